"""Steps of plates and lattices of one kind of element and mesh: by elements, and with PETSc's matrices, in turns."""

import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from pounding.tables import by_ranks, leave

from .comparison import LABELS, check_agreement
from .workers import SOURCE, Stepper, slab_cells, step_benchmark

WAYS = ["element", "aij", "sbaij"]
CELLS = slab_cells(60_000)
# One scene for the meshes of tests/meshes.
SCENE = """\
structures: plate
plate:
  mesh: {mesh}
  mesh_set: "{parameters}"
  clamp: x_min
  numbers: {numbers}
  damping: {{alpha: 0.1562, beta: 1.2557e-5}}
  body: {element}
material: {{concrete: {{young: 30e9, poisson: 0.2, density: 2400}}}}
section:
  tube: {{area: 0.01, inertia_y: 1e-4, inertia_z: 2e-4, torsion: 2e-4, shear_area: "5e-3,4e-3", z_axis: "1,2,3"}}
motion:
  x: {{record: {motion}, unit: m/s2, time_step: 2e-3}}
end_time: 0.001
output: none
"""
SHELL = "{element: shell, material: concrete, thickness: 0.22}"
SOLID = "{element: hex8, material: concrete}"
BEAM = "{element: beam, material: concrete, section: tube}"


@dataclass(frozen=True)
class Shape:
    """A kind of element and mesh: cells of the benchmark's own, or a mesh of tests/meshes with parameters."""

    label: str
    cells: tuple = ()
    parameters: str = ""
    element: str = SOLID
    mesh: str = "holes.geo"
    numbers: str = "double"

    def model(self, scratch: Path, motion: Path) -> list:
        if self.cells:
            return ["-cells", ",".join(str(n) for n in self.cells)]
        scene = scratch / "shape.yaml"
        scene.write_text(SCENE.format(mesh=SOURCE / "tests" / "meshes" / self.mesh, motion=motion,
                                      parameters=self.parameters, element=self.element, numbers=self.numbers))
        return ["-scene", scene]


SHAPES = {
    "rectangles": Shape("rectangles of shells in rows", cells=(*CELLS[:2], 0)),
    "quadrangles": Shape("quadrangles round holes, by Blossom", parameters="kind=1,size=0.11",
                         element=SHELL),
    "triangles": Shape("triangles round holes", parameters="kind=0,size=0.11", element=SHELL),
    "bricks": Shape("bricks in rows, one layer", cells=CELLS),
    "extruded": Shape("hexahedra extruded from Blossom's quadrangles, one layer",
                      parameters="kind=2,size=0.1"),
    "layers": Shape("the same in four layers", parameters="kind=2,size=0.15,layers=4"),
    "split": Shape("hexahedra made from tetrahedra", parameters="kind=3,size=0.45,thickness=0.5"),
    "many": Shape("the same, more than the caches hold", parameters="kind=3,size=0.16,thickness=0.5"),
    "single": Shape("these with numbers in 32 bits", parameters="kind=3,size=0.16,thickness=0.5", numbers="single"),
    "lattice": Shape("beams along three axes", parameters="n=20", element=BEAM, mesh="lattice.geo"),
    "skewed": Shape("beams, each of a length and direction of its own", parameters="n=20,skew=0.1", element=BEAM,
                    mesh="lattice.geo"),
}


@dataclass
class Measured:
    """Times of one way [s per step], one per round."""

    shape: str
    ranks: int
    way: str
    dofs: int
    seconds: list = field(default_factory=list)

    @property
    def nanoseconds_per_dof(self) -> float:
        return 1e9 * float(np.median(self.seconds)) / self.dofs


def measure(folder: Path, scratch: Path, motion: Path, name: str, ranks: int, rounds: int, lasting: float) -> list:
    """Every way once per round."""
    print(f"  {name}, {ranks} ranks", file=sys.stderr, flush=True)
    model = SHAPES[name].model(scratch, motion)
    with Stepper(step_benchmark(folder, ranks, motion, model, WAYS)) as stepper:
        check_agreement({(way, ranks): told["displacement_square"] for way, told in stepper.ways.items()})
        measured = [Measured(name, ranks, way, stepper.ways[way]["dofs"]) for way in WAYS]
        for _ in range(rounds):
            for one in measured:
                told = stepper.ask(f"{one.way} {lasting}")
                one.seconds.append(told["quiet_seconds_per_step"])
    return measured


def ratio(one: Measured, to: Measured) -> float:
    """Median over the rounds of the times of one over those of the other."""
    return float(np.median(np.array(one.seconds) / np.array(to.seconds)))


def write(folder: Path, measured: list) -> str:
    """Writes shapes.md and shapes.csv; returns the table."""
    found = {(one.shape, one.ranks, one.way): one for one in measured}
    rows = [{"elements": SHAPES[one.shape].label, "dofs": one.dofs, "ranks": one.ranks, "ns": one.nanoseconds_per_dof,
             **{way: ratio(found[one.shape, one.ranks, way], one) for way in WAYS[1:]}}
            for one in measured if one.way == "element"]
    text = by_ranks("Steps of concrete plates and lattices by kind of element and mesh: element by element, and times "
                    "over that", "elements", rows, {"elements": "elements", "free dofs": "dofs", "ns per dof": "ns",
                                                    **{f"{LABELS[way]}, ×": way for way in WAYS[1:]}})
    return leave(folder, "shapes", text, [
        {"shape": one.shape, "ranks": one.ranks, "way": one.way, "dofs": one.dofs,
         "nanoseconds_per_dof": one.nanoseconds_per_dof,
         "ratio_to_element": ratio(one, found[one.shape, one.ranks, "element"])} for one in measured])
