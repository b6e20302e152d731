"""The writer: a neutral model in SI as a scene and a mesh, whatever it was read from."""

from .geometry import difference, dot, length, scaled, sum_of, unit
from .joints import Joints, turning_nodes
from .mesh_file import MeshFile, Names, plain
from .model import ALL, BAR, BEAMS, COMPONENTS, ROTATIONS, SHELL, SOLIDS, TRANSLATIONS, AxialSpring, InputFault, Material, Model
from .sections import own_name

# First words of the options of a structure: no group has their names.
WORDS = ("absorbing", "allow", "clamp", "damping", "diaphragm", "gravity", "ignore", "initial", "join", "levels",
         "mass", "matrices", "mesh", "modal", "model", "p", "pin", "rigid", "soil", "stiffness", "target", "tie",
         "time", "none", "ungrouped")
HEADS = ("title", "structures", "include", "contacts", "end_time", "output")  # of the scene
SPRING_YOUNG, SPRING_DENSITY = 1e11, 1e-9  # of bars that stand for springs aslant: their mass is nothing


def numbers(values) -> str:
    return ",".join(f"{value + 0.0:.15g}" for value in values)


def axis_of(vector) -> tuple:
    """A direction without its sign, to ten digits."""
    direction = [round(value, 10) + 0.0 for value in unit(vector)]
    first = next(value for value in direction if value)
    return tuple(direction if first > 0 else [0.0 - value for value in direction])


