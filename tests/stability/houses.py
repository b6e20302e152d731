"""Two houses of one storey that pound: every element of the program in a mesh of some twenty nodes.

The left one runs into the right one with a velocity of its own while the ground shakes. All
coordinates are multiples of 1/8 m, exact in binary, and stay so when the pair is moved by 1e6 m.
"""
import os
import tempfile

import numpy

from history import History
from small_meshes import Mesh, house

GAP = 0.002
YOUNG, DENSITY, STEEL, STEEL_DENSITY = 30e9, 2400.0, 200e9, 7800.0
SECTION = {"area": 40e-4, "inertia_y": 600e-8, "inertia_z": 1500e-8, "torsion": 12e-8}
SAMPLES, INTERVAL = 41, 0.005
VELOCITY = (0.5, 0.1, -0.05)
TIME_STEP = 1.6e-5


def shaking(amount=1.0):
    """Ground acceleration [m/s2], shape (samples, 3), every INTERVAL seconds."""
    time = numpy.arange(SAMPLES) * INTERVAL
    waves = [numpy.sin(2 * numpy.pi * f * time) * a for f, a in ((7, 4.0), (11, 2.0), (17, 1.0))]
    return amount * numpy.array(waves).T


def numbers(values):
    return ",".join(repr(float(value)) for value in values)


class Pair:
    """The pair in some setting: length and mass units, orientation, order."""

    def __init__(self, gap=GAP, turn=None, length=1.0, mass=1.0, contacts=True, beams=True):
        self.left, self.right = house(0, 3, 2.5, "x_max"), house(3, 2.25, 2.5, "x_min")
        self.gap, self.velocity, self.record = gap, numpy.array(VELOCITY), shaking()
        self.turn = numpy.eye(3) if turn is None else turn
        self.length, self.mass = length, mass  # size of one metre and one kilogram in the units used
        self.seeds = (None, None)
        self.contact = {"secondary": "left:face", "primary": "right:face"} if contacts else {}
        self.beams = beams

    def meshes(self):
        return [Mesh(mesh.nodes @ self.turn.T * self.length, mesh.groups)
                for mesh in (self.left, self.right)]

    def words(self, folder, time_step, end_time):
        stress = self.mass / self.length  # of kg / (m s2)
        words = ["-structures", "left,right", "-time_step", repr(time_step), "-end_time", repr(end_time),
                 "-output_interval", repr(time_step / 2), "-energy_interval", 1, "-modes", 0,
                 "-spectra_frequencies", 10, "-probes", "one,two", "-one_structure", "left", "-one_group", "face",
                 "-two_structure", "right", "-two_group", "mass"]
        if self.contact:
            words += ["-contacts", "joint", "-joint_gap", repr(self.gap * self.length)]
            words += [word for side, group in self.contact.items() for word in (f"-joint_{side}", group)]
        for name, young, poisson, density in (("concrete", YOUNG, 0.2, DENSITY),
                                              ("steel", STEEL, 0.3, STEEL_DENSITY)):
            words += [f"-material_{name}_young", repr(young * stress), f"-material_{name}_poisson", poisson,
                      f"-material_{name}_density", repr(density * self.mass / self.length**3)]
        if self.beams:
            words += ["-section_column_z_axis", numbers(self.turn @ (1.0, 0.0, 0.0))]
            for key, value in SECTION.items():
                words += [f"-section_column_{key}", repr(value * self.length**(2 if key == "area" else 4))]
        for name, mesh, seed in zip(("left", "right"), self.meshes(), self.seeds):
            words += [f"-{name}_mesh", mesh.write(os.path.join(folder, f"{name}.msh"), seed),
                      f"-{name}_clamp", "base", f"-{name}_damping_alpha", 0.2, f"-{name}_damping_beta", 2e-5]
            words += self._regions(name)
        words += ["-left_initial_velocity", numbers(self.turn @ self.velocity * self.length)]
        return words + self._motion(folder)

    def _regions(self, name):
        column = ["section", "column"] if self.beams else ["area", repr(SECTION["area"] * self.length**2)]
        words = [f"-{name}_column_{column[0]}", column[1], f"-{name}_brace_area", repr(1e-4 * self.length**2),
                 f"-{name}_parapet_thickness", repr(0.125 * self.length),
                 f"-{name}_mass_mass", repr(50.0 * self.mass)]
        for group, element, material in (("slab", "hex8", "concrete"),
                                         ("column", "beam" if self.beams else "bar", "steel"),
                                         ("brace", "bar", "steel"), ("parapet", "shell", "concrete"),
                                         ("mass", "point_mass", None)):
            words += [f"-{name}_{group}_element", element]
            words += [f"-{name}_{group}_material", material] if material else []
        return words

    def _motion(self, folder):
        words = []
        for axis, column in zip("xyz", (self.record @ self.turn.T * self.length).T):
            path = os.path.join(folder, f"{axis}.txt")
            numpy.savetxt(path, column, fmt="%.17g")
            words += [f"-motion_{axis}_record", path, f"-motion_{axis}_unit", "m/s2",
                      f"-motion_{axis}_time_step", INTERVAL]
        return words


class Run(History):
    """Histories of one run of a pair, in metres and kilograms and in the axes of the model."""

    def __init__(self, test, pair, ranks=1, time_step=TIME_STEP, end_time=0.05, more=()):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            super().__init__(test, [*pair.words(folder, time_step, end_time), *more], ranks)
        if pair.contact:
            self.gap = self.data["gap"][:, 0] / pair.length
            self.force = self.data["contact_force"][:, 0] / (pair.mass * pair.length)
        self.vectors = {}
        for name in ("displacement", "velocity", "acceleration"):
            values = self.data[name].reshape(len(self.time), -1, 3)  # samples, probes, x y z
            self.vectors[name] = values @ pair.turn / pair.length


def assert_same(test, found, reference, tolerance):
    """Every history within `tolerance` of the largest value of the reference; 0: the same bits."""
    test.assertGreater(reference.force.max(), 0, "the houses must touch")
    histories = [(name, found.vectors[name], values) for name, values in reference.vectors.items()]
    histories += [("gap", found.gap, reference.gap), ("force", found.force, reference.force)]
    for name, values, expected in histories:
        test.assertEqual(values.shape, expected.shape, name)
        test.assertLessEqual(abs(values - expected).max(), tolerance * abs(expected).max(), name)
