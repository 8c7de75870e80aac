"""throng: read synthetic crowd datasets, order them from the service, simulate evacuations in code.

    import throng

    dataset = throng.Dataset("dataset.tar")
    frame = dataset[0]
    frame.image(), frame.people.boxes, frame.people.masks(), frame.camera.project(frame.people.positions)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import engine, job, scores
from ._version import __version__
from .annotations import Annotations
from .camera import Camera
from .client import Client
from .dataset import Dataset, merge
from .errors import (
    AccessError,
    ConflictError,
    ConnectionFailedError,
    DatasetError,
    InvalidRequestError,
    JobFailedError,
    MissingPackageError,
    OutputFileError,
    Mistake,
    NotFoundError,
    ProgramError,
    ScenarioError,
    ServiceError,
    ThrongError,
    TraceError,
    UnavailableError,
)
from ._live import LiveFlight, LiveMessage, LiveImage, LiveState
from ._trajectories import Trajectories
from .frame import Frame
from .plotting import animate, show, show_labels
from .program import find_program, metrics, read_camera, run, simulate, study, validate_crowd
from .real_sets import REAL_SETS, open_real_set
from .scenario import Scenario
from .tables import Table
from .trace import Trace
from .training import CountingDataset, DetectionDataset, KeypointDataset, SegmentationDataset, TrackingDataset, collate

if TYPE_CHECKING:
    from .env import Env, VectorEnv

__all__ = [
    "__version__",
    "AccessError",
    "Annotations",
    "Camera",
    "Client",
    "ConflictError",
    "ConnectionFailedError",
    "CountingDataset",
    "Dataset",
    "DatasetError",
    "DetectionDataset",
    "Env",
    "Frame",
    "InvalidRequestError",
    "JobFailedError",
    "KeypointDataset",
    "LiveFlight",
    "LiveMessage",
    "LiveImage",
    "LiveState",
    "MissingPackageError",
    "OutputFileError",
    "Mistake",
    "NotFoundError",
    "ProgramError",
    "REAL_SETS",
    "Scenario",
    "ScenarioError",
    "SegmentationDataset",
    "ServiceError",
    "Table",
    "ThrongError",
    "Trace",
    "Trajectories",
    "TraceError",
    "TrackingDataset",
    "UnavailableError",
    "VectorEnv",
    "animate",
    "collate",
    "engine",
    "find_program",
    "read_camera",
    "job",
    "merge",
    "metrics",
    "open_real_set",
    "run",
    "scores",
    "show",
    "show_labels",
    "simulate",
    "study",
    "validate_crowd",
]


def __getattr__(name: str) -> Any:
    """Env and VectorEnv are imported when they are used: gymnasium, where it is installed, takes its time."""
    if name in ("Env", "VectorEnv"):
        return getattr(import_module(".env", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
