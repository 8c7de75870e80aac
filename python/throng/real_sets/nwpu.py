"""NWPU-Crowd: heads as points and boxes in JSON."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import DatasetError
from ._files import below, find_image, read_text, wrong_layout
from ._images import FloatArray, RealImage, RealSet, table


def read_nwpu(folder: Path) -> RealSet:
    """Folders images/ and jsons/. If there is val.txt, only its images are taken: those that the set's authors test on.

    The images of test.txt have no labels. The boxes of the set are heads, so they are not used as people's.
    """
    parts = below(folder, "images", "jsons")
    if not parts:
        raise wrong_layout(folder, "images/ and jsons/")
    images = []
    for part in parts:
        for path in _label_files(part):
            picture = find_image(part / "images", path.stem, path)
            images.append(RealImage(picture, "", None, table([], 4), _points(path)))
    return RealSet("nwpu", folder, images)


def _label_files(folder: Path) -> list[Path]:
    chosen = folder / "val.txt"
    if not chosen.is_file():
        return sorted((folder / "jsons").glob("*.json"))
    files = []
    for number, line in enumerate(read_text(chosen).splitlines(), 1):
        if not line.strip():
            continue
        path = folder / "jsons" / f"{line.split()[0]}.json"
        if not path.is_file():
            raise DatasetError(f"{chosen}:{number}: found {line[:80]!r}, expected the name of a file in jsons/")
        files.append(path)
    return files


def _points(path: Path) -> FloatArray:
    try:
        content: Any = json.loads(read_text(path))
    except ValueError as error:
        if isinstance(error, DatasetError):
            raise
        raise DatasetError(f"{path}: found no JSON ({error})") from error
    points = content.get("points") if isinstance(content, dict) else None
    if not isinstance(points, list):
        raise DatasetError(f"{path}: /points: found {type(points).__name__}, expected a list of [x, y]")
    for i, point in enumerate(points):
        is_pair = isinstance(point, list) and len(point) == 2
        if not is_pair or not all(isinstance(value, (int, float)) and np.isfinite(value) for value in point):
            raise DatasetError(f"{path}: /points/{i}: found {str(point)[:80]}, expected [x, y]")
    human_num = content.get("human_num", len(points))
    if human_num != len(points):
        raise DatasetError(f"{path}: /human_num: found {human_num}, expected {len(points)}, the number of points")
    return table(points, 2)
