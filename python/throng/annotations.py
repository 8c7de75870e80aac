"""The annotations of one frame as columns of NumPy arrays.

Boxes, masks, heads and keypoints are in box coordinates: the corner of the image is (0, 0) and pixel i covers [i, i +
1). Rows keep the order of the file. Coordinates of the world are meters with Z up.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Callable, Collection, Iterator, Mapping, Sequence, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from . import masks as _masks
from ._words import counted
from .errors import DatasetError

FloatArray = NDArray[np.float64]
_Item = TypeVar("_Item", int, str)
PERSON, DRONE = 1, 2
#: Category ids of vehicles, which datasets have whose job asks for the annotation "vehicles".
CAR, TRAIN, VAN, TRUCK, BUS, MOTORCYCLE = 3, 4, 5, 6, 7, 8
VEHICLES = {CAR: "car", TRAIN: "train", VAN: "van", TRUCK: "truck", BUS: "bus", MOTORCYCLE: "motorcycle"}
NAMES = {PERSON: "person", DRONE: "drone", **VEHICLES}


@dataclass(frozen=True)
class AnnotationFilter:
    """Which annotations of a frame are kept; None and 0 keep all."""

    categories: frozenset[int] | None = None
    states: frozenset[str] | None = None
    min_visibility: float = 0.0
    min_height_px: float = 0.0
    min_area_px: float = 0.0
    min_contrast: float = 0.0
    predicate: Callable[[Mapping[str, Any]], bool] | None = None

    def keeps(self, record: Mapping[str, Any]) -> bool:
        if self.categories is not None and record.get("category_id") not in self.categories:
            return False
        if self.states is not None and record.get("state") not in self.states:
            return False
        if record.get("visibility", 1.0) < self.min_visibility or record.get("area", 0) < self.min_area_px:
            return False
        if self.min_contrast > 0 and isinstance(record.get("difficulty"), dict):
            contrasts = [record["difficulty"].get(key) for key in ("contrast", "edge_contrast")]
            if max((value for value in contrasts if isinstance(value, (int, float))), default=0.0) < self.min_contrast:
                return False
        if self.min_height_px > 0 and (record.get("bbox_amodal") or record["bbox"])[3] < self.min_height_px:
            return False
        return self.predicate is None or bool(self.predicate(record))


class Annotations(Sequence[Mapping[str, Any]]):
    """The people (and drones) of a frame. Iterating gives the records of the COCO file."""

    def __init__(
        self,
        records: Collection[Mapping[str, Any]],
        height: int,
        width: int,
        where: str,
        tracks: Mapping[int, Mapping[str, Any]],
        track_offset: int = 0,
    ) -> None:
        self.records = list(records)
        self._height, self._width, self._where = height, width, where
        self._tracks = tracks
        self._track_offset = track_offset

    def __len__(self) -> int:
        return len(self.records)

    @overload
    def __getitem__(self, index: int) -> Mapping[str, Any]:
        ...

    @overload
    def __getitem__(self, index: slice) -> Annotations:
        ...

    def __getitem__(self, index: int | slice) -> Mapping[str, Any] | Annotations:
        if isinstance(index, slice):
            return self._with(self.records[index])
        return self.records[index]

    def __iter__(self) -> Iterator[Mapping[str, Any]]:
        return iter(self.records)

    def __repr__(self) -> str:
        counts = (
            counted(len(self.people), "person", "people"),
            counted(len(self.drones), "drone"),
            counted(len(self.vehicles), "vehicle"),
        )
        return f"Annotations({', '.join(counts)})"

    def _with(self, records: Collection[Mapping[str, Any]]) -> Annotations:
        return Annotations(records, self._height, self._width, self._where, self._tracks, self._track_offset)

    def select(self, keep: Sequence[bool] | NDArray[np.bool_]) -> Annotations:
        """The rows where keep is true, for example a.select(a.visibility > 0.5)."""
        if len(keep) != len(self):
            raise ValueError(f"keep: found {len(keep)} values, expected {len(self)}")
        return self._with([record for record, kept in zip(self.records, keep) if kept])

    @property
    def people(self) -> Annotations:
        return self.select([record.get("category_id") == PERSON for record in self.records])

    @property
    def drones(self) -> Annotations:
        return self.select([record.get("category_id") == DRONE for record in self.records])

    @property
    def vehicles(self) -> Annotations:
        """Motor vehicles and trains, of jobs with "vehicles" in outputs.annotations."""
        return self.select([record.get("category_id") in VEHICLES for record in self.records])

    def _column(
        self, key: str, shape: tuple[int, ...], dtype: Any = np.float64, *, required: str = "", cut: int | None = None
    ) -> NDArray[Any]:
        """The records' values; missing ones are NaN unless `required` says what would write them. cut: of lists only so many."""
        values = [record.get(key) for record in self.records]
        if not values:
            return np.empty((0,) + shape, dtype=dtype)
        if any(value is None for value in values):
            is_asked = any(record.get("category_id") == PERSON for record in self.records)
            if required and is_asked and all(value is None for value in values):
                raise DatasetError(f'{self._where}: found no "{key}", expected it in the annotations: {required}')
            if dtype is not np.float64:
                raise DatasetError(f'{self._where}: found an annotation without "{key}", expected it in all')
            filler = np.full(shape, np.nan).tolist()
            values = [filler if value is None else value for value in values]
        if cut is not None:
            values = [value[:cut] if isinstance(value, list) else value for value in values]
        try:
            out = np.array(values, dtype=dtype)
        except (TypeError, ValueError, OverflowError):
            raise DatasetError(f'{self._where}: "{key}": found values that are not numbers of one shape') from None
        if out.shape != (len(values),) + shape:
            raise DatasetError(f'{self._where}: "{key}": found the shape {out.shape[1:]}, expected {shape}')
        return out

    @cached_property
    def ids(self) -> NDArray[np.int64]:
        return self._column("id", (), np.int64)

    @cached_property
    def track_ids(self) -> NDArray[np.int64]:
        """The same for a person in all frames and cameras of a run."""
        return self._column("track_id", (), np.int64) + self._track_offset

    @cached_property
    def category_ids(self) -> NDArray[np.int64]:
        """1: person, 2: drone."""
        return self._column("category_id", (), np.int64)

    @cached_property
    def boxes(self) -> FloatArray:
        """(N, 4): x, y, width, height of the visible part."""
        return self._column("bbox", (4,))

    @property
    def boxes_xyxy(self) -> FloatArray:
        """(N, 4): left, top, right, bottom of the visible part, as torchvision has it."""
        return np.concatenate((self.boxes[:, :2], self.boxes[:, :2] + self.boxes[:, 2:]), axis=1)

    @cached_property
    def boxes_amodal(self) -> FloatArray:
        """(N, 4): x, y, width, height of the whole person, hidden or not; may leave the image."""
        return self._column("bbox_amodal", (4,))

    @cached_property
    def areas(self) -> FloatArray:
        """Pixels of the visible mask."""
        return self._column("area", ())

    @cached_property
    def visibility(self) -> FloatArray:
        """Visible share, in (0, 1]."""
        return self._column("visibility", ())

    @cached_property
    def truncation(self) -> FloatArray:
        """Share of the amodal box outside of the image."""
        return np.nan_to_num(self._column("truncation", ()))

    @cached_property
    def head_boxes(self) -> FloatArray:
        """(N, 4): x, y, width, height of the head with hair and headwear, hidden or not; NaN where the camera sees none.

        With "heads" in outputs.annotations.
        """
        return self._column("head_box", (4,), required="heads")

    @cached_property
    def head_visibility(self) -> FloatArray:
        """Visible share of what each person has in their head's box; NaN where that is no pixel."""
        return self._column("head_visibility", (), required="heads")

    def _member(self, name: str, key: str) -> FloatArray:
        """The number record[name][key] of each annotation, NaN where there is no record[name]."""
        values = []
        for record in self.records:
            group = record.get(name)
            value = group.get(key) if isinstance(group, dict) else None
            if group is not None and (isinstance(value, bool) or not isinstance(value, (int, float))):
                raise DatasetError(f"{self._where}: found a {name} whose {key} is no number, expected one")
            values.append(np.nan if value is None else float(value))
        return np.array(values, dtype=np.float64)

    def _items(self, record: Any, key: str, kind: type[_Item]) -> list[_Item]:
        """The list record[key], empty where there is none; all of its items are of one kind."""
        values = record.get(key, []) if isinstance(record, dict) else None
        if not isinstance(values, list) or not all(type(value) is kind for value in values):
            expected = "integers" if kind is int else "names"
            raise DatasetError(f"{self._where}: found a {key} that is no list of {expected}")
        return list(values)

    @property
    def contrasts(self) -> FloatArray:
        """CIELAB difference to the surroundings; NaN without "difficulty" in outputs.annotations."""
        return self._member("difficulty", "contrast")

    @property
    def edge_contrasts(self) -> FloatArray:
        """Median CIELAB difference along the outline; NaN without "difficulty" in outputs.annotations."""
        return self._member("difficulty", "edge_contrast")

    @property
    def blur_px(self) -> FloatArray:
        """Motion in the image during the exposure; NaN without "difficulty" in outputs.annotations."""
        return self._member("difficulty", "blur_px")

    @property
    def lookalikes(self) -> list[list[int]]:
        """Track ids of people nearby who look alike; empty without "difficulty" in outputs.annotations."""
        groups = [record.get("difficulty", {}) for record in self.records]
        return [self._items(group, "lookalikes", int) for group in groups]

    @property
    def danger_m(self) -> FloatArray:
        """Distance to the reach of the nearest hazard, 0 within; NaN before any, and without "hazards"."""
        return self._member("danger", "distance_m")

    @property
    def danger_s(self) -> FloatArray:
        """Time within reach of any hazard so far; NaN before any, and without "hazards"."""
        return self._member("danger", "inside_s")

    @property
    def occluders(self) -> list[list[tuple[int, float]]]:
        """Of each person, instances that hide a share of them; empty without "occluders" in outputs.annotations."""
        try:
            return [[(int(i), float(share)) for i, share in record.get("occluded_by", [])] for record in self.records]
        except (TypeError, ValueError, OverflowError):
            raise DatasetError(f"{self._where}: found an occluded_by that is no list of [instance, share]") from None

    @cached_property
    def is_crowd(self) -> NDArray[np.bool_]:
        return np.array([bool(record.get("iscrowd", 0)) for record in self.records], dtype=np.bool_)

    @cached_property
    def positions(self) -> FloatArray:
        """(N, 3): where they stand in the world, m."""
        return self._column("position", (3,))

    @cached_property
    def velocities(self) -> FloatArray:
        """(N, 2): m/s on the ground."""
        return self._column("velocity", (2,), cut=2)  # drones have three

    @cached_property
    def headings(self) -> FloatArray:
        """Radians, counter-clockwise from +x."""
        return self._column("heading", ())

    @cached_property
    def boxes_3d(self) -> FloatArray:
        """(N, 7): center x, y, z; length, width, height (ahead, to the side, up), m; heading, rad."""
        return np.concatenate((self._column("box_3d", (6,)), self.headings[:, None]), axis=1)

    def corners_3d(self) -> FloatArray:
        """(N, 8, 3): corners of boxes_3d in the world; the first four are the bottom's, counter-clockwise."""
        boxes = self.boxes_3d
        signs = np.array([[x, y, z] for z in (-1, 1) for x, y in ((1, -1), (1, 1), (-1, 1), (-1, -1))])
        local = signs[None] * boxes[:, None, 3:6] / 2
        with np.errstate(invalid="ignore"):
            c, s = np.cos(boxes[:, 6:7]), np.sin(boxes[:, 6:7])
        x = c * local[..., 0] - s * local[..., 1]
        y = s * local[..., 0] + c * local[..., 1]
        corners: FloatArray = boxes[:, None, :3] + np.stack((x, y, local[..., 2]), axis=-1)
        return corners

    @cached_property
    def heads(self) -> FloatArray:
        """(N, 2): middle of the head, also if hidden; NaN where the camera sees nothing, and of drones."""
        return self._column("head", (2,))

    @cached_property
    def keypoints(self) -> FloatArray:
        """(N, 17, 3): x, y and visibility (0 not labeled, 1 hidden, 2 visible) in COCO's order; 0 of drones."""
        flat = self._column("keypoints", (51,), required='a job writes it with "keypoints" in outputs.annotations')
        return np.nan_to_num(flat).reshape(-1, 17, 3)

    @cached_property
    def keypoints_3d(self) -> FloatArray:
        """(N, 17, 3): keypoints in the world, m; NaN of drones."""
        return self._column("keypoints_3d", (17, 3), required='a job writes it with "keypoints" in outputs.annotations')

    @cached_property
    def joints(self) -> FloatArray:
        """(N, 33, 3): x, y and state of each joint: 0 outside of the image, 1 hidden, 2 visible, 3 hidden by the own body.

        Names are in categories[0]["joints"] of the COCO file. 0 of drones.
        """
        flat = self._column("joints", (99,), required='a job writes it with "skeletons" in outputs.annotations')
        return np.nan_to_num(flat).reshape(-1, 33, 3)

    @cached_property
    def joints_3d(self) -> FloatArray:
        """(N, 33, 3): joints in the world, m; NaN of drones."""
        return self._column("joints_3d", (33, 3), required='a job writes it with "skeletons" in outputs.annotations')

    @cached_property
    def bone_turns(self) -> FloatArray:
        """(N, 21, 4): unit quaternions (w, x, y, z) that turn bones from the rest pose, which faces +x; NaN of drones."""
        return self._column("bone_turns", (21, 4), required='a job writes it with "skeletons" in outputs.annotations')

    @cached_property
    def gazes(self) -> FloatArray:
        """(N, 3): unit vectors in the world that heads face along; NaN of drones."""
        return self._column("gaze", (3,), required='a job writes it with "skeletons" in outputs.annotations')

    @property
    def states(self) -> list[str | None]:
        """Activities: waiting, walking, running, following, panicking, lying, falling, getting_up, sitting or
        squatting."""
        return [record.get("state") for record in self.records]

    @property
    def actions(self) -> list[list[str]]:
        """Names of the actions of each person; empty without "actions" in outputs.annotations. A motion (stand, walk, run, turn, fall,
        lie, get_up, sit, squat or cower) and others: look_around, use_phone, look_at_drone, panic, cheer, lean, talk, call, film,
        point, wave, clap, dance, eat, drink, smoke, read, look_back, carry."""
        return [self._items(record, "actions", str) for record in self.records]

    @property
    def together_with(self) -> list[list[int]]:
        """Track ids of members of each person's group within 3 m; empty without "actions" in outputs.annotations."""
        return [self._items(record, "together_with", int) for record in self.records]

    @property
    def exits(self) -> list[str | None]:
        """The exits that they want to reach."""
        return [record.get("exit") for record in self.records]

    @property
    def attributes(self) -> list[Mapping[str, Any]]:
        """Sex, age, clothes, carried item of each; {} where the file has none."""
        return [self._tracks.get(record.get("track_id", -1), {}).get("attributes", {}) for record in self.records]

    @property
    def groups(self) -> list[int | None]:
        """Numbers of their social groups."""
        return [self._tracks.get(record.get("track_id", -1), {}).get("group") for record in self.records]

    def mask(self, index: int, *, amodal: bool = False) -> _masks.BoolArray:
        """(height, width) bool of one annotation: the visible part, or with amodal the whole body in the image."""
        mask: _masks.BoolArray = self._with([self.records[index]]).masks(amodal=amodal)[0]
        return mask

    def masks(self, *, amodal: bool = False) -> _masks.BoolArray:
        """(N, height, width) bool: the visible parts, or with amodal the whole bodies in the image."""
        key = "amodal_segmentation" if amodal else "segmentation"
        for record in self.records:
            if key not in record:
                needed = ': a job writes it with "amodal" in outputs.annotations' if amodal else ""
                raise DatasetError(f'{self._where}: found no "{key}", expected it in the annotations{needed}')
        try:
            return _masks.decode_many([record[key] for record in self.records], self._height, self._width)
        except DatasetError as error:
            raise DatasetError(f"{self._where}: {error}") from None
