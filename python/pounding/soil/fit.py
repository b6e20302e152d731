"""Springs, dashpots and masses that have the impedances of a table.

S = K + i omega C - omega^2 M + sum_j X_j i omega / (1 + i omega / p_j + q_j / (i omega)) with symmetric K, C, M, X_j without
negative eigenvalues, p_j > 0 and q_j >= 0 can only take energy. For given rates p_j, q_j the rest is a convex problem, which is
solved; docs/reference/theory/links.md has all of it.
"""

import math
from dataclasses import dataclass, field

import numpy

from pounding.soil.impedances import Impedances, motions_of, sizes_of
from pounding.soil.rates import Samples, Search, nonnegative

COUPLED = 1e-3  # term over its diagonals from which on motions are coupled
HEAVY = 10  # share of the table's rows that the static one counts as
LIGHTEST = 0.05  # least size of a row over the median, for its weight
MOST_ROUNDS = 60  # of directions
SETTLED = 1e-4  # part by which a round has to lower the misfit
NEGLIGIBLE = 1e-9


@dataclass
class Hidden:
    """A dashpot, a spring and a mass in series, against the motion b . e of the mats; spring or mass 0 where there is none."""
    motion: numpy.ndarray  # b, shape (6 mats)
    dashpot: float
    spring: float
    mass: float

    def at(self, omega):
        """Shape (..., 6 mats, 6 mats)."""
        iw = 1j * numpy.where(omega > 0, omega, 1)
        slip = 1 + (iw * self.dashpot / self.spring if self.spring else 0) + (self.dashpot / (iw * self.mass) if self.mass else 0)
        return numpy.multiply.outer(numpy.where(omega > 0, iw * self.dashpot / slip, 0), numpy.outer(self.motion, self.motion))


@dataclass
class Soil:
    """Soil of some mats. Matrices along and about x, y, z, mat by mat: shape (6 mats, 6 mats)."""
    mats: int = 1
    hidden: list = field(default_factory=list)

    def __post_init__(self):
        self.stiffness, self.dashpots, self.masses = (numpy.zeros((6 * self.mats, 6 * self.mats)) for _ in range(3))

    def at(self, omega) -> numpy.ndarray:
        """Impedance, shape (n, 6 mats, 6 mats), of circular frequencies, shape (n)."""
        w = numpy.asarray(omega, float)[..., None, None]
        return sum((part.at(w[..., 0, 0]) for part in self.hidden), self.stiffness + 1j * w * self.dashpots - w**2 * self.masses)


@dataclass
class BlockFit:
    """Motions that the table couples, and the fit to their block. Terms are over the root of the product of the moduli
    of the two diagonals, frequency by frequency."""
    motions: list  # indices
    mats: int  # of the table
    cells: int  # hidden parts with rates of their own
    misfit: numpy.ndarray  # of the worst term, per frequency
    table_damping: float  # least eigenvalue of the imaginary part of the table
    damping: float  # the same of the fit, from the first frequency to the last
    damping_at: float  # Hz
    margin: float  # least eigenvalue of the real part of S / (i omega) at any frequency, over the usual largest one of the table

    @property
    def names(self) -> str:
        return " ".join(motions_of(self.mats)[i] for i in self.motions)


def coupled_motions(table: Impedances) -> tuple:
    """Sets of motions that are coupled, and the largest term between motions of different sets."""
    largest = (abs(table.matrix) / sizes_of(table.matrix)).max(axis=0)
    root = list(range(len(largest)))
    for i, j in numpy.argwhere(largest > COUPLED):
        root = [root[j] if one == root[i] else one for one in root]
    blocks = [[i for i in range(len(root)) if root[i] == one] for one in dict.fromkeys(root)]
    apart = numpy.not_equal.outer(root, root)
    return blocks, float(largest[apart].max(initial=0))


def at_rest(table: Impedances) -> numpy.ndarray:
    """The parabola in the frequency through the first row and the first one at twice its frequency."""
    f = table.frequency
    second = int(numpy.searchsorted(f, 2 * f[0]))
    if second == len(f):
        return table.matrix[0]
    share = f[0]**2 / (f[second]**2 - f[0]**2)
    return table.matrix[0] + share * (table.matrix[0] - table.matrix[second])


