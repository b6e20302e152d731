"""Ties of parts whose meshes do not match, beside dense algebra, closed forms and meshes that match.

What follows is u_s = B u of the face, B written here by hand for a grid of squares: shares of the corners, the turn of
the face where there is a distance or the node turns, the bulge of edges that turn; all of them at the place of the node,
or as means over its cells with the shares dual to its own, which on a grid are products of those along its lines. T has B
in the rows of what follows.
"""
import unittest

import numpy
import scipy.sparse
import scipy.sparse.csgraph

import program
from decks import box_of, clock, contacts, in_modes, material, probes, section
from recorded import Recorded, all_nodes, assert_continues, write_sine
from rigid_groups_test import Dense

GRAVITY = 9.81
YOUNG, POISSON, DENSITY = 30e9, 0.2, 2400.0
CONCRETE = ["-material_c_young", YOUNG, "-material_c_density", DENSITY]
BRICKS = ["-structures", "t", "-t_mesh", "tests/meshes/tied_blocks.geo", "-t_first_element", "hex8",
          "-t_first_material", "c", "-t_second_element", "hex8", "-t_second_material", "c", *CONCRETE,
          "-material_c_poisson", POISSON]
THICKNESS = ["-t_first_thickness", 0.2, "-t_second_thickness", 0.3]
PLATES = [{"hex8": "shell"}.get(word, word) for word in BRICKS] + THICKNESS
MIXED = BRICKS[:8] + [{"hex8": "shell"}.get(word, word) for word in BRICKS[8:]] + THICKNESS[2:]
HELD = ["-t_clamp", "x_min"]
TIE = ["-t_tie", "edge:face"]
STEEL = [*material("steel", 200e9, 0.3, 7800), *section("tube", 1e-2, 1e-5, 1e-5, 1e-5, "0,0,1")]


def mesh(**parameters):
    return ["-t_mesh_set", ",".join(f"{name}={value}" for name, value in parameters.items())]


def along(x, cells):
    """Corners of the cells of the unit interval that hold x, or of the nearest, with shares, slopes and bulges."""
    x = min(max(x, 0.0), 1.0)
    found = [(cell, x * cells - cell) for cell in range(cells) if -1e-9 <= x * cells - cell <= 1 + 1e-9]
    rows = {}
    for cell, s in found:
        bulge = 4 * s * (1 - s) / 8 / cells
        for corner, values in ((cell, (1 - s, -cells, bulge)), (cell + 1, (s, cells, -bulge))):
            rows[corner] = rows.get(corner, 0) + numpy.array(values) / len(found)
    return rows


def means(nodes, cells):
    """The same as means over the intervals between `nodes`, what these bend taken off; and how much of each is covered."""
    points, weights = numpy.polynomial.legendre.leggauss(6)
    rows = [{} for _ in nodes]
    covered, whole = numpy.zeros(len(nodes)), numpy.zeros(len(nodes))
    for a in range(len(nodes) - 1):
        low, high = nodes[a], nodes[a + 1]
        whole[a:a + 2] += (high - low) / 2
        cuts = sorted({max(low, 0.0), min(high, 1.0), *[c / cells for c in range(cells + 1) if low < c / cells < high]})
        cuts = [cut for k, cut in enumerate(cuts) if k == 0 or cut - cuts[k - 1] > 1e-9]
        x = numpy.concatenate([(c + d + (d - c) * points) / 2 for c, d in zip(cuts, cuts[1:])])
        w = numpy.concatenate([(d - c) * weights / 2 for c, d in zip(cuts, cuts[1:])])
        shares = numpy.array([high - x, x - low]) / (high - low)
        dual = numpy.diag(shares @ w) @ numpy.linalg.solve(shares * w @ shares.T, shares)
        for i in (0, 1):
            covered[a + i] += dual[i] @ w
            for place, weight in zip(x, w * dual[i]):
                for corner, values in along(place, cells).items():
                    rows[a + i][corner] = rows[a + i].get(corner, 0) + weight * values
            bent = (w * dual[i]) @ (4 * shares[0] * shares[1]) * (high - low) / 8
            for end, sign in ((low, -1), (high, 1)):
                for corner, values in along(end, cells).items():
                    rows[a + i][corner] = rows[a + i].get(corner, 0) + numpy.array([0, 0, sign * bent * values[0]])
    return [{c: values / size for c, values in row.items()} for row, size in zip(rows, covered)], covered / whole


