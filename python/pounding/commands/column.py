"""Level ground whose moduli and damping agree with its strains: run/column FILE [--out DIR]

FILE (YAML) has layers, half-space, curves of modulus and damping over the shear strain, and motions. Shear waves go straight up;
moduli and damping of each layer follow its effective strain until they agree. Writes per estimate (best, upper, lower) a
table of layers and the motions at the mats, the transfer functions, a figure, and soils.yaml, the block `soils` of a study.
docs/manual/column.md has the keys and the method.
"""

from pathlib import Path

from pounding.arguments import positive
from pounding.column import answer, column_file, motions, output

from .process import parser_of


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("file", metavar="FILE", type=Path, help="layers, curves and motions")
    parser.add_argument("--out", metavar="DIR", type=Path, help="(default: results/FILE)")
    parser.add_argument("--thickest", metavar="M", type=positive(float),
                        help="sublayers in place of those of the file (default there: a wave takes 5 ms through one)")
    options = parser.parse_args()
    folder = options.out or Path("results") / options.file.stem
    ground = column_file.read(options.file, options.thickest)
    signals = motions.signals_of(ground)
    estimates = [answer.estimate(ground, name, soil, signals) for name, soil in ground.estimates().items()]
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for one in estimates:
        output.write_table(folder, one, ground.rule.ratio)
        files[one.name] = output.write_motions(folder / "motions", one, signals)
    output.write_transfer(folder, ground, estimates)
    lines = [line for one in estimates for line in answer.lines_of(one, signals)]
    if ground.mats.structures:
        lines += [f"{one.name}: a half-space of " + "{:.4g} m/s and {:.4g} kg/m3".format(
            *output.half_space(one, ground.mats.depth, ground.mats.over)) + " under the mats" for one in estimates]
    lines += [f"warning: {doubt}" for doubt in column_file.doubts_of(ground)]
    lines += [f"warning: {doubt}" for one in estimates for doubt in answer.doubts_of(one, signals, ground.rule.ratio)]
    if ground.level:
        output.write_soils(folder / "soils.yaml", ground, estimates, files)
    from pounding.plot.column_figure import draw
    lines.append(f"see {draw(ground, estimates, folder)}")
    print("\n".join(lines))
    return 0
