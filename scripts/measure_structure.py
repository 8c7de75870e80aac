#!/usr/bin/env python3
"""Measures the structure of the source code: sizes, public headers, cycles, function lengths, words, tests.

usage: scripts/measure_structure.py [--compile BUILD] >docs/reference/structure.md
       scripts/measure_structure.py BEFORE AFTER            two checkouts: before → after

The first table, sizes, has the figures of the committed docs/reference/structure.md beside today's. --compile BUILD measures what
compiling costs (scripts/compile_cost.py, some minutes on an idle machine); without it the committed figures stay. Modules that
grew by more than a tenth are named on stderr: the commit's message says why.

Then come a table of figures with a row per top-level folder with C++ sources, one of the headers that cost most, one of the classes
with more than 15 members, and one of the folders of modules. Members are variables and functions, constructors included; destructors
and what is deleted or defaulted are left out. Columns of figures:
  .cpp, .h    number of files, each with its lines in the next column
  public      headers that the modules in the folder declare as PUBLIC
  folders     that hold them, and the files of the largest
  cycles      #includes that close a cycle between files of the module (NAME.h and NAME.cpp are one file)
  functions   number, and lines of the median, the 90 % quantile and the longest
  words       coined words, British spelling and clauses without antecedent that scripts/check_language.py finds
  tests       lines of tests per line of product code
"""
import collections
import datetime
import pathlib
import re
import subprocess
import sys

import check_language
import compile_cost
import module_rules

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMITTED = "docs/reference/structure.md"
APART = {"tests", "bench", "examples", "scripts"}
# Parts of the repository that are no module: name, and paths as git lists them.
PARTS = {
    "product, C++": [
        ":(exclude,top)tests",
        ":(exclude)bench",
        ":(exclude)examples",
        ":(exclude)scripts",
        "*.cpp",
        "*.h",
    ],
    "product, shaders": ["*.glsl"],
    "product, Python": ["python/*.py"],
    "product, web": ["web/*.ts", "web/*.tsx", "web/*.js", "web/*.mjs", "web/*.css"],
    "tests, C++": ["tests/*.cpp", "tests/*.h"],
    "tests, Python": ["tests/*.py"],
    "tests, web": ["tests/*.mjs", "tests/*.ts", "tests/*.js"],
    "scripts, benchmarks, examples": [
        "scripts/*.py",
        "scripts/*.sh",
        "scripts/*.cpp",
        "scripts/*.h",
        "bench/*",
        "examples/*",
    ],
}
SKIPPED = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'')
FUNCTION = re.compile(
    r"\)\s*(?:const\s*)?(?:noexcept\s*)?(?:override\s*)?(?:final\s*)?(?:->\s*[\w:<>&*, ]+\s*)?"
    r"(?::\s*[\w:]+[({].*)?\{\s*$"
)

# Declarations in a class that are not counted as members.
NO_MEMBER = re.compile(r"^\s*(using|friend|struct|class|enum|static_assert)\b|=\s*(delete|default)|~")
MAX_MEMBERS = 15


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


def member_counts(text):
    """{name: number of members} of the classes in a file."""
    text, counts = SKIPPED.sub("", text), {}
    # From the innermost braces outwards, so that only declarations of its own are left of a class's body.
    while block := re.search(r"(?:\bclass\s+(\w+)(?: final)?(?:\s*:[^:;{}()][^;{}()]*)?\s*)?\{([^{}]*)\}", text):
        before = text[: block.start()]
        if block[1]:
            declarations = re.split("[;\0]", re.sub(r"\b(public|private|protected):(?!:)", "", block[2]))
            counts[block[1]] = sum(bool(d.strip()) and not NO_MEMBER.search(d) for d in declarations)
        is_body = not block[1] and re.search(r"[)}][\w\s]*$|->[^;]*$", before)
        text = before + ("\0" if is_body else "") + text[block.end() :]
    return counts


def large_classes(root):
    """Rows of the classes with most members: module, and its classes."""
    found = collections.defaultdict(list)
    for path in git_files(root):
        if path.split("/")[0] not in APART:
            counts = member_counts((root / path).read_text(errors="replace", encoding="utf-8"))
            found[path.split("/")[0]] += [(-count, name) for name, count in counts.items() if count > MAX_MEMBERS]
    for module, classes in sorted(item for item in found.items() if item[1]):
        yield [module, ", ".join(f"{name} {-count}" for count, name in sorted(classes))]


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