class Tied(Dense):
    """T of two parts that lie behind each other, see tied_blocks.geo; `face` is that of solids, or an edge of shells."""

    def __init__(self, case, arguments, cells, solid):
        self.cells, self.solid = cells, solid
        super().__init__(case, [*arguments, "-t_allow_loose", "true"], None)

    def admit(self, _):
        first = self.in_first()
        places = numpy.round(self.place, 9)
        face, edge = places[first][:, 0].max(), places[~first][:, 0].min()
        index = {(*places[i], self.component[i]): i for i in numpy.flatnonzero(first)}
        self.followers = numpy.flatnonzero(~first & (places[:, 0] == edge))
        alone = numpy.setdiff1d(numpy.arange(len(first)), self.followers)
        column = {i: k for k, i in enumerate(alone)}
        self.find_means()
        self.motions = numpy.zeros((len(first), len(alone)))
        self.motions[alone, numpy.arange(len(alone))] = 1
        for i in self.followers:
            x = self.place[i]
            arm = x - [face, *numpy.clip(x[1:], 0, 1)] if self.solid else x - [face, min(max(x[1], 0), 1), x[2]]
            for j, value in self.row(x, self.component[i], face, index, arm).items():
                self.motions[i, column[j]] += value
        self.reduced_stiffness = self.motions.T @ self.stiffness @ self.motions
        self.reduced_mass = self.motions.T @ (self.mass[:, None] * self.motions)

    def in_first(self):
        """Dofs of the part that K joins with those next to the clamped end."""
        order = [("x", "y", "z", "rx", "ry", "rz").index(c) for c in self.component]
        node = numpy.cumsum([i == 0 or order[i] <= order[i - 1] for i in range(len(order))]) - 1
        joined = scipy.sparse.coo_matrix(self.stiffness)
        graph = scipy.sparse.coo_matrix((numpy.ones(joined.nnz), (node[joined.row], node[joined.col])))
        _, part = scipy.sparse.csgraph.connected_components(graph)
        return part[node] == part[node[numpy.argmin(self.place[:, 0])]]

    def find_means(self):
        """Rows of means along y and along z; none along z of an edge, and none at all of an edge that follows a face."""
        self.lines = [sorted({round(x, 9): x for x in self.place[self.followers][:, d]}.items()) for d in (1, 2)]
        self.means = [means([x for _, x in line], self.cells) if len(line) > 1 else None for line in self.lines]
        self.by_means = self.means[0] is not None and (self.means[1] is not None) == self.solid

    def along_both(self, x):
        """Corners along y and along z that a node at x follows, and the bulges of an edge."""
        places = [along(x[1], self.cells), along(x[2], self.cells) if self.solid else {0: (1, 0, 0)}]
        if not self.by_means:
            return places
        at = [[place for place, _ in self.lines[d]].index(round(x[d + 1], 9)) for d in (0, 1)]
        covered = self.means[0][1][at[0]] * (self.means[1][1][at[1]] if self.solid else 1)
        if covered < 0.5:
            return places
        return [self.means[d][0][at[d]] if self.means[d] else places[d] for d in (0, 1)]

    def row(self, x, component, face, index, arm):
        """What a node at x follows, for its distance `arm` from the face."""
        across, up = self.along_both(x)
        result = {}

        def add(y, z, name, value):
            if value != 0:
                place = index.get((face, round(y / self.cells, 9), round(z / self.cells, 9), name))
                result[place] = result.get(place, 0.0) + value

        for j, (share_y, slope_y, bulge) in across.items():
            if not self.solid and component == "z":  # the edge bends out of its plane by its ends' turns
                add(j, x[2], "rx", bulge)
            for k, (share_z, slope_z, _) in up.items():
                for name, value in self.terms(component, share_y * share_z, slope_y * share_z, share_y * slope_z, arm):
                    add(j, k, name, value)
        return result

    def terms(self, component, n, dy, dz, arm):
        """Components of one corner of the face that a component gets, with their factors."""
        if not self.solid:
            turn = {axis: [("r" + axis, n)] for axis in "xyz"}
        else:  # omega x r: its gradient along the face has them all
            turn = {"x": [("z", dy / 2), ("y", -dz / 2)], "y": [("x", dz)], "z": [("x", -dy)]}
        if component.startswith("r"):
            return turn[component[1]]
        d = dict(zip("xyz", arm))
        first, second = {"x": ("y", "z"), "y": ("z", "x"), "z": ("x", "y")}[component]
        return ([(component, n)] + [(name, value * d[second]) for name, value in turn[first]] +
                [(name, -value * d[first]) for name, value in turn[second]])


