"""The small scene on which features are laid: two houses of one storey beside each other, a few dozen dofs each.

Options are written once, in metres, kilograms and the axes of the model; `Scene.words` gives them in other units or turned
by a quarter about z, by the units that `pounding -help_json` states and by the kinds of values below. `@` in a key stands
for the structure that a feature is laid on. A group of a mesh is there where an option names it.
"""
import functools
import hashlib
import json
import os
import re
import sys
import tempfile
import threading
from dataclasses import dataclass

import numpy

import program

sys.path.insert(0, os.path.join(program.SOURCE, "tests", "stability"))
from small_meshes import GMSH, Mesh, brick  # noqa: E402

GMSH.update(triangle=(2, 2), tetrahedron=(4, 3), wedge=(6, 3))


class vector(tuple):
    """Components along x, y, z, which turn with the model."""


class axes(tuple):
    """Numbers along (and then about) x, y, z, without a sign."""


class points(tuple):
    """Places of the model."""


class pairs(tuple):
    """Numbers whose units alternate."""


class curve(pairs):
    """Likewise, with colons between the two."""


@dataclass
class quantity:
    """A value with a unit other than that of its option."""
    value: object
    unit: str


class record(numpy.ndarray):
    """Accelerations along (or about) x, y, z every INTERVAL seconds, shape (samples, 3), of a motion or `rotation`."""


INTERVAL, STEP, STEPS = 1e-3, 2e-4, 160
UNITS = {"SI": (1.0, 1.0), "mm": (1e3, 1e-3)}  # length of a metre, mass of a kilogram
TURN = numpy.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])


def waves(*of):
    """A record of sines: (size [m/s2], frequency [Hz]) along x, y, z."""
    time = INTERVAL * numpy.arange(round(STEP * STEPS / INTERVAL) + 12)
    return numpy.array([size * numpy.sin(2 * numpy.pi * f * time) for size, f in of]).T.view(record)


@functools.cache
def described():
    """Names of options as patterns, with their units; those with more letters of their own first."""
    listed = json.loads(program.job(["-help_json"], 1).stdout)
    found = [(re.sub(r"<x\\?\|y\\?\|z>", "[xyz]", re.sub(r"<\w+>", r"[a-z]\\w*", row["name"])), row["unit"]) for row in listed]
    return sorted(found, key=lambda row: -len(re.sub(r"\[.*?\]\W*\w?\*?", "", row[0])))


def unit_of(option):
    return next(unit for pattern, unit in described() if re.fullmatch(pattern, option))


def factor(unit, length, mass):
    """What a number of a unit is multiplied by where a metre is `length` and a kilogram `mass`."""
    total = 1.0
    for part, sign in zip(re.split(r"[/]", unit), (1, -1)):
        for name, power in re.findall(r"([A-Za-z]+)([\d.]*)", part):
            size = {"m": length, "kg": mass, "N": mass * length, "Pa": mass / length, "J": mass * length**2}.get(name, 1.0)
            total *= size ** (sign * float(power or 1))
    return total


HOUSES = {"a": (0.0, 3.0, (2, 2, 1)), "b": (3.0, 2.25, (2, 1, 1))}  # place and width along x [m], bricks of the floor


