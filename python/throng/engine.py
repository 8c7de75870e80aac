"""The engine in this process: a job's run simulated step by step, with arrays that show its own memory."""

# The module of Python is compiled (python/engine) and has no types.
# mypy: disable-error-code="no-any-return"

from __future__ import annotations

import importlib
import json
import os
import sys
from pathlib import Path
from typing import Any, Mapping, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._job_base import Part, plain
from ._layouts import FALLEN as FALLEN, FOLLOWING as FOLLOWING, PANICKED as PANICKED, PRESENT as PRESENT
from .errors import MissingPackageError, ThrongError
from .program import LINUX_ONLY, find_program

JobLike = Union[Mapping[str, Any], Part, str, "os.PathLike[str]"]


class EngineError(ThrongError, ValueError):
    """The job or a command is wrong; the message names what was found and what was expected."""


def _resources(program: Path) -> None:
    """Scenarios and characters of the installed program, which the engine looks for beside its process's program."""
    for variable, name in (("THRONG_SCENARIOS", "scenarios"), ("THRONG_PEOPLE", "people")):
        folder = program.parent.parent / "share/throng" / name
        if folder.is_dir():
            os.environ.setdefault(variable, str(folder))


def _load() -> Any:
    try:
        return importlib.import_module("throng_engine")
    except ImportError:
        pass
    if sys.platform != "linux":
        raise MissingPackageError(f"Simulation and Env need the engine. {LINUX_ONLY}")
    program = Path(find_program()).resolve()
    folder = program.parent.parent / "lib/throng/python"
    sys.path.append(str(folder))
    try:
        module = importlib.import_module("throng_engine")
    except ImportError as error:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise MissingPackageError(
            f"the engine was not found in {folder} for Python {version}: {error}; it is built with throng for the Python "
            "of the system (/usr/bin/python3)"
        ) from error
    finally:
        sys.path.remove(str(folder))
    _resources(program)
    return module


def job_text(job: JobLike) -> tuple[str, str]:
    """The job's JSON and its name in messages."""
    if isinstance(job, (str, os.PathLike)):
        path = Path(job)
        try:
            return path.read_text(encoding="utf-8-sig"), str(path)
        except UnicodeDecodeError as error:
            raise EngineError(f"{path}: found bytes that are no UTF-8 ({error}), expected a job in JSON") from None
    return json.dumps(plain(job)), "job"


