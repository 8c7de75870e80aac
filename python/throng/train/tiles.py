"""Tiles that are trained on: squares of images at sampled scales, with other light, sharpness and noise.

A tile depends on the seed and its number only, so that a training which was interrupted goes on as if it had not been.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._optional import require
from .pictures import Cache, FloatArray, Picture

SCALES = (0.5, 2.0)
_LEAST_SEEN = 0.4
"""People of whom less is inside a tile are not trained on there, nor those who are smaller."""
_LEAST_HEIGHT_PX = 5.0
# Of those that tiles are cut around: the least, and the largest as a share of the tile.
_HEIGHTS_PX = (10.0, 0.6)
Pixels = NDArray[np.uint8]


class Tiles:
    """A map-style dataset: tile (3, side, side) from 0 to 1, and heads (N, 2) of its people or boxes (N, 5), whose last column is 0
    for what is to be ignored: people too small or too hidden, and regions without labels.

    sources are lists of images that are sampled from equally often; task is "detect" or "count"; changes: of light, sharpness and
    noise.
    """

    def __init__(
        self,
        sources: Sequence[Sequence[Picture]],
        task: str,
        side: int,
        count: int,
        seed: int,
        *,
        first: int = 0,
        scales: tuple[float, float] = SCALES,
        changes: bool = True,
    ) -> None:
        self.sources, self.task, self.side, self.seed = sources, task, side, seed
        self.first, self.count, self.scales, self.changes = first, count, scales, changes
        self._cache = Cache()

    def __len__(self) -> int:
        return self.count - self.first

    def __getitem__(self, index: int) -> tuple[Any, Any]:
        if index >= len(self):
            raise IndexError(index)
        torch = require("torch", "throng.train")
        rng = np.random.default_rng((self.seed, self.first + index))
        pictures = self.sources[rng.integers(len(self.sources))]
        picture = pictures[rng.integers(len(pictures))]
        tile, place = _cut(self._cache.read(picture), self._middles(picture), self.side, self.scales, rng)
        if self.changes:
            tile = _changed(tile, rng)
        pixels = torch.from_numpy(np.ascontiguousarray(tile.transpose(2, 0, 1))).float() / 255
        people = self._boxes(picture, place) if self.task == "detect" else place.move(picture.heads)
        return pixels, torch.from_numpy(people).float()

    def _middles(self, picture: Picture) -> FloatArray:
        """(N, 3) x, y and height of people, 0 where it is not known."""
        if picture.boxes is None:
            return np.pad(picture.heads, ((0, 0), (0, 1)))
        low, high = picture.boxes[:, :2], picture.boxes[:, 2:]
        return np.column_stack(((low + high) / 2, (high - low)[:, 1]))

    def _boxes(self, picture: Picture, place: _Place) -> FloatArray:
        boxes = np.empty((0, 4)) if picture.boxes is None else picture.boxes
        whole = np.concatenate((boxes, picture.ignored))
        corners = place.move(whole.reshape(-1, 2)).reshape(-1, 4)
        whole = np.stack((corners[:, ::2].min(1), corners[:, 1], corners[:, ::2].max(1), corners[:, 3]), axis=1)
        inside = whole.clip(0, self.side)
        area, seen = ((part[:, 2:] - part[:, :2]).prod(axis=1) for part in (whole, inside))
        counts = (np.arange(len(whole)) < len(boxes)) & (seen >= _LEAST_SEEN * area)
        counts &= whole[:, 3] - whole[:, 1] >= _LEAST_HEIGHT_PX
        people: FloatArray = np.concatenate((inside, counts[:, None]), axis=1)[seen > 0]
        return people


@dataclass(frozen=True)
class _Place:
    """The place of a tile in its image."""

    corner: NDArray[np.int64]
    scale: float
    side: int
    is_flipped: bool

    def move(self, points: FloatArray) -> FloatArray:
        moved = (points - self.corner) * self.scale
        if self.is_flipped:
            moved[:, 0] = self.side - moved[:, 0]
        return moved


def _cut(
    image: Pixels, people: FloatArray, side: int, scales: tuple[float, float], rng: np.random.Generator
) -> tuple[Pixels, _Place]:
    """A square of the image, resized to `side` and flipped in half of the cases. Every second is around somebody, whose height
    in it is sampled: most people of a dataset are far away, and near ones would hardly be learned."""
    scale = float(np.exp(rng.uniform(*np.log(scales))))
    is_around = len(people) > 0 and rng.random() < 0.5
    if is_around:
        x, y, height = people[rng.integers(len(people))]
        if height > 0:
            wanted = np.exp(rng.uniform(np.log(_HEIGHTS_PX[0]), np.log(_HEIGHTS_PX[1] * side)))
            scale = float(np.clip(wanted / height, scales[0] / 2, scales[1] * 2))
    size = max(1, round(side / scale))
    spare = np.array([max(image.shape[1] - size, 0), max(image.shape[0] - size, 0)])
    corner = (rng.random(2) * (spare + 1)).astype(np.int64)
    if is_around:
        corner = np.clip((x, y) - size * rng.uniform(0.1, 0.9, 2), 0, spare).astype(np.int64)
    part = image[corner[1] : corner[1] + size, corner[0] : corner[0] + size]
    part = np.pad(part, ((0, size - part.shape[0]), (0, size - part.shape[1]), (0, 0)))
    pil = require("PIL.Image", "throng.train")
    tile = np.array(pil.fromarray(part).resize((side, side), pil.BILINEAR))
    is_flipped = bool(rng.random() < 0.5)
    return tile[:, ::-1] if is_flipped else tile, _Place(corner, side / size, side, is_flipped)


def _changed(tile: Pixels, rng: np.random.Generator) -> Pixels:
    """Changes that cameras and their files make: exposure, tone, colors, sharpness, resolution, noise, compression; things in front."""
    values = (tile / 255.0) ** np.exp(rng.normal(0, 0.25))
    values = values * np.exp(rng.normal(0, 0.2) + rng.normal(0, 0.08, 3))
    values = (values - values.mean()) * np.exp(rng.normal(0, 0.25)) + values.mean() + rng.normal(0, 0.05)
    gray = values.mean(axis=2, keepdims=True)
    values = gray + (values - gray) * (0 if rng.random() < 0.1 else rng.uniform(0.4, 1.5))
    if rng.random() < 0.3:
        _cover(values, rng)
    tile = _resample(_bytes(values), rng)
    if rng.random() < 0.4:
        tile = _bytes(tile / 255.0 + rng.normal(0, rng.uniform(0.005, 0.05), tile.shape))
    return _compress(tile, rng) if rng.random() < 0.5 else tile


def _cover(values: FloatArray, rng: np.random.Generator) -> None:
    """Up to three rectangles show another part of the tile."""
    side = len(values)
    for _ in range(rng.integers(1, 4)):
        height, width = rng.integers(side // 32, side // 6, 2)
        (y, x), (from_y, from_x) = rng.integers(0, side - max(height, width), (2, 2))
        values[y : y + height, x : x + width] = values[from_y : from_y + height, from_x : from_x + width].copy()


def _resample(tile: Pixels, rng: np.random.Generator) -> Pixels:
    pil, filters = require("PIL.Image", "throng.train"), require("PIL.ImageFilter", "throng.train")
    image, kind = pil.fromarray(tile), rng.random()
    if kind < 0.2:
        image = image.filter(filters.GaussianBlur(rng.uniform(0.3, 1.3)))
    elif kind < 0.35:
        image = image.filter(filters.UnsharpMask(rng.uniform(0.5, 2), int(rng.integers(50, 200)), 2))
    elif kind < 0.5:
        small = max(8, round(len(tile) / rng.uniform(1.2, 2.5)))
        image = image.resize((small, small), pil.BILINEAR).resize(image.size, pil.BICUBIC)
    return np.array(image)


def _compress(tile: Pixels, rng: np.random.Generator) -> Pixels:
    pil = require("PIL.Image", "throng.train")
    file = io.BytesIO()
    pil.fromarray(tile).save(file, "JPEG", quality=int(rng.integers(30, 96)))
    return np.array(pil.open(file))


def _bytes(values: FloatArray) -> Pixels:
    return np.asarray((values * 255).clip(0, 255), dtype=np.uint8)
