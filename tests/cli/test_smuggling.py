"""Requests within requests, decompression bombs and nested JSON, at the bare port and through nginx (docker/nginx.conf);
and that honest clients notice nothing of what keeps them out."""
import concurrent.futures
import contextlib
import gzip
import http.client
import io
import json
import os
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import zipfile

from program import THRONG, throng

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import hostile  # noqa: E402

HOST = b"Host: localhost\r\n"
# Options of curl.
JSON_BODY = ("-H", "Content-Type: application/json", "--data-binary", "@-")
CHUNKED = ("-H", "Transfer-Encoding: chunked")
STATUS_ONLY = ("-o", "/dev/null", "-w", "%{http_code}")
MOMENT_S = 1
NONE_S = 2  # until it is clear that no answer comes, where none is as good as a refusal


# A refusal may close the connection while we still send: over TLS that is an ssl.SSLError, not a ConnectionError.
CLOSED = (TimeoutError, ConnectionError, ssl.SSLError)


def connected(front):
    client = socket.create_connection(("127.0.0.1", front.port), 60)
    return front.context.wrap_socket(client, server_hostname="localhost") if front.context else client


def exchange(front, message, answers=1, patience_s=60):
    """Sends bytes as they are; returns all that comes until the other side closes. It has reason to as soon as these answers
    have come, or patience_s has passed without them: then we end our side, and throng answers what is left of ours. nginx
    would drop it; it gets a moment for an answer too many."""
    answer = b""
    with connected(front) as client:
        client.settimeout(patience_s)
        with contextlib.suppress(*CLOSED):
            client.sendall(message)
        try:
            while len([s for s in statuses(answer) if s != 100]) < answers:
                data = client.recv(65536)
                if not data:
                    return answer
                answer += data
        except TimeoutError:
            pass
        except CLOSED:
            return answer
        if front.context:
            client.settimeout(MOMENT_S)
            try:
                while data := client.recv(65536):
                    answer += data
                return answer
            except TimeoutError:
                pass
            except CLOSED:
                return answer
        client.settimeout(60)
        with contextlib.suppress(*CLOSED, OSError):
            socket.socket.shutdown(client, socket.SHUT_WR)  # SSLSocket's own ends reading, too
            while data := client.recv(65536):
                answer += data
    return answer


def statuses(answers):
    """Of all answers in what came."""
    return [int(status) for status in re.findall(rb"HTTP/1\.[01] (\d{3}) ", answers)]


