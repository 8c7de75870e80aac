"""The real program, end to end: what a user does, and what must hold afterwards."""
import filecmp
import io
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import unittest
import urllib.error

from check_dataset import check_dataset
from program import THRONG, FolderTest, made, run, throng, write_json
from service import ask, send, wait_until


JOB = {
    "name": "end to end",
    "scenario": "city_square/nearest_exit",
    "seed": 3,
    "runs": 2,
    "drones": [
        {
            "id": "d1",
            "start": [-24, -6, 20],
            "guidance": {"policy": "waypoints", "waypoints": [[-24, 0, 20], [-20, 4, 22]], "speed_mps": 2},
            "camera": {"width": 320, "height": 200, "hfov_deg": 80, "pitch_deg": -40, "yaw_deg": -90},
        }
    ],
    "capture": {"rate_hz": 2, "from_s": 1, "to_s": 5},
    "outputs": {
        "annotations": ["coco", "keypoints", "density", "exits", "depth", "instances", "flow"],
        "formats": """
            coco coco-keypoints coco-panoptic yolo-detect yolo-segment yolo-pose mot mots visdrone-det
            visdrone-mot""".split(),
        "splits": {"val_runs": [1]},
        "filters": {"min_visibility": 0.1},
    },
}


def files_of(folder):
    return {str(p.relative_to(folder)): p for p in pathlib.Path(folder).rglob("*") if p.is_file()}


