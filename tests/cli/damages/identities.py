"""Damages to identities, attributes, states and exits of people."""
import json

import numpy

from .dataset import (
    damage,
    damage_by,
    damage_of_labels,
    each_person_of_an_image,
    each_track,
    tracks_by_frequency,
    two_people,
)
from .rasters import ids_to_rgb, instances, png_bytes, raster_name


@damage_of_labels
def somebody_erased(d):
    """From records, instances and parts; the image still shows them."""
    image = d.image()
    person = d.largest(image)
    number = person["track_id"] % 1000000
    d.coco["annotations"].remove(person)
    image["counts"]["all"] -= 1
    image["counts"]["visible"] -= 1
    image["counts"]["truncated"] -= 1 if "truncation" in person else 0
    ids = instances(d, image)
    mask = ids == number
    ids[mask] = 0xFF0000
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))
    d.change_raster("parts", image, lambda a: numpy.where(mask[..., None], 0, a).astype(a.dtype))


@damage_of_labels
def two_people_exchanged_in_one_frame(d):
    """Ids in records and instances alike."""
    image = d.image()
    a, b = two_people(d, image)
    numbers = [p["track_id"] % 1000000 for p in (a, b)]
    ids = instances(d, image)
    one, two = ids == numbers[0], ids == numbers[1]
    ids[one], ids[two] = numbers[1], numbers[0]
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))
    for key in ("track_id", "id"):
        a[key], b[key] = b[key], a[key]
    d.coco["annotations"].sort(key=lambda p: p["id"])


@damage_of_labels
def poses_of_two_people_exchanged(d):
    a, b = two_people(d, d.image())
    for key in ("position", "velocity", "heading", "box_3d", "keypoints", "keypoints_3d", "num_keypoints", "head"):
        a[key], b[key] = b[key], a[key]


@damage_of_labels
def attributes_of_two_people_exchanged(d):
    a, b = tracks_by_frequency(d)[:2]
    a["attributes"], b["attributes"] = b["attributes"], a["attributes"]


def first_garment(d):
    track = tracks_by_frequency(d)[0]
    return track["attributes"]["clothes"][0]


@damage_of_labels
def garment_called_another_color(d):
    garment = next(
        g for t in d.coco["tracks"] if "attributes" in t for g in t["attributes"]["clothes"] if "colour" in g
    )
    garment["colour_name"] = "pink" if garment["colour_name"] != "pink" else "blue"


@damage_of_labels
def garment_in_another_slot(d):
    first_garment(d)["slot"] = "hat"


@damage_of_labels
def garment_left_out(d):
    tracks_by_frequency(d)[0]["attributes"]["clothes"].pop()


@damage_of_labels
def attributes_of_all_people_moved_by_one(d):
    tracks = [t for t in d.coco["tracks"] if "attributes" in t]
    attributes = [t["attributes"] for t in tracks]
    for track, other in zip(tracks, attributes[1:] + attributes[:1]):
        track["attributes"] = other


@damage_by(each_track)
def colors_of_clothes_exchanged(track):
    a = track.get("attributes", {})
    if "top_colour" in a and "bottom_colour" in a:
        a["top_colour"], a["bottom_colour"] = a["bottom_colour"], a["top_colour"]


@damage_by(each_track)
def colors_as_bgr(track):
    for key, value in track.get("attributes", {}).items():
        if key.endswith("_colour"):
            track["attributes"][key] = "#" + value[5:7] + value[3:5] + value[1:3]


@damage_of_labels
def sex_of_one_person(d):
    track = tracks_by_frequency(d)[0]["attributes"]
    track["sex"] = "male" if track["sex"] == "female" else "female"


@damage_of_labels
def stature_of_one_person_20_cm_less(d):
    track = tracks_by_frequency(d)[0]["attributes"]
    track["stature_m"] = round(track["stature_m"] - 0.2, 3)


@damage_by(each_person_of_an_image)
def state_of_walkers_waiting(person):
    if person["state"] in ("walking", "running"):
        person["state"] = "waiting"


@damage_of_labels
def state_of_one_person_running(d):
    d.largest(d.image(), lambda p: p["state"] in ("walking", "waiting"))["state"] = "running"


@damage_of_labels
def exits_of_people_exchanged(d):
    names = [e["id"] for e in d.images[0]["exits"]]
    for person in d.everybody:
        if person.get("exit") in names:
            person["exit"] = names[(names.index(person["exit"]) + 1) % len(names)]


