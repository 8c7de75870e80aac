#!/usr/bin/env python3
"""Measures what compiling the product costs, one file after the other on each core, without ccache.

usage: scripts/compile_cost.py modules BUILD [TARGET]   processor seconds of the compilers, by module
       scripts/compile_cost.py headers BUILD [TARGET]   seconds that clang++ takes for the headers that the product's files include

TARGET: throng_programs if not given; throng_first is what the first image needs.

BUILD is a configured build folder of the preset release. scripts/measure_structure.py --compile prints both as tables.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALL_PROGRAMS = "throng_programs"
LAUNCHERS = re.compile(r"^(/usr/bin/env|CCACHE_\w+=.*|.*/ccache)$")


def compile_commands(build, target):
    """The commands that compile the target's files: (module's folder, words)."""
    listed = subprocess.run(
        ["ninja", "-C", build, "-t", "commands", target], check=True, capture_output=True, encoding="utf-8"
    ).stdout
    for line in listed.splitlines():
        words = shlex.split(line.split(" && ")[0])
        if "-c" not in words or "-o" not in words or not words[words.index("-c") + 1].endswith(".cpp"):
            continue
        module = words[words.index("-o") + 1].split("/CMakeFiles/")[0]
        yield module, [word for word in words if not LAUNCHERS.match(word)]


def on_all_cores(function, items):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(function, items))


def cpu_seconds(build, target=ALL_PROGRAMS):
    """Processor seconds of the compiler by module."""

    def measure(item):
        module, words = item
        words = [*words]
        words[words.index("-o") + 1] = "/dev/null"
        for flag in ("-MF", "-MT"):
            at = words.index(flag)
            del words[at : at + 2]
        words.remove("-MD")
        process = subprocess.Popen(words, cwd=build)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"compile_cost.py: {' '.join(words)} failed")
        return module, usage.ru_utime + usage.ru_stime

    sums = collections.Counter()
    for module, seconds in on_all_cores(measure, compile_commands(build, target)):
        sums[module] += seconds
    return sums


def header_name(path):
    """The words between < > or " " of an #include."""
    path = re.sub(r"^(/usr/include/|/usr/lib/gcc/)", "", str(path))
    path = re.sub(r"^(x86_64-linux-gnu/|c\+\+/\d+/|eigen3/|opencv4/|hdf5/serial/)", "", path)
    return path.removeprefix(f"{ROOT}/")


def traced_headers(events, own):
    """(name, s) of the headers that files of the project include, from clang's trace; not those inside others'."""
    spans = sorted(
        ((event["ts"], -event["dur"], event["args"]["detail"]) for event in events if event["name"] == "Source")
    )
    stack = []
    for begin, negative_duration, path in spans:
        while stack and stack[-1][0] <= begin:
            stack.pop()
        inside_library = any(not own(outer) for _, outer in stack)
        if not own(path) and not inside_library:
            yield header_name(path), -negative_duration / 1e6
        stack.append((begin - negative_duration, path))


def header_seconds(build, target=ALL_PROGRAMS):
    """Seconds by library header, and the number of compiled files that include it."""

    def measure(item):
        number, (_, words) = item
        words = [*words]
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / f"{number}.o"
            words[0] = "clang++"
            words[words.index("-o") + 1] = str(output)
            dropped = ("-O", "-M", "--param", "ggc-", "-fno-semantic")
            at = words.index("-MF")
            del words[at : at + 2]
            at = words.index("-MT")
            del words[at : at + 2]
            kept = [word for word in words if not word.startswith(dropped)]
            subprocess.run([*kept, "-O0", "-w", "-ftime-trace"], check=True, cwd=build)
            events = json.loads(output.with_suffix(".json").read_text(encoding="utf-8"))["traceEvents"]
        return list(traced_headers(events, lambda path: path.startswith(str(ROOT)) or "/usr/" not in path))

    seconds, files = collections.Counter(), collections.Counter()
    for headers in on_all_cores(measure, enumerate(compile_commands(build, target))):
        for name, duration in headers:
            seconds[name] += duration
        files.update({name for name, _ in headers})
    return seconds, files


def main():
    kind, build, target = [*sys.argv[1:], ALL_PROGRAMS][:3]
    if kind == "modules":
        sums = cpu_seconds(build, target)
        for module, cpu_s in sums.most_common():
            print(f"{cpu_s:8.1f} {module}")
        print(f"{sum(sums.values()):8.1f} all")
    else:
        seconds, files = header_seconds(build, target)
        for name, duration_s in seconds.most_common(30):
            print(f"{duration_s:8.1f} s in {files[name]:3d} files: {name}")


if __name__ == "__main__":
    main()