# Arguments, cells across the first part, whether it is of solids.
CASES = {
    "bricks": ([*BRICKS, *HELD, *mesh(m1=2, m2=3)], 2, True),
    "bricks apart and displaced": ([*BRICKS, *HELD, *mesh(m1=2, m2=3, gap=0.05, shift=0.1)], 2, True),
    "plates apart": ([*PLATES, *HELD, *mesh(m1=3, m2=5, plates=1, gap=0.02)], 3, False),
    "plate on brick": ([*MIXED, *HELD, *mesh(m1=2, m2=3, plates=2)], 2, True),
}


class BesideDenseAlgebra(unittest.TestCase):
    known = {}

    def dense(self, name):
        if name not in self.known:
            arguments, cells, solid = CASES[name]
            self.known[name] = Tied(self, arguments, cells, solid)
        return self.known[name]

    def nodes(self, name):
        dense = self.dense(name)
        return sum(dense.component[i] == "x" for i in dense.followers)

    def test_frequencies_and_the_stable_step(self):
        for name, (arguments, *_) in CASES.items():
            squares = self.dense(name).squared_frequencies()
            for ranks in (1, 3) if name == "bricks" else (1,):
                with self.subTest(case=name, ranks=ranks):
                    run = Recorded(self, [*arguments, *TIE, "-end_time", 1e-4, "-modes", 8], ranks)
                    structure = run.summary["structures"]["t"]
                    found = numpy.array([mode["frequency"] for mode in structure["frequencies"]])
                    self.assertLess(abs(found * 2 * numpy.pi / numpy.sqrt(squares[:8]) - 1).max(), 1e-9)
                    self.assertAlmostEqual(structure["omega_max"] / numpy.sqrt(squares[-1]), 1, delta=1e-9)
                    self.assertEqual(structure["connectivity"]["pieces"], 1)
                    group = structure["rigid_groups"][0]
                    self.assertEqual((group["kind"], group["nodes"], group["dofs"]),
                                     ("tie", self.nodes(name), len(self.dense(name).followers)))

    def test_omega_max_never_grows(self):
        for name, (arguments, *_) in CASES.items():
            alone = Recorded(self, [*arguments, "-t_allow_loose", "true", "-end_time", 1e-4]).summary
            tied = numpy.sqrt(self.dense(name).squared_frequencies()[-1])
            self.assertLess(tied, alone["structures"]["t"]["omega_max"] * (1 + 1e-9), name)

    def test_steps(self):
        record = write_sine(3.0, 40.0, 0.1)
        for name, (arguments, *_) in CASES.items():
            dense = self.dense(name)
            step = float(f"{min(0.9 * 2 / numpy.sqrt(dense.squared_frequencies()[-1]), 1e-4):.2g}")
            count = 100
            inverse = numpy.linalg.inv(dense.reduced_mass)
            load = dense.motions.T @ (dense.mass * numpy.array([float(c == "y") for c in dense.component]))
            place = numpy.zeros(len(dense.place))
            place[dense.followers] = [dense.component[i] == "y" for i in dense.followers]
            row = place / place.sum() @ dense.motions
            u = numpy.zeros(len(inverse))
            v = u.copy()
            expected = []
            for n in range(count):
                expected.append(row @ u)
                ground = numpy.interp(n * step, 1e-4 * numpy.arange(1001),
                                      3.0 * numpy.sin(80e-4 * numpy.pi * numpy.arange(1001)))
                v = v + (step if n else step / 2) * inverse @ (-dense.reduced_stiffness @ u - load * ground)
                u = u + step * v
            with self.subTest(case=name):
                run = Recorded(self, [*arguments, *TIE, *clock(step, count * step), *probes(p="t:edge"),
                                      "-motion_y_record", record, "-motion_y_unit", "m/s2"])
                found = run.displacement("p.y")[:count]
                size = abs(numpy.array(expected)).max()
                self.assertGreater(size, 0)
                self.assertLess(abs(found - expected).max() / size, 1e-9)

    def test_rest_under_gravity(self):
        for name, (arguments, *_) in CASES.items():
            dense = self.dense(name)
            down = numpy.array([-GRAVITY * float(c == "z") for c in dense.component])
            u = dense.motions @ numpy.linalg.solve(dense.reduced_stiffness, dense.motions.T @ (dense.mass * down))
            last = [i for i in range(len(u)) if dense.component[i] == "z" and dense.place[i][0] > 1.9]
            for more in ([], ["-preload_solver", "iterative"]):
                with self.subTest(case=name, more=more):
                    run = Recorded(self, [*arguments, *TIE, "-gravity", GRAVITY, "-preload", "static", "-end_time",
                                          1e-3, "-output_interval", 1e-4, *probes(p="t:x_max"),
                                          *more], identity=1e-10)
                    found = run.displacement("p.z")
                    self.assertLess(abs(found / numpy.mean(u[last]) - 1).max(), 1e-9)
                    self.assertLess(run.summary["equilibrium"]["structures"]["t"]["imbalance"], 1e-9)

    def test_reduced_structures(self):
        """The lowest modes, and as many as there are independent dofs."""
        for name, (arguments, *_) in CASES.items():
            squares = self.dense(name).squared_frequencies()
            for count in (5, len(squares)) if "bricks" not in name else (5,):
                with self.subTest(case=name, count=count):
                    run = Recorded(self, [*arguments, *TIE, *in_modes("t", count), "-end_time", 1e-5, "-modes",
                                          count])
                    found = [mode["frequency"] for mode in run.summary["structures"]["t"]["frequencies"]]
                    wanted = numpy.sqrt(squares[:count]) / (2 * numpy.pi)
                    self.assertGreaterEqual(len(found), count)
                    self.assertLess(abs(found[:count] / wanted - 1).max(), 1e-9)


