"""One annotated image of a dataset."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from functools import cached_property
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np
from numpy.typing import NDArray

from . import _png
from ._optional import require
from .annotations import AnnotationFilter, Annotations
from .camera import Camera
from .errors import DatasetError

if TYPE_CHECKING:
    from .source import Source

FloatArray = NDArray[np.float32]
# More than any label file of so many pixels takes: 16-bit RGB without compression and headers.
_BYTES_PER_PIXEL = 7


class Frame:
    """An image with its labels. Images and label files are read when they are asked for, never kept."""

    def __init__(self, source: Source, record: Mapping[str, Any], keep: AnnotationFilter | None) -> None:
        self._source = source
        self._keep = keep
        self.record = record

    def __repr__(self) -> str:
        return f"Frame({self.sequence} frame {self.index} at {self.time_s:g} s, {self.width} x {self.height})"

    @property
    def id(self) -> int:
        """Unique in its Dataset, also a merged one."""
        return int(self.record["id"]) + self._source.image_offset

    @property
    def file_name(self) -> str:
        return str(self.record["file_name"])

    @property
    def width(self) -> int:
        return int(self.record["width"])

    @property
    def height(self) -> int:
        return int(self.record["height"])

    @property
    def run(self) -> str:
        return str(self.record.get("run") or "")

    @property
    def camera_id(self) -> str:
        """The drone that took the image."""
        return str(self.record.get("camera_id") or "")

    @property
    def index(self) -> int:
        """Number of the frame in its run."""
        return int(self.record.get("frame") or 0)

    @property
    def time_s(self) -> float:
        """Seconds since the run began."""
        return float(self.record.get("time_s") or 0.0)

    @property
    def sequence(self) -> str:
        """Names the video that the frame belongs to: RUN/CAMERA, in merged datasets NUMBER:RUN/CAMERA."""
        return f"{self._source.prefix}{self.run}/{self.camera_id}"

    @property
    def split(self) -> str | None:
        """The split that the job put the frame's run in."""
        return self._source.split_of(self.run)

    def _object(self, key: str) -> dict[str, Any]:
        """The object record[key], empty where there is none."""
        value = self.record.get(key) or {}
        if not isinstance(value, dict):
            raise DatasetError(f"{self._where}: found a {key} that is no object")
        return dict(value)

    def _objects(self, key: str) -> list[Mapping[str, Any]]:
        """The list of objects record[key], empty where there is none."""
        values = self.record.get(key) or []
        if not isinstance(values, list) or not all(isinstance(value, dict) for value in values):
            raise DatasetError(f"{self._where}: found a {key} that is no list of objects")
        return list(values)

    @property
    def drawn(self) -> Mapping[str, Any]:
        """Values that were sampled for the frame's run, by dotted path ("drones.0.camera.pitch_deg")."""
        return self._object("drawn")

    @property
    def scenario(self) -> str:
        """Id of the scenario of the frame's run."""
        scenario = self.drawn.get("scenario") or self._source.description.get("job", {}).get("scenario")
        if isinstance(scenario, str):
            return scenario
        return json.dumps(scenario, sort_keys=True)

    @property
    def place(self) -> str:
        """The name of `scenario` in version 0.1."""
        return self.scenario

    @property
    def environment(self) -> Mapping[str, Any]:
        """Light and weather."""
        return self._object("environment")

    @property
    def flight(self) -> Mapping[str, Any]:
        """The drone at time_s: what is true and what was measured."""
        return self._object("flight")

    @property
    def sensor(self) -> Mapping[str, Any]:
        return self._object("sensor")

    @property
    def counts(self) -> Mapping[str, int]:
        """People in the image as the file has it, without regard to filters: all, visible, truncated."""
        return self._object("counts")

    @property
    def exits(self) -> list[Mapping[str, Any]]:
        """State of each exit, with its door and zone as polygons in box coordinates."""
        return self._objects("exits")

    @property
    def hazards(self) -> list[Mapping[str, Any]]:
        """Place, reach and area of each hazard that has begun; empty without "hazards" in outputs.annotations."""
        return self._objects("hazards")

    @cached_property
    def camera(self) -> Camera:
        if self.record.get("camera") is None:
            raise DatasetError(f"{self._where}: found no camera, expected one in the image's record")
        try:
            return Camera.from_record(self.record["camera"], self.width, self.height)
        except DatasetError as error:
            raise DatasetError(f"{self._where}: {error}") from None

    @cached_property
    def annotations(self) -> Annotations:
        """All annotations that the dataset's filters keep, people's and drones'."""
        records = self._source.labels.records(int(self.record["id"]))
        if self._keep is not None:
            try:
                records = [record for record in records if self._keep.keeps(record)]
            except (TypeError, IndexError) as error:
                raise DatasetError(f"{self._where}: an annotation cannot be filtered: {error}") from error
        return Annotations(
            records, self.height, self.width, self._where, self._source.labels.tracks, self._source.track_offset
        )

    @property
    def people(self) -> Annotations:
        return self.annotations.people

    @property
    def _where(self) -> str:
        return f"{self._source.labels.where}: {self.file_name}"

    def image(self) -> NDArray[np.uint8]:
        """(height, width, 3) RGB. Needs Pillow."""
        pil = require("PIL.Image", "image()")
        storage = self._source.storage
        data = storage.read(self.file_name, 4096 + 8 * self.width * self.height)
        try:
            with pil.open(io.BytesIO(data), formats=("JPEG", "PNG")) as picture:
                size = picture.size
                pixels = np.array(picture.convert("RGB")) if size == (self.width, self.height) else None
        except (OSError, SyntaxError, ValueError, pil.DecompressionBombError) as error:
            raise DatasetError(f"{storage.where(self.file_name)}: found no whole image ({error})") from error
        if pixels is None:
            raise DatasetError(
                f"{storage.where(self.file_name)}: found {size[0]} x {size[1]} pixels, expected "
                f"{self.width} x {self.height}"
            )
        return pixels

    def has(self, kind: str) -> bool:
        """Whether there is a label file: density, or a kind of `outputs.annotations` that has a value for each pixel."""
        return self._source.storage.exists(self._label_name(kind))

    def _label_name(self, kind: str) -> str:
        if kind == "density":
            return str(self.record.get("density_file") or self._stem("density", "npz"))
        return self._stem(kind, "png")

    def _stem(self, folder: str, suffix: str) -> str:
        _, _, rest = self.file_name.partition("/")
        return f"{folder}/{rest.rpartition('.')[0]}.{suffix}"

    def _read_label(self, kind: str) -> tuple[bytes, str]:
        name = self._label_name(kind)
        storage = self._source.storage
        if not storage.exists(name):
            raise DatasetError(
                f'{storage.where(name)}: found no such file: a job writes it with "{kind}" in ' "outputs.annotations"
            )
        return storage.read(name, 4096 + _BYTES_PER_PIXEL * self.width * self.height), storage.where(name)

    def _unpacked(self, file: Any, where: str) -> Any:
        """The array of a .npz file, of which nothing is unpacked that is larger than the image's."""
        limit = 4096 + 4 * self.width * self.height
        size = file.zip.getinfo("density.npy").file_size
        if size > limit:
            raise DatasetError(f"{where}: found an array of {size} bytes, expected {limit} at most")
        return file["density"]

    def _png(self, kind: str, dtype: Any, channels: int) -> NDArray[Any]:
        data, where = self._read_label(kind)
        pixels = _png.decode(data, where, (self.height, self.width))
        if pixels.dtype != dtype or pixels.ndim != (2 if channels == 1 else 3):
            raise DatasetError(
                f"{where}: found {pixels.dtype} of shape {pixels.shape}, expected "
                f"{np.dtype(dtype)} with {channels} channel(s)"
            )
        return pixels

    def density(self) -> FloatArray:
        """(height, width) people per pixel; sums to the number of heads in the image."""
        data, where = self._read_label("density")
        try:
            values = np.load(io.BytesIO(data), allow_pickle=False)
            if isinstance(values, np.lib.npyio.NpzFile):
                values = self._unpacked(values, where)
        except (ValueError, OSError, EOFError, KeyError, zipfile.BadZipFile, zlib.error) as error:
            if isinstance(error, DatasetError):
                raise
            raise DatasetError(f"{where}: found no whole NumPy file ({error})") from error
        if (
            not isinstance(values, np.ndarray)
            or values.shape != (self.height, self.width)
            or values.dtype != np.float32
        ):
            raise DatasetError(
                f"{where}: found {getattr(values, 'dtype', 'no array')} "
                f"{getattr(values, 'shape', '')}, expected float32 ({self.height}, {self.width})"
            )
        return values

    def depth(self) -> FloatArray:
        """(height, width) camera z, m; infinity for sky, beyond 655.35 m and where the lens shows nothing."""
        centimeters = self._png("depth", np.uint16, 1)
        return np.where(centimeters == 0, np.inf, centimeters / 100.0).astype(np.float32)

    def instances(self) -> NDArray[np.int32]:
        """(height, width) ids: 0 sky, a person's track_id - 1000000 run, 0xFF0000 ground, ... (docs/formats.md)."""
        p = self._png("instances", np.uint8, 3).astype(np.int32)
        result: NDArray[np.int32] = p[..., 0] + 256 * p[..., 1] + 65536 * p[..., 2]
        return result

    def parts(self) -> NDArray[np.uint8]:
        """(height, width) body parts, 1 head to 9 carried item; 0 elsewhere."""
        return self._png("parts", np.uint8, 1)

    def semantic(self) -> NDArray[np.uint8]:
        """(height, width) values of `Dataset.semantic_classes`."""
        return self._png("semantic", np.uint8, 1)

    def semantic_colors(self) -> NDArray[np.uint8]:
        """(height, width, 3) the semantic classes in the colors of dataset.json."""
        colors = np.zeros((256, 3), dtype=np.uint8)
        for entry in self._source.description.get("semantic_classes", []):
            colors[int(entry["id"])] = entry["color"]
        picture: NDArray[np.uint8] = colors[self.semantic()]
        return picture

    def normals(self) -> FloatArray:
        """(height, width, 3) unit normals in world axes; 0 for sky."""
        p = self._png("normals", np.uint8, 3)
        vectors = np.where((p == 0).all(axis=-1, keepdims=True), np.float32(0), (p.astype(np.float32) - 128) / 127)
        return vectors.astype(np.float32)

    def flow(self, *, backward: bool = False) -> tuple[FloatArray, NDArray[np.bool_]]:
        """(height, width, 2) motion in x and y to the next frame, px, NaN where unknown; and where it is known.

        With `backward` it is that to the previous frame.
        """
        p = self._png("flow_backward" if backward else "flow", np.uint16, 3)
        known = p[..., 2] > 0
        motion = (p[..., :2].astype(np.float32) - 32768) / 64
        motion[~known] = np.nan
        return motion, known

    def flow_occlusion(self) -> NDArray[np.uint8]:
        """(height, width) where the next frame shows the same: 0 unknown, 1 visible, 2 hidden, 3 outside of the image."""
        return self._png("flow_occlusion", np.uint8, 1)

    def scene_flow(self) -> FloatArray:
        """(height, width, 3) motion in the world to the next frame, m; NaN where unknown."""
        p = self._png("scene_flow", np.uint16, 3)
        motion = (p.astype(np.float32) - 32768) / 1000
        motion[(p == 0).all(axis=-1)] = np.nan
        return motion

    def hazard_opacity(self) -> FloatArray:
        """(height, width, 3) share of what shows that fire, smoke with dust, and gas hide, each 0 to 1."""
        return self._png("hazard_opacity", np.uint8, 3).astype(np.float32) / 255

    def lens_mask(self) -> NDArray[np.bool_]:
        """(height, width) where the lens shows something."""
        name = f"cameras/{self.run}/{self.camera_id}.mask.png"
        storage = self._source.storage
        if not storage.exists(name):
            return np.ones((self.height, self.width), dtype=np.bool_)
        data = storage.read(name, 4096 + _BYTES_PER_PIXEL * self.width * self.height)
        result: NDArray[np.bool_] = _png.decode(data, storage.where(name), (self.height, self.width)) > 127
        return result
