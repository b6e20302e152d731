"""The block of the plant for CalculiX: meshes/plant-block.geo in quadratic shells, the mat's nodes clamped,
equipment as masses, no cabinets. Needs python3-gmsh and calculix-ccx:

    python3 block_calculix.py 2 block.inp && ccx block       # 2 elements along a module of 3.05 m
"""
import sys
from pathlib import Path

import gmsh

GEOMETRY = Path(__file__).resolve().parents[2] / "meshes" / "plant-block.geo"
MATERIALS = {"concrete": 2403, "slab_concrete": 2803}  # density [kg/m3]; both 27.6 GPa, 0.2
SHELLS = {"slabs": ("slab_concrete", 0.61), "roofs": ("slab_concrete", 0.46), "basement": ("concrete", 1.07),
          "inner_walls": ("concrete", 0.61), "outer_walls": ("concrete", 0.76), "tower_walls": ("concrete", 0.61)}
EQUIPMENT = 96e3  # [kg] each


def read_mesh(elements_along_module):
    """Coordinates by node, quadrangles by group, nodes of the mat, nodes of the equipment."""
    gmsh.initialize(["gmsh", "-setnumber", "m", str(elements_along_module)])
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


def write_input(path, elements_along_module):
    places, shells, mat, equipment = read_mesh(elements_along_module)
    used = {node for quadrangles in shells.values() for quadrangle in quadrangles for node in quadrangle}
    lines = ["*NODE"] + [f"{node}," + ",".join(f"{x:.9g}" for x in places[node]) for node in sorted(used)]
    number = 0
    for name, quadrangles in shells.items():
        lines.append(f"*ELEMENT,TYPE=S8R,ELSET={name}")
        for quadrangle in quadrangles:
            number += 1
            lines.append(",".join(map(str, [number, *quadrangle])))
    lines.append("*ELEMENT,TYPE=MASS,ELSET=equipment")
    lines += [f"{number + 1 + place},{node}" for place, node in enumerate(equipment)]
    for name, density in MATERIALS.items():
        lines += [f"*MATERIAL,NAME={name}", "*ELASTIC", "27.6e9,0.2", "*DENSITY", str(density)]
    for name, (material, thickness) in SHELLS.items():
        lines += [f"*SHELL SECTION,ELSET={name},MATERIAL={material}", str(thickness)]
    lines += ["*MASS,ELSET=equipment", str(EQUIPMENT), "*BOUNDARY"]
    lines += [f"{node},1,6" for node in sorted(mat & used)]
    lines += ["*STEP", "*FREQUENCY", "12", "*NODE FILE", "U", "*END STEP"]
    path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write_input(Path(sys.argv[2]), int(sys.argv[1]))
