#!/usr/bin/env python3
"""docker/compose.yaml without Docker: the service of the image and nginx as processes with the file's settings.

usage: test_compose.py STORE    STORE: as test_image.py's
"""
import pathlib
import ssl
import subprocess
import sys
import tempfile
import unittest

import yaml
from built_image import ROOT, ImageTest
from free_ports import free_ports
from service import wait_until

# Nothing may be written but /tmp; the configuration is the mounted one.
READ_ONLY = """set -e
size="$1"; shift
mount --bind / /
mount -o remount,bind,ro /
mount -t tmpfs -o "size=$size" tmpfs /tmp
exec "$@"
"""


def tmpfs_size(service):
    [mount] = service["tmpfs"]
    folder, options = mount.split(":")
    assert folder == "/tmp" and options.startswith("size="), mount
    return options.removeprefix("size=")


class Compose(ImageTest):
    def setUp(self):
        super().setUp()
        self.services = yaml.safe_load((ROOT / "docker/compose.yaml").read_text())["services"]
        folder = tempfile.TemporaryDirectory(dir="/var/tmp")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start_throng(self):
        settings = self.services["throng"]
        # ImageTest.command() gives these to every program in the image.
        self.assertTrue(settings["read_only"])
        self.assertEqual(settings["cap_drop"], ["ALL"])
        self.assertEqual(settings["security_opt"], ["no-new-privileges:true"])
        self.assertEqual(tmpfs_size(settings), "1g")
        self.assertEqual(settings["volumes"], ["throng-data:/data"])
        files = settings["ulimits"]["nofile"]
        self.serve(limits=[f"--nofile={files['soft']}:{files['hard']}", f"--core={settings['ulimits']['core']}"])

    def start_nginx(self):
        """nginx with docker/nginx.conf, with its ports, the service's address and the certificate's folder replaced."""
        settings = self.services["nginx"]
        self.assertTrue(settings["read_only"])
        self.assertEqual(settings["cap_drop"], ["ALL"])
        tls = self.folder / "tls"
        subprocess.run([ROOT / "docker/make_certificate.sh", tls, "localhost"], check=True, stdout=subprocess.DEVNULL)
        port, plain_port = free_ports(2)
        text = (ROOT / "docker/nginx.conf").read_text()
        for before, after in (
            ("listen 8080;", f"listen 127.0.0.1:{plain_port};"),
            ("listen 8443 ssl", f"listen 127.0.0.1:{port} ssl"),
            ("server throng:8080", f"server 127.0.0.1:{self.port}"),
            ("/etc/throng-tls", str(tls)),
        ):
            self.assertIn(before, text)
            text = text.replace(before, after)
        (self.folder / "nginx.conf").write_text(text)
        rights = ",".join(["-all", *("+" + right.lower() for right in settings["cap_add"])])
        words = ["unshare", "--mount", "bash", "-c", READ_ONLY, "bash", tmpfs_size(settings),
                 "setpriv", f"--bounding-set={rights}", "--inh-caps=-all", "--no-new-privs",
                 "/usr/sbin/nginx", "-c", self.folder / "nginx.conf", "-g", "daemon off;"]  # fmt: skip
        self.nginx_errors = self.folder / "errors"
        with self.nginx_errors.open("w") as errors, (self.folder / "log").open("w") as log:
            self.nginx = subprocess.Popen([str(word) for word in words], stdout=log, stderr=errors)
        self.addCleanup(self.nginx.kill)
        self.address = f"https://localhost:{port}"
        return ssl.create_default_context(cafile=tls / "tls.crt")

    def test_a_job_through_nginx(self):
        self.start_throng()
        key = self.first_key()
        context = self.start_nginx()

        def answers():
            self.assertIsNone(self.nginx.poll(), self.nginx_errors.read_text())
            try:
                return self.asked("/v1/version", context=context)["name"] == "throng"
            except OSError:
                return False

        wait_until(answers, what="nginx before the service")
        job = {"scenario": "bridge/everyday", "capture": {"to_s": 1}, "quality": "draft"}
        made = self.asked("/v1/jobs", key, job, context=context)["links"]["self"]
        self.finished(made, key, context=context)
        self.assertIn(b"<title>", self.asked("/", context=context))
        self.nginx.terminate()
        self.assertEqual(self.nginx.wait(60), 0)
        self.end_service()


if __name__ == "__main__":
    unittest.main()
