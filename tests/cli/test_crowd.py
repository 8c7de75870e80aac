"""throng crowd: Menge projects from the command line, and what comes of them."""
import csv
import json
import os
import pathlib
import signal
import struct
import subprocess
import time
import unittest

from program import ROOT, THRONG, FolderTest, throng

EXAMPLES = ROOT.parent / "shared" / "data" / "menge_examples"

SCENE = """<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/>
  <Common time_step="0.1"/>
  <AgentProfile name="p"><Common r="0.2" pref_speed="1.3" {common}/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="p"/>
    <StateSelector type="const" name="Walk"/>
    <Generator type="rect_grid" anchor_x="-8" anchor_y="0" offset_x="1" offset_y="1" count_x="{n}" count_y="{n}"/>
  </AgentGroup>
</Experiment>"""
BEHAVIOR = """<BFSM>
  <GoalSet id="0"><Goal type="AABB" id="0" min_x="10" max_x="20" min_y="-10" max_y="10"/></GoalSet>
  <State name="Walk" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/><VelComponent type="goal"/></State>
  <State name="Stop" final="1"/>
  <Transition from="Walk" to="Stop"><Condition type="goal_reached" distance="0"/></Transition>
</BFSM>"""


def crowd(*words, **options):
    return throng("crowd", *words, **options)


def read_scb(path):
    """The frames of a version 2.1 file, each a list of (x, y, orientation, state)."""
    data = pathlib.Path(path).read_bytes()
    assert data[:4] == b"2.1\0", data[:4]
    (count,) = struct.unpack_from("<i", data, 4)
    header = 12 + 4 * count
    frame = 16 * count
    assert (len(data) - header) % frame == 0
    return [list(struct.iter_unpack("<4f", data[at : at + frame])) for at in range(header, len(data), frame)]


def read_rows(path):
    with open(path) as file:
        return list(csv.DictReader(file))


