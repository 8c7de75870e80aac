"""Readers of real sets: small files made here in each layout, and throng's own exports of known people."""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import common
import numpy as np
import throng
from throng import DatasetError, open_real_set


class Folder(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, text=""):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".jpg":
            from PIL import Image

            Image.new("RGB", (40, 30), (9, 99, 199)).save(path)
        else:
            path.write_text(text, encoding="latin-1")

    def assert_wrong(self, kind, *parts):
        with self.assertRaises(DatasetError) as caught:
            open_real_set(kind, self.root)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def assert_skipped(self, kind, count, *parts, folder="."):
        """The set with `count` images; what was left out is listed, and logged in one line."""
        with self.assertLogs("throng", "WARNING") as logged:
            images = open_real_set(kind, self.root / folder)
        self.assertEqual(len(images), count)
        listed = "\n".join(map(str, images.skipped))
        for part in parts:
            self.assertIn(part, listed)
        self.assertEqual(len(images.skipped), len(parts), listed)
        self.assertEqual(len(logged.output), 1)
        self.assertRegex(logged.output[0], rf": skipped {len(parts)} files?, folders? or lines?, the first {self.root}")
        return images


class VisDrone(Folder):
    def test_images(self):
        self.write("images/a.jpg")
        self.write("images/b.jpg")
        self.write("annotations/a.txt", "1,2,3,4,1,1,0,0,\n5,5,10,10,0,0,0,0\n2,2,4,4,1,4,0,0\n7,7,0,3,1,2,0,0\n\n")
        self.write("annotations/b.txt", "0,0,2,2,0,1,0,0\n0,0,2,2,1,2,0,0\n")
        images = open_real_set("visdrone", self.root)
        self.assertEqual([image.path.name for image in images], ["a.jpg", "b.jpg"])
        self.assertEqual((images[0].boxes.tolist(), images[0].hidden.tolist()), ([[1, 2, 4, 6]], [0]))
        self.assertEqual(images[0].ignored.tolist(), [[5, 5, 15, 15]])
        self.assertEqual((images[1].boxes.tolist(), images[1].ignored.tolist()), ([[0, 0, 2, 2]], [[0, 0, 2, 2]]))
        self.assertEqual(images[0].image().shape, (30, 40, 3))
        self.assertIn("2 images, 2 people", repr(images))
        self.assertEqual(len(images[1:]), 1)

    def test_videos(self):
        self.write("sequences/s/0000001.jpg")
        self.write("sequences/s/0000002.jpg")
        self.write("annotations/s.txt", "2,0,1,2,3,4,1,1,0,0\n")
        images = open_real_set("visdrone", self.root)
        self.assertEqual([(image.sequence, image.count) for image in images], [("s", 0), ("s", 1)])
        self.write("annotations/s.txt", "3,0,1,2,3,4,1,1,0,0\n")
        self.assert_skipped("visdrone", 2, "annotations/s.txt:1: found the frame 3, expected one of 2")
        self.write(
            "annotations/s.txt", "1,0,1,2,3,4,1,1,0,0\n1,0,1,2\n1,0\n\xe9,0,1\n2,0,1,2,3,4,1,1,0,0\n1,0,9,9,3,4,1,1,0,0"
        )
        parts = (
            "s.txt:2: found '1,0,1,2', expected 10 or more",
            "s.txt:3:",
            "s.txt:4: found '\ufffd,0,1', expected a frame",
        )
        (image,) = self.assert_skipped("visdrone", 1, *parts)
        self.assertEqual((image.path.name, image.count), ("0000002.jpg", 1))
        self.write("sequences/t/0000001.jpg")
        self.write("annotations/u.txt")
        parts = (*parts, "sequences/t: found no labels of this sequence", "annotations/u.txt: found no folder")
        self.assert_skipped("visdrone", 1, *parts)

    def test_errors(self):
        self.assert_wrong("visdrone", "found an empty folder; expected annotations/ with images/ or sequences/")
        self.write("images/a.jpg")
        self.write("annotations/a.txt", "1,2,3,4,1,1,0,0\n1,2,x,4\n")
        self.assert_wrong("visdrone", "annotations/a.txt:2: found '1,2,x,4', expected 8 or more numbers: left, top")
        self.write("annotations/a.txt", "1,2,3,4,1,77,0,0\n")
        self.assert_wrong("visdrone", "a.txt:1: found the category 77, expected 0 to 11")
        self.write("annotations/a.txt", "1,2,3,4,0.5,1,0,0\n")
        self.assert_wrong("visdrone", "a.txt:1: found the score 0.5, expected 1")
        self.write("annotations/a.txt")
        self.write("images/c.jpg")
        self.write("annotations/d.txt")
        parts = ["c.jpg: found no labels c, expected a file", "d.txt: found no image"]
        self.assert_skipped("visdrone", 1, *parts)
        self.write("annotations/c.txt", "1,2,3,4,1,1,0,0\n1,2,x,4\n")
        parts[0] = "c.txt:2: found '1,2,x,4'"
        images = self.assert_skipped("visdrone", 1, *parts)
        self.assertEqual((images.skipped[0].path.name, images.skipped[0].line), ("c.txt", 2))
        self.assertEqual(images[:1].skipped, images.skipped)
        (self.root / "annotations/a.txt").unlink()
        self.assert_wrong(
            "visdrone", "expected a set in the layout of visdrone\n  ", *parts, "a.jpg: found no labels a"
        )
        with self.assertRaisesRegex(ValueError, "did you mean 'visdrone'"):
            open_real_set("visdron", self.root)
        with self.assertRaisesRegex(DatasetError, "found no such folder"):
            open_real_set("mot", self.root / "absent")
        (self.root / "broken.jpg").write_text("no image")
        with self.assertRaisesRegex(DatasetError, "broken.jpg: found no whole image"):
            throng.real_sets.RealImage(self.root / "broken.jpg", "", None, np.empty((0, 4)), None).image()

    def test_damaged_images(self):
        for name in ("whole", "padded", "cut", "zeros", "text", "empty", "system"):
            self.write(f"images/{name}.jpg")
            self.write(f"annotations/{name}.txt", "1,2,3,4,1,1,0,0\n")
        jpeg = (self.root / "images/whole.jpg").read_bytes()
        for name, content in {
            "padded.jpg": jpeg + bytes(5000),
            "cut.jpg": jpeg[:-200],
            "zeros.jpg": jpeg[:-200] + bytes(200),
            "text.jpg": b"none",
            "empty.jpg": b"",
        }.items():
            (self.root / "images" / name).write_bytes(content)
        parts = [f"{name}.jpg: found no whole image" for name in ("cut", "zeros", "text", "empty")]
        images = self.assert_skipped("visdrone", 3, *parts)
        self.assertEqual([image.image().shape for image in images], [(30, 40, 3)] * 3)