class Simulation:
    """The first run of a job, in steps of dt_s.

    Without `remote` the drones fly as the job says, and the trace is that of `throng simulate`, byte for byte. With it
    they follow the commands of step().

    >>> simulation = throng.engine.Simulation("scenarios/city_square/demo.job.json", seed=3)
    >>> while not simulation.is_over:
    ...     simulation.step()
    ...     inside = simulation.present.sum()

    positions, velocities, yaws, flags and drones are read-only views of the engine's memory: they show the newest step,
    and keep showing it after further ones. Copy what should last.
    """

    def __init__(
        self,
        job: JobLike,
        *,
        seed: int | None = None,
        remote: bool = False,
        trace: str | os.PathLike[str] | None = None,
        image_size: tuple[int, int] = (320, 180),
        threads: int = 1,
    ) -> None:
        """`threads` share the work of a step; crowds of thousands are quicker with several. Results do not depend on it."""
        if threads < 1:
            raise EngineError(f"threads: found {threads}, expected 1 or more")
        module = _load()
        text, source = job_text(job)
        self._errors = (module.InputError, module.EnvironmentError)
        self._size = (int(image_size[0]), int(image_size[1]))
        self._remote = remote
        try:
            # Paths as bytes: those that the locale cannot name have no str that the engine could take.
            paths = os.fsencode(source), b"" if trace is None else os.fsencode(trace)
            self._run = module.SteppedJob(text, paths[0], seed, remote, paths[1], *self._size, threads)
        except self._errors as error:
            raise EngineError(str(error)) from None
        #: Meters, one row per agent (n, 2).
        self.positions: NDArray[np.float32] = self._run.positions
        #: Meters per second (n, 2).
        self.velocities: NDArray[np.float32] = self._run.velocities
        #: Headings in rad, counter-clockwise from +x (n,).
        self.yaws: NDArray[np.float32] = self._run.yaws
        #: PRESENT | PANICKED | FALLEN | FOLLOWING (n,).
        self.flags: NDArray[np.uint8] = self._run.flags
        #: Index into exit_ids of the exit that each one heads for, -1: none (n,).
        self.exit_intents: NDArray[np.int8] = self._run.exit_intents
        #: Position (m), velocity (m/s), orientation (w, x, y, z; body to world), body rates (rad/s); (drones, 13).
        self.drones: NDArray[np.float64] = self._run.drones
        #: The area that people leave (m): [[x, y] of its south-west corner, of its north-east corner].
        self.area: NDArray[np.float64] = np.array(self._run.area).reshape(2, 2)
        #: Whether each agent is a person, and not a danger (n,).
        self.is_person: NDArray[np.bool_] = np.isin(self._run.roles, (0, 3, 4))

    @property
    def dt_s(self) -> float:
        """Seconds per step."""
        return self._run.dt_s

    @property
    def time_s(self) -> float:
        return self._run.time_s

    @property
    def duration_s(self) -> float:
        """Of the job's run."""
        return self._run.duration_s

    @property
    def is_over(self) -> bool:
        """Whether the job's duration has passed; further steps are possible."""
        return self._run.is_over

    @property
    def drone_ids(self) -> list[str]:
        return self._run.drone_ids

    @property
    def exit_ids(self) -> list[str]:
        return self._run.exit_ids

    @property
    def present(self) -> NDArray[np.bool_]:
        """Whether each agent is a person who has arrived and not left (n,)."""
        return ((self.flags & PRESENT) != 0) & self.is_person

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Whether each agent is a person who is present and in the area that people leave (n,)."""
        within = (self.positions >= self.area[0]) & (self.positions <= self.area[1])
        return self.present & within.all(axis=1)

    def step(self, commands: ArrayLike | None = None, steps: int = 1) -> None:
        """Simulates steps, with one row of commands per drone if `remote`, which hold for all of them.

        A row is: velocity ahead, to the left and up in the drone's heading (m/s), yaw rate (rad/s, counter-clockwise),
        and whether its beacon is on (above 0); rows of 7 also turn the camera: its pitch above the horizon and its yaw to
        the left of the heading (rad), which a gimbal follows at 60 degrees/s.
        """
        try:
            if self._remote:
                rows = np.zeros((len(self.drones), 5)) if commands is None else np.asarray(commands, dtype=np.float64)
                self._run.step_by(np.atleast_2d(rows), int(steps))
            elif commands is not None:
                raise EngineError("commands, but the drones fly as the job says: Simulation(..., remote=True)")
            else:
                self._run.step(int(steps))
        except self._errors as error:
            raise EngineError(str(error)) from None

    def events(self) -> list[dict[str, Any]]:
        """The events since the last call, as the rows of a trace (docs/trace.md): time_s, type, agent, drone, value, ..."""
        return self._run.take_events()

    def image(self, drone: int | str = 0) -> NDArray[np.uint8]:
        """The view of a drone's camera now, in draft quality: (height, width, 3), RGB."""
        number = self.drone_ids.index(drone) if isinstance(drone, str) else int(drone)
        width, height = self._size
        try:
            return self._run.image(number, width, height)
        except self._errors as error:
            raise EngineError(str(error)) from None

    def finish(self) -> list[str]:
        """Ends the run, completes its trace and returns warnings. No step is possible afterwards."""
        return self._run.finish()

    def flown_job(self) -> dict[str, Any]:
        """The job that repeats the commands so far: `throng simulate` gives the same trace from it."""
        if not self._remote:
            raise EngineError("only flights by commands are repeated by another job: Simulation(..., remote=True)")
        return json.loads(self._run.flown_job())
