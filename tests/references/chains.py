"""The scheme on masses, springs and one contact row, written anew from its equations: what the program must
reproduce step by step on bars whose sections move as one.

    M (v+ - v-) = dt (f - C v- - K u) + L^T lambda,  u+ = u + dt v+,  0 <= L v+  _|_  lambda >= 0  where g(u) <= 0

The first step has the duration dt / 2. With one row the complementarity problem is one division."""
import numpy


def bar(elements, length, young, density, area=1.0):
    """Lumped masses and stiffness matrix of a bar of equal elements."""
    mass = numpy.full(elements + 1, density * area * length / elements)
    mass[[0, -1]] /= 2
    stiffness = numpy.zeros((elements + 1, elements + 1))
    for e in range(elements):
        stiffness[e:e + 2, e:e + 2] += young * area * elements / length * numpy.array([[1, -1], [-1, 1]])
    return mass, stiffness


def side_by_side(one, two):
    """Masses and stiffness of two bars that only contact joins."""
    mass = numpy.concatenate([one[0], two[0]])
    stiffness = numpy.zeros((len(mass), len(mass)))
    first = len(one[0])
    stiffness[:first, :first], stiffness[first:, first:] = one[1], two[1]
    return mass, stiffness


def march(mass, stiffness, row, gap, time_step, steps, velocity, acceleration=0.0):
    """Displacement before each step, velocity after it (shape (steps, masses)), and impulse."""
    u, v = numpy.zeros(len(mass)), numpy.array(velocity, dtype=float)
    delassus = row @ (row / mass)
    displacements, velocities, impulses = numpy.zeros((2, steps, len(mass))).tolist() + [numpy.zeros(steps)]
    for n in range(steps):
        displacements[n] = u.copy()
        duration = time_step if n > 0 else time_step / 2
        v = v + duration * (acceleration - stiffness @ u / mass)
        rate = row @ v
        if gap + row @ u <= 0 and rate < 0:
            impulses[n] = -rate / delassus
            v = v + impulses[n] * row / mass
        velocities[n] = v
        u = u + time_step * v
    return numpy.array(displacements), numpy.array(velocities), impulses


def centre(mass, velocities, part=slice(None)):
    """Velocity of the centre of mass of some of the masses."""
    return velocities[:, part] @ mass[part] / mass[part].sum()
