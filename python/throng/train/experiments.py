"""Which trainings an experiment needs, and running them: each has a folder of its own, and what is finished is not repeated."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .._progress import ProgressBar
from . import evaluate, learning
from .pictures import Picture, share, spread

EXPERIMENTS = ("synthetic", "frames", "fine_tune", "real", "mixed", "ablation")
PERCENTS = (1.0, 5.0, 10.0, 50.0, 100.0)
FRAMES = (30, 100, 300, 1000, 3000)


@dataclass(frozen=True)
class Training:
    """Trains on the sources that `of` gives for a seed, from the weights of the training `start` if it is named."""

    name: str
    of: Callable[[int], list[list[Picture]]]
    x: float | None = None
    """Frames or percent, where the experiment is a curve."""
    start: str | None = None


def plan(
    experiments: Sequence[str],
    pictures: list[Picture],
    real: list[Picture],
    ablated: Mapping[str, list[Picture]],
    *,
    frames: Sequence[int] = FRAMES,
    percents: Sequence[float] = PERCENTS,
) -> list[Training]:
    """The trainings of the experiments, each once, in an order in which those that others start from are first."""
    found: dict[str, Training] = {}

    def add(
        name: str, of: Callable[[int], list[list[Picture]]], x: float | None = None, start: str | None = None
    ) -> None:
        found.setdefault(name, Training(name, of, x, start))

    whole = lambda seed: [pictures]  # noqa: E731
    for experiment in experiments:
        if experiment in ("synthetic", "fine_tune", "ablation"):
            add("synthetic", whole)
        for count in frames if experiment == "frames" else ():
            if count <= len(pictures):
                add(f"frames_{count}", lambda seed, count=count: [spread(pictures, count, seed)], count)  # type: ignore[misc]
        for percent in percents if experiment in ("real", "mixed", "fine_tune") else ():
            part = lambda seed, percent=percent: share(real, percent, seed)  # noqa: E731
            name = f"{experiment}_{percent:g}"
            if experiment == "mixed":
                add(name, lambda seed, part=part: [pictures, part(seed)], percent)  # type: ignore[misc]
            else:
                start = "synthetic" if experiment == "fine_tune" else None
                add(name, lambda seed, part=part: [part(seed)], percent, start)  # type: ignore[misc]
        for group, less in ablated.items() if experiment == "ablation" else ():
            add(f"without_{group}", lambda seed, less=less: [spread(less, len(pictures), seed)])  # type: ignore[misc]
    return list(found.values())


@dataclass
class Bench:
    """Folder, options, tests and machine of trainings."""

    folder: Path
    setting: learning.Setting
    tests: dict[str, list[Picture]]
    device: str = "cpu"
    workers: int = 0
    scale: float = 1.0
    every: int = 200
    results: list[dict[str, Any]] = field(default_factory=list)

    def run(self, trainings: Sequence[Training], seeds: Sequence[int]) -> list[dict[str, Any]]:
        """Trains and scores; a result says task, training, x, seed, test and its scores."""
        for training in trainings:
            for seed in seeds:
                folder = self.folder_of(training.name, seed)
                bar = ProgressBar(f"{self.setting.task} {training.name}, seed {seed}")
                start = None if training.start is None else self.folder_of(training.start, seed) / "model.pt"
                model = learning.train(
                    self.setting,
                    training.of(seed),
                    seed,
                    folder,
                    start=start,
                    device=self.device,
                    workers=self.workers,
                    every=self.every,
                    progress=lambda done, text: bar.update(done, text, f"{math.floor(10 * done)}0 %"),
                )
                bar.close()
                self.results += score_model(
                    model, folder / "scores.json", self.tests, self.device, self.scale, training, seed
                )
        return self.results

    def folder_of(self, name: str, seed: int) -> Path:
        return self.folder / self.setting.task / name / f"seed{seed}"


def score_model(
    model_file: Path,
    scores_file: Path | None,
    tests: Mapping[str, list[Picture]],
    device: str,
    scale: float,
    training: Training | None = None,
    seed: int | None = None,
) -> list[dict[str, Any]]:
    """Scores on each test, of which those in scores_file are not repeated."""
    known: dict[str, Any] = {}
    if scores_file is not None and scores_file.exists():
        known = json.loads(scores_file.read_text(encoding="utf-8"))
    model, about = learning.load(model_file, device)
    results = []
    for name, pictures in tests.items():
        usable = [one for one in pictures if about["task"] == "count" or one.boxes is not None]
        key = f"{name}, {len(usable)} images, scale {scale:g}"
        if not usable:
            continue
        if key not in known:
            known[key] = rounded(evaluate.score(model, about, usable, scale=scale))
            if scores_file is not None:
                scores_file.write_text(json.dumps(known, indent=1), encoding="utf-8")
        results.append(
            {
                "task": about["task"],
                "training": training.name if training else model_file.stem,
                "x": training.x if training else None,
                "seed": about["seed"] if seed is None else seed,
                "trained_images": about["images"],
                "test": name,
                "scores": known[key],
            }
        )
    return results


def rounded(value: Any) -> Any:
    """As JSON has it: four digits, null for what is not a number."""
    if isinstance(value, dict):
        return {name: rounded(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(one) for one in value]
    if isinstance(value, float):
        return None if math.isnan(value) else round(value, 4)
    return value
