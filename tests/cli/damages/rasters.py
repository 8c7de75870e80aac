"""PNG, NumPy and run-length files as throng writes them."""
import io
import struct
import zipfile
import zlib

import numpy
from check_dataset import decode_counts


def raster_name(kind, image):
    return kind + image["file_name"][len("images") : -len("jpg")] + "png"


def read_png(path):
    """NumPy array as in the file. Pillow knows no 16-bit RGB, so PNG is read by hand."""
    data = path.read_bytes()
    at, idat, size = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            size = height, width, 3 if colour == 2 else 1, bits // 8
        if kind == b"IDAT":
            idat += body
        at += 12 + length
    height, width, channels, depth = size
    stride = width * channels * depth
    raw = numpy.frombuffer(zlib.decompress(idat), numpy.uint8).reshape(height, stride + 1)
    assert set(raw[:, 0]) <= {0, 2}, "throng's rows are as they are or the difference to the row above"
    rows = numpy.zeros((height, stride), numpy.uint8)
    above = numpy.zeros(stride, numpy.uint8)
    for y in range(height):
        above = raw[y, 1:] + above if raw[y, 0] == 2 else raw[y, 1:]
        rows[y] = above
    array = rows.view(">u2").astype(numpy.uint16) if depth == 2 else rows
    return array.reshape(height, width, channels)


def png_bytes(array):
    height, width, channels = array.shape
    depth = array.dtype.itemsize
    rows = array.astype(">u2" if depth == 2 else numpy.uint8).tobytes()
    stride = width * channels * depth
    raw = b"".join(b"\0" + rows[y * stride : (y + 1) * stride] for y in range(height))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, height, 8 * depth, 2 if channels == 3 else 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 1)) + chunk(b"IEND", b"")


def ids_of(array):
    return array[..., 0].astype(int) + 256 * array[..., 1].astype(int) + 65536 * array[..., 2].astype(int)


def ids_to_rgb(ids):
    return numpy.stack([ids & 255, ids >> 8 & 255, ids >> 16 & 255], -1).astype(numpy.uint8)


def is_building(ids):
    return (ids >= 0x800000) & (ids < 0xC00000)


def is_person(ids):
    return (ids > 0) & (ids < 0x400000)


def instances(d, image):
    return ids_of(d.raster("instances", image)[1])


def encode(runs):
    text = ""
    for i, run in enumerate(runs):
        value = run - runs[i - 2] if i > 2 else run
        more = True
        while more:
            group = value & 31
            value >>= 5
            more = value != (-1 if group & 16 else 0)
            text += chr((group | 32 if more else group) + 48)
    return text


def mask_of(segmentation):
    height, width = segmentation["size"]
    runs = decode_counts(segmentation["counts"])
    flat = numpy.repeat(numpy.arange(len(runs)) % 2 == 1, runs)
    return flat.reshape(width, height).T


def segmentation_of(mask):
    flat = mask.T.ravel().astype(int)
    borders = numpy.flatnonzero(numpy.diff(flat)) + 1
    runs = numpy.diff([0, *borders, len(flat)]).tolist()
    if flat[0]:
        runs = [0, *runs]
    return {"size": list(mask.shape), "counts": encode(runs)}


def npy_of(data):
    """The bytes of a .npy file, or of the one in a .npz file."""
    if not data.startswith(b"PK"):
        return data
    with zipfile.ZipFile(io.BytesIO(data)) as file:
        return file.read("density.npy")


def read_npy(path):
    return numpy.load(io.BytesIO(npy_of(path.read_bytes())))


def npy_like(original, array):
    """With the original's header: NumPy's own is written otherwise."""
    plain = npy_of(original)
    start = 10 + plain[8] + 256 * plain[9]
    changed = plain[:start] + numpy.ascontiguousarray(array, "<f4").tobytes()
    if plain is original:
        return changed
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("density.npy", changed)
    return out.getvalue()


def change_npy(d, name, change):
    original = d.path(name).read_bytes()
    array = read_npy(d.path(name))
    changed = change(array.copy())
    assert changed.shape == array.shape and not numpy.array_equal(changed, array), "nothing changed"
    d.write(name, npy_like(original, changed))
