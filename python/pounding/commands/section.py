"""Laws of a reinforced concrete wall, from its concrete and its steel: run/section --strength 30e6 --steel 0.008 --yield 400e6
--thickness 0.3 [--pressure 1e6]

Prints the skeleton of shear stress over shear strain in the plane of the wall, the parameters of the law that cracks, and
the options to paste into a scene, in SI units. The skeleton is trilinear, by the formulas of accounts of JEAC 4601 for
shear walls with columns or cross walls along their edges (docs/reference/nonlinear.md has them, and their limits); a panel
without such edges (--panel) carries no more than its steel does in both directions.
"""

import argparse
import math

from pounding import UserError
from pounding.arguments import numbers_above_0, positive

from .process import parser_of

STEEL = 2.05e11  # Pa, Young's modulus
LAST_STRAIN = 4e-3
ROOT = 0.313  # of sqrt(Fc) with both in MPa, which is sqrt(Fc) with both in kgf/cm2




def root_of(strength: float) -> float:
    """sqrt(Fc) of the formulas [Pa]: close to the tensile strength."""
    return ROOT * 1e6 * math.sqrt(strength / 1e6)


def skeleton(shear: float, root: float, pressure: list, hold: list, aspect: float, panel: bool, cracking: float | None) -> list:
    """Corners, pairs of strain and stress [Pa]. `shear`: modulus; `hold`: steel ratio times yield stress, both ways [Pa];
    `cracking`: the first stress where it is known."""
    first = cracking or math.sqrt(root * (root + pressure[0]))
    carried = sum(hold) / 2 + sum(pressure) / 2
    most = 4.5 * root
    last = most
    if carried < most:
        last = (3 - 1.8 * min(1, aspect)) * root * (1 - carried / most) + carried
    if panel:
        last = min(last, math.sqrt((hold[0] + pressure[0]) * (hold[1] + pressure[1])))
    corners = [(first / shear, first), (3 * first / shear, 1.35 * first), (LAST_STRAIN, last)]
    if not corners[1][0] < LAST_STRAIN:
        raise UserError(f"its second corner, at a strain of {corners[1][0]:.3g}, is beyond the last one at {LAST_STRAIN}; "
                        "are strength and pressure in Pa?")
    if last * corners[1][0] > corners[1][1] * LAST_STRAIN:
        raise UserError("its last corner lies above the line through the second one; are ratios and stresses in SI units?")
    return corners


def cracked_bending(part: float, thickness: float, cover: float) -> float:
    """Inertia of the cracked section over that of the concrete. `part`: steel ratio times the ratio of moduli, half of it
    `cover` [m] below each face."""
    away = thickness * (math.sqrt(part * part + part) - part)  # of the neutral axis from the pressed face
    steel = part * thickness / 2 * ((away - cover)**2 + (thickness - cover - away)**2)
    return (away**3 / 3 + steel) / (thickness**3 / 12)


def pair(values: list, option: str) -> list:
    """Values of both directions."""
    if len(values) > 2:
        raise UserError(f"{option} has one number or two, the vertical one first")
    return values if len(values) == 2 else 2 * values