class PatchTest(unittest.TestCase):
    """A constant stress passes, whatever cells are across both sides and whichever follows."""
    CELLS = ((1, 1), (1, 4), (2, 4), (2, 3), (3, 2), (4, 5), (5, 4), (2, 5), (4, 2))

    def hung(self, m1, m2, tie):
        """Error of the displacements of bricks that hang from x_min without lateral strain, over the largest one."""
        scene = [*BRICKS[:-2], "-material_c_poisson", 0, *HELD, "-t_tie", tie, *mesh(m1=m1, m2=m2), "-t_gravity",
                 f"{GRAVITY},0,0", "-preload", "static", "-end_time", 1e-4, "-output_interval", 1e-4, "-probes", "p,q",
                 *all_nodes("p", "t", "first"), *all_nodes("q", "t", "second")]
        run = Recorded(self, scene, identity=1e-9)
        positions, names = run.nodes("p")
        more = run.nodes("q")
        x = numpy.concatenate([positions, more[0]])[:, 0]
        wanted = DENSITY * GRAVITY / YOUNG * (2 * x - x**2 / 2)
        found = numpy.array([run.displacement(f"{name}.x")[0] for name in [*names, *more[1]]])
        self.assertEqual([line for line in run.summary["warnings"] if "tie" in line], [])
        return abs(found - wanted).max() / wanted.max()

    def test_hung_bricks(self):
        for m1, m2, tie in ((2, 4, "edge:face"), (3, 5, "edge:face"), (4, 5, "edge:face"), (4, 2, "face:edge"),
                            (4, 2, "edge:face"), (3, 2, "edge:face")):
            self.assertLess(self.hung(m1, m2, tie), 1e-10, (m1, m2, tie))

    def test_bricks_hung_on_tetrahedra(self):
        """Triangles beside squares: tetrahedra next to without weight hold bricks, which pull them alike everywhere."""
        for m1, m2, tie in ((3, 4, "edge:face"), (3, 4, "face:edge"), (4, 3, "edge:face")):
            scene = [*BRICKS[:8], "-t_second_element", "tet4", "-t_second_material", "light", *CONCRETE,
                     "-material_c_poisson", 0, *material("light", YOUNG, 0, 1e-9 * DENSITY), "-t_clamp", "x_max",
                     "-t_tie", tie, *mesh(m1=m1, m2=m2, tets=1), "-t_gravity", f"{-GRAVITY},0,0", "-preload", "static",
                     "-end_time", 1e-9, "-output_interval", 1e-10, "-probes", "p,q", *all_nodes("p", "t", "first"),
                     *all_nodes("q", "t", "second")]
            run = Recorded(self, scene, identity=1e-9)
            (near, names), (far, others) = run.nodes("p"), run.nodes("q")
            depth = 2 - numpy.concatenate([near, far])[:, 0]
            wanted = -DENSITY * GRAVITY / YOUNG * (depth - numpy.maximum(depth - 1, 0)**2 / 2)
            found = numpy.array([run.displacement(f"{name}.x")[0] for name in [*names, *others]])
            self.assertLess(abs(found - wanted).max() / abs(wanted).max(), 1e-8, (m1, m2, tie))

    def imbalance(self, m1, m2, plates):
        """Largest force left on a node of the face under constant stresses of the lot, over that of a facet: tension
        along x at all nodes, other strains where nothing but the face pulls: away from its border, and from what follows
        there."""
        scene = [*(PLATES if plates else BRICKS), *HELD, *mesh(m1=m1, m2=m2, plates=plates)]
        if plates:
            scene[scene.index("-t_second_thickness") + 1] = 0.2
        dense = Tied(self, scene, m1, not plates)
        alone = numpy.setdiff1d(numpy.arange(len(dense.place)), dense.followers)
        place = dense.place[alone]
        at_face = abs(place[:, 0] - 1) < 1e-9

        def border(x):
            return (abs(x[:, 1] - 0.5) > 0.49) | ((abs(x[:, 2] - 0.5) > 0.49) & (not plates))

        beside = dense.followers[border(dense.place[dense.followers])]
        inside = at_face & ~border(place) & ~numpy.any(dense.motions[beside], axis=0)

        def left(gradient):
            u = numpy.array([gradient["xyz".index(c)] @ x if c in "xyz" else 0
                             for x, c in zip(dense.place, dense.component)])
            return abs(dense.motions.T @ (dense.stiffness @ u))

        worst = left(numpy.diag([1, -POISSON, -POISSON]))[at_face].max()
        for a, b in [(0, 0), (1, 1), (0, 1)] + [(2, 2), (1, 2), (0, 2)] * (not plates):
            strain = numpy.zeros((3, 3))
            strain[a, b] = strain[b, a] = 1
            worst = max(worst, left(strain)[inside].max(initial=0))
        return worst / (YOUNG * (0.2 / m1 if plates else 1 / m1**2))

    def test_constant_stress(self):
        for plates in (0, 1):
            for m1, m2 in self.CELLS:
                self.assertLess(self.imbalance(m1, m2, plates), 1e-11, (m1, m2, plates))


