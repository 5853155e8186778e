"""What Parvis keeps beside a scene, changed by somebody else."""

import functools
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import threading

from . import faults
from .case import CAMERA, Case, scene, write

CUBE = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
PYRAMID = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv 0 2 0\nf 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"
GROUND = "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nf 1 2 3 4\n"
# What a picture is made of, by the files in which it is kept.
NODES = {
    "*.map": 'reflection(method="multiple_environment_maps")\nreferenceMaps(position="0 -3 1.2")\n',
    "*.reflector": 'reflection(method="virtual_objects")\n',
    "*.transfer": "bouncedLight(rays=16)\n",
}


def content_hash(data):
    """The checksum of sealed files (base/content_hash.h), so that a change is not found by it."""
    state, mask = 0x243F6A8885A308D3, 2**64 - 1

    def mix(state, word):
        state = ((state ^ word) * 0x9E3779B97F4A7C15) & mask
        return state ^ (state >> 32)

    state = mix(state, len(data))
    whole = len(data) // 8 * 8
    for word in struct.unpack(f"<{whole // 8}Q", data[:whole]):
        state = mix(state, word)
    state = mix(state, int.from_bytes(data[whole:], "little"))
    return state ^ (state >> 29)


def place(folder, pattern):
    """Two closed mirrors of different shapes above a ground, and a small cube that they show."""
    for name, text in (("cube", CUBE), ("pyramid", PYRAMID), ("ground", GROUND)):
        write(folder, name + ".obj", text)
    mirror = 'model(file="{}.obj", name="{}", dynamic=1, reflective=1, position="{}") {{ material(preset="chrome") }}\n'
    return scene(folder, NODES[pattern] + mirror.format("cube", "a", "-1.6 0 1.2") + mirror.format("pyramid", "b", "1.6 0 0.2") +
                 'model(file="ground.obj")\nmodel(file="cube.obj", position="0 -3 0.4", scale=0.3)\ndayLight(timeOfDay=13)\n' + CAMERA)


def render(output):
    return ["render", "scene.xp", "--size", "64x64", "-o", output]


_lock = threading.Lock()


@functools.lru_cache(maxsize=None)
def _baked(pattern):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="parvis-attack-"))
    try:
        place(folder, pattern)
        for arguments in (["bake", "scene.xp"], render("out.png")):
            subprocess.run([*faults.program, *arguments], cwd=folder, check=True, capture_output=True)
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.glob("scene.baked/**/*") if path.is_file()}, (folder / "out.png").read_bytes()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def baked(pattern):
    """The files that the place keeps, and its picture, which nobody has touched."""
    with _lock:
        return _baked(pattern)


def is_right(pattern, folder, results, may_differ=False, must_warn=False):
    """The picture with what is kept is the one of the untouched place, or there is a warning; baked again, it is."""
    said = results[0]["said"].decode(errors="replace")
    if results[0]["status"] != 0:
        return f"no picture: {said[:200]}"
    _, right = baked(pattern)
    if must_warn and "warning" not in said:
        return "what is kept is not read: nothing warns of its damage"
    if not may_differ and "warning" not in said and (folder / "out.png").read_bytes() != right:
        return "another picture, without a warning"
    if not may_differ and (folder / "again.png").exists() and (folder / "again.png").read_bytes() != right:
        return "baked again, the picture is another"
    return ""


def changed(name, pattern, change, is_sealed=False, must_warn=False, may_refuse=False):
    """The kept files with a change, rendered, baked again and rendered. `change(folder, kept)`, of a folder and the
    files in it that match, says which of them it has changed. Sealed: whoever knows how may say what he likes, but
    not crash Parvis. May refuse: what is no file of ours need not be baked over, but the picture is the right one."""

    def build(folder):
        place(folder, pattern)
        for file, content in baked(pattern)[0].items():
            write(folder, file, content)
        kept = sorted(folder.glob("scene.baked/**/" + pattern))
        if not kept:
            raise LookupError(f"no {pattern} is kept")
        if not change(folder, kept):
            raise LookupError("no kept file is changed")
        return [render("out.png"), ["bake", "scene.xp"], *([] if is_sealed or may_refuse else [render("again.png")])]

    def check(folder, results):
        return is_right(pattern, folder, results, is_sealed, must_warn)

    return Case("cache", name, build, "either" if may_refuse else "done", needs_gl=True, check=check)


