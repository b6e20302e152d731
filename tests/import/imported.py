"""Imports decks that tests write, and compares the scenes with the same models written by hand."""
import importlib
import json
import os
import re
import runpy
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy  # noqa: F401: for the forks
import program
import scipy.spatial  # noqa: F401

sys.dont_write_bytecode = True
COMMAND = Path(program.SOURCE) / "run" / "import"
PACKAGE = COMMAND.parents[1] / "python"
sys.path[:0] = [str(PACKAGE), str(COMMAND.parent)]
for module in sorted((PACKAGE / "pounding" / "importing").glob("[a-z]*.py")):  # once, and not in each fork
    importlib.import_module(f"pounding.importing.{module.stem}")
TYPES = {"point": 15, "line": 1, "triangle": 2, "quadrangle": 3, "tetrahedron": 4, "brick": 5, "wedge": 6}
DIMENSIONS = {"point": 0, "line": 1, "triangle": 2, "quadrangle": 2, "tetrahedron": 3, "brick": 3, "wedge": 3}


def of_file(name, content):
    """A file in a folder of its own."""
    path = Path(tempfile.mkdtemp(prefix="pounding-import-")) / name
    path.write_bytes(content) if isinstance(content, bytes) else path.write_text(content)
    return path


def command(path, units, *words):
    """run/import of a file into its folder, without modes: in a fork of this process, which has numpy and scipy already
    and so takes a tenth of the time."""
    line = ["run/import", path, path.parent / "out", "--units", units, "--modes", 0, *words]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        sys.stdout.flush()
        sys.stderr.flush()
        child = os.fork()
        if child == 0:
            status = 99
            try:
                os.dup2(out.fileno(), 1)
                os.dup2(err.fileno(), 2)
                sys.stdout, sys.stderr = os.fdopen(1, "w", closefd=False), os.fdopen(2, "w", closefd=False)
                sys.argv = list(map(str, line))
                runpy.run_path(str(COMMAND), run_name="__main__")
                status = 0
            except SystemExit as error:
                status = error.code if isinstance(error.code, int) else 1 if error.code else 0
            except BaseException:  # as the interpreter would
                sys.excepthook(*sys.exc_info())
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        out.seek(0)
        err.seek(0)
        return subprocess.CompletedProcess(line, status, out.read(), err.read())


def imported(test, name, content, units="m,kg,s", *words):
    """The scene of a deck, and what the command said."""
    path = of_file(name, content)
    done = command(path, units, *words)
    test.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
    return path.parent / "out" / f"{path.stem.lower()}.yaml", done.stdout


def refused(test, name, content, *parts, units="m,kg,s", words=()):
    """One line, exit status 1, and nothing written; returns what was said before it."""
    path = of_file(name, content)
    done = command(path, units, *words)
    test.assertEqual(done.returncode, 1, done.stdout + done.stderr)
    test.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
    test.assertTrue(done.stderr.startswith("run/import: "), done.stderr)
    for part in parts:
        test.assertIn(part, done.stderr)
    test.assertFalse((path.parent / "out").exists())
    return done.stdout


def by_hand(nodes, groups, options):
    """A scene of one structure `t` as the program's words: nodes by number, groups name -> (shape, cells), options of
    the structure and others, which begin with -."""
    cells = [(shape, cell, number) for number, (shape, members) in enumerate(groups.values(), 1) for cell in members]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
    lines += [f'{DIMENSIONS[shape]} {number} "{name}"' for number, (name, (shape, _)) in enumerate(groups.items(), 1)]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{number} " + " ".join(map(repr, map(float, x))) for number, x in nodes.items()]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{place} {TYPES[shape]} 2 {number} {number} " + " ".join(map(str, cell))
              for place, (shape, cell, number) in enumerate(cells, 1)]
    mesh = of_file("hand.msh", "\n".join([*lines, "$EndElements", ""]))
    words = ["-structures", "t", "-t_mesh", mesh]
    for name, value in options.items():
        words += [name if name.startswith("-") else f"-t_{name}", value]
    return words


def steel(name="steel"):
    return {f"-material_{name}_young": 2.1e11, f"-material_{name}_poisson": 0.3, f"-material_{name}_density": 7850}


