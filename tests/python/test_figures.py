"""A small part of the figures of docs/training.md, measured again: with $THRONG_LONG, since it takes minutes, and with 24
characters, as the page says."""
import os
import subprocess
import sys
import unittest

import common


@unittest.skipUnless(os.environ.get("THRONG_LONG"), "minutes of CPU time; with $THRONG_LONG")
@unittest.skipUnless(common.has("torch"), "torch, which is optional, is not installed")
class Page(unittest.TestCase):
    def test_a_part_of_the_figures(self):
        script = common.ROOT / "scripts/studies/training_figures.py"
        environment = {**os.environ, "THRONG": str(common.THRONG)}
        result = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True, env=environment)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    common.main()
