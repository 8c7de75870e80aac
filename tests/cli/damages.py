"""Damages to a dataset, one at a time, each with the manifest's sizes and hashes put right: what `throng validate`
should find without the manifest. See docs/formats.md, and test_validate_damages.py, which runs them.

usage: damages.py THRONG DATASET [NAME...]    prints a table; DATASET has all annotations and at least two runs, two
cameras and five frames; damages of formats/ need `mot`, `yolo-detect`, `kitti`, `voc` and `table` there."""
import csv
import hashlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import numpy
from PIL import Image, ImageFilter

KINDS = {}  # name -> function


def damage(function):
    KINDS[function.__name__.replace("_", " ")] = function
    return function


class Dataset:
    """A copy by hard links; files are replaced, never changed in place."""

    def __init__(self, source, folder):
        self.root = pathlib.Path(folder)
        shutil.copytree(source, self.root, copy_function=os.link)
        self.touched = set()
        self._coco = None
        # A hovering camera and one that moves; a frame in the middle.
        self.images = self.coco["images"]
        self.runs = sorted({i["run"] for i in self.images})
        self.cameras = sorted({i["camera_id"] for i in self.images})
        self.frames = 1 + max(i["frame"] for i in self.images)

    def path(self, name):
        return self.root / name

    def write(self, name, data):
        target = self.path(name)
        target.unlink(missing_ok=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data if isinstance(data, bytes) else data.encode())
        self.touched.add(name)

    def exchange(self, a, b):
        one, two = self.path(a).read_bytes(), self.path(b).read_bytes()
        assert one != two, f"{a} and {b} are the same"
        self.write(a, two)
        self.write(b, one)

    def copy(self, source, target):
        data = self.path(source).read_bytes()
        assert data != self.path(target).read_bytes(), f"{source} and {target} are the same"
        self.write(target, data)

    @property
    def everybody(self):
        return [a for a in self.coco["annotations"] if a["category_id"] == 1]

    @property
    def coco(self):
        if self._coco is None:
            self._coco = json.loads(self.path("annotations/instances.json").read_text())
        return self._coco

    def people(self, image):
        return [a for a in self.coco["annotations"] if a["image_id"] == image["id"] and a["category_id"] == 1]

    def image(self, camera=-1, frame=None, run=0):
        frame = self.frames // 2 if frame is None else frame
        wanted = self.runs[run], self.cameras[camera], frame
        return next(i for i in self.images if (i["run"], i["camera_id"], i["frame"]) == wanted)

    def largest(self, image, where=lambda person: True):
        people = [p for p in self.people(image) if where(p)]
        assert people, "nobody fits"
        return max(people, key=lambda person: person["area"])

    def save_coco(self):
        """As throng writes it: the head, then one record a line."""
        name = "annotations/instances.json"
        lines = self.path(name).read_text().split("\n")
        arrays = {"\"tracks\":[": "tracks", "\"images\":[": "images", "\"annotations\":[": "annotations"}
        out, skipping = [], False
        for line in lines:
            if skipping and not line.startswith("]"):
                continue
            skipping = False
            out.append(line)
            if line in arrays:
                records = [json.dumps(r, separators=(",", ":")) for r in self.coco[arrays[line]]]
                out += [r + "," for r in records[:-1]] + records[-1:]
                skipping = True
        self.write(name, "\n".join(out))

    def raster(self, kind, image):
        name = raster_name(kind, image)
        array = read_png(self.path(name))
        return name, array

    def change_raster(self, kind, image, change):
        name, array = self.raster(kind, image)
        changed = change(array.copy())
        changed = array if changed is None else changed
        assert not numpy.array_equal(changed, read_png(self.path(name))), "nothing changed"
        self.write(name, png_bytes(changed))

    def picture(self, image):
        return Image.open(self.path(image["file_name"])).convert("RGB")

    def save_picture(self, image, picture, name=None, quality=None):
        buffer = io.BytesIO()
        quality = quality or image["sensor"]["jpeg_quality"]
        picture.save(buffer, "JPEG", quality=quality, subsampling=2)
        self.write(name or image["file_name"], buffer.getvalue())

    def table(self, name):
        rows = list(csv.reader(io.StringIO(self.path(name).read_text())))
        return rows[0], rows[1:]

    def save_table(self, name, head, rows):
        buffer = io.StringIO()
        writer = csv.writer(buffer, lineterminator="\n")
        writer.writerows([head, *rows])
        assert buffer.getvalue() != self.path(name).read_text(), "nothing changed"
        self.write(name, buffer.getvalue())

    def finish(self):
        manifest = json.loads(self.path("manifest.json").read_text())
        for entry in manifest["files"]:
            if entry["path"] in self.touched:
                data = self.path(entry["path"]).read_bytes()
                entry["bytes"] = len(data)
                entry["sha256"] = hashlib.sha256(data).hexdigest()
        self.write("manifest.json", json.dumps(manifest, indent=1) + "\n")


def raster_name(kind, image):
    return kind + image["file_name"][len("images"):-len("jpg")] + "png"


def read_png(path):
    """NumPy array as in the file. Pillow knows no 16-bit RGB, so PNG is read by hand."""
    import struct
    import zlib

    data = path.read_bytes()
    at, idat, size = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            size = height, width, 3 if colour == 2 else 1, bits // 8
        if kind == b"IDAT":
            idat += body
        at += 12 + length
    height, width, channels, depth = size
    stride = width * channels * depth
    raw = numpy.frombuffer(zlib.decompress(idat), numpy.uint8).reshape(height, stride + 1)
    assert set(raw[:, 0]) <= {0, 2}, "throng's rows are as they are or the difference to the row above"
    rows = numpy.zeros((height, stride), numpy.uint8)
    above = numpy.zeros(stride, numpy.uint8)
    for y in range(height):
        above = raw[y, 1:] + above if raw[y, 0] == 2 else raw[y, 1:]
        rows[y] = above
    array = rows.view(">u2").astype(numpy.uint16) if depth == 2 else rows
    return array.reshape(height, width, channels)


def png_bytes(array):
    import struct
    import zlib

    height, width, channels = array.shape
    depth = array.dtype.itemsize
    rows = array.astype(">u2" if depth == 2 else numpy.uint8).tobytes()
    stride = width * channels * depth
    raw = b"".join(b"\0" + rows[y * stride : (y + 1) * stride] for y in range(height))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, height, 8 * depth, 2 if channels == 3 else 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 1)) + chunk(b"IEND", b"")


