#!/usr/bin/python3
"""Writes the man page and the shell completion of the command from what its --help says.

    packaging/package_texts.py build/release/apps/parvis/parvis FOLDER
"""
import gzip
import pathlib
import re
import subprocess
import sys


def help_of(parvis, *words):
    return subprocess.run([parvis, *words, "--help"], capture_output=True, text=True, check=True).stdout


def subcommands(text):
    """[(name, what it does)] of a help text."""
    part = re.search(r"^Subcommands:\n((?:  .*\n|\s*\n)+)", text, re.M)
    return re.findall(r"^  (\S+)\s+(.*)$", part[1], re.M) if part else []


def options(text):
    """Long options of a help text."""
    return sorted(set(re.findall(r"(?<![\w-])(--[a-z][a-z0-9-]*)", text)))


def roff(text):
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^(['.])", r"\\&\1", escaped, flags=re.M)


def man_page(parvis, version):
    text = help_of(parvis)
    lines = [f'.TH PARVIS 1 "" "Parvis {version}"', ".SH NAME", "parvis \\- shows a city square before it changes", ".SH SYNOPSIS",
             ".B parvis", ".I SUBCOMMAND", "[\\fIOPTIONS\\fR]", ".SH DESCRIPTION",
             roff("Parvis shows places as they are and as they are planned to be. A scene is a script (.xp); its language stands in the "
                  "documents of the project. Each subcommand says by --help what it takes, and gives an example. Exit status: 0 done, "
                  "1 failed, 2 bad usage."), ".SH SUBCOMMANDS"]
    for name, what in subcommands(text):
        lines += [f".SS {name}", roff(what), ".PP", ".nf", roff(help_of(parvis, name).split("\n", 1)[1].strip()), ".fi"]
    lines += [".SH FILES", ".TP", ".I /usr/share/parvis/scenes", "Scenes to begin with: \\fBparvis view /usr/share/parvis/scenes/planned_square.xp\\fR"]
    return "\n".join(lines) + "\n"


def completion(parvis):
    names = [name for name, _ in subcommands(help_of(parvis))]
    cases = "\n".join(f'    {name}) options="{" ".join(options(help_of(parvis, name)))}" ;;' for name in names)
    return f"""# Completion of parvis for bash: subcommands, their options, and files.
_parvis() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{' '.join(names)} --help --version" -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{cases}
  esac
  if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "$options" -- "$word")); fi
}}
complete -o default -F _parvis parvis
"""


def main():
    parvis, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([parvis, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    # No time of day in it: the same program gives the same bytes.
    (folder / "parvis.1.gz").write_bytes(gzip.compress(man_page(parvis, version).encode(), mtime=0))
    (folder / "parvis").write_text(completion(parvis))


if __name__ == "__main__":
    main()
