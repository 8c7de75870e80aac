#!/usr/bin/env python3
"""Refuses files that do not belong in the repository: unknown places and kinds of files, too large ones, images of docs/
that no script makes, and long lines of documents.

usage: scripts/check_tree.py [ROOT]
"""
import fnmatch
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "sheets"))
from doc_images import maker  # noqa: E402

MODULES = "annotate base calibration camera checks cli crowd formats jobs live metrics places render server sim skinning spec validation world".split()
CODE_FOLDERS = [*MODULES, "bench", "examples", "python/engine", "scripts", "tests"]
# Files, and the largest size of one in KiB. The first rule that names a file holds for it; a * matches slashes, too.
RULES = [
    *((f"{folder}/*.{ending}", 32) for folder in CODE_FOLDERS for ending in ("cpp", "h")),
    *((f"{folder}/*CMakeLists.txt", 16) for folder in CODE_FOLDERS),
    ("CMakeLists.txt", 16),
    ("cmake/*", 16),
    ("render/shaders/*.glsl", 32),
    ("render/props/shapes/*.json", 24),
    ("crowd/models/ttc_posterior.csv", 64),
    ("spec/*.json", 96),
    ("python/throng/layouts.json", 16),
    ("skinning/assets/*.json", 16),
    ("server/throng.service", 8),
    ("python/throng/*.py", 48),
    ("python/generate_types.py", 16),
    ("python/notebooks/*.ipynb", 320),
    *((f"python/{name}", 16) for name in ("LICENSE", "README.md", "pyproject.toml", "throng/py.typed")),
    ("web/package-lock.json", 128),
    *((f"web/*.{ending}", 32) for ending in ("ts", "tsx", "css", "js", "mjs", "json", "html", "svg", "txt")),
    *((f"scenarios/*.{ending}", 64) for ending in ("json", "xml")),
    *((f"{folder}/*.{ending}", 32) for folder in ("bench", "scripts", "examples", "tests")
      for ending in ("py", "sh", "mjs", "yaml", "yml")),
    ("scripts/packages.txt", 8),
    ("docker/*", 16),
    (".ci/run", 1),
    ("docs/*.md", 80),
    ("docs/*.jpg", 800),
    ("docs/*.png", 100),
    ("docs/*.svg", 500),
    ("tests/fuzz/corpus/*", 16),
    *((f"tests/*.{ending}", 64) for ending in (
        "bin", "c", "config", "dict", "gz", "json", "jsonl", "obj", "osm", "sdf", "supp", "tar", "urdf", "xml", "zip")),
    *((name, 48) for name in (
        "CHANGELOG.md", "CMakePresets.json", "CONTRIBUTING.md", "LICENSE", "NOTICE", "README.md", "SECURITY.md",
        "biome.jsonc", ".clang-format", ".clang-tidy", ".dockerignore", ".gitignore", ".shellcheckrc")),
]  # fmt: skip
LINKS = ["python/LICENSE"]
MAX_LINE = 160  # characters of a paragraph; of a table, a text in quotes or what a program writes they may be more


def problem(root, name):
    """The problem with a file of the repository; None if there is none."""
    limit_kib = next((limit for pattern, limit in RULES if fnmatch.fnmatchcase(name, pattern)), None)
    if limit_kib is None:
        return "no rule of scripts/check_tree.py has a file of this kind here"
    file = root / name
    if file.is_symlink() and name not in LINKS:
        return "found a link, expected a file"
    size = file.stat().st_size
    if size > limit_kib * 1024:
        return f"found {-(-size // 1024)} KiB, expected at most {limit_kib} (scripts/check_tree.py)"
    if name.startswith("docs/") and file.suffix in (".jpg", ".png", ".svg") and not maker(name.removeprefix("docs/")):
        return "no script makes this image (scripts/sheets/doc_images.py)"
    if name.endswith((".md", "CMakeLists.txt")) and not name.startswith("docs/reference/"):
        text = re.sub(
            r"^```.*?^```",
            lambda block: "\n" * block[0].count("\n"),
            file.read_text(encoding="utf-8"),
            flags=re.M | re.S,
        )
        for number, line in enumerate(text.splitlines(), 1):
            if (
                len(line) > MAX_LINE
                and not line.startswith("|")
                and not (name.endswith("CMakeLists.txt") and '"' in line)
            ):
                return f"line {number}: found {len(line)} characters, expected at most {MAX_LINE}"
    return None


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__ + "/../..").resolve()
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root, check=True, capture_output=True, encoding="utf-8",
    ).stdout  # fmt: skip
    names = sorted(name for name in listed.split("\0") if name and (root / name).exists())
    wrong = [f"{name}: {what}" for name in names if (what := problem(root, name))]
    print("\n".join(wrong), end="\n" if wrong else "")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
