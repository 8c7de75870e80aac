#!/usr/bin/env python3
"""`throng_first`, the program that scripts/demo.sh has first: it makes the same dataset as `throng`, and says which program does
what it cannot do.

usage: test_first_program.py THRONG FIRST
"""
import sys
import unittest

from program import THRONG, FolderTest, run, write_json

FIRST = sys.argv.pop(1)
JOB = {
    "scenario": "bridge/everyday",
    "quality": "draft",
    "drones": [{"id": "d1", "start": [0, -10, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": {"from_s": 1, "to_s": 2, "rate_hz": 1},
}


def commands(program):
    """The commands that the help lists."""
    text = run(program, "--help").stdout
    return {
        line.split()[0]
        for line in text.split("Subcommands:")[1].splitlines()
        if line.startswith("  ") and line[2] != " "
    }


class FirstProgram(FolderTest):
    def test_it_makes_the_same_dataset(self):
        job = write_json(self.folder / "job.json", JOB)
        contents = []
        for name, program in (("first", FIRST), ("whole", THRONG)):
            run(program, "run", job, "-o", self.folder / name)
            dataset = self.folder / name / "dataset"
            files = [path for path in sorted(dataset.rglob("*")) if path.is_file()]
            contents.append({str(path.relative_to(dataset)): path.read_bytes() for path in files})
        self.assertGreater(len(contents[0]), 5)
        self.assertEqual(contents[0], contents[1])

    def test_it_lacks_only_what_the_first_image_does_not_need(self):
        missing = commands(THRONG) - commands(FIRST)
        self.assertEqual(missing, {"calibrate", "live", "match", "train", "validate", "validate-crowd"})
        self.assertEqual(commands(FIRST) - commands(THRONG), set())

    def test_work_that_it_lacks_is_named(self):
        request = {"task": "calibration", "request": {}, "files": str(self.folder)}
        write_json(self.folder / "request.json", request)
        done = run(FIRST, "confined", self.folder, code=3)
        self.assertIn("does not have the work", done.stderr)
        self.assertIn("scripts/setup.sh", done.stderr)


if __name__ == "__main__":
    unittest.main()
