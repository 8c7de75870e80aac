"""throng people: characters of the user's own, who there is, and sheets that show them."""
import base64
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import unittest

from PIL import Image

from program import ROOT, THRONG, FolderTest, throng, write_json

PEOPLE = pathlib.Path(os.environ.get("THRONG_PEOPLE", ROOT / "build" / "people"))


def people(*words, **options):
    return throng("people", *words, **options)


# Joint positions of a person of 1.8 m (x to their left, y up, z forward), and the parent of each.
LIMBS = {
    "UpLeg": ("Hips", 0.1, 0.93),
    "Leg": ("UpLeg", 0.1, 0.5),
    "Foot": ("Leg", 0.1, 0.09),
    "Arm": ("Spine", 0.2, 1.45),
    "ForeArm": ("Arm", 0.23, 1.17),
    "Hand": ("ForeArm", 0.24, 0.92),
}
BONES = {"Hips": (None, 0, 0.95), "Spine": ("Hips", 0, 1.1), "Head": ("Spine", 0, 1.6)}
for side, sign in (("Left", 1), ("Right", -1)):
    for name, (parent, x, y) in LIMBS.items():
        BONES[side + name] = (side + parent if parent in LIMBS else parent, sign * x, y)
BOX = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]


def box_man(rename=lambda name: name):
    """A glTF file of somebody made of boxes, one for each bone."""
    names = list(BONES)
    nodes, points, joints, indices, inverse = [], [], [], [], []
    for number, (name, (parent, x, y)) in enumerate(BONES.items()):
        _, px, py = BONES[parent] if parent else (None, 0, 0)
        children = [i for i, other in enumerate(names) if BONES[other][0] == name]
        nodes.append(
            {"name": rename(name), "translation": [x - px, y - py, 0], **({"children": children} if children else {})}
        )
        inverse += [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, 0, 1]
        low, high = {"Foot": (0, y), "Head": (y, 1.8)}.get(
            name.replace("Left", "").replace("Right", ""), (y - 0.2, y + 0.05)
        )
        indices += [8 * number + i for i in BOX]
        for corner in range(8):
            half = 0.05 if corner & 1 else -0.05
            ahead = (0.2 if name.endswith("Foot") else 0.05) if corner & 4 else -0.05
            points += [x + half, high if corner & 2 else low, ahead]
            joints += [number, 0, 0, 0]
    vertices = len(points) // 3
    columns = [
        (points, "f", "VEC3", 5126, vertices),
        (joints, "B", "VEC4", 5121, vertices),
        ([1, 0, 0, 0] * vertices, "f", "VEC4", 5126, vertices),
        (indices, "I", "SCALAR", 5125, len(indices)),
        (inverse, "f", "MAT4", 5126, len(names)),
    ]
    data, views, accessors = b"", [], []
    for values, kind, shape, component, count in columns:
        packed = struct.pack(f"<{len(values)}{kind}", *values)
        accessors.append({"bufferView": len(views), "componentType": component, "type": shape, "count": count})
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data += packed
    accessors[0].update(min=[min(points[i::3]) for i in range(3)], max=[max(points[i::3]) for i in range(3)])
    primitive = {"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0, len(nodes)]}],
            "nodes": nodes + [{"name": "Body", "mesh": 0, "skin": 0}],
            "meshes": [{"primitives": [primitive]}],
            "skins": [{"joints": list(range(len(names))), "inverseBindMatrices": 4}],
            "accessors": accessors,
            "bufferViews": views,
            "buffers": [{"byteLength": len(data), "uri": uri}],
        }
    )


class WithFolder(FolderTest):
    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def describe(self, name, **more):
        description = {"name": name, "model": "man.gltf", "height_m": 1.7, "license": "CC0-1.0", **more}
        file = write_json(self.folder / f"{name}.json", description)
        return file


