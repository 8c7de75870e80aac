#!/usr/bin/env python3
"""Traces damaged by seed: every command that reads one either works or says what is wrong with which file (exit code 2),
and is never ended by a signal. The HDF5 library itself crashes on some of these files.
usage: test_damaged_traces.py THRONG
"""
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import tempfile
import unittest

import program

JOB = {
    "scenario": "city_square/emergency",
    "seed": 3,
    "crowd": {"agents": 25},
    "capture": {"rate_hz": 1, "from_s": 0, "to_s": 6},
}
BYTE_DAMAGES = 16
CRASH = "a damaged HDF5 file, which cannot be read"


def throng(*words):
    return program.throng(*words, errors="replace", code=None)


def address_damages(data):
    """Addresses of the file's trees, heaps and symbol nodes, each replaced by the undefined one, at which the library
    crashes, and by one that is out of the file, at its end, of another structure or a little off."""
    structures = [found.start() for found in re.finditer(rb"TREE|HEAP|SNOD", data)]
    places = set()
    for structure in structures:
        address = structure.to_bytes(8, "little")
        places |= {found.start() for found in re.finditer(re.escape(address), data) if found.start() % 8 == 0}
    for i, place in enumerate(sorted(places)):
        right = int.from_bytes(data[place : place + 8], "little")
        others = (2**62, len(data) - 4, 0, structures[0], structures[-1], right + 8)
        for wrong in (2**64 - 1, others[i // 2 % len(others)])[: 1 + i % 2]:
            yield f"{wrong} at {place}", data[:place] + wrong.to_bytes(8, "little") + data[place + 8 :]


def byte_damages(data):
    """Single bytes, words, runs of zeros and of noise, and missing ends; half of them near the structures, where
    metadata is."""
    near = [found.start() for found in re.finditer(rb"TREE|HEAP|SNOD", data)]
    for seed in range(BYTE_DAMAGES):
        chance = random.Random(seed)
        damaged = bytearray(data)
        for _ in range(chance.choice([1, 5, 20])):
            place = chance.choice(near) + chance.randrange(-300, 600) if seed % 2 else chance.randrange(len(data))
            place = min(max(place, 0), len(data) - 16)
            kind = chance.randrange(4)
            if kind == 0:
                damaged[place] = chance.randrange(256)
            elif kind == 1:
                word = place - place % 8
                damaged[word : word + 8] = chance.choice([b"\xff" * 8, bytes(8), (2**31).to_bytes(8, "little")])
            elif kind == 2:
                damaged[place : place + 16] = chance.randbytes(16)
            else:
                damaged[place : place + 8] = bytes(8)
        yield f"seed {seed}", bytes(damaged)
        if seed % 8 == 0:
            yield f"seed {seed}, cut", data[: chance.randrange(len(data))]


class DamagedTraces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.job = program.write_json(cls.folder / "job.json", JOB)
        cls.sound = cls.folder / "sound.h5"
        program.throng("simulate", cls.job, "-o", cls.sound)
        program.throng("metrics", cls.sound)
        cls.files = []
        data = cls.sound.read_bytes()
        addresses = list(address_damages(data))[:: 1 if os.environ.get("THRONG_LONG") else 4]
        for name, content in [*addresses, *byte_damages(data)]:
            file = cls.folder / f"damaged{len(cls.files)}.h5"
            file.write_bytes(content)
            cls.files.append((name, file))

    def check(self, name, file, done):
        """Whether the file was refused; fails unless the command ended as it should."""
        with self.subTest(damage=name, arguments=done.args[1:]):
            self.assertIn(done.returncode, (0, 2), done.stderr[-2000:])
            if done.returncode == 2:
                self.assertRegex(done.stderr, f"^throng: {re.escape(str(file))}: .*found .*expected ")
        return done.returncode == 2

    def test_what_is_no_file_is_refused(self):
        for name in ("missing.h5", "folder.h5"):
            file = self.folder / name
            if name == "folder.h5":
                file.mkdir()
            for command in (
                ["metrics", file],
                ["metrics", self.sound, "--without-guides", file],
                ["report", file, "-o", self.folder / "report.html"],
                ["scenario", "plan", JOB["scenario"], "--trace", file, "-o", self.folder / "plan.svg"],
                ["render", self.job, "--trace", file, "-o", self.folder / "rendered"],
            ):
                self.assertTrue(self.check(name, file, throng(*command)))

    def test_each_is_read_or_refused(self):
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(lambda named: (*named, throng("metrics", named[1])), self.files))
        refused = [(name, file) for name, file, done in results if self.check(name, file, done)]
        self.assertGreater(len(self.files), 20)
        self.assertGreater(len(refused), 0.3 * len(self.files))
        crashing = [(name, file) for name, file, done in results if CRASH in done.stderr]
        self.assertGreater(len(crashing), 0)
        others = [named for named in refused if named not in crashing]
        for name, file in [crashing[0], crashing[-1], others[0], others[-1]]:
            self.check(name, file, throng("report", file, "-o", self.folder / "report.html"))
            plan = throng("scenario", "plan", JOB["scenario"], "--trace", file, "-o", self.folder / "plan.svg")
            self.check(name, file, plan)
            self.check(name, file, throng("render", self.job, "--trace", file, "-o", self.folder / "rendered"))
            self.assertFalse((self.folder / "rendered").exists())
            second = throng("metrics", self.sound, "--without-guides", file)
            self.assertTrue(self.check(name, file, second))

    def test_a_job_makes_its_own_trace_again(self):
        """The trace of a run that was interrupted is damaged, also in ways at which the library crashes."""
        small = {
            "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 160, "height": 120}}],
            "outputs": {"annotations": ["coco"]},
        }
        job = {**JOB, "capture": {"rate_hz": 1, "from_s": 0, "to_s": 2}, **small}
        output = program.made(self.folder, job, "small")
        manifest = (output / "dataset" / "manifest.json").read_bytes()
        trace = output / "work" / "run000" / "trace.h5"
        sound = trace.read_bytes()
        structure = sound.find(b"TREE", 1000)
        place = sound.find(structure.to_bytes(8, "little"))
        damages = [sound[:place] + b"\xff" * 8 + sound[place + 8 :], sound[: len(sound) // 2], b"", sound + b"x"]
        for damaged in damages:
            for left in (output / "dataset", *trace.parent.glob("shard*")):
                shutil.rmtree(left)
            trace.write_bytes(damaged)
            program.throng("run", self.folder / "small.json", "-o", output)
            self.assertEqual(trace.read_bytes(), sound)
            self.assertEqual((output / "dataset" / "manifest.json").read_bytes(), manifest)


if __name__ == "__main__":
    unittest.main()
