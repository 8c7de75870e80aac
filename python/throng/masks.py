"""COCO's segmentations as NumPy masks: compressed and plain run lengths, polygons.

Masks are boolean arrays (height, width); pixel i covers [i, i + 1) of box coordinates. Run lengths count pixels down
the columns, column after column, of 0, 1, 0, 1, ...
"""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import DatasetError

BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]


def run_lengths(counts: str | bytes | Sequence[int]) -> NDArray[np.int64]:
    """The run lengths that COCO's `counts` holds, compressed or as a list."""
    if not isinstance(counts, (str, bytes)):
        try:
            runs = np.asarray(counts, dtype=np.int64)
        except (TypeError, ValueError, OverflowError):
            raise DatasetError("counts: found a list of other things, expected whole numbers") from None
        return runs.reshape(-1)
    if isinstance(counts, str):
        try:
            counts = counts.encode("ascii")
        except UnicodeEncodeError:
            raise DatasetError("counts: found characters that are not ASCII") from None
    return _parse([counts])[0] if counts else np.empty(0, dtype=np.int64)


def compress(runs: Sequence[int] | NDArray[np.int64]) -> str:
    """COCO's compressed text of run lengths."""
    text = bytearray()
    for i, run in enumerate(runs):
        value = int(run) - (int(runs[i - 2]) if i > 2 else 0)
        while True:
            group = value & 31
            value >>= 5
            done = value == (-1 if group & 16 else 0)
            text.append(48 + (group if done else group | 32))
            if done:
                break
    return text.decode("ascii")


def decode(segmentation: Any, height: int, width: int) -> BoolArray:
    """A mask of a COCO segmentation: {"size", "counts"} or a list of polygons [x, y, x, y, ...]."""
    mask: BoolArray = decode_many([segmentation], height, width)[0]
    return mask


def decode_many(segmentations: Sequence[Any], height: int, width: int) -> BoolArray:
    """(N, height, width) masks; the work grows with the number of pixels that are set, not with the image's size."""
    out = np.zeros((len(segmentations), height, width), dtype=np.bool_)
    texts: list[bytes] = []
    indices: list[int] = []
    for i, segmentation in enumerate(segmentations):
        if isinstance(segmentation, dict):
            if segmentation.get("size") != [height, width] or "counts" not in segmentation:
                raise DatasetError(
                    f"segmentation: found the size {segmentation.get('size')}, expected "
                    f"[{height}, {width}] and counts"
                )
            counts = segmentation["counts"]
            if isinstance(counts, str) and counts and counts.isascii():
                texts.append(counts.encode())
                indices.append(i)
            else:
                runs = run_lengths(counts)
                _fill(out, np.array([i]), runs, np.zeros(runs.size, dtype=np.int64), np.arange(runs.size))
        elif isinstance(segmentation, list):
            for polygon in segmentation:
                out[i] |= from_polygon(polygon, height, width)
        else:
            raise DatasetError(f"segmentation: found {type(segmentation).__name__}, expected run lengths or polygons")
    if texts:
        _fill(out, np.array(indices), *_parse(texts))
    return out


def _parse(texts: Sequence[bytes]) -> tuple[IntArray, IntArray, IntArray]:
    """Run lengths of several texts, one after the other; of each the number of its text and its index in it."""
    groups = np.frombuffer(b"".join(texts), dtype=np.uint8).astype(np.int64) - 48
    is_last = (groups & 32) == 0
    text_ends = np.cumsum([len(text) for text in texts]) - 1
    if groups.min() < 0 or groups.max() > 63 or not is_last[text_ends].all():
        raise DatasetError("counts: found text that is not COCO's compressed run lengths")
    ends = np.flatnonzero(is_last)
    starts = np.append(0, ends[:-1] + 1)
    digit = np.arange(groups.size) - np.repeat(starts, ends - starts + 1)
    if digit.max() > 7:
        raise DatasetError("counts: found a number of more than 40 bits")
    values = np.add.reduceat((groups & 31) << (5 * digit), starts)
    values -= np.where((groups[ends] & 16) != 0, np.int64(1) << (5 * (digit[ends] + 1)), 0)
    text = np.searchsorted(text_ends, ends)
    index = np.arange(values.size) - np.searchsorted(text, np.arange(len(texts)))[text]
    # From the fourth run on, values are differences to the run two before: sums over odd and over even indices from 2.
    chain = text * 3 + np.where(index == 0, 0, 2 - index % 2)
    order = np.argsort(chain, kind="stable")
    values[order] = _chained_sums(values[order], chain[order])
    return values, text, index


