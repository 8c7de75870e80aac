"""Small jobs of many kinds, whose datasets are sound: `throng validate` must find nothing in any of them.
See test_sound_datasets.py; `sound_jobs.py` prints their names."""

GEOMETRY = """coco keypoints amodal vehicles difficulty heads skeletons actions occluders density exits hazards fields counts
trajectories events depth instances parts normals flow flow_backward flow_occlusion scene_flow hazard_opacity
semantic sensors""".split()
BROWN = {"model": "brown_conrady", "distortion": {"k1": -0.25, "k2": 0.07, "p1": 0.001, "p2": -0.0015}}
FISHEYE = {"model": "fisheye", "distortion": {"k1": -0.01, "k2": 0.003}}
NOISY = {"iso": 1600, "exposure_s": 0.02, "vignette": 0.7}
SQUARE = "city_square/nearest_exit"
JOBS = {}


def view(start, pitch, yaw=0, hfov=70, width=400, height=300, *, name=None, guidance=None, **more):
    """A drone; without a name it is d1, d2, and so on."""
    camera = {"width": width, "height": height, "hfov_deg": hfov, "pitch_deg": pitch, "yaw_deg": yaw, **more}
    drone = {"start": start, "camera": camera, **({"guidance": guidance} if guidance else {})}
    return {"id": name, **drone} if name else drone


def job(name, scenario, *drones, at=3, frames=3, rate=2, agents=None, crowd=None, **more):
    JOBS[name] = {
        "name": name,
        "scenario": scenario,
        "seed": 100 + len(JOBS),
        "crowd": {**({"agents": agents} if agents else {}), **(crowd or {})},
        "drones": [{"id": f"d{number}", **drone} for number, drone in enumerate(drones, 1)],
        "capture": {"rate_hz": rate, "from_s": at, "to_s": at + (frames - 1) / rate + 1e-6},
        "outputs": {"annotations": GEOMETRY, "previews": 1},
        **more,
    }
    if not JOBS[name]["crowd"]:
        del JOBS[name]["crowd"]


def orbit(center, radius):
    return {"policy": "orbit", "center": center, "radius_m": radius, "speed_mps": 2}


VIEW = view([8, -3, 15], -38, 90)

# Shipped places, each from two sides.
job("bridge", "bridge/everyday", view([-22, -24, 22], -40, 60), view([-36, -10, 36], -55, 10))
job("bridge emergency", "bridge/emergency", view([0, -18, 22], -50, 90), at=12)
job("campus", "campus/everyday", view([0, -34, 22], -40, 90), view([30, 0, 40], -60, 180))
job(
    "campus emergency at dusk",
    "campus/emergency",
    view([0, -26, 25], -35, 90),
    at=14,
    environment={"time_of_day": "19:20"},
)
job("concert", "concert/everyday", view([0, -56, 32], -32, 90), agents=1500, frames=2)
job("concert emergency", "concert/emergency", view([0, -24, 30], -70, 90), agents=1000, frames=2, at=8)
job("market", "market_in_park/everyday", view([-20, -24, 20], -40, 60), view([-30, 10, 34], -50, -30))
job("market emergency", "market_in_park/emergency", view([0, -18, 22], -60, 90), at=15)
job("street", "shopping_street/everyday", view([-44, 0, 18], -32, 0), view([36, 0, 30], -60, 180))
job(
    "street emergency in smoke",
    "shopping_street/emergency",
    view([-34, 0, 24], -40, 0),
    at=14,
    environment={"smoke": 0.6},
)
job("stadium", "stadium_exit/everyday", view([10, 64, 32], -42, -90), view([-60, -10, 45], -50, 0), agents=600)
job("stadium emergency", "stadium_exit/emergency", view([8, 60, 32], -60, -90), agents=600, at=10)
job("station", "station/everyday", view([0, -26, 24], -34, 90), view([34, 4, 34], -50, 135))
job("station emergency", "station/emergency", view([0, -12, 26], -60, 90), at=14)
job("square", SQUARE, view([27, -6, 24], -36, 180), view([-24, -12, 22], -78, 90), agents=200, at=20)
job("square everyday", "city_square/everyday", VIEW)
job("huang2016", "city_square/huang2016/side_exit_blocked", view([27, -6, 24], -36, 180), at=10)

# Lenses, shutters, light.
job("brown lens", SQUARE, view([8, -3, 15], -38, 90, **BROWN), view([-8, 3, 18], -60, 0, **BROWN), agents=150, at=20)
job(
    "fisheye",
    SQUARE,
    view([8, -3, 15], -38, 90, 110, **FISHEYE),
    view([4, 12, 15], -42, 180, 100, **FISHEYE, guidance=orbit([-4, 0], 14)),
    agents=150,
    at=20,
)
job(
    "rain and umbrellas",
    "shopping_street/everyday",
    view([-44, 0, 18], -45, 0, 40),
    appearance={"umbrellas": 0.8},
    environment={"weather": "rain", "rain_mm_per_h": 10},
)
job(
    "umbrellas from above",
    "station/everyday",
    view([0, -12, 20], -85, 90, 50),
    appearance={"umbrellas": 0.9},
    environment={"weather": "rain"},
)
job("fog", "campus/everyday", view([0, -34, 22], -40, 90), environment={"weather": "fog", "visibility_m": 90})
job("night", "city_square/everyday", VIEW, environment={"time_of_day": "23:30"})
job("noise and blur", SQUARE, view([4, 12, 15], -42, 180, sensor=NOISY, guidance=orbit([-4, 0], 14)), agents=150, at=20)
job(
    "rolling shutter",
    SQUARE,
    view([4, 12, 15], -42, 180, sensor={"readout_s": 0.03, "exposure_s": 0.004}, guidance=orbit([-4, 0], 14)),
    agents=150,
    at=20,
)
job(
    "wind and gimbal",
    SQUARE,
    view([8, -3, 15], -38, 90, gimbal={"model": "second_order"}),
    view([-8, 3, 18], -60, 0, gimbal={"model": "second_order"}),
    agents=150,
    at=15,
    frames=4,
    environment={"wind": {"speed_mps": 7, "direction_deg": 40}},
)
job("draft", "station/everyday", view([0, -26, 24], -34, 90), quality="draft")
job("high", SQUARE, VIEW, agents=150, at=20, quality="high")

