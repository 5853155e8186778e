"""Small input that asks for much work or memory: bounded, with a message."""

import json
import math

from .cities import osm, templates
from .case import CAMERA, Case, scene, write
from .gltf import instances, meshopt, zeros
from .png import png

SMALL_BUDGET = "0.5"  # GB


def checked(name, text, expects="either", says="", seconds=60, files=None, options=(), command="check"):
    def build(folder):
        for other, content in (files or {}).items():
            write(folder, other, content() if callable(content) else content)
        script = scene(folder, text() if callable(text) else text)
        return [[command, script, *options, *(["-o", "out.glb"] if command == "export" else [])]]

    return Case("growth", name, build, expects, seconds=seconds, says=says)


def budget(name, file, content, expects="refused", extra=None, limit=SMALL_BUDGET, says="--max-memory"):
    """What fits into the machine and not into the budget."""

    def build(folder):
        for other, other_content in (extra or {}).items():
            write(folder, other, other_content() if callable(other_content) else other_content)
        write(folder, file, content() if callable(content) else content)
        script = scene(folder, f'model(file="{file}")\n' + CAMERA)
        return [["export", script, "--max-memory", limit, "-o", "out.glb"]]

    return Case("budget", name, build, expects, seconds=90, says=says)


def road_surface(side_m):
    square = [[0, 0, 0], [side_m, 0, 0], [side_m, side_m, 0], [0, side_m, 0]]
    return json.dumps({"type": "CityJSON", "version": "1.1", "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]}, "vertices": square,
                       "CityObjects": {"a": {"type": "Road", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2, 3]]]}]}}})


def crossing_roads(count, apart_m):
    lines = []
    for i in range(count):
        at, end = i * apart_m, count * apart_m
        lines += [f'road(path="{at} -50, {at} {end}")', f'road(path="-50 {at}, {end} {at}")']
    return "\n".join(lines) + "\n" + CAMERA


def ways(count, tags, between=0):
    """Ways of a map between two nodes, or each from the first to one of its own, all round it."""
    ends = between - 1 if between else count
    points = [(0, 0), *((.004 * math.cos(6.28 * i / ends), .006 * math.sin(6.28 * i / ends)) for i in range(ends))]
    return osm("".join(f'<node id="{i}" lat="{52.005 + lat:.8f}" lon="{4.005 + lon:.8f}"/>' for i, (lat, lon) in enumerate(points)) +
               "".join(f'<way id="{i + 1}"><nd ref="0"/><nd ref="{i % ends + 1}"/>{tags}</way>' for i in range(count)))


def bridges_in_one_place(count):
    """Bridges of streets to the north and of paths to the east, all within 40 m."""
    kinds = (("residential", lambda i: ((0, i / count), (1, i / count))), ("footway", lambda i: ((i / count, 0), (i / count, 1))))
    nodes, lines = [], []
    for highway, ends in kinds:
        for i in range(count):
            for lat, lon in ends(i):
                nodes.append(f'<node id="{len(nodes)}" lat="{52.005 + 1e-4 * lat:.9f}" lon="{4.005 + 1.5e-4 * lon:.9f}"/>')
            lines.append(f'<way id="{len(lines) + 1}"><nd ref="{len(nodes) - 2}"/><nd ref="{len(nodes) - 1}"/><tag k="highway" v="{highway}"/>'
                         '<tag k="bridge" v="yes"/><tag k="layer" v="1"/></way>')
    return osm("".join(nodes) + "".join(lines))


def scenarios(count, overrides):
    text = "".join(f'group(name="g{i}") {{ }}\n' for i in range(overrides))
    for s in range(count):
        text += f'scenario(name="s{s}") {{\n' + "".join(f'  override(of="g{i}", position="{s} {i} 0")\n' for i in range(overrides)) + "}\n"
    return text + CAMERA


