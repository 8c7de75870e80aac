"""Files that the shell blocks of the documentation need: small jobs, places, points, boards and characters."""

import json
import math
import shutil
import subprocess
import zipfile

import numpy
from PIL import Image

from program import ROOT, write_json
from test_people import box_man

SMALL_VIEW = {"width": 160, "height": 120}
SMALL_JOB = {
    "scenario": "city_square/nearest_exit",
    "quality": "draft",
    "crowd": {"agents": 20},
    "drones": [{"id": "d1", "start": [0, -10, 20], "camera": SMALL_VIEW}],
    "capture": {"to_s": 1},
    "outputs": {"previews": 0},
}


def shortened(job):
    """The job with few people, small images and a second of time."""
    job["crowd"] = {**job.get("crowd", {}), "agents": 20}
    job["quality"] = "draft"
    for drone in job["drones"]:
        drone["camera"].update(SMALL_VIEW)
    start_s = job["capture"].get("from_s", 0)
    job["capture"] = {"from_s": start_s, "to_s": start_s + 1}
    return job


def source_tree(folder, throng, people):
    """The files of the source tree that commands name; the jobs in it are shortened."""
    (folder / "build" / "release" / "cli").mkdir(parents=True)
    (folder / "build" / "release" / "cli" / "throng").symlink_to(throng)
    (folder / "build" / "people").symlink_to(people)
    (folder / "tests").symlink_to(ROOT / "tests")
    (folder / "examples").symlink_to(ROOT / "examples")
    (folder / "scenarios").mkdir()
    for place in (ROOT / "scenarios").iterdir():
        if place.name != "city_square":
            (folder / "scenarios" / place.name).symlink_to(place)
    shutil.copytree(ROOT / "scenarios" / "city_square", folder / "scenarios" / "city_square")
    for file in (folder / "scenarios" / "city_square").glob("*.job.json"):
        write_json(file, shortened(json.loads(file.read_text())))


def job(folder, throng):
    write_json(folder / "job.json", SMALL_JOB)


def run_done(folder, throng):
    """out: the folder of a job that is done."""
    job(folder, throng)
    subprocess.run([throng, "run", "job.json", "-o", "out"], cwd=folder, check=True, capture_output=True)


def npm_packages(folder, throng):
    """The packages that the page has installed by npm: those of the build."""
    (folder / "node_modules").symlink_to(ROOT / "build/web/node_modules")


def traces(folder, throng):
    """run.h5 and plain.h5, paired runs; experiment.txt and place.json, recorded people and where they walked."""
    job(folder, throng)
    commands = (
        ["simulate", "job.json", "-o", "run.h5"],
        ["simulate", "job.json", "-o", "plain.h5"],
        ["metrics", "run.h5", "--to", "experiment.txt"],
    )
    for command in commands:
        subprocess.run([throng, *command], cwd=folder, check=True, capture_output=True)
    place = json.loads((ROOT / "scenarios" / "city_square" / "nearest_exit.json").read_text())
    place.pop("crowd")
    place.pop("drones", None)
    for exit in place["exits"]:
        exit.pop("goals", None)
    write_json(folder / "place.json", place)


def recordings(folder, throng):
    """recordings/walk.txt: people who walk through a corridor from x = 1 to 19 m."""
    lines = [f"{who} {15 * who + i} {1 + 0.1 * i:.1f} {1.5 if who % 2 else 1}" for who in range(12) for i in range(181)]
    (folder / "recordings" / "walk.txt").write_text("# framerate: 10\n" + "\n".join(lines))


def my_place(folder, throng):
    """my_place.json, its crowd, a trace in it and a job that flies there."""
    traces(folder, throng)
    for file in (ROOT / "scenarios" / "city_square").glob("nearest_exit*"):
        shutil.copy(file, folder)
    shutil.copy(ROOT / "scenarios" / "city_square" / "square_scene.xml", folder)
    (folder / "nearest_exit.json").rename(folder / "my_place.json")
    (folder / "job.json").rename(folder / "my.job.json")


