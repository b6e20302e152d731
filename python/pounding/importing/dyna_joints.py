"""Supports, sets, rigid bodies and materials of LS-DYNA decks."""

from .dyna_cards import Card, Keyword
from .model import X, Y, Z, InputFault, Reading

CODES = (0, X, Y, Z, X | Y, Y | Z, Z | X, X | Y | Z)
ELASTIC = ("MAT_ELASTIC", "MAT_001")
RIGID = ("MAT_RIGID", "MAT_020")
OTHERS = ("MAT_SPRING_ELASTIC", "MAT_S01", "MAT_DAMPER_VISCOUS", "MAT_S02", "MAT_LINEAR_ELASTIC_DISCRETE_BEAM",
          "MAT_066")
FAMILIES = {"SET_BEAM": ("beam", "bar"), "SET_SHELL": ("shell",), "SET_SOLID": ("hex8", "hex8_full", "wedge6", "tet4")}


class JointReader(Reading):
    """`reader` is the whole deck's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.sets: dict = {}  # set of nodes -> nodes
        self.of_part: dict = {}  # rigid part -> its nodes
        self.handlers = {"BOUNDARY_SPC_NODE": self._held, "BOUNDARY_SPC_SET": self._held, "SET_NODE": self._nodes,
                         "SET_NODE_LIST": self._nodes, "SET_NODE_LIST_GENERATE": self._nodes,
                         "SET_SEGMENT": self._segments, "CONSTRAINED_NODAL_RIGID_BODY": self._body,
                         "CONSTRAINED_EXTRA_NODES_SET": self._extra, "CONSTRAINED_EXTRA_NODES_NODE": self._extra,
                         "CONSTRAINED_RIGID_BODIES": self._merge, "CONSTRAINED_NODE_SET": self._pin,
                         "BOUNDARY_PRESCRIBED_MOTION_SET": self._moved, "BOUNDARY_PRESCRIBED_MOTION_NODE": self._moved,
                         **{name + end: self._elements for name in FAMILIES for end in ("", "_LIST")}}
        self.handlers |= dict.fromkeys(("SET_PART", "SET_PART_LIST", "SET_PART_LIST_GENERATE"), self._parts)
        self.merged: list = []

    def hold_code(self, node: int, code: int, shift: int, place: str) -> None:
        if not 0 <= code <= 7:
            raise InputFault(f"{place}: a constraint code {code}; they are from 0 to 7")
        if code:
            self.model.hold(node, CODES[code] << shift)

    def _nodes_of(self, keyword: Keyword, number: int, place: str) -> list:
        """Of a keyword that names a set, or one node."""
        if keyword.name.endswith("SET"):
            return self.nodes(number, place)
        self.model.at(number, place)
        return [number]

    def _held(self, keyword: Keyword) -> None:
        """Six flags behind a coordinate system."""
        for card in keyword.cards():
            components = sum(1 << k for k in range(6) if card.int(2 + k))
            if card.int(1) and (components & 7 not in (0, 7) or components >> 3 not in (0, 7)):
                self.lose("BOUNDARY_SPC", "supports hold along the global axes", card.place)
                continue
            for node in self._nodes_of(keyword, card.int(0), card.place):
                self.model.hold(node, components)

    def nodes(self, number: int, place: str) -> list:
        if number not in self.sets:
            raise InputFault(f"{place}: node set {number} is not in the deck")
        return self.sets[number]

    def _nodes(self, keyword: Keyword) -> None:
        own, members = keyword.card(0).int(0), []
        for card in keyword.cards()[1:]:
            values = [card.int(k) for k in range(8) if card.int(k)]
            if keyword.name.endswith("GENERATE"):
                for first, last in zip(values[::2], values[1::2]):
                    members += [node for node in self.model.nodes if first <= node <= last]
            else:
                for node in values:
                    self.model.at(node, card.place)
                members += values
        self.new("node set", own, members, keyword.place)
        self.sets[own] = members
        self.model.node_sets[f"set_{own}"] = members

    def _segments(self, keyword: Keyword) -> None:
        facets = []
        for card in keyword.cards()[1:]:
            nodes = [card.int(k) for k in range(4)]
            for node in nodes:
                if node:
                    self.model.at(node, card.place)
            facets.append(tuple(nodes[:3] if nodes[3] in (0, nodes[2]) else nodes))
        self.new("set of segments", keyword.card(0).int(0), facets, keyword.place)
        self.model.facet_sets[f"segments_{keyword.card(0).int(0)}"] = facets

    def _elements(self, keyword: Keyword) -> None:
        families = FAMILIES[keyword.name.removesuffix("_LIST")]
        found = [self.reader.elements[kind, card.int(k)] for card in keyword.cards()[1:] for k in range(8)
                 for kind in families if (kind, card.int(k)) in self.reader.elements]
        name = keyword.name[4:].removesuffix("_LIST").lower()
        self.new(f"set of {name}s", keyword.card(0).int(0), found, keyword.place)
        self.model.element_sets[f"{name}_set_{keyword.card(0).int(0)}"] = found

    def _parts(self, keyword: Keyword) -> None:
        """A set of parts is one of their elements."""
        found: list = []
        for card in keyword.cards()[1:]:
            values = [card.int(k) for k in range(8) if card.int(k)]
            spans = zip(values[::2], values[1::2]) if keyword.name.endswith("GENERATE") else zip(values, values)
            for first, last in spans:
                wanted = [part for part in sorted(self.reader.parts) if first <= part <= last]
                if not wanted:
                    raise InputFault(f"{card.place}: part {first} is not in the deck")
                found += [at for part in wanted for at in self.reader.by_part.get(part, ())]
        self.new("set of parts", keyword.card(0).int(0), found, keyword.place)
        self.model.element_sets[f"part_set_{keyword.card(0).int(0)}"] = sorted(set(found))

    def _body(self, keyword: Keyword) -> bool | None:
        lost = False
        for card in keyword.cards():
            if card.int(5) or card.int(6):
                self.lose(keyword.name, "rigid bodies couple all components of their nodes", card.place)
                lost = True
                continue
            nodes, extra = self.nodes(card.int(2) or card.int(0), card.place), card.int(3)
            nodes = [*nodes, extra] if extra in self.model.nodes else nodes
            self.model.rigid.append((f"rigid_{card.int(0)}", nodes, card.place))
        return False if lost else None

    def _extra(self, keyword: Keyword) -> None:
        for card in keyword.cards():
            part = card.int(0)
            if part not in self.of_part:
                raise InputFault(f"{card.place}: part {part} is not rigid")
            self.of_part[part] |= set(self._nodes_of(keyword, card.int(1), card.place))

    def _merge(self, keyword: Keyword) -> None:
        self.merged += [(card.int(0), card.int(1), card.place) for card in keyword.cards()]

    def _pin(self, keyword: Keyword) -> bool | None:
        card = keyword.card(0)
        if card.int(1) != 7:
            return self.lose(keyword.name, "nodes share all three displacements", card.place)
        self.model.pins.append((set(self.nodes(card.int(0), card.place)), card.place))
        return None

    def _moved(self, keyword: Keyword) -> None:
        """Nodes that a motion moves are supports: the motion is that of the ground."""
        for card in keyword.cards():
            dof, number, place = card.int(1), card.int(0), card.place
            if dof not in (1, 2, 3, 5, 6, 7):
                self.lose(keyword.name, "supports hold along the global axes", place)
                continue
            components = 1 << (dof - 1 if dof < 4 else dof - 2)
            self.model.said.append(f"{place}: nodes with a motion of their own are held; the motion is told in the "
                                   "scene")
            for node in self.nodes(number, place) if keyword.name.endswith("SET") else [number]:
                self.model.hold(node, components)

    def material(self, keyword: Keyword) -> None:
        """Counts a material, and makes the parts of a rigid one bodies."""
        number = keyword.card(0).int(0)
        parts = [part for part, (_, _, material, _) in self.reader.parts.items() if material == number]
        if keyword.name in RIGID:
            card = keyword.card(1) if len(keyword.lines) > 1 else Card([], keyword.place)
            held = 0
            if card.real(0) > 0:
                held = CODES[card.int(1) % 8] | CODES[card.int(2) % 8] << 3
            elif card.real(0) < 0:
                self.lose("CMO OF MAT_RIGID", "supports hold along the global axes", card.place)
            for part in parts:
                self.of_part.setdefault(part, set()).update(self.reader.members.get(part, ()))
                if held == 63:
                    for node in self.of_part[part]:
                        self.model.hold(node, held)
                elif held:
                    self.lose("CMO OF MAT_RIGID", "a rigid body is clamped as a whole or not at all", card.place)
        elif keyword.name in ELASTIC:
            card = keyword.card(0)
            if card.real(4) or card.real(5):
                self.model.said.append(f"{card.place}: damping DA, DB is not read; damping is told in the scene")
        elif keyword.name not in OTHERS:
            if parts:
                self.lose(keyword.name, "materials are elastic", keyword.place)
            else:
                self.note(keyword.name, "no part has this material")
            return
        self.use(keyword.name)

    def finish(self) -> None:
        for first, second, place in self.merged:
            for part in (first, second):
                if part not in self.of_part:
                    raise InputFault(f"{place}: part {part} is not rigid")
            self.of_part[first] |= self.of_part[second]  # bodies that share nodes are one
        for part, nodes in self.of_part.items():
            if nodes:
                self.model.rigid.append((f"rigid_part_{part}", sorted(nodes), self.reader.parts[part][3]))
