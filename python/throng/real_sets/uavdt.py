"""UAVDT's benchmark M, of vehicles; throng's export in its layout has people, as category 4."""

from __future__ import annotations

from pathlib import Path

from ._files import Skips, WrongLine, below, files_in, numbered, read_frames, sequences, wrong_layout
from ._images import RealImage, read_boxes

_CAR, _TRUCK, _BUS, _PERSON = 1, 2, 3, 4
_WHOLE = "frame, id, left, top, width, height, out of view, occlusion, category"
_IGNORE = "frame, id, left, top, width, height"


def read_uavdt(folder: Path, skips: Skips) -> list[RealImage]:
    """Folders UAV-benchmark-M/SEQ/ and GT/SEQ_gt_whole.txt, with GT/SEQ_gt_ignore.txt where it is.

    The published set labels no people: what a detector of people finds there, outside of ignored regions, is scored as
    false.
    """
    parts = below(folder, "UAV-benchmark-M", "GT")
    if not parts:
        raise wrong_layout(folder, "UAV-benchmark-M/ and GT/")
    images: list[RealImage] = []
    for part in parts:
        with skips.faults():
            texts = files_in(part / "GT", (".txt",), skips)
            labels = {path.stem.removesuffix("_gt_whole"): path for path in texts if path.stem.endswith("_gt_whole")}
            for path, frames in sequences(labels, part / "UAV-benchmark-M", skips):
                with skips.faults():
                    images += _sequence(path, frames, skips)
    return images


def _sequence(path: Path, frames: Path, skips: Skips) -> list[RealImage]:
    image_files = numbered(frames, skips)
    people: dict[int, list[list[float]]] = {number: [] for number in image_files}
    ignored: dict[int, list[list[float]]] = {number: [] for number in image_files}

    def add(number: int, values: list[float]) -> None:
        if values[8] not in (_CAR, _TRUCK, _BUS, _PERSON):
            raise WrongLine(f"found the category {values[8]:g}, expected 1 to 4")
        if values[8] == _PERSON:
            people[number].append(values[2:6])

    read_frames(path, _WHOLE, 9, image_files, add, skips)
    ignore = path.with_name(f"{frames.name}_gt_ignore.txt")
    if ignore.is_file():
        read_frames(ignore, _IGNORE, 6, image_files, lambda number, values: ignored[number].append(values[2:6]), skips)
    return [
        RealImage(image_file, frames.name, read_boxes(people[number]), read_boxes(ignored[number]), None)
        for number, image_file in image_files.items()
    ]