class BesideMatchedMeshes(unittest.TestCase):
    """A cantilever of two parts whose meshes do not match, and of one mesh: frequencies, and the sag of its end."""

    def measured(self, scene):
        more = [*TIE, *scene, "-gravity", GRAVITY, "-preload", "static", "-end_time", 1e-4, "-output_interval", 1e-4,
                "-modes", 3, *probes(p="t:x_max")]
        run = Recorded(self, more, identity=1e-9)
        frequencies = [mode["frequency"] for mode in run.summary["structures"]["t"]["frequencies"]]
        return numpy.array([*frequencies, -run.displacement("p.z")[0]])

    def test_bricks(self):
        scene = [*BRICKS, *HELD]
        matched = self.measured([*scene, *mesh(m1=6, m2=6, n1=6, n2=6)])
        for m1 in (4, 5):
            found = self.measured([*scene, *mesh(m1=m1, m2=6, n1=6, n2=6)])
            self.assertLess(abs(found / matched - 1).max(), 5e-3)

    def test_plates(self):
        scene = [*PLATES, *HELD]
        matched = self.measured([*scene, *mesh(m1=12, m2=12, n1=12, n2=12, plates=1)])
        for m1, m2 in ((8, 12), (8, 11)):
            found = self.measured([*scene, *mesh(m1=m1, m2=m2, n1=12, n2=12, plates=1)])
            self.assertLess(abs(found / matched - 1).max(), 2e-3)

    @program.long
    def test_sag_converges_as_one_mesh(self):
        """2 beside 3 cells, 4 beside 6, 8 beside 12: the error falls as that of one mesh of the coarser cells, and is
        smaller."""
        for parts, kind, sizes, fine in ((BRICKS, {}, (1, 2, 4), 18), (PLATES, {"plates": 1}, (2, 4, 8), 48)):
            def sag(m1, m2, parts=parts, kind=kind):
                return self.measured([*parts, *HELD, *mesh(m1=m1, m2=m2, n1=m1, n2=m2, **kind)])[-1]

            exact = sag(fine, fine)
            tied = [abs(sag(2 * k, 3 * k) / exact - 1) for k in sizes]
            coarse = [abs(sag(2 * k, 2 * k) / exact - 1) for k in sizes]
            for k, size in enumerate(sizes):
                self.assertLess(tied[k], coarse[k], (kind, size))
            for before, after in zip(tied, tied[1:]):
                self.assertGreater(before / after, 2.7, kind)  # 4 of second order, where cells are small