def ids_of(array):
    return array[..., 0].astype(int) + 256 * array[..., 1].astype(int) + 65536 * array[..., 2].astype(int)


def ids_to_rgb(ids):
    return numpy.stack([ids & 255, ids >> 8 & 255, ids >> 16 & 255], -1).astype(numpy.uint8)


def is_building(ids):
    return (ids >= 0x800000) & (ids < 0xC00000)


def is_person(ids):
    return (ids > 0) & (ids < 0x400000)


def instances(d, image):
    return ids_of(d.raster("instances", image)[1])


def decode(counts):
    runs, at = [], 0
    while at < len(counts):
        value, shift, more = 0, 0, True
        while more:
            byte = ord(counts[at]) - 48
            value |= (byte & 31) << shift
            more = byte & 32
            shift += 5
            at += 1
            if not more and byte & 16:
                value -= 1 << shift
        if len(runs) > 2:
            value += runs[-2]
        runs.append(value)
    return runs


def encode(runs):
    text = ""
    for i, run in enumerate(runs):
        value = run - runs[i - 2] if i > 2 else run
        more = True
        while more:
            group = value & 31
            value >>= 5
            more = value != (-1 if group & 16 else 0)
            text += chr((group | 32 if more else group) + 48)
    return text


def mask_of(segmentation):
    height, width = segmentation["size"]
    flat = numpy.repeat(numpy.arange(len(decode(segmentation["counts"]))) % 2 == 1, decode(segmentation["counts"]))
    return flat.reshape(width, height).T


def segmentation_of(mask):
    flat = mask.T.ravel().astype(int)
    borders = numpy.flatnonzero(numpy.diff(flat)) + 1
    runs = numpy.diff([0, *borders, len(flat)]).tolist()
    if flat[0]:
        runs = [0, *runs]
    return {"size": list(mask.shape), "counts": encode(runs)}


# --- images ---------------------------------------------------------------------------------------------------------


@damage
def picture_black(d):
    image = d.image()
    d.save_picture(image, Image.new("RGB", (image["width"], image["height"])))


@damage
def picture_mirrored(d):
    image = d.image()
    d.save_picture(image, d.picture(image).transpose(Image.FLIP_LEFT_RIGHT))


@damage
def picture_upside_down(d):
    image = d.image(0)
    d.save_picture(image, d.picture(image).transpose(Image.FLIP_TOP_BOTTOM))


@damage
def all_pictures_mirrored(d):
    for image in d.images:
        d.save_picture(image, d.picture(image).transpose(Image.FLIP_LEFT_RIGHT))


@damage
def pictures_of_two_cameras_exchanged(d):
    d.exchange(d.image(0)["file_name"], d.image(1)["file_name"])


@damage
def pictures_of_two_frames_exchanged(d):
    d.exchange(d.image(0, 1)["file_name"], d.image(0, 3)["file_name"])


@damage
def picture_of_the_next_frame(d):
    d.copy(d.image(-1, 2)["file_name"], d.image(-1, 1)["file_name"])


@damage
def picture_of_the_other_run(d):
    d.copy(d.image(0, run=1)["file_name"], d.image(0)["file_name"])


@damage
def picture_2_px_to_the_right(d):
    image = d.image()
    d.save_picture(image, Image.fromarray(numpy.roll(numpy.array(d.picture(image)), 2, 1)))


@damage
def all_pictures_3_px_down(d):
    for image in d.images:
        d.save_picture(image, Image.fromarray(numpy.roll(numpy.array(d.picture(image)), 3, 0)))


@damage
def red_and_blue_exchanged(d):
    image = d.image()
    d.save_picture(image, Image.fromarray(numpy.array(d.picture(image))[..., ::-1]))


@damage
def red_and_blue_exchanged_in_all_pictures(d):
    for image in d.images:
        d.save_picture(image, Image.fromarray(numpy.array(d.picture(image))[..., ::-1]))


@damage
def picture_without_color(d):
    image = d.image()
    d.save_picture(image, d.picture(image).convert("L").convert("RGB"))


@damage
def picture_negative(d):
    image = d.image(0)
    d.save_picture(image, Image.fromarray(255 - numpy.array(d.picture(image))))


@damage
def picture_blurred(d):
    image = d.image()
    d.save_picture(image, d.picture(image).filter(ImageFilter.GaussianBlur(6)))


@damage
def picture_of_lower_quality(d):
    image = d.image()
    d.save_picture(image, d.picture(image), quality=60)


@damage
def preview_of_another_frame(d):
    names = sorted(str(p.relative_to(d.root)) for p in d.path("previews").rglob("*.jpg"))
    image = next(i for i in d.images if i["file_name"][7:] == names[0][9:])
    other = d.image(d.cameras.index(image["camera_id"]), (image["frame"] + 2) % d.frames, d.runs.index(image["run"]))
    d.save_picture(other, d.picture(other), name=names[0])


@damage
def previews_of_two_cameras_exchanged(d):
    names = sorted(str(p.relative_to(d.root)) for p in d.path("previews").rglob("*.jpg"))
    d.exchange(names[0], names[1])


# --- people -----------------------------------------------------------------------------------------------------------

PAIRS = [(1, 2), (3, 4), (5, 6), (7, 8), (9, 10), (11, 12), (13, 14), (15, 16)]


def exchange_keypoints(person, pairs=PAIRS, flat=True, solid=True):
    for a, b in pairs:
        if flat:
            k = person["keypoints"]
            k[3 * a : 3 * a + 3], k[3 * b : 3 * b + 3] = k[3 * b : 3 * b + 3], k[3 * a : 3 * a + 3]
        if solid:
            k = person["keypoints_3d"]
            k[a], k[b] = k[b], k[a]


@damage
def left_and_right_keypoints_exchanged(d):
    for person in d.everybody:
        exchange_keypoints(person)
    d.save_coco()


@damage
def left_and_right_keypoints_of_one_person_exchanged(d):
    exchange_keypoints(d.largest(d.image()))
    d.save_coco()


@damage
def left_and_right_arms_of_one_person_exchanged(d):
    exchange_keypoints(d.largest(d.image()), [(5, 6), (7, 8), (9, 10)])
    d.save_coco()


@damage
def keypoints_exchanged_in_the_picture_only(d):
    for person in d.people(d.image()):
        exchange_keypoints(person, solid=False)
    d.save_coco()


