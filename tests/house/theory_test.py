"""The identities and bounds of docs/reference/theory in numbers, on random small systems, apart from the program."""
import itertools
import unittest

import numpy


def symmetric(random, size, rank):
    factor = random.normal(size=(size, rank))
    return factor @ factor.T


def smallest(matrix):
    return numpy.linalg.eigvalsh(matrix)[0]


def largest_step(mass, damping, stiffness):
    """Where 4 M - 2 dt C - dt^2 K stops being positive definite, by bisection."""
    low, high = 0.0, 100.0
    for _ in range(100):
        middle = (low + high) / 2
        stable = smallest(4 * mass - 2 * middle * damping - middle**2 * stiffness) > 0
        low, high = (middle, high) if stable else (low, middle)
    return low


def complementary(delassus, rate):
    """0 <= impulse _|_ H impulse + rate >= 0, by trying every set of closed rows."""
    for closed in itertools.product((False, True), repeat=len(rate)):
        impulse = numpy.zeros(len(rate))
        rows = numpy.flatnonzero(closed)
        impulse[rows] = numpy.linalg.solve(delassus[numpy.ix_(rows, rows)], -rate[rows])
        if (impulse >= 0).all() and (delassus @ impulse + rate >= -1e-12 * abs(rate).max()).all():
            return impulse
    raise AssertionError("no solution")


class System:
    """M + S, C = alpha M + beta K + D, K and two contact rows."""
    alpha, beta, gap = 0.3, 0.01, 0.05

    def __init__(self, seed):
        random = numpy.random.default_rng(seed)
        size = 6
        self.lumped = numpy.diag(random.uniform(1, 3, size))
        self.mass = self.lumped + 0.5 * symmetric(random, size, 1)
        self.stiffness = symmetric(random, size, size)
        self.damping = (self.alpha * self.lumped + self.beta * self.stiffness
                        + 0.1 * symmetric(random, size, 2))
        self.rows = numpy.array([[-1, 1, 0, 0, 0, 0], [0, 0.5, -1, 0.5, 0, 0]])
        self.limit = largest_step(self.mass, self.damping, self.stiffness)
        self.displacement, self.velocity = random.normal(scale=0.1, size=size), random.normal(size=size)

    def force(self, step):
        return self.lumped @ numpy.ones(len(self.velocity)) * (3 * numpy.sin(0.3 * step) - 1)

    def solve(self, vector):
        return numpy.linalg.solve(self.mass, vector)

    def energy(self, dt, after, before, velocity):
        kinetic = velocity @ (self.mass - dt / 2 * self.damping) @ velocity / 2
        return kinetic + after @ self.stiffness @ before / 2

    def impulse(self, free_velocity):
        """Of one step from the present displacement."""
        closed = numpy.flatnonzero(self.rows @ self.displacement + self.gap <= 0)
        impulse = numpy.zeros(len(self.rows))
        if len(closed) > 0:
            rows = self.rows[closed]
            impulse[closed] = complementary(rows @ self.solve(rows.T), rows @ free_velocity)
        return impulse


