#!/usr/bin/env python3
"""The service as a container starts it: the first key, logs and the end; without a container, by the environment that the image sets.

usage: test_container.py THRONG
"""
import json
import os
import re
import signal
import tempfile
import unittest
import urllib.error
import urllib.request

from program import THRONG, FolderTest, throng
from service import ServiceEnded, send, start_service

CONTAINER = {**os.environ, "THRONG_CONTAINER": "1"}
OUTSIDE = {name: value for name, value in os.environ.items() if name != "THRONG_CONTAINER"}

SECRET = "b1946ac92492d2347c6235b4d2611184b1946ac92492d234"


def status(port, key=None):
    """HTTP status of the list of jobs."""
    try:
        with send(f"http://127.0.0.1:{port}/v1/jobs", key=key) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


class Container(FolderTest):
    def setUp(self):
        super().setUp()
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

    def key_file(self, text, mode=0o400):
        file = self.folder / "key"
        file.unlink(missing_ok=True)
        file.write_text(text)
        file.chmod(mode)
        return str(file)

    def refusal(self, file, *arguments):
        """The message of a service that does not start because of its key file."""
        variables = {"THRONG_ADMIN_KEY_FILE": file}
        serve = ("serve", "--data", self.data, "--port", 0, *arguments)
        done = throng(*serve, env={**OUTSIDE, **variables}, code=2)
        return done.stderr

    def test_the_key_can_come_from_a_file(self):
        file = self.key_file(SECRET + "\n")
        port = self.start(THRONG_ADMIN_KEY_FILE=file)
        self.assertEqual((status(port), status(port, SECRET), status(port, SECRET[:-1] + "5")), (401, 200, 401))
        self.assertNotIn(SECRET, self.output.read_text() + self.errors.read_text())
        self.end()

    def test_with_a_key_file_keys_are_asked_for_on_every_address(self):
        file = self.key_file(SECRET)
        for environment in (CONTAINER, OUTSIDE):
            for arguments in (["--host", "127.0.0.1"], ["--host", "localhost"], ["--host", "0.0.0.0", "--insecure"]):
                with tempfile.TemporaryDirectory() as data:
                    process, port = start_service(
                        THRONG, data, *arguments, env={**environment, "THRONG_ADMIN_KEY_FILE": file}
                    )
                    self.addCleanup(process.kill)
                    self.assertEqual((status(port), status(port, SECRET)), (401, 200), arguments)
                    process.send_signal(signal.SIGTERM)
                    self.assertEqual(process.wait(60), 0)

    def test_the_key_of_the_file_is_valid_beside_others(self):
        throng("keys", "create", "other", "--data", self.data)
        for secret in (SECRET, SECRET[::-1], SECRET[::-1]):
            port = self.start(THRONG_ADMIN_KEY_FILE=self.key_file(secret))
            self.assertEqual(status(port, secret), 200)
            self.end()
        listed = throng("keys", "list", "--data", self.data)
        ids = [line.split()[0] for line in listed.stdout.splitlines() if "administrator" in line]
        self.assertEqual(len(ids), 2, listed.stdout)
        for key in ids:
            throng("keys", "revoke", key, "--data", self.data)
        self.assertIn("which was revoked", self.refusal(self.key_file(SECRET)))

    def test_wrong_key_files_are_refused_on_every_address(self):
        for arguments in (["--host", "0.0.0.0"], ["--host", "127.0.0.1"], ["--host", "0.0.0.0", "--insecure"]):
            for text in ("", "short", "x" * 200, "with spaces in it, which no header may have"):
                file = self.key_file(text)
                expected = f"{file}: found a key of {len(text)} characters, expected 32 to 128 letters"
                self.assertIn(expected, self.refusal(file, *arguments))
            self.assertIn("every user of this machine", self.refusal(self.key_file(SECRET, 0o644), *arguments))
            for missing in ("/missing/key", str(self.folder)):
                self.assertIn(f"{missing}, which is no file", self.refusal(missing, *arguments))
            self.assertIn("an empty path", self.refusal("", *arguments))

    def test_a_service_without_keys_says_who_may_use_it(self):
        errors = self.folder / "errors"
        with errors.open("w") as said:
            process, port = start_service(THRONG, self.data, env=OUTSIDE, stderr=said)
        self.addCleanup(process.kill)
        self.assertEqual(status(port), 200)
        self.assertIn("there are no keys: everybody who reaches", errors.read_text())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 0)

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
