"""Files of jobs, and the presets that come with throng."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

from .errors import DatasetError


def read_job(path: Path) -> dict[str, Any]:
    """Errors: DatasetError where the file holds no JSON object."""
    try:
        value = json.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError) as error:
        raise DatasetError(f"{path}: found no JSON that can be read ({error}), expected a job") from None
    if not isinstance(value, dict):
        raise DatasetError(f"{path}: found {type(value).__name__}, expected a job, which is an object")
    return value


def preset_path(name: str) -> Path:
    """The file of a preset, "detection", in $THRONG_SCENARIOS, in the source tree or where throng is installed.

    Errors: DatasetError where there is none of this name.
    """
    folders = [Path(os.environ["THRONG_SCENARIOS"])] if os.environ.get("THRONG_SCENARIOS") else []
    folders += [Path(__file__).parents[2] / "scenarios", Path(sys.prefix) / "share/throng/scenarios"]
    for folder in folders:
        path = folder / f"presets/{name}.job.json"
        if path.is_file():
            return path
    raise DatasetError(f"found no presets/{name}.job.json in {', '.join(map(str, folders))}, expected a preset")
