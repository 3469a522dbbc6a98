"""One hostile case: files, a command line, a place; how it is run, and what it must not do."""

import dataclasses
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import threading
import time
import zlib

SECONDS = 20  # of a processor, at most
HANGS = 90  # seconds of a clock; others use the machine, too
MEMORY = 2 << 30
SANITIZER = 99
LIBRARY_WORDS = ("[json", "std::", "basic_string", "bad_alloc", "vector::", "max_size()", "terminate called")


@dataclasses.dataclass
class Case:
    what: str
    files: dict = dataclasses.field(default_factory=dict)  # name: bytes, "-> target" for a link, None for a folder
    args: list = dataclasses.field(default_factory=list)
    output: str = ""  # of -o; nothing of it may be there after a refusal
    limits: dict = dataclasses.field(default_factory=dict)  # resource.RLIMIT_*: bytes or count
    stdout: str = "pipe"  # or "closed", "full"
    kill: tuple = ()  # signal and after how many seconds
    again: bool = False  # after the kill the same once more, which must do as if nothing had been
    env: dict = dataclasses.field(default_factory=dict)
    refused: str = ""  # it must be, with a sentence that names this


@dataclasses.dataclass
class Outcome:
    code: int
    out: str
    err: str
    seconds: float
    memory: int
    hung: bool


