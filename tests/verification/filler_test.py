"""A joint filled with foam between a falling block and a wall, and between two blocks that fly into each other.

References: the motion of one mass under the filler's force, piece by piece in closed form (a parabola where the
force is constant, a harmonic motion where it is straight), with first loading, unloading, the next loading and,
faster, the stop where the filler is dense; for two blocks the same with their reduced mass.
"""
import math
import os
import tempfile
import unittest

import numpy
import scipy.io
import scipy.linalg

import program
from recorded import Recorded, assert_continues

MASS, GAP, PUSH = 1000.0, 0.1, 2.0  # kg, m, m/s2
TABLE = ((0.2, 6e3), (0.7, 9e3), (0.9, 3e4))  # strain, Pa, on 1 m2
UNLOADING = 6e5
STEP = 1e-5
LONG = 1e-11  # energy identity: tens of thousands of steps


def block(name, x0, *more, cells=1, low=False):
    """A rigid brick of 1 m3 and 1 t that can move."""
    return [f"-{name}_mesh", "tests/meshes/box.geo",
            f"-{name}_mesh_set", f"x0={x0},y0=-0.5,nx={cells},ny={cells},nz={cells}",
            f"-{name}_body_element", "hex8", f"-{name}_body_material", "stone", f"-{name}_rigid", "body", *more]


def filler(table=TABLE, unloading=UNLOADING, *more):
    text = ",".join(f"{strain}:{pressure}" for strain, pressure in table)
    return ["-contacts", "joint", "-joint_filler", text, "-joint_filler_unloading", unloading, *more]


def common(end, step=STEP, young=1e3):
    return ["-material_stone_young", young, "-material_stone_poisson", 0.2, "-material_stone_density", MASS,
            "-time_step", repr(step), "-end_time", repr(end), "-output_interval", repr(step), "-energy_interval", 1]


def dropped(speed, end, *more, step=STEP):
    """A block that a constant acceleration drives against a wall behind the filler."""
    return ["-structures", "block", *block("block", 0), *common(end, step), "-block_initial_velocity", f"{speed},0,0",
            "-block_gravity", f"{PUSH},0,0", *filler(), "-joint_secondary", "block:x_max",
            "-joint_primary", "wall", "-joint_gap", GAP, "-probes", "one", "-one_structure", "block",
            "-one_at", "0,-0.5,0", *more]


def colliding(*more, cells=(1, 1), speed=1.2, end=0.15, step=4 * STEP, models=("", ""), young=1e3, rigid=True):
    words = ["-structures", "left,right"]
    for name, x0, count in (("left", 0, cells[0]), ("right", 1 + GAP, cells[1])):
        scene = block(name, x0, cells=count)
        words += scene if rigid else [word for word in scene if word not in (f"-{name}_rigid", "body")]
    return [*words, *common(end, step, young), "-left_initial_velocity", f"{speed},0,0", *filler(),
            "-joint_secondary", "left:x_max", "-joint_primary", "right:x_min", "-probes", "l,r",
            "-l_structure", "left", "-l_at", "0,-0.5,0", "-r_structure", "right", "-r_at", f"{2 + GAP},-0.5,0", *more]


