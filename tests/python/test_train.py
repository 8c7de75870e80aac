"""throng.train: it learns, goes on where it was interrupted, scores on real sets, and names what is wrong.

torch is optional: without it only the message that asks for it is tested, and the rest says that it is skipped.
"""
import contextlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import common
import numpy as np

HAS_TORCH = common.has("torch")
SKIPPED = "torch, which is optional, is not installed (apt-get install python3-torch): nothing is trained"
if HAS_TORCH:
    from throng.train import __main__ as command
    from throng.train import detectors, evaluate, experiments, learning, networks, pictures, report, tiles
    from throng.train.networks import torch
from throng.train import jobs


os.environ.setdefault("THRONG_PROGRAM", str(common.THRONG))


def run(*arguments):
    """The command in this process, which saves the time to load torch. Gives exit code, output and errors."""
    out, errors, code = io.StringIO(), io.StringIO(), 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            code = command.main([str(each) for each in arguments])
        except SystemExit as exit_:
            code = exit_.code
    return code, out.getvalue(), errors.getvalue()


class WithoutTorch(unittest.TestCase):
    def test_torch_is_named(self):
        code = "import runpy, sys; sys.modules['torch'] = None; sys.argv = ['train', '-o', 'x', 'y']; "
        code += "runpy.run_module('throng.train', run_name='__main__')"
        environment = {**os.environ, "PYTHONPATH": str(common.ROOT / "python")}
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("apt-get install python3-torch", result.stderr)


class Jobs(unittest.TestCase):
    JOB = {
        "scenario": ["bridge/everyday", {"generate": {"kind": "street"}}, "campus/everyday"],
        "drones": [
            {"id": "d", "camera": {"hfov_deg": {"uniform": [50, 70]}, "sensor": {"iso": {"log_uniform": [100, 400]}}}}
        ],
        "environment": {"time_of_day": {"uniform": ["06:30", "19:30"]}, "weather": {"choice": ["clear", "rain"]}},
        "randomize": {"props.density": {"uniform": [0, 1]}, "appearance.variety": {"normal": [0.7, 0.1]}},
    }

    def test_a_group_is_left_out(self):
        less = {group: jobs.without(self.JOB, group) for group in jobs.GROUPS}
        self.assertEqual(less["hour"]["environment"]["time_of_day"], {"choice": ["13:00"]})
        self.assertEqual(less["hour"]["environment"]["weather"], self.JOB["environment"]["weather"])
        self.assertEqual(less["weather"]["environment"]["weather"], {"choice": ["clear"]})
        self.assertEqual(less["lens"]["drones"][0]["camera"]["hfov_deg"], {"choice": [60]})
        self.assertEqual(less["sensor"]["drones"][0]["camera"]["sensor"]["iso"], {"choice": [200]})
        self.assertEqual(less["appearance"]["randomize"]["appearance.variety"], {"choice": [0.7]})
        self.assertEqual(less["clutter"]["randomize"]["props.density"], {"choice": [0.5]})
        self.assertEqual(less["place"]["scenario"], "bridge/everyday")
        self.assertEqual(
            jobs.without(self.JOB, "place", frozenset(["bridge/everyday"]))["scenario"],
            {"generate": {"kind": "street"}},
        )
        with self.assertRaisesRegex(ValueError, "samples nothing of hour"):
            jobs.without({}, "hour")

    def test_jobs_of_presets_are_valid(self):
        with tempfile.TemporaryDirectory() as folder:
            for group in jobs.GROUPS:
                job = pathlib.Path(folder) / f"{group}.job.json"
                job.write_text(json.dumps(jobs.without(jobs.read_job("detection"), group)))
                subprocess.run([common.THRONG, "check", job], capture_output=True, check=True)


