"""A dataset of throng as a sequence of frames, read from a folder, a tar or a zip file without unpacking.

Operations (filter, split, resample, ...) give new views; they copy no files and change none.
"""

from __future__ import annotations

import copy
import json
import math
import os
from typing import Any, Callable, Collection, Iterator, Mapping, Sequence, overload

import numpy as np
from numpy.typing import NDArray

from ._frame_list import SUFFIX, read_frame_list
from ._npy import read_npy
from ._optional import require
from ._words import counted, known_names
from .annotations import NAMES, AnnotationFilter
from .errors import DatasetError
from .frame import Frame
from .source import Source, verify_files
from .tables import Table, read_csv

_RUN_TRACKS = 1_000_000


class Dataset(Sequence[Frame]):
    """Frames of one or several datasets.

    >>> dataset = Dataset("out/dataset")        # or a .tar or .zip file, or a .frames.json of `python3 -m throng.match`
    >>> frame = dataset[0]
    >>> frame.people.boxes, frame.image(), frame.camera.project(frame.people.positions)
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        where, listed = os.fspath(path), None
        if where.endswith(SUFFIX):
            where, listed = read_frame_list(where)
        source = Source(where)
        self._sources: list[Source] = [source]
        self._frames: list[tuple[int, int]] = [(0, i) for i in range(len(source.labels.images))]
        if listed is not None:
            self._frames = _listed_frames(source, listed, os.fspath(path))
        self._keep: AnnotationFilter | None = None

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, index: int) -> Frame:
        ...

    @overload
    def __getitem__(self, index: slice | list[int] | NDArray[Any]) -> Dataset:
        ...

    def __getitem__(self, index: Any) -> Frame | Dataset:
        """A frame by its index; a slice or a list of indices gives a Dataset."""
        if isinstance(index, slice):
            return self._view(self._frames[index])
        if isinstance(index, (list, np.ndarray)):
            return self._view([self._index(int(i)) for i in index])
        if not isinstance(index, (int, np.integer)):
            raise TypeError(f"dataset[{index!r}]: expected the index of a frame, a slice or a list of indices")
        source, image = self._index(int(index))
        return Frame(self._sources[source], self._sources[source].labels.images[image], self._keep)

    def _index(self, index: int) -> tuple[int, int]:
        if not -len(self) <= index < len(self):
            raise IndexError(
                f"dataset[{index}]: found {counted(len(self), 'frame')}, expected an index below {len(self)}"
            )
        return self._frames[index]

    def __iter__(self) -> Iterator[Frame]:
        for i in range(len(self)):
            yield self[i]

    def __repr__(self) -> str:
        return f"Dataset({self.name!r}: {counted(len(self), 'frame')} of {counted(len(self.sequences), 'sequence')})"

    def _view(self, frames: Sequence[tuple[int, int]]) -> Dataset:
        view = copy.copy(self)
        view._frames = list(frames)
        return view

    # Metadata of the dataset.

    @property
    def name(self) -> str:
        return " + ".join(str(source.labels.info.get("description", "")) for source in self._sources)

    @property
    def info(self) -> Mapping[str, Any]:
        """dataset.json: conventions, job, splits, statistics, license. Of the first dataset where several were
        merged."""
        return self._sources[0].description

    @property
    def manifest(self) -> Mapping[str, Any]:
        """manifest.json: the job, seeds, every file with its size and SHA-256."""
        return self._sources[0].manifest

    @property
    def categories(self) -> dict[int, str]:
        return {int(c["id"]): str(c["name"]) for source in self._sources for c in source.labels.categories}

    @property
    def semantic_classes(self) -> dict[str, int]:
        """Names of the classes of `Frame.semantic()` with their values; empty without `semantic/`."""
        return {str(c["name"]): int(c["id"]) for c in self.info.get("semantic_classes", [])}

    @property
    def runs(self) -> list[str]:
        """Names of the runs of the frames, in their order."""
        return list(dict.fromkeys(frame.run for frame in self))

    @property
    def cameras(self) -> list[str]:
        return list(dict.fromkeys(frame.camera_id for frame in self))

    @property
    def sequences(self) -> dict[str, list[int]]:
        """Indices of the frames of each run and camera, by time."""
        indices: dict[str, list[int]] = {}
        for i, frame in enumerate(self):
            indices.setdefault(frame.sequence, []).append(i)
        for frames in indices.values():
            frames.sort(key=lambda i: float(self[i].time_s))
        return indices

    @property
    def splits(self) -> dict[str, Dataset]:
        """The splits that the job made, as datasets."""
        frames_by_split: dict[str, list[tuple[int, int]]] = {}
        for index, frame in zip(self._frames, self):
            if frame.split is not None:
                frames_by_split.setdefault(frame.split, []).append(index)
        return {name: self._view(frames) for name, frames in frames_by_split.items()}

    def tracks(self) -> dict[int, Mapping[str, Any]]:
        """Everybody with an annotation by track_id: run, group and attributes."""
        return {
            number + source.track_offset: track
            for source in self._sources
            for number, track in source.labels.tracks.items()
        }

    # Tables of runs.

    def metrics(self) -> Any:
        """metrics.json: figures of all runs (docs/metrics.md). A list of them where datasets were merged."""
        values = [source.json("metrics.json") for source in self._sources]
        return values[0] if len(values) == 1 else values

    def exits(self, run: str) -> Table:
        """Every exit at the time of every frame (docs/metrics.md); of the first dataset where several were merged."""
        return self._csv(f"exits/{run}.csv")

    def sensors(self, run: str, camera_id: str) -> Table:
        """Readings of a drone's sensors, and the truth, about 60 rows per second."""
        return self._csv(f"sensors/{run}/{camera_id}.csv")

    def _csv(self, name: str, texts: Collection[str] = ()) -> Table:
        storage = self._sources[0].storage
        return read_csv(storage.read(name), storage.where(name), texts)

    def field(self, run: str, frame: int, cell_m: float | None = None) -> tuple[NDArray[np.float32], Mapping[str, Any]]:
        """(4, rows, columns): people per m2, velocity in x and y, people per m2 by Voronoi cells; and the grid.

        cell_m: one of the sizes in outputs.fields.cells_m.
        """
        source = self._sources[0]
        grid = source.object(f"fields/{run}.json")
        folder = f"fields/{run}"
        if cell_m is not None:
            levels = {level["cell_m"]: level for level in grid.get("levels", [])}
            if cell_m not in levels:
                known = ", ".join(f"{size:g}" for size in levels) or "none"
                raise ValueError(f"cell_m: found {cell_m:g}, expected one of outputs.fields.cells_m: {known}")
            folder += "/" + str(levels[cell_m]["folder"])
            grid = {**grid, **levels[cell_m]}
        expected = (4, grid.get("rows"), grid.get("columns"))
        return read_npy(source, f"{folder}/{frame:06d}.npy", expected), grid

    def counts(self, run: str) -> Table:
        """People in zones and across lines of the ground, a row per frame and area (docs/formats_pixels.md).

        The columns "entered" and "left" are track ids with blanks between.
        """
        return self._csv(f"counts/{run}.csv", ("entered", "left"))

    def actions(self, run: str) -> Table:
        """Stretches of time in which people do something, seen or not: track_id, action, other, from_s, to_s.

        "other" is the track id of whom they are "together" with, else empty.
        """
        return self._csv(f"actions/{run}.csv", ("other",))

    def count_areas(self, run: str) -> Mapping[str, Any]:
        """The "zones" and "lines" of counts(), with their positions on the ground, m."""
        return self._sources[0].object(f"counts/{run}.json")

    def trajectories(self, run: str) -> tuple[NDArray[np.float32], Mapping[str, Any]]:
        """(frames, people, 4): x, y (m), heading (rad) and the state's number of everybody, seen or not, NaN where
        absent; and the times of the frames, the people's track ids and the names of the states."""
        source = self._sources[0]
        description = source.object(f"trajectories/{run}.json")
        name = f"trajectories/{run}.npy"
        expected = (len(description.get("times_s", ())), len(description.get("track_ids", ())), 4)
        return read_npy(source, name, expected), description

    def events(self, run: str) -> list[dict[str, Any]]:
        """The events of a run, by time: type, time_s, frame, and person, drone and place where the type has them."""
        name = f"events/{run}.jsonl"
        storage = self._sources[0].storage
        try:
            return [dict(json.loads(line)) for line in storage.read(name).decode().splitlines()]
        except ValueError as error:
            raise DatasetError(f"{storage.where(name)}: {error}, expected a JSON object on each line") from None

    # Views.

    def filter(
        self,
        predicate: Callable[[Frame], bool] | None = None,
        *,
        runs: Collection[str] | None = None,
        cameras: Collection[str] | None = None,
        split: str | None = None,
        min_people: int = 0,
        from_s: float = -math.inf,
        to_s: float = math.inf,
    ) -> Dataset:
        """The frames for which all conditions hold. min_people counts what filter_annotations left.

        Raises ValueError for a run or a camera of which the whole dataset has no frame.
        """
        records = [image for source in self._sources for image in source.labels.images]
        runs = known_names("runs", runs, (str(image.get("run")) for image in records))
        cameras = known_names("cameras", cameras, (str(image.get("camera_id")) for image in records))
        known_names("split", split, ("train", "val", "test"))

        def keeps(frame: Frame) -> bool:
            return (
                (runs is None or frame.run in runs)
                and (cameras is None or frame.camera_id in cameras)
                and (split is None or frame.split == split)
                and from_s <= frame.time_s <= to_s
                and (min_people <= 0 or len(frame.people) >= min_people)
                and (predicate is None or predicate(frame))
            )

        return self._view([index for index, frame in zip(self._frames, self) if keeps(frame)])

    def filter_annotations(
        self,
        predicate: Callable[[Mapping[str, Any]], bool] | None = None,
        *,
        categories: Collection[int] | None = None,
        states: Collection[str] | None = None,
        min_visibility: float = 0.0,
        min_height_px: float = 0.0,
        min_area_px: float = 0.0,
        min_contrast: float = 0.0,
    ) -> Dataset:
        """The same frames with only those annotations for which all conditions hold.

        min_height_px is of the whole person, min_contrast of datasets with "difficulty", predicate gets a record of the COCO file. It replaces an earlier filter.
        """
        view = self._view(self._frames)
        view._keep = AnnotationFilter(
            None if categories is None else frozenset(categories),
            None if states is None else frozenset(states),
            min_visibility,
            min_height_px,
            min_area_px,
            min_contrast,
            predicate,
        )
        return view

    def split(self, *, by: str = "run", seed: int = 0, **shares: float) -> dict[str, Dataset]:
        """Random parts, for example split(train=0.8, val=0.2), that sum to at most 1.

        by: "run" (default: frames of one run resemble each other), "sequence" (run and camera), "scenario",
        or "frame". Each part gets the whole groups that come nearest to its share of the groups,
        at least one where its share is above 0.
        """
        total = math.fsum(shares.values())
        if not shares or min(shares.values()) < 0 or total > 1 + 1e-9:
            raise ValueError(f"shares: found {shares}, expected shares from 0 that sum to at most 1")
        groups: dict[Any, list[tuple[int, int]]] = {}
        for index, frame in zip(self._frames, self):
            groups.setdefault(self._group_key(by, index, frame), []).append(index)
        keys = list(groups)
        wanted = sum(share > 0 for share in shares.values())
        if len(keys) < wanted:
            raise ValueError(
                f'by="{by}": found {counted(len(keys), by)}, expected at least one for each of {wanted} parts: '
                'make a dataset of more runs, or split by "sequence" or "frame"'
            )
        order = np.random.default_rng(seed).permutation(len(keys))
        parts: dict[str, Dataset] = {}
        sizes = _part_sizes(len(keys), shares)
        start = 0
        for name, size in sizes.items():
            chosen = {index for i in order[start : start + size] for index in groups[keys[i]]}
            parts[name] = self._view([index for index in self._frames if index in chosen])
            start += size
        return parts

    def _group_key(self, by: str, index: tuple[int, int], frame: Frame) -> Any:
        if by == "run":
            return index[0], frame.run
        if by == "sequence":
            return frame.sequence
        if by in ("scenario", "place"):  # its name in version 0.1
            return frame.scenario
        if by == "frame":
            return index
        raise ValueError(f'by: found {by!r}, expected "run", "sequence", "scenario" or "frame"')

    def resample(self, rate_hz: float) -> Dataset:
        """Of each sequence the frames nearest to rate_hz a second from its first on; never more than there are."""
        if not rate_hz > 0:
            raise ValueError(f"rate_hz: found {rate_hz}, expected a number above 0")
        chosen: set[int] = set()
        for indices in self.sequences.values():
            times = np.array([self[i].time_s for i in indices])
            wanted = times[0] + np.arange(math.floor((times[-1] - times[0]) * rate_hz + 1e-6) + 1) / rate_hz
            right = np.clip(np.searchsorted(times, wanted), 1, len(times) - 1) if len(times) > 1 else np.zeros(1, int)
            left = np.maximum(right - 1, 0)
            nearest = np.where(wanted - times[left] <= times[right] - wanted, left, right)
            chosen.update(indices[i] for i in nearest)
        return self._view([self._frames[i] for i in sorted(chosen)])

    def sample(
        self, count: int, *, seed: int = 0, weights: Callable[[Frame], float] | None = None, replacement: bool = False
    ) -> Dataset:
        """count frames at random; with weights, in proportion to them."""
        if count < 0 or (count > len(self) and not replacement) or (count and not len(self)):
            raise ValueError(f"count: found {count}, expected 0 to {len(self)} (more with replacement=True)")
        share = None
        if weights is not None:
            values = np.array([weights(frame) for frame in self], dtype=np.float64)
            if not (np.isfinite(values).all() and (values >= 0).all() and values.sum() > 0):
                raise ValueError("weights: expected finite numbers from 0, not all 0")
            share = values / values.sum()
        chosen = np.random.default_rng(seed).choice(len(self), size=count, replace=replacement, p=share)
        return self._view([self._frames[i] for i in chosen])

    # Other forms.

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row per annotation."""
        pandas = require("pandas", "to_pandas()")
        columns: dict[str, list[Any]] = {}
        for frame in self:
            for name, values in _rows(frame).items():
                columns.setdefault(name, []).extend(values)
        return pandas.DataFrame(columns)

    def to_coco(self) -> dict[str, Any]:
        """A COCO dictionary of these frames, filters applied and ids made unique, as pycocotools reads it."""
        images: list[dict[str, Any]] = []
        annotations: list[dict[str, Any]] = []
        for frame in self:
            images.append({**frame.record, "id": frame.id})
            for record, track in zip(frame.annotations.records, frame.annotations.track_ids):
                annotations.append({**record, "id": len(annotations) + 1, "image_id": frame.id, "track_id": int(track)})
        categories = {c["id"]: c for source in self._sources for c in source.labels.categories}
        return {
            "info": {"description": self.name, "version": "1"},
            "licenses": [{"id": 1, "name": "CC0-1.0", "url": "https://creativecommons.org/publicdomain/zero/1.0/"}],
            "categories": list(categories.values()),
            "images": images,
            "annotations": annotations,
        }

    def verify(self, *, complete: bool = True) -> None:
        """Reads every file and compares size and SHA-256 with the manifest; DatasetError with the first difference.

        complete=False lets files be missing, as in an archive that was downloaded in part. `throng validate` checks
        more.
        """
        for source in self._sources:
            verify_files(source.storage, source.manifest.get("files"), complete=complete)

    def show(self, index: int = 0, **options: Any) -> Any:
        """Draws a frame with its annotations; see throng.show."""
        from .plotting import show

        return show(self[index], **options)

    def _merged_with(self, others: Sequence[Dataset]) -> Dataset:
        merged = copy.copy(self)
        merged._sources, merged._frames = [], []
        images = tracks = 0
        for dataset in (self, *others):
            if dataset._keep != self._keep:
                raise ValueError(
                    "datasets: found different annotation filters, expected equal ones: filter after merging"
                )
            used = {index[0] for index in dataset._frames}
            number_of: dict[int, int] = {}
            for i, original in enumerate(dataset._sources):
                if i not in used:
                    continue
                source = copy.copy(original)
                labels = source.labels
                source.image_offset, source.track_offset = images, tracks
                source.prefix = f"{len(merged._sources)}:"
                images += max((int(image["id"]) for image in labels.images), default=0)
                highest = max(labels.tracks, default=0)
                tracks += (highest // _RUN_TRACKS + 1) * _RUN_TRACKS
                number_of[i] = len(merged._sources)
                merged._sources.append(source)
            merged._frames += [(number_of[source], image) for source, image in dataset._frames]
        return merged


def merge(datasets: Sequence[Dataset]) -> Dataset:
    """One dataset of several; image and track ids are kept apart."""
    if not datasets:
        raise ValueError("datasets: found none, expected at least one")
    return datasets[0] if len(datasets) == 1 else datasets[0]._merged_with(datasets[1:])


def _listed_frames(source: Source, names: Sequence[str], where: str) -> list[tuple[int, int]]:
    numbers = {str(image.get("file_name")): i for i, image in enumerate(source.labels.images)}
    for name in names:
        if name not in numbers:
            raise DatasetError(f"{where}: found the frame {name!r}, expected one of {source.path}")
    return [(0, numbers[name]) for name in names]


def _part_sizes(count: int, shares: Mapping[str, float]) -> dict[str, int]:
    """Largest remainders; every share above 0 gets at least one."""
    sizes = {name: max(int(share * count + 1e-9), 1 if share > 0 else 0) for name, share in shares.items()}
    limit = min(count, round(math.fsum(shares.values()) * count))
    limit = max(limit, sum(share > 0 for share in shares.values()))
    while sum(sizes.values()) > limit:
        sizes[max(sizes, key=lambda name: sizes[name] - shares[name] * count)] -= 1
    while sum(sizes.values()) < limit:
        sizes[max(sizes, key=lambda name: shares[name] * count - sizes[name])] += 1
    return sizes


def _rows(frame: Frame) -> dict[str, Any]:
    """Columns of to_pandas() of one frame."""
    a = frame.annotations
    count = len(a)
    same = {
        "image_id": frame.id,
        "sequence": frame.sequence,
        "run": frame.run,
        "camera_id": frame.camera_id,
        "frame": frame.index,
        "time_s": frame.time_s,
    }
    return {
        **{name: [value] * count for name, value in same.items()},
        "track_id": a.track_ids,
        "category": [NAMES.get(category, str(category)) for category in a.category_ids.tolist()],
        **dict(zip(("x", "y", "width", "height"), a.boxes.T)),
        "area_px": a.areas,
        "visibility": a.visibility,
        **dict(zip(("world_x_m", "world_y_m", "world_z_m"), a.positions.T)),
        **dict(zip(("vx_mps", "vy_mps"), a.velocities.T)),
        "heading_rad": a.headings,
        "state": a.states,
        "exit": a.exits,
    }


__all__ = ["Dataset", "merge"]
