"""Damages to boxes, heads, amodal masks and hidden people."""
import numpy

from .dataset import damage_by, damage_of_labels, each_image, each_person, each_person_of_an_image, two_people
from .rasters import mask_of, segmentation_of


@damage_of_labels
def box_3d_30_cm_off(d):
    person = d.largest(d.image())
    person["box_3d"][0] = round(person["box_3d"][0] + 0.3, 2)


@damage_by(each_person)
def boxes_3d_20_percent_too_large(person):
    person["box_3d"][3:] = [round(1.2 * v, 2) for v in person["box_3d"][3:]]


@damage_by(each_person_of_an_image)
def box_3d_sizes_exchanged(person):
    b = person["box_3d"]
    b[3], b[5] = b[5], b[3]


@damage_of_labels
def head_of_one_person_off(d):
    person = d.largest(d.image())
    person["head"] = [person["head"][0] + 6, person["head"][1] + 4]


@damage_by(each_person_of_an_image)
def heads_at_the_feet(person):
    x, y, w, h = person["bbox_amodal"]
    if person["head"]:
        person["head"] = [round(x + w / 2, 2), round(y + 0.95 * h, 2)]


@damage_of_labels
def amodal_box_4_px_off(d):
    person = d.largest(d.image(), lambda p: p["visibility"] > 0.95 and "truncation" not in p)
    person["bbox_amodal"][0] += 4


@damage_by(each_person_of_an_image)
def amodal_boxes_are_visible_boxes(person):
    person["bbox_amodal"] = person["bbox"]


def shifted(mask, dx, dy):
    return numpy.roll(numpy.roll(mask, dx, 1), dy, 0)


@damage_by(each_person)
def amodal_masks_moved(person):
    mask = mask_of(person["amodal_segmentation"])
    visible = mask_of(person["segmentation"])
    person["amodal_segmentation"] = segmentation_of(shifted(mask, 3, 0) | visible)


@damage_of_labels
def amodal_mask_of_one_person_moved(d):
    person = d.largest(d.image(), lambda p: p["visibility"] < 0.9 and "truncation" not in p)
    person["amodal_segmentation"] = segmentation_of(shifted(mask_of(person["amodal_segmentation"]), 4, 3))


@damage_of_labels
def amodal_mask_is_visible_mask(d):
    person = d.largest(d.image(), lambda p: p["visibility"] < 0.8 and "truncation" not in p)
    person["amodal_segmentation"] = person["segmentation"]
    person["area_amodal"] = person["area"]
    person["visibility"] = 1


@damage_of_labels
def amodal_mask_is_its_box(d):
    person = d.largest(d.image(), lambda p: "truncation" not in p)
    mask = mask_of(person["amodal_segmentation"])
    rows, columns = numpy.flatnonzero(mask.any(1)), numpy.flatnonzero(mask.any(0))
    mask[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1] = True
    person["amodal_segmentation"] = segmentation_of(mask)
    person["area_amodal"] = int(mask.sum())
    person["visibility"] = float(f"{person['area'] / person['area_amodal']:.3g}")


@damage_by(each_image)
def hidden_people_left_out(image):
    image["counts"]["all"] -= len(image.pop("hidden", []))


@damage_of_labels
def hidden_people_of_one_picture_left_out(d):
    image = max(d.images, key=lambda i: len(i.get("hidden", [])) * (0 < i["frame"] < d.frames - 1))
    image["counts"]["all"] -= len(image.pop("hidden"))


@damage_by(each_image)
def hidden_boxes_moved(image):
    for person in image.get("hidden", []):
        person["bbox_amodal"][0] += 25 if person["bbox_amodal"][0] < image["width"] / 2 else -25


@damage_by(each_image)
def hidden_people_exchanged(image):
    hidden = image.get("hidden", [])
    ids = [p["track_id"] for p in hidden]
    for person, other in zip(hidden, ids[1:] + ids[:1]):
        person["track_id"] = other


@damage_by(each_person_of_an_image)
def boxes_2_px_to_the_right(person):
    person["bbox"][0] += 2
    person["bbox_amodal"][0] += 2


@damage_by(each_person)
def amodal_boxes_2_px_down_everywhere(person):
    person["bbox_amodal"][1] += 2


def move_mask(person, dx, dy):
    """The mask with its box and area, and the amodal ones, as if the person were there."""
    mask, whole = (shifted(mask_of(person[key]), dx, dy) for key in ("segmentation", "amodal_segmentation"))
    rows, columns = numpy.flatnonzero(mask.any(1)), numpy.flatnonzero(mask.any(0))
    person["bbox"] = [int(columns[0]), int(rows[0]), int(columns[-1] - columns[0] + 1), int(rows[-1] - rows[0] + 1)]
    person["segmentation"] = segmentation_of(mask)
    person["amodal_segmentation"] = segmentation_of(whole)
    person["bbox_amodal"][0] += dx
    person["bbox_amodal"][1] += dy


def well_inside(person, image):
    x, y, w, h = person["bbox_amodal"]
    return x > 5 and y > 5 and x + w < image["width"] - 5 and y + h < image["height"] - 5


@damage_of_labels
def masks_and_boxes_of_one_person_3_px_off(d):
    image = d.image()
    move_mask(d.largest(image, lambda p: well_inside(p, image)), 3, 0)


@damage_of_labels
def masks_and_boxes_of_all_people_2_px_off(d):
    for image in d.images:
        for person in d.people(image):
            if well_inside(person, image):
                move_mask(person, 2, 0)


@damage_of_labels
def masks_of_two_people_exchanged(d):
    a, b = two_people(d, d.image())
    for key in ("segmentation", "amodal_segmentation", "bbox", "bbox_amodal", "area", "area_amodal", "visibility"):
        a[key], b[key] = b[key], a[key]


@damage_of_labels
def mask_one_pixel_thinner(d):
    person = d.largest(d.image())
    mask = mask_of(person["segmentation"])
    mask &= shifted(mask, 1, 0)
    rows, columns = numpy.flatnonzero(mask.any(1)), numpy.flatnonzero(mask.any(0))
    person["bbox"] = [int(columns[0]), int(rows[0]), int(columns[-1] - columns[0] + 1), int(rows[-1] - rows[0] + 1)]
    person["segmentation"] = segmentation_of(mask)
    person["area"] = int(mask.sum())
    person["visibility"] = float(f"{person['area'] / person['area_amodal']:.3g}")


@damage_by(each_person)
def visibility_inverted(person):
    person["visibility"] = round(1 - person["visibility"], 3)


@damage_of_labels
def truncation_left_out(d):
    people = [p for p in d.everybody if p.pop("truncation", None)]
    assert people, "nobody is truncated"
    for image in d.images:
        image["counts"]["truncated"] = 0


@damage_of_labels
def truncation_doubled(d):
    for person in d.everybody:
        if "truncation" in person:
            person["truncation"] = min(1, 2 * person["truncation"])
    assert any("truncation" in p for p in d.everybody), "nobody is truncated"


@damage_by(each_person)
def heads_3_px_higher(person):
    if person["head"] and person["head"][1] > 3:
        person["head"][1] = round(person["head"][1] - 3, 2)
