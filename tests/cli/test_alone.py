"""A trace is enough: `throng metrics`, `report` and `render` where the scenario's folder is gone. `simulate` without
drones. `throng schema`.
usage: test_alone.py THRONG"""
import json
import pathlib
import unittest

from program import FolderTest, printed, write_json

YARD = {
    "$schema": "schemas/blueprint.schema.json",
    "name": "Yard",
    "ground": {"min": [-30, -20], "max": [30, 20], "material": "pavers"},
    "inside": {"min": [-16, -12], "max": [16, 12]},
    "exits": [{"id": "east", "from": [15, -2], "to": [15, 2]}],
    "buildings": [
        {"id": "north", "box": [-15, 11, 15, 11.5], "height_m": 3},
        {"id": "south", "box": [-15, -11.5, 15, -11], "height_m": 3},
        {"id": "west", "box": [-15.5, -11, -15, 11], "height_m": 3},
        {"id": "ne", "box": [15, 2, 15.5, 11], "height_m": 3},
        {"id": "se", "box": [15, -11, 15.5, -2], "height_m": 3},
    ],
    "people": {
        "pre_movement_s": {"uniform": [1, 3]},
        "groups": [{"doing": "wait", "box": [-10, -8, 8, 8], "count": 12}],
    },
    "disasters": [
        {"kind": "fire", "position": [-14, 10], "start_s": 1, "radius_m": 0.4, "max_radius_m": 0.4, "noticed_m": 100}
    ],
}
JOB = {
    "$schema": "schemas/job.schema.json",
    "scenario": "yard",
    "quality": "draft",
    "drones": [{"id": "d1", "start": [0, -10, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": {"from_s": 1, "to_s": 2, "rate_hz": 1},
}


class Alone(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder / "yard.blueprint.json").write_text(json.dumps(YARD))

    def throng(self, *words, scenarios="mine", code=0):
        variables = {"THRONG_SCENARIOS": self.folder / scenarios}
        return printed(*words, cwd=self.folder, variables=variables, code=code)

    def simulated(self, job=JOB):
        self.throng("scenario", "make", "yard.blueprint.json", "-o", "mine")
        (self.folder / "job.json").write_text(json.dumps(job))
        self.throng("simulate", "job.json", "-o", "run.h5")

    def test_a_trace_needs_no_scenario(self):
        self.simulated()
        there = self.throng("metrics", "run.h5")
        self.assertGreater(json.loads(there)["people"], 0)
        (self.folder / "gone").mkdir()
        self.assertEqual(self.throng("metrics", "run.h5", scenarios="gone"), there)
        self.throng("report", "run.h5", "-o", "report.html", scenarios="gone")
        self.assertIn("<html", (self.folder / "report.html").read_text())
        self.throng("render", "job.json", "--trace", "run.h5", "-o", "out", scenarios="gone")
        images = list((self.folder / "out" / "dataset").rglob("*.jpg")) + list(
            (self.folder / "out" / "dataset").rglob("*.png")
        )
        self.assertTrue(images)
        self.throng("report", "out", "-o", "again.html", scenarios="gone")

    def test_an_exit_with_a_capacity_passes_no_more(self):
        yard = json.loads(json.dumps(YARD))
        yard["exits"][0]["capacity"] = {"device": "full_height_turnstile"}
        yard["doors"] = [{"id": "line", "from": [-6, -11], "to": [-6, 11], "capacity": {"per_s": 100}}]
        write_json(self.folder / "yard.blueprint.json", yard)
        self.simulated({"scenario": "yard", "capture": {"to_s": 60}})
        exit = json.loads(self.throng("metrics", "run.h5"))["exits"][0]
        self.assertEqual(exit["capacity_source"], "1 x full_height_turnstile")
        self.assertAlmostEqual(exit["capacity_per_s"], 20 / 60)
        gaps = exit["gaps"]["list_s"]
        self.assertGreater(len(gaps), 8, "most of the 12 have left")
        # Somebody who is admitted needs up to a second to the line.
        self.assertGreater(min(gaps), 1.5)
        self.assertGreater(sum(gaps), 3 * (len(gaps) - 1))
        self.throng("report", "run.h5", "-o", "report.html")
        self.assertIn("0.33 (1 x full_height_turnstile)", (self.folder / "report.html").read_text())

    def test_no_drone_is_needed_to_simulate(self):
        self.simulated({"scenario": "yard", "capture": {"to_s": 2}})
        self.assertGreater(json.loads(self.throng("metrics", "run.h5"))["people"], 0)
        self.assertIn("none without drones", self.throng("check", "job.json"))
        render = self.throng("render", "job.json", "--trace", "run.h5", "-o", "out", code=2)
        self.assertIn("/drones: found nothing, expected a drone, whose camera renders", render)

    def test_a_scenario_of_a_hazard_is_sound(self):
        self.throng("scenario", "make", "yard.blueprint.json", "-o", "mine")
        self.assertIn("0 errors, 0 warnings", self.throng("scenario", "check", "mine/yard.json"))

    def test_check_knows_the_goals_that_drones_move(self):
        self.throng("scenario", "make", "yard.blueprint.json", "-o", "mine")
        drone = {**JOB["drones"][0], "moves_goal": [99, 7], "guidance": {"policy": "hover", "beacon": True}}
        (self.folder / "job.json").write_text(json.dumps({**JOB, "drones": [drone]}))
        self.assertIn("/drones/0/moves_goal", self.throng("check", "job.json", code=2))
        drone["moves_goal"] = [3, 0]
        (self.folder / "job.json").write_text(json.dumps({**JOB, "drones": [drone]}))
        self.throng("check", "job.json")

    def test_schemas(self):
        names = self.throng("schema").split()
        self.assertIn("blueprint", names)
        files = self.throng("schema", "-o", "schemas").split()
        self.assertEqual([pathlib.Path(file).name for file in files], [f"{name}.schema.json" for name in names])
        for name in names:
            text = self.throng("schema", name)
            self.assertEqual(json.loads(text)["type"], "object")
            self.assertEqual(text, (self.folder / "schemas" / f"{name}.schema.json").read_text())
        self.assertIn("did you mean", self.throng("schema", "bluprint", code=2))


if __name__ == "__main__":
    unittest.main()