def bundle(folder, throng):
    """my_place and my_place.zip: scenarios to upload; job.json names one of them."""
    blueprint = {
        "name": "Plaza",
        "ground": {"min": [-20, -20], "max": [20, 20], "material": "pavers"},
        "inside": {"min": [-12, -12], "max": [12, 12]},
        "exits": [{"id": "east", "from": [12, -4], "to": [12, 4]}],
        "drones": [{"id": "d1", "start": [0, -10, 20], "yaw_deg": 90}],
        "people": {"groups": [{"doing": "stroll", "box": [-8, -8, 8, 8], "count": 10}]},
    }
    write_json(folder / "plaza.blueprint.json", blueprint)
    subprocess.run(
        [throng, "scenario", "make", "plaza.blueprint.json", "-o", "my_place"],
        cwd=folder,
        check=True,
        capture_output=True,
    )
    with zipfile.ZipFile(folder / "my_place.zip", "w") as archive:
        for file in (folder / "my_place").iterdir():
            archive.write(file, f"my_place/{file.name}")
    write_json(folder / "job.json", {**SMALL_JOB, "scenario": "bundle/plaza", "crowd": {"agents": 5}})


def rotation(tilt, turn):
    a, b, c, d = math.cos(tilt), math.sin(tilt), math.cos(turn), math.sin(turn)
    return numpy.array([[c, 0, d], [0, 1, 0], [-d, 0, c]]) @ numpy.array([[1, 0, 0], [0, a, -b], [0, b, a]])


VIEWS = [
    (0.5, 0.1),
    (-0.5, 0.4),
    (0.1, -0.6),
    (0.6, 0.6),
    (-0.3, -0.5),
    (-0.6, -0.2),
    (0.4, 0.5),
    (-0.1, 0.7),
    (0.2, 0.3),
]


def boards(folder, throng):
    """boards/*.jpg and a.jpg to c.jpg: a chessboard of 9 x 6 inner corners at 25 mm, seen from many sides."""
    square, side = 0.025, 40
    squares = (numpy.add.outer(numpy.arange(7), numpy.arange(10)) % 2) * 255
    texture = numpy.pad(numpy.kron(squares, numpy.ones((side, side))), side, constant_values=255)
    image = Image.fromarray(texture.astype(numpy.uint8))
    camera = numpy.array([[800, 0, 319.5], [0, 800, 239.5], [0, 0, 1]])
    to_board = numpy.array(
        [[square / side, 0, -5 * square - square], [0, square / side, -3.5 * square - square], [0, 0, 1]]
    )
    (folder / "boards").mkdir()
    for view, (tilt, turn) in enumerate(VIEWS):
        turned = rotation(tilt, turn)
        plane = camera @ numpy.column_stack([turned[:, 0], turned[:, 1], [0.01 * view - 0.03, 0.01, 0.45]]) @ to_board
        back = numpy.linalg.inv(plane)
        back /= back[2, 2]
        seen = image.transform(
            (640, 480), Image.Transform.PERSPECTIVE, back.flatten()[:8], Image.Resampling.BICUBIC, fillcolor=200
        )
        seen.save(folder / "boards" / f"{view}.jpg", quality=95)
    for name, view in (("a", 0), ("b", 1), ("c", 2)):
        shutil.copy(folder / "boards" / f"{view}.jpg", folder / f"{name}.jpg")


