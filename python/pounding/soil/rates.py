"""Search for the rates of a dashpot in series with a spring and a mass, of which soil is made."""

import math

import numpy
from scipy.optimize import lsq_linear, nnls

GOOD_MISFIT = 1e-5  # below which no rates are added
WORTH_IT = 0.9  # misfit of one more pair over that without it
MOST_CELLS = 10  # pairs of rates
FIRST_MOVE, LAST_MOVE = 0.2, 1e-3  # of the logarithm of a rate
NOTICED = 1 - 1e-4  # of the misfit, for a move to count
PER_DECADE = 8  # points of the grid
SHARPNESSES = (0.5, 1.0, 2.0, 4.0, 8.0)
LEAST_SHARPNESS, MOST_SHARPNESS = 0.2, 30


def nonnegative(matrix, wanted) -> numpy.ndarray:
    """The x >= 0 that makes |A x - b| least (Lawson and Hanson)."""
    try:
        return nnls(matrix, wanted, maxiter=100 + 30 * matrix.shape[1])[0]
    except RuntimeError:  # round-off turned it in a circle
        return numpy.maximum(lsq_linear(matrix, wanted, (0, math.inf), method="trf").x, 0)


def response(omega, spring: float, mass: float) -> numpy.ndarray:
    """i omega / (1 + i omega / spring + mass / (i omega)), 0 at rest: a dashpot of 1, `spring` infinite for none, `mass` 0 for
    none. Spring over dashpot, and dashpot over mass."""
    iw = 1j * numpy.where(omega > 0, omega, 1)
    return numpy.where(omega > 0, iw / (1 + iw / spring + mass / iw), 0)


class Samples:
    """Weighted samples of functions of the frequency as columns: real parts, then imaginary ones."""

    def __init__(self, omega, weight):
        self.omega, self.weight = omega, weight  # increasing, from 0 on, over a unit
        self.grounded = numpy.stack([self.column(values) for values in (1 + 0j * omega, 1j * omega, -omega**2 + 0j)], axis=1)

    def column(self, values) -> numpy.ndarray:
        return numpy.concatenate([self.weight * values.real, self.weight * values.imag])

    def of(self, rates: tuple) -> numpy.ndarray:
        return self.column(response(self.omega, *rates))


class Search:
    """Greedy search for rates, each step of which lowers the misfit of some columns of functions by sums of a spring, a
    dashpot, a mass and parts with these rates, with factors that are not negative."""

    def __init__(self, samples: Samples, wanted):
        self.samples, self.wanted = samples, wanted
        self.low, self.high = samples.omega[samples.omega > 0][0], samples.omega[-1]
        self.grounded = samples.grounded / numpy.linalg.norm(samples.grounded, axis=0)

    def run(self) -> list:
        grid, found = self.grid(), []
        misfit, _ = self.misfit([])
        while misfit > GOOD_MISFIT and len(found) < min(MOST_CELLS, len(self.samples.omega) // 4):
            columns = [self.column(rates) for rates in found]
            trials = [self.misfit([*columns, self.column(rates)])[0] for rates in grid]
            if not trials or not min(trials) < misfit:
                break
            trial = [*found, grid[int(numpy.argmin(trials))]]
            least, used = self.move(trial)
            if not least < WORTH_IT * misfit:
                break
            found = [rates for rates, one in zip(trial, used) if one]
            misfit = least
        return found

    def is_allowed(self, rates: tuple) -> bool:
        """Rates that the table can see: their peaks lie about its band and are no narrower than it resolves."""
        spring, mass = rates
        if math.isinf(spring) or mass == 0:
            return self.is_near(mass if math.isinf(spring) else spring)
        peak, sharpness = math.sqrt(spring * mass), math.sqrt(mass / spring)
        return self.is_near(peak) and LEAST_SHARPNESS <= sharpness <= self.sharpest(peak)

    def is_near(self, rate: float) -> bool:
        return self.low / 2 <= rate <= 2 * self.high

    def sharpest(self, peak: float) -> float:
        omega = self.samples.omega
        above = int(numpy.searchsorted(omega, peak, side="right"))
        if peak <= self.low or above == len(omega):
            return 1.0
        return min(max(peak / (2 * (omega[above] - omega[above - 1])), 1.0), MOST_SHARPNESS)

    def grid(self) -> list:
        decades = math.log10(4 * self.high / self.low)
        grid = []
        for rate in self.low / 2 * numpy.logspace(0, decades, math.ceil(PER_DECADE * decades) + 1):
            grid += [(rate, 0.0), (math.inf, rate)] + [(rate / sharp, rate * sharp) for sharp in SHARPNESSES]
        return [rates for rates in grid if self.is_allowed(rates)]

    def column(self, rates: tuple) -> numpy.ndarray:
        column = self.samples.of(rates)
        return column / numpy.linalg.norm(column)

    def misfit(self, columns: list) -> tuple:
        """Root of the sum of the squared misfits of all functions, and which columns have a factor above 0."""
        basis, triangle = numpy.linalg.qr(numpy.column_stack([self.grounded, *columns]))
        inside = basis.T @ self.wanted
        square = ((self.wanted - basis @ inside)**2).sum()
        used = numpy.zeros(len(columns), bool)
        for wanted in inside.T:
            x = nonnegative(triangle, wanted)
            square += ((triangle @ x - wanted)**2).sum()
            used |= x[self.grounded.shape[1]:] > 0
        return math.sqrt(square), used

    def move(self, trial: list) -> tuple:
        """Moves rates one by one while that lowers the misfit, by ever smaller steps."""
        columns = [self.column(rates) for rates in trial]
        best = self.misfit(columns)
        step = FIRST_MOVE
        while step > LAST_MOVE:
            moved = False
            for i in range(len(trial)):
                both = math.isfinite(trial[i][0]) and trial[i][1] > 0
                ways = [(sign * step, way * step) for sign in (1, -1) for way in ((sign, -sign) if both else (sign,))]
                for ways_of_rates in ways:
                    while (found := self.moved(trial, columns, i, ways_of_rates, best[0])) is not None:
                        best, moved = found, True
            if not moved:
                step /= 2
        return best

    def moved(self, trial: list, columns: list, i: int, ways: tuple, least: float):
        """The misfit after a move, if it is lower; else the move is not made."""
        rates = tuple(rate * math.exp(way) for rate, way in zip(trial[i], ways))
        if not self.is_allowed(rates):
            return None
        kept, columns[i] = columns[i], self.column(rates)
        found = self.misfit(columns)
        if not found[0] < NOTICED * least:
            columns[i] = kept
            return None
        trial[i] = rates
        return found
