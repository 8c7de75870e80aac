"""Live flights against the real server: flown by commands, repeated by a job, ended when nobody looks."""
import base64
import csv
import hashlib
import json
import math
import os
import pathlib
import subprocess
import sys
import threading
import time
import unittest

import numpy

from mcap import matrix_of, read_recording
import program
from program import THRONG, FolderTest
from service import start_service, wait_until

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))

import throng  # noqa: E402
from throng.errors import ServiceError  # noqa: E402

JOB = {
    "name": "live",
    "scenario": "city_square/nearest_exit",
    "crowd": {"agents": 40},
    "seed": 5,
    "runs": 3,
    "quality": "draft",
    "drones": [
        {
            "id": "d1",
            "start": [-24.3, -6.7, 20.1],
            "camera": {"width": 160, "height": 120, "pitch_deg": -60},
            "moves_goal": [99, 0],
            "guidance": {"policy": "balance"},
        },
        {
            "id": "d2",
            "start": [5, 5, 15],
            "camera": {"width": 160, "height": 120, "pitch_deg": {"uniform": [-70, -50]}},
            "guidance": {"policy": "waypoints", "waypoints": [[10, 5, 15]]},
        },
    ],
    "randomize": {"drones.1.guidance.speed_mps": {"uniform": [1, 4]}, "drones.1.start.0": {"uniform": [3, 6]}},
    "environment": {"wind": {"speed_mps": 3}},
    "capture": {"rate_hz": 1, "from_s": 1, "to_s": 4},
}


RECORDED = {
    "/clock": "rosgraph_msgs/msg/Clock",
    "/tf": "tf2_msgs/msg/TFMessage",
    "/ground_truth/boxes": "visualization_msgs/msg/MarkerArray",
    "/ground_truth/detections_3d": "vision_msgs/msg/Detection3DArray",
}
for name in ("d1", "d2"):
    RECORDED |= {
        f"/{name}/odometry": "nav_msgs/msg/Odometry",
        f"/{name}/imu": "sensor_msgs/msg/Imu",
        f"/{name}/magnetic_field": "sensor_msgs/msg/MagneticField",
        f"/{name}/pressure": "sensor_msgs/msg/FluidPressure",
        f"/{name}/fix": "sensor_msgs/msg/NavSatFix",
        f"/{name}/fix_velocity": "geometry_msgs/msg/TwistStamped",
        f"/{name}/camera/camera_info": "sensor_msgs/msg/CameraInfo",
        f"/{name}/camera/image_color/compressed": "sensor_msgs/msg/CompressedImage",
        f"/{name}/command": "geometry_msgs/msg/TwistStamped",
        f"/{name}/mode": "std_msgs/msg/String",
    }


class WithServer(FolderTest):
    live_timeout_s = 600  # no flight ends by itself while a busy machine gets round to looking at it

    def setUp(self):
        super().setUp()
        self.log = open(self.folder / "log", "w")
        self.addCleanup(self.log.close)
        options = ["--live-timeout", self.live_timeout_s]
        self.server, port = start_service(THRONG, self.folder / "data", *options, stderr=self.log)
        self.addCleanup(self.stop)
        self.url = f"http://127.0.0.1:{port}"
        self.client = throng.Client(self.url, timeout_s=300, patience_s=2)

    def stop(self):
        self.server.terminate()
        self.server.wait(300)
        self.assertNotIn("Sanitizer", (self.folder / "log").read_text())

    def live(self, client=None):
        flight = (client or self.client).live(JOB)

        def end():
            try:
                flight.remove()
            except throng.ThrongError:
                pass  # the server has gone

        self.addCleanup(end)
        return flight


