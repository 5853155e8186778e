"""What Parvis keeps beside a scene, changed by somebody else."""

import struct

from .case import Case
from .writing import place


def content_hash(data):
    """The checksum of sealed files (base/content_hash.h), so that a change is not found by it."""
    state, mask = 0x243F6A8885A308D3, 2**64 - 1

    def mix(state, word):
        state = ((state ^ word) * 0x9E3779B97F4A7C15) & mask
        return state ^ (state >> 32)

    state = mix(state, len(data))
    whole = len(data) // 8 * 8
    for word in struct.unpack(f"<{whole // 8}Q", data[:whole]):
        state = mix(state, word)
    state = mix(state, int.from_bytes(data[whole:], "little"))
    return state ^ (state >> 29)


BOUNCED = 'dayLight(timeOfDay=13)\nbouncedLight(rays=16)\n'


def changed(name, pattern, change, nodes=""):
    """Bakes, changes each file that is kept, and renders again."""

    def build(folder):
        script = place(folder)
        with open(script, "a") as scene:
            scene.write(nodes)
        render = ["render", script, "--size", "32x32", "-o", "out.png"]
        return [["bake", script], ("change", pattern, change), render, ["bake", script]]

    return Case("cache", name, build, "done", needs_gl=True)


def cut(share):
    return lambda content: content[: int(len(content) * share)]


def flipped(at):
    return lambda content: content[:at] + bytes([content[at] ^ 0xff]) + content[at + 1:] if at < len(content) else content


def resealed(at, value):
    """Another value in the content, with a right checksum."""

    def change(content):
        body = content[:-8]
        if at + len(value) > len(body):
            return content
        body = body[:at] + value + body[at + len(value):]
        return body + struct.pack("<Q", content_hash(body))

    return change


def cases():
    for pattern, nodes in (("*.map", ""), ("*.reflector", ""), ("*.transfer", BOUNCED)):
        for share in (0, 0.01, 0.5, 0.99):
            yield changed(f"{pattern} cut to {share}", pattern, cut(share), nodes)
        for at in (0, 7, 8, 9, 16, 20, 24, 40, 100):
            yield changed(f"{pattern} byte {at}", pattern, flipped(at), nodes)
        for at in range(8, 72, 4):
            for value in (b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\0"):
                yield changed(f"{pattern} {value[3]:02x} at {at}, sealed", pattern, resealed(at, value), nodes)
