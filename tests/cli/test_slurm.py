"""Jobs on a Slurm cluster of two nodes (on this machine) that share a folder: workers, nodes, the controller and the
server are killed or cut off while a job runs; in the end the dataset has the bytes of `throng run` on one machine.

usage: test_slurm.py THRONG [unittest's arguments]
"""
import contextlib
import json
import os
import pathlib
import signal
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import THRONG, FolderTest, throng, write_json  # noqa: E402
from service import send, start_service, wait_until  # noqa: E402
from slurm_cluster import Cluster, is_alive, missing_programs  # noqa: E402


JOB = {
    "name": "cluster",
    "scenario": "city_square/nearest_exit",
    "runs": 2,
    "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": {"rate_hz": 1, "from_s": 1, "to_s": 2},
    "outputs": {"annotations": ["coco"]},
}
POLL = ("--slurm-poll", "1")


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def starts_of(job_folder):
    """How often each task was begun, by the logs of the workers."""
    return {log.stem: log.read_text().count(" begun, attempt ") for log in (job_folder / "logs").glob("run*.log")}


def ends_of(job_folder):
    return [json.loads(line) for line in (job_folder / "logs" / "nodes.jsonl").read_text().splitlines()]


class Server:
    def __init__(self, base, environment):
        self.folder, self.environment, self.process = base, environment, None
        self.log = open(base / "server.log", "ab")

    def start(self, faults=""):
        options = ["--database", self.folder / "local", "--executor", "slurm", *POLL]
        environment = dict(self.environment, THRONG_FAULTS=faults)
        self.process, port = start_service(THRONG, self.folder / "shared", *options, stderr=self.log, env=environment)
        self.url = f"http://127.0.0.1:{port}"

    def end(self, number):
        self.process.send_signal(number)
        self.process.wait(300)

    def close(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.log.close()

    def request(self, method, path, body=None):
        with send(self.url + path, body, method=method) as answer:
            text = answer.read()
        return json.loads(text or b"null") if path.startswith("/v1") else text.decode()

    def job(self, name):
        return self.request("GET", f"/v1/jobs/{name}")

    def wait_for_end(self, name):
        wait_until(lambda: self.job(name)["state"] not in ("queued", "running"), what="the job's end")
        return self.job(name)


@unittest.skipIf(
    missing_programs() and not os.environ.get("CI"),
    f"skipped: this machine has no {', '.join(missing_programs())} (Debian: slurm-wlm, munge)",
)
@unittest.skipIf(os.getuid() != 0, "skipped: only root may look into workers, which are protected from their own user")
class Slurm(FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        base = pathlib.Path(cls.folder.name)
        cls.job_file = write_json(base / "job.json", JOB)
        throng("run", cls.job_file, "-o", base / "local")
        cls.expected = files_of(base / "local" / "dataset")

    def start_cluster(self, **options):
        self.cluster = Cluster(self.folder / "cluster", **options)
        self.addCleanup(self.cluster.stop)
        self.cluster.__enter__()

    def expect_same_files(self, dataset):
        found = files_of(dataset)
        self.assertEqual(sorted(found), sorted(self.expected))
        for path, data in self.expected.items():
            self.assertEqual(found[path], data, path)

    def tasks(self, *states):
        return [task for task in self.cluster.jobs() if not states or task[2] in states]

    def worker_of(self, task, node=None):
        """The process that works on a task, and its node."""

        def found():
            for name in [node] if node else ["node1", "node2"]:
                for pid in self.cluster.processes_of(name):
                    with contextlib.suppress(OSError):
                        words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
                        if b"--array" not in words or words[0].endswith(b"sh"):
                            continue
                        folder = pathlib.Path(words[words.index(b"--job") + 1].decode())
                        array = folder / "attempts" / words[words.index(b"--array") + 1].decode()
                        environment = pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
                        index = next(
                            int(entry.split(b"=")[1])
                            for entry in environment
                            if entry.startswith(b"SLURM_ARRAY_TASK_ID=")
                        )
                        tasks = json.loads((array / "array.json").read_text())["tasks"]
                        if tasks[index]["task"] == task and (array / str(index) / "messages").exists():
                            return pid, name
            return None

        return wait_until(found, what=f"a worker of {task}")

    def test_run_on_two_nodes(self):
        self.start_cluster()
        out = self.folder / "out"
        refused = self.cluster.run(
            THRONG, "run", str(self.job_file), "-o", str(out), "--executor", "slurm", "--slurm-partition", "nope"
        )
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("nvalid partition", refused.stderr)
        begun = time.monotonic()
        # Each task rests so long that the other node gets the next one.
        run = self.cluster.run(
            "env",
            "THRONG_FAULTS=slow:*:3",
            THRONG,
            "run",
            str(self.job_file),
            "-o",
            str(out),
            "--executor",
            "slurm",
            *POLL,
            "--slurm-time",
            "30",
            "--slurm-option=--comment=a test",
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        print(f"throng run: {time.monotonic() - begun:.1f} s on two nodes", file=sys.stderr)
        self.expect_same_files(out / "dataset")
        self.assertEqual({end["node"] for end in ends_of(out)}, {"node1", "node2"})
        self.assertFalse((out / "attempts").exists())
        self.assertEqual(list(out.rglob("*.tmp.*")), [])

    def test_service_survives_what_dies(self):
        self.start_cluster(node_timeout_s=10)  # a lost node is waited for
        server = Server(self.folder, self.cluster.environment)
        self.addCleanup(server.close)
        # Simulations rest for a while at their beginning: time to kill somebody.
        server.start("slow:run000/trace:12")
        name = server.request("POST", "/v1/jobs", JOB)["id"]
        folder = self.folder / "shared" / "jobs" / name

        # The server dies while tasks run; the next one finds them.
        worker, _ = self.worker_of("run000/trace")
        server.end(signal.SIGKILL)
        self.assertTrue(is_alive(worker), "tasks go on without the server")
        server.start("slow:run000/shard0000:600")
        wait_until(lambda: (folder / "work/run000/trace.h5").exists(), what="the first simulation")

        # A worker is killed in the next stage. It is the only attempt that is lost so far.
        worker, _ = self.worker_of("run000/shard0000")
        self.assertEqual(starts_of(folder)["run000_trace"], 1, "it did not run twice")
        # A worker that dies before its first word leaves no count of its attempt.
        wait_until(lambda: starts_of(folder).get("run000_shard0000", 0) == 1, what="the first attempt")
        os.kill(worker, signal.SIGKILL)
        wait_until(lambda: starts_of(folder).get("run000_shard0000", 0) == 2, what="the second attempt")

        # The controller goes away; workers go on.
        self.cluster.end("slurmctld")
        wait_until(
            lambda: "does not answer" in str(server.job(name)["waiting_for"]), what="a word about the controller"
        )
        self.assertEqual(server.job(name)["state"], "running")
        self.cluster.start_controller()
        self.cluster.wait_for_nodes()

        # The node is cut off from the cluster, with its worker in the midst of its work.
        worker, node = self.worker_of("run000/shard0000")
        cut_off = self.cluster.processes_of(node)
        for pid in cut_off:
            os.kill(pid, signal.SIGSTOP)
        begun = time.monotonic()
        try:
            wait_until(lambda: any("NODE_FAIL" in end["message"] for end in ends_of(folder)), what="the node's loss")
        except TimeoutError:
            print(self.cluster.node_states(), self.cluster.jobs(), ends_of(folder), server.job(name), file=sys.stderr)
            raise
        print(f"node lost after {time.monotonic() - begun:.1f} s", file=sys.stderr)
        # A server that ends politely leaves its tasks to the next one, too.
        server.end(signal.SIGTERM)
        server.start("slow:run000/shard0000:12")
        third, other = self.worker_of("run000/shard0000", "node2" if node == "node1" else "node1")
        os.kill(third, signal.SIGTERM)  # "somebody else ends it": costs no attempt
        end = server.wait_for_end(name)
        self.assertEqual(end["state"], "succeeded", end["error"])
        self.expect_same_files(folder / "dataset")
        published = files_of(folder / "work")

        # It comes back and goes on with its work: nothing of it may appear.
        for pid in cut_off:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGCONT)
        wait_until(lambda: not is_alive(worker), what="the end of the worker that was cut off")
        self.assertEqual(files_of(folder / "work"), published)
        self.assertFalse((folder / "attempts").exists())

        nodes = {work["node"]: work for work in end["progress"]["nodes"]}
        self.assertEqual(set(nodes), {"node1", "node2"})
        self.assertGreaterEqual(sum(work["failed"] for work in nodes.values()), 2)
        self.assertIn(
            f'throng_node_attempts_total{{node="{other}",outcome="succeeded"}}', server.request("GET", "/metrics")
        )
        self.assertFalse((self.folder / "shared" / "jobs.sqlite").exists(), "the database is local")

    def test_cancel_ends_tasks(self):
        self.start_cluster()
        server = Server(self.folder, self.cluster.environment)
        self.addCleanup(server.close)
        server.start("slow:run000/trace:400")
        name = server.request("POST", "/v1/jobs?priority=40", JOB)["id"]
        worker, _ = self.worker_of("run000/trace")
        self.assertIn(" Nice=60 ", self.cluster.run("scontrol", "show", "job").stdout)
        server.request("POST", f"/v1/jobs/{name}/cancel")
        wait_until(lambda: not is_alive(worker), what="the worker's end")
        wait_until(lambda: not self.tasks("RUNNING", "PENDING", "COMPLETING"), what="an empty queue")
        self.assertEqual(server.job(name)["state"], "cancelled")
        self.assertFalse((self.folder / "shared" / "jobs" / name / "attempts").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
