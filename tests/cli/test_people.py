"""throng people: who there is, and sheets that show them. Skips where nobody has been baked."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

THRONG = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
PEOPLE = pathlib.Path(os.environ.get("THRONG_PEOPLE", ROOT / "build" / "people"))


def people(*arguments):
    return subprocess.run([THRONG, "people", *map(str, arguments)], capture_output=True, text=True, timeout=300)


class Sheet(unittest.TestCase):
    def setUp(self):
        if not (PEOPLE / "population.json").exists():
            self.skipTest(f"no baked people in {PEOPLE}: run scripts/setup.sh")
        self.folder = tempfile.TemporaryDirectory()
        self.base = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def names(self):
        return sorted(p.name for p in self.base.iterdir())

    def test_draws_a_picture_of_the_wanted_width(self):
        for name, kind in (("sheet.png", "PNG"), ("sheet.jpg", "JPEG")):
            done = people("sheet", PEOPLE, "--count", 3, "--width", 1200, "-o", self.base / name)
            self.assertEqual(done.returncode, 0, done.stderr)
            with Image.open(self.base / name) as picture:
                self.assertEqual(picture.format, kind)
                self.assertEqual(picture.width, 1200)
                self.assertGreater(picture.height, 1000)
                self.assertGreater(len(set(picture.convert("L").getdata())), 100)
        self.assertEqual(self.names(), ["sheet.jpg", "sheet.png"])

    def test_shows_only_who_is_named(self):
        first, second = re.findall(r"^person_\d+", people("list", PEOPLE).stdout, re.M)[:2]
        sizes = []
        for names in (first, f"{first},{second}"):
            done = people("sheet", PEOPLE, "--people", names, "--width", 800, "-o", self.base / "s.png")
            self.assertEqual(done.returncode, 0, done.stderr)
            with Image.open(self.base / "s.png") as picture:
                sizes.append(list(picture.convert("L").resize((50, 100)).getdata()))
        self.assertNotEqual(*sizes)

    def test_says_what_is_wrong_and_leaves_nothing(self):
        (self.base / "folder.png").mkdir()
        before = self.names()
        out = self.base / "s.png"
        cases = [
            ([PEOPLE, "-o", self.base / "s.bmp"], r"\.bmp.*\.png"),
            ([PEOPLE, "-o", self.base / "sheet"], r"no extension"),
            ([PEOPLE, "-o", self.base / "nowhere" / "s.png"], r"no folder .*nowhere"),
            ([PEOPLE, "-o", self.base / "folder.png"], r"a folder"),
            ([PEOPLE, "-o", out, "--people", "nobody"], r"nobody.*people list"),
            ([PEOPLE, "-o", out, "--count", "0"], r"--count.*at least 1"),
            ([PEOPLE, "-o", out, "--width", "10"], r"--width.*800"),
            ([self.base, "-o", out], r"population\.json"),
        ]
        for arguments, said in cases:
            done = people("sheet", *arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertRegex(done.stderr, said)
        self.assertEqual(self.names(), before)

    def test_stops_when_asked(self):
        process = subprocess.Popen(
            [THRONG, "people", "sheet", PEOPLE, "--width", "8000", "-o", self.base / "s.png"],
            stderr=subprocess.PIPE, text=True)
        process.stderr.readline()  # it has begun
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("cancelled", said)
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
