"""Spectators of a stand, end to end: boxes lie where a camera model of this test's own sees their seats, and a dataset
with people who sit, cheer and leave passes the checks."""
import json
import math
import unittest

from program import FolderTest, printed, throng, write_json

ROWS, DEPTH, RISE, FRONT = 6, 0.85, 0.38, 1.0
STAND = {"id": "main", "from": [-15, -3], "to": [15, -3], "rows": ROWS, "front_height_m": FRONT}
CAMERA = {"width": 1280, "height": 720, "hfov_deg": 75, "pitch_deg": -20, "yaw_deg": -90}
START = [0, 14, 9]


def blueprint(spectators):
    return {
        "name": "Ground",
        "ground": {"min": [-40, -30], "max": [40, 40], "material": "grass"},
        "inside": {"min": [-20, -3], "max": [20, 20]},
        "exits": [
            {"id": "east", "from": [20, 4], "to": [20, 10]},
            {"id": "west", "from": [-20, 10], "to": [-20, 4]},
        ],
        "stands": [{**STAND, "spectators": spectators}],
        "drones": [{"id": "d1", "start": START}],
        "people": {"lines": [{"from": [8, 12], "to": [11, 12], "count": 3}]},
    }


def job(to_s, annotations=("coco",)):
    return {
        "scenario": "ground",
        "capture": {"from_s": 0, "to_s": to_s, "rate_hz": 0.5},
        "drones": [{"id": "d1", "start": START, "camera": CAMERA}],
        "outputs": {"annotations": list(annotations)},
    }


def pixel_of(x, y, z):
    """A pinhole camera that looks along -y and 20 degrees down."""
    focal = CAMERA["width"] / 2 / math.tan(math.radians(CAMERA["hfov_deg"] / 2))
    down = math.radians(-CAMERA["pitch_deg"])
    right, ahead, up = -(x - START[0]), -(y - START[1]), z - START[2]
    depth = ahead * math.cos(down) - up * math.sin(down)
    below = -ahead * math.sin(down) - up * math.cos(down)
    return CAMERA["width"] / 2 + focal * right / depth, CAMERA["height"] / 2 + focal * below / depth


def row_of(y):
    return int((-3 - y) / DEPTH)


class Stands(FolderTest):
    def dataset(self, spectators, to_s, annotations=("coco",)):
        write_json(self.folder / "ground.blueprint.json", blueprint(spectators))
        variables = {"THRONG_SCENARIOS": self.folder}
        file = write_json(self.folder / "job.json", job(to_s, annotations))
        throng("run", file, "-o", self.folder / "job", variables=variables)
        return self.folder / "job" / "dataset"

    def test_boxes_are_at_the_seats(self):
        dataset = self.dataset({"count": 120, "seed": 2}, 2)
        coco = json.loads((dataset / "annotations" / "instances.json").read_text(encoding="utf-8"))
        first = min(image["id"] for image in coco["images"])
        people = [a for a in coco["annotations"] if a["image_id"] == first and a["position"][2] > 0.05]
        self.assertGreater(len(people), 60)
        for person in people:
            x, y, z = person["position"]
            self.assertAlmostEqual(z, FRONT + RISE * row_of(y), places=3)
            u, v = pixel_of(x, y, z + 0.6)
            left, top, width, height = person["bbox_amodal"]
            self.assertTrue(left <= u <= left + width and top <= v <= top + height, person["bbox_amodal"])

    def test_a_dataset_with_people_who_leave_is_valid(self):
        kinds = ("coco", "keypoints", "heads", "density", "trajectories", "events", "actions", "fields", "counts")
        dataset = self.dataset({"count": 60, "seed": 2, "leave_at_s": 4}, 60, kinds)
        throng("validate", dataset)
        figures = json.loads((dataset / "metrics.json").read_text(encoding="utf-8"))
        self.assertIn("runs", figures)

    def test_more_spectators_than_seats_are_refused(self):
        write_json(self.folder / "ground.blueprint.json", blueprint({"count": 5000}))
        file = write_json(self.folder / "job.json", job(2))
        said = printed("check", file, code=2, variables={"THRONG_SCENARIOS": self.folder})
        self.assertIn("/stands/0/spectators/count", said)
        self.assertIn("its seats", said)


if __name__ == "__main__":
    unittest.main()
