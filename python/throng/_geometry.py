"""Polygons and lines from lists, NumPy arrays, WKT, shapely and anything else with __geo_interface__."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import ScenarioError

Points = NDArray[np.float64]
_SAME_M = 1e-6
# A sharp corner's outer end would lie far away; it is cut off at so many thicknesses.
_MAX_MITRE = 4.0


@dataclass(frozen=True)
class Polygon:
    """Corners counter-clockwise and not repeated, holes likewise."""

    outer: Points
    holes: tuple[Points, ...] = ()


def read_polygon(value: Any, what: str) -> Polygon:
    kind, rings = _parts(value, what, "POLYGON")
    if kind != "Polygon" or not rings:
        raise ScenarioError(f"{what}: found a {kind or 'geometry'}, expected one polygon")
    return Polygon(
        _ring(rings[0], what), tuple(_ring(ring, f"{what}, hole {i + 1}") for i, ring in enumerate(rings[1:]))
    )


def read_line(value: Any, what: str) -> Points:
    """Two or more points."""
    kind, lines = _parts(value, what, "LINESTRING")
    if kind not in ("LineString", "Polygon") or len(lines) != 1:
        raise ScenarioError(f"{what}: found a {kind or 'geometry'}, expected one line")
    points = _points(lines[0], what)
    points = points[np.append(True, np.hypot(*np.diff(points, axis=0).T) > _SAME_M)]
    if len(points) < 2:
        raise ScenarioError(f"{what}: found a line without length, expected two or more points that differ")
    return points


def read_point(value: Any, what: str) -> tuple[float, float]:
    """One point."""
    if isinstance(value, str):
        match = re.fullmatch(r"\s*POINT\s*\(([^()]*)\)\s*", value, re.IGNORECASE)
        value = match[1].split() if match else value
    elif hasattr(value, "__geo_interface__"):
        value = value.__geo_interface__.get("coordinates")
    try:
        x, y = (float(c) for c in value[:2])
    except (TypeError, ValueError):
        raise ScenarioError(f"{what}: found {value!r}, expected a point (x, y)") from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise ScenarioError(f"{what}: found {value!r}, expected finite numbers")
    return x, y


def _parts(value: Any, what: str, wkt: str) -> tuple[str, list[Any]]:
    """The kind of a geometry as GeoJSON calls it, and its rings or lines."""
    if isinstance(value, str):
        return _parse_wkt(value, what)
    if hasattr(value, "__geo_interface__") or (isinstance(value, dict) and "coordinates" in value):
        geometry = value if isinstance(value, dict) else value.__geo_interface__
        kind, coordinates = str(geometry.get("type")), geometry.get("coordinates")
        if kind == "MultiPolygon" and coordinates is not None and len(coordinates) == 1:
            kind, coordinates = "Polygon", coordinates[0]
        if kind == "LinearRing":
            kind, coordinates = "Polygon", [coordinates]
        return kind, list(coordinates or []) if kind == "Polygon" else [coordinates]
    return ("Polygon" if wkt == "POLYGON" else "LineString"), [value]


def _parse_wkt(text: str, what: str) -> tuple[str, list[Any]]:
    match = re.fullmatch(
        r"\s*(?:SRID=\d+;)?\s*(POLYGON|LINESTRING)\s*(?:Z\s*)?(\(.*\))\s*", text, re.IGNORECASE | re.DOTALL
    )
    if match is None:
        raise ScenarioError(
            f"{what}: found {text[:60]!r}, expected WKT: POLYGON ((x y, ...), ...) or LINESTRING (x y, ...)"
        )
    is_polygon = match[1].upper() == "POLYGON"
    body = match[2].strip()
    rings = re.findall(r"\(([^()]*)\)", body)
    plain = "(" + ",".join(f"({ring})" for ring in rings) + ")" if is_polygon else f"({rings[0]})" if rings else ""
    if re.sub(r"\s", "", plain) != re.sub(r"\s", "", body):
        raise ScenarioError(f"{what}: found parentheses that do not match in {text[:60]!r}")
    try:
        lines = [[tuple(float(c) for c in point.split()) for point in ring.split(",")] for ring in rings]
    except ValueError:
        raise ScenarioError(f"{what}: found something that is no number in {text[:60]!r}") from None
    return ("Polygon" if is_polygon else "LineString"), lines


def _points(value: Any, what: str) -> Points:
    try:
        points = np.array([tuple(point)[:2] for point in value], dtype=np.float64)
    except (TypeError, ValueError):
        raise ScenarioError(f"{what}: found {str(value)[:60]}, expected points (x, y)") from None
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
        raise ScenarioError(f"{what}: found {str(value)[:60]}, expected points (x, y) of finite numbers")
    return points


def _ring(value: Any, what: str) -> Points:
    points = _points(value, what)
    points = points[np.hypot(*(points - np.roll(points, 1, axis=0)).T) > _SAME_M]
    if len(points) > 3:  # corners on a straight line are none: an exit may lie across them
        before, after = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
        sine = (before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]) / np.hypot(*before.T) / np.hypot(*after.T)
        points = points[(np.abs(sine) > 1e-9) | (np.sum(before * after, axis=1) < 0)]
    area = signed_area(points) if len(points) >= 3 else 0.0
    if abs(area) < 1e-4:
        raise ScenarioError(
            f"{what}: found {len(points)} different corners and an area of {abs(area):.4f} m2, expected a " "polygon"
        )
    if area < 0:
        points = points[::-1]
    if (crossing := _self_crossing(points)) is not None:
        raise ScenarioError(
            f"{what}: found edges {crossing[0]} and {crossing[1]} that cross, expected a simple polygon"
        )
    return points


def contains(polygon: Polygon, point: Sequence[float]) -> bool:
    """Whether a point is inside or on the edge of a polygon, its holes not regarded."""
    inside = False
    x, y = point[0], point[1]
    for a, b in zip(polygon.outer, np.roll(polygon.outer, -1, axis=0)):
        if along(a, b, point, 1e-6) is not None:
            return True
        if (a[1] > y) != (b[1] > y) and x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]):
            inside = not inside
    return inside


def signed_area(points: Points) -> float:
    x, y = points.T
    return float(0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _self_crossing(points: Points) -> tuple[int, int] | None:
    count = len(points)
    ends = np.roll(points, -1, axis=0)
    for i in range(count):
        for j in range(i + 2, count - (i == 0)):
            a, b, c, d = points[i], ends[i], points[j], ends[j]
            if _turn(a, b, c) * _turn(a, b, d) < 0 and _turn(c, d, a) * _turn(c, d, b) < 0:
                return i, j
    return None


def _turn(a: Points, b: Points, c: Points) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def right_normals(points: Points, closed: bool) -> Points:
    """Unit normals to the right of each edge: outward of a counter-clockwise ring."""
    edges = (np.roll(points, -1, axis=0) if closed else points[1:]) - (points if closed else points[:-1])
    result: Points = np.stack((edges[:, 1], -edges[:, 0]), axis=1) / np.hypot(*edges.T)[:, None]
    return result


def offset(points: Points, distance: float, closed: bool) -> Points:
    """Corners moved to the right so that edges move by distance; neighbors share their corners."""
    normals = right_normals(points, closed)
    before = np.roll(normals, 1, axis=0) if closed else np.concatenate((normals[:1], normals))
    after = normals if closed else np.concatenate((normals, normals[-1:]))
    total = before + after
    scale = distance / np.maximum(1 + np.sum(before * after, axis=1), 2 / _MAX_MITRE**2)
    result: Points = points + total * scale[:, None]
    return result


def along(a: Points, b: Points, point: Sequence[float], tolerance: float) -> float | None:
    """How far from a to b, m, a point of this segment is; None if it is farther off than tolerance."""
    edge = b - a
    length = float(np.hypot(*edge))
    local = np.asarray(point) - a
    at = float(local @ edge) / length
    off = abs(float(local[0] * edge[1] - local[1] * edge[0])) / length
    return min(max(at, 0.0), length) if off <= tolerance and -tolerance <= at <= length + tolerance else None