def large_picture():
    """16384 x 16384 pixels of one bit, all there, in some kilobytes."""
    side = 16384
    return png(side, side, (b"\0" + b"\0" * (side // 8)) * side, kind=0, depth=1)


OBJ = {"m.mtl": "newmtl m\nmap_Kd t.png\n"}
TEXTURED = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"


def narrow_streets(side):
    """A grid of streets too narrow for two cars."""
    apart, half, end = 4000, 200, 4000 * (side - 1) + 200  # cm
    bands = [(i * apart - half, -half, i * apart + half, end) for i in range(side)]
    bands += [(low, left, high, right) for left, low, right, high in bands]
    corners = [[x, y, 0] for a, b, c, d in bands for x, y in ((a, b), (c, b), (c, d), (a, d))]
    return json.dumps({"type": "CityJSON", "version": "1.1", "transform": {"scale": [0.01] * 3, "translate": [0, 0, 0]}, "vertices": corners,
                       "CityObjects": {"a": {"type": "Road", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3]] for i in range(len(bands))]}]}}})


def cubes(count):
    """Cubes in one another."""
    corners = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
    faces = [(1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)]
    return "".join("".join(f"v {x * s} {y * s} {z * s}\n" for x, y, z in corners) + "".join("f " + " ".join(str(c + 8 * i) for c in face) + "\n" for face in faces)
                   for i, s in ((i, 1 + i * 1e-3) for i in range(count)))


def roads_north(count, points):
    return "".join('road(path="' + ", ".join(f"{0.3 * (i % 2)} {i + r * (points + 100)}" for i in range(points)) + '")\n' for r in range(count)) + CAMERA


def many_casters(count):
    models = "".join(f'model(file="m.obj", name="o{i}", position="{i % 300} {i // 300} 0")\n' for i in range(count))
    return models + "shadowMap(" + ", ".join(f'casters="o{i}"' for i in range(count)) + ")\n" + CAMERA


def cameras_of_signs(count):
    """Names that are all the same in the name of a file."""

    def build(folder):
        names = ("".join("!?$%&*+,;:"[int(digit)] for digit in f"{i:05d}") for i in range(count))
        script = scene(folder, "".join(f'camera(name="{name}", position="0 -9 2", target="0 0 1")\n' for name in names))
        return [["reference", script, "--path-traced", "--all-cameras", "--size", "2x2", "--samples", "1", "-o", "out.png"]]

    return Case("growth", f"{count} cameras named by signs", build, "done", seconds=60)


