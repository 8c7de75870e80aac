"""scripts/check_language.py: refuses coined words and British spelling, names the replacement, leaves public names."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.argv.pop(1)  # the program, which is not needed
CHECK = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_language.py"


class Language(unittest.TestCase):
    def check(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / name
            file.write_text(text)
            done = subprocess.run([sys.executable, CHECK, file], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 1 if done.stdout else 0, done.stderr)
        return [line.split(": ", 1)[1] for line in done.stdout.splitlines()]

    def test_identifiers(self):
        self.assertEqual(self.check("a.cpp", "constexpr int kMostAgents = 3;\n"), ['"kMost": use kMax...'])
        self.assertEqual(self.check("a.h", "double most_bytes;\n"), ['"most_bytes": use max_...'])
        self.assertEqual(
            self.check("a.h", "struct ColourOf { int neighbourCount, grey_px; };\n"),
            ['"Colour": use color', '"neighbour": use neighbor', '"grey": use gray'],
        )
        self.assertEqual(
            self.check("a.h", "int picture_count, told;\n"),
            ['"told": use given, reported, notified', '"picture_count": use image, texture, plot'],
        )
        self.assertEqual(
            self.check("a.h", "int kMaxAgents, most_similar, at_most, color, gray; bool normalized;\n"), []
        )

    def test_comments(self):
        self.assertEqual(
            self.check("a.cpp", "// The ways of the craft.\n"),
            ['"ways": use paths, trajectories', '"craft": use vehicle, drone'],
        )
        self.assertEqual(
            self.check("a.cpp", "int i;  // normalised by metres\n"),
            ['"normalised": use normalized', '"metres": use meters'],
        )
        [finding] = self.check("a.cpp", "/// Stays in place. Who\n/// stands does not move.\n")
        self.assertIn("Who ...", finding)
        self.assertEqual(self.check("a.cpp", "// Which one? What does it cost? See `colour`.\n"), [])
        self.assertEqual(self.check("a.cpp", "// A wall\nint where;\n// that stands.\n"), [])

    def test_strings_are_public_names(self):
        self.assertEqual(self.check("a.cpp", 'auto a = json["colour"]; auto b = R"(// ways)"; char c = \'"\';\n'), [])

    def test_messages(self):
        self.assertEqual(
            self.check("a.cpp", 'auto a = "the colour of pictures";\n'),
            ['"colour": use color', '"pictures": use images'],
        )
        [finding] = self.check("a.cpp", 'auto a = "Who is younger is left out.";\n')
        self.assertIn("Who ...", finding)

    def test_documentation(self):
        self.assertEqual(
            self.check("a.md", "The colour of a `colour`.\n\n```\ncolour = grey\n```\n"), ['"colour": use color']
        )
        [finding] = self.check("a.md", "| `field` | Who is younger is left out. |\n")
        self.assertIn("Who ...", finding)
        self.assertEqual(
            self.check("a.py", '"""Wait.\n\nWhat lies beyond is skipped."""\nx = "colour"\n')[0][:6], '"What '
        )

    def test_this_tree(self):
        done = subprocess.run([sys.executable, CHECK], capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


unittest.main()
