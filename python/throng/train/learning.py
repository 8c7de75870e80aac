"""Training: steps of tiles with checkpoints, so that what was interrupted goes on and ends with the same weights."""

from __future__ import annotations

import copy
import json
import math
import os
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from .._optional import require
from ..errors import DatasetError
from .detectors import make
from .pictures import Picture
from .tiles import Tiles

torch = require("torch", "throng.train")

_DECAY = 0.99
"""Of the mean of weights over the steps, which is what is kept: it forgets within a hundred steps."""
Progress = Callable[[float, str], None]


@dataclass(frozen=True)
class Setting:
    """Everything that a training depends on besides its images."""

    task: str = "detect"
    network: str = "small"
    steps: int = 1000
    batch: int = 8
    tile: int = 192
    width: int = 24
    rate: float = 2e-3


def train(
    setting: Setting,
    sources: Sequence[Sequence[Picture]],
    seed: int,
    folder: Path,
    *,
    start: Path | None = None,
    device: str = "cpu",
    workers: int = 0,
    every: int = 200,
    progress: Progress | None = None,
) -> Path:
    """Writes folder/model.pt, or finds it there, and goes on with a training that was interrupted.

    sources: lists of images, each of which is trained on as often. start: a model whose weights are the first ones.
    every: steps between two checkpoints. Errors: DatasetError where folder has a training of another setting.
    """
    folder.mkdir(parents=True, exist_ok=True)
    plan = {**asdict(setting), "seed": seed, "images": [len(source) for source in sources]}
    _check_plan(folder / "plan.json", plan)
    model_file, checkpoint = folder / "model.pt", folder / "checkpoint.pt"
    if model_file.exists():
        return model_file
    torch.manual_seed(seed)
    model = make(setting.network, setting.task, setting.width)
    if start is not None:
        model.load_state_dict(_load(start)["state"])
    model, mean = model.to(device), copy.deepcopy(model).to(device)
    optimizer = torch.optim.AdamW(model.parameters(), lr=setting.rate, weight_decay=1e-4)
    parts = {"model": model, "mean": mean, "optimizer": optimizer}
    first = 0
    if checkpoint.exists():
        saved = _load(checkpoint)
        first = int(saved["step"])
        for name, part in parts.items():
            part.load_state_dict(saved[name])
    count = setting.steps * setting.batch
    tiles = Tiles(sources, setting.task, setting.tile, count, seed, first=first * setting.batch)
    loader = torch.utils.data.DataLoader(tiles, setting.batch, num_workers=workers, collate_fn=_collate)
    for step, (images, people) in enumerate(loader, first + 1):
        done = step / setting.steps
        optimizer.param_groups[0]["lr"] = setting.rate * _rate(done)
        loss = _step(model, optimizer, images.to(device), [each.to(device) for each in people])
        _follow(mean, model, min(_DECAY, step / (step + 10)))
        if progress is not None:
            progress(done, f"step {step}, loss {loss:.3f}")
        if step % every == 0 and step < setting.steps:
            _save({"step": step, **{name: part.state_dict() for name, part in parts.items()}}, checkpoint)
    counts = [picture.count for source in sources for picture in source]
    about = {"mean_count": sum(counts) / max(1, len(counts)), "images": len(counts), "seed": seed, **asdict(setting)}
    _save({"state": {name: value.cpu() for name, value in mean.state_dict().items()}, **about}, model_file)
    checkpoint.unlink(missing_ok=True)
    return model_file


def _step(model: Any, optimizer: Any, images: Any, people: list[Any]) -> float:
    model.train()
    loss = model.loss(images, people)
    optimizer.zero_grad()
    loss.backward()
    torch.nn.utils.clip_grad_norm_(model.parameters(), 5.0)
    optimizer.step()
    return float(loss.item())


def load(path: Path, device: str = "cpu") -> tuple[Any, dict[str, Any]]:
    """The network of a file that train() wrote, ready to be used, and what else the file holds."""
    saved = _load(path)
    try:
        model = make(saved["network"], saved["task"], saved["width"])
        model.load_state_dict(saved.pop("state"))
    except (KeyError, RuntimeError, ValueError, TypeError) as error:
        raise DatasetError(f"{path}: found no model of throng.train ({error})") from error
    return model.to(device).eval(), saved


def _load(path: Path) -> dict[str, Any]:
    try:
        saved = torch.load(path, map_location="cpu", weights_only=True)
    except Exception as error:  # torch raises many kinds for files that are damaged
        reason = str(error).split("\n")[0]
        raise DatasetError(f"{path}: found no model of throng.train ({reason})") from error
    loaded: dict[str, Any] = _mapped(saved, lambda one: float(one) if _is_float(one) else one)
    return loaded


def _save(content: dict[str, Any], path: Path) -> None:
    """The file is whole or absent, whenever the program ends. Numbers are tensors in it: torch 1.13 reads no others without
    running code of the file."""
    packed = _mapped(content, lambda one: torch.tensor(one, dtype=torch.float64) if isinstance(one, float) else one)
    torch.save(packed, path.with_suffix(".part"))
    os.replace(path.with_suffix(".part"), path)


def _is_float(value: Any) -> bool:
    return isinstance(value, torch.Tensor) and value.dtype == torch.float64 and value.dim() == 0


def _mapped(value: Any, change: Callable[[Any], Any]) -> Any:
    if isinstance(value, dict):
        return {key: _mapped(member, change) for key, member in value.items()}
    if isinstance(value, (list, tuple)):
        return [_mapped(member, change) for member in value]
    return change(value)


def _rate(done: float) -> float:
    """Share of the largest learning rate: up in the first sixth of the steps, down along a cosine."""
    return min(6 * done, 0.5 + 0.5 * math.cos(math.pi * max(0.0, done - 1 / 6) * 6 / 5))


def _check_plan(path: Path, plan: dict[str, Any]) -> None:
    text = json.dumps(plan, indent=1)
    if path.exists() and path.read_text(encoding="utf-8") != text:
        found = json.loads(path.read_text(encoding="utf-8"))
        wanted = json.loads(text)
        name = next(name for name in wanted if found.get(name) != wanted[name])
        raise DatasetError(
            f"{path}: found a training with {name} {found.get(name)}, expected {wanted[name]}: choose another folder"
        )
    path.write_text(text, encoding="utf-8")


def _collate(samples: Sequence[tuple[Any, Any]]) -> tuple[Any, list[Any]]:
    return torch.stack([image for image, _ in samples]), [people for _, people in samples]


def _follow(mean: Any, model: Any, decay: float) -> None:
    with torch.no_grad():
        for kept, value in zip(mean.state_dict().values(), model.state_dict().values()):
            if kept.dtype.is_floating_point:
                kept.mul_(decay).add_(value, alpha=1 - decay)
            else:
                kept.copy_(value)
