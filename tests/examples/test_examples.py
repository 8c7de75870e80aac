"""Output of the programs in examples/. Usage: test_examples.py NAME PROGRAM."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NAME, PROGRAM = sys.argv[1:3]


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=250)


def numbers(pattern, text):
    found = re.search(pattern, text)
    assert found, f"no {pattern!r} in {text!r}"
    return [float(group) for group in found.groups()]


class Examples(unittest.TestCase):
    def room_and_door(self):
        flows = {}
        for width in (0.8, 1.6):
            done = run(width)
            self.assertEqual(done.returncode, 0, done.stderr)
            out, people, time_s, flow = numbers(
                r"(\d+) of (\d+) people out after ([\d.]+) s, ([\d.]+) per second", done.stdout
            )
            self.assertEqual((out, people), (60, 60))
            self.assertAlmostEqual(flow, out / time_s, places=1)
            flows[width] = flow
        self.assertGreater(flows[1.6], flows[0.8])
        self.assertEqual(run(0.8).stdout, run(0.8).stdout)

    def crossing(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            done = run(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            slowed, free = numbers(r"([\d.]+) m/s where the streams cross, ([\d.]+) m/s alone", done.stdout)
            self.assertTrue(0.3 * free < slowed < free, done.stdout)
            self.assertIn("<!-- Beyond the crossing. -->", (folder / "behavior.xml").read_text())
            program = os.environ.get("THRONG_PROGRAM")
            if program and Path(program).exists():  # the files are ones that the program runs
                subprocess.run(
                    [program, "crowd", "-s", folder / "scene.xml", "-b", folder / "behavior.xml", "-d", "5"],
                    check=True,
                    capture_output=True,
                    timeout=250,
                )

    def study(self):
        done = run(3)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [tuple(map(float, row)) for row in re.findall(r"one door ([\d.]+) s, two doors ([\d.]+) s", done.stdout)]
        self.assertEqual(len(rows), 3)
        saved, _, pairs = numbers(
            r"saves ([-\d.]+) s on average \(standard error ([\d.]+) s, (\d+) pairs\)", done.stdout
        )
        self.assertEqual(pairs, 3)
        self.assertAlmostEqual(saved, sum(one - two for one, two in rows) / 3, delta=0.11)
        self.assertGreater(saved, 0)
        self.assertEqual(run("none").returncode, 2)


if __name__ == "__main__":
    suite = unittest.TestSuite([Examples(NAME)])
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful())