def points(folder, throng):
    """corners.csv of a lens without distortion; gcp.csv and seen.csv of cameras that look straight down."""
    lines = ["image,i,X,Y,Z,u,v"]
    for view, (tilt, turn) in enumerate(VIEWS + [(0.7, 0), (0, 0.5), (-0.7, 0.2)]):
        turned = rotation(tilt, turn)
        for i in range(48):
            x, y = 0.15 * (i % 8 - 3.5), 0.15 * (i // 8 - 2.5)
            seen = turned @ [x, y, 0] + [0, 0, 1.6]
            lines.append(f"v{view},{i},{x},{y},0,{1500 * seen[0] / seen[2] + 961},{1500 * seen[1] / seen[2] + 538}")
    (folder / "corners.csv").write_text("\n".join(lines) + "\n")
    ground = {f"p{i}": (2.5 * (i % 5) - 5, 2 * (i // 5) - 3, 0.4 * (i * 7 % 5)) for i in range(20)}
    (folder / "gcp.csv").write_text("point,X,Y,Z\n" + "".join(f"{p},{x},{y},{z}\n" for p, (x, y, z) in ground.items()))
    lines = ["image,point,u,v"]
    for image, (cx, cy, cz) in {"a": (0, 0, 25), "b": (4, 1, 26), "c": (-3, 2, 24)}.items():
        for point, (x, y, z) in ground.items():
            lines.append(f"{image},{point},{1500 * (x - cx) / (cz - z) + 961},{1500 * (cy - y) / (cz - z) + 538}")
    (folder / "seen.csv").write_text("\n".join(lines) + "\n")


def models(folder, throng, names):
    """Rigged models made of boxes."""
    (folder / "man.gltf").write_text(box_man())
    for name in names:
        write_json(folder / f"{name}.json", {"name": name, "model": "man.gltf", "height_m": 1.7, "license": "CC0-1.0"})


def characters(folder, throng):
    """guide.json and robot.json."""
    models(folder, throng, ["guide", "robot"])


def character_library(folder, throng):
    """A library of one character."""
    models(folder, throng, ["walker"])
    command = [throng, "people", "import", "walker.json", "-o", "people"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return folder / "people"


def two_jobs(folder, throng):
    """jobs/*.json"""
    (folder / "jobs").mkdir()
    for seed in (1, 2):
        write_json(folder / "jobs" / f"{seed}.json", {**SMALL_JOB, "seed": seed})


def menge_project(folder, throng):
    """4square.xml: the square of the shipped scenarios as a project of Menge."""
    for name in ("square_scene.xml", "nearest_exit_behavior.xml"):
        shutil.copy(ROOT / "scenarios" / "city_square" / name, folder)
    (folder / "4square.xml").write_text(
        '<Project scene="square_scene.xml" behavior="nearest_exit_behavior.xml" model="orca" duration="20" random="7"/>\n'
    )


def recipe_files(folder, throng):
    """Files that the jobs of docs/recipes.md name: camera.json, walk.csv, and the Menge files of mine/hall.json."""
    points(folder, throng)
    command = [throng, "calibrate", "intrinsics", "--points", "corners.csv", "--size", "1920x1080", "--lens", "pinhole"]
    subprocess.run([*command, "-o", "camera.json"], cwd=folder, check=True, capture_output=True)
    rows = [f"{person},{frame},{frame / 16 - 5},{person}" for person in range(4) for frame in range(160)]
    (folder / "walk.csv").write_text("person,frame,x,y\n" + "\n".join(rows) + "\n")
    (folder / "mine").mkdir(exist_ok=True)
    (folder / "mine" / "scene.xml").write_text(HALL_SCENE)
    (folder / "mine" / "behavior.xml").write_text(HALL_BEHAVIOR)


HALL_SCENE = """<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/>
  <Common time_step="0.1"/>
  <AgentProfile name="adult"><Common r="0.2" max_speed="2" pref_speed="1.3"/><ORCA tau="3" tauObst="0.15"/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="adult"/><StateSelector type="const" name="Walk"/>
    <Generator type="rect_grid" anchor_x="0" anchor_y="0" offset_x="1" offset_y="1" count_x="4" count_y="4"/>
  </AgentGroup>
</Experiment>
"""
HALL_BEHAVIOR = """<BFSM>
  <GoalSet id="1"><Goal id="0" type="circle" x="25" y="0" radius="2"/></GoalSet>
  <State name="Walk" final="1"><GoalSelector type="nearest" goal_set="1"/><VelComponent type="goal"/></State>
</BFSM>
"""
