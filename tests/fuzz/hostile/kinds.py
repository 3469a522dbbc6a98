"""The five kinds of hostile cases. Each is a function that yields Case after Case for ever or to its end."""

import json
import re
import resource
import signal
import struct
import subprocess

import damage
from case import Case

DRAFT = ["--quality", "draft", "--rays", "4", "--shadow-rays", "1"]


class Seeds:
    """Small good files: those of relamp_fuzz_seeds, and what is put together from them."""

    def __init__(self, folder, program, scratch):
        self.program = program
        files = {part.name: sorted(part.iterdir(), key=lambda file: int(file.name)) for part in folder.iterdir()}
        read = {name: [file.read_bytes() for file in some] for name, some in files.items()}
        self.glbs = [content for content in read["gltf"] if content.startswith(b"glTF")]
        self.plys = read["ply"]
        self.ies = read["ies"][0]
        self.lights = read["lights_json"][0]
        self.timeline = read["timeline_json"][0]
        self.pictures = {ending: self.picture(read["image"], begin) for ending, begin in
                         (("png", b"\x89PNG"), ("jpg", b"\xff\xd8"), ("webp", b"RIFF"), ("tif", b"II"), ("bmp", b"BM"),
                          ("exr", b"v/1\1"), ("hdr", b"#?"), ("tga", b"\0"))}
        self.room = self.part(read["result"][0], 7)  # the last of kFilesOfResult
        self.result = self.delit(scratch)

    @staticmethod
    def picture(pictures, begin):
        return next(content for content in pictures if content.startswith(begin))

    @staticmethod
    def part(joined, wanted):
        at = 0
        while joined[at] != wanted:
            at += 5 + struct.unpack_from("<I", joined, at + 1)[0]
        length, = struct.unpack_from("<I", joined, at + 1)
        return joined[at + 5:at + 5 + length]

    def delit(self, scratch):
        """The room, and what relamp makes of it."""
        (scratch / "room.glb").write_bytes(self.room)
        for command in (["delight", "room.glb", "-o", "out", "--light", "1,2,1", *DRAFT],
                        ["relight", "out", "-o", "out.exr", "--fixture", "all=on", "--rays", "4", "--bake"]):
            subprocess.run([self.program, *command], cwd=scratch, check=True, capture_output=True,
                           env={"VK_DRIVER_FILES": "none", "ASAN_OPTIONS": "detect_leaks=0"})
        return {"room.glb": self.room, **{f"out/{file.name}": file.read_bytes() for file in (scratch / "out").iterdir()
                                          if file.name != "preview.png"}}

    def obj(self, ending="png"):
        """An OBJ whose picture is of that format."""
        return {"room.obj": b"mtllib room.mtl\no wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                            b"vn 0 0 1\nusemtl paint\nf 1/1/1 2/2/1 3/3/1\nf 3/3/1 2/2/1 4/4/1\n",
                "room.mtl": f"newmtl paint\nKd 1 1 1\nmap_Kd -clamp on a.{ending}\n".encode(),
                f"a.{ending}": self.pictures[ending]}

    def gltf(self):
        text, binary = damage.chunks(self.glbs[0])
        document = json.loads(text)
        document["buffers"] = [{"byteLength": len(binary), "uri": "room.bin"}]
        return {"room.gltf": json.dumps(document).encode(), "room.bin": binary}


def use(main, number, files, what):
    """`info` of the scan; every eighth is taken apart, too."""
    if number % 8:
        return Case(what, files, ["info", main] + (["--json"] if number % 2 else []))
    return Case(what, files, ["delight", main, "-o", "out", "-q", *DRAFT], "out")


