"""Messages for wrong commands, options, names and files: exit code 2 and the nearest valid name."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from free_ports import free_port
from service import start_service

THRONG = sys.argv.pop(1)


def throng(*arguments, **environment):
    return subprocess.run(
        [THRONG, *map(str, arguments)], capture_output=True, text=True, timeout=300, env={**os.environ, **environment}
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
        self.refused('unknown command "abracadabra"; expected one of: run, check, simulate,', "abracadabra")
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

    def test_a_missing_character_library_is_noticed_before_anything_is_written(self):
        job, out = self.job(capture={"to_s": 1}), self.folder / "out"
        missing = {"THRONG_PEOPLE": str(self.folder / "nobody")}
        self.refused(
            "nobody/population.json: found no such file, expected a character library", "run", job, "-o", out, **missing
        )
        self.assertFalse(out.exists())
        # No camera, no need.
        done = throng("run", self.job(capture={"to_s": 1}, drones=[]), "-o", out, **missing)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_missing_field_is_named(self):
        study = self.folder / "my.study.json"
        study.write_text("{}")
        self.refused('missing required field "cases"', "study", study, "-o", self.folder / "out")

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

    def test_a_misspelled_scenario_of_a_command_is_answered_with_the_nearest_one(self):
        self.refused(
            'unknown scenario "city_sqare/everyday"; did you mean "city_square/everyday"?',
            "scenario",
            "check",
            "city_sqare/everyday",
        )
        self.refused("--workers: found -1, expected a number of at least 0", "run", "x", "-o", "y", "--workers", "-1")
        self.refused("found no suffix", "scenario", "plan", "city_square/everyday", "-o", self.folder / "plan")
        file = self.job()
        self.refused("my.job.json: found a file, expected a new or empty folder", "run", file, "-o", file)
        self.refused("throng metrics: missing TRACE or --trajectory (`throng metrics --help`)", "metrics")

    def test_a_missing_file_is_wrong_input(self):
        missing = self.folder / "nothing.json"
        self.refused(f"{missing}: found no such file, expected a scenario file", "scenario", "check", missing)
        self.refused("nowhere.h5: found no such file, expected a trace", "metrics", "nowhere.h5")
        self.refused(
            "found no such folder, expected the folder of scenarios",
            "scenarios",
            THRONG_SCENARIOS=str(self.folder / "nowhere"),
        )

    def run_job(self, expected, **fields):
        self.refused(expected, "run", self.job(**fields), "-o", self.folder / "out")

    def test_unknown_names_in_jobs_are_answered_with_the_nearest_one(self):
        def drone(**fields):
            return [{"id": "d1", **fields}]

        self.run_job(
            '/outputs/formats/0: unknown format "yolo-detct"; did you mean "yolo-detect"?',
            outputs={"formats": ["yolo-detct"]},
        )
        self.run_job('/outputs/formats/0: unknown format "xyz"; expected one of: coco,', outputs={"formats": ["xyz"]})
        self.run_job(
            '/outputs/formats/0: unknown format "yolo"; did you mean "yolo-pose"?', outputs={"formats": ["yolo"]}
        )
        self.run_job(
            '/outputs/annotations/1: unknown value "densty"; did you mean "density"?',
            outputs={"annotations": ["coco", "densty"]},
        )
        self.run_job('unknown airframe "f45"; did you mean "f450"?', drones=drone(airframe="f45"))
        self.run_job('unknown scenario "city_square/nearest_exti"; did you mean', scenario="city_square/nearest_exti")
        self.run_job(
            'unknown path "crowd.agent"; did you mean "crowd.agents"?', randomize={"crowd.agent": {"uniform": [1, 2]}}
        )
        self.run_job(
            'unknown path "crowd"; did you mean "crowd.agents"?', randomize={"crowd": {"agents": {"uniform": [1, 2]}}}
        )

    def test_limits_are_named(self):
        self.run_job("/capture/to_s: found 5, expected at least from_s, which is 10", capture={"from_s": 10, "to_s": 5})
        self.run_job("/crowd/agents: found 5000, expected 1 to 260, the people", crowd={"agents": 5000})

    def test_another_kind_of_file_is_recognized(self):
        place = self.folder / "yard.place.json"
        place.write_text('{"name": "Yard", "people": {}}')
        self.refused(
            "found a blueprint, expected a job; a blueprint is for `throng scenario make`", "run", place, "-o", "x"
        )
        self.refused("found a blueprint, expected a scenario", "scenario", "check", place)
        self.refused("found a job, expected a study; a job is for `throng run`", "study", self.job(), "-o", "x")
        self.refused("found a job, expected a blueprint", "scenario", "make", self.job())
        study = self.folder / "s.json"
        study.write_text('{"cases": [], "policies": []}')
        self.refused("found a study, expected a job; a study is for `throng study`", "run", study, "-o", "x")
        self.refused(f"{self.folder}: found a folder, expected a job file", "run", self.folder, "-o", "x")

    def test_options_and_arguments(self):
        job = self.job()
        self.refused('throng run: unknown option "--outptu"; did you mean "--output"?', "run", job, "--outptu", "x")
        self.refused("throng run: missing JOB (`throng run --help`)", "run")
        self.refused("throng run: missing --output (`throng run --help`)", "run", job)
        self.refused("throng serve: --port: found 99999, expected 0 to 65535", "serve", "--port", "99999")
        self.refused('one more argument, "check"', "scenarios", "check")
        alone = subprocess.run([THRONG], capture_output=True, text=True, timeout=100)
        self.assertEqual((alone.returncode, alone.stderr), (0, ""))
        self.assertIn("Subcommands:", alone.stdout)
        self.assertNotIn("confined", alone.stdout)
        self.refused("throng keys: found no command, expected one of: ", "keys")
        self.refused("--classes: found x, expected one of: ", "export", "d", "--classes", "x")

    def test_inputs_are_not_written_over(self):
        job = self.job()
        text = job.read_text()
        other = self.folder / "link.h5"
        other.symlink_to(job)
        for output in (job, other):
            self.refused(
                f"--output: found {output}, which is an input, expected another file", "simulate", job, "-o", output
            )
        self.refused("which is an input", "scenario", "plan", job, "-o", job)
        self.refused("which is an input", "report", job, "-o", job)
        self.refused("--csv: found", "metrics", job, "--csv", job)
        self.refused("which is an input", "calibrate", "intrinsics", "--points", job, "-o", job)
        self.assertEqual(job.read_text(), text)

    def test_a_job_s_folder_is_not_its_dataset(self):
        (self.folder / "out/dataset").mkdir(parents=True)
        (self.folder / "out/dataset/manifest.json").write_text("{}")
        expected = f"found no manifest.json, expected a finished dataset, as {self.folder}/out/dataset"
        self.refused(expected, "validate", self.folder / "out")
        self.refused(expected, "export", self.folder / "out", "-o", self.folder / "x", "--formats", "mot")

    def test_counts_agree_with_their_nouns(self):
        done = throng("scenario", "check", "city_square/nearest_exit")
        self.assertRegex(
            done.stdout, r"\b(1 error|0 errors|\d\d* errors), (1 warning|[02-9]\d* warnings|\d\d+ warnings)\n$"
        )

    def test_a_job_that_is_not_there_is_answered_with_the_nearest_one(self):
        server, port = start_service(THRONG, self.folder / "data")
        self.addCleanup(server.wait, 120)
        self.addCleanup(server.terminate)
        url = f"http://127.0.0.1:{port}"
        for command in ("watch", "cancel", "retry", "remove", "logs", "fetch"):
            self.refused(
                f'unknown job "nope" on {url}; expected an id that `throng jobs` lists', command, "nope", THRONG_URL=url
            )
        done = throng("submit", self.job(capture={"to_s": 1}), THRONG_URL=url)
        job = done.stdout.strip()
        self.refused(f'unknown job "{job[:-1]}" on {url}; did you mean "{job}"?', "watch", job[:-1], THRONG_URL=url)
        throng("cancel", job, THRONG_URL=url)

    def test_a_server_that_is_not_there_is_named(self):
        url = f"http://127.0.0.1:{free_port()}"
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
