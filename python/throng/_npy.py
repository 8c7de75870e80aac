"""NumPy files of a dataset."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import DatasetError
from .source import Source


def read_npy(source: Source, name: str, shape: tuple[Any, ...]) -> NDArray[np.float32]:
    """A NumPy file of the dataset, of this shape."""
    try:
        values: NDArray[np.float32] = np.load(io.BytesIO(source.storage.read(name)), allow_pickle=False)
    except (ValueError, OSError, EOFError) as error:
        if isinstance(error, DatasetError):
            raise
        raise DatasetError(f"{source.storage.where(name)}: found no whole NumPy file ({error})") from error
    if values.shape != shape:
        raise DatasetError(f"{source.storage.where(name)}: found the shape {values.shape}, expected {shape}")
    return values