@damage
def elbows_and_wrists_of_one_person_exchanged(d):
    person = d.largest(d.image())
    exchange_keypoints(person, [(7, 9), (8, 10)])
    d.save_coco()


@damage
def eyes_and_ears_exchanged(d):
    for person in d.people(d.image()):
        exchange_keypoints(person, [(1, 3), (2, 4)])
    d.save_coco()


@damage
def visible_keypoints_called_hidden(d):
    for person in d.people(d.image()):
        k = person["keypoints"]
        k[2::3] = [1 if v == 2 else v for v in k[2::3]]
    d.save_coco()


@damage
def hidden_keypoints_called_visible(d):
    for person in d.people(d.image()):
        k = person["keypoints"]
        k[2::3] = [2 if v == 1 else v for v in k[2::3]]
    d.save_coco()


def turn_vector(v, angle):
    c, s = numpy.cos(angle), numpy.sin(angle)
    return [float(round(c * v[0] - s * v[1], 2)), float(round(s * v[0] + c * v[1], 2))]


def change_velocities(d, people, change):
    for person in people:
        person["velocity"] = change(person["velocity"])
    d.save_coco()


@damage
def velocities_reversed(d):
    change_velocities(d, d.everybody, lambda v: [-v[0], -v[1]])


def walker(d, image):
    return d.largest(image, lambda p: numpy.hypot(*p["velocity"]) > 0.8)


@damage
def velocity_of_one_person_reversed(d):
    change_velocities(d, [walker(d, d.image())], lambda v: [-v[0], -v[1]])


@damage
def velocities_5_percent_too_high(d):
    change_velocities(d, d.everybody, lambda v: [round(1.05 * v[0], 2), round(1.05 * v[1], 2)])


@damage
def velocities_of_one_frame_turned_by_90_degrees(d):
    change_velocities(d, d.people(d.image()), lambda v: turn_vector(v, numpy.pi / 2))


@damage
def velocity_axes_exchanged(d):
    change_velocities(d, d.everybody, lambda v: v[::-1])


@damage
def velocities_of_one_frame_zero(d):
    change_velocities(d, d.people(d.image()), lambda v: [0, 0])


def wrapped(angle):
    return round(float((angle + numpy.pi) % (2 * numpy.pi) - numpy.pi), 2)


def change_headings(d, people, change):
    for person in people:
        person["heading"] = wrapped(change(person["heading"]))
    d.save_coco()


@damage
def headings_turned_by_90_degrees(d):
    change_headings(d, d.everybody, lambda h: h + numpy.pi / 2)


@damage
def headings_from_north(d):
    change_headings(d, d.everybody, lambda h: numpy.pi / 2 - h)


@damage
def heading_of_one_person_reversed(d):
    change_headings(d, [d.largest(d.image())], lambda h: h + numpy.pi)


@damage
def headings_of_one_frame_40_degrees_off(d):
    change_headings(d, d.people(d.image()), lambda h: h + 0.7)


@damage
def headings_in_degrees(d):
    for person in d.everybody:
        person["heading"] = round(float(numpy.degrees(person["heading"])), 2)
    d.save_coco()


@damage
def positions_30_cm_off(d):
    for person in d.people(d.image()):
        person["position"][0] = round(person["position"][0] + 0.3, 3)
    d.save_coco()


@damage
def position_of_one_person_1_m_off(d):
    person = d.largest(d.image())
    person["position"][1] = round(person["position"][1] + 1, 3)
    d.save_coco()


@damage
def position_axes_exchanged(d):
    for person in d.everybody:
        p = person["position"]
        p[0], p[1] = p[1], p[0]
    d.save_coco()


@damage
def positions_of_the_frame_before(d):
    before = {p["track_id"]: p for p in d.people(d.image(-1, 1))}
    for person in d.people(d.image(-1, 2)):
        if person["track_id"] in before:
            person["position"] = before[person["track_id"]]["position"]
    d.save_coco()


@damage
def box_3d_30_cm_off(d):
    person = d.largest(d.image())
    person["box_3d"][0] = round(person["box_3d"][0] + 0.3, 2)
    d.save_coco()


@damage
def boxes_3d_20_percent_too_large(d):
    for person in d.everybody:
        person["box_3d"][3:] = [round(1.2 * v, 2) for v in person["box_3d"][3:]]
    d.save_coco()


@damage
def box_3d_sizes_exchanged(d):
    for person in d.people(d.image()):
        b = person["box_3d"]
        b[3], b[5] = b[5], b[3]
    d.save_coco()


@damage
def head_of_one_person_off(d):
    person = d.largest(d.image())
    person["head"] = [person["head"][0] + 6, person["head"][1] + 4]
    d.save_coco()


@damage
def heads_at_the_feet(d):
    for person in d.people(d.image()):
        x, y, w, h = person["bbox_amodal"]
        if person["head"]:
            person["head"] = [round(x + w / 2, 2), round(y + 0.95 * h, 2)]
    d.save_coco()


@damage
def amodal_box_4_px_off(d):
    person = d.largest(d.image(), lambda p: p["visibility"] > 0.95 and "truncation" not in p)
    person["bbox_amodal"][0] += 4
    d.save_coco()


@damage
def amodal_boxes_are_visible_boxes(d):
    for person in d.people(d.image()):
        person["bbox_amodal"] = person["bbox"]
    d.save_coco()


def shifted(mask, dx, dy):
    return numpy.roll(numpy.roll(mask, dx, 1), dy, 0)


@damage
def amodal_masks_moved(d):
    for person in d.everybody:
        mask = mask_of(person["amodal_segmentation"])
        visible = mask_of(person["segmentation"])
        person["amodal_segmentation"] = segmentation_of(shifted(mask, 3, 0) | visible)
    d.save_coco()


@damage
def amodal_mask_of_one_person_moved(d):
    person = d.largest(d.image(), lambda p: p["visibility"] < 0.9 and "truncation" not in p)
    person["amodal_segmentation"] = segmentation_of(shifted(mask_of(person["amodal_segmentation"]), 4, 3))
    d.save_coco()


@damage
def amodal_mask_is_visible_mask(d):
    person = d.largest(d.image(), lambda p: p["visibility"] < 0.8 and "truncation" not in p)
    person["amodal_segmentation"] = person["segmentation"]
    person["area_amodal"] = person["area"]
    person["visibility"] = 1
    d.save_coco()


