"""The figures of `throng metrics`, against an independent implementation of the same definitions (docs/metrics.md)
with NumPy, and the trajectories that it writes, read with Python's own library. Skipped without h5py."""
import csv
import gzip
import importlib.util
import json
import math
import os
import pathlib
import sqlite3
import struct
import subprocess
import tempfile
import unittest

import numpy

from program import THRONG, printed, throng


WIDTH = 1.2
BUILDINGS = [[[0, -10], [4, -10], [4, -WIDTH / 2], [0, -WIDTH / 2]], [[0, WIDTH / 2], [4, WIDTH / 2], [4, 10], [0, 10]]]
INSIDE = {"min": [-20, -12], "max": [3, 12]}

SCENE = """<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
<AgentProfile name="a"><Common r="0.25" max_accel="5"><Property name="pref_speed" dist="n" mean="1.3" stddev="0.2"/></Common>
<ORCA tau="2" tauObst="0.3"/></AgentProfile>
<AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Walk"/>
<Generator type="rect_grid" anchor_x="-8" anchor_y="-4" offset_x="0.9" offset_y="1" count_x="8" count_y="9"
 displace_dist="u" displace_min="0" displace_max="0.1"/></AgentGroup>
<ObstacleSet type="explicit" class="1">{}</ObstacleSet></Experiment>""".format(
    "".join(
        '<Obstacle closed="1">' + "".join(f'<Vertex p_x="{x}" p_y="{y}"/>' for x, y in building) + "</Obstacle>"
        for building in BUILDINGS
    )
)
BEHAVIOR = """<BFSM><GoalSet id="0"><Goal id="0" type="AABB" min_x="12" min_y="-1" max_x="14" max_y="1"/></GoalSet>
<State name="Walk" final="0"><GoalSelector type="nearest" goal_set="0"/><VelComponent type="auto"/></State>
<State name="Out" final="1"/><Transition from="Walk" to="Out"><Condition type="goal_reached"/></Transition></BFSM>"""
PLACE = {
    "name": "yard with a door",
    "crowd": {"scene": "scene.xml", "behavior": "behavior.xml"},
    "ground": {"min": [-30, -20], "max": [30, 20], "material": "asphalt"},
    "inside": INSIDE,
    "exits": [{"id": "door", "from": [0, -WIDTH / 2], "to": [0, WIDTH / 2], "outward": [1, 0], "goals": [[0, 0]]}],
    "buildings": [{"id": f"b{i}", "footprint": corners, "height_m": 5} for i, corners in enumerate(BUILDINGS)],
}


