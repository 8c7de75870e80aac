"""Damages to what is said twice of a whole run: tables, events, trajectories of people whom no camera sees, names in the COCO
file's head, and classes of still surfaces."""
import io
import json

import numpy

from .dataset import damage, damage_by, damage_of_labels, each_track


def sensor_table(d):
    name = f"sensors/{d.runs[0]}/{d.cameras[0]}.csv"
    return name, *d.table(name)


@damage
def sensor_columns_renamed(d):
    name, head, rows = sensor_table(d)
    d.save_table(name, [f"column_{i}" for i in range(len(head))], rows)


@damage
def one_sensor_column_renamed(d):
    name, head, rows = sensor_table(d)
    d.save_table(name, [column.replace("gps_x_m", "gps_east_m") for column in head], rows)


@damage
def sensor_names_exchanged(d):
    name, head, rows = sensor_table(d)
    head[1], head[2] = head[2], head[1]
    d.save_table(name, head, rows)


@damage
def sensor_rows_left_out(d):
    name, head, rows = sensor_table(d)
    d.save_table(name, head, rows[:500] + rows[520:])


@damage
def one_sensor_row_left_out(d):
    name, head, rows = sensor_table(d)
    d.save_table(name, head, rows[:700] + rows[701:])


@damage
def sensor_rows_from_the_middle_on(d):
    name, head, rows = sensor_table(d)
    d.save_table(name, head, rows[300:])


@damage
def sensor_rows_end_early(d):
    name, head, rows = sensor_table(d)
    d.save_table(name, head, rows[:-70])


@damage
def exit_columns_renamed(d):
    name = f"exits/{d.runs[0]}.csv"
    head, rows = d.table(name)
    d.save_table(name, [column.replace("voronoi_density", "density_of_voronoi") for column in head], rows)


def change_head(d, change):
    """Changes the first category of the COCO file, which is people's."""
    name = "annotations/instances.json"
    lines = d.path(name).read_text().split("\n")
    at = next(i for i, line in enumerate(lines) if line.startswith('"categories":'))
    categories = json.loads(lines[at].removeprefix('"categories":').rstrip(","))
    change(categories)
    lines[at] = '"categories":' + json.dumps(categories, separators=(",", ":")) + ","
    d.write(name, "\n".join(lines))


@damage_by(change_head)
def joint_names_exchanged(categories):
    joints = categories[0]["joints"]
    joints[17], joints[18] = joints[18], joints[17]


def change_events(d, change):
    name = f"events/{d.runs[0]}.jsonl"
    events = [json.loads(line) for line in d.path(name).read_text().splitlines()]
    changed = change(events)
    assert changed != events, "nothing changed"
    d.write(name, "".join(json.dumps(event) + "\n" for event in changed))


def without(kind, count=None):
    def change(events):
        chosen = [event for event in events if event["type"] == kind][:count]
        assert chosen, f"no {kind}"
        return [event for event in events if event not in chosen]

    return change


@damage_by(change_events)
def notices_half_a_second_early(events):
    return [{**e, "time_s": round(e["time_s"] - 0.5, 6)} if e["type"] == "notices" else e for e in events]


@damage_by(change_events)
def notices_of_others(events):
    tracks = [e["track_id"] for e in events if e["type"] == "notices"]
    moved = iter(tracks[1:] + tracks[:1])
    return [{**e, "track_id": next(moved)} if e["type"] == "notices" else e for e in events]


@damage_by(change_events)
def somebody_departs_twice(events):
    gone = {"time_s": 1.0, "type": "departs", "track_id": events[0]["track_id"]}
    return [gone, gone, *events]


def change_unseen(d, change):
    """Changes trajectories of people whom no image of the run shows."""
    run = d.runs[0]
    tracks = json.loads(d.path(f"trajectories/{run}.json").read_text())["track_ids"]
    images = {image["id"] for image in d.images if image["run"] == run}
    seen = {a["track_id"] for a in d.coco["annotations"] if a["image_id"] in images}
    unseen = [i for i, track in enumerate(tracks) if track not in seen]
    name = f"trajectories/{run}.npy"
    values = numpy.load(d.path(name))
    unseen = [i for i in unseen if numpy.isfinite(values[:, i]).all()]
    assert len(unseen) >= 2, "everybody is seen"
    changed = values.copy()
    change(changed, unseen)
    buffer = io.BytesIO()
    numpy.save(buffer, changed)
    d.write(name, buffer.getvalue())


