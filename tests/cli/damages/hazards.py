"""Damages to hazards and dangers. The dataset shows people after a disaster began."""
import numpy as np

from .dataset import damage
from .rasters import raster_name


def image_with_hazard(d):
    found = [i for i in d.images if i["hazards"] and d.people(i)]
    assert found, "no hazards"
    return found[len(found) // 2]


@damage
def hazard_left_out(d):
    image_with_hazard(d)["hazards"].pop()
    d.save_coco()


@damage
def hazard_3_m_off(d):
    image_with_hazard(d)["hazards"][0]["position"][0] += 3
    d.save_coco()


@damage
def hazard_areas_10_px_off(d):
    for image in d.images:
        for hazard in image["hazards"]:
            hazard["area"] = [[x + 10, y] for x, y in hazard["area"]]
    d.save_coco()


@damage
def hazards_twice_as_large(d):
    for image in d.images:
        for hazard in image["hazards"]:
            hazard["radius_m"] = round(2 * hazard["radius_m"], 3)
    d.save_coco()


@damage
def hazard_of_another_kind(d):
    hazard = image_with_hazard(d)["hazards"][0]
    hazard["kind"] = "gas" if hazard["kind"] != "gas" else "fire"
    d.save_coco()


@damage
def hazards_of_another_kind(d):
    for image in d.images:
        for hazard in image["hazards"]:
            hazard["kind"] = "fire" if hazard["kind"] != "fire" else "explosion"
    d.save_coco()


@damage
def hazard_begins_later(d):
    image = image_with_hazard(d)
    image["hazards"][0]["start_s"] = image["time_s"] + 5
    d.save_coco()


@damage
def danger_from_the_middle(d):
    for person in d.everybody:
        if "danger" in person and person["danger"]["distance_m"] > 0:
            person["danger"]["distance_m"] = round(person["danger"]["distance_m"] + 2, 2)
    d.save_coco()


@damage
def danger_left_out(d):
    del d.people(image_with_hazard(d))[0]["danger"]
    d.save_coco()


@damage
def time_in_danger_is_a_minute(d):
    d.people(image_with_hazard(d))[0]["danger"]["inside_s"] = 60
    d.save_coco()


@damage
def opacity_of_smoke_called_gas(d):
    d.change_raster("hazard_opacity", image_with_hazard(d), lambda a: a[..., [0, 2, 1]])


@damage
def opacity_of_fire_upside_down(d):
    def moved(image):  # by how many rows the middle of the flames would be
        shown = (d.raster("hazard_opacity", image)[1][..., 0] > 0).sum(axis=1)
        if shown.sum() == 0:
            return 0
        return abs((np.arange(len(shown)) * shown).sum() / shown.sum() - (len(shown) - 1) / 2)

    d.change_raster("hazard_opacity", max(d.images, key=moved), lambda a: a[::-1])


def change_opacity(d, change):
    for image in d.images:
        if d.raster("hazard_opacity", image)[1].any():
            d.change_raster("hazard_opacity", image, change)


@damage
def opacity_left_out(d):
    change_opacity(d, np.zeros_like)


@damage
def opacity_halved(d):
    change_opacity(d, lambda a: a // 2)


@damage
def opacity_of_fire_and_smoke_exchanged(d):
    change_opacity(d, lambda a: a[..., [1, 0, 2]])


@damage
def opacity_before_the_fire(d):
    early = next(i for i in d.images if not i["hazards"])
    d.copy(raster_name("hazard_opacity", image_with_hazard(d)), raster_name("hazard_opacity", early))
