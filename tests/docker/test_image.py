#!/usr/bin/env python3
"""The image of docker/Dockerfile, built whole and used as its users do: without rights, with a read-only root, a tmpfs and one
folder that may be written. Needs root, buildah and debootstrap; no daemon, and nothing is pulled.

usage: test_image.py STORE    STORE: folder that keeps the base image and the layers, so that a second build is quick
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/cli")]
from free_ports import free_port  # noqa: E402
from service import wait_until  # noqa: E402

STORE = pathlib.Path(sys.argv.pop(1)).resolve()
IMAGE = "localhost/throng-test"
MAX_MB = 550
USER = 10001
# The image's file system is mounted read-only; only /data and /tmp can be written.
ISOLATED = """set -e
root="$1"; data="$2"; user="$3"; shift 3
mount --bind "$root" "$root"
for folder in proc dev; do mount --rbind /$folder "$root/$folder"; done
mount -o remount,bind,ro "$root"
mount -t tmpfs tmpfs "$root/tmp"
mount --bind "$data" "$root/data"
cd "$root"
exec chroot --userspec="$user:$user" "$root" /usr/bin/env -i -C /data PATH=/opt/throng/bin:/usr/bin:/bin "$@"
"""


def buildah(*words):
    command = ["buildah", "--root", STORE / "storage", "--runroot", STORE / "run", *words]
    environment = {**os.environ, "STORAGE_DRIVER": "overlay", "TMPDIR": str(STORE / "tmp")}
    return subprocess.run(
        [*map(str, command)], check=True, capture_output=True, text=True, env=environment
    ).stdout.strip()


class Image(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        log = STORE / "build.log"
        STORE.mkdir(parents=True, exist_ok=True)
        with log.open("w") as output:
            done = subprocess.run(
                [ROOT / "tests/docker/build_image.sh", STORE], stdout=output, stderr=subprocess.STDOUT
            )
        if done.returncode != 0:
            raise AssertionError(f"the image was not built: {log}\n{log.read_text()[-3000:]}")
        cls.container = buildah("from", "--pull-never", IMAGE)
        cls.addClassCleanup(buildah, "rm", cls.container)
        cls.root = pathlib.Path(buildah("mount", cls.container))
        cls.addClassCleanup(buildah, "umount", cls.container)
        inspected = json.loads(buildah("inspect", "--type", "image", IMAGE))
        cls.config = inspected["Docker"]["config"]
        cls.environment = [word for word in cls.config["Env"] if word.startswith("THRONG_")]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.data = pathlib.Path(folder.name)

    def command(self, *words, user=USER, environment=()):
        """The command line of a program in the image."""
        os.chown(self.data, user, user)
        return ["unshare", "--mount", "bash", "-c", ISOLATED, "bash", self.root, self.data, user, *self.environment,
                *environment, *words]  # fmt: skip

    def run_in_it(self, *words, code=0, **options):
        done = subprocess.run(
            [str(word) for word in self.command(*words, **options)], capture_output=True, text=True, timeout=600
        )
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def serve(self, **options):
        """The address of the service, as the image's CMD starts it, on a free port."""
        port = free_port()
        words = [word if word != "8080" else port for word in self.config["Cmd"]]
        self.output, self.errors = self.data / "stdout", self.data / "stderr"
        with self.output.open("w") as output, self.errors.open("w") as errors:
            self.server = subprocess.Popen(
                [str(word) for word in self.command(*words, **options)], stdout=output, stderr=errors
            )
        self.addCleanup(self.server.kill)
        address = f"http://127.0.0.1:{port}"

        def is_ready():
            if self.server.poll() is not None:
                raise AssertionError(self.errors.read_text())
            try:
                return urllib.request.urlopen(address + "/readyz", timeout=60).status == 200
            except (urllib.error.URLError, ConnectionError):
                return False

        wait_until(is_ready, what="the service in the image")
        return address

    def asked(self, address, path, key=None, body=None, kind="application/json"):
        request = urllib.request.Request(address + path, data=body)
        if key:
            request.add_header("Authorization", f"Bearer {key}")
        if body is not None:
            request.add_header("Content-Type", kind)
        with urllib.request.urlopen(request, timeout=300) as answer:
            return answer.read()

    def test_it_is_small(self):
        size_mb = (
            sum(
                file.lstat().st_blocks * 512 / max(file.lstat().st_nlink, 1)
                for file in self.root.rglob("*")
                if file.is_file() and not file.is_symlink()
            )
            / 1e6
        )
        print(f"the image takes {size_mb:.0f} MB", file=sys.stderr)
        self.assertLess(size_mb, MAX_MB)

    def test_it_says_what_it_holds(self):
        labels = self.config["Labels"]
        self.assertEqual(labels["org.opencontainers.image.licenses"], "Apache-2.0")
        self.assertEqual((self.config["User"], self.config["StopSignal"]), ("throng", "SIGTERM"))
        listed = json.loads((self.root / "usr/share/doc/throng-image/packages.spdx.json").read_text())["packages"]
        self.assertGreater(len(listed), 50)
        for package in listed:
            self.assertTrue((self.root / "usr/share/doc" / package["name"] / "copyright").is_file(), package["name"])
            self.assertIn(
                f"Version: {package['versionInfo']}\n",
                (self.root / "var/lib/dpkg/status.d" / package["name"]).read_text(),
            )
        names = {package["name"] for package in listed}
        self.assertLess({"libassimp5", "libgl1-mesa-dri", "fonts-dejavu-core"}, names)
        self.assertEqual({name for name in names if re.search(r"qt5|gdal|contrib|-dev$", name)}, set())

    def test_the_demo_runs_and_validates(self):
        job = "/opt/throng/share/throng/scenarios/city_square/demo.job.json"
        self.run_in_it("throng", "run", job, "-o", "out")
        self.assertIn("no faults", self.run_in_it("throng", "validate", "out/dataset"))
        characters = json.loads((self.data / "out/dataset/dataset.json").read_text())["statistics"][
            "distinct_characters"
        ]
        self.assertGreater(characters, 60)

    def test_a_job_on_mounted_files_with_any_user(self):
        job = {"scenario": "bridge/everyday", "capture": {"to_s": 1}, "quality": "draft"}
        (self.data / "my.job.json").write_text(json.dumps(job))
        self.run_in_it("throng", "run", "my.job.json", "-o", "out", user=23456)
        owners = {file.stat().st_uid for file in (self.data / "out").rglob("*")}
        self.assertEqual(owners, {23456})

    def test_a_study_a_plan_and_a_calibration(self):
        case = {"id": "square", "scenario": "city_square/emergency", "duration_s": 30}
        study = {"cases": [case], "policies": [{"id": "none"}], "runs": 2}
        (self.data / "a.study.json").write_text(json.dumps(study))
        self.run_in_it("throng", "study", "a.study.json", "-o", "study")
        self.run_in_it("throng", "scenario", "plan", "city_square/emergency", "-o", "plan.svg")
        self.run_in_it("throng", "calibrate", "selftest", "--views", "12", "-o", "selftest.json")
        shutil.copy(ROOT / "tests/imports/data/yard.sdf", self.data)
        shutil.copytree(ROOT / "tests/imports/data/models", self.data / "models")
        self.run_in_it("throng", "scenario", "import", "yard.sdf", "-o", "mine", "--models", "models")

    def test_the_service_from_its_first_start_to_its_end(self):
        address = self.serve()
        [key] = set(re.findall(r"throng_[a-z0-9]{8}_[a-z0-9]+", self.errors.read_text()))
        self.assertEqual(json.loads(self.asked(address, "/healthz"))["status"], "ok")
        self.assertIn(b"<title>", self.asked(address, "/"))
        job = {"scenario": "bridge/everyday", "capture": {"to_s": 2}, "quality": "draft"}
        made = json.loads(self.asked(address, "/v1/jobs", key, json.dumps(job).encode()))

        def is_done():
            state = json.loads(self.asked(address, f"/v1/jobs/{made['id']}", key))
            self.assertNotIn(state["state"], ("failed", "cancelled"), state)
            return state["state"] == "succeeded"

        wait_until(is_done, what="the job in the image")
        (self.data / "archive.tar").write_bytes(self.asked(address, f"/v1/jobs/{made['id']}/archive", key))
        self.assertIn(
            "instances.json",
            subprocess.run(["tar", "-tf", self.data / "archive.tar"], capture_output=True, text=True).stdout,
        )
        for line in self.output.read_text().splitlines():
            json.loads(line)
        self.server.send_signal(signal.SIGTERM)
        self.assertEqual(self.server.wait(60), 0)


if __name__ == "__main__":
    unittest.main()
