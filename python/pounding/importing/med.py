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
MOST_GROUPS = 10**5  # of a file
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


def _stay_inside(group, path: Path, seen: set) -> None:
    """Throws InputFault where a group takes data from other files, or goes round and round."""
    for name in group:
        if isinstance(group.get(name, getlink=True), h5py.ExternalLink):
            raise InputFault(f"{path}: {group.name.rstrip('/')}/{name} lies in another file; write the mesh into one file")
        one = group[name]
        if isinstance(one, h5py.Group):
            if one.id.__hash__() not in seen and len(seen) < MOST_GROUPS:
                seen.add(one.id.__hash__())
                _stay_inside(one, path, seen)
        elif isinstance(one, h5py.Dataset) and (one.external or one.is_virtual):
            raise InputFault(f"{path}: the data of {one.name} lie in another file; write the mesh into one file")


def _whole(cells, what: str, path: Path) -> np.ndarray:
    """Whole numbers of a set of data, as many as it says itself. Throws InputFault."""
    found = np.asarray(cells[what][()]).reshape(-1)
    if found.dtype.kind not in "iu":
        raise InputFault(f"{path}: {cells[what].name} has no whole numbers")
    return found.astype(int)


def _families(one, names: dict, count: int, path: Path) -> list:
    """Names of groups for each node or cell. Throws InputFault where there are not as many families, or unknown ones."""
    if "FAM" not in one:
        return [()] * count
    found = _whole(one, "FAM", path)
    if len(found) != count:
        raise InputFault(f"{path}: {one.name} has {count} nodes or cells, and families of {len(found)}")
    unknown = sorted(set(found.tolist()) - set(names) - {0})
    if unknown:
        raise InputFault(f"{path}: {one.name} has family {unknown[0]}, which is not in the file")
    return [names.get(family, ()) for family in found.tolist()]


def _read(file, path: Path) -> Model:
    _stay_inside(file, path, set())
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
    names = _names(families["NOEUD"]) if "NOEUD" in families else {}
    for n, groups in enumerate(_families(mesh["NOE"], names, len(places), path), 1):
        for name in groups:
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
    nodes = _whole(cells, "NOD", path)
    stated = int(cells["NOD"].attrs.get("NBR", len(nodes) // (width or count)))
    if stated * (width or count) != len(nodes):
        raise InputFault(f"{path}: {stated} cells {type_} have {len(nodes)} nodes, and not {width or count} each")
    nodes = nodes.reshape((width or count, -1)).T
    if nodes.size and (nodes.min() < 1 or nodes.max() > len(places)):
        raise InputFault(f"{path}: cells {type_} have nodes that are not there")
    for own in nodes.tolist() if width else ():
        by_corners(model, f"CELLS {type_}", kind, own, count, path.name)
    nodes = nodes[:, :count]
    if mirrored is not None and len(nodes):
        x = places[nodes - 1]
        volumes = tetrahedra(x)[0] if count == 4 else bricks(x[:, list(AS_BRICK[count])])[0]
        nodes[volumes < 0] = nodes[volumes < 0][:, list(mirrored)]  # the order of MED
    for own, groups in zip(nodes.tolist(), _families(cells, names, len(nodes), path)):
        for name in groups:
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
