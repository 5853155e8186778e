"""Faults of the machine: allocations and calls that fail, short reads and writes, and signals at any moment.

A command that is hit must end as the one that is not hit, or say so, leave what was there before, and leave
nothing half written; given again, it must end with the same bytes as if nothing had happened.
"""

import dataclasses
import functools
import hashlib
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import tempfile
import threading
import time

from .case import Case, scene, write
from .writing import OLD, command, place

VERBS = {"format": "scene.xp", "export": "out.glb", "reference": "out.png", "photograph": "out.exr", "render": "out.png", "bake": "", "city": "city"}
program = None  # the command line of parvis, set by script/attack
library = None  # what is preloaded


@dataclasses.dataclass
class Baseline:
    """A command that nothing happens to."""

    seconds: float
    allocations: int
    results: dict  # name and hash of each file that it writes


def prepare(folder, verb):
    """The files that the command works on; returns its arguments."""
    script = place(folder)
    if verb == "format":  # something to do, again and again
        scene(folder, pathlib.Path(script).read_text().replace(", ", " ,  "))
    elif verb not in ("bake", "city"):
        write(folder, VERBS[verb], OLD)
    return [str(word).replace(str(folder) + "/", "") for word in command(verb, script, VERBS[verb])]


def results(folder, verb):
    """Hashes of what the command wrote: its file, or all files of its folder."""
    top = pathlib.Path(folder)
    top = {"bake": top / "scene.baked", "city": top / "city"}.get(verb, top / VERBS[verb])
    files = [] if not top.exists() else [top] if top.is_file() else sorted(path for path in top.rglob("*") if path.is_file() and "/." not in str(path.relative_to(folder)))
    return {str(path.relative_to(folder)): hashlib.sha1(path.read_bytes()).hexdigest() for path in files}


_lock = threading.Lock()


@functools.lru_cache(maxsize=None)
def _baseline(verb):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="parvis-attack-"))
    try:
        arguments = prepare(folder, verb)
        count = folder / "count"
        environment = {**os.environ, "LD_PRELOAD": str(library), "PARVIS_FAULTS_COUNT": str(count)}
        began = time.monotonic()
        subprocess.run([*program, *arguments], cwd=folder, env=environment, check=True, capture_output=True)
        seconds = time.monotonic() - began
        return Baseline(seconds, int(count.read_text()) if count.exists() else 0, results(folder, verb))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def baseline(verb):
    with _lock:
        return _baseline(verb)


@functools.lru_cache(maxsize=None)
def starting_seconds():
    """Processor time until the program does what it is asked: of one that only says its version. To be asked first
    while no other command runs, whose time would be counted, too."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([*program, "--version"], check=False, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def is_whole_or_old(verb, before, folder, ran):
    """What the command left where it was hit: each file is whole, or the one that was there before; another one
    only after a warning, that a picture could not be read."""
    left = [path.name for path in pathlib.Path(folder).rglob(".*") if path.name.startswith((".partial-", ".unfinished-"))]
    if left and ran[-1]["status"] >= 0:  # else nothing could be removed; the next command does it
        return f"{left[0]} is left"
    if ran[-1]["status"] == 0 and b"warning" in ran[-1]["said"]:
        return ""
    expected, there = baseline(verb).results, results(folder, verb)
    for name, content in there.items():
        if content not in (expected.get(name), before.get(name)):
            return f"{name} is neither the result nor what was there before"
    gone = before.keys() - there.keys()
    return f"{gone.pop()} is gone" if gone else ""


def check_both(verb):
    def check(folder, ran):
        if ran[-1]["status"] == 1 and b"--restart" in ran[-1]["said"]:
            return ""  # without its texture it was another photograph, whose tiles are not lost unasked
        if ran[-1]["status"] != 0:
            return f"given again, it ends with {ran[-1]['status']}: {ran[-1]['said'].decode(errors='replace')[:200]}"
        if results(folder, verb) != baseline(verb).results:
            return "given again, it ends with another result"
        return ""

    return check


def hit(kind, name, verb, **faults):
    def build(folder):
        arguments = prepare(folder, verb)
        return [arguments, ("check", functools.partial(is_whole_or_old, verb, results(folder, verb))), arguments]

    return Case(kind, f"{verb}, {name}", build, "either", seconds=120, check=check_both(verb), needs_gl=verb in ("render", "reference", "bake"), **faults)


def failing_allocation(verb, share):
    count = baseline(verb).allocations
    if count == 0:
        raise RuntimeError(f"{verb}: no allocation is counted, so that none would fail; is {library} loaded?")
    return f"new:{max(1, round(share * count))}"


def allocations(verb, count):
    """Allocations at evenly spread places of the command's life."""
    for i in range(count):
        share = (i + 0.5) / count
        yield hit("allocation", f"at {share:.4f} of its allocations", verb,
                  faults=lambda sooner=1.0, v=verb, s=share: failing_allocation(v, sooner * s))


def kills(verb, count):
    """SIGKILL, SIGTERM and SIGINT at moments that nobody chose."""
    chance = random.Random(f"kills of {verb}")
    for i in range(count):
        share, number = chance.uniform(0.0, 1.1), (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)[i % 3]
        yield hit("kill", f"{number.name} at {share:.3f} of its time", verb, kill_after=lambda v=verb, s=share: s * baseline(v).seconds, kill_with=number)


def deaf(program):
    """A control: a stand-in that works for a second and does not listen to SIGTERM. `program` is set to it; what
    starting takes is Parvis's."""
    starting_seconds()
    program[:] = ["bash", "-c", "while :; do :; done", "control"]

    def build(folder):
        return [["format", "scene.xp"]]

    return Case("control", "deaf", build, "either", seconds=20, kill_after=lambda: 3 * starting_seconds() + 1, kill_with=signal.SIGTERM)


def cases():
    for verb, count in {"format": 150, "export": 250, "reference": 200, "photograph": 150, "render": 100, "bake": 100, "city": 50}.items():
        yield from allocations(verb, count)
    for verb, count in {"format": 20, "export": 35, "reference": 35, "photograph": 35, "render": 35, "bake": 25, "city": 15}.items():
        yield from kills(verb, count)
    for verb in VERBS:
        yield hit("calls", "short reads", verb, faults=lambda: "read:short")
        yield hit("calls", "short writes", verb, faults=lambda: "write:short")
        for call, numbers in {"write": (1, 2, 3, 5), "fsync": (1, 2, 3), "rename": (1, 2), "open": (1, 2, 3, 5, 8), "ftruncate": (1, 2), "memfd": (1, 2, 3), "fork": (1, 2)}.items():
            for number in numbers:
                yield hit("calls", f"{call} {number} fails", verb, faults=lambda c=call, n=number: f"{c}:{n}")
