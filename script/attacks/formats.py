"""Further files of every format: what refers to itself, claims much in few bytes, unpacks to much, or names other files."""

import io
import json
import struct
import zipfile
import zlib

from .case import CAMERA, Case, model_case, scene, write
from .cities import HEAD, building, city, gml, osm, surface, tiff
from .meshes import INSTANCE, dae, ifc_spoiled, pavilion, scene_of
from .pictures import exr, texture
from .png import png

OUT = ("../outside/secret.png", "link.png", "/etc/passwd", "pipe", "file:///etc/passwd", "%2e%2e/outside/secret.png")
SQUARE = [(0, 0), (0, .001), (.001, .001), (.001, 0)]


def ply_cases():
    head = "ply\nformat {}\n{}end_header\n"
    xyz = "property float x\nproperty float y\nproperty float z\n"
    faces = "element face 1\nproperty list {} {} vertex_indices\n"
    ascii_body = "0 0 0\n1 0 0\n0 0 1\n"
    for name, text in {
        "without end_header": "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz,
        "100,000 comments": "ply\nformat ascii 1.0\n" + "comment a\n" * 100_000,
        "a list of floats as count": head.format("ascii 1.0", "element vertex 3\n" + xyz + faces.format("float", "int")) + ascii_body + "3 0 1 2\n",
        "a list of unknown types": head.format("ascii 1.0", "element vertex 3\n" + xyz + faces.format("quad", "octet")) + ascii_body + "3 0 1 2\n",
        "a list of 2^32-1": head.format("ascii 1.0", "element vertex 3\n" + xyz + faces.format("uint", "int")) + ascii_body + "4294967295 0 1 2\n",
        "an element of 10^12 that is not known": head.format("ascii 1.0", "element dust 1000000000000\nproperty float a\nelement vertex 3\n" + xyz + faces.format("uchar", "int")) + ascii_body + "3 0 1 2\n",
        "vertices without x": head.format("ascii 1.0", "element vertex 3\nproperty float q\n" + faces.format("uchar", "int")) + "1\n2\n3\n3 0 1 2\n",
        "faces before vertices": head.format("ascii 1.0", faces.format("uchar", "int") + "element vertex 3\n" + xyz) + "3 0 1 2\n" + ascii_body,
        "words as numbers": head.format("ascii 1.0", "element vertex 3\n" + xyz + faces.format("uchar", "int")) + "a b c\n- + .\n1e 0 0\n3 0 1 2\n",
        "nan as numbers": head.format("ascii 1.0", "element vertex 3\n" + xyz + faces.format("uchar", "int")) + "nan 0 0\n0 inf 0\n0 0 1\n3 0 1 2\n",
        "a line of 20 MB": head.format("ascii 1.0", "element vertex 3\n" + xyz + faces.format("uchar", "int")) + "0 " * 10_000_000,
        "no version": head.format("nonsense", "element vertex 3\n" + xyz) + ascii_body,
        "triangle strips": head.format("ascii 1.0", "element vertex 3\n" + xyz + "element tristrips 1\nproperty list int int vertex_indices\n") + ascii_body + "5 0 1 -1 2 99\n",
    }.items():
        yield model_case("more", f"PLY {name}", "m.ply", text)
    for order in ("little", "big"):
        for count in (255, 2**31 - 1, 2**32 - 1):
            body = b"".join(struct.pack("<3f" if order == "little" else ">3f", *p) for p in ((0, 0, 0), (1, 0, 0), (0, 0, 1)))
            body += struct.pack("<I3I" if order == "little" else ">I3I", count, 0, 1, 2)
            yield model_case("more", f"PLY binary {order} list of {count}", "m.ply", head.format(f"binary_{order}_endian 1.0", "element vertex 3\n" + xyz + faces.format("uint", "uint")).encode() + body, seconds=90)
    for path in OUT:
        text = head.format("ascii 1.0", f"comment TextureFile {path}\nelement vertex 3\n" + xyz + "property float s\nproperty float t\n" + faces.format("uchar", "int"))
        yield model_case("more", f"PLY with a picture {path}", "m.ply", text + "0 0 0 0 0\n1 0 0 1 0\n0 0 1 0 1\n3 0 1 2\n")


