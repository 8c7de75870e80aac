"""Downloads that go on where they broke off, checked by the manifest's hashes."""

from __future__ import annotations

import json
import os
import re
import time
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Callable, Iterator, Mapping

from ._http import BROKEN, Http, pauses, what
from .errors import ConnectionFailedError, DatasetError, OutputFileError, ServiceError
from .source import verify_files
from .storage import open_storage

_CHUNK = 1 << 20
_MAX_MANIFEST_BYTES = 1 << 30
Report = Callable[[int, int], None]


def file_name_from(headers: Mapping[str, str], fallback: str) -> str:
    """The name that the service proposes, without anything that could lead to another folder."""
    match = re.search(r'filename="([^"]*)"', headers.get("Content-Disposition", ""))
    name = os.path.basename(match[1].replace("\\", "/")) if match else ""
    return name if name not in ("", ".", "..") and "\0" not in name and not name.startswith(".") else fallback


def check_output(path: Path, *, overwrite: bool) -> None:
    """Refuses a file that could not be written in the end, or that another program wrote, before anything is sent."""
    folder = path.parent
    if not folder.is_dir():
        raise OutputFileError(f"{folder}: found no such folder, expected one for {path.name}")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise OutputFileError(f"{folder}: found a folder that cannot be written to, expected one for {path.name}")
    part_file, note = _partial_files(path)
    others = [path] if note.exists() else [path, part_file]
    for other in others:
        if not overwrite and os.path.lexists(other):
            raise OutputFileError(f"{other}: found a file that is there already, expected a new one, or overwrite=True")


def _partial_files(path: Path) -> tuple[Path, Path]:
    """The part of a download, and the note on what it is a part of."""
    return Path(f"{path}.part"), Path(f"{path}.part.json")


def fetch(http: Http, target: str, path: Path, report: Report | None) -> None:
    """Writes the answer to GET target to path, by way of path.part, which a later call goes on with."""
    part_file, note = _partial_files(path)
    lost_since: float | None = None
    attempts = pauses()
    while True:
        have, tag = _state(part_file, note, target)
        headers = {"Range": f"bytes={have}-", "If-Range": tag} if have and tag else {}
        done = have
        try:
            with http.open("GET", target, headers=headers) as response:
                if response.status == 416:  # longer than what is there now, or exactly as long
                    length = response.headers.get("Content-Range", "").rpartition("/")[2]
                    if length.isdigit() and int(length) == have:
                        break
                    part_file.unlink(missing_ok=True)
                    continue
                if response.status not in (200, 206):
                    error = http.read_problem(response)
                    if response.status not in (502, 503, 504):
                        raise error
                    raise ConnectionFailedError(str(error))
                if response.status == 206:
                    if not response.headers.get("Content-Range", "").startswith(f"bytes {have}-"):
                        raise ServiceError(206, "Wrong range", "the service sent another part of the file")
                else:
                    done = 0
                    with _writing(note):
                        note.write_text(
                            json.dumps({"etag": response.headers.get("ETag"), "target": target}), encoding="utf-8"
                        )
                total = done + int(response.headers.get("Content-Length") or 0)
                with _writing(part_file):
                    file = open(part_file, "ab" if response.status == 206 else "wb")
                with file:
                    while chunk := response.read(_CHUNK):
                        with _writing(part_file):
                            file.write(chunk)
                            file.flush()
                        done += len(chunk)
                        if report is not None:
                            report(done, total)
                if done == total:
                    break
                raise ConnectionFailedError(f"{http.url}: the connection ended after {done} of {total} bytes")
        except OutputFileError:  # no fault of the connection: another attempt would not help
            raise
        except (*BROKEN, ConnectionFailedError) as error:
            if http.is_not_there(error):
                raise ConnectionFailedError(f"{http.url}: {what(error)}") from error
            if done > have:
                lost_since, attempts = None, pauses()
            lost_since = time.monotonic() if lost_since is None else lost_since
            if time.monotonic() - lost_since > http.patience_s:
                raise ConnectionFailedError(f"{http.url}: {error}; the same call goes on where it broke off") from error
            time.sleep(next(attempts))
    with _writing(path):
        os.replace(part_file, path)
    note.unlink(missing_ok=True)


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    """Errors of files apart from those of connections, which are of the same kind."""
    try:
        yield
    except OSError as error:
        raise OutputFileError(f"{path}: cannot be written: {error.strerror or error}") from error


def _state(part_file: Path, note: Path, target: str) -> tuple[int, str | None]:
    """How much is there, and the tag of what it is a part of."""
    try:
        known = json.loads(note.read_text(encoding="utf-8"))
        if known["target"] == target and isinstance(known["etag"], str):
            return part_file.stat().st_size, known["etag"]
    except (OSError, ValueError, KeyError, TypeError):
        pass
    return 0, None


def check(path: Path, *, complete: bool) -> None:
    """Compares every file of an archive with the manifest in it; removes the archive if one differs."""
    try:
        with closing(open_storage(path, "manifest.json")) as storage:
            manifest = json.loads(storage.read("manifest.json", _MAX_MANIFEST_BYTES))
            verify_files(storage, manifest.get("files") if isinstance(manifest, dict) else None, complete=complete)
    except (DatasetError, ValueError) as error:
        path.unlink(missing_ok=True)
        raise DatasetError(f"{path}: the download is damaged and was removed: {error}") from error
