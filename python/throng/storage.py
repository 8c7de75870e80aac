"""Files of a dataset, read from a folder, a tar file or a zip file without unpacking.

Names are paths below the dataset's root with "/" between their parts. Nothing is ever written. Names that leave the
root, links that leave the archive, members that are there twice and sizes that cannot be true are refused.
"""

from __future__ import annotations

import mmap
import os
import stat
import struct
import tarfile
import threading
import zipfile
import zlib
from dataclasses import dataclass
from typing import Iterable, Union

from .errors import DatasetError

LABELS_FILE = "annotations/instances.json"
# A deflated member that grows to more than this is refused where it grows more than _MAX_RATIO times.
_LARGE_BYTES = 64 << 20
_MAX_RATIO = 200
# Windows changes line ends of files that are not opened as binary; elsewhere a named pipe must not block. Python keeps
# descriptors from child processes by itself.
_OPEN_FLAGS = os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0)
_SEEKING = threading.Lock()

Buffer = Union[bytes, "mmap.mmap"]


def check_name(name: str, where: str) -> str:
    """The name in its plain form; DatasetError if it is absolute or leaves the dataset."""
    parts = [part for part in name.split("/") if part not in ("", ".")]
    if name.startswith("/") or ".." in parts or "\0" in name or "\\" in name or not parts:
        raise DatasetError(f"{where}: found the path {name!r}, expected one below the dataset's root")
    return "/".join(parts)


class Storage:
    """Base class. Reading is safe in several threads and in processes that were forked or got a pickled copy."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.root = ""

    def names(self) -> Iterable[str]:
        """All files, relative to the root."""
        raise NotImplementedError

    def exists(self, name: str) -> bool:
        raise NotImplementedError

    def map(self, name: str) -> tuple[Buffer, int, int]:
        """A buffer that holds the file from the first offset to the second; not a copy where that can be."""
        raise NotImplementedError

    def read(self, name: str, max_bytes: int | None = None) -> bytes:
        """The file's bytes. Larger files than max_bytes are refused before they are read."""
        raise NotImplementedError

    def close(self) -> None:
        """Lets go of an archive's file, which Windows cannot remove before; the next reading opens it again."""

    def where(self, name: str) -> str:
        """How messages name the file."""
        return f"{self.path}: {self.root}{name}"

    def missing(self, name: str) -> DatasetError:
        return DatasetError(f"{self.where(name)}: found no such file, expected one")

    def too_large(self, name: str, size: int, limit: int) -> DatasetError:
        return DatasetError(f"{self.where(name)}: found {size} bytes, expected {limit} at most")


class FolderStorage(Storage):
    def names(self) -> Iterable[str]:
        base = os.path.join(self.path, self.root)
        for folder, folders, files in os.walk(base):
            folders.sort()
            for file in sorted(files):
                yield os.path.relpath(os.path.join(folder, file), base).replace(os.sep, "/")

    def _full(self, name: str) -> str:
        return os.path.join(self.path, self.root, check_name(name, self.path))

    def where(self, name: str) -> str:
        return os.path.join(self.path, self.root, name)

    def exists(self, name: str) -> bool:
        return os.path.isfile(self._full(name))

    def _open(self, name: str) -> tuple[int, int]:
        try:
            file = os.open(self._full(name), _OPEN_FLAGS)
        except FileNotFoundError:
            raise self.missing(name) from None
        except OSError as error:
            raise DatasetError(f"{self.where(name)}: cannot be read: {error.strerror}") from error
        status = os.fstat(file)
        if not stat.S_ISREG(status.st_mode):
            os.close(file)
            raise DatasetError(f"{self.where(name)}: found a folder, pipe or device, expected a file")
        return file, status.st_size

    def map(self, name: str) -> tuple[Buffer, int, int]:
        file, size = self._open(name)
        try:
            if size == 0:
                return b"", 0, 0
            return mmap.mmap(file, size, access=mmap.ACCESS_READ), 0, size
        finally:
            os.close(file)

    def read(self, name: str, max_bytes: int | None = None) -> bytes:
        file, size = self._open(name)
        try:
            if max_bytes is not None and size > max_bytes:
                raise self.too_large(name, size, max_bytes)
            return _read_at(file, 0, size, self.where(name))
        finally:
            os.close(file)


@dataclass(frozen=True)
class _Member:
    offset: int  # of the data, or for zip files of the local header
    size: int  # as it is unpacked
    packed: int  # as it is in the archive
    deflated: bool = False
    crc: int | None = None