@damage
def amodal_mask_is_its_box(d):
    person = d.largest(d.image(), lambda p: "truncation" not in p)
    mask = mask_of(person["amodal_segmentation"])
    rows, columns = numpy.flatnonzero(mask.any(1)), numpy.flatnonzero(mask.any(0))
    mask[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1] = True
    person["amodal_segmentation"] = segmentation_of(mask)
    person["area_amodal"] = int(mask.sum())
    person["visibility"] = float(f"{person['area'] / person['area_amodal']:.3g}")
    d.save_coco()


def somebody_hidden(d):
    for image in d.images:
        if 0 < image["frame"] < d.frames - 1 and image.get("hidden"):
            return image
    raise AssertionError("nobody is hidden")


@damage
def hidden_people_left_out(d):
    for image in d.images:
        image["counts"]["all"] -= len(image.pop("hidden", []))
    d.save_coco()


@damage
def hidden_people_of_one_picture_left_out(d):
    image = max(d.images, key=lambda i: len(i.get("hidden", [])) * (0 < i["frame"] < d.frames - 1))
    image["counts"]["all"] -= len(image.pop("hidden"))
    d.save_coco()


@damage
def hidden_boxes_moved(d):
    for image in d.images:
        for person in image.get("hidden", []):
            person["bbox_amodal"][0] += 25 if person["bbox_amodal"][0] < image["width"] / 2 else -25
    d.save_coco()


@damage
def hidden_people_exchanged(d):
    for image in d.images:
        hidden = image.get("hidden", [])
        ids = [p["track_id"] for p in hidden]
        for person, other in zip(hidden, ids[1:] + ids[:1]):
            person["track_id"] = other
    d.save_coco()


@damage
def somebody_erased(d):
    """From records, instances and parts; the image still shows them."""
    image = d.image()
    person = d.largest(image)
    number = person["track_id"] % 1000000
    d.coco["annotations"].remove(person)
    image["counts"]["all"] -= 1
    image["counts"]["visible"] -= 1
    image["counts"]["truncated"] -= 1 if "truncation" in person else 0
    ids = instances(d, image)
    mask = ids == number
    ids[mask] = 0xFF0000
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))
    d.change_raster("parts", image, lambda a: numpy.where(mask[..., None], 0, a).astype(a.dtype))
    d.save_coco()


def two_people(d, image):
    people = sorted((p for p in d.people(image) if "truncation" not in p), key=lambda p: -p["area"])
    return people[0], people[1]


@damage
def two_people_exchanged_in_one_frame(d):
    """Ids in records and instances alike."""
    image = d.image()
    a, b = two_people(d, image)
    numbers = [p["track_id"] % 1000000 for p in (a, b)]
    ids = instances(d, image)
    one, two = ids == numbers[0], ids == numbers[1]
    ids[one], ids[two] = numbers[1], numbers[0]
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))
    for key in ("track_id", "id"):
        a[key], b[key] = b[key], a[key]
    d.coco["annotations"].sort(key=lambda p: p["id"])
    d.save_coco()


@damage
def poses_of_two_people_exchanged(d):
    a, b = two_people(d, d.image())
    for key in ("position", "velocity", "heading", "box_3d", "keypoints", "keypoints_3d", "num_keypoints", "head"):
        a[key], b[key] = b[key], a[key]
    d.save_coco()


def tracks_by_frequency(d):
    seen = {}
    for person in d.everybody:
        seen[person["track_id"]] = seen.get(person["track_id"], 0) + person["area"]
    return sorted((t for t in d.coco["tracks"] if "attributes" in t and t["id"] in seen), key=lambda t: -seen[t["id"]])


@damage
def attributes_of_two_people_exchanged(d):
    a, b = tracks_by_frequency(d)[:2]
    a["attributes"], b["attributes"] = b["attributes"], a["attributes"]
    d.save_coco()


@damage
def attributes_of_all_people_moved_by_one(d):
    tracks = [t for t in d.coco["tracks"] if "attributes" in t]
    attributes = [t["attributes"] for t in tracks]
    for track, other in zip(tracks, attributes[1:] + attributes[:1]):
        track["attributes"] = other
    d.save_coco()


@damage
def colors_of_clothes_exchanged(d):
    for track in d.coco["tracks"]:
        a = track.get("attributes", {})
        if "top_colour" in a and "bottom_colour" in a:
            a["top_colour"], a["bottom_colour"] = a["bottom_colour"], a["top_colour"]
    d.save_coco()


@damage
def colors_as_bgr(d):
    for track in d.coco["tracks"]:
        for key, value in track.get("attributes", {}).items():
            if key.endswith("_colour"):
                track["attributes"][key] = "#" + value[5:7] + value[3:5] + value[1:3]
    d.save_coco()


@damage
def sex_of_one_person(d):
    track = tracks_by_frequency(d)[0]["attributes"]
    track["sex"] = "male" if track["sex"] == "female" else "female"
    d.save_coco()


@damage
def stature_of_one_person_20_cm_less(d):
    track = tracks_by_frequency(d)[0]["attributes"]
    track["stature_m"] = round(track["stature_m"] - 0.2, 3)
    d.save_coco()


@damage
def state_of_walkers_waiting(d):
    for person in d.people(d.image()):
        if person["state"] in ("walking", "running"):
            person["state"] = "waiting"
    d.save_coco()


@damage
def state_of_one_person_running(d):
    d.largest(d.image(), lambda p: p["state"] in ("walking", "waiting"))["state"] = "running"
    d.save_coco()


@damage
def exits_of_people_exchanged(d):
    names = [e["id"] for e in d.images[0]["exits"]]
    for person in d.everybody:
        if person.get("exit") in names:
            person["exit"] = names[(names.index(person["exit"]) + 1) % len(names)]
    d.save_coco()


@damage
def labels_of_the_frame_before(d):
    """Records and rasters of one image are those of the frame before; the image is right."""
    image, before = d.image(-1, 3), d.image(-1, 2)
    old = d.people(image)
    d.coco["annotations"] = [p for p in d.coco["annotations"] if p not in old]
    for person in json.loads(json.dumps(d.people(before))):
        person["image_id"] = image["id"]
        person["id"] = image["id"] * 100000 + person["track_id"] % 1000000
        d.coco["annotations"].append(person)
    d.coco["annotations"].sort(key=lambda p: p["id"])
    for key in ("camera", "flight", "counts", "hidden", "exits", "density_count"):
        if key in before:
            image[key] = before[key]
    for kind in ("depth", "instances", "parts", "normals", "flow"):
        d.copy(raster_name(kind, before), raster_name(kind, image))
    d.write(image["density_file"], d.path(before["density_file"]).read_bytes())
    d.save_coco()


