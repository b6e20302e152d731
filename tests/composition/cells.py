"""Two features on one scene: whether that runs, and whether what it leaves is true."""
import functools
import os
import re
import shutil
import tempfile
from pathlib import Path

import h5py
import numpy

import program
from scene import STEP, STEPS, UNITS, Scene, factor, record


def on(feature, structure):
    """Options of a feature on a structure."""
    return {key.replace("@", structure): value.replace("@", structure) if isinstance(value, str) else value
            for key, value in feature.options.items()}


def clash(first, second):
    """Why two features, given by their options, cannot be on one scene by a rule of their kinds; else none."""
    for key in sorted(first.keys() & second.keys()):
        one, other = first[key], second[key]
        more = isinstance(one, str) and one.startswith("+")
        weight = key in ("gravity", "preload") and one == other
        if not more and not weight:
            return f"both state `{re.sub('^[ab]_', '', key)}`"
    for one, other in ((first, second), (second, first)):
        for key, value in one.items():
            gone = re.fullmatch(r"([ab])_(\w+)_element", key)
            if gone and value is None:
                structure, group = gone.groups()
                if any(k.startswith(f"{structure}_{group}_") or k.endswith("_group") and v == group
                       or isinstance(v, str) and re.search(rf"\b{structure}:{group}\b", v) for k, v in other.items()):
                    return f"one takes out the {group} that the other is of"
    return None


def pair(first, second):
    """The scene of two features, the second on the other structure where they are alternatives on one; or why there is
    none."""
    reasons = []
    for structure in "ab" if any("@" in key for key in second.options) else "a":
        one, two = on(first, "a"), on(second, structure)
        same_place = first.slot and first.slot == second.slot and structure == "a"
        reasons.append("both are of one ground" if same_place else clash(one, two))
        if reasons[-1] is None:
            return Scene().lay(one).lay(two)
    return reasons[0]


class Records:
    """What a run left: columns of history.h5 by name, and by vectors of three; the ledger."""

    def __init__(self, folder, units="SI", turned=False):
        length, mass = UNITS[units]
        self.summary = program.summary(folder)
        self.columns = {}
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            self.time = file["time"][()]
            names = {key: [n.decode() for n in file[key]] for key in ("channels", "contacts", "forces", "links", "rotations") if key in file}
            for key, data in file.items():
                if data.dtype.kind != "f" or not data.size or len(data) != len(self.time) or key == "time":
                    continue
                labels = names.get({"force": "forces", "gap": "contacts", "contact_force": "contacts", "link_force": "links",
                                    "link_elongation": "links", "rotation": "rotations"}.get(key, "channels"), [])
                labels = [f"ground.{axis}" for axis in "xyz"] if key == "ground_acceleration" else labels
                unit = data.attrs["unit"].decode().split(", ")
                for label, column in zip(labels, numpy.nan_to_num(data[()]).T):
                    turning = re.search(r"\.(M\w|T|r[xyz])\w?$", label) is not None
                    self.columns[f"{key} {label}"] = column / factor(unit[-1 if turning else 0], length, mass)
        struck = os.path.join(folder, "struck_areas.csv")
        for place, force in enumerate(program.read_csv(struck)["force"] if os.path.exists(struck) else ()):
            self.columns[f"contact_force struck {place}"] = numpy.array([float(force)]) / factor("N", length, mass)
        if turned:
            self.turn_back()
        ledger = program.read_csv(os.path.join(folder, "energy.csv"))
        self.ledger = {name: numpy.array(values, dtype=float) / factor("J", length, mass)
                       for name, values in ledger.items() if name != "time"}

    def turn_back(self):
        """From the axes of the turned model, x' = -y and y' = x."""
        for name in [name for name in self.columns if re.search(r"[.FM]x$", name)]:
            other = name[:-1] + "y"
            self.columns[name], self.columns[other] = self.columns[other], -self.columns[name]
            if name.startswith("link"):
                self.columns[other] = -self.columns[other]

    def apart(self, other, tolerance):
        """The first quantity in which another run differs by more than a tolerance of the largest value of its kind; or
        none."""
        if self.columns.keys() != other.columns.keys():
            return f"columns {self.columns.keys() ^ other.columns.keys()}"
        scales = {}
        for name, column in self.columns.items():
            kind = re.sub(r"\.\w+$", "", name) if name.startswith(("force", "link")) else name.split()[0]
            kind += "turning" if re.search(r"\.(M\w|T|r[xyz])\w?$", name) else ""
            scales[name] = kind
        largest = {}
        for name, kind in scales.items():
            largest[kind] = max(largest.get(kind, 0), abs(self.columns[name]).max())
        largest["gap"] = max(largest.get("gap", 0), largest["displacement"])
        worst = ("", 0.0)
        for name, column in self.columns.items():
            difference = abs(column - other.columns[name]).max()
            rough = 100 if re.match("acceleration|contact_force|force|link_force", name) else 1  # differences over a step
            if difference > rough * tolerance * largest[scales[name]]:
                part = difference / largest[scales[name]] if largest[scales[name]] else numpy.inf
                worst = max(worst, (name, part), key=lambda found: found[1])
        energy = max(abs(values).max() for values in self.ledger.values())
        for name, values in self.ledger.items():
            difference = abs(values - other.ledger[name]).max()
            if difference > tolerance * energy:
                worst = max(worst, (f"{name} of the ledger", difference / energy), key=lambda found: found[1])
        return f"{worst[0]} by {worst[1]:.1e}" if worst[0] else None


