"""Reads Nastran bulk data (.bdf, .nas, .dat) into the neutral model."""

import re
from pathlib import Path

from .cards import names_of
from .geometry import (along_global_axes, applied, axis_between, difference, frame_about, length, normal_of,
                       permutation, scaled, sum_of, turned_z)
from .model import BAR, AxialSpring, Element, InputFault, Model, PointMass, Property, Reading, Spring
from .nastran_cards import GLOBAL, Card, Systems
from .nastran_joints import JointReader
from .nastran_lines import deck_of
from .nastran_properties import PropertyReader
from .second_order import by_corners

SOLIDS = {"CHEXA": ("hex8", 8, 20), "CPENTA": ("wedge6", 6, 15), "CTETRA": ("tet4", 4, 10)}
PLATES = {"CQUAD4": 4, "CQUADR": 4, "CTRIA3": 3, "CTRIAR": 3}
BEAMS = ("CBAR", "CBEAM")
# Reason to pass over cards -> their names.
NOTED = {
    "titles, output and control": names_of("""
    PLOTEL SET1 SET3 PARAM ENDDATA SUPORT SUPORT1 EIGR EIGRL EIGB EIGC EIGP TSTEP TSTEPNL NLPARM NLPCI ASET ASET1 OMIT
    OMIT1 MONPNT1 DTI TABDMP1 FREQ FREQ1 FREQ2 FREQ3 FREQ4 FREQ5 RANDPS RANDT1 TABRND1 TABLED1 TABLED2 TABLED3 TABLED4
    TABLEM1 DESVAR DCONSTR DRESP1 DVPREL1 DEFORM
    """),
    "loads and steps are not part of the model": names_of("""
    FORCE FORCE1 FORCE2 MOMENT MOMENT1 MOMENT2 PLOAD PLOAD1 PLOAD2 PLOAD4 GRAV LOAD RFORCE ACCEL ACCEL1 TEMP TEMPD
    TEMPP1 TEMPRB DLOAD TLOAD1 TLOAD2 RLOAD1 RLOAD2 DAREA DELAY DPHASE LSEQ SPCD SLOAD TIC NOLIN1 SPCR
    """)}


