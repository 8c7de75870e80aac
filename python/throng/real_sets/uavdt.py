"""UAVDT's benchmark M, of vehicles; throng's export in its layout has people, as category 4."""

from __future__ import annotations

from pathlib import Path

from ..errors import DatasetError
from ._files import below, frame_number, number_lines, numbered, wrong_layout
from ._images import RealImage, RealSet, read_boxes

_CAR, _TRUCK, _BUS, _PERSON = 1, 2, 3, 4
_WHOLE = "frame, id, left, top, width, height, out of view, occlusion, category"
_IGNORE = "frame, id, left, top, width, height"


def read_uavdt(folder: Path) -> RealSet:
    """Folders UAV-benchmark-M/SEQ/ and GT/SEQ_gt_whole.txt, with GT/SEQ_gt_ignore.txt where it is.

    The published set labels no people: what a detector of people finds there, outside of ignored regions, is scored as
    false. Sequences without a file in GT/ are left out.
    """
    parts = below(folder, "UAV-benchmark-M", "GT")
    if not parts:
        raise wrong_layout(folder, "UAV-benchmark-M/ and GT/")
    images: list[RealImage] = []
    for part in parts:
        for path in sorted((part / "GT").glob("*_gt_whole.txt")):
            images += _sequence(part, path)
    return RealSet("uavdt", folder, images)


def _sequence(folder: Path, path: Path) -> list[RealImage]:
    name = path.name.removesuffix("_gt_whole.txt")
    frames = folder / "UAV-benchmark-M" / name
    if not frames.is_dir():
        raise DatasetError(f"{path}: found no folder {frames}, expected the sequence's images")
    pictures = numbered(frames)
    people: dict[int, list[list[float]]] = {number: [] for number in pictures}
    ignored: dict[int, list[list[float]]] = {number: [] for number in pictures}

    def add(to: dict[int, list[list[float]]], file: Path, line: int, values: list[float]) -> None:
        number = frame_number(file, line, values[0])
        if number not in pictures:
            raise DatasetError(f"{file}:{line}: found the frame {number}, expected one of {len(pictures)} in {frames}")
        to[number].append(values[2:6])

    for line, values in number_lines(path, _WHOLE, 9):
        if values[8] not in (_CAR, _TRUCK, _BUS, _PERSON):
            raise DatasetError(f"{path}:{line}: found the category {values[8]:g}, expected 1 to 4")
        if values[8] == _PERSON:
            add(people, path, line, values)
    ignore = path.with_name(f"{name}_gt_ignore.txt")
    if ignore.is_file():
        for line, values in number_lines(ignore, _IGNORE, 6):
            add(ignored, ignore, line, values)
    return [
        RealImage(pictures[number], name, read_boxes(people[number]), read_boxes(ignored[number]), None)
        for number in pictures
    ]
