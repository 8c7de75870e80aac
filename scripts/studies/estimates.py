#!/usr/bin/env python3
"""Estimates of `throng check` beside what the jobs then take.

usage: scripts/studies/estimates.py [NAME...]

Runs jobs of many kinds, one after another, and prints for each what was estimated of CPU time, disk and memory of the
dataset, and the quotient estimate / actual. CPU time is that of all processes of the job (user and system); on an idle
machine the wall time is that by the number of cores. Ends with 1 where a quotient of disk or time is beyond 1.5.
The jobs teach the machine's speed to a cache of their own: the first estimates are those of the reference machine.
THRONG names another program than build/release/cli/throng.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
THRONG = os.environ.get("THRONG", str(ROOT / "build/release/cli/throng"))
LARGEST_QUOTIENT = 1.5


def drones(count, **camera):
    """Drones that hover beside each other and look down aslant."""
    return [
        {"id": f"d{i}", "start": [10 + 4 * i, -8, 24], "camera": {"pitch_deg": -45, "yaw_deg": 90, **camera}}
        for i in range(count)
    ]


SMALL = {"width": 640, "height": 480}
LARGE = {"width": 3840, "height": 2160}
EVERYDAY = {"scenario": "city_square/everyday"}
JOBS = {
    "one image": {**EVERYDAY, "drones": drones(1, **SMALL), "capture": {"to_s": 1, "from_s": 1}},
    "short": {**EVERYDAY, "drones": drones(1), "capture": {"rate_hz": 1, "to_s": 5}},
    "long": {**EVERYDAY, "drones": drones(1, **SMALL), "capture": {"rate_hz": 1, "to_s": 120}},
    "draft": {**EVERYDAY, "quality": "draft", "drones": drones(1), "capture": {"rate_hz": 5, "to_s": 10}},
    "high": {**EVERYDAY, "quality": "high", "drones": drones(1), "capture": {"rate_hz": 1, "to_s": 3}},
    "large images": {**EVERYDAY, "drones": drones(1, **LARGE), "capture": {"rate_hz": 1, "to_s": 5}},
    "50 people": {**EVERYDAY, "crowd": {"agents": 50}, "drones": drones(1), "capture": {"rate_hz": 1, "to_s": 20}},
    "2000 people": {
        "scenario": "concert/everyday",
        "crowd": {"agents": 2000},
        "drones": [{"id": "d", "start": [0, -30, 35], "camera": {"pitch_deg": -40, "yaw_deg": 90}}],
        "capture": {"rate_hz": 1, "to_s": 10},
    },
    "four drones": {**EVERYDAY, "drones": drones(4, **SMALL), "capture": {"rate_hz": 2, "to_s": 10}},
    "all rasters": {
        **EVERYDAY,
        "drones": drones(1),
        "capture": {"rate_hz": 1, "to_s": 5},
        "outputs": {
            "annotations": ["coco", "density", "depth", "instances", "parts", "normals", "flow", "semantic"],
        },
    },
    "previews": {
        **EVERYDAY,
        "drones": drones(1),
        "capture": {"rate_hz": 1, "to_s": 8},
        "outputs": {"previews": 100},
    },
    "formats": {
        **EVERYDAY,
        "drones": drones(1),
        "capture": {"rate_hz": 1, "to_s": 8},
        "outputs": {"annotations": ["coco"], "formats": ["yolo-detect", "mot", "voc"]},
    },
    "lens": {
        **EVERYDAY,
        "drones": drones(1, model="brown_conrady", distortion={"k1": -0.1}, **SMALL),
        "capture": {"rate_hz": 1, "to_s": 8},
    },
    "shutter": {
        **EVERYDAY,
        "drones": drones(1, sensor={"exposure_s": 0.01}, **SMALL),
        "capture": {"rate_hz": 1, "to_s": 8},
    },
    "night, rain": {
        **EVERYDAY,
        "environment": {"weather": "rain", "time_of_day": "22:00"},
        "drones": drones(1),
        "capture": {"rate_hz": 1, "to_s": 8},
    },
    "figures": {**EVERYDAY, "drones": [], "runs": 4, "capture": {"to_s": 300}},
    "figures, crowded": {
        "scenario": "concert/emergency",
        "crowd": {"agents": 2000},
        "drones": [],
        "capture": {"to_s": 120},
    },
    "stadium": {"scenario": "stadium_exit/everyday", "capture": {"rate_hz": 1, "to_s": 6}},
    "stadium, figures": {"scenario": "stadium_exit/everyday", "drones": [], "capture": {"to_s": 60}},
    "station, dusk": {
        "scenario": "station/everyday",
        "environment": {"time_of_day": "20:30"},
        "capture": {"rate_hz": 1, "to_s": 10},
    },
    "market, dusk": {
        "scenario": "market_in_park/everyday",
        "environment": {"time_of_day": "21:00"},
        "capture": {"rate_hz": 1, "to_s": 5},
    },
    "street": {
        "scenario": {"generate": {"kind": "street"}},
        "drones": [{"id": "d", "start": [0, -15, 20], "camera": {"pitch_deg": -35, "yaw_deg": 90}}],
        "capture": {"rate_hz": 1, "to_s": 8},
    },
    "large, night": {
        **EVERYDAY,
        "environment": {"time_of_day": "22:00"},
        "drones": drones(1, **LARGE),
        "capture": {"rate_hz": 1, "to_s": 4},
    },
    "many runs": {**EVERYDAY, "runs": 8, "drones": drones(1, **SMALL), "capture": {"rate_hz": 1, "to_s": 3}},
}


def folder_bytes(folder):
    """Bytes of all files, each once, whatever it is linked to."""
    files = {}
    for file in folder.rglob("*"):
        if file.is_file() and not file.is_symlink():
            status = file.stat()
            files[status.st_ino] = status.st_size
    return sum(files.values())


def child_cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(job, folder):
    """Estimate, and CPU seconds, wall seconds and bytes of the job."""
    file = folder / "job.json"
    file.write_text(json.dumps(job), encoding="utf-8")
    checked = subprocess.run([THRONG, "check", "--json", file], capture_output=True, encoding="utf-8", cwd=ROOT)
    if checked.returncode:
        raise SystemExit(checked.stderr)
    before, start = child_cpu_s(), time.monotonic()
    done = subprocess.run([THRONG, "run", file, "-o", folder / "out"], capture_output=True, encoding="utf-8", cwd=ROOT)
    if done.returncode:
        raise SystemExit(done.stderr)
    wall_s = time.monotonic() - start
    return json.loads(checked.stdout), child_cpu_s() - before, wall_s, folder_bytes(folder / "out")


def main():
    names = sys.argv[1:] or list(JOBS)
    with tempfile.TemporaryDirectory() as cache:
        os.environ["XDG_CACHE_HOME"] = cache
        beyond = measured(names)
    if beyond:
        raise SystemExit(f"beyond a factor of {LARGEST_QUOTIENT}: {', '.join(beyond)}")


def measured(names):
    """Prints the table of these jobs; the names of those beyond the factor."""
    beyond = []
    print(f"{'job':18} {'CPU s':>16} {'quotient':>8} {'wall s':>7} {'MB':>16} {'quotient':>8}")
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            answer, cpu_s, wall_s, size = measure(JOBS[name], pathlib.Path(folder))
        estimate = answer["estimate"]
        quotients = estimate["cpu_s"] / cpu_s, estimate["disk_bytes"] / size
        print(
            f"{name:18} {estimate['cpu_s']:7.1f} {cpu_s:8.1f} {quotients[0]:8.2f} {wall_s:7.1f} "
            f"{estimate['disk_bytes'] / 1e6:7.2f} {size / 1e6:8.2f} {quotients[1]:8.2f}",
            flush=True,
        )
        if not all(1 / LARGEST_QUOTIENT <= quotient <= LARGEST_QUOTIENT for quotient in quotients):
            beyond.append(name)
    return beyond


main()
