#!/usr/bin/python3
"""Judges the inputs of ../shared/data/reports by the command, as a user runs it; what is right stands in each folder's right.md.

    apps/bench/files/judge_reports.py build/release/apps/parvis/parvis ../shared/data/reports [--broken] [--json FILE] [FOLDER...]

--broken is the control: the scenes' models are turned by 20 degrees and shrunk (or the cameras, clock or camera of a folder without a
scene are wrong), so that no folder may come out right. Exit status 1 where one is not right.
"""

import csv
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

JUDGES = {}  # the number of a folder -> what judges it


def judges(number):
    """Registers a function that yields (what is measured, value, lowest right value, highest)."""
    return lambda function: JUDGES.setdefault(number, function)


def pixels(png):
    """The rows of an 8-bit PNG file, each a list of (red, green, blue)."""
    width, channels, data, at = 0, 3, b"", 8
    while at < len(png):
        size, kind = struct.unpack_from(">I4s", png, at)
        if kind == b"IHDR":
            width, _, _, colour = struct.unpack_from(">IIBB", png, at + 8)
            channels = {2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            data += png[at + 8 : at + 8 + size]
        at += 12 + size
    data, row, rows = zlib.decompress(data), bytearray(width * channels), []
    for start in range(0, len(data), width * channels + 1):
        method, line = data[start], bytearray(data[start + 1 : start + 1 + width * channels])
        for i in range(len(line)):
            left, up = (line[i - channels] if i >= channels else 0), row[i]
            corner = row[i - channels] if i >= channels else 0
            nearest = min((left, up, corner), key=lambda value: abs(left + up - corner - value))
            line[i] = (line[i] + (0, left, up, (left + up) // 2, nearest)[method]) % 256
        row = line
        rows.append([tuple(row[i : i + 3]) for i in range(0, len(row), channels)])
    return rows


def mean(rows, left, top, right, bottom):
    """The mean colour of a rectangle of pixels."""
    chosen = [pixel for row in rows[top:bottom] for pixel in row[left:right]]
    return [sum(pixel[k] for pixel in chosen) / len(chosen) for k in range(3)]


class Model:
    """The triangles of a .glb file that export has written, z up, all transforms applied."""

    def __init__(self, path):
        data = path.read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json, self.binary = json.loads(data[20 : 20 + length]), data[28 + length :]
        self.triangles, self.objects = [], []
        identity = [[float(i == j) for j in range(4)] for i in range(4)]
        for node in self.json["scenes"][self.json.get("scene", 0)]["nodes"]:
            self.visit(node, identity)

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        letter, size = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        start, stride = view.get("byteOffset", 0) + accessor.get("byteOffset", 0), view.get("byteStride", size * width)
        rows = [struct.unpack_from(f"<{width}{letter}", self.binary, start + i * stride) for i in range(accessor["count"])]
        return [row[0] for row in rows] if width == 1 else rows

    def visit(self, index, above):
        node = self.json["nodes"][index]
        if "matrix" in node:
            own = [[node["matrix"][4 * column + row] for column in range(4)] for row in range(4)]
        else:
            x, y, z, w = node.get("rotation", (0, 0, 0, 1))
            turned = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
            scale, moved = node.get("scale", (1, 1, 1)), node.get("translation", (0, 0, 0))
            own = [[turned[i][j] * scale[j] for j in range(3)] + [moved[i]] for i in range(3)] + [[0, 0, 0, 1]]
        place = [[sum(above[i][k] * own[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
        first = len(self.triangles)
        if "mesh" in node:
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                self.add(primitive, place)
        if len(self.triangles) > first:
            self.objects.append(self.triangles[first:])
        for child in node.get("children", []):
            self.visit(child, place)

    def add(self, primitive, place):
        points = []
        for x, y, z in self.accessor(primitive["attributes"]["POSITION"]):
            there = [place[i][0] * x + place[i][1] * y + place[i][2] * z + place[i][3] for i in range(3)]
            points.append((there[0], -there[2], there[1]))
        indices = self.accessor(primitive["indices"])
        self.triangles += [tuple(points[i] for i in indices[k : k + 3]) for k in range(0, len(indices), 3)]

    def box(self, triangles=None):
        corners = [corner for triangle in (self.triangles if triangles is None else triangles) for corner in triangle]
        return [min(c[k] for c in corners) for k in range(3)], [max(c[k] for c in corners) for k in range(3)]

    def size(self):
        low, high = self.box()
        return [high[k] - low[k] for k in range(3)]

    def volume(self, triangles=None):
        return sum(dot(a, cross(b, c)) for a, b, c in (self.triangles if triangles is None else triangles)) / 6

    def top(self, x, y):
        """The highest point above (x, y); minus infinity where there is nothing."""
        heights = [-math.inf]
        for a, b, c in self.triangles:
            twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            if abs(twice) < 1e-12:
                continue
            u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / twice
            v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / twice
            if u >= -1e-9 and v >= -1e-9 and u + v <= 1 + 1e-9:
                heights.append(u * a[2] + v * b[2] + (1 - u - v) * c[2])
        return max(heights)

    def wall_area(self, low=0.5):
        """Of upright triangles that reach higher than `low`."""
        total = 0.0
        for a, b, c in self.triangles:
            normal = cross(minus(b, a), minus(c, a))
            length = math.sqrt(dot(normal, normal))
            if length > 0 and abs(normal[2]) < 0.05 * length and max(a[2], b[2], c[2]) > low:
                total += length / 2
        return total


def minus(a, b):
    return [a[k] - b[k] for k in range(3)]


def dot(a, b):
    return sum(a[k] * b[k] for k in range(3))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class Place:
    """A copy of a folder, whose scenes are broken for the control."""

    def __init__(self, parvis, source, folder, broken):
        self.parvis, self.folder, self.broken = parvis, folder / source.name, broken
        shutil.copytree(source, self.folder, copy_function=shutil.copy)
        for path in self.folder.rglob("*"):  # the source may not be writable
            path.chmod(0o755 if path.is_dir() else 0o644)
        self.folder.chmod(0o755)
        if broken:
            for scene in self.folder.glob("*.xp"):
                turned = re.sub(r"model\(", "model(heading_deg=20, ", scene.read_text())
                scene.write_text(re.sub(r"\bscale=([\d.]+)", lambda found: f"scale={0.7 * float(found[1])}", turned) if "scale=" in turned
                                 else turned.replace("model(", "model(scale=0.7, "))

    def run(self, *words, errors=True):
        """What the command prints, with its warnings or without; a failure is what it says."""
        done = subprocess.run([self.parvis, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=600)
        if done.returncode != 0:
            raise Failed((done.stderr.strip().splitlines() or ["no message"])[-1])
        return done.stdout + (done.stderr if errors else "")

    def export(self, scene, *objects):
        self.run("export", scene, *(word for name in objects for word in ("--object", name)), "-o", "exported.glb")
        return Model(self.folder / "exported.glb")

    def picture(self, scene, *words, command="render"):
        self.run(command, scene, "--size", "320x180", *words, "-o", "picture.png")
        return pixels((self.folder / "picture.png").read_bytes())

    def facade_hours(self, *words):
        """Hours of the sunniest vertex of upright surfaces by their bearing: [(degrees, hours)]."""
        self.run("sun", *words, "-o", "sun")
        found = []
        with open(self.folder / "sun_facades.csv", encoding="utf-8") as table:
            for row in csv.reader(table):
                try:
                    numbers = [float(cell) for cell in row]
                except ValueError:
                    continue  # the head
                if abs(numbers[5]) < 0.1:
                    found.append((math.degrees(math.atan2(numbers[3], numbers[4])) % 360, numbers[6]))
        return found


class Failed(Exception):
    """The command did not end with status 0."""


def about(name, value, right, tolerance):
    return name, value, right - tolerance, right + tolerance


def boxes(model, low, high, tolerance=1e-3):
    found = model.box()
    for end, values, right in (("low", found[0], low), ("high", found[1], high)):
        for axis, value, expected in zip("xyz", values, right):
            if expected is not None:
                yield about(f"{end} {axis}", value, expected, tolerance)


def sizes(model, right, tolerance=1e-3):
    for axis, value, expected in zip("xyz", model.size(), right):
        yield about(f"size {axis}", value, expected, tolerance)


def greatest(hours, bearing, reach=8):
    return max((h for degrees, h in hours if abs((degrees - bearing + 180) % 360 - 180) < reach), default=-1.0)


@judges("01")
def small_matrix(place):
    model = place.export("bench_matrix.xp")
    yield from boxes(model, (0, 0, 0), (1.8, 0.45, 0.85))
    yield about("triangles", len(model.triangles), 36, 0)
    yield about("volume", model.volume(), 0.258, 0.0003)


@judges("02")
def small_scale(place):
    yield from boxes(place.export("bench_mm.xp"), (5, 0, 0), (6.8, 0.45, 0.85))


def red_or_blue(colour):
    """1: red, -1: blue, else 0."""
    return 1 if colour[0] > 2 * colour[2] else -1 if colour[2] > 2 * colour[0] else 0


@judges("03")
def texture_settings(place):
    for command in ("render", "reference"):
        for scene, right in (("own_transforms", [1, 1, 1, -1, -1, -1]), ("second_uvs", [1, 1, 1, -1, -1, -1]),
                             ("mirrored", [1, -1, -1, 1]), ("cutoff_low", [1, 1, 1])):
            rows = place.picture(f"{scene}.xp", command=command)
            width = 320 // len(right)
            for i, colour in enumerate(right):
                # The wall behind shows at the sides of what is smaller.
                seen = [red_or_blue(mean(rows, x, top, x + width // 4, top + 20)) for x in (i * width + width // 8, (i + 1) * width - 3 * width // 8)
                        for top in (8, 80, 150)]
                yield about(f"{command} {scene}, part {i + 1}", min(seen, key=lambda value: value * colour), colour, 0)


@judges("04")
def vertex_colours(place):
    for scene in ("board_bytes_gltf.xp", "board_ply.xp"):
        rows = place.picture(scene)
        left, right, middle = (mean(rows, *area) for area in ((4, 20, 40, 160), (280, 20, 316, 160), (150, 20, 170, 160)))
        yield f"{scene} red at the left", left[0] / max(left[2], 1), 3, math.inf
        yield f"{scene} blue at the right", right[2] / max(right[0], 1), 3, math.inf
        yield about(f"{scene} alike in the middle", middle[0] - middle[2], 0, 12)
        yield f"{scene} fills the picture", min(sum(mean(rows, x, y, x + 4, y + 4)) for x in (4, 312) for y in (8, 168)), 60, math.inf


@judges("05")
def instances(place):
    model = place.export("row_used.xp")
    yield about("triangles", len(model.triangles), 72, 0)
    yield from boxes(model, (0, -1, -0.2), (34.1, 2.25, 2), 0.06)
    for i, (x, y) in enumerate(((10, 0), (16, 0.5), (22, 1), (28, 1.5), (34, 2))):
        yield about(f"height of bollard {i + 1}", model.top(x, y), 1 + 0.25 * i, 1e-3)


@judges("06")
def cancelling(place):
    model = place.export("kerb_brought_back.xp")
    yield from boxes(model, (3.25, 0, None), (3.4, 4.0, None))
    stones = sorted(model.box(stone) for stone in model.objects)
    stones.sort(key=lambda box: box[0][1])
    yield about("stones", len(stones), 5, 0)
    for i, (low, high) in enumerate(stones):
        yield about(f"stone {i + 1} begins", low[1], 0.8 * i, 1e-3)
        yield about(f"stone {i + 1} ends", high[1], 0.8 * (i + 1), 1e-3)


@judges("07")
def mirrored(place):
    if place.broken:  # the mirrored half is missing
        gltf = json.loads((place.folder / "semi.gltf").read_text())
        gltf["scenes"][0]["nodes"] = [i for i in gltf["scenes"][0]["nodes"] if min(gltf["nodes"][i].get("scale", [1])) > 0]
        (place.folder / "semi.gltf").write_text(json.dumps(gltf))
    model = place.export("semi.xp")
    halves = [[t for t in model.triangles if side * sum(corner[0] for corner in t) > 0] for side in (1, -1)]
    volumes = [model.volume(half) for half in halves]
    yield "volume of the right half", volumes[0], 1.0, math.inf
    yield about("volume of the left half by that of the right", volumes[1] / volumes[0], 1, 1e-3)
    drawn, traced = place.picture("semi.xp"), place.picture("semi.xp", command="reference")
    differing = sum(max(abs(p[k] - q[k]) for k in range(3)) > 24 for a, b in zip(drawn, traced) for p, q in zip(a, b))
    yield "pixels that differ from the ray tracer", differing, 0, 0.02 * 320 * 180


@judges("08")
def indexed_outlines(place):
    model = place.export("polycurves.xp")
    yield from sizes(model, (16.4, 10.3, 3.0), 0.02)
    lines = [line for account in json.loads(place.run("check", "polycurves.xp", "--json", errors=False)) for line in account["lines"]]
    built = sum(line["count"] for line in lines if line["kind"] in ("IfcWall", "IfcWallStandardCase", "IfcSlab", "IfcColumn") and line["fate"] == "used")
    yield about("objects used", built, 5, 0)
    yield "volume of all", model.volume(), 3 * 5.4 + 2.48 + 1.46 - 0.01, 3 * 5.4 + 2.52 + 1.51 + 0.01


@judges("09")
def true_north(place):
    for scene in ("true_north.xp", "turned_by_hand.xp"):
        size = place.export(scene, "house").size()
        yield about(f"{scene} size x", size[0], 21.32, 0.02)
        yield about(f"{scene} size y", size[1], 16.93, 0.02)
        hours = place.facade_hours(scene, "--from", "2026-03-21", "--cell", "1", "--area", "-30", "-30", "30", "30")
        for bearing, right in ((60, 4.5), (150, 9.6), (240, 7.7), (330, 2.5)):
            yield about(f"{scene} hours at {bearing}", greatest(hours, bearing), right, 0.15)


@judges("10")
def north_first(place):
    for scene in ("town_north_first.xp", "town_east_first.xp"):
        model = place.export(scene)
        yield about(f"{scene} size x", model.size()[0], 30.1, 0.05)
        yield about(f"{scene} size y", model.size()[1], 75.1, 0.05)
        yield about(f"{scene} low z", model.box()[0][2], 104, 0.5)
        yield about(f"{scene} high z", model.box()[1][2], 134, 0.5)
        yield about(f"{scene} volume", model.volume(), 7680.5, 7.6)


@judges("11")
def deleted(place):
    model = place.export("project.xp")
    yield about("top at -35, 5", model.top(-35, 5), 9.0, 0.01)
    yield about("top at 3, 7", model.top(3, 7), 24.0, 0.01)
    yield about("top at 12, 6", max(model.top(12, 6), 0.0), 0.0, 0.5)
    yield about("top at -4, 1.5", max(model.top(-4, 1.5), 0.0), 0.0, 0.5)


@judges("12")
def roof_direction(place):
    model, up = place.export("roofs.xp"), 0.91
    for name, x, y, right in (("A", -60, 3.5, 9.0), ("A", -65.5, 0, 6.25), ("A control", -65.5, 30, 9.0), ("A control", -60, 33.5, 6.38),
                              ("B north", -33.5, 0, 9.0), ("B north", -30, 3.5, 6.38), ("B east", -30, 33.5, 9.0), ("B east", -33.5, 30, 6.38),
                              ("D", 30, 0, 5.0), ("D levels", 30, 30, 3.0)):
        yield about(f"{name} at {x}, {y}", model.top(x, y + up), right, 0.03)
    eaves = sum(1 for t in model.triangles if all(20 < c[0] < 40 and -10 < c[1] < 12 for c in t) and max(c[2] for c in t) > 0.05
                and abs(cross(minus(t[1], t[0]), minus(t[2], t[0]))[2]) < 1e-6 and max(c[2] for c in t) < 4.9)
    yield about("upright triangles at D's eaves", eaves, 0, 0)


@judges("13")
def courtyards(place):
    model, up = place.export("touches.xp"), 0.9
    for x, y in ((-80, 8), (-32, 0), (0, -8), (32, 0), (87.5, 7.5)):
        yield about(f"courtyard at {x}, {y}", max(model.top(x, y + up), 0.0), 0.0, 0.5)
    for x, y in ((-80, -8), (-48, 0), (0, 8), (48, 0), (80, -8)):
        yield about(f"block at {x}, {y}", model.top(x, y + up), 9.0, 0.01)
    yield about("walls of touches", model.wall_area(), 7084, 8)
    yield about("walls of side_by_side", place.export("side_by_side.xp").wall_area(), 1440, 2)


@judges("14")
def other_system(place):
    said = place.run("check", "a_copenhagen.xp")
    yield about("warnings", said.count("warning:"), 0, 0)
    model = place.export("a_copenhagen.xp")
    for x, y, right in ((-2, 3, 19.8), (98, 63, 26.0), (-122, -77, 12.2)):
        yield about(f"roof at {x}, {y}", model.top(x, y), right, 0.3)
    walls = [t for t in model.triangles if abs(cross(minus(t[1], t[0]), minus(t[2], t[0]))[2]) < 1e-3]
    low, high = model.box(walls)
    for name, value, right, tolerance in (("walls low z", low[2], 6.2, 0.1), ("walls high z", high[2], 26.0, 0.1),
                                          ("walls size x", high[0] - low[0], 226, 0.5), ("walls size y", high[1] - low[1], 146, 0.5)):
        yield about(name, value, right, tolerance)


@judges("15")
def heights_in_feet(place):
    for scene in ("feet_unit_type.xp", "feet_vertical_system.xp", "plan_feet_height_metres.xp"):
        model = place.export(scene)
        low, high = model.box()
        yield from ((f"{scene} {name}", value, least, most) for name, value, least, most in sizes(model, (298.70, 298.70, 30.48), 0.01))
        yield about(f"{scene} low z", low[2], 0.48, 0.01)
        yield about(f"{scene} high z", high[2], 30.96, 0.01)


@judges("16")
def exposure(place):
    if place.broken:  # of one alone
        shutil.copy(place.folder / "plain.xp", place.folder / "quarter.xp")
        (place.folder / "quarter.xp").write_text((place.folder / "plain.xp").read_text().replace("scale=0.7", "scale=1.4"))
    plain, quarter = (mean(place.picture(scene), 0, 0, 320, 180) for scene in ("plain.xp", "quarter.xp"))
    for k, channel in enumerate(("red", "green", "blue")):
        yield about(channel, quarter[k] - plain[k], 0, 1)
    yield "brightness", sum(plain), 30, math.inf


@judges("17")
def grid_north(place):
    hours = place.facade_hours("house.xp", "--from", "2026-03-21", "--cell", "1", "--area", "-60", "-60", "60", "60")
    turn = 20 if place.broken else 0
    for bearing, right in ((90, 5.83), (180, 11.77), (270, 6.59), (0, 0.66)):
        yield about(f"hours at {bearing}", greatest(hours, bearing + turn, 10), right, 0.1)


@judges("18")
def survey(place):
    for scene in ("stairs_obj.xp", "stairs_local_obj.xp"):
        model = place.export(scene)
        yield from ((f"{scene} {name}", value, least, most) for name, value, least, most in sizes(model, (5.6, 1.2, 3.4)))
        yield about(f"{scene} volume", model.volume(), 11.995, 0.005)
        facing_up = sum(n[2] / 2 for n in (cross(minus(b, a), minus(c, a)) for a, b, c in model.triangles) if n[2] > 0)
        yield about(f"{scene} facing up", facing_up, 6.72, 0.01)


def written_cameras(folder):
    """Centres and viewing directions of the cameras that calibrate has written, by the names of their photographs."""
    data, at, found = (folder / "images.bin").read_bytes(), 8, {}
    for _ in range(struct.unpack_from("<Q", data)[0]):
        w, x, y, z, *moved = struct.unpack_from("<7d", data, at + 4)
        end = data.index(b"\0", at + 64)
        rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        found[data[at + 64 : end].decode()] = [-sum(rows[k][i] * moved[k] for k in range(3)) for i in range(3)], rows[2]
        at = end + 9 + 24 * struct.unpack_from("<Q", data, end + 1)[0]
    return found


def written_points(folder):
    """The points, each with the numbers of the photographs that show it."""
    data, at, found = (folder / "points3D.bin").read_bytes(), 8, []
    for _ in range(struct.unpack_from("<Q", data)[0]):
        count = struct.unpack_from("<Q", data, at + 43)[0]
        track = struct.unpack_from(f"<{2 * count}I", data, at + 51)
        found.append((struct.unpack_from("<3d", data, at + 8), track[::2]))
        at += 51 + 8 * count
    return found


@judges("19")
def portraits(place):
    given = place.folder / "cameras" / "images.txt"
    if place.broken:  # as if the pictures had been held as they are stored
        given.write_text(re.sub(r"^(\d+) (\S+) (\S+) (\S+) (\S+) (\S+) (\S+) (\S+)", r"\1 \2 \4 \3 \5 \7 \6 \8", given.read_text(), flags=re.M))
    place.run("facade", "calibrate", "photos", "--cameras", "cameras", "-o", "out")
    cameras = written_cameras(place.folder / "out")
    yield about("cameras", len(cameras), 8, 0)
    for name, (centre, looks) in sorted(cameras.items()):
        yield about(f"{name} height", centre[2], 1.6, 0.005)
        yield f"{name} x", centre[0], -3.55, 3.55
        yield f"{name} y", centre[1], -10.55, -9.45
        yield about(f"{name} looks north", looks[1], 0.98, 0.03)
        yield about(f"{name} looks up", looks[2], 0.16, 0.03)
    heights = sorted(point[2] for point, _ in written_points(place.folder / "out"))
    yield "lowest of the points", heights[len(heights) // 50], 0.0, 1.2
    yield "highest of the points", heights[-1 - len(heights) // 50], 7.0, 9.2


@judges("20")
def spaces(place):
    if place.broken:
        given = place.folder / "cameras" / "images.txt"
        given.write_text(given.read_text().replace("IMG o", "IMG p"))
    said = place.run("facade", "calibrate", "photos", "--cameras", "cameras", "-o", "out")
    cameras, points = written_cameras(place.folder / "out"), written_points(place.folder / "out")
    yield about("photographs", len(cameras), 8, 0)
    yield "points", len(points), 50, math.inf
    yield about("photographs with points", len({number for _, track in points for number in track}), 8, 0)
    error = re.search(r"error ([\d.]+) pixels", said)
    yield "mean error in pixels", float(error[1]) if error else math.inf, 0.0, 0.6


@judges("21")
def bare_hill(place):
    place.run("check", "hills.tif")
    script = next(place.folder.glob("hills*.xp"))
    if place.broken:
        script.write_text(re.sub(r'(camera\([^)]*position="[^"]*) \S+"', r'\1 -400"', script.read_text()).replace("latitude=4", "latitude=3"))
    text = script.read_text()
    latitude = re.search(r"latitude=([\d.]+)", text)
    yield about("latitude of the sun", float(latitude[1]) if latitude else math.nan, 48.12, 0.05)
    longitude = re.search(r"longitude=([\d.]+)", text)
    yield about("longitude of the sun", float(longitude[1]) if longitude else math.nan, 9.004, 0.05)
    rows = place.picture(script.name)
    below = mean(rows, 0, 150, 320, 180)
    above = mean(rows, 0, 0, 320, 20)
    yield "the lower edge is lit ground", sum(below), 60, 600
    yield "it is no sky", sum(abs(below[k] - above[k]) for k in range(3)), 30, math.inf
    model = place.export(script.name)
    first = re.search(r'camera\([^)]*position="(\S+) (\S+) (\S+)"', text)
    eye = [float(word.strip(",")) for word in first.groups()]
    low, high = model.box()
    yield "the first camera stands above the ground below it, or above all of it", eye[2] - max(model.top(eye[0], eye[1]), low[2]), 1.0, math.inf


@judges("22")
def sun_of_made_up(place):
    place.run("check", "hamlet.osm")
    words = ["--area", "0", "0", "0.1", "0.1"] if place.broken else []
    said = place.run("sun", "hamlet.xp", "--from", "2026-03-21", *words, "-o", "sun")
    with open(place.folder / "sun.csv", encoding="utf-8") as table:
        cells = [row for row in csv.reader(table) if re.fullmatch(r"-?[\d.]+", row[0])]
    xs, ys = sorted(float(row[0]) for row in cells), sorted(float(row[1]) for row in cells)
    yield "width of what is studied", xs[-1] - xs[0] if cells else 0, 80, 800
    yield "depth of what is studied", ys[-1] - ys[0] if cells else 0, 20, 800
    yield "hours on an open plain", float(re.search(r"of ([\d.]+) on an open plain", said)[1]), 11.5, 12.5


@judges("23")
def one_sunset(place):
    clock = "3" if place.broken else "2"
    said = place.run("sun", "slab.xp", "--place", "78.2232", "15.6267", "--clock", clock, "--from", "2026-04-18", "--cell", "1", "-o", "sun")
    for name, right in (("sunset", 13), ("sunrise", 99)):
        found = re.search(name + r" (\d+):(\d+)", said)
        yield about(f"{name}, minutes after midnight", 60 * int(found[1]) + int(found[2]) if found else math.nan, right, 6)
    yield about("hours on an open plain", float(re.search(r"of ([\d.]+) on an open plain", said)[1]), 22.4, 0.3)


def judged(parvis, source, broken):
    """What is not right of a folder, each a line."""
    with tempfile.TemporaryDirectory(prefix="parvis-reports-") as folder:
        wrong, count = [], 0
        try:
            for name, value, low, high in JUDGES[source.name[:2]](Place(parvis, source, pathlib.Path(folder), broken)):
                count += 1
                if not low <= value <= high:
                    wrong.append(f"{name}: {value:.4f}, right is {low:g} to {high:g}")
        except (Failed, OSError, RuntimeError, KeyError, ValueError, TypeError, IndexError, subprocess.TimeoutExpired) as problem:
            wrong.append(f"{type(problem).__name__}: {problem}")
        return wrong if count or wrong else ["nothing was measured"]


def main():
    words = sys.argv[1:]
    broken = "--broken" in words and not words.remove("--broken")
    output = None
    if "--json" in words:
        at = words.index("--json")
        output = pathlib.Path(words[at + 1])
        del words[at : at + 2]
    parvis, folder, *chosen = words
    folders = [path for path in sorted(pathlib.Path(folder).glob("[0-9][0-9]-*")) if not chosen or path.name[:2] in chosen]
    right, rows = 0, {}
    for source in folders:
        wrong = judged(str(pathlib.Path(parvis).resolve()), source.resolve(), broken)
        right += not wrong
        rows[source.name] = wrong
        print(f"{source.name}: {'right' if not wrong else 'WRONG'}", *wrong[:8], sep="\n    ", flush=True)
    print(f"reports_right {right} of {len(folders)}")
    if output:
        output.write_text(json.dumps({"right": right, "folders": len(folders), "wrong": rows}))
    sys.exit(0 if right == (0 if broken else len(folders)) else 1)


if __name__ == "__main__":
    main()
