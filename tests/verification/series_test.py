"""Springs and dampers in series, with a state of their own: a published case, an integration that is not this
program's, and the same element at full order, in modes, on any ranks and in a continued run."""
import unittest

import numpy
import scipy.integrate

import program
from nonlinear_springs_test import mass, spring
from program import write_samples
from recorded import Recorded, assert_continues
from springs_test import chain, point
from springs_test import spring as link

ZENER = {"dashpot": "1.7,0,0", "dashpot_stiffness": "60,0,0", "series_stiffness": "120,0,0"}


class Zener(unittest.TestCase):
    def test_support_that_jumps(self):
        """SDND107A of Code_Aster's manual of verification: the support jumps by .1 m, the mass is at rest."""
        step = 2e-5
        jump = write_samples([0, .1 / step**2, -.1 / step**2, 0], step)
        words = mass(step, 5.01, "-chain_first_mass", 1, *spring("10,0,0", **ZENER), "-motion_x_record", jump,
                     "-motion_x_unit", "m/s2", "-chain_allow_loose", "true", "-output_interval", 2e-4)
        for ranks in (1, 2):
            # Seen from the ground the mass jumps at 5000 m/s: the energy of that is lost and found to its round-off.
            run = Recorded(self, words, ranks, identity=1e-7)
            # The ground has jumped at 1.5 steps.
            position = numpy.interp([t + 1.5 * step for t in (.5, 1, 1.5, 2, 3, 5)], run.time,
                                    run.displacement("one.x")) + .1
            expected = numpy.array([.114023, .151027, .096798, .075906, .111272, .102398])
            self.assertLess(abs(position - expected).max(), 1e-6)
            self.assertGreater(run.energy["devices"], 0)


class PowerOfTheRate(unittest.TestCase):
    """A mass of 50 kg on K1 in series with [K2 beside (K3 in series with c v^a)], by an implicit integrator."""
    K2 = 2e3

    def reference(self, time, outer, inner, strength, exponent):
        def rates(_, y):
            u, v, d = y  # d: of the dashpot
            x = (outer * u + inner * d) / (outer + self.K2 + inner) if outer > 0 else u
            q = inner * (x - d)
            force = self.K2 * x + q
            return v, -force / 50, numpy.sign(q) * (abs(q) / strength)**(1 / exponent)
        return scipy.integrate.solve_ivp(rates, (0, time[-1]), [0, 1, 0], "Radau", t_eval=time, rtol=1e-9,
                                         atol=1e-11).y[0]

    def test_beside_an_integrator(self):
        for outer, inner, strength, exponent, ranks in ((0, 4e3, 300, .3, 1), (6e3, 4e3, 300, .5, 2),
                                                       (6e3, 4e3, 100, 1.6, 1)):
            run = Recorded(self, mass(1e-4, 2, "-chain_initial_velocity", "0,1,0", "-output_interval", 1e-2, *spring(
                f"0,{self.K2},0", dashpot=f"0,{strength},0", dashpot_exponent=exponent,
                dashpot_stiffness=f"0,{inner},0", series_stiffness=f"0,{outer},0")), ranks)
            expected = self.reference(run.time, outer, inner, strength, exponent)
            self.assertLess(abs(run.displacement("one.y") - expected).max(), 1e-5 * abs(expected).max())

    def test_the_smallest_power_slips_at_its_force(self):
        """c v^.01 is all but Coulomb's friction: the mass stops after v0^.99 m / (.99 c)."""
        run = Recorded(self, mass(1e-4, .6, "-chain_initial_velocity", "0,1,0", *spring(
            "0,1e-9,0", dashpot="0,100,0", dashpot_exponent=.01)), 2)
        time = run.time + 5e-5  # of the velocity
        expected = numpy.maximum(1 - .99 * 100 / 50 * time, 0)**(1 / .99)
        self.assertLess(abs(run.velocity("one.y") - expected).max(), 2e-4)

    def test_however_stiff_and_strong(self):
        """At a step that the spring beside it decides: 1e12 N/m would want one a million times shorter."""
        for exponent in (.3, 1):
            run = Recorded(self, mass(1e-3, .5, "-chain_initial_velocity", "0,1,0", *spring(
                "0,1000,0", dashpot="0,1e5,0", dashpot_exponent=exponent, dashpot_stiffness="0,1e12,0")), 2)
            self.assertLessEqual(abs(run.velocity("one.y")).max(), 1 + 1e-12)
            self.assertGreaterEqual(run.energy["devices"], 0)


def pair(*more):
    """Two masses, the first on a Zener element, the second on a Maxwell element to the first and a spring."""
    return chain(1e-3, 1.5, *point("first", 50.0), *point("second", 20.0), "-chain_mesh_set", "links=2",
                 *link("support", "grounded_spring", "3e4,3e4,3e4", "200,200,0"),
                 "-chain_support_dashpot_stiffness", "2e4,2e4,0", "-chain_support_series_stiffness", "6e4,6e4,0",
                 *link("link2", "spring", "1e3,1e3,1e3", "300,300,0"), "-chain_link2_dashpot_stiffness", "1e4,1e4,0",
                 "-output_interval", .01, *more)


class TwoMasses(unittest.TestCase):
    def test_on_any_ranks_and_in_modes(self):
        full = Recorded(self, pair(), 1)
        power = ("-chain_link2_dashpot_exponent", .4)
        for more, others in (((), (full, Recorded(self, pair(), 3))), (power, (Recorded(self, pair(*power), 2),))):
            modal = Recorded(self, pair("-chain_model", "modal", "-chain_modal_vectors", 6, *more), 2)
            for run in others:
                for name in ("one.x", "two.x"):
                    u, v = modal.displacement(name), run.displacement(name)
                    self.assertLess(abs(u - v).max(), 1e-9 * abs(u).max())
            self.assertGreater(modal.energy["devices"], 0)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        for more in ((), ("-chain_link2_dashpot_exponent", .4)):
            assert_continues(self, pair(*more), .7, 300)


class Refused(unittest.TestCase):
    def test_by_name(self):
        for more, words in (
                (("-chain_support_series_stiffness", "6e4,6e4,5"), ("-chain_support_series_stiffness", "along z")),
                (("-chain_link2_dashpot_stiffness", "1e4,1e4,5"), ("-chain_link2_dashpot_stiffness", "along z")),
                (("-chain_support_yield_force", "5,0,0"), ("-chain_support_series_stiffness", "yields along x")),
                (("-export_matrices", "/tmp/none"), ("-export_matrices", "link2", "in series")),
                (("-chain_link2_dashpot_stiffness", "0,0,0", "-chain_support_dashpot_stiffness", "0,0,0",
                  "-chain_support_series_stiffness", "0,0,0", "-chain_link2_dashpot_exponent", .5,
                  "-export_matrices", "/tmp/none"), ("-export_matrices", "link2", "power"))):
            program.must_refuse(self, pair(*more), *words)


if __name__ == "__main__":
    unittest.main()
