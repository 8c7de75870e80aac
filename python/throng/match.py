"""Jobs and selections of frames that match a set of photographs: python3 -m throng.match KIND FOLDER (docs/matching.md).

>>> images = throng.open_real_set("visdrone", "VisDrone2019-DET-train")
>>> real = throng.match.measure_real(images, hfov_deg=70, limit=500, seed=0)
>>> job, notes = throng.match.match_job(base, real, hfov_deg=70, width=0, views=3)
"""

from __future__ import annotations

import argparse
import json
import logging
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._frame_list import SUFFIX, write_frame_list
from ._job_file import preset_path, read_job
from ._match_job import NIGHT_BRIGHTNESS, correct_job, match_job
from ._measures import COLUMNS, Measures, distance, measure_dataset, measure_real
from ._optional import require
from ._thin import choose_frames
from ._words import counted
from .dataset import Dataset
from .errors import DatasetError, OutputFileError, ThrongError
from .real_sets import REAL_SETS, WHOLE_BODIES, open_real_set

_PRESETS = {True: "detection", False: "counting"}
_SHOWN = (0.1, 0.25, 0.5, 0.75, 0.9)
_WORDS = {
    "count": "people",
    "box_height": "box height / image width",
    "box_spread": "box heights: ln(q90 / q10)",
    "aspect": "box width / height",
    "overlap": "overlap of boxes",
    "hidden": "hidden share (labels)",
    "brightness": "brightness",
    "contrast": "contrast",
    "saturation": "saturation",
    "pitch_deg": "pitch, deg",
    "camera_height_m": "camera height, m",
}


