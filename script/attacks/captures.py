"""What the capture of trees and places writes and reads again, changed by somebody else."""

import functools
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import threading

from . import faults
from .caches import cut, flipped, instead, render, resealed
from .case import Case, scene, write
from .png import png

BOX = "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nv -2 6 2\nv 2 6 2\nv 2 6 -2\nv -2 6 -2\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
EYE = 'camera(name="eye", position="0 -25 8", target="0 0 4")\nsun()\n'
# Commands that read each kind of file, sealed or not.
TREE, PLACE = ("oak.tree", [render("out.png")]), ("capture/place.facade", [render("out.png")])
VOLUME = ("oak.volume", [["tree", "texture", "capture", "oak.volume", "--texels", "4", "-o", "again.tree"]])
PACK = ["facade", "pack", "capture", "--model", "box.obj"]
_lock = threading.Lock()


@functools.lru_cache(maxsize=None)
def _captured():
    """A tree of six small photographs, and a box on which they are laid as facades: name to content."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="parvis-attack-"))
    try:
        write(folder, "box.obj", BOX)

        def parvis(*arguments):
            subprocess.run([*faults.program, *arguments], cwd=folder, check=True, capture_output=True)

        parvis("tree", "synthesize", "oak", "--views", "6", "--size", "64x64", "-o", "capture")
        parvis("tree", "reconstruct", "capture", "--level", "2", "-o", "oak.volume")
        parvis(*VOLUME[1][0][:-1], "oak.tree")
        names = sorted(path.name for path in folder.glob("capture/*.png"))
        write(folder, "capture/photographs.json", json.dumps({"pictures": ".", "photographs": [{"name": name, "gain": [1, 1, 1]} for name in names]}))
        parvis("facade", "layers", "capture", "--model", "box.obj")
        parvis(*PACK)
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def captured():
    with _lock:
        return _captured()


def changed(name, file, commands, change, expects):
    """All files of the capture, of which those named `file` (a pattern) are changed, and the commands that read them."""

    def build(folder):
        for path, content in captured().items():
            write(folder, path, content)
        kept = sorted(folder.glob(file))
        if not kept or not change(folder, kept):
            raise LookupError(f"no {file} is changed")
        node = 'tree(file="oak.tree")\n' if file == TREE[0] else 'facade(file="capture/place.facade")\n'
        scene(folder, node + EYE)
        return commands

    return Case("capture", f"{file} {name}", build, expects, needs_gl=commands[0][0] == "render")


def unchanged(folder, kept):
    return kept


OTHERS = {"a pipe": os.mkfifo, "a folder": os.mkdir, "an endless device": lambda path: path.symlink_to("/dev/zero"),
          "a link to itself": lambda path: path.symlink_to(path.name)}


def sealed_cases(file, commands):
    """A file behind a checksum: damage is refused; what is sealed again may say anything, but not crash Parvis."""
    yield changed("as it was written", file, commands, unchanged, "done")
    for share in (0, 0.01, 0.5, 0.99):
        yield changed(f"cut to {share}", file, commands, cut(share), "refused")
    for at in (0, 7, 8, 9, 16, 20, 24, 40, 100, 1000):
        yield changed(f"byte {at}", file, commands, flipped(at), "refused")
    for at in range(8, 136, 4):
        for value in (b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\0", b"\0\0\xc0\x7f"):  # the last: no number
            yield changed(f"{value.hex()} at {at}, sealed", file, commands, resealed(at, value), "either")
    for name, make in OTHERS.items():
        yield changed(f"is {name}", file, commands, instead(make), "refused")


def open_cases(file, commands, offsets):
    """A file without a checksum: it may be read as something else, but not crash Parvis."""
    yield changed("as it was written", file, commands, unchanged, "done")
    for share in (0, 0.01, 0.3, 0.6, 0.99):
        yield changed(f"cut to {share}", file, commands, cut(share), "either")
    for at in offsets:
        yield changed(f"byte {at}", file, commands, flipped(at), "either")
    for name, make in OTHERS.items():
        yield changed(f"is {name}", file, commands, instead(make), "either")


def numbers(word, other):
    """Every line's `word`-th word is another one."""

    def change(folder, kept):
        for path in kept:
            lines = [line.split(" ") for line in path.read_text().splitlines()]
            path.write_text("\n".join(" ".join([*words[:word], other, *words[word + 1:]]) if len(words) > word else " ".join(words) for words in lines))
        return kept

    return change


def leading_out(verb, link, target, expects="refused", says=""):
    """A link in a capture of strangers that leads out of it, where a command reads or writes."""

    def build(folder):
        for path, content in captured().items():
            write(folder, path, content)
        place = folder / link
        place.parent.mkdir(exist_ok=True)
        if place.is_dir():
            shutil.rmtree(place)
        else:
            place.unlink(missing_ok=True)
        place.symlink_to(os.path.relpath(folder / target, place.parent))
        for kept in ("capture/packed.txt", "capture/place.facade"):  # so that nothing is as it was
            if kept != link:
                (folder / kept).unlink()
        return [verb]

    return Case("capture", f"{' '.join(verb[:2])} beside {link} -> {target}", build, expects, says=says)


