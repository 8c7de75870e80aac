"""Images with people, of throng's datasets and of real sets alike, to train on and to score with."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..dataset import Dataset, merge
from ..errors import DatasetError
from ..real_sets import RealImage, RealSet

FloatArray = NDArray[np.float64]
MIN_VISIBILITY = 0.25
MIN_HEIGHT_PX = 6.0
"""People of whom less can be seen, or who are smaller, are neither trained on nor scored."""


@dataclass(frozen=True, eq=False)
class Picture:
    """Labels are in box coordinates: the corner of the image is (0, 0), pixel i covers [i, i + 1)."""

    name: str
    group: str
    """The scenario, or the video."""
    read: Callable[[], NDArray[np.uint8]]
    """Gives the image, (rows, columns, 3) RGB."""
    boxes: FloatArray | None
    """(N, 4) x0, y0, x1, y1; None where there are heads only."""
    ignored: FloatArray
    """(M, 4) regions in which nothing is scored."""
    heads: FloatArray
    """(N, 2); the middles of the boxes' upper sides where a set has boxes only."""

    @property
    def count(self) -> int:
        return len(self.heads)


def of_datasets(datasets: Sequence[Dataset], *, split: str = "all", boxes: str = "visible") -> list[Picture]:
    """The images of a split of the datasets; "all" takes every image. boxes: "visible" or "whole" bodies."""
    dataset = datasets[0] if len(datasets) == 1 else merge(datasets)
    if split != "all":
        splits = dataset.splits
        if split not in splits:
            names = ", ".join(("all", *splits))
            raise DatasetError(f"--split: found {split!r}, expected one of {names}")
        dataset = splits[split]
    visible = dataset.filter_annotations(min_visibility=MIN_VISIBILITY, min_height_px=MIN_HEIGHT_PX)
    return [_of_frame(frame, kept, boxes) for frame, kept in zip(dataset, visible)]


def _of_frame(frame: Any, kept: Any, boxes: str) -> Picture:
    chosen = set(kept.people.track_ids.tolist())
    others = frame.people.select([track not in chosen for track in frame.people.track_ids.tolist()])
    both = [people.boxes_xyxy if boxes == "visible" else _whole(people) for people in (kept.people, others)]
    heads = kept.people.heads
    with np.errstate(invalid="ignore"):
        inside = (heads >= 0).all(axis=1) & (heads[:, 0] < frame.width) & (heads[:, 1] < frame.height)
    return Picture(str(frame.id), str(frame.scenario), frame.image, both[0], both[1], heads[inside])


def _whole(people: Any) -> FloatArray:
    boxes = people.boxes_amodal
    corners: FloatArray = np.concatenate((boxes[:, :2], boxes[:, :2] + boxes[:, 2:]), axis=1)
    return corners


def of_real_set(images: RealSet) -> list[Picture]:
    return [_of_photograph(image) for image in images]


def _of_photograph(image: RealImage) -> Picture:
    heads = image.points
    if heads is None:
        boxes = np.empty((0, 4)) if image.boxes is None else image.boxes
        heads = np.stack(((boxes[:, 0] + boxes[:, 2]) / 2, boxes[:, 1]), axis=1)
    return Picture(str(image.path), image.sequence, image.image, image.boxes, image.ignored, heads)


def spread(pictures: Sequence[Picture], count: int, seed: int) -> list[Picture]:
    """So many of the pictures, at random; smaller choices of the same seed are parts of larger ones."""
    order = np.random.default_rng(seed).permutation(len(pictures))
    return [pictures[i] for i in sorted(order[:count].tolist())]


def share(pictures: Sequence[Picture], percent: float, seed: int) -> list[Picture]:
    return spread(pictures, max(1, math.ceil(len(pictures) * percent / 100)), seed)


class Cache:
    """Decoded images, so many as fit into `size`, of which each is used for many tiles."""

    def __init__(self, size: int = 160) -> None:
        self.read: Callable[[Picture], NDArray[np.uint8]] = lru_cache(size)(_read)


def _read(picture: Picture) -> NDArray[np.uint8]:
    return picture.read()
