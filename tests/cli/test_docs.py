"""Documentation: links and anchors lead somewhere, every page is on the start page, commands and variables exist."""
import itertools
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

import numpy
from PIL import Image

from program import ROOT, THRONG, run, throng

sys.path[:0] = [str(pathlib.Path(__file__).parent), str(ROOT / "scripts")]
import doc_fixtures  # noqa: E402
from doc_blocks import read_blocks  # noqa: E402

PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "python").glob("*.md")])
CODE = re.compile(r"^(```|~~~).*?^\1\s*$", re.M | re.S)
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def recipe_of(page, heading):
    """The first JSON block below a heading."""
    return json.loads(re.search(rf"^## {re.escape(heading)}\n.*?^```json\n(.*?)^```", page, re.M | re.S)[1])


def text_of(page):
    """Without blocks and spans of code."""
    return re.sub(r"`[^`\n]*`", "`code`", CODE.sub("", page.read_text()))


def anchor(heading):
    """As GitHub makes it."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def anchors_of(page):
    return {anchor(line.lstrip("#")) for line in CODE.sub("", page.read_text()).splitlines() if line.startswith("#")}


def shell_lines(page):
    for _, language, block in read_blocks(page.read_text()):
        if language == "sh":
            yield from block.replace("\\\n", " ").splitlines()


class Docs(unittest.TestCase):
    def test_links_lead_somewhere(self):
        broken = []
        for page in PAGES:
            for target in LINK.findall(text_of(page)):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, place = target.partition("#")
                file = (page.parent / name).resolve() if name else page
                if not file.exists():
                    broken.append(f"{page.relative_to(ROOT)}: no file {target}")
                elif place and file.suffix == ".md" and place not in anchors_of(file):
                    broken.append(f"{page.relative_to(ROOT)}: no heading {target}")
        self.assertEqual(broken, [])

    def test_the_start_page_names_every_page(self):
        start = (ROOT / "docs" / "README.md").read_text()
        named = {link.partition("#")[0] for link in LINK.findall(start)}
        pages = {str(page.relative_to(ROOT / "docs")) for page in (ROOT / "docs").rglob("*.md")} - {"README.md"}
        self.assertEqual(pages - named, set())

    def test_every_variable_is_in_the_table(self):
        table = (ROOT / "docs" / "troubleshooting.md").read_text()
        folders = "base cli crowd jobs render server sim skinning world python/throng scripts".split()
        used = set()
        for folder in folders:
            for file in (ROOT / folder).rglob("*"):
                if file.suffix in {".cpp", ".h", ".py", ".sh"}:
                    text = file.read_text()
                    used.update(re.findall(r"\"(THRONG_[A-Z_]+)\"", text), re.findall(r"\$\{?(THRONG_[A-Z_]+)", text))
        used = {name for name in used if not name.endswith("_MODULES")}  # of CMake
        self.assertEqual({name for name in used if f"`{name}`" not in table}, set())

    def test_commands_in_the_docs_exist(self):
        """Each `throng COMMAND` of a shell block has help, and so has each of its long options."""
        helps = {}
        wrong = []
        for page in PAGES:
            if page.name == "CHANGELOG.md":
                continue
            for line in shell_lines(page):
                found = re.search(r"(?:^|.*[\s/;|])throng +((?:[a-z][a-z-]* *)+)(.*)", line.split("#")[0])
                if not found:
                    continue
                words = found[1].split()
                for count in (2, 1):
                    command = tuple(words[:count])
                    if command not in helps:
                        done = throng(*command, "--help", code=None)
                        helps[command] = done.stdout if done.returncode == 0 else None
                    if helps[command] is not None:
                        break
                if helps[command] is None:
                    wrong.append(f"{page.name}: no command in: {line.strip()}")
                    continue
                for option in re.findall(r"(?<!\S)(--[a-z-]+)", found[2].split("|")[0].split(";")[0]):
                    if option not in helps[command] and option != "--help":
                        wrong.append(f"{page.name}: no {option} in: {line.strip()}")
        self.assertEqual(wrong, [])

    def test_every_recipe_is_a_job_that_can_be_done(self):
        """By default every eighth one, in the long test all."""
        is_long = bool(os.environ.get("THRONG_LONG"))
        page = (ROOT / "docs" / "recipes.md").read_text()
        jobs = 0
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            doc_fixtures.recipe_files(folder, THRONG)
            for recipe in re.findall(r"^```json\n(.*?)^```", page, re.M | re.S):
                document = json.loads(recipe)
                if "scenario" not in document:
                    (folder / "mine" / "hall.json").write_text(recipe)
                    continue
                jobs += 1
                if not is_long and jobs % 8 != 1:
                    continue
                (folder / "job.json").write_text(recipe)
                scenarios = folder / "mine" if document["scenario"] == "hall" else ROOT / "scenarios"
                with self.subTest(recipe=recipe):
                    throng("check", folder / "job.json", variables={"THRONG_SCENARIOS": scenarios})
        self.assertGreaterEqual(jobs, 20)

    def test_images_of_a_set_are_of_many_runs(self):
        """Those of one run show the same place and, where people stand, the same people."""
        page = (ROOT / "docs" / "recipes.md").read_text()
        lists = re.findall(r"^- (?:Detectors|Light and weather|Labels):(.*(?:\n  .*)*)$", page, re.M)
        names = {name for line in lists for name, _ in re.findall(r"\[([^\]]+)\]\((#[^)]+)\)", line)}
        self.assertGreaterEqual(len(names), 14)
        sequences = {"Tracking", "Optical flow and all ground truth per pixel"}
        for name in names - sequences:
            job = recipe_of(page, name)
            self.assertEqual(job["capture"]["from_s"], job["capture"]["to_s"], name)
            self.assertGreaterEqual(job["runs"], 8, name)
        for preset in ("counting", "detection", "keypoints", "segmentation"):
            job = json.loads((ROOT / f"scenarios/presets/{preset}.job.json").read_text())
            self.assertGreaterEqual(job["drones"][0]["camera"].get("per_frame", {}).get("yaw_deg", 0), 20, preset)

    def test_images_of_the_counting_recipe_are_no_near_duplicates(self):
        job = recipe_of((ROOT / "docs" / "recipes.md").read_text(), "Crowd counting")
        job.update({"quality": "draft", "crowd": {"agents": 150}, "outputs": {}})
        for drone in job["drones"]:
            drone["camera"].update({"width": 320, "height": 180})
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "job.json").write_text(json.dumps(job))
            people = doc_fixtures.character_library(folder, THRONG)
            throng("run", "job.json", "-o", "out", cwd=folder, variables={"THRONG_PEOPLE": people})
            files = sorted((folder / "out/dataset/images").rglob("*.jpg"))
            small = [numpy.asarray(Image.open(file).convert("L").resize((32, 18)), float) for file in files]
        self.assertEqual(len(small), job["runs"])
        for one, other in itertools.combinations(small, 2):
            self.assertGreater(numpy.abs(one - other).mean(), 5)

    def provided_by(self, packages):
        """Names that Debian's packages stand for: several packages provide BLAS and LAPACK, and any of them is linked."""
        if not packages:
            return {}
        command = ["dpkg-query", "-W", "-f", "${Package} ${Provides}\\n", *packages]
        lines = run(*command, code=None).stdout.splitlines()
        words = [re.sub(r"\([^)]*\)|,", " ", line).split() for line in lines]
        return {package: set(provided) for package, *provided in filter(None, words)}

    def test_the_notice_names_every_linked_library(self):
        needed = re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", THRONG).stdout)
        places = dict(re.findall(r"(\S+) => (/\S+)", run("ldd", THRONG).stdout))
        notice = (ROOT / "NOTICE").read_text()
        named = set(re.findall(r"^  (\S+) ", notice, re.M))
        owners = set()
        for library in needed:
            if library.startswith("ld-linux"):  # the loader, which finds the others
                continue
            place = str(pathlib.Path(places[library]).resolve())
            for file in (place, place.removeprefix("/usr")):
                owner = run("dpkg-query", "-S", file, code=None)
                if owner.returncode == 0:
                    owners.add(owner.stdout.split(":")[0])
                    break
        self.assertGreater(len(owners), 20)
        missing = owners - named
        replaceable = set().union(*self.provided_by(named).values())
        missing -= {package for package, provided in self.provided_by(missing).items() if provided & replaceable}
        self.assertEqual(missing, set())


if __name__ == "__main__":
    unittest.main()
