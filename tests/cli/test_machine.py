"""Faults of the machine, which are no job's: no files left to open, a disk that becomes read-only.

usage: test_machine.py THRONG [unittest's arguments]
"""
import contextlib
import os
import pathlib
import resource
import subprocess
import time
import unittest
import urllib.error

import test_crash as crash
from program import FolderTest

HERE = pathlib.Path(__file__).resolve().parent


def open_files(pid):
    return len(os.listdir(f"/proc/{pid}/fd"))


class Machine(FolderTest):
    def setUp(self):
        super().setUp()
        self.server = crash.Server(self.folder)
        self.addCleanup(lambda: self.server.stop())

    def status(self, method, path, body=None, timeout_s=300):
        try:
            self.server.request(method, path, body, timeout_s)
            return 200
        except urllib.error.HTTPError as error:
            return error.code

    def test_without_files_to_open_jobs_wait(self):
        self.server.start()
        job = self.server.request("POST", "/v1/jobs", dict(crash.JOB, runs=6))["id"]
        crash.wait_until(lambda: self.server.state(job) == "running")
        pid = self.server.process.pid
        limits = resource.prlimit(pid, resource.RLIMIT_NOFILE)
        # One connection fits beside what is open.
        resource.prlimit(pid, resource.RLIMIT_NOFILE, (open_files(pid) + 2, limits[1]))
        end = time.monotonic() + 12
        accepted, refused = 0, 0
        while time.monotonic() < end or not refused:
            if time.monotonic() > end:  # workers had more files open when that was counted
                resource.prlimit(pid, resource.RLIMIT_NOFILE, (open_files(pid) + 1, limits[1]))
            # Few are queued: the first one would wait for them all.
            path = "/v1/jobs" if accepted < 3 else "/v1/jobs?dry_run"
            try:
                # A connection that is not accepted would wait as long as the limit lasts.
                status = self.status("POST", path, crash.JOB, timeout_s=10)
                self.assertIn(status, (200, 503))
                accepted += status == 200
                refused += status == 503
            except (OSError, urllib.error.URLError):
                refused += 1  # it waits to be accepted
            time.sleep(0.3)
        self.assertIsNone(self.server.process.poll(), "the server has ended")
        resource.prlimit(pid, resource.RLIMIT_NOFILE, limits)
        done = self.server.wait_for_end(job)
        self.assertEqual(done["state"], "succeeded", done["error"])
        for other in self.server.request("GET", "/v1/jobs?limit=500")["jobs"]:
            self.assertNotIn(other["state"], ("failed", "partial"), other["error"])

    def begun_workers(self):
        """Workers that run their own program: before, a child has the server's files."""
        found = []
        for pid, _ in crash.workers_of(self.server.process.pid):
            with contextlib.suppress(OSError):
                if b"worker" in pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0"):
                    found.append(pid)
        return found

    def test_workers_inherit_no_connection(self):
        self.server.start(faults="slow:*:600")
        self.server.request("POST", "/v1/jobs", crash.JOB)
        workers = crash.wait_until(lambda: self.begun_workers(), what="a worker")
        found = []
        for number in os.listdir(f"/proc/{workers[0]}/fd"):
            with contextlib.suppress(FileNotFoundError):  # it has closed the file meanwhile
                found.append(os.readlink(f"/proc/{workers[0]}/fd/{number}"))
        self.assertGreater(len(found), 2)
        self.assertEqual([name for name in found if name.startswith("socket:") or ".sqlite" in name], [])

    def test_processes_of_the_same_user_do_not_read_the_servers_memory(self):
        self.server.start()
        self.assertEqual(os.stat(f"/proc/{self.server.process.pid}/environ").st_uid, 0)
        if os.geteuid() != 0:
            with self.assertRaises(PermissionError):
                pathlib.Path(f"/proc/{self.server.process.pid}/environ").read_bytes()

    def test_a_disk_that_becomes_read_only_is_waited_for(self):
        library = self.folder / "read_only_disk.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-o", library, HERE / "read_only_disk.c", "-ldl"], check=True)
        flag = self.folder / "flag"
        preloaded = {"LD_PRELOAD": str(library), "READ_ONLY_ROOT": str(self.server.data), "READ_ONLY_FLAG": str(flag)}
        os.environ.update(preloaded)
        self.server.start()
        for name in preloaded:
            del os.environ[name]
        pid = self.server.process.pid
        job = self.server.request("POST", "/v1/jobs", crash.JOB)["id"]
        crash.wait_until(lambda: list(self.server.data.glob(f"jobs/{job}/work/run*/trace.h5")), what="a trace")
        flag.touch()
        crash.wait_until(lambda: self.status("GET", "/readyz") == 503, what="503")
        waiting = self.server.request("GET", f"/v1/jobs/{job}")
        self.assertEqual(waiting["state"], "running", waiting["error"])
        self.assertIn("read-only", waiting["waiting_for"])
        self.assertEqual(self.status("POST", "/v1/jobs", crash.JOB), 503)
        self.assertEqual(self.status("POST", f"/v1/jobs/{job}/cancel"), 503)
        self.assertEqual(self.status("PATCH", f"/v1/jobs/{job}", {"labels": ["x"]}), 503)
        crash.wait_until(lambda: not crash.workers_of(pid), what="a rest of all workers")
        self.assertEqual(self.server.state(job), "running")
        flag.unlink()
        end = self.server.wait_for_end(job)
        self.assertEqual(end["state"], "succeeded", end["error"])
        self.assertEqual(len(self.server.request("GET", "/v1/jobs")["jobs"]), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
