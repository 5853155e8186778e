"""A case: files in a scene's folder, commands on them, and what must hold afterwards."""

import dataclasses
import pathlib
import typing

SECRET = b"PARVIS-SECRET-OUTSIDE-7f3a-"  # in files outside of the scene's folder: nothing of it may get out


@dataclasses.dataclass
class Case:
    """`build(folder)` writes files into the scene's folder and returns the commands, lists of arguments."""

    kind: str
    name: str
    build: typing.Callable[[pathlib.Path], list]
    expects: str = "either"  # "refused": status 1 or 2 with a message; "done": status 0; "either" of them
    seconds: float = 60.0
    before: list = dataclasses.field(default_factory=list)  # a command line that the program is run by
    file_limit: int = 0  # bytes that a file may have, as on a full disk; 0: no limit
    check: typing.Callable = None  # check(folder, results) -> problem or ""
    needs_gl: bool = False
    says: str = ""  # what one of the commands must say
    faults: typing.Callable = None  # what PARVIS_FAULTS says while the first command runs (cmake/faults.cpp)
    kill_after: typing.Callable = None  # seconds after which the first command gets a signal
    kill_with: int = 0


CAMERA = 'camera(name="eye", position="0 -9 2", target="0 0 1")\n'


def scene(folder, text, name="scene.xp"):
    """Writes a script; returns its path."""
    return write(folder, name, text)


def write(folder, name, content):
    """Writes a file of text or bytes; returns its path as text."""
    path = pathlib.Path(folder) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return str(path)


def model_case(kind, name, file, content, expects="either", extra=None, attributes="", **more):
    """A model file in a right scene: checked, and exported."""

    def build(folder):
        for other, other_content in (extra or {}).items():
            write(folder, other, other_content)
        write(folder, file, content() if callable(content) else content)
        script = scene(folder, f'model(file="{file}"{attributes})\n' + CAMERA)
        return [["export", script, "-o", "out.glb"]]

    return Case(kind, name, build, expects, **more)
