"""scripts/check_limits.py: ranges that two tables of fields write in figures."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_limits.py"


class CheckLimits(unittest.TestCase):
    def checked(self, **rows):
        """The result for a checkout in which each file NAME.cpp has this row of a table."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["git", "init", "-q", folder], check=True)
            for name, row in rows.items():
                (pathlib.Path(folder) / f"{name}.cpp").write_text(f"void f() {{\n  {row}\n}}\n", encoding="utf-8")
            subprocess.run(["git", "-C", folder, "add", "."], check=True)
            return subprocess.run([sys.executable, CHECK, folder], capture_output=True, encoding="utf-8", check=False)

    def test_a_range_in_two_files_is_refused(self):
        result = self.checked(
            job='table.add("crowd/agents", "Agents", "", integers(1, 1000000), at(&Job::agents), "");',
            mix='table.add("agents", "Agents", "",\n      fields::integers(1, 1\'000\'000), at(&Mix::agents), "");',
        )
        self.assertEqual(result.returncode, 1)
        self.assertIn('"agents" is in job.cpp and mix.cpp', result.stderr)

    def test_named_and_other_ranges_pass(self):
        result = self.checked(
            job='table.add("agents", "", "", integers(1, kMaxAgents), at(&Job::agents), "");',
            mix='table.add("agents", "", "", integers(1, kMaxAgents), at(&Mix::agents), "");',
            share='table.add("share", "", "", numbers(0, 1), at(&Job::share), "");',
            other='table.add("share", "", "", numbers(0, 1), at(&Mix::share), "");',
            high='table.add("height_m", "", "", numbers(0, 10), at(&Job::height_m), "");',
            low='table.add("height_m", "", "", numbers(0, 5), at(&Mix::height_m), "");',
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
