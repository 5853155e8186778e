"""The command as its users meet it: help, exit statuses, bad input, the window.

Usage: command_test.py PARVIS [unittest's arguments]. Exit status 0 is done, 1 failed, 2 bad usage.
"""

import base64
import csv
import glob
import importlib.machinery
import importlib.util
import json
import math
import os
import pathlib
import re
import shlex
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import wave
import zlib

PARVIS = None  # path of the program, from the command line
SUBCOMMANDS = ["view", "render", "bake", "reference", "compare", "check", "format", "export", "city", "plan", "photomontage", "sun", "facade", "tree", "car", "noise", "sound", "soundserver", "study", "share"]
SIZE = ["--size", "64x48"]


def run(*arguments, environment=None, before=()):
    """Runs `parvis` with `arguments`, after the command `before`; returns the finished process with its text."""
    return subprocess.run(
        [*before, PARVIS, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=240,
        env={**os.environ, **(environment or {})},
    )


def subcommands_in(help_text):
    """The names of the subcommands that a help lists."""
    return re.findall(r"^  ([a-z]+)(?= |$)", help_text.split("Subcommands:")[1], re.MULTILINE)


def triangle(positions=(0, 0, 0, 4, 0, 0, 0, 0, 4), indices=(0, 1, 2), claimed_bytes=None):
    """A glTF document of one triangle and the bytes of its buffer, true unless told otherwise."""
    data = struct.pack("<9f", *positions) + struct.pack("<3I", *indices)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "sail"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [4, 0, 4]},
            {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 12},
        ],
        "buffers": [{"byteLength": claimed_bytes or len(data)}],
    }
    return document, data


def gltf(document, data):
    """The text of a .gltf file with its buffer inside."""
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document)


def glb(document, data):
    """The bytes of a .glb file."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def city(version="1.1", last_index=2, has_polygons=True):
    """The text of a CityJSON file of one roof."""
    geometry = [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, last_index]]]}]
    return json.dumps(
        {
            "type": "CityJSON",
            "version": version,
            "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]},
            "CityObjects": {"roof": {"type": "Building", "geometry": geometry if has_polygons else []}},
            "vertices": [[0, 0, 3], [9, 0, 3], [9, 9, 3]],
        }
    )


def pixels(png):
    """The rows of an 8-bit PNG file as bytes, three or four a pixel, and how many."""
    width, height, channels, data, at = 0, 0, 3, b"", 8
    while at < len(png):
        size, kind = struct.unpack_from(">I4s", png, at)
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack_from(">IIBB", png, at + 8)
            channels = {2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            data += png[at + 8 : at + 8 + size]
        at += 12 + size
    data, row, rows = zlib.decompress(data), bytearray(width * channels), []
    for y in range(height):
        start = y * (width * channels + 1)
        method, line = data[start], bytearray(data[start + 1 : start + 1 + width * channels])
        for i in range(len(line)):
            left, up = (line[i - channels] if i >= channels else 0), row[i]
            corner = row[i - channels] if i >= channels else 0
            nearest = min((left, up, corner), key=lambda value: abs(left + up - corner - value))
            line[i] = (line[i] + (0, left, up, (left + up) // 2, nearest)[method]) % 256
        row = line
        rows.append(line)
    return rows, channels


class TimedResult(unittest.TextTestResult):
    """Prints the time of each test as GoogleTest does, for script/test."""

    def startTest(self, test):
        self.began = time.monotonic()
        super().startTest(test)

    def stopTest(self, test):
        super().stopTest(test)
        milliseconds = 1000 * (time.monotonic() - self.began)
        self.stream.writeln(f"[     TIME ] {type(test).__name__}.{test._testMethodName} ({milliseconds:.0f} ms)")


class InAFolder(unittest.TestCase):
    """Each test has an empty folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="parvis-command-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, content):
        """Writes a file of text or bytes and returns its path."""
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def files(self):
        """All that lies in the folder."""
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def expect_failure(self, *arguments, words, environment=None):
        """Status 1, a message that holds each of `words`, and no file more or less than before."""
        before = self.files()
        done = run(*arguments, environment=environment)
        self.assertEqual(done.returncode, 1, f"{arguments}: {done.stdout}{done.stderr[:2000]}")
        for word in words:
            self.assertIn(word, done.stderr[:20000], arguments)
        self.assertLess(len(done.stderr), 20000, "a message, not a flood")
        self.assertEqual(self.files(), before, "nothing half-written")

    def expect_bad_scene(self, script, *words, is_rendered=False):
        """`check` fails, and `render` of one scene of each class, with a message that holds `words`."""
        scene = self.write("scene.xp", script)
        self.expect_failure("check", scene, words=words)
        if is_rendered:
            self.expect_failure("render", scene, *SIZE, "-o", self.folder / "out.png", words=words)

    def expect_bad_model(self, name, content, *words, is_rendered=False):
        """The same for a model file in a right scene; the message names the file."""
        self.write(name, content)
        self.expect_bad_scene(f'sun()\nmodel(file="{name}")\n', name, *words, is_rendered=is_rendered)

    def expect_warning(self, name, content, *words, is_rendered=False):
        """A model file that is read but for what a warning names."""
        self.write(name, content)
        scene = self.write("scene.xp", f'model(file="{name}")\ncamera(name="a", position="0 -9 2")\n')
        for command in [["check", scene], ["render", scene, *SIZE, "-o", self.folder / "out.png"]][: 1 + is_rendered]:
            done = run(*command)
            self.assertEqual(done.returncode, 0, done.stderr)
            for word in ["warning", name, *words]:
                self.assertIn(word, done.stdout + done.stderr)


