import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from damages import runner  # noqa: E402 (the folder above must be on the path)

runner.main(*sys.argv[1:])