class SystemFiles(Folder):
    def test_they_are_left_out_everywhere(self):
        row = "1,1,2,3,4,5,1,1,1,0\n"
        for kind, image, label, text in (
            ("visdrone", "images/1.jpg", "annotations/1.txt", "1,1,2,3,1,1,0,0\n"),
            ("visdrone", "sequences/s/1.jpg", "annotations/s.txt", row),
            ("mot", "s/img1/1.jpg", "s/gt/gt.txt", row),
            ("uavdt", "UAV-benchmark-M/s/1.jpg", "GT/s_gt_whole.txt", row),
            ("nwpu", "images/1.jpg", "jsons/1.json", '{"points": []}'),
            ("dronecrowd", "images/img001001.jpg", "annotations/1.txt", row),
            ("dronecrowd", "images/1/1.jpg", "annotations/1.txt", row),
        ):
            with self.subTest(kind=kind, image=image):
                shutil.rmtree(self.root)
                self.write(image)
                self.write(label, text)
                self.assertEqual(open_real_set(kind, self.root).skipped, ())
                parts = []
                for path in (pathlib.Path(image), pathlib.Path(label)):
                    for name in ("._" + path.name, ".DS_Store", "Thumbs.db"):
                        (self.root / path.with_name(name)).write_bytes(b"\0\5\x16\7\0\2\0\0Mac OS X\xb0")
                        if not path.name.startswith("gt"):  # MOT's folders of labels are not listed
                            parts.append(f"{path.with_name(name)}: found a file of macOS or Windows")
                self.assert_skipped(kind, 1, *parts)