def lines_of(patterns):
    """Lines of the files that git lists for the patterns."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", *patterns], check=True, capture_output=True, encoding="utf-8", cwd=ROOT
    ).stdout.split("\0")
    return sum((ROOT / path).read_bytes().count(b"\n") for path in listed if path and (ROOT / path).is_file())


def committed_rows():
    """The first table of the committed page: {name: (lines, CPU seconds)}, and the line that says when that was measured."""
    page = subprocess.run(["git", "show", f"HEAD:{COMMITTED}"], capture_output=True, encoding="utf-8", cwd=ROOT).stdout
    sizes, _, rest = page.partition("\n## Figures")
    rows = re.findall(r"^\| (\S[^|]*?) \| (\d+) \|[^|]*\| ([\d.]*) \|", sizes, re.M)
    measured = re.search(r"Compilers: .*", sizes)
    headers = re.search(r"^## Headers\n.*?(?=^## )", rest, re.M | re.S)
    return (
        {name: (int(lines), float(cpu or 0)) for name, lines, cpu in rows},
        measured[0] if measured else "Compilers: not measured yet.",
        headers[0] if headers else "",
    )


def changed(now, before):
    return f"{now - before:+}" if before and now != before else ""


def size_rows(sums, before):
    """Rows of the first table: modules, then the other parts. Names on stderr what grew by more than a tenth."""
    top_folders = sorted({name.split("/")[0] for name in module_rules.Structure(ROOT).modules})
    modules = {name: [f"{name}/*.cpp", f"{name}/*.h"] for name in top_folders}
    for name, patterns in {**modules, **PARTS}.items():
        lines = lines_of(patterns)
        cpu_s = sum(s for module, s in sums.items() if module.split("/")[0] == name or name == "product, C++")
        lines_before, cpu_before_s = before.get(name, (0, 0))
        if lines_before and lines > 1.1 * lines_before:
            print(f"{name}: {lines_before} → {lines} lines; say why in the commit's message", file=sys.stderr)
        cpu = [f"{cpu_s:.0f}", changed(round(cpu_s), round(cpu_before_s))] if cpu_s else ["", ""]
        yield [name, str(lines), changed(lines, lines_before), *cpu]


def print_sizes(build):
    """The first table. Returns the section about headers."""
    before, measured, headers = committed_rows()
    if build:
        sums = compile_cost.cpu_seconds(build)
        measured = (
            f"Compilers: processor seconds of g++ for all programs without ccache, measured on {datetime.date.today()}."
        )
        seconds, files = compile_cost.header_seconds(build)
        rows = "".join(f"| `{name}` | {s:.1f} | {files[name]} |\n" for name, s in seconds.most_common(20))
        headers = (
            "## Headers\n\nLibraries' headers that cost most: seconds of clang++ -O0 for those that the project's files include,"
            f" and how many compiled files do.\n\n| header | s | files |\n|---|---|---|\n{rows}\n"
        )
    else:
        sums = {name: cpu_s for name, (_, cpu_s) in before.items() if name not in PARTS}
    print("## Sizes\n\nLines, and their change since the page was committed last. " + measured + "\n")
    print_table(["part", "lines", "change", "compilers, s", "change"], size_rows(sums, before))
    return headers


def main():
    arguments = sys.argv[1:]
    build = arguments.pop(1) if arguments[:1] == ["--compile"] else None
    roots = [pathlib.Path(folder).resolve() for folder in arguments if folder != "--compile"] or [ROOT]
    print(
        "# Structure in figures\n\nMade by `scripts/measure_structure.py` (its head explains the columns); do not edit.\n"
    )
    headers = print_sizes(build) if roots == [ROOT] else ""
    print("\n## Figures\n")
    tables = [measure(root) for root in roots]
    rows = []
    for module in tables[-1]:
        compared = [table.get(module, ["-"] * (len(HEAD) - 1)) for table in tables]
        cells = [values[0] if len(set(values)) == 1 else " → ".join(values) for values in zip(*compared)]
        rows.append([module, *cells])
    print_table(HEAD, rows)
    print("\n" + headers, end="")
    print("## Large classes\n\nClasses with more than 15 members, and how many they have.\n")
    print_table(["module", "classes"], large_classes(roots[-1]))
    print(
        "\n## Folders\n\nModules are in bold, from the lowest layer to the highest, with the modules that they use; below them their folders.\n"
    )
    print_table(["folder", "purpose", "uses", "files"], folder_rows(roots[-1]))


if __name__ == "__main__":
    main()