class Attacks:
    """Run at the bare port and, by a class of its own, through nginx."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.throng = hostile.Throng(THRONG, cls.folder.name)
        cls.addClassCleanup(cls.throng.stop)
        data = str(pathlib.Path(cls.folder.name) / "data")
        cls.reader = throng("keys", "create", "reader", "--data", data, "--scope", "read").stdout.split()[-1]
        cls.front = cls.entrance()

    def setUp(self):
        self.job = json.loads(
            self.ask(
                "/v1/jobs",
                json.dumps(dict(hostile.JOB, name="victim")).encode(),
                headers={"Content-Type": "application/json"},
            )
        )["id"]
        self.ask(f"/v1/jobs/{self.job}/cancel", method="POST")

    def ask(self, path, *more, **named):
        """As soon as nginx's limit of requests allows."""
        while True:
            try:
                return self.front.request(path, *more, **named)
            except urllib.error.HTTPError as error:
                if error.code != 429:
                    raise
                time.sleep(0.2)

    def assert_unharmed(self, attack):
        """Other users get the answers to what they have asked, and nobody has deleted the job for them."""
        for _ in range(3):
            self.assertEqual(json.loads(self.ask("/v1/version"))["name"], "throng", attack)
            self.assertEqual(json.loads(self.ask(f"/v1/jobs/{self.job}"))["id"], self.job, attack)

    def victims_request(self):
        """The beginning of a request that the next user of the same connection would complete with their key."""
        return f"DELETE /v1/jobs/{self.job} HTTP/1.1\r\nHost: localhost\r\nX: ".encode()

    def assert_refused(self, head, body=b"", expected=(400, 415, 417, 431, 501, 505, 404, 405, 408)):
        with self.subTest(head=head):
            answers = exchange(self.front, head + body, patience_s=NONE_S)
            self.assertIn(len(statuses(answers)), (0, 1), answers[:500])
            for status in statuses(answers):
                self.assertIn(status, expected, answers[:500])
            self.assert_unharmed(head)

    def test_bodies_of_methods_without_one(self):
        inner = self.victims_request()
        for method in (b"GET", b"HEAD", b"OPTIONS", b"TRACE", b"PROPFIND", b"get", b"BREW"):
            for fields in (b"Content-Length: %d\r\n" % len(inner), b"Transfer-Encoding: chunked\r\n"):
                body = inner if b"Length" in fields else b"%x\r\n%s\r\n0\r\n\r\n" % (len(inner), inner)
                self.assert_refused(method + b" /v1/version HTTP/1.1\r\n" + HOST + fields + b"\r\n", body)

    def test_unclear_framing(self):
        inner = self.victims_request()
        start = b"POST /v1/jobs HTTP/1.1\r\n" + HOST + b"Content-Type: application/json\r\n"
        for fields in (
            b"Content-Length: 0\r\nContent-Length: %d\r\n",
            b"Content-Length: 0, %d\r\n",
            b"Content-Length: +%d\r\n",
            b"Content-Length: 0x%x\r\n",
            b"Content-Length:\x0b%d\r\n",
            b"Content-Length: %d\r\nTransfer-Encoding: chunked\r\n",
            b"Transfer-Encoding: chunked\r\nContent-Length: %d\r\n",
            b"Transfer-Encoding: xchunked\r\nContent-Length: %d\r\n",
            b"Transfer-Encoding:\x0bchunked\r\nContent-Length: %d\r\n",
            b"Transfer-Encoding: identity\r\nContent-Length: %d\r\n",
            b"X: y\r\n Transfer-Encoding: chunked\r\nContent-Length : %d\r\n",
            b"Content-Length: %d\r\nX: \0\r\n",
        ):
            head = start + fields % len(inner) + b"\r\n"
            self.assert_refused(head, b"0\r\n\r\n" + inner, (400, 401, 415, 501))

    def test_chunked_oddities(self):
        inner = self.victims_request()
        start = (
            b"POST /v1/jobs HTTP/1.1\r\n" + HOST + b"Content-Type: application/json\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n"
        )
        for body in (
            b"0\r\nContent-Length: 5\r\n\r\n",
            b'0;x="\r\n\r\n"\r\n\r\n',
            b"0 \r\n\r\n",
            b"0x0\r\n\r\n",
            b"1\n\n0\n\n",
            b"ffffffffffffffff1\r\n",
            b"-1\r\n",
            b"3\r\nabcd\r\n0\r\n\r\n",
            b"\r\n\r\n",
        ):
            with self.subTest(body=body):
                exchange(self.front, start + body + inner, patience_s=NONE_S)
                self.assert_unharmed(body)

    def test_malformed_heads(self):
        inner = self.victims_request() + b"y\r\n\r\n"
        for head in (
            b"GET /v1/version\r\n\r\n",
            b"GET /v1/version HTTP/0.9\r\n\r\n",
            b"GET /v1/version HTTP/3.0\r\n\r\n",
            b"GET /v1/version HTTP/1.1\n" + HOST.replace(b"\r", b"") + b"\n",
            b"\0",
            b"\x16\x03\x01\x02\0",
            b"GET /v1/version HTTP/1.1\r\n\r\n",
            b"GET /v1/version HTTP/1.1\r\n" + HOST + HOST + b"\r\n",
            b"GET /v1/version HTTP/1.1\r\nHost: a b\r\n\r\n",
            b"GET /v1/%zz HTTP/1.1\r\n" + HOST + b"\r\n",
            b"GET /v1/version HTTP/1.1\r\n" + HOST + b"X: " + b"y" * 70_000 + b"\r\n\r\n",
            b"GET /" + b"y" * 70_000 + b" HTTP/1.1\r\n" + HOST + b"\r\n",
            b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
        ):
            with self.subTest(head=head[:100]):
                answers = exchange(self.front, head + inner, patience_s=NONE_S)
                # nginx itself takes lines that end with LF, and what follows is a request of the same client.
                if not (self.front.context and b"1.1\n" in head):
                    self.assertTrue(all(status >= 400 for status in statuses(answers)), answers[:300])
                self.assert_unharmed(head[:100])

    def test_refused_bodies_are_no_requests(self):
        inner = self.victims_request() + b"y\r\nAuthorization: Bearer " + self.reader.encode() + b"\r\n\r\n"
        for line in (
            b"POST /v1/jobs",
            b"POST /v1/nothing",
            b"PUT /v1/jobs",
            b"DELETE /v1/version",
            b"PATCH /v1/jobs/a",
        ):
            for more in (
                b"",
                b"Authorization: Bearer " + self.reader.encode() + b"\r\n",
                b"Content-Encoding: br\r\n",
                b"Expect: 100-continue\r\n",
            ):
                head = line + b" HTTP/1.1\r\n" + HOST + b"Content-Length: %d\r\n" % len(inner) + more + b"\r\n"
                with self.subTest(head=head):
                    answers = [s for s in statuses(exchange(self.front, head + inner)) if s != 100]
                    self.assertEqual(len(answers), 1, head)
                    self.assertGreaterEqual(answers[0], 400)
                    self.assert_unharmed(head)

    def test_an_answer_goes_to_who_asked(self):
        """The smuggled request would have its answer sent to the next user: with an attacker's own key."""
        inner = b"GET /v1/jobs HTTP/1.1\r\n" + HOST + b"Authorization: Bearer " + self.reader.encode() + b"\r\n\r\n"
        for method in (b"GET", b"HEAD", b"OPTIONS"):
            head = method + b" /healthz HTTP/1.1\r\n" + HOST + b"Content-Length: %d\r\n\r\n" % len(inner)
            self.assert_refused(head, inner)

    def test_upgrades_are_not_followed(self):
        for fields in (
            b"Connection: Upgrade, HTTP2-Settings\r\nUpgrade: h2c\r\nHTTP2-Settings: AAMAAABkAARAAAAAAAIAAAAA\r\n",
            b"Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n",
        ):
            answers = exchange(self.front, b"GET /v1/version HTTP/1.1\r\n" + HOST + fields + b"\r\n")
            self.assertEqual(statuses(answers)[:1], [200], answers[:300])
            self.assert_unharmed(fields)

    def test_nothing_is_inflated(self):
        before = self.throng.resident_mb()
        bomb = gzip.compress(gzip.compress(b"\0" * 200_000_000))
        for coding in (
            b"br",
            b"gzip",
            b"deflate",
            b"GZIP",
            b"identity, gzip",
            b"gzip\r\nContent-Encoding: identity",
            b"identity\r\nContent-Encoding: gzip",
        ):
            for key in (b"", self.throng.key.encode()):
                head = (
                    b"POST /v1/jobs HTTP/1.1\r\n"
                    + HOST
                    + b"Content-Type: application/json\r\nContent-Encoding: "
                    + coding
                    + b"\r\nAuthorization: Bearer "
                    + key
                    + b"\r\nContent-Length: %d\r\n\r\n" % len(bomb)
                )
                answers = exchange(self.front, head + bomb)
                # nginx may refuse a stranger before it looks at all fields.
                self.assertIn(statuses(answers), ([415],) if key else ([415], [401]), head)
        # A part of a form may contain any headers: they are ignored (RFC 7578, 4.8).
        part = (
            b'--B\r\nContent-Disposition: form-data; name="job"\r\nContent-Encoding: gzip\r\n\r\n'
            + bomb
            + b"\r\n--B--\r\n"
        )
        head = (
            b"POST /v1/jobs HTTP/1.1\r\n"
            + HOST
            + b"Content-Type: multipart/form-data; boundary=B\r\nConnection: close\r\n"
            b"Authorization: Bearer " + self.throng.key.encode() + b"\r\nContent-Length: %d\r\n\r\n" % len(part)
        )
        self.assertEqual(statuses(exchange(self.front, head + part)), [400])
        self.assertLess(self.throng.resident_mb() - before, 100)

    def test_nested_json_ends_nothing(self):
        deep = b"[" * 150_000 + b"]" * 150_000
        for method, path, form in (
            ("POST", "/v1/jobs", b'{"scenario": "x", "randomize": %s}'),
            ("POST", "/v1/jobs", b"%s"),
            ("POST", "/v1/calibrations", b'{"files": %s}'),
            ("POST", "/v1/calibrations", b'{"a": %s}'),
            ("PATCH", f"/v1/jobs/{self.job}", b'{"labels": %s}'),
            ("PATCH", f"/v1/jobs/{self.job}", b'{"priority": %s}'),
            ("POST", f"/v1/jobs/{self.job}/clone", b'{"x": %s}'),
            ("POST", "/v1/webhooks", b'{"url": %s}'),
            ("POST", "/v1/webhooks", b'{"events": %s}'),
        ):
            with self.assertRaises(urllib.error.HTTPError) as raised:
                self.ask(path, form % deep, method, {"Content-Type": "application/json"})
            self.assertEqual(raised.exception.code, 400, path)
            self.assertIn("64", raised.exception.read().decode())
        self.assert_unharmed("nested JSON")

    def test_nested_json_in_archives_ends_nothing(self):
        deep = "[" * 150_000 + "]" * 150_000
        for name, text in (
            ("deep.json", deep),
            ("deep.json", '{"crowd": %s}' % deep),
            ("deep.json", '{"base": %s}' % deep),
        ):
            archive = io.BytesIO()
            with zipfile.ZipFile(archive, "w") as bundle:
                bundle.writestr(name, text)
            form = (
                b'--B\r\nContent-Disposition: form-data; name="job"\r\n\r\n{"scenario": "bundle/deep", "crowd": {"agents": 3}}'
                b'\r\n--B\r\nContent-Disposition: form-data; name="scenario"; filename="a.zip"\r\n\r\n'
                + archive.getvalue()
                + b"\r\n--B--\r\n"
            )
            for path, body, kind in (
                ("/v1/scenarios?name=deep", archive.getvalue(), "application/zip"),
                ("/v1/jobs", form, "multipart/form-data; boundary=B"),
            ):
                with self.assertRaises(urllib.error.HTTPError) as raised:
                    self.ask(path, body, "POST", {"Content-Type": kind})
                self.assertEqual(raised.exception.code, 400, path)
        self.assert_unharmed("nested JSON in an archive")

    def test_forms_that_cannot_be_read(self):
        """The library gives up before the body: what is left of it must not become a request."""
        inner = self.victims_request() + b"y\r\nAuthorization: Bearer " + self.throng.key.encode() + b"\r\n\r\n"
        key = b"Authorization: Bearer " + self.throng.key.encode() + b"\r\n"
        part = b'Content-Disposition: form-data; name="job"\r\n'
        for kind, body in (
            (b"multipart/form-data", inner),
            (b"multipart/form-data; boundary=", inner),
            (b'multipart/form-data; boundary="', inner),
            (b"multipart/form-data; boundary=" + b"x" * 4000, inner),
            (b"multipart/form-data; boundary=(.*)*", b"--(.*)*\r\n" + part + b"\r\n" + inner),
            (b"multipart/form-data; boundary=B", b"--B\r\nX: " + b"y" * 9000 + b"\r\n\r\n" + inner),
            (b"multipart/form-data; boundary=B", b"--B\r\n" + part + b"\r\nx\r\n--B--\r\n" + inner),
            (b"application/x-www-form-urlencoded", b"a=" + b"b" * 20_000 + inner),
            (b"application/x-www-form-urlencoded", b"%" * 3000 + inner),
        ):
            head = (
                b"POST /v1/jobs HTTP/1.1\r\n"
                + HOST
                + key
                + b"Content-Type: "
                + kind
                + b"\r\nContent-Length: %d\r\n\r\n" % len(body)
            )
            with self.subTest(kind=kind[:60]):
                answers = exchange(self.front, head + body)
                self.assertEqual(len(statuses(answers)), 1, answers[:400])
                self.assertGreaterEqual(statuses(answers)[0], 400)
                self.assert_unharmed(kind[:60])

    def test_lengths_that_lie(self):
        inner = self.victims_request() + b"y\r\n\r\n"
        start = b"POST /v1/jobs HTTP/1.1\r\n" + HOST + b"Content-Type: application/json\r\n"
        key = b"Authorization: Bearer " + self.throng.key.encode() + b"\r\n"
        for body, length in ((b"{}", 100), (b"{}" + inner, 2), (b"", 5)):
            head = start + key + b"Content-Length: %d\r\n\r\n" % length
            answers = exchange(self.front, head + body, patience_s=NONE_S)
            self.assertTrue(all(status >= 400 for status in statuses(answers)), answers[:300])
            self.assert_unharmed(body)

    def test_old_clients(self):
        self.assertEqual(statuses(exchange(self.front, b"GET /v1/version HTTP/1.0\r\n\r\n")), [200])
        kept = b"GET /v1/version HTTP/1.0\r\nConnection: keep-alive\r\n\r\n"
        self.assertEqual(statuses(exchange(self.front, kept * 2, answers=2)), [200, 200])

    def test_escaped_line_ends_stay_escaped(self):
        """The library decodes percent escapes in header fields."""
        inner = b"x%0d%0aAuthorization: Bearer " + self.throng.key.encode()
        answers = exchange(
            self.front, b"GET /v1/jobs HTTP/1.1\r\n" + HOST + b"X: " + inner + b"\r\nConnection: close\r\n\r\n"
        )
        self.assertEqual(statuses(answers), [401])
        for length in (b"%30", b"0%0d%0aX: y"):
            head = b"POST /v1/jobs HTTP/1.1\r\n" + HOST + b"Content-Length: " + length + b"\r\n\r\n"
            self.assert_refused(head, self.victims_request(), (400, 401))

    def test_other_spellings_of_the_path(self):
        """Scopes are those of the route that answers, however its path is written."""
        paths = """
            /v1/%77ebhooks /v1//webhooks /v1/./webhooks /v1/jobs/../webhooks /v1/webhooks/ /V1/webhooks
            /v1/webhooks;x /v1/webhooks%3f /v1/webhooks%20 /v1/jobs/..%2fwebhooks""".split()
        for path in paths:
            for method, body in (("GET", b""), ("POST", b'{"url": "http://a"}')):
                head = (
                    f"{method} {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAuthorization: Bearer {self.reader}\r\n"
                    f"Content-Type: application/json\r\n"
                ).encode()
                head += b"Content-Length: %d\r\n" % len(body) if body else b""
                answers = exchange(self.front, head + b"\r\n" + body)
                self.assertEqual(len(statuses(answers)), 1)
                self.assertIn(statuses(answers)[0], (400, 403, 404, 405), path)

    def curl(self, *arguments, data=None):
        scheme = "https" if self.front.context else "http"
        words = [
            f"{scheme}://localhost:{self.front.port}{word}" if word.startswith("/v1") else word for word in arguments
        ]
        return subprocess.run(
            ["curl", "-sk", "--max-time", "300", "-H", f"Authorization: Bearer {self.throng.key}", *words],
            input=data,
            capture_output=True,
            check=False,
        ).stdout

    def test_curl_keeps_its_connection(self):
        written = "\n%{num_connects} %{http_code}\n"
        out = self.curl("-w", written, "/v1/version", "/v1/jobs", "/v1/version").decode().splitlines()
        self.assertEqual([line for line in out if line in ("0 200", "1 200")], ["1 200", "0 200", "0 200"])

    def test_curl_posts_without_a_body(self):
        code = self.curl("-X", "POST", "-o", "/dev/null", "-w", "%{http_code}", f"/v1/jobs/{self.job}/retry")
        self.assertEqual(code, b"200")
        self.ask(f"/v1/jobs/{self.job}/cancel", method="POST")

    def test_curl_waits_for_continue(self):
        body = json.dumps(hostile.JOB).encode()
        out = self.curl("-i", "-H", "Expect: 100-continue", *JSON_BODY, "--http1.1", "/v1/jobs?dry_run", data=body)
        self.assertIn(b"100 Continue", out)
        self.assertIn(b"200", out.split(b"\r\n\r\n")[1])

    def test_head_range_and_events(self):
        head = exchange(self.front, b"HEAD /v1/version HTTP/1.1\r\n" + HOST + b"Connection: close\r\n\r\n")
        self.assertEqual(statuses(head), [200])
        self.assertTrue(head.endswith(b"\r\n\r\n"))
        events = self.curl("-H", "Accept: text/event-stream", f"/v1/jobs/{self.job}/events").decode()
        self.assertIn("event: submitted", events)
        self.assertIn("event: cancelled", events)

    def test_64_connections(self):
        def ask(number):
            kind = http.client.HTTPSConnection if self.front.context else http.client.HTTPConnection
            more = {"context": self.front.context} if self.front.context else {}
            connection = kind("localhost", self.front.port, timeout=300, **more)
            found = []
            for i in range(3):
                body = json.dumps(dict(hostile.JOB, name=f"job {number} {i}"))
                connection.request(
                    "POST",
                    "/v1/jobs?dry_run",
                    body,
                    {"Content-Type": "application/json", "Authorization": f"Bearer {self.throng.key}"},
                )
                answer = connection.getresponse()
                found.append(json.loads(answer.read()).get("job", {}).get("name") == f"job {number} {i}")
            connection.close()
            return all(found)

        # As many connections as nginx allows an address at once.
        with concurrent.futures.ThreadPoolExecutor(40 if self.front.context else 64) as pool:
            self.assertTrue(all(pool.map(ask, range(64))))

    def test_pipelined_requests(self):
        one = b"GET /v1/version HTTP/1.1\r\n" + HOST
        answers = exchange(self.front, (one + b"\r\n") * 5 + one + b"Connection: close\r\n\r\n", answers=6)
        self.assertEqual(statuses(answers), [200] * 6)


