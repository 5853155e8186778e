"""glTF that claims what it does not hold."""

import base64
import copy
import json
import struct

from .case import model_case
from .secret_picture import JPEG, PNG

BIG = 2**64


def triangle():
    """A document of one triangle and the bytes of its buffer."""
    data = struct.pack("<9f", 0, 0, 0, 4, 0, 0, 0, 0, 4) + struct.pack("<3I", 0, 1, 2)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "sail"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
        "buffers": [{"byteLength": len(data)}],
    }
    return document, data


def text(document, data):
    document["buffers"][0].setdefault("uri", "data:;base64," + base64.b64encode(data).decode())
    return json.dumps(document)


def glb(document, data):
    chunk = json.dumps(document).encode()
    chunk += b" " * (-len(chunk) % 4)
    chunks = struct.pack("<II", len(chunk), 0x4E4F534A) + chunk + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def spoiled(path, value):
    """The triangle with one value replaced: path ("accessors", 0, "count")."""
    document, data = triangle()
    at = document
    for step in path[:-1]:
        at = at[step] if isinstance(at, list) else at.setdefault(step, {})
    at[path[-1]] = value
    return text(document, data)


NUMBERS = [-1, 2**31, 2**32, 2**32 + 1, 2**62, 2**63, BIG - 1, BIG - 3600, BIG - 36, BIG - 12, BIG, 1e30, 0.5, "3", None, [], True]
PATHS = [("accessors", 0, "count"), ("accessors", 0, "byteOffset"), ("accessors", 1, "count"), ("accessors", 0, "bufferView"),
         ("accessors", 0, "componentType"), ("bufferViews", 0, "byteOffset"), ("bufferViews", 0, "byteLength"),
         ("bufferViews", 0, "byteStride"), ("bufferViews", 0, "buffer"), ("buffers", 0, "byteLength"),
         ("meshes", 0, "primitives"), ("nodes", 0, "mesh"), ("scene",), ("nodes", 0, "children")]


def sparse(count, index_offset, value_offset):
    document, data = triangle()
    document["accessors"][0]["sparse"] = {
        "count": count, "indices": {"bufferView": 1, "byteOffset": index_offset, "componentType": 5125},
        "values": {"bufferView": 0, "byteOffset": value_offset}}
    return text(document, data)


def zeros(count):
    """Accessors without a view: all zeros, of a few bytes of file."""
    document, data = triangle()
    for accessor in document["accessors"]:
        accessor["count"] = count
        accessor.pop("bufferView")
    document["meshes"][0]["primitives"] *= 40
    return text(document, data)


def instances(nodes, triangles):
    """One mesh on many nodes."""
    document, data = triangle()
    data = data[:36] + struct.pack("<3I", 0, 1, 2) * triangles
    document["accessors"][1]["count"] = 3 * triangles
    document["bufferViews"][1]["byteLength"] = 12 * triangles
    document["buffers"][0]["byteLength"] = len(data)
    document["nodes"] = [{"mesh": 0} for _ in range(nodes)]
    document["scenes"][0]["nodes"] = list(range(nodes))
    return glb(document, data)


def deep_nodes(depth):
    document, data = triangle()
    document["nodes"] = [{"children": [i + 1]} for i in range(depth)] + [{"mesh": 0}]
    return text(document, data)


DEEP_PLACES = ["asset", "scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers", "materials", "textures", "images",
               "samplers", "skins", "animations", "cameras", "extensions", "extras", "extensionsRequired", "extensionsUsed", "scene"]


def deep(place, depth, brackets="[]"):
    document, data = triangle()
    document[place] = "DEEP"
    opening = brackets[0] + ('"a":' if brackets == "{}" else "")
    return text(document, data).replace('"DEEP"', opening * depth + (brackets[0] + brackets[1]) + brackets[1] * depth) \
        if "buffers" != place else '{"asset":{"version":"2.0"},"buffers":' + opening * depth + "0" + brackets[1] * depth + "}"


def with_image(uri=None, data=None, mime="image/png"):
    document, buffer = triangle()
    image = {"uri": uri} if uri else {"uri": f"data:{mime};base64," + base64.b64encode(data).decode()}
    document["images"], document["textures"] = [image], [{"source": 0}]
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    return text(document, buffer)


