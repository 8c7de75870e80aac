"""Scores of detectors and counters: average precision as COCO defines it, errors of counts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IOU_THRESHOLDS: tuple[float, ...] = tuple(round(0.5 + 0.05 * i, 2) for i in range(10))
_RECALLS = np.linspace(0, 1, 101)


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
    """ap: mean over the IoU thresholds 0.5, 0.55, ... 0.95. NaN where there is nobody to find."""

    ap: float
    ap50: float
    ap75: float
    recall50: float
    images: int
    people: int


@dataclass(frozen=True)
class CountingScores:
    """Errors in people per image; bias: mean of counted - true."""

    mae: float
    rmse: float
    bias: float
    images: int
    mean_count: float


def score_counts(counted: Sequence[float], true: Sequence[float]) -> CountingScores:
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
    )


def score_detections(images: Iterable[DetectedImage], *, max_detections: int = 500) -> DetectionScores:
    """Average precision over 101 recalls, as COCO's; of each image the max_detections with the highest scores count.

    COCO's own limit is 100, VisDrone's 500, since images from drones have more people.
    """
    scores: list[FloatArray] = []
    hits: list[NDArray[np.int8]] = []
    people = count = 0
    for image in images:
        truth = _boxes(image.truth)
        values = np.asarray(image.scores, dtype=np.float64).reshape(-1)
        boxes = _boxes(image.boxes)
        if len(values) != len(boxes):
            raise ValueError(f"found {len(values)} scores of {len(boxes)} boxes, expected one for each")
        order = np.argsort(-values, kind="stable")[:max_detections]
        scores.append(values[order])
        hits.append(_hits(boxes[order], truth, _boxes(image.ignored)))
        people += len(truth)
        count += 1
    if people == 0:
        return DetectionScores(np.nan, np.nan, np.nan, np.nan, count, 0)
    order = np.argsort(-np.concatenate(scores), kind="stable")
    all_hits = np.concatenate(hits, axis=1)[:, order]
    curves = [_precision(row, people) for row in all_hits]
    precisions = [float(precision) for precision, _ in curves]
    return DetectionScores(
        float(np.mean(precisions)),
        precisions[IOU_THRESHOLDS.index(0.5)],
        precisions[IOU_THRESHOLDS.index(0.75)],
        curves[IOU_THRESHOLDS.index(0.5)][1],
        count,
        people,
    )


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


def _hits(boxes: FloatArray, truth: FloatArray, ignored: FloatArray) -> NDArray[np.int8]:
    """(thresholds, detections) 1 found somebody, 0 nobody, -1 not scored. Boxes come by falling scores."""
    shares = iou(boxes, truth)
    areas = _areas(boxes)[:, None]
    inside = np.divide(intersections(boxes, ignored), areas, out=np.zeros((len(boxes), len(ignored))), where=areas > 0)
    hidden = inside.max(axis=1, initial=0)
    hits = np.zeros((len(IOU_THRESHOLDS), len(boxes)), dtype=np.int8)
    for row, threshold in zip(hits, IOU_THRESHOLDS):
        free = np.ones(len(truth), dtype=np.bool_)
        for i, share in enumerate(shares):
            candidates = np.where(free & (share >= threshold), share, -1.0)
            best = int(candidates.argmax()) if len(candidates) else -1
            if best >= 0 and candidates[best] >= 0:
                free[best] = False
                row[i] = 1
            elif hidden[i] >= threshold:
                row[i] = -1
    return hits


def _precision(hits: NDArray[np.int8], people: int) -> tuple[float, float]:
    """Average precision and the recall that all detections reach."""
    scored = hits[hits >= 0]
    if len(scored) == 0:
        return 0.0, 0.0
    found = np.cumsum(scored)
    recall = found / people
    precision = found / np.arange(1, len(scored) + 1)
    # The best precision at this recall or a higher one.
    precision = np.maximum.accumulate(precision[::-1])[::-1]
    ranks = np.searchsorted(recall, _RECALLS, side="left")
    reached = ranks < len(precision)
    return float(precision[ranks[reached]].sum() / len(_RECALLS)), float(recall[-1])
