"""throng: read synthetic crowd datasets, order them from the service, simulate evacuations in code.

    import throng

    dataset = throng.Dataset("dataset.tar")
    frame = dataset[0]
    frame.image(), frame.people.boxes, frame.people.masks(), frame.camera.project(frame.people.positions)
"""

from __future__ import annotations

from .annotations import Annotations
from .camera import Camera
from .dataset import Dataset, merge
from .errors import (DatasetError, MissingPackageError, ProgramError, ScenarioError, ThrongError, TraceError)
from .frame import Frame
from .plotting import animate, show
from .tables import Table
from .trace import Trace
from .training import (CountingDataset, DetectionDataset, KeypointDataset, SegmentationDataset, TrackingDataset, collate)

__version__ = "0.1.0"

__all__ = [
    "Annotations", "Camera", "CountingDataset", "Dataset", "DatasetError", "DetectionDataset", "Frame", "KeypointDataset",
    "MissingPackageError", "ProgramError", "ScenarioError", "SegmentationDataset", "Table", "ThrongError", "Trace",
    "TraceError", "TrackingDataset", "animate", "collate", "merge", "show",
]
