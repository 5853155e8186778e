"""The tables of docs/formats.md, tried: each thing that they call left out has a file here whose account names it, and kinds of files
that readers get wrong in silence are measured as exported.

Usage: formats_test.py PARVIS [unittest's arguments].
"""

import base64
import io
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "apps/bench/files"))
import judge_reports  # noqa: E402

PARVIS = None  # path of the program, from the command line
CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]  # of a cube of 1 m, wound outward
HALVES = [half for a, b, c, d in SIDES for half in ((a, b, c), (a, c, d))]


def gltf(**changes):
    """A cube, with further members of the document; those of "primitive" belong to its primitive."""
    points = b"".join(struct.pack("<3f", *corner) for corner in CORNERS)
    data = points + b"".join(struct.pack("<3H", *half) for half in HALVES)
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, **changes.pop("attributes", {})}, "indices": 1, **changes.pop("primitive", {})},
                                   *changes.pop("primitives", [])]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }
    return json.dumps({**document, **changes})


def material(extension, **values):
    return {"materials": [{"name": "brick", "extensions": {extension: values}}], "extensionsUsed": [extension], "primitive": {"material": 0}}


def obj(*further, corners=CORNERS):
    return "\n".join(["v %g %g %g" % corner for corner in corners] + ["f " + " ".join(str(i + 1) for i in side) for side in SIDES] + list(further)) + "\n"


def outline(*points):
    """One polygon of an OBJ, upright."""
    return "".join(f"v {x} {y} 0\n" for x, y in points) + "f " + " ".join(str(i + 1) for i in range(len(points))) + "\n"


def ply(properties="", values="", elements="", rest=""):
    head = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    faces = "element face 6\nproperty list uchar int vertex_indices\n"
    return (head + properties + faces + elements + "end_header\n" + "".join("%d %d %d %s\n" % (*corner, values) for corner in CORNERS)
            + "".join("4 %d %d %d %d\n" % side for side in SIDES) + rest)


def stl(attribute, at=(0, 0, 0)):
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *(at[k] + CORNERS[i][k] for i in half for k in range(3)), attribute) for half in HALVES)
    return b"COLOR=\xc8\xc8\xc8\xff".ljust(80) + struct.pack("<I", len(HALVES)) + facets


def fbx(unit_cm, up, front, front_sign):
    """A cube of 10 units, moved by 50 along the file's z, with the settings that programs write."""
    points = ",".join("%d,%d,%d" % tuple(10 * v for v in corner) for corner in CORNERS)
    polygons = ",".join(",".join(str(-i - 1 if k == 3 else i) for k, i in enumerate(side)) for side in SIDES)
    settings = "".join(f'\t\tP: "{name}", "int", "Integer", "",{value}\n' for name, value in (
        ("UpAxis", up), ("UpAxisSign", 1), ("FrontAxis", front), ("FrontAxisSign", front_sign), ("CoordAxis", 0), ("CoordAxisSign", 1)))
    return (f'; FBX 7.3.0 project file\nFBXHeaderExtension:  {{\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}}\nGlobalSettings:  {{\n\tVersion: 1000\n\tProperties70:  {{\n{settings}'
            f'\t\tP: "UnitScaleFactor", "double", "Number", "",{unit_cm}\n\t}}\n}}\nObjects:  {{\n\tGeometry: 1000, "Geometry::cube", "Mesh" {{\n\t\tVertices: *24 {{\n\t\t\ta: {points}\n\t\t}}\n'
            f'\t\tPolygonVertexIndex: *24 {{\n\t\t\ta: {polygons}\n\t\t}}\n\t\tGeometryVersion: 124\n\t}}\n\tModel: 2000, "Model::cube", "Mesh" {{\n\t\tVersion: 232\n\t\tProperties70:  {{\n'
            '\t\t\tP: "Lcl Translation", "Lcl Translation", "", "A",0,0,50\n\t\t}\n\t}\n}\nConnections:  {\n\tC: "OO",2000,0\n\tC: "OO",1000,2000\n}\n')


def three_mf(unit, packing=zipfile.ZIP_DEFLATED):
    """A cube of one unit, and another one 2 units above it."""
    opc, kinds = "http://schemas.openxmlformats.org/package/2006/", "application/vnd."
    corners = "".join('<vertex x="%d" y="%d" z="%d"/>' % corner for corner in CORNERS)
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % half for half in HALVES)
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", packing) as archive:
        archive.writestr("[Content_Types].xml", f'<Types xmlns="{opc}content-types"><Default Extension="rels" ContentType="{kinds}openxmlformats-package.relationships+xml"/>'
                         f'<Default Extension="model" ContentType="{kinds}ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        archive.writestr("_rels/.rels", f'<Relationships xmlns="{opc}relationships"><Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", f'<model {unit} xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model"><mesh><vertices>{corners}</vertices>'
                         f'<triangles>{triangles}</triangles></mesh></object><object id="2" type="model"><components><component objectid="1"/><component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 2"/>'
                         "</components></object></resources><build><item objectid=\"2\"/></build></model>")
    return held.getvalue()


