"""The members of a study: samples of motion and building, each put to every gap and level, and apart."""

from dataclasses import dataclass

import numpy as np

from pounding import UserError
from pounding.fragility import latin_hypercube

from .study import Joint, Study

MOST_SAMPLES = 100_000  # so that studies of different seeds have different joints
OWN_FIELD = (1.0, 1.0)  # factors of a field as the study has it
APART = "apart"  # the runs without pounding, whose gap is the study's `apart`


@dataclass(frozen=True)
class Member:
    """`gap`: nominal [m], None of a run apart; `level`: peak ground acceleration [m/s2]; `values`: texts of the options
    of the table's columns. `disturbed`: by the study's noise, beside a member that is repeated at full order.
    `exchanged`: in the joint of the next sample, that of the first one for the last. `factors`: on deviation and length of
    the fields of its joints."""

    sample: int
    gap: float | None
    level: float
    values: tuple
    disturbed: bool = False
    exchanged: bool = False
    factors: tuple = OWN_FIELD

    @property
    def is_plain(self) -> bool:
        """As the study has it: neither disturbed, nor in the joints of others or in other fields."""
        return not self.disturbed and not self.exchanged and self.factors == OWN_FIELD


@dataclass
class Design:
    columns: list  # names of options
    members: list
    samples: np.ndarray  # (samples, variables)
    motions: list  # of each sample the number of its motion
    repeated: list  # indices of members to be repeated at full order

    def first(self, count: int) -> "Design":
        """That of so many samples."""
        members = [one for one in self.members if one.sample < count]
        return Design(self.columns, members, self.samples[:count], self.motions[:count], self.repeated)


def text_of(value: float) -> str:
    return f"{value:.9g}"


def motion_columns(study: Study) -> list:
    """Names of options, and of each motion their texts."""
    names = []
    for axis, one in study.axes.items():
        names += [f"motion_{axis}_{'record' if one.records else 'seed'}", f"motion_{axis}_pga"]
    return names + (study.moved.columns if study.moved else [])


def motion_values(study: Study, motion: int, level: float) -> tuple:
    values = []
    for one in study.axes.values():
        values += [str(one.motions[motion]), text_of(level * one.ratio_of(motion))]
    return tuple(values) + (study.moved.values(motion, text_of(level)) if study.moved else ())


def build(study: Study) -> Design:
    """All members, sample by sample, so that the first samples are whole where not all have been run. Throws UserError
    where a drawn value cannot be."""
    count = study.motion_count
    drawn = latin_hypercube(study.variables, study.samples, study.seed)
    names = [one.name for one in study.variables]
    for place, name in enumerate(names):
        if name.endswith("_factor") and not (drawn[:, place] > 0).all():
            raise UserError(f"{study.path}: factors: {name}: a draw of {drawn[:, place].min():.3g} is not above 0; "
                            "take a lognormal one")
    motions, off = [sample % count for sample in range(study.samples)], study.deviations(drawn)

    def member(sample: int, gap: float | None, level: float, disturbed: bool = False, exchanged: bool = False,
               factors: tuple = OWN_FIELD) -> Member:
        shaken = level * (1 + study.noise) if disturbed else level
        owner = (sample + exchanged) % study.samples  # of the joint
        values = motion_values(study, motions[sample], shaken)
        for place, joint in enumerate(study.joints.values()):
            values += (joint.text((study.apart if gap is None else gap) + off[owner, place]),)
            values += (str((study.seed * MOST_SAMPLES + owner) % 2**31),) if joint.field else ()
            if joint.field and study.field_factors:
                values += tuple(text_of(factor * one) for factor, one in zip(factors, joint.field))
        values += tuple(text_of(drawn[sample, names.index(one.name)]) for one in study.factors)
        return Member(sample, gap, level, values, disturbed, exchanged, factors)

    own_or_next = (False, True) if study.exchange else (False,)
    ways = [(None, False), *((gap, exchanged) for gap in study.gaps for exchanged in own_or_next)]
    members = [member(sample, gap, level, exchanged=exchanged) for sample in range(study.samples)
               for gap, exchanged in ways for level in study.levels]
    members += [member(sample, gap, study.levels[-1], exchanged=exchanged, factors=factors)
                for factors in study.field_factors for sample in range(study.samples)
                for gap in study.gaps for exchanged in own_or_next]
    repeated = choose(study, members)
    members += [member(one.sample, one.gap, one.level, True) for one in (members[index] for index in repeated)]
    joints = [column for name, joint in study.joints.items()
              for column in (f"{name}_{joint.column}", *(f"{name}_gap_{part}" for part in field_columns(study, joint)))]
    columns = motion_columns(study) + joints + [one.name for one in study.factors]
    return Design(columns, members, drawn, motions, repeated)


def field_columns(study: Study, joint: Joint) -> tuple:
    """Options of a joint's field that the members' table has; the scene has the others."""
    if not joint.field:
        return ()
    return ("seed", "deviation", "length") if study.field_factors else ("seed",)


def choose(study: Study, members: list) -> list:
    """Indices of members to be repeated at full order, spread over all cells by the seed; those apart, in the joints of
    others, and in other fields, are left out."""
    cells = [index for index, one in enumerate(members) if one.gap is not None and one.is_plain]
    wanted = int(np.ceil(study.share * len(cells) - 1e-9))
    generator = np.random.default_rng([study.seed, 1])
    strata = np.array_split(np.array(cells), wanted) if wanted else []
    return [int(generator.choice(stratum)) for stratum in strata]


def clipped(study: Study, design: Design) -> int:
    """How many gaps of the cells would be below zero, and are closed joints."""
    return int((study.built(design.samples)[..., None] + np.array(study.gaps) < 0).sum())
