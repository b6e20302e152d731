"""Reads SAP2000 texts (.s2k) into the neutral model. Axis 2 of a frame there is z of the program, axis 3 its -y; the text
holds objects, of which SAP2000 makes elements: frames are cut here at the joints on them, as there by its preset."""

import math
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from .cards import is_whole_number
from .geometry import along_global_axes, axis_between, cross, difference, frame_about, length, scaled, turned_z
from .model import COMPONENTS, AxialSpring, Element, Gap, InputFault, Material, Model, PointMass, Property, Section, Spring
from .sap2000_tables import Row, tables_of

DOFS = ("U1", "U2", "U3", "R1", "R2", "R3")
MODIFIERS = ("AMod", "A2Mod", "A3Mod", "JMod", "I2Mod", "I3Mod", "MMod")
# Titles of tables, by their beginnings, in which there is no stiffness, mass or support.
NOTED = ("PROGRAM CONTROL", "PROJECT INFORMATION", "PREFERENCES", "GRID LINES", "LOAD", "CASE", "COMBINATION", "FUNCTION", "AUTO",
         "ANALYSIS OPTIONS", "MODAL", "NAMED", "TABLES", "OPTIONS", "OVERWRITES", "STEEL DESIGN", "CONCRETE DESIGN",
         "ALUMINUM DESIGN", "COLD FORMED", "COORDINATE SYSTEMS", "JOINT LOADS", "FRAME LOADS", "AREA LOADS", "JOINT PATTERN",
         "REBAR SIZES", "BRIDGE", "GROUPS 1", "GROUPS 3", "FRAME DESIGN", "FRAME OUTPUT STATION", "MATERIAL PROPERTIES 01",
         "MATERIAL PROPERTIES 03", "MATERIAL PROPERTIES 04", "MATERIAL PROPERTIES 05", "FRAME SECTION PROPERTIES 02",
         "FRAME SECTION PROPERTIES 03", "AREA SECTION PROPERTY DESIGN", "JOINT LOCAL AXES ASSIGNMENTS 0", "DATABASE", "VIEW",
         "PUSHOVER", "MATERIAL PROPERTIES 06", "SECTION CUTS", "RESPONSE", "TIME HISTORY", "BUCKLING")
# Tables by their beginnings -> what a row is of: those two of which are the same thing twice.
KEYS = (("JOINT CONSTRAINT", ()), ("JOINT", ("Joint",)), ("MATERIAL", ("Material", "Temp")), ("FRAME SECTION PROPERTIES", ("SectionName",)),
        ("FRAME", ("Frame",)), ("AREA SECTION PROPERTIES", ("Section",)), ("AREA", ("Area",)), ("LINK PROPERTY DEFINITIONS", ("Link", "DOF")),
        ("LINK", ("Link",)), ("CONNECTIVITY - FRAME", ("Frame",)), ("CONNECTIVITY - AREA", ("Area",)), ("CONNECTIVITY - LINK", ("Link",)),
        ("CONSTRAINT DEFINITIONS", ("Name",)), ("ACTIVE DEGREES", ("",)))
NONLINEAR = "links are linear springs and dashpots, or dampers, gaps and hooks along their line; give their laws in the scene"


