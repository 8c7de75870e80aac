#!/usr/bin/env python3
"""The rules of modules and of the folders in them (docs/architecture.md), checked whenever the build is configured.

usage: scripts/module_rules.py check ROOT [MODULE...]      MODULE: those of this build; default: all
       scripts/module_rules.py headers ROOT MODULE         what other programs need of a module: its public headers, and
                                                           those of its own that they include

A file of a module may include any header of its module, and public headers of the modules that it declares. Tests of a
module (tests/MODULE/) and its benchmark (bench/MODULE.cpp) may include any header of it and of modules in its folder; other
tests, benchmarks, examples, scripts and Python's module public ones only, unless throng_allow_private names file and header. A module declares no
module that it does not include, and none after it in THRONG_ALL_MODULES. A public header exists and is included from
outside of the module, unless the module is in THRONG_LIBRARY_MODULES. A module is not linked with what it REFUSES, be it
through others.

Readers of other people's datasets open files by base/files/untrusted_folders.h only, which follows no links.

A top-level folder is a floor: no two of them include each other.

A module declares all folders in it by throng_folder(), its own one ("."), too. A file in one may include its own folder
and those that the folder USES, which precede it. The module's own folder is an interface below the folders that follow it,
which may include it, and a façade above those that precede it, which it may include: neither needs USES.
"""
import dataclasses
import functools
import os
import pathlib
import re
import sys

KEYWORDS = {"PUBLIC", "SOURCES", "MODULES", "LIBRARIES", "PRIVATE_LIBRARIES", "REFUSES"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">\n]+)[">]', re.M)
MAX_FILES = 40  # of a folder
READS_DATASETS = ("formats", "jobs/bucket")
OPENS_A_FILE = re.compile(r"\bifstream \w+[({]|\bfopen\(|\bO_RDONLY\b|\bcopy_file\(|\bcreate_hard_link\(|\bH5Fopen\(")


@dataclasses.dataclass
class Folder:
    path: str
    purpose: str
    uses: list[str]


@dataclasses.dataclass
class Module:
    name: str
    public: list[str]  # paths
    modules: list[str]
    refused: list[str]
    folders: dict[str, Folder]  # by path, in the order of their declaration


def calls(text, name):
    """Arguments of each call of a CMake command; quoted ones are kept as one."""
    text = re.sub(r"(?m)^\s*#.*$|\s#[^\"\n]*$", "", text)
    for found in re.finditer(rf"\b{name}\(((?:[^()\"]|\"[^\"]*\"|\([^()]*\))*)\)", text):
        yield [word.strip('"') for word in re.findall(r'"[^"]*"|[^\s"]+', found[1])]


def nearest(headers, header):
    """The headers of the same folder, if there are any: a list for a message."""
    beside = [other for other in headers if os.path.dirname(other) == os.path.dirname(header)]
    return beside or headers


def by_keyword(words):
    groups, current = {}, None
    for word in words:
        if word in KEYWORDS | {"USES"}:
            current = groups.setdefault(word, [])
        elif current is not None:
            current.append(word)
    return groups


