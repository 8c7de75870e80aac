"""throng check: every mistake at once, estimates, and warnings for jobs that succeed without effect."""
import json
import os
import shutil
import unittest

from program import FolderTest, printed, throng, write_json
from service import ask

SQUARE = {"scenario": "city_square/second_nearest", "capture": {"to_s": 5}}


class Check(FolderTest):
    def setUp(self):
        super().setUp()
        # No test has anything from another's jobs.
        os.environ["XDG_CACHE_HOME"] = str(self.folder / "cache")

    def write(self, job):
        file = write_json(self.folder / "my.job.json", job)
        return file

    def check(self, job, *options, code=0):
        return throng("check", self.write(job), *options, code=code)

    def answer(self, **fields):
        done = self.check({**SQUARE, **fields}, "--json")
        return json.loads(done.stdout)

    def warned(self, **fields):
        return {warning["pointer"]: warning["found"] for warning in self.answer(**fields)["warnings"]}

    def test_disk_is_estimated_within_a_factor(self):
        """Estimates of disk and memory for jobs of several kinds."""
        small = {"id": "a", "start": [8, -3, 15], "camera": {"width": 320, "height": 240, "yaw_deg": 90}}
        camera = {**small["camera"], "pitch_deg": -40}
        drones = [{**small, "camera": camera}]
        kinds = ["coco", "keypoints", "depth", "normals", "flow", "instances", "fields"]
        everyday = {"scenario": "city_square/everyday", "quality": "draft", "drones": drones}
        for number, job in enumerate(
            (
                {**everyday, "capture": {"rate_hz": 2, "to_s": 4}},
                {**everyday, "crowd": {"agents": 50}, "capture": {"rate_hz": 2, "to_s": 4}},
                {**everyday, "capture": {"to_s": 2}, "outputs": {"annotations": kinds, "previews": 0}},
                {**everyday, "drones": [], "capture": {"to_s": 60}, "runs": 2},
                {"scenario": "city_square/emergency", "drones": [], "capture": {"to_s": 30}},
            )
        ):
            estimate = self.answer(**{**job, "scenario": job["scenario"]})["estimate"]["disk_bytes"]
            out = self.folder / f"out{number}"
            throng("run", self.folder / "my.job.json", "-o", out)
            files = {file.stat().st_ino: file.stat().st_size for file in out.rglob("*") if file.is_file()}
            quotient = estimate / sum(files.values())
            self.assertTrue(1 / 1.5 <= quotient <= 1.5, (job, quotient))

    def test_all_mistakes_at_once(self):
        done = self.check(
            {
                "scenario": "city_square/nearest_exti",
                "drone": [],
                "runs": 0,
                "capture": {"to_s": "soon"},
                "outputs": {"formats": ["yolo"]},
            },
            code=2,
        )
        for expected in (
            '/drone: unknown field "drone"; did you mean "drones"?',
            "/runs: found 0, expected ",
            '/capture/to_s: found "soon"',
            'unknown scenario "city_square/nearest_exti"; did you mean "city_square/nearest_exit"?',
            '/outputs/formats/0: unknown format "yolo"',
        ):
            self.assertIn(expected, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 5, done.stderr)

    def test_a_mistake_is_reported_once(self):
        """Not again as what its absence would mean."""
        done = self.check(
            {**SQUARE, "drones": [{"id": "d1", "guidance": {"policy": "orbit", "radius_m": "wide"}}]}, code=2
        )
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("/drones/0/guidance/radius_m", done.stderr)

    def test_counts_and_estimates(self):
        answer = self.answer(runs=2, capture={"rate_hz": 2, "from_s": 1, "to_s": 5}, crowd={"agents": 20})
        cameras = len(answer["job"]["drones"])
        self.assertEqual(answer["runs"], 2)
        self.assertEqual(answer["people"], 20)
        self.assertEqual(answer["frames"], 2 * 9 * cameras)
        # Of which the characters are most, and tests have fewer of them.
        self.assertGreater(answer["estimate"]["memory_mib"], 350)
        more = self.answer(runs=4, capture={"rate_hz": 2, "from_s": 1, "to_s": 5}, crowd={"agents": 20})
        # The light of the place is baked once for all runs.
        self.assertAlmostEqual(more["estimate"]["cpu_s"] / answer["estimate"]["cpu_s"], 1.85, delta=0.15)
        self.assertGreater(
            self.answer(quality="high")["estimate"]["cpu_s"], self.answer(quality="draft")["estimate"]["cpu_s"]
        )

    def test_the_estimates_are_those_of_a_run(self):
        job = {**SQUARE, "drones": [{"id": "d1", "camera": {"width": 640, "height": 360}}]}
        answer = json.loads(self.check(job, "--json").stdout)
        throng("run", self.write(job), "-o", self.folder / "out")
        files = [file for file in (self.folder / "out/dataset").rglob("*") if file.is_file()]
        images = [file for file in files if file.parts[-4] == "images"]
        self.assertEqual(len(images), answer["frames"])
        size = sum(file.stat().st_size for file in files)
        self.assertLess(abs(size / answer["estimate"]["disk_bytes"] - 1), 1, (size, answer["estimate"]))

    def test_people_are_those_of_a_run(self):
        """Those there at the start and those who come until the end."""
        for number, (scenario, to_s, fields) in enumerate(
            (
                ("station/everyday", 40, {}),
                ("stadium_exit/everyday", 5, {}),
                ("stadium_exit/everyday", 20, {}),
                ("city_square/everyday", 30, {"runs": 2}),
                ("city_square/everyday", 30, {"crowd": {"agents": 120}}),
            )
        ):
            job = {"scenario": scenario, "drones": [], "capture": {"to_s": to_s, "rate_hz": 0.2}, **fields}
            planned = self.answer(**job)["people"]
            out = self.folder / f"out{number}"
            throng("run", self.write(job), "-o", out)
            # A check loads the first run.
            simulated = json.loads((out / "dataset/metrics.json").read_text())["runs"][0]["people"]
            # People that are sampled come sooner or later than others.
            self.assertAlmostEqual(planned / simulated, 1, delta=0.1 if "crowd" in fields else 0.01, msg=scenario)

    def test_a_job_larger_than_the_free_disk(self):
        camera = {"width": 7680, "height": 4320}
        drones = [{"id": "d", "start": [0, -3, 15], "camera": camera}]
        capture = {"to_s": 600, "rate_hz": 30}
        outputs = {"annotations": ["coco", "depth", "flow", "normals", "instances"]}
        job = {"scenario": "city_square/everyday", "drones": drones, "capture": capture, "outputs": outputs}
        answer = self.answer(**job, runs=100)
        if answer["estimate"]["disk_bytes"] <= shutil.disk_usage(".").free:
            self.skipTest("a very large disk")
        warned = [warning for warning in answer["warnings"] if "free on the disk of" in warning["expected"]]
        self.assertEqual([warning["pointer"] for warning in warned], ["/runs"])
        self.assertRegex(
            self.check({**job, "runs": 100}).stdout, "warning: .*: found a job of about .* [GT]B, expected at most"
        )
        self.assertNotIn("/runs", self.warned())

    def test_the_time_is_learned_from_jobs_and_no_dataset_depends_on_it(self):
        job = self.write({"scenario": "city_square/everyday", "drones": [], "capture": {"to_s": 5, "rate_hz": 1}})
        learned = self.folder / "cache/throng/speed.json"

        def estimate():
            return json.loads(printed("check", "--json", job))["estimate"]

        before = estimate()
        self.assertEqual(before["basis"], "reference machine")
        self.assertRegex(printed("check", job), r"\n  time +about .* of the reference machine\n")
        throng("run", job, "-o", self.folder / "out0")
        factor = json.loads(learned.read_text())["factor"]
        self.assertEqual(estimate()["basis"], "this machine")
        self.assertAlmostEqual(estimate()["cpu_s"], factor * before["cpu_s"], delta=0.051 * (1 + factor))
        self.assertRegex(printed("check", job), r"\n  time +about .* of this machine\n")
        learned.write_text('{"factor": 7, "jobs": 8}')
        throng("run", job, "-o", self.folder / "out1")
        manifests = [(self.folder / f"out{i}/dataset/manifest.json").read_bytes() for i in range(2)]
        self.assertEqual(manifests[0], manifests[1])
        learned.write_text("[[[")
        self.assertEqual(estimate(), before)

    def test_a_job_for_figures_needs_no_drone(self):
        answer = self.answer(drones=[])
        self.assertEqual((answer["frames"], answer["shards"]), (0, 0))
        self.assertEqual(answer["job"]["drones"], [])
        self.assertEqual(answer["job"]["outputs"]["annotations"], ["exits"])
        self.assertIn("figures", self.check({**SQUARE, "drones": []}).stdout)
        images = {"annotations": ["events", "depth", "coco"], "formats": ["mot"], "previews": 2}
        done = self.check({**SQUARE, "drones": [], "outputs": images}, code=2)
        for pointer in ("annotations/1", "annotations/2", "formats/0", "previews"):
            self.assertRegex(
                done.stderr, f"/outputs/{pointer}: found .* without drones, .* expected a drone in /drones"
            )
        self.assertNotIn("annotations/0", done.stderr)

    def test_a_run_for_figures(self):
        job = {"scenario": "city_square/huang2016/second_nearest", "drones": [], "capture": {"to_s": 15}}
        file = self.write(
            {
                **job,
                "outputs": {
                    "annotations": ["exits", "events", "counts", "trajectories"],
                    "formats": ["jupedsim", "trajnet"],
                },
            }
        )
        out = self.folder / "out"
        done = throng("run", file, "-o", out)
        self.assertIn("warning: run000: /scenario: found an alarm at 0 s that none of 260 people noticed", done.stderr)
        for name in """
            metrics.json exits/run000.csv events/run000.jsonl trajectories/run000.npy
            formats/jupedsim/train/run000.txt formats/trajnet/train/run000.ndjson""".split():
            self.assertTrue((out / "dataset" / name).is_file(), name)
        self.assertFalse((out / "dataset/images").exists())
        throng("validate", out / "dataset")
        refused = {**job, "outputs": {"annotations": ["coco"]}}
        done = throng("run", self.write(refused), "-o", out, code=2)
        self.assertIn("/outputs/annotations/0", done.stderr)
        throng("validate", out / "dataset")  # what was there before stays
        (out / "dataset/exits/run000.csv").unlink()
        done = throng("validate", out / "dataset", code=2)
        self.assertIn("exits/run000.csv: no such file", done.stdout)

    def test_a_wall_left_out_is_said_before_and_after_the_run(self):
        def wall(name, x0, y0, x1, y1):
            return {"id": name, "box": [x0, y0, x1, y1], "height_m": 3}

        walls = [
            wall("north", -10, 7, 10, 7.3),
            wall("south", -10, -7.3, 10, -7),
            wall("west", -10.3, -7.3, -10, 7.3),
            wall("south_east", 10, -7.3, 10.3, -1),  # and none north of the door
        ]
        hall = {
            "name": "Hall",
            "ground": {"min": [-30, -30], "max": [30, 30], "material": "concrete"},
            "inside": {"min": [-13, -10], "max": [13, 10]},
            "exits": [{"id": "east", "from": [10, -1], "to": [10, 1]}],
            "buildings": walls,
            "disasters": [{"kind": "fire", "position": [0, -4], "start_s": 2, "radius_m": 1}],
            "people": {"groups": [{"doing": "stroll", "box": [-9, -6, 9, 6], "count": 60}]},
        }
        scenarios = self.folder / "places"
        blueprint = write_json(self.folder / "hall.blueprint.json", hall)
        throng("scenario", "make", blueprint, "-o", scenarios)
        job = self.write({"scenario": "hall", "seed": 4, "drones": [], "capture": {"to_s": 40}})
        done = throng("run", job, "-o", self.folder / "hall", variables={"THRONG_SCENARIOS": scenarios})
        gap = 'a gap 6.0 m wide at [10, 4], nearest to exit "east"'
        self.assertIn(gap, done.stderr)
        figures = json.loads((self.folder / "hall/dataset/metrics/run000.json").read_text())
        counts = figures["people_counts"]
        self.assertIn(gap, figures["warnings"][0])
        done_again = throng("metrics", self.folder / "hall/work/run000/trace.h5")
        self.assertIn(gap, done_again.stderr)
        self.assertEqual(json.loads(done_again.stdout)["warnings"], figures["warnings"])
        page = self.folder / "hall.html"
        throng("report", self.folder / "hall", "-o", page)
        self.assertIn("a gap 6.0 m wide at [10, 4]", page.read_text())
        self.assertGreater(counts["left_by_no_exit"], 0)
        self.assertIn(f"warning: run000: {counts['left_by_no_exit']} of 60 people left the place where", done.stderr)

    def test_an_alarm_that_nobody_notices(self):
        paper = {"scenario": "city_square/huang2016/second_nearest", "capture": {"to_s": 60}}
        self.assertIn("that none of 260 people noticed", self.warned(**paper)["/scenario"])
        follows = self.warned(**paper, crowd={"compat": "huang2016"})["/scenario"]
        self.assertIn("agents that start inside of it", follows, "what `scenario check` says of its files")

    def test_an_error_of_the_scenario(self):
        """The run goes on, and warns of it, as does the check: the only exit leads into a court without a way out."""

        def wall(name, *box):
            return {"id": name, "box": box, "height_m": 3}

        hall = {
            "name": "Hall",
            "ground": {"min": [-30, -30], "max": [30, 30], "material": "concrete"},
            "inside": {"min": [-10, -7], "max": [10, 7]},
            "exits": [{"id": "east", "from": [10, -1], "to": [10, 1]}],
            "buildings": [
                wall("north", -10, 7, 20, 7.3),
                wall("south", -10, -7.3, 20, -7),
                wall("west", -10.3, -7.3, -10, 7.3),
                wall("north_east", 10, 1, 10.3, 7),
                wall("south_east", 10, -7, 10.3, -1),
                wall("court", 20, -7.3, 20.3, 7.3),
            ],
            "people": {"groups": [{"doing": "leave", "box": [-9, -6, 9, 6], "count": 9}]},
        }
        (self.folder / "court.blueprint.json").write_text(json.dumps(hall))
        job = self.write(
            {
                "scenario": "court",
                "drones": [],
                "capture": {"to_s": 20},
                "outputs": {"annotations": ["trajectories"], "formats": ["jupedsim", "eth-ucy", "trajnet"]},
            }
        )
        scenarios = {"THRONG_SCENARIOS": self.folder}
        done = throng("check", job, variables=scenarios)
        self.assertIn("valid, but its scenario has 1 error", done.stdout)
        out = self.folder / "court"
        done = throng("run", job, "-o", out, variables=scenarios)
        self.assertIn('exit "east", behind which walls enclose the ground', done.stderr)
        metrics = json.loads((out / "dataset/metrics/run000.json").read_text())
        self.assertTrue(any('exit "east", behind which' in warning for warning in metrics["warnings"]))
        for written in ("jupedsim", "eth-ucy", "trajnet"):
            self.assertTrue(any((out / "dataset/formats" / written).rglob("run000*")), written)

    def test_text(self):
        done = self.check({**SQUARE, "environment": {"rain_mm_per_h": 20}})
        self.assertRegex(done.stdout, r"my.job.json: valid, 1 warning\n")
        self.assertRegex(done.stdout, r"\n  images +\d+ in \d+ shards?\n")
        self.assertRegex(done.stdout, r"\n  time +about \d+ (s|min) on \d+ cores? of (this|the reference) machine\n")
        self.assertRegex(done.stdout, r"\n  disk +about [\d.]+ [kMG]B\n")
        self.assertRegex(done.stdout, r"shows up to \d+ % of the area")
        self.assertIn("warning: ", done.stdout)

    def test_a_sound_job_has_no_warning(self):
        self.assertEqual(self.warned(), {})

    def test_settings_without_effect(self):
        self.assertIn("rain in no run", self.warned(environment={"rain_mm_per_h": 20})["/environment/rain_mm_per_h"])
        self.assertEqual(self.warned(environment={"rain_mm_per_h": 20, "weather": "rain"}), {})
        self.assertIn("coco", self.warned(outputs={"annotations": ["keypoints"]})["/outputs/annotations/0"])
        self.assertEqual(self.warned(outputs={"annotations": ["keypoints", "coco"]}), {})
        self.assertIn("no run of 1", self.warned(outputs={"splits": {"val": 0.2}})["/outputs/splits/val"])
        self.assertEqual(self.warned(outputs={"splits": {"val": 0.5}}, runs=2), {})

    def test_deprecated_names(self):
        orbit = {"policy": "orbit", "centre": [0, 0], "radius_m": 10}
        warned = self.warned(drones=[{"id": "d1", "start": [0, -10, 25], "guidance": orbit}])
        self.assertEqual(warned["/drones/0/guidance/centre"], 'the deprecated name "centre"')

    def test_smoke_needs_a_hazard(self):
        everyday = {"scenario": "city_square/everyday", "environment": {"smoke": 0.5}}
        self.assertIn("/environment/smoke", self.warned(**everyday))
        self.assertNotIn(
            "/environment/smoke", self.warned(scenario="city_square/emergency", environment={"smoke": 0.5})
        )

    def test_cameras_that_see_nobody(self):
        up = [{"id": "d1", "start": [0, 0, 30], "camera": {"pitch_deg": 30}}]
        self.assertIn("nobody in any image", self.warned(drones=up)["/drones/0/camera"])
        away = [{"id": "d1", "start": [1000, 0, 30]}]
        warned = self.warned(drones=away)
        self.assertIn("m beyond the scenario's ground", warned["/drones/0"])
        self.assertIn("nobody in any image", warned["/drones/0/camera"])
        high = [{"id": "d1", "start": [0, 0, 900], "camera": {"pitch_deg": -90, "width": 320, "height": 240}}]
        self.assertRegex(self.warned(drones=high)["/drones/0/camera"], r"people of at most \d px")

    def test_the_dry_run_of_the_service_says_the_same(self):
        job = {**SQUARE, "environment": {"rain_mm_per_h": 20}}
        answer = ask(self.serve() + "/v1/jobs?dry_run", job)
        self.assertTrue(answer.pop("valid"))
        self.assertEqual(answer, json.loads(self.check(job, "--json").stdout))


unittest.main()
