"""The look of every figure, and drawing of long series without losing their extremes."""

import io
import itertools
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402
from PIL import Image  # noqa: E402

from pounding.files import file_name, written_beside  # noqa: E402

G = 9.81  # [m/s2]
WIDTH = 9.0  # of a figure [in]

# One colour for each run in all figures: with pounding, without, the ground; of more runs one each.
WITH, WITHOUT, OF_GROUND = "#08519C", "#D55E00", "#777777"
_RUN_COLOURS = (WITH, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")

DIRECTION_COLOURS = {"x": "#0072B2", "y": "#E69F00", "z": "#009E73"}
_PROBE_COLOURS = ("#7FB0D9", "#4A6FA5", "#F4A582", "#B2182B", "#A6D96A", "#1B7837", "#C2A5CF", "#762A83")
_CONTACT_COLOURS = ("#3B7D3B", "#9C2C77", "#B8860B", "#2F4F6F")

plt.rcParams.update({
    "figure.dpi": 140, "figure.constrained_layout.use": True, "font.size": 10, "lines.linewidth": 1.0,
    "axes.titlesize": 10, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.grid": True,
    "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False, "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6, "legend.frameon": False, "legend.fontsize": 9, "agg.path.chunksize": 20000,
})


def run_colours(pounding: list) -> list:
    """Colour of each run of a list that says whether it has contacts; those without are of one colour."""
    own = itertools.cycle(_RUN_COLOURS)
    return [next(own) if one else WITHOUT for one in pounding]


def probe_colour(probes: list, name: str) -> str:
    return _PROBE_COLOURS[probes.index(name) % len(_PROBE_COLOURS)]


def contact_colour(contacts: list, name: str) -> str:
    index = contacts.index(name) if name in contacts else 0
    return _CONTACT_COLOURS[index % len(_CONTACT_COLOURS)]


def envelope(time: np.ndarray, values: np.ndarray, bins: int = 2500):
    """The series, or if it is long the smallest and largest value of each of `bins` stretches, in
    the order in which they occur: the picture is the same and no peak is lost."""
    size = len(values) // bins
    if size < 3:
        return time, values
    body = size * bins
    blocks = np.nan_to_num(values[:body], nan=0.0).reshape(bins, size)
    start = np.arange(bins) * size
    ends = np.sort(np.stack([start + blocks.argmin(1), start + blocks.argmax(1)], 1), 1).ravel()
    kept = np.concatenate([ends, np.arange(body, len(values))])
    return time[kept], values[kept]


def plot_series(axes, time, values, **options) -> None:
    axes.plot(*envelope(np.asarray(time), np.asarray(values)), **options)


def has_signal(values, reference: float) -> bool:
    """Whether the series is more than round-off beside `reference`."""
    peak = np.nanmax(np.abs(values), initial=0.0)
    return bool(peak > 1e-6 * reference and peak > 0)


def log_scale(axes, which: str, values, plain: bool = True) -> None:
    """Logarithmic axis if there is a positive value to draw; plain: 0.1 1 10, not powers of ten."""
    values = np.asarray(values)
    positive = values[np.isfinite(values) & (values > 0)]
    if len(positive) == 0:
        return
    getattr(axes, f"set_{which}scale")("log")
    if plain:
        axis = getattr(axes, f"{which}axis")
        number = FuncFormatter(lambda value, _: f"{value:g}")
        axis.set_major_formatter(number)
        # Below one decade the only labels may be those of the minor ticks; over more than a third of one those of
        # 2 and 5 are enough, and all of them would lie over each other.
        narrow = positive.max() < 10 * positive.min()

        def minor(value, _):
            low, high = axis.get_view_interval()
            return f"{value:g}" if high < 3 * low or f"{value:.6e}"[0] in "125" else ""

        axis.set_minor_formatter(FuncFormatter(minor) if narrow else NullFormatter())


def g_axis(axes) -> None:
    """A second axis on the right of one in m/s2, in g."""
    beside = axes.secondary_yaxis("right", functions=(lambda a: a / G, lambda a: a * G))
    if axes.get_yscale() == "log":
        beside.yaxis.set_major_formatter(axes.yaxis.get_major_formatter())
    beside.set_ylabel("[g]")


def legend_above(axes, columns: int = 1) -> None:
    """Legend at the right of the title, clear of the curves."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncol=columns, borderaxespad=0.0)


def stacked(rows: int, height: float = 1.9, sharey: bool = False):
    """Rows of axes over one time axis, as a flat array."""
    figure, axes = plt.subplots(rows, 1, figsize=(WIDTH, 0.6 + height * rows), sharex=True,
                                sharey=sharey, squeeze=False)
    return figure, axes.ravel()


def _panels(figure, picture, columns: list) -> tuple | None:
    """The picture cut between its columns of axes, so that a narrow page can show them below each other: how many of
    its pieces are legends above them, which come first, and (part of the width, PNG) of each."""
    drawn = [[axes.get_tightbbox() for axes in column if axes.get_visible()] for column in columns]
    ends = [(min(box.x0 for box in boxes), max(box.x1 for box in boxes)) for boxes in drawn if boxes]
    if len(ends) < 2:
        return None
    cuts = [0, *(round((left[1] + right[0]) / 2) for left, right in zip(ends, ends[1:])), picture.width]
    legends = [legend.get_window_extent() for legend in figure.legends]
    top = max((picture.height - math.floor(box.y0) for box in legends), default=0)
    pieces = [(math.floor(box.x0), 0, math.ceil(box.x1), top) for box in legends]
    pieces += [(left, top, right, picture.height) for left, right in zip(cuts, cuts[1:])]
    found = []
    for piece in pieces:
        held = io.BytesIO()
        picture.crop(piece).save(held, optimize=True, format="png")
        found.append(((piece[2] - piece[0]) / picture.width, held.getvalue()))
    return len(legends), found


def save(figure, folder: Path, name: str, title: str, caption: str, columns: list = ()) -> list:
    """Writes the PNG, in 256 colours, which takes a third of the room; returns what the report needs to show it.
    `columns`: lists of axes that stand side by side, from the left, which a narrow page shows below each other."""
    figure.align_ylabels()
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    colours = Image.open(drawn).convert("RGB").quantize(256, dither=Image.Dither.NONE)
    panels = _panels(figure, colours, columns)
    plt.close(figure)
    name = file_name(name)
    with written_beside(folder / name) as draft:
        colours.save(draft, optimize=True, format="png")
    return [{"file": name, "title": title, "caption": caption, "panels": panels}]
