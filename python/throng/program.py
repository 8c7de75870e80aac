"""The throng program on this machine: simulate, measure, compare, make datasets and studies."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Mapping, Sequence, Union

from ._job_base import Part, plain
from .dataset import Dataset
from .errors import ProgramError
from .trace import Trace

PathLike = Union[str, "os.PathLike[str]"]
JobLike = Union[Mapping[str, Any], Part]

LINUX_ONLY = "It runs on Linux only: elsewhere use its container (docs/container.md), or throng.Client with a service"


def find_program(program: PathLike | None = None) -> str:
    """The program's path: the argument, else $THRONG_PROGRAM, else throng in $PATH."""
    wanted = os.fspath(program) if program is not None else os.environ.get("THRONG_PROGRAM", "throng")
    found = shutil.which(wanted)
    if found is None:
        raise ProgramError(
            f"the program {wanted!r} was not found: build throng (README.md) and put it in $PATH, or name it "
            f"in $THRONG_PROGRAM{'' if sys.platform == 'linux' else '. ' + LINUX_ONLY}"
        )
    return os.path.abspath(found)


def call(
    arguments: Sequence[PathLike],
    *,
    program: PathLike | None = None,
    scenarios: PathLike | None = None,
    cwd: PathLike | None = None,
    quiet: bool = True,
) -> str:
    """Runs the program and returns what it printed; ProgramError with its message where it fails.

    scenarios is the folder that ids of scenarios are looked for in. quiet=False lets it draw its progress bar.
    """
    environment = dict(os.environ)
    if scenarios is not None:
        environment["THRONG_SCENARIOS"] = os.path.abspath(os.fspath(scenarios))
    command = [find_program(program), *(os.fspath(argument) for argument in arguments)]
    done = subprocess.run(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if quiet else None,
        encoding="utf-8",
        errors="replace",
        cwd=cwd,
        env=environment,
        check=False,
    )
    if done.returncode != 0:
        said = "\n".join(
            line for line in (done.stderr or "").splitlines() if line.startswith("throng: ") or " % " not in line
        )
        raise ProgramError(f"throng {arguments[0]}: {said.strip() or f'exit code {done.returncode}'}", done.returncode)
    return done.stdout


def run(
    job: JobLike,
    out: PathLike,
    *,
    program: PathLike | None = None,
    scenarios: PathLike | None = None,
    quiet: bool = False,
) -> Dataset:
    """Makes a job's dataset here and now: `throng run`. The same call goes on with a job that was interrupted."""
    with tempfile.TemporaryDirectory() as folder:
        call(
            ["run", _write_json(folder, job), "-o", os.path.abspath(os.fspath(out))],
            program=program,
            scenarios=scenarios,
            quiet=quiet,
        )
    return Dataset(Path(out) / "dataset")


def simulate(
    job: JobLike,
    trace: PathLike,
    *,
    run: int = 0,
    program: PathLike | None = None,
    scenarios: PathLike | None = None,
    quiet: bool = True,
) -> Trace:
    """Simulates one run of a job without drawing anything: `throng simulate`. trace is the file to write."""
    with tempfile.TemporaryDirectory() as folder:
        call(
            ["simulate", _write_json(folder, job), "-o", os.path.abspath(os.fspath(trace)), "--run", str(run)],
            program=program,
            scenarios=scenarios,
            quiet=quiet,
        )
    return Trace(trace)


def read_camera(file: PathLike, *, name: str = "", program: PathLike | None = None) -> dict[str, Any]:
    """The camera in a file of ROS (camera_info), OpenCV, Kalibr or COLMAP as a job takes it for a drone's
    `camera.calibration`: `throng calibrate camera`. name chooses one of several, such as "cam1"."""
    whole = os.path.abspath(os.fspath(file)) + (f"#{name}" if name else "")
    camera: dict[str, Any] = json.loads(call(["calibrate", "camera", whole], program=program))
    return camera


def metrics(
    trace: Trace | PathLike,
    *,
    scenario: PathLike | None = None,
    program: PathLike | None = None,
    scenarios: PathLike | None = None,
) -> Any:
    """Exits, clogs, escape and exposure of a trace (docs/metrics.md): `throng metrics`."""
    path = trace.path if isinstance(trace, Trace) else os.fspath(trace)
    more = [] if scenario is None else ["--scenario", os.fspath(scenario)]
    return json.loads(call(["metrics", path, *more], program=program, scenarios=scenarios))


def study(
    study: Mapping[str, Any] | PathLike,
    out: PathLike,
    *,
    runs: int = 0,
    program: PathLike | None = None,
    scenarios: PathLike | None = None,
    quiet: bool = False,
) -> Any:
    """Compares cases and policies over many paired runs (docs/study.md): `throng study`. Returns its
    summary.json."""
    more = ["--runs", str(runs)] if runs else []
    with tempfile.TemporaryDirectory() as folder:
        file = _write_json(folder, study) if isinstance(study, Mapping) else os.fspath(study)
        call(
            ["study", file, "-o", os.path.abspath(os.fspath(out)), *more],
            program=program,
            scenarios=scenarios,
            quiet=quiet,
        )
    summary = Path(out) / "summary.json"
    return json.loads(summary.read_text(encoding="utf-8"))


def validate_crowd(
    data: PathLike,
    *,
    models: Sequence[str] | None = None,
    experiments: Sequence[str] | None = None,
    seeds: int | None = None,
    constants: str | None = None,
    program: PathLike | None = None,
    quiet: bool = False,
) -> Any:
    """Compares pedestrian models with the recorded people of a folder (docs/validation.md): `throng validate-crowd
    --data`. Returns all values; those that were not reached or measured are None."""
    command: list[PathLike] = ["validate-crowd", "--data", os.fspath(data), "--json"]
    for option, names in (("--models", models), ("--experiments", experiments)):
        if names is not None:
            command += [option, ",".join(names)]
    if seeds is not None:
        command += ["--seeds", str(seeds)]
    if constants is not None:
        command += ["--constants", constants]
    return json.loads(call(command, program=program, quiet=quiet))


def _write_json(folder: str, value: Any) -> str:
    path = os.path.join(folder, "job.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(plain(value), file, allow_nan=False)
    return path
