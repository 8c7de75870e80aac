"""Projection against OpenCV's formulas written down once more, point by point, and against labels of the program."""
import math
import unittest

import common
import numpy as np
from throng import Camera, Dataset, DatasetError

LENSES = {
    "pinhole": ("pinhole", {}),
    "wide angle": ("brown_conrady", {"k1": -0.28, "k2": 0.08, "p1": 0.0003, "p2": -0.0002, "k3": -0.01}),
    "rational": (
        "brown_conrady",
        {"k1": 0.4, "k2": 0.1, "p1": 0.001, "p2": 0.002, "k3": 0.01, "k4": 0.7, "k5": 0.2, "k6": 0.03},
    ),
    "pincushion": ("brown_conrady", {"k1": 0.2}),
    "fisheye": ("fisheye", {"k1": -0.02, "k2": 0.003, "k3": -0.001, "k4": 0.0002}),
}


def camera_of(name, **more):
    model, distortion = LENSES[name]
    yaw, pitch = 0.7, -0.9
    ahead = np.array([math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), math.sin(pitch)])
    right = np.array([math.sin(yaw), -math.cos(yaw), 0])
    rotation = np.array([right, np.cross(ahead, right), ahead])
    k = np.array([[300, more.get("skew", 0), 317.3], [0, 310, 241.8], [0, 0, 1.0]])
    return Camera(640, 480, k, rotation, -rotation @ np.array([3.0, -2.0, 18.0]), model, distortion)


def project_plainly(camera, point):
    """cv::projectPoints and cv::fisheye::projectPoints, from OpenCV's documentation."""
    x, y, z = (sum(camera.R[i][j] * point[j] for j in range(3)) + camera.t[i] for i in range(3))
    a, b = x / z, y / z
    d = {**dict.fromkeys(("k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"), 0.0), **camera.distortion}
    r2 = a * a + b * b
    if camera.model == "fisheye":
        theta = math.atan(math.sqrt(r2))
        bent = theta * (1 + d["k1"] * theta**2 + d["k2"] * theta**4 + d["k3"] * theta**6 + d["k4"] * theta**8)
        a, b = (v * bent / math.sqrt(r2) for v in (a, b))
    else:
        c = (1 + d["k1"] * r2 + d["k2"] * r2**2 + d["k3"] * r2**3) / (
            1 + d["k4"] * r2 + d["k5"] * r2**2 + d["k6"] * r2**3
        )
        a, b = (
            a * c + 2 * d["p1"] * a * b + d["p2"] * (r2 + 2 * a * a),
            b * c + d["p1"] * (r2 + 2 * b * b) + 2 * d["p2"] * a * b,
        )
    return camera.K[0][0] * a + camera.K[0][1] * b + camera.K[0][2], camera.K[1][1] * b + camera.K[1][2]