class Reader(Reading):
    """The whole deck. `model` is the result."""

    def __init__(self, path: Path):
        super().__init__(Model(path.stem))
        self.name = path.name
        control, cards = deck_of(path)
        self.cards = cards
        self.systems = Systems(self.position)
        self.grids: dict = {}  # number -> (system, coordinates, system of displacements, place)
        self.frames: dict = {}  # grid -> axes of its displacements where they are not the global ones
        self.defaults: dict = {card.name: card for card in cards if card.name in ("GRDSET", "BAROR", "BEAMOR")}
        self.parameters = {card.text(0).upper(): card for card in cards if card.name == "PARAM"}
        self.mass_factor = self.parameters["WTMASS"].real(1) if "WTMASS" in self.parameters else 1.0
        self.properties = PropertyReader(self)
        self.joints = JointReader(self, control)
        for card in cards:
            if card.name.startswith("CORD"):
                if card.name not in ("CORD2R", "CORD2C", "CORD2S", "CORD1R", "CORD1C", "CORD1S"):
                    raise InputFault(f"{card.place}: {card.name} is not known")
                self.systems.add(card)
            elif card.name == "GRID":
                self._grid(card)
        for number in self.grids:
            self.model.nodes[number] = self.position(number, "")
        for number, (_, x, system, place) in self.grids.items():
            if system:
                axes = self.systems.axes_at(system, self.model.nodes[number], place)
                if axes != GLOBAL:
                    self.frames[number] = axes
        self.handlers = {"CROD": self._rod, "CTUBE": self._rod, "CONROD": self._rod, "CELAS1": self._scalar,
                         "CELAS2": self._scalar, "CDAMP1": self._scalar, "CDAMP2": self._scalar, "CBUSH": self._bush,
                         "CONM2": self._mass, **self.joints.handlers}
        for card in cards:  # properties first, since offsets and axes hang on them
            if card.name in self.properties.handlers:
                self.properties.handlers[card.name](card)
                self.use(card.name)
        for card in cards:
            self._handle(card)
        self.joints.finish()
        self._tell_rotary_inertia()

    def _tell_rotary_inertia(self) -> None:
        """Of bars, which Nastran's lumped masses have not."""
        coupled = self.parameters.get("COUPMASS")
        materials = {self.model.properties[element.property].material for element in self.model.elements
                     if element.kind == "beam" and element.property in self.model.properties}
        if self.model.cards.read["CBAR"] and not (coupled and coupled.real(1) > 0) and any(
                self.model.materials[one].density for one in materials if one in self.model.materials):
            self.model.said.append("beams have the rotary inertia of their sections here, also about their axis; a CBAR with "
                                   "lumped masses has none: modes of twisting, and those of thick beams, are other ones")

    def _handle(self, card: Card) -> None:
        name = card.name
        if name in SOLIDS:
            self._solid(card)
        elif name in PLATES:
            self._plate(card)
        elif name in BEAMS:
            self._beam(card)
        elif name in self.handlers:
            if self.handlers[name](card) is not False:
                self.use(name)
        elif name in ("GRID", "GRDSET", "BAROR", "BEAMOR") or name.startswith("CORD"):
            self.use(name)
        elif name not in self.properties.handlers:
            self.pass_over(name, card.place, NOTED)

    # Grid points.

    def _grid(self, card: Card) -> None:
        number, default = card.int(0), self.defaults.get("GRDSET", Card("GRDSET", [], card.place))
        self.grids[number] = (card.int(1, default.int(1, 0)), card.vector(2), card.int(5, default.int(5, 0)),
                              card.place)
        fixed = card.text(6) or default.text(6)
        if fixed.strip("0"):
            self.joints.permanent.append((number, fixed, card.place))

    def position(self, number: int, place: str) -> tuple:
        """Global coordinates of a grid point. Throws InputFault."""
        if number not in self.grids:
            raise InputFault(f"{place}: grid point {number} is not in the deck")
        system, x, _, own = self.grids[number]
        return self.systems.point(system, x, own)

    def frame(self, number: int) -> tuple:
        """Axes of the displacements of a grid point."""
        return self.frames.get(number, GLOBAL)

    # Elements.

    def _add(self, card: Card, kind: str, nodes, key, counted: bool = True, **more) -> None:
        for node in nodes:
            self.model.at(node, card.place)
        self.model.elements.append(Element(kind, card.int(0), tuple(nodes), key, place=card.place, **more))
        if counted:
            self.use(card.name)

    def _solid(self, card: Card) -> None:
        kind, count, more = SOLIDS[card.name]
        nodes = [card.int(2 + k) for k in range(count)]
        middle = [card.int(2 + k) for k in range(count, more) if card.text(2 + k)]
        self._add(card, kind, nodes, card.int(1), counted=not middle)
        if middle:
            by_corners(self.model, f"{card.name} of second order", kind, [*nodes, *middle], count, card.place)

    def _plate(self, card: Card) -> None:
        count = PLATES[card.name]
        nodes = [card.int(2 + k) for k in range(count)]
        offset = card.real(3 + count)
        key = self._with_thickness(card, card.int(1, card.int(0)), count)
        arms = None
        if offset:
            arms = (scaled(normal_of([self.model.at(node, card.place) for node in nodes], card.place), offset),) * count
        self._add(card, "shell", nodes, key, arms=arms)

    def _with_thickness(self, card: Card, key: int, count: int):
        """The property, or one of its own where a plate has other thicknesses: T1 to T4, or by TFLAG parts of that of its
        property."""
        flag = card.text(9)
        if flag not in ("", "0", "1"):
            raise InputFault(f"{card.place}: {card.name} {card.text(0)} has TFLAG {flag}; it is 0 or 1")
        thicknesses = [card.real(10 + k) for k in range(count) if card.text(10 + k)]
        own = self.model.properties.get(key)
        if not thicknesses or own is None:
            return key
        if len(thicknesses) < count or max(thicknesses) - min(thicknesses) > 1e-9 * max(thicknesses):
            self.lose(f"T1 TO T{count} OF {card.name}",
                      "a thickness that varies within an element; allowed, the first holds", card.place)
        thickness = thicknesses[0] * (own.thickness if flag == "1" else 1.0)
        if thickness == own.thickness:
            return key
        fresh = f"{key} {thickness!r}"
        self.model.properties.setdefault(fresh, Property(f"{own.name}_t", own.material, thickness=thickness,
                                                         added=own.added, place=card.place))
        return fresh

    def _beam(self, card: Card) -> None:
        default = self.defaults.get("BAROR" if card.name == "CBAR" else "BEAMOR", Card("", [], card.place))
        key = card.int(1, default.int(1, card.int(0)))
        nodes = (card.int(2), card.int(3))
        ends = [self.model.at(node, card.place) for node in nodes]
        source = card if any(card.text(k) for k in (4, 5, 6)) else default
        kind = (card.text(7) or default.text(7) or "GGG").upper()
        if kind[:3] != "GGG" and not re.fullmatch(r"[\d.]+|1", kind):
            self.lose(f"OFFT {kind} OF {card.name}", "vectors are in the axes of displacements, GGG", card.place)
        arms = [applied(self.frame(node), card.vector(at)) for node, at in zip(nodes, (10, 13))]
        start = [sum_of(x, arm) for x, arm in zip(ends, arms)]
        if source.text(4) and "." not in source.text(4) and not source.text(5) and not source.text(6):
            towards = difference(self.model.at(source.int(4), card.place), start[0])
        else:
            towards = applied(self.frame(nodes[0]), source.vector(4))
        who = f"{card.place}: element {card.int(0)}"
        frame = frame_about(axis_between(start, who), towards, who)
        angle = self.properties.angles.get(key, 0.0)
        if angle:
            towards = turned_z(frame, angle)
        elif source.text(4) and not source.text(5) and not source.text(6):
            towards = frame[2]
        hinged = [False, False]
        for end, text in enumerate((card.text(8), card.text(9))):
            if text.strip("0"):
                digits = "".join(sorted(text.strip()))
                hinged[end] = "5" in digits or "6" in digits or "4" in digits
                if digits != "456":
                    self.lose(f"PINS {digits} OF {card.name}", "a hinge lets all three rotations go; allowed, it does "
                                                               "here, where it has one of them", card.place)
        long = [arm if length(arm) > 0 else None for arm in arms]
        self._add(card, "beam", nodes, key, z_axis=tuple(towards), arms=tuple(long) if any(long) else None,
                  hinged=tuple(hinged))

    def _rod(self, card: Card) -> bool:
        if card.name == "CONROD":
            key = f"CONROD {card.int(3)} {card.real(4)!r} {card.real(7)!r}"
            if card.real(5):
                self.lose("J OF CONROD", "bars do not twist", card.place)
            self.model.properties.setdefault(key, Property("conrod", card.int(3), area=card.real(4),
                                                           added=card.real(7) * self.mass_factor, place=card.place))
            self._add(card, BAR, (card.int(1), card.int(2)), key)
        else:
            self._add(card, BAR, (card.int(2), card.int(3)), card.int(1, card.int(0)))
        return False

    # Springs and masses.

    def _scalar(self, card: Card) -> bool | None:
        family = "PELAS" if card.name.startswith("CELAS") else "PDAMP"
        if card.name.endswith("1"):
            key = family, card.int(1, card.int(0))
            if key not in self.properties.springs:
                raise InputFault(f"{card.place}: {family} {key[1]} is not in the deck")
            value = self.properties.springs[key]
        else:
            value = card.real(1)
        ends = [(card.int(at), card.int(at + 1, 0)) for at in (2, 4) if card.text(at)]
        if not ends or any(not 1 <= component <= 6 for _, component in ends):
            return self.lose(card.name, "springs act on components of grid points", card.place)
        found = []
        for node, component in ends:
            self.model.at(node, card.place)
            places = permutation(self.frame(node))
            found.append(None if places is None else places[(component - 1) % 3] + (component - 1) // 3 * 3)
        if None in found or len(set(found)) > 1:
            return self.lose(card.name, "springs act along the global axes, on the same component of both nodes",
                                  card.place)
        both = (value, 0.0) if family == "PELAS" else (0.0, value)
        self.model.add_spring(tuple(node for node, _ in ends), found[0], *both, card.name.lower(), card.place)
        return None

    def _bush(self, card: Card) -> bool | None:
        key = "PBUSH", card.int(1, card.int(0))
        if key not in self.properties.springs:
            raise InputFault(f"{card.place}: PBUSH {key[1]} is not in the deck")
        stiffness, dashpot = self.properties.springs[key]
        nodes = tuple(card.int(at) for at in (2, 3) if card.text(at))
        if not nodes:
            raise InputFault(f"{card.place}: CBUSH {card.int(0)} has no grid point")
        places = [self.model.at(node, card.place) for node in nodes]
        way = difference(places[-1], places[0])
        apart = length(way) > 0
        who = f"{card.place}: element {card.int(0)}"
        name = f"pbush_{key[1]}"
        if card.text(7):
            axes = self.systems.axes_at(card.int(7), places[0], card.place)
        elif not apart:
            axes = GLOBAL
        elif not any((*stiffness[1:], *dashpot[1:])):
            self.model.axial_springs.append(AxialSpring(nodes, stiffness[0], dashpot[0], name, "CBUSH", card.place))
            return None
        else:
            if card.text(4) and not card.text(5) and "." not in card.text(4):
                towards = difference(self.model.at(card.int(4), card.place), places[0])
            else:
                towards = applied(self.frame(nodes[0]), card.vector(4))
            x, y, z = frame_about(axis_between(places, who), towards, who)
            axes = (x, z, scaled(y, -1.0))  # y of the bushing lies in the plane of the vector
        six = [along_global_axes(values, axes) for values in (stiffness, dashpot)]
        if None in six:
            return self.lose("CBUSH", "bushings act along and about the global axes", card.place)
        across = [k for k in range(3) if apart and abs(way[k]) < (1 - 1e-9) * length(way) and (six[0][k] or six[1][k])]
        if across:
            return self.lose("CBUSH", "a force across the length of a bushing makes moments; its nodes have to "
                                           "coincide",
                                  card.place)
        self.model.springs.append(Spring(nodes, *six, name, card.place))
        return None

    def _mass(self, card: Card) -> bool | None:
        node, system = card.int(1), card.int(2, 0)
        place = self.model.at(node, card.place)
        axes = GLOBAL if system == -1 else self.systems.axes_at(system, place, card.place) if system else GLOBAL
        arm = difference(card.vector(4), place) if system == -1 else applied(axes, card.vector(4))
        inertia = [card.real(k) for k in (8, 10, 13)]
        about = along_global_axes((*inertia, 0.0, 0.0, 0.0), axes)
        if any(card.real(k) for k in (9, 11, 12)) or about is None:
            self.lose("I OF CONM2", "rotary inertia is about the global axes, without products", card.place)
            about = (0.0,) * 3
        self.model.masses.append(PointMass(node, card.real(3) * self.mass_factor, scaled(about[:3], self.mass_factor),
                                           arm if length(arm) > 0 else None, "conm2", card.place))
        return None


def read(path: Path) -> Model:
    """The model of a deck. Throws InputFault."""
    return Reader(path).model
