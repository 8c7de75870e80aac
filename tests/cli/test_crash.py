"""Effect of crashes on a job: the server, its workers, or both are killed at random moments and at every change of a
job's state, the disk is full, the database is locked, what was half-written is damaged. In every case the job has to
end with the bytes of an undisturbed one.

usage: test_crash.py THRONG [unittest's arguments]
$THRONG_CRASHES is the number of random moments of each kind (default: 1); `THRONG_CRASHES=100 ctest --preset release -R cli.crash` takes 50. With $THRONG_LONG
the server dies before and after each change of state, otherwise before or after it in turns.
"""
import contextlib
import hashlib
import http.client
import json
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest
import urllib.error
import urllib.request

from program import THRONG, FolderTest, throng
from service import ServiceEnded, ask, start_service, wait_until

CRASHES = int(os.environ.get("THRONG_CRASHES", "1"))
IS_LONG = bool(os.environ.get("THRONG_LONG"))

# One shard per run, long enough to be hit; in the long test two (of 30 and of 6 frames).
CAPTURE = {"rate_hz": 5, "from_s": 1, "to_s": 8} if IS_LONG else {"rate_hz": 1, "from_s": 1, "to_s": 2}
JOB = {
    "name": "crash",
    "scenario": "city_square/nearest_exit",
    "runs": 2,
    "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": CAPTURE,
    "outputs": {"annotations": ["coco"]},
}


def moments_of(number):
    """When the server dies at the change of state of this number."""
    return ("before", "after") if IS_LONG else (("before", "after")[number % 2],)


def children_of(pid):
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        with contextlib.suppress(OSError, IndexError):
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
            if int(fields[1]) == pid:
                found.append((int(entry.name), fields[0]))
    return found


def workers_of(pid):
    """The server's children but for the process that forks its checks, which stays."""

    def is_fork_server(child):
        with contextlib.suppress(OSError):
            return b"confined" in pathlib.Path(f"/proc/{child}/cmdline").read_bytes().split(b"\0")
        return False

    return [(child, state) for child, state in children_of(pid) if not is_fork_server(child)]


def is_alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


class Server:
    def __init__(self, base, data=None, options=()):
        self.folder = base
        self.data = data or base / "data"
        self.options = options
        self.process = None
        self.log = open(base / "server.log", "ab")

    def start(self, faults=None):
        environment = dict(os.environ)
        if faults:
            environment["THRONG_FAULTS"] = faults
        try:
            self.process, port = start_service(THRONG, self.data, *self.options, stderr=self.log, env=environment)
            self.url = f"http://127.0.0.1:{port}"
        except ServiceEnded as ended:  # by a fault
            self.process, self.url = ended.process, None

    def kill(self):
        workers = [pid for pid, _ in children_of(self.process.pid)]
        self.process.kill()
        self.process.wait()
        # The kernel ends workers with their supervisor; a second writer would spoil everything.
        wait_until(lambda: not any(map(is_alive, workers)), what="the workers' end")

    def stop(self):
        if self.process and self.process.poll() is None:
            self.process.terminate()
            self.process.wait(120)
        self.log.close()

    def kill_a_worker(self):
        workers = [pid for pid, state in workers_of(self.process.pid) if state != "Z"]
        if workers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(random.choice(workers), signal.SIGKILL)
        return bool(workers)

    def request(self, method, path, body=None, timeout_s=300):
        try:
            return ask(self.url + path, body, method=method, timeout_s=timeout_s)
        except http.client.HTTPException as error:  # the server died in the midst of its answer
            raise ConnectionResetError(f"{method} {path}: {error}") from error

    def state(self, job):
        return self.request("GET", f"/v1/jobs/{job}")["state"]

    def wait_for_end(self, job, seconds=600):
        wait_until(lambda: self.state(job) not in ("queued", "running"), seconds, "the job's end")
        return self.request("GET", f"/v1/jobs/{job}")

    def hash_of(self, job):
        digest = hashlib.sha256()
        with urllib.request.urlopen(f"{self.url}/v1/jobs/{job}/archive", timeout=300) as archive:
            for block in iter(lambda: archive.read(1 << 20), b""):
                digest.update(block)
        return digest.hexdigest()


