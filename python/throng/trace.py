"""A run's trace (docs/trace.md): positions of all people at every step, drones and events. Needs h5py."""

from __future__ import annotations

import json
import os
from contextlib import contextmanager
from functools import cached_property
from typing import Any, Iterator

import numpy as np
from numpy.typing import NDArray

from ._layouts import FALLEN, FOLLOWING, LAYOUTS, PANICKED, PRESENT, ROLES
from ._optional import require
from .errors import TraceError
from .tables import Table

FloatArray = NDArray[np.float64]
_VERSION = LAYOUTS["trace_version"]


def _read_crowd(attributes: dict[str, Any]) -> dict[str, Any]:
    """Origin of the people's motion: `model` ("recorded": a recording), `compat`, `hard_separation`, `constants`,
    `compliance`, `physical`, `fall_impulse_ns`; empty in traces of earlier versions."""
    if "crowd_model" not in attributes:
        return {}
    return {
        "model": _text(attributes["crowd_model"]),
        "compat": _text(attributes.get("crowd_compat", b"none")),
        "hard_separation": _number(attributes.get("crowd_hard_separation")) == 1,
        "constants": _text(attributes.get("crowd_constants", b"best")),
        "compliance": _number(attributes.get("crowd_compliance")),
        "physical": _number(attributes.get("crowd_physical")) == 1,
        "fall_impulse_ns": _number(attributes.get("crowd_fall_impulse_ns")),
    }


