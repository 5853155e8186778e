"""Every attribute of every node of the scene language, with values at its limits, beyond them, and that are none.

The nodes are those that the program names (parvis check --schema), in their own examples: a node that is new is tried
without a word here.
"""

import functools
import json
import os
import re
import subprocess

from . import faults
from .captures import captured
from .caches import CUBE
from .case import CAMERA, Case, scene, write
from .cities import building, city
from .gltf import glb, triangle
from .meshes import SHAPE
from .pictures import hdr

SPARSE_BYTES = 3_900_000_000  # less than the largest file that is read, and all holes
MEMORY = ["--max-memory", "1"]
LONG = "a" * 100_000
STARS = "*?" * 500 + "b"
VALUES = {
    "number": ["nan", "inf", "1e300", "-1e300", "1e-320", "0", "-1", "4294967297", "x"],
    "vector": ["nan 0 0", "inf 0 0", "1e300 0 0", "1e30 1e30 1e30", "1e6 1e6 1e6", "-1e9 0 1e9", "0 0 0", "0 0", ""],
    "points": ["nan 0", "1e300 0, 0 0", "1e6 1e6, -1e6 -1e6", "0 0", "0 0, 0 0", "0 0, 1e-9 0, 0 0", "0 0, 9 0, 9 9, 0 0", ", ,", ""],
    "text": [LONG, STARS, "%s%n", "\\n", "..", "", "target"],
    "event": [", , ,", "1e300, target, show, 1e300", "-1, target, show, nan", "a, target, toggle, 0", "0, target, position nan nan nan", "0, target, show, 0", LONG, "a"],
    "flag": ["2", "nan", ""],
}
KINDS = {"number": "number", "angle": "number", "integer": "number", "vec3": "vector", "colour": "vector", "points": "points", "path": "points",
         "text": "text", "reference": "text", "choice": "text", "event": "event", "flag": "flag"}


@functools.lru_cache(maxsize=None)
def schema():
    said = subprocess.run([*faults.program, "check", "--schema"], check=True, capture_output=True).stdout
    return json.loads(said)["nodes"]


def files_of(example):
    """Right files for the names in a node's example."""
    contents = {".xp": "sun()\n", ".glb": lambda: glb(*triangle()), ".obj": CUBE, ".json": city, ".hdr": hdr,
                ".osm": lambda: building([(0, 0), (0, .001), (.001, .001), (.001, 0)]),
                ".wrl": "#VRML V2.0 utf8\n" + 'DEF east Viewpoint { position 9 0 1 description "east" }\n' + SHAPE,
                ".tree": lambda: captured()["oak.tree"], ".facade": lambda: captured()["capture/place.facade"]}
    for name in re.findall(r'"([\w/]+(?:\.city)?\.\w+)"', example):
        content = contents.get(os.path.splitext(name)[1])
        if content is not None:
            yield name, content() if callable(content) else content


def with_attribute(node, name, value):
    """The node's example with that value; the node itself is called `target` where it may have a name."""
    def changed(found):
        words = re.sub(rf'(?<!\w){name}=("[^"]*"|[^,)\s]+),?\s*', "", found[2]).strip().rstrip(",")
        named = [f'name="target"'] if name != "name" and any(a["name"] == "name" for a in node["attributes"]) and "name=" not in words else []
        value_as_text = value.replace('"', '\\"')
        return f"{found[1]}({', '.join([*filter(None, [words]), *named, f'{name}=' + chr(34) + value_as_text + chr(34)])})"

    return re.sub(rf"(?<!\w)({node['type']})\(([^)]*)\)", changed, node["example"], count=1)


def traced(script):
    return ["reference", script, *MEMORY, "--size", "8x8", "--samples", "1", "-o", "out.png"]


def attribute_case(node, attribute, values):
    def build(folder):
        for name, content in files_of(node["example"]):
            write(folder, name, content)
        return [traced(scene(folder, with_attribute(node, attribute["name"], value) + "\n" + CAMERA, f"{i}.xp")) for i, value in enumerate(values)]

    return Case("node", f"{node['type']}.{attribute['name']}", build, "either", seconds=60)


def message_case(node, attribute, values):
    """The attribute, changed by messages while the scene runs."""
    def build(folder):
        for name, content in files_of(node["example"]):
            write(folder, name, content)
        scripts = []
        for i, value in enumerate(values):
            target = "%" + node["type"] if node["is_unique"] else "target"
            text = re.sub(rf"(?<!\w)({node['type']})\(", r'\1(name="target", ' if target == "target" else r"\1(", re.sub(r'name="[^"]*",?\s*', "", node["example"]) if target == "target" else node["example"], count=1)
            text += f'\ntimer(onTime="0.1, {target}, {attribute["name"]} {value}")\n' + CAMERA
            scripts.append([*traced(scene(folder, text, f"{i}.xp")), "--time", "1"])
        return scripts

    return Case("node", f"{node['type']}.{attribute['name']} by message", build, "either", seconds=60)


def file_case(node, attribute, kind):
    """Something in the place of a file that cannot be read as one, or must not."""
    def build(folder):
        name = next((name for name, _ in files_of(node["example"])), "x.xp")
        for other, content in files_of(node["example"]):
            write(folder, other, content)
        extension = os.path.splitext(name)[1]
        target = "odd" + extension
        if kind == "pipe":
            os.mkfifo(folder / target)
        elif kind == "sparse":
            with open(folder / target, "wb") as file:
                file.write((folder / name).read_bytes()[:64] if (folder / name).exists() else b"#")
                file.truncate(SPARSE_BYTES)
        elif kind in ("empty", "noise"):
            write(folder, target, b"" if kind == "empty" else bytes(range(256)) * 400)
        elif kind == "folder":
            (folder / target).mkdir()
        elif kind == "device":
            (folder / target).symlink_to("/dev/zero")
        elif kind == "link out":
            (folder / target).symlink_to("../outside/secret.png")
        else:
            target = kind
        script = scene(folder, with_attribute(node, attribute["name"], target) + "\n" + CAMERA)
        return [["check", script, *MEMORY], traced(script), ["export", script, *MEMORY, "-o", "out.glb"]]

    return Case("node", f"{node['type']}.{attribute['name']} is {kind}", build, "either", seconds=60)


FILES = ["pipe", "sparse", "empty", "noise", "folder", "device", "link out", "../outside/secret.png", "/etc/passwd", ".", "", "a" * 5000]


def cases():
    for node in schema():
        for attribute in node["attributes"]:
            if attribute["type"] == "file":
                yield from (file_case(node, attribute, kind) for kind in FILES)
                continue
            limits = [str(attribute[key]) for key in ("minimum", "maximum") if key in attribute and KINDS[attribute["type"]] == "number"]
            values = limits + VALUES[KINDS[attribute["type"]]]
            yield attribute_case(node, attribute, values)
            if attribute["is_live"] and KINDS[attribute["type"]] in ("number", "vector"):
                yield message_case(node, attribute, [value for value in values if value])