def section(name, area, inertia_y, inertia_z, torsion, z_axis, shear=None):
    words = {"area": area, "inertia_y": inertia_y, "inertia_z": inertia_z, "torsion": torsion, "z_axis": z_axis}
    if shear:
        words["shear_area"] = shear
    return {f"-section_{name}_{key}": value for key, value in words.items()}


def structure(test, words, ranks=1, modes=10):
    """What summary.json has of the only structure of a scene."""
    words = ["-options_file", words] if isinstance(words, Path) else list(words)
    words += ["-end_time", 1e-12, "-modes", modes, "-lowest_eps_tol", 1e-14]
    return next(iter(program.must_run(test, words, ranks)[1]["structures"].values()))


def frequencies(found):
    return [mode["frequency"] for mode in found["frequencies"]]


def same(test, scene, words, tolerance=1e-9, modes=10, ranks=1):
    """Mass and modes of the imported scene are those of the one by hand; returns the former's summary."""
    one, other = structure(test, scene, ranks, modes), structure(test, words, 1, modes)
    test.assertLess(abs(one["mass"] / other["mass"] - 1), 1e-12)
    test.assertEqual(one["dofs"], other["dofs"])
    found, expected = frequencies(one), frequencies(other)
    test.assertEqual(len(found), len(expected))
    test.assertGreater(expected[0], 0.01)
    for number, (value, reference) in enumerate(zip(found, expected), 1):
        test.assertLess(abs(value - reference), tolerance * max(reference, 1e-3), f"mode {number}: {value}, "
                                                                                  f"{reference}")
    return one


def said_mass(text):
    """Mass [kg] and centre of gravity [m] that the command prints."""
    found = re.search(r"mass (\S+) kg.*centre of gravity (\S+), (\S+), (\S+) m", text)
    return float(found[1]), tuple(map(float, found.groups()[1:]))


def close(test, found, expected, tolerance=2e-6):
    for value, reference in zip(found, expected):
        test.assertLess(abs(value - reference), tolerance * max(1.0, abs(reference)), (found, expected))


def damaged(text, rng):
    """A text with a line or two of it changed, cut, repeated or lost."""
    lines = text.splitlines()
    for _ in range(rng.randint(1, 2)):
        at = rng.randrange(len(lines))
        line, way = lines[at], rng.randrange(5)
        place = rng.randrange(len(line) + 1)
        if way == 0:
            lines[at] = rng.choice(lines)
        elif way == 1:
            lines[at] = line[:place]
        elif way == 2:
            lines[at] = line[:place] + rng.choice("0123456789.,-+eE *$!=") + line[place + 1:]
        elif way == 3:
            lines[at] = line[:place] + rng.choice(["0", "-1", "99999999999", "zz", ",", " "]) + line[place:]
        else:
            lines = lines[:at + 1]
    return "\n".join(lines) + "\n"


def survives(name, texts):
    """What no reader may say of texts of a format, in a process of its own: faults other than one line with the file's
    name, and texts that take more than 10 s."""
    script = ("import json, signal, sys, traceback\nfrom pathlib import Path\nsys.dont_write_bytecode = True\n"
              f"sys.path.insert(0, {str(PACKAGE)!r})\n"
              "from pounding.importing.formats import read\nfrom pounding.importing.model import InputFault\n"
              "from pounding.importing.scene import Scene\n"
              "from pounding.importing.units import in_si, units_of\nfrom pounding.importing.weighing import weigh\n"
              "path, texts, found = Path(sys.argv[1]), json.load(sys.stdin), []\n"
              "for text in texts:\n    path.write_text(text)\n    signal.alarm(10)\n    told = ''\n"
              "    try:\n        model = read(path, None)\n        in_si(model, units_of('mm,t,s'))\n"
              "        try:\n            Scene(model, 'm').mesh.text(model.nodes)\n            weigh(model)\n"
              "        except InputFault as fault:\n            told = str(fault)\n"
              "    except InputFault as fault:\n        told = str(fault)\n"
              "        if path.name not in told:\n            found.append(told)\n"
              "    except Exception:\n        found.append(traceback.format_exc() + text)\n"
              "    if '\\n' in told:\n        found.append(told)\n"
              "print(json.dumps(found))\n")
    done = subprocess.run(["/usr/bin/python3", "-W", "error", "-c", script, of_file(name, "")],
                          input=json.dumps(texts), text=True,
                          capture_output=True, timeout=300, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else [f"status {done.returncode}: {done.stderr[-2000:]}"]
