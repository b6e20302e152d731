"""SAP2000 texts become scenes whose modes are those of the same models written by hand."""
import math
import random
import time
import unittest
from pathlib import Path

import imported
import program
from imported import by_hand, close, said_mass, same, section

STEEL = '''TABLE:  "MATERIAL PROPERTIES 01 - GENERAL"
   Material=S355   Type=Steel   SymType=Isotropic   TempDepend=No

TABLE:  "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES"
   Material=S355   UnitWeight=76.97   UnitMass=7.85   E1=210000000   G12=80769230.7692308   U12=0.3   A1=1.17E-05
'''


def table(name, *rows):
    return f'TABLE:  "{name}"\n' + "".join(f"   {row}\n" for row in rows) + "\n"


def joints(places):
    return table("JOINT COORDINATES", *(f"Joint={n}   CoordSys=GLOBAL   CoordType=Cartesian   XorR={x}   Y={y}   Z={z}   SpecialJt=No   "
                                        f"_\n        GlobalX={x}   GlobalY={y}   GlobalZ={z}" for n, (x, y, z) in places.items()))


def sections(*rows):
    return table("FRAME SECTION PROPERTIES 01 - GENERAL", *rows)


def own_section(name, area, torsion, i33, i22, as2, as3, more=""):
    return (f'SectionName={name}   Material=S355   Shape=General   t3=.3   t2=.2   Area={area}   TorsConst={torsion}   I33={i33}   '
            f'I22={i22}   I23=0   AS2={as2}   AS3={as3}   Color=Blue   {more}').rstrip()


HEAD = ('File C:\\models\\frame.s2k was saved on 11/26/26 at 10:00:00\n\n'
        + table("PROGRAM CONTROL", 'ProgramName=SAP2000   Version=24.0.0   CurrUnits="KN, m, C"   SteelCode="Eurocode 3-2005"'))
PLACES = {1: (0, 0, 0), 2: (6, 0, 0), 3: (0, 5, 0), 4: (6, 5, 0), 5: (0, 0, 4), 6: (6, 0, 4), 7: (0, 5, 4), 8: (6, 5, 4),
          9: (3, 0, 4), 10: (4, 2, 4), 11: (7, 0, 4), 12: (6, 0, 5), 13: (9, 0, 4), 14: (0, 5, 4)}