def each(change):
    """A change of bytes, in each file."""

    def change_files(folder, kept):
        before = [path.read_bytes() for path in kept]
        for path, content in zip(kept, before):
            path.write_bytes(change(content))
        return [path for path, content in zip(kept, before) if path.read_bytes() != content]

    return change_files


def cut(share):
    return each(lambda content: content[: int(len(content) * share)])


def flipped(at):
    return each(lambda content: content[:at] + bytes([content[at] ^ 0xff]) + content[at + 1:] if at < len(content) else content)


def resealed(at, value):
    """Another value in the content, with a right checksum."""

    def change(content):
        body = content[:-8]
        if at + len(value) > len(body):
            return content
        other = value if body[at:at + len(value)] != value else b"\1\0\0\0"
        body = body[:at] + other + body[at + len(value):]
        return body + struct.pack("<Q", content_hash(body))

    return each(change)


def exchanged(folder, kept):
    """The first two files under each other's names."""
    contents = [path.read_bytes() for path in kept[:2]]
    for path, content in zip(kept, reversed(contents)):
        path.write_bytes(content)
    return kept if len(contents) == 2 and contents[0] != contents[1] else []


def instead(make):
    """Something else in the place of each file: a pipe, a folder, a link."""

    def change(folder, kept):
        for path in kept:
            path.unlink()
            make(path)
        return kept

    return change


def folder_instead(target):
    """A link in the place of the folder that holds them."""

    def change(folder, kept):
        inner = kept[0].parent
        shutil.rmtree(inner)
        inner.symlink_to(os.path.relpath(folder / target, inner.parent))
        return kept

    return change


def control(name):
    """What the judge of these cases must find: another scene beside the kept files, or a case that changes nothing."""

    def one_model_less(folder, kept):
        script = folder / "scene.xp"
        script.write_text("".join(line + "\n" for line in script.read_text().splitlines() if "scale=" not in line))
        return kept

    return changed(name, "*.reflector", one_model_less if name == "another picture" else lambda folder, kept: [])


def cases():
    for pattern in NODES:
        yield changed(f"{pattern} under its own name, written again", pattern, lambda folder, kept: [path.write_bytes(path.read_bytes()) for path in kept])
        for share in (0, 0.01, 0.5, 0.99):
            yield changed(f"{pattern} cut to {share}", pattern, cut(share), must_warn=True)
        for at in (0, 7, 8, 9, 16, 20, 24, 40, 100):
            yield changed(f"{pattern} byte {at}", pattern, flipped(at), must_warn=True)
        for at in range(8, 72, 4):
            for value in (b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\0"):
                yield changed(f"{pattern} {value[3]:02x} at {at}, sealed", pattern, resealed(at, value), is_sealed=True)
        for name, make in {"a pipe": os.mkfifo, "a folder": os.mkdir, "an endless device": lambda path: path.symlink_to("/dev/zero"),
                           "a link out": lambda path: path.symlink_to(os.path.relpath(path.parents[2] / "../outside/secret.bin", path.parent)),
                           "a link to itself": lambda path: path.symlink_to(path.name)}.items():
            yield changed(f"{pattern} is {name}", pattern, instead(make), may_refuse=True)
        for target in ("../outside/keep", "../outside"):
            yield changed(f"the folder of {pattern} is a link to {target}", pattern, folder_instead(target), may_refuse=True)
    yield changed("the files of two reflectors exchanged", "*.reflector", exchanged, must_warn=True)
