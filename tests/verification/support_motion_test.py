"""Supports that move on their own: viaducts, bars and a tower on parts of the ground.

Two supports with the motion of the ground give what the ground gives, with impacts, friction, links and every kind
of damping. What differs from that is compared with central differences of dense matrices in absolute coordinates,
with the loads K_fs (u_s + beta v_s) of the prescribed displacements, from the matrices that the program exports of
the structure without clamps; with gaps that close by hand; and with the rigid rotation of a tower.
"""
import math
import os
import tempfile
import unittest

import numpy
import scipy.io

import program
from decks import SECTION, SPAN, STEEL, braces, viaduct
from recorded import Recorded, assert_continues, assert_follows, write_samples, write_sine

class Pulse:
    """Acceleration of a smooth displacement that comes back to zero, along an axis."""

    def __init__(self, size, frequency, cycles=2):
        self.step, end = 1e-3, cycles / frequency
        t = self.step * numpy.arange(round(end / self.step) + 1)
        w, envelope = 2 * math.pi * frequency, math.pi / end
        # u = size sin^3(envelope t) sin(w t), its second derivative by terms of one frequency each
        terms = [(3 / 4, envelope), (-1 / 4, 3 * envelope)]
        a = sum(c / 2 * (-(w - e)**2 * numpy.cos((w - e) * t) + (w + e)**2 * numpy.cos((w + e) * t)) for c, e in terms)
        self.samples = size * a
        self.file = write_samples(self.samples, self.step)

    def at(self, t):
        return numpy.interp(t, self.step * numpy.arange(len(self.samples)), self.samples, left=0, right=0)

    def words(self, option):
        return [f"-{option}_record", self.file, f"-{option}_unit", "m/s2"]


class WithPulses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.x, cls.z = Pulse(0.02, 3.0), Pulse(0.004, 5.0)

    @classmethod
    def tearDownClass(cls):
        for pulse in (cls.x, cls.z):
            os.remove(pulse.file)

    def ground(self):
        return self.x.words("motion_x") + self.z.words("motion_z")


def probes(*named):
    words = ["-probes", ",".join(name for name, _, _ in named)]
    for name, structure, group in named:
        words += [f"-{name}_structure", structure, f"-{name}_group", group, f"-{name}_average", "false"]
    return words


class UniformMotion(WithPulses):
    """Two viaducts that pound: all supports move as the ground would."""
    END = 0.3
    LINKS = ["-a_bearings_dashpot", "1e5,1e5,1e5,0,0,0", *braces("b"), "-joint_filler", "0.3:1e4,0.8:5e4",
             "-joint_filler_unloading", 5e5, "-joint_filler_area", 0.6]

    def words(self, *more):
        return ["-structures", "a,b", *viaduct("a", 2, 0.0), *viaduct("b", 1, 12.0005), *STEEL, *SECTION,
                "-contacts", "joint", "-joint_secondary", "a:east", "-joint_primary", "b:west", "-joint_friction", 0.3,
                *probes(("pa", "a", "east"), ("pb", "b", "west"), ("fa", "a", "feet")), "-end_time", self.END,
                "-output_interval", 1e-3, *more]

    def on_supports(self):
        words = ["-supports", "one,two", "-one_groups", "a:foot0,b:feet", "-two_groups", "a:foot1,a:foot2"]
        for support in ("one", "two"):
            words += self.x.words(f"{support}_motion_x") + self.z.words(f"{support}_motion_z")
        return words

    def compare(self, *more, tolerance=1e-9):
        common = Recorded(self, self.words(*self.ground(), *more))
        moved = Recorded(self, self.words(*self.on_supports(), *more), identity=1e-11)
        self.assertGreater(sum(common.column("impulse")), 0, "it pounds")
        for axis in "xyz":
            foot = moved.displacement(f"fa.1.{axis}")
            self.assertEqual(abs(foot - moved.displacement(f"fa.3.{axis}")).max(), 0)
            scale = abs(common.displacement("pa.1.x")).max()
            for probe in ("pa.1", "pa.3", "pb.2"):
                difference = moved.displacement(f"{probe}.{axis}") - foot - common.displacement(f"{probe}.{axis}")
                self.assertLess(abs(difference).max(), tolerance * scale, (probe, axis))
        assert_follows(self, moved.force("joint"), common.force("joint"), 1e-6, "force")
        return moved

    def test_rayleigh_damping(self):
        moved = self.compare("-a_damping_alpha", 0.5, "-a_damping_beta", 2e-5, "-b_damping_alpha", 0.2, "-b_damping_beta", 1e-5)
        self.assertGreater(moved.energy["damping"], 0)

    def test_uniform_damping(self):
        self.compare("-a_damping_uniform", 0.03, "-a_damping_band", "1,200", "-b_damping_alpha", 0.2)

    def test_links_and_filler(self):
        moved = self.compare(*self.LINKS, "-b_damping_beta", 1e-5, "-stiffness", "element")
        self.assertGreater(moved.energy["devices"], 0)

    def test_bearings_that_yield(self):
        """What holds the deck along x is no linear element."""
        moved = self.compare("-a_bearings_yield_force", "5e3,5e3,0", "-a_bearings_hardening", 0.1)
        self.assertGreater(moved.energy["plastic"], 0)

    def test_rigid_deck_and_own_damping(self):
        self.compare("-a_diaphragm", "deck", "-b_piers_damping_beta", 1e-5, "-b_mass_scaling", 5e-5)

    def test_from_rest_under_gravity(self):
        moved = self.compare("-gravity", 9.81, "-preload", "static", "-a_p_delta", "true", "-a_damping_beta", 1e-5)
        self.assertLess(moved.displacement("pa.1.z")[0], -1e-4)

    def test_all_modes(self):
        self.compare("-a_model", "modal", "-a_modal_vectors", 10000, "-a_damping_beta", 1e-5)


