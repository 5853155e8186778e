"""Meshes that assimp reads, and files that are named like them; nothing that ends a reader (docs/safety.md)."""

import io
import pathlib
import re
import struct
import zipfile

from .case import SECRET, model_case, write, scene, CAMERA, Case
from .png import png
from .secret_picture import JPEG

OBJ = "mtllib m.mtl\no sail\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"


def ply_binary(vertices=40, faces=40):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n").encode()
    body = b"".join(struct.pack("<3f", i % 7, i % 5, i % 3) for i in range(40))
    return head + body + b"".join(struct.pack("<B3i", 3, i % 40, (i + 1) % 40, (i + 9) % 40) for i in range(40))


def ply_text(face, vertices=3, faces=1):
    return (f"ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\nelement face {faces}\n"
            f"property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 0 1\n{face}\n")


def dae(nodes):
    return ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Z_UP</up_axis></asset>'
            '<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 0 1</float_array>'
            '<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>'
            '<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
            '<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>'
            + nodes + "</COLLADA>")


INSTANCE = '<instance_geometry url="#g"/>'


def zip_bomb(size):
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         '<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", b"<model>" + b" " * size)
    return target.getvalue()


def scene_of(nodes):
    return f'<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>'


def pavilion():
    """A right building as IFC, 48 KB."""
    return (pathlib.Path(__file__).resolve().parents[2] / "scenes/pavilion.ifc").read_bytes()


def ifc_spoiled(pattern, replacement):
    """The pavilion with each match replaced."""
    text = re.sub(pattern, replacement, pavilion())
    if text == pavilion():
        raise LookupError(f"{pattern}: nothing of the pavilion is replaced")
    return text


def ifc_textured(texture):
    """The pavilion whose surface styles have a picture, too."""
    text = re.sub(rb"(#\d+=IFCSURFACESTYLE\([^;]*\([^)]*)\)\);", rb"\1,#900001));", pavilion())
    if b"#900001" not in text:
        raise LookupError("no surface style of the pavilion gets a picture")
    return text.replace(b"ENDSEC;\nEND-ISO", b"#900001=IFCSURFACESTYLEWITHTEXTURES((#900002));\n#900002=" + texture + b"\nENDSEC;\nEND-ISO")


def ifc_picture_cases():
    """Pictures of surface styles, beside the file and in it."""
    for path in ("../outside/secret.png", "../outside/secret.jpg", "link.png", "link.jpg", "/etc/passwd", "pipe", "file:///etc/passwd", "%2e%2e/outside/secret.png", "..\\\\outside\\\\secret.png",
                 "t.avi", "x.null?RES=32768x32768", ".", "memory.jpg", "http://127.0.0.1:9/a.png", "a" * 5000):
        yield model_case("ifc", f"a picture {path[:40]}", "m.ifc", lambda p=path: ifc_textured(b"IFCIMAGETEXTURE(.T.,.T.,$,$,$,'" + p.encode() + b"');"), "done",
                         extra={"t.avi": b"ffconcat version 1.0\nfile ../outside/secret.png\n", "memory.jpg": JPEG[:40]})
    for name, content in {"a right one": png(8, 8), "cut": png(8, 8)[:40], "that claims 32768 x 32768": png(32768, 32768, b"\0"), "a list of films": b"ffconcat version 1.0\nfile ../outside/secret.png\n",
                          "a list of addresses": b"#EXTM3U\nlink.png", "no bytes": b"", "10 MB of ones": b"\xff" * 10_000_000}.items():
        yield model_case("ifc", f"a picture in the file, {name}", "m.ifc",
                         lambda c=content: ifc_textured(b"IFCBLOBTEXTURE(.T.,.T.,$,$,$,'PNG',\"0" + c.hex().upper().encode() + b"\");"), "done", seconds=90)
    yield model_case("ifc", "a picture that is its own style", "m.ifc", lambda: ifc_textured(b"IFCSURFACESTYLEWITHTEXTURES((#900002));"))
    for name, more in {"a place of 1e308": b"#900003=IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$,#900004,1.E300);\n#900004=IFCCARTESIANPOINT((1.E308,1.E308));",
                       "a place without numbers": b"#900003=IFCCARTESIANTRANSFORMATIONOPERATOR2D(#900004,$,#900005,0.);\n#900004=IFCDIRECTION((0.,0.));\n#900005=IFCCARTESIANPOINT(());"}.items():
        yield model_case("ifc", f"a picture at {name}", "m.ifc", lambda m=more: ifc_textured(b"IFCIMAGETEXTURE(.T.,.T.,$,#900003,$,'t.png');\n" + m), extra={"t.png": png(8, 8)})
    for name, corners in {"no corner": b"(1,-7,99999999)", "nothing": b"($,$,$)", "too few": b"(1)"}.items():
        yield model_case("ifc", f"a picture laid on {name}", "m.ifc", lambda c=corners: ifc_textured(
            b"IFCIMAGETEXTURE(.T.,.T.,$,$,$,'t.png');\n#900010=IFCINDEXEDTRIANGLETEXTUREMAP((#900002),#900011,#900013,(" + b",".join([c] * 1000) +
            b"));\n#900011=IFCTRIANGULATEDFACESET(#900012,$,$,(" + b",".join([b"(1,2,3)"] * 1000) + b"),$);\n#900012=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.,0.,0.),(0.,1.,0.)));\n"
            b"#900013=IFCTEXTUREVERTEXLIST(((0.,0.),(1.E400,1.)));"), extra={"t.png": png(8, 8)})


