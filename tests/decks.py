"""Scenes, or parts of them, that several tests run: words after the program's name."""

# The two-storey pair on a very coarse mesh, reduced, that pounds.
SMALL = "cells_x=3,cells_y=3,column_elements=1"
SMALL_MODAL_PAIR = ["-options_file", "petsc-options/azalee/gap2.yaml", "-s1_mesh_set", SMALL, "-s2_mesh_set", SMALL,
                    "-motion_x_pga", 20, "-motion_x_envelope", "0.02,20", "-floor2_gap", "4e-4,2e-4",
                    "-floor1_gap", 0.02, "-modes", 3, "-time_step", 5e-5, "-spectra_frequencies", "1:200:5lin",
                    "-s1_model", "modal", "-s1_modal_vectors", 20, "-s2_model", "modal", "-s2_modal_vectors", 20]

# Viaducts on piers of steel.
STEEL = ["-material_steel_young", "2.1e11", "-material_steel_poisson", 0.3, "-material_steel_density", 7850]
SECTION = ["-section_leg_area", 0.04, "-section_leg_inertia_y", "4e-4", "-section_leg_inertia_z", "2e-4",
           "-section_leg_torsion", "3e-4", "-section_leg_z_axis", "0,1,0"]
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
    words = ["-structures", "left,right", "-contacts", "gap", "-gap_secondary", "left:x_max", "-gap_primary", "right:x_min",
             "-probes", "face1,face2", "-face1_structure", "left", "-face1_group", "x_max",
             "-face2_structure", "right", "-face2_group", "x_min"]
    for i, (name, start, wall) in enumerate((("left", -1, "x_min"), ("right", 0, "x_max"))):
        words += [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_mesh_set", f"x0={start}",
                  f"-{name}_clamp", wall, f"-{name}_body_element", "hex8",
                  f"-{name}_body_material", name, f"-{name}_damping_alpha", alpha[i],
                  f"-material_{name}_young", stiffness[i], f"-material_{name}_poisson", 0,
                  f"-material_{name}_density", 2 * mass[i]]
    return words
