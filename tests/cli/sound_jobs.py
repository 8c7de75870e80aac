"""Small jobs of many kinds, whose datasets are sound: `throng validate` must find nothing in any of them.
See test_sound_datasets.py; `sound_jobs.py` prints their names."""

GEOMETRY = [
    "coco",
    "keypoints",
    "amodal",
    "vehicles",
    "difficulty",
    "heads",
    "skeletons",
    "actions",
    "occluders",
    "density",
    "exits",
    "hazards",
    "fields",
    "counts",
    "trajectories",
    "events",
    "depth",
    "instances",
    "parts",
    "normals",
    "flow",
    "flow_backward",
    "flow_occlusion",
    "scene_flow",
    "hazard_opacity",
    "semantic",
    "sensors",
]
BROWN = {"model": "brown_conrady", "distortion": {"k1": -0.25, "k2": 0.07, "p1": 0.001, "p2": -0.0015}}
FISHEYE = {"model": "fisheye", "distortion": {"k1": -0.01, "k2": 0.003}}
NOISY = {"iso": 1600, "exposure_s": 0.02, "vignette": 0.7}
JOBS = {}


def camera(pitch, yaw=0, hfov=70, width=400, height=300, **more):
    return {"width": width, "height": height, "hfov_deg": hfov, "pitch_deg": pitch, "yaw_deg": yaw, **more}


def drone(start, view, name="d1", **more):
    return {"id": name, "start": start, "camera": view, **more}


def job(name, scenario, drones, *, at=3, frames=3, rate=2, agents=None, crowd=None, **more):
    JOBS[name] = {
        "name": name,
        "scenario": scenario,
        "seed": 100 + len(JOBS),
        "crowd": {**({"agents": agents} if agents else {}), **(crowd or {})},
        "drones": drones,
        "capture": {"rate_hz": rate, "from_s": at, "to_s": at + (frames - 1) / rate + 1e-6},
        "outputs": {"annotations": GEOMETRY, "previews": 1},
        **more,
    }
    if not JOBS[name]["crowd"]:
        del JOBS[name]["crowd"]


def orbit(center, radius):
    return {"policy": "orbit", "center": center, "radius_m": radius, "speed_mps": 2}


# Shipped places, each from two sides.
job("bridge", "bridge/everyday", [drone([-22, -24, 22], camera(-40, 60)), drone([-36, -10, 36], camera(-55, 10), "d2")])
job("bridge emergency", "bridge/emergency", [drone([0, -18, 22], camera(-50, 90))], at=12)
job("campus", "campus/everyday", [drone([0, -34, 22], camera(-40, 90)), drone([30, 0, 40], camera(-60, 180), "d2")])
job(
    "campus emergency at dusk",
    "campus/emergency",
    [drone([0, -26, 25], camera(-35, 90))],
    at=14,
    environment={"time_of_day": "19:20"},
)
job("concert", "concert/everyday", [drone([0, -56, 32], camera(-32, 90))], agents=1500, frames=2)
job("concert emergency", "concert/emergency", [drone([0, -24, 30], camera(-70, 90))], agents=1000, frames=2, at=8)
job(
    "market",
    "market_in_park/everyday",
    [drone([-20, -24, 20], camera(-40, 60)), drone([-30, 10, 34], camera(-50, -30), "d2")],
)
job("market emergency", "market_in_park/emergency", [drone([0, -18, 22], camera(-60, 90))], at=15)
job(
    "street",
    "shopping_street/everyday",
    [drone([-44, 0, 18], camera(-32, 0)), drone([36, 0, 30], camera(-60, 180), "d2")],
)
job(
    "street emergency in smoke",
    "shopping_street/emergency",
    [drone([-34, 0, 24], camera(-40, 0))],
    at=14,
    environment={"smoke": 0.6},
)
job(
    "stadium",
    "stadium_exit/everyday",
    [drone([10, 64, 32], camera(-42, -90)), drone([-60, -10, 45], camera(-50, 0), "d2")],
    agents=600,
)
job("stadium emergency", "stadium_exit/emergency", [drone([8, 60, 32], camera(-60, -90))], agents=600, at=10)
job("station", "station/everyday", [drone([0, -26, 24], camera(-34, 90)), drone([34, 4, 34], camera(-50, 135), "d2")])
job("station emergency", "station/emergency", [drone([0, -12, 26], camera(-60, 90))], at=14)
job(
    "square",
    "city_square/nearest_exit",
    [drone([27, -6, 24], camera(-36, 180)), drone([-24, -12, 22], camera(-78, 90), "d2")],
    agents=200,
    at=20,
)
job("square everyday", "city_square/everyday", [drone([8, -3, 15], camera(-38, 90))])
job("huang2016", "city_square/huang2016/side_exit_blocked", [drone([27, -6, 24], camera(-36, 180))], at=10)

