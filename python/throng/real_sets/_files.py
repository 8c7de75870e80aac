"""Files of labels: lines of numbers, MATLAB's files, folders. Damaged ones are skipped and listed, with the reason."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .._optional import require
from ..errors import DatasetError

IMAGES = (".jpg", ".jpeg", ".png")
SYSTEM_FILE = "found a file of macOS or Windows, expected images and labels only"


@dataclass(frozen=True)
class Skipped:
    """A file, a folder or a line of a file that was left out, and why."""

    path: Path
    reason: str
    line: int | None = None

    def __str__(self) -> str:
        return f"{self.path}:{'' if self.line is None else f'{self.line}:'} {self.reason}"


class Fault(DatasetError):
    """A file cannot be used; the rest of the set can."""

    def __init__(self, path: Path, reason: str, line: int | None = None) -> None:
        self.skipped = Skipped(path, reason, line)
        super().__init__(str(self.skipped))


class WrongLine(Exception):
    """A line of labels is wrong; the message has neither the file nor the line's number."""


class Skips:
    """Collects files, folders and lines that are left out, each once."""

    def __init__(self) -> None:
        self._found: dict[tuple[Path, int | None], Skipped] = {}

    def add(self, skipped: Skipped) -> None:
        self._found.setdefault((skipped.path, skipped.line), skipped)

    @contextmanager
    def faults(self) -> Iterator[None]:
        """Takes a fault for something to leave out."""
        try:
            yield
        except Fault as fault:
            self.add(fault.skipped)

    def all(self) -> tuple[Skipped, ...]:
        """In the order in which they were found, but files of systems, which explain nothing, last."""
        return tuple(sorted(self._found.values(), key=lambda skipped: skipped.reason == SYSTEM_FILE))


def read_text(path: Path) -> str:
    try:
        # A wrong byte makes its line wrong, not the file.
        return path.read_text(encoding="utf-8-sig", errors="replace")
    except OSError as error:
        raise Fault(path, f"found no text file that can be read ({error})") from error


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    """Lines that are not blank, with their numbers from 1. VisDrone has some that end with a comma."""
    for number, line in enumerate(read_text(path).splitlines(), 1):
        if text := line.strip().rstrip(","):
            yield number, text


def _numbers(text: str, columns: str, at_least: int) -> list[float]:
    try:
        values = [float(part) for part in text.replace(",", " ").split()]
    except ValueError:
        values = []
    if len(values) < at_least or not all(math.isfinite(value) for value in values):
        raise WrongLine(f"found {text[:80]!r}, expected {at_least} or more numbers: {columns}")
    return values


def read_lines(path: Path, columns: str, at_least: int, use: Callable[[list[float]], None]) -> None:
    """Hands the values of each line of an image's labels to `use`; the first that is wrong is a fault of the file.

    columns names what a line holds, for errors; at_least is the smallest number of values.
    """
    for number, text in _lines(path):
        try:
            use(_numbers(text, columns, at_least))
        except WrongLine as error:
            raise Fault(path, str(error), number) from None


def read_frames(
    path: Path,
    columns: str,
    at_least: int,
    image_files: dict[int, Path],
    use: Callable[[int, list[float]], None],
    skips: Skips,
    first: int = 1,
) -> None:
    """Hands frame and values of each line of a sequence's labels to `use`; frames count from `first`.

    Wrong lines are left out, and the frames that they begin with are removed from `image_files`: their labels are not whole.
    """
    whole = len(image_files)
    incomplete: set[int] = set()
    for number, text in _lines(path):
        frame = None
        try:
            frame = _frame_number(text, first)
            if frame not in image_files and frame not in incomplete:
                raise WrongLine(f"found the frame {frame}, expected one of {whole} images")
            use(frame, _numbers(text, columns, at_least))
        except WrongLine as error:
            skips.add(Skipped(path, str(error), number))
            if frame is not None:
                incomplete.add(frame)
                image_files.pop(frame, None)


def _frame_number(text: str, first: int) -> int:
    try:
        value = float(text.split(",")[0])
    except ValueError:
        value = math.nan
    if not (first <= value < 2**53 and value == int(value)):
        raise WrongLine(f"found {text[:80]!r}, expected a frame at its beginning, a whole number from {first}")
    return int(value)


