"""A job on a simulated Slurm cluster of 100 nodes (fake_slurm.py) with a slow shared folder (shared_folder.c), while nodes
fail and are cut off, tasks are preempted, requeued, ended by limits and forgotten, and the controller is away: the dataset
has the files of one machine, no attempt is wasted, and neither the controller nor the shared folder is asked more than
docs/cluster.md says. test_slurm.py does the like with Slurm itself.

usage: test_slurm_size.py THRONG [unittest's arguments]    two jobs of 25 tasks at once; with $THRONG_LONG one of 3001 tasks, 1000
                                                      of which render 10 frames each
"""
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from program import THRONG, throng, write_json

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import fake_slurm  # noqa: E402

HERE = pathlib.Path(__file__).parent
IS_LONG = bool(os.environ.get("THRONG_LONG"))
FRAMES_PER_RUN = 10
POLL_S = 0.5
KINDS = ("open", "create", "status", "list", "make_folder", "rename", "link", "remove", "sync")
COUNTS = 16  # of shared_folder.c
SLOW = {"SHARED_LATENCY_US": "2000", "SHARED_VISIBILITY_MS": "1000"}


def job_of(runs):
    return {
        "name": "size",
        "scenario": "city_square/nearest_exit",
        "runs": runs,
        "quality": "draft",
        "crowd": {"agents": 10},
        "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 64, "height": 64, "pitch_deg": -60}}],
        "capture": {"rate_hz": 10, "from_s": 1, "to_s": 1.9},
        "outputs": {"annotations": ["coco"]},
    }


def hashes_of(folder):
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def has_failed_before(task):
    """Three failures of its own would be the end of a task."""
    words = shlex.split(task.script)
    job, array = (pathlib.Path(words[words.index(option) + 1]) for option in ("--job", "--array"))
    try:
        tasks = json.loads((job / "attempts" / array / "array.json").read_text())["tasks"]
    except OSError:
        return False  # the array was given up
    return tasks[task.index]["attempt"] > 1


def counts_in(file):
    numbers = struct.unpack(f"{COUNTS}Q", file.read_bytes())
    return collections.Counter(dict(zip(KINDS, numbers))), numbers[-1] / 1e6


