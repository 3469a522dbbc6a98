"""Ways to spoil what was good."""

import copy
import json
import re
import struct

# Instead of a value in JSON. Raw ones are no JSON, but what some programs write.
VALUES = (None, True, -1, 0, 0.5, 1e300, -1e300, 1e38, 4294967296, 2**63, 2**64, "", "x" * 5000, "\x1b[31mred\x07",
          "../../../etc/passwd", [], {}, [[[[]]]], [1e300, -1e300, 5], {"a": {"b": []}})
RAW = ("NaN", "-Infinity", "1e999", "[" * 20000, "1" * 400, '"\\ud800"', "\xff")
WORDS = ("", "nan", "inf", "-1", "1e300", "1e38", "-1e20", "4294967296", "99999999999999999999", "x", "0", "../../etc/passwd",
         "\x1b[31m", "a" * 5000, "\xff\xfe")
PLACE = "@hostile@"


def bytes_of(content, random):
    """`content` with one to four damages."""
    spoilt = bytearray(content)
    for _ in range(random.choice((1, 1, 1, 2, 4))):
        size = max(len(spoilt), 1)
        at, length = random.randrange(size), random.choice((1, 2, 4, 16, 200))
        way = random.randrange(8)
        if not spoilt:
            break
        if way == 0:
            spoilt[at] ^= 1 << random.randrange(8)
        elif way == 1:
            del spoilt[at:]
        elif way == 2:
            spoilt[at:at] = random.randbytes(length)
        elif way == 3:
            del spoilt[at:at + length]
        elif way == 4:
            spoilt[at:at + length] = random.choice((b"\0", b"\xff", b"\x7f", b"\x80")) * min(length, size - at)
        elif way == 5:
            spoilt[at:at] = spoilt[at:at + length]
        elif way == 6:
            number = random.choice((0, 1, 2**31 - 1, 2**31, 2**32 - 1, 0x7fc00000, 0x7f800000))
            spoilt[at:at + 4] = struct.pack(random.choice("<>") + "I", number)
        else:
            spoilt[at] = random.randrange(256)
    return bytes(spoilt)


def paths(document, path=()):
    """Where values are in a JSON document, itself left out."""
    items = document.items() if isinstance(document, dict) else enumerate(document)
    for key, value in items:
        yield path + (key,)
        if isinstance(value, (dict, list)):
            yield from paths(value, path + (key,))


def with_value(document, path, value):
    changed = copy.deepcopy(document)
    parent = changed
    for key in path[:-1]:
        parent = parent[key]
    parent[path[-1]] = value
    return changed


def values_of(text):
    """(what, text) for each value in a JSON text put in the place of each of its values, and for each left out."""
    document = json.loads(text)
    for path in paths(document):
        where = "/".join(map(str, path))
        for value in VALUES:
            yield f"{where}={str(value)[:20]!r}", json.dumps(with_value(document, path, value)).encode()
        placed = json.dumps(with_value(document, path, PLACE))
        for raw in RAW:
            yield f"{where}={raw[:10]!r}", placed.replace(f'"{PLACE}"', raw).encode("latin1")
        parent = document
        for key in path[:-1]:
            parent = parent[key]
        if isinstance(parent, dict):
            without = copy.deepcopy(document)
            inner = without
            for key in path[:-1]:
                inner = inner[key]
            del inner[path[-1]]
            yield f"{where} gone", json.dumps(without).encode()


def words_of(text):
    """(what, text) for each word of a text replaced by each of WORDS."""
    for found in re.finditer(r"[^\s/]+", text):
        for word in WORDS:
            spoilt = text[:found.start()] + word + text[found.end():]
            yield f"{found.group()[:20]}@{found.start()}={word[:10]!r}", spoilt.encode("latin1")


def glb(document, binary):
    text = document + b" " * (-len(document) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") +
            text + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def chunks(content):
    """JSON text and binary of a GLB."""
    length, = struct.unpack_from("<I", content, 12)
    return content[20:20 + length], content[28 + length:]