def files_in(folder: Path, suffixes: Sequence[str], skips: Skips) -> list[Path]:
    """Files with one of the suffixes, by name, without those that macOS and Windows leave in every folder."""
    files = []
    try:
        entries = sorted(folder.iterdir())
    except OSError as error:
        raise Fault(folder, f"found no folder that can be read ({error.strerror or error})") from error
    for path in entries:
        if path.name.startswith(".") or path.name.lower() in ("thumbs.db", "desktop.ini"):
            skips.add(Skipped(path, SYSTEM_FILE))
        elif path.suffix.lower() in suffixes and path.is_file():
            files.append(path)
    return files


def folders_in(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.is_dir())


def pairs(
    labels: Sequence[Path], images: Path, skips: Skips, prefix: str = "", is_whole: bool = True
) -> Iterator[tuple[Path, Path]]:
    """Each file of labels with its image, which has the same name without the prefix; those without the other are left
    out. is_whole: each image should have labels."""
    image_files: dict[str, Path] = {}
    for path in files_in(images, IMAGES, skips):
        image_files.setdefault(path.stem, path)
    for path in labels:
        stem = path.stem.removeprefix(prefix)
        image_file = image_files.pop(stem, None)
        if image_file is None:
            skips.add(Skipped(path, f"found no image {images / stem}.jpg (or .png), expected one for these labels"))
        else:
            yield path, image_file
    for stem, image_file in image_files.items() if is_whole else ():
        skips.add(Skipped(image_file, f"found no labels {prefix}{stem}, expected a file of them for each image"))


def sequences(labels: Mapping[str, Path], folder: Path, skips: Skips) -> Iterator[tuple[Path, Path]]:
    """Each file of a sequence's labels with the folder of its images; those without the other are left out."""
    for name, path in labels.items():
        if (folder / name).is_dir():
            yield path, folder / name
        else:
            skips.add(Skipped(path, f"found no folder {folder / name}, expected the sequence's images"))
    for other in folders_in(folder):
        if other.name not in labels:
            skips.add(Skipped(other, "found no labels of this sequence, expected a file of them"))


def numbered(folder: Path, skips: Skips) -> dict[int, Path]:
    """Images by the number at the end of their names: 0000001.jpg, img000001.jpg."""
    by_number = {}
    for path in files_in(folder, IMAGES, skips):
        digits = path.stem[len(path.stem.rstrip("0123456789")) :]
        if digits:
            by_number[int(digits)] = path
        else:
            skips.add(Skipped(path, "found no number at the end of the name, expected that of the frame"))
    return by_number


def read_heads(path: Path) -> NDArray[np.float64]:
    """(N, 2) heads in box coordinates of a GT_*.mat of ShanghaiTech, whose pixels count from 1 at their centers.

    Needs scipy.
    """
    scipy = require("scipy.io", "reading .mat files")
    try:
        content = scipy.loadmat(path)
    except Exception as error:  # scipy raises many kinds for files that are damaged
        raise Fault(path, f"found no MATLAB file of version 4 to 7.2 ({error})") from error
    if "image_info" not in content:
        names = ", ".join(sorted(name for name in content if not name.startswith("__"))) or "nothing"
        raise Fault(path, f"found {names}, expected image_info")
    try:
        points = np.asarray(content["image_info"][0, 0][0, 0][0], dtype=np.float64)
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise Fault(path, f"image_info: found no image_info{{1,1}}.location ({error})") from error
    if points.size == 0:
        return np.empty((0, 2))
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
        raise Fault(path, f"image_info: found the shape {points.shape}, expected finite (heads, 2)")
    return points - 0.5


def below(folder: Path, *names: str) -> list[Path]:
    """The folder itself or, if it lacks these entries, its folders that have them: train/, val/, sequences."""

    def fits(path: Path) -> bool:
        return all((path / name).exists() for name in names)

    return [folder] if fits(folder) else [path for path in folders_in(folder) if fits(path)]


def wrong_layout(folder: Path, expected: str) -> DatasetError:
    entries = sorted(path.name + ("/" if path.is_dir() else "") for path in folder.iterdir())
    found = ", ".join(entries[:6]) + (", ..." if len(entries) > 6 else "") or "an empty folder"
    return DatasetError(f"{folder}: found {found}; expected {expected}")
