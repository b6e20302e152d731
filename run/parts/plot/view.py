"""The view of the page: the model in three dimensions, its modes, and the pounding as it was recorded."""

import base64
import json
from pathlib import Path

import h5py
import numpy as np

from pounding.results import Missing, Result
from . import scene_mesh

MOST_NODES = 60000     # shown in a page; ParaView takes any number
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

    def marks(self, folder: Path) -> list:
        clamped = [self.number(p, part.clamped) for p, part in enumerate(self.parts)]
        shown = [{"name": "supports", "colour": "#1a1a1a", "nodes": _packed(np.concatenate(clamped), "<u4")}]
        for name in sorted({name for part in self.parts for name in part.contacts}):
            nodes = [self.number(p, part.contacts[name]) for p, part in enumerate(self.parts) if name in part.contacts]
            shown.append({"name": f"contact {name}", "colour": "#d01c1c", "nodes": _packed(np.concatenate(nodes), "<u4")})
        probes = self._probes(folder)
        if len(probes):
            shown.append({"name": "probes", "colour": "#0a6e0a", "nodes": _packed(probes, "<u4")})
        return shown

    def _probes(self, folder: Path) -> np.ndarray:
        """The seen nodes at the places of the probes, which model.h5 has."""
        path = folder / "model.h5"
        if not path.exists():
            return np.array([])
        with h5py.File(path, "r") as file:
            if "marks/probes/points" not in file:
                return np.array([])
            places = file["marks/probes/points"][()]
        points = self.rows([part.points for part in self.parts])
        return np.array([int(np.argmin(((points - place)**2).sum(1))) for place in places])

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
            moved = np.stack([self.rows([file[part.name]["displacement"][f"{frame:06d}"][()] for part in self.parts])
                              for frame in kept])
            times = file["time"][()][kept]
        return {"times": times.tolist(), "impulse": impulse[kept].tolist(), "strongest": kept.index(strongest),
                "stride": stride, **_scaled(moved)}

    @staticmethod
    def _impulse(file, part, frame: int) -> float:
        """What contacts brought to the nodes of a part since the frame before [N s]."""
        if "contact_impulse" not in file[part.name]:
            return 0.0
        return float(np.linalg.norm(file[part.name]["contact_impulse"][f"{frame:06d}"][()], axis=1).sum())


def data(folder: Path) -> dict:
    """All that the view shows. Throws Missing if there is no mesh, or one too large for a page."""
    scene = _Scene(*scene_mesh.load(folder))
    points = scene.rows([part.points for part in scene.parts])
    return {"points": _packed(points, "<f4"), "groups": scene.shapes(), "marks": scene.marks(folder),
            "modes": scene.modes(folder), "motion": scene.motion(folder)}


def html(result: Result) -> str:
    """The view for the page, with its script and its numbers in it."""
    try:
        numbers = json.dumps(data(result.folder), separators=(",", ":")).replace("</", "<\\/")
    except (OSError, KeyError, ValueError, IndexError) as error:
        raise Missing(f"a file with the mesh or its motion cannot be read: {' '.join(str(error).split())}") from error
    script = (Path(__file__).parent / "view.js").read_text(encoding="utf-8")
    return ('<h2>The model and its motion</h2>\n<div id="view"></div>\n'
            f'<script type="application/json" id="view-data">{numbers}</script>\n<script>\n{script}</script>\n')
