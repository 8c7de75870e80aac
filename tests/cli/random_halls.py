"""Halls drawn at random, as blueprints: walls with doors, drawn as wide as they are or wider, in halves, with pillars, that
close or are never open, with `inside` up to them, beyond them or before them.

usage: random_halls.py SEED    prints the blueprint of a seed"""
import json
import math
import random
import sys

import numpy as np

WALL_M = 0.4


def wall(name, low, high):
    """A box, a building with a number that nothing else has."""
    return {"id": name, "box": [round(value, 3) for value in (*low, *high)], "height_m": 3}


def side_of(side, doors, draw):
    """The walls of a side with its openings, the exits in them, and the openings. A side goes from its `corner` `length_m`
    along; its walls are on its `outward` side, from `from_m` on."""
    corner, along, outward, length_m, from_m = side

    def at(s, depth):
        return [round(corner[k] + s * along[k] + depth * outward[k], 3) for k in (0, 1)]

    def box(name, s0, s1, d0=0.0, d1=WALL_M):
        a, b = at(s0, d0), at(s1, d1)
        return wall(name, [min(a[k], b[k]) for k in (0, 1)], [max(a[k], b[k]) for k in (0, 1)])

    walls, exits, openings = [], [], []
    begin = from_m
    for door in doors:
        middle, width, name = door["at_m"], door["width_m"], door["id"]
        low, high = middle - width / 2, middle + width / 2
        walls.append(box(f"wall_{name}", begin, low))
        begin = high
        depth = draw.choice([0.0, WALL_M / 2, WALL_M])
        more = door["drawn_wider_m"]
        ends = [(low - more, high + more)]
        free = [(low, high)]
        if door["pillar_m"]:
            left = low + door["pillar_at_m"]
            walls.append(box(f"pillar_{name}", left, left + door["pillar_m"], 0.1, 0.3))
        if door["halves"]:
            ends = free = [(low, middle), (middle, high)]
        for number, (start, end) in enumerate(ends):
            exit = {
                "id": f"{name}{'ab'[number] if door['halves'] else ''}",
                "from": at(start, depth),
                "to": at(end, depth),
            }
            exit["outward"] = list(outward)
            if door["closes_at_s"] is not None:
                exit["closes_at_s"] = door["closes_at_s"]
            if door["never_opens"]:
                exit["open"] = False
            exits.append(exit)
            first, last = free[number]
            openings.append(
                {
                    "id": exit["id"],
                    "a": np.array(at(first, depth)),
                    "b": np.array(at(last, depth)),
                    "outward": np.array(outward),
                    "free_m": last - first - door["pillar_m"],
                    "low_m": 0 if door["halves"] and number == 1 else 1,
                    "high_m": 0 if door["halves"] and number == 0 else 1,
                    "open_until_s": 0
                    if door["never_opens"]
                    else door["closes_at_s"]
                    if door["closes_at_s"] is not None
                    else math.inf,
                }
            )
    walls.append(box(f"end_{corner[0]}_{corner[1]}_{along[0]}", begin, length_m))
    return walls, exits, openings


def random_door(name, at_m, draw):
    kind = draw.choice(["plain", "plain", "wider", "halves", "pillar"])
    width_m = round(draw.uniform(1.6, 3), 1)
    pillar_m = round(draw.uniform(0.2, 0.4), 2) if kind == "pillar" else 0
    return {
        "id": name,
        "at_m": at_m,
        "width_m": width_m,
        "drawn_wider_m": round(draw.uniform(0.2, 2), 1) if kind == "wider" else 0,
        "halves": kind == "halves",
        "pillar_m": pillar_m,
        "pillar_at_m": round(draw.uniform(0.55, width_m - pillar_m - 0.55), 2) if pillar_m else 0,
        "closes_at_s": None,
        "never_opens": False,
    }


