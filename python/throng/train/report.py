"""Tables and curves of results: means over seeds with 95 % intervals."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .._optional import available, require

# Two-sided 95 % of Student's t by degrees of freedom.
_T = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)
_COLUMNS = {
    "detect": ("ap50", "ap75", "ap", "ap_small", "ap_medium", "ap_large", "recall50"),
    "count": ("mae", "rmse", "bias"),
}
_FIRST = {"detect": ("ap50", "ap50_interval"), "count": ("mae", "mae_interval")}


def interval(values: Sequence[float]) -> tuple[float, float]:
    """Mean and half of the 95 % interval of Student's t; values of several seeds."""
    mean = sum(values) / len(values)
    if len(values) < 2:
        return mean, math.nan
    deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))
    factor = _T[min(len(values) - 1, len(_T)) - 1]
    return mean, factor * deviation / math.sqrt(len(values))


def table(results: Sequence[dict[str, Any]]) -> list[str]:
    """Lines of Markdown: a row per training and test."""
    lines: list[str] = []
    for task, columns in _COLUMNS.items():
        rows = _grouped([result for result in results if result["task"] == task])
        if not rows:
            continue
        heads = [columns[0], "95 %", *columns[1:], *(["always the mean"] if task == "count" else [])]
        lines += ["", f"| training | images | test | seeds | {' | '.join(heads)} |", "|---" * (4 + len(heads)) + "|"]
        for (training, test), group in rows.items():
            images = sorted({result["trained_images"] for result in group})
            cells = [training, ", ".join(map(str, images)), test, str(len(group))]
            cells += [_cell(task, group, column) for column in columns]
            cells.insert(5, _interval_cell(task, group))
            if task == "count":
                cells.append(f"{group[0]['scores']['always_the_mean']['mae']:.2f}")
            lines.append(f"| {' | '.join(cells)} |")
    note = "95 %: of Student's t over the seeds; of one seed, of the bootstrap over the test's images. AP by size: COCO's areas."
    return [*lines, "", note]


def _grouped(results: Sequence[dict[str, Any]]) -> dict[tuple[str, str], list[dict[str, Any]]]:
    groups: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for result in results:
        groups.setdefault((result["training"], result["test"]), []).append(result)
    return groups


def _values(group: Sequence[dict[str, Any]], column: str) -> list[float]:
    return [float(result["scores"][column]) for result in group if result["scores"][column] is not None]


def _cell(task: str, group: Sequence[dict[str, Any]], column: str) -> str:
    values = _values(group, column)
    return f"{interval(values)[0]:.{3 if task == 'detect' else 2}f}" if values else "-"


def _interval_cell(task: str, group: Sequence[dict[str, Any]]) -> str:
    column, pair = _FIRST[task]
    values, digits = _values(group, column), 3 if task == "detect" else 2
    if not values:
        return "-"
    if len(values) > 1:
        return f"± {interval(values)[1]:.{digits}f}"
    low, high = group[0]["scores"][pair]
    return f"{low:.{digits}f} to {high:.{digits}f}"


def write(results: Sequence[dict[str, Any]], folder: Path) -> str:
    """Writes table.md, scores.json and, where matplotlib is installed, curves.svg; gives the table."""
    text = "\n".join(table(results)).strip() + "\n"
    (folder / "table.md").write_text(text, encoding="utf-8")
    (folder / "scores.json").write_text(json.dumps(list(results), indent=1), encoding="utf-8")
    if available("matplotlib") is not None:
        _draw(results, folder / "curves.svg")
    return text


def _draw(results: Sequence[dict[str, Any]], path: Path) -> None:
    """A panel per task; a line per experiment and test, whose x are frames or percent; what has no x is a level."""
    plt = require("matplotlib.pyplot", "curves.svg")
    tasks = [task for task in _COLUMNS if any(result["task"] == task for result in results)]
    figure, panels = plt.subplots(1, max(1, len(tasks)), figsize=(6 * max(1, len(tasks)), 4), squeeze=False)
    for axes, task in zip(panels[0], tasks):
        column = _FIRST[task][0]
        curves: dict[str, list[tuple[float, float, float]]] = {}
        for (training, test), group in _grouped([result for result in results if result["task"] == task]).items():
            if not (values := _values(group, column)):
                continue
            mean, half = interval(values)
            if group[0]["x"] is None:
                axes.axhline(mean, linestyle="--", linewidth=0.8, color="0.5")
                axes.annotate(f"{training}, {test}", (0.01, mean), xycoords=("axes fraction", "data"), fontsize=7)
            else:
                label = f"{training.rsplit('_', 1)[0]}, {test}"
                curves.setdefault(label, []).append((group[0]["x"], mean, 0 if math.isnan(half) else half))
        for label, points in curves.items():
            x, mean_values, halves = zip(*sorted(points))
            axes.errorbar(x, mean_values, halves, marker="o", capsize=3, label=label)
        if curves:
            axes.set_xscale("log")
            axes.legend(fontsize=7)
        axes.set(xlabel="frames or percent", ylabel={"ap50": "AP50", "mae": "MAE / people"}[column], title=task)
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
