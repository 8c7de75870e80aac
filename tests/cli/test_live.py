"""Live flights against the real server: flown by commands, repeated by a job, ended when nobody looks."""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from service import start_service, wait_until

THRONG = sys.argv.pop(1)
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


class WithServer(unittest.TestCase):
    live_timeout_s = 600  # no flight ends by itself while a busy machine gets round to looking at it

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.base = pathlib.Path(folder.name)
        self.log = open(self.base / "log", "w")
        self.addCleanup(self.log.close)
        options = ["--live-timeout", self.live_timeout_s]
        self.server, port = start_service(THRONG, self.base / "data", *options, stderr=self.log)
        self.addCleanup(self.stop)
        self.url = f"http://127.0.0.1:{port}"
        self.client = throng.Client(self.url, timeout_s=300, patience_s=2)

    def stop(self):
        self.server.terminate()
        self.server.wait(300)
        self.assertNotIn("Sanitizer", (self.base / "log").read_text())

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
        trace = self.client.trace(replayed["id"], 0, self.base / "trace.h5")
        self.assertEqual(hashlib.sha256(trace.read_bytes()).hexdigest(), result["trace_sha256"])

        # The logs as files beside a job do the same.
        job = json.loads(json.dumps(result["job"]))
        for drone, log in zip(job["drones"], result["drones"]):
            del drone["guidance"]["setpoints"]
            drone["guidance"]["log"] = log["id"] + ".csv"
            (self.base / (log["id"] + ".csv")).write_text(log["csv"])
        (self.base / "job.json").write_text(json.dumps(job))
        subprocess.run([THRONG, "simulate", self.base / "job.json", "-o", self.base / "again.h5"], check=True)
        self.assertEqual(hashlib.sha256((self.base / "again.h5").read_bytes()).hexdigest(), result["trace_sha256"])
        flight.remove()
        with self.assertRaises(throng.NotFoundError):
            flight.state()

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
            return subprocess.run(
                [THRONG, "keys", "create", name, "--data", self.base / "data", "--scope", scope],
                check=True,
                capture_output=True,
                text=True,
            ).stdout.strip()

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

    def test_a_flight_ends_with_the_server_and_does_not_outlive_a_crash(self):
        flight = self.live()
        self.fly(flight, 0.5)
        children = subprocess.run(["pgrep", "-P", str(self.server.pid), "-f", "live"], capture_output=True, text=True)
        pids = [int(p) for p in children.stdout.split()]
        self.assertEqual(len(pids), 1)
        os.kill(pids[0], 9)
        wait_until(lambda: flight.state()["state"] == "failed")
        self.assertIn("signal 9", flight.state()["error"]["message"])
        with self.assertRaisesRegex(ServiceError, "signal 9"):
            flight.stop()
        other = self.live()
        self.fly(other, 0.5)
        pids = [
            int(p)
            for p in subprocess.run(
                ["pgrep", "-P", str(self.server.pid), "-f", "live"], capture_output=True, text=True
            ).stdout.split()
        ]
        self.server.kill()
        self.server.wait(300)
        wait_until(lambda: not any(pathlib.Path(f"/proc/{pid}").exists() for pid in pids))


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
        wait_until(lambda: not list((self.base / "data" / "live").iterdir()))  # no folder is left


if __name__ == "__main__":
    unittest.main()
