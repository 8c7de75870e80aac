"""Contents of requests: bundles of scenarios, JSON, paths."""

from __future__ import annotations

import io
import json
import os
import zipfile
from pathlib import Path
from typing import Any, Union

from ._http import part
from .errors import NotFoundError

PathLike = Union[str, "os.PathLike[str]"]


def bundle(path: PathLike) -> bytes:
    """The zip of a folder, without hidden files; the bytes of an archive as they are."""
    source = Path(path)
    if source.is_file():
        return source.read_bytes()
    if not source.is_dir():
        raise FileNotFoundError(f"{source}: found nothing there, expected a folder or an archive of scenarios")
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(source.rglob("*")):
            name = file.relative_to(source)
            if file.is_file() and not file.is_symlink() and not any(p.startswith(".") for p in name.parts):
                archive.write(file, name.as_posix())
    return out.getvalue()


def json_bytes(value: Any) -> bytes:
    return json.dumps(value, allow_nan=False).encode()


def path_of(name: str) -> str:
    segments = name.split("/")
    if "" in segments or "." in segments or ".." in segments:
        raise NotFoundError(404, "Not Found", f"{name!r} is not a plain relative path")
    return "/".join(part(segment) for segment in segments)
