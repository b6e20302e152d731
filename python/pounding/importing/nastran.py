"""Reads Nastran bulk data (.bdf, .nas, .dat) into the neutral model."""

import re
from pathlib import Path

from .cards import names_of
from .geometry import applied, axis_between, difference, frame_about, length, normal_of, scaled, sum_of, turned_z
from .model import BAR, Element, InputFault, Model, Property, Reading
from .nastran_cards import GLOBAL, Card, Systems
from .nastran_joints import JointReader
from .nastran_lines import deck_of
from .nastran_properties import PropertyReader
from .nastran_springs import SpringReader
from .second_order import by_corners

# Card -> kind of element, nodes at corners, all nodes; CIHEX2 goes round its faces, corners and mid-side nodes in turn.
SOLIDS = {"CHEXA": ("hex8", 8, 20), "CPENTA": ("wedge6", 6, 15), "CTETRA": ("tet4", 4, 10), "CIHEX1": ("hex8", 8, 8),
          "CIHEX2": ("hex8", 8, 20), "CHEXA1": ("hex8", 8, 8), "CHEXA2": ("hex8", 8, 8), "CWEDGE": ("wedge6", 6, 6)}
IN_TURN = (0, 2, 4, 6, 12, 14, 16, 18)
FIRST = ("CHEXA1", "CHEXA2", "CWEDGE", "CTETRA")  # of NASTRAN-95, with a material in place of a property
# Card -> nodes at corners, all nodes, places of the offset, the first thickness and TFLAG, kind of property.
PLATES = {**dict.fromkeys(("CQUAD4", "CQUADR"), (4, 4, 7, 10, 9, "PSHELL")),
          **dict.fromkeys(("CTRIA3", "CTRIAR"), (3, 3, 6, 10, 9, "PSHELL")), "CQUAD8": (4, 8, 15, 10, 16, "PSHELL"),
          "CTRIA6": (3, 6, 9, 10, 13, "PSHELL"), **{name: (3 if "TR" in name else 4,) * 2 + (99, 99, 99, name.replace("C", "P", 1))
                                                   for name in ("CQUAD1", "CQUAD2", "CTRIA1", "CTRIA2", "CQDMEM", "CQDMEM1", "CQDMEM2",
                                                                "CTRMEM", "CSHEAR")}}
SCALAR = ("CELAS3", "CELAS4", "CDAMP3", "CDAMP4", "CMASS3", "CMASS4")  # make their own scalar points
BEAMS = {"CBAR": "PBAR", "CBEAM": "PBEAM"}
MEMBRANES = {**dict.fromkeys(("PQDMEM", "PQDMEM1", "PQDMEM2", "PTRMEM"), "membranes are not known; allowed, they are shells, which bend as "
                                                                         "well"),
             "PSHEAR": "panels that carry shear alone are not known; allowed, they are shells, which carry all forces"}
# Reason to pass over cards -> their names.
NOTED = {
    "titles, output and control": names_of("""
    PLOTEL PLOTEL3 PLOTEL4 PLOTEL6 PLOTEL8 CBARAO SET1 SET3 PARAM MDLPRM ENDDATA SUPORT SUPORT1 EIGR EIGRL EIGB EIGC EIGP TSTEP
    TSTEPNL TSTEP1 NLPARM NLPCI NLSTEP NLCNTLG NLCNTL ASET ASET1 OMIT OMIT1 BSET BSET1 CSET CSET1 QSET QSET1 USET USET1 SPOINT EPOINT
    MONPNT1 MONPNT2 MONPNT3 MONDSP1 DTI TABDMP1 FREQ FREQ1 FREQ2 FREQ3 FREQ4 FREQ5 RANDPS RANDT1 TABRND1 TABRNDG TABLED1 TABLED2
    TABLED3 TABLED4 TABLEM1 TABLEM2 TABLEM3 TABLEM4 TABLES1 TABLEST DEFORM CNGRNT SEQGP ITER POINTAX GROUP
    """),
    "loads and steps are not part of the model": names_of("""
    FORCE FORCE1 FORCE2 MOMENT MOMENT1 MOMENT2 PLOAD PLOAD1 PLOAD2 PLOAD4 GRAV LOAD RFORCE ACCEL ACCEL1 TEMP TEMPD
    TEMPP1 TEMPP2 TEMPRB DLOAD TLOAD1 TLOAD2 RLOAD1 RLOAD2 DAREA DELAY DPHASE LSEQ SPCD SLOAD TIC NOLIN1 NOLIN2 NOLIN3 NOLIN4 SPCR
    LOADCYN DLOADS PLOAD3 LOADCYH LOADCYT TLOAD3
    """),
    "heat is not part of the model": names_of("""
    MAT4 MAT5 MATT4 MATT5 PHBDY CHBDY CHBDYE CHBDYG CHBDYP CONV CONVM PCONV PCONVM QVOL QVECT QBDY1 QBDY2 QBDY3 QHBDY RADBC RADBND RADCAV
    RADLST RADM RADMTX RADSET TEMPBC VIEW VIEW3D THPAD BDYOR
    """),
    "optimisation is not part of the model": names_of("""
    DESVAR DCONSTR DCONADD DRESP1 DRESP2 DRESP3 DVPREL1 DVPREL2 DVMREL1 DVMREL2 DVCREL1 DVCREL2 DVTREL1 DVGRID DVBSHAP DEQATN DLINK
    DOPTPRM DSCREEN DTABLE DVSET TOPVAR MAT1DSN POPT PLIMIT
    """),
    "forces of air are not part of the model": names_of("""
    AERO AEROS AEROZ AECOMP AECOMPL AEFACT AELINK AELIST AEPARM AEPRESS AEFORCE AESTAT AESURF AESURFS CAERO1 CAERO2 CAERO3 CAERO4
    CAERO5 CAERO7 PAERO1 PAERO2 PAERO3 PAERO4 PAERO5 PAERO7 SPLINE1 SPLINE2 SPLINE3 SPLINE4 SPLINE5 SPLINE6 SPLINE7 FLFACT
    FLUTTER FLUTPRM MKAERO1 MKAERO2 MKAEROZ GUST TRIM TRIM2 CSSCHD DIVERG UXVEC BODY7 SEGMESH AESURFZ ACOORD TRIMVAR TRIMLNK TRIMOBJ
    TRIMCON FLUTMOD AEROP WKK
    """)}
