"""Springs, dashpots and masses of Nastran decks."""

from .geometry import (along_global_axes, applied, axis_between, difference, frame_about, length, permutation, scaled,
                       sum_of)
from .model import AxialSpring, Gap, InputFault, PointMass, Reading, Spring
from .nastran_cards import GLOBAL, Card


class SpringReader(Reading):
    """`reader` is the whole deck's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.following = 0  # number of the last node at the end of an arm
        self.scalar_masses: dict = {}  # grid -> six masses and a card
        self.handlers = {"CELAS1": self._scalar, "CELAS2": self._scalar, "CDAMP1": self._scalar, "CDAMP2": self._scalar,
                         "CBUSH": self._bush, "CBUSH1D": self._along, "CVISC": self._along, "CGAP": self._gap, "CONM2": self._mass,
                         "CONM1": self._matrix_mass, "CMASS1": self._scalar_mass, "CMASS2": self._scalar_mass}

    def _property(self, family: str, card: Card) -> tuple:
        """Number of the property that a card names, its own where it names none, and what the property says."""
        number = card.int(1, card.int(0))
        if (family, number) not in self.reader.properties.springs:
            raise InputFault(f"{card.place}: {family} {number} is not in the deck")
        return number, self.reader.properties.springs[family, number]

    def _scalar(self, card: Card) -> bool | None:
        family = "PELAS" if card.name.startswith("CELAS") else "PDAMP"
        value = self._property(family, card)[1] if card.name.endswith("1") else card.real(1)
        ends = [(card.int(at), card.int(at + 1, 0)) for at in (2, 4) if card.text(at)]
        if not ends or any(not 1 <= component <= 6 for _, component in ends):
            return self.lose(card.name, "springs act on components of grid points", card.place)
        found = []
        if any(node in self.reader.points for node, _ in ends):
            return self.lose(card.name, "springs act on components of grid points", card.place)
        for node, component in ends:
            self.model.at(node, card.place)
            places = permutation(self.reader.frame(node))
            found.append(None if places is None else places[(component - 1) % 3] + (component - 1) // 3 * 3)
        if None in found or len(set(found)) > 1:
            return self.lose(card.name, "springs act along the global axes, on the same component of both nodes",
                                  card.place)
        both = (value, 0.0) if family == "PELAS" else (0.0, value)
        self.model.add_spring(tuple(node for node, _ in ends), found[0], *both, card.name.lower(), card.place)
        return None

    def _bush(self, card: Card) -> bool | None:
        number, (stiffness, dashpot) = self._property("PBUSH", card)
        nodes = tuple(card.int(at) for at in (2, 3) if card.text(at))
        if not nodes:
            raise InputFault(f"{card.place}: CBUSH {card.int(0)} has no grid point")
        places = [self.model.at(node, card.place) for node in nodes]
        way = difference(places[-1], places[0])
        apart = length(way) > 0
        who = f"{card.place}: element {card.int(0)}"
        name = f"pbush_{number}"
        if card.text(7):
            axes = self.reader.systems.axes_at(card.int(7), places[0], card.place)
        elif not apart:
            axes = GLOBAL
        elif not any((*stiffness[1:], *dashpot[1:])):
            self.model.axial_springs.append(AxialSpring(nodes, stiffness[0], dashpot[0], name, card.place))
            return None
        else:
            if card.text(4) and not card.text(5) and "." not in card.text(4):
                towards = difference(self.model.at(card.int(4), card.place), places[0])
            else:
                towards = applied(self.reader.frame(nodes[0]), card.vector(4))
            x, y, z = frame_about(axis_between(places, who), towards, who)
            axes = (x, z, scaled(y, -1.0))  # y of the bushing lies in the plane of the vector
        six = [along_global_axes(values, axes) for values in (stiffness, dashpot)]
        if None in six:
            return self.lose("CBUSH", "bushings act along and about the global axes", card.place)
        across = [k for k in range(3) if apart and abs(way[k]) < (1 - 1e-9) * length(way) and (six[0][k] or six[1][k])]
        if across:  # the bushing lies at one place, and arms go from there to both nodes
            share = card.real(8, 0.5)
            own = card.int(9, -1)
            place = self.reader.systems.point(own, card.vector(10), card.place) if own >= 0 else sum_of(places[0], way, share)
            nodes = tuple(self._arm(node, place, f"{name}_arm", card.place) for node in nodes)
        self.model.springs.append(Spring(nodes, *six, name, card.place))
        return None

    def _arm(self, node: int, place: tuple, name: str, where: str) -> int:
        """A node at a place that moves with another one as one body; that one where it is there."""
        if self.model.nodes[node] == place:
            return node
        self.following = (self.following or max(self.model.nodes)) + 1
        self.model.nodes[self.following] = place
        self.model.rigid.append((name, [node, self.following], where))
        return self.following

    def _along(self, card: Card) -> bool | None:
        """A spring or a dashpot along the line of two grid points."""
        family = "PVISC" if card.name == "CVISC" else "PBUSH1D"
        number, values = self._property(family, card)
        nodes = tuple(card.int(at) for at in (2, 3) if card.text(at))
        if len(nodes) < 2 or self.model.at(nodes[0], card.place) == self.model.at(nodes[1], card.place):
            return self.lose(card.name, "springs along a line have two grid points that are apart", card.place)
        self.model.axial_springs.append(AxialSpring(nodes, *values, f"{family.lower()}_{number}", card.place))
        return None

    def _gap(self, card: Card) -> bool | None:
        """Along x of its system, else along the line of its grid points."""
        number, values = self._property("PGAP", card)
        nodes = card.int(2), card.int(3)
        places = [self.model.at(node, card.place) for node in nodes]
        if card.text(7):
            way = self.reader.systems.axes_at(card.int(7), places[0], card.place)[0]
        else:
            way = axis_between(places, f"{card.place}: gap {card.int(0)}")
        self.model.gaps.append(Gap(nodes, way, *values, f"pgap_{number}", card.place))
        return None

    def _scalar_mass(self, card: Card) -> bool | None:
        """Masses along one component, which are gathered by grid points."""
        value = card.real(1) if card.name == "CMASS2" else self._property("PMASS", card)[1]
        ends = [(card.int(at), card.int(at + 1, 0)) for at in (2, 4) if card.text(at)]
        places = permutation(self.reader.frame(ends[0][0])) if len(ends) == 1 and 1 <= ends[0][1] <= 6 else None
        if places is None or ends[0][0] in self.reader.points:
            return self.lose(card.name, "a mass acts on one component, along a global axis, of one grid point", card.place)
        node, component = ends[0]
        self.model.at(node, card.place)
        six, _ = self.scalar_masses.setdefault(node, ([0.0] * 6, card))
        six[places[(component - 1) % 3] + (component - 1) // 3 * 3] += value * self.reader.mass_factor
        return None

    def finish(self) -> None:
        for node, (six, card) in self.scalar_masses.items():
            self._keep_mass(node, six, max(map(abs, six[:3])), "cmass", card)

    def _keep_mass(self, node: int, six: list, scale: float, name: str, card: Card) -> None:
        """The point mass of six numbers along and about the axes; `scale` of the differences that are round-off."""
        if max(six[:3]) - min(six[:3]) > 1e-9 * scale:
            self.lose("MASS THAT DIFFERS BY DIRECTION", "a mass is the same along all axes; allowed, the largest holds", card.place)
        self.model.masses.append(PointMass(node, max(six[:3]), tuple(six[3:]), name=name, place=card.place))

    def _matrix_mass(self, card: Card) -> None:
        """Of the six by six numbers of CONM1 a mass that is the same along all axes, and inertia about them."""
        rows = [[card.real(3 + i * (i + 1) // 2 + k) * self.reader.mass_factor for k in range(i + 1)] for i in range(6)]
        diagonal = [row[-1] for row in rows]
        scale = max(map(abs, diagonal)) or 1.0
        if card.int(2, 0) or any(abs(value) > 1e-9 * scale for row in rows for value in row[:-1]):
            self.lose("PRODUCTS OF CONM1", "masses have no products and no axes of their own; allowed, its diagonal holds", card.place)
        self._keep_mass(card.int(1), diagonal, scale, "conm1", card)

    def _mass(self, card: Card) -> bool | None:
        node, system = card.int(1), card.int(2, 0)
        place = self.model.at(node, card.place)
        axes = GLOBAL if system == -1 else self.reader.systems.axes_at(system, place, card.place) if system else GLOBAL
        arm = difference(card.vector(4), place) if system == -1 else applied(axes, card.vector(4))
        inertia = [card.real(k) for k in (8, 10, 13)]
        about = along_global_axes((*inertia, 0.0, 0.0, 0.0), axes)
        if any(card.real(k) for k in (9, 11, 12)) or about is None:
            self.lose("I OF CONM2", "rotary inertia is about the global axes, without products", card.place)
            about = (0.0,) * 3
        self.model.masses.append(PointMass(node, card.real(3) * self.reader.mass_factor, scaled(about[:3], self.reader.mass_factor),
                                           arm if length(arm) > 0 else None, "conm2", card.place))
        return None
