"""Tables of what was computed: motion, structures, damping, materials, sections, modes, joints; the
figure of damping."""

import numpy as np

from pounding.results import DIRECTIONS, Missing, Result
from .markup import html_table, paragraphs
from .style import G, WIDTH, log_scale, plt, save

MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
SHOWN = (1.0, 10.0, 100.0, 400.0)  # frequencies at which damping is told, as on the console [Hz]
FREQUENCY = np.geomspace(0.5, 400, 300)  # [Hz]
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def motion_table(result: Result) -> str:
    """Each record as it was understood."""
    found = result.summary.get("motion", {})
    rows = []
    for way in DIRECTIONS:
        one = found.get(way) if isinstance(found, dict) else None
        if not one:
            continue
        peak = one.get("file_peak")
        rows.append((way, one.get("file"), one.get("component", ""), one.get("sets_in_at", 0), one.get("format"),
                     one.get("unit", "m/s²"), peak, one.get("factor"),
                     one.get("pga"), one.get("pga_in_g", one.get("pga", 0) / G), one.get("points"), one.get("time_step"),
                     one.get("duration"), one.get("treatment"), one.get("end_velocity"),
                     None if one.get("end_displacement") is None else 1e3 * one["end_displacement"]))
    header = ("", "file", "component in it", "sets in at [s]", "read as", "unit", "peak in it [m/s²]", "factor",
              "PGA [m/s²]", "PGA [g]", "points", "step [s]", "duration [s]", "baseline and sampling",
              "velocity at its end [m/s]", "displacement at its end [mm]")
    if not rows:
        return paragraphs(["The ground does not move."])
    # One column per direction: the names of files are long.
    columns = list(zip(header, *rows))
    text = html_table("Ground motion as it was understood", list(columns[0]), [list(row) for row in columns[1:]],
                      text=tuple(range(1, len(rows) + 1)))
    supports = result.summary.get("supports", [])
    text += html_table("Supports that move otherwise", ["component", "source", "peak", "largest", "at the end"],
                       [(one.get("component"), one.get("source"), one.get("peak"), one.get("largest"), one.get("end"))
                        for one in supports], text=(1,))
    return text


def ratio_of(damping: dict, frequency: np.ndarray) -> np.ndarray | None:
    """Damping ratio [-] over frequency [Hz] of Rayleigh or uniform damping as summary.json tells it; None of another."""
    omega = 2 * np.pi * np.asarray(frequency, dtype=float)
    if "alpha" in damping:
        return damping["alpha"] / (2 * omega) + damping["beta"] * omega / 2
    if "filters" in damping:
        # Free motions e^(zt), z = i omega e^(i lag): the lag is half the phase of the modulus there, its sine the ratio.
        lag = np.zeros_like(omega)
        for _ in range(60):
            z = 1j * omega * np.exp(1j * lag)
            lag = np.angle(1 + sum(one["weight"] * z / (one["rate"] + z) for one in damping["filters"]) + 0 * z) / 2
        return np.sin(lag)
    return None


def damping_curves(structure: dict, frequency: np.ndarray) -> dict:
    """Label -> ratios [-] at the frequencies [Hz]: of the structure, then of the regions with damping of their own."""
    given = {"": structure.get("damping", {})} | structure.get("region_damping", {})
    curves = {name: ratio_of(one, frequency) for name, one in given.items() if one}
    return {name: ratios for name, ratios in curves.items() if ratios is not None}


def damping_table(result: Result) -> str:
    rows = []
    for name, structure in result.summary.get("structures", {}).items():
        given = structure.get("damping", {})
        ratios = structure.get("modal", {}).get("damping_ratios")
        if ratios:
            rows.append((name, "by mode: " + ", ".join(f"{100 * ratio:.3g} %" for ratio in ratios) + " and so on",
                         *[None] * len(SHOWN)))
            continue
        for region, curve in damping_curves(structure, np.array(SHOWN)).items():
            own = structure["region_damping"][region] if region else given
            words = (f"Rayleigh, α = {own['alpha']:.6g} 1/s, β = {own['beta']:.6g} s" if "alpha" in own else
                     f"uniform {100 * own['uniform']:.4g} % from {own['band'][0]:g} to {own['band'][1]:g} Hz, "
                     f"{len(own['filters'])} filters")
            rows.append((f"{name}: {region}" if region else name, words, *(f"{100 * ratio:.3f} %" for ratio in curve)))
    return html_table("Damping ratio", ["", "as given", *(f"at {f:g} Hz" for f in SHOWN)], rows, text=(1,))