class Structure:
    """Modules and folders of a checkout, and the includes between its files. Paths are relative to its root."""

    def __init__(self, root):
        self.root = pathlib.Path(root).resolve()
        top = self.text("CMakeLists.txt") + (self.text("cmake/Install.cmake") or "")
        lists = {words[0]: words[1:] for words in calls(top, "set") if words}
        self.order = lists.get("THRONG_ALL_MODULES", [])
        self.libraries = lists.get("THRONG_LIBRARY_MODULES", [])
        self.exceptions = [(words[0], header) for words in calls(top, "throng_allow_private") for header in words[1:]]
        self.modules = {}
        for name in self.order:
            text = self.text(f"{name}/CMakeLists.txt")
            for words in calls(text or "", "throng_module"):
                groups = by_keyword(words[1:])
                public = [f"{name}/{header}" for header in groups.get("PUBLIC", [])]
                self.modules[name] = Module(name, public, groups.get("MODULES", []), groups.get("REFUSES", []), {})
            for path, purpose, *words in calls(text or "", "throng_folder"):
                folder = Folder(
                    os.path.normpath(f"{name}/{path}"),
                    purpose,
                    [f"{name}/{used}" for used in by_keyword(words).get("USES", [])],
                )
                self.modules[name].folders[folder.path] = folder

    def text(self, path):
        file = self.root / path
        return file.read_text(errors="replace", encoding="utf-8") if file.is_file() else None

    @functools.cached_property
    def files(self):
        """All C++ files of modules, tests, benchmarks, examples, scripts and the module of Python."""
        tops = dict.fromkeys(
            [name.split("/")[0] for name in self.order] + ["tests", "bench", "examples", "scripts", "python"]
        )
        found = []
        for top in tops:
            for folder, inner, names in os.walk(self.root / top):
                inner[:] = [name for name in inner if name != "build"]
                found += [os.path.relpath(os.path.join(folder, name), self.root) for name in names]
        return sorted(path for path in found if path.endswith((".h", ".cpp")))

    @functools.cache
    def module_of(self, path):
        """The innermost module that a path belongs to: jobs/queue/store/store.h is in jobs/queue, and sim/sensors/wind.h in sim, since
        sim/sensors is no module. None for a path in no module."""
        folder = os.path.dirname(path)
        while folder and folder not in self.order:
            folder = os.path.dirname(folder)
        return folder or None

    @functools.cache
    def includes(self, path):
        """(header, line) of the project's headers that a file includes."""
        text = self.text(path) or ""
        found = []
        for include in INCLUDE.finditer(text):
            beside = os.path.normpath(os.path.join(os.path.dirname(path), include[2]))
            line = text.count("\n", 0, include.start(1)) + 1
            if include[1] == '"' and (self.root / beside).is_file():
                found.append((beside, line))
            elif "/" in include[2] and (self.root / include[2]).is_file():
                found.append((include[2], line))
        return found

    def home_of(self, path):
        """The module whose private headers a file outside of modules may include."""
        if path.startswith("tests/"):
            return self.module_of(path.removeprefix("tests/"))
        bench = re.fullmatch(r"bench/([a-z_]+)\.cpp", path)
        return bench[1] if bench and bench[1] in self.order else None

    def interface_headers(self, name):
        """The public headers of a module, and those of the module that they include."""
        todo, headers = list(self.modules[name].public), []
        while todo:
            header = todo.pop(0)
            if header not in headers and self.module_of(header) == name:
                headers.append(header)
                todo += [included for included, _ in self.includes(header)]
        return headers

    def linked(self, name):
        """The modules that one is linked with, itself included."""
        seen, todo = set(), [name]
        while todo:
            name = todo.pop()
            if name not in seen:
                seen.add(name)
                todo += self.modules[name].modules if name in self.modules else []
        return seen