class MovedDifferently(WithPulses):
    """The same viaducts on feet that a wave reaches one after the other."""
    words = UniformMotion.words
    END, LINKS = UniformMotion.END, UniformMotion.LINKS

    def on_supports(self):
        words = self.ground() + ["-supports", "s0,s1,s2,s3"]
        for i, group in enumerate(("a:foot0", "a:foot1", "a:foot2,b:foot0", "b:foot1")):
            words += [f"-s{i}_groups", group, f"-s{i}_delay", 0.02 * i, f"-s{i}_factor", f"{1 - 0.1 * i!r},1,1"]
        return words + self.z.words("s3_motion_y")

    def run_of(self, *more):
        """The ledger closes to round-off."""
        return Recorded(self, self.words(*self.on_supports(), *more), identity=1e-11)

    def compare(self, run, other, tolerance):
        for channel in ("pa.1.x", "pb.2.y", "pa.3.z"):
            assert_follows(self, run.displacement(channel), other.displacement(channel), tolerance, channel)

    BENDS = 2.1e11 * 4e-4  # N m2, of the piers about their local y
    KINDS = ([*LINKS, "-a_damping_beta", 1e-5],
             ["-b_piers_bending_skeleton_y", f"{2e4 / BENDS},2e4,{2e5 / BENDS},4e4", "-b_damping_beta", 1e-5],
             ["-a_bearings_yield_force", "5e3,5e3,0", "-b_diaphragm", "deck", "-a_damping_uniform", 0.03])

    def test_ledger(self):
        """Impacts, friction, dashpots, braces, a filler, bearings that yield, a rigid deck."""
        for more in self.KINDS:
            run = self.run_of(*more)
            self.assertGreater(run.energy["devices"] + run.energy["plastic"], 0)
        self.assertGreater(run.energy["friction"], 0)
        self.assertGreater(sum(run.column("impulse")), 0, "it pounds")

    def test_all_modes(self):
        """As the finite elements themselves, beside impacts and friction."""
        more = ["-a_damping_beta", 1e-5, "-time_step", 3e-5]
        full = self.run_of(*more)
        self.assertGreater(sum(full.column("impulse")), 0, "it pounds")
        self.compare(self.run_of(*more, "-a_model", "modal", "-a_modal_vectors", 10000), full, 1e-8)

    def test_continues(self):
        assert_continues(self, self.words(*self.on_supports(), *self.LINKS, "-a_damping_uniform", 0.03), 0.2, 3000)

    def test_without_a_difference_no_bit_changes(self):
        """Supports that go by the motion of the ground leave the run as it is without them."""
        plain = Recorded(self, self.words(*self.ground()))
        same = Recorded(self, self.words(*self.ground(), "-supports", "s", "-s_groups", "a:feet,b:feet"))
        for channel in ("pa.1.x", "pb.2.z"):
            self.assertTrue(numpy.array_equal(plain.velocity(channel), same.velocity(channel)))