class Crowd(FolderTest):
    def setUp(self):
        super().setUp()
        self.write(n=3)

    def write(self, n, common="", project=""):
        (self.folder / "scene.xml").write_text(SCENE.format(n=n, common=common))
        (self.folder / "behavior.xml").write_text(BEHAVIOR)
        self.project = self.folder / "project.xml"
        self.project.write_text(f'<Project scene="scene.xml" behavior="behavior.xml" model="orca" view="" {project}/>')

    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def test_runs_until_all_are_in_final_states(self):
        out, series, positions = self.folder / "out.scb", self.folder / "s.csv", self.folder / "p.csv"
        done = crowd(self.project, "-o", out, "--series", series, "--positions", positions)
        self.assertRegex(done.stdout, r"^9 agents, [\d.]+ s in \d+ steps, .* 9 of 9 in final states\n$")
        frames = read_scb(out)
        self.assertEqual(len(frames[0]), 9)
        self.assertEqual(frames[0][0][:2], (-8.0, 0.0))
        self.assertTrue(all(agent[3] == 1 for agent in frames[-1]))
        self.assertFalse(all(agent[3] == 1 for agent in frames[-2]))
        rows = read_rows(series)
        self.assertEqual(rows[0]["time"], "0.0000")
        self.assertEqual(rows[-1]["frac_final_state"], "1.0000")
        self.assertEqual(rows[-1]["time"], f"{(len(frames) - 1) / 10:.4f}")
        places = read_rows(positions)
        self.assertEqual(len(places), 6 * 9)
        self.assertAlmostEqual(float(places[-1]["x"]), frames[-1][-1][0], places=4)

    def test_the_command_line_overrides_the_project(self):
        self.write(n=2, project='duration="1" timeStep="0.5" output="ours.scb" scbVersion="2.2"')
        self.assertEqual(crowd(self.project, "-q").stdout, "")
        self.assertEqual((self.folder / "ours.scb").stat().st_size, 12 + 4 * 4 + 3 * 4 * 32)
        crowd(
            self.project, "-d", "2", "-t", "0.25", "--sub-steps", "1", "-o", self.folder / "b", "--scb-version", "2.1"
        )
        self.assertEqual(len(read_scb(self.folder / "b.scb")), 9)
        other = self.folder / "other.xml"
        other.write_text(SCENE.format(n=1, common=""))
        crowd("-s", other, "-b", self.folder / "behavior.xml", "-d", "0", "-o", self.folder / "c.scb")
        self.assertEqual([len(f) for f in read_scb(self.folder / "c.scb")], [1])

    def test_writes_a_trace(self):
        crowd(self.project, "-o", self.folder / "trace.h5", "-d", "3")
        self.assertEqual((self.folder / "trace.h5").read_bytes()[:8], b"\x89HDF\r\n\x1a\n")

    def test_is_the_same_for_any_number_of_threads(self):
        self.write(n=40, common='max_accel="4"')
        for threads in (1, 2, 5):
            crowd(self.project, "-d", "5", "--threads", threads, "-o", self.folder / f"{threads}.scb")
        one = (self.folder / "1.scb").read_bytes()
        self.assertEqual(one, (self.folder / "2.scb").read_bytes())
        self.assertEqual(one, (self.folder / "5.scb").read_bytes())

    def test_takes_positions_at_given_times(self):
        crowd(self.project, "--positions", self.folder / "p.csv", "--at", "0.5,2")
        self.assertEqual([row["time"] for row in read_rows(self.folder / "p.csv")], ["0.5000"] * 9 + ["2.0000"] * 9)

    def test_says_what_is_wrong_and_leaves_nothing(self):
        before = self.names()
        cases = [
            ([], "nothing"),
            ([self.folder], "no file"),
            ([self.folder / "nowhere.xml"], "no file"),
            ([self.folder / "scene.xml"], "<Project>"),
            ([self.project, "-m", "orka"], "orca"),
            ([self.project, "-d", "-1"], "duration"),
            ([self.project, "-t", "0"], "time-step"),
            ([self.project, "--compat", "meng"], "compat"),
            ([self.project, "--scb-version", "9"], "scb-version"),
            ([self.project, "--at", "3"], "positions"),
            ([self.project, "-s", self.folder / "behavior.xml", "-o", self.folder / "o.scb"], "<Experiment>"),
        ]
        for arguments, said in cases:
            done = crowd(*arguments, code=2)
            self.assertIn(said, done.stderr)
        done = crowd(self.project, "-o", self.folder / "project.xml" / "below.scb", code=3)
        self.assertEqual(self.names(), before)

    def test_warns_with_a_suggestion(self):
        self.write(n=1, common='max_sped="3"', project='random="0"')
        done = crowd(self.project, "-d", "1")
        self.assertIn("did you mean max_speed?", done.stderr)
        self.assertIn("every run of Menge another one", done.stderr)
        self.assertEqual(crowd(self.project, "-d", "1", "--quiet").stderr, "")

    def test_ends_cleanly_when_it_is_interrupted(self):
        self.write(n=60, project='timeStep="0.001" duration="100000"')
        before = self.names()
        process = subprocess.Popen(
            [
                THRONG,
                "crowd",
                self.project,
                "-o",
                self.folder / "o.scb",
                "--series",
                self.folder / "s.csv",
                "--positions",
                self.folder / "p.csv",
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        deadline = time.monotonic() + 300
        while len(self.names()) < len(before) + 3 and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertNotIn("o.scb", self.names())
        os.kill(process.pid, signal.SIGINT)
        said = process.communicate(timeout=300)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("cancelled", said)
        self.assertEqual(self.names(), before)

    def test_takes_menge_s_command_lines(self):
        words = "--view view.xml -u images --verbose --subSteps 1 -d 1 --scbVersion 2.2 -o".split()
        crowd("-p", self.project, *words, self.folder / "o")
        self.assertTrue((self.folder / "o.scb").exists())

    def test_a_seed_of_0_is_one_of_1(self):
        self.write(n=20, project='duration="2"')
        written = []
        for seed in ("0", "1", "2"):
            done = crowd(self.project, "-r", seed, "--series", self.folder / "s.csv")
            self.assertEqual("taken for 1" in done.stderr, seed == "0", done.stderr)
            written.append((self.folder / "s.csv").read_text())
        self.assertEqual(written[0], written[1])

    def test_lists_what_the_files_may_say(self):
        kinds = {kind["kind"]: kind for kind in json.loads(crowd("--list", "--json").stdout)}
        conditions = {entry["name"]: entry for entry in kinds["Conditions"]["entries"]}
        (distance,) = [a for a in conditions["goal_reached"]["attributes"] if a["name"] == "distance"]
        self.assertEqual(distance["default"], "0")
        self.assertIn("goal_reached", crowd("--list").stdout)

    @unittest.skipUnless(EXAMPLES.exists(), "Menge's examples are not here")
    def test_runs_menge_s_examples_unchanged(self):
        for project in sorted(EXAMPLES.glob("*.xml")):
            crowd(project, "-d", "2", "-r", "1234", "--compat", "menge", "--series", self.folder / "s.csv")
            reference = EXAMPLES / "reference" / f"core_{project.stem}.csv"
            self.assertEqual((self.folder / "s.csv").read_text().splitlines()[0], reference.read_text().splitlines()[0])


unittest.main()