class Exact:
    """Motion d(t) of a mass that a constant acceleration drives into the filler, from d = 0."""

    def __init__(self, mass, push, speed, thickness=GAP, area=1.0, table=TABLE, unloading=UNLOADING):
        self.points = [(0.0, 0.0)] + [(e * thickness, p * area) for e, p in table]
        self.mass, self.push, self.k = mass, push, unloading * area / thickness
        self.crushed, self.deepest = 0.0, 0.0
        self.time, self.d, self.v = 0.0, 0.0, speed
        self.locks = []  # time and speed

    def first(self, d):
        d_, f_ = zip(*self.points)
        return float(numpy.interp(d, d_, f_))

    def piece(self):
        """Force and its slope at d now, and the d at which this law ends, above and below."""
        if self.d < self.crushed or (self.d == self.crushed and self.v <= 0):
            return 0.0, 0.0, self.crushed, -math.inf
        if self.d < self.deepest or self.v <= 0:
            return self.k * (self.d - self.crushed), self.k, self.deepest, self.crushed
        low, high = next((a, b) for a, b in zip(self.points, self.points[1:]) if self.d < b[0])
        slope = (high[1] - low[1]) / (high[0] - low[0])
        return low[1] + slope * (self.d - low[0]), slope, high[0], -math.inf

    def at(self, force, slope, t):
        a = self.push - force / self.mass
        if slope == 0:
            return self.d + self.v * t + a * t * t / 2, self.v + a * t
        w = math.sqrt(slope / self.mass)
        shift = a / w**2
        return (self.d + shift * (1 - math.cos(w * t)) + self.v / w * math.sin(w * t),
                shift * w * math.sin(w * t) + self.v * math.cos(w * t))

    def run(self, times):
        """d and v at increasing times."""
        found = []
        loading = self.v > 0
        i = 0
        while i < len(times):
            force, slope, above, below = self.piece()
            loading = self.v > 0 and slope != self.k and self.d >= self.crushed

            def over(t):
                d, v = self.at(force, slope, t)
                return d > above or d < below or (loading and v < 0)
            t, h = 0.0, 1e-4
            while not over(t + h) and self.time + t + h < times[-1] + h:
                t += h
            low, high = t, t + h
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (low, middle) if over(middle) else (middle, high)
            while i < len(times) and times[i] <= self.time + low:
                found.append(self.at(force, slope, times[i] - self.time))
                i += 1
            d, v = self.at(force, slope, high)
            self.time += high
            if abs(d - above) < 1e-9 and d >= above:
                d = above
            elif abs(d - below) < 1e-9 and d <= below:
                d = below
            self.d, self.v = d, v
            if loading:
                self.deepest = d
                if v <= 0:
                    self.crushed = d - self.first(d) / self.k
                    self.v = min(v, -1e-30)
                elif d == self.points[-1][0]:  # dense: it stops there
                    self.locks.append((self.time, v))
                    self.crushed = d - self.first(d) / self.k
                    self.v = -1e-30
        return numpy.array(found).T


class OneMass(unittest.TestCase):
    def test_loading_unloading_and_loading_again(self):
        run = Recorded(self, dropped(1.0, 0.8))
        exact = Exact(MASS, PUSH, 1.0)
        d, v = exact.run(run.time)
        x = run.displacement("one.x")
        self.assertLess(abs(x - d).max(), 1e-6 * d.max())
        # It came back twice: three loadings, of which the second and the third begin crushed.
        deep = (d[1:-1] > d[:-2]) & (d[1:-1] > d[2:])
        self.assertGreaterEqual(deep.sum(), 3)
        self.assertEqual(len(run.impacts["contact"]), 0)
        filler_ = run.summary["contacts"]["joint"]["filler"]
        self.assertAlmostEqual(filler_["area"], 1, delta=1e-12)
        self.assertAlmostEqual(filler_["peak_force"] / exact.first(d.max()), 1, delta=1e-6)
        self.assertAlmostEqual(filler_["peak_pressure"] / filler_["peak_force"], 1, delta=1e-12)
        self.assertAlmostEqual(filler_["crushed_strain"] * GAP / exact.crushed, 1, delta=1e-6)
        # All that the filler took is in the column of plastic work, and nothing else is there.
        self.assertAlmostEqual(filler_["energy_lost"] / run.energy["plastic"], 1, delta=1e-9)

    def test_order_of_accuracy(self):
        errors = []
        for step in (1e-3, 1e-5):
            run = Recorded(self, dropped(1.0, 0.3, step=step))
            d, _ = Exact(MASS, PUSH, 1.0).run(run.time)
            errors.append(abs(run.displacement("one.x") - d).max())
        self.assertGreater(errors[0] / errors[1], 1000, errors)  # 1e4 in second order, 1e2 in first

    def test_dense_filler_locks(self):
        speed = 2.0
        run = Recorded(self, dropped(speed, 0.3))
        exact = Exact(MASS, PUSH, speed)
        d, v = exact.run(run.time)
        (time, lock), = exact.locks[:1]
        x = run.displacement("one.x")
        self.assertLess(abs(x - d).max(), 1e-3 * d.max())
        self.assertLess(x.max(), 0.9 * GAP + 1.01 * STEP * lock)  # a step's way beyond dense at most
        self.assertEqual(len(run.impacts["contact"]), 1)
        self.assertAlmostEqual(float(run.impacts["start"][0]), time, delta=2 * STEP)
        self.assertAlmostEqual(float(run.impacts["impulse"][0]) / (MASS * lock), 1, delta=2e-3)
        self.assertAlmostEqual(float(run.impacts["energy_lost"][0]) / (MASS * lock**2 / 2), 1, delta=2e-3)
        # Momentum: that of the start, of the push, of the filler and of the stop.
        force = [exact.first(min(a, 0.9 * GAP)) for a in x]
        self.assertGreater(max(force), 2.9e4)

    def test_thinner_than_the_joint(self):
        """Half of the joint is air, the filler of half its thickness: the same force after 5 cm of free way."""
        half = GAP / 2
        run = Recorded(self, [*dropped(1.0, 0.15, step=2 * STEP), "-joint_filler_thickness", half, "-joint_filler_area", 4],
                       identity=LONG)
        # Half the thickness: each strain at half the way. Four times the area: four times the force.
        speed = math.sqrt(1 + 2 * PUSH * half)
        start = (speed - 1) / PUSH
        d, _ = Exact(MASS, PUSH, speed, half, 4).run(run.time[run.time > start] - start)
        x = run.displacement("one.x")[run.time > start]
        self.assertGreater(d.max(), 0.3 * half)
        inside = run.time[run.time > start] - start < 0.05
        self.assertLess(abs(x - half - d)[inside].max(), 2e-6 * d.max())


