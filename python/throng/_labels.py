"""The COCO file of a dataset: what belongs to the whole at once, annotations image by image.

throng writes one record per line. Of such a file only the positions of the images' lines are found when it is opened;
each image's annotations are parsed on request. Any other COCO file is parsed as a whole.
"""

from __future__ import annotations

import json
import math
import re
from typing import Any

from .errors import DatasetError
from .storage import LABELS_FILE, Buffer, Storage, check_name

Record = dict[str, Any]

_ANNOTATIONS = b'\n"annotations":[\n'
_LINE = re.compile(rb'\{"id":\d{1,18},"image_id":(\d{1,18}),[^\n]*\n')
_MAX_SIDE_PX = 65535
_MAX_PIXELS = 1 << 28


class LabelFile:
    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self.where = storage.where(LABELS_FILE)
        self._lines: dict[int, list[tuple[int, int]]] = {}
        self._parsed: dict[int, list[Record]] | None = None
        self._buffer: Buffer | None
        self._buffer, start, end = storage.map(LABELS_FILE)
        split = self._buffer.find(_ANNOTATIONS, start, end)
        whole: Record
        if split >= 0 and self._index(split + len(_ANNOTATIONS), end):
            whole = self._load(self._buffer[start:split].rstrip().rstrip(b",") + b"}")
        else:
            whole = self._load(self._buffer[start:end])
            self._buffer = None
            self._parsed = self._group(whole)
        self.info = self._of(whole, "info", dict, {})
        self.categories: list[Record] = self._of(whole, "categories", list, [])
        for i, category in enumerate(self.categories):
            if not (isinstance(category, dict) and isinstance(category.get("id"), int) and "name" in category):
                raise DatasetError(f"{self.where}: /categories/{i}: found {_short(category)}, expected id and name")
        self.images: list[Record] = self._check_images(self._of(whole, "images", list, None))
        self.tracks = {
            track["id"]: track
            for track in self._of(whole, "tracks", list, [])
            if isinstance(track, dict) and isinstance(track.get("id"), int)
        }
        known = {image["id"] for image in self.images}
        labeled = set(self._lines) if self._parsed is None else set(self._parsed)
        if strangers := labeled - known:
            raise DatasetError(f"{self.where}: annotations: found the image_id {min(strangers)}, which no image has")

    def __getstate__(self) -> dict[str, Any]:
        state = self.__dict__.copy()
        state["_buffer"] = None
        return state

    def _index(self, start: int, end: int) -> bool:
        """Finds the lines of each image; False if the file is laid out in another way."""
        buffer = self._buffer
        assert buffer is not None
        if any(buffer.find(text, start, end) >= 0 for text in (b"},{", b"}, {")):
            return False  # several records in a line
        at = block = start
        image = -1
        for match in _LINE.finditer(buffer, start, end):
            if match.start() != at:
                return False
            number = int(match[1])
            if number != image:
                if image >= 0:
                    self._lines.setdefault(image, []).append((block, at))
                image, block = number, at
            at = match.end()
        if image >= 0:
            self._lines.setdefault(image, []).append((block, at))
        if buffer[at:end].split() == [b"]}"]:
            return True
        self._lines = {}
        # The last record has no comma and no line of its own in files of other layouts.
        return False

    def _load(self, text: bytes) -> Record:
        try:
            value = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise DatasetError(f"{self.where}: found no valid JSON: {error}") from error
        if not isinstance(value, dict):
            raise DatasetError(f"{self.where}: found {type(value).__name__}, expected an object")
        return value

    def _of(self, whole: Record, key: str, kind: type, default: Any) -> Any:
        value = whole.get(key, default)
        if not isinstance(value, kind):
            raise DatasetError(f"{self.where}: /{key}: found {_short(value)}, expected {_NAMES[kind]}")
        return value

    def _group(self, whole: Record) -> dict[int, list[Record]]:
        groups: dict[int, list[Record]] = {}
        for i, record in enumerate(self._of(whole, "annotations", list, None)):
            if not isinstance(record, dict) or not isinstance(record.get("image_id"), int):
                raise DatasetError(
                    f"{self.where}: /annotations/{i}: found {_short(record)}, expected an object with " "image_id"
                )
            groups.setdefault(record["image_id"], []).append(record)
        return groups

    def _check_images(self, images: list[Any]) -> list[Record]:
        seen: set[int] = set()
        for i, image in enumerate(images):
            here = f"{self.where}: /images/{i}"
            if not isinstance(image, dict):
                raise DatasetError(f"{here}: found {_short(image)}, expected an object")
            for key, kind in (("id", int), ("file_name", str), ("width", int), ("height", int)):
                if not isinstance(image.get(key), kind) or isinstance(image.get(key), bool):
                    raise DatasetError(f"{here}/{key}: found {_short(image.get(key))}, expected {_NAMES[kind]}")
            width, height = image["width"], image["height"]
            if not (0 < width <= _MAX_SIDE_PX and 0 < height <= _MAX_SIDE_PX and width * height <= _MAX_PIXELS):
                raise DatasetError(
                    f"{here}: found {width} x {height} pixels, expected 1 to {_MAX_SIDE_PX} a side and "
                    f"{_MAX_PIXELS} at most"
                )
            check_name(image["file_name"], f"{here}/file_name")
            for key, kinds in _OPTIONAL.items():
                value = image.get(key)
                if value is not None and (not isinstance(value, kinds) or isinstance(value, bool)):
                    raise DatasetError(f"{here}/{key}: found {_short(value)}, expected {_NAMES[kinds[-1]]}")
            if not math.isfinite(image.get("time_s") or 0):
                raise DatasetError(f"{here}/time_s: found {image['time_s']}, expected a finite number")
            if image["id"] in seen:
                raise DatasetError(f"{here}/id: found {image['id']} twice, expected it once")
            seen.add(image["id"])
        return images

    def records(self, image_id: int) -> list[Record]:
        """The annotations of an image; [] if it has none."""
        if self._parsed is not None:
            return self._checked(self._parsed.get(image_id, []), image_id)
        blocks = self._lines.get(image_id)
        if blocks is None:
            return []
        if self._buffer is None:
            self._buffer = self._storage.map(LABELS_FILE)[0]
        records: list[Record] = []
        for start, end in blocks:
            try:
                records += json.loads(b"[" + self._buffer[start:end].rstrip().rstrip(b",") + b"]")
            except (ValueError, RecursionError) as error:
                raise DatasetError(
                    f"{self.where}: annotations of image {image_id}: found no valid JSON: {error}"
                ) from error
        if any(record.get("image_id") != image_id for record in records):
            # Lines that hold several records: another layout after all.
            self._parsed = self._group(self._load(self._storage.read(LABELS_FILE)))
            return self.records(image_id)
        return self._checked(records, image_id)

    def _checked(self, records: list[Record], image_id: int) -> list[Record]:
        for record in records:
            box = record.get("bbox")
            if not isinstance(box, list) or len(box) != 4:
                raise DatasetError(
                    f'{self.where}: annotation {record.get("id")} of image {image_id}: "bbox": found '
                    f"{_short(box)}, expected [x, y, width, height]"
                )
        return records


_NAMES = {dict: "an object", list: "a list", int: "a whole number", float: "a number", str: "text"}
# Keys of an image that may be missing or null.
_OPTIONAL: dict[str, tuple[type, ...]] = {
    **dict.fromkeys(("run", "camera_id", "density_file"), (str,)),
    **dict.fromkeys(("camera", "sensor", "flight", "environment", "counts"), (dict,)),
    "frame": (int,),
    "time_s": (int, float),
    "exits": (list,),
}


def _short(value: Any) -> str:
    if value is None:
        return "nothing"
    text = json.dumps(value, default=str)
    return text if len(text) <= 60 else text[:57] + "..."
