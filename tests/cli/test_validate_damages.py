"""`throng validate` believes no manifest: a dataset with everything is damaged in one way after the other, with its
hashes put right each time (damages/), and the damage is found; the dataset itself is not found fault with.

usage: test_validate_damages.py THRONG    damages for every third rule of validate, and some of runs; with $THRONG_LONG, all"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import damages
import damages.runner
from sound_jobs import GEOMETRY


def camera(**more):
    return {"width": 384, "height": 240, "hfov_deg": 62, **more}


JOB = {
    "name": "damages",
    "scenario": "city_square/nearest_exit",
    "seed": 5,
    "runs": 2,
    "crowd": {"agents": 130, "model": "orca"},
    "capture": {"rate_hz": 2, "from_s": 29, "to_s": 31},
    "drones": [
        {"id": "d1", "start": [8, -3, 15], "camera": camera(yaw_deg=90, pitch_deg=-38)},
        {
            "id": "d1_lens",
            "start": [-8, -3, 15],
            "camera": camera(yaw_deg=60, pitch_deg=-38, model="brown_conrady", distortion={"k1": -0.2, "k2": 0.05}),
        },
        {
            "id": "d2",
            "start": [4, 12, 15],
            "guidance": {"policy": "orbit", "center": [-4, 0], "radius_m": 14, "speed_mps": 2},
            "camera": camera(yaw_deg=180, pitch_deg=-42),
        },
    ],
    "outputs": {
        "annotations": GEOMETRY,
        "previews": 1,
        "fields": {"cells_m": [2]},
        "counts": {
            "zones": [{"id": "yard", "corners": [[-12, -12], [12, -12], [12, 14], [-12, 14]]}],
            "lines": [{"id": "middle", "start": [0, -20], "end": [0, 20]}],
        },
        "formats": ["coco", "mot", "yolo-detect", "kitti", "visdrone-mot", "table"],
    },
}
# A street of cars, and a lens.
VEHICLES_JOB = {
    "name": "vehicle damages",
    "scenario": "stadium_exit/everyday",
    "seed": 6,
    "crowd": {"agents": 150},
    "capture": {"rate_hz": 1, "from_s": 5, "to_s": 8},
    "drones": [
        {"id": "d1", "start": [-10, -58, 20], "camera": camera(yaw_deg=-100, pitch_deg=-32)},
        {
            "id": "d2",
            "start": [-36, -60, 16],
            "camera": camera(yaw_deg=-90, pitch_deg=-35, model="brown_conrady", distortion={"k1": -0.2, "k2": 0.05}),
        },
    ],
    "outputs": {"annotations": GEOMETRY, "formats": ["visdrone-mot", "kitti", "uavdt"]},
}
# A fire and people who flee from it.
HAZARDS_JOB = {
    "name": "hazard damages",
    "scenario": "city_square/emergency",
    "seed": 7,
    "environment": {"smoke": 0.7},
    "crowd": {"agents": 150},
    "capture": {"rate_hz": 1, "from_s": 5, "to_s": 20},
    "drones": [{"id": "d1", "start": [20, -18, 26], "camera": camera(yaw_deg=90, pitch_deg=-50)}],
    "outputs": {"annotations": ["coco", "hazards", "hazard_opacity", "depth"]},
}
# Of two people with all that belongs to them, and of places that little else depends on, nothing else tells. Flow is
# taken over 4 s, and these images span 2 s. Nothing tells the ground behind a person who is painted over, nor the states of people who are never
# seen and walk as the others do, nor the sex of people where nobody wears women's clothes.
NOT_FOUND = {
    "attributes of two people exchanged",
    "everybody male",
    "field one cell off",
    "flow of exits doubled",
    "picture without somebody",
    "unseen people in other states",
}
# Nobody of this job is in a group, and fewer than a quarter have escaped.
NOT_POSSIBLE = {"groups moved by one", "escape percentiles 20 percent less"}

# A damage that each rule of validate finds.
ONE_PER_RULE = {
    "actions": "two motions at once",
    "area-is-mask": "amodal masks moved",
    "attributes": "sex of one person",
    "bones": "elbows and wrists of one person exchanged",
    "box-3d": "all places 50 cm higher",
    "box-is-mask-bounds": "boxes 2 px to the right",
    "camera": "calibration file of another focal length",
    "category": "categories exchanged",
    "colors-are-clothes": "red and blue exchanged in all pictures",
    "counts": "two people exchanged in one frame",
    "density-is-heads": "density map 2 px off",
    "density-sum": "density maps 10 percent more",
    "depth": "depth of one person 1 m more",
    "zone-counts": "count of visible people one more",
    "depth-agrees": "depth of buildings in one picture",
    "depth-of-buildings": "depth of buildings in one picture",
    "depth-of-ground": "depth 1 percent more",
    "environment": "sun on the other side",
    "difficulty": "contrasts doubled",
    "flow-occlusion": "occlusion inverted",
    "exit-polygons": "door 3 px off in one picture",
    "exits": "exits of people exchanged",
    "fields": "fields turned by 180 degrees",
    "flight": "gimbal yaw with the other sign",
    "flow": "flow of the last frame",
    "flow-leads-to-boxes": "flow of people zero",
    "flow-of-keypoints": "flow of people 1 px off everywhere",
    "flow-of-still": "flow of still pixels zero",
    "formats": "amodal mask is visible mask",
    "head": "head of one person off",
    "heading-is-body": "headings are of velocity reversed for those who stand",
    "heading-is-motion": "velocities reversed",
    "hidden-box": "hidden boxes moved",
    "hidden-by-nearer": "amodal mask is its box",
    "ids": "runs of tracks exchanged",
    "ids-agree": "ids of two buildings exchanged",
    "image": "picture of lower quality",
    "heads": "head visibility inverted",
    "image-brightness": "picture half as bright",
    "image-colors": "red and blue exchanged",
    "image-is-labels": "pictures of two frames exchanged",
    "instances-are-masks": "ids of people one more",
    "job": "sensor record says noise",
    "keypoints": "visible keypoints called hidden",
    "keypoints-in-box": "box 3d 30 cm off",
    "lookalikes": "lookalike of other colors",
    "metrics": "metrics of two runs exchanged",
    "nobody-left-out": "hidden people left out",
    "normals-are-surface": "normals turned by 20 degrees",
    "normals-face-camera": "normals of people flipped",
    "one-instant": "velocity of one person reversed",
    "occluders": "occluders are others",
    "parts": "parts 2 px off",
    "parts-at-keypoints": "parts left and right exchanged",
    "position": "position axes exchanged",
    "previews": "preview of another frame",
    "scene-flow": "scene flow of one person zero",
    "schema": "two people exchanged in one frame",
    "skeletons": "toes are heels",
    "semantic": "semantic people called umbrellas",
    "events": "events 30 m off",
    "sensors": "sensor columns vx and vy exchanged",
    "state": "velocities in km per h",
    "time": "times one frame late",
    "trajectories": "trajectories 10 cm off",
    "truncation": "truncation doubled",
    "velocity-is-motion": "velocities 5 percent too high",
    "visibility-is-ratio": "visibility inverted",
    "visible-in-amodal": "amodal box 4 px off",
}


def dataset_of(throng, job, folder):
    """A dataset that `throng validate` does not find fault with."""
    folder.mkdir(parents=True)
    file = folder / "job.json"
    file.write_text(json.dumps(job))
    subprocess.run([throng, "run", file, "-o", folder / "out"], check=True, capture_output=True, timeout=300)
    dataset = folder / "out" / "dataset"
    intact = subprocess.run([throng, "validate", dataset], capture_output=True, text=True, check=False)
    assert intact.returncode == 0, intact.stdout
    return dataset


def rules_that_find(throng, job, names, folder):
    """{damage: rules that find it}; ["not possible"] where the dataset has nobody or nothing of that kind."""
    dataset = dataset_of(throng, job, folder)

    def run(name):
        with tempfile.TemporaryDirectory(dir=folder) as place:
            try:
                code, lines = damages.runner.run(throng, dataset, place, name)
            except (AssertionError, StopIteration):
                return name, ["not possible"]
        assert code in (0, 2), (name, code, lines[-3:])
        # That exports are no longer those of the records would find nearly everything.
        told = [line for line in lines if line.endswith("]")]
        if not name.startswith("formats"):
            told = [line for line in told if not line.startswith("formats/")]
        return name, sorted({line[line.rindex("[") + 1 : -1] for line in told})

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = dict(pool.map(run, names))
    for name, rules in results.items():
        assert rules != ["manifest"], f"{name}: the manifest was not put right"
        print(f"{name:62} {'found by ' + ', '.join(rules) if rules else 'NOT FOUND'}")
    return results


def test_damages(throng, job, names, folder, rule_of=None):
    """Each damage is found, and by its rule where rule_of names one. Whether a damage is possible and shows depends on who is
    in the images: what the people of one seed do not show, those of another one do."""
    rule_of = rule_of or {}
    expected = (set(names) - NOT_FOUND - NOT_POSSIBLE) | set(rule_of)
    found_by = {name: set() for name in names}
    for seed in (job["seed"], job["seed"] + 100):
        again = [name for name in names if not is_found(name, found_by[name], rule_of)]
        if not expected & set(again):
            break
        for name, rules in rules_that_find(throng, {**job, "seed": seed}, again, folder / str(seed)).items():
            found_by[name] |= set(rules) - {"not possible"}
    silent = {name: sorted(rule_of.get(name, [])) for name in expected if not is_found(name, found_by[name], rule_of)}
    print(f"found {sum(map(bool, found_by.values()))} of {len(names)}")
    assert not silent, f"not found by the rules of either seed: {silent}"


def is_found(name, rules, rule_of):
    return bool(rules) and rule_of.get(name, set()) <= rules


def test_everything(throng, folder):
    is_long = bool(os.environ.get("THRONG_LONG"))
    others = damages.OF_VEHICLES | damages.OF_HAZARDS
    rule_of = {}
    for rule in sorted(ONE_PER_RULE)[:: 1 if is_long else 3]:
        rule_of.setdefault(ONE_PER_RULE[rule], set()).add(rule)
    some_of_runs = sorted(damages.OF_RUNS)[::6]
    names = sorted(set(damages.KINDS) - others) if is_long else sorted({*rule_of, *some_of_runs})
    test_damages(throng, JOB, names, folder / "people", rule_of)
    some = slice(None, None, 1 if is_long else 3)
    test_damages(throng, VEHICLES_JOB, sorted(damages.OF_VEHICLES)[some], folder / "vehicles")
    test_damages(throng, HAZARDS_JOB, sorted(damages.OF_HAZARDS)[some], folder / "hazards")


if __name__ == "__main__":
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        test_everything(sys.argv[1], pathlib.Path(temporary))
    print(f"{time.monotonic() - started:.0f} s")
