"""Live flights without the service: flown over Foxglove's WebSocket protocol by @foxglove/ws-protocol of npm."""
import contextlib
import hashlib
import http.client
import json
import math
import os
import queue
import re
import signal
import socket
import subprocess
import threading
import unittest

from mcap import read_recording
from program import ROOT, THRONG, FolderTest, throng

PATIENCE_S = 300  # of a busy machine

JOB = {
    "name": "outside",
    "scenario": "city_square/nearest_exit",
    "crowd": {"agents": 40},
    "seed": 5,
    "drones": [{"id": "d1", "start": [-24.5, -6.5, 20]}, {"id": "d-2", "start": [5, 5, 15]}],
    "capture": {"rate_hz": 1, "from_s": 1, "to_s": 4},
}

STEP_S = 0.1
POSE_STAMPED = """std_msgs/Header header
geometry_msgs/Pose pose
===
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
===
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
===
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
===
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
===
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
""".replace(
    "===", "=" * 80
)


class Client:
    """tests/cli/foxglove_client.mjs; all that it has printed is in `seen`."""

    def __init__(self, port):
        script = [ROOT / "tests/cli/foxglove_client.mjs", ROOT / "build/web/node_modules"]
        self.process = subprocess.Popen(
            ["node", *map(str, script), f"ws://127.0.0.1:{port}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.arrived = queue.Queue()
        self.thread = threading.Thread(target=self.read, daemon=True)
        self.thread.start()
        self.seen = []
        self.calls = 0
        self.wait("advertiseServices")

    def read(self):
        for line in self.process.stdout:
            if line.endswith("\n"):  # else it was killed meanwhile
                self.arrived.put(json.loads(line))
        self.arrived.put(None)

    def next(self):
        event = self.arrived.get(timeout=PATIENCE_S)
        assert event is not None, "the client has ended"
        self.seen.append(event)
        return event

    def wait(self, kind, **fields):
        """The next event of this kind with these fields."""
        while True:
            event = self.next()
            if event["event"] == kind and all(event.get(name) == value for name, value in fields.items()):
                return event

    def do(self, action, **fields):
        self.process.stdin.write(json.dumps({"do": action, **fields}) + "\n")
        self.process.stdin.flush()

    def call(self, service, **request):
        """The answer of a service; of one that failed its message."""
        self.calls += 1
        self.do("call", service=service, id=self.calls, request=request)
        return self.outcome(self.calls)

    def outcome(self, call):
        while True:
            event = self.next()
            if event.get("id") == call and event["event"] in ("answer", "failure"):
                return event.get("answer", event.get("message"))

    def step(self, steps):
        """The messages of these steps, by topic."""
        before = len(self.seen)
        answer = self.call("/throng/step", steps=steps)
        assert answer["success"], answer
        topics = {}
        for event in self.seen[before:]:
            if event["event"] == "message":
                topics.setdefault(event["topic"], []).append(event["message"])
        return topics

    def close(self):
        self.process.kill()
        self.process.wait()
        self.thread.join()
        self.process.stdin.close()
        self.process.stdout.close()


def rotated(turn, vector):
    """A vector turned by a quaternion of ROS."""
    x, y, z, w = (turn[axis] for axis in "xyzw")
    (a, b, c) = vector
    tx, ty, tz = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return (a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx)


class Outside(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder / "job.json").write_text(json.dumps(JOB))
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()

    def begin(self, *options, start=("--paused",)):
        """Starts a flight, which waits by default; returns its port."""
        command = [THRONG, "live", self.folder / "job.json", "--port", "0", *start, *options]
        self.flight = subprocess.Popen(
            list(map(str, command)),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "TMPDIR": str(self.temporary)},
        )
        self.addCleanup(self.end)
        line = self.flight.stderr.readline()
        found = re.search(r"ws://127\.0\.0\.1:(\d+)", line)
        self.assertTrue(found, line)
        self.errors = []
        self.reader = threading.Thread(target=lambda: self.errors.extend(self.flight.stderr), daemon=True)
        self.reader.start()
        return int(found[1])

    def end(self):
        self.flight.kill()
        self.flight.wait()
        self.reader.join()
        self.flight.stdout.close()
        self.flight.stderr.close()

    def connect(self, port):
        client = Client(port)
        self.addCleanup(client.close)
        return client

    def finish(self):
        """The words that a flight which ends by itself has printed on stdout."""
        self.assertEqual(self.flight.wait(PATIENCE_S), 0, self.errors)
        self.reader.join()
        self.assertNotIn("Sanitizer", "".join(self.errors))
        self.assertEqual(list(self.temporary.iterdir()), [])  # no trace is left
        return self.flight.stdout.read().split()

    def digest(self, file):
        return hashlib.sha256(file.read_bytes()).hexdigest()

    def test_no_more_than_16_clients_are_served_whatever_they_do(self):
        port = self.begin("--no-camera", start=("--factor", "20", "--duration", "3600"))
        request = (
            f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n"
        ).encode()
        sockets = [socket.create_connection(("127.0.0.1", port), PATIENCE_S) for _ in range(200)]
        for each in sockets:
            self.addCleanup(each.close)
        for each in sockets:
            with contextlib.suppress(OSError):
                each.sendall(request)
        served = []
        for each in sockets:
            with contextlib.suppress(OSError):  # the others are closed
                if each.recv(12) == b"HTTP/1.1 101":
                    served.append(each)
        self.assertEqual(len(served), 16)
        masked = json.dumps(
            {"op": "subscribe", "subscriptions": [{"id": k, "channelId": k} for k in range(60)]}
        ).encode()
        frame = b"\x81\xfe" + len(masked).to_bytes(2, "big") + bytes(4) + masked
        for each in served:  # they ask for all, and take nothing
            each.sendall(frame)
        self.flight.send_signal(signal.SIGTERM)
        self.assertEqual(self.flight.wait(PATIENCE_S), 0)

    def test_commands_are_flown_and_a_job_repeats_them(self):
        client = self.connect(self.begin("--no-camera", "-o", self.folder / "out"))
        client.do("subscribe", topics=["/d1/odometry", "/d1/command", "/d1/mode", "/d_2/odometry", "/events"])

        def place(topics, drone="d1"):
            position = topics[f"/{drone}/odometry"][-1]["pose"]["pose"]["position"]
            return [position[axis] for axis in "xyz"]

        # A velocity holds for one second of the flight, then the drone stops.
        client.do("publish", topic="/d1/cmd_vel", message={"linear": {"x": 3}, "angular": {"z": 0}})
        topics = client.step(30)
        ahead = [message["twist"]["linear"]["x"] for message in topics["/d1/command"]]
        self.assertEqual(ahead, [3.0] * 10 + [0.0] * 20)
        x, y, z = place(topics)
        turn = topics["/d1/odometry"][-1]["pose"]["pose"]["orientation"]
        heading = 2 * math.atan2(turn["z"], turn["w"])
        way = [now - then for now, then in zip((x, y), JOB["drones"][0]["start"])]
        self.assertGreater(way[0] * math.cos(heading) + way[1] * math.sin(heading), 1)
        self.assertLess(abs(way[1] * math.cos(heading) - way[0] * math.sin(heading)), 1)
        self.assertEqual(json.loads(topics["/d1/mode"][0]["data"])["route"], False)

        # A pose, as the clients of ROS publish it: north-west of there, looking north.
        goal = [x - 4, y + 5, z - 3]
        pose = {
            "position": dict(zip("xyz", goal)),
            "orientation": {"x": 0, "y": 0, "z": 2**-0.5, "w": 2**-0.5},
        }
        header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "world"}
        client.do(
            "publish",
            topic="/d1/cmd_pose",
            encoding="cdr",
            schema="geometry_msgs/msg/PoseStamped",
            definition=POSE_STAMPED,
            message={"header": header, "pose": pose},
        )
        topics = client.step(120)
        for found, wanted in zip(place(topics), goal):
            self.assertLess(abs(found - wanted), 0.7)
        turned = topics["/d1/odometry"][-1]["pose"]["pose"]["orientation"]
        self.assertLess(abs(abs(turned["z"]) - 2**-0.5), 0.05)

        # Waypoints of the other drone, and the beacon.
        corners = [[5, 8, 15], [8, 8, 14]]
        client.do("publish", topic="/d_2/cmd_waypoints", message={"waypoints": corners, "speed_mps": 4})
        client.do("publish", topic="/d1/beacon", message={"data": True})
        topics = client.step(100)
        for found, wanted in zip(place(topics, "d_2"), corners[-1]):
            self.assertLess(abs(found - wanted), 0.7)
        self.assertTrue(json.loads(topics["/d1/mode"][-1]["data"])["beacon"])

        self.assertTrue(client.call("/throng/stop")["success"])
        self.assertEqual(self.finish(), [str(self.folder / "out/flight000")])
        kept = self.folder / "out/flight000"
        self.assertEqual(
            {file.name for file in kept.iterdir()}, {"trace.h5", "d1.csv", "d-2.csv", "job.json", "flight.json"}
        )
        self.assertEqual(json.loads((kept / "flight.json").read_text())["steps"], 250)
        throng("simulate", kept / "job.json", "-o", self.folder / "again.h5")
        self.assertEqual(self.digest(self.folder / "again.h5"), self.digest(kept / "trace.h5"))

    def test_the_gimbal_turns_and_a_dataset_of_the_flight_shows_it(self):
        job = {
            **JOB,
            "crowd": {"agents": 5},
            "drones": [
                {**JOB["drones"][0], "camera": {"width": 320, "height": 180, "pitch_deg": -20}},
                {**JOB["drones"][1], "camera": {"width": 320, "height": 180, "gimbal": {"model": "rigid"}}},
            ],
            "outputs": {"annotations": ["coco"]},
            "quality": "draft",
        }
        (self.folder / "job.json").write_text(json.dumps(job))
        client = self.connect(self.begin("--no-camera", "-o", self.folder / "out"))
        client.do("subscribe", topics=["/tf"])

        def camera(messages):
            """Newest pitch and yaw of d1's camera from its body, which hovers level, in degrees."""
            turns = {
                each["child_frame_id"]: each["transform"]["rotation"]
                for message in messages
                for each in message["transforms"]
            }
            ahead = rotated(turns["d1/camera_optical_frame"], (0, 0, 1))
            return math.degrees(math.asin(ahead[2])), math.degrees(math.atan2(ahead[1], ahead[0]))

        self.assertAlmostEqual(camera(client.step(1)["/tf"])[0], -20, delta=0.05)
        client.do("publish", topic="/d1/gimbal", message={"pitch_deg": -80, "yaw_deg": 30})
        pitch, yaw = camera(client.step(5)["/tf"])
        self.assertAlmostEqual(pitch, -50, delta=2)  # 60 degrees/s
        self.assertAlmostEqual(yaw, 30, delta=0.5)
        pitch, yaw = camera(client.step(24)["/tf"])
        self.assertAlmostEqual(pitch, -80, delta=0.05)
        self.assertAlmostEqual(yaw, 30, delta=0.5)
        client.do("publish", topic="/d_2/gimbal", message={"pitch_deg": -80})
        self.assertIn("rigid", client.wait("status")["message"])
        client.call("/throng/stop")
        self.finish()

        kept = self.folder / "out/flight000"
        self.assertIn("gimbal_pitch_deg", (kept / "d1.csv").read_text().splitlines()[0])
        self.assertNotIn("gimbal_pitch_deg", (kept / "d-2.csv").read_text())
        throng("run", kept / "job.json", "-o", self.folder / "data")
        images = json.loads((self.folder / "data/dataset/annotations/instances.json").read_text())["images"]
        shown = {
            round(image["flight"]["true"]["time_s"]): image["flight"]["true"]["gimbal"]
            for image in images
            if image["file_name"].find("d1") >= 0
        }
        # The first step flies without a command; from then on 60 degrees/s from -20, and a set-point 3 ms later.
        self.assertAlmostEqual(shown[1]["pitch_deg"], -20 - 60 * 0.897, delta=0.01)
        self.assertAlmostEqual(shown[2]["pitch_deg"], -80, delta=1e-6)
        throng("validate", self.folder / "data/dataset")

    def test_a_client_that_neither_reads_nor_leaves_does_not_keep_the_flight_from_ending(self):
        client = self.connect(self.begin("--no-camera", "-o", self.folder / "out"))
        client.do("subscribe", topics=["/d1/odometry"])
        client.step(5)
        client.do("rest")
        client.wait("rests")
        self.flight.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(), [str(self.folder / "out/flight000")])

    def test_images_of_a_flight_that_rests_repeat_no_transforms(self):
        client = self.connect(self.begin())
        image = "/d1/camera/image_color/compressed"
        client.do("subscribe", topics=[image, "/tf", "/d1/mode"])
        client.step(2)
        for _ in range(3):  # it is drawn again while nothing moves
            client.wait("message", topic=image)
        stamps = [
            (each["child_frame_id"], each["header"]["stamp"]["sec"], each["header"]["stamp"]["nanosec"])
            for event in client.seen
            if event["event"] == "message" and event["topic"] == "/tf"
            for each in event["message"]["transforms"]
        ]
        self.assertEqual(len(stamps), len(set(stamps)))
        self.assertTrue(client.call("/throng/reset")["success"])
        client.wait("message", topic="/d1/mode")  # that of the new flight, before its first step
        client.call("/throng/stop")
        self.finish()

    def test_time_parameters_and_services(self):
        port = self.begin("--no-camera", "-o", self.folder / "out", "--factor", 0)
        client, other = self.connect(port), self.connect(port)
        info = next(event for event in client.seen if event["event"] == "serverInfo")["info"]
        self.assertEqual(
            sorted(info["capabilities"]), ["clientPublish", "parameters", "parametersSubscribe", "services", "time"]
        )
        client.do("get", names=[], id="all")
        values = client.wait("parameterValues", id="all")["values"]
        self.assertEqual((values["factor"], values["paused"], values["view"], values["seed"]), (0, True, "d1", 5))
        self.assertEqual(values["d-2/start_m"], [5, 5, 15])

        # Another client sees what one has set.
        other.do("watch", names=["factor", "paused", "seed"])
        other.do("get", names=["factor"], id="watched")
        other.wait("parameterValues", id="watched")
        client.do("set", parameters={"factor": 2, "view": "d-2"}, id="set")
        self.assertEqual(client.wait("parameterValues", id="set")["values"], {"factor": 2, "view": "d-2"})
        self.assertEqual(other.wait("parameterValues")["values"], {"factor": 2})
        client.do("set", parameters={"factor": 0}, id="fast")

        self.assertAlmostEqual(client.call("/throng/step", steps=7)["time_s"], 7 * STEP_S)
        times = [event["time_ns"] for event in client.seen if event["event"] == "time"]
        self.assertEqual((times[-1], times), (700_000_000, sorted(times)))
        self.assertTrue(client.call("/throng/resume")["success"])
        self.assertIn("not paused", client.call("/throng/step"))
        client.do("subscribe", topics=["/clock"])
        while client.wait("message")["message"]["clock"]["sec"] < 3:
            pass
        paused_s = client.call("/throng/pause")["time_s"]
        other.wait("parameterValues", values={"paused": True})

        # Again with another seed, in another folder.
        self.assertEqual(client.call("/throng/reset", seed=9), {"success": True, "message": "", "time_s": 0})
        self.assertEqual(other.wait("parameterValues")["values"], {"seed": 9})
        self.assertEqual(client.step(3)["/clock"][-1]["clock"], {"sec": 0, "nanosec": 300_000_000})
        self.assertEqual(client.call("/throng/reset")["time_s"], 0)
        client.step(2)
        self.flight.send_signal(signal.SIGINT)
        folders = [self.folder / f"out/flight00{i}" for i in range(3)]
        self.assertEqual(self.finish(), list(map(str, folders)))
        flown = [json.loads((folder / "flight.json").read_text()) for folder in folders]
        self.assertEqual([flight["seed"] for flight in flown], [5, 9, 9])
        self.assertGreaterEqual(flown[0]["duration_s"], paused_s)
        self.assertEqual([flight["steps"] for flight in flown[1:]], [3, 2])

    def test_mistakes_are_named_and_end_nothing(self):
        client = self.connect(self.begin("--no-camera"))

        def mistake():
            return client.wait("status", level=2)["message"]

        def published(topic, message=None, **fields):
            client.do("publish", topic=topic, message=message, **fields)
            return mistake()

        twist = "geometry_msgs/msg/Twist"
        self.assertIn('unknown topic "/d3/cmd_vel"; did you mean "/d1/cmd_vel"', published("/d3/cmd_vel", {}))
        self.assertIn("advertised and accepted", mistake())  # its message
        self.assertIn('/d1/cmd_pose: encoding: found "ros1"', published("/d1/cmd_pose", {}, encoding="ros1"))
        mistake()
        self.assertIn(
            "expected json, or cdr with Pose or PoseStamped",
            published("/d1/cmd_pose", encoding="cdr", schema=twist, text="x"),
        )
        mistake()
        for message, found in [
            ({"linear": {"x": 99}}, "/d1/cmd_vel: /linear: found [99,0,0], expected 3 numbers from -20 to 20"),
            ({"angular": {"z": -7}}, "/d1/cmd_vel: /angular/z: found -7, expected a number from -6.283 to 6.283"),
            ({"liner": {}}, 'unknown field "liner"; did you mean "linear"?'),
            ([1], "found [1], expected an object"),
        ]:
            self.assertIn(found, published("/d1/cmd_vel", message))
        self.assertIn("/d1/cmd_vel: ", published("/d1/cmd_vel", text="{"))
        self.assertIn("16 bytes", published("/d1/cmd_vel", encoding="cdr", schema=twist, text="\0\1\0\0" + "x" * 12))
        self.assertIn("/d1/cmd_pose: /position: found nothing", published("/d1/cmd_pose", {}))
        self.assertIn(
            "a quaternion of length 1",
            published("/d1/cmd_pose", {"position": {"x": 1, "y": 2, "z": 9}, "orientation": {"w": 0.5}}),
        )
        self.assertIn(
            "/d1/cmd_waypoints: /waypoints/1: found [1,2]",
            published("/d1/cmd_waypoints", {"waypoints": [[1, 2, 3], [1, 2]]}),
        )
        self.assertIn('/d1/beacon: /data: found "on"', published("/d1/beacon", {"data": "on"}))

        for frame in [{"text": "no json"}, {"text": '{"op": "fly"}'}, {"hex": ""}, {"hex": "07"}, {"hex": "02000000"}]:
            client.do("send", **frame)
            self.assertIn("message: ", mistake())
        client.do("send", text='{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 4000}]}')
        self.assertIn("channel 4000", mistake())
        for name, value, found in [
            ("factor", -1, "parameter factor: found -1"),
            ("paused", 1, "expected true or false"),
            ("view", "d3", 'unknown drone "d3"'),
            ("seed", 3, "cannot be set"),
            ("speed", 3, "cannot be set"),
        ]:
            client.do("set", parameters={"factor": 2, name: value})
            self.assertIn(found, mistake())
        client.do("get", names=["faktor"], id="x")
        self.assertIn('unknown parameter "faktor"; did you mean "factor"?', mistake())
        self.assertIn("/throng/step: /steps: found 0", client.call("/throng/step", steps=0))
        self.assertIn('unknown field "step"', client.call("/throng/step", step=1))
        client.do("call", service="/throng/none", id=70, request={})
        self.assertIn("id 99", client.outcome(70))
        client.do("call", service="/throng/step", id=71, encoding="cdr", text="")
        self.assertIn('encoding: found "cdr"', client.outcome(71))

        # All were refused whole.
        client.do("get", names=["factor", "paused"], id="after")
        self.assertEqual(client.wait("parameterValues", id="after")["values"], {"factor": 1, "paused": True})
        self.assertAlmostEqual(client.call("/throng/step", steps=2)["time_s"], 2 * STEP_S)

    def test_slow_and_lost_clients_hold_nobody_up(self):
        port = self.begin("--no-camera")
        slow, lost, client = self.connect(port), self.connect(port), self.connect(port)
        topics = list(next(event for event in slow.seen if event["event"] == "advertise")["topics"])
        for each in (slow, lost):
            each.do("subscribe", topics=topics)
        slow.do("rest")
        slow.wait("rests")
        self.assertAlmostEqual(client.call("/throng/step", steps=50)["time_s"], 5)
        lost.close()
        self.assertAlmostEqual(client.call("/throng/step", steps=450)["time_s"], 50)
        slow.do("resume")
        while slow.wait("time")["time_ns"] < 50_000_000_000:
            pass
        self.assertAlmostEqual(client.call("/throng/step", steps=1)["time_s"], 50.1)

    def test_images_for_those_who_want_them_and_a_recording(self):
        file = self.folder / "flight.mcap"
        port = self.begin("--record", file)
        client = self.connect(port)
        image, lens = "/d_2/camera/image_color/compressed", "/d_2/camera/camera_info"
        client.do("subscribe", topics=[image, lens])
        message = client.wait("message", topic=image)["message"]
        self.assertEqual((message["format"], message["data"]["head"]), ("jpeg", "ffd8ff"))
        client.step(3)
        self.assertEqual(client.wait("message", topic=lens, time_ns=300_000_000)["message"]["width"], 640)
        # After a reset there are images again, and a recording of its own.
        self.assertEqual(client.call("/throng/reset")["time_s"], 0)
        self.assertEqual(client.wait("message", topic=image)["time_ns"], 0)
        client.step(2)
        client.do("unsubscribe", topics=[image, lens])
        client.call("/throng/stop")
        client.wait("close")
        self.assertEqual(self.finish(), [str(file), str(self.folder / "flight-2.mcap")])
        advertised = next(event for event in client.seen if event["event"] == "advertise")["topics"]
        _, topics = read_recording(file)
        self.assertEqual({topic: advertised.get(topic) for topic in topics}, {t: m[0].type for t, m in topics.items()})
        self.assertIn(image, topics)
        self.assertIn("/d_2/command", topics)
        self.assertEqual(max(message.time_ns for message in topics["/clock"]), 300_000_000)
        _, topics = read_recording(self.folder / "flight-2.mcap")
        self.assertEqual(max(message.time_ns for message in topics["/clock"]), 200_000_000)

    def test_others_are_refused(self):
        port = self.begin("--no-camera", "--allow-origin", "https://own.example")

        def answer(**headers):
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
            self.addCleanup(connection.close)
            connection.request("GET", "/", headers=headers)
            return connection.getresponse()

        upgrade = {
            "Connection": "Upgrade",
            "Upgrade": "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
            "Sec-WebSocket-Protocol": "foxglove.websocket.v1",
        }
        self.assertEqual(answer().status, 426)
        self.assertEqual(answer(**upgrade).status, 101)
        self.assertEqual(answer(**upgrade, Origin="https://own.example").status, 101)
        refused = answer(**upgrade, Origin="https://other.example")
        self.assertEqual(refused.status, 403)
        self.assertIn(b"https://other.example", refused.read())
        self.assertEqual(answer(**{**upgrade, "Sec-WebSocket-Protocol": "chat"}).status, 400)

        def fail(*options, job="job.json"):
            done = throng("live", self.folder / job, *options, code=None)
            return done.returncode, done.stderr

        code, message = fail("--port", str(port), "--no-camera")
        self.assertEqual(code, 3)
        self.assertIn(f"cannot listen on 127.0.0.1, port {port}", message)
        code, message = fail("--host", "nowhere")
        self.assertEqual(code, 2)
        self.assertIn("--host: found nowhere", message)
        code, message = fail("--record", "flight.bag")
        self.assertEqual((code, ".mcap" in message), (2, True))
        (self.folder / "none.json").write_text(json.dumps({**JOB, "drones": []}))
        code, message = fail("--port", "0", job="none.json")
        self.assertEqual(code, 2)
        self.assertIn("/drones: found no drone", message)


if __name__ == "__main__":
    unittest.main(verbosity=2)