def plain_cases():
    """STL, OFF, OBJ and MTL."""
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    whole = "solid a\n" + facet + "endsolid a\n"
    for size in range(0, len(whole), 11):
        yield model_case("more", f"STL of text cut at {size}", "m.stl", whole[:size])
    for name, text in {"without vertices": "solid a\n" + "facet normal 0 0 1\nouter loop\nendloop\nendfacet\n" * 1000, "nan": whole.replace("1 0 0", "nan inf 1e400"),
                       "a name of 5 MB": "solid " + "a" * 5_000_000 + "\n" + facet, "10,000 solids": whole * 10_000, "only solid": "solid", "solid and zeros": b"solid" + b"\0" * 200,
                       "loops without end": "solid a\n" + "facet normal 0 0 1\nouter loop\n" * 100_000, "text that is binary": b"solid" + b" " * 75 + struct.pack("<I", 2**28) + b"\xff" * 100}.items():
        yield model_case("more", f"STL {name}", "m.stl", text)
    for name, values in {"nan": (float("nan"),) * 12, "3e38": (3e38,) * 12, "infinite": (float("inf"),) * 12, "denormal": (1e-44,) * 12}.items():
        yield model_case("more", f"binary STL of {name}", "m.stl", b"\0" * 80 + struct.pack("<I", 2) + (struct.pack("<12f", *values) + b"\0\0") * 2)
    for text in ("OFF 3 1 0 0 0 0 1 0 0 0 0 1 3 0 1 2", "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0\n0 0 1\n3 0 1 2\n", "STOFF\n3 1 0\n", "4OFF\n3 1 0\n0 0 0 0\n", "nOFF\n99999999\n3 1 0\n",
                 "OFF BINARY\n\0\0\0\3\0\0\0\1", "OFF\n-3 -1 0\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n-3 0 1 2\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1\n", "OFF\n3 1 0\nnan nan nan\ninf 0 0\n0 0 1\n3 0 1 2\n",
                 "OFF\n3 100000 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n", "OFF\n" + "# comment\n" * 300_000, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 1e30\n"):
        yield model_case("more", f"OFF {text[:32]!r}", "m.off", text)
    obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"
    for name, line in {"continued without end": "f 1 2 \\\n" * 50_000, "a face of 300,000 corners": "f " + "1 2 3 " * 100_000, "100,000 groups": "g a\n" * 100_000, "100,000 materials": "usemtl m\nusemtl n\n" * 50_000,
                       "a call": "call ../outside/secret.mtl\ncall /dev/zero\n", "curves": "curv 0 1 1 2 3\nsurf 0 1 0 1 1 2 3\n", "texture coordinates of nan": "vt nan inf\nf 1/2 2/2 3/2\n", "normals of nan": "vn nan nan nan\nf 1//1 2//1 3//1\n",
                       "three slashes": "f 1/1/1/1 2/2/2/2 3///3\n", "tabs and zeros": "f\t1\0 2 3\n", "1,000 libraries": "mtllib m.mtl\n" * 1000, "a library of itself": "mtllib m.obj\n", "indices of 40 digits": "f " + "1" * 40 + " 2 3\n",
                       "vertices of 4 numbers": "v 1 1 1 0\nf 1 2 4\n", "a negative that wraps": "f -2147483648 -2147483647 -1\n", "subdivision": "cstype bspline\ndeg 1000000\n"}.items():
        yield model_case("more", f"OBJ {name}", "m.obj", obj + line, extra={"m.mtl": "newmtl m\nKd 1 0 0\n"}, seconds=90)
    for path in OUT:
        for key in ("map_Ks", "map_Bump -bm 1", "map_d", "norm", "map_Kd -o 1 1 1 -s 2 2 2 -clamp on", "refl -type sphere", "map_Pr", "disp"):
            yield model_case("more", f"MTL {key} {path}", "m.obj", obj, extra={"m.mtl": f"newmtl m\n{key} {path}\nmap_Kd {path}\n"})
    for mtl in ("newmtl m\n" * 100_000, "newmtl m\nmap_Kd -o\n", "newmtl m\nmap_Kd -s nan nan nan t.png\n", "newmtl m\nTr 1e400\nNi nan\nillum 99999999999\n", "newmtl\nKd\n", "newmtl m\nKd " + "1" * 100_000 + "\n", "\0" * 1000, "newmtl m\nKd xyz 1 2 3\n"):
        yield model_case("more", f"MTL {mtl[:36]!r}", "m.obj", obj, extra={"m.mtl": mtl})


def packed(model, **others):
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         '<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("3D/3dmodel.model", model)
        for name, content in others.items():
            archive.writestr(name, content)
    return target.getvalue()


def three_mf(objects, build='<item objectid="1"/>'):
    return f'<?xml version="1.0"?><model unit="meter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>{objects}</resources><build>{build}</build></model>'


SOLID = ('<object id="{}" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="0" z="1"/></vertices>'
         '<triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>')


def archive_cases():
    whole = packed(three_mf(SOLID.format(1)))
    yield model_case("more", "3MF a right one", "m.3mf", whole, "done")
    for share in range(0, 10):
        yield model_case("more", f"3MF cut to {share} of 10", "m.3mf", whole[: len(whole) * share // 10])
    for at in range(0, len(whole), 23):
        yield model_case("more", f"3MF byte {at}", "m.3mf", whole[:at] + bytes([whole[at] ^ 0xff]) + whole[at + 1:])
    component = '<object id="{}"><components>{}</components></object>'
    itself = component.format(1, '<component objectid="1"/>')
    circle = component.format(1, '<component objectid="2"/>') + component.format(2, '<component objectid="1"/>')
    doubling = "".join(component.format(i, f'<component objectid="{i + 1}"/>' * 2) for i in range(1, 40)) + SOLID.format(40)
    for name, objects, build in (("an object of itself", itself, '<item objectid="1"/>'), ("two objects of each other", circle, '<item objectid="1"/>'), ("an object that doubles 40 times", doubling, '<item objectid="1"/>'),
                                 ("an item of nothing", SOLID.format(1), '<item objectid="99"/>'), ("an item without a number", SOLID.format(1), "<item/>"), ("100,000 items", SOLID.format(1), '<item objectid="1"/>' * 100_000),
                                 ("triangles of no vertex", SOLID.format(1).replace('v3="2"', 'v3="99"'), '<item objectid="1"/>'), ("triangles of negative vertices", SOLID.format(1).replace('v3="2"', 'v3="-7"'), '<item objectid="1"/>'),
                                 ("a transform of nan", SOLID.format(1), '<item objectid="1" transform="nan nan nan nan nan nan nan nan nan nan nan nan"/>'), ("a transform of two", SOLID.format(1), '<item objectid="1" transform="1 2"/>'),
                                 ("vertices of nan", SOLID.format(1).replace('"1"', '"nan"', 2), '<item objectid="1"/>'), ("an object number of 40 digits", SOLID.format("1" * 40), f'<item objectid="{"1" * 40}"/>')):
        yield model_case("more", f"3MF {name}", "m.3mf", lambda o=objects, b=build: packed(three_mf(o, b)), seconds=90)
    for path in ("/../outside/secret.png", "../../outside/secret.png", "/etc/passwd", "/3D/Textures/t.png"):
        texture2d = f'<m:texture2d xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" id="9" path="{path}" contenttype="image/png"/>'
        yield model_case("more", f"3MF with a picture {path}", "m.3mf", packed(three_mf(texture2d + SOLID.format(1)), **{"3D/Textures/t.png": b"\x89PNG"}))
    yield model_case("more", "3MF with a DOCTYPE", "m.3mf", packed(three_mf(SOLID.format(1)).replace("<model", '<!DOCTYPE a [<!ENTITY e SYSTEM "file:///etc/passwd">]><model')))
    yield model_case("more", "3MF of names that lead out", "m.3mf", packed(three_mf(SOLID.format(1)), **{"../../outside/made": "x", "/tmp/parvis-made": "x"}))
    yield model_case("more", "3MF of 50,000 files", "m.3mf", lambda: packed(three_mf(SOLID.format(1)), **{f"f{i}": "" for i in range(50_000)}), seconds=90)


def dae_cases():
    for name, old, new in (("a stride of 2^31", 'stride="3"', 'stride="2147483647"'), ("a stride of 0", 'stride="3"', 'stride="0"'), ("a negative stride", 'stride="3"', 'stride="-3"'), ("a count of 10^18", 'count="9"', 'count="1000000000000000000"'),
                           ("a count of nothing", 'count="9"', 'count=""'), ("an index of 99", "<p>0 1 2", "<p>0 1 99"), ("a negative index", "<p>0 1 2", "<p>0 1 -2"), ("an index of 2^64", "<p>0 1 2", "<p>0 1 18446744073709551618"),
                           ("fewer indices", "<p>0 1 2", "<p>0 1"), ("no indices", "<p>0 1 2</p>", "<p/>"), ("an offset of 10^9", 'offset="0"', 'offset="1000000000"'), ("a negative offset", 'offset="0"', 'offset="-1"'),
                           ("10^9 triangles", 'triangles count="1"', 'triangles count="1000000000"'), ("nan as a number", "0 0 0 1", "nan inf 1e400 1"), ("words as numbers", "0 0 0 1", "a b c d"), ("a source of nothing", 'source="#p"', 'source="#q"'),
                           ("vertices of themselves", 'source="#p"', 'source="#v"'), ("an accessor of itself", 'source="#a"', 'source="#p"'), ("a source without a mark", 'source="#a"', 'source=""'), ("a unit of nan", "<up_axis>", '<unit meter="nan"/><up_axis>'),
                           ("a unit of 0", "<up_axis>", '<unit meter="0"/><up_axis>'), ("a unit of 1e300", "<up_axis>", '<unit meter="1e300"/><up_axis>'), ("another axis", "Z_UP", "W_UP"), ("version 9", "1.4.1", "9.9.9"), ("no geometry", 'id="g"', 'id="h"')):
        yield model_case("more", f"DAE {name}", "m.dae", dae(scene_of("<node>" + INSTANCE + "</node>")).replace(old, new, 1), seconds=90)
    polygons = '<polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/><vcount>{}</vcount><p>0 1 2 0 1 2</p></polylist>'
    for count in ("3 3", "3 99999999", "-3 3", "0 0", "4294967295 1", "", "1 2 3 4 5 6 7"):
        text = dae(scene_of("<node>" + INSTANCE + "</node>"))
        start, end = text.index("<triangles"), text.index("</triangles>") + len("</triangles>")
        yield model_case("more", f"DAE polygons of {count[:20]!r}", "m.dae", text[:start] + polygons.format(count) + text[end:], seconds=90)
    for path in OUT:
        effect = (f'<library_images><image id="i"><init_from>{path}</init_from></image></library_images><library_effects><effect id="e"><profile_COMMON>'
                  '<newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam><newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>'
                  '<technique sid="c"><lambert><diffuse><texture texture="t" texcoord="u"/></diffuse></lambert></technique></profile_COMMON></effect></library_effects>'
                  '<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>')
        bound = '<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry>'
        yield model_case("more", f"DAE with a picture {path}", "m.dae", dae(effect + scene_of(f"<node>{bound}</node>")).replace("<triangles ", '<triangles material="m" '))
        yield model_case("more", f"DAE that names {path}", "m.dae", dae(scene_of(f'<node><instance_geometry url="{path}#g"/><instance_node url="{path}#n"/></node>')))
    samplers = '<library_effects><effect id="e"><profile_COMMON><newparam sid="t"><sampler2D><source>t</source></sampler2D></newparam><technique sid="c"><lambert><diffuse><texture texture="t" texcoord="u"/></diffuse></lambert></technique></profile_COMMON></effect></library_effects>'
    yield model_case("more", "DAE whose sampler is itself", "m.dae", dae(samplers + '<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>' + scene_of("<node>" + INSTANCE + "</node>")))
    yield model_case("more", "DAE whose scene is itself", "m.dae", dae('<library_visual_scenes><visual_scene id="s"><node><instance_visual_scene url="#s"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>'))
    skin = '<library_controllers><controller id="c"><skin source="#c"><joints/><vertex_weights count="4000000000"><vcount>1</vcount><v>0 0</v></vertex_weights></skin></controller></library_controllers>'
    yield model_case("more", "DAE whose skin is its own", "m.dae", dae(skin + scene_of('<node><instance_controller url="#c"/></node>')))
    yield model_case("more", "DAE of 200,000 transforms", "m.dae", lambda: dae(scene_of("<node>" + "<translate>1e30 0 0</translate><scale>1e30 1 1</scale>" * 100_000 + INSTANCE + "</node>")))
    yield model_case("more", "DAE in UTF-16 that is none", "m.dae", dae("").replace('version="1.0"', 'version="1.0" encoding="UTF-16"', 1))


def fbx_text(vertices="0,0,0,1,0,0,0,0,1", indices="0,1,-3", extra="", connections=""):
    return ("; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7300\n}\nObjects:  {\n\tGeometry: 10, \"Geometry::g\", \"Mesh\" {\n"
            f"\t\tVertices: *9 {{\n\t\t\ta: {vertices}\n\t\t}}\n\t\tPolygonVertexIndex: *3 {{\n\t\t\ta: {indices}\n\t\t}}\n\t\tGeometryVersion: 124\n{extra}\t}}\n"
            '\tModel: 1, "Model::a", "Mesh" {\n\t\tVersion: 232\n\t}\n' + "}\n"
            f'Connections:  {{\n\tC: "OO",1,0\n\tC: "OO",10,1\n{connections}}}\n')


def fbx_cases():
    yield model_case("more", "FBX a right one", "m.fbx", fbx_text(), "done")
    whole = fbx_text()
    for size in range(0, len(whole), 29):
        yield model_case("more", f"FBX of text cut at {size}", "m.fbx", whole[:size])
    for indices in ("0,1,2", "-1,-1,-1", "0,1,-99", "99,1,-3", "2147483647,0,-2147483648", "", "a,b,c", "0,1,-3," * 50_000):
        yield model_case("more", f"FBX of indices {indices[:20]!r}", "m.fbx", fbx_text(indices=indices))
    for vertices in ("nan,0,0,1,0,0,0,0,1", "1e400,0,0,1,0,0,0,0,1", "3e38,0,0,-3e38,0,0,0,0,1", "0,0", "", "0,0,0," * 100_000):
        yield model_case("more", f"FBX of vertices {vertices[:20]!r}", "m.fbx", fbx_text(vertices=vertices))
    for mapping in ("ByPolygonVertex", "ByVertice", "ByPolygon", "AllSame", "Nothing"):
        layer = f'\t\tLayerElementMaterial: 0 {{\n\t\t\tMappingInformationType: "{mapping}"\n\t\t\tReferenceInformationType: "IndexToDirect"\n\t\t\tMaterials: *1 {{\n\t\t\t\ta: -9\n\t\t\t}}\n\t\t}}\n' \
                f'\t\tLayerElementUV: 0 {{\n\t\t\tMappingInformationType: "{mapping}"\n\t\t\tReferenceInformationType: "IndexToDirect"\n\t\t\tUV: *2 {{\n\t\t\t\ta: 0,0\n\t\t\t}}\n\t\t\tUVIndex: *3 {{\n\t\t\t\ta: 0,99,-5\n\t\t\t}}\n\t\t}}\n' \
                '\t\tLayer: 0 {\n\t\t\tVersion: 100\n\t\t\tLayerElement:  {\n\t\t\t\tType: "LayerElementUV"\n\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t\tLayerElement:  {\n\t\t\t\tType: "LayerElementMaterial"\n\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n'
        yield model_case("more", f"FBX with layers {mapping}", "m.fbx", fbx_text(extra=layer))
    for path in OUT:
        objects = (f'\tVideo: 21, "Video::v", "Clip" {{\n\t\tFilename: "{path}"\n\t\tRelativeFilename: "{path}"\n\t}}\n\tTexture: 20, "Texture::t", "" {{\n\t\tFileName: "{path}"\n\t\tRelativeFilename: "{path}"\n\t}}\n'
                   '\tMaterial: 22, "Material::m", "" {\n\t\tVersion: 102\n\t\tShadingModel: "phong"\n\t}\n')
        yield model_case("more", f"FBX with a picture {path}", "m.fbx", fbx_text(connections='\tC: "OO",22,1\n\tC: "OP",20,22, "DiffuseColor"\n\tC: "OO",21,20\n').replace('\tModel: 1', objects + "\tModel: 1"))
    yield model_case("more", "FBX 100,000 deep", "m.fbx", "; FBX 7.3.0 project file\n" + "A: {\n" * 100_000)
    nodes = "".join(f'\tModel: {i}, "Model::n", "Null" {{\n\t}}\n' for i in range(100, 141))
    links = "".join(f'\tC: "OO",{i + 1},{i}\n' * 2 for i in range(100, 140)) + '\tC: "OO",100,0\n'
    yield model_case("more", "FBX that doubles 40 times", "m.fbx", fbx_text(connections=links).replace("\tModel: 1,", nodes + "\tModel: 1,"), seconds=120)

    def binary(*nodes, version=7400):
        body = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
        for name, properties in nodes:
            packed_properties = b"".join(properties)
            end = len(body) + 13 + len(name) + len(packed_properties)
            body += struct.pack("<IIIB", end, len(properties), len(packed_properties), len(name)) + name + packed_properties
        return body + b"\0" * 13

    bomb = zlib.compress(b"\0" * 200_000_000, 9)
    for name, properties in {"an array of 2^32-1": [b"d" + struct.pack("<III", 2**32 - 1, 0, 8) + b"\0" * 8], "a packed array of 2^29": [b"d" + struct.pack("<III", 2**29, 1, 8) + b"\0" * 8],
                             "a packed array that unpacks to 200 MB": [b"d" + struct.pack("<III", 25_000_000, 1, len(bomb)) + bomb], "an unknown property": [b"q"], "a text of 2^32-1": [b"S" + struct.pack("<I", 2**32 - 1)]}.items():
        for node in (b"Vertices", b"Objects", b"FBXHeaderExtension"):
            yield model_case("more", f"binary FBX {node.decode()} of {name}", "m.fbx", lambda n=node, p=properties: binary((n, p)))
    yield model_case("more", "binary FBX whose node ends before it", "m.fbx", b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<IIIIB", 7400, 5, 0, 0, 1) + b"a")
    yield model_case("more", "binary FBX of version 2^32-1", "m.fbx", binary((b"Objects", []), version=2**32 - 1))


def cut_and_damaged(title, file, whole, cut, first):
    """A right file, that file cut every `cut` bytes, and with a byte of ones every fifth from `first` on."""
    yield model_case("more", f"{title} a right one", file, whole, "done")
    for size in range(0, len(whole), cut):
        yield model_case("more", f"{title} cut at {size}", file, whole[:size])
    for at in range(first, len(whole), 5):
        yield model_case("more", f"{title} byte {at}", file, whole[:at] + b"\xff" + whole[at + 1:])


def chunk_cases():
    """3DS, LWO, AC3D and DirectX."""
    def chunk(kind, content):
        return struct.pack("<HI", kind, 6 + len(content)) + content

    mesh = chunk(0x4110, struct.pack("<H9f", 3, 0, 0, 0, 1, 0, 0, 0, 0, 1)) + chunk(0x4120, struct.pack("<H4H", 1, 0, 1, 2, 0))
    whole = chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"a\0" + chunk(0x4100, mesh))))
    yield from cut_and_damaged("3DS", "m.3ds", whole, cut=7, first=2)
    for path in OUT:
        material = chunk(0xAFFF, chunk(0xA000, b"m\0") + chunk(0xA200, chunk(0xA300, path.encode() + b"\0")))
        named = mesh + chunk(0x4130, b"m\0" + struct.pack("<HH", 1, 0)) + chunk(0x4140, struct.pack("<H6f", 3, 0, 0, 1, 0, 0, 1))
        yield model_case("more", f"3DS with a picture {path}", "m.3ds", chunk(0x4D4D, chunk(0x3D3D, material + chunk(0x4000, b"a\0" + chunk(0x4100, named)))))
    key = chunk(0xB000, b"".join(chunk(0xB002, chunk(0xB010, b"a\0" + struct.pack("<HHH", 0, 0, parent))) for parent in (0, 1, 2, 65535, 7)))
    yield model_case("more", "3DS of nodes in a circle", "m.3ds", chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"a\0" + chunk(0x4100, mesh))) + key))
    nested = b""
    for _ in range(20_000):
        nested = chunk(0x3D3D, nested) if len(nested) < 200_000 else nested
    yield model_case("more", "3DS of chunks in chunks", "m.3ds", chunk(0x4D4D, nested))

    def iff(kind, content):
        return kind + struct.pack(">I", len(content)) + content + b"\0" * (len(content) % 2)

    body = iff(b"LAYR", struct.pack(">HH3f", 0, 0, 0, 0, 0) + b"a\0") + iff(b"PNTS", struct.pack(">9f", 0, 0, 0, 1, 0, 0, 0, 0, 1)) + iff(b"POLS", b"FACE" + struct.pack(">4H", 3, 0, 1, 2)) + iff(b"TAGS", b"m\0") + iff(b"PTAG", b"SURF" + struct.pack(">2H", 0, 0))
    whole = iff(b"FORM", b"LWO2" + body)
    yield from cut_and_damaged("LWO", "m.lwo", whole, cut=9, first=12)
    for path in OUT:
        clip = iff(b"CLIP", struct.pack(">I", 1) + b"STIL" + struct.pack(">H", len(path) + 1 + (len(path) + 1) % 2) + path.encode() + b"\0" * (1 + (len(path) + 1) % 2))
        yield model_case("more", f"LWO with a picture {path}", "m.lwo", iff(b"FORM", b"LWO2" + body + clip))
    ac = "AC3Db\nMATERIAL \"m\" rgb 1 0 0 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\nOBJECT poly\n{}numvert 3\n0 0 0\n1 0 0\n0 0 1\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n"
    whole = ac.format("")
    for size in range(0, len(whole), 13):
        yield model_case("more", f"AC3D cut at {size}", "m.ac", whole[:size])
    for old, new in (("numvert 3", "numvert -3"), ("numsurf 1", "numsurf 99999999"), ("refs 3", "refs 4000000000"), ("mat 0", "mat 99"), ("mat 0", "mat -99"), ("kids 1", "kids 1000000"), ("1 0 0\n0 0 1", "nan inf 1e400\n0 0 1"), ("SURF 0x0", "SURF 0x4"), ("2 0 0", "4294967295 0 0")):
        yield model_case("more", f"AC3D {new}", "m.ac", whole.replace(old, new, 1))
    for path in OUT:
        yield model_case("more", f"AC3D with a picture {path}", "m.ac", ac.format(f'texture "{path}"\n'))
    for line in ("subdiv 30\n", "subdiv -1\n", "crease nan\n", "loc nan nan nan\n", "rot 1e300 0 0 0 0 0 0 0 0\n", "data 99999999\nx\n", "texrep nan nan\n"):
        yield model_case("more", f"AC3D {line[:14]!r}", "m.ac", ac.format(line), seconds=90)
    x = "xof 0303txt 0032\nMesh m {{\n3;\n0;0;0;,\n1;0;0;,\n0;0;1;;\n1;\n3;0,1,2;;\n{}}}\n"
    whole = x.format("")
    for size in range(0, len(whole), 7):
        yield model_case("more", f"X cut at {size}", "m.x", whole[:size])
    for old, new in (("3;\n0", "4000000000;\n0"), ("3;0,1,2", "3;0,1,99"), ("3;0,1,2", "3;0,1,-2"), ("3;0,1,2", "4000000000;0,1,2"), ("1;\n3", "4000000000;\n3"), ("1;0;0", "nan;inf;1e400"), ("0303txt", "0303bin"), ("0303txt", "0303tzip"), ("0303txt", "0303bzip"), ("0032", "9999")):
        yield model_case("more", f"X {new!r}", "m.x", whole.replace(old, new, 1), seconds=90)
    for path in OUT:
        material = f'MeshMaterialList {{ 1; 1; 0; Material a {{ 1;0;0;1;; 1; 0;0;0;; 0;0;0;; TextureFilename {{ "{path}"; }} }} }}\nMeshTextureCoords {{ 3; 0;0;, 1;0;, 0;1;; }}\n'
        yield model_case("more", f"X with a picture {path}", "m.x", x.format(material))
    yield model_case("more", "X that unpacks to much", "m.x", lambda: b"xof 0303tzip0032" + struct.pack("<IHH", 2**32 - 1, 32768, 2 + 200) + b"CK" + zlib.compress(b"\0" * 30_000)[2:] + b"\0" * 300)