class BarePort(Attacks, unittest.TestCase):
    @classmethod
    def entrance(cls):
        return hostile.Front(cls.throng.port, cls.throng.key)

    def setUp(self):
        # tests/server/smuggling_test.cpp attacks the bare port, too.
        if not os.environ.get("THRONG_LONG") and hasattr(Attacks, self._testMethodName):
            self.skipTest("in the long test")
        super().setUp()

    def test_chunked_uploads_arrive(self):
        code = self.curl(*CHUNKED, *JSON_BODY, *STATUS_ONLY, "/v1/jobs?dry_run", data=json.dumps(hostile.JOB).encode())
        self.assertEqual(code, b"200")

    def test_slow_heads_are_cut_off(self):
        """While it is sent, however slowly, the connection is closed, and with it what came so far."""
        answers, sent = b"", 0
        with connected(self.front) as client:
            client.settimeout(0.3)
            client.sendall(b"GET /v1/version HTTP/1.1\r\nHost: a")
            while True:
                try:
                    if not (data := client.recv(65536)):
                        break
                    answers += data
                except TimeoutError:
                    self.assertLess(sent, 1000, "5 minutes")
                    with contextlib.suppress(ConnectionError):
                        client.sendall(b"a")
                    sent += 1
                except ConnectionError:
                    break
        self.assertGreater(sent, 0)
        self.assertIn(statuses(answers), ([], [408]))


