"""Damages to cameras, flights, sensors and the environment."""
import json

import numpy

from .dataset import damage, damage_by, damage_of_labels, each_image


@damage_by(each_image)
def flight_moved_by_5_m(image):
    image["flight"]["true"]["position"][0] += 5


@damage_of_labels
def flight_of_one_picture_moved_by_20_cm(d):
    d.image()["flight"]["true"]["position"][1] += 0.2


@damage_of_labels
def camera_and_flight_moved_by_5_m(d):
    """The camera's pose, the flight's truth and the sensors' tables."""
    for image in d.images:
        camera = image["camera"]
        image["flight"]["true"]["position"][0] += 5
        image["flight"]["measured"]["gps"]["position"][0] += 5
        camera["centre"][0] += 5
        camera["t"] = (-numpy.array(camera["R"]) @ camera["centre"]).tolist()
    for path in d.path("sensors").rglob("*.csv"):
        name = str(path.relative_to(d.root))
        head, rows = d.table(name)
        for row in rows:
            for column in ("true_x_m", "gps_x_m"):
                row[head.index(column)] = repr(float(row[head.index(column)]) + 5)
        d.save_table(name, head, rows)


@damage_by(each_image)
def camera_turned_by_half_a_degree(image):
    camera = image["camera"]
    c, s = numpy.cos(numpy.radians(0.5)), numpy.sin(numpy.radians(0.5))
    turn = numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    camera["R"] = (turn @ camera["R"]).tolist()
    camera["t"] = (-numpy.array(camera["R"]) @ camera["centre"]).tolist()


@damage_of_labels
def camera_of_the_frame_before(d):
    d.image(-1, 3)["camera"] = d.image(-1, 2)["camera"]


@damage_by(each_image)
def focal_length_1_percent_more(image):
    image["camera"]["K"][0][0] *= 1.01
    image["camera"]["K"][1][1] *= 1.01


@damage_by(each_image)
def flight_velocity_axes_exchanged(image):
    v = image["flight"]["true"]["velocity"]
    v[0], v[1] = v[1], v[0]


@damage_by(each_image)
def flight_orientation_inverted(image):
    q = image["flight"]["true"]["orientation_wxyz"]
    q[1:] = [-v for v in q[1:]]


@damage_by(each_image)
def gimbal_yaw_with_the_other_sign(image):
    image["flight"]["true"]["gimbal"]["yaw_deg"] *= -1


@damage_by(each_image)
def gimbal_in_radians(image):
    for name in ("true", "measured"):
        gimbal = image["flight"][name]["gimbal"]
        for key in gimbal:
            gimbal[key] = float(numpy.radians(gimbal[key]))


@damage_by(each_image)
def gyro_and_accelerometer_of_pictures_exchanged(image):
    m = image["flight"]["measured"]
    m["gyro"], m["accelerometer"] = m["accelerometer"], m["gyro"]


def sensor_tables(d):
    return sorted(str(p.relative_to(d.root)) for p in d.path("sensors").rglob("*.csv"))


def exchange_columns(d, a, b, names=None):
    for name in names or sensor_tables(d):
        head, rows = d.table(name)
        i, j = head.index(a), head.index(b)
        for row in rows:
            row[i], row[j] = row[j], row[i]
        d.save_table(name, head, rows)


@damage
def sensor_rows_late_by_one(d):
    name = sensor_tables(d)[-1]
    head, rows = d.table(name)
    d.save_table(name, head, [[row[0], *before[1:]] for before, row in zip(rows[:1] + rows, rows)])


@damage
def sensor_readings_late_by_10_rows(d):
    name = sensor_tables(d)[-1]
    head, rows = d.table(name)
    first = head.index("gyro_x_rad_s")
    late = rows[:10] + rows
    d.save_table(name, head, [[*row[:first], *before[first:]] for before, row in zip(late, rows)])


@damage
def gyro_in_degrees(d):
    for name in sensor_tables(d):
        head, rows = d.table(name)
        first = head.index("gyro_x_rad_s")
        for row in rows:
            row[first : first + 3] = [repr(float(numpy.degrees(float(v)))) for v in row[first : first + 3]]
        d.save_table(name, head, rows)


@damage
def sensors_of_the_other_drone(d):
    tables = sensor_tables(d)
    d.exchange(tables[0], tables[1])


@damage
def sensors_of_the_other_run(d):
    tables = sensor_tables(d)
    d.exchange(tables[0], tables[len(d.cameras)])


@damage
def one_row_of_sensors_spoilt(d):
    name = sensor_tables(d)[-1]
    head, rows = d.table(name)
    rows[len(rows) // 3][head.index("true_x_m")] = repr(float(rows[len(rows) // 3][head.index("true_x_m")]) + 0.3)
    d.save_table(name, head, rows)


@damage_of_labels
def sun_on_the_other_side(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    for record in [*d.images, *manifest["runs"]]:
        record["environment"]["sun_azimuth_deg"] += 90
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage_of_labels
def weather_of_one_run(d):
    for image in d.images:
        if image["run"] == d.runs[1]:
            image["environment"]["weather"] = "rain"


DAMAGES = {
    "sensor columns vx and vy exchanged": lambda d: exchange_columns(
        d, "true_vx_mps", "true_vy_mps", sensor_tables(d)[-1:]
    ),
    "sensor columns gyro y and z exchanged": lambda d: exchange_columns(d, "gyro_y_rad_s", "gyro_z_rad_s"),
    "sensor columns gps and truth exchanged": lambda d: exchange_columns(d, "true_y_m", "gps_y_m"),
}
