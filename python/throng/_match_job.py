"""The job whose images are to have the figures of a real set."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._measures import Measures, distance
from ._view_estimate import seen_ground_m2
from .errors import DatasetError

FloatArray = NDArray[np.float64]
Job = dict[str, Any]

_QUANTILES = 16
# Ranges of the fields (docs/reference/job.md).
_HEIGHTS_M, _PITCHES_DEG, _EV = (2.0, 500.0), (-90.0, -3.0), (-3.0, 3.0)
# Of the presets' scenarios the smallest crowd has 800 people, those of generated streets about as many.
_MAX_AGENTS = 750
# Below it an image is one of the night: throng's have 0.21 to 0.30 then and 0.5 to 0.6 by day (deciles of 48 images each, ev 0).
NIGHT_BRIGHTNESS = 0.31
_NIGHT_HOURS = ("20:30", "21:30", "22:30", "23:30")
_DAY_HOURS = ("07:00", "08:30", "10:00", "11:30", "13:00", "14:30", "16:00", "17:30")
# Medians of the same images, and the steps of one EV at such tones.
_DAY_BRIGHTNESS, _NIGHT_BRIGHTNESS, _DAY_STEP, _NIGHT_STEP = 0.55, 0.24, 0.13, 0.08
# Of these images, ground within reach by the share of the crowd with a label: what others, houses and trees hide counts, too.
_CROWDED_M2, _REACH_M = 45000.0, 80.0
# Share of a crowd that one image shows where a set says nothing about its cameras.
_USUAL_SHARE = 0.2
_STEEPEST_AIM = 0.05


def match_job(
    base: Mapping[str, Any], real: Measures, *, hfov_deg: float, width: int, views: int
) -> tuple[Job, list[str]]:
    """The job and what could not be matched.

    base gives everything else. width: of the images, 0 for the real set's; views: drones, each with the pitches of its share of the
    real images and the heights that go with them, since a job samples each field by itself.
    """
    job: Job = copy.deepcopy(dict(base))
    notes: list[str] = []
    size = _image_size(real, width, notes)
    groups = _views(real, views)
    if groups:
        _set_views(job, groups, size, hfov_deg)
    else:
        notes.append("pitch and height: too few whole people have boxes; those of the base job are kept")
        for drone in _drones(job):
            drone["camera"].update(width=size[0], height=size[1])
    _set_people(job, real, hfov_deg, notes)
    _set_light(job, real)
    _set_filters(job, real, size[0], notes)
    return job, notes


def correct_job(job: Mapping[str, Any], real: Measures, pilot: Measures) -> Job:
    """The job with heights, people and exposure changed by how the images of the pilot, which it made, differ from the real ones.

    Figures that differ by no more than chance lets them are kept.
    """
    corrected: Job = copy.deepcopy(dict(job))
    randomize = corrected.setdefault("randomize", {})
    heights = _log_change(pilot.known("camera_height_m"), real.known("camera_height_m"))
    if not len(real.known("camera_height_m")) or not len(pilot.known("camera_height_m")):
        # People half as tall are twice as far away.
        sizes = _log_change(pilot.known("box_height"), real.known("box_height"))
        heights = None if sizes is None else (-sizes[0], sizes[1])
    if heights is not None:
        for name in [name for name in randomize if name.endswith(".aim.height_m")]:
            randomize[name] = _changed(randomize[name], heights, _HEIGHTS_M, 2)
    people = _log_change(pilot.count[pilot.count > 0], real.count[real.count > 0])
    if people is not None and "crowd.agents" in randomize:
        randomize["crowd.agents"] = _changed(randomize["crowd.agents"], people, (1, _MAX_AGENTS), 0)
    exposures = [_exposures(each.brightness) for each in (real, pilot)]
    if not _differ(*exposures):
        return corrected
    brighter = float(np.median(exposures[0]) - np.median(exposures[1]))
    for drone in _drones(corrected):
        sensor = drone["camera"].setdefault("sensor", {})
        values = _values(sensor.get("ev", 0))
        sensor["ev"] = _choice(values + brighter, _EV, 2)
    return corrected


def _drones(job: Job) -> list[Any]:
    drones = job.get("drones")
    if not isinstance(drones, list) or not drones or not all(isinstance(each, dict) for each in drones):
        raise DatasetError("the base job: found no drones, expected at least one with a camera and an aim")
    for drone in drones:
        drone.setdefault("camera", {})
    return drones


def _image_size(real: Measures, width: int, notes: list[str]) -> tuple[int, int]:
    sizes, counts = np.unique(np.stack((real.width, real.height), axis=1), axis=0, return_counts=True)
    usual = sizes[int(counts.argmax())]
    if len(sizes) > 1:
        notes.append(
            f"sizes: found {len(sizes)}, used the most frequent, {usual[0]:g} x {usual[1]:g}; boxes are compared by width"
        )
    wanted = float(width or usual[0])
    columns = int(np.clip(round(wanted), 64, 7680))
    return columns, int(np.clip(round(columns * usual[1] / usual[0]), 64, 4320))


def _views(real: Measures, views: int) -> list[tuple[FloatArray, FloatArray]]:
    """Pitches and heights of equally many images each, from the steepest pitches on."""
    known = np.isfinite(real.pitch_deg)
    pitch, height = real.pitch_deg[known], real.camera_height_m[known]
    order = np.lexsort((height, pitch))
    count = min(views, max(1, len(order) // 4)) if len(order) else 0
    return [(pitch[part], height[part]) for part in np.array_split(order, count)] if count else []


def _set_views(job: Job, groups: list[tuple[FloatArray, FloatArray]], size: tuple[int, int], hfov_deg: float) -> None:
    randomize = job.setdefault("randomize", {})
    first = _drones(job)[0]
    for name in [name for name in randomize if name.startswith("drones.")]:
        del randomize[name]
    drones = []
    for i, (pitch, height) in enumerate(groups):
        drone = copy.deepcopy(first)
        drone.pop("start", None)
        drone["id"] = f"view{i}"
        # Far people are seen at small angles: the person on the axis may stand where it meets the ground.
        steep = max(_STEEPEST_AIM, math.tan(math.radians(-float(np.median(pitch)))))
        farthest = float(np.clip(np.quantile(height, 0.9) / steep, 100, 300))
        drone["aim"] = {**drone.get("aim", {}), "max_distance_m": round(farthest)}
        for name in ("fx_px", "fy_px", "cx_px", "cy_px", "preset", "calibration", "model", "distortion"):
            drone["camera"].pop(name, None)
        pitches = _choice(_quantiles(pitch), _PITCHES_DEG, 1)
        drone["camera"].update(width=size[0], height=size[1], hfov_deg=hfov_deg, pitch_deg=pitches)
        per_frame = drone["camera"].get("per_frame")
        if isinstance(per_frame, dict):
            per_frame["pitch_deg"] = 0
        drones.append(drone)
        randomize[f"drones.{i}.aim.height_m"] = _choice(_quantiles(height), _HEIGHTS_M, 2)
    job["drones"] = drones
    # As many images as the base job has.
    if isinstance(job.get("runs"), int):
        entries = len(job["scenario"]) if isinstance(job.get("scenario"), list) else 1
        job["runs"] = max(min(entries, job["runs"]), math.ceil(job["runs"] / len(drones)))


def _set_people(job: Job, real: Measures, hfov_deg: float, notes: list[str]) -> None:
    """crowd.agents: people per image by the share of a crowd that an image shows, which a pilot corrects."""
    count = np.maximum(real.count, 1)
    share = np.full(len(count), _USUAL_SHARE)
    known = np.isfinite(real.pitch_deg)
    if known.any():
        aspect = float(np.median(real.width / real.height))
        ground = seen_ground_m2(real.pitch_deg[known], real.camera_height_m[known], hfov_deg, aspect, _REACH_M)
        share[known] = np.clip(ground / _CROWDED_M2, 0.02, 0.6)
        share[~known] = np.median(share[known])
    agents = _quantiles(count / share)
    if agents[-1] > _MAX_AGENTS:
        notes.append(
            f"people: up to {agents[-1]:.0f} in a scenario would be needed, cut to {_MAX_AGENTS}: not all have more"
        )
    job.setdefault("randomize", {})["crowd.agents"] = _choice(agents, (1, _MAX_AGENTS), 0)
    for entry in job["scenario"] if isinstance(job.get("scenario"), list) else []:
        if isinstance(entry, dict):
            entry.pop("agents", None)


def _set_light(job: Job, real: Measures) -> None:
    night = real.brightness < NIGHT_BRIGHTNESS
    count = round(_QUANTILES * float(night.mean()))
    hours = [_NIGHT_HOURS[i % len(_NIGHT_HOURS)] for i in range(count)]
    hours += [_DAY_HOURS[i % len(_DAY_HOURS)] for i in range(_QUANTILES - count)]
    environment = job.setdefault("environment", {})
    environment["time_of_day"] = {"choice": hours}
    brighter = _exposures(real.brightness)
    low, middle, high = np.quantile(brighter, (0.1, 0.5, 0.9))
    # Scenes differ in brightness themselves: half of the spread is that of the exposure.
    reach = float(np.clip((high - low) / 4, 0.1, 1))
    for drone in _drones(job):
        values = np.linspace(middle - reach, middle + reach, _QUANTILES)
        drone["camera"].setdefault("sensor", {})["ev"] = _choice(values, _EV, 2)


def _exposures(brightness: FloatArray) -> FloatArray:
    """EV by which images are brighter than throng's usual ones of the day or the night."""
    night = (brightness - _NIGHT_BRIGHTNESS) / _NIGHT_STEP
    return np.where(brightness < NIGHT_BRIGHTNESS, night, (brightness - _DAY_BRIGHTNESS) / _DAY_STEP)


