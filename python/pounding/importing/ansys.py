"""Reads ANSYS archives (.cdb) into the neutral model."""

import math
from pathlib import Path

from .ansys_cards import Command, Commands
from .ansys_properties import Properties, SHELLS, solid_kind
from .cards import names_of, number, whole, whole_range
from .geometry import applied, axis_between, cross, difference, dot, frame_about, normal_of, scaled, shape_of, turned_z
from .joints import Shared, hold_turned
from .model import ALL, BAR, AxialSpring, Element, InputFault, Model, PointMass, Property, Reading, Section
from .second_order import by_corners

# Reason to pass over cards -> their names.
NOTED = {
    "titles, output and control": names_of("""
    NUMOFF DOF FINISH EXTOPT MPTEMP TREF TOFFST ANTYPE MODOPT MXPAND LUMPM KUSE TIME TUNIF TOTAL ERESX SSTIF SHPP SOLVE
    NLGEOM OUTRES OUTPR AUTOTS NSUBST KBC ERNORM EQSLV PRED CNVTOL NEQIT LNSRCH CSYS LOCAL CSCIR CLOCAL DSYS ALLSEL
    NSEL ESEL TYPE MAT REAL SECNUM ESYS RATE CMSEL EXPASS NUMEXP BCSOPTION RESCONTROL DMPRAT MDAMP DMPSTR PSTRES TINTP
    TRNOPT LSCLEAR CMEDIT WPSTYL LSWRITE UNITS CRPLIM DMPOPT NCNV STEF TIMINT MODCONTROL QRDOPT EMUNIT THOPT CM CMGRP CMDELE
    HROPT HARFRQ HROUT NROPT OPNCONTROL ARCLEN CUTCONTROL SOLCONTROL PIVCHECK SNOPTION SPOPT SVTYP SSOPT BUCOPT STABILIZE
    CEWRITE CNTR ETCON TSHAPE NLDIAG XMLO MONITOR SHOWDISP EXUNIT KEYW NUMSTR ICLWID NSLE ESLN CMLIST PRECISION
    """),
    "loads and steps are not part of the model": names_of("""
    CGOMEGA F SF SFE SFL SFA SFGRAD BF BFE BFUNIF ACEL OMEGA DOMEGA CGLOC CGOMGA DCGOMG CMOMEGA CMDOMEGA CMACEL FK IC INISTATE
    SFCUM FCUM BFCUM BFECUM LDREAD
    """)}
NOTED = {why: names | {name[:4] for name in names} for why, names in NOTED.items()}  # four letters are enough for ANSYS
# They take more from other files: macros, archives, sets of data.
ELSEWHERE = ("/INP", "/INPUT", "*USE", "CDREAD", "LSREAD", "PARRES", "/ASSIGN", "*ULIB", "RESUME", "/PSEARCH", "*VREAD", "*TREAD",
             "NREAD", "EREAD", "MPREAD", "CBDOF", "IGESIN", "PARAIN", "SATIN", "UGIN", "CATIAIN")
# Nodes that an element of a type cannot do without.
NEEDED = {185: 8, 45: 8, 181: 3, 63: 3, 43: 3, 188: 2, 4: 2, 180: 2, 8: 2, 184: 2}
# Those of second order: name, type that they become by their corners, nodes at corners and behind them.
SECOND_ORDER = {186: ("SOLID186", 185, 8), 187: ("SOLID187", 185, 4), 95: ("SOLID95", 45, 8), 92: ("SOLID92", 45, 4),
                281: ("SHELL281", 181, 4), 93: ("SHELL93", 181, 4), 189: ("BEAM189", 188, 2)}

LABELS = {label: 1 << k for k, label in enumerate(("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"))} | {"ALL": ALL}
OTHER_LABELS = {"TEMP", "VOLT", "MAG", "PRES", "AX", "AY", "AZ", "CURR", "EMF", "CONC", "ENKE", "ENDS"}


