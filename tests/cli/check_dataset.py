"""Checks a throng dataset with code that shares nothing with throng: JSON from the standard library,
arrays from NumPy, images from Pillow, and a mask decoder written from COCO's description."""
import hashlib
import json
import pathlib

import numpy
from PIL import Image


def decode_counts(text):
    """COCO's compressed run lengths: 5 bits a character, lowest first, differences from the third on."""
    runs, position = [], 0
    while position < len(text):
        value, shift, more = 0, 0, True
        while more:
            byte = ord(text[position]) - 48
            assert 0 <= byte < 64, f"character {text[position]!r} in counts"
            value |= (byte & 31) << shift
            more = bool(byte & 32)
            shift += 5
            position += 1
            if not more and byte & 16:
                value -= 1 << shift
        if len(runs) > 2:
            value += runs[-2]
        runs.append(value)
    return runs


def mask_of(segmentation):
    height, width = segmentation["size"]
    runs = decode_counts(segmentation["counts"])
    assert sum(runs) == height * width, "the runs do not fill the image"
    flat = numpy.zeros(height * width, bool)
    start = 0
    for index, run in enumerate(runs):
        flat[start : start + run] = index % 2 == 1
        start += run
    return flat.reshape((width, height)).T


def check_manifest(folder):
    manifest = json.loads((folder / "manifest.json").read_text())
    listed = {entry["path"]: entry for entry in manifest["files"]}
    present = {str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file()} - {"manifest.json"}
    assert set(listed) == present, set(listed) ^ present
    for path, entry in listed.items():
        data = (folder / path).read_bytes()
        assert len(data) == entry["bytes"], path
        assert hashlib.sha256(data).hexdigest() == entry["sha256"], path


def check_annotation(annotation, image):
    mask = mask_of(annotation["segmentation"])
    assert mask.shape == (image["height"], image["width"])
    rows, columns = numpy.nonzero(mask)
    assert len(rows) > 0, "an annotation without a visible pixel"
    x, y, width, height = annotation["bbox"]
    bounds = (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
    assert bounds == (x, y, x + width, y + height), (bounds, annotation["bbox"])
    assert 0 <= x and 0 <= y and x + width <= image["width"] and y + height <= image["height"]
    assert annotation["area"] == len(rows)
    assert annotation["iscrowd"] == 0
    assert 0 < annotation["visibility"] <= 1

    ax, ay, amodal_width, amodal_height = annotation["bbox_amodal"]
    assert ax <= x + 1 and ay <= y + 1, "the amodal box must hold the visible one"
    assert ax + amodal_width >= x + width - 1 and ay + amodal_height >= y + height - 1

    camera = image["camera"]
    point = numpy.array(camera["R"]) @ numpy.array(annotation["box_3d"][:3]) + numpy.array(camera["t"])
    pixel = numpy.array(camera["K"]) @ point
    u, v = pixel[:2] / pixel[2] + 0.5
    assert ax <= u <= ax + amodal_width and ay <= v <= ay + amodal_height, "the body's middle outside the amodal box"


def check_dataset(folder):
    """Raises AssertionError at the first error; returns (frames, annotations)."""
    folder = pathlib.Path(folder)
    check_manifest(folder)
    coco = json.loads((folder / "annotations/instances.json").read_text(), parse_constant=lambda word: 1 / 0)
    images = {image["id"]: image for image in coco["images"]}
    assert len(images) == len(coco["images"]), "image ids are not unique"
    assert len({a["id"] for a in coco["annotations"]}) == len(coco["annotations"]), "annotation ids are not unique"
    categories = {category["id"] for category in coco["categories"]}

    tracks = {track["id"] for track in coco["tracks"]}
    assert len(tracks) == len(coco["tracks"]), "track ids are not unique"
    assert tracks == {a["track_id"] for a in coco["annotations"]}, "tracks are not those of the annotations"

    seen = set()
    for annotation in coco["annotations"]:
        assert annotation["category_id"] in categories
        key = (annotation["image_id"], annotation["track_id"])
        assert key not in seen, "one person twice in one frame"
        seen.add(key)
        check_annotation(annotation, images[annotation["image_id"]])

    for image in images.values():
        with Image.open(folder / image["file_name"]) as picture:
            assert picture.size == (image["width"], image["height"])
            picture.load()
        density = numpy.load(folder / image["density_file"])["density"]
        assert density.shape == (image["height"], image["width"]) and density.dtype == numpy.float32
        assert density.min() >= 0
        count = image["density_count"]
        assert abs(density.sum(dtype=numpy.float64) - count) <= 1e-3 * max(count, 1), image["file_name"]
    return len(images), len(coco["annotations"])


if __name__ == "__main__":
    import sys

    print("%d frames, %d annotations: all consistent" % check_dataset(sys.argv[1]))