def _set_filters(job: Job, real: Measures, width: int, notes: list[str]) -> None:
    if not len(real.heights):
        notes.append("sizes of people: the set has no boxes of people; outputs.filters is kept")
        return
    smallest = real.smallest * width
    outputs = job.setdefault("outputs", {})
    outputs["filters"] = {**outputs.get("filters", {}), "min_height_px": round(max(1.0, smallest), 1)}


def _quantiles(values: FloatArray) -> FloatArray:
    """The middles of _QUANTILES equal shares."""
    return np.quantile(values, (np.arange(_QUANTILES) + 0.5) / _QUANTILES)


def _choice(values: FloatArray, limits: tuple[float, float], digits: int) -> dict[str, list[float]]:
    clipped = np.clip(values, *limits)
    return {"choice": [round(float(value), digits) if digits else int(round(float(value))) for value in clipped]}


def _values(distribution: Any) -> FloatArray:
    """Quantiles of a job's distribution of numbers, or the number."""
    if isinstance(distribution, (int, float)):
        return np.full(1, float(distribution))
    ((kind, values),) = distribution.items()
    if kind == "choice":
        return np.array(values, dtype=np.float64)
    places = (np.arange(_QUANTILES) + 0.5) / _QUANTILES
    if kind == "normal":
        return np.array([NormalDist(*values).inv_cdf(place) for place in places])
    ends = np.array(values, dtype=np.float64)
    if kind == "log_uniform":
        return np.exp(np.interp(places, (0, 1), np.log(ends)))
    return np.interp(places, (0, 1), ends)


def _differ(first: FloatArray, second: FloatArray) -> bool:
    """Whether two samples are not of one distribution: Kolmogorov and Smirnov's test at 5 %."""
    return distance(first, second) > 1.36 * math.sqrt(1 / len(first) + 1 / len(second))


def _log_change(found: FloatArray, wanted: FloatArray) -> tuple[float, float] | None:
    """Difference of the medians' logarithms, of four times at most, and factor of their spread; None where they do not differ."""
    if not len(found) or not len(wanted) or not _differ(found, wanted):
        return None
    logs = [np.quantile(np.log(values), (0.2, 0.5, 0.8)) for values in (found, wanted)]
    spreads = [float(each[2] - each[0]) for each in logs]
    factor = float(np.clip(spreads[1] / spreads[0], 0.5, 2)) if min(spreads) > 1e-3 else 1.0
    return float(np.clip(logs[1][1] - logs[0][1], -math.log(4), math.log(4))), factor


def _changed(distribution: Any, change: tuple[float, float], limits: tuple[float, float], digits: int) -> Any:
    logs = np.log(np.maximum(_values(distribution), 1e-9))
    middle = float(np.median(logs))
    return _choice(np.exp(middle + change[0] + (logs - middle) * change[1]), limits, digits)
