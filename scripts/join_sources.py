#!/usr/bin/env python3
"""Joins the product's sources into a few files for clang-tidy, which spends most of its time on the files' headers.

usage: scripts/join_sources.py COUNT BUILD FOLDER

Writes FOLDER/joined_N.cpp, which include the sources that git lists, and FOLDER/compile_commands.json with the flags of
the build folder BUILD. Files of one module whose unnamed namespaces define the same name, or that use a constant which
another one defines, go to different files; files for another version of C++ stay alone. Sources that include CLI11 have
files of their own: performance-unnecessary-value-param searches a whole file for each of that header's 120 parameters
that it would report, which takes two minutes. There may be more than COUNT files when the names ask for it. Prints the
paths.
"""
import json
import pathlib
import re
import subprocess
import sys

from compile_flags import macros_and_folders, with_own_standard

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
TYPE = re.compile(r"\b(?:struct|class|enum(?: class)?|using)\s+(\w+)\s*(?:final\s*)?[:{=]")
CONSTANT = re.compile(r"\b(k[A-Z]\w*)\s*(?:\[[^\]]*\]\s*)?(?:=|\{)")
FUNCTION = re.compile(r"^(?:template.*>\s*)?[\w:<>,*&\s]*?[\s*&](\w+)\([^;]*?\)\s*(?:const\s*)?\{", re.M)
ENUMERATORS = re.compile(r"\benum\s+\w+[^{;]*\{([^}]*)\}")


class Source:
    """A file, the names that its unnamed namespaces define, and the constants that it uses."""

    def __init__(self, path):
        self.path = path
        self.module = path.split("/")[0]
        text = (ROOT / path).read_text(encoding="utf-8")
        self.uses_cli11 = "#include <CLI/" in text
        text = COMMENT.sub(" ", text)
        self.lines = text.count("\n")
        hidden = self.unnamed(text)
        self.defines = set(TYPE.findall(hidden)) | set(CONSTANT.findall(hidden)) | set(FUNCTION.findall(hidden))
        for names in ENUMERATORS.findall(hidden):
            self.defines |= set(re.findall(r"\w+", names))
        self.words = set(re.findall(r"\b\w+\b", text))

    @staticmethod
    def unnamed(text):
        """The text of the unnamed namespaces."""
        parts = []
        for match in re.finditer(r"\bnamespace\s*\{", text):
            depth, end = 1, match.end()
            while depth and end < len(text):
                depth += {"{": 1, "}": -1}.get(text[end], 0)
                end += 1
            parts.append(text[match.end() : end])
        return "\n".join(parts)

    def clashes(self, other):
        """Whether the two cannot be in one file."""
        if self.module != other.module:
            return False
        shared = self.defines & other.defines
        used = (self.defines & other.words) | (other.defines & self.words)
        return bool(shared) or any(re.match(r"k[A-Z]", name) for name in used)


def joined(sources, count):
    """Lists of sources that can be compiled as one, of about the same size."""
    share = sum(source.lines for source in sources) / count
    units, before = [[] for _ in range(count)], 0
    for source in sources:
        wanted = min(int(before / share), count - 1)
        order = list(range(wanted, len(units))) + list(range(wanted))
        place = next((i for i in order if not any(source.clashes(other) for other in units[i])), None)
        if place is None:
            units.append([])
            place = len(units) - 1
        units[place].append(source)
        before += source.lines
    return units


def included(path):
    """The line that includes a source; each program's main() under a name of its own."""
    line = f'#include "{path}"\n'
    if "\nint main(" not in path.read_text(encoding="utf-8"):
        return line
    return f"#define main main_of_{path.stem}\n{line}#undef main\n"


def main():
    count, build, folder = int(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]).absolute()
    listed = subprocess.run(
        ["git", "ls-files", "*.cpp"], check=True, capture_output=True, encoding="utf-8", cwd=ROOT
    ).stdout
    alone = with_own_standard(build)
    apart = {entry["file"] for entry in alone}
    sources = [
        Source(path)
        for path in listed.split()
        if not path.startswith(("tests/", "bench/", "examples/", "scripts/", "python/"))
        and (ROOT / path).exists()
        and str(ROOT / path) not in apart
    ]
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("joined_*.cpp"):
        old.unlink()
    entries = list(alone)
    flags = macros_and_folders(build)
    with_cli11 = [source for source in sources if source.uses_cli11]
    without = [source for source in sources if not source.uses_cli11]
    for number, unit in enumerate(joined(with_cli11, 1) + joined(without, count)):
        file = folder / f"joined_{number}.cpp"
        file.write_text("".join(included(ROOT / source.path) for source in unit), encoding="utf-8")
        entries.append(
            {
                "directory": str(folder),
                "file": str(file),
                "arguments": ["clang++", *flags, "-c", str(file), "-o", str(file.with_suffix(".o"))],
            }
        )
    (folder / "compile_commands.json").write_text(json.dumps(entries, indent=1), encoding="utf-8")
    print("\n".join(entry["file"] for entry in entries))


if __name__ == "__main__":
    main()
