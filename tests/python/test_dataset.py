"""A dataset as Dataset reads it, from a folder, a tar and a zip file, against its files read by json, Pillow and
NumPy."""
import csv
import json
import pickle
import subprocess
import tarfile
import tempfile
import unittest
import zipfile

import common
import numpy as np
from PIL import Image
from throng import Dataset, DatasetError, merge, tables
from throng.annotations import Annotations


CATEGORIES = {1: "person", 2: "drone", 3: "car", 4: "train", 5: "van", 6: "truck", 7: "bus", 8: "motorcycle"}


class Reading(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.path = common.dataset_folder()
        cls.coco = json.loads((cls.path / "annotations/instances.json").read_text())
        cls.of_image = {}
        for record in cls.coco["annotations"]:
            cls.of_image.setdefault(record["image_id"], []).append(record)
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        with tarfile.open(f"{folder}/linked.tar", "w") as archive:  # with hard links, as the program's archives
            archive.add(cls.path, "set")
            link = tarfile.TarInfo("set/formats/first.jpg")
            link.type, link.linkname = tarfile.LNKTYPE, "set/" + cls.coco["images"][0]["file_name"]
            archive.addfile(link)
        subprocess.run(["tar", "-cf", f"{folder}/plain.tar", "-C", cls.path, "."], check=True)
        for name, method in (("stored", zipfile.ZIP_STORED), ("deflated", zipfile.ZIP_DEFLATED)):
            with zipfile.ZipFile(f"{folder}/{name}.zip", "w", method) as archive:
                for file in sorted(cls.path.rglob("*")):
                    archive.write(file, f"my set/{file.relative_to(cls.path)}")
        cls.datasets = {
            "folder": Dataset(cls.path),
            "job's folder": Dataset(cls.path.parent),
            **{name: Dataset(f"{folder}/{name}") for name in ("linked.tar", "plain.tar", "stored.zip", "deflated.zip")},
        }

    def test_what_it_is(self):
        for name, dataset in self.datasets.items():
            with self.subTest(name):
                self.assertEqual(dataset.name, "reader test")
                self.assertEqual([frame.id for frame in dataset], [image["id"] for image in self.coco["images"]])
                self.assertEqual(sorted(dataset.runs), ["run000", "run001"])
                self.assertEqual(sorted(dataset.cameras), ["d1", "d2", "d3"])
                self.assertEqual(dataset.categories, CATEGORIES)
                self.assertEqual(
                    {k: v.runs for k, v in dataset.splits.items()}, {"train": ["run000"], "val": ["run001"]}
                )
                self.assertEqual(dataset.metrics(), json.loads((self.path / "metrics.json").read_text()))
                self.assertEqual(dataset.tracks(), {track["id"]: track for track in self.coco["tracks"]})
                dataset.verify()

    def test_annotations(self):
        for name, dataset in self.datasets.items():
            for frame, image in zip(dataset, self.coco["images"]):
                records = self.of_image[image["id"]]
                a = frame.annotations
                self.assertEqual(list(a), records, name)
                self.assertEqual(a.track_ids.tolist(), [r["track_id"] for r in records])
                self.assertEqual(a.boxes.tolist(), [r["bbox"] for r in records])
                self.assertEqual(a.visibility.tolist(), [r["visibility"] for r in records])
                self.assertEqual(a.positions.tolist(), [r["position"] for r in records])
                self.assertEqual(a.states, [r.get("state") for r in records])
                people = [r for r in records if r["category_id"] == 1]
                self.assertEqual(len(frame.people) + len(a.drones) + len(a.vehicles), len(records))
                self.assertEqual(frame.people.keypoints.reshape(-1, 51).tolist(), [r["keypoints"] for r in people])
                self.assertEqual(frame.people.contrasts.tolist(), [r["difficulty"]["contrast"] for r in people])
                self.assertEqual(frame.people.joints.reshape(-1, 99).tolist(), [r["joints"] for r in people])
                self.assertEqual(frame.people.bone_turns.tolist(), [r["bone_turns"] for r in people])
                self.assertEqual(frame.people.gazes.tolist(), [r["gaze"] for r in people])
                self.assertEqual(frame.people.lookalikes, [r["difficulty"]["lookalikes"] for r in people])
                self.assertEqual(frame.people.blur_px.tolist(), [r["difficulty"]["blur_px"] for r in people])
                self.assertEqual(frame.hazards, image["hazards"])
                dangers = [r["danger"]["distance_m"] if "danger" in r else None for r in people]
                self.assertEqual([None if np.isnan(d) else d for d in frame.people.danger_m], dangers)
                self.assertEqual(frame.people.occluders, [[tuple(o) for o in r["occluded_by"]] for r in people])
                self.assertEqual(frame.people.heads.tolist(), [r["head"] for r in people])
                boxes = [None if np.isnan(box).any() else box.tolist() for box in frame.people.head_boxes]
                self.assertEqual(boxes, [r["head_box"] for r in people])
                shares = [None if np.isnan(share) else share for share in frame.people.head_visibility]
                self.assertEqual(shares, [r["head_visibility"] for r in people])
                self.assertEqual(frame.people.boxes_3d[:, :6].tolist(), [r["box_3d"] for r in people])
        self.assertTrue(any(len(frame.annotations.drones) for frame in self.datasets["folder"]))
        records = [{"category_id": category, "track_id": 7} for category in (1, 2, 3, 4)]
        of_all = Annotations(records, 10, 10, "here", {})
        self.assertEqual(list(of_all.vehicles), records[2:])

    def test_fields_with_other_cells_have_the_same_people(self):
        dataset = self.datasets["folder"]
        for run in ("run000", "run001"):
            for frame in range(2):
                fine, grid = dataset.field(run, frame)
                people = grid["people"][frame]
                size = grid["cell_m"]
                edges = [np.arange(n + 1) * size for n in (grid["rows"], grid["columns"])]
                for cell_m in (1, 3.1):
                    field, level = dataset.field(run, frame, cell_m)
                    self.assertEqual(field.shape[1:], (level["rows"], level["columns"]))
                    self.assertAlmostEqual(field[0].sum(dtype=np.float64) * cell_m**2, people, places=3)
                    # The overlap of each cell of the fine grid with each of the coarse one, along both axes.
                    shares = []
                    for axis, edge in enumerate(edges):
                        low = np.arange(field.shape[1 + axis])[:, None] * cell_m
                        shares.append(np.clip(np.minimum(edge[1:], low + cell_m) - np.maximum(edge[:-1], low), 0, None))
                    rows, columns = shares
                    expected = rows @ fine[0].astype(float) @ columns.T / cell_m**2
                    np.testing.assert_allclose(field[0], expected, atol=1e-5)
                    moving = rows @ (fine[0].astype(float) * fine[1]) @ columns.T / cell_m**2
                    np.testing.assert_allclose(field[0] * field[1], moving, atol=1e-5)
        with self.assertRaisesRegex(ValueError, "found 2, expected one of outputs.fields.cells_m: 1, 3.1"):
            dataset.field("run000", 0, 2)

    def test_actions_of_images_are_in_the_table(self):
        dataset = self.datasets["folder"]
        motions, together = set(), 0
        for run in ("run000", "run001"):
            table = dataset.actions(run)
            rows = {}
            for track, action, other, begin, end in zip(
                *(table[c] for c in ("track_id", "action", "other", "from_s", "to_s"))
            ):
                rows.setdefault((int(track), action, other), []).append((begin, end))
            for frame in dataset.filter(runs=[run]):
                for track, names, others in zip(
                    frame.people.track_ids, frame.people.actions, frame.people.together_with
                ):
                    motions.update(names)
                    together += len(others)
                    wanted = [(int(track), name, "") for name in names]
                    wanted += [(int(track), "together", str(other)) for other in others]
                    for key in wanted:
                        stretches = rows.get(key, [])
                        self.assertTrue(
                            any(a - 0.25 <= frame.time_s <= b + 0.25 for a, b in stretches), (key, frame.time_s)
                        )
        self.assertIn("walk", motions)
        self.assertIn("carry", motions)

    def test_counts_are_those_of_the_trajectories(self):
        dataset = self.datasets["folder"]
        crossings = 0
        for run in ("run000", "run001"):
            values, record = dataset.trajectories(run)
            ids = np.array(record["track_ids"])
            areas = dataset.count_areas(run)
            self.assertEqual([zone["id"] for zone in areas["zones"]], ["ground", "corner"])
            self.assertEqual(areas["zones"][1]["corners"], [[0, 0], [30, 0], [0, 30]])
            self.assertEqual(areas["lines"][-1], {"id": "middle", "start": [0, -30], "end": [0, 30]})
            table = dataset.counts(run)
            self.assertEqual(len(table["id"]), len(values) * (len(areas["zones"]) + len(areas["lines"])))
            before = set()
            for frame in range(len(values)):
                x, y = values[frame, :, 0].astype(float), values[frame, :, 1].astype(float)
                here = table.where(frame=frame, id="corner")
                entered, left = ([int(i) for i in here[key][0].split()] for key in ("entered", "left"))
                now = set(ids[(x >= 0) & (y >= 0) & (x + y <= 30)].tolist())
                self.assertEqual(int(here["inside"][0]), len(now))
                self.assertEqual((entered, left), (sorted(now - before), sorted(before - now)))
                self.assertEqual((int(here["inflow"][0]), int(here["outflow"][0])), (len(entered), len(left)))
                before = now
                # To the left of the way north is west.
                here = table.where(frame=frame, id="middle")
                entered, left = ([int(i) for i in here[key][0].split()] for key in ("entered", "left"))
                crossings += len(entered) + len(left)
                if frame == 0:
                    self.assertEqual((entered, left), ([], []))
                    continue
                last = values[frame - 1].astype(float)
                for person, number in enumerate(ids.tolist()):
                    if np.isnan(last[person, 0]) or np.isnan(x[person]) or abs(y[person]) > 25:
                        continue
                    net = entered.count(number) - left.count(number)
                    self.assertEqual(net, int(x[person] <= 0) - int(last[person, 0] <= 0), number)
        self.assertGreater(crossings, 0)
        for frame, record in zip(dataset, self.coco["images"]):
            visible = {zone["id"]: zone["visible"] for zone in record["zones"]}
            x, y, _ = frame.people.positions.T
            self.assertEqual(visible["corner"], int(((x >= 0) & (y >= 0) & (x + y <= 30)).sum()))

    def test_head_boxes_are_where_the_image_shows_heads(self):
        """Bounds of the pixels of the part 1 (head, hair and neck), of people whose head nothing hides."""
        dataset = self.datasets["folder"]
        errors, missing = [], []
        for frame in dataset:
            parts, instances = frame.parts(), frame.instances()
            for person, box in zip(frame.people, frame.people.head_boxes):
                x, y, width, height = box
                inside = x > 1 and y > 1 and x + width < frame.width - 1 and y + height < frame.height - 1
                if not inside or width * height < 6 or person["head_visibility"] != 1 or person["visibility"] < 1:
                    continue
                number = person["track_id"] % 1000000
                rows, columns = np.nonzero((parts == 1) & (instances == number))
                if len(rows) == 0:
                    missing.append(min(width, height))
                    continue
                errors.append([columns.min() - x, columns.max() + 1 - x - width, rows.min() - y])
        # A pixel shows what is at its middle: the outermost half a pixel may be missing, not more than one over.
        errors = np.array(errors)
        self.assertGreater(len(errors), 20)
        # A head of fewer than three pixels may lie between the middles of pixels; some of the smallest bodies are drawn
        # without one, for a cause that is not known.
        self.assertLess(max(missing, default=0), 4)
        self.assertLess(len(missing), 0.05 * len(errors))
        # Small people in drafts have coarse meshes, whose heads reach into the shoulders and are not quite as high.
        self.assertGreater(np.quantile(errors[:, 2], 0.05), -1.01)
        self.assertGreater(errors[:, 2].min(), -2)
        self.assertLess(np.median(np.abs(errors[:, [0, 2]])), 1)
        self.assertLess(np.median(np.abs(errors[:, 1])), 1)

    def test_pictures_and_label_files(self):
        for name, dataset in self.datasets.items():
            for frame in dataset:
                stem = f"{frame.run}/{frame.camera_id}/{frame.index:06d}"
                with self.subTest(name, frame=stem):
                    with Image.open(self.path / frame.file_name) as picture:
                        np.testing.assert_array_equal(frame.image(), np.array(picture.convert("RGB")))
                    np.testing.assert_array_equal(
                        frame.density(), np.load(self.path / f"density/{stem}.npz")["density"]
                    )
                    self.assertAlmostEqual(float(frame.density().sum()), frame.record["density_count"], places=3)
                    with Image.open(self.path / f"depth/{stem}.png") as picture:
                        centimeters = np.array(picture).astype(float)
                    depth = frame.depth()
                    np.testing.assert_array_equal(np.isinf(depth), centimeters == 0)
                    np.testing.assert_allclose(depth[centimeters > 0], centimeters[centimeters > 0] / 100, rtol=1e-6)
                    with Image.open(self.path / f"instances/{stem}.png") as picture:
                        ids = np.array(picture).astype(int) @ [1, 256, 65536]
                    np.testing.assert_array_equal(frame.instances(), ids)
                    with Image.open(self.path / f"parts/{stem}.png") as picture:
                        np.testing.assert_array_equal(frame.parts(), np.array(picture))
                    is_person = frame.semantic() == dataset.semantic_classes["person"]
                    np.testing.assert_array_equal(is_person, (ids > 0) & (ids < 0x400000))
                    lengths = np.linalg.norm(frame.normals(), axis=-1)
                    self.assertTrue(((lengths == 0) | (np.abs(lengths - 1) < 0.02)).all())
                    flow, known = frame.flow()
                    self.assertEqual(np.isnan(flow).any(axis=-1).tolist(), (~known).tolist())
                    self.assertEqual(frame.scene_flow().shape, (frame.height, frame.width, 3))
                    self.assertEqual(frame.hazard_opacity().shape, (frame.height, frame.width, 3))

    def test_masks_are_the_picture_of_instances(self):
        for frame in self.datasets["folder"]:
            ids, people = frame.instances(), frame.people
            masks, whole = people.masks(), people.masks(amodal=True)
            run = int(frame.run[3:])
            for i, track in enumerate(people.track_ids):
                np.testing.assert_array_equal(masks[i], ids == track - run * 1_000_000)
                rows, columns = np.nonzero(masks[i])
                x, y, width, height = people.boxes[i]
                self.assertEqual(
                    (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1), (x, y, x + width, y + height)
                )
                self.assertEqual(masks[i].sum(), people.areas[i])
                self.assertFalse((masks[i] & ~whole[i]).any())
                np.testing.assert_array_equal(masks[i], people.mask(i))

    def test_tables(self):
        for name, dataset in self.datasets.items():
            table = dataset.exits("run000")
            with open(self.path / "exits/run000.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(table.rows, len(rows), name)
            self.assertEqual(table["exit"].tolist(), [row["exit"] for row in rows])
            np.testing.assert_array_equal(table["density"], [float(row["density"]) for row in rows])
            self.assertEqual(
                table.where(exit=rows[0]["exit"]).rows, sum(row["exit"] == rows[0]["exit"] for row in rows)
            )
            sensors = dataset.sensors("run000", "d1")
            self.assertGreater(sensors.rows, 500)
            self.assertAlmostEqual(float(sensors["true_z_m"][0]), 15)
            self.check_trajectories(dataset)
            lines = (self.path / "events/run000.jsonl").read_text().splitlines()
            self.assertEqual(dataset.events("run000"), [json.loads(line) for line in lines])
            field, grid = dataset.field("run001", 1)
            self.assertAlmostEqual(float(field[0].sum()) * grid["cell_m"] ** 2, grid["people"][1], delta=0.01)

    def check_trajectories(self, dataset):
        """Everybody whom an image shows is where the image has the person; others are there too."""
        values, description = dataset.trajectories("run001")
        self.assertEqual(values.shape[2], 4)
        seen = set()
        for frame in dataset.filter(runs=["run001"]):
            people = frame.people
            for track, position in zip(people.track_ids, people.positions):
                person = description["track_ids"].index(track)
                np.testing.assert_allclose(values[frame.index, person, :2], position[:2], atol=0.006)
                seen.add((frame.index, track))
            self.assertAlmostEqual(description["times_s"][frame.index], frame.time_s, places=3)
        self.assertGreater(len(seen), 20)
        # Far more than the few who may be hidden or not.
        self.assertGreater((~np.isnan(values[..., 0])).sum(), len(seen) + 20)

    def test_copies_in_other_processes(self):
        for name, dataset in self.datasets.items():
            copy = pickle.loads(pickle.dumps(dataset))
            self.assertEqual(copy[3].people.boxes.tolist(), dataset[3].people.boxes.tolist(), name)
            np.testing.assert_array_equal(copy[3].image(), dataset[3].image())

    def test_other_layouts_of_the_coco_file(self):
        """Indented, in another order, polygons and plain run lengths: what other tools write."""
        with tempfile.TemporaryDirectory() as folder:
            with zipfile.ZipFile(f"{folder}/a.zip", "w") as archive:
                archive.writestr("annotations/instances.json", json.dumps(dict(reversed(self.coco.items())), indent=1))
            dataset = Dataset(f"{folder}/a.zip")
            for frame in dataset:
                self.assertEqual(list(frame.annotations), self.of_image[frame.id])
            mixed = [{"id": 2, "image_id": 8}, {"id": 1, "image_id": 7}, {"id": 3, "image_id": 8}]
            mixed = [
                {**record, "category_id": 1, "bbox": [1, 1, 2, 2], "segmentation": [[1, 1, 3, 1, 3, 3, 1, 3]]}
                for record in mixed
            ]
            images = [{"id": i, "file_name": f"images/r/c/{i}.jpg", "width": 5, "height": 4} for i in (7, 8, 9)]
            lines = ",\n".join(json.dumps(record, separators=(",", ":")) for record in mixed)
            two_a_line = lines.replace(",\n", ",", 1)
            for text in (
                json.dumps({"images": images, "annotations": mixed}),
                '{"images":' + json.dumps(images) + ',\n"annotations":[\n' + two_a_line + "\n]}\n",
                '{"images":' + json.dumps(images) + ',\n"annotations":[\n' + lines + "\n]}\n",
            ):
                with zipfile.ZipFile(f"{folder}/b.zip", "w") as archive:
                    archive.writestr("annotations/instances.json", text)
                dataset = Dataset(f"{folder}/b.zip")
                self.assertEqual([[r["id"] for r in frame.annotations] for frame in dataset], [[1], [2, 3], []])
                self.assertEqual(dataset[1].people.masks().sum(axis=(1, 2)).tolist(), [4, 4])
                self.assertEqual(dataset[2].people.boxes_xyxy.shape, (0, 4))
                self.assertEqual(dataset[2].people.masks().shape, (0, 4, 5))
                with self.assertRaisesRegex(DatasetError, "keypoints.*outputs.annotations"):
                    dataset[1].people.keypoints
                with self.assertRaisesRegex(DatasetError, "amodal"):
                    dataset[1].people.masks(amodal=True)
                with self.assertRaisesRegex(DatasetError, "depth/r/c/7.png.*outputs.annotations"):
                    dataset[0].depth()


class Views(unittest.TestCase):
    def setUp(self):
        self.dataset = Dataset(common.dataset_folder())

    def test_filter(self):
        self.assertEqual(
            {f.sequence for f in self.dataset.filter(runs=["run001"], cameras=["d1", "d3"])}, {"run001/d1", "run001/d3"}
        )
        self.assertEqual(len(self.dataset.filter(split="val")), 9)
        self.assertEqual(len(self.dataset.filter(cameras="d1")), len(self.dataset.filter(cameras=["d1"])))
        first = self.dataset.filter(runs=["run000"])
        self.assertEqual(len(first.filter(runs=["run001"])), 0, "a run of the dataset, of which the view has nothing")
        for wrong, message in (
            ({"cameras": ["D1"]}, "cameras: found 'D1', expected one of d1, .*did you mean 'd1'"),
            ({"runs": "run01"}, "runs: found 'run01', expected one of run000, .*did you mean 'run001'"),
            ({"split": "valid"}, "split: found 'valid', expected one of test, train, val .did you mean 'val'"),
        ):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, message):
                self.dataset.filter(**wrong)
        count = len(self.dataset)
        for index in (count, -count - 1):
            with self.assertRaisesRegex(IndexError, f"dataset.{index}.: found {count} frames"):
                self.dataset[index]
        self.assertEqual({f.time_s for f in self.dataset.filter(from_s=8.5, to_s=9.5)}, {9.0})
        self.assertEqual(len(self.dataset.filter(lambda f: f.index == 2)), 6)
        crowded = self.dataset.filter(min_people=30)
        self.assertTrue(0 < len(crowded) < len(self.dataset))
        self.assertTrue(all(len(f.people) >= 30 for f in crowded))
        self.assertEqual(self.dataset[:4][[0, 2]][1].id, self.dataset[2].id)
        self.assertEqual(self.dataset[-1].id, self.dataset[17].id)

    def test_filter_annotations(self):
        kept = self.dataset.filter_annotations(min_visibility=0.6, min_height_px=12, categories=[1])
        for before, after in zip(self.dataset, kept):
            a = before.annotations
            keep = (a.visibility >= 0.6) & (a.boxes_amodal[:, 3] >= 12) & (a.category_ids == 1)
            self.assertEqual(after.annotations.ids.tolist(), a.ids[keep].tolist())
        distinct = self.dataset.filter_annotations(min_contrast=15)
        for before, after in zip(self.dataset, distinct):
            a = before.people
            keep = np.maximum(a.contrasts, a.edge_contrasts) >= 15
            self.assertEqual(after.people.ids.tolist(), a.ids[keep].tolist())
        walking = self.dataset.filter_annotations(lambda r: r["area"] > 20, states=["walking"])
        self.assertTrue(all(r["state"] == "walking" and r["area"] > 20 for f in walking for r in f.annotations))

    def test_split(self):
        parts = self.dataset.split(train=0.5, val=0.5, seed=3)
        self.assertEqual(
            {frozenset(part.runs) for part in parts.values()}, {frozenset(["run000"]), frozenset(["run001"])}
        )
        parts = self.dataset.split(train=0.7, val=0.2, test=0.1, by="frame", seed=1)
        self.assertEqual({name: len(part) for name, part in parts.items()}, {"train": 12, "val": 4, "test": 2})
        ids = [frame.id for part in parts.values() for frame in part]
        self.assertEqual(sorted(ids), sorted(frame.id for frame in self.dataset))
        again = self.dataset.split(train=0.7, val=0.2, test=0.1, by="frame", seed=1)
        self.assertEqual([f.id for f in again["val"]], [f.id for f in parts["val"]])
        parts = self.dataset.split(a=0.9, b=0.1, by="sequence")
        self.assertEqual([len(part.sequences) for part in parts.values()], [5, 1])
        ids = [frame.id for frame in self.dataset]
        for by in ("scenario", "place"):  # "place" in version 0.1
            self.assertEqual([frame.id for frame in self.dataset.split(a=1, by=by)["a"]], ids)
        self.assertEqual({frame.scenario for frame in self.dataset}, {frame.place for frame in self.dataset})
        for wrong in ({"train": 0.9, "val": 0.3}, {"train": -0.1}, {}, {"a": 0.3, "b": 0.3, "c": 0.3}):
            with self.assertRaises(ValueError):
                self.dataset.split(**wrong)
        with self.assertRaises(ValueError):
            self.dataset.split(a=1, by="moon")

    def test_resample_and_sample(self):
        half = self.dataset.resample(0.5)
        self.assertEqual(
            {(f.sequence, f.time_s) for f in half}, {(f.sequence, f.time_s) for f in self.dataset if f.index in (0, 2)}
        )
        self.assertEqual(len(self.dataset.resample(100)), 18)
        self.assertEqual(len(self.dataset.resample(0.01)), 6)
        self.assertEqual(len({f.id for f in self.dataset.sample(7, seed=2)}), 7)
        only = self.dataset.sample(5, weights=lambda f: f.run == "run001")
        self.assertEqual(only.runs, ["run001"])
        self.assertEqual(len(self.dataset.sample(50, replacement=True)), 50)
        for call in (
            lambda: self.dataset.resample(0),
            lambda: self.dataset.sample(19),
            lambda: self.dataset.sample(1, weights=lambda f: 0),
        ):
            with self.assertRaises(ValueError):
                call()

    def test_merge(self):
        merged = merge([self.dataset.filter(runs=["run001"]), self.dataset, self.dataset[:3]])
        self.assertEqual(len(merged), 9 + 18 + 3)
        self.assertEqual(len({frame.id for frame in merged}), 30)
        self.assertEqual(len(merged.sequences), 3 + 6 + 3)
        tracks = [
            {(int(t)) for f in merged if f.sequence.startswith(f"{i}:") for t in f.annotations.track_ids}
            for i in range(3)
        ]
        self.assertFalse(tracks[0] & tracks[1] or tracks[1] & tracks[2] or tracks[0] & tracks[2])
        self.assertTrue(set.union(*tracks) <= merged.tracks().keys())
        self.assertEqual(merged[9].people.attributes, self.dataset[0].people.attributes)
        self.assertEqual([f.id for f in self.dataset], [f.id for f in Dataset(common.dataset_folder())])
        twice = merge([merged, self.dataset])
        self.assertEqual(len({frame.id for frame in twice}), 48)
        with self.assertRaises(ValueError):
            merge([])
        with self.assertRaises(ValueError):
            merge([self.dataset, self.dataset.filter_annotations(min_visibility=0.5)])

    def test_to_coco(self):
        merged = merge([self.dataset, self.dataset]).filter_annotations(min_visibility=0.3)
        coco = json.loads(json.dumps(merged.to_coco()))
        self.assertEqual(len({a["id"] for a in coco["annotations"]}), sum(len(f.annotations) for f in merged))
        self.assertTrue({a["image_id"] for a in coco["annotations"]} <= {i["id"] for i in coco["images"]})
        with tempfile.TemporaryDirectory() as folder:
            with zipfile.ZipFile(f"{folder}/a.zip", "w") as archive:
                archive.writestr("annotations/instances.json", json.dumps(coco))
            again = Dataset(f"{folder}/a.zip")
            self.assertEqual(
                [f.annotations.track_ids.tolist() for f in again], [f.annotations.track_ids.tolist() for f in merged]
            )

    @unittest.skipUnless(common.has("pandas"), "pandas is not installed")
    def test_to_pandas(self):
        frame = self.dataset.to_pandas()
        records = [record for f in self.dataset for record in f.annotations]
        self.assertEqual(frame[["x", "y", "width", "height"]].to_numpy().tolist(), [r["bbox"] for r in records])
        self.assertEqual(
            frame[["world_x_m", "world_y_m", "world_z_m"]].to_numpy().tolist(), [r["position"] for r in records]
        )
        self.assertEqual(frame[["vx_mps", "vy_mps"]].to_numpy().tolist(), [r["velocity"][:2] for r in records])
        self.assertEqual(frame["state"].tolist(), [r.get("state") for r in records])
        one = frame[(frame.sequence == "run001/d2") & (frame.frame == 1)]
        self.assertEqual(
            one.track_id.tolist(),
            self.dataset.filter(lambda f: f.sequence == "run001/d2" and f.index == 1)[0].annotations.track_ids.tolist(),
        )
        self.assertEqual(len(self.dataset.exits("run000").to_pandas()), self.dataset.exits("run000").rows)


class Csv(unittest.TestCase):
    def test_types(self):
        table = tables.read_csv(b"a,b,c\n1,2.5,x\n3,,y\n", "t.csv")
        self.assertEqual((table["a"].dtype.kind, table["b"].dtype.kind, table["c"].dtype.kind), ("i", "f", "U"))
        self.assertTrue(np.isnan(table["b"][1]))
        self.assertEqual(tables.read_csv(b"a,b\n", "t.csv").rows, 0)
        for text in (b"", b"a,b\n1\n", b"\xff\xfe"):
            with self.assertRaises(DatasetError):
                tables.read_csv(text, "t.csv")


if __name__ == "__main__":
    common.main()