class EndToEnd(FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.first = made(cls.base, JOB, "first")
        cls.job = cls.base / "first.json"
        cls.dataset = cls.first / "dataset"

    def assert_same_dataset(self, other):
        mine, theirs = files_of(self.dataset), files_of(other)
        self.assertEqual(sorted(mine), sorted(theirs))
        different = [name for name in mine if not filecmp.cmp(mine[name], theirs[name], shallow=False)]
        self.assertEqual(different, [])

    def bad_job(self, change, *expected):
        job = json.loads(json.dumps(JOB))
        change(job)
        path = write_json(self.base / "bad.json", job)
        result = throng("run", path, "-o", self.base / "never", code=2)
        for text in ("bad.json", *expected):
            self.assertIn(text, result.stderr)
        self.assertFalse((self.base / "never" / "dataset").exists())

    def test_dataset_is_consistent(self):
        frames, annotations = check_dataset(self.dataset)
        self.assertEqual(frames, 2 * 9)
        self.assertGreater(annotations, 500)

    def test_validation_agrees_and_notices_a_changed_byte(self):
        throng("validate", self.dataset)
        damaged = self.base / "damaged"
        shutil.copytree(self.dataset, damaged)
        picture = damaged / "images/run001/d1/000003.jpg"
        picture.write_bytes(picture.read_bytes()[:-1] + b"x")
        done = throng("validate", damaged, code=2)
        self.assertIn("images/run001/d1/000003.jpg: its SHA-256", done.stdout)

    def test_snippets_of_the_readme_run(self):
        text = (self.dataset / "README.md").read_text()
        snippets = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertEqual(len(snippets), 3)
        for snippet in snippets:
            run(sys.executable, "-c", snippet, cwd=self.dataset)

    def test_dataset_json_counts_what_is_there(self):
        card = json.loads((self.dataset / "dataset.json").read_text())
        coco = json.loads((self.dataset / "annotations/instances.json").read_text())
        statistics = card["statistics"]
        self.assertEqual(statistics["images"], len(coco["images"]))
        self.assertEqual(sum(statistics["annotations_by_height_px"].values()), len(coco["annotations"]))
        self.assertEqual(card["splits"], {"train": ["run000"], "val": ["run001"]})
        for folder in card["formats"].values():
            self.assertTrue((self.dataset / folder).is_dir())

    def test_same_seed_gives_the_same_bytes_whatever_the_number_of_workers(self):
        again = self.base / "again"
        throng("run", self.job, "-o", again, "--workers", 1)
        self.assert_same_dataset(again / "dataset")
        for name in ("run000", "run001"):
            self.assertTrue(
                filecmp.cmp(self.first / "work" / name / "trace.h5", again / "work" / name / "trace.h5", shallow=False)
            )

    def test_another_seed_gives_other_pictures(self):
        job = dict(JOB, seed=4, runs=1, outputs={})
        made(self.base, job, "other")
        name = "images/run000/d1/000006.jpg"
        self.assertFalse(filecmp.cmp(self.dataset / name, self.base / "other/dataset" / name, shallow=False))

    def test_exposure_and_noise_follow_the_light_unless_given(self):
        records = {}
        for name, sensor in (("default", {}), ("given", {"metering": "light", "iso": 0})):
            job = json.loads(json.dumps(JOB))
            job.update(
                runs=1,
                capture={"rate_hz": 1, "from_s": 1, "to_s": 1},
                outputs={},
                environment={"time_of_day": "23:00"},
                crowd={"agents": 20},
            )
            job["drones"][0]["camera"]["sensor"] = sensor
            night = made(self.base, job, f"night_{name}")
            coco = json.loads((night / "dataset/annotations/instances.json").read_text())
            records[name] = coco["images"][0]["sensor"]
        self.assertEqual(records["default"]["iso"], 1600)
        self.assertNotAlmostEqual(records["default"]["exposure_gain"], 1, 2)
        self.assertEqual((records["given"]["iso"], records["given"]["exposure_gain"]), (0, 1))

    def test_simulate_then_render_is_the_same_as_run(self):
        trace = self.base / "alone.h5"
        throng("simulate", self.job, "--run", 1, "-o", trace)
        self.assertTrue(filecmp.cmp(trace, self.first / "work/run001/trace.h5", shallow=False))
        rendered = self.base / "rendered"
        throng("render", self.job, "--trace", trace, "-o", rendered)
        self.assertTrue(
            filecmp.cmp(
                self.dataset / "images/run001/d1/000006.jpg",
                rendered / "dataset/images/run000/d1/000006.jpg",
                shallow=False,
            )
        )
        check_dataset(rendered / "dataset")
        seeds = [
            json.loads((d / "manifest.json").read_text())["runs"][-1]["seed"]
            for d in (self.dataset, rendered / "dataset")
        ]
        self.assertEqual(*seeds, "the manifest names the seed of the trace that was drawn")

    def test_bad_jobs_name_file_pointer_found_and_expected(self):
        self.bad_job(lambda j: j["capture"].update(rate_hz=-1), "/capture/rate_hz", "-1")
        self.bad_job(lambda j: j.update(colour="red"), "/colour")
        self.bad_job(lambda j: j.update(scenario="atlantis"), "/scenario", "city_square/nearest_exit")
        self.bad_job(lambda j: j.update(crowd={"agents": 100000}), "/crowd/agents", "260")
        self.bad_job(lambda j: j["outputs"].update(formats=["mot", "docx"]), "/outputs/formats/1", "yolo-detect")
        self.bad_job(lambda j: j["outputs"]["splits"].update(test_runs=[2]), "/outputs/splits/test_runs/0", "0 to 1")
        self.bad_job(lambda j: j["drones"][0].update(airframe="brick"), "/drones/0/airframe", "f450")
        self.bad_job(
            lambda j: j["drones"][0]["guidance"].update(waypoints=[[25, 0, 3]]), "/drones/0/guidance/waypoints/0"
        )

    def test_unwritable_output_is_the_environments_fault(self):
        blocker = self.base / "file"
        blocker.write_text("not a folder")
        result = throng("run", self.job, "-o", blocker / "out", code=3)
        self.assertIn("file", result.stderr)

    def test_an_interrupt_cancels_and_a_second_run_resumes(self):
        out = self.base / "cancelled"
        # It cannot end before it is interrupted: one of its runs rests.
        process = subprocess.Popen(
            [THRONG, "run", str(self.job), "-o", str(out)],
            stderr=subprocess.PIPE,
            text=True,
            env=dict(os.environ, THRONG_FAULTS="slow:run001/trace:3600"),
        )
        wait_until((out / "work/run000/trace.h5").exists)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 130, errors)
        self.assertFalse((out / "dataset" / "manifest.json").exists())
        throng("run", self.job, "-o", out)
        self.assert_same_dataset(out / "dataset")

    def test_the_server_makes_the_same_bytes(self):
        url = self.serve()
        job = url + "/v1/jobs/" + ask(url + "/v1/jobs", JOB)["id"]
        wait_until(lambda: ask(job)["state"] not in ("queued", "running"))
        self.assertEqual(ask(job)["state"], "succeeded")
        unpacked = self.folder / "unpacked"
        with tarfile.open(fileobj=io.BytesIO(send(job + "/archive").read())) as archive:
            archive.extractall(unpacked)
        (root,) = unpacked.iterdir()
        self.assert_same_dataset(root)
        self.assertEqual(len(ask(job + "/metrics")["runs"]), 2)

    def test_server_answers_bad_jobs_with_pointers(self):
        with self.assertRaises(urllib.error.HTTPError) as caught:
            ask(self.serve() + "/v1/jobs", dict(JOB, runs=0, colour="red"))
        self.assertEqual(caught.exception.code, 400)
        pointers = {e["pointer"] for e in json.load(caught.exception)["errors"]}
        self.assertEqual(pointers, {"/runs", "/colour"})


if __name__ == "__main__":
    os.environ.setdefault("PYTHONDONTWRITEBYTECODE", "1")
    unittest.main(verbosity=2)
