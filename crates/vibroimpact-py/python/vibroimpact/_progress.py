"""Reports of progress: none, to a function, or to a progress bar of tqdm."""

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeAlias

#: `None`, `True` for a progress bar, or a function called with the amounts done and in total. It stops the work by returning False.
Progress: TypeAlias = "bool | Callable[[int, int], object] | None"


@contextmanager
def watched(progress: Progress, what: str) -> Iterator[Callable[[int, int], object] | None]:
    """The function to call with progress; a progress bar is closed afterwards."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        if not callable(progress):
            raise TypeError("progress is True, or a function of what is done and what there is to do")
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        warnings.warn("progress=True needs tqdm: pip install tqdm", stacklevel=3)
        yield None
        return
    with tqdm(desc=what, unit_scale=True) as bar:

        def advance(done: int, total: int) -> None:
            bar.total = total
            bar.update(done - bar.n)

        yield advance
