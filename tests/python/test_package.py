"""Wheel and source archive, built offline by Debian's setuptools; type hints under mypy --strict."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

import common

PACKAGE = common.ROOT / "python"
CONSUMER = """
import throng
from throng import job

dataset = throng.Dataset("x")
frame: throng.Frame = dataset[0]
wrong: int = dataset[2:]
for each in dataset.filter(min_people=3):
    reveal_type(each.camera.project(each.people.positions))
client = throng.Client()
made = client.submit(job.Job("a", seed=3, quality="draft"))
reveal_type(made["state"])
job.Job("a", quality="best")
job.Job("a", sed=1)
made["stat"]
"""


def call(code, cwd, *arguments):
    return subprocess.run(
        [sys.executable, "-I", "-c", code, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=False
    )


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def build(self, source, kind):
        # As pip and build, without looking for packages elsewhere.
        done = call(f"import sys, setuptools.build_meta as b; print(b.build_{kind}(sys.argv[1]))", source, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / done.stdout.splitlines()[-1]

    @unittest.skipUnless(common.has("setuptools", "wheel"), "setuptools or wheel is not installed")
    def test_wheel_and_source_archive(self):
        source = self.folder / "source"
        shutil.copytree(PACKAGE, source, ignore=shutil.ignore_patterns("build", "dist", "*.egg-info", "__pycache__"))
        archive = self.build(source, "sdist")
        with tarfile.open(archive) as file:
            file.extractall(self.folder / "unpacked", filter="data") if sys.version_info >= (
                3,
                12,
            ) else file.extractall(self.folder / "unpacked")
        again = next((self.folder / "unpacked").iterdir())
        wheels = {}
        for name, folder in (("direct", source), ("from the archive", again)):
            with zipfile.ZipFile(self.build(folder, "wheel")) as wheel:
                wheels[name] = {entry: wheel.read(entry) for entry in wheel.namelist() if not entry.endswith("RECORD")}
                wheel.extractall(self.folder / "installed")
        self.assertEqual(wheels["direct"], wheels["from the archive"])
        sources = (PACKAGE / "throng").rglob("*.py")
        modules = {str(path.relative_to(PACKAGE)) for path in sources} | {"throng/py.typed", "throng/layouts.json"}
        self.assertEqual({name for name in wheels["direct"] if name.startswith("throng/")}, modules)
        license = (common.ROOT / "LICENSE").read_bytes()
        self.assertIn(license, [text for name, text in wheels["direct"].items() if name.endswith("/LICENSE")])
        self.assertEqual((again / "LICENSE").read_bytes(), license)
        done = call(
            "import sys; sys.path.insert(0, sys.argv[1]); import throng; print(throng.__file__, throng.__version__)",
            self.folder,
            self.folder / "installed",
        )
        version = re.search(r"project\(throng VERSION ([\d.]+)", (common.ROOT / "CMakeLists.txt").read_text())[1]
        self.assertEqual(done.stdout.split(), [str(self.folder / "installed/throng/__init__.py"), version])
        metadata = next(text for name, text in wheels["direct"].items() if name.endswith("METADATA")).decode()
        self.assertIn("Requires-Python: >=3.11", metadata)
        self.assertEqual(re.findall(r"^Requires-Dist: (\S+)[^;\n]*$", metadata, re.M), ["numpy"])

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_type_hints(self):
        environment = {**os.environ, "MYPYPATH": str(PACKAGE), "MYPY_CACHE_DIR": str(common.folder() / "mypy")}
        done = subprocess.run(
            ["mypy", "--strict", PACKAGE / "throng", PACKAGE / "generate_types.py"],
            env=environment,
            capture_output=True,
            text=True,
            cwd=self.folder,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        (self.folder / "consumer.py").write_text(CONSUMER)
        answer = subprocess.run(
            ["mypy", "--strict", "consumer.py"],
            env=environment,
            capture_output=True,
            text=True,
            cwd=self.folder,
            check=False,
        ).stdout
        for line, words in ((7, "Dataset"), (9, "ndarray"), (12, "queued"), (13, "quality"), (14, "sed"), (15, "stat")):
            self.assertRegex(answer, rf"consumer.py:{line}: .*{words}")
        self.assertEqual(len(re.findall(": error:", answer)), 4, answer)

    def test_all_names(self):
        import throng

        for name in throng.__all__:
            self.assertTrue(hasattr(throng, name), name)
            if callable(getattr(throng, name)):
                self.assertTrue(getattr(throng, name).__doc__, f"{name} says nothing of itself")


if __name__ == "__main__":
    common.main()
