"""Files of labels: lines of numbers, MATLAB's files, folders. Errors name file, line, what was found and expected."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .._optional import require
from ..errors import DatasetError

IMAGES = (".jpg", ".jpeg", ".png")


def read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError(f"{path}: found no text file that can be read ({error})") from error


def number_lines(path: Path, columns: str, at_least: int) -> list[tuple[int, list[float]]]:
    """The number of each line that is not blank, from 1, and its values. VisDrone has lines that end with a comma.

    columns names what a line holds, for errors; at_least is the smallest number of values.
    """
    found = []
    for number, line in enumerate(read_text(path).splitlines(), 1):
        text = line.strip().rstrip(",")
        if not text:
            continue
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            values = []
        if len(values) < at_least or not all(math.isfinite(value) for value in values):
            raise DatasetError(f"{path}:{number}: found {line[:80]!r}, expected {at_least} or more numbers: {columns}")
        found.append((number, values))
    return found


def frame_number(path: Path, line: int, value: float) -> int:
    if value < 1 or value != int(value):
        raise DatasetError(f"{path}:{line}: found the frame {value:g}, expected a whole number from 1")
    return int(value)


def images_in(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.suffix.lower() in IMAGES)


def find_image(folder: Path, stem: str, label: Path) -> Path:
    """The image of this name without its suffix; label names the file that asks for it."""
    for suffix in (*IMAGES, *(suffix.upper() for suffix in IMAGES)):
        path = folder / (stem + suffix)
        if path.is_file():
            return path
    raise DatasetError(f"{label}: found no image {folder / stem}.jpg (or .png), expected one for these labels")


def numbered(folder: Path) -> dict[int, Path]:
    """Images by the number at the end of their names: 0000001.jpg, img000001.jpg."""
    by_number = {}
    for path in images_in(folder):
        digits = path.stem[len(path.stem.rstrip("0123456789")) :]
        if not digits:
            raise DatasetError(f"{path}: found no number at the end of the name, expected that of the frame")
        by_number[int(digits)] = path
    return by_number


def read_heads(path: Path) -> NDArray[np.float64]:
    """(N, 2) heads in box coordinates of a GT_*.mat of ShanghaiTech, whose pixels count from 1 at their centers.

    Needs scipy.
    """
    scipy = require("scipy.io", "reading .mat files")
    try:
        content = scipy.loadmat(path)
    except Exception as error:  # scipy raises many kinds for files that are damaged
        raise DatasetError(f"{path}: found no MATLAB file of version 4 to 7.2 ({error})") from error
    if "image_info" not in content:
        names = ", ".join(sorted(name for name in content if not name.startswith("__"))) or "nothing"
        raise DatasetError(f"{path}: found {names}, expected image_info")
    try:
        points = np.asarray(content["image_info"][0, 0][0, 0][0], dtype=np.float64)
    except (IndexError, KeyError, TypeError, ValueError) as error:
        raise DatasetError(f"{path}: image_info: found no image_info{{1,1}}.location ({error})") from error
    if points.size == 0:
        return np.empty((0, 2))
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
        raise DatasetError(f"{path}: image_info: found the shape {points.shape}, expected finite (heads, 2)")
    return points - 0.5


def below(folder: Path, *names: str) -> list[Path]:
    """The folder itself or, if it lacks these entries, its folders that have them: train/, val/, sequences."""

    def fits(path: Path) -> bool:
        return all((path / name).exists() for name in names)

    if fits(folder):
        return [folder]
    return sorted(path for path in folder.iterdir() if path.is_dir() and fits(path))


def wrong_layout(folder: Path, expected: str) -> DatasetError:
    entries = sorted(path.name + ("/" if path.is_dir() else "") for path in folder.iterdir())
    found = ", ".join(entries[:6]) + (", ..." if len(entries) > 6 else "") or "an empty folder"
    return DatasetError(f"{folder}: found {found}; expected {expected}")
