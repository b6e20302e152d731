"""Modes and largest frequencies of structures that stand alone, by a run that makes one step.

Several structures in one run cost little more than one. In the words of a case, @ stands for the
name of its structure.
"""
import decks
import program

CONCRETE = {"young": 30e9, "poisson": 0.2, "density": 2400}


def material(young, poisson, density):
    return decks.material("@", young, poisson, density)


def group(name, element, **properties):
    """Element of a group of the mesh, with the material of the structure if it takes one."""
    words = [f"-@_{name}_element", element]
    if element != "grounded_spring":
        words += [f"-@_{name}_material", "@"]
    for key, value in properties.items():
        words += [f"-@_{name}_{key}", value]
    return words


def case(mesh, words, **parameters):
    """A structure: its mesh in tests/meshes, its words, parameters of the .geo file."""
    words = ["-@_mesh", f"tests/meshes/{mesh}.geo"] + list(words)
    if parameters:
        words += ["-@_mesh_set", ",".join(f"{name}={value!r}" for name, value in parameters.items())]
    return words


def structures(test, cases, modes=1, ranks=program.RANKS, mechanisms=None):
    """What summary.json says of each structure, in the order of the cases. `mechanisms`: whether each of them, or
    none, has to be called one."""
    names = [f"b{number}" for number in range(len(cases))]
    arguments = ["-structures", ",".join(names), "-end_time", 1e-12, "-modes", modes]
    for name, words in zip(names, cases):
        arguments += [str(word).replace("@", name) for word in words]
    summary = program.must_run(test, arguments, ranks)[1]
    said = [line for line in summary["warnings"] if "no stiffness" in line]
    if mechanisms is not None:
        test.assertEqual(len(said), len(names) if mechanisms else 0, said)
    return [summary["structures"][name] for name in names]


def frequencies(result):
    return [mode["frequency"] for mode in result["frequencies"]]


def moving(result, components):
    """Frequencies of the modes that take part in these components only (0-5: x, y, z, about them)."""
    kept = []
    for mode in result["frequencies"]:
        masses = mode["effective_modal_mass"]
        inside = sum(masses[c] for c in components)
        if inside > 1e3 * (sum(masses) - inside):
            kept.append(mode["frequency"])
    return kept


def assert_close(test, found, expected, tolerance, name):
    """Relative, value by value; found may hold more than expected."""
    test.assertGreaterEqual(len(found), len(expected), name)
    for number, (value, reference) in enumerate(zip(found, expected), start=1):
        test.assertLessEqual(abs(value / reference - 1), tolerance,
                             f"{name}, value {number}: {value:.6f}, expected {reference:.6f}")
