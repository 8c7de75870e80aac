"""examples/train_detector.py, train_counter.py and evaluate.py: they learn, score, and name what is wrong.

torch is optional: without it only the message that asks for it is tested, and the rest says that it is skipped.
"""
import contextlib
import importlib
import io
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import common

EXAMPLES = common.ROOT / "examples"
SKIPPED = "torch, which is optional, is not installed (apt-get install python3-torch): nothing is trained"


def run(program, *arguments):
    """Runs main() in this process, which saves the time to load torch. Gives exit code, output and errors."""
    module = importlib.import_module(program)
    out, errors, code = io.StringIO(), io.StringIO(), 0
    with mock.patch.object(sys, "argv", [program, *map(str, arguments)]):
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            try:
                importlib.import_module("learning").finish(module.main)
            except SystemExit as exit_:
                code = exit_.code
    return code, out.getvalue(), errors.getvalue()


class WithoutTorch(unittest.TestCase):
    def test_torch_is_named(self):
        code = "import runpy, sys; sys.modules['torch'] = None; runpy.run_path(sys.argv[1], run_name='__main__')"
        for name in ("train_detector", "train_counter", "evaluate"):
            script = f"import sys; sys.path.insert(0, {str(EXAMPLES)!r}); {code}"
            command = [sys.executable, "-c", script, EXAMPLES / f"{name}.py"]
            result = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(result.returncode, 1)
            self.assertIn("apt-get install python3-torch", result.stderr)


class Jobs(unittest.TestCase):
    def test_a_training_set_of_a_demo(self):
        with tempfile.TemporaryDirectory() as folder:
            job = pathlib.Path(folder) / "bridge.job.json"
            demo = common.ROOT / "scenarios/bridge/demo.job.json"
            job.write_bytes(subprocess.check_output(["jq", "-f", EXAMPLES / "training_set.jq", demo]))
            checked = subprocess.run([common.THRONG, "check", job], capture_output=True, text=True, check=True).stdout
            self.assertRegex(checked, "images +42 ")


@unittest.skipUnless(common.has("torch"), SKIPPED)
class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        sys.path.insert(0, str(EXAMPLES))
        cls.dataset = common.dataset_folder()

    def train(self, program, steps, *more):
        model = self.root / f"{program}{steps}.pt"
        few = ["--batch", 4, "--tile", 96, "--rate", 0.005, "--threads", 1, "--device", "cpu"]
        code, out, errors = run(program, self.dataset, "-o", model, "--split", "all", "--steps", steps, *few, *more)
        self.assertEqual((code, errors), (0, ""), out)
        return model

    def score(self, model, *arguments):
        code, out, errors = run("evaluate", model, *arguments, "--threads", 1, "--device", "cpu")
        self.assertEqual((code, errors), (0, ""), out)
        return json.loads(out)

    def test_detector(self):
        trained = self.train("train_detector", 110)
        scores = self.score(trained, self.dataset, "--split", "all")
        self.assertGreater(scores["ap50"], 0.25)
        self.assertGreater(scores["recall50"], 0.4)
        self.assertEqual((scores["images"], scores["trained_images"]), (18, 18))
        untrained = self.score(self.train("train_detector", 0), self.dataset, "--split", "val")
        self.assertLess(untrained["ap50"], 0.02)
        self.assertEqual(untrained["images"], 9)
        # The same images and people in VisDrone's layout, boxes in whole pixels.
        limits = ["--min-visibility", "0.25", "--min-height", "6", "--split", "train=1"]
        export = [common.THRONG, "export", self.dataset, "-o", self.root / "out", "--formats", "visdrone-det", *limits]
        subprocess.run(export, check=True, capture_output=True, timeout=300)
        photographs = ["--real", "visdrone", self.root / "out/visdrone-det/train"]
        real = self.score(trained, *photographs)
        self.assertEqual(real["people"], scores["people"])
        self.assertLess(abs(real["ap50"] - scores["ap50"]), 0.05)
        small = self.score(trained, *photographs, "--limit", 2, "--scale", 0.5)
        self.assertEqual(small["images"], 2)

    def test_counter(self):
        scores = self.score(self.train("train_counter", 120), self.dataset, "--split", "all")
        self.assertLess(scores["mae"], scores["always_the_mean"]["mae"])
        few = self.score(self.train("train_counter", 0, "--images", 12), self.dataset, "--split", "val")
        self.assertEqual((few["images"], few["trained_images"]), (9, 12))
        self.assertGreater(few["mae"], few["always_the_mean"]["mae"])

    def test_errors(self):
        model = self.train("train_detector", 0)
        (self.root / "none.pt").write_text("none")
        heads = self.root / "nwpu"
        (heads / "images").mkdir(parents=True)
        (heads / "jsons").mkdir()
        shutil.copy(next((self.dataset / "images").rglob("*.jpg")), heads / "images/0001.jpg")
        (heads / "jsons/0001.json").write_text('{"points": []}')
        for arguments, message in (
            (("train_detector", self.dataset, "-o", model, "--split", "x"), "found 'x', expected all, train, val"),
            (("train_detector", self.dataset, "-o", model, "--images", 99), "count: found 99, expected 0 to 9"),
            (("train_counter", self.dataset, "-o", model, "--tile", 90), "--tile: found 90, expected a multiple of 8"),
            (("train_counter", self.dataset, "-o", model, "--steps", -1), "found -1, expected 0 or more"),
            (("train_detector", self.dataset, "-o", self.root / "no/x.pt"), "x.pt, whose folder does not exist"),
            (("train_counter", self.dataset, "-o", self.root), "which cannot be written"),
            (("train_detector", self.dataset, "-o", model, "--tile", 4096), "--tile: found 4096, expected at most 320"),
            (("train_detector", self.dataset, "-o", model, "--device", "gpu"), "--device: found gpu, expected a dev"),
            (("evaluate", model, self.dataset, "--device", "cuda:99"), "--device: found cuda:99, expected a device"),
            (("evaluate", self.root / "none.pt", self.dataset), "none.pt: found no model of train_detector.py"),
            (("evaluate", model), "expected either datasets or --real"),
            (("evaluate", model, self.dataset, "--scale", 0), "--scale: found 0, expected 0.05 to 20"),
            (("evaluate", model, "--real", "visdrom", heads), "did you mean 'visdrone'?"),
            (("evaluate", model, "--real", "nwpu", heads), "0001.jpg: found heads only, expected boxes"),
        ):
            code, _, errors = run(*arguments)
            self.assertEqual(code, 2, errors)
            self.assertIn(message, errors)


if __name__ == "__main__":
    if not common.has("torch"):
        print(SKIPPED)
    common.main()
