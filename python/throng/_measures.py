"""Figures of images of people: sizes of boxes, counts, overlap, light, and the view that the boxes tell of."""

from __future__ import annotations

import dataclasses
import logging
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._view_estimate import estimate_view
from ._words import counted
from .dataset import Dataset
from .errors import DatasetError
from .frame import Frame
from .real_sets import RealImage, RealSet

FloatArray = NDArray[np.float64]
Item = tuple[Callable[[], NDArray[np.uint8]], FloatArray | None, int, FloatArray | None]

_LOG = logging.getLogger("throng")
_SAMPLED_COLUMNS = 200
# Rec. 709.
_LUMA = np.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True, eq=False)
class Measures:
    """One value per image; NaN where an image does not tell."""

    width: FloatArray
    height: FloatArray
    count: FloatArray
    """People with labels."""
    box_height: FloatArray
    """Median of the boxes' heights by the width of the image."""
    box_spread: FloatArray
    """Logarithm of the ninth by the first decile of the boxes' heights: small from above, large along the ground."""
    aspect: FloatArray
    """Median of the boxes' widths by their heights."""
    overlap: FloatArray
    """Mean share of a box that one other box in front of it covers."""
    hidden: FloatArray
    """Mean share of people that others hide, in VisDrone's levels, where a set says it."""
    brightness: FloatArray
    """Mean luma, 0 to 1."""
    contrast: FloatArray
    """Standard deviation of the luma."""
    saturation: FloatArray
    """Mean of (max - min) / max of a pixel's channels."""
    pitch_deg: FloatArray
    camera_height_m: FloatArray
    heights: FloatArray
    """Of every box of all images, by the width of its image."""
    whole_heights: FloatArray
    """The same of boxes that nothing covers and no border cuts, as far as a set says it."""

    def __len__(self) -> int:
        return len(self.count)

    def known(self, name: str) -> FloatArray:
        """The values of a column that are known."""
        values: FloatArray = getattr(self, name)
        finite: FloatArray = values[np.isfinite(values)]
        return finite

    @property
    def smallest(self) -> float:
        """Height from which on people have labels, by the width of the image: of the hundredth part of whole people; 0 without boxes."""
        heights = self.whole_heights if len(self.whole_heights) else self.heights
        return float(np.quantile(heights, 0.01)) if len(heights) else 0.0

    def rows(self, indices: Sequence[int]) -> Measures:
        """Of these images alone; without the boxes' heights, which are not kept by image."""
        columns = {name: getattr(self, name)[list(indices)] for name in COLUMNS}
        return Measures(**columns, heights=np.empty(0), whole_heights=np.empty(0))


COLUMNS = tuple(field.name for field in dataclasses.fields(Measures) if not field.name.endswith("heights"))


