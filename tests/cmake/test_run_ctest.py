"""scripts/run_ctest.py on small projects: what is repeated, what is noted; scripts/report_checks.py: the closing table.

usage: test_run_ctest.py CMAKE
"""

import contextlib
import importlib.util
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

CMAKE = sys.argv.pop(1)
SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
PRESETS = {
    "version": 6,
    "configurePresets": [{"name": "p", "generator": "Ninja", "binaryDir": "${sourceDir}/build/p"}],
    "testPresets": [{"name": "p", "configurePreset": "p"}],
}
# Fails the first time that it runs.
FLAKY = 'sh -c "echo first try; mkdir tried_{name} && exit 1; exit 0"'


def script(name):
    spec = importlib.util.spec_from_file_location(name, SCRIPTS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class RunCtest(unittest.TestCase):
    def project(self, tests):
        """A configured project with tests of these (name, command, labels); returns its folder."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        (root / "CMakePresets.json").write_text(json.dumps(PRESETS))
        lines = ["cmake_minimum_required(VERSION 3.25)", "project(p LANGUAGES NONE)", "enable_testing()"]
        for name, command, labels in tests:
            lines.append(f"add_test(NAME {name} COMMAND {command.format(name=name)})")
            lines.append(f'set_tests_properties({name} PROPERTIES LABELS "{labels}")')
        (root / "CMakeLists.txt").write_text("\n".join(lines))
        subprocess.run([CMAKE, "-S", root, "--preset", "p"], cwd=root, check=True, capture_output=True)
        return root

    def run_tests(self, tests, *arguments):
        """Exit status, outcome of each test, and the folder of notes."""
        root = self.project(tests)
        module = script("run_ctest")
        checks = root / "build" / "checks"
        with mock.patch.multiple(module, ROOT=root, CHECKS=checks), mock.patch.object(
            sys, "argv", ["run_ctest.py", "step", "p", *arguments]
        ), contextlib.redirect_stdout(io.StringIO()):
            status = module.main()
        notes = [json.loads(line) for line in (checks / "tests.jsonl").read_text().splitlines()]
        return status, {note["name"]: note["outcome"] for note in notes}, checks

    def test_a_test_that_waits_is_repeated_once_and_called_flaky(self):
        tests = [("a.x", FLAKY, "slow;waits"), ("b", "true", "waits")]
        status, outcomes, checks = self.run_tests(tests, "--repeat-waits")
        self.assertEqual((status, outcomes), (0, {"a.x": "flaky", "b": "passed"}))
        self.assertIn("first try", (checks / "flaky" / "step.a.x.log").read_text())

    def test_other_tests_are_not_repeated(self):
        for tests, arguments, failed in (
            ([("a", FLAKY, "computing")], ["--repeat-waits"], 1),
            ([("a", FLAKY, "waits"), ("b", "false", "computing")], ["--repeat-waits"], 2),
            ([("a", FLAKY, "waits")], [], 1),
            ([("a", "false", "waits")], ["--repeat-waits"], 1),
            ([(name, FLAKY, "waits") for name in "abcd"], ["--repeat-waits"], 4),
        ):
            with self.subTest(tests=tests, arguments=arguments):
                status, outcomes, _ = self.run_tests(tests, *arguments)
                self.assertNotEqual(status, 0)
                self.assertEqual(list(outcomes.values()).count("failed"), failed)

    def test_a_test_whose_program_is_not_there_has_failed(self):
        status, outcomes, _ = self.run_tests([("a", "no_such_program", "waits")], "--repeat-waits")
        self.assertEqual((status != 0, outcomes), (True, {"a": "failed"}))

    def test_no_test_is_no_success(self):
        status, _, _ = self.run_tests([("a", "true", "waits")], "-L", "^another$")
        self.assertNotEqual(status, 0)


class ReportChecks(unittest.TestCase):
    def report(self, steps, tests):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for file, rows in (("steps.jsonl", steps), ("tests.jsonl", tests)):
                (folder / file).write_text("".join(json.dumps(row) + "\n" for row in rows))
            text = io.StringIO()
            with mock.patch.object(sys, "argv", ["report_checks.py", name]), contextlib.redirect_stdout(text):
                status = script("report_checks").main()
            return status, text.getvalue()

    def test_every_failure_is_named(self):
        step = {"wall_s": 61, "cpu_s": 100, "was_run": True, "failed_parts": ""}
        steps = [
            {**step, "step": "format", "status": 1, "failed_parts": "language"},
            {**step, "step": "release", "status": 0},
        ]
        tests = [{"step": "release", "name": f"t{i}", "wall_s": i, "outcome": "passed"} for i in range(30)]
        tests[3]["outcome"], tests[4]["outcome"] = "failed", "flaky"
        status, text = self.report(steps, tests)
        self.assertEqual(status, 1)
        for line in (
            "FAILED: step format (language)",
            "FAILED: release: t3",
            "FLAKY:  release: t4",
            "29 passed, 1 failed",
        ):
            self.assertIn(line, text)
        self.assertIn("1:01", text)
        self.assertEqual(sum("  release  t" in line for line in text.splitlines()), 20)

    def test_success_needs_every_step(self):
        step = {"step": "format", "wall_s": 1, "cpu_s": 1, "was_run": True, "failed_parts": ""}
        self.assertEqual(self.report([{**step, "status": 0}], [])[0], 0)
        self.assertNotIn("NOT RUN", self.report([{**step, "status": 0}], [])[1])
        status, text = self.report(
            [{**step, "status": 0}, {**step, "step": "image", "status": 0, "was_run": False}], []
        )
        self.assertEqual(status, 0)
        self.assertIn("all checks passed, NOT RUN: image", text)
        self.assertEqual(self.report([], [])[0], 1)


unittest.main(argv=sys.argv[:1])