@damage_of_labels
def labels_of_the_frame_before(d):
    """Records and rasters of one image are those of the frame before; the image is right."""
    image, before = d.image(-1, 3), d.image(-1, 2)
    old = d.people(image)
    d.coco["annotations"] = [p for p in d.coco["annotations"] if p not in old]
    for person in json.loads(json.dumps(d.people(before))):
        person["image_id"] = image["id"]
        person["id"] = image["id"] * 100000 + person["track_id"] % 1000000
        d.coco["annotations"].append(person)
    d.coco["annotations"].sort(key=lambda p: p["id"])
    for key in ("camera", "flight", "counts", "hidden", "exits", "density_count"):
        if key in before:
            image[key] = before[key]
    for kind in ("depth", "instances", "parts", "normals", "flow"):
        d.copy(raster_name(kind, before), raster_name(kind, image))
    d.write(image["density_file"], d.path(before["density_file"]).read_bytes())


def renumber(d, images, numbers):
    """Track ids in records and instances, by a map of numbers in the run."""
    for image in images:
        base = d.runs.index(image["run"]) * 1000000
        for person in d.people(image):
            number = numbers.get(person["track_id"] - base, person["track_id"] - base)
            person["track_id"] = base + number
            person["id"] = image["id"] * 100000 + number
        for person in image.get("hidden", []):
            person["track_id"] = base + numbers.get(person["track_id"] - base, person["track_id"] - base)
        ids = instances(d, image)
        changed = ids.copy()
        for number, other in numbers.items():
            changed[ids == number] = other
        if not numpy.array_equal(ids, changed):
            d.write(raster_name("instances", image), png_bytes(ids_to_rgb(changed)))
    d.coco["annotations"].sort(key=lambda p: p["id"])
    d.save_coco()


