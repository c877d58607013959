#!/usr/bin/env python3
"""Generates the glTF files of ../gltf, ../gltf_broken and ../gltf_fuzz, with the same bytes each time.

    testdata/gltf/make.py

Needs only Python 3 and, for the packed file, Debian's libmeshoptimizer2d. The numbers are chosen so that the expected
results can be found by hand: quarter and half turns, halves and quarters of metres. The expected messages of broken files
are written by hand, not generated.
"""
import base64
import ctypes
import json
import math
import pathlib
import struct

GOOD = pathlib.Path(__file__).resolve().parent
BROKEN = GOOD.parent / "gltf_broken"
FUZZ = GOOD.parent / "gltf_fuzz"

FLOAT, BYTE, UBYTE, SHORT, USHORT, UINT = 5126, 5120, 5121, 5122, 5123, 5125
LETTER = {FLOAT: "f", BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I"}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
X90 = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
Y90 = [0, math.sqrt(0.5), 0, math.sqrt(0.5)]
Z90 = [0, 0, math.sqrt(0.5), math.sqrt(0.5)]
NONE = [0, 0, 0, 1]


def z_turn(degrees):
    half = math.radians(degrees) / 2
    return [0, 0, math.sin(half), math.cos(half)]


class File:
    """A glTF file that is put together; its numbers lie in one buffer."""

    def __init__(self, nodes, roots=None):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0", "generator": "testdata/gltf/make.py"}, "nodes": nodes, "accessors": [],
                     "bufferViews": [], "buffers": [{"byteLength": 0}]}
        if roots is not None:
            self.json["scenes"] = [{"nodes": roots}]
            self.json["scene"] = 0

    def view(self, data, **more):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data), **more})
        self.bytes += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, kind, component=FLOAT, **more):
        flat = [number for row in rows for number in (row if isinstance(row, (list, tuple)) else [row])]
        view = self.view(struct.pack("<%d%s" % (len(flat), LETTER[component]), *flat))
        self.json["accessors"].append({"bufferView": view, "componentType": component,
                                       "count": len(flat) // WIDTH[kind], "type": kind, **more})
        return len(self.json["accessors"]) - 1

    def animation(self, name=None):
        self.json.setdefault("animations", []).append({"channels": [], "samplers": []})
        if name:
            self.json["animations"][-1]["name"] = name

    def channel(self, node, path, times, keys, interpolation=None, component=FLOAT):
        """times: a list of seconds, or the number of an accessor; keys likewise."""
        if "animations" not in self.json:
            self.animation("take")
        animation = self.json["animations"][-1]
        kind = {"rotation": "VEC4", "weights": "SCALAR"}.get(path, "VEC3")
        if isinstance(times, list):
            times = self.accessor(times, "SCALAR", min=[min(times)], max=[max(times)])
        if isinstance(keys, list):
            more = {} if component == FLOAT else {"normalized": True}
            keys = self.accessor(keys, kind, component, **more)
        sampler = {"input": times, "output": keys}
        if interpolation:
            sampler["interpolation"] = interpolation
        animation["channels"].append({"sampler": len(animation["samplers"]), "target": {"node": node, "path": path}})
        animation["samplers"].append(sampler)
        return times

    def mesh(self, targets=0, names=None, name=None, skin=None):
        """A triangle on a node of its own; the node's number."""
        corners = self.accessor([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "VEC3", min=[0, 0, 0], max=[1, 1, 0])
        primitive = {"attributes": {"POSITION": corners}}
        if skin is not None:
            primitive["attributes"]["JOINTS_0"] = self.accessor([[0, 0, 0, 0]] * 3, "VEC4", UBYTE)
            primitive["attributes"]["WEIGHTS_0"] = self.accessor([[1, 0, 0, 0]] * 3, "VEC4")
        if targets:
            primitive["targets"] = [{"POSITION": corners} for _ in range(targets)]
        mesh = {"primitives": [primitive]}
        if name:
            mesh["name"] = name
        if names:
            mesh["extras"] = {"targetNames": names}
        self.json.setdefault("meshes", []).append(mesh)
        node = {"mesh": len(self.json["meshes"]) - 1}
        if skin is not None:
            node["skin"] = skin
        self.json["nodes"].append(node)
        if "scenes" in self.json:
            self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def skin(self, joints, matrices=None):
        skin = {"joints": joints}
        if matrices:
            skin["inverseBindMatrices"] = self.accessor(matrices, "MAT4")
        self.json.setdefault("skins", []).append(skin)
        self.mesh(skin=len(self.json["skins"]) - 1)

    def finished(self):
        if self.bytes:
            self.json["buffers"][0]["byteLength"] = len(self.bytes)
        else:
            for name in ("buffers", "bufferViews", "accessors"):
                del self.json[name]
        return json.dumps(self.json, separators=(",", ":"))

    def glb(self):
        text = self.finished().encode()
        return glb_of(text, self.bytes)

    def gltf(self, uri=None):
        self.json["buffers"][0]["uri"] = uri or ("data:application/octet-stream;base64," +
                                                 base64.b64encode(self.bytes).decode())
        return json.dumps(json.loads(self.finished()), indent=1).encode() + b"\n"


def glb_of(text, data):
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    if data:
        chunks += struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def away(x, y, z):
    """The inverse of a joint's bind matrix that stands there, columns first."""
    return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1]


def arm():
    """Hips a metre up, an arm of two bones of half a metre along x, and an end that is no joint of the skin."""
    file = File([{"name": "Hips", "translation": [0, 1, 0], "children": [1]},
                 {"name": "Someone:LeftArm", "translation": [0.5, 0, 0], "children": [2]},
                 {"name": "Someone:LeftHand", "translation": [0.5, 0, 0], "children": [3]},
                 {"name": "End", "translation": [0.25, 0, 0]}], [0])
    file.skin([0, 1, 2], [away(0, 1, 0), away(0.5, 1, 0), away(1, 1, 0)])
    return file


def thirtieths(count):
    return [i / 30 for i in range(count)]


def linear():
    file = arm()
    times = file.channel(0, "translation", thirtieths(5), [[0, 1 + i / 4, 0] for i in range(5)])
    file.channel(1, "rotation", times, [z_turn(22.5 * i) for i in range(5)])
    return file


def step():
    file = arm()
    file.channel(1, "rotation", [0, 0.5, 1], [NONE, Z90, NONE], "STEP")
    file.channel(2, "rotation", thirtieths(31), [z_turn(i) for i in range(31)])
    return file


def cubic():
    file = arm()
    # Along x: from 0.5 to 1 in two seconds, leaving at 1 m/s: halfway 0.75 + 2/8·1 = 1; then it stands.
    file.channel(1, "translation", [0, 2, 3], [[0, 0, 0], [0.5, 0, 0], [1, 0, 0],
                                               [0, 0, 0], [1, 0, 0], [0, 0, 0],
                                               [0, 0, 0], [1, 0, 0], [0, 0, 0]], "CUBICSPLINE")
    file.channel(2, "rotation", [0, 2], [[0] * 4, NONE, [0] * 4, [0] * 4, Z90, [0] * 4], "CUBICSPLINE")
    return file


def uneven():
    file = arm()
    file.channel(1, "rotation", [0.1, 0.137, 0.3171, 0.4], [NONE, z_turn(30), z_turn(60), z_turn(90)])
    file.channel(1, "translation", [0.1, 0.2, 0.3333, 0.4], [[0.5, 0, 0], [0.6, 0, 0], [0.7, 0, 0], [0.8, 0, 0]])
    return file


def two_takes():
    file = arm()
    file.json["animations"] = []
    for name, degrees in (("rest", 0), ("wave", 90), (None, 45)):
        file.animation(name)
        file.channel(1, "rotation", [0, 1 / 25, 2 / 25], [NONE, z_turn(degrees / 2), z_turn(degrees)])
    file.json["nodes"].append({"name": "Sun", "extensions": {"KHR_lights_punctual": {"light": 0}}})
    file.json["extensionsUsed"] = ["KHR_lights_punctual"]
    file.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}}
    file.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
    file.json["nodes"].append({"name": "Camera", "camera": 0})
    file.json["scenes"].append({"nodes": [5, 6]})
    file.channel(6, "translation", [0, 1 / 25], [[0, 0, 0], [1, 0, 0]])
    return file


