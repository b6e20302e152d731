"""Reads universal files (.unv) of Salome and I-deas into the neutral model: nodes, cells of first order, groups of both; a
file without groups has those of its cells' physical properties, by their numbers."""

from pathlib import Path

from .cards import cut, lines_of, number, whole
from .model import BAR, Element, InputFault, Model
from .second_order import by_corners

# Kind of element and nodes by "FE descriptor id".
CELLS = {**dict.fromkeys((11, 21, 22, 136), (BAR, 2)), **dict.fromkeys((41, 51, 61, 81, 91), ("shell", 3)),
         **dict.fromkeys((44, 54, 64, 84, 94), ("shell", 4)), 111: ("tet4", 4), 112: ("wedge6", 6), 115: ("hex8", 8),
         137: ("point", 1), 161: ("point", 1)}
# Of second order: nodes along the edges in turn, of solids floor by floor; where the corners are among them.
SECOND = {**dict.fromkeys((22, 24), (BAR, 3, (0, 2))), **dict.fromkeys((42, 52, 62, 72, 82, 92), ("shell", 6, (0, 2, 4))),
          **dict.fromkeys((45, 55, 65, 75, 85, 95), ("shell", 8, (0, 2, 4, 6))), 118: ("tet4", 10, (0, 2, 4, 9)),
          113: ("wedge6", 15, (0, 2, 4, 9, 11, 13)), 116: ("hex8", 20, (0, 2, 4, 6, 12, 14, 16, 18))}
GROUPS = (2435, 2452, 2467, 2477)
UNREAD = {15: "nodes", 781: "nodes", 71: "elements", 780: "elements",
          **dict.fromkeys((752, 2400, 2417, 2429, 2430, 2432), "groups")}


class Records:
    """Lines of a dataset, taken one by one."""

    def __init__(self, place: str):
        self.place, self.lines, self.at = place, [], 0

    def more(self) -> bool:
        return self.at < len(self.lines)

    def line(self) -> str:
        """The next line. Throws InputFault where there is none."""
        if not self.more():
            raise InputFault(f"{self.place}: a dataset that ends too early")
        self.place, line = self.lines[self.at]
        self.at += 1
        return line

    def integers(self, least: int) -> list:
        """Whole numbers of the next line, ten columns each."""
        values = [whole(word, self.place) for word in cut(self.line(), (10,)) if word]
        if len(values) < least:
            raise InputFault(f"{self.place}: {len(values)} numbers, and not {least}")
        return values

    def reals(self) -> tuple:
        """Three numbers of 25 columns each."""
        line = self.line()
        return tuple(number(line[at:at + 25], self.place) for at in (0, 25, 50))


def _datasets(path: Path) -> list:
    found: list = []
    inside = False
    for place, line in lines_of(path):
        if line.strip() == "-1":
            inside = not inside
            if inside:
                found.append(Records(place))
        elif inside:
            found[-1].lines.append((place, line))
    if inside:
        raise InputFault(f"{found[-1].place}: the file ends within this dataset")
    return [(dataset.integers(1)[0], dataset) for dataset in found]


def _units(model: Model, records: Records, _) -> None:
    records.line()
    factor = records.reals()[0]
    if factor != 1:
        model.said.append(f"{records.place}: dataset 164 has {factor:g} for lengths; taken are those of --units")


def _systems(_model, records: Records, _) -> None:
    records.line()
    records.line()
    while records.more():
        if records.integers(2)[1] != 0:
            raise InputFault(f"{records.place}: a coordinate system that is not Cartesian; export without")
        records.line()  # its name
        for row in range(4):
            if records.reals() != tuple(float(row == d) for d in range(3)):
                raise InputFault(f"{records.place}: a coordinate system that is turned or moved; export without")


def _nodes(model: Model, records: Records, _) -> None:
    while records.more():
        label = records.integers(1)[0]
        if label in model.nodes:
            raise InputFault(f"{records.place}: node {label} occurs twice")
        model.nodes[label] = records.reals()
        model.cards.use("NODES")


def _cells(model: Model, records: Records, places: dict) -> None:
    """Elements, and for `places` by label where each is among them: None if it is lost."""
    while records.more():
        label, kind, property_, _, _, count = records.integers(6)[:6]
        place, nodes = records.place, []
        if not 1 <= count <= 100:
            raise InputFault(f"{place}: an element of {count} nodes")
        if label in places:
            raise InputFault(f"{place}: element {label} occurs twice")
        if kind in (11, 21, 22, 23, 24):  # beams and rods have a line more
            records.line()
        while len(nodes) < count:
            nodes += records.integers(1)
        known, width = CELLS.get(kind, ("", 0))
        if width != len(nodes) and SECOND.get(kind, ("", 0))[1] == len(nodes):
            known, _, corners = SECOND[kind]
            nodes = by_corners(model, f"ELEMENTS {kind} OF {len(nodes)}", known, nodes, corners, place)
        elif width != len(nodes):
            places[label] = None
            model.cards.lose(f"ELEMENTS {kind} OF {len(nodes)}", "elements of first order are known", place)
            continue
        places[label] = len(model.elements)
        model.elements.append(Element(known, label, tuple(nodes), property_, place=place))
        if width == len(nodes):
            model.cards.use(f"ELEMENTS {kind}")


def _groups(model: Model, records: Records, places: dict) -> None:
    while records.more():
        head = records.integers(8)
        name, left, members = records.line().strip() or str(head[0]), head[7], []
        while left > len(members) // 4:
            members += records.integers(4)
        model.cards.use("GROUPS")
        for kind, label in zip(members[:4 * left:4], members[1:4 * left:4]):
            if kind == 7 and label in model.nodes:
                model.node_sets.setdefault(name, []).append(label)
            elif kind == 8 and label in places:
                if places[label] is not None:
                    model.element_sets.setdefault(name, []).append(places[label])
            else:
                what = {7: f"node {label}", 8: f"element {label}"}.get(kind, f"something else (type {kind})")
                raise InputFault(f"{records.place}: group '{name}' has {what}, which is no cell or node of the file")


READERS = {164: _units, 2420: _systems, 2411: _nodes, 2412: _cells, **dict.fromkeys(GROUPS, _groups)}


def read(path: Path) -> Model:
    """The model of a file. Throws InputFault."""
    model = Model(path.stem, has_properties=False)
    places: dict = {}
    for set_, records in sorted(_datasets(path), key=lambda one: one[0] in GROUPS):
        if set_ in UNREAD:
            raise InputFault(f"{records.place}: dataset {set_} of {UNREAD[set_]} is not known; export as .med")
        if set_ in READERS:
            READERS[set_](model, records, places)
    if not model.element_sets and not model.node_sets:
        for at, element in enumerate(model.elements):
            model.element_sets.setdefault(str(element.property), []).append(at)
    return model
