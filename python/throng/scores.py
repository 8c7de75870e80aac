"""Scores of detectors and counters: average precision as COCO defines it, errors of counts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IOU_THRESHOLDS: tuple[float, ...] = tuple(round(0.5 + 0.05 * i, 2) for i in range(10))
_RECALLS = np.linspace(0, 1, 101)
_SIZES = {"small": (0.0, 32.0**2), "medium": (32.0**2, 96.0**2), "large": (96.0**2, np.inf)}
"""Areas of boxes in px that COCO calls small, medium and large."""


@dataclass(frozen=True, eq=False)
class DetectedImage:
    """Detections of an image and what there is. Boxes are (N, 4) x0, y0, x1, y1 in any unit, scores (N,)."""

    boxes: ArrayLike
    scores: ArrayLike
    truth: ArrayLike
    ignored: ArrayLike = ()
    """Regions: a detection without a person whose share inside one reaches the threshold is not scored."""


@dataclass(frozen=True)
class DetectionScores:
    """ap: mean over the IoU thresholds 0.5, 0.55, ... 0.95; by COCO's sizes in ap_small, ap_medium and ap_large. NaN where there
    is nobody to find."""

    ap: float
    ap50: float
    ap75: float
    recall50: float
    images: int
    people: int
    ap_small: float = float("nan")
    ap_medium: float = float("nan")
    ap_large: float = float("nan")
    ap50_interval: tuple[float, float] | None = None
    """95 % of what other choices of as many images would give (bootstrap); None without `resamples`."""


@dataclass(frozen=True)
class CountingScores:
    """Errors in people per image; bias: mean of counted - true."""

    mae: float
    rmse: float
    bias: float
    images: int
    mean_count: float
    mae_interval: tuple[float, float] | None = None
    """95 % of what other choices of as many images would give (bootstrap); None without `resamples`."""


def score_counts(counted: Sequence[float], true: Sequence[float], *, resamples: int = 0) -> CountingScores:
    """Errors: ValueError for sequences of different lengths or without an image."""
    if len(counted) != len(true) or len(true) == 0:
        raise ValueError(f"found {len(counted)} counts and {len(true)} true counts, expected as many, at least one")
    error = np.asarray(counted, dtype=np.float64) - np.asarray(true, dtype=np.float64)
    return CountingScores(
        float(np.abs(error).mean()),
        float(np.sqrt((error**2).mean())),
        float(error.mean()),
        len(true),
        float(np.mean(true)),
        _interval([float(weights @ np.abs(error)) / len(error) for weights in _choices(len(error), resamples)]),
    )


def score_detections(
    images: Iterable[DetectedImage], *, max_detections: int = 500, resamples: int = 0
) -> DetectionScores:
    """Average precision over 101 recalls, as COCO's; of each image the max_detections with the highest scores count.

    COCO's own limit is 100, VisDrone's 500, since images from drones have more people. For the sizes, people of other
    sizes are as if they were ignored; each detection has the one person that it was matched to among all.
    """
    matched = [_match(image, max_detections) for image in images]
    people = [len(each.person_areas) for each in matched]
    if sum(people) == 0:
        return DetectionScores(np.nan, np.nan, np.nan, np.nan, len(matched), 0)
    order = np.argsort(-np.concatenate([each.scores for each in matched]), kind="stable")
    hits = np.concatenate([each.hits for each in matched], axis=1)[:, order]
    areas = np.concatenate([each.areas for each in matched])[order]
    # The area of the person that was found, else the detection's.
    found_areas = np.concatenate([each.found_areas for each in matched], axis=1)[:, order]
    owners = np.repeat(np.arange(len(matched)), [len(each.scores) for each in matched])[order]
    curves = [_precision(row, sum(people)) for row in hits]
    precisions = [float(precision) for precision, _ in curves]
    at50 = IOU_THRESHOLDS.index(0.5)
    person_areas = np.concatenate([each.person_areas for each in matched])
    by_size = {}
    for name, (low, high) in _SIZES.items():
        count = int(((person_areas >= low) & (person_areas < high)).sum())
        extent = np.where(hits == 1, found_areas, areas)
        sized = np.where((extent >= low) & (extent < high), hits, -1)
        by_size[name] = float(np.mean([_precision(row, count)[0] for row in sized])) if count else np.nan
    again = []
    for weights in _choices(len(matched), resamples):
        if (total := float(weights @ people)) > 0:
            again.append(_precision(hits[at50], total, weights[owners])[0])
    return DetectionScores(
        float(np.mean(precisions)),
        precisions[at50],
        precisions[IOU_THRESHOLDS.index(0.75)],
        curves[at50][1],
        len(matched),
        sum(people),
        by_size["small"],
        by_size["medium"],
        by_size["large"],
        _interval(again),
    )


@dataclass(frozen=True, eq=False)
class _Matched:
    """An image's detections by falling scores: hits and areas of the people found are (thresholds, detections)."""

    scores: FloatArray
    areas: FloatArray
    hits: NDArray[np.int8]
    found_areas: FloatArray
    person_areas: FloatArray


