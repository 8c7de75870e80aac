"""Every shell block of README.md and docs/ runs as it is pasted, or stands in NOT_RUN with the reason.

Each page has a folder of its own with links to what its commands name of the source tree. Blocks run in their order, in bash with
-e and pipefail; files that the page says to save are saved. Exports last for the page. Differences from a user's
terminal, to save time: the shipped jobs of city_square/ are shortened (doc_fixtures.shortened: 20 people, 160 x 120 pixels,
one second), and the character library has one character, made of boxes. Ports 8080 and 8765 are free ones.
"""

import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

from program import ROOT, THRONG

sys.path[:0] = [str(pathlib.Path(__file__).parent), str(ROOT / "scripts")]
import doc_fixtures as fixtures  # noqa: E402
from doc_blocks import read_blocks, save_files  # noqa: E402
from free_ports import free_port  # noqa: E402

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
LANGUAGES = {"sh", "text", "json", "xml", "python", "cpp", "cmake", "javascript", "yaml"}

# Page, how the block begins -> why it does not run here.
NOT_RUN = {
    ("README.md", "scripts/demo.sh"): "needs root, the network and ten minutes; scripts/fresh_debian.sh runs it",
    ("README.md", "docker build"): "needs Docker; tests/docker/test_image.py builds and uses the image",
    ("docs/container.md", ""): "needs Docker; tests/docker/test_image.py builds and uses the image",
    ("README.md", "python3 -m venv"): "pip needs the network; tests/python/test_package.py installs the package",
    ("docs/api.md", "docker/make_certificate.sh"): "needs Docker",
    ("docs/blueprint.md", ""): "all blocks are run by tests/cli/test_scenarios.py",
    ("docs/calibration.md", "throng calibrate selftest"): "26 s of CPU time; run by tests/cli/test_calibrate.py",
    (
        "docs/evacuation.md",
        "throng study doors.json -o doors\n",
    ): "24 s of CPU time: the same as the study before it, with two cases",
    ("docs/imports.md", ""): "all blocks are run by tests/cli/test_imports.py, the last one without images",
    ("docs/library.md", "cmake --preset"): "builds the program: many minutes; tests/cli/test_package.py installs it",
    ("docs/people.md", "throng people build"): "48 s of CPU time for 96 people; run by scripts/setup.sh",
    (
        "docs/python.md",
        "pip install",
    ): "pip needs the network; the rest of the page is run by tests/python/test_docs.py",
    ("docs/robotics.md", "export PYTHONPATH"): "a minute of CPU time; the notebook is run by tests/python/test_docs.py",
    (
        "docs/training.md",
        "",
    ): "minutes of CPU time, needs torch; tests/python/test_train.py and test_figures.py run the command",
    ("docs/matching.md", ""): "needs photographs; tests/python/test_match.py runs the same commands",
    ("docs/publishing.md", ""): "needs an object store; tests/cli/test_publish.py runs the same commands",
    ("docs/studio.md", "node web/studio"): "never ends (--watch), needs the packages of web/",
}

# Page, how the block begins -> functions of doc_fixtures that make what it needs beforehand; "service": throng serve runs.
NEEDS = {
    ("README.md", "throng calibrate intrinsics"): ["boards"],
    ("docs/api.md", "key="): ["service"],
    ("docs/api.md", "curl -sf -H 'Content-Type: application/json'"): ["service"],
    ("docs/api.md", "throng scenarios upload"): ["bundle", "service"],
    ("docs/calibration.md", "throng calibrate intrinsics boards"): ["boards"],
    ("docs/calibration.md", "throng calibrate intrinsics --points"): ["points"],
    ("docs/calibration.md", "curl"): ["service"],
    ("docs/crowd.md", "throng crowd 4square.xml"): ["menge_project"],
    ("docs/metrics.md", "throng metrics run.h5"): ["traces"],
    ("docs/metrics.md", "throng report out"): ["run_done", "service"],
    ("docs/operations.md", "throng backup"): ["service"],
    ("docs/operations.md", "THRONG_URL="): ["service"],
    ("docs/people.md", "throng people import"): ["characters", "job"],
    ("docs/recipes.md", "throng serve"): ["two_jobs"],
    ("docs/recipes.md", "python3"): ["run_done"],
    ("docs/rendering.md", "THRONG_DEVICE"): ["job"],
    ("docs/robotics.md", "node height.mjs"): ["npm_packages"],
    ("docs/scenario.md", "throng scenario check"): ["my_place"],
    ("docs/service.md", "THRONG_FAULTS"): ["job"],
    ("docs/validation.md", "throng validate-crowd"): ["recordings"],
}


def name_of(page):
    return str(page.relative_to(ROOT))


def entry(table, page, block):
    """The first row of the table that is about this block, and its key."""
    for (name, start), value in table.items():
        if name == name_of(page) and block.startswith(start):
            return (name, start), value
    return None, None


