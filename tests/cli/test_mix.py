"""A job of several scenarios, with drones that aim at people: locally, over HTTP, in Python.
usage: test_mix.py THRONG"""
import json
import os
import pathlib
import sys
import tempfile
import unittest

import program
from program import ROOT, THRONG
from service import ask, send, start_service

sys.path.insert(0, str(ROOT / "python"))
import throng  # noqa: E402

JOB = {
    "scenario": [
        "city_square/nearest_exit",
        {"id": "campus/everyday", "agents": 700},
        {"generate": {"kind": "plaza", "size_m": 40}},
    ],
    "runs": 5,
    "quality": "draft",
    "crowd": {"agents": 40},
    "drones": [
        {"id": "view", "aim": {}, "camera": {"width": 160, "height": 120, "pitch_deg": {"uniform": [-80, -30]}}}
    ],
    "randomize": {"drones.0.aim.height_m": {"uniform": [9, 14]}},
    "capture": {"from_s": 0, "to_s": 0.5, "rate_hz": 2},
    "outputs": {"previews": 0, "splits": {"train": 0.5, "val": 0.5, "test_scenarios": ["campus/everyday"]}},
}
PLACES = [
    "city_square/nearest_exit",
    "campus/everyday",
    "generated/plaza",
    "city_square/nearest_exit",
    "campus/everyday",
]


class Mix(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.folder / "job.json").write_text(json.dumps(JOB))
        cls.run_throng("run", "job.json", "-o", "out")
        cls.data = throng.Dataset(cls.folder / "out" / "dataset")

    @classmethod
    def run_throng(cls, *words, code=0):
        done = program.throng(*words, cwd=cls.folder, code=code)
        return done.stdout + done.stderr

    def manifest(self):
        return json.loads((self.folder / "out/dataset/manifest.json").read_text())

    def card(self):
        return json.loads((self.folder / "out/dataset/dataset.json").read_text())

    def test_runs_alternate_among_the_scenarios(self):
        for run, place in zip(self.manifest()["runs"], PLACES, strict=True):
            self.assertTrue(run["scenario"].startswith(place), run)
            self.assertEqual(run["drawn"]["scenario"], run["scenario"])
            self.assertEqual(self.card()["scenarios"][run["run"]], run["scenario"])
            trace = throng.Trace(self.folder / "out/work" / run["run"] / "trace.h5")
            self.assertEqual(trace.scenario, run["scenario"])

    def test_drones_look_at_people_at_the_sampled_height(self):
        heights = set()
        for frame in self.data:
            if frame.index > 0:
                continue
            self.assertGreater(len(frame.people), 0, f"{frame}: nobody in sight")
            height = frame.drawn["drones.0.aim.height_m"]
            self.assertAlmostEqual(float(frame.camera.center[2]), height, delta=0.3)
            heights.add(height)
            # Somebody is at the middle of the first image: the optical axis meets a person's chest.
            boxes = frame.people.boxes
            nearest = min(max(abs(x + w / 2 - 80) - w / 2, abs(y + h / 2 - 60) - h / 2) for x, y, w, h in boxes)
            self.assertLess(nearest, 6, f"{frame}")
        self.assertEqual(len(heights), JOB["runs"])

    def test_the_dataset_is_sound_and_split_by_place(self):
        self.run_throng("validate", "out/dataset")
        self.assertEqual(self.data.splits["test"].runs, ["run001", "run004"])
        parts = self.data.split(by="place", a=0.34, b=0.33, c=0.33)
        places = [{frame.place for frame in part} for part in parts.values()]
        self.assertEqual(sorted(len(each) for each in places), [1, 1, 1])
        self.assertEqual(len(set.union(*places)), 3)

    def test_one_run_is_simulated_and_rendered_alone(self):
        self.run_throng("simulate", "job.json", "--run", "1", "-o", "one.h5")
        self.assertIn("campus/everyday", json.dumps(throng.Trace(self.folder / "one.h5").scenario))
        self.run_throng("render", "job.json", "--trace", "one.h5", "-o", "one")
        self.assertTrue((self.folder / "one/dataset/images/run000/view/000000.jpg").exists())

    def test_check_looks_into_every_scenario(self):
        answer = json.loads(self.run_throng("check", "--json", "job.json"))
        self.assertEqual(answer["runs"], 5)
        job = {**JOB, "scenario": ["campus/everyday", "city_square/nearest_exti"]}
        (self.folder / "bad.json").write_text(json.dumps(job))
        said = self.run_throng("check", "bad.json", code=2)
        self.assertIn('did you mean "city_square/nearest_exit"?', said)
        job = {**JOB, "drones": [{"id": "view", "start": [0, 0, 1.0e-3]}]}
        (self.folder / "bad.json").write_text(json.dumps({**job, "randomize": {}}))
        said = self.run_throng("check", "bad.json", code=2)
        self.assertIn(" in campus/everyday", said)
        self.assertIn(" in city_square/nearest_exit", said)

    def test_the_service_makes_the_same_bytes(self):
        server, port = start_service(THRONG, self.folder / "data", cwd=self.folder)
        try:
            url = f"http://127.0.0.1:{port}"
            os.environ["THRONG_URL"] = url
            self.run_throng("submit", "job.json", "--fetch", "there.tar")
            there = throng.Dataset(self.folder / "there.tar")
            self.assertEqual([f.id for f in there], [f.id for f in self.data])
            for a, b in zip(there, self.data):
                self.assertEqual(a.record, b.record)
            jobs = ask(url + "/v1/jobs")["jobs"]
            plan = send(f"{url}/v1/jobs/{jobs[0]['id']}/plan")
            self.assertIn(b"<svg", plan.read())
        finally:
            server.terminate()
            server.wait()


if __name__ == "__main__":
    unittest.main()
