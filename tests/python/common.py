"""Shared by the tests of the Python package: the package's path, the throng program and small datasets made by it.

usage of each test: test_X.py THRONG [DATA]    DATA is a folder that keeps the datasets between tests.
"""
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests" / "cli")]
from sound_jobs import GEOMETRY  # noqa: E402

os.environ.setdefault("MPLBACKEND", "Agg")

THRONG = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else None
_DATA = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
_own = None

_CAMERA = {"width": 320, "height": 200}
# Two runs, so that there are splits; a camera of each lens, one of which ends within the image. Many people are behind
# them all.
JOB = {
    "name": "reader test",
    "scenario": "city_square/nearest_exit",
    "seed": 5,
    "runs": 2,
    "crowd": {"agents": 60},
    "quality": "draft",
    "capture": {"rate_hz": 1, "from_s": 8, "to_s": 10},
    "drones": [
        {"id": "d1", "start": [8, -3, 15], "camera": {**_CAMERA, "hfov_deg": 62, "yaw_deg": 90, "pitch_deg": -38}},
        {
            "id": "d2",
            "start": [4, 8, 15],
            "camera": {
                **_CAMERA,
                "fx_px": 200,
                "yaw_deg": 180,
                "pitch_deg": -42,
                "model": "brown_conrady",
                "distortion": {"k1": -0.28, "k2": 0.08, "p1": 0.0003, "p2": -0.0002, "k3": 0.01, "k4": 0.02},
            },
        },
        {
            "id": "d3",
            "start": [0, 0, 20],
            "camera": {
                **_CAMERA,
                "fx_px": 100,
                "yaw_deg": 150,
                "pitch_deg": -45,
                "model": "fisheye",
                "distortion": {"k1": -0.02, "k2": 0.003},
            },
        },
    ],
    "outputs": {
        "annotations": GEOMETRY,
        "previews": 1,
        "fields": {"cells_m": [1, 3.1]},
        "counts": {
            "zones": [{"id": "corner", "corners": [[0, 0], [30, 0], [0, 30]]}],
            "lines": [{"id": "middle", "start": [0, -30], "end": [0, 30]}],
        },
        "splits": {"train": 0.5, "val": 0.5},
    },
}


def has(*modules):
    """Whether they are installed; in CI they have to be (scripts/packages.txt)."""
    missing = [module for module in modules if not importlib.util.find_spec(module)]
    assert not missing or not os.environ.get("CI"), f"{missing} are missing"
    return not missing


def folder():
    global _own
    if _DATA is not None:
        _DATA.mkdir(parents=True, exist_ok=True)
        return _DATA
    if _own is None:
        _own = tempfile.TemporaryDirectory()
    return pathlib.Path(_own.name)


def run_folder():
    """The folder of a finished job: dataset/ and work/. Made once."""
    out = folder() / "job"
    stamp = folder() / "job.made"
    wanted = json.dumps([JOB, THRONG.stat().st_mtime_ns, os.environ.get("THRONG_PEOPLE", "")])
    if not stamp.exists() or stamp.read_text() != wanted:
        shutil.rmtree(out, ignore_errors=True)
        job = folder() / "job.json"
        job.write_text(json.dumps(JOB))
        subprocess.run([THRONG, "run", job, "-o", out], check=True, capture_output=True, timeout=300)
        stamp.write_text(wanted)
    return out


def dataset_folder():
    return run_folder() / "dataset"


def main():
    # unittest must not take the arguments for names of tests.
    unittest.main(argv=[sys.argv[0], "-v"] if os.environ.get("VERBOSE") else [sys.argv[0]])