def _match(image: DetectedImage, max_detections: int) -> _Matched:
    truth = _boxes(image.truth)
    values = np.asarray(image.scores, dtype=np.float64).reshape(-1)
    boxes = _boxes(image.boxes)
    if len(values) != len(boxes):
        raise ValueError(f"found {len(values)} scores of {len(boxes)} boxes, expected one for each")
    order = np.argsort(-values, kind="stable")[:max_detections]
    hits, found = _hits(boxes[order], truth, _boxes(image.ignored))
    areas = _areas(truth)
    return _Matched(values[order], _areas(boxes[order]), hits, np.append(areas, np.nan)[found], areas)


def _choices(count: int, resamples: int) -> Iterable[FloatArray]:
    """How often each of `count` images is taken, in so many choices of as many with replacement."""
    rng = np.random.default_rng(count)
    for _ in range(resamples):
        yield rng.multinomial(count, np.full(count, 1 / count)).astype(np.float64)


def _interval(values: Sequence[float]) -> tuple[float, float] | None:
    if not values:
        return None
    low, high = np.percentile(values, (2.5, 97.5))
    return float(low), float(high)


def intersections(a: FloatArray, b: FloatArray) -> FloatArray:
    """(N, M) areas that boxes have in common."""
    low = np.maximum(a[:, None, :2], b[None, :, :2])
    high = np.minimum(a[:, None, 2:], b[None, :, 2:])
    result: FloatArray = np.clip(high - low, 0, None).prod(axis=2)
    return result


def iou(a: FloatArray, b: FloatArray) -> FloatArray:
    """(N, M) shares of the common area in the joint area; 0 for boxes without area."""
    common = intersections(a, b)
    joint = _areas(a)[:, None] + _areas(b)[None] - common
    return np.divide(common, joint, out=np.zeros_like(common), where=joint > 0)


def _boxes(boxes: ArrayLike) -> FloatArray:
    return np.asarray(boxes, dtype=np.float64).reshape(-1, 4)


def _areas(boxes: FloatArray) -> FloatArray:
    sides: FloatArray = boxes[:, 2:] - boxes[:, :2]
    return np.asarray(sides.prod(axis=1), dtype=np.float64)


def _hits(boxes: FloatArray, truth: FloatArray, ignored: FloatArray) -> tuple[NDArray[np.int8], NDArray[np.intp]]:
    """(thresholds, detections) 1 found somebody, 0 nobody, -1 not scored; and whom, -1 nobody. Boxes come by falling scores."""
    shares = iou(boxes, truth)
    areas = _areas(boxes)[:, None]
    inside = np.divide(intersections(boxes, ignored), areas, out=np.zeros((len(boxes), len(ignored))), where=areas > 0)
    hidden = inside.max(axis=1, initial=0)
    hits = np.zeros((len(IOU_THRESHOLDS), len(boxes)), dtype=np.int8)
    found = np.full(hits.shape, -1, dtype=np.intp)
    for row, whom, threshold in zip(hits, found, IOU_THRESHOLDS):
        free = np.ones(len(truth), dtype=np.bool_)
        for i, share in enumerate(shares):
            candidates = np.where(free & (share >= threshold), share, -1.0)
            best = int(candidates.argmax()) if len(candidates) else -1
            if best >= 0 and candidates[best] >= 0:
                free[best] = False
                row[i], whom[i] = 1, best
            elif hidden[i] >= threshold:
                row[i] = -1
    return hits, found


def _precision(hits: NDArray[np.int8], people: float, weights: FloatArray | None = None) -> tuple[float, float]:
    """Average precision and the recall that all detections reach. weights: how often each detection counts."""
    scored = hits >= 0
    counts = np.ones(len(hits)) if weights is None else weights
    counts = counts[scored]
    if counts.sum() == 0:
        return 0.0, 0.0
    found = np.cumsum(hits[scored] * counts)
    recall = found / people
    precision = found / np.maximum(np.cumsum(counts), 1)
    # The best precision at this recall or a higher one.
    precision = np.maximum.accumulate(precision[::-1])[::-1]
    ranks = np.searchsorted(recall, _RECALLS, side="left")
    reached = ranks < len(precision)
    return float(precision[ranks[reached]].sum() / len(_RECALLS)), float(recall[-1])