def armature():
    """As many exporters leave it: centimetres and Z up below, a helper above that mends both. One node is a matrix."""
    file = File([{"name": "Armature", "rotation": [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)], "scale": [0.01, 0.01, 0.01],
                  "children": [1]},
                 {"name": "Hips", "translation": [0, 0, 100], "children": [2]},
                 {"name": "Spine", "matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 20, 1], "children": [3]},
                 {"name": "Head", "translation": [0, 0, 15]}], [0])
    file.skin([1, 2, 3])
    file.channel(0, "scale", [0], [[0.01, 0.01, 0.01]])
    file.channel(1, "translation", [0, 1 / 24, 2 / 24], [[0, 0, 100], [0, 0, 110], [0, 0, 120]])
    file.channel(3, "rotation", [0, 1 / 24], [NONE, Z90])
    return file


def morph():
    file = arm()
    named = file.mesh(2, ["jawOpen", "eyeBlinkLeft"], "face")
    plain = file.mesh(1, None, "teeth")
    again = file.mesh(2, ["jawOpen", "eyeBlinkLeft"], "brows")
    times = file.channel(named, "weights", [0, 0.1, 0.2], [0, 1, 0.5, 0.5, 1, 0])
    file.channel(plain, "weights", times, [0, 51, 255], component=UBYTE)
    file.channel(again, "weights", times, [0, 0.25, 0.5, 0.25, 1, 0.25])
    return file


