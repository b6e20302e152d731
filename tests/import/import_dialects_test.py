"""Ways of writing that programs and people have: the scene is that of the same deck in plain words."""
import unittest

import imported
import yaml
from import_losses_test import ABAQUS, ANSYS, DYNA, NASTRAN, ansys_elements
from import_sap2000_test import MODEL, table
from imported import refused

PINNED = ABAQUS.replace("3, 0., 0., 6.\n", "3, 0., 0., 6.\n4, 0., 0., 3.\n").replace("2, 2, 3\n", "2, 4, 3\n")
EQUATIONS = "".join(f"*EQUATION\n2\n2, {k}, 1., 4, {k}, -1.\n" for k in (1, 2, 3))
PARAMETERS = ("*PARAMETER\n# a comment\ntall = 2*(1.5e0 + .5) - 1.0  # of a storey\ntop=2*tall/1\nfirst = -(-2)/2\n"
              "step = 1.5*first\n")
SPC = "         7         0         1         1         1         0         0         0\n"
CONTROL = ("IRLF,  0\nCGOMEGA,  0., 0., 0.\nSTEF, 5.67E-08\nDMPOPT,ESAV,NO\nNCNV,1,0,0,0,0\nTIMINT,0,STRU\nCRPLIM,0.1,0\n"
           "MODCONTROL,ON\nQRDOPT,OFF\nEMUNIT,MKS\nTHOPT,FULL\nFINI\nOUTRE,ALL\nEN,R5.5,ATTR,       -1\nCM,_ALL,NODE\n")


def in_instances(sets):
    """Two posts beside each other, whose part has these sets."""
    return (f"*PART, NAME=POST\n{ABAQUS.partition('*MATERIAL')[0]}{sets}*BEAM SECTION{ABAQUS.partition('*BEAM SECTION')[2]}*END PART\n"
            "*ASSEMBLY, NAME=ALL\n*INSTANCE, NAME=A, PART=POST\n*END INSTANCE\n*INSTANCE, NAME=B, PART=POST\n5., 0., 0.\n"
            "*END INSTANCE\n*END ASSEMBLY\n*MATERIAL" + ABAQUS.partition("*MATERIAL")[2].partition("*BEAM SECTION")[0])


# Name, deck, and the same in plain words.
SAME = {
    "a term a line": ("model.inp", PINNED + EQUATIONS.replace("1., 4", "1.,\n4"), PINNED + EQUATIONS),
    "keywords without blanks": ("model.inp", ABAQUS.replace("*BEAM SECTION", "*BEAMSECTION") + "*NODEFILE\nU\n*RIGIDBODY, "
                                "NSET=S, REFNODE=2\n*NSET, NSET=S\n2, 3\n",
                                ABAQUS + "*RIGID BODY, NSET=S, REF NODE=2\n*NSET, NSET=S\n2, 3\n"),
    "temperatures, and nodes that are not there": (
        "model.inp", ABAQUS + "*NSET, NSET=S\n2, 77\n*BOUNDARY\n2, 0, 0, 20.\n2, 11, 11, 20.\n*HEADING\n<no name>\n",
        ABAQUS + "*NSET, NSET=S\n2\n"),
    "a set without nodes": ("model.inp", in_instances("*NSET, NSET=NOTHING\n*NSET, NSET=S\nNOTHING, 2\n"), in_instances("*NSET, NSET=S\n2\n")),
    "indented comments": ("model.inp", ABAQUS.replace("7850.", "   ** kg/m3\n  7850."), ABAQUS),
    "surplus numbers": ("model.inp", ABAQUS.replace("2, 2, 3\n", "2, 2, 3, 1, 1\n"), ABAQUS),
    "parameters": ("model.inp", PARAMETERS + ABAQUS.replace("2, 0., 0., 3.", "2, 0., 0., <tall>").replace(
        "3, 0., 0., 6.", "3, 0., 0., <TOP>").replace("*BOUNDARY\n1,", "*BOUNDARY\n<first>,").replace(
            ".3\n*DENSITY", "<slender>\n*DENSITY").replace("*NODE", "*PARAMETER\nslender=step/5\n*NODE", 1), ABAQUS),
    "control of the solution": ("model.cdb", ANSYS + CONTROL, ANSYS),
    "names of *SET": ("model.cdb", "*set,sid,1\n*set,twice,2\n" + ANSYS.replace("ET,1,188", "et,sid,188").replace(
        "MP,DENS,1", "MP,DENS,sid") + "D,3,ux,%table%\n", ANSYS + "D,3,UX\n"),
    "heads of supports": ("model.k", DYNA + "*SET_NODE_LIST\n         7\n         2         3\n*BOUNDARY_SPC_SET_ID\n"
                          "         1 the first\n" + SPC + "         2 the second\n" + SPC.replace("1         0         0",
                                                                                             "0         1         1"),
                          DYNA + "*SET_NODE_LIST\n         7\n         2         3\n*BOUNDARY_SPC_SET\n" + SPC
                          + SPC.replace("1         0         0", "0         1         1")),
    "titles of sections": ("model.k", DYNA.replace("*SECTION_BEAM\n", "*SECTION_BEAM_TITLE\nthe first\n").replace(
        "*PART", "the second\n         2         2       1.0\n      0.02      1e-5      1e-5      2e-5\n*PART"), DYNA),
    "numbers of a beam's own": ("model.k", DYNA.replace("*ELEMENT_BEAM\n", "*ELEMENT_BEAM_THICKNESS\n").replace(
        "       1       2\n", "       1       2\n{0:>16}{1:>16}\n".format("0.02", "3e-5"), 1).replace(
            "       2       3\n", "       2       3\n{0:>16}{1:>16}\n".format("0.02", "3e-5")).replace(
                "1e-5      1e-5", "1e-5      3e-5"), DYNA.replace("0.01      1e-5      1e-5", "0.02      3e-5      3e-5")),
}

