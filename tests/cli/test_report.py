"""`throng report` as a reader opens it: well-formed, nothing fetched, and in headless Chromium, where that is
installed (Debian: chromium), without a word on the console and with every chart drawn."""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

THRONG = sys.argv.pop(1)
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
CHARTS_OF_A_RUN = 5


def throng(*arguments):
    done = subprocess.run([THRONG, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Balance(html.parser.HTMLParser):
    """Complains of elements that are not closed in order."""
    ALONE = {"meta", "input", "br"}

    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attributes):
        if tag not in self.ALONE:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        base = cls.base = pathlib.Path(cls.folder.name)
        (base / "runs").mkdir()
        scenario = pathlib.Path(__file__).parents[2] / "scenarios/city_square"
        for seed in (1, 2):
            throng("crowd", "-s", scenario / "square_scene.xml", "-b", scenario / "nearest_exit_behavior.xml",
                   "-r", seed, "-d", 60, "-q", "-o", base / f"runs/run{seed}.h5")
        throng("report", base / "runs", "--scenario", "city_square/nearest_exit", "-o", base / "report.html")
        cls.text = (base / "report.html").read_text()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_is_well_formed_and_fetches_nothing(self):
        parser = Balance()
        parser.feed(self.text)
        self.assertEqual(parser.open, [])
        charts = re.findall(r"<svg .*?</svg>", self.text, re.DOTALL)
        self.assertEqual(len(charts), 1 + 2 * CHARTS_OF_A_RUN)
        for chart in charts:
            xml.etree.ElementTree.fromstring(chart)
        self.assertEqual(set(re.findall(r"https?://[^\"' <]*", self.text)), {"http://www.w3.org/2000/svg"})
        self.assertNotRegex(self.text, r"<(script|link|img|iframe)\b|url\(|@import")

    @unittest.skipUnless(CHROMIUM, "chromium is not installed")
    def test_opens_in_chromium(self):
        picture = self.base / "report.png"
        options = [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                   f"--user-data-dir={self.base / 'profile'}", "--enable-logging=stderr", "--window-size=1000,3200"]
        page = f"file://{self.base / 'report.html'}"
        drawn = subprocess.run([*options, f"--screenshot={picture}", page], capture_output=True, text=True, timeout=180)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertEqual([line for line in drawn.stderr.splitlines() if ":CONSOLE" in line], [])
        self.assertGreater(picture.stat().st_size, 50_000, "an empty page is smaller")
        dom = subprocess.run([*options, "--dump-dom", page], capture_output=True, text=True, timeout=180).stdout
        self.assertEqual(dom.count("<svg "), 1 + 2 * CHARTS_OF_A_RUN)


if __name__ == "__main__":
    unittest.main()