class _ArchiveStorage(Storage):
    """Members whose bytes lie in the archive in one piece."""

    def __init__(self, path: str) -> None:
        super().__init__(path)
        self._members: dict[str, _Member] = {}
        self._lock = threading.Lock()
        self._file: int | None = None
        self._map: mmap.mmap | None = None
        self._index()

    def __getstate__(self) -> dict[str, object]:
        state = self.__dict__.copy()
        state.update(_lock=None, _file=None, _map=None)
        return state

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state)
        self._lock = threading.Lock()

    def __del__(self) -> None:
        self.close()

    def close(self) -> None:
        file = getattr(self, "_file", None)
        self._file = self._map = None
        if file is not None:
            os.close(file)

    def _index(self) -> None:
        raise NotImplementedError

    def _data_offset(self, name: str, member: _Member) -> int:
        return member.offset

    def _descriptor(self) -> int:
        with self._lock:
            if self._file is None:
                self._file = os.open(self.path, _OPEN_FLAGS)
            return self._file

    def _add(self, name: str, member: _Member) -> None:
        plain = check_name(name, self.path)
        if plain in self._members:
            raise DatasetError(f"{self.path}: found the member {plain!r} twice, expected it once")
        self._members[plain] = member

    def names(self) -> Iterable[str]:
        return [name[len(self.root) :] for name in self._members if name.startswith(self.root)]

    def exists(self, name: str) -> bool:
        return self.root + check_name(name, self.path) in self._members

    def _member(self, name: str) -> _Member:
        try:
            return self._members[self.root + check_name(name, self.path)]
        except KeyError:
            raise self.missing(name) from None

    def map(self, name: str) -> tuple[Buffer, int, int]:
        member = self._member(name)
        if member.deflated or member.size == 0:
            return (data := self.read(name)), 0, len(data)
        start = self._data_offset(name, member)
        file = self._descriptor()
        with self._lock:
            if self._map is None:
                self._map = mmap.mmap(file, 0, access=mmap.ACCESS_READ)
        if start + member.size > len(self._map):
            raise DatasetError(f"{self.where(name)}: found the archive's end within it, expected {member.size} bytes")
        return self._map, start, start + member.size

    def read(self, name: str, max_bytes: int | None = None) -> bytes:
        member = self._member(name)
        if max_bytes is not None and member.size > max_bytes:
            raise self.too_large(name, member.size, max_bytes)
        if max_bytes is None and member.size > max(_LARGE_BYTES, _MAX_RATIO * member.packed):
            raise DatasetError(
                f"{self.where(name)}: found {member.packed} bytes that would unpack to {member.size}, "
                f"expected {_MAX_RATIO} times as many at most"
            )
        start = self._data_offset(name, member)
        data = _read_at(self._descriptor(), start, member.packed, self.where(name))
        if member.deflated:
            data = _inflate(data, member.size, self.where(name))
        if member.crc is not None and zlib.crc32(data) != member.crc:
            raise DatasetError(f"{self.where(name)}: found other bytes than its checksum (CRC-32) says")
        return data


class TarStorage(_ArchiveStorage):
    """An uncompressed tar file; hard links within it are followed, as throng's archives have them."""

    def _index(self) -> None:
        size = os.path.getsize(self.path)
        links: list[tuple[str, str]] = []
        try:
            with tarfile.open(self.path, "r:", encoding="utf-8") as archive:
                for entry in archive:
                    name = check_name(entry.name, self.path) if entry.name.strip("./") else ""
                    if entry.isdir() or not name:
                        continue
                    if entry.islnk():
                        links.append((name, check_name(entry.linkname, self.path)))
                    elif entry.isreg() and not entry.issparse():
                        if entry.size < 0 or entry.offset_data + entry.size > size:
                            raise DatasetError(
                                f"{self.path}: {name}: found the archive's end within it, expected "
                                f"{entry.size} bytes: it is cut off"
                            )
                        self._add(name, _Member(entry.offset_data, entry.size, entry.size))
                    else:
                        raise DatasetError(
                            f"{self.path}: {name}: found a symbolic link, a device or a sparse file, "
                            "expected a plain file"
                        )
                end = archive.offset
        except (tarfile.TarError, OSError, ValueError, EOFError) as error:
            if isinstance(error, DatasetError):
                raise
            raise DatasetError(
                f"{self.path}: found a damaged or cut off tar file ({error}), " "expected a whole, uncompressed one"
            ) from error
        with open(self.path, "rb") as file:
            file.seek(end)
            if file.read(512) != bytes(512):
                raise DatasetError(
                    f"{self.path}: found no end of the archive at byte {end} of {size}: it is cut off "
                    "or damaged there"
                )
        for name, target in links:
            if target not in self._members:
                raise DatasetError(f"{self.path}: {name}: found a link to {target!r}, expected an earlier member")
            self._add(name, self._members[target])