# Cards that are lost -> the reason.
WHY = {"TF": "equations between displacements, as transfer functions are, are not known",
       "RBE3": "means of displacements of several nodes are not known", "CPYRAM": "pyramids are not known", "CBEND": "bent beams are not known",
       "DMIG": "matrices are given in the scene (matrices)", "MATT1": "moduli depend on no temperature; allowed, those of MAT1 hold",
       "MATS1": "materials are elastic here; allowed, those of MAT1 hold; give laws in the scene"}


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
        self.springs = SpringReader(self)
        for card in cards:
            if card.name.startswith("CORD"):
                if card.name not in ("CORD2R", "CORD2C", "CORD2S", "CORD1R", "CORD1C", "CORD1S"):
                    raise InputFault(f"{card.place}: {card.name} is not known")
                self.systems.add(card)
            elif card.name == "GRID":
                self._grid(card)
        self.in_order = sorted(self.grids)
        for number in self.grids:
            self.model.nodes[number] = self.position(number, "")
        for number, (_, x, system, place) in self.grids.items():
            if system:
                axes = self.systems.axes_at(system, self.model.nodes[number], place)
                if axes != GLOBAL:
                    self.frames[number] = axes
        self.points = {number for card in cards if card.name in ("SPOINT", "EPOINT") for number in card.list_from(0, 10**6)}
        self.points |= {card.int(at) for card in cards if card.name in SCALAR for at in (2, 3) if card.text(at)}
        # Number of a property -> card that is lost.
        self.strange = {card.text(0): card.name for card in cards if card.name[0] == "P" and card.name not in self.properties.handlers}
        self.other_materials = {int(card.text(0)): card.name for card in cards if card.name[:3] == "MAT"
                                and card.text(0).isdecimal() and card.name not in ("MAT1", "MAT4", "MAT5")}
        self.handlers = {"CROD": self._rod, "CTUBE": self._rod, "CONROD": self._rod, **self.springs.handlers, **self.joints.handlers}
        for handlers in (self.properties.materials, self.properties.handlers):  # offsets and axes of elements hang on them
            for card in cards:
                if card.name in handlers:
                    lost = self.model.cards.lost[card.name]
                    handlers[card.name](card)
                    if self.model.cards.lost[card.name] == lost:
                        self.use(card.name)
        for card in cards:
            self._handle(card)
        self.springs.finish()
        self._leave_strange()
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
        elif name in WHY:
            self.lose(name, WHY[name], card.place)
        elif name not in self.properties.handlers and name not in self.properties.materials:
            self.pass_over(name, card.place, NOTED)

    # Grid points.

    def _grid(self, card: Card) -> None:
        number, default = card.int(0), self.defaults.get("GRDSET", Card("GRDSET", [], card.place))
        self.grids[number] = (card.int(1, default.int(1, 0)), card.vector(2), card.int(5, default.int(5, 0)),
                              card.place)
        if self.grids[number][2] == -1:
            self.lose("GRID OF A FLUID", "fluids are not known; allowed, its grid points are left to what hangs on them", card.place)
            self.grids[number] = (*self.grids[number][:2], 0, card.place)
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
        order = [*IN_TURN, *(k for k in range(20) if k not in IN_TURN)] if card.name == "CIHEX2" else range(more)
        nodes = [card.int(2 + k) for k in order[:count]]
        middle = [card.int(2 + k) for k in order[count:] if card.text(2 + k)]
        key = "PSOLID", card.int(1)
        if card.name in FIRST and key not in self.properties.solids:
            key = "MAT1", card.int(1)
            self.model.properties.setdefault(key, Property(f"MAT1_{key[1]}", key[1], place=card.place))
        self._add(card, kind, nodes, key, counted=not middle)
        if middle:
            by_corners(self.model, f"{card.name} of second order", kind, [*nodes, *middle], count, card.place)

    def _plate(self, card: Card) -> None:
        count, more, at_offset, at_thickness, at_flag, family = PLATES[card.name]
        nodes = [card.int(2 + k) for k in range(count)]
        middle = [card.int(2 + k) for k in range(count, more) if card.text(2 + k)]
        number = family, card.int(1, card.int(0))
        offset = card.real(at_offset) + self.properties.offsets.get(number, 0.0)
        key = self._with_thickness(card, number, count, at_thickness, at_flag)
        if family in MEMBRANES:
            self.lose(card.name, MEMBRANES[family], card.place)
        arms = None
        if offset:
            arms = (scaled(normal_of([self.model.at(node, card.place) for node in nodes], card.place), offset),) * count
        self._add(card, "shell", nodes, key, counted=more == count and family not in MEMBRANES, arms=arms)
        if more > count:
            by_corners(self.model, card.name, "shell", [*nodes, *middle], count, card.place)

    def _with_thickness(self, card: Card, key: tuple, count: int, at: int, at_flag: int):
        """The property, or one of its own where a plate has other thicknesses: T1 to T4, or by TFLAG parts of that of its
        property."""
        flag = card.text(at_flag)
        if flag not in ("", "0", "1"):
            raise InputFault(f"{card.place}: {card.name} {card.text(0)} has TFLAG {flag}; it is 0 or 1")
        thicknesses = [card.real(at + k) for k in range(count) if card.text(at + k)]
        own = self.model.properties.get(key)
        if not thicknesses or own is None:
            return key
        if len(thicknesses) < count or max(thicknesses) - min(thicknesses) > 1e-9 * max(thicknesses):
            self.lose(f"T1 TO T{count} OF {card.name}",
                      "a thickness that varies within an element; allowed, the mean holds", card.place)
        thickness = sum(thicknesses) / len(thicknesses) * (own.thickness if flag == "1" else 1.0)
        if thickness == own.thickness:
            return key
        fresh = (*key, thickness)
        self.model.properties.setdefault(fresh, Property(f"{own.name}_t", own.material, thickness=thickness,
                                                         added=own.added, place=card.place))
        return fresh

    def _beam(self, card: Card) -> None:
        default = self.defaults.get("BAROR" if card.name == "CBAR" else "BEAMOR", Card("", [], card.place))
        key = BEAMS[card.name], card.int(1, default.int(1, card.int(0)))
        nodes = (card.int(2), card.int(3))
        ends = [self.model.at(node, card.place) for node in nodes]
        source = card if any(card.text(k) for k in (4, 5, 6)) else default
        kind = (card.text(7) or default.text(7) or "GGG").upper()
        if not re.fullmatch(r"[GB]GG|[\d.]+", kind) and (any(card.text(k) for k in range(10, 16)) or not re.fullmatch(r"[GB][GO][GO]", kind)):
            self.lose(f"OFFT {kind} OF {card.name}", "offsets are in the axes of displacements; allowed, they are", card.place)
        arms = [applied(self.frame(node), card.vector(at)) for node, at in zip(nodes, (10, 13))]
        start = [sum_of(x, arm) for x, arm in zip(ends, arms)]
        if source.text(4) and "." not in source.text(4) and not source.text(5) and not source.text(6):
            towards = difference(self.model.at(source.int(4), card.place), start[0])
        else:
            towards = source.vector(4) if kind[0] == "B" else applied(self.frame(nodes[0]), source.vector(4))
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
        own = self.model.properties.get(key)
        if own and own.section and own.section.inertia_y == own.section.inertia_z == 0:  # carries along its axis alone
            hinged = [True, True]
            if own.section.torsion:
                self.lose(f"J OF {card.name}", "bars do not twist", card.place)
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
            family = "PROD" if card.name == "CROD" else "PTUBE"
            self._add(card, BAR, (card.int(2), card.int(3)), (family, card.int(1, card.int(0))))
        return False

    def _leave_strange(self) -> None:
        """Elements whose property is of a card that is lost, or whose material is, are lost with it."""
        kept = []
        for element in self.model.elements:
            own = self.model.properties.get(element.property)
            if own is None:
                number = str(element.property[1])
                card = self.properties.unknown.get((element.property[0], number)) or self.strange.get(number)
            else:
                card = None if own.material in self.model.materials else self.other_materials.get(own.material)
            if card:
                self.lose(f"ELEMENTS OF {card}", f"{card} is not known, nor elements with it; allowed, they are left out", element.place)
            else:
                kept.append(element)
        self.model.elements = kept


def read(path: Path) -> Model:
    """The model of a deck. Throws InputFault."""
    return Reader(path).model