class Check:
    """Violations of the rules, for the modules of one build."""

    def __init__(self, structure, declared):
        self.of = structure
        self.declared = [name for name in structure.modules if not declared or name in declared]
        self.violations = []
        self.dependencies = set()  # (module, module) that includes need
        self.outside = set()  # headers that are included from outside of their module
        self.needed = set()  # (file, header) that an exception may be for
        self.stairs = {}  # (top-level folder, top-level folder) -> place and header of an include between them

    def run(self):
        for path in self.of.files:
            for header, line in self.of.includes(path):
                self.judge(path, header, line)
        for (lower, upper), (place, header) in sorted(self.stairs.items()):
            if lower < upper and (upper, lower) in self.stairs:
                self.violations.append(
                    f"{place}: includes {header}, but '{upper}' includes '{lower}', too ({self.stairs[upper, lower][0]}), "
                    "and a top-level folder is a floor"
                )
        for path in self.of.files:
            if self.of.module_of(path) in READS_DATASETS:
                self.check_opening(path)
        for name in self.declared:
            self.check_declaration(self.of.modules[name])
            self.check_folders(self.of.modules[name])
        for path, header in self.of.exceptions:
            module = self.of.modules.get(self.of.module_of(header))
            if (path, header) not in self.needed or (module and header in module.public):
                self.violations.append(
                    f"throng_allow_private: {path} includes {header} is an exception that nothing needs; remove it"
                )
        return self.violations

    def judge(self, path, header, line):
        owner, home, module = self.of.module_of(path), self.of.home_of(path), self.of.module_of(header)
        if module is None or module == owner:
            return self.judge_folders(path, header, line) if owner in self.declared else None
        self.dependencies.add((owner, module))
        if owner is not None and owner.split("/")[0] != module.split("/")[0]:
            self.stairs.setdefault((owner.split("/")[0], module.split("/")[0]), (f"{path}:{line}", header))
        if home and f"{module}/".startswith(f"{home}/"):
            return
        self.outside.add(header)
        self.needed.add((path, header))
        # Of modules that are left out of this build, nothing is known.
        if (owner is None and module not in self.declared) or (owner is not None and owner not in self.declared):
            return
        refused = f"{path}:{line}: includes {header}, but"
        public = self.of.modules[module].public if module in self.of.modules else []
        if owner is not None and module not in self.of.modules[owner].modules:
            self.violations.append(
                f"{refused} module '{owner}' does not declare module '{module}' (MODULES in {owner}/CMakeLists.txt)"
            )
        elif header not in public and (path, header) not in self.of.exceptions:
            self.violations.append(
                f"{refused} this is a private header of module '{module}' (its public headers: {', '.join(nearest(public, header))})"
            )

    def judge_folders(self, path, header, line):
        module = self.of.module_of(path)
        folders = self.of.modules[module].folders if module else {}
        here, there = os.path.dirname(path), os.path.dirname(header)
        if not folders or here == there or there not in folders or here not in folders:
            return
        if module in (here, there):
            order = list(folders)
            if order.index(there) > order.index(here):
                self.violations.append(
                    f"{path}:{line}: includes {header}, but folder '{here}' precedes '{there}' in {module}/CMakeLists.txt; the "
                    "own folder of a module is below those that follow it and above those that precede it"
                )
        elif there not in folders[here].uses:
            self.violations.append(
                f"{path}:{line}: includes {header}, but folder '{here}' does not use '{there}' (USES in {module}/CMakeLists.txt)"
            )

    def check_opening(self, path):
        for number, line in enumerate((self.of.root / path).read_text(encoding="utf-8").splitlines(), 1):
            if found := OPENS_A_FILE.search(line):
                self.violations.append(
                    f"{path}:{number}: {found[0]} follows links, which datasets of others may have; use open_stream(), "
                    "open_for_reading() or link_or_copy()"
                )

    def check_declaration(self, module):
        where = f"{module.name}/CMakeLists.txt: module '{module.name}'"
        level = self.of.order.index(module.name)
        for name in module.modules:
            if name not in self.of.order[:level]:
                self.violations.append(
                    f"{where} declares '{name}', which does not precede it in THRONG_ALL_MODULES (CMakeLists.txt)"
                )
            elif (module.name, name) not in self.dependencies:
                self.violations.append(f"{where} declares module '{name}', but includes none of its headers")
        for header in module.public:
            stated = f"{module.name}/CMakeLists.txt: public header {header} is"
            if self.of.module_of(header) != module.name or not (self.of.root / header).is_file():
                self.violations.append(f"{stated} not a file of module '{module.name}'")
            elif module.name not in self.of.libraries and header not in self.outside:
                self.violations.append(
                    f"{stated} included by no file outside module '{module.name}'; remove it from PUBLIC"
                )
        for name in sorted(self.of.linked(module.name) & set(module.refused)):
            self.violations.append(f"{where} is linked with module '{name}', which it is to do without")

    def check_folders(self, module):
        own = [path for path in self.of.files if self.of.module_of(path) == module.name]
        sizes = {}
        for path in own:
            sizes.setdefault(os.path.dirname(path), []).append(path)
        where = f"{module.name}/CMakeLists.txt: folder"
        for folder, files in sizes.items():
            if len(files) > MAX_FILES:
                self.violations.append(f"{where} '{folder}' holds {len(files)} files, expected at most {MAX_FILES}")
            if folder not in module.folders:
                self.violations.append(f"{where} '{folder}' is not declared (throng_folder)")
        before = []
        for folder in module.folders.values():
            if folder.path not in sizes and folder.path != module.name:
                self.violations.append(f"{where} '{folder.path}' holds no C++ file")
            for used in folder.uses:
                included = any(
                    os.path.dirname(header) == used
                    for path in sizes.get(folder.path, [])
                    for header, _ in self.of.includes(path)
                )
                if used not in before:
                    self.violations.append(f"{where} '{folder.path}' uses '{used}', which is not declared before it")
                elif not included:
                    self.violations.append(f"{where} '{folder.path}' uses '{used}', but includes none of its headers")
            before.append(folder.path)


def main():
    command, root, *modules = sys.argv[1:]
    structure = Structure(root)
    if command == "headers":
        print("\n".join(structure.interface_headers(modules[0])))
        return
    violations = Check(structure, modules).run()
    if violations:
        print("rules of modules (scripts/module_rules.py) are broken:\n  " + "\n  ".join(violations), file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
