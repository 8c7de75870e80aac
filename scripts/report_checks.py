"""Prints the closing table of scripts/test.sh and says whether everything passed.

usage: report_checks.py CHECKS_FOLDER

Reads steps.jsonl (a line for each step: step, wall_s, cpu_s, status, was_run, failed_parts) and tests.jsonl (scripts/run_ctest.py). Exit
status 1 if a step failed; one that this machine or its time limit left out is named.
"""
import json
import pathlib
import sys


def read_lines(path):
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []


def duration(seconds):
    return f"{int(seconds) // 60:3d}:{int(seconds) % 60:02d}"


def main():
    folder = pathlib.Path(sys.argv[1])
    steps, tests = read_lines(folder / "steps.jsonl"), read_lines(folder / "tests.jsonl")
    print(f"\n{'step':10} {'wall':>6} {'CPU':>6}  min:s")
    for step in steps:
        verdict = "passed" if step["was_run"] else "NOT RUN"
        if step["status"] != 0:
            verdict = "FAILED: " + (step["failed_parts"] or "see above")
        print(f"{step['step']:10} {duration(step['wall_s'])} {duration(step['cpu_s'])}  {verdict}")
    print(f"{'total':10} {duration(sum(s['wall_s'] for s in steps))} {duration(sum(s['cpu_s'] for s in steps))}")
    slowest = sorted(tests, key=lambda test: -test["wall_s"])[:20]
    if slowest:
        print("\nslowest tests (wall s, beside others)")
    for test in slowest:
        print(f"{test['wall_s']:8.1f}  {test['step']:8} {test['name']}")
    print()
    of = {outcome: [t for t in tests if t["outcome"] == outcome] for outcome in ("passed", "failed", "flaky")}
    for test in of["flaky"]:
        print(
            f"FLAKY:  {test['step']}: {test['name']} (first output: {folder}/flaky/{test['step']}.{test['name']}.log)"
        )
    for test in of["failed"]:
        print(f"FAILED: {test['step']}: {test['name']}")
    for step in steps:
        if step["status"] != 0:
            print(f"FAILED: step {step['step']}" + (f" ({step['failed_parts']})" if step["failed_parts"] else ""))
    if tests:
        print(f"{len(of['passed']) + len(of['flaky'])} passed, {len(of['failed'])} failed")
    sound = bool(steps) and all(step["status"] == 0 for step in steps)
    left_out = [step["step"] for step in steps if not step["was_run"]]
    print(
        ("all checks passed" if sound else "checks FAILED") + (f", NOT RUN: {', '.join(left_out)}" if left_out else "")
    )
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
