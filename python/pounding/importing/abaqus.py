"""Reads Abaqus and CalculiX decks (.inp) into the neutral model."""

from dataclasses import dataclass, replace
from pathlib import Path

from .abaqus_cards import Block, Motion, Scope, blocks_of, motion_of
from .abaqus_joints import JointReader
from .abaqus_sections import SectionReader
from .cards import is_whole_number, names_of, numbers, whole, whole_range
from .geometry import axis_between, cross, difference, permutation, unit
from .model import BAR, BEAMS, AxialSpring, Element, Gap, InputFault, Material, Model, PointMass, Reading
from .second_order import by_corners

ELEMENTS = {"C3D8": ("hex8_full", 8), "C3D8I": ("hex8", 8), "C3D8R": ("hex8", 8), "C3D6": ("wedge6", 6),
            "C3D4": ("tet4", 4), "S4": ("shell", 4), "S4R": ("shell", 4), "S4RS": ("shell", 4), "S4RSW": ("shell", 4),
            "S3": ("shell", 3), "S3R": ("shell", 3), "S3RS": ("shell", 3), "STRI3": ("shell", 3), "B31": ("beam", 2),
            "B33": ("euler_beam", 2), "T3D2": (BAR, 2)}
POINTS = {"MASS": 1, "ROTARYI": 1, "SPRING1": 1, "DASHPOT1": 1, "SPRING2": 2, "DASHPOT2": 2, "SPRINGA": 2,
          "DASHPOTA": 2, "GAPUNI": 2}
# Those of second order: the element of their corners, all their nodes, and where the corners are among them.
SECOND = {**dict.fromkeys(("C3D20", "C3D20R", "C3D20H", "C3D20RH"), ("hex8", 20, 8)),
          **dict.fromkeys(("C3D10", "C3D10M", "C3D10H", "C3D10MH", "C3D10HS", "C3D10T"), ("tet4", 10, 4)),
          **dict.fromkeys(("C3D15", "C3D15H"), ("wedge6", 15, 6)),
          **dict.fromkeys(("S8", "S8R", "S8R5"), ("shell", 8, 4)), **dict.fromkeys(("S6", "STRI65"), ("shell", 6, 3)),
          **dict.fromkeys(("B32", "B32R", "B32H"), ("beam", 3, (0, 2))), "T3D3": (BAR, 3, (0, 2))}
# Nodes of elements that are counted and lost, so that their data are not taken for more elements.
LOST = {"C3D8H": 8, "C3D8RH": 8, "B31OS": 2, "B31H": 2,
        "M3D4": 4, "M3D4R": 4, "M3D3": 3, "SC8R": 8, "SC6R": 6, "CONN3D2": 2, "CPS4": 4, "CPE4": 4,
        "CPS3": 3, "CAX4": 4, "R3D4": 4, "R3D3": 3, "SFM3D4": 4, "C3D5": 5}
FACES = {8: ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
         6: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
         4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))}