class Tower(WithPulses):
    """A mass on a weightless column whose foot rocks about a point away from it: the top goes along as a rigid body,
    and on top of that as an oscillator under the inertia of that motion."""
    MASS, YOUNG, INERTIA, HEIGHT, POINT = 2000.0, 3e10, 1e-3, 8.0, (1.5, 0.0, -2.0)

    def rock(self, density, step, *foot):
        """The run with what holds its foot, and the tower's steps by hand for a stiffness of the top [N/m]: angle of
        the support, u of the top beside the rigid motion."""
        words = ["-structures", "t", "-t_mesh", "tests/meshes/cantilever.geo", "-t_mesh_set",
                 f"height={self.HEIGHT!r},n=1", *foot, "-t_stem_element", "beam", "-t_stem_material", "stuff",
                 "-t_stem_section", "pipe", "-material_stuff_young", self.YOUNG, "-material_stuff_poisson", 0.2,
                 "-material_stuff_density", density, "-section_pipe_area", 0.1, "-section_pipe_inertia_y", self.INERTIA,
                 "-section_pipe_inertia_z", self.INERTIA, "-section_pipe_torsion", self.INERTIA,
                 "-section_pipe_z_axis", "1,0,0", "-t_top_element", "point_mass", "-t_top_mass", self.MASS,
                 "-t_top_rotary_inertia", "1,1,1", "-supports", "s", "-s_rotation_y_record",
                 self.x.file, "-s_rotation_y_scale", 0.1, "-s_point", ",".join(map(repr, self.POINT)), "-time_step", step,
                 "-end_time", 1, "-output_interval", step, *probes(("top", "t", "top"), ("foot", "t", "base"))]
        run = Recorded(self, words)

        def by_hand(stiffness):
            u = v = angle = rate = 0.0
            exact = []
            for n in range(len(run.time)):
                exact.append((angle, u))
                h, turn = (step if n else step / 2), 0.1 * self.x.at(n * step)
                v += h * (-stiffness / self.MASS * u - self.up() * turn)
                rate += h * turn
                u, angle = u + step * v, angle + step * rate
            return numpy.array(exact).T
        return run, by_hand

    def up(self):
        return self.HEIGHT - self.POINT[2]

    def compliance(self):
        return self.HEIGHT**3 / (3 * self.YOUNG * self.INERTIA)

    def test_rocking(self):
        run, steps = self.rock(1e-3, 2e-4, "-t_clamp", "base", "-s_groups", "t:base")
        up, (angle, u) = self.up(), steps(1 / self.compliance())
        self.assertGreater(abs(u).max(), 0.1 * abs(up * angle).max())
        for found, by_hand, tolerance in (("top.x", up * angle + u, 2e-3), ("top.z", self.POINT[0] * angle, 5e-3),
                                          ("foot.x", -self.POINT[2] * angle, 1e-12),
                                          ("foot.z", self.POINT[0] * angle, 1e-12)):
            assert_follows(self, run.displacement(found), by_hand, tolerance, found)

    def test_rocking_on_springs(self):
        """The ground under a spring turns with the support; springs and column make the top less stiff. The foot goes
        where the column's shear and moment push it."""
        side, turn = 2e6, 1e8
        spring = [f"-t_base_{word}" for word in ("element", "stiffness")]
        run, steps = self.rock(10.0, 4e-5, spring[0], "grounded_spring", spring[1],
                               f"{side},{side},{side},{turn},{turn},{turn}", "-s_groups", "t")
        whole = self.compliance() + 1 / side + self.HEIGHT**2 / turn
        self.assertGreater(whole / self.compliance(), 1.15)
        up, (angle, u) = self.up(), steps(1 / whole)
        assert_follows(self, run.displacement("top.x"), up * angle + u, 1e-2, "top.x")
        foot = -self.POINT[2] * angle + u / whole / side
        assert_follows(self, run.displacement("foot.x"), foot, 1e-2, "foot.x")


def read_matrices(folder, structure):
    """Rows (position, component) of an exported structure, its K and the diagonal of its M."""
    where = os.path.join(folder, structure)
    with open(os.path.join(where, "dofs.csv")) as file:
        rows = [line.strip().split(",") for line in file if line[0] not in "#x"]
    dofs = [(*(round(float(v), 6) for v in row[:3]), row[3]) for row in rows]
    stiffness = scipy.io.mmread(os.path.join(where, "stiffness.mtx")).toarray()
    return dofs, stiffness, scipy.io.mmread(os.path.join(where, "mass.mtx")).toarray().ravel()


class DenseSteps:
    """Central differences in absolute coordinates: the rows of the feet are prescribed, u_s and v_s by the same
    steps from their accelerations; alpha brakes v - iota v_s, beta what the stiffness resists."""

    def __init__(self, test, words, alpha, beta):
        with tempfile.TemporaryDirectory() as folder:
            without = [word for i, word in enumerate(words) if "-v_clamp" not in (word, words[i - 1])]
            program.must_run(test, [*without, "-v_allow_loose", "true", "-export_matrices", folder, "-end_time", 1e-4,
                                    "-modes", 0], 1)
            self.dofs, stiffness, mass = read_matrices(folder, "v")
        self.alpha, self.beta = alpha, beta
        self.feet = [i for i, dof in enumerate(self.dofs) if dof[2] == 0]
        self.free = [i for i, dof in enumerate(self.dofs) if dof[2] != 0]
        self.inner = stiffness[numpy.ix_(self.free, self.free)]
        self.outer = stiffness[numpy.ix_(self.free, self.feet)]
        self.mass = mass[self.free]
        self.shape = -numpy.linalg.solve(self.inner, self.outer)

    def run(self, acceleration, dt, steps):
        """Absolute displacements of all rows at every step; `acceleration(t)`: of the feet's rows."""
        u, v = numpy.zeros(len(self.free)), numpy.zeros(len(self.free))
        us, vs = numpy.zeros(len(self.feet)), numpy.zeros(len(self.feet))
        history = numpy.zeros((steps, len(self.dofs)))
        for n in range(steps):
            history[n, self.free], history[n, self.feet] = u, us
            h = dt if n > 0 else dt / 2
            force = self.inner @ (u + self.beta * v) + self.outer @ (us + self.beta * vs)
            v = v - h * (force / self.mass + self.alpha * (v - self.shape @ vs))
            vs = vs + h * acceleration(n * dt)
            u, us = u + dt * v, us + dt * vs
        return history


