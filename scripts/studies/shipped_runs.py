#!/usr/bin/env python3
"""Simulates every shipped scenario for 600 s with its hovering drones and says why people are inside at the end.

usage: scripts/studies/shipped_runs.py [--seeds 1,2,3,4,5] [--agents N] [--duration S] [SCENARIO...]

Prints a row per scenario and seed: the counts of metrics.json's `remaining`. Exits with 1 where somebody is stalled,
blocked or follows a drone that only films. THRONG names another program than build/release/cli/throng.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
THRONG = os.environ.get("THRONG", str(ROOT / "build/release/cli/throng"))
REASONS = ["casualty", "guided", "waiting", "blocked", "walking", "stalled"]
LARGE = {"concert": 2000, "stadium_exit": 2000}


def shipped():
    """Ids of all scenarios."""
    folder = ROOT / "scenarios"
    for file in sorted(folder.rglob("*.json")):
        if not file.name.endswith(".job.json") and file.name != "study.json":
            yield re.sub(r"(\.scenario|\.blueprint)?\.json$", "", str(file.relative_to(folder)))


def crowd_options(scenario, agents):
    """The job's crowd: large scenarios with fewer people, the paper's own files in the paper's mode."""
    crowd = {}
    limit = agents or LARGE.get(scenario.split("/")[0])
    if limit:
        crowd["agents"] = limit
    if "huang2016/" in scenario and not scenario.endswith("_navigated"):
        crowd["compat"] = "huang2016"
    return crowd


def count_remaining(scenario, seed, options, folder):
    """metrics.json of one run."""
    job = {
        "scenario": scenario,
        "seed": seed,
        "crowd": crowd_options(scenario, options.agents),
        "capture": {"rate_hz": 1, "from_s": 0, "to_s": options.duration},
    }
    job_file, trace = folder / "job.json", folder / "run.h5"
    job_file.write_text(json.dumps(job), encoding="utf-8")
    subprocess.run([THRONG, "simulate", job_file, "-o", trace], check=True, capture_output=True, cwd=ROOT)
    said = subprocess.run([THRONG, "metrics", trace], check=True, capture_output=True, cwd=ROOT, encoding="utf-8")
    trace.unlink()
    return json.loads(said.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="1,2,3,4,5")
    parser.add_argument("--agents", type=int)
    parser.add_argument("--duration", type=float, default=600)
    parser.add_argument("scenario", nargs="*")
    options = parser.parse_args()
    failed = False
    print("| scenario | seed | people | inside | " + " | ".join(REASONS) + " |")
    print("|---|" + "---|" * (3 + len(REASONS)))
    with tempfile.TemporaryDirectory() as folder:
        for scenario in options.scenario or shipped():
            for seed in map(int, options.seeds.split(",")):
                metrics = count_remaining(scenario, seed, options, pathlib.Path(folder))
                remaining = metrics["remaining"]
                row = [scenario, seed, metrics["people"], remaining["people"]] + [remaining[r] for r in REASONS]
                print("| " + " | ".join(map(str, row)) + " |", flush=True)
                failed = failed or any(remaining[r] for r in ("guided", "blocked", "stalled"))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
