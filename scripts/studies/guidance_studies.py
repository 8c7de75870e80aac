#!/usr/bin/env python3
"""Runs the studies of docs/guidance.md; scripts/studies/guidance_page.py writes their figures into the page.

usage: scripts/studies/guidance_studies.py FOLDER [--runs N] [--threads N] [STUDY...]

Studies (all without a name): square (scenarios/city_square/study.json), baselines (nobody informed or a siren at t = 0,
without and with three drones, for the crowd models orca and ttc), unseen (another seed, drones lead at 1.6 m/s), camera
(drones see what their cameras count), compliance (half of the people follow), signage, everyday_square (the four cases of
city_square). FOLDER has a folder per study; an interrupted one is resumed. THRONG names another program than
build/release/cli/throng.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
THRONG = os.environ.get("THRONG", str(ROOT / "build/release/cli/throng"))
SHIPPED = json.loads((ROOT / "scenarios/city_square/study.json").read_text(encoding="utf-8"))
NEWS = r'<Condition type="proximity" distance="20" agentToAvoid="260" growth_rate="0.75"/>'
SIREN = '<Condition type="proximity" distance="1000" agentToAvoid="260"/>'
CASES = ["nearest_exit", "crowded_exit_blocked", "side_exit_blocked", "second_nearest"]
UNSEEN_SEED = 60427  # of no study before this one


def cases(prefix, **crowd):
    """Cases of the shipped study whose ids begin with `prefix`, with more settings of the crowd."""
    found = [dict(case) for case in SHIPPED["cases"] if case["id"].startswith(prefix)]
    for case in found:
        if crowd:
            case["crowd"] = {**case.get("crowd", {}), **crowd}
    return found


def policies(*ids, **guidance):
    """Policies of the shipped study, with other parameters of the drones' guidance."""
    found = json.loads(json.dumps([policy for policy in SHIPPED["policies"] if policy["id"] in ids]))
    for policy in found:
        for drone in policy.get("drones", []):
            drone["guidance"].update(guidance)
    return found


def study(name, its_cases, its_policies, runs, seed=None):
    """A study file as a value; nobody flies in its baseline."""
    return {
        "name": name,
        "seed": SHIPPED["seed"] if seed is None else seed,
        "runs": runs,
        "baseline": "none",
        "cases": its_cases,
        "policies": its_policies,
    }


def add_siren(scenarios):
    """Scenarios X_siren: X_navigated, but everybody knows at t = 0."""
    folder = scenarios / "city_square/huang2016"
    for case in CASES:
        behavior = (folder / f"{case}_navigated_behavior.xml").read_text(encoding="utf-8")
        if behavior.count(NEWS) == 0:
            raise SystemExit(f"{case}_navigated_behavior.xml: no condition {NEWS}")
        (folder / f"{case}_siren_behavior.xml").write_text(behavior.replace(NEWS, SIREN), encoding="utf-8")
        scenario = json.loads((folder / f"{case}_navigated.json").read_text(encoding="utf-8"))
        scenario["crowd"]["behavior"] = f"{case}_siren_behavior.xml"
        (folder / f"{case}_siren.json").write_text(json.dumps(scenario), encoding="utf-8")


def baseline_cases():
    """Cases 1 to 4 with navigation, without and with a siren, for two crowd models."""
    found = []
    for model in ["orca", "ttc"]:
        for case in cases("ours_", model=model):
            siren = dict(case, scenario=case["scenario"].replace("_navigated", "_siren"))
            found += [dict(case, id=f"{model}_{case['id']}"), dict(siren, id=f"{model}_siren_{case['id']}")]
    return found


def everyday_square():
    """The cases of city_square with today's default crowd of that scenario."""
    return [{"id": case, "scenario": f"city_square/{case}", "duration_s": 300} for case in CASES]


def signage():
    """Three drones of the policy signage."""
    drones = policies("balance_3")[0]["drones"]
    for drone in drones:
        drone["guidance"] = {"policy": "signage"}
    return [policies("none")[0], {"id": "signage_3", "title": "signage, 3 drones", "drones": drones}]


def studies():
    """All studies by name."""
    three = policies("none", "balance_3", lead_speed_mps=1.6)
    camera = policies("none", "balance_3", lead_speed_mps=1.6, perception={"kind": "camera"})
    return {
        "square": SHIPPED,
        "baselines": study("Baselines", baseline_cases(), policies("none", "balance_3"), 24),
        "unseen": study(
            "Other seeds", cases(""), policies("none", "balance_1", "balance_3", lead_speed_mps=1.6), 12, UNSEEN_SEED
        ),
        "three": study("Three drones at 1.6 m/s", cases("paper_"), three, 12),
        "camera": study("Camera perception", cases("paper_"), camera, 12),
        "compliance": study("Half comply", cases("paper_", compliance=0.5), three, 12),
        "signage": study("Signage", cases("paper_"), signage(), 12),
        "everyday_square": study("Cases of the library", everyday_square(), policies("none", "balance_3"), 12),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("study", nargs="*")
    options = parser.parse_intermixed_args()
    scenarios = options.folder.resolve() / "scenarios"
    shutil.copytree(ROOT / "scenarios", scenarios, dirs_exist_ok=True)
    add_siren(scenarios)
    for name, document in studies().items():
        if options.study and name not in options.study:
            continue
        file = options.folder / f"{name}.json"
        file.write_text(json.dumps(document, indent=1), encoding="utf-8")
        subprocess.run(
            [
                THRONG,
                "study",
                file,
                "-o",
                options.folder / name,
                "--runs",
                str(options.runs),
                "--threads",
                str(options.threads),
            ],
            check=True,
            stdout=subprocess.DEVNULL,
            env={**os.environ, "THRONG_SCENARIOS": str(scenarios)},
        )


if __name__ == "__main__":
    main()