# --- camera, flight, sensors ------------------------------------------------------------------------------------------


@damage
def flight_moved_by_5_m(d):
    for image in d.images:
        image["flight"]["true"]["position"][0] += 5
    d.save_coco()


@damage
def flight_of_one_picture_moved_by_20_cm(d):
    d.image()["flight"]["true"]["position"][1] += 0.2
    d.save_coco()


@damage
def camera_and_flight_moved_by_5_m(d):
    """The camera's pose, the flight's truth and the sensors' tables."""
    for image in d.images:
        camera = image["camera"]
        image["flight"]["true"]["position"][0] += 5
        image["flight"]["measured"]["gps"]["position"][0] += 5
        camera["centre"][0] += 5
        camera["t"] = (-numpy.array(camera["R"]) @ camera["centre"]).tolist()
    for path in d.path("sensors").rglob("*.csv"):
        name = str(path.relative_to(d.root))
        head, rows = d.table(name)
        for row in rows:
            for column in ("true_x_m", "gps_x_m"):
                row[head.index(column)] = repr(float(row[head.index(column)]) + 5)
        d.save_table(name, head, rows)
    d.save_coco()


@damage
def camera_turned_by_half_a_degree(d):
    for image in d.images:
        camera = image["camera"]
        c, s = numpy.cos(numpy.radians(0.5)), numpy.sin(numpy.radians(0.5))
        turn = numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
        camera["R"] = (turn @ camera["R"]).tolist()
        camera["t"] = (-numpy.array(camera["R"]) @ camera["centre"]).tolist()
    d.save_coco()


@damage
def camera_of_the_frame_before(d):
    d.image(-1, 3)["camera"] = d.image(-1, 2)["camera"]
    d.save_coco()


@damage
def focal_length_1_percent_more(d):
    for image in d.images:
        image["camera"]["K"][0][0] *= 1.01
        image["camera"]["K"][1][1] *= 1.01
    d.save_coco()


@damage
def flight_velocity_axes_exchanged(d):
    for image in d.images:
        v = image["flight"]["true"]["velocity"]
        v[0], v[1] = v[1], v[0]
    d.save_coco()


@damage
def flight_orientation_inverted(d):
    for image in d.images:
        q = image["flight"]["true"]["orientation_wxyz"]
        q[1:] = [-v for v in q[1:]]
    d.save_coco()


@damage
def gimbal_yaw_with_the_other_sign(d):
    for image in d.images:
        image["flight"]["true"]["gimbal"]["yaw_deg"] *= -1
    d.save_coco()


@damage
def gimbal_in_radians(d):
    for image in d.images:
        for name in ("true", "measured"):
            gimbal = image["flight"][name]["gimbal"]
            for key in gimbal:
                gimbal[key] = float(numpy.radians(gimbal[key]))
    d.save_coco()


@damage
def gyro_and_accelerometer_of_pictures_exchanged(d):
    for image in d.images:
        m = image["flight"]["measured"]
        m["gyro"], m["accelerometer"] = m["accelerometer"], m["gyro"]
    d.save_coco()


def sensor_tables(d):
    return sorted(str(p.relative_to(d.root)) for p in d.path("sensors").rglob("*.csv"))


def exchange_columns(d, a, b, names=None):
    for name in names or sensor_tables(d):
        head, rows = d.table(name)
        i, j = head.index(a), head.index(b)
        for row in rows:
            row[i], row[j] = row[j], row[i]
        d.save_table(name, head, rows)


@damage
def sensor_columns_vx_and_vy_exchanged(d):
    exchange_columns(d, "true_vx_mps", "true_vy_mps", sensor_tables(d)[-1:])


@damage
def sensor_columns_gyro_y_and_z_exchanged(d):
    exchange_columns(d, "gyro_y_rad_s", "gyro_z_rad_s")


@damage
def sensor_columns_gps_and_truth_exchanged(d):
    exchange_columns(d, "true_y_m", "gps_y_m")


@damage
def sensor_rows_late_by_one(d):
    name = sensor_tables(d)[-1]
    head, rows = d.table(name)
    d.save_table(name, head, [[row[0], *before[1:]] for before, row in zip(rows[:1] + rows, rows)])


@damage
def sensor_readings_late_by_10_rows(d):
    name = sensor_tables(d)[-1]
    head, rows = d.table(name)
    first = head.index("gyro_x_rad_s")
    late = rows[:10] + rows
    d.save_table(name, head, [[*row[:first], *before[first:]] for before, row in zip(late, rows)])


@damage
def gyro_in_degrees(d):
    for name in sensor_tables(d):
        head, rows = d.table(name)
        first = head.index("gyro_x_rad_s")
        for row in rows:
            row[first : first + 3] = [repr(float(numpy.degrees(float(v)))) for v in row[first : first + 3]]
        d.save_table(name, head, rows)


@damage
def sensors_of_the_other_drone(d):
    tables = sensor_tables(d)
    d.exchange(tables[0], tables[1])


@damage
def sensors_of_the_other_run(d):
    tables = sensor_tables(d)
    d.exchange(tables[0], tables[len(d.cameras)])


