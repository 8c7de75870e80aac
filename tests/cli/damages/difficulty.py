"""Damages to contrast, blur and occluders."""
from .dataset import damage_by, damage_of_labels, each_person


@damage_by(each_person)
def contrasts_doubled(person):
    person["difficulty"]["contrast"] *= 2


@damage_of_labels
def edge_contrast_of_one_person_zero(d):
    d.largest(d.image(), lambda p: p["difficulty"]["edge_contrast"] > 8)["difficulty"]["edge_contrast"] = 0


@damage_of_labels
def difficulties_of_two_people_exchanged(d):
    people = sorted(d.everybody, key=lambda p: p["difficulty"]["contrast"])
    people[0]["difficulty"], people[-1]["difficulty"] = people[-1]["difficulty"], people[0]["difficulty"]


@damage_of_labels
def blur_of_10_px(d):
    d.largest(d.image())["difficulty"]["blur_px"] = 10


@damage_of_labels
def visible_keypoints_one_more(d):
    d.largest(d.image())["difficulty"]["visible_keypoints"] += 1


@damage_of_labels
def difficulty_left_out(d):
    del d.largest(d.image())["difficulty"]


@damage_of_labels
def occluders_left_out(d):
    d.largest(d.image(), lambda p: p["occluded_by"] and p["occluded_by"][0][1] > 0.1)["occluded_by"] = []


@damage_of_labels
def occluders_are_others(d):
    person = d.largest(d.image(), lambda p: p["occluded_by"] and p["occluded_by"][0][1] > 0.1)
    person["occluded_by"][0][0] += 1


@damage_by(each_person)
def occluder_shares_of_the_visible_area(person):
    person["occluded_by"] = [[i, round(share / person["visibility"], 3)] for i, share in person["occluded_by"]]


def compared(d):
    """People of an image in which several are large enough for their colors to be compared."""
    return max(([p for p in d.people(i) if p["area"] >= 50] for i in d.images), key=len)


@damage_by(each_person)
def lookalikes_left_out(person):
    person["difficulty"]["lookalikes"] = []


@damage_of_labels
def lookalike_of_other_colors(d):
    people = compared(d)
    person = people[0]
    other = next(p for p in people[1:] if p["track_id"] not in person["difficulty"]["lookalikes"])
    for a, b in ((person, other), (other, person)):
        a["difficulty"]["lookalikes"].append(b["track_id"])


@damage_of_labels
def lookalike_of_oneself(d):
    person = compared(d)[0]
    person["difficulty"]["lookalikes"].append(person["track_id"])


@damage_of_labels
def lookalike_of_another_image(d):
    person = compared(d)[0]
    person["difficulty"]["lookalikes"].append(person["track_id"] - person["track_id"] % 1000000 + 999999)
