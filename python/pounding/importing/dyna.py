"""Reads LS-DYNA decks (.k, .key) into the neutral model. Axis s of a beam there, towards its third node, is z of the
program, its t axis is -y."""

from pathlib import Path

from . import sections
from .dyna_cards import EIGHT, Card, Keyword, keywords_of
from .dyna_joints import JointReader
from .geometry import applied, axis_between, difference, frame_about, length, normal_of, scaled, shape_of, unit
from .model import BAR, AxialSpring, Element, InputFault, Material, Model, PointMass, Property, Reading, Section, Spring
from .second_order import by_corners

NODE = (8, 16, 16, 16, 8, 8)
MASS = (8, 8, 16, 8)
DISCRETE = (8, 8, 8, 8, 8, 16, 8, 16)
TITLES = ("DATABASE_", "CONTROL_", "DEFINE_CURVE", "DEFINE_TABLE", "DEFINE_FUNCTION", "TITLE", "KEYWORD", "END",
          "HOURGLASS",
          "TERMINATION_", "INTERFACE_", "COMMENT", "DEFINE_VECTOR", "DEFINE_COORDINATE", "DEFINE_BOX", "CASE_")
LOADS = ("LOAD_", "INITIAL_", "EOS_")
DAMPING = ("DAMPING_",)
SOLID_FORMS = {2: "hex8_full", 18: "hex8_full"}
MORE = {"ELEMENT_SOLID_H20": 20, "ELEMENT_SOLID_H27": 27, "ELEMENT_SOLID_TET4TOTET10": 0}  # nodes on cards behind
SECOND_ORDER = {16: 4, 17: 4, 23: 8, 24: 8}  # corners of these forms of solids


