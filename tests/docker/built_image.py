"""The image of docker/Dockerfile, built whole, and its programs run as a container would: without rights, with a read-only
root, a tmpfs and one folder that may be written. Needs root, buildah and debootstrap; no daemon, and nothing is pulled."""
import json
import os
import pathlib
import re
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
USER = 10001
# The image's file system is mounted read-only; only /data and /tmp can be written.
CONTAINER = """set -e
root="$1"; data="$2"; shift 2
mount --bind "$root" "$root"
for folder in proc dev; do mount --rbind /$folder "$root/$folder"; done
mount -o remount,bind,ro "$root"
mount -t tmpfs -o size=1g tmpfs "$root/tmp"
mount --bind "$data" "$root/data"
cd "$root"
exec chroot "$root" "$@"
"""
WITHOUT_RIGHTS = ("--clear-groups", "--bounding-set=-all", "--inh-caps=-all", "--no-new-privs")


def buildah(*words):
    command = ["buildah", "--root", STORE / "storage", "--runroot", STORE / "run", *words]
    environment = {**os.environ, "STORAGE_DRIVER": "overlay", "TMPDIR": str(STORE / "tmp")}
    return subprocess.run(
        [*map(str, command)], check=True, capture_output=True, text=True, env=environment
    ).stdout.strip()


def build_image():
    """Builds it; quick where all layers are there already."""
    log = STORE / "build.log"
    STORE.mkdir(parents=True, exist_ok=True)
    with log.open("w") as output:
        done = subprocess.run([ROOT / "tests/docker/build_image.sh", STORE], stdout=output, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise AssertionError(f"the image was not built: {log}\n{log.read_text()[-3000:]}")


class ImageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build_image()
        cls.container = buildah("from", "--pull-never", IMAGE)
        cls.addClassCleanup(buildah, "rm", cls.container)
        cls.root = pathlib.Path(buildah("mount", cls.container))
        cls.addClassCleanup(buildah, "umount", cls.container)
        inspected = json.loads(buildah("inspect", "--type", "image", IMAGE))
        cls.config = inspected["Docker"]["config"]
        cls.environment = cls.config["Env"]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.data = pathlib.Path(folder.name)

    def command(self, *words, user=USER, limits=()):
        """The command line of a program in the image; limits are options of prlimit."""
        os.chown(self.data, user, user)
        of_user = ["setpriv", f"--reuid={user}", f"--regid={user}", *WITHOUT_RIGHTS]
        words = [*of_user, "prlimit", *limits, "env", "-i", "-C", "/data", *self.environment, *words]
        return [
            str(word) for word in ["unshare", "--mount", "bash", "-c", CONTAINER, "bash", self.root, self.data, *words]
        ]

    def run_in_it(self, *words, code=0, **options):
        done = subprocess.run(self.command(*words, **options), capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def serve(self, **options):
        """Starts the service as the image's CMD does, on a free port; its address."""
        self.port = free_port()
        words = [word if word != "8080" else self.port for word in self.config["Cmd"]]
        self.output, self.errors = self.data / "stdout", self.data / "stderr"
        with self.output.open("w") as output, self.errors.open("w") as errors:
            self.server = subprocess.Popen(self.command(*words, **options), stdout=output, stderr=errors)
        self.addCleanup(self.server.kill)
        self.address = f"http://127.0.0.1:{self.port}"

        def is_ready():
            if self.server.poll() is not None:
                raise AssertionError(self.errors.read_text())
            try:
                return urllib.request.urlopen(self.address + "/readyz", timeout=60).status == 200
            except (urllib.error.URLError, ConnectionError):
                return False

        wait_until(is_ready, what="the service in the image")

    def first_key(self):
        """The key that the first start printed."""
        [key] = set(re.findall(r"throng_[a-z0-9]{8}_[a-z0-9]+", self.errors.read_text()))
        return key

    def end_service(self):
        self.server.send_signal(signal.SIGTERM)
        self.assertEqual(self.server.wait(60), 0)

    def asked(self, path, key=None, body=None, kind="application/json", context=None):
        """The service's answer to GET, or to POST of a body: bytes, or a JSON value."""
        body = json.dumps(body).encode() if isinstance(body, dict) else body
        request = urllib.request.Request(self.address + path, data=body)
        if key:
            request.add_header("Authorization", f"Bearer {key}")
        if body is not None:
            request.add_header("Content-Type", kind)
        with urllib.request.urlopen(request, timeout=300, context=context) as answer:
            content = answer.read()
            return json.loads(content) if answer.headers.get_content_type() == "application/json" else content

    def finished(self, path, key, context=None):
        """The state of a job, calibration or study that has succeeded."""
        state = {}

        def is_done():
            state.update(self.asked(path, key, context=context))
            self.assertNotIn(state["state"], ("failed", "cancelled"), state)
            return state["state"] == "succeeded"

        wait_until(is_done, what=path)
        return state