# Lenses, shutters, light.
job(
    "brown lens",
    "city_square/nearest_exit",
    [drone([8, -3, 15], camera(-38, 90, **BROWN)), drone([-8, 3, 18], camera(-60, 0, **BROWN), "d2")],
    agents=150,
    at=20,
)
job(
    "fisheye",
    "city_square/nearest_exit",
    [
        drone([8, -3, 15], camera(-38, 90, 110, **FISHEYE)),
        drone([4, 12, 15], camera(-42, 180, 100, **FISHEYE), "d2", guidance=orbit([-4, 0], 14)),
    ],
    agents=150,
    at=20,
)
job(
    "rain and umbrellas",
    "shopping_street/everyday",
    [drone([-44, 0, 18], camera(-45, 0, 40))],
    appearance={"umbrellas": 0.8},
    environment={"weather": "rain", "rain_mm_per_h": 10},
)
job(
    "umbrellas from above",
    "station/everyday",
    [drone([0, -12, 20], camera(-85, 90, 50))],
    appearance={"umbrellas": 0.9},
    environment={"weather": "rain"},
)
job(
    "fog", "campus/everyday", [drone([0, -34, 22], camera(-40, 90))], environment={"weather": "fog", "visibility_m": 90}
)
job("night", "city_square/everyday", [drone([8, -3, 15], camera(-38, 90))], environment={"time_of_day": "23:30"})
job(
    "noise and blur",
    "city_square/nearest_exit",
    [drone([4, 12, 15], camera(-42, 180, sensor=NOISY), guidance=orbit([-4, 0], 14))],
    agents=150,
    at=20,
)
job(
    "rolling shutter",
    "city_square/nearest_exit",
    [
        drone(
            [4, 12, 15], camera(-42, 180, sensor={"readout_s": 0.03, "exposure_s": 0.004}), guidance=orbit([-4, 0], 14)
        )
    ],
    agents=150,
    at=20,
)
job(
    "wind and gimbal",
    "city_square/nearest_exit",
    [
        drone([8, -3, 15], camera(-38, 90, gimbal={"model": "second_order"})),
        drone([-8, 3, 18], camera(-60, 0, gimbal={"model": "second_order"}), "d2"),
    ],
    agents=150,
    at=15,
    frames=4,
    environment={"wind": {"speed_mps": 7, "direction_deg": 40}},
)
job("draft", "station/everyday", [drone([0, -26, 24], camera(-34, 90))], quality="draft")
job("high", "city_square/nearest_exit", [drone([8, -3, 15], camera(-38, 90))], agents=150, at=20, quality="high")

# Cameras near people, low, steep, tiny, and of many directions.
job(
    "low camera",
    "city_square/nearest_exit",
    [drone([2, -14, 2.5], camera(-5, 90)), drone([-10, 0, 3], camera(-15, 0), "d2")],
    agents=200,
    at=10,
)
job(
    "low among the crowd",
    "station/everyday",
    [drone([0, -6, 2.2], camera(-10, 90)), drone([6, 2, 2.4], camera(-2, -160, 95), "d2")],
)
job(
    "low in a street",
    "shopping_street/everyday",
    [drone([-10, 0, 2.6], camera(0, 0, 80)), drone([10, 2, 3], camera(-20, 180, 90), "d2")],
)
job(
    "above heads",
    "market_in_park/everyday",
    [drone([0, 0, 4], camera(-90, 0, 90)), drone([5, 5, 5], camera(-75, 120, 100), "d2")],
)
job(
    "nadir",
    "city_square/nearest_exit",
    [drone([0, 0, 12], camera(-90, 0)), drone([-8, -4, 25], camera(-90, 77), "d2")],
    agents=200,
    at=15,
)
job(
    "tiny pictures",
    "city_square/nearest_exit",
    [drone([8, -3, 15], camera(-38, 90, 62, 160, 120)), drone([-8, 3, 18], camera(-60, 0, 80, 96, 64), "d2")],
    agents=200,
    at=20,
)
job("tele", "campus/everyday", [drone([0, -34, 60], camera(-55, 90, 12))])
job("horizon", "bridge/everyday", [drone([0, -30, 12], camera(3, 90, 90))])
job(
    "frames that differ",
    "city_square/everyday",
    [drone([8, -3, 15], camera(-38, 90, per_frame={"yaw_deg": 8, "pitch_deg": 4, "ev": 0.4}))],
)
job(
    "large pictures",
    "city_square/nearest_exit",
    [drone([8, -3, 15], camera(-38, 90, 62, 1280, 720))],
    agents=200,
    at=20,
    frames=2,
)

