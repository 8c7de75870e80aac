"""DroneCrowd: heads in videos, as a MATLAB file per image or as tracks in a text per sequence."""

from __future__ import annotations

from pathlib import Path

from ..errors import DatasetError
from ._files import below, frame_number, read_heads, find_image, images_in, number_lines, numbered, wrong_layout
from ._images import RealImage, RealSet, table

_COLUMNS = "frame, id, left, top, width, height, out, occluded, ..."
_SEQUENCE_DIGITS = 3


def read_dronecrowd(folder: Path) -> RealSet:
    """Images in images/ (img001002.jpg is frame 2 of the sequence 1, or a folder for each sequence), and either
    ground_truth/GT_img001002.mat (needs scipy) or annotations/SEQUENCE.txt; or folders that have them (train_data/).

    Heads of tracks are the middles of their boxes; those marked as out of the image are left out.
    """
    images = [
        image
        for part in below(folder, "images")
        for image in (_read_tracks(part) if (part / "annotations").is_dir() else _read_mats(part))
    ]
    if not images:
        raise wrong_layout(folder, "images/ with annotations/ or ground_truth/, or folders that have them")
    return RealSet("dronecrowd", folder, images)


def _read_mats(folder: Path) -> list[RealImage]:
    images = []
    for path in sorted((folder / "ground_truth").glob("GT_*.mat")):
        stem = path.stem.removeprefix("GT_")
        sequence = stem.removeprefix("img")[:_SEQUENCE_DIGITS]
        picture = find_image(folder / "images", stem, path)
        images.append(RealImage(picture, sequence, None, table([], 4), read_heads(path)))
    return images


def _read_tracks(folder: Path) -> list[RealImage]:
    images = []
    for path in sorted((folder / "annotations").glob("*.txt")):
        pictures = _pictures(folder / "images", path)
        heads: dict[int, list[list[float]]] = {number: [] for number in pictures}
        for line, values in number_lines(path, _COLUMNS, 8):
            number = frame_number(path, line, values[0])
            if number not in pictures:
                raise DatasetError(f"{path}:{line}: found the frame {number}, expected one of {len(pictures)} images")
            left, top, width, height, out = values[2:7]
            if out not in (0, 1):
                raise DatasetError(f"{path}:{line}: found {out:g} in the column 7, expected 0 or 1")
            if out == 0:
                heads[number].append([left + width / 2, top + height / 2])
        images += [
            RealImage(pictures[number], path.stem, None, table([], 4), table(heads[number], 2)) for number in pictures
        ]
    return images


def _pictures(folder: Path, path: Path) -> dict[int, Path]:
    """A sequence's images by frame, from 1."""
    if (folder / path.stem).is_dir():
        return numbered(folder / path.stem)
    # Of images in one folder, the sequence's number is the first three digits of the name.
    if path.stem.isdigit():
        prefix = f"img{int(path.stem):0{_SEQUENCE_DIGITS}}"
        found = [picture for picture in images_in(folder) if picture.stem.startswith(prefix)]
        if found and all(picture.stem[len(prefix) :].isdigit() for picture in found):
            return {int(picture.stem[len(prefix) :]): picture for picture in found}
    raise DatasetError(f"{path}: found no images, expected the folder {folder / path.stem} or images by sequence")
