"""throng validate-crowd --data: a folder that this test writes, from the recording to the page, figures and JSON."""
import gzip
import json
import pathlib
import signal
import subprocess
import sys
import unittest

from program import ROOT, THRONG, FolderTest, printed, throng

SPEED_MPS = 0.8
GAP_S = 2.0
PEOPLE = 12


def recording():
    """People who enter a corridor one after the other at x = 1 m and walk to x = 19 m."""
    lines = ["# framerate: 10", "# ID FR x/cm y/cm"]
    for person in range(PEOPLE):
        first = round(10 * GAP_S * person)
        for i in range(round(10 * 18 / SPEED_MPS) + 1):
            lines.append(f"{person} {first + i} {100 + 10 * SPEED_MPS * i} {60 if person % 2 else 140}")
    return "\n".join(lines) + "\n"


def description():
    return {
        "experiments": [
            {
                "name": "corridor",
                "file": "walk.txt.gz",
                "free_speed_mps": {"mean": SPEED_MPS, "stddev": 0},
                "walkable": [[0, 0], [20, 0], [20, 2], [0, 2]],
                "goals": [{"min": [18, 0.2], "max": [19.5, 1.8]}],
                "area": {"min": [8, 0], "max": [12, 2]},
                "line": [[10, 0], [10, 2]],
            },
            {"name": "loop", "loop": {"length_m": 20, "width_m": 2, "points": [[0.4, 1.3], [1, 1.1]]}},
        ]
    }


class ValidateCrowd(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder / "walk.txt.gz").write_bytes(gzip.compress(recording().encode()))
        self.describe(description())

    def describe(self, document):
        (self.folder / "experiments.json").write_text(json.dumps(document))

    def printed(self, *arguments):
        return printed("validate-crowd", *arguments)

    def refused(self, words, *arguments):
        done = throng("validate-crowd", *arguments, code=2)
        self.assertEqual(done.stdout, "")
        for word in words:
            self.assertIn(word, done.stderr)

    def test_figures_are_those_of_the_recording(self):
        answer = json.loads(self.printed("--data", self.folder, "-m", "ttc,orca", "--seeds", 2, "--json"))
        self.assertEqual(answer["models"], ["ttc", "orca"])
        self.assertEqual(answer["seeds"], 2)
        corridor, loop = answer["experiments"]
        self.assertEqual(corridor["people"], PEOPLE)
        self.assertEqual(len(corridor["passages_s"]), PEOPLE)
        values = {quantity["name"]: quantity for quantity in corridor["quantities"]}
        self.assertAlmostEqual(values["flow"]["recorded"], 1 / GAP_S / 2, places=6)
        self.assertAlmostEqual(values["speed"]["recorded"], SPEED_MPS, places=4)
        self.assertAlmostEqual(values["time gap, median"]["recorded"], GAP_S, places=4)
        self.assertAlmostEqual(values["T90"]["recorded"], 9 / SPEED_MPS + GAP_S * 10, places=4)
        for quantity in ("flow", "speed"):
            for model in values[quantity]["models"]:
                self.assertEqual(len(model["values"]), 2)
                self.assertLess(abs(model["relative_error"]), 0.1, f"{quantity} of people who walk alone")
        self.assertEqual([point["density_per_m2"] for point in loop["quantities"]], [0.4, 1])
        self.assertEqual([row["error_of"] for row in answer["summary"]], ["exit flow", "speed", "T90", "diagram"])

    def test_results_do_not_depend_on_threads(self):
        command = ["--data", self.folder, "-m", "ttc", "--reduced", "--json"]
        self.assertEqual(self.printed(*command, "-j", 1), self.printed(*command, "-j", 4))

    def test_page_has_its_figures_beside_it(self):
        page = self.folder / "out.md"
        self.assertEqual(self.printed("--data", self.folder, "-m", "orca", "--seeds", 1, "-o", page), "")
        text = page.read_text()
        for name in ("out_curves.svg", "out_diagram.svg"):
            self.assertIn(f"]({name})", text)
            self.assertIn("<svg", (self.folder / name).read_text())
        self.assertIn("## corridor", text)
        printed = self.printed("--data", self.folder, "-m", "orca", "--seeds", 1, "--experiments", "corridor")
        self.assertIn("## corridor", printed)
        self.assertNotIn("## loop", printed)

    def test_the_part_of_the_documentation(self):
        page = self.folder / "validation.md"
        text = (ROOT / "docs/validation.md").read_text()
        page.write_text(text)
        command = [
            sys.executable,
            ROOT / "scripts/studies/validation_page.py",
            self.folder,
            "-m",
            "orca",
            "--seeds",
            "1",
        ]
        for _ in range(2):  # the second time it replaces what it wrote
            subprocess.run([*command, "--page", page, "--throng", THRONG], check=True, capture_output=True, timeout=300)
        written = page.read_text()
        self.assertEqual(written.count("### corridor"), 1)
        self.assertEqual(written.count("](validation_curves.svg)"), 1)
        self.assertTrue((self.folder / "validation_diagram.svg").exists())
        self.assertTrue(written.endswith(text[text.index("## Standard tests") :]))
        self.assertTrue(written.startswith(text[: text.index("<!-- recorded people -->")]))

    def test_mistakes_are_named(self):
        data = ["--data", self.folder, "-m", "orca", "--seeds", 1]
        self.refused(['unknown experiment "coridor"', '"corridor"'], *data, "--experiments", "coridor")
        self.refused(["orca"], "--data", self.folder, "-m", "orcas")
        self.refused(["--tests"], *data, "--tests", "rimea_1")
        self.refused(["--seeds"], "--data", self.folder, "--seeds", 0)
        self.refused(["--data"], "--seeds", 3)
        self.refused(["--data"], "--json")
        self.refused([".md"], *data, "-o", self.folder / "out.txt")
        self.refused(["missing", "a folder"], "--data", self.folder / "missing")
        self.refused(["no experiment"], "--data", pathlib.Path(__file__).parent)
        document = description()
        document["experiments"][0]["goals"][0]["mxa"] = [1, 1]
        self.describe(document)
        self.refused(["experiments.json: /experiments/0/goals/0/mxa", 'did you mean "max"?'], *data)
        self.describe(description())
        (self.folder / "walk.txt.gz").write_bytes(gzip.compress(recording().encode())[:500])
        self.refused(["walk.txt.gz", "damaged gzip file"], *data)

    def test_it_is_cancelled(self):
        process = subprocess.Popen(
            [THRONG, "validate-crowd", "--data", self.folder, "--seeds", "1000"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        with process:
            self.assertTrue(process.stderr.read(1), "the progress bar shows that it runs")
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(output, b"")


if __name__ == "__main__":
    unittest.main()
