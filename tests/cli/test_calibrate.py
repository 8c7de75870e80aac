"""throng calibrate: from the command line and over HTTP, and datasets that have the camera it found."""
import json
import pathlib
import sys
import unittest

import cv2
import numpy

from program import ROOT, THRONG, FolderTest, throng, write_json
from service import ask, send, wait_until

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import throng as throng_package  # noqa: E402

SHARED = ROOT.parent / "shared" / "data" / "calib"


def points_table():
    """Five views of a flat grid through a camera of f = 800 px, without a lens's distortion."""
    import math

    lines = ["image,i,X,Y,Z,u,v"]
    for view, (tilt, turn) in enumerate([(0.5, 0.1), (-0.5, 0.4), (0.1, -0.6), (0.6, 0.6), (-0.3, -0.5)]):
        a, b = math.cos(tilt), math.sin(tilt)
        c, d = math.cos(turn), math.sin(turn)
        for row in range(6):
            for column in range(8):
                x, y = 0.1 * (column - 3.5), 0.1 * (row - 2.5)
                # About x by tilt, then about y by turn, two meters away.
                x1, y1, z1 = x, a * y, b * y
                x2, y2, z2 = c * x1 + d * z1, y1, -d * x1 + c * z1 + 1.6
                lines.append(f"v{view},{row * 8 + column},{x},{y},0,{800 * x2 / z2 + 321},{800 * y2 / z2 + 238}")
    return "\n".join(lines) + "\n"


