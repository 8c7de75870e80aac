"""Requests to the service: plain HTTP/1.1 by the standard library, problems as exceptions, retries where they are
safe."""

from __future__ import annotations

import http.client
import json
import logging
import secrets
import socket
import ssl
import time
from contextlib import contextmanager
from typing import Any, Iterator, Mapping, Sequence
from urllib.parse import quote, urlencode, urlsplit

from .errors import (
    AccessError,
    ConflictError,
    ConnectionFailedError,
    InvalidRequestError,
    Mistake,
    NotFoundError,
    ServiceError,
    UnavailableError,
)

_ERRORS: dict[int, type[ServiceError]] = {
    400: InvalidRequestError,
    413: InvalidRequestError,
    415: InvalidRequestError,
    422: InvalidRequestError,
    401: AccessError,
    403: AccessError,
    404: NotFoundError,
    409: ConflictError,
    429: UnavailableError,
    503: UnavailableError,
    507: UnavailableError,
}
BROKEN = (OSError, http.client.HTTPException)
_LOG = logging.getLogger("throng")
_MAX_PROBLEM_BYTES = 1 << 20


class Answer:
    def __init__(self, status: int, headers: Mapping[str, str], body: bytes) -> None:
        self.status = status
        self.headers = headers
        self.body = body

    def json(self) -> Any:
        try:
            return json.loads(self.body)
        except ValueError as error:
            raise ServiceError(self.status, "Unreadable answer", f"found no JSON: {error}") from error


class Http:
    """One connection per request, so that it can be used by several threads."""

    def __init__(
        self, url: str, key: str | None, timeout_s: float, patience_s: float, context: ssl.SSLContext | None
    ) -> None:
        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname or parts.query or parts.fragment:
            raise ValueError(f"url: found {url!r}, expected an address such as http://127.0.0.1:8080")
        if key is not None and not (key.isascii() and key.isprintable() and key):
            raise ValueError("key: found characters that no key has")
        self.url = url.rstrip("/")
        self._parts = parts
        self._key = key
        self._timeout_s = timeout_s
        self.patience_s = patience_s
        self._was_reached = False
        self._context = context

    def _connect(self, timeout_s: float) -> http.client.HTTPConnection:
        host, port = self._parts.hostname or "", self._parts.port
        if self._parts.scheme == "https":
            return http.client.HTTPSConnection(
                host, port, timeout=timeout_s, context=self._context or ssl.create_default_context()
            )
        return http.client.HTTPConnection(host, port, timeout=timeout_s)

    def kept_connection(self) -> http.client.HTTPConnection:
        """A connection for several requests, one after the other; the caller closes it."""
        return self._connect(self._timeout_s)

    def path_of(self, path: str) -> str:
        """A path of the service in requests."""
        return self._parts.path.rstrip("/") + path

    def headers(self, more: Mapping[str, str] | None = None) -> dict[str, str]:
        """Headers of a request, the key's included."""
        sent = dict(more or {})
        if self._key is not None:
            sent["Authorization"] = f"Bearer {self._key}"
        return sent

    @contextmanager
    def open(
        self,
        method: str,
        path: str,
        *,
        body: Any = None,
        headers: Mapping[str, str] | None = None,
        timeout_s: float | None = None,
    ) -> Iterator[http.client.HTTPResponse]:
        """One attempt. The response is that of any status; BROKEN exceptions pass through."""
        connection = self._connect(self._timeout_s if timeout_s is None else min(timeout_s, self._timeout_s))
        try:
            connection.request(method, self.path_of(path), body=body, headers=self.headers(headers))
            response = connection.getresponse()
            self._was_reached = True
            yield response
        finally:
            connection.close()

    def request(
        self,
        method: str,
        path: str,
        *,
        query: Mapping[str, Any] | None = None,
        body: bytes | None = None,
        json_body: Any = None,
        content_type: str = "application/json",
        headers: Mapping[str, str] | None = None,
        repeatable: bool | None = None,
    ) -> Answer:
        """The answer with a status below 400; others are raised.

        Requests that change nothing, or that are `repeatable`, are sent again while the connection fails or the service
        answers 503, for at most patience_s; a warning is logged. A service that was never reached and refuses the
        connection is not there: that is raised at once.
        """
        sent = dict(headers or {})
        if json_body is not None:
            body = json.dumps(json_body, allow_nan=False).encode()
        if body is not None:
            sent["Content-Type"] = content_type
        target = path + query_string(query)
        again = method in ("GET", "DELETE") if repeatable is None else repeatable
        deadline = time.monotonic() + self.patience_s
        is_said = False
        for pause in pauses():
            try:
                with self.open(method, target, body=body, headers=sent) as response:
                    data = response.read()
                    if response.status < 400:
                        return Answer(response.status, dict(response.headers.items()), data)
                    error: Exception = problem(response.status, response.reason, data)
                    if response.status != 503 or not again:
                        raise error
            except BROKEN as broken:
                error = ConnectionFailedError(f"{self.url}: {what(broken)}")
                error.__cause__ = broken
                if self.is_not_there(broken):
                    raise error
            if not again or time.monotonic() + pause > deadline:
                raise error
            if not is_said:
                _LOG.warning("%s; trying again for at most %g s", error, self.patience_s)
                is_said = True
            time.sleep(pause)
        raise AssertionError

    def is_not_there(self, error: BaseException) -> bool:
        """Whether nothing listens at the address, or it has none: a service that restarts has answered before."""
        return not self._was_reached and isinstance(error, (ConnectionRefusedError, socket.gaierror))

    def read_problem(self, response: http.client.HTTPResponse) -> ServiceError:
        return problem(response.status, response.reason, response.read(_MAX_PROBLEM_BYTES))


