"""`throng report` as a reader opens it: well-formed, nothing fetched, and in headless Chromium (Debian: chromium)
without a word on the console and with every chart drawn."""
import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import printed, throng

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
CHARTS_OF_A_RUN = 5
MAPS_OF_A_RUN = 4  # and the diagram, by ECharts; the rest are Studio's charts


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
        base = cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (base / "runs").mkdir()
        scenario = pathlib.Path(__file__).parents[2] / "scenarios/city_square"
        for seed in (1, 2):
            files = ["-s", scenario / "square_scene.xml", "-b", scenario / "nearest_exit_behavior.xml"]
            throng("crowd", *files, "-r", seed, "-d", 60, "-q", "-o", base / f"runs/run{seed}.h5")
        throng("report", base / "runs", "--scenario", "city_square/nearest_exit", "-o", base / "report.html")
        cls.text = (base / "report.html").read_text()

    def test_is_well_formed_and_fetches_nothing(self):
        parser = Balance()
        parser.feed(self.text)
        self.assertEqual(parser.open, [])
        self.assertEqual(self.text.count("<div data-chart="), 1 + 2 * CHARTS_OF_A_RUN)
        # Elements that could fetch: the page's own markup, which its policy also confines.
        markup = self.text[: self.text.index("<script")]
        self.assertNotRegex(markup, r"https?:|<(link|img|iframe)\b|url\(|@import")
        self.assertIn("default-src 'none'", markup)

    def test_tables_need_no_script(self):
        markup = self.text[: self.text.index("<script")]
        self.assertEqual(markup.count("<table>"), 5)
        metrics = printed("metrics", self.base / "runs/run2.h5", "--scenario", "city_square/nearest_exit")
        people = json.loads(metrics)["people"]
        self.assertGreater(people, 100)
        self.assertIn(f"<td>run2</td><td>{people}</td>", markup)
        self.assertIn(">greatest density</a></td>", markup)

    def chromium(self, *arguments):
        self.assertIsNotNone(CHROMIUM, "Chromium is missing (Debian package chromium; scripts/setup.sh installs it)")
        options = [
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            f"--user-data-dir={self.base / 'profile'}",
            "--enable-logging=stderr",
            "--window-size=1000,3200",
            "--virtual-time-budget=10000",
        ]
        done = subprocess.run([CHROMIUM, *options, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line for line in done.stderr.splitlines() if ":CONSOLE" in line], [])
        return done.stdout

    def test_opens_in_chromium(self):
        page = f"file://{self.base / 'report.html'}"
        picture = self.base / "report.png"
        self.chromium(f"--screenshot={picture}", page)
        self.assertGreater(picture.stat().st_size, 100_000, "an empty page is smaller")
        dom = self.chromium("--dump-dom", page)
        shown = dom[: dom.index('<section id="of_run1">')]
        # Charts of a run come with its choice.
        self.assertEqual(len(re.findall(r"_echarts_instance_=", shown)), MAPS_OF_A_RUN)
        self.assertEqual(len(re.findall(r"_echarts_instance_=", dom)), MAPS_OF_A_RUN)
        self.assertEqual(len(re.findall(r'<svg class="chart"', dom)), 2, "escape curve and states of the exits")
        for text in ("50 %", "40 s", "open exits"):
            self.assertTrue(f">{text}</text>" in shown, text)
        # The curve's figures at the end of the runs are those of the report.
        figures = json.loads(re.search(r'id="figures">(.*?)</script>', self.text, re.S).group(1))["escape"]
        low, median, high = (figures[name][-1] for name in ("low", "median", "high"))
        self.assertIn(f"median {median:.1f} %, quartiles {low:.1f} % to {high:.1f} %", shown)
        self.assertRegex(shown, r'class="series-band series-0" points="\d')
        self.assertRegex(shown, r'<rect class="exit-flowing"')

    def test_another_run_can_be_chosen(self):
        chosen = self.text.replace('id="run0" checked', 'id="run0"').replace('id="run1"', 'id="run1" checked')
        (self.base / "chosen.html").write_text(chosen)
        dom = self.chromium("--dump-dom", f"file://{self.base / 'chosen.html'}")
        section = dom[dom.index('<section id="of_run1">') : dom.index("<script")]
        self.assertEqual(len(re.findall(r"_echarts_instance_=", section)), MAPS_OF_A_RUN)
        self.assertEqual(len(re.findall(r'<svg class="chart"', section)), 1)

    def test_prints_all_runs(self):
        paper = self.base / "report.pdf"
        self.chromium(f"--print-to-pdf={paper}", f"file://{self.base / 'report.html'}")
        pages = len(re.findall(rb"/Type\s*/Page\b", paper.read_bytes()))
        self.assertGreater(pages, 6, "two runs with five charts each")


if __name__ == "__main__":
    unittest.main()