class Crash(FolderTest):
    @classmethod
    def setUpClass(cls):
        """Result and duration of an undisturbed job."""
        cls.undisturbed = tempfile.TemporaryDirectory()
        server = Server(pathlib.Path(cls.undisturbed.name))
        server.start()
        begun = time.monotonic()
        job = server.request("POST", "/v1/jobs", JOB)["id"]
        assert server.wait_for_end(job)["state"] == "succeeded"
        cls.duration_s = time.monotonic() - begun
        cls.hash = server.hash_of(job)
        server.stop()

    @classmethod
    def tearDownClass(cls):
        cls.undisturbed.cleanup()

    def setUp(self):
        super().setUp()
        self.server = Server(self.folder)
        self.addCleanup(lambda: self.server.stop())
        self.random = random.Random(self.id())

    def expect_undisturbed(self, job):
        end = self.server.wait_for_end(job)
        self.assertEqual(end["state"], "succeeded", end["error"])
        self.assertEqual(self.server.hash_of(job), self.hash)
        self.assertEqual([state for _, state in workers_of(self.server.process.pid)], [], "zombies or leaked workers")
        folder = self.server.data / "jobs" / job
        left = [str(path) for path in folder.rglob("*.tmp.*")]
        self.assertEqual(left, [], "half-written files are left")

    def moments(self, seconds):
        return sorted(self.random.uniform(0, seconds) for _ in range(CRASHES))

    def test_the_server_is_killed_at_random_moments(self):
        self.server.start()
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        hits = 0
        for _ in range(CRASHES):
            time.sleep(self.random.uniform(0, self.duration_s / 3))
            if self.server.state(job) not in ("queued", "running"):
                self.expect_undisturbed(job)
                job = self.server.request("POST", "/v1/jobs", JOB)["id"]
            hits += self.server.state(job) in ("queued", "running")
            self.server.kill()
            self.server.start()
            self.assertEqual(
                len(self.server.request("GET", "/v1/jobs?state=running&state=queued")["jobs"])
                + len(self.server.request("GET", "/v1/jobs?state=succeeded")["jobs"]),
                len(self.server.request("GET", "/v1/jobs")["jobs"]),
                "a job is lost or has failed",
            )
        self.expect_undisturbed(job)
        print(f"server killed {CRASHES} times, {hits} of them at work: no job lost, bytes as undisturbed")

    def test_workers_are_killed_at_random_moments(self):
        self.server.start()
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        hits = 0
        partial = 0
        for _ in range(CRASHES):
            time.sleep(self.random.uniform(0, self.duration_s / 3))
            hits += self.server.kill_a_worker()
            state = self.server.state(job)
            if state in ("queued", "running"):
                continue
            if state in ("failed", "partial"):  # the same task was hit three times
                partial += 1
                self.server.request("POST", f"/v1/jobs/{job}/retry")
            self.expect_undisturbed(job)
            job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        if self.server.wait_for_end(job)["state"] in ("failed", "partial"):
            self.server.request("POST", f"/v1/jobs/{job}/retry")
        self.expect_undisturbed(job)
        print(f"workers killed {hits} times, {partial} jobs retried by hand: bytes as undisturbed")

    @unittest.skipUnless(IS_LONG, "in the long test: each of the two is killed above")
    def test_both_are_killed_at_once(self):
        self.server.start()
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        for _ in range(CRASHES):
            time.sleep(self.random.uniform(0, self.duration_s / 3))
            if self.server.state(job) not in ("queued", "running"):
                self.expect_undisturbed(job)
                job = self.server.request("POST", "/v1/jobs", JOB)["id"]
            self.server.kill_a_worker()
            self.server.kill()
            self.server.start()
        self.expect_undisturbed(job)
        print(f"server and workers killed {CRASHES} times: bytes as undisturbed")

    def test_the_server_dies_at_every_change_of_state(self):
        for number, event in enumerate(("started", "succeeded")):
            for moment in moments_of(number):
                with self.subTest(event=event, moment=moment):
                    shutil.rmtree(self.server.data, ignore_errors=True)
                    self.server.start(faults=f"die:server/{event}/{moment}")
                    # It may die before the answer is out, or in the midst of it.
                    with contextlib.suppress(OSError):
                        self.server.request("POST", "/v1/jobs", JOB)
                    self.assertEqual(self.server.process.wait(300), -signal.SIGKILL)
                    self.server.start()
                    jobs = self.server.request("GET", "/v1/jobs")["jobs"]
                    self.assertEqual(len(jobs), 1, "what was accepted is there, once")
                    self.expect_undisturbed(jobs[0]["id"])
                    self.server.stop()
                    self.server = Server(self.folder)

    def test_the_server_dies_when_a_job_is_cancelled_or_retried_or_fails(self):
        changes = (
            ("cancelled", "slow:*:30", "cancel"),
            ("failed", "fail:*", None),
            ("retried", "fail:*", "retry"),
            ("resumed", "slow:*:30", None),
        )
        for number, (event, faults, path) in enumerate(changes):
            for moment in moments_of(number):
                with self.subTest(event=event, moment=moment):
                    shutil.rmtree(self.server.data, ignore_errors=True)
                    if event in ("retried", "resumed"):
                        self.server.start(faults=faults)
                        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
                        wait_until(lambda: self.server.state(job) == ("failed" if event == "retried" else "running"))
                        self.server.kill()
                    self.server.start(faults=f"{faults},die:server/{event}/{moment}")
                    if event not in ("retried", "resumed"):
                        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
                    if path:
                        wait_until(lambda: self.server.state(job) != "queued")
                        with self.assertRaises(OSError):
                            self.server.request("POST", f"/v1/jobs/{job}/{path}")
                    self.assertEqual(self.server.process.wait(300), -signal.SIGKILL)
                    self.server.start()
                    end = self.server.wait_for_end(job)
                    if end["state"] in ("cancelled", "failed"):
                        self.server.request("POST", f"/v1/jobs/{job}/retry")
                    self.expect_undisturbed(job)
                    self.server.stop()
                    self.server = Server(self.folder)

    def test_a_run_whose_worker_always_dies_leaves_the_others(self):
        self.server.start(faults="die:run001/shard0000")
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        end = self.server.wait_for_end(job)
        self.assertEqual(end["state"], "partial")
        self.assertEqual([run["run"] for run in end["error"]["runs"]], ["run001"])
        self.assertEqual(end["error"]["runs"][0]["attempts"], 3)
        self.assertIn("signal 9", end["error"]["runs"][0]["message"])
        self.assertNotIn(str(self.folder), json.dumps(end))
        manifest = self.server.request("GET", f"/v1/jobs/{job}/manifest")
        self.assertEqual([run["run"] for run in manifest["runs"]], ["run000"])
        self.assertEqual(manifest["failed_runs"], [{"run": "run001", "task": "run001/shard0000"}])
        # Everything present is complete.
        throng("validate", self.server.data / "jobs" / job / "dataset")
        self.server.kill()
        self.server.start()
        self.server.request("POST", f"/v1/jobs/{job}/retry")
        self.expect_undisturbed(job)

    def test_a_worker_that_hangs_is_replaced(self):
        self.server.options = ("--task-timeout", "20")
        self.server.start(faults="hang:run000/trace:1")
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        self.expect_undisturbed(job)

    def test_a_worker_that_wants_too_much_memory_is_named(self):
        self.server.options = ("--worker-memory", "1000")
        self.server.start(faults="grow:*")
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        end = self.server.wait_for_end(job)
        self.assertEqual(end["state"], "failed")
        self.assertIn("memory", end["error"]["message"])

    def test_a_job_that_never_fits_is_refused(self):
        self.server.options = ("--worker-memory", "64")
        self.server.start()
        with self.assertRaises(urllib.error.HTTPError) as refused:
            self.server.request("POST", "/v1/jobs", JOB)
        self.assertEqual(refused.exception.code, 400)
        self.assertIn("memory", json.load(refused.exception)["errors"][0]["found"])

    def test_a_locked_database_is_waited_for(self):
        self.server.start()
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        with contextlib.closing(sqlite3.connect(self.server.data / "jobs.sqlite", isolation_level=None)) as other:
            other.execute("BEGIN IMMEDIATE")
            with self.assertRaises(urllib.error.HTTPError) as refused:
                self.server.request("POST", "/v1/jobs", JOB)
            self.assertEqual(refused.exception.code, 503)
            self.assertEqual(len(self.server.request("GET", "/v1/jobs")["jobs"]), 1, "reading goes on")
            other.execute("ROLLBACK")
        self.expect_undisturbed(job)

    def test_damaged_staging_is_not_taken_for_output(self):
        self.server.start(faults="slow:run001/trace:30")
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        work = self.server.data / "jobs" / job / "work"
        wait_until(lambda: (work / "run000" / "trace.h5").exists(), what="a trace")
        self.server.kill()
        for name in ("run000/shard0000.tmp.1.0", "run000/shard0001.tmp.99.3"):
            (work / name / "files").mkdir(parents=True)
            (work / name / "files" / "x.jpg").write_bytes(b"half a picture")
        (work / "run001").mkdir(exist_ok=True)
        (work / "run001" / "trace.h5.tmp.7.1").write_bytes(b"half a trace")
        (self.server.data / "jobs" / job / "dataset.tmp.7.0").mkdir()
        self.server.start()
        self.expect_undisturbed(job)

    def status_of(self, path):
        try:
            self.server.request("GET", path)
            return 200
        except urllib.error.HTTPError as error:
            return error.code

    def use_a_small_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", str(disk)], capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("no right to mount a small disk")
        self.addCleanup(lambda: subprocess.run(["umount", "-l", str(disk)]))
        self.server.data = disk / "data"
        self.server.options = ("--min-free", "8")
        return disk

    def test_a_killed_service_starts_reads_and_deletes_on_a_disk_without_a_free_byte(self):
        disk = self.use_a_small_disk()
        self.server.start()
        jobs = [self.server.request("POST", "/v1/jobs", JOB)["id"] for _ in range(2)]
        for job in jobs:
            self.assertEqual(self.server.wait_for_end(job)["state"], "succeeded")
        hashes = [self.server.hash_of(job) for job in jobs]
        for kill in range(5):
            for block in (1 << 20, 1 << 12, 1):
                with contextlib.suppress(OSError), open(disk / f"filler{kill}", "ab", buffering=0) as file:
                    while file.write(bytes(block)) == block:
                        pass
            self.assertEqual(os.statvfs(disk).f_bavail, 0)
            self.server.kill()
            self.server.start()
            self.assertIsNotNone(self.server.url, "the service did not start")
            self.assertEqual([self.server.hash_of(job) for job in jobs], hashes)
        self.server.request("DELETE", f"/v1/jobs/{jobs[0]}")
        self.assertEqual([row["id"] for row in self.server.request("GET", "/v1/jobs")["jobs"]], jobs[1:])

    def test_a_full_disk_lets_the_queue_rest(self):
        disk = self.use_a_small_disk()
        self.server.start(faults="slow:*:0.2")
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        wait_until(lambda: self.server.state(job) == "running")
        filler = disk / "filler"
        with contextlib.suppress(OSError), open(filler, "wb") as file:
            while True:
                file.write(bytes(1 << 16))
        wait_until(lambda: self.status_of("/readyz") == 503, what="503")
        wait_until(lambda: not workers_of(self.server.process.pid), what="a rest of all workers")
        self.assertEqual(self.server.state(job), "running", "a full disk fails no job")
        filler.unlink()
        self.expect_undisturbed(job)

    def test_it_ends_soon_as_the_first_process_too(self):
        self.server.start(faults="slow:*:3600")
        job = self.server.request("POST", "/v1/jobs", JOB)["id"]
        wait_until(lambda: self.server.state(job) == "running")
        streams = []
        for _ in range(20):
            request = urllib.request.Request(
                f"{self.server.url}/v1/jobs/{job}/events", headers={"Accept": "text/event-stream"}
            )
            streams.append(urllib.request.urlopen(request, timeout=300))
        begun = time.monotonic()
        self.server.process.terminate()
        # Ten seconds are what `docker stop` gives it; a busy machine takes longer, but the job at work would take an hour.
        self.assertEqual(self.server.process.wait(100), 0)
        took_s = time.monotonic() - begun
        for stream in streams:
            stream.close()
        self.server.start()
        self.expect_undisturbed(job)
        print(f"ended in {took_s:.1f} s with a job at work and 20 event streams")
        # Process 1 of a namespace of its own has no default action for SIGTERM, as in a container.
        self.server.stop()
        port_file = self.folder / "port1"
        first = subprocess.Popen(
            [
                "unshare",
                "--fork",
                "--pid",
                "--kill-child",
                "--mount-proc",
                THRONG,
                "serve",
                "--data",
                str(self.server.data),
                "--port",
                "0",
                "--port-file",
                str(port_file),
            ],
            stderr=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
        )
        self.server.process = first
        self.server.log = first.stderr
        ready = wait_until(lambda: port_file.exists() or first.poll() is not None)
        if not port_file.exists() and ready:
            self.skipTest("no right to make a namespace")
        for pid, _ in children_of(first.pid):
            os.kill(pid, signal.SIGTERM)
        first.wait(100)


if __name__ == "__main__":
    unittest.main(verbosity=2)
