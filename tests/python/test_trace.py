"""A trace as Trace reads it against h5py, and its evacuation against `throng metrics`."""
import json
import pathlib
import subprocess
import tempfile
import unittest

import common
import h5py
import numpy as np
from throng import Trace, TraceError

HALL = {
    "name": "Hall",
    "ground": {"min": [-10, -10], "max": [30, 20], "material": "concrete"},
    "inside": {"min": [0, 0], "max": [20, 10]},
    "exits": [{"id": "door", "from": [20, 3], "to": [20, 7]}],
    "drones": [{"id": "view", "start": [10, 5, 30], "yaw_deg": 0}],
    "buildings": [
        {"id": "w", "box": [-0.4, 0, 0, 10], "height_m": 2},
        {"id": "s", "box": [0, -0.4, 20, 0], "height_m": 2},
        {"id": "n", "box": [0, 10, 20, 10.4], "height_m": 2},
        {"id": "e1", "box": [20, 0, 20.4, 3], "height_m": 2},
        {"id": "e2", "box": [20, 7, 20.4, 10], "height_m": 2},
    ],
    "people": {"groups": [{"doing": "leave", "box": [1, 1, 8, 9], "count": 40}]},
}


class Traces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (folder / "hall.blueprint.json").write_text(json.dumps(HALL))
        (folder / "job.json").write_text(json.dumps({"scenario": "hall", "seed": 3, "capture": {"to_s": 40}}))
        environment = {"THRONG_SCENARIOS": str(folder / "s"), "PATH": "/usr/bin:/bin"}
        for command in (
            ["scenario", "make", "hall.blueprint.json", "-o", "s"],
            ["simulate", "job.json", "-o", "run.h5"],
            ["metrics", "run.h5", "-o", "metrics.json"],
        ):
            subprocess.run([common.THRONG, *command], cwd=folder, env=environment, check=True, capture_output=True)
        cls.path = folder / "run.h5"
        cls.metrics = json.loads((folder / "metrics.json").read_text())
        cls.trace = Trace(cls.path)

    def test_says_which_model_moved_the_people(self):
        self.assertEqual(self.trace.crowd["model"], "ttc")
        self.assertIs(self.trace.crowd["physical"], False)
        self.assertEqual(self.metrics["crowd_model"], "ttc")
        earlier = self.path.with_name("earlier.h5")
        earlier.write_bytes(self.path.read_bytes())
        with h5py.File(earlier, "a") as file:
            for name in [name for name in file.attrs if name.startswith("crowd_")]:
                del file.attrs[name]
        self.assertEqual(Trace(earlier).crowd, {})

    def test_arrays(self):
        trace = self.trace
        with h5py.File(self.path) as file:
            present = (file["crowd/flags"][()] & 1) == 1
            np.testing.assert_array_equal(trace.present, present)
            for name, values in (
                ("position", trace.positions),
                ("velocity", trace.velocities),
                ("yaw_rad", trace.headings),
            ):
                np.testing.assert_array_equal(values[present], file[f"crowd/{name}"][()][present].astype(float))
                self.assertTrue(np.isnan(values[~present]).all())
            np.testing.assert_array_equal(trace.time_s, file["crowd/time_s"][()])
            np.testing.assert_array_equal(trace.drone("view")["position"], file["drones/0/position"][()])
            self.assertEqual(trace.state_names, [text.decode() for text in file["state_names"][()]])
        self.assertEqual((trace.scenario, trace.exit_ids, trace.drone_ids), ("hall", ["door"], ["view"]))
        self.assertEqual(set(trace.roles), {"person"})
        self.assertEqual(len(trace.people), 40)
        with self.assertRaises(KeyError):
            trace.drone("other")

    def test_evacuation(self):
        times, escaped = self.trace.evacuation()
        expected = sorted(t for t in self.metrics["by_person"]["escaped_s"] if t is not None)
        np.testing.assert_allclose(times, expected, atol=1e-9)
        self.assertEqual(escaped[-1], len(expected))
        self.assertGreater(len(expected), 30)

    @unittest.skipUnless(common.has("pandas"), "pandas is not installed")
    def test_to_pandas(self):
        table = self.trace.to_pandas()
        self.assertEqual(len(table), self.trace.present.sum())
        for agent in (0, 17):
            one = table[table.id == agent]
            np.testing.assert_array_equal(
                one[["x", "y"]].to_numpy(), self.trace.positions[self.trace.present[:, agent], agent]
            )
        self.assertEqual(len(self.trace.events().to_pandas()), self.trace.events().rows)

    def test_damaged_files(self):
        folder = self.path.parent
        data = self.path.read_bytes()
        with h5py.File(folder / "other.h5", "w") as file:
            file.attrs["format"] = "else"
        with h5py.File(folder / "newer.h5", "w") as file:
            file.attrs["format"], file.attrs["version"] = np.bytes_("throng trace"), 99
        with h5py.File(folder / "empty.h5", "w") as file:
            file.attrs["format"], file.attrs["version"] = np.bytes_("throng trace"), 3
        for name, content in (("cut.h5", data[: len(data) // 2]), ("text.h5", b"hello"), ("nothing.h5", b"")):
            (folder / name).write_bytes(content)
        for name in ("other.h5", "newer.h5", "cut.h5", "text.h5", "nothing.h5", "absent.h5"):
            with self.subTest(name), self.assertRaisesRegex(TraceError, name):
                Trace(folder / name)
        with self.assertRaisesRegex(TraceError, "crowd/flags"):
            Trace(folder / "empty.h5").present
        for name, values in (("position", np.zeros((5, 40, 2))), ("state", np.zeros(7))):
            (folder / "shape.h5").write_bytes(data)
            with h5py.File(folder / "shape.h5", "a") as file:
                del file[f"crowd/{name}"]
                file[f"crowd/{name}"] = values
            trace = Trace(folder / "shape.h5")
            with self.assertRaisesRegex(TraceError, f"crowd/{name}.*shape"):
                trace.positions, trace.states
        # Bytes of its tables of contents changed; data beyond are not touched, since libhdf5 itself may crash then.
        rng = np.random.default_rng(1)
        for _ in range(60):
            damaged = bytearray(data)
            damaged[rng.integers(8, 96)] = rng.integers(256)
            (folder / "header.h5").write_bytes(damaged)
            try:
                Trace(folder / "header.h5").positions
            except TraceError as error:
                self.assertIn("header.h5", str(error))


if __name__ == "__main__":
    common.main()
