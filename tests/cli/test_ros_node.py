"""The ROS 1 node of examples/ros with a rosmaster, rospy and rostopic of Debian, and a live flight."""
import base64
import io
import json
import math
import os
import queue
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import genpy
import rosgraph
import rospy
from free_ports import free_port
from geometry_msgs.msg import PoseStamped, Quaternion, Twist
from mcap import read_recording
from nav_msgs.msg import Odometry, Path
from PIL import Image
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, CompressedImage, FluidPressure, Imu
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from program import ROOT, THRONG, FolderTest

sys.path.insert(0, str(ROOT / "examples/ros"))
import throng_ros1  # noqa: E402
from foxglove_client import FoxgloveClient  # noqa: E402

PATIENCE_S = 300  # of a busy machine
START = [-24.5, -6.5, 20]
JOB = {
    "name": "ros",
    "scenario": "city_square/nearest_exit",
    "crowd": {"agents": 40},
    "seed": 5,
    "drones": [{"id": "d1", "start": START}, {"id": "d-2", "start": [5, 5, 15]}],
}
SAMPLES_PER_S = 60  # of a drone's state
IMAGE = "/d1/camera/image_color/compressed"


def setUpModule():
    """Starts a rosmaster of this test's own, with nothing but its folder and this machine's inner network."""
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    port = free_port()
    os.environ.update(
        ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", ROS_HOME=folder.name, PYTHONUNBUFFERED="1"
    )
    for name in ("ROS_HOSTNAME", "ROS_LOG_DIR", "ROS_NAMESPACE", "ROSCONSOLE_FORMAT"):
        os.environ.pop(name, None)
    master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL)
    unittest.addModuleCleanup(end, master)
    poll(lambda: master.poll() is not None or rosgraph.is_master_online())
    rospy.init_node("test", disable_signals=True)
    unittest.addModuleCleanup(rospy.signal_shutdown, "the tests are over")


def end(process):
    process.kill()
    process.wait()


def poll(condition):
    """Waits until it holds."""
    begun = time.monotonic()
    while not condition():
        assert time.monotonic() - begun < PATIENCE_S, "nothing has come"
        time.sleep(0.05)


def seconds(stamp):
    return stamp.secs + stamp.nsecs * 1e-9


def heading_deg(orientation):
    return math.degrees(2 * math.atan2(orientation.z, orientation.w))


def plain(value):
    """A message of ROS 1 as JSON has that of ROS 2, but for the sequence number of headers."""
    if isinstance(value, genpy.rostime.TVal):
        return {"sec": value.secs, "nanosec": value.nsecs}
    if isinstance(value, genpy.Message):
        return {slot.lower(): plain(getattr(value, slot)) for slot in value.__slots__ if slot != "seq"}
    if isinstance(value, bytes):
        return base64.b64encode(value).decode()
    return [plain(each) for each in value] if isinstance(value, (list, tuple)) else value


def covered(found, recorded):
    """The fields of the record that are found, too: ROS 1 has fewer."""
    if isinstance(found, dict):
        return {name: covered(value, getattr(recorded, name)) for name, value in found.items()}
    if isinstance(found, list):
        return [covered(*pair) for pair in zip(found, recorded)] if len(found) == len(recorded) else recorded
    return recorded


class Watch:
    """Messages of a topic, in the order in which they come."""

    def __init__(self, topic, message_class):
        self.topic = topic
        self.arrived = queue.Queue()
        self.subscriber = rospy.Subscriber(topic, message_class, self.arrived.put, queue_size=100_000)

    def next(self):
        return self.arrived.get(timeout=PATIENCE_S)

    def until(self, condition, within_s=None):
        """The first message for which it holds, for stamped ones within this simulated time."""
        message = first = self.next()
        while not condition(message):
            message = self.next()
            if within_s is not None:
                waited_s = seconds(message.header.stamp) - seconds(first.header.stamp)
                assert waited_s < within_s, f"{self.topic}: found {message}"
        return message