class Import(WithFolder):
    def test_makes_people_of_models(self):
        (self.folder / "man.gltf").write_text(box_man())
        one, other = self.describe("one"), self.describe("other", height_m=1.95, sex="female", wears="boxes")
        people("import", one, "-o", self.folder / "people")
        people("import", other, "--with", self.folder / "people", "-o", self.folder / "people")
        listed = people("list", self.folder / "people").stdout
        self.assertRegex(listed, r"one +male +35 +1\.70 m")
        self.assertRegex(listed, r"other +female +35 +1\.95 m +nothing +boxes")
        people("sheet", self.folder / "people", "--width", 1000, "-o", self.folder / "s.png")
        with Image.open(self.folder / "s.png") as picture:
            self.assertEqual(picture.width, 1000)

    def test_says_what_is_wrong_and_leaves_nothing(self):
        (self.folder / "man.gltf").write_text(box_man(lambda name: name.replace("LeftUpLeg", "Gamba")))
        cases = [
            (self.describe("a"), r"/bones/left_thigh.*Gamba"),
            (self.describe("b", height_m=300), r"/height_m: found 300, expected 0\.5 to 2\.5"),
            (self.describe("c", model="nobody.glb"), r"nobody\.glb: found no such file"),
            (
                self.describe("d", bones={"left_thigh": "Gamba"}, clips={"walk": {"speed_mps": 1.3}}),
                r"/clips/walk/name.*has none",
            ),
        ]
        before = self.names()
        for file, said in cases:
            done = people("import", file, "-o", self.folder / "people", code=2)
            self.assertRegex(done.stderr, said)
        self.assertEqual(self.names(), before)


class Sheet(WithFolder):
    def setUp(self):
        super().setUp()
        if not (PEOPLE / "population.json").exists():
            self.skipTest(f"no baked people in {PEOPLE}: run scripts/setup.sh")

    def test_draws_a_picture_of_the_wanted_width(self):
        for name, kind in (("sheet.png", "PNG"), ("sheet.jpg", "JPEG")):
            people("sheet", PEOPLE, "--count", 3, "--width", 1200, "-o", self.folder / name)
            with Image.open(self.folder / name) as picture:
                self.assertEqual(picture.format, kind)
                self.assertEqual(picture.width, 1200)
                self.assertGreater(picture.height, 1000)
                self.assertGreater(len(set(picture.convert("L").getdata())), 100)
        self.assertEqual(self.names(), ["sheet.jpg", "sheet.png"])

    def test_shows_only_who_is_named(self):
        first, second = re.findall(r"^person_\d+", people("list", PEOPLE).stdout, re.M)[:2]
        sizes = []
        for names in (first, f"{first},{second}"):
            people("sheet", PEOPLE, "--people", names, "--width", 800, "-o", self.folder / "s.png")
            with Image.open(self.folder / "s.png") as picture:
                sizes.append(list(picture.convert("L").resize((50, 100)).getdata()))
        self.assertNotEqual(*sizes)

    def test_says_what_is_wrong_and_leaves_nothing(self):
        (self.folder / "folder.png").mkdir()
        before = self.names()
        out = self.folder / "s.png"
        cases = [
            ([PEOPLE, "-o", self.folder / "s.bmp"], r"\.bmp.*\.png"),
            ([PEOPLE, "-o", self.folder / "sheet"], r"no extension"),
            ([PEOPLE, "-o", self.folder / "nowhere" / "s.png"], r"no folder .*nowhere"),
            ([PEOPLE, "-o", self.folder / "folder.png"], r"a folder"),
            ([PEOPLE, "-o", out, "--people", "nobody"], r"nobody.*people list"),
            ([PEOPLE, "-o", out, "--count", "0"], r"--count.*at least 1"),
            ([PEOPLE, "-o", out, "--width", "10"], r"--width.*800"),
            ([self.folder, "-o", out], r"population\.json"),
        ]
        for arguments, said in cases:
            done = people("sheet", *arguments, code=2)
            self.assertRegex(done.stderr, said)
        self.assertEqual(self.names(), before)

    def test_stops_when_asked(self):
        process = subprocess.Popen(
            [THRONG, "people", "sheet", PEOPLE, "--width", "8000", "-o", self.folder / "s.png"],
            stderr=subprocess.PIPE,
            text=True,
        )
        process.stderr.readline()  # it has begun
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("cancelled", said)
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
