"""Places built in code: walls, areas, exits, groups; simulated by the throng program.

    hall = throng.Scenario("hall", "POLYGON ((0 0, 20 0, 20 10, 0 10))")
    hall.exit("door", (20, 4), (20, 6))
    hall.group([(1, 1), (8, 1), (8, 9), (1, 9)], count=60)
    trace = hall.simulate(to_s=60)

What is built is a blueprint (docs/blueprint.md), from which the program makes a scenario. Meters; x to the east, y to
the north. Polygons and lines are lists of (x, y), NumPy arrays, WKT, shapely's or GeoJSON's.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import tempfile
import warnings
import weakref
from pathlib import Path
from typing import Any, Iterator, Literal, Mapping, Sequence, Union

import numpy as np

from . import program as _program
from ._geometry import Points, along, contains, read_line, offset, read_point, read_polygon, right_normals, signed_area
from ._job_base import plain
from ._words import counted
from .dataset import Dataset
from .errors import ScenarioError
from .trace import Trace

PathLike = Union[str, "os.PathLike[str]"]
_ON_WALL_M = 0.02
_MARGIN_M = 15.0
_DRONE_HEIGHT_M = 60.0

Sampled = Union[float, Mapping[str, Any]]
"""A number that is sampled for each person, as docs/blueprint.md has it."""


class Scenario:
    """A scenario: ground, walls, exits, and the people in it.

    walkable is the floor: walls stand around it but for the exits, its holes are obstacles. People escape when they
    leave its bounding box. Methods return the scenario, so that calls can be chained.

    Speeds and pre-movement times are numbers, {"uniform": [low, high]}, {"normal": [mean, standard deviation]} or
    {"lognormal": [median, standard deviation of the logarithm]}; the latter two with "min" and "max".
    """

    def __init__(
        self,
        name: str,
        walkable: Any,
        *,
        walls: bool = True,
        wall_thickness_m: float = 0.3,
        wall_height_m: float = 2.5,
        ground: str = "concrete",
        speed_mps: Sampled | None = None,
        in_groups: float | None = None,
        pre_movement_s: Sampled | None = None,
        evacuation_speed_mps: Sampled | Literal["unchanged"] | None = None,
    ) -> None:
        if not re.fullmatch(r"[a-z0-9_]{1,60}", name):
            raise ScenarioError(f"name: found {name!r}, expected 1 to 60 letters a to z, digits and '_'")
        if not 0.05 <= wall_thickness_m <= 5:
            raise ScenarioError(f"wall_thickness_m: found {wall_thickness_m}, expected 0.05 to 5")
        self.name = name
        self.walkable = read_polygon(walkable, "walkable")
        self._walls = walls
        self._thickness = wall_thickness_m
        self._height = wall_height_m
        self._ground = ground
        people = {
            "speed_mps": speed_mps,
            "in_groups": in_groups,
            "pre_movement_s": pre_movement_s,
            "evacuation_speed_mps": evacuation_speed_mps,
        }
        self._people: dict[str, Any] = {key: plain(value) for key, value in people.items() if value is not None}
        self._exits: list[dict[str, Any]] = []
        self._blocks: list[tuple[str, Points, float]] = []
        self._lists: dict[str, list[dict[str, Any]]] = {"groups": [], "sources": [], "lines": []}
        self._disasters: list[dict[str, Any]] = []
        self._drones: list[dict[str, Any]] = []
        for i, hole in enumerate(self.walkable.holes):
            self._block(f"hole{i + 1}", hole, wall_height_m)

    def __repr__(self) -> str:
        people = sum(group["count"] for group in self._lists["groups"])
        return f"Scenario({self.name}: {counted(len(self._exits), 'exit')}, {counted(people, 'person', 'people')})"

    def exit(self, exit_id: str, start: Any, end: Any = None, *, open: bool = True) -> Scenario:
        """A door from one point to another on the edge of the walkable area; also a line: exit("a", "LINESTRING
        (...)")."""
        points = read_line(
            start if end is None else [read_point(start, "start"), read_point(end, "end")], f"exit {exit_id!r}"
        )
        if len(points) != 2:
            raise ScenarioError(f"exit {exit_id!r}: found {len(points)} points, expected two")
        if any(entry["id"] == exit_id for entry in self._exits):
            raise ScenarioError(f"exit {exit_id!r}: found twice, expected once")
        outward = self._outward_normal(points, exit_id)
        entry: dict[str, Any] = {"id": exit_id, "from": points[0].tolist(), "to": points[1].tolist()}
        if outward is not None:
            entry["outward"] = outward.tolist()
        if not open:
            entry["open"] = False
        self._exits.append(entry)
        return self

    def _outward_normal(self, points: Points, exit_id: str) -> Points | None:
        ring = self.walkable.outer
        for corner, after, normal in zip(ring, np.roll(ring, -1, axis=0), right_normals(ring, closed=True)):
            if all(along(corner, after, point, _ON_WALL_M) is not None for point in points):
                low, high = ring.min(axis=0), ring.max(axis=0)
                if not ((np.abs(points - low) < _ON_WALL_M) | (np.abs(points - high) < _ON_WALL_M)).all(axis=0).any():
                    warnings.warn(
                        f"exit {exit_id!r} does not lie on the bounding box of the walkable area: people count as "
                        "escaped only once they have left that box",
                        stacklevel=3,
                    )
                outward: Points = normal
                return outward
        if self._walls:
            raise ScenarioError(
                f"exit {exit_id!r}: found {points.tolist()}, expected both points on one edge of the walkable "
                f"area (within {_ON_WALL_M} m)"
            )
        return None

    def obstacle(self, polygon: Any, *, height_m: float | None = None) -> Scenario:
        """Something that nobody walks through; above 2.6 m it is drawn as a building."""
        shape = read_polygon(polygon, f"obstacle {len(self._blocks) + 1}")
        if shape.holes:
            raise ScenarioError("obstacle: found a polygon with holes, expected one without")
        return self._block(
            f"obstacle{len(self._blocks) + 1}", shape.outer, self._height if height_m is None else height_m
        )

    def wall(self, line: Any, *, thickness_m: float | None = None, height_m: float | None = None) -> Scenario:
        """A wall along a line of points, half its thickness to each side."""
        number = len(self._blocks) + 1
        points = read_line(line, f"wall {number}")
        half = (self._thickness if thickness_m is None else thickness_m) / 2
        left, right = offset(points, -half, closed=False), offset(points, half, closed=False)
        for i in range(len(points) - 1):
            self._block(
                f"wall{number}_{i + 1}",
                np.array([right[i], right[i + 1], left[i + 1], left[i]]),
                self._height if height_m is None else height_m,
            )
        return self

    def _block(self, name: str, corners: Points, height_m: float) -> Scenario:
        if signed_area(corners) <= 0:
            raise ScenarioError(
                f"{name}: found an edge that is shorter than the wall is thick, expected longer edges or a "
                "smaller thickness"
            )
        self._blocks.append((name, corners, height_m))
        return self

    def group(
        self,
        area: Any = None,
        *,
        count: int,
        doing: Literal["leave", "stroll", "wait", "cross", "watch"] = "leave",
        **more: Any,
    ) -> Scenario:
        """People who are there from the start, at random on the free ground of an area (default: all of it).

        leave: go to the exit that looks fastest; stroll: from spot to spot; wait: stand; watch: stand before
        a show, clap and cheer; cross: to an exit by chance. more is as docs/blueprint.md has it, for example
        facing={"towards": [0, 5]}.
        """
        if count < 1:
            raise ScenarioError(f"count: found {count}, expected 1 or more")
        shape = self.walkable if area is None else read_polygon(area, f"group {len(self._lists['groups']) + 1}")
        for corner in shape.outer:
            if self._walls and not contains(self.walkable, corner):
                raise ScenarioError(
                    f"group {len(self._lists['groups']) + 1}: found the corner {corner.tolist()} of its area, "
                    "expected all within the walkable area"
                )
        self._lists["groups"].append({"doing": doing, "area": shape.outer.tolist(), "count": int(count), **plain(more)})
        return self

    def source(
        self,
        *,
        exit: str | None = None,
        line: Any = None,
        per_minute: float | None = None,
        table: Sequence[Sequence[float]] | None = None,
        doing: str = "cross",
        towards: str | None = None,
        until_s: float | None = None,
        speed_mps: Sampled | None = None,
    ) -> Scenario:
        """People who come in by an exit or across a line: per_minute of them (Poisson), or a table of [seconds,
        people]."""
        entry: dict[str, Any] = {
            "doing": doing,
            "exit": exit,
            "per_minute": per_minute,
            "table": plain(table),
            "towards": towards,
            "until_s": until_s,
            "speed_mps": plain(speed_mps),
        }
        if line is not None:
            points = read_line(line, "source")
            entry.update({"from": points[0].tolist(), "to": points[-1].tolist()})
        self._lists["sources"].append({key: value for key, value in entry.items() if value is not None})
        return self

    def queue(self, line: Any, *, count: int, **more: Any) -> Scenario:
        """People who stand in line; its head is the line's first point. more is as docs/blueprint.md has it."""
        points = read_line(line, "queue")
        self._lists["lines"].append(
            {"from": points[0].tolist(), "to": points[-1].tolist(), "count": int(count), **plain(more)}
        )
        return self

    def disaster(
        self,
        kind: Literal["explosion", "fire", "attacker", "collapse", "gas"],
        position: Any,
        *,
        start_s: float = 0.0,
        **more: Any,
    ) -> Scenario:
        """Something that people flee from; more is as docs/blueprint.md has it, for example radius_m=3."""
        self._disasters.append(
            {"kind": kind, "position": list(read_point(position, kind)), "start_s": start_s, **plain(more)}
        )
        return self

    def drone(self, drone_id: str, start: Sequence[float], *, yaw_deg: float = 0.0) -> Scenario:
        """A drone that jobs of this scenario fly; without any, one hovers high above when it is simulated."""
        self._drones.append({"id": drone_id, "start": [float(c) for c in start], "yaw_deg": yaw_deg})
        return self

    @property
    def obstacles(self) -> list[Points]:
        """Corners of everything that stands in the way, walls included; for animate(obstacles=...)."""
        return [corners for _, corners, _ in [*self._blocks, *self._wall_pieces()]]

    def _wall_pieces(self) -> list[tuple[str, Points, float]]:
        if not self._walls:
            return []
        inner = self.walkable.outer
        outer = offset(inner, self._thickness, closed=True)
        pieces: list[tuple[str, Points, float]] = []
        for i in range(len(inner)):
            a, b, a_out, b_out = (ring[j % len(inner)] for ring in (inner, outer) for j in (i, i + 1))
            length = float(np.hypot(*(b - a)))
            direction = (b - a) / length
            normal = np.array([direction[1], -direction[0]]) * self._thickness
            gaps = sorted(self._gaps(a, b))
            at, begin = 0.0, (a, a_out)
            for low, high in [*gaps, (length, length)]:
                stop = (a + direction * low, a + direction * low + normal) if low < length else (b, b_out)
                if low - at > 1e-3:
                    corners = np.array([begin[0], begin[1], stop[1], stop[0]])
                    if signed_area(corners) <= 0:
                        raise ScenarioError(
                            f"walkable: found an edge of {length:.2f} m at {a.tolist()}, expected edges that "
                            f"are longer than the walls are thick ({self._thickness} m)"
                        )
                    pieces.append((f"edge{i + 1}_{len(pieces) + 1}", corners, self._height))
                at, begin = max(at, high), (a + direction * high, a + direction * high + normal)
        return pieces

    def _gaps(self, a: Points, b: Points) -> Iterator[tuple[float, float]]:
        """From where to where, m from a, exits are in the edge from a to b."""
        for entry in self._exits:
            first, second = (along(a, b, entry[key], _ON_WALL_M) for key in ("from", "to"))
            if first is not None and second is not None:
                yield min(first, second), max(first, second)

    def blueprint(self) -> dict[str, Any]:
        """The scenario as docs/blueprint.md describes it."""
        if not self._exits:
            raise ScenarioError("exits: found none, expected at least one")
        low, high = self.walkable.outer.min(axis=0), self.walkable.outer.max(axis=0)
        blueprint: dict[str, Any] = {
            "name": self.name,
            "ground": {"min": (low - _MARGIN_M).tolist(), "max": (high + _MARGIN_M).tolist(), "material": self._ground},
            "inside": {"min": low.tolist(), "max": high.tolist()},
            "exits": self._exits,
            "buildings": [
                {"id": name, "footprint": corners.tolist(), "height_m": height}
                for name, corners, height in [*self._blocks, *self._wall_pieces()]
            ],
            "people": {**self._people, **{key: entries for key, entries in self._lists.items() if entries}},
        }
        if self._disasters:
            blueprint["disasters"] = self._disasters
        if self._drones:
            blueprint["drones"] = self._drones
        return blueprint

    def write(self, folder: PathLike, *, program: PathLike | None = None) -> Path:
        """Writes NAME.blueprint.json, and with the program the scenario's files, into a folder; returns NAME.json there.

        ProgramError says what of it the program refuses.
        """
        out = Path(folder)
        out.mkdir(parents=True, exist_ok=True)
        file = out / f"{self.name}.blueprint.json"
        file.write_text(json.dumps(self.blueprint(), indent=1), encoding="utf-8")
        _program.call(["scenario", "make", file, "-o", out], program=program)
        return out / f"{self.name}.json"

    def check(self, *, program: PathLike | None = None) -> str:
        """Output of `throng scenario check`; ProgramError where it finds errors."""
        with tempfile.TemporaryDirectory() as folder:
            return _program.call(["scenario", "check", self.write(folder, program=program)], program=program)

    def plan(self, path: PathLike, *, program: PathLike | None = None) -> Path:
        """Draws the floor plan to an .svg, .png or .pdf file."""
        with tempfile.TemporaryDirectory() as folder:
            _program.call(
                ["scenario", "plan", self.write(folder, program=program), "-o", os.path.abspath(os.fspath(path))],
                program=program,
            )
        return Path(path)

    def simulate(
        self,
        *,
        to_s: float = 60.0,
        seed: int = 1,
        model: str | None = None,
        job: Mapping[str, Any] | None = None,
        trace: PathLike | None = None,
        program: PathLike | None = None,
    ) -> Trace:
        """Simulates one run without drawing anything.

        model is a pedestrian model of `throng crowd --list` (default: ttc). job holds more fields of a job, such
        as {"crowd": {"agents": 20}}. The trace is kept in the file `trace`, else in a temporary one for as long as the
        Trace is.
        """
        folder = tempfile.mkdtemp(prefix="throng-")
        try:
            self.write(folder, program=program)
            file = os.path.join(folder, "trace.h5") if trace is None else os.path.abspath(os.fspath(trace))
            result = _program.simulate(self._job(to_s, seed, model, job), file, program=program, scenarios=folder)
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        if trace is None:
            weakref.finalize(result, shutil.rmtree, folder, ignore_errors=True)
        else:
            shutil.rmtree(folder, ignore_errors=True)
        return result

    def run(
        self,
        out: PathLike,
        *,
        job: Mapping[str, Any] | None = None,
        program: PathLike | None = None,
        quiet: bool = False,
    ) -> Dataset:
        """Makes a dataset of this scenario: job holds the fields of docs/job.md but for the scenario."""
        with tempfile.TemporaryDirectory() as folder:
            self.write(folder, program=program)
            return _program.run(
                {**plain(job or {}), "scenario": self.name}, out, program=program, scenarios=folder, quiet=quiet
            )

    def metrics(self, trace: Trace, *, program: PathLike | None = None) -> Any:
        """Exits, clogs and evacuation of a trace of this scenario (docs/metrics.md)."""
        with tempfile.TemporaryDirectory() as folder:
            return _program.metrics(
                trace, scenario=self.write(folder, program=program), program=program, scenarios=folder
            )

    def _job(self, to_s: float, seed: int, model: str | None, more: Mapping[str, Any] | None) -> dict[str, Any]:
        job: dict[str, Any] = dict(plain(more or {}))
        job["scenario"], job["seed"] = self.name, seed
        job["capture"] = {**job.get("capture", {}), "to_s": to_s}
        if model is not None:
            job["crowd"] = {**job.get("crowd", {}), "model": model}
        if not self._drones and "drones" not in job:
            middle = (self.walkable.outer.min(axis=0) + self.walkable.outer.max(axis=0)) / 2
            job["drones"] = [{"id": "view", "start": [*middle.tolist(), _DRONE_HEIGHT_M]}]
        return job
