"""MOT Challenge (2015 to 2020) and PETS 2009, whose sequences PETS09-S2L1 and others it distributes in its format."""

from __future__ import annotations

from pathlib import Path

from ..errors import DatasetError
from ._files import below, frame_number, number_lines, numbered, wrong_layout
from ._images import RealImage, RealSet, read_boxes

_PEDESTRIAN = 1
# Benchmarks neither reward nor punish these: on a vehicle, static person, distractor, reflection, crowd.
_NOT_SCORED = (2, 7, 8, 12, 13)
_COLUMNS = "frame, id, left, top, width, height, considered, ..."


def read_mot(folder: Path) -> RealSet:
    """A sequence (img1/, gt/gt.txt), a folder of sequences, or a folder of such (train/).

    People are those of class 1 that are to be considered, in the files of MOT15 (10 columns, without classes) all that
    are. Boxes are of whole bodies. Pixels count from 1 in the files.
    """
    sequences = below(folder, "img1", "gt/gt.txt")
    for part in sorted(path for path in folder.iterdir() if path.is_dir() and path not in sequences):
        sequences += [path for path in below(part, "img1", "gt/gt.txt") if path != part]
    if not sequences:
        raise wrong_layout(folder, "img1/ and gt/gt.txt, or folders that have them")
    return RealSet("mot", folder, [image for sequence in sequences for image in _sequence(sequence)])


def _sequence(folder: Path) -> list[RealImage]:
    pictures = numbered(folder / "img1")
    people: dict[int, list[list[float]]] = {number: [] for number in pictures}
    ignored: dict[int, list[list[float]]] = {number: [] for number in pictures}
    path = folder / "gt/gt.txt"
    for line, values in number_lines(path, _COLUMNS, 7):
        number = frame_number(path, line, values[0])
        if number not in pictures:
            raise DatasetError(f"{path}:{line}: found the frame {number}, expected one of {len(pictures)} in img1/")
        left, top, width, height, considered = values[2:7]
        if considered not in (0, 1):
            raise DatasetError(f"{path}:{line}: found {considered:g} in the column 7, expected 0 or 1")
        # 9 columns have a class and a visibility, 10 a place in the world instead.
        person_class = _PEDESTRIAN if len(values) in (7, 10) else int(values[7])
        box = [left - 1, top - 1, width, height]
        if considered == 1 and person_class == _PEDESTRIAN:
            people[number].append(box)
        elif person_class in (_PEDESTRIAN, *_NOT_SCORED):
            ignored[number].append(box)
    return [
        RealImage(pictures[number], folder.name, read_boxes(people[number]), read_boxes(ignored[number]), None)
        for number in pictures
    ]
