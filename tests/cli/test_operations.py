"""Operation of the service: backup and restore, draining, logs, keys that expire, metrics, the systemd unit.

usage: test_operations.py THRONG
"""
import json
import math
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import unittest
import urllib.error
import urllib.request

from program import ROOT, THRONG, FolderTest, printed, write_json
from service import send, start_service, wait_until

JOB = {
    "scenario": "city_square/nearest_exit",
    "quality": "draft",
    "crowd": {"agents": 20},
    "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": {"rate_hz": 1, "to_s": 2},
}
NAME = r"[a-zA-Z_:][a-zA-Z0-9_:]*"
LABEL = r'[a-zA-Z_][a-zA-Z0-9_]*="(?:[^"\\\n]|\\\\|\\"|\\n)*"'
SAMPLE = re.compile(rf"({NAME})(?:\{{({LABEL}(?:,{LABEL})*)\}})? (\S+)")


def parse_metrics(text):
    """{name: {labels: value}} of Prometheus' text format, read strictly: metadata before samples, families in one piece,
    suffixes by type, whole histograms."""
    assert text.endswith("\n")
    values, types, family = {}, {}, None
    lines = iter(text[:-1].split("\n"))
    for line in lines:
        if line.startswith("# HELP "):
            family = line.split(" ", 3)[2]
            assert family not in types, f"{family} comes twice"
            kind = re.fullmatch(rf"# TYPE {re.escape(family)} (counter|gauge|histogram)", next(lines))
            types[family] = kind[1]
            continue
        sample = SAMPLE.fullmatch(line)
        assert sample, line
        name, labels, value = sample[1], sample[2] or "", float(sample[3])
        suffixes = ("_bucket", "_sum", "_count") if types[family] == "histogram" else ("",)
        assert name in [family + suffix for suffix in suffixes], line
        assert (types[family] == "counter") == family.endswith("_total"), family
        labels = frozenset(re.findall(LABEL, labels))
        assert labels not in values.setdefault(name, {}), f"{line} comes twice"
        values[name][labels] = value
        assert not math.isnan(value) and (types[family] == "gauge" or value >= 0), line
    for name in (name for name, kind in types.items() if kind == "histogram"):
        series = {}
        for labels, value in values[name + "_bucket"].items():
            bound = next(label for label in labels if label.startswith("le="))
            series.setdefault(labels - {bound}, {})[float(bound[4:-1])] = value
        for labels, buckets in series.items():
            counts = [buckets[bound] for bound in sorted(buckets)]
            assert counts == sorted(counts) and max(buckets) == math.inf
            assert counts[-1] == values[name + "_count"][labels] and labels in values[name + "_sum"]
    return values


