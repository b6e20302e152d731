"""Two elastic slabs on springs pound: contacts, impulses and floor spectra up to 400 Hz.

Bars of 3.0 and 2.4 m, 4600 and 3500 kg, of concrete, springs in proportion to the mass at every
node (2.1 and 3.7 Hz), Rayleigh damping as for the two-storey pair, gap 2 cm, ground 0.30 g
sin(2 pi 2.6 t) for 3 s. Spectra of 5 % damping from accelerations that are means over 5e-5 s.
What the figures say: a dozen elements per slab, and any stable step, serve to 0.2 %; a gap of 1 %
more changes the spectra by 0.3 %; without stiffness-proportional damping they rise by 10 %, with
ten times as much of it they fall by 30 %; a single element per slab errs as much.

Reference: an independent one-dimensional code. Here the bars are hexahedra without Poisson effect;
both have the section of the first, the second has its mass and stiffness per length by its material.
"""
import math
import unittest

import numpy

from recorded import Recorded, reference, write_sine

YOUNG, DENSITY = 30e9, 2400.0
# length [m], mass [kg], frequency on the springs [Hz], alpha [1/s], beta [s]
SLABS = {"one": (3.0, 4600.0, 2.1, 0.1562, 1.2557e-5), "two": (2.4, 3500.0, 3.7, 0.2723, 1.2426e-5)}
AREA = 4600.0 / (DENSITY * 3.0)
END, SAMPLING = 3.0, 5e-5
# Two centimetres of rigid motion on bars of 1e10 N/m per element leave a force by round-off.
IDENTITY_OF_SPRUNG_BARS = 2e-10  # measured: 4e-11

# elements, factor on beta, gap [m]; time step [s], number of contacts, the first: start and
# duration [s], impulse [N s]; impulse of all; of the spectra of the far end of the second slab over
# those with 100 and 80 elements: root mean square and largest of the logarithm
RUNS = {
    "m25_20": ((25, 20), 1, 0.02, 1.6666666666666667e-05, 8, 0.366116667, 0.001516667,
               2446.3835276449213, 49161.088337124944, 0.000139038, 0.000378664),
    "m12_10": ((12, 10), 1, 0.02, 5e-05, 8, 0.3661, 0.00155,
               2444.3793378844466, 49114.44426206872, 0.001574088, 0.003067201),
    "m25_20_cfl05": ((25, 20), 1, 0.02, 1e-05, 8, 0.36611, 0.00151,
                     2446.222415274374, 49152.601288538404, 0.000328369, 0.000574575),
    "m25_20_gap1pct": ((25, 20), 1, 0.0202, 1.6666666666666667e-05, 8, 0.3664, 0.001516667,
                       2445.896849911556, 49304.44371999861, 0.003002698, 0.004934068),
    "m25_20_nobeta": ((25, 20), 0, 0.02, 2.5e-05, 8, 0.3661, 0.001425,
                      2495.133006042225, 50999.10800849491, 0.109949228, 0.390027413),
    "m25_20_beta10": ((25, 20), 10, 0.02, 4.166666666666667e-06, 7, 0.3661625, 0.0014125,
                      2112.235766832314, 33733.196376352455, 0.296975351, 0.409927984),
    "m1_1": ((1, 1), 0, 0.02, 5e-05, 7, 0.3661, 0.00165,
             2013.802569973177, 31226.266889049566, 0.228220024, 0.595734552),
}


def slab(name, elements, factor):
    length, mass, frequency, alpha, beta = SLABS[name]
    start = -length if name == "one" else 0.0
    share = mass / (AREA * length * DENSITY)
    spring = mass / (4 * elements) * (2 * math.pi * frequency)**2
    words = [f"-{name}_mesh", "tests/meshes/sprung_bar.geo", f"-{name}_mesh_set",
             f"x0={start},length={length},side={math.sqrt(AREA)!r},n={elements}",
             f"-{name}_body_element", "hex8_full", f"-{name}_body_material", name,
             f"-material_{name}_young", repr(YOUNG * share), f"-material_{name}_poisson", 0,
             f"-material_{name}_density", repr(DENSITY * share),
             f"-{name}_damping_alpha", alpha, f"-{name}_damping_beta", repr(factor * beta),
             f"-{name}_ends_element", "grounded_spring",
             f"-{name}_ends_stiffness", ",".join([repr(spring / 2)] * 3)]
    if elements > 1:
        words += [f"-{name}_inner_element", "grounded_spring",
                  f"-{name}_inner_stiffness", ",".join([repr(spring)] * 3)]
    # The centre of mass as a mean over points: the inner ones count twice.
    places = [start + length * i / elements for i in range(elements + 1)]
    places += places[1:-1]
    return words + [f"-centre_{name}_structure", name,
                    f"-centre_{name}_at", "; ".join(f"{x!r},0,0" for x in places)]


