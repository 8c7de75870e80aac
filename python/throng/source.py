"""One dataset on disk: its storage, labels and the files that say what it is."""

from __future__ import annotations

import hashlib
import json
from functools import cached_property
from typing import Any, Mapping

from ._labels import LabelFile
from .errors import DatasetError
from .storage import Storage, open_storage

_MAX_JSON_BYTES = 1 << 30


class Source:
    """Offsets keep the ids of merged datasets apart; they are 0 for a dataset of its own."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.storage = open_storage(path)
        self.labels = LabelFile(self.storage)
        self.image_offset = 0
        self.track_offset = 0
        self.prefix = ""

    def json(self, name: str) -> Any:
        """A JSON file of the dataset."""
        data = self.storage.read(name)
        if len(data) > _MAX_JSON_BYTES:
            raise self.storage.too_large(name, len(data), _MAX_JSON_BYTES)
        try:
            return json.loads(data)
        except (ValueError, RecursionError) as error:
            raise DatasetError(f"{self.storage.where(name)}: found no valid JSON: {error}") from error

    def object(self, name: str) -> Mapping[str, Any]:
        value = self.json(name)
        if not isinstance(value, dict):
            raise DatasetError(f"{self.storage.where(name)}: found {type(value).__name__}, expected an object")
        return value

    @cached_property
    def description(self) -> Mapping[str, Any]:
        """dataset.json; {} where an archive was made without it."""
        return self.object("dataset.json") if self.storage.exists("dataset.json") else {}

    @cached_property
    def manifest(self) -> Mapping[str, Any]:
        return self.object("manifest.json")

    @property
    def splits(self) -> Mapping[str, list[str]]:
        """Names of runs by split."""
        splits = self.description.get("splits", {})
        if not isinstance(splits, dict) or not all(isinstance(runs, list) for runs in splits.values()):
            raise DatasetError(f"{self.storage.where('dataset.json')}: /splits: expected an object of lists")
        return splits

    def split_of(self, run: str) -> str | None:
        for name, runs in self.splits.items():
            if run in runs:
                return name
        return None


def verify_files(storage: Storage, files: Any, *, complete: bool) -> None:
    """Compares every file with the size and SHA-256 that the manifest's `files` say."""
    where = storage.where("manifest.json")
    if not isinstance(files, list):
        raise DatasetError(f"{where}: /files: expected a list")
    for i, entry in enumerate(files):
        try:
            name, size, digest = str(entry["path"]), int(entry["bytes"]), str(entry["sha256"])
        except (TypeError, KeyError, ValueError):
            raise DatasetError(f"{where}: /files/{i}: expected path, bytes and sha256") from None
        if not storage.exists(name):
            if complete:
                raise storage.missing(name)
            continue
        data = storage.read(name)
        if len(data) != size or hashlib.sha256(data).hexdigest() != digest:
            raise DatasetError(
                f"{storage.where(name)}: found {len(data)} bytes with another SHA-256 than the manifest "
                f"says, expected {size}"
            )