class Block:
    """Fit of the terms of some motions that the table couples with no others. Motions are scaled so that their diagonals are
    about 1, frequencies by the middle of the band."""

    def __init__(self, table: Impedances, motions: list):
        self.table, self.motions, self.size = table, motions, len(motions)
        f, matrix = table.frequency, table.matrix[:, motions][:, :, motions]
        self.unit = 2 * math.pi * math.sqrt(f[f > 0][0] * f[-1])
        self.scale = numpy.sqrt(numpy.sort(abs(numpy.diagonal(matrix, axis1=1, axis2=2)), axis=0)[len(f) // 2])
        if f[0] > 0:
            f = numpy.concatenate([[0], f])
            matrix = numpy.concatenate([at_rest(table)[None][:, motions][:, :, motions], matrix])
        self.rows = matrix / numpy.outer(self.scale, self.scale)
        self.rows[0].imag = 0
        norms = numpy.sqrt((abs(self.rows)**2).sum(axis=(1, 2)) / self.size)
        weight = 1 / (numpy.maximum(norms, LIGHTEST * numpy.sort(norms)[len(norms) // 2]) * math.sqrt(len(norms)))
        weight[0] *= math.sqrt(max(1.0, len(norms) / HEAVY))
        self.samples = Samples(2 * math.pi * f / self.unit, weight)
        self.pairs = [(a, b) for a in range(self.size) for b in range(a + 1)]

    def fit(self, soil: Soil) -> int:
        """Adds what it finds to the soil; returns the number of rates."""
        wanted = [self.samples.column(numpy.einsum("a,nab,b->n", one, self.rows, one)) for one in self.first_directions()]
        rates = Search(self.samples, numpy.stack(wanted, axis=1)).run()
        self.terms = numpy.column_stack([self.samples.grounded, *(self.samples.of(one) for one in rates)])
        self.norms = numpy.linalg.norm(self.terms, axis=0)
        factors = self.find_factors()
        at = numpy.ix_(self.motions, self.motions)
        for matrix, factor, power in zip((soil.stiffness, soil.dashpots, soil.masses), factors, (0, 1, 2)):
            matrix[at] = factor * numpy.outer(self.scale, self.scale) / self.unit**power
        for (spring, mass), factor in zip(rates, factors[3:]):
            self.add_hidden(soil, spring, mass, factor)
        return len(rates)

    def first_directions(self) -> list:
        """Along each motion and between each two."""
        unit = numpy.eye(self.size)
        return [unit[a] if a == b else (unit[a] + unit[b]) * math.sqrt(0.5) for a, b in self.pairs]

    def find_factors(self) -> numpy.ndarray:
        """Factors of all terms, symmetric and without a negative eigenvalue: sums of squares of directions, with new ones
        where the misfit falls most."""
        factors, last = self.solve([(t, one) for t in range(self.terms.shape[1]) for one in self.first_directions()])
        for turn in range(MOST_ROUNDS if self.size > 1 else 0):
            found, misfit = self.solve(self.next_atoms(factors, turn))
            if misfit < last:
                factors = found
            if not misfit < last * (1 - SETTLED):
                break
            last = misfit
        return factors

    def residual(self, factors) -> numpy.ndarray:
        """Weighted entries of the table less the fit: shape (rows of a column, size, size)."""
        table = numpy.concatenate([self.rows.real, self.rows.imag]) * numpy.tile(self.samples.weight, 2)[:, None, None]
        return table - numpy.tensordot(self.terms, factors, 1)

    def next_atoms(self, factors, turn: int) -> list:
        slopes = numpy.tensordot(self.terms.T, self.residual(factors), 1)  # fall of half the squared misfit
        reach = 0.3 * 0.7**turn
        atoms = []
        for t, (factor, slope) in enumerate(zip(factors, slopes)):
            matrices = [factor, slope]
            own, fall = numpy.linalg.norm(factor), numpy.linalg.norm(slope)
            if own > 0 and fall > 0:
                matrices += [factor / own + way * slope / fall for way in (reach, -reach)]
            atoms += [(t, one) for matrix in matrices for one in numpy.linalg.eigh((matrix + matrix.T) / 2)[1].T]
        return atoms

    def solve(self, atoms: list) -> tuple:
        """Factors by the best sum of the atoms, terms in one direction each, and the misfit."""
        double = [1 if a == b else math.sqrt(2) for a, b in self.pairs]
        terms = numpy.array([t for t, _ in atoms])
        squares = numpy.array([numpy.outer(one, one) for _, one in atoms]) / self.norms[terms][:, None, None]
        columns = numpy.concatenate([twice * squares[:, a, b] * self.terms[:, terms]
                                     for twice, (a, b) in zip(double, self.pairs)])
        none = numpy.zeros((self.terms.shape[1], self.size, self.size))
        rest = self.residual(none)
        wanted = numpy.concatenate([twice * rest[:, a, b] for twice, (a, b) in zip(double, self.pairs)])
        basis, triangle = numpy.linalg.qr(columns)
        x = nonnegative(triangle, basis.T @ wanted)
        numpy.add.at(none, terms, x[:, None, None] * squares)
        return none, numpy.linalg.norm(self.residual(none))

    def add_hidden(self, soil: Soil, spring: float, mass: float, factor) -> None:
        """Parts in the directions of the eigenvectors of a factor of the scaled motions."""
        values, vectors = numpy.linalg.eigh(factor)
        for value, vector in zip(values, vectors.T):
            if not value > NEGLIGIBLE * values[-1] or not value > 0:
                continue
            motion = numpy.zeros(len(soil.stiffness))
            motion[self.motions] = self.scale * vector
            largest = motion[numpy.argmax(abs(motion))]
            strength = value * largest**2
            soil.hidden.append(Hidden(motion / largest + 0.0, strength / self.unit, strength * spring if math.isfinite(spring) else 0.0,
                                      strength / (mass * self.unit**2) if mass > 0 else 0.0))

    def judge(self, soil: Soil, cells: int) -> BlockFit:
        f, at = self.table.frequency, numpy.ix_(self.motions, self.motions)
        wanted, found = self.table.matrix[:, at[0], at[1]], soil.at(2 * math.pi * f)[:, at[0], at[1]]
        miss = numpy.where((f == 0)[:, None, None], (found - wanted).real, found - wanted)
        positive = f > 0
        table = numpy.linalg.eigvalsh((wanted.imag / sizes_of(wanted))[positive])
        usual = numpy.linalg.eigvalsh((wanted.imag / numpy.outer(self.scale, self.scale))[positive])[:, -1] / (
            2 * math.pi * f[positive])
        first, last, beyond = f[positive][0], f[-1], 1000
        everywhere = first / beyond * (last / first * beyond**2)**numpy.linspace(0, 1, 2001)
        everywhere = numpy.sort(numpy.concatenate([everywhere, f[positive]]))
        values = soil.at(2 * math.pi * everywhere)[:, at[0], at[1]]
        margin = numpy.linalg.eigvalsh(values.imag / numpy.outer(self.scale, self.scale))[:, 0] / (
            2 * math.pi * everywhere * numpy.sort(usual)[len(usual) // 2])
        inside = (everywhere >= first) & (everywhere <= last)
        damping = numpy.linalg.eigvalsh((values.imag / sizes_of(values))[inside])[:, 0]
        return BlockFit(self.motions, self.table.mats, cells, (abs(miss) / sizes_of(wanted)).max(axis=(1, 2)), float(table[:, 0].min()),
                        float(damping.min()), float(everywhere[inside][damping.argmin()]), float(margin.min()))


def fit(table: Impedances) -> tuple:
    """Soil that misses a table least, what is told of each set of coupled motions, and the largest term between motions that are
    taken as not coupled."""
    soil, found = Soil(table.mats), []
    sets, left_out = coupled_motions(table)
    for motions in sets:
        block = Block(table, motions)
        found.append((block, block.fit(soil)))
    return soil, [block.judge(soil, cells) for block, cells in found], left_out
