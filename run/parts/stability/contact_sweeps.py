"""Sweeps of contacts that hold a place more than once: rows of L that are one row again, or nearly. Returns
its rows."""

import sys

from . import scenes
from .bench import SOURCE, Bench, Row, checked

sys.path.append(str(SOURCE / "tests" / "stability"))
from small_meshes import brick  # noqa: E402

CELLS = 3  # along each side of the faces
SNAP = 1e-6  # of the program: a node this close to another, in cells, is paired with it as it stands


def struck(bench: Bench, shift: float = 0.0) -> list:
    """Two soft cubes of 1 m, the first thrown at the second; the nodes inside the second one's face lie
    `shift` beside those that they meet. [m]"""
    words = scenes.blocks((2.0, 3.0), young=1e7, time_step=1e-4, end_time=0.02)
    bench.folder.mkdir(parents=True, exist_ok=True)
    for name, start in (("one", -1), ("two", 0)):
        mesh = brick((start, 0, 0), (start + 1, 1, 1), (1, CELLS, CELLS))
        inside = (mesh.nodes[:, 1] > 0.1) & (mesh.nodes[:, 1] < 0.9)
        mesh.nodes[inside, 1] += shift if name == "two" else 0.0
        words[words.index(f"-{name}_mesh") + 1] = mesh.write(str(bench.folder / f"{name}-{shift:g}.msh"))
        words[words.index(f"-{name}_mesh_set") + 1] = "none"
    return words


def again(words: list, name: str, sides: tuple) -> list:
    """The scene with a further contact of its two faces."""
    words = list(words)
    words[words.index("-contacts") + 1] += f",{name}"
    return words + [f"-{name}_secondary", sides[0], f"-{name}_primary", sides[1], f"-{name}_gap", 0.001]


def contact_rows(bench: Bench) -> list:
    """The same pairs once more, from the other side, and on meshes that hardly differ."""
    once = bench.run(struck(bench), 1)
    faces = ("one:x_max", "two:x_min")
    twice = [("listed twice", again(struck(bench), "twin", faces), 0.0),
             ("listed twice, sides swapped", again(struck(bench), "twin", faces[::-1]), 0.0)]
    twice += [(f"both sides constrained, nodes {shift:g} m apart", [*struck(bench, shift), "-joint_passes", 2], shift)
              for shift in bench.choose((0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3),
                                        (0.0, 1e-9, 1e-5))]
    rows = []
    for case, words, shift in twice:
        snapped = shift if shift * CELLS < SNAP else 0.0
        alone, run = bench.run(words, 1), bench.run(words, 2)
        row = Row("contact rows", case, "motion and impulse of the pairs once, also on 2 ranks; residual of the "
                  "contact problem below 1e-9", "", run.end, limit=1e-9 + snapped)
        if run.runs and alone.runs:
            impacts, reference = run.summary["impacts"], once.summary["impacts"]
            row.measure = max(run.difference(once, "velocity", "displacement"),
                              run.difference(alone, "velocity", "displacement"),
                              abs(impacts["total_impulse"] / reference["total_impulse"] - 1),
                              impacts["complementarity_residual"])
            row.seen = f"{run.summary['contact_rows']} rows, {run.summary['coupled_rows']} of them coupled, " \
                       f"{impacts['total_impulse']:.9g} N s"
        rows.append(checked(row, run))
    return rows


SWEEPS = {"contact_rows": contact_rows}
