"""One structure, its modes and its largest frequency, by a run of the program that makes one step."""
import program

# Elements that more than one test uses: words for the structure b.
CONCRETE = {"young": 30e9, "poisson": 0.2, "density": 2400}


def material(young, poisson, density):
    return ["-material_m_young", young, "-material_m_poisson", poisson, "-material_m_density", density]


def group(name, element, **properties):
    """Element of a group; all that have a material share one."""
    words = [f"-b_{name}_element", element]
    if element not in ("grounded_spring", "spring", "point_mass"):
        words += [f"-b_{name}_material", "m"]
    for key, value in properties.items():
        words += [f"-b_{name}_{key}", value]
    return words


def section(name, area, inertia_y, inertia_z, torsion):
    return [f"-section_{name}_area", area, f"-section_{name}_inertia_y", inertia_y,
            f"-section_{name}_inertia_z", inertia_z, f"-section_{name}_torsion", torsion,
            f"-section_{name}_z_axis", "0,0,1"]


def structure(test, mesh, words, modes=1, ranks=2, **parameters):
    """What summary.json says of the structure; parameters are those of the .geo file."""
    arguments = ["-structures", "b", "-b_mesh", f"tests/meshes/{mesh}.geo", "-end_time", 1e-12,
                 "-modes", modes] + list(words)
    if parameters:
        arguments += ["-b_mesh_set", ",".join(f"{name}={value!r}" for name, value in parameters.items())]
    return program.must_run(test, arguments, ranks)[1]["structures"]["b"]


def frequencies(result):
    return [mode["frequency"] for mode in result["frequencies"]]


def assert_close(test, found, expected, tolerance, case):
    """Relative, value by value; found may hold more than expected."""
    test.assertGreaterEqual(len(found), len(expected), case)
    for number, (value, reference) in enumerate(zip(found, expected), start=1):
        test.assertLessEqual(abs(value / reference - 1), tolerance,
                             f"{case}, value {number}: {value:.6f}, expected {reference:.6f}")