class TwoBlocks(unittest.TestCase):
    def check(self, run, speed=1.2):
        exact = Exact(MASS / 2, 0.0, speed)
        d, _ = exact.run(run.time)
        left, right = run.displacement("l.x"), run.displacement("r.x")
        self.assertLess(abs(left - right - d).max(), 1e-6 * d.max())
        momentum = run.velocity("l.x") + run.velocity("r.x")
        self.assertLess(abs(momentum - speed).max(), 1e-12 * speed)

    def test_matched_and_not(self):
        for cells, more in (((1, 1), ()), ((2, 3), ()), ((2, 3), ("-joint_passes", 2))):
            self.check(Recorded(self, colliding(*more, cells=cells)))

    def test_two_that_lock(self):
        speed, run = 3.0, Recorded(self, colliding(speed=3.0, end=0.1))
        exact = Exact(MASS / 2, 0.0, speed)
        exact.run(run.time)
        momentum = run.velocity("l.x") + run.velocity("r.x")
        self.assertLess(abs(momentum - speed).max(), 1e-12 * speed)
        self.assertEqual(len(run.impacts["contact"]), 1)
        lock = exact.locks[0][1]
        self.assertAlmostEqual(float(run.impacts["impulse"][0]) / (MASS / 2 * lock), 1, delta=2e-3)

    def test_stable_step(self):
        """Two free masses on the filler at its stiffest: 2 / sqrt(k (1/m + 1/m))."""
        words = colliding()
        at = words.index("-time_step")
        free = words[:at] + words[at + 2:]
        _, summary = program.must_run(self, free + ["-end_time", 1e-3])
        stiffness = UNLOADING / GAP
        self.assertAlmostEqual(summary["filler_time_step"] / (2 / math.sqrt(2 * stiffness / MASS)), 1, delta=1e-9)

    def test_stable_step_of_elastic_blocks(self):
        """Beside dense algebra of both blocks and the filler: on the safe side, by a tenth where it is about as stiff."""
        for young, least in ((1e7, 0.89), (1e9, 0.995)):
            words = colliding(rigid=False, young=young, end=1e-3)
            at = words.index("-time_step")
            words = words[:at] + words[at + 2:]
            _, summary = program.must_run(self, words)
            plain = [word for i, word in enumerate(words) if not str(word).startswith("-joint_filler") and
                     not str(words[i - 1]).startswith("-joint_filler")]
            with tempfile.TemporaryDirectory() as folder:
                program.must_run(self, [*plain, "-export_matrices", folder])
                blocks, rows, masses = [], [], []
                for name in ("left", "right"):
                    of = os.path.join(folder, name)
                    blocks.append(scipy.io.mmread(os.path.join(of, "stiffness.mtx")).toarray())
                    masses.append(scipy.io.mmread(os.path.join(of, "mass.mtx")).toarray().ravel())
                    rows.append(scipy.io.mmread(os.path.join(of, "contact.mtx")).toarray())
            stiffness = scipy.linalg.block_diag(*blocks)
            row = numpy.hstack(rows)
            self.assertEqual(len(row), 4)
            stiffness += row.T @ row * UNLOADING / GAP / 4  # a quarter of 1 m2 each
            root = numpy.sqrt(numpy.concatenate(masses))
            exact = 2 / math.sqrt(numpy.linalg.eigvalsh(stiffness / numpy.outer(root, root))[-1])
            self.assertLessEqual(summary["filler_time_step"], exact * (1 + 1e-9))
            self.assertGreater(summary["filler_time_step"] / exact, least)

    def test_reduced_is_full(self):
        words = colliding(rigid=False, young=1e7, speed=3.0, end=0.1, step=2e-5)
        full = Recorded(self, words)
        self.assertEqual(len(full.impacts["contact"]) > 0, True)
        reduced = Recorded(self, [*words, "-left_model", "modal", "-left_modal_vectors", 24])
        both = Recorded(self, [*words, "-left_model", "modal", "-left_modal_vectors", 24,
                               "-right_model", "modal", "-right_modal_vectors", 24])
        for other in (reduced, both):
            for channel in ("l.x", "r.x"):
                u = full.displacement(channel)
                self.assertLess(abs(other.displacement(channel) - u).max(), 1e-8 * abs(u).max())

    def test_continued(self):
        assert_continues(self, [*colliding(speed=3.0, end=0.06, cells=(2, 3)), "-spectra_frequencies", 10], 0.03, 333, 2)

    def test_put_in_at_rest(self):
        """Two blocks on clamped feet that lean towards each other under their weight: the filler does not press."""
        words = colliding("-left_clamp", "z_min", "-right_clamp", "z_min", "-left_initial_velocity", "0,0,0", "-left_gravity",
                          "2,0,0", "-right_gravity", "-2,0,0", "-preload", "static", "-l_at", "0,-0.5,1", "-r_at", f"{2 + GAP},-0.5,1",
                          rigid=False, young=1e6, end=0.05, step=1e-4)
        run = Recorded(self, words)
        for channel in ("l.x", "r.x"):
            u = run.displacement(channel)
            self.assertGreater(abs(u[0]), 1e-4)
            self.assertLess(abs(u - u[0]).max(), 1e-12)
        self.assertEqual(run.summary["contacts"]["joint"]["filler"]["peak_force"], 0)

    def test_strong_and_near_the_limit(self):
        """With a thousandth to the stable step the ledger closes and the filler takes energy."""
        words = colliding()
        at = words.index("-time_step")
        run = Recorded(self, [*words[:at], *words[at + 2:], "-courant", 0.999, "-output_interval", 1e-3,
                              "-energy_interval", 1])
        self.assertGreater(run.energy["plastic"], 0)


