"""Results that must be whole or not there at all, and never outside of their place."""

import os

from .case import CAMERA, Case, scene, write
from .png import png

TRIANGLE = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"
TOWER = "v -1 0 0\nv 1 0 0\nv 0 4 0\nf 1 2 3\n"
OLD = b"OLD" * 100


def place(folder):
    write(folder, "t.png", png(64, 64))
    write(folder, "m.mtl", "newmtl m\nmap_Kd t.png\n")
    write(folder, "m.obj", TRIANGLE)
    return scene(folder, 'model(file="m.obj", dynamic=1, reflective=1)\nmodel(file="m.obj", position="3 0 0")\nreferenceMaps(position="0 -3 1.2")\n' + CAMERA)


def command(verb, script, output):
    size = ["--size", "64x64"]
    return {
        "render": ["render", script, *size, "-o", output],
        "film": ["render", script, *size, "--seconds", "0.2", "-o", output],
        "reference": ["reference", script, *size, "--samples", "1", "-o", output],
        "photograph": ["reference", script, *size, "--samples", "1", "--path-traced", "-o", output],
        "export": ["export", script, "-o", output],
        "bake": ["bake", script],
        "city": ["city", "kitchen", "-o", output],
        "format": ["format", script],
    }[verb]


def old_stays(output):
    """The result is whole, or what was there before."""

    def check(folder, results):
        path = folder / output
        if results[-1]["status"] == 0:
            return "" if path.exists() and path.read_bytes() != OLD else "status 0 without a result"
        return "" if path.exists() and path.read_bytes() == OLD else f"status {results[-1]['status']}, and the old {output} is gone"

    return check


def full_disk(verb, output, limit):
    def build(folder):
        script = place(folder)
        write(folder, output, OLD)
        return [command(verb, script, output)]

    return Case("full disk", f"{verb} to {output}, {limit} bytes", build, "either", file_limit=limit, check=old_stays(output), needs_gl=verb in ("render", "film", "reference"))


def linked(verb, output, link, target):
    def build(folder):
        script = place(folder)
        path = os.path.join(folder, link)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        os.symlink(target, path)
        return [command(verb, script, output)]

    return Case("link", f"{verb} beside {link} -> {target}", build, "either", needs_gl=verb in ("render", "film", "reference", "bake"))


def pipe_in_place(verb, output, name):
    """A pipe where a command looks for what an earlier one has left, or is to write."""

    def build(folder):
        script = place(folder)
        os.makedirs(os.path.dirname(os.path.join(folder, name)) or folder, exist_ok=True)
        os.mkfifo(os.path.join(folder, name))
        return [command(verb, script, output)]

    return Case("pipe", f"{verb} beside a pipe {name}", build, "either", seconds=30, needs_gl=verb in ("render", "film", "reference", "bake"))


def two_states(names, verb="render"):
    """Pictures of scenarios, or of cameras, whose names have one shape as names of files: as many pictures, each of its own."""

    def build(folder):
        write(folder, "tower.obj", TOWER)
        states = "".join(f'scenario(name="{name}") {{ override(of="m", position="{3 * i} 0 0") }}\n' for i, name in enumerate(names))
        cameras = "".join(f'camera(name="{name}", position="{3 * i} -9 2", target="0 0 1")\n' for i, name in enumerate(names))
        text = 'model(name="m", file="tower.obj", dynamic=1)\n' + (states + CAMERA if verb == "render" else cameras)
        script = scene(folder, text)
        if verb == "render":
            return [["render", script, "--size", "64x64", *(word for name in names for word in ("--scenario", name)), "-o", "out.png"]]
        return [["reference", script, "--path-traced", "--all-cameras", "--size", "64x64", "--samples", "1", "-o", "out.png"]]

    def check(folder, results):
        if results[0]["status"] != 0:
            return f"refused: {results[0]['said'][:200]}"
        pictures = [path.read_bytes() for path in folder.glob("out*.png")]
        if len(set(pictures)) != len(names):
            return f"{len(pictures)} pictures, {len(set(pictures))} that differ, of {len(names)} states"
        return ""

    return Case("names", f"{verb} of {' and '.join(names)}", build, "either", check=check, needs_gl=verb == "render")


def formatted(mode, link=False):
    """`format` of a script with permissions of its own, or through a link beside it."""

    def build(folder):
        script = place(folder)
        scene(folder, (folder / "scene.xp").read_text().replace(", ", " ,  "))
        (folder / "scene.xp").chmod(mode)
        if link:
            (folder / "link.xp").symlink_to("scene.xp")
        return [["format", "link.xp" if link else script]]

    def check(folder, results):
        path = folder / "scene.xp"
        if " ,  " in path.read_text():
            return "nothing is formatted"
        if link and not (folder / "link.xp").is_symlink():
            return "the link has become a file"
        return "" if path.stat().st_mode & 0o7777 == mode else f"its mode was {mode:o} and is {path.stat().st_mode & 0o7777:o}"

    return Case("format", f"of a script of mode {mode:o}{' through a link' if link else ''}", build, "done", check=check)


def to_full_output(arguments):
    def build(folder):
        script = place(folder)
        return [[word if word != "SCENE" else script for word in arguments]]

    return Case("full output", " ".join(arguments), build, "refused", before=["bash", "-c", 'exec "$@" > /dev/full', "sh"])


def to_closed_output(arguments):
    """No standard output at all: what is printed is lost, or gets into a file that is opened in its place."""

    def build(folder):
        script = place(folder)
        return [[word if word != "SCENE" else script for word in arguments]]

    return Case("full output", "closed, " + " ".join(arguments), build, "refused", before=["bash", "-c", 'exec "$@" >&-', "sh"])


