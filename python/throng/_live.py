"""Live flights: a job's drones flown by commands, as they happen (docs/studio.md)."""

# Answers are JSON, which openapi.json describes and api_types.py names; nothing checks them once more.
# mypy: disable-error-code="no-any-return"

from __future__ import annotations

import http.client
import json
import struct
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _download
from ._bundle import PathLike
from ._http import BROKEN, Http, part, problem
from ._layouts import LAYOUTS, read_head, record
from .api_types import LiveFlight as LiveFlightAnswer
from .errors import ConnectionFailedError, ServiceError

_HEAD = struct.Struct("<cI")
_LIVE = LAYOUTS["live"]
_STATE, _IMAGE, _DRONE, _PERSON = (record(_LIVE[name]) for name in ("state_head", "image_head", "drone", "person"))


@dataclass(frozen=True)
class LiveState:
    """Everybody at the end of a step."""

    time_s: float
    #: Of the newest commands in force.
    sequence: int
    paused: bool
    #: Simulated seconds per second that are reached.
    factor: float
    #: Fields position (m), quaternion (w, x, y, z; body to world), speed_mps, flags (1 beacon, 2 on its mission, 4 rotors turn),
    #: gimbal_deg (pitch above the horizon, yaw to the left of the heading).
    drones: NDArray[Any]
    #: Fields position (m), yaw (1e-4 rad), state, flags (1 present, 2 in panic, 4 fallen, 8 follows a drone).
    people: NDArray[Any]


@dataclass(frozen=True)
class LiveImage:
    """A drone's camera."""

    time_s: float
    sequence: int
    drone: int
    jpeg: bytes


@dataclass(frozen=True)
class LiveMessage:
    """kind is hello, event, result or failure."""

    kind: str
    value: dict[str, Any]


_KINDS: dict[bytes, str] = {byte.encode(): name for byte, name in _LIVE["message_types"].items()}
Received = Union[LiveState, LiveImage, LiveMessage]


def read_message(kind: bytes, data: bytes) -> Received | None:
    """One message of the stream; None for a sign of life."""
    name = _KINDS.get(kind)
    if name == "state":
        head = read_head(data, _STATE)
        drones = np.frombuffer(data, _DRONE, int(head["drones"]), _STATE.itemsize)
        return LiveState(
            float(head["time_s"]),
            int(head["sequence"]),
            bool(head["flags"] & _LIVE["state_flags"]["paused"]),
            float(head["factor"]),
            drones,
            np.frombuffer(data, _PERSON, int(head["people"]), _STATE.itemsize + drones.nbytes),
        )
    if name == "image":
        head = read_head(data, _IMAGE)
        return LiveImage(float(head["time_s"]), int(head["sequence"]), int(head["drone"]), data[_IMAGE.itemsize :])
    return LiveMessage(name, json.loads(data)) if name in ("hello", "event", "result", "failure") else None


