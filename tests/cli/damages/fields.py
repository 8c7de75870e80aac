"""Damages to density maps and fields on the ground."""
import json

import numpy

from .dataset import damage, damage_of_labels
from .rasters import change_npy, read_npy


@damage_of_labels
def density_map_without_somebody(d):
    image = d.image()
    image["density_count"] -= 1

    def lift(a):
        y, x = numpy.unravel_index(a.argmax(), a.shape)
        Y, X = numpy.mgrid[: a.shape[0], : a.shape[1]]
        kernel = numpy.exp(-((X - x) ** 2 + (Y - y) ** 2) / 32.0) * (abs(X - x) < 17) * (abs(Y - y) < 17)
        return numpy.maximum(a - kernel / kernel.sum(), 0)

    change_npy(d, image["density_file"], lift)


def field_names(d, run=0):
    return sorted(str(p.relative_to(d.root)) for p in (d.path("fields") / d.runs[run]).glob("*.npy"))


@damage
def fields_turned_by_180_degrees(d):
    for name in field_names(d):
        change_npy(d, name, lambda a: a[:, ::-1, ::-1])


@damage
def field_origin_1_m_off(d):
    name = f"fields/{d.runs[0]}.json"
    grid = json.loads(d.path(name).read_text())
    grid["origin_m"][0] += 1
    d.write(name, json.dumps(grid, indent=2) + "\n")


@damage
def fields_one_frame_late(d):
    names = field_names(d)
    data = [d.path(n).read_bytes() for n in names]
    for name, other in zip(names[1:], data):
        d.write(name, other)


@damage
def fields_of_the_other_run(d):
    for one, two in zip(field_names(d), field_names(d, 1)):
        d.exchange(one, two)


@damage
def density_maps_10_percent_more(d):
    for image in d.images:
        change_npy(d, image["density_file"], lambda a: 1.1 * a)


@damage_of_labels
def density_maps_and_counts_doubled(d):
    for image in d.images:
        change_npy(d, image["density_file"], lambda a: 2 * a)
        image["density_count"] *= 2


def spoil_middle(value):
    def spoil(a):
        a[..., a.shape[-2] // 2, a.shape[-1] // 2] = value
        return a

    return spoil


@damage
def fields_10_percent_more(d):
    for name in field_names(d):
        change_npy(d, name, lambda a: a * numpy.array([1.1, 1, 1, 1.1])[:, None, None])


@damage
def field_velocities_in_km_per_h(d):
    for name in field_names(d):
        change_npy(d, name, lambda a: a * numpy.array([1, 3.6, 3.6, 1])[:, None, None])


@damage
def fields_with_twice_the_cells(d):
    name = f"fields/{d.runs[0]}.json"
    grid = json.loads(d.path(name).read_text())
    grid["cell_m"] *= 1.05
    d.write(name, json.dumps(grid, indent=2) + "\n")


@damage
def field_people_one_more(d):
    name = f"fields/{d.runs[0]}.json"
    text = d.path(name).read_text()
    grid = json.loads(text)
    key = next(k for k, v in grid.items() if k in ("people", "frames"))
    if isinstance(grid[key], list):
        entry = grid[key][1]
        if isinstance(entry, dict):
            entry["people"] += 1
        else:
            grid[key][1] += 1
    d.write(name, json.dumps(grid, indent=2) + "\n")


DAMAGES = {
    "density map 2 px off": lambda d: change_npy(d, d.image()["density_file"], lambda a: numpy.roll(a, 2, 1)),
    "density map of another picture": lambda d: change_npy(
        d, d.image(0)["density_file"], lambda a: read_npy(d.path(d.image(0, 0)["density_file"])) * 1
    ),
    "field mirrored": lambda d: change_npy(d, field_names(d)[2], lambda a: a[:, :, ::-1]),
    "field velocities reversed": lambda d: change_npy(
        d, field_names(d)[2], lambda a: numpy.stack([a[0], -a[1], -a[2], a[3]])
    ),
    "field velocity axes exchanged": lambda d: change_npy(d, field_names(d)[2], lambda a: a[[0, 2, 1, 3]]),
    "field one cell off": lambda d: change_npy(d, field_names(d)[2], lambda a: numpy.roll(a, 1, 2)),
    "field voronoi doubled": lambda d: change_npy(
        d, field_names(d)[2], lambda a: a * numpy.array([1, 1, 1, 2])[:, None, None]
    ),
    "field planes of density exchanged": lambda d: change_npy(d, field_names(d)[2], lambda a: a[[3, 1, 2, 0]]),
    "density map mirrored": lambda d: change_npy(d, d.image()["density_file"], lambda a: a[:, ::-1]),
    "density map with nan": lambda d: change_npy(d, d.image()["density_file"], spoil_middle(numpy.nan)),
    "field with nan": lambda d: change_npy(d, field_names(d)[1], spoil_middle(numpy.nan)),
    "field with infinity": lambda d: change_npy(d, field_names(d)[1], spoil_middle(numpy.inf)),
    "field upside down": lambda d: change_npy(d, field_names(d)[2], lambda a: a[:, ::-1]),
}
