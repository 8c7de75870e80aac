#!/usr/bin/python3
"""Lightness (CIELAB's L) of a dataset's images: mean, standard deviation, 1st and 99th percentile, contrast within blocks.

Usage: scripts/studies/tone.py DATASET...

A line for each dataset: means over its images. Contrast is the mean over blocks of 32 x 32 px of the difference between
the 95th and the 5th percentile. Needs NumPy and Pillow.
"""
import pathlib
import sys

import numpy as np
from cielab import lightness
from PIL import Image

BLOCK = 32


def figures(image):
    light = lightness(image.convert("RGB"))
    height, width = (size // BLOCK for size in light.shape)
    blocks = light[: height * BLOCK, : width * BLOCK].reshape(height, BLOCK, width, BLOCK).swapaxes(1, 2)
    low, high = np.percentile(blocks.reshape(-1, BLOCK * BLOCK), [5, 95], axis=1)
    return [light.mean(), light.std(), *np.percentile(light, [1, 99]), (high - low).mean()]


def main():
    for dataset in sys.argv[1:]:
        rows = []
        for file in sorted((pathlib.Path(dataset) / "images").rglob("*.jpg")):
            with Image.open(file) as image:
                rows.append(figures(image))
        if not rows:
            sys.exit(f"tone.py: found no images/**/*.jpg in {dataset}, expected the folder of a dataset")
        mean, deviation, low, high, contrast = np.mean(rows, axis=0)
        print(
            f"{dataset}: {len(rows)} images, L {mean:.1f}, standard deviation {deviation:.1f}, 1 % {low:.1f}, "
            f"99 % {high:.1f}, contrast of blocks {contrast:.1f}"
        )


if __name__ == "__main__":
    main()