def bytes_damaged(seeds, random):
    """i: damaged bytes of every format that a scan is made of."""
    sorts = [(f"glb{i}", {"room.glb": content}, "room.glb", "room.glb") for i, content in enumerate(seeds.glbs)]
    sorts += [(f"ply{i}", {"room.ply": content}, "room.ply", "room.ply") for i, content in enumerate(seeds.plys)]
    sorts += [(part, seeds.obj(), "room.obj", part) for part in ("room.obj", "room.mtl")]
    sorts += [(part, seeds.gltf(), "room.gltf", part) for part in ("room.gltf", "room.bin")]
    sorts += [(ending, seeds.obj(ending), "room.obj", f"a.{ending}") for ending in seeds.pictures]
    number = 0
    while True:
        for what, files, main, part in sorts:
            number += 1
            spoilt = {**files, part: damage.bytes_of(files[part], random)}
            yield use(main, number // len(sorts) + number, spoilt, f"bytes {what} {number}")


def mixed(random, *sources):
    """All of them, in an order that `random` says."""
    every = [case for source in sources for case in source]
    random.shuffle(every)
    yield from every


def values_impossible(seeds, random):
    """ii: every key, field and number of a scan set to what it cannot be."""
    def glbs():
        for index in (0, len(seeds.glbs) - 1):
            text, binary = damage.chunks(seeds.glbs[index])
            for number, (what, spoilt) in enumerate(damage.values_of(text)):
                yield use("room.glb", number, {"room.glb": damage.glb(spoilt, binary)}, f"values glb{index} {what}")

    def texts():
        files = seeds.obj()
        for part in ("room.obj", "room.mtl"):
            for number, (what, spoilt) in enumerate(damage.words_of(files[part].decode("latin1"))):
                yield use("room.obj", number, {**files, part: spoilt}, f"values {part} {what}")
        for index, content in enumerate(seeds.plys):
            header, end, rest = content.partition(b"end_header")
            text = header.decode() + (end + rest).decode() if index < 2 else header.decode()
            for number, (what, spoilt) in enumerate(damage.words_of(text)):
                whole = spoilt if index < 2 else spoilt + end + rest
                yield use("room.ply", number, {"room.ply": whole, "a.png": seeds.pictures["png"]},
                          f"values ply{index} {what}")

    yield from mixed(random, glbs(), texts())


def results_damaged(seeds, random):
    """iii: what delight wrote, and files of light, cameras, timelines and lamps, damaged."""
    relight = ["relight", "out", "-o", "a.exr", "--rays", "4", "--size", "16x16", "-q"]
    verify = ["verify", "out", "--samples", "2", "--places", "16", "--json"]
    files = seeds.result

    def uses(number, spoilt, what):
        if number % 2:
            return Case(what, spoilt, verify)
        return Case(what, spoilt, relight + ["--fixture", "all=on"], "a.exr")

    def documents():
        for part in ("out/report.json", "out/lights.json"):
            for number, (what, spoilt) in enumerate(damage.values_of(files[part])):
                yield uses(number, {**files, part: spoilt}, f"result {part} {what}")

    def bytes_of_result():
        for number in range(400):
            part = random.choice(["out/transport.bin", "out/transport.bin", "out/albedo.exr", "out/confidence.png", "out/fixtures.png", "out/correction.png",
                                  "out/report.json", "out/lights.json"])
            yield uses(number, {**files, part: damage.bytes_of(files[part], random)}, f"result {part} bytes {number}")

    def spoilt_maps(part):
        """A map of texels as no relamp wrote it."""
        good = files[part]
        name = part.removeprefix("out/")
        maps = {"empty": {part: b""}, "gone": {}, "of words": {part: b"hello\n"}, "of an EXR": {part: files["out/albedo.exr"]},
                "of another size": {part: seeds.pictures["png"]}, "that is a folder": {part: None}, "that loops": {part: f"-> {name}"},
                "that dangles": {part: "-> ../nowhere"}, "that is a device": {part: "-> /dev/zero"},
                "elsewhere, of another size": {part: "-> ../a.png", "a.png": seeds.pictures["png"]},
                "elsewhere, no picture": {part: "-> ../b.txt", "b.txt": b"root:x:0:0\n"}}
        return maps | {f"cut at {length}": {part: good[:length]} for length in (1, 8, 30, len(good) // 2, len(good) - 12, len(good) - 1)}

    def maps():
        """Whatever reads them must say so by their name. fixtures.png of another size only relight refuses, for pages are looked
        up in it by their shares of the sides. Without correction.png no light is corrected."""
        for name in ("fixtures", "correction"):
            part = f"out/{name}.png"
            others = {other: content for other, content in files.items() if other != part}
            for what, spoilt in spoilt_maps(part).items():
                isOfAnotherSize = "another size" in what
                isLeftOut = name == "correction" and what in ("gone", "that loops", "that dangles")
                refused = "" if isLeftOut else f"{name}*.png" if isOfAnotherSize else part
                yield Case(f"result {name}.png {what} relight", {**others, **spoilt}, relight + ["--fixture", "all=on"], "a.exr",
                           refused=refused)
                yield Case(f"result {name}.png {what} verify", {**others, **spoilt}, verify,
                           refused="" if isOfAnotherSize and name == "fixtures" else refused)
            yield Case(f"result {name}.png elsewhere, as it was", {**others, part: "-> ../c.png", "c.png": files[part]},
                       relight + ["--fixture", "all=on"], "a.exr")

    def beside(name, text, option, spoil):
        more = {"a.ies": seeds.ies} if option != "--camera" else {}
        for what, spoilt in spoil(text):
            yield Case(f"result {name} {what}", {**files, **more, name: spoilt}, relight + [option, name], "a.exr")

    def ies():
        lights = b'{"format": "relamp lights 1", "lights": [{"type": "ies", "position": [1, 1.5, 1], "file": "a.ies"}]}'
        for what, spoilt in damage.words_of(seeds.ies.decode()):
            yield Case(f"result a.ies {what}", {**files, "lights.json": lights, "a.ies": spoilt},
                       relight + ["--lights", "lights.json"], "a.exr")

    camera = (b'{"format": "relamp camera 1", "position": [1, 1, 1], "target": [1, 1, 0], "up": [0, 1, 0],'
              b' "fieldOfView": 80}')
    lights = (b'{"format": "relamp lights 1", "white": {"kelvin": 4500}, "fixtures": [{"id": 0, "lumens": 80, "kelvin": 3000,'
              b' "dim": 0.5}], "lights": [{"name": "a", "type": "sphere", "position": [1, 1, 1], "radius": 0.1,'
              b' "lumens": 800, "kelvin": 2900}], "sky": {"radiance": [1, 1, 1]}}')
    timeline = seeds.timeline
    yield from mixed(random, documents(), bytes_of_result(), ies(), maps(),
                     beside("camera.json", camera, "--camera", damage.values_of),
                     beside("lights.json", lights, "--lights", damage.values_of),
                     (case
                      for case in beside("day.json", timeline, "--timeline", first_frames)))


def first_frames(timeline):
    """Timelines that are read and refused before a film is made would be few: a short one is enough."""
    document = json.loads(timeline)
    document["seconds"] = 0.1
    return damage.values_of(json.dumps(document).encode())


def usage_wrong(seeds, random):
    """iv: options and arguments as nobody means them."""
    files = {**seeds.result, "camera.json": b"{}", "folder": None, "empty": b"", "loop": "-> loop", "none": "-> nowhere",
             "text": b"hello\n"}
    commands = {"info": ["info", "room.glb"],
                "delight": ["delight", "room.glb", "-o", "new", "-q", *DRAFT],
                "relight": ["relight", "out", "-o", "a.png", "--size", "16x16", "-q", "--rays", "4"],
                "verify": ["verify", "out", "--samples", "2", "--places", "16"],
                "bench": ["bench", "room.glb", "--runs", "1"], "devices": ["devices"], "view": ["view", "none.glb"]}
    values = ("", "nan", "inf", "-inf", "-1", "0", "1e300", "1e-300", "99999999999999999999", "1,2", "1,2,3", "nan,nan,nan",
              "1e38,1e38,1e38", "x", "\x1b[31mred", "a" * 5000, "text", "folder", "empty", "loop", "none", "/dev/null", "-",
              "--", "../../x", "1x1", "0x0", "99999x99999", "all=on", "0=nan%", "0=1e300lm", "=", "0=", "all=2700K,x", "\xff")
    outputs = {"delight": "new", "relight": "a.png"}

    def cases():
        for command, arguments in commands.items():
            said = subprocess.run([seeds.program, command, "--help"], capture_output=True, text=True,
                                  env={"VK_DRIVER_FILES": "none"}).stdout
            for option in dict.fromkeys(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", said, re.M)):
                for value in values:
                    yield Case(f"usage {command} {option} {value[:20]!r}", files, arguments + [option, value], outputs.get(command, ""))
                yield Case(f"usage {command} {option} without", files, arguments + [option], outputs.get(command, ""))
                yield Case(f"usage {command} {option} twice", files, arguments + [option, "1", option, "2"], outputs.get(command, ""))
                yield Case(f"usage {command} {option}=", files, arguments + [f"{option}="], outputs.get(command, ""))
            for value in values + ("/dev/zero", "/dev/full", "/proc/self/mem", "out/report.json", "room.glb/"):
                yield Case(f"usage {command} of {value[:20]!r}", files, [value if a in ("room.glb", "out") else a for a in arguments])
                yield Case(f"usage {command} more {value[:20]!r}", files, arguments + [value])
        for value in values:
            yield Case(f"usage {value[:20]!r}", files, [value])
            yield Case(f"usage delight -o {value[:20]!r}", files, ["delight", "room.glb", "-o", value, "-q", *DRAFT])
            yield Case(f"usage relight -o {value[:20]!r}", files, ["relight", "out", "-o", value, "--size", "8x8", "--rays", "4"])
        yield Case("usage nothing", files, [])

    for case in mixed(random, cases()):
        # An option that is taken may name another output or ask for films: then it is judged by its words alone.
        if any(option in case.args for option in ("--output", "--output=", "--turntable", "--timeline", "--bake", "--help", "--help=")):
            case.output = ""
        yield case


def places_hostile(seeds, random):
    """v: places and resources: full disks, closed pipes, kills, links, bombs."""
    files = seeds.result
    delight = ["delight", "room.glb", "-o", "new", "-q", *DRAFT]
    relight = ["relight", "out", "-o", "a.png", "--size", "16x16", "--rays", "4", "--fixture", "all=on", "-q"]
    verify = ["verify", "out", "--samples", "2", "--places", "16", "--json"]

    def resources():
        for size in (0, 1, 100, 300, 1000, 1500, 2000, 4000, 8000, 16000, 32000, 64000, 100000, 130000, 1 << 20):
            for name, args, output in (("delight", delight, "new"), ("relight", relight, "a.png"), ("verify", verify, "")):
                yield Case(f"places {name} files up to {size}", files, args, output, {resource.RLIMIT_FSIZE: size})
        for count in (12, 16, 24, 32, 64):  # below, a sanitizer cannot look at memory
            for name, args, output in (("delight", delight, "new"), ("relight", relight, "a.png"), ("verify", verify, "")):
                yield Case(f"places {name} {count} files open", files, args, output, {resource.RLIMIT_NOFILE: count})
        for name, args, output in (("info", ["info", "room.glb"], ""), ("delight", delight[:-7] + delight[-6:], "new"),
                                   ("relight", relight, "a.png"), ("verify", verify, ""), ("help", ["--help"], "")):
            for stdout in ("closed", "full"):
                yield Case(f"places {name} stdout {stdout}", files, args, output, stdout=stdout)
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            for i in range(25):
                after = random.uniform(0.0, 0.8)
                yield Case(f"places kill {number.name} {i}", files, delight, "new", kill=(number, after), again=True)
                yield Case(f"places kill relight {number.name} {i}", files, relight, "a.png", kill=(number, after), again=True)

    def links():
        secret = b"root:x:0:0:secret of this machine"
        text, binary = damage.chunks(seeds.glbs[0])
        document = json.loads(text)
        for uri in ("../secret", "/etc/passwd", "file:///etc/passwd", "link", "%2e%2e/secret", "http://localhost/x", "/dev/zero",
                    "/dev/stdin", "/proc/self/mem", "fifo", "folder", "a/../../secret", "..%2fsecret", "\x1b[31m", "x" * 5000):
            for where in ("images", "buffers"):
                spoilt = json.loads(text)
                spoilt[where][0] = {"uri": uri, "byteLength": len(binary), "mimeType": "image/png"}
                content = damage.glb(json.dumps(spoilt).encode(), binary)
                yield Case(f"places {where} {uri[:30]!r}", {"in/room.glb": content, "secret": secret, "in/link": "-> ../secret",
                                                          "in/folder": None}, ["delight", "in/room.glb", "-o", "new", "-q", *DRAFT], "new")
            obj = {f"in/{name}": content for name, content in seeds.obj().items()}
            obj["in/room.mtl"] = b"newmtl paint\nmap_Kd " + uri.encode() + b"\n"
            yield Case(f"places map_Kd {uri[:30]!r}", {**obj, "secret": secret, "in/link": "-> ../secret"},
                       ["delight", "in/room.obj", "-o", "new", "-q", *DRAFT], "new")
        for what, more, args in (
                ("scan is a link", {"link.glb": "-> room.glb"}, ["info", "link.glb"]),
                ("scan is a loop", {"loop.glb": "-> loop.glb"}, ["info", "loop.glb"]),
                ("scan is a folder", {"folder.glb": None}, ["info", "folder.glb"]),
                ("output is a link to a folder", {"there": None, "new": "-> there"}, delight),
                ("output dangles", {"new": "-> nowhere"}, delight), ("output is a file", {"new": b"mine"}, delight),
                ("output loops", {"new": "-> new"}, delight), ("output in a file", {}, delight[:3] + ["room.glb/new"] + delight[4:]),
                ("output in /proc", {}, delight[:3] + ["/proc/new"] + delight[4:]),
                ("output is the room's folder", {}, delight[:3] + ["."] + delight[4:]),
                ("file for a folder inside", {"new/report.json": None}, delight),
                ("lights.json is a folder", {"new/lights.json/x": b""}, delight),
                ("transport is a folder", {"out/transport.bin/x": b""}, relight),
                ("transport is a loop", {"out/transport.bin": "-> transport.bin"}, relight),
                ("no home", {}, delight)):
            kept = {name: content for name, content in files.items() if not any(m.startswith(name) and m != name for m in more)}
            yield Case(f"places {what}", {**kept, **more}, args, env={"HOME": "/nowhere", "TMPDIR": "/nowhere"})
        for name in ("-x.glb", "a\nb.glb", "a b.glb", "\xff\xfe.glb", "n" * 250 + ".glb", "\x1b[31m.glb", "%s%n.glb", "a:b.glb",
                     "..glb", ".glb", "room.GLB", "room.glb.", "room", "é.glb"):
            yield Case(f"places name {name[:20]!r}", {name: seeds.room}, ["info", "./" + name])
            yield Case(f"places delight {name[:20]!r}", {name: seeds.room}, ["delight", "./" + name, *delight[2:]], "new")

    yield from mixed(random, resources(), links(), bombs(seeds))


def bombs(seeds):
    """Cheap files that ask for much."""
    text, binary = damage.chunks(seeds.glbs[0])

    def changed(change):
        document = json.loads(text)
        change(document)
        return damage.glb(json.dumps(document).encode(), binary)

    def nodes(count):
        def change(document):
            document["nodes"] = [{"mesh": 0}] * count
            document["scenes"] = [{"nodes": list(range(count))}]
        return change

    def chain(count):
        def change(document):
            document["nodes"] = [{"children": [i + 1]} for i in range(count)] + [{"mesh": 0}]
            document["scenes"] = [{"nodes": [0]}]
        return change

    def fork(count):
        def change(document):
            document["nodes"] = [{"children": [i + 1, i + 1]} for i in range(count)] + [{"mesh": 0}]
            document["scenes"] = [{"nodes": [0]}]
        return change

    def pages(count):
        def change(document):
            primitive = document["meshes"][0]["primitives"][0]
            document["textures"] = [{"source": i} for i in range(count)]
            document["images"] = document["images"] * count
            document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in range(count)]
            document["meshes"][0]["primitives"] = [{**primitive, "material": i} for i in range(count)]
        return change

    def repeated(key, count):
        def change(document):
            document[key] = document[key] * count
        return change

    sorts = [(f"{count} nodes", nodes(count)) for count in (1000, 10_000, 100_000, 1_000_000)]
    sorts += [(f"chain of {count}", chain(count)) for count in (1000, 100_000)]
    sorts += [(f"fork of {count}", fork(count)) for count in (20, 1000)]
    sorts += [(f"{count} pages", pages(count)) for count in (50, 500, 5000)]
    sorts += [(f"{count} {key}", repeated(key, count)) for key in ("accessors", "bufferViews", "materials", "meshes", "images")
              for count in (1000, 100_000)]
    for what, change in sorts:
        content = changed(change)
        yield Case(f"places {what}", {"room.glb": content}, ["info", "room.glb"])
        yield Case(f"places delight {what}", {"room.glb": content}, ["delight", "room.glb", "-o", "new", "-q", *DRAFT], "new")
    for what, content in (("deep", b'{"asset":' + b"[" * 1_000_000), ("wide", b'{"asset":[' + b"0," * 2_000_000 + b"0]}"),
                          ("long text", b'{"asset":{"version":"' + b"2" * 10_000_000 + b'"}}'),
                          ("spaces", b" " * 20_000_000)):
        yield Case(f"places json {what}", {"room.gltf": content}, ["info", "room.gltf"])
    for count in (2**31 - 1, 2**32 - 1, 10**12, 2**63):
        for kind in ("vertex", "face"):
            ply = seeds.plys[2].replace(f"element {kind} 1".encode(), f"element {kind} {count}".encode())
            yield Case(f"places ply {count} {kind}", {"room.ply": ply}, ["info", "room.ply"])
    lines = b"".join(b"v %d 0 0\n" % i for i in range(200_000)) + b"f 1 2 3\n" * 200_000
    yield Case("places obj of 400000 lines", {"room.obj": lines}, ["info", "room.obj"])
    yield Case("places obj of one line", {"room.obj": b"f " + b"1 " * 2_000_000}, ["info", "room.obj"])
    yield Case("places obj continued", {"room.obj": b"v 0 0 0 \\\n" * 500_000}, ["info", "room.obj"])


KINDS = {"bytes": bytes_damaged, "values": values_impossible, "results": results_damaged, "usage": usage_wrong,
         "places": places_hostile}
