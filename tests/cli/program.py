"""The program under test, whose path is the first argument of each test, as a user runs it.

usage of each test: test_X.py THRONG [unittest's arguments]"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from service import start_service

THRONG = str(pathlib.Path(sys.argv.pop(1)).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(*command, code=0, variables=None, **options):
    """Runs a command, which has to end with this exit code (None: with any). Variables are added to the environment; options
    are those of subprocess.run."""
    command = [str(word) for word in command]
    options = {"capture_output": True, "text": True, "encoding": "utf-8", "timeout": 600, **options}
    if variables:
        options["env"] = {**os.environ, **{name: str(value) for name, value in variables.items()}}
    done = subprocess.run(command, **options)
    if code not in (None, done.returncode):
        raise AssertionError(f"{command}: exit code {done.returncode} is not {code}\n{done.stdout}{done.stderr}")
    return done


def throng(*words, **options):
    return run(THRONG, *words, **options)


def printed(*words, code=0, **options):
    """Output of the program; where it has to fail, its messages."""
    done = throng(*words, code=code, **options)
    return done.stderr if code else done.stdout


def write_json(file, value):
    file.write_text(json.dumps(value), encoding="utf-8")
    return file


def made(folder, job, name="job"):
    """The folder NAME of a job that has run, whose file is NAME.json."""
    throng("run", write_json(folder / f"{name}.json", job), "-o", folder / name)
    return folder / name


class FolderTest(unittest.TestCase):
    """Each test has an empty folder."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def serve(self, *options, **of_process):
        """The address of a service, which ends with the test."""
        process, port = start_service(THRONG, self.folder / "data", *options, **of_process)
        self.addCleanup(process.wait, 300)
        self.addCleanup(process.terminate)
        return f"http://127.0.0.1:{port}"
