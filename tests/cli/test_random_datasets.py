"""`throng validate` finds nothing in the datasets of jobs drawn at random (random_jobs.py).

usage: test_random_datasets.py THRONG [FIRST [COUNT]]    COUNT jobs from the seed FIRST on: always the same 8; with
$THRONG_LONG, 60 from a new seed, which is printed. `random_jobs.py SEED` prints the job of a seed."""
import concurrent.futures
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import random_jobs

FIRST_SEED = 20261126
LONG = bool(os.environ.get("THRONG_LONG"))


def first_seed():
    """New ones in long, so that its runs do not look for faults where there are none any more."""
    return int.from_bytes(os.urandom(5), "big") if LONG else FIRST_SEED


def result_of(throng, job, folder):
    """Findings of validate in the job's dataset, a line each; None where the job cannot be run, as a drone in a building."""
    with tempfile.TemporaryDirectory(dir=folder) as place:
        file = pathlib.Path(place) / "job.json"
        file.write_text(json.dumps(job))
        run = subprocess.run(
            [throng, "run", file, "-o", f"{place}/out"], capture_output=True, text=True, timeout=600, check=False
        )
        assert run.returncode in (0, 2), f"{job['name']}: {run.stderr}"
        if run.returncode == 2:
            return None
        done = subprocess.run(
            [throng, "validate", f"{place}/out/dataset"], capture_output=True, text=True, timeout=300, check=False
        )
    assert done.returncode in (0, 2), f"{job['name']}: {done.stderr}"
    return [] if done.returncode == 0 else (done.stdout + done.stderr).splitlines()


def main(throng, first=None, count=60 if LONG else 8):
    started = time.monotonic()
    first = first_seed() if first is None else int(first)
    print(f"from the seed {first} on; random_jobs.py SEED prints a seed's job", flush=True)
    faulty, clean, refused = {}, 0, 0
    seeds = itertools.count(first)
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            while (missing := int(count) - clean - len(faulty)) > 0:
                jobs = [random_jobs.random_job(seed) for seed in itertools.islice(seeds, missing)]
                for job, lines in zip(jobs, pool.map(lambda job: result_of(throng, job, folder), jobs)):
                    refused += lines is None
                    clean += lines == []
                    if lines:
                        faulty[job["name"]] = lines
                        print(f"{job['name']}:", *lines[:5], sep="\n  ", flush=True)
    took_s = time.monotonic() - started
    print(f"nothing found in {clean} of {clean + len(faulty)} in {took_s:.0f} s; {refused} jobs could not be run")
    assert not faulty, sorted(faulty)
    assert refused <= clean, "most jobs cannot be run"


if __name__ == "__main__":
    main(*sys.argv[1:])
