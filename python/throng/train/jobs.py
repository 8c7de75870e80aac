"""Datasets of jobs that the command makes itself, and jobs that sample less, for ablations."""

from __future__ import annotations

import copy
import json
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .. import _job_file, program
from .._frame_list import SUFFIX
from ..dataset import Dataset

_DISTRIBUTIONS = ("choice", "uniform", "log_uniform", "normal")
# Paths of fields, as manifests name them, by what an ablation leaves out.
GROUPS = {
    "hour": r"environment\.time_of_day",
    "weather": r"environment\.(?!time_of_day)",
    "lens": r"drones\.\d+\.camera\.(?!sensor\b|processing\b|gimbal\b|.*pitch|.*yaw|.*roll|per_frame)",
    "sensor": r"drones\.\d+\.camera\.(sensor\b|processing\b|gimbal\b|per_frame\.ev)|outputs\.image",
    "appearance": r"appearance\.",
    "place": r"scenario$",
    "clutter": r"props\.|clutter\.",
}


# Members of cameras by the same groups: without one, all drones have the first drone's.
CAMERA_MEMBERS = {"lens": ("hfov_deg", "model", "distortion"), "sensor": ("sensor", "processing", "gimbal")}


def open_dataset(name: str, folder: Path, *, quiet: bool = False) -> Dataset:
    """A dataset of throng, or that of a job: a file *.job.json or a preset's name. It is made in `folder`; the part that is
    there already is not made again."""
    job = read_job(name)
    return Dataset(name) if job is None else make(job, folder / job_name(name), quiet=quiet)


def read_job(name: str) -> dict[str, Any] | None:
    """The job of a file or a preset; None for anything else."""
    path = Path(name)
    if not path.exists() and re.fullmatch(r"\w+", name):
        path = _job_file.preset_path(name)
    if not (path.is_file() and path.suffix == ".json") or path.name.endswith(SUFFIX):
        return None
    return _job_file.read_job(path)


def job_name(name: str) -> str:
    return Path(name).name.split(".")[0]


def make(job: dict[str, Any], folder: Path, *, quiet: bool = False) -> Dataset:
    return program.run(job, folder, quiet=quiet)


def without(job: dict[str, Any], group: str, held_out: frozenset[str] = frozenset()) -> dict[str, Any]:
    """The job with a typical value wherever it samples something of the group; for "place" the first scenario that is not held
    out. ValueError where it samples nothing of it."""
    less = _with_whole_cameras(job)
    if group == "place":
        scenarios = less.get("scenario")
        kept = [one for one in scenarios if _id(one) not in held_out] if isinstance(scenarios, list) else []
        if len(kept) < 2:
            raise ValueError("--ablate: found one place, expected a job of several for place")
        less["scenario"] = kept[0]
        less.get("outputs", {}).pop("splits", None)
        return less
    found = [place for place in _sampled(less) if re.match(GROUPS[group], place[2])]
    if not found:
        raise ValueError(f"--ablate: found a job that samples nothing of {group}, expected one that does")
    for parent, key, _ in found:
        parent[key] = {"choice": [typical(parent[key])]}
    cameras = [drone["camera"] for drone in less.get("drones", []) if "camera" in drone]
    for camera in cameras[1:]:
        camera.update({name: cameras[0][name] for name in CAMERA_MEMBERS.get(group, ()) if name in cameras[0]})
    return less


def _with_whole_cameras(job: dict[str, Any]) -> dict[str, Any]:
    """A copy of the job whose cameras have the fields of their presets as their own."""
    whole = copy.deepcopy(job)
    drones = [drone for drone in whole.get("drones", []) if drone.get("camera", {}).get("preset")]
    if drones:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "job.json"
            file.write_text(json.dumps(job), encoding="utf-8")
            checked = json.loads(program.call(["check", "--json", file]))["job"]["drones"]
        resolved = {drone["id"]: drone["camera"] for drone in checked}
        for drone in drones:
            drone["camera"] = {key: value for key, value in resolved[drone["id"]].items() if key != "preset"}
    return whole


def _id(scenario: Any) -> str:
    return scenario if isinstance(scenario, str) else str(scenario.get("id", ""))


def _sampled(value: Any, path: str = "") -> Iterator[tuple[Any, Any, str]]:
    """Object, member and dotted path of each distribution."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, member in list(items):
        inner = f"{path}.{key}" if path else str(key)
        if isinstance(member, dict) and len(member) == 1 and next(iter(member)) in _DISTRIBUTIONS:
            yield value, key, inner.removeprefix("randomize.")
        else:
            yield from _sampled(member, inner)


def typical(distribution: dict[str, Any]) -> Any:
    """The middle of a range, the mean, the first of a choice."""
    ((kind, values),) = distribution.items()
    if kind in ("choice", "normal"):
        return values[0]
    low, high = values
    if isinstance(low, str):
        middle = sum(int(part[:2]) * 60 + int(part[3:5]) for part in (low, high)) // 2
        return f"{middle // 60:02}:{middle % 60:02}"
    return (low * high) ** 0.5 if kind == "log_uniform" else (low + high) / 2
