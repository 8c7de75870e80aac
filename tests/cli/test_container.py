#!/usr/bin/env python3
"""The service as a container starts it: the first key, logs and the end; without a container, by the environment that the image sets.

usage: test_container.py THRONG
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

from service import ServiceEnded, start_service

THRONG = sys.argv.pop(1)
CONTAINER = {**os.environ, "THRONG_CONTAINER": "1"}
OUTSIDE = {name: value for name, value in os.environ.items() if name != "THRONG_CONTAINER"}


def status(port, key=None):
    """HTTP status of the list of jobs."""
    request = urllib.request.Request(f"http://127.0.0.1:{port}/v1/jobs")
    if key:
        request.add_header("Authorization", f"Bearer {key}")
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


class Container(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.data = self.folder / "data"

    def start(self, **environment):
        """The port of a service on all addresses; its output goes to files."""
        self.output, self.errors = self.folder / "stdout", self.folder / "stderr"
        with self.output.open("w") as output, self.errors.open("w") as errors:
            self.process, port = start_service(
                THRONG, self.data, "--host", "0.0.0.0", env={**CONTAINER, **environment}, stdout=output, stderr=errors
            )
        self.addCleanup(self.process.kill)
        return port

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.process.wait(60), 0)

    def test_the_first_start_makes_a_key_and_says_it_once(self):
        port = self.start()
        said = self.errors.read_text()
        [key] = set(re.findall(r"throng_[a-z0-9]{8}_[a-z0-9]+", said))
        self.assertIn("http://localhost:", said)
        self.assertEqual((status(port), status(port, key)), (401, 200))
        self.assertNotIn(key, self.output.read_text())
        self.end()
        port = self.start()
        self.assertNotIn("throng_", self.errors.read_text())
        self.assertEqual(status(port, key), 200)
        self.end()

    def test_the_key_can_come_from_a_file(self):
        secret = "b1946ac92492d2347c6235b4d2611184b1946ac92492d234"
        file = self.folder / "key"
        file.write_text(secret + "\n")
        port = self.start(THRONG_ADMIN_KEY_FILE=str(file))
        self.assertEqual((status(port), status(port, secret), status(port, secret[:-1] + "5")), (401, 200, 401))
        self.assertNotIn(secret, self.output.read_text() + self.errors.read_text())
        self.end()

    def test_a_file_without_a_key_is_refused(self):
        file = self.folder / "key"
        for text in ("", "short", "x" * 200, "with spaces in it, which no header may have"):
            file.write_text(text)
            done = subprocess.run(
                [THRONG, "serve", "--data", self.data, "--port", "0", "--host", "0.0.0.0"],
                env={**CONTAINER, "THRONG_ADMIN_KEY_FILE": str(file)},
                capture_output=True,
                text=True,
                timeout=60,
            )
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"{file}: found a key of {len(text)} characters, expected 32 to 128 letters", done.stderr)
        done = subprocess.run(
            [THRONG, "serve", "--data", self.data, "--port", "0", "--host", "0.0.0.0"],
            env={**CONTAINER, "THRONG_ADMIN_KEY_FILE": "/missing/key"},
            capture_output=True,
            text=True,
            timeout=60,
        )
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("/missing/key", done.stderr)

    def test_outside_of_containers_a_service_without_keys_stays_closed(self):
        with self.assertRaises(ServiceEnded) as refused:
            start_service(THRONG, self.data, "--host", "0.0.0.0", env=OUTSIDE)
        self.assertEqual(refused.exception.process.returncode, 2)

    def test_logs_are_json_on_standard_output(self):
        port = self.start()
        status(port)
        self.end()
        lines = [json.loads(line) for line in self.output.read_text().splitlines()]
        self.assertTrue(any("serving on" in json.dumps(line) for line in lines), lines)
        self.assertTrue(any("ending" in json.dumps(line) for line in lines), lines)


if __name__ == "__main__":
    unittest.main()
