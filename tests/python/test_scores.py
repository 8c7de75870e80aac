"""Average precision against its definition, written out without NumPy, and errors of counts."""
import math
import random
import unittest

import common
from throng.scores import IOU_THRESHOLDS, DetectedImage, score_counts, score_detections


def overlap(a, b):
    width, height = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return max(width, 0) * max(height, 0)


def area(box):
    return (box[2] - box[0]) * (box[3] - box[1])


def shared(a, b):
    return overlap(a, b) / (area(a) + area(b) - overlap(a, b))


def precision_by_definition(images, threshold):
    """Mean over 101 recalls of the best precision among all score limits that reach the recall."""
    judged = []
    for image in images:
        free = list(image.truth)
        for score, box in sorted(zip(image.scores, image.boxes), key=lambda pair: -pair[0]):
            best = max(free, key=lambda truth: shared(box, truth), default=None)
            if best is not None and shared(box, best) >= threshold:
                free.remove(best)
                judged.append((score, True))
            elif not any(overlap(box, region) / area(box) >= threshold for region in image.ignored):
                judged.append((score, False))
    people = sum(len(image.truth) for image in images)
    points = []
    for limit, _ in judged:
        kept = [hit for score, hit in judged if score >= limit]
        points.append((sum(kept) / people, sum(kept) / len(kept)))
    return sum(max((p for r, p in points if r >= i / 100 - 1e-12), default=0) for i in range(101)) / 101


def random_image(rng):
    def box():
        x, y = rng.uniform(0, 90), rng.uniform(0, 90)
        return [x, y, x + rng.uniform(4, 12), y + rng.uniform(6, 20)]

    truth = [box() for _ in range(rng.randrange(6))]
    near = [[value + rng.gauss(0, 1.2) for value in one] for one in truth for _ in range(rng.randrange(3))]
    near = [one for one in near if one[2] > one[0] and one[3] > one[1]]
    boxes = near + [box() for _ in range(rng.randrange(4))]
    region = box()
    return DetectedImage(boxes, [rng.random() for _ in boxes], truth, [[*region[:2], region[2] + 25, region[3] + 25]])


class Detections(unittest.TestCase):
    def test_by_the_definition(self):
        rng = random.Random(4)
        for _ in range(12):
            images = [random_image(rng) for _ in range(5)]
            if not any(image.truth for image in images):
                continue
            scores = score_detections(images)
            expected = [precision_by_definition(images, threshold) for threshold in IOU_THRESHOLDS]
            self.assertAlmostEqual(scores.ap50, expected[0], places=9)
            self.assertAlmostEqual(scores.ap75, expected[5], places=9)
            self.assertAlmostEqual(scores.ap, sum(expected) / 10, places=9)

    def test_by_hand(self):
        truth = [[0, 0, 10, 10], [20, 0, 30, 10]]
        both = score_detections([DetectedImage(truth, [0.9, 0.8], truth)])
        self.assertEqual((both.ap, both.ap50, both.recall50, both.people), (1, 1, 1, 2))
        # One of two found: precision 1 at the recalls 0, 0.01, ... 0.5.
        half = score_detections([DetectedImage([[0, 0, 10, 10]], [0.9], truth)])
        self.assertAlmostEqual(half.ap, 51 / 101)
        # IoU 0.8 (8 of 10 rows): right at the thresholds 0.5 to 0.8, wrong at 0.85 to 0.95.
        shorter = score_detections([DetectedImage([[0, 0, 10, 8]], [0.9], [[0, 0, 10, 10]])])
        self.assertEqual((shorter.ap50, shorter.ap75), (1, 1))
        self.assertAlmostEqual(shorter.ap, 0.7)
        # A second detection of the same person is wrong, unless its region is not scored.
        twice = [[0, 0, 10, 10], [0, 0, 10, 9], [20, 0, 30, 10]]
        self.assertAlmostEqual(
            score_detections([DetectedImage(twice, [0.9, 0.8, 0.7], truth)]).ap50, (51 + 50 * 2 / 3) / 101
        )
        region = [[-5, -5, 15, 15]]
        self.assertEqual(score_detections([DetectedImage(twice, [0.9, 0.8, 0.7], truth, region)]).ap50, 1)
        limited = score_detections([DetectedImage(twice, [0.9, 0.8, 0.7], truth)], max_detections=1)
        self.assertEqual(limited.recall50, 0.5)

    def test_by_size(self):
        """Of a small and a large person the large one is found, the small one by a second detection of low score."""
        truth = [[0, 0, 20, 30], [100, 100, 200, 300]]
        boxes, values = [[100, 100, 200, 300], [300, 300, 310, 310], [0, 0, 20, 30]], [0.9, 0.8, 0.7]
        scores = score_detections([DetectedImage(boxes, values, truth)])
        self.assertEqual((scores.ap_small, scores.ap_large), (0.5, 1))
        self.assertTrue(math.isnan(scores.ap_medium))

    def test_interval(self):
        one = DetectedImage([[0, 0, 10, 10]], [0.9], [[0, 0, 10, 10]])
        none = DetectedImage([], [], [[0, 0, 10, 10]])
        low, high = score_detections([one] * 20 + [none] * 20, resamples=200).ap50_interval
        self.assertTrue(0.3 < low < 0.45 and 0.55 < high < 0.7, (low, high))
        self.assertEqual(score_detections([one] * 3, resamples=20).ap50_interval, (1, 1))
        self.assertIsNone(score_detections([one]).ap50_interval)
        low, high = score_counts([1, 5], [1, 1], resamples=100).mae_interval
        self.assertEqual((low, high), (0, 4))

    def test_nothing_and_nobody(self):
        self.assertEqual(score_detections([DetectedImage([], [], [[0, 0, 1, 1]])]).ap, 0)
        nobody = score_detections([DetectedImage([[0, 0, 1, 1]], [0.5], [])])
        self.assertTrue(math.isnan(nobody.ap))
        self.assertEqual((nobody.images, nobody.people), (1, 0))
        with self.assertRaisesRegex(ValueError, "found 2 scores of 1 boxes"):
            score_detections([DetectedImage([[0, 0, 1, 1]], [0.5, 0.4], [])])


class Counts(unittest.TestCase):
    def test_errors(self):
        scores = score_counts([3, 10, 0], [5, 6, 0])
        self.assertAlmostEqual(scores.mae, 2)
        self.assertAlmostEqual(scores.rmse, math.sqrt(20 / 3))
        self.assertAlmostEqual(scores.bias, 2 / 3)
        self.assertAlmostEqual(scores.mean_count, 11 / 3)
        for wrong in (([1], [1, 2]), ([], [])):
            with self.assertRaisesRegex(ValueError, "expected as many, at least one"):
                score_counts(*wrong)


if __name__ == "__main__":
    common.main()
