"""Damages to tables and polygons of exits, and to metrics."""
import json
import operator

from .dataset import damage, damage_by, damage_of_labels, each_image


def exits_name(d, run=0):
    return f"exits/{d.runs[run]}.csv"


def change_exits(d, change, name=None):
    name = name or exits_name(d)
    head, rows = d.table(name)
    rows = change(head, rows)
    d.save_table(name, head, rows)


@damage_by(change_exits)
def exits_shifted_by_one_frame(head, rows):
    exits = len({r[2] for r in rows})
    return [[*row[:3], *other[3:]] for row, other in zip(rows, rows[exits:] + rows[:exits])]


@damage_by(change_exits)
def exits_exchanged(head, rows):
    names = list(dict.fromkeys(r[2] for r in rows))
    for row in rows:
        row[2] = names[(names.index(row[2]) + 1) % len(names)]
    return rows


def change_column(d, column, change):
    """Of the first run's table; images keep what they have."""

    def changed(head, rows):
        at = head.index(column)
        return [[*row[:at], change(row[at]), *row[at + 1 :]] for row in rows]

    change_exits(d, changed)


def busy_columns(d, change):
    """Table and images alike, where the demand is there."""
    for run in range(len(d.runs)):
        name = exits_name(d, run)
        head, rows = d.table(name)
        before = json.dumps(rows)
        for row in rows:
            change({key: i for i, key in enumerate(head)}, row)
        if json.dumps(rows) != before:
            d.save_table(name, head, rows)
        values = {(int(r[0]), r[2]): r for r in rows}
        for image in d.images:
            if image["run"] != d.runs[run]:
                continue
            for exit in image["exits"]:
                row = values[image["frame"], exit["id"]]
                exit["state"] = row[head.index("state")]
                for key, column in (
                    ("in_zone", "in_zone"),
                    ("queue", "queue"),
                    ("queue_length_m", "queue_length"),
                    ("clogging_index", "clogging_index"),
                    ("flow_per_s", "flow"),
                ):
                    number = float(row[head.index(column)])
                    exit[key] = int(number) if key in ("in_zone", "queue") else number
    assert d.touched, "nothing changed"
    d.save_coco()


def change_busy_column(d, column, change):
    busy_columns(d, lambda at, row: operator.setitem(row, at[column], change(row[at[column]])))


@damage_by(busy_columns)
def clogging_index_inverted_where_people_wait(at, row):
    if row[at["demand"]] == "1":
        row[at["clogging_index"]] = f"{1 - float(row[at['clogging_index']]):.4f}"


@damage_by(busy_columns)
def states_of_exits_idle(at, row):
    row[at["state"]] = row[at["state_offline"]] = "idle"


@damage_by(busy_columns)
def density_of_exits_per_10_m2(at, row):
    for key in ("density",):
        row[at[key]] = f"{10 * float(row[at[key]]):.4f}" if row[at["frame"]] == "2" else row[at[key]]