class Reader(Reading):
    """The whole deck. `model` is the result."""

    def __init__(self, path: Path):
        super().__init__(Model(path.stem))
        self.keywords = keywords_of(path)
        self.parts: dict = {}  # part -> (title, section, material, place)
        self.materials: dict = {}  # material -> (keyword, its cards)
        self.sections: dict = {}  # section -> (keyword, its cards)
        self.ways: dict = {}  # orientation of discrete elements -> vector
        self.elements: dict = {}  # family and number -> place in the model's elements
        self.members: dict = {}  # part -> nodes
        self.by_part: dict = {}  # part -> places in the model's elements
        self.joints = JointReader(self)
        tables = {"PART": self._part, "NODE": self._nodes, "DEFINE_SD_ORIENTATION": self._way}
        for keyword in self.keywords:
            if keyword.name in tables:
                tables[keyword.name](keyword)
            elif keyword.name.startswith("MAT_"):
                own = keyword.card(0).int(0)
                self.new("material", own, (keyword.name, [line for _, line in keyword.lines]), keyword.place)
                self.materials[own] = keyword
            elif keyword.name.startswith("SECTION_"):
                self._section(keyword)
        self.handlers = {**dict.fromkeys(("ELEMENT_SOLID", *MORE), self._solids), "ELEMENT_SHELL": self._shells,
                         "ELEMENT_SHELL_THICKNESS": self._shells, "ELEMENT_SHELL_OFFSET": self._shells,
                         "ELEMENT_BEAM": self._beams, "ELEMENT_BEAM_ORIENTATION": self._beams,
                         "ELEMENT_BEAM_OFFSET": self._beams,
                         "ELEMENT_BEAM_THICKNESS": self._beams, "ELEMENT_DISCRETE": self._discrete,
                         "ELEMENT_MASS": self._masses, "ELEMENT_INERTIA": self._inertias,
                         "ELEMENT_INERTIA_OFFSET": self._inertias, "DAMPING_GLOBAL": self._damping,
                         **self.joints.handlers}
        first = ("ELEMENT_", "SET_", "MAT_")  # to which others refer
        for keyword in sorted(self.keywords, key=lambda one: [not one.name.startswith(head) for head in first]):
            self._handle(keyword)
        self.joints.finish()

    def _handle(self, keyword: Keyword) -> None:
        name = keyword.name
        if name in self.handlers:
            if self.handlers[name](keyword) is not False and not name.startswith("ELEMENT_"):
                self.use(name)  # elements are counted one by one
        elif name in ("PART", "NODE", "DEFINE_SD_ORIENTATION") or name.startswith(("SECTION_", "INCLUDE")):
            self.use(name, len(keyword.lines) if name == "NODE" else 1)
        elif name.startswith("MAT_"):
            self.joints.material(keyword)
        elif name.startswith(TITLES):
            self.note(name, "titles, output and control")
        elif name.startswith(LOADS):
            self.note(name, "loads and steps are not part of the model")
        elif name.startswith(DAMPING):
            self.note(name, "damping is told in the scene")
        else:
            count = len(keyword.lines) if name.startswith("ELEMENT_") else 1
            self.lose(name, "not known", keyword.place, max(1, count))

    # Tables.

    def _nodes(self, keyword: Keyword) -> None:
        for card in keyword.cards(*NODE):
            own = card.int(0)
            if own < 1:
                raise InputFault(f"{card.place}: node {own} is no number")
            if not self.new("node", own, (card.vector(1), card.int(4), card.int(5)), card.place):
                continue
            self.model.nodes[own] = card.vector(1)
            for at, shift in ((4, 0), (5, 3)):
                self.joints.hold_code(own, card.int(at), shift, card.place)

    def _part(self, keyword: Keyword) -> None:
        rows = keyword.lines
        for at in range(0, len(rows) - 1, 2):
            card = keyword.card(at + 1)
            self.new("part", card.int(0), card.fields, card.place)
            self.parts[card.int(0)] = rows[at][1].strip() or f"part_{card.int(0)}", card.int(1), card.int(2), card.place

    def _section(self, keyword: Keyword) -> None:
        """Two cards each, of solids one."""
        step = 1 if keyword.name == "SECTION_SOLID" else 2
        for at in range(0, len(keyword.lines) - step + 1, step):
            first, second = keyword.card(at), keyword.card(at + step - 1)
            self.new("section", first.int(0), (keyword.name, first.fields, second.fields), first.place)
            self.sections[first.int(0)] = keyword.name[8:], first, second

    def _way(self, keyword: Keyword) -> None:
        for card in keyword.cards():
            self.new("orientation", card.int(0), card.fields, card.place)
            if card.int(1) not in (0, 2):
                self.lose("DEFINE_SD_ORIENTATION", "springs act along a vector, or from node to node", card.place)
            elif card.int(1) == 2:
                ends = [self.model.at(card.int(k), card.place) for k in (5, 6)]
                self.ways[card.int(0)] = difference(ends[1], ends[0])
            else:
                self.ways[card.int(0)] = card.vector(2)

    def part_of(self, card: Card, at: int, family: str) -> tuple:
        """Title, section's cards and material's number of an element's part. Throws InputFault."""
        number = card.int(at)
        if number not in self.parts:
            raise InputFault(f"{card.place}: part {number} is not in the deck")
        title, section, material, place = self.parts[number]
        if section not in self.sections or not self.sections[section][0].startswith(family):
            raise InputFault(f"{place}: part {number} has no *SECTION_{family} {section}")
        return title, self.sections[section][1:], material, number

    def elastic(self, number: int, place: str) -> None:
        """Puts a material of elements into the model. Throws InputFault."""
        if number in self.model.materials:
            return
        if number not in self.materials:
            raise InputFault(f"{place}: material {number} is not in the deck")
        card = self.materials[number].card(0)
        self.model.materials[number] = Material(card.real(2), card.real(3), card.real(1), place=card.place)

    def _add(self, kind: str, own: int, nodes, key, place: str, part: int, **more) -> None:
        for node in nodes:
            self.model.at(node, place)
        family = "shell" if kind == "shell" else "beam" if kind in ("beam", BAR) else "solid"
        if not self.new(f"{family} element", own, (kind, tuple(nodes), key, more), place):
            return
        self.elements[kind, own] = len(self.model.elements)
        self.members.setdefault(part, set()).update(nodes)
        self.by_part.setdefault(part, []).append(len(self.model.elements))
        self.model.elements.append(Element(kind, own, tuple(nodes), key, place=place, **more))

    # Elements.

    def _solids(self, keyword: Keyword) -> None:
        rows = iter(keyword.cards(*EIGHT))
        for card in rows:
            nodes = [card.int(k) for k in range(2, 10)]
            if not any(nodes):
                nodes, count = [], MORE.get(keyword.name) or 10
                while len(nodes) < count:
                    second = next(rows, None)
                    if second is None:
                        raise InputFault(f"{card.place}: element {card.int(0)} has no card of nodes")
                    nodes += [second.int(k) for k in range(10)]
            title, (form, _), material, part = self.part_of(card, 1, "SOLID")
            corners = 8 if MORE.get(keyword.name) else SECOND_ORDER.get(form.int(1, 1), 4 if any(nodes[8:]) else 0)
            second_order = corners or keyword.name in MORE
            if second_order:
                corners = corners or 4
                kind = "tet4" if corners == 4 else "hex8"
                card_name = keyword.name if keyword.name in MORE else "ELEMENT_SOLID of second order"
                nodes = list(by_corners(self.model, card_name, kind, nodes, corners, card.place))
            nodes = [node for node in nodes if node]
            if not nodes:
                raise InputFault(f"{card.place}: element {card.int(0)} has no nodes")
            nodes += nodes[-1:] * (8 - len(nodes))
            shape, nodes = shape_of(nodes)
            if shape is None:
                self.lose("ELEMENT_SOLID PYRAMID", "this shape is not known", card.place)
                continue
            self.elastic(material, card.place)
            self.model.properties.setdefault(part, Property(title, material, place=card.place))
            kind = SOLID_FORMS.get(form.int(1, 1), "hex8") if shape == "brick" else shape
            self._add(kind, card.int(0), nodes, part, card.place, part)
            if not second_order:
                self.use(keyword.name)

    def _shells(self, keyword: Keyword) -> None:
        rows = iter(keyword.cards(*EIGHT))
        wide = iter(keyword.cards(16, 16, 16, 16, 16))
        for card in rows:
            next(wide)
            more = None
            if keyword.name != "ELEMENT_SHELL":
                next(rows, None)
                more = next(wide, None)
                if more is None:
                    raise InputFault(f"{card.place}: element {card.int(0)} has no second card")
            nodes = [card.int(k) for k in range(2, 6)]
            if any(card.int(k) for k in range(6, 10)):
                by_corners(self.model, "ELEMENT_SHELL of second order", "shell", [card.int(k) for k in range(2, 10)], 4,
                           card.place)
            nodes = nodes[:3] if nodes[3] in (0, nodes[2]) else nodes
            title, (_, second), material, part = self.part_of(card, 1, "SHELL")
            thicknesses = [second.real(k) for k in range(4)]
            offset = -second.real(4) / 2
            if keyword.name == "ELEMENT_SHELL_THICKNESS" and any(more.real(k) for k in range(4)):
                thicknesses = [more.real(k) for k in range(4)]
            given = {value for value in thicknesses[:len(nodes)] if value}
            if len(given) > 1:
                self.lose("THICKNESS THAT VARIES", "a shell has one thickness; allowed, the largest holds", card.place)
            if not given:
                raise InputFault(f"{card.place}: element {card.int(0)} has no thickness")
            thickness = max(given)
            self.elastic(material, card.place)
            key = f"{part} {thickness!r}"
            self.model.properties.setdefault(key, Property(title, material, thickness=thickness, added=second.real(5),
                                                           place=card.place))
            arm = offset * thickness + (more.real(0) if keyword.name == "ELEMENT_SHELL_OFFSET" else 0.0)
            places = [self.model.at(node, card.place) for node in nodes]
            arms = (scaled(normal_of(places, f"{card.place}: element {card.int(0)}"),
                           arm),) * len(nodes) if arm else None
            self._add("shell", card.int(0), nodes, key, card.place, part, arms=arms)
            self.use(keyword.name)

    def _beams(self, keyword: Keyword) -> None:
        rows, wide = iter(keyword.cards(*EIGHT)), iter(keyword.cards(16))
        for card in rows:
            next(wide)
            own = next(wide, None) if keyword.name != "ELEMENT_BEAM" else None
            more = next(rows, None) if keyword.name != "ELEMENT_BEAM" else Card([], card.place)
            if more is None:
                raise InputFault(f"{card.place}: element {card.int(0)} has no second card")
            title, (first, second), material, part = self.part_of(card, 1, "BEAM")
            key = part
            if keyword.name == "ELEMENT_BEAM_THICKNESS":  # dimensions or numbers of its own, where there are some
                fields = [own.text(k) if k < 5 and own.real(k) else second.text(k) for k in range(8)]
                second = Card(fields, own.place)
                key = f"{part} {','.join(fields)}"
            form = first.int(1, 1)
            nodes = card.int(2), card.int(3)
            ends = [self.model.at(node, card.place) for node in nodes]
            if form == 6:
                self._discrete_beam(card, title, second, material, nodes, part)
                continue
            self.use(keyword.name)
            self.elastic(material, card.place)
            added = first.real(6)
            if form == 3:
                self.model.properties.setdefault(key, Property(title, material, area=second.real(0), added=added,
                                                               place=card.place))
                self._add(BAR, card.int(0), nodes, key, card.place, part)
                continue
            section, off = self._cross_section(form, first, second)
            if section is None:
                self.lose(f"SECTION_BEAM ELFORM {form}", "this form is not known", first.place)
            who = f"{card.place}: element {card.int(0)}"
            axis = axis_between(ends, who)
            if keyword.name == "ELEMENT_BEAM_ORIENTATION":
                way = more.vector(0)
            elif card.int(4):
                way = difference(self.model.at(card.int(4), card.place), ends[0])
            elif section is not None and section.inertia_y == section.inertia_z and not any(off):
                way = min(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
                          key=lambda one: abs(sum(a * b for a, b in zip(one, axis))))
            else:
                raise InputFault(f"{who} has no third node for the direction of its section")
            frame = frame_about(axis, way, who)
            arms = [applied(frame, (0.0, off[1], -off[0])) for _ in nodes]  # s is z, t is -y
            if keyword.name == "ELEMENT_BEAM_OFFSET":
                arms = [tuple(a + b for a, b in zip(arm, more.vector(at))) for arm, at in zip(arms, (0, 3))]
            hinged = [self._released(card, at) for at in (5, 7)]
            self.model.properties.setdefault(key, Property(title, material, section=section, added=added,
                                                           place=card.place))
            long = tuple(arm if length(arm) > 0 else None for arm in arms)
            self._add("beam", card.int(0), nodes, key, card.place, part, z_axis=frame[2], arms=long if any(long)
                      else None, hinged=tuple(hinged))

    def _released(self, card: Card, at: int) -> bool:
        """Whether an end turns on its own, by its codes of translations and rotations."""
        moves, turns = card.int(at), card.int(at + 1)
        if moves or turns not in (0, 7):
            self.lose("RELEASES OF ELEMENT_BEAM", "a hinge lets all three rotations go; allowed, it does here, where "
                                                  "it has one of them", card.place)
        return turns != 0

    def _cross_section(self, form: int, first: Card, second: Card) -> tuple:
        """Section, and how far along s and t the nodes lie from the centroid."""
        if form in (1, 4, 5, 11):
            s, t = second.real(0), second.real(2)
            if second.real(1, s) not in (0.0, s) or second.real(3, t) not in (0.0, t):
                self.lose("SECTION_BEAM THAT TAPERS", "beams that taper are not known; allowed, end 1 "
                                                                  "holds", second.place)
            if first.int(4) == 1:
                one = sections.ring(s / 2, t / 2)
            elif first.int(4) == 0:
                one = sections.rectangle(t, s)
            else:
                return None, (0.0, 0.0)
            factor = first.real(2, 1.0)
            return sections.with_shear(one, factor, factor), (second.real(4) * s / 2, second.real(5) * t / 2)
        if form in (2, 12, 13):
            area, about_s, about_t, torsion, shear = (second.real(k) for k in range(5))
            if second.real(5):
                self.lose("IST OF SECTION_BEAM", "a product of inertia is not known; give principal axes", second.place)
            return Section(area, about_t, about_s, torsion or about_s + about_t, shear, shear), (0.0, 0.0)
        return None, (0.0, 0.0)

    def _discrete_beam(self, card: Card, title: str, second: Card, material: int, nodes, part: int) -> bool | None:
        """Form 6 with *MAT_LINEAR_ELASTIC_DISCRETE_BEAM in the global axes."""
        keyword = self.materials.get(material)
        if keyword is None or keyword.name not in ("MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "MAT_066"):
            return self.lose("SECTION_BEAM ELFORM 6", "discrete beams are linear and elastic", card.place)
        values, dampers = keyword.card(0), keyword.card(1) if len(keyword.lines) > 1 else Card([], keyword.place)
        stiffness = tuple(values.real(2 + k) for k in range(6))
        dashpot = tuple(dampers.real(k) for k in range(6))
        way = difference(self.model.nodes[nodes[1]], self.model.nodes[nodes[0]])
        size = length(way)
        across = [k for k in range(3) if size > 0 and abs(way[k]) < (1 - 1e-9) * size and (stiffness[k] or dashpot[k])]
        if second.int(2) or across:
            return self.lose("SECTION_BEAM ELFORM 6", "discrete beams act along the global axes, between nodes that "
                                                      "coincide or along their line", card.place)
        self.model.springs.append(Spring(nodes, stiffness, dashpot, title, card.place))
        mass, inertia = values.real(1) * second.real(0) / 2, values.real(1) * second.real(1) / 2
        for node in nodes:
            if mass or inertia:
                self.model.masses.append(PointMass(node, mass, (inertia,) * 3, None, f"{title}_mass", card.place))
        self.use("ELEMENT_BEAM")

    def _discrete(self, keyword: Keyword) -> None:
        for card in keyword.cards(*DISCRETE):
            title, (first, _), material, _ = self.part_of(card, 1, "DISCRETE")
            law = self.materials.get(material)
            kind = law.name if law else ""
            if kind not in ("MAT_SPRING_ELASTIC", "MAT_S01", "MAT_DAMPER_VISCOUS", "MAT_S02"):
                self.lose("ELEMENT_DISCRETE", "springs and dampers are linear", card.place)
                continue
            self.use(keyword.name)
            if not self.new("discrete element", card.int(0), card.fields, card.place):
                continue
            value = law.card(0).real(1) * (card.real(5) or 1.0)
            both = (value, 0.0) if kind in ("MAT_SPRING_ELASTIC", "MAT_S01") else (0.0, value)
            nodes = tuple(node for node in (card.int(2), card.int(3)) if node)
            torsional, way = first.int(1), self.ways.get(card.int(4))
            if card.int(4) == 0 and len(nodes) == 2 and not torsional:
                self.model.axial_springs.append(AxialSpring(nodes, *both, title, card.place))
                continue
            if way is None and len(nodes) == 2:
                way = difference(self.model.at(nodes[1], card.place), self.model.at(nodes[0], card.place))
            direction = unit(way) if way else None
            along = [k for k in range(3) if direction and abs(abs(direction[k]) - 1) < 1e-9]
            if not along:
                self.lose("ELEMENT_DISCRETE", "springs act along and about the global axes, or between "
                                                          "two nodes", card.place)
                continue
            self.model.add_spring(nodes, along[0] + 3 * torsional, *both, title, card.place)

    # Masses and damping.

    def _masses(self, keyword: Keyword) -> None:
        for card in keyword.cards(*MASS):
            if not self.new("mass", card.int(0), card.fields, card.place):
                continue
            self.model.masses.append(PointMass(card.int(1), card.real(2), name="mass", place=card.place))
            self.use(keyword.name)

    def _inertias(self, keyword: Keyword) -> None:
        step = 3 if keyword.name.endswith("OFFSET") else 2
        for at in range(0, len(keyword.lines), step):
            card, values = keyword.card(at, *EIGHT), keyword.card(at + 1)
            if not self.new("inertia", card.int(0), (card.fields, values.fields), card.place):
                continue
            if card.int(2) or any(values.real(k) for k in (1, 2, 4)):
                self.lose("ELEMENT_INERTIA", "rotary inertia is about the global axes, without products", card.place)
                continue
            arm = keyword.card(at + 2).vector(0) if step == 3 else None
            self.model.masses.append(PointMass(card.int(1), values.real(6), (values.real(0), values.real(3),
                                                                             values.real(5)),
                                               arm if arm and length(arm) > 0 else None, "inertia", card.place))
            self.use(keyword.name)

    def _damping(self, keyword: Keyword) -> None:
        if keyword.card(0).int(0):
            self.note("DAMPING_GLOBAL", "damping that changes in time is told in the scene")
        self.model.alpha = keyword.card(0).real(1)


def read(path: Path) -> Model:
    """The model of a deck. Throws InputFault."""
    return Reader(path).model