# Reason to pass over cards -> their names.
NOTED = {
    "titles and output": names_of("""
    HEADING, PREPRINT, RESTART, OUTPUT, NODE OUTPUT, ELEMENT OUTPUT, CONTACT OUTPUT, ENERGY OUTPUT, NODE PRINT,
    EL PRINT, NODE FILE, EL FILE, ENERGY PRINT, ENERGY FILE, CONTACT PRINT, CONTACT FILE, SECTION PRINT, MODAL OUTPUT,
    MODAL FILE, MONITOR, FILE FORMAT, TIME POINTS, DIAGNOSTICS, PRINT, SURFACE OUTPUT, INTEGRATED OUTPUT, FILTER
    """),
    "loads and steps are not part of the model": names_of("""
    STEP, END STEP, STATIC, DYNAMIC, FREQUENCY, COMPLEX FREQUENCY, BUCKLE, MODAL DYNAMIC, VISCO, STEADY STATE DYNAMICS,
    RESPONSE SPECTRUM, RANDOM RESPONSE, CONTROLS, AMPLITUDE, CLOAD, DLOAD, DSLOAD, DSFLUX, BASE MOTION, TEMPERATURE,
    FIELD, INITIAL CONDITIONS, SELECT EIGENMODES, MODAL DAMPING, GLOBAL DAMPING, PHYSICAL CONSTANTS, BULK VISCOSITY,
    FIXED MASS SCALING, VARIABLE MASS SCALING, SOLVER CONTROLS, SPECTRUM, PSD-DEFINITION, CORRELATION, LOAD CASE,
    END LOAD CASE, NO ANALYSIS
    """),
    "says nothing of stiffness, mass or supports here": names_of("""
    EXPANSION, CONDUCTIVITY, SPECIFIC HEAT, LATENT HEAT, FRICTION, SURFACE INTERACTION, SURFACE BEHAVIOR,
    CONTACT DAMPING, CONTACT CONTROLS, CONTACT INITIALIZATION DATA, CONTACT FORMULATION, ORIENTATION, TRANSFORM,
    SECTION CONTROLS, HOURGLASS STIFFNESS, FAIL STRESS, FAIL STRAIN
    """)}


@dataclass(slots=True)
class Raw:
    """An element as the deck has it; `element` is what was made of it, if anything."""

    type: str
    number: int
    nodes: tuple
    place: str
    element: Element | None = None
    at: int = -1


