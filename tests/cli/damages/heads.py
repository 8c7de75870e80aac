"""Damages to the boxes of heads and to their visible shares."""
from .dataset import damage_by, damage_of_labels, each_person


def large(person):
    return person["head_box"] and person["head_box"][3] > 4 and person["head_visibility"] == 1


@damage_of_labels
def head_boxes_moved_by_their_width(d):
    for person in filter(large, d.everybody):
        person["head_box"][0] += person["head_box"][2]


@damage_of_labels
def head_box_twice_as_large(d):
    box = d.largest(d.image(), large)["head_box"]
    box[0], box[1], box[2], box[3] = box[0] - box[2] / 2, box[1] - box[3] / 2, 2 * box[2], 2 * box[3]


@damage_of_labels
def head_boxes_are_those_of_the_bodies(d):
    for person in filter(large, d.everybody):
        person["head_box"] = person["bbox_amodal"]


@damage_of_labels
def head_boxes_of_a_tenth(d):
    for person in filter(large, d.everybody):
        x, y = person["head"]
        width, height = person["head_box"][2] / 10, person["head_box"][3] / 10
        person["head_box"] = [x - width / 2, y - height / 2, width, height]


@damage_of_labels
def head_box_left_out(d):
    person = d.largest(d.image(), large)
    del person["head_box"], person["head_visibility"]


@damage_of_labels
def head_visibility_inverted(d):
    person = d.largest(d.image(), large)
    person["head_visibility"] = 1 - person["head_visibility"]


@damage_by(each_person)
def head_visibility_is_the_bodys(person):
    person["head_visibility"] = person["visibility"]
