"""VisDrone: images (DET) and videos (MOT, VID), as the toolkits VisDrone2018-DET and -MOT describe them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ._files import Skips, WrongLine, below, files_in, numbered, pairs, read_frames, read_lines, sequences, wrong_layout
from ._images import RealImage, read_boxes

_IGNORED, _PEDESTRIAN, _PERSON = 0, 1, 2
# Middles of its levels of occlusion: none, up to a half, more.
_HIDDEN = (0.0, 0.25, 0.75)
_IMAGE = "left, top, width, height, score, category, truncation, occlusion"
_VIDEO = "frame, id, " + _IMAGE


def read_visdrone(folder: Path, skips: Skips) -> list[RealImage]:
    """Folders images/ and annotations/ (a text per image), or sequences/SEQ/ and annotations/SEQ.txt.

    People are the categories 1 and 2 with a score of 1. Ignored are regions of category 0 and people with a score of 0.
    """
    singles, videos = below(folder, "images", "annotations"), below(folder, "sequences", "annotations")
    if not singles and not videos:
        raise wrong_layout(folder, "annotations/ with images/ or sequences/")
    images: list[RealImage] = []
    for part in singles:
        with skips.faults():
            images += _read_images(part, skips)
    for part in videos:
        with skips.faults():
            images += _read_videos(part, skips)
    return images


class _Labels:
    """Boxes, left, top, width and height, of people and of what is ignored."""

    def __init__(self) -> None:
        self.people: list[list[float]] = []
        self.hidden: list[float] = []
        self.ignored: list[list[float]] = []

    def add(self, values: list[float]) -> None:
        score, category = values[4:6]
        if score not in (0, 1):
            raise WrongLine(f"found the score {score:g}, expected 1 (scored) or 0 (ignored)")
        if not 0 <= category <= 11:
            raise WrongLine(f"found the category {category:g}, expected 0 to 11")
        is_person = category in (_PEDESTRIAN, _PERSON)
        if is_person and score == 1:
            if min(values[2:4]) > 0:
                self.people.append(values[:4])
                self.hidden.append(_HIDDEN[int(np.clip(values[7], 0, 2))])
        elif is_person or category == _IGNORED:
            self.ignored.append(values[:4])

    def image(self, path: Path, sequence: str) -> RealImage:
        boxes, ignored = read_boxes(self.people), read_boxes(self.ignored)
        return RealImage(path, sequence, boxes, ignored, None, np.array(self.hidden))


def _read_images(folder: Path, skips: Skips) -> list[RealImage]:
    images = []
    for path, image_file in pairs(files_in(folder / "annotations", (".txt",), skips), folder / "images", skips):
        labels = _Labels()
        with skips.faults():
            read_lines(path, _IMAGE, 8, labels.add)
            images.append(labels.image(image_file, ""))
    return images


def _read_videos(folder: Path, skips: Skips) -> list[RealImage]:
    images: list[RealImage] = []
    texts = {path.stem: path for path in files_in(folder / "annotations", (".txt",), skips)}
    for path, frames in sequences(texts, folder / "sequences", skips):
        with skips.faults():
            image_files = numbered(frames, skips)
            labels = {number: _Labels() for number in image_files}
            read_frames(path, _VIDEO, 10, image_files, lambda number, values: labels[number].add(values[2:]), skips)
            images += [labels[number].image(image_file, path.stem) for number, image_file in image_files.items()]
    return images
