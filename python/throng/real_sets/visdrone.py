"""VisDrone: images (DET) and videos (MOT, VID), as the toolkits VisDrone2018-DET and -MOT describe them."""

from __future__ import annotations

from pathlib import Path

from ..errors import DatasetError
from ._files import below, frame_number, find_image, images_in, number_lines, numbered, wrong_layout
from ._images import RealImage, RealSet, read_boxes, table

_IGNORED, _PEDESTRIAN, _PERSON = 0, 1, 2
_IMAGE = "left, top, width, height, score, category, truncation, occlusion"
_VIDEO = "frame, id, " + _IMAGE


def read_visdrone(folder: Path) -> RealSet:
    """Folders images/ and annotations/ (a text per image), or sequences/SEQ/ and annotations/SEQ.txt.

    People are the categories 1 and 2 with a score of 1. Ignored are regions of category 0 and people with a score of 0.
    """
    images: list[RealImage] = []
    for part in below(folder, "images", "annotations"):
        images += _read_images(part)
    for part in below(folder, "sequences", "annotations"):
        images += _read_videos(part)
    if not images:
        raise wrong_layout(folder, "annotations/ with images/ or sequences/")
    return RealSet("visdrone", folder, images)


def _label(path: Path, line: int, values: list[float]) -> tuple[list[float], bool] | None:
    """Left, top, width and height, and whether it is a person; None for what is neither person nor ignored."""
    score, category = values[4:6]
    if score not in (0, 1):
        raise DatasetError(f"{path}:{line}: found the score {score:g}, expected 1 (scored) or 0 (ignored)")
    if not 0 <= category <= 11:
        raise DatasetError(f"{path}:{line}: found the category {category:g}, expected 0 to 11")
    if category == _IGNORED or (score == 0 and category in (_PEDESTRIAN, _PERSON)):
        return values[:4], False
    return (values[:4], True) if category in (_PEDESTRIAN, _PERSON) else None


def _image(path: Path, sequence: str, labels: list[tuple[list[float], bool]]) -> RealImage:
    people = read_boxes([box for box, is_person in labels if is_person])
    ignored = read_boxes([box for box, is_person in labels if not is_person])
    return RealImage(path, sequence, people, ignored if len(ignored) else table([], 4), None)


def _read_images(folder: Path) -> list[RealImage]:
    images = []
    for path in sorted((folder / "annotations").glob("*.txt")):
        labels = [_label(path, line, values) for line, values in number_lines(path, _IMAGE, 8)]
        images.append(_image(find_image(folder / "images", path.stem, path), "", [one for one in labels if one]))
    labeled = {image.path for image in images}
    for picture in images_in(folder / "images"):
        if picture not in labeled:
            raise DatasetError(f"{picture}: found no annotations/{picture.stem}.txt, expected one for each image")
    return images


def _read_videos(folder: Path) -> list[RealImage]:
    images = []
    for path in sorted((folder / "annotations").glob("*.txt")):
        frames = folder / "sequences" / path.stem
        if not frames.is_dir():
            raise DatasetError(f"{path}: found no folder {frames}, expected the sequence's images")
        pictures = numbered(frames)
        labels: dict[int, list[tuple[list[float], bool]]] = {number: [] for number in pictures}
        for line, values in number_lines(path, _VIDEO, 10):
            number = frame_number(path, line, values[0])
            if number not in labels:
                expected = f"expected one of {len(labels)} in {frames}"
                raise DatasetError(f"{path}:{line}: found the frame {number}, {expected}")
            label = _label(path, line, values[2:])
            if label:
                labels[number].append(label)
        images += [_image(pictures[number], path.stem, labels[number]) for number in pictures]
    return images
