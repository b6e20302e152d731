"""Features of the program, one declaration each: its name, its kind, and what it lays on the small scene (scene.py).

`@` in an option is the structure that it is laid on. Two features that state one option of a structure are alternatives
there, and so are two with one `slot`, or one that names a group whose element the other takes out: the second goes to the
other structure. Where that does not help either, as two joints between the same faces, the pair is impossible. `physics` is
False where a feature changes no motion; `spared` are properties that it has not, with the reason, `beside` any other or a kind.
"""
import functools
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy

from scene import BASE, FACES, HOUSES, INTERVAL, axes, curve, kept, pairs, points, quantity, vector, waves
from soil_tables import coupled, two_mats, write_parts, write_soil

KINDS = ("interaction", "law", "element", "model", "start", "support", "damping", "load", "output")


@dataclass
class Feature:
    name: str
    kind: str
    options: dict
    slot: str = ""
    physics: bool = True
    spared: dict = field(default_factory=dict)
    beside: str = ""


STOP = {"contacts": "joint", "joint_secondary": "a:nib", "joint_primary": "b:nib", "joint_along": vector((1, 0, 0))}
REST = {"gravity": 2.0, "preload": "static"}


def spring(group, stiffness, **more):
    return {f"@_{group}_stiffness": axes(stiffness), **{f"@_{group}_{key}": value for key, value in more.items()}}


def feet(stiffness=(4e6, 5e6, 2e7), **more):
    return {"@_clamp": "none", "@_feet_element": "grounded_spring", **spring("feet", stiffness, **more)}


def pads(stiffness=(4e6, 4e6, 2e7), **more):
    return {"@_clamp": "ground", "@_pad_element": "spring", **spring("pad", stiffness, **more)}


def brace(group="brace", **more):
    return {f"@_{group}_element": "bar", f"@_{group}_material": "steel", f"@_{group}_area": 1e-3,
            **{f"@_{group}_{key}": value for key, value in more.items()}}


def wall(**more):
    return {"@_wall_element": "shell", "@_wall_material": "concrete", "@_wall_thickness": .1,
            **{f"@_wall_{key}": value for key, value in more.items()}}


def slab(group, element, **more):
    return {"@_slab_element": None, "@_slab_material": None, f"@_{group}_element": element, f"@_{group}_material": "concrete", **more}


def load(name, **more):
    return {"loads": f"+{name}", **{f"{name}_{key}": value for key, value in more.items()}}


def force(kind, **more):
    return {"forces": f"+{kind}", f"{kind}_structure": "@", f"{kind}_kind": kind, **{f"{kind}_{k}": v for k, v in more.items()}}


@functools.cache
def soil_file():
    return write_soil(lambda omega: coupled(omega) / 100)


def soil(*_):
    """A file of soil in SI and in the axes of the model."""
    return soil_file()


@functools.cache
def shared_soil_file():
    whole = two_mats()
    for matrix in (whole.stiffness, whole.dashpots, whole.masses):
        matrix /= 100
    for part in whole.hidden:
        part.dashpot, part.spring, part.mass = part.dashpot / 100, part.spring / 100, part.mass / 100
    return write_parts(whole)


def shared_soil(*_):
    """A file of soil of both houses."""
    return shared_soil_file()


def state(structure, length, turn):
    """The file of a state of two nodes: their places, displacements and velocities."""
    left, width, _ = HOUSES[structure]
    rows = [turn @ numpy.array(row) * length for node, moved, velocity in (
        ((left, 0, 2.5), (1e-4, 2e-4, 0), (.1, -.2, .1)), ((left + width, 2, 2.5), (0, 1e-4, 1e-4), (.2, .1, 0)))
            for row in (node, moved, velocity)]
    lines = ["x,y,z,ux,uy,uz,vx,vy,vz"] + [",".join(repr(float(x)) for row in rows[i:i + 3] for x in row) for i in (0, 3)]
    return kept(lambda path: Path(path).write_text("\n".join(lines)), ".csv")


