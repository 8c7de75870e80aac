"""A file that names some of a dataset's images: *.frames.json, which throng.Dataset opens."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path

from .errors import DatasetError, OutputFileError

SUFFIX = ".frames.json"


def read_frame_list(path: str) -> tuple[str, list[str]]:
    """The dataset, which lies relative to the file, and the names of its images. DatasetError for another content."""
    try:
        value = json.loads(Path(path).read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError) as error:
        raise DatasetError(f"{path}: found no JSON that can be read ({error}), expected a list of frames") from None
    names = value.get("frames") if isinstance(value, dict) else None
    dataset = value.get("dataset") if isinstance(value, dict) else None
    if not isinstance(dataset, str) or not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise DatasetError(f'{path}: expected an object with "dataset", a path, and "frames", names of images')
    return os.path.join(os.path.dirname(os.path.abspath(path)), dataset), names


def write_frame_list(path: str | os.PathLike[str], dataset: str | os.PathLike[str], names: Sequence[str]) -> None:
    """OutputFileError where the file cannot be written."""
    file = os.fspath(path)
    if not file.endswith(SUFFIX):
        raise OutputFileError(f"{file}: expected a name that ends with {SUFFIX}, by which throng.Dataset knows it")
    folder = os.path.dirname(os.path.abspath(file))
    value = {"dataset": os.path.relpath(os.path.abspath(os.fspath(dataset)), folder), "frames": list(names)}
    try:
        Path(file).write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")
    except OSError as error:
        raise OutputFileError(f"{file}: cannot be written: {error.strerror or error}") from error
