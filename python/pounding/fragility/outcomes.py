"""What members of a study left, as arrays: those of ensemble.h5."""

import zipfile
import zlib
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from pathlib import Path

import h5py
import numpy as np

from pounding import UserError
from pounding.ensembles import damaged
from pounding.files import written_beside
from pounding.results import UNREADABLE, Result, text_of
from pounding.spans import MOTIONS
from pounding.stability import MOTIONS as SETTLED, base_motion, slip_of
from pounding.struck import VALUES, of_run as struck_of_run


FILE = "ensemble.h5"
BANDS = ((0.1, 10), (10, 50), (50, 400))  # of the parts of a scatter [Hz]
# Dataset of ensemble.h5 -> its name here; the first dimension is the member's.
ARRAYS = {"spectra/pseudo_acceleration": "spectra", "impacts/episodes": "episodes", "impacts/first_time": "first_time",
          "impacts/impulse_sum": "impulse_sum", "impacts/impulse_largest": "impulse_largest",
          "impacts/force_peak": "force_peak", "gaps/smallest": "smallest_gap", "peaks/displacement": "displacement",
          "peaks/acceleration": "acceleration", "energy/residual": "residual", "pairs/initial_gap": "pair_gap",
          "pairs/least_gap": "pair_least", "pairs/time": "pair_time", "pairs/displacement": "pair_moved",
          "spans/peak": "span_peak", "spans/time": "span_time", "struck/largest": "struck",
          "bases/settled": "settled", "impacts/slip": "slip"}
NOT_ALWAYS = {"span_peak": lambda contacts: (0, len(MOTIONS)), "span_time": lambda contacts: (0, len(MOTIONS)),
              "struck": lambda contacts: (contacts, 0, VALUES), "settled": lambda contacts: (0, len(SETTLED)),
              "slip": lambda contacts: (contacts,)}  # shapes of none, by the number of contacts
FORCES = "forces/history"  # of members that have them: left in the file
# What all members share.
LABELS = {"spectra/frequency": "frequency", "spectra/damping": "damping", "spectra/channels": "channels",
          "impacts/contacts": "contacts", "pairs/contact": "pair_contact", "pairs/place": "pair_place", "spans/names": "spans",
          "bases/names": "bases"}
TEXTS = ("channels", "contacts", "spans", "bases", "force_names")


@dataclass
class Outcomes:
    """`spectra` (members, channels, damping ratios, frequencies) [m/s2]; impacts and gaps (members, contacts); peaks
    (members, channels); pairs of contacts by number of the contact and place (pairs, 3), their gaps at the start, least ones
    and when (members, pairs), and largest relative displacements (members, pairs, 3); largest motions of the ends of
    `spans` against each other, and when (members, spans, 8), in the order of spans.MOTIONS; largest forces on windows of the faces
    (members, contacts, windows, struck.VALUES); stability.MOTIONS of `bases` (members, bases, 3); slips (members, contacts); `forces` recorded (members,
    samples, columns) and their names and times; SI units."""

    frequency: np.ndarray
    damping: np.ndarray
    channels: list
    contacts: list
    pair_contact: np.ndarray
    pair_place: np.ndarray
    spectra: np.ndarray
    episodes: np.ndarray
    first_time: np.ndarray
    impulse_sum: np.ndarray
    impulse_largest: np.ndarray
    force_peak: np.ndarray
    smallest_gap: np.ndarray
    displacement: np.ndarray
    acceleration: np.ndarray
    residual: np.ndarray
    pair_gap: np.ndarray
    pair_least: np.ndarray
    pair_time: np.ndarray
    pair_moved: np.ndarray
    spans: list
    span_peak: np.ndarray
    span_time: np.ndarray
    struck: np.ndarray
    bases: list
    settled: np.ndarray
    slip: np.ndarray
    force_names: list = field(default_factory=list)
    force_time: np.ndarray = field(default_factory=lambda: np.empty(0))
    forces: "np.ndarray | Kept" = field(default_factory=lambda: np.empty((1, 0, 0)))

    def rows(self, channels: list, cells_at, place: dict | None = None) -> list:
        """A row per channel of these numbers, damping ratio and frequency, with the cells that `cells_at` has of its place
        among them; `place`: cells in front."""
        return [{**(place or {}), "channel": self.channels[channel], "damping": f"{ratio:g}",
                 "frequency": f"{frequency:.9g}", **cells_at((c, d, f))} for c, channel in enumerate(channels)
                for d, ratio in enumerate(self.damping) for f, frequency in enumerate(self.frequency)]

    @property
    def bands(self) -> list:
        """Name of each band of BANDS in which there are frequencies, and which of them are."""
        inside = {f"{low:g}-{high:g}": (self.frequency >= low) & (self.frequency <= high) for low, high in BANDS}
        return [(name, which) for name, which in inside.items() if which.any()]


