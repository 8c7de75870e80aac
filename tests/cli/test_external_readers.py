"""Exports read with tools that nobody here wrote: Python's own library, NumPy and Pillow, and h5py, SciPy, OpenCV and
torchvision where Debian's packages of them are installed (python3-h5py, python3-scipy, python3-opencv,
python3-torchvision). Missing packages are skipped, with a message; in CI, which has them all (scripts/packages.txt), they
are a fault."""
import configparser
import csv
import importlib.util
import json
import os
import pathlib
import sys
import tarfile
import tempfile
import types
import unittest
import xml.etree.ElementTree

import numpy
from PIL import Image

from program import made, printed, throng


JOB = {
    "name": "external readers",
    "scenario": "city_square/nearest_exit",
    "seed": 5,
    "runs": 2,
    "drones": [
        {
            "id": "d1",
            "start": [-24, -6, 14],
            "camera": {"width": 320, "height": 200, "hfov_deg": 80, "pitch_deg": -40, "yaw_deg": -90},
        }
    ],
    "capture": {"rate_hz": 1, "from_s": 6, "to_s": 9},
    "outputs": {
        "annotations": """
            coco keypoints skeletons amodal heads difficulty density depth instances flow fields sensors
            semantic trajectories""".split()
    },
}


def needs(module):
    def missing(test):
        raise AssertionError(f"{module} is not installed (scripts/packages.txt)")

    if importlib.util.find_spec(module):
        return lambda test: test
    return (lambda test: missing) if os.environ.get("CI") else unittest.skip(f"{module} is not installed")


def mask_of(segmentation):
    """Pixels of a mask, from the description of COCO's compressed run lengths."""
    height, width = segmentation["size"]
    runs, value, shift = [], 0, 0
    for code in segmentation["counts"].encode():
        group = code - 48
        value |= (group & 31) << shift
        shift += 5
        if group & 32:
            continue
        if group & 16:
            value -= 1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
        value, shift = 0, 0
    pixels = numpy.repeat(numpy.arange(len(runs)) % 2, runs)
    return pixels.reshape(width, height).T


def install_stand_in_for_pycocotools():
    """The part of pycocotools.coco.COCO that torchvision needs, from the format's description."""

    class COCO:
        def __init__(self, path):
            content = json.loads(pathlib.Path(path).read_text())
            self.imgs = {image["id"]: image for image in content["images"]}
            self.of_image = {}
            self.anns = {}
            for annotation in content["annotations"]:
                self.of_image.setdefault(annotation["image_id"], []).append(annotation["id"])
                self.anns[annotation["id"]] = annotation

        def getAnnIds(self, image):  # noqa: N802
            return self.of_image.get(image, [])

        def loadAnns(self, ids):  # noqa: N802
            return [self.anns[i] for i in ids]

        def loadImgs(self, image):  # noqa: N802
            return [self.imgs[image]]

        def annToMask(self, annotation):  # noqa: N802
            return mask_of(annotation["segmentation"])

    package, module = types.ModuleType("pycocotools"), types.ModuleType("pycocotools.coco")
    module.COCO = COCO
    sys.modules.update({"pycocotools": package, "pycocotools.coco": module})


