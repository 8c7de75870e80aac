"""Exports of several cameras that look at the same people, read as their users do: crops for re-identification
(Market-1501) and places on a grid (WILDTRACK), with NumPy, Pillow and Python's own library."""
import csv
import json
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree

import numpy
from PIL import Image

from program import made


def two_camera(yaw_deg, **more):
    return {"width": 960, "height": 600, "hfov_deg": 62, "yaw_deg": yaw_deg, "pitch_deg": -45, **more}


# Two drones that look at the same people from both sides.
JOB = {
    "name": "several cameras",
    "scenario": "city_square/nearest_exit",
    "seed": 9,
    "runs": 2,
    "crowd": {"agents": 150},
    "drones": [
        {"id": "d1", "start": [0, -14, 14], "camera": two_camera(0)},
        {
            "id": "d2",
            "start": [0, 10, 14],
            "camera": two_camera(-90, model="brown_conrady", distortion={"k1": -0.2, "k2": 0.05}),
        },
    ],
    "capture": {"rate_hz": 1, "from_s": 6, "to_s": 8},
    "outputs": {"annotations": ["coco"], "splits": {"train": 0.5, "test": 0.5}, "formats": ["market1501", "wildtrack"]},
}


def rotation(vector):
    """Rodrigues' formula."""
    angle = numpy.linalg.norm(vector)
    x, y, z = vector / angle
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross


class SeveralCameras(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.dataset = made(base, JOB) / "dataset"
        cls.formats = cls.dataset / "formats"

    def crops(self, folder):
        """(identity, camera, pixels) as readers of Market-1501 take them from the names."""
        for path in sorted((self.formats / "market1501" / folder).glob("*.jpg")):
            identity, rest = path.name.split("_")[:2]
            with Image.open(path) as image:
                yield int(identity), int(rest[1:].split("s")[0]), numpy.array(image.convert("RGB")).astype(float)

    def test_crops_are_of_the_images(self):
        with open(self.formats / "market1501/crops.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 500)
        for row in rows[::20]:
            x, y, width, height = (int(row[key]) for key in ("x", "y", "width", "height"))
            with Image.open(self.dataset / row["image"]) as image:
                whole = numpy.array(image.convert("RGB")).astype(float)
            with Image.open(self.formats / "market1501" / row["file"]) as image:
                crop = numpy.array(image.convert("RGB")).astype(float)
            self.assertLess(numpy.abs(whole[y : y + height, x : x + width] - crop).mean(), 5)

    def test_mean_colors_find_people_in_the_other_camera(self):
        """The simplest features are far better than chance, as they are with real people."""

        def feature(pixels):
            height, width = pixels.shape[:2]
            body = pixels[:, width // 4 : max(width - width // 4, width // 4 + 1)]
            return numpy.concatenate(
                [body[height // 6 : height // 2].mean((0, 1)), body[height // 2 : -height // 12].mean((0, 1))]
            )

        gallery = [(number, camera, feature(pixels)) for number, camera, pixels in self.crops("bounding_box_test")]
        trained = {number for number, _, _ in self.crops("bounding_box_train")}
        queries = [(number, camera, feature(pixels)) for number, camera, pixels in self.crops("query")]
        self.assertGreater(len(queries), 50)
        found = chance = 0
        for number, camera, wanted in queries:
            self.assertNotIn(number, trained)
            others = [entry for entry in gallery if entry[0] != -1 and entry[:2] != (number, camera)]
            self.assertTrue(any(entry[0] == number for entry in others))
            best = min(others, key=lambda entry: numpy.abs(entry[2] - wanted).sum())
            found += best[0] == number
            chance += sum(entry[0] == number for entry in others) / len(others)
        self.assertGreater(found, 5 * chance)

    def test_wildtracks_places_are_in_the_boxes_of_all_views(self):
        looked_at = 0
        for run in ("train/run000", "test/run001"):
            folder = self.formats / "wildtrack" / run
            grid = json.loads((folder / "grid.json").read_text())
            views = [self.calibration(folder / "calibrations", number) for number in (1, 2)]
            for path in sorted((folder / "annotations_positions").glob("*.json")):
                for person in json.loads(path.read_text()):
                    row, column = divmod(person["positionID"], grid["columns"])
                    place = numpy.array(grid["origin_m"]) + grid["cell_m"] * numpy.array([column, row])
                    hips_cm = numpy.array([100 * place[0], 100 * place[1], 80])
                    for view in person["views"]:
                        if not 5 < view["xmin"] < view["xmax"] < 954 or not 5 < view["ymin"] < view["ymax"] < 594:
                            continue  # cut off, or not in this view
                        u, v = views[view["viewNum"]](hips_cm)
                        self.assertTrue(view["xmin"] - 3 <= u <= view["xmax"] + 3, (person, u))
                        self.assertTrue(view["ymin"] - 3 <= v <= view["ymax"] + 3, (person, v))
                        looked_at += 1
        self.assertGreater(looked_at, 500)

    def calibration(self, folder, number):
        """A function from a point (cm) to its pixel."""
        kind = "zero" if number == 1 else "original"
        inner = xml.etree.ElementTree.parse(folder / f"intrinsic_{kind}/intr_C{number}.xml").getroot()
        outer = xml.etree.ElementTree.parse(folder / f"extrinsic/extr_C{number}.xml").getroot()
        numbers = lambda node: numpy.array([float(text) for text in node.text.split()])  # noqa: E731
        k = numbers(inner.find("camera_matrix/data")).reshape(3, 3)
        k1, k2 = numbers(inner.find("distortion_coefficients/data"))[:2]
        turn, move = rotation(numbers(outer.find("rvec"))), numbers(outer.find("tvec"))

        def project(point):
            x, y, z = turn @ point + move
            square = (x * x + y * y) / (z * z)
            scale = (1 + k1 * square + k2 * square * square) / z
            return k[0, 0] * scale * x + k[0, 2], k[1, 1] * scale * y + k[1, 2]

        return project


if __name__ == "__main__":
    unittest.main(verbosity=2)