def cases():
    streets = 'model(name="q", file="m.json")\nstreets(of="q")\n' + CAMERA
    for side in (100, 1000, 4000):
        yield checked(f"roads out of a surface of {side} m", streets, files={"m.json": lambda s=side: road_surface(s)}, seconds=90)
    yield checked("60 x 60 narrow streets", streets, "done", files={"m.json": lambda: narrow_streets(60)})
    yield checked("roads of 400,000 points to the north", lambda: roads_north(4, 99_999), "done")
    yield checked("20,000 cubes of glass in one another", 'model(file="m.obj", dynamic=1) { material(preset="solid_glass") }\n' + CAMERA, "done", files={"m.obj": lambda: cubes(20_000)})
    yield checked("25,000 casters of shadows", lambda: many_casters(25_000), "done", files={"m.obj": lambda: cubes(1)})
    yield cameras_of_signs(1000)
    for apart in (60, 5):
        yield checked(f"200 x 200 roads that cross, {apart} m apart", lambda a=apart: crossing_roads(200, a), seconds=90)
    for apart in (60, 5):
        yield checked(f"150 x 150 paved streets, {apart} m apart", lambda a=apart: "paving()\n" + crossing_roads(150, a), seconds=120)
    yield checked("a paved road of 200 km", 'paving()\nroad(path="0 0, 200000 0")\n' + CAMERA, "done", seconds=90)
    for node in ("parkedCars()", "streetTrees(spacing=2)", 'streetTrees(kind="oak", spacing=2)', 'streetFurniture(kind="lamps", spacing=1)'):
        yield checked(f"{node} along 200 km", f'road(path="0 0, 200000 0")\n{node}\n' + CAMERA, seconds=120)
        yield checked(f"{node} along 1 km", f'road(path="0 0, 1000 0")\n{node}\n' + CAMERA, "done", seconds=120)
    for plant in ("hedge", "grass", "oak"):
        for groups in (1, 3, 10):
            text = "group(scale=1e6) {" * groups + f'plant(kind="{plant}")' + "}" * groups + '\nroad(path="0 0, 1000 0")\nparkedCars()\n'
            yield checked(f"cars beside a {plant} in {groups} groups of scale 1e6", text + CAMERA)
    wall = "v -1e6 0 -5\nv 1e6 0 -5\nv 0 1e6 -5\n" + "f 1 2 3\n" * 100
    yield checked("cars beside 100 triangles of 2,000 km", 'model(file="wall.obj")\nroad(path="0 0, 1000 0")\nparkedCars()\n' + CAMERA, files={"wall.obj": wall})
    slant = "v -1e6 -2e6 -1e6\nv -1e6 -2e6 1e6\nv 1e6 2e6 0\n" + "f 1 2 3\n" * 100
    yield checked("cars along 200 km under 100 slanted triangles of 2,000 km", 'model(file="slant.obj")\nroad(path="0 0, 200000 0")\nparkedCars()\n' + CAMERA, files={"slant.obj": slant})
    yield checked("10,000 roads of 2,000 km", lambda: "".join(f'road(path="-1e6 {30 * i}, 1e6 {30 * i}", lanes=8)\n' for i in range(10000)) + CAMERA, "refused", "km of lanes", 90)
    yield checked("3,000 roads between two places", 'road(path="0 0, 500 0")\n' * 3000 + CAMERA, "refused", "lies along")
    yield checked("2,000 roads that meet", lambda: "".join(f'road(path="0 0, {900 - i} {i}")\n' for i in range(0, 900)) + CAMERA, "refused")
    yield checked("8,000 roads of two metres in one place", lambda: "".join(f'road(path="{5 + i / 400:.5f} 0, {5 + i / 400:.5f} 2")\n' for i in range(8000)) + CAMERA, "refused", "so many in one place")
    for tags in ('<tag k="highway" v="residential"/>', '<tag k="highway" v="primary"/><tag k="bridge" v="yes"/><tag k="layer" v="1"/>'):
        yield checked(f"3,000 ways between two nodes of a map, {tags[:30]}", 'model(file="m.osm")\n' + CAMERA, "done", "lies along", files={"m.osm": lambda t=tags: ways(3000, t, between=2)})
    yield checked("3,000 ways from one node of a map", 'model(file="m.osm")\n' + CAMERA, "done", "lies along", files={"m.osm": lambda: ways(3000, '<tag k="highway" v="residential"/>')})
    yield checked("20,000 bridges of streets and 20,000 of paths in one place", 'model(file="m.osm")\n' + CAMERA, files={"m.osm": lambda: bridges_in_one_place(20_000)})
    lamps = "".join(f'model(file="m.obj", name="o{i}")\nlamp(shows="o{i}", of="o{i}")\n' for i in range(5000))
    yield checked("5,000 lamps that show an object each", lamps + CAMERA, "done", files={"m.obj": lambda: cubes(1)})
    yield checked("5,000 scenarios of 20 overrides", lambda: scenarios(5000, 20), seconds=120)
    yield checked("300 scenarios of 20 overrides", lambda: scenarios(300, 20), "done")
    comment = {"c.xp": lambda: b"# " + b"x" * 5_000_000 + b"\n"}
    yield checked("9,000 includes of a comment of 5 MB", lambda: 'include(file="c.xp")\n' * 9000, "refused", "larger than", files=comment)
    yield checked("20 includes of a comment of 5 MB", lambda: 'include(file="c.xp")\n' * 20 + CAMERA, "done", files=comment)
    for name, source in (("underflow", "1e-320"), ("overflow", "1e400"), ("long", "9" * 400)):
        yield checked(f"an event at {name}", f'group(name="g") {{ }}\ntimer(period_s=2, onTime="{source}, g, hide, 0.5")\n' + CAMERA)
    yield budget("accessors of zeros", "m.gltf", lambda: zeros(2_000_000))
    yield budget("one mesh on 2,000 nodes", "m.glb", lambda: instances(2000, 20000))
    yield budget("meshopt counts", "m.gltf", lambda: meshopt(count=2_500_000, byteStride=252))
    yield budget("3,000 templates of 2,000 surfaces", "m.json", lambda: templates(3000))
    yield budget("a true picture of 16384 x 16384 pixels", "m.obj", TEXTURED, "done", {**OBJ, "t.png": large_picture})
    yield budget("a small picture", "m.obj", TEXTURED, "done", {**OBJ, "t.png": lambda: png(64, 64)}, says="")
    yield budget("one mesh on 20 nodes", "m.glb", lambda: instances(20, 2000), "done", says="")