class RosNode(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder / "job.json").write_text(json.dumps(JOB))

    def begin_flight(self, *options):
        """Starts a flight; returns its address."""
        command = [THRONG, "live", self.folder / "job.json", "--port", "0", *options]
        with open(self.folder / "flight.txt", "w") as log:
            self.flight = subprocess.Popen(list(map(str, command)), stdout=log, stderr=log)
        self.addCleanup(end, self.flight)
        address = re.compile(r"ws://[\d.:]+")
        poll(lambda: self.flight.poll() is not None or address.search((self.folder / "flight.txt").read_text()))
        return address.search((self.folder / "flight.txt").read_text())[0]

    def begin_node(self, *arguments):
        with open(self.folder / "node.txt", "w") as log:
            self.node = subprocess.Popen(
                [sys.executable, ROOT / "examples/ros/throng_ros1.py", *arguments], stdout=log, stderr=log
            )
        self.addCleanup(end, self.node)

    def node_end(self):
        """The node's exit status and its words."""
        return self.node.wait(PATIENCE_S), (self.folder / "node.txt").read_text()

    def watch(self, topic, message_class):
        watch = Watch(topic, message_class)
        self.addCleanup(watch.subscriber.unregister)
        poll(lambda: watch.subscriber.get_num_connections() > 0)
        return watch

    def publisher(self, topic, message_class):
        publisher = rospy.Publisher(topic, message_class, queue_size=10)
        self.addCleanup(publisher.unregister)
        poll(lambda: publisher.get_num_connections() > 0)
        return publisher

    def call(self, service):
        rospy.wait_for_service(service, PATIENCE_S)
        answer = rospy.ServiceProxy(service, Trigger)()
        return answer.success, answer.message

    def assert_near(self, point, expected, within_m):
        for found, wanted in zip((point.x, point.y, point.z), expected, strict=True):
            self.assertLess(abs(found - wanted), within_m, point)

    def test_states_and_readings(self):
        self.begin_node(self.begin_flight("--paused", "--factor", 4, "--no-camera"))
        self.assertTrue(self.call("/throng/resume")[0])
        self.assertIs(rospy.get_param("/use_sim_time"), True)
        odometry = self.watch("/d1/odometry", Odometry)
        clock = self.watch("/clock", Clock)

        before = seconds(clock.next().clock)
        after = seconds(clock.until(lambda message: seconds(message.clock) > before + 1).clock)
        state, following = odometry.next(), odometry.next()
        self.assertEqual((state.header.frame_id, state.child_frame_id), ("world", "d1/base_link"))
        self.assert_near(state.pose.pose.position, START, 0.5)  # nobody commands it
        self.assertAlmostEqual(heading_deg(state.pose.pose.orientation), 90, delta=5)
        passed_s = seconds(following.header.stamp) - seconds(state.header.stamp)
        self.assertAlmostEqual(passed_s, 1 / SAMPLES_PER_S, places=6)
        odometry.until(lambda message: seconds(message.header.stamp) > after)

        reading = self.watch("/d1/imu", Imu).next()
        force = [getattr(reading.linear_acceleration, axis) for axis in "xyz"]
        self.assertAlmostEqual(math.hypot(*force), 9.81, delta=1.5)
        self.assertGreater(force[2], 8)  # upright
        self.assertEqual(reading.orientation_covariance[0], -1)  # there is no orientation
        pressure_pa = self.watch("/d1/pressure", FluidPressure).next().fluid_pressure
        self.assertTrue(90_000 < pressure_pa < 110_000, pressure_pa)

        # The mode is sent to those who come later, too.
        for _ in range(2):
            mode = self.watch("/d1/mode", String)
            self.assertIs(json.loads(mode.next().data)["beacon"], False)
            mode.subscriber.unregister()

        # By rostopic's clock, which is that of the flight.
        hz = subprocess.Popen(["rostopic", "hz", "/d1/odometry"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.addCleanup(hz.stdout.close)
        self.addCleanup(end, hz)
        rate = 0.0
        while abs(rate - SAMPLES_PER_S) > 3:
            line = hz.stdout.readline().decode()
            self.assertTrue(line, "rostopic has ended")
            if found := re.match(r"average rate: ([\d.]+)", line):
                rate = float(found[1])

    def test_images_are_drawn_while_somebody_looks(self):
        self.begin_node(self.begin_flight("--factor", 4))
        transforms = self.watch("/tf", TFMessage)

        def time_s():
            """The next time of a transform, and whether it is that of an image: between the drone's samples."""
            samples = seconds(transforms.next().transforms[0].header.stamp) * SAMPLES_PER_S
            return samples / SAMPLES_PER_S, abs(samples - round(samples)) > 1e-4

        lens = self.watch("/d1/camera/camera_info", CameraInfo)
        shown = self.watch(IMAGE, CompressedImage)
        message, info = shown.next(), lens.next()
        self.assertEqual((info.width, info.height, info.distortion_model), (640, 360, "plumb_bob"))
        self.assertEqual((info.K[2], info.K[5], info.K[8], len(info.D)), (319.5, 179.5, 1, 5))
        self.assertEqual((info.P[0], info.P[5]), (info.K[0], info.K[4]))
        self.assertEqual((message.format, message.header.frame_id), ("jpeg", info.header.frame_id))
        with Image.open(io.BytesIO(message.data)) as image:
            self.assertEqual((image.format, image.size), ("JPEG", (640, 360)))
            image.load()
        frames = set()
        while not frames >= {"d1/base_link", "d_2/base_link", info.header.frame_id}:
            frames |= {each.child_frame_id for each in transforms.next().transforms}
        while not time_s()[1]:
            pass

        lens.subscriber.unregister()
        shown.subscriber.unregister()
        begun_s = last_image_s = now_s = time_s()[0]
        while now_s < last_image_s + 4:
            now_s, is_image = time_s()
            last_image_s = now_s if is_image else last_image_s
            self.assertLess(now_s, begun_s + 60)
        self.watch(IMAGE, CompressedImage).next()

    def test_commands_are_flown(self):
        self.begin_node(self.begin_flight("--factor", 4, "--no-camera"))
        odometry = self.watch("/d1/odometry", Odometry)
        mode = self.watch("/d1/mode", String)

        velocity = Twist()
        velocity.linear.x = 3  # ahead: to the north
        self.publisher("/d1/cmd_vel", Twist).publish(velocity)
        x, y, z = START
        state = odometry.until(lambda each: each.pose.pose.position.y > y + 1, within_s=20)
        self.assert_near(state.pose.pose.position, [x, y + 1, z], 0.5)

        goal = PoseStamped()
        goal.header.frame_id = "world"
        position = goal.pose.position
        position.x, position.y, position.z = x - 4, y + 5, z - 3
        goal.pose.orientation.z = 1  # to the west

        def is_there(message, point, turn_deg):
            pose = message.pose.pose
            way = [getattr(pose.position, axis) - getattr(point, axis) for axis in "xyz"]
            turned_deg = (heading_deg(pose.orientation) - turn_deg + 180) % 360 - 180
            return math.hypot(*way) < 0.5 and abs(turned_deg) < 5

        self.publisher("/d1/cmd_pose", PoseStamped).publish(goal)
        odometry.until(lambda each: is_there(each, position, 180), within_s=60)

        path = Path()
        for corner in [[5, 8, 15], [8, 8, 14]]:
            path.poses.append(PoseStamped())
            point = path.poses[-1].pose.position
            point.x, point.y, point.z = corner
        path.poses[-1].pose.orientation = Quaternion(0, 0, 1, 0)
        other = self.watch("/d_2/odometry", Odometry)
        self.publisher("/d_2/cmd_waypoints", Path).publish(path)
        other.until(lambda each: is_there(each, point, 180), within_s=60)

        beacon = self.publisher("/d1/beacon", Bool)
        for on in (True, False):
            beacon.publish(on)
            mode.until(lambda each: json.loads(each.data)["beacon"] == on)

        # 60 degrees down (positive about y), which the camera's frame in /tf shows: its z looks ahead.
        self.publisher("/d1/gimbal", Quaternion).publish(Quaternion(0, 0.5, 0, 3**0.5 / 2))

        def pitch_deg(message):
            for each in message.transforms:
                if each.child_frame_id == "d1/camera_optical_frame":
                    q = each.transform.rotation
                    return math.degrees(math.asin(1 - 2 * (q.x**2 + q.y**2)))
            return 0

        transforms = self.watch("/tf", TFMessage)
        poll(lambda: abs(pitch_deg(transforms.next()) + 60) < 1)

        velocity.linear.x = 99
        self.publisher("/d1/cmd_vel", Twist).publish(velocity)
        refused = re.compile(r"\[ERROR\].*/d1/cmd_vel: /linear: found \[99")
        poll(lambda: refused.search((self.folder / "node.txt").read_text()))

    def test_services(self):
        self.begin_node(self.begin_flight("--factor", 4, "--no-camera"))
        clock = self.watch("/clock", Clock)
        clock.next()
        success, message = self.call("/throng/step")
        self.assertFalse(success)
        self.assertIn("not paused", message)

        self.assertEqual(self.call("/throng/pause"), (True, ""))
        quiet = False
        while not quiet:  # a flight that goes on has 240 messages in this time
            try:
                paused_s = seconds(clock.arrived.get(timeout=1).clock)
            except queue.Empty:
                quiet = True
        for _ in range(2):
            self.assertEqual(self.call("/throng/step"), (True, ""))
        clock.until(lambda message: abs(seconds(message.clock) - paused_s - 0.2) < 1e-6)
        self.assertEqual(self.call("/throng/resume"), (True, ""))
        clock.until(lambda message: seconds(message.clock) > paused_s + 1)
        self.assertEqual(self.call("/throng/reset"), (True, ""))
        clock.until(lambda message: seconds(message.clock) == 0)
        self.assertEqual(self.call("/throng/stop"), (True, ""))
        status, words = self.node_end()
        self.assertEqual(status, 0, words)
        self.assertIn("the flight has ended, and with it this node", words)
        self.assertNotIn("Traceback", words)
        self.assertEqual(self.flight.wait(PATIENCE_S), 0)

    def test_the_end_of_the_connection_and_of_the_node(self):
        address = self.begin_flight("--no-camera")
        self.begin_node(address, "_sim_time:=false")
        self.watch("/clock", Clock).next()
        self.node.send_signal(signal.SIGINT)
        status, words = self.node_end()
        self.assertEqual((status, "Traceback" in words), (0, False), words)

        rospy.set_param("/use_sim_time", False)
        self.begin_node(address, "_sim_time:=false")
        self.watch("/clock", Clock).next()
        self.assertIs(rospy.get_param("/use_sim_time"), False)
        self.flight.kill()
        status, words = self.node_end()
        self.assertEqual(status, 1, words)
        self.assertIn(f"the connection to {address} was lost", words)
        self.assertNotIn("Traceback", words)

        self.begin_node(address)
        status, words = self.node_end()
        self.assertEqual(status, 1, words)
        self.assertIn(f"cannot connect to {address}", words)

    def test_messages_are_decoded_as_others_do(self):
        """All that a client gets from a flight is in its recording, which @foxglove/rosmsg2-serialization reads."""
        file = self.folder / "flight.mcap"
        client = FoxgloveClient(self.begin_flight("--paused", "--record", file))
        decoders = {
            topic: throng_ros1.Decoder(each.schema_name, each.schema) for topic, each in client.channels.items()
        }
        got = {}
        client.start(lambda channel, data: got.setdefault(channel.topic, []).append(data), lambda level, text: None)
        client.subscribe_to(set(client.channels) - {"/ground_truth/detections_3d"})
        for _ in range(10):
            self.assertEqual(client.call("/throng/step"), (True, ""))
        poll(lambda: IMAGE in got)
        self.assertEqual(client.call("/throng/stop"), (True, ""))
        self.assertTrue(client.wait(PATIENCE_S))
        self.assertEqual(client.problem, "")
        self.assertEqual(self.flight.wait(PATIENCE_S), 0)

        _, recorded = read_recording(file)
        self.assertGreater(len(got["/d1/odometry"]), 50)
        kinds = set()
        for topic, messages in got.items():
            if topic.startswith("/d_2/camera"):
                continue  # the recording has the images of one drone
            kinds.add(decoders[topic].name)
            found = [plain(decoders[topic].decode(data)) for data in messages]
            expected = [each.message for each in recorded[topic]]
            for message in found:
                self.assertTrue(any(covered(message, each) == message for each in expected), (topic, message))
        self.assertGreaterEqual(len(kinds), 12, kinds)

    def test_commands_of_new_messages(self):
        self.assertEqual(throng_ros1.pose_command(PoseStamped()), {"position": {"x": 0, "y": 0, "z": 0}})
        self.assertEqual(throng_ros1.path_command(Path()), {"waypoints": []})
        self.assertEqual(throng_ros1.path_command(Path(poses=[PoseStamped()])), {"waypoints": [[0, 0, 0]]})


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")  # rospy leaves its sockets to the collector