class PlantedBeam(unittest.TestCase):
    """A steel beam whose foot follows the face of a concrete cube: nearly a clamped cantilever, if the facets are not
    much narrower than 0.3 m, three times the width of the beam."""
    LENGTH, INERTIA, AREA = 2.0, 1e-5, 1e-2

    def test_frequency_of_a_cantilever(self):
        clamped = 1.8751040687**2 / (2 * numpy.pi * self.LENGTH**2) * numpy.sqrt(
            200e9 * self.INERTIA / (7800 * self.AREA))
        for cells in (1, 2, 3):
            run = Recorded(self, ["-structures", "b", "-b_mesh", "tests/meshes/planted_beam.geo", "-b_mesh_set",
                                  f"m={cells}", "-b_clamp", "back", "-b_body_element", "hex8", "-b_body_material", "c",
                                  *CONCRETE, "-material_c_poisson", POISSON, "-b_beam_element", "beam",
                                  "-b_beam_material", "steel", "-b_beam_section", "tube", "-b_tie", "foot:face",
                                  *STEEL, "-end_time", 1e-4, "-modes", 2])
            structure = run.summary["structures"]["b"]
            for mode in structure["frequencies"]:  # it bends in two planes
                self.assertLess(abs(mode["frequency"] / clamped - 1), 0.01)
            self.assertEqual(structure["connectivity"]["pieces"], 1)


class CompositeBeam(unittest.TestCase):
    """A strip of slab and the beam below it bend as one section, whichever follows and whatever their meshes."""
    LENGTH, WIDTH, THICKNESS, OFFSET, YOUNG = 4.0, 0.4, 0.1, 0.3, 30e9
    SCENE = ["-structures", "c", "-c_mesh", "tests/meshes/composite.geo", "-c_beam_element", "beam", "-c_beam_material",
             "c", "-c_beam_section", "rib", *material("c", YOUNG, 0, DENSITY),
             *section("rib", 0.04, 1.2e-4, 1.5e-4, 1e-4, "0,0,1"), "-c_slab_element", "shell", "-c_slab_material", "c",
             "-c_slab_thickness", THICKNESS, "-c_clamp", "end", "-gravity", GRAVITY, "-preload", "static", "-end_time",
             1e-3, *probes(p="c:tip")]

    def test_bends_as_one_section(self):
        slab = self.WIDTH * self.THICKNESS
        together = (self.WIDTH * self.THICKNESS**3 / 12 + 1.2e-4 + self.OFFSET**2 * slab * 0.04 / (slab + 0.04))
        expected = DENSITY * GRAVITY * (slab + 0.04) * self.LENGTH**4 / (8 * self.YOUNG * together)
        for tie, n, nb in (("beam:slab", 40, 60), ("beam:slab", 40, 47), ("beam:spine", 80, 93), ("slab:beam", 47, 40)):
            run = Recorded(self, [*self.SCENE, "-c_tie", tie, "-c_mesh_set", f"n={n},nb={nb}"], identity=1e-10)
            self.assertLess(abs(-run.displacement("p.z")[0] / expected - 1), 8e-3, (tie, n, nb))
            # What goes to clamped nodes of the facets is part of what the clamps hold.
            self.assertEqual(run.summary["warnings"], [])
            self.assertLess(run.summary["equilibrium"]["structures"]["c"]["imbalance"], 1e-8)


