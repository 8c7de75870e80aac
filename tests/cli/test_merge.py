"""throng merge: datasets become one that is sound, with the images, people and splits of all of them."""
import csv
import hashlib
import json
import pathlib
import tempfile
import unittest

from program import made, throng

JOB = {
    "name": "part",
    "scenario": "city_square/nearest_exit",
    "seed": 1,
    "runs": 2,
    "crowd": {"agents": 60},
    "quality": "draft",
    "capture": {"rate_hz": 1, "from_s": 8, "to_s": 9},
    "drones": [
        {"id": "d1", "start": [8, -3, 15], "camera": {"width": 160, "height": 120, "yaw_deg": 90, "pitch_deg": -38}},
        {"id": "d2", "start": [0, 0, 22], "camera": {"width": 160, "height": 120, "pitch_deg": -60}},
    ],
    "outputs": {
        "annotations": ["coco", "actions", "counts", "difficulty", "events", "exits", "instances", "trajectories"],
        "formats": ["mot"],
        "previews": 1,
        "splits": {"train": 0.5, "val": 0.5},
    },
}
RUN_TRACKS = 1_000_000


class Merge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        one = made(cls.folder, JOB, "one") / "dataset"
        job = {**JOB, "seed": 7, "name": "other", "runs": 1, "scenario": "city_square/second_nearest"}
        two = made(cls.folder, job, "two") / "dataset"
        cls.parts = [one, two]
        cls.whole = cls.folder / "whole"
        done = throng("merge", one, two, "-o", cls.whole)
        cls.printed = done.stdout

    def test_the_result_is_sound(self):
        throng("validate", self.whole)
        self.assertIn("12 images of 3 runs with ", self.printed)

    def test_all_images_and_people_are_there_once(self):
        whole = coco(self.whole)
        images, annotations = [], []
        runs = 0
        for part in self.parts:
            labels = coco(part)
            for image in labels["images"]:
                run = f"run{int(image['run'][3:]) + runs:03}"
                images.append((run, image["camera_id"], image["frame"], image["camera"]))
            for person in labels["annotations"]:
                annotations.append((person["track_id"] + runs * RUN_TRACKS, person["bbox"], person["position"]))
            runs += len({image["run"] for image in labels["images"]})
        self.assertEqual([(i["run"], i["camera_id"], i["frame"], i["camera"]) for i in whole["images"]], images)
        self.assertEqual([(a["track_id"], a["bbox"], a["position"]) for a in whole["annotations"]], annotations)
        for ids in (
            [image["id"] for image in whole["images"]],
            [person["id"] for person in whole["annotations"]],
            [track["id"] for track in whole["tracks"]],
        ):
            self.assertEqual(len(ids), len(set(ids)))
        tracks = {track["id"] for track in whole["tracks"]}
        self.assertLessEqual({person["track_id"] for person in whole["annotations"]}, tracks)

    def test_files_are_those_of_the_parts_under_their_new_names(self):
        manifest = json.loads((self.whole / "manifest.json").read_text())
        for file in manifest["files"]:
            data = (self.whole / file["path"]).read_bytes()
            self.assertEqual((len(data), hashlib.sha256(data).hexdigest()), (file["bytes"], file["sha256"]), file)
        listed = {file["path"] for file in manifest["files"]} | {"manifest.json"}
        found = {str(f.relative_to(self.whole)) for f in self.whole.rglob("*") if f.is_file()}
        self.assertEqual(found, listed)
        for kind in ("images", "instances"):
            name = f"{kind}/run002/d2/000001" + (".jpg" if kind == "images" else ".png")
            own = name.replace("run002", "run000")
            self.assertEqual((self.whole / name).read_bytes(), (self.parts[1] / own).read_bytes())

    def test_tables_have_the_new_ids(self):
        with open(self.parts[1] / "actions/run000.csv", encoding="utf-8") as file:
            own = list(csv.DictReader(file))
        with open(self.whole / "actions/run002.csv", encoding="utf-8") as file:
            merged = list(csv.DictReader(file))
        self.assertGreater(len(own), 10)
        shifted = [{**row, "track_id": str(int(row["track_id"]) + 2 * RUN_TRACKS)} for row in own]
        for row in shifted:
            if row["other"].isdigit():
                row["other"] = str(int(row["other"]) + 2 * RUN_TRACKS)
        self.assertEqual(merged, shifted)
        own = json.loads((self.parts[1] / "trajectories/run000.json").read_text())["track_ids"]
        merged = json.loads((self.whole / "trajectories/run002.json").read_text())["track_ids"]
        self.assertEqual(merged, [track + 2 * RUN_TRACKS for track in own])

    def test_splits_stay_and_figures_are_joined(self):
        parts = [json.loads((part / "dataset.json").read_text())["splits"] for part in self.parts]
        expected = {}
        for splits, first in zip(parts, (0, 2)):
            for name, runs in splits.items():
                expected.setdefault(name, []).extend(f"run{int(run[3:]) + first:03}" for run in runs)
        self.assertEqual(json.loads((self.whole / "dataset.json").read_text())["splits"], expected)
        runs = json.loads((self.whole / "metrics.json").read_text())["runs"]
        self.assertEqual([run["run"] for run in runs], ["run000", "run001", "run002"])
        self.assertEqual(len({run["seed"] for run in runs}), 3)
        throng("export", self.whole, "-o", self.folder / "mot", "--formats", "mot")

    def test_a_merged_dataset_can_be_merged(self):
        again = self.folder / "again"
        throng("merge", self.whole, self.parts[0], "-o", again)
        throng("validate", again)

    def refused(self, expected, *arguments):
        done = throng("merge", *arguments, "-o", self.folder / "refused", code=2)
        self.assertIn(expected, done.stderr)
        self.assertFalse((self.folder / "refused").exists())

    def test_datasets_that_do_not_fit_are_refused(self):
        one = self.parts[0]
        job = {**JOB, "capture": {"rate_hz": 2, "from_s": 8, "to_s": 9}, "runs": 1}
        other = made(self.folder, job, "sizes") / "dataset"
        self.refused('manifest.json: /job/capture: found {"from_s": 8', one, other)
        self.refused("found 1 dataset, expected two or more", one)
        self.refused("nowhere: found no such folder, expected the folder of a finished dataset", one, "nowhere")
        self.refused(f"expected a finished dataset, as {self.folder}/one/dataset", self.folder / "one", one)
        done = throng("merge", *self.parts, "-o", self.whole, code=2)
        self.assertIn("found something that is there already, expected a new folder", done.stderr)
        (self.folder / "two/dataset/images/run000/d1/000000.jpg").rename(self.folder / "gone.jpg")
        self.addCleanup((self.folder / "gone.jpg").rename, self.folder / "two/dataset/images/run000/d1/000000.jpg")
        self.refused("000000.jpg: found no such file, expected a file of the manifest", *self.parts)


def coco(dataset):
    return json.loads((dataset / "annotations/instances.json").read_text())


unittest.main()
