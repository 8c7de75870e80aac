#!/usr/bin/env python3
"""Writes the part of docs/validation.md on recorded people, and its figures beside it, from a folder of recordings.

usage: scripts/studies/validation_page.py DATA [-m MODELS] [--seeds N] [--page PAGE] [--throng PROGRAM]

The part stands between two comments in the page; the recordings are not part of the repository.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from doc_blocks import replace_passage  # noqa: E402

FIGURES = ("_curves.svg", "_diagram.svg")


def generated_part(report):
    """The report of the program as a part of the page: without its title, with headings one level below."""
    text = re.sub(r"\A# .*\n+", "", report).replace(" (docs/validation.md says what is compared)", "")
    return re.sub(r"(?m)^(#+ )", r"#\1", text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("-m", "--models")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs/validation.md")
    parser.add_argument("--throng", default=ROOT / "build/release/cli/throng")
    arguments = parser.parse_args()
    page = arguments.page.read_text(encoding="utf-8")
    replace_passage(page, "recorded people", [])  # before an hour of simulations
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder, arguments.page.name)
        command = [arguments.throng, "validate-crowd", "--data", arguments.data, "--seeds", str(arguments.seeds)]
        command += ["-o", report] + (["-m", arguments.models] if arguments.models else [])
        subprocess.run(command, check=True)
        for ending in FIGURES:
            figure = report.with_name(report.stem + ending)
            if figure.exists():
                arguments.page.with_name(figure.name).write_bytes(figure.read_bytes())
        part = generated_part(report.read_text(encoding="utf-8"))
    arguments.page.write_text(replace_passage(page, "recorded people", ["", part]), encoding="utf-8")


if __name__ == "__main__":
    main()