class Mot(Folder):
    def test_classes_and_pets(self):
        self.write("train/MOT16-02/img1/000001.jpg")
        rows = ["1,1,11,21,5,9,1,1,0.8", "1,2,1,1,5,9,0,1,1", "1,3,1,1,2,2,1,7,1", "1,4,1,1,3,3,1,3,1"]
        self.write("train/MOT16-02/gt/gt.txt", "\n".join(rows))
        self.write("train/PETS09-S2L1/img1/000001.jpg")
        self.write("train/PETS09-S2L1/gt/gt.txt", "1,1,11,21,5.5,9,1,-7.1,3.2,0\n1,2,4,4,2,2,0,-1,-1,-1\n")
        mot, pets = open_real_set("mot", self.root)
        self.assertEqual(mot.boxes.tolist(), [[10, 20, 15, 29]])
        self.assertEqual(mot.ignored.tolist(), [[0, 0, 5, 9], [0, 0, 2, 2]])
        self.assertEqual((pets.sequence, pets.boxes.tolist()), ("PETS09-S2L1", [[10, 20, 15.5, 29]]))
        self.assertEqual(pets.ignored.tolist(), [[3, 3, 5, 5]])
        self.assertEqual(len(open_real_set("mot", self.root / "train/MOT16-02")), 1)

    def test_errors(self):
        self.assert_wrong("mot", "expected img1/ and gt/gt.txt")
        self.write("s/img1/000001.jpg")
        for text, message in {
            "1,1,1,1,1,1,3,1,1": "gt.txt:1: found 3 in the column 7, expected 0 or 1",
            "1,1,1,nan,1,1,1": "gt.txt:1: found '1,1,1,nan",
        }.items():
            self.write("s/gt/gt.txt", text)
            self.assert_wrong("mot", message)
        for text, message in {
            "2,1,1,1,1,1,1,1,1": "gt.txt:1: found the frame 2, expected one of 1 images",
            "1.5,1,1,1,1,1,1,1,1": "gt.txt:1: found '1.5,1,1,1,1,1,1,1,1', expected a frame at its beginning, a whole number",
        }.items():
            self.write("s/gt/gt.txt", text)
            self.assert_skipped("mot", 1, message)
        self.write("s/img1/thumb.jpg")
        self.write("s/gt/gt.txt")
        self.write("t/img1/000001.jpg")
        no_number = "thumb.jpg: found no number at the end of the name"
        self.assert_skipped("mot", 1, no_number, "t: found no gt/gt.txt, expected the labels of img1/")


class Uavdt(Folder):
    def test_vehicles_are_no_people(self):
        self.write("UAV-benchmark-M/M01/img000001.jpg")
        self.write("GT/M01_gt_whole.txt", "1,1,2,3,4,5,1,1,1\n1,2,6,7,2,2,1,1,4\n")
        self.write("GT/M01_gt_ignore.txt", "1,-1,0,0,9,9,-1,-1,-1\n")
        (image,) = open_real_set("uavdt", self.root)
        self.assertEqual((image.boxes.tolist(), image.ignored.tolist()), ([[6, 7, 8, 9]], [[0, 0, 9, 9]]))
        self.write("GT/M01_gt_whole.txt", "1,1,2,3,4,5,1,1,9\n")
        self.assert_wrong("uavdt", "M01_gt_whole.txt:1: found the category 9, expected 1 to 4")
        self.write("GT/M02_gt_whole.txt", "")
        self.write("GT/M01_gt_whole.txt", "")
        self.assert_skipped("uavdt", 1, "M02_gt_whole.txt: found no folder")
        self.write("GT/M01_gt_ignore.txt", "1,0,x")
        self.assert_wrong("uavdt", "M02_gt_whole.txt: found no folder", "M01_gt_ignore.txt:1: found '1,0,x'")


class MovingDroneCrowd(Folder):
    def test_frames_count_from_0(self):
        for number in (1, 2):
            self.write(f"frames/scene_1/3/{number}.jpg")
        self.write("annotations/scene_1/3.csv", "0,1,10,20,4,6,1\n1,1,11,20,4,6,1\n1,2,1,1,2,2,1\n")
        first, second = open_real_set("movingdronecrowd", self.root)
        self.assertEqual((first.sequence, first.points.tolist()), ("scene_1/3", [[12, 23]]))
        self.assertEqual((second.path.name, second.count, second.boxes), ("2.jpg", 2, None))
        self.write("annotations/scene_1/3.csv", "2,1,10,20,4,6,1\n")
        self.assert_skipped("movingdronecrowd", 2, "3.csv:1: found the frame 2, expected one of 2 images")
        self.write("annotations/scene_1/4.csv")
        parts = ("3.csv:1: found", "4.csv: found no folder")
        self.assert_skipped("movingdronecrowd", 2, *parts)
        shutil.rmtree(self.root / "frames")
        self.assert_wrong("movingdronecrowd", "found annotations/; expected frames/ and annotations/")