@unittest.skipUnless(hostile.nginx_program() or os.environ.get("CI"), "there is no nginx on this machine")
class ThroughNginx(Attacks, unittest.TestCase):
    @classmethod
    def entrance(cls):
        nginx = hostile.Nginx(cls.folder.name, cls.throng.port)
        cls.addClassCleanup(nginx.stop)
        return hostile.Front(nginx.port, cls.throng.key, nginx.context)

    def test_unannounced_bodies_of_http2_end_in_nginx(self):
        for method in ("GET", "OPTIONS", "BREW"):
            self.curl("--http2", "-X", method, "-T", "-", "-H", "Expect:", "/v1/version", data=self.victims_request())
            self.assert_unharmed(f"HTTP/2 {method}")

    def test_a_get_with_a_body_never_reaches_throng(self):
        log = pathlib.Path(self.folder.name) / "access.log"
        self.assertEqual(
            self.curl("-X", "GET", "-d", "x", "--http1.1", "-w", "%{http_code}", "-o", "/dev/null", "/v1/version"),
            b"400",
        )
        end_s = time.monotonic() + 300
        while '"GET /v1/version" 400' not in log.read_text():  # nginx logs after it has answered
            self.assertLess(time.monotonic(), end_s, log.read_text()[-2000:])
            time.sleep(0.05)

    def test_chunked_uploads_arrive(self):
        body = json.dumps(hostile.JOB).encode()
        code = self.curl(*CHUNKED, *JSON_BODY, "--http1.1", *STATUS_ONLY, "/v1/jobs?dry_run", data=body)
        self.assertEqual(code, b"200")

    def test_other_connections_of_the_upstream_are_shared(self):
        """Precondition of the attacks: two users' requests on one connection to throng."""
        for _ in range(20):
            self.ask("/v1/version")
        ends = (
            subprocess.run(
                ["ss", "-tn", "state", "established", f"( dport = :{self.throng.port} )"],
                capture_output=True,
                text=True,
            ).stdout
            if shutil.which("ss")
            else ""
        )
        self.assertLess(len(ends.splitlines()), 20)


if __name__ == "__main__":
    unittest.main()
