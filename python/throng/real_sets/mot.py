"""MOT Challenge (2015 to 2020) and PETS 2009, whose sequences PETS09-S2L1 and others it distributes in its format."""

from __future__ import annotations

from pathlib import Path

from ._files import Skipped, Skips, WrongLine, folders_in, numbered, read_frames, wrong_layout
from ._images import RealImage, read_boxes

_PEDESTRIAN = 1
# Benchmarks neither reward nor punish these: on a vehicle, static person, distractor, reflection, crowd.
_NOT_SCORED = (2, 7, 8, 12, 13)
_COLUMNS = "frame, id, left, top, width, height, considered, ..."


def read_mot(folder: Path, skips: Skips) -> list[RealImage]:
    """A sequence (img1/, gt/gt.txt), a folder of sequences, or a folder of such (train/).

    People are those of class 1 that are to be considered, in the files of MOT15 (10 columns, without classes) all that
    are. Boxes are of whole bodies. Pixels count from 1 in the files.
    """
    nested = [inner for outer in folders_in(folder) for inner in (outer, *folders_in(outer))]
    images: list[RealImage] = []
    found = [path for path in (folder, *nested) if (path / "img1").is_dir()]
    if not any((path / "gt/gt.txt").exists() for path in found):
        raise wrong_layout(folder, "img1/ and gt/gt.txt, or folders that have them")
    for sequence in found:
        with skips.faults():
            if (sequence / "gt/gt.txt").exists():
                images += _sequence(sequence, skips)
            else:
                skips.add(Skipped(sequence, "found no gt/gt.txt, expected the labels of img1/"))
    return images


def _sequence(folder: Path, skips: Skips) -> list[RealImage]:
    image_files = numbered(folder / "img1", skips)
    people: dict[int, list[list[float]]] = {number: [] for number in image_files}
    ignored: dict[int, list[list[float]]] = {number: [] for number in image_files}

    def add(number: int, values: list[float]) -> None:
        left, top, width, height, considered = values[2:7]
        if considered not in (0, 1):
            raise WrongLine(f"found {considered:g} in the column 7, expected 0 or 1")
        # 9 columns have a class and a visibility, 10 a place in the world instead.
        person_class = _PEDESTRIAN if len(values) in (7, 10) else int(values[7])
        box = [left - 1, top - 1, width, height]
        if considered == 1 and person_class == _PEDESTRIAN:
            people[number].append(box)
        elif person_class in (_PEDESTRIAN, *_NOT_SCORED):
            ignored[number].append(box)

    read_frames(folder / "gt/gt.txt", _COLUMNS, 7, image_files, add, skips)
    return [
        RealImage(image_file, folder.name, read_boxes(people[number]), read_boxes(ignored[number]), None)
        for number, image_file in image_files.items()
    ]
