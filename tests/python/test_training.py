"""Datasets for training, with and without torch, and figures of matplotlib."""
import subprocess
import sys
import unittest

import common
import numpy as np
import throng
from throng import Dataset, MissingPackageError
from throng.training import density_map


class Training(unittest.TestCase):
    def setUp(self):
        self.dataset = Dataset(common.dataset_folder())

    def test_detection_segmentation_keypoints(self):
        for kind in (throng.DetectionDataset, throng.SegmentationDataset, throng.KeypointDataset):
            samples = kind(self.dataset, tensors=False)
            self.assertEqual(len(samples), len(self.dataset))
            for frame, (image, target) in zip(self.dataset, samples):
                people = frame.people
                self.assertEqual((image.shape, image.dtype), ((3, 200, 320), np.float32))
                np.testing.assert_allclose(image.transpose(1, 2, 0) * 255, frame.image(), atol=1e-3)
                np.testing.assert_allclose(
                    target["boxes"][:, 2:] - target["boxes"][:, :2], people.boxes[:, 2:], atol=1e-4
                )
                np.testing.assert_allclose(target["boxes"][:, :2], people.boxes[:, :2], atol=1e-4)
                self.assertEqual(target["labels"].tolist(), [1] * len(people))
                self.assertEqual(int(target["image_id"]), frame.id)
                if "masks" in target:
                    self.assertEqual(target["masks"].sum(axis=(1, 2)).tolist(), people.areas.tolist())
                if "keypoints" in target:
                    np.testing.assert_allclose(target["keypoints"], people.keypoints, atol=1e-4)
        amodal = throng.DetectionDataset(self.dataset, amodal=True, tensors=False)[2][1]["boxes"]
        np.testing.assert_allclose(amodal[:, 2:] - amodal[:, :2], self.dataset[2].people.boxes_amodal[:, 2:], atol=1e-3)
        doubled = throng.DetectionDataset(
            self.dataset, tensors=False, transform=lambda image, target: (image * 2, target)
        )
        np.testing.assert_array_equal(doubled[0][0], throng.DetectionDataset(self.dataset, tensors=False)[0][0] * 2)
        images, targets = throng.collate([doubled[0], doubled[1]])
        self.assertEqual((len(images), len(targets)), (2, 2))

    def test_counting(self):
        made = throng.CountingDataset(self.dataset.filter_annotations(), tensors=False)
        for i, (_, target) in enumerate(throng.CountingDataset(self.dataset, tensors=False)):
            self.assertEqual(target["density"].shape, (1, 200, 320))
            self.assertEqual(target["count"], self.dataset[i].record["density_count"])
            self.assertAlmostEqual(float(target["density"].sum()), float(target["count"]), places=2)
            # The same map from the heads alone.
            np.testing.assert_allclose(made[i][1]["density"], target["density"], atol=2e-5)
        few = throng.CountingDataset(self.dataset.filter_annotations(min_visibility=0.9), tensors=False)[0][1]
        self.assertLess(few["count"], self.dataset[0].record["density_count"])
        self.assertAlmostEqual(float(few["density"].sum()), float(few["count"]), places=2)
        self.assertEqual(density_map(np.array([[-100.0, 3], [5, 5]]), 10, 10, 1.0).sum().round(4), 1)
        with self.assertRaises(ValueError):
            throng.CountingDataset(self.dataset, sigma_px=0)

    def test_tracking(self):
        clips = throng.TrackingDataset(self.dataset, length=2, stride=1, tensors=False)
        self.assertEqual(len(clips), 6 * 2)
        for clip in clips:
            self.assertEqual(clip["images"].shape, (2, 3, 200, 320))
            a, b = clip["frames"]
            self.assertAlmostEqual(float(b["time_s"] - a["time_s"]), 1.0)
            self.assertGreater(len(set(a["track_ids"].tolist()) & set(b["track_ids"].tolist())), 10)
        self.assertIsNone(throng.TrackingDataset(self.dataset, length=3, images=False, tensors=False)[0]["images"])
        with self.assertRaises(ValueError):
            throng.TrackingDataset(self.dataset, length=0)

    @unittest.skipUnless(common.has("torch"), "torch is not installed")
    def test_tensors(self):
        import torch

        loader = torch.utils.data.DataLoader(
            throng.DetectionDataset(self.dataset), batch_size=4, num_workers=2, collate_fn=throng.collate
        )
        images, targets = next(iter(loader))
        self.assertEqual((len(images), images[0].dtype, targets[0]["boxes"].dtype), (4, torch.float32, torch.float32))

    @unittest.skipUnless(common.has("matplotlib"), "matplotlib is not installed")
    def test_show(self):
        ax = throng.show(self.dataset[3], masks=True, keypoints=True, boxes_3d=True, exits=True)
        self.assertGreaterEqual(len(ax.patches), len(self.dataset[3].annotations))
        frame = self.dataset[3]
        painted, plain = ax.images[0].get_array(), frame.image()
        covered = frame.annotations.masks().any(axis=0)
        np.testing.assert_array_equal(painted[~covered], plain[~covered])
        self.assertGreater((painted != plain).any(axis=-1)[covered].mean(), 0.9)

    @unittest.skipUnless(common.has("matplotlib"), "matplotlib is not installed")
    def test_animation(self):
        trace = throng.Trace(common.run_folder() / "work/run000/trace.h5")
        animation = trace.animate(every_s=1.0)
        people, title = animation._func(50)
        there = np.isfinite(trace.positions[50, trace.people, 0])
        np.testing.assert_allclose(people.get_offsets()[there], trace.positions[50, trace.people][there])
        self.assertIn(f"{there.sum()} people", title.get_text())
        animation._draw_was_started = True


class OptionalPackages(unittest.TestCase):
    def test_only_numpy_is_imported(self):
        code = (
            "import sys; sys.path.insert(0, sys.argv[1]); import throng; "
            "print(sorted({'torch', 'pandas', 'matplotlib', 'shapely', 'h5py', 'PIL'} & set(sys.modules)))"
        )
        result = subprocess.run(
            [sys.executable, "-c", code, str(common.ROOT / "python")], capture_output=True, text=True, check=True
        )
        self.assertEqual(result.stdout.strip(), "[]")

    def test_a_missing_package_is_named(self):
        code = (
            "import sys; sys.path.insert(0, sys.argv[1]); import throng\n"
            "for name in ('PIL', 'pandas', 'matplotlib', 'h5py'): sys.modules[name] = None\n"
            "dataset = throng.Dataset(sys.argv[2])\n"
            "for call in (dataset[0].image, dataset.to_pandas, dataset.show, lambda: throng.Trace('x.h5')):\n"
            "    try: call()\n"
            "    except throng.MissingPackageError as error: print(error)\n"
        )
        result = subprocess.run(
            [sys.executable, "-c", code, str(common.ROOT / "python"), common.dataset_folder()],
            capture_output=True,
            text=True,
            check=True,
        )
        for package in ("python3-pil", "python3-pandas", "python3-matplotlib", "python3-h5py"):
            self.assertIn(f"apt-get install {package}", result.stdout)
        self.assertTrue(issubclass(MissingPackageError, ImportError))


if __name__ == "__main__":
    common.main()