@unittest.skipUnless(HAS_TORCH, SKIPPED)
class Tiles(unittest.TestCase):
    def picture(self, boxes, ignored=(), pixels=None):
        boxes, ignored = np.reshape(boxes, (-1, 4)).astype(float), np.reshape(ignored, (-1, 4)).astype(float)
        image = np.zeros((90, 120, 3), np.uint8) if pixels is None else pixels
        return pictures.Picture("a", "", lambda: image, boxes, ignored, boxes[:, :2])

    def test_boxes_follow_the_pixels(self):
        pixels = np.zeros((90, 120, 3), np.uint8)
        pixels[20:50, 40:52] = 255
        source = self.picture([[40, 20, 52, 50]], pixels=pixels)
        found = 0
        for image, people in tiles.Tiles([[source]], "detect", 64, 40, 3, changes=False):
            if len(people) == 1 and people[0, 4] == 1 and (people[0, :4] > 1).all() and (people[0, :4] < 63).all():
                rows, columns = np.nonzero(image[0].numpy() > 0.5)
                edges = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
                np.testing.assert_allclose(people[0, :4].numpy(), edges, atol=1.6)
                found += 1
        self.assertGreater(found, 5)

    def test_small_and_unscored_people_are_not_asked_for(self):
        source = self.picture([[10, 10, 20, 40], [30, 10, 32, 12]], [[60, 20, 80, 40]])
        (_, people), *_ = tiles.Tiles([[source]], "detect", 128, 1, 1, scales=(1, 1), changes=False)
        self.assertEqual(sorted(people[:, 4].tolist()), [0, 0, 1])
        heat, wanted, weight, asked = networks._targets(people, 32, 32)
        self.assertEqual((heat == 1).sum(), 1)
        self.assertAlmostEqual(float(weight.sum()), 1, places=5)
        self.assertLess(asked.min(), 1)

    def test_numbers_say_all(self):
        rng = np.random.default_rng(1)
        source = self.picture([[40, 20, 52, 50]], pixels=rng.integers(0, 255, (90, 120, 3)).astype(np.uint8))
        whole = [tile for tile, _ in tiles.Tiles([[source]], "count", 64, 6, 2)]
        rest = [tile for tile, _ in tiles.Tiles([[source]], "count", 64, 6, 2, first=4)]
        self.assertTrue(all(torch.equal(a, b) for a, b in zip(whole[4:], rest)))
        self.assertFalse(torch.equal(whole[0], whole[1]))


@unittest.skipUnless(HAS_TORCH, SKIPPED)
class Networks(unittest.TestCase):
    def test_targets_are_found_again(self):
        boxes = torch.tensor([[8.0, 8, 24, 60, 1], [60, 10, 72, 30, 1]])
        heat, wanted, _, _ = networks._targets(boxes, 24, 24)
        model = networks.Detector(8)
        with mock.patch.object(model, "forward", lambda images: (torch.logit(heat[None] * 0.9 + 0.01), wanted[None])):
            (found, scores), *_ = model.detect(torch.zeros(1, 3, 96, 96))
        self.assertEqual(sorted(found[:2].tolist()), boxes[:, :4].tolist())

    def test_people_of_two_scales_are_one(self):
        boxes, scores = evaluate._join(
            np.array([[0, 0, 10, 20], [0, 0, 10, 22], [50, 0, 60, 20.0]]), np.array([0.9, 0.9, 0.3])
        )
        np.testing.assert_allclose(boxes, [[0, 0, 10, 21], [50, 0, 60, 20]])
        self.assertEqual(scores.tolist(), [0.9, 0.3])

    @unittest.skipUnless(common.has("torchvision"), "torchvision is not installed")
    def test_torchvision(self):
        model = detectors.make("torchvision", "detect", 0).train()
        people = torch.tensor([[8.0, 8, 24, 60, 1], [60, 10, 72, 30, 0]])
        loss = model.loss(torch.rand(1, 3, 96, 96), [people])
        loss.backward()
        self.assertGreater(float(loss), 0)
        (boxes, scores), *_ = model.eval().detect(torch.rand(1, 3, 96, 96))
        self.assertEqual(boxes.shape, (len(scores), 4))


