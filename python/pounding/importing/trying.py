"""Tries every deck of a folder, each in a process of its own with limits of time and memory, and writes what became of
it: read, read with losses, or refused and why."""

import multiprocessing
import os
import re
import resource
import signal
import stat
from collections import Counter
from pathlib import Path

from pounding.tables import write_rows

from .cards import split_lines
from .formats import FORMATS, read
from .model import InputFault
from .nastran_lines import holds_mass
from .scene import Scene
from .units import in_si
from .weighing import weigh

FORKS = multiprocessing.get_context("fork")
MEMORY = 4 << 30  # bytes of a process
HEAD = 1 << 18  # bytes at the beginning of a file that tell what it is
COLUMNS = ("file", "format", "mass", "outcome", "nodes", "elements", "kilograms", "losses", "reason")
# First cards of a deck. Endings are shared: .inp and .dat are those of several programs.
BEGINNINGS = (
    ("dyna", r"\s*\*KEYWORD"), ("sap2000", r'\s*TABLE:\s*"'),
    ("abaqus", r"\*(?:HEADING|NODE|ELEMENT|PART|ASSEMBLY|INCLUDE|MATERIAL|NSET|ELSET|PARAMETER)\b"),
    ("ansys", r"(?:/PREP7|NBLOCK,|EBLOCK,|/COM,ANSYS|ET,\s*\d)"), ("unv", r" {4}-1\s*$"),
    ("nastran", r"\s*(?:BEGIN\s+BULK|CEND\s*$|SOL\s+\w|GRID\*?[ ,]|C(?:QUAD|TRIA|HEXA|TETRA|BAR|BEAM|ROD)[0-9R]?\*?[ ,]"
                r"|INCLUDE\s+')"))
# Cards that give a mass, where the reader itself does not tell.
MASSES = {"abaqus": r"\s*\*\s*(?:DENSITY|MASS|NONSTRUCTURAL)", "ansys": r"(?:MP|MPDATA|R5\.0)?.*,\s*DENS\b|.*\bMASS21\b",
          "dyna": r"\*(?:MAT_|ELEMENT_MASS)", "sap2000": r".*(?:UnitMass|Mass1|MassPerLen)\s*=\s*[^0\s]"}


def format_of(path: Path) -> str | None:
    """What a file is by its first cards, or by its ending where these are no text; None where it is no deck."""
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            return None
        with open(path, "rb") as file:
            head = file.read(HEAD)
    except OSError:
        return None
    ending = path.suffix.lower()
    if head.startswith(b"\x89HDF"):
        return "med" if ending in FORMATS["med"][1] else None
    if b"\0" in head:
        return None
    found = None
    for line in split_lines(head.decode("latin-1")):
        kind = next((kind for kind, begin in BEGINNINGS if re.match(begin, line, re.IGNORECASE)), None)
        if kind == "dyna" or (kind and found is None):
            found = kind
        if found and found != "abaqus":  # *NODE is a card of LS-DYNA as well, below *KEYWORD
            break
    known = [name for name, (_, endings) in FORMATS.items() if ending in endings]
    shared = {".inp": ("abaqus", "nastran", "ansys"), ".dat": ("nastran", "abaqus", "ansys")}
    return found if found in (*known, *shared.get(ending, ())) else None


def has_mass(path: Path, kind: str) -> str:
    """Whether a deck holds elements of a structure and a mass: `yes` or `no`, `?` where that cannot be seen."""
    try:
        if kind == "nastran":
            return "yes" if holds_mass(path) else "no"
        if kind in MASSES:
            text = path.read_bytes().decode("latin-1")
            return "yes" if any(re.match(MASSES[kind], line, re.IGNORECASE) for line in split_lines(text)) else "no"
    except Exception:  # noqa: BLE001: what is wrong with the deck the reader says
        pass
    return "?"