class Struck(unittest.TestCase):
    """Bricks tied to each other fly against a wall with sides that both have: nodes that follow, and followed ones."""
    SPEED = 0.5
    SCENE = [*BRICKS, *TIE, "-t_initial_velocity", f"0.1,{-SPEED},0", *contacts(w=("t:y_min", "wall", "1e-3")),
             *clock(2e-5, 0.01), *probes(p="t:edge")]

    def test_ledger(self):
        for parameters in (mesh(m1=2, m2=3), mesh(m1=2, m2=3, gap=0.05)):
            run = Recorded(self, [*self.SCENE, *parameters])
            self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-9)
            self.assertGreater(run.energy["strain"], 0)
            self.assertGreater(run.summary["impacts"]["total_impulse"], 4800 * self.SPEED)

    @staticmethod
    def two_structures(*more):
        """A block flies against bricks that hang by a tie, under gravity."""
        scene = [*BRICKS, *TIE, *HELD, *mesh(m1=2, m2=3, gap=0.02),
                 *box_of("b", "x0=0.3,y0=-1.001,z0=0.1,lx=1.2,nx=2,ny=1,nz=2", "c"), "-b_initial_velocity", "0,1,0",
                 *contacts(w=("b:y_max", "t:y_min")), "-end_time", 0.01, "-output_interval", 1e-4, "-gravity", GRAVITY,
                 *probes(p="t:edge")]
        scene[scene.index("-structures") + 1] = "t,b"
        return [*scene, *more]

    def test_another_structure_with_damping_under_gravity(self):
        """The ledger with all of its terms."""
        for more in (["-t_damping_alpha", 0.3, "-t_damping_beta", 1e-6], ["-t_damping_uniform", 0.04]):
            run = Recorded(self, self.two_structures(*more))
            self.assertGreater(run.summary["impacts"]["total_impulse"], 0)
            self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-9)

    def test_the_same_run_twice(self):
        a, b = (Recorded(self, [*self.SCENE, *mesh(m1=2, m2=3)], 2).displacement("p.y") for _ in range(2))
        self.assertTrue(numpy.array_equal(a, b))

    def test_reduced_to_all_of_its_modes(self):
        scene = [*self.SCENE, *HELD, *mesh(m1=2, m2=3), "-w_gap", "1e-4"]
        full = Recorded(self, scene)
        reduced = Recorded(self, [*scene, *in_modes("t", 10000)])
        u, v = full.displacement("p.y"), reduced.displacement("p.y")
        self.assertGreater(full.summary["impacts"]["total_impulse"], 0)
        self.assertLess(abs(u - v).max() / abs(u).max(), 1e-9)

    def test_continued(self):
        assert_continues(self, [*self.SCENE, *mesh(m1=2, m2=3), "-modes", 1], 0.005, 100)

    def test_it_flies_and_turns_freely(self):
        """Six motions without stiffness, across a gap as well."""
        for scene in ([*BRICKS, *mesh(m1=2, m2=3, gap=0.05, shift=0.1)], [*MIXED, *mesh(m1=2, m2=3, plates=2)],
                      [*PLATES, *mesh(m1=3, m2=4, plates=1, gap=0.3)]):
            run = Recorded(self, [*scene, *TIE, "-t_initial_velocity", "1,0,0", "-end_time", 1e-4, "-modes", 7])
            found = [mode["frequency"] for mode in run.summary["structures"]["t"]["frequencies"]]
            self.assertLess(found[5], 1e-6 * found[6])