def quantised():
    file = arm()
    root = round(32767 * math.sqrt(0.5))
    times = file.channel(1, "rotation", [0, 1 / 60, 2 / 60], [[0, 0, 0, 32767], [0, 0, root, root], [0, 0, -32768, 32767]],
                         component=SHORT)
    file.channel(2, "rotation", times, [[0, 0, 0, 127], [0, 90, 0, 90], [0, 127, 0, 0]], component=BYTE)
    file.json["extensionsUsed"] = ["KHR_mesh_quantization", "KHR_draco_mesh_compression"]
    file.json["extensionsRequired"] = ["KHR_mesh_quantization", "KHR_draco_mesh_compression"]
    return file


def sparse():
    """Times and turns between each other in one view; the translation all zero but for one key."""
    file = arm()
    rows = [(0.0, NONE), (0.02, Z90), (0.04, [0, 0, 1, 0])]
    data = b"".join(struct.pack("<5f", time, *turn) for time, turn in rows)
    view = file.view(data, byteStride=20)
    first = len(file.json["accessors"])
    file.json["accessors"] += [
        {"bufferView": view, "componentType": FLOAT, "count": 3, "type": "SCALAR", "min": [0], "max": [0.04]},
        {"bufferView": view, "byteOffset": 4, "componentType": FLOAT, "count": 3, "type": "VEC4"},
        {"componentType": FLOAT, "count": 3, "type": "VEC3",
         "sparse": {"count": 1, "indices": {"bufferView": file.view(struct.pack("<H", 1)), "componentType": USHORT},
                    "values": {"bufferView": file.view(struct.pack("<3f", 0, 0.25, 0))}}}]
    file.channel(1, "rotation", first, first + 1)
    file.channel(1, "translation", first, first + 2)
    return file


def packed(data, count, stride):
    library = ctypes.CDLL("libmeshoptimizer.so.2d")
    size = library.meshopt_encodeVertexBufferBound
    size.restype = ctypes.c_size_t
    encode = library.meshopt_encodeVertexBuffer
    encode.restype = ctypes.c_size_t
    most = size(ctypes.c_size_t(count), ctypes.c_size_t(stride))
    out = ctypes.create_string_buffer(most)
    used = encode(out, ctypes.c_size_t(most), data, ctypes.c_size_t(count), ctypes.c_size_t(stride))
    assert used > 0
    return out.raw[:used]