def houses(name, groups):
    """The mesh of house a or b: those of its groups that are named. Where its floor is a deck of shells, that is all of it."""
    left, width, cells = HOUSES[name]
    h, top = 2.5, 2.5 if "deck" in groups else 2.75
    slab = brick((left, 0, h), (left + width, 2, 2.75), cells)
    bricks, nodes = slab.groups["body"][1], slab.nodes.tolist()

    def find(x, y, z, new=False):
        """The node there, made if there is none; x and y over the sides of the house."""
        place = [left + x * width, 2.0 * y, z]
        for i, node in enumerate(nodes):
            if not new and max(abs(a - b) for a, b in zip(node, place)) < 1e-9:
                return i
        nodes.append(place)
        return len(nodes) - 1

    def side(corners, of):
        """Faces of bricks, cut as their wedges or tetrahedra are."""
        if "tets" in groups or "prisms" in groups and corners == (4, 5, 6, 7):
            return "triangle", [[row[corners[i]] for i in part] for row in of for part in ((0, 1, 2), (0, 2, 3))]
        return "quadrangle", [[row[i] for i in corners] for row in of]

    near, far, facing = (1, 0, (1, 2, 6, 5)) if name == "a" else (0, 1, (0, 3, 7, 4))
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    steps = [j / cells[1] for j in range(cells[1] + 1)]
    grid = [[(i / 2, v), ((i + 1) / 2, v), ((i + 1) / 2, w), (i / 2, w)] for v, w in zip(steps, steps[1:]) for i in (0, 1)]
    feet = [find(x, y, 0) for x, y in corners]
    prisms, tets = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)), ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))

    rise = (3.5 - top) / 2
    round_it = [(0, 0), (.5, 0), (1, 0), *((1, v) for v in steps[1:]), (.5, 1), (0, 1), *((0, v) for v in steps[-2::-1])]
    edge = list(zip(round_it, round_it[1:]))

    def level(z):
        return "quadrangle", [[find(x, y, z) for x, y in cell] for cell in grid]

    def layers(*heights):
        return "hexahedron", [[find(x, y, z) for z in pair for x, y in cell] for pair in zip(heights, heights[1:]) for cell in grid]

    made = {
        "slab": lambda: ("hexahedron", bricks),
        "skewed": lambda: ("hexahedron", bricks),
        "prisms": lambda: ("wedge", [[row[i] for i in part] for row in bricks for part in prisms]),
        "tets": lambda: ("tetrahedron", [[row[i] for i in part] for row in bricks for part in tets]),
        "deck": lambda: level(h),
        "face": lambda: ("line", [[find(near, v, h), find(near, w, h)] for v, w in zip(steps, steps[1:])]) if "deck" in groups
        else side(facing, bricks[near::2]),
        "upside": lambda: level(h) if "deck" in groups else side((4, 5, 6, 7), bricks),
        "column": lambda: ("line", [[find(x, y, z), find(x, y, z + h / 2)] for x, y in corners for z in (0, h / 2)]),
        "pier": lambda: layers(0, h / 2, h),
        "block": lambda: layers(-1.0, 0.0),
        "bottom": lambda: level(-1.0),
        "stay": lambda: ("line", [[find(0, 0, 0), find(1, 0, h)], [find(0, 1, 0), find(1, 1, h)], [find(0, 0, 0), find(0, 1, h)],
                                  [find(1, 0, 0), find(1, 1, h)]]),
        "brace": lambda: ("line", [[find(near, 0, 0), find(far, 0, h)], [find(far, 1, 0), find(near, 1, h)]]),
        "strut": lambda: ("line", [[find(far, 0, 0), find(far, 1, h)]]),
        "wall": lambda: ("quadrangle", [[find(x, 0, z), find(x + .5, 0, z), find(x + .5, 0, z + h / 2), find(x, 0, z + h / 2)]
                                        for x in (0, .5) for z in (0, h / 2)]),
        "basin": lambda: ("quadrangle", [[find(*a, z), find(*b, z), find(*b, z + rise), find(*a, z + rise)] for a, b in edge
                                         for z in (top, top + rise)]),
        "sea_cells": lambda: layers(top, top + rise, top + 2 * rise),
        "base": lambda: ("point", [[i] for i in feet]),
        "feet": lambda: ("point", [[i] for i in feet]),
        "west": lambda: ("point", [[feet[0]], [feet[3]]]),
        "east": lambda: ("point", [[feet[1]], [feet[2]]]),
        "pad": lambda: ("line", [[find(x, y, 0, new=True), foot] for foot, (x, y) in zip(feet, corners)]),
        "ground": lambda: ("point", [[i] for i in range(len(nodes) - 4, len(nodes))]),  # the ends of the pads
        "raft": lambda: level(0.0),
        "subgrade": lambda: level(0.0),
        "mast": lambda: ("line", [[find(far, 0, top + .2), find(far, 0, top + 1)]]),
        "mast_foot": lambda: ("point", [[find(far, 0, top + .2)]]),
        "pump": lambda: ("point", [[find(far, 1, top)]]),
        "nib": lambda: ("point", [[find(near, 0, top)]]),
        "curb": lambda: ("quadrangle", [[find(.1, .25, top), find(.1, .6, top), find(.1, .6, top + .5), find(.1, .25, top + .5)]]),
        "curb_foot": lambda: ("line", [[find(.1, .25, top), find(.1, .6, top)]]),
    }
    kept = {group: rows() for group, rows in made.items() if group in groups}
    if "skewed" in groups:  # no brick of the floor is a box
        nodes[find(.5, .5 if name == "a" else 0, 2.75)][0] += .2
    used = sorted({i for _, rows in kept.values() for row in rows for i in row})
    place = {old: new for new, old in enumerate(used)}
    return Mesh([nodes[i] for i in used], {g: (kind, [[place[i] for i in row] for row in rows]) for g, (kind, rows) in kept.items()})


@functools.cache
def inputs():
    return tempfile.mkdtemp(prefix="composition-")


def kept(write, kind):
    """A file that `write` makes; equal ones are one, so that Gmsh reads a mesh once for all runs, and runs can be continued."""
    path = os.path.join(inputs(), f"{threading.get_ident()}{kind}")
    write(path)
    with open(path, "rb") as file:
        name = os.path.join(inputs(), hashlib.sha256(file.read()).hexdigest()[:16] + kind)
    os.replace(path, name)
    return name


GROUPS = ("slab skewed prisms tets deck face upside column pier stay brace strut wall basin sea_cells base feet west east pad ground pump nib block raft subgrade mast mast_foot "
          "bottom curb curb_foot").split()