class Reader:
    """The whole text. `model` is the result."""

    def __init__(self, path: Path):
        self.model = Model(path.stem)
        self.numbers: dict = {}  # label of a joint -> number
        self.materials: dict = {}  # name -> row
        self.sections: dict = {}  # name of a frame section -> row
        self.plates: dict = {}  # name of an area section -> row
        self.frames: dict = {}  # label -> places in the model's elements
        self.areas: dict = {}
        self.of_frame: dict = {}  # table -> label -> row
        self.constraints: dict = {}  # name -> kind
        self.links: dict = {}  # property -> DOF -> row
        self.kinds: dict = {}  # property -> type of its links
        self.bodies: dict = {}  # constraint -> nodes
        self.next, self.tree = 1, None
        tables: dict = {}
        for table in tables_of(path):
            if table.name in tables:
                raise InputFault(f"{table.place}: table {table.name} is there already")
            tables[table.name] = table
        steps = {"JOINT COORDINATES": self._joint, "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES": self._material,
                 "FRAME SECTION PROPERTIES 01 - GENERAL": self._section, "AREA SECTION PROPERTIES": self._plate,
                 **{f"FRAME {name}": self._of_frame for name in (
                     "SECTION ASSIGNMENTS", "LOCAL AXES ASSIGNMENTS 1 - TYPICAL", "RELEASE ASSIGNMENTS 1 - GENERAL",
                     "PROPERTY MODIFIERS", "ADDED MASS ASSIGNMENTS", "AUTO MESH ASSIGNMENTS", "INSERTION POINT ASSIGNMENTS",
                     "OFFSET ALONG LENGTH ASSIGNMENTS", "TENSION AND COMPRESSION LIMITS")},
                 "AREA SECTION ASSIGNMENTS": self._of_frame, "AREA AUTO MESH ASSIGNMENTS": self._of_frame,
                 "LINK PROPERTY DEFINITIONS 01 - GENERAL": self._link_kind, "LINK PROPERTY DEFINITIONS 02 - LINEAR": self._link_law,
                 **dict.fromkeys((f"LINK PROPERTY DEFINITIONS {kind}" for kind in ("04 - DAMPER", "05 - GAP", "06 - HOOK")),
                                 self._link_law),
                 "LINK PROPERTY ASSIGNMENTS": self._of_frame,
                 "CONNECTIVITY - FRAME": self._frame, "CONNECTIVITY - AREA": self._area, "CONNECTIVITY - LINK": self._link,
                 "JOINT RESTRAINT ASSIGNMENTS": self._restraint, "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED": self._spring,
                 "JOINT ADDED MASS ASSIGNMENTS": self._mass, "CONSTRAINT DEFINITIONS - BODY": self._constraint,
                 "JOINT CONSTRAINT ASSIGNMENTS": self._constrained, "GROUPS 2 - ASSIGNMENTS": self._group,
                 "MASS SOURCE": self._source, "MASSES 1 - MASS SOURCE": self._source, "ACTIVE DEGREES OF FREEDOM": self._active}
        for name, handle in steps.items():
            for row in self._once(tables[name]) if name in tables else ():
                self.table = name
                handle(row)
                self.model.cards.use(name)
        for name, table in tables.items():
            if name.startswith(NOTED):
                self._noted(table)
            elif name not in steps and table.rows:
                self.model.cards.lose(name, "not known", table.place, len(table.rows))

    @staticmethod
    def _once(table) -> list:
        """Rows without those that say the same again. Throws InputFault where two say other things of the same."""
        columns = next((columns for begin, columns in KEYS if table.name.startswith(begin)), ())
        if not columns:
            return table.rows
        seen: dict = {}
        for row in table.rows:
            label = tuple(row.values.get(column, "") for column in columns)
            first = seen.setdefault(label, row)
            if first.values != row.values:
                raise InputFault(f"{row.place}: {columns[0]} {label[0]} is in {table.name} twice, in another way at {first.place}")
        return list(seen.values())

    def _noted(self, table) -> None:
        self.model.cards.note(table.name, "loads, design and output", max(1, len(table.rows)))
        if table.name == "PROGRAM CONTROL":
            units = next((row.values["CurrUnits"] for row in table.rows if "CurrUnits" in row.values), None)
            if units:
                self.model.said.append(f"the file says that its units are {units} (force, length)")
        for row in table.rows if table.name.startswith("MATERIAL PROPERTIES 01") else ():
            if row.values.get("SymType", "Isotropic") != "Isotropic":
                self.lose(row, "MATERIAL THAT IS NOT ISOTROPIC", f"material {row.values.get('Material')} has directions")

    def lose(self, row: Row, card: str, why: str) -> bool:
        return self.model.cards.lose(card, why, row.place)

    # Tables that others refer to.

    def _joint(self, row: Row) -> None:
        label = row.text("Joint")
        own = int(label) if is_whole_number(label) else 0
        if own == 0 or own in self.model.nodes:
            own = self.next
        self.next = max(self.next, own + 1)
        self.numbers[label] = own
        if "GlobalX" in row.values:
            place = tuple(row.real(name) for name in ("GlobalX", "GlobalY", "GlobalZ"))
        elif row.values.get("CoordSys", "GLOBAL").upper() != "GLOBAL":
            raise InputFault(f"{row.place}: joint {label} is given in the system {row.values['CoordSys']} alone; export its global "
                             "coordinates as well")
        elif row.values.get("CoordType", "Cartesian").lower() == "cartesian":
            place = row.real("XorR"), row.real("Y"), row.real("Z")
        else:
            turn = math.radians(row.real("T"))
            place = row.real("XorR") * math.cos(turn), row.real("XorR") * math.sin(turn), row.real("Z")
        self.model.nodes[own] = place

    def node(self, row: Row, name: str) -> int:
        """The number of a joint that a row names. Throws InputFault."""
        label = row.text(name)
        if label not in self.numbers:
            raise InputFault(f"{row.place}: joint {label} is not in the file")
        return self.numbers[label]

    def _material(self, row: Row) -> None:
        young = row.real("E1")
        shear = row.real("G12", 0.0)
        self.model.materials.setdefault(row.text("Material"), Material(
            young, row.real("U12", 0.0), row.real("UnitMass", 0.0), shear or None, place=row.place))

    def _section(self, row: Row) -> None:
        self.sections[row.text("SectionName")] = row

    def _plate(self, row: Row) -> None:
        self.plates[row.text("Section")] = row

    def _of_frame(self, row: Row) -> None:
        key = self.table.split()[0].capitalize()
        self.of_frame.setdefault(self.table, {})[row.text(key)] = row

    def own(self, table: str, label: str) -> Row | None:
        return self.of_frame.get(table, {}).get(label)

    def _material_of(self, name: str, row: Row) -> str:
        if name not in self.model.materials:
            raise InputFault(f"{row.place}: material {name} is not in the file")
        return name

    # Frames.

    def _frame(self, row: Row) -> bool | None:
        label, ends = row.text("Frame"), (self.node(row, "JointI"), self.node(row, "JointJ"))
        if row.says("IsCurved"):
            self.lose(row, "CURVED FRAME", "frames are straight")
        section = self.own("FRAME SECTION ASSIGNMENTS", label)
        if section is None:
            raise InputFault(f"{row.place}: frame {label} has no section")
        name = section.text("AnalSect")
        if name not in self.sections:
            kind = "NONPRISMATIC" if name.lower() != "none" else "NULL"
            return self.lose(section, f"FRAME SECTION THAT IS {kind}", f"section {name} is not among the prismatic ones")
        key = self._frame_property(label, name, section)
        places = [self.model.nodes[end] for end in ends]
        who = f"{row.place}: frame {label}"
        axis = axis_between(places, who)
        upright = abs(axis[2]) > 1 - 1e-6 / 2  # within .001 of the vertical axis 2 is along X
        frame = frame_about(axis, (1.0, 0.0, 0.0) if upright else (0.0, 0.0, 1.0), who)
        local = self.own("FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL", label)
        if local is not None and local.says("AdvanceAxes"):
            self.lose(local, "ADVANCED AXES", "directions of sections are by an angle")
        angle = math.radians(local.real("Angle", 0.0)) if local is not None else 0.0
        self._ends_as_they_are(label)
        hinged = self._hinges(label)
        inner = self._between(ends, label)
        path = [ends[0], *inner, ends[1]]
        self.frames[label] = []
        for at, pair in enumerate(zip(path, path[1:])):
            self.frames[label].append(len(self.model.elements))
            self.model.elements.append(Element(
                "beam", len(self.model.elements) + 1, pair, key, z_axis=turned_z(frame, angle), place=row.place,
                hinged=(hinged[0] and at == 0, hinged[1] and at == len(path) - 2)))

    def _frame_property(self, label: str, name: str, place: Row) -> str:
        """Section, its own factors and those of the frame, and added mass."""
        row, more = self.sections[name], self.own("FRAME PROPERTY MODIFIERS", label)
        area, a2, a3, torsion, i2, i3, mass = (
            row.real(key, 1.0) * (more.real(key, 1.0) if more is not None else 1.0) for key in MODIFIERS)
        added_row = self.own("FRAME ADDED MASS ASSIGNMENTS", label)
        added = added_row.real("MassPerLen") if added_row is not None else 0.0
        key = f"{name} {(area, a2, a3, torsion, i2, i3, mass, added)!r}"
        if key in self.model.properties:
            return key
        if row.real("I23", 0.0):
            self.lose(row, "I23 OF A FRAME SECTION", "a product of inertia is not known; give principal axes")
        material = self._material_of(row.text("Material"), row)
        whole = row.real("Area")
        own = Section(whole * area, row.real("I33") * i3, row.real("I22") * i2, row.real("TorsConst") * torsion,
                      row.real("AS3", 0.0) * a3, row.real("AS2", 0.0) * a2)
        rest = self.model.materials[material].density * whole * (mass - area) + added
        if rest < 0:
            self.lose(place, "MASS MODIFIER BELOW THAT OF THE AREA", "mass cannot be taken away; allowed, that of the area holds")
        self.model.properties[key] = Property(name, material, section=own, added=max(rest, 0.0), place=row.place)
        return key

    def _ends_as_they_are(self, label: str) -> None:
        row = self.own("FRAME INSERTION POINT ASSIGNMENTS", label)
        offsets = [key for key in row.values if key.startswith("JtOffset") and row.real(key)] if row is not None else []
        if row is not None and (row.values.get("CardinalPt", "10").split()[0] not in ("10", "11") or offsets):
            self.lose(row, "INSERTION POINT OFF THE CENTROID", "frames go from joint to joint through their centroids")
        row = self.own("FRAME OFFSET ALONG LENGTH ASSIGNMENTS", label)
        if row is not None and row.real("RigidFact", 0.0) and (row.real("LengthI", 0.0) or row.real("LengthJ", 0.0)):
            self.lose(row, "RIGID ENDS OF FRAMES", "ends of frames that are stiff are not known; allowed, they bend")
        row = self.own("FRAME TENSION AND COMPRESSION LIMITS", label)
        if row is not None and (row.says("TensLimit") or row.says("CompLimit")):
            self.lose(row, "TENSION AND COMPRESSION LIMITS", "frames are linear; give a bar with tension_only in the scene")

    def _hinges(self, label: str) -> tuple:
        row = self.own("FRAME RELEASE ASSIGNMENTS 1 - GENERAL", label)
        if row is None:
            return False, False
        found = []
        for end in "IJ":
            free = {name for name in ("P", "V2", "V3", "T", "M2", "M3") if row.says(name + end)}
            bends = free & {"M2", "M3"}
            if free - {"M2", "M3", "T"} or len(bends) == 1:
                self.lose(row, "PARTIAL RELEASE", "a hinge lets all rotations go; allowed, it does here, where it has one of them")
            found.append(bool(bends))
        return tuple(found)

    def _between(self, ends, label: str) -> list:
        """Joints on a frame, in their order, at which it is cut unless it is told not to be."""
        row = self.own("FRAME AUTO MESH ASSIGNMENTS", label)
        if row is not None and not (row.says("AutoMesh") and row.says("AtJoints")):
            return []
        if self.tree is None:
            self.order = np.array(list(self.model.nodes))
            self.places = np.array(list(self.model.nodes.values()), dtype=float)
            self.tree = cKDTree(self.places)
        first, last = (np.array(self.model.nodes[end]) for end in ends)
        way = last - first
        size = float(np.linalg.norm(way))
        near = np.array(self.tree.query_ball_point((first + last) / 2, size / 2 * (1 + 1e-6)), dtype=int)
        off = self.places[near] - first
        share = off @ way / size**2
        on = (share > 1e-9) & (share < 1 - 1e-9) & (np.linalg.norm(off - share[:, None] * way, axis=1) < 1e-6 * size)
        return [node for _, node in sorted(zip(share[on].tolist(), self.order[near[on]].tolist())) if node not in ends]

    # Areas.

    def _area(self, row: Row) -> bool | None:
        label = row.text("Area")
        nodes = [self.node(row, f"Joint{k}") for k in range(1, int(row.real("NumJoints")) + 1)]
        if len(nodes) not in (3, 4):
            return self.lose(row, "AREA OF MORE THAN FOUR JOINTS", "shells have three or four nodes; divide it in the model")
        assigned = self.own("AREA SECTION ASSIGNMENTS", label)
        if assigned is None:
            raise InputFault(f"{row.place}: area {label} has no section")
        name = assigned.text("Section")
        if name not in self.plates:
            return self.lose(assigned, "AREA WITHOUT A SHELL SECTION", f"section {name} is not among the area sections")
        mesh = self.own("AREA AUTO MESH ASSIGNMENTS", label)
        if mesh is not None and mesh.values.get("MeshType", "None") != "None":
            self.lose(mesh, "AREA THAT THE ANALYSIS DIVIDES", "divide areas in the model; allowed, each is one shell")
        plate = self.plates[name]
        if not plate.values.get("Type", "Shell-Thin").startswith("Shell"):
            return self.lose(plate, f"AREA SECTION OF TYPE {plate.values['Type'].upper()}", "areas are shells")
        thickness = plate.real("Thickness")
        if plate.real("BendThick", thickness) != thickness:
            self.lose(plate, "THICKNESS IN BENDING", "a shell has one thickness; allowed, that of its plane holds")
        if any(key.endswith("Mod") and plate.real(key) != 1 for key in plate.values):
            self.lose(plate, "AREA MODIFIERS", "stiffness and mass of areas are those of thickness and material")
        material = self._material_of(plate.text("Material"), plate)
        self.model.properties.setdefault(f"area {name}", Property(name, material, thickness=thickness, place=plate.place))
        self.areas[label] = [len(self.model.elements)]
        self.model.elements.append(Element("shell", len(self.model.elements) + 1, tuple(nodes), f"area {name}", place=row.place))

    # Links.

    def _link_kind(self, row: Row) -> None:
        if not row.values.get("LinkType", "Linear").startswith(("Linear", "Damper", "Gap", "Hook")):
            self.lose(row, "NONLINEAR LINK", NONLINEAR)
        self.kinds[row.text("Link")] = row.values.get("LinkType", "Linear")
        if row.real("Mass", 0.0) or any(row.real(f"RotInert{k}", 0.0) for k in (1, 2, 3)):
            self.lose(row, "MASS OF A LINK", "links have no mass; give it to joints")

    def _link_law(self, row: Row) -> None:
        self.links.setdefault(row.text("Link"), {})[row.text("DOF")] = row

    def _link(self, row: Row) -> bool | None:
        label = row.text("Link")
        assigned = self.own("LINK PROPERTY ASSIGNMENTS", label)
        if assigned is None:
            raise InputFault(f"{row.place}: link {label} has no property")
        laws = self.links.get(assigned.text("LinkProp"), {})
        if any(one.says("Fixed") for one in laws.values()):
            return self.lose(row, "FIXED COMPONENT OF A LINK", "links are springs and dashpots; use a body constraint")
        stiffness, dashpot = (tuple(laws[dof].real(f"{'Trans' if dof[0] == 'U' else 'Rot'}{key}", 0.0) if dof in laws else 0.0
                                    for dof in DOFS) for key in ("KE", "CE"))
        bent = {dof: one for dof, one in laws.items() if one.says("NonLinear")}
        nodes = [self.node(row, "JointI")]
        if row.values.get("JointJ", row.text("JointI")) != row.text("JointI"):
            nodes.append(self.node(row, "JointJ"))
        way = difference(self.model.nodes[nodes[1]], self.model.nodes[nodes[0]]) if len(nodes) == 2 else (0.0, 0.0, 0.0)
        name = assigned.text("LinkProp")
        first = axis_between([(0.0, 0.0, 0.0), way], row.place) if length(way) > 0 else (0.0, 0.0, 1.0)
        if bent:
            law, kind = bent.get("U1"), self.kinds.get(name, "")
            if law is None or len(laws) > 1 or not law.real("TransK", 0.0) > 0 or (kind.startswith("Damper") and not length(way) > 0):
                return self.lose(row, "NONLINEAR LINK", NONLINEAR)
            if kind.startswith("Damper"):
                self.model.axial_springs.append(AxialSpring(tuple(nodes), 0.0, law.real("TransC"), name, row.place,
                                                            law.real("CExp", 1.0), law.real("TransK")))
                return None
            ends = (nodes[-1], nodes[0]) if len(nodes) == 2 else (nodes[0], None)  # the ground is the first end
            opening = law.real("TransOpen", law.real("Open", 0.0))
            self.model.gaps.append(Gap(ends, scaled(first, 1.0 if kind == "Hook" else -1.0), opening, law.real("TransK"), name, row.place))
            return None
        if length(way) > 0 and not any(stiffness[1:]) and not any(dashpot[1:]):
            self.model.axial_springs.append(AxialSpring(tuple(nodes), stiffness[0], dashpot[0], name, row.place))
            return
        frame = frame_about(first, (1.0, 0.0, 0.0) if abs(first[2]) > 1 - 1e-6 / 2 else (0.0, 0.0, 1.0), row.place)
        axes = (first, frame[2], cross(first, frame[2]))
        turned = along_global_axes(stiffness, axes), along_global_axes(dashpot, axes)
        if None in turned:
            self.lose(row, "LINK ACROSS THE GLOBAL AXES", "springs act along and about the global axes, or along their line")
            return
        self.model.springs.append(Spring(tuple(nodes), *turned, name, row.place))

    # Joints.

    def _restraint(self, row: Row) -> None:
        self.model.hold(self.node(row, "Joint"), sum(1 << k for k, dof in enumerate(DOFS) if row.says(dof)))

    def _active(self, row: Row) -> None:
        """Degrees of freedom that the analysis has not are held at every joint."""
        held = sum(1 << k for k, dof in enumerate(("UX", "UY", "UZ", "RX", "RY", "RZ")) if row.values.get(dof, "Yes").lower() == "no")
        if held:
            for node in self.model.nodes:
                self.model.hold(node, held)
            names = ", ".join(COMPONENTS[k] for k in range(6) if held >> k & 1)
            self.model.said.append(f"degrees of freedom that are not active are held at every joint: {names}")

    def _spring(self, row: Row) -> bool | None:
        if row.values.get("CoordSys", "Local").upper() not in ("LOCAL", "GLOBAL"):
            return self.lose(row, "SPRING IN ANOTHER SYSTEM", "springs act along and about the global axes")
        self.model.springs.append(Spring((self.node(row, "Joint"),), tuple(row.real(dof, 0.0) for dof in DOFS), name="springs",
                                         place=row.place))

    def _mass(self, row: Row) -> None:
        three = [row.real(f"Mass{k}", 0.0) for k in (1, 2, 3)]
        if max(three) != min(three):
            self.lose(row, "MASS THAT DIFFERS BY DIRECTION", "a mass is the same along all axes; allowed, the largest holds")
        self.model.masses.append(PointMass(self.node(row, "Joint"), max(three),
                                           tuple(row.real(f"MMI{k}", 0.0) for k in (1, 2, 3)), place=row.place))

    def _constraint(self, row: Row) -> None:
        free = [dof for dof in ("UX", "UY", "UZ", "RX", "RY", "RZ") if dof in row.values and not row.says(dof)]
        if free:
            self.lose(row, "BODY CONSTRAINT OF SOME COMPONENTS", "rigid bodies couple all components of their nodes")
        self.constraints[row.text("Name")] = "Body"

    def _constrained(self, row: Row) -> bool | None:
        name = row.text("Constraint")
        if name not in self.constraints:
            return self.lose(row, f"CONSTRAINT OF TYPE {row.values.get('Type', 'UNKNOWN').upper()}",
                             "body constraints alone are known; give a diaphragm in the scene")
        if name not in self.bodies:
            self.bodies[name] = []
            self.model.rigid.append((name, self.bodies[name], row.place))
        self.bodies[name].append(self.node(row, "Joint"))

    def _group(self, row: Row) -> None:
        name, kind, label = row.text("GroupName"), row.text("ObjectType"), row.text("ObjectLabel")
        if kind == "Joint" and label in self.numbers:
            self.model.node_sets.setdefault(name, []).append(self.numbers[label])
        elif kind in ("Frame", "Area"):
            self.model.element_sets.setdefault(name, []).extend((self.frames if kind == "Frame" else self.areas).get(label, []))

    def _source(self, row: Row) -> None:
        by_loads = row.says("Loads") or "load" in row.values.get("MassFrom", "").lower()
        if by_loads:
            self.lose(row, "MASS FROM LOADS", "masses are those of materials and joints; give this one by hand")


def read(path: Path) -> Model:
    """The model of a text. Throws InputFault."""
    return Reader(path).model
