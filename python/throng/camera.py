"""The camera of a frame: project, unproject and undistort, with the lenses of OpenCV.

World: meters, right-handed, Z up. Camera: x right, y down, z forward; X_camera = R X_world + t. Pixels are by default
OpenCV's, in which the center of the top-left pixel is (0, 0); with origin="corner" they are those of boxes, masks,
keypoints and heads, in which the image's corner is (0, 0): 0.5 more.

Lenses: "pinhole"; "brown_conrady" with k1, k2, p1, p2, k3, k4, k5, k6 as cv::projectPoints has them (Brown 1966,
rational denominator); "fisheye" with k1 to k4 as cv::fisheye::projectPoints has them (Kannala and Brandt 2006). A
lens's model is used where it is monotonic, at most 80 degrees off its axis, as throng renders it: beyond, results are
NaN.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import DatasetError

FloatArray = NDArray[np.float64]
Origin = Literal["center", "corner"]

_BROWN = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")
_FISHEYE = ("k1", "k2", "k3", "k4")
_WIDEST_ANGLE_RAD = math.radians(80)
_LIMIT_STEPS = 4096
_NEWTON_STEPS = 20
_CONVERGED = 1e-12


class Lens:
    """Maps (x, y) = (X / Z, Y / Z) to where the lens shows it, before the focal length is applied, and back."""

    def __init__(self, model: str, distortion: Mapping[str, float]) -> None:
        if model not in ("pinhole", "brown_conrady", "fisheye"):
            raise DatasetError(f'model: found "{model}", expected "pinhole", "brown_conrady" or "fisheye"')
        self.model = model
        names = {"pinhole": (), "brown_conrady": _BROWN, "fisheye": _FISHEYE}[model]
        if unknown := set(distortion) - set(names) - set(_BROWN if not any(distortion.values()) else ()):
            raise DatasetError(f"distortion: found {sorted(unknown)}, expected {', '.join(names) or 'nothing'}")
        self._k = np.array([float(distortion.get(name, 0.0)) for name in names])
        self.is_pinhole = model == "pinhole"

    def _radial(self, r: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Distance from the axis as shown, and its derivative by r."""
        if self.is_pinhole:
            return r, np.ones_like(r)
        k = self._k
        if self.model == "fisheye":
            theta = np.arctan(r)
            s = theta * theta
            value = 1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))
            slope = k[0] + s * (2 * k[1] + s * (3 * k[2] + s * 4 * k[3]))
            return theta * value, (value + 2 * s * slope) / (1 + r * r)
        s = r * r
        above = 1 + s * (k[0] + s * (k[1] + s * k[4]))
        above_slope = k[0] + s * (2 * k[1] + s * 3 * k[4])
        below = 1 + s * (k[5] + s * (k[6] + s * k[7]))
        below_slope = k[5] + s * (2 * k[6] + s * 3 * k[7])
        c = above / below
        return r * c, c + 2 * s * (above_slope - c * below_slope) / below

    @cached_property
    def limit(self) -> float:
        """Largest r = hypot(x, y) for which the model is valid."""
        if self.is_pinhole:
            return math.inf
        r = np.linspace(0, math.tan(_WIDEST_ANGLE_RAD), _LIMIT_STEPS + 1)
        with np.errstate(all="ignore"):
            shown, slope = self._radial(r)
            good = (slope > 0) & np.append(True, np.diff(shown) > 0)
        bad = np.flatnonzero(~good[1:])
        if bad.size == 0:
            return float(r[-1])
        low, high = r[bad[0]], r[bad[0] + 1]
        while high - low > 1e-9:
            middle = 0.5 * (low + high)
            if self._radial(np.array(middle))[1] > 0:
                low = middle
            else:
                high = middle
        return float(low)

    def _apply(self, xy: FloatArray) -> FloatArray:
        r = np.hypot(xy[..., 0], xy[..., 1])
        safe = np.where(r < 1e-9, 1.0, r)
        out: FloatArray = xy * np.where(r < 1e-9, 1.0, self._radial(safe)[0] / safe)[..., None]
        if self.model == "brown_conrady" and (self._k[2] or self._k[3]):
            p1, p2 = self._k[2], self._k[3]
            x, y = xy[..., 0], xy[..., 1]
            out = out + np.stack(
                (2 * p1 * x * y + p2 * (r * r + 2 * x * x), p1 * (r * r + 2 * y * y) + 2 * p2 * x * y), axis=-1
            )
        return out

    def _jacobian(self, xy: FloatArray) -> FloatArray:
        """(..., 2, 2): derivatives of _apply."""
        r = np.hypot(xy[..., 0], xy[..., 1])
        near = r < 1e-9
        safe = np.where(near, 1.0, r)
        shown, slope = self._radial(safe)
        across = np.where(near, 1.0, shown / safe)
        slope = np.where(near, 1.0, slope)
        outward = xy / safe[..., None]
        j = across[..., None, None] * np.eye(2)
        j = j + (slope - across)[..., None, None] * outward[..., :, None] * outward[..., None, :]
        if self.model == "brown_conrady":
            p1, p2 = self._k[2], self._k[3]
            x, y = xy[..., 0], xy[..., 1]
            mixed = 2 * p1 * x + 2 * p2 * y
            j = j + np.stack(
                (
                    np.stack((2 * p1 * y + 6 * p2 * x, mixed), axis=-1),
                    np.stack((mixed, 6 * p1 * y + 2 * p2 * x), axis=-1),
                ),
                axis=-2,
            )
        return j

    def distort(self, xy: FloatArray) -> FloatArray:
        """Projection of directions by the lens; NaN beyond its range."""
        if self.is_pinhole:
            return xy
        with np.errstate(all="ignore"):
            valid = np.hypot(xy[..., 0], xy[..., 1]) <= self.limit
            if self.model == "brown_conrady" and (self._k[2] or self._k[3]):
                # Tangential terms fold the image before the radial ones do, on one side.
                valid &= _determinant(self._jacobian(xy)) > 1e-9
            return np.where(valid[..., None], self._apply(xy), np.nan)

    def undistort(self, shown: FloatArray) -> FloatArray:
        """The inverse, by Newton's method; NaN where nothing is shown."""
        if self.is_pinhole:
            return shown
        with np.errstate(all="ignore"):
            table = np.linspace(0, self.limit, _LIMIT_STEPS)
            distance = np.hypot(shown[..., 0], shown[..., 1])
            start = np.interp(distance, self._radial(table)[0], table)
            scale = np.where(distance < 1e-9, 1.0, start / np.where(distance < 1e-9, 1.0, distance))
            p = shown * scale[..., None]
            for _ in range(_NEWTON_STEPS):
                error = self._apply(p) - shown
                j = self._jacobian(p)
                determinant = _determinant(j)
                step = np.stack(
                    (
                        j[..., 1, 1] * error[..., 0] - j[..., 0, 1] * error[..., 1],
                        j[..., 0, 0] * error[..., 1] - j[..., 1, 0] * error[..., 0],
                    ),
                    axis=-1,
                )
                p = p - step / determinant[..., None]
                if not (np.abs(error) > _CONVERGED).any():
                    break
            error = np.abs(self._apply(p) - shown).max(axis=-1)
            valid = (
                (error < 1e-9)
                & (np.hypot(p[..., 0], p[..., 1]) <= self.limit)
                & (_determinant(self._jacobian(p)) > 1e-9)
            )
            return np.where(valid[..., None], p, np.nan)


