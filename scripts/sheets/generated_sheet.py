#!/usr/bin/python3
"""Draws docs/scenarios/generated.jpg: scenarios from seeds, a row for each kind, ten seconds into a run.

usage: scripts/sheets/generated_sheet.py [SEEDS]    THRONG names another program than build/release/cli/throng.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
KINDS = ["plaza", "street", "campus", "block"]
WIDTH, HEIGHT = 400, 260  # of a panel, pixels
VIEWS = {"street": ([-92, -4, 46], -32, 0)}  # along it: start of the drone, pitch, yaw


def picture(kind, seed, folder):
    start, pitch_deg, yaw_deg = VIEWS.get(kind, ([0, -72, 62], -43, 90))
    job = {
        "scenario": {"generate": {"kind": kind, "seed": seed}},
        "seed": seed,
        "drones": [
            {
                "id": "view",
                "start": start,
                "guidance": {"policy": "hover"},
                "camera": {
                    "width": WIDTH,
                    "height": HEIGHT,
                    "hfov_deg": 74,
                    "pitch_deg": pitch_deg,
                    "yaw_deg": yaw_deg,
                },
            }
        ],
        "capture": {"rate_hz": 1, "from_s": 10, "to_s": 10},
        "outputs": {"annotations": ["coco"]},
    }
    file = folder / "job.json"
    file.write_text(json.dumps(job), encoding="utf-8")
    throng = os.environ.get("THRONG", ROOT / "build/release/cli/throng")
    subprocess.run([throng, "run", file, "-o", folder / "out"], check=True, stdout=subprocess.DEVNULL)
    return Image.open(next((folder / "out/dataset/images").rglob("*.jpg")))


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    sheet = Image.new("RGB", (seeds * WIDTH, len(KINDS) * HEIGHT))
    for row, kind in enumerate(KINDS):
        for column in range(seeds):
            with tempfile.TemporaryDirectory() as folder:
                sheet.paste(picture(kind, column + 1, Path(folder)), (column * WIDTH, row * HEIGHT))
    sheet.save(ROOT / "docs/scenarios/generated.jpg", quality=85)
    print("docs/scenarios/generated.jpg")


if __name__ == "__main__":
    main()
