"""Layouts of binary data and names that the program defines (layouts.json, which it writes)."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any, Sequence

import numpy as np

LAYOUTS: dict[str, Any] = json.loads(Path(__file__).with_name("layouts.json").read_text(encoding="utf-8"))

#: Bits of an agent's flags.
PRESENT, PANICKED, FALLEN, FOLLOWING = (
    int(LAYOUTS["agent_flags"][name]) for name in ("present", "panicked", "fallen", "following")
)
#: Names of agents' roles in the order of their numbers.
ROLES: tuple[str, ...] = tuple(sorted(LAYOUTS["agent_roles"], key=LAYOUTS["agent_roles"].__getitem__))


def record(fields: Sequence[tuple[str, str, int]]) -> np.dtype[Any]:
    """The type of a binary record."""
    return np.dtype([(name, kind) if count == 1 else (name, kind, count) for name, kind, count in fields])


def read_head(data: bytes, kind: np.dtype[Any]) -> Any:
    """The record at the beginning of the bytes; raises struct.error if there are too few."""
    if len(data) < kind.itemsize:
        raise struct.error(f"found {len(data)} bytes, expected at least {kind.itemsize}")
    return np.frombuffer(data, kind, 1)[0]
