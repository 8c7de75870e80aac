"""Readers of photographs with labels, in the layouts of their publishers, to test on what was trained with throng.

>>> images = throng.open_real_set("visdrone", "VisDrone2019-DET-val")
>>> images[0].image(), images[0].boxes, images[0].ignored

The sets themselves are not part of throng; each has terms of its own. docs/training.md says where labels differ.
"""

from __future__ import annotations

import logging
import os
from pathlib import Path
from typing import Callable

from .._words import counted, known_names
from ..errors import DatasetError
from ._files import Skipped, Skips
from ._images import RealImage, RealSet
from .dronecrowd import read_dronecrowd
from .mot import read_mot
from .movingdronecrowd import read_movingdronecrowd
from .nwpu import read_nwpu
from .shanghaitech import read_shanghaitech
from .uavdt import read_uavdt
from .upcount import read_upcount
from .visdrone import read_visdrone

_LOG = logging.getLogger("throng")

REAL_SETS: dict[str, Callable[[Path, Skips], list[RealImage]]] = {
    "dronecrowd": read_dronecrowd,
    "mot": read_mot,
    "movingdronecrowd": read_movingdronecrowd,
    "nwpu": read_nwpu,
    "shanghaitech": read_shanghaitech,
    "uavdt": read_uavdt,
    "upcount": read_upcount,
    "visdrone": read_visdrone,
}
WHOLE_BODIES = ("mot",)
"""Kinds of sets that label whole bodies; the others label what can be seen."""


def open_real_set(kind: str, folder: str | os.PathLike[str]) -> RealSet:
    """The images and labels of a folder in the layout of `kind`, a key of REAL_SETS; "mot" reads PETS 2009, too.

    Labels are read at once, images when they are asked for. Damaged files and those without a counterpart are left
    out: `skipped` of the result lists them, and one line is logged. Labels with a wrong line lose their image, in videos its
    frame. Errors: ValueError for another kind, DatasetError for a folder of another layout or with nothing that can be
    read.
    """
    known_names("kind", kind, REAL_SETS)
    path = Path(folder)
    if not path.is_dir():
        raise DatasetError(f"{path}: found no such folder, expected a set in the layout of {kind}")
    skips = Skips()
    images = []
    for image in REAL_SETS[kind](path, skips):
        with skips.faults():
            image.check()
            images.append(image)
    found = RealSet(kind, path, images, skips.all())
    if found.skipped:
        count = counted(len(found.skipped), "file, folder or line", "files, folders or lines")
        _LOG.warning("%s: skipped %s, the first %s", path, count, found.skipped[0])
    return found


__all__ = ["REAL_SETS", "RealImage", "RealSet", "Skipped", "open_real_set"]