@dataclass(frozen=True)
class Kept:
    """Histories of recorded forces that stay in the files of the members: each is read where it is asked for."""

    places: list  # of each member, file and row

    def __getitem__(self, member: int) -> np.ndarray:
        path, row = self.places[member]
        with _reading(path) as file:
            return file[FORCES][row]


def _texts(values) -> list:
    return list(map(text_of, np.ravel(values)))


@contextmanager
def _reading(path: Path):
    """Throws UserError where what is read is damaged."""
    try:
        with h5py.File(path, "r") as file:
            yield file
    except UNREADABLE as error:
        raise UserError(f"{path} cannot be read ({' '.join(str(error).split())}); remove it, and its members are run "
                        "again") from error


def read_rows(path: Path) -> tuple:
    """Columns, and of each finished member its texts -> its number in the file; one whose numbers are not those written counts as
    not run. Throws UserError."""
    with _reading(path) as file:
        table = file["members/table"]
        columns = text_of(table.attrs["columns"]).split(",")
        cells, done = np.array(_texts(table[()])).reshape(-1, len(columns)), np.ravel(file["done"][()])
        if len(cells) != len(done):
            raise ValueError("a flag for each member is missing")
        lost = set(damaged(file) if "members/crc32" in file else ())
    return columns, {tuple(row): index for index, row in enumerate(cells) if done[index] == 1 and index not in lost}


def time_steps(path: Path) -> list:
    """Time step that all members of an ensemble have, as text [s]; none of single runs."""
    with _reading(path) as file:
        lines = _texts(file["identity"][()]) if "identity" in file else []
    return [line.split()[2] for line in lines if line.startswith("time step ")]


def collect(files: list, members: list, columns: list) -> tuple:
    """Outcomes of the members, and the indices of those that are in none of the files. The outcomes are of the members
    that were found, in their order; None of none."""
    found, shared, places = {}, None, {}
    for path in files:
        heads, rows = read_rows(path)
        if heads != columns:
            continue
        for index, member in enumerate(members):
            if index not in places and member.values in rows:
                places[index] = (path, rows[member.values])
    order = sorted(places)
    for path in dict.fromkeys(place for place, _ in places.values()):
        mine = [index for index in order if places[index][0] == path]
        rows = np.array([places[index][1] for index in mine])
        with _reading(path) as file:
            labels = {name: file[dataset][()] if dataset in file else [] for dataset, name in LABELS.items()}
            labels |= {name: _texts(labels[name]) for name in TEXTS if name in labels}
            if FORCES in file:
                labels |= {"force_names": _texts(file["forces/names"][()]), "force_time": file["forces/time"][()]}
            shared = shared or labels
            if labels["channels"] != shared["channels"] or not np.allclose(labels["frequency"], shared["frequency"]):
                raise UserError(f"{path}: other probes or frequencies than in the other parts")
            for dataset, name in ARRAYS.items():
                lacks = name in NOT_ALWAYS and dataset not in file
                values = np.zeros((len(rows), *NOT_ALWAYS[name](len(labels["contacts"])))) if lacks else file[dataset][()][rows]
                target = found.setdefault(name, np.empty((len(order), *values.shape[1:])))
                target[[order.index(index) for index in mine]] = values
    if shared and "force_names" in shared:
        found["forces"] = Kept([places[index] for index in order])
    missing = [index for index in range(len(members)) if index not in places]
    return (Outcomes(**shared, **found) if shared else None), missing