def pauses() -> Iterator[float]:
    """Seconds to wait before the next attempt: 0.1, 0.2, 0.4, ... 5, 5, ..."""
    pause = 0.1
    while True:
        yield pause
        pause = min(5.0, 2 * pause)


def query_string(query: Mapping[str, Any] | None) -> str:
    pairs: list[tuple[str, str]] = []
    for name, value in (query or {}).items():
        if value is None or value is False:
            continue
        for item in value if isinstance(value, (list, tuple)) else [value]:
            pairs.append((name, "1" if item is True else str(item)))
    return "?" + urlencode(pairs) if pairs else ""


def part(text: str) -> str:
    """Text as one segment of a path."""
    return quote(text, safe="")


def problem(status: int, reason: str, body: bytes) -> ServiceError:
    """The exception of a problem document, or of any other answer with this status."""
    try:
        document = json.loads(body)
    except ValueError:
        document = None
    if not isinstance(document, dict):
        document = {}
    mistakes: list[Mistake] = []
    for entry in document.get("errors") or []:
        if isinstance(entry, dict):
            texts = {key: str(entry.get(key, "")) for key in ("pointer", "found", "expected", "message")}
            texts["message"] = (
                texts["message"] or f"{texts['pointer']}: found {texts['found']}, expected {texts['expected']}"
            )
            mistakes.append(Mistake(**texts))
    kind = _ERRORS.get(status, ServiceError)
    return kind(status, str(document.get("title") or reason or "Error"), str(document.get("detail") or ""), mistakes)


def multipart(fields: Sequence[tuple[str, str | None, str, bytes]]) -> tuple[bytes, str]:
    """Body and content type of multipart/form-data: (name, file name, content type, content) of each part."""
    while True:
        boundary = "throng-" + secrets.token_hex(16)
        if not any(boundary.encode() in content for *_, content in fields):
            break
    body = bytearray()
    for name, file_name, content_type, content in fields:
        for text in (name, file_name or ""):
            if any(c in text for c in '"\r\n\\'):
                raise ValueError(f"{text!r}: found a quote, backslash or line break, expected a plain name")
        disposition = f'form-data; name="{name}"' + (f'; filename="{file_name}"' if file_name else "")
        body += f"--{boundary}\r\nContent-Disposition: {disposition}\r\nContent-Type: {content_type}\r\n\r\n".encode()
        body += content + b"\r\n"
    body += f"--{boundary}--\r\n".encode()
    return bytes(body), f"multipart/form-data; boundary={boundary}"


def what(error: BaseException) -> str:
    if isinstance(error, ConnectionRefusedError):
        return "the connection was refused: is the service running?"
    if isinstance(error, socket.gaierror):
        return f"the name of the host is not known ({error.strerror})"
    if isinstance(error, TimeoutError):
        return "no answer in time"
    return str(error) or type(error).__name__
