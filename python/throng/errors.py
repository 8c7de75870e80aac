"""Exceptions of the package. All derive from ThrongError."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Sequence


class ThrongError(Exception):
    """Base class of every error that this package raises on purpose."""


class DatasetError(ThrongError, ValueError):
    """A dataset or one of its files is missing, damaged or not what it should be.

    The message names the file, for archives also the member, what was found and what was expected.
    """


class TraceError(ThrongError, ValueError):
    """A trace file is missing, damaged or of another version."""


class ScenarioError(ThrongError, ValueError):
    """A scenario that was built in code cannot be made."""


class ProgramError(ThrongError, RuntimeError):
    """The throng program was not found or failed.

    exit_code is that of the program (2: the input is wrong, 3: the machine failed), None where it was not started.
    """

    def __init__(self, message: str, exit_code: int | None = None) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class OutputFileError(ThrongError, OSError):
    """A file cannot be written where it was asked for, or something else is there already."""


class MissingPackageError(ThrongError, ImportError):
    """An optional package is needed for what was called; the message says how to install it."""


@dataclass(frozen=True)
class Mistake:
    """One error of a request: JSON pointer, the value found, the value expected."""

    pointer: str
    found: str
    expected: str
    message: str


class ServiceError(ThrongError):
    """The service answered with a problem (RFC 9457)."""

    def __init__(self, status: int, title: str, detail: str, errors: Sequence[Mistake] = ()) -> None:
        lines = [f"{status} {title}: {detail}" if detail else f"{status} {title}", *("  " + e.message for e in errors)]
        super().__init__("\n".join(lines))
        self.status = status
        self.title = title
        self.detail = detail
        self.errors = list(errors)


class InvalidRequestError(ServiceError, ValueError):
    """The request is invalid (400, 413, 415, 422); errors names each mistake."""


class AccessError(ServiceError):
    """The key is missing or unknown, or its scope does not allow this (401, 403)."""


class NotFoundError(ServiceError, LookupError):
    """There is no such job, file or scenario (404)."""


class ConflictError(ServiceError):
    """It cannot be done in the present state (409)."""


class UnavailableError(ServiceError):
    """Not now: a limit of the key, a full disk or a busy service (429, 503, 507)."""


class ConnectionFailedError(ThrongError, ConnectionError):
    """The service cannot be reached, or the connection broke and could not be made again."""


class JobFailedError(ThrongError):
    """A job that was watched has failed or was cancelled; `job` is its last state."""

    def __init__(self, message: str, job: Mapping[str, Any]) -> None:
        super().__init__(message)
        self.job = job
