"""Runs what docs/blueprint.md tells users to do, as it stands there, and the commands on scenarios."""

import json
import os
import pathlib
import re
import tempfile

from program import ROOT, THRONG, run, throng


def said(*words, **options):
    done = throng(*words, **options)
    return done.stdout + done.stderr


def test_ten_minutes(folder):
    text = (ROOT / "docs" / "blueprint.md").read_text()
    blueprints = re.findall(r"Save this as `([a-z_]+\.blueprint\.json)`.*?```json\n(.*?)```", text, re.S)
    assert [name for name, _ in blueprints] == ["yard.blueprint.json", "yard_fire.blueprint.json"]
    for name, content in blueprints:
        (folder / name).write_text(content)
    job = re.search(r'`(\{"scenario": "yard_fire".*?\})`', text).group(1)
    (folder / "job.json").write_text(job)
    commands = [line for block in re.findall(r"```sh\n(.*?)```", text, re.S) for line in block.splitlines()]
    assert len(commands) == 5, commands
    variables = {"PATH": f"{folder}:{os.environ['PATH']}"}
    (folder / "throng").symlink_to(THRONG)
    for command in commands:
        run("bash", "-ec", command, cwd=folder, variables=variables)
    assert "<svg" in (folder / "yard.svg").read_text()
    assert list((folder / "my_scenarios").glob("plaza_5_*.json"))
    datasets = [path.parent for path in (folder / "out").rglob("manifest.json")]
    assert datasets, "a dataset"


def test_check_says_what_is_wrong(folder):
    scenario = json.loads((ROOT / "scenarios" / "bridge" / "everyday.blueprint.json").read_text())
    (folder / "good.blueprint.json").write_text(json.dumps(scenario))
    assert "0 errors" in said("scenario", "check", "good.blueprint.json", cwd=folder)
    throng("scenario", "make", "good.blueprint.json", "-o", "made", cwd=folder)
    assert "0 errors" in said("scenario", "check", "made/good.json", cwd=folder)
    scenario["drones"][0]["start"] = [-66, 20, 11.2]
    (folder / "bad.blueprint.json").write_text(json.dumps(scenario))
    message = said("scenario", "check", "bad.blueprint.json", cwd=folder, code=2)
    assert "/drones/0/start" in message and "remedy" in message, message


def test_a_plan_shows_the_ways_of_a_jobs_drones(folder):
    guidance = {"policy": "waypoints", "waypoints": [[-16, 10, 20], [-16, 4, 20], [-12, 4, 20]], "speed_mps": 4}
    job = {
        "scenario": "bridge/everyday",
        "capture": {"to_s": 10},
        "drones": [{"id": "scout", "start": [-20, 10, 20], "guidance": guidance}],
    }
    (folder / "plan_job.json").write_text(json.dumps(job))

    def path_segments(*arguments):
        throng("scenario", "plan", *arguments, "-o", "plan.svg", cwd=folder)
        svg = (folder / "plan.svg").read_text()
        # Lines in the color of drones; the scenario's own drone, not of the job, has one of one segment.
        lines = re.findall(r'<path style="fill:none;[^"]*stroke:rgb\(54\.9[^"]*" d="([^"]*)"', svg)
        return max(line.count(" L ") for line in lines)

    assert path_segments("plan_job.json") >= 3, "segments of the planned path"
    throng("simulate", "plan_job.json", "-o", "plan.h5", cwd=folder)
    assert path_segments("bridge/everyday", "--trace", "plan.h5") >= 3, "segments of the path flown"


def test_a_generated_place_in_a_job(folder):
    job = {"scenario": {"generate": {"kind": "street", "seed": 4, "people": 30}}, "capture": {"to_s": 5}}
    (folder / "job.json").write_text(json.dumps(job))
    throng("simulate", "job.json", "-o", "a.h5", cwd=folder)
    throng("simulate", "job.json", "-o", "b.h5", cwd=folder)
    assert (folder / "a.h5").stat().st_size == (folder / "b.h5").stat().st_size
    job["scenario"]["generate"]["kind"] = "moon"
    (folder / "job.json").write_text(json.dumps(job))
    message = said("simulate", "job.json", "-o", "c.h5", cwd=folder, code=2)
    assert "/scenario/generate/kind" in message and "campus" in message, message


def test_names_say_where_things_lie(_):
    axes = {"east": (0, 1), "west": (0, -1), "north": (1, 1), "south": (1, -1)}
    checked = 0
    for file in (ROOT / "scenarios").rglob("*.json"):
        scenario = json.loads(file.read_text())
        for thing in [*scenario.get("buildings", []), *scenario.get("exits", [])]:
            if "box" in thing:
                corners = [thing["box"][:2], thing["box"][2:]]
            else:
                corners = thing.get("footprint") or [thing["from"], thing["to"]]
            for word in set(thing.get("id", "").split("_")) & set(axes):
                axis, sign = axes[word]
                middle = sum(corner[axis] for corner in corners) / len(corners)
                assert sign * middle > 0, (file, thing["id"], corners)
                checked += 1
    assert checked > 100, checked


for test in [value for name, value in list(globals().items()) if name.startswith("test_")]:
    with tempfile.TemporaryDirectory() as temporary:
        test(pathlib.Path(temporary))
        print(test.__name__, "ok")