def of_run(result: Result) -> Outcomes:
    """The same arrays, of one member, from the result folder of an ordinary run."""
    told, table = result.summary, result.spectra
    contacts = list(told.get("contacts", {}))
    probes = list(told.get("probes", {}))
    channels = [f"{probe} {way}" for probe in probes for way in "xyz"]
    damping, frequency = np.unique(table["damping"]), np.unique(table["frequency"])
    spectra = np.array([[result.spectrum(*channel.rsplit(" ", 1), damping=ratio)[1] for ratio in damping]
                        for channel in channels])
    impacts = told.get("impacts", {})

    def of_contact(key: str, default: float) -> np.ndarray:
        return np.array([[impacts.get(name, {}).get(key) or default for name in contacts]], float)

    struck = np.asarray(result.impacts.get("contact", []), dtype=str)

    bases = list(dict.fromkeys(name.rsplit(".", 1)[0] for name in result.history.get("bases", [])))
    settled = np.array([base_motion(result, name) for name in bases]).reshape(1, -1, len(SETTLED))
    slip = np.array([[slip_of(result, name) if "slip" in result.impacts else 0.0 for name in contacts]])

    def of_impacts(column: str, smallest: bool) -> np.ndarray:
        """Smallest or largest of a column by contact; none is nan or 0."""
        found = [result.impacts[column][struck == name] for name in contacts]
        if smallest:
            return np.array([[one.min() if len(one) else np.nan for one in found]])
        return np.array([[one.max() if len(one) else 0.0 for one in found]])

    gaps = [np.nanmin(result.history["gap"], axis=0) if len(contacts) else []]
    peaks = {key: [[value or 0.0 for probe in probes for value in told["probes"][probe][key]]]
             for key in ("peak_displacement", "peak_acceleration")}
    pairs = result.table("joint_pairs")
    of_pairs = {name: np.asarray(pairs.get(name, []), float)
                for name in ("x", "y", "z", "initial_gap", "least_gap", "time", "dx", "dy", "dz")}
    place = np.stack([of_pairs[axis] for axis in "xyz"], -1)
    of_spans = np.array([span.largest for span in result.spans.values()]).reshape(-1, 2, len(MOTIONS))
    owner = np.array([contacts.index(name) for name in pairs.get("contact", [])], float)
    recorded = result.history.get("forces", [])
    every = slice(None) if len(recorded) else slice(0, 0)
    return Outcomes(frequency, damping, channels, contacts, owner, place, spectra[None], of_contact("episodes", 0),
                    of_impacts("start", True), of_contact("total_impulse", 0), of_contact("largest_impulse", 0),
                    of_impacts("peak_force", False), np.array(gaps), np.array(peaks["peak_displacement"]),
                    np.array(peaks["peak_acceleration"]), np.array([told["energy"]["relative_residual"] or 0.0]),
                    of_pairs["initial_gap"][None], of_pairs["least_gap"][None], of_pairs["time"][None],
                    np.stack([of_pairs[f"d{axis}"] for axis in "xyz"], -1)[None], list(result.spans), of_spans[None, :, 0],
                    of_spans[None, :, 1], struck_of_run(result)[1][None], bases, settled, slip, list(recorded), result.history["time"][every],
                    result.history.get("force", np.empty((0, 0)))[every][None])


def write(path: Path, columns: list, texts: list, parts: list) -> None:
    """Writes outcomes of one member each as an ensemble.h5, in place at once."""
    with written_beside(path) as draft, h5py.File(draft, "w") as file:
        table = file.create_dataset("members/table", data=np.char.encode(np.array(texts).reshape(len(texts), -1)))
        table.attrs["columns"] = ",".join(columns)
        for dataset, name in LABELS.items():
            values = getattr(parts[0], name)
            file[dataset] = np.char.encode(np.array(values, str)) if isinstance(values, list) else values
        for dataset, name in ARRAYS.items():
            file[dataset] = np.concatenate([getattr(part, name) for part in parts])
        if parts[0].force_names:
            file["forces/names"], file["forces/time"] = np.char.encode(parts[0].force_names), parts[0].force_time
            file[FORCES] = np.concatenate([part.forces for part in parts])
        file["done"] = np.ones(len(parts), dtype="i4")


def save(path: Path, one: Outcomes) -> None:
    """Keeps the outcome of one member."""
    with written_beside(path) as draft:
        np.savez(draft, **{item.name: getattr(one, item.name) for item in fields(Outcomes)})


def restore(path: Path) -> Outcomes | None:
    """None where there is none, or one that is damaged."""
    try:
        with np.load(path, allow_pickle=False) as file:
            values = {item.name: file[item.name] for item in fields(Outcomes)}
    except (*UNREADABLE, EOFError, zipfile.BadZipFile, zlib.error):
        return None
    return Outcomes(**values | {name: values[name].tolist() for name in TEXTS})