class Formulas(unittest.TestCase):
    def test_projection(self):
        rng = np.random.default_rng(1)
        for name in LENSES:
            camera = camera_of(name, skew=2.5)
            pixels = rng.uniform((0, 0), (640, 480), (50, 2))
            points = camera.unproject(pixels, rng.uniform(2, 60, 50))
            shown = np.isfinite(points).all(axis=1)  # the wide angle's range ends within the image
            self.assertGreater(shown.sum(), 25)
            pixels, points = pixels[shown], points[shown]
            for pixel, point in zip(pixels, points):
                np.testing.assert_allclose(project_plainly(camera, point), pixel, atol=1e-8, err_msg=name)
            np.testing.assert_allclose(camera.project(points), pixels, atol=1e-8)
            np.testing.assert_allclose(camera.project(points, origin="corner"), pixels + 0.5, atol=1e-8)
            np.testing.assert_allclose(
                camera.unproject(pixels + 0.5, camera.depth(points), origin="corner"), points, atol=1e-8
            )

    def test_the_axis_and_shapes(self):
        for name in LENSES:
            camera = camera_of(name)
            ahead = camera.center + 5 * camera.R[2]
            np.testing.assert_allclose(camera.project(ahead), [317.3, 241.8], atol=1e-9)
            self.assertEqual(camera.project(np.tile(ahead, (2, 3, 1))).shape, (2, 3, 2))
            self.assertTrue(np.isnan(camera.project(camera.center - camera.R[2])).all())
        self.assertEqual(camera.project(np.empty((0, 3))).shape, (0, 2))
        with self.assertRaises(ValueError):
            camera.project([1, 2])
        with self.assertRaises(ValueError):
            camera.project([1, 2, 3], origin="middle")

    def test_ground(self):
        for name in LENSES:
            camera = camera_of(name)
            pixels = np.array([[300.0, 200], [120, 370], [500, 300]])
            ground = camera.unproject_to_ground(pixels, z_m=0.5)
            np.testing.assert_allclose(ground[:, 2], 0.5, atol=1e-9)
            np.testing.assert_allclose(camera.project(ground), pixels, atol=1e-8)
        level = Camera(640, 480, camera.K, np.array([[0, -1, 0], [0, 0, -1], [1, 0, 0]]), np.array([0, 5.0, 0]))
        self.assertTrue(np.isnan(level.unproject_to_ground([320, 100])).all())
        self.assertTrue(np.isfinite(level.unproject_to_ground([320, 400])).all())

    def test_where_a_lens_ends(self):
        # Barrel distortion r (1 - 0.28 r^2) turns back at r = 1 / sqrt(3 * 0.28).
        camera = Camera(
            640,
            480,
            np.array([[300, 0, 320], [0, 300, 240], [0, 0, 1.0]]),
            model="brown_conrady",
            distortion={"k1": -0.28},
        )
        self.assertAlmostEqual(camera.lens.limit, 1 / math.sqrt(0.84), places=6)
        self.assertTrue(np.isfinite(camera.project([1.09, 0, 1])).all())
        self.assertTrue(np.isnan(camera.project([1.10, 0, 1])).all())
        self.assertTrue(np.isnan(camera.directions([639 + 300, 240])).all())
        fisheye = Camera(640, 480, camera.K, model="fisheye", distortion={})
        self.assertAlmostEqual(math.degrees(math.atan(fisheye.lens.limit)), 80, places=6)

    def test_undistort(self):
        rows, columns = np.mgrid[0:480, 0:640].astype(float)
        interior = np.zeros((480, 640))
        interior[1:-1, 1:-1] = 1
        for name in LENSES:
            camera = camera_of(name)
            # An image whose values say where in the undistorted image they belong.
            straight = camera.undistort_points(np.stack((columns, rows), axis=-1))
            flat = camera.undistort(straight)
            seen = (flat[..., 0] > 30) & (flat[..., 0] < 600) & (flat[..., 1] > 30) & (flat[..., 1] < 440)
            seen &= camera.undistort(interior) == 1
            self.assertGreater(seen.mean(), 0.3, name)
            np.testing.assert_allclose(flat[seen][:, 0], columns[seen], atol=0.05, err_msg=name)
            np.testing.assert_allclose(flat[seen][:, 1], rows[seen], atol=0.05, err_msg=name)
            point = camera.unproject([411.0, 97.0], 20.0)
            np.testing.assert_allclose(
                camera.undistort_points([411.0, 97.0]), camera.pinhole().project(point), atol=1e-8
            )
            labels = np.arange(640 * 480, dtype=np.int32).reshape(480, 640)
            self.assertEqual(camera.undistort(labels, interpolate=False).dtype, np.int32)

    def test_damaged_records(self):
        good = {"K": np.eye(3).tolist(), "R": np.eye(3).tolist(), "t": [0, 0, 0], "model": "pinhole"}
        Camera.from_record(good, 4, 4)
        for change in (
            {"K": [[1, 0], [0, 1]]},
            {"t": None},
            {"K": "x"},
            {"R": [[math.nan] * 3] * 3},
            {"distortion": [1]},
            {"K": (-np.eye(3)).tolist()},
        ):
            with self.subTest(change=change), self.assertRaises(DatasetError):
                Camera.from_record({**good, **change}, 4, 4)
        for model, distortion in (("panorama", {}), ("fisheye", {"p1": 0.1}), ("brown_conrady", {"k9": 1.0})):
            with self.assertRaises(DatasetError):
                Camera(4, 4, np.eye(3), model=model, distortion=distortion).project([0, 0, 1])


