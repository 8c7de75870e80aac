"""Hostile clients at the bare port and through nginx (docker/nginx.conf), and what nginx lets through."""
import contextlib
import json
import os
import pathlib
import re
import signal
import socket
import sys
import tempfile
import time
import unittest
import urllib.error

from program import ROOT, THRONG, printed, run

for folder in ("bench", "python"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / folder))
import hostile  # noqa: E402
import throng  # noqa: E402
from open_requests import Http1, Http2  # noqa: E402

# For requests that stay open as long as the test wants.
PATIENT = (
    ("client_body_timeout 10s", "client_body_timeout 1h"),
    ("proxy_read_timeout 90s", "proxy_read_timeout 1h"),
    ("send_timeout 30s", "send_timeout 1h"),
    ("lingering_time 5s", "lingering_time 1h"),
    ("lingering_timeout 2s", "lingering_timeout 1h"),
)
LARGE = 240_000_000


class Front(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.throng = hostile.Throng(THRONG, folder.name)
        self.addCleanup(self.throng.stop)
        self.bare = hostile.Front(self.throng.port, self.throng.key)
        self.folder = folder.name

    def through_nginx(self, *changes):
        if not hostile.nginx_program():
            self.assertFalse(os.environ.get("CI"), "nginx is missing (Debian package nginx-light)")
            self.skipTest("there is no nginx on this machine")
        nginx = hostile.Nginx(self.folder, self.throng.port, changes)
        self.addCleanup(nginx.stop)
        self.plain_port = nginx.plain_port
        return hostile.Front(nginx.port, self.throng.key, nginx.context)

    def key(self, name, scope="submit"):
        return printed("keys", "create", name, "--data", f"{self.folder}/data", "--scope", scope).split()[-1]

    def client(self, protocol, front, address="127.0.0.1", **more):
        client = protocol(front, address, **more)
        self.addCleanup(client.close)
        return client

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
        reader = self.key("reader", "read")
        for key, status in (("", 401), ("throng_wrong", 401), (reader, 403)):
            headers = {"Content-Type": "application/zip", "Authorization": f"Bearer {key}"}
            self.assertEqual(self.refusal(front, "/v1/scenarios?name=x", body=body[: 1 << 20], headers=headers), status)

    def upload(self, client, key, path="/v1/calibrations", **more):
        """Begins a large upload, whose body does not come; returns its status, 100 if the body is waited for."""
        headers = {"Authorization": f"Bearer {key}", "Content-Type": "application/zip"}
        exchange = client.decided(client.begin("POST", path, headers, **(more or {"length": LARGE})))
        if exchange.status == 429:
            self.assert_refused(client, exchange)
        return exchange.status or 100

    def assert_refused(self, client, exchange, status=429):
        problem = json.loads(client.ended(exchange).body)
        self.assertEqual((exchange.status, problem["status"]), (status, status), problem)
        if isinstance(client, Http1):
            self.assertEqual(exchange.fields["content-type"], "application/problem+json")
            self.assertEqual(exchange.fields["retry-after"], "5")

    def test_a_key_has_two_large_bodies_at_once_and_others_are_not_kept_waiting(self):
        front = self.through_nginx(*PATIENT)
        greedy, other = self.key("greedy"), self.key("other")
        for protocol in (Http1, Http2):
            with self.subTest(protocol=protocol.__name__):
                client = self.client(protocol, front)
                elsewhere = self.client(protocol, front, "127.0.0.2")
                self.assertEqual(self.upload(client, greedy), 100)
                self.assertEqual(self.upload(elsewhere, greedy, "/v1/scenarios?name=x", is_chunked=True), 100)
                for path in ("/v1/calibrations", "/v1/scenarios?name=x", "/v1/jobs"):
                    length = LARGE if path == "/v1/calibrations" else 60_000_000
                    self.assertEqual(self.upload(client, greedy, path, length=length), 429)
                    self.assertEqual(self.upload(elsewhere, greedy, path, is_chunked=True), 429)
                # The same connection, the same key: small ones go on.
                headers = {"Authorization": f"Bearer {greedy}"}
                self.assertEqual(client.ended(client.begin("GET", "/v1/jobs", headers)).status, 200)
                small = hostile.Front(front.port, greedy, front.context)
                headers = {"Content-Type": "application/json"}
                small.request("/v1/jobs?dry_run", json.dumps(hostile.JOB).encode(), headers=headers)
                headers = {"Content-Type": "application/zip"}
                refused = self.refusal(small, "/v1/scenarios?name=x", body=b"x" * 900_000, headers=headers)
                self.assertEqual(refused, 400, "a body of medium size passes, and is no archive")
                # Another key sends large ones, from the same address.
                large = hostile.Front(front.port, other, front.context)
                refused = self.refusal(large, "/v1/scenarios?name=x", body=b"x" * 2_000_000, headers=headers)
                self.assertEqual(refused, 400)
                self.assertEqual(self.upload(client, other), 100)
                client.close()
                elsewhere.close()
                again = self.client(protocol, front)
                hostile.wait_until(lambda: self.upload(again, greedy) == 100, what="the place of a client that left")
                again.close()

    def test_an_address_has_four_large_bodies_at_once(self):
        front = self.through_nginx(*PATIENT)
        keys = [self.key(f"k{number}") for number in range(3)]
        client = self.client(Http1, front)
        found = [self.upload(client, key) for key in keys for _ in range(2)]
        self.assertEqual(found, [100] * 4 + [429] * 2)

    def test_a_key_has_sixteen_smaller_bodies_in_files_at_once(self):
        front = self.through_nginx(*PATIENT)
        key = self.key("one")
        client = self.client(Http2, front)
        for path in ("/v1/jobs", "/v1/scenarios?name=x", "/v1/calibrations", "/v1/studies") * 4:
            self.assertEqual(self.upload(client, key, path, length=60_000), 100)
        for path in ("/v1/jobs", "/v1/studies"):
            self.assertEqual(self.upload(client, key, path, length=900_000), 429)
            self.assertEqual(self.upload(client, key, path, length=59_999), 100, "it is kept in memory")

    def test_bodies_of_all_fit_into_the_memory_for_them(self):
        front = self.through_nginx(*PATIENT)
        conf = (ROOT / "docker/nginx.conf").read_text()
        total_mib = 0
        for place, zone in (("body", "small"), ("bundle", "bundles"), ("calibration", "calibrations")):
            text = conf[conf.index(f"location @{place} {{") :].split("}")[0]
            size = re.search(r"client_max_body_size (\d+)m", text) or re.search(r"client_max_body_size (\d+)m", conf)
            total_mib += int(size[1]) * int(re.search(rf"limit_conn {zone} (\d+)", text)[1])
        settings = (ROOT / "docker/compose.yaml").read_text().partition("\n  nginx:")[2]
        files_mib = int(re.search(r"/tmp:size=(\d+)g", settings)[1]) * 1024
        self.assertLess(total_mib, files_mib)
        self.assertLessEqual(files_mib + 512, int(re.search(r"mem_limit: (\d+)m", settings)[1]))
        # As many keys and addresses as one likes.
        clients = [self.client(Http2, front, f"127.0.0.{2 + number}") for number in range(5)]
        keys = [self.key(f"k{number}") for number in range(5)]
        found = [self.upload(client, key) for client, key in zip(clients, keys) for _ in range(2)]
        self.assertEqual(found, [100] * 5 + [429] * 5)
        found = [
            self.upload(client, key, "/v1/scenarios?name=x", length=60_000_000)
            for client, key in zip(clients[2:], keys[2:])
            for _ in range(3)
        ]
        self.assertEqual(found, [100, 429, 429] + [100, 100, 429] * 2)

    def test_strangers_take_no_places_of_uploads(self):
        front = self.through_nginx(*PATIENT)
        strangers = self.client(Http1, front)
        found = [self.upload(strangers, f"throng_{number}") for number in range(8)]
        self.assertEqual(found, [401] * 8)
        self.assertEqual(self.upload(self.client(Http1, front), self.key("one")), 100)

    def test_a_session_counts_as_a_key_whatever_is_sent_beside_it(self):
        front = self.through_nginx(*PATIENT)
        origin = f"https://localhost:{front.port}"
        cookies = []
        for name in ("one", "two"):
            client = self.client(Http1, front)
            body = json.dumps({"key": self.key(name)}).encode()
            headers = {"Content-Type": "application/json", "Origin": origin, "Content-Length": len(body)}
            opened = client.begin("POST", "/v1/session", headers)
            client.send(opened, body)
            cookies.append(client.ended(opened).fields["set-cookie"].split(";")[0])

        def upload(cookie, **more):
            client = self.client(Http1, front)
            headers = {"Cookie": cookie, "Origin": origin, "Content-Type": "application/zip", **more}
            exchange = client.decided(client.begin("POST", "/v1/calibrations", headers, LARGE))
            return exchange.status or 100

        self.assertEqual(upload(cookies[0]), 100)
        self.assertEqual(upload(f"a=b; __Host-throng_session=x;  {cookies[0]}; c=d", Authorization="Basic x"), 100)
        for number in range(3):
            self.assertEqual(upload(cookies[0], Authorization=f"Basic {number}"), 429)
            self.assertEqual(upload(f"{'; ' * 200}{number}=1; __Host-throng_session_1={number}; {cookies[0]}"), 429)
        self.assertEqual(upload(cookies[1]), 100)
        text = "".join((pathlib.Path(self.folder) / name).read_text() for name in ("access.log", "error.log"))
        for cookie in cookies:
            self.assertNotIn(cookie.partition("=")[2], text)

    def test_nginx_logs_no_keys(self):
        front = self.through_nginx(*PATIENT)
        secrets = [self.key("one"), "throng_" + "s" * 300]
        client = self.client(Http1, front)
        self.assertEqual([self.upload(client, secrets[0]) for _ in range(3)], [100, 100, 429])
        self.assertEqual(self.upload(client, secrets[1]), 401)
        headers = {"Authorization": f"Bearer {secrets[1]}", "Cookie": f"__Host-throng_session_{front.port}={'c' * 300}"}
        self.assertEqual(client.ended(client.begin("GET", "/v1/events", headers)).status, 401)
        client.close()
        access, errors = (pathlib.Path(self.folder) / name for name in ("access.log", "error.log"))
        hostile.wait_until(lambda: len(re.findall('"POST /v1/calib|/v1/events', access.read_text())) == 5)
        self.assertIn("limiting connections", errors.read_text())
        for text in (access.read_text(), errors.read_text()):
            for secret in (*secrets, "c" * 300):
                self.assertNotIn(secret, text)

    def front_of_watchers(self, *changes):
        self.addCleanup(self.throng.process.kill)  # it would answer all long polls before it ends
        return self.through_nginx(*PATIENT, *changes)

    def watch(self, client, key):
        return client.begin("GET", "/v1/events?wait_s=60", {"Authorization": f"Bearer {key}"})

    def watched(self, front, key):
        """Status of a request for the events that there are."""
        client = self.client(Http1, front)
        return client.ended(client.begin("GET", "/v1/events", {"Authorization": f"Bearer {key}"})).status

    @contextlib.contextmanager
    def throng_standing_still(self):
        """Nothing is answered but by nginx, so that no long poll ends while others begin."""
        os.kill(self.throng.process.pid, signal.SIGSTOP)
        try:
            yield
        finally:
            os.kill(self.throng.process.pid, signal.SIGCONT)

    def assert_answers(self, front):
        for path in ("/healthz", "/readyz", "/v1/version", "/v1/jobs"):
            front.request(path)

    def test_long_polls_of_one_key_keep_nobody_waiting(self):
        front = self.front_of_watchers()
        greedy, other = self.key("greedy"), self.key("other")
        clients = [self.client(Http1, front, f"127.0.0.{2 + number}") for number in range(9)]

        def answered():
            for client in clients:
                client.read()
            return sum((client.statuses() for client in clients), [])

        with self.throng_standing_still():
            for client in clients:
                for _ in range(30):
                    self.watch(client, greedy)
            hostile.wait_until(lambda: len(answered()) >= 270 - 32, what="refusals")
            self.assertEqual(answered(), [429] * (270 - 32))
        self.assert_answers(front)
        self.assert_answers(hostile.Front(front.port, greedy, front.context))
        client = self.client(Http1, front, "127.0.0.2")
        headers = {"Authorization": f"Bearer {other}", "Accept": "text/event-stream"}
        self.assertEqual(client.decided(client.begin("GET", "/v1/events", headers)).status, 200)

    def test_watching_over_one_connection_of_http2_is_limited_too(self):
        front = self.front_of_watchers()
        greedy = self.key("greedy")
        client = self.client(Http2, front)
        with self.throng_standing_still():
            watches = [self.watch(client, greedy) for _ in range(60)]
            client.wait_for(lambda: len(client.statuses()) >= 28, "refusals")
            self.assertEqual([watch.status for watch in watches], [0] * 32 + [429] * 28)
            self.assert_refused(client, watches[-1])
        for path in ("/healthz", "/readyz", "/v1/version"):
            self.assertEqual(client.ended(client.begin("GET", path)).status, 200)

    def test_all_watchers_together_leave_room_for_others(self):
        front = self.front_of_watchers()
        clients = [self.client(Http2, front, f"127.0.0.{2 + number}") for number in range(5)]
        with self.throng_standing_still():
            for number, client in enumerate(clients[:4]):
                key = self.key(f"k{number}")
                for _ in range(33):
                    self.watch(client, key)
                client.wait_for(lambda: client.statuses() == [429], "a refusal")
            self.assert_refused(clients[4], self.watch(clients[4], self.key("other")))
        self.assert_answers(front)

    def test_who_asks_for_health_is_answered_when_nobody_else_is(self):
        # All that throng has for others is taken; so is all that the address may have.
        front = self.front_of_watchers(("max_conns=200", "max_conns=64"))
        keys = [self.key(f"k{number}") for number in range(3)]
        client = self.client(Http2, front)
        other = self.client(Http1, front, "127.0.0.2")
        with self.throng_standing_still():
            for number in range(70):
                self.watch(client, keys[number % 3])
            client.wait_for(lambda: len(client.statuses()) >= 6, "refusals")
            self.assertEqual(client.statuses(), [429] * 6)
            self.assert_refused(other, other.begin("GET", "/v1/version"), 503)
            asked = [(who, who.begin("GET", path)) for who in (client, other) for path in ("/healthz", "/readyz")]
        self.assertEqual([who.ended(exchange).status for who, exchange in asked], [200] * 4)

    def test_a_long_poll_counts_until_throng_has_answered_it(self):
        front = self.front_of_watchers()
        greedy = self.key("greedy")
        for protocol in (Http1, Http2):
            with self.subTest(protocol=protocol.__name__), self.throng_standing_still():
                client = self.client(protocol, front, "127.0.0.2")
                for _ in range(33):
                    self.watch(client, greedy)
                client.wait_for(lambda: client.statuses() == [429], "a refusal")
                client.close()
                again = self.client(protocol, front)
                refused = [again.decided(self.watch(again, greedy)).status for _ in range(3)]
                self.assertEqual(refused, [429] * 3)
                again.close()
            # An event is an answer to all of them.
            headers = {"Content-Type": "application/json"}
            job = json.loads(self.bare.request("/v1/jobs", json.dumps(hostile.JOB).encode(), headers=headers))["id"]
            self.bare.request(f"/v1/jobs/{job}/cancel", method="POST")
            hostile.wait_until(lambda: self.watched(front, greedy) == 200, what="free places")

    def test_every_answer_over_tls_says_that_there_is_tls(self):
        front = self.through_nginx()
        key = {"Authorization": f"Bearer {front.key}"}
        asked = {
            ("GET", "/healthz"): 200,
            ("GET", "/"): 200,
            ("GET", "/v1/jobs"): 401,
            ("POST", "/v1/jobs"): 401,
            ("GET", "/v1/nothing", "Authorization"): 404,
            ("GET", "/v1/nothing", "Content-Length"): 400,
            ("POST", "/v1/jobs", "Content-Encoding"): 415,
            ("POST", "/v1/schema", "Authorization", "Content-Length"): 413,
            ("BREW", "/v1/jobs", "Range"): 501,
            ("GET", "/%"): 400,
        }
        more = {**key, "Content-Length": 2 << 20, "Content-Encoding": "gzip", "Range": "x"}
        client = self.client(Http1, front)

        def assert_secure(method, path, status, headers):
            exchange = client.decided(client.begin(method, path, headers))
            self.assertEqual(exchange.status, status, (method, path, headers))
            self.assertEqual(exchange.fields.get("strict-transport-security"), "max-age=31536000", (method, path))

        for (method, path, *names), status in asked.items():
            assert_secure(method, path, status, {name: more[name] for name in names})
        reader = {"Authorization": f"Bearer {self.key('reader', 'read')}"}
        assert_secure("POST", "/v1/jobs", 403, reader)
        self.throng.stop()
        assert_secure("GET", "/v1/version", 503, {})
        command = ["curl", "-sS", "-o", "/dev/null", "-D", "-"]
        secure = [*command, "--http2", "--cacert", f"{self.folder}/tls/tls.crt", f"https://localhost:{front.port}/x"]
        answer = run(*secure).stdout.lower()
        self.assertTrue(answer.startswith("http/2 503"), answer)
        self.assertEqual(answer.count("strict-transport-security: max-age=31536000\n"), 1, answer)
        plain = [*command, f"http://127.0.0.1:{self.plain_port}/x"]
        answer = run(*plain).stdout.lower()
        self.assertIn(" 308 ", answer.splitlines()[0])
        self.assertNotIn("strict-transport-security", answer)
        self.assertIn("location: https://127.0.0.1/x", answer)
        for host in ["evil.example", "localhost.evil.example", ""]:
            strange = [*plain, "-H", f"Host: {host}" if host else "Host;"]
            answer = run(*strange).stdout.lower()
            self.assertNotIn("location", answer, host)


if __name__ == "__main__":
    unittest.main()