def city_cases():
    def objects(**changes):
        return city(CityObjects=changes)

    surface_of = [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2]]]}]
    yield model_case("more", "CityJSON of its own parent", "m.json", objects(a={"type": "Building", "parents": ["a"], "children": ["a"], "geometry": surface_of}))
    yield model_case("more", "CityJSON of parents in a circle", "m.json", objects(a={"type": "Building", "children": ["b"], "parents": ["b"], "geometry": surface_of}, b={"type": "BuildingPart", "children": ["a"], "parents": ["a"], "geometry": surface_of}))
    yield model_case("more", "CityJSON of 100,000 objects without geometry", "m.json", lambda: objects(**{f"o{i}": {"type": "Building"} for i in range(100_000)}))
    for name, geometry in {"semantics of other numbers": {"semantics": {"surfaces": [{"type": "RoofSurface"}], "values": [99]}}, "negative semantics": {"semantics": {"surfaces": [{"type": "RoofSurface"}], "values": [-1]}},
                           "semantics in semantics": {"semantics": {"surfaces": [{"type": "Door", "parent": 0, "children": [0]}], "values": [0]}}, "semantics of text": {"semantics": "a"}, "values of text": {"semantics": {"surfaces": {}, "values": "a"}},
                           "a texture of other numbers": {"texture": {"t": {"values": [[[99, 0, 1, 2]]]}}}, "a negative texture": {"texture": {"t": {"values": [[[-1, -1, -1, -1]]]}}}, "a texture of text": {"texture": {"t": {"values": [[["a"]]]}}},
                           "a material of other numbers": {"material": {"t": {"value": 99}}}, "a negative material": {"material": {"t": {"values": [-9]}}}, "a level of nan": {"lod": "nan"}, "a level of lists": {"lod": [[1]]}, "a template of nothing": {"type": "GeometryInstance", "template": 99},
                           "a template without a place": {"type": "GeometryInstance", "template": 0, "boundaries": []}, "no boundaries": {"boundaries": None}, "an unknown type": {"type": "Nonsense"}, "a type of numbers": {"type": 7}}.items():
        yield model_case("more", f"CityJSON with {name}", "m.json", objects(a={"type": "Building", "geometry": [{**surface_of[0], **geometry}]}))
    for key, value in {"version": 99, "transform": None, "vertices": {}, "appearance": {"materials": "a", "textures": 7, "vertices-texture": "a"}, "metadata": {"referenceSystem": "a" * 1_000_000}, "extensions": {"a": {"url": "http://127.0.0.1:9/a.json"}},
                       "CityObjects": [], "geometry-templates": {"templates": "a", "vertices-templates": 7}}.items():
        yield model_case("more", f"CityJSON whose {key} is another", "m.json", city(**{key: value}))
    yield model_case("more", "CityJSON of 3,000,000 vertices that nobody uses", "m.json", lambda: city(vertices=[[0, 0, 0], [9, 0, 0], [0, 0, 9]] * 1_000_000), "done", seconds=120)
    yield model_case("more", "CityJSON of a ring of 200,000 equal points", "m.json", lambda: objects(a={"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2] * 70_000]]}]}), seconds=90)
    yield model_case("more", "CityJSON of 100,000 surfaces in one place", "m.json", lambda: objects(a={"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2]]] * 100_000}]}), seconds=90)
    line = '{"type":"CityJSONFeature","id":"a","vertices":[[0,0,0],[9,0,0],[0,0,9]],"CityObjects":{"a":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]}}}\n'
    yield model_case("more", "a sequence of 50,000 equal features", "m.jsonl", lambda: city() + "\n" + line * 50_000, seconds=120)
    yield model_case("more", "a sequence whose features are no documents", "m.jsonl", city() + "\n" + "7\n" * 1000)
    yield model_case("more", "a sequence of vertices out of range", "m.jsonl", city() + "\n" + line.replace("[0,1,2]", "[0,1,99]"))
    right = surface("0 0 0 1 0 0 0 0 1 0 0 0")
    for name, inside in {"a dimension of 99999999": right.replace('"3"', '"99999999"'), "a dimension of 0": right.replace('"3"', '"0"'), "a negative dimension": right.replace('"3"', '"-3"'), "a surface of itself": right.replace("<gml:surfaceMember>", '<gml:surfaceMember xlink:href="#s" xmlns:xlink="http://www.w3.org/1999/xlink"/><gml:surfaceMember>').replace("<gml:MultiSurface>", '<gml:MultiSurface gml:id="s">'),
                         "a reference to another file": '<bldg:lod1MultiSurface xmlns:xlink="http://www.w3.org/1999/xlink" xlink:href="../outside/secret.bin#s"/>', "10,000 rings": right.replace("</gml:exterior>", "</gml:exterior>" + "<gml:interior><gml:LinearRing><gml:posList>0 0 0 1 0 0 0 0 1 0 0 0</gml:posList></gml:LinearRing></gml:interior>" * 10_000),
                         "a name of 5 MB": '<gml:name xmlns:gml="http://www.opengis.net/gml">' + "a" * 5_000_000 + "</gml:name>" + right, "a height of nan": '<bldg:measuredHeight uom="m">nan</bldg:measuredHeight>' + right, "attributes of 1 MB": right.replace("<gml:Polygon>", '<gml:Polygon gml:id="' + "a" * 1_000_000 + '">'),
                         "half a letter": right.replace("<gml:Polygon>", "<gml:Polygon><!-- \udce9 -->")}.items():
        yield model_case("more", f"CityGML with {name}", "m.gml", gml(inside).encode("utf-8", "surrogateescape"), seconds=90)
    for system in ("EPSG:99999999", "urn:ogc:def:crs:EPSG::4326", "+proj=pipeline +step +proj=geos +h=-1", "../outside/secret.bin", "a" * 100_000, "%n%s"):
        yield model_case("more", f"CityGML in the system {system[:30]}", "m.gml", gml(f'<gml:boundedBy xmlns:gml="http://www.opengis.net/gml"><gml:Envelope srsName="{system}" srsDimension="3"><gml:lowerCorner>0 0 0</gml:lowerCorner><gml:upperCorner>1 1 1</gml:upperCorner></gml:Envelope></gml:boundedBy>' + right))
    implicit = '<bldg:outerBuildingInstallation><bldg:BuildingInstallation><bldg:lod2ImplicitRepresentation><ImplicitGeometry><libraryObject>{}</libraryObject></ImplicitGeometry></bldg:lod2ImplicitRepresentation></bldg:BuildingInstallation></bldg:outerBuildingInstallation>'
    for path in OUT:
        yield model_case("more", f"CityGML with a library {path}", "m.gml", gml(implicit.format(path) + right))
        appearance = f'<app:appearanceMember xmlns:app="http://www.opengis.net/citygml/appearance/2.0"><app:Appearance><app:surfaceDataMember><app:ParameterizedTexture><app:imageURI>{path}</app:imageURI></app:ParameterizedTexture></app:surfaceDataMember></app:Appearance></app:appearanceMember>'
        yield model_case("more", f"CityGML with a picture {path}", "m.gml", gml(right).replace("</CityModel>", appearance + "</CityModel>"))
    for encoding in ("UTF-16", "UTF-32", "EBCDIC-CP-US", "nonsense", ""):
        yield model_case("more", f"CityGML in {encoding!r}", "m.gml", gml(right).replace("UTF-8", encoding))


def varint(value):
    out = b""
    while value > 127:
        out, value = out + bytes([value & 127 | 128]), value >> 7
    return out + bytes([value])


def field(number, content):
    return varint(number << 3 | 2) + varint(len(content)) + content if isinstance(content, bytes) else varint(number << 3) + varint(content)


def pbf(kind, content, raw_size=None):
    packed_content = zlib.compress(content, 9)
    blob = field(2, len(content) if raw_size is None else raw_size) + field(3, packed_content)
    head = field(1, kind) + field(3, len(blob))
    return struct.pack(">I", len(head)) + head + blob


def map_cases():
    header = pbf(b"OSMHeader", field(4, b"OsmSchema-V0.6") + field(4, b"DenseNodes"))
    strings = field(1, field(1, b"") + field(1, b"building") + field(1, b"yes"))

    def zigzag(value):
        return varint((value << 1) ^ (value >> 63))

    def block(group, more=b""):
        return header + pbf(b"OSMData", strings + field(2, group) + more)

    dense = field(2, field(1, b"".join(map(zigzag, (1, 1, 1)))) + field(8, b"".join(map(zigzag, (520000000, 10000, 0)))) + field(9, b"".join(map(zigzag, (40000000, 0, 10000)))))
    way = field(3, field(1, 1) + field(2, varint(1)) + field(3, varint(2)) + field(8, b"".join(map(zigzag, (1, 1, 1, -2)))))
    right = block(dense) + pbf(b"OSMData", strings + field(2, way))
    for size in range(0, len(right), 13):
        yield model_case("more", f"PBF cut at {size}", "m.pbf", right[:size])
    for name, content in {"a right one": right, "a block that unpacks to 2 GB": lambda: header + pbf(b"OSMData", b"\0" * 500_000_000, 2**31 - 1), "a block that claims 2^31": header + pbf(b"OSMData", b"\0" * 10, 2**31), "a block that claims -1": header + pbf(b"OSMData", b"\0" * 10, 2**64 - 1),
                          "a head of 2^32-1": header + b"\xff\xff\xff\xff" + b"\0" * 100, "dense nodes of unequal length": block(field(2, field(1, b"\2" * 1000) + field(8, b"\2") + field(9, b"\2"))), "a granularity of 0": block(dense, field(17, 0)),
                          "a granularity of 2^31": block(dense, field(17, 2**31)), "an offset of 2^63": block(dense, field(19, 2**63) + field(20, 2**63)), "texts out of range": block(field(3, field(1, 1) + field(2, varint(99)) + field(3, varint(2**32)) + field(8, zigzag(1)))),
                          "more keys than values": block(field(3, field(1, 1) + field(2, varint(1) * 5) + field(8, zigzag(1)))), "a way of 5,000,000 nodes": lambda: block(dense) + pbf(b"OSMData", strings + field(2, field(3, field(1, 1) + field(2, varint(1)) + field(3, varint(2)) + field(8, zigzag(1) + b"\0" * 5_000_000)))),
                          "nodes at numbers that wrap": block(field(2, field(1, b"".join(zigzag(2**62) for _ in range(8))) + field(8, b"".join(zigzag(2**62) for _ in range(8))) + field(9, b"".join(zigzag(2**62) for _ in range(8))))),
                          "a relation of itself": block(dense) + pbf(b"OSMData", strings + field(2, field(4, field(1, 1) + field(2, varint(1)) + field(3, varint(2)) + field(8, varint(0)) + field(9, zigzag(1)) + field(10, varint(2))))), "10,000 blocks": lambda: header + pbf(b"OSMData", strings + field(2, dense)) * 10_000,
                          "another packing": header + struct.pack(">I", len(field(1, b"OSMData") + field(3, 8))) + field(1, b"OSMData") + field(3, 8) + field(4, b"\0" * 6), "a required feature": pbf(b"OSMHeader", field(4, b"Nonsense"))}.items():
        yield model_case("more", f"PBF {name}", "m.pbf", content, "done" if name == "a right one" else "either", seconds=120)
    for name, text in {"nodes beyond the poles": building([(900, 0), (0, 900), (900, 900)]), "nodes of nan": building(SQUARE).replace('lat="52"', 'lat="nan"'), "nodes of 1e400": building(SQUARE).replace('lat="52"', 'lat="1e400"'), "numbers of 40 digits": building(SQUARE).replace('id="0"', 'id="' + "9" * 40 + '"'),
                       "a way of one node": osm('<node id="1" lat="52" lon="4"/><way id="1"><nd ref="1"/><tag k="building" v="yes"/></way>'), "a way of absent nodes": osm('<way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/></way>'),
                       "a house of 50,000 equal corners": building([(0, 0), (0, .001)] * 25_000), "100,000 tags": building(SQUARE, '<tag k="building" v="yes"/>' + '<tag k="a" v="b"/>' * 100_000), "a tag of 5 MB": building(SQUARE, f'<tag k="building" v="{"a" * 5_000_000}"/>'),
                       "5,000 houses in one place": osm("".join(f'<node id="{i}" lat="{52 + a}" lon="{4 + b}"/>' for i, (a, b) in enumerate(SQUARE)) + "".join(f'<way id="{w}">' + "".join(f'<nd ref="{i}"/>' for i in (0, 1, 2, 3, 0)) + '<tag k="building" v="yes"/></way>' for w in range(5000))),
                       "a bridge on layer 10^9": building(SQUARE, '<tag k="highway" v="primary"/><tag k="bridge" v="yes"/><tag k="layer" v="1000000000"/>'), "trees between 10^9 levels": building(SQUARE, '<tag k="building" v="yes"/><tag k="building:levels" v="1000000000"/><tag k="roof:shape" v="gabled"/>'),
                       "a forest of 100 km": osm('<node id="0" lat="52" lon="4"/><node id="1" lat="53" lon="4"/><node id="2" lat="53" lon="5"/><node id="3" lat="52" lon="5"/><way id="1"><nd ref="0"/><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="0"/><tag k="natural" v="wood"/></way>', '<bounds minlat="52" minlon="4" maxlat="53" maxlon="5"/>'),
                       "a row of trees of 100 km": osm('<node id="0" lat="52" lon="4"/><node id="1" lat="53" lon="4"/><way id="1"><nd ref="0"/><nd ref="1"/><tag k="natural" v="tree_row"/></way>', '<bounds minlat="52" minlon="4" maxlat="53" maxlon="5"/>'),
                       "a square of 50 x 50 crossings in a polygon": building([(.0001 * i * (1 if i % 2 else -1), .00002 * i) for i in range(400)])}.items():
        yield model_case("more", f"OSM {name}", "m.osm", text, seconds=120)


def raster(*entries, data=b"\0" * 64, **more):
    given = {256: (4, 1, 4), 257: (4, 1, 4), 258: (3, 1, 32), 259: (3, 1, 1), 262: (3, 1, 1), 273: (4, 1, 200), 277: (3, 1, 1), 278: (4, 1, 4), 279: (4, 1, 64), 339: (3, 1, 3)}
    for tag, *value in entries:
        given[tag] = tuple(value)
    whole = tiff([(tag, *value) for tag, value in sorted(given.items())], b"")
    return whole + b"\0" * (200 - len(whole)) + data


def terrain_cases():
    heights = struct.pack("<16f", *range(16))
    yield model_case("more", "terrain, a right one", "m.tif", raster(data=heights), "done", attributes=", cell=1")
    for name, entries in {"packed by JPEG": [(259, 3, 1, 7)], "packed by what nobody knows": [(259, 3, 1, 9999)], "65,535 samples": [(277, 3, 1, 65535)], "65,535 bits": [(258, 3, 1, 65535)], "0 bits": [(258, 3, 1, 0)], "text as numbers": [(339, 3, 1, 99)], "0 rows in a strip": [(278, 4, 1, 0)],
                          "tiles of 2^31": [(322, 4, 1, 2**31), (323, 4, 1, 2**31), (324, 4, 1, 200), (325, 4, 1, 64)], "tiles of 0": [(322, 4, 1, 0), (323, 4, 1, 0), (324, 4, 1, 200), (325, 4, 1, 64)], "10^6 strips": [(257, 4, 1, 10**6), (278, 4, 1, 1), (273, 4, 10**6, 200), (279, 4, 10**6, 200)],
                          "a scale of nothing": [(33550, 12, 3, 200), (33922, 12, 6, 200)], "a system of 65,535": [(34735, 3, 65535, 200)], "a nodata of 10^9 letters": [(42113, 2, 10**9, 200)], "a colour map": [(262, 3, 1, 3), (320, 3, 65535, 200)], "metadata of 2^31 letters": [(42112, 2, 2**31, 200)]}.items():
        yield model_case("more", f"terrain, {name}", "m.tif", raster(*entries, data=heights), attributes=", cell=1")
    for name, values in {"nan": [float("nan")] * 16, "infinite": [float("inf")] * 16, "3e38": [3e38, -3e38] * 8, "-9999": [-9999.0] * 16, "some nan": [1.0, float("nan")] * 8}.items():
        yield model_case("more", f"terrain of {name}", "m.tif", raster(data=struct.pack("<16f", *values)), attributes=", cell=1")
    whole = raster(data=heights)
    count = struct.unpack_from("<H", whole, 8)[0]
    yield model_case("more", "terrain whose pages are a circle", "m.tif", whole[:10 + 12 * count] + struct.pack("<I", 8) + whole[14 + 12 * count:], attributes=", cell=1")
    for at in range(8, 140, 6):
        yield model_case("more", f"terrain byte {at}", "m.tif", whole[:at] + bytes([whole[at] ^ 0xff]) + whole[at + 1:], attributes=", cell=1")
    vrt = '<VRTDataset rasterXSize="4" rasterYSize="4"><VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename>../outside/secret.bin</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>'
    for name in ("m.tif", "m.vrt", "m.asc"):
        yield model_case("more", f"terrain, a list of others as {name}", name, vrt, "refused", attributes=", cell=1")
    side = raster(data=heights)
    for name, content in {"m.tif.aux.xml": '<PAMDataset><Metadata domain="x"><MDI key="a">../outside/secret.bin</MDI></Metadata></PAMDataset>', "m.tif.ovr": b"II*\0" + b"\xff" * 100, "m.tfw": "nan\nnan\nnan\nnan\nnan\nnan\n", "m.tif.msk": side, "m.tif.aux.xml ": "<" * 100_000}.items():
        yield model_case("more", f"terrain beside {name.strip()}", "m.tif", side, extra={name.strip(): content}, attributes=", cell=1")


def ifc_cases():
    for name, pattern, replacement in (("solids whose profile is themselves", rb"#(\d+)=IFCEXTRUDEDAREASOLID\(#\d+", rb"#\1=IFCEXTRUDEDAREASOLID(#\1"), ("extrusions of 1e300", rb"(IFCEXTRUDEDAREASOLID\([^;]*),[\d.E+-]+\);", rb"\1,1.E300);"),
                                       ("extrusions of nothing", rb"(IFCEXTRUDEDAREASOLID\([^;]*),[\d.E+-]+\);", rb"\1,0.);"), ("a million units", rb"IFCSIUNIT\(\*,\.LENGTHUNIT\.,\$,\.METRE\.\)", b"IFCSIUNIT(*,.LENGTHUNIT.,.EXA.,.METRE.)"),
                                       ("placements of themselves", rb"#(\d+)=IFCLOCALPLACEMENT\((?:\$|#\d+)", rb"#\1=IFCLOCALPLACEMENT(#\1"), ("aggregates of themselves", rb"(=IFCRELAGGREGATES\([^;]*),(#\d+),\([^)]*\)\)", rb"\1,\2,(\2))"),
                                       ("circles of 1e300", rb"IFCRECTANGLEPROFILEDEF\([^;]*\);", b"IFCCIRCLEPROFILEDEF(.AREA.,$,$,1.E300);"), ("circles of nothing", rb"IFCRECTANGLEPROFILEDEF\([^;]*\);", b"IFCCIRCLEPROFILEDEF(.AREA.,$,$,0.);")):
        yield model_case("more", f"IFC {name}", "m.ifc", lambda p=pattern, r=replacement: ifc_spoiled(p, r) if __import__("re").search(p, pavilion()) else pavilion(), seconds=90)


def picture_cases():
    def gif(width, height, frames, data=b"\x02\x02\x44\x01\0"):
        return b"GIF89a" + struct.pack("<HHBBB", width, height, 0x80, 0, 0) + b"\0\0\0\xff\xff\xff" + (b"\x2c" + struct.pack("<HHHHB", 0, 0, width, height, 0) + data) * frames + b";"

    for name, content in {"of 20,000 frames": gif(1, 1, 20_000), "of no frame": gif(4, 4, 0), "whose codes have no end": gif(4, 4, 1, b"\x02" + b"\xff" * 400), "of 13 bits": gif(4, 4, 1, b"\x0d\x02\x44\x01\0"), "of comments": b"GIF89a\1\0\1\0\0\0\0" + b"\x21\xfe\xff" + b"a" * 255 * 1000}.items():
        yield texture(f"GIF {name}", "t.gif", content, "either")
    chunk = lambda kind, content: struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    good = png(8, 8)
    for name, content in {"a text that unpacks to 500 MB": lambda: chunk(b"zTXt", b"a\0\0" + zlib.compress(b"\0" * 500_000_000, 9)), "a profile that unpacks to 500 MB": lambda: chunk(b"iCCP", b"a\0\0" + zlib.compress(b"\0" * 500_000_000, 9)), "100,000 texts": lambda: chunk(b"tEXt", b"a\0b") * 100_000,
                          "a chunk of 2^31": lambda: struct.pack(">I", 2**31 - 1) + b"tEXt", "two heads": lambda: good[8:33], "a palette of 257": lambda: chunk(b"PLTE", b"\0" * 771), "a gamma of 0": lambda: chunk(b"gAMA", b"\0\0\0\0"), "animation": lambda: chunk(b"acTL", struct.pack(">II", 2**31 - 1, 0))}.items():
        yield texture(f"PNG with {name}", "t.png", good[:33] + content() + good[33:] if "500 MB" not in name else good[:33] + content() + good[33:], "either", seconds=90)
    riff = lambda content: b"RIFF" + struct.pack("<I", 4 + len(content)) + b"WEBP" + content
    part = lambda kind, content: kind + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)
    for name, content in {"of 16,384 x 16,384": riff(part(b"VP8L", b"\x2f" + struct.pack("<I", 0x3FFF | 0x3FFF << 14) + b"\0" * 40)), "that is extended to 2^24": riff(part(b"VP8X", b"\x10\0\0\0\xff\xff\xff\xff\xff\xff") + part(b"VP8L", b"\x2f\0\0\0\0\0")), "of 5,000 frames": riff(part(b"VP8X", b"\x02\0\0\0\0\0\0\0\0\0") + part(b"ANIM", b"\0" * 6) + part(b"ANMF", b"\0" * 16 + part(b"VP8L", b"\x2f\0\0\0\0\0")) * 5000), "of nothing": riff(b"")}.items():
        yield texture(f"WebP {name}", "t.webp", content, "either")
    quantities = b"\xff\xdb\0\x43\0" + b"\1" * 64
    for width, height in ((65500, 65500), (0, 0), (1, 65500)):
        progressive = b"\xff\xd8" + quantities + b"\xff\xc2\0\x0b\x08" + struct.pack(">HH", height, width) + b"\x01\x01\x11\0" + b"\xff\xda\0\x08\x01\x01\0\0\0\0" * 20_000 + b"\xff\xd9"
        yield texture(f"JPEG of 20,000 passes over {width} x {height}", "t.jpg", progressive, "either", seconds=90)
    yield texture("JPEG with 65,535 bytes of place and time", "t.jpg", b"\xff\xd8\xff\xe1\xff\xffExif\0\0II*\0\x08\0\0\0\xff\xff" + b"\xff" * 65_000, "either")
    yield texture("JPEG of marks alone", "t.jpg", b"\xff\xd8" + b"\xff\xd0" * 100_000, "either")
    entries = [(256, 4, 1, 8), (257, 4, 1, 8), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 1), (273, 4, 1, 200), (277, 3, 1, 1), (278, 4, 1, 8), (279, 4, 1, 64)]
    whole = tiff(entries, b"")
    whole += b"\x80" * (264 - len(whole))
    end = 10 + 12 * len(entries)
    yield texture("TIFF a right one", "t.tif", whole)
    yield texture("TIFF whose pages are a circle", "t.tif", whole[:end] + struct.pack("<I", 8) + whole[end + 4:], "either")
    for at in range(10, end, 12):
        for value in (0, 2**31, 2**32 - 1):
            yield texture(f"TIFF entry {(at - 10) // 12} is {value}", "t.tif", whole[:at + 8] + struct.pack("<I", value) + whole[at + 12:], "either")
    for packing in (2, 3, 4, 5, 6, 7, 8, 32773, 32946, 34676, 34712, 50000, 50001):
        yield texture(f"TIFF packed by {packing}", "t.tif", whole[:10 + 36 + 8] + struct.pack("<I", packing) + whole[10 + 36 + 12:], "either")
    floats = exr([1.0, 2.0])
    for at in (4, 5, 6, 7, *range(8, 300, 7)):
        yield texture(f"EXR byte {at}", "t.exr", floats[:at] + bytes([floats[at] ^ 0xff]) + floats[at + 1:], "either")
    box = floats.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
    for window in ((0, 0, 2**31 - 1, 2**31 - 1), (-2**31, -2**31, 2**31 - 1, 2**31 - 1), (5, 5, 0, 0), (0, 0, 99_999, 99_999)):
        yield texture(f"EXR of {window}", "t.exr", floats[:box] + struct.pack("<iiii", *window) + floats[box + 16:], "either")
    for packing in range(1, 12):
        at = floats.index(b"compression\0compression\0") + len(b"compression\0compression\0") + 4
        yield texture(f"EXR packed by {packing}", "t.exr", floats[:at] + bytes([packing]) + floats[at + 1:], "either")
    for name, content in {"rows that overrun": b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 16\n" + b"\2\2\0\x10" + b"\xff\1" * 200, "rows of nothing": b"#?RADIANCE\n\n-Y 2 +X 16\n\2\2\0\x10" + b"\0" * 100, "other rows": b"#?RADIANCE\n\n+X 8 +Y 8\n" + b"\x80" * 256, "a negative size": b"#?RADIANCE\n\n-Y -8 +X -8\n",
                          "an exposure of nan": b"#?RADIANCE\nEXPOSURE=nan\nGAMMA=0\n\n-Y 2 +X 4\n" + b"\x80" * 32, "a head without end": b"#?RADIANCE\n" + b"A=B\n" * 500_000}.items():
        yield texture(f"HDR with {name}", "t.hdr", content, "either")
    for kind in (0, 1, 2, 3, 9, 10, 11, 32, 255):
        for bits in (0, 8, 15, 16, 24, 32, 255):
            if kind in (1, 9) and bits in (24, 32):
                continue  # ends OpenImageIO's reader: docs/safety.md
            yield texture(f"TGA {kind} of {bits} bits", "t.tga", struct.pack("<BBBHHBHHHHBB", 0, kind in (1, 9), kind, 0, 256, 24, 0, 0, 8, 8, bits, 0) + b"\xff" * 900, "either")


def script_cases():
    for name, text in {"100,000 groups in groups": "group() {" * 100_000 + "}" * 100_000, "100,000 groups without end": "group() {" * 100_000, "a text without end": 'model(file="' + "a" * 1_000_000, "a number of 1,000,000 digits": "sun(azimuth_deg=" + "1" * 1_000_000 + ")", "100,000 attributes": "sun(" + "a=1," * 100_000 + ")",
                       "no bytes but zeros": b"\0" * 1_000_000, "bytes that are no UTF-8": b"sun(\xff\xfe=\xe9)", "a mark of the byte order": b"\xef\xbb\xbfsun()\n" + CAMERA.encode(), "UTF-16": "sun()".encode("utf-16"), "returns alone": b"sun()\r" * 1000 + CAMERA.encode(), "a million suns": "sun()\n" * 1_000_000,
                       "a name that turns the line": 'model(file="a\u202eb\x1b[2J.obj")\n', "a million errors": "x\n" * 1_000_000, "100,000 cameras": CAMERA * 100_000, "a name of 1 MB": f'group(name="{"a" * 1_000_000}") {{ }}\ntimer(onTime="0, {"a" * 1_000_000}, hide, 0")\n' + CAMERA, "brackets": "(" * 500_000, "braces": "}" * 500_000, "quotes": '"' * 500_001,
                       "comments in comments": "/*" * 500_000, "an include of itself": 'include(file="scene.xp")\n', "an include of two of itself": 'include(file="scene.xp")\ninclude(file="./scene.xp")\n'}.items():
        def build(folder, text=text):
            script = scene(folder, text)
            return [["check", script], ["format", script], ["export", script, "-o", "out.glb"]]

        yield Case("more", f"a script of {name}", build, "either", seconds=60)

    def ladder(folder):
        for i in range(40):
            write(folder, f"i{i}.xp", f'include(file="i{i + 1}.xp")\n' * 2)
        write(folder, "i40.xp", "sun()\n")
        return [["check", "i0.xp"]]

    yield Case("more", "a script that includes 2^40 others", ladder, "refused", seconds=60)


def cases():
    for part in (ply_cases, plain_cases, archive_cases, dae_cases, fbx_cases, chunk_cases, city_cases, map_cases, terrain_cases, ifc_cases, picture_cases, script_cases):
        yield from part()
