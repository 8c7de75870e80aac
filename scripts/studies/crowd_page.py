#!/usr/bin/env python3
"""Writes the table of docs/crowd.md of pedestrian models in the scenes of crowd_gates.

usage: scripts/studies/crowd_page.py [MODEL ...]    (default: all of the table; the columns of others stay as they are)
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/crowd.md"
ROWS = [(f"fd_{density}", 0) for density in (0.6, 1.1, 1.6, 2.1, 2.9, 4, 6)]
ROWS += [("ring_1.2_1.6", 0), ("ring_1.8_1.6", 0), ("ring_6_1.6", 0)]
ROWS += [(f"door_{width}", 0) for width in (0.8, 1, 1.2, 2)]
ROWS += [("imo_4", 0), ("square_0.5", 0), ("square_1", 0), ("room_0", 0), ("room_100", 0)]
ROWS += [("two_way_0.75", (0, 1)), ("two_way_0.75", 2)]
ROWS += [(f"{kind}_queued_{width}", 0) for width in (2, 4) for kind in ("straight", "corner", "corner_thin")]
ROWS += [("meet_0.3", 0), ("meet_0.3", 1), ("queue", 0), ("queue", 1)]


def column(model):
    """The cells of a model, in the order of the rows."""
    gates = ",".join(dict.fromkeys(name for name, _ in ROWS))
    program = ROOT / "build/release/scripts/studies/crowd_gates"
    words = [program, model, "seeds=2", "only=" + gates]
    lines = subprocess.run(words, capture_output=True, encoding="utf-8", check=True).stdout.splitlines()
    values = {}
    for line in lines:
        name, *runs = line.split("|")
        values[name.strip()] = [[float(word) for word in run.split()] for run in runs]
    cells = []
    for name, which in ROWS:
        places = which if isinstance(which, tuple) else (which,)
        found = [run[place] for run in values[name] for place in places]
        low, high = f"{min(found):.3g}", f"{max(found):.3g}"
        cells.append(low if low == high else f"{low} – {high}")
    return cells


def main():
    page = PAGE.read_text(encoding="utf-8")
    table = re.search(r"^\| \| `ttc` \|.*\n\|[-|]+\n((?:\|.*\n)+)", page, re.M)
    models = re.findall(r"`(\w+)`", table[0].splitlines()[0])
    rows = [line.strip("|\n").split("|") for line in table[1].splitlines()]
    assert len(rows) == len(ROWS), "the table has the rows of this script"
    for model in sys.argv[1:] or models:
        for row, cell in zip(rows, column(model)):
            row[1 + models.index(model)] = f" {cell} "
    text = "".join("|" + "|".join(row) + "|\n" for row in rows)
    PAGE.write_text(page.replace(table[1], text), encoding="utf-8")


if __name__ == "__main__":
    main()