class TravellingWave(WithPulses):
    """A viaduct of two spans: the motion of the ground reaches its piers one after the other, grows on the way, and
    the last foot moves along y by a record of its own, and rocks about a point beside it."""
    STEP, END, DELAYS, FACTORS = 4e-5, 0.3, (0.0, 0.04, 0.11), (1.0, 1.3, 0.7)
    POINT = (12.5, 0.4, -0.3)
    solutions = []

    def words(self, *more):
        return ["-structures", "v", *viaduct("v", 2, 0.0), *STEEL, *SECTION, *self.ground(), "-time_step", self.STEP,
                "-end_time", self.END, *more]

    def on_supports(self):
        words = ["-supports", "s0,s1,s2"]
        for i in range(3):
            words += [f"-s{i}_groups", f"v:foot{i}", f"-s{i}_delay", self.DELAYS[i],
                      f"-s{i}_factor", ",".join([repr(self.FACTORS[i])] * 3)]
        words += self.x.words("s2_motion_y") + ["-s2_motion_y_scale", 0.5]
        for axis, scale in (("x", 0.03), ("y", -0.05), ("z", 0.02)):
            words += [f"-s2_rotation_{axis}_record", self.z.file, f"-s2_rotation_{axis}_scale", scale]
        return words + ["-s2_point", ",".join(map(repr, self.POINT)), "-output_interval", 2e-4,
                        *probes(("deck", "v", "deck"), ("feet", "v", "feet"))]

    def acceleration(self, dofs):
        """Of the rows of the feet, absolute."""
        def at(t):
            turn = self.z.at(t) * numpy.array([0.03, -0.05, 0.02])
            result = []
            for x, y, z, component in dofs:
                i = round(x / SPAN)
                late, factor = t - self.DELAYS[i], self.FACTORS[i]
                a = factor * numpy.array([self.x.at(late), 0.0, self.z.at(late)])
                rotation = turn if i == 2 else numpy.zeros(3)
                if i == 2:
                    a[1] = 0.5 * self.x.at(t)
                a = a + numpy.cross(rotation, numpy.array([x, y, z]) - self.POINT)
                result.append({"u": a, "r": rotation}[component[0]]["xyz".index(component[1])])
            return numpy.array(result)
        return at

    def exact(self, alpha, beta):
        """Dense steps, taken once."""
        if not self.solutions:
            dense = DenseSteps(self, self.words(), alpha, beta)
            history = dense.run(self.acceleration([dense.dofs[i] for i in dense.feet]), self.STEP,
                                round(self.END / self.STEP) + 1)
            self.solutions.append((dense, history[::5]))
        return self.solutions[0]

    def check(self, *more, alpha=0.6, beta=5e-6, tolerance=1e-9):
        damping = ["-v_damping_alpha", alpha, "-v_damping_beta", beta]
        run = Recorded(self, self.words(*self.on_supports(), *damping, *more))
        dense, exact = self.exact(alpha, beta)
        ground = {"x": self.x, "y": None, "z": self.z}
        for axis in "xyz":
            u, v = 0.0, 0.0
            moved = numpy.zeros(len(exact) * 5)
            for n in range(len(moved) if ground[axis] else 0):  # of the ground itself, by the same steps
                moved[n] = u
                v += (self.STEP if n else self.STEP / 2) * ground[axis].at(n * self.STEP)
                u += self.STEP * v
            for probe in ("deck", "feet"):
                for position, name in zip(*run.nodes(probe)):
                    row = dense.dofs.index((*(round(float(x), 6) for x in position), "u" + axis))
                    found = run.displacement(f"{name}.{axis}")
                    difference = found + moved[::5][:len(found)] - exact[:len(found), row]
                    self.assertLess(abs(difference).max(), tolerance * abs(exact).max(), (name, axis))
        self.assertGreater(abs(run.energy["input"]), 0)
        return run

    def test_against_dense_steps(self):
        self.check()

    def test_element_by_element_and_with_all_modes(self):
        self.check("-stiffness", "element")
        self.check("-v_model", "modal", "-v_modal_vectors", 10000)

    def test_repeats_and_restarts(self):
        words = self.words(*self.on_supports(), "-v_damping_beta", 5e-6, "-end_time", 0.2)
        runs = [Recorded(self, words, 2) for _ in range(2)]
        for channel in ("deck.1.x", "deck.5.y", "deck.7.z", "feet.3.x"):
            self.assertTrue(numpy.array_equal(*(run.velocity(channel) for run in runs)), channel)
        assert_continues(self, words, 0.15, 2500)


