"""Properties and materials of Nastran decks. Axis y of an element of Nastran, the one of its vector v, is axis z of the
program, its z axis is -y: so v is the `z_axis`, I1 the inertia_y, K1 bears along z."""

from . import sections
from .model import InputFault, Material, Property, Reading, Section
from .nastran_cards import Card

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


class PropertyReader(Reading):
    """`reader` is the whole deck's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.angles: dict = {}  # property -> angle of its principal axes
        self.springs: dict = {}  # PELAS, PDAMP, PBUSH: number -> (six stiffnesses, six dashpots), or a value
        self.handlers = {"MAT1": self._material, "PSOLID": self._solid, "PSHELL": self._shell, "PBAR": self._bar,
                         "PBARL": self._shaped, "PBEAML": self._shaped, "PBEAM": self._beam, "PROD": self._rod,
                         "PTUBE": self._tube, "PELAS": self._scalar, "PDAMP": self._scalar, "PBUSH": self._bush}

    def _material(self, card: Card) -> None:
        young, shear, poisson = (card.real(k) if card.text(k) else None for k in (1, 2, 3))
        if young is None and shear is not None and poisson is not None:
            young = 2 * shear * (1 + poisson)
        if young is None:
            raise InputFault(f"{card.place}: MAT1 {card.text(0)} has no Young's modulus")
        if card.real(8):
            self.model.said.append(f"{card.place}: structural damping GE is not read; damping is told in the scene")
        self.model.materials[card.int(0)] = Material(young, poisson, card.real(4) * self.reader.mass_factor, shear,
                                                     place=card.place)

    def _put(self, card: Card, material, **more) -> None:
        self.model.properties[card.int(0)] = Property(f"{card.name}_{card.int(0)}", material, place=card.place, **more)

    def _solid(self, card: Card) -> None:
        if card.int(2, 0):
            self.model.said.append(f"{card.place}: the material axes of PSOLID do not matter to an isotropic one")
        self._put(card, card.int(1))

    def _shell(self, card: Card) -> None:
        membrane, bending, shear = (card.int(k, 0) for k in (1, 3, 5))
        wrong = [word for word, is_wrong in (
            ("bending of another material, or none", bending != membrane), ("12 I / T^3", card.real(4, 1.0) != 1.0),
            ("shear of another material", shear not in (0, membrane)), ("no membrane", membrane == 0)) if is_wrong]
        if wrong:
            self.lose("PSHELL", f"plates are of one material and full thickness ({wrong[0]}); allowed, it "
                                            "is one", card.place)
        self._put(card, membrane or bending, thickness=card.real(2), added=card.real(7) * self.reader.mass_factor)

    def _bar(self, card: Card) -> None:
        area = card.real(2)
        section = Section(area, card.real(3), card.real(4), card.real(5), card.real(17) * area, card.real(16) * area,
                          -card.real(18))
        self._put_section(card, section, card.real(6))

    def _put_section(self, card: Card, section: Section, added: float) -> None:
        turned, angle = sections.principal(section)
        if angle and section.shear_y != section.shear_z:
            self.lose(card.name, "shear areas that differ, beside a product of inertia", card.place)
        self.angles[card.int(0)] = angle
        self._put(card, card.int(1), section=turned, added=added * self.reader.mass_factor)

    def _shaped(self, card: Card) -> None:
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
            return self._put(card, card.int(1))
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
        step = 4 if card.name == "PELAS" else 2
        for at in range(0, 8, step):
            if card.text(at):
                self.springs[card.name, card.int(at)] = card.real(at + 1)

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
