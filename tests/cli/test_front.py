"""Hostile clients at the bare port and through nginx (docker/nginx.conf), and what nginx lets through."""
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error

for folder in ("bench", "python"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / folder))
import hostile  # noqa: E402
import throng  # noqa: E402

THRONG = sys.argv.pop(1)


class Front(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.throng = hostile.Throng(THRONG, folder.name)
        self.addCleanup(self.throng.stop)
        self.bare = hostile.Front(self.throng.port, self.throng.key)
        self.folder = folder.name

    def through_nginx(self):
        if not hostile.nginx_program():
            self.assertFalse(os.environ.get("CI"), "nginx is missing (Debian package nginx-light)")
            self.skipTest("there is no nginx on this machine")
        nginx = hostile.Nginx(self.folder, self.throng.port)
        self.addCleanup(nginx.stop)
        return hostile.Front(nginx.port, self.throng.key, nginx.context)

    def withstands(self, front):
        undisturbed = self.bare.run_job()
        found = hostile.attack(self.throng, front, 24, 4)
        self.assertEqual(found.job_hash, undisturbed)
        self.assertEqual(found.refused, 0)
        self.assertLess(found.memory_mb[1] - found.memory_mb[0], 200)

    def test_the_bare_port_withstands_hostile_clients(self):
        self.withstands(self.bare)

    def test_nginx_keeps_hostile_clients_away(self):
        self.withstands(self.through_nginx())

    def refusal(self, front, path, **more):
        with self.assertRaises(urllib.error.HTTPError) as raised:
            front.request(path, **more)
        problem = json.loads(raised.exception.read())
        self.assertEqual(problem["status"], raised.exception.code)
        return raised.exception.code

    def test_nginx_lets_through_what_clients_need(self):
        front = self.through_nginx()
        self.assertEqual(json.loads(front.request("/v1/version"))["name"], "throng")
        front.run_job()
        job = json.loads(front.request("/v1/jobs"))["jobs"][0]["id"]
        whole = front.request(f"/v1/jobs/{job}/archive")
        part = front.request(f"/v1/jobs/{job}/archive", headers={"Range": "bytes=1000-1999"})
        self.assertEqual(part, whole[1000:2000])
        events = front.request(f"/v1/jobs/{job}/events")
        self.assertIn("submitted", events.decode())
        large = b" " * (2 << 20)
        headers = {"Content-Type": "application/json"}
        self.assertEqual(self.refusal(front, "/v1/schema", body=large, headers=headers), 413)
        # Large ones pass where they belong, and are looked at by the service.
        headers = {"Content-Type": "application/zip"}
        self.assertEqual(self.refusal(front, "/v1/scenarios?name=x", body=large, headers=headers), 400)
        self.assertEqual(self.refusal(front, "/v1/jobs", headers={"Authorization": "Bearer x"}), 401)
        self.throng.stop()
        self.assertEqual(self.refusal(front, "/v1/version"), 503)

    def delay_of_commands(self, client):
        """Seconds until a command is in force in a state that arrives (median), and the flight, which goes on."""
        job = {
            "scenario": "city_square/nearest_exit",
            "crowd": {"agents": 20},
            "drones": [{"id": "d1", "start": [0, 0, 20]}],
        }
        flight = client.live(job)
        self.addCleanup(flight.remove)
        sent, delays, images, sequence = {}, [], 0, 0
        for message in flight.messages():
            now = time.monotonic()
            images += isinstance(message, throng.LiveImage)
            if not isinstance(message, throng.LiveState):
                continue
            delays += [now - sent.pop(number) for number in list(sent) if number <= message.sequence]
            if len(delays) >= 20 and images >= 5:
                break
            sequence += 1
            sent[sequence] = now
            flight.fly("d1", velocity_mps=[1, 0, 0], sequence=sequence)
        return sorted(delays)[len(delays) // 2], flight

    def test_nginx_lets_live_flights_pass_as_they_come(self):
        front = self.through_nginx()
        client = throng.Client(f"https://localhost:{front.port}", front.key, ssl_context=front.context)
        direct = self.delay_of_commands(throng.Client(f"http://127.0.0.1:{self.bare.port}", self.bare.key))[0]
        delay, flight = self.delay_of_commands(client)
        # A step takes 0.1 s. A state has some 350 bytes: if nginx collected answers, it would hold back seconds of them. On a
        # busy machine commands take longer without nginx, too.
        self.assertLess(delay, 1 + 3 * direct, "a command is soon in force in what arrives")
        commands = f"/v1/live/{flight.id}/commands"
        body = json.dumps({"sequence": 1000, "drones": []}).encode()
        for headers in ({"Origin": "https://other-site.test"}, {"Host": "other-site.test"}):
            headers = {"Content-Type": "application/json", **headers}
            self.assertIn(self.refusal(front, commands, body=body, headers=headers), (403, 421))
        own = {"Content-Type": "application/json", "Origin": f"https://localhost:{front.port}"}
        front.request(commands, body=body, headers=own)
        with self.assertRaises(urllib.error.HTTPError) as raised:
            front.request(commands, body=body, headers={**own, "Authorization": ""})
        self.assertEqual(raised.exception.code, 401)

    def test_nginx_keeps_no_bodies_of_strangers(self):
        front = self.through_nginx()
        body = b"x" * (50 << 20)
        kept = []
        with front.context.wrap_socket(
            socket.create_connection(("127.0.0.1", front.port)), server_hostname="localhost"
        ) as client:
            client.sendall(
                b"POST /v1/scenarios?name=x HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/zip\r\n"
                b"Content-Length: %d\r\n\r\n" % len(body)
            )
            for start in range(0, 8 << 20, 1 << 20):
                try:
                    client.sendall(body[start : start + (1 << 20)])
                except OSError:
                    break
                kept += [path for path in pathlib.Path(self.folder).glob("nginx-bodies/**/*") if path.is_file()]
            self.assertIn(b" 401 ", client.recv(4096).split(b"\r\n")[0])
        self.assertEqual(kept, [])
        reader = subprocess.run(
            [THRONG, "keys", "create", "reader", "--data", f"{self.folder}/data", "--scope", "read"],
            check=True,
            capture_output=True,
            text=True,
        ).stdout.split()[-1]
        for key, status in (("", 401), ("throng_wrong", 401), (reader, 403)):
            headers = {"Content-Type": "application/zip", "Authorization": f"Bearer {key}"}
            self.assertEqual(self.refusal(front, "/v1/scenarios?name=x", body=body[: 1 << 20], headers=headers), status)


if __name__ == "__main__":
    unittest.main()