class LiveFlight:
    """A live flight of the service. Time runs while messages() is read.

    >>> flight = client.live(job)
    >>> for message in flight.messages():
    ...     if isinstance(message, throng.LiveState) and message.time_s < 20:
    ...         flight.fly("d1", velocity_mps=(3, 0, 0), yaw_rate_deg_s=20)
    ...     elif isinstance(message, throng.LiveState):
    ...         break
    >>> client.submit(flight.stop()["job"])
    """

    def __init__(self, service: Http, answer: LiveFlightAnswer) -> None:
        self._http = service
        self.id: str = answer["id"]
        self._name = part(self.id)
        self._lock = threading.Lock()
        self._connection: http.client.HTTPConnection | None = None

    def __enter__(self) -> LiveFlight:
        return self

    def __exit__(self, *_: object) -> None:
        self.remove()

    def state(self) -> LiveFlightAnswer:
        """The flight as the service has it."""
        return self._http.request("GET", f"/v1/live/{self._name}").json()

    def messages(self) -> Iterator[Received]:
        """All messages until the flight ends; of states and images those that there is time for."""
        try:
            with self._http.open("GET", f"/v1/live/{self._name}/stream") as response:
                if response.status != 200:
                    raise self._http.read_problem(response)
                while head := response.read(_HEAD.size):
                    kind, length = _HEAD.unpack(head)
                    if length > _LIVE["max_message_bytes"]:
                        raise ServiceError(200, "Unreadable answer", f"found a message of {length} bytes")
                    message = read_message(kind, response.read(length))
                    if message is not None:
                        yield message
        except BROKEN as broken:
            raise ConnectionFailedError(f"{self._http.url}: {broken}") from broken

    def fly(
        self,
        drone: str,
        *,
        velocity_mps: Sequence[float] | None = None,
        yaw_rate_deg_s: float | None = None,
        gimbal_deg: Sequence[float] | None = None,
        beacon: bool | None = None,
        return_home: bool | None = None,
        position_m: Sequence[float] | None = None,
        waypoints_m: Sequence[Sequence[float]] | None = None,
        yaw_deg: float | None = None,
        speed_mps: float | None = None,
        sequence: int | None = None,
    ) -> None:
        """Commands a drone: velocity ahead, to the left and up, to be repeated at least once per simulated second; or points
        of the world to fly to, and the heading there; gimbal_deg turns the camera (pitch above the horizon, yaw to the
        left of the heading).
        """
        one = {
            "id": drone,
            "velocity_mps": None if velocity_mps is None else list(velocity_mps),
            "yaw_rate_deg_s": yaw_rate_deg_s,
            "gimbal_deg": None if gimbal_deg is None else list(gimbal_deg),
            "beacon": beacon,
            "return_home": return_home,
            "position_m": None if position_m is None else list(position_m),
            "waypoints_m": None if waypoints_m is None else [list(point) for point in waypoints_m],
            "yaw_deg": yaw_deg,
            "speed_mps": speed_mps,
        }
        body: dict[str, Any] = {"drones": [{key: value for key, value in one.items() if value is not None}]}
        if sequence is not None:
            body["sequence"] = sequence
        self.command(body)

    def command(self, commands: Mapping[str, Any]) -> None:
        """Commands as POST /v1/live/{id}/commands takes them, over a connection that is kept."""
        body = json.dumps(commands, allow_nan=False).encode()
        with self._lock:
            for is_last in (False, True):
                if self._connection is None:
                    self._connection = self._http.kept_connection()
                try:
                    self._connection.request(
                        "POST",
                        self._http.path_of(f"/v1/live/{self._name}/commands"),
                        body,
                        self._http.headers({"Content-Type": "application/json"}),
                    )
                    answer = self._connection.getresponse()
                    data = answer.read()
                    break
                except BROKEN as broken:
                    # The service closes connections that rest for two seconds.
                    self._connection.close()
                    self._connection = None
                    if is_last:
                        raise ConnectionFailedError(f"{self._http.url}: {broken}") from broken
        if answer.status >= 400:
            raise problem(answer.status, answer.reason, data)

    def stop(self) -> dict[str, Any]:
        """Ends the flight: its job repeats it, drones have the pilot logs as CSV, trace_sha256 is the trace's."""
        answer = self._http.request("POST", f"/v1/live/{self._name}/stop", body=b"").json()
        if answer["error"]:
            raise ServiceError(200, "The flight failed", answer["error"]["message"])
        return answer["result"]

    def recording(self, path: PathLike) -> Path:
        """Downloads the recording (MCAP) of a flight that has ended, begun with record=True; returns its path."""
        _download.fetch(self._http, f"/v1/live/{self._name}/recording", Path(path), None)
        return Path(path)

    def remove(self) -> None:
        """Ends the flight without an outcome; nothing if there is none any more."""
        with self._lock:
            if self._connection is not None:
                self._connection.close()
                self._connection = None
        try:
            self._http.request("DELETE", f"/v1/live/{self._name}")
        except ServiceError as error:
            if error.status != 404:
                raise
