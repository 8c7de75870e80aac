"""Pitch and height of a camera from the boxes of the people that it sees.

People are upright ellipsoids BODY_HEIGHT_M tall and BODY_WIDTH_M wide on level ground, the camera is a pinhole without roll. G is
how far it is above the middle of a body, t its pitch (0 level, pi/2 straight down), f its focal length in pixels. A body whose middle is
at the column c and row v from the image's center is seen a = t + atan(v / f) below the level. From its distance on the ground, G cot a,
its depth is z = G k with k = cot a cos t + sin t. The derivatives of the projection by height, depth and sideways give

    box height = f / (G k^2) * hypot(h cot a, w)
    box width  = 1 / (G k) * hypot(w f, h c sin t, w c cos t)

For a level camera the first is linear in the row below the horizon, h v / G. Both are proportional to 1 / G: for each t of a grid, the
weighted median of the boxes' deviations gives G, and the t with the least sum of absolute deviations is taken. Height over row and
height over width both tell t, so that views from straight above, in which all boxes are alike, are found as well.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

BODY_HEIGHT_M = 1.7
BODY_WIDTH_M = 0.6
# Standard deviations of the logarithms: people differ in height, more in the width that their arms and steps have.
_HEIGHT_DEVIATION, _WIDTH_DEVIATION = 0.12, 0.25
_PITCHES = np.radians(np.arange(1.0, 91.0))
_MIN_BOXES = 4
_MAX_BOXES = 300
_MAX_COVERED = 0.3
_LEAST_DEPRESSION = math.radians(0.5)


def focal_px(width: float, hfov_deg: float) -> float:
    return width / 2 / math.tan(math.radians(hfov_deg) / 2)


def box_sizes(
    pitch: Any, above_m: Any, focal: float, columns: FloatArray, rows: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Heights and widths, px, of boxes with their middles at columns and rows from the image's center; pitch in rad, positive down,
    above_m over the middle of a body. NaN at and above the horizon."""
    below = pitch + np.arctan2(rows, focal)
    below = np.where(below > _LEAST_DEPRESSION, below, np.nan)
    cotangent = np.cos(below) / np.sin(below)
    k = cotangent * np.cos(pitch) + np.sin(pitch)
    heights = focal / (above_m * k**2) * np.hypot(BODY_HEIGHT_M * cotangent, BODY_WIDTH_M)
    aside = np.hypot(BODY_HEIGHT_M * columns * np.sin(pitch), BODY_WIDTH_M * columns * np.cos(pitch))
    widths = np.hypot(BODY_WIDTH_M * focal, aside) / (above_m * k)
    return heights, widths


def estimate_view(
    boxes: FloatArray, covered: FloatArray, width: int, height: int, hfov_deg: float
) -> tuple[float, float]:
    """Pitch, degrees, negative down as jobs have it, and height above the ground, m; NaN where too few whole people are seen.

    boxes (N, 4) are x0, y0, x1, y1; covered (N,) the share that others hide.
    """
    inside = (boxes[:, :2] > 1).all(axis=1) & (boxes[:, 2] < width - 1) & (boxes[:, 3] < height - 1)
    size = boxes[:, 2:] - boxes[:, :2]
    whole = boxes[inside & (covered <= _MAX_COVERED) & (size > 0).all(axis=1)]
    if len(whole) < _MIN_BOXES:
        return math.nan, math.nan
    whole = whole[:: math.ceil(len(whole) / _MAX_BOXES)]
    focal = focal_px(width, hfov_deg)
    middles = (whole[:, :2] + whole[:, 2:]) / 2 - np.array([width, height]) / 2
    size = whole[:, 2:] - whole[:, :2]
    with np.errstate(invalid="ignore", divide="ignore"):
        models = box_sizes(_PITCHES[:, None], 1.0, focal, middles[None, :, 0], middles[None, :, 1])
        # A box of few pixels is rounded to them.
        deviations = [
            np.broadcast_to(np.hypot(deviation, 0.4 / size[:, axis]), models[0].shape)
            for axis, deviation in ((1, _HEIGHT_DEVIATION), (0, _WIDTH_DEVIATION))
        ]
        logs = np.concatenate([np.log(model) - np.log(size[:, axis]) for model, axis in zip(models, (1, 0))], axis=1)
    weights = 1 / np.concatenate(deviations, axis=1)
    # Nobody is above the horizon.
    possible = np.isfinite(logs).all(axis=1)
    if not possible.any():
        return math.nan, math.nan
    logs, weights, pitches = logs[possible], weights[possible], _PITCHES[possible]
    above = _weighted_medians(logs, weights)
    losses = (np.abs(logs - above[:, None]) * weights).sum(axis=1)
    best = int(losses.argmin())
    return -math.degrees(pitches[best]), math.exp(above[best]) + BODY_HEIGHT_M / 2


def _weighted_medians(values: FloatArray, weights: FloatArray) -> FloatArray:
    """Of each row."""
    order = values.argsort(axis=1)
    sums = np.take_along_axis(weights, order, axis=1).cumsum(axis=1)
    middle = (sums < sums[:, -1:] / 2).sum(axis=1)
    medians: FloatArray = np.take_along_axis(values, np.take_along_axis(order, middle[:, None], axis=1), axis=1)[:, 0]
    return medians


def seen_ground_m2(
    pitch_deg: FloatArray, height_m: FloatArray, hfov_deg: float, aspect: float, reach_m: float
) -> FloatArray:
    """Level ground in the image up to reach_m ahead; aspect is width by height of the image."""
    tangent = math.tan(math.radians(hfov_deg) / 2)
    half = math.atan(tangent / aspect)
    pitch = -np.radians(pitch_deg)
    steps = np.linspace(-half, half, 65)
    below = pitch[:, None] + steps
    reach = math.hypot(reach_m, 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        ahead = np.where(below > 1e-3, height_m[:, None] / np.tan(np.maximum(below, 1e-3)), reach)
    ahead = np.clip(ahead, -reach, reach)
    depth = ahead * np.cos(pitch)[:, None] + height_m[:, None] * np.sin(pitch)[:, None]
    across = 2 * tangent * np.minimum(np.maximum(depth, 0), reach)
    area: FloatArray = (np.abs(np.diff(ahead, axis=1)) * (across[:, 1:] + across[:, :-1]) / 2).sum(axis=1)
    return area