class Calibrate(FolderTest):
    def setUp(self):
        super().setUp()
        self.points = self.folder / "points.csv"
        self.points.write_text(points_table())

    def calibrate(self, *more):
        out = self.folder / "camera.json"
        done = throng("calibrate", "intrinsics", "--points", self.points, "--size", "640x480", "-o", out, *more)
        return json.loads(out.read_text()), done.stdout

    def test_points_give_a_camera_and_all_files(self):
        files = [self.folder / name for name in ("cv.yaml", "ros.yaml", "residuals.svg")]
        camera, said = self.calibrate("--lens", "pinhole", "--opencv", files[0], "--ros", files[1], "--plot", files[2])
        self.assertAlmostEqual(camera["fx"], 800, places=4)
        self.assertAlmostEqual(camera["cx"], 321, places=4)
        self.assertAlmostEqual(camera["cy"], 238, places=4)
        self.assertLess(camera["rms_px"], 1e-6)
        self.assertIn("5 views", said)
        self.assertIn("warning: 5 views", said)
        self.assertIn("camera_matrix", files[0].read_text())
        self.assertIn("camera_name: ros", files[1].read_text())
        self.assertIn("<svg", files[2].read_text())

    def test_control_points_place_the_camera(self):
        self.calibrate("--lens", "pinhole")
        centres = {"a": (0.0, 0.0, 25.0), "b": (4.0, 1.0, 26.0), "c": (-3.0, 2.0, 24.0)}
        ground = {f"p{i}": (2.5 * (i % 5) - 5, 3.0 * (i // 5) - 4, 0.4 * (i * 7 % 5)) for i in range(20)}
        gcp, seen = self.folder / "gcp.csv", self.folder / "seen.csv"
        gcp.write_text("point,X,Y,Z\n" + "".join(f"{p},{x},{y},{z}\n" for p, (x, y, z) in ground.items()))
        lines = ["image,point,u,v"]  # straight down, the top of the image to the north
        for image, (cx, cy, cz) in centres.items():
            for point, (x, y, z) in ground.items():
                lines.append(f"{image},{point},{800 * (x - cx) / (cz - z) + 321},{800 * (cy - y) / (cz - z) + 238}")
        seen.write_text("\n".join(lines) + "\n")
        for command in ("pose", "bundle"):
            out = self.folder / f"{command}.json"
            files = ["--camera", self.folder / "camera.json", "--gcp", gcp, "--observations", seen]
            throng("calibrate", command, *files, "-o", out)
            views = {view["image"]: view for view in json.loads(out.read_text())["views"]}
            self.assertEqual(sorted(views), sorted(centres))
            for image, centre in centres.items():
                for found, true in zip(views[image]["camera_centre"], centre):
                    self.assertAlmostEqual(found, true, places=3, msg=(command, image))

    def test_errors_name_what_is_wrong(self):
        done = throng("calibrate", "intrinsics", "--points", self.points, code=2)
        self.assertIn("the size of the images", done.stderr)
        done = throng("calibrate", "intrinsics", "--points", self.points, "--size", "640x480", "--fix", "k9=1", code=2)
        self.assertIn("k9", done.stderr)
        bad = self.folder / "bad.jpg"
        bad.write_text("no picture")
        done = throng("calibrate", "intrinsics", bad, code=2)
        self.assertIn("bad.jpg", done.stderr)

    def board_image(self, name, columns, rows, tilt):
        """A chessboard with so many inner corners, seen obliquely; without corners a gray image."""
        picture = numpy.full((480, 640), 128, numpy.uint8)
        if columns:
            squares = numpy.indices((rows + 1, columns + 1)).sum(axis=0) % 2 * 255
            board = cv2.copyMakeBorder(
                numpy.kron(squares, numpy.ones((40, 40))), *[40] * 4, cv2.BORDER_CONSTANT, value=255
            )
            height, width = board.shape
            corners = numpy.float32([[0, 0], [width, 0], [width, height], [0, height]])
            seen = numpy.float32([[60 + tilt, 60], [540, 40 + tilt], [560 - tilt, 420], [80, 400 - tilt]])
            matrix = cv2.getPerspectiveTransform(corners, seen)
            picture = cv2.warpPerspective(board.astype(numpy.uint8), matrix, (640, 480), borderValue=128)
        cv2.imwrite(str(self.folder / name), picture)
        return self.folder / name

    def test_a_board_that_is_found_in_few_images_is_refused(self):
        images = [self.board_image(f"{i}.png", 9 if i < 4 else 0, 6, 8 * i) for i in range(13)]
        done = throng("calibrate", "intrinsics", *images, "--columns", 9, "--rows", 6, code=2)
        self.assertIn("found the board in 4 of 13 images, expected it in at least half of them", done.stderr)
        done = throng("calibrate", "intrinsics", *images[:4], "--columns", 9, "--rows", 6, code=None)
        self.assertNotIn("expected it in at least half", done.stderr)

    def test_cameras_of_other_programs(self):
        chain = self.folder / "chain.yaml"
        one = """cam{}:
  camera_model: pinhole
  distortion_coeffs: [-0.1, 0.02, 0.0003, 0.0001]
  distortion_model: radtan
  intrinsics: [{}, 801, 321, 238]
  resolution: [640, 480]
"""
        chain.write_text(one.format(0, 800) + one.format(1, 700))
        camera = throng_package.read_camera(chain, name="cam1", program=THRONG)
        self.assertEqual((camera["fx"], camera["lens"], camera["k1"]), (700, "brown4", -0.1))
        job = {
            "scenario": "city_square/nearest_exit",
            "drones": [{"id": "d1", "start": [0, 0, 20], "camera": {"calibration": "chain.yaml#cam1"}}],
            "capture": {"from_s": 1, "to_s": 2},
        }
        file = write_json(self.folder / "job.json", job)
        done = throng("check", file, "--json")
        self.assertEqual(json.loads(done.stdout)["job"]["drones"][0]["camera"]["calibration"]["fx"], 700)
        job["drones"][0]["camera"]["calibration"] = "chain.yaml"
        file.write_text(json.dumps(job))
        done = throng("check", file, code=2)
        self.assertIn("FILE#NAME with one of: cam0, cam1", done.stderr)

    def test_pictures_of_a_real_board(self):
        if not SHARED.exists():
            self.skipTest("no pictures beside the sources")
        pictures = sorted((SHARED / "chess").iterdir())
        out = self.folder / "left.json"
        bad = self.folder / "bad.jpg"
        bad.write_text("no picture")
        done = throng("calibrate", "intrinsics", *pictures, bad, "--columns", "9", "--rows", "6", "-o", out)
        camera = json.loads(out.read_text())
        wanted = json.loads((SHARED / "reference.json").read_text())["left_full"]
        self.assertAlmostEqual(camera["fx"], wanted["fx"], delta=0.05)
        self.assertAlmostEqual(camera["rms_px"], wanted["rms_px"], delta=1e-3)
        self.assertEqual(len(camera["views"]), 13)
        self.assertIn("left out: " + str(bad), done.stdout)
        done = throng("calibrate", "intrinsics", *pictures[:2], "--columns", "7", "--rows", "5", code=2)
        self.assertIn("9 x 6 inner corners", done.stderr)

    def test_a_rendered_board_gives_the_camera_that_rendered_it(self):
        report = self.folder / "report.json"
        throng("calibrate", "selftest", "--device", "software", "-o", report)
        checks = json.loads(report.read_text())["checks"]
        self.assertEqual(len(checks), 6)
        for check in checks:
            self.assertTrue(check["holds"], check)

    def job(self, calibration):
        return {
            "scenario": "city_square/nearest_exit",
            "crowd": {"agents": 20},
            "quality": "draft",
            "drones": [{"id": "d1", "start": [0, 0, 30], "camera": {"calibration": calibration, "pitch_deg": -80}}],
            "capture": {"rate_hz": 1, "from_s": 0, "to_s": 1},
        }

    def test_datasets_have_the_calibrated_camera(self):
        camera, _ = self.calibrate("--lens", "brown5")
        camera.update(k1=-0.2, p1=0.001, skew=0.5)
        (self.folder / "mine.json").write_text(json.dumps(camera))
        job = write_json(self.folder / "job.json", self.job("mine.json"))
        throng("run", job, "-o", self.folder / "out", "--workers", "1")
        dataset = self.folder / "out" / "dataset"
        manifest = json.loads((dataset / "manifest.json").read_text())
        recorded = manifest["job"]["drones"][0]["camera"]["calibration"]
        for name in ("fx", "fy", "cx", "cy", "skew", "k1", "p1", "width", "height"):
            self.assertEqual(recorded[name], camera[name], name)
        yaml = next(dataset.glob("cameras/**/*.opencv.yaml")).read_text()
        self.assertIn(f"{camera['fx']!r}, 0.5, {camera['cx']!r}", yaml)
        job.write_text(json.dumps(self.job("none.json")))
        done = throng("run", job, "-o", self.folder / "other", code=2)
        self.assertIn("/drones/0/camera/calibration", done.stderr)

    def test_calibrations_over_http(self):
        url = self.serve()
        request = json.dumps({"name": "wide", "points": "points.csv", "size": "640x480", "lens": "brown2"})
        body = (
            f'--board\r\nContent-Disposition: form-data; name="request"\r\n\r\n{request}\r\n'
            f'--board\r\nContent-Disposition: form-data; name="file"; filename="points.csv"\r\n\r\n'
            f"{points_table()}\r\n--board--\r\n"
        )
        with send(url + "/v1/calibrations", body.encode(), kind="multipart/form-data; boundary=board") as answer:
            self.assertEqual(answer.status, 201)
            calibration = url + json.load(answer)["links"]["self"]
        wait_until(lambda: ask(calibration)["state"] in ("succeeded", "failed"))
        state = ask(calibration)
        self.assertEqual(state["state"], "succeeded", state)
        self.assertAlmostEqual(state["camera"]["fx"], 800, places=3)
        for result, word in (
            ("camera", "rms_px"),
            ("opencv", "camera_matrix"),
            ("ros", "camera_name: wide"),
            ("residuals", "<svg"),
        ):
            with send(url + state["links"][result]) as shown:
                self.assertIn(word, shown.read().decode())
        # A dataset job takes it by its id, and holds the camera itself.
        with send(url + "/v1/jobs", self.job(state["id"])) as answer:
            self.assertEqual(answer.status, 201)
            job = json.load(answer)
        self.assertEqual(job["job"]["drones"][0]["camera"]["calibration"]["fx"], state["camera"]["fx"])
        send(url + job["links"]["self"], method="DELETE").close()


if __name__ == "__main__":
    unittest.main()
