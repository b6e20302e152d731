"""Scenes that go to extremes: words for the program's command line. SI units."""

import math
from pathlib import Path

import numpy as np

import program
from decks import box_of, contacts, material, probes, section

CONCRETE = (30e9, 0.2, 2400.0)
PULSE = 2.6  # frequency of the ground motion of the pair, between those of its two structures [Hz]


def cheap(*places: str) -> list:
    """Without modes, one frequency per spectrum; a probe is structure:group."""
    named = probes(**{f"probe{i}": place for i, place in enumerate(places)}) if places else []
    return ["-modes", 0, "-spectra_frequencies", 10, *named]


def blocks(densities, speed: float = 1.0, gap: float = 0.001, young: float = 1e-12,
           time_step: float = 1e-4, end_time: float = 0.005) -> list:
    """Two cubes of 1 m, of which the first moves towards the second. So soft that the eight nodes of
    each are free masses of an eighth of the cube: node against node is a plastic impact of the two
    faces, each with half of the mass of its cube."""
    words = ["-structures", "one,two", *contacts(joint=("one:x_max", "two:x_min", repr(gap))),
             "-one_initial_velocity", f"{speed!r},0,0", "-time_step", repr(time_step),
             "-end_time", repr(end_time), "-output_interval", repr(time_step / 2),
             "-energy_interval", 1]
    for name, start, density in zip(("one", "two"), (-1, 0), densities):
        words += [*box_of(name, f"x0={start}", name, "hex8_full"), *material(name, young, 0, density)]
    return words + cheap("one:x_max", "two:x_min")


def oscillator(name: str, stiffness: float, mass: float, speed: float, beta: float = 0.0) -> list:
    """A structure that is one mass at (1, 0, 0) on a grounded spring, thrown along x."""
    return [f"-{name}_mesh", "tests/meshes/chain.geo", f"-{name}_initial_velocity", f"{speed!r},0,0",
            f"-{name}_damping_beta", repr(beta), f"-{name}_first_element", "point_mass",
            f"-{name}_first_mass", repr(mass), f"-{name}_support_element", "grounded_spring",
            f"-{name}_support_stiffness", ",".join([repr(stiffness)] * 3)]


def two_masses(name: str, soft: float, stiff: float, speed: float) -> list:
    """Masses of 1 kg: the first on a grounded spring, the second, at (2, 0, 0), tied to it."""
    return [*oscillator(name, soft, 1.0, speed), f"-{name}_mesh_set", "links=2",
            f"-{name}_second_element", "point_mass",
            f"-{name}_second_mass", 1, f"-{name}_link2_element", "spring",
            f"-{name}_link2_stiffness", ",".join([repr(stiff)] * 3)]


def two_masses_history(ratio: float, speed: float, time_step: float, steps) -> np.ndarray:
    """Displacement of the first mass after these numbers of steps, springs of 1 and `ratio` N/m: the
    two modes of the scheme, v dt sin(n theta) / sin(theta) with sin(theta / 2) = omega dt / 2."""
    large = (1 + 2 * ratio + math.sqrt(1 + 4 * ratio**2)) / 2
    squares = np.array([ratio / large, large])  # omega^2; their product is the determinant
    modes = np.linalg.eigh([[1 + ratio, -ratio], [-ratio, ratio]])[1]
    theta = 2 * np.arcsin(np.sqrt(squares) * time_step / 2)
    waves = speed * time_step * np.sin(np.outer(steps, theta)) / np.sin(theta)
    return waves @ (modes[0] * modes.sum(axis=0))


def column(thickness: float, speed: float = 1.0, end_time: float = 8e-4) -> list:
    """Ten concrete cubes of 0.1 m and in their middle a layer of another thickness, thrown against
    a rigid wall."""
    return ["-structures", "column", "-column_mesh", "tests/meshes/sliver.geo",
            "-column_mesh_set", f"thickness={thickness!r}", "-column_body_element", "hex8_full",
            "-column_body_material", "concrete", *material("concrete", CONCRETE[0], 0.0, CONCRETE[2]),
            *contacts(stop=("column:z_min", "wall", 1e-5)), "-column_initial_velocity", f"0,0,{-speed!r}",
            "-end_time", repr(end_time), *cheap("column:z_max")]


ELEMENTS = {  # structure: its element, mesh and parameters, group, a further word of the group
    "brick": ("hex8", "box", "", "body", ()),
    "full": ("hex8_full", "box", "", "body", ()),
    "rod": ("bar", "line", "", "line", ("area", 1e-3)),
    "tube": ("euler_beam", "line", "", "line", ("section", "tube")),
    "plate": ("shell", "quadrilateral", "nx=1,ny=1,length=1,width_0=1,width_1=1", "plate",
              ("thickness", 2.0)),
}
RADIUS = 0.05  # of gyration of the tube [m]


def lone_elements(names, end_time: float = 2e-3) -> list:
    """Structures of one free element of 1 m each, thrown in all directions."""
    words = ["-structures", ",".join(names), "-end_time", repr(end_time), "-output_interval", 1e-9,
             *material("concrete", *CONCRETE), *section("tube", 1e-3, *[1e-3 * RADIUS**2] * 3)]
    for name in names:
        element, mesh, parameters, group, more = ELEMENTS[name]
        words += [f"-{name}_mesh", f"tests/meshes/{mesh}.geo", f"-{name}_{group}_element", element,
                  f"-{name}_{group}_material", "concrete", f"-{name}_initial_velocity", "1,0.5,0.25"]
        words += [f"-{name}_mesh_set", parameters] if parameters else []
        words += [f"-{name}_{group}_{more[0]}", more[1]] if more else []
    return words + cheap(*(f"{name}:{ELEMENTS[name][3]}" for name in names))


def lone_frequencies() -> dict:
    """omega_max of each of these elements in closed form [rad/s]: uniform dilatation of the cube and
    of the square membrane, stretching of the rod and of the tube (longer than 11 of its radii)."""
    young, poisson, density = CONCRETE
    bulk = young / (3 * (1 - 2 * poisson))
    wave = math.sqrt(young / density)
    return {"brick": math.sqrt(12 * bulk / density), "full": math.sqrt(12 * bulk / density),
            "rod": 2 * wave, "tube": 2 * wave,
            "plate": 2 * math.sqrt(young / ((1 - poisson) * density))}


def shaken_pair(folder: Path, peak: float, speed: float = 0.0, gap: float = 0.02,
                end_time: float = 0.6) -> list:
    """The two-storey pair on a coarse mesh, under a sine along x that starts at once; `speed` of the
    first structure towards the second at t = 0 [m/s], so that it hits early. `peak` [m/s2]."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"sine-{peak:g}.txt"
    time = np.arange(0, 1, 0.005)
    np.savetxt(path, peak * np.sin(2 * math.pi * PULSE * time), fmt="%.17g")
    return [*program.COARSE_PAIR, "-motion_x_record", str(path), "-motion_x_unit", "m/s2",
            "-motion_x_time_step", 0.005, "-motion_x_pga", 0, "-s1_initial_velocity", f"{speed!r},0,0",
            "-floor1_gap", repr(gap), "-floor2_gap", repr(gap), "-end_time", repr(end_time),
            "-output_interval", 1e-3, "-modes", 0, "-spectra_frequencies", 10]