def put(folder, files):
    for name, content in files.items():
        path = folder / name if isinstance(name, str) else folder / os.fsdecode(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        if content is None:
            path.mkdir(exist_ok=True)
        elif isinstance(content, str):
            path.symlink_to(content.removeprefix("-> "))
        else:
            path.write_bytes(content)


def everything(folder):
    return {str(path.relative_to(folder)): path.stat().st_mtime_ns if path.is_file() else 0
            for path in folder.rglob("*")}


def reader(stream, into):
    thread = threading.Thread(target=lambda: into.append(stream.read(1 << 22)), daemon=True)
    thread.start()
    return thread


def run(program, case, folder, kill=()):
    """Runs `case` in `folder`, where its files are."""
    def limit():
        for what, most in case.limits.items():
            resource.setrlimit(what, (most, most))
        if case.stdout == "closed":
            os.close(1)

    full = open("/dev/full", "wb") if case.stdout == "full" else None
    env = {**os.environ, "VK_DRIVER_FILES": "none", "ASAN_OPTIONS": f"exitcode={SANITIZER}",
           "UBSAN_OPTIONS": f"exitcode={SANITIZER}", **case.env}
    process = subprocess.Popen([program, *case.args], cwd=folder, env=env, stdin=subprocess.DEVNULL,
                               stdout=full or subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit,
                               start_new_session=True)
    out, err, hung = [], [], []
    threads = [reader(process.stderr, err)] + ([] if full else [reader(process.stdout, out)])

    def end(number, isHang):
        try:
            os.kill(process.pid, number)
        except ProcessLookupError:
            return
        if isHang:
            hung.append(True)

    timers = [threading.Timer(HANGS, end, (signal.SIGKILL, True))]
    if kill:
        timers.append(threading.Timer(kill[1], end, (kill[0], False)))
    for timer in timers:
        timer.start()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = 0
    for timer in timers:
        timer.cancel()
    for thread in threads:
        thread.join(5)
    text = [b"".join(part).decode("utf-8", "surrogateescape") for part in (out, err)]
    return Outcome(os.waitstatus_to_exitcode(status), *text, usage.ru_utime + usage.ru_stime,
                   usage.ru_maxrss << 10, bool(hung))


def judge(case, outcome, folder, before):
    """What is wrong with it, in a word or two; nothing if it did as it must."""
    if outcome.hung or outcome.seconds > SECONDS:
        return "too long"
    if outcome.memory > MEMORY and not case.limits.get(resource.RLIMIT_AS):
        return "too much memory"
    if outcome.code < 0 and not case.kill:
        return f"signal {signal.Signals(-outcome.code).name}"
    if outcome.code == SANITIZER or "ERROR: AddressSanitizer" in outcome.err or "runtime error:" in outcome.err:
        return "sanitizer"
    if case.kill:
        return judge_killed(case, outcome, folder, before)
    if outcome.code not in (0, 1, 2):
        return f"exit code {outcome.code}"
    if case.refused and (outcome.code != 1 or case.refused not in outcome.err):
        return f"not refused for {case.refused}"
    return (judge_words(case, outcome) or (judge_result(case, outcome, folder) if outcome.code == 0
                                          else judge_refusal(case, outcome, folder, before)))


def judge_killed(case, outcome, folder, before):
    if case.kill[0] in (signal.SIGKILL, signal.SIGHUP):  # the end of a terminal is not waited for
        return ""
    if outcome.code not in (0, 1, 130, -case.kill[0]):  # the signal itself, before anything was begun
        return f"exit code {outcome.code} after a signal"
    if outcome.code and set(everything(folder)) - set(before):
        return "something left after a signal"
    return ""


def judge_words(case, outcome):
    given = " ".join(case.args) + "".join(
        content.decode("latin1") for content in case.files.values() if isinstance(content, bytes) and len(content) < 1e5)
    said = outcome.err + outcome.out
    for word in LIBRARY_WORDS:
        if word in said and word not in given:
            return "library words"
    if any(ord(c) < 32 and c not in "\n\t\r" or ord(c) == 127 for c in said):
        return "control characters"
    isTold = all(len(arg) < 1000 for arg in case.args)  # else it may well say it again
    if isTold and any(len(line) > 4000 for line in outcome.err.splitlines()):
        return "endless line"
    return ""


def judge_refusal(case, outcome, folder, before):
    if case.stdout != "pipe":
        return ""
    if not outcome.err.strip():
        return "no sentence"
    if outcome.code == 1:
        said = [line for line in outcome.err.replace("\r", "\n").splitlines() if line.startswith("relamp: ")]
        if not said:
            return "no sentence"
        if not any(name in line for name in names(case) for line in said):
            return "no file named"
    if re.search(r"\d of \d+ scans are done", outcome.err):  # the others' results stay, and must be whole
        return judge_result(case, outcome, folder) if (folder / case.output).exists() else ""
    if everything(folder).keys() - before.keys():
        return "something left"
    return ""


def names(case):
    """Words one of which a refusal must say: a file, or what was given as an option."""
    words = set()
    for name in [os.fsdecode(name) for name in case.files] + [arg for arg in case.args if arg]:
        words |= {name[:40], pathlib.PurePath(name).name[:40] or name, pathlib.PurePath(name).stem[:40] or name}
    words |= {part for word in words for part in re.split(r"[^ -~]", word)}  # what is not printable is not printed
    return {word for word in words if word} | {"standard output", "memory", "GPU", "Vulkan", "Node.js"}


def judge_result(case, outcome, folder):
    if "--json" in case.args and case.stdout == "pipe" and not holds_numbers(outcome.out):
        return "NaN in an output"
    if any(part.name.startswith(".") and part.name not in case.files for part in folder.iterdir()):
        return "something left"
    if not case.output:
        return ""
    output = folder / case.output
    if not output.exists():
        return "no result"
    files = [output] if output.is_file() else [part for part in output.rglob("*") if part.is_file()]
    return "" if all(is_sound(part) for part in files) else "NaN in an output"


def holds_numbers(text):
    def refuse(word):
        raise ValueError(word)
    try:
        json.loads(text, parse_constant=refuse)
    except ValueError:
        return False
    return True


def is_sound(path):
    content = path.read_bytes()
    if path.suffix == ".json":
        return holds_numbers(content)
    if path.suffix == ".glb":
        length, = struct.unpack_from("<I", content, 12)
        return holds_numbers(content[20:20 + length])
    if path.suffix == ".exr":
        return all(half & 0x7c00 != 0x7c00 for half in halves(content))
    return True


def halves(exr):
    """All samples of an EXR as relamp writes it: scan lines of halves, by ZIP."""
    at, size = 8, {}
    while exr[at]:
        name, kind, rest = exr[at:].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        length, = struct.unpack_from("<I", exr, at)
        size[name] = exr[at + 4:at + 4 + length]
        at += 4 + length
    at += 1
    left, top, right, bottom = struct.unpack("<4i", size[b"dataWindow"])
    lines = {0: 1, 2: 1, 3: 16}.get(size[b"compression"][0])
    if lines is None:
        return
    blocks = -(-(bottom - top + 1) // lines)
    for offset in struct.unpack_from(f"<{blocks}Q", exr, at):
        first, length = struct.unpack_from("<iI", exr, offset)
        block = exr[offset + 8:offset + 8 + length]
        samples = 3 * (right - left + 1) * min(lines, bottom - first + 1)
        if length < 2 * samples:  # what gets no smaller is not compressed
            mixed = bytearray(zlib.decompress(block))
            for i in range(1, len(mixed)):
                mixed[i] = (mixed[i - 1] + mixed[i] - 128) & 255
            half = (len(mixed) + 1) // 2
            block = bytes(byte for pair in zip(mixed[:half], mixed[half:]) for byte in pair)
        yield from struct.unpack_from(f"<{len(block) // 2}H", block)


def try_case(program, case, folder, keep):
    """Runs it in a folder of its own; the outcome, and what was wrong. What failed is kept."""
    folder.mkdir()
    put(folder, case.files)
    before = everything(folder)
    outcome = run(program, case, folder, case.kill)
    wrong = judge(case, outcome, folder, before)
    if case.again and not wrong:
        once_more = dataclasses.replace(case, kill=())
        outcome = run(program, once_more, folder)
        wrong = judge(once_more, outcome, folder, before) or ("fails after a kill" if outcome.code else "")
    if wrong and keep:
        kept = keep / case.what.replace("/", "_").replace(" ", "_")[:100]
        shutil.rmtree(kept, ignore_errors=True)
        shutil.move(folder, kept)
        words = " ".join(repr(arg)[:300] for arg in case.args)
        (kept / "what").write_text(f"{wrong}: exit {outcome.code}, {outcome.seconds:.1f} s, {outcome.memory >> 20} MiB\n"
                                   f"relamp {words}\n{outcome.err[-6000:]}\n{outcome.out[-2000:]}", errors="replace")
    shutil.rmtree(folder, ignore_errors=True)
    return outcome, wrong