class SoilUnderOneFoot(WithPulses):
    """Two feet on a support of their own, the third on soil, whose ground moves as `motion` says."""
    END = 0.3

    def run_of(self, *more):
        return Recorded(self, ["-structures", "v", *viaduct("v", 2, 0.0), *STEEL, *SECTION, *self.ground(), "-end_time", self.END,
                               "-time_step", 1e-5, "-output_interval", 1e-3, *probes(("deck", "v", "deck"), ("feet", "v", "feet")),
                               *more], identity=1e-11)

    def moved(self, *more):
        return self.run_of("-supports", "s,still", "-s_groups", "v:foot0,v:foot1", "-s_delay", 0.02, "-s_factor", "1,1,0.5",
                           *self.z.words("s_motion_y"), "-s_rotation_y_record", self.z.file, "-s_rotation_y_scale", 0.05,
                           "-s_point", "4,0.5,-1", *more)

    def soil(self, speed):
        return ["-supports", "s", "-v_clamp", "foot0,foot1", "-v_soil_mat", "foot2", "-v_soil_size", "2,2", "-v_soil_vs", speed,
                "-v_soil_density", 1900, "-v_soil_poisson", 0.35]

    def test_stiff_soil_is_a_clamp(self):
        clamped = self.moved("-still_groups", "v:foot2")
        apart = [abs(clamped.displacement(channel) - run.displacement(channel)).max() / abs(clamped.displacement("deck.1.x")).max()
                 for run in (self.moved(*self.soil(2000)), self.moved(*self.soil(500)))
                 for channel in ("deck.1.x", "deck.5.y", "deck.7.z")]
        self.assertLess(max(apart[:3]), 0.01, apart)
        self.assertGreater(max(apart[3:]), 4 * max(apart[:3]), "soft soil gives way")

    def test_all_modes(self):
        soil = self.soil(150)
        full, modes = self.moved(*soil), self.moved(*soil, "-v_model", "modal", "-v_modal_vectors", 10000)
        for channel in ("deck.1.x", "deck.5.y", "deck.7.z"):
            assert_follows(self, modes.displacement(channel), full.displacement(channel), 1e-8, channel)

    def test_moved_alike_it_is_a_ground(self):
        soil = self.soil(150)
        alike = [*soil, "-s_groups", "v:foot0,v:foot1", *self.x.words("s_motion_x"), *self.z.words("s_motion_z")]
        moved, still = self.run_of(*alike), self.run_of(*soil[2:])
        for channel in ("deck.1.x", "deck.7.z"):
            assert_follows(self, moved.displacement(channel), still.displacement(channel), 1e-8, channel)