def meshopt():
    """Every view of the animation is packed, its turns through the filter for quaternions."""
    file = arm()
    count = 9
    # The filter's own coding, by hand: the largest part last, the others of 16 bits over the square root of 2.
    rows = []
    for i in range(count):
        z, w = z_turn(10 * i)[2:]
        code = round(z * math.sqrt(2) * 32767)
        rows.append(struct.pack("<4h", 0, 0, code, (32767 & ~3) | 3))
    times = struct.pack("<%df" % count, *[i / 50 for i in range(count)])
    file.json["buffers"].append({"byteLength": 0, "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
    fallback = 0
    for data, stride, filter in ((times, 4, "NONE"), (b"".join(rows), 8, "QUATERNION")):
        view = file.view(packed(data, count, stride))
        there = file.json["bufferViews"][view]
        file.json["bufferViews"][view] = {
            "buffer": 1, "byteOffset": fallback, "byteLength": count * stride,
            "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteOffset": there["byteOffset"],
                                                       "byteLength": there["byteLength"], "byteStride": stride,
                                                       "count": count, "mode": "ATTRIBUTES", "filter": filter}}}
        fallback += count * stride
    file.json["buffers"][1]["byteLength"] = fallback
    views = len(file.json["bufferViews"])
    first = len(file.json["accessors"])
    file.json["accessors"] += [
        {"bufferView": views - 2, "componentType": FLOAT, "count": count, "type": "SCALAR", "min": [0], "max": [0.16]},
        {"bufferView": views - 1, "componentType": SHORT, "count": count, "type": "VEC4", "normalized": True}]
    file.channel(1, "rotation", first, first + 1)
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = ["EXT_meshopt_compression"]
    return file


def two_skins():
    """Clothes share joints with the body and have one of their own; a second person has fewer."""
    file = arm()
    file.json["nodes"][2]["children"].append(len(file.json["nodes"]))
    file.json["nodes"].append({"name": "Sleeve", "translation": [0, -0.25, 0]})
    file.skin([1, 2, len(file.json["nodes"]) - 1])
    file.json["nodes"] += [{"name": "Child", "children": [len(file.json["nodes"]) + 1]}, {"name": "Child's hand"}]
    child = len(file.json["nodes"]) - 2
    file.json["scenes"][0]["nodes"].append(child)
    file.skin([child, child + 1])
    file.channel(1, "rotation", [0, 0.04], [NONE, Z90])
    return file


def bare():
    """No skin: a tree under a node that stands still."""
    file = File([{"name": "Scene", "translation": [0, 0, 2], "children": [1, 5]},
                 {"name": "Root", "children": [4, 2]},
                 {"name": "Arm", "translation": [0.5, 0, 0], "children": [3]},
                 {"name": "Hand", "translation": [0.25, 0, 0]},
                 {"name": "Camera", "camera": 0},
                 {"name": "Table", "translation": [9, 0, 0]}], [0])
    file.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
    file.channel(1, "translation", [0, 0.1], [[0, 0, 0], [0, 0.5, 0]])
    file.channel(2, "rotation", [0, 0.1], [NONE, Y90])
    return file


def bent_bind():
    file = arm()
    matrices = [away(0, 1, 0), [0] * 16, away(1, 1, 0)]
    file.json["skins"][0]["inverseBindMatrices"] = file.accessor(matrices, "MAT4")
    file.json["skins"].append({"joints": [0, 1], "inverseBindMatrices": file.accessor(
        [away(0, 1, 0), [0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, -1, 0.75, 0, 1]], "MAT4")})
    file.channel(1, "rotation", [0, 0.1], [NONE, Z90])
    return file


def squashed():
    """A scale of other numbers on each axis above joints that do not turn it: exact, and told."""
    file = arm()
    del file.json["skins"][0]["inverseBindMatrices"]
    file.json["nodes"][0]["scale"] = [2, 1, 1]
    file.json["nodes"][1]["rotation"] = Z90
    file.json["nodes"][1]["scale"] = [1, 0.5, 1]
    file.channel(0, "translation", [0, 0.1], [[0, 1, 0], [0, 2, 0]])
    file.channel(2, "rotation", [0, 0.1], [NONE, Z90])
    return file


