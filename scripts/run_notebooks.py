#!/usr/bin/python3
"""Runs the notebooks of python/notebooks and keeps in them what they print and draw, as a code host shows them.

usage: scripts/run_notebooks.py [NOTEBOOK...]     THRONG_PROGRAM, or build/release/cli/throng

Without Jupyter, whose packages are many: cells are executed in one namespace; what is kept is their text, the last
expression's repr, and figures of matplotlib as PNG. Notebooks hold no HTML, which code hosts do not show.
"""
import ast
import base64
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import types

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "python/notebooks"


def run_cell(source, name, namespace):
    """Executes a cell; gives what it printed with the last expression's repr, and its figures as PNG."""
    import matplotlib.pyplot as plt

    tree = ast.parse(source, name)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    is_shown = last is not None and not source.rstrip().endswith(";")
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
        exec(compile(tree, name, "exec"), namespace)  # noqa: S102
        if last is not None:
            value = eval(compile(ast.Expression(last.value), name, "eval"), namespace)  # noqa: S307
    figures = []
    for number in plt.get_fignums():
        png = io.BytesIO()
        plt.figure(number).savefig(png, format="png", dpi=72, bbox_inches="tight", metadata={"Software": None})
        figures.append(png.getvalue())
    plt.close("all")
    is_drawing = type(value).__module__.startswith("matplotlib")
    text = repr(value) if is_shown and value is not None and not is_drawing else ""
    return printed.getvalue(), text, figures


def make_outputs(printed, text, figures, count):
    """A cell's outputs as nbformat 4 has them."""
    outputs = []
    if printed:
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.splitlines(keepends=True)})
    if text:
        data = {"text/plain": text.splitlines(keepends=True)}
        outputs.append({"output_type": "execute_result", "execution_count": count, "data": data, "metadata": {}})
    for figure in figures:
        data = {"image/png": base64.b64encode(figure).decode(), "text/plain": ["<Figure>"]}
        outputs.append({"output_type": "display_data", "data": data, "metadata": {}})
    return outputs


def run_notebook(path):
    """The notebook with the outputs of this run, and the namespace of its cells."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    import matplotlib.pyplot as plt

    plt.close("all")
    namespace, count = {}, 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        count += 1
        result = run_cell("".join(cell["source"]), f"{path.name} {cell['id']}", namespace)
        cell["execution_count"] = count
        cell["outputs"] = make_outputs(*result, count)
    return notebook, namespace


def prepare():
    """The package, a display without a window, and the program."""
    sys.path.insert(0, str(ROOT / "python"))
    os.environ.setdefault("MPLBACKEND", "Agg")
    os.environ.setdefault("THRONG_PROGRAM", str(ROOT / "build/release/cli/throng"))
    if "IPython" not in sys.modules:
        shell = types.ModuleType("IPython")
        shell.get_ipython = lambda: None
        sys.modules["IPython"] = shell


def main():
    prepare()
    for path in map(pathlib.Path, sys.argv[1:] or sorted(map(str, NOTEBOOKS.glob("*.ipynb")))):
        path = path.resolve()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            notebook, _ = run_notebook(path)
            os.chdir(ROOT)
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