class ZipStorage(_ArchiveStorage):
    """A zip file, stored or deflated."""

    def _index(self) -> None:
        size = os.path.getsize(self.path)
        try:
            with zipfile.ZipFile(self.path) as archive:
                for entry in archive.infolist():
                    if entry.is_dir():
                        continue
                    if entry.flag_bits & 1:
                        raise DatasetError(f"{self.path}: {entry.filename}: found an encrypted member")
                    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                        raise DatasetError(
                            f"{self.path}: {entry.filename}: found the compression "
                            f"{entry.compress_type}, expected 0 (stored) or 8 (deflate)"
                        )
                    deflated = entry.compress_type == zipfile.ZIP_DEFLATED
                    if (
                        entry.header_offset < 0
                        or entry.header_offset + entry.compress_size > size
                        or (not deflated and entry.compress_size != entry.file_size)
                    ):
                        raise DatasetError(f"{self.path}: {entry.filename}: found sizes that cannot be true")
                    self._add(
                        entry.filename,
                        _Member(entry.header_offset, entry.file_size, entry.compress_size, deflated, entry.CRC),
                    )
        except (zipfile.BadZipFile, OSError, NotImplementedError, UnicodeError, struct.error) as error:
            raise DatasetError(
                f"{self.path}: found a damaged or cut off zip file ({error}), " "expected a whole one"
            ) from error

    def _data_offset(self, name: str, member: _Member) -> int:
        header = _read_at(self._descriptor(), member.offset, 30, self.where(name))
        if header[:4] != b"PK\3\4":
            raise DatasetError(f"{self.where(name)}: found no local header at byte {member.offset}")
        name_bytes, extra_bytes = struct.unpack("<HH", header[26:30])
        return member.offset + 30 + int(name_bytes) + int(extra_bytes)


def _read_part(file: int, size: int, offset: int) -> bytes:
    if hasattr(os, "pread"):
        return os.pread(file, size, offset)
    with _SEEKING:  # Windows has one position for all threads, and reads up to 2 GiB at once
        os.lseek(file, offset, os.SEEK_SET)
        return os.read(file, min(size, 1 << 30))


def _read_at(file: int, offset: int, size: int, where: str) -> bytes:
    parts: list[bytes] = []
    left = size
    while left > 0:
        try:
            part = _read_part(file, left, offset)
        except (OSError, OverflowError) as error:
            raise DatasetError(f"{where}: cannot be read at byte {offset}: {error}") from error
        if not part:
            raise DatasetError(f"{where}: found its end after {size - left} bytes, expected {size}")
        parts.append(part)
        offset += len(part)
        left -= len(part)
    return parts[0] if len(parts) == 1 else b"".join(parts)


def _inflate(data: bytes, size: int, where: str) -> bytes:
    inflater = zlib.decompressobj(-zlib.MAX_WBITS)
    try:
        out = inflater.decompress(data, size + 1)
    except zlib.error as error:
        raise DatasetError(f"{where}: found damaged compressed data ({error})") from error
    if len(out) != size:
        raise DatasetError(
            f"{where}: found {'more than ' if len(out) > size else ''}{min(len(out), size)} bytes, " f"expected {size}"
        )
    return out


def open_storage(path: str | os.PathLike[str], marker: str = LABELS_FILE) -> Storage:
    """The storage of a dataset at path. Its root is where the file `marker` is found, which may be a subfolder."""
    text = os.path.abspath(os.fspath(path))
    storage: Storage
    if os.path.isdir(text):
        storage = FolderStorage(text)
        roots = [root for root in ("", "dataset/") if storage.exists(root + marker)]
    elif os.path.isfile(text):
        with open(text, "rb") as file:
            head = file.read(4)
        if head[:2] == b"\x1f\x8b" or head[:3] in (b"BZh", b"\xfd7z"):
            raise DatasetError(
                f"{text}: found a compressed tar file, expected an uncompressed one, which can be read "
                "at any place: decompress it first (gunzip), or use zip"
            )
        archive = ZipStorage(text) if head[:2] == b"PK" else TarStorage(text)
        storage = archive
        roots = sorted(
            (name[: -len(marker)] for name in archive.names() if name == marker or name.endswith("/" + marker)),
            key=lambda root: root.count("/"),
        )
    elif os.path.exists(text):
        raise DatasetError(f"{text}: found a pipe or device, expected a folder, a .tar or a .zip file")
    else:
        raise DatasetError(f"{text}: found nothing there, expected a dataset: a folder, a .tar or a .zip file")
    if not roots:
        raise DatasetError(f"{text}: found no {marker}, expected a dataset of throng with it")
    storage.root = roots[0]
    return storage
