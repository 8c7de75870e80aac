"""Positions of all people at some times of a run, as the service sends them (docs/api.md)."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .errors import ServiceError

_HEAD = struct.Struct("<IIIfff")
_PLACE = np.dtype([("x", "<u2"), ("y", "<u2"), ("state", "u1"), ("flags", "u1")])
_VERSION = 1
_ABSENT = 0xFFFF


@dataclass(frozen=True)
class Trajectories:
    """Arrays over (times, agents)."""

    time_s: NDArray[np.float64]
    role: NDArray[np.uint8]
    """Per agent: 0 a person, 1 a hazard, 2 absent, 3 an attacker."""
    position: NDArray[np.float64]
    """(times, agents, 2), m; NaN where an agent takes no part."""
    state: NDArray[np.uint8]
    flags: NDArray[np.uint8]
    """Bits: 1 takes part, 2 in panic, 4 fallen, 8 follows a drone."""


def read_trajectories(data: bytes) -> Trajectories:
    """Throws ServiceError where the bytes are none."""
    if len(data) < _HEAD.size or _HEAD.unpack_from(data)[0] != _VERSION:
        raise ServiceError(200, "Unreadable answer", "found no trajectories of version 1")
    _, times, agents, x, y, step = _HEAD.unpack_from(data)
    if len(data) != _HEAD.size + 8 * times + agents + times * agents * _PLACE.itemsize:
        raise ServiceError(200, "Unreadable answer", f"found {len(data)} bytes")
    time_s = np.frombuffer(data, "<f8", times, _HEAD.size)
    role = np.frombuffer(data, np.uint8, agents, _HEAD.size + 8 * times)
    packed = np.frombuffer(data, _PLACE, times * agents, _HEAD.size + 8 * times + agents).reshape(times, agents)
    position = np.stack([x + step * packed["x"].astype(np.float64), y + step * packed["y"].astype(np.float64)], axis=-1)
    position[packed["x"] == _ABSENT] = np.nan
    return Trajectories(time_s, role, position, packed["state"], packed["flags"])
