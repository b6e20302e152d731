"""The rungs of a scene's ladder of fidelities, and the disturbances that tell its noise floor."""

from dataclasses import dataclass

from .settings import RARE, Setting, of_all

COUNTS = (25, 50, 100, 200, 400, 800, 1600)  # modes per structure
SHAKING, GAP = 1.001, 1e-5  # factor on the motion; what is added to every gap [m]


@dataclass(frozen=True)
class Rung:
    """A fidelity of the ladder: its setting, the modes of each structure (None: full order)."""

    setting: Setting
    modes: int | None


FULL = Rung(Setting("full", "full order, at its own time step"), None)


def reduced(structures: tuple, modes: int) -> tuple:
    """Options of structures by modes and attachment vectors; the bases are kept, for the other runs of the rung."""
    kept = tuple((f"{name}_modal_basis", f"{{folder}}/basis-{name}-{modes}.h5") for name in structures)
    return (*of_all(structures, "model", "modal"), *of_all(structures, "modal_vectors", modes), *kept, RARE)


def rungs(structures: tuple, dofs: int) -> list:
    """By modes, as long as they are fewer than half the dofs of the largest structure, then full order."""
    found = [Rung(Setting(f"modal-{n}", f"{n} modes and attachment vectors", reduced(structures, n)), n)
             for n in COUNTS if 2 * n < dofs]
    return [*found, FULL]


def longer_step(rung: Rung, structures: tuple, factor: float, time_step: float) -> Setting:
    """The rung with its fast coordinates slowed down for `factor` times the `time_step` of full order [s]."""
    step = float(f"{factor * time_step:.3g}")
    return Setting(f"{rung.setting.name}-step-{factor:g}",
                   f"{rung.setting.what}, mass scaled for a step of {step:.3g} s",
                   (*rung.setting.changes, *of_all(structures, "mass_scaling", step), ("courant", 0.99)))


def changed(setting: Setting, name: str, what: str, changes: tuple) -> Setting:
    """A setting with more options under a name of its own."""
    return Setting(f"{setting.name}-{name}", f"{setting.what}, {what}", (*setting.changes, *changes), noise=True)


def disturbances(options: dict) -> list:
    """(name, words, options) of what a scene is disturbed by, from its options in force: .1 % more shaking, and gaps
    that are .01 mm wider where they are given as numbers."""
    shaking = []
    for way in "xyz":
        head = f"motion_{way}_"
        if not (options.get(f"{head}target") or options.get(f"{head}record", "none") != "none"):
            continue
        key = "pga" if float(options.get(f"{head}pga", 0)) > 0 else "scale"
        shaking.append((f"{head}{key}", f"{float(options.get(f'{head}{key}', 1)) * SHAKING:.9g}"))
    found = [("shaking", "0.1 % more shaking", tuple(shaking))] if shaking else []
    gaps = []
    for contact in filter(None, str(options.get("contacts", "")).split(",")):
        values = _numbers(str(options.get(f"{contact.strip()}_gap", "")))
        if values:
            gaps.append((f"{contact.strip()}_gap", ",".join(f"{value + GAP:.9g}" for value in values)))
    return found + ([("gaps", "gaps .01 mm wider", tuple(gaps))] if gaps else [])


def _numbers(text: str) -> list:
    try:
        return [float(word) for word in text.split(",")]
    except ValueError:
        return []
