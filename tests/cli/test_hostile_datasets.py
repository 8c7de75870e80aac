"""Datasets of strangers: names that lead out of the folder, and links, are refused by all that reads or writes them."""
import json
import os
import pathlib
import shutil
import tempfile
import unittest

from program import made, throng

JOB = {
    "name": "part",
    "scenario": "city_square/nearest_exit",
    "seed": 1,
    "crowd": {"agents": 60},
    "quality": "draft",
    "capture": {"rate_hz": 1, "from_s": 8, "to_s": 8},
    "drones": [
        {"id": "d1", "start": [8, -3, 15], "camera": {"width": 160, "height": 120, "yaw_deg": 90, "pitch_deg": -38}}
    ],
    "outputs": {"annotations": ["coco", "instances", "sensors", "trajectories"], "formats": ["mot"]},
}
HOSTILE = ("../stolen", "/tmp/throng-stolen", "a/../../stolen", "..", "", "a\\b", "a\nb")
FORMATS = "coco,mot,voc,kitti,yolo-detect,mcap,webdataset,coco-panoptic,jupedsim,table"


class HostileDatasets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.sound = made(cls.folder, JOB, "sound") / "dataset"

    def setUp(self):
        self.base = self.folder / self.id().rsplit(".", 1)[1]
        self.base.mkdir()
        self.dataset = self.base / "inner/dataset"
        self.secret = self.base / "secret.txt"
        self.secret.write_text("secret")
        self.renew()

    def renew(self):
        shutil.rmtree(self.base / "inner", ignore_errors=True)
        shutil.copytree(self.sound, self.dataset)

    def expect_refused_by_all(self, expected, but=()):
        """Every command refuses the dataset and writes nothing outside of its output."""
        before = sorted(self.base.rglob("*"))
        out = self.base / "inner/out"
        for command in (
            ["validate", self.dataset],
            ["export", self.dataset, "-o", out, "--formats", FORMATS],
            ["merge", self.dataset, self.sound, "-o", out],
            ["publish", self.dataset, "s3://bucket/prefix"],
        ):
            if command[0] in but:
                continue
            done = throng(*command, code=2)
            self.assertIn(expected, done.stdout + done.stderr, command[0])
            self.assertEqual(sorted(self.base.rglob("*")), before, command[0])
            self.assertFalse(pathlib.Path("/tmp/throng-stolen").exists())

    def change_manifest(self, change):
        file = self.dataset / "manifest.json"
        manifest = json.loads(file.read_text())
        change(manifest)
        file.write_text(json.dumps(manifest))

    def change_image(self, **fields):
        """Changes the records of images, which are one per line."""
        file = self.dataset / "annotations/instances.json"
        lines = file.read_text().split("\n")
        at = lines.index('"images":[') + 1
        record = json.loads(lines[at].rstrip(","))
        record.update(fields)
        lines[at] = json.dumps(record) + ("," if lines[at].endswith(",") else "")
        file.write_text("\n".join(lines))

    def test_paths_of_the_manifest(self):
        for path in HOSTILE:
            self.renew()
            self.change_manifest(lambda manifest: manifest["files"][0].update(path=path))
            self.expect_refused_by_all("/files/0/path: found")

    def test_runs_of_the_manifest(self):
        for run in (*HOSTILE, "run", "run00x", "run000/../../x"):
            self.renew()
            self.change_manifest(lambda manifest: manifest["runs"][0].update(run=run))
            self.expect_refused_by_all("/runs/0/run: found", but=["publish"])

    def test_drones_and_formats_of_the_job(self):
        for name in HOSTILE:
            self.renew()
            self.change_manifest(lambda manifest: manifest["job"]["drones"][0].update(id=name))
            self.expect_refused_by_all("/job/drones/0/id: found", but=["publish"])
            self.renew()
            self.change_manifest(lambda manifest: manifest["job"]["outputs"].update(formats=[name]))
            self.expect_refused_by_all("/job/outputs/formats/0: found", but=["publish"])

    def test_records_of_images(self):
        for field in ("file_name", "run", "camera_id"):
            for value in HOSTILE:
                self.renew()
                self.change_image(**{field: value})
                # Their hashes are wrong, too, which merge sees first.
                done = throng("validate", self.dataset, code=2)
                self.assertIn("instances.json", done.stdout + done.stderr)
                self.expect_refused_by_all("instances.json: line", but=["publish", "validate", "merge"])

    def test_links(self):
        images = next((self.dataset / "images").rglob("*.jpg")).relative_to(self.dataset)
        for linked, target in (
            (images, self.secret),
            (images.parent, self.base),
            (pathlib.Path("annotations"), "/etc"),
        ):
            self.renew()
            place = self.dataset / linked
            shutil.rmtree(place) if place.is_dir() else place.unlink()
            os.symlink(target, place)
            self.expect_refused_by_all("", but=["publish"])

    def test_a_link_to_the_whole_dataset_is_followed(self):
        link = self.base / "link"
        os.symlink(self.dataset, link)
        for command in (["validate", link], ["export", link, "-o", self.base / "out", "--formats", "mot"]):
            throng(*command)

    def test_merge_checks_hashes(self):
        image = next((self.dataset / "images").rglob("*.jpg"))
        image.write_bytes(image.read_bytes()[:-1] + b"x")
        done = throng("merge", self.dataset, self.sound, "-o", self.base / "inner/out", code=2)
        self.assertIn(f"{image}: found a file whose SHA-256 is not that of manifest.json", done.stderr)


if __name__ == "__main__":
    unittest.main()
