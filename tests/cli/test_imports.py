"""The commands of docs/imports.md and a job of docs/recorded.md: imports, their check, and a run of one of them and of recorded people."""
import json
import math
import re
import shlex
import unittest

from program import ROOT, FolderTest, throng


class Imports(FolderTest):
    def setUp(self):
        super().setUp()
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
                throng("simulate", job, "-o", "trace.h5", cwd=self.folder, variables={"THRONG_SCENARIOS": scenarios})
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
        mine = {"THRONG_SCENARIOS": self.folder / "mine"}
        throng("simulate", "job.json", "-o", "trace.h5", cwd=self.folder, variables=mine)
        run = json.loads(throng("metrics", "trace.h5", cwd=self.folder, variables=mine).stdout)
        own = json.loads(
            throng(
                *"metrics --trajectory walk.csv --scenario mine/yard.json --frame-rate 16 --unit-m 0.01 --person-column who".split(),
                *"--frame-column t --x-column east --y-column north".split(),
                cwd=self.folder,
            ).stdout
        )
        self.assertEqual(run["people"], 4)
        for part in ("exits", "escape_curve", "exposure", "journeys"):
            self.assertEqual(run[part], own[part], part)

    def test_wrong_input_is_refused(self):
        (self.folder / "w.txt").write_text("no world")
        world = "tests/places/imports/data/yard.sdf"
        for words in (["w.txt"], ["none.osm"], [world, "--exit", "1,2,3"], [world, "--models", "no_models"]):
            throng("scenario", "import", *words, "-o", "mine", cwd=self.folder, code=2)
        self.assertFalse((self.folder / "mine").exists())


if __name__ == "__main__":
    unittest.main()
