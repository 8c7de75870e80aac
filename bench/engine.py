"""Speed of throng.engine: seconds of the scenario per second, and images per second.

usage: taskset -c 0 /usr/bin/python3 bench/engine.py THRONG [SCENARIO...]
"""

import os
import pathlib
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))
os.environ["THRONG_PROGRAM"] = sys.argv[1]
os.environ.setdefault("THRONG_PEOPLE", str(ROOT / "build/people"))
from throng.engine import Simulation  # noqa: E402

SCENARIOS = sys.argv[2:] or ["city_square/nearest_exit", "city_square/market_day"]
COMMAND = [[1, 0, 0, 0.1, 1]]
DURATION_S = 120
IMAGES = 60
REPEATS = 5


def simulation(scenario):
    job = {"scenario": scenario, "drones": [{"id": "d1", "start": [0, -10, 20]}], "capture": {"to_s": DURATION_S}}
    return Simulation(job, seed=3, remote=True)


def times_real_time(scenario):
    run = simulation(scenario)
    began = time.perf_counter()
    while not run.is_over:
        run.step(COMMAND)
    return run.time_s / (time.perf_counter() - began)


def images_per_s(scenario):
    run = simulation(scenario)
    run.image()  # loads characters
    began = time.perf_counter()
    for _ in range(IMAGES):
        run.step(COMMAND)
        run.image()
    return IMAGES / (time.perf_counter() - began)


for each in SCENARIOS:
    agents = int(simulation(each).present.sum())
    factors = [times_real_time(each) for _ in range(REPEATS)]
    images = [images_per_s(each) for _ in range(REPEATS)]
    print(
        f"{each}, {agents} people at the start: {statistics.median(factors):.0f} x real time ({min(factors):.0f} to"
        f" {max(factors):.0f}), {statistics.median(images):.0f} images/s of 320 x 180 ({min(images):.0f} to {max(images):.0f})"
    )
