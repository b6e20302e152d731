"""Element types, real constants, sections and materials of ANSYS archives. Axes y and z of its beams are those of
the program."""

from . import sections
from .ansys_cards import Command
from .cards import is_whole_number
from .model import InputFault, Material, Reading, Section

# Name -> what becomes of it; solids of KEYOPT are in `solid_kind`.
SHELLS = {181: 0, 63: 0, 43: 0, 41: None}
LABELS = {"EX": "young", "DENS": "density", "NUXY": "poisson", "PRXY": "poisson", "GXY": "shear", "ALPD": "alpha",
          "BETD": "beta", "DAMP": "beta"}
OTHER_AXES = ("EY", "EZ", "NUYZ", "NUXZ", "PRYZ", "PRXZ", "GYZ", "GXZ")
BEAM_SHAPES = {"RECT": 2, "CSOLID": 1, "CTUBE": 2, "I": 6, "HREC": 6, "ASEC": 6}


def solid_kind(type_: int, keys: dict) -> str | None:
    """The element that bricks of a type become; None where it is none."""
    if type_ == 185:
        return None if keys.get(3) else "hex8" if keys.get(2, 0) in (1, 2, 3) else "hex8_full"
    return {45: "hex8_full" if keys.get(1) else "hex8"}.get(type_)


