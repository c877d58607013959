"""Writes arm.fbx of this folder as binary FBX: arm_7400.fbx, and arm_7700.fbx with 64-bit positions and compressed arrays.

    python3 testdata/fbx/make_binary.py
"""
import os
import re
import struct
import zlib

FOLDER = os.path.dirname(os.path.abspath(__file__))
TOKEN = re.compile(r';[^\n]*|"[^"]*"|\*\d+|[{}]|,|[\w|]+:|[-+.\w]+')


def tokens(text):
    return [token for token in TOKEN.findall(text) if not token.startswith(";")]


def parse(words, at, end):
    """Records as (name, values, children) until the closing brace."""
    records = []
    while at < len(words) and words[at] != end:
        name, values, children = words[at][:-1], [], None
        at += 1
        while at < len(words) and words[at] not in ("{", "}") and not words[at].endswith(":"):
            if words[at] != ",":
                values.append(words[at])
            at += 1
        if at < len(words) and words[at] == "{":
            children, at = parse(words, at + 1, "}")
        if values and values[0].startswith("*"):  # an array: its numbers are in the record 'a'
            values, children = [[float(number) for number in children[0][1]]], None
        records.append((name, values, children))
    return records, at + 1


def value_bytes(name, value, deflate):
    if isinstance(value, list):
        kinds = {"KeyTime": "l", "KeyAttrFlags": "i", "KeyAttrRefCount": "i", "KeyValueFloat": "f", "KeyAttrDataFloat": "f"}
        kind = kinds.get(name, "d")
        if name == "KeyAttrDataFloat":  # the text holds the bits of the last two
            raw = b"".join(struct.pack("<f" if i % 4 < 2 else "<I", n if i % 4 < 2 else int(n)) for i, n in enumerate(value))
        else:
            cast = int if kind in "li" else float
            raw = struct.pack("<%d%s" % (len(value), "q" if kind == "l" else kind), *map(cast, value))
        packed = zlib.compress(raw) if deflate else raw
        return kind.encode() + struct.pack("<III", len(value), int(deflate), len(packed)) + packed
    if value.startswith('"'):
        text = value[1:-1]
        if "::" in text:
            kind, text = text.split("::", 1)
            text = text + "\0\1" + kind
        return b"S" + struct.pack("<I", len(text)) + text.encode()
    if re.fullmatch(r"-?\d+", value):
        return b"L" + struct.pack("<q", int(value))
    if re.fullmatch(r"[A-Z]", value):
        return b"C" + b"\1"
    return b"D" + struct.pack("<d", float(value))


def record_bytes(record, place, wide):
    name, values, children = record
    head = (24 if wide else 12) + 1 + len(name)
    body = b"".join(value_bytes(name, value, wide) for value in values)
    size = len(body)
    if children is not None:
        for child in children:
            body += record_bytes(child, place + head + len(body), wide)
        body += bytes(25 if wide else 13)
    end = place + head + len(body)
    numbers = struct.pack("<QQQ" if wide else "<III", end, len(values), size)
    return numbers + bytes([len(name)]) + name.encode() + body


with open(os.path.join(FOLDER, "arm.fbx")) as file:
    scene, _ = parse(tokens(file.read()), 0, None)
for version in (7400, 7700):
    wide = version >= 7500
    out = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
    for record in scene:
        out += record_bytes(record, len(out), wide)
    with open(os.path.join(FOLDER, "arm_%d.fbx" % version), "wb") as file:
        file.write(out + bytes(25 if wide else 13))
