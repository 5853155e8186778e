"""City models, maps and terrain."""

import json
import math
import struct

from .case import CAMERA, Case, model_case, scene, write

HEAD = '<?xml version="1.0" encoding="UTF-8"?>'


def city(**changes):
    geometry = [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2]]]}]
    return json.dumps({"type": "CityJSON", "version": "1.1", "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]},
                       "vertices": [[0, 0, 0], [9, 0, 0], [0, 0, 9]],
                       "CityObjects": {"a": {"type": "Building", "geometry": geometry}}, **changes})


def boundaries(value, kind="MultiSurface"):
    return city(CityObjects={"a": {"type": "Building", "geometry": [{"type": kind, "lod": "2", "boundaries": value}]}})


def star(points, step):
    """A polygon that crosses itself everywhere."""
    vertices, order, at = [], [], 0
    for i in range(points):
        vertices.append([1000 * math.cos(6.28318 * i / points), 1000 * math.sin(6.28318 * i / points), 0])
    for _ in range(points):
        order.append(at)
        at = (at + step) % points
    return city(vertices=vertices, CityObjects={"a": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[order]]}]}})


def crossing(points, step):
    """A star beside a plain polygon of as many points: it takes about as long, whatever becomes of it."""

    def build(folder):
        commands = []
        for name, turn in (("plain", 1), ("star", step)):
            write(folder, name + ".json", star(points, turn))
            commands.append(["export", scene(folder, f'model(file="{name}.json")\n' + CAMERA, name + ".xp"), "-o", name + ".glb"])
        return commands

    def check(folder, results):
        plain, crossed = (result["seconds"] for result in results)
        return f"{crossed:.1f} s, a plain polygon {plain:.1f} s" if crossed > 3 * plain + 1 else ""

    return Case("city", f"a star of {points} points, every {step}", build, "either", check=check)


def different_holes(count):
    """A plate with square holes beside each other."""
    side = math.isqrt(count)
    corners = [(0, 0), (9 * side, 0), (9 * side, 9 * side), (0, 9 * side)]
    for i in range(count):
        x, y = 3 + 5 * (i % side), 3 + 5 * (i // side)
        corners += [(x, y), (x, y + 2), (x + 2, y + 2), (x + 2, y)]
    rings = [[4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3] for i in range(count + 1)]
    return city(vertices=[[x, y, 0] for x, y in corners], CityObjects={"a": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [rings]}]}})


