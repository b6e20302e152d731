"""A model of another program as a scene: run/import FILE DIR --units mm,t,s

Reads Abaqus and CalculiX (.inp), Nastran (.bdf, .nas, .dat), ANSYS (.cdb), Salome and Code_Aster (.med, .unv),
LS-DYNA (.k) and SAP2000 (.s2k), and writes a scene (.yaml) and its mesh (.msh) in SI units into a folder; nothing that is there is written over.
Cards that have no place in a scene are listed with their counts. Where stiffness, mass or support would be lost nothing
is written, unless --allow-losses names these cards. docs/manual/import.md has the tables of cards.

run/import --try FOLDER tries every deck below a folder and writes a table, tried.csv: what is read, with which losses, or
refused and why.
"""

import argparse
import os
from pathlib import Path

from pounding import UserError
from pounding.arguments import positive
from pounding.files import write_text
from pounding.importing.formats import FORMATS, read
from pounding.importing.massless import scaling_of
from pounding.importing.mesh_file import plain
from pounding.importing.model import InputFault
from pounding.importing.scene import Scene
from pounding.importing.told import cards_told, model_told, modes_told
from pounding.importing.trying import try_folder
from pounding.importing.units import in_si, units_of
from pounding.importing.weighing import weigh
from pounding.runs import RunError, next_steps
from pounding.scenes import write_scene

from .process import called, parser_of, printable

NAME = called("run/import")


def units(text: str):
    try:
        return units_of(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def density(text: str) -> tuple:
    name, _, value = text.rpartition("=")
    if not name:
        raise argparse.ArgumentTypeError(f"'{text}' is not material=kg/m3")
    return name.upper(), positive(float)(value)


def arguments():
    parser = parser_of(__doc__)
    parser.add_argument("file", type=Path, metavar="FILE", help="the model, or the folder of --try")
    parser.add_argument("folder", nargs="?", type=Path, default=Path("."), metavar="DIR",
                        help="where the scene, or the table of --try, goes (default: here)")
    parser.add_argument("--try", action="store_true", dest="tries",
                        help="FILE is a folder: every deck below it is tried, and a table tells what became of it")
    parser.add_argument("--units", type=units, metavar="L,M,T",
                        help="units of the file: length, mass or force, time: m,kg,s or mm,t,s or ft,kip,s or mm,N,s; "
                             "--try takes m,kg,s where none are said")
    parser.add_argument("--format", choices=list(FORMATS), help="of the file (default: by the ending of its name)")
    parser.add_argument("--name", help="name of the structure, the scene and the mesh (default: that of the file)")
    parser.add_argument("--allow-losses", default="", metavar="CARD,...",
                        help="cards that may be lost, by the names that are printed")
    parser.add_argument("--density", type=density, action="append", default=[], metavar="MATERIAL=KG/M3",
                        help="of a material that has none in the file; may be given again")
    parser.add_argument("--properties", type=Path, metavar="FILE",
                        help="options file with elements, materials and clamps by group, for files that hold meshes "
                             "alone (.med, .unv); the scene includes it")
    parser.add_argument("--expect-mass", type=positive(float), metavar="KG", help="printed beside the mass")
    parser.add_argument("--modes", type=int, default=10, metavar="N",
                        help="lowest modes that are computed and printed, where the program is built (default: 10); "
                             "0: none")
    given = parser.parse_args()
    if not (given.units or given.tries):
        parser.error("the following arguments are required: --units")
    return given


def options_of(scene, name: str, mesh: str, properties: str | None) -> dict:
    options: dict = {"title": f"{name}, imported", "structures": name, name: {"mesh": mesh, **scene.options}}
    if properties:
        options = {"include": properties, **options}
    if scene.materials:
        options["material"] = scene.materials
    if scene.sections:
        options["section"] = scene.sections
    if scene.contacts:
        options |= {"contacts": ",".join(scene.contacts), **scene.contacts}
    return {**options, "end_time": 1, "output": f"results/{name}"}


def write(options: dict, comment: str, paths: tuple, mesh: str) -> None:
    """Both files or, with OSError, none."""
    for path in paths:
        if os.path.lexists(path):
            raise FileExistsError(f"{path} is there already; give another folder or --name, or move it away")
    paths[0].parent.mkdir(parents=True, exist_ok=True)
    write_text(paths[1], mesh)
    try:
        write_scene(paths[0], options, comment)
    except BaseException:
        paths[1].unlink(missing_ok=True)
        raise


def tell(lines) -> None:
    print("\n".join(map(printable, lines)), flush=True)


def try_all(given) -> int:
    table = given.folder / "tried.csv"
    if os.path.lexists(table):
        raise UserError(f"{table} is there already; give another folder, or move it away")
    given.folder.mkdir(parents=True, exist_ok=True)
    try_folder(given.file, table, given.units or units_of("m,kg,s"))
    return 0


def main() -> int:
    given = arguments()
    if given.tries:
        return try_all(given)
    name = plain(given.name or given.file.stem)
    allowed = {word.strip().lstrip("*").upper() for word in given.allow_losses.split(",") if word.strip()}
    model = read(given.file, given.format)
    in_si(model, given.units)
    for material, value in given.density:
        found = next((one for one in model.materials if str(one).upper() == material), None)
        if found is None:
            raise UserError(f"--density {material}: no such material; the file has "
                            f"{', '.join(map(str, model.materials)) or 'none'}")
        model.materials[found].density = value
    fault = None
    try:
        scene = Scene(model, name)
        mass, centre = weigh(model) if model.has_properties else (0.0, None)
    except InputFault as found:  # told after the losses, which it may follow from
        fault = str(found)
    tell(cards_told(model.cards, allowed))
    spare = sorted(allowed - {card.upper() for card in model.cards.lost})
    if spare:
        print(f"--allow-losses {','.join(spare)}: not among the losses")
    lost = sorted(card for card in model.cards.lost if card.upper() not in allowed)
    if lost:
        raise UserError(f"{given.file}: {', '.join(f'{card} {model.cards.lost[card]}' for card in lost)} would be lost; "
                        f"take them out, or allow it: --allow-losses '{','.join(lost)}'")
    if fault:
        raise UserError(fault)
    paths = given.folder / f"{name}.yaml", given.folder / f"{name}.msh"
    properties = None
    if given.properties:
        if not given.properties.is_file():
            raise UserError(f"--properties {given.properties}: no such file")
        properties = os.path.relpath(given.properties, given.folder)
    comment = (f"From {ascii(given.file.name)[1:-1]} by {NAME}; SI units. Every option is in docs/reference/scene: damping, "
               "contacts, motion\nand probes are still to be said.")
    options, mesh = options_of(scene, name, paths[1].name, properties), scene.mesh.text(model.nodes)
    if scene.massless:
        options[name]["mass_scaling"], told = scaling_of(options, name, mesh)
        names = ", ".join(sorted(map(str, scene.massless)))
        model.said.append(f"material {names}: no density, its beams and bars weigh nothing (--density gives one); {told}")
    write(options, comment, paths, mesh)
    tell(model_told(scene, mass, centre, given.expect_mass))
    print(f"wrote {paths[0]}, {paths[1]}")
    if not model.has_properties and not given.properties:
        print("it is a mesh and groups alone: give elements, materials and clamps in a file, --properties, or in the "
              "scene")
    elif given.modes > 0:
        try:
            lines, fault = modes_told(paths[0], name, given.modes)
        except RunError as error:
            print(f"no modes: {error}")
        else:
            if fault:
                raise UserError(f"{paths[0]} is written, and the program refuses it: {fault}")
            tell(lines)
    print(next_steps(paths[0]))
    return 0
