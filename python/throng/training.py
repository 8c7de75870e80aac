"""Map-style datasets for training, as torch.utils.data.DataLoader takes them.

They are sequences: ds[i] gives (image, target). With torch installed, arrays are tensors; without it, or with
tensors=False, NumPy arrays of the same shapes and types. Images are (3, height, width) float32 from 0 to 1. Boxes are
x0, y0, x1, y1 in pixels, as torchvision's detection models take them; `collate` joins samples to batches for these.
"""

from __future__ import annotations

import math
from typing import Any, Callable, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from ._optional import available
from .annotations import Annotations
from .dataset import Dataset
from .frame import Frame

Sample = tuple[Any, dict[str, Any]]
Transform = Callable[[Any, dict[str, Any]], Sample]


class _FrameDataset(Sequence[Sample]):
    """transform gets and gives (image, target)."""

    def __init__(self, dataset: Dataset, *, transform: Transform | None = None, tensors: bool | None = None) -> None:
        self.dataset = dataset
        self.transform = transform
        self.tensors = available("torch") is not None if tensors is None else tensors

    def __len__(self) -> int:
        return len(self.dataset)

    def __getitem__(self, index: Any) -> Any:
        frame: Frame = self.dataset[int(index)]
        image = np.ascontiguousarray(frame.image().transpose(2, 0, 1), dtype=np.float32) / np.float32(255)
        target: dict[str, Any] = {"image_id": np.int64(frame.id)}
        target.update(self._target(frame, frame.people))
        return _finish(image, target, self.tensors, self.transform)

    def _target(self, frame: Frame, people: Annotations) -> dict[str, Any]:
        raise NotImplementedError


def _detection(people: Annotations) -> dict[str, Any]:
    return {
        "boxes": people.boxes_xyxy.astype(np.float32),
        "labels": people.category_ids,
        "area": people.areas.astype(np.float32),
        "iscrowd": people.is_crowd.astype(np.int64),
    }


class DetectionDataset(_FrameDataset):
    """Targets: boxes (N, 4), labels (N,), area, iscrowd, image_id. amodal=True: boxes of whole bodies."""

    def __init__(
        self, dataset: Dataset, *, amodal: bool = False, transform: Transform | None = None, tensors: bool | None = None
    ) -> None:
        super().__init__(dataset, transform=transform, tensors=tensors)
        self.amodal = amodal

    def _target(self, frame: Frame, people: Annotations) -> dict[str, Any]:
        target = _detection(people)
        if self.amodal:
            boxes = people.boxes_amodal
            target["boxes"] = np.concatenate((boxes[:, :2], boxes[:, :2] + boxes[:, 2:]), axis=1).astype(np.float32)
        return target


class SegmentationDataset(_FrameDataset):
    """Targets of DetectionDataset and masks (N, height, width) uint8."""

    def _target(self, frame: Frame, people: Annotations) -> dict[str, Any]:
        return {**_detection(people), "masks": people.masks().astype(np.uint8)}


class KeypointDataset(_FrameDataset):
    """Targets of DetectionDataset and keypoints (N, 17, 3): x, y, visibility."""

    def _target(self, frame: Frame, people: Annotations) -> dict[str, Any]:
        return {**_detection(people), "keypoints": people.keypoints.astype(np.float32)}


class CountingDataset(_FrameDataset):
    """Targets: density (1, height, width), points (N, 2) heads in the image, count.

    The density is that of the dataset's files where it has them and no filter is set, else Gaussians of sigma_px at the
    heads, each of which sums to 1 in the image.
    """

    def __init__(
        self,
        dataset: Dataset,
        *,
        sigma_px: float = 4.0,
        transform: Transform | None = None,
        tensors: bool | None = None,
    ) -> None:
        super().__init__(dataset, transform=transform, tensors=tensors)
        if not sigma_px > 0:
            raise ValueError(f"sigma_px: found {sigma_px}, expected a number above 0")
        self.sigma_px = sigma_px

    def _target(self, frame: Frame, people: Annotations) -> dict[str, Any]:
        heads = people.heads
        with np.errstate(invalid="ignore"):
            inside = (heads >= 0).all(axis=1) & (heads[:, 0] < frame.width) & (heads[:, 1] < frame.height)
        points = heads[inside]
        if self.dataset._keep is None and frame.has("density"):
            density = frame.density()
        else:
            density = density_map(points, frame.height, frame.width, self.sigma_px)
        return {"density": density[None], "points": points.astype(np.float32), "count": np.float32(len(points))}