def _determinant(j: FloatArray) -> FloatArray:
    result: FloatArray = j[..., 0, 0] * j[..., 1, 1] - j[..., 0, 1] * j[..., 1, 0]
    return result


@dataclass(frozen=True)
class Camera:
    """Intrinsics, lens and pose of one frame's camera."""

    width: int
    height: int
    K: FloatArray
    R: FloatArray = field(default_factory=lambda: np.eye(3))
    t: FloatArray = field(default_factory=lambda: np.zeros(3))
    model: str = "pinhole"
    distortion: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def from_record(cls, camera: Mapping[str, Any], width: int, height: int) -> Camera:
        """The `camera` of an image's record."""
        try:
            k, r, t = (np.array(camera[key], dtype=np.float64) for key in ("K", "R", "t"))
            distortion = {str(name): float(value) for name, value in camera.get("distortion", {}).items()}
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise DatasetError(f"camera: found no usable K, R, t and distortion ({error!r})") from None
        if k.shape != (3, 3) or r.shape != (3, 3) or t.shape != (3,):
            raise DatasetError(f"camera: found K {k.shape}, R {r.shape}, t {t.shape}, expected 3 x 3, 3 x 3 and 3")
        if not (k[0, 0] > 0 and k[1, 1] > 0 and all(np.isfinite(a).all() for a in (k, r, t))):
            raise DatasetError("camera: found focal lengths that are not positive or numbers that are not finite")
        return cls(width, height, k, r, t, str(camera.get("model", "pinhole")), distortion)

    @cached_property
    def lens(self) -> Lens:
        return Lens(self.model, self.distortion)

    @property
    def center(self) -> FloatArray:
        """Position of the camera in the world."""
        result: FloatArray = -self.R.T @ self.t
        return result

    def depth(self, points: ArrayLike) -> FloatArray:
        """Camera z of world points (..., 3), m."""
        result: FloatArray = np.asarray(points, dtype=np.float64) @ self.R[2] + self.t[2]
        return result

    def project(self, points: ArrayLike, *, origin: Origin = "center") -> FloatArray:
        """Pixels (..., 2) of world points (..., 3); NaN behind the camera and where the lens shows nothing.

        Points outside of the image have pixels, too.
        """
        x = np.asarray(points, dtype=np.float64)
        if x.shape[-1:] != (3,):
            raise ValueError(f"points: found the shape {x.shape}, expected (..., 3)")
        local = x @ self.R.T + self.t
        with np.errstate(all="ignore"):
            direction = np.where(local[..., 2:] > 0, local[..., :2] / local[..., 2:], np.nan)
        return self._to_pixels(self.lens.distort(direction)) + _shift(origin)

    def directions(self, pixels: ArrayLike, *, origin: Origin = "center") -> FloatArray:
        """(x / z, y / z) in the camera's frame of what is seen at pixels (..., 2); NaN where the lens shows nothing."""
        u = np.asarray(pixels, dtype=np.float64)
        if u.shape[-1:] != (2,):
            raise ValueError(f"pixels: found the shape {u.shape}, expected (..., 2)")
        u = u - _shift(origin)
        y = (u[..., 1] - self.K[1, 2]) / self.K[1, 1]
        x = (u[..., 0] - self.K[0, 2] - self.K[0, 1] * y) / self.K[0, 0]
        return self.lens.undistort(np.stack((x, y), axis=-1))

    def unproject(self, pixels: ArrayLike, depth_m: ArrayLike, *, origin: Origin = "center") -> FloatArray:
        """World points (..., 3) seen at pixels (..., 2) with camera depth z."""
        xy = self.directions(pixels, origin=origin)
        z = np.asarray(depth_m, dtype=np.float64)
        local = np.concatenate((xy, np.ones(xy.shape[:-1] + (1,))), axis=-1) * z[..., None]
        result: FloatArray = (local - self.t) @ self.R
        return result

    def unproject_to_ground(self, pixels: ArrayLike, *, z_m: float = 0.0, origin: Origin = "center") -> FloatArray:
        """Points (..., 3) of the plane Z = z_m seen at pixels; NaN where the ray does not meet it."""
        xy = self.directions(pixels, origin=origin)
        ray = np.concatenate((xy, np.ones(xy.shape[:-1] + (1,))), axis=-1) @ self.R
        with np.errstate(all="ignore"):
            distance = (z_m - self.center[2]) / ray[..., 2]
            return np.where((distance > 0)[..., None], self.center + ray * distance[..., None], np.nan)

    def pinhole(self) -> Camera:
        """The same camera without its lens's distortion: that of undistorted images and points."""
        return Camera(self.width, self.height, self.K, self.R, self.t)

    def undistort_points(self, pixels: ArrayLike, *, origin: Origin = "center") -> FloatArray:
        """Pixels (..., 2) where pinhole() shows what this camera shows at the given ones."""
        return self._to_pixels(self.directions(pixels, origin=origin)) + _shift(origin)

    def undistort(self, image: NDArray[Any], *, interpolate: bool = True) -> NDArray[Any]:
        """The image (height, width, ...) as pinhole() takes it, 0 where the lens shows nothing.

        Use interpolate=False for labels, whose values must not be mixed.
        """
        if image.shape[:2] != (self.height, self.width):
            raise ValueError(f"image: found {image.shape[:2]}, expected {(self.height, self.width)}")
        rows, columns = np.mgrid[0 : self.height, 0 : self.width].astype(np.float64)
        plain = Camera(self.width, self.height, self.K)
        source = self._to_pixels(self.lens.distort(plain.directions(np.stack((columns, rows), axis=-1))))
        return _sample(image, source, interpolate)

    def _to_pixels(self, shown: FloatArray) -> FloatArray:
        x, y = shown[..., 0], shown[..., 1]
        return np.stack((self.K[0, 0] * x + self.K[0, 1] * y + self.K[0, 2], self.K[1, 1] * y + self.K[1, 2]), axis=-1)


