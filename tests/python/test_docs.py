"""Every example of docs/python.md, in its order and in one namespace, and the cells of the notebooks."""
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import common
from service import start_service


class Examples(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        os.environ["THRONG_PROGRAM"] = str(common.THRONG)

    def serve(self):
        server, port = start_service(common.THRONG, self.folder / "data")
        self.addCleanup(server.wait, 120)
        self.addCleanup(server.terminate)
        os.environ["THRONG_URL"] = f"http://127.0.0.1:{port}"

    def test_the_documentation(self):
        self.serve()
        (self.folder / "out").mkdir()
        (self.folder / "out/dataset").symlink_to(common.dataset_folder())
        subprocess.run(["tar", "-cf", "dataset.tar", "-C", common.run_folder(), "dataset"], check=True)
        text = (common.ROOT / "docs/python.md").read_text()
        namespace, ran = {}, 0
        for match in re.finditer(r"(?:<!-- needs ([\w ]+) -->\n)?```python\n(.*?)```", text, re.S):
            if not common.has(*(match[1] or "").split()):
                continue
            line = text[: match.start(2)].count("\n") + 1
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
                exec(compile("\n" * (line - 1) + match[2], "docs/python.md", "exec"), namespace)  # noqa: S102
            # The comment behind a print is its output.
            for said in re.findall(r"^ *print\(.*\) +# (.*)$", match[2], re.M):
                self.assertIn(said, printed.getvalue(), f"line {line}")
            ran += 1
        self.assertGreater(ran, 8)
        self.assertIn("60 people out after", self.printed(text, namespace))

    def printed(self, text, namespace):
        block = next(b for b in re.findall(r"```python\n(.*?)```", text, re.S) if "people out after" in b)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(block, namespace)  # noqa: S102
        return printed.getvalue()

    @unittest.skipUnless(common.has("matplotlib", "torch"), "matplotlib or torch is not installed")
    def test_the_notebooks(self):
        """Cells run, and the notebooks keep what such a run prints and draws: code hosts show only that."""
        sys.path.insert(0, str(common.ROOT / "scripts"))
        import run_notebooks

        run_notebooks.prepare()
        paths = sorted(run_notebooks.NOTEBOOKS.glob("*.ipynb"))
        min_pictures = {"first_dataset": 3, "first_evacuation": 3, "train_policy": 1}
        self.assertEqual([path.stem for path in paths], list(min_pictures))
        for path in paths:
            kept = json.loads(path.read_text())
            cells = kept["cells"]
            self.assertEqual((kept["nbformat"], len({c["id"] for c in cells})), (4, len(cells)))
            made, namespace = run_notebooks.run_notebook(self.shortened(path))
            for cell, again in zip(cells, made["cells"]):
                self.assertEqual(kinds_of(cell), kinds_of(again), f"{path.name} {cell['id']}: run_notebooks.py")
            pictures = [kind for cell in cells for kind in kinds_of(cell) if kind == "image/png"]
            self.assertGreaterEqual(len(pictures), min_pictures[path.stem], path.name)
            self.assertLess(path.stat().st_size, 600_000)
            if path.stem == "first_evacuation":
                self.assertEqual(len(namespace["times"]), 60)
            elif path.stem == "first_dataset":
                self.assertLess(namespace["losses"][-1], 0.8 * namespace["losses"][0])
            else:
                self.assertEqual(len(namespace["curve"]), 2)
                self.assertLess(min(namespace["learned"]), 70)

    def shortened(self, path):
        """The notebook, or a copy that trains for two generations of its twelve."""
        if path.stem != "train_policy":
            return path
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        copy = pathlib.Path(folder.name) / path.name
        text = path.read_text()
        self.assertIn("range(12)", text)
        copy.write_text(text.replace("range(12)", "range(2)"))
        return copy


def kinds_of(cell):
    """Kinds of a cell's outputs. Their texts depend on the character library."""
    return [output.get("name") or list(output["data"])[0] for output in cell.get("outputs", [])]


if __name__ == "__main__":
    common.main()