class Properties(Reading):
    """Tables that commands fill; `model` gets the materials."""

    def __init__(self, model):
        super().__init__(model)
        self.types: dict = {}  # number -> type of element
        self.keys: dict = {}  # number -> option -> value
        self.reals: dict = {}  # set -> values
        self.sections: dict = {}  # number -> [kind, subtype, name, values or layers, offset, place]
        self.current: int | None = None
        self.repeated: list = []  # sections of the same number, and what they were before
        self.last_real: int | None = None
        self.values: dict = {}  # material -> name of LABELS -> value
        self.handlers = {"ET": self._type, "ETBLOCK": self._types, "KEYO": self._key, "KEYOP": self._key, "KEYOPT": self._key,
                         "R": self._real,
                         "RMORE": self._more, "RLBLOCK": self._reals, "SECTYPE": self._section, "SECDATA": self._data,
                         "SECBLOCK": self._layers, "SECOFFSET": self._offset, "SECCONTROL": self._control,
                         "SECCONTROLS": self._control, "MP": self._material, "MPDATA": self._material}

    def _type(self, command: Command) -> None:
        text = command.text(1).upper()
        digits = "".join(letter for letter in text if is_whole_number(letter))
        if not digits or not is_whole_number(digits):
            raise InputFault(f"{command.place}: ET {command.text(0)} names no element")
        self.new("ET", command.int(0), command.words[1:], command.place)
        self.types[command.int(0)] = int(digits)
        for at, value in enumerate(command.words[2:], 1):
            if value:
                self.keys.setdefault(command.int(0), {})[at] = int(value) if is_whole_number(value.lstrip("-")) else 0

    def _types(self, command: Command) -> None:
        for place, words in command.rows:
            row = Command("ETBLOCK", words, place)
            self.new("ET", row.int(0), words[1:], place)
            self.types[row.int(0)] = row.int(1)
            self.keys[row.int(0)] = {at: row.int(1 + at) for at in range(1, len(words) - 1) if row.int(1 + at, 0)}

    def _key(self, command: Command) -> None:
        self.keys.setdefault(command.int(0), {})[command.int(1)] = int(command.real(2))

    def _real(self, command: Command) -> None:
        self.last_real = command.int(0)
        self.new("set of real constants", self.last_real, command.words[1:], command.place)
        self.reals[self.last_real] = [command.real(at) for at in range(1, len(command.words))]

    def _more(self, command: Command) -> None:
        values = self.reals.get(self.last_real)
        if values is None:
            raise InputFault(f"{command.place}: RMORE after no R")
        values += [0.0] * (-len(values) % 6) + [command.real(at) for at in range(len(command.words))]

    def _reals(self, command: Command) -> None:
        for own, values in command.rows:
            self.new("set of real constants", own, values, command.place)
            self.reals[own] = values

    def _section(self, command: Command) -> None:
        self.current = command.int(0)
        if self.current in self.sections:
            self.repeated.append((self.current, self.sections[self.current]))
        self.sections[self.current] = [command.text(1).upper(), command.text(2).upper(), command.text(3), [], ("", []),
                                       command.place]

    def _open(self, command: Command) -> list:
        if self.current is None:
            raise InputFault(f"{command.place}: {command.name} after no SECTYPE")
        return self.sections[self.current]

    def _data(self, command: Command) -> None:
        values = [command.real(at) for at in range(len(command.words))]
        if self._open(command)[0].startswith("SHEL"):
            self._open(command)[3].append(values)
        else:
            self._open(command)[3] += values

    def _layers(self, command: Command) -> None:
        for place, words in command.rows:
            self._data(Command("SECBLOCK", words, place))

    def _offset(self, command: Command) -> None:
        self._open(command)[4] = command.text(0).upper(), [command.real(1), command.real(2)]

    def _control(self, command: Command) -> bool:
        if any(command.real(at) for at in range(len(command.words))):
            return self.lose("SECCONTROL", "stiffnesses and masses in place of those of the section", command.place)
        return True

    def _material(self, command: Command) -> None:
        words = command.words[:]
        if words and words[0].upper().startswith("R") and "." in words[0]:  # MPDATA,R5.0, 1,EX  , 1, 1, 2e11
            label = next((at for at in range(1, min(4, len(words))) if words[at][:1].isalpha()
                          and words[at].upper() != "UNBL"), None)
            if label is None:
                raise InputFault(f"{command.place}: {command.name} names no property")
            words = words[label:]
        row = Command(command.name, words, command.place)
        name, number_ = row.text(0).upper(), row.int(1)
        value = row.real(3 if command.name == "MPDATA" else 2)
        if command.name == "MP" or row.int(2, 1) == 1:  # other ones begin at a higher temperature
            self.new(f"{name} of material", number_, value, command.place)
        if name in LABELS:
            own = self.values.setdefault(number_, {})
            if LABELS[name] not in own:  # of several temperatures the first
                own[LABELS[name]] = value
                own.setdefault("place", command.place)
        elif name in OTHER_AXES:
            self.values.setdefault(number_, {}).setdefault("others", []).append((name, value, command.place))

    def finish(self) -> None:
        """Materials of the model."""
        for number_, before in self.repeated:
            if before[:5] != self.sections[number_][:5]:
                raise InputFault(f"{self.sections[number_][5]}: section {number_} is there already, at {before[5]}, and is "
                                 "another one")
        for number_, values in self.values.items():
            young, poisson, shear = (values.get(name) for name in ("young", "poisson", "shear"))
            place = values.get("place", "")
            for name, value, where in values.get("others", []):
                same = young if name[0] == "E" else shear if name[0] == "G" else poisson
                if value and same is not None and abs(value - same) > 1e-9 * abs(same):
                    self.lose("MP OF OTHER AXES", "materials are isotropic", where)
            if young is None:
                continue
            if poisson is None and not shear:
                poisson = 0.3
                self.model.said.append(f"material {number_} has no Poisson's ratio: 0.3, as ANSYS takes it")
            self.model.materials[number_] = Material(young, poisson, values.get("density", 0.0), shear,
                                                     values.get("alpha", 0.0), values.get("beta", 0.0), place)

    def beam_section(self, number_: int, place: str) -> tuple | None:
        """Section of SECTYPE, the angle of its principal axes, and the place of its centroid along y and z from the
        node. None where it is lost."""
        if number_ not in self.sections or self.sections[number_][0] != "BEAM":
            raise InputFault(f"{place}: section {number_} is no BEAM of SECTYPE")
        _, shape, _, values, (where, way), own = self.sections[number_]
        if shape not in BEAM_SHAPES:
            self.lose(f"SECTYPE BEAM {shape}", "this cross-section is not known; give its numbers as ASEC", own)
            return None
        if len(values) < BEAM_SHAPES[shape]:
            raise InputFault(f"{own}: a section {shape} has {BEAM_SHAPES[shape]} dimensions")
        if shape == "RECT":
            found = sections.rectangle(values[0], values[1])
        elif shape == "CSOLID":
            found = sections.ring(values[0])
        elif shape == "CTUBE":
            found = sections.ring(values[1], values[0])
        elif shape == "HREC" and len(set(values[2:6])) == 1:
            found = sections.box(values[0], values[1], values[2], values[2])
        elif shape == "I" and values[0] == values[1] and values[3] == values[4]:
            found = sections.i_shape(values[2], values[0], values[1], values[3], values[4], values[5])[0]
        elif shape == "ASEC":
            area, iyy, iyz, izz, _, torsion, *rest = values
            if any(rest[:4]):
                self.lose("SECTYPE BEAM ASEC", "a centroid or shear centre off the node", own)
            found = Section(area, iyy, izz, torsion, 5 / 6 * area, 5 / 6 * area, iyz)
        else:
            self.lose(f"SECTYPE BEAM {shape}", "walls of different thickness, or flanges that differ", own)
            return None
        centroid = (0.0, 0.0)
        if where == "USER" and shape in ("RECT", "CSOLID", "CTUBE"):
            centroid = (-way[0], -way[1])
        elif where not in ("", "CENT", "SHRC") and not (where == "ORIGIN" and shape in ("RECT", "CSOLID", "CTUBE")):
            self.lose(f"SECOFFSET {where} OF {shape}", "the origin of this section is not known", own)
        turned, angle = sections.principal(found)
        return turned, angle, centroid

    def shell_section(self, number_: int, material: int, place: str) -> tuple:
        """Thickness, material and offset of the mid-surface along the normal over the thickness."""
        if number_ not in self.sections or not self.sections[number_][0].startswith("SHEL"):
            raise InputFault(f"{place}: section {number_} is no SHELL of SECTYPE")
        _, _, _, layers, (where, _), own = self.sections[number_]
        materials = {int(layer[1]) if len(layer) > 1 and layer[1] else material for layer in layers}
        if not all(layer and layer[0] > 0 for layer in layers):
            raise InputFault(f"{own}: a section SHELL has a layer without thickness")
        if not layers or len(materials) != 1:
            self.lose("SECTYPE SHELL", "layers of one material", own)
            materials.add(material)
        if where not in ("", "MID", "TOP", "BOT"):
            self.lose(f"SECOFFSET {where} OF SHELL", "offsets of shells are MID, TOP, BOT", own)
        return sum(layer[0] for layer in layers), sorted(materials)[0], {"TOP": -0.5, "BOT": 0.5}.get(where, 0.0)