def two_groups(folder, name, x0, groups):
    """A brick of 1 m3 in Gmsh's format 2.2, which writes an element once for each of its groups: the face at its right or
    left in all of the groups given."""
    nodes = [(x0 + a, b, c) for c in (0, 1) for a, b in ((0, -0.5), (1, -0.5), (1, 0.5), (0, 0.5))]
    face = (2, 3, 7, 6) if x0 == 0 else (1, 5, 8, 4)
    elements = ["1 5 2 1 1 1 2 3 4 5 6 7 8", "2 3 2 2 2 1 4 3 2"]
    for i, _ in enumerate(groups):
        elements.append(f"{3 + i} 3 2 {3 + i} 3 " + " ".join(map(str, face)))
    names = ['3 1 "body"', '2 2 "base"', *(f'2 {3 + i} "{group}"' for i, group in enumerate(groups))]
    path = os.path.join(folder, f"{name}.msh")
    with open(path, "w") as file:
        file.write("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names,
                              "$EndPhysicalNames", "$Nodes", "8",
                              *(f"{i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(nodes)), "$EndNodes", "$Elements",
                              str(len(elements)), *elements, "$EndElements", ""]))
    return path


class Area(unittest.TestCase):
    """A filler has the area that its two faces have in common, once."""

    def area(self, *more):
        _, summary = program.must_run(self, colliding(*more, end=1e-3, step=1e-4))
        return summary["contacts"]["joint"]["filler"]["area"]

    def test_of_a_larger_face(self):
        """Cells of 1 m over 3 m x 3 m before a face of 1 m2: on one of them, or across four."""
        for y0, z0 in ((-1.5, -1), (-1.2, -1.3)):
            large = ["-right_mesh_set", f"x0={1 + GAP},y0={y0},z0={z0},ly=3,lz=3,ny=3,nz=3", "-r_at", f"{2 + GAP},{y0},{z0}"]
            sides = ["-joint_secondary", "right:x_min", "-joint_primary", "left:x_max"]
            for more in (sides, [*sides, "-joint_passes", 2], []):
                if (y0, more) == (-1.2, []):
                    continue
                self.assertAlmostEqual(self.area(*large, *more), 1, delta=1e-9)

    def test_of_a_face_in_two_groups(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            for groups in (["face"], ["face", "skin"], ["skin", "face", "outside"]):
                left = two_groups(folder, "left", 0, groups)
                right = two_groups(folder, "right", 1 + GAP, ["face"])
                words = [word for word in colliding(end=1e-3, step=1e-4) if "mesh" not in str(word) and
                         not str(word).startswith("x0=") and not str(word).endswith(".geo")]
                _, summary = program.must_run(self, [
                    *words, "-left_mesh", left, "-right_mesh", right, "-left_ignore",
                    ",".join({"base", *groups} - {"face"}), "-right_ignore", "base", "-joint_secondary", "left:face", "-joint_primary", "right:face"])
                self.assertAlmostEqual(summary["contacts"]["joint"]["filler"]["area"], 1, delta=1e-12, msg=groups)


class Refused(unittest.TestCase):
    def test_what_is_no_filler(self):
        for more, parts in (
                (("-joint_filler", "0.2"), ("-joint_filler", "strain:pressure")),
                (("-joint_filler", "0.2:5,0.1:6"), ("-joint_filler", "rise")),
                (("-joint_filler", "0.2:5,0.4:4"), ("-joint_filler", "fall")),
                (("-joint_filler", "0.2:5,1.4:6"), ("-joint_filler", "1 at most")),
                (("-joint_filler", "0.2:0"), ("-joint_filler", "never presses")),
                (("-joint_filler_unloading", 1e3), ("-joint_filler_unloading", "steeper")),
                (("-joint_filler_thickness", 0.2), ("contact joint", "less than its filler")),
                (("-joint_filler", "none"), ("-joint_filler_unloading", "not given")),
                (("-joint_gap", 0), ("contact joint", "no room")),
                (("-export_matrices", "nowhere"), ("-export_matrices", "filler"))):
            words = dropped(1.0, 1e-3)
            for name, value in zip(more[::2], more[1::2]):
                if name in words:
                    words[words.index(name) + 1] = value
                else:
                    words += [name, value]
            program.must_refuse(self, words, *parts)


ON_RANKS = {"a filler of faces that do not match": colliding(cells=(2, 3)),
            # Accelerations are differences of velocities over a step of 4e-5 s.
            "a filler in two passes, between elastic blocks": (
                colliding("-joint_passes", 2, cells=(2, 3), rigid=False, young=1e7, end=0.12), {"tolerance": 1e-11}),
            "a filler that locks": colliding(speed=3.0, end=0.06)}


if __name__ == "__main__":
    unittest.main()
