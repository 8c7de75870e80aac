"""Damaged and hostile datasets: every fault is a DatasetError that names the file, and nothing is written anywhere."""
import collections
import copy
import hashlib
import io
import json
import os
import pathlib
import random
import struct
import tarfile
import tempfile
import unittest
import zipfile
import zlib

import common
import numpy as np
from PIL import Image
from throng import Dataset, DatasetError, _png

LABELS = "annotations/instances.json"


def png(array):
    out = io.BytesIO()
    Image.fromarray(array).save(out, "PNG")
    return out.getvalue()


def files(**more):
    image = {
        "id": 1,
        "file_name": "images/run000/d1/000000.jpg",
        "width": 6,
        "height": 4,
        "run": "run000",
        "camera_id": "d1",
        "frame": 0,
        "time_s": 0,
    }
    record = {
        "id": 11,
        "image_id": 1,
        "category_id": 1,
        "bbox": [0, 0, 2, 2],
        "area": 4,
        "track_id": 1,
        "segmentation": {"size": [4, 6], "counts": [0, 2, 2, 2, 18]},
    }
    jpeg = io.BytesIO()
    Image.new("RGB", (6, 4), (200, 10, 10)).save(jpeg, "JPEG")
    density = io.BytesIO()
    np.savez_compressed(density, density=np.zeros((4, 6), np.float32))
    lines = json.dumps(record, separators=(",", ":"))
    text = (
        '{"info":{},\n"categories":[],\n"tracks":[\n],\n"images":[\n'
        + json.dumps(image)
        + '\n],\n"annotations":[\n'
        + lines
        + "\n]}\n"
    )
    content = {
        LABELS: text.encode(),
        "images/run000/d1/000000.jpg": jpeg.getvalue(),
        "density/run000/d1/000000.npz": density.getvalue(),
        "depth/run000/d1/000000.png": png(np.full((4, 6), 500, np.uint16)),
        "exits/run000.csv": b"frame,exit\n0,a\n",
        "metrics.json": b"{}",
        "dataset.json": b"{}",
    }
    content.update(more)
    manifest = {
        "files": [
            {"path": name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}
            for name, data in content.items()
        ]
    }
    content["manifest.json"] = json.dumps(manifest).encode()
    return content


def zeros_of(name: str, count: int) -> io.BytesIO:
    """A .npz file of one array of zeros."""
    file = io.BytesIO()
    np.savez_compressed(file, **{name: np.zeros(count, np.float32)})
    return file