def vrml(*nodes):
    return "#VRML V2.0 utf8\n" + "\n".join(nodes or ["Shape { geometry Box { size 2 1 1 } }"]) + "\n"


def ifc(*lines, schema="IFC4", context="$", product="IFCWALL", item=None, unit="$"):
    """A wall of 4 x 0.3 x 2.5 m; `lines` are further instances, numbered from #50 on."""
    body = item or ["#30=IFCPOLYLINE((#31,#32,#33,#34,#31));", "#31=IFCCARTESIANPOINT((0.,0.));", "#32=IFCCARTESIANPOINT((4.,0.));",
                    "#33=IFCCARTESIANPOINT((4.,0.3));", "#34=IFCCARTESIANPOINT((0.,0.3));", "#35=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#30);",
                    "#36=IFCEXTRUDEDAREASOLID(#35,#4,#2,2.5);"]
    tail = "$" if schema == "IFC2X3" else "$,$"
    instances = [
        "#1=IFCCARTESIANPOINT((0.,0.,0.));", "#2=IFCDIRECTION((0.,0.,1.));", "#3=IFCDIRECTION((1.,0.,0.));", "#4=IFCAXIS2PLACEMENT3D(#1,#2,#3);",
        f"#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#4,{context});", f"#6=IFCSIUNIT(*,.LENGTHUNIT.,{unit},.METRE.);", "#7=IFCUNITASSIGNMENT((#6));",
        "#8=IFCPROJECT('0000000000000000000001',$,'p',$,$,$,$,(#5),#7);", "#9=IFCLOCALPLACEMENT($,#4);",
        "#10=IFCSITE('0000000000000000000002',$,'site',$,$,#9,$,$,.ELEMENT.,$,$,0.,$,$);", "#11=IFCBUILDING('0000000000000000000003',$,'b',$,$,#9,$,$,.ELEMENT.,$,$,$);",
        "#12=IFCBUILDINGSTOREY('0000000000000000000004',$,'s',$,$,#9,$,$,.ELEMENT.,0.);", "#13=IFCRELAGGREGATES('0000000000000000000005',$,$,$,#8,(#10));",
        "#14=IFCRELAGGREGATES('0000000000000000000006',$,$,$,#10,(#11));", "#15=IFCRELAGGREGATES('0000000000000000000007',$,$,$,#11,(#12));",
        "#20=IFCSHAPEREPRESENTATION(#5,'Body','SweptSolid',(#36));", "#21=IFCPRODUCTDEFINITIONSHAPE($,$,(#20));",
        f"#22={product}('0000000000000000000008',$,'w',$,$,#9,#21,{tail});", "#23=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000009',$,$,$,(#22),#12);", *body, *lines]
    return ("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('%s'));\nENDSEC;\nDATA;\n%s\nENDSEC;\n"
            "END-ISO-10303-21;\n" % (schema, "\n".join(instances)))


def extruded(*profile):
    """A body of 2.5 m of the profile #35."""
    return [*profile, "#36=IFCEXTRUDEDAREASOLID(#35,#4,#2,2.5);"]


def points_2d(number, *places):
    """A closed polyline, with its points behind it."""
    refs = ",".join(f"#{number + 1 + i}" for i in range(len(places)))
    return [f"#{number}=IFCPOLYLINE(({refs},#{number + 1}));"] + [f"#{number + 1 + i}=IFCCARTESIANPOINT(({x:.3f},{y:.3f}));" for i, (x, y) in enumerate(places)]


# Half a disc of 1 m by points at the height of its middle, in axes that are turned by a right angle, and its straight side, which runs backwards.
HALF_DISC = extruded(
    "#37=IFCAXIS2PLACEMENT2D(#38,#44);", "#38=IFCCARTESIANPOINT((5.,3.));", "#44=IFCDIRECTION((0.,1.));", "#39=IFCCIRCLE(#37,1.);",
    "#40=IFCTRIMMEDCURVE(#39,(#45),(#46),.T.,.CARTESIAN.);", "#45=IFCCARTESIANPOINT((6.,3.));", "#46=IFCCARTESIANPOINT((4.,3.));", "#41=IFCPOLYLINE((#45,#46));",
    "#42=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#40);", "#43=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.F.,#41);", "#30=IFCCOMPOSITECURVE((#42,#43),.F.);",
    "#35=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#30);")
TWO_PROFILES = extruded(*points_2d(130, (0, 0), (4, 0), (4, 0.3), (0, 0.3)), *points_2d(140, (0, 1), (4, 1), (4, 1.3), (0, 1.3)),
                        "#37=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#130);", "#38=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#140);", "#35=IFCCOMPOSITEPROFILEDEF(.AREA.,$,(#37,#38),$);")
