"""Every figure of evacuation agrees with a count from the trace in halls drawn at random (random_halls.py).

usage: test_random_halls.py THRONG [FIRST [COUNT]]    COUNT halls from the seed FIRST on: always the same 10; with
$THRONG_LONG, 200 from a new seed, which is printed. `random_halls.py SEED` prints the blueprint of a seed."""
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import random_halls

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from throng.trace import Trace  # noqa: E402

FIRST_SEED = 20261128
LONG = bool(os.environ.get("THRONG_LONG"))
END_S = 60
BESIDE_M = 0.2  # a crossing counts so far beyond the line
DOORWAY_M = 2  # so near to an exit people are inside until they pass it


def beyond_m(exit, places):
    return (places - (exit["a"] + exit["b"]) / 2) @ exit["outward"]


def distance_m(exit, places):
    edge = exit["b"] - exit["a"]
    share = np.clip((places - exit["a"]) @ edge / (edge @ edge), 0, 1)
    return np.linalg.norm(places - exit["a"] - share[..., None] * edge, axis=-1)


def crossings_of(exit, places, time_s, radius_m):
    """Of one person: [(step, +1 outward or -1 inward, time)] by the plane of the exit, within its opening."""
    found = []
    beyond = beyond_m(exit, places)
    along = (exit["b"] - exit["a"]) / np.linalg.norm(exit["b"] - exit["a"])
    for step in np.flatnonzero((beyond[1:] >= 0) != (beyond[:-1] >= 0)):
        share = beyond[step] / (beyond[step] - beyond[step + 1])
        point = places[step] + share * (places[step + 1] - places[step])
        at_m = (point - exit["a"]) @ along
        if -exit["low_m"] * radius_m <= at_m < np.linalg.norm(exit["b"] - exit["a"]) + exit["high_m"] * radius_m:
            sign = 1 if beyond[step + 1] >= 0 else -1
            found.append((step + 1, sign, time_s[step] + share * (time_s[step + 1] - time_s[step])))
    return found


def is_inside(hall, border_m, places):
    """Whether places are in the hall made larger by a border."""
    shape = {name: np.array(corner) + border_m for name, corner in hall["shape"].items()}
    in_box = np.all((places >= -border_m) & (places <= shape["max"]), axis=-1)
    return in_box & np.any(places <= shape["notch"], axis=-1)


def outcome_of(places, present, time_s, hall, radius_m, alarm_s):
    """How the run ended for a person, counted without any of the program's code."""
    exits = hall["exits"]
    there = np.flatnonzero(present)
    crossings = sorted(
        (time, step, sign, exit["id"])
        for exit in exits
        for step, sign, time in crossings_of(exit, places[there], time_s[there], radius_m)
    )
    crossings = [(time, there[step], sign, name) for time, step, sign, name in crossings]
    within = is_inside(hall, hall["border_m"], places) & present
    first_in = int(np.argmax(within)) if within.any() else None
    result = {"crossings": crossings, "escaped_s": None, "exit": None, "start_s": None}
    if first_in is None:
        return result | {"outcome": "never_inside"}
    near = np.stack([distance_m(exit, places) for exit in exits])
    beyond = np.stack([beyond_m(exit, places) for exit in exits])
    margins = np.where(np.arange(len(places)) > first_in, BESIDE_M, BESIDE_M if present[:first_in].any() else 0)
    entered = (np.take_along_axis(beyond, near.argmin(axis=0)[None], axis=0)[0] < -margins) & within
    entered |= is_inside(hall, -BESIDE_M, places) & within
    passed = np.zeros(len(places), bool)
    for _, step, sign, _ in crossings:
        passed[step:] = sign > 0
    before_exit = ((near <= DOORWAY_M) & (beyond < 0)).any(axis=0) & present & ~passed
    before_exit[:first_in] = False
    last_in = np.flatnonzero(within | before_exit)[-1]
    result["start_s"] = max(alarm_s, time_s[first_in])
    is_out = last_in + 1 < len(places)
    if not entered.any():
        return result | {"outcome": "turned_back"}
    if not is_out:
        return result | {"outcome": "inside"}
    outward = [(step, name) for _, step, sign, name in crossings if sign > 0]
    result["exit"] = outward[-1][1] if crossings and crossings[-1][2] > 0 else None
    out_from = max(last_in + 1, outward[-1][0] if result["exit"] else 0)
    return result | {"outcome": "left", "escaped_s": time_s[out_from]}


def percentile(times_s, people, percent):
    rank = math.ceil(percent * people / 100 - 1e-9)
    return sorted(times_s)[rank - 1] if 0 < rank <= len(times_s) else None


