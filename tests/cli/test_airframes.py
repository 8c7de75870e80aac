"""throng airframes: the quadcopters that a job can name, and those that a user describes."""
import json
import pathlib
import unittest

from program import FolderTest, throng, write_json

ROBOTS = pathlib.Path(__file__).resolve().parents[1] / "places/imports/data/robots"
PAPER_CASES = ("nearest_exit", "crowded_exit_blocked", "side_exit_blocked", "second_nearest")


def one_drone(airframe, **guidance):
    return {"id": "d1", "airframe": airframe, "start": [10, 6, 22], "guidance": guidance}


class Airframes(FolderTest):
    def simulate(self, job):
        return throng("simulate", write_json(self.folder / "job.json", job), "-o", self.folder / "run.h5")

    def test_an_airframe_that_was_printed_is_one_that_a_job_can_have(self):
        names = [line.split()[0] for line in throng("airframes").stdout.splitlines()[1:]]
        self.assertIn("hector", names)
        for name in names:
            airframe = json.loads(throng("airframes", name).stdout)
            job = {
                "scenario": "city_square/everyday",
                "drones": [one_drone(airframe, policy="hover")],
                "capture": {"to_s": 1},
            }
            self.simulate(job)

    def test_hector_flies_the_cases_of_the_paper(self):
        for case in PAPER_CASES:
            job = {
                "scenario": f"city_square/huang2016/{case}",
                "crowd": {"compat": "huang2016"},
                "drones": [one_drone("hector", policy="zigzag", speed_mps=1.8)],
                "capture": {"to_s": 90},
            }
            done = self.simulate(job)
            for event in ("blown", "tilt", "collision", "fall"):
                self.assertNotIn(event, done.stderr, case)

    def test_an_imported_robot_flies_with_its_own_camera(self):
        airframe = self.folder / "quad.json"
        done = throng("airframes", "import", ROBOTS / "quad.urdf", "-o", airframe)
        self.assertRegex(done.stderr, r"skipped: .*quad.urdf:25: plugin sonar")
        self.assertRegex(done.stderr, r"assumed: rotors: those of the airframe hector")
        job = {
            "scenario": "city_square/everyday",
            "drones": [one_drone(json.loads(airframe.read_text()), policy="hover")],
            "capture": {"to_s": 1},
        }
        self.simulate(job)
        self.assertEqual(json.loads(airframe.read_text())["camera"]["gimbal"]["model"], "rigid")

    def test_models_that_lie_elsewhere_are_found_in_folders_that_are_named(self):
        robot = self.folder / "racer.sdf"
        robot.write_text((ROBOTS / "racer_with_camera" / "model.sdf").read_text())
        lost = throng("airframes", "import", robot, code=2)
        self.assertRegex(lost.stderr, r"racer.sdf: line \d+: .*model://racer.*--models")
        found = throng("airframes", "import", robot, "--models", ROBOTS)
        self.assertAlmostEqual(json.loads(found.stdout)["mass_kg"], 1.1)
        self.assertRegex(found.stderr, "propeller_3.*no <inertia>")

    def test_what_cannot_be_imported_is_named(self):
        xacro = self.folder / "quad.urdf.xacro"
        xacro.write_text("<robot xmlns:xacro='http://ros.org/wiki/xacro'>\n<xacro:include filename='x'/></robot>")
        for arguments, expected in (
            ([xacro], r"line 2: found <xacro:include>: a xacro file, expected its expansion: xacro .* -o quad.urdf"),
            ([self.folder / "nowhere.sdf"], "found no file"),
            ([ROBOTS / "quad.urdf", "--base", "hektor"], 'unknown airframe "hektor"; did you mean "hector"'),
            ([ROBOTS / "quad.urdf", "--camera", "frnt"], 'unknown camera "frnt"; did you mean "front"'),
            ([ROBOTS / "quad.urdf", "--models", self.folder / "none"], "which is no folder"),
        ):
            done = throng("airframes", "import", *arguments, code=2)
            self.assertRegex(done.stderr, expected)


if __name__ == "__main__":
    unittest.main()