BASE = {
    "structures": "a,b", "time_step": STEP, "end_time": STEP * STEPS, "output_interval": STEP, "energy_interval": 10, "modes": 0,
    "spectra_frequencies": "10,30", "csv_digits": 17, "probes": "pa,pb", "pa_structure": "a", "pa_group": "pump", "pb_structure": "b",
    "pb_group": "pump", "motion": waves((-40, 35), (12, 50), (9, 60)), "material_concrete_young": 3e8, "material_concrete_poisson": .2,
    "material_concrete_density": 2400, "material_steel_young": 1e10, "material_steel_poisson": .3, "material_steel_density": 2000,
    "section_post_area": .04, "section_post_inertia_y": 1.3e-4, "section_post_inertia_z": 1.8e-4, "section_post_torsion": 2e-4,
    "section_post_shear_area": (.033, .03), "section_post_z_axis": vector((1, 0, 0)),
}
OF_A_HOUSE = {
    "@_slab_element": "hex8", "@_slab_material": "concrete", "@_column_element": "beam", "@_column_material": "steel",
    "@_column_section": "post", "@_stay_element": "bar", "@_stay_material": "steel", "@_stay_area": 2e-4, "@_clamp": "base",
    "@_pump_element": "point_mass", "@_pump_mass": 300,
}
FACES = {"contacts": "joint", "joint_secondary": "a:face", "joint_primary": "b:face", "joint_gap": 1e-4}


class Scene:
    """Options of one scene; `lay` puts those of a feature on a structure. None takes an option out."""

    def __init__(self):
        self.options = {**BASE, **FACES}
        for name in "ab":
            self.lay(OF_A_HOUSE, name)

    @classmethod
    def of(cls, options):
        scene = cls()
        scene.options = dict(options)
        return scene

    def lay(self, options, structure="a"):
        for key, value in options.items():
            key = key.replace("@", structure)
            value = value.replace("@", structure) if isinstance(value, str) else value
            if value is None:
                self.options.pop(key, None)
            elif isinstance(value, str) and value.startswith("+"):  # one more of a list
                self.options[key] = ",".join(filter(None, [self.options.get(key, ""), value[1:]]))
            else:
                self.options[key] = value
        return self

    def groups(self, structure):
        """Groups of its mesh that the options name."""
        own = f"{structure}_"
        keys = [key.removeprefix(own) for key in self.options if key.startswith(own)]
        texts = [value for key, value in self.options.items() if key.startswith((own, f"p{own}")) and isinstance(value, str)]
        texts += [value for key, value in self.options.items()
                  if key.endswith(("_faces", "_water")) and self.options[key[:-5] + "structure"] == structure]
        texts += re.findall(rf"\b{structure}:(\w+)", " ".join(v for v in self.options.values() if isinstance(v, str)))
        return {g for g in GROUPS if any(key.startswith(f"{g}_") for key in keys) or re.search(rf"\b{g}\b", " ".join(texts))}

    def words(self, folder, units="SI", turned=False):
        """The words of a run, with meshes and records written to a folder."""
        length, mass = UNITS[units]
        turn = TURN if turned else numpy.eye(3)
        swap = [1, 0, 2] if turned else [0, 1, 2]
        words = []

        def place(xyz):
            return ",".join(repr(float(x)) for x in turn @ xyz * length)

        for name in self.options["structures"].split(","):
            mesh = houses(name, self.groups(name))
            words += [f"-{name}_mesh", kept(Mesh(mesh.nodes @ turn.T * length, mesh.groups).write, ".msh")]
        for key, value in self.options.items():
            if isinstance(value, record):
                words += self._record(key, numpy.asarray(value), turn, length)
                continue
            if callable(value):
                value = value(key[0], length, turn)
            if isinstance(value, str):
                value = value.replace("$", folder + "/")
            unit = "-" if isinstance(value, str) else unit_of(key)
            if isinstance(value, quantity):
                value, unit = value.value, value.unit
            if isinstance(value, points):
                value = "; ".join(place(p) for p in value)
            elif isinstance(value, tuple):
                parts = [factor(u, length, mass) for u in re.split("[,:]", unit)]
                numbers = list(value)
                if isinstance(value, vector):
                    numbers = turn @ value
                elif isinstance(value, axes):
                    numbers = [numbers[3 * half + i] for half in range(len(numbers) // 3) for i in swap] or [numbers[i] for i in swap[:2]]
                each = [parts[i % len(parts)] if isinstance(value, pairs) else parts[min(i // 3, len(parts) - 1)]
                        for i in range(len(numbers))]
                texts = [repr(float(n * f)) for n, f in zip(numbers, each)]
                value = ",".join(map(":".join, zip(texts[::2], texts[1::2])) if isinstance(value, curve) else texts)
            elif isinstance(value, float) or isinstance(value, int) and not isinstance(value, bool):
                size = factor(re.split("[,:]", unit)[0], length, mass)
                value = repr(value if size == 1 else value * size)
            words += [f"-{key}", value]
        return words

    @staticmethod
    def _record(key, values, turn, length):
        words, rotation = [], "rotation" in key
        for axis, column in zip("xyz", (values @ turn.T * (1 if rotation else length)).T):
            if not column.any():
                continue
            path = kept(lambda name, column=column: numpy.savetxt(name, column, fmt="%.17g"), ".txt")
            words += [f"-{key}_{axis}_record", path, f"-{key}_{axis}_time_step", INTERVAL]
            words += [] if rotation else [f"-{key}_{axis}_unit", "m/s2"]
        return words
