"""Positions of all people at some times of a run, as the service sends them (docs/api.md)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._layouts import LAYOUTS, read_head, record
from .errors import ServiceError

_LAYOUT = LAYOUTS["trajectories"]
_HEAD, _AGENT = record(_LAYOUT["head"]), record(_LAYOUT["agent"])


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
    head = read_head(data, _HEAD) if len(data) >= _HEAD.itemsize else None
    if head is None or head["version"] != _LAYOUT["version"]:
        raise ServiceError(200, "Unreadable answer", f"found no trajectories of version {_LAYOUT['version']}")
    times, agents = int(head["times"]), int(head["agents"])
    roles_at = _HEAD.itemsize + 8 * times
    if len(data) != roles_at + agents + times * agents * _AGENT.itemsize:
        raise ServiceError(200, "Unreadable answer", f"found {len(data)} bytes")
    time_s = np.frombuffer(data, "<f8", times, _HEAD.itemsize)
    role = np.frombuffer(data, np.uint8, agents, roles_at)
    packed = np.frombuffer(data, _AGENT, times * agents, roles_at + agents).reshape(times, agents)
    position = head["origin"].astype(np.float64) + float(head["step_m"]) * packed["position"].astype(np.float64)
    position[packed["position"][..., 0] == _LAYOUT["absent"]] = np.nan
    return Trajectories(time_s, role, position, packed["state"], packed["flags"])
