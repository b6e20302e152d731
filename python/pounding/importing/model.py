"""The neutral model: what readers of all formats fill and one writer makes a scene of. In the units of the file until
`in_si` (scaling.py) has gone over it; local axes are those of the program, so that z_axis is `z_axis` of a section."""

from collections import Counter
from dataclasses import dataclass, field

from pounding import UserError

X, Y, Z, RX, RY, RZ = (1 << place for place in range(6))
TRANSLATIONS, ROTATIONS, ALL = X | Y | Z, RX | RY | RZ, 63
COMPONENTS = ("x", "y", "z", "rx", "ry", "rz")

# Nodes of an element, and whether they turn.
SOLIDS = {"hex8": 8, "hex8_full": 8, "wedge6": 6, "tet4": 4}
BEAMS = ("beam", "euler_beam")
SHELL, BAR = "shell", "bar"


class InputFault(UserError):
    """A file that cannot be read: one line with its name and the number of the line."""


@dataclass(slots=True)
class Material:
    """Isotropic. `shear`: the modulus where the file states one of its own."""

    young: float
    poisson: float | None
    density: float
    shear: float | None = None
    alpha: float = 0.0
    beta: float = 0.0
    place: str = ""


@dataclass(slots=True)
class Section:
    """Numbers of a cross-section in axes y and z of the program: inertia_y bends in the x-z plane. Shear areas of 0
    mean no flexibility in shear. `product`: integral of y z over the section."""

    area: float
    inertia_y: float
    inertia_z: float
    torsion: float
    shear_y: float = 0.0
    shear_z: float = 0.0
    product: float = 0.0


@dataclass(slots=True)
class Property:
    """Material by name, and what the kind of element needs: section of beams, area of bars, thickness of shells;
    `added`: mass per length or area beside the material's."""

    name: str
    material: object
    section: Section | None = None
    area: float = 0.0
    thickness: float = 0.0
    added: float = 0.0
    place: str = ""


@dataclass(slots=True)
class Element:
    """`arms`: per node the vector from it to the place of the element's own node, or None. `hinged`: ends of a beam
    that turn on their own."""

    kind: str
    number: int
    nodes: tuple
    property: object
    z_axis: tuple | None = None
    arms: tuple | None = None
    hinged: tuple = (False, False)
    added: float = 0.0
    place: str = ""


@dataclass(slots=True)
class PointMass:
    """Mass and rotary inertia about x, y, z at the end of an arm from the node."""

    node: int
    mass: float
    inertia: tuple = (0.0, 0.0, 0.0)
    arm: tuple | None = None
    name: str = "mass"
    place: str = ""


@dataclass(slots=True)
class Spring:
    """Along and about the global axes; one node: to the ground."""

    nodes: tuple
    stiffness: tuple
    dashpot: tuple = (0.0,) * 6
    name: str = "spring"
    place: str = ""


@dataclass(slots=True)
class AxialSpring:
    """Along the line between its two nodes; its dashpot goes by a power of the rate, and may be in series with a spring.
    `only`: the option by which it acts one way."""

    nodes: tuple
    stiffness: float
    dashpot: float = 0.0
    name: str = "spring"
    place: str = ""
    power: float = 1.0
    series: float = 0.0
    only: str = ""


@dataclass(slots=True)
class Gap:
    """Two nodes that may come together by `gap` along the unit vector `way`, in which the second lies beyond the first;
    None: the ground. `stiffness` from there on, 0: it is hard."""

    nodes: tuple
    way: tuple
    gap: float
    stiffness: float = 0.0
    name: str = "gap"
    place: str = ""


class Cards:
    """What became of every card of a file, by its name: read, noted because nothing of stiffness, mass or support is in
    it, or lost."""

    def __init__(self):
        self.read: Counter = Counter()
        self.noted: Counter = Counter()
        self.lost: Counter = Counter()
        self.why: dict = {}
        self.first: dict = {}

    def use(self, card: str, count: int = 1) -> None:
        self.read[card] += count

    def note(self, card: str, why: str = "", count: int = 1) -> bool:
        """False, which handlers return where the card is not read."""
        self.noted[card] += count
        if why:
            self.why.setdefault(card, why)
        return False

    def lose(self, card: str, why: str, place: str, count: int = 1) -> bool:
        """False, as `note`."""
        self.lost[card] += count
        self.why.setdefault(card, why)
        self.first.setdefault(card, place)
        return False


