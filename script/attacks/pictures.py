"""Pictures that are damaged, claim too much, or are lists of other files; skies with values that are none."""

import math
import struct
import subprocess

from .case import CAMERA, Case, scene, write
from .png import png
from .secret_picture import JPEG, PNG


def hdr(value=(128, 128, 128, 129), width=4, height=2, claimed=None):
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {claimed or height} +X {claimed or width}\n".encode() + bytes(value) * (width * height)


def bmp(width, height, bits=24):
    return struct.pack("<2sIHHIIiiHHIIiiII", b"BM", 54, 0, 0, 54, 40, width, height, 1, bits, 0, 0, 0, 0, 0, 0)


def ico():
    return struct.pack("<HHH", 0, 1, 1) + struct.pack("<BBBBHHII", 1, 1, 0, 0, 1, 32, 104, 22) + struct.pack("<IiiHHIIiiII", 40, 2**15, 2**16, 1, 32, 0, 0, 0, 0, 0, 0) + b"\xff" * 64


def exr(values, width=4, height=2):
    """A scan-line EXR of 32-bit floats, not compressed."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data

    channels = b"".join(name + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\0") + \
        attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box) + attribute(b"lineOrder", b"lineOrder", b"\0") + \
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)) + \
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    lines, offsets = b"", b""
    for y in range(height):
        offsets += struct.pack("<Q", len(head) + 8 * height + len(lines))
        line = b"".join(struct.pack("<f", values[(y * width + x) % len(values)]) for _ in range(3) for x in range(width))
        lines += struct.pack("<ii", y, len(line)) + line
    return head + offsets + lines


def texture(name, file, content, expects="done", **more):
    """A picture of a mesh: what cannot be read is a checker with a warning, and the model is there."""

    def build(folder):
        write(folder, "memory.jpg", JPEG)  # of which libraries ask for pictures that they hold in memory
        write(folder, "memory.png", PNG)
        write(folder, file, content)
        write(folder, "m.mtl", f"newmtl m\nmap_Kd {file}\n")
        write(folder, "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
        return [["export", scene(folder, 'model(file="m.obj")\n' + CAMERA), "-o", "out.glb"]]

    return Case("picture", name, build, expects, **more)


def shown(extension, content):
    """A picture in the scene's own folder, on a square before the camera: exported, or rendered."""

    def build(folder):
        write(folder, "t.jpg", content)
        write(folder, "m.mtl", "newmtl m\nmap_Kd t.jpg\n")
        write(folder, "m.obj", "mtllib m.mtl\nv -4 0 0\nv 4 0 0\nv 4 4 0\nv -4 4 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n")
        script = scene(folder, 'model(file="m.obj")\ndayLight(timeOfDay=13)\n' + CAMERA)
        return [["export", script, "-o", "out.glb"] if extension == ".glb" else ["render", script, "--size", "64x64", "-o", "out" + extension]]

    return Case("shown", extension, build, "done", needs_gl=extension != ".glb")


def sky(name, file, content, expects="either", command="photograph"):
    def build(folder):
        if content is not None:
            write(folder, file, content)
        write(folder, "m.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
        script = scene(folder, f'sky(file="{file}")\nmodel(file="m.obj")\n' + CAMERA)
        options = ["--size", "16x16", "--samples", "1"]
        return [{"check": ["check", script], "trace": ["reference", script, *options, "-o", "out.exr"],
                 "photograph": ["reference", script, *options, "--path-traced", "-o", "out.exr"]}[command]]

    return Case("sky", f"{name}, {command}", build, expects, needs_gl=command == "trace")


def numbers_of(file):
    """The values of a picture in float."""
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "gbrpf32le", "-"], capture_output=True, stdin=subprocess.DEVNULL).stdout
    return struct.unpack(f"<{len(raw) // 4}f", raw)


def mended(name, values, replaced, command):
    """A sky with values that are none, beside the same sky with finite ones: one picture, and a warning."""

    def build(folder):
        write(folder, "m.obj", "v -2 0 0\nv 2 0 0\nv 0 4 0\nf 1 2 3\n")
        commands = []
        for sky, content, output in (("sky.exr", values, "out.exr"), ("mended.exr", replaced, "right.exr")):
            write(folder, sky, exr(content))
            script = scene(folder, f'sky(file="{sky}")\nmodel(file="m.obj")\n' + CAMERA, sky + ".xp")
            options = ["--size", "16x16", "--samples", "4", "-o", output]
            commands.append(["reference", script, *options, *(["--path-traced"] if command == "photograph" else [])])
        return commands

    def check(folder, results):
        got, right = numbers_of(folder / "out.exr"), numbers_of(folder / "right.exr")
        if not right or not all(map(math.isfinite, got)):
            return "the picture has values that are no finite numbers"
        if got != right:
            return "another picture than of the sky whose values are finite"
        if max(right) <= 0 < max(replaced):
            return "the picture of the finite sky is black: nothing is compared"
        return "" if b"warning" in results[0]["said"] else "no warning of what was replaced"

    return Case("sky", f"{name} as if mended, {command}", build, "done", needs_gl=command == "trace", check=check)