class TrackingDataset(Sequence[dict[str, Any]]):
    """Clips of consecutive frames of one camera.

    Samples: images (length, 3, height, width), or None with images=False; frames: a list of targets with boxes, labels,
    track_ids and time_s; sequence. stride is the distance of two clips' first frames (default: length, no overlap).
    """

    def __init__(
        self,
        dataset: Dataset,
        *,
        length: int = 8,
        stride: int | None = None,
        images: bool = True,
        tensors: bool | None = None,
    ) -> None:
        if length < 1 or (stride is not None and stride < 1):
            raise ValueError(f"length, stride: found {length}, {stride}, expected 1 or more")
        self.dataset = dataset
        self.images = images
        self.tensors = available("torch") is not None if tensors is None else tensors
        self._clips = [
            (name, indices[i : i + length])
            for name, indices in dataset.sequences.items()
            for i in range(0, len(indices) - length + 1, stride or length)
        ]

    def __len__(self) -> int:
        return len(self._clips)

    def __getitem__(self, index: Any) -> Any:
        name, indices = self._clips[int(index)]
        frames: list[Frame] = [self.dataset[i] for i in indices]
        targets: list[dict[str, Any]] = []
        for frame in frames:
            people = frame.people
            target = {
                **_detection(people),
                "track_ids": people.track_ids,
                "image_id": np.int64(frame.id),
                "time_s": np.float64(frame.time_s),
            }
            targets.append(_finish(None, target, self.tensors, None)[1])
        images: Any = None
        if self.images:
            images = np.stack([frame.image().transpose(2, 0, 1) for frame in frames]).astype(np.float32) / np.float32(
                255
            )
            images = _finish(images, {}, self.tensors, None)[0]
        return {"images": images, "frames": targets, "sequence": name}


def collate(samples: Iterable[Sample]) -> tuple[list[Any], list[dict[str, Any]]]:
    """Joins samples whose targets differ in length: collate_fn of DataLoader for torchvision's detection models."""
    images: list[Any] = []
    targets: list[dict[str, Any]] = []
    for image, target in samples:
        images.append(image)
        targets.append(target)
    return images, targets


def density_map(points: NDArray[Any], height: int, width: int, sigma_px: float) -> NDArray[np.float32]:
    """People per pixel of points (N, 2) in box coordinates: Gaussians cut off at 4 sigma and at the borders, sum 1
    each."""
    out = np.zeros((height, width), dtype=np.float64)
    reach = 4 * sigma_px
    for x, y in np.asarray(points, dtype=np.float64):
        x0, x1 = max(0, math.floor(x - reach)), min(width, math.ceil(x + reach))
        y0, y1 = max(0, math.floor(y - reach)), min(height, math.ceil(y + reach))
        if x0 >= x1 or y0 >= y1:
            continue
        dx, dy = np.arange(x0, x1) + 0.5 - x, np.arange(y0, y1) + 0.5 - y
        kernel = np.exp(-(dy[:, None] ** 2 + dx**2) / (2 * sigma_px**2))
        kernel *= (np.abs(dy)[:, None] <= reach) & (np.abs(dx) <= reach)
        if kernel.sum() > 0:
            out[y0:y1, x0:x1] += kernel / kernel.sum()
    return out.astype(np.float32)


def _finish(image: Any, target: dict[str, Any], tensors: bool, transform: Transform | None) -> Sample:
    if tensors:
        torch = available("torch")
        image = None if image is None else torch.from_numpy(image)
        target = {name: torch.as_tensor(np.array(value)) for name, value in target.items()}
    return transform(image, target) if transform is not None else (image, target)