class Reader(Reading):
    """The whole deck. `model` is the result."""

    def __init__(self, path: Path):
        super().__init__(Model(path.stem))
        self.parts: dict = {}
        self.deck = Scope()
        self.blocks = self._flatten(blocks_of(path))
        self.material: str | None = None
        self.axes: dict = {}  # node -> local axes of *TRANSFORM
        self.orientations: dict = {}
        self.largest = 0  # number of a node
        self.valued: set = set()  # masses and springs that have a value
        self.repeated: list = []  # materials of the same name
        self.sections = SectionReader(self)
        self.joints = JointReader(self)
        self.handlers = {"MATERIAL": self._name_material, "ELASTIC": self._elastic, "DENSITY": self._density,
                         "DAMPING": self._damping, "SOLID SECTION": self.sections.solid,
                         "SHELL SECTION": self.sections.shell, "BEAM SECTION": self.sections.beam,
                         "BEAM GENERAL SECTION": self.sections.general, "NONSTRUCTURAL MASS": self.sections.added_mass,
                         "SPRING": self._spring, "DASHPOT": self._spring, "GAP": self._gap, "MASS": self._mass,
                         "ROTARY INERTIA": self._mass, **self.joints.handlers}
        for wanted in (("NODE",), ("ELEMENT",), ("NSET", "ELSET"), ("SURFACE",), ("TRANSFORM", "ORIENTATION")):
            for block, scope, motion in self.blocks:
                if block.keyword in wanted:
                    getattr(self, f"_read_{block.keyword.lower()}")(block, scope, motion)
        self.taken: set = set()  # followers that another block has read
        for block, scope, motion in self.blocks:
            if id(block) not in self.taken:
                self._handle(block, scope, motion)
        self.joints.finish()
        self._check_points()
        for first, second in self.repeated:
            if replace(first, place="") != replace(second, place=""):
                raise InputFault(f"{second.place}: this material is there already, at {first.place}, and is another one")

    # What became of a block.

    def lose_block(self, block: Block, why: str) -> bool:
        return self.lose(block.keyword, why, block.place)

    def followers(self, block: Block) -> list:
        """The blocks right behind this one that belong to it."""
        places = [at for at, (one, _, _) in enumerate(self.blocks) if one is block]
        found = []
        for one, _, _ in self.blocks[places[-1] + 1:]:
            if one.keyword not in ("TRANSVERSE SHEAR STIFFNESS", "CENTROID", "SHEAR CENTER", "KINEMATIC",
                                   "DISTRIBUTING"):
                break
            found.append(one)
            self.taken.add(id(one))
        return found

    def _handle(self, block: Block, scope: Scope, motion: Motion) -> None:
        keyword = block.keyword
        for parameter in block.strangers():
            self.lose(f"{keyword} {parameter}", "this parameter is not known", block.place)
        if keyword in self.handlers:
            if self.handlers[keyword](block, scope, motion) is not False:
                self.use(keyword)
        elif keyword in ("NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "PART", "END PART", "ASSEMBLY", "END ASSEMBLY",
                         "INSTANCE", "END INSTANCE", "INCLUDE", "PARAMETER"):
            if keyword != "ELEMENT":
                self.use(keyword)
        else:
            self.pass_over(keyword, block.place, NOTED)

    def _check_points(self) -> None:
        """Masses and springs that no block gives a value."""
        for block, scope, _ in self.blocks:
            if block.keyword == "ELEMENT" and block.name("TYPE") in POINTS:
                for raw in scope.elements.values():
                    if raw.type in POINTS and id(raw) not in self.valued:
                        self.valued.add(id(raw))
                        self.lose(f"ELEMENT TYPE={raw.type}", "it has no value", raw.place)

    # Parts and instances.

    def _flatten(self, blocks: list) -> list:
        """Blocks with their scope and motion; those of a part once for each of its instances."""
        flat, part, scope, motion = [], None, self.deck, Motion()
        for block in blocks:
            if block.keyword == "PART":
                if not self.new("part", block.name("NAME"), block.place, block.place):
                    raise InputFault(f"{block.place}: part {block.name('NAME')} is there already")
                part = self.parts[block.name("NAME")] = []
            elif block.keyword == "END PART":
                part = None
            elif part is not None:
                part.append(block)
                continue
            elif block.keyword == "INSTANCE":
                self.new("instance", block.name("NAME"), block.place, block.place)
                scope, motion = Scope(block.name("NAME"), self.deck), motion_of(block)
                self.deck.inner[scope.name] = scope
                name = block.name("PART")
                if name not in self.parts:
                    raise InputFault(f"{block.place}: part {name} is not in the deck")
                flat += [(one, scope, motion) for one in self.parts[name]]
            flat.append((block, scope, motion))
            if block.keyword == "END INSTANCE":
                scope, motion = self.deck, Motion()
        return flat

    # Nodes, elements, sets.

    def _read_node(self, block: Block, scope: Scope, motion: Motion) -> None:
        if block.name("SYSTEM", "R") != "R":
            raise InputFault(f"{block.place}: *NODE, SYSTEM={block.name('SYSTEM')} is not known; give rectangular "
                             "coordinates")
        members = []
        for place, fields in block.data:
            own = whole(fields[0], place)
            x = (numbers(fields[1:4], place) + [0.0] * 3)[:3]
            if not self.new("node", scope.full(own), x, place):
                members.append(scope.nodes[own])
                continue
            number = own if own > 0 and own not in self.model.nodes else self.largest + 1
            self.largest = max(self.largest, number)
            self.model.nodes[number] = motion.place(x)
            scope.nodes[own] = number
            members.append(number)
        if "NSET" in block.parameters:
            self._store(scope, "node_sets", block.name("NSET"), members)

    def _read_element(self, block: Block, scope: Scope, _motion: Motion) -> None:
        kind = block.name("TYPE")
        shape = ELEMENTS.get(kind) or SECOND.get(kind)
        width = shape[1] if shape else POINTS.get(kind) or LOST.get(kind)
        rows, open_row = [], None
        for place, fields in block.data:
            values = [text for text in fields if text]
            if open_row is not None:
                rows[-1][1].extend(values)
            else:
                rows.append((place, list(values)))
            more = len(fields) > 1 and not fields[-1]
            short = width is None or len(rows[-1][1]) < width + 1
            open_row = rows[-1] if more and short else None
        members, surplus = [], []
        for place, values in rows:
            if not self.new("element", scope.full(values[0]), (kind, values), place):
                members.append(scope.elements[whole(values[0], place)])
                continue
            ids = [whole(text, place) if not at or is_whole_number(text) else text.upper() for at, text in enumerate(values)]
            if shape and shape[0] in BEAMS and len(ids) == width + 2:
                towards = self.node(ids.pop(), scope, place)
            else:
                towards = None
            if width and len(ids) > width + 1:
                surplus.append(place)
                del ids[width + 1:]
            if width and len(ids) != width + 1:
                raise InputFault(f"{place}: element {values[0]} of type {kind} has {len(ids) - 1} nodes in place of "
                                 f"{width}")
            raw = Raw(kind, ids[0], tuple(self.node(one, scope, place) for one in ids[1:]) if width else (), place)
            members.append(raw)
            scope.elements[raw.number] = raw
            if shape:
                own = raw.nodes if kind in ELEMENTS else by_corners(self.model, f"ELEMENT TYPE={kind}", shape[0],
                                                                    raw.nodes, shape[2], place)
                raw.element = Element(shape[0], raw.number, own, None, place=place)
                if towards is not None:
                    raw.element.z_axis = difference(self.model.nodes[towards], self.model.nodes[raw.nodes[0]])
                raw.at = len(self.model.elements)
                self.model.elements.append(raw.element)
            elif kind not in POINTS:
                self.lose(f"ELEMENT TYPE={kind}", "this type is not known", place)
        if surplus:
            self.model.said.append(f"{surplus[0]}: more numbers than the {width} nodes of {kind}, in {len(surplus)} lines; "
                                   "the first ones are taken")
        if kind in ELEMENTS or kind in POINTS:
            self.use(f"ELEMENT TYPE={kind}", len(rows))
        if "ELSET" in block.parameters:
            self._store(scope, "element_sets", block.name("ELSET"), members)

    def _store(self, scope: Scope, table: str, name: str, members: list) -> None:
        held = getattr(scope, table).setdefault(name, [])
        known = {id(one) if isinstance(one, Raw) else one for one in held}
        for one in members:  # each once: a set may have itself, or another, many times
            key = id(one) if isinstance(one, Raw) else one
            if key not in known:
                known.add(key)
                held.append(one)
        full = f"{scope.name}.{name}" if scope.name and len(self.deck.inner) > 1 else name
        if table == "node_sets":
            self.model.node_sets[full] = held
        else:
            self.model.element_sets[full] = sorted({raw.at for raw in held if raw.at >= 0})

    def _read_set(self, block: Block, scope: Scope, table: str, key: str, one) -> None:
        inner = self.deck.inner.get(block.name("INSTANCE", "")) or scope
        members: list = []
        for place, fields in block.data:
            if "GENERATE" in block.parameters:
                given = [whole(text, place) for text in fields if text]
                if len(given) < 2:
                    raise InputFault(f"{place}: GENERATE has a first and a last number")
                first, last, step = (given + [1])[:3]
                span = whole_range(first, last, step, place)
                wanted = getattr(inner, "nodes" if table == "node_sets" else "elements")
                members += [wanted[n] for n in (span if len(span) < len(wanted) else sorted(wanted))
                            if n in wanted and n in span]
                continue
            for text in fields:
                if not text:
                    continue
                found = self._named(table, text.upper(), inner)
                if found is None and table == "node_sets" and is_whole_number(text) and inner.find("nodes", int(text)) is None:
                    self.model.said.append(f"{place}: node {text} of set {block.name(key)} is not in the deck")
                else:
                    members += list(found) if found is not None else [one(text, inner, place)]
        self._store(scope, table, block.name(key), members)

    def _read_nset(self, block: Block, scope: Scope, _motion: Motion) -> None:
        if "ELSET" in block.parameters:
            members = sorted({node for raw in self.elements_of(block.name("ELSET"), scope,
                                                               block.place) for node in raw.nodes})
            self._store(scope, "node_sets", block.name("NSET"), members)
        else:
            self._read_set(block, scope, "node_sets", "NSET", self.node)

    def _read_elset(self, block: Block, scope: Scope, _motion: Motion) -> None:
        self._read_set(block, scope, "element_sets", "ELSET", self._element)

    def _find(self, table: str, key, scope: Scope):
        """What a scope has of a table, else the deck; None where neither has."""
        found = scope.find(table, key)
        return found if found is not None else self.deck.find(table, key)

    def _named(self, table: str, name: str, scope: Scope):
        """A set or surface by its name; numbers are those of nodes and elements."""
        return None if is_whole_number(name) else self._find(table, name, scope)

    def node(self, text, scope: Scope, place: str) -> int:
        """Number in the model of a node by its number, or INSTANCE.number. Throws InputFault."""
        found = self._find("nodes", int(text) if is_whole_number(str(text)) else str(text).upper(), scope)
        if found is None:
            raise InputFault(f"{place}: node {text} is not in the deck")
        return found

    def _element(self, text, scope: Scope, place: str) -> Raw:
        found = scope.find("elements", int(text) if is_whole_number(str(text)) else str(text).upper())
        if found is None:
            raise InputFault(f"{place}: element or set {text} is not in the deck")
        return found

    def nodes_of(self, text: str, scope: Scope, place: str) -> list:
        """Nodes of a set, or the one of that number."""
        name = str(text).strip('"').upper()
        found = self._named("node_sets", name, scope)
        if found is not None:
            return found
        if is_whole_number(name) or is_whole_number(name.rpartition(".")[2]):
            return [self.node(name, scope, place)]
        raise InputFault(f"{place}: node set {text} is not in the deck")

    def elements_of(self, text: str, scope: Scope, place: str) -> list:
        name = str(text).strip('"').upper()
        found = self._named("element_sets", name, scope)
        if found is not None:
            return found
        if is_whole_number(name):
            return [self._element(name, scope, place)]
        raise InputFault(f"{place}: element set {text} is not in the deck")

    def _read_surface(self, block: Block, scope: Scope, _motion: Motion) -> None:
        name, facets, nodes = block.name("NAME"), [], []
        if not self.new("surface", scope.full(name), [fields for _, fields in block.data], block.place):
            return
        for place, fields in block.data:
            if not fields or not fields[0]:
                continue
            if block.name("TYPE", "ELEMENT") == "NODE":
                nodes += self.nodes_of(fields[0], scope, place)
                continue
            face = fields[1].upper() if len(fields) > 1 else ""
            for raw in self.elements_of(fields[0], scope, place):
                if raw.element is None:
                    continue
                own = raw.element.nodes
                if raw.element.kind == "shell":
                    facets.append(own)
                elif len(own) in FACES and face[:1] == "S" and is_whole_number(face[1:]) and 1 <= int(face[1:]) <= len(
                        FACES[len(own)]):
                    facets.append(tuple(own[k] for k in FACES[len(own)][int(face[1:]) - 1]))
                else:
                    raise InputFault(f"{place}: a surface of '{fields[0]}' needs the faces of its elements, as in S1")
        scope.surfaces[name] = nodes or sorted({node for facet in facets for node in facet})
        full = f"{scope.name}.{name}" if scope.name and len(self.deck.inner) > 1 else name
        if facets:
            self.model.facet_sets[full] = facets
        elif nodes:
            self.model.node_sets.setdefault(full, nodes)

    def surface_nodes(self, name: str, scope: Scope, place: str) -> list:
        found = self._find("surfaces", name, scope)
        return found if found is not None else self.nodes_of(name, scope, place)

    # Local axes.

    def _read_transform(self, block: Block, scope: Scope, motion: Motion) -> None:
        place, fields = block.data[0] if block.data else (block.place, [])
        values = numbers(fields, place)
        if len(values) < 6:
            raise InputFault(f"{place}: *TRANSFORM has two points")
        a, b, kind = motion.turn(values[:3]), motion.turn(values[3:6]), block.name("TYPE", "R")
        for node in self.nodes_of(block.name("NSET"), scope, block.place):
            if kind == "R":
                x, z = unit(a), unit(cross(a, b))
            else:
                a, b = motion.place(values[:3]), motion.place(values[3:6])
                z, way = unit(difference(b, a)), difference(self.model.nodes[node], a)
                x = unit(cross(cross(z, way), z)) if z and kind == "C" else None
            if x is None or z is None:
                raise InputFault(f"{place}: no axes for node {node} in *TRANSFORM, TYPE={kind}")
            self.new("*TRANSFORM of node", node, (x, z), place)
            self.axes[node] = (x, cross(z, x), z)

    def _read_orientation(self, block: Block, scope: Scope, motion: Motion) -> None:
        place, fields = block.data[0] if block.data else (block.place, [])
        values = (numbers(fields, place) + [0.0] * 6)[:6]
        self.new("orientation", scope.full(block.name("NAME")), values, place)
        x, z = unit(motion.turn(values[:3])), unit(cross(motion.turn(values[:3]), motion.turn(values[3:6])))
        plain = x and z and block.name("SYSTEM", "RECTANGULAR") == "RECTANGULAR" and len(block.data) < 2
        self.orientations[block.name("NAME")] = (x, cross(z, x), z) if plain else None

    # Materials.

    def _name_material(self, block: Block, _scope, _motion) -> None:
        self.material = block.name("NAME")
        first = self.model.materials.get(self.material)
        self.model.materials[self.material] = Material(0.0, 0.0, 0.0, place=block.place)
        if first:
            self.repeated.append((first, self.model.materials[self.material]))

    def _property(self, block: Block) -> tuple:
        if self.material is None or not block.data:
            raise InputFault(f"{block.place}: *{block.keyword} outside a material, or without numbers")
        if len(block.data) > 1:
            self.model.said.append(f"{block.place}: *{block.keyword} has {len(block.data)} lines; the first one is "
                                   "taken")
        material, values = self.model.materials[self.material], numbers(block.data[0][1], block.data[0][0])
        self.new(f"*{block.keyword} of material", f"{self.material} ({material.place})", values, block.place)
        return material, values

    def _elastic(self, block: Block, _scope, _motion) -> bool | None:
        if block.name("TYPE", "ISOTROPIC") not in ("ISO", "ISOTROPIC"):
            return self.lose_block(block, "materials are isotropic")
        material, values = self._property(block)
        material.young, material.poisson = (values + [0.0])[:2]

    def _density(self, block: Block, _scope, _motion) -> None:
        material, values = self._property(block)
        material.density = values[0]

    def _damping(self, block: Block, _scope, _motion) -> bool | None:
        if self.material is None or set(block.parameters) - {"ALPHA", "BETA"}:
            return self.lose_block(block, "damping is alpha M + beta K of a material")
        material = self.model.materials[self.material]
        material.alpha, material.beta = block.number("ALPHA", 0.0), block.number("BETA", 0.0)

    # Points and springs.

    def _point_elements(self, block: Block, scope: Scope, begin: str) -> list:
        """Elements of a block's set, which have to be points or springs whose types begin so. They have a value then."""
        raws = self.elements_of(block.name("ELSET"), scope, block.place)
        for raw in raws:
            if raw.type not in POINTS or not raw.type.startswith(begin):
                raise InputFault(f"{block.place}: *{block.keyword} of element {raw.number}, which is a {raw.type}")
        self.valued |= {id(raw) for raw in raws}
        return raws

    def _mass(self, block: Block, scope: Scope, _motion) -> bool | None:
        wanted = "MASS" if block.keyword == "MASS" else "ROTARYI"
        if not block.data:
            raise InputFault(f"{block.place}: *{block.keyword} has no value")
        values = (numbers(block.data[0][1], block.data[0][0]) + [0.0] * 6)[:6]
        if "ORIENTATION" in block.parameters or (wanted == "ROTARYI" and any(values[3:])) or (
                wanted == "MASS" and block.parameters.get("TYPE", "ISOTROPIC").upper() != "ISOTROPIC"):
            self.valued |= {id(raw) for raw in self.elements_of(block.name("ELSET"), scope, block.place)}
            return self.lose_block(block, "masses are the same along all axes, inertias about the global ones")
        name = block.name("ELSET")
        for raw in self._point_elements(block, scope, wanted):
            if not self.new(f"*{block.keyword} of element", scope.full(raw.number), values, block.place):
                continue
            mass = PointMass(raw.nodes[0], values[0], name=name, place=raw.place) if wanted == "MASS" else PointMass(
                raw.nodes[0], 0.0, tuple(values[:3]), name=name, place=raw.place)
            self.model.masses.append(mass)

    def _spring(self, block: Block, scope: Scope, _motion) -> bool | None:
        """*SPRING and *DASHPOT: a line of components, which SPRINGA leaves empty, and one of the value."""
        name, family = block.name("ELSET"), block.keyword
        raws = self.elements_of(name, scope, block.place)
        self.valued |= {id(raw) for raw in raws}
        axes = None
        if "ORIENTATION" in block.parameters:
            axes = self.orientations.get(block.name("ORIENTATION"))
            if axes is None or permutation(axes) is None:
                return self.lose_block(block, "springs act along and about the global axes")
        if "NONLINEAR" in block.parameters or len(block.data) > 2 or any(any(fields[1:]) for _,
                                                                         fields in block.data[1:]):
            return self.lose_block(block, "springs and dashpots are linear")
        along_line = all(raw.type.endswith("A") for raw in raws)  # their first line is empty
        if not block.data or (len(block.data) < 2 and not along_line):
            raise InputFault(f"{block.place}: *{family} has a line of components and one of the value")
        (where, dofs), (place, fields) = block.data[0], block.data[-1]
        value = numbers(fields[:1], place)[0]
        both = (value, 0.0) if family == "SPRING" else (0.0, value)
        for raw in self._point_elements(block, scope, family):
            if not self.new(f"*{family} of element", scope.full(raw.number), (dofs, value), block.place):
                continue
            if raw.type.endswith("A"):
                self.model.axial_springs.append(AxialSpring(raw.nodes, *both, name, raw.place))
                continue
            along = [whole(text, where) for text in dofs if text]
            if not along or not all(1 <= dof <= 6 for dof in along):
                raise InputFault(f"{where}: components of a spring are from 1 to 6")
            if any(self.axes.get(node) and permutation(self.axes[node]) != (0, 1, 2) for node in raw.nodes):
                return self.lose_block(block, "springs act along and about the global axes")
            if len(raw.nodes) == 2 and len(set(along)) != 1:
                return self.lose_block(block, "springs join the same component of two nodes")
            dof = along[0] - 1
            dof = permutation(axes)[dof % 3] + dof // 3 * 3 if axes else dof
            self.model.add_spring(raw.nodes, dof, *both, name, raw.place)

    def _gap(self, block: Block, scope: Scope, _motion) -> None:
        """Clearance, direction from the first node to the second, and behind an area CalculiX's stiffness."""
        if not block.data:
            raise InputFault(f"{block.place}: *GAP has no clearance")
        place, fields = block.data[0]
        values = numbers(fields, place) + [0.0] * 6
        for raw in self._point_elements(block, scope, "GAPUNI"):
            if self.new("*GAP of element", scope.full(raw.number), values, block.place):
                way = unit(values[1:4]) or axis_between([self.model.nodes[node] for node in raw.nodes], raw.place)
                self.model.gaps.append(Gap(raw.nodes, way, values[0], values[5], block.name("ELSET"), raw.place))


def read(path: Path) -> Model:
    """The model of a deck. Throws InputFault."""
    return Reader(path).model
