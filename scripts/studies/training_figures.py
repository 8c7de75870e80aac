#!/usr/bin/python3
"""The figures of docs/training.md: estimates of the presets, and scores of transfer between places.

usage: scripts/studies/training_figures.py [--presets | --check]    THRONG, or build/release/cli/throng

Runs the page's command with one thread and writes its table into the page. --presets: only the estimates. --check: only the
detectors of 16 images; changes nothing, and fails where the page has other figures. Needs torch.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from doc_blocks import read_blocks, replace_passage  # noqa: E402

PAGE = ROOT / "docs/training.md"
THRONG = os.environ.get("THRONG", str(ROOT / "build/release/cli/throng"))
PRESETS = ("detection", "counting", "tracking", "segmentation", "keypoints", "evacuation_video")
TOLERANCE = 0.02
COMMAND = "python3 -m throng.train scenarios/transfer.job.json"


def run(*command):
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "python"), "THRONG_PROGRAM": THRONG}
    done = subprocess.run(
        [str(word) for word in command], stdout=subprocess.PIPE, encoding="utf-8", cwd=ROOT, env=environment
    )
    if done.returncode:
        raise SystemExit(f"{command} failed")
    return done.stdout


def write_presets():
    """The estimate of each preset, in its row's last cell, on two cores whatever this machine has."""
    text = PAGE.read_text(encoding="utf-8")
    for preset in PRESETS:
        answer = json.loads(run(THRONG, "check", "--json", f"scenarios/presets/{preset}.job.json"))
        minutes = max(1, round(answer["estimate"]["cpu_s"] / 2 / 60))
        text, count = re.subn(rf"(\| `{preset}` \|.*\| )[^|]+( \|\n)", rf"\g<1>{minutes} min\g<2>", text)
        assert count == 1, preset
    PAGE.write_text(text, encoding="utf-8")


def measure(folder, *more):
    """Lines of the table that the page's command prints, with other options after its own."""
    page = PAGE.read_text(encoding="utf-8")
    block = next(block for _, _, block in read_blocks(page) if COMMAND in block)
    words = block[block.index(COMMAND) :].split("\n\n")[0].replace("\\\n", " ").split()
    words[words.index("-o") + 1] = folder
    return run("/usr/bin/python3", *words[1:], *more).strip().splitlines()


def check(folder):
    """Figures may differ by TOLERANCE: processors round sums of a training in different orders."""
    key = lambda row: (row.split("|")[1], row.count("|"))  # noqa: E731  counters have other columns
    rows = {key(row): row for row in PAGE.read_text(encoding="utf-8").splitlines() if row.startswith("| ")}
    measured = [line for line in measure(folder, "--experiment", "frames", "--task", "detect") if "frames_" in line]
    assert measured
    for line in measured:
        was = rows.get(key(line), "")
        pairs = list(zip(re.findall(r"\d+\.\d+", was), re.findall(r"\d+\.\d+", line)))
        if len(pairs) < 5 or any(abs(float(a) - float(b)) > TOLERANCE for a, b in pairs):
            raise SystemExit(
                f"docs/training.md has the row\n{was}\nmeasured is (without --check it is written)\n{line}"
            )


def main():
    with tempfile.TemporaryDirectory() as folder:
        if "--check" in sys.argv[1:]:
            return check(folder)
        write_presets()
        if "--presets" not in sys.argv[1:]:
            lines = measure(folder)
            PAGE.write_text(replace_passage(PAGE.read_text(encoding="utf-8"), "scores", lines), encoding="utf-8")


main()
