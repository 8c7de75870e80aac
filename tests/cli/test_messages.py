"""Messages for wrong commands, options, names and files: exit code 2 and the nearest valid name."""
import contextlib
import fcntl
import json
import os
import pty
import re
import shutil
import struct
import subprocess
import termios
import unittest

from free_ports import free_port
from program import ROOT, THRONG, FolderTest, printed, run, throng, write_json

SCENARIOS = ROOT / "scenarios"


class Messages(FolderTest):
    def refused(self, expected, *arguments, code=2, **environment):
        done = throng(*arguments, code=code, variables=environment)
        self.assertIn(expected, done.stderr)

    def job(self, **fields):
        file = write_json(self.folder / "my.job.json", {"scenario": "city_square/nearest_exit", **fields})
        return file

    def unwritable(self, expected, *arguments):
        """Also root has no other rights than those of the folder's mode here."""
        drop = ["setpriv", "--bounding-set", "-dac_override,-dac_read_search"] if os.geteuid() == 0 else []
        done = run(*drop, THRONG, *arguments, cwd=self.folder, code=3)
        self.assertIn(f"throng: cannot write {expected}", done.stderr)

    def test_folders_that_cannot_be_written_say_why(self):
        denied = f": Permission denied (user {os.geteuid()})"
        for name in ("locked", "data/jobs"):
            (self.folder / name).mkdir(parents=True)
        for name in ("keys", "jobs", "webhooks"):
            (self.folder / name).mkdir()
            file = self.folder / name / f"{name}.sqlite"
            file.touch()
            file.chmod(0o444)
        (self.folder / "file").touch()
        (self.folder / "locked").chmod(0o555)
        (self.folder / "data/jobs").chmod(0o555)
        serve = ("serve", "--port", "0", "--data")
        self.unwritable("to locked" + denied, *serve, "locked")
        self.unwritable("to locked" + denied, *serve, "locked/data")
        self.unwritable("to file: found a file, expected a folder", *serve, "file/data")
        self.unwritable("to data/jobs" + denied, *serve, "data")
        for name in ("keys", "jobs", "webhooks"):
            self.unwritable(f"to {name}/{name}.sqlite" + denied, *serve, name)
        job = self.job(crowd={"agents": 5}, drones=[])
        self.unwritable("to locked" + denied, "run", job, "-o", "locked")
        self.unwritable("to locked" + denied, "run", job, "-o", "locked/out")
        self.unwritable("to file: found a file, expected a folder", "run", job, "-o", "file/out")
        self.unwritable("locked/trace.h5" + denied, "simulate", job, "-o", "locked/trace.h5")

    def test_an_unknown_command_is_named_with_the_nearest_one(self):
        self.refused('unknown command "runn"; did you mean "run"?', "runn", "x")
        self.refused('unknown command "exprot"; did you mean "export"?', "exprot")
        self.refused('unknown command "chek"; did you mean "check"?', "scenario", "chek", "x")
        self.refused('unknown command "bulid"; did you mean "build"?', "people", "bulid")
        self.refused('unknown command "abracadabra"; expected one of: run, check, simulate,', "abracadabra")
        self.refused('unknown command "runn"; did you mean "run"?', "help", "runn")

    def test_help_is_a_command(self):
        done = throng("help")
        self.assertIn("validate-crowd", done.stdout)
        self.assertIn("Usage: throng ", done.stdout)
        self.assertIn("Usage: throng scenario check [OPTIONS]", printed("help", "scenario", "check"))
        self.assertIn("--output", printed("help", "run"))
        self.assertIn("FILE.json, a folder or an id", printed("help", "scenario", "check"))

    def test_commands_in_python_get_their_arguments(self):
        for name in ("train", "match"):
            self.assertIn(f"throng.{name}", printed(name, "--help"))
            missing = printed(name, "--help", variables={"THRONG_PYTHON": "/no/python"}, code=3)
            self.assertIn("cannot start /no/python", missing)

    def test_help_is_plain_text(self):
        for command in ([], ["metrics"], ["calibrate", "pose"]):
            text = printed(*command, "--help")
            self.assertTrue(text.isascii() and re.fullmatch(r"[\n -~]*", text), command)
        self.assertIn("{any,text,sqlite,scb,csv,hdf5,fcd,json}", printed("metrics", "--help"))

    def test_an_unknown_field_is_named_with_the_nearest_one(self):
        job = self.job(drone=[])
        self.refused('/drone: unknown field "drone"; did you mean "drones"?', "run", job, "-o", self.folder / "out")

    def test_a_missing_character_library_is_noticed_before_anything_is_written(self):
        job, out = self.job(capture={"to_s": 1}), self.folder / "out"
        missing = {"THRONG_PEOPLE": str(self.folder / "nobody")}
        self.refused(
            "nobody/population.json: found no such file, expected a character library", "run", job, "-o", out, **missing
        )
        self.assertFalse(out.exists())
        # No camera, no need.
        throng("run", self.job(capture={"to_s": 1}, drones=[]), "-o", out, variables=missing)

    def test_a_file_is_no_data_folder_and_a_folder_is_no_image(self):
        file = self.folder / "data"
        file.write_text("")
        self.refused(
            f"--data: found {file}, which is a file, expected a folder", "serve", "--data", file, "--port", "0"
        )
        boards = ["--columns", "9", "--rows", "6", "--square", "1", "-o", self.folder / "camera.json"]
        expected = f"{self.folder}: found a folder, expected images, such as {self.folder}/*.jpg"
        self.refused(expected, "calibrate", "intrinsics", self.folder, *boards)

    def test_one_mistake_gives_one_message(self):
        done = throng("check", self.job(scenario=[{"weight": 2}]), code=2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_missing_field_is_named(self):
        study = self.folder / "my.study.json"
        study.write_text("{}")
        self.refused(
            "/cases: found nothing, expected an array of at least 1", "study", study, "-o", self.folder / "out"
        )

    def test_an_unknown_scenario_is_named_with_the_nearest_one(self):
        expected = 'unknown scenario "city_square/nearest_exti"; did you mean "city_square/nearest_exit"?'
        plan = ("-o", self.folder / "plan.svg")
        self.refused(expected, "scenario", "plan", "city_square/nearest_exti", *plan)
        self.refused("THRONG_SCENARIOS", "scenario", "plan", "atlantis", *plan)

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
        path = "here/city_square/everyday.json"
        for command in (["check", path], ["plan", path, "-o", self.folder / "plan.svg"]):
            expected = f'{path}: found no such file, expected a scenario file, or its id: "city_square/everyday"'
            self.refused(expected, "scenario", *command)
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
            '/outputs/formats/0: unknown format "yolo"; did you mean "yolo-detect"?', outputs={"formats": ["yolo"]}
        )
        self.run_job(
            '/outputs/annotations/1: unknown value "densty"; did you mean "density"?',
            outputs={"annotations": ["coco", "densty"]},
        )
        self.run_job('unknown airframe "f45"; did you mean "f450"?', drones=drone(airframe="f45"))
        self.run_job(
            "/crowd/constants: found posterior of the model orca", crowd={"model": "orca", "constants": "posterior"}
        )
        self.run_job('unknown scenario "city_square/nearest_exti"; did you mean', scenario="city_square/nearest_exti")
        self.run_job(
            'unknown path "crowd.agent"; did you mean "crowd.agents"?', randomize={"crowd.agent": {"uniform": [1, 2]}}
        )
        self.run_job(
            'unknown path "crowd"; did you mean "crowd.agents"?', randomize={"crowd": {"agents": {"uniform": [1, 2]}}}
        )

    def test_the_file_of_a_calibration_is_named_with_the_job_s(self):
        camera = {"calibration": "nowhere.json"}
        expected = 'my.job.json: /drones/0/camera/calibration: found "nowhere.json"'
        self.run_job(expected, drones=[{"id": "a", "start": [0, 0, 20], "camera": camera}])

    def test_limits_are_named(self):
        self.run_job("/capture/to_s: found 5, expected at least from_s, which is 10", capture={"from_s": 10, "to_s": 5})
        self.run_job(
            "/crowd/agents: found 5000, expected 1 to 260, all who are in the scenario at the start",
            crowd={"agents": 5000},
        )

    def test_another_kind_of_file_is_recognized(self):
        place = self.folder / "yard.blueprint.json"
        place.write_text('{"name": "Yard", "people": {}}')
        self.refused(
            "found a blueprint, expected a job; a blueprint is for `throng scenario check`", "run", place, "-o", "x"
        )
        self.refused("/ground: found nothing", "scenario", "plan", place, "-o", self.folder / "plan.svg")
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
        alone = throng()
        self.assertEqual(alone.stderr, "")
        self.assertIn("Subcommands:", alone.stdout)
        self.assertNotIn("confined", alone.stdout)
        self.refused("throng keys: found no command, expected one of: ", "keys")
        self.refused("--classes: found x, expected one of: ", "export", "d", "--classes", "x")

    def test_an_option_before_its_command_is_told_its_place(self):
        self.refused("found -o before the command, expected -o behind `throng run`", "-o", "out", "run", self.job())
        self.refused(
            "found -o before the command, expected -o behind `throng people sheet`", "people", "-o", "x", "sheet"
        )
        self.refused('unknown command "list"; expected `throng scenarios`', "scenario", "list")

    def test_wrong_values_of_a_study_are_said_once(self):
        study = self.folder / "study.json"
        case = {"id": "a", "scenario": "city_square/nearest_exit", "duration_s": "200"}
        study.write_text(json.dumps({"name": "x", "runs": 2, "cases": [case]}))
        done = throng("study", study, "-o", self.folder / "out", code=2)
        self.assertEqual(done.stderr.count("expected"), 1, done.stderr)
        self.refused("--runs: found 0, expected a number above 0", "study", study, "-o", "x", "--runs", "0")

    def test_a_scenario_that_is_an_object_of_something_else_is_said_once(self):
        job = self.job(scenario={"kind": "plaza"})
        self.assertEqual(throng("check", job, code=2).stderr.count("expected"), 1)

    def test_a_scenario_in_place_of_a_job_is_told_how_a_job_names_it(self):
        for name in ("city_square/everyday", "scenarios/city_square/everyday"):
            for command in (("check",), ("run", "-o", "x")):
                self.refused('a job file, which may be {"scenario": "city_square/everyday"}', *command, name)

    def test_a_job_is_no_scenario_to_upload(self):
        self.refused("found a job, expected a scenario", "scenarios", "upload", self.job())

    def test_what_may_be_no_mistake_is_asked(self):
        radians = {"id": "d", "start": [0, 0, 20], "camera": {"pitch_deg": -1.57}}
        said = printed("check", self.job(drones=[radians]))
        self.assertIn("/drones/0/camera/pitch_deg: found -1.57 degrees, expected -90 if it is meant in radians", said)
        for pitch, in_degrees in ((-0.7, -40), (-1.2, -69)):
            asked = {**radians, "camera": {"pitch_deg": pitch}}
            said = printed("check", self.job(drones=[asked]))
            self.assertIn(f"found {pitch} degrees, expected {in_degrees} if it is meant in radians", said)
        for pitch in (-1.75, -30, -2, -1, -0.1, 0.001, 0.5):
            fine = {**radians, "camera": {"pitch_deg": pitch}}
            self.assertNotIn("radians", printed("check", self.job(drones=[fine])), pitch)
        self.refused("1 to ", "check", self.job(crowd={"agents": 1_000_000}))
        capture = {"to_s": 1, "rate_hz": 1}
        said = printed("check", self.job(scenario="concert/everyday", crowd={"agents": 2000}, capture=capture))
        self.assertRegex(said, r"people +about 1\d+ of 2000, as the others come after the end")

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

    def test_options_that_are_cut_short_find_their_whole_names(self):
        job = self.job()
        for option in ("--out", "-out", "--outp=x"):
            self.refused(f'unknown option "{option.split("=")[0]}"; did you mean "--output"?', "run", job, option, "x")
        self.refused('unknown option "-O"; did you mean "-o"?', "run", job, "-O", "x")

    def test_a_trace_is_expected(self):
        job = self.job()
        table = self.folder / "people.csv"
        table.write_text("id,frame,x,y\n1,0,0,0\n")
        for command in (["metrics"], ["report", "-o", self.folder / "r.html"], ["render", job, "-o", "x", "--trace"]):
            self.refused("my.job.json: found a job, expected a trace (HDF5); `throng simulate ", *command, job)
            self.refused("found a table, expected a trace (HDF5); `throng metrics --trajectory ", *command, table)
        (self.folder / "out/work/run000").mkdir(parents=True)
        (self.folder / "out/work/run000/trace.h5").touch()
        self.refused("out: found the folder of a job, expected a trace", "metrics", self.folder / "out")
        (self.folder / "d").mkdir()
        (self.folder / "d/manifest.json").touch()
        self.refused("d: found a dataset, expected a trace (HDF5); its figures are in ", "metrics", self.folder / "d")
        trace = self.folder / "run.h5"
        trace.write_bytes(b"\x89HDF\r\n\x1a\n")
        self.refused("run.h5: found HDF5 that is damaged or cut short", "metrics", "--trajectory", trace)
        self.refused("found a job, expected a file of trajectories", "metrics", "--trajectory", job)

    def test_endings_of_files_to_write_are_checked_first(self):
        job = self.job(capture={"to_s": 7000})
        self.refused("--output: found r.csv, expected a file whose name ends with .h5", "simulate", job, "-o", "r.csv")
        self.refused("--output: found r.pdf, expected a file whose name ends with .html", "report", "x", "-o", "r.pdf")
        self.refused(
            "--csv: found x.json, expected a file whose name ends with .csv", "metrics", "x", "--csv", "x.json"
        )

    def test_validate_says_that_there_is_no_dataset(self):
        self.refused("nowhere: found no such file, expected the folder of a finished dataset", "validate", "nowhere")
        self.refused("found a file, expected the folder of a finished dataset", "validate", self.job())

    def test_faults_of_json_are_in_words_wherever_it_is_read(self):
        bad = self.folder / "bad.json"
        for command in (
            ["check"],
            ["scenario", "make"],
            ["scenario", "plan", "-o", self.folder / "x.svg"],
            ["study", "-o", self.folder / "x"],
        ):
            bad.write_text('{\n  "name": "x",\n}\n')
            expected = f"{bad}: line 2, column 14: found a comma too many before }}, expected no comma after the last"
            self.refused(expected, *command, bad)
            bad.write_bytes('{"name": "x"}'.encode("utf-16"))
            self.refused(f"{bad}: found a file in UTF-16, expected valid JSON in UTF-8", *command, bad)
            bad.write_text("")
            self.refused(f"{bad}: found an empty file, expected valid JSON", *command, bad)

    def test_a_full_disk_is_said(self):
        for command in (["schema", "job"], ["--help"], ["scenarios"], ["manual"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([THRONG, *command], stdout=full, stderr=subprocess.PIPE, text=True, timeout=100)
            self.assertEqual(done.returncode, 3, command)
            self.assertIn("No space left on device", done.stderr)

    def test_a_job_among_the_scenarios_breaks_nothing(self):
        folder = self.folder / "scenarios"
        shutil.copytree(SCENARIOS / "bridge", folder / "bridge")
        (folder / "job.json").write_text('{"scenario": "bridge/everyday"}')
        (folder / "bridge/job.json").write_text('{"scenario": "bridge/everyday"}')
        done = throng("scenarios", variables={"THRONG_SCENARIOS": folder})
        self.assertEqual(done.stderr, "")
        self.assertEqual(
            [line.split()[0] for line in done.stdout.splitlines()], ["bridge/emergency", "bridge/everyday"]
        )
        throng("scenario", "check", folder)
        # One that is broken hides no other.
        (folder / "broken.json").write_text('{"ground": 5}')
        done = throng("scenarios", variables={"THRONG_SCENARIOS": folder}, code=2)
        self.assertIn("bridge/everyday", done.stdout)
        self.assertIn("broken.json: ", done.stderr)

    def test_the_progress_bar_keeps_to_the_terminal(self):
        job = self.job(name="a job with a name that is long", capture={"to_s": 3}, crowd={"agents": 20})
        for columns in (20, 47, 200):
            master, slave = pty.openpty()
            fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 20, columns, 0, 0))
            command = [THRONG, "simulate", job, "-o", self.folder / "run.h5"]
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=slave)
            os.close(slave)
            shown = b""
            with contextlib.suppress(OSError):  # the end of a terminal
                while part := os.read(master, 4096):
                    shown += part
            os.close(master)
            self.assertEqual(process.wait(timeout=100), 0, shown)
            lines = [line for line in shown.decode().replace("\n", "\r").split("\r") if line]
            bars = [line for line in lines if "%" in line]
            self.assertTrue(bars, lines)
            self.assertLess(max(map(len, bars)), columns, bars)

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
        url = self.serve()
        for command in ("watch", "cancel", "retry", "remove", "logs", "fetch"):
            self.refused(
                f'unknown job "nope" on {url}; expected an id that `throng jobs` lists', command, "nope", THRONG_URL=url
            )
        job = printed("submit", self.job(capture={"to_s": 1}), variables={"THRONG_URL": url}).strip()
        self.refused(f'unknown job "{job[:-1]}" on {url}; did you mean "{job}"?', "watch", job[:-1], THRONG_URL=url)
        throng("cancel", job, variables={"THRONG_URL": url})

    def test_a_server_that_is_not_there_is_named(self):
        url = f"http://127.0.0.1:{free_port()}"
        self.refused(f"cannot reach {url} (is `throng serve` running?", "jobs", code=3, THRONG_URL=url)

    def test_ports_and_addresses_say_why(self):
        port = self.serve().rpartition(":")[2]
        serve = ("serve", "--data", self.folder / "other")
        self.refused("another program listens there", *serve, "--port", port, code=3)
        self.refused(
            "Cannot assign requested address", *serve, "--port", 0, "--host", "192.0.2.1", "--insecure", code=3
        )
        self.refused("it does not speak TLS", "jobs", code=3, THRONG_URL=f"https://127.0.0.1:{port}")

    def test_renamed_options_keep_their_old_names_with_a_warning(self):
        data = self.folder / "data"
        done = throng("keys", "create", "alice", "--data", data, "--most-jobs", "3", "--most-gib=2")
        self.assertIn("--most-jobs is deprecated, use --max-jobs", done.stderr)
        self.assertIn("--most-gib is deprecated, use --max-gib", done.stderr)
        done = throng("calibrate", "intrinsics", "--picture=plot.svg", code=None)
        self.assertIn("--picture is deprecated, use --plot", done.stderr)
        self.assertEqual(throng("keys", "create", "bob", "--data", data, "--max-jobs", "3").stderr, "")
        throng("keys", "create", "eve", "--data", data, "--most-jobs", "-3", code=2)


unittest.main()
