"""A client of Foxglove's WebSocket protocol (foxglove.websocket.v1), as the ROS nodes of this folder need it.

It needs websocket-client (Debian: python3-websocket).
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import dataclasses
import json
import struct
import threading
from typing import Any, Callable

import websocket

SUBPROTOCOL = "foxglove.websocket.v1"
DEFAULT_URL = "ws://localhost:8765"  # of `throng live`
GREETING_TIMEOUT_S = 30
CLOSE_TIMEOUT_S = 5
NORMAL_CLOSES = (websocket.STATUS_NORMAL, websocket.STATUS_GOING_AWAY)


@dataclasses.dataclass(frozen=True)
class Channel:
    """A topic that the server publishes."""

    id: int
    topic: str
    schema_name: str  # such as nav_msgs/msg/Odometry
    schema: str  # its definition, in the text of ros2msg


class FoxgloveClient:
    """A connection. Commands and services may be sent on any thread, the rest belongs to one."""

    def __init__(self, url: str) -> None:
        """Connects; raises ConnectionError. Messages come after start()."""
        self.url = url
        self.channels: dict[str, Channel] = {}  # by topic
        self.services: dict[str, int] = {}  # ids by name
        self.problem = "an error in this program"  # why the connection has ended; empty if the server closed it
        self._subscribed: set[str] = set()
        self._advertised: dict[str, int] = {}  # ids of this client's channels by topic
        self._calls: dict[int, concurrent.futures.Future[tuple[bool, str]]] = {}
        self._called = 0
        self._lock = threading.Lock()
        self._ended = threading.Event()
        try:
            # An origin is the business of web pages: a server on another machine would refuse it.
            self._socket = websocket.create_connection(
                url,
                timeout=GREETING_TIMEOUT_S,
                subprotocols=[SUBPROTOCOL],
                suppress_origin=True,
                enable_multithread=True,
            )
            while not self.services:
                self._take_greeting(json.loads(self._socket.recv()))
            self._socket.settimeout(None)
        except (OSError, ValueError, websocket.WebSocketException) as error:
            raise ConnectionError(f"cannot connect to {url}: {error}; is `throng live` running there?") from error

    def _take_greeting(self, message: dict[str, Any]) -> None:
        for each in message.get("channels", []):
            channel = Channel(each["id"], each["topic"], each["schemaName"], each["schema"])
            self.channels[channel.topic] = channel
        for each in message.get("services", []):
            self.services[each["name"]] = each["id"]

    def start(self, on_message: Callable[[Channel, bytes], None], on_status: Callable[[int, str], None]) -> None:
        """Begins to read, on a thread of its own.

        on_message gets messages of topics in CDR, on_status a level (0 information, 1 warning, 2 error) and a text.
        """
        self._thread = threading.Thread(target=self._read, args=(on_message, on_status), daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Ends the connection; no message comes afterwards."""
        with contextlib.suppress(OSError):  # it has ended
            self._socket.abort()
        self._thread.join(CLOSE_TIMEOUT_S)

    def wait(self, timeout_s: float) -> bool:
        """Whether the connection has ended; `problem` says why."""
        return self._ended.wait(timeout_s)

    def drones(self) -> list[str]:
        """Names of drones as topics have them."""
        ending = "/odometry"
        return [topic[1 : -len(ending)] for topic in self.channels if topic.endswith(ending)]

    def subscribe_to(self, topics: set[str]) -> None:
        """Subscribes to these topics, and to no others."""
        added = [self.channels[topic].id for topic in topics - self._subscribed]
        removed = [self.channels[topic].id for topic in self._subscribed - topics]
        self._subscribed = set(topics)
        if added:
            self._send_json(op="subscribe", subscriptions=[{"id": each, "channelId": each} for each in added])
        if removed:
            self._send_json(op="unsubscribe", subscriptionIds=removed)

    def publish(self, topic: str, data: bytes, encoding: str = "json", schema_name: str = "") -> None:
        """Publishes a command; topics are advertised with their first one."""
        with self._lock:
            if topic not in self._advertised:
                self._advertised[topic] = len(self._advertised)
                channel = {"id": self._advertised[topic], "topic": topic, "encoding": encoding}
                self._send_json(op="advertise", channels=[{**channel, "schemaName": schema_name}])
            self._send(struct.pack("<BI", 1, self._advertised[topic]) + data)

    def call(self, service: str) -> tuple[bool, str]:
        """Calls a service without arguments; returns whether it succeeded, and its message."""
        answer: concurrent.futures.Future[tuple[bool, str]] = concurrent.futures.Future()
        with self._lock:
            if self._ended.is_set():
                return False, "the connection has ended"
            self._called += 1
            call = self._called
            self._calls[call] = answer
        encoding, request = b"json", b"{}"
        head = struct.pack("<BIII", 2, self.services[service], call, len(encoding))
        self._send(head + encoding + request)
        return answer.result()

    def _send_json(self, **message: Any) -> None:
        self._send(json.dumps(message))

    def _send(self, message: str | bytes) -> None:
        binary = isinstance(message, bytes)
        with contextlib.suppress(OSError, websocket.WebSocketException):  # the thread that reads sees it, too
            self._socket.send(message, websocket.ABNF.OPCODE_BINARY if binary else websocket.ABNF.OPCODE_TEXT)

    def _read(self, on_message: Callable[[Channel, bytes], None], on_status: Callable[[int, str], None]) -> None:
        by_id = {channel.id: channel for channel in self.channels.values()}
        try:
            while True:
                opcode, data = self._socket.recv_data()
                if opcode == websocket.ABNF.OPCODE_CLOSE:
                    code = int.from_bytes(data[:2], "big")
                    self.problem = "" if code in NORMAL_CLOSES else f"the server has closed it with code {code}"
                    return
                if opcode == websocket.ABNF.OPCODE_TEXT:
                    self._take_text(json.loads(data), on_status)
                elif data[0] == 1:
                    (subscription,) = struct.unpack_from("<I", data, 1)  # the channel's id; the time follows
                    on_message(by_id[subscription], data[13:])
                elif data[0] == 3:
                    _, call, encoding_bytes = struct.unpack_from("<III", data, 1)
                    answer = json.loads(data[13 + encoding_bytes :])
                    self._calls.pop(call).set_result((answer["success"], answer["message"]))
        except (OSError, websocket.WebSocketException) as error:
            self.problem = str(error)
        finally:
            self._socket.shutdown()  # the server waits for that
            with self._lock:
                self._ended.set()
            for answer in self._calls.values():
                answer.set_result((False, "the connection has ended"))

    def _take_text(self, message: dict[str, Any], on_status: Callable[[int, str], None]) -> None:
        if message["op"] == "status":
            on_status(message["level"], message["message"])
        elif message["op"] == "serviceCallFailure":
            self._calls.pop(message["callId"]).set_result((False, message["message"]))