class UpCount(Folder):
    def test_points(self):
        self.write("test/images/0001__0001__30.5.jpg")
        self.write("test/labels/0001__0001__30.5.txt", "12 7\n20.5 3\n")
        (image,) = open_real_set("upcount", self.root)
        self.assertEqual((image.points.tolist(), image.boxes), ([[12, 7], [20.5, 3]], None))
        self.write("test/labels/0001__0001__30.5.txt", "12\n")
        self.assert_wrong("upcount", "30.5.txt:1: found '12', expected 2 or more numbers: x y")
        shutil.rmtree(self.root / "test/labels")
        self.assert_wrong("upcount", "expected images/ and labels/")


class Nwpu(Folder):
    def test_points(self):
        for name in ("0001", "0002"):
            self.write(f"images/{name}.jpg")
            self.write(f"jsons/{name}.json", json.dumps({"human_num": 2, "points": [[1.5, 2], [3, 4]]}))
        self.assertEqual([image.count for image in open_real_set("nwpu", self.root)], [2, 2])
        self.write("val.txt", "0002 1 0\n")
        (image,) = open_real_set("nwpu", self.root)
        self.assertEqual((image.boxes, image.points.tolist()), (None, [[1.5, 2], [3, 4]]))
        self.assertFalse(open_real_set("nwpu", self.root).has_boxes)

    def test_errors(self):
        self.write("images/0001.jpg")
        for content, message in {
            "{": "found no JSON",
            "[]": "/points: found NoneType, expected a list",
            '{"points": [[1, 2], [3]]}': "/points/1: found [3], expected [x, y]",
            '{"points": [[1, 2]], "human_num": 5}': "/human_num: found 5, expected 1",
        }.items():
            self.write("jsons/0001.json", content)
            self.assert_wrong("nwpu", "0001.json", message)
        self.write("val.txt", "0007 1 0\n")
        self.assert_wrong("nwpu", "val.txt:1: found '0007 1 0'")
        self.write("jsons/0001.json", '{"points": [[1, 2]]}')
        self.write("images/0002.jpg")
        self.write("val.txt", "0007 1 0\n0001 1 0\n")
        self.assert_skipped("nwpu", 1, "val.txt:1: found '0007 1 0'")
        (self.root / "val.txt").unlink()
        self.assert_skipped("nwpu", 1, "0002.jpg: found no labels 0002")


