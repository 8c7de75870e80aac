"""COCO's run lengths and polygons against a decoder that follows docs/formats.md letter by letter."""
import random
import unittest

import common
import numpy as np
from throng import DatasetError, masks


def plain_decode(text, height, width):
    """Character by character, pixel by pixel."""
    numbers, number, shift = [], 0, 0
    for character in text:
        group = ord(character) - 48
        number |= (group & 31) << shift
        shift += 5
        if not group & 32:
            if group & 16:
                number -= 1 << shift
            numbers.append(number + (numbers[-2] if len(numbers) > 2 else 0))
            number = shift = 0
    pixels = []
    for i, run in enumerate(numbers):
        pixels += [i % 2 == 1] * run
    return [[pixels[x * height + y] for x in range(width)] for y in range(height)]


class Masks(unittest.TestCase):
    def test_round_trip_and_the_slow_decoder(self):
        rng = np.random.default_rng(3)
        for height, width in ((1, 1), (7, 5), (40, 61), (200, 3)):
            for share in (0.0, 0.02, 0.5, 0.98, 1.0):
                mask = rng.random((height, width)) < share
                segmentation = masks.encode(mask)
                np.testing.assert_array_equal(masks.decode(segmentation, height, width), mask)
                self.assertEqual(plain_decode(segmentation["counts"], height, width), mask.tolist())
                counts = masks.run_lengths(segmentation["counts"]).tolist()
                np.testing.assert_array_equal(
                    masks.decode({"size": [height, width], "counts": counts}, height, width), mask
                )

    def test_many_at_once_are_those_one_by_one(self):
        rng = np.random.default_rng(4)
        expected = rng.random((23, 31, 17)) < rng.random((23, 1, 1))
        many = masks.decode_many([masks.encode(mask) for mask in expected], 31, 17)
        np.testing.assert_array_equal(many, expected)

    def test_long_runs(self):
        mask = np.zeros((1000, 1300), dtype=bool)
        mask[999, 1299] = True
        np.testing.assert_array_equal(masks.decode(masks.encode(mask), 1000, 1300), mask)

    def test_polygons(self):
        mask = masks.from_polygon([1, 1, 4, 1, 4, 3, 1, 3], 5, 6)
        self.assertEqual(mask.astype(int).tolist(), [[0] * 6, [0, 1, 1, 1, 0, 0], [0, 1, 1, 1, 0, 0], [0] * 6, [0] * 6])
        rng = random.Random(5)
        for _ in range(20):
            points = [(rng.uniform(-5, 25), rng.uniform(-5, 25)) for _ in range(rng.randint(3, 8))]
            mask = masks.decode([[c for point in points for c in point]], 20, 20)
            for y in range(20):
                for x in range(20):
                    inside = False
                    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]):
                        if (y0 > y + 0.5) != (y1 > y + 0.5):
                            inside ^= x + 0.5 < x0 + (y + 0.5 - y0) * (x1 - x0) / (y1 - y0)
                    self.assertEqual(mask[y, x], inside)

    def test_damaged_segmentations(self):
        good = masks.encode(np.eye(6, dtype=bool))
        for segmentation in (
            {"size": [6, 7], "counts": good["counts"]},
            {"size": [6, 6], "counts": good["counts"][:-2]},
            {"size": [6, 6], "counts": "~~~~"},
            {"size": [6, 6], "counts": "o" * 20},
            {"size": [6, 6], "counts": ""},
            {"size": [6, 6], "counts": [-1, 37]},
            {"size": [6, 6], "counts": [10**30]},
            {"size": [6, 6]},
            {"size": [6, 6], "counts": "\u00e4"},
            {"size": [6, 6], "counts": ["x"]},
            7,
            [[1, 2, 3, 4]],
            [["x"]],
            [[0, 0, float("nan"), 1, 2, 2]],
            [[1, 2, 3]],
        ):
            with self.subTest(segmentation=segmentation), self.assertRaises(DatasetError):
                masks.decode(segmentation, 6, 6)
        with self.assertRaises(DatasetError):
            masks.decode_many([good, {"size": [6, 6], "counts": good["counts"] + "1"}], 6, 6)


if __name__ == "__main__":
    common.main()