class BesideOtherThings(unittest.TestCase):
    """A tie beside friction and faces that absorb, under weight; and below a column with P-Delta."""

    def alike(self, scene, lost, ranks=(1, 3)):
        """Runs a scene on some numbers of ranks; returns the motion of the face, and the last run."""
        values = []
        for count in ranks:
            run = Recorded(self, scene, count, identity=1e-11)
            values.append(numpy.array([run.displacement(f"p.{axis}") for axis in "xyz"]))
            self.assertGreater(run.energy[lost], 1)
            self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-13)
            self.assertLess(abs(values[-1] - values[0]).max() / abs(values[0]).max(), 1e-9)
        return values[0], run

    def shaken(self):
        """Two bricks shaken across."""
        record = write_sine(8.0, 10.0, 0.1)
        return [*BRICKS, *TIE, "-motion_y_record", record, "-motion_y_unit", "m/s2", "-output_interval", 1e-3,
                "-end_time", 0.05, *probes(p="t:edge")]

    def test_absorbing_faces(self):
        """Waves leave through an end of two tied bricks."""
        self.alike([*self.shaken(), *mesh(m1=2, m2=3, gap=0.05), "-t_absorbing", "x_min"], "devices", (1,))

    def test_friction_below_both_parts(self):
        """They stand on rough ground with both parts and slide: nodes that follow are held by those that they follow."""
        rough = [*self.shaken(), "-gravity", GRAVITY, "-preload", "static", "-contacts", "w", "-w_secondary", "t:z_min",
                 "-w_gap", 0, "-w_friction", 0.3]
        wall = [*rough, "-w_primary", "wall"]
        for parameters, carried in ((mesh(m1=2, m2=3, gap=0.05), 4), (mesh(m1=2, m2=3), 4),
                                    (mesh(m1=2, m2=3, gap=0.05, shift=0.1), 4)):
            _, run = self.alike([*wall, *parameters], "friction")
            self.assertEqual(run.summary["contacts"]["w"]["carried_nodes"], carried)
        block = [*rough, "-w_primary", "b:z_max",
                 *box_of("b", "x0=-0.5,y0=-0.5,z0=-1,lx=3,ly=2,lz=1,nx=4,ny=3,nz=1", "c"), "-b_clamp", "z_min",
                 *mesh(m1=2, m2=3), "-w_passes", 2]
        block[block.index("-structures") + 1] = "t,b"
        self.alike(block, "friction", (1, 3))

    def test_friction_below_matched_parts(self):
        """Parts tied node by node slide as the one mesh does that has these nodes once."""
        wall = ["-gravity", GRAVITY, "-preload", "static", *contacts(w=("t:z_min", "wall", 0)), "-w_friction", 0.3,
                "-p_group", "x_max", "-time_step", 2e-5]
        tied, run = self.alike([*self.shaken(), *mesh(m1=3, m2=3), *wall], "friction", (1,))
        self.assertEqual(run.summary["contacts"]["w"]["carried_nodes"], 4)
        shaking = self.shaken()[len(BRICKS) + len(TIE):]
        one = ["-structures", "t", *box_of("t", "lx=2,nx=4,ny=3,nz=3", "c"), *CONCRETE, "-material_c_poisson", POISSON]
        found, _ = self.alike([*one, *shaking, *wall], "friction", (1,))
        self.assertLess(abs(tied - found).max() / abs(found).max(), 1e-8)

    def test_column_with_p_delta(self):
        """A weight on the beam softens it as it does the beam with a clamped foot."""
        def frequency(p_delta, foot, ranks):
            words = ["-structures", "b", "-b_mesh", "tests/meshes/planted_beam.geo", "-b_mesh_set", "m=2", "-b_body_element",
                     "hex8", "-b_body_material", "c", *CONCRETE, "-material_c_poisson", POISSON, "-b_beam_element", "beam",
                     "-b_beam_material", "steel", "-b_beam_section", "tube", *STEEL, "-b_tip_element", "point_mass",
                     "-b_tip_mass", 5e4, "-b_gravity", f"{-GRAVITY},0,0", "-preload", "static", "-b_p_delta", p_delta,
                     "-end_time", 1e-4, "-modes", 2, *foot]
            run = Recorded(self, words, ranks)
            self.assertLess(run.summary["equilibrium"]["structures"]["b"]["imbalance"], 1e-10)
            return run.summary["structures"]["b"]["frequencies"][0]["frequency"]

        tied, clamped = ["-b_tie", "foot:face", "-b_clamp", "back"], ["-b_clamp", "back,foot"]
        falls = [frequency("true", foot, ranks) / frequency("false", foot, ranks)
                 for foot, ranks in ((clamped, 1), (tied, 1), (tied, 3))]
        self.assertLess(falls[0], 0.95)
        for fall in falls[1:]:
            self.assertAlmostEqual(fall / falls[0], 1, delta=5e-3)
            self.assertAlmostEqual(fall / falls[1], 1, delta=1e-9)


class LinksOnATie(unittest.TestCase):
    """A spring with dashpots, which pushes only, below a corner that follows: solved for with the tie, or by modes."""

    def test_same_by_modes(self):
        for more in (["-t_corner_compression_only", "true"], []):
            scene = [*PLATES, *HELD, *TIE, *mesh(m1=2, m2=3, plates=1), "-t_corner_element", "grounded_spring",
                     "-t_corner_stiffness", "1e6,1e6,1e7", "-t_corner_dashpot", "1e3,1e4,1e5", *more,
                     "-t_initial_velocity", "0.1,0.2,0.5", *clock(1e-5, 0.02, 1e-4), *probes(p="t:corner")]
            modes = Recorded(self, [*scene, *in_modes("t", 10000)], 1, identity=1e-9)
            run = Recorded(self, scene, identity=1e-11)
            self.assertGreater(run.energy["devices"], 1)
            for axis in "xyz":
                u, v = run.displacement(f"p.{axis}"), modes.displacement(f"p.{axis}")
                self.assertLess(abs(u - v).max(), 1e-8 * abs(v).max())


ON_RANKS = {"tied bricks that strike a wall": [*Struck.SCENE, *mesh(m1=2, m2=3)],
            "bricks tied over a gap that strike a wall": [*Struck.SCENE, *mesh(m1=2, m2=3, gap=0.05)],
            "a block that strikes tied bricks": Struck.two_structures("-t_damping_alpha", 0.3, "-t_damping_beta", 1e-6),
            "a block that strikes tied bricks with uniform damping": Struck.two_structures("-t_damping_uniform", 0.04),
            "tied bricks with a face that absorbs": lambda: [
                *BesideOtherThings().shaken(), *mesh(m1=2, m2=3, gap=0.05), "-t_absorbing", "x_min"]}


if __name__ == "__main__":
    unittest.main()