def parting(_, length, turn):
    """The file of a wave that parts in two shapes along every axis, at the nodes of the bottoms of both houses."""
    nodes = numpy.array([(left + u * width, 2.0 * v, -1.0) for left, width, _ in HOUSES.values() for u in (0, .5, 1) for v in (0, .5, 1)])
    record = numpy.asarray(BASE["motion"])
    time = INTERVAL * numpy.arange(len(record))

    def write(path):
        with h5py.File(path, "w") as file:
            file.attrs["time_step"] = INTERVAL
            file["nodes"] = nodes @ turn.T * length
            for axis, of in enumerate(abs(turn).argmax(1)):
                name, sign = "xyz"[axis], turn[axis, of]
                file[f"{name}/record"] = sign * record[:, of]
                file[f"{name}/shapes"] = numpy.column_stack([numpy.ones(len(nodes)), numpy.sin((1 + of) * nodes[:, 0] + nodes[:, 1])])
                file[f"{name}/histories"] = sign * numpy.array([3 * numpy.sin(40 * (2 + of) * time), 8 * numpy.sin(55 * (3 + of) * time)])
    return kept(write, ".h5")


EAST = waves((25, 40), (20, 45), (12, 50))

FEATURES = [
    Feature("contact", "interaction", FACES),
    Feature("friction", "interaction", {**FACES, "joint_friction": .4}),
    Feature("sliding", "interaction", {**FACES, "joint_sliding": .2}),
    Feature("filler", "interaction", {**FACES, "joint_gap": .002, "joint_filler": curve((.1, 2e4, .6, 2e5)),
                                               "joint_filler_unloading": 1e6, "joint_filler_area": .5}),
    Feature("crushing", "interaction", {**FACES, "joint_crushing": 1e4, "joint_crushing_stiffness": 1e9,
                                                 "joint_crushing_depth": .01, "joint_crushing_area": .5}),
    Feature("hard stop", "interaction", {**STOP, "joint_gap": (2e-5, 1e-5)}),
    Feature("soft stop", "interaction", {**STOP, "joint_gap": (2e-5, 1e-5), "joint_stiffness": 1e6, "joint_dashpot": 1e3}),
    Feature("rigid wall", "interaction", {**FACES, "joint_primary": "wall", "joint_gap": 1e-3}),
    Feature("random gap", "interaction", {**FACES, "joint_gap": 1e-4, "joint_gap_deviation": 5e-5, "joint_gap_length": 1.0},
            spared={"turned": "its waves are those of the tangent axes, in the order x, y, z"}),
    Feature("two passes", "interaction", {**FACES, "joint_passes": 2}),
    Feature("joint at rest", "interaction", {**FACES, **REST, "joint_gap_at": "rest"}),
    Feature("stop at a wall", "interaction", {**STOP, "joint_primary": "wall", "joint_gap": 1e-3}),

    Feature("tension-only bar", "law", brace(tension_only="true")),
    Feature("compression-only bar", "law", brace("strut", compression_only="true", slack=2e-4)),
    Feature("yielding bar", "law", brace(yield_force=500.0, hardening=.1)),
    Feature("bar with a rule", "law", brace(rule="peak", skeleton=quantity(pairs((5e-5, 500.0, 1e-3, 900.0)), "-,N"))),
    Feature("bar dashpot", "law", {"@_strut_element": "bar", "@_strut_dashpot": 2e4}),
    Feature("power dashpot in series", "law", brace("strut", dashpot=2e4, dashpot_stiffness=1e7)),
    Feature("beams yielding in bending", "law", {
        "@_column_bending_skeleton_y": pairs((1e-5, 13.0, 1e-3, 200.0)), "@_column_bending_skeleton_z": pairs((1e-5, 18.0, 1e-3, 300.0))}),
    Feature("beams yielding in shear", "law", {
        "@_column_shear_skeleton_y": pairs((1e-6, 126.92307692307693, 1e-4, 3e3)), "@_column_shear_skeleton_z": pairs((1e-6, 115.38461538461539, 1e-4, 3e3))}),
    Feature("shells yielding in shear", "law", wall(shear_skeleton=pairs((1e-5, 1.25e3, 1e-3, 1e4)), drilling_factor=.01)),
    Feature("cracking shells", "law", wall(cracking_force=200.0, cracked_tension=.05)),
    Feature("dashpots to the ground", "law", feet(dashpot=axes((2e4, 2e4, 4e4)))),
    Feature("feet that lift off", "law", feet(compression_only="true")),
    Feature("yielding feet", "law", feet(yield_force=axes((200.0, 200.0, 0)), hardening=.1)),
    Feature("Zener feet", "law", feet(dashpot=axes((2e4, 2e4, 4e4)), series_stiffness=axes((2e7, 2e7, 8e7)))),
    Feature("power dashpots", "law", feet(dashpot=quantity(axes((2e3, 2e3, 4e3)), "N s1.5/m1.5"), dashpot_exponent=1.5)),
    Feature("lead-rubber bearings", "law", pads(yield_force=axes((200.0, 200.0, 0)), hardening=.1, yield_circle="x+y")),
    Feature("friction pendulum", "law", {**REST, **pads(sliding_friction=.3, hardening=.1, yield_circle="x+y", pendulum_radius=1.0)}),
    Feature("sliding bearings", "law", {**REST, **pads(sliding_friction=.3, yield_circle="x+y")}),
    Feature("raft on a subgrade", "law", {**REST,
        "@_clamp": "none", "@_raft_element": "shell", "@_raft_material": "concrete", "@_raft_thickness": .3, "@_subgrade_element": "grounded_spring",
        "@_subgrade_stiffness_per_area": axes((2e6, 2e6, 4e6)), "@_subgrade_dashpot_per_area": axes((1e4, 1e4, 2e4)),
        "@_subgrade_compression_only": "true"}),

    Feature("incompatible modes off", "element", {"@_slab_element": "hex8_full"}),
    Feature("wedges", "element", slab("prisms", "wedge6")),
    Feature("tetrahedra", "element", slab("tets", "tet4")),
    Feature("shells", "element", slab("deck", "shell", **{"@_deck_thickness": .25})),
    Feature("wall of shells", "element", wall()),
    Feature("beams without shear", "element", {"@_column_element": "euler_beam"}),
    Feature("columns of bars", "element", {"@_column_element": "bar", "@_column_area": .04, "@_column_section": None, **brace()}),
    Feature("pier of bricks", "element", {"@_column_element": None, "@_column_material": None, "@_column_section": None,
                                                    "@_pier_element": "hex8", "@_pier_material": "concrete"}),
    Feature("bars", "element", brace()),
    Feature("rotary inertia", "element", {"@_pump_rotary_inertia": axes((50.0, 40.0, 30.0))}),
    Feature("springs to the ground", "element", feet()),
    Feature("springs between nodes", "element", pads()),
    Feature("rigid slab", "element", {"@_rigid": "upside"}),
    Feature("diaphragm", "element", {"@_diaphragm": "upside"}),
    Feature("tie", "element", {"@_curb_element": "shell", "@_curb_material": "concrete", "@_curb_thickness": .1,
                                       "@_tie": "curb_foot:upside"}),
    Feature("eccentric join", "element", {"@_mast_element": "beam", "@_mast_material": "steel", "@_mast_section": "post", "@_join": "mast_foot:upside"}),
    Feature("levels", "element", {"@_levels": "upside"}),
    Feature("pool", "element", {"@_basin_element": "shell", "@_basin_material": "concrete", "@_basin_thickness": .1, "pools": "+tank",
                                "tank_structure": "@", "tank_faces": "basin,upside", "tank_level": 3.5, "tank_density": 1000.0,
                                "tank_gravity": 9.80665, "tank_damping": .02}, beside="damping",
            spared={"all modes": "in modes the structure's damping is taken off the waves by strain energy"}),
    Feature("water by cells", "element", {"@_basin_element": "shell", "@_basin_material": "concrete", "@_basin_thickness": .1, "pools": "+sea",
                                          "sea_structure": "@", "sea_water": "sea_cells", "sea_density": 1000.0}),

    Feature("few modes", "model", {"@_model": "modal", "@_modal_vectors": 8}),
    Feature("chosen modes", "model", {"@_model": "modal", "@_modal_vectors": 8, "@_modal_candidates": 20}),
    Feature("patches of contact", "model", {"@_model": "modal", "@_modal_vectors": 8, "@_modal_patches": 2}),
    Feature("modes between strikes", "model", {"@_model": "switched", "@_modal_vectors": 8, "@_switched_part": 1e-4}),
    Feature("matrices", "model", {"@_matrices": "$@"}),
    Feature("ensemble", "model", {"ensemble": "$members.csv", "a_model": "modal", "a_modal_vectors": 12, "b_model": "modal", "b_modal_vectors": 12}),
    Feature("mass scaling", "model", {"@_mass_scaling": 1e-3},
            spared={"all modes": "in modes it slows generalised coordinates, at full order elements"}),
    Feature("time step target", "model", {"@_time_step_target": 4e-4, "@_target_change": .1, "@_target_frequency": 5.0}),
    Feature("meshes in pieces", "model", {"mesh_pieces": "$pieces"}, physics=False),
    Feature("assembled matrix", "model", {"stiffness": "assembled"}, physics=False),
    Feature("numbers in 32 bits", "model", slab("skewed", "hex8", **{"@_numbers": "single"}),
            spared={"other units": "its numbers are rounded, in other units to others"}),
    Feature("stiffness factor", "model", {"@_stiffness_factor": 1.3},
            spared={"all modes": "the basis keeps the rotary inertia of beams, which follows the stiffness at full order"}),
    Feature("cracked columns", "model", {"@_column_stiffness_factor": .5, "@_column_damping_factor": 1.75},
            spared={"all modes": "composite damping of modes leaves out the coupling between them"}),

    Feature("initial velocity", "start", {"@_initial_velocity": vector((.3, .1, -.05))}),
    Feature("initial displacement", "start", {"@_initial_displacement": vector((2e-4, 1e-4, 0))}),
    Feature("rest under gravity", "start", REST),
    Feature("gravity that sets in", "start", {"gravity": 9.81, "preload": "none"}),
    Feature("P-Delta", "start", {**REST, "@_p_delta": "true"}),
    Feature("initial state", "start", {"@_initial_state": state}),

    Feature("supports", "support", {"supports": "+near,far", "near_groups": "@:west", "far_groups": "@:east", "far_motion": EAST, "@_clamp": "west,east"}, "@ground"),
    Feature("structure on a support", "support", {"supports": "+whole", "whole_groups": "@", "whole_motion": EAST}, "@ground"),
    Feature("rocking support", "support", {"supports": "+rocking", "rocking_groups": "@", "rocking_point": points(((1.0, .5, 0),)),
                                              "rocking_rotation": waves((5, 30), (4, 35), (6, 45))}, "@ground"),
    Feature("late support", "support", {"supports": "+late", "late_groups": "@", "late_delay": 3e-3}, "@ground"),
    Feature("embedded support", "support", {"supports": "+deep", "deep_groups": "@", "deep_point": points(((1.5, 1.0, 0),)), "deep_embedment": .5,
                                            "deep_vs": 100.0, "deep_half_width": 1.5}, "@ground"),
    Feature("soil under a mat", "support", {"@_clamp": "none", "@_rigid": "+base", "@_soil_mat": "base", "@_soil_size": axes((3.0, 2.0)),
                                                    "@_soil_vs": 100.0, "@_soil_density": 1800.0, "@_soil_poisson": .35}),
    Feature("soil from a table", "support", {"@_clamp": "none", "@_rigid": "+base", "@_soil_mat": "base", "@_soil_table": soil},
            spared={"other units": "the file is in SI", "turned": "the file has the axes of the model"}),
    Feature("soil that mats share", "support", {f"{s}_{key}": value for s in "ab" for key, value in (
        ("clamp", "none"), ("rigid", "+base"), ("soil_mat", "base"), ("soil_table", shared_soil), ("soil_table_mat", 1 + "ab".index(s)))},
            spared={"other units": "the file is in SI", "turned": "the file has the axes of the model"}),
    Feature("absorbing faces", "support", {"@_clamp": "none", "@_block_element": "hex8", "@_block_material": "concrete", "@_absorbing": "bottom"}),
    Feature("wave from below", "support", {"motion_input": "below", **{f"{s}_{key}": value for s in "ab" for key, value in (
        ("clamp", "none"), ("block_element", "hex8"), ("block_material", "concrete"), ("absorbing_base", "bottom"))}}),
    Feature("incoherent wave from below", "support", {"motion_input": "below", "motion_incoherent": parting, **{
        f"{s}_{key}": value for s in "ab" for key, value in (
            ("clamp", "none"), ("block_element", "hex8"), ("block_material", "concrete"), ("absorbing_base", "bottom"))}}),

    Feature("uniform damping", "damping", {"@_damping_uniform": .05,
                                                      "@_damping_reference": 10.0}),
    Feature("stiffness damping", "damping", {"@_damping_beta": 2e-5}, beside="law",
            spared={"all modes": "in modes it brakes them as a whole, at full order not elements that yield or let go"}),
    Feature("mass damping", "damping", {"@_damping_alpha": .5}),
    Feature("damping factor", "damping", {"@_damping_alpha": .5, "@_damping_factor": 3.0}),
    Feature("modal damping", "damping", {"@_model": "modal", "@_modal_vectors": 12, "@_modal_damping": (.02, .05)}),
    Feature("damping of a region", "damping", {"@_slab_damping_beta": 1e-5, "@_slab_damping_alpha": 2.0}),

    Feature("constant force", "load", load("weight", on="@:pump", force=vector((400, 200, -300)))),
    Feature("harmonic moment", "load", load("engine", on="@:column", moment=vector((4e2, 2e2, 3e2)), function="harmonic", frequency=30.0)),
    Feature("line force", "load", load("wind", on="@:column", line_force=vector((4e2, 2e2, 3e2)), function="ramp", rise=.01)),
    Feature("pressure", "load", load("blast", on="@:upside", pressure=2e3, values="0,1; 0.01,3; 0.02,0")),

    Feature("reactions", "output", force("reactions"), physics=False),
    Feature("storey force", "output", force("storey", level=1.7), physics=False),
    Feature("member forces", "output", force("members", group="column"), physics=False),
    Feature("cut", "output", force("cut", group="slab", level=.9, normal=vector((1, 0, 0))), physics=False),
    Feature("shell forces", "output", {**wall(), **force("shells", group="wall")}, physics=False),
    Feature("span", "output", {"spans": "tray", "tray_from": "pa", "tray_to": "pb"}, physics=False),
    Feature("floors", "output", {"pa_floor": "true"}, physics=False),
    Feature("pictures", "output", {"write_model": "true", "write_modes": "true", "modes": 2}, physics=False),
    Feature("fields", "output", {"fields_interval": 4e-3}, physics=False),
    Feature("exported matrices", "output", {"export_matrices": "$export"}, physics=False),
    Feature("struck areas", "output", {"struck_areas": .2, "struck_edges": .8}, physics=False),
]