def damping(result: Result) -> list:
    structures = result.summary.get("structures", {})
    curves, points = {}, {}
    for name, structure in structures.items():
        ratios = structure.get("modal", {}).get("damping_ratios")
        if ratios:
            frequencies = [mode["frequency"] for mode in structure.get("frequencies", [])]
            points[name] = (frequencies, [ratios[min(i, len(ratios) - 1)] for i in range(len(frequencies))])
            continue
        for region, curve in damping_curves(structure, FREQUENCY).items():
            if np.any(curve > 0):
                curves[f"{name}: {region}" if region else name] = curve
    if not curves and not points:
        raise Missing("no structure is damped")
    figure, axes = plt.subplots(figsize=(WIDTH, 3.2))
    for number, (name, curve) in enumerate(curves.items()):
        colour = _COLOURS[number % len(_COLOURS)]
        axes.plot(FREQUENCY, 100 * curve, label=name, color=colour, lw=2.2 if number == 0 else 1.4,
                  ls=("-", "--", "-.", ":")[number % 4])
        for mode in structures.get(name, {}).get("frequencies", []):
            if FREQUENCY[0] <= mode["frequency"] <= FREQUENCY[-1]:
                axes.plot(mode["frequency"], 100 * np.interp(mode["frequency"], FREQUENCY, curve), "o", ms=4, color=colour)
    for number, (name, (frequencies, ratios)) in enumerate(points.items()):
        axes.plot(frequencies, 100 * np.array(ratios), "s", ms=4, label=f"{name}, by mode",
                  color=_COLOURS[(len(curves) + number) % len(_COLOURS)])
    log_scale(axes, "x", FREQUENCY)
    log_scale(axes, "y", 100 * np.concatenate([*curves.values(), *(np.array(ratios) for _, ratios in points.values())]))
    axes.grid(True, which="minor", lw=0.3)
    axes.set(xlabel="frequency [Hz]", ylabel="damping ratio [%]")
    axes.legend(loc="best")
    return save(figure, result.folder, "damping.png", "Damping",
                "Damping ratio of a motion at one frequency; dots: the modes that were computed.")


def structure_table(result: Result) -> str:
    rows = []
    for name, one in result.summary.get("structures", {}).items():
        reduced = one.get("modal", {}).get("coordinates")
        rows.append((name, one.get("nodes"), one.get("elements"), one.get("dofs"), reduced, one.get("mass"),
                     one.get("omega_max"), one.get("stable_time_step")))
    header = ["", "nodes", "elements", "dofs", "reduced to", "mass [kg]", "ω max [rad/s]", "stable time step [s]"]
    if all(row[4] is None for row in rows):
        header, rows = header[:4] + header[5:], [row[:4] + row[5:] for row in rows]
    if any(isinstance(row[2], dict) for row in rows):
        rows = [(*row[:2], ", ".join(f"{count} {kind}" for kind, count in row[2].items()), *row[3:]) for row in rows]
    return html_table("Structures", header, rows)


def _vector(values) -> str:
    return ", ".join(f"{value:.4g}" for value in values)


def region_table(result: Result) -> str:
    """Each group: element, material and section by name, and its own numbers."""
    rows = []
    for name, structure in result.summary.get("structures", {}).items():
        for group, one in structure.get("regions", {}).items():
            own = [f"{key.replace('_', ' ')} {_vector(value) if isinstance(value, list) else format(value, '.6g')}"
                   for key, value in one.items() if key not in ("element", "material", "section") and value is not True]
            own += [key.replace("_", " ") for key, value in one.items() if value is True]
            rows.append((f"{name}: {group}", structure.get("groups", {}).get(group), one.get("element"),
                         one.get("material", {}).get("name"), one.get("section", {}).get("name"), "; ".join(own) or None))
    return html_table("Groups of the meshes (SI units)", ["", "elements", "kind", "material", "section", "and"], rows,
                      text=(2, 3, 4, 5))


def _named(result: Result, kind: str) -> dict:
    found = {}
    for structure in result.summary.get("structures", {}).values():
        for one in structure.get("regions", {}).values():
            if kind in one:
                found.setdefault(tuple((key, str(value)) for key, value in one[kind].items()), one[kind])
    return list(found.values())


