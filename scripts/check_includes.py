#!/usr/bin/env python3
"""Parses every source file by itself: proves that each includes the project's headers that it uses, which joined builds
do not show.

usage: scripts/check_includes.py BUILD [FILE...]    (default: all files that git lists)

Takes macros and include folders from BUILD/compile_commands.json. Headers of libraries are precompiled, since they take
most of the time; so a missing #include of a library that another file's header list below names goes unnoticed.
"""
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile

from compile_flags import macros_and_folders, with_own_standard

ROOT = pathlib.Path(__file__).resolve().parent.parent
PRECOMPILED = """algorithm array atomic bit charconv chrono cmath condition_variable cstdint cstdlib cstring deque exception
    filesystem fstream functional future iterator limits map memory mutex numbers numeric optional random regex set span
    sstream stdexcept stop_token string string_view thread tuple type_traits unordered_map utility variant vector
    Eigen/Core Eigen/Geometry Eigen/LU Eigen/SVD fmt/core.h fmt/format.h fmt/ranges.h nlohmann/json.hpp gtest/gtest.h
    gmock/gmock.h CLI/CLI.hpp spdlog/spdlog.h tbb/parallel_for.h tbb/task_arena.h boost/geometry.hpp""".split()


def parse(flags, file):
    """The compiler's messages about a file, empty for none."""
    result = subprocess.run(
        ["clang++", *flags, "-fsyntax-only", "-w", file], capture_output=True, encoding="utf-8", cwd=ROOT
    )
    return result.stderr if result.returncode else ""


def main():
    build = sys.argv[1]
    apart = {entry["file"] for entry in with_own_standard(build)}
    files = (
        sys.argv[2:]
        or subprocess.run(
            ["git", "ls-files", "*.cpp"], check=True, capture_output=True, encoding="utf-8", cwd=ROOT
        ).stdout.split()
    )
    files = [file for file in files if (ROOT / file).exists() and str(ROOT / file) not in apart]
    flags = [*macros_and_folders(build), f"-I{ROOT}/tests/fuzz"]
    with tempfile.TemporaryDirectory() as folder:
        header = pathlib.Path(folder) / "libraries.h"
        header.write_text("".join(f"#include <{name}>\n" for name in PRECOMPILED), encoding="utf-8")
        compiled = str(header.with_suffix(".pch"))
        subprocess.run(["clang++", *flags, "-w", "-x", "c++-header", header, "-o", compiled], check=True, cwd=ROOT)
        flags += ["-include-pch", compiled]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            messages = [text for text in pool.map(lambda file: parse(flags, file), files) if text]
    sys.stderr.write("\n".join(messages))
    print(f"{len(files)} files parsed, {len(messages)} with errors")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
