"""UP-COUNT: heads as points in photographs from drones, a text per image."""

from __future__ import annotations

from pathlib import Path

from ._files import Skips, below, files_in, pairs, read_lines, wrong_layout
from ._images import RealImage, table


def read_upcount(folder: Path, skips: Skips) -> list[RealImage]:
    """Folders images/ and labels/ with lines of x and y, here or in folders (train/, val/, test/)."""
    parts = below(folder, "images", "labels")
    if not parts:
        raise wrong_layout(folder, "images/ and labels/, or folders that have them")
    images = []
    for part in parts:
        with skips.faults():
            for path, image_file in pairs(files_in(part / "labels", (".txt",), skips), part / "images", skips):
                heads: list[list[float]] = []
                with skips.faults():
                    read_lines(path, "x y", 2, lambda values: heads.append(values[:2]))
                    images.append(RealImage(image_file, "", None, table([], 4), table(heads, 2)))
    return images
