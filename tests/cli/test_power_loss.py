"""Power failures: what the service has answered with 200 or 201 is there afterwards, although every byte and every name
that was not synced is lost. A preloaded library (synced_files.c) logs what was synced; from that an image of the data
folder is made as the strictest file system that POSIX allows would leave it, and a new server is started on it.

usage: test_power_loss.py THRONG [unittest's arguments]
"""
import contextlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import zipfile

import test_crash as crash
from program import FolderTest, throng
from service import ask, send

HERE = pathlib.Path(__file__).resolve().parent

# Appends to a file from two threads and asks of the copy, each time, whether it has what was synced.
APPENDS = """
import os, pathlib, sys, threading
path, copies = sys.argv[1], pathlib.Path(sys.argv[2])

def append():
    file = os.open(path, os.O_RDWR | os.O_APPEND)
    for _ in range(50):
        os.write(file, b"x" * 100)
        end = os.lseek(file, 0, os.SEEK_CUR)
        os.fsync(file)
        [copy] = [entry for entry in copies.iterdir() if entry.suffix != ".part"]
        if copy.stat().st_size < end:
            os._exit(3)

threads = [threading.Thread(target=append) for _ in range(2)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
"""


def below(pid):
    """A process and all that it has started, and they have."""
    return [pid] + [process for child, _ in crash.children_of(pid) for process in below(child)]


def runs(pid):
    """Whether a thread of the process still does something: it stops only after the system call that it is in."""
    for stat in pathlib.Path(f"/proc/{pid}/task").glob("*/stat"):
        with contextlib.suppress(OSError):
            if stat.read_text().rpartition(")")[2].split()[0] not in "TZX":
                return True
    return False


def stop_all(pid):
    """Stops a process and all below it; returns when nothing of them runs."""
    stopped = set()
    while begun := set(below(pid)) - stopped:
        for process in begun:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, crash.signal.SIGSTOP)
        crash.wait_until(lambda: not any(map(runs, begun)), what="processes to stop")
        stopped |= begun


def ids_below(folder):
    """Paths of all files by inode; folders and links by themselves."""
    found = {}
    for root, folders, files in os.walk(folder):
        for name in folders + files:
            path = pathlib.Path(root) / name
            found.setdefault(path.lstat().st_ino, path)
    return found


class Disk:
    """A folder whose syncs are logged."""

    def __init__(self, base):
        self.base = base
        self.root = base / "disk"
        self.copies = base / "copies"
        self.log = base / "synced.log"
        self.root.mkdir()
        self.copies.mkdir()
        library = base / "synced_files.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, HERE / "synced_files.c"], check=True)
        self.environment = {"LD_PRELOAD": str(library), "SYNCED_LOG": str(self.log), "SYNCED_COPIES": str(self.copies)}

    def image_after_power_loss(self, target):
        """Copies what is left of the folder. Returns the paths of files and folders that are not what they were."""
        folders, files = {}, {}
        for line in self.log.read_bytes().decode().splitlines():
            kind, ident, *rest = line.split("\t")
            if kind == "folder":
                folders[ident] = [entry.rsplit("/", 2) for entry in rest]
            else:
                files[ident] = rest
        paths = ids_below(self.root)
        lost = []

        def copy(ident, kind, place):
            now = paths.get(int(ident.split("-")[0]))
            if kind == "l":
                place.symlink_to(os.readlink(now)) if now else lost.append(str(place))
            elif kind == "d":
                place.mkdir()
                if ident not in folders:
                    lost.append(f"{place}/*")
                for name, child, of_kind in folders.get(ident, []):
                    copy(child, of_kind, place / name)
            elif (self.copies / ident).exists():
                shutil.copyfile(self.copies / ident, place)
            else:
                status = now.stat() if now else None
                state = (
                    [str(status.st_size), f"{status.st_mtime_ns // 10**9}.{status.st_mtime_ns % 10**9:09}"]
                    if now
                    else []
                )
                if state and files.get(ident) == state:
                    shutil.copyfile(now, place)
                else:
                    place.write_bytes(b"")
                    lost.append(str(place))

        roots = [ident for ident in folders if int(ident.split("-")[0]) == self.root.stat().st_ino]
        if not roots:
            raise AssertionError("the name of the data folder itself was never synced: all is lost")
        copy(roots[0], "d", target)
        return [path.removeprefix(str(target)) for path in lost]