class Page:
    """Runs the blocks of one page in a folder of their own."""

    def __init__(self, folder, people):
        self.folder = folder
        self.port = free_port()
        self.live_port = free_port()
        fixtures.source_tree(folder, THRONG, people)
        programs = folder / "build/release/cli"  # also where the pages say that the program is
        program = programs / "throng"
        program.unlink()
        program.write_text(f'#!/bin/sh\n[ "$1" != serve ] || set -- "$@" --port {self.port}\nexec {THRONG} "$@"\n')
        program.chmod(0o755)
        self.environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith("THRONG_")},
            "PATH": f"{programs}:{os.environ['PATH']}",
            "THRONG_PEOPLE": str(people),
            "ROS_HOME": str(folder / "ros"),
            "ROS_IP": "127.0.0.1",
            "THRONG_URL": f"http://127.0.0.1:{self.port}",
        }
        self.exports = ""

    def run(self, block, needs):
        """Output of the block, None if it succeeded."""
        server = None
        for need in needs:
            if need != "service":
                getattr(fixtures, need)(self.folder, THRONG)
        if "service" in needs:
            server = self.start_service()
        script = self.folder / "block.sh"
        script.write_text(
            f"set -eo pipefail\n{self.exports}{block}".replace("127.0.0.1:8080", f"127.0.0.1:{self.port}").replace(
                "8765", str(self.live_port)
            )
        )
        self.exports += "".join(line + "\n" for line in block.splitlines() if line.startswith("export "))
        try:
            done = subprocess.run(
                ["bash", script], cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=900
            )
        finally:
            if server:
                server.terminate()
                server.wait(300)
        return (
            None if done.returncode == 0 else f"exit code {done.returncode}\n{done.stdout[-1500:]}{done.stderr[-1500:]}"
        )

    def start_service(self):
        shutil.rmtree(self.folder / "data", ignore_errors=True)
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        command = [THRONG, "serve", "--data", "data", "--port", str(self.port)]
        server = subprocess.Popen(command, cwd=self.folder, env=self.environment, **quiet)
        ready = ["curl", "-sf", "--retry", "280", "--retry-delay", "1", "--retry-connrefused", "-o", "/dev/null"]
        subprocess.run([*ready, f"http://127.0.0.1:{self.port}/readyz"], check=True, timeout=300)
        return server


class DocBlocks(unittest.TestCase):
    maxDiff = None

    def test_every_block_has_a_language(self):
        found = {
            name_of(page): {language for _, language, _ in read_blocks(page.read_text())} - LANGUAGES for page in PAGES
        }
        self.assertEqual({page: languages for page, languages in found.items() if languages}, {})

    def test_tables_name_blocks_that_exist(self):
        used = set()
        for page in PAGES:
            for _, language, block in read_blocks(page.read_text()):
                if language == "sh":
                    used |= {entry(table, page, block)[0] for table in (NOT_RUN, NEEDS)}
        self.assertEqual((set(NOT_RUN) | set(NEEDS)) - used, set())

    def test_most_blocks_run(self):
        blocks = [
            (page, block) for page in PAGES for _, language, block in read_blocks(page.read_text()) if language == "sh"
        ]
        # Here, or as it stands in the page by another test.
        run = [
            block for page, block in blocks if "run by tests/" in (entry(NOT_RUN, page, block)[1] or "run by tests/")
        ]
        self.assertGreater(len(run), 0.6 * len(blocks))


class RunBlocks(unittest.TestCase):
    """A test for each page; `test_doc_blocks.py THRONG RunBlocks.test_metrics` runs one."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.people = fixtures.character_library(pathlib.Path(folder.name), THRONG)
        os.environ["THRONG_PEOPLE"] = str(cls.people)  # also of the fixtures

    def run_page(self, page):
        text = page.read_text()
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        with tempfile.TemporaryDirectory() as folder:
            runner = Page(pathlib.Path(folder), self.people)
            for before, language, block in read_blocks(text):
                save_files(runner.folder, before, block)
                if language != "sh" or entry(NOT_RUN, page, block)[1]:
                    continue
                wrong = runner.run(block, entry(NEEDS, page, block)[1] or [])
                self.assertIsNone(wrong, f"{name_of(page)}:\n{block}\n{wrong}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent_s = after.ru_utime + after.ru_stime - used.ru_utime - used.ru_stime
        print(f"{page.name}: {spent_s:.1f} s of CPU time", file=sys.stderr)


def runs_blocks(page):
    """Whether any block of the page is run."""
    return any(
        language == "sh" and not entry(NOT_RUN, page, block)[1] for _, language, block in read_blocks(page.read_text())
    )


for each_page in filter(runs_blocks, PAGES):
    setattr(RunBlocks, f"test_{each_page.stem}", lambda self, page=each_page: self.run_page(page))


if __name__ == "__main__":
    unittest.main()
