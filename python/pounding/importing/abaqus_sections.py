"""Sections of Abaqus and CalculiX: cross-sections of beams, shells, bars, and the mass that they carry."""

from dataclasses import replace

from . import sections
from .abaqus_cards import Block
from .cards import number, numbers
from .geometry import applied, axis_between, frame_about, normal_of, scaled, size_of
from .model import BAR, BEAMS, SHELL, SOLIDS, InputFault, Material, Property, Reading, Section

# Shear areas over the area that the manual of Abaqus gives its Timoshenko beams.
SHEAR = {"RECT": 0.85, "CIRC": 0.89, "PIPE": 0.53, "BOX": 0.44, "I": 0.44, "GENERAL": 1.0}
UNTURNED = (0.0, 0.0, -1.0)  # direction n1 where none is given


def shape_of(block: Block, shape: str) -> tuple:
    """Section with z along direction 1 of the beam and y against direction 2, and the place of its centroid along
    direction 2 from the node. Throws InputFault."""
    if not block.data:
        raise InputFault(f"{block.place}: *{block.keyword} has no dimensions")
    place, fields = block.data[0]
    values = [value for value in numbers(fields, place)]
    while values and values[-1] == 0:
        values.pop()
    needed = {"RECT": (2,), "CIRC": (1, 2), "PIPE": (2,), "BOX": (6,), "I": (7,)}[shape]
    if len(values) not in needed or min(values[1:] or values) <= 0:
        raise InputFault(f"{place}: a section {shape} has {' or '.join(map(str, needed))} dimensions above 0")
    centroid = 0.0
    if shape == "RECT":
        one = sections.rectangle(values[1], values[0])
    elif shape == "CIRC":
        if len(values) == 2 and values[0] != values[1]:
            raise InputFault(f"{place}: an elliptical section is not known")
        one = sections.ring(values[0] if len(values) == 1 else values[0] / 2)  # CalculiX gives two diameters
    elif shape == "PIPE":
        one = sections.ring(values[0], values[0] - values[1])
    elif shape == "BOX":
        if values[2] != values[4] or values[3] != values[5]:
            raise InputFault(f"{place}: a box with walls of different thickness is not known")
        one = sections.box(values[1], values[0], values[3], values[2])
    else:
        upright, middle = sections.i_shape(values[1], values[2], values[3], values[4], values[5], values[6])
        one, centroid = sections.swapped(upright), middle - values[0]  # the web lies along direction 2
    return sections.with_shear(one, SHEAR[shape], SHEAR[shape]), centroid