class Filters(unittest.TestCase):
    """Uniform damping: its energy only falls, and its limit is exact."""
    weights, rates, at_rest = numpy.array([0.2, 0.4]), numpy.array([0.5, 3.0]), 0.9

    def move(self, stiffness, mass, dt, steps, seed):
        """Energy E' of every step and by how much it should have changed; the last displacement."""
        random = numpy.random.default_rng(seed)
        size = len(stiffness)
        u, v = random.normal(size=size), random.normal(size=size)
        c = (self.rates * dt / 2)[:, None]
        y, held = numpy.zeros((2, size)), None
        lengths = u - y
        fast = mass - dt**2 / 4 * self.at_rest * (1 + self.weights.sum()) * stiffness
        for step in range(steps):
            before = lengths
            if step > 0:
                y = ((1 - c) * y + c * (u + last)) / (1 + c)
            lengths = u - y
            force = self.at_rest * stiffness @ (u + self.weights @ lengths)
            last, v = u, v - dt * numpy.linalg.solve(mass, force)
            u = u + dt * v
            mean = (u + last) / 2
            energy = v @ fast @ v / 2 + self.at_rest / 2 * (mean @ stiffness @ mean + sum(
                a * x @ stiffness @ x for a, x in zip(self.weights, lengths + dt / 2 * v)))
            if step > 0:
                sums = lengths + before
                change = -self.at_rest / 2 * sum(
                    a * k * x @ stiffness @ x for a, k, x in zip(self.weights, c[:, 0], sums))
                yield energy - held, change, energy, u
            held = energy

    def test_energy_falls_by_what_the_dashpots_take(self):
        for seed in range(4):
            system = System(seed)
            limit = largest_step(system.mass, 0 * system.mass, self.at_rest * 1.6 * system.stiffness)
            for found, expected, energy, _ in self.move(system.stiffness, system.mass, 0.98 * limit, 400, seed):
                self.assertAlmostEqual(found, expected, delta=1e-12 * max(1, energy))
                self.assertLessEqual(expected, 0)
                self.assertGreater(energy, 0)

    def test_limit_is_exact(self):
        for seed in range(3):
            system = System(seed)
            limit = largest_step(system.mass, 0 * system.mass, self.at_rest * 1.6 * system.stiffness)
            for part, grows in ((0.999, False), (1.001, True)):
                *_, (_, _, _, last) = self.move(system.stiffness, system.mass, part * limit, 1500, seed)
                self.assertEqual(abs(last).max() > 1e6, grows, (seed, part))


class Scheme(unittest.TestCase):
    def test_energy_identity_with_contact(self):
        touched = 0
        for seed in range(4):
            system = System(seed)
            dt = 0.7 * system.limit
            u, v = system.displacement, system.velocity
            before = system.energy(dt, u, u - dt * v, v)
            for step in range(300):
                force = system.force(step)
                system.displacement = u
                free = v + dt * system.solve(force - system.damping @ v - system.stiffness @ u)
                impulse = system.impulse(free)
                after = free + system.solve(system.rows.T @ impulse)
                new, mean = u + dt * after, (after + v) / 2
                energy = system.energy(dt, new, u, after)
                work = impulse @ system.rows @ v / 2
                expected = -dt * mean @ system.damping @ mean + dt * mean @ force + work
                self.assertAlmostEqual(energy - before, expected, delta=1e-12 * max(1, abs(energy)))
                self.assertLessEqual(work, 1e-12)
                self.check_forms(system, dt, (u, v), (new, after), energy)
                if not impulse.any():
                    self.check_growth(system, dt, force, before, energy)
                touched += bool(impulse.any())
                u, v, before = new, after, energy
        self.assertGreater(touched, 100)
        self.assertLess(touched, 1100)

    def check_forms(self, system, dt, old, now, energy):
        """The energy by the mean displacement, and K v- out of q."""
        (u, v), (new, after) = old, now
        mean = (new + u) / 2
        positive = system.mass - dt / 2 * system.damping - dt**2 / 4 * system.stiffness
        other = after @ positive @ after / 2 + mean @ system.stiffness @ mean / 2
        self.assertAlmostEqual(energy, other, delta=1e-12 * max(1, abs(energy)))
        product = system.stiffness @ (u + system.beta * v)
        rate = (product - system.stiffness @ (u - dt * v)) / (system.beta + dt)
        numpy.testing.assert_allclose(rate, system.stiffness @ v, atol=1e-10)

    def check_growth(self, system, dt, force, before, energy):
        """What bounds how fast gaps close."""
        positive = system.mass - dt / 2 * system.damping - dt**2 / 4 * system.stiffness
        norm = numpy.sqrt(force @ numpy.linalg.solve(positive, force))
        self.assertLessEqual(numpy.sqrt(2 * energy) - numpy.sqrt(2 * before), dt * norm + 1e-10)

    def test_stable_below_the_limit_and_not_above(self):
        for seed in range(5):
            system = System(seed)
            for factor, stable in ((0.5, True), (0.9999, True), (1.0001, False), (1.1, False)):
                dt, one = factor * system.limit, numpy.eye(6)
                pull, drag = dt * system.solve(system.stiffness), dt * system.solve(system.damping)
                step = numpy.block([[one - dt * pull, dt * (one - drag)], [-pull, one - drag]])
                radius = abs(numpy.linalg.eigvals(step)).max()
                self.assertEqual(bool(radius < 1), stable, (seed, factor, radius))

    def test_limit_of_one_frequency_is_equation_12(self):
        for omega, alpha, beta in ((100.0, 0.2, 1e-5), (3e5, 0.16, 1.3e-5), (2.0, 0, 0), (5.0, 1.0, 3.0)):
            xi = alpha / (2 * omega) + beta * omega / 2
            rate = alpha + beta * omega**2
            quotients = 4 / (rate + numpy.hypot(rate, 2 * omega))
            stable_form = 2 / (omega * (numpy.hypot(1, xi) + xi))
            printed = 2 * (numpy.hypot(1, xi) - xi) / omega
            self.assertAlmostEqual(quotients / stable_form, 1, delta=1e-14)
            self.assertAlmostEqual(printed / stable_form, 1, delta=1e-15 * (1 + 4 * xi**2) * 10)
            found = largest_step(numpy.eye(1), numpy.eye(1) * rate, numpy.eye(1) * omega**2)
            self.assertAlmostEqual(found / stable_form, 1, delta=1e-9)


