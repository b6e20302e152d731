"""The meshes that a run left for pictures: their surface, what moves in them."""

from dataclasses import dataclass

import h5py
import numpy as np

from pounding.results import Missing, require_schema

# Of XDMF's codes of cells: nodes, and faces by the places of their nodes.
NODES = {4: 3, 5: 4, 6: 4, 8: 6, 9: 8}
FACES = {4: [(0, 1, 2)], 5: [(0, 1, 2, 3)], 6: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)],
         8: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2)],
         9: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}
SOLIDS = (6, 8, 9)
FILES = ("fields.h5", "model.h5", "modes.h5")
MOST_CELLS = 400000  # looked through for a page; ParaView takes any number


@dataclass
class Part:
    """A structure: nodes (n, 3) [m], and what is seen of it by the number of its group."""

    name: str
    points: np.ndarray
    faces: dict   # group -> corners, lists of three or four nodes
    lines: dict   # group -> (k, 2)
    dots: dict    # group -> (k,)
    clamped: np.ndarray
    contacts: dict  # name -> nodes
    bars: dict      # number of an element of two nodes in the mesh file -> its two ends

    def used(self) -> np.ndarray:
        """Nodes of what is seen, increasing."""
        seen = [np.ravel(nodes) for kind in (self.lines, self.dots) for nodes in kind.values()]
        seen += [np.ravel(face) for faces in self.faces.values() for face in faces]
        return np.unique(np.concatenate([*seen, self.clamped, *self.contacts.values()]).astype(int))


def _cells(topology: np.ndarray) -> list:
    """Code and nodes of each cell."""
    found, place, codes = [], 0, topology.tolist()
    while place < len(codes):
        code = codes[place]
        count = NODES.get(code)
        place += 1
        if count is None:
            count = codes[place]
            place += 1
        found.append((code, codes[place:place + count]))
        place += count
    return found


def _part(name: str, group: h5py.Group) -> Part:
    faces, lines, dots, outside, cuts = {}, {}, {}, {}, {}
    for number, element, (code, nodes) in zip(group["group"][()].tolist(), group["element"][()].tolist(),
                                              _cells(group["topology"][()])):
        if code not in FACES:
            if len(nodes) == 2:
                cuts.setdefault(element, []).append(nodes)
            kind = lines if len(nodes) == 2 else dots
            kind.setdefault(number, []).append(nodes)
            continue
        for places in FACES[code]:
            face = [nodes[i] for i in places]
            if code not in SOLIDS:
                faces.setdefault(number, []).append(face)
                continue
            key = tuple(sorted(face))
            outside[key] = None if key in outside else (number, face)
    for number, face in filter(None, outside.values()):  # faces of one solid only
        faces.setdefault(number, []).append(face)
    contacts = {key.removeprefix("contact_"): np.flatnonzero(group[key][()])
                for key in group if key.startswith("contact_") and isinstance(group[key], h5py.Dataset)}
    return Part(name, group["coordinates"][()], faces, {key: np.array(value) for key, value in lines.items()},
                {key: np.ravel(value) for key, value in dots.items()}, np.flatnonzero(group["clamped"][()] == 7),
                contacts, {element: (pieces[0][0], pieces[-1][1]) for element, pieces in cuts.items()})


def load(folder) -> tuple:
    """Names of the groups and the parts of the scene. Throws Missing if no file has a mesh."""
    for name in FILES:
        path = folder / name
        if not path.exists():
            continue
        try:
            with h5py.File(path, "r") as file:
                require_schema(path.name, file.attrs)
                if "groups" not in file:
                    continue
                parts = [item for item in file.values()
                         if isinstance(item, h5py.Group) and "topology" in item and "group" in item]
                cells = sum(len(part["group"]) for part in parts)
                if cells > MOST_CELLS:
                    raise Missing(f"{cells} elements, more than the {MOST_CELLS} that a page shows: "
                                  "look at the .xdmf files in ParaView")
                groups = [value.decode().strip("\0 ") for value in file["groups"][()]]
                return groups, [_part(part.name.strip("/"), part) for part in parts]
        except (OSError, KeyError, ValueError, IndexError) as error:
            raise Missing(f"{path} cannot be read: {' '.join(str(error).split())}") from error
    raise Missing("no fields.h5, model.h5 or modes.h5 with a mesh (-fields_interval, -write_model, -write_modes)")
