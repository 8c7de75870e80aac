"""Damages to counts in zones and across lines, and to fields with other cells."""
import json

import numpy

from .dataset import damage, damage_by, damage_of_labels
from .rasters import change_npy


def changed(d, change, run=0):
    """Changes rows of counts/RUN.csv, which change() finds among them."""
    name = f"counts/{d.runs[run]}.csv"
    head, rows = d.table(name)
    change([row for row in rows])
    d.save_table(name, head, rows)


@damage_of_labels
def count_of_visible_people_one_more(d):
    d.image()["zones"][-1]["visible"] += 1


@damage_by(changed)
def people_inside_one_more(rows):
    row = next(row for row in rows if row[0] == "2" and row[3] == "yard")
    row[4] = str(int(row[4]) + 1)


@damage_by(changed)
def somebody_enters_who_was_inside(rows):
    first = next(row for row in rows if row[0] == "0" and row[3] == "yard")
    row = next(row for row in rows if row[0] == "2" and row[3] == "yard")
    row[7] = " ".join([*row[7].split(), first[7].split()[0]])
    row[5], row[4] = str(int(row[5]) + 1), str(int(row[4]) + 1)


@damage
def zones_of_another_place(d):
    name = f"counts/{d.runs[0]}.json"
    areas = json.loads(d.path(name).read_text())
    areas["zones"][-1]["corners"] = [[x + 4, y] for x, y in areas["zones"][-1]["corners"]]
    d.write(name, json.dumps(areas) + "\n")


@damage
def lines_in_the_other_direction(d):
    for run in d.runs:
        name = f"counts/{run}.json"
        areas = json.loads(d.path(name).read_text())
        for line in areas["lines"]:
            line["start"], line["end"] = line["end"], line["start"]
        d.write(name, json.dumps(areas) + "\n")


DAMAGES = {
    "counts of the other run": lambda d: d.exchange(f"counts/{d.runs[0]}.csv", f"counts/{d.runs[1]}.csv"),
    "coarse field mirrored": lambda d: change_npy(
        d, f"fields/{d.runs[0]}/cell_2/000001.npy", lambda a: numpy.ascontiguousarray(a[:, :, ::-1])
    ),
    "coarse fields 10 percent more": lambda d: change_npy(
        d, f"fields/{d.runs[0]}/cell_2/000001.npy", lambda a: a * numpy.float32(1.1)
    ),
}
