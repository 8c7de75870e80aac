"""Messages for wrong commands, options, names and files: exit code 2 and the nearest valid name."""
import json
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import unittest

THRONG = sys.argv.pop(1)


def throng(*arguments, **environment):
    return subprocess.run(
        [THRONG, *map(str, arguments)], capture_output=True, text=True, timeout=60, env={**os.environ, **environment}
    )


class Messages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, expected, *arguments, code=2, **environment):
        done = throng(*arguments, **environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(expected, done.stderr)

    def job(self, **fields):
        file = self.folder / "my.job.json"
        file.write_text(json.dumps({"scenario": "city_square/nearest_exit", **fields}))
        return file

    def test_an_unknown_command_is_named_with_the_nearest_one(self):
        self.refused('unknown command "runn"; did you mean "run"?', "runn", "x")
        self.refused('unknown command "exprot"; did you mean "export"?', "exprot")
        self.refused('unknown command "chek"; did you mean "check"?', "scenario", "chek", "x")
        self.refused('unknown command "bulid"; did you mean "build"?', "people", "bulid")
        self.refused('unknown command "abracadabra"; expected one of: run, simulate,', "abracadabra")
        self.refused('unknown command "runn"; did you mean "run"?', "help", "runn")

    def test_help_is_a_command(self):
        done = throng("help")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("validate-crowd", done.stdout)
        self.assertIn("Usage: throng ", done.stdout)
        self.assertIn("Usage: throng scenario check [OPTIONS]", throng("help", "scenario", "check").stdout)
        self.assertIn("--output", throng("help", "run").stdout)
        self.assertIn("FILE.json, a folder or an id", throng("help", "scenario", "check").stdout)

    def test_help_is_plain_text(self):
        for command in ([], ["metrics"], ["calibrate", "pose"]):
            text = throng(*command, "--help").stdout
            self.assertTrue(text.isascii() and re.fullmatch(r"[\n -~]*", text), command)
        self.assertIn("{any,text,sqlite,scb,csv}", throng("metrics", "--help").stdout)

    def test_an_unknown_field_is_named_with_the_nearest_one(self):
        self.refused(
            '/drone: unknown field "drone"; did you mean "drones"?',
            "run",
            self.job(drone=[]),
            "-o",
            self.folder / "out",
        )

    def test_a_missing_field_is_named(self):
        study = self.folder / "my.study.json"
        study.write_text("{}")
        self.refused('missing required field "policies"', "study", study, "-o", self.folder / "out")

    def test_an_unknown_scenario_is_named_with_the_nearest_one(self):
        self.refused(
            'unknown scenario "city_square/nearest_exti"; did you mean "city_square/nearest_exit"?',
            "scenario",
            "plan",
            "city_square/nearest_exti",
            "-o",
            self.folder / "plan.svg",
        )
        self.refused("THRONG_SCENARIOS", "scenario", "plan", "atlantis", "-o", self.folder / "plan.svg")

    def test_a_missing_file_is_wrong_input(self):
        missing = self.folder / "nothing.json"
        self.refused(f"{missing}: found no such file, expected a scenario file", "scenario", "check", missing)
        self.refused("nowhere.h5: found no such file, expected a trace", "metrics", "nowhere.h5")
        self.refused(
            "found no such folder, expected the folder of scenarios",
            "scenarios",
            THRONG_SCENARIOS=str(self.folder / "nowhere"),
        )

    def test_a_server_that_is_not_there_is_named(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            url = f"http://127.0.0.1:{free.getsockname()[1]}"
        self.refused(f"cannot reach {url} (is `throng serve` running?", "jobs", code=3, THRONG_URL=url)

    def test_renamed_options_keep_their_old_names_with_a_warning(self):
        data = self.folder / "data"
        done = throng("keys", "create", "alice", "--data", data, "--most-jobs", "3", "--most-gib=2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--most-jobs is deprecated, use --max-jobs", done.stderr)
        self.assertIn("--most-gib is deprecated, use --max-gib", done.stderr)
        done = throng("calibrate", "intrinsics", "--picture=plot.svg")
        self.assertIn("--picture is deprecated, use --plot", done.stderr)
        self.assertEqual(throng("keys", "create", "bob", "--data", data, "--max-jobs", "3").stderr, "")
        self.assertEqual(throng("keys", "create", "eve", "--data", data, "--most-jobs", "-3").returncode, 2)


unittest.main()
