"""throng airframes: the quadcopters that a job can name, and those that a user describes."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

THRONG = sys.argv.pop(1)
PAPER_CASES = ("nearest_exit", "crowded_exit_blocked", "side_exit_blocked", "second_nearest")


def throng(*arguments, **options):
    return subprocess.run([THRONG, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


def one_drone(airframe, **guidance):
    return {"id": "d1", "airframe": airframe, "start": [10, 6, 22], "guidance": guidance}


class Airframes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def simulate(self, job):
        file = self.folder / "job.json"
        file.write_text(json.dumps(job))
        return throng("simulate", file, "-o", self.folder / "run.h5")

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
            done = self.simulate(job)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_hector_flies_the_cases_of_the_paper(self):
        for case in PAPER_CASES:
            job = {
                "scenario": f"city_square/huang2016/{case}",
                "crowd": {"compat": "huang2016"},
                "drones": [one_drone("hector", policy="zigzag", speed_mps=1.8)],
                "capture": {"to_s": 90},
            }
            done = self.simulate(job)
            self.assertEqual(done.returncode, 0, done.stderr)
            for event in ("blown", "tilt", "collision", "fall"):
                self.assertNotIn(event, done.stderr, case)


if __name__ == "__main__":
    unittest.main()
