#!/usr/bin/env python3
"""Writes the table of docs/crowd.md between its comments, from build/release/scripts/studies/crowd_gates.

usage: scripts/studies/crowd_figures.py [MODEL ...]    default: ttc weidmann orca
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from doc_blocks import replace_passage  # noqa: E402

RING = "flow in a ring 3 m wide at {} /m², 1/(m s)"
ROWS = (
    [(RING.format(density), f"fd_{density}", (0,)) for density in (0.6, 1.1, 1.6, 2.1, 2.9, 4, 6)]
    + [
        (f"the same at 1.6 /m², {width} m wide", name, (0,))
        for width, name in ((1.2, "ring_1.2_1.6"), (1.8, "ring_1.8_1.6"), (6, "ring_6_1.6"))
    ]
    + [(f"door of {width} m, 1/(m s)", f"door_{width}", (0,)) for width in (0.8, 1, 1.2, 2)]
    + [
        ("IMO 4: exit of 1 m, 1/s (at most 1.33)", "imo_4", (0,)),
        ("open square, 0.5 /m²: share who are stuck after 2 min", "square_0.5", (0,)),
        ("open square, 1 /m²: share who are stuck after 2 min", "square_1", (0,)),
        ("100 people through 2 m against 0, s", "room_0", (0,)),
        ("100 people through 2 m against 100, s", "room_100", (0,)),
        ("corridor 4 m wide, 0.75 /(m s) from each side: out on each, 1/(m s)", "two_way_0.75", (0, 1)),
    ]
    + [
        (f"corridor {width} m wide with people who wait, {text}, 1/(m s)", f"{name}_queued_{width}", (0,))
        for width in (2, 4)
        for text, name in (
            ("straight", "straight"),
            ("corner of a block", "corner"),
            ("corner of thin walls", "corner_thin"),
        )
    ]
    + [
        ("two who meet 0.3 m aside: one goes aside before, s", "meet_0.3", (0,)),
        ("their greatest acceleration, m/s²", "meet_0.3", (1,)),
        ("queue: turns per person and minute", "queue", (0,)),
        ("queue: stops per person and minute", "queue", (1,)),
    ]
)


def measure(model):
    program = ROOT / "build/release/scripts/studies/crowd_gates"
    lines = subprocess.run(
        [program, model, "seeds=2"], capture_output=True, encoding="utf-8", check=True
    ).stdout.splitlines()
    found = {}
    for line in lines:
        name, *runs = line.split("|")
        found[name.strip()] = [[float(word) for word in run.split()] for run in runs]
    return found


def cell(runs, columns):
    values = sorted(run[column] for run in runs for column in columns)
    low, high = f"{values[0]:.3g}", f"{values[-1]:.3g}"
    return low if low == high else f"{low} – {high}"


def main(models):
    figures = {model: measure(model) for model in models}
    table = ["| | " + " | ".join(f"`{model}`" for model in models) + " |", "|---" * (len(models) + 1) + "|"]
    for title, gate, columns in ROWS:
        table.append(f"| {title} | " + " | ".join(cell(figures[model][gate], columns) for model in models) + " |")
    page = ROOT / "docs/crowd.md"
    page.write_text(replace_passage(page.read_text(encoding="utf-8"), "crowd figures", table), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:] or ["ttc", "weidmann", "orca"])
