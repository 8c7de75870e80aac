"""MovingDroneCrowd: heads in videos of moving drones, as boxes with identities."""

from __future__ import annotations

from pathlib import Path

from ._files import Skips, below, files_in, folders_in, numbered, read_frames, sequences, wrong_layout
from ._images import RealImage, table

_COLUMNS = "frame, id, left, top, width, height, ..."


def read_movingdronecrowd(folder: Path, skips: Skips) -> list[RealImage]:
    """Folders frames/SCENE/CLIP/ and annotations/SCENE/CLIP.csv. Frames count from 0 in the labels, images from 1.

    Heads are the middles of their boxes.
    """
    parts = below(folder, "frames", "annotations")
    if not parts:
        raise wrong_layout(folder, "frames/ and annotations/, or folders that have them")
    images: list[RealImage] = []
    for part in parts:
        for scene in folders_in(part / "annotations"):
            with skips.faults():
                clips = {path.stem: path for path in files_in(scene, (".csv",), skips)}
                for path, frames in sequences(clips, part / "frames" / scene.name, skips):
                    with skips.faults():
                        images += _clip(path, frames, f"{scene.name}/{path.stem}", skips)
    return images


def _clip(path: Path, frames: Path, name: str, skips: Skips) -> list[RealImage]:
    image_files = {number - 1: image_file for number, image_file in numbered(frames, skips).items()}
    heads: dict[int, list[list[float]]] = {number: [] for number in image_files}

    def add(number: int, values: list[float]) -> None:
        left, top, width, height = values[2:6]
        heads[number].append([left + width / 2, top + height / 2])

    read_frames(path, _COLUMNS, 6, image_files, add, skips, first=0)
    return [RealImage(file, name, None, table([], 4), table(heads[number], 2)) for number, file in image_files.items()]