FRAMES = ((1, 1, 5, "COL"), (2, 2, 6, "COL"), (3, 3, 7, "COL"), (4, 4, 8, "COL"), (5, 5, 6, "GIR"), (6, 7, 8, "GIR"), (7, 5, 7, "GIR"))
MODEL = (HEAD + STEEL + joints(PLACES)
         + table("CONNECTIVITY - FRAME", *(f"Frame={n}   JointI={i}   JointJ={j}   IsCurved=No" for n, i, j, _ in FRAMES))
         + sections(own_section("COL", .0149, 1.85e-6, 2.52e-4, 8.56e-5, .0035, .01),
                    own_section("GIR", .0084, 6e-7, 2.3e-4, 1.3e-5, .004, .005,
                                "AMod=1   A2Mod=1   A3Mod=1   JMod=1   I2Mod=1   I3Mod=1.4   MMod=1.2"))
         + table("FRAME SECTION ASSIGNMENTS", *(f'Frame={n}   SectionType=General   AutoSelect=N.A.   AnalSect={one}   MatProp=Default'
                                                for n, _, _, one in FRAMES))
         + table("FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL", "Frame=2   Angle=90   MirrorAbt2=No   MirrorAbt3=No   AdvanceAxes=No")
         + table("FRAME RELEASE ASSIGNMENTS 1 - GENERAL", "Frame=6   PI=No   V2I=No   V3I=No   TI=No   M2I=No   M3I=No   PJ=No   "
                 "V2J=No   V3J=No   TJ=No   M2J=Yes   M3J=Yes   PartialFix=No")
         + table("FRAME ADDED MASS ASSIGNMENTS", "Frame=7   MassPerLen=.05")
         + table("FRAME AUTO MESH ASSIGNMENTS", *(f"Frame={n}   AutoMesh=Yes   AtJoints=Yes   AtFrames=No" for n in range(1, 8)))
         + table("CONNECTIVITY - AREA", "Area=1   NumJoints=3   Joint1=5   Joint2=9   Joint3=10",
                 "Area=2   NumJoints=4   Joint1=7   Joint2=5   Joint3=10   Joint4=8")
         + table("AREA SECTION PROPERTIES", "Section=SLAB   Material=S355   MatAngle=0   AreaType=Shell   Type=Shell-Thick   "
                 "DrillDOF=Yes   Thickness=.02   BendThick=.02   F11Mod=1   M11Mod=1   MMod=1")
         + table("AREA SECTION ASSIGNMENTS", "Area=1   Section=SLAB", "Area=2   Section=SLAB")
         + table("JOINT RESTRAINT ASSIGNMENTS", *(f"Joint={n}   U1=Yes   U2=Yes   U3=Yes   R1={r}   R2={r}   R3={r}"
                                                  for n, r in ((1, "Yes"), (2, "Yes"), (3, "No"), (4, "Yes"), (13, "Yes"))))
         + table("JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED", "Joint=8   CoordSys=GLOBAL   U1=500   U2=600   U3=0   R1=0   R2=0   R3=70")
         + table("JOINT ADDED MASS ASSIGNMENTS", "Joint=10   CoordSys=Global   Mass1=3   Mass2=3   Mass3=3   MMI1=0   MMI2=0   MMI3=0",
                 "Joint=11   CoordSys=Global   Mass1=1.5   Mass2=1.5   Mass3=1.5   MMI1=.1   MMI2=.2   MMI3=.3",
                 "Joint=14   CoordSys=Global   Mass1=.8   Mass2=.8   Mass3=.8   MMI1=.02   MMI2=.02   MMI3=.02")
         + table("CONSTRAINT DEFINITIONS - BODY", "Name=BODY1   CoordSys=GLOBAL   UX=Yes   UY=Yes   UZ=Yes   RX=Yes   RY=Yes   RZ=Yes")
         + table("JOINT CONSTRAINT ASSIGNMENTS", *(f"Joint={n}   Constraint=BODY1   Type=Body" for n in (6, 11, 12)))
         + table("LINK PROPERTY DEFINITIONS 01 - GENERAL", "Link=PAD   LinkType=Linear   Mass=0   Weight=0   RotInert1=0",
                 "Link=STAY   LinkType=Linear   Mass=0   Weight=0   RotInert1=0")
         + table("LINK PROPERTY DEFINITIONS 02 - LINEAR", "Link=PAD   DOF=U1   Fixed=No   TransKE=9000   TransCE=20",
                 "Link=PAD   DOF=U2   Fixed=No   TransKE=1000   TransCE=0", "Link=PAD   DOF=U3   Fixed=No   TransKE=2000   TransCE=0",
                 "Link=PAD   DOF=R1   Fixed=No   RotKE=300   RotCE=0", "Link=PAD   DOF=R2   Fixed=No   RotKE=400   RotCE=0",
                 "Link=PAD   DOF=R3   Fixed=No   RotKE=500   RotCE=0", "Link=STAY   DOF=U1   Fixed=No   TransKE=800   TransCE=0")
         + table("CONNECTIVITY - LINK", "Link=1   JointI=7   JointJ=14", "Link=2   JointI=11   JointJ=13")
         + table("LINK PROPERTY ASSIGNMENTS", "Link=1   LinkType=Linear   LinkJoints=TwoJoint   LinkProp=PAD",
                 "Link=2   LinkType=Linear   LinkJoints=TwoJoint   LinkProp=STAY")
         + table("GROUPS 2 - ASSIGNMENTS", "GroupName=roof   ObjectType=Frame   ObjectLabel=5", "GroupName=roof   ObjectType=Area   "
                 "ObjectLabel=1", "GroupName=tip   ObjectType=Joint   ObjectLabel=10")
         + table("MASS SOURCE", "MassSource=MSSSRC1   Elements=Yes   Masses=Yes   Loads=No   IsDefault=Yes")
         + table("LOAD PATTERN DEFINITIONS", "LoadPat=DEAD   DesignType=Dead   SelfWtMult=1") + "END TABLE DATA\n")