class AllGround(WithPulses):
    """A structure named without a group: what is clamped and the ground of its springs, dashpots and soil move with
    the support."""
    END = 0.3

    def viaduct(self, groups, *more):
        words = ["-structures", "v", *viaduct("v", 2, 0.0), *STEEL, *SECTION, *self.ground(), "-end_time", self.END,
                 "-supports", "s", "-s_groups", groups, "-s_delay", 0.02, "-s_factor", "1,1,0.5",
                 *self.z.words("s_motion_y"), "-s_rotation_y_record", self.z.file, "-s_rotation_y_scale", 0.05,
                 "-s_point", "4,0.5,-1", "-output_interval", 1e-3, *probes(("deck", "v", "deck"), ("feet", "v", "feet"))]
        return words + list(more)

    def test_clamped_feet_alone(self):
        """No other way than naming the feet: the shapes that were solved for are rigid motions."""
        for more in (["-v_damping_alpha", 0.5, "-v_damping_beta", 1e-5], braces("v"),
                     ["-v_bearings_dashpot", "1e5,1e5,1e5,0,0,0", "-v_damping_uniform", 0.03],
                     ["-v_bearings_yield_force", "5e3,5e3,0", "-v_bearings_hardening", 0.1],
                     ["-v_model", "modal", "-v_modal_vectors", 10000, "-v_damping_beta", 1e-5]):
            feet = Recorded(self, self.viaduct("v:feet", *more))
            whole = Recorded(self, self.viaduct("v", *more))
            for channel in ("deck.1.x", "deck.5.y", "deck.7.z", "feet.3.x", "feet.3.z"):
                assert_follows(self, whole.displacement(channel), feet.displacement(channel), 1e-9, channel)

    def plant(self, *more):
        """The plant on layered soil, its joint of 1 mm: a mat of soil with internal masses, springs at nodes, dashpots
        over walls, no clamp."""
        return ["-options_file", "petsc-options/plant/layered_soil.yaml", "-block_mesh_set", "m=1", "-frame_mesh_set",
                "m=1,x0=24.801", "-floor1_gap", 1e-3, "-floor2_gap", 1e-3, "-end_time", 0.4, "-output_interval", 1e-3,
                "-motion_y_record", "none", "-motion_z_record", "none", "-motion_x_pga", 0, "-supports", "none", *more]

    FORCES = ["-forces", "base,springs", "-base_kind", "reactions", "-base_structure", "frame", "-springs_kind",
              "members", "-springs_structure", "frame", "-springs_group", "soil", "-springs_at",
              "30.897,12.192,0; 36.993,12.192,0"]

    def on_two(self):
        words = ["-motion_x_record", "none", "-supports", "one,two", "-one_groups", "block", "-two_groups", "frame"]
        return words + self.x.words("one_motion_x") + self.x.words("two_motion_x")

    def compare(self, *more):
        common = Recorded(self, self.plant(*self.x.words("motion_x"), *more), identity=1e-10)
        moved = Recorded(self, self.plant(*self.on_two(), *more), identity=1e-10)
        self.assertGreater(sum(common.column("impulse")), 0, "it pounds")
        for roof, mat in (("tower_roof", "block_mat"), ("frame_roof", "frame_mat")):
            found, wanted = (run.displacement(f"{roof}.x") - run.displacement(f"{mat}.x") for run in (moved, common))
            assert_follows(self, found, wanted, 1e-7, roof)
        assert_follows(self, moved.force("floor1") + moved.force("floor2"), common.force("floor1") + common.force("floor2"),
                       1e-6, "force")
        for item in ("base", "springs") if "-forces" in more else ():
            assert_follows(self, moved.members(item), common.members(item), 1e-6, item)

    def test_springs_dashpots_and_soil(self):
        self.compare(*self.FORCES)

    def test_soil_that_only_presses(self):
        self.compare("-frame_soil_compression_only", "true", "-gravity", 9.81, "-preload", "static")

    def test_reduced(self):
        self.compare("-block_model", "modal", "-block_modal_vectors", 40, "-frame_model", "modal",
                     "-frame_modal_vectors", 40)

    def test_continues(self):
        assert_continues(self, self.plant(*self.x.words("motion_x"), "-supports", "one", "-one_groups", "block",
                                          "-one_delay", 0.03), 0.3, 2000)

    EMBEDDED = ["-supports", "s", "-s_groups", "v", "-s_embedment", 5, "-s_vs", 300, "-s_half_width", 9, "-s_point",
                "3,0,0"]

    def test_a_point_elsewhere_is_doubted(self):
        for point, doubted in (("3,0,0", False), ("30,0,0", True), ("3,0,-5", True)):
            done = program.run(["-structures", "v", *viaduct("v", 1, 0.0), *STEEL, *SECTION, *self.ground(), "-end_time",
                                1e-3, "-dry_run", *self.EMBEDDED[:-1], point])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("outside of structure v" in done.stdout + done.stderr, doubted, point)

    def test_mistakes(self):
        for more, part in ((["-supports", "s", "-s_groups", "v,v:feet"], "means all ground"),
                           (["-supports", "s,t", "-s_groups", "v:feet", "-t_groups", "v"], "means all ground"),
                           (["-supports", "s", "-s_groups", "v,v"], "is on a support already"),
                           (["-supports", "s", "-s_groups", "v:"], "neither structure:group nor a structure"),
                           (["-supports", "s", "-s_groups", "viaduct"], "there is no structure 'viaduct'"),
                           (["-supports", "s", "-s_groups", "v", "-s_vs", 300], "goes with -s_embedment"),
                           ([*self.EMBEDDED, "-gravity", 9.81, "-preload", "static", "-v_p_delta", "true"],
                            "its weight would not turn with its ground"),
                           ([*self.EMBEDDED, "-motion_x_record", "none"], "there is no -motion_x or -motion_y"),
                           ([*self.EMBEDDED, "-s_vs", 0.3], "is it in m/s"), (self.EMBEDDED[:-2], "s_point"), ([*self.EMBEDDED, "-s_delay", 0.1], "not with -s_embedment"),
                           ([*self.EMBEDDED, *self.x.words("s_motion_x")], "follows from that of the surface")):
            program.must_refuse(self, ["-structures", "v", *viaduct("v", 1, 0.0), *STEEL, *SECTION, *self.ground(),
                                       "-end_time", 1e-3, *more], part)