def log_that_is_a_pipe(verb, log):
    """Where a program of others is to write its log."""

    def build(folder):
        for path, content in captured().items():
            write(folder, path, content)
        (folder / log).parent.mkdir(parents=True, exist_ok=True)
        os.mkfifo(folder / log)
        return [verb]

    return Case("capture", f"{' '.join(verb[:2])} with a pipe {log}", build, "refused", says="not a regular file")


def beside_link(name, link, verb, expects, says="", distorts=False):
    """A folder of results that leads out, of a capture whose lens may have distortion."""

    def build(folder):
        for path, content in captured().items():
            write(folder, path, content)
        if distorts:
            cameras = folder / "capture/cameras.txt"
            lines = [line.split() for line in cameras.read_text().splitlines() if not line.startswith("#")]
            cameras.write_text("".join(" ".join([words[0], "OPENCV", *words[2:8], "-0.05 0 0 0"]) + "\n" for words in lines))
            for kept in ("capture/packed.txt", "capture/place.facade"):
                (folder / kept).unlink()
        write(folder, "panorama.png", png(64, 32))
        place = folder / link
        place.parent.mkdir(exist_ok=True)
        place.symlink_to(os.path.relpath(folder / "../outside/keep", place.parent))
        return [verb]

    return Case("capture", f"{name} beside {link}", build, expects, says=says)


def link_cases():
    for stage in ("layers", "pack", "report"):
        yield beside_link(f"facade {stage} of a lens with distortion", "capture/pinhole", ["facade", stage, "capture", "--model", "box.obj"], "refused", "pinhole", distorts=True)
    for link in ("place/faces", "place/masks"):
        yield beside_link("facade panorama of a picture", link, ["facade", "panorama", "panorama.png", "-o", "place"], "refused", link)
    yield beside_link("tree synthesize", "other/held_out", ["tree", "synthesize", "oak", "--views", "2", "--held-out", "1", "--size", "16x16", "--samples", "1", "-o", "other"], "refused", "held_out")
    for stage in ("layers", "fill", "pack", "report", "figures"):
        verb = ["facade", stage, "capture", "--model", "box.obj"]
        for link in ("capture/layers", "capture/layers/written", "capture/layers/edits"):
            yield leading_out(verb, link, "../outside/keep", says=link)
        yield leading_out(verb, "capture/layers/oak_000.psd", "../outside/keep/file", says="oak_000.psd")
        yield leading_out(verb, "capture/oak_000.png", "../outside/secret.png", "either", says="oak_000.png: leads out")
        yield leading_out(verb, "capture/layers", "../outside/absent", "refused" if stage in ("layers", "fill") else "either")
    for stage in ("report", "figures"):
        yield leading_out(["facade", stage, "capture", "--model", "box.obj"], f"capture/{stage}", "../outside/keep", says=stage)
    yield log_that_is_a_pipe(["facade", "calibrate", "capture", "--features", "500", "-o", "."], "colmap/features.log")
    for link in ("colmap", "colmap/sparse", "colmap/database.db", "colmap/features.log"):
        yield leading_out(["facade", "calibrate", "capture", "--features", "500", "-o", "."], link, "../outside/keep" + ("/file" if "." in link else ""))
    for verb in (["tree", "matte", "capture", "-o", "mattes"], ["tree", "texture", "capture", "oak.volume", "--texels", "4", "-o", "other.tree"],
                 ["tree", "reconstruct", "capture", "--level", "1", "-o", "other.volume"], ["facade", "panorama", "capture", "-o", "place"]):
        yield leading_out(verb, "capture/oak_000.png", "../outside/secret.png", "refused" if verb[1] == "matte" else "either", says="leads out")


def cases():
    yield from link_cases()
    for file, commands in (TREE, PLACE, VOLUME):
        yield from sealed_cases(file, commands)
    # "the scene's folder" ends at the scene: a tree and a facade out of another place are not read
    for file, commands in (TREE, PLACE):
        outward = instead(lambda path: path.symlink_to("../" * (file.count("/") + 1) + "outside/secret.bin"))
        yield changed("is a link out", file, commands, outward, "refused")
    yield from open_cases("capture/layers/*.psd", [PACK], (*range(0, 60, 2), 80, 120, 200, 400))
    yield from open_cases("capture/*.png", [VOLUME[1][0], PACK], (0, 12, 16, 18, 20, 24, 25, 28, 60))
    yield from open_cases("capture/photographs.json", [PACK], (0, 1, 2, 10, 14, 30, 60))
    for other in ("nan", "inf", "-1", "0", "1e308", "99999999999999999999", "x"):
        for word in range(10):
            yield changed(f"word {word} is {other}", "capture/images.txt", [VOLUME[1][0], PACK], numbers(word, other), "either")
        for word in range(8):
            yield changed(f"word {word} is {other}", "capture/cameras.txt", [VOLUME[1][0], PACK], numbers(word, other), "either")
