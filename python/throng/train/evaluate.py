"""Scores of a trained network on pictures, with intervals."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from .._optional import require
from ..scores import DetectedImage, iou, score_counts, score_detections
from .networks import MULTIPLE, STRIDE
from .pictures import FloatArray, Picture

torch = require("torch", "throng.train")
VIEWS = (1.0, 0.5)
"""Scales at which an image is looked at; what they show is joined."""
_SAME_PERSON = 0.55


def score(model: Any, about: dict[str, Any], pictures: Iterable[Picture], **options: Any) -> dict[str, Any]:
    """AP of a detector or errors of a counter as JSON has them, with 95 % intervals over the images."""
    task = about["task"]
    return (
        score_detector(model, pictures, **options)
        if task == "detect"
        else score_counter(model, about, pictures, **options)
    )


def score_detector(
    model: Any, pictures: Iterable[Picture], *, scale: float = 1.0, views: Sequence[float] = VIEWS, flip: bool = True
) -> dict[str, Any]:
    def detected() -> Iterable[DetectedImage]:
        for picture in pictures:
            boxes, scores = detect(model, picture.read(), [scale * view for view in views], flip)
            yield DetectedImage(boxes, scores, picture.boxes if picture.boxes is not None else (), picture.ignored)

    return asdict(score_detections(detected(), resamples=RESAMPLES))


def score_counter(
    model: Any, about: dict[str, Any], pictures: Iterable[Picture], *, scale: float = 1.0, **_: Any
) -> dict[str, Any]:
    counted, true = [], []
    for picture in pictures:
        counted.append(count(model, picture.read(), scale))
        true.append(picture.count)
    mean = [about["mean_count"]] * len(true)
    return {
        **asdict(score_counts(counted, true, resamples=RESAMPLES)),
        "always_the_mean": asdict(score_counts(mean, true)),
    }


RESAMPLES = 200


def detect(model: Any, pixels: Any, scales: Sequence[float], flip: bool) -> tuple[FloatArray, FloatArray]:
    """Boxes (N, 4) in pixels of the image and scores (N,), of all scales joined."""
    boxes, scores = [np.empty((0, 4))], [np.empty(0)]
    for scale in scales:
        image = _resized(model, pixels, scale)
        width = image.shape[2]
        for flipped in (False, True) if flip else (False,):
            with torch.no_grad():
                found, score = model.detect(_padded(image.flip(2) if flipped else image))[0]
            found = found.cpu().numpy().astype(np.float64)
            if flipped:
                found = np.stack((width - found[:, 2], found[:, 1], width - found[:, 0], found[:, 3]), axis=1)
            boxes.append(found / scale)
            scores.append(score.cpu().numpy().astype(np.float64))
    return _join(np.concatenate(boxes), np.concatenate(scores))


def _join(boxes: FloatArray, scores: FloatArray) -> tuple[FloatArray, FloatArray]:
    """One box of those that are of one person: the mean of all, weighted by their scores, with the highest of the scores."""
    order = np.argsort(-scores, kind="stable")[:1500]
    boxes, scores = boxes[order], scores[order]
    same = iou(boxes, boxes) > _SAME_PERSON
    free = np.ones(len(boxes), dtype=np.bool_)
    joined, kept = [], []
    for i in range(len(boxes)):
        if free[i]:
            group = same[i] & free
            group[i] = True
            free[group] = False
            joined.append((boxes[group] * scores[group, None]).sum(axis=0) / scores[group].sum())
            kept.append(scores[i])
    return np.array(joined).reshape(-1, 4), np.array(kept)


def count(model: Any, pixels: Any, scale: float) -> float:
    image = _resized(model, pixels, scale)
    rows, columns = (math.ceil(side / STRIDE) for side in image.shape[1:])
    with torch.no_grad():
        return float(model(_padded(image))[0, :rows, :columns].sum())


def _resized(model: Any, pixels: Any, scale: float) -> Any:
    """The image (3, rows, columns) from 0 to 1 on the model's device."""
    device = next(model.parameters()).device
    image = torch.from_numpy(np.ascontiguousarray(pixels.transpose(2, 0, 1))).to(device).float() / 255
    if scale != 1:
        smooth = {"mode": "bilinear", "antialias": scale < 1}
        image = torch.nn.functional.interpolate(image[None], scale_factor=scale, **smooth)[0]
    return image


def _padded(image: Any) -> Any:
    """The image as a batch whose sides are multiples of MULTIPLE."""
    rows, columns = image.shape[1:]
    return torch.nn.functional.pad(image, (0, -columns % MULTIPLE, 0, -rows % MULTIPLE))[None]