class SlurmSize(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.library = cls.base / "shared_folder.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", cls.library, HERE / "shared_folder.c"], check=True)
        cls.runs = 1000 if IS_LONG else 8
        cls.job_file = write_json(cls.base / "job.json", job_of(cls.runs))
        begun = time.monotonic()
        local = cls.base / "local"
        throng("run", cls.job_file, "-o", local, "--workers", "2")
        print(f"one machine: {time.monotonic() - begun:.1f} s", file=sys.stderr)
        cls.expected = hashes_of(local / "dataset")

    def run_on(self, cluster, out, *options):
        """`throng run` on the cluster; its calls to the shared folder, its CPU time and how long it took."""
        counts = cluster.base / "server_counts"
        environment = dict(
            cluster.environment, **SLOW, LD_PRELOAD=self.library, SHARED_ROOT=out.parent, SHARED_COUNTS=counts
        )
        command = [
            THRONG,
            "run",
            self.job_file,
            "-o",
            out,
            "--executor",
            "slurm",
            "--slurm-poll",
            str(POLL_S),
            *options,
        ]
        begun = time.monotonic()
        run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr[-3000:])
        return (*counts_in(counts), time.monotonic() - begun)

    def expect_little_was_wasted(self, cluster, out):
        """The faults that cost an attempt, and no others."""
        lost = sum(cluster.faults[kind] for kind in fake_slurm.FAULTS if kind not in ("forgotten", "launch"))
        attempts = [
            int(number)
            for log in (out / "logs").glob("*.log")
            for number in re.findall(r" begun, attempt (\d+)", log.read_text())
        ]
        tasks = 3 * self.runs + 1
        self.assertLessEqual(tasks, len(attempts))
        self.assertLessEqual(len(attempts), tasks + lost + 2)
        self.assertLessEqual(max(attempts), 3)
        # Of tasks that begin before a look shows that they wait, and of an array whose number got lost. They cost no attempt.
        # A machine that is busy looks late, and then refuses more.
        self.assertLessEqual(
            cluster.refused_starts, cluster.hasty_restarts + self.runs * cluster.faults["lost_answer"] + tasks // 4
        )
        print(f"attempts: {len(attempts)} of {tasks} tasks, {lost} were lost", file=sys.stderr)
        return len(attempts)

    def expect_few_calls(self, cluster, elapsed_s):
        """However many tasks there are: a look per poll, and at most as many calls of each other program."""
        for program, calls in cluster.calls.items():
            self.assertLessEqual(calls, elapsed_s / POLL_S + 6, program)
        arrays = 5 + 3 * self.runs / 1000  # of a job without failures, and the options' test
        self.assertLessEqual(cluster.calls["sbatch"], arrays + sum(cluster.faults.values()) + cluster.hasty_restarts)

    def expect_few_file_operations(self, server, workers, attempts, elapsed_s):
        """Per frame those that write, sync, hash and link its image and a share of previews; the others per run and
        attempt. The server looks at messages at a bounded rate."""
        frames = self.runs * FRAMES_PER_RUN
        lost = attempts - 3 * self.runs - 1
        self.assertLessEqual(workers.total(), 9 * frames + 330 * (self.runs + lost) + 200)
        self.assertLessEqual(server.total(), 45 * attempts + 30 * elapsed_s + 300)

    def run_job(self, *options, **of_cluster):
        with tempfile.TemporaryDirectory() as folder:
            base = pathlib.Path(folder)
            out = base / "shared" / "out"
            out.parent.mkdir()
            with fake_slurm.Cluster(
                base / "cluster",
                self.library,
                out.parent,
                process_environment=SLOW,
                spares=has_failed_before,
                **of_cluster,
            ) as cluster:
                server, server_cpu_s, elapsed_s = self.run_on(cluster, out, *options)
                cluster.thaw()
                workers = sum(
                    (counts_in(file)[0] for file in (base / "cluster/counts").iterdir()), collections.Counter()
                )
                self.report(cluster, server, workers, server_cpu_s, elapsed_s)
                attempts = self.expect_little_was_wasted(cluster, out)
                self.expect_few_calls(cluster, elapsed_s)
                self.expect_few_file_operations(server, workers, attempts, elapsed_s)
                self.assertEqual(set(cluster.kinds) - set(cluster.faults), set(), "faults that did not happen")
                self.expect_same_files(out)

    def expect_same_files(self, out):
        found = hashes_of(out / "dataset")
        self.assertEqual(sorted(found), sorted(self.expected))
        self.assertEqual([path for path, value in found.items() if value != self.expected[path]], [])
        self.assertFalse((out / "attempts").exists())
        self.assertEqual(list(out.rglob("*.tmp.*")), [])

    def report(self, cluster, server, workers, server_cpu_s, elapsed_s):
        frames = self.runs * FRAMES_PER_RUN
        calls = {name: f"{60 * count / elapsed_s:.0f}" for name, count in cluster.calls.items()}
        print(
            f"\n{elapsed_s:.1f} s, server {server_cpu_s:.2f} s of CPU; faults {dict(cluster.faults)}\n"
            f"calls {dict(cluster.calls)}, per minute {calls}; refused starts {cluster.refused_starts},"
            f" {cluster.hasty_restarts} of tasks that began again at once\n"
            f"workers: {workers.total()} = {workers.total() / frames:.1f} per frame: {dict(workers)}\n"
            f"server: {server.total()} = {server.total() / frames:.1f} per frame,"
            f" {server.total() / elapsed_s:.0f} per s: {dict(server)}",
            file=sys.stderr,
        )

    def test_failures(self):
        """Slurm's own repetitions, which a user may ask for, beside those of throng."""
        controller_faults = [(5, "away", 2), (8, "lost_answer", None), (12, "slow", None)]
        with concurrent.futures.ThreadPoolExecutor() as pool:
            runs = [
                pool.submit(self.run_job, fault_every=30 if IS_LONG else 2, controller_faults=controller_faults, seed=7)
            ]
            if not IS_LONG:
                requeued = ["node_fail", "preempted", "cut_off", "launch"]
                options = {"faults": requeued, "fault_every": 3, "has_accounting": False, "seed": 11}
                runs.append(pool.submit(self.run_job, "--slurm-option=--requeue", **options))
            for run in runs:
                run.result()

    def test_programs_load_nothing_from_the_shared_folder(self):
        """A worker's working folder is its job's, which others may write to."""
        with tempfile.TemporaryDirectory() as folder:
            for library in re.findall(r"(lib\S+) =>", subprocess.check_output(["ldd", THRONG], text=True)):
                (pathlib.Path(folder) / library).write_text("not a library")
            program = pathlib.Path(THRONG).resolve()
            subprocess.run([program, "--version"], cwd=folder, check=True, capture_output=True)


if __name__ == "__main__":
    unittest.main(verbosity=2)