def bad_output(verb, output, expects="refused"):
    def build(folder):
        script = place(folder)
        write(folder, "file", "x")
        return [command(verb, script, output)]

    return Case("output", f"{verb} to {output[:40]!r}", build, expects, needs_gl=verb in ("render", "film", "reference"))


def kept_files(name, files, arguments, expects, says=""):
    """Somebody's own files beside a result stay as they are."""

    def build(folder):
        script = place(folder)
        for file in files:
            write(folder, file, OLD)
        return [[word if word != "SCENE" else script for word in words] for words in arguments]

    def check(folder, results):
        lost = [file for file in files if not (folder / file).exists() or (folder / file).read_bytes() != OLD]
        return f"{', '.join(lost)} of somebody's own is gone" if lost else ""

    return Case("own files", name, build, expects, check=check, says=says, needs_gl=any("render" in words or "reference" in words for words in arguments))


def cases():
    size = ["--size", "64x64"]
    yield kept_files("a picture that an export would name", ["out_t.png", "out_t.jpg"], [["export", "SCENE", "-o", "out.glb"]], "refused", "out_t")
    yield kept_files("names like those of partial files", [".partial-original-out.png", ".partial-projects-out.png/a.txt"], [["render", "SCENE", *size, "-o", "out.png"]], "done")
    yield kept_files("a folder like an unfinished one", ["city/.unfinished-business/a.txt"], [["city", "kitchen", "-o", "city"]], "done")
    yield kept_files("a checkpoint that is none", ["out.png.checkpoint"], [["reference", "SCENE", *size, "--path-traced", "--samples", "1", "--restart", "-o", "out.png"]], "refused", "checkpoint")
    yield kept_files("a mask in the picture's place", [], [["reference", "SCENE", *size, "--samples", "1", "-o", "a.png", "--mask", "a.png"]], "refused", "a.png")
    yield kept_files("two mattes of one name", [], [["tree", "matte", "same", "-o", "mattes"]], "refused")
    for limit in (1, 200, 1000):
        for extension in ("png", "jpg", "exr", "hdr", "tif", "bmp", "tga", "webp"):
            for verb in ("render", "reference", "photograph"):
                yield full_disk(verb, f"out.{extension}", limit)
        yield full_disk("film", "out.mp4", limit)
        yield full_disk("export", "out.glb", limit)
    for target in ("../outside/keep", "../outside", "/"):
        for verb in ("bake", "render"):
            yield linked(verb, "out.png", "scene.baked", target)
        yield linked("city", "city", "city/.unfinished", target if target != "/" else "../outside/keep")
    for verb, output, link in (("render", "out.png", ".partial-out.png"), ("film", "out.mp4", ".partial-out.mp4"), ("export", "out.glb", ".partial-out.glb"),
                               ("format", "", ".partial-scene.xp"), ("bake", "", ".partial-scene.xp"), ("photograph", "out.png", "out.png.checkpoint"),
                               ("photograph", "out.png", ".partial-out.png"), ("reference", "out.png", ".partial-out.png"),
                               ("export", "out.glb", "out_t.png"), ("export", "out.glb", "out_t.jpg"), ("export", "out.glb", "out.glb"), ("render", "out.png", "out.png"),
                               ("film", "out.mp4", "out.mp4"), ("photograph", "out.png", "out.png")):
        for target in ("../outside/secret.bin", "../outside/absent"):
            yield linked(verb, output, link, target)
    for target in ("../outside/keep", "../outside", "../outside/absent"):
        yield linked("film", "out.mp4", "out.mp4.frames", target)
        for inner in ("scene.baked/reflectors", "scene.baked/bounced_light", "scene.baked"):
            yield linked("bake", "", inner, target)
    for verb, output, name in (("photograph", "out.png", "out.png.checkpoint"), ("photograph", "out.png", "out.png"), ("render", "out.png", "out.png"),
                               ("export", "out.glb", "out.glb"), ("export", "out.glb", "out_t.jpg"), ("film", "out.mp4", "out.mp4"), ("film", "out.mp4", "out.mp4.frames"),
                               ("bake", "", "scene.baked"), ("bake", "", "scene.baked/reflectors"), ("city", "city", "city"), ("city", "city", "city/.unfinished")):
        yield pipe_in_place(verb, output, name)
    for names in (["a/b", "a-b"], ["a-b", "a/b"], ["a b", "a_b", "a/b"], ["a-b-2", "a-b", "a/b"]):
        yield two_states(names)
        yield two_states(names, "reference")
    for mode in (0o600, 0o640, 0o755):
        yield formatted(mode)
        yield formatted(mode, link=True)
    for arguments in (["check", "SCENE"], ["check", "--reference"], ["check", "--schema"], ["--help"], ["export", "SCENE", "-o", "out.glb"]):
        yield to_full_output(arguments)
        yield to_closed_output(arguments)
    for verb, extension in (("render", "png"), ("film", "mp4"), ("export", "glb"), ("reference", "png"), ("photograph", "png")):
        yield bad_output(verb, f"file/out.{extension}")
        yield bad_output(verb, "a" * 300 + "." + extension)
        yield bad_output(verb, "a" * (254 - len(extension)) + "." + extension, "done")
        yield bad_output(verb, "out.gif")
        yield bad_output(verb, "out.jp2")
        yield bad_output(verb, "out.sgi")
        yield bad_output(verb, "out")
        yield bad_output(verb, "")
        yield bad_output(verb, "/dev/full")