def _chained_sums(values: IntArray, chain: IntArray) -> IntArray:
    """Running sums that begin anew with each number of `chain`, which is sorted."""
    sums = np.cumsum(values)
    first = np.searchsorted(chain, chain)
    result: IntArray = sums - (sums[first] - values[first])
    return result


def _fill(out: BoolArray, masks: IntArray, runs: IntArray, text: IntArray, index: IntArray) -> None:
    """Sets the pixels of the odd runs in out[masks[text]]."""
    _, height, width = out.shape
    total = height * width
    sums = np.zeros(len(masks), dtype=np.int64)
    if runs.size:
        if runs.min() < 0 or runs.max() > total:
            raise DatasetError(
                f"segmentation: found a run of {int(runs.min() if runs.min() < 0 else runs.max())} "
                f"pixels, expected 0 to {total}"
            )
        np.add.at(sums, text, runs)
    if (sums != total).any():
        raise DatasetError(
            f"segmentation: found run lengths that sum to {int(sums[sums != total][0])}, expected {total}"
        )
    begins = _chained_sums(runs, text) - runs
    keep = (index % 2 == 1) & (runs > 0)
    lengths = runs[keep]
    before = np.cumsum(lengths) - lengths
    pixel = np.arange(int(lengths.sum())) + np.repeat(begins[keep] - before, lengths)
    out[np.repeat(masks[text[keep]], lengths), pixel % height, pixel // height] = True


def encode(mask: NDArray[Any]) -> dict[str, Any]:
    """The segmentation of a mask with compressed run lengths."""
    flat = np.asarray(mask, dtype=np.bool_).T.reshape(-1)
    changes = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    runs = np.diff(np.append(np.append(0, changes), flat.size))
    if flat.size and flat[0]:
        runs = np.append(0, runs)
    return {"size": [int(mask.shape[0]), int(mask.shape[1])], "counts": compress(runs)}


def from_polygon(polygon: Sequence[float], height: int, width: int) -> BoolArray:
    """Pixels whose centers are inside of a polygon [x, y, x, y, ...] in box coordinates (even-odd rule)."""
    try:
        points = np.asarray(polygon, dtype=np.float64).reshape(-1, 2)
    except (TypeError, ValueError):
        raise DatasetError("segmentation: found a polygon that is not a list of x, y, x, y, ...") from None
    if len(points) < 3 or not np.isfinite(points).all():
        raise DatasetError(f"segmentation: found a polygon of {len(points)} points, expected three or more, finite")
    crossings = np.zeros((height, width + 1), dtype=np.int32)
    for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0)):
        low, high = min(y0, y1), max(y0, y1)
        # Rows whose centers row + 0.5 are in [low, high).
        first, last = max(0, int(np.ceil(low - 0.5))), min(height, int(np.ceil(high - 0.5)))
        if first >= last:
            continue
        rows = np.arange(first, last)
        x = x0 + (rows + 0.5 - y0) * (x1 - x0) / (y1 - y0)
        # The first column whose center lies at or right of the edge.
        columns = np.clip(np.ceil(x - 0.5), 0, width).astype(np.int64)
        np.add.at(crossings, (rows, columns), 1)
    inside: BoolArray = np.cumsum(crossings, axis=1)[:, :width] % 2 == 1
    return inside
