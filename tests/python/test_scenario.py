"""Places built in code: their geometry against plain sums, and simulated by the program."""
import json
import math
import os
import pathlib
import tempfile
import unittest
import warnings

import common
import numpy as np
import throng
from throng import ProgramError, Scenario, ScenarioError

ROOM = [(0, 0), (20, 0), (20, 10), (0, 10)]


def area(corners):
    return 0.5 * sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(corners, [*corners[1:], corners[0]]))


class Geometry(unittest.TestCase):
    def test_one_room_in_every_form(self):
        wkt = "POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))"
        geojson = {"type": "Polygon", "coordinates": [[[0, 0], [20, 0], [20, 10], [0, 10], [0, 0]]]}

        class Shape:
            __geo_interface__ = geojson

        forms = [
            ROOM,
            ROOM[::-1],
            [*ROOM, ROOM[0]],
            np.array(ROOM),
            wkt,
            "polygon Z((0 0 1,20 0 1,20 10 1,0 10 1,0 0 1))",
            geojson,
            Shape(),
        ]
        forms += [
            [*ROOM[:2], (20, 3), (20, 5), ROOM[2], (7, 10), ROOM[3]],
            {"type": "MultiPolygon", "coordinates": [geojson["coordinates"]]},
        ]
        if common.has("shapely"):
            import shapely.geometry
            import shapely.wkt

            forms += [shapely.geometry.Polygon(ROOM), shapely.wkt.loads(wkt), shapely.geometry.LinearRing(ROOM)]
        walls = []
        for form in forms:
            place = Scenario("room", form).exit("door", "LINESTRING (20 4, 20 6)").group(count=5)
            self.assertEqual({tuple(c) for c in place.walkable.outer.tolist()}, {tuple(map(float, c)) for c in ROOM})
            self.assertGreater(area(place.walkable.outer.tolist()), 0)
            walls.append(sum(area(b["footprint"]) for b in place.blueprint()["buildings"]))
        # The room's outline 0.3 m wide with mitred corners, but for the door.
        np.testing.assert_allclose(walls, (20.6 * 10.6 - 200) - 2 * 0.3, rtol=1e-9)

    def test_doors_at_corners_and_several_in_an_edge(self):
        place = Scenario("room", ROOM, wall_thickness_m=0.5)
        place.exit("a", (20, 0), (20, 2)).exit("b", (20, 8), (20, 5)).exit("c", (0, 0), (0, 10)).group(count=1)
        pieces = place.blueprint()["buildings"]
        self.assertAlmostEqual(
            sum(area(p["footprint"]) for p in pieces), 2 * (20.5 + 20.5) / 2 * 0.5 + 0.5 * 5 + 0.125 + 0.25, delta=0.3
        )
        for piece in pieces:
            self.assertGreater(area(piece["footprint"]), 0)
            for exit_ in place.blueprint()["exits"]:
                middle = [(a + b) / 2 for a, b in zip(exit_["from"], exit_["to"])]
                xs, ys = zip(*piece["footprint"])
                self.assertFalse(
                    min(xs) < middle[0] < max(xs)
                    and min(ys) - 0.01 < middle[1] < max(ys) + 0.01
                    and piece["height_m"] > 0
                    and min(xs) < 20 < max(xs)
                )
        self.assertEqual([e["outward"] for e in place.blueprint()["exits"]], [[1, 0], [1, 0], [-1, 0]])

    def test_holes_obstacles_and_walls(self):
        place = Scenario("room", "POLYGON ((0 0, 20 0, 20 10, 0 10), (4 4, 4 6, 6 6, 6 4))").exit(
            "door", (20, 4), (20, 6)
        )
        place.obstacle([(10, 3), (11, 3), (11, 4), (10, 4)], height_m=5).wall(
            [(8, 0), (8, 3), (12, 3)], thickness_m=0.2
        ).group(count=3)
        by_id = {b["id"]: b for b in place.blueprint()["buildings"]}
        self.assertAlmostEqual(area(by_id["hole1"]["footprint"]), 4)
        self.assertEqual(by_id["obstacle2"]["height_m"], 5)
        self.assertAlmostEqual(
            area(by_id["wall3_1"]["footprint"]) + area(by_id["wall3_2"]["footprint"]), 0.2 * 7, delta=0.02
        )
        self.assertEqual(len(place.obstacles), len(by_id))

    def test_mistakes(self):
        for call, words in (
            (lambda: Scenario("Room 1", ROOM), "name"),
            (lambda: Scenario("room", [(0, 0), (1, 1)]), "polygon"),
            (lambda: Scenario("room", [(0, 0), (9, 9), (9, 0), (0, 8)]), "cross"),
            (lambda: Scenario("room", [(0, 0), (math.nan, 1), (2, 2)]), "finite"),
            (lambda: Scenario("room", "POLYGON ((0 0, 1 x, 2 2))"), "number"),
            (lambda: Scenario("room", "MULTIPOLYGON (((0 0, 1 0, 1 1)))"), "WKT"),
            (lambda: Scenario("room", "POLYGON ((0 0, 9 0, 9 9)"), "WKT|parentheses"),
            (lambda: Scenario("room", {"type": "MultiPolygon", "coordinates": []}), "MultiPolygon"),
            (lambda: Scenario("room", 7), "points"),
            (lambda: Scenario("room", ROOM).exit("a", (10, 5), (10, 6)), "edge"),
            (lambda: Scenario("room", ROOM).exit("a", (19, 0), (20, 1)), "edge"),
            (lambda: Scenario("room", ROOM).exit("a", (20, 4), (20, 4)), "without length"),
            (lambda: Scenario("room", ROOM).exit("a", (20, 1), (20, 2)).exit("a", (20, 4), (20, 5)), "twice"),
            (lambda: Scenario("room", ROOM).group(count=0), "count"),
            (lambda: Scenario("room", ROOM).group([(1, 1), (21, 1), (5, 5)], count=3), "walkable"),
            (lambda: Scenario("room", ROOM).obstacle("LINESTRING (0 0, 1 1)"), "LineString"),
            (lambda: Scenario("room", ROOM).blueprint(), "exits"),
            (lambda: Scenario("room", ROOM, wall_thickness_m=0), "wall_thickness_m"),
        ):
            with self.subTest(words), self.assertRaisesRegex(ScenarioError, words):
                call()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            Scenario("l", [(0, 0), (9, 0), (9, 5), (5, 5), (5, 9), (0, 9)]).exit("a", (6, 5), (8, 5))
        self.assertIn("bounding box", str(caught[0].message))


