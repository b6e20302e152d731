"""The view of the page: the model in three dimensions, its modes, and the pounding as it was recorded."""

import base64
import json
from pathlib import Path

import h5py
import numpy as np
from scipy.spatial import cKDTree

from pounding.results import Missing, Result
from . import scene_mesh
from .style import contact_colour, envelope

MOST_NODES = 60000     # shown in a page; ParaView takes any number
GAP_BINS = 600         # of the curve of a gap
HOLDS, FAILS = "#1b7837", "#d01c1c"  # colours of equipment
DEMANDS = ((1, HOLDS, "no farther than 1"), (2, "#e6b800", "1 to 2"), (4, "#e07b00", "2 to 4"),
           (np.inf, FAILS, "beyond 4"))  # the most over the first corner, colour, words
SIDES = {"N": "z", "T": "z", "Vy": "y", "Vz": "z", "My": "z", "Mz": "y"}  # axis along which a component is drawn
MOST_BYTES = 12000000  # of the frames in a page, before base64
COLOURS = ("#9bb7d4", "#d9a066", "#8fbf8f", "#c99bc4", "#d98c8c", "#b8b86a", "#7fc4c4", "#a89a86", "#8c8cd9", "#c4c4c4")


def _packed(values, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def _scaled(values: np.ndarray) -> dict:
    """Values as parts of the largest of them, in two bytes."""
    largest = float(abs(values).max()) if values.size else 0.0
    return {"largest": largest, "values": _packed(np.round(values / (largest or 1) * 32767), "<i2")}


class _Scene:
    """Nodes of all parts that are seen, one after the other."""

    def __init__(self, groups: list, parts: list):
        self.groups, self.parts = groups, parts
        self.used = [part.used() for part in parts]
        self.first = np.concatenate([[0], np.cumsum([len(used) for used in self.used])]).astype(int)
        if self.first[-1] > MOST_NODES:
            raise Missing(f"{self.first[-1]} nodes on the surface, more than the {MOST_NODES} that a page shows: "
                          "look at the .xdmf files in ParaView")

    def number(self, part: int, nodes) -> np.ndarray:
        return self.first[part] + np.searchsorted(self.used[part], nodes)

    def rows(self, tables: list) -> np.ndarray:
        """The rows of the nodes out of a table per part."""
        return np.concatenate([table[used] for table, used in zip(tables, self.used)])

    def shapes(self) -> list:
        shown = []
        for number, name in enumerate(self.groups, start=1):
            triangles, edges, lines, dots = [], [], [], []
            for p, part in enumerate(self.parts):
                for face in part.faces.get(number, []):
                    own = self.number(p, face).tolist()
                    triangles += [own[:3]] if len(own) == 3 else [own[:3], [own[0], own[2], own[3]]]
                    edges += [sorted(pair) for pair in zip(own, own[1:] + own[:1])]
                if number in part.lines:
                    lines += self.number(p, part.lines[number]).tolist()
                if number in part.dots:
                    dots += self.number(p, part.dots[number]).tolist()
            edges = np.unique(np.array(edges).reshape(-1, 2), axis=0)
            shown.append({"name": name, "colour": COLOURS[(number - 1) % len(COLOURS)],
                          "triangles": _packed(triangles, "<u4"), "edges": _packed(edges, "<u4"),
                          "lines": _packed(lines, "<u4"), "dots": _packed(dots, "<u4")})
        return shown

    def motion_of(self, file, frame: int) -> np.ndarray:
        """Displacements of the seen nodes in a frame [m]."""
        return self.rows([file[part.name]["displacement"][f"{frame:06d}"][()] for part in self.parts])

    def rest(self, folder: Path) -> np.ndarray:
        """Displacements of the seen nodes at the start, under the weight where the run begins at rest under it [m]."""
        nothing = np.zeros((self.first[-1], 3))
        path = folder / "fields.h5"
        if not path.exists():
            return nothing
        with h5py.File(path, "r") as file:
            if int(file["frames"][0]) == 0 or file["time"][0] > 0:
                return nothing
            return self.motion_of(file, 0)

    def marks(self, folder: Path) -> list:
        clamped = [self.number(p, part.clamped) for p, part in enumerate(self.parts)]
        shown = [{"name": "supports", "colour": "#1a1a1a", "nodes": _packed(np.concatenate(clamped), "<u4")}]
        for name in sorted({name for part in self.parts for name in part.contacts}):
            nodes = [self.number(p, part.contacts[name]) for p, part in enumerate(self.parts) if name in part.contacts]
            shown.append({"name": f"contact {name}", "colour": "#d01c1c", "nodes": _packed(np.concatenate(nodes), "<u4")})
        probes = self.probes(folder)
        if probes:
            nodes = [node for own in probes.values() for node in own]
            shown.append({"name": "probes", "colour": "#0a6e0a", "nodes": _packed(nodes, "<u4")})
        return shown

    def probes(self, folder: Path) -> dict:
        """Probe -> the seen nodes at its places, which model.h5 has."""
        path, found = folder / "model.h5", {}
        if not path.exists():
            return found
        with h5py.File(path, "r") as file:
            if "marks/probes/points" not in file:
                return found
            places, numbers = file["marks/probes/points"][()], file["marks/probes/probe"][()]
            names = [name.decode().strip("\0 ") for name in file["probes"][()]]
        points = self.rows([part.points for part in self.parts])
        for place, number in zip(places, numbers):
            found.setdefault(names[number - 1], []).append(int(np.argmin(((points - place)**2).sum(1))))
        return found

    def capacities(self, result: Result) -> list:
        """Items of equipment at their places, with demand over capacity: above 1 the item fails."""
        probes, shown = self.probes(result.folder), []
        for name, one in result.verdicts.items():
            if one["ratio"] and one["probe"] in probes:
                demand = one["needed"] / one["ratio"]
                shown.append({"name": f"{name}: {demand:.2f} of its capacity", "colour": FAILS if demand > 1 else HOLDS,
                              "nodes": _packed(probes[one["probe"]], "<u4")})
        return shown

    def yielding(self, result: Result) -> list:
        """Nodes in the middle of elements that may yield, by demand over capacity: the largest elongation of any of an
        element's laws over that of the first corner. A node that several share has the farthest of them."""
        table = result.yielding
        if not len(table.get("law", ())):
            return []
        points = self.rows([part.points for part in self.parts])
        nearest = cKDTree(points).query(np.column_stack([table[axis] for axis in "xyz"]))[1]
        farthest = np.zeros(len(points))
        np.maximum.at(farthest, nearest, table["ductility"])
        own = np.unique(nearest)
        number = np.searchsorted([most for most, _, _ in DEMANDS], farthest[own])
        return [{"name": f"yielding: {words} times the first corner", "colour": colour,
                 "nodes": _packed(own[number == i], "<u4")}
                for i, (_, colour, words) in enumerate(DEMANDS) if (number == i).any()]

    def members(self, result: Result, times: list) -> list:
        """Beams whose forces were recorded: ends, axes, and for each component at both ends the largest of the samples and,
        where there is a history, its values at the times [N, N m]."""
        shown, table = {}, result.forces
        options, history = result.summary.get("options", {}), result.history.get("forces", [])
        for item, component, element, peak in zip(*(table.get(key, ()) for key in ("item", "component", "element", "peak"))):
            structure = options.get(f"{item}_structure")
            part = next((i for i, part in enumerate(self.parts) if part.name == structure), None)
            quantity, end = (component[:-1], int(component[-1]) - 1) if component[-1] in "12" else (component, None)
            if part is None or quantity not in SIDES or int(element) not in self.parts[part].bars:
                continue
            beam = shown.setdefault((item, element), self._beam(result, item, part, int(element)))
            name, at = f"{item}.{int(element)}.{component}", None
            if name in history:
                at = np.interp(times, result.history["time"], result.history["force"][:, history.index(name)]).tolist()
            values = beam["values"].setdefault(quantity, [None, None])
            for i in (0, 1) if end is None else (end,):
                values[i] = {"largest": float(peak), "at": at}
        return list(shown.values())

    def _beam(self, result: Result, item: str, part: int, element: int) -> dict:
        """A beam with the axes of its section."""
        one = self.parts[part]
        nodes = one.bars[element]
        along = one.points[nodes[1]] - one.points[nodes[0]]
        along = along / (np.linalg.norm(along) or 1)
        group = result.summary["options"].get(f"{item}_group")
        section = result.summary["structures"][one.name]["regions"].get(group, {}).get("section", {})
        z = np.asarray(section.get("z_axis", np.eye(3)[int(np.argmin(np.abs(along)))]), float)
        z = z - (z @ along) * along
        z = z / (np.linalg.norm(z) or 1)
        return {"name": f"{item}, element {element}", "nodes": self.number(part, list(nodes)).tolist(),
                "y": np.cross(z, along).tolist(), "z": z.tolist(), "values": {}}

    def modes(self, folder: Path) -> list:
        path = folder / "modes.h5"
        if not path.exists():
            return []
        shown = []
        with h5py.File(path, "r") as file:
            for p, part in enumerate(self.parts):
                if part.name not in file or not np.array_equal(file[part.name]["coordinates"][()], part.points):
                    continue  # of another mesh
                for number, frequency in enumerate(file[part.name]["frequencies"][()], start=1):
                    shape = np.zeros((self.first[-1], 3))
                    rows = file[part.name][f"shapes/{number:04d}"][()][:, :3]
                    shape[self.first[p]:self.first[p + 1]] = rows[self.used[p]]
                    shown.append({"name": f"{part.name}, mode {number}: {frequency:.3g} Hz", **_scaled(shape)})
        return shown

    def motion(self, folder: Path) -> dict:
        path = folder / "fields.h5"
        if not path.exists():
            return {}
        with h5py.File(path, "r") as file:
            frames = int(file["frames"][0])
            if frames == 0:
                return {}
            impulse = np.array([sum(self._impulse(file, part, frame) for part in self.parts) / 2
                                for frame in range(frames)])
            stride = -(-frames * int(self.first[-1]) * 6 // MOST_BYTES)
            strongest = int(impulse.argmax())
            kept = list(range(strongest % stride, frames, stride))
            moved = np.stack([self.motion_of(file, frame) for frame in kept]) - self.rest(folder)
            times = file["time"][()][kept]
        return {"times": times.tolist(), "impulse": impulse[kept].tolist(), "strongest": kept.index(strongest),
                "stride": stride, **_scaled(moved)}

    @staticmethod
    def _impulse(file, part, frame: int) -> float:
        """What contacts brought to the nodes of a part since the frame before [N s]."""
        if "contact_impulse" not in file[part.name]:
            return 0.0
        return float(np.linalg.norm(file[part.name]["contact_impulse"][f"{frame:06d}"][()], axis=1).sum())


def _gaps(result: Result) -> list:
    """The smallest gap of each contact over time [s, mm], as much of it as a picture holds."""
    shown = []
    for column, name in enumerate(result.contacts if "gap" in result.history else []):
        gap = result.history["gap"][:, column]
        known = np.isfinite(gap)
        if known.any():
            times, values = envelope(result.history["time"][known], 1e3 * gap[known], GAP_BINS)
            shown.append({"name": name, "colour": contact_colour(result.contacts, name),
                          "times": np.round(times, 6).tolist(), "gap": np.round(values, 4).tolist()})
    return shown


def data(result: Result) -> dict:
    """All that the view shows, displacements since the rest. Throws Missing if there is no mesh, or one too large for a
    page."""
    folder = result.folder
    scene = _Scene(*scene_mesh.load(folder))
    motion, rest = scene.motion(folder), scene.rest(folder)
    points = scene.rows([part.points for part in scene.parts]) + rest
    return {"points": _packed(points, "<f4"), "sag": float(np.abs(rest).max(initial=0.0)), "groups": scene.shapes(),
            "marks": scene.marks(folder) + scene.capacities(result) + scene.yielding(result),
            "modes": scene.modes(folder), "motion": motion, "gaps": _gaps(result),
            "members": scene.members(result, motion.get("times", []))}


def texts(result: Result) -> tuple:
    """Numbers and script of the view, as a page has them. Throws Missing."""
    try:
        numbers = json.dumps(data(result), separators=(",", ":")).replace("</", "<\\/")
    except (OSError, KeyError, ValueError, IndexError) as error:
        raise Missing(f"a file with the mesh or its motion cannot be read: {' '.join(str(error).split())}") from error
    return numbers, (Path(__file__).parent / "view.js").read_text(encoding="utf-8")
