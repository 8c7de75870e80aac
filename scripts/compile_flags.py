"""Compiler flags of the whole project, from a build folder's compile_commands.json."""
import json
import pathlib
import shlex


def cpp_entries(build):
    """The entries of the build's compile_commands.json that are C++: assembly and C have other flags."""
    entries = json.loads((pathlib.Path(build) / "compile_commands.json").read_text(encoding="utf-8"))
    return [entry for entry in entries if pathlib.Path(entry["file"]).suffix in (".cpp", ".cxx")]


def macros_and_folders(build):
    """All macros and include folders that any file of the build is compiled with. If files differ about a macro's
    value, the first one counts: good enough for parsing, not for a program."""
    flags = {}
    for entry in cpp_entries(build):
        words = shlex.split(entry["command"])
        for word, following in zip(words, words[1:] + [""]):
            if word.startswith("-D"):
                flags.setdefault(word.split("=")[0], [word])
            elif word.startswith("-I"):
                flags.setdefault(word, [word])
            elif word == "-isystem":
                flags.setdefault(word + following, [word, following])
    return ["-std=c++20", "-fwrapv"] + [flag for group in flags.values() for flag in group]


def with_own_standard(build):
    """The files that are compiled for another version of C++ than the rest, as entries of compile_commands.json."""

    def standard(entry):
        return [word for word in shlex.split(entry["command"]) if word.startswith("-std=")][-1:]

    return [entry for entry in cpp_entries(build) if standard(entry) not in ([], ["-std=c++20"], ["-std=gnu++20"])]