def _shift(origin: Origin) -> float:
    if origin not in ("center", "corner"):
        raise ValueError(f'origin: found {origin!r}, expected "center" or "corner"')
    return 0.5 if origin == "corner" else 0.0


def _sample(image: NDArray[Any], at: FloatArray, interpolate: bool) -> NDArray[Any]:
    """The image at pixels (height, width, 2), 0 outside."""
    height, width = image.shape[:2]
    with np.errstate(invalid="ignore"):
        inside = (at[..., 0] > -0.5) & (at[..., 1] > -0.5) & (at[..., 0] < width - 0.5) & (at[..., 1] < height - 0.5)
    u, v = np.where(inside, at[..., 0], 0.0), np.where(inside, at[..., 1], 0.0)
    keep = inside.reshape(inside.shape + (1,) * (image.ndim - 2))
    if not interpolate:
        nearest = image[np.clip(np.rint(v).astype(int), 0, height - 1), np.clip(np.rint(u).astype(int), 0, width - 1)]
        return np.where(keep, nearest, 0).astype(image.dtype)
    left, top = np.floor(u).astype(int), np.floor(v).astype(int)
    fx, fy = (w.reshape(keep.shape) for w in (u - left, v - top))
    x0, x1 = np.clip(left, 0, width - 1), np.clip(left + 1, 0, width - 1)
    y0, y1 = np.clip(top, 0, height - 1), np.clip(top + 1, 0, height - 1)
    value = (image[y0, x0] * (1 - fx) + image[y0, x1] * fx) * (1 - fy) + (
        image[y1, x0] * (1 - fx) + image[y1, x1] * fx
    ) * fy
    if np.issubdtype(image.dtype, np.integer):
        value = np.rint(value)
    return np.where(keep, value, 0).astype(image.dtype)