def templates(count):
    template = {"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2]]] * 2000}
    return city(**{"geometry-templates": {"templates": [template], "vertices-templates": [[0, 0, 0], [1, 0, 0], [0, 0, 1]]},
                   "CityObjects": {f"o{i}": {"type": "SolitaryVegetationObject", "geometry": [
                       {"type": "GeometryInstance", "template": 0, "boundaries": [0], "transformationMatrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]} for i in range(count)}})


def gml(inside, head=HEAD):
    return (head + '<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" '
            'xmlns:bldg="http://www.opengis.net/citygml/building/2.0"><cityObjectMember><bldg:Building>' + inside + "</bldg:Building></cityObjectMember></CityModel>")


def surface(positions):
    return ('<bldg:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList srsDimension="3">'
            + positions + "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod1MultiSurface>")


def osm(inside, bounds='<bounds minlat="52" minlon="4" maxlat="52.01" maxlon="4.01"/>'):
    return f'{HEAD}<osm version="0.6">{bounds}{inside}</osm>'


def building(nodes, tags='<tag k="building" v="yes"/>'):
    points = "".join(f'<node id="{i}" lat="{52 + lat}" lon="{4 + lon}"/>' for i, (lat, lon) in enumerate(nodes))
    return osm(points + '<way id="1">' + "".join(f'<nd ref="{i}"/>' for i in [*range(len(nodes)), 0]) + tags + "</way>")


def tiff(entries, data=b"\0" * 64):
    body = struct.pack("<2sHIH", b"II", 42, 8, len(entries))
    for tag, kind, count, value in entries:
        body += struct.pack("<HHII", tag, kind, count, value)
    return body + struct.pack("<I", 0) + data


def grid(width, height, rows=None, strip=8):
    return tiff([(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, 32), (259, 3, 1, 1), (262, 3, 1, 1), (273, 4, 1, 130), (277, 3, 1, 1),
                 (278, 4, 1, rows or height), (279, 4, 1, strip), (339, 3, 1, 3)])


def on_ground(name, file, content, expects="either"):
    """A map that stands on a terrain: the program asks for heights while a child reads the map."""
    ground = city(CityObjects={"t": {"type": "TINRelief", "geometry": [{"type": "CompositeSurface", "lod": "1", "boundaries": [[[0, 1, 3]], [[1, 2, 3]]]}]}},
                  vertices=[[500000, 5700000, 3], [800000, 5700000, 3], [800000, 5900000, 4], [500000, 5900000, 4]])

    def build(folder):
        write(folder, "t.json", ground)
        write(folder, file, content)
        return [["export", scene(folder, f'model(name="t", file="t.json")\nmodel(file="{file}", ground="t")\n' + CAMERA), "-o", "out.glb"]]

    return Case("map", f"on a ground: {name}", build, expects)


def cases():
    for place in ("vertices", "CityObjects", "appearance", "transform", "metadata", "geometry-templates", "extensions"):
        for opening, closing in (("[", "]"), ('{"a":', "}")):
            yield model_case("city", f"80,000 {opening[0]} in {place}", "m.json",
                             lambda p=place, o=opening, c=closing: city(**{p: "DEEP"}).replace('"DEEP"', o * 80000 + "0" + c * 80000), "refused")
    for value in ([[[0, 1, 99]]], [[[0, 1, -1]]], [[[0, 1, 2**64]]], [[[0, 1, 2**32]]], [[["a", 1, 2]]], [[0, 1, 2]], [0], {}, "a", [[[]]], [[[0, 1, 2.5]]], [[[0, 0, 0]]]):
        for kind in ("MultiSurface", "Solid", "MultiSolid"):
            yield model_case("city", f"{kind} of {value}", "m.json", boundaries(value, kind))
    for vertices in ([[1e300, 0, 0]] * 3, [[0, 0]] * 3, [["a", 0, 0]] * 3, [[3e38, 3e38, 3e38], [0, 0, 0], [1, 0, 0]], "none", [[None] * 3] * 3):
        yield model_case("city", f"vertices {vertices[0]}", "m.json", city(vertices=vertices))
    for scale in ([1e300] * 3, [0, 0, 0], ["a"] * 3, [-1e30, 1, 1]):
        yield model_case("city", f"scale {scale}", "m.json", city(transform={"scale": scale, "translate": [0, 0, 0]}))
    for points, step in ((61, 30), (1001, 2), (1001, 500), (9001, 4500)):
        yield crossing(points, step)
    yield model_case("city", "20,000 equal holes", "m.json", lambda: boundaries([[[0, 1, 2]] + [[0, 1, 2]] * 20000]), seconds=60)
    yield model_case("city", "6,000 different holes", "m.json", lambda: different_holes(6000), "done")
    yield model_case("city", "20,000 different holes", "m.json", lambda: different_holes(20000), "refused", says="holes are too many")
    yield model_case("city", "3,000 templates of 2,000 surfaces", "m.json", lambda: templates(3000), seconds=120)
    for name in ("../outside/secret.png", "/etc/passwd", "link.png", "pipe"):
        yield model_case("city", f"texture {name}", "m.json", city(appearance={"textures": [{"type": "PNG", "image": name}], "vertices-texture": [[0, 0]]}))
    yield model_case("city", "an invalid name", "m.json", city().encode().replace(b'"a":', b'"a\xe9":'))
    yield model_case("city", "a version of bytes", "m.json", city(version="\udcff"))
    for text in ("", "\x1e", "{", "[", "null", "{}", '{"type":"CityJSONFeature"}', city() + "\n" + city(), city() + "\n{" * 1000):
        yield model_case("city", f"sequence {text[:20]!r}", "m.jsonl", text)
    for entity in ('<!DOCTYPE a [<!ENTITY e SYSTEM "file:///etc/passwd">]>', "<!DOCTYPE a>", '<!DOCTYPE a [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>', '<!DOCTYPE a SYSTEM "http://127.0.0.1:9/a.dtd">'):
        yield model_case("city", f"CityGML {entity[:40]}", "m.gml", gml(surface("0 0 0 1 0 0 0 0 1 0 0 0"), HEAD + entity), "refused")
        yield model_case("city", f"OSM {entity[:40]}", "m.osm", HEAD + entity + osm("")[len(HEAD):], "refused")
    for positions in ("", "0 0", "a b c", "0 0 0", "1e400 0 0 1 0 0 0 0 1", "nan nan nan 1 0 0 0 1 0", "0 0 0 " * 100000, "1e300 0 0 -1e300 0 0 0 1e300 0"):
        yield model_case("city", f"CityGML positions {positions[:20]}", "m.gml", gml(surface(positions)))
    for depth in (400, 5000, 100000):
        yield model_case("city", f"CityGML {depth} deep", "m.gml", gml("<bldg:consistsOfBuildingPart><bldg:BuildingPart>" * depth + "</bldg:BuildingPart></bldg:consistsOfBuildingPart>" * depth))
    for size in (0, 10, 100, 300, 500):
        yield model_case("city", f"CityGML cut at {size}", "m.gml", gml(surface("0 0 0 1 0 0 0 0 1 0 0 0"))[:size], "refused")
    square = [(0, 0), (0, .001), (.001, .001), (.001, 0)]
    for tags in ("height", "building:levels", "roof:height", "min_height", "roof:levels", "width", "lanes", "maxspeed"):
        for value in ("nan", "inf", "1e300", "-5", "9" * 400, "1e9", "0"):
            yield model_case("map", f"{tags}={value}", "m.osm", building(square, f'<tag k="building" v="yes"/><tag k="{tags}" v="{value}"/>'))
    for value in ("1e9", "999999", "100000000000"):
        yield model_case("map", f"a road of {value} lanes", "m.osm", building(square, f'<tag k="highway" v="primary"/><tag k="lanes" v="{value}"/><tag k="width" v="{value}"/>'))
    many = "".join(f'<way id="{i}"><nd ref="1"/><nd ref="2"/><tag k="highway" v="primary"/></way>' for i in range(3000))
    yield model_case("map", "3,000 ways between two nodes", "m.osm", osm('<node id="1" lat="52" lon="4"/><node id="2" lat="52.001" lon="4"/>' + many), seconds=60)
    streets = 150
    nodes = "".join(f'<node id="{1 + i * streets + j}" lat="{52 + i * .0002}" lon="{4 + j * .0003}"/>' for i in range(streets) for j in range(streets))
    ways = "".join(f'<way id="{i + 1}">' + "".join(f'<nd ref="{1 + i * streets + j}"/>' for j in range(streets)) + '<tag k="highway" v="residential"/></way>' for i in range(streets))
    ways += "".join(f'<way id="{9000 + j}">' + "".join(f'<nd ref="{1 + i * streets + j}"/>' for i in range(streets)) + '<tag k="highway" v="residential"/></way>' for j in range(streets))
    yield model_case("map", "150 x 150 streets that cross", "m.osm", osm(nodes + ways, '<bounds minlat="52" minlon="4" maxlat="52.03" maxlon="4.05"/>'), seconds=150)
    relation = "".join(f'<relation id="{i}"><member type="relation" ref="{(i + 1) % 9}" role="outer"/><tag k="building" v="yes"/></relation>' for i in range(9))
    yield model_case("map", "relations in a circle", "m.osm", osm('<node id="1" lat="52" lon="4"/>' + relation))
    for bounds in ('<bounds minlat="nan" minlon="4" maxlat="52" maxlon="4"/>', '<bounds minlat="-90" minlon="-180" maxlat="90" maxlon="180"/>', ""):
        yield model_case("map", f"bounds {bounds[:30]}", "m.osm", osm('<node id="1" lat="52" lon="4"/>', bounds))
    right = building(square)
    yield on_ground("a right one", "m.osm", right, "done")
    for size in range(0, len(right), 60):
        yield on_ground(f"cut at {size}", "m.osm", right[:size], "refused")
    for entity in ('<!DOCTYPE a [<!ENTITY e SYSTEM "file:///etc/passwd">]>', "<a>" * 50000):
        yield on_ground(entity[:30], "m.osm", HEAD + entity + right[len(HEAD):], "refused")
    for content in (b"", b"\0\0\0\x0d\n\x09OSMHeader" + b"\xff" * 40, b"\0\0\0\x0d\n\x09OSMHeader\x18\x7f" + b"\0" * 200, b"\xff" * 60):
        yield on_ground(f"PBF {content[:12]}", "m.pbf", content, "refused")
    for width, height in ((2**31, 2**31), (2**32 - 1, 2**32 - 1), (0, 0), (1, 1), (2**31 - 1, 2), (60000, 60000)):
        yield model_case("terrain", f"{width} x {height}", "m.tif", grid(width, height), "refused", attributes=", cell=1")
        yield model_case("terrain", f"{width} x {height} in strips of all", "m.tif", grid(width, height, 2**32 - 1, 2**31), "refused", attributes=", cell=1")
    # its strip says 8 bytes, but all 64 are there: libtiff counts again
    yield model_case("terrain", "4 x 4, a wrong count of bytes", "m.tif", grid(4, 4), "either", attributes=", cell=1")
    for size in (0, 4, 8, 40, 100):
        yield model_case("terrain", f"cut at {size}", "m.tif", grid(4, 4)[:size], "refused", attributes=", cell=1")