SWEPT = ["#130=IFCPOLYLINE((#131,#132,#133));", "#131=IFCCARTESIANPOINT((0.,0.,0.));", "#132=IFCCARTESIANPOINT((3.,0.,0.));", "#133=IFCCARTESIANPOINT((3.,2.,0.));",
         "#37=IFCAXIS2PLACEMENT2D(#38,$);", "#38=IFCCARTESIANPOINT((0.,0.));", "#35=IFCRECTANGLEPROFILEDEF(.AREA.,$,#37,0.4,0.2);"]
ON_MAP = ("#50=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);", "#51=IFCMAPCONVERSION(#5,#50,500000.,5700000.,12.,1.,0.,0.9996);")
RIGID = ("#50=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);", "#51=IFCRIGIDOPERATION(#5,#50,IFCLENGTHMEASURE(500000.),IFCLENGTHMEASURE(5700000.),12.);")
BY_PROPERTIES = (
    *(f"#{50 + i}=IFCPROPERTYSINGLEVALUE('{name}',$,{value},$);" for i, (name, value) in enumerate(
        [("Eastings", "IFCLENGTHMEASURE(500000.)"), ("Northings", "IFCLENGTHMEASURE(5700000.)"), ("OrthogonalHeight", "IFCLENGTHMEASURE(12.)"),
         ("XAxisAbscissa", "IFCREAL(0.)"), ("XAxisOrdinate", "IFCREAL(1.)"), ("Name", "IFCLABEL('EPSG:25832')")])),
    "#60=IFCPROPERTYSET('0000000000000000000010',$,'ePSet_MapConversion',$,(#50,#51,#52,#53,#54));",
    "#61=IFCRELDEFINESBYPROPERTIES('0000000000000000000011',$,$,$,(#8),#60);", "#62=IFCPROPERTYSET('0000000000000000000012',$,'ePSet_ProjectedCRS',$,(#55));",
    "#63=IFCRELDEFINESBYPROPERTIES('0000000000000000000013',$,$,$,(#8),#62);")


def gml(ring, further="", system="EPSG:25832"):
    """A roof of 10 x 10 m; `ring` writes its corners."""
    corners = [(565000, 5934000, 5), (565010, 5934000, 5), (565010, 5934010, 5), (565000, 5934010, 5), (565000, 5934000, 5)]
    polygon = f"<gml:Polygon><gml:exterior><gml:LinearRing>{ring(corners)}</gml:LinearRing></gml:exterior></gml:Polygon>"
    return (f'<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:bldg="http://www.opengis.net/citygml/building/2.0">'
            f'<gml:boundedBy><gml:Envelope srsName="{system}"><gml:lowerCorner>565000 5934000 5</gml:lowerCorner><gml:upperCorner>565010 5934010 5</gml:upperCorner>'
            f"</gml:Envelope></gml:boundedBy><cityObjectMember><bldg:Building><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>{polygon}</gml:surfaceMember>"
            f"</gml:MultiSurface></bldg:lod2MultiSurface>{further}</bldg:Building></cityObjectMember></CityModel>")


def pos_list(corners):
    return "<gml:posList>%s</gml:posList>" % " ".join(f"{value}" for corner in corners for value in corner)


def coord(corners):
    return "".join(f"<gml:coord><gml:X>{x}</gml:X><gml:Y>{y}</gml:Y><gml:Z>{z}</gml:Z></gml:coord>" for x, y, z in corners)


def city_json(**further):
    objects = {"roof": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2, 3]]]}]}, **further}
    return json.dumps({"type": "CityJSON", "version": "1.1", "transform": {"scale": [1, 1, 1], "translate": [565000, 5934000, 5]}, "CityObjects": objects,
                       "vertices": [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]]})


def osm(*elements, nodes=True):
    """A house of some 10 x 10 m, whose corners are nodes 1 to 4, and further elements."""
    places = [(52.0, 4.0), (52.0, 4.000146), (52.00009, 4.000146), (52.00009, 4.0)]
    corners = "".join(f'<node id="{i + 1}" lat="{lat}" lon="{lon}"/>' for i, (lat, lon) in enumerate(places)) if nodes else ""
    refs = "".join(f'<nd ref="{i % 4 + 1}" lat="{places[i % 4][0]}" lon="{places[i % 4][1]}"/>' if not nodes else f'<nd ref="{i % 4 + 1}"/>' for i in range(5))
    house = f'<way id="10">{refs}<tag k="building" v="yes"/><tag k="height" v="9"/></way>'
    return '<?xml version="1.0"?><osm version="0.6">' + corners + house + "".join(elements).replace("HOUSE", house) + "</osm>"


