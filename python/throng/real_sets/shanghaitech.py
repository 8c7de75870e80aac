"""ShanghaiTech, parts A and B: heads in MATLAB's files."""

from __future__ import annotations

from pathlib import Path

from ._files import read_heads, find_image, wrong_layout
from ._images import RealImage, RealSet, table

_LABELS = ("ground-truth", "ground_truth")


def read_shanghaitech(folder: Path) -> RealSet:
    """A folder with images/ and ground-truth/GT_*.mat (or ground_truth/), or one with such folders (train_data/). Needs
    scipy."""
    images = []
    for part in [folder, *sorted(path for path in folder.iterdir() if path.is_dir())]:
        labels = next((part / name for name in _LABELS if (part / name).is_dir()), None)
        if labels is None or not (part / "images").is_dir():
            continue
        for path in sorted(labels.glob("GT_*.mat")):
            picture = find_image(part / "images", path.stem.removeprefix("GT_"), path)
            images.append(RealImage(picture, "", None, table([], 4), read_heads(path)))
    if not images:
        raise wrong_layout(folder, "images/ and ground-truth/GT_*.mat, or folders that have them (train_data/)")
    return RealSet("shanghaitech", folder, images)
