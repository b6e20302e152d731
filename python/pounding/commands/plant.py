"""The plant pair with and without pounding: run/plant [--size small|medium|large] [--fidelity full,modal]

Runs the pair of petsc-options/plant at a size and at one fidelity or more, and without contacts at the first; then
draws each run and sets them beside each other: impacts by floor, spectra at floors and cabinets, what it cost. May be
stopped and started again; finished runs are not repeated. The page is plant.html in the folder of --out.
"""

import argparse
from pathlib import Path

from pounding.arguments import names, positive, ranks, words
from pounding.compare import page, runs
from pounding.plant import study
from pounding.study import alone_in, understood

from .process import called, parser_of

NAME = called("run/plant")
GOES_ON = True


def arguments() -> argparse.Namespace:
    parser = parser_of(__doc__)
    parser.add_argument("--size", choices=study.SIZES, default="small", help="of the meshes (default: small)")
    parser.add_argument("--fidelity", metavar="LIST", type=names(study.FIDELITIES), default=["full"],
                        help=f"{', '.join(study.FIDELITIES)}, or several between commas (default: full)")
    parser.add_argument("--modes", metavar="N", type=positive(int), default=200,
                        help="of each building where it is modal, with attachment vectors beside (default: 200)")
    parser.add_argument("--seconds", metavar="T", type=positive(float), default=10.0,
                        help="of the motion, in three directions (default: 10)")
    parser.add_argument("--gap", metavar="M", type=positive(float), default=0.025, help="joint [m], 5 mm narrower at one end (default: 0.025)")
    parser.add_argument("--ranks", metavar="N", type=ranks, default=2, help="of each run (default: 2)")
    parser.add_argument("--options", metavar="TEXT", type=words, default=[], help="more options of every run, in one word")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder of all (default: results/plant-SIZE)")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    folder = options.out or Path("results") / f"plant-{options.size}"
    members = study.members(options.fidelity, options.modes, options.seconds, options.gap, folder)
    with alone_in(folder, NAME):
        study.run_all(members, options.size, options.options, options.ranks, folder)
        with understood(folder):
            found = runs.read([folder / member.name for member in members])
            written = study.write(found, folder)
            text = study.text(found) + "\n" + page.text(found)
    print(text)
    print(f"see {written}")
    return 0
