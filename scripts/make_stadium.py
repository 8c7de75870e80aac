#!/usr/bin/python3
"""Draws the stadium of scenarios/stadium_exit: its four stands, goals, dugouts and floodlights.

usage: scripts/make_stadium.py    (writes scenarios/stadium_exit/stadium.obj and stadium.mtl, as every configuration of the build does)

World coordinates are x east, y north, z up, in meters; the file's are y up. The crowd's obstacles are in
everyday.blueprint.json and must agree with SOUTH_BLOCKS.
"""
import math
from pathlib import Path

MATERIALS = {
    "concrete": (0.36, 0.35, 0.33),
    "wall": (0.44, 0.43, 0.41),
    "seat": (0.05, 0.13, 0.42),
    "seat_light": (0.80, 0.80, 0.78),
    "steel": (0.62, 0.64, 0.66),
    "white": (0.86, 0.86, 0.86),
    "roof": (0.78, 0.79, 0.80),
    "dark": (0.05, 0.06, 0.07),
    "lamp": (0.93, 0.93, 0.86),
    "red": (0.55, 0.06, 0.05),
}
SOUTH_BLOCKS = [(-88, -58), (-50, -22), (-14, 14), (22, 50), (58, 88)]  # m, between the passages


class Mesh:
    """Faces by material, each a list of corners counter-clockwise from outside."""

    def __init__(self):
        self.corners, self.faces = {}, {}  # a corner's number, from 1

    def face(self, material, *corners):
        texts = [" ".join(f"{v:.2f}".rstrip("0").rstrip(".") for v in (x, z, -y)) for x, y, z in corners]
        numbers = [self.corners.setdefault(text, len(self.corners) + 1) for text in texts]
        self.faces.setdefault(material, []).append(numbers)

    def box(self, material, low, high, place=lambda p: p):
        (x0, y0, z0), (x1, y1, z1) = low, high
        at = [
            place(p)
            for p in [
                (x0, y0, z0),
                (x1, y0, z0),
                (x1, y1, z0),
                (x0, y1, z0),
                (x0, y0, z1),
                (x1, y0, z1),
                (x1, y1, z1),
                (x0, y1, z1),
            ]
        ]
        for side in [(4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]:
            self.face(material, *(at[i] for i in side))

    def write(self, folder, name):
        lines = ["# Made by scripts/make_stadium.py; y up, metres.", f"mtllib {name}.mtl"]
        lines += [f"v {corner}" for corner in self.corners]
        for material, faces in self.faces.items():
            lines.append(f"usemtl {material}")
            lines += ["f " + " ".join(map(str, face)) for face in faces]
        write_changed(folder / f"{name}.obj", lines)
        colors = [f"newmtl {m}\nKd {r} {g} {b}" for m, (r, g, b) in MATERIALS.items() if m in self.faces]
        write_changed(folder / f"{name}.mtl", colors)


def write_changed(file, lines):
    """Leaves a file alone that has these lines, since the source folder may be read-only by then."""
    text = "\n".join(lines) + "\n"
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def stand(mesh, place, length_m, rows, front_m=1.0, rise_m=0.36, depth_m=0.9, light=lambda along, row: False):
    """Rows of seats: `place` takes (along, back, up) of a block that faces its own front, back = 0."""
    aisle_m, section_m, seats_m = 1.2, 7.0, 0.5
    for row in range(rows):
        back, top = row * depth_m, front_m + row * rise_m
        mesh.box("concrete", (0, back, 0 if row == 0 else top - rise_m - 0.02), (length_m, back + depth_m, top), place)
        sections = max(1, round(length_m / section_m))
        for section in range(sections):
            start = section * length_m / sections + aisle_m / 2
            end = (section + 1) * length_m / sections - aisle_m / 2
            cells = max(1, round((end - start) / seats_m / 2))
            begun, color = start, None
            for cell in range(cells + 1):  # neighbors of the same color are one box
                along = start + cell * (end - start) / cells
                now = None if cell == cells else ("seat_light" if light(along, row) else "seat")
                if now == color:
                    continue
                if color:
                    mesh.box(color, (begun, back + 0.42, top + 0.2), (along, back + 0.84, top + 0.42), place)
                    mesh.box(color, (begun, back + 0.78, top + 0.42), (along, back + 0.86, top + 0.78), place)
                begun, color = along, now
    depth, height = rows * depth_m, front_m + rows * rise_m
    mesh.box("wall", (0, depth - 0.02, 0), (length_m, depth + 0.25, height + 0.9), place)
    for along in (0, length_m - 0.2):  # what closes a stand to its sides, up to the rows
        for row in range(rows):
            mesh.box(
                "wall",
                (along, row * depth_m, 0),
                (along + 0.2, (row + 1) * depth_m, front_m + row * rise_m + 0.9),
                place,
            )


def goal(mesh, x, outward):
    """7.32 m by 2.44 m, its net as a few bars."""
    for y in (77 - 3.66, 77 + 3.66):
        mesh.box("white", (x - 0.06, y - 0.06, 0), (x + 0.06, y + 0.06, 2.44))
    mesh.box("white", (x - 0.06, 77 - 3.66, 2.38), (x + 0.06, 77 + 3.66, 2.5))
    back = x + 2 * outward
    for i in range(9):
        y = 77 - 3.66 + i * 0.915
        mesh.box("white", (min(x, back), y - 0.02, 2.4), (max(x, back), y + 0.02, 2.44))
        mesh.box("white", (back - 0.02, y - 0.02, 0), (back + 0.02, y + 0.02, 2.44))


def floodlight(mesh, x, y):
    mesh.box("steel", (x - 0.35, y - 0.35, 0), (x + 0.35, y + 0.35, 26))
    towards = math.atan2(77 - y, -x)
    for row in range(4):
        for column in range(6):
            side, up = (column - 2.5) * 1.1, 26 + row * 1.0
            cx, cy = x - side * math.sin(towards), y + side * math.cos(towards)
            mesh.box("lamp", (cx - 0.4, cy - 0.4, up), (cx + 0.4, cy + 0.4, up + 0.8))
    mesh.box("dark", (x - 0.3, y - 0.3, 26), (x + 0.3, y + 0.3, 30.2))


LETTERS = {  # 5 columns by 7 rows, the top row first
    "T": "11111 00100 00100 00100 00100 00100 00100",
    "H": "10001 10001 10001 11111 10001 10001 10001",
    "R": "11110 10001 10001 11110 10100 10010 10001",
    "O": "01110 10001 10001 10001 10001 10001 01110",
    "N": "10001 11001 10101 10101 10011 10001 10001",
    "G": "01110 10001 10000 10111 10001 10001 01110",
}


def writing(word, length_m, first_row, cell_m, mirrored):
    """Whether the seat at (along, row) is of a letter: two rows are one line of a letter's dots."""
    width_m = cell_m * (6 * len(word) - 1)

    def light(along, row):
        column = ((length_m - along if mirrored else along) - (length_m - width_m) / 2) / cell_m
        line = (row - first_row) // 2
        if not (0 <= column < 6 * len(word) - 1 and 0 <= line < 7) or column % 6 >= 5:
            return False
        return LETTERS[word[int(column // 6)]].split()[6 - line][int(column % 6)] == "1"

    return light


def main():
    mesh = Mesh()
    out_m = 0.02  # in front of the crowd's obstacle: surfaces that coincide flicker
    for west, east in SOUTH_BLOCKS:  # faces north; rows go up to the south
        length = east - west + 2 * out_m
        stand(
            mesh,
            lambda p, east=east: (east + out_m - p[0], 33 + out_m - p[1], p[2]),
            length,
            14,
            light=lambda along, row, length=length: min(along, length - along) < 2.2 or row in (0, 13),
        )
    stand(mesh, lambda p: (-56 + p[0], 116 + p[1], p[2]), 112, 24, light=writing("THRONG", 112, 5, 2.4, False))
    stand(mesh, lambda p: (-60 - p[1], 42 + p[0], p[2]), 68, 18, light=lambda along, row: row in (5, 6, 11, 12))
    stand(mesh, lambda p: (60 + p[1], 110 - p[0], p[2]), 68, 18, light=lambda along, row: row in (5, 6, 11, 12))
    mesh.box("roof", (-57, 122, 16.6), (57, 140, 17.1))
    for i in range(9):
        mesh.box("steel", (-56.2 + 14 * i, 138.4, 0), (-55.8 + 14 * i, 138.8, 16.6))
    for x, outward in ((-52.5, -1), (52.5, 1)):
        goal(mesh, x, outward)
    for x in (-18, 10):
        mesh.box("dark", (x, 41.5, 0), (x + 8, 41.7, 2.0))
        mesh.box("red", (x, 41.7, 1.9), (x + 8, 42.9, 2.1))
    for x in (-75, 75):
        for y in (50, 120):
            floodlight(mesh, x, y)
    mesh.write(Path(__file__).resolve().parent.parent / "scenarios" / "stadium_exit", "stadium")


if __name__ == "__main__":
    main()
