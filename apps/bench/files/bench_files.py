#!/usr/bin/python3
"""The bench of files from the field: what is read of them, and what is said of the rest.

    script/bench files [--quick] [--json FILE] [--list] [--part PART]

Its parts measure the built command from outside, by other readers than its own; each key has a control that must miss its target.
Parts that lack a program or data are skipped by name.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from outside import PARVIS, ROOT, Skipped, main, run

HERE = pathlib.Path(__file__).resolve().parent
SECOND = ROOT / "script/second_readers"
DATA = next((folder for folder in (ROOT / "../shared/data", ROOT / "shared/data") if folder.is_dir()), None)


def judged(figures, quick):
    """The folders of reports, and the same with broken scenes."""
    if DATA is None:
        raise Skipped("the shared data is absent")
    with tempfile.TemporaryDirectory() as folder:
        for key, words in (("reports_right", []), ("reports_right_broken", ["--broken"])):
            out = pathlib.Path(folder) / key
            run(HERE / "judge_reports.py", PARVIS, DATA / "reports", *words, "--json", out)
            result = json.loads(out.read_text())
            figures[key] = result["right"]
            for name, wrong in result["wrong"].items():
                if bool(wrong) != bool(words):
                    print(f"  {key}: {name}: {wrong[0] if wrong else 'right though it is broken'}")


def valid_files(quick):
    """Every valid model file of the project and of the shared data that a second reader may know, the smallest first."""
    endings = (".gltf", ".glb", ".obj", ".ply", ".stl", ".ifc", ".wrl", ".iv", ".json", ".gml", ".osm", ".tif")
    places = [ROOT / "scenes", *ROOT.glob("src/formats/*/fuzz/corpus")]
    if DATA is not None:
        places += [DATA / name for name in ("cars", "cities", "gltf_animated", "gltf_kenney", "photos_sceaux", "reflectors", "reports")]
    found = [path for place in places for path in sorted(place.rglob("*")) if path.suffix.lower() in endings and path.is_file()]
    found = [path for path in found if path.suffix != ".json" or '"CityJSON"' in path.read_text(errors="replace")[:2000]]
    found.sort(key=lambda path: path.stat().st_size)
    return [path for path in found if path.stat().st_size < 300_000] if quick else found


def second_readers(figures, quick):
    """Objects of every valid file against other libraries; controls lose a triangle of each object, or stretch them."""
    files = valid_files(quick)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        for control, chosen in (("", files), ("loss", files[:60]), ("size", files[:60])):
            run(SECOND, PARVIS, "--json", out, *(["--control", control] if control else []), *chosen)
            found = json.loads(out.read_text())
            result, rows = found["figures"], found["rows"]
            known = result["objects"] - result["explained"]
            agree = 100 * result["agree"] / known if known else 0
            if control == "loss":
                figures["silent_losses_of_valid_files_broken"] = result["silent"]
                figures["readers_without_account_broken"] = result["without_account"]
            elif control == "size":
                figures["second_readers_agree_percent_broken"] = agree
            else:
                figures["silent_losses_of_valid_files"] = result["silent"]
                figures["readers_without_account"] = result["without_account"]
                figures["second_readers_agree_percent"] = agree
                print(f"  {result['files']} files, {result['objects']} objects, {result['explained']} differ for a known reason")
                for row in rows:
                    if row["missing"] or row["unnamed"] or row["note"]:
                        print(f"  {row['file']}: {len(row['missing'])} of {row['objects']} differ {' '.join(row['unnamed'])} {row['note']}")


def written_today(figures, quick):
    """glTF that other programs write of our models: read as they meant it, or named."""
    with tempfile.TemporaryDirectory() as folder:
        done = run(ROOT / "script/written_today", PARVIS, folder, ROOT / "scenes/bare_saloon.glb")
        made = [pathlib.Path(line) for line in done.stdout.split()]
        if not made:
            raise Skipped("no program wrote a file")
        out = pathlib.Path(folder) / "out.json"
        for key, words in (("gltf2026_read_or_named", []), ("gltf2026_read_or_named_broken", ["--control", "loss"])):
            run(SECOND, PARVIS, "--json", out, *words, *made)
            rows = json.loads(out.read_text())["rows"]
            good = [row for row in rows if row["objects"] and not row["missing"] and not row["unnamed"]]
            figures[key] = 100 * len(good) / len(rows)
            for row in rows:
                if not words and row not in good:
                    print(f"  {pathlib.Path(row['file']).name}: {len(row['missing'])} of {row['objects']} differ {' '.join(row['unnamed'])} {row['note']}")
        print(f"  {len(made)} files; Blender's exporter is not tried: Debian's is of 2022")


def load_times(figures, quick):
    """How long check takes, beside another build, in turns; the control loads the larger file for the smaller."""
    other = os.environ.get("PARVIS_4BFB91EA", "")
    if not other or not os.access(other, os.X_OK):
        raise Skipped("PARVIS_4BFB91EA does not name the program of 4bfb91ea")
    if DATA is None:
        raise Skipped("the shared data is absent")
    print("  a PBF of 40 MB is not tried: none is among the data")
    ratios, control = [], []
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "one.xp"

        def seconds(program, file):
            scene.write_text(f'model(file="{file.name}")\n')
            began = time.perf_counter()
            subprocess.run([program, "check", scene, "--data", file.parent], capture_output=True, check=True)
            return time.perf_counter() - began

        files = [DATA / "cities/DenHaag_01.city.json", DATA / "cars/p406/p406.obj"]
        for file in files:
            for _ in range(3 if quick else 9):
                ratios.append((file.name, seconds(PARVIS, file) / seconds(other, file)))
        for _ in range(3):
            control.append(seconds(PARVIS, files[0]) / seconds(other, files[1]))
    figures["load_ms_ratio_to_4bfb91ea"] = max(statistics.median(r for n, r in ratios if n == file.name) for file in files)
    figures["load_ms_ratio_to_4bfb91ea_broken"] = statistics.median(control)


PARTS = {"reports": judged, "second_readers": second_readers, "written_today": written_today, "load_times": load_times}


if __name__ == "__main__":
    main("files", PARTS)
