"""Short jobs whose settings are drawn at random: places, times, hours, weathers, lenses, sensors, drones, crowds, people, outputs.
A seed gives one job; see test_random_datasets.py. `random_jobs.py SEED` prints its job."""
import json
import math
import random
import sys

from sound_jobs import BROWN, FISHEYE, GEOMETRY

PLACES = ["bridge", "campus", "city_square", "concert", "market_in_park", "shopping_street", "stadium_exit", "station"]
SCENARIOS = [f"{place}/{kind}" for place in PLACES for kind in ("everyday", "emergency")] + [
    f"city_square/{kind}"
    for kind in (
        "nearest_exit",
        "second_nearest",
        "side_exit_blocked",
        "crowded_exit_blocked",
        "huang2016/nearest_exit",
    )
]
GENERATED = ["plaza", "street", "block", "campus"]
CIRCLE = [0.03, 0.01, 0.003, 0.0005]  # the largest terms of a fisheye whose image has a border
MODELS = ["orca", "helbing", "ttc"]


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def random_sensor(draw):
    sensor = {}
    if draw.random() < 0.4:
        sensor["iso"] = round(log_uniform(draw, 100, 6400))
    if draw.random() < 0.4:
        sensor["exposure_s"] = round(log_uniform(draw, 0.0005, 0.02), 5)
    if draw.random() < 0.25:
        sensor["readout_s"] = round(draw.uniform(0.005, 0.03), 3)
    if draw.random() < 0.3:
        sensor["vignette"] = round(draw.random(), 2)
    if draw.random() < 0.3:
        sensor["ev"] = round(draw.uniform(-1, 1), 2)
    if draw.random() < 0.2:
        sensor["metering"] = "light"
    return sensor


def random_lens(draw, width):
    """Members of a camera: those of a pinhole or a lens, and its field of view."""
    lens = draw.choice([{}, {}, {}, BROWN, FISHEYE, "circle"])
    if lens == "circle":
        # The image of some of these is larger than what the lens's model describes.
        terms = {name: round(draw.uniform(-most, most), 4) for name, most in zip(("k1", "k2", "k3", "k4"), CIRCLE)}
        return {"model": "fisheye", "distortion": terms, "fx_px": round(width * draw.uniform(0.28, 0.45), 1)}
    return {"hfov_deg": round(log_uniform(draw, 15, 110 if lens is FISHEYE else 90), 1), **lens}


def random_camera(draw):
    width = round(draw.choice([log_uniform(draw, 64, 400), draw.uniform(200, 400), draw.uniform(200, 700)]))
    camera = {
        "width": width,
        "height": max(64, round(width * draw.uniform(0.5, 1))),
        "yaw_deg": round(draw.uniform(-180, 180), 1),
        "pitch_deg": round(draw.choice([-90, draw.uniform(-90, -20), draw.uniform(-60, -30), draw.uniform(-20, 5)]), 1),
        **random_lens(draw, width),
    }
    if sensor := random_sensor(draw):
        camera["sensor"] = sensor
    if draw.random() < 0.3:
        camera["gimbal"] = {"model": "second_order"}
    if draw.random() < 0.15:
        camera["per_frame"] = {"yaw_deg": 8, "pitch_deg": 4, "ev": 0.4}
    return camera


def random_drone(draw, name):
    """One that hovers, flies, sinks for want of power, or flies into what is in its way."""
    drone = {"id": name, "camera": random_camera(draw)}
    kind = draw.choice(["hover", "hover", "orbit", "waypoints", "crash", "battery"])
    if kind == "crash":
        height = round(draw.uniform(1.2, 4), 1)
        place = [round(draw.uniform(-20, 20), 1) for _ in range(2)]
        aim = [round(v + draw.uniform(-10, 10), 1) for v in place]
        drone["start"] = [*place, height]
        drone["guidance"] = {
            "policy": "waypoints",
            "waypoints": [[*aim, 1.2]],
            "speed_mps": round(draw.uniform(3, 9), 1),
        }
        return drone
    drone["aim"] = {"height_m": round(log_uniform(draw, *((20, 60) if kind == "orbit" else (2, 60))), 1)}
    if kind == "orbit":
        center = [round(draw.uniform(-10, 10), 1) for _ in range(2)]
        drone["guidance"] = {
            "policy": "orbit",
            "center": center,
            "radius_m": round(draw.uniform(8, 25), 1),
            "speed_mps": 3,
        }
    elif kind == "waypoints":
        points = [[round(draw.uniform(-20, 20), 1), round(draw.uniform(-20, 20), 1), 25] for _ in range(2)]
        drone["guidance"] = {"policy": "waypoints", "waypoints": points, "speed_mps": 5}
    elif kind == "battery":
        drone["battery"] = {"charge": draw.choice([0.05, 0.151, 0.16])}
    return drone


