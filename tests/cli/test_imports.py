"""The commands of docs/imports.md and a job of docs/recorded.md: imports, their check, and a run of one of them and of recorded people."""
import json
import math
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

THRONG = sys.argv[1]
ROOT = Path(__file__).resolve().parents[2]


def throng(*words, cwd, scenarios=None, code=0):
    env = dict(os.environ)
    if scenarios:
        env["THRONG_SCENARIOS"] = str(scenarios)
    done = subprocess.run([THRONG, *map(str, words)], cwd=cwd, env=env, capture_output=True, text=True)
    assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
    return done


class Imports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "tests").symlink_to(ROOT / "tests")

    def commands(self):
        page = (ROOT / "docs" / "imports.md").read_text()
        return [shlex.split(line) for line in re.search(r"```sh\n(.*?)```", page, re.S).group(1).splitlines()]

    def test_the_page_s_commands_work(self):
        for words in self.commands():
            if words[0].startswith("THRONG_SCENARIOS="):
                scenarios = self.folder / words[0].split("=")[1]
                job = self.folder / words[3]
                short = json.loads(job.read_text())
                short["capture"] = {"from_s": 1, "to_s": 3}
                job.write_text(json.dumps(short))
                throng("simulate", job, "-o", "trace.h5", cwd=self.folder, scenarios=scenarios)
                continue
            throng(*words[1:], cwd=self.folder)
        skipped = (self.folder / "mine" / "yard.skipped.txt").read_text()
        self.assertRegex(skipped, r"yard.sdf:5: .*<plugin>")

    def test_recorded_people_are_measured_as_their_file_is(self):
        throng(*self.commands()[0][1:], cwd=self.folder)
        rows = ["who,t,east,north"]
        for person in range(4):
            for frame in range(160):
                rows.append(f"p{person},{frame},{100 * frame / 16 - 600 + 30 * person},{100 + 5 * math.sin(frame)}")
        (self.folder / "walk.csv").write_text("\n".join(rows))
        job = {
            "scenario": "yard",
            "capture": {"to_s": 159 / 16},
            "crowd": {
                "recorded": {
                    "file": "walk.csv",
                    "frame_rate_hz": 16,
                    "unit": "cm",
                    "columns": {"person": "who", "frame": "t", "x": "east", "y": "north"},
                }
            },
        }
        (self.folder / "job.json").write_text(json.dumps(job))
        mine = self.folder / "mine"
        throng("simulate", "job.json", "-o", "trace.h5", cwd=self.folder, scenarios=mine)
        run = json.loads(throng("metrics", "trace.h5", cwd=self.folder, scenarios=mine).stdout)
        own = json.loads(
            throng(
                "metrics",
                "--trajectory",
                "walk.csv",
                "--scenario",
                "mine/yard.json",
                "--frame-rate",
                "16",
                "--unit-m",
                "0.01",
                "--person-column",
                "who",
                "--frame-column",
                "t",
                "--x-column",
                "east",
                "--y-column",
                "north",
                cwd=self.folder,
            ).stdout
        )
        self.assertEqual(run["people"], 4)
        for part in ("exits", "escape_curve", "exposure", "journeys"):
            self.assertEqual(run[part], own[part], part)

    def test_wrong_input_is_refused(self):
        (self.folder / "w.txt").write_text("no world")
        throng("scenario", "import", "w.txt", "-o", "mine", cwd=self.folder, code=2)
        throng("scenario", "import", "none.osm", "-o", "mine", cwd=self.folder, code=2)
        throng(
            "scenario",
            "import",
            "tests/places/imports/data/yard.sdf",
            "-o",
            "mine",
            "--exit",
            "1,2,3",
            cwd=self.folder,
            code=2,
        )
        world = "tests/places/imports/data/yard.sdf"
        throng("scenario", "import", world, "-o", "mine", "--models", "no_models", cwd=self.folder, code=2)
        self.assertFalse((self.folder / "mine").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
