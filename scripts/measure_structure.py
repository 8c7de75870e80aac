#!/usr/bin/env python3
"""Measures the structure of the source code: sizes, public headers, cycles, function lengths, words, tests.

usage: scripts/measure_structure.py [FOLDER...] >docs/reference/structure.md    (default: this checkout; two folders: before → after)

Prints a Markdown table of the folders of modules, and one of figures with a row per top-level folder with C++ sources. Columns:
  .cpp, .h    number of files, each with its lines in the next column
  public      headers that the modules in the folder declare as PUBLIC
  folders     that hold them, and the files of the largest
  cycles      #includes that close a cycle between files of the module (NAME.h and NAME.cpp are one file)
  functions   number, and lines of the median, the 90 % quantile and the longest
  words       coined words, British spelling and clauses without antecedent that scripts/check_language.py finds
  tests       lines of tests per line of product code
"""
import collections
import pathlib
import re
import subprocess
import sys

import check_language
import module_rules

ROOT = pathlib.Path(__file__).resolve().parent.parent
APART = {"tests", "bench", "examples", "scripts"}
SKIPPED = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'')
FUNCTION = re.compile(
    r"\)\s*(?:const\s*)?(?:noexcept\s*)?(?:override\s*)?(?:final\s*)?(?:->\s*[\w:<>&*, ]+\s*)?"
    r"(?::\s*[\w:]+[({].*)?\{\s*$"
)


def language_findings(path, text):
    """Number of findings of scripts/check_language.py."""
    report = check_language.Report(path, text)
    check_language.check_code(report)
    return len(report.findings)


def git_files(root):
    """Paths of the checkout's C++ files."""
    listed = subprocess.run(
        ["git", "ls-files", "*.cpp", "*.h"], check=True, capture_output=True, encoding="utf-8", cwd=root
    )
    return [path for path in listed.stdout.split() if (root / path).exists()]


def function_lengths(text):
    """Lines of each function body, header and braces included: blocks that follow a parameter list at the outermost
    level of classes and namespaces."""
    lengths, stack = [], []
    for number, line in enumerate(SKIPPED.sub("", text).split("\n")):
        opens_function = bool(FUNCTION.search(line)) and not re.match(
            r"\s*(if|for|while|switch|else|catch|do|return)\b", line
        )
        for place, letter in enumerate(line):
            if letter == "{":
                inside = any(kind for kind, _ in stack)
                stack.append((opens_function and not inside and place == len(line.rstrip()) - 1, number))
            elif letter == "}" and stack:
                is_function, first = stack.pop()
                if is_function:
                    lengths.append(number - first + 1)
    return lengths


def cycle_edges(edges):
    """Number of edges that a depth-first search finds to lead back to a file that it is in."""
    state, back = {}, 0

    def visit(start):
        nonlocal back
        todo = [(start, iter(sorted(edges.get(start, ()))))]
        state[start] = 1
        while todo:
            node, rest = todo[-1]
            following = next(rest, None)
            if following is None:
                state[node] = 2
                todo.pop()
            elif state.get(following) == 1:
                back += 1
            elif following not in state:
                state[following] = 1
                todo.append((following, iter(sorted(edges.get(following, ())))))

    for node in sorted(edges):
        if node not in state:
            visit(node)
    return back


def quantile(values, share):
    """Nearest rank."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else 0


HEAD = [
    "module",
    ".cpp, lines",
    ".h, lines",
    "public",
    "folders (largest)",
    "cycles",
    "functions",
    "median/p90/max",
    "words",
    "tests",
]


def measure(root):
    """Rows of the table by module, and their sum."""
    texts = {path: (root / path).read_text(errors="replace", encoding="utf-8") for path in git_files(root)}
    product = {path: text for path, text in texts.items() if path.split("/")[0] not in APART}
    includes = {path: re.findall(r'^#include "([^"]+)"', text, re.M) for path, text in product.items()}
    structure = module_rules.Structure(root)
    public = {header for module in structure.modules.values() for header in module.public}
    table, everything, sums = {}, [], [0] * 9
    for module in sorted({path.split("/")[0] for path in product}):
        own = {path: text for path, text in product.items() if path.split("/")[0] == module}
        lines = {path: text.count("\n") for path, text in own.items()}
        sources = [path for path in own if path.endswith(".cpp")]
        headers = [path for path in own if path.endswith(".h")]
        edges = {}
        for path in own:
            name = path.rsplit(".", 1)[0]
            targets = {target.rsplit(".", 1)[0] for target in includes[path] if target in own}
            edges.setdefault(name, set()).update(targets - {name})
        lengths = [length for path in sources for length in function_lengths(own[path])]
        everything += lengths
        counts = [
            len(sources),
            sum(lines[p] for p in sources),
            len(headers),
            sum(lines[p] for p in headers),
            sum(path in public for path in headers),
            cycle_edges(edges),
            len(lengths),
            sum(language_findings(path, text) for path, text in own.items()),
            sum(text.count("\n") for path, text in texts.items() if path.startswith(f"tests/{module}/")),
        ]
        sums = [a + b for a, b in zip(sums, counts)]
        folders = collections.Counter(path.rsplit("/", 1)[0] for path in own)
        table[module] = table_row(counts, lengths, f"{len(folders)} ({max(folders.values())})")
    table["**all**"] = table_row(sums, everything, "")
    return table


def table_row(counts, lengths, folders):
    sources, source_lines, headers, header_lines, public, cycles, functions, words, tests = counts
    quantiles = f"{quantile(lengths, .5)}/{quantile(lengths, .9)}/{max(lengths, default=0)}"
    return [
        f"{sources}, {source_lines}",
        f"{headers}, {header_lines}",
        str(public),
        folders,
        str(cycles),
        str(functions),
        quantiles,
        str(words),
        f"{tests / (source_lines + header_lines):.2f}",
    ]


def print_table(head, rows):
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def folder_rows(root):
    """A row per folder of a module: what it is for, the folders that it uses, its files."""
    structure = module_rules.Structure(root)
    files = collections.Counter(path.rsplit("/", 1)[0] for path in git_files(root))
    for module in structure.modules.values():
        for folder in module.folders.values():
            name = f"**{folder.path}**" if folder.path == module.name else folder.path
            uses = " ".join(
                module.modules if folder.path == module.name else [u[len(module.name) + 1 :] for u in folder.uses]
            )
            yield [name, folder.purpose, uses, str(files[folder.path])]


def main():
    roots = [pathlib.Path(folder).resolve() for folder in sys.argv[1:]] or [ROOT]
    tables = [measure(root) for root in roots]
    print(
        "# Structure in figures\n\nMade by `scripts/measure_structure.py` (its head explains the columns); do not edit.\n"
    )
    rows = []
    for module in tables[-1]:
        compared = [table.get(module, ["-"] * (len(HEAD) - 1)) for table in tables]
        cells = [values[0] if len(set(values)) == 1 else " → ".join(values) for values in zip(*compared)]
        rows.append([module, *cells])
    print_table(HEAD, rows)
    print(
        "\n## Folders\n\nModules are in bold, from the lowest layer to the highest, with the modules that they use; below them their folders.\n"
    )
    print_table(["folder", "purpose", "uses", "files"], folder_rows(roots[-1]))


if __name__ == "__main__":
    main()