def material_tables(result: Result) -> str:
    text = html_table("Materials as used", ["", "Young's modulus [GPa]", "Poisson's ratio", "density [kg/m³]"],
                      [(one["name"], 1e-9 * one["young"], one["poisson"], one["density"])
                       for one in _named(result, "material")])
    return text + html_table("Sections as used", ["", "area [cm²]", "I y [cm⁴]", "I z [cm⁴]", "torsion [cm⁴]", "local z"],
                             [(one["name"], 1e4 * one["area"], 1e8 * one["inertia_y"], 1e8 * one["inertia_z"],
                               1e8 * one["torsion"], _vector(one["z_axis"])) for one in _named(result, "section")])


def mode_rows(structure: dict) -> list:
    """The console's table of modes: number, frequency [Hz], direction, effective mass along it [kg] or about it [kg m2],
    its unit and axis, the share of what moves along or about the direction [%], the damped frequency [Hz], and the group
    with most of the motion, with its share."""
    rows = []
    for number, mode in enumerate(structure.get("frequencies", []), 1):
        masses, way = mode.get("effective_modal_mass") or [], mode.get("direction") or ""
        known = way in MOTIONS and len(masses) == len(MOTIONS)
        mass = masses[MOTIONS.index(way)] if known else mode.get("effective_mass")
        axis = f"{'kg m² about' if way.startswith('r') else 'kg along'} {way[-1]}" if known else None
        share = mode.get("fraction")
        rows.append((number, mode.get("frequency"), mode.get("direction"), mass, axis,
                     None if share is None else 100 * share, mode.get("damped_frequency"),
                     f"{mode['group']}, {100 * mode['group_share']:.1f} %" if "group" in mode else None))
    return rows


def mode_tables(result: Result) -> str:
    text = ""
    for name, structure in result.summary.get("structures", {}).items():
        rows = [(number, None if f is None else f"{f:.3f}", way, None if mass is None else f"{mass:.0f}", axis,
                 None if share is None else f"{share:.1f}", None if moved is None else f"{moved:.3f}", group)
                for number, f, way, mass, axis, share, moved, group in mode_rows(structure)]
        header = ["mode", "frequency [Hz]", "direction", "effective mass", "", "share of the direction [%]",
                  "damped [Hz]", "group that moves"]
        shown = [i for i in range(8) if i < 6 or any(row[i] for row in rows)]
        text += html_table(f"Modes of {name}", [header[i] for i in shown], [[row[i] for i in shown] for row in rows])
    if text:
        text += paragraphs(["Effective mass: along the direction named, or rotary inertia about it. Share: of all that can move along the "
                            "direction named (mass), or about it (rotary inertia), as on the console. Group that moves: the one whose nodes "
                            "have most of the kinetic energy; nodes that groups share count for each."], kind="note")
    return text


def contact_table(result: Result) -> str:
    """Joints as they were: gaps given and those of the meshes."""
    options = result.summary.get("options", {})
    rows = []
    for name, one in result.summary.get("contacts", {}).items():
        gap, mesh = one.get("initial_gap", [None] * 2), one.get("geometric_gap") or [None] * 2
        unloaded = one.get("unloaded_gap") or gap
        def span(pair):
            if pair[0] is None:
                return None
            low, high = (1e3 * value for value in pair)
            return f"{low:.4g}" if abs(high - low) < 1e-6 * max(abs(high), 1e-9) else f"{low:.4g} to {high:.4g}"
        filler = one.get("filler")
        rows.append((name, f"{options.get(f'{name}_secondary', '?')} on {options.get(f'{name}_primary', '?')}",
                     one.get("pairs"), one.get("matched"), options.get(f"{name}_gap"), span(gap), span(unloaded), span(mesh),
                     options.get(f"{name}_friction"), None if not filler else f"{filler['area']:.4g} m²"))
    header = ["", "faces", "pairs", "node to node", "gap as given [m]", "gap at rest [mm]", "unloaded [mm]", "in the meshes [mm]",
              "friction", "filler"]
    if not any(row[9] for row in rows):
        header, rows = header[:9], [row[:9] for row in rows]
    return html_table("Joints as they were computed", header, rows, text=(1, 4))


def run_table(result: Result) -> str:
    summary = result.summary
    labels = (("end_time", "end time [s]"), ("time_step", "time step [s]"), ("stable_time_step", "stable time step [s]"),
              ("steps", "steps"), ("output_interval", "interval of the samples [s]"), ("ranks", "ranks"),
              ("wall_time", "wall time [s]"), ("microseconds_per_step", "µs per step"), ("peak_memory", "memory of all ranks [bytes]"))
    return html_table("Run", ["", ""], [(label, summary[key]) for key, label in labels if key in summary])