# People.
job(
    "bodies pushed",
    "city_square/nearest_exit",
    [drone([8, -3, 15], camera(-38, 90)), drone([-18, 3, 18], camera(-60, 0), "d2")],
    agents=260,
    crowd={"physical": True},
    at=25,
)
job(
    "people struck",
    "city_square/nearest_exit",
    [
        drone(
            [8, -3, 1.6],
            camera(-20, 90),
            guidance={"policy": "waypoints", "waypoints": [[8, -3, 1.6], [-10, -3, 1.5]], "speed_mps": 6},
        ),
        drone([0, 0, 16], camera(-80, 90), "d2"),
    ],
    agents=200,
    crowd={"physical": True, "fall_impulse_ns": 1},
    at=3,
    rate=4,
)
job(
    "helbing",
    "city_square/second_nearest",
    [drone([8, -3, 15], camera(-38, 90))],
    agents=150,
    crowd={"model": "helbing"},
    at=12,
)
job("children", "campus/everyday", [drone([0, -30, 12], camera(-40, 90))], appearance={"oldest_years": 12})
job("slow captures", "city_square/nearest_exit", [drone([8, -3, 15], camera(-38, 90))], agents=150, at=5, rate=0.2)
job(
    "odd captures",
    "city_square/nearest_exit",
    [drone([8, -3, 15], camera(-38, 90), guidance=orbit([8, 9], 12))],
    agents=150,
    at=5.37,
    rate=7.3,
    frames=4,
)
job(
    "fast captures",
    "city_square/nearest_exit",
    [drone([8, -3, 15], camera(-38, 90))],
    agents=150,
    at=9,
    rate=30,
    frames=4,
)
job("two runs", "city_square/nearest_exit", [drone([8, -3, 15], camera(-38, 90))], agents=120, at=12, runs=2)

# What rules once took for a fault.
job(
    "smoke in the wind",
    "station/emergency",
    [drone([-6, -14, 6], camera(-8, 90, 60))],
    at=20,
    rate=0.7,
    environment={"smoke": 0.3, "wind": {"speed_mps": 5, "direction_deg": 164}},
)
job(
    "line of a platform",
    "station/everyday",
    [drone([0, -4, 6], camera(-60, 90, 50)), drone([6, -6, 5], camera(-40, 170, 60), "d2")],
)
job(
    "sun at the horizon",
    "bridge/everyday",
    [drone([-20, -22, 14], camera(-22, 55, 75, 640, 400)), drone([0, -12, 8], camera(-25, 90, 85), "d2")],
    at=14,
    environment={"time_of_day": "19:40", "day_of_year": 172},
)
job(
    "noise in fog",
    "stadium_exit/emergency",
    [drone([8, 40, 12], camera(-20, -90, 90, sensor={"iso": 6400, "exposure_s": 0.01}))],
    at=14,
    agents=400,
    environment={"weather": "fog", "smoke": 0.3},
)
job(
    "image circle",
    "market_in_park/everyday",
    [
        {
            "id": "d1",
            "aim": {"height_m": 3},
            "camera": {
                "width": 480,
                "height": 360,
                "pitch_deg": -55,
                "model": "fisheye",
                "distortion": {"k1": -0.02, "k2": 0.004, "k3": -0.001, "k4": 0.0002},
                "fx_px": 158.4,
            },
        }
    ],
    rate=1.6,
    environment={"wind": {"speed_mps": 5, "direction_deg": 207}},
)
job(
    "falls",
    "station/emergency",
    [
        drone([-6, -14, 9], camera(-30, 80, 78)),
        drone(
            [-6, -10, 1.5],
            camera(0, 0, 90),
            "ram",
            guidance={
                "policy": "waypoints",
                "waypoints": [[-6, -10, 1.5], [14, -8, 1.4], [-12, -16, 1.5]],
                "speed_mps": 8,
            },
        ),
    ],
    agents=260,
    crowd={"physical": True, "fall_impulse_ns": 1.5},
    at=18,
    rate=1,
    frames=6,
)
job(
    "strong compression",
    "market_in_park/emergency",
    [drone([0, -18, 8], camera(-22, 90, 75))],
    at=16,
    outputs={"annotations": GEOMETRY, "image": {"quality": 30}},
)

# Places of other kinds.
for kind, seed in [("plaza", 5), ("street", 8), ("block", 3), ("campus", 6)]:
    job(f"generated {kind}", {"generate": {"kind": kind, "seed": seed}}, [drone([0, -20, 25], camera(-50, 90))], at=4)

if __name__ == "__main__":
    print("\n".join(JOBS))
