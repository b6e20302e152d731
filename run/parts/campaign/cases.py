"""The cases: ground motions, gaps, variants of the model, and the words that ask the program for them."""

from dataclasses import dataclass, field
from pathlib import Path

from . import paper


def both(**options) -> list:
    """Options of the two structures."""
    return [word for structure in ("s1", "s2") for name, value in options.items()
            for word in (f"-{structure}_{name}", value)]


# Fidelity: options in front of those of the case; {bases} is where bases are kept, one pair per variant.
COMMON = ["-courant", "0.99", "-gap_interval", "1e-3"]
FIDELITIES = {
    "full": COMMON,
    "scaled": [*both(mass_scaling="2.2e-5"), *COMMON],
    "modal": [*both(model="modal", modal_vectors="400", mass_scaling="5.5e-5"), *COMMON,
              "-s1_modal_basis", "{bases}-s1.h5", "-s2_modal_basis", "{bases}-s2.h5"],
}

VARIANTS = {"A": "Model A", "B": "Model B", "A-symmetric": "Model A, symmetric gap",
            "A-apart": "Model A without pounding"}

TARGETS = {"Cadarache": "near_field_rock", "El Centro": "alluvial", "Northridge": "near_fault_pulse",
           "Kobe": "long_period"}
SEEDS = {"x": 1, "y": 2, "z": 3}

# A hundred times cheaper: the same physics on a coarse mesh, the strong phase only.
QUICK_MESH = {"s1": "cells_x=7,cells_y=5,column_elements=2", "s2": "cells_x=5,cells_y=5,column_elements=2"}


DESCRIPTIONS = {"full": "full order", "scaled": "full order, mass of stiff frames scaled for a step of 2.2e-5 s",
                "modal": "400 modes and attachment vectors per structure, mass scaled for a step of 5.5e-5 s"}


@dataclass(frozen=True)
class Window:
    """How long a run lasts, and of a synthetic motion its duration and envelope [s]."""

    end_time: float = paper.DURATION
    duration: float = paper.DURATION
    envelope: str = "2,15"


FULL = Window()
QUICK = Window(end_time=3.0, duration=12.0, envelope="0.5,5")


@dataclass(frozen=True)
class Case:
    """One run: nominal gap [cm], ground motion, variant of the model, and all that asks for it."""

    gap: int
    motion: str
    variant: str
    words: tuple = field(default=(), compare=False)

    @property
    def model(self) -> str:
        return self.variant[0]

    @property
    def pounds(self) -> bool:
        return self.variant != "A-apart"

    @property
    def bases(self) -> list:
        """Files of the modal bases that the run reads or, if they are not there, writes."""
        return [Path(value) for name, value in zip(self.words, self.words[1:]) if name.endswith("_modal_basis")]

    @property
    def name(self) -> str:
        return f"gap{self.gap}-{self.motion.lower().replace(' ', '-')}-{self.variant.lower()}"

    @property
    def pga(self) -> float:
        """[m/s2]"""
        return paper.PGA[self.gap][self.motion] * paper.G


def gap_words(case: Case) -> list:
    corners = paper.CORNERS[case.gap]
    if not case.pounds:
        return ["-contacts", "none"]
    if case.variant == "A-symmetric":
        return [word for floor in ("floor1", "floor2") for word in (f"-{floor}_gap", repr(case.gap / 100))]
    lower, upper = (f"{corners[start] / 100!r},{corners[end] / 100!r}" for start, end in ("DC", "AB"))
    return ["-floor1_gap", lower, "-floor2_gap", upper]


def model_words(case: Case, quick: bool) -> list:
    words = ["-options_file", f"petsc-options/azalee/{'pair-b' if case.model == 'B' else 'pair'}.yaml"]
    for structure, cells in QUICK_MESH.items() if quick else ():
        slab = "slab=1," if case.model == "B" else ""
        words += [f"-{structure}_mesh_set", slab + cells]
    return words


def synthetic_words(case: Case, window: Window) -> list:
    target = f"petsc-options/spectra/{TARGETS[case.motion]}.csv"
    return ["-motion_x_target", target, "-motion_x_pga", repr(case.pga), "-motion_x_seed", str(SEEDS["x"]),
            "-motion_x_duration", repr(window.duration), "-motion_x_envelope", window.envelope]


def make_case(gap: int, motion: str, variant: str, window: Window, quick: bool, fidelity: str, extra: list,
              record=None, root: Path = Path()) -> Case:
    """`record`: a records.Record in the place of the synthetic motion, or None; `root`: folder of all cases."""
    case = Case(gap, motion, variant)
    bases = str(root / "bases" / variant.lower())
    shaking = record.words(case.pga) if record else synthetic_words(case, window)
    words = [*model_words(case, quick), *[word.format(bases=bases) for word in FIDELITIES[fidelity]],
             *gap_words(case), *shaking, "-end_time", repr(window.end_time), "-modes", "1",
             "-title", f"gap {gap} cm, {motion}, {VARIANTS[variant]}", *extra]
    return Case(gap, motion, variant, tuple(words))


def all_cases(window: Window = FULL, quick: bool = False, fidelity: str = "full", extra=(), records=None,
              gaps=paper.GAPS, motions=paper.MOTIONS, variants=tuple(VARIANTS), root: Path = Path()) -> list:
    """In the order in which they are run: every variant of a gap and a motion together."""
    return [make_case(gap, motion, variant, window, quick, fidelity, list(extra), (records or {}).get(motion), root)
            for gap in gaps for motion in motions for variant in variants]


def run_for(case: Case, among: list) -> Case:
    """The case of the list `among` whose run answers `case`. Without pounding the response grows with
    the peak of the motion, whatever the gap: one run serves all gaps."""
    if case.pounds:
        return case
    return next(one for one in among if (one.motion, one.variant) == (case.motion, case.variant))
