#!/usr/bin/env python3
"""A scenario of every other shipped folder runs for 150 s, and nobody is inside at the end without a reason.

The drones of the scenario hover, as a job without drones has it. 60 people each keep it short; with $THRONG_LONG it is
every scenario, with 250 people for 300 s, and scripts/studies/shipped_runs.py does the same for 600 s with everybody and more seeds. The paper's own files (huang2016, in the paper's mode) are left out: some of
their people start in a wall (docs/shipped_scenarios.md).
usage: test_shipped.py THRONG
"""
import json
import os
import pathlib
import re
import tempfile
import unittest

from program import ROOT, printed, throng

IS_LONG = bool(os.environ.get("THRONG_LONG"))
PEOPLE, DURATION_S = (250, 300) if IS_LONG else (60, 150)
# The blueprint's, city_square/nearest_exit and its three cases, and the same with walls around obstacles.
PAPERS_OWN = (
    "huang2016/crowded_exit_blocked",
    "huang2016/nearest_exit",
    "huang2016/second_nearest",
    "huang2016/side_exit_blocked",
)


def shipped():
    """Ids of all scenarios but the paper's own."""
    folder = ROOT / "scenarios"
    for file in sorted(folder.rglob("*.json")):
        name = re.sub(r"(\.blueprint)?\.json$", "", str(file.relative_to(folder)))
        is_scenario = not file.name.endswith(".job.json") and file.name != "study.json"
        if is_scenario and not name.endswith(PAPERS_OWN):
            yield name


def sample_of(names):
    """One of every other folder: its emergency, if it has one."""
    by_folder = {}
    for name in names:
        folder = name.partition("/")[0]
        if folder not in by_folder or name == f"{folder}/emergency":
            by_folder[folder] = name
    return list(by_folder.values())[::2]


def metrics_of(scenario, folder, drones=None):
    """metrics.json of one run."""
    job = {
        "scenario": scenario,
        "seed": 90210,
        "crowd": {"agents": PEOPLE},
        "capture": {"rate_hz": 1, "from_s": 0, "to_s": DURATION_S},
    }
    if drones:
        job["drones"] = drones
    job_file, trace = pathlib.Path(folder) / "job.json", pathlib.Path(folder) / "run.h5"
    job_file.write_text(json.dumps(job))
    throng("simulate", job_file, "-o", trace, cwd=ROOT)
    metrics = printed("metrics", trace, cwd=ROOT)
    trace.unlink()
    return json.loads(metrics)


class Shipped(unittest.TestCase):
    def test_nobody_is_trapped(self):
        with tempfile.TemporaryDirectory() as folder:
            for scenario in shipped() if IS_LONG else sample_of(shipped()):
                with self.subTest(scenario=scenario):
                    metrics = metrics_of(scenario, folder)
                    remaining = metrics["remaining"]
                    self.assertGreater(metrics["people"], 0)
                    for reason in ("guided", "blocked", "stalled"):
                        self.assertEqual(remaining[reason], 0, remaining)
                    if not scenario.endswith("everyday"):
                        # Arrivals in the last seconds may not have noticed yet.
                        self.assertLessEqual(remaining["waiting"], 5, remaining)

    def test_a_lit_beacon_is_asked_for_and_named(self):
        drones = [
            {"id": "d1", "start": [0, -10, 25], "moves_goal": [99, 0], "guidance": {"policy": "hover", "beacon": True}}
        ]
        with tempfile.TemporaryDirectory() as folder:
            remaining = metrics_of("city_square/nearest_exit", folder, drones)["remaining"]
        self.assertGreater(remaining["guided"], 10)


if __name__ == "__main__":
    unittest.main()
