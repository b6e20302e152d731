"""Two slabs that translate and turn pound at two corners, against event-driven results.

Each slab is rigid in its plane: mass and inertia 9200 kg, 11691.67 kg m2 and 7000 kg, 5979.17 kg m2;
2.1 and 8.6 Hz, 3.7 and 10.2 Hz in translation and torsion, 1.5 % damping each. They can touch at
y = 1.25 and y = -1.25 m with gaps of their own; the ground shakes with 0.30 g sin(2 pi 2.6 t).
Reference: solution between events in closed form, events by bisection.

The slab of the program is two hexahedra and a mass at mid-width, on springs and dashpots from each
node to the ground. It is made rigid by its stiffness, and plastic by damping proportional to that:
of a velocity of approach 1/(beta omega)^2 comes back, omega being its lowest frequency of
deformation in its plane. The damping of its springs by beta is taken off their dashpots.
"""
import math
import unittest

import numpy

from decks import contacts
from recorded import Recorded, reference, write_sine

WIDTH, HEIGHT = 2.5, 1.4
BETA = 4.6e-4  # below that which alone damps the torsion of the springs by 1.5 %
RATIO = 0.015
ACCELERATION, FREQUENCY = 0.30 * 9.81, 2.6

END = 0.9  # s
# The stiffness that makes the slabs rigid leaves a force in their motion, by round-off.
IDENTITY_OF_STIFF_BODIES = 2e-10  # measured: 3e-11

# mass [kg], inertia [kg m2], frequencies of translation and torsion [Hz], part of the mass at the
# corners, lowest frequency of deformation in the plane over (E / density)^(1/2) [1/m]
SLABS = {"left": (9200.0, 11691.666666666666, 2.1, 8.6, 0.4, 0.6),
         "right": (7000.0, 5979.166666666667, 3.7, 10.2, 0.3, 0.6)}

# gaps at y = 1.25 and -1.25 m [m]; impacts after which the corners part: time [s], where, impulse
# [N s], none where they stay together and the force at rest adds to it
CASES = {
    "gap2cm": ((0.025, 0.020), ((0.3668971138, "below", 1030.794722),
                                (0.3731278529, "above", 1272.677906),
                                (0.7473502334, "below", 1878.052267),
                                (0.7502637, "above", 2498.049997))),
    "gap0": ((0.0, 0.007), ((0.3357944682, "above", None), (0.3453568940, "below", 1180.7279),
                            (0.7225749418, "above", None), (0.7270627, "below", 2536.336174))),
    "gap2cm_sym": ((0.02, 0.02), ((0.3668971138, "above", 1324.629300),
                                  (0.3668971138, "below", 1324.629300),
                                  (0.7472185702, "above", 2460.710234),
                                  (0.7472185702, "below", 2460.710234))),
}


def slab(name, overdamping):
    """overdamping: beta times the lowest frequency of deformation."""
    mass, inertia, translation, torsion, corners, lowest = SLABS[name]
    length = 2 * math.sqrt(inertia / mass - corners * (WIDTH / 2)**2)
    density = 2 * corners * mass / (length * WIDTH * HEIGHT)
    young = density * (overdamping / (BETA * lowest))**2
    start = -length if name == "left" else 0
    words = [f"-{name}_mesh", "tests/meshes/torsional_slab.geo", f"-{name}_mesh_set",
             f"x0={start!r},length={length!r},width={WIDTH},height={HEIGHT}",
             f"-{name}_body_element", "hex8_full", f"-{name}_body_material", name,
             f"-material_{name}_young", repr(young), f"-material_{name}_poisson", 0,
             f"-material_{name}_density", repr(density), f"-{name}_damping_beta", BETA]
    # Twelve springs along x and along y, the dashpots along x at the middle, along y at all nodes.
    along, about = ((2 * math.pi * f)**2 * m for f, m in ((translation, mass), (torsion, inertia)))
    loss, turn = (2 * RATIO * 2 * math.pi * f * m - BETA * k for f, m, k in
                  ((translation, mass, along), (torsion, inertia, about)))
    side = (about - along * 8 / 12 * (WIDTH / 2)**2) / (3 * length**2)
    springs = f"{along / 12!r},{side!r},{along / 12!r}"
    across = repr(turn / (3 * length**2))
    return words + [
        f"-{name}_middle_element", "point_mass", f"-{name}_middle_mass",
        repr((1 - 2 * corners) * mass / 4),
        f"-{name}_corners_element", "grounded_spring", f"-{name}_corners_stiffness", springs,
        f"-{name}_corners_dashpot", f"0,{across},0,0,0,0",
        f"-{name}_axis_element", "grounded_spring", f"-{name}_axis_stiffness", springs,
        f"-{name}_axis_dashpot", f"{loss / 4!r},{across},0,0,0,0"]


