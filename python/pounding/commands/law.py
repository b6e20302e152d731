"""The loops of every law of a scene, with the energy that they take: run/law SCENE [--amplitudes 1,2,4] [--out DIR]

The program takes each law in one dimension of the scene, of springs, bars and sections that yield, through two cycles of
each amplitude, given over the elongation of its first corner, and writes them to laws.csv; laws.png draws them. No mesh
is read and nothing is stepped: laws of bars are those of their strain, per length.
"""

from pathlib import Path

from pounding.arguments import numbers_above_0, words
from pounding.plot import law_figure
from pounding.runs import RunError, alone

from .process import parser_of


def follow(scene: Path, amplitudes: list, more: list, folder: Path) -> Path:
    """Has the program write laws.csv into the folder. Throws RunError."""
    failure = alone("-options_file", scene, *more, "-law_cycles", ",".join(map(repr, amplitudes)), "-output", folder)[1]
    if failure:
        raise RunError(failure)
    return folder / "laws.csv"


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("scene", metavar="SCENE", type=Path, help="options file of the scene")
    parser.add_argument("--amplitudes", metavar="A,B,...", type=numbers_above_0, default=[1.0, 2.0, 4.0, 8.0],
                        help="over the elongation of the first corner (default: 1,2,4,8)")
    parser.add_argument("--options", metavar="TEXT", type=words, default=[], help="more options of the program")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder (default: results/law-SCENE)")
    options = parser.parse_args()
    folder = options.out or Path("results") / f"law-{options.scene.stem}"
    table = follow(options.scene, options.amplitudes, options.options, folder)
    for line in law_figure.draw(law_figure.read(table), folder):
        print(line)
    return 0
