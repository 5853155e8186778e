"""Commands on files that are no scenes: captures, trees, facades, cars, pictures that are compared, bare models that are shown."""

import os

from .captures import captured
from .case import CAMERA, Case, scene, write
from .meshes import make_special
from .png import png

# What stands in the place of a file or folder that a command is given.
ODD = ("pipe", "folder", "zero", "sparse", "absent", "loop", "empty", "noise", "link out", "long name", "bytes")
LONG_NAME = "n" * 251
BYTES_NAME = b"caf\xe9".decode("utf-8", "surrogateescape")


def put_odd(folder, kind, extension):
    """Returns the name of what it makes."""
    name = {"long name": LONG_NAME[:255 - len(extension)], "bytes": BYTES_NAME}.get(kind, "odd") + extension
    if kind == "empty":
        write(folder, name, b"")
    elif kind in ("noise", "long name", "bytes"):
        write(folder, name, bytes(range(256)) * 40)
    elif kind == "link out":
        os.symlink("../outside/secret.bin", os.path.join(folder, name))
    else:
        make_special(folder, kind, name)
    return name


def put_capture(folder):
    for path, content in captured().items():
        write(folder, path, content)


# Command lines of which one word is replaced: (words, which word, its extension).
PLACES = [
    (["tree", "pack", "oak.tree"], 2, ".tree"), (["tree", "report", "oak.tree", "capture"], 2, ".tree"), (["tree", "report", "oak.tree", "capture"], 3, ""),
    (["tree", "vary", "oak.tree", "-o", "other.tree"], 2, ".tree"), (["tree", "export", "oak.tree", "-o", "other.glb"], 2, ".tree"),
    (["tree", "export", "oak.glb", "-o", "other.tree"], 2, ".glb"), (["tree", "measure", "oak.volume"], 2, ".volume"),
    (["tree", "organs", "oak.volume", "--trunk", "trunk.glb"], 2, ".volume"), (["tree", "organs", "oak.volume", "--capture", "capture", "--trunk", "trunk.glb"], 4, ""),
    (["tree", "texture", "capture", "oak.volume", "--texels", "4", "-o", "other.tree"], 2, ""), (["tree", "texture", "capture", "oak.volume", "--texels", "4", "-o", "other.tree"], 3, ".volume"),
    (["tree", "reconstruct", "capture", "--level", "1", "-o", "other.volume"], 2, ""),
    (["tree", "matte", "capture", "-o", "mattes"], 2, ""), (["tree", "matte", "capture", "--zones", "zones", "-o", "mattes"], 4, ""),
    (["facade", "pack", "capture", "--model", "box.obj"], 2, ""), (["facade", "pack", "capture", "--model", "box.obj"], 4, ".obj"),
    (["facade", "layers", "capture", "--model", "box.obj"], 4, ".glb"), (["facade", "fill", "capture", "--model", "box.obj"], 2, ""), (["facade", "report", "capture", "--model", "box.obj"], 2, ""),
    (["facade", "export", "capture", "--texture-side", "256", "-o", "other.glb"], 2, ""), (["facade", "model", "capture"], 2, ""), (["facade", "model", "capture", "--hints", "hints.txt"], 4, ".txt"),
    (["facade", "calibrate", "capture", "--features", "500", "-o", "place"], 2, ""), (["facade", "calibrate", "capture", "--cameras", "cameras.txt", "-o", "place"], 4, ".txt"),
    (["facade", "calibrate", "capture", "--cameras", "cameras.json", "-o", "place"], 4, ".json"), (["facade", "calibrate", "capture", "--cameras", "cameras.wrl", "-o", "place"], 4, ".wrl"),
    (["facade", "calibrate", "capture", "--cameras", "cameras.gltf", "-o", "place"], 4, ".gltf"), (["facade", "calibrate", "capture", "--cameras", "cameras", "-o", "place"], 4, ""),
    (["facade", "panorama", "capture/0000.png", "-o", "place"], 2, ".jpg"), (["facade", "panorama", "capture/0000.png", "-o", "place"], 2, ""),
    (["facade", "walk", "capture", "--model", "box.obj", "-o", "place"], 2, ""),
    (["car", "box.obj"], 1, ".obj"), (["car", "box.obj", "-o", "car.xp"], 1, ".glb"), (["compare", "a.png", "b.png"], 1, ".png"), (["compare", "a.png", "b.png"], 2, ".exr"),
    (["compare", "a.png", "b.png", "--mask", "c.png"], 4, ".png"), (["check", "scene.xp"], 1, ".xp"), (["check", "m.obj"], 1, ".glb"), (["check", "m.obj"], 1, ".json"),
    (["view", "scene.xp", "--frames", "1", "--size", "64x64"], 1, ".xp"), (["view", "m.glb", "--frames", "1", "--size", "64x64"], 1, ".glb"), (["view", "m.glb", "--frames", "1", "--size", "64x64"], 1, ".osm"),
    (["sun", "scene.xp", "--from", "2026-06-21", "--every", "1", "--place", "52", "4", "--area", "0", "0", "4", "4"], 1, ".xp"), (["export", "m.obj", "-o", "out.glb"], 1, ".ply"),
    (["format", "scene.xp"], 1, ".xp"), (["bake", "scene.xp"], 1, ".xp"), (["render", "scene.xp", "--size", "64x64", "--data", "folder", "-o", "out.png"], 5, ""),
]


def misplaced(words, at, extension, kind):
    def build(folder):
        put_capture(folder)
        scene(folder, 'model(file="box.obj")\n' + CAMERA)
        for name in ("a.png", "b.png"):
            write(folder, name, png(8, 8))
        odd = put_odd(folder, kind, extension)
        return [[*words[:at], odd, *words[at + 1:]]]

    # A further folder may be anything, and so may what is not read; a script may be empty.
    is_free = words[0] == "render" or words[1] == "matte" and kind == "folder" or kind == "empty" and extension == ".xp"
    return Case("command", f"{' '.join(words)[:60]}, {words[at]} is {kind} {extension}", build, "either" if is_free else "refused", seconds=60, needs_gl=words[0] in ("view", "render", "bake"))


def cases():
    for words, at, extension in PLACES:
        for kind in ODD:
            # a script that a person names may be a link: what a scene names may not
            if not (kind == "link out" and extension == ".xp"):
                yield misplaced(words, at, extension, kind)