def scene(gaps, record, overdamping, end):
    above, below = gaps
    words = ["-structures", "left,right",
             *contacts(above=("left:far_high", "right:near_high", f"1,{above}"), below=("left:far_low",
                       "right:near_low", f"{below},1")),
             "-end_time", end, "-motion_x_record", record, "-motion_x_unit", "m/s2", "-output_interval", 1e-4,
             "-impact_merge_time", 1e-3, "-probes", "left_above,left_below,right_above,right_below"]
    for name in SLABS:
        for place, y in (("above", WIDTH / 2), ("below", -WIDTH / 2)):
            words += [f"-{name}_{place}_structure", name, f"-{name}_{place}_at", f"0,{y},0"]
    return words + slab("left", overdamping) + slab("right", overdamping)


class TorsionalSlabs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_sine(ACCELERATION, FREQUENCY, END)

    def pound(self, case, overdamping):
        return Recorded(self, scene(CASES[case][0], self.record, overdamping, END), identity=IDENTITY_OF_STIFF_BODIES)

    def check_impacts(self, run, case, overdamping):
        start, impulse = run.column("start"), run.column("impulse")
        for time, where, expected in CASES[case][1]:
            here = [i for i, name in enumerate(run.impacts["contact"]) if name == where]
            nearest = min(here, key=lambda i: abs(start[i] - time))
            self.assertAlmostEqual(start[nearest], time, delta=8e-3 / overdamping**2,
                                   msg=(case, where))
            if expected is not None:
                self.assertAlmostEqual(impulse[nearest] / expected, 1, msg=(case, where, time),
                                       delta=2.5 / overdamping**2)

    def errors(self, run, case):
        """Of the displacements and of the rotations, relative, root mean square: (left, right)."""
        table = reference("torsional_slabs.csv")
        at = (table["case"] == case) & (table["t"] <= run.time[-1])
        translations, rotations = [], []
        for name, number in (("left", 1), ("right", 2)):
            above, below = (numpy.interp(table["t"][at], run.time,
                                         run.displacement(f"{name}_{place}.x"))
                            for place in ("above", "below"))
            for found, column, errors in (((above + below) / 2, f"u{number}", translations),
                                          ((below - above) / WIDTH, f"th{number}", rotations)):
                expected = table[column][at]
                errors.append(numpy.linalg.norm(found - expected) / numpy.linalg.norm(expected))
        return translations, rotations

    def test_asymmetric_gaps(self):
        errors = {}
        for case, overdamping in (("gap2cm", 20), ("gap2cm", 10), ("gap0", 20)):
            with self.subTest(case, overdamping=overdamping):
                run = self.pound(case, overdamping)
                self.check_impacts(run, case, overdamping)
                translations, rotations = self.errors(run, case)
                self.assertLess(max(translations), 3e-3 * (20 / overdamping)**2)
                self.assertLess(max(rotations), 0.05 * (20 / overdamping)**2)
                errors[case, overdamping] = max(translations)
        # what springs back falls as the square
        self.assertTrue(2.8 < errors["gap2cm", 10] / errors["gap2cm", 20] < 5, errors)

    def test_symmetric_gap_does_not_turn_the_slabs(self):
        run = self.pound("gap2cm_sym", 20)
        self.check_impacts(run, "gap2cm_sym", 20)
        self.assertLess(max(self.errors(run, "gap2cm_sym")[0]), 3e-3)
        for name in SLABS:
            turn = run.displacement(f"{name}_below.x") - run.displacement(f"{name}_above.x")
            self.assertLess(abs(turn).max() / WIDTH, 1e-7)


# What makes the slabs rigid leaves round-off in their motion.
ON_RANKS = {"slabs that translate and turn": (
    lambda: scene(CASES["gap2cm"][0], write_sine(ACCELERATION, FREQUENCY, 0.38), 3, 0.38), {"tolerance": 1e-11})}


if __name__ == "__main__":
    unittest.main()