@unittest.skipUnless(HAS_TORCH, SKIPPED)
class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.dataset = common.dataset_folder()

    def train(self, out, *more, steps=2):
        few = ["--batch", 4, "--tile", 96, "--width", 8, "--threads", 1, "--device", "cpu", "--test-split", "all"]
        code, said, errors = run(self.dataset, "-o", self.root / out, "--split", "all", "--steps", steps, *few, *more)
        self.assertEqual(code, 0, errors)
        return said, {
            (each["task"], each["training"], each["test"]): each["scores"]
            for each in json.loads((self.root / out / "scores.json").read_text())
        }

    def test_it_learns(self):
        said, scores = self.train("learned", "--rate", 0.006, "--width", 12, "--task", "detect", steps=100)
        self.assertGreater(scores["detect", "synthetic", "all"]["ap50"], 0.2)
        _, counts = self.train("counted", "--rate", 0.004, "--task", "count", steps=240)
        counted = counts["count", "synthetic", "all"]
        _, untrained = self.train("uncounted", "--task", "count", steps=0)
        self.assertLess(counted["mae"], 0.7 * untrained["count", "synthetic", "all"]["mae"])
        low, high = scores["detect", "synthetic", "all"]["ap50_interval"]
        self.assertTrue(low < scores["detect", "synthetic", "all"]["ap50"] < high)
        self.assertIn("| synthetic | 18 | all | 1 |", said)
        # The same images and people in VisDrone's layout, boxes in whole pixels.
        limits = ["--min-visibility", "0.25", "--min-height", "6", "--split", "train=1"]
        export = [common.THRONG, "export", self.dataset, "-o", self.root / "out", "--formats", "visdrone-det", *limits]
        subprocess.run(export, check=True, capture_output=True, timeout=300)
        model = self.root / "learned/detect/synthetic/seed1/model.pt"
        code, said, errors = run(
            "--model", model, "--test", "visdrone", self.root / "out/visdrone-det/train", "--threads", 1
        )
        self.assertEqual(code, 0, errors)
        real = float(said.splitlines()[-3].split("|")[5])
        self.assertLess(abs(real - scores["detect", "synthetic", "all"]["ap50"]), 0.06)

    def test_it_goes_on(self):
        """Interrupted after a checkpoint, a training ends with the same weights."""
        self.train("whole", "--task", "detect", steps=6)
        real_step = torch.optim.AdamW.step
        calls = []

        def step(self, *more, **options):
            calls.append(1)
            if len(calls) == 4:
                raise KeyboardInterrupt
            return real_step(self, *more, **options)

        with mock.patch.object(torch.optim.AdamW, "step", step), self.assertRaises(KeyboardInterrupt):
            self.train("parts", "--task", "detect", "--checkpoint", 2, steps=6)
        self.assertTrue((self.root / "parts/detect/synthetic/seed1/checkpoint.pt").exists())
        self.train("parts", "--task", "detect", "--checkpoint", 2, steps=6)
        states = [
            torch.load(self.root / out / "detect/synthetic/seed1/model.pt")["state"] for out in ("whole", "parts")
        ]
        self.assertTrue(all(torch.equal(a, b) for a, b in zip(states[0].values(), states[1].values())))
        # A finished training is not repeated; other options are refused.
        with mock.patch.object(learning.torch.optim, "AdamW", None), mock.patch.object(evaluate, "detect", None):
            self.train("parts", "--task", "detect", steps=6)
        code, _, errors = run(self.dataset, "-o", self.root / "parts", "--split", "all", "--steps", 7, "--threads", 1)
        self.assertEqual(code, 2)
        self.assertIn("plan.json: found a training with steps 6, expected 7", errors)

    def test_experiments(self):
        limits = ["--min-visibility", "0.25", "--min-height", "6", "--split", "train=1"]
        export = [common.THRONG, "export", self.dataset, "-o", self.root / "real", "--formats", "visdrone-det", *limits]
        subprocess.run(export, check=True, capture_output=True, timeout=300)
        real = ["visdrone", self.root / "real/visdrone-det/train"]
        experiment = ["--experiment", "frames,fine_tune,real,mixed", "--frames", "4,8,900", "--percents", "10,100"]
        said, scores = self.train(
            "many", *experiment, "--real", *real, "--test", *real, "--task", "detect", "--seeds", "1,2", "--limit", 2
        )
        trained = {training for _, training, _ in scores}
        names = ["synthetic", "frames_4", "frames_8"]
        names += [f"{kind}_{percent}" for kind in ("fine_tune", "real", "mixed") for percent in (10, 100)]
        self.assertEqual(trained, set(names))
        self.assertIn("| mixed_10 | 20 | visdrone train | 2 |", said)
        self.assertIn("| real_10 | 2 |", said)
        if common.has("matplotlib"):
            self.assertIn("<svg", (self.root / "many/curves.svg").read_text())

    def test_ablation_by_transfer(self):
        job = json.loads((common.ROOT / "scenarios/bridge/demo.job.json").read_text())
        job.update(runs=3, quality="draft", capture={"from_s": 2, "to_s": 2})
        job["scenario"] = ["bridge/everyday", "campus/everyday", "station/everyday"]
        job["drones"] = [{"id": "d", "aim": {"height_m": 15}, "camera": {"width": 128, "height": 96, "pitch_deg": -60}}]
        job["environment"] = {"weather": {"choice": ["clear", "rain"]}}
        job["outputs"] = {"annotations": ["coco"]}
        job.pop("randomize", None)
        file = self.root / "places.job.json"
        file.write_text(json.dumps(job))
        options = [
            "--transfer",
            1,
            "--ablate",
            "weather,place",
            "--steps",
            1,
            "--tile",
            64,
            "--width",
            8,
            "--threads",
            1,
        ]
        with mock.patch.dict(os.environ, {"THRONG_PROGRAM": str(common.THRONG)}):
            code, said, errors = run(file, "-o", self.root / "places", "--task", "count", *options)
        self.assertEqual(code, 0, errors)
        for row in (
            "| synthetic | 2 | 1 other places",
            "| without_weather | 2 | 1 other",
            "| without_place | 2 | 1 other",
        ):
            self.assertIn(row, said)

    def test_errors(self):
        self.train("errors", "--task", "detect", steps=0)
        model = self.root / "errors/detect/synthetic/seed1/model.pt"
        (self.root / "none.pt").write_text("none")
        heads = self.root / "nwpu"
        (heads / "images").mkdir(parents=True)
        (heads / "jsons").mkdir()
        shutil.copy(next((self.dataset / "images").rglob("*.jpg")), heads / "images/0001.jpg")
        (heads / "jsons/0001.json").write_text('{"points": []}')
        out = (self.dataset, "-o", self.root / "new")
        for arguments, message in (
            ((*out, "--split", "x"), "found 'x', expected one of all, train, val"),
            ((*out, "--tile", 90), "--tile: found 90, expected a multiple of 32"),
            ((*out, "--steps", -1), "found -1, expected 0 or more"),
            ((*out, "--experiment", "synthetik"), "did you mean 'synthetic'?"),
            ((*out, "--experiment", "real"), "--experiment real: expected --real KIND PATH and --test"),
            ((*out, "--ablate", "wether"), "did you mean 'weather'?"),
            ((*out, "--ablate", "weather"), "--ablate: expected one job or the name of a preset"),
            ((*out, "--transfer", 3), "--transfer: found 3, expected less than the 1 scenarios"),
            ((self.dataset, "-o", self.root / "none.pt"), "which is a file, expected a folder"),
            ((*out, "--device", "gpu"), "--device: found gpu, expected a device of this machine"),
            (("-o", self.root / "new"), "expected a dataset, a job or the name of a preset"),
            ((self.dataset,), "expected either -o FOLDER"),
            (("--model", model), "--model: expected datasets or --test KIND PATH"),
            (("--model", self.root / "none.pt", self.dataset), "none.pt: found no model of throng.train"),
            (("--model", model, self.dataset, "--scale", 0), "found 0, expected 0.05 to 20"),
            (("--model", model, "--test", "visdrom", heads), "did you mean 'visdrone'?"),
            (("--model", model, "--test", "nwpu", heads), "found heads only, expected boxes"),
        ):
            code, _, errors = run(*arguments)
            self.assertEqual(code, 2, (arguments, errors))
            self.assertIn(message, errors)


@unittest.skipUnless(HAS_TORCH, SKIPPED)
class Report(unittest.TestCase):
    def test_intervals(self):
        mean, half = report.interval([0.5, 0.6, 0.7])
        self.assertAlmostEqual(mean, 0.6)
        self.assertAlmostEqual(half, 4.303 * 0.1 / 3**0.5, places=4)

    def test_larger_choices_hold_smaller_ones(self):
        few, more = (pictures.spread(range(50), count, 3) for count in (5, 20))
        self.assertTrue(set(few) < set(more))
        self.assertEqual(len(experiments.plan(["frames"], [0] * 100, [], {})), 2)


if __name__ == "__main__":
    if not HAS_TORCH:
        print(SKIPPED)
    common.main()