class Heads(Folder):
    def test_tracks(self):
        self.write("images/img001001.jpg")
        self.write("images/img001002.jpg")
        self.write("annotations/00001.txt", "2,5,10,20,4,6,0,0,-1,-1\n2,6,10,20,4,6,1,0,-1,-1\n")
        first, second = open_real_set("dronecrowd", self.root)
        self.assertEqual((first.count, second.points.tolist()), (0, [[12, 23]]))
        self.write("annotations/00001.txt", "3,5,10,20,4,6,0,0,-1,-1\n")
        self.assert_skipped("dronecrowd", 2, "00001.txt:1: found the frame 3, expected one of 2 images")
        self.write("annotations/00002.txt", "")
        self.write("annotations/00001.txt", "")
        self.write("images/img003001.jpg")
        unlabeled = "img003001.jpg: found no labels of its sequence"
        self.assert_skipped("dronecrowd", 2, "00002.txt: found no images", unlabeled)

    @unittest.skipIf(common.has("scipy"), "scipy is installed")
    def test_scipy_is_named(self):
        self.write("train_data/images/IMG_1.jpg")
        self.write("train_data/ground-truth/GT_IMG_1.mat")
        with self.assertRaisesRegex(throng.MissingPackageError, "python3-scipy"):
            open_real_set("shanghaitech", self.root)

    @unittest.skipUnless(common.has("scipy"), "scipy, which is optional, is not installed: .mat files are not read")
    def test_mat(self):
        import scipy.io

        heads = np.array([[1.0, 1.0], [10.5, 20.0]])
        cell = np.empty((1, 1), dtype=object)
        cell[0, 0] = {"location": heads, "number": 2.0}
        for name in ("train_data/images/IMG_1.jpg", "other/images/img002003.jpg"):
            self.write(name)
        (self.root / "train_data/ground-truth").mkdir()
        scipy.io.savemat(self.root / "train_data/ground-truth/GT_IMG_1.mat", {"image_info": cell})
        (image,) = open_real_set("shanghaitech", self.root)
        self.assertEqual(image.points.tolist(), [[0.5, 0.5], [10, 19.5]])
        (self.root / "other/ground_truth").mkdir()
        scipy.io.savemat(self.root / "other/ground_truth/GT_img002003.mat", {"image_info": cell})
        (image,) = open_real_set("dronecrowd", self.root / "other")
        self.assertEqual((image.sequence, image.count), ("002", 2))
        shutil.rmtree(self.root / "other")
        (self.root / "train_data/ground-truth/GT_IMG_1.mat").write_text("none")
        self.assert_wrong("shanghaitech", "GT_IMG_1.mat: found no MATLAB file")
        for name in ("train_data/images/IMG_2.jpg", "train_data/images/IMG_3.jpg"):
            self.write(name)
        scipy.io.savemat(self.root / "train_data/ground-truth/GT_IMG_2.mat", {"image_info": cell})
        (self.root / "train_data/ground-truth/._GT_IMG_2.mat").write_bytes(bytes(99))
        parts = (
            "GT_IMG_1.mat: found no MATLAB file",
            "IMG_3.jpg: found no labels GT_IMG_3",
            "._GT_IMG_2.mat: found a file of",
        )
        self.assert_skipped("shanghaitech", 1, *parts)
        (self.root / "train_data/ground-truth/GT_IMG_2.mat").unlink()
        scipy.io.savemat(self.root / "train_data/ground-truth/GT_IMG_1.mat", {"density": heads})
        self.assert_wrong("shanghaitech", "GT_IMG_1.mat: found density, expected image_info")


class Exports(unittest.TestCase):
    """The exports of throng in these layouts are read as the people that it knows."""

    @classmethod
    def setUpClass(cls):
        cls.out = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory())) / "out"
        formats = "visdrone-det,visdrone-mot,mot,uavdt,dronecrowd,shanghaitech"
        command = [common.THRONG, "export", common.dataset_folder(), "-o", cls.out, "--formats", formats]
        subprocess.run(command, check=True, capture_output=True, timeout=300)
        cls.dataset = throng.Dataset(common.dataset_folder())

    def read(self, kind, name):
        folders = [folder for folder in sorted((self.out / name).iterdir()) if folder.name != "seqmaps"]
        images = [image for folder in folders for image in open_real_set(kind, folder)]
        self.assertEqual(len(images), len(self.dataset))
        return images

    def test_boxes(self):
        visible = sorted(box for frame in self.dataset for box in frame.people.boxes_xyxy.tolist())
        whole = sorted(box for frame in self.dataset for box in frame.people.boxes_amodal.tolist())
        for kind, name in (("visdrone", "visdrone-det"), ("visdrone", "visdrone-mot"), ("uavdt", "uavdt")):
            found = sorted(box for image in self.read(kind, name) for box in image.boxes.tolist())
            self.assertEqual(found, visible, name)
        found = np.array(sorted(box for image in self.read("mot", "mot") for box in image.boxes.tolist()))
        # MOT's files have hidden people, too.
        self.assertGreaterEqual(len(found), len(whole))
        sizes = found[:, 2:] - found[:, :2]
        for box in whole:
            error = np.abs(np.column_stack((found[:, :2], sizes)) - box).max(axis=1).min()
            self.assertLess(error, 0.02)

    def test_heads(self):
        kinds = [("dronecrowd", "dronecrowd")] + ([("shanghaitech", "shanghaitech")] if common.has("scipy") else [])
        expected = []
        for frame in self.dataset:
            heads = frame.people.heads
            expected += heads[((heads >= 0) & (heads < (frame.width, frame.height))).all(axis=1)].tolist()
        for kind, name in kinds:
            found = [point for image in self.read(kind, name) for point in image.points.tolist()]
            self.assertEqual(len(found), len(expected), name)
            np.testing.assert_allclose(np.sum(found, axis=0), np.sum(expected, axis=0), atol=0.02 * len(found))


if __name__ == "__main__":
    common.main()