class Reader(Reading):
    """The whole archive. `model` is the result."""

    def __init__(self, path: Path):
        super().__init__(Model(path.stem))
        self.commands = Commands(path).found
        self.properties = Properties(self.model)
        self.turned: dict = {}  # node -> axes of its displacements where they are not the global ones
        self.elements_: dict = {}  # number -> place in the model's elements
        self.joints = JointReader(self)
        for command in self.commands:
            if command.name in self.properties.handlers:
                if self.properties.handlers[command.name](command) is not False:
                    self.use(command.name)
            elif command.name == "NBLOCK":
                self._nodes(command)
            elif command.name == "N" and command.text(1).upper() == "LOC":
                self._node(command)
        self.properties.finish()
        for command in self.commands:
            if command.name == "EBLOCK":
                self._elements(command)
        for command in self.commands:
            self._handle(command)
        self.joints.finish()

    def _handle(self, command: Command) -> None:
        name = command.name
        if name in self.joints.handlers:
            if self.joints.handlers[name](command) is not False:
                self.use(name)
        elif name in ("NBLOCK", "EBLOCK"):
            self.use(name)
        elif name in self.properties.handlers or (name == "N" and command.text(1).upper() == "LOC"):
            return
        elif name in ELSEWHERE or name[:4] in ELSEWHERE:
            self.lose(name, "it reads another file, which is not followed; write one archive with CDWRITE", command.place)
        elif name[0] in "/*_" or "=" in name:
            self.note(name.partition("=")[0], "titles, output and control")
        elif name == "EN" and command.words[-1:] == ["-1"]:
            self.note(name, "titles, output and control")  # the end of a block
        elif name == "IRLF" and not command.real(0):
            self.note(name, "titles, output and control")
        elif name in ("ALPHAD", "BETAD"):
            setattr(self.model, "alpha" if name == "ALPHAD" else "beta", command.real(0))
            self.use(name)
        else:
            self.pass_over(name, command.place, {why: {name} for why, names in NOTED.items() if {name, name[:4]} & names})

    # Nodes.

    def _nodes(self, command: Command) -> None:
        first = 3 if command.text(1).upper() == "SOLID" else 1
        for place, words in command.rows:
            own = whole(words[0], place)
            values = [number(text, place) if text else 0.0 for text in words[first:]] + [0.0] * 6
            self._put(own, values, place)

    def _node(self, command: Command) -> None:
        """N,R5.3,LOC, number, x, y, z with ANG in a line of its own."""
        own = command.int(2)
        if own > 0:
            self._put(own, [command.real(3 + k) for k in range(3)] + [0.0] * 3, command.place)

    def _put(self, own: int, values: list, place: str) -> None:
        if own < 1:
            raise InputFault(f"{place}: node {own} is no number")
        if not self.new("node", own, values[:6], place):
            return
        self.model.nodes[own] = tuple(values[:3])
        if any(values[3:6]):  # about z, then x, then y
            a, b, c = (math.radians(value) for value in values[3:6])
            x, y, z = (math.cos(a), math.sin(a), 0.0), (-math.sin(a), math.cos(a), 0.0), (0.0, 0.0, 1.0)
            y, z = _turned(y, z, b)
            z, x = _turned(z, x, c)
            self.turned[own] = (x, y, z)

    # Elements.

    def _elements(self, command: Command) -> None:
        if command.text(1).upper() != "SOLID":
            self.lose("EBLOCK OF OTHERS", "elements are read in blocks of the kind 19,SOLID; others are of contact and loads",
                      command.place, max(1, len(command.rows)))
            return
        rows = iter(command.rows)
        for place, words in rows:
            values = [whole(text, place) for text in words]
            if len(values) < 12:
                raise InputFault(f"{place}: an element has {len(values)} numbers in place of 12 and more")
            count, nodes = values[8], values[11:]
            while len(nodes) < count:
                place_, more = next(rows, (place, []))
                if not more:
                    raise InputFault(f"{place_}: an element has {len(nodes)} nodes of {count}")
                nodes += [whole(text, place_) for text in more]
            self._element(values, nodes[:count], place)

    def _element(self, values: list, nodes: list, place: str) -> bool | None:
        material, type_number, real, section, own = values[0], values[1], values[2], values[3], values[10]
        if type_number not in self.properties.types:
            raise InputFault(f"{place}: element type {type_number} is not in the file")
        if not self.new("element", own, (values[:4], nodes), place):
            return None
        type_, keys = self.properties.types[type_number], self.properties.keys.get(type_number, {})
        reals = self.properties.reals.get(real, [])
        name = f"type_{type_number}_mat_{material}"
        key = (type_number, material, real, section)
        second = SECOND_ORDER.get(type_)
        if second:
            if len(nodes) < second[2]:
                raise InputFault(f"{place}: element {own} of type {type_} has {len(nodes)} nodes")
            section = 0 if type_ == 93 else section  # it has real constants alone
            type_, keys, nodes = self._by_corners(second, keys, nodes, place)
        common = key, name, material, real, section, reals, own, place
        for at, node in enumerate(nodes):
            if node or at < min(NEEDED.get(type_, 1), len(nodes)):
                self.model.at(node, place)
        if len(nodes) < NEEDED.get(type_, 1):
            raise InputFault(f"{place}: element {own} of type {type_} has {len(nodes)} nodes")
        if type_ in (185, 45):
            self._solid(solid_kind(type_, keys), type_, nodes, common)
        elif type_ in SHELLS:
            self._shell(type_, keys, nodes, common)
        elif type_ in (188, 4):
            self._beam(type_, nodes, common)
        elif type_ in (180, 8):
            self._link(type_, nodes, common)
        elif type_ == 14:
            self._spring(keys, nodes, common)
        elif type_ == 21:
            self._mass(keys, nodes, common)
        elif type_ == 184 and keys.get(1, 0) == 1:
            self.model.rigid.append((f"rigid_{own}", nodes[:2], place))
        elif type_ == 200:
            return self.note("ELEMENT MESH200", "it has no stiffness")
        else:
            return self.lose(f"ELEMENT {type_}", "this type is not known", place)
        if not second:
            self.use(f"ELEMENT {type_}")
        return None

    def _by_corners(self, second: tuple, keys: dict, nodes: list, place: str) -> tuple:
        """Type, options and nodes of the element of first order that one of second order becomes."""
        card, type_, count = second
        kind = {181: "shell", 188: "beam"}.get(type_, "tet4" if count == 4 else "hex8")
        ends, towards = (nodes[:3], nodes[3:4]) if type_ == 188 else (nodes, [])  # the fourth shows a beam's direction
        found = by_corners(self.model, f"ELEMENT {card}", kind, ends, count, place)
        if type_ == 185:  # reduced integration does not lock, nor do incompatible modes
            keys = {2: 1, 3: keys.get(3, 0)}
        if kind == "tet4":
            found = (*found[:3], found[2], *found[3:] * 4)
        return type_, keys if type_ in (181, 185) else {}, [*found, *towards]

    def _add(self, kind: str, nodes, common, **more) -> None:
        key, own, place = common[0], common[6], common[7]
        self.elements_[own] = len(self.model.elements)
        self.model.elements.append(Element(kind, own, tuple(nodes), key, place=place, **more))

    def _property(self, common, material: int, **more) -> Property:
        key, name, place = common[0], common[1], common[7]
        given = self.properties.sections.get(common[4], ["", "", ""])[2]
        return self.model.properties.setdefault(key, Property(given or name, material, place=place, **more))

    def _solid(self, kind: str | None, type_: int, nodes: list, common) -> bool | None:
        shape, nodes = shape_of((nodes + nodes[-1:] * 8)[:8] if len(nodes) != 4 else [*nodes[:3], nodes[2],
                                                                                      *[nodes[3]] * 4])
        if kind is None or shape is None:
            return self.lose(f"ELEMENT {type_} {'LAYERED' if kind is None else 'PYRAMID'}", "this shape is not "
                                                                                                 "known", common[7])
        self._property(common, common[2])
        self._add(kind if shape == "brick" else shape, nodes, common)

    def _shell(self, type_: int, keys: dict, nodes: list, common) -> bool | None:
        _, _, material, _, section, reals, own, place = common
        if SHELLS[type_] is None or keys.get(1):
            return self.lose(f"ELEMENT {type_} KEYOPT 1", "membranes and plates alone are not known", place)
        added, offset = 0.0, 0.0
        if section in self.properties.sections and type_ == 181:
            thickness, material, offset = self.properties.shell_section(section, material, place)
        else:
            thicknesses = {value for value in reals[:4] if value}
            if len(thicknesses) != 1:
                fault = "a thickness that varies" if thicknesses else "no thickness"
                raise InputFault(f"{place}: element {own} has {fault}")
            thickness = thicknesses.pop()
            rest = reals + [0.0] * 20
            added = rest[5] if type_ == 181 else rest[17] if type_ == 63 else rest[7]
            if type_ == 63 and rest[4]:
                self.lose("EFS OF SHELL63", "foundations of shells are not known", place)
        nodes = nodes[:3] if len(nodes) > 3 and nodes[2] == nodes[3] else nodes
        self._property(common, material, thickness=thickness, added=added)
        arms = None
        if offset:
            way = normal_of([self.model.nodes[node] for node in nodes], f"{place}: element {own}")
            arms = (scaled(way, offset * thickness),) * len(nodes)
        self._add("shell", nodes, common, arms=arms)

    def _beam(self, type_: int, nodes: list, common) -> None:
        _, _, material, _, section, reals, own, place = common
        who = f"{place}: element {own}"
        ends = [self.model.nodes[node] for node in nodes[:2]]
        axis = axis_between(ends, who)
        if len(nodes) > 2 and nodes[2]:
            frame = frame_about(axis, difference(self.model.nodes[nodes[2]], ends[0]), who)
        else:  # y parallel to the x-y plane, of vertical ones along y
            steep = abs(dot(axis, (0.0, 0.0, 1.0))) > 1 - 1e-8
            y = (0.0, 1.0, 0.0) if steep else cross((0.0, 0.0, 1.0), axis)
            frame = frame_about(axis, cross(axis, y), who)
        added, arms, angle = 0.0, None, 0.0
        if type_ == 188:
            found = self.properties.beam_section(section, place)
            if found is None:
                found = None, 0.0, (0.0, 0.0)
            one, angle, centroid = found
            if any(centroid):
                arms = (applied(frame, (0.0, *centroid)),) * 2
        else:
            area, izz, iyy, _, _, theta, strain, ixx, shear_z, shear_y, _, added = (reals + [0.0] * 12)[:12]
            if strain:
                self.lose("ISTRN OF BEAM4", "initial strains are not known", place)
            angle = math.radians(theta)
            one = Section(area, iyy, izz, ixx or iyy + izz, area / shear_z if shear_z else 0.0,
                          area / shear_y if shear_y else 0.0)
        self._property(common, material, section=one, added=added)
        self._add("beam", nodes[:2], common, z_axis=turned_z(frame, angle) if angle else frame[2], arms=arms)

    def _link(self, type_: int, nodes: list, common) -> None:
        material, section, reals, place = common[2], common[4], common[5], common[7]
        if section in self.properties.sections and type_ == 180 and self.properties.sections[section][0] == "LINK":
            area, added = (self.properties.sections[section][3] + [0.0] * 2)[:2]
        else:
            area, added, one_way = (reals + [0.0] * 3)[:3]
            if one_way and type_ == 180:
                self.lose("TENSKEY OF LINK180", "bars of one direction are told in the scene: tension_only", place)
            if type_ == 8:
                if added:
                    self.lose("ISTRN OF LINK8", "initial strains are not known", place)
                added = 0.0
        self._property(common, material, area=area, added=added)
        self._add(BAR, nodes[:2], common)

    def _spring(self, keys: dict, nodes: list, common) -> None:
        name, reals, place = common[1], common[5], common[7]
        stiffness, dashpot, quadratic = (reals + [0.0] * 3)[:3]
        along = keys.get(2, 0)
        ends = tuple(node for node in nodes[:2] if node)
        if quadratic or along > 6 or (along == 0 and keys.get(3, 0) == 1) or (along and set(ends) & set(self.turned)):
            self.lose("ELEMENT 14 KEYOPT OR CV2",
                      "springs act along and about the global axes, or between two nodes, linearly", place)
        elif along == 0 and len(ends) < 2:
            raise InputFault(f"{place}: a spring along its line has two nodes")
        elif along == 0:
            self.model.axial_springs.append(AxialSpring(ends, stiffness, dashpot, name, place))
        else:
            self.model.add_spring(ends, along - 1, stiffness, dashpot, name, place)

    def _mass(self, keys: dict, nodes: list, common) -> bool | None:
        name, reals, place = common[1], (common[5] + [0.0] * 6)[:6], common[7]
        if keys.get(3, 0) == 2:
            mass, inertia = reals[0], (0.0,) * 3
        elif keys.get(3, 0) == 0:
            mass, inertia = reals[0], tuple(reals[3:6])
            if len(set(reals[:3])) > 1 or (any(inertia) and keys.get(2)):
                self.lose("ELEMENT 21 OF DIRECTIONS", "a mass is the same along all axes", place)
        else:
            return self.lose(f"ELEMENT 21 KEYOPT 3 = {keys.get(3)}", "masses are of three dimensions", place)
        self.model.masses.append(PointMass(nodes[0], mass, inertia, None, name, place))