def meshopt(**changes):
    document, data = triangle()
    packing = {"buffer": 0, "byteOffset": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES", **changes}
    document["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": packing}
    document["extensionsRequired"] = document["extensionsUsed"] = ["EXT_meshopt_compression"]
    return text(document, data)


def vertices(value):
    document, data = triangle()
    return text(document, struct.pack("<3f", value, value, value) + data[12:])


def cases():
    for path in PATHS:
        for value in NUMBERS:
            yield model_case("glTF", f"{path} = {value}", "m.gltf", lambda p=path, v=value: spoiled(p, v))
    for count, index_offset, value_offset in [(1, BIG - 3600, 0), (1, 0, BIG - 3600), (3, BIG - 12, BIG - 36), (BIG - 1, 0, 0),
                                              (2**62, 0, 0), (3, BIG - 4, 0), (1, 12, 0), (2**63, 2**63, 2**63), (3, 0, BIG - 8)]:
        yield model_case("glTF", f"sparse {count} {index_offset} {value_offset}", "m.gltf",
                         lambda c=count, i=index_offset, v=value_offset: sparse(c, i, v), "refused")
    for place in DEEP_PLACES:
        yield model_case("glTF", f"80,000 lists in {place}", "m.gltf", lambda p=place: deep(p, 80000), "refused")
        yield model_case("glTF", f"80,000 objects in {place}", "m.gltf", lambda p=place: deep(p, 80000, "{}"), "refused")
    yield model_case("glTF", "accessors of zeros", "m.gltf", lambda: zeros(19_000_000), "refused")
    yield model_case("glTF", "one mesh on 20,000 nodes", "m.glb", lambda: instances(20000, 20000))
    yield model_case("glTF", "deep nodes", "m.gltf", lambda: deep_nodes(100_000))
    for value in (3e38, -3e38, 1e30, 1e20, 1e15, float("inf"), float("nan")):
        yield model_case("glTF", f"vertices at {value}", "m.gltf", lambda v=value: vertices(v), "refused")
    for uri in ("../outside/secret.png", "/etc/passwd", "file:///etc/passwd", "http://127.0.0.1:9/a.png", "%2e%2e/outside/secret.png",
                "..\\outside\\secret.png", "x.null?RES=32768x32768", "t.avi", "concat:secret.png", "link.png", "pipe", "."):
        yield model_case("glTF", f"picture {uri}", "m.gltf", lambda u=uri: with_image(u))
    for data in (b"", b"GIF89a", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff\xe0" + b"\0" * 40, b"#EXTM3U\nsecret.png", b"ffconcat version 1.0\nfile secret.png\n"):
        yield model_case("glTF", f"embedded picture {data[:8]}", "m.gltf", lambda d=data: with_image(data=d),
                         extra={"memory.jpg": JPEG, "memory.png": PNG, "t.avi": b"ffconcat version 1.0\nfile ../outside/secret.png\n"})
    for name, content in (("buffer", "../outside/secret.bin"), ("buffer", "/dev/zero"), ("buffer", "pipe"), ("buffer", "link.bin"),
                          ("buffer", "%2E%2E/outside/secret.bin")):
        document, data = triangle()
        document["buffers"][0]["uri"] = content
        yield model_case("glTF", f"{name} {content}", "m.gltf", json.dumps(copy.deepcopy(document)), "refused")
    for changes in ({"count": 2**31}, {"count": 2**60}, {"byteStride": 256, "count": 20_000_000}, {"byteStride": 0}, {"mode": "INDICES"},
                    {"byteLength": BIG - 1}, {"byteOffset": BIG - 8}, {"count": -1}, {"mode": "TRIANGLES", "count": 4, "byteStride": 4},
                    {"filter": "QUATERNION"}, {"count": 15_000_000, "byteStride": 252}):
        yield model_case("glTF", f"meshopt {changes}", "m.gltf", lambda c=changes: meshopt(**c), "refused")
    whole = glb(*triangle())
    for size in range(0, len(whole), 31):
        yield model_case("glTF", f".glb cut at {size}", "m.glb", whole[:size], "refused")
    for at in range(0, 12):
        yield model_case("glTF", f".glb head byte {at}", "m.glb", whole[:at] + b"\xff" + whole[at + 1:])
    for name in ("m.GLTF", "m.GlTf", "m.GLB"):
        document, data = triangle()
        document["buffers"][0]["uri"] = "../outside/secret.bin"
        yield model_case("glTF", f"{name} with a buffer outside", name, json.dumps(document), "refused")
    document, data = triangle()
    document["nodes"][0]["name"] = "caf\udce9"
    yield model_case("glTF", "a lone surrogate as a name", "m.gltf", text(document, data))
    yield model_case("glTF", "a name of bytes that are no UTF-8", "m.gltf",
                     text(*triangle()).encode().replace(b"sail", b"sa\xe9l"))
