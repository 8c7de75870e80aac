"""Damages to hazards and dangers. The dataset shows people after a disaster began."""
import numpy as np

from .dataset import damage, damage_by, damage_of_labels, each_image, each_person
from .rasters import raster_name


def image_with_hazard(d):
    found = [i for i in d.images if i["hazards"] and d.people(i)]
    assert found, "no hazards"
    return found[len(found) // 2]


@damage_of_labels
def hazard_left_out(d):
    image_with_hazard(d)["hazards"].pop()


@damage_of_labels
def hazard_3_m_off(d):
    image_with_hazard(d)["hazards"][0]["position"][0] += 3


@damage_by(each_image)
def hazard_areas_10_px_off(image):
    for hazard in image["hazards"]:
        hazard["area"] = [[x + 10, y] for x, y in hazard["area"]]


@damage_by(each_image)
def hazards_twice_as_large(image):
    for hazard in image["hazards"]:
        hazard["radius_m"] = round(2 * hazard["radius_m"], 3)


@damage_of_labels
def hazard_of_another_kind(d):
    hazard = image_with_hazard(d)["hazards"][0]
    hazard["kind"] = "gas" if hazard["kind"] != "gas" else "fire"


@damage_by(each_image)
def hazards_of_another_kind(image):
    for hazard in image["hazards"]:
        hazard["kind"] = "fire" if hazard["kind"] != "fire" else "explosion"


@damage_of_labels
def hazard_begins_later(d):
    image = image_with_hazard(d)
    image["hazards"][0]["start_s"] = image["time_s"] + 5


@damage_by(each_person)
def danger_from_the_middle(person):
    if "danger" in person and person["danger"]["distance_m"] > 0:
        person["danger"]["distance_m"] = round(person["danger"]["distance_m"] + 2, 2)


@damage_of_labels
def danger_left_out(d):
    del d.people(image_with_hazard(d))[0]["danger"]


@damage_of_labels
def time_in_danger_is_a_minute(d):
    d.people(image_with_hazard(d))[0]["danger"]["inside_s"] = 60


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
def opacity_before_the_fire(d):
    early = next(i for i in d.images if not i["hazards"])
    d.copy(raster_name("hazard_opacity", image_with_hazard(d)), raster_name("hazard_opacity", early))


DAMAGES = {
    "opacity of smoke called gas": lambda d: d.change_raster(
        "hazard_opacity", image_with_hazard(d), lambda a: a[..., [0, 2, 1]]
    ),
    "opacity left out": lambda d: change_opacity(d, np.zeros_like),
    "opacity halved": lambda d: change_opacity(d, lambda a: a // 2),
    "opacity of fire and smoke exchanged": lambda d: change_opacity(d, lambda a: a[..., [1, 0, 2]]),
}
