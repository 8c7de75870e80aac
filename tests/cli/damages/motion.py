"""Damages to backward flow, flow's occlusion and scene flow."""
import numpy

from .dataset import damage, walker
from .pixels import change_flow, moving
from .rasters import instances, is_person, png_bytes, raster_name


def change_scene_flow(d, image, change, where=lambda ids: ids >= 0):
    """Changes motion (mm) where it is known and the ids are those asked for."""
    name, a = d.raster("scene_flow", image)
    known = (a != 0).any(axis=-1) & where(instances(d, image))
    new = numpy.rint(change(a.astype(float) - 32768) + 32768).clip(1, 65535).astype(numpy.uint16)
    changed = numpy.where(known[..., None], new, a)
    assert not numpy.array_equal(a, changed), "nothing changed"
    d.write(name, png_bytes(changed))


def change_targets(d, image, table):
    name, a = d.raster("flow_occlusion", image)
    changed = numpy.array(table, numpy.uint8)[a]
    assert not numpy.array_equal(a, changed), "nothing changed"
    d.write(name, png_bytes(changed))


@damage
def backward_flow_is_forward_flow(d):
    image = moving(d)[1]
    d.copy(raster_name("flow", image), raster_name("flow_backward", image))


@damage
def scene_flow_a_tenth_less(d):
    for image in d.images:
        if image["frame"] < d.frames - 1:
            change_scene_flow(d, image, lambda m: 0.9 * m)


@damage
def scene_flow_of_one_person_zero(d):
    image = d.image(0)
    number = walker(d, image)["track_id"] % 1000000
    change_scene_flow(d, image, lambda m: 0 * m, lambda ids: ids == number)


@damage
def scene_flow_of_the_last_frame(d):
    last = d.image(-1, d.frames - 1)
    d.copy(raster_name("scene_flow", d.image(-1, d.frames - 2)), raster_name("scene_flow", last))


DAMAGES = {
    "backward flow reversed": lambda d: change_flow(d, moving(d)[1:2], lambda f: -f, kind="flow_backward"),
    "backward flow of people zero": lambda d: change_flow(
        d, moving(d)[1:2], lambda f: 0 * f, is_person, "flow_backward"
    ),
    "backward flow of the first frame": lambda d: d.copy(
        raster_name("flow_backward", d.image(-1, 1)), raster_name("flow_backward", d.image(-1, 0))
    ),
    "occlusion all visible": lambda d: change_targets(d, moving(d)[1], [0, 1, 1, 1]),
    "occlusion inverted": lambda d: change_targets(d, moving(d)[1], [0, 2, 1, 3]),
    "occlusion outside is hidden": lambda d: change_targets(d, moving(d)[1], [0, 1, 2, 2]),
    "occlusion of the frame before": lambda d: d.copy(
        raster_name("flow_occlusion", d.image(-1, 1)), raster_name("flow_occlusion", d.image(-1, 2))
    ),
    "occlusion of unknown values": lambda d: change_targets(d, moving(d)[1], [0, 1, 4, 3]),
    "scene flow reversed": lambda d: change_scene_flow(d, d.image(0), lambda m: -m),
    "scene flow axes exchanged": lambda d: change_scene_flow(d, d.image(0), lambda m: m[..., [1, 0, 2]]),
    "scene flow in centimeters": lambda d: change_scene_flow(d, d.image(0), lambda m: m / 10),
    "scene flow of still pixels 5 cm": lambda d: change_scene_flow(
        d, d.image(0), lambda m: m + [50, 0, 0], lambda ids: ~is_person(ids)
    ),
}