def tiff(values, bands=1, photometric=1, kind=3, bits=32, tags=()):
    """A GeoTIFF of 2-byte-aligned strips, 8 columns wide, cells of 2 m, in EPSG:25832; `tags`: further ones as (number, type, count, bytes)."""
    letter = {(3, 32): "f", (1, 8): "B"}[kind, bits]
    data = b"".join(struct.pack("<" + letter, value) for value in values for _ in range(bands))
    entries = [(256, 3, 1, struct.pack("<H", 8)), (257, 3, 1, struct.pack("<H", len(values) // 8)), (258, 3, bands, struct.pack(f"<{bands}H", *[bits] * bands)),
               (259, 3, 1, struct.pack("<H", 1)), (262, 3, 1, struct.pack("<H", photometric)), (273, 4, 1, None), (277, 3, 1, struct.pack("<H", bands)),
               (278, 3, 1, struct.pack("<H", len(values) // 8)), (279, 4, 1, struct.pack("<I", len(data))), (339, 3, bands, struct.pack(f"<{bands}H", *[kind] * bands)),
               (33550, 12, 3, struct.pack("<3d", 2, 2, 0)), (33922, 12, 6, struct.pack("<6d", 0, 0, 0, 500000, 5700000, 0)),
               (34735, 3, 16, struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 25832)), *tags]
    entries.sort()
    at, extra, table = 8 + 2 + 12 * len(entries) + 4, b"", b""
    at_of_data = at + sum(len(value) + len(value) % 2 for _, _, _, value in entries if value and len(value) > 4)
    for number, type_, count, value in entries:
        value = struct.pack("<I", at_of_data) if value is None else value
        if len(value) > 4:
            table += struct.pack("<HHII", number, type_, count, at + len(extra))
            extra += value + b"\0" * (len(value) % 2)
        else:
            table += struct.pack("<HHI", number, type_, count) + value.ljust(4, b"\0")
    return struct.pack("<2sHIH", b"II", 42, 8, len(entries)) + table + struct.pack("<I", 0) + extra + data


def dng(red, green, blue, turned):
    """A raw file of a camera, 64 x 48, of one linear colour behind a Bayer mosaic whose primaries are those of sRGB; held upright where `turned`."""
    level = ((red, green), (green, blue))
    data = b"".join(struct.pack("<H", round(65535 * level[y % 2][x % 2])) for y in range(48) for x in range(64))
    to_camera = (3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570)  # from CIE XYZ
    short, long_, text = (lambda *v: struct.pack(f"<{len(v)}H", *v)), (lambda v: struct.pack("<I", v)), (lambda v: v.encode() + b"\0")
    entries = [(254, 4, 1, long_(0)), (256, 4, 1, long_(64)), (257, 4, 1, long_(48)), (258, 3, 1, short(16)), (259, 3, 1, short(1)), (262, 3, 1, short(32803)),
               (271, 2, 5, text("Make")), (272, 2, 6, text("Model")), (273, 4, 1, None), (274, 3, 1, short(6 if turned else 1)), (277, 3, 1, short(1)), (278, 4, 1, long_(48)),
               (279, 4, 1, long_(len(data))), (284, 3, 1, short(1)), (306, 2, 20, text("2026:06:21 10:30:00")), (33421, 3, 2, short(2, 2)), (33422, 1, 4, bytes((0, 1, 1, 2))),
               (50706, 1, 4, bytes((1, 4, 0, 0))), (50707, 1, 4, bytes((1, 1, 0, 0))), (50708, 2, 6, text("Model")), (50714, 4, 1, long_(0)), (50717, 4, 1, long_(65535)),
               (50721, 10, 9, b"".join(struct.pack("<2i", round(10000 * v), 10000) for v in to_camera)), (50728, 5, 3, struct.pack("<6I", *[1] * 6)), (50778, 3, 1, short(21))]
    start = 8 + 2 + 12 * len(entries) + 4
    data_at = start + sum(len(value) + len(value) % 2 for *_, value in entries if value and len(value) > 4)
    table, extra = b"", b""
    for number, kind, count, value in entries:
        value = long_(data_at) if value is None else value
        table += struct.pack("<HHI", number, kind, count) + (long_(start + len(extra)) if len(value) > 4 else value.ljust(4, b"\0"))
        extra += value + b"\0" * (len(value) % 2) if len(value) > 4 else b""
    return struct.pack("<2sHIH", b"II", 42, 8, len(entries)) + table + long_(0) + extra + data


def pixel(picture, width, height):
    """Size of a picture by ffmpeg, and the colour of its middle."""
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", picture, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True, check=True).stdout
    at = 3 * (width * (height // 2) + width // 2)
    return len(raw), tuple(raw[at : at + 3])


SLOPE = [10.0 + i % 8 for i in range(64)]
MESHES = "OBJ, PLY, STL, OFF, COLLADA, FBX, 3DS, 3MF, AC3D, LightWave, DirectX"
OPEN_GL_POINT = {"attributes": {"POSITION": 0}, "mode": 0}

# (section of docs/formats.md, words of it, file, content, the fate and the kind that the account names)
NAMED = [
    ("glTF 2.0", "further scenes", "scenes.gltf", gltf(scenes=[{"nodes": [0]}, {"nodes": [0]}]), "left out", "scenes"),
    ("glTF 2.0", "cameras", "camera.gltf", gltf(cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]), "left out", "cameras"),
    ("glTF 2.0", "lamps (`KHR_lights_punctual`", "lamp.gltf",
     gltf(extensions={"KHR_lights_punctual": {"lights": [{"type": "point"}]}}, extensionsUsed=["KHR_lights_punctual"], extensionsRequired=["KHR_lights_punctual"]), "left out", "lights"),
    ("glTF 2.0", "points and lines", "points.gltf", gltf(primitives=[OPEN_GL_POINT]), "left out", "primitives"),
    ("glTF 2.0", "primitives without positions", "bare.gltf", gltf(primitives=[{"attributes": {"_COLOUR": 0}}]), "left out", "primitives"),
    ("glTF 2.0", "attributes beyond one colour", "attribute.gltf", gltf(attributes={"_FEATURE_ID_0": 0}), "left out", "vertex attributes"),
    ("glTF 2.0", "further sets", "colours.gltf", gltf(attributes={"COLOR_1": 0}), "left out", "vertex attributes"),
    ("glTF 2.0", "other extensions of materials", "sheen.gltf", gltf(**material("KHR_materials_sheen")), "left out", "extensions"),
    ("glTF 2.0", "colours of highlights", "gloss.gltf", gltf(**material("KHR_materials_pbrSpecularGlossiness", diffuseFactor=[1, 0, 0, 1])), "changed", "colours of highlights"),
    ("glTF 2.0", "KTX2 (`KHR_texture_basisu`)", "ktx2.gltf",
     gltf(textures=[{"extensions": {"KHR_texture_basisu": {"source": 0}}}], images=[{"uri": "data:image/ktx2;base64,q0tUWCAyMLs="}], extensionsUsed=["KHR_texture_basisu"],
          materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], primitive={"material": 0}), "left out", "extensions"),
    (MESHES, "free-form curves and surfaces", "curve.obj", obj("curv 0 1 1 2 3"), "left out", "statements"),
    (MESHES, "points and lines", "line.obj", obj("l 1 2"), "left out", "primitives"),
    (MESHES, "further properties and elements of PLY", "confidence.ply", ply("property float confidence\n", "1"), "left out", "properties"),
    (MESHES, "strips of PLY", "strips.ply", ply(elements="element tristrips 1\nproperty list int int vertex_indices\n", rest="4 0 1 2 3\n"), "left out", "elements"),
    (MESHES, "colours of faces", "faces.off", "OFF\n8 6 0\n" + "".join("%d %d %d\n" % c for c in CORNERS) + "".join("4 %d %d %d %d 255 0 0\n" % s for s in SIDES), "left out", "colours of faces"),
    (MESHES, "of facets where Magics writes them", "facets.stl", stl(0x001F), "left out", "colours of facets"),
    (MESHES, "material libraries that are not there", "library.obj", "mtllib gone.mtl\n" + obj(), "left out", "material libraries"),
    (MESHES, "an OBJ whose y is a northing is taken as z up", "grid.obj", obj(corners=[(x + 84500, y + 447300, z) for x, y, z in CORNERS]), "changed", "axes"),
    (MESHES, "in single precision", "grid.stl", stl(0, (458321.37, 5431987.63, 0)), "left out", "digits of coordinates"),
    ("Open Inventor 2, VRML 1 and 2", "lines, points", "line.wrl", vrml("Shape { geometry Box {} }", "Shape { geometry IndexedLineSet { coord Coordinate { point [ 0 0 0, 1 0 0 ] } coordIndex [ 0 1 -1 ] } }"), "left out", "lines and points"),
    ("Open Inventor 2, VRML 1 and 2", "cameras", "view.wrl", vrml("Viewpoint {}", "Shape { geometry Box {} }"), "left out", "cameras"),
    ("IFC 2x3, 4 and 4X3", "the scale of a map conversion", "scale.ifc", ifc(*ON_MAP), "changed", "scales of maps"),
    ("IFC 2x3, 4 and 4X3", "spaces", "space.ifc", ifc("#50=IFCSPACE('0000000000000000000014',$,'room',$,$,#9,#21,$,.ELEMENT.,.INTERNAL.,$);"), "not needed", "IfcSpace"),
    ("CityGML 1 to 3", "points and lines", "roof.gml", gml(pos_list, "<bldg:lod2MultiCurve><gml:MultiCurve><gml:curveMember><gml:LineString><gml:posList>565000 5934000 5 565010 5934000 5</gml:posList></gml:LineString>"
                                                               "</gml:curveMember></gml:MultiCurve></bldg:lod2MultiCurve>"), "left out", "geometries MultiCurve"),
    ("CityGML 1 to 3", "polygons that libcitygml makes nothing of", "flat.gml", gml(pos_list), "used", "polygons"),
    ("CityJSON 0.2 to 2.0", "`MultiPoint` and `MultiLineString`", "tree.city.json", city_json(tree={"type": "SolitaryVegetationObject", "geometry": [{"type": "MultiPoint", "lod": "1", "boundaries": [0]}]}), "left out", "geometries MultiPoint"),
    ("CityJSON 0.2 to 2.0", "objects without a geometry", "empty.city.json", city_json(lost={"type": "Building"}), "not needed", "city objects"),
    ("OpenStreetMap", "elements of other kinds", "bench.osm", osm('<node id="9" lat="52" lon="4"><tag k="amenity" v="bench"/></node>'), "left out", "elements with a kind"),
    ("OpenStreetMap", "numbers and units that cannot be read", "height.osm", osm('<way id="11"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/><tag k="height" v="~12"/></way>'), "left out", "tags height"),
    ("OpenStreetMap", "what an editor has deleted", "deleted.osm", osm('<node id="9" action="delete" lat="52" lon="4"><tag k="natural" v="tree"/></node>'), "not needed", "elements"),
    ("GeoTIFF", "further bands", "bands.tif", tiff(SLOPE, bands=2, tags=[(338, 3, 1, struct.pack("<H", 0))]), "left out", "bands"),
    ("GeoTIFF", "-9999 and its like", "holes.tif", tiff([-9999.0] + SLOPE[1:]), "changed", "samples"),
]

# (file, content, size in x, y and z, or None, volume, area: None where they are not asked for)
MEASURED = [
    ("cube.gltf", gltf(), (1, 1, 1), 1, 6),
    ("mirrored_twice.gltf", gltf(nodes=[{"children": [1], "scale": [-1, 1, 1]}, {"mesh": 0, "scale": [1, -2, 1]}]), (1, 1, 2), 2, 10),
    ("sheared.gltf", gltf(nodes=[{"mesh": 0, "matrix": [1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]), (1.5, 1, 1), 1, None),
    ("no_positions.gltf", gltf(primitives=[{"attributes": {"_COLOUR": 0}}]), (1, 1, 1), 1, 6),
    ("even_l.obj", outline((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)), (2, 0, 2), None, 3),
    ("comb.obj", outline((0, 0), (5, 0), (5, 3), (4, 3), (4, 1), (3, 1), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)), (5, 0, 3), None, 11),
    ("continued.obj", obj().replace("f 1 2 4 3", "f 1 2 \\\n 4 3"), (1, 1, 1), 1, 6),
    ("metres.3mf", three_mf('unit="meter"'), (1, 1, 3), 2, None),
    ("inches.3mf", three_mf('unit="inch"', zipfile.ZIP_STORED), (0.0254, 0.0254, 0.0762), 2 * 0.0254**3, None),
    ("millimetres.3mf", three_mf(""), (0.001, 0.001, 0.003), None, None),
    ("centimetres_y_up.fbx", fbx(1, 1, 2, 1), (0.1, 0.1, 0.1), 0.001, None),
    ("metres_z_up.fbx", fbx(100, 2, 1, -1), (10, 10, 10), 1000, None),
    ("mirrored.wrl", vrml("Transform { scale -1 1 1 children Shape { geometry Box { size 2 1 1 } } }"), (2, 1, 1), 2, 10),
    ("clockwise.wrl", vrml("Transform { scale 1 1 -1 children Shape { geometry IndexedFaceSet { ccw FALSE coord Coordinate { point [ %s ] } coordIndex [ %s ] } } }" % (
        ", ".join("%d %d %d" % c for c in CORNERS), " ".join("%d %d %d %d -1" % s[::-1] for s in SIDES))), (1, 1, 1), 1, 6),
    ("rigid.ifc", ifc(*RIGID, schema="IFC4X3"), (4, 0.3, 2.5), 3, None),
    ("properties.ifc", ifc(*BY_PROPERTIES, schema="IFC2X3", product="IFCWALLSTANDARDCASE"), (0.3, 4, 2.5), 3, None),
    ("half_disc.ifc", ifc(item=HALF_DISC), (2, 1, 2.5), 1.25 * 24 * math.sin(math.pi / 24), None),
    ("two_profiles.ifc", ifc(item=TWO_PROFILES), (4, 1.3, 2.5), 6, None),
    ("by_reference.ifc", ifc(item=[*SWEPT, "#36=IFCFIXEDREFERENCESWEPTAREASOLID(#35,$,#130,$,$,#2);"]), (3.1, 2.1, 0.4), 0.4, None),
    ("on_plane.ifc", ifc(item=[*SWEPT, "#39=IFCPLANE(#4);", "#36=IFCSURFACECURVESWEPTAREASOLID(#35,$,#130,0.,2.,#39);"]), (3.1, 2.1, 0.4), 0.4, None),
    ("block.ifc", ifc(item=["#36=IFCCSGSOLID(#37);", "#37=IFCBLOCK(#4,4000.,300.,2500.);"], unit=".MILLI."), (4, 0.3, 2.5), 3, None),
    ("pyramid.ifc", ifc(item=["#36=IFCCSGSOLID(#37);", "#37=IFCRECTANGULARPYRAMID(#4,4.,3.,2.);"]), (4, 3, 2), 8, None),
    ("slanted.ifc", ifc("#50=IFCDIRECTION((3.,0.,4.));", item=["#35=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,1.,1.);", "#36=IFCEXTRUDEDAREASOLID(#35,#4,#50,5.);"]), (4, 1, 4), 4, None),
    ("sphere.ifc", ifc(item=["#36=IFCSPHERE(#4,2000.);"], unit=".MILLI."), (4, 4, 4), None, None),
    ("coord.gml", gml(coord), (10, 10, 0), None, 100),
    ("twice.osm", osm("HOUSE"), None, None, None),
    ("places_in_ways.osm", osm('<node id="9" lat="52" lon="4"/>', nodes=False), None, None, None),
]


def read(folder, name, content):
    """What the account says of a file, and the model as it is exported."""
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    up = ', up="y"' if name.endswith(".wrl") else ""
    (folder / "scene.xp").write_text(f'model(name="thing", file="{name}"{up})\n')
    said = []
    for words in (("check", "scene.xp", "--json"), ("export", "scene.xp", "-o", "out.glb")):
        done = subprocess.run([PARVIS, *words], cwd=folder, capture_output=True, text=True, timeout=240)
        if done.returncode != 0:
            raise AssertionError(f"{name}: {done.stderr.strip()}")
        said.append(done.stdout)
    return [line for account in json.loads(said[0]) for line in account["lines"]], judge_reports.Model(folder / "out.glb")


class Formats(unittest.TestCase):
    def setUp(self):
        self.sections = dict(re.findall(r"^## ([^\n]*?)(?: \([.\w, ]*\))?\n(.*?)(?=^## |\Z)", (ROOT / "docs/formats.md").read_text(), re.M | re.S))

    def test_the_account_names_what_the_tables_call_left_out(self):
        for section, words, name, content, fate, kind in NAMED:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                self.assertIn(words, self.sections[section])
                lines, _ = read(pathlib.Path(folder), name, content)
                self.assertTrue([line for line in lines if line["fate"] == fate and line["kind"] == kind], lines)

    def test_each_clause_of_the_tables_is_tried(self):
        for section in {row[0] for row in NAMED}:
            tried = [words for other, words, *_ in NAMED if other == section]
            for row in re.findall(r"^\| (?!---)(.*) \|$", self.sections[section], re.M):
                left_out = "" if row.endswith("|") else row.split(" | ")[-1]
                for clause in left_out.split(";"):
                    known = any(words in clause for words in tried) or any(words in clause for words in ELSEWHERE)
                    self.assertTrue(known or "left out, and named" in clause or not clause.strip(" |"), f"{section}: {clause}")

    def test_files_that_are_easily_got_wrong_have_their_measures(self):
        for name, content, size, volume, area in MEASURED:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                _, model = read(pathlib.Path(folder), name, content)
                if size:
                    for given, right in zip(model.size(), size):
                        self.assertAlmostEqual(given, right, delta=1e-3)
                if volume is not None:
                    self.assertAlmostEqual(model.volume(), volume, delta=1e-3 * volume)
                if area is not None:
                    self.assertAlmostEqual(sum(area_of(*triangle) for triangle in model.triangles), area, delta=1e-3 * area)

    def test_what_is_up_in_a_file_is_up(self):
        for name, content, low in (("y.fbx", fbx(100, 1, 2, 1), (0, -60, 0)), ("z.fbx", fbx(100, 2, 1, -1), (0, 0, 50)), ("part.3mf", three_mf('unit="meter"'), (0, 0, 0))):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                _, model = read(pathlib.Path(folder), name, content)
                for given, right in zip(model.box()[0], low):
                    self.assertAlmostEqual(given, right, delta=1e-3)

    def test_a_house_of_a_map_is_there_once_wherever_its_corners_are_written(self):
        areas = []
        for content in (osm(), osm("HOUSE"), osm('<node id="9" lat="52" lon="4"/>', nodes=False), osm(nodes=False)):
            with tempfile.TemporaryDirectory() as folder:
                _, model = read(pathlib.Path(folder), "house.osm", content)
                areas.append(model.wall_area())
        self.assertAlmostEqual(areas[0], 2 * (10.02 + 10.01) * 9, delta=5)
        for area in areas[1:]:
            self.assertAlmostEqual(area, areas[0], delta=0.01)

    def test_a_picture_is_no_terrain(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(AssertionError, "is a picture"):
                read(pathlib.Path(folder), "photo.tif", tiff([100 + i % 8 for i in range(64)], bands=3, photometric=2, kind=1, bits=8))

    def test_pictures_of_telephones_and_of_the_web_are_read(self):
        if not shutil.which("ffmpeg") or not shutil.which("oiiotool"):
            self.skipTest("skipped: no ffmpeg or no oiiotool here")
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "color=red:size=64x48", "-frames:v", "1", "-still-picture", "1", folder / "red.avif"], check=True)
            textured = gltf(textures=[{"extensions": {"EXT_texture_avif": {"source": 0}}}], images=[{"uri": "red.avif"}], extensionsUsed=["EXT_texture_avif"],
                            materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], primitive={"material": 0})
            lines, _ = read(folder, "textured.gltf", textured)
            self.assertEqual([line for line in lines if line["fate"] in ("left out", "changed")], [])
            self.assertNotIn("red.avif", subprocess.run([PARVIS, "check", "scene.xp"], cwd=folder, capture_output=True, text=True, timeout=240).stderr)
            (folder / "red.avif").write_text("no picture")
            self.assertIn("red.avif", subprocess.run([PARVIS, "check", "scene.xp"], cwd=folder, capture_output=True, text=True, timeout=240).stderr)
            (folder / "photos").mkdir()
            subprocess.run(["oiiotool", "--pattern", "constant:color=.2,.4,.6", "64x48", "3", "-o", folder / "photos/IMG_1.heic"], check=True)
            (folder / "photos/IMG_2.HEIC").write_text("no picture")
            done = subprocess.run([PARVIS, "facade", "calibrate", "photos", "-o", "place"], cwd=folder, capture_output=True, text=True, timeout=240)
            self.assertIn("IMG_2.HEIC", done.stderr)
            self.assertIn("holds 1 photographs that can be read", done.stderr)

    def test_raw_files_of_cameras_are_developed(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("skipped: no ffmpeg here")
        with tempfile.TemporaryDirectory() as folder:
            photos, place = pathlib.Path(folder) / "photos", pathlib.Path(folder) / "place"
            photos.mkdir()
            (photos / "lying.dng").write_bytes(dng(0.5, 0.2, 0.05, turned=False))
            (photos / "UPRIGHT.DNG").write_bytes(dng(0.5, 0.2, 0.05, turned=True))
            (photos / "broken.nef").write_bytes(b"no raw file")
            done = subprocess.run([PARVIS, "facade", "calibrate", photos, "-o", place], capture_output=True, text=True, timeout=240)
            self.assertIn("broken.nef", done.stderr)
            self.assertNotIn("lying.dng: cannot", done.stderr)
            for name, width, height in (("lying.jpg", 64, 48), ("UPRIGHT.jpg", 48, 64)):
                size, colour = pixel(place / "developed" / name, width, height)
                self.assertEqual(size, 3 * 64 * 48)
                for given, right in zip(colour, (188, 124, 63)):  # sRGB of .5, .2 and .05
                    self.assertAlmostEqual(given, right, delta=4)

    def test_a_grid_without_a_system_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            lines, _ = read(pathlib.Path(folder), "no_system.city.json", city_json())
            self.assertTrue(any("no coordinate system" in line.get("reason", "") for line in lines), lines)


def area_of(a, b, c):
    normal = judge_reports.cross(judge_reports.minus(b, a), judge_reports.minus(c, a))
    return math.sqrt(judge_reports.dot(normal, normal)) / 2


# Clauses that other tests try, with files that are larger than these.
ELSEWHERE = [
    "the plain picture that the file may have stands for it",  # glTF: GltfCompression
    "skins, morph targets, animations, cameras, lamps", "further sets",  # formats of assimp, whose files are long
    "a picture (red, green, blue) is refused",  # test_a_picture_is_no_terrain
    "tangents follow from the texture",  # glTF: GltfKinds
    "channels that move nothing shown",  # glTF: animations' tests
    "digits of a national grid in the others",  # Assimp
    "other pictures",  # Assimp.WhatIsLeftOutIsNamed
    "of levels of detail one is shown",  # Inventor.WhatMakesNoTrianglesIsCountedByKindAndName
    "entities that IFC 4 has not",  # IfcBodies.ObjectsAndUnknownEntitiesAreAccountedFor
    "faces of advanced breps whose surface has no size or wrong knots",  # IfcBodies.FacesLieOnSplines
    "the taper of revolved solids", "each item that IFC++ makes no surface of",  # IfcBodies.WhatGivesNoSurfaceIsNamed
    "other textures, property sets",  # TexturedIfcTest
    "other elements of such schemas",  # CityGmlExtensions
    "other themes than the first",  # CityGml
    "ways with `area=no`",  # Osm
]

if __name__ == "__main__":
    PARVIS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
