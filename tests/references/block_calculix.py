"""The block of the plant for CalculiX: meshes/plant-block.geo in quadratic shells, the mat's nodes clamped,
equipment as masses, no cabinets. Needs python3-gmsh and calculix-ccx:

    python3 block_calculix.py 2 block.inp && ccx block       # 2 elements along a module of 3.05 m
    python3 block_calculix.py 2 block.inp sa && ccx block    # a quarter of it, see `quarter`

A quarter is of the block without stairs and equipment, which two planes mirror. Its modes are those that the plane
across x and the one across y mirror (s) or turn round (a): ss, sa, as, aa. Walls in these planes have half of their
stiffness and density.
"""
import sys
from pathlib import Path

import gmsh

GEOMETRY = Path(__file__).resolve().parents[2] / "meshes" / "plant-block.geo"
MATERIALS = {"concrete": 2403, "slab_concrete": 2803}  # density [kg/m3]; both 27.6 GPa, 0.2
SHELLS = {"slabs": ("slab_concrete", 0.61), "roofs": ("slab_concrete", 0.46), "basement": ("concrete", 1.07),
          "inner_walls": ("concrete", 0.61), "outer_walls": ("concrete", 0.76), "tower_walls": ("concrete", 0.61)}
EQUIPMENT = 96e3  # [kg] each
MIDDLE = 12.192  # of the block along x and y [m]
HELD = {"s": ({0, 4, 5}, {1, 3, 5}), "a": ({1, 2, 3}, {0, 2, 4})}  # components on the planes across x and y


def read_mesh(elements_along_module, opening):
    """Coordinates by node, quadrangles by group, nodes of the mat, nodes of the equipment."""
    gmsh.initialize(["gmsh", "-setnumber", "m", str(elements_along_module), "-setnumber", "opening", str(opening)])
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(GEOMETRY))
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
    gmsh.model.mesh.generate(2)
    tags, values, _ = gmsh.model.mesh.getNodes()
    places = {int(tag): values[3 * n:3 * n + 3] for n, tag in enumerate(tags)}
    groups = {gmsh.model.getPhysicalName(*group): (group[0], gmsh.model.getEntitiesForPhysicalGroup(*group))
              for group in gmsh.model.getPhysicalGroups()}

    def quadrangles(name):
        found = []
        for entity in groups[name][1]:
            kinds, _, nodes = gmsh.model.mesh.getElements(2, entity)
            assert list(kinds) == [16], kinds  # quadrangles with 8 nodes
            found += nodes[0].reshape(-1, 8).tolist()
        return found

    shells = {name: quadrangles(name) for name in SHELLS}
    mat = {node for quadrangle in quadrangles("mat") for node in quadrangle}
    equipment = [int(gmsh.model.mesh.getNodes(0, entity)[0][0]) for entity in groups["equipment"][1]]
    gmsh.finalize()
    return places, shells, mat, equipment


def quarter(places, shells, signs):
    """Quadrangles by group and half, and clamped components by node, of the quarter at the origin."""
    def beyond(node, axis):
        return places[node][axis] - MIDDLE

    parts, held = {}, {}
    for name, quadrangles in shells.items():
        for quadrangle in quadrangles:
            if any(beyond(node, axis) > 1e-6 for node in quadrangle for axis in (0, 1)):
                continue
            inside = any(all(abs(beyond(node, axis)) < 1e-6 for node in quadrangle) for axis in (0, 1))
            parts.setdefault((name, inside), []).append(quadrangle)
            for node in quadrangle:
                for axis in (0, 1):
                    if abs(beyond(node, axis)) < 1e-6:
                        held[node] = held.get(node, set()) | HELD[signs[axis]][axis]
    return parts, held


def write_input(path, elements_along_module, signs=None):
    places, shells, mat, equipment = read_mesh(elements_along_module, 1 if signs is None else 0)
    parts, held = {(name, False): quadrangles for name, quadrangles in shells.items()}, {}
    if signs is not None:
        parts, held = quarter(places, shells, signs)
        equipment = []
    used = {node for quadrangles in parts.values() for quadrangle in quadrangles for node in quadrangle}
    held.update({node: set(range(6)) for node in mat & used})
    lines = ["*NODE"] + [f"{node}," + ",".join(f"{x:.9g}" for x in places[node]) for node in sorted(used)]
    number = 0
    for (name, halved), quadrangles in parts.items():
        lines.append(f"*ELEMENT,TYPE=S8R,ELSET={name}{'_halved' if halved else ''}")
        for quadrangle in quadrangles:
            number += 1
            lines.append(",".join(map(str, [number, *quadrangle])))
    if equipment:
        lines.append("*ELEMENT,TYPE=MASS,ELSET=equipment")
        lines += [f"{number + 1 + place},{node}" for place, node in enumerate(equipment)]
        lines += ["*MASS,ELSET=equipment", str(EQUIPMENT)]
    for name, density in MATERIALS.items():
        for end, factor in (("", 1), ("_halved", 0.5)):
            lines += [f"*MATERIAL,NAME={name}{end}", "*ELASTIC", f"{factor * 27.6e9},0.2", "*DENSITY", str(factor * density)]
    for name, halved in parts:
        material, thickness = SHELLS[name]
        end = "_halved" if halved else ""
        lines += [f"*SHELL SECTION,ELSET={name}{end},MATERIAL={material}{end}", str(thickness)]
    lines += ["*BOUNDARY"]
    lines += [f"{node},{c + 1},{c + 1}" for node, components in sorted(held.items()) for c in sorted(components)]
    lines += ["*STEP", "*FREQUENCY", "12", "*NODE FILE", "U", "*END STEP"]
    path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write_input(Path(sys.argv[2]), int(sys.argv[1]), *sys.argv[3:4])
