"""PNG, written and read."""

import struct
import zlib


def png(width, height, rows=None, kind=2, depth=8, cut=None):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    pixels = rows if rows is not None else b"".join(b"\0" + b"\x50\x60\x70" * width for _ in range(height))
    whole = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b"")
    return whole if cut is None else whole[:cut]


def rows_of_png(content):
    """Rows of pixels of 3 values, of an 8-bit PNG with colours; None for other kinds."""
    width, height, depth, kind, _, _, interlace = struct.unpack(">IIBBBBB", content[16:29])
    if depth != 8 or kind not in (2, 6) or interlace or width * height > 1 << 24:
        return None
    channels, at, packed = {2: 3, 6: 4}[kind], 8, b""
    while at + 8 <= len(content):
        size, name = struct.unpack(">I4s", content[at:at + 8])
        packed += content[at + 8:at + 8 + size] if name == b"IDAT" else b""
        at += 12 + size
    data, stride, rows, above = zlib.decompress(packed), width * channels, [], bytes(width * channels)
    for y in range(height):
        filtered, row = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride if filtered else 0):
            left, up, corner = row[i - channels] if i >= channels else 0, above[i], above[i - channels] if i >= channels else 0
            if filtered == 4:
                guess = min((left, up, corner), key=lambda value: abs(left + up - corner - value))
            else:
                guess = (left, up, (left + up) // 2)[filtered - 1]
            row[i] = (row[i] + guess) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, stride, channels)])
        above = row
    return rows
