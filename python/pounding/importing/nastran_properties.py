"""Properties and materials of Nastran decks. Axis y of an element of Nastran, the one of its vector v, is axis z of the
program, its z axis is -y: so v is the `z_axis`, I1 the inertia_y, K1 bears along z."""

from dataclasses import replace

from . import sections
from .model import InputFault, Material, Property, Reading, Section
from .nastran_cards import Card
from .nastran_plates import layers_of, stiffness_of
from .plates import Layer, equal_plate

SHAPES = {"ROD": 1, "TUBE": 2, "BAR": 2, "BOX": 4, "I": 6}


def shape_of(kind: str, values: list, card: Card) -> Section | None:
    """Section of a type of PBARL and PBEAML; None where it is not known."""
    if kind not in SHAPES:
        return None
    if len(values) < SHAPES[kind] or min(values[:1] + values[2:SHAPES[kind]]) <= 0:
        raise InputFault(f"{card.place}: {card.name} of type {kind} has {SHAPES[kind]} dimensions above 0")
    if kind == "ROD":
        return sections.ring(values[0])
    if kind == "TUBE":
        return sections.ring(values[0], values[1])
    if kind == "BAR":
        return sections.rectangle(values[0], values[1])
    if kind == "BOX":
        return sections.box(values[0], values[1], values[3], values[2])
    height, bottom, top, web, bottom_flange, top_flange = values[:6]
    if bottom != top or bottom_flange != top_flange:
        return None
    return sections.i_shape(height, bottom, top, bottom_flange, top_flange, web)[0]


# Card -> kind of property; numbers of one kind are its own.
FAMILIES = {"PBARL": "PBAR", "PBEAML": "PBEAM", "PCOMP": "PSHELL", "PCOMPG": "PSHELL", "PIHEX": "PSOLID"}


def family_of(card: str) -> str:
    return FAMILIES.get(card, card)