def sun_elevation_deg(minutes, latitude_deg, day_of_year):
    """Within a degree, of solar time."""
    declination = math.radians(-23.4 * math.cos(2 * math.pi * (day_of_year + 10) / 365))
    latitude, angle = math.radians(latitude_deg), math.radians((minutes / 60 - 12) * 15)
    up = math.sin(latitude) * math.sin(declination) + math.cos(latitude) * math.cos(declination) * math.cos(angle)
    return math.degrees(math.asin(up))


def random_time(draw):
    """Any hour, or one at which the sun is near the horizon."""
    latitude_deg = round(draw.uniform(-60, 65), 1)
    day_of_year = draw.randrange(1, 366)
    minutes = range(24 * 60)
    if draw.random() < 0.35:
        minutes = [m for m in minutes if abs(sun_elevation_deg(m, latitude_deg, day_of_year)) < 6] or minutes
    chosen = draw.choice(minutes)
    return {
        "time_of_day": f"{chosen // 60:02}:{chosen % 60:02}",
        "latitude_deg": latitude_deg,
        "day_of_year": day_of_year,
    }


def random_environment(draw):
    environment = {
        **random_time(draw),
        "weather": draw.choice(["clear", "clear", "overcast", "fog", "rain"]),
    }
    if environment["weather"] == "rain":
        environment["rain_mm_per_h"] = round(log_uniform(draw, 1, 60), 1)
    if draw.random() < 0.3:
        environment["visibility_m"] = round(log_uniform(draw, 30, 5000))
    if draw.random() < 0.5:
        environment["smoke"] = round(draw.random(), 2)
    if draw.random() < 0.6:
        wind = {"speed_mps": round(draw.uniform(1, 14), 1), "direction_deg": draw.randrange(360)}
        environment["wind"] = {**wind, "gusts": draw.choice(["dryden", "ou", "none"])}
    return environment


def random_crowd(draw):
    # At times hardly anybody, so that images show nobody.
    crowd = {"agents": draw.choice([1, 5, *(round(log_uniform(draw, low, 180)) for low in (10, 60, 60, 140))])}
    if draw.random() < 0.4:
        crowd["physical"] = True
        if draw.random() < 0.5:
            crowd["fall_impulse_ns"] = draw.choice([1, 1.5, 3])
    if draw.random() < 0.2:
        crowd["model"] = draw.choice(MODELS)
    if draw.random() < 0.15:
        crowd["separation"] = "hard"
    return crowd


def random_outputs(draw):
    # Nearly always everything; else some kinds, of which each may miss another that a check reads.
    kinds = GEOMETRY
    if draw.random() < 0.1:
        kinds = ["coco", *(kind for kind in GEOMETRY[1:] if draw.random() < 0.6)]
    outputs = {"annotations": kinds, "previews": draw.randrange(3), "image": {"quality": draw.randrange(40, 101)}}
    if "fields" in kinds and draw.random() < 0.5:
        outputs["fields"] = {"cells_m": [2]}
    if "counts" in kinds:
        corners = [[-12, -12], [12, -12], [12, 14], [-12, 14]]
        outputs["counts"] = {
            "zones": [{"id": "yard", "corners": corners}],
            "lines": [{"id": "middle", "start": [0, -20], "end": [0, 20]}],
        }
    if draw.random() < 0.3:
        outputs["formats"] = draw.sample(["coco", "mot", "yolo-detect", "visdrone-mot", "table", "voc"], 2)
    return outputs


def random_job(seed):
    draw = random.Random(seed)
    scenario = draw.choice(
        [*SCENARIOS, *({"generate": {"kind": kind, "seed": draw.randrange(1000)}} for kind in GENERATED)]
    )
    to_s = round(log_uniform(draw, 2, 60), 2)
    frames = draw.choice([1, 2, 3, 3, 4, 6])
    rate_hz = round(log_uniform(draw, 0.2, 30), 3)
    from_s = max(0, to_s - (frames - 1) / rate_hz)
    job = {
        "name": f"random {seed}",
        "scenario": scenario,
        "seed": draw.randrange(1000000),
        "runs": draw.choice([1, 1, 1, 1, 2]),
        "crowd": random_crowd(draw),
        "drones": [random_drone(draw, f"d{i + 1}") for i in range(draw.choice([1, 1, 2]))],
        "capture": {"rate_hz": rate_hz, "from_s": round(from_s, 6), "to_s": to_s + 1e-5},
        "environment": random_environment(draw),
        "quality": draw.choice(["draft", "standard", "standard", "high"]),
        "outputs": random_outputs(draw),
    }
    if draw.random() < 0.3:
        job["appearance"] = draw.choice(
            [{"oldest_years": 30}, {"umbrellas": 0.8}, {"saturation": 0}, {"brightness": 0.4}, {"variety": 0.2}]
        )
    if draw.random() < 0.2:
        job["props"] = {"density": round(draw.random(), 2)}
    return job


if __name__ == "__main__":
    print(json.dumps(random_job(int(sys.argv[1])), indent=1))
