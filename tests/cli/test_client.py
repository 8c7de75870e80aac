"""The command line's clients of the HTTP API against the real server, and keys."""
import hashlib
import json
import os
import pathlib
import subprocess
import tarfile
import unittest
import zipfile

from free_ports import free_port
from program import THRONG, FolderTest, printed, write_json
from service import start_service, wait_until


JOB = {
    "name": "client",
    "scenario": "city_square/nearest_exit",
    "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": {"rate_hz": 1, "from_s": 1, "to_s": 4},
}


class Client(FolderTest):
    def setUp(self):
        super().setUp()
        self.job = write_json(self.folder / "job.json", JOB)
        self.environment = dict(os.environ)
        self.port = free_port()  # at which it comes back
        self.start()
        self.addCleanup(self.stop)

    def start(self):
        self.server, self.port = start_service(THRONG, self.folder / "data", port=self.port)
        self.environment["THRONG_URL"] = f"http://127.0.0.1:{self.port}"

    def stop(self):
        self.server.terminate()
        self.server.wait(300)

    def throng(self, *arguments, code=0):
        return printed(*arguments, env=self.environment, code=code)

    def test_submit_watch_and_fetch(self):
        self.assertRegex(self.throng("submit", self.job, "--dry-run"), r"valid[^$]*, 1 run\n *light [^\n]*\n *images ")
        archive = self.folder / "out.tar"
        id_ = self.throng("submit", self.job, "--label", "a b", "--key", "k", "--fetch", archive).split()[0]
        with tarfile.open(archive) as tar:
            names = tar.getnames()
        self.assertTrue(any(name.endswith("annotations/instances.json") for name in names), names)
        self.assertEqual(self.throng("submit", self.job, "--label", "a b", "--key", "k").strip(), id_)
        self.assertIn(id_, self.throng("jobs", "--label", "a b", "--state", "succeeded"))
        self.assertNotIn(id_, self.throng("jobs", "--label", "other"))
        self.assertIn("run000_trace.log", self.throng("logs", id_))
        self.throng("logs", id_, "run000_trace.log")
        self.assertEqual(self.throng("watch", id_), "")
        # A download that broke off goes on, and one of another file starts again.
        whole = archive.read_bytes()
        again = self.folder / "again.tar"
        self.throng("fetch", id_, "-o", again)
        self.assertEqual(again.read_bytes(), whole)
        again.write_text("mine")
        self.assertIn("again.tar, which is there already", self.throng("fetch", id_, "-o", again, code=2))
        self.assertEqual(again.read_text(), "mine")
        self.throng("fetch", id_, "-o", again, "--force")
        self.assertEqual(again.read_bytes(), whole)
        self.assertIn("whose folder does not exist", self.throng("fetch", id_, "-o", self.folder / "no/x.tar", code=2))
        self.assertIn("--fetch: found", self.throng("submit", self.job, "--fetch", archive, code=2))
        part = self.folder / "again.tar.part"
        tag = self.folder / "again.tar.part.etag"
        manifest = [name for name in names if name.endswith("/manifest.json")][0]
        with tarfile.open(archive) as tar:
            etag = '"' + hashlib.sha256(tar.extractfile(manifest).read()).hexdigest() + '"'
        for tag_text, begin in ((etag, whole[:5000]), ('"other"', b"x" * 5000), (etag, whole)):
            again.unlink()
            part.write_bytes(begin)
            tag.write_text(tag_text)
            self.throng("fetch", id_, "-o", again)
            self.assertEqual(again.read_bytes(), whole)
            self.assertFalse(part.exists() or tag.exists())
        zipped = self.folder / "part.zip"
        self.throng("fetch", id_, "-o", zipped, "--zip", "--include", "images,coco", "--runs", "0")
        with zipfile.ZipFile(zipped) as part_zip:
            self.assertIsNone(part_zip.testzip())
            tops = {name.split("/")[1] for name in part_zip.namelist()}
        self.assertEqual(tops, {"images", "annotations", "manifest.json"})
        self.assertIn("?runs", self.throng("fetch", id_, "-o", zipped, "--force", "--runs", "7", code=2))
        trace = self.folder / "run.h5"
        self.throng("fetch", id_, "--trace", "0", "-o", trace)
        self.assertIn("people", json.loads(self.throng("metrics", trace)))
        self.assertIn("no run 7", self.throng("fetch", id_, "--trace", "7", "--force", "-o", trace, code=2))
        self.throng("remove", id_)
        self.assertIn(id_, self.throng("watch", id_, code=2))

    def test_studies_survive_a_kill_of_the_server(self):
        study = {
            "name": "killed",
            "runs": 20,
            "cases": [
                {"id": "square", "scenario": "city_square/nearest_exit", "crowd": {"agents": 20}, "duration_s": 20}
            ],
            "policies": [{"id": "none"}, {"id": "same"}],
        }
        file = write_json(self.folder / "study.json", study)
        self.assertIn("40 simulations", self.throng("studies", "submit", file, "--dry-run"))
        self.assertIn("expected a study; a job is for `throng run`", self.throng("studies", "submit", self.job, code=2))
        id_ = self.throng("studies", "submit", file).strip()
        runs = self.folder / "data" / "studies" / id_ / "runs"
        wait_until(lambda: len(list(runs.glob("*/*/*.json"))) >= 5)
        self.server.kill()
        self.server.wait(300)
        finished = {path: path.stat().st_mtime_ns for path in runs.glob("*/*/*.json")}
        self.assertLess(len(finished), 40)
        self.start()
        self.throng("studies", "watch", id_)
        self.assertEqual({path: path.stat().st_mtime_ns for path in finished}, finished)
        self.assertRegex(self.throng("studies", "list"), rf"{id_} +succeeded +100%")
        self.throng("studies", "fetch", id_, "-o", self.folder / "fetched")
        self.throng("study", file, "-o", self.folder / "here")
        for name in ("summary.json", "summary.csv", "summary.md", "values.json", "report.html"):
            self.assertEqual(
                (self.folder / "fetched" / name).read_bytes(), (self.folder / "here" / name).read_bytes(), name
            )
        self.throng("studies", "cancel", id_)  # it has ended: nothing is left to cancel
        self.assertRegex(self.throng("studies", "list"), rf"{id_} +succeeded")
        self.throng("studies", "retry", id_, code=2)
        self.assertIn(id_, self.throng("studies", "watch", id_[:-1], code=2))
        self.throng("studies", "remove", id_)
        self.assertNotIn(id_, self.throng("studies", "list"))

    def test_scenarios_of_ones_own(self):
        place = pathlib.Path(__file__).resolve().parents[2] / "scenarios" / "city_square"
        ids = self.throng("scenarios", "upload", place, "--name", "mine").split()
        self.assertIn("mine/nearest_exit", ids)
        self.assertIn("name", self.throng("scenarios", "upload", place, "--name", "mine", code=2))
        self.throng("scenarios", "remove", "mine")
        self.throng("scenarios", "remove", "mine", code=2)
        self.assertIn("no scenario", self.throng("scenarios", "upload", place.parent.parent / "docs", code=2))
        # A worker finds the scenario that came with its job.
        self.job.write_text(json.dumps({**JOB, "scenario": "bundle/nearest_exit"}))
        id_ = self.throng("submit", self.job, "--scenario", place, "--watch").split()[0]
        bundles = self.folder / "data" / "uploads"
        self.assertEqual(len(list(bundles.iterdir())), 1)
        self.throng("remove", id_)
        self.assertEqual(list(bundles.iterdir()), [])

    def test_mistakes_and_missing_servers_have_their_exit_codes(self):
        self.job.write_text(json.dumps({**JOB, "runs": 0}))
        self.assertIn("/runs", self.throng("submit", self.job, code=2))
        self.assertIn("no such file", self.throng("submit", self.folder / "none.json", code=2))
        self.assertIn("jnosuchjob000000", self.throng("cancel", "jnosuchjob000000", code=2))
        self.environment["THRONG_URL"] = "127.0.0.1"
        self.assertIn("THRONG_URL", self.throng("jobs", code=2))
        self.environment["THRONG_URL"] = "http://127.0.0.1:9"
        self.assertIn("cannot reach", self.throng("jobs", code=3))

    def test_report_of_a_job(self):
        self.job.write_text(json.dumps({**JOB, "scenario": {"generate": {"kind": "plaza", "seed": 5}}}))
        id_ = self.throng("submit", self.job, "--watch").split()[0]
        pages = [self.folder / "of_server.html", self.folder / "of_folder.html"]
        self.throng("report", id_, "-o", pages[0])
        self.throng("report", self.folder / "data" / "jobs" / id_, "-o", pages[1])
        self.assertTrue("Generated plaza 5" in pages[0].read_text())
        self.assertTrue(pages[0].read_bytes() == pages[1].read_bytes())
        self.throng("remove", id_)
        self.throng("report", id_, "-o", pages[0], code=2)

    def test_cancel_and_retry(self):
        self.job.write_text(json.dumps({**JOB, "runs": 200}))  # for longer than this test
        id_ = self.throng("submit", self.job).strip()
        wait_until(lambda: "running" in self.throng("jobs"))
        self.throng("cancel", id_)
        self.assertIn("cancelled", self.throng("jobs"))
        workers = subprocess.run(["pgrep", "-f", f"throng worker.*{id_}"], capture_output=True, text=True)
        self.assertEqual(workers.stdout, "", "nobody works on it any more")
        self.throng("cancel", id_)  # as it is already
        self.throng("watch", id_, code=130)
        self.throng("retry", id_)
        wait_until(lambda: "running" in self.throng("jobs"))
        self.throng("remove", id_)

    def test_watch_goes_on_when_the_server_is_restarted(self):
        self.job.write_text(json.dumps({**JOB, "runs": 3}))
        id_ = self.throng("submit", self.job).strip()
        watcher = subprocess.Popen([THRONG, "watch", id_], env=self.environment, stderr=subprocess.DEVNULL)
        self.addCleanup(watcher.kill)
        wait_until(lambda: "running" in self.throng("jobs"))
        self.server.kill()
        self.server.wait()
        self.start()
        self.assertEqual(watcher.wait(300), 0)

    def test_keys(self):
        data = self.folder / "data"
        key = self.throng("keys", "create", "alice", "--scope", "read", "--data", data).strip()
        self.assertIn("needs a key", self.throng("jobs", code=2))
        self.environment["THRONG_KEY"] = key
        self.throng("jobs")
        self.assertIn("scope", self.throng("submit", self.job, code=2))
        listed = self.throng("keys", "list", "--data", data)
        self.assertIn("alice", listed)
        self.assertNotIn(key, listed)
        self.throng("keys", "revoke", key.split("_")[1], "--data", data)
        self.assertIn("revoked", self.throng("jobs", code=2))
        self.throng("keys", "revoke", "nobody00", "--data", data, code=2)


if __name__ == "__main__":
    unittest.main()
