"""Positions of a four-bar: this package and pylinkage's solver that numba compiles, its fastest.

The linkage is the one of pylinkage's documentation (frame 4, crank 1, coupler 3.5, rocker 3), the work of both the positions of its pins at
equal steps of a full turn of the crank, again in each repetition. Both are warm: pylinkage's solver is compiled, and the limits of the linkage and
the table of sines are known here, as they are in a sweep. The curves are compared before anything is timed.

    python benchmarks/pylinkage_fourbar.py
"""

import argparse
import statistics
import sys
import time
from collections.abc import Callable

# Without numba pylinkage computes the same a hundred times more slowly.
import numba  # noqa: F401
import numpy as np
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import RRRDyad
from pylinkage.simulation import Linkage

import coupler_atlas as ca

FRAME, CRANK, COUPLER, ROCKER = 4.0, 1.0, 3.5, 3.0


def pylinkage_four_bar(steps: int) -> Linkage:
    """The four-bar, compiled, for so many steps of a turn."""
    first, second = Ground(0, 0, name="O1"), Ground(FRAME, 0, name="O2")
    crank = Crank(anchor=first, radius=CRANK, angular_velocity=2 * np.pi / steps, name="crank")
    rocker = RRRDyad(anchor1=crank.output, anchor2=second, distance1=COUPLER, distance2=ROCKER, name="rocker")
    linkage = Linkage([first, second, crank, rocker], name="Four-Bar")
    linkage.compile()
    return linkage


def median_seconds(call: Callable[[], object], repetitions: int) -> float:
    """The median time of a call."""
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repetitions", type=int, default=200, help="how often each is timed")
    parser.add_argument("--at-least", type=float, default=0.0, help="fail unless the ratio at 1000 steps is at least this")
    arguments = parser.parse_args()
    # The rocker pin, as a point of the coupler.
    bar = ca.FourBar(FRAME, CRANK, COUPLER, ROCKER, along=COUPLER, across=0)
    ratios = {}
    for steps in (360, 1000, 10_000):
        theirs = pylinkage_four_bar(steps)
        # Their first position is after a step, and ours before it.
        expected = np.roll(theirs.step_fast(iterations=steps)[:, 3], 1, axis=0)
        difference = np.abs(bar.curve(steps) - expected).max()
        assert difference < 1e-9, f"the curves differ by {difference}"
        # In turn, so that both see the same machine.
        rounds = [
            (
                median_seconds(lambda: theirs.step_fast(iterations=steps), arguments.repetitions),
                median_seconds(lambda: bar.curve(steps), arguments.repetitions),
            )
            for _ in range(5)
        ]
        ratios[steps] = statistics.median(slow / fast for slow, fast in rounds)
        slow, fast = (statistics.median(column) for column in zip(*rounds))
        print(f"{steps:6} steps: pylinkage {slow * 1e6:8.1f} us, coupler_atlas {fast * 1e6:8.1f} us, {ratios[steps]:5.1f} times as fast")
    if ratios[1000] < arguments.at_least:
        print(f"{ratios[1000]:.1f} times as fast, and not {arguments.at_least}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
