"""run/section: the laws of a wall from its concrete and steel, pasted into scenes; panels of Vecchio and Collins (1986)."""
import re
import unittest

import numpy

import program
from loops_test import Loops

# Strength [MPa], steel ratios and yield stresses [MPa] both ways, measured peak [MPa], of panels of 890 x 890 x 70 mm.
PANELS = {"PV19": (19.0, (0.01785, 0.00713), (458, 299), 3.95), "PV20": (19.6, (0.01785, 0.00885), (460, 297), 4.26)}


def section(*words):
    return program.command("section", *words)


def options_of(text, start):
    """Words for the program of the options that are printed below a remark."""
    block = text[text.index(start):].split("# ")[1]
    words = []
    for name, quoted, plain in re.findall(r'(\w+): (?:"([^"]*)"|([^,{}\s]+))', block):
        words += [f"-w_wall_{name}", quoted or plain]
    young = re.search(r"young: ([^,]+)", text)[1]
    return [*words, "-material_concrete_young", young, "-material_concrete_poisson", 0.2,
            "-material_concrete_density", 1e-3]


def pushed(words):
    """One panel whose head is carried over at an even speed, to a strain of 6e-3; stress over strain."""
    side = 0.89
    return ["-structures", "w", "-w_mesh", "tests/meshes/wall.geo", "-w_mesh_set",
            f"nx=1,nz=1,width={side},height={side}", "-w_clamp", "foot,head:y+z+rx+ry+rz",
            "-w_wall_drilling_factor", 1e-9, "-w_head_element", "point_mass", "-w_head_mass", 1e9, "-w_initial_velocity",
            "0.1,0,0", "-end_time", 6e-3 * side / 0.1, "-time_step", "1e-5", "-output_interval", "1e-5", "-loops", "w:wall",
            "-probes", "head", "-head_structure", "w", "-head_at", f"{side / 2},0,{side}", *words]


class Section(unittest.TestCase):
    def test_panels_by_the_program(self):
        for name, (strength, steel, stress, peak) in PANELS.items():
            words = ["--strength", strength * 1e6, "--steel", ",".join(map(str, steel)), "--yield",
                     ",".join(f"{value}e6" for value in stress), "--thickness", 0.07]
            result = section(*words, "--panel")
            self.assertEqual(result.returncode, 0, result.stderr)
            run = Loops(self, pushed(options_of(result.stdout, "# yields")), 2 if name == "PV19" else 1)
            strain, found = run.elongation[:, 0], run.force[:, 0]
            young = 21e9 * (strength / 20)**0.5
            shear = young / 2.4
            root = 0.313e6 * strength**0.5
            self.assertAlmostEqual(found[10] / strain[10] / shear, 1, delta=1e-5)
            cracks = numpy.flatnonzero(found < 0.999 * shear * strain)
            cracks = cracks[cracks > 10][0]
            self.assertAlmostEqual(found[cracks] / root, 1, delta=0.02)
            self.assertAlmostEqual(found.max() / 1e6 / peak, 1, delta=0.1)
            # As a wall with columns its steel and concrete would carry more than was measured.
            more = float(re.search(r"last +(\S+) MPa", section(*words).stdout)[1])
            self.assertGreater(more / peak, 1.3)

    def test_skeleton_by_hand(self):
        result = section("--strength", 30e6, "--steel", 0.008, "--yield", 400e6, "--thickness", 0.3, "--pressure", 1e6)
        root = 0.313 * 30**0.5
        held = 0.008 * 400 + 0.5
        last = 1.2 * root * (1 - held / (4.5 * root)) + held
        first = (root * (root + 1))**0.5
        shear = 21e3 * 1.5**0.5 / 2.4
        expected = [first / shear, first * 1e6, 3 * first / shear, 1.35e6 * first, 4e-3, last * 1e6]
        found = [float(value) for value in re.search(r'shear_skeleton: "([^"]*)"', result.stdout)[1].split(",")]
        for one, other in zip(found, expected):
            self.assertAlmostEqual(one / other, 1, delta=2e-6)
        known = section("--strength", 30e6, "--steel", 0.008, "--yield", 400e6, "--thickness", 0.3, "--pressure", 1e6,
                        "--cracking", 1.4e6).stdout
        found = [float(value) for value in re.search(r'shear_skeleton: "([^"]*)"', known)[1].split(",")]
        for one, other in zip(found, [1.4 / shear, 1.4e6, 4.2 / shear, 1.89e6, *expected[4:]]):
            self.assertAlmostEqual(one / other, 1, delta=5e-6)

    def test_cracking_pasted(self):
        result = section("--strength", 30e6, "--steel", 0.008, "--yield", 400e6, "--thickness", 0.3)
        run = Loops(self, pushed(options_of(result.stdout, "# or cracks")), 1)
        strain, found = run.elongation[:, 0], run.force[:, 0]
        self.assertLess(found[-1] / strain[-1], 0.7 * found[10] / strain[10])
        steel = 0.008 * 2.05e11 / (21e9 * 1.5**0.5)
        self.assertIn(f"cracked_tension: {steel:.4g}", result.stdout)

    def test_refusals(self):
        good = {"--strength": 30e6, "--steel": 0.008, "--yield": 400e6, "--thickness": 0.3}
        for change, said in (({"--steel": 0.8}, "not in %"), ({"--strength": 30}, "Pa"), ({"--cover": 0.2}, "half of"),
                             ({"--thickness": 0}, "above 0"), ({"--steel": "1e-3,1e-3,1e-3"}, "one number or two")):
            result = section(*[word for pair in {**good, **change}.items() for word in pair])
            self.assertNotEqual(result.returncode, 0, change)
            self.assertIn(said, result.stderr)
            self.assertEqual(result.stdout, "")


if __name__ == "__main__":
    unittest.main()
