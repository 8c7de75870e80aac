#!/usr/bin/env python3
"""Contents and uses of the image that docker/Dockerfile describes.

usage: test_image.py STORE    STORE: folder that keeps the base image and the layers, so that a second build is quick
"""
import io
import json
import re
import shutil
import subprocess
import sys
import tarfile
import unittest

from built_image import ROOT, ImageTest
from service import wait_until

MAX_MB = 600


def grid_table():
    """Three views of a flat grid through a pinhole of 800 px, turned about x, y and both: control points of a calibration."""
    from math import cos, sin

    lines = ["image,i,X,Y,Z,u,v"]
    for view, (lean_x, lean_y) in enumerate(((0.5, 0.6), (0, 0.6), (0.5, 0))):
        for i in range(30):
            x, y = 0.1 * (i % 6 - 2.5), 0.1 * (i // 6 - 2)
            y, z = cos(lean_x) * y, sin(lean_x) * y
            x_c, z_c = cos(lean_y) * x + sin(lean_y) * z, cos(lean_y) * z - sin(lean_y) * x + 1.5
            point = f"{0.1 * (i % 6 - 2.5)},{0.1 * (i // 6 - 2)},0"
            lines.append(f"v{view},{i},{point},{800 * x_c / z_c + 322},{800 * y / z_c + 237}")
    return "\n".join(lines) + "\n"


class Image(ImageTest):
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

    def test_a_study_a_plan_an_import_and_calibrations(self):
        case = {"id": "square", "scenario": "city_square/emergency", "duration_s": 30}
        study = {"name": "square", "cases": [case], "policies": [{"id": "none"}], "runs": 2}
        (self.data / "a.study.json").write_text(json.dumps(study))
        self.run_in_it("throng", "study", "a.study.json", "-o", "study")
        self.run_in_it("throng", "scenario", "plan", "city_square/emergency", "-o", "plan.svg")
        self.run_in_it("throng", "calibrate", "selftest", "--views", "12", "-o", "selftest.json")
        (self.data / "points.csv").write_text(grid_table())
        self.run_in_it(
            "throng",
            "calibrate",
            "intrinsics",
            "--points",
            "points.csv",
            "--size",
            "640x480",
            "--lens",
            "pinhole",
            "-o",
            "camera.json",
        )
        self.assertAlmostEqual(json.loads((self.data / "camera.json").read_text())["fx"], 800, 2)
        shutil.copy(ROOT / "tests/places/imports/data/yard.sdf", self.data)
        shutil.copytree(ROOT / "tests/places/imports/data/models", self.data / "models")
        self.run_in_it("throng", "scenario", "import", "yard.sdf", "-o", "mine", "--models", "models")

    def test_the_service_makes_datasets_and_calibrations(self):
        self.serve()
        key = self.first_key()
        self.assertEqual(self.asked("/healthz")["status"], "ok")
        health_check = self.config["Healthcheck"]["Test"]
        self.assertEqual(health_check[0], "CMD-SHELL")
        self.run_in_it("sh", "-c", health_check[1].replace("8080", str(self.port)))
        self.assertIn(b"<title>", self.asked("/"))
        job = {"scenario": "bridge/everyday", "capture": {"to_s": 2}, "quality": "draft"}
        made = self.asked("/v1/jobs", key, job)
        request = {"name": "wide", "points": "points.csv", "size": "640x480", "lens": "pinhole"}
        calibration = self.asked("/v1/calibrations", key, {**request, "files": {"points.csv": grid_table()}})
        self.finished(made["links"]["self"], key)
        with tarfile.open(fileobj=io.BytesIO(self.asked(f"/v1/jobs/{made['id']}/archive", key))) as archive:
            archive.extractall(self.data / "archive")
        [dataset] = (file.parent for file in (self.data / "archive").rglob("manifest.json"))
        self.assertIn("no faults", self.run_in_it("throng", "validate", dataset.relative_to(self.data)))
        camera = self.finished(calibration["links"]["self"], key)["camera"]
        self.assertAlmostEqual(camera["fx"], 800, 2)
        for line in self.output.read_text().splitlines():
            json.loads(line)
        self.end_service()

    def test_a_job_goes_on_after_a_stop(self):
        self.serve()
        key = self.first_key()
        job = {"scenario": "bridge/everyday", "capture": {"to_s": 60}, "quality": "draft"}
        made = self.asked("/v1/jobs", key, job)["links"]["self"]
        wait_until(lambda: self.asked(made, key)["progress"].get("frames_done", 0) > 0, what="the job's first images")
        self.end_service()
        self.serve()
        state = self.asked(made, key)["state"]
        self.assertIn(state, ("queued", "running"))
        self.finished(made, key)
        self.end_service()


if __name__ == "__main__":
    unittest.main()