@damage
def one_row_of_sensors_spoilt(d):
    name = sensor_tables(d)[-1]
    head, rows = d.table(name)
    rows[len(rows) // 3][head.index("true_x_m")] = repr(float(rows[len(rows) // 3][head.index("true_x_m")]) + 0.3)
    d.save_table(name, head, rows)


@damage
def sun_on_the_other_side(d):
    manifest = json.loads(d.path("manifest.json").read_text())
    for record in [*d.images, *manifest["runs"]]:
        record["environment"]["sun_azimuth_deg"] += 90
    d.write("manifest.json", json.dumps(manifest, indent=1))
    d.save_coco()


@damage
def weather_of_one_run(d):
    for image in d.images:
        if image["run"] == d.runs[1]:
            image["environment"]["weather"] = "rain"
    d.save_coco()


# --- depth, normals, flow, parts, instances ---------------------------------------------------------------------------


def scale_depth(d, image, factor, where):
    ids = instances(d, image)
    d.change_raster(
        "depth",
        image,
        lambda a: numpy.where(where(ids)[..., None], numpy.minimum(a * factor, 65535), a).round().astype(a.dtype),
    )


@damage
def depth_of_buildings_5_percent_more(d):
    for image in d.images:
        scale_depth(d, image, 1.05, is_building)


@damage
def depth_of_buildings_4_percent_less(d):
    for image in d.images:
        scale_depth(d, image, 0.96, is_building)


@damage
def depth_of_buildings_in_one_picture(d):
    scale_depth(d, d.image(0), 0.97, is_building)


@damage
def depth_of_one_building(d):
    image = d.image()
    ids = instances(d, image)
    values, counts = numpy.unique(ids[is_building(ids)], return_counts=True)
    scale_depth(d, image, 1.04, lambda i: i == values[counts.argmax()])


@damage
def depth_of_props(d):
    image = d.image()
    scale_depth(d, image, 1.08, lambda i: (i >= 0xC00000) & (i < 0xE00000))


@damage
def depth_of_one_person_1_m_more(d):
    image = d.image()
    number = d.largest(image)["track_id"] % 1000000
    ids = instances(d, image)
    d.change_raster("depth", image, lambda a: (a + 100 * (ids == number)[..., None]).astype(a.dtype))


@damage
def depth_1_percent_more(d):
    scale_depth(d, d.image(), 1.01, lambda i: i >= 0)


@damage
def depth_of_the_frame_before(d):
    d.copy(raster_name("depth", d.image(-1, 1)), raster_name("depth", d.image(-1, 2)))


@damage
def depth_along_the_ray(d):
    image = d.image()
    k = image["camera"]["K"]
    y, x = numpy.mgrid[: image["height"], : image["width"]]
    ray = numpy.sqrt(1 + ((x - k[0][2]) / k[0][0]) ** 2 + ((y - k[1][2]) / k[1][1]) ** 2)
    d.change_raster("depth", image, lambda a: (a[..., 0] * ray).clip(0, 65535).round()[..., None].astype(a.dtype))


def change_normals(d, images, change, where=lambda ids: ids > 0):
    for image in images:
        ids = instances(d, image)
        name, a = d.raster("normals", image)
        n = (a.astype(float) - 128) / 127
        changed = numpy.where(where(ids)[..., None], numpy.rint(128 + 127 * change(n)), a).astype(numpy.uint8)
        assert not numpy.array_equal(a, changed), "nothing changed"
        d.write(name, png_bytes(changed))


@damage
def normals_flipped(d):
    change_normals(d, d.images, lambda n: -n)


@damage
def normals_of_buildings_flipped_in_one_picture(d):
    change_normals(d, [d.image()], lambda n: -n, is_building)


@damage
def normals_of_people_flipped(d):
    change_normals(d, d.images, lambda n: -n, is_person)


@damage
def normal_axes_exchanged(d):
    change_normals(d, d.images, lambda n: n[..., [1, 0, 2]])


@damage
def normals_turned_by_20_degrees(d):
    c, s = numpy.cos(0.35), numpy.sin(0.35)
    change_normals(d, [d.image()], lambda n: n @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))


@damage
def normals_in_camera_axes(d):
    image = d.image()
    change_normals(d, [image], lambda n: n @ numpy.array(image["camera"]["R"]).T)


@damage
def normals_of_the_frame_before(d):
    d.copy(raster_name("normals", d.image(-1, 1)), raster_name("normals", d.image(-1, 2)))


def change_flow(d, images, change, where=lambda ids: ids >= 0):
    for image in images:
        ids = instances(d, image)
        name, a = d.raster("flow", image)
        flow = (a[..., :2].astype(float) - 32768) / 64
        changed = a.copy()
        known = (a[..., 2] > 0) & where(ids)
        new = numpy.rint(change(flow) * 64 + 32768).clip(0, 65535).astype(numpy.uint16)
        changed[..., :2] = numpy.where(known[..., None], new, a[..., :2])
        assert not numpy.array_equal(a, changed), "nothing changed"
        d.write(name, png_bytes(changed))


def moving(d):
    return [i for i in d.images if i["camera_id"] == d.cameras[-1] and i["frame"] < d.frames - 1]


@damage
def flow_reversed(d):
    change_flow(d, moving(d), lambda f: -f)


@damage
def flow_axes_exchanged(d):
    change_flow(d, moving(d)[1:2], lambda f: f[..., ::-1])


@damage
def flow_of_still_pixels_zero(d):
    change_flow(d, moving(d)[1:2], lambda f: 0 * f, lambda ids: ~is_person(ids))


@damage
def flow_of_people_zero(d):
    change_flow(d, [d.image(0)], lambda f: 0 * f, is_person)


@damage
def flow_of_one_person_reversed(d):
    image = d.image(0)
    number = walker(d, image)["track_id"] % 1000000
    change_flow(d, [image], lambda f: -f, lambda ids: ids == number)


@damage
def flow_5_percent_more(d):
    change_flow(d, moving(d)[1:2], lambda f: 1.05 * f)


@damage
def flow_of_the_frame_before(d):
    d.copy(raster_name("flow", d.image(-1, 1)), raster_name("flow", d.image(-1, 2)))


