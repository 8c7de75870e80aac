"""Damages to cars and trains. The dataset shows some, and was written with "vehicles"."""
import numpy

from .dataset import damage_of_labels
from .runs import BUILDING, GRASS, PAVEMENT, ROAD, TERRAIN, WALL, change_class, exchange_classes
from .rasters import mask_of, segmentation_of
from .shapes import shifted

CATEGORIES = (3, 4)


def vehicles(d, image=None):
    found = [a for a in d.coco["annotations"] if a["category_id"] in CATEGORIES and image in (None, a["image_id"])]
    assert found, "no vehicles"
    return found


def largest(d):
    return max(vehicles(d), key=lambda vehicle: vehicle["area"])


@damage_of_labels
def vehicle_left_out(d):
    vehicle = largest(d)
    d.coco["annotations"].remove(vehicle)
    next(i for i in d.images if i["id"] == vehicle["image_id"])["counts"]["vehicles"] -= 1


@damage_of_labels
def vehicles_of_one_image_left_out(d):
    image = next(i for i in d.images if i["id"] == largest(d)["image_id"])
    for vehicle in vehicles(d, image["id"]):
        d.coco["annotations"].remove(vehicle)
    del image["counts"]["vehicles"]


@damage_of_labels
def vehicle_count_one_more(d):
    next(i for i in d.images if i["id"] == largest(d)["image_id"])["counts"]["vehicles"] += 1


@damage_of_labels
def vehicle_box_2_px_wider(d):
    largest(d)["bbox"][2] += 2


@damage_of_labels
def vehicle_category_exchanged(d):
    vehicle = largest(d)
    vehicle["category_id"] = 7 - vehicle["category_id"]


@damage_of_labels
def vehicle_track_and_category_exchanged(d):
    vehicle = largest(d)
    names = {3: "train", 4: "car"}
    track = next(t for t in d.coco["tracks"] if t["id"] == vehicle["track_id"])
    track["vehicle"] = names[vehicle["category_id"]]
    for other in vehicles(d):
        if other["track_id"] == vehicle["track_id"]:
            other["category_id"] = 7 - other["category_id"]


@damage_of_labels
def vehicle_tracks_exchanged_in_one_image(d):
    image = largest(d)["image_id"]
    a, b = sorted(vehicles(d, image), key=lambda v: -v["area"])[:2]
    for key in ("track_id", "id"):
        a[key], b[key] = b[key], a[key]
    d.coco["annotations"].sort(key=lambda v: v["id"])


@damage_of_labels
def vehicle_mask_moved(d):
    vehicle = largest(d)
    mask = shifted(mask_of(vehicle["segmentation"]), 4, 2)
    vehicle["segmentation"] = segmentation_of(mask)


@damage_of_labels
def vehicle_box_3d_1_m_off(d):
    largest(d)["box_3d"][0] += 1


@damage_of_labels
def vehicle_boxes_3d_turned_by_90_degrees(d):
    for vehicle in vehicles(d):
        vehicle["heading"] = round(vehicle["heading"] + numpy.pi / 2, 2)


@damage_of_labels
def vehicle_boxes_3d_twice_as_high(d):
    for vehicle in vehicles(d):
        vehicle["box_3d"][5] *= 2
        vehicle["box_3d"][2] = vehicle["box_3d"][5] / 2


@damage_of_labels
def vehicle_in_motion(d):
    largest(d)["velocity"] = [1.5, 0, 0]


@damage_of_labels
def vehicle_place_jumps(d):
    """In one image it stands somewhere else."""
    vehicle = largest(d)
    vehicle["position"][1] += 3


@damage_of_labels
def vehicle_visibility_is_a_half(d):
    vehicle = largest(d)
    vehicle["visibility"] = 0.5 if vehicle["visibility"] > 0.7 else 1


@damage_of_labels
def vehicle_amodal_box_is_5_px_off(d):
    largest(d)["bbox_amodal"][0] -= 5


DAMAGES = {
    "semantic land called pavement": lambda d: change_class(d, TERRAIN, PAVEMENT),
    "semantic walls called facades": lambda d: change_class(d, WALL, BUILDING),
    "semantic road and pavement exchanged": lambda d: exchange_classes(d, d.images, ROAD, PAVEMENT),
    "semantic grass and road exchanged": lambda d: exchange_classes(d, d.images, GRASS, ROAD),
}
