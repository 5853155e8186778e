#!/usr/bin/python3
"""The bench of shared sites: how large they are, how soon they show something, and how near that is to parvis render.

    script/bench site [--quick] [--json FILE] [--list]

It opens what the built command wrote in Chromium with a software renderer (script/site_in_browser); each key has a control that must
miss its target. Without Chromium or npm it is skipped by name.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from outside import PARVIS, ROOT, main, run

SQUARE = ROOT / "scenes/planned_square.xp"


def megabytes(folder):
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6


def city(figures, _quick):
    """The largest place that the program makes by itself."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run([PARVIS, "city", "paper", "-o", folder / "paper"], **quiet)
        scene = next((folder / "paper").glob("paper.xp"))
        subprocess.run([PARVIS, "share", scene, "-o", folder / "site"], **quiet)
        (folder / "plain").mkdir()
        subprocess.run([PARVIS, "export", scene, "-o", folder / "plain/city.glb"], **quiet)
        figures["site_mb"] = megabytes(folder / "site")
        figures["site_mb_broken"] = megabytes(folder / "plain") * 4 / 3


def square(figures, _quick):
    """A place as architects share it, in a browser."""
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        done = run(ROOT / "script/site_in_browser", PARVIS, "--json", report.name, SQUARE)
        print("\n".join("  " + line for line in done.stdout.splitlines()))
        found = json.load(open(report.name))
    figures["site_first_picture_s"], figures["site_first_picture_s_broken"] = found["first_picture_s"], found["first_picture_s_throttled"]
    figures["site_flip_to_render"] = max(each["flip"] for each in found["flips"])
    figures["site_flip_to_render_broken"] = found["flip_control"]


if __name__ == "__main__":
    main("site", {"city": city, "square": square})