class Labels(unittest.TestCase):
    """The program's own labels, which come from camera/."""

    def setUp(self):
        self.dataset = Dataset(common.dataset_folder())

    def test_keypoints_and_heads(self):
        compared = 0
        for frame in self.dataset:
            people = frame.people
            labeled = people.keypoints[..., 2] > 0
            pixels = frame.camera.project(people.keypoints_3d, origin="corner")
            # Places are rounded to 1 mm, pixels to 0.01.
            np.testing.assert_allclose(pixels[labeled], people.keypoints[..., :2][labeled], atol=0.05)
            compared += labeled.sum()
        self.assertGreater(compared, 1000)

    def test_boxes_3d_project_around_the_amodal_boxes(self):
        for frame in self.dataset.filter(cameras=["d1"]):
            corners = frame.camera.project(frame.people.corners_3d(), origin="corner")
            boxes = frame.people.boxes_amodal
            self.assertTrue((corners.min(axis=1) <= boxes[:, :2] + 1).all())
            self.assertTrue((corners.max(axis=1) >= boxes[:, :2] + boxes[:, 2:] - 1).all())

    def test_depth_of_ground_is_on_the_ground(self):
        for frame in self.dataset:
            ground = frame.instances() == 0xFF0000
            rows, columns = np.nonzero(ground)
            depth = frame.depth()[ground]
            near = depth < 60
            pixels, depth = np.stack((columns, rows), axis=-1)[near].astype(float), depth[near]
            self.assertGreater(near.sum(), 5000)
            off = np.abs(frame.camera.depth(frame.camera.unproject_to_ground(pixels)) - depth)
            # Depth is in centimeters; with a lens it may be that of half a pixel away at the edge of a body.
            self.assertLess(np.quantile(off, 0.99), 0.006)
            self.assertLess((off / depth).max(), 0.01)
            heights = frame.camera.unproject(pixels, depth)[:, 2]
            self.assertLess(np.quantile(np.abs(heights), 0.99), 0.03)

    def test_lens_masks_are_where_directions_exist(self):
        rows, columns = np.mgrid[0:200, 0:320].astype(float)
        for frame in self.dataset:
            seen = np.isfinite(frame.camera.directions(np.stack((columns, rows), axis=-1))).all(axis=-1)
            np.testing.assert_array_equal(seen, frame.lens_mask())
        self.assertFalse(self.dataset.filter(cameras=["d3"])[0].lens_mask().all())

    def test_centers(self):
        for frame in self.dataset:
            np.testing.assert_allclose(frame.camera.center, frame.record["camera"]["centre"], atol=1e-9)

    def test_flow_of_standing_ground(self):
        """Ground moves as depth and the next frame's camera say; the drones here drift by centimeters."""
        frames = self.dataset.filter(runs=["run000"], cameras=["d2"])
        flow, known = frames[0].flow()
        ground = known & (frames[0].instances() == 0xFF0000) & (frames[0].depth() < 50)
        rows, columns = np.nonzero(ground)
        pixels = np.stack((columns, rows), axis=-1).astype(float)
        moved = frames[1].camera.project(frames[0].camera.unproject_to_ground(pixels))
        both = np.isfinite(moved).all(axis=-1)
        self.assertGreater(both.sum(), 1000)
        self.assertLess(np.abs(moved - pixels - flow[ground])[both].max(), 0.1)

    def test_motion_in_the_world_leads_where_flow_does(self):
        for camera in ("d1", "d2"):
            before, after = self.dataset.filter(runs=["run000"], cameras=[camera])[:2]
            flow, known = before.flow()
            motion = before.scene_flow()
            person = known & (before.instances() < 0x400000) & (before.instances() > 0)
            self.assertGreater(person.sum(), 30)
            rows, columns = np.nonzero(person)
            pixels = np.stack((columns, rows), axis=-1).astype(float)
            points = before.camera.unproject(pixels, before.depth()[person]) + motion[person]
            off = np.linalg.norm(after.camera.project(points) - pixels - flow[person], axis=-1)
            self.assertLess(
                np.nanquantile(off, 0.95), 0.5 if camera == "d1" else 1.5
            )  # a lens shows depth beside edges
            self.assertTrue((motion[before.instances() == 0xFF0000] == 0).all())
            self.assertTrue(np.isnan(motion[before.instances() == 0]).all())

    def test_backward_flow_undoes_flow_where_occlusion_says_visible(self):
        before, after = self.dataset.filter(runs=["run000"], cameras=["d1"])[:2]
        flow, known = before.flow()
        back, back_known = after.flow(backward=True)
        target = before.flow_occlusion()
        np.testing.assert_array_equal(target == 0, ~known)
        self.assertTrue((target == 1).any())
        rows, columns = np.nonzero(target == 1)
        to = np.rint(np.stack((columns, rows), axis=-1) + flow[rows, columns]).astype(int)
        inside = ((to >= 0) & (to < [before.width, before.height])).all(axis=-1)
        self.assertGreater(inside.mean(), 0.99)
        to, rows, columns = to[inside], rows[inside], columns[inside]
        usable = back_known[to[:, 1], to[:, 0]]
        off = np.linalg.norm(back[to[:, 1], to[:, 0]] + flow[rows, columns], axis=-1)[usable]
        self.assertLess(np.quantile(off, 0.98), 1)
        self.assertFalse(before.flow(backward=True)[1].any())


if __name__ == "__main__":
    common.main()
