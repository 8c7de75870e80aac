"""The pages of docs/reference are those that scripts/reference_pages.py makes of the program."""
import sys
import unittest

from program import ROOT, THRONG, run


class Reference(unittest.TestCase):
    def test_pages_are_up_to_date(self):
        run(sys.executable, ROOT / "scripts/reference_pages.py", THRONG, "--check")


if __name__ == "__main__":
    unittest.main()