def growing():
    """A root whose scale changes, above all other joints: baked into where they are, and told."""
    file = simple()
    file.json["nodes"][1]["children"] = [2]
    file.json["nodes"].append({"name": "Finger", "translation": [0.5, 0, 0]})
    file.channel(0, "scale", [0, 0.1], [[1, 1, 1], [2, 2, 2]])
    file.channel(2, "translation", [0, 0.1], [[0.5, 0, 0], [1, 0, 0]])
    return file


def tracks():
    file = linear()
    file.json["animations"][0]["extras"] = {
        "tracks": [{"name": "gaze", "rate": 30, "values": [0, 0.25, 0.5, 0.75, 1]},
                   {"name": "slow", "rate": 15, "values": [0, 1, 3]}, {"name": "no numbers", "values": "none"}],
        "deep": [[[[[["passed over"]]]]]]}
    return file


def good_files():
    write = lambda name, data: (GOOD / name).write_bytes(data)
    for make in (linear, cubic, uneven, armature, morph, quantised, sparse, meshopt, two_skins, bent_bind, squashed,
                 growing, tracks):
        write(make.__name__ + ".glb", make().glb())
    outside = step()
    write("step.gltf", outside.gltf("step%20keys.bin"))
    write("step keys.bin", outside.bytes)
    write("two_takes.gltf", two_takes().gltf())
    write("bare.gltf", bare().gltf())


def simple():
    """What the broken files are made of: a root and a hand, two keys."""
    file = File([{"name": "Root", "children": [1]}, {"name": "Hand", "translation": [0, 1, 0]}], [0])
    file.channel(0, "rotation", [0, 0.1], [NONE, Z90])
    return file


def changed(change):
    file = simple()
    change(file.json, file)
    return file.glb()


def set_at(*path_and_value):
    *path, last, value = path_and_value

    def change(document, _):
        at = document
        for key in path:
            at = at[key]
        at[last] = value
    return change


def keys(node, path, times, rows, interpolation=None, component=FLOAT):
    return lambda _, file: file.channel(node, path, times, rows, interpolation, component)


def without_byte(data, at):
    return data[:at] + data[at + 1:]