# Cameras near people, low, steep, tiny, and of many directions.
job("low camera", SQUARE, view([2, -14, 2.5], -5, 90), view([-10, 0, 3], -15, 0), agents=200, at=10)
job("low among the crowd", "station/everyday", view([0, -6, 2.2], -10, 90), view([6, 2, 2.4], -2, -160, 95))
job("low in a street", "shopping_street/everyday", view([-10, 0, 2.6], 0, 0, 80), view([10, 2, 3], -20, 180, 90))
job("above heads", "market_in_park/everyday", view([0, 0, 4], -90, 0, 90), view([5, 5, 5], -75, 120, 100))
job("nadir", SQUARE, view([0, 0, 12], -90, 0), view([-8, -4, 25], -90, 77), agents=200, at=15)
job(
    "tiny pictures",
    SQUARE,
    view([8, -3, 15], -38, 90, 62, 160, 120),
    view([-8, 3, 18], -60, 0, 80, 96, 64),
    agents=200,
    at=20,
)
job("tele", "campus/everyday", view([0, -34, 60], -55, 90, 12))
job("horizon", "bridge/everyday", view([0, -30, 12], 3, 90, 90))
job(
    "frames that differ",
    "city_square/everyday",
    view([8, -3, 15], -38, 90, per_frame={"yaw_deg": 8, "pitch_deg": 4, "ev": 0.4}),
)
job("large pictures", SQUARE, view([8, -3, 15], -38, 90, 62, 1280, 720), agents=200, at=20, frames=2)

# People.
job("bodies pushed", SQUARE, VIEW, view([-18, 3, 18], -60, 0), agents=260, crowd={"physical": True}, at=25)
job(
    "people struck",
    SQUARE,
    view(
        [8, -3, 1.6],
        -20,
        90,
        guidance={"policy": "waypoints", "waypoints": [[8, -3, 1.6], [-10, -3, 1.5]], "speed_mps": 6},
    ),
    view([0, 0, 16], -80, 90),
    agents=200,
    crowd={"physical": True, "fall_impulse_ns": 1},
    at=3,
    rate=4,
)
job("helbing", "city_square/second_nearest", VIEW, agents=150, crowd={"model": "helbing"}, at=12)
job("children", "campus/everyday", view([0, -30, 12], -40, 90), appearance={"oldest_years": 12})
job("slow captures", SQUARE, VIEW, agents=150, at=5, rate=0.2)
job(
    "odd captures",
    SQUARE,
    view([8, -3, 15], -38, 90, guidance=orbit([8, 9], 12)),
    agents=150,
    at=5.37,
    rate=7.3,
    frames=4,
)
job("fast captures", SQUARE, VIEW, agents=150, at=9, rate=30, frames=4)
job("two runs", SQUARE, VIEW, agents=120, at=12, runs=2)

# Kinds that rules once took for faults.
job(
    "smoke in the wind",
    "station/emergency",
    view([-6, -14, 6], -8, 90, 60),
    at=20,
    rate=0.7,
    environment={"smoke": 0.3, "wind": {"speed_mps": 5, "direction_deg": 164}},
)
job("line of a platform", "station/everyday", view([0, -4, 6], -60, 90, 50), view([6, -6, 5], -40, 170, 60))
job(
    "sun at the horizon",
    "bridge/everyday",
    view([-20, -22, 14], -22, 55, 75, 640, 400),
    view([0, -12, 8], -25, 90, 85),
    at=14,
    environment={"time_of_day": "19:40", "day_of_year": 172},
)
job(
    "noise in fog",
    "stadium_exit/emergency",
    view([8, 40, 12], -20, -90, 90, sensor={"iso": 6400, "exposure_s": 0.01}),
    at=14,
    agents=400,
    environment={"weather": "fog", "smoke": 0.3},
)
job(
    "image circle",
    "market_in_park/everyday",
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
    },
    rate=1.6,
    environment={"wind": {"speed_mps": 5, "direction_deg": 207}},
)
job(
    "falls",
    "station/emergency",
    view([-6, -14, 9], -30, 80, 78),
    view(
        [-6, -10, 1.5],
        0,
        0,
        90,
        guidance={"policy": "waypoints", "waypoints": [[-6, -10, 1.5], [14, -8, 1.4], [-12, -16, 1.5]], "speed_mps": 8},
        name="ram",
    ),
    agents=260,
    crowd={"physical": True, "fall_impulse_ns": 1.5},
    at=18,
    rate=1,
    frames=6,
)
job(
    "strong compression",
    "market_in_park/emergency",
    view([0, -18, 8], -22, 90, 75),
    at=16,
    outputs={"annotations": GEOMETRY, "image": {"quality": 30}},
)

# Places of other kinds.
for kind, seed in [("plaza", 5), ("street", 8), ("block", 3), ("campus", 6)]:
    job(f"generated {kind}", {"generate": {"kind": kind, "seed": seed}}, view([0, -20, 25], -50, 90), at=4)

if __name__ == "__main__":
    print("\n".join(JOBS))
