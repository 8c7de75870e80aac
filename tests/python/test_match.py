"""Matching a real set: boxes of known cameras, light and counts, the job that is made of them, and frames that are chosen."""
import contextlib
import io
import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import common
import numpy as np
import throng
from throng import DatasetError, match
from throng._view_estimate import BODY_HEIGHT_M, box_sizes, estimate_view, focal_px

WIDTH, HEIGHT, HFOV = 640, 360, 70.0


def person(camera_height, pitch_deg, ahead, aside, tall, wide):
    """The box of a person, projected here point by point: points of an ellipsoid that stands on the ground."""
    pitch = -math.radians(pitch_deg)
    around = np.linspace(0, 2 * math.pi, 24)
    up = np.linspace(-1, 1, 13)
    x = ahead + wide / 2 * np.outer(np.sqrt(1 - up**2), np.cos(around))
    y = aside + wide / 2 * np.outer(np.sqrt(1 - up**2), np.sin(around))
    below = camera_height - (tall / 2 + tall / 2 * up)[:, None] + 0 * x
    depth = x * math.cos(pitch) + below * math.sin(pitch)
    if depth.min() < 0.3:
        return None
    focal = focal_px(WIDTH, HFOV)
    columns = WIDTH / 2 + focal * y / depth
    rows = HEIGHT / 2 + focal * (below * math.cos(pitch) - x * math.sin(pitch)) / depth
    box = [columns.min(), rows.min(), columns.max(), rows.max()]
    return box if 0 < box[0] and 0 < box[1] and box[2] < WIDTH and box[3] < HEIGHT else None


def crowd(camera_height, pitch_deg, count, seed):
    """Boxes in whole pixels of so many people in the image."""
    random = np.random.default_rng(seed)
    boxes = []
    middle = camera_height / math.tan(-math.radians(pitch_deg))
    reach = 3 * camera_height / math.sin(-math.radians(pitch_deg)) ** 1.5
    while len(boxes) < count:
        place = middle + random.uniform(-1, 1) * reach, random.uniform(-1, 1) * reach
        box = person(camera_height, pitch_deg, *place, BODY_HEIGHT_M * random.normal(1, 0.06), random.normal(0.6, 0.1))
        if box is not None and box[3] - box[1] >= 4:
            boxes.append([math.floor(box[0]), math.floor(box[1]), math.ceil(box[2]), math.ceil(box[3])])
    return np.array(boxes, dtype=np.float64)


class Views(unittest.TestCase):
    def test_cameras_are_found_by_the_boxes(self):
        for height, pitch in ((4, -12), (8, -25), (15, -40), (25, -60), (30, -80), (20, -90)):
            found = []
            for seed in range(5):
                boxes = crowd(height, pitch, 30, seed)
                found.append(estimate_view(boxes, np.zeros(len(boxes)), WIDTH, HEIGHT, HFOV))
            found_pitch, found_height = np.median(found, axis=0)
            self.assertLess(abs(found_pitch - pitch), 6, (height, pitch, found))
            self.assertLess(abs(math.log(found_height / height)), 0.15, (height, pitch, found))

    def test_box_sizes_are_those_of_projected_bodies(self):
        for height, pitch, ahead, aside in ((4, -12, 15, 1), (20, -45, 20, -5), (20, -45, 14, 9), (40, -90, 3, 10)):
            box = np.array(person(height, pitch, ahead, aside, BODY_HEIGHT_M, 0.6))
            middle = (box[:2] + box[2:]) / 2 - np.array([WIDTH, HEIGHT]) / 2
            sizes = box_sizes(
                -math.radians(pitch),
                height - BODY_HEIGHT_M / 2,
                focal_px(WIDTH, HFOV),
                middle[None, 0],
                middle[None, 1],
            )
            np.testing.assert_allclose([sizes[0][0], sizes[1][0]], (box[2:] - box[:2])[::-1], rtol=0.04)

    def test_too_few_people_tell_nothing(self):
        few = crowd(10, -30, 3, 0)
        for boxes in (np.empty((0, 4)), few, few + [0, 0, WIDTH, HEIGHT]):
            self.assertTrue(all(map(math.isnan, estimate_view(boxes, np.zeros(len(boxes)), WIDTH, HEIGHT, HFOV))))


