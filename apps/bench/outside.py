"""What the benches share that measure the built command from outside, by other programs."""

import argparse
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PARVIS = ROOT / "build/release/apps/parvis/parvis"


class Skipped(Exception):
    """What a part needs is not there."""


def run(*words, limit_s=3000):
    """A finished program; 77 means that it skips itself."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=limit_s)
    if done.returncode == 77:
        raise Skipped((done.stdout + done.stderr).strip().splitlines()[-1])
    return done


def table(bench):
    """The keys of a bench and figures.is_met, from script/figures: {name: row of apps/bench/keys.cpp}."""
    loader = importlib.machinery.SourceFileLoader("figures", str(ROOT / "script/figures"))
    figures = importlib.util.module_from_spec(importlib.util.spec_from_loader("figures", loader))
    loader.exec_module(figures)
    return {row["name"]: row for title, rows in figures.table_of_keys() if title == bench for row in rows}, figures.is_met


def main(bench, parts):
    """Runs the parts, {name: function(figures, quick)}, which enter figures; exit status 1 where a control reaches its target."""
    parser = argparse.ArgumentParser(prog=f"script/bench {bench}")
    parser.add_argument("--quick", action="store_true", help="small files alone")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--part", choices=parts)
    arguments = parser.parse_args()
    if arguments.list:
        for name, part in parts.items():
            print(f"{bench} {name} {part.__doc__.splitlines()[0]}")
        return
    figures, failed, rows = {}, [], []
    for name in [arguments.part] if arguments.part else parts:
        print(f"{name}:", flush=True)
        try:
            parts[name](figures, arguments.quick)
        except Skipped as reason:
            print(f"  skipped: {reason}")
    print(f"{'key':<34}{'value':>10} {'target':<8} control" + ("  (the quick run)" if arguments.quick else ""))
    keys, is_met = table(bench)
    for key, row in keys.items():
        if key not in figures:
            continue
        control = row["controls"][0]
        if is_met(row, figures[control]):
            failed.append(f"{key}: its control reaches the target")
        target = ("<= " if row["kind"] == "maximum" else ">= ") + f"{row['limit']:g}"
        verdict = "" if is_met(row, figures[key]) else "MISSED"
        print(f"{key:<34}{figures[key]:>10.4g} {target:<8} {figures[control]:.4g} {verdict}  {row['shows']}")
        rows += [{"key": name, "value": figures[name]} for name in (key, control)]
    if arguments.json:
        arguments.json.write_text(json.dumps({"bench": bench, "quick": arguments.quick, "figures": figures, "keys": rows}))
    for line in failed:
        print(line, file=sys.stderr)
    sys.exit(1 if failed else 0)
