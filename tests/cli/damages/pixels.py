"""Damages to depth, normals, flow, parts and instances."""
import numpy

from .dataset import damage, walker
from .rasters import ids_to_rgb, instances, is_building, is_person, png_bytes, raster_name


def scale_depth(d, image, factor, where):
    ids = instances(d, image)
    d.change_raster(
        "depth",
        image,
        lambda a: numpy.where(where(ids)[..., None], numpy.minimum(a * factor, 65535), a).round().astype(a.dtype),
    )


@damage
def depth_of_buildings_5_percent_more(d):
    for image in d.images:
        scale_depth(d, image, 1.05, is_building)


@damage
def depth_of_buildings_4_percent_less(d):
    for image in d.images:
        scale_depth(d, image, 0.96, is_building)


@damage
def depth_of_one_building(d):
    image = d.image()
    ids = instances(d, image)
    values, counts = numpy.unique(ids[is_building(ids)], return_counts=True)
    scale_depth(d, image, 1.04, lambda i: i == values[counts.argmax()])


@damage
def depth_of_props(d):
    image = d.image()
    scale_depth(d, image, 1.08, lambda i: (i >= 0xC00000) & (i < 0xE00000))


@damage
def depth_of_one_person_1_m_more(d):
    image = d.image()
    number = d.largest(image)["track_id"] % 1000000
    ids = instances(d, image)
    d.change_raster("depth", image, lambda a: (a + 100 * (ids == number)[..., None]).astype(a.dtype))


@damage
def depth_along_the_ray(d):
    image = d.image()
    k = image["camera"]["K"]
    y, x = numpy.mgrid[: image["height"], : image["width"]]
    ray = numpy.sqrt(1 + ((x - k[0][2]) / k[0][0]) ** 2 + ((y - k[1][2]) / k[1][1]) ** 2)
    d.change_raster("depth", image, lambda a: (a[..., 0] * ray).clip(0, 65535).round()[..., None].astype(a.dtype))


def change_normals(d, images, change, where=lambda ids: ids > 0):
    for image in images:
        ids = instances(d, image)
        name, a = d.raster("normals", image)
        n = (a.astype(float) - 128) / 127
        changed = numpy.where(where(ids)[..., None], numpy.rint(128 + 127 * change(n)), a).astype(numpy.uint8)
        assert not numpy.array_equal(a, changed), "nothing changed"
        d.write(name, png_bytes(changed))


@damage
def normals_turned_by_20_degrees(d):
    c, s = numpy.cos(0.35), numpy.sin(0.35)
    change_normals(d, [d.image()], lambda n: n @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))


@damage
def normals_in_camera_axes(d):
    image = d.image()
    change_normals(d, [image], lambda n: n @ numpy.array(image["camera"]["R"]).T)


def change_flow(d, images, change, where=lambda ids: ids >= 0, kind="flow"):
    for image in images:
        ids = instances(d, image)
        name, a = d.raster(kind, image)
        flow = (a[..., :2].astype(float) - 32768) / 64
        changed = a.copy()
        known = (a[..., 2] > 0) & where(ids)
        new = numpy.rint(change(flow) * 64 + 32768).clip(0, 65535).astype(numpy.uint16)
        changed[..., :2] = numpy.where(known[..., None], new, a[..., :2])
        assert not numpy.array_equal(a, changed), "nothing changed"
        d.write(name, png_bytes(changed))


def moving(d):
    return [i for i in d.images if i["camera_id"] == d.cameras[-1] and i["frame"] < d.frames - 1]


@damage
def flow_of_one_person_reversed(d):
    image = d.image(0)
    number = walker(d, image)["track_id"] % 1000000
    change_flow(d, [image], lambda f: -f, lambda ids: ids == number)