class JointReader(Reading):
    """Supports, couplings and components; `reader` is the whole archive's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.components: dict = {}  # name -> nodes
        self.coupled = Shared(self.model, "coupled", "CP", "couplings join all displacements of nodes that coincide")
        self.selects = any(command.name in ("NSEL", "CMSEL", "NSLE") for command in reader.commands)
        self.held: dict = {}  # node -> [components, place]
        self.handlers = {"D": self._support, "CMBLOCK": self._component, "CP": self._couple}

    def _nodes(self, text: str, place: str) -> list:
        name = text.upper()
        if name == "ALL":
            return list(self.model.nodes)
        if name in self.components:
            return self.components[name]
        node = whole(text, place)
        self.model.at(node, place)
        return [node]

    def _support(self, command: Command) -> bool:
        """D, node, label, value, value2, last node, step, more labels."""
        labels = [text.upper() for text in (command.text(1), *command.words[6:]) if text]
        if set(labels) & OTHER_LABELS:
            return self.note(f"D {labels[0]}", "says nothing of displacements")
        if not labels or set(labels) - set(LABELS):
            return self.lose(f"D {' '.join(labels)}", "supports hold UX to ROTZ, or ALL", command.place)
        if command.text(0).upper() in ("ALL", "") and self.selects:
            return self.lose("D OF SELECTED NODES", "selections are not followed; name the nodes or a component",
                                  command.place)
        table = command.text(2)[:1] == "%" and command.text(2).upper() != "%_FIX%"
        if table or command.text(2).upper() not in ("", "%_FIX%") and command.real(2):
            self.model.said.append(f"{command.place}: a displacement of {command.text(2)} is held at zero")
        nodes = self._nodes(command.text(0), command.place)
        if command.text(4):
            span = whole_range(nodes[0], command.int(4), command.int(5, 1), command.place)
            nodes = [node for node in self.model.nodes if node in span]
        for node in nodes:
            for label in labels:
                self.held.setdefault(node, [0, command.place])[0] |= LABELS[label]
        return True

    def _component(self, command: Command) -> None:
        """Numbers, and last ones of ranges with a minus sign."""
        name, kind = command.text(0).upper(), command.text(1).upper()
        if not self.new("component", name, (kind, command.rows), command.place):
            return
        known = self.model.nodes if kind.startswith("NODE") else self.reader.elements_
        members: dict = {}  # in their order, each once
        before = None
        for value in command.rows:
            if value < 0:
                if before is None:
                    raise InputFault(f"{command.place}: a component begins with the end of a range")
                span = whole_range(before, -value, 1, command.place)
                members.update(dict.fromkeys(n for n in (span if len(span) < len(known) else sorted(known)) if n in known
                                             and n in span))
            elif value in known:
                members[value] = None
            before = abs(value)
        if kind.startswith("NODE"):
            self.components[name] = list(members)
            self.model.node_sets[name] = self.components[name]
        else:
            self.model.element_sets[name] = [self.reader.elements_[n] for n in members]

    def _couple(self, command: Command) -> bool:
        label = command.text(1).upper()
        if label in OTHER_LABELS:
            return self.note(f"CP {label}", "says nothing of displacements")
        if label not in LABELS:
            return self.lose(f"CP {label}", "couplings are of UX to ROTZ, or ALL", command.place)
        nodes = [node for text in command.words[2:] if text for node in self._nodes(text, command.place)]
        self.coupled.add(nodes, LABELS[label], command.place)
        return False

    def finish(self) -> None:
        for node, (components, place) in self.held.items():
            hold_turned(self.model, node, components, self.reader.turned.get(node), "D", place)
        self.coupled.finish()


def _turned(first, second, angle: float) -> tuple:
    """Two axes turned in their plane, from the first towards the second."""
    c, s = math.cos(angle), math.sin(angle)
    return tuple(c * a + s * b for a, b in zip(first, second)), tuple(c * b - s * a for a, b in zip(first, second))


def read(path: Path) -> Model:
    """The model of an archive. Throws InputFault."""
    return Reader(path).model
