"""Reads meshes of Salome and Code_Aster (.med) into the neutral model: nodes, cells and groups, all that they hold."""

from pathlib import Path

import h5py
import numpy as np

from .model import BAR, Element, InputFault, Model
from .second_order import by_corners
from .weighing import AS_BRICK, bricks, tetrahedra

# Type of cells -> kind of element, nodes, and the places of its nodes in the mirrored cell.
CELLS = {"HE8": ("hex8", 8, (0, 3, 2, 1, 4, 7, 6, 5)), "PE6": ("wedge6", 6, (0, 2, 1, 3, 5, 4)), "TE4": ("tet4", 4,
                                                                                                         (0, 2, 1, 3)),
         "QU4": ("shell", 4, None), "TR3": ("shell", 3, None), "SE2": (BAR, 2, None), "PO1": ("point", 1, None)}
# Those of second order: of first order by their corners, which come first, and all their nodes.
SECOND = {"H20": ("HE8", 20), "H27": ("HE8", 27), "P15": ("PE6", 15), "P18": ("PE6", 18), "T10": ("TE4", 10),
          "QU8": ("QU4", 8), "QU9": ("QU4", 9), "TR6": ("TR3", 6), "TR7": ("TR3", 7), "SE3": ("SE2", 3)}


def _names(families) -> dict:
    """Family -> names of its groups."""
    found = {}
    for family in families.values():
        names = []
        if "GRO" in family:
            for row in np.asarray(family["GRO"]["NOM"][()]):
                letters = row.tobytes() if hasattr(row, "tobytes") else bytes(row)
                names.append(letters.split(b"\0")[0].decode("latin-1").strip())
        found[int(family.attrs["NUM"])] = [name for name in names if name]
    return found


def _read(file, path: Path) -> Model:
    model = Model(path.stem, has_properties=False)
    meshes = list(file["ENS_MAA"])
    if len(meshes) != 1:
        raise InputFault(f"{path}: it holds {len(meshes)} meshes ({', '.join(meshes)}), and one is wanted; write it "
                         "alone")
    mesh = file["ENS_MAA"][meshes[0]]
    dimension = int(mesh.attrs["ESP"])
    if "NOE" not in mesh:
        steps = list(mesh)
        mesh = mesh[steps[0]]
        if len(steps) > 1:
            model.said.append(f"{path.name}: {len(steps)} states of the mesh, of which the first is read")
    places = np.asarray(mesh["NOE"]["COO"][()], dtype=float).reshape((dimension, -1)).T
    if not np.isfinite(places).all():
        raise InputFault(f"{path}: coordinates that are not finite")
    places = np.pad(places, ((0, 0), (0, 3 - dimension)))
    model.nodes = {n: tuple(map(float, x)) for n, x in enumerate(places, 1)}
    model.cards.use("NODES", len(places))
    families = file["FAS"].get(meshes[0], {}) if "FAS" in file else {}
    if "FAM" in mesh["NOE"] and "NOEUD" in families:
        names = _names(families["NOEUD"])
        for n, family in enumerate(np.asarray(mesh["NOE"]["FAM"][()]), 1):
            for name in names.get(int(family), ()):
                model.node_sets.setdefault(name, []).append(n)
    names = _names(families["ELEME"]) if "ELEME" in families else {}
    for type_, cells in (mesh["MAI"].items() if "MAI" in mesh else ()):
        _cells(model, path, type_, cells, places, names)
    model.cards.use("GROUPS OF NODES", len(model.node_sets))
    model.cards.use("GROUPS OF CELLS", len(model.element_sets))
    return model


def _cells(model: Model, path: Path, type_: str, cells, places, names) -> None:
    first, width = SECOND.get(type_, (type_, 0))
    if first not in CELLS:
        count = int(cells["NOD"].attrs.get("NBR", 0)) if "NOD" in cells else 0
        model.cards.lose(f"CELLS {type_}", f"cells are known of {', '.join([*CELLS, *SECOND])}",
                         path.name, count)
        return
    kind, count, mirrored = CELLS[first]
    nodes = np.asarray(cells["NOD"][()], dtype=int).reshape((width or count, -1)).T
    if nodes.size and (nodes.min() < 1 or nodes.max() > len(places)):
        raise InputFault(f"{path}: cells {type_} have nodes that are not there")
    for own in nodes.tolist() if width else ():
        by_corners(model, f"CELLS {type_}", kind, own, count, path.name)
    nodes = nodes[:, :count]
    if mirrored is not None and len(nodes):
        x = places[nodes - 1]
        volumes = tetrahedra(x)[0] if count == 4 else bricks(x[:, list(AS_BRICK[count])])[0]
        nodes[volumes < 0] = nodes[volumes < 0][:, list(mirrored)]  # the order of MED
    families = np.asarray(cells["FAM"][()]) if "FAM" in cells else np.zeros(len(nodes), dtype=int)
    for own, family in zip(nodes.tolist(), families.tolist()):
        for name in names.get(family, ()):
            model.element_sets.setdefault(name, []).append(len(model.elements))
        model.elements.append(Element(kind, 0, tuple(own), None, place=path.name))
    if not width:
        model.cards.use(f"CELLS {type_}", len(nodes))


def read(path: Path) -> Model:
    """The model of a file. Throws InputFault."""
    try:
        with h5py.File(path, "r") as file:
            return _read(file, path)
    except (OSError, KeyError, ValueError, TypeError, AttributeError) as error:
        raise InputFault(f"{path}: not a mesh of MED: {' '.join(str(error).split())}") from error