def scene(record, elements, factor, gap, time_step, end=END):
    far_end = f"{SLABS['two'][0]},0,0"
    return ["-structures", "one,two", "-contacts", "joint", "-joint_secondary", "one:x_max",
            "-joint_primary", "two:x_min", "-joint_gap", repr(gap), "-impact_merge_time", 1e-3,
            "-motion_x_record", record, "-motion_x_unit", "m/s2", "-time_step", repr(time_step),
            "-end_time", end, "-output_interval", repr(SAMPLING * (1 + 1e-9)),
            "-spectra_frequencies", "1:400:157log",
            "-probes", "centre_one,centre_two,end_two", "-end_two_structure", "two",
            "-end_two_at", far_end, *slab("one", elements[0], factor),
            *slab("two", elements[1], factor)]


class SlabPounding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_sine(0.30 * 9.81, 2.6, END, 2.5e-5)
        cls.runs = {}

    def run_of(self, name):
        if name not in self.runs:
            elements, factor, gap, time_step = RUNS[name][:4]
            self.runs[name] = Recorded(self, scene(self.record, elements, factor, gap, time_step),
                                       identity=IDENTITY_OF_SPRUNG_BARS)
        return self.runs[name]

    def test_contacts_and_impulses(self):
        for name in RUNS:
            time_step, count, first, duration, impulse, total = RUNS[name][3:9]
            with self.subTest(name):
                run = self.run_of(name)
                self.assertAlmostEqual(run.time_step, time_step, delta=1e-12)
                self.assertEqual(len(run.column("start")), count)
                self.assertAlmostEqual(run.column("start")[0], first, delta=1e-9)
                self.assertAlmostEqual(run.column("duration")[0], duration, delta=1e-9)
                self.assertAlmostEqual(run.column("impulse")[0] / impulse, 1, delta=1e-6)
                self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / total, 1,
                                       delta=1e-6)

    def test_every_contact_and_the_spectra_themselves(self):
        contacts, spectra = reference("slab_contacts.csv"), reference("slab_spectra.csv")
        for name in RUNS:
            with self.subTest(name):
                run = self.run_of(name)
                mine = contacts["run"] == name
                self.assertEqual(mine.sum(), RUNS[name][4])
                for column, scale in (("start", 1e-9), ("duration", 1e-9), ("impulse", 1e-6)):
                    expected = contacts[column][mine]
                    allowed = scale if column != "impulse" else scale * expected
                    self.assertTrue((abs(run.column(column) - expected) <= allowed).all(), column)
                # Where blocks of several steps are cut matters where forces jump: at the centre
                # of mass, which feels the contact force itself, and everywhere without beta.
                one_step_blocks = run.time_step > 0.9 * SAMPLING
                for probe in ("centre_one", "centre_two", "end_two"):
                    _, found = run.spectrum(probe, "x")
                    mine = (spectra["run"] == name) & (spectra["channel"] == probe)
                    self.assertGreater(mine.sum(), 20)
                    lines = spectra["line"][mine].astype(int)
                    smooth = one_step_blocks or (probe == "end_two" and RUNS[name][1] > 0)
                    ratio = numpy.log(found[lines] / spectra["psa"][mine])
                    self.assertLess(abs(ratio).max(), 5e-6 if smooth else 2e-3, probe)

    def test_spectra_beside_those_of_fine_meshes(self):
        spectra = reference("slab_spectra.csv")
        fine = spectra["psa"][spectra["run"] == "ref_100_80"]
        for name in RUNS:
            rms, largest = RUNS[name][9:]
            with self.subTest(name):
                frequency, found = self.run_of(name).spectrum("end_two", "x")
                self.assertEqual(len(frequency), len(fine))
                ratio = numpy.log(found / fine)
                self.assertAlmostEqual(math.sqrt((ratio**2).mean()) / rms, 1, delta=0.03)
                self.assertAlmostEqual(abs(ratio).max() / largest, 1, delta=0.01)


# Two centimetres of rigid motion on stiff bars leave round-off.
ON_RANKS = {"slabs on springs": (
    lambda: scene(write_sine(0.30 * 9.81, 2.6, 0.4, 2.5e-5), *RUNS["m12_10"][:4], 0.4), {"tolerance": 1e-10})}


if __name__ == "__main__":
    unittest.main()