def of_structures(options):
    """Those of structures alone, at full order and of their own elements, to export their matrices."""
    lists = ("contacts", "loads", "forces", "supports")
    items = tuple(f"{name}_" for key in lists for name in options.get(key, "").split(",") if name)
    return {key: value for key, value in options.items() if not key.startswith(items) and key not in (
        *lists, "loops", "ensemble", "mesh_pieces", "fields_interval") and not re.match(r"[ab]_(matrices|model|modal_|switched_)", key)}


class Cell:
    """The scene of one or two features and its runs, in a folder that goes with it."""

    def __init__(self, scene):
        self.scene = scene
        self.folder = tempfile.mkdtemp(prefix="cell-")
        self.count = 0

    def close(self):
        shutil.rmtree(self.folder)

    def run(self, *more, scene=None, ranks=1, units="SI", turned=False):
        """Runs the scene, or another one in its place; the result and the folder of what it left. What it needs of other runs comes first."""
        scene = scene or self.scene
        place = os.path.join(self.folder, f"{self.count}")
        self.count += 1
        os.makedirs(place)
        if any(key[1:] == "_matrices" for key in scene.options):
            matrices = os.path.join(self.folder, f"{units}-{turned}", "matrices")
            first = Scene.of(of_structures(scene.options))
            done = program.job([*first.words(place, units, turned), "-dry_run", "-export_matrices", f"{matrices}", "-output", f"{place}/first"], 1)
            if done.returncode:
                return done, place
            scene = Scene.of({key: value.replace("$", f"{matrices}/") if key[1:] == "_matrices" else value for key, value in scene.options.items()})
        if "mesh_pieces" in scene.options:
            done = program.job([*scene.words(place, units, turned), "-write_mesh_pieces", ranks, *(["-partition", "elements"] if ranks > 1 else [])], 1)
            if done.returncode:
                return done, place
        if "ensemble" in scene.options:
            with open(os.path.join(place, "members.csv"), "w") as file:
                file.write("motion_level\n0.7\n1\n")
        output = os.path.join(place, "results")
        return program.job([*scene.words(place, units, turned), *more, "-output", output], ranks), output

    def records(self, *more, **options):
        result, output = self.run(*more, **options)
        if result.returncode != 0:
            raise Refused(sentence(result))
        return Records(output, options.get("units", "SI"), options.get("turned", False))

    def without(self, *names):
        return Scene.of({key: value for key, value in self.scene.options.items() if key not in names})

    @functools.cached_property
    def single(self):
        """The scene as one run."""
        return self.without("ensemble")

    @functools.cached_property
    def reference(self):
        result, output = self.run(scene=self.single)
        if result.returncode != 0:
            raise Refused(sentence(result))
        self.results = output
        return Records(output)


class Refused(Exception):
    pass


def sentence(result):
    """The line that a refused run ends with, without names of files; a crash says so."""
    lines = program.error_lines(result)
    if result.returncode != 1 or len(lines) != 1:
        return f"ended with {result.returncode}: {result.stderr[-300:]}"
    return re.sub(r"\b[0-9a-f]{16}(?=\.)", "file", re.sub(r"/\S*/", "", lines[0].removeprefix("pounding: ")))


CLOSE, RANKS, SAME = 1e-12, 1e-10, 1e-9


def within(tolerance, scene):
    """The tolerance of a scene: looser where a rest under gravity or a basis of a few modes is found by iterations."""
    modes = any(key[1:] == "_model" for key in scene.options)
    return max(tolerance, 1e-6 if modes else 2e-8 if scene.options.get("preload") == "static" else 0)


def ledger(cell):
    """It closes to round-off."""
    residual = cell.reference.summary["energy"]["relative_residual"]
    return f"residual {residual:.1e}" if residual > CLOSE else None


def two_ranks(cell):
    return cell.reference.apart(cell.records(scene=cell.single, ranks=2), within(RANKS, cell.single))


def continued(cell):
    """A run that is continued from a checkpoint is the uninterrupted one to the bit."""
    step = STEPS * 3 // 8
    whole = cell.reference
    result, output = cell.run("-checkpoint_steps", step, "-end_time", (step + 9) * STEP, scene=cell.single)
    if result.returncode:
        return f"cut: {sentence(result)}"
    result, after = cell.run("-restart", os.path.join(output, "checkpoint.h5"), scene=cell.single)
    if result.returncode:
        return f"continued: {sentence(result)}"
    apart = whole.apart(Records(after), 0)
    for name in ("impacts.csv", "energy.csv", "spectra.csv", "forces.csv"):
        texts = {path.read_text() for place in (cell.results, after) for path in Path(place).glob(name)}
        apart = apart or (name if len(texts) > 1 else None)
    return apart