class ExternalReaders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        made(base, JOB)
        cls.dataset = base / "job/dataset"
        formats = [line.split()[0] for line in printed("export", "--list").splitlines()]
        cls.out = base / "out"
        throng("export", cls.dataset, "-o", cls.out, "--formats", ",".join(formats), "--split", "val=run001")
        cls.coco = json.loads((cls.dataset / "annotations/instances.json").read_text())
        cls.images = {image["id"]: image for image in cls.coco["images"]}

    @staticmethod
    def stem(image):
        return f"{image['run']}-{image['camera_id']}-{image['frame']:06}"

    def people(self, image):
        return [person for person in self.coco["annotations"] if person["image_id"] == image["id"]]

    def heads(self, image):
        heads = [person["head"] for person in self.people(image) if person["head"]]
        return [h for h in heads if 0 <= h[0] < image["width"] and 0 <= h[1] < image["height"]]

    @needs("h5py")
    def test_h5py_reads_densities(self):
        import h5py

        for image in self.coco["images"]:
            split = "train" if image["run"] == "run000" else "val"
            for kind in ("shanghaitech", "shanghaitech-adaptive", "shanghaitech-perspective"):
                path = self.out / kind / f"{split}_data/ground_truth/IMG_{self.stem(image)}.h5"
                with h5py.File(path) as file:
                    density = file["density"][:]
                self.assertEqual(density.shape, (image["height"], image["width"]))
                self.assertEqual(density.dtype, numpy.float32)
                count = len(self.heads(image))
                self.assertAlmostEqual(density.sum(dtype=numpy.float64), count, delta=1e-3 * max(count, 1))

    @needs("scipy")
    def test_scipy_reads_points(self):
        import scipy.io

        for image in self.coco["images"]:
            split = "train" if image["run"] == "run000" else "val"
            path = self.out / f"shanghaitech/{split}_data/ground_truth/GT_IMG_{self.stem(image)}.mat"
            points = scipy.io.loadmat(path)["image_info"][0, 0][0, 0][0]
            numpy.testing.assert_allclose(points, numpy.array(self.heads(image)).reshape(-1, 2) + 0.5, atol=1e-9)

    @needs("cv2")
    def test_opencv_reads_exr_flow_and_calibration(self):
        os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
        import cv2

        image = self.coco["images"][1]
        depth = cv2.imread(str(self.out / f"depth-exr/run000-d1/{self.stem(image)}.exr"), cv2.IMREAD_UNCHANGED)
        place = image["file_name"].split("/", 1)[1].replace(".jpg", ".png")
        png = cv2.imread(str(self.dataset / "depth" / place), cv2.IMREAD_UNCHANGED)
        numpy.testing.assert_allclose(depth[png > 0], png[png > 0] / 100.0, atol=1e-4)
        self.assertTrue(numpy.isinf(depth[png == 0]).all())
        flow = cv2.readOpticalFlow(str(self.out / f"flow-flo/run000-d1/{self.stem(image)}.flo"))
        kitti = cv2.imread(str(self.dataset / "flow" / place), cv2.IMREAD_UNCHANGED)
        known = kitti[:, :, 0] == 1
        numpy.testing.assert_allclose(flow[known][:, 0], (kitti[known][:, 2] - 32768.0) / 64, atol=1e-5)
        storage = cv2.FileStorage(str(self.dataset / "cameras/run000/d1.opencv.yaml"), cv2.FILE_STORAGE_READ)
        numpy.testing.assert_allclose(storage.getNode("camera_matrix").mat(), image["camera"]["K"])

    @needs("cv2")
    def test_opencv_fills_yolo_polygons_to_the_masks(self):
        """Polygons run through the middles of border pixels (docs/formats_export.md): filled, they are the masks. Pieces that
        are apart are joined to the largest one by lines of at most as many pixels as they have, or else left out."""
        import cv2

        whole = 0
        for image in self.coco["images"]:
            split = "train" if image["run"] == "run000" else "val"
            lines = (self.out / f"yolo-segment/labels/{split}/{self.stem(image)}.txt").read_text().splitlines()
            people = self.people(image)
            self.assertEqual(len(lines), len(people))
            for line, person in zip(lines, people):
                corners = numpy.array(line.split()[1:], float).reshape(-1, 2) * (image["width"], image["height"])
                filled = numpy.zeros((image["height"], image["width"]), numpy.uint8)
                cv2.fillPoly(filled, [numpy.floor(corners).astype(numpy.int32)], 1)
                mask = mask_of(person["segmentation"]).astype(numpy.uint8)
                sizes = numpy.bincount(cv2.connectedComponents(mask, connectivity=8)[1].ravel())[1:]
                self.assertLessEqual(int((filled != mask).sum()), int(sizes.sum() - sizes.max()))
                whole += len(sizes) == 1
        self.assertGreater(whole, 20)

    @needs("torchvision")
    def test_torchvision_reads_coco(self):
        if not importlib.util.find_spec("pycocotools"):  # Debian 12 has none
            install_stand_in_for_pycocotools()
        from torchvision.datasets import CocoDetection

        data = CocoDetection(self.out / "coco/train", self.out / "coco/annotations/instances_train.json")
        self.assertEqual(len(data), 4)
        for picture, target in data:
            self.assertEqual(picture.size, (320, 200))
            for annotation in target:
                mask = numpy.asarray(data.coco.annToMask(annotation))
                self.assertEqual(int(mask.sum()), annotation["area"])
                rows, columns = numpy.nonzero(mask)
                self.assertEqual(
                    [columns.min(), rows.min(), numpy.ptp(columns) + 1, numpy.ptp(rows) + 1], annotation["bbox"]
                )
        self.assertGreater(len(target), 10)

    @needs("torchvision")
    def test_torchvision_reads_cityscapes(self):
        from torchvision.datasets import Cityscapes

        images = 0
        seen = 0
        for split in ("train", "val"):
            kinds = ["semantic", "instance", "color"]
            for picture, (labels, instances, _) in Cityscapes(self.out / "cityscapes", split, "fine", kinds):
                ids = numpy.asarray(labels)
                self.assertEqual(picture.size, ids.shape[::-1])
                self.assertTrue({7, 8, 11} & set(numpy.unique(ids)), "ground or buildings")
                people = numpy.asarray(instances)[ids == 24]
                self.assertTrue((people // 1000 == 24).all())
                seen += len(numpy.unique(people))
                images += 1
        self.assertGreater(seen, 10)
        self.assertEqual(images, len(self.coco["images"]))

    def test_numpy_reads_trajectories(self):
        values = numpy.load(self.dataset / "trajectories/run000.npy")
        tracks = json.loads((self.dataset / "trajectories/run000.json").read_text())["track_ids"]
        expected = {
            (tracks[person], frame): values[frame, person, :2]
            for frame, person in zip(*numpy.nonzero(~numpy.isnan(values[..., 0])))
        }
        text = numpy.loadtxt(self.out / "jupedsim/train/run000.txt")
        self.assertEqual({(int(row[0]), int(row[1])) for row in text}, set(expected))
        for row in text:
            numpy.testing.assert_allclose(row[2:4], expected[int(row[0]), int(row[1])], atol=6e-5)
        rows = numpy.loadtxt(self.out / "eth-ucy/train/run000.txt")
        numpy.testing.assert_array_equal(rows, text[:, [1, 0, 2, 3]])
        done = printed("metrics", "--trajectory", self.out / "jupedsim/train/run000.txt", "--scenario", JOB["scenario"])
        self.assertEqual(json.loads(done)["people"], len(tracks))

    def head_people(self, image):
        """People whose heads are in the image, in the records' order."""
        return [
            person
            for person in self.people(image)
            if person["head"] and 0 <= person["head"][0] < image["width"] and 0 <= person["head"][1] < image["height"]
        ]

    def share_of_head(self, person):
        """The visible share of the person's pixels in the box of the head, from the masks."""
        x, y, width, height = person["head_box"]
        shares = []
        for key in ("segmentation", "amodal_segmentation"):
            mask = mask_of(person[key])
            rows, columns = numpy.mgrid[: mask.shape[0], : mask.shape[1]] + 0.5
            inside = (columns >= x) & (columns < x + width) & (rows >= y) & (rows < y + height)
            shares.append(int((mask.astype(bool) & inside).sum()))
        return shares[0] / shares[1] if shares[1] else person["visibility"]

    def test_openpose_jta_and_wholebody_are_one_skeleton(self):
        """JTA's places in the camera's frame project to its pixels, and the formats agree on joints that they share."""
        rows_of = {}
        for image in self.coco["images"]:
            split = "train" if image["run"] == "run000" else "val"
            name = f"jta/annotations/{split}/{image['run']}-{image['camera_id']}.json"
            if name not in rows_of:
                rows_of[name] = numpy.array(json.loads((self.out / name).read_text())).reshape(-1, 10)
            rows = rows_of[name][rows_of[name][:, 0] == image["frame"] + 1]
            k = numpy.array(image["camera"]["K"])
            ahead = rows[:, 7] > 0.5
            pixels = rows[ahead, 5:8] @ k.T
            pixels = pixels[:, :2] / pixels[:, 2:] + 0.5
            numpy.testing.assert_allclose(pixels, rows[ahead, 3:5], atol=0.1)
            name = f"openpose/{split}/json/{self.stem(image)}_keypoints.json"
            people = json.loads((self.out / name).read_text())["people"]
            feet = json.loads((self.out / f"coco-wholebody/annotations/coco_wholebody_{split}_v1.0.json").read_text())
            feet = {
                record["track_id"]: record["foot_kpts"]
                for record in feet["annotations"]
                if record["image_id"] == image["id"]
            }
            self.assertEqual(len(people), len(rows) // 22)
            for number, person in enumerate(people):
                joints = numpy.array(person["pose_keypoints_2d"]).reshape(25, 3)
                mine = rows[22 * number : 22 * number + 22]
                for body_25, jta in ((2, 4), (3, 5), (4, 6), (9, 16), (10, 17), (14, 21)):
                    if joints[body_25, 2] > 0:
                        numpy.testing.assert_allclose(joints[body_25, :2], mine[jta, 3:5], atol=0.006)
                        self.assertEqual(joints[body_25, 2] == 1, mine[jta, 8] == 0)
                foot = numpy.array(feet[person["person_id"][0]]).reshape(6, 3)
                numpy.testing.assert_allclose(joints[19:25, :2], foot[:, :2], atol=1e-9)

    def test_nwpu_as_its_authors_read_it(self):
        # Wang et al., 2020: lists of name, luminance and scene level; jsons/ with points and boxes of corners.
        root, number = self.out / "nwpu", 0
        lists = {
            split: [line.split() for line in (root / f"{split}.txt").read_text().splitlines()]
            for split in ("train", "val")
        }
        self.assertEqual(sum(map(len, lists.values())), len(self.coco["images"]))
        for image in self.coco["images"]:
            number += 1
            name = f"{number:04}"
            split = "train" if image["run"] == "run000" else "val"
            (row,) = [row for row in lists[split] if row[0] == name]
            record = json.loads((root / f"jsons/{name}.json").read_text())
            people = self.head_people(image)
            self.assertEqual((record["img_id"], record["human_num"]), (f"{name}.jpg", len(people)))
            self.assertEqual(record["points"], [person["head"] for person in people])
            boxes = numpy.array([person["head_box"] for person in people]).reshape(-1, 4)
            boxes[:, 2:] += boxes[:, :2]
            numpy.testing.assert_allclose(numpy.array(record["boxes"]).reshape(-1, 4), boxes, atol=0.006)
            picture = Image.open(root / f"images/{name}.jpg").convert("L")
            self.assertEqual(int(row[1]), min(3, int(numpy.asarray(picture).mean() / 255 * 4)))
            self.assertEqual(int(row[2]), numpy.searchsorted([0, 100, 500, 5000], len(people)))
            if importlib.util.find_spec("scipy"):
                import scipy.io

                mat = scipy.io.loadmat(root / f"mats/{name}.mat")
                numpy.testing.assert_allclose(mat["annPoints"], numpy.array(record["points"]).reshape(-1, 2))
                numpy.testing.assert_allclose(mat["annBoxes"], numpy.array(record["boxes"]).reshape(-1, 4))

    def test_jhu_crowd_as_its_authors_describe_it(self):
        # Sindagi et al., 2020: x y w h occlusion blur; name,count,scene,weather,distractor.
        number, levels = 0, set()
        for image in self.coco["images"]:
            number += 1
            root = self.out / "jhu-crowd" / ("train" if image["run"] == "run000" else "val")
            labels = [line.split(",") for line in (root / "image_labels.txt").read_text().splitlines()]
            (row,) = [row for row in labels if row[0] == f"{number:04}"]
            people = self.head_people(image)
            self.assertEqual(row[1:], [str(len(people)), JOB["scenario"], "0", str(int(not people))])
            lines = (root / f"gt/{number:04}.txt").read_text().splitlines()
            self.assertEqual(len(lines), len(people))
            for line, person in zip(lines, people):
                x, y, width, height, occlusion, blur = map(int, line.split())
                self.assertEqual([x, y], [int(value) for value in person["head"]])
                numpy.testing.assert_allclose([width, height], numpy.maximum(person["head_box"][2:], 1), atol=0.51)
                share = self.share_of_head(person)
                if person["head_visibility"] is not None:  # else a head of no pixel
                    self.assertAlmostEqual(share, person["head_visibility"], delta=6e-4)
                self.assertEqual(occlusion, 1 if share >= 0.95 else 2 if share > 0.05 else 3)
                self.assertEqual(blur, 0, "nothing is blurred without an exposure time")
                levels.add(occlusion)
            self.assertEqual(Image.open(root / f"images/{number:04}.jpg").size, (320, 200))
        self.assertGreaterEqual(levels, {1, 2})

    def test_up_count_as_its_authors_load_it(self):
        # github.com/up-count/uav-dot: a list of sequences; labels beside images, x y; the name ends with the height.
        root, images = self.out / "up-count", {image["file_name"]: image for image in self.coco["images"]}
        found = 0
        for split, run in (("train", "run000"), ("val", "run001")):
            for sequence in (root / f"{split}.txt").read_text().splitlines():
                for frame, path in enumerate(sorted((root / "images" / sequence).glob("*.jpg"))):
                    image = images[f"images/{run}/d1/{frame:06}.jpg"]
                    self.assertAlmostEqual(
                        float(str(path).split("__")[-1][:-4]), image["flight"]["true"]["height_m"], delta=0.006
                    )
                    label = str(path).replace("images", "labels").replace(".jpg", ".txt")
                    points = numpy.loadtxt(label, dtype=numpy.float32).reshape(-1, 2)
                    expected = numpy.array([person["head"] for person in self.head_people(image)]).reshape(-1, 2)
                    numpy.testing.assert_array_equal(points, numpy.floor(expected))
                    found += 1
        self.assertEqual(found, len(images))

    def test_moving_drone_crowd_as_its_authors_load_it(self):
        # github.com/fyw1999/MovingDroneCrowd: rows of frame (from 0), identity, left, top, width, height.
        root = self.out / "movingdronecrowd"
        for split, run in (("train", "run000"), ("val", "run001")):
            self.assertEqual((root / f"{split}.txt").read_text().split(), [f"{run}/d1"])
            rows = numpy.loadtxt(root / f"annotations/{run}/d1.csv", delimiter=",", ndmin=2)
            frames = sorted((root / "frames" / run / "d1").iterdir(), key=lambda path: int(path.stem))
            images = [image for image in self.coco["images"] if image["run"] == run]
            self.assertEqual(len(frames), len(images))
            seen, inflow = set(), 0
            for path, image in zip(frames, images):
                people = self.head_people(image)
                here = rows[rows[:, 0] == int(path.stem) - 1]
                self.assertEqual(here[:, 1].tolist(), [person["track_id"] % 1000000 for person in people])
                numpy.testing.assert_allclose(here[:, 2:6], [person["head_box"] for person in people], atol=1e-9)
                inflow += len(set(here[:, 1]) - seen)
                seen |= set(here[:, 1])
            self.assertEqual(inflow, len(numpy.unique(rows[:, 1])), "individuals of the clip")

    def test_tarfile_reads_webdataset(self):
        with tarfile.open(self.out / "webdataset/train-000000.tar") as archive:
            names = archive.getnames()
            self.assertEqual([name.split(".")[0] for name in names[::2]], [name.split(".")[0] for name in names[1::2]])
            picture = Image.open(archive.extractfile(names[0]))
            self.assertEqual(picture.size, (320, 200))
            sample = json.load(archive.extractfile(names[1]))
        self.assertEqual(len(sample["annotations"]), len(self.people(sample)))

    def test_configparser_and_numpy_read_mot(self):
        sequence = self.out / "mot/train/run000-d1"
        info = configparser.ConfigParser()
        info.read(sequence / "seqinfo.ini")
        self.assertEqual(int(info["Sequence"]["seqLength"]), 4)
        rows = numpy.loadtxt(sequence / "gt/gt.txt", delimiter=",", ndmin=2)
        self.assertEqual(rows.shape[1], 9)
        keys = {(row[0], row[1]) for row in rows}
        self.assertEqual(len(keys), len(rows), "a track is in a frame once")
        self.assertTrue((rows[:, 1] > 0).all() and rows[:, 0].min() == 1)

    def test_xml_and_csv_are_read_by_pythons_library(self):
        boxes = xml.etree.ElementTree.parse(self.out / "cvat/annotations.xml").findall("image/box")
        self.assertEqual(len(boxes), len(self.coco["annotations"]))
        with open(self.out / "table/people.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(self.coco["annotations"]))
        tracks = {track["id"]: track for track in self.coco["tracks"]}
        for row, person in zip(rows, self.coco["annotations"]):
            self.assertEqual(int(row["track_id"]), person["track_id"])
            self.assertEqual(row["state"], person["state"])
            self.assertEqual(row["sex"], tracks[person["track_id"]]["attributes"]["sex"])

    def test_fields_on_the_ground_sum_to_the_people(self):
        grid = json.loads((self.dataset / "fields/run000.json").read_text())
        for frame, people in enumerate(grid["people"]):
            field = numpy.load(self.dataset / f"fields/run000/{frame:06}.npy")
            self.assertEqual(field.shape, (4, grid["rows"], grid["columns"]))
            self.assertAlmostEqual(field[0].sum(dtype=numpy.float64) * grid["cell_m"] ** 2, people, places=3)
        self.assertGreater(people, 100)

    def test_validation_finds_no_faults(self):
        self.assertIn("no faults", printed("validate", self.dataset))


if __name__ == "__main__":
    unittest.main(verbosity=2)
