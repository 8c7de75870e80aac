#!/usr/bin/env python3
"""Every image of the demo, with which a new user begins, shows a crowd, and the crowd leaves while it is filmed.

usage: test_demo.py THRONG
"""
import collections
import json
import pathlib
import tempfile
import unittest

from program import ROOT, throng

# People whose box covers at least this many pixels of an image 640 pixels wide; smaller ones are hardly seen.
LEAST_AREA_PX = 12
LEAST_PEOPLE = {"overview": 100, "d1": 30}


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        job = json.loads((ROOT / "scenarios/city_square/demo.job.json").read_text())
        for drone in job["drones"]:
            drone["camera"].update(width=640, height=360)
        job.update(quality="draft", outputs={"annotations": ["coco", "exits"], "previews": 0})
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "demo.job.json").write_text(json.dumps(job))
            said = throng("run", folder / "demo.job.json", "-o", folder / "out", cwd=ROOT)
            cls.messages = said.stderr
            cls.labels = json.loads((folder / "out/dataset/annotations/instances.json").read_text())
            cls.metrics = json.loads((folder / "out/dataset/metrics/run000.json").read_text())

    def test_each_image_shows_a_crowd(self):
        people = collections.Counter()
        for annotation in self.labels["annotations"]:
            width, height = annotation["bbox"][2:]
            people[annotation["image_id"]] += annotation["category_id"] == 1 and width * height >= LEAST_AREA_PX
        self.assertGreater(len(self.labels["images"]), 40)
        for image in self.labels["images"]:
            camera = image["file_name"].split("/")[2]
            self.assertGreaterEqual(people[image["id"]], LEAST_PEOPLE[camera], image["file_name"])

    def test_people_leave_while_the_cameras_look(self):
        last_s = max(image["time_s"] for image in self.labels["images"])
        left = [time for time in self.metrics["by_person"]["escaped_s"] if time is not None and time <= last_s]
        self.assertGreater(len(left), 30)
        self.assertLess(self.metrics["alarm_s"], last_s / 2 + 2)

    def test_check_says_how_many_people_take_part(self):
        done = throng("check", "--json", ROOT / "scenarios/city_square/demo.job.json")
        self.assertAlmostEqual(json.loads(done.stdout)["people"] / self.metrics["people"], 1, delta=0.1)

    def test_it_ends_without_a_warning(self):
        self.assertNotIn("warning", self.messages)


if __name__ == "__main__":
    unittest.main()