def covered_shares(boxes: FloatArray) -> FloatArray:
    """(N,) of each box the largest share that one other box covers whose lower edge is further down, as of somebody in front."""
    if len(boxes) < 2:
        return np.zeros(len(boxes))
    shares = np.zeros(len(boxes))
    areas = (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    for i, box in enumerate(boxes):
        front = boxes[boxes[:, 3] > box[3]]
        sides = np.minimum(front[:, 2:], box[2:]) - np.maximum(front[:, :2], box[:2])
        if len(front) and areas[i] > 0:
            shares[i] = np.maximum(sides, 0).prod(axis=1).max() / areas[i]
    return shares


def _light(pixels: NDArray[np.uint8]) -> dict[str, float]:
    step = max(1, pixels.shape[1] // _SAMPLED_COLUMNS)
    sampled = pixels[::step, ::step].astype(np.float64) / 255
    luma = sampled @ _LUMA
    most = sampled.max(axis=2)
    saturation = np.where(most > 0, (most - sampled.min(axis=2)) / np.maximum(most, 1e-9), 0)
    return {"brightness": luma.mean(), "contrast": luma.std(), "saturation": saturation.mean()}


def _people(boxes: FloatArray | None, width: int, height: int, hfov_deg: float) -> dict[str, float]:
    names = ("box_height", "box_spread", "aspect", "overlap", "pitch_deg", "camera_height_m")
    row = dict.fromkeys(names, math.nan)
    if boxes is None or not len(boxes):
        return row
    sides = boxes[:, 2:] - boxes[:, :2]
    covered = covered_shares(boxes)
    row["box_height"] = float(np.median(sides[:, 1])) / width
    if len(boxes) > 1:
        low, high = np.quantile(sides[:, 1], (0.1, 0.9))
        row["box_spread"] = math.log(high / low)
    row["aspect"] = float(np.median(sides[:, 0] / sides[:, 1]))
    row["overlap"] = float(covered.mean())
    row["pitch_deg"], row["camera_height_m"] = estimate_view(boxes, covered, width, height, hfov_deg)
    return row


def _measured(items: Iterable[Item], what: str, hfov_deg: float) -> Measures:
    """Of each item: its pixels, boxes, number of people and their hidden shares. Images that cannot be decoded are left out."""
    rows: list[dict[str, float]] = []
    heights: list[FloatArray] = []
    whole_heights: list[FloatArray] = []
    faults: list[DatasetError] = []
    for read, boxes, count, hidden in items:
        try:
            pixels = read()
        except DatasetError as error:
            faults.append(error)
            continue
        height, width = pixels.shape[:2]
        row = {"width": float(width), "height": float(height), "count": float(count)}
        row["hidden"] = float(hidden.mean()) if hidden is not None and len(hidden) else math.nan
        rows.append({**row, **_light(pixels), **_people(boxes, width, height, hfov_deg)})
        if boxes is not None:
            heights.append((boxes[:, 3] - boxes[:, 1]) / width)
            is_whole = (boxes[:, 1] > 1) & (boxes[:, 3] < height - 1)
            is_whole &= covered_shares(boxes) == 0 if hidden is None else hidden == 0
            whole_heights.append(heights[-1][is_whole])
    if not rows:
        raise DatasetError(
            f"{what}: found no image that can be measured" + (f", the first: {faults[0]}" if faults else "")
        )
    if faults:
        _LOG.warning("%s: left out %s, the first: %s", what, counted(len(faults), "damaged image"), faults[0])
    columns = {name: np.array([row[name] for row in rows]) for name in COLUMNS}
    all_heights, whole = (np.concatenate(each or [np.empty(0)]) for each in (heights, whole_heights))
    return Measures(**columns, heights=all_heights, whole_heights=whole)


def chosen_indices(count: int, limit: int, seed: int) -> list[int]:
    """At most limit of them, sampled by the seed, in their order."""
    if count <= limit:
        return list(range(count))
    return sorted(np.random.default_rng(seed).choice(count, size=limit, replace=False).tolist())


def measure_real(images: RealSet, *, hfov_deg: float, limit: int, seed: int) -> Measures:
    """Figures of at most limit images of a real set, sampled by the seed."""
    chosen: list[RealImage] = [images[i] for i in chosen_indices(len(images), limit, seed)]
    items = ((image.image, image.boxes, image.count, image.hidden) for image in chosen)
    return _measured(items, str(images.folder), hfov_deg)


def measure_dataset(
    dataset: Dataset, *, hfov_deg: float, whole: bool, min_height: float = 0.0, min_visibility: float = 0.2
) -> Measures:
    """The same of a dataset of throng, with boxes as a real set labels them.

    whole: boxes of whole bodies (MOT) instead of what is visible. min_height by the width of the image and min_visibility: who is
    smaller or less visible has no label.
    """

    def item(frame: Frame) -> Item:
        people = frame.people
        keep = (people.visibility >= min_visibility) & (people.boxes_amodal[:, 3] >= min_height * frame.width)
        boxes = np.array((people.boxes_amodal if whole else people.boxes)[keep], dtype=np.float64)
        boxes[:, 2:] += boxes[:, :2]
        visible = people.visibility[keep]
        hidden = np.where(visible > 0.995, 0.0, np.where(visible >= 0.5, 0.25, 0.75))
        return frame.image, boxes, len(boxes), hidden

    return _measured((item(frame) for frame in dataset), dataset.name, hfov_deg)


def distance(first: FloatArray, second: FloatArray) -> float:
    """Kolmogorov and Smirnov's distance of two samples, 0 (alike) to 1; NaN where one is empty."""
    if not len(first) or not len(second):
        return math.nan
    both = np.concatenate((first, second))
    shares = [np.searchsorted(np.sort(sample), both, side="right") / len(sample) for sample in (first, second)]
    return float(np.abs(shares[0] - shares[1]).max())