def _write_job(path: str, job: dict[str, Any]) -> None:
    try:
        Path(path).write_text(json.dumps(job, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise OutputFileError(f"{path}: cannot be written: {error.strerror or error}") from error


def _line(name: str, values: Any) -> str:
    shown = "".join(f"{value:10.3g}" for value in np.quantile(values, _SHOWN)) if len(values) else "  not measured"
    return f"{name:<28}{shown}"


def describe(real: Measures, others: dict[str, Measures] | None = None) -> str:
    """A table of quantiles; under the real set's those of others, with Kolmogorov and Smirnov's distance to it."""
    sizes = sorted({(int(w), int(h)) for w, h in zip(real.width, real.height)})
    night = float((real.brightness < NIGHT_BRIGHTNESS).mean())
    listed = ", ".join(f"{w} x {h}" for w, h in sizes[:4]) + (", ..." if len(sizes) > 4 else "")
    lines = [f"{counted(len(real), 'image')} of {listed}; {night:.0%} by night"]
    lines.append(f"{'quantiles':<28}" + "".join(f"{place:10.0%}" for place in _SHOWN))
    for name, words in _WORDS.items():
        lines.append(_line(words, real.known(name)))
        for what, other in (others or {}).items():
            far = distance(real.known(name), other.known(name))
            if not math.isnan(far):
                lines.append(_line("  " + what, other.known(name)) + f"   distance {far:.2f}")
    return "\n".join(lines)


def plot(path: str, real: Measures, others: dict[str, Measures]) -> None:
    """Draws the distributions, each with its share of images up to a value. Needs matplotlib."""
    pyplot = require("matplotlib.pyplot", "--plot")
    figure, axes = pyplot.subplots(3, 4, figsize=(13, 9), layout="constrained")
    for axis, (name, words) in zip(axes.flat, _WORDS.items()):
        for what, measures in {"real": real, **others}.items():
            values = np.sort(measures.known(name))
            if len(values):
                axis.step(values, (np.arange(len(values)) + 1) / len(values), where="post", label=what)
        axis.set_xlabel(words)
        axis.set_ylim(0, 1)
    for axis in axes.flat[len(_WORDS) :]:
        axis.remove()
    axes.flat[0].set_ylabel("share of the images")
    axes.flat[0].legend()
    try:
        figure.savefig(path)
    except (OSError, ValueError) as error:
        raise OutputFileError(f"{path}: cannot be written: {error}") from error
    finally:
        pyplot.close(figure)


def _measure_made(path: str, kind: str, real: Measures, hfov_deg: float) -> tuple[Dataset, Measures]:
    dataset = Dataset(path)
    measures = measure_dataset(dataset, hfov_deg=hfov_deg, whole=kind in WHOLE_BODIES, min_height=real.smallest)
    return dataset, measures


def _arguments(given: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python3 -m throng.match",
        description="Measures a set of photographs and writes a job whose images match it.",
    )
    parser.add_argument("kind", choices=sorted(REAL_SETS), metavar="KIND", help=", ".join(sorted(REAL_SETS)))
    parser.add_argument("folder", metavar="FOLDER", help="the set")
    parser.add_argument("--job", metavar="JOB", help="the job to begin with; default: a preset, detection or counting")
    parser.add_argument(
        "-o", "--output", metavar="OUT", help=f"the job to write, or with --thin the list of frames, *{SUFFIX}"
    )
    parser.add_argument(
        "--pilot", metavar="DATASET", help="images that JOB made: write JOB with what they differ in corrected"
    )
    parser.add_argument("--thin", metavar="DATASET", help="choose frames of this dataset, together like the set's")
    parser.add_argument("--count", type=int, metavar="N", help="frames that --thin chooses; default: half of them")
    parser.add_argument(
        "--hfov",
        type=float,
        default=70.0,
        metavar="DEG",
        help="assumed horizontal angle of the set's cameras (%(default)g)",
    )
    parser.add_argument(
        "--width", type=int, default=0, metavar="PX", help="of the job's images; default: as the set has them"
    )
    parser.add_argument("--views", type=int, default=3, metavar="N", help="drones of the job, 1 to 16 (%(default)d)")
    parser.add_argument(
        "--limit", type=int, default=500, metavar="N", help="measure so many images at most (%(default)d)"
    )
    parser.add_argument("--seed", type=int, default=0, help="samples the images that are measured")
    parser.add_argument("--plot", metavar="PNG", help="draw the distributions; needs matplotlib")
    options = parser.parse_args(given)
    for name, low, high in (("hfov", 5, 150), ("views", 1, 16), ("limit", 1, 10**6), ("seed", 0, 2**63)):
        if not low <= getattr(options, name) <= high:
            parser.error(f"--{name}: found {getattr(options, name):g}, expected {low} to {high}")
    if options.width and not 64 <= options.width <= 7680:
        parser.error(f"--width: found {options.width}, expected 64 to 7680")
    if options.pilot and not options.job:
        parser.error("--pilot: expected --job, the job that made its images")
    if options.pilot and options.thin:
        parser.error("--thin: expected without --pilot")
    return options


def _run(options: argparse.Namespace) -> None:
    images = open_real_set(options.kind, options.folder)
    base = (
        None
        if options.thin
        else read_job(Path(options.job) if options.job else preset_path(_PRESETS[images.has_boxes]))
    )
    real = measure_real(images, hfov_deg=options.hfov, limit=options.limit, seed=options.seed)
    others: dict[str, Measures] = {}
    job, chosen = base, None
    notes: list[str] = []
    if options.thin:
        dataset, made = _measure_made(options.thin, options.kind, real, options.hfov)
        if len(made) != len(dataset):
            raise DatasetError(f"{options.thin}: found damaged images, expected none: throng validate lists them")
        count = max(1, len(made) // 2) if options.count is None else options.count
        if not 1 <= count <= len(made):
            raise DatasetError(f"--count: found {count}, expected 1 to {len(made)}, the images of {options.thin}")
        chosen = choose_frames(real, made, count)
        others = {"dataset": made, "chosen": made.rows(chosen)}
    elif options.pilot:
        assert base is not None
        others = {"pilot": _measure_made(options.pilot, options.kind, real, options.hfov)[1]}
        job = correct_job(base, real, others["pilot"])
    else:
        assert base is not None
        job, notes = match_job(base, real, hfov_deg=options.hfov, width=options.width, views=options.views)
        job["name"] = f"match of {Path(options.folder).resolve().name}"
    print(describe(real, others))
    for note in notes:
        print(f"note: {note}")
    if options.plot:
        plot(options.plot, real, others)
    if options.output and chosen is not None:
        write_frame_list(options.output, options.thin, [dataset[i].file_name for i in chosen])
    elif options.output and job is not None:
        _write_job(options.output, job)


def main(given: Sequence[str] | None = None) -> int:
    """The command; 0, or 2 where the input is wrong."""
    options = _arguments(given)
    logging.basicConfig(format="throng: %(message)s")
    try:
        _run(options)
    except (ThrongError, ValueError) as error:
        print(f"throng: {error}", file=sys.stderr)
        return 2
    return 0


__all__ = [
    "COLUMNS",
    "Measures",
    "choose_frames",
    "correct_job",
    "describe",
    "distance",
    "main",
    "match_job",
    "measure_dataset",
    "measure_real",
    "plot",
    "write_frame_list",
]

if __name__ == "__main__":
    sys.exit(main())