def cases():
    good = png(8, 8)
    for size in range(0, len(good), 9):
        yield texture(f"PNG cut at {size}", "t.png", good[:size])
    for width, height in ((32768, 32768), (65536, 65536), (2**31 - 1, 1), (0, 0), (32768, 1), (2**32 - 1, 2**32 - 1)):
        for kind, depth in ((2, 8), (6, 16), (0, 1)):
            yield texture(f"PNG that claims {width} x {height}, {kind} {depth}", "t.png", png(width, height, b"\0", kind, depth))
        yield texture(f"BMP that claims {width} x {height}", "t.bmp", bmp(width % 2**31, height % 2**31))
    for bits in (0, 1, 3, 4, 8, 16, 32, 64, 65535):
        yield texture(f"BMP of {bits} bits", "t.bmp", bmp(4, 4, bits) + b"\0" * 64)
    for name, content in {
        "t.ico": ico(), "t.png ": good, "t.avi": b"ffconcat version 1.0\nfile ../outside/secret.png\n", "t.m3u8": b"#EXTM3U\n#EXTINF:1,\n../outside/secret.png\n",
        "t.mpd": b"<?xml version='1.0'?><MPD/>", "t.null": b"?RES=32768x32768", "t.psd": b"8BPS\0\1" + b"\xff" * 60, "t.dds": b"DDS " + b"\xff" * 124,
        "t.jp2": b"\0\0\0\x0cjP  \r\n\x87\n" + b"\xff" * 40, "t.svg": b"<svg/>", "t.pdf": b"%PDF-1.4", "t.cin": b"\x80\x2a\x5f\xd7" + b"\xff" * 2048, "t.sgi": b"\x01\xda" + b"\xff" * 510,
        "t.rla": b"\xff" * 800, "t.iff": b"FOR4\0\0\0\x10CIMG", "t.zfile": b"\x2f\x08\x67\xab" + b"\xff" * 140, "t.pnm": b"P6 32768 32768 255\n", "t.fits": b"SIMPLE  =", "t.heic": b"\0\0\0\x18ftypheic",
        "t.ptx": b"\xff" * 100, "t.tga": b"\0\0\x0a\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x20\0", "t.gif": b"GIF89a\xff\xff\xff\xff\xf7\0\0", "t.webp": b"RIFF\xff\xff\xff\xffWEBPVP8L\xff\xff\xff\xff",
        "t.jpg": b"\xff\xd8\xff\xe0\0\x10JFIF\0" + b"\xff\xc0\0\x11\x08\xff\xff\xff\xff\x03" + b"\0" * 60, "t.tif": b"II*\0\x08\0\0\0\xff\xff" + b"\xff" * 90, "t.exr": b"\x76\x2f\x31\x01" + b"\xff" * 90,
        "t.hdr": b"#?RADIANCE\n\n-Y 999999999 +X 999999999\n"}.items():
        yield texture(f"{name} of few bytes", name, content)
        yield texture(f"{name}'s bytes as PNG", "u.png", content)
    floats = [1.0, 2.0]
    for name, values in {"an infinite sun": [1.0, float("inf")], "no number": [float("nan"), 1.0], "minus infinity": [float("-inf"), 1.0], "all infinite": [float("inf")],
                         "negative": [-1.0, 1.0], "3e38": [3e38, 1.0], "all 3e38": [3e38], "all zero": [0.0], "denormal": [1e-44], "right": floats}.items():
        for command in ("check", "trace", "photograph"):
            yield sky(name, "sky.exr", exr(values), "done", command)
    inf, nan = float("inf"), float("nan")
    for name, values, replaced in (("an infinite sun", [1.0, 2.0, inf], [1.0, 2.0, 2.0]), ("no number", [nan, 1.0], [0.0, 1.0]),
                                   ("minus infinity", [-inf, 1.0], [0.0, 1.0]), ("all infinite", [inf], [0.0]), ("all of them", [inf, nan, -inf, 3.0], [3.0, 0.0, 0.0, 3.0])):
        for command in ("trace", "photograph"):
            yield mended(name, values, replaced, command)
    for name, content in {"cut": exr(floats)[:200], "empty": b"", "HDR of 255": hdr((255, 255, 255, 255)), "HDR that claims": hdr(claimed=32768), "HDR": hdr(), "a PNG": good}.items():
        yield sky(name, "sky.exr" if "HDR" not in name else "sky.hdr", content)
    for name in ("../outside/secret.png", "../outside/secret.jpg", "link.png", "link.jpg", "pipe"):
        yield sky(f"of {name}", name, None, "refused")
