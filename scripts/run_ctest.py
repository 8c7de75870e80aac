"""Runs ctest for a step of scripts/test.sh and notes the outcome of every test.

usage: run_ctest.py STEP PRESET [--repeat-waits] [CTEST_ARGUMENT...]

Appends a line of JSON for each test to build/checks/tests.jsonl: step, name, wall_s, outcome (passed, failed, flaky or
skipped). scripts/report_checks.py makes the closing table of them.

With --repeat-waits, if at most three tests failed and all of them have the label "waits" (cmake/Tests.cmake), these are
run once more, alone. Tests that pass then are flaky: the step passes, their first output is kept in
build/checks/flaky/, and the closing table names them. A test without that label is never repeated.
"""
import json
import pathlib
import subprocess
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[1]
CHECKS = ROOT / "build" / "checks"
MOST_REPEATED = 3


def run(preset, junit, arguments):
    """Runs ctest. Returns its exit status and, by name, the wall time, outcome and output of each test."""
    junit.unlink(missing_ok=True)
    command = ["ctest", "--preset", preset, "--output-junit", str(junit), "--test-output-size-failed", "1000000"]
    status = subprocess.run([*command, *arguments], cwd=ROOT).returncode
    tests = {}
    if junit.exists():
        for case in xml.etree.ElementTree.parse(junit).iter("testcase"):
            output = case.findtext("system-out") or ""
            outcome = {"run": "passed", "disabled": "skipped"}.get(case.get("status"), "failed")
            tests[case.get("name")] = {"wall_s": float(case.get("time")), "outcome": outcome, "output": output}
    return status, tests


def read_labels(preset):
    """Labels of every test of a preset, by name."""
    text = subprocess.run(
        ["ctest", "--preset", preset, "--show-only=json-v1"], cwd=ROOT, capture_output=True, encoding="utf-8"
    ).stdout
    found = {}
    for test in json.loads(text[text.index("{") :])["tests"]:
        labels = [p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"]
        found[test["name"]] = labels[0] if labels else []
    return found


def repeat_alone(step, preset, tests, failed):
    """Runs the failed tests once more, one at a time. Returns whether all passed; marks them as flaky in `tests`."""
    (CHECKS / "flaky").mkdir(parents=True, exist_ok=True)
    passed = True
    for name in failed:
        log = CHECKS / "flaky" / f"{step}.{name}.log"
        log.write_text(tests[name]["output"], encoding="utf-8")
        print(f"== {name} failed; it waits for others, so it runs once more, alone (first output: {log})", flush=True)
        pattern = "^" + name.replace(".", r"\.") + "$"
        status, again = run(preset, CHECKS / "repeated.xml", ["-R", pattern])
        if status == 0 and again.get(name, {}).get("outcome") == "passed":
            tests[name]["outcome"] = "flaky"
            print(f"FLAKY: {name}", flush=True)
        else:
            passed = False
    return passed


def main():
    step, preset, *arguments = sys.argv[1:]
    repeat = "--repeat-waits" in arguments
    arguments = [argument for argument in arguments if argument != "--repeat-waits"]
    CHECKS.mkdir(parents=True, exist_ok=True)
    status, tests = run(preset, CHECKS / f"{step}.xml", arguments)
    failed = [name for name, test in tests.items() if test["outcome"] == "failed"]
    if status != 0 and repeat and 0 < len(failed) <= MOST_REPEATED:
        labels = read_labels(preset)
        if all("waits" in labels[name] for name in failed) and repeat_alone(step, preset, tests, failed):
            status = 0
    with (CHECKS / "tests.jsonl").open("a", encoding="utf-8") as file:
        for name, test in tests.items():
            line = {"step": step, "name": name, "wall_s": test["wall_s"], "outcome": test["outcome"]}
            file.write(json.dumps(line) + "\n")
    if status == 0 and not tests:
        print("run_ctest.py: no test ran", file=sys.stderr)
        status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