@damage
def flow_half_unknown(d):
    def forget(a):
        a[:, : a.shape[1] // 2] = 0
        return a

    d.change_raster("flow", d.image(), forget)


@damage
def flow_of_the_last_frame(d):
    d.copy(raster_name("flow", d.image(-1, d.frames - 2)), raster_name("flow", d.image(-1, d.frames - 1)))


SIDES = numpy.array([0, 1, 2, 4, 3, 6, 5, 8, 7, 9], numpy.uint8)


@damage
def parts_left_and_right_exchanged(d):
    for image in d.images:
        d.change_raster("parts", image, lambda a: SIDES[a])


@damage
def parts_of_one_person_left_and_right_exchanged(d):
    image = d.image()
    best = d.largest(image)
    ids = instances(d, image)
    mask = (ids == best["track_id"] % 1000000)[..., None]
    d.change_raster("parts", image, lambda a: numpy.where(mask, SIDES[a], a))


@damage
def parts_heads_and_torsos_exchanged(d):
    table = numpy.array([0, 2, 1, 3, 4, 5, 6, 7, 8, 9], numpy.uint8)
    d.change_raster("parts", d.image(), lambda a: table[a])


@damage
def parts_arms_and_legs_exchanged(d):
    table = numpy.array([0, 1, 2, 5, 6, 3, 4, 7, 8, 9], numpy.uint8)
    d.change_raster("parts", d.image(), lambda a: table[a])


@damage
def parts_all_torso(d):
    d.change_raster("parts", d.image(), lambda a: numpy.where(a > 0, 2, 0).astype(a.dtype))


@damage
def ids_of_two_buildings_exchanged(d):
    image = d.image(0)
    ids = instances(d, image)
    values, counts = numpy.unique(ids[is_building(ids)], return_counts=True)
    a, b = values[numpy.argsort(-counts)[:2]]
    one, two = ids == a, ids == b
    ids[one], ids[two] = b, a
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


@damage
def building_called_prop(d):
    image = d.image()
    ids = instances(d, image)
    values, counts = numpy.unique(ids[is_building(ids)], return_counts=True)
    ids[ids == values[counts.argmax()]] = 0xC00003
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


@damage
def ground_called_building(d):
    image = d.image()
    ids = instances(d, image)
    h, w = ids.shape
    patch = ids[2 * h // 3 :, w // 3 : 2 * w // 3]
    patch[patch == 0xFF0000] = 0x800001
    d.write(raster_name("instances", image), png_bytes(ids_to_rgb(ids)))


# --- density, fields, exits, metrics ----------------------------------------------------------------------------------


def read_npy(path):
    return numpy.load(io.BytesIO(path.read_bytes()))


def npy_like(original, array):
    """With the original's header: NumPy's own is written otherwise."""
    start = 10 + original[8] + 256 * original[9]
    return original[:start] + numpy.ascontiguousarray(array, "<f4").tobytes()


def change_npy(d, name, change):
    original = d.path(name).read_bytes()
    array = read_npy(d.path(name))
    changed = change(array.copy())
    assert changed.shape == array.shape and not numpy.array_equal(changed, array), "nothing changed"
    d.write(name, npy_like(original, changed))


@damage
def density_map_2_px_off(d):
    change_npy(d, d.image()["density_file"], lambda a: numpy.roll(a, 2, 1))


@damage
def density_map_of_another_picture(d):
    change_npy(d, d.image(0)["density_file"], lambda a: read_npy(d.path(d.image(0, 0)["density_file"])) * 1)


@damage
def density_map_without_somebody(d):
    image = d.image()
    image["density_count"] -= 1

    def lift(a):
        y, x = numpy.unravel_index(a.argmax(), a.shape)
        Y, X = numpy.mgrid[: a.shape[0], : a.shape[1]]
        kernel = numpy.exp(-((X - x) ** 2 + (Y - y) ** 2) / 32.0) * (abs(X - x) < 17) * (abs(Y - y) < 17)
        return numpy.maximum(a - kernel / kernel.sum(), 0)

    change_npy(d, image["density_file"], lift)
    d.save_coco()


def field_names(d, run=0):
    return sorted(str(p.relative_to(d.root)) for p in (d.path("fields") / d.runs[run]).glob("*.npy"))


@damage
def fields_turned_by_180_degrees(d):
    for name in field_names(d):
        change_npy(d, name, lambda a: a[:, ::-1, ::-1])


@damage
def field_mirrored(d):
    change_npy(d, field_names(d)[2], lambda a: a[:, :, ::-1])


@damage
def field_velocities_reversed(d):
    change_npy(d, field_names(d)[2], lambda a: numpy.stack([a[0], -a[1], -a[2], a[3]]))


@damage
def field_velocity_axes_exchanged(d):
    change_npy(d, field_names(d)[2], lambda a: a[[0, 2, 1, 3]])


@damage
def field_one_cell_off(d):
    change_npy(d, field_names(d)[2], lambda a: numpy.roll(a, 1, 2))


@damage
def field_origin_1_m_off(d):
    name = f"fields/{d.runs[0]}.json"
    grid = json.loads(d.path(name).read_text())
    grid["origin_m"][0] += 1
    d.write(name, json.dumps(grid, indent=2) + "\n")


@damage
def fields_one_frame_late(d):
    names = field_names(d)
    data = [d.path(n).read_bytes() for n in names]
    for name, other in zip(names[1:], data):
        d.write(name, other)


@damage
def fields_of_the_other_run(d):
    for one, two in zip(field_names(d), field_names(d, 1)):
        d.exchange(one, two)


@damage
def field_voronoi_doubled(d):
    change_npy(d, field_names(d)[2], lambda a: a * numpy.array([1, 1, 1, 2])[:, None, None])


@damage
def field_planes_of_density_exchanged(d):
    change_npy(d, field_names(d)[2], lambda a: a[[3, 1, 2, 0]])


def exits_name(d, run=0):
    return f"exits/{d.runs[run]}.csv"


def change_exits(d, change, name=None):
    name = name or exits_name(d)
    head, rows = d.table(name)
    rows = change(head, rows)
    d.save_table(name, head, rows)


@damage
def exits_shifted_by_one_frame(d):
    def shift(head, rows):
        exits = len({r[2] for r in rows})
        return [[*row[:3], *other[3:]] for row, other in zip(rows, rows[exits:] + rows[:exits])]

    change_exits(d, shift)


@damage
def exits_exchanged(d):
    def exchange(head, rows):
        names = list(dict.fromkeys(r[2] for r in rows))
        for row in rows:
            row[2] = names[(names.index(row[2]) + 1) % len(names)]
        return rows

    change_exits(d, exchange)


@damage
def exits_of_the_other_run(d):
    d.exchange(exits_name(d, 0), exits_name(d, 1))


def busy_columns(d, change, picture_key=None):
    """Table and images alike, where the demand is there."""
    for run in range(len(d.runs)):
        name = exits_name(d, run)
        head, rows = d.table(name)
        before = json.dumps(rows)
        for row in rows:
            change({key: i for i, key in enumerate(head)}, row)
        if json.dumps(rows) != before:
            d.save_table(name, head, rows)
        values = {(int(r[0]), r[2]): r for r in rows}
        for image in d.images:
            if image["run"] != d.runs[run]:
                continue
            for exit in image["exits"]:
                row = values[image["frame"], exit["id"]]
                exit["state"] = row[head.index("state")]
                for key, column in (("in_zone", "in_zone"), ("queue", "queue"), ("queue_length_m", "queue_length"),
                                    ("clogging_index", "clogging_index"), ("flow_per_s", "flow")):
                    number = float(row[head.index(column)])
                    exit[key] = int(number) if key in ("in_zone", "queue") else number
    assert d.touched, "nothing changed"
    d.save_coco()


@damage
def clogging_index_inverted(d):
    def invert(at, row):
        row[at["clogging_index"]] = f"{1 - float(row[at['clogging_index']]):.4f}"

    busy_columns(d, invert)


@damage
def clogging_index_inverted_where_people_wait(d):
    def invert(at, row):
        if row[at["demand"]] == "1":
            row[at["clogging_index"]] = f"{1 - float(row[at['clogging_index']]):.4f}"

    busy_columns(d, invert)


@damage
def flow_of_exits_doubled(d):
    def double(at, row):
        row[at["flow"]] = f"{2 * float(row[at['flow']]):.2f}"

    busy_columns(d, double)


@damage
def states_of_exits_idle(d):
    def idle(at, row):
        row[at["state"]] = row[at["state_offline"]] = "idle"

    busy_columns(d, idle)


@damage
def density_of_exits_per_10_m2(d):
    def scale(at, row):
        for key in ("density",):
            row[at[key]] = f"{10 * float(row[at[key]]):.4f}" if row[at["frame"]] == "2" else row[at[key]]

    busy_columns(d, scale)


@damage
def people_at_exits_too_few(d):
    def fewer(at, row):
        n = int(row[at["in_zone"]])
        if n > 2:
            for key in ("density", "normalised_density"):
                row[at[key]] = f"{float(row[at[key]]) * (n // 2) / n:.4f}"
            row[at["in_zone"]] = str(n // 2)

    busy_columns(d, fewer)


@damage
def door_3_px_off_in_one_picture(d):
    image = next(i for i in d.images if i["frame"] > 0 and any(e["door"] for e in i["exits"]))
    exit = next(e for e in image["exits"] if e["door"])
    exit["door"] = [[x + 3, y] for x, y in exit["door"]]
    d.save_coco()


@damage
def doors_and_zones_exchanged(d):
    for image in d.images:
        for exit in image["exits"]:
            exit["door"], exit["zone"] = exit["zone"], exit["door"]
    d.save_coco()


@damage
def zones_of_two_exits_exchanged(d):
    image = max(d.images, key=lambda i: sum(1 for e in i["exits"] if e["zone"]))
    a, b = [e for e in image["exits"] if e["zone"]][:2]
    a["zone"], b["zone"] = b["zone"], a["zone"]
    d.save_coco()


def change_metrics(d, change, copies=True):
    metrics = json.loads(d.path("metrics.json").read_text())
    before = json.dumps(metrics)
    change(metrics["runs"][0])
    assert json.dumps(metrics) != before, "nothing changed"
    d.write("metrics.json", json.dumps(metrics, indent=2) + "\n")
    if copies:
        name = f"metrics/{d.runs[0]}.json"
        own = json.loads(d.path(name).read_text())
        change(own)
        d.write(name, json.dumps(own, indent=2) + "\n")


@damage
def metrics_of_two_runs_exchanged(d):
    d.exchange(f"metrics/{d.runs[0]}.json", f"metrics/{d.runs[1]}.json")


@damage
def metrics_with_another_number_of_people(d):
    def change(run):
        run["people"] += 1

    change_metrics(d, change)


@damage
def metrics_time_in_state_halved(d):
    def change(run):
        for exit in run["exits"]:
            for key in exit["time_in_state"]:
                exit["time_in_state"][key] /= 2

    change_metrics(d, change)


@damage
def metrics_greatest_density_halved(d):
    def change(run):
        for exit in run["exits"]:
            exit["max_voronoi_density_per_m2"] /= 2

    change_metrics(d, change)


@damage
def escape_curve_reversed(d):
    def change(run):
        run["escape_curve"]["escaped_share"] = [1 - v for v in run["escape_curve"]["escaped_share"]]

    change_metrics(d, change)


# --- other formats ----------------------------------------------------------------------------------------------------


def first(d, pattern):
    names = sorted(str(p.relative_to(d.root)) for p in d.root.glob(pattern))
    assert names, "no " + pattern
    return next(n for n in names if d.path(n).stat().st_size > 100)


def edit_line(d, pattern, change):
    name = first(d, pattern)
    lines = d.path(name).read_text().split("\n")
    lines[1] = change(lines[1])
    d.write(name, "\n".join(lines))


@damage
def formats_mot_ids_exchanged(d):
    edit_line(d, "formats/mot/*/*/gt/gt.txt", lambda line: ",".join([line.split(",")[0], "77", *line.split(",")[2:]]))


@damage
def formats_yolo_box_moved(d):
    def move(line):
        parts = line.split(" ")
        parts[1] = f"{float(parts[1]) + 0.01:.6f}"
        return " ".join(parts)

    edit_line(d, "formats/yolo-detect/labels/*/*.txt", move)


@damage
def formats_kitti_rotation_reversed(d):
    def turn(line):
        parts = line.split(" ")
        parts[-1] = f"{-float(parts[-1]):.2f}"
        return " ".join(parts)

    edit_line(d, "formats/kitti/**/label_2/*.txt", turn)


@damage
def formats_table_column(d):
    name = "formats/table/people.csv"
    head, rows = d.table(name)
    rows[5][-1], rows[6][-1] = rows[6][-1] + "1", rows[5][-1]
    d.save_table(name, head, rows)


def run(throng, dataset, folder, name):
    """Result of validating the damaged copy: (exit code, lines)."""
    d = Dataset(dataset, pathlib.Path(folder) / "damaged")
    try:
        KINDS[name](d)
        d.finish()
        done = subprocess.run([throng, "validate", d.root], capture_output=True, text=True, timeout=300, check=False)
        return done.returncode, done.stdout.splitlines() + done.stderr.splitlines()
    finally:
        shutil.rmtree(d.root)


def main(throng, dataset, *names):
    found = total = 0
    started = time.monotonic()
    for name in names or KINDS:
        with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
            try:
                code, lines = run(throng, dataset, folder, name)
            except (AssertionError, StopIteration, FileNotFoundError) as error:
                print(f"{name:62} not possible here: {error or type(error).__name__}")
                continue
        rules = sorted({line[line.rindex("[") + 1 : -1] for line in lines if line.endswith("]")})
        assert code in (0, 2), (code, lines[-3:])
        assert rules != ["manifest"], lines[:3]
        found += bool(rules)
        total += 1
        print(f"{name:62} {'found by ' + ', '.join(rules) if rules else 'NOT FOUND'}", flush=True)
    print(f"found {found} of {total} in {time.monotonic() - started:.0f} s")
    return found, total


if __name__ == "__main__":
    main(*sys.argv[1:])
