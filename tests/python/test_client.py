"""The client against the real service, also through a proxy that breaks connections."""
import contextlib
import datetime
import hashlib
import io
import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
import zipfile

import common
import numpy as np
import throng
from free_ports import free_port
from service import start_service, wait_until
from throng import Client, job
from throng._download import file_name_from
from throng._events import parse
from throng._job_base import plain
from throng._progress import ProgressBar

ROLES = ("person", "disaster", "absent", "attacker")
JOB = job.Job(
    "city_square/nearest_exit",
    name="client",
    crowd=job.Crowd(agents=30),
    quality="draft",
    capture=job.Capture(rate_hz=1, from_s=1, to_s=4),
    drones=[job.Drone("d1", start=[8, -3, 15], camera=job.Camera(width=128, height=96, pitch_deg=-60, yaw_deg=90))],
    outputs=job.Outputs(formats=["yolo-detect"]),
)
PLACE = {
    "name": "Yard",
    "ground": {"min": [-20, -20], "max": [20, 20], "material": "grass"},
    "inside": {"min": [-15, -15], "max": [15, 15]},
    "exits": [{"id": "east", "from": [15, -3], "to": [15, 3]}],
    "drones": [{"id": "d1", "start": [0, 0, 20], "yaw_deg": 0}],
    "people": {"groups": [{"doing": "stroll", "box": [-8, -8, 8, 8], "count": 10}]},
}


class Proxy:
    """Passes bytes on and ends every connection after `limit` bytes of the answer, while there are `cuts` left."""

    def __init__(self, port):
        self.target, self.limit, self.cuts = port, None, 0
        self.server = socket.create_server(("127.0.0.1", 0))
        self.port = self.server.getsockname()[1]
        self.refused = 0
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                threading.Thread(target=self._serve, args=(self.server.accept()[0],), daemon=True).start()

    def _serve(self, client):
        try:
            server = socket.create_connection(("127.0.0.1", self.target))
        except OSError:
            self.refused += 1
            client.close()
            return
        with contextlib.suppress(OSError), client, server:

            def up():
                with contextlib.suppress(OSError):
                    while data := client.recv(65536):
                        server.sendall(data)

            threading.Thread(target=up, daemon=True).start()
            sent = 0
            try:
                while data := server.recv(4096):
                    if self.cuts and self.limit is not None and sent + len(data) > self.limit:
                        self.cuts -= 1
                        client.sendall(data[: self.limit - sent])
                        return
                    client.sendall(data)
                    sent += len(data)
            finally:
                # close() alone sends nothing while the other thread waits for the client: it would wait for 300 s.
                client.shutdown(socket.SHUT_RDWR)


def run(*words, **options):
    command = [common.THRONG, *words]
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8", timeout=300, **options)


