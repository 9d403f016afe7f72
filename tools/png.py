"""8-bit PNG files: reading, comparing and packing tighter, with nothing but the standard library."""
import math
import struct
import zlib

import files

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}


class PngError(Exception):
    pass


def chunks(data):
    at = len(SIGNATURE)
    while at + 12 <= len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def unfilter(kind, line, above, step):
    """Undoes one row's filter (PNG specification, section 9.2), in place."""
    if kind == 1:
        for i in range(step, len(line)):
            line[i] = (line[i] + line[i - step]) & 255
    elif kind == 2:
        line[:] = bytes((a + b) & 255 for a, b in zip(line, above))
    elif kind == 3:
        for i in range(len(line)):
            left = line[i - step] if i >= step else 0
            line[i] = (line[i] + (left + above[i]) // 2) & 255
    elif kind == 4:
        for i in range(len(line)):
            a, b, c = (line[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            line[i] = (line[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
    elif kind != 0:
        raise PngError(f"unknown row filter {kind}")


def read(path):
    """(width, height, channels, bytes). Only what this project writes: 8 bits, not interlaced, no palette."""
    data = path.read_bytes()
    if not data.startswith(SIGNATURE):
        raise PngError(f"{path} is no PNG file")
    parts = list(chunks(data))
    width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", parts[0][1])
    if depth != 8 or colour not in CHANNELS or interlace:
        raise PngError(f"{path}: only 8-bit grey or colour without interlacing is read here")
    raw = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    step = CHANNELS[colour]
    stride = width * step
    rows, above = [], bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        line = bytearray(raw[start + 1:start + 1 + stride])
        unfilter(raw[start], line, above, step)
        rows.append(line)
        above = line
    return width, height, step, b"".join(rows)


def smallest(line, above, channels):
    """(filter, filtered row) of the three filters that undo in one addition."""
    left = bytes(channels) + line[:-channels] if len(line) > channels else bytes(len(line))
    candidates = [(0, line), (1, bytes((a - b) & 255 for a, b in zip(line, left))),
                  (2, bytes((a - b) & 255 for a, b in zip(line, above)))]
    return min(candidates, key=lambda c: sum(min(v, 256 - v) for v in c[1]))


def write(path, width, height, channels, pixels, quick=False):
    """Small rather than quick: each row takes the filter whose differences are smallest, then the best deflate. `quick`: for
    pictures of flat colours, which pack well without filters."""
    stride = width * channels
    out, above = bytearray(), bytes(stride)
    for y in range(height):
        line = pixels[y * stride:(y + 1) * stride]
        kind, best = (0, line) if quick else smallest(line, above, channels)
        out.append(kind)
        out += best
        above = line
    colour = {1: 0, 3: 2, 4: 6, 2: 4}[channels]
    body = SIGNATURE
    for name, content in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)),
                          (b"IDAT", zlib.compress(bytes(out), 9)), (b"IEND", b"")):
        body += struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    files.write(path, body)


def rootMeanSquare(a, b):
    """Of two pictures as `read` gives them, in levels of 255; infinite when their sizes differ."""
    if a[:3] != b[:3]:
        return math.inf
    if a[3] == b[3]:
        return 0.0
    return math.sqrt(sum((x - y) * (x - y) for x, y in zip(a[3], b[3])) / max(1, len(a[3])))
