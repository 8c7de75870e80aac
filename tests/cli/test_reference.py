"""The pages of docs/reference are those that scripts/reference_pages.py makes of the program."""
import pathlib
import subprocess
import sys
import unittest

THRONG = sys.argv.pop(1)
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "reference_pages.py"


class Reference(unittest.TestCase):
    def test_pages_are_up_to_date(self):
        done = subprocess.run([sys.executable, SCRIPT, THRONG, "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