class Elements(unittest.TestCase):
    def test_scaled_mass_allows_the_wanted_step(self):
        random = numpy.random.default_rng(1)
        scaled = 0
        for _ in range(500):
            stiffness = random.uniform(1, 100) * numpy.array([[1, -1], [-1, 1]])
            mass = random.uniform(0.1, 2) * numpy.eye(2)
            alpha, beta, dt = random.uniform(0, 0.5), random.uniform(0, 0.1), random.uniform(0.01, 0.5)
            square = 2 * stiffness[0, 0] / mass[0, 0]
            factor = (2 * dt * beta + dt**2) / 4 - (1 - dt * alpha / 2) / square
            if factor <= 0:
                continue
            scaled += 1
            added = factor * stiffness
            damping = alpha * mass + beta * stiffness
            left = 4 * (mass + added) - 2 * dt * damping - dt**2 * stiffness
            self.assertGreater(smallest(left), -1e-10)
        self.assertGreater(scaled, 100)

    def test_scaled_mass_lowers_squared_frequencies_as_foretold(self):
        random = numpy.random.default_rng(2)
        stiff, rest = symmetric(random, 5, 1), symmetric(random, 5, 5)
        factor = 1e-5
        squares, modes = numpy.linalg.eigh(stiff + rest)
        scaled = numpy.linalg.eigvals(numpy.linalg.solve(numpy.eye(5) + factor * stiff, stiff + rest))
        shares = numpy.einsum("ik,ij,jk->k", modes, stiff, modes) / squares
        foretold = squares * (1 - factor * squares * shares)
        numpy.testing.assert_allclose(numpy.sort(scaled.real), foretold, rtol=1e-8)

    def test_scaled_mass_beside_local_steps(self):
        """A bar of 100 elements with ten of a tenth of their length in the middle, at 0.9 of the others' step."""
        length = numpy.r_[numpy.ones(50), numpy.full(10, 0.1), numpy.ones(50)]
        fine = length < 0.5
        size, dt, halvings, stabilisation = len(length), 0.9, 11, 0.01
        stiffness, mass, scaled = numpy.zeros((size + 1, size + 1)), numpy.zeros(size + 1), numpy.zeros((size + 1,) * 2)
        small = numpy.zeros(size + 1)
        for e, l in enumerate(length):
            element = numpy.array([[1, -1], [-1, 1]]) / l
            stiffness[e:e + 2, e:e + 2] += element
            mass[e:e + 2] += l / 2
            scaled[e:e + 2, e:e + 2] += max(0, dt**2 / 4 - l**2 / 4) * element
            small[e:e + 2] = numpy.maximum(small[e:e + 2], fine[e])
        stiffness, mass, scaled, small = stiffness[1:, 1:], mass[1:], scaled[1:, 1:] + numpy.diag(mass[1:]), small[1:]

        # Stabilised leap-frog with local steps: u_{n+1} = 2 z_p - u_{n-1} = 2 u_n - u_{n-1} - dt^2 M^-1 K_p u_n.
        per_mass = stiffness / mass[:, None]
        inner, outer = per_mass * small, per_mass * (1 - small)
        delta = 1 + stabilisation / halvings**2
        angle = numpy.arccosh(delta)
        chebyshev = [numpy.cosh(m * angle) for m in range(halvings + 1)]
        rate = 2 * halvings * numpy.sinh(halvings * angle) / numpy.sinh(angle) / chebyshev[halvings]
        before = numpy.eye(size)
        now = before - dt**2 / (rate * delta) * (outer + inner)
        for m in range(1, halvings):
            part, step = chebyshev[m - 1] / chebyshev[m + 1], chebyshev[m] / chebyshev[m + 1]
            after = (1 + part) * now - part * before - 2 * dt**2 * step / rate * (outer + inner @ now)
            before, now = now, after
        local = 2 * mass[:, None] * (numpy.eye(size) - now) / dt**2
        numpy.testing.assert_allclose(local, local.T, atol=1e-12 * abs(local).max())

        def frequencies(k, m):
            half = numpy.linalg.inv(numpy.linalg.cholesky(m))
            return numpy.sqrt(numpy.linalg.eigvalsh(half @ (k + k.T) / 2 @ half.T))

        diagonal = numpy.diag(mass)
        exact, by_steps = frequencies(stiffness, diagonal), frequencies(local, diagonal)
        by_mass = frequencies(stiffness, scaled)
        self.assertLess(by_mass[-1] * dt, 2)
        self.assertLess(by_steps[-1] * dt, 2)
        move = 1 - by_mass[:20] / exact[:20]
        nearest = [abs(by_steps / f - 1).min() for f in exact[:20]]
        own = (exact[:20] * dt)**2 / 24  # by which the step itself moves a frequency
        self.assertAlmostEqual(move[4], 1.93e-5, delta=1e-7)
        self.assertAlmostEqual(nearest[4], 1.37e-5, delta=1e-7)
        self.assertTrue((move < 0.04 * own).all())
        # Modes of the small elements appear among the lowest of the bar.
        self.assertGreater((by_steps < exact[19]).sum(), 20)
        self.assertEqual((by_mass < exact[19]).sum(), 20)

    def test_coordinate_with_scaled_mass_has_the_wanted_limit(self):
        omega, alpha, beta, dt = 4e4, 0.2, 1e-5, 6e-5
        mass = (2 * dt * beta + dt**2) * omega**2 / (4 - 2 * dt * alpha)
        self.assertGreater(mass, 1)
        found = largest_step(numpy.eye(1), numpy.eye(1) * (alpha + beta * omega**2 / mass),
                             numpy.eye(1) * omega**2 / mass)
        self.assertAlmostEqual(found / dt, 1, delta=1e-9)

    def test_tension_only_bar_gives_back_no_more_than_it_took(self):
        random = numpy.random.default_rng(3)
        stiffness = 2.0
        for before, now, after in random.normal(size=(20000, 3)):
            taut = [max(0.0, elongation) for elongation in (before, now, after)]
            pull = stiffness * taut[1] * (taut[2] - taut[0]) / (after - before)
            change = stiffness * taut[1] * (taut[2] - taut[0]) / 2
            for drag in (0.0, 0.3, 30.0):  # c / (2 dt)
                tension = max(0.0, pull + drag * (after - before)) if now > 0 else 0.0
                work = tension * (after - before) / 2
                self.assertGreaterEqual(work, change - 1e-12)
                if drag == 0:
                    self.assertAlmostEqual(work, change, delta=1e-12)
            if min(before, now, after) > 0:
                self.assertAlmostEqual(pull, stiffness * now, delta=1e-12)

    def test_rayleigh_damping_holds_at_both_frequencies(self):
        ratio, first, second = 0.006, 2 * numpy.pi * 2.1, 2 * numpy.pi * 150
        alpha, beta = 2 * ratio * first * second / (first + second), 2 * ratio / (first + second)
        for omega in (first, second):
            self.assertAlmostEqual(alpha / (2 * omega) + beta * omega / 2, ratio, delta=1e-15)

    def test_means_with_lines_between_lower_a_spectrum_as_told(self):
        times = 0.045  # f h
        self.assertAlmostEqual(1 - numpy.sinc(times)**3, (numpy.pi * times)**2 / 2, delta=1e-4)
        self.assertAlmostEqual(1 - numpy.sinc(times)**3, 0.01, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