def broken_files():
    whole = simple().glb()
    text = simple().gltf()
    inf, nan = float("inf"), float("nan")

    def scaled(scale, turn=None):
        def change(document, file):
            document["nodes"][0]["scale"] = scale
            if turn:
                file.channel(1, "rotation", [0, 0.1], [NONE, turn])
        return change

    def one_grows(document, file):
        document["nodes"][0]["children"] = [1, 3]
        document["nodes"][1]["children"] = [2]
        document["nodes"] += [{"name": "Finger", "translation": [0, 1, 0]}, {"name": "Other", "translation": [1, 0, 0]}]
        file.channel(1, "scale", [0, 0.1], [[1, 1, 1], [2, 2, 2]])

    def many_weights(document, file):
        node = file.mesh(2)
        file.channel(node, "weights", [0, 0.1], [0, 0, 1])

    def endless(document, file):
        file.json["animations"] = []
        file.animation("long")
        file.channel(0, "rotation", [0, 86000], [NONE, Z90])
        document["nodes"] += [{"name": "bone %d" % i, "children": [i + 3]} for i in range(2000)]
        document["nodes"].append({"name": "last"})
        document["nodes"][1]["children"] = [2]

    def packed_wrong(document, file):
        data = packed(struct.pack("<8f", *NONE, *NONE), 2, 16)
        view = file.view(data[:-3] + b"\xff\xff\xff")
        document["bufferViews"][view]["extensions"] = {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": document["bufferViews"][view]["byteOffset"], "byteLength": 7, "byteStride": 16,
            "count": 2, "mode": "ATTRIBUTES"}}
        document["accessors"][1] = {"bufferView": view, "componentType": FLOAT, "count": 2, "type": "VEC4"}

    def packed_as(**more):
        def change(document, file):
            document["bufferViews"][1]["extensions"] = {"EXT_meshopt_compression": {
                "buffer": 0, "byteLength": 8, "byteStride": 16, "count": 2, "mode": "ATTRIBUTES", **more}}
        return change

    def sparse_of(index, count=1):
        def change(document, file):
            document["accessors"][1]["sparse"] = {
                "count": count,
                "indices": {"bufferView": file.view(struct.pack("<H", index)), "componentType": USHORT},
                "values": {"bufferView": file.view(struct.pack("<4f", *NONE))}}
        return change

    def skinned_without_numbers(document, file):
        file.skin([0, 1], [away(0, 0, 0), away(0, 0, 0)])
        document["accessors"][document["skins"][0]["inverseBindMatrices"]]["count"] = 3

    files = {
        "accessor_count_huge": changed(set_at("accessors", 1, "count", 2 ** 52)),
        "accessor_count_negative": changed(set_at("accessors", 1, "count", -1)),
        "accessor_component_unknown": changed(set_at("accessors", 1, "componentType", 5130)),
        "accessor_past_view": changed(set_at("accessors", 1, "byteOffset", 4)),
        "accessor_type_unknown": changed(set_at("accessors", 1, "type", "VEC5")),
        "accessor_type_wrong": changed(set_at("accessors", 1, "type", "VEC3")),
        "accessor_view_missing": changed(set_at("accessors", 1, "bufferView", 2)),
        "accessor_view_text": changed(set_at("accessors", 1, "bufferView", "1")),
        "animation_none": changed(set_at("animations", [])),
        "animation_moves_nothing": changed(set_at("animations", 0, "channels", [])),
        "asset_missing": changed(set_at("asset", {})),
        "base64_wrong": text.replace(b"base64,A", b"base64,*", 1),
        "bind_matrices_past_end": changed(skinned_without_numbers),
        "buffer_absolute": simple().gltf("/etc/passwd"),
        "buffer_above": simple().gltf("../linear.glb"),
        "buffer_remote": simple().gltf("https://example.org/keys.bin"),
        "buffer_missing": simple().gltf("nowhere.bin"),
        "buffer_short": changed(lambda document, file: file.view(b"")).replace(
            b'"buffers":[{"byteLength":40', b'"buffers":[{"byteLength":99', 1),
        "channel_twice": changed(keys(0, "rotation", [0, 0.1], [NONE, NONE])),
        "channel_node_missing": changed(set_at("animations", 0, "channels", 0, "target", "node", 2)),
        "channel_sampler_missing": changed(set_at("animations", 0, "channels", 0, "sampler", 1)),
        "children_circle": changed(set_at("nodes", 1, "children", [0])),
        "child_of_two": changed(lambda document, _: document["nodes"].append({"children": [1]})),
        "cubic_two_per_key": changed(keys(1, "rotation", [0, 0.1], [NONE] * 4, "CUBICSPLINE")),
        "depth_bomb": b'{"asset":{"version":"2.0"},"nodes":' + b"[" * 100000 + b"]" * 100000 + b"}",
        "duration_too_large": changed(endless),
        "empty": b"",
        "extension_unknown": changed(set_at("extensionsRequired", ["ACME_bones"])),
        "glb_chunk_too_long": whole[:12] + struct.pack("<I", 999999) + whole[16:],
        "glb_cut": whole[:-10],
        "glb_head_only": whole[:16],
        "glb_first_chunk_wrong": whole[:16] + b"BIN\0" + whole[20:],
        "glb_version_1": whole[:4] + struct.pack("<I", 1) + whole[8:],
        "interpolation_unknown": changed(set_at("animations", 0, "samplers", 0, "interpolation", "BEZIER")),
        "json_cut": text[:len(text) // 2],
        "json_list": b"[]",
        "json_comma": text.replace(b",\n", b"\n", 1),
        "json_number_endless": text.replace(b'"byteOffset": 0', b'"byteOffset": 1e999', 1),
        "keys_fewer": changed(set_at("accessors", 1, "count", 1)),
        "keys_not_finite": changed(keys(1, "translation", [0, 0.1], [[0, 0, 0], [0, inf, 0]])),
        "keys_without_length": changed(keys(1, "rotation", [0, 0.1], [NONE, [0, 0, 0, 0]])),
        "keys_whole_numbers": changed(set_at("accessors", 1, "componentType", SHORT)),
        "matrix_perspective": changed(set_at("nodes", 1, "matrix", [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])),
        "matrix_shear": changed(set_at("nodes", 1, "matrix", [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])),
        "matrix_short": changed(set_at("nodes", 1, "matrix", [1, 0, 0])),
        "not_gltf": b"HIERARCHY\nROOT Hips\n",
        "packed_damaged": changed(packed_wrong),
        "packed_filter_unknown": changed(packed_as(filter="SMOOTH")),
        "packed_mode_unknown": changed(packed_as(mode="ZIP")),
        "packed_stride_odd": changed(packed_as(byteStride=6)),
        "packed_count_huge": changed(packed_as(count=2 ** 31)),
        "rotation_without_length": changed(set_at("nodes", 1, "rotation", [0, 0, 0, 0])),
        "rotation_of_three": changed(set_at("nodes", 1, "rotation", [0, 0, 0])),
        "scale_changes_by_axis": changed(keys(0, "scale", [0, 0.1], [[1, 1, 1], [1, 2, 1]])),
        "scale_changes_of_some": changed(one_grows),
        "scale_changes_to_nothing": changed(keys(0, "scale", [0, 0.1], [[1, 1, 1], [0, 0, 0]])),
        "scale_nothing": changed(scaled([0, 0, 0])),
        "scale_shears": changed(scaled([1, 1, 2], X90)),
        "skin_joint_missing": changed(set_at("skins", [{"joints": [7]}])),
        "sparse_past_end": changed(sparse_of(2)),
        "sparse_too_many": changed(sparse_of(0, 3)),
        "stride_odd": changed(set_at("bufferViews", 1, "byteStride", 6)),
        "stride_short": changed(set_at("bufferViews", 1, "byteStride", 8)),
        "times_back": changed(keys(1, "rotation", [0.2, 0.1], [NONE, NONE])),
        "times_nan": changed(keys(1, "rotation", [0, nan], [NONE, NONE])).replace(b"NaN", b"0.1"),
        "times_negative": changed(keys(1, "rotation", [-0.1, 0.1], [NONE, NONE])),
        "times_same": changed(keys(1, "rotation", [0.1, 0.1], [NONE, NONE])),
        "times_years": changed(keys(1, "rotation", [0, 1e9], [NONE, NONE])),
        "times_all_zero": changed(lambda document, _: document["accessors"][0].pop("bufferView")),
        "utf16": text.decode().encode("utf-16"),
        "version_1": changed(set_at("asset", "version", "1.0")),
        "version_later": changed(set_at("asset", "minVersion", "2.1")),
        "view_buffer_missing": changed(set_at("bufferViews", 1, "buffer", 4)),
        "view_past_buffer": changed(set_at("bufferViews", 1, "byteOffset", 16)),
        "weights_odd": changed(many_weights),
        "weights_without_mesh": changed(keys(1, "weights", [0, 0.1], [0, 1])),
    }
    for old in list(BROKEN.glob("*.glb")) + list(BROKEN.glob("*.gltf")):
        old.unlink()
    for name, data in files.items():
        ending = ".glb" if data.startswith(b"glTF") else ".gltf"
        (BROKEN / (name + ending)).write_bytes(data)


def fuzz_seeds():
    for make in (linear, cubic, uneven, armature, morph, quantised, sparse, meshopt, two_skins, bent_bind, squashed,
                 tracks, simple):
        (FUZZ / (make.__name__ + ".glb")).write_bytes(make().glb())
    (FUZZ / "bare.gltf").write_bytes(bare().gltf())


if __name__ == "__main__":
    for folder in (BROKEN, FUZZ):
        folder.mkdir(exist_ok=True)
    good_files()
    broken_files()
    fuzz_seeds()
