"""scripts/check_tree.py on a small repository.

usage: test_check_tree.py
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_tree.py"


class CheckTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        subprocess.run(["git", "init", "-q", self.root], check=True)

    def add(self, name, size=10):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(b"x" * size)

    def found(self):
        done = subprocess.run([sys.executable, SCRIPT, self.root], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1 if done.stdout else 0, done.stderr)
        return {line.split(": ")[0]: line for line in done.stdout.splitlines()}

    def test_what_belongs_is_accepted(self):
        for name in (
            "base/json/a.cpp",
            "docs/labels.jpg",
            "tests/cli/test_a.py",
            "README.md",
            "scenarios/a/b.job.json",
        ):
            self.add(name)
        self.add("build/shot.png")
        self.add(".gitignore", 0)
        (self.root / ".gitignore").write_text("/build/\n")
        self.assertEqual(self.found(), {})

    def test_strays_are_named(self):
        strays = ["x_sq60/shot.png", "a.json", "base/notes.md", "tests/cli/shot.png", "out/run.h5", "docs/draft.txt"]
        for name in strays:
            self.add(name)
        (self.root / "base").joinpath("link.cpp").symlink_to("notes.md")
        self.assertEqual(set(self.found()), {*strays, "base/link.cpp"})

    def test_large_files_and_images_that_nothing_makes_are_named(self):
        self.add("base/table.cpp", 40_000)
        self.add("docs/by_hand.png")
        found = self.found()
        self.assertIn("found 40 KiB, expected at most 32", found["base/table.cpp"])
        self.assertIn("no script makes this image", found["docs/by_hand.png"])

    def test_long_lines_of_documents_are_named(self):
        self.add("docs/paragraph.md", 161)
        self.add("docs/table.md")
        (self.root / "docs/table.md").write_text(f"| {'x' * 200} |\n\n```text\n{'y' * 200}\n```\n", encoding="utf-8")
        self.assertEqual(
            self.found(), {"docs/paragraph.md": "docs/paragraph.md: line 1: found 161 characters, expected at most 160"}
        )


if __name__ == "__main__":
    unittest.main()