class Simulated(unittest.TestCase):
    def setUp(self):
        os.environ["THRONG_PROGRAM"] = str(common.THRONG)

    def bottleneck(self, width):
        return (
            Scenario("bottleneck", ROOM)
            .exit("door", (20, 5 - width / 2), (20, 5 + width / 2))
            .group([(1, 1), (8, 1), (8, 9), (1, 9)], count=60)
        )

    def test_a_bottleneck(self):
        wide, narrow = self.bottleneck(4), self.bottleneck(1)
        self.assertIn("0 errors, 0 warnings", wide.check())
        traces = {place: place.simulate(to_s=90, seed=2) for place in (wide, narrow)}
        for place, trace in traces.items():
            self.assertEqual(trace.present[0].sum(), 60)
            start = trace.positions[0]
            self.assertTrue(((start >= [1, 1]) & (start <= [8, 9])).all())
            # Nobody is ever within a wall, and who is inside of the room left it by the door.
            for corners in place.obstacles:
                low, high = corners.min(axis=0), corners.max(axis=0)
                if np.isclose(np.prod(high - low), area(corners.tolist()), rtol=0.1):
                    with np.errstate(invalid="ignore"):
                        inside = ((trace.positions > low + 0.05) & (trace.positions < high - 0.05)).all(axis=-1)
                    self.assertFalse(inside.any())
            crossing = np.diff(np.nan_to_num(trace.positions[..., 0], nan=99) > 20, axis=0)
            step, agent = np.nonzero(crossing & trace.present[1:])
            self.assertLess(np.abs(trace.positions[step, agent, 1] - 5).max(), 2.2)
        times = [trace.evacuation()[0] for trace in traces.values()]
        self.assertEqual([len(t) for t in times], [60, 60])
        self.assertGreater(times[1][-1], 1.3 * times[0][-1])
        measured = wide.metrics(traces[wide])
        np.testing.assert_allclose(sorted(measured["by_person"]["escaped_s"]), times[0], atol=1e-9)
        again = wide.simulate(to_s=90, seed=2)
        np.testing.assert_array_equal(again.positions, traces[wide].positions)
        folder = pathlib.Path(again.path).parent
        self.assertTrue(folder.exists())
        del again
        self.assertFalse(folder.exists())

    def test_other_shapes(self):
        place = Scenario(
            "l", "POLYGON ((0 0, 20 0, 20 8, 10 8, 10 20, 0 20, 0 0), (3 3, 5 3, 5 5, 3 5, 3 3))", in_groups=0
        )
        place.exit("e", (20, 2), (20, 4)).exit("n", "LINESTRING (2 20, 6 20)").wall([(8, 0), (8, 4)]).group(count=50)
        self.assertIn("0 errors", place.check())
        self.assertGreater(len(place.simulate(to_s=60, model="orca").evacuation()[0]), 45)
        hexagon = Scenario("hexagon", [(10, 0), (20, 6), (20, 16), (10, 22), (0, 16), (0, 6)]).exit(
            "e", (20, 9), (20, 12)
        )
        hexagon.source(line=[(4, 10), (4, 12)], per_minute=60, doing="leave", until_s=20).group(count=10)
        hexagon.disaster("fire", (5, 5), start_s=5, radius_m=1)
        self.assertIn("0 errors", hexagon.check())
        self.assertGreater(len(hexagon.simulate(to_s=60, job={"crowd": {"compliance": 0.5}}).evacuation()[0]), 10)

    def test_speeds_and_times(self):
        place = Scenario(
            "slow", ROOM, in_groups=0, pre_movement_s={"uniform": [5, 6]}, evacuation_speed_mps="unchanged"
        )
        place.exit("door", (20, 4), (20, 6)).group(count=20, doing="wait", speed_mps={"normal": [0.8, 0.1]})
        place.queue([(5, 2), (8, 2)], count=3, speed_mps={"uniform": [1.4, 1.6]})
        place.disaster("fire", (1, 9), start_s=2, radius_m=0.3, max_radius_m=0.3, noticed_m=100)
        self.assertIn("0 errors", place.check())
        trace = place.simulate(to_s=60, seed=3)
        people = np.flatnonzero(np.array(trace.roles) == "person")
        speeds = trace.preferred_speeds_mps[people]
        self.assertEqual(((speeds > 0.45) & (speeds < 1.15)).sum(), 20)
        flees = trace.states[:, people] == trace.state_names.index("Flee")
        first = trace.time_s[flees.argmax(axis=0)]
        self.assertTrue(((first >= 6.9) & (first <= 8.3)).all(), first)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            place = self.bottleneck(2)
            self.assertEqual(place.write(folder).name, "bottleneck.json")
            self.assertEqual(
                json.loads((pathlib.Path(folder) / "bottleneck.blueprint.json").read_text()), place.blueprint()
            )
            self.assertIn("<svg", place.plan(f"{folder}/plan.svg").read_text())
            trace = place.simulate(to_s=2, trace=f"{folder}/kept.h5")
            self.assertEqual([door["id"] for door in trace.scenario_document["exits"]], ["door"])
            self.assertEqual(throng.Trace(f"{folder}/kept.h5").positions.shape, trace.positions.shape)
            self.assertEqual(len(throng.metrics(trace, scenario=f"{folder}/bottleneck.json")["by_person"]["agent"]), 60)

    def test_a_dataset_of_the_place(self):
        with tempfile.TemporaryDirectory() as folder:
            job = {
                "capture": {"from_s": 1, "to_s": 1},
                "quality": "draft",
                "drones": [
                    {"id": "d1", "start": [4.5, 5, 14], "camera": {"width": 160, "height": 120, "pitch_deg": -90}}
                ],
            }
            dataset = self.bottleneck(2).run(f"{folder}/out", job=job, quiet=True)
            self.assertEqual(len(dataset), 1)
            self.assertGreater(len(dataset[0].people), 40)
            self.assertTrue((dataset[0].people.positions[:, 0] < 9.5).all())

    def test_a_study(self):
        with tempfile.TemporaryDirectory() as folder:
            self.bottleneck(2).drone("d1", (10, 5, 30)).write(folder)
            answer = throng.study(
                {
                    "name": "doors",
                    "seed": 1,
                    "runs": 2,
                    "baseline": "none",
                    "policies": [{"id": "none"}],
                    "cases": [{"id": "a", "scenario": "bottleneck", "alarm_s": 0, "duration_s": 60}],
                },
                f"{folder}/out",
                scenarios=folder,
                quiet=True,
            )
            self.assertEqual(answer, json.loads((pathlib.Path(folder) / "out/summary.json").read_text()))

    def test_a_comparison_with_recorded_people(self):
        with tempfile.TemporaryDirectory() as folder:
            lines = [f"{who} {20 * who + i} {1 + 0.1 * i:.1f} 1" for who in range(5) for i in range(181)]
            pathlib.Path(folder, "walk.txt").write_text("# framerate: 10\n" + "\n".join(lines))
            corridor = {
                "name": "corridor",
                "file": "walk.txt",
                "walkable": [[0, 0], [20, 0], [20, 2], [0, 2]],
                "goals": [{"min": [18, 0.2], "max": [19.5, 1.8]}],
                "area": {"min": [8, 0], "max": [12, 2]},
                "line": [[10, 0], [10, 2]],
            }
            file = pathlib.Path(folder, "experiments.json")
            file.write_text(json.dumps({"experiments": [corridor]}))
            answer = throng.validate_crowd(folder, models=["orca"], experiments=["corridor"], seeds=2, quiet=True)
            self.assertEqual((answer["models"], answer["seeds"]), (["orca"], 2))
            quantities = {one["name"]: one for one in answer["experiments"][0]["quantities"]}
            self.assertAlmostEqual(quantities["speed"]["recorded"], 1, places=3)
            self.assertEqual(len(quantities["speed"]["models"][0]["values"]), 2)
            other = throng.validate_crowd(folder, models=["ttc"], seeds=1, constants="conservative", quiet=True)
            self.assertEqual(other["models"], ["ttc (conservative)"])
            with self.assertRaisesRegex(ProgramError, 'did you mean "loop"') as caught:
                file.write_text(json.dumps({"experiments": [{**corridor, "lop": {}}]}))
                throng.validate_crowd(folder, quiet=True)
            self.assertEqual(caught.exception.exit_code, 2)

    def test_what_the_program_refuses(self):
        with self.assertRaisesRegex(ProgramError, "doing") as caught:
            Scenario("room", ROOM).exit("door", (20, 4), (20, 6)).group(count=3, doing="fly").simulate()
        self.assertEqual(caught.exception.exit_code, 2)
        with self.assertRaisesRegex(ProgramError, "rate_hz"):
            self.bottleneck(2).simulate(job={"capture": {"rate_hz": -1}})
        with self.assertRaisesRegex(ProgramError, "was not found"):
            self.bottleneck(2).simulate(program="/nowhere/throng")


if __name__ == "__main__":
    common.main()