class WithService(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.port = free_port()  # at which it comes back
        cls.start()
        cls.client = Client(f"http://127.0.0.1:{cls.port}", timeout_s=300, patience_s=300)
        cls.done = cls.client.watch(cls.client.submit(JOB)["id"], progress=False, timeout_s=300)
        cls.proxy = Proxy(cls.port)
        cls.shaky = Client(f"http://127.0.0.1:{cls.proxy.port}", timeout_s=300, patience_s=300)

    @classmethod
    def start(cls):
        cls.server, cls.port = start_service(common.THRONG, cls.base / "data", "--webhook-private", port=cls.port)

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait(120)

    def setUp(self):
        self.proxy.cuts = 0

    def folder(self):
        return pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(dir=self.base)))

    def test_a_finished_job(self):
        id_ = self.done["id"]
        self.assertEqual((self.done["state"], self.done["progress"]["frames_done"]), ("succeeded", 4))
        self.assertEqual([e["type"] for e in self.client.events(id_)][-1], "succeeded")
        self.assertEqual([e["type"] for e in self.client.events(id_, follow=True)][-1], "succeeded")
        self.assertIn(id_, [e["job"] for e in self.client.events()])
        self.assertEqual(next(self.client.jobs(name="clie", state="succeeded", page=1))["id"], id_)
        self.assertEqual(self.client.metrics(id_)["runs"][0]["run"], "run000")
        self.assertGreater(self.client.exits(id_).rows, 3)
        trace = throng.Trace(self.client.trace(id_, 0, self.folder() / "run.h5"))
        self.assertGreater(trace.positions.shape[1], 0)
        # Between two steps half of the way; elsewhere a step as it is.
        there = self.client.trajectories(id_, 0, from_s=1, to_s=3, every_s=0.25)
        np.testing.assert_allclose(there.time_s, np.arange(1, 3.1, 0.25))
        self.assertEqual([ROLES[role] for role in there.role], list(trace.roles))
        first = round(1 / trace.dt_s)
        for index, step in ((0, first), (2, first + 5)):
            present = trace.present[step]
            np.testing.assert_array_equal(np.isnan(there.position[index, :, 0]), ~present)
            np.testing.assert_allclose(there.position[index][present], trace.positions[step][present], atol=0.002)
            np.testing.assert_array_equal(there.state[index], trace.states[step])
            np.testing.assert_array_equal(there.flags[index] & 1, present)
        stays = trace.present[first + 2] & trace.present[first + 3]
        between = (trace.positions[first + 2] + trace.positions[first + 3]) / 2
        np.testing.assert_allclose(there.position[1][stays], between[stays], atol=0.002)
        self.assertEqual(len(self.client.trajectories(id_, 0, from_s=1000).time_s), 0)
        with self.assertRaisesRegex(throng.InvalidRequestError, "every_s"):
            self.client.trajectories(id_, 0, every_s=0)
        with self.assertRaises(throng.NotFoundError):
            self.client.trajectories(id_, 9)
        self.assertIn("alarm_s", self.client.metrics(id_, run=0))
        self.assertIn("<svg", self.client.plan(id_))
        self.assertIn("<html", self.client.report(id_).lower())
        names = [log["name"] for log in self.client.logs(id_)["logs"]]
        self.assertIsInstance(self.client.log(id_, names[0]), str)
        preview = self.client.previews(id_)["previews"][0]["name"]
        self.assertEqual(self.client.preview(id_, preview)[:2], b"\xff\xd8")
        self.assertNotEqual(self.client.preview(id_, preview), self.client.preview(id_, preview, clean=True))
        for entry in self.client.manifest(id_)["files"][:6]:
            self.assertEqual(hashlib.sha256(self.client.file(id_, entry["path"])).hexdigest(), entry["sha256"])
        self.assertEqual(self.client.change(id_, labels=["paper"], priority=3)["labels"], ["paper"])
        self.assertEqual([j["id"] for j in self.client.jobs(label="paper")], [id_])

    def test_download(self):
        folder = self.folder()
        path = self.client.download(self.done["id"], folder, progress=False)
        self.assertEqual(path.name, "client.tar")
        dataset = throng.Dataset(path)
        self.assertEqual(len(dataset), 4)
        self.assertEqual(dataset[0].image().shape, (96, 128, 3))  # hard links within the archive
        part = self.client.download(
            self.done["id"], folder / "part.zip", format="zip", include=["images", "coco"], progress=False
        )
        with zipfile.ZipFile(part) as archive:
            self.assertFalse(any("density" in name for name in archive.namelist()))
        throng.Dataset(part)[0].image()
        self.assertEqual(sorted(p.name for p in folder.iterdir()), ["client.tar", "part.zip"])

    def test_a_broken_download_goes_on(self):
        folder = self.folder()
        expected = self.client.download(self.done["id"], folder / "whole.tar", progress=False).read_bytes()
        reports = []
        self.proxy.limit, self.proxy.cuts = 100_000, 3
        path = self.shaky.download(self.done["id"], folder / "broken.tar", progress=False)
        self.assertEqual(path.read_bytes(), expected)
        self.assertEqual(self.proxy.cuts, 0)
        # A process that was killed leaves a part; what was changed meanwhile is not mixed.
        (folder / "later.tar.part").write_bytes(expected[:50_000])
        target = f"/v1/jobs/{self.done['id']}/archive"
        with self.client._http.open("GET", target) as response:
            tag = response.headers["ETag"]
        for etag, begin in ((tag, expected[:50_000]), ('"other"', b"x" * 70_000), (tag, expected)):
            (folder / "later.tar.part").write_bytes(begin)
            (folder / "later.tar.part.json").write_text(json.dumps({"etag": etag, "target": target}))
            from throng import _download

            _download.fetch(
                self.client._http, target, folder / "later.tar", lambda done, total: reports.append((done, total))
            )
            self.assertEqual((folder / "later.tar").read_bytes(), expected)
        self.assertGreater(reports[0][0], 50_000)
        self.assertEqual({total for _, total in reports}, {len(expected)})
        # A part with wrong bytes is found by its hash and removed.
        (folder / "bad.tar.part").write_bytes(b"\1" * 5000 + expected[5000:60_000])
        (folder / "bad.tar.part.json").write_text(json.dumps({"etag": tag, "target": target}))
        with self.assertRaisesRegex(throng.DatasetError, "damaged"):
            self.client.download(self.done["id"], folder / "bad.tar", progress=False)
        self.assertFalse((folder / "bad.tar").exists())
        impatient = Client(f"http://127.0.0.1:{self.proxy.port}", patience_s=0.3)
        self.proxy.limit, self.proxy.cuts = 10, 10_000
        with self.assertRaises(throng.ConnectionFailedError):
            impatient.download(self.done["id"], folder / "never.tar", progress=False)

    def test_errors_keep_pointer_found_and_expected(self):
        for call in (self.client.dry_run, self.client.submit):
            with self.assertRaises(throng.InvalidRequestError) as caught:
                call({"scenario": "city_square/nearest_exit", "runs": 0, "capture": {"rate_hz": "x"}})
            error = caught.exception
            self.assertEqual(error.status, 400)
            self.assertEqual({e.pointer for e in error.errors}, {"/runs", "/capture/rate_hz"})
            runs = next(e for e in error.errors if e.pointer == "/runs")
            self.assertEqual((runs.found, runs.expected), ("0", "an integer from 1 to 1000"))
            self.assertIn("/runs: found 0, expected an integer from 1 to 1000", str(error))
        with self.assertRaises(throng.NotFoundError):
            self.client.job("j0")
        with self.assertRaises(throng.NotFoundError):
            self.client.file(self.done["id"], "../../secret")
        with self.assertRaises(throng.ConflictError):
            self.client.retry(self.done["id"])
        with self.assertRaises(throng.ConnectionFailedError) as refused:
            Client("http://127.0.0.1:9", patience_s=0).version()
        self.assertIn("http://127.0.0.1:9", str(refused.exception))
        for url in ("127.0.0.1:8080", "ftp://x", "http://", "http://x/?a=1"):
            with self.assertRaises(ValueError):
                Client(url)
        with self.assertRaises(ValueError):
            Client(key="two\r\nlines")
        self.assertFalse(Client("http://127.0.0.1:9").is_alive())

    def test_dry_run(self):
        answer = self.client.dry_run(JOB)
        self.assertEqual((answer["valid"], answer["runs"], answer["frames"]), (True, 1, 4))
        self.assertEqual(answer["job"]["capture"]["to_s"], 4)

    def test_a_job_that_has_ended_is_cancelled_already(self):
        ended = self.client.cancel(self.done["id"])
        self.assertEqual((ended["id"], ended["state"]), (self.done["id"], "succeeded"))
        with self.assertRaises(throng.NotFoundError):
            self.client.cancel("j0")

    def test_cancel_retry_clone_remove(self):
        # Work for longer than this test, ahead of the other job: that one waits.
        slow = self.client.clone(self.done["id"], {"name": "slow", "runs": 50, "capture": {"rate_hz": 20, "to_s": 60}})
        same = self.client.submit(JOB, idempotency_key="once", priority=-5)
        self.assertEqual(self.client.submit(JOB, idempotency_key="once", priority=-5)["id"], same["id"])
        begun = time.monotonic()
        with self.assertRaises(TimeoutError):  # nothing happens to a job that waits
            self.client.watch(same["id"], progress=False, timeout_s=0.4)
        self.assertLess(time.monotonic() - begun, 30)
        self.assertEqual(self.client.cancel(same["id"])["state"], "cancelled")

        class Reported(Exception):
            pass

        def report(progress):
            raise Reported(progress["stage"])

        with self.assertRaises(Reported) as reported:
            self.client.watch(slow["id"], progress=False, timeout_s=300, callback=report)
        self.assertTrue(str(reported.exception))
        with self.assertRaises(TimeoutError):
            self.client.watch(slow["id"], progress=False, timeout_s=0.4)
        self.client.cancel(slow["id"])
        with self.assertRaisesRegex(throng.JobFailedError, "slow.*was cancelled"):
            self.client.watch(slow["id"], progress=False)
        self.assertEqual(self.client.watch(slow["id"], progress=False, check=False)["state"], "cancelled")
        self.client.retry(same["id"])
        self.assertEqual(self.client.watch(same["id"], progress=False, timeout_s=300)["state"], "succeeded")
        self.client.remove(slow["id"])
        with self.assertRaises(throng.NotFoundError):
            self.client.job(slow["id"])

    def test_watching_survives_broken_connections_and_restarts(self):
        long = self.client.clone(self.done["id"], {"name": "long", "capture": {"rate_hz": 10, "to_s": 20}})
        self.proxy.limit, self.proxy.cuts, self.proxy.refused = 900, 4, 0
        result = {}
        watcher = threading.Thread(
            target=lambda: result.update(job=self.shaky.watch(long["id"], progress=False, timeout_s=300))
        )
        watcher.start()
        wait_until(lambda: self.proxy.cuts < 4)
        self.server.kill()
        self.server.wait()
        wait_until(lambda: self.proxy.refused > 0)
        self.start()
        watcher.join(300)
        self.assertEqual(result["job"]["state"], "succeeded")
        self.assertEqual(result["job"]["attempt"], 2, "the service ended while the job ran")
        numbers = [e["seq"] for e in self.shaky.events(long["id"], follow=True)]
        self.assertEqual(numbers, [e["seq"] for e in self.client.events(long["id"])])

    def test_scenarios(self):
        folder = self.folder()
        (folder / "yard.blueprint.json").write_text(json.dumps(PLACE))
        run("scenario", "make", "yard.blueprint.json", "-o", "mine", cwd=folder)
        self.assertEqual(self.client.upload_scenario(folder / "mine", "yards", dry_run=True)["ids"], ["yards/yard"])
        self.assertEqual(self.client.upload_scenario(folder / "mine", "yards")["ids"], ["yards/yard"])
        self.assertIn("yards/yard", [s["id"] for s in self.client.scenarios()])
        self.assertEqual(self.client.scenario("yards/yard")["name"], "Yard")
        self.assertIn("<svg", self.client.scenario_plan("yards/yard"))
        with self.assertRaises(throng.ConflictError):
            self.client.upload_scenario(folder / "mine", "yards")
        blueprint = common.ROOT / "scenarios" / "city_square" / "everyday.blueprint.json"
        self.assertEqual(self.client.upload_scenario(blueprint, "square", dry_run=True)["ids"], ["square/place"])
        self.client.remove_scenario("yards")
        answer = self.client.dry_run({"scenario": "bundle/yard", "capture": {"to_s": 2}}, scenario=folder / "mine")
        self.assertEqual(answer["frames"], 3)
        with self.assertRaises(FileNotFoundError):
            self.client.submit(JOB, scenario=folder / "nowhere")

    def test_calibrations(self):
        """A board seen by a known pinhole; the service finds its focal length."""

        rng = np.random.default_rng(1)
        board = np.array([[x * 0.1, y * 0.1, 0.0] for y in range(6) for x in range(9)])
        k = np.array([[800, 0, 319.5], [0, 790, 239.5], [0, 0, 1.0]])
        rows = ["image,i,X,Y,Z,u,v"]
        for image in range(12):
            a, b = rng.uniform(-0.5, 0.5, 2)
            tilt = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]]) @ np.array(
                [[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]]
            )
            camera = throng.Camera(640, 480, k, tilt, np.array([-0.4, -0.25, 1.6]) + rng.uniform(-0.1, 0.1, 3))
            for i, (point, (u, v)) in enumerate(zip(board, camera.project(board))):
                rows.append(f"{image},{i},{point[0]},{point[1]},0,{u:.5f},{v:.5f}")
        folder = self.folder()
        (folder / "corners.csv").write_text("\n".join(rows) + "\n")
        request = {"kind": "intrinsics", "points": "corners.csv", "size": "640x480", "lens": "pinhole"}
        queued = self.client.calibrate(request, [folder / "corners.csv"])
        done = self.client.wait_for_calibration(queued["id"])
        self.assertAlmostEqual(done["camera"]["fx"], 800, places=2)
        self.assertAlmostEqual(json.loads(self.client.calibration_result(queued["id"], "camera"))["fy"], 790, places=2)
        with self.assertRaisesRegex(throng.NotFoundError, "no image of this name"):
            self.client.calibration_image(queued["id"], "board.png")
        self.assertIn(queued["id"], [c["id"] for c in self.client.calibrations()])
        self.client.remove_calibration(queued["id"])
        with self.assertRaises(throng.InvalidRequestError):
            self.client.calibrate({"kind": "magic"})

    def test_studies(self):
        study = {
            "name": "two",
            "runs": 5,
            "cases": [
                {"id": "square", "scenario": "city_square/nearest_exit", "crowd": {"agents": 10}, "duration_s": 20}
            ],
            "policies": [{"id": "none"}, {"id": "also_none"}],
        }
        self.assertEqual(self.client.check_study(study)["simulations"], 10)
        # It waits for work that is more urgent until it is followed.
        urgent = self.client.submit({**plain(JOB), "runs": 50, "capture": {"rate_hz": 20, "to_s": 60}}, priority=50)
        queued = self.client.submit_study(study)
        followed = []
        for kind, event in self.client.study_events(queued["id"], follow=True):
            if not followed:
                self.client.remove(urgent["id"])
            followed.append((kind, event))
        # Past events come first, in order.
        self.assertEqual([followed[0][0], followed[-1][0]], ["submitted", "succeeded"])
        progress = [data["runs_done"] for kind, data in followed if kind == "progress" and "runs_done" in data]
        self.assertEqual(progress, sorted(progress))
        self.assertTrue(progress)
        done = self.client.wait_for_study(queued["id"], timeout_s=300)
        self.assertEqual([row["runs"] for row in done["summary"]["rows"]], [5, 5])
        self.assertEqual(json.loads(self.client.study_file(queued["id"], "summary.json")), done["summary"])
        values = self.client.study_values(queued["id"])["cases"][0]
        self.assertEqual(values["policies"][0]["t50_s"], values["policies"][1]["t50_s"])
        self.assertIn("People out", self.client.study_report(queued["id"]))
        self.assertIn(queued["id"], [entry["id"] for entry in self.client.studies()])
        changed = self.client.change_study(queued["id"], labels=["paper"], keep=True)
        self.assertEqual((changed["labels"], changed["keep"], changed["priority"]), (["paper"], True, 0))
        self.assertEqual(
            [kind for kind, _ in self.client.study_events(queued["id"])],
            [kind for kind, _ in followed if kind != "progress"] + ["changed"],
        )
        with self.assertRaisesRegex(throng.InvalidRequestError, "priority"):
            self.client.change_study(queued["id"], priority=1000)
        self.assertEqual(self.client.cancel_study(queued["id"])["state"], "succeeded")
        with self.assertRaises(throng.ConflictError):
            self.client.retry_study(queued["id"])
        self.client.remove_study(queued["id"])
        with self.assertRaises(throng.NotFoundError):
            self.client.study(queued["id"])
        with self.assertRaisesRegex(throng.InvalidRequestError, "cases"):
            self.client.submit_study({"cases": []})

    def test_the_service_itself(self):
        self.assertEqual(
            self.client.version(),
            run("--version").stdout.split()[-1],
        )
        self.assertTrue(self.client.is_alive() and self.client.is_ready())
        self.assertIn("paths", self.client.openapi())
        self.assertIn("throng_", self.client.prometheus())
        self.assertIn("properties", self.client.schema())
        for catalogue, key in (
            ("people", "people"),
            ("airframes", "airframes"),
            ("policies", "policies"),
            ("formats", "formats"),
        ):
            self.assertTrue(getattr(self.client, catalogue)()[key])

    def test_webhooks(self):
        hook = self.client.create_webhook("http://127.0.0.1:9/hook", ["succeeded"])
        self.assertIn("secret", hook)
        self.assertEqual([h["id"] for h in self.client.webhooks()], [hook["id"]])
        self.assertFalse(self.client.enable_webhook(hook["id"], False)["enabled"])
        self.assertFalse(self.client.ping_webhook(hook["id"])["succeeded"])
        self.assertEqual(self.client.webhook(hook["id"])["url"], "http://127.0.0.1:9/hook")
        self.assertIsInstance(self.client.webhook_deliveries(hook["id"])["deliveries"], list)
        self.client.remove_webhook(hook["id"])

    def test_z_keys(self):
        """Last: from the first key on everybody needs one."""
        self.client.change(self.done["id"], labels=["shared"])  # for keys that may only read
        made = run("keys", "create", "reader", "--scope", "read", "--data", self.base / "data")
        key = next(word for word in (made.stdout + made.stderr).split() if word.startswith("throng_"))
        with self.assertRaises(throng.AccessError) as nobody:
            self.client.job(self.done["id"])
        self.assertEqual(nobody.exception.status, 401)
        reader = Client(self.client._http.url, key)
        self.assertEqual(reader.job(self.done["id"])["id"], self.done["id"])
        self.assertFalse(reader.may_submit())
        with self.assertRaises(throng.AccessError) as readers:
            reader.submit(JOB)
        self.assertEqual(readers.exception.status, 403)
        self.assertNotIn(key, repr(reader))
        made = run("keys", "create", "admin", "--scope", "admin", "--data", self.base / "data")
        admin = Client(self.client._http.url, made.stdout.strip())
        self.assertTrue(admin.may_submit())
        never = datetime.datetime(2100, 2, 3, tzinfo=datetime.timezone.utc)
        friend = admin.create_key("friend", "read", max_jobs=2, expires_at=never)
        self.assertEqual(friend["expires_at"], "2100-02-03T00:00:00.000Z")
        self.assertEqual(Client(self.client._http.url, friend["key"]).job(self.done["id"])["id"], self.done["id"])
        self.assertEqual([entry["name"] for entry in admin.keys()], ["reader", "admin", "friend"])
        admin.revoke_key(friend["id"])
        with self.assertRaises(throng.AccessError):
            Client(self.client._http.url, friend["key"]).job(self.done["id"])


