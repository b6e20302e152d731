"""Scenes, or parts of them, that several tests run: words after the program's name."""


def material(name, young, poisson, density):
    """A material [Pa, -, kg/m3]."""
    return [f"-material_{name}_young", young, f"-material_{name}_poisson", poisson, f"-material_{name}_density", density]


def section(name, area, inertia_y, inertia_z, torsion, z_axis="0,0,1"):
    """A cross-section [m2, m4] whose local z is along an axis."""
    return [f"-section_{name}_area", area, f"-section_{name}_inertia_y", inertia_y, f"-section_{name}_inertia_z",
            inertia_z, f"-section_{name}_torsion", torsion, f"-section_{name}_z_axis", z_axis]


def box_of(name, sizes, of, element="hex8"):
    """A structure that is one block, of the material `of`."""
    return [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_mesh_set", sizes, f"-{name}_body_element", element,
            f"-{name}_body_material", of]


def in_modes(name, vectors):
    """A structure reduced to so many modes beside its attachment vectors."""
    return [f"-{name}_model", "modal", f"-{name}_modal_vectors", vectors]


def clock(step, end, every=None):
    """The time step, the end and the time between two records [s]: a step unless it is said."""
    return ["-time_step", step, "-end_time", end, "-output_interval", step if every is None else every]


def contacts(**sides):
    """Contacts by their names: secondary side, primary side and, unless it is that of the meshes, gap [m]."""
    words = ["-contacts", ",".join(sides)]
    for name, side in sides.items():
        words += [word for key, value in zip(("secondary", "primary", "gap"), side) for word in (f"-{name}_{key}", value)]
    return words


def probes(**places):
    """Averaged probes by their names: structure:group, or structure@x,y,z."""
    words = ["-probes", ",".join(places)]
    for name, place in places.items():
        structure, key, where = place.replace(":", " group ").replace("@", " at ").split(" ", 2)
        words += [f"-{name}_structure", structure, f"-{name}_{key}", where]
    return words


# The two-storey pair on a very coarse mesh, reduced, that pounds.
SMALL = "cells_x=3,cells_y=3,column_elements=1"
SMALL_MODAL_PAIR = ["-options_file", "petsc-options/azalee/gap2.yaml", "-s1_mesh_set", SMALL, "-s2_mesh_set", SMALL,
                    "-motion_x_pga", 20, "-motion_x_envelope", "0.02,20", "-floor2_gap", "4e-4,2e-4",
                    "-floor1_gap", 0.02, "-modes", 3, "-time_step", 5e-5, "-spectra_frequencies", "1:200:5lin",
                    *in_modes("s1", 20), *in_modes("s2", 20)]

# Viaducts on piers of steel.
STEEL = material("steel", "2.1e11", 0.3, 7850)
SECTION = section("leg", 0.04, "4e-4", "2e-4", "3e-4", "0,1,0")
SPAN, BEARING = 6.0, "3e7,4e7,2e8,1e6,1e6,1e6"


def viaduct(name, spans, x0, *more):
    """A deck on piers; the feet are clamped."""
    words = [f"-{name}_mesh", "tests/meshes/viaduct.geo", f"-{name}_mesh_set", f"spans={spans},x0={x0!r}",
             f"-{name}_clamp", "feet", f"-{name}_deck_element", "shell", f"-{name}_deck_material", "steel",
             f"-{name}_deck_thickness", 0.3, f"-{name}_piers_element", "euler_beam", f"-{name}_piers_material", "steel",
             f"-{name}_piers_section", "leg", f"-{name}_bearings_element", "spring",
             f"-{name}_bearings_stiffness", BEARING]
    words += [f"-{name}_ignore", "braces"] if not any("braces" in str(word) for word in more) else []
    return words + list(more)


def braces(name):
    return [f"-{name}_braces_element", "bar", f"-{name}_braces_material", "steel", f"-{name}_braces_area", 1e-4,
            f"-{name}_braces_tension_only", "true"]


def oscillators(mass, stiffness, alpha):
    """Two bricks that are clamped at their far faces and face each other over a gap: each an oscillator, with its mass
    [kg], stiffness [N/m] and damping alpha [1/s]; probes of the faces."""
    words = ["-structures", "left,right", *contacts(gap=("left:x_max", "right:x_min")),
             *probes(face1="left:x_max", face2="right:x_min")]
    for i, (name, start, wall) in enumerate((("left", -1, "x_min"), ("right", 0, "x_max"))):
        words += [*box_of(name, f"x0={start}", name), f"-{name}_clamp", wall, f"-{name}_damping_alpha", alpha[i],
                  *material(name, stiffness[i], 0, 2 * mass[i])]
    return words
