"""The networks that can be trained, by name: each is a torch module with loss(images, people) and detect(images) or, of counters,
a density of people per cell."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from .._optional import available, require
from . import networks

torch = require("torch", "throng.train")


class Torchvision(networks.Module):  # type: ignore[misc]
    """torchvision's Faster R-CNN on MobileNet v3, from scratch: nothing is downloaded. width is not used."""

    def __init__(self, width: int) -> None:
        super().__init__()
        detection = require("torchvision.models.detection", "--network torchvision")
        self.model = detection.fasterrcnn_mobilenet_v3_large_fpn(
            weights=None, weights_backbone=None, num_classes=2, min_size=64, max_size=4096, box_detections_per_img=500
        )
        # Images keep their size, which the scales of tiles and of tests set.
        self.model.transform.resize = lambda image, target=None: (image, target)

    def loss(self, images: Any, people: list[Any]) -> Any:
        targets = [
            {"boxes": boxes, "labels": torch.ones(len(boxes), dtype=torch.int64, device=boxes.device)}
            for boxes in (_asked(each) for each in people)
        ]
        return sum(self.model(list(images), targets).values())

    def detect(self, images: Any) -> list[Any]:
        return [(found["boxes"], found["scores"]) for found in self.model(list(images))]


class Ultralytics(networks.Module):  # type: ignore[misc]
    """Ultralytics' YOLOv8n from its configuration, from scratch. width is not used."""

    def __init__(self, width: int) -> None:
        super().__init__()
        tasks = require("ultralytics.nn.tasks", "--network ultralytics")
        self.model = tasks.DetectionModel("yolov8n.yaml", nc=1, verbose=False)
        self.model.args = SimpleNamespace(box=7.5, cls=0.5, dfl=1.5)

    def loss(self, images: Any, people: list[Any]) -> Any:
        people = [_asked(each) for each in people]
        boxes = torch.cat(people)
        middles = torch.cat(((boxes[:, :2] + boxes[:, 2:]) / 2, boxes[:, 2:] - boxes[:, :2]), 1)
        owners = torch.cat([torch.full((len(each),), float(i)) for i, each in enumerate(people)])
        batch = {
            "img": images,
            "bboxes": middles / images.shape[-1],
            "cls": torch.zeros(len(boxes), 1),
            "batch_idx": owners,
        }
        return self.model.loss(batch)[0].sum() / len(images)

    def detect(self, images: Any) -> list[Any]:
        outputs = self.model(images)[0]
        corners = torch.cat((outputs[:, :2] - outputs[:, 2:4] / 2, outputs[:, :2] + outputs[:, 2:4] / 2), 1)
        found = []
        for boxes, scores in zip(corners, outputs[:, 4]):
            scores, at = scores.topk(min(500, len(scores)))
            found.append((boxes[:, at].T, scores))
        return found


def _asked(people: Any) -> Any:
    """Boxes (N, 4) of the people who are to be found; these networks cannot leave out regions."""
    boxes = people[people[:, 4] > 0, :4]
    return boxes[((boxes[:, 2:] - boxes[:, :2]) > 1).all(1)]


DETECTORS: dict[str, Callable[[int], Any]] = {
    "small": networks.Detector,
    "torchvision": Torchvision,
    "ultralytics": Ultralytics,
}


def make(network: str, task: str, width: int) -> Any:
    """A new network for the task "detect" or "count"; counters are all of the kind "small"."""
    return networks.Counter(width) if task == "count" else DETECTORS[network](width)


def best_available() -> str:
    """The network of `--network auto`: an installed library's network where a GPU can train it, else the small one."""
    if torch.cuda.is_available():
        for name, module in (("ultralytics", "ultralytics"), ("torchvision", "torchvision.models.detection")):
            if available(module) is not None:
                return name
    return "small"
