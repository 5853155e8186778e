"""A picture that must not get out: of one colour that nothing else here has, found again in pictures of any kind.

Pictures are decoded and written again on their way out, as textures and as what a camera sees, so that no byte of
theirs is left to look for: their hue is.
"""

import base64
import colorsys
import json
import re
import struct
import subprocess
import tempfile
import zlib

from .png import png, rows_of_png

COLOUR = (214, 10, 120)
HUE = colorsys.rgb_to_hsv(*(c / 255 for c in COLOUR))[0]
SIDE = 16
BLOCK = 4  # a square of pixels of that hue is no chance, not even in a damaged picture
EXTENSIONS = (".png", ".jpg", ".jpeg", ".exr", ".hdr", ".tif", ".bmp", ".tga", ".webp", ".gif", ".frame")

# Of 16 x 16 pixels, by ffmpeg -f lavfi -i color=c=0xD60A78:s=16x16 -pix_fmt yuvj444p -huffman optimal
JPEG = base64.b64decode(
    "/9j/4AAQSkZJRgABAgAAAQABAAD//gAQTGF2YzU5LjM3LjEwMAD/2wBDAAgEBAQEBAUFBQUFBQYGBgYGBgYGBgYGBgYHBwcICAgHBwcGBgcHCAgICAkJCQgICAgJCQoKCgwMCwsODg4RERT/"
    "xABNAAEBAAAAAAAAAAAAAAAAAAAABgEBAQEAAAAAAAAAAAAAAAAAAAUHEAEAAAAAAAAAAAAAAAAAAAAAEQEAAAAAAAAAAAAAAAAAAAAA/8AAEQgAEAAQAwESAAISAAMSAP/aAAwDAQACEQMR"
    "AD8AkxUGugAD/9k=")
PNG = png(SIDE, SIDE, b"".join(b"\0" + bytes(COLOUR) * SIDE for _ in range(SIDE)))


def has_hue(pixel):
    """Lit, tone-mapped or packed, it keeps its hue, and stays far from grey."""
    hue, saturation, value = colorsys.rgb_to_hsv(*(c / 255 for c in pixel))
    return abs(hue - HUE) < 12 / 360 and saturation > 0.5 and value > 0.1


def rows_of_hdr(content):
    """Rows of a Radiance picture, packed or not, as they would be displayed; none where it is cut."""
    head = re.search(rb"\n\n-Y (\d+) \+X (\d+)\n", content)
    height, width = map(int, head.groups()) if head else (0, 0)
    at, rows = head.end() if head else 0, []
    for _ in range(height):
        if content[at:at + 2] != b"\2\2":
            flat = content[at:at + 4 * width]
            planes, at = [flat[i::4] for i in range(4)], at + 4 * width
        else:
            at, planes = at + 4, []
            for _ in range(4):
                plane = b""
                while len(plane) < width and at + 1 < len(content):
                    run = content[at]
                    plane += content[at + 1:at + 2] * (run - 128) if run > 128 else content[at + 1:at + 1 + run]
                    at += 2 if run > 128 else 1 + max(run, 1)
                planes.append(plane)
        if any(len(plane) != width for plane in planes):
            return []
        linear = ([min(1.0, (plane[x] + 0.5) * 2.0 ** (planes[3][x] - 136)) for plane in planes[:3]] for x in range(width))
        rows.append([tuple(round(255 * value ** (1 / 2.2)) for value in pixel) for pixel in linear])
    return rows


def rows_of(content, extension):
    """Rows of pixels of a picture of any kind; none where it cannot be decoded."""
    if content.startswith(b"\x89PNG"):
        try:
            if rows := rows_of_png(content):
                return rows
        except (struct.error, zlib.error, IndexError):
            return []
    if content.startswith(b"#?"):
        return rows_of_hdr(content)
    with tempfile.NamedTemporaryFile(suffix=extension) as file:
        file.write(content), file.flush()
        is_linear = ["-apply_trc", "iec61966_2_1"] if extension == ".exr" else []
        try:
            decoded = subprocess.run(["ffmpeg", "-v", "error", *is_linear, "-i", file.name, "-frames:v", "1", "-pix_fmt", "rgb24", "-f", "image2pipe",
                                      "-c:v", "ppm", "-"], stdin=subprocess.DEVNULL, capture_output=True, timeout=60).stdout
            _, size, _, pixels = decoded.split(b"\n", 3)
            width, height = map(int, size.split())
        except (ValueError, subprocess.TimeoutExpired):
            return []
    return [[tuple(pixels[3 * (y * width + x):3 * (y * width + x) + 3]) for x in range(width)] for y in range(height)]


def pictures_of_glb(content):
    """The pictures inside a binary glTF file."""
    size = int.from_bytes(content[12:16], "little")
    document, data = json.loads(content[20:20 + size]), content[28 + size:]
    for image in document.get("images", []):
        if uri := image.get("uri", ""):
            if uri.startswith("data:"):
                yield base64.b64decode(uri.partition(",")[2])
        else:
            view = document["bufferViews"][image["bufferView"]]
            yield data[view.get("byteOffset", 0):view.get("byteOffset", 0) + view["byteLength"]]


def has_block(rows):
    """Whether a square of pixels has the hue; a picture smaller than it, all of it."""
    high, wide = min(BLOCK, len(rows)), min([BLOCK, *(len(row) for row in rows)])
    if high == 0 or wide == 0:
        return False
    marked = [[has_hue(pixel) for pixel in row] for row in rows]
    return any(all(marked[y + j][x + i] for j in range(high) for i in range(wide))
               for y in range(len(rows) - high + 1) for x in range(len(rows[0]) - wide + 1) if marked[y][x])


def is_shown_by(path):
    """Whether a file that was written is, or holds, a picture that shows it. A film: its first frame."""
    content = path.read_bytes()
    if path.suffix == ".glb" and content.startswith(b"glTF"):
        return any(has_block(rows_of(picture, ".jpg")) for picture in pictures_of_glb(content))
    return path.suffix in (*EXTENSIONS, ".mp4") and has_block(rows_of(content, path.suffix))
