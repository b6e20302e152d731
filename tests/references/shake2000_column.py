"""The sample column of SHAKE91 as SHAKE2000 1.1 iterates it (test/shake2000b/example.out of github.com/arkottke/strata), beside
run/column's: python3 tests/references/shake2000_column.py DIAM.ACC, the record of that folder (Loma Prieta 1989, Diamond Heights)."""
import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from pounding.column import curves, iteration  # noqa: E402
from pounding.column.waves import Column, Given  # noqa: E402

G = 32.174  # [ft/s2]; feet, kips and seconds
STRAIN = numpy.array([1e-4, 3e-4, 1e-3, 3e-3, .01, .03, .1, .3, 1, 3, 10]) / 100
DAMPING = numpy.array([.24, .42, .8, 1.4, 2.8, 5.1, 9.8, 15.5, 21, 25, 28]) / 100
CLAY = curves.Curve("clay", STRAIN, numpy.array([1, 1, 1, .981, .941, .847, .656, .438, .238, .144, .110]), DAMPING)
SAND = curves.Curve("sand", STRAIN, numpy.array([1, 1, .99, .96, .85, .64, .37, .18, .08, .05, .035]), DAMPING)
SPEED = numpy.array([1000, 900, 900, 950, 1000, 1000, 1100, 1100, 1300, 1300, 1400, 1400, 1500, 1500, 1600, 1800, 4000.])
# Of its output: final shear moduli [ksf], largest strains [%], largest accelerations at the tops [g].
MODULI = numpy.array([3855.2, 3022.9, 2806.7, 2988.8, 3625.3, 3544.1, 4300.4, 4244.1, 5409.2, 5272.4, 6295.8, 6210.9, 7366.1, 7299.6,
                      8580.6, 11304.4])
STRAINS = numpy.array([.00154, .00590, .01266, .01950, .02196, .02804, .02721, .03129, .02708, .03008, .02669, .02822, .02464, .02560,
                       .02227, .01727])
ACCELERATIONS = numpy.array([.19043, .19008, .18876, .18261, .17211, .15948, .14289, .12653, .11051, .09840, .08997, .08268, .08558,
                             .08545, .08200, .07769, .07616])


def deviations(path: Path) -> dict:
    """Relative deviations of moduli, strains and accelerations of all layers."""
    lines = path.read_text().splitlines()[3:253]
    motion = numpy.array([float(line[k:k + 10]) for line in lines for k in range(0, 80, 10)])
    density = numpy.array([.125] * 8 + [.130] * 8 + [.140]) / G
    column = Column(numpy.array([5, 5] + [10] * 14, float), density, density * SPEED**2, numpy.array([0] * 16 + [.01]))
    soil = iteration.Soil(column, tuple(CLAY if 4 <= k < 8 else SAND for k in range(16)), tuple(map(str, range(17))))
    found = iteration.iterate(soil, .1 * G * motion / abs(motion).max(), .02, Given(16, True), Given(0, True),
                              iteration.Rule(.5, 1e-6, 100))
    return {"moduli": found.column.modulus[:-1] / MODULI - 1, "strains": 100 * found.strain / STRAINS - 1,
            "accelerations": found.acceleration / G / ACCELERATIONS - 1}


if __name__ == "__main__":
    for name, values in deviations(Path(sys.argv[1])).items():
        print(f"{name}: {values.min():+.1e} to {values.max():+.1e}")
