#!/usr/bin/python3
"""Man pages of the programs, and completion for bash, from what their -help says: manual.py BUILD VERSION DIR.

Options come from the help, which the program makes of its table of options; there is no second list. On a machine
that the programs of BUILD are not for, it says so and makes none. DIR/made is written at the end in any case.
"""

import re
import subprocess
import sys
from pathlib import Path

SEE = {"pounding": "pounding-spectra", "pounding-spectra": "pounding", "pounding-mesh": "pounding"}
FILES = [("resolved.yaml", "all options in force"), ("summary.json", "every number of the run"),
         ("history.h5", "motion of the probes"), ("impacts.csv, energy.csv, spectra.csv", "tables"),
         ("checkpoint.h5", "the state of the run, to continue it")]
MESH = """This program makes or opens one mesh with Gmsh for pounding(1), which starts it from the folder in which it lies
itself. It is not run by hand: it can read files and answer, and nothing else."""


def escaped(text: str) -> str:
    """Text for troff, where a line may begin with any character."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text.startswith((".", "\\(aq")) else text


def header(name: str, version: str, what: str) -> list[str]:
    return [f'.TH {name.upper()} 1 "" "pounding {version}" "User commands"', ".SH NAME", escaped(f"{name} - {what}")]


def footer(name: str) -> list[str]:
    pages = "/usr/share/doc/pounding/docs"
    return [".SH SEE ALSO", f"{escaped(SEE[name])}(1), pages in", f".I {pages}"]


class Option:
    """A line of the help: names before their texts."""

    def __init__(self, name: str, argument: str, text: str):
        self.name, self.argument, self.text = name, argument, text

    def words(self) -> list[str]:
        """What may follow."""
        found = re.search(r"one of ([\w|]+)", self.text)
        if found:
            return found[1].split("|")
        return ["true", "false"] if self.argument == "flag" else []

    def troff(self) -> list[str]:
        argument = f" \\fI{escaped(self.argument)}\\fR" if self.argument else ""
        return [".TP", f"\\fB{escaped(self.name)}\\fR{argument}", escaped(self.text)]


def read_pounding(text: str):
    """Name, usage, words before the options, blocks of options by title, names that pass through."""
    head, usage, about, *blocks = text.rstrip("\n").split("\n\n")
    found, passed = {}, []
    for block in blocks:
        title, *lines = block.split("\n")
        if title.startswith("Options of PETSc"):
            passed = " ".join(lines).split()
            continue
        found[title] = []
        for line in lines:
            name, unit, help_text = re.fullmatch(r"  (-\S+) +\[(.*?)\] +(.*)", line).groups()
            found[title].append(Option(name, unit, help_text))
    return head.partition(": ")[2], usage, about, found, passed


def pounding_page(text: str, version: str) -> list[str]:
    what, usage, about, blocks, passed = read_pounding(text)
    page = header("pounding", version, what) + [".SH SYNOPSIS", ".nf"]
    page += [escaped(line.strip()) for line in usage.split("\n")] + [".fi", ".SH DESCRIPTION"]
    page += [escaped(line) for line in about.split("\n")] + [".SH OPTIONS"]
    for title, options in blocks.items():
        page.append(f".SS {escaped(title)}")
        for option in options:
            page += option.troff()
    page += [".SS Options of PETSc and SLEPc that pass through", escaped(" ".join(passed))]
    page += [".SH EXIT STATUS", "0, 1 after an error, which is one line, 2 when a signal ended the run after a checkpoint.",
             ".SH FILES", "In the folder of", ".BR \\-output :"]
    for name, content in FILES:
        page += [".TP", f".I {escaped(name)}", escaped(content)]
    return page + footer("pounding")


def read_spectra(text: str):
    """Name, usage, words before the options, options, words behind them."""
    head, usage, about, body, *tail = text.rstrip("\n").split("\n\n")
    options = []
    for line in body.split("\n"):
        found = re.fullmatch(r"  (--\S+)( \S+)?(?: {2,}(.*))?", line)
        if found:
            options.append(Option(found[1], (found[2] or "").strip(), found[3] or ""))
        else:
            options[-1].text += (" " if options[-1].text else "") + re.sub(r"  +", ": ", line.strip())
    return head.partition(": ")[2], usage.strip(), about, options, tail


def spectra_page(text: str, version: str) -> list[str]:
    what, usage, about, options, tail = read_spectra(text)
    page = header("pounding-spectra", version, what) + [".SH SYNOPSIS", escaped(usage), ".SH DESCRIPTION"]
    page += [escaped(line) for line in about.split("\n")] + [".SH OPTIONS"]
    for option in options:
        page += option.troff()
    for paragraph in tail:
        title, _, words = paragraph.partition(": ")
        page += [f".SH {title.upper()}", escaped(words)]
    return page + footer("pounding-spectra")


def mesh_page(version: str) -> list[str]:
    return (header("pounding-mesh", version, "makes the meshes of pounding") +
            [".SH DESCRIPTION", *map(escaped, MESH.split("\n"))] + footer("pounding-mesh"))


def completion(run: str, spectra: str) -> str:
    """Functions of bash. Names of the user's are completed by what follows them: -left_ by -left_mesh and its like."""
    options = [option for block in read_pounding(run)[3].values() for option in block]
    names = sorted(option.name for option in options if "<" not in option.name) + ["-options_file", "-help", "-version"]
    ends = sorted({re.sub(r".*>", "", option.name) for option in options if "<" in option.name} - {""})
    follow = {option.name: option for option in options if "<" not in option.name and option.words()}
    of_spectra = read_spectra(spectra)[3]
    cases = "".join(f"    {name}) words='{' '.join(option.words())}' ;;\n" for name, option in follow.items())
    return f"""# Completion of pounding's options for bash, made of its -help.
_pounding() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} words='' end at
  COMPREPLY=()
  case $previous in
{cases}  esac
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W '{' '.join(names)}' -- "$current"))
    [ "${{#COMPREPLY[@]}}" -gt 0 ] || for end in {' '.join(ends)}; do
      for ((at = 2; at < ${{#current}}; at++)); do
        [[ ${{current:at:1}} == _ && $end == "${{current:at}}"* ]] && COMPREPLY+=("${{current:0:at}}$end")
      done
    done
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
_pounding_spectra() {{
  local current=${{COMP_WORDS[COMP_CWORD]}}
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W '{' '.join(option.name for option in of_spectra)}' -- "$current"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -F _pounding pounding
complete -F _pounding_spectra pounding-spectra
"""


def help_of(program: Path) -> str:
    done = subprocess.run([program, "-help"], capture_output=True, text=True, check=False)
    if done.returncode != 0 or not done.stdout:
        raise OSError(f"{program.name} does not run here")
    return done.stdout


def main(build: Path, version: str, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    try:
        run, spectra = help_of(build / "pounding"), help_of(build / "pounding-spectra")
    except OSError as error:
        print(f"manual: {error}: no man pages and no completion", file=sys.stderr)
    else:
        pages = {"pounding": pounding_page(run, version), "pounding-spectra": spectra_page(spectra, version),
                 "pounding-mesh": mesh_page(version)}
        for name, lines in pages.items():
            (folder / f"{name}.1").write_text("\n".join(lines) + "\n")
        for name in ("pounding", "pounding-spectra"):  # bash looks for a file by the command's name
            (folder / name).write_text(completion(run, spectra))
    (folder / "made").touch()


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]))
