#!/usr/bin/python3
"""Draws docs/presets/NAME.jpg: images of the first runs of each preset, one of each camera, twelve at most, with their boxes.

Usage: scripts/sheets/preset_sheets.py THRONG [NAME...]

The presets run with fewer runs and one time each; their first runs are those of the whole preset. Needs Pillow.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
PRESETS = ROOT / "scenarios/presets"
COLUMNS = 3
MAX_IMAGES = 12
WIDTH, HEIGHT = 480, 270


def excerpt(job):
    """The preset's first runs, at one time in the middle of its capture."""
    start_s, end_s = job["capture"]["from_s"], job["capture"]["to_s"]
    time_s = (start_s + end_s) / 2
    return {
        **job,
        "runs": min(job["runs"], MAX_IMAGES // len(job["drones"])),
        "capture": {"rate_hz": 1, "from_s": time_s, "to_s": time_s + 0.5},
    }


def sheet(images):
    rows = math.ceil(len(images) / COLUMNS)
    page = Image.new("RGB", (COLUMNS * WIDTH, rows * HEIGHT))
    for i, file in enumerate(images):
        with Image.open(file) as image:
            page.paste(image.resize((WIDTH, HEIGHT), Image.LANCZOS), (i % COLUMNS * WIDTH, i // COLUMNS * HEIGHT))
    return page


def main():
    throng, names = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    (ROOT / "docs/presets").mkdir(exist_ok=True)
    for file in sorted(PRESETS.glob("*.job.json")):
        name = file.name.removesuffix(".job.json")
        if names and name not in names:
            continue
        with tempfile.TemporaryDirectory() as folder:
            job = pathlib.Path(folder) / "job.json"
            job.write_text(json.dumps(excerpt(json.loads(file.read_text(encoding="utf-8")))), encoding="utf-8")
            subprocess.run([throng, "run", job, "-o", pathlib.Path(folder) / "out"], check=True)
            images = sorted((pathlib.Path(folder) / "out/dataset/previews").rglob("*.jpg"))
            sheet(images).save(ROOT / f"docs/presets/{name}.jpg", quality=82)
        print(f"docs/presets/{name}.jpg: {len(images)} images")


if __name__ == "__main__":
    main()
