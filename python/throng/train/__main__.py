"""Makes or takes datasets, trains a detector and a counter, scores them on real sets and draws up a table.

python3 -m throng.train detection -o out --test visdrone VisDrone2019-DET-val --seeds 1,2,3
python3 -m throng.train --model out/detect/synthetic/seed1/model.pt --test mot 2DMOT2015/train

Run again, it goes on where it was interrupted. docs/training.md
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from ..dataset import Dataset
from ..errors import OutputFileError, ThrongError
from ..real_sets import REAL_SETS, WHOLE_BODIES, open_real_set
from .._words import known_names

_MULTIPLE = 32


def _number(kind: Callable[[str], Any], low: float, high: float = float("inf")) -> Callable[[str], Any]:
    def read(text: str) -> Any:
        try:
            value = kind(text)
        except ValueError:
            value = float("nan")
        if not low <= value <= high:
            wanted = f"{low:g} to {high:g}" if high < float("inf") else f"{low:g} or more"
            raise argparse.ArgumentTypeError(f"found {text}, expected {wanted}")
        return value

    return read


def _list(read: Callable[[str], Any]) -> Callable[[str], list[Any]]:
    return lambda text: [read(part) for part in text.split(",")]


def _parser() -> argparse.ArgumentParser:
    positive, natural, percent = _number(int, 1), _number(int, 0), _number(float, 0.01, 100)
    kinds = ", ".join(sorted(REAL_SETS))
    parser = argparse.ArgumentParser(prog="throng.train", description=(__doc__ or "").split("\n")[0])
    add = parser.add_argument
    add("datasets", nargs="*", help="of throng: folders, .tar, .zip; or jobs and names of presets, which are run")
    add("-o", "--output", help="folder of datasets, models and scores")
    add("--model", help="scores this model instead of training")
    add("--test", nargs=2, action="append", default=[], metavar=("KIND", "PATH"), help=f"throng or {kinds}")
    add(
        "--real",
        nargs=2,
        metavar=("KIND", "PATH"),
        help="photographs to train on, of another part of the set than --test",
    )
    add("--split", default="train", help="which of the job's splits to train on; all: every image")
    add("--test-split", default="val", help="of the datasets of throng")
    add("--transfer", type=natural, default=0, metavar="N", help="test on N scenarios that are not trained on")
    add(
        "--experiment",
        default="synthetic",
        help="several by commas: synthetic, frames, fine_tune, real, mixed, ablation",
    )
    add("--ablate", default="", help="by commas: hour, weather, lens, sensor, appearance, place, clutter")
    add("--frames", type=_list(positive), help="of the experiment frames: 30,100,300,1000,3000")
    add("--percents", type=_list(percent), help="of real images: 1,5,10,50,100")
    add("--seeds", type=_list(natural), default=[1], help="1,2,3: a training and an interval over them")
    add("--task", choices=("detect", "count", "both"), default="both")
    add("--network", choices=("auto", "small", "torchvision", "ultralytics"), default="auto", help="of detectors")
    add("--boxes", choices=("auto", "visible", "whole"), default="auto", help="auto: as the first test has them")
    add("--steps", type=natural, default=1500, help="0 keeps the untrained network")
    add("--batch", type=positive, default=8, help="tiles per step")
    add("--tile", type=positive, default=192, help=f"side in pixels, a multiple of {_MULTIPLE}")
    add("--width", type=positive, default=24, help="channels of the small network")
    add("--rate", type=_number(float, 1e-7, 1), default=2e-3, help="largest learning rate")
    add("--scale", type=_number(float, 0.05, 20), default=1.0, help="resizes images of tests")
    add("--limit", type=positive, help="only so many images of each test, evenly spread")
    add("--device", default="auto", help="cpu, cuda, ...; auto: a GPU if there is one")
    add("--threads", type=positive, help="of the CPU; default: all cores")
    add("--workers", type=natural, default=0, help="processes that read images; 0: none of their own")
    add("--checkpoint", type=positive, default=200, metavar="STEPS", help="steps between two checkpoints")
    return parser


def _check(given: argparse.Namespace) -> None:
    from .experiments import EXPERIMENTS
    from .jobs import GROUPS

    given.experiment = given.experiment.split(",")
    given.ablate = [group for group in given.ablate.split(",") if group]
    if given.ablate and "ablation" not in given.experiment:
        given.experiment.append("ablation")
    known_names("--experiment", given.experiment, EXPERIMENTS)
    known_names("--ablate", given.ablate, GROUPS)
    if given.tile % _MULTIPLE:
        raise ValueError(f"--tile: found {given.tile}, expected a multiple of {_MULTIPLE}")
    if bool(given.model) == bool(given.output):
        raise ValueError("expected either -o FOLDER, to train, or --model FILE, to score")
    needs_real = {"fine_tune", "real", "mixed"} & set(given.experiment)
    if needs_real and not (given.real and given.test):
        raise ValueError(f"--experiment {sorted(needs_real)[0]}: expected --real KIND PATH and --test KIND PATH")
    if given.output:
        if not given.datasets:
            raise ValueError("expected a dataset, a job or the name of a preset")
        if os.path.exists(given.output) and not os.path.isdir(given.output):
            raise OutputFileError(f"-o: found {given.output}, which is a file, expected a folder")
    elif not (given.test or given.datasets):
        raise ValueError("--model: expected datasets or --test KIND PATH")


def _device(given: argparse.Namespace) -> str:
    from .networks import torch

    if given.threads:
        torch.set_num_threads(given.threads)
    name: str = given.device
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    if name == "cpu":
        torch.use_deterministic_algorithms(True)
    try:
        torch.zeros(1, device=name)
    except (RuntimeError, AssertionError, NotImplementedError) as error:  # by the kind of device
        reason = str(error).split("\n")[0]
        raise ValueError(
            f"--device: found {name}, expected a device of this machine, such as cpu ({reason})"
        ) from error
    return name


def _evenly(pictures: list[Any], limit: int | None) -> list[Any]:
    if limit is None or limit >= len(pictures):
        return pictures
    return [pictures[round(i * (len(pictures) - 1) / max(1, limit - 1))] for i in range(limit)]


def _tests(given: argparse.Namespace, boxes: str) -> dict[str, list[Any]]:
    from . import pictures

    tests = {}
    for kind, path in given.test:
        name = f"{kind} {Path(path).name}"
        if kind == "throng":
            found = pictures.of_datasets([Dataset(path)], split=given.test_split, boxes=boxes)
        else:
            found = pictures.of_real_set(open_real_set(kind, path))
        tests[name] = _evenly(found, given.limit)
    return tests


def _run_score(given: argparse.Namespace, boxes: str) -> list[dict[str, Any]]:
    from . import experiments, pictures

    tests = _tests(given, boxes)
    for name in given.datasets:
        found = pictures.of_datasets([Dataset(name)], split=given.test_split, boxes=boxes)
        tests[name] = _evenly(found, given.limit)
    return experiments.score_model(Path(given.model), None, tests, _device(given), given.scale)


def _places(found: Sequence[Any], held_out: frozenset[str]) -> tuple[list[Any], list[Any]]:
    """Pictures of the places that are trained on, and of those held out."""
    return [one for one in found if one.group not in held_out], [one for one in found if one.group in held_out]


def _run_train(given: argparse.Namespace, boxes: str) -> list[dict[str, Any]]:
    from . import detectors, experiments, jobs, learning, pictures, report

    out, device = Path(given.output), _device(given)
    made = [jobs.open_dataset(name, out / "datasets") for name in given.datasets]
    split = "all" if given.transfer else given.split
    chosen = pictures.of_datasets(made, split=split, boxes=boxes)
    names = sorted({one.group for one in chosen})
    if given.transfer >= len(names) and given.transfer:
        raise ValueError(f"--transfer: found {given.transfer}, expected less than the {len(names)} scenarios there are")
    held_out = frozenset(names[len(names) - given.transfer :])
    train, test = _places(chosen, held_out)
    tests = _tests(given, boxes)
    if given.transfer:
        tests[f"{given.transfer} other places"] = _evenly(test, given.limit)
    elif not tests:
        tests[given.test_split] = _evenly(pictures.of_datasets(made, split=given.test_split, boxes=boxes), given.limit)
    ablated = {}
    for group in given.ablate:
        job = jobs.read_job(given.datasets[0])
        if job is None or len(given.datasets) > 1:
            raise ValueError("--ablate: expected one job or the name of a preset, which samples what is left out")
        less = jobs.make(jobs.without(job, group, held_out), out / f"datasets/without_{group}")
        split = given.split if given.split in less.splits and not given.transfer else "all"
        ablated[group] = _places(pictures.of_datasets([less], split=split, boxes=boxes), held_out)[0]
    real = pictures.of_real_set(open_real_set(*given.real)) if given.real else []
    options = {name: getattr(given, name) for name in ("frames", "percents") if getattr(given, name)}
    plan = experiments.plan(given.experiment, train, real, ablated, **options)
    results: list[dict[str, Any]] = []
    network = detectors.best_available() if given.network == "auto" else given.network
    for task in ("detect", "count") if given.task == "both" else (given.task,):
        setting = learning.Setting(
            task,
            network if task == "detect" else "small",
            given.steps,
            given.batch,
            given.tile,
            given.width,
            given.rate,
        )
        bench = experiments.Bench(out, setting, tests, device, given.workers, given.scale, given.checkpoint)
        results += bench.run(plan, given.seeds)
        report.write(results, out)
    return results


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; mistakes of the input end it with a line and 2, too little memory with 3."""
    given = _parser().parse_args(arguments)
    try:
        from . import report

        _check(given)
        kinds = [kind for kind, _ in given.test]
        known_names("--test", kinds, ("throng", *REAL_SETS))
        boxes = given.boxes
        if boxes == "auto":
            boxes = "whole" if kinds and kinds[0] in WHOLE_BODIES else "visible"
        results = (_run_score if given.model else _run_train)(given, boxes)
        if not results:
            raise ValueError("--test: found heads only, expected boxes, which a detector is scored by")
        print("\n".join(report.table(results)).strip())
    except (ThrongError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except (MemoryError, RuntimeError) as error:
        if "memory" not in str(error):
            raise
        print("error: out of memory; a smaller --tile, --batch or --width needs less", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