def report(options: argparse.Namespace) -> list:
    steel, yields = pair(options.steel, "--steel"), pair(options.yields, "--yield")
    if max(steel) > 0.1:
        raise UserError(f"--steel {max(steel)}: is that a ratio, and not in %?")
    pressure = pair(options.pressure, "--pressure") if len(options.pressure) == 2 else [options.pressure[0], 0.0]
    young = options.young or 21e9 * math.sqrt(options.strength / 20e6)
    shear = young / (2 * (1 + options.poisson))
    root = root_of(options.strength)
    hold = [ratio * stress for ratio, stress in zip(steel, yields)]
    corners = skeleton(shear, root, pressure, hold, options.aspect, options.panel, options.cracking)
    thickness = options.thickness
    cover = options.cover or min(0.04, thickness / 4)
    if cover >= thickness / 2:
        raise UserError(f"--cover {cover}: the steel is within half of the thickness")
    part = sum(steel) / 2 * STEEL / young
    force, moment = root * thickness, root * thickness**2 / 6
    bending = cracked_bending(part, thickness, cover)
    if not max(part, bending) < 1:
        raise UserError("its steel is as stiff as its concrete; are --strength and --young in Pa?")
    flat = ",".join(f"{value:.6g}" for corner in corners for value in corner)
    lines = [f"Young's modulus {young / 1e9:.4g} GPa, shear modulus {shear / 1e9:.4g} GPa",
             "shear stress over shear strain:"]
    lines += [f"  {name:10s} {stress / 1e6:8.4g} MPa at {strain:.4g}, {stress * thickness / 1e3:.4g} kN per m of wall"
              for name, (strain, stress) in zip(("cracking", "second", "last"), corners)]
    if corners[2][1] < corners[1][1]:
        lines.append("  it falls beyond the second corner: too little steel to carry what the concrete did; answers depend "
                     "on the mesh")
    lines += [f"cracks in tension at {force / 1e3:.4g} kN/m, then {part:.3g} as stiff; in bending at {moment / 1e3:.4g} "
              f"kN m/m, then {bending:.3g}", "",
              "# yields in shear in its plane",
              f'{options.group}: {{element: shell, material: concrete, thickness: {thickness:g}, shear_skeleton: "{flat}"}}',
              "# or cracks, in its plane and out of it",
              f"{options.group}: {{element: shell, material: concrete, thickness: {thickness:g}, cracking_force: {force:.6g},",
              f"  cracking_moment: {moment:.6g}, cracked_tension: {part:.4g}, cracked_bending: {bending:.4g}}}",
              "# either with",
              f"material: {{concrete: {{young: {young:.6g}, poisson: {options.poisson:g}, density: 2400}}}}"]
    return lines


def stresses(text: str) -> list:
    """Stresses between commas, 0 among them."""
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no list of numbers between commas") from error
    if len(values) > 2 or not all(0 <= value < math.inf for value in values):
        raise argparse.ArgumentTypeError(f"'{text}': one or two numbers, 0 or above")
    return values


def ratio(text: str) -> float:
    """Poisson's ratio."""
    value = float(text)
    if not 0 <= value < 0.5:
        raise argparse.ArgumentTypeError(f"{text} is not within [0, 0.5)")
    return value


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("--strength", metavar="PA", type=positive(float), required=True, help="of the concrete, compressive")
    parser.add_argument("--steel", metavar="R[,R]", type=numbers_above_0, required=True,
                        help="ratio of the steel to the section, vertical and horizontal, both faces together")
    parser.add_argument("--yield", metavar="PA[,PA]", type=numbers_above_0, required=True, dest="yields",
                        help="yield stress of the steel, likewise")
    parser.add_argument("--thickness", metavar="M", type=positive(float), required=True, help="of the wall")
    parser.add_argument("--pressure", metavar="PA[,PA]", type=stresses, default=[0.0],
                        help="vertical (and horizontal) compression that lasts (default: 0)")
    parser.add_argument("--aspect", metavar="A", type=positive(float), default=1.0,
                        help="M / (Q D): moment over shear force times depth of the wall; above 1 as 1 (default: 1)")
    parser.add_argument("--panel", action="store_true", help="no columns or cross walls along its edges")
    parser.add_argument("--cracking", metavar="PA", type=positive(float),
                        help="shear stress at which it cracks, as measured or by another code (default: by the formula)")
    parser.add_argument("--young", metavar="PA", type=positive(float),
                        help="Young's modulus of the concrete (default: 21 GPa sqrt(strength / 20 MPa))")
    parser.add_argument("--poisson", metavar="NU", type=ratio, default=0.2, help="its Poisson's ratio (default: 0.2)")
    parser.add_argument("--cover", metavar="M", type=positive(float),
                        help="from a face to its steel (default: 40 mm, at most a quarter of the thickness)")
    parser.add_argument("--group", metavar="NAME", default="wall", help="of the mesh, in the options printed")
    options = parser.parse_args()
    print("\n".join(report(options)))
    return 0
