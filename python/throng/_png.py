"""A reader of PNG images for label values: gray and RGB of 8 or 16 bits, not interlaced.

Pillow reduces RGB of 16 bits, as flow has it, to 8. Label files of throng use the filter "up" only, which NumPy undoes
for the whole image at once; other filters are undone row by row.
"""

from __future__ import annotations

import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import DatasetError

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_NONE, _SUB, _UP, _AVERAGE, _PAETH = range(5)


def decode(data: bytes, where: str, size: tuple[int, int]) -> NDArray[Any]:
    """(height, width) or (height, width, 3), uint8 or uint16. size is the (height, width) that is expected."""
    header, packed = _chunks(data, where)
    width, height, bits, color, _, _, interlace = header
    if (height, width) != size:
        raise DatasetError(f"{where}: found {width} x {height} pixels, expected {size[1]} x {size[0]}")
    if color not in (0, 2) or bits not in (8, 16) or interlace:
        raise DatasetError(
            f"{where}: found a PNG of color type {color} with {bits} bits{', interlaced' * interlace}, "
            "expected gray or RGB of 8 or 16 bits"
        )
    channels = 3 if color == 2 else 1
    pixel_bytes = channels * bits // 8
    row_bytes = width * pixel_bytes
    expected = (row_bytes + 1) * height
    try:
        raw = zlib.decompressobj().decompress(packed, expected + 1)
    except zlib.error as error:
        raise DatasetError(f"{where}: found damaged pixels ({error})") from error
    if len(raw) != expected:
        raise DatasetError(f"{where}: found {len(raw)} bytes of pixels, expected {expected}")
    rows = np.frombuffer(raw, dtype=np.uint8).reshape(height, row_bytes + 1)
    filters, rows = rows[:, 0], rows[:, 1:]
    if (filters == _UP).all():
        rows = np.cumsum(rows, axis=0, dtype=np.uint8)
    elif filters.any():
        rows = _unfilter(filters, rows, pixel_bytes, where)
    pixels = np.ascontiguousarray(rows)
    values: NDArray[Any] = pixels.view(">u2").astype(np.uint16) if bits == 16 else pixels
    return values.reshape((height, width, 3) if channels == 3 else (height, width))


def _chunks(data: bytes, where: str) -> tuple[tuple[int, ...], bytes]:
    if data[:8] != _SIGNATURE or len(data) < 33 or data[12:16] != b"IHDR":
        raise DatasetError(f"{where}: found no PNG image, expected one")
    header = struct.unpack(">IIBBBBB", data[16:29])
    parts: list[bytes] = []
    at = 8
    while at + 12 <= len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        check = data[at + 8 + length : at + 12 + length]
        if len(check) != 4 or zlib.crc32(kind + body) != struct.unpack(">I", check)[0]:
            raise DatasetError(f"{where}: found a cut off or damaged PNG at byte {at}")
        if kind == b"IDAT":
            parts.append(body)
        if kind == b"IEND":
            return header, b"".join(parts)
        at += 12 + length
    raise DatasetError(f"{where}: found the end of the file at byte {len(data)}, expected the rest of a PNG")


def _unfilter(filters: NDArray[np.uint8], rows: NDArray[np.uint8], pixel_bytes: int, where: str) -> NDArray[np.uint8]:
    out = np.zeros_like(rows)
    above = np.zeros(rows.shape[1], dtype=np.uint8)
    for y, kind in enumerate(filters):
        row = rows[y]
        if kind == _NONE:
            out[y] = row
        elif kind == _SUB:
            out[y] = np.cumsum(row.reshape(-1, pixel_bytes), axis=0, dtype=np.uint8).reshape(-1)
        elif kind == _UP:
            out[y] = row + above
        elif kind in (_AVERAGE, _PAETH):
            out[y] = _unfilter_row(int(kind), row.tolist(), above.tolist(), pixel_bytes)
        else:
            raise DatasetError(f"{where}: found the filter {kind} in row {y}, expected 0 to 4")
        above = out[y]
    return out


def _unfilter_row(kind: int, row: list[int], above: list[int], pixel_bytes: int) -> list[int]:
    out: list[int] = []
    for i, value in enumerate(row):
        left = out[i - pixel_bytes] if i >= pixel_bytes else 0
        up = above[i]
        if kind == _AVERAGE:
            out.append((value + (left + up) // 2) & 255)
            continue
        corner = above[i - pixel_bytes] if i >= pixel_bytes else 0
        # Paeth's predictor (PNG specification, 9.4): the neighbor that is nearest to left + up - corner.
        guess = left + up - corner
        distances = (abs(guess - left), abs(guess - up), abs(guess - corner))
        out.append((value + (left, up, corner)[distances.index(min(distances))]) & 255)
    return out