def call(*arguments):
    """Exit code, what was printed and what was said of errors."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            code = match.main([str(argument) for argument in arguments])
        except SystemExit as ended:
            code = ended.code
    return code, out.getvalue(), errors.getvalue()


@unittest.skipUnless(common.has("PIL"), "Pillow, which is optional, is not installed")
class RealSets(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def image(self, name, luma=120, size=(WIDTH, HEIGHT)):
        from PIL import Image

        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        Image.new("RGB", size, (luma,) * 3).save(path)

    def visdrone(self, name, boxes, luma=120, size=(WIDTH, HEIGHT)):
        self.image(f"set/images/{name}.jpg", luma, size)
        lines = [f"{x0:g},{y0:g},{x1 - x0:g},{y1 - y0:g},1,1,0,0\n" for x0, y0, x1, y1 in boxes]
        (self.root / "set/annotations").mkdir(exist_ok=True)
        (self.root / f"set/annotations/{name}.txt").write_text("".join(lines))

    def two_cameras(self):
        """Low oblique by day and from above by night."""
        for i in range(8):
            self.visdrone(f"low{i}", crowd(5, -15, 12, i), 140)
            self.visdrone(f"high{i}", crowd(25, -85, 40, i), 30)

    def test_job(self):
        self.two_cameras()
        code, said, errors = call("visdrone", self.root / "set", "-o", self.root / "made.job.json", "--views", 2)
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("16 images of 640 x 360; 50% by night", said)
        job = json.loads((self.root / "made.job.json").read_text())
        above, low = job["drones"]
        self.assertEqual(
            (above["camera"]["width"], above["camera"]["height"], above["camera"]["hfov_deg"]), (640, 360, 70)
        )
        heights = [np.median(job["randomize"][f"drones.{i}.aim.height_m"]["choice"]) for i in range(2)]
        pitches = [np.median(drone["camera"]["pitch_deg"]["choice"]) for drone in (above, low)]
        np.testing.assert_allclose(heights, [25, 5], rtol=0.2)
        np.testing.assert_allclose(pitches, [-85, -15], atol=7)
        hours = job["environment"]["time_of_day"]["choice"]
        self.assertEqual(sum(hour > "20:00" for hour in hours), len(hours) // 2)
        self.assertGreater(job["outputs"]["filters"]["min_height_px"], 4)
        self.assertLess(job["outputs"]["filters"]["min_height_px"], 20)
        checked = subprocess.run([common.THRONG, "check", self.root / "made.job.json"], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        again = self.root / "again.job.json"
        call("visdrone", self.root / "set", "-o", again, "--views", 2)
        self.assertEqual(again.read_text(), (self.root / "made.job.json").read_text())
        call("visdrone", self.root / "set", "-o", again, "--width", 320, "--limit", 6, "--seed", 3)
        smaller = json.loads(again.read_text())
        self.assertEqual(smaller["drones"][0]["camera"]["height"], 180)

    def test_images_without_people_and_heads(self):
        for i in range(3):
            self.visdrone(f"none{i}", [], size=(64 + i, 48))
        code, said, _ = call("visdrone", self.root / "set", "-o", self.root / "a.job.json")
        self.assertEqual(code, 0)
        self.assertIn("note: pitch and height: too few whole people", said)
        self.assertIn("note: sizes: found 3", said)
        self.image("heads/images/1.jpg")
        (self.root / "heads/jsons").mkdir()
        (self.root / "heads/jsons/1.json").write_text(json.dumps({"points": [[9, 9]] * 50}))
        code, said, _ = call("nwpu", self.root / "heads", "-o", self.root / "b.job.json")
        self.assertEqual(code, 0)
        self.assertRegex(said, "box height / image width +not measured")
        self.assertIn("no boxes of people", said)
        job = json.loads((self.root / "b.job.json").read_text())
        preset = json.loads((common.ROOT / "scenarios/presets/counting.job.json").read_text())
        self.assertEqual(job["outputs"], preset["outputs"])
        self.assertEqual(job["drones"][0]["camera"]["pitch_deg"], preset["drones"][0]["camera"]["pitch_deg"])
        for name in "ab":
            checked = subprocess.run([common.THRONG, "check", self.root / f"{name}.job.json"], capture_output=True)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_errors(self):
        (self.root / "set").mkdir()
        self.visdrone("a", crowd(8, -30, 9, 0))
        wrong = self.root / "wrong.json"
        wrong.write_text("[]")
        good = "visdrone", self.root / "set"
        for arguments, message in (
            (("visdrone", self.root / "none"), "found no such folder"),
            (("mot", self.root / "set"), "expected img1/ and gt/gt.txt"),
            ((*good, "--job", wrong), "found list, expected a job"),
            ((*good, "--job", self.root / "none.json"), "none.json: found no JSON that can be read"),
            ((*good, "-o", self.root / "none/a.json"), "none/a.json: cannot be written"),
            ((*good, "--hfov", "200"), "--hfov: found 200, expected 5 to 150"),
            ((*good, "--pilot", "x"), "--pilot: expected --job"),
            ((*good, "--thin", self.root / "none"), "none"),
            (("visdron", self.root), "invalid choice"),
        ):
            code, _, errors = call(*arguments)
            self.assertEqual(code, 2, arguments)
            self.assertIn(message, errors)
        self.assertEqual(call(*good)[0], 0)
        wrong.write_text("{}")
        self.assertIn("the base job: found no drones", call(*good, "--job", wrong)[2])
        # Damage between beginning and end shows when the image is decoded.
        path = self.root / "set/images/a.jpg"
        content = bytearray(path.read_bytes())
        content[2:40] = bytes(38)
        path.write_bytes(content)
        self.assertIn("a.jpg: found no whole image", call(*good)[2])

    def test_correction(self):
        def some(height, count, light):
            columns = {name: np.full(20, np.nan) for name in match.COLUMNS}
            spread = np.exp(np.linspace(-0.5, 0.5, 20))
            columns.update(box_height=height * spread, count=count * spread, brightness=np.full(20, light))
            return match.Measures(**columns, heights=height * spread, whole_heights=np.empty(0))

        job = {
            "drones": [{"camera": {"sensor": {"ev": {"uniform": [-0.5, 0.5]}}}}],
            "randomize": {
                "drones.0.aim.height_m": {"log_uniform": [10, 40]},
                "crowd.agents": {"choice": [50, 100, 200]},
            },
        }
        corrected = match.correct_job(job, some(0.1, 30, 0.5), some(0.05, 60, 0.37))
        heights = corrected["randomize"]["drones.0.aim.height_m"]["choice"]
        self.assertAlmostEqual(float(np.median(heights)), 10, delta=0.3)
        self.assertEqual(corrected["randomize"]["crowd.agents"]["choice"], [25, 50, 100])
        self.assertAlmostEqual(np.mean(corrected["drones"][0]["camera"]["sensor"]["ev"]["choice"]), 1, delta=0.05)
        self.assertEqual(
            match.correct_job(job, some(0.1, 30, 0.5), some(0.1, 30, 0.5))["randomize"]["crowd.agents"],
            job["randomize"]["crowd.agents"],
        )


@unittest.skipUnless(os.environ.get("THRONG_LONG"), "takes minutes: with THRONG_LONG")
class Made(unittest.TestCase):
    """Datasets of throng, exported, stand for photographs; images of the job that matches them have their figures."""

    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.preset = json.loads((common.ROOT / "scenarios/presets/detection.job.json").read_text())
        cls.preset["runs"] = 6
        cls.preset["capture"] = {"rate_hz": 0.1, "from_s": 10, "to_s": 30}
        cls.preset["outputs"]["formats"] = ["visdrone-det", "mot"]
        cls.preset["outputs"]["splits"] = {"train": 1}
        cls.preset["drones"][0]["camera"].update(width=640, height=360)
        cls.made_by_preset = throng.Dataset(cls.made(cls.preset, "preset"))

    @classmethod
    def made(cls, job, name):
        file = cls.root / f"{name}.job.json"
        file.write_text(json.dumps(job))
        subprocess.run([common.THRONG, "run", file, "-o", cls.root / name], check=True, capture_output=True)
        return cls.root / name / "dataset"

    def assert_matched(self, kind, layout, height, pitch, hours):
        source = json.loads(json.dumps(self.preset))
        source["drones"][0]["camera"].update(hfov_deg=HFOV, pitch_deg={"uniform": [pitch - 3, pitch + 3]})
        source["environment"]["time_of_day"] = {"uniform": hours}
        source["randomize"]["drones.0.aim.height_m"] = {"uniform": [0.9 * height, 1.1 * height]}
        source["randomize"]["crowd.agents"] = {"uniform": [150, 300]}
        folder = self.made(source, f"source_{kind}") / "formats" / layout
        output = self.root / f"{kind}.job.json"
        code, _, errors = call(kind, folder, "-o", output, "--views", 2)
        self.assertEqual((code, errors), (0, ""))
        job = {**json.loads(output.read_text()), "runs": 6, "seed": 99}
        real = match.measure_real(throng.open_real_set(kind, folder), hfov_deg=HFOV, limit=100, seed=0)
        figures = {}
        matched = throng.Dataset(self.made(job, f"{kind}_matched"))
        for name, data in (("preset", self.made_by_preset), ("matched", matched)):
            figures[name] = match.measure_dataset(data, hfov_deg=HFOV, whole=kind == "mot", min_height=real.smallest)
        # By day the preset is about as bright as any set.
        is_night = np.median(real.brightness) < 0.3
        for column in ("box_height", "pitch_deg", "camera_height_m", *(["brightness"] if is_night else [])):
            far, near = (match.distance(real.known(column), figures[name].known(column)) for name in figures)
            self.assertLess(near, 0.75 * far, (kind, column))
        medians = [float(np.median(each.heights)) for each in (real, figures["matched"])]
        self.assertLess(abs(math.log(medians[1] / medians[0])), 0.25)

    def test_low_by_day(self):
        self.assert_matched("mot", "mot/train", 4, -12, ["10:00", "15:00"])

    def test_from_above_by_night(self):
        self.assert_matched("visdrone", "visdrone-det", 40, -80, ["21:00", "23:30"])


class Thin(unittest.TestCase):
    def measures(self, heights, counts):
        columns = {name: np.ones(len(heights)) for name in match.COLUMNS}
        columns.update(box_height=np.array(heights), count=np.array(counts))
        return match.Measures(**columns, heights=np.array(heights), whole_heights=np.empty(0))

    def test_joint_distribution(self):
        """Large people are few and small ones many in the real set, in the other set sizes and counts are independent."""
        random = np.random.default_rng(1)
        large = random.random(200) < 0.3
        real = self.measures(np.where(large, 0.2, 0.02), np.where(large, 5.0, 80.0))
        made_large, made_few = random.random(400) < 0.5, random.random(400) < 0.5
        made = self.measures(np.where(made_large, 0.2, 0.02), np.where(made_few, 5.0, 80.0))
        chosen = match.choose_frames(real, made, 100)
        self.assertEqual(len(set(chosen)), 100)
        self.assertTrue((made_large[chosen] == made_few[chosen]).all())
        self.assertAlmostEqual(made_large[chosen].mean(), large.mean(), delta=0.03)
        self.assertEqual(chosen, match.choose_frames(real, made, 100))
        with self.assertRaisesRegex(ValueError, "count: found 401, expected 1 to 400"):
            match.choose_frames(real, made, 401)

    def test_list_of_frames(self):
        dataset = throng.Dataset(common.dataset_folder())
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "some.frames.json"
            names = [dataset[i].file_name for i in (3, 1)]
            match.write_frame_list(path, common.dataset_folder(), names)
            self.assertEqual([frame.file_name for frame in throng.Dataset(path)], names)
            with self.assertRaisesRegex(throng.OutputFileError, "ends with .frames.json"):
                match.write_frame_list(path.with_suffix(".txt"), common.dataset_folder(), names)
            match.write_frame_list(path, common.dataset_folder(), ["images/none.jpg"])
            with self.assertRaisesRegex(DatasetError, "found the frame 'images/none.jpg'"):
                throng.Dataset(path)
            path.write_text('{"frames": 3}')
            with self.assertRaisesRegex(DatasetError, 'expected an object with "dataset"'):
                throng.Dataset(path)


if __name__ == "__main__":
    common.main()
