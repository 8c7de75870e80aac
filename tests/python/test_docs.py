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
import types
import unittest

import common
from service import start_service


class Examples(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
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

    @unittest.skipUnless(os.environ.get("THRONG_LONG"), "in the long test")
    @unittest.skipUnless(common.has("matplotlib"), "matplotlib is not installed")
    def test_the_notebooks(self):
        """Without Jupyter: Debian's nbclient and a kernel are 40 packages."""
        if not importlib.util.find_spec("IPython"):
            display = types.ModuleType("IPython.display")
            display.HTML = str
            sys.modules.update({"IPython": types.ModuleType("IPython"), "IPython.display": display})
            sys.modules["IPython"].get_ipython = lambda: None
        for path in sorted((common.ROOT / "python/notebooks").glob("*.ipynb")):
            notebook = json.loads(path.read_text())
            self.assertEqual(
                (notebook["nbformat"], len({c["id"] for c in notebook["cells"]})), (4, len(notebook["cells"]))
            )
            namespace = {}
            for cell in notebook["cells"]:
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), "kept without outputs")
                    exec(compile("".join(cell["source"]), f"{path.name} {cell['id']}", "exec"), namespace)  # noqa: S102
            self.assertEqual(len(namespace["times"]), 60)


if __name__ == "__main__":
    common.main()
