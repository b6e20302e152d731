"""What is compared: the reference, the same scene disturbed by next to nothing, and every saving."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Setting:
    """`changes`: options beside those of the case, as {name: value}; `gap` [m] is added to every gap and
    `pga` multiplies the ground motion. `noise`: a disturbance, no saving. `file` replaces the case's
    options file where the model is another."""

    name: str
    what: str
    changes: tuple = ()
    gap: float = 0.0
    pga: float = 1.0
    noise: bool = False
    shells: bool = False

    @property
    def splits(self) -> int:
        return dict(self.changes).get("mesh_splits", 0)

    @property
    def reduces(self) -> bool:
        """Whether it changes the equations of full order."""
        return any(name.endswith(("_model", "_mass_scaling")) for name, _ in self.changes)


def both(option: str, value) -> tuple:
    """The same for the two buildings."""
    return ((f"s1_{option}", value), (f"s2_{option}", value))


REFERENCE = Setting("full", "full order, at its own time step")


def of_all(structures: list, option: str, value) -> tuple:
    """The same for every structure."""
    return tuple((f"{name}_{option}", value) for name in structures)


def in_modes(structures: list, count: int, told: tuple = ()) -> tuple:
    """Structures of a scene in so many modes, with the options that let the run tell its error."""
    return (*of_all(structures, "model", "modal"), *of_all(structures, "modal_vectors", count), *told, RARE)


def of_scene(structures: list, reducible: list, solids: list, dofs: int, time_step: float, told: tuple = ()) -> list:
    """Savings for any scene: `dofs` of its largest structure bound the modes of those that are `reducible`, mass is scaled
    for multiples of its `time_step` at full order [s], `solids` are the structures with hexahedra. `told`: options by
    which runs estimate their errors; the mesh, the same in all, is judged by the first that is run."""
    counts = [n for n in (25, 50, 100, 200, 400, 800) if n < dofs]
    step = {factor: float(f"{factor * time_step:.3g}") for factor in (2, 4)}
    fast = (*of_all(structures, "mass_scaling", step[4]), ("courant", 0.99))
    savings = [Setting("courant-0.99", "0.99 of the stable step", (("courant", 0.99),))]
    if solids:
        savings.append(Setting("single", "hexahedra in 32 bits", of_all(solids, "numbers", "single")))
    if reducible:
        savings.append(Setting("switched", "modes between strikes, full order else", of_all(reducible, "model", "switched")))
    savings += [Setting(f"mass-{factor}", f"stiff members scaled for a step of {value:.3g} s",
                        (*of_all(structures, "mass_scaling", value), *told)) for factor, value in step.items()]
    savings += [Setting(f"modal-{n}", f"{n} modes and attachment vectors, gaps every 0.01 s", in_modes(reducible, n, told))
                for n in counts]
    savings += [Setting(f"modal-{n}-fast", f"{n} modes, mass scaled for {step[4]:.3g} s, 0.99 of the stable step",
                        (*in_modes(reducible, n, told), *fast)) for n in counts]
    return savings


def pasted(setting: Setting) -> str:
    """Its options as words of a command line; bases go to the working folder."""
    words = [f"-{name} {value}".replace("{folder}/", "") for name, value in setting.changes
             if not name.startswith("fidelity_")]
    return " ".join(words) + ("  (in petsc-options/azalee/pair-b.yaml)" if setting.shells else "")


HALF_STEP = "half the time step"


def finer(time_step: float, splits: int) -> list:
    """Finer runs of any scene, whose `time_step` at full order [s] may come from stability or from what it resolves: half
    the step and, with meshes split so many times, a quarter and the scene at full order on each of them."""
    steps = [Setting("noise-step", HALF_STEP, (("time_step", f"{0.5 * time_step:.6g}"),), noise=True),
             Setting("noise-quarter", "a quarter of it", (("time_step", f"{0.25 * time_step:.6g}"),), noise=True)]
    meshes = [Setting(f"split-{n}", f"full order, every element split {n}x", (("mesh_splits", n),))
              for n in range(1, splits + 1)]
    return steps[:2 if splits else 1] + meshes


NOISE = [
    Setting("noise-pga", "shaking + 0.1 %", pga=1.001, noise=True),
    Setting("noise-gap", "gaps + 0.01 mm", gap=1e-5, noise=True),
    Setting("noise-step", HALF_STEP, (("courant", 0.45),), noise=True),
]

# Stiffness damping of the frames left out: the slabs keep theirs.
SLAB_BETA = (("s1_damping_beta", 0), ("s1_slab_damping_alpha", 0.1562), ("s1_slab_damping_beta", 1.2557e-5),
             ("s2_damping_beta", 0), ("s2_slab_damping_alpha", 0.2723), ("s2_slab_damping_beta", 1.2426e-5))
# One damping ratio from 1 to 400 Hz in place of Rayleigh's, which is 0.6 % at 2 and at 150 Hz.
UNIFORM = (*both("damping_alpha", 0), *both("damping_beta", 0), *both("damping_uniform", 0.006))
COARSE = (("s1_mesh_set", "cells_x=14,cells_y=10,column_elements=5"),
          ("s2_mesh_set", "cells_x=9,cells_y=10,column_elements=5"))
COARSER = (("s1_mesh_set", "cells_x=7,cells_y=5,column_elements=2"),
           ("s2_mesh_set", "cells_x=5,cells_y=5,column_elements=2"))
FINE = (("s1_mesh_set", "cells_x=56,cells_y=38,column_elements=20"),
        ("s2_mesh_set", "cells_x=36,cells_y=38,column_elements=20"))
# Gaps recorded more rarely than the probes, and the mass of fast coordinates scaled.
RARE = ("gap_interval", 0.01)
FAST = (*both("mass_scaling", 5.5e-5), ("courant", 0.99), RARE)


def modal(vectors: int, *more: tuple, candidates: int = 0) -> tuple:
    """Both buildings by modes and attachment vectors; the bases are kept and used again."""
    chosen = both("modal_candidates", candidates) if candidates else ()
    kept = f"{vectors}-of-{candidates}" if candidates else vectors
    return (*both("model", "modal"), *both("modal_vectors", vectors), *chosen, *more,
            ("s1_modal_basis", f"{{folder}}/basis-s1-{kept}.h5"), ("s2_modal_basis", f"{{folder}}/basis-s2-{kept}.h5"))


SAVINGS = [
    Setting("courant-0.99", "0.99 of the stable step", (("courant", 0.99),)),
    Setting("intervals", "gaps recorded every 0.01 s, energy ledger every 2000 steps",
            (RARE, ("energy_interval", 2000))),
    Setting("slab-beta", "beta in the slabs only", SLAB_BETA),
    Setting("uniform", "uniform damping of 0.6 % from 1 to 400 Hz", UNIFORM),
    Setting("shells", "slabs of shells (Model B)", shells=True),
    Setting("fine", "6 cm mesh, stiff frames scaled for a step of 6.5e-6 s", (*FINE, *both("mass_scaling", 6.5e-6))),
    Setting("two-layers", "two elements through the slabs", both("mesh_set", "layers=2")),
    Setting("coarse", "24 cm mesh", COARSE),
    Setting("coarser", "48 cm mesh", COARSER),
    Setting("mass-1e-5", "stiff frames scaled for a step of 1e-5 s", both("mass_scaling", 1e-5)),
    Setting("mass-2.2e-5", "stiff frames scaled for a step of 2.2e-5 s", both("mass_scaling", 2.2e-5)),
    Setting("mass-2.2e-5-fast", "the same, 0.99 of the stable step, gaps recorded every 0.01 s",
            (*both("mass_scaling", 2.2e-5), ("courant", 0.99), RARE)),
    Setting("mass-2.2e-5-coarse", "the same on the 24 cm mesh", (*both("mass_scaling", 2.2e-5), *COARSE)),
    *[Setting(f"modal-{n}", f"{n} modes and attachment vectors, gaps every 0.01 s", modal(n, RARE))
      for n in (40, 100, 200, 400, 800, 1000)],
    *[Setting(f"modal-{n}-of-400", f"{n} modes chosen of 400, likewise", modal(n, RARE, candidates=400))
      for n in (60, 80, 100, 150)],
    *[Setting(f"modal-{n}-of-400-fast", f"the same with {n}, mass scaled for 5.5e-5 s, 0.99 of the stable step",
              modal(n, *FAST, candidates=400)) for n in (60, 80, 100, 150)],
    *[Setting(f"modal-{n}-fast", f"{n} lowest modes, mass scaled in this way", modal(n, *FAST))
      for n in (100, 200, 400)],
    Setting("modal-bare-400", "400 modes without attachment vectors",
            (*both("model", "modal"), *both("modal_vectors", 400), *both("modal_attachment", "false"))),
    Setting("mixed", "structure 1 full, structure 2 by 400 modes", (("s2_model", "modal"), ("s2_modal_vectors", 400))),
]