class PowerLoss(FolderTest):
    def setUp(self):
        super().setUp()
        self.disk = Disk(self.folder)

    def start(self, faults=None):
        os.environ.update(self.disk.environment)
        self.server = crash.Server(self.folder, self.disk.root / "data")
        self.server.start(faults)
        for name in self.disk.environment:
            del os.environ[name]
        self.addCleanup(lambda: self.server.stop())

    def lose_power(self):
        """The server's successor, on what is left."""
        stop_all(self.server.process.pid)  # nothing is written while the image is made
        image = self.folder / "image"
        try:
            lost = self.disk.image_after_power_loss(image)
        finally:
            self.server.kill()
            self.server.stop()
        after = crash.Server(self.folder, image / "data")
        after.start()
        self.addCleanup(after.stop)
        return after, lost

    def test_a_copy_is_whole_and_has_all_that_was_synced(self):
        file = self.disk.root / "x.sqlite"
        file.write_bytes(b"x" * 4_000_000)
        command = [sys.executable, "-c", APPENDS, file, self.disk.copies]
        environment = {**os.environ, **self.disk.environment}
        writers = [subprocess.Popen(command, env=environment) for _ in range(2)]
        sizes = [0]
        while any(writer.poll() is None for writer in writers):
            sizes += [path.stat().st_size for path in self.disk.copies.iterdir() if path.suffix != ".part"]
        self.assertEqual([writer.returncode for writer in writers], [0, 0])
        self.assertEqual(sizes, sorted(sizes), "the copy was whole at any time, and never an older one")
        self.assertEqual(sizes[-1], file.stat().st_size)

    def test_a_finished_dataset_is_there_afterwards(self):
        self.start()
        job = self.server.request("POST", "/v1/jobs", crash.JOB)["id"]
        self.assertEqual(self.server.wait_for_end(job)["state"], "succeeded")
        before = self.server.hash_of(job)
        after, lost = self.lose_power()
        self.assertEqual([path for path in lost if f"jobs/{job}/dataset" in path], [])
        self.assertEqual(after.state(job), "succeeded")
        self.assertEqual(after.hash_of(job), before)
        throng("validate", after.data / "jobs" / job / "dataset")

    def test_a_job_goes_on_where_it_was(self):
        # The job cannot end before the power does.
        self.start("slow:run001/shard0000:3600")
        job = self.server.request("POST", "/v1/jobs", crash.JOB)["id"]
        crash.wait_until(lambda: list(self.server.data.glob(f"jobs/{job}/work/run*/shard*[0-9]")), what="a shard")
        after, _ = self.lose_power()
        traces = [path.name for path in after.data.glob(f"jobs/{job}/work/run*/trace.h5")]
        self.assertEqual(len(traces), 2, "published output is lost")
        end = after.wait_for_end(job)
        self.assertEqual(end["state"], "succeeded", end["error"])
        undisturbed = crash.Server(self.folder, self.folder / "undisturbed")
        undisturbed.start()
        self.addCleanup(undisturbed.stop)
        again = undisturbed.request("POST", "/v1/jobs", crash.JOB)["id"]
        undisturbed.wait_for_end(again)
        self.assertEqual(after.hash_of(job), undisturbed.hash_of(again))

    def test_what_was_accepted_is_there_afterwards(self):
        self.start()
        bundle = io.BytesIO()
        with zipfile.ZipFile(bundle, "w") as archive:
            for path in sorted((HERE.parents[1] / "scenarios" / "city_square").rglob("*")):
                if path.is_file():
                    archive.write(path, path.relative_to(HERE.parents[1] / "scenarios" / "city_square"))
        url = self.server.url + "/v1/scenarios?name=mine"
        with send(url, bundle.getvalue(), kind="application/zip") as answer:
            self.assertEqual(answer.status, 201)
        hook = self.server.request("POST", "/v1/webhooks", {"url": "https://example.org/hook"})
        slow = dict(crash.JOB, runs=20)
        first = self.server.request("POST", "/v1/jobs", slow)["id"]
        queued = [self.server.request("POST", "/v1/jobs", slow)["id"] for _ in range(5)]
        self.server.request("PATCH", f"/v1/jobs/{queued[0]}", {"labels": ["paper"]})
        self.server.request("POST", f"/v1/jobs/{queued[1]}/cancel")
        self.server.request("DELETE", f"/v1/jobs/{queued[2]}")
        after, _ = self.lose_power()
        jobs = {job["id"]: job for job in after.request("GET", "/v1/jobs")["jobs"]}
        self.assertEqual(set(jobs), {first, *queued} - {queued[2]})
        self.assertEqual(jobs[queued[0]]["labels"], ["paper"])
        self.assertEqual(jobs[queued[1]]["state"], "cancelled")
        self.assertEqual([h["id"] for h in after.request("GET", "/v1/webhooks")["webhooks"]], [hook["id"]])
        scenarios = json.dumps(after.request("GET", "/v1/scenarios"))
        self.assertIn("mine/", scenarios)
        job = dict(crash.JOB, scenario="mine/nearest_exit")
        self.assertTrue(ask(after.url + "/v1/jobs?dry_run", job)["valid"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
