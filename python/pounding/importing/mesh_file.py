"""A mesh with physical groups as a file of Gmsh's format 4.1."""

import re

TYPES = {("point", 1): (0, 15), ("line", 2): (1, 1), ("face", 3): (2, 2), ("face", 4): (2, 3), ("solid", 4): (3, 4),
         ("solid", 6): (3, 6), ("solid", 8): (3, 5)}
LARGEST = 2**31 - 1  # number of a node or an element that a mesh has; files with larger ones get new numbers from 1


def plain(text) -> str:
    """A text as the name of a group."""
    name = re.sub(r"[^a-z0-9_]+", "_", str(text).lower()).strip("_") or "group"
    return name if name[0].isalpha() else f"g{name}"


class Names:
    """Names of groups, of letters, digits and _ in lower case, each once; `taken`: words that no group may have."""

    def __init__(self, taken):
        self.taken = set(taken)

    def free(self, text: str) -> str:
        """The name that `text` becomes, with a number where another one has it already."""
        name = found = plain(text)
        count = 1
        while found in self.taken:
            count += 1
            found = f"{name}_{count}"
        self.taken.add(found)
        return found


class MeshFile:
    """Cells by their nodes, each with the names of its groups; a cell comes again where two elements want it."""

    def __init__(self):
        self.cells: list = []  # (family, nodes, number or None, names)
        self.places: dict = {}  # (family, nodes) -> place of the first in `cells`

    def add(self, family: str, nodes, name: str | None, number: int | None = None) -> None:
        """A new cell of an element, in a group or none."""
        nodes = tuple(nodes)
        self.places.setdefault((family, frozenset(nodes)), len(self.cells))
        self.cells.append((family, nodes, number, {name} if name else set()))

    def mark(self, family: str, nodes, name: str) -> None:
        """Puts the cell on these nodes into a group, be it an element's or a place alone."""
        at = self.places.get((family, frozenset(nodes)))
        if at is None:
            self.add(family, nodes, name)
        else:
            self.cells[at][3].add(name)

    def text(self, nodes: dict) -> str:
        """The file, with the nodes that its cells use."""
        used = sorted({node for _, cell, _, _ in self.cells for node in cell})
        tag = {node: node if used[-1] <= LARGEST else k for k, node in enumerate(used, 1)}
        numbers = self._numbers()
        groups, entities, blocks = self._sort()
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
        lines += [f'{dimension} {number} "{name}"' for (dimension, name), number in groups.items()]
        lines += ["$EndPhysicalNames", "$Entities",
                  " ".join(str(sum(key[0] == dimension for key in entities)) for dimension in range(4))]
        for dimension in range(4):
            for (own, tags), entity in entities.items():
                if own == dimension:
                    box = "0 0 0" if dimension == 0 else "0 0 0 0 0 0"
                    lines.append(" ".join([str(entity), box, str(len(tags)), *map(str, tags)])
                                 + ("" if dimension == 0 else " 0"))
        first = next(iter(entities)) if entities else (0, ())
        lines += ["$EndEntities", "$Nodes", f"1 {len(used)} {tag[used[0]]} {tag[used[-1]]}",
                  f"{first[0]} {entities[first]} 0 {len(used)}", *(str(tag[node]) for node in used)]
        lines += [" ".join(map(repr, nodes[node])) for node in used]
        lines += ["$EndNodes", "$Elements", f"{len(blocks)} {len(self.cells)} {min(numbers)} {max(numbers)}"]
        for (dimension, entity, kind), cells in blocks.items():
            lines.append(f"{dimension} {entity} {kind} {len(cells)}")
            lines += [" ".join(map(str, (numbers[at], *(tag[node] for node in self.cells[at][1])))) for at in cells]
        return "\n".join([*lines, "$EndElements", ""])

    def _numbers(self) -> list:
        """Those of the file where each stands once, and new ones above for all else."""
        given, numbers = set(), []
        if max([number for _, _, number, _ in self.cells if number] or [0]) > LARGEST:
            return list(range(1, len(self.cells) + 1))
        following = max([number for _, _, number, _ in self.cells if number] or [0]) + 1
        for _, _, number, _ in self.cells:
            if number is None or number < 1 or number in given:
                number, following = following, following + 1
            given.add(number)
            numbers.append(number)
        return numbers

    def _sort(self) -> tuple:
        """Groups with their numbers, entities by dimension and groups, and cells by entity and type."""
        groups: dict = {}
        entities: dict = {}
        blocks: dict = {}
        for at, (family, nodes, _, names) in enumerate(self.cells):
            dimension, kind = TYPES[family, len(nodes)]
            tags = tuple(sorted(groups.setdefault((dimension, name), len(groups) + 1) for name in sorted(names)))
            entity = entities.setdefault((dimension, tags), len(entities) + 1)
            blocks.setdefault((dimension, entity, kind), []).append(at)
        return groups, entities, blocks
