"""`throng validate` finds nothing in sound datasets: those of sound_jobs.py, in all places, lights, lenses and views.

usage: test_sound_datasets.py THRONG [NAME...]    the jobs of these names instead of FEW; with $THRONG_LONG, all"""
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import sound_jobs

# Different places, lights, lenses, motions and views.
FEW = [
    "concert",
    "street emergency in smoke",
    "station emergency",
    "fisheye",
    "night",
    "rolling shutter",
    "people struck",
    "generated block",
]


def findings_of(throng, job, folder):
    """Findings of validate in the job's dataset; empty where it finds nothing."""
    folder.mkdir()
    (folder / "job.json").write_text(json.dumps(job))
    run = subprocess.run(
        [throng, "run", folder / "job.json", "-o", folder / "out"],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert run.returncode == 0, f"{job['name']}: {run.stderr}"
    done = subprocess.run(
        [throng, "validate", folder / "out" / "dataset"], capture_output=True, text=True, timeout=300, check=False
    )
    shutil.rmtree(folder)
    assert done.returncode in (0, 2), done.stderr
    return [] if done.returncode == 0 else (done.stdout + done.stderr).splitlines()


def main(throng, *names):
    started = time.monotonic()
    chosen = names or (sound_jobs.JOBS if os.environ.get("THRONG_LONG") else FEW)
    jobs = [sound_jobs.JOBS[name] for name in chosen]
    faulty = []
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            places = [pathlib.Path(folder) / str(i) for i in range(len(jobs))]
            for job, lines in zip(jobs, pool.map(findings_of, [throng] * len(jobs), jobs, places)):
                if lines:
                    faulty.append(job["name"])
                    print(f"{job['name']}:", *lines[:5], sep="\n  ", flush=True)
    print(f"nothing found in {len(jobs) - len(faulty)} of {len(jobs)} in {time.monotonic() - started:.0f} s")
    assert not faulty, faulty


if __name__ == "__main__":
    main(*sys.argv[1:])
