"""One or two damped oscillators under ground motion that hit each other, or a stop, without rebound.

`events` solves them between events in closed form (the ground is linear between its samples) and finds impact
and release by bisection: no time stepping. `scheme` is the time stepping scheme on the same masses. Body one
moves towards +x and meets body two, or the stop, when gap + u2 - u1 = 0."""
import math
from dataclasses import dataclass, field

import numpy

TOUCH = 1e-13  # m: depth by which a gap counts as closed


@dataclass
class Oscillator:
    mass: float
    stiffness: float
    alpha: float  # damping over mass [1/s]

    def acceleration(self, u, v, ground):
        return -ground - self.alpha * v - self.stiffness / self.mass * u

    def after(self, u, v, ground, slope, t):
        """State after a time t under the ground acceleration ground + slope t."""
        square, half = self.stiffness / self.mass, self.alpha / 2
        # a particular solution p + q t of u'' + 2 half u' + square u = -ground - slope t
        q = -slope / square
        p = -(ground + 2 * half * q) / square
        turn = math.sqrt(square - half**2)
        decay, c, s = math.exp(-half * t), math.cos(turn * t), math.sin(turn * t)
        a, b = u - p, (v - q + half * (u - p)) / turn
        moved = decay * (a * c + b * s)
        return (moved + p + q * t, decay * turn * (b * c - a * s) - half * moved + q)


@dataclass
class History:
    """Displacements at the samples of the ground, impacts (time, impulse, speed of closing), releases."""
    u1: numpy.ndarray
    u2: numpy.ndarray
    impacts: list = field(default_factory=list)
    releases: list = field(default_factory=list)


def together(one, two, gap):
    """Two bodies that stay in contact: the oscillator of u1 about its rest, and that rest."""
    mass, stiffness = one.mass + two.mass, one.stiffness + two.stiffness
    damping = (one.alpha * one.mass + two.alpha * two.mass) / mass
    return Oscillator(mass, stiffness, damping), two.stiffness * gap / stiffness


def root(function, low, high):
    """Where a function that is not negative at `low` and negative at `high` changes its sign."""
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) >= 0 else (low, middle)
    return (low + high) / 2


class Pair:
    """Free flight and contact of two bodies; `two` None: a stop."""

    def __init__(self, one, two, gap):
        self.one, self.two, self.gap = one, two, gap
        if two is not None:
            self.joined, self.rest = together(one, two, gap)
        self.state, self.stuck = (0.0, 0.0, 0.0, 0.0), False

    def moved(self, ground, slope, t):
        u1, v1, u2, v2 = self.state
        if self.stuck and self.two is None:
            return self.state
        if self.stuck:
            w, v = self.joined.after(u1 - self.rest, v1, ground, slope, t)
            return (w + self.rest, v, w + self.rest - self.gap, v)
        one = self.one.after(u1, v1, ground, slope, t)
        return one + (self.two.after(u2, v2, ground, slope, t) if self.two else (0.0, 0.0))

    def opening(self, state):
        return self.gap + state[2] - state[0]

    def force(self, state, ground):
        """Compression while they stay together."""
        u1, v1, u2, v2 = state
        alone = self.one.acceleration(u1, v1, ground)
        if self.two is None:
            return self.one.mass * alone
        both = (self.one.mass * alone + self.two.mass * self.two.acceleration(u2, v2, ground)) / \
            (self.one.mass + self.two.mass)
        return self.one.mass * (alone - both)

    def impact(self):
        """Plastic: one velocity after it; returns the impulse and the speed of closing."""
        u1, v1, u2, v2 = self.state
        closing = v1 - v2
        if self.two is None:
            self.state = (self.gap, 0.0, 0.0, 0.0)
            return self.one.mass * closing, closing
        m1, m2 = self.one.mass, self.two.mass
        v = (m1 * v1 + m2 * v2) / (m1 + m2)
        self.state = (u1, v, u2, v)
        return m1 * (v1 - v), closing


def events(one, two, gap, ground, step):
    """The history under a ground acceleration sampled every `step`."""
    pair = Pair(one, two, gap)
    history = History(numpy.zeros(len(ground)), numpy.zeros(len(ground)))
    for i in range(len(ground) - 1):
        slope, done = (ground[i + 1] - ground[i]) / step, 0.0
        while done < step:
            here = ground[i] + slope * done
            left = step - done
            ends = pair.moved(here, slope, left)
            if pair.stuck:
                held = lambda t: pair.force(pair.moved(here, slope, t), here + slope * t)  # noqa: E731
                if held(left) >= 0:
                    pair.state = ends
                    break
                t = root(held, 0.0, left)
                pair.state, pair.stuck = pair.moved(here, slope, t), False
                done += t
                history.releases.append(i * step + done)
                continue
            if pair.opening(ends) >= -TOUCH:
                pair.state = ends
                break
            t = root(lambda t: pair.opening(pair.moved(here, slope, t)), 0.0, left)
            pair.state = pair.moved(here, slope, t)
            done += t
            history.impacts.append((i * step + done, *pair.impact()))
            pair.stuck = pair.force(pair.state, ground[i] + slope * done) > 0
        history.u1[i + 1], history.u2[i + 1] = pair.state[0], pair.state[2]
    return history


def scheme(one, two, gap, ground, step, time_step, end):
    """Displacements before each step, impulses of the steps; the ground is linear between samples."""
    count = math.ceil(end / time_step - 1e-9) + 1
    times = numpy.arange(count) * time_step
    load = numpy.interp(times, numpy.arange(len(ground)) * step, ground, right=0.0).tolist()
    bodies = [one] if two is None else [one, two]
    masses = [one.mass, math.inf if two is None else two.mass]
    delassus = 1 / masses[0] + 1 / masses[1]
    u, v = [0.0, 0.0], [0.0, 0.0]
    first, second, impulse = numpy.zeros((3, count))
    for n in range(count):
        first[n], second[n] = u
        duration = time_step if n > 0 else time_step / 2
        for k, body in enumerate(bodies):
            v[k] += duration * body.acceleration(u[k], v[k], load[n])
        rate = v[1] - v[0]
        if gap + u[1] - u[0] <= 0 and rate < 0:
            impulse[n] = -rate / delassus
            v[0] -= impulse[n] / masses[0]
            v[1] += impulse[n] / masses[1]
        u = [u[0] + time_step * v[0], u[1] + time_step * v[1]]
    return first, second, impulse