class Embedded(unittest.TestCase):
    """A foundation 8 m below a surface that moves as a sine along x and y: where it stands against the surface, by the
    published factors and by the rule for a rigid body that turns about its underside."""
    DEPTH, VELOCITY, HALF, POINT = 8.0, 320.0, 12.0, (0.0, 0.0, -8.0)

    def test_foot_of_a_column(self):
        for frequency in (2.0, 6.5, 12.0):
            path = write_sine(1.0, frequency, 6.0, 1e-3)
            try:
                run = Recorded(self, ["-structures", "t", "-t_mesh", "tests/meshes/cantilever.geo", "-t_mesh_set",
                                      "height=8.0,n=2", "-t_clamp", "base", "-t_stem_element", "beam", "-t_stem_material",
                                      "steel", "-t_stem_section", "leg", *STEEL, *SECTION, "-t_ignore", "top",
                                      "-motion_x_record", path, "-motion_y_record", path, "-motion_y_scale", 2,
                                      "-motion_x_unit", "m/s2", "-motion_y_unit", "m/s2",
                                      "-supports", "s", "-s_groups", "t", "-s_embedment", self.DEPTH, "-s_vs",
                                      self.VELOCITY, "-s_half_width", self.HALF, "-s_point",
                                      ",".join(map(repr, self.POINT)), "-time_step", 1e-4, "-end_time", 6,
                                      "-output_interval", 1e-3, *probes(("foot", "t", "base"))])
            finally:
                os.remove(path)
            a0 = 2 * math.pi * frequency * self.DEPTH / self.VELOCITY
            along, about = math.cos(min(a0, 1.1)), 0.26 / self.HALF * (1 - math.cos(min(a0, math.pi / 2)))
            arm = -self.POINT[2]
            steady = (run.time > 2) & (run.time < 5)
            surface = numpy.sin(2 * math.pi * frequency * run.time[steady]) * -1 / (2 * math.pi * frequency)**2
            for axis, scale in (("x", 1), ("y", 2)):
                found = run.displacement(f"foot.{axis}")[steady]
                wanted = scale * (along - 1 + about * arm) * surface
                t = run.time[steady]
                found = found - numpy.polyval(numpy.polyfit(t, found - wanted, 1), t)  # what the start left
                self.assertLess(abs(found - wanted).max(), 3e-3 * scale * abs(surface).max(), (frequency, axis))


class DisplacementRecords(unittest.TestCase):
    """The foot of a column that settles by 50 mm along x within a second, as a record of its displacement has it."""
    WAY, STEP = 0.05, 5e-3

    def place(self, t):
        return self.WAY * numpy.where(t < 1, t - numpy.sin(2 * math.pi * t) / (2 * math.pi), 1)

    def run_of(self, text, unit, *more):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(text)
            file.flush()
            return Recorded(self, self.words(file.name, unit, *more))

    def words(self, path, unit, *more):
        return ["-structures", "t", "-t_mesh", "tests/meshes/cantilever.geo", "-t_mesh_set", "height=8.0,n=2", "-t_clamp",
                "base", "-t_stem_element", "beam", "-t_stem_material", "steel", "-t_stem_section", "leg", *STEEL, *SECTION,
                "-t_ignore", "top", "-supports", "s", "-s_groups", "t:base", "-s_motion_x_record", path, "-s_motion_x_unit",
                unit, "-time_step", 1e-4, "-end_time", 2, "-output_interval", self.STEP,
                *probes(("foot", "t", "base"), ("top", "t", "top")), *more]

    def rows(self, values, step):
        return "".join(f"{i * step:.4f} {value:.17g}\n" for i, value in enumerate(values))

    def test_the_support_goes_through_its_samples_and_stays(self):
        times = self.STEP * numpy.arange(201)
        by_units = [self.run_of(head + self.rows(factor * self.place(times) + shift, self.STEP), unit, *more)
                    for head, unit, factor, shift, more in (("", "m", 1, 0, ()), ("# Displacement [mm]\n", "mm", 1e3, 20, ()),
                                                            ("", "cm", -50, 0, ("-s_motion_x_scale", -2)))]
        run = by_units[0]
        self.assertLess(abs(run.displacement("foot.x") - self.place(run.time)).max(), 1e-6 * self.WAY)
        for other in by_units[1:]:
            self.assertLess(abs(other.displacement("top.x") - run.displacement("top.x")).max(), 1e-9 * self.WAY)
        fine = 1e-3 * numpy.arange(1001)
        acceleration = self.rows(self.WAY * 2 * math.pi * numpy.sin(2 * math.pi * fine), 1e-3)
        reference = self.run_of(acceleration, "m/s2")
        top = reference.displacement("top.x")
        self.assertLess(abs(run.displacement("top.x") - top).max(), 1e-4 * self.WAY)

    def test_mistakes(self):
        rows = self.rows(self.place(self.STEP * numpy.arange(201)), self.STEP)
        for text, unit, more, part in ((rows, "m", ("-s_motion_x_pga", 3), "takes a scale"),
                                       ("# acceleration\n" + rows, "m", (), "speaks of acceleration or velocity"),
                                       ("# velocity [m/s]\n" + rows, "mm", (), "speaks of acceleration or velocity"),
                                       ("# units: g\n" + rows, "cm", (), "the header says g"),
                                       ("# displacement [m]\n" + rows, "m/s2", (), "give an accelerogram")):
            with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
                file.write(text)
                file.flush()
                program.must_refuse(self, self.words(file.name, unit, *more), part)


