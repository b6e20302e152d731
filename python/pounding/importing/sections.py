"""Cross-sections of beams by their dimensions. Axis 1 and 2 of the figures are z and y of the program: a height is
along axis z, a width along y. Shear areas are given as factors of the area by formats that have factors of their own;
where they have none those of the program's own sections are taken (docs/reference/scene/materials.md)."""

import math
import re
from dataclasses import replace

from .model import Section

# Names by which the program knows standard sections, and takes their numbers where a scene gives none.
STANDARD = re.compile(r"(ipe|he[abm]?|upn|w|shs|rhs|chs|hss|rect|round)\d[\dx]*[abm]?", re.IGNORECASE)


def own_name(name: str) -> str:
    """A name for a section of a file that no standard one has: without shear areas it is one without."""
    return f"{name}_of_file" if STANDARD.fullmatch(name) else name


def rectangle(width: float, height: float) -> Section:
    """The height along z. Torsion by the series of Saint-Venant."""
    area, (low, high) = width * height, sorted((width, height))
    if not low > 0:
        return Section(area, 0.0, 0.0, 0.0)
    series = sum(math.tanh(n * math.pi * high / (2 * low)) / n**5 for n in range(1, 2000, 2))
    torsion = high * low**3 * (1 / 3 - 64 / math.pi**5 * low / high * series)
    return Section(area, width * height**3 / 12, height * width**3 / 12, torsion, 5 / 6 * area, 5 / 6 * area)


def ring(outer: float, inner: float = 0.0) -> Section:
    """By its radii; shear areas of 9/10 of a full one, after Cowper with nu = 0 of others: half of a thin one."""
    area, inertia = math.pi * (outer**2 - inner**2), math.pi / 4 * (outer**4 - inner**4)
    if inner == 0:
        shear = 0.9 * area
    else:
        m = (inner / outer)**2
        shear = 6 * (1 + m)**2 / (7 * (1 + m)**2 + 20 * m) * area
    return Section(area, inertia, inertia, 2 * inertia, shear, shear)


def box(width: float, height: float, side: float, cover: float) -> Section:
    """The height along z; walls `side` along z and `cover` along y. Torsion of thin walls, shear areas of the walls
    along the force."""
    inner_width, inner_height = width - 2 * side, height - 2 * cover
    area = width * height - inner_width * inner_height
    middle_width, middle_height = width - side, height - cover
    torsion = 2 * (middle_width * middle_height)**2 / (middle_width / cover + middle_height / side)
    return Section(area, (width * height**3 - inner_width * inner_height**3) / 12,
                   (height * width**3 - inner_height * inner_width**3) / 12, torsion,
                   2 * cover * middle_width, 2 * side * middle_height)


def i_shape(height: float, bottom: float, top: float, bottom_flange: float, top_flange: float, web: float) -> tuple:
    """Section of an I along z by its widths and thicknesses, and the height of its centroid above the bottom. Torsion
    is a third of b t^3; shear areas are the web along z and 5/6 of the flanges along y."""
    parts = ((bottom, bottom_flange, bottom_flange / 2), (web, height - bottom_flange - top_flange,
             (height + bottom_flange - top_flange) / 2), (top, top_flange, height - top_flange / 2))
    area = sum(b * h for b, h, _ in parts)
    centroid = sum(b * h * z for b, h, z in parts) / area
    inertia_y = sum(b * h**3 / 12 + b * h * (z - centroid)**2 for b, h, z in parts)
    inertia_z = sum(h * b**3 / 12 for b, h, _ in parts)
    torsion = (bottom * bottom_flange**3 + top * top_flange**3 + parts[1][1] * web**3) / 3
    flanges = bottom * bottom_flange + top * top_flange
    middle = height - (bottom_flange + top_flange) / 2
    return Section(area, inertia_y, inertia_z, torsion, 5 / 6 * flanges, web * middle), centroid


def with_shear(section: Section, factor_y: float, factor_z: float) -> Section:
    """The same with shear areas that are these parts of its area."""
    return replace(section, shear_y=factor_y * section.area, shear_z=factor_z * section.area)


def swapped(section: Section) -> Section:
    """With y and z exchanged."""
    return replace(section, inertia_y=section.inertia_z, inertia_z=section.inertia_y, shear_y=section.shear_z,
                   shear_z=section.shear_y)


def principal(section: Section) -> tuple:
    """The section in its principal axes, and the angle from z to the new z, positive from z towards -y (about x from
    y to z), in radians."""
    if section.product == 0:
        return section, 0.0
    # Inertia tensor [[Iy, -P], [-P, Iz]]; turning axes by a about x: y' = y cos a + z sin a, z' = z cos a - y sin a.
    angle = 0.5 * math.atan2(2 * section.product, section.inertia_z - section.inertia_y)
    c, s = math.cos(angle), math.sin(angle)
    turned_y = section.inertia_y * c * c + section.inertia_z * s * s - 2 * section.product * s * c
    turned_z = section.inertia_z * c * c + section.inertia_y * s * s + 2 * section.product * s * c
    return replace(section, inertia_y=turned_y, inertia_z=turned_z, product=0.0), angle
