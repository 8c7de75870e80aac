"""Damages to keypoints, velocities, headings and positions of people."""
import numpy

from .dataset import damage, damage_by, damage_of_labels, each_person, each_person_of_an_image, walker


PAIRS = [(1, 2), (3, 4), (5, 6), (7, 8), (9, 10), (11, 12), (13, 14), (15, 16)]


def exchange_keypoints(d, people, pairs=PAIRS, solid=True):
    for person in people:
        for a, b in pairs:
            k = person["keypoints"]
            k[3 * a : 3 * a + 3], k[3 * b : 3 * b + 3] = k[3 * b : 3 * b + 3], k[3 * a : 3 * a + 3]
            if solid:
                k = person["keypoints_3d"]
                k[a], k[b] = k[b], k[a]
    d.save_coco()


def change_states(d, people, key, states):
    """Of keypoints or joints, {state: the one that it becomes}."""
    for person in people:
        person[key][2::3] = [states.get(state, state) for state in person[key][2::3]]
    d.save_coco()


def turn_vector(v, angle):
    c, s = numpy.cos(angle), numpy.sin(angle)
    return [float(round(c * v[0] - s * v[1], 2)), float(round(s * v[0] + c * v[1], 2))]


def change_velocities(d, people, change):
    for person in people:
        person["velocity"] = change(person["velocity"])
    d.save_coco()


def wrapped(angle):
    return round(float((angle + numpy.pi) % (2 * numpy.pi) - numpy.pi), 2)


def change_headings(d, people, change):
    for person in people:
        person["heading"] = wrapped(change(person["heading"]))
    d.save_coco()


@damage_by(each_person)
def headings_in_degrees(person):
    person["heading"] = round(float(numpy.degrees(person["heading"])), 2)


@damage_by(each_person_of_an_image)
def positions_30_cm_off(person):
    person["position"][0] = round(person["position"][0] + 0.3, 3)


@damage_of_labels
def position_of_one_person_1_m_off(d):
    person = d.largest(d.image())
    person["position"][1] = round(person["position"][1] + 1, 3)


@damage_by(each_person)
def position_axes_exchanged(person):
    p = person["position"]
    p[0], p[1] = p[1], p[0]


@damage_of_labels
def positions_of_the_frame_before(d):
    before = {p["track_id"]: p for p in d.people(d.image(-1, 1))}
    for person in d.people(d.image(-1, 2)):
        if person["track_id"] in before:
            person["position"] = before[person["track_id"]]["position"]


@damage_by(each_person_of_an_image)
def keypoints_2_px_to_the_right(person):
    k = person["keypoints"]
    for i in range(0, len(k), 3):
        k[i] = round(k[i] + 2, 2) if k[i + 2] else 0


@damage_by(each_person)
def all_places_50_cm_higher(person):
    person["position"][2] = 0.5
    person["box_3d"][2] = round(person["box_3d"][2] + 0.5, 2)
    for point in person["keypoints_3d"]:
        point[2] = round(point[2] + 0.5, 3)


@damage_by(each_person)
def positions_at_the_middle_of_the_body(person):
    person["position"][2] = person["box_3d"][2]


def move_in_world(person, x, y):
    for place in [person["position"], person["box_3d"], *person["keypoints_3d"]]:
        place[0] = round(place[0] + x, 3)
        place[1] = round(place[1] + y, 3)


@damage_of_labels
def places_in_a_run_30_cm_off(d):
    images = {i["id"] for i in d.images if i["run"] == d.runs[0]}
    for person in d.everybody:
        if person["image_id"] in images:
            move_in_world(person, 0.3, 0)


@damage_of_labels
def places_of_one_person_30_cm_off(d):
    track = d.largest(d.image())["track_id"]
    for person in d.everybody:
        if person["track_id"] == track:
            move_in_world(person, 0, 0.3)


@damage_of_labels
def velocities_one_frame_late(d):
    last = {}
    for image in d.images:
        key = image["run"], image["camera_id"]
        before, last[key] = last.get(key, {}), {p["track_id"]: p["velocity"] for p in d.people(image)}
        for person in d.people(image):
            person["velocity"] = before.get(person["track_id"], person["velocity"])


@damage
def headings_are_of_velocity_reversed_for_those_who_stand(d):
    people = [p for p in d.everybody if numpy.hypot(*p["velocity"]) < 0.2]
    assert people, "nobody stands"
    change_headings(d, people, lambda h: h + numpy.pi)