@damage_by(busy_columns)
def people_at_exits_too_few(at, row):
    n = int(row[at["in_zone"]])
    if n > 2:
        for key in ("density", "normalised_density"):
            row[at[key]] = f"{float(row[at[key]]) * (n // 2) / n:.4f}"
        row[at["in_zone"]] = str(n // 2)


@damage_of_labels
def door_3_px_off_in_one_picture(d):
    image = next(i for i in d.images if i["frame"] > 0 and any(e["door"] for e in i["exits"]))
    exit = next(e for e in image["exits"] if e["door"])
    exit["door"] = [[x + 3, y] for x, y in exit["door"]]


@damage_by(each_image)
def doors_and_zones_exchanged(image):
    for exit in image["exits"]:
        exit["door"], exit["zone"] = exit["zone"], exit["door"]


@damage_of_labels
def zones_of_two_exits_exchanged(d):
    image = max(d.images, key=lambda i: sum(1 for e in i["exits"] if e["zone"]))
    a, b = [e for e in image["exits"] if e["zone"]][:2]
    a["zone"], b["zone"] = b["zone"], a["zone"]


def change_metrics(d, change, copies=True):
    metrics = json.loads(d.path("metrics.json").read_text())
    before = json.dumps(metrics)
    change(metrics["runs"][0])
    assert json.dumps(metrics) != before, "nothing changed"
    d.write("metrics.json", json.dumps(metrics, indent=2) + "\n")
    if copies:
        name = f"metrics/{d.runs[0]}.json"
        own = json.loads(d.path(name).read_text())
        change(own)
        d.write(name, json.dumps(own, indent=2) + "\n")


@damage_by(change_metrics)
def metrics_with_another_number_of_people(run):
    run["people"] += 1


@damage_by(change_metrics)
def metrics_time_in_state_halved(run):
    for exit in run["exits"]:
        for key in exit["time_in_state"]:
            exit["time_in_state"][key] /= 2


@damage_by(change_metrics)
def metrics_greatest_density_halved(run):
    for exit in run["exits"]:
        exit["max_voronoi_density_per_m2"] /= 2


@damage_by(change_metrics)
def escape_curve_reversed(run):
    run["escape_curve"]["escaped_share"] = [1 - v for v in run["escape_curve"]["escaped_share"]]


@damage_by(change_exits)
def crossings_one_more(head, rows):
    at = head.index("crossed_out")
    wanted = max(rows, key=lambda r: int(r[at]))[2]
    for row in rows:
        row[at] = str(int(row[at]) + 1) if row[2] == wanted else row[at]
    return rows


@damage
def crossings_one_more_from_a_frame_on(d):
    def more(head, rows):
        at = head.index("crossed_out")
        wanted = max(rows, key=lambda r: int(r[at]))[2]
        for row in rows:
            if row[2] == wanted and int(row[0]) >= d.frames // 2:
                row[at] = str(int(row[at]) + 1)
        return rows

    change_exits(d, more)


@damage_by(change_exits)
def crossings_in_and_out_exchanged(head, rows):
    a, b = head.index("crossed_out"), head.index("crossed_in")
    for row in rows:
        row[a], row[b] = row[b], row[a]
    return rows


@damage_by(change_exits)
def exits_with_nan(head, rows):
    rows[len(rows) // 2][head.index("density")] = "nan"
    return rows


@damage_of_labels
def door_of_one_exit_3_px_off_in_all_pictures(d):
    exits = [e for i in d.images for e in i["exits"] if e["door"]]
    assert exits, "no door is seen"
    for exit in exits:
        if exit["id"] == exits[0]["id"]:
            exit["door"] = [[x + 3, y] for x, y in exit["door"]]


@damage_by(change_metrics)
def mean_escape_time_10_s_more(run):
    run["mean_escape_time_censored_s"] += 10


@damage_by(change_metrics)
def escape_percentiles_20_percent_less(run):
    values = run["escape_time_percentiles"]
    for key, value in values.items():
        if isinstance(value, (int, float)):
            values[key] = 0.8 * value


@damage_by(change_metrics)
def not_escaped_one_less(run):
    run["not_escaped"] -= 1


@damage_by(change_metrics)
def one_more_left_by_an_exit(run):
    run["people_counts"]["left_by_exit"][0]["people"] += 1


@damage_by(change_metrics)
def net_out_one_more(run):
    exit = max(run["exits"], key=lambda e: e["net_out"])
    exit["net_out"] += 1


@damage_by(change_metrics)
def shares_of_exits_moved_by_one(run):
    shares = [e["share_of_net_out"] for e in run["exits"]]
    for exit, share in zip(run["exits"], shares[1:] + shares[:1]):
        exit["share_of_net_out"] = share


@damage_by(change_metrics, copies=False)
def metrics_in_one_place_only(run):
    run["people"] += 1


@damage_by(change_metrics)
def drones_of_metrics_flew_farther(run):
    for drone in run["drones"]:
        drone["flown_m"] += 20


@damage_by(change_metrics)
def exposure_doubled(run):
    def double(value):
        if isinstance(value, dict):
            return {k: double(v) for k, v in value.items()}
        return 2 * value if isinstance(value, (int, float)) else value

    run["exposure"] = double(run["exposure"])


DAMAGES = {
    "clogging index inverted": lambda d: change_busy_column(d, "clogging_index", lambda v: f"{1 - float(v):.4f}"),
    "flow of exits doubled": lambda d: change_busy_column(d, "flow", lambda v: f"{2 * float(v):.2f}"),
    "queues one more": lambda d: change_busy_column(d, "queue", lambda v: str(int(v) + 1)),
    "people at exits one more": lambda d: change_busy_column(d, "in_zone", lambda v: str(int(v) + 1)),
    "predicted waits halved": lambda d: change_column(d, "predicted_wait", lambda v: f"{float(v) / 2:.2f}"),
    "predicted waits doubled": lambda d: change_column(d, "predicted_wait", lambda v: f"{float(v) * 2:.2f}"),
    "pressure of exits doubled": lambda d: change_column(d, "pressure", lambda v: f"{2 * float(v):.4f}"),
    "exits of the other run": lambda d: d.exchange(exits_name(d, 0), exits_name(d, 1)),
    "metrics of two runs exchanged": lambda d: d.exchange(f"metrics/{d.runs[0]}.json", f"metrics/{d.runs[1]}.json"),
}
