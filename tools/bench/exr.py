"""The pixels of the chapters' .exr files, to the bit: enough of the format (OpenEXR 2.0, scan lines, ZIP) to compare two."""
import struct
import sys
import zlib
from array import array
from dataclasses import dataclass
from itertools import accumulate

MAGIC = b"\x76\x2f\x31\x01"
ZIP = {2: 1, 3: 16}  # compression -> lines in a block: ZIPS, ZIP
FLOAT = 2


class ExrError(Exception):
    pass


@dataclass
class Picture:
    size: tuple     # width, height
    channels: dict  # name -> array("I"): the bits of each float, top row first

    def differing(self, other):
        """Pixels in which any channel has other bits: two NaNs are the same, 0 and -0 are not."""
        if self.size != other.size or self.channels.keys() != other.channels.keys():
            raise ExrError(f"pictures of {self.size} {sorted(self.channels)} and {other.size} {sorted(other.channels)} "
                           "cannot be compared")
        if self.channels == other.channels:
            return 0
        pairs = zip(*self.channels.values(), strict=True), zip(*other.channels.values(), strict=True)
        return sum(a != b for a, b in zip(*pairs))


def attributes(data):
    """The header: name -> bytes; and where it ends."""
    at, found = 8, {}
    while data[at] != 0:
        nameEnd = data.index(0, at)
        typeEnd = data.index(0, nameEnd + 1)
        count, = struct.unpack_from("<i", data, typeEnd + 1)
        found[data[at:nameEnd].decode()] = data[typeEnd + 5:typeEnd + 5 + count]
        at = typeEnd + 5 + count
    return found, at + 1


def channelNames(listed):
    names, at = [], 0
    while listed[at] != 0:
        end = listed.index(0, at)
        kind, = struct.unpack_from("<i", listed, end + 1)
        if kind != FLOAT:
            raise ExrError(f"channel {listed[at:end].decode()} is not of 32-bit floats")
        names.append(listed[at:end].decode())
        at = end + 17
    return names


def unpacked(block, size):
    """One block of scan lines: ZIP stores differences of the even bytes, then of the odd ones."""
    if len(block) == size:
        return block
    differences = zlib.decompress(block)
    split = bytes(accumulate(differences, lambda before, d: (before + d - 128) & 255))
    half = (size + 1) // 2
    joined = bytearray(size)
    joined[0::2], joined[1::2] = split[:half], split[half:]
    return bytes(joined)


def decoded(data):
    """The Picture in these bytes. ExrError if they are something else than a chapter writes."""
    try:
        return decode(data)
    except (IndexError, ValueError, struct.error, zlib.error, KeyError) as problem:
        raise ExrError(f"a damaged .exr: {problem}") from None


def decode(data):
    if data[:4] != MAGIC:
        raise ExrError("not an .exr file")
    header, at = attributes(data)
    compression = header["compression"][0]
    if compression not in ZIP:
        raise ExrError(f"compression {compression} of an .exr is not ZIP")
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    names = channelNames(header["channels"])
    channels = {name: array("I") for name in names}
    lines = ZIP[compression]
    for offset, in struct.iter_unpack("<q", data[at:at + 8 * -(-height // lines)]):
        y, count = struct.unpack_from("<2i", data, offset)
        rows = min(lines, height - (y - top))
        pixels = unpacked(data[offset + 8:offset + 8 + count], 4 * width * len(names) * rows)
        for row in range(rows):
            for i, name in enumerate(names):
                begin = 4 * width * (row * len(names) + i)
                channels[name].frombytes(pixels[begin:begin + 4 * width])
    if sys.byteorder == "big":
        for values in channels.values():
            values.byteswap()
    if any(len(values) != width * height for values in channels.values()):
        raise ExrError("an .exr with rows missing")
    return Picture((width, height), channels)
