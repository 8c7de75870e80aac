"""Images of a real set with their labels."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from .._optional import available, require
from .._words import counted
from ..errors import DatasetError
from ._files import Fault, Skipped, Skips, files_in, pairs, read_heads

FloatArray = NDArray[np.float64]
_END_OF_JPEG, _END_OF_PNG, _TAIL_BYTES = b"\xff\xd9", b"IEND", 1024
_FIRST_REASONS = 3


@dataclass(frozen=True, eq=False)
class RealImage:
    """A photograph. All labels are in box coordinates: the corner of the image is (0, 0), pixel i covers [i, i + 1)."""

    path: Path
    sequence: str
    """The video it belongs to; empty for single photographs."""
    boxes: FloatArray | None
    """(N, 4) x0, y0, x1, y1 of people, px; None where the set has heads only."""
    ignored: FloatArray
    """(M, 4) regions in which nothing is to be scored."""
    points: FloatArray | None
    """(N, 2) heads, px; None where the set has boxes only."""
    hidden: FloatArray | None = None
    """(N,) share of each person in boxes that others hide, as far as the set says; None where it does not."""

    @property
    def count(self) -> int:
        """Number of people that are labeled."""
        labels = self.points if self.points is not None else self.boxes
        return 0 if labels is None else len(labels)

    def image(self) -> NDArray[np.uint8]:
        """(height, width, 3) RGB. Needs Pillow."""
        pil = require("PIL.Image", "image()")
        with _opened(self.path, pil) as decoded:
            return np.array(decoded.convert("RGB"))

    def check(self) -> None:
        """DatasetError for an image that lacks its beginning or end, where Pillow is installed. Sets are large: what is
        between is only decoded by image()."""
        pil = available("PIL.Image")
        if pil is not None:
            with _opened(self.path, pil) as decoded, open(self.path, "rb") as file:
                file.seek(max(0, file.seek(0, os.SEEK_END) - _TAIL_BYTES))
                if (_END_OF_PNG if decoded.format == "PNG" else _END_OF_JPEG) not in file.read():
                    decoded.load()  # some have other data behind the image


@contextmanager
def _opened(path: Path, pil: Any) -> Iterator[Any]:
    try:
        with pil.open(path, formats=("JPEG", "PNG")) as decoded:
            yield decoded
    except Exception as error:  # Pillow raises many kinds for files that are damaged
        raise Fault(path, f"found no whole image ({error})") from error


class RealSet(Sequence[RealImage]):
    """The images of a set, sorted by their paths."""

    def __init__(self, kind: str, folder: Path, images: Iterable[RealImage], skipped: Sequence[Skipped] = ()) -> None:
        self.kind = kind
        self.folder = folder
        self.skipped = tuple(skipped)
        """Files, folders and lines that were left out, each with its path, its line or None, and the reason."""
        self._images = sorted(images, key=lambda image: image.path)
        if not self._images:
            reasons = "".join(f"\n  {each}" for each in self.skipped[:_FIRST_REASONS])
            more = len(self.skipped) - _FIRST_REASONS
            raise DatasetError(
                f"{folder}: found no images with labels, expected a set in the layout of {kind}"
                f"{reasons}{f'{chr(10)}  and {more} more' if more > 0 else ''}"
            )

    def __len__(self) -> int:
        return len(self._images)

    @overload
    def __getitem__(self, index: int) -> RealImage:
        ...

    @overload
    def __getitem__(self, index: slice) -> RealSet:
        ...

    def __getitem__(self, index: int | slice) -> RealImage | RealSet:
        if isinstance(index, slice):
            return RealSet(self.kind, self.folder, self._images[index], self.skipped)
        return self._images[index]

    def __repr__(self) -> str:
        people = sum(image.count for image in self._images)
        counts = f"{counted(len(self), 'image')}, {counted(people, 'person', 'people')}"
        return f"RealSet({self.kind!r}, {str(self.folder)!r}: {counts})"

    @property
    def has_boxes(self) -> bool:
        return all(image.boxes is not None for image in self._images)


def read_mats(images: Path, labels: Path, skips: Skips, sequence_of: Callable[[str], str]) -> list[RealImage]:
    """Images with heads in GT_*.mat; sequence_of gives the sequence of an image's name without its suffix."""
    found = []
    with skips.faults():
        mats = [path for path in files_in(labels, (".mat",), skips) if path.stem.startswith("GT_")]
        for path, image_file in pairs(mats, images, skips, "GT_"):
            with skips.faults():
                found.append(RealImage(image_file, sequence_of(image_file.stem), None, table([], 4), read_heads(path)))
    return found


def table(rows: Sequence[Sequence[float]], columns: int) -> FloatArray:
    """Rows as an array, of shape (0, columns) where there are none."""
    return np.array(rows, dtype=np.float64).reshape(len(rows), columns)


def read_boxes(rows: Sequence[Sequence[float]]) -> FloatArray:
    """x0, y0, x1, y1 of rows of left, top, width and height; those without a size are dropped."""
    boxes = table(rows, 4)
    boxes = boxes[(boxes[:, 2] > 0) & (boxes[:, 3] > 0)]
    return np.concatenate((boxes[:, :2], boxes[:, :2] + boxes[:, 2:]), axis=1)
