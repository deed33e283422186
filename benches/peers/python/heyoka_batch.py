"""heyoka: Taylor integration of several motions at once, one in each lane of the vector registers.

Set as `heyoka_scalar.py`; the number of lanes is the one heyoka recommends for the machine. A lane whose start is done
takes the next one within the callback, so that no lane waits for another.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence

import heyoka as hy
import numpy as np

from heyoka_scalar import RESTITUTION, TOLERANCE, seconds_per_call
from peer import (DROPPED, FIRST, FOLLOWED, MOST_M, TAU, Basin, Followed, Start, basin_start, label, main)

LANES: int = hy.recommended_simd_size()
ROUND = 4096
"""Impacts of all lanes together between two looks at the clock. It is impacts and not time, because in a given time all
lanes would have to wait for the one with the most steps."""
FAR = 1e9
"""A time never reached."""
APART = 1e-3
"""Difference in the velocity of the starts of neighbouring lanes: the same attractor, another motion."""
OUT_OF_REACH = 1e9
"""The gap of a lane that is done."""


class Lanes:
    """An integrator and its memory: rows x, v in `state` and beta, gap, phase in `pars`, one number for each lane."""

    def __init__(self, impact: Callable[[hy.taylor_adaptive_batch_dbl, bool, int], bool]) -> None:
        x, v = hy.make_vars("x", "v")
        beta, gap, phase = hy.par[0], hy.par[1], hy.par[2]
        self.ta = hy.taylor_adaptive_batch(
            [(x, v), (v, hy.sin(beta * hy.time + phase) - x)],
            np.zeros((2, LANES)),
            pars=np.ones((3, LANES)),
            t_events=[hy.t_event_batch(x - gap, callback=impact, direction=hy.event_direction.positive)],
            tol=TOLERANCE,
            fast_math=True,
        )
        self.state = memoryview(self.ta.state).cast("B").cast("d")
        self.pars = memoryview(self.ta.pars).cast("B").cast("d")
        # what the times of the lanes were set back by
        self.offset = [0.0] * LANES

    def put(self, lane: int, start: Start, now: float = 0.0) -> None:
        """Puts a lane, whose time is `now`, at a start."""
        self.state[lane], self.state[LANES + lane] = start.x, start.v
        self.pars[lane], self.pars[LANES + lane] = start.beta, start.gap
        self.pars[2 * LANES + lane] = (start.phase - start.beta * now) % TAU

    def go_on(self) -> None:
        """Until the callback says false. Then the times are set to 0 and the phases moved on, to keep their digits."""
        self.ta.propagate_until([FAR] * LANES)
        times = self.ta.time.copy()
        self.ta.pars[2] = (self.ta.pars[2] + self.ta.pars[0] * times) % TAU
        self.ta.set_time(0.0)
        for lane, time_of_lane in enumerate(times):
            self.offset[lane] += float(time_of_lane)


class Batch:
    """Follows as many motions at once as there are lanes."""

    def follow(self, start: Start, seconds: float) -> Followed:
        count = 0

        def impact(ta: hy.taylor_adaptive_batch_dbl, sign: bool, lane: int) -> bool:
            nonlocal count
            state[LANES + lane] *= -RESTITUTION
            count += 1
            return count % ROUND != 0

        lanes = Lanes(impact)
        state = lanes.state
        for lane in range(LANES):
            lanes.put(lane, start)
            state[LANES + lane] += APART * lane
        # twice as many as asked for, since some lanes are ahead of others
        while count < 2 * DROPPED * LANES:
            lanes.go_on()
        # on a periodic motion all lanes would do the same at the same time; shifted, they are like any motions
        lanes.ta.propagate_for([TAU / start.beta * lane / LANES for lane in range(LANES)])
        first, elapsed = count, 0.0
        clock = time.perf_counter()
        while elapsed < seconds:
            lanes.go_on()
            elapsed = time.perf_counter() - clock
        rate = (count - first) / elapsed
        return Followed(rate, rate * seconds_per_call(impact, lanes.ta, True, 0))

    def basin(self, seconds: float) -> Basin:
        labels: Counter[str] = Counter()
        total = begun = 0
        starts, counts = [0] * LANES, [0] * LANES
        times: list[list[float]] = [[] for _ in range(LANES)]
        velocities: list[list[float]] = [[] for _ in range(LANES)]
        beta = basin_start(0).beta

        def take(lane: int, now: float) -> None:
            """The lane takes the next start."""
            nonlocal begun
            lanes.put(lane, basin_start(begun), now)
            starts[lane], counts[lane] = begun, 0
            begun += 1
            times[lane].clear()
            velocities[lane].clear()

        def impact(ta: hy.taylor_adaptive_batch_dbl, sign: bool, lane: int) -> bool:
            nonlocal total
            state[LANES + lane] *= -RESTITUTION
            counts[lane] = count = counts[lane] + 1
            if count >= FOLLOWED - MOST_M:
                now = ta.time[lane]
                times[lane].append(lanes.offset[lane] + now)
                velocities[lane].append(state[LANES + lane])
                if count == FOLLOWED:
                    labels[label(beta, times[lane], velocities[lane])] += 1
                    take(lane, now)
            total += 1
            return total % ROUND != 0

        lanes = Lanes(impact)
        state = lanes.state
        for lane in range(LANES):
            take(lane, 0.0)
        elapsed = 0.0
        clock = time.perf_counter()
        while elapsed < seconds:
            before = list(zip(starts, counts, strict=True))
            lanes.go_on()
            for lane, now in enumerate(zip(starts, counts, strict=True)):
                # no impact while the others had hundreds
                if now == before[lane]:
                    labels["stuck"] += 1
                    take(lane, 0.0)
            elapsed = time.perf_counter() - clock
        return Basin(labels.total() / elapsed, labels)

    def impacts(self, starts: Sequence[Start]) -> list[list[float]]:
        times: list[list[float]] = []

        def impact(ta: hy.taylor_adaptive_batch_dbl, sign: bool, lane: int) -> bool:
            lanes.state[LANES + lane] *= -RESTITUTION
            times[lane].append(float(ta.time[lane]))
            if len(times[lane]) == FIRST:
                lanes.pars[LANES + lane] = OUT_OF_REACH
            return True

        lanes = Lanes(impact)
        lists: list[list[float]] = []
        for k in range(0, len(starts), LANES):
            group = list(starts[k : k + LANES])
            missing = LANES - len(group)
            group += [group[-1]] * missing
            times = [[] for _ in group]
            lanes.ta.set_time(0.0)
            lanes.ta.reset_cooldowns()
            for lane, start in enumerate(group):
                lanes.put(lane, start)
            lanes.ta.propagate_until([start.horizon for start in group])
            lists += times[: LANES - missing]
        return lists


if __name__ == "__main__":
    main(Batch())