class MovedApart(unittest.TestCase):
    """Two bars on the x axis, each held at its outer end by a support of its own; the gap between them closes."""
    YOUNG, DENSITY, LENGTH, GAP = 2e9, 2000.0, 1.0, 2e-3

    def words(self, *more):
        words = ["-structures", "a,b", "-supports", "sa,sb", "-sa_groups", "a:x_min", "-sb_groups", "b:x_max",
                 "-material_stuff_young", self.YOUNG, "-material_stuff_poisson", 0.0,
                 "-material_stuff_density", self.DENSITY, "-contacts", "joint", "-joint_secondary", "a:x_max",
                 "-joint_primary", "b:x_min"]
        for name, x0, end in (("a", 0.0, "x_min"), ("b", self.LENGTH + self.GAP, "x_max")):
            words += [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_mesh_set",
                      f"x0={x0!r},lx={self.LENGTH!r},ly=0.2,lz=0.2,nx=10", f"-{name}_clamp", end,
                      f"-{name}_body_element", "hex8", f"-{name}_body_material", "stuff"]
        return words + list(more)

    def approach(self, acceleration, step, *more):
        """Support b comes towards a by this acceleration."""
        path = write_samples(-acceleration / 2, step)
        other = write_samples(acceleration / 2, step)
        try:
            return Recorded(self, self.words("-sb_motion_x_record", path, "-sb_motion_x_unit", "m/s2",
                                             "-sa_motion_x_record", other, "-sa_motion_x_unit", "m/s2", *more))
        finally:
            os.remove(path)
            os.remove(other)

    def test_instant_of_the_impact(self):
        """Supports that begin to approach smoothly, at first as a t^3: the bars follow as rigid ones but for their own
        delay, a second order of what they deform by."""
        step, rate = 1e-3, 0.5  # m/s3
        times = step * numpy.arange(401)
        closing = (6 * self.GAP / rate)**(1 / 3)  # rate t^3 / 6 = gap
        run = self.approach(rate * times, step, "-end_time", 1.05 * closing, "-output_interval", 1e-4)
        lag = self.DENSITY * self.LENGTH**2 / (2 * self.YOUNG) * rate * closing  # u = rho a L^2 / 2E, both bars
        speed = rate * closing**2 / 2
        self.assertAlmostEqual(run.column("start")[0], closing + lag / speed, delta=3 * run.time_step)
        self.assertGreater(closing, 100 * run.time_step)

    def test_force_of_a_gap_that_stays_closed(self):
        """Supports that end 5 mm nearer to each other press the bars by E A / 2L times what the gap falls short of
        that."""
        step, end, way = 1e-3, 0.2, 5e-3
        t = step * numpy.arange(round(end / step) + 1)
        w = 2 * math.pi / end
        run = self.approach(way / end * w * numpy.sin(w * t), step, "-a_damping_alpha", 300, "-b_damping_alpha", 300,
                            "-end_time", 0.6, "-output_interval", 1e-3)
        behind = run.summary["impacts"]["max_penetration"]  # where the faces stand since they met
        self.assertLess(behind, 5e-6)
        exact = self.YOUNG * 0.2**2 / (2 * self.LENGTH) * (way - self.GAP - behind)
        self.assertAlmostEqual(run.plateau("joint", 0.55, 0.6) / exact, 1, delta=3e-4)


def moved_differently(kind, end=0.15):
    """Words of the viaducts on feet that a wave reaches one after the other."""
    MovedDifferently.setUpClass()
    problem = MovedDifferently()
    return problem.words(*problem.on_supports(), *problem.KINDS[kind], "-end_time", end)


def wave():
    """Words of a viaduct whose feet move by delays, factors, records and rotations of their own."""
    TravellingWave.setUpClass()
    problem = TravellingWave()
    return problem.words(*problem.on_supports(), "-v_damping_beta", 5e-6, "-end_time", 0.15)


# Accelerations are differences of velocities over a step of 4e-5 s.
ON_RANKS = {"viaducts on moved feet, with links": (lambda: moved_differently(0), {"tolerance": 1e-10}),
            "viaducts on moved feet, that yield": (lambda: moved_differently(1), {"tolerance": 1e-10}),
            "viaducts on moved feet, with a rigid deck": (lambda: moved_differently(2), {"tolerance": 1e-10}),
            "a viaduct that a wave reaches": (wave, {"tolerance": 1e-10})}


if __name__ == "__main__":
    unittest.main()