def sides_of(x, y, notch):
    """The sides of a hall x by y, without a notch in its north-east corner from (x1, y1) on if there is one."""
    x1, y1 = notch or (x, y)
    sides = {
        "w": ((0, 0), (0, 1), (-1, 0), y, 0),
        "s": ((0, 0), (1, 0), (0, -1), x, 0),
        "e": ((x, 0), (0, 1), (1, 0), y1, 0),
        "n": ((0, y), (1, 0), (0, 1), x1, 0),
    }
    if notch:
        sides["notch_e"] = ((x1, y1), (0, 1), (1, 0), y - y1, WALL_M)
        sides["notch_n"] = ((x1, y1), (1, 0), (0, 1), x - x1, 0)
    return sides


def posts_of(x, y, notch):
    """Boxes that close the corners between walls that end there."""
    x1, y1 = notch or (x, y)
    corners = {(-WALL_M, -WALL_M), (x, -WALL_M), (-WALL_M, y), (x, y1), (x1, y)}
    return [wall(f"post_{i}", low, [value + WALL_M for value in low]) for i, low in enumerate(sorted(corners))]


def random_hall(seed):
    """The blueprint, and what its figures must know of it: the hall's shape, `inside`, the alarm, and the openings."""
    draw = random.Random(seed)
    x, y = draw.randint(16, 36), draw.randint(14, 26)
    notch = (x - draw.randint(5, 7), y - draw.randint(5, 6)) if draw.random() < 0.4 else None
    sides = sides_of(x, y, notch)
    used = ["w", "e", draw.choice(["n", "s", "notch_e", "notch_n"] if notch else ["n", "s"])][: draw.choice([2, 3, 3])]
    doors = {name: [random_door(name, round(draw.uniform(0.4, 0.6) * sides[name][3], 1), draw)] for name in used}
    named = [door for side in doors.values() for door in side]
    if draw.random() < 0.5:
        draw.choice(named)["closes_at_s"] = draw.choice([0, 4, 9, 14.5, 200])
    elif draw.random() < 0.5:
        draw.choice(named)["never_opens"] = True
    walls, exits, openings = posts_of(x, y, notch), [], []
    for name, side in sides.items():
        more_walls, more_exits, more_openings = side_of(side, doors.get(name, []), draw)
        walls += more_walls
        exits += more_exits
        openings += more_openings
    border_m = draw.choice([0, 0, WALL_M, 3, -1])
    low, high = [-border_m, -border_m], [x + border_m, y + border_m]
    inside = {"min": low, "max": high}
    if notch:
        inner = [value + border_m for value in notch]
        turns = [[high[0], inner[1]], inner, [inner[0], high[1]]]
        inside = {"corners": [low, [high[0], low[1]], *turns, [low[0], high[1]]]}
    x_most, y_most = x - 2, (notch[1] if notch else y) - 2
    people = {
        "groups": [
            {"doing": draw.choice(["stroll", "wait"]), "box": [2, 2, x_most, y_most], "count": draw.randint(10, 40)}
        ]
    }
    if draw.random() < 0.5:
        way_in = draw.choice([exit for exit in exits if exit.get("open", True)])
        people["sources"] = [{"exit": way_in["id"], "doing": "stroll", "per_minute": 40, "until_s": 12}]
    blueprint = {
        "name": f"Hall {seed}",
        "ground": {"min": [-20, -20], "max": [x + 20, y + 20], "material": "pavers"},
        "inside": inside,
        "exits": exits,
        "buildings": walls,
        "people": people,
        "disasters": [
            {
                "kind": "fire",
                "position": [x / 2, y_most / 2],
                "start_s": draw.choice([3, 6]),
                "radius_m": 1,
                "growth_mps": 0,
                "max_radius_m": 1,
            }
        ],
    }
    alarm_s = blueprint["disasters"][0]["start_s"]
    shape = {"max": (x, y), "notch": notch or (x, y)}
    return {"blueprint": blueprint, "shape": shape, "border_m": border_m, "alarm_s": alarm_s, "exits": openings}


if __name__ == "__main__":
    print(json.dumps(random_hall(int(sys.argv[1]))["blueprint"], indent=1))
