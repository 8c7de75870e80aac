"""Images of a real set with their labels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

import numpy as np
from numpy.typing import NDArray

from .._optional import require
from .._words import counted
from ..errors import DatasetError

FloatArray = NDArray[np.float64]


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

    @property
    def count(self) -> int:
        """Number of people that are labeled."""
        labels = self.points if self.points is not None else self.boxes
        return 0 if labels is None else len(labels)

    def image(self) -> NDArray[np.uint8]:
        """(height, width, 3) RGB. Needs Pillow."""
        pil = require("PIL.Image", "image()")
        try:
            with pil.open(self.path, formats=("JPEG", "PNG")) as picture:
                return np.array(picture.convert("RGB"))
        except (OSError, SyntaxError, ValueError, pil.DecompressionBombError) as error:
            raise DatasetError(f"{self.path}: found no whole image ({error})") from error


class RealSet(Sequence[RealImage]):
    """The images of a set, sorted by their paths."""

    def __init__(self, kind: str, folder: Path, images: Iterable[RealImage]) -> None:
        self.kind = kind
        self.folder = folder
        self._images = sorted(images, key=lambda image: image.path)
        if not self._images:
            raise DatasetError(f"{folder}: found no images with labels, expected a set in the layout of {kind}")

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
            return RealSet(self.kind, self.folder, self._images[index])
        return self._images[index]

    def __repr__(self) -> str:
        people = sum(image.count for image in self._images)
        counts = f"{counted(len(self), 'image')}, {counted(people, 'person', 'people')}"
        return f"RealSet({self.kind!r}, {str(self.folder)!r}: {counts})"

    @property
    def has_boxes(self) -> bool:
        return all(image.boxes is not None for image in self._images)


def table(rows: Sequence[Sequence[float]], columns: int) -> FloatArray:
    """Rows as an array, of shape (0, columns) where there are none."""
    return np.array(rows, dtype=np.float64).reshape(len(rows), columns)


def read_boxes(rows: Sequence[Sequence[float]]) -> FloatArray:
    """x0, y0, x1, y1 of rows of left, top, width and height; those without a size are dropped."""
    boxes = table(rows, 4)
    boxes = boxes[(boxes[:, 2] > 0) & (boxes[:, 3] > 0)]
    return np.concatenate((boxes[:, :2], boxes[:, :2] + boxes[:, 2:]), axis=1)
