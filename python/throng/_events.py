"""Server-Sent Events of a job or a study, with reconnection."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING, Any, BinaryIO, Iterator

from ._http import BROKEN, Http, pauses, query_string
from .errors import ConnectionFailedError, ServiceError

if TYPE_CHECKING:
    import http.client

ENDED = ("succeeded", "partial", "failed", "cancelled")
_MAX_LINE_BYTES = 1 << 20


def parse(stream: BinaryIO | http.client.HTTPResponse) -> Iterator[tuple[int | None, str, str]]:
    """(id, event, data) of each message; ends with the stream."""
    number: int | None = None
    kind = "message"
    data: list[str] = []
    while line := stream.readline(_MAX_LINE_BYTES):
        text = line.decode("utf-8", "replace").rstrip("\r\n")
        if not text:
            if data:
                yield number, kind, "\n".join(data)
            number, kind, data = None, "message", []
            continue
        field, _, value = text.partition(":")
        value = value.removeprefix(" ")
        if field == "id" and value.isdigit():
            number = int(value)
        elif field == "event":
            kind = value
        elif field == "data":
            data.append(value)


def follow(http: Http, path: str, after: int, deadline: float | None) -> Iterator[tuple[str, dict[str, Any]]]:
    """("progress", figures) and (type, event) of the job or study at `path` until it has ended, from the event after
    number `after` on.

    A connection that breaks, or a service that restarts, is met with new attempts for at most the client's patience.
    """
    last = after
    lost_since: float | None = None
    attempts = pauses()
    while True:
        try:
            headers = {"Accept": "text/event-stream", "Last-Event-ID": str(last)}
            left = None if deadline is None else max(0.05, deadline - time.monotonic())
            with http.open("GET", f"{path}/events", headers=headers, timeout_s=left) as response:
                if response.status != 200:
                    error = http.read_problem(response)
                    if response.status not in (502, 503, 504):
                        raise error
                    raise ConnectionFailedError(str(error))
                for number, kind, text in parse(response):
                    lost_since, attempts = None, pauses()
                    last = last if number is None else number
                    try:
                        yield kind, json.loads(text)
                    except ValueError:
                        raise ConnectionFailedError(f"{http.url}: found an event that is no JSON") from None
                    _check(deadline)
            # A stream ends when its job has, but a proxy may end one, too.
            state = http.request("GET", path).json()["state"]
            if state in ENDED:
                page = http.request("GET", f"{path}/events" + query_string({"after": last})).json()
                for event in page["events"]:
                    yield event["type"], event
                return
        except (*BROKEN, ConnectionFailedError) as error:
            if isinstance(error, ServiceError):
                raise
            _check(deadline)
            lost_since = time.monotonic() if lost_since is None else lost_since
            if time.monotonic() - lost_since > http.patience_s:
                raise ConnectionFailedError(
                    f"{http.url}: the connection broke and could not be made again: {error}"
                ) from error
        _check(deadline)
        time.sleep(next(attempts))


def _check(deadline: float | None) -> None:
    if deadline is not None and time.monotonic() > deadline:
        raise TimeoutError("the job or study has not ended in time")