class Sap2000(unittest.TestCase):
    def test_a_frame_with_slabs_links_and_a_body(self):
        scene, said = imported.imported(self, "frame.s2k", MODEL, "m,t,s")
        rho = 7850.0
        steel = {"-material_m_young": 2.1e11, "-material_m_poisson": 0.3, "-material_m_density": rho}
        column, girder = (.0149, 2.52e-4, 8.56e-5, 1.85e-6), (.0084, 1.4 * 2.3e-4, 1.3e-5, 6e-7)
        # Shear areas along 3, which is y of the program but for its sign, and along 2.
        shear = {"c": ".01,.0035", "g": ".005,.004"}
        added = rho * .0084 * .2
        lines = {"c": [(1, 5), (3, 7), (4, 8)], "ct": [(2, 6)], "gx": [(5, 9), (9, 6)], "gh": [(7, 20)], "gy": [(5, 7)]}
        places = {**{n: PLACES[n] for n in PLACES}, 20: PLACES[8]}
        groups = {name: ("line", cells) for name, cells in lines.items()}
        groups |= {"triangle": ("triangle", [(5, 9, 10)]), "slab": ("quadrangle", [(7, 5, 10, 8)]), "ground": ("point", [(8,)]),
                   "heavy": ("point", [(10,)]), "arm": ("point", [(11,)]), "hung": ("point", [(14,)]), "pad": ("line", [(7, 14)]),
                   "stay": ("line", [(11, 13)]), "fixed": ("point", [(1,), (2,), (4,), (13,)]), "foot": ("point", [(3,)]),
                   "body": ("point", [(6,), (11,), (12,)]), "hinge": ("point", [(8,), (20,)])}
        options = {}
        for name in lines:
            options |= {f"{name}_element": "beam", f"{name}_material": "m", f"{name}_section": name}
        for name, axis in (("c", "1,0,0"), ("ct", "0,1,0")):
            options |= section(name, *column, axis, shear["c"])
        for name in ("gx", "gh", "gy"):
            options |= section(name, *girder, "0,0,1", shear["g"])
            options[f"{name}_mass_per_length"] = added + (50 if name == "gy" else 0)
        for name in ("triangle", "slab"):
            options |= {f"{name}_element": "shell", f"{name}_material": "m", f"{name}_thickness": .02}
        options |= {"ground_element": "grounded_spring", "ground_stiffness": "5e5,6e5,0,0,0,7e4",
                    "heavy_element": "point_mass", "heavy_mass": 3000, "arm_element": "point_mass", "arm_mass": 1500,
                    "arm_rotary_inertia": "100,200,300", "hung_element": "point_mass", "hung_mass": 800,
                    "hung_rotary_inertia": "20,20,20", "pad_element": "spring",
                    # Axis 1 of a link of no length points up, 2 along x.
                    "pad_stiffness": "1e6,2e6,9e6,4e5,5e5,3e5", "pad_dashpot": "0,0,2e4,0,0,0",
                    "stay_element": "spring", "stay_stiffness": "8e5,0,0,0,0,0", "clamp": "fixed,foot:x+y+z", "rigid": "body",
                    "pin": "hinge", **steel}
        same(self, scene, by_hand(places, groups, options))
        frames = .0149 * rho * 4 * 4 + (.0084 * rho * 1.2) * (6 + 6 + 5) + 50 * 5
        slab = .02 * rho * (self.area(5, 9, 10) + self.area(7, 5, 10) + self.area(7, 10, 8))
        close(self, said_mass(said)[:1], (frames + slab + 5300,))
        for part in ("its units are KN, m, C", "LOAD PATTERN DEFINITIONS 1", "CONNECTIVITY - FRAME 7"):
            self.assertIn(part, said)

    @staticmethod
    def area(a, b, c):
        u, v = ([PLACES[n][k] - PLACES[a][k] for k in range(3)] for n in (b, c))
        return .5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])

    def test_the_stick_of_a_reactor_building(self):
        """Frames one above the other in ft, kip, s: the published first modes are 8.455, 12.367 and 32.89 Hz."""
        levels, areas = (0, 8, 13, 22, 33.5, 49, 61, 93), (2000, 2560, 2210, 1960, 1740, 780, 190)
        inertias, shear = (1.1e6, 1.2e6, 1.2e6, 1.3e6, 9e5, 2e5, 4e3), (1320, 1560, 1460, 730, 600, 360, 70)
        masses = (85.52, 76.32, 193.22, 114.29, 263.40, 37.12, 25.17)
        text = (table("PROGRAM CONTROL", 'CurrUnits="Kip, ft, F"')
                + table("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES", "Material=S355   UnitMass=1E-4   E1=345000   G12=134976.5   U12=.278")
                + joints({n: (0, 0, z) for n, z in enumerate(levels, 1)})
                + table("CONNECTIVITY - FRAME", *(f"Frame={n}   JointI={n}   JointJ={n + 1}" for n in range(1, 8)))
                + sections(*(own_section(f"S{n}", a, 2 * i, i, i, s, s) for n, (a, i, s) in enumerate(zip(areas, inertias, shear), 1)))
                + table("FRAME SECTION ASSIGNMENTS", *(f"Frame={n}   AnalSect=S{n}" for n in range(1, 8)))
                + table("JOINT RESTRAINT ASSIGNMENTS", "Joint=1   U1=Yes   U2=Yes   U3=Yes   R1=Yes   R2=Yes   R3=Yes")
                + table("JOINT ADDED MASS ASSIGNMENTS", *(f"Joint={n}   Mass1={m}   Mass2={m}   Mass3={m}"
                                                          for n, m in enumerate(masses, 2))))
        scene, said = imported.imported(self, "stick.s2k", text, "ft,kip,s")
        found = imported.frequencies(imported.structure(self, scene))
        for value, reference in zip(found[::2], (8.455, 12.367, 27.83, 32.89)):
            self.assertLess(abs(value / reference - 1), 2e-3, found)
        heights = [b - a for a, b in zip(levels, levels[1:])]
        close(self, said_mass(said)[:1], ((sum(masses) + 1e-4 * sum(a * h for a, h in zip(areas, heights))) * 4448.2216152605 / .3048,))

    @staticmethod
    def portal(section="F1", restraints=(), more=""):
        """Two columns of 4 m and a girder of 6 m in the x-z plane, without shear areas."""
        held = "U1=Yes   U2=Yes   U3=Yes   R1=Yes   R2=Yes   R3=Yes"
        return (HEAD + STEEL + joints({1: (0, 0, 0), 2: (0, 0, 4), 3: (6, 0, 4), 4: (6, 0, 0)})
                + table("CONNECTIVITY - FRAME", *(f"Frame={n}   JointI={i}   JointJ={j}" for n, i, j in ((1, 1, 2), (2, 2, 3), (3, 4, 3))))
                + sections(own_section(section, .01, 1e-6, 1e-4, 1e-5, 0, 0))
                + table("FRAME SECTION ASSIGNMENTS", *(f"Frame={n}   AnalSect={section}" for n in (1, 2, 3)))
                + table("JOINT RESTRAINT ASSIGNMENTS", f"Joint=1   {held}", f"Joint=4   {held}", *restraints) + more)

    def test_degrees_of_freedom_that_are_not_active(self):
        """Are held at every joint, as by restraints there; the plane frame sways at 12.592 Hz."""
        plane = "U1=No   U2=Yes   U3=No   R1=Yes   R2=No   R3=Yes"
        scene, _ = imported.imported(self, "plane.s2k", self.portal("F1", (f"Joint=2   {plane}", f"Joint=3   {plane}")), "m,t,s")
        expected = imported.frequencies(imported.structure(self, scene, modes=3))
        for row in ("UX=Yes   UY=No   UZ=Yes   RX=No   RY=Yes   RZ=No", "UY=No   RX=No   RZ=No"):
            scene, said = imported.imported(self, "plane.s2k", self.portal("F1", (), table("ACTIVE DEGREES OF FREEDOM", row)), "m,t,s")
            close(self, imported.frequencies(imported.structure(self, scene, modes=3)), expected, 1e-9)
            self.assertIn("\ndegrees of freedom that are not active are held at every joint: y, rx, rz\n", said)
        self.assertLess(abs(expected[0] - 12.592), 1e-3)

    def test_a_section_with_the_name_of_a_standard_one(self):
        """Keeps its own numbers: without shear areas it has no flexibility in shear."""
        found = []
        for name in ("FSEC1", "W12X106", "HEB160", "ROUND50", "RECT600x400"):
            scene, _ = imported.imported(self, "portal.s2k", self.portal(name), "m,t,s")
            found.append(imported.frequencies(imported.structure(self, scene, modes=3)))
        for other in found[1:]:
            close(self, other, found[0], 1e-12)
        rows = (Path(program.SOURCE) / "src/scene/standard_sections.csv").read_text().splitlines()
        names = [row.split(",")[0] for row in rows if row and not row.startswith("#")]
        self.assertGreater(len(names), 200)
        from pounding.importing.sections import STANDARD
        self.assertEqual([name for name in [*names, "HE160B", "SHS100x5", "HSS8x8x1"] if not STANDARD.fullmatch(name)], [])

    def test_things_given_twice(self):
        """The same again counts once; other values are refused with both places."""
        _, said = imported.imported(self, "frame.s2k", MODEL, "m,t,s")
        rows = {"Joint=1   ": "XorR=0", "Frame=5   JointI": "JointJ=6", "SectionName=COL": "Area=0.0149", "Frame=3   SectionType": "AnalSect=COL",
                "Material=S355   UnitWeight": "UnitMass=7.85", "Joint=10   CoordSys=Global   Mass1": "Mass1=3", "Area=1   NumJoints": "Joint3=10",
                "Link=1   JointI": "JointJ=14"}
        lines = MODEL.splitlines(True)
        for begin, part in rows.items():
            with self.subTest(begin):
                at = next(k for k, line in enumerate(lines) if line.strip().startswith(begin))
                row = "".join(lines[at:at + 1 + lines[at].rstrip().endswith(" _")])
                self.assertIn(part, row)
                other = row.replace(part, part.split("=")[0] + "=9")
                imported.refused(self, "frame.s2k", "".join([*lines[:at], row, other, *lines[at + row.count("\n"):]]), " twice, in another way at "
                                 f"frame.s2k line {at + 1}", units="m,t,s")
                _, again = imported.imported(self, "frame.s2k", "".join([*lines[:at], row, *lines[at:]]), "m,t,s")
                self.assertEqual(said_mass(again), said_mass(said))

    def test_time_grows_with_joints(self):
        """Joints on frames are found by their places: four times as many take less than eight times as long."""
        from pounding.importing.sap2000 import read
        taken = []
        for count in (1500, 6000):
            text = (STEEL + joints({f"J{n}": (n % 100, n // 100, 0) for n in range(count + 1)})
                    + table("CONNECTIVITY - FRAME", *(f"Frame={n}   JointI=J{n}   JointJ=J{n + 1}" for n in range(count)))
                    + sections(own_section("A", .01, 1e-5, 1e-5, 1e-5, 0, 0))
                    + table("FRAME SECTION ASSIGNMENTS", *(f"Frame={n}   AnalSect=A" for n in range(count))))
            path, begin = imported.of_file("long.s2k", text), time.process_time()
            self.assertGreaterEqual(len(read(path).elements), count)
            taken.append(time.process_time() - begin)
        self.assertLess(taken[1], 8 * taken[0], taken)

    def test_losses_have_names(self):
        cases = (("Frame=2   Angle=90   MirrorAbt2=No   MirrorAbt3=No   AdvanceAxes=No", "Frame=2   Angle=90   AdvanceAxes=Yes",
                  "ADVANCED AXES"),
                 ("M2J=Yes   M3J=Yes", "M2J=No   M3J=Yes", "PARTIAL RELEASE"), ("Type=Shell-Thick", "Type=Membrane",
                                                                              "AREA SECTION OF TYPE MEMBRANE"),
                 ("BendThick=.02", "BendThick=.03", "THICKNESS IN BENDING"), ("F11Mod=1", "F11Mod=.5", "AREA MODIFIERS"),
                 ("Mass3=3", "Mass3=0", "MASS THAT DIFFERS BY DIRECTION"), ("Constraint=BODY1   Type=Body", "Constraint=DIA   Type=Diaphragm",
                                                                          "CONSTRAINT OF TYPE DIAPHRAGM"),
                 ("Loads=No", "Loads=Yes", "MASS FROM LOADS"), ("I23=0", "I23=1E-6", "I23 OF A FRAME SECTION"),
                 ("LinkType=Linear   Mass=0", "LinkType=Friction   Mass=0", "NONLINEAR LINK"), ("AnalSect=GIR", "AnalSect=TAPER",
                                                                                         "FRAME SECTION THAT IS NONPRISMATIC"),
                 ("SymType=Isotropic", "SymType=Orthotropic", "MATERIAL THAT IS NOT ISOTROPIC"), ("Fixed=No   TransKE=800", "Fixed=Yes",
                                                                                                "FIXED COMPONENT OF A LINK"),
                 ("LOAD PATTERN DEFINITIONS", "TENDON OBJECTS", "TENDON OBJECTS"), ("IsCurved=No", "IsCurved=Yes", "CURVED FRAME"),
                 ("RX=Yes   RY=Yes   RZ=Yes", "RX=No   RY=No   RZ=No", "BODY CONSTRAINT OF SOME COMPONENTS"))
        for before, after, name in cases:
            with self.subTest(name):
                self.assertIn(before, MODEL)
                said = imported.refused(self, "frame.s2k", MODEL.replace(before, after, 1), units="m,t,s")
                self.assertIn(f"LOST: {name} ", said)

    def test_mistakes_are_one_line(self):
        for before, after, part in (("JointJ=5 ", "JointJ=55 ", "joint 55 is not in the file"), ("E1=210000000", "E1=steel", "'steel' is not"),
                                    ("AnalSect=COL", "Sect=COL", "AnalSect is not given"), ('TABLE:  "JOINT', "JOINT", "no row of"),
                                    ("Material=S355   Shape", "Material=S999   Shape", "material S999 is not in the file")):
            with self.subTest(part):
                imported.refused(self, "frame.s2k", MODEL.replace(before, after, 1), part, units="m,t,s")
        imported.refused(self, "empty.s2k", "File\n", "no table in it", units="m,t,s")

    def test_texts_that_no_model_has(self):
        begin = 'TABLE:  "JOINT COORDINATES"\n'
        for row, part in (("   " + "A" * 9000 + "\n", "no row of NAME=VALUE"), ("   " + "a=" * 4000 + "\n", "Joint is not given"),
                          ("a" * 90 + " _\n" + ("b" * 90 + " _\n") * 20000, "a row of more than 100000 letters"),
                          ("   Joint=\xb2   XorR=0   Y=0   Z=1e308\n", "Z: '1e308' is beyond 1e+60")):
            at = time.monotonic()
            imported.refused(self, "frame.s2k", (MODEL.replace(begin, begin + row, 1)).encode("latin-1"), part, units="m,t,s")
            self.assertLess(time.monotonic() - at, 5, part)

    def test_damaged_texts(self):
        rng = random.Random(4)
        self.assertEqual(imported.survives("frame.s2k", [imported.damaged(MODEL, rng) for _ in range(150)]), [])


if __name__ == "__main__":
    unittest.main()
