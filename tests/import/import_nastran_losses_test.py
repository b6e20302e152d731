"""Nastran cards that come close to parts of a scene: read as losses that may be allowed, each with what it becomes; cards
of NASTRAN-95; and cards without effect."""
import math
import re
import unittest

import imported
import yaml

HEAD = "SOL 103\nCEND\nBEGIN BULK\n"
PLATE = ("GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,4.,0.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,2.,1.,0.\nGRID,6,,4.,1.,0.\n"
         "SPC1,1,123456,1,4\nMAT1,1,3.+10,,0.2,2500.\n")
QUADS = "CQUAD4,1,9,1,2,5,4\nCQUAD4,2,9,2,3,6,5\n"
MAST = ("GRID,1,,0.,0.,0.\nGRID,2,,0.,0.,3.\nCBAR,1,1,1,2,1.,0.,0.\nMAT1,1,2.1+11,,.3,7850.\nSPC1,1,123456,1\n")


class Losses(unittest.TestCase):
    def read(self, text, *losses):
        """Options of the scene of a deck, and what was said; without its losses allowed the deck is refused by their names."""
        words = ("--allow-losses", ",".join(losses)) if losses else ()
        for loss in losses:
            said = imported.refused(self, "deck.bdf", HEAD + text, "would be lost", words=("--allow-losses", ",".join(
                {*losses} - {loss})) if len(losses) > 1 else ())
            self.assertIn(f"LOST: {loss} ", said)
        scene, said = imported.imported(self, "deck.bdf", HEAD + text, "m,kg,s", *words)
        return yaml.safe_load(scene.read_text()), said

    def plate(self, text, *losses):
        """Young's modulus, Poisson's ratio, thickness and mass of a plate of 4 m2."""
        options, said = self.read(PLATE + text, *losses)
        region = next(region for region in options["deck"].values() if isinstance(region, dict) and region.get("element") == "shell")
        material = options["material"][region["material"]]
        return (*(float(value) for value in (material["young"], material["poisson"], region["thickness"])), imported.said_mass(said)[0])

    def test_layers_of_one_material_are_a_plate(self):
        for layers in ("1,.05,0.,YES,1,.1,45.,YES\n,1,.05,0.\n", "1,.05,0.,,,.1\n,,.05\n", "1,.2\n"):
            young, poisson, thickness, mass = self.plate(QUADS + "PCOMP,9\n," + layers, "PCOMP")
            imported.close(self, (young / 3e10, poisson, thickness, mass), (1, .2, .2, 2000), 1e-9)
        found = self.plate(QUADS + "PCOMP,9,,,,,,,SYM\n,1,.05,,,1,.05\n", "PCOMP")
        imported.close(self, (found[2], found[3]), (.2, 2000), 1e-9)

    def test_a_sandwich_keeps_both_stiffnesses_and_its_mass(self):
        """Faces of 2 mm on a core of 50 mm: in plane and in bending as the layers are, by hand."""
        text = QUADS + "MAT1,2,7.+10,,.2,2700.\nMAT1,3,7.+7,,.2,80.\nPCOMPG,9,,1.5\n,1,2,.002,,,,,\n,2,3,.05,,,,,\n,3,2,.002\n"
        young, poisson, thickness, mass = self.plate(text, "PCOMPG")
        plane = (7e10 * .004 + 7e7 * .05) / .96
        bending = (7e10 * (.054**3 - .05**3) + 7e7 * .05**3) / 12 / .96
        imported.close(self, (young * thickness / .96 / plane, young * thickness**3 / 12 / .96 / bending, poisson, mass),
                       (1, 1, .2, 4 * (2700 * .004 + 80 * .05 + 1.5)), 1e-9)

    def test_directions_are_their_mean(self):
        """The stiffness in plane of a layer with directions, turned through all angles, has the mean that is written."""
        e1, e2, nu, g = 1.4e11, 1e10, .3, 5e9
        rest = 1 - nu**2 * e2 / e1
        q = (e1 / rest, nu * e2 / rest, e2 / rest, g)
        turned = [(math.cos(a), math.sin(a)) for a in (math.pi * k / 180 for k in range(180))]
        q11 = sum(q[0] * c**4 + 2 * (q[1] + 2 * q[3]) * s**2 * c**2 + q[2] * s**4 for c, s in turned) / 180
        q12 = sum((q[0] + q[2] - 4 * q[3]) * s**2 * c**2 + q[1] * (s**4 + c**4) for c, s in turned) / 180
        for text, loss in (("PCOMP,9\n,8,.01,30.,,8,.01,-20.\n", "PCOMP"), ("PSHELL,9,8,.02,8\n", "PSHELL")):
            young, poisson, thickness, mass = self.plate(QUADS + "MAT8,8,1.4+11,1.+10,.3,5.+9,,,1600.\n" + text, loss)
            imported.close(self, (young / (1 - poisson**2) / q11, poisson * q11 / q12, thickness, mass), (1, 1, .02, 128), 1e-9)
        # The same by MAT2, of which a bending stiffness of eight times the own one makes a plate of the same stretch.
        numbers = ",".join(f"{value:.8g}" for value in (q[0], q[1], 0., q[2], 0., q[3], 1600.))
        young, poisson, thickness, mass = self.plate(QUADS + f"MAT2,8,{numbers}\nPSHELL,9,8,.02,8,8.\n", "PSHELL")
        imported.close(self, (young * thickness / (1 - poisson**2) / q11 / .02, (thickness / .02)**2, mass), (1, 8, 128), 1e-7)

    def test_a_reference_plane_off_the_middle(self):
        """Of a laminate whose bottom lies in its grid points the middle is half a thickness above them."""
        _, said = self.read(PLATE + QUADS + "PCOMP,9,0.\n,1,.2\n", "PCOMP")
        imported.close(self, imported.said_mass(said)[1], (2, .5, .1))

    def test_bars_without_torsion_or_with_one_inertia(self):
        for values, losses, expected in ((".01,2.-5,1.-5", ("J OF PBAR",), (2e-5, 1e-5, 3e-5)),
                                         (".01,2.-5,,4.-5", ("I OF PBAR",), (2e-5, 2e-5, 4e-5)),
                                         (".01,,2.-5", ("I OF PBAR", "J OF PBAR"), (2e-5, 2e-5, 4e-5))):
            options, _ = self.read(MAST + f"PBAR,1,1,{values}\n", *losses)
            found = next(iter(options["section"].values()))
            imported.close(self, [float(found[key]) / 1e-5 for key in ("inertia_y", "inertia_z", "torsion")],
                           [value / 1e-5 for value in expected], 1e-9)
        options, said = self.read(MAST + "PBAR,1,1,.01\n")  # a bar without any inertia carries along its axis
        self.assertIn("elements: bar 1\n", said)
        self.assertEqual(options["deck"]["pbar_1"]["element"], "bar")

    def test_numbers_of_properties_by_their_kind(self):
        _, said = self.read(PLATE + QUADS + "PSHELL,9,1,.1,1\nCBAR,3,9,3,6,0.,0.,1.\nPBAR,9,1,.01,1.-5,1.-5,1.-5\n"
                            "CROD,4,9,2,6\nPROD,9,1,.02\n")
        imported.close(self, imported.said_mass(said)[:1], (2500 * (4 * .1 + .01 + .02 * math.sqrt(5)),))

    def test_cards_without_effect(self):
        cards = ("USET,U1,2,3\nUSET1,U1,3,2\nCBARAO,1,FR,.2,.4\nPLOTEL3,8,1,2,2\nSPOINT,90\nASET1,123,2\nAERO,,1.,1.,1.\n"
                 "CAERO1,7,7\nDOPTPRM,DESMAX,5\nDEQATN,5,F(A,B) = A +\n+ B, 2.\nCNGRNT,1,2\n")
        _, said = self.read(MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\n" + cards)
        for name in ("USET 1", "USET1 1", "CBARAO 1", "PLOTEL3 1", "SPOINT 1", "ASET1 1", "AERO 1", "CAERO1 1", "DOPTPRM 1", "DEQATN 1", "CNGRNT 1"):
            self.assertRegex(said, rf"(?m)^passed over.*\b{name}\b")

    def test_plates_and_bricks_of_nastran_95(self):
        """Are those of later decks."""
        for text in (QUADS + "PSHELL,9,1,.1,1,,,,3.\n", QUADS.replace("CQUAD4", "CQUAD2") + "PQUAD2,8,1,.5,,9,1,.1,3.\n",
                     QUADS.replace("CQUAD4", "CQUAD1") + "PQUAD1,9,1,.1,1,8.33333333-5,,,3.\n"):
            young, poisson, thickness, mass = self.plate(text)
            imported.close(self, (young / 3e10, poisson, thickness, mass), (1, .2, .1, 1012), 1e-7)
        grids = "".join(f"GRID,{k + 1},,{x}.,{y}.,{z}.\n" for k, (x, y, z) in enumerate(
            ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))))
        for card in ("CHEXA1,1,1,1,2,3,4,5,6\n,7,8\n", "CIHEX1,1,7,1,2,3,4,5,6\n,7,8\nPIHEX,7,1\n"):
            _, said = self.read(grids + card + "MAT1,1,3.+10,,0.2,2500.\nSPC1,1,123,1,2,3,4\n")
            imported.close(self, imported.said_mass(said)[:1], (2500,))
        found = self.plate(QUADS.replace("CQUAD4", "CSHEAR") + "PSHEAR,9,1,.1,3.\n", "CSHEAR")
        imported.close(self, found[2:], (.1, 1012))

    def test_shells_of_second_order_by_their_corners(self):
        grids = "GRID,7,,1.,0.,0.\nGRID,8,,2.,.5,0.\nGRID,9,,1.,1.,0.\nGRID,10,,0.,.5,0.\n"
        found = self.plate(grids + "CQUAD8,1,9,1,2,5,4,7,8\n,9,10,.3,.3,.3,.3\nCQUAD4,2,9,2,3,6,5\nPSHELL,9,1,.1,1\n", "CQUAD8")
        imported.close(self, found[3:], (2500 * 2 * (.1 + .3),))

    def test_masses_by_component_and_by_matrix(self):
        mast = MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\nGRID,3,,1.,0.,0.\n"
        for text in ("CMASS2,5,40.,2,1\nCMASS2,6,40.,2,2\nCMASS2,7,40.,2,3\n", "PMASS,3,40.\n" + "".join(f"CMASS1,{k + 4},3,2,{k}\n" for k in (1, 2, 3)),
                     "CONM1,5,2,,40.,,40.,,,40.\n"):
            _, said = self.read(mast + text)
            imported.close(self, imported.said_mass(said)[:1], (275.5,))
        _, said = self.read(mast + "CMASS2,5,40.,2,3\n", "MASS THAT DIFFERS BY DIRECTION")
        imported.close(self, imported.said_mass(said)[:1], (275.5,))

    def test_springs_and_dashpots_along_a_line(self):
        options, _ = self.read(MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\nGRID,3,,2.,0.,3.\nSPC1,1,123456,3\nCBUSH1D,5,5,2,3\nPBUSH1D,5,2.+6,3.+3\n"
                               "CVISC,6,6,2,3\nPVISC,5,1.,,,6,4.+3\n")
        found = [region for region in options["deck"].values() if isinstance(region, dict) and region.get("element") == "spring"]
        self.assertEqual([(region["stiffness"], region["dashpot"]) for region in found], [("2000000,0,0", "7000,0,0")])

    def test_sets_of_subcases_and_sets_that_are_not_there(self):
        deck = MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\nSPC1,2,123456,2\n"
        text = "SUBCASE 1\nSPC = 1\nSUBCASE 2\nSPC = 2\n"
        imported.refused(self, "deck.bdf", "SOL 101\nCEND\n" + text + "BEGIN BULK\n" + deck, "SPC OF OTHER SUBCASES 1 would be lost")
        _, said = imported.imported(self, "deck.bdf", "SOL 101\nCEND\n" + text + "BEGIN BULK\n" + deck, "m,kg,s", "--allow-losses",
                                    "SPC OF OTHER SUBCASES")
        self.assertIn("supported nodes 1:", said)

    def test_a_bushing_between_nodes_apart(self):
        """Lies at one place between them, at the ends of rigid arms: as one between nodes there would with RBE2 as arms."""
        two = (MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\nGRID,3,,2.,0.,0.\nGRID,4,,2.,0.,3.\nCBAR,2,1,3,4,1.,0.,0.\nSPC1,1,123456,3\n"
               "PBUSH,9,K,3.+5,4.+5,5.+5,6.+4\n")
        for more, at in (("", 1.), (",\n,.25", .5), (",\n,,0,1.5,0.,3.", 1.5)):
            scene, _ = imported.imported(self, "deck.bdf", HEAD + two + f"CBUSH,5,9,2,4,,,,0{more}\n")
            arms = f"GRID,5,,{at},0.,3.\nGRID,6,,{at},0.,3.\nRBE2,7,2,123456,5\nRBE2,8,4,123456,6\nCBUSH,5,9,5,6,,,,0\n"
            other, _ = imported.imported(self, "deck.bdf", HEAD + two + arms)
            imported.close(self, *(imported.frequencies(imported.structure(self, path, modes=6)) for path in (scene, other)), 1e-9)

    def test_shells_on_each_other_are_one(self):
        """Of both stiffnesses and masses: two of 0.1 m are one of the same bending as both, which is no plate of 0.2 m."""
        twice = QUADS + "CQUAD4,3,8,1,2,5,4\nCQUAD4,4,8,6,5,2,3\nPSHELL,8,1,.1,1\n"
        for thickness in (.1, .3):
            young, poisson, own, mass = self.plate(twice + f"PSHELL,9,1,{thickness},1,,,,5.\n")
            plane, bending = .1 + thickness, .1**3 + thickness**3
            imported.close(self, (young * own / plane / 3e10, young * own**3 / bending / 3e10, poisson, mass), (1, 1, .2, 4 * (2500 * plane + 5)), 1e-9)
        _, said = self.read(PLATE + twice + "PSHELL,9,1,.1,1\n")
        self.assertIn("\nshells on the nodes of others 2: one each has", said)
        self.plate("MAT1,2,3.+10,,0.3,2500.\n" + twice + "PSHELL,9,2,.1,2\n", "SHELLS OF DIFFERENT MATERIALS ON EACH OTHER")

    def test_scalar_points_that_elements_make(self):
        _, said = self.read(MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\nCELAS4,5,1.+3,70,71\nSPC1,1,0,71\nSPC,1,70,0,0.\n", "CELAS4")
        self.assertIn("supported nodes 1:", said)

    def test_a_ratio_of_poisson_that_bars_do_not_need(self):
        """With E and G a bar has both: its torsion is that of G."""
        options, _ = self.read(MAST.replace(",,.3,7850.", ",8.+10,17.,7850.") + "PBAR,1,1,.01,1.-5,1.-5,2.-5\n")
        material, own = (next(iter(options[kind].values())) for kind in ("material", "section"))
        shear = float(material["young"]) / 2 / (1 + float(material["poisson"]))
        imported.close(self, (float(material["young"]) / 2.1e11, float(own["torsion"]) * shear / (2e-5 * 8e10)), (1, 1), 1e-9)

    def test_numbers_beyond_those_of_a_mesh(self):
        """Nodes and elements of ten digits and more get new numbers; Gmsh ends on theirs."""
        text = HEAD + "PBAR,1,1,.01,1.-5,1.-5,2.-5\n"
        scene, _ = imported.imported(self, "deck.bdf", text + MAST)
        other, _ = imported.imported(self, "deck.bdf", text + MAST.replace("GRID,2", "GRID,80000000001").replace("CBAR,1,1,1,2", "CBAR,80000000001,1,1,80000000001"))
        one, two = (imported.structure(self, path, modes=3) for path in (scene, other))
        self.assertEqual((one["mass"], imported.frequencies(one)), (two["mass"], imported.frequencies(two)))

    def test_bricks_whose_nodes_go_round(self):
        """CIHEX2 names corners and mid-side nodes in turn."""
        round_ = ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1))
        places = [(x, y, 0) for x, y in round_] + [(x, y, 1) for x, y in round_[::2]] + [(x, y, 2) for x, y in round_]
        grids = "".join(f"GRID,{k},,{x}.,{y}.,{z}.\n" for k, (x, y, z) in enumerate(places, 1))
        card = "CIHEX2,1,7,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n,15,16,17,18,19,20\nPIHEX,7,1\n"
        _, said = self.read(grids + card + "MAT1,1,3.+10,,0.2,2500.\nSPC1,1,123,1,3,5,7\n", "CIHEX2 of second order")
        imported.close(self, imported.said_mass(said)[:1], (20000,))

    def test_axes_of_vectors_and_offsets(self):
        """In axes that are turned about z by 90 degrees a vector along x is along y; by BGG it stays along x."""
        deck = (MAST.replace("GRID,1,,0.,0.,0.", "CORD2R,4,,0.,0.,0.,0.,0.,1.,\n,0.,1.,0.\nGRID,1,,0.,0.,0.,4") + "PBAR,1,1,.01,1.-5,2.-5,2.-5\n")
        for kind, axis in (("", "0,1,0"), (",GGG", "0,1,0"), (",BGG", "1,0,0"), (",BOO", "1,0,0")):
            options, _ = self.read(deck.replace("1.,0.,0.\nMAT1", f"1.,0.,0.{kind}\nMAT1"))
            self.assertEqual(next(iter(options["section"].values()))["z_axis"], axis)
        self.read(deck.replace("1.,0.,0.\nMAT1", "1.,0.,0.,BOG,,\n,,,.1,.2\nMAT1"), "OFFT BOG OF CBAR")

    def test_elements_of_cards_that_are_lost_go_with_them(self):
        _, said = self.read(MAST + "PBAR,1,1,.01,1.-5,1.-5,2.-5\nGRID,3,,1.,0.,3.\nCBAR,2,2,2,3,0.,0.,1.\nPBARL,2,1,,T2\n,.1,.1,.01,.01\n",
                            "PBARL T2", "ELEMENTS OF PBARL T2")
        self.assertTrue(re.search(r"nodes 2, elements: beam 1", said), said)


if __name__ == "__main__":
    unittest.main()