class SectionReader(Reading):
    """Gives elements their properties; `reader` is the whole deck's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.taken: dict = {}  # id of an element -> what its section says

    def _new(self, block: Block, material, **more) -> str:
        name = block.parameters.get("ELSET", "section").strip('"').rpartition(".")[2]
        key = f"{len(self.model.properties)} {name}"
        self.model.properties[key] = Property(name, material, place=block.place, **more)
        return key

    def _take(self, element, key: str, more=None) -> bool:
        """Gives an element its section, with `more` that belongs to it; False where it has the same already. Throws
        InputFault where it has another one."""
        one = self.model.properties[key]
        own = replace(one, name="", place=""), more
        if element.property is None:
            element.property, self.taken[id(element)] = key, own
            return True
        if self.taken[id(element)] != own:
            raise InputFault(f"{one.place}: element {element.number} has a section already, of "
                             f"{self.model.properties[element.property].place}, and another one")
        return False

    def _members(self, block: Block, scope, *kinds) -> list:
        """Elements of its set, which have to be of these kinds."""
        found = []
        for raw in self.reader.elements_of(block.name("ELSET"), scope, block.place):
            if raw.element is None:
                continue
            if raw.element.kind not in kinds:
                raise InputFault(f"{block.place}: *{block.keyword} of element {raw.number}, which is a {raw.type}")
            found.append(raw.element)
        return found

    def solid(self, block: Block, scope, _motion) -> bool | None:
        if "COMPOSITE" in block.parameters:
            return self.reader.lose_block(block, "composites are not known")
        area = number(block.data[0][1][0] or "0", block.data[0][0]) if block.data and block.data[0][1][0] else 0.0
        key = self._new(block, block.name("MATERIAL"), area=area)
        for element in self._members(block, scope, *SOLIDS, BAR):
            self._take(element, key)

    def shell(self, block: Block, scope, _motion) -> bool | None:
        for word in ("COMPOSITE", "NODAL THICKNESS", "SHELL THICKNESS"):
            if word in block.parameters:
                self._members(block, scope, SHELL)
                return self.reader.lose_block(block, f"{word.lower()} is not known")
        if not block.data:
            raise InputFault(f"{block.place}: *SHELL SECTION has no thickness")
        place, fields = block.data[0]
        thickness = number(fields[0], place)
        key = self._new(block, block.name("MATERIAL"), thickness=thickness)
        text = block.parameters.get("OFFSET", "0").strip().upper()
        offset = {"SPOS": 0.5, "SNEG": -0.5}[text] if text in ("SPOS", "SNEG") else number(text, block.place)
        for element in self._members(block, scope, SHELL):
            if self._take(element, key, offset) and offset:
                arm = scaled(normal_of([self.model.at(node, block.place) for node in element.nodes], element.place),
                             -offset * thickness)
                element.arms = (arm,) * len(element.nodes)

    def beam(self, block: Block, scope, motion) -> bool | None:
        shape = block.name("SECTION")
        if shape not in SHEAR or shape == "GENERAL":
            self._members(block, scope, *BEAMS)
            return self.reader.lose_block(block, f"cross-section {shape} is not known; give its numbers in "
                                                 "*BEAM GENERAL SECTION")
        section, centroid = shape_of(block, shape)
        key = self._new(block, block.name("MATERIAL"), section=section)
        direction = self._direction(block, 1, motion)
        for element in self._members(block, scope, *BEAMS):
            self._orient(element, key, direction, (0.0, centroid))

    def general(self, block: Block, scope, motion) -> bool | None:
        shape = block.name("SECTION", "GENERAL")
        rows = block.data
        if shape == "GENERAL":
            if len(rows) < 3:
                raise InputFault(f"{block.place}: *BEAM GENERAL SECTION has three lines: numbers, direction, E and G")
            area, i11, i12, i22, torsion = (numbers(rows[0][1], rows[0][0]) + [0.0] * 5)[:5]
            section = Section(area, i22, i11, torsion, area, area)
            if i12:
                self.reader.lose_block(block, "a product of inertia is not known; give principal axes")
        elif shape in SHEAR:
            section = shape_of(block, shape)[0]
        else:
            self._members(block, scope, *BEAMS)
            return self.reader.lose_block(block, f"cross-section {shape} is not known")
        place, fields = rows[2] if len(rows) > 2 else (block.place, [])
        young, shear = (numbers(fields, place) + [0.0] * 2)[:2]
        material = f"{block.name('ELSET')} material"
        poisson = block.number("POISSON", 0.0) if "POISSON" in block.parameters else None
        own = Material(young, poisson, block.number("DENSITY", 0.0), shear or None, place=block.place)
        while replace(self.model.materials.setdefault(material, own), place=block.place) != own:  # of another part
            material += " more"
        centroid, bears = (0.0, 0.0), None
        for follower in self.reader.followers(block):
            values = numbers(follower.data[0][1], follower.data[0][0]) if follower.data else []
            if follower.keyword == "TRANSVERSE SHEAR STIFFNESS" and shear and len(values) >= 2:
                bears = values[1] / shear, values[0] / shear  # K23 along direction 2, K13 along 1
            elif follower.keyword == "CENTROID" and len(values) >= 2:
                centroid = tuple(values[:2])
            elif follower.keyword == "SHEAR CENTER" and tuple((values + [0.0] * 2)[:2]) != centroid:
                self.reader.lose_block(follower, "the shear centre is taken to be the centroid")
                continue
            self.reader.use(follower.keyword)
        if bears:
            section.shear_y, section.shear_z = bears
        key = self._new(block, material, section=section)
        direction = self._direction(block, 1, motion)
        for element in self._members(block, scope, *BEAMS):
            self._orient(element, key, direction, centroid)

    def _direction(self, block: Block, row: int, motion) -> tuple:
        if len(block.data) > row and any(block.data[row][1]):
            values = (numbers(block.data[row][1], block.data[row][0]) + [0.0] * 3)[:3]
            return motion.turn(values)
        return UNTURNED

    def _orient(self, element, key, direction, centroid) -> None:
        """`direction`: n1, unless the element has a node for it; `centroid` along directions 1 and 2."""
        ends = [self.model.at(node, element.place) for node in element.nodes]
        who = f"{element.place}: element {element.number}"
        if not self._take(element, key, (direction, centroid)):
            return
        element.z_axis = element.z_axis or tuple(direction)
        frame = frame_about(axis_between(ends, who), element.z_axis, who)
        if any(centroid):
            # y of the program is against direction 2.
            arm = applied(frame, (0.0, -centroid[1], centroid[0]))
            element.arms = (arm, arm)

    def added_mass(self, block: Block, scope, _motion) -> bool | None:
        """*NONSTRUCTURAL MASS per area or length, or all of it."""
        units = block.name("UNITS", "TOTAL MASS")
        raws = [raw.element for raw in self.reader.elements_of(block.name("ELSET"), scope, block.place) if raw.element]
        value = number(block.data[0][1][0], block.data[0][0]) if block.data else 0.0
        kinds = {"MASS PER AREA": (SHELL,), "MASS PER LENGTH": (*BEAMS, BAR)}.get(units)
        if units == "TOTAL MASS" and raws and len({element.kind == SHELL for element in raws}) == 1 and not any(
                element.kind in SOLIDS for element in raws):
            sizes = [size_of([self.model.at(node, block.place) for node in element.nodes]) for element in raws]
            value, kinds = value / sum(sizes), (SHELL, *BEAMS, BAR)
        if kinds is None or any(element.kind not in kinds for element in raws):
            return self.reader.lose_block(block, f"non-structural mass of {units.lower()} on these elements is not "
                                                 "known")
        for element in raws:
            element.added += value
