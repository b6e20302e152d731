"""Supports and constraints of Abaqus and CalculiX decks."""

from .abaqus_cards import Block
from .cards import number, whole
from .joints import Shared, follow_in_part, hold_turned, is_whole, turning_nodes
from .model import ALL, BEAMS, RX, RY, RZ, TRANSLATIONS, X, Y, Z, InputFault, Reading

NAMED = {"ENCASTRE": ALL, "PINNED": TRANSLATIONS, "XSYMM": X | RY | RZ, "YSYMM": Y | RX | RZ, "ZSYMM": Z | RX | RY,
         "XASYMM": Y | Z | RX, "YASYMM": X | Z | RY, "ZASYMM": X | Y | RZ}
WHOLE_RELEASES = ("ALLM", "M1-M2-T")


def span_of(values, place: str) -> int:
    """Components from the first number to the second, or the first alone. Throws InputFault."""
    first, last = values[0], (values[1:] or values)[0]
    if not 1 <= first <= last:
        raise InputFault(f"{place}: components from {first} to {last}")
    return sum(1 << (dof - 1) for dof in range(first, min(last, 6) + 1))


class JointReader(Reading):
    """`reader` is the whole deck's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.equal = Shared(self.model, "tied", "EQUATION",
                            "equations join all displacements of two nodes that coincide")
        self.waiting: list = []  # (name, reference, nodes, components or None, block)
        self.handlers = {"BOUNDARY": self._boundary, "RIGID BODY": self._rigid, "COUPLING": self._coupling,
                         "KINEMATIC COUPLING": self._kinematic, "MPC": self._mpc, "EQUATION": self._equation,
                         "TIE": self._tie, "RELEASE": self._release}

    def _boundary(self, block: Block, scope, motion) -> bool | None:
        if block.name("TYPE", "DISPLACEMENT") != "DISPLACEMENT":
            return self.note(block.keyword, "motions of the ground are told in the scene")
        if block.name("OP", "MOD") == "NEW" and block.data:
            self.model.said.append(f"{block.place}: supports of all steps are taken together")
        for place, fields in block.data:
            if len(fields) < 2:
                raise InputFault(f"{place}: *BOUNDARY has a node or set and its components")
            word = fields[1].upper()
            if word in NAMED:
                components = NAMED[word]
            else:
                first = whole(fields[1], place)
                last = whole(fields[2], place) if len(fields) > 2 and fields[2] else first
                if first > 6 or first == last == 0:  # temperature and the like
                    self.note("BOUNDARY", "")
                    continue
                components = span_of((first, last), place)
                if len(fields) > 3 and fields[3] and number(fields[3], place) != 0:
                    self.model.said.append(f"{place}: a displacement of {fields[3]} is held at zero")
            for node in self.reader.nodes_of(fields[0], scope, place):
                axes = self.reader.axes.get(node)
                if axes is None and motion.axis:
                    axes = tuple(motion.turn(axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
                if not hold_turned(self.model, node, components, axes, "BOUNDARY", place):
                    return False
        return None

    def _rigid(self, block: Block, scope, _motion) -> bool | None:
        nodes = list(self.reader.nodes_of(block.name("REF NODE"), scope, block.place))
        if pins := "PIN NSET" in block.parameters:
            members = self.reader.nodes_of(block.name("PIN NSET"), scope, block.place)
            self.waiting.append(("rigid", [nodes[0], *members], TRANSLATIONS, block))
        for key in ("NSET", "TIE NSET"):
            if key in block.parameters:
                nodes += self.reader.nodes_of(block.name(key), scope, block.place)
        if "ELSET" in block.parameters:
            for raw in self.reader.elements_of(block.name("ELSET"), scope, block.place):
                nodes += raw.nodes
        if "ANALYTICAL SURFACE" in block.parameters:
            return self.reader.lose_block(block, "analytical surfaces are not known")
        if len(nodes) > 1:
            self.model.rigid.append(("rigid", sorted(set(nodes)), block.place))
        return False if pins else None

    def _coupling(self, block: Block, scope, motion) -> bool | None:
        reference = self.reader.nodes_of(block.name("REF NODE"), scope, block.place)
        nodes = self.reader.surface_nodes(block.name("SURFACE"), scope, block.place)
        followers = self.reader.followers(block)
        if not followers or followers[0].keyword != "KINEMATIC":
            what = followers[0] if followers else block
            return self.lose(f"COUPLING {what.keyword}", "couplings that distribute forces are not known", block.place)
        components = self._ranges(followers[0])
        return self._couple(block.parameters.get("CONSTRAINT NAME", "coupling"), [*reference, *nodes], components, block, motion)

    def _couple(self, name: str, nodes: list, components: int, block: Block, motion) -> bool:
        """False: the card is counted at the end. Of a turned instance all displacements couple, or none."""
        if motion.axis and not {components & TRANSLATIONS, components >> 3} <= {0, TRANSLATIONS}:
            return self.lose(block.keyword, "components of nodes that follow a body are along the global axes", block.place)
        self.waiting.append((name, nodes, components, block))
        return False

    def _ranges(self, block: Block) -> int:
        components = 0
        for place, fields in block.data:
            values = [whole(text, place) for text in fields if text]
            if values:
                components |= span_of(values, place)
        return components or ALL

    def _kinematic(self, block: Block, scope, motion) -> bool | None:
        reference, following = self.reader.nodes_of(block.name("REF NODE"), scope, block.place), {}
        for place, fields in block.data:
            values = [whole(text, place) for text in fields[1:] if text]
            for node in self.reader.nodes_of(fields[0], scope, place):
                following[node] = following.get(node, 0) | (span_of(values, place) if values else ALL)
        for components in sorted(set(following.values()) or {ALL}):
            nodes = [node for node, own in following.items() if own == components]
            self._couple("coupling", [*reference, *nodes], components, block, motion)
        return False

    def _mpc(self, block: Block, scope, _motion) -> bool | None:
        for place, fields in block.data:
            kind = fields[0].upper()
            nodes = [node for text in fields[1:] if text for node in self.reader.nodes_of(text, scope, place)]
            if kind == "BEAM":
                self.model.rigid.append(("rigid", nodes, place))
            elif kind == "TIE":
                self.waiting.append(("tied", nodes, None, block))
            elif kind == "PIN":
                self.model.pins.append((set(nodes), place))
            else:
                self.lose(f"MPC {kind}", "this constraint is not known", place)
                continue
            self.use("MPC")
        return False

    def _equation(self, block: Block, scope, _motion) -> bool | None:
        if set(block.parameters) & {"REMOVE", "REMOVE ALL"}:
            return False  # a loss by this parameter
        rows = iter(block.data)
        for place, fields in rows:
            terms, values = whole(fields[0], place), []
            if not 1 <= terms <= 1000:
                raise InputFault(f"{place}: an equation of {terms} terms")
            while len(values) < 3 * terms:  # up to four terms in a line, or fewer
                more = next(rows, (place, []))[1]
                values += more
                while len(values) % 3 and not values[-1]:
                    values.pop()
                if not any(more):
                    break
            if len(values) < 3 * terms:
                raise InputFault(f"{place}: an equation of {terms} terms has a node, a component and a factor for each")
            parts = [(values[3 * k], whole(values[3 * k + 1], place), number(values[3 * k + 2],
                                                                             place)) for k in range(terms)]
            if any(component < 1 for _, component, _ in parts):
                raise InputFault(f"{place}: components of an equation are from 1 to 6")
            if terms == 2 and parts[0][1] == parts[1][1] <= 6 and parts[0][2] == -parts[1][2] != 0:
                pairs = [self.reader.nodes_of(part[0], scope, place) for part in parts]
                if len(pairs[0]) == len(pairs[1]):
                    for pair in zip(*pairs):
                        self.equal.add(pair, 1 << (parts[0][1] - 1), place)
                    continue
            self.lose("EQUATION", self.equal.why, place)
        return False

    def _tie(self, block: Block, scope, _motion) -> bool | None:
        for place, fields in block.data:
            if len(fields) < 2:
                raise InputFault(f"{place}: *TIE has two surfaces")
            first, second = (text.upper() for text in fields[:2])
            if second not in self.model.facet_sets:
                self.lose("TIE", "the second surface of a tie is one of elements", place)
                continue
            if first not in self.model.facet_sets:
                self.model.node_sets.setdefault(first, self.reader.surface_nodes(first, scope, place))
            self.model.ties.append((first, second))
            self.use(block.keyword)
        return False

    def _release(self, block: Block, scope, _motion) -> bool | None:
        for place, fields in block.data:
            end, what = fields[1].upper() if len(fields) > 1 else "", fields[2].upper() if len(fields) > 2 else "ALLM"
            if end not in ("S1", "S2"):
                raise InputFault(f"{place}: *RELEASE has an element, S1 or S2, and what is released")
            for raw in self.reader.elements_of(fields[0], scope, place):
                if raw.element is None or raw.element.kind not in BEAMS:
                    raise InputFault(f"{place}: element {raw.number} is no beam")
                if what not in WHOLE_RELEASES:
                    self.lose(f"RELEASE {what}", "a hinge lets all three rotations go; allowed, it does here", place)
                ends = list(raw.element.hinged)
                ends[int(end[1]) - 1] = True
                raw.element.hinged = tuple(ends)
            self.use(block.keyword)
        return False

    def finish(self) -> None:
        """Couplings and equations, once it is known which nodes turn."""
        turning = turning_nodes(self.model)
        for name, nodes, components, block in self.waiting:
            if components is None or is_whole(components, nodes[1:], turning):
                self.model.rigid.append((name, nodes, block.place))
                self.use(block.keyword)
            else:
                follow_in_part(self.model, name, nodes[0], nodes[1:], components, self.reader.axes.get, block.keyword, block.place)
        self.equal.finish()
