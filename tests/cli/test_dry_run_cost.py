#!/usr/bin/python3
"""CPU and memory cost of a dry run in the service: its process neither simulates nor loads a crowd, and its confined
children, who do, build no mesh for paths that nobody walks.

    tests/cli/test_dry_run_cost.py THRONG

Prints CPU time and memory of the server's process for dry runs of a concert with 9 000 people, and CPU time of the
children for a stadium's exit, and fails above limits that leave room for a slow machine.
"""
import os
import pathlib
import re
import statistics
import sys
import tempfile

from service import ask, start_service

JOB = {"scenario": "concert/everyday", "crowd": {"agents": 9000}}
REPETITIONS = 4
# 10 to 13 ms of each dry run on a slow machine that compiles meanwhile. Loading the crowd would take some 300 ms.
MAX_CPU_S = 0.1
MAX_MIB = 8  # that stay, after all of them
# A dry run loads the people of this place once, without the mesh of their paths: 0.6 to 0.7 s of CPU on a slow machine
# that compiles meanwhile. It was 2.9 s when each check loaded them with the mesh.
MESHED_JOB = {"scenario": "stadium_exit/everyday"}
MAX_CHILD_CPU_S = 2


def cpu_s(pid):
    """User and system time of the process alone, without its children."""
    total_ns = 0
    for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
        total_ns += int((task / "schedstat").read_text().split()[0])
    return total_ns / 1e9


def tree_cpu_s(pid):
    """User and system time of a process and all below it, those who have ended included."""
    stat = {}
    for entry in pathlib.Path("/proc").iterdir():
        try:
            stat[int(entry.name)] = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except (ValueError, OSError):
            continue
    below = {pid}
    for _ in stat:
        below |= {child for child, fields in stat.items() if int(fields[1]) in below}
    return sum(int(ticks) for each in below for ticks in stat[each][11:15]) / os.sysconf("SC_CLK_TCK")


def resident_mib(pid):
    return int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text())[1]) / 1024


def main():
    throng = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        server, port = start_service(throng, f"{folder}/data")
        try:
            dry_run = f"http://127.0.0.1:{port}/v1/jobs?dry_run"
            ask(dry_run, {**JOB, "crowd": {}})  # schemas are read, the process that forks checks runs
            memory = resident_mib(server.pid)
            answers, costs = [], []
            for _ in range(REPETITIONS):
                cpu = cpu_s(server.pid)
                answers.append(ask(dry_run, JOB))
                costs.append(cpu_s(server.pid) - cpu)
            assert answers[0]["valid"] and answers[0]["job"]["crowd"]["agents"] == 9000, answers[0]
            assert all(answer == answers[0] for answer in answers)
            grown = resident_mib(server.pid) - memory
            cpu = tree_cpu_s(server.pid)
            for seed in range(REPETITIONS):
                ask(dry_run, {**MESHED_JOB, "seed": seed})
            child = (tree_cpu_s(server.pid) - cpu) / REPETITIONS
        finally:
            server.terminate()
            server.wait()
    each = statistics.median(costs)
    print(
        f"dry run of {JOB['scenario']} with {JOB['crowd']['agents']} people: the server's process used "
        f"{1000 * each:.1f} ms of CPU (median of {REPETITIONS}; {1000 * costs[0]:.1f} ms for the first, at most "
        f"{1000 * max(costs):.1f} ms), {memory:.1f} MiB before and {grown:+.1f} MiB after them; "
        f"its children {1000 * child:.0f} ms for {MESHED_JOB['scenario']}"
    )
    assert each < MAX_CPU_S, f"{1000 * each:.1f} ms of CPU for each dry run"
    assert child < MAX_CHILD_CPU_S, f"{1000 * child:.0f} ms of CPU for each dry run of {MESHED_JOB['scenario']}"
    assert grown < MAX_MIB, f"{grown:.1f} MiB stay"


main()
