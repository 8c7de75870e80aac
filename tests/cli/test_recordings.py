"""MCAP recordings of a dataset, read by @mcap/core and @foxglove/rosmsg2-serialization of npm, and compared with it."""
import base64
import csv
import json
import pathlib
import resource
import signal
import tempfile
import unittest

import numpy
from PIL import Image

from mcap import matrix_of, read_recording
from program import made, throng


JOB = {
    "name": "recordings",
    "scenario": "city_square/nearest_exit",
    "seed": 5,
    "runs": 2,
    "drones": [
        {
            "id": "d1",
            "start": [-24, -6, 14],
            "camera": {
                "width": 320,
                "height": 200,
                "hfov_deg": 80,
                "pitch_deg": -40,
                "yaw_deg": -90,
                "gimbal": {"model": "rigid"},
                "mount": {"x_m": 0.1, "z_m": -0.05},
            },
        }
    ],
    "capture": {"rate_hz": 1, "from_s": 6, "to_s": 9},
    "outputs": {"annotations": ["coco", "depth", "instances", "sensors"]},
}

RECORDED = {
    "/clock": "rosgraph_msgs/msg/Clock",
    "/tf": "tf2_msgs/msg/TFMessage",
    "/d1/odometry": "nav_msgs/msg/Odometry",
    "/d1/imu": "sensor_msgs/msg/Imu",
    "/d1/magnetic_field": "sensor_msgs/msg/MagneticField",
    "/d1/pressure": "sensor_msgs/msg/FluidPressure",
    "/d1/fix": "sensor_msgs/msg/NavSatFix",
    "/d1/fix_velocity": "geometry_msgs/msg/TwistStamped",
    "/d1/camera/camera_info": "sensor_msgs/msg/CameraInfo",
    "/d1/camera/image_color/compressed": "sensor_msgs/msg/CompressedImage",
    "/d1/camera/depth": "sensor_msgs/msg/Image",
    "/d1/camera/instances": "sensor_msgs/msg/Image",
    "/d1/ground_truth/boxes": "visualization_msgs/msg/MarkerArray",
    "/d1/ground_truth/detections_2d": "vision_msgs/msg/Detection2DArray",
    "/d1/ground_truth/detections_3d": "vision_msgs/msg/Detection3DArray",
    "/d1/ground_truth/annotations": "std_msgs/msg/String",
}


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.dataset = cls.base / "job/dataset"
        cls.out = cls.base / "out"
        made(cls.base, JOB)
        throng("export", cls.dataset, "-o", cls.out, "--formats", "mcap", "--split", "val=run001")
        cls.coco = json.loads((cls.dataset / "annotations/instances.json").read_text())

    def people(self, image):
        return [person for person in self.coco["annotations"] if person["image_id"] == image["id"]]

    def test_mcap_core_replays_the_runs(self):
        for run, split in (("run000", "train"), ("run001", "val")):
            images = [image for image in self.coco["images"] if image["run"] == run]
            head, topics = read_recording(self.out / f"mcap/{split}/{run}.mcap")
            self.assertEqual(head["profile"], "ros2")
            self.assertEqual(head["messages"], sum(map(len, topics.values())))
            self.assertEqual({topic: messages[0].type for topic, messages in topics.items()}, RECORDED)
            readings = {"/d1/imu", "/d1/magnetic_field", "/d1/pressure", "/d1/fix", "/d1/fix_velocity"}
            for topic in set(topics) - readings:
                self.assertEqual(len(topics[topic]), len(images), topic)
            for i, image in enumerate(images):
                at = {topic: messages[i].message for topic, messages in topics.items()}
                self.assertEqual(at["/clock"].clock.sec + 1e-9 * at["/clock"].clock.nanosec, image["time_s"])
                self.check_image(at, image)
                self.check_boxes(at["/d1/ground_truth/boxes"].markers, self.people(image))
                self.check_detections(at, self.people(image))
                self.check_transforms(at["/tf"].transforms, image, at["/d1/odometry"])
            self.check_readings(run, topics, images)

    def check_image(self, at, image):
        picture, lens = at["/d1/camera/image_color/compressed"], at["/d1/camera/camera_info"]
        for message in (picture, lens, at["/d1/odometry"], at["/tf"].transforms[0], at["/d1/camera/depth"]):
            stamp = message.header.stamp
            self.assertAlmostEqual(stamp.sec + 1e-9 * stamp.nanosec, image["time_s"], places=8)
        self.assertEqual(base64.b64decode(picture.data), (self.dataset / image["file_name"]).read_bytes())
        numpy.testing.assert_array_equal(numpy.reshape(lens.k, (3, 3)), image["camera"]["K"])
        self.assertEqual((lens.distortion_model, lens.d), ("plumb_bob", [0.0] * 5))
        annotations = json.loads(at["/d1/ground_truth/annotations"].data)["annotations"]
        self.assertEqual(annotations[0]["id"], self.people(image)[0]["id"])
        name = image["file_name"].removeprefix("images/").rsplit(".", 1)[0] + ".png"
        stored = numpy.asarray(Image.open(self.dataset / "depth" / name)).astype(float)
        depth = at["/d1/camera/depth"]
        self.assertEqual((depth.width, depth.height, depth.encoding), (320, 200, "32FC1"))
        meters = numpy.frombuffer(base64.b64decode(depth.data), "<f4").reshape(200, 320)
        numpy.testing.assert_allclose(meters[stored > 0], stored[stored > 0] / 100, rtol=1e-6)
        self.assertTrue(numpy.isinf(meters[stored == 0]).all())
        colors = numpy.asarray(Image.open(self.dataset / "instances" / name)).astype(int)
        ids = numpy.frombuffer(base64.b64decode(at["/d1/camera/instances"].data), "<i4").reshape(200, 320)
        numpy.testing.assert_array_equal(ids, colors[..., 0] + 256 * colors[..., 1] + 65536 * colors[..., 2])

    def check_detections(self, at, people):
        solid, flat = at["/d1/ground_truth/detections_3d"].detections, at["/d1/ground_truth/detections_2d"].detections
        self.assertEqual([int(each.id) for each in solid], [person["track_id"] % 1000000 for person in people])
        self.assertEqual([each.id for each in flat], [each.id for each in solid])
        for box, rectangle, person in zip(solid, flat, people):
            size, center = box.bbox.size, rectangle.bbox.center.position
            numpy.testing.assert_allclose([size.x, size.y, size.z], person["box_3d"][3:6])
            x, y, width, height = person["bbox"]
            numpy.testing.assert_allclose([center.x, center.y], [x + width / 2, y + height / 2])
            numpy.testing.assert_allclose([rectangle.bbox.size_x, rectangle.bbox.size_y], [width, height])
            self.assertEqual(box.results[0].hypothesis.class_id, "person")

    def check_readings(self, run, topics, images):
        """All rows of the table of sensors from 1 s before the first image on."""
        with open(self.dataset / f"sensors/{run}/d1.csv") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        first, last = images[0]["time_s"] - 1, images[-1]["time_s"]
        rows = [row for row in rows if first <= row["time_s"] <= last]
        for topic in ("/d1/imu", "/d1/magnetic_field", "/d1/pressure"):
            self.assertEqual(len(topics[topic]), len(rows), topic)
        for i, row in enumerate(rows):
            rates = topics["/d1/imu"][i].message.angular_velocity
            numpy.testing.assert_allclose([rates.x, rates.y, rates.z], [row[f"gyro_{axis}_rad_s"] for axis in "xyz"])
            field = topics["/d1/magnetic_field"][i].message.magnetic_field
            numpy.testing.assert_allclose(
                [field.x, field.y, field.z], [1e-6 * row[f"magnetometer_{axis}_ut"] for axis in "xyz"]
            )
            self.assertEqual(topics["/d1/pressure"][i].message.fluid_pressure, row["pressure_pa"])
        fixes = {row["gps_time_s"]: row for row in rows}
        self.assertEqual(len(topics["/d1/fix"]), len(fixes))
        for message, row in zip(topics["/d1/fix"], fixes.values()):
            fix = message.message
            degree_m = 111_132  # along a meridian at 45 degrees; a parallel is shorter by the cosine
            self.assertAlmostEqual((fix.latitude - 45) * degree_m, row["gps_y_m"], delta=0.02)
            self.assertAlmostEqual(fix.longitude * 78_847, row["gps_x_m"], delta=0.02)
            self.assertEqual(fix.altitude, row["gps_z_m"])

    def check_boxes(self, markers, people):
        cubes = [marker for marker in markers if marker.action == 0]
        self.assertEqual(len(cubes), len(people))
        for cube, person in zip(cubes, people):
            self.assertEqual(cube.id, person["track_id"] % 1000000)
            place = cube.pose.position
            numpy.testing.assert_allclose([place.x, place.y, place.z], person["box_3d"][:3])
            turn = cube.pose.orientation
            difference = 2 * numpy.arctan2(turn.z, turn.w) - person["heading"]
            self.assertAlmostEqual(numpy.cos(difference), 1, places=9)

    def check_transforms(self, transforms, image, odometry):
        """From the camera to the world, step by step: as the image's record says."""
        pose = numpy.eye(4)
        for transform, frames in zip(
            transforms, (("world", "d1/base_link"), ("d1/base_link", "d1/camera_optical_frame"))
        ):
            self.assertEqual((transform.header.frame_id, transform.child_frame_id), frames)
            pose = pose @ matrix_of(transform.transform)
        numpy.testing.assert_allclose(pose[:3, :3].T, image["camera"]["R"], atol=1e-9)
        numpy.testing.assert_allclose(pose[:3, 3], image["camera"]["centre"], atol=1e-9)
        true, place = image["flight"]["true"], odometry.pose.pose.position
        numpy.testing.assert_allclose([place.x, place.y, place.z], true["position"], atol=1e-9)
        speed = odometry.twist.twist.linear
        self.assertAlmostEqual(numpy.linalg.norm([speed.x, speed.y, speed.z]), numpy.linalg.norm(true["velocity"]))

    def test_full_disk_leaves_a_complete_recording(self):
        """A limit for files does what a full disk does; the whole recording of these images has 4.5 MB."""

        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, resource.RLIM_INFINITY))

        job = dict(JOB, runs=1, capture={"rate_hz": 8, "from_s": 6, "to_s": 12})
        made(self.base, job, "long")
        out = self.base / "full"
        done = throng(
            *("export", self.base / "long/dataset", "-o", out, "--formats", "mcap"),
            preexec_fn=limit_files,
            restore_signals=False,
            code=3,
        )
        self.assertIn("the recording is complete until", done.stderr)
        self.assertIn("full.partial", done.stderr)
        self.assertFalse(out.exists())
        head, topics = read_recording(self.base / "full.partial/train/run000.mcap")
        self.assertGreater(head["chunks"], 1)
        self.assertEqual(head["messages"], sum(map(len, topics.values())))


if __name__ == "__main__":
    unittest.main()
