"""Damages to the trajectories of everybody and to the events."""
import json

import numpy

from .dataset import damage, damage_by
from .rasters import change_npy


def name_of(d, run=0):
    return f"trajectories/{d.runs[run]}.npy"


def person_seen(d):
    """Column of a person whom an image of the first run shows."""
    tracks = json.loads(d.path(f"trajectories/{d.runs[0]}.json").read_text())["track_ids"]
    return tracks.index(d.people(d.image())[0]["track_id"])


@damage
def trajectories_without_somebody_seen(d):
    def leave_out(a):
        a = a.copy()
        a[:, person_seen(d)] = numpy.nan
        return a

    change_npy(d, name_of(d), leave_out)


@damage
def trajectories_of_two_people_exchanged(d):
    def exchange(a):
        one = person_seen(d)
        other = (one + 1) % a.shape[1]
        order = numpy.arange(a.shape[1])
        order[[one, other]] = [other, one]
        return a[:, order]

    change_npy(d, name_of(d), exchange)


@damage
def trajectory_states_exchanged(d):
    name = f"trajectories/{d.runs[0]}.json"
    description = json.loads(d.path(name).read_text())
    description["states"] = description["states"][1:] + description["states"][:1]
    d.write(name, json.dumps(description))


@damage
def trajectory_of_somebody_leaps(d):
    def leap(a):
        a = a.copy()
        a[-1, :, 0] += 40
        return a

    change_npy(d, name_of(d, 1), leap)


def change_events(d, change):
    """Changes each event of the first run in place."""
    name = f"events/{d.runs[0]}.jsonl"
    events = [json.loads(line) for line in d.path(name).read_text().splitlines()]
    for event in events:
        change(event)
    d.write(name, "".join(json.dumps(event) + "\n" for event in events))


@damage_by(change_events)
def events_30_m_off(event):
    if "position" in event:
        event["position"][0] += 30


@damage_by(change_events)
def events_of_the_next_frame(event):
    if "frame" in event:
        event["frame"] += 1


@damage_by(change_events)
def events_20_s_late(event):
    event["time_s"] += 20


DAMAGES = {
    "trajectories 10 cm off": lambda d: change_npy(d, name_of(d), lambda a: a + numpy.float32([0.1, 0, 0, 0])),
    "trajectories one frame late": lambda d: change_npy(d, name_of(d), lambda a: numpy.concatenate([a[:1], a[:-1]])),
    "trajectory headings from north": lambda d: change_npy(
        d, name_of(d), lambda a: a - numpy.float32([0, 0, numpy.pi / 2, 0])
    ),
}