class Trace:
    """S steps of N agents. Arrays are read when they are asked for; the file is closed in between.

    >>> trace = Trace("run.h5")
    >>> trace.positions.shape, trace.present.sum(axis=1)
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.path.abspath(os.fspath(path))
        attributes = self._attributes()
        if _text(attributes.get("format", b"")) != "throng trace":
            raise TraceError(f'{self.path}: found no attribute format = "throng trace", expected a trace of throng')
        version = _number(attributes.get("version"))
        if version != _VERSION:
            raise TraceError(f"{self.path}: found version {version:g} of the trace file, expected {_VERSION}")
        self.scenario = _text(attributes.get("scenario_id", b""))
        self.generator = _text(attributes.get("generator", b""))
        seed = _number(attributes.get("seed"))
        self.seed = int(seed) if np.isfinite(seed) else 0
        self.dt_s = _number(attributes.get("dt_s"))
        self.crowd = _read_crowd(attributes)

    def __repr__(self) -> str:
        return f"Trace({self.scenario}: {len(self.time_s)} steps of {len(self.roles)} agents)"

    @contextmanager
    def _open(self, what: str = "") -> Iterator[Any]:
        """The file; whatever HDF5 finds wrong with it is a TraceError that names `what` was read."""
        h5py = require("h5py", "Trace")
        where = f"{self.path}: {what}" if what else self.path
        try:
            with h5py.File(self.path, "r") as file:
                yield file
        except FileNotFoundError:
            raise TraceError(f"{self.path}: found nothing there, expected a trace (HDF5)") from None
        except (OSError, RuntimeError, ValueError, AttributeError, KeyError, TypeError, OverflowError) as error:
            if isinstance(error, TraceError):
                raise
            raise TraceError(f"{where}: found a file that is damaged or no HDF5 ({error})") from error

    def _attributes(self) -> dict[str, Any]:
        with self._open() as file:
            return dict(file.attrs)

    def _read(self, name: str, dtype: Any = None) -> NDArray[Any]:
        with self._open(name) as file:
            if name not in file:
                raise TraceError(f"{self.path}: found no {name}, expected it in a trace")
            values: NDArray[Any] = np.asarray(file[name][()])
            return values if dtype is None else values.astype(dtype)

    def _crowd(self, name: str, dtype: Any, *more: int) -> NDArray[Any]:
        """A dataset of shape (S, N, *more)."""
        values = self._read(f"crowd/{name}", dtype)
        if values.shape != (*self._flags.shape, *more):
            expected = (*self._flags.shape, *more)
            raise TraceError(f"{self.path}: crowd/{name}: found the shape {values.shape}, expected {expected}")
        return values

    def _texts(self, name: str) -> list[str]:
        return [_text(value) for value in self._read(name)]

    @cached_property
    def time_s(self) -> FloatArray:
        """(S,)"""
        return self._read("crowd/time_s", np.float64)

    @cached_property
    def positions(self) -> FloatArray:
        """(S, N, 2) m; NaN while an agent is not there."""
        return np.where(self.present[..., None], self._crowd("position", np.float64, 2), np.nan)

    @cached_property
    def velocities(self) -> FloatArray:
        """(S, N, 2) m/s; NaN while an agent is not there."""
        return np.where(self.present[..., None], self._crowd("velocity", np.float64, 2), np.nan)

    @cached_property
    def headings(self) -> FloatArray:
        """(S, N) rad, counter-clockwise from +x; NaN while an agent is not there."""
        return np.where(self.present, self._crowd("yaw_rad", np.float64), np.nan)

    @cached_property
    def _flags(self) -> NDArray[np.uint8]:
        flags = self._read("crowd/flags", np.uint8)
        if flags.ndim != 2:
            raise TraceError(f"{self.path}: crowd/flags: found the shape {flags.shape}, expected steps x agents")
        return flags

    def _flag(self, bit: int) -> NDArray[np.bool_]:
        result: NDArray[np.bool_] = (self._flags & bit) != 0
        return result

    @property
    def present(self) -> NDArray[np.bool_]:
        """(S, N): has arrived and not left yet."""
        return self._flag(PRESENT)

    @property
    def panicking(self) -> NDArray[np.bool_]:
        return self._flag(PANICKED)

    @property
    def lying(self) -> NDArray[np.bool_]:
        return self._flag(FALLEN)

    @property
    def following(self) -> NDArray[np.bool_]:
        """(S, N): heads for the goal that a drone moves."""
        return self._flag(FOLLOWING)

    @cached_property
    def scenario_document(self) -> dict[str, Any]:
        """The scenario file without its crowd (docs/scenario.md); empty in traces of earlier versions."""
        with self._open("scenario") as file:
            text = bytes(file["scenario"][()]) if "scenario" in file else b"{}"
            document: dict[str, Any] = json.loads(text)
        return document

    @cached_property
    def state_names(self) -> list[str]:
        return self._texts("state_names")

    @cached_property
    def states(self) -> NDArray[np.uint8]:
        """(S, N) index into state_names."""
        return self._crowd("state", np.uint8)

    @cached_property
    def exit_ids(self) -> list[str]:
        return self._texts("exit_ids")

    @cached_property
    def exit_intents(self) -> NDArray[np.int8]:
        """(S, N) index into exit_ids, -1 for none."""
        return self._crowd("exit_intent", np.int8)

    @cached_property
    def roles(self) -> list[str]:
        """Of each agent: person, disaster, absent (not in this run), attacker or spectator."""
        return [ROLES[role] if role < len(ROLES) else str(role) for role in self._read("agents/role")]

    @cached_property
    def radii_m(self) -> FloatArray:
        return self._read("agents/radius_m", np.float64)

    @cached_property
    def preferred_speeds_mps(self) -> FloatArray:
        return self._read("agents/pref_speed_mps", np.float64)

    @cached_property
    def groups(self) -> NDArray[np.int32]:
        """Number of the social group of each agent, -1 for none."""
        return self._read("agents/group", np.int32)

    @cached_property
    def people(self) -> NDArray[np.int64]:
        """Numbers of the agents that are people of this run."""
        return np.array([i for i, role in enumerate(self.roles) if role == "person"], dtype=np.int64)

    @cached_property
    def drone_ids(self) -> list[str]:
        return self._texts("drone_ids")

    def drone(self, drone_id: str) -> dict[str, NDArray[Any]]:
        """time_s, position, velocity, orientation_wxyz, body_rates, specific_force, air_velocity, energy_j."""
        if drone_id not in self.drone_ids:
            raise KeyError(f"drone {drone_id!r}: there are {', '.join(self.drone_ids) or 'none'}")
        group = f"drones/{self.drone_ids.index(drone_id)}"
        with self._open(group) as file:
            names = list(file[group])
        return {name: self._read(f"{group}/{name}") for name in names}

    def events(self) -> Table:
        """Events by time: escapes, closed exits, collisions, ... (docs/trace.md)."""
        columns: dict[str, NDArray[Any]] = {}
        for name in ("time_s", "type", "agent", "drone", "value", "partner", "other", "extra"):
            values = self._read(f"events/{name}")
            columns[name] = np.array([_text(v) for v in values], dtype=np.str_) if values.dtype.kind in "SO" else values
        return Table(columns)

    def evacuation(self) -> tuple[FloatArray, NDArray[np.int64]]:
        """Times at which people first left the scenario's `inside`, sorted, and how many had by then. Escapes for good
        are in metrics.json (by_person)."""
        times = np.sort(self.events().where(type="agent_escaped")["time_s"].astype(np.float64))
        return times, np.arange(1, len(times) + 1)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row per person and step while they are there, as PedPy names it: id, frame, x, y;
        beside these time_s, vx, vy, state."""
        pandas = require("pandas", "to_pandas()")
        keep = self.present.copy()
        keep[:, [role not in ("person", "attacker", "spectator") for role in self.roles]] = False
        agent, step = np.nonzero(keep.T)
        position, velocity = self.positions[step, agent], self.velocities[step, agent]
        return pandas.DataFrame(
            {
                "id": agent,
                "frame": step,
                "x": position[:, 0],
                "y": position[:, 1],
                "time_s": self.time_s[step],
                "vx": velocity[:, 0],
                "vy": velocity[:, 1],
                "state": np.array(self.state_names)[self.states[step, agent]],
            }
        )

    def animate(self, **options: Any) -> Any:
        """A matplotlib animation of the trajectories; see throng.animate."""
        from .plotting import animate

        return animate(self, **options)


def _text(value: Any) -> str:
    return value.decode("utf-8", "replace").rstrip("\0") if isinstance(value, bytes) else str(value)


def _number(value: Any) -> Any:
    """An attribute that is one number; NaN otherwise."""
    return value.item() if isinstance(value, np.generic) and value.dtype.kind in "iuf" else np.nan