@damage
def ids_permuted_after_a_frame(d):
    """Everybody has the next person's id in all cameras of a run, from a frame on."""
    tracks = sorted({p["track_id"] for p in d.everybody if p["track_id"] < 1000000})
    images = [i for i in d.images if i["run"] == d.runs[0] and i["frame"] >= d.frames // 2]
    renumber(d, images, dict(zip(tracks, tracks[1:] + tracks[:1])))


@damage
def ids_of_two_people_exchanged_after_a_frame(d):
    a, b = two_people(d, d.image())
    images = [i for i in d.images if i["run"] == d.runs[0] and i["frame"] >= d.frames // 2]
    renumber(d, images, {a["track_id"]: b["track_id"], b["track_id"]: a["track_id"]})


@damage
def ids_of_two_people_exchanged_in_one_camera(d):
    a, b = two_people(d, d.image())
    images = [i for i in d.images if i["run"] == d.runs[0] and i["camera_id"] == d.cameras[-1]]
    renumber(d, images, {a["track_id"]: b["track_id"], b["track_id"]: a["track_id"]})


@damage_of_labels
def one_person_removed_everywhere(d):
    """From records, counts and the manifest; the rasters and images still show the person."""
    track = d.largest(d.image())["track_id"]
    images = {i["id"]: i for i in d.images}
    gone = [p for p in d.everybody if p["track_id"] == track]
    for person in gone:
        image = images[person["image_id"]]
        image["counts"]["all"] -= 1
        image["counts"]["visible"] -= 1
        image["counts"]["truncated"] -= 1 if "truncation" in person else 0
    for image in d.images:
        kept = [p for p in image.get("hidden", []) if p["track_id"] != track]
        if len(kept) < len(image.get("hidden", [])):
            image["hidden"] = kept
            image["counts"]["all"] -= 1
    d.coco["annotations"] = [p for p in d.coco["annotations"] if p not in gone]
    d.coco["tracks"] = [t for t in d.coco["tracks"] if t["id"] != track]
    manifest = json.loads(d.path("manifest.json").read_text())
    manifest["counts"]["agents"] -= 1
    manifest["counts"]["annotations"] -= len(gone)
    manifest["runs"][0]["agents"] -= 1
    manifest["runs"][0]["annotations"] -= len(gone)
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage_of_labels
def everybody_in_the_background_removed(d):
    """People smaller than the median, from the records of an image and its counts."""
    image = d.image()
    people = sorted(d.people(image), key=lambda p: p["area"])
    gone = people[: len(people) // 2]
    image["counts"]["all"] -= len(gone)
    image["counts"]["visible"] -= len(gone)
    image["counts"]["truncated"] -= sum(1 for p in gone if "truncation" in p)
    d.coco["annotations"] = [p for p in d.coco["annotations"] if p not in gone]


@damage_of_labels
def annotation_twice(d):
    image = d.image()
    person = json.loads(json.dumps(d.largest(image)))
    taken = {p["track_id"] for p in d.people(image)}
    person["track_id"] = next(t["id"] for t in d.coco["tracks"] if t["id"] < 1000000 and t["id"] not in taken)
    person["id"] = image["id"] * 100000 + person["track_id"]
    d.coco["annotations"].append(person)
    d.coco["annotations"].sort(key=lambda p: p["id"])
    image["counts"]["all"] += 1
    image["counts"]["visible"] += 1
    image["counts"]["truncated"] += 1 if "truncation" in person else 0


@damage_by(each_track)
def top_colors_inverted(track):
    a = track.get("attributes", {})
    if "top_colour" in a:
        a["top_colour"] = f"#{0xFFFFFF - int(a['top_colour'][1:], 16):06x}"


@damage_of_labels
def top_color_of_the_largest_person_green(d):
    d_track = tracks_by_frequency(d)[0]["attributes"]
    d_track["top_colour"] = "#00ff00"


@damage_of_labels
def groups_moved_by_one(d):
    tracks = [t for t in d.coco["tracks"] if "group" in t]
    groups = [t["group"] for t in tracks]
    assert len(set(groups)) > 1, "nobody is in a group"
    for track, other in zip(tracks, groups[1:] + groups[:1]):
        track["group"] = other


@damage_by(each_track)
def ages_ten_years_older(track):
    if "attributes" in track:
        track["attributes"]["age_years"] += 10


@damage_by(each_track)
def statures_in_centimeters(track):
    if "attributes" in track:
        track["attributes"]["stature_m"] *= 100


@damage_of_labels
def behaviors_of_people_exchanged(d):
    names = sorted({p["behaviour"] for p in d.everybody})
    assert len(names) > 1, "everybody does the same"
    for person in d.everybody:
        person["behaviour"] = names[(names.index(person["behaviour"]) + 1) % len(names)]


@damage
def categories_exchanged(d):
    name = "annotations/instances.json"
    text = d.path(name).read_text()
    changed = text.replace('"name":"person"', '"name":"?"').replace('"name":"drone"', '"name":"person"')
    changed = changed.replace('"name":"?"', '"name":"drone"')
    assert changed != text, "no names of categories"
    d.write(name, changed)


@damage_of_labels
def runs_of_images_exchanged(d):
    """The records of the same frame and camera of two runs have each other's people."""
    for camera in d.cameras:
        a = next(i for i in d.images if (i["run"], i["camera_id"], i["frame"]) == (d.runs[0], camera, 1))
        b = next(i for i in d.images if (i["run"], i["camera_id"], i["frame"]) == (d.runs[1], camera, 1))
        ours, theirs = d.people(a), d.people(b)
        for people, image, shift in ((ours, b, 1000000), (theirs, a, -1000000)):
            for person in people:
                person["track_id"] += shift
                person["image_id"] = image["id"]
                person["id"] = image["id"] * 100000 + person["track_id"] % 1000000
        for key in ("counts", "density_count", "exits", "hidden"):
            a[key], b[key] = b.get(key), a.get(key)
        for image, shift in ((a, -1000000), (b, 1000000)):
            image["hidden"] = [{**p, "track_id": p["track_id"] + shift} for p in image["hidden"] or []]
    known = {t["id"] for t in d.coco["tracks"]}
    d.coco["annotations"] = [p for p in d.coco["annotations"] if p["track_id"] in known]
    d.coco["annotations"].sort(key=lambda p: p["id"])


@damage_of_labels
def runs_of_tracks_exchanged(d):
    for track in d.coco["tracks"]:
        track["run"] = d.runs[1 - d.runs.index(track["run"])]


@damage_of_labels
def carried_items_left_out(d):
    people = [
        t["attributes"] for t in d.coco["tracks"] if t.get("attributes", {}).get("carries", "nothing") != "nothing"
    ]
    assert people, "nobody carries anything"
    for attributes in people:
        attributes["carries"] = "nothing"


def change_actions(d, change):
    """Of everybody in one image."""
    for person in d.people(d.image()):
        person["actions"] = change(person["actions"])
    d.save_coco()


@damage_of_labels
def unknown_action(d):
    d.largest(d.image())["actions"].append("dance")


@damage_of_labels
def two_motions_at_once(d):
    person = d.largest(d.image())
    person["actions"].append("walk" if "walk" not in person["actions"] else "run")


@damage
def actions_a_second_late(d):
    for run in d.runs:
        name = f"actions/{run}.csv"
        head, *rows = d.path(name).read_text().splitlines()
        late = [row.split(",") for row in rows]
        late = [",".join(row[:3] + [f"{float(value) + 1:g}" for value in row[3:]]) for row in late]
        d.write(name, "\n".join([head, *late]) + "\n")


@damage_of_labels
def together_with_a_stranger(d):
    a, b = d.people(d.image())[:2]
    a["together_with"].append(b["track_id"])
    b["together_with"].append(a["track_id"])


DAMAGES = {
    "walking people stand": lambda d: change_actions(
        d, lambda names: ["stand" if name in ("walk", "run") else name for name in names]
    ),
    "everybody carries": lambda d: change_actions(
        d, lambda names: names + [] if "carry" in names else names + ["carry"]
    ),
}