# Name, deck with a dashpot of 4000 N s/m from (0, 0, 3) to a clamped node 4 at (2, 1, 0).
DAMPERS = {
    "Nastran": ("model.bdf", NASTRAN + "GRID,4,,2.,1.,0.\nSPC1,1,123456,4\nCVISC,6,6,2,4\nPVISC,6,4.+3\n"),
    "Abaqus": ("model.inp", ABAQUS.replace("3, 0., 0., 6.\n", "3, 0., 0., 6.\n4, 2., 1., 0.\n") + "*BOUNDARY\n4, 1, 6\n"
               "*ELEMENT, TYPE=DASHPOTA, ELSET=OIL\n9, 2, 4\n*DASHPOT, ELSET=OIL\n\n4000.\n"),
    "ANSYS": ("model.cdb", ANSYS.replace("N,R5.3", "        4        0        0 2.0000000000000E+000 1.0000000000000E+000\nN,R5.3")
              + ansys_elements(14, 2, 4).replace("        1        2        0", "        1        2        7") + "R,7,0,4000\nD,4,ALL\n"),
    "LS-DYNA": ("model.k", DYNA + "*NODE\n" + f"{4:8d}{2.0:16.1f}{1.0:16.1f}{0.0:16.1f}{7:8d}{7:8d}\n" + "*PART\noil\n"
                + "".join(f"{v:10d}" for v in (7, 7, 7)) + "\n*SECTION_DISCRETE\n" + f"{7:10d}{0:10d}\n{0:10d}\n" + "*MAT_DAMPER_VISCOUS\n"
                + f"{7:10d}{4e3:10.1f}\n" + "*ELEMENT_DISCRETE\n" + "".join(f"{v:8d}" for v in (9, 7, 2, 4, 0)) + "\n")}

# A gap of 4 mm, 2e6 N/m beyond it, from (0, 0, 3) to a node 4 that is clamped at (2, 0, 3) or coincides with it.
STOPS = {
    "Nastran": ("model.bdf", NASTRAN + "GRID,4,,2.,0.,3.\nSPC1,1,123456,4\nCGAP,6,6,2,4\nPGAP,6,.004,,2.+6\n"),
    "Nastran, in a system": ("model.bdf", NASTRAN + "GRID,4,,0.,0.,3.\nSPC1,1,123456,4\nCGAP,6,6,4,2,,,,5\nPGAP,6,.004,,2.+6\n"
                             "CORD2R,5,,0.,0.,0.,0.,1.,0.,\n,-1.,0.,0.\n"),
    "CalculiX": ("model.inp", ABAQUS.replace("3, 0., 0., 6.\n", "3, 0., 0., 6.\n4, 2., 0., 3.\n") + "*BOUNDARY\n4, 1, 6\n"
                 "*ELEMENT, TYPE=GAPUNI, ELSET=PGAP_6\n9, 2, 4\n*GAP, ELSET=PGAP_6\n.004, 1., 0., 0., , 2e6\n")}


