"""Cost of a flight that Python steps, each figure next to its goal. CPU times, medians; compared flights are interleaved.
scripts/bench runs this program with Debian's Python and the package of the build folder.

usage: stepping.py SOURCE
"""

import pathlib
import statistics
import sys
import time

import numpy as np

import hedgehop

ROUNDS = 7
#: One camera of 64 x 48 px at 25 Hz and control at 50 Hz, typical of small learning environments.
SMALL = {"rig": {"cameras": [{"role": "front", "width": 64, "height": 48, "rate": 25}]}, "control_rate": 50,
         "velocimeter.enabled": False, "film.enabled": False, "checks": [], "drawing.renderer": "tiles", "duration": 40}


def cpu_s(call):
    begin = time.process_time()
    call()
    return time.process_time() - begin


def step_through(sim):
    """Flies with a command from Python in every decision; returns the number of decisions."""
    hover, decisions = hedgehop.HoverCommand(), 0
    while not sim.over:
        sim.step(hover)
        decisions += 1
    return decisions


def more_than_native_us(world):
    """Additional cost of a decision in Python over one in C++, us: a flight without cameras, plus the construction of an
    Observation with an image."""
    blind = hedgehop.Simulation(world, set={**SMALL, "rig": {"cameras": []}}, cameras=[])
    native, stepped, decisions = [], [], 0

    def count():
        nonlocal decisions
        decisions = step_through(blind)

    for _ in range(3 * ROUNDS):
        blind.reset()
        native.append(cpu_s(blind._native.run_through))
        blind.reset()
        stepped.append(cpu_s(count))
    seeing = hedgehop.Simulation(world, set=SMALL, cameras=["front"])

    def look_on(sim):
        for _ in range(10000):
            sim._native.seen()

    image_s = (cpu_s(lambda: look_on(seeing)) - cpu_s(lambda: look_on(blind))) / 10000
    return 1e6 * ((statistics.median(stepped) - statistics.median(native)) / decisions + image_s)


def speed(world):
    """Real-time factor of a flight that Python steps, on one core."""
    sim = hedgehop.Simulation(world, set=SMALL, cameras=["front"])
    times = []
    for _ in range(ROUNDS):
        sim.reset()
        times.append(cpu_s(lambda: step_through(sim)))
    return sim.t_s / statistics.median(times)


def start_over_reset(world):
    def start():
        hedgehop.Simulation(world, set=SMALL, cameras=["front"])

    sim = hedgehop.Simulation(world, set=SMALL, cameras=["front"])
    starts = [cpu_s(start) for _ in range(ROUNDS)]
    return statistics.median(starts) / statistics.median(cpu_s(sim.reset) for _ in range(3 * ROUNDS))


def side_by_side(world):
    """Steps per second of two environments in separate processes, wall time."""
    with hedgehop.VectorEnv(str(world), 2, cameras=["front"], set=SMALL) as envs:
        envs.reset(seed=1)
        action, begin = np.zeros((2, 4)), time.monotonic()
        for _ in range(1000):
            envs.step(action)
        return 2 * 1000 / (time.monotonic() - begin)


def main(source):
    world = pathlib.Path(source) / "configs/worlds/tree.yaml"
    print(f"\n{'stepped from Python':60} {'measured':>10} {'goal':>8}")
    for figure, value, goal in (("a decision from Python over one in C++, us", more_than_native_us(world), "<= 20"),
                              ("one camera 64 x 48 at 25 Hz, times real time, one core", speed(world), ">= 100"),
                              ("the same as an Env, two processes, steps per second", side_by_side(world), ""),
                              ("start over reset", start_over_reset(world), ">= 40")):
        print(f"{figure:60} {value:10.4g} {goal:>8}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