class Damage(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, content, kind="folder"):
        path = self.folder / f"set{len(list(self.folder.iterdir()))}"
        if kind == "folder":
            for name, data in content.items():
                (path / name).parent.mkdir(parents=True, exist_ok=True)
                (path / name).write_bytes(data)
        elif kind == "tar":
            with tarfile.open(path, "w") as archive:
                for name, data in content.items():
                    entry = tarfile.TarInfo(name)
                    entry.size = len(data)
                    archive.addfile(entry, io.BytesIO(data))
        else:
            with zipfile.ZipFile(
                path, "w", zipfile.ZIP_DEFLATED if kind == "deflated" else zipfile.ZIP_STORED
            ) as archive:
                for name, data in content.items():
                    archive.writestr(name, data)
        return path

    def read_everything(self, path):
        dataset = Dataset(path)
        dataset.verify()
        for frame in dataset:
            frame.image(), frame.density(), frame.depth(), frame.annotations.masks(), frame.annotations.boxes
        dataset.exits("run000"), dataset.metrics()
        return dataset

    def refused(self, path, *words, use=None):
        with self.assertRaises(DatasetError) as caught:
            (use or self.read_everything)(path)
        for word in (str(path), *words):
            self.assertIn(word, str(caught.exception))

    def test_sound_ones_are_read(self):
        for kind in ("folder", "tar", "stored", "deflated"):
            self.assertEqual(len(self.read_everything(self.write(files(), kind))), 1)

    def test_nothing_and_other_things(self):
        self.refused(self.folder / "nowhere", "found nothing there")
        self.refused(self.write({"readme.txt": b"x"}), LABELS)
        self.refused(self.write({"readme.txt": b"x"}, "tar"), LABELS)
        text = self.folder / "text.tar"
        for data in (b"", b"hello", b"x" * 5000, b"PK\3\4" + b"x" * 50, b"\x1f\x8b\x08rest"):
            text.write_bytes(data)
            self.refused(text)
        os.mkfifo(self.folder / "pipe")
        self.refused(self.folder / "pipe")
        pipe = self.write(files())
        (pipe / LABELS).unlink()
        os.mkfifo(pipe / LABELS)
        self.refused(pipe)

    def test_every_cut_of_an_archive(self):
        for kind in ("tar", "stored", "deflated"):
            whole = self.write(files(), kind)
            data = whole.read_bytes()
            last = 10240 if kind == "tar" else 1  # a tar's end is padded
            for length in [*range(0, len(data) - last, 97), len(data) - last]:
                cut = self.folder / "cut"
                cut.write_bytes(data[:length])
                if kind == "tar" and not data[length:].strip(b"\0"):
                    continue
                with self.subTest(kind=kind, length=length):
                    self.refused(cut)

    def test_flipped_bytes_never_go_unnoticed(self):
        rng = np.random.default_rng(1)
        for kind in ("tar", "stored", "deflated"):
            data = self.write(files(), kind).read_bytes()
            reference = files()
            for place in rng.integers(0, len(data), 150):
                damaged = bytearray(data)
                damaged[place] ^= 1 << rng.integers(8)
                path = self.folder / "flipped"
                path.write_bytes(damaged)
                try:
                    dataset = self.read_everything(path)
                except DatasetError:
                    continue
                # Padding, times and the like: the content is the same.
                storage = dataset._sources[0].storage
                for name, expected in reference.items():
                    if name != "manifest.json":
                        self.assertEqual(storage.read(name), expected, (kind, place))

    def test_names_that_leave_the_dataset(self):
        for name in ("../evil.txt", "/etc/evil.txt", "a/../../evil.txt", "a\\..\\evil.txt"):
            for kind in ("tar", "stored"):
                self.refused(self.write({**files(), name: b"x"}, kind), "evil.txt")
        for name in ("../../etc/passwd", "/etc/passwd", ""):
            text = files()[LABELS].replace(b"images/run000/d1/000000.jpg", name.encode())
            self.refused(self.write(files(**{LABELS: text})), "file_name")
        text = files()[LABELS].replace(b'"frame": 0', b'"frame": 0, "density_file": "../../etc/passwd"')
        self.refused(self.write(files(**{LABELS: text})), "etc/passwd")
        self.assertEqual([p for p in self.folder.parent.glob("evil.txt")], [])

    def test_links_and_devices(self):
        for kind, target in (
            (tarfile.SYMTYPE, "/etc/passwd"),
            (tarfile.LNKTYPE, "../x"),
            (tarfile.LNKTYPE, "missing"),
            (tarfile.CHRTYPE, ""),
            (tarfile.FIFOTYPE, ""),
        ):
            path = self.write(files(), "tar")
            with tarfile.open(path, "a") as archive:
                entry = tarfile.TarInfo("link")
                entry.type, entry.linkname = kind, target
                archive.addfile(entry)
            self.refused(path)

    def test_a_member_twice(self):
        path = self.write(files(), "tar")
        with tarfile.open(path, "a") as archive:
            entry = tarfile.TarInfo("metrics.json")
            archive.addfile(entry, io.BytesIO())
        self.refused(path, "metrics.json", "twice")

    def test_bombs(self):
        """Small files that would unpack to much: refused by what the record says, or by the ratio."""
        for name in ("depth/run000/d1/000000.png", "density/run000/d1/000000.npz", "images/run000/d1/000000.jpg"):
            path = self.write(files(**{name: bytes(50 << 20)}), "deflated")
            self.assertLess(path.stat().st_size, 1 << 20)
            kind = name.split("/")[0]
            self.refused(path, name, use=lambda p, kind=kind: getattr(Dataset(p)[0], kind.removesuffix("s"))())
        path = self.write(files(**{LABELS: b" " * (80 << 20)}), "deflated")
        self.refused(path, LABELS, "unpack")
        # A size in the directory that is not that of the data.
        data = bytearray(self.write(files(), "deflated").read_bytes())
        at = data.index(b"PK\1\2")
        data[at + 24 : at + 28] = struct.pack("<I", 10)
        (self.folder / "lie").write_bytes(data)
        self.refused(self.folder / "lie")
        # A PNG of the right size on paper with pixels for many more.
        head = struct.pack(">IIBBBBB", 6, 4, 16, 0, 0, 0, 0)
        chunks = b"".join(
            struct.pack(">I", len(b)) + k + b + struct.pack(">I", zlib.crc32(k + b))
            for k, b in ((b"IHDR", head), (b"IDAT", zlib.compress(bytes(30 << 20))), (b"IEND", b""))
        )
        with self.assertRaisesRegex(DatasetError, "bytes of pixels"):
            _png.decode(b"\x89PNG\r\n\x1a\n" + chunks, "x.png", (4, 6))

    def test_wrong_json(self):
        good = files()[LABELS]
        for old, new, words in (
            (good, b"", "JSON"),
            (good, b"[1]", "object"),
            (b'"images":[', b'"pictures":[', "/images"),
            (b'"width": 6', b'"width": "6"', "/images/0/width"),
            (b'"width": 6', b'"width": 99999999', "pixels"),
            (b'"image_id":1,', b'"image_id":7,', "image_id 7"),
            (b'"annotations":[', b'"annotations":[}', "JSON"),
            (b'"bbox":[0,0,2,2]', b'"bbox":[0,0,"x",2]', "bbox"),
            (b'"bbox":[0,0,2,2]', b'"bbox":[0,0,2]', "bbox"),
            (b'"track_id":1', b'"track_id":1,', "JSON"),
            (b"[0,2,2,2,18]", b"[0,2,2,2,19]", "segmentation"),
            (b'"bbox":[0,0,2,2],', b"", "bbox"),
            (b'"image_id":1,', b'"image_id":' + b"1" * 5000 + b",", "JSON"),
            (good, b"[" * 100000, "JSON"),
            (b'"category_id":1', b'"category_id":1,"x":' + b"[" * 100000, "JSON"),
        ):
            with self.subTest(new=new[:60]):
                self.assertIn(old, good)
                path = self.write(files(**{LABELS: good.replace(old, new)}))
                self.refused(path, words)
        self.refused(self.write(files(**{"metrics.json": b"{"})), "metrics.json")
        self.refused(self.write(files(**{"exits/run000.csv": b"frame,exit\n0\n"})), "exits/run000.csv", "line 2")
        self.refused(self.write(files(**{"dataset.json": b"[]"})), "dataset.json", use=lambda p: Dataset(p).splits)

    @unittest.skipUnless(common.THRONG, "needs the program")
    def test_any_wrong_value(self):
        """Values of a real label file replaced by others, one at a time: what is read is right or a DatasetError."""
        coco = json.loads((common.dataset_folder() / LABELS).read_text())
        coco["images"], coco["tracks"] = coco["images"][:2], coco["tracks"][:5]
        ids = [image["id"] for image in coco["images"]]
        coco["annotations"] = [a for a in coco["annotations"] if a["image_id"] in ids][:8]
        others = (None, "x", [], {}, -1, True, [[]], 10**20, "", [None], float("nan"), 0.5)
        changes = [*self.changes_of_every_member(coco, others), *self.changes_anywhere(coco, others, 200)]
        path = self.folder / "changed"
        (path / "annotations").mkdir(parents=True)
        outcomes = collections.Counter()
        for *members, value in changes:
            changed = copy.deepcopy(coco)
            place = changed
            for key in members[:-1]:
                place = place[key]
            place[members[-1]] = value
            (path / LABELS).write_text(json.dumps(changed))
            with self.subTest(members=members, value=value):
                try:
                    self.read_all_columns(Dataset(path))
                    outcomes["read"] += 1
                except DatasetError as error:
                    self.assertIn("changed", str(error))
                    outcomes["refused"] += 1
        self.assertGreater(min(outcomes["read"], outcomes["refused"]), 50)

    def changes_of_every_member(self, coco, others):
        """Every member of the first image, annotation, track and category, replaced by a value of each type."""
        types = {type(value): value for value in others}
        for table in ("images", "annotations", "tracks", "categories"):
            for key in coco[table][0]:
                for value in types.values():
                    yield table, 0, key, value

    def changes_anywhere(self, coco, others, count):
        """Values at random places, also within lists and objects."""
        rng = random.Random(7)
        for _ in range(count):
            table = rng.choice(("images", "annotations", "tracks", "categories"))
            members = [table, rng.randrange(len(coco[table]))]
            place = coco[table][members[1]]
            while True:
                key = rng.choice(list(place)) if isinstance(place, dict) else rng.randrange(len(place))
                members.append(key)
                if not place[key] or not isinstance(place[key], (dict, list)) or rng.random() < 0.5:
                    break
                place = place[key]
            yield *members, rng.choice(others)

    def read_all_columns(self, dataset):
        dataset.name, dataset.runs, dataset.categories, dataset.splits, dataset.tracks(), dataset.resample(1.0)
        dataset.to_coco()
        if common.has("pandas"):
            dataset.to_pandas()
        for frame in dataset.filter_annotations(min_visibility=0.1, min_height_px=2, min_area_px=1, states=["walking"]):
            frame.annotations.boxes
        columns = [name for name, kind in vars(type(dataset[0].people)).items() if not name.startswith("_")]
        for frame in dataset:
            repr(frame)
            for name, kind in vars(type(frame)).items():
                if isinstance(kind, property) and not name.startswith("_") and name != "camera":
                    getattr(frame, name)
            for name in columns:
                value = getattr(frame.people, name)
                if name in ("corners_3d", "masks"):
                    value()
            frame.camera.project(frame.people.positions)

    def test_missing_and_changed_files(self):
        for name in ("metrics.json", "exits/run000.csv", "depth/run000/d1/000000.png", "images/run000/d1/000000.jpg"):
            content = files()
            del content[name]
            for kind in ("folder", "tar", "stored"):
                self.refused(self.write(content, kind), name)
        path = self.write(files())
        (path / "metrics.json").write_bytes(b"[]")
        self.refused(path, "metrics.json", "SHA-256")
        (path / "metrics.json").unlink()
        Dataset(path).verify(complete=False)

    def test_damaged_pictures(self):
        for name in ("depth/run000/d1/000000.png", "images/run000/d1/000000.jpg", "density/run000/d1/000000.npz"):
            whole = files()[name]
            kind = name.split("/")[0].removesuffix("s")
            other = {
                "depth": png(np.zeros((4, 7), np.uint16)),
                "image": png(np.zeros((4, 7, 3), np.uint8)),
                "density": b"\x93NUMPY\1\0",
            }[kind]
            for data in (b"", whole[: len(whole) // 2], b"x" * len(whole), other):
                path = self.write(files(**{name: data}))
                with self.subTest(name=name, data=data[:10]):
                    self.refused(path, name, use=lambda p, kind=kind: getattr(Dataset(p)[0], kind)())
        pickled = io.BytesIO()
        np.savez(pickled, density=np.array([[print]], dtype=object))
        for damaged in (pickled, zeros_of("density", 50 << 20), zeros_of("another", 4), zeros_of("density", 3)):
            path = self.write(files(**{"density/run000/d1/000000.npz": damaged.getvalue()}))
            self.refused(path, "000000.npz", use=lambda p: Dataset(p)[0].density())

    def test_density_of_earlier_versions(self):
        old = io.BytesIO()
        np.save(old, np.full((4, 6), 0.5, np.float32))
        content = files()
        del content["density/run000/d1/000000.npz"]
        content["density/run000/d1/000000.npy"] = old.getvalue()
        content[LABELS] = content[LABELS].replace(
            b'"frame": 0', b'"frame": 0, "density_file": "density/run000/d1/000000.npy"'
        )
        frame = Dataset(self.write(content))[0]
        self.assertEqual(float(frame.density().sum()), 12)

    def test_all_filters_of_png(self):
        """Pillow chooses filters row by row."""
        rng = np.random.default_rng(2)
        smooth = (np.add.outer(np.arange(60) * 3, np.arange(50) * 5) % 256).astype(np.uint8)
        for array in (
            smooth,
            smooth[:, :, None] + np.array([1, 50, 90], np.uint8),
            rng.integers(0, 256, (9, 8, 3), np.uint8),
            smooth.astype(np.uint16) * 257,
        ):
            data = png(array)
            np.testing.assert_array_equal(_png.decode(data, "x.png", array.shape[:2]), array)
        height, width = 5, 7
        rows = rng.integers(0, 256, (height, width * 3), np.uint8)
        for kind in range(5):
            raw = b"".join(bytes([kind]) + row.tobytes() for row in rows)
            head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
            data = b"\x89PNG\r\n\x1a\n" + b"".join(
                struct.pack(">I", len(b)) + k + b + struct.pack(">I", zlib.crc32(k + b))
                for k, b in ((b"IHDR", head), (b"IDAT", zlib.compress(raw)), (b"IEND", b""))
            )
            with Image.open(io.BytesIO(data)) as picture:
                np.testing.assert_array_equal(_png.decode(data, "x.png", (height, width)), np.array(picture))


if __name__ == "__main__":
    common.main()
