#!/usr/bin/python3
"""The bench of shared sites: how large they are, how soon they show something, and how near that is to parvis render.

    script/bench site [--quick] [--json FILE] [--list]

It opens what the built command wrote in Chromium with a software renderer (script/site_in_browser); each key has a control that must
miss its target. Without Chromium or npm it is skipped by name.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent.parent
PARVIS = ROOT / "build/release/apps/parvis/parvis"
SQUARE = ROOT / "scenes/planned_square.xp"

# key: (unit, target as text, whether a value reaches it, what it shows)
KEYS = {
    "site_mb": ("MB", "<= 25", lambda v: v <= 25, "the paper's city as a site, all files; control: its export as files, in base 64"),
    "site_first_picture_s": ("s", "<= 5", lambda v: v <= 5, "the planned square from a double click to its first picture, median of five; control: a processor 20 times as slow"),
    "site_flip_to_render": ("", "<= 0.1", lambda v: v <= 0.1, "the planned square, every view in every scenario against parvis render, the largest; control: three hours later"),
}


def megabytes(folder):
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6


def city(figures):
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


def square(figures):
    """A place as architects share it, in a browser."""
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        done = subprocess.run([ROOT / "script/site_in_browser", PARVIS, "--json", report.name, SQUARE], capture_output=True, text=True)
        if done.returncode == 77:
            print("  " + done.stdout.strip())
            return
        print("\n".join("  " + line for line in done.stdout.splitlines()))
        found = json.load(open(report.name))
    figures["site_first_picture_s"], figures["site_first_picture_s_broken"] = found["first_picture_s"], found["first_picture_s_throttled"]
    figures["site_flip_to_render"] = max(each["flip"] for each in found["flips"])
    figures["site_flip_to_render_broken"] = found["flip_control"]


def main():
    parser = argparse.ArgumentParser(prog="script/bench site")
    parser.add_argument("--quick", action="store_true", help="the same: a site has no shorter run")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    parts = {"city": city, "square": square}
    if arguments.list:
        for name, part in parts.items():
            print(f"site {name} {part.__doc__.splitlines()[0]}")
        return
    figures, failed, rows = {}, [], []
    for name, part in parts.items():
        print(f"{name}:", flush=True)
        part(figures)
    print(f"{'key':<24}{'value':>10} {'target':<8} control")
    for key, (unit, target, reaches, shows) in KEYS.items():
        if key not in figures:
            continue
        broken = figures[f"{key}_broken"]
        if reaches(broken):
            failed.append(f"{key}: its control reaches the target")
        print(f"{key:<24}{figures[key]:>10.4g} {target:<8} {broken:.4g} {'' if reaches(figures[key]) else 'MISSED'}  {shows}")
        rows.append({"key": key, "value": figures[key], "unit": unit, "target": target, "control": broken, "shows": shows})
    if arguments.json:
        arguments.json.write_text(json.dumps({"bench": "site", "quick": arguments.quick, "figures": figures, "rows": rows}))
    for line in failed:
        print(line, file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
