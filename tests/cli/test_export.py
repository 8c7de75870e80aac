"""throng export: a dataset in every format, by the options of its job unless the command line has others."""
import filecmp
import json
import pathlib
import subprocess
import tempfile
import unittest

from program import THRONG, throng, write_json


DRONE = {"camera": {"width": 160, "height": 100, "hfov_deg": 80, "pitch_deg": -40, "yaw_deg": -90}}
# Their layouts have no place for splits.
WITHOUT_SPLITS = {"depth-exr", "flow-flo"}


def files_of(folder):
    return {str(path.relative_to(folder)): path for path in pathlib.Path(folder).rglob("*") if path.is_file()}


def differing_files(left, right):
    """Paths that only one of two folders has, or with different content."""
    mine, theirs = files_of(left), files_of(right)
    same = {name for name in mine.keys() & theirs.keys() if filecmp.cmp(mine[name], theirs[name], shallow=False)}
    return sorted((mine.keys() | theirs.keys()) - same)


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.formats = [line.split()[0] for line in throng("export", "--list").stdout.splitlines()]
        schema = json.loads(throng("schema", "job").stdout)["properties"]["outputs"]["properties"]
        job = {
            "name": "every format",
            "scenario": "city_square/nearest_exit",
            "seed": 5,
            "runs": 3,
            "drones": [dict(DRONE, id="d1", start=[-24, -6, 14]), dict(DRONE, id="d2", start=[-24, -10, 14])],
            "capture": {"rate_hz": 1, "from_s": 6, "to_s": 7},
            "outputs": {
                "annotations": schema["annotations"]["items"]["enum"],
                "formats": cls.formats,
                "splits": {"train_runs": [1], "val_runs": [0], "test_runs": [2]},
                "filters": {"min_height_px": 4},
                "classes": {"by": "sex", "names": ["female=woman"]},
            },
        }
        file = write_json(cls.base / "job.json", job)
        throng("run", file, "-o", cls.base / "out")
        cls.dataset = cls.base / "out/dataset"

    def export(self, name, *options):
        out = self.base / name
        done = throng("export", self.dataset, "-o", out, "--formats", ",".join(self.formats), *options)
        return out, done.stderr

    def test_a_full_disk_is_named(self):
        room = self.base / "room"
        room.mkdir()
        script = 'mount -t tmpfs -o size=60k none "$0" || exit 77; exec "$@"'
        for name in ("voc", "yolo-detect", "mcap"):
            export = [THRONG, "export", self.dataset, "--formats", name, "-o", room / "out"]
            done = subprocess.run(
                ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script, *map(str, [room, *export])],
                capture_output=True,
                text=True,
                timeout=300,
            )
            if done.returncode == 77 or "unshare" in done.stderr:
                self.skipTest("no right to mount")
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("No space left on device", done.stderr)

    def test_an_export_has_the_splits_filters_and_classes_of_the_job(self):
        out, said = self.export("same")
        self.assertIn("splits: train run001; val run000; test run002", said)
        for name in self.formats:
            with self.subTest(name):
                self.assertEqual(differing_files(out / name, self.dataset / "formats" / name), [])

    def test_classes_of_people_have_colors_of_their_own_in_panoptic_files(self):
        file = self.dataset / "formats/coco-panoptic/panoptic_coco_categories.json"
        categories = json.loads(file.read_text())
        self.assertEqual([category["name"] for category in categories[:2]], ["woman", "male"])
        self.assertEqual(len({tuple(category["color"]) for category in categories}), len(categories))

    def test_options_replace_those_of_the_job(self):
        out, said = self.export("others", "--split", "train=1", "--min-height", "0", "--classes", "none")
        self.assertNotIn("splits:", said)
        unchanged = {name for name in self.formats if not differing_files(out / name, self.dataset / "formats" / name)}
        self.assertEqual(unchanged, WITHOUT_SPLITS)
        categories = json.loads((out / "coco/annotations/instances_train.json").read_text())["categories"]
        self.assertEqual([category["name"] for category in categories][:1], ["person"])

    def test_wrong_options_are_named(self):
        for options, expected in (
            (["-o", "none", "--formats", "docx"], "yolo-detect"),
            (["-o", "none", "--formats", "mot", "--split", "val=run007"], "one of: run000, run001, run002"),
            (["-o", self.dataset, "--formats", "mot"], "exists"),
        ):
            done = throng("export", self.dataset, *options, code=2)
            self.assertIn(expected, done.stderr)


if __name__ == "__main__":
    unittest.main()
