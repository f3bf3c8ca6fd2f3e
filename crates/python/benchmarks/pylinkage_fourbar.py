"""Positions of a four-bar, and of a thousand: this package and pylinkage's solver that numba compiles, its fastest.

The linkage is the one of pylinkage's documentation (frame 4, crank 1, coupler 3.5, rocker 3), the work of both the positions of its pins at
equal steps of a full turn of the crank, again in each repetition. Both are warm: pylinkage's solver is compiled, and the limits of the linkage and
the table of sines are known here, as they are in a sweep. The curves are compared before anything is timed.

The thousand differ in the length of the crank: an `Ensemble` of pylinkage, and here a `FourBar` each, and a sweep of their points, from the array of
cranks to the last array of points.

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
from pylinkage.population import Ensemble
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


def compare_many(repetitions: int, steps: int = 360, count: int = 1000) -> None:
    """A thousand four-bars with other cranks."""
    base = pylinkage_four_bar(steps)
    cranks = np.linspace(0.8, 1.2, count)
    dimensions = np.column_stack([cranks, np.full(count, COUPLER), np.full(count, ROCKER)])
    starts = np.repeat(np.array([[part.x, part.y] for part in base.components], dtype=float)[None], count, axis=0)
    ensemble = Ensemble(base, dimensions, starts)

    def each() -> np.ndarray:
        return np.array([ca.FourBar(FRAME, crank, COUPLER, ROCKER, along=COUPLER, across=0).curve(steps) for crank in cranks])

    def swept() -> np.ndarray:
        parameters = {"frame": FRAME, "crank": cranks, "coupler": COUPLER, "rocker": ROCKER, "along": COUPLER, "across": 0}
        sweep = ca.sweep(linkage="four-bar", parameters=parameters, circuits="start", samples=steps, points=True, progress=False)
        return np.concatenate([np.column_stack([batch["x"], batch["y"]]) for batch in sweep.batches()]).reshape(count, steps, 2)

    expected = np.roll(ensemble.simulate(iterations=steps)[:, :, 3], 1, axis=1)
    for own in (each(), swept()):
        assert np.abs(own - expected).max() < 1e-9
    calls = (lambda: ensemble.simulate(iterations=steps), each, swept)
    rounds = [[median_seconds(call, max(1, repetitions // 20)) for call in calls] for _ in range(5)]
    theirs, one_by_one, together = (statistics.median(column) for column in zip(*rounds))
    print(
        f"{count} linkages in {steps} steps: pylinkage {theirs * 1e3:.1f} ms, coupler_atlas one by one {one_by_one * 1e3:.1f} ms, "
        f"{theirs / one_by_one:.1f} times as fast, in a sweep {together * 1e3:.1f} ms, {theirs / together:.1f} times as fast"
    )


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
    compare_many(arguments.repetitions)
    if ratios[1000] < arguments.at_least:
        print(f"{ratios[1000]:.1f} times as fast, and not {arguments.at_least}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
