"""A dataset that is damaged: a copy whose files are replaced and whose manifest is put right."""
import csv
import functools
import hashlib
import io
import json
import os
import pathlib
import shutil

import numpy
from PIL import Image

from .rasters import png_bytes, raster_name, read_png


def damage(function):
    """Marks a damage, which is named as its function, with blanks for underscores."""
    function.is_damage = True
    return function


def damage_by(change, **options):
    """Marks a damage that `change(dataset, function, **options)` does by the function."""
    return lambda function: damage(functools.wraps(function)(lambda d: change(d, function, **options)))


def each(records):
    """For damage_by: the function changes each of the records of the labels, which are written then."""

    def change(d, function):
        for record in records(d):
            function(record)
        d.save_coco()

    return change


damage_of_labels = damage_by(each(lambda d: [d]))
each_person = each(lambda d: d.everybody)
each_person_of_an_image = each(lambda d: d.people(d.image()))
each_image = each(lambda d: d.images)
each_track = each(lambda d: d.coco["tracks"])


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
        arrays = {'"tracks":[': "tracks", '"images":[': "images", '"annotations":[': "annotations"}
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


def walker(d, image):
    return d.largest(image, lambda p: numpy.hypot(*p["velocity"]) > 0.8)


def two_people(d, image):
    people = sorted((p for p in d.people(image) if "truncation" not in p), key=lambda p: -p["area"])
    return people[0], people[1]


def tracks_by_frequency(d):
    seen = {}
    for person in d.everybody:
        seen[person["track_id"]] = seen.get(person["track_id"], 0) + person["area"]
    return sorted((t for t in d.coco["tracks"] if "attributes" in t and t["id"] in seen), key=lambda t: -seen[t["id"]])
