"""Tasks of a Dask cluster that are submitted as others end, so that its scheduler never has many of them."""

from collections.abc import Callable, Generator, Iterable, Mapping
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from distributed import Client

T = TypeVar("T")


def rolling(
    client: "Client",
    work: Callable[..., T],
    tasks: Iterable[tuple[str, tuple[Any, ...]]],
    in_flight: int,
    how: Mapping[str, Any],
) -> Generator[list[T], None, None]:
    """The results of `work` for the arguments of each task, which has a key, in batches as they come.

    At most `in_flight` tasks are with the scheduler; `how` are further arguments of `client.submit`. Tasks that are still there when
    the iterator is closed are cancelled.
    """
    from distributed import as_completed

    queue, running = iter(tasks), dict[str, Any]()

    def submit(count: int) -> list[Any]:
        new = {key: client.submit(work, *of, key=key, **how) for key, of in islice(queue, count)}
        running.update(new)
        return list(new.values())

    ended = as_completed(submit(in_flight), with_results=True)  # type: ignore[no-untyped-call]
    try:
        for batch in ended.batches():  # type: ignore[no-untyped-call]
            for task, _ in batch:
                running.pop(task.key, None)
            yield [result for _, result in batch]
            ended.update(submit(in_flight - len(running)))  # type: ignore[no-untyped-call]
    finally:
        client.cancel(list(running.values()))  # type: ignore[no-untyped-call]