@damage_by(each_person_of_an_image)
def joints_left_and_right_exchanged_in_the_image_only(person):
    for a, b in [(25, 26), (27, 28), (31, 32)]:
        j = person["joints"]
        j[3 * a : 3 * a + 3], j[3 * b : 3 * b + 3] = j[3 * b : 3 * b + 3], j[3 * a : 3 * a + 3]


@damage_by(each_person_of_an_image)
def joints_2_px_to_the_right(person):
    person["joints"][3 * 17 :: 3] = [x + 2 if x else x for x in person["joints"][3 * 17 :: 3]]


@damage_of_labels
def gaze_backward(d):
    person = d.largest(d.image())
    person["gaze"] = [-value for value in person["gaze"]]


@damage_by(each_person)
def turns_of_heads_and_gazes_backward(person):
    w, x, y, z = person["bone_turns"][4]
    person["bone_turns"][4] = [-z, y, -x, w]  # half a turn about z first
    person["gaze"] = [-value for value in person["gaze"]]


@damage_of_labels
def toes_are_heels(d):
    person = d.largest(d.image())
    j = person["joints_3d"]
    j[27], j[31] = j[31], [value + 0.2 for value in j[31]]


@damage_of_labels
def bone_turns_of_length_2(d):
    person = d.largest(d.image())
    person["bone_turns"][7] = [2 * value for value in person["bone_turns"][7]]


@damage_of_labels
def joints_left_out(d):
    del d.largest(d.image())["joints"]


DAMAGES = {
    "left and right keypoints exchanged": lambda d: exchange_keypoints(d, d.everybody),
    "left and right keypoints of one person exchanged": lambda d: exchange_keypoints(d, [d.largest(d.image())]),
    "left and right arms of one person exchanged": lambda d: exchange_keypoints(
        d, [d.largest(d.image())], [(5, 6), (7, 8), (9, 10)]
    ),
    "keypoints exchanged in the picture only": lambda d: exchange_keypoints(d, d.people(d.image()), solid=False),
    "elbows and wrists of one person exchanged": lambda d: exchange_keypoints(
        d, [d.largest(d.image())], [(7, 9), (8, 10)]
    ),
    "eyes and ears exchanged": lambda d: exchange_keypoints(d, d.people(d.image()), [(1, 3), (2, 4)]),
    "visible keypoints called hidden": lambda d: change_states(d, d.people(d.image()), "keypoints", {2: 1}),
    "hidden keypoints called visible": lambda d: change_states(d, d.people(d.image()), "keypoints", {1: 2}),
    "keypoint visibility inverted": lambda d: change_states(d, d.everybody, "keypoints", {1: 2, 2: 1}),
    "self hidden joints called hidden": lambda d: change_states(d, d.everybody, "joints", {3: 1}),
    "all joints visible": lambda d: change_states(d, d.everybody, "joints", {1: 2, 3: 2}),
    "velocities reversed": lambda d: change_velocities(d, d.everybody, lambda v: [-v[0], -v[1]]),
    "velocity of one person reversed": lambda d: change_velocities(d, [walker(d, d.image())], lambda v: [-v[0], -v[1]]),
    "velocities 5 percent too high": lambda d: change_velocities(
        d, d.everybody, lambda v: [round(1.05 * v[0], 2), round(1.05 * v[1], 2)]
    ),
    "velocities of one frame turned by 90 degrees": lambda d: change_velocities(
        d, d.people(d.image()), lambda v: turn_vector(v, numpy.pi / 2)
    ),
    "velocity axes exchanged": lambda d: change_velocities(d, d.everybody, lambda v: v[::-1]),
    "velocities of one frame zero": lambda d: change_velocities(d, d.people(d.image()), lambda v: [0, 0]),
    "headings turned by 90 degrees": lambda d: change_headings(d, d.everybody, lambda h: h + numpy.pi / 2),
    "headings from north": lambda d: change_headings(d, d.everybody, lambda h: numpy.pi / 2 - h),
    "heading of one person reversed": lambda d: change_headings(d, [d.largest(d.image())], lambda h: h + numpy.pi),
    "headings of one frame 40 degrees off": lambda d: change_headings(d, d.people(d.image()), lambda h: h + 0.7),
    "velocities in km per h": lambda d: change_velocities(
        d, d.everybody, lambda v: [round(3.6 * v[0], 2), round(3.6 * v[1], 2)]
    ),
}
