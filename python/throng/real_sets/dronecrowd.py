"""DroneCrowd: heads in videos, as a MATLAB file per image or as tracks in a text per sequence."""

from __future__ import annotations

from pathlib import Path

from ._files import (
    IMAGES,
    Fault,
    Skipped,
    Skips,
    WrongLine,
    below,
    files_in,
    numbered,
    read_frames,
    sequences,
    wrong_layout,
)
from ._images import RealImage, read_mats, table

_COLUMNS = "frame, id, left, top, width, height, out, occluded, ..."
_SEQUENCE_DIGITS = 3


def read_dronecrowd(folder: Path, skips: Skips) -> list[RealImage]:
    """Images in images/ (img001002.jpg is frame 2 of the sequence 1, or a folder for each sequence), and either
    ground_truth/GT_img001002.mat (needs scipy) or annotations/SEQUENCE.txt; or folders that have them (train_data/).

    Heads of tracks are the middles of their boxes; those marked as out of the image are left out.
    """
    tracks, mats = below(folder, "images", "annotations"), below(folder, "images", "ground_truth")
    if not tracks and not mats:
        raise wrong_layout(folder, "images/ with annotations/ or ground_truth/, or folders that have them")
    images: list[RealImage] = []
    for part in tracks:
        with skips.faults():
            images += _read_tracks(part, skips)
    for part in mats:
        if part not in tracks:
            images += read_mats(part / "images", part / "ground_truth", skips, _sequence_of)
    return images


def _sequence_of(stem: str) -> str:
    return stem.removeprefix("img")[:_SEQUENCE_DIGITS]


def _read_tracks(folder: Path, skips: Skips) -> list[RealImage]:
    images: list[RealImage] = []
    texts = {path.stem: path for path in files_in(folder / "annotations", (".txt",), skips)}
    singles = files_in(folder / "images", IMAGES, skips)
    with_folder = {name: path for name, path in texts.items() if (folder / "images" / name).is_dir()}
    for path, frames in sequences(with_folder, folder / "images", skips):
        with skips.faults():
            images += _sequence(path, numbered(frames, skips), skips)
    labeled: set[Path] = set()
    for name in sorted(texts.keys() - with_folder.keys()):
        with skips.faults():
            image_files = _numbered_images(singles, texts[name])
            labeled.update(image_files.values())
            images += _sequence(texts[name], image_files, skips)
    for image_file in singles:
        if image_file not in labeled:
            skips.add(Skipped(image_file, "found no labels of its sequence, expected a file of them"))
    return images


def _sequence(path: Path, image_files: dict[int, Path], skips: Skips) -> list[RealImage]:
    heads: dict[int, list[list[float]]] = {number: [] for number in image_files}

    def add(number: int, values: list[float]) -> None:
        left, top, width, height, out = values[2:7]
        if out not in (0, 1):
            raise WrongLine(f"found {out:g} in the column 7, expected 0 or 1")
        if out == 0:
            heads[number].append([left + width / 2, top + height / 2])

    read_frames(path, _COLUMNS, 8, image_files, add, skips)
    return [
        RealImage(image_file, path.stem, None, table([], 4), table(heads[number], 2))
        for number, image_file in image_files.items()
    ]


def _numbered_images(singles: list[Path], path: Path) -> dict[int, Path]:
    """A sequence's images by frame, from 1, of images in one folder: its number is the first three digits of their names."""
    if path.stem.isdigit():
        prefix = f"img{int(path.stem):0{_SEQUENCE_DIGITS}}"
        numbers = {
            image_file.stem.removeprefix(prefix): image_file
            for image_file in singles
            if image_file.stem.startswith(prefix)
        }
        found = {int(number): image_file for number, image_file in numbers.items() if number.isdigit()}
        if found:
            return found
    raise Fault(path, f"found no images, expected the folder images/{path.stem} or images by sequence")