class Scene:
    """What is written: `options` of the structure, materials and sections as dictionaries, `mesh`, and the model
    with the nodes that were added. Throws InputFault."""

    def __init__(self, model: Model, structure: str):
        self.model, self.structure = model, structure
        self.names, self.material_names, self.section_names = Names(WORDS), Names(()), Names(())
        self.options: dict = {}
        self.contacts: dict = {}
        self.materials: dict = {}
        self.sections: dict = {}
        self.written: dict = {}  # material of the model -> name in the scene
        self.mesh = MeshFile()
        self.massless: set = set()  # materials of beams and bars that have no density
        self.heavy = any(mass.mass > 0 for mass in model.masses) or any(one.added for one in model.properties.values())
        self.regions: dict = {}  # name of a region -> places of its elements
        self._check()
        self._touching()
        self.joints = Joints(model)
        self.turning = self._turning()
        if model.has_properties:
            self._elements()
        else:  # cells and groups alone
            for element in model.elements:
                self.mesh.add(family_of(element.kind), element.nodes, None, element.number)
        self._masses()
        self._springs()
        self._sets()
        self._motions()
        self._supports()
        self._gaps()
        if not self.mesh.cells:
            raise InputFault("no element is left")

    def _check(self) -> None:
        for element in self.model.elements:
            for node in element.nodes:
                self.model.at(node, element.place)
            if self.model.has_properties and element.property not in self.model.properties:
                raise InputFault(f"{element.place}: element {element.number} has no section or property")
        for part in (*self.model.masses, *self.model.springs, *self.model.axial_springs, *self.model.gaps):
            for node in [part.node] if hasattr(part, "node") else part.nodes:
                if node is not None:
                    self.model.at(node, part.place)

    def _touching(self) -> None:
        """Gaps that are closed from the start become bars that act one way, which weight may press; to the ground over 1 m."""
        for gap in list(self.model.gaps):
            nodes = gap.nodes
            if nodes[1] is None:
                nodes = nodes[0], max(self.model.nodes) + 1
                places = [self.model.nodes[nodes[0]], sum_of(self.model.nodes[nodes[0]], gap.way)]
            else:
                places = [self.model.nodes[node] for node in nodes]
            line = unit(difference(places[1], places[0]))
            if gap.gap != 0 or not gap.stiffness > 0 or line is None or abs(abs(dot(line, gap.way)) - 1) > 1e-9:
                continue
            if nodes[1] not in self.model.nodes:
                self.model.nodes[nodes[1]] = places[1]
                self.model.hold(nodes[1], TRANSLATIONS)
            only = "compression_only" if dot(line, gap.way) > 0 else "tension_only"
            self.model.axial_springs.append(AxialSpring(nodes, gap.stiffness, name=gap.name, place=gap.place, only=only))
            self.model.gaps.remove(gap)

    def _turning(self) -> set:
        """Nodes with rotations."""
        turning = turning_nodes(self.model)
        turning |= {mass.node for mass in self.model.masses if any(mass.inertia)}
        for spring in self.model.springs:
            if any(spring.stiffness[3:]) or any(spring.dashpot[3:]):
                turning |= set(spring.nodes)
        return turning

    # Elements.

    def _elements(self) -> None:
        kinds: dict = {}
        for element in self.model.elements:
            kinds.setdefault(element.property, set()).add(element.kind)
        parts: dict = {}
        for at, element in enumerate(self.model.elements):
            kind = element.kind
            if kind == "wedge6":  # a region of bricks takes them
                kind = next((one for one in ("hex8", "hex8_full") if one in kinds[element.property]), kind)
            axis = axis_of(element.z_axis) if kind in BEAMS and element.z_axis else None
            parts.setdefault(element.property, {}).setdefault((kind, element.added, axis), []).append(at)
        for key, regions in parts.items():
            one = self.model.properties[key]
            for (kind, added, axis), places in regions.items():
                name = self.names.free(one.name)
                self.options[name] = self._region(name, one, kind, added, axis, self.model.elements[places[0]])
                self.regions[name] = places
        for name, places in self.regions.items():
            for at in places:
                element = self.model.elements[at]
                self.mesh.add(family_of(element.kind), element.nodes, name, element.number)

    def _region(self, name, one, kind, added, axis, first) -> dict:
        region: dict = {"element": kind}
        if not self.model.has_properties:
            return region
        if one.material not in self.model.materials:
            raise InputFault(f"{one.place or first.place}: material {one.material} is not in the file")
        material = self.model.materials[one.material]
        region["material"], factor = self._material(one.material, material, kind)
        if kind in BEAMS:
            if one.section is None:
                raise InputFault(f"{first.place}: element {first.number} is a beam, and {one.name} has no "
                                 "cross-section")
            region["section"] = self._section(name, one, kind, axis, factor, first)
        elif kind == BAR:
            region["area"] = positive(one.section.area if one.section else one.area, "area", one, first)
        elif kind == SHELL:
            region["thickness"] = positive(one.thickness, "thickness", one, first)
        if one.added + added:
            if kind in SOLIDS:
                raise InputFault(f"{first.place}: non-structural mass of solids is not known")
            region["mass_per_area" if kind == SHELL else "mass_per_length"] = one.added + added
        if material.alpha or material.beta:
            region["damping"] = {"alpha": material.alpha, "beta": material.beta}
        return region

    def _material(self, key, material: Material, kind: str) -> tuple:
        """Its name in the scene, and what its own shear modulus is over that of E and nu."""
        poisson = material.poisson
        if poisson is None:
            poisson = material.young / (2 * material.shear) - 1 if material.shear else 0.0
            poisson = poisson if -1 < poisson < 0.5 else 0.3
        factor = material.shear * 2 * (1 + poisson) / material.young if material.shear and material.young > 0 else 1.0
        if abs(factor - 1) < 1e-12:
            factor = 1.0
        if kind not in BEAMS and kind != BAR and abs(factor - 1) > 5e-3:
            self.model.cards.lose(f"G OF MATERIAL {key}", "shells and solids have G = E / (2 (1 + nu))", material.place)
        if material.density == 0 and kind in (*BEAMS, BAR) and self.heavy:
            self.massless.add(key)
        elif not material.density > 0:
            raise InputFault(f"{material.place}: material {key} has no density, and elements without mass cannot be "
                             f"stepped; say one in kg/m3 with --density {key}=2500")
        if not (material.young > 0 and -1 < poisson < 0.5):
            raise InputFault(f"{material.place}: material {key} has Young's modulus {material.young:g} Pa and "
                             f"Poisson's ratio {poisson:g}; they have to be positive, and between -1 and 0.5")
        if key not in self.written:
            self.written[key] = self.material_names.free(key)
            self.materials[self.written[key]] = {"young": material.young, "poisson": poisson,
                                                 "density": material.density}
        return self.written[key], factor

    def _section(self, name, one, kind, axis, factor, first) -> str:
        section = one.section
        if axis is None:
            raise InputFault(f"{first.place}: element {first.number} has no direction of its section")
        values = {what: positive(getattr(section, what), what, one, first)
                  for what in ("area", "inertia_y", "inertia_z", "torsion")}
        values["torsion"] *= factor
        if section.shear_y > 0 and section.shear_z > 0 and kind == "beam":
            values["shear_area"] = numbers((section.shear_y * factor, section.shear_z * factor))
        elif kind == "beam" and (section.shear_y > 0 or section.shear_z > 0):
            stiff = 1e6 * section.area  # along one axis only
            values["shear_area"] = numbers((section.shear_y * factor or stiff, section.shear_z * factor or stiff))
        values["z_axis"] = numbers(axis)
        own = self.section_names.free(own_name(name))
        self.sections[own] = values
        return own

    # Points and springs.

    def _masses(self) -> None:
        at: dict = {}
        for mass in self.model.masses:
            sums = at.setdefault(mass.node, [0.0, 0.0, 0.0, 0.0, mass.name, mass.place])
            for k, value in enumerate((mass.mass, *mass.inertia)):
                sums[k] += value
        groups: dict = {}
        for node, (mass, *inertia, name, place) in at.items():
            if mass < 0 or min(inertia) < 0:
                raise InputFault(f"{place}: a mass or inertia below zero at node {node}")
            if mass == 0 and any(inertia):
                mass = 1e-9
                self.model.said.append(f"node {node} has rotary inertia and no mass: 1e-9 kg stands for none")
            if mass > 0:
                groups.setdefault((mass, *inertia), []).append((node, name))
        for (mass, *inertia), members in groups.items():
            name = self.names.free(members[0][1])
            self.options[name] = {"element": "point_mass", "mass": mass}
            if any(inertia):
                self.options[name]["rotary_inertia"] = numbers(inertia)
            for node, _ in members:
                self.mesh.mark("point", (node,), name)

    def _springs(self) -> None:
        for spring in self.model.axial_springs:
            self._axial(spring)
        sums: dict = {}
        for spring in self.model.springs:
            key = tuple(sorted(spring.nodes))
            before = sums.setdefault(key, [(0.0,) * 6, (0.0,) * 6, spring.name, spring.place])
            before[0] = tuple(a + b for a, b in zip(before[0], spring.stiffness))
            before[1] = tuple(a + b for a, b in zip(before[1], spring.dashpot))
        groups: dict = {}
        for nodes, (stiffness, dashpot, name, place) in sums.items():
            if min(*stiffness, *dashpot) < 0:
                raise InputFault(f"{place}: a spring or dashpot below zero")
            if any(stiffness) or any(dashpot):
                groups.setdefault((len(nodes), stiffness, dashpot), []).append((nodes, name))
        for (count, stiffness, dashpot), members in groups.items():
            name = self.names.free(members[0][1])
            width = 6 if any(stiffness[3:]) or any(dashpot[3:]) else 3
            region = {"element": "spring" if count == 2 else "grounded_spring", "stiffness": numbers(stiffness[:width])}
            if any(dashpot):
                region["dashpot"] = numbers(dashpot[:width])
            self.options[name] = region
            for nodes, _ in members:
                if count == 2:
                    self.mesh.add("line", nodes, name)
                else:
                    self.mesh.mark("point", nodes, name)

    def _axial(self, spring) -> None:
        """Along a global axis a spring, aslant a bar of its stiffness and dashpot."""
        way = difference(self.model.nodes[spring.nodes[1]], self.model.nodes[spring.nodes[0]])
        size = length(way)
        if size <= self.joints.near:
            raise InputFault(f"{spring.place}: a spring along the line between two nodes that coincide")
        along = [k for k in range(3) if abs(abs(way[k]) - size) <= 1e-9 * size]
        if along and not spring.series and not spring.only:
            self.model.add_spring(spring.nodes, along[0], spring.stiffness, spring.dashpot, spring.name, spring.place)
            return
        if min(spring.stiffness, spring.dashpot) < 0:
            raise InputFault(f"{spring.place}: a spring or dashpot below zero")
        region = {"element": BAR}
        if spring.stiffness:
            region |= {"material": "springs_aslant", "area": float(f"{spring.stiffness * size / SPRING_YOUNG:.13g}")}
            self.materials["springs_aslant"] = {"young": SPRING_YOUNG, "poisson": 0, "density": SPRING_DENSITY}
        if spring.only:
            region[spring.only] = "true"
        if spring.dashpot:
            region["dashpot"] = spring.dashpot
            region |= {name: value for name, value in (("dashpot_exponent", spring.power), ("dashpot_stiffness", spring.series))
                       if value != (1.0 if name == "dashpot_exponent" else 0.0)}
        if len(region) > 1:
            name = next((one for one, own in self.options.items() if own == region), None)
            if name is None:
                name = self.names.free(spring.name)
                self.options[name] = region
            self.mesh.add("line", spring.nodes, name)

    # Groups that mark places.

    def _points(self, wanted: str, nodes) -> str | None:
        """Name of a new group of those nodes that are in use; None where none is."""
        used = sorted(set(nodes) & self.joints.used)
        if not used:
            return None
        name = self.names.free(wanted)
        for node in used:
            self.mesh.mark("point", (node,), name)
        return name

    def _sets(self) -> None:
        self.sets: dict = {}  # set of the model -> group
        for wanted, places in self.model.element_sets.items():
            if sorted(self.regions.get(plain(wanted), ())) == sorted(places):
                self.sets[wanted] = plain(wanted)
            elif places:
                self.sets[wanted] = name = self.names.free(wanted)
                for at in places:
                    element = self.model.elements[at]
                    self.mesh.mark(family_of(element.kind), element.nodes, name)
        for wanted, facets in self.model.facet_sets.items():
            self.sets[wanted] = name = self.names.free(wanted)
            for nodes in facets:
                self.mesh.mark("face" if len(nodes) > 2 else "line", nodes, name)
        self.node_groups: dict = {}  # nodes -> group
        for wanted, nodes in self.model.node_sets.items():
            name = self._points(wanted if wanted not in self.sets else f"{wanted}_nodes", nodes)
            if name:
                self.sets.setdefault(wanted, name)
                self.node_groups.setdefault(frozenset(set(nodes) & self.joints.used), name)

    def _motions(self) -> None:
        rigid = [self._points(name, nodes) for name, nodes in self.joints.rigid]
        for name, hub, nodes, components in self.joints.in_part:
            words = [self._points(f"{name}_hub", hub), self._points(name, nodes),
                     "+".join(COMPONENTS[k] for k in range(6) if components >> k & 1)]
            rigid.append(":".join(word for word in words if word))
        if rigid:
            self.options["rigid"] = ",".join(rigid)
        if self.joints.joined:
            arms = self._points("arms", self.joints.joined)
            self.options["join"] = f"{arms}:{self._points('arm_roots', self.joints.joined.values())}"
        pins = [self._points("hinges", nodes) for nodes in self.joints.pin_groups()]
        if pins:
            self.options["pin"] = ",".join(pins)
        ties = [f"{self.sets[one]}:{self.sets[other]}" for one, other in self.model.ties
                if one in self.sets and other in self.sets]
        if ties:
            self.options["tie"] = ",".join(ties)

    def _supports(self) -> None:
        self.held = {node: mask for node, mask in self.model.supports.items() if node in self.joints.used and mask}
        groups: dict = {}
        for node, mask in self.held.items():
            own = mask if node in self.turning else mask & ~ROTATIONS
            whole = own == (ALL if node in self.turning else ALL & ~ROTATIONS)
            if own:
                groups.setdefault(ALL if whole else own, []).append(node)
        clamps = []
        for mask, nodes in sorted(groups.items(), key=lambda item: -item[0]):
            words = [COMPONENTS[k] for k in range(6) if mask >> k & 1]
            name = self.node_groups.get(frozenset(nodes)) or self._points(
                "clamped" if mask == ALL else "held_" + "_".join(words), nodes)
            clamps.append(name if mask == ALL else f"{name}:{'+'.join(words)}")
        if clamps:
            self.options["clamp"] = ",".join(clamps)
        if self.model.alpha or self.model.beta:
            self.options["damping"] = {"alpha": self.model.alpha, "beta": self.model.beta}


    def _gaps(self) -> None:
        """Stops between nodes; one that nothing but its support holds is the ground."""
        names, ends = Names((self.structure, "material", "section", *HEADS)), {}
        for gap in self.model.gaps:
            nodes, way = gap.nodes, gap.way
            fixed = [node is None or node not in self.joints.used for node in nodes]
            if fixed[0]:
                nodes, way, fixed = nodes[::-1], scaled(way, -1.0), fixed[::-1]
            lone = [node for node, alone in zip(nodes, fixed) if alone and node is not None
                    and self.model.supports.get(node, 0) & TRANSLATIONS != TRANSLATIONS]
            if fixed[0] or lone or gap.gap < 0:
                raise InputFault(f"{gap.place}: " + ("a gap below zero" if gap.gap < 0 else
                                                     "a gap at a node that no element and no support has"))
            for node in nodes:
                if node not in ends and node in self.joints.used:
                    ends[node] = f"{self.structure}:{self._points('gap_end', (node,))}"
            name = names.free(gap.name)
            self.contacts[name] = {"secondary": ends[nodes[0]], "primary": "wall" if fixed[1] else ends[nodes[1]],
                                   "along": numbers(way), "gap": gap.gap}
            if gap.stiffness:
                self.contacts[name]["stiffness"] = gap.stiffness


def family_of(kind: str) -> str:
    return {SHELL: "face", "point": "point"}.get(kind, "solid" if kind in SOLIDS else "line")


def positive(value: float, what: str, one, first) -> float:
    if not value > 0:
        raise InputFault(f"{one.place or first.place}: {one.name} has {what.replace('_', ' ')} {value:g}, and it has "
                         "to be above 0")
    return value