@damage_by(change_unseen)
def unseen_people_2_m_off(values, unseen):
    values[:, unseen, 0] += 2


@damage_by(change_unseen)
def unseen_people_mirrored(values, unseen):
    values[:, unseen, 1] *= -1


@damage_by(change_unseen)
def somebody_unseen_left_out(values, unseen):
    values[:, unseen[0]] = numpy.nan


@damage_by(change_unseen)
def somebody_unseen_absent_for_a_frame(values, unseen):
    values[1, unseen[0]] = numpy.nan


@damage_by(change_unseen)
def unseen_people_in_other_frames(values, unseen):
    values[:, unseen] = values[::-1, unseen]


@damage_by(change_unseen)
def unseen_people_look_back(values, unseen):
    values[:, unseen, 2] += numpy.pi


@damage
def unseen_people_in_other_states(d):
    states = len(json.loads(d.path(f"trajectories/{d.runs[0]}.json").read_text())["states"])

    def change(values, unseen):
        values[:, unseen, 3] = (values[:, unseen, 3] + 1) % states

    change_unseen(d, change)


@damage_of_labels
def one_hidden_person_left_out(d):
    image = next(i for i in d.images if len(i.get("hidden", [])) > 1 and 0 < i["frame"] < d.frames - 1)
    middle = max(image["hidden"], key=lambda p: p["bbox_amodal"][2] * p["bbox_amodal"][3])
    image["hidden"].remove(middle)
    image["counts"]["all"] -= 1


@damage_by(each_track)
def everybody_male(track):
    if "attributes" in track:
        track["attributes"]["sex"] = "male"


@damage
def parts_all_head(d):
    for image in d.images:
        d.change_raster("parts", image, lambda parts: numpy.where(parts > 0, 1, 0).astype(parts.dtype))


def exchange_classes(d, images, a, b):
    changed = 0
    for image in images:
        name, classes = d.raster("semantic", image)
        if not ((classes == a).any() or (classes == b).any()):
            continue
        d.change_raster("semantic", image, lambda v: numpy.where(v == a, b, numpy.where(v == b, a, v)).astype(v.dtype))
        changed += 1
    assert changed, "neither class shows"


TERRAIN, ROOF, BUILDING, DOOR, WALL, PAVEMENT, ROAD, GRASS = 1, 7, 2, 8, 9, 11, 12, 13


def change_class(d, a, b):
    changed = 0
    for image in d.images:
        if (d.raster("semantic", image)[1] == a).sum() > 200:
            d.change_raster("semantic", image, lambda v: numpy.where(v == a, b, v).astype(v.dtype))
            changed += 1
    assert changed, "the class does not show"


DAMAGES = {
    "keypoint names reversed": lambda d: change_head(d, lambda categories: categories[0]["keypoints"].reverse()),
    "skeleton from zero": lambda d: change_head(
        d, lambda categories: categories[0].update(skeleton=[[a - 1, b - 1] for a, b in categories[0]["skeleton"]])
    ),
    "skeleton without a limb": lambda d: change_head(d, lambda categories: categories[0]["skeleton"].pop()),
    "bone name left out": lambda d: change_head(d, lambda categories: categories[0]["bones"].pop()),
    "category left out": lambda d: change_head(d, lambda categories: categories.pop()),
    "notices left out": lambda d: change_events(d, without("notices")),
    "one notice left out": lambda d: change_events(d, without("notices", 1)),
    "escapes left out": lambda d: change_events(d, without("escapes")),
    "events left out": lambda d: change_events(d, lambda events: []),
    "escapes called notices": lambda d: change_events(
        d, lambda events: [{**e, "type": "notices"} if e["type"] == "escapes" else e for e in events]
    ),
    "event of unknown type": lambda d: change_events(d, lambda events: [{**events[0], "type": "sneezes"}, *events[1:]]),
    "semantic roofs and facades exchanged": lambda d: exchange_classes(d, d.images, ROOF, BUILDING),
    "semantic doors and facades exchanged": lambda d: exchange_classes(d, d.images, DOOR, BUILDING),
    "semantic road and pavement exchanged in one image": lambda d: exchange_classes(d, [d.image()], ROAD, PAVEMENT),
}
