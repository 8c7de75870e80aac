"""ShanghaiTech, parts A and B: heads in MATLAB's files."""

from __future__ import annotations

from pathlib import Path

from ._files import Skips, files_in, folders_in, wrong_layout
from ._images import RealImage, read_mats

_LABELS = ("ground-truth", "ground_truth")


def read_shanghaitech(folder: Path, skips: Skips) -> list[RealImage]:
    """A folder with images/ and ground-truth/GT_*.mat (or ground_truth/), or one with such folders (train_data/). Needs
    scipy."""
    parts = [
        (part / "images", part / name)
        for part in [folder, *folders_in(folder)]
        for name in _LABELS
        if (part / name).is_dir() and (part / "images").is_dir()
    ]
    if not parts:
        raise wrong_layout(folder, "images/ and ground-truth/GT_*.mat, or folders that have them (train_data/)")
    return [image for images, labels in parts for image in read_mats(images, labels, skips, lambda stem: "")]
