"""Frames of a dataset that have, together, the figures of a real set."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._measures import Measures

FloatArray = NDArray[np.float64]

_MIN_DEVIATION = 1e-3


def features(measures: Measures, heads_only: bool) -> FloatArray:
    """(images, features): logarithms of sizes and counts, overlap and light; sizes and overlap only where there are boxes."""
    columns = [np.log1p(measures.count), measures.brightness, measures.contrast]
    if not heads_only:
        with np.errstate(invalid="ignore", divide="ignore"):
            columns += [np.log(measures.box_height), measures.box_spread, np.log(measures.aspect), measures.overlap]
            columns.append(measures.hidden)
    return np.stack(columns, axis=1)


def choose_frames(real: Measures, made: Measures, count: int) -> list[int]:
    """Indices of `count` of the made images, in their order, whose joint distribution is near the real one's.

    Greedy: each next one is that with which the energy distance (Szekely and Rizzo) of the two sets of standardized features is
    least; the same input gives the same result. ValueError for more images than there are.
    """
    if not 1 <= count <= len(made):
        raise ValueError(f"count: found {count}, expected 1 to {len(made)}, the images of the dataset")
    heads_only = not len(real.heights)
    wanted, found = (features(each, heads_only) for each in (real, made))
    middles = np.array(
        [np.median(column[np.isfinite(column)]) if np.isfinite(column).any() else 0 for column in wanted.T]
    )
    wanted, found = (np.where(np.isfinite(each), each, middles) for each in (wanted, found))
    deviations = np.maximum(wanted.std(axis=0), np.maximum(0.1 * found.std(axis=0), _MIN_DEVIATION))
    wanted, found = wanted / deviations, found / deviations
    to_real = np.array([_distances(each, wanted).mean() for each in found])
    to_chosen = np.zeros(len(found))
    is_free = np.ones(len(found), dtype=np.bool_)
    for size in range(1, count + 1):
        # Twice the mean distance to the real ones less the mean distance within the chosen ones, in what depends on the next.
        score = np.where(is_free, 2 * to_real - 2 * to_chosen / size, np.inf)
        best = int(score.argmin())
        is_free[best] = False
        to_chosen += _distances(found[best], found)
    return [int(i) for i in np.flatnonzero(~is_free)]


def _distances(one: FloatArray, others: FloatArray) -> FloatArray:
    result: FloatArray = np.sqrt(((others - one) ** 2).sum(axis=1))
    return result