def full(cell):
    return Scene.of({key: value for key, value in cell.single.options.items() if not re.fullmatch(r"[ab]_(model|modal_\w+)", key)})


def in_all_modes(cell):
    """All modes are full order, where structures may be in modes."""
    scene = full(cell)
    reference = cell.reference if scene.options.keys() == cell.single.options.keys() else cell.records(scene=scene)
    modal = Scene.of({**scene.options, **{key: value for s in "ab" for key, value in (
        (f"{s}_model", "modal"), (f"{s}_modal_vectors", reference.summary["structures"][s]["dofs"]))}})
    cell.modal = modal
    return reference.apart(cell.records(scene=modal), within(SAME, full(cell)))


def as_member(cell):
    """A member of an ensemble is its single run."""
    options = {key: value for key, value in cell.scene.options.items() if key not in ("loops", "fields_interval")}
    if "ensemble" not in options:
        options.update({"a_model": "modal", "a_modal_vectors": 12, "b_model": "modal", "b_modal_vectors": 12})
    single = cell.records(scene=Scene.of({key: value for key, value in options.items() if key != "ensemble"}))
    result, output = cell.run(scene=Scene.of({**options, "ensemble": "$members.csv"}))
    if result.returncode:
        raise Refused(sentence(result))
    with h5py.File(os.path.join(output, "ensemble.h5")) as file:
        channels = [name.decode() for name in file["spectra/channels"]]
        peaks, residual = file["peaks/displacement"][1], file["energy/residual"][()]
        struck = file["struck/largest"][1, ..., 0].ravel() if "struck/largest" in file else []
        impulse, episodes = file["impacts/impulse_sum"][1].sum(), file["impacts/episodes"][1].sum()
    own = {name: abs(column).max() for name, column in single.columns.items()}
    scale = max(value for name, value in own.items() if name.startswith("displacement"))
    for channel, peak in zip(channels, peaks):
        expected = own["displacement " + channel.replace(" ", ".")]
        if abs(peak - expected) > 1e-9 * scale:
            return f"peak of {channel} {peak:.10g}, alone {expected:.10g}"
    for place, force in enumerate(struck):
        alone = single.columns[f"contact_force struck {place}"][0]
        if abs(force - alone) > 1e-7 * abs(alone):
            return f"struck by {force:.10g} N, alone {alone:.10g} N"
    if abs(residual).max() > CLOSE:
        return f"residual {abs(residual).max():.1e}"
    found = single.summary["impacts"]
    if episodes != (found.get("episodes") or 0) or abs(impulse - found.get("total_impulse", 0)) > 1e-9 * max(1, abs(impulse)):
        return f"{episodes} impacts of {impulse}, alone {found.get('episodes')} of {found.get('total_impulse')}"
    return None


def at_rest(cell):
    """A structure at rest stays at rest: nothing shakes, nothing starts."""
    options = {key: value for key, value in cell.single.options.items()
               if not isinstance(value, record) and not re.search(r"_initial_\w+$", key)}
    driven = ("rocking", "late", "deep")  # by a motion that there is not
    options = {key: value for key, value in options.items() if not key.startswith(driven)}
    if "supports" in options:
        options["supports"] = ",".join(s for s in options["supports"].split(",") if s not in driven) or "none"
    loads = [name for name in options.get("loads", "").split(",") if name]
    weight = options.get("gravity") and options.get("preload") == "static"
    still = [name for name in loads if weight and options.get(f"{name}_function", "constant") == "constant" and f"{name}_values" not in options]
    for name in loads:
        if name not in still:
            options = {key: value for key, value in options.items() if not key.startswith(f"{name}_")}
    options["loads"] = ",".join(still) or "none"
    if not weight:
        options.pop("gravity", None)
    quiet = cell.records(scene=Scene.of(options))
    scale = max(abs(column).max() for name, column in cell.reference.columns.items() if name.startswith("displacement"))
    for name, column in quiet.columns.items():
        if name.startswith("displacement") and numpy.ptp(column) > 1e-9 * scale:
            return f"{name} moves by {numpy.ptp(column):.1e}, of {scale:.1e} in the run"
    return None


def in_other_units(cell):
    return cell.reference.apart(cell.records(scene=cell.single, units="mm"), within(SAME, cell.single))


def turned(cell):
    return cell.reference.apart(cell.records(scene=cell.single, turned=True), within(SAME, cell.single))


PROPERTIES = {"the ledger closes": ledger, "two ranks": two_ranks, "continued": continued, "all modes": in_all_modes,
              "as a member": as_member, "at rest": at_rest, "other units": in_other_units, "turned": turned}