class Once:
    """Numbers and names that a file gives to one thing alone."""

    def __init__(self):
        self.first: dict = {}  # (what, number) -> content and place of the first

    def new(self, what: str, number, content, place: str) -> bool:
        """Whether this is the first; a second that says the same is none. Throws InputFault where it says other."""
        before, where = self.first.setdefault((what, number), (content, place))
        if before != content:
            raise InputFault(f"{place}: {what} {number} is there already, at {where}, and is another one")
        return where is place


@dataclass
class Model:
    """A structure: nodes by number, elements, and what holds and joins them."""

    name: str = ""
    nodes: dict = field(default_factory=dict)  # number -> (x, y, z)
    elements: list = field(default_factory=list)
    materials: dict = field(default_factory=dict)
    properties: dict = field(default_factory=dict)
    masses: list = field(default_factory=list)
    springs: list = field(default_factory=list)
    axial_springs: list = field(default_factory=list)
    gaps: list = field(default_factory=list)
    supports: dict = field(default_factory=dict)  # node -> components
    rigid: list = field(default_factory=list)  # (name, nodes, place)
    in_part: list = field(default_factory=list)  # (name, hub, nodes that follow it, in these components, card, place)
    pins: list = field(default_factory=list)  # sets of nodes that share their displacements, and their place
    node_sets: dict = field(default_factory=dict)  # name -> nodes
    element_sets: dict = field(default_factory=dict)  # name -> places in `elements`
    facet_sets: dict = field(default_factory=dict)  # name -> tuples of nodes
    midside: dict = field(default_factory=dict)  # node between corners -> corners of its cell, and their place
    ties: list = field(default_factory=list)  # (name of a set that follows, name of a set of facets)
    alpha: float = 0.0
    beta: float = 0.0
    has_properties: bool = True  # .med and .unv hold meshes and groups alone
    cards: Cards = field(default_factory=Cards)
    once: Once = field(default_factory=Once)
    said: list = field(default_factory=list)  # remarks for the user

    def hold(self, node: int, components: int) -> None:
        self.supports[node] = self.supports.get(node, 0) | components

    def add_spring(self, nodes: tuple, component: int, stiffness: float, dashpot: float, name: str, place: str) -> None:
        """Along or about one global axis; components are counted from 0."""
        six = [tuple(value if k == component else 0.0 for k in range(6)) for value in (stiffness, dashpot)]
        self.springs.append(Spring(nodes, *six, name, place))

    def at(self, node: int, place: str) -> tuple:
        """Coordinates of a node; throws InputFault where there is none."""
        if node not in self.nodes:
            raise InputFault(f"{place}: node {node} is not in the file")
        return self.nodes[node]


class Reading:
    """Readers of all formats and their parts: the model, and what becomes of cards. `reader`: of the whole file."""

    def __init__(self, model: Model, reader=None):
        self.model, self.reader = model, reader
        self.use, self.note, self.lose = model.cards.use, model.cards.note, model.cards.lose
        self.new = model.once.new

    def pass_over(self, card: str, place: str, reasons: dict) -> None:
        """Notes a card that no handler takes by the reason that knows its name, or loses it."""
        why = next((why for why, names in reasons.items() if card in names), None)
        self.lose(card, "not known", place) if why is None else self.note(card, why)


def components_of(digits: str, place: str) -> int:
    """Components of a text as 123 or 1246. Throws InputFault."""
    found = 0
    for digit in digits.strip():
        if digit not in "0123456":
            raise InputFault(f"{place}: '{digits.strip()[:60]}' are not components from 1 to 6")
        if digit != "0":
            found |= 1 << (int(digit) - 1)
    return found
