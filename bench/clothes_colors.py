#!/usr/bin/env python3
"""Compares the colors that tracks name for tops and shoes with the pixels of these parts in the images.

usage: bench/clothes_colors.py DATASET... [--min-pixels 40]

DATASET needs `coco`, `instances` and `parts`; images under an overcast sky from nearby cameras
say most. A pair is a person in one image with at least so many pixels of the part. Pixels are divided by the light of the
image (what the tops of all its people are, on the median, against their labels). A pair agrees if, freely scaled in
brightness, the pixels' mean color is within 12 of the label in CIELAB's a*b* at the label's lightness, or nearer to it
than to nine tenths of the other labels. For comparison: how many agree with somebody else's label (`exchanged`). Gray and black ones are alike:
colorful labels (a*b* of 15 and more from gray) are also counted by themselves.
"""
import argparse
import json
import pathlib
import sys

import numpy
from cielab import TO_XYZ, linear
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "cli"))
from damages.rasters import read_png  # noqa: E402

PARTS = {"top_colour": [2], "shoes_colour": [7, 8]}
WHITE = TO_XYZ.sum(1)


def label_of(text):
    return linear([int(text[i : i + 2], 16) for i in (1, 3, 5)])


def chroma(rgb, lightness_of):
    """a* and b* of a color in linear light, scaled to another one's luminance."""
    xyz = TO_XYZ @ rgb
    xyz = xyz * ((TO_XYZ @ lightness_of)[1] + 0.002) / (xyz[1] + 1e-6)
    f = numpy.where(xyz / WHITE > 0.008856, numpy.cbrt(xyz / WHITE), 7.787 * xyz / WHITE + 16 / 116)
    return numpy.array([500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def pairs_of(dataset, min_pixels):
    """Per image: a list of (attribute, label, mean of the part's pixels in linear light)."""
    coco = json.loads((dataset / "annotations/instances.json").read_text())
    tracks = {t["id"]: t.get("attributes", {}) for t in coco["tracks"]}
    people = {}
    for a in coco["annotations"]:
        if a["category_id"] == 1:
            people.setdefault(a["image_id"], []).append(a)
    for image in coco["images"]:
        name = image["file_name"][len("images/") : -len("jpg")] + "png"
        ids = read_png(dataset / "instances" / name).astype(int)
        ids = ids[..., 0] + 256 * ids[..., 1] + 65536 * ids[..., 2]
        parts = read_png(dataset / "parts" / name)[..., 0]
        pixels = linear(numpy.array(Image.open(dataset / image["file_name"]).convert("RGB")))
        found = []
        for person in people.get(image["id"], []):
            attributes = tracks[person["track_id"]]
            mine = ids == person["track_id"] % 1000000
            for key, numbers in PARTS.items():
                mask = mine & numpy.isin(parts, numbers)
                # The border of a part is mixed with what is beside it.
                inner = mask.copy()
                for axis in (0, 1):
                    for by in (-1, 1):
                        inner &= numpy.roll(mask, by, axis)
                if key in attributes and inner.sum() >= min_pixels:
                    found.append((key, label_of(attributes[key]), numpy.median(pixels[inner], 0)))
        if found:
            yield found


def light_of(found):
    tops = [(label, seen) for key, label, seen in found if key == "top_colour" and label.min() > 0.01]
    if len(tops) < 3:
        return numpy.ones(3)
    ratio = numpy.median([seen / label for label, seen in tops], 0)
    return ratio / ratio.mean()


def agrees(label, seen, others):
    off = numpy.linalg.norm(chroma(seen, label) - chroma(label, label))
    away = [numpy.linalg.norm(chroma(seen, other) - chroma(other, other)) for other in others]
    return off <= 12 or off <= numpy.quantile(away, 0.1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("datasets", nargs="+", type=pathlib.Path)
    parser.add_argument("--min-pixels", type=int, default=40)
    options = parser.parse_args()
    pairs = {key: [] for key in PARTS}
    for dataset in options.datasets:
        for found in pairs_of(dataset, options.min_pixels):
            light = light_of(found)
            for key, label, seen in found:
                pairs[key].append((label, seen / light))
    for key, rows in pairs.items():
        report(key, rows, rows)
        report(key + ", colorful", [row for row in rows if numpy.linalg.norm(chroma(row[0], row[0])) >= 15], rows)


def report(name, rows, all_rows):
    if len(rows) < 10:
        return
    labels = [label for label, _ in all_rows]
    good = sum(agrees(label, seen, labels) for label, seen in rows)
    step = len(rows) // 2 + 1
    wrong = sum(agrees(rows[(i + step) % len(rows)][0], seen, labels) for i, (_, seen) in enumerate(rows))
    off = [numpy.linalg.norm(chroma(seen, label) - chroma(label, label)) for label, seen in rows]
    print(
        f"{name}: {good} of {len(rows)} pairs agree ({100 * good / len(rows):.1f} %), exchanged {wrong}; "
        f"a*b* off by {numpy.median(off):.1f} (median), {numpy.quantile(off, 0.9):.1f} (90 %)"
    )


if __name__ == "__main__":
    main()