class Parts(unittest.TestCase):
    def test_server_sent_events(self):
        stream = io.BytesIO(
            b': comment\n\nid: 7\nevent: stage\ndata: {"a":\ndata: 1}\n\r\nevent: progress\ndata: {}\n\ndata: cut'
        )
        self.assertEqual(list(parse(stream)), [(7, "stage", '{"a":\n1}'), (None, "progress", "{}")])

    def test_proposed_names_stay_in_the_folder(self):
        for proposed, name in (
            ("a.tar", "a.tar"),
            ("../../a.tar", "a.tar"),
            ("..\\a.tar", "a.tar"),
            ("..", "x"),
            ("/", "x"),
            (".bashrc", "x"),
            ("", "x"),
        ):
            self.assertEqual(file_name_from({"Content-Disposition": f'attachment; filename="{proposed}"'}, "x"), name)

    def test_the_bar_of_a_notebook(self):
        shown = []

        class Handle:
            def update(self, markup):
                shown.append(markup)

        def display(markup, display_id):
            shown.append(markup)
            return Handle()

        shell = type("ZMQInteractiveShell", (), {})()
        modules = {
            "IPython": types.SimpleNamespace(get_ipython=lambda: shell),
            "IPython.display": types.SimpleNamespace(HTML=str, display=display),
        }
        with unittest.mock.patch.dict(sys.modules, modules):
            bar = ProgressBar("<set>")
            bar.update(0.25, "1 of 4 frames")
            bar.update(1, "4 of 4 frames")
            bar.close()
        self.assertEqual(len(shown), 2)
        self.assertIn("value='0.2500'", shown[0])
        self.assertIn("&lt;set&gt;", shown[1])

    def test_the_bar(self):
        class Terminal(io.StringIO):
            def isatty(self):
                return True

        terminal, log = Terminal(), io.StringIO()
        for stream in (terminal, log):
            bar = ProgressBar("set", stream)
            bar.update(0.0, "waiting", "waiting")
            bar.update(0.5, "12 of 24 frames", "rendering")
            bar.update(1.0, "24 of 24 frames", "rendering")
            bar.close()
        self.assertIn("\rset [############............]  50 % 12 of 24 frames", terminal.getvalue())
        self.assertEqual(log.getvalue(), "set: waiting\nset: rendering\n")


if __name__ == "__main__":
    common.main()
