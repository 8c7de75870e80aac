#!/usr/bin/python3
"""Draws a frame of the demo's dataset beside its labels: docs/labels.jpg.

usage: scripts/sheets/labels_sheet.py DATASET FILE
"""
import pathlib
import sys

import matplotlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import throng  # noqa: E402

matplotlib.use("Agg")
frames = [frame for frame in throng.Dataset(sys.argv[1]) if frame.camera_id == "overview"]
throng.show_labels(frames[len(frames) // 3]).savefig(sys.argv[2], dpi=128, pil_kwargs={"quality": 90})
