"""Damages to lenses, poses, times and readings that are consistent in several places."""
import json
import re

import numpy

from .cameras import sensor_tables
from .dataset import damage, damage_by, damage_of_labels, each_image


def change_calibrations(d, change):
    for path in d.path("cameras").rglob("*.yaml"):
        name = str(path.relative_to(d.root))
        d.write(name, change(path.read_text()))


@damage_of_labels
def focal_length_3_percent_more_in_calibrations_too(d):
    image = d.images[0]
    fx, fy = image["camera"]["K"][0][0], image["camera"]["K"][1][1]
    for image in d.images:
        image["camera"]["K"][0][0] *= 1.03
        image["camera"]["K"][1][1] *= 1.03
    change_calibrations(d, lambda text: scale_numbers(text, {fx, fy}, 1.03))


def scale_numbers(text, values, factor):
    def scaled(match):
        number = float(match.group(0))
        near = any(abs(number - value) < 1e-4 * abs(value) for value in values)
        return repr(number * factor) if near else match.group(0)

    return re.sub(r"-?\d+\.\d*(?:[eE][+-]?\d+)?", scaled, text)


@damage_by(each_image)
def focal_length_3_percent_more_along_x(image):
    image["camera"]["K"][0][0] *= 1.03


@damage_by(each_image)
def principal_point_3_px_off(image):
    image["camera"]["K"][0][2] += 3


@damage
def calibration_file_of_another_focal_length(d):
    fx = d.images[0]["camera"]["K"][0][0]
    change_calibrations(d, lambda text: scale_numbers(text, {fx}, 1.02))


@damage
def calibration_files_of_two_cameras_exchanged(d):
    names = sorted(str(p.relative_to(d.root)) for p in d.path("cameras").rglob("*.opencv.yaml"))
    d.exchange(names[0], names[1])


@damage_of_labels
def distortion_with_the_other_sign(d):
    assert any("distortion" in i["camera"] for i in d.images), "no lens"
    for image in d.images:
        lens = image["camera"].get("distortion", {})
        for key in lens:
            lens[key] = -lens[key]


@damage_of_labels
def lens_called_pinhole(d):
    assert any("distortion" in i["camera"] for i in d.images), "no lens"
    for image in d.images:
        if image["camera"].pop("distortion", None):
            image["camera"]["model"] = "pinhole"


def turn_cameras(d, images, degrees):
    """About the world's vertical, through the camera's center: R, t, the flight's direction and gimbal."""
    c, s = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    turn = numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    for image in images:
        camera = image["camera"]
        R = numpy.array(camera["R"]) @ turn.T
        camera["R"] = R.tolist()
        camera["t"] = (-R @ camera["centre"]).tolist()
        truth = image["flight"]["true"]
        w, x, y, z = truth["camera_orientation_wxyz"]
        cw, sz = numpy.cos(numpy.radians(degrees) / 2), numpy.sin(numpy.radians(degrees) / 2)
        truth["camera_orientation_wxyz"] = [cw * w - sz * z, cw * x - sz * y, cw * y + sz * x, cw * z + sz * w]
        for gimbal in (truth["gimbal"], image["flight"]["measured"]["gimbal"]):
            gimbal["yaw_deg"] = (gimbal["yaw_deg"] + degrees + 180) % 360 - 180
    d.save_coco()


@damage_of_labels
def times_one_frame_late(d):
    step = d.image(0, 1)["time_s"] - d.image(0, 0)["time_s"]
    for image in d.images:
        image["time_s"] += step


@damage_of_labels
def times_and_capture_half_a_second_late(d):
    """The times of images and the manifest's job; tables of exits and sensors keep theirs."""
    for image in d.images:
        image["time_s"] += 0.5
    manifest = json.loads(d.path("manifest.json").read_text())
    manifest["job"]["capture"]["from_s"] += 0.5
    manifest["job"]["capture"]["to_s"] += 0.5
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage_of_labels
def capture_rate_doubled(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    manifest["job"]["capture"]["rate_hz"] *= 2
    first = manifest["job"]["capture"]["from_s"]
    for image in d.images:
        image["time_s"] = first + (image["time_s"] - first) / 2
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage_of_labels
def weather_rain_everywhere(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    for record in [*d.images, *manifest["runs"]]:
        record["environment"]["weather"] = "rain"
        record["environment"]["rain_mm_per_h"] = 4.0
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage_of_labels
def time_of_day_three_hours_later(d):
    """With the sun where it then is; job, manifest and images alike."""
    manifest = json.loads(d.path("manifest.json").read_text())
    for record in [*d.images, *manifest["runs"]]:
        record["environment"]["time_of_day"] = "18:30"
        record["environment"]["sun_azimuth_deg"] = 161.9
        record["environment"]["sun_elevation_deg"] = 5.2
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage_by(each_image)
def sensor_record_says_noise(image):
    image["sensor"]["iso"] = 6400.0


def change_columns(d, names, change, tables=None):
    for table in tables or sensor_tables(d):
        head, rows = d.table(table)
        at = [head.index(name) for name in names]
        for row in rows:
            for i, value in zip(at, change([float(row[i]) for i in at], head, row)):
                row[i] = repr(float(value))
        d.save_table(table, head, rows)


GYRO = ["gyro_x_rad_s", "gyro_y_rad_s", "gyro_z_rad_s"]
MAGNETOMETER = ["mag_x_ut", "mag_y_ut", "mag_z_ut"]
GPS = ["gps_x_m", "gps_y_m", "gps_z_m"]


def columns_like(d, beginning):
    head, _ = d.table(sensor_tables(d)[0])
    found = [name for name in head if name.startswith(beginning)]
    assert len(found) == 3, head
    return found


@damage
def gyro_without_noise(d):
    true = columns_like(d, "true_w")
    change_columns(d, GYRO, lambda v, head, row: [float(row[head.index(name)]) for name in true])


@damage_of_labels
def energy_of_the_battery_halved(d):
    change_columns(d, ["energy_j"], lambda v, head, row: [v[0] / 2])
    for image in d.images:
        image["flight"]["true"]["energy_wh"] /= 2


@damage
def seeds_of_runs_exchanged(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    a, b = manifest["runs"][:2]
    a["seed"], b["seed"] = b["seed"], a["seed"]
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage
def gimbal_pitch_5_degrees_off_in_the_job(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    manifest["job"]["drones"][0]["camera"]["pitch_deg"] += 5
    d.write("manifest.json", json.dumps(manifest, indent=1))


@damage
def wind_of_the_job(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    manifest["job"]["environment"]["wind"]["speed_mps"] = 9.0
    d.write("manifest.json", json.dumps(manifest, indent=1))


DAMAGES = {
    "cameras turned by 1 degree": lambda d: turn_cameras(d, d.images, 1),
    "camera of one picture turned by 1 degree": lambda d: turn_cameras(d, [d.image()], 1),
    "accelerometer 5 percent more": lambda d: change_columns(
        d, columns_like(d, "acc"), lambda v, head, row: [1.05 * x for x in v]
    ),
    "magnetometer axes exchanged": lambda d: change_columns(
        d, columns_like(d, "mag"), lambda v, head, row: [v[1], v[0], v[2]]
    ),
    "gps 30 m off": lambda d: change_columns(d, GPS, lambda v, head, row: [v[0] + 30, v[1], v[2]]),
    "pressure in hectopascal": lambda d: change_columns(d, ["pressure_pa"], lambda v, head, row: [v[0] / 100]),
}
