"""Exceptions of the package. All derive from ThrongError."""

from __future__ import annotations


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


class MissingPackageError(ThrongError, ImportError):
    """An optional package is needed for what was called; the message says how to install it."""