@damage
def flow_half_unknown(d):
    def forget(a):
        a[:, : a.shape[1] // 2] = 0
        return a

    d.change_raster("flow", d.image(), forget)


SIDES = numpy.array([0, 1, 2, 4, 3, 6, 5, 8, 7, 9], numpy.uint8)


@damage
def parts_left_and_right_exchanged(d):
    for image in d.images:
        d.change_raster("parts", image, lambda a: SIDES[a])


@damage
def parts_of_one_person_left_and_right_exchanged(d):
    image = d.image()
    best = d.largest(image)
    ids = instances(d, image)
    mask = (ids == best["track_id"] % 1000000)[..., None]
    d.change_raster("parts", image, lambda a: numpy.where(mask, SIDES[a], a))


@damage
def parts_heads_and_torsos_exchanged(d):
    table = numpy.array([0, 2, 1, 3, 4, 5, 6, 7, 8, 9], numpy.uint8)
    d.change_raster("parts", d.image(), lambda a: table[a])


@damage
def parts_arms_and_legs_exchanged(d):
    table = numpy.array([0, 1, 2, 5, 6, 3, 4, 7, 8, 9], numpy.uint8)
    d.change_raster("parts", d.image(), lambda a: table[a])


@damage
def ids_of_two_buildings_exchanged(d):
    image = d.image(0)
    ids = instances(d, image)
    values, counts = numpy.unique(ids[is_building(ids)], return_counts=True)
    a, b = values[numpy.argsort(-counts)[:2]]
    one, two = ids == a, ids == b
    ids[one], ids[two] = b, a
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


@damage
def building_called_prop(d):
    image = d.image()
    ids = instances(d, image)
    values, counts = numpy.unique(ids[is_building(ids)], return_counts=True)
    ids[ids == values[counts.argmax()]] = 0xC00003
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


@damage
def ground_called_building(d):
    image = d.image()
    ids = instances(d, image)
    h, w = ids.shape
    patch = ids[2 * h // 3 :, w // 3 : 2 * w // 3]
    patch[patch == 0xFF0000] = 0x800001
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


@damage
def depth_2_percent_more_everywhere(d):
    for image in d.images:
        scale_depth(d, image, 1.02, lambda i: i >= 0)


@damage
def depth_of_people_2_percent_more(d):
    for image in d.images:
        scale_depth(d, image, 1.02, is_person)


@damage
def depth_unknown_in_a_patch(d):
    def forget(a):
        a[: a.shape[0] // 3, : a.shape[1] // 3] = 0
        return a

    d.change_raster("depth", d.image(), forget)


@damage
def ids_of_people_one_more(d):
    for image in d.images:
        ids = instances(d, image)
        ids[is_person(ids)] += 1
        d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


@damage
def instances_2_px_off(d):
    image = d.image()
    name, array = d.raster("instances", image)
    d.write(name, png_bytes(numpy.roll(array, 2, 1)))


DAMAGES = {
    "depth of buildings in one picture": lambda d: scale_depth(d, d.image(0), 0.97, is_building),
    "depth 1 percent more": lambda d: scale_depth(d, d.image(), 1.01, lambda i: i >= 0),
    "depth of the frame before": lambda d: d.copy(
        raster_name("depth", d.image(-1, 1)), raster_name("depth", d.image(-1, 2))
    ),
    "normals flipped": lambda d: change_normals(d, d.images, lambda n: -n),
    "normals of buildings flipped in one picture": lambda d: change_normals(d, [d.image()], lambda n: -n, is_building),
    "normals of people flipped": lambda d: change_normals(d, d.images, lambda n: -n, is_person),
    "normal axes exchanged": lambda d: change_normals(d, d.images, lambda n: n[..., [1, 0, 2]]),
    "normals of the frame before": lambda d: d.copy(
        raster_name("normals", d.image(-1, 1)), raster_name("normals", d.image(-1, 2))
    ),
    "flow reversed": lambda d: change_flow(d, moving(d), lambda f: -f),
    "flow axes exchanged": lambda d: change_flow(d, moving(d)[1:2], lambda f: f[..., ::-1]),
    "flow of still pixels zero": lambda d: change_flow(d, moving(d)[1:2], lambda f: 0 * f, lambda ids: ~is_person(ids)),
    "flow of people zero": lambda d: change_flow(d, [d.image(0)], lambda f: 0 * f, is_person),
    "flow 5 percent more": lambda d: change_flow(d, moving(d)[1:2], lambda f: 1.05 * f),
    "flow of the frame before": lambda d: d.copy(
        raster_name("flow", d.image(-1, 1)), raster_name("flow", d.image(-1, 2))
    ),
    "flow of the last frame": lambda d: d.copy(
        raster_name("flow", d.image(-1, d.frames - 2)), raster_name("flow", d.image(-1, d.frames - 1))
    ),
    "parts all torso": lambda d: d.change_raster(
        "parts", d.image(), lambda a: numpy.where(a > 0, 2, 0).astype(a.dtype)
    ),
    "depth mirrored": lambda d: d.change_raster("depth", d.image(), lambda a: a[:, ::-1]),
    "depth in millimeters": lambda d: d.change_raster(
        "depth", d.image(), lambda a: numpy.minimum(a.astype(int) * 10, 65535).astype(a.dtype)
    ),
    "depth of the other camera": lambda d: d.copy(raster_name("depth", d.image(0)), raster_name("depth", d.image(1))),
    "normals mirrored": lambda d: change_normals(d, d.images, lambda n: n * numpy.array([-1, 1, 1])),
    "normals all up": lambda d: change_normals(d, [d.image()], lambda n: 0 * n + numpy.array([0, 0, 1])),
    "flow in half units": lambda d: change_flow(d, moving(d), lambda f: f / 2),
    "flow 2 px off": lambda d: change_flow(d, moving(d)[1:2], lambda f: f + numpy.array([2, 0])),
    "flow of people 1 px off everywhere": lambda d: change_flow(
        d, [i for i in d.images if i["frame"] < d.frames - 1], lambda f: f + numpy.array([1, 1]), is_person
    ),
    "parts 2 px off": lambda d: d.change_raster("parts", d.image(), lambda a: numpy.roll(a, 2, 1)),
    "parts of two frames exchanged": lambda d: d.exchange(
        raster_name("parts", d.image(-1, 1)), raster_name("parts", d.image(-1, 2))
    ),
    "semantic people called umbrellas": lambda d: d.change_raster(
        "semantic", d.image(), lambda a: numpy.where(a == 4, 5, a).astype(a.dtype)
    ),
    "semantic mirrored": lambda d: d.change_raster("semantic", d.image(), lambda a: a[:, ::-1]),
    "semantic props called buildings": lambda d: d.change_raster(
        "semantic", d.image(), lambda a: numpy.where(a >= 17, 2, a).astype(a.dtype)
    ),
}
