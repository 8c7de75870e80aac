"""Runs damages on copies of a dataset, and `throng validate` on each."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

from . import KINDS
from .dataset import Dataset


def run(throng, dataset, folder, name):
    """Result of validating the damaged copy: (exit code, lines)."""
    d = Dataset(dataset, pathlib.Path(folder) / "damaged")
    try:
        KINDS[name](d)
        d.finish()
        done = subprocess.run([throng, "validate", d.root], capture_output=True, text=True, timeout=300, check=False)
        return done.returncode, done.stdout.splitlines() + done.stderr.splitlines()
    finally:
        shutil.rmtree(d.root)


def main(throng, dataset, *names):
    found = total = 0
    started = time.monotonic()
    for name in names or KINDS:
        with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
            try:
                code, lines = run(throng, dataset, folder, name)
            except (AssertionError, StopIteration, FileNotFoundError) as error:
                print(f"{name:62} not possible here: {error or type(error).__name__}")
                continue
        rules = sorted({line[line.rindex("[") + 1 : -1] for line in lines if line.endswith("]")})
        assert code in (0, 2), (code, lines[-3:])
        assert rules != ["manifest"], lines[:3]
        found += bool(rules)
        total += 1
        print(f"{name:62} {'found by ' + ', '.join(rules) if rules else 'NOT FOUND'}", flush=True)
    print(f"found {found} of {total} in {time.monotonic() - started:.0f} s")
    return found, total