class PropertyReader(Reading):
    """`reader` is the whole deck's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.angles: dict = {}  # property -> angle of its principal axes
        self.springs: dict = {}  # PELAS, PDAMP, PBUSH: number -> (six stiffnesses, six dashpots), or a value
        self.layers: dict = {}  # material -> (stiffness in plane and across it, density), see nastran_plates.py
        self.offsets: dict = {}  # property of plates -> way of their middle from the grid points
        self.unknown: dict = {}  # kind and number of a property -> card, of a cross-section that is not known
        self.solids: set = set()  # keys of properties of solids
        self.materials = {"MAT1": self._material, "MAT2": self._anisotropic, "MAT8": self._anisotropic}
        self.handlers = {"PSOLID": self._solid, "PIHEX": self._solid, "PSHELL": self._shell, "PCOMP": self._laminate,
                         "PCOMPG": self._laminate, **dict.fromkeys(("PQUAD1", "PTRIA1"), self._old_plate),
                         **dict.fromkeys(("PQUAD2", "PTRIA2", "PQDMEM", "PQDMEM1", "PQDMEM2", "PTRMEM"), self._plate), "PSHEAR": self._panel, "PBAR": self._bar,
                         "PBARL": self._shaped, "PBEAML": self._shaped, "PBEAM": self._beam, "PROD": self._rod,
                         "PTUBE": self._tube, "PELAS": self._scalar, "PDAMP": self._scalar, "PBUSH": self._bush,
                         "PBUSH1D": self._line, "PVISC": self._line, "PMASS": self._scalar, "PGAP": self._gap}

    def _material(self, card: Card) -> None:
        young, shear, poisson = (card.real(k) if card.text(k) else None for k in (1, 2, 3))
        if young is None and shear is not None and poisson is not None:
            young = 2 * shear * (1 + poisson)
        if young is None:
            raise InputFault(f"{card.place}: MAT1 {card.text(0)} has no Young's modulus")
        if young and shear and poisson is not None and not -1 < poisson < 0.5:
            poisson = None  # bars have no need of it
        if card.real(8):
            self.model.said.append(f"{card.place}: structural damping GE is not read; damping is told in the scene")
        density = card.real(4) * self.reader.mass_factor
        self.model.materials[card.int(0)] = Material(young, poisson, density, shear, place=card.place)
        self.layers[card.int(0)] = stiffness_of(card), density

    def _anisotropic(self, card: Card) -> None:
        self.layers[card.int(0)] = stiffness_of(card), card.real(7) * self.reader.mass_factor

    def _put(self, card: Card, material, **more) -> None:
        key = family_of(card.name), card.int(0)
        self.model.properties[key] = Property(f"{card.name}_{card.int(0)}", material, place=card.place, **more)

    def _solid(self, card: Card) -> None:
        if card.name == "PSOLID" and card.int(2, 0):
            self.model.said.append(f"{card.place}: the material axes of PSOLID do not matter to an isotropic one")
        self._put(card, card.int(1))
        self.solids.add((family_of(card.name), card.int(0)))

    def _plate(self, card: Card) -> None:
        """Two properties on a card, each with material, thickness and mass per area."""
        for at in range(0, len(card.fields), 4):
            if card.text(at):
                self._put(Card(card.name, card.fields[at:at + 4], card.place), card.int(at + 1), thickness=card.real(at + 2),
                          added=card.real(at + 3) * self.reader.mass_factor)

    def _panel(self, card: Card) -> None:
        self._put(card, card.int(1), thickness=card.real(2), added=card.real(3) * self.reader.mass_factor)

    def _old_plate(self, card: Card) -> None:
        """Of NASTRAN-95: material and thickness in plane, material and inertia per length in bending, those of shear."""
        thickness = card.real(2) or (12 * abs(card.real(4)))**(1 / 3)
        ratio = 12 * card.real(4) / thickness**3 if thickness else 1.0
        fields = [card.text(0), card.text(1), repr(thickness), card.text(3), "" if abs(ratio - 1) < 1e-4 else repr(ratio), "", "",
                  card.text(7)]
        self._shell(Card(card.name, fields, card.place))

    def _shell(self, card: Card) -> None:
        membrane, bending, shear = (card.int(k, 0) for k in (1, 3, 5))
        isotropic = all(one in self.model.materials for one in (membrane, bending) if one)
        wrong = [word for word, is_wrong in (
            ("of a material with directions", not isotropic), ("bending of another material, or none", bending != membrane),
            ("12 I / T^3", card.real(4, 1.0) != 1.0), ("shear of another material", shear not in (0, membrane)),
            ("no membrane", membrane == 0)) if is_wrong]
        if wrong:
            self.lose(card.name, f"plates are of one isotropic material and full thickness ({wrong[0]}); allowed, thickness and "
                                "modulus are those of equal mean stiffness in plane and in bending, without shear of a core",
                      card.place)
        thickness, added = card.real(2), card.real(7) * self.reader.mass_factor
        both = [one for one in (membrane, bending) if one]
        if (not isotropic or card.real(4, 1.0) != 1.0 or len(set(both)) > 1) and thickness > 0 and all(
                one in self.layers for one in both):
            (plane, density), bent = self.layers[both[0]], self.layers[both[-1]][0]
            ratio = card.real(4, 1.0) if bending else 1.0
            self._equal(card, equal_plate([Layer(plane, density, thickness)],
                                          [value * ratio * thickness**3 / 12 for value in bent]), added)
        else:
            self._put(card, membrane or bending, thickness=thickness, added=added)

    def _laminate(self, card: Card) -> None:
        layers, middle = layers_of(card, self.layers)
        self.lose(card.name, "plates are of one isotropic material; allowed, thickness and modulus are those of equal mean stiffness "
                             "in plane and in bending, without directions and without shear of a core", card.place)
        if abs(middle) > 1e-9 * sum(layer.thickness for layer in layers):
            self.offsets[family_of(card.name), card.int(0)] = middle
        self._equal(card, equal_plate(layers), card.real(2) * self.reader.mass_factor)

    def _equal(self, card: Card, plate: tuple, added: float) -> None:
        young, poisson, density, thickness = plate
        name = f"{card.name} {card.int(0)}"
        self.model.materials[name] = Material(young, poisson, density, place=card.place)
        self._put(card, name, thickness=thickness, added=added)

    def _bar(self, card: Card) -> None:
        area = card.real(2)
        section = Section(area, card.real(3), card.real(4), card.real(5), card.real(17) * area, card.real(16) * area,
                          -card.real(18))
        self._put_section(card, section, card.real(6))

    def _put_section(self, card: Card, section: Section, added: float) -> None:
        stiff = max(section.inertia_y, section.inertia_z)
        if stiff > 0 and min(section.inertia_y, section.inertia_z) == 0:
            self.lose(f"I OF {card.name}", "beams bend about both axes; allowed, the inertia of one holds for both", card.place)
            section = replace(section, inertia_y=stiff, inertia_z=stiff)
        if stiff > 0 and section.torsion == 0:
            self.lose(f"J OF {card.name}", "beams twist; allowed, I1 + I2 holds where J is none", card.place)
            section = replace(section, torsion=section.inertia_y + section.inertia_z)
        turned, angle = sections.principal(section)
        if angle and section.shear_y != section.shear_z:
            self.lose(card.name, "shear areas that differ, beside a product of inertia", card.place)
        self.angles[family_of(card.name), card.int(0)] = angle
        self._put(card, card.int(1), section=turned, added=added * self.reader.mass_factor)

    def _shaped(self, card: Card):
        kind = card.text(3).upper()
        values = []
        for text in card.fields[8:]:
            if text.upper() in ("YES", "YESA", "NO"):  # of PBEAML, where other stations begin
                break
            values.append(text)
        while values and not values[-1]:
            values.pop()
        dimensions = [card.real(8 + k) for k in range(len(values))]
        section = shape_of(kind, dimensions, card)
        if section is None:
            self.lose(f"{card.name} {kind}", "this cross-section is not known; give its numbers in PBAR", card.place)
            self.unknown[family_of(card.name), card.text(0)] = f"{card.name} {kind}"
            return None
        rest = len([text for text in card.fields[8 + len(values):] if text])
        far = [card.real(10 + len(values) + k, value) for k, value in enumerate(dimensions[:SHAPES[kind]])]
        if rest and shape_of(kind, far, card) != section:
            self.lose("PBEAML", "beams that taper are not known; allowed, end A holds", card.place)
        return self._put_section(card, section, dimensions[SHAPES[kind]] if len(dimensions) > SHAPES[kind] else 0.0)

    def _beam(self, card: Card) -> None:
        blocks = [card.fields[at:at + 8] for at in range(8, len(card.fields), 8)]
        numbers = [card.real(2 + k) for k in range(6)]  # A, I1, I2, I12, J, NSM
        stress, tail, tapers = True, [], False
        for at, block in enumerate(blocks):
            if block[0].upper() in ("YES", "YESA", "NO"):
                stress = block[0].upper() == "YES"
                station = [Card("", block, card.place).real(2 + k, numbers[k]) for k in range(6)]
                tapers |= any(abs(a - b) > 1e-3 * abs(b) for a, b in zip(station, numbers))
            elif stress:
                stress = False
            else:
                tail = [text for rest in blocks[at:] for text in rest]
                break
        last = Card(card.name, tail, card.place)
        if tapers:
            self.lose("PBEAM", "beams that taper are not known; allowed, end A holds", card.place)
        if any(last.real(k) for k in (4, 5, *range(8, 16))):
            self.lose("PBEAM", "inertia per length, and masses and axes off the beam, are not known", card.place)
        area = numbers[0]
        section = Section(area, numbers[1], numbers[2], numbers[4], last.real(1, 1.0) * area, last.real(0, 1.0) * area,
                          -numbers[3])
        self._put_section(card, section, numbers[5])

    def _rod(self, card: Card) -> None:
        if card.real(3):
            self.lose("J OF PROD", "bars do not twist", card.place)
        self._put(card, card.int(1), area=card.real(2), added=card.real(5) * self.reader.mass_factor)

    def _tube(self, card: Card) -> None:
        outer, wall = card.real(2) / 2, card.real(3)
        area = sections.ring(outer, outer - wall if wall else 0.0).area
        self._put(card, card.int(1), area=area, added=card.real(4) * self.reader.mass_factor)

    def _scalar(self, card: Card) -> None:
        step = {"PELAS": 4}.get(card.name, 2)
        for at in range(0, 8, step):
            if card.text(at):
                self.springs[card.name, card.int(at)] = card.real(at + 1)

    def _line(self, card: Card) -> None:
        """Spring and dashpot along a line."""
        if card.name == "PVISC":
            for at in (0, 4):
                if card.text(at):
                    self.springs["PVISC", card.int(at)] = 0.0, card.real(at + 1)
                if card.real(at + 2):
                    self.lose("CR OF PVISC", "dashpots about their line are not known", card.place)
            return
        if any(card.fields[4:]):
            self.lose("PBUSH1D", "springs along a line are linear", card.place)
        if card.real(3):
            self.lose("M OF PBUSH1D", "masses of bushings are not known", card.place)
        self.springs["PBUSH1D", card.int(0)] = card.real(1), card.real(2)

    def _gap(self, card: Card) -> None:
        """Opening and stiffness once it is closed."""
        closed = card.real(3)
        for at, word, most in ((2, "F0", 0.0), (4, "KB", 1e-3 * closed), (6, "MU1", 0.0), (7, "MU2", 0.0)):
            if abs(card.real(at)) > most:
                self.lose(f"{word} OF PGAP", "a gap has an opening and a stiffness once it is closed, no friction", card.place)
        self.springs["PGAP", card.int(0)] = card.real(1), closed

    def _bush(self, card: Card) -> None:
        parts, key = {"K": [0.0] * 6, "B": [0.0] * 6}, None
        count = 0
        for at, text in enumerate(card.fields[1:], 1):
            if text and text[0].isalpha():
                key, count = text.upper(), at
                if key not in ("K", "B", "GE", "RCV", "M"):
                    raise InputFault(f"{card.place}: PBUSH has {text} in place of K or B")
            elif text and key in parts and 1 <= at - count <= 6:
                parts[key][at - count - 1] = card.real(at)
            elif text and key == "M":
                self.lose("M OF PBUSH", "masses of bushings are not known", card.place)
        self.springs["PBUSH", card.int(0)] = tuple(parts["K"]), tuple(parts["B"])