class Dialects(unittest.TestCase):
    def test_gaps_are_stops(self):
        for what, (name, deck) in STOPS.items():
            with self.subTest(what):
                scene, said = imported.imported(self, name, deck)
                options = yaml.safe_load(scene.read_text())
                stop = {key: value if key in ("secondary", "primary") else [float(x) for x in str(value).split(",")]
                        for key, value in options[options["contacts"]].items()}
                self.assertEqual(stop, {"secondary": "model:gap_end", "primary": "wall", "along": [1.0, 0.0, 0.0], "gap": [.004],
                                        "stiffness": [2e6]})
                self.assertIn("stops with a gap 1", said)
                imported.structure(self, scene, modes=3)
        scene, _ = imported.imported(self, "model.bdf", NASTRAN + "CGAP,6,6,1,3\nPGAP,6,.004,,2.+6\nCGAP,7,6,2,3\n")
        options = yaml.safe_load(scene.read_text())
        self.assertEqual([[options[name][key] for key in ("secondary", "primary", "along")] for name in options["contacts"].split(",")],
                         [["model:gap_end", "model:gap_end_2", "0,0,1"], ["model:gap_end_3", "model:gap_end_2", "0,0,1"]])
        imported.structure(self, scene, modes=3)
        # Closed from the start: bars that press, which a weight may close
        for what in ("Nastran", "CalculiX"):
            name, deck = STOPS[what]
            scene, _ = imported.imported(self, name, deck.replace(".004", "0."))
            options = yaml.safe_load(scene.read_text())
            self.assertEqual(options["model"]["pgap_6"], {"element": "bar", "material": "springs_aslant", "area": "4e-05",
                                                          "compression_only": "true"})
            self.assertNotIn("contacts", options)
            imported.structure(self, scene, modes=3)
        refused(self, "model.bdf", STOPS["Nastran"][1].replace("SPC1,1,123456,4\n", ""), "no element and no support has")
        for field, loss in (("PGAP,6,.004,5.,2.+6", "F0 OF PGAP"), ("PGAP,6,.004,,2.+6,,,.3", "MU1 OF PGAP")):
            refused(self, "model.bdf", STOPS["Nastran"][1].replace("PGAP,6,.004,,2.+6", field), loss)

    def test_gaps_and_hooks_of_sap2000(self):
        """Between two joints and to the ground: a gap closes as joint J comes to joint I, a hook as it goes away."""
        for kind, sign in (("Gap", -1), ("Hook", 1)):
            number = "05 - GAP" if kind == "Gap" else "06 - HOOK"
            law = table(f"LINK PROPERTY DEFINITIONS {number}", "Link=STOP   DOF=U1   Fixed=No   NonLinear=Yes   TransKE=0   TransCE=0   "
                        "DJ=0   TransK=2000   TransOpen=.01")
            deck = MODEL.replace("Link=STAY   LinkType=Linear", f"Link=STOP   LinkType={kind}").replace(
                "LinkProp=STAY", "LinkProp=STOP").replace("END TABLE DATA", law + "END TABLE DATA")
            one_joint = deck.replace("Link=2   JointI=11   JointJ=13", "Link=2   JointI=11   JointJ=11")
            for text, along in ((deck, f"{-sign},0,0"), (one_joint, f"0,0,{sign}")):
                scene, _ = imported.imported(self, "frame.s2k", text, "m,t,s")
                options = yaml.safe_load(scene.read_text())
                stop = options[options["contacts"]]
                self.assertEqual((stop["primary"], stop["along"], float(stop["gap"]), float(stop["stiffness"])), ("wall", along, .01, 2e6))
                imported.structure(self, scene, modes=3)
                closed, _ = imported.imported(self, "frame.s2k", text.replace("TransOpen=.01", "TransOpen=0"), "m,t,s")
                region = yaml.safe_load(closed.read_text())["frame"]["stop"]
                self.assertEqual([name for name in region if name.endswith("_only")],
                                 ["tension_only" if kind == "Hook" and text is deck else "compression_only"])
                imported.structure(self, closed, modes=3)

    def test_dampers_along_a_skew_line_are_bars(self):
        for what, (name, deck) in DAMPERS.items():
            with self.subTest(what):
                scene, _ = imported.imported(self, name, deck)
                regions = yaml.safe_load(scene.read_text())["model"].values()
                self.assertEqual([region for region in regions if isinstance(region, dict) and region.get("element") == "bar"],
                                 [{"element": "bar", "dashpot": "4000.0"}])
                imported.structure(self, scene, modes=3)

    def test_exponential_dampers_of_sap2000(self):
        """c in kN (s/m)^a, in series with a spring; the mass is in t."""
        law = table("LINK PROPERTY DEFINITIONS 04 - DAMPER", "Link=OIL   DOF=U1   Fixed=No   NonLinear=Yes   TransKE=0   TransCE=0   "
                    "DJ=0   TransK=9000   TransC=50   CExp=.4")
        deck = MODEL.replace("Link=STAY   LinkType=Linear", "Link=OIL   LinkType=\"Damper - Exponential\"").replace(
            "LinkProp=STAY", "LinkProp=OIL").replace("END TABLE DATA", law + "END TABLE DATA")
        scene, _ = imported.imported(self, "frame.s2k", deck, "m,t,s")
        self.assertEqual(yaml.safe_load(scene.read_text())["frame"]["oil"], {
            "element": "bar", "dashpot": "50000.0", "dashpot_exponent": "0.4", "dashpot_stiffness": "9000000.0"})
        imported.structure(self, scene, modes=3)
        refused(self, "frame.s2k", deck.replace("DOF=U1   Fixed=No   NonLinear", "DOF=U2   Fixed=No   NonLinear"), "NONLINEAR LINK", units="m,t,s")

    def test_the_scene_is_the_same(self):
        for what, (name, deck, plain) in SAME.items():
            with self.subTest(what):
                one, other = (imported.imported(self, name, text)[0] for text in (deck, plain))
                self.assertEqual(one.read_text(), other.read_text())
                self.assertEqual(one.with_suffix(".msh").read_text(), other.with_suffix(".msh").read_text())

    def test_sets_of_parts_are_groups(self):
        for keyword, values in (("SET_PART_LIST", "         1"), ("SET_PART_LIST_GENERATE", "         1         5")):
            scene, said = imported.imported(self, "model.k", DYNA + f"*{keyword}\n         3\n{values}\n")
            self.assertIn('"part_set_3"', scene.with_suffix(".msh").read_text())
            self.assertIn(f"{keyword} 1", said)
        refused(self, "model.k", DYNA + "*SET_PART_LIST\n         3\n         4\n", "part 4 is not in the deck")

    def test_parameters_are_numbers_alone(self):
        for line, part in (("a=__import__('os').system('x')", "'__import__('os').system('x')' is more than numbers"),
                           ("a=2**3", "is more than numbers"), ("a=b", "'b' is no number, nor an earlier name"),
                           ("a=1/0", "a division by zero"), ("a=(1", "a bracket that is not closed"), ("a=1 2", "no expression"),
                           ("a=" + "(" * 900 + "1" + ")" * 99, "within each other"), ("a 1", "lines of name = number"),
                           ("a=" + "-" * 999 + "1", "within each other"), ("a=" + "*".join(["1e59"] * 6), "no expression")):
            with self.subTest(line[:40]):
                refused(self, "model.inp", f"*PARAMETER\n{line}\n" + ABAQUS, part, "line 2")
        refused(self, "model.inp", ABAQUS.replace("7850.", "<rho>"), "<rho> is no name of *PARAMETER")

    def test_blocks_of_other_elements_are_a_loss(self):
        more = "EBLOCK,10,,,2\n(15i9)\n     1163        3        3\n     1164        3        3\n-1\n"
        refused(self, "model.cdb", ANSYS + more, "EBLOCK OF OTHERS 2 would be lost")

    def test_inertia_relief_is_a_loss(self):
        refused(self, "model.cdb", ANSYS + "IRLF,1\n", "IRLF 1 would be lost")


if __name__ == "__main__":
    unittest.main()