def outcome_of(path: Path, kind: str, units) -> dict:
    """What the reader makes of a deck."""
    found = {"mass": has_mass(path, kind), "outcome": "refused"}
    try:
        model = read(path, kind)
        in_si(model, units)
        lost = model.cards.lost
        try:
            scene = Scene(model, "tried")
            found["kilograms"] = f"{weigh(model)[0]:.6g}" if model.has_properties else ""
            scene.mesh.text(model.nodes)
            found |= {"outcome": "read with losses" if lost else "read", "nodes": len(scene.joints.used),
                      "elements": len(model.elements)}
        except InputFault as fault:
            found["reason"] = str(fault)
        found["losses"] = ", ".join(f"{card} {count}" for card, count in sorted(lost.items()))
    except InputFault as fault:
        found["reason"] = str(fault)
    except MemoryError:
        found["reason"] = f"more memory than {MEMORY >> 30} GB"
    except Exception as error:  # noqa: BLE001: a table of faults is what this is for
        found |= {"outcome": "fault", "reason": f"{type(error).__name__}: {error}"}
    return found


def _in_child(path: Path, kind: str, units, seconds: float) -> dict:
    """`outcome_of` in a fork that ends with its limits."""
    source, target = FORKS.Pipe(duplex=False)

    def try_it() -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        target.send(outcome_of(path, kind, units))

    child = FORKS.Process(target=try_it)
    child.start()
    target.close()
    try:
        return source.recv() if source.poll(seconds) else {"outcome": "refused", "reason": f"not read within {seconds:g} s"}
    except (EOFError, OSError):
        return {"outcome": "fault", "reason": "the process ended without a word"}
    finally:
        source.close()
        child.kill()
        child.join()


def _kind_of_reason(row: dict) -> str:
    """A reason without file, line and numbers, by which the same ones are counted."""
    text = re.sub(r"^\S.*? line \d+: |^\S+: ", "", row.get("reason", ""))
    return re.sub(r"'[^']*'", "'...'", re.sub(r"\d[\d.e+-]*", "#", text))


def _told(rows: list) -> None:
    outcomes = Counter(row["outcome"] for row in rows)
    print(f"tried {len(rows)}: " + ", ".join(f"{name} {outcomes[name]}" for name in (
        "read", "read with losses", "refused", "fault") if outcomes[name]))
    for kind in sorted({row["format"] for row in rows}):
        own = [row for row in rows if row["format"] == kind]
        heavy = [row for row in own if row.get("mass") != "no"]
        taken = sum(row["outcome"].startswith("read") for row in heavy)
        print(f"  {kind}: {len(own)}, with elements and mass {len(heavy)}, of these read {taken}"
              + (f" ({100 * taken / len(heavy):.0f} %)" if heavy else ""))
    for title, words in (("losses", (re.sub(r" \d+$", "", word) for row in rows if row["outcome"] == "read with losses"
                                     for word in row["losses"].split(", "))),
                         ("refused", (_kind_of_reason(row) for row in rows if not row["outcome"].startswith("read")))):
        found = Counter(words).most_common(20)
        if found:
            print(f"{title}:")
            print("\n".join(f"  {count:4d}  {word}" for word, count in found))


def try_folder(folder: Path, table: Path, units, seconds: float = 60.0) -> None:
    """Writes the table, a row for each deck below a folder, and prints what is in it. Throws InputFault."""
    if not folder.is_dir():
        raise InputFault(f"{folder}: no such folder")
    rows = []
    for path in sorted(path for path in folder.rglob("*") if not path.is_symlink()):
        kind = format_of(path)
        if kind:
            name = os.fsencode(path.relative_to(folder)).decode("utf-8", "backslashreplace")
            name = "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in name)
            row = {"file": name, "format": kind, **_in_child(path, kind, units, seconds)}
            rows.append(row)
            print(f"{row['file']}: {row['outcome']}" + (f": {row['reason']}" if row.get("reason") else ""), flush=True)
    if not rows:
        raise InputFault(f"{folder}: no deck in it")
    write_rows(table, COLUMNS, ([row.get(name, "") for name in COLUMNS] for row in rows))
    _told(rows)
    print(f"wrote {table}")