def differences(hall, metrics, events, rows, trace):
    """Lines about figures that differ from what the trace gives."""
    said = []

    def same(what, found, expected, slack=1e-6):
        if found is None or expected is None:
            equal = found is expected
        else:
            equal = found == expected if isinstance(found, str) else abs(found - expected) <= slack
        if not equal:
            said.append(f"{what}: {found}, by the trace {expected}")

    alarm_s, time_s = hall["alarm_s"], trace.time_s
    radius_m = float(np.mean(trace.radii_m[trace.people]))
    people = {}
    for agent in trace.people:
        if trace.present[:, agent].any():
            people[int(agent)] = outcome_of(
                trace.positions[:, agent], trace.present[:, agent], time_s, hall, radius_m, alarm_s
            )
    table = metrics["by_person"]
    same("people", len(table["agent"]), len(people))
    for row, agent in enumerate(table["agent"]):
        for key in ("outcome", "exit", "escaped_s"):
            same(f"{key} of {agent}", table[key][row], people[agent][key])
    counts = metrics["people_counts"]
    for key in ("turned_back", "never_inside", "inside"):
        same(key, counts[key], sum(person["outcome"] == key for person in people.values()))
    left = [person for person in people.values() if person["outcome"] == "left"]
    evacuees = [
        person
        for person in people.values()
        if person["outcome"] in ("left", "inside") and not (person["escaped_s"] or END_S) < person["start_s"] - 1e-6
    ]
    times_s = [person["escaped_s"] - person["start_s"] for person in evacuees if person["outcome"] == "left"]
    for percent in (25, 50, 90, 95, 100):
        key = f"t{percent}_s"
        same(key, metrics["escape_time_percentiles"][key], percentile(times_s, len(evacuees), percent))
    nets = {}
    for exit, figures, by_exit in zip(hall["exits"], metrics["exits"], counts["left_by_exit"]):
        name = exit["id"]
        of_exit = [one for person in people.values() for one in person["crossings"] if one[3] == name]
        nets[name] = sum(sign for _, _, sign, _ in of_exit)
        at_line = sum(
            abs(beyond_m(exit, trace.positions[-1, agent])) < BESIDE_M for agent in people if trace.present[-1, agent]
        )
        same(f"net_out of {name}", figures["net_out"], nets[name], at_line)
        same(f"last row of {name}", rows[name][0] - rows[name][1], figures["net_out"])
        same(f"left by {name}", by_exit["people"], sum(person["exit"] == name for person in left))
        same(f"width of {name}", figures["width_m"], exit["free_m"], 1e-3)
        open_s = exit["open_until_s"]
        open_share = np.mean(time_s < open_s - 1e-6)
        same(f"capacity of {name}", figures["capacity_per_s"], 1.3 * exit["free_m"] * open_share, 1e-2)
        late = [time for time, _, sign, _ in of_exit if sign > 0 and time > open_s + 1e-6]
        same(f"passages of {name} when closed", len(late), 0)
    total = sum(max(0, figures["net_out"]) for figures in metrics["exits"])
    for figures in metrics["exits"]:
        if total:
            same(f"share of {figures['id']}", figures["share_of_net_out"], max(0, figures["net_out"]) / total)
    escapes = {event["track_id"] % 1000000 - 1: event for event in events if event["type"] == "escapes"}
    same("escapes in events", len(escapes), len(left))
    for agent, person in people.items():
        if person["outcome"] == "left" and agent in escapes:
            same(f"event's time of {agent}", escapes[agent]["time_s"], person["escaped_s"], 1e-5)
            same(f"event's exit of {agent}", escapes[agent].get("exit"), person["exit"])
    return said


def faults_of(throng, seed, folder):
    hall = random_halls.random_hall(seed)
    name = f"hall{seed}"
    place = pathlib.Path(folder) / name
    place.mkdir()
    (place / f"{name}.blueprint.json").write_text(json.dumps(hall["blueprint"]))
    job = {
        "name": name,
        "scenario": name,
        "seed": seed,
        "drones": [],
        "capture": {"rate_hz": 1, "from_s": 0, "to_s": END_S},
        "outputs": {"annotations": ["exits", "events"]},
    }
    (place / "job.json").write_text(json.dumps(job))
    run = subprocess.run(
        [throng, "run", place / "job.json", "-o", place / "out"],
        env=os.environ | {"THRONG_SCENARIOS": str(place)},
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    if run.returncode:
        return [run.stderr]
    data = place / "out" / "dataset"
    metrics = json.loads((data / "metrics" / "run000.json").read_text())
    events = [json.loads(line) for line in (data / "events" / "run000.jsonl").read_text().splitlines()]
    rows = {}
    with open(next((data / "exits").glob("run000*.csv")), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            rows[row["exit"]] = int(row["crossed_out"]), int(row["crossed_in"])
    return differences(hall, metrics, events, rows, Trace(place / "out" / "work" / "run000" / "trace.h5"))


def main(throng, first=None, count=200 if LONG else 10):
    first = int(first) if first else int.from_bytes(os.urandom(5), "big") if LONG else FIRST_SEED
    print(f"from the seed {first} on; random_halls.py SEED prints a seed's blueprint", flush=True)
    faulty = 0
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            seeds = range(first, first + int(count))
            for seed, said in zip(seeds, pool.map(lambda seed: faults_of(throng, seed, folder), seeds)):
                faulty += bool(said)
                if said:
                    print(f"{seed}:", *said[:8], sep="\n  ", flush=True)
    print(f"{int(count) - faulty} of {count} halls agree")
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