class Live(WithServer):
    def fly(self, flight, until_s, factor=4.0, drones=frozenset()):
        """Flies by a script until a time, and until these drones' images have been seen; returns states and images."""
        received = {"states": [], "images": [], "hello": None, "events": []}
        flight.command({"factor": factor})
        sequence = 0
        view = 0
        for message in flight.messages():
            if isinstance(message, throng.LiveImage):
                received["images"].append(message)
                continue
            if isinstance(message, throng.LiveMessage):
                received["hello" if message.kind == "hello" else "events"] = message.value
                self.assertNotEqual(message.kind, "failure", message.value)
                continue
            received["states"].append(message)
            # Each state changes the view, but images come when they are made.
            shown = {image.drone for image in received["images"]}
            if message.time_s >= until_s and len(received["images"]) > 3 and shown >= drones:
                return received
            sequence += 1
            t = message.time_s
            flight.command(
                {
                    "sequence": sequence,
                    "view": f"d{1 + view}",
                    "drones": [
                        {
                            "id": "d1",
                            "velocity_mps": [5, 1.3, -0.7 if t < 3 else 0.4],
                            "yaw_rate_deg_s": 11.1,
                            "beacon": t > 2,
                        },
                        {"id": "d2", "velocity_mps": [0, -2, 0], "return_home": t > 4},
                    ],
                }
            )
            view = 1 - view if t > 3 else view
        self.fail("the stream ended")

    def test_the_first_message_says_where_smoke_rises(self):
        job = {**JOB, "scenario": "city_square/emergency", "environment": {"smoke": 0.7}}
        flight = self.client.live(job)
        self.addCleanup(flight.remove)
        hello = next(flight.messages()).value
        scenario = json.loads(
            (pathlib.Path(__file__).parents[2] / "scenarios/city_square/emergency.blueprint.json").read_text()
        )
        expected = [(d["kind"], d["position"], d["start_s"]) for d in scenario["disasters"] if d["kind"] != "attacker"]
        self.assertEqual([(d["kind"], d["position"], d["start_s"]) for d in hello["dangers"]], expected)
        self.assertGreater(len(expected), 0)
        self.assertEqual(hello["smoke"], 0.7)

    def test_a_job_repeats_the_flight(self):
        flight = self.live()
        received = self.fly(flight, 8, drones={0, 1})
        hello = received["hello"]
        self.assertEqual([d["id"] for d in hello["drones"]], ["d1", "d2"])
        self.assertEqual(hello["dt_s"], 0.1)
        self.assertGreater(len(hello["exits"]), 3)
        self.assertEqual((hello["smoke"], hello["dangers"]), (0, []))
        last = received["states"][-1]
        self.assertEqual(len(last.people), hello["people"])
        self.assertEqual(sum(1 for p, role in zip(last.people, hello["roles"]) if p["flags"] & 1 and role == 0), 40)
        self.assertEqual([bool(d["flags"] & 1) for d in last.drones], [True, False], "beacons")
        self.assertTrue(all(d["flags"] & 6 == 6 for d in last.drones))
        start = hello["drones"][0]["start"]
        self.assertGreater(sum((a - b) ** 2 for a, b in zip(last.drones[0]["position"], start)) ** 0.5, 5)
        self.assertEqual({p.jpeg[:3] for p in received["images"]}, {b"\xff\xd8\xff"})
        self.assertEqual({p.drone for p in received["images"]}, {0, 1})
        self.assertGreater(max(p.sequence for p in received["images"]), 3)

        result = flight.stop()
        self.assertEqual(flight.state()["state"], "ended")
        self.assertGreaterEqual(result["duration_s"], 8)
        replayed = self.client.submit(result["job"])
        self.assertEqual(self.client.watch(replayed["id"], progress=False)["state"], "succeeded")
        trace = self.client.trace(replayed["id"], 0, self.folder / "trace.h5")
        self.assertEqual(hashlib.sha256(trace.read_bytes()).hexdigest(), result["trace_sha256"])

        # The logs as files beside a job do the same.
        job = json.loads(json.dumps(result["job"]))
        for drone, log in zip(job["drones"], result["drones"]):
            del drone["guidance"]["setpoints"]
            drone["guidance"]["log"] = log["id"] + ".csv"
            (self.folder / (log["id"] + ".csv")).write_text(log["csv"])
        (self.folder / "job.json").write_text(json.dumps(job))
        program.throng("simulate", self.folder / "job.json", "-o", self.folder / "again.h5")
        self.assertEqual(hashlib.sha256((self.folder / "again.h5").read_bytes()).hexdigest(), result["trace_sha256"])
        flight.remove()
        with self.assertRaises(throng.NotFoundError):
            flight.state()

    def test_drones_fly_to_points(self):
        flight = self.live()
        flight.command({"factor": 10})
        goals = [(-24.3, 2, 18), (9, 9, 14)]
        flight.fly("d1", position_m=goals[0], yaw_deg=0, speed_mps=4)
        flight.fly("d2", waypoints_m=[(5, 8, 15), goals[1]])
        for message in flight.messages():
            if not isinstance(message, throng.LiveState):
                continue
            # No more commands: points are flown to without them.
            off = [math.dist(drone["position"], goal) for drone, goal in zip(message.drones, goals)]
            if max(off) < 0.7:
                break
            self.assertLess(message.time_s, 300, off)
        with self.assertRaises(throng.InvalidRequestError) as refused:
            flight.fly("d1", waypoints_m=[(1, 2, 3), (1, 2)])
        self.assertEqual([mistake.pointer for mistake in refused.exception.errors], ["/drones/0/waypoints_m/1"])
        flight.stop()

    def test_gimbals_are_turned(self):
        flight = self.live()
        flight.command({"factor": 10})
        flight.fly("d1", gimbal_deg=(-80, 30))
        for message in flight.messages():
            if not isinstance(message, throng.LiveState):
                continue
            off = [abs(float(found) - wanted) for found, wanted in zip(message.drones["gimbal_deg"][0], (-80, 30))]
            if max(off) < 1e-4:
                break
            self.assertLess(message.time_s, 300, off)
        with self.assertRaises(throng.InvalidRequestError) as refused:
            flight.fly("d1", gimbal_deg=(60, 0))
        self.assertEqual([mistake.pointer for mistake in refused.exception.errors], ["/drones/0/gimbal_deg"])
        job = flight.stop()["job"]
        self.assertEqual(job["drones"][0]["guidance"]["setpoints"][-1][6:], [-80, 30])
        self.assertEqual(len(job["drones"][1]["guidance"]["setpoints"][-1]), 6)

    def test_a_recording_holds_the_flight(self):
        flight = self.client.live(JOB, record=True)
        self.addCleanup(flight.remove)
        file = self.folder / "flight.mcap"
        received = self.fly(flight, 5, drones={0, 1})
        with self.assertRaisesRegex(throng.ConflictError, "goes on"):
            flight.recording(file)
        result = flight.stop()
        self.assertEqual(flight.state()["links"]["recording"], f"/v1/live/{flight.id}/recording")
        self.assertEqual(flight.recording(file), file)
        recording = result["recording"]
        self.assertAlmostEqual(recording["complete_until_s"], result["duration_s"], places=8)
        self.assertEqual((recording["problem"], recording["bytes"]), (None, file.stat().st_size))
        head, topics = read_recording(file)
        self.assertEqual(head["profile"], "ros2")
        self.assertEqual({topic: messages[0].type for topic, messages in topics.items()}, RECORDED)

        job = {**result["job"], "outputs": {"annotations": ["coco", "sensors"]}}
        dataset = self.folder / "job/dataset"
        program.made(self.folder, job)
        trace = throng.Trace(self.folder / "job/work/run000/trace.h5")
        for drone in ("d1", "d2"):
            self.check_motion(drone, topics, trace.drone(drone))
            self.check_readings(drone, topics, dataset / f"sensors/run000/{drone}.csv")
        self.check_people(topics, trace)
        self.check_images(received["images"], topics)
        self.check_commands(topics)
        times = [message.time_ns for message in topics["/clock"]]
        self.assertEqual(times, sorted(set(times)))
        self.assertEqual(times[-1], round(1e9 * result["duration_s"]))

    def check_motion(self, drone, topics, truth):
        """Poses at all of the trace's samples, and at those of images."""
        poses = {}
        for message in topics["/tf"]:
            body, camera = message.message.transforms
            if body.child_frame_id == f"{drone}/base_link":
                self.assertEqual((body.header.frame_id, camera.header.frame_id), ("world", f"{drone}/base_link"))
                self.assertEqual(camera.child_frame_id, f"{drone}/camera_optical_frame")
                poses[message.time_ns] = (matrix_of(body.transform), matrix_of(camera.transform))
        self.assertEqual(len(topics[f"/{drone}/odometry"]), len(truth["time_s"]))
        for i, message in enumerate(topics[f"/{drone}/odometry"]):
            self.assertEqual(message.time_ns, round(1e9 * truth["time_s"][i]))
            position, q = message.message.pose.pose.position, message.message.pose.pose.orientation
            self.assertEqual([position.x, position.y, position.z], list(truth["position"][i]))
            self.assertEqual([q.w, q.x, q.y, q.z], list(truth["orientation_wxyz"][i]))
            body, camera = poses[message.time_ns]
            numpy.testing.assert_allclose(body[:3, 3], truth["position"][i], atol=1e-12)
            velocity = message.message.twist.twist.linear
            numpy.testing.assert_allclose(
                body[:3, :3] @ [velocity.x, velocity.y, velocity.z], truth["velocity"][i], atol=1e-6
            )
            if drone == "d1":
                self.assertAlmostEqual((body @ camera)[2, 2], -numpy.sin(numpy.radians(60)))

    def check_readings(self, drone, topics, table):
        """Those of the dataset that repeats the flight."""
        with open(table) as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        for topic in ("imu", "magnetic_field", "pressure"):
            self.assertEqual(len(topics[f"/{drone}/{topic}"]), len(rows), topic)
        near = {"rtol": 1e-8, "atol": 1e-8}  # tables have nine digits
        for i, row in enumerate(rows):
            imu = topics[f"/{drone}/imu"][i].message
            for field, column in (
                (imu.angular_velocity, "gyro_{}_rad_s"),
                (imu.linear_acceleration, "accelerometer_{}_mps2"),
            ):
                expected = [row[column.format(axis)] for axis in "xyz"]
                numpy.testing.assert_allclose([field.x, field.y, field.z], expected, **near)
            pressure = topics[f"/{drone}/pressure"][i].message.fluid_pressure
            numpy.testing.assert_allclose(pressure, row["pressure_pa"], **near)
        fixes = {row["gps_time_s"]: row for row in rows}
        self.assertEqual(len(topics[f"/{drone}/fix"]), len(fixes))
        for message, row in zip(topics[f"/{drone}/fix_velocity"], fixes.values()):
            field = message.message.twist.linear
            numpy.testing.assert_allclose(
                [field.x, field.y, field.z], [row[f"gps_v{axis}_mps"] for axis in "xyz"], **near
            )

    def check_people(self, topics, trace):
        """Everybody who takes part, at each step."""
        boxes = topics["/ground_truth/boxes"]
        self.assertEqual(len(boxes), len(trace.time_s))
        people = [i for i, role in enumerate(trace.roles) if role in ("person", "attacker")]
        for step, message in enumerate(boxes):
            self.assertEqual(message.time_ns, round(1e9 * trace.time_s[step]))
            cubes = [marker for marker in message.message.markers if marker.action == 0]
            present = [i for i in people if trace.present[step, i]]
            self.assertEqual([cube.id for cube in cubes], [i + 1 for i in present])
            solid = topics["/ground_truth/detections_3d"][step].message.detections
            self.assertEqual([int(each.id) for each in solid], [cube.id for cube in cubes])
            places = [[cube.pose.position.x, cube.pose.position.y] for cube in cubes]
            numpy.testing.assert_allclose(places, trace.positions[step, present], atol=1e-5)
            self.assertTrue(all(0.9 < cube.scale.z < 2.3 for cube in cubes))

    def check_images(self, shown, topics):
        """All that a viewer got, and their transforms."""
        moved = {(m.time_ns, m.message.transforms[0].child_frame_id) for m in topics["/tf"]}
        for drone, name in enumerate(("d1", "d2")):
            pictures = {
                message.time_ns: base64.b64decode(message.message.data)
                for message in topics[f"/{name}/camera/image_color/compressed"]
            }
            for image in shown:
                if image.drone == drone:
                    self.assertEqual(pictures[round(1e9 * image.time_s)], image.jpeg)
            self.assertLessEqual({(time_ns, f"{name}/base_link") for time_ns in pictures}, moved)
            lenses = topics[f"/{name}/camera/camera_info"]
            self.assertEqual([lens.time_ns for lens in lenses], list(pictures))
            self.assertEqual((lenses[0].message.width, lenses[0].message.height), (640, 360))

    def check_commands(self, topics):
        given = [message.message.twist for message in topics["/d1/command"]]
        self.assertIn(
            (5, 1.3, -0.7, numpy.radians(11.1)),
            [(twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z) for twist in given],
        )
        modes = [json.loads(message.message.data) for message in topics["/d1/mode"]]
        self.assertEqual([mode["beacon"] for mode in modes], [False, True])

    def test_a_flight_that_was_not_recorded_says_so(self):
        flight = self.live()
        with self.assertRaisesRegex(throng.NotFoundError, "without"):
            flight.recording(self.folder / "flight.mcap")
        self.fly(flight, 0.5)
        self.assertIsNone(flight.stop()["recording"])
        with self.assertRaisesRegex(throng.NotFoundError, "without"):
            flight.recording(self.folder / "flight.mcap")

    def test_a_recording_of_a_killed_flight_holds_whole_chunks(self):
        flight = self.client.live(JOB, record=True)
        self.addCleanup(flight.remove)
        self.fly(flight, 3)
        os.kill(self.process_of_flight(), 9)
        wait_until(lambda: flight.state()["state"] == "failed")
        file = flight.recording(self.folder / "flight.mcap")
        records = []
        with open(file, "rb") as recording:
            self.assertEqual(recording.read(8), b"\x89MCAP0\r\n")
            while head := recording.read(9):
                length = int.from_bytes(head[1:], "little")
                records.append(head[0])
                self.assertEqual(len(recording.read(length)), length)
        self.assertGreater(records.count(6), 1, "chunks")
        self.assertNotIn(15, records, "it has no end")

    def test_time_stands_still_while_nobody_looks(self):
        flight = self.live()
        with self.assertRaisesRegex(throng.ConflictError, "has not begun"):
            flight.stop()
        self.fly(flight, 0.5)
        wait_until(lambda: flight.state()["viewers"] == 0)
        # Until word of that has reached the flight, it makes a few steps more: then it does not move for a second, in which
        # it would fly four.
        seen = []

        def stands_still():
            now = time.monotonic()
            time_s = flight.state()["time_s"]
            if not seen or seen[0][1] != time_s:
                seen[:] = [(now, time_s)]
            return now - seen[0][0] > 1

        wait_until(stands_still)
        # A new viewer finds it where it was, but for a step that was under way on a busy machine.
        flight.command({"paused": True})
        again = next(m for m in flight.messages() if isinstance(m, throng.LiveState) and m.paused)
        self.assertAlmostEqual(again.time_s, seen[0][1], delta=0.25)

    def test_pause_and_hover(self):
        flight = self.live()
        states = []
        paused_at = None
        for message in flight.messages():
            if not isinstance(message, throng.LiveState):
                continue
            states.append(message)
            if len(states) == 3:
                flight.fly("d1", velocity_mps=[8, 0, 0])
            if message.paused and len(states) > 5:
                paused_at = message.time_s
                break
            if len(states) == 10:
                threading.Timer(0.5, lambda: flight.command({"paused": True})).start()
        # Time stands still, also for those who look: they see what the other drone sees at that moment.
        flight.command({"view": "d2"})
        seen = None
        for message in flight.messages():
            if isinstance(message, throng.LiveState):
                self.assertEqual((message.time_s, message.paused), (paused_at, True))
            if isinstance(message, throng.LiveImage):
                seen = message
                if message.drone == 1:
                    break
        self.assertEqual(seen.drone, 1)
        # Images lie between the last two states: within one step of dt_s.
        self.assertLessEqual(seen.time_s, paused_at)
        self.assertGreater(seen.time_s, paused_at - 0.1 - 1e-9)
        flight.command({"paused": False, "factor": 5})
        # Nobody has commanded for a second: the drone hovers.
        for message in flight.messages():
            if isinstance(message, throng.LiveState) and message.time_s > paused_at + 16:
                self.assertLess(message.drones[0]["speed_mps"], 1)
                break
        flight.remove()

    def test_wrong_requests(self):
        def mistakes(call):
            with self.assertRaises(throng.InvalidRequestError) as caught:
                call()
            return [(m.pointer, m.found, m.expected) for m in caught.exception.errors]

        self.assertEqual(mistakes(lambda: self.client.live({**JOB, "runs": 0}))[0][0], "/job/runs")
        self.assertIn(
            "/job/drones/0/start",
            [
                m[0]
                for m in mistakes(
                    lambda: self.client.live({**JOB, "drones": [{**JOB["drones"][0], "start": [-24, -6, 0.01]}]})
                )
            ],
        )
        self.assertEqual(
            mistakes(lambda: self.client.live({**JOB, "drones": [], "randomize": {}}))[0][0], "/job/drones"
        )
        flight = self.live()
        found = mistakes(lambda: flight.command({"drones": [{"id": "d3", "velocity_mps": [1, 2]}], "fakt": 1}))
        self.assertEqual([m[0] for m in found], ["/fakt", "/drones/0/velocity_mps", "/drones/0/id"], found)
        self.assertIn("d1", found[-1][2])
        self.assertEqual(mistakes(lambda: flight.command({"factor": 99}))[0][:2], ("/factor", "99"))
        self.assertEqual(
            mistakes(lambda: flight.command({"drones": [{"id": "d1", "beacon": 1}]}))[0][0], "/drones/0/beacon"
        )
        flight.remove()
        with self.assertRaises(throng.NotFoundError):
            flight.command({})

    def test_other_keys_and_limits(self):
        def key(name, scope):
            return program.printed("keys", "create", name, "--data", self.folder / "data", "--scope", scope).strip()

        alice = throng.Client(self.url, key("alice", "submit"), patience_s=0)
        bob = throng.Client(self.url, key("bob", "submit"), patience_s=0)
        reader = throng.Client(self.url, key("carol", "read"), patience_s=0)
        first = self.live(alice)
        with self.assertRaises(throng.NotFoundError):
            bob.live_flight(first.id)
        self.assertEqual(bob.live_flights(), [])
        with self.assertRaises(throng.AccessError):
            reader.live(JOB)
        self.live(alice)
        with self.assertRaisesRegex(throng.UnavailableError, "2 live flights at once"):
            self.live(alice)
        self.live(bob).remove()
        first.remove()
        self.live(alice)
        # Both count.
        self.assertEqual(len(alice.live_flights()), 2)

    def process_of_flight(self):
        """Number of the only flight's process."""
        children = subprocess.run(["pgrep", "-P", str(self.server.pid), "-f", "live"], capture_output=True, text=True)
        (process,) = map(int, children.stdout.split())
        return process

    def test_a_flight_ends_with_the_server_and_does_not_outlive_a_crash(self):
        flight = self.live()
        self.fly(flight, 0.5)
        os.kill(self.process_of_flight(), 9)
        wait_until(lambda: flight.state()["state"] == "failed")
        self.assertIn("signal 9", flight.state()["error"]["message"])
        with self.assertRaisesRegex(ServiceError, "signal 9"):
            flight.stop()
        other = self.live()
        self.fly(other, 0.5)
        process = self.process_of_flight()
        self.server.kill()
        self.server.wait(300)
        wait_until(lambda: not pathlib.Path(f"/proc/{process}").exists())


class Unseen(WithServer):
    live_timeout_s = 10

    def test_a_flight_that_nobody_looks_at_ends(self):
        flight = self.live()
        for message in flight.messages():
            if isinstance(message, throng.LiveState):
                left = time.monotonic()
                break
        wait_until(lambda: self.client.live_flights() == [])
        self.assertGreater(time.monotonic() - left, 10)
        with self.assertRaises(throng.NotFoundError):
            flight.state()
        wait_until(lambda: not list((self.folder / "data" / "live").iterdir()))  # no folder is left


if __name__ == "__main__":
    unittest.main()