class Operations(FolderTest):
    def setUp(self):
        super().setUp()
        self.data = self.folder / "data"
        self.job = write_json(self.folder / "job.json", JOB)
        self.environment = dict(os.environ)

    def start(self, *options, data=None, **of_process):
        self.process, port = start_service(THRONG, data or self.data, *options, **of_process)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)
        self.url = self.environment["THRONG_URL"] = f"http://127.0.0.1:{port}"

    def end(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        self.assertEqual(self.process.wait(300), 0)

    def throng(self, *arguments, code=0):
        return printed(*arguments, env=self.environment, code=code)

    def ask(self, path, method="GET", body=None, key=None):
        """Status and body of an answer."""
        try:
            with send(self.url + path, body, method=method, key=key) as answer:
                return answer.status, answer.read().decode()
        except urllib.error.HTTPError as error:
            return error.code, error.read().decode()

    def state(self, id_):
        return json.loads(self.ask(f"/v1/jobs/{id_}")[1])["state"]

    def succeeded(self, id_):
        wait_until(lambda: self.state(id_) == "succeeded", what="the job")

    def listed(self):
        return [
            {key: job[key] for key in ("id", "name", "state")} for job in json.loads(self.ask("/v1/jobs")[1])["jobs"]
        ]

    def test_a_backup_of_a_service_that_runs_is_the_same_service(self):
        # The second job hangs until the service ends; restored, it is done.
        hanging = {**self.environment, "THRONG_FAULTS": "hang:run001/trace"}
        self.start(env=hanging)
        done = self.throng("submit", self.job, "--fetch", self.folder / "one.tar").split()[0]
        self.job.write_text(json.dumps({**JOB, "runs": 2, "name": "two"}))
        running = self.throng("submit", self.job).split()[0]
        wait_until(lambda: (self.data / "jobs" / running / "work/run000/trace.h5").exists(), what="the first run")
        self.assertIn("files", self.throng("backup", self.data, "-o", self.folder / "backup"))
        before = self.listed()
        self.assertEqual([job["state"] for job in before], ["running", "succeeded"])
        self.process.kill()
        self.process.wait(300)
        sums = subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=self.folder / "backup")
        self.assertEqual(sums.returncode, 0)
        moved = shutil.copytree(self.folder / "backup", self.folder / "moved")  # without hard links
        self.throng("restore", moved, self.folder / "restored")
        modes = {path.stat().st_mode & 0o77 for path in (self.folder / "restored").rglob("*")}
        self.assertEqual(modes, {0})
        self.start(data=self.folder / "restored")
        self.assertEqual({job["id"] for job in self.listed()}, {job["id"] for job in before})
        self.throng("fetch", done, "-o", self.folder / "again.tar")
        self.assertEqual((self.folder / "again.tar").read_bytes(), (self.folder / "one.tar").read_bytes())
        self.succeeded(running)

    def test_a_backup_that_is_broken_off_is_none(self):
        self.start()
        self.succeeded(self.throng("submit", self.job).split()[0])
        large = self.data / "jobs" / self.listed()[0]["id"] / "large"
        with large.open("wb") as file:
            file.truncate(8 << 30)
        command = [THRONG, "backup", self.data, "-o", self.folder / "backup"]
        backup = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        backup.stderr.readline()  # it has begun to copy
        backup.send_signal(signal.SIGINT)
        backup.communicate(timeout=300)
        self.assertEqual(backup.returncode, 130)
        self.assertEqual([path.name for path in self.folder.iterdir() if "backup" in path.name], [])
        large.unlink()
        self.assertIn(
            "which is there already", self.throng("backup", self.data, "-o", self.data.parent / "job.json", code=2)
        )
        self.assertIn("neither in", self.throng("backup", self.data, "-o", self.data / "jobs" / "b", code=2))
        self.assertIn("jobs.sqlite", self.throng("backup", self.folder, "-o", self.folder / "b", code=2))
        self.end()

    def test_neither_sighup_nor_sigusr1_ends_it_and_no_line_is_lost(self):
        log, rotated = self.folder / "log", self.folder / "log.1"
        self.start("--log", log, "--log-json")
        first = self.throng("submit", self.job).split()[0]
        self.succeeded(first)
        for number in (signal.SIGHUP, signal.SIGUSR1):
            log.rename(rotated)
            self.process.send_signal(number)
            wait_until(log.exists, what="the new log")
            id_ = self.throng("submit", self.job).split()[0]
            self.succeeded(id_)
            lines = [json.loads(line)["message"] for line in log.read_text().splitlines()]
            for event in ("queued", "started", "succeeded"):
                self.assertEqual(lines.count(f"job {id_} {event}"), 1)
            self.assertNotIn(f"job {id_} ", rotated.read_text())
            self.assertEqual(log.stat().st_mode & 0o777, 0o600)
        self.end()
        self.assertIn('"ending"', log.read_text())
        missing = self.folder / "no" / "log"
        self.assertIn("cannot write to", self.throng("serve", "--data", self.data, "--log", missing, code=3))

    def test_without_a_log_file_signals_do_nothing(self):
        self.start(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        for number in (signal.SIGHUP, signal.SIGUSR1):
            self.process.send_signal(number)
        self.succeeded(self.throng("submit", self.job).split()[0])
        self.end()

    def test_draining_lets_tasks_finish_and_jobs_go_on_later(self):
        # A trace takes a second: long enough to drain meanwhile.
        self.start("--workers", "1", env={**self.environment, "THRONG_FAULTS": "slow:run000/trace:1"})
        first = self.throng("submit", self.job).split()[0]
        second = self.throng("submit", self.job).split()[0]
        wait_until(lambda: self.state(first) == "running", what="the first job")
        trace = self.data / "jobs" / first / "logs/run000_trace.log"
        wait_until(trace.exists, what="the first task")
        self.throng("drain")
        self.assertEqual(self.process.wait(300), 0)
        self.assertTrue((self.data / "jobs" / first / "work/run000/trace.h5").exists(), "its task was ended")
        self.start()
        self.succeeded(first)
        self.succeeded(second)
        self.end(signal.SIGUSR2)

    def test_draining_has_a_limit(self):
        self.start("--drain-timeout", "0", env={**self.environment, "THRONG_FAULTS": "hang:run000/trace"})
        id_ = self.throng("submit", self.job).split()[0]
        wait_until((self.data / "jobs" / id_ / "logs/run000_trace.log").exists, what="the task")
        self.end(signal.SIGUSR2)

    def test_keys_expire(self):
        admin = self.throng("keys", "create", "boss", "--scope", "admin", "--data", self.data).strip()
        visitor = self.throng("keys", "create", "guest", "--expires", "2100-02-03", "--data", self.data).strip()
        self.assertRegex(self.throng("keys", "list", "--data", self.data), r"2100-02-03 +guest")
        for wrong in ("yesterday", "2001-01-01", "30", "0d"):
            message = self.throng("keys", "create", "x", "--expires=" + wrong, "--data", self.data, code=2)
            self.assertIn("--expires", message)
        self.start()
        self.assertEqual(self.ask("/v1/jobs", key=visitor)[0], 200)
        with sqlite3.connect(self.data / "keys.sqlite") as keys:
            keys.execute("UPDATE key SET expires_ms = 1000 WHERE name = 'guest'")
        status, body = self.ask("/v1/jobs", key=visitor)
        self.assertEqual((status, "this key expired at 1970-01-01" in body), (401, True), body)
        self.assertEqual(self.ask("/v1/keys", "POST", {"name": "x", "expires_at": "1h"}, admin)[0], 201)
        self.end()
        with sqlite3.connect(self.data / "keys.sqlite") as keys:
            keys.execute("PRAGMA user_version = 1000")
        self.assertRegex(self.throng("serve", "--data", self.data, "--port", "0", code=3), "version 1000; this program")

    def test_metrics(self):
        admin = self.throng("keys", "create", "boss", "--scope", "admin", "--data", self.data).strip()
        self.start("--workers", "1", "--max-active-jobs", "1", "--webhook-private")
        key = admin.split("_")[1]
        nobody = f"http://127.0.0.1:{self.url.rpartition(':')[2]}/nobody"
        self.assertEqual(self.ask("/v1/webhooks", "POST", {"url": nobody, "events": ["submitted"]}, admin)[0], 201)
        self.environment["THRONG_KEY"] = admin
        wrong = {**JOB, "crowd": {"agents": 30}, "drones": [{**JOB["drones"][0], "start": [-24, -6, 20]}]}
        done = self.throng("submit", self.job).split()[0]
        self.throng("watch", done)
        self.assertEqual(self.ask("/v1/jobs", "POST", {}, admin)[0], 400)
        self.assertEqual(self.ask("/nowhere")[0], 404)
        self.assertEqual(self.ask("/metrics")[0], 401)
        self.job.write_text(json.dumps({**wrong, "runs": 2}))
        self.throng("submit", self.job)
        wait_until(
            lambda: '{outcome="failed"} 0' not in self.ask("/metrics", key=admin)[1], what="a delivery that fails"
        )

        def metrics():
            return parse_metrics(self.ask("/metrics", key=admin)[1])

        values = metrics()
        self.assertGreaterEqual(values["throng_jobs"][frozenset(['state="succeeded"'])], 1)
        owned = [count for labels, count in values["throng_key_jobs"].items() if f'key="{key}"' in labels]
        self.assertEqual(owned, [1])
        ended = frozenset(['state="succeeded"', 'cause=""'])
        self.assertEqual(values["throng_jobs_ended_total"][ended], 1)
        shards = frozenset(['kind="shard"'])
        self.assertGreaterEqual(values["throng_task_seconds_count"][shards], 1)
        self.assertGreater(values["throng_task_seconds_sum"][shards], 0)
        requests = values["throng_http_requests_total"]
        for labels in (
            ['route="jobs"', 'method="POST"', 'status="201"'],
            ['route="jobs"', 'method="POST"', 'status="400"'],
            ['route="metrics"', 'method="GET"', 'status="401"'],
            ['route="other"', 'method="GET"', 'status="404"'],
        ):
            self.assertGreaterEqual(requests[frozenset(labels)], 1, labels)
        free, total = values["throng_disk_free_bytes"], values["throng_disk_total_bytes"]
        self.assertLess(free[frozenset()], total[frozenset()])
        self.assertGreater(values["throng_stored_bytes"][frozenset(['of="jobs"'])], 0)
        self.assertGreater(values["process_resident_memory_bytes"][frozenset()], 1 << 20)
        wait_until(
            lambda: metrics()["throng_workers_resident_memory_bytes"][frozenset()] > 8 << 20, what="a worker's memory"
        )

    def test_failures_are_counted_by_cause(self):
        self.start(env={**self.environment, "THRONG_FAULTS": "die:run000/trace:3"})
        id_ = self.throng("submit", self.job).split()[0]
        wait_until(lambda: self.state(id_) == "failed", what="the end")
        values = parse_metrics(self.ask("/metrics")[1])
        crashed = frozenset(['kind="trace"', 'outcome="crashed"'])
        self.assertEqual(values["throng_task_attempts_total"][crashed], 3)
        failed = frozenset(['state="failed"', 'cause="environment"'])
        self.assertEqual(values["throng_jobs_ended_total"][failed], 1)


class Unit(unittest.TestCase):
    unit = ROOT / "server/throng.service"

    def settings(self):
        return [line.partition("=")[::2] for line in self.unit.read_text().splitlines() if re.match(r"\w+=", line)]

    def test_it_starts_the_service_with_options_that_exist(self):
        settings = dict(self.settings())
        words = settings["ExecStart"].split()
        self.assertEqual(words[1], "serve")
        help_text = printed("serve", "--help")
        for option in (word for word in words if word.startswith("--")):
            self.assertRegex(help_text, rf"(?m)^ *{option}\b")
        drain_s = int(words[words.index("--drain-timeout") + 1])
        self.assertGreater(int(settings["TimeoutStopSec"]), drain_s)
        self.assertEqual(settings["RestartKillSignal"], "SIGUSR2")
        self.assertIn("-HUP", settings["ExecReload"])
        # Workers confine themselves by these.
        calls = {word for name, value in self.settings() if name == "SystemCallFilter" for word in value.split()}
        needed = {"seccomp", "landlock_create_ruleset", "landlock_add_rule", "landlock_restrict_self"}
        self.assertLessEqual(needed, calls)

    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd is not installed")
    def test_systemd_takes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = pathlib.Path(folder) / "throng.service"
            unit.write_text(self.unit.read_text().replace("/usr/bin/throng", THRONG))
            done = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True, timeout=300)
            self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
