"""NWPU-Crowd: heads as points and boxes in JSON."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from ._files import Fault, Skipped, Skips, below, files_in, pairs, read_text, wrong_layout
from ._images import FloatArray, RealImage, table


def read_nwpu(folder: Path, skips: Skips) -> list[RealImage]:
    """Folders images/ and jsons/. If there is val.txt, only its images are taken: those that the set's authors test on.

    The images of test.txt have no labels. The boxes of the set are heads, so they are not used as people's.
    """
    parts = below(folder, "images", "jsons")
    if not parts:
        raise wrong_layout(folder, "images/ and jsons/")
    images = []
    for part in parts:
        with skips.faults():
            labels, is_chosen = files_in(part / "jsons", (".json",), skips), (part / "val.txt").is_file()
            if is_chosen:
                labels = _chosen(part / "val.txt", labels, skips)
            for path, image_file in pairs(labels, part / "images", skips, is_whole=not is_chosen):
                with skips.faults():
                    images.append(RealImage(image_file, "", None, table([], 4), _points(path)))
    return images


def _chosen(listed: Path, labels: list[Path], skips: Skips) -> list[Path]:
    by_name = {path.stem: path for path in labels}
    files = []
    for number, line in enumerate(read_text(listed).splitlines(), 1):
        if not line.strip():
            continue
        path = by_name.get(line.split()[0])
        if path is None:
            skips.add(Skipped(listed, f"found {line[:80]!r}, expected the name of a file in jsons/", number))
        else:
            files.append(path)
    return files


def _points(path: Path) -> FloatArray:
    try:
        content: Any = json.loads(read_text(path))
    except (RecursionError, ValueError) as error:
        if isinstance(error, Fault):
            raise
        raise Fault(path, f"found no JSON ({error})") from error
    points = content.get("points") if isinstance(content, dict) else None
    if not isinstance(points, list):
        raise Fault(path, f"/points: found {type(points).__name__}, expected a list of [x, y]")
    for i, point in enumerate(points):
        is_pair = isinstance(point, list) and len(point) == 2
        if not is_pair or not all(isinstance(value, (int, float)) and np.isfinite(value) for value in point):
            raise Fault(path, f"/points/{i}: found {str(point)[:80]}, expected [x, y]")
    human_num = content.get("human_num", len(points))
    if human_num != len(points):
        raise Fault(path, f"/human_num: found {human_num}, expected {len(points)}, the number of points")
    return table(points, 2)