def ifc_cases():
    whole = pavilion()
    yield model_case("ifc", "a right one", "m.ifc", whole, "done")
    for share in range(0, 20):
        yield model_case("ifc", f"cut to {share} of 20", "m.ifc", whole[: len(whole) * share // 20])
    for name, pattern, replacement in (
            ("points that are no numbers", rb"IFCCARTESIANPOINT\(\([^)]*\)\)", b"IFCCARTESIANPOINT((nan,inf,1.E400))"),
            ("points at 3e38", rb"IFCCARTESIANPOINT\(\([^)]*\)\)", b"IFCCARTESIANPOINT((3.E38,-3.E38,3.E38))"),
            ("points without numbers", rb"IFCCARTESIANPOINT\(\([^)]*\)\)", b"IFCCARTESIANPOINT(())"),
            ("points of points", rb"IFCCARTESIANPOINT\(\([^)]*\)\)", b"IFCCARTESIANPOINT(((((1.)))))"),
            ("directions of length 0", rb"IFCDIRECTION\(\([^)]*\)\)", b"IFCDIRECTION((0.,0.,0.))"),
            ("entities of one number", rb"\n#\d+=", b"\n#1="),
            ("entities of huge numbers", rb"\n#(\d+)=", rb"\n#99999999999999999999\1="),
            ("entities of negative numbers", rb"\n#(\d+)=", rb"\n#-\1="),
            ("references to what is absent", rb"#(\d+)([,)])", rb"#9\g<1>999\2"),
            ("references to themselves", rb"\n#(\d+)=(\w+)\(#\d+", rb"\n#\1=\2(#\1"),
            ("references to the first", rb"#\d+([,)])", rb"#1\1"),
            ("nothing where something must be", rb"#\d+([,)])", rb"$\1"),
            ("other entities", rb"IFCEXTRUDEDAREASOLID", b"IFCPERSON"), ("no entities", rb"=IFC\w+", b"=IFCNOTHING"),
            ("text without end", rb"'\)", b")"), ("another schema", rb"IFC4", b"IFC9"),
            ("escapes without end", rb"'Pavilion|'[A-Z][a-z]+", rb"'\\X2\\D800"),
            ("names of bytes", rb"'[A-Z][a-z]+", b"'\xff\xfe\x00")):
        yield model_case("ifc", name, "m.ifc", lambda p=pattern, r=replacement: ifc_spoiled(p, r))
    for depth in (1000, 100000):
        yield model_case("ifc", f"{depth} lists in a list", "m.ifc",
                         lambda d=depth: ifc_spoiled(rb"\(\(0\.,0\.,1\.\)\)", b"(" * d + b"0." + b")" * d))
    yield model_case("ifc", "300,000 entities that are alike", "m.ifc",
                     lambda: whole.replace(b"ENDSEC;\nEND-ISO", b"".join(b"#%d=IFCDIRECTION((0.,0.,1.));\n" % (100000 + i) for i in range(300000)) + b"ENDSEC;\nEND-ISO"), seconds=120)
    boxes = rb"IFCRECTANGLEPROFILEDEF\(([^;]*)\);"
    yield model_case("ifc", "profiles of no size", "m.ifc", lambda: re.sub(boxes, b"IFCRECTANGLEPROFILEDEF(.AREA.,$,$,0.,-1.);", whole))
    for name in ("m.iv", "m.obj", "m.stp"):
        yield model_case("ifc", f"as {name}", name, whole, "refused")


INVENTOR = "#Inventor V2.1 ascii\n"
FACES = "Coordinate3 { point [ 0 0 0, 1 0 0, 0 0 1 ] }\nIndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] }\n"
SHAPE = "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 0 1 ] } coordIndex [ 0 1 2 -1 ] } }\n"


def inventor_cases():
    """Open Inventor and VRML 1 and 2."""
    heads = {"iv": (INVENTOR, FACES), "wrl": ("#VRML V1.0 ascii\n", FACES), "wrl 2": ("#VRML V2.0 utf8\n", SHAPE)}
    for kind, (head, body) in heads.items():
        name = "m." + kind.split()[0]
        right = head + body
        yield model_case("inventor", f"a right {kind}", name, right, "done")
        for size in range(0, len(right), 9):
            yield model_case("inventor", f"{kind} cut at {size}", name, right[:size])
        for index in ("99", "-7", "4294967296", "a", "0 0", "1e9", ", , ,"):
            yield model_case("inventor", f"{kind} of index {index!r}", name, right.replace("2", index).replace(f"V{index}", "V2"))
        for number in ("nan", "inf", "1e400", "3e38", "-", "0x7f"):
            yield model_case("inventor", f"{kind} of a point {number}", name, right.replace("1 0 0", f"{number} 0 0"))
        group = "Separator" if kind != "wrl 2" else "Group"
        opening, closing = (f"{group} {{ ", "} ") if kind != "wrl 2" else ("Group { children [ ", "] } ")
        for depth in (255, 300, 100000):
            yield model_case("inventor", f"{kind} nested {depth}", name, head + opening * depth + body + closing * depth)
            yield model_case("inventor", f"{kind} nested {depth} without end", name, head + opening * depth)
        for path in ("../outside/secret.png", "../outside/secret.jpg", "/etc/passwd", "link.png", "http://127.0.0.1:9/a.png", "memory.jpg.png", "a" * 5000):
            texture = f'Texture2 {{ filename "{path}" }}\n{body}' if kind != "wrl 2" else body.replace("Shape {", f'Shape {{ appearance Appearance {{ texture ImageTexture {{ url "{path}" }} }} ')
            yield model_case("inventor", f"{kind} with a picture {path[:30]}", name, head + texture)
        for path in ("../outside/secret.bin", "/dev/zero"):
            inline = {"iv": f'File {{ name "{path}" }}', "wrl": f'WWWInline {{ name "{path}" }}', "wrl 2": f'Inline {{ url "{path}" }}'}[kind]
            yield model_case("inventor", f"{kind} with a file {path}", name, right + inline + "\n")
        yield model_case("inventor", f"{kind} with a picture that claims", name,
                         head + ("Texture2 { image 32768 32768 4 0 }\n" if kind != "wrl 2" else "Shape { appearance Appearance { texture PixelTexture { image 32768 32768 4 0 } } }\n") + body)
        yield model_case("inventor", f"{kind} of bytes", name, right.encode().replace(b"point", b"p\xff\xfe\0nt"))
        yield model_case("inventor", f"{kind} of an unknown node", name, right + "Nonsense { fields [ SFFloat a ] a 1e999 }\n")
    yield model_case("inventor", "binary Inventor", "m.iv", b"#Inventor V2.1 binary\n" + b"\xff" * 400, "refused")
    yield model_case("inventor", "packed VRML", "m.wrl", b"\x1f\x8b\x08\0" + b"\xff" * 400, "refused")
    yield model_case("inventor", "VRML with a script", "m.wrl", "#VRML V2.0 utf8\n" + 'Script { url "javascript: while (true) {}" eventIn SFTime a }\n' + SHAPE)
    yield model_case("inventor", "an elevation of 10^10 heights", "m.wrl",
                     "#VRML V2.0 utf8\nShape { geometry ElevationGrid { xDimension 100000 zDimension 100000 height [ 0 ] } }\n")
    yield model_case("inventor", "a cone of complexity 1e9", "m.iv", INVENTOR + "Complexity { value 1e9 }\nSphere { radius 1e30 }\n")


REFUSED = ["lws", "x3d", "x3db", "irr", "irrmesh", "assbin", "assxml", "smd", "md2", "md3", "md5mesh", "mdl", "bvh", "ase", "blend",
           "b3d", "cob", "csm", "dxf", "enff", "hmp", "lxo", "ms3d", "ndo", "nff", "pk3", "q3o", "raw", "sib", "ter", "vrml", "zgl", "xgl",
           "mesh.xml", "ogex", "step", "stp", "amf", "m3d", "iqm", "pmx", "q3s", "scn", "", "obj ", "gltf2", "sh", "so"]


def cases():
    yield from ifc_cases()
    yield from ifc_picture_cases()
    yield from inventor_cases()
    yield model_case("mesh", "a right binary PLY", "m.ply", ply_binary(), "done")
    for face in ("255 0 1 2", "3 0 1", "3 0 0 0", "4 0 1 2 9"):
        yield model_case("mesh", f"PLY face {face}", "m.ply", ply_text(face))
    for vertices, faces in ((2**31, 1), (2**32 - 1, 2**32 - 1), (3, 2**31), (10**18, 1), (-1, 1)):
        yield model_case("mesh", f"PLY of {vertices} vertices, {faces} faces", "m.ply", ply_text("3 0 1 2", vertices, faces), seconds=90)
    for line in ("f 1 2 -9", "f 1 2 99", "f 0 0 0", "f 1 2 4294967297", "f -1 -2 -3", "f 1//9 2//9 3//9", "f " + "1 " * 20000, "l 1 2", "p 1",
                 "v nan nan nan", "v 1e39 0 0", "v 3e38 3e38 3e38\nf 1 2 4", "o " + "n" * 200000, "g \xe9\xff", "usemtl nothing"):
        yield model_case("mesh", f"OBJ {line[:24]!r}", "m.obj", OBJ.encode() + line.encode("latin-1") + b"\n", extra={"m.mtl": "newmtl m\nKd 1 0 0\n"})
    for mtl in ("map_Kd\n", "newmtl m\nmap_Kd ../outside/secret.png\n", "newmtl m\nmap_Kd /etc/passwd\n",
                "newmtl m\nmap_Kd link.png\n", "newmtl m\nmap_Kd link.jpg\n", "newmtl m\nmap_Kd ../outside/secret.jpg\n", "newmtl m\nmap_Kd pipe\n", "newmtl m\nKd nan nan nan\nd nan\nNs -1\n", "newmtl m\nNs inf\n",
                "newmtl " + "m" * 100000 + "\n", "newmtl m\nmap_Kd " + "a/" * 5000 + "\n"):
        yield model_case("mesh", f"MTL {mtl[:30]!r}", "m.obj", OBJ, extra={"m.mtl": mtl})
    for library in ("../outside/secret.mtl", "link.mtl", "/etc/passwd", "pipe", "..\\outside\\secret.mtl", ".", "/dev/zero"):
        yield model_case("mesh", f"mtllib {library}", "m.obj", OBJ.replace("m.mtl", library).replace("usemtl m", "usemtl SECRETMATERIAL"))
    yield model_case("mesh", "DAE nested 2000", "m.dae", lambda: dae(scene_of("<node>" * 2000 + INSTANCE + "</node>" * 2000)))
    doubling = "".join(f'<node id="n{i}"><instance_node url="#n{i+1}"/><instance_node url="#n{i+1}"/></node>' for i in range(40))
    yield model_case("mesh", "DAE that doubles 40 times", "m.dae",
                     dae(f'<library_nodes>{doubling}<node id="n40">{INSTANCE}</node></library_nodes>' + scene_of('<node><instance_node url="#n0"/></node>')), seconds=120)
    yield model_case("mesh", "DAE with a DOCTYPE", "m.dae", '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY e SYSTEM "../outside/secret.mtl">]>' + dae(scene_of("<node>&e;" + INSTANCE + "</node>"))[21:])
    for size in (18, 23, 27, 60):
        yield model_case("mesh", f"binary FBX cut at {size}", "m.fbx", (b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400) + b"\xff" * 200)[:size])
    for content in ("OFF\n1 1 0\n0 0 0\n3 0 1 2\n", "OFF\n4294967295 1 0\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 -7\n", "OFF\n", "OFF\n3 4294967295 0\n",
                    "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n99999999 0 1 2\n"):
        yield model_case("mesh", f"OFF {content[:30]!r}", "m.off", content, seconds=90)
    for count in (0, 1, 2**31, 2**32 - 1):
        yield model_case("mesh", f"STL of {count}", "m.stl", b"\0" * 80 + struct.pack("<I", count) + b"\0" * 50)
    yield model_case("mesh", "3MF zip bomb", "m.3mf", lambda: zip_bomb(2_000_000_000), seconds=120)
    yield model_case("mesh", "3MF of nothing", "m.3mf", lambda: zip_bomb(1))
    for content in (b"MM" + b"\xff" * 60, b"MM\x10\0\0\0=='\xff\xff\xff", b"MM\0\0\0\0"):
        yield model_case("mesh", f"3DS {content[:8]}", "m.3ds", content)
    for content in (b"FORM\xff\xff\xff\xffLWO2", b"FORM\0\0\0\x08LWO2LAYR", b"FORM"):
        yield model_case("mesh", f"LWO {content[:12]}", "m.lwo", content)
    for content in ("AC3Db\nOBJECT world\nkids 1\nOBJECT poly\nnumvert 4294967295\n", "AC3Db\nOBJECT poly\nnumvert 1\n0 0 0\nnumsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n9 0 0\n-1 0 0\nkids 0\n"):
        yield model_case("mesh", f"AC3D {content[:40]!r}", "m.ac", content)
    for extension in REFUSED:
        yield model_case("format", f".{extension} is on no list", f"m.{extension}" if extension else "m", OBJ, "refused")
    lws = "LWSC\n3\nLoadObjectLayer 1 ../outside/secret.lwo\nAddNullObject a\n"
    for name in ("m.lws", "m.LWS", "m.obj", "m.lwo"):
        yield model_case("format", f"LWS as {name}", name, lws, "refused")
    x3d = '<X3D><Scene><Inline url="../outside/secret.x3d"/></Scene></X3D>'
    for name in ("m.x3d", "m.X3D", "m.obj", "m.dae"):
        yield model_case("format", f"X3D as {name}", name, x3d, "refused")
    for name, content in (("m.obj", b"\x7fELF\0\0\0"), ("m.ply", OBJ), ("m.gltf", OBJ), ("m.glb", b"PK\x03\x04"), ("m.json", "[1]"), ("m.gml", "{}"),
                          ("m.osm", "{}"), ("m.tif", b"\x89PNG"), ("m.fbx", b"PK"), ("m.3ds", b"ply"), ("m.stl", b"x"), ("m.dae", "{}"), ("m.3mf", b"Rar!")):
        yield model_case("format", f"another content as {name}", name, content, "refused")
    for name in ("m.OBJ", "m.Obj"):
        yield model_case("format", f"{name} is OBJ", name, OBJ, "done", extra={"m.mtl": "newmtl m\n"})
    for target, kind in (("pipe", "a pipe"), ("folder", "a folder"), ("zero", "an endless device"), ("sparse", "20 GB of nothing"), ("absent", "nothing"),
                         ("loop", "a link to itself")):
        for extension in ("obj", "gltf", "glb", "json", "gml", "osm", "tif", "ply"):
            yield special(target, kind, extension)
    for target in ("pipe", "folder", "zero", "sparse", "absent", "loop"):
        yield special_script(target)


def make_special(folder, target, name):
    import os
    path = os.path.join(folder, name)
    if target == "pipe":
        os.mkfifo(path)
    elif target == "folder":
        os.mkdir(path)
    elif target == "zero":
        os.symlink("/dev/zero", path)
    elif target == "loop":
        os.symlink(name, path)
    elif target == "sparse":
        with open(path, "wb") as file:
            file.truncate(20_000_000_000)


def special(target, kind, extension):
    def build(folder):
        make_special(folder, target, f"m.{extension}")
        return [["export", scene(folder, f'model(file="m.{extension}")\n' + CAMERA), "-o", "out.glb"]]

    return Case("file", f"{kind} as .{extension}", build, "refused", seconds=20)


def special_script(target):
    def build(folder):
        make_special(folder, target, "s.xp")
        include = scene(folder, 'include(file="s.xp")\n', "outer.xp")
        return [["check", "s.xp"], ["format", "s.xp"], ["check", include]]

    return Case("file", f"{target} as a script", build, "refused", seconds=20)
