"""Imports of optional packages, where they are used."""

from __future__ import annotations

import importlib
from typing import Any

from .errors import MissingPackageError

# Module: (Debian package, pip package).
_PACKAGES = {
    "h5py": ("python3-h5py", "h5py"),
    "matplotlib": ("python3-matplotlib", "matplotlib"),
    "pandas": ("python3-pandas", "pandas"),
    "PIL": ("python3-pil", "Pillow"),
    "scipy": ("python3-scipy", "scipy"),
    "shapely": ("python3-shapely", "shapely"),
    "torch": ("python3-torch", "torch"),
    "torchvision": ("python3-torchvision", "torchvision"),
    "ultralytics": ("", "ultralytics"),
}


def require(module: str, purpose: str) -> Any:
    """The module, for example "matplotlib.pyplot"; purpose completes "... needs the package"."""
    package = module.split(".")[0]
    try:
        return importlib.import_module(module)
    except ImportError as error:
        if error.name is not None and error.name.split(".")[0] != package:
            raise
        debian, pip = _PACKAGES[package]
        by_debian = f"apt-get install {debian} (Debian) or " if debian else ""
        raise MissingPackageError(
            f"{purpose} needs the package {package}, which is not installed: {by_debian}pip install {pip}"
        ) from error


def available(module: str) -> Any:
    """The module, or None where it is not installed."""
    try:
        return importlib.import_module(module)
    except ImportError:
        return None
