"""scripts/check_language.py: refuses coined words and British spelling, names the replacement, leaves public names."""

import sys
import unittest

from program import ROOT, FolderTest, run

CHECK = ROOT / "scripts" / "check_language.py"


class Language(FolderTest):
    def check(self, name, text):
        file = self.folder / name
        file.write_text(text, encoding="utf-8")
        done = run(sys.executable, CHECK, file, code=None)
        self.assertEqual(done.returncode, 1 if done.stdout else 0, done.stderr)
        return [line.split(": ", 1)[1] for line in done.stdout.splitlines()]

    def expect(self, name, text, *findings):
        self.assertEqual(self.check(name, text), list(findings))

    def test_identifiers(self):
        self.expect("a.cpp", "constexpr int kMostAgents = 3;\n", '"kMost": use kMax...')
        self.expect("a.h", "double most_bytes;\n", '"most_bytes": use max_...')
        self.expect(
            "a.h",
            "struct ColourOf { int neighbourCount, grey_px; };\n",
            '"Colour": use color',
            '"neighbour": use neighbor',
            '"grey": use gray',
        )
        self.expect(
            "a.h",
            "int picture_count, told;\n",
            '"told": use given, reported, notified',
            '"picture_count": use image, texture, plot',
        )
        self.expect("a.h", "int kMaxAgents, most_similar, at_most, color, gray; bool normalized;\n")

    def test_comments(self):
        self.expect(
            "a.cpp", "// The ways of the craft.\n", '"ways": use paths, trajectories', '"craft": use vehicle, drone'
        )
        self.expect(
            "a.cpp", "int i;  // normalised by metres\n", '"normalised": use normalized', '"metres": use meters'
        )
        [finding] = self.check("a.cpp", "/// Stays in place. Who\n/// stands does not move.\n")
        self.assertIn("Who ...", finding)
        self.expect("a.cpp", "// Which one? What does it cost? See `colour`.\n")
        self.expect("a.cpp", "// A wall\nint where;\n// that stands.\n")

    def test_strings_are_public_names(self):
        self.expect("a.cpp", 'auto a = json["colour"]; auto b = R"(// ways)"; char c = \'"\';\n')

    def test_messages(self):
        self.expect("a.cpp", 'auto a = "the colour of pictures";\n', '"colour": use color', '"pictures": use images')
        [finding] = self.check("a.cpp", 'auto a = "Who is younger is left out.";\n')
        self.assertIn("Who ...", finding)

    def test_documentation(self):
        self.expect("a.md", "The colour of a `colour`.\n\n```\ncolour = grey\n```\n", '"colour": use color')
        [finding] = self.check("a.md", "| `field` | Who is younger is left out. |\n")
        self.assertIn("Who ...", finding)
        self.assertEqual(
            self.check("a.py", '"""Wait.\n\nWhat lies beyond is skipped."""\nx = "colour"\n')[0][:6], '"What '
        )

    def test_this_tree(self):
        self.assertEqual(run(sys.executable, CHECK).stdout, "")


unittest.main()