class Usage(InAFolder):
    def test_every_subcommand_has_help_with_an_example(self):
        overview = run("--help")
        self.assertEqual(overview.returncode, 0)
        for command in SUBCOMMANDS:
            done = run(command, "--help")
            self.assertEqual(done.returncode, 0, command)
            self.assertIn("Example: parvis " + command, done.stdout)
        self.assertEqual(sorted(subcommands_in(overview.stdout)), sorted(SUBCOMMANDS))

    def test_every_stage_of_a_subcommand_has_help_with_an_example(self):
        for command in ["facade", "tree"]:
            stages = subcommands_in(run(command, "--help").stdout)
            self.assertGreaterEqual(len(stages), 10, command)
            for stage in stages:
                done = run(command, stage, "--help")
                self.assertEqual(done.returncode, 0, (command, stage))
                self.assertIn(f"Example: parvis {command} {stage}", done.stdout)

    def test_a_scene_or_a_part_of_it_is_exported(self):
        self.write("sail.glb", glb(*triangle()))
        scene = self.write(
            "scene.xp",
            'model(name="a", file="sail.glb")\nmodel(name="b", file="sail.glb", position="9 0 0")\n'
            'model(file="sail.glb", visible=false)\ncamera(name="eye", position="0 -9 2")\n',
        )
        for options, objects in [([], ["a", "b"]), (["--object", "b"], ["b"])]:
            done = run("export", scene, *options, "-o", self.folder / "out.glb")
            self.assertEqual(done.returncode, 0, done.stderr)
            data = (self.folder / "out.glb").read_bytes()
            document = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
            nodes = [document["nodes"][child] for child in document["nodes"][0]["children"]]
            self.assertEqual([node["name"] for node in nodes], objects + ["eye"])
            self.assertEqual(len(document["meshes"]), 1, "objects of one model share its mesh")
        (self.folder / "out.glb").unlink()
        output = ["-o", self.folder / "new.glb"]
        self.expect_failure("export", scene, "--object", "aa", *output, words=["aa", 'did you mean "a"'])
        self.expect_failure("export", scene, "-o", self.folder / "new.obj", words=["new.obj", ".glb"])

    def test_the_version_is_printed(self):
        shown = run("--version")
        self.assertEqual(shown.returncode, 0)
        self.assertRegex(shown.stdout, r"^parvis \d+\.\d+\.\d+\n$")

    def test_a_data_folder_that_does_not_exist_is_named_with_those_beside_it(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "a.xp")
            scene.write_text("sun()\n")
            pathlib.Path(folder, "towns").mkdir()
            for command in ("check", "render"):
                said = run(command, scene, "--data", pathlib.Path(folder, "town"),
                           *([*SIZE, "-o", pathlib.Path(folder, "a.png")] if command == "render" else []))
                self.assertIn('has no folder "town"; did you mean "towns"?', said.stderr)

    def test_bad_usage_is_status_2(self):
        for arguments in [
            [],
            ["dance"],
            ["render"],
            ["render", "a.xp", "--no-such-option"],
            ["render", "a.xp", "--fps", "0"],
            ["city", "paper"],
        ]:
            done = run(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertTrue(done.stderr, arguments)

    def test_what_fails_is_status_1(self):
        scene = self.write("scene.xp", "sun()\n")
        absent = self.folder / "absent.xp"
        self.expect_failure("check", absent, words=["absent.xp"])
        self.expect_failure("render", scene, "--size", "wide", words=["--size wide"])
        self.expect_failure("render", scene, *SIZE, "--camera", "roof", words=["roof"])
        self.expect_failure("render", scene, *SIZE, "--reflection", "chrome", words=["shared_cube_map"])
        self.expect_failure("compare", self.folder / "a.png", self.folder / "b.png", words=["a.png"])

    def test_a_right_scene_is_checked_and_drawn(self):
        self.write("sail.glb", glb(*triangle()))
        scene = self.write("scene.xp", 'sun()\nmodel(file="sail.glb")\ncamera(name="a", position="0 -9 2")\n')
        self.assertEqual(run("check", scene).returncode, 0)
        done = run("render", scene, *SIZE, "-o", self.folder / "out.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "out.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(self.files(), ["out.png", "sail.glb", "scene.xp"])


MIRROR = 'model(file="mirror.obj", dynamic=1, reflective=1) { material(preset="chrome") }\n'


DRIVE = [
    'road(path="-30 -3 0, 30 -3 0")',
    'traffic(vehicles=2, seed=3) { model(file="mirror.obj", dynamic=1, reflective=1) }',
    'camera(name="drive", follows="vehicle 1", offset="-6 -3 2")',
]


class BeforeAMirror(InAFolder):
    """A mirror in a place of ground and a wall."""

    def setUp(self):
        super().setUp()
        self.write_quad("mirror.obj", (-2, 0, 0), (2, 0, 0), (2, 0, 3), (-2, 0, 3))
        self.write_quad("ground.obj", (-40, -40, 0), (40, -40, 0), (40, 40, 0), (-40, 40, 0))
        self.write_quad("wall.obj", (40, -20, 0), (-40, -20, 0), (-40, -20, 9), (40, -20, 9))

    def write_quad(self, name, *corners):
        """The corners are in world coordinates, z up; Wavefront files have y up."""
        self.write(name, "".join(f"v {x} {z} {-y}\n" for x, y, z in corners) + "f 1 2 3 4\n")

    def write_place(self, *nodes):
        """A mirror before a wall, looked at from the wall's side."""
        place = 'model(file="ground.obj")\nmodel(file="wall.obj")\n' + MIRROR + "sun()\n"
        camera = 'camera(name="eye", position="1 -5 1.6", target="0 0 1.5")\n'
        return self.write("scene.xp", place + camera + "\n".join(nodes))

    def render(self, scene, method="multiple_environment_maps"):
        """What is said, and the pixels in the mirror's middle."""
        out = self.folder / "out.png"
        done = run("render", scene, *SIZE, "--reflection", method, "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows, channels = pixels(out.read_bytes())
        middle = [rows[y][x * channels : x * channels + 3] for y in range(16, 32) for x in range(24, 40)]
        return done.stderr, middle


class Reflections(BeforeAMirror):
    """Methods that the command names, places too large for maps, and kept maps that are damaged."""

    def test_the_method_of_the_command_line_holds_in_a_scenario_with_another(self):
        mirrored = 'scenario(name="plain") { override(of="%reflection", method="none") }\n'
        scene = self.write_place('reflection(method="rerendered_cube_map")', mirrored)

        def picture(*options):
            out = self.folder / "out.png"
            done = run("render", scene, *SIZE, *options, "-o", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            return out.read_bytes()

        plain, mirror = picture("--scenario", "plain"), picture()
        self.assertTrue(plain != mirror, "the control: the scenario shows something else")
        self.assertTrue(picture("--scenario", "plain", "--reflection", "rerendered_cube_map") == mirror)
        self.assertTrue(picture("--reflection", "none") == plain)

    def test_heights_that_memory_would_not_hold(self):
        far = 'model(file="ground.obj", position="90000 60000 0")'
        told, middle = self.render(self.write_place(far))
        self.assertGreater(min(map(sum, middle)), 30)
        for word in ["90.1 x 60.1 km", "would take 34360 MB", "referenceMaps(cell="]:
            self.assertIn(word, told)

    def test_kept_maps_of_another_version_or_cut_short(self):
        scene = self.write_place('referenceMaps(position="0 -3 1.2", position="0 -9 1.2")')
        done = run("bake", scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        maps = sorted(self.folder.glob("scene.baked/*/*.map"))
        self.assertEqual(len(maps), 2)
        told, right = self.render(scene)
        self.assertNotIn("warning", told)
        whole = maps[0].read_bytes()
        for damaged, word in [(b"PARVISM0" + whole[8:], "another version"), (whole[: len(whole) // 2], "cut short"),
                              (b"", "no reference map")]:
            maps[0].write_bytes(damaged)
            told, middle = self.render(scene)
            self.assertIn(maps[0].name, told)
            self.assertIn(word, told)
            self.assertIn("rendered again", told)
            self.assertEqual(middle, right)

    def test_a_square_is_written_and_right(self):
        square = self.folder / "square"
        self.assertEqual(run("city", "square", "-o", square).returncode, 0)
        for script in ["place.xp", "square.xp"]:
            done = run("check", square / script)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Orange trees, without cars", done.stdout)
        picture = self.folder / "fountain.png"
        done = run("render", square / "place.xp", *SIZE, "-o", picture)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(picture.exists())

    def test_a_kitchen_of_mirrors_is_written_and_drawn(self):
        kitchen = self.folder / "kitchen"
        self.assertEqual(run("city", "kitchen", "-o", kitchen).returncode, 0)
        for script in ["kitchen.xp", "glass.xp"]:
            done = run("check", kitchen / script)
            self.assertEqual(done.returncode, 0, done.stderr)
        picture = self.folder / "kettle.png"
        cube_maps = ["--reflection", "rerendered_cube_map"]  # virtual objects take a minute with software GL
        done = run("render", kitchen / "kitchen.xp", "--camera", "at the kettle", *cube_maps, *SIZE, "-o", picture)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(picture.exists())


class HoursOfSun(BeforeAMirror):
    """`parvis sun` over a plain."""

    def study(self, *nodes, area=(-10, -10, 10, 10), options=("--from", "2026-03-21")):
        """What is said, and the hours in the middle of the area."""
        scene = self.write("scene.xp", "\n".join(['model(file="ground.obj")', *nodes]))
        place = ["--place", "43.7", "7.27", "--area", *area, "--cell", "1"]
        done = run("sun", scene, *place, *options, "-o", self.folder / "out")
        hours = [float(row["hours"]) for row in csv.DictReader((self.folder / "out.csv").read_text().splitlines())]
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, hours[len(hours) // 2 + 10] if hours else None

    def test_sunrise_and_the_files_are_named(self):
        said, hours = self.study()
        self.assertIn("2026-03-21: sunrise 05:3", said)
        self.assertIn("sunset 17:4", said)
        self.assertIn("BRE 209 is kept", said)
        for name in [".png", ".csv", "_facades.csv", ".glb", "_sun_hours.jpg"]:
            self.assertIn(name, said)
            self.assertTrue((self.folder / f"out{name}").exists(), name)
        self.assertGreater(hours, 11)

    def test_the_clock_of_a_place(self):
        said, _ = self.study(options=["--from", "2026-03-21", "--clock", "1"])
        self.assertIn("sunrise 06:3", said)
        self.assertIn("UTC+1", said)

    def test_the_sun_of_a_place_and_day_without_a_scene(self):
        done = run("sun", "--place", "43.7,7.26", "--clock", "2", "--date", "2026-06-21")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("2026-06-21: sunrise 05:49, sunset 21:16, at UTC+2", done.stdout)
        self.assertRegex(done.stdout, r"13:3\d +(179\.9|180\.0)\d* +69\.7\d*  highest")
        for date, words in (("2026-08-24", "the sun does not set"), ("2026-08-25", "sunset 00:29, sunrise 01:33, sunset 23:56")):
            said = run("sun", "--place", "78.2232,15.6267", "--clock", "2", "--date", date).stdout
            self.assertIn(f"{date}: {words}", said)
        self.assertEqual(run("sun", "--date", "2026-06-21").returncode, 2)
        self.assertEqual(run("sun", "--place", "43.7,7.26").returncode, 1)

    def test_a_polar_night_has_no_hours(self):
        scene = self.write("scene.xp", 'model(file="ground.obj")\n')
        place = ["--place", "78", "15", "--area", "-10", "-10", "10", "10", "--cell", "1"]
        done = run("sun", scene, *place, "--from", "2026-12-21", "-o", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the sun does not rise", done.stdout)
        rows = list(csv.DictReader((self.folder / "out.csv").read_text().splitlines()))
        self.assertEqual({float(row["hours"]) for row in rows}, {0.0})

    def test_a_date_and_a_place_that_are_none(self):
        scene = self.write("scene.xp", 'model(file="ground.obj")\n')
        for place, date, words in [
            (["43.7", "7.27"], "2026-02-30", ["2026-02-30 is not a date"]),
            (["91", "0"], "2026-03-21", ["latitude=91", "north pole"]),
        ]:
            self.expect_failure("sun", scene, "--place", *place, "--from", date, "-o", self.folder / "out", words=words)

    def test_what_visitors_may_move_casts_its_shadow(self):
        self.write_quad("screen.obj", (40, -4, 0), (-40, -4, 0), (-40, -4, 30), (40, -4, 30))
        self.assertLess(self.study('object(file="screen.obj", grab=1, wall=0)')[1], 2)
        self.assertGreater(self.study('model(file="screen.obj", dynamic=1)')[1], 11)

    def test_an_area_without_ground(self):
        said, hours = self.study(area=(100, 100, 120, 120))
        self.assertIn("no open ground", said)
        self.assertNotIn("BRE 209 is", said)
        self.assertNotIn(".glb", said)
        self.assertIsNone(hours)

    def test_a_facade_that_faces_north_sees_no_sun(self):
        self.write_quad("south.obj", (-6, 0, 0), (6, 0, 0), (6, 0, 8), (-6, 0, 8))
        self.write_quad("north.obj", (6, 1, 0), (-6, 1, 0), (-6, 1, 8), (6, 1, 8))
        self.study('model(file="south.obj")', 'model(file="north.obj")')
        rows = list(csv.DictReader((self.folder / "out_facades.csv").read_text().splitlines()))
        south = [float(row["hours"]) for row in rows if float(row["normal_y"]) < -0.9]
        north = [float(row["hours"]) for row in rows if float(row["normal_y"]) > 0.9]
        self.assertGreater(min(south), 9)
        self.assertLess(max(north), 1)

    def test_a_building_inside_out_is_no_open_ground(self):
        corners = [(x, y, z) for z in (0, 6) for x, y in ((-5, -5), (5, -5), (5, 5), (-5, 5))]
        sides = ["4 3 2 1", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"]
        vertices = "".join(f"v {x} {z} {-y}\n" for x, y, z in corners)
        self.write("right.obj", vertices + "".join(f"f {side}\n" for side in sides))
        self.write("inside_out.obj", vertices + "".join(f"f {' '.join(reversed(side.split()))}\n" for side in sides))
        right, inside_out = (self.study(f'model(file="{name}.obj")')[0].split("open ground:")[1].split("m2")[0] for name in ("right", "inside_out"))
        self.assertEqual(right, inside_out)

    def test_a_winter(self):
        winter = self.study(options=["--from", "2026-12-01", "--to", "2027-02-28", "--every", "15"])[1]
        self.assertTrue(9 < winter < 10.5, winter)
        scene = self.folder / "scene.xp"
        for last in ["2026-11-30", "2027-12-02"]:
            options = ["--place", "43.7", "7.27", "--from", "2026-12-01", "--to", last, "-o", self.folder / "out"]
            done = run("sun", scene, *options)
            self.assertEqual(done.returncode, 1)
            self.assertIn("366 days at most", done.stderr)

    def test_named_ground_and_an_outline(self):
        self.write_quad("lawn.obj", (2, 2, 0.1), (8, 2, 0.1), (8, 8, 0.1), (2, 8, 0.1))
        lawn, equinox = 'model(name="lawn", file="lawn.obj")', ["--from", "2026-03-21"]
        said, _ = self.study(lawn, options=[*equinox, "--ground", "la*"])
        self.assertIn('ground "la*": 36 m2, 100.0 % with 2 h or more: BRE 209 is kept', said)
        outline = ["--outline", "-5 -5, 5 -5, 5 5, -5 5"]
        said, _ = self.study(lawn, options=[*equinox, *outline])
        self.assertIn("open ground in the outline: 100 m2", said)
        said, _ = self.study(lawn, options=[*equinox, *outline, "--ground", "lawn"])
        self.assertIn('ground "lawn" in the outline: 9 m2', said)
        judged = [row["judged"] for row in csv.DictReader((self.folder / "out.csv").read_text().splitlines())]
        self.assertEqual(judged.count("1"), 9)
        self.assertEqual(len(judged), 400)

    def test_ground_that_is_none(self):
        self.write_quad("lawn.obj", (2, 2, 0.1), (8, 2, 0.1), (8, 8, 0.1), (2, 8, 0.1))
        scene = self.write("scene.xp", 'model(file="ground.obj")\nmodel(name="lawn", file="lawn.obj")\n')
        place = ["--place", "43.7", "7.27", "--area", "-10", "-10", "10", "10", "--from", "2026-03-21"]
        for options, words in [
            (["--ground", "laun"], ['"laun"', '"lawn"', "did you mean"]),
            (["--outline", "0 0, 4 0"], ["--outline", "3 to 1000 corners; this one has 2"]),
            (["--outline", "0 0, 4 4, 4 0, 0 4"], ["--outline", "crosses itself"]),
            (["--outline", "0 0, 4 north, 4 4"], ["--outline", "expected points"]),
            (["--outline", "0 0, 40 0, 40 40"], ["--outline", "40 0 lies outside of --area"]),
        ]:
            self.expect_failure("sun", scene, *place, *options, "-o", self.folder / "out", words=words)
        done = run("sun", scene, *place, "--ground", "lawn", "--film", self.folder / "out.mp4")
        self.assertEqual(done.returncode, 2)

    def test_a_film_of_a_day(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("skipped: no ffmpeg here")
        east, west = [(0, -10, 0), (0, 10, 0), (0, 10, 12), (0, -10, 12)], [(0, 10, 0), (0, -10, 0), (0, -10, 12), (0, 10, 12)]
        self.write_quad("east.obj", *east)
        self.write_quad("west.obj", *west)
        models = "".join(f'model(file="{name}.obj")\n' for name in ("ground", "east", "west"))
        day = "dayLight(latitude=43.70, longitude=7.27, standardMeridian=1, julianDay=172)\nsunPath(radius=24)\n"
        scene = self.write("scene.xp", day + models + 'camera(name="above", position="0 -1 60", target="0 0 0")\n')
        film = self.folder / "day.mp4"
        done = run("sun", scene, "--from", "2026-03-21", "--step", "60", *SIZE, "--film", film)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([name for name in self.files() if "partial" in name], [])
        subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-pix_fmt", "rgb24", self.folder / "frame%02d.png"], check=True)
        frames = [pixels(path.read_bytes()) for path in sorted(self.folder.glob("frame*.png"))]
        self.assertEqual(len(frames), 13, "one an hour between sunrise and sunset, 12 h and some minutes apart")

        def brightness(frame, columns):
            rows, channels = frame
            values = [value for row in rows[20:28] for value in row[columns.start * channels : columns.stop * channels]]
            return sum(values) / len(values)

        for before, after in zip(frames, frames[1:]):
            self.assertEqual((len(before[0]), len(before[0][0])), (48, 64 * before[1]))
            self.assertNotEqual(before[0], after[0], "the sun moves")
        for frame in frames[1:-1]:
            self.assertGreater(brightness(frame, slice(0, 64)), 20, "black")
        # West and east of the wall, whose shadow goes round with the sun.
        left, right = slice(12, 28), slice(36, 52)
        for frame, shaded, lit in [(frames[2], left, right), (frames[-3], right, left)]:
            self.assertLess(brightness(frame, shaded), 0.85 * brightness(frame, lit))

    def test_a_film_of_a_polar_night(self):
        scene = self.write("scene.xp", 'dayLight(latitude=78.2, longitude=15.6)\nmodel(file="ground.obj")\ncamera(name="a", position="0 -9 2")\n')
        self.expect_failure("sun", scene, "--from", "2026-12-21", *SIZE, "--film", self.folder / "day.mp4", words=["does not rise"])


# Both processes share the cores: bound to one each, they would be slower where tests run side by side.
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", "2"]


class Divided(BeforeAMirror):
    """Work that mpirun divides."""

    def setUp(self):
        super().setUp()
        if not shutil.which("mpirun"):
            self.skipTest("skipped: no mpirun here (package openmpi-bin)")

    def expect_done(self, *arguments, before=()):
        done = run(*arguments, before=before)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def expect_same(self, output, *arguments):
        """Alone and divided, the command writes the same bytes."""
        self.expect_done(*arguments)
        alone = output.read_bytes()
        output.unlink()
        self.expect_done(*arguments, before=MPIRUN)
        self.assertEqual(output.read_bytes(), alone)

    def process_of_rank(self, rank, parent):
        """The number of mpirun's child of this rank."""
        for status in pathlib.Path("/proc").glob("[0-9]*/status"):
            try:
                is_child = f"PPid:\t{parent}\n" in status.read_text()
                environment = (status.parent / "environ").read_bytes() if is_child else b""
            except OSError:
                continue
            if f"OMPI_COMM_WORLD_RANK={rank}".encode() in environment.split(b"\0"):
                return int(status.parent.name)
        self.fail(f"mpirun has no child of rank {rank}")


class SeveralProcesses(Divided):
    """Baked maps of two processes are those of one bit for bit; what cannot be divided is refused."""

    def test_baked_maps(self):
        scene = self.write_place('referenceMaps(position="0 -3 1.2", position="0 -9 1.2", position="4 -9 1.2")')
        told = [self.expect_done("bake", scene).stdout]
        alone = {path.name: path.read_bytes() for path in self.folder.glob("scene.baked/*/*.map")}
        self.assertEqual(len(alone), 3)
        shutil.rmtree(self.folder / "scene.baked")
        told.append(self.expect_done("bake", scene, before=MPIRUN).stdout)
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.glob("scene.baked/*/*.map")}, alone)
        self.assertEqual(told[0], told[1], "only the first process prints")

    def test_frames_of_a_film_behind_a_link_are_left_alone(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        (self.folder / "out.mp4.frames").symlink_to(elsewhere)
        done = run("render", self.write_place(*DRIVE), *SIZE, "--seconds", "0.2", "--reflection", "none", "-o", self.folder / "out.mp4")
        self.assertEqual(done.returncode, 1)
        self.assertIn("is a link", done.stderr)
        self.assertEqual(list(elsewhere.iterdir()), [])

    def test_a_film_whose_frames_depend_on_each_other(self):
        done = run("render", self.write_place(*DRIVE), *SIZE, "--seconds", "0.5", "--reflection", "time_sliced_cube_map",
                   "-o", self.folder / "out.mp4", before=MPIRUN)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("without mpirun", done.stderr)

    def test_an_error_ends_all(self):
        missing = self.folder / "missing.xp"
        done = run("bake", missing, before=MPIRUN)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("missing.xp", done.stderr)


class AllDividedWork(Divided):
    """All other work that is divided, and work that is killed and resumed: with script/test --full."""

    def test_a_reference_picture(self):
        picture = self.folder / "out.exr"
        self.expect_same(picture, "reference", self.write_place(), "--size", "160x120", "--samples", "4", "-o", picture)

    def test_a_photograph(self):
        picture = self.folder / "out.exr"
        scene, options = self.write_place(), ["--path-traced", "--size", "160x120", "--samples", "4"]
        self.expect_same(picture, "reference", scene, *options, "-o", picture)
        self.assertEqual([name for name in self.files() if "checkpoint" in name], [])

    def test_hours_of_sun(self):
        plan = self.folder / "out.csv"
        options = ["--place", "43.7", "7.27", "--from", "2026-03-21", "--area", "-4", "-4", "4", "4", "--cell", "0.2"]
        self.expect_same(plan, "sun", self.write_place(), *options, "--ground-only", "-o", self.folder / "out")

    def test_a_film(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("skipped: no ffmpeg here")
        film = self.folder / "out.mp4"
        scene = self.write_place(*DRIVE)
        command = ["render", scene, *SIZE, "--camera", "drive", "--seconds", "0.5", "--fps", "12", "-o", film]
        self.expect_same(film, *command)
        self.assertEqual([name for name in self.files() if "frames" in name], [])

    def test_a_film_goes_on_with_the_frames_that_are_there(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("skipped: no ffmpeg here")
        film, frames = self.folder / "out.mp4", self.folder / "out.mp4.frames"
        scene = self.write_place(*DRIVE)
        command = ["render", scene, *SIZE, "--camera", "drive", "--seconds", "1", "--fps", "12", "-o", film]
        self.expect_done(*command)
        alone = film.read_bytes()
        film.unlink()
        long = [*command[:-4], "--fps", "12", "-o", film]
        long[long.index("--seconds") + 1] = "900"
        process = subprocess.Popen(
            [*MPIRUN, PARVIS, *map(str, long)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        while process.poll() is None and not (frames.exists() and len(list(frames.glob("[!.]*.frame"))) > 6):
            time.sleep(0.02)
        self.assertIsNone(process.poll(), "it ended too soon for this test")
        os.kill(self.process_of_rank(1, process.pid), signal.SIGKILL)
        process.communicate(timeout=60)
        self.assertFalse(film.exists())
        whole = {path.name: path.read_bytes() for path in frames.glob("[!.]*.frame")}
        self.assertGreater(len(whole), 6)
        self.expect_done(*command, before=MPIRUN)
        self.assertEqual(film.read_bytes(), alone)
        self.assertFalse(frames.exists())
        # Another frame in the place of one is rendered again; and so is one that is no frame at all.
        frames.mkdir()
        names = sorted(name for name in whole if int(name[-12:-6]) < 12)
        self.assertGreater(len(names), 2, "frames of the short film")
        for name in names:
            (frames / name).write_bytes(whole[names[0]])
        (frames / names[-1]).write_bytes(b"none")
        film.unlink()
        told = self.expect_done(*command, before=MPIRUN).stderr
        self.assertEqual(told.count("is another frame"), len(names) - 2, told[:2000])
        self.assertIn(names[-1], told)
        self.assertEqual(film.read_bytes(), alone)

    def test_a_process_that_dies_ends_the_run_and_the_work_goes_on(self):
        scene, picture = self.write_place(), self.folder / "out.exr"
        command = ["reference", scene, "--path-traced", "--size", "320x256", "--samples", "256", "-o", picture]
        checkpoint = self.folder / "out.exr.checkpoint"
        process = subprocess.Popen(
            [*MPIRUN, PARVIS, *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        tile = 32 * 32 * 5 * 4
        while process.poll() is None and not (checkpoint.exists() and checkpoint.stat().st_size > 3 * tile):
            time.sleep(0.02)
        self.assertIsNone(process.poll(), "it ended too soon for this test")
        os.kill(self.process_of_rank(1, process.pid), signal.SIGKILL)
        _, told = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("rank 1", told)
        self.assertFalse(picture.exists())
        kept = checkpoint.stat().st_size
        self.assertGreater(kept, 3 * tile)
        done = self.expect_done(*command)
        self.assertFalse(checkpoint.exists())
        resumed, rays = picture.read_bytes(), float(done.stdout.split()[1])
        picture.unlink()
        done = self.expect_done(*command)
        self.assertEqual(picture.read_bytes(), resumed)
        self.assertLess(rays, 0.98 * float(done.stdout.split()[1]), "finished tiles are not traced again")


class CurvedMirrors(BeforeAMirror):
    """Balls that are no balls, as curved mirrors: a picture all the same, and a word of what was done."""

    def write_ball(self, keep=lambda i, j: True, turned=lambda i, j: False, rings=12):
        """Of squares of two triangles, without normals; square (i, j) is kept, and turned over, as is said."""
        lines = []
        for i in range(rings + 1):
            for j in range(2 * rings):
                polar, turn = math.pi * i / rings, math.pi * j / rings
                x, y = math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn)
                lines.append(f"v {x} {math.cos(polar) + 1.2} {-y}")  # OBJ: y is up
        at = lambda i, j: 1 + i * 2 * rings + j % (2 * rings)
        for i in range(rings):
            for j in range(2 * rings):
                square = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
                if keep(i, j):
                    for corners in (square[:3], [square[0], *square[2:]]):
                        ordered = reversed(corners) if turned(i, j) else corners
                        lines.append("f " + " ".join(map(str, ordered)))
        self.write("mirror.obj", "\n".join(lines) + "\n")

    def expect_picture(self, *words, scene=None):
        """Virtual objects show light in the mirror, the same each time, and tell `words`."""
        scene = scene or self.write_place()
        told, middle = self.render(scene, "virtual_objects")
        self.assertGreater(min(map(sum, middle)), 30, "black pixels")
        self.assertEqual(self.render(scene, "virtual_objects")[1], middle)
        for word in words:
            self.assertIn(word, told)

    def test_holes(self):
        self.write_ball(keep=lambda i, j: i != 3 or j % 4)
        self.expect_picture("holes are closed for the search")

    def test_triangles_turned_over(self):
        self.write_ball(turned=lambda i, j: (i * 7 + j) % 5 == 0)
        self.expect_picture("ran the other way round")

    def test_a_single_triangle(self):
        self.write("mirror.obj", "v -3 0 0\nv 3 0 0\nv 0 5 0\nf 1 2 3\n")
        self.expect_picture()

    def test_edges_of_three_triangles(self):
        self.write("mirror.obj", "v -3 0 0\nv 3 0 0\nv 0 5 0\nv 0 2 2\nv 0 2 -2\nf 1 2 3\nf 1 2 4\nf 1 2 5\n")
        self.expect_picture("have not two triangles")

    def test_a_viewer_inside(self):
        self.write_ball()
        eye = 'camera(name="inside", position="0 0 1.2", target="0 9 1.2")'
        scene = self.write_place(eye)
        out = self.folder / "out.png"
        done = run("render", scene, *SIZE, "--camera", "inside", "--reflection", "virtual_objects", "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(out.exists())

    def test_things_that_touch_and_cross_it(self):
        self.write_ball()
        self.write_quad("shelf.obj", (-2, -2, 1), (2, -2, 1), (2, 2, 1.4), (-2, 2, 1.4))
        self.expect_picture(scene=self.write_place('model(file="shelf.obj")'))

    def test_a_million_vertices_beside_it(self):
        self.write_ball()
        side = 1000
        positions = struct.pack(
            f"<{3 * side * side}f", *(v for i in range(side * side) for v in (i % side / 100 - 5, 0.05, i // side / 100 - 5)))
        cells = ((y * side + x) for y in range(side - 1) for x in range(side - 1))
        indices = struct.pack(f"<{6 * (side - 1) ** 2}I", *(v for a in cells for v in (a, a + side, a + 1, a + 1, a + side, a + side + 1)))
        document, _ = triangle()
        document["accessors"][0].update(count=side * side, min=[-5, 0.05, -5], max=[4.99, 0.05, 4.99])
        document["accessors"][1]["count"] = 6 * (side - 1) ** 2
        document["bufferViews"] = [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
        ]
        document["buffers"][0]["byteLength"] = len(positions) + len(indices)
        self.write("field.glb", glb(document, positions + indices))
        told, middle = self.render(self.write_place('model(file="field.glb")'), "virtual_objects")
        self.assertGreater(min(map(sum, middle)), 30)

    def test_kept_reflectors_of_another_version_or_cut_short(self):
        self.write_ball()
        scene = self.write("scene.xp", self.write_place().read_text() + '\nreflection(method="virtual_objects")\n')
        done = run("bake", scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        (kept,) = self.folder.glob("scene.baked/reflectors/*.reflector")
        told, right = self.render(scene, "virtual_objects")
        self.assertNotIn("rebuilt", told)
        whole = kept.read_bytes()
        for damaged, word in [(b"PARVISR0" + whole[8:], "another version"), (whole[: len(whole) // 2], "cut short")]:
            kept.write_bytes(damaged)
            told, middle = self.render(scene, "virtual_objects")
            self.assertIn(word, told)
            self.assertIn("rebuilt", told)
            self.assertEqual(middle, right)

    KINDS_OF_KEPT_FILES = {"*/*.map": "map", "reflectors/*.reflector": "reflector", "bounced_light/*.transfer": "bounced light"}

    def write_all_kinds(self):
        """A scene of which every kind of result is kept."""
        self.write_ball(rings=8)
        nodes = ['referenceMaps(position="0 -3 1.2")', "bouncedLight(spacing=20, rays=16)",
                 'reflection(method="multiple_environment_maps", virtual_within=4)']
        return self.write_place(*nodes)

    def bake(self, scene):
        done = run("bake", scene)
        self.assertEqual(done.returncode, 0, done.stderr)

    def kept_files(self, kind):
        kept = list(self.folder.glob(f"scene.baked/{kind}"))
        self.assertTrue(kept, kind)
        return kept

    def test_a_flipped_bit_in_any_kept_file_is_noticed(self):
        scene = self.write_all_kinds()
        self.bake(scene)
        told, right = self.render(scene)
        self.assertNotIn("damaged", told)
        for kind, name in self.KINDS_OF_KEPT_FILES.items():
            kept = self.kept_files(kind)[0]
            whole = kept.read_bytes()
            for at in [9, len(whole) // 2, len(whole) - 1]:
                flipped = bytearray(whole)
                flipped[at] ^= 0x10
                kept.write_bytes(flipped)
                told, middle = self.render(scene)
                self.assertIn(f"{kept.name}: is cut short or damaged", told, (name, at))
                self.assertEqual(middle, right, (name, at))
            kept.write_bytes(whole)

    def test_two_that_bake_one_scene_at_once_both_succeed(self):
        scene = self.write_all_kinds()
        self.bake(scene)
        alone = {path: path.read_bytes() for kind in self.KINDS_OF_KEPT_FILES for path in self.kept_files(kind)}
        for _ in range(3):
            shutil.rmtree(self.folder / "scene.baked")
            both = [subprocess.Popen([PARVIS, "bake", scene], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for _ in range(2)]
            for process in both:
                told = process.communicate(timeout=240)[1]
                self.assertEqual(process.returncode, 0, told)
            kept = {path: path.read_bytes() for path in (self.folder / "scene.baked").glob("*/*")}
            self.assertEqual(kept, alone)


class Photomontages(InAFolder):
    """A design in a photograph, whose camera six clicked points tell."""

    SCENE = """dayLight(latitude=43.70, longitude=7.27, standardMeridian=2, julianDay=1, timeOfDay=12)
skyDome()
model(name="floor", file="floor.obj", up=z)
design(name="stone") { placed(name=bench, kind=bench_stone, position="0 0 0", heading_deg=180) }
camera(name="street", position="0 -8 3", target="0 0 0.5", fov_deg=50)
"""
    POINTS = [(-3, -2, 0), (3, -2, 0), (-3, 3, 0), (3, 3, 0), (-2, 2, 2), (2.5, -1, 1.5), (0, 0, 0)]

    def write_place(self):
        (self.folder / "floor.obj").write_text("v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n")
        scene = self.folder / "court.xp"
        scene.write_text(self.SCENE)
        bare = self.folder / "bare.xp"
        bare.write_text(self.SCENE.replace('design(name="stone")', 'design(name="stone", visible=0)'))
        photo = self.folder / "photo.png"
        done = run("render", bare, "--size", "320x240", "-o", photo)
        self.assertEqual(done.returncode, 0, done.stderr)
        return scene, photo

    def clicks(self):
        """Where the scene's camera shows the points: it looks from (0, -8, 3) to (0, 0, 0.5)."""
        length = math.hypot(8, 2.5)
        forward, up = (8 / length, -2.5 / length), (2.5 / length, 8 / length)
        focal = 160 / math.tan(math.radians(25))
        lines = []
        for x, y, z in self.POINTS:
            depth, height = (y + 8) * forward[0] + (z - 3) * forward[1], (y + 8) * up[0] + (z - 3) * up[1]
            lines.append(f"{160 + focal * x / depth} {120 - focal * height / depth} {x} {y} {z}\n")
        return lines

    def test_a_design_by_clicked_points(self):
        scene, photo = self.write_place()
        points, report, montage = (self.folder / name for name in ("points.txt", "report.json", "montage.png"))
        points.write_text("".join(self.clicks()))
        done = run("photomontage", photo, scene, "--points", points, "--date", "2026-06-21", "--hour", "10:30",
                   "--report", report, "-o", montage)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(report.read_text())
        for found, true in zip(told["camera"]["position"], (0, -8, 3)):
            self.assertAlmostEqual(found, true, delta=0.02)
        self.assertIn("1 x Stone bench", told["caption"])
        self.assertIn("2026-06-21, 10:30", told["caption"])
        self.assertGreater(told["covered_fraction"], 0.002)
        self.assertGreater(told["shaded_fraction"], 0.002)
        self.assertTrue(montage.read_bytes().startswith(b"\x89PNG"))

    def test_a_photograph_of_a_telephone_is_taken_as_it_is(self):
        if not shutil.which("oiiotool"):
            self.skipTest("skipped: no oiiotool here")
        scene, photo = self.write_place()
        telephone, report = self.folder / "IMG_1.HEIC", self.folder / "report.json"
        subprocess.run(["oiiotool", photo, "--ch", "R,G,B", "--attrib", "Exif:DateTimeOriginal", "2026:06:21 10:30:00", "-o", telephone], check=True)
        done = run("photomontage", telephone, scene, "--camera", "street", "--report", report, "-o", self.folder / "montage.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(report.read_text())
        self.assertIn("2026-06-21, 10:30", told["caption"])
        self.assertGreater(told["covered_fraction"], 0.002)

    def test_a_photograph_that_was_held_upright_is_shown_so(self):
        if not shutil.which("oiiotool"):
            self.skipTest("skipped: no oiiotool here")
        scene, photo = self.write_place()
        points, report, montage = (self.folder / name for name in ("points.txt", "report.json", "montage.png"))
        points.write_text("".join(self.clicks()))
        fractions = []
        for orientation, turn in ((6, "--rotate270"), (3, "--rotate180"), (1, "--noop")):
            stored = self.folder / "stored.jpg"
            subprocess.run(["oiiotool", photo, "--ch", "R,G,B", *([turn] if orientation > 1 else []), "--attrib", "Orientation", str(orientation), "-o", stored], check=True)
            done = run("photomontage", stored, scene, "--points", points, "--no-caption", "--report", report, "-o", montage)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(struct.unpack_from(">2I", montage.read_bytes(), 16), (320, 240))
            told = json.loads(report.read_text())
            for found, true in zip(told["camera"]["position"], (0, -8, 3)):
                self.assertAlmostEqual(found, true, delta=0.02)
            fractions.append(told["covered_fraction"])
        for fraction in fractions:
            self.assertAlmostEqual(fraction, fractions[-1], delta=0.002)

    def test_bad_input_is_answered(self):
        scene, photo = self.write_place()
        points = self.folder / "points.txt"
        cut = self.folder / "cut.png"
        cut.write_bytes(photo.read_bytes()[:200])
        clicks = self.clicks()
        for text, arguments, answer in (
                ("".join(clicks[:4]), (photo, scene, "--points", points), "takes 6 at least"),
                ("1 2 3\n", (photo, scene, "--points", points), "points.txt:1"),
                ("".join(clicks[:6]) + "310 5 0 0 0\n", (photo, scene, "--points", points), "no camera explains the points"),
                ("", (photo, scene), "the photograph's camera is not given"),
                ("", (cut, scene, "--camera", "street"), "cut.png"),
                ("", (photo, scene, "--camera", "street", "--date", "2026-06-21"), "--date and --hour go together"),
                ("", (photo, scene, "--camera", "street", "--date", "21.6.2026", "--hour", "10:30"), "expected a day"),
                ("", (photo, scene, "--camera", "street", "--design", "ston"), "no design"),
                ("", (photo, scene, "--camera", "street", "-o", photo), "photo.png")):
            points.write_text(text)
            done = run("photomontage", *arguments)
            self.assertEqual(done.returncode, 1, answer)
            self.assertIn(answer, done.stderr)
            self.assertFalse((self.folder / "montage.png").exists())


class Plans(InAFolder):
    """A drawing under a place, and the place as a plan."""

    DRAWING = """0 SECTION|2 HEADER|9 $ACADVER|1 AC1015|9 $INSUNITS|70 UNIT|0 ENDSEC|0 SECTION|2 BLOCKS|0 BLOCK|8 0|2 BANC|70 0|10 0|20 0
|0 LWPOLYLINE|8 0|90 4|70 1|10 0|20 0|10 2|20 0|10 2|20 0.5|10 0|20 0.5|0 ENDBLK|0 ENDSEC|0 SECTION|2 ENTITIES
|0 LINE|5 A|8 BATI|10 1043000|20 6298000|11 1043010|21 6298000|0 INSERT|5 B|8 MOBILIER|2 BANC|10 1043004|20 6297995
|0 RAY|5 C|8 BATI|10 0|20 0|11 1|21 0|0 ENDSEC|0 EOF"""

    def write_scene(self, unit="6"):
        groups = self.DRAWING.replace("\n", "").replace("70 UNIT", f"70 {unit}").split("|")
        text = "".join("\n".join(group.split(" ", 1)) + "\n" for group in groups)
        (self.folder / "square.dxf").write_text(text)
        scene = self.folder / "square.xp"
        scene.write_text('planDrawing(name="survey", file="square.dxf", blocks="BANC=bench")\n')
        return scene

    def test_a_kind_that_nothing_names_leaves_no_file(self):
        scene = self.write("empty.xp", "design(name=a) { }\n")
        self.write("seat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        kept = self.folder / "kinds" / "seat.glb"
        done = run("plan", scene, "--kind", self.folder / "seat.obj", "--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(kept.parent.exists())
        done = run("plan", scene, "--kind", self.folder / "seat.obj", "--do", "insert seat 1,2", "--json", self.folder / "a.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(kept.exists())

    def test_no_output_takes_the_place_of_another_file(self):
        scene = self.write("s.xp", "design(name=a) { placed(name=b, kind=bench_stone) }\n")
        self.write("floor.obj", "v 0 0 0\n")
        for options in [("--pdf", scene), ("--csv", self.folder / "floor.obj"), ("-o", self.folder / "x.xp", "--csv", self.folder / "x.xp"),
                        ("--csv", self.folder / "t.csv", "--json", self.folder / "t.csv")]:
            self.expect_failure("plan", scene, *options, words=["name"])

    def test_a_surface_lies_on_the_ground_below_a_bench(self):
        scene = self.write("s.xp", "design(name=a) { placed(name=b, kind=bench_stone, position=\"0 0 0\") }\n")
        done = run("plan", scene, "--do", "surface paving 0,0 3,0 3,3 name s", "-o", scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('outline="0 0 0, 3 0 0, 3 3 0"', scene.read_text())

    def test_a_design_of_a_newer_version(self):
        self.expect_failure("check", self.write("new.xp", "design(name=a, version=9) { }\n"),
                            words=["version 9", "newer than this program"])

    def test_a_plan_in_three_files(self):
        scene = self.write_scene()
        pdf, dxf, table = (self.folder / name for name in ("plan.pdf", "plan.dxf", "plan.csv"))
        done = run("plan", scene, "--pdf", pdf, "--dxf", dxf, "--csv", table, "--title", "Place de la Liberté",
                   "--do", "measure slope 0,0,0 10,0,0.5 name ramp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 RAY", done.stderr)  # what is not read is named
        self.assertTrue(pdf.read_bytes().startswith(b"%PDF"))
        self.assertIn("AcDbBlockReference", dxf.read_text("latin-1"))
        rows = list(csv.DictReader(table.open(newline="")))
        self.assertEqual([(row["kind"], row["x"], row["y"], row["width_m"]) for row in rows[:1]],
                         [("bench", "1043005.000", "6297995.250", "2.000")])
        self.assertEqual([(row["kind"], row["name"], row["value"], row["unit"]) for row in rows[1:]],
                         [("slope", "ramp", "0.0500", "1")])

    def test_the_sheet_for_the_council(self):
        scene = self.folder / "two.xp"
        scene.write_text(
            "dayLight(latitude=43.7, longitude=7.27, standardMeridian=1, julianDay=80, timeOfDay=12)\n"
            'design(name=ground) { surface(name=floor, material=plain, outline="-30 -30, 30 -30, 30 30, -30 30") }\n'
            'design(name=old) { placed(name=a, kind=kiosk, position="0 0 0") }\n'
            'design(name=new, visible=0) { placed(name=b, kind=umbrella, position="6 0 0") }\n'
            'camera(name="street", position="0 -12 1.7", target="2 0 1")\n')
        sheet = self.folder / "council.pdf"
        done = run("plan", scene, "--design", "new", "--compare", "old", "--council", sheet)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 views, plan at 1:100, 2 objects that differ, hours of sun on 21 March 2026", done.stdout)
        self.assertTrue(sheet.read_bytes().startswith(b"%PDF"))
        plain = sheet.stat().st_size
        self.assertEqual(run("plan", scene, "--design", "new", "--compare", "old", "--council", sheet, "--link",
                             "https://example.org/square").returncode, 0)
        self.assertGreater(sheet.stat().st_size, plain, "its QR code")
        sheet.unlink()
        for wrong, said in ((["--view", "balcony"], "street"), (["--sun-day", "2026-02-30"], "not a date"),
                            (["--design", "old"], "itself"), (["--scale", "1"], "1:5"), (["--link", "my square"], "https://")):
            refused = run("plan", scene, *(["--design", "new"] if "--design" not in wrong else []),
                          "--compare", "old", "--council", sheet, *wrong)
            self.assertEqual(refused.returncode, 1, wrong)
            self.assertIn(said, refused.stderr)
            self.assertFalse(sheet.exists())
        self.assertIn("--compare", run("plan", scene, "--council", sheet).stderr)

    def test_it_says_what_it_needs(self):
        scene = self.write_scene()
        self.assertEqual(run("plan", scene).returncode, 1)
        far = run("plan", scene, "--pdf", self.folder / "plan.pdf", "--centre", "5000,0")
        self.assertEqual(far.returncode, 1)
        self.assertIn("another centre", far.stderr)
        self.assertFalse((self.folder / "plan.pdf").exists())
        without_unit = run("check", self.write_scene("0"))
        self.assertEqual(without_unit.returncode, 1)
        self.assertIn("unit=", without_unit.stderr)


class Studies(InAFolder):
    """Sessions of a study, from a file of inputs to a report."""

    STUDY = """study(name=shade, scene="square.xp", order=balanced, asked="sus remarks") {
  condition(name=bright, scenario=noon)
  condition(name=dim, scenario=evening)
  task(name=left, area="-9 -9, 0 -9, 0 9, -9 9", instruction="left")
  task(name=right, instruction="right")
}
"""
    SCENE = """sun(azimuth_deg=140, elevation_deg=40)
camera(name=street, position="0 -12 1.7", target="0 0 1")
design(name=floor) { surface(name=court, material=plain, outline="-9 -9, 9 -9, 9 9, -9 9") }
scenario(name=noon) { }
scenario(name=evening) { override(of="%sun", elevation_deg=12) }
"""
    INPUTS = "1 do insert bin -2,3\n2 do insert bin 4,3\n3 do insert nothing 0,0\n9 done\n10 do insert bin 1,1\n12 done\n" + "".join(
        f"{12 + item} answer sus.{item} {5 if item % 2 else 1}\n" for item in range(1, 11)) + "30 answer remarks.good <shade & light>\n31 done\n"

    def setUp(self):
        super().setUp()
        self.write("square.xp", self.SCENE)
        self.task, self.inputs = self.write("shade.study", self.STUDY), self.write("inputs.txt", self.INPUTS)

    def take_part(self, participant, *arguments):
        return run("study", "run", self.task, "--participant", participant, "--input", self.inputs, *arguments)

    def test_a_session_is_logged_replayed_reported_and_forgotten(self):
        for participant in ("P1", "P2"):
            done = self.take_part(participant)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("has ended", done.stdout)
        again = run("study", "replay", self.task, "--participant", "P1")
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertRegex(again.stdout, r"^1860 frames, [1-9]\d* logged states: the same bits\n$")
        picture = self.folder / "eye.png"
        shown = run("study", "replay", self.task, "--participant", "P1", "--at", "8", "-o", picture, *SIZE)
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertEqual(len(pixels(picture.read_bytes())[0]), 48)

        page, tables, xdf = (self.folder / name for name in ("report.html", "tables", "xdf"))
        done = run("study", "report", self.task, "-o", page, "--csv", tables, "--xdf", xdf)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("percentile above 99.8", page.read_text())
        self.assertIn("&lt;shade &amp; light&gt;", page.read_text())
        rows = list(csv.DictReader((tables / "parts.csv").open(newline="")))
        left = [(row["participant"], row["condition"], row["refused"], row["outside"]) for row in rows if row["task"] == "left"]
        self.assertEqual(left, [("P1", "bright", "1", "1"), ("P2", "dim", "1", "1")])
        self.assertEqual((xdf / "P2.xdf").read_bytes()[:4], b"XDF:")

        self.assertEqual(run("study", "forget", self.task, "--participant", "P1").returncode, 0)
        self.expect_failure("study", "replay", self.task, "--participant", "P1", words=["no participant \"P1\"", "P2"])

    def test_the_page_of_questions(self):
        page = self.folder / "page.html"
        self.assertEqual(run("study", "page", self.task, "-o", page, "--language", "fr").returncode, 0)
        self.assertIn("sus.10", page.read_text())
        self.inputs.write_text("1 done\n2 done\n")
        self.assertIn("part 3 of 3", self.take_part("P1").stdout)
        answers = self.write("answers.txt", "0 answer sus.1 4\n0 answer remarks.bad nothing\n")
        done = run("study", "run", self.task, "--participant", "P1", "--answers", answers)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("has ended", done.stdout)

    def test_what_is_wrong_is_said(self):
        run_p1 = ["study", "run", self.task, "--participant", "P1", "--input", self.inputs]
        self.expect_failure("study", "report", self.task, "-o", self.folder / "r.html", words=["no log of sessions"])
        for wrong, said in (('scene="square.xp"', "needs scene="), ("scenario=noon", '"non"; did you mean')):
            self.task.write_text(self.STUDY.replace(wrong, "" if "xp" in wrong else "scenario=non").replace("(name=shade, ,", "(name=shade,"))
            done = run(*run_p1)
            self.assertEqual(done.returncode, 1)
            self.assertIn("shade.study", done.stderr)
            self.assertIn("needs scene=" if "xp" in wrong else '"noon"', done.stderr, said)
        self.task.write_text(self.STUDY)
        self.assertEqual(run(*run_p1).returncode, 0)
        self.expect_failure(*run_p1, words=["P1 has a session", "--resume"])
        self.expect_failure("study", "run", self.task, "--participant", "Anna Miller", "--input", self.inputs, words=["no participant code"])
        log = self.folder / "shade.sqlite"
        whole = log.read_bytes()
        log.write_bytes(whole[: len(whole) // 2])
        self.expect_failure("study", "replay", self.task, "--participant", "P1", words=["shade.sqlite", "damaged or cut"])
        log.write_bytes(whole[:60] + struct.pack(">I", 7) + whole[64:])  # the version
        self.expect_failure("study", "replay", self.task, "--participant", "P1", words=["version 7"])

    def test_a_full_disk_does_not_end_the_session(self):
        self.inputs.write_text("300 do insert bin -2,3\n301 done\n302 done\n303 done\n")
        done = run("study", "run", self.task, "--participant", "P1", "--input", self.inputs,
                   before=["bash", "-c", 'trap "" XFSZ; ulimit -f 400; exec "$@"', "sh"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("make room", done.stderr)
        self.assertIn("has ended", done.stdout)
        events = run("study", "report", self.task, "--csv", self.folder / "tables")
        self.assertEqual(events.returncode, 0, events.stderr)
        self.assertIn("P1,0.000000,part,", (self.folder / "tables" / "P1" / "events.csv").read_text())


TEN_LINES = """# two places to look from
sun(azimuth_deg=140, elevation_deg=40)
camera(name="street", position="0 -9 2", target="0 0 1")
group(name="hill", position="0 40 8") {
  camera(name="top", position="0 0 1.6")
}
scenario(name="turned", title="The hill, turned") {
  override(of="hill", heading_deg=90)
}
# the end
"""

QUAD = """mtllib quad.mtl
o wall
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
usemtl brick
f 1 2 3 4
"""


class Libraries(InAFolder):
    """Which libraries a command maps, and what it says where one is missing."""

    MAX_MAPPED = 40
    READERS = ("OpenImageIO", "assimp", "gdal", "Coin", "IfcPlusPlus", "citygml", "xerces", "tiff", "jpeg", "png")

    def mapped(self, *arguments):
        """Names of the libraries that the command maps: in the program itself, by the loader's own list, and in all of its
        processes, whose maps are read again and again while it runs."""
        log = self.folder / "mapped"
        everywhere = set()
        with open(self.folder / "said", "w+") as said:
            process = subprocess.Popen(
                [PARVIS, *map(str, arguments)], stdout=said, stderr=said, start_new_session=True,
                env={**os.environ, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(log)})
            while process.poll() is None:
                for child in filter(str.isdigit, os.listdir("/proc")):
                    try:
                        if os.getsid(int(child)) == process.pid:
                            maps = pathlib.Path("/proc", child, "maps").read_text()
                            everywhere.update(re.findall(r"/([^/ ]+)\.so[.\w]*$", maps, re.MULTILINE))
                    except OSError:  # it has ended
                        pass
                time.sleep(0.005)
            said.seek(0)
            self.assertEqual(process.returncode, 0, said.read())
        (file,) = self.folder.glob("mapped.*")
        program = set(re.findall(r"file=(\S+) \[\d+\];  generating link map", file.read_text(errors="replace")))
        file.unlink()
        program = {pathlib.PurePath(name).name.split(".so")[0] for name in program}
        return program, program | everywhere - {"ld-linux-x86-64"}

    def test_commands_that_read_no_model_map_few(self):
        scene = self.write("ten.xp", TEN_LINES)
        for arguments in (["--version"], ["--help"], ["check", scene], ["format", scene]):
            _, everywhere = self.mapped(*arguments)
            self.assertIn("libstdc++", everywhere)
            self.assertLessEqual(len(everywhere), self.MAX_MAPPED, sorted(everywhere))

    def test_readers_stay_out_of_the_program(self):
        self.write("quad.obj", QUAD)
        self.write("quad.mtl", "newmtl brick\nKd 1 1 1\nmap_Kd brick.png\n")
        rows = zlib.compress(b"".join(b"\0" + bytes([200, 90, 60] * 4) for _ in range(4)))
        chunks = [(b"IHDR", struct.pack(">2I5B", 4, 4, 8, 2, 0, 0, 0)), (b"IDAT", rows), (b"IEND", b"")]
        self.write("brick.png", b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks))
        # Several, so that the process that has the modules is there for a while.
        pavilions = [f"pavilion_{number}.ifc" for number in range(8)]
        for name in pavilions:
            shutil.copy(pathlib.Path(__file__).resolve().parents[2] / "scenes" / "pavilion.ifc", self.folder / name)
        scene = self.write("scene.xp", "".join(f'model(file="{name}")\n' for name in ["quad.obj", *pavilions]))
        program, everywhere = self.mapped("check", scene)
        for reader in ("assimp", "OpenImageIO", "IfcPlusPlus"):
            self.assertTrue(any(reader in name for name in everywhere), reader)
        self.assertGreater(len(everywhere), self.MAX_MAPPED, "the control of the test above")
        found = [name for name in program if any(reader in name for reader in self.READERS)]
        self.assertEqual(found, [], "libraries that read strangers' bytes, in the program")

    def test_a_missing_module_is_an_error(self):
        self.write("quad.obj", QUAD)
        scene = self.write("scene.xp", 'sun()\nmodel(file="quad.obj")\n')
        base = self.folder / "libraries"
        base.mkdir()
        shutil.copy(pathlib.Path(PARVIS).resolve().parents[2] / "lib" / "libparvis_base.so", base)
        alone = {"LD_LIBRARY_PATH": str(base)}  # modules lie beside it
        self.expect_failure("check", scene, words=["parvis_assimp.so", "cannot open"], environment=alone)
        self.write("scene.xp", TEN_LINES)
        self.assertEqual(run("check", scene, environment=alone).returncode, 0)


class BadModels(InAFolder):
    def test_too_little_address_space_is_said_at_once(self):
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        scene = self.write("scene.xp", 'model(file="a.obj")\n')
        for limit in (300000, 450000):  # kB; of the second a library takes so much that it waits for a thread for ever
            done = run("check", scene, before=["bash", "-c", f'ulimit -v {limit}; exec "$@"', "sh"])
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("ulimit -v", done.stderr)

    def test_damaged_glb(self):
        whole = glb(*triangle())
        self.expect_bad_model("short.glb", whole[: len(whole) // 2], is_rendered=True)
        self.expect_bad_model("magic.glb", b"glTG" + whole[4:])
        self.expect_bad_model("empty.glb", b"")

    def test_buffers_that_claim_more_bytes_than_the_file_has(self):
        self.expect_bad_model("claims.glb", glb(*triangle(claimed_bytes=1 << 30)))

    def test_vertices_that_are_not_finite(self):
        for number in ["nan", "inf", "-inf"]:
            document, data = triangle(positions=(0, 0, 0, 4, float(number), 0, 0, 0, 4))
            self.expect_bad_model("wild.gltf", gltf(document, data), "vertex 1")

    def test_indices_out_of_range(self):
        self.expect_bad_model("far.gltf", gltf(*triangle(indices=(0, 1, 70000))), "70000")

    def test_a_missing_texture_is_named_and_the_model_is_drawn(self):
        document, data = triangle()
        document["images"] = [{"uri": "lost.png"}]
        document["textures"] = [{"source": 0}]
        document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        document["meshes"][0]["primitives"][0]["material"] = 0
        self.expect_warning("sail.gltf", gltf(document, data), "lost.png", is_rendered=True)

    def test_city_json(self):
        self.expect_bad_model("a.city.json", city(last_index=99), "roof", is_rendered=True)
        self.expect_bad_model("b.city.json", city(version="7.3"), "7.3")
        self.expect_bad_model("c.city.json", city(has_polygons=False))
        self.expect_bad_model("d.city.json", city()[:-40])


    def test_a_skin_with_missing_joints(self):
        document, data = triangle()
        document["nodes"][0]["skin"] = 0
        document["skins"] = [{"name": "legs", "joints": [0, 7]}]
        self.expect_bad_model("legs.gltf", gltf(document, data), 'skin "legs"', "joint 7")

    def test_a_circle_of_nodes_is_named_and_the_rest_is_read(self):
        document, data = triangle()
        document["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [0]}]
        self.expect_warning("circle.gltf", gltf(document, data), "node 0 is its own ancestor through node 1")

    def test_ways_with_missing_nodes_are_named_and_the_rest_is_read(self):
        corners = [(1, 52.16, 4.49), (2, 52.16, 4.4902), (3, 52.1601, 4.4902)]
        nodes = "".join(f'<node id="{i}" lat="{lat}" lon="{lon}"/>' for i, lat, lon in corners)
        way = '<way id="7">' + "".join(f'<nd ref="{i}"/>' for i in [1, 2, 3, 99, 1])
        text = f'<osm version="0.6">{nodes}{way}<tag k="building" v="yes"/></way></osm>'
        self.expect_warning("block.osm", text, "way 7", "node 99")

    def test_a_grid_of_heights_without_a_place_on_the_earth(self):
        # a TIFF of 2 x 2 samples: little-endian, one directory of eight entries, samples behind it
        entries = [(256, 2), (257, 2), (258, 8), (259, 1), (262, 1), (273, 110), (278, 2), (279, 4)]
        directory = b"".join(struct.pack("<HHII", tag, 3, 1, value) for tag, value in entries)
        grid = b"II*\0" + struct.pack("<IH", 8, len(entries)) + directory + struct.pack("<I", 0) + bytes([1, 2, 3, 4])
        self.expect_bad_model("hill.tif", grid, "georeference", "cell=", is_rendered=True)
        scene = self.write("scene.xp", 'model(file="hill.tif", cell=10)\ncamera(name="a", position="0 -9 2")\n')
        self.assertEqual(run("check", scene).returncode, 0)

    def test_a_doctype(self):
        text = '<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]>\n<osm>&b;</osm>\n'
        for name in ["a.osm", "a.gml"]:
            self.expect_bad_model(name, text, name + ":2:", "DOCTYPE", is_rendered=True)


ROOT = pathlib.Path(__file__).resolve().parents[2]


def second_readers(test, *words):
    """The figures of script/second_readers, and what it prints; skips where its libraries cannot be had."""
    out = test.folder / "second.json"
    done = subprocess.run([ROOT / "script" / "second_readers", PARVIS, "--json", out, *words],
                          cwd=ROOT, capture_output=True, text=True, timeout=1500)
    if done.returncode == 77:
        test.skipTest(done.stdout.strip())
    return json.loads(out.read_text())["figures"], done.stdout


class Files(InAFolder):
    """What is read of model files, beside other readers of the same files."""

    FILES = ["scenes/canal.osm", "scenes/court/bench.obj", "scenes/court/relief_front.wrl", "scenes/bare_saloon.glb",
             "src/formats/ifc/fuzz/corpus/ifc/wall.ifc", "src/formats/gltf/fuzz/corpus/gltf/instanced.glb",
             "src/formats/city_models/fuzz/corpus/city_json/solid.city.json"]

    def test_other_readers_find_the_same_objects(self):
        figures, printed = second_readers(self, *self.FILES)
        self.assertEqual(figures["files"], len(self.FILES), printed)
        self.assertEqual(figures["agree"] + figures["explained"], figures["objects"], printed)
        self.assertEqual((figures["silent"], figures["without_account"]), (0, 0), printed)

    def test_what_is_lost_or_stretched_is_found(self):
        figures, printed = second_readers(self, "--control", "loss", *self.FILES[:4])
        self.assertGreater(figures["silent"], 50, printed)
        self.assertEqual(figures["without_account"], 4, printed)
        figures, printed = second_readers(self, "--control", "size", *self.FILES[1:4])
        self.assertEqual(figures["agree"], 0, printed)


class AllFiles(InAFolder):
    """Every valid file of the project, and the inputs after reports of other programs' users."""

    def test_other_readers_find_the_same_objects(self):
        endings = (".osm", ".obj", ".wrl", ".glb", ".ifc", ".gml", ".json")
        files = [path for folder in ("scenes", "src/formats") for path in (ROOT / folder).rglob("*") if path.suffix in endings]
        figures, printed = second_readers(self, *sorted(files))
        self.assertEqual(figures["agree"] + figures["explained"], figures["objects"], printed)
        self.assertEqual((figures["silent"], figures["without_account"]), (0, 0), printed)

    def test_reports_of_others_come_out_right(self):
        reports = ROOT.parent / "shared" / "data" / "reports"
        if not reports.is_dir():
            self.skipTest("skipped: shared data absent")
        done = subprocess.run([ROOT / "apps/bench/files/judge_reports.py", PARVIS, reports],
                              capture_output=True, text=True, timeout=1500)
        self.assertEqual(done.returncode, 0, done.stdout)


class Hostile(InAFolder):
    """A few of script/attack's classes, each of which once crashed, escaped or wrapped."""

    def setUp(self):
        super().setUp()
        self.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nusemtl m\nf 1 2 3\n")
        self.scene = self.write("scene.xp", 'model(file="m.obj")\ncamera(name="a", position="0 -9 2")\n')

    def test_numbers_that_are_none_or_wrap(self):
        photograph = ["reference", self.scene, "--path-traced", "--samples", "1", *SIZE, "-o", self.folder / "out.png"]
        for arguments in [
            ["render", self.scene, *SIZE, "--time=nan"],
            ["render", self.scene, *SIZE, "--seconds=nan", "-o", self.folder / "out.mp4"],
            ["render", self.scene, "--size=4294967360x48"],
            [*photograph, "--fov=nan", "--circle=0,0,0,5,1,2"],
            [*photograph, "--clamp=nan"],
            [*photograph, "--seed=-1"],
            [*photograph, "--circle=0,0,0,nan,1,2"],
            [*photograph, "--circle=0,0,0,0,1,2"],
            [*photograph, "--circle=0,0,0,5,1,-3"],
            [*photograph, "--circle=0,0,0,5,1,1.5"],
            [*photograph, "--circle=1e30,0,0,5,1,2"],
        ]:
            done = run(*arguments)
            self.assertIn(done.returncode, (1, 2), arguments)
            self.assertTrue(done.stderr, arguments)
            self.assertEqual(self.files(), ["m.obj", "scene.xp"])

    def test_a_film_that_is_ended_leaves_nothing(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("skipped: no ffmpeg here")
        for wait in [0.0, 0.05, 0.1]:
            film = subprocess.Popen([PARVIS, "render", self.scene, *SIZE, "--seconds", "100", "-o", self.folder / "out.mp4"],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while film.poll() is None and not any(name.startswith(".partial") for name in self.files()):
                time.sleep(0.01)
            time.sleep(wait)
            film.send_signal(signal.SIGHUP)  # to the program alone, not to ffmpeg
            film.wait()
            time.sleep(0.3)
            self.assertFalse([name for name in self.files() if name.startswith(".partial")], wait)

    def test_a_material_library_outside_is_not_opened(self):
        outside = self.folder.parent / (self.folder.name + "-outside.mtl")
        outside.write_text("newmtl m\nKd 0.123 0.456 0.789\n")
        self.addCleanup(outside.unlink)
        (self.folder / "m.mtl").symlink_to(outside)
        done = run("export", self.scene, "-o", self.folder / "out.glb")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn(b"0.456", (self.folder / "out.glb").read_bytes())

    def test_formats_are_known_by_name_and_content(self):
        for name, content in [("m.lws", "LWSC\n3\n"), ("m.obj", b"\x7fELF\0"), ("m.ply", "v 0 0 0\n"), ("m.GLTF", "no JSON")]:
            self.expect_bad_model(name, content, name)
        self.write("m.OBJ", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
        self.write("scene.xp", 'model(file="m.OBJ")\n')
        self.assertEqual(run("check", self.scene).returncode, 0)

    def test_a_sparse_accessor_before_its_buffer(self):
        document, data = triangle()
        document["accessors"][0]["sparse"] = {
            "count": 1, "indices": {"bufferView": 1, "componentType": 5125}, "values": {"bufferView": 0, "byteOffset": 2**64 - 12}}
        self.expect_bad_model("sparse.gltf", gltf(document, data), "accessor 0")

    def test_json_that_is_too_deep(self):
        document, data = triangle()
        document["extras"] = "DEEP"
        self.expect_bad_model("deep.gltf", gltf(document, data).replace('"DEEP"', "[" * 80000 + "]" * 80000), "deep")
        self.expect_bad_model("deep.json", city().replace("{", '{"a":' + "[" * 80000 + "]" * 80000 + ",", 1), "deep")

    def test_a_full_output_is_an_error(self):
        for arguments in (["check", self.scene], ["check", "--reference"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PARVIS, *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1, arguments)


class Cars(InAFolder):
    """What `parvis car` writes."""

    def write_lying_car(self):
        """A body of which the glTF has z up, not y: its script needs a copy of it."""
        return self.write_car("lying.glb", lambda x, y, z: (x, y, z))

    def write_car(self, name, placed):
        """A body in a glTF, for which `placed` turns its corners: along x, y to its left, z up."""
        profile = [(-2, 0.2), (2, 0.2), (2, 0.8), (0.9, 0.9), (0.2, 1.4), (-1.6, 1.4), (-2, 0.9)]
        corners = [(x, y, z) for y in (-0.85, 0.85) for x, z in profile]
        count, triangles = len(profile), []
        for i in range(count):
            following = (i + 1) % count
            triangles += [(i, following, count + following), (i, count + following, count + i)]
        for first in (0, count):
            triangles += [(first, first + i, first + i + 1) for i in range(1, count - 1)]
        corners = [placed(*corner) for corner in corners]
        positions = struct.pack(f"<{3 * len(corners)}f", *(value for corner in corners for value in corner))
        indices = struct.pack(f"<{3 * len(triangles)}I", *(index for one in triangles for index in one))
        document, _ = triangle()
        bounds = {"min": [min(values) for values in zip(*corners)], "max": [max(values) for values in zip(*corners)]}
        document["accessors"][0].update(count=len(corners), **bounds)
        document["accessors"][1].update(count=3 * len(triangles))
        document["bufferViews"][0]["byteLength"] = len(positions)
        document["bufferViews"][1].update(byteOffset=len(positions), byteLength=len(indices))
        document["buffers"][0]["byteLength"] = len(positions) + len(indices)
        return self.write(name, glb(document, positions + indices))

    def test_the_script_and_its_copy_of_the_model_are_written(self):
        done = run("car", self.write_lying_car(), "-o", self.folder / "new" / "car.xp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.files(), ["lying.glb", "new", "new/car.xp", "new/car_model.glb"])
        self.assertIn('file="car_model.glb"', (self.folder / "new" / "car.xp").read_text())

    def test_the_script_reads_its_car_without_data_wherever_that_lies(self):
        (self.folder / "bodies").mkdir()
        body = self.write_car("bodies/body.glb", lambda x, y, z: (x, z, -y))
        for script, model in (("out/car.xp", "car_model.glb"), ("car.xp", "bodies/body.glb")):
            done = run("car", body, "-o", self.folder / script)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f'file="{model}"', (self.folder / script).read_text())
            checked = run("check", self.folder / script)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_a_script_that_cannot_be_written_leaves_no_copy_of_the_model(self):
        (self.folder / "car.xp").symlink_to("../elsewhere.xp")  # nothing writes out of the folder
        done = run("car", self.write_lying_car(), "-o", self.folder / "car.xp")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("car.xp", done.stderr)
        self.assertEqual(self.files(), ["car.xp", "lying.glb"])


class Facades(InAFolder):
    def test_stages_say_what_is_missing(self):
        self.assertEqual(run("facade", "pack", self.folder / "nowhere").returncode, 2)
        for stage in ("layers", "fill", "pack", "report"):
            done = run("facade", stage, self.folder)
            self.assertEqual(done.returncode, 1, stage)
            self.assertIn("parvis facade model", done.stderr)

    def test_a_model_that_is_there_is_kept(self):
        model = self.folder / "model.glb"
        model.write_text("corrected")
        done = run("facade", "model", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("--overwrite", done.stderr)
        self.assertEqual(model.read_text(), "corrected")
        self.assertNotIn("--overwrite", run("facade", "model", self.folder, "--overwrite").stderr)

    def test_a_scan_that_is_not_used_is_named_at_once(self):
        place, photographs = self.folder / "place", self.folder / "photographs"
        for folder in (place, photographs):
            folder.mkdir()
        (place / "model.glb").write_text("corrected")
        (self.folder / "scan.ply").write_text("ply")
        done = run("facade", "walk", photographs, "-o", place, "--scan", self.folder / "scan.ply")
        self.assertEqual(done.returncode, 1)  # there are no photographs
        self.assertIn("--overwrite", done.stderr)
        self.assertEqual((place / "model.glb").read_text(), "corrected")

    def panorama(self, name, width, height):
        """A PNG whose rows differ, so that up and down do."""
        row = lambda y: b"".join(bytes((x * 255 // width, y * 255 // height, 90)) for x in range(width))
        rows = b"".join(b"\0" + row(y) for y in range(height))
        chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        path = self.folder / name
        path.write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
        return path

    def test_panoramas_become_a_place_that_is_packed_and_exported(self):
        place = self.folder / "square"
        for number, position in enumerate((("0", "0", "1.7"), ("0.5", "0", "1.7"))):
            done = run("facade", "panorama", self.panorama(f"p{number}.png", 256, 128), "-o", place, "--position", *position)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("12 photographs", done.stdout)
        wrong = run("facade", "panorama", self.panorama("strip.png", 300, 100), "-o", self.folder / "strip")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("strip", wrong.stderr)
        document, data = triangle(positions=(-4, 3, -4, 4, 3, -4, 0, 3, 8))
        document["nodes"][0]["rotation"] = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # z up, as the place is
        (self.folder / "wall.gltf").write_text(gltf(document, data))
        done = run("facade", "export", place, "-o", self.folder / "square.glb")
        self.assertEqual(done.returncode, 1)
        self.assertIn("parvis facade pack", done.stderr)
        self.assertEqual(run("facade", "model", place, "--scan", self.folder / "none.ply").returncode, 2)
        self.assertEqual(run("facade", "model", place, "--scan", self.folder / "wall.gltf", "--flat").returncode, 2)
        done = run("facade", "model", place, "--scan", self.folder / "wall.gltf")  # too few triangles to be trimmed
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("model.glb", done.stdout)
        self.assertIn(b"backdrop", (place / "model.glb").read_bytes())
        self.assertEqual(run("facade", "model", place, "--scan", self.folder / "wall.gltf").returncode, 1)
        done = run("facade", "pack", place, "--model", self.folder / "wall.gltf")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("facade", "export", place, "-o", self.folder / "square.glb", "--texture-side", "512")
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "square.xp").write_text('facade(file="square.glb", texture_mb=64)')
        self.assertEqual(run("check", self.folder / "square.xp").returncode, 0)
        done = run("facade", "figures", place, "--model", self.folder / "wall.gltf")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((place / "figures" / "figure_3_14.png").exists())
        self.assertEqual(run("facade", "figures", place, "--model", self.folder / "wall.gltf", "--photograph", "no").returncode, 1)
        self.reported_without(place)

    def reported_without(self, place):
        """How well the place shows photographs that it is made without."""
        command = ["facade", "report", place, "--model", self.folder / "wall.gltf", "--leave-out"]
        done = run(*command, "no.png")
        self.assertEqual(done.returncode, 1)
        self.assertIn('no photograph "no.png" to leave out', done.stderr)
        done = run(*command, "p1_north.png", "--leave-out", "p1_south.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("SSIM", done.stdout)
        self.assertIn("p1_south.png             layers                     shows nothing of the model", done.stdout)
        methods = ["layers", "single_best_view", "extracted_texture", "view_dependent_subdivided", "unstructured_lumigraph"]
        for method in methods:
            psnr_db = re.search(f"mean  *{method}  *([\\d.]+)", done.stdout)
            self.assertGreater(float(psnr_db[1]), 25, done.stdout)

    def test_a_damaged_pack_is_named(self):
        (self.folder / "place.facade").write_bytes(b"PVFACE_1" + b"x" * 100)
        (self.folder / "place.xp").write_text('facade(file="place.facade")')
        done = run("check", self.folder / "place.xp")
        self.assertEqual(done.returncode, 1)
        self.assertIn("place.facade", done.stderr)


class DemoOfPhotographs(InAFolder):
    """The stages of script/demo --photos that are its own, on a small place that is made up."""

    def setUp(self):
        super().setUp()
        file = pathlib.Path(__file__).resolve().parent.parent.parent / "script" / "demo_photos"
        loader = importlib.machinery.SourceFileLoader("demo_photos", str(file))
        self.demo = importlib.util.module_from_spec(importlib.util.spec_from_loader("demo_photos", loader))
        sys.dont_write_bytecode = True
        loader.exec_module(self.demo)

    def photographs(self):
        """Three photographs of a court whose wall stands 20 m north, 1.6 m above its ground."""
        looks_north = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
        return [self.demo.Photograph(f"{i:04}.jpg", looks_north, [-4.0 * i, 1.6, 0], 1, (96, 64), (60.0, 60.0, 48.0, 32.0)) for i in range(3)]

    def points(self):
        """Of the ground, of a wall, and of a car that stands before it."""
        ground = [self.demo.Point((0.5 * x, 5 + 0.5 * y, 0.0), 3) for x in range(20) for y in range(20)]
        wall = [self.demo.Point((0.5 * x - 4, 20.0, 0.25 * z), 3) for x in range(40) for z in range(20)]
        car = [self.demo.Point((4 + 0.2 * x, 9 + 0.3 * y, 0.4 + 0.2 * z), 3) for x in range(8) for y in range(5) for z in range(5)]
        return ground + wall + car

    def model(self, names=("wall_1",)):
        """A model of one wall, as parvis facade model writes models: under a node that turns z up."""
        document, data = triangle((-8, 20, 0, 20, 20, 0, 20, 20, 9))
        document["nodes"] = [{"name": "z_up", "children": [1], "matrix": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]}, {"mesh": 0, "name": names[0]}]
        document["materials"] = [{"name": "unpainted"}]
        file = self.folder / "model.glb"
        self.demo.write_glb(file, document, bytearray(data))
        return file

    def test_the_pixel_of_a_point_is_where_the_camera_sees_it(self):
        first, second, _ = self.photographs()
        self.assertEqual(first.centre(), [0, 0, 1.6])
        self.assertEqual(second.centre()[0], 4.0)
        self.assertEqual(first.pixel((0, 10, 1.6)), (48.0, 32.0))
        self.assertEqual(first.pixel((1, 10, 2.6)), (54.0, 26.0))  # to the right, and up
        self.assertIsNone(first.pixel((0, -1, 0)))

    def test_ground_is_where_hardly_a_point_lies_below(self):
        self.assertEqual(self.demo.ground_level(self.points(), self.photographs()), 0.0)
        noisy = self.points() + [self.demo.Point((0, 9, -7.0), 3)]
        self.assertEqual(self.demo.ground_level(noisy, self.photographs()), 0.0)
        with self.assertRaises(SystemExit):
            self.demo.ground_level([p for p in self.points() if p.position[2] > 1.7], self.photographs())

    def test_sloping_ground_is_a_plane(self):
        ground = self.demo.plane_of([(x, y, 2 + 0.1 * x - 0.2 * y) for x in (0, 5, 9) for y in (1, 4)])
        self.assertAlmostEqual(ground(20, 10), 2.0)
        self.assertEqual(self.demo.plane_of([(3, 4, 7.0)])(50, 60), 7.0)

    def test_ground_is_added_to_a_model_that_parvis_reads(self):
        file = self.model()
        self.demo.add_ground(file, -0.5, (-10, 0), (10, 22))
        (self.folder / "scene.xp").write_text('model(file="model.glb")\ncamera(name="down", position="0 8 30", pitch_deg=-90)')
        done = run("render", self.folder / "scene.xp", "--size", "64x36", "--probe", "20,18", "-o", self.folder / "down.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"-0\.50 m")

    def test_a_car_before_a_wall_is_masked_and_the_wall_is_not(self):
        file = self.model()
        walls = self.demo.wall_points(*self.demo.read_glb(file))
        boxes = self.demo.standing_boxes(self.points(), walls, self.demo.plane_of([(0, 0, 0.0)]), self.photographs())
        self.assertEqual(len(boxes), 1)
        box = boxes[0]
        self.assertTrue(box.low[0] < 4 and box.high[0] > 5.4 and box.low[1] < 9 and box.high[1] < 11 and box.high[2] < 2 and box.low[2] < 0)
        rows = self.demo.mask_rows(self.photographs()[1], boxes)
        x, y = map(round, self.photographs()[1].pixel((4.7, 9.6, 0.8)))
        self.assertEqual(rows[y][x], 0)
        self.assertEqual(rows[2][x], 255)
        self.assertEqual(rows[y][90], 255)
        # Fewer points are a part of a wall that the model lacks.
        few = [p for p in self.points() if not 4 <= p.position[0] <= 5.5 or not 9 <= p.position[1] < 10.3 or p.position[2] < 0.5]
        self.assertEqual(self.demo.standing_boxes(few, walls, self.demo.plane_of([(0, 0, 0.0)]), self.photographs()), [])

    def test_masks_are_named_beside_those_that_somebody_painted(self):
        (self.folder / "photographs.json").write_text(json.dumps({"pictures": "p", "photographs": [{"name": "0000.jpg", "mask": "mine.png"}, {"name": "0001.jpg"}]}))
        box = self.demo.Box((3.7, 8.7, 0), (5.7, 10.5, 1.5))
        self.assertEqual(self.demo.write_masks(self.folder, self.photographs(), [box]), 1)  # 0002.jpg is not in the set
        entries = json.loads((self.folder / "photographs.json").read_text())["photographs"]
        self.assertEqual([entry["mask"] for entry in entries], ["mine.png", "masks/0001.png"])
        self.assertTrue((self.folder / "masks/0001.png").read_bytes().startswith(b"\x89PNG"))

    def test_what_is_inserted_stands_before_a_camera_that_the_place_has(self):
        place = self.folder / "place.xp"
        place.write_text('camera(name="between", position="1 0 1.6", heading_deg=0, pitch_deg=0, roll_deg=0, fov_deg=60)\n'
                         + "".join(f'camera(name="{i:04}", position="{4 * i} 0.0000 1.6000", heading_deg={turn}, pitch_deg=-1.5, roll_deg=0.1, fov_deg=60.5)\n' for i, turn in ((3, -20.0), (5, 75.0), (7, -45.0))))
        cameras = self.demo.read_cameras(place)
        self.assertEqual([camera.name for camera in cameras], ["0003", "0005", "0007"])
        obstacles = [(0.5 * x - 30, 25.0) for x in range(160)] + [(26.0 + 0.2 * i, 3.0) for i in range(10)]
        first, depth, second = self.demo.chosen_views(cameras, obstacles)
        self.assertNotEqual(first.name, "0005")  # which looks at a wall 6 m away
        self.assertGreater(depth, 15)
        stops = self.demo.film_stops(cameras, first, second)
        self.assertEqual(len(stops), len({camera.name for camera in stops}))
        (self.folder / "light.xp").write_text("sun(direction=\"0 0 1\")\n")
        text = self.demo.design_text(first, depth, self.demo.plane_of([(0, 0, 0.0)]), second, stops)
        (self.folder / "square.xp").write_text(text.replace('include(file="place.xp")', place.read_text()))
        for car in ("saloon_silver", "hatchback_red"):
            self.model().rename(self.folder / f"{car}.glb")
        done = run("check", self.folder / "square.xp")
        self.assertEqual(done.returncode, 0, done.stderr)
        # A step aside, for at a photograph's own viewpoint masks do not count.
        self.assertAlmostEqual(math.dist(cameras[0].position, cameras[0].beside("x").position), self.demo.ASIDE_M)
        self.assertIn('camera(name="view"', text)
        # An object 10 m before a camera that looks north-west by 20 degrees.
        x, y, _ = cameras[0].place(0, 10, 0)
        self.assertAlmostEqual(x, 12 - 10 * math.sin(math.radians(20)))
        self.assertAlmostEqual(y, 10 * math.cos(math.radians(20)))


class Captured(InAFolder):
    """A tree that the command photographs, small."""

    def photograph(self, views):
        capture = self.folder / "capture"
        done = run("tree", "synthesize", "winter", "--views", views, "--size", "64x64", "--samples", "4", "-o", capture)
        self.assertEqual(done.returncode, 0, done.stderr)
        return capture


class Trees(Captured):
    """What becomes of photographs; photographs that are killed and resumed."""

    def test_photographs_that_were_taken_before_a_kill_are_not_taken_again(self):
        first, whole = self.folder / "first", self.folder / "whole"
        steps = self.folder / "first.steps"
        command = ["tree", "synthesize", "winter", "--views", "6", "--held-out", "1", "--size", "96x96", "--samples", "64", "-o"]
        process = subprocess.Popen([PARVIS, *command, first], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not (steps / "winter_001.part").exists():
            time.sleep(0.01)
        self.assertIsNone(process.poll(), "it ended too soon for this test")
        process.kill()
        process.wait(timeout=60)
        self.assertFalse(first.exists())
        taken = (steps / "winter_000.part").stat().st_mtime_ns
        # The last one cannot be kept: so the steps stay to be looked at.
        (steps / "winter_held_out_000.part").mkdir()
        done = run(*command, first)
        self.assertEqual(done.returncode, 1)
        self.assertIn("winter_held_out_000", done.stderr)
        self.assertEqual((steps / "winter_000.part").stat().st_mtime_ns, taken, "taken once more")
        (steps / "winter_held_out_000.part").rmdir()
        self.assertEqual(run(*command, first).returncode, 0)
        self.assertFalse(steps.exists())
        self.assertEqual(run(*command, whole).returncode, 0)
        for name in ["winter_000.png", "winter_005.png", "held_out/winter_held_out_000.png"]:
            self.assertEqual((first / name).read_bytes(), (whole / name).read_bytes())

    def test_a_tree_is_packed_by_vector_quantisation(self):
        capture, volume = self.photograph(8), self.folder / "a.volume"
        tree, small, model = self.folder / "a.tree", self.folder / "small.tree", self.folder / "small.glb"
        quick = ["--level", "2", "--coarse-epochs", "1", "--fine-epochs", "0"]
        self.assertEqual(run("tree", "reconstruct", capture, "-o", volume, *quick).returncode, 0)
        self.assertEqual(run("tree", "texture", capture, volume, "-o", tree, "--parents", "0").returncode, 0)
        done = run("tree", "pack", tree)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("after packing disjoint alphas", done.stdout)
        self.assertEqual(run("tree", "pack", tree, "--codes", "16").returncode, 2, "codes without an output")
        done = run("tree", "pack", tree, "--codes", "16", "-o", small)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("share 16 codes", done.stdout)
        self.assertLess(small.stat().st_size, 0.6 * tree.stat().st_size)
        self.assertEqual(run("tree", "export", small, "-o", model).returncode, 0)
        again = self.folder / "again.tree"
        self.assertEqual(run("tree", "export", model, "-o", again).returncode, 0)
        self.assertLess(again.stat().st_size, 0.6 * tree.stat().st_size)

    def test_a_tree_holds_its_trunk(self):
        capture, volume = self.photograph(8), self.folder / "a.volume"
        quick = ["--level", "3", "--coarse-epochs", "1", "--fine-epochs", "0"]
        self.assertEqual(run("tree", "reconstruct", capture, "-o", volume, *quick).returncode, 0)
        truth, found = (float(re.search(r"height ([\d.]+) m", text)[1])
                        for text in ((capture / "truth.txt").read_text(), run("tree", "measure", volume).stdout))
        self.assertAlmostEqual(found, truth, delta=0.1 * truth)  # pictures of 64 x 64
        self.assertEqual((capture / "truth.glb").read_bytes()[:4], b"glTF")
        plain, whole = self.folder / "plain.tree", self.folder / "whole.tree"
        self.assertEqual(run("tree", "texture", capture, volume, "-o", plain, "--parents", "0").returncode, 0)
        done = run("tree", "texture", capture, volume, "-o", whole, "--parents", "0", "--trunk")
        self.assertEqual(done.returncode, 0, done.stderr)
        triangles = {}
        for name, tree in [("plain", plain), ("whole", whole)]:
            model = self.folder / f"{name}.glb"
            self.assertEqual(run("tree", "export", tree, "-o", model).returncode, 0)
            content = model.read_bytes()
            size = int.from_bytes(content[12:16], "little")
            triangles[name] = sum(len(mesh["primitives"]) for mesh in json.loads(content[20 : 20 + size])["meshes"])
        self.assertEqual(triangles["whole"], triangles["plain"] + 1, "the trunk is a part of the model")

    def test_two_photographs_are_too_few(self):
        capture = self.photograph(2)
        self.expect_failure("tree", "reconstruct", capture, "-o", self.folder / "a.volume", words=["2 photographs", "3"])

    def test_one_wrong_camera_among_twenty_is_named_and_left_out(self):
        capture = self.photograph(20)
        lines, wrong = (capture / "images.txt").read_text().splitlines(), "winter_007.png"
        for i, line in enumerate(lines):
            words = line.split()
            if words[-1:] == [wrong]:
                lines[i] = " ".join([*words[:5], str(float(words[5]) + 1.5), str(float(words[6]) + 0.7), *words[7:]])
        (capture / "images.txt").write_text("\n".join(lines) + "\n")
        output, quick = self.folder / "a.volume", ["--level", "2", "--coarse-epochs", "1", "--fine-epochs", "0"]
        done = run("tree", "reconstruct", capture, "-o", output, *quick)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{wrong}: its silhouette contradicts all other photographs", done.stdout)
        self.assertIn("19 photographs", done.stdout)
        tree = self.folder / "a.tree"
        done = run("tree", "texture", capture, output, "-o", tree, "--parents", "0")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{wrong}: its silhouette contradicts all other photographs", done.stdout)
        kept = self.folder / "kept.tree"
        done = run("tree", "texture", capture, output, "-o", kept, "--parents", "0", "--keep-inconsistent")
        self.assertIn("used all the same", done.stdout)
        self.assertLess(tree.stat().st_size, kept.stat().st_size, "textures of one photograph less")


class AllTrees(Captured):
    """Reconstructions by two processes, and killed and resumed: with script/test --full."""

    @unittest.skipUnless(shutil.which("mpirun"), "there is no mpirun here: package openmpi-bin")
    def test_two_processes_reconstruct_the_tree_of_one(self):
        capture, volumes = self.photograph(8), {}
        for name, before, iterations in [("one", [], 20), ("two", MPIRUN, 20), ("less", [], 19)]:
            output = self.folder / f"{name}.volume"
            options = ["--level", "3", "--iterations", iterations, "--fine-epochs", "1"]
            done = run("tree", "reconstruct", capture, "-o", output, *options, before=before)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("2 processes"), 1 if before else 0, "one of them reports")
            volumes[name] = output.read_bytes()
        self.assertGreater(len(volumes["one"]), 20_000)
        self.assertEqual(volumes["one"], volumes["two"], "sums are exact: capture/trees/exact_sum.h")
        self.assertNotEqual(volumes["one"], volumes["less"], "the control")

    def test_what_is_killed_or_interrupted_goes_on_where_it_was(self):
        capture, whole, output = self.photograph(8), self.folder / "whole.volume", self.folder / "a.volume"
        steps = self.folder / "a.volume.steps"
        command = ["tree", "reconstruct", capture, "--level", "3", "--iterations", "6", "--fine-epochs", "40", "-o"]
        for signal_sent, words in [(signal.SIGKILL, ""), (signal.SIGINT, "goes on from there")]:
            (steps / "opacity.part").unlink(missing_ok=True)
            process = subprocess.Popen(
                [PARVIS, *map(str, command), output], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
            )
            while process.poll() is None and not (steps / "opacity.part").exists():
                time.sleep(0.01)
            time.sleep(0.2)
            self.assertIsNone(process.poll(), "it ended too soon for this test")
            process.send_signal(signal_sent)
            _, reported = process.communicate(timeout=60)
            self.assertNotEqual(process.returncode, 0)
            self.assertIn(words, reported)
            self.assertFalse(output.exists())
        done = run(*command, output)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("steps kept before: 6", done.stdout)
        self.assertFalse(steps.exists())
        self.assertEqual(run(*command, whole).returncode, 0)
        self.assertEqual(output.read_bytes(), whole.read_bytes())


class BadScripts(InAFolder):
    def test_names_that_are_not_there_or_taken(self):
        place = 'camera(name="a")\ngroup(name="trees") { }\n'
        self.expect_bad_scene(
            place + 'keys(onPress="button2, treess, show, 0.5", onPress="h, trees, dance")\n',
            "scene.xp:3:14:", '"treess"', '"trees"', "scene.xp:3:52:", '"dance"', "toggle",
        )
        self.expect_bad_scene(
            place + 'scenario(name="green") {\n  override(of="oaks", visible=1)\n  override(of="%sky", intensity=4)\n'
            '  override(of="trees", visibel=1)\n}\n',
            "scene.xp:4:15:", '"oaks"', "scene.xp:5:15:", "no sky", "scene.xp:6:24:", '"visibel"', '"visible"',
        )
        self.expect_bad_scene(place + 'group(name="trees") { }\n', "scene.xp:3:12:", '"trees"', "scene.xp:2")

    def test_a_storm_of_events_spreads_over_steps(self):
        storm = ", ".join(['onTime="1, trees, toggle"'] * 10_000)
        scene = self.write("scene.xp", f'camera(name="a")\ngroup(name="trees") {{ }}\ntimer({storm})\n')
        self.assertEqual(run("check", scene).returncode, 0)
        done = run("render", scene, *SIZE, "--time", "2", "-o", self.folder / "out.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = done.stdout + done.stderr
        self.assertEqual(told.count("warning"), 1, told[:2000])
        for word in ["scene.xp:3:", "more than 1000 messages", '"toggle"', '"trees"']:
            self.assertIn(word, told)

    def test_cyclic_includes(self):
        self.write("other.xp", 'include(file="scene.xp")\n')
        self.expect_bad_scene('sun()\ninclude(file="other.xp")\n', "other.xp", "scene.xp", is_rendered=True)

    def test_unknown_words(self):
        self.expect_bad_scene("sun()\nmodle()\n", "scene.xp:2:", "modle", "model", is_rendered=True)
        self.expect_bad_scene("\n\nsun(azimut_deg=3)\n", "scene.xp:3:", "azimut_deg", "azimuth_deg")

    def test_ten_megabytes_of_brackets(self):
        for brackets in ["(", "{", "a(){", ")"]:
            self.expect_bad_scene(brackets * (10_000_000 // len(brackets)), "scene.xp:1:")

    def test_paths_that_lead_out(self):
        for path in ["../secret.glb", "/etc/passwd", "a/../../secret.glb"]:
            self.expect_bad_scene(f'sun()\nmodel(file="{path}")\n', "scene.xp:2:", path)


class Surroundings(InAFolder):
    def test_an_output_folder_that_cannot_be_made(self):
        self.write("taken", "a file, not a folder")
        scene = self.write("scene.xp", 'camera(name="a", position="0 -9 2")\n')
        inside = self.folder / "taken" / "out.png"
        self.expect_failure("render", scene, *SIZE, "-o", inside, words=["taken"])
        film = inside.with_suffix(".mp4")
        self.expect_failure("render", scene, *SIZE, "--seconds", "0.1", "-o", film, words=["taken", "choose"])
        self.expect_failure("reference", scene, *SIZE, "--samples", "1", "-o", inside, words=["taken"])
        self.expect_failure("city", "paper", "-o", inside.parent, words=["taken"])

    def test_an_output_of_no_known_kind(self):
        scene = self.write("scene.xp", 'camera(name="a", position="0 -9 2")\n')
        self.expect_failure("render", scene, *SIZE, "-o", self.folder / "out.xyz", words=["out.xyz"])
        film = self.folder / "out.gif"
        self.expect_failure("render", scene, *SIZE, "--seconds", "0.1", "-o", film, words=["out.gif", ".mp4"])

    def test_an_interrupted_film(self):
        scene = self.write("scene.xp", 'camera(name="a", position="0 -9 2")\n')
        film = self.folder / "film.mp4"
        command = [PARVIS, "render", str(scene), *SIZE, "--seconds", "3600", "-o", str(film)]
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        while not self.files()[0].startswith(".") and process.poll() is None:
            time.sleep(0.05)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, told)
        self.assertIn("interrupted", told)
        self.assertEqual(self.files(), ["scene.xp"])

    def test_a_driver_below_opengl_4_5(self):
        scene = self.write("scene.xp", "sun()\n")
        self.expect_failure(
            "render", scene, *SIZE, "-o", self.folder / "out.png",
            words=["offers OpenGL 3.3", "4.5"], environment={"MESA_GL_VERSION_OVERRIDE": "3.3"},
        )


class Displays(BeforeAMirror):
    """Scenes on the walls of a room."""

    ROOM = {
        "parvis_display": 1, "stereo": "anaglyph", "head": "head", "wand": "wand",
        "walls": [
            {"name": "front", "lower_left": [-1, 2, 0], "lower_right": [1, 2, 0], "upper_right": [1, 2, 2], "pixels": [64, 64]},
            {"name": "floor", "lower_left": [-1, 0, 0], "lower_right": [1, 0, 0], "upper_right": [1, 2, 0], "pixels": [64, 64]},
        ],
    }

    def write_room(self, **changes):
        return self.write("room.json", json.dumps({**self.ROOM, **changes}))

    def test_each_wall_and_eye_is_drawn_and_traced(self):
        scene, room = self.write_place(), self.write_room()
        for command, options in [("render", []), ("reference", ["--samples", "4"])]:
            done = run(command, scene, "--display", room, *options, "-o", self.folder / command)
            self.assertEqual(done.returncode, 0, done.stderr)
            names = sorted(path.name for path in (self.folder / command).iterdir())
            self.assertEqual(names, [f"{wall}{eye}.png" for wall in ["floor", "front"] for eye in ["", "_left", "_right"]])
        pictures = {path.name: path.read_bytes() for path in (self.folder / "render").iterdir()}
        self.assertNotEqual(pictures["front_left.png"], pictures["front_right.png"])
        self.assertEqual(run("render", scene, "--display", room, "--eye", "0.4,0.2,1.6", "--wall", "front", "-o", self.folder / "moved").returncode, 0)
        self.assertEqual(sorted(path.name for path in (self.folder / "moved").iterdir()), ["front.png", "front_left.png", "front_right.png"])
        self.assertNotEqual((self.folder / "moved/front.png").read_bytes(), pictures["front.png"])

    def test_every_example_is_drawn(self):
        for example in sorted((ROOT / "scenes/displays").iterdir()):
            if example.name == "wand.json" or example.suffix == ".txt":  # of a wand, and what a tracker sent
                continue
            done = run("render", self.write_place(), "--display", example, "-o", self.folder / "out")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_bad_input_is_answered(self):
        scene, out = self.write_place(), self.folder / "out"
        for changes, words in [({"stereo": "both"}, ["stereo", "anaglyph"]), ({"parvis_display": 7}, ["version 7", "version 1"]),
                               ({"walls": self.ROOM["walls"] * 150}, ["300 walls", "64"])]:
            self.expect_failure("render", scene, "--display", self.write_room(**changes), "-o", out, words=words)
        corners = self.write("a.pvx", "<pvx><Machine Name='x'/></pvx>")
        self.expect_failure("render", scene, "--display", corners, "-o", out, words=["a.pvx:1", "without corners"])
        self.expect_failure("render", scene, "--display", self.write_room(), "--eye", "0,9,0", "-o", out, words=["not before wall"])
        self.expect_failure("render", scene, "--display", self.write_room(), "--wall", "frond", "-o", out, words=["no such wall", "front"])
        self.write("devices.json", '{"parvis_devices": 1, "buttons": {"1": "dance"}}')
        self.expect_failure("view", scene, "--display", self.write_room(), "--devices", self.folder / "devices.json", words=["dance", "view plan"])

    def test_windows_show_what_render_writes(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        scene, room = self.write_place(), self.write_room(head="", wand="")
        done = run("view", scene, "--display", room, "--frames", "3", "--walls-output", self.folder / "shown", before=["xvfb-run", "-a", "-f", str(self.folder / "Xauthority")])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run("render", scene, "--display", room, "-o", self.folder / "drawn").returncode, 0)
        for name in ["front.png", "floor_left.png"]:
            self.assertEqual(pixels((self.folder / "shown" / name).read_bytes()), pixels((self.folder / "drawn" / name).read_bytes()))


class DividedWalls(Divided):
    """Walls of several processes."""

    def begin(self, *options):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        room = self.write("room.json", json.dumps({**Displays.ROOM, "head": "", "wand": ""}))
        self.said = open(self.folder / "said", "w+")
        self.addCleanup(self.said.close)
        command = ["xvfb-run", "-a", "-f", str(self.folder / "Xauthority"), *MPIRUN, PARVIS, "view", self.write_place(), "--display", room, *options]
        process = subprocess.Popen(list(map(str, command)), stdout=self.said, stderr=self.said, start_new_session=True)
        self.addCleanup(process.wait)
        self.addCleanup(lambda: process.poll() is None and os.killpg(process.pid, 15))
        return process

    def frames(self, rank):
        log = self.folder / f"log.{rank}.csv"
        return [line.split(",") for line in log.read_text().splitlines()] if log.exists() else []

    def test_they_show_the_same_second(self):
        process = self.begin("--frames", "20", "--frame-log", self.folder / "log")
        self.assertEqual(process.wait(timeout=120), 0)
        first, second = self.frames(0), self.frames(1)
        self.assertEqual(len(first), 20)
        self.assertEqual([(frame, seconds) for frame, _, seconds in first], [(frame, seconds) for frame, _, seconds in second])
        self.said.seek(0)
        said = self.said.read()
        self.assertIn('process 1 shows wall "floor"', said)
        self.assertNotIn("another state", said)

    def wait_until(self, holds):
        began = time.monotonic()
        while not holds():
            self.assertLess(time.monotonic() - began, 120)
            time.sleep(0.1)

    def begin_with_mpirun(self):
        """A show that has begun, and the number of its mpirun."""
        process = self.begin("--frame-log", self.folder / "log")
        self.wait_until(lambda: process.poll() is not None or min(len(self.frames(0)), len(self.frames(1))) > 1)
        self.assertIsNone(process.poll())
        (mpirun,) = (int(pathlib.Path(status).parent.name) for status in glob.glob("/proc/[0-9]*/status")
                     if self.is_mpirun_of(status, process.pid))
        return process, mpirun

    def test_one_that_hangs_is_named_and_waited_for(self):
        process, mpirun = self.begin_with_mpirun()
        hangs = self.process_of_rank(1, mpirun)
        os.kill(hangs, signal.SIGSTOP)
        try:
            self.wait_until(lambda: "process 1 has not answered for 1 s" in pathlib.Path(self.said.name).read_text())
            shown = len(self.frames(0))
        finally:
            os.kill(hangs, signal.SIGCONT)
        self.wait_until(lambda: len(self.frames(0)) > shown + 2)
        self.assertIsNone(process.poll())

    def test_one_that_dies_ends_the_show(self):
        process, mpirun = self.begin_with_mpirun()
        os.kill(self.process_of_rank(1, mpirun), 9)
        killed = time.monotonic()
        while self.is_running(mpirun):
            time.sleep(0.02)
            self.assertLess(time.monotonic() - killed, 60)
        self.assertLess(time.monotonic() - killed, 10)  # a second on a machine with nothing else to do
        self.assertNotEqual(process.wait(timeout=60), 0)
        self.said.seek(0)
        self.assertRegex(self.said.read(), r"rank 1 .*(\n.*)?exited on signal 9")

    def is_running(self, number):
        try:
            return "State:\tZ" not in pathlib.Path(f"/proc/{number}/status").read_text()
        except OSError:
            return False

    def is_mpirun_of(self, status, session):
        try:
            return os.getsid(int(pathlib.Path(status).parent.name)) == session and "Name:\tmpirun" in pathlib.Path(status).read_text()
        except OSError:
            return False


class Window(InAFolder):
    pictures = tempfile.TemporaryDirectory()  # of the catalogue, for all tests

    def display(self):
        """The command that runs another one in front of a display of its own.

        Its key stands in the test's folder: xvfb-run's own folder is sometimes gone before it is cleaned up (status 5).
        """
        return ["xvfb-run", "-a", "-f", str(self.folder / "Xauthority")]

    def test_it_shows_frames_and_writes_the_last(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        scene = self.write("scene.xp", 'sun()\ncamera(name="a", position="0 -9 2")\n')
        picture = self.folder / "last.png"
        done = run("view", scene, *SIZE, "--frames", "3", "--screenshot", picture, before=self.display())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_a_rate_is_held_by_drawing_fewer_pixels(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        scene = self.write("scene.xp", 'sun()\ncamera(name="a", position="0 -9 2")\n')
        command = ["view", scene, "--size", "640x480", "--frames", "80"]
        for rate, fewer in [("1000", True), ("off", False), (None, False)]:
            done = run(*command, *(["--fps", rate] if rate else []), before=self.display())
            self.assertEqual(done.returncode, 0, done.stderr)
            drawn = float(done.stdout.split("the last one drew ")[1].split()[0])
            self.assertEqual(drawn < 50, fewer, f"--fps {rate}: {drawn} %")
        self.assertEqual(run("view", scene, *SIZE, "--frames", "2", "--fps", "auto", before=self.display()).returncode, 0)
        for wrong in ["0", "fast", "-3", "10 20"]:
            self.expect_failure("view", scene, f"--fps={wrong}", words=["--fps", "frames per second", "off"])

    def test_at_rest_it_says_how_far_it_has_refined(self):
        if not shutil.which("xvfb-run") or not shutil.which("xdotool"):
            self.skipTest("skipped: no xvfb-run or no xdotool here")
        scene = self.write("scene.xp", 'sun()\ncamera(name="a", position="0 -9 2")\n')
        drive = self.write(
            "drive.sh",
            f"{shlex.join(map(str, [PARVIS, 'view', scene, *SIZE]))} & parvis=$!\n"
            "timeout 60 xdotool search --sync --onlyvisible --name Parvis > window || exit 3\n"
            "for wait in $(seq 300); do\n"
            "  xdotool getwindowname $(cat window) > title; grep -q 'reference picture, 256' title && break\n"
            "  sleep 0.2\ndone\n"
            "xdotool keydown d sleep 1 getwindowname $(cat window) keyup d > moving\n"
            "xdotool key Escape\nwait $parvis\n",
        )
        done = subprocess.run([*self.display(), "sh", str(drive)], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("reference picture, 256 rays per pixel", (self.folder / "title").read_text())
        self.assertEqual((self.folder / "moving").read_text().strip(), "Parvis: scene")

    def test_mouse_and_keys_drive_it(self):
        """The panel opened and a scenario switched by keys, a picture taken by a click; the window is golden."""
        if not shutil.which("xvfb-run") or not shutil.which("xdotool"):
            self.skipTest("skipped: no xvfb-run or no xdotool here")
        self.write("sail.glb", glb(*triangle(positions=(0, 0, 0, 4, 0, 0, 0, 4, 0))))
        scene = self.write(
            "scene.xp",
            'sun(azimuth_deg=200, elevation_deg=40)\nmodel(name="sail", file="sail.glb", scale=1.5)\n'
            'camera(name="a", position="2 -9 2", target="2 0 2")\n'
            'scenario(name="turned", title="Turned sail") { override(of="sail", heading_deg=35) }\n',
        )
        last = self.folder / "last.png"
        command = [PARVIS, "view", scene, "--size", "960x640", "--output", self.folder / "pictures", "--screenshot", last]
        drive = self.write(
            "drive.sh",
            f"{shlex.join(map(str, command))} & parvis=$!\n"
            "timeout 60 xdotool search --sync --onlyvisible --name Parvis > window || exit 3\n"
            "xdotool mousemove --window $(cat window) 300 300 key F2 sleep 0.5 key Tab sleep 0.5\n"
            # The button "Picture": on a busy machine the panel is drawn later than it is asked for.
            "for i in $(seq 30); do xdotool mousemove --window $(cat window) 674 617 sleep 0.5 click 1 sleep 0.5\n"
            "  [ -e pictures/scene-0001.png ] && break; done\n"
            "xdotool mousemove --window $(cat window) 300 300 sleep 6 key Escape\n"  # notices are gone by then
            "wait $parvis\n",
        )
        done = subprocess.run(
            [*self.display(), "-s", "-screen 0 960x640x24", "sh", str(drive)],
            capture_output=True, text=True, timeout=120, cwd=self.folder,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        taken = self.folder / "pictures" / "scene-0001.png"
        self.assertEqual(struct.unpack(">II", taken.read_bytes()[16:24]), (610, 640), "the picture beside the panel")
        self.expect_golden(last, "window")

    def drive(self, command, steps, keyboard="us", **options):
        """Runs `parvis view` on a display of 1280 x 720 and drives it by xdotool."""
        if not shutil.which("xvfb-run") or not shutil.which("xdotool"):
            self.skipTest("skipped: no xvfb-run or no xdotool here")
        script = self.write(
            "drive.sh",
            (f"setxkbmap {keyboard}\n" if keyboard != "us" else "") +
            f"{shlex.join(map(str, [PARVIS, 'view', *command, '--size', '1280x720']))} & parvis=$!\n"
            "timeout 60 xdotool search --sync --onlyvisible --name Parvis > window || exit 3\n"
            "at() { xdotool mousemove --window $(cat window) $1 $2 sleep 1; }\n"
            "click() { at $1 $2; xdotool click 1 sleep 2; }\n"
            "key() { xdotool key $1 sleep 1; }\n"
            # On a busy machine a second Escape may come too late to be the second one.
            "leave() { while kill -0 $parvis 2> /dev/null; do key Escape; done; wait $parvis; }\n"
            # All kinds of the catalogue are drawn and kept.
            f"pictures() {{ for i in $(seq 200); do [ $(ls {self.pictures.name}/parvis 2> /dev/null | wc -l) -ge 19 ] && break; sleep 0.5; done; sleep 2; }}\n"
            "sleep 6\n" + steps,  # the window is there before its first frame
        )
        done = subprocess.run(
            [*self.display(), "-s", "-screen 0 1280x720x24 -noreset", "sh", str(script)],
            capture_output=True, text=True, timeout=240, cwd=self.folder, env={**os.environ, "XDG_CACHE_HOME": self.pictures.name}, **options,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def write_square(self):
        return self.write(
            "square.xp",
            'sun(azimuth_deg=200, elevation_deg=40)\n'
            'design(name=design) { surface(name=ground, material=plain, outline="-60 -60, 60 -60, 60 60, -60 60") }\n'
            'camera(name="street", position="0 -12 1.7", target="0 0 0.5")\n',
        )

    def test_a_bench_is_placed_moved_and_saved_by_hand(self):
        scene = self.write_square()
        last = self.folder / "last.png"
        self.drive(
            [scene, "--plan", "--screenshot", last],
            "key k\npictures\nclick 110 590\n"  # the first picture of the catalogue
            "click 640 400\nkey Escape\nkey k\n"
            "key 4\nsleep 2.5\nclick 700 250\nclick 640 360\n"  # in the plan
            "key ctrl+s\nleave\n",
        )
        self.assertIn("bench_wood", scene.read_text(), "the design is saved in its own file")
        self.assertIn("bench_wood_1", run("plan", scene, "--list").stdout)

    def test_what_was_done_is_there_again_after_a_kill(self):
        scene = self.write_square()
        self.drive([scene, "--plan"], "key k\npictures\nclick 110 590\nclick 640 400\nsleep 1\nkill -9 $parvis\nwait $parvis\ntrue\n")
        listed = run("plan", scene, "--journal", "--list").stdout
        self.assertIn("bench_wood_1", listed)
        self.assertIn("that had not been saved", listed)

    def test_commands_are_written_by_name_in_french_on_a_french_keyboard(self):
        if not shutil.which("setxkbmap"):
            self.skipTest("skipped: no setxkbmap here")
        scene = self.write_square()
        self.drive(
            [scene, "--plan", "--language", "fr", "--text-size", "150", "--screenshot", self.folder / "last.png"],
            "write() { sleep 1; xdotool type --delay 60 \"$1\"; sleep 1; xdotool key $2; sleep 1; }\n"
            "xdotool key ctrl+k\nwrite 'ins' Tab\nwrite 'bench_w' Tab\nwrite ' 1.25,2.5 name first' Return\n"
            "write 'insert bollard 4,4 name second' Return\n"
            # Ctrl and the key labelled Z, which lies where an American W does: the bollard goes.
            "key Escape\nxdotool key --clearmodifiers ctrl+z sleep 1\n"
            "key ctrl+s\nleave\n",
            keyboard="fr",
        )
        listed = run("plan", scene, "--list").stdout
        self.assertIn("first", listed)
        self.assertNotIn("second", listed)

    def expect_golden(self, picture, name):
        """The picture looks like docs/goldens/NAME.png; fonts and edges are the machine's own."""
        golden = pathlib.Path(__file__).resolve().parents[2] / "docs" / "goldens" / f"{name}.png"
        if os.environ.get("PARVIS_UPDATE_GOLDENS"):
            shutil.copyfile(picture, golden)
        compared = run("compare", picture, golden)
        self.assertEqual(compared.returncode, 0, compared.stderr)
        self.assertLess(float(compared.stdout.split()[1]), 0.01, "FLIP: " + compared.stdout)

    def test_a_driver_below_opengl_4_5_is_named(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        scene = self.write("scene.xp", "sun()\n")
        done = run("view", scene, "--frames", "1", before=self.display(),
                   environment={"MESA_GL_VERSION_OVERRIDE": "3.3"})
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("offers OpenGL 3.3", done.stderr)

    def test_without_a_display_it_says_so(self):
        scene = self.write("scene.xp", "sun()\n")
        self.expect_failure(
            "view", scene, "--frames", "1", words=["display"],
            environment={"DISPLAY": "", "WAYLAND_DISPLAY": ""},
        )


class Noise(InAFolder):
    """The map of noise: its files, the difference of two states, a traffic that changes, what cannot be computed."""

    ROAD = 'road(name="street", path="-90 0, 90 0", speed_km_h=30)\npaving()\nterrain_plane()\ntrafficCount(per_hour="420 210 60")\n'

    def house(self):
        """A house of 20 x 8 x 9 m north of the road, which the scenario "without" hides."""
        corners = [(x, y, z) for z in (0, 9) for y in (12, 20) for x in (-10, 10)]
        faces = [(1, 2, 6, 5), (4, 3, 7, 8), (3, 1, 5, 7), (2, 4, 8, 6), (5, 6, 8, 7)]
        self.write("house.ply", f"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                   f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
                   + "".join("%g %g %g\n" % corner for corner in corners) + "".join("4 %d %d %d %d\n" % tuple(i - 1 for i in face) for face in faces))
        return ('model(name="house", file="house.ply")\nscenario(name="without") {\n  override(of="house", visible=0)\n}\n')

    def rows(self, name):
        with open(self.folder / name) as table:
            return list(csv.DictReader(table))

    def test_its_files_agree_and_two_states_differ_behind_the_house(self):
        scene = self.write("scene.xp", self.ROAD + self.house())
        done = run("noise", scene, "--area", -20, 4, 20, 34, "--against", "without", "-o", self.folder / "n")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("n.png", "n.tif", "n.glb", "n_Lden.png", "n_facades.csv", "n_difference.png"):
            self.assertGreater((self.folder / name).stat().st_size, 100, name)
        at = {(float(row["x_m"]), float(row["y_m"])): row for row in self.rows("n.csv")}
        self.assertNotIn((2.5, 16.5), at, "in the house")
        near, behind = float(at[2.5, 6.5]["lden_db"]), float(at[2.5, 26.5]["lden_db"])
        self.assertGreater(near, behind + 12)
        change = {(float(row["x_m"]), float(row["y_m"])): float(row["difference_db"]) for row in self.rows("n_difference.csv")}
        self.assertLess(change[2.5, 26.5], -5)
        self.assertGreater(change[2.5, 6.5], 0, "the facade reflects")
        facades = self.rows("n_facades.csv")
        self.assertEqual({row["floor"] for row in facades}, {"0", "1", "2"})
        south = [float(row["lden_db"]) for row in facades if float(row["facing_y"]) < -0.9]
        north = [float(row["lden_db"]) for row in facades if float(row["facing_y"]) > 0.9]
        self.assertGreater(min(south), max(north) + 8)
        if shutil.which("gdalinfo"):
            said = subprocess.run(["gdalinfo", "-stats", self.folder / "n.tif"], capture_output=True, text=True).stdout
            self.assertIn("Description = Lden dB(A)", said)
            loudest = max(float(row["lden_db"]) for row in at.values())
            self.assertAlmostEqual(float(re.search(r"Maximum=([0-9.]+)", said)[1]), loudest, delta=0.1)

    def test_traffic_that_changes_recolours_the_map_of_a_scene(self):
        scene = self.write("scene.xp", self.ROAD + 'noiseMap(name="map", area="-40 5 0, 40 40 0", cell=5)\nsun()\n'
                           'scenario(name="busy") {\n  override(of="map", traffic_factor=10)\n}\ncamera(name="a", position="0 -40 60", target="0 20 0")\n')
        done = run("render", scene, *SIZE, "--scenario", "base", "--scenario", "busy", "-o", self.folder / "out.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        base, busy = (pixels((self.folder / f"out-{name}.png").read_bytes()) for name in ("base", "busy"))
        self.assertNotEqual(base, busy)

    def test_trams_mark_every_level_as_indicative(self):
        scene = self.write("scene.xp", 'tram(path="-90 0, 90 0", headway_s=300) {\n  tramStop(position="0 -3 0")\n}\nterrain_plane()\n')
        done = run("noise", scene, "--area", -20, 8, 20, 28, "-o", self.folder / "n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"dB\(A\) \(indicative\)")
        self.assertIn("lden_db_indicative", self.rows("n.csv")[0])

    def test_what_cannot_be_computed_is_said(self):
        for script, words in (("sun()\n", "no roads"), ('road(path="-9 0, 9 0")\n', "trafficCount"), (self.ROAD.replace("(per_hour", '(road="alley", per_hour'), "name"),
                              ('noiseSource(path="0 0 1", power_db="1 2 3")\n', "eight")):
            self.expect_failure("noise", self.write("scene.xp", script), "-o", self.folder / "n", words=[words])
        scene = self.write("scene.xp", self.ROAD + self.house())
        self.expect_failure("noise", scene, "--area", -5, 13, 4, 19, "--cell", 3, "--ground-only", "-o", self.folder / "n", words=["buildings"])
        self.expect_failure("noise", scene, "--area", 0, 0, 9000, 9000, "--cell", 1, "-o", self.folder / "n", words=["larger --cell"])


class Sounds(InAFolder):
    """Sound files that are read and written, the window's sound, and the server."""

    def tone(self, name, seconds=1.0, amplitude=0.3, bytes_kept=None):
        samples = [round(32767 * amplitude * math.sin(2 * math.pi * 1000 * i / 48000)) for i in range(int(48000 * seconds))]
        with wave.open(str(self.folder / name), "wb") as file:
            file.setnchannels(1), file.setsampwidth(2), file.setframerate(48000)
            file.writeframes(struct.pack(f"<{len(samples)}h", *samples))
        if bytes_kept is not None:
            whole = (self.folder / name).read_bytes()
            (self.folder / name).write_bytes(whole[:bytes_kept])

    def samples(self, name):
        with wave.open(str(self.folder / name), "rb") as file:
            return struct.unpack(f"<{file.getnframes() * file.getnchannels()}h", file.readframes(file.getnframes()))

    def test_a_walk_with_a_recording_is_heard_in_named_channels(self):
        self.tone("tone.wav")
        scene = self.write("scene.xp", 'sound(kind="recording", file="tone.wav", position="-5 0 1.7", level_db=20)\n')
        heard = self.folder / "heard.wav"
        done = run("sound", scene, "--camera-path", "0 -3 1.7, 0 3 1.7", "--seconds", 1, "--for", "5.1", "-o", heard)
        self.assertEqual(done.returncode, 0, done.stderr)
        header = heard.read_bytes()[:68]
        self.assertEqual(struct.unpack("<H", header[22:24])[0], 6, "channels")
        self.assertEqual(struct.unpack("<I", header[40:44])[0], 0x60F, "their names")
        samples = struct.unpack("<288000h", heard.read_bytes()[68:])
        energies = [sum(it * it for it in samples[channel::6]) for channel in range(6)]
        self.assertEqual(energies[3], 0, "low frequencies")
        self.assertGreater(energies[0] + energies[4], 10 * (energies[1] + energies[5]), "from the left")

    def test_bad_sound_files_are_named(self):
        scene = self.folder / "scene.xp"
        self.tone("cut.wav", bytes_kept=60)
        self.tone("silent.wav", amplitude=0.0)
        (self.folder / "empty.ogg").write_bytes(b"")
        (self.folder / "large.wav").write_bytes(b"RIFF" + bytes(70 << 20))
        for name in ("cut.wav", "silent.wav", "empty.ogg", "large.wav", "missing.wav"):
            self.write("scene.xp", f'sound(kind="bed", file="{name}")\n')
            self.expect_failure("check", scene, words=[name])
        self.write("scene.xp", 'sound(kind="bed")\n')
        self.expect_failure("check", scene, words=["file=", "scene.xp:1"])

    def server(self, device, seconds, **environment):
        return subprocess.Popen([PARVIS, "soundserver", "--port", "0", "--device", str(device), "--seconds", str(seconds)], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, env={**os.environ, **environment})

    def port_of(self, server):
        return int(re.search(r"port (\d+)", server.stdout.readline())[1])

    def osc(self, address, types="", arguments=b""):
        text = lambda value: value.encode() + bytes(4 - len(value) % 4)
        return text(address) + text("," + types) + arguments

    def fountain(self, *direction):
        return self.osc("/parvis/sound", "is" + "f" * 12, struct.pack(">i", 7) + b"fountain" + bytes(4) + struct.pack(">12f", *direction, *[70] * 8, 0.1))

    def test_a_server_plays_what_it_is_sent_and_survives_the_rest(self):
        with self.server(self.folder / "served.wav", 3) as server:
            port = self.port_of(server)
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
                client.settimeout(5)
                client.sendto(self.osc("/parvis/ping"), ("127.0.0.1", port))
                self.assertTrue(client.recv(100).startswith(b"/parvis/pong"))
                sound = self.fountain(-1, 0, 0)
                for packet in (b"/parvis/sound\0\0\0", b"#bundle\0", b"x", sound[:40], sound):
                    client.sendto(packet, ("127.0.0.1", port))
            _, errors = server.communicate(timeout=60)
        self.assertEqual(server.returncode, 0, errors)
        self.assertIn("4 packets were refused", errors)
        samples = self.samples("served.wav")
        self.assertGreater(max(samples[0::2]), 20, "the fountain")
        self.assertEqual(max(map(abs, samples[-2000:])), 0, "faded away after two seconds")

    def heard_by_openal(self, device, *direction):
        """The channels of two seconds in which OpenAL Soft plays a fountain into a file, and their rate."""
        heard = self.folder / "heard.wav"
        settings = self.write("alsoft.conf", f"[general]\nchannels = surround51\nsample-type = int16\n[wave]\nfile = {heard}\n")
        with self.server(device, 2, ALSOFT_DRIVERS="wave", ALSOFT_CONF=str(settings)) as server:
            port = self.port_of(server)
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
                for _ in range(10):
                    client.sendto(self.fountain(*direction), ("127.0.0.1", port))
                    time.sleep(0.1)
            _, errors = server.communicate(timeout=60)
        self.assertEqual(server.returncode, 0, errors)
        content = heard.read_bytes()
        channels, rate = struct.unpack("<HI", content[22:28])
        samples = content[content.index(b"data") + 8:]
        frames = len(samples) // (2 * channels)
        samples = struct.unpack(f"<{frames * channels}h", samples[:2 * frames * channels])
        return [samples[channel::channels] for channel in range(channels)], rate

    def test_openal_plays_on_for_as_long_as_something_sounds(self):
        (left, right), rate = self.heard_by_openal("default", -1, 0, 0)
        self.assertEqual(rate, 48000, "nothing is resampled")
        tenths = [sum(it * it for it in left[begin:begin + 4800]) for begin in range(0, len(left) - 4800, 4800)]
        loud = [i for i, energy in enumerate(tenths) if energy > 0.05 * max(tenths)]
        self.assertGreater(max(tenths), 1e9)
        self.assertGreater(len(loud), 7, tenths)
        self.assertGreater(sum(it * it for it in left), 2 * sum(it * it for it in right), "from the left")

    def test_loudspeakers_by_openal_have_a_centre(self):
        channels, _ = self.heard_by_openal("default@5.1", 0, 1, 0)
        self.assertEqual(len(channels), 6)
        energies = [sum(it * it for it in channel) for channel in channels]
        self.assertGreater(energies[2], 1e9)
        self.assertGreater(energies[2], 100 * (sum(energies) - energies[2]), "ahead is the centre alone")

    def test_recordings_and_beds_of_a_window_reach_a_server(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        self.tone("bed.wav", 2.0)
        scene = self.write("scene.xp", 'sun()\nsound(kind="bed", file="bed.wav", level_db=20)\ncamera(name="a", position="0 -3 2")\n')
        with self.server(self.folder / "served.wav", 20) as server:
            done = run("view", scene, *SIZE, "--frames", 1200, "--sound", f"osc://127.0.0.1:{self.port_of(server)}",
                       before=["xvfb-run", "-a", "-f", str(self.folder / "Xauthority")])
            self.assertEqual(done.returncode, 0, done.stderr)
            server.send_signal(signal.SIGINT)
            _, errors = server.communicate(timeout=60)
        self.assertNotIn("refused", errors)
        self.assertGreater(max(self.samples("served.wav")), 1000, errors)

    def test_the_window_sounds_and_goes_on_without_a_device(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("skipped: no xvfb-run here")
        scene = self.write("scene.xp", 'sun()\nsound(kind="fountain", position="0 3 1")\ncamera(name="a", position="0 -3 2")\n')
        before = ["xvfb-run", "-a", "-f", str(self.folder / "Xauthority")]
        command = ["view", scene, *SIZE, "--frames", 60]
        done = run(*command, "--sound", self.folder / "window.wav", before=before)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(max(self.samples("window.wav")), 20)
        done = run(*command, "--sound", "no such device", before=before)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    PARVIS = os.path.abspath(sys.argv.pop(1))
    unittest.main(testRunner=unittest.TextTestRunner(verbosity=2, resultclass=TimedResult))  # names those skipped, too