@unittest.skipUnless(importlib.util.find_spec("h5py") or os.environ.get("CI"), "h5py is not installed")
class Metrics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import h5py

        base = cls.base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (base / "scene.xml").write_text(SCENE)
        (base / "behavior.xml").write_text(BEHAVIOR)
        (base / "place.json").write_text(json.dumps(PLACE))
        scene = ["-s", base / "scene.xml", "-b", base / "behavior.xml"]
        throng("crowd", *scene, *"-m orca -r 5 -d 90 -q -o".split(), base / "run.h5")
        place = ["--scenario", base / "place.json", "--csv", base / "exits.csv"]
        throng("metrics", base / "run.h5", *place, "-o", base / "run.json")
        cls.figures = json.loads((base / "run.json").read_text())
        with open(base / "exits.csv", newline="") as file:
            cls.rows = list(csv.DictReader(file))
        with h5py.File(base / "run.h5") as file:
            cls.time = file["crowd/time_s"][:]
            cls.place = file["crowd/position"][:].astype(float)
            cls.velocity = file["crowd/velocity"][:].astype(float)
            cls.desired = file["crowd/desired_speed_mps"][:].astype(float)
            cls.radius = float(file["agents/radius_m"][:].mean())
        cls.zone_radius = max(WIDTH, 2) + 1
        # Some go around the end of the wall, since the queue at the door takes longer.
        beyond = cls.place[..., 0] >= 0.2
        people = numpy.arange(beyond.shape[1])
        cls.by_door = beyond.any(axis=0) & (numpy.abs(cls.place[beyond.argmax(axis=0), people, 1]) < WIDTH)
        cls.in_zone = (cls.place[..., 0] < 0) & (numpy.hypot(cls.place[..., 0], cls.place[..., 1]) < cls.zone_radius)

    def column(self, name):
        return numpy.array([float(row[name]) for row in self.rows])

    def crossed(self):
        """Cumulative crossings outward; who is 0.2 m beyond the line has crossed. In this place nobody comes back."""
        beyond = numpy.maximum.accumulate(self.place[..., 0], axis=0) >= 0.2
        return beyond[:, self.by_door].sum(axis=1)

    def test_crossings_and_flow(self):
        crossed = self.crossed()
        self.assertEqual(crossed[0], 0)
        self.assertGreater(crossed[-1], 50)
        numpy.testing.assert_array_equal(self.column("crossed_out"), crossed)
        earlier = numpy.concatenate([numpy.zeros(40), crossed[:-40]])
        numpy.testing.assert_allclose(self.column("flow"), (crossed - earlier) / 4, atol=0.006)
        numpy.testing.assert_allclose(self.column("specific_flow"), (crossed - earlier) / 4 / WIDTH, atol=6e-4)

    def test_density_and_clogging_index(self):
        area = math.pi * self.zone_radius**2 / 2
        count = self.in_zone.sum(axis=1)
        density = count / area
        numpy.testing.assert_array_equal(self.column("in_zone"), count)
        numpy.testing.assert_allclose(self.column("density"), density, atol=2e-4)
        eta = density * 2 * math.sqrt(3) * self.radius**2
        numpy.testing.assert_allclose(self.column("normalised_density"), eta, atol=2e-4)
        to_door = -self.place / numpy.linalg.norm(self.place, axis=2, keepdims=True)
        ahead = (self.velocity * to_door).sum(axis=2)
        some = numpy.maximum(count, 1)
        approach = (ahead * self.in_zone).sum(axis=1) / some
        desired = (self.desired * self.in_zone).sum(axis=1) / some
        numpy.testing.assert_allclose(self.column("approach_speed"), approach, atol=2e-4)
        demand = count >= math.ceil(WIDTH / (2 * self.radius)) + 1
        flow = self.column("flow")
        lack = numpy.clip(1 - flow / (1.3 * WIDTH), 0, 1) + numpy.clip(
            1 - approach / numpy.maximum(0.6 * desired, 1e-9), 0, 1
        )
        index = demand * numpy.minimum(1, eta / 0.6) * 0.5 * lack
        numpy.testing.assert_allclose(self.column("clogging_index"), index, atol=2e-3)
        self.assertGreater(index.max(), 0.2, "there is something to compare")

    def test_voronoi_density_by_raster(self):
        """Everybody's cell drawn in squares of 4 cm."""
        cell = 0.04
        x, y = numpy.meshgrid(numpy.arange(-7, 4, cell) + cell / 2, numpy.arange(-6, 6, cell) + cell / 2)
        free = (x < 0) | ((abs(y) < WIDTH / 2) & (x < 4))
        zone = (x < 0) & (numpy.hypot(x, y) < self.zone_radius)
        measured = self.column("voronoi_density")
        compared = 0
        for step in range(30, len(self.time), 60):
            near = self.place[step][
                (numpy.linalg.norm(self.place[step], axis=1) < self.zone_radius + 6) & (self.place[step][:, 0] < 4)
            ]
            if len(near) == 0:
                continue
            distance = numpy.stack([(x - px) ** 2 + (y - py) ** 2 for px, py in near])
            owner = distance.argmin(axis=0)
            owned = free & (distance.min(axis=0) < 4)
            people = 0.0
            for i in range(len(near)):
                mine = owned & (owner == i)
                people += (mine & zone).sum() / max(mine.sum(), 1)
            expected = people / (math.pi * self.zone_radius**2 / 2)
            self.assertAlmostEqual(measured[step], expected, delta=0.03 * expected + 0.01, msg=f"step {step}")
            compared += 1
        self.assertGreater(compared, 3)

    def test_queue_and_wait(self):
        """People who can be reached from the zone over links of 1.2 m, by relaxing until nothing gets shorter."""
        speed = numpy.hypot(self.velocity[..., 0], self.velocity[..., 1])
        slow = (self.place[..., 0] < 0) & (speed < 0.5 * self.desired)
        crossed = self.crossed()
        compared = 0
        for step in range(0, len(self.time), 10):
            who = numpy.flatnonzero(slow[step])
            at = self.place[step, who]
            way = numpy.where(self.in_zone[step, who], numpy.hypot(at[:, 0], at[:, 1]), numpy.inf)
            link = numpy.linalg.norm(at[:, None] - at[None], axis=2)
            link[link > 1.2] = numpy.inf
            while len(who):
                shorter = numpy.minimum(way, (way[None] + link).min(axis=1))
                if (shorter == way).all():
                    break
                way = shorter
            queue = numpy.isfinite(way)
            self.assertEqual(float(self.rows[step]["queue"]), queue.sum(), f"step {step}")
            self.assertAlmostEqual(float(self.rows[step]["queue_length"]), way[queue].max(initial=0), delta=6e-3)
            # Of the last 200 steps those that began with a queue, and 10 s at the capacity of that part of the door before
            # which the queue stands in the zone.
            across = at[self.in_zone[step, who], 1]
            used = min(WIDTH, max(0.8, (numpy.ptp(across) if len(across) else 0) + 2 * self.radius))
            last = [s for s in range(max(1, step - 199), step + 1) if float(self.rows[s - 1]["queue"]) > 0]
            served = sum(crossed[s] - crossed[s - 1] for s in last)
            wait = queue.sum() / ((served + 10 * 1.3 * used) / (0.1 * len(last) + 10))
            self.assertAlmostEqual(float(self.rows[step]["predicted_wait"]), wait, delta=0.01 + 1e-3 * wait)
            compared += queue.sum() > 5
        self.assertGreater(compared, 10, "there were queues to compare")

    def pressure_at(self, step, places):
        squared = ((places[:, None] - self.place[step][None]) ** 2).sum(axis=2)
        weight = numpy.where(squared <= 4, numpy.exp(-squared), 0)
        total = numpy.maximum(weight.sum(axis=1), 1e-300)
        mean = weight @ self.velocity[step] / total[:, None]
        variance = weight @ (self.velocity[step] ** 2).sum(axis=1) / total - (mean**2).sum(axis=1)
        return total / (math.pi * (1 - math.exp(-4))) * numpy.maximum(0, variance)

    def test_pressure(self):
        edge = numpy.arange(-8, 8) * 0.5 + 0.25
        places = numpy.stack(numpy.meshgrid(edge, edge), axis=2).reshape(-1, 2)
        places = places[(places[:, 0] < 0) & (numpy.hypot(places[:, 0], places[:, 1]) < self.zone_radius)]
        greatest = []
        for end in range(20, len(self.time), 50):
            mean = sum(self.pressure_at(step, places) for step in range(end - 9, end + 1)) / 10
            greatest.append(mean.max())
            self.assertAlmostEqual(float(self.rows[end]["pressure"]), mean.max(), delta=1e-3 + 1e-3 * mean.max())
        self.assertGreater(max(greatest), 0.05, "there was something to compare")
        overall = self.figures["exposure"]["max_pressure_per_s2"]
        self.assertGreater(overall, 0.8 * self.column("pressure").max(), "the ground's lattice is another one")

    def test_gaps(self):
        """From the moments on the line, between two steps."""
        x = self.place[..., 0]
        out = []
        for person in range(x.shape[1]):
            beyond = numpy.flatnonzero(x[:, person] >= 0.2)
            if self.by_door[person]:
                last = numpy.flatnonzero(x[: beyond[0], person] < 0)[-1]
                share = x[last, person] / (x[last, person] - x[last + 1, person])
                out.append(self.time[last] + share * (self.time[last + 1] - self.time[last]))
        gaps = numpy.diff(numpy.sort(out))
        figures = self.figures["exits"][0]["gaps"]
        self.assertEqual(figures["count"], len(gaps))
        numpy.testing.assert_allclose(figures["list_s"], gaps, atol=1e-5)
        self.assertAlmostEqual(figures["median_s"], numpy.median(gaps), delta=1e-5)
        self.assertAlmostEqual(figures["p90_s"], numpy.quantile(gaps, 0.9), delta=1e-5)

    def test_edie(self):
        """Every way between two steps in fifty pieces."""
        demand = self.column("demand")[:-1] > 0
        part = (numpy.arange(50) + 0.5) / 50
        person_s = walked = 0.0
        for step in numpy.flatnonzero(demand):
            start, way = self.place[step], self.place[step + 1] - self.place[step]
            at = start[:, None] + part[None, :, None] * way[:, None]
            share = ((at[..., 0] < 0) & (numpy.hypot(at[..., 0], at[..., 1]) < self.zone_radius)).mean(axis=1)
            person_s += share.sum() * 0.1
            walked += (share * numpy.linalg.norm(way, axis=1)).sum()
        region = demand.sum() * 0.1 * math.pi * self.zone_radius**2 / 2
        edie = self.figures["exits"][0]["edie"]
        self.assertAlmostEqual(edie["density_per_m2"] / (person_s / region), 1, delta=2e-3)
        self.assertAlmostEqual(edie["flow_per_ms"] / (walked / region), 1, delta=2e-3)
        self.assertAlmostEqual(edie["speed_mps"] / (walked / person_s), 1, delta=2e-3)

    def test_escape_percentiles(self):
        outside = ((self.place < INSIDE["min"]) | (self.place > INSIDE["max"])).any(axis=2)
        first = numpy.where(outside.any(axis=0), self.time[outside.argmax(axis=0)], numpy.inf)
        ordered = numpy.sort(first)
        for percent in (50, 80, 90, 95, 99, 100):
            expected = ordered[math.ceil(percent * len(ordered) / 100) - 1]
            value = self.figures["escape_time_percentiles"][f"t{percent}_s"]
            if math.isinf(expected):
                self.assertIsNone(value)
            else:
                self.assertAlmostEqual(value, expected, delta=1e-6)
        censored = numpy.minimum(first, self.time[-1]).mean()
        self.assertAlmostEqual(self.figures["mean_escape_time_censored_s"], censored, delta=1e-6)
        self.assertEqual(self.figures["not_escaped"], int(numpy.isinf(first).sum()))

    def assert_places(self, rows):
        """Rows of id, frame, x, y."""
        self.assertEqual(len(rows), self.place.shape[0] * self.place.shape[1])
        for person, frame, x, y in rows[:: max(1, len(rows) // 500)]:
            numpy.testing.assert_allclose([x, y], self.place[frame, person - 1], atol=1e-4)

    def test_text_for_pedpy(self):
        throng("metrics", self.base / "run.h5", "--to", self.base / "run.txt")
        lines = (self.base / "run.txt").read_text().splitlines()
        self.assertEqual(lines[0], "# framerate: 10")
        rows = [line.split() for line in lines if not line.startswith("#")]
        self.assert_places([(int(a), int(f), float(x), float(y)) for a, f, x, y in rows])

    def test_sqlite_of_jupedsim(self):
        throng("metrics", self.base / "run.h5", "--to", self.base / "run.sqlite")
        with sqlite3.connect(self.base / "run.sqlite") as database:
            metadata = dict(database.execute("SELECT key, value FROM metadata"))
            self.assertEqual(metadata, {"version": "2", "fps": "10"})
            self.assert_places(
                list(database.execute("SELECT id, frame, pos_x, pos_y FROM trajectory_data ORDER BY id, frame"))
            )

    def test_scb_of_menge(self):
        throng("metrics", self.base / "run.h5", "--to", self.base / "run.scb")
        data = (self.base / "run.scb").read_bytes()
        self.assertEqual(data[:4], b"2.1\0")
        people, dt = struct.unpack_from("<if", data, 4)
        self.assertEqual(people, self.place.shape[1])
        self.assertAlmostEqual(dt, 0.1, places=6)
        frames = numpy.frombuffer(data, dtype="<f4", offset=12 + 4 * people).reshape(-1, people, 4)
        numpy.testing.assert_allclose(frames[..., :2], self.place, atol=1e-5)

    def test_what_was_written_gives_the_same_figures(self):
        for suffix in ("txt", "sqlite", "scb"):
            file = self.base / f"again.{suffix}"
            throng("metrics", self.base / "run.h5", "--to", file)
            again = json.loads(printed("metrics", "--trajectory", file, "--scenario", self.base / "place.json"))
            self.assertEqual(again["exits"][0]["crossings"], self.figures["exits"][0]["crossings"], suffix)
            for name, value in self.figures["escape_time_percentiles"].items():
                self.assertEqual(again["escape_time_percentiles"][name] is None, value is None)
                if value is not None:
                    self.assertAlmostEqual(again["escape_time_percentiles"][name], value, delta=1e-3)

    def test_people_of_a_frame_are_not_exchanged_with_frames(self):
        throng("metrics", self.base / "run.h5", "--to", self.base / "ids_first.txt")
        rows = [line.split() for line in (self.base / "ids_first.txt").read_text().splitlines() if line[0] != "#"]
        rows.sort(key=lambda row: (int(row[1]), int(row[0])))
        file = self.base / "eth.txt"
        file.write_text("".join(f"{frame}\t{who}\t{x}\t{y}\n" for who, frame, x, y in rows))
        place = ("--scenario", self.base / "place.json", "--frame-rate", "10")
        for more in ((), ("--columns", "frame,id,x,y")):
            again = json.loads(printed("metrics", "--trajectory", file, *place, *more))
            self.assertEqual(again["people"], self.figures["people"])
            self.assertEqual(again["exits"][0]["crossings"], self.figures["exits"][0]["crossings"])

    def test_people_in_other_units_are_refused(self):
        file = self.base / "centimetres.txt"
        file.write_text("# framerate: 10\n1 0 -300 0\n1 1 -290 0\n")
        command = [THRONG, "metrics", "--trajectory", str(file), "--scenario", str(self.base / "place.json")]
        for options, found in (
            ((), "found no unit"),
            (("--unit-m", "1"), "found nobody inside the scenario at any time"),
        ):
            done = subprocess.run([*command, *options], capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"centimetres.txt: {found}", done.stderr)
            self.assertIn("--unit-m 0.01", done.stderr)
        done = subprocess.run([*command, "--unit-m", "0.01"], capture_output=True, text=True, timeout=300)
        self.assertEqual(json.loads(done.stdout)["people"], 1)


EXPERIMENTS = pathlib.Path(__file__).parents[2] / "../shared/data/experiments"
RECORDING = EXPERIMENTS / "040_c_56_h-.txt.gz"


@unittest.skipUnless(RECORDING.exists(), "the recordings are not here")
class RecordedBottleneck(unittest.TestCase):
    """75 people before an opening, all of whom are through after 65 s. The place says nothing of a crowd."""

    @classmethod
    def setUpClass(cls):
        base = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (base / "walk.txt").write_bytes(gzip.decompress(RECORDING.read_bytes()))
        cls.place = {
            "name": "bottleneck",
            "ground": {"min": [-9, -9], "max": [9, 9], "material": "concrete"},
            "inside": {"min": [-5, 0], "max": [5, 8]},
            "exits": [{"id": "opening", "from": [-0.25, 0], "to": [0.25, 0], "outward": [0, -1]}],
        }
        (base / "place.json").write_text(json.dumps(cls.place))
        place = ["--scenario", base / "place.json", "--csv", base / "exits.csv"]
        cls.figures = json.loads(printed("metrics", "--trajectory", base / "walk.txt", *place))
        cls.rows = list(csv.DictReader((base / "exits.csv").read_text().splitlines()))
        cls.base = base

    def test_everybody_goes_out_and_nobody_in(self):
        door = self.figures["exits"][0]
        self.assertEqual(door["crossings"], {"out": 75, "in": 0})
        self.assertEqual(door["net_out"], 75)
        self.assertEqual(door["share_of_net_out"], 1)
        self.assertIsNone(self.figures["notification"])
        self.assertIsNone(self.figures["alarm_s"])

    def test_predicted_waits_are_those_that_come(self):
        """The predicted wait of the last one in the queue, against the time when as many had passed."""
        passed = numpy.array([int(row["crossed_out"]) for row in self.rows])
        time = numpy.array([float(row["time_s"]) for row in self.rows])
        predicted, actual = [], []
        for step, row in enumerate(self.rows):
            queue = int(row["queue"])
            later = numpy.flatnonzero(passed >= passed[step] + queue)
            if queue < 5 or not len(later):
                continue
            predicted.append(float(row["predicted_wait"]))
            actual.append(time[later[0]] - time[step])
        self.assertGreater(len(actual), 300)
        ratio = numpy.array(predicted) / numpy.array(actual)
        self.assertTrue(0.75 < numpy.median(ratio) < 1.35, numpy.median(ratio))
        self.assertLess(numpy.quantile(ratio, 0.95), 2)
        self.assertGreater(numpy.quantile(ratio, 0.05), 0.5)
        self.assertLess(self.figures["exits"][0]["max_predicted_wait_s"], 2 * time[-1])

    def test_such_a_place_is_not_simulated(self):
        job = {"scenario": "place", "capture": {"to_s": 2}, "drones": [{"id": "d", "start": [0, 0, 20]}]}
        (self.base / "job.json").write_text(json.dumps(job))
        done = throng(
            "simulate",
            self.base / "job.json",
            "-o",
            self.base / "run.h5",
            variables={"THRONG_SCENARIOS": self.base},
            code=2,
        )
        self.assertIn("only recorded people can be in it", done.stderr)


if __name__ == "__main__":
    unittest.main()
