#!/usr/bin/python3
"""run/plot on a small result folder made here: figures, report, and errors."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

PLOT = Path(__file__).resolve().parents[2] / "run" / "plot"
sys.dont_write_bytecode = True
sys.path.insert(0, str(PLOT.parents[1] / "python"))
from pounding.plot import contact_figures, report, style  # noqa: E402
from pounding.plot.style import envelope  # noqa: E402
from pounding import results  # noqa: E402

PROBES = {"s1_floor1": ("s1", 2.72), "s1_floor2": ("s1", 5.22), "s2_floor1": ("s2", 2.72),
          "s2_floor2": ("s2", 5.22)}
CONTACTS = ("floor1", "floor2")
FIGURES = {"answer.png", "spectra.png", "spectra_2.png", "drifts.png", "accelerations_x.png", "accelerations_y.png",
           "accelerations_z.png", "ground_motion.png", "gap.png", "strongest_impact.png",
           "impacts.png", "energy.png", "loops.png"}
IMPACTS = ((0, 1.0, 4e-3, 30.0), (1, 1.5, 9e-3, 900.0), (1, 2.25, 6e-3, 260.0))


def make_history(path: Path, samples: int) -> None:
    random = np.random.default_rng(1)
    time = np.linspace(0, 4, samples)
    step = time[1]
    envelope_of = np.clip(time, 0, 1) * np.clip(4 - time, 0, 1)
    ground = envelope_of[:, None] * np.sin(
        2 * np.pi * np.outer(time, [3.0, 4.0, 7.0]) + np.cumsum(random.normal(size=3)))
    displacement, acceleration, channels = [], [], []
    for number, (name, (_, height)) in enumerate(PROBES.items()):
        for direction in range(3):
            omega = 2 * np.pi * (2.1 + number + 3 * direction)
            moved = 1e-3 * height**2 * envelope_of * np.sin(omega * time) / (1 + direction)
            felt = -omega**2 * moved
            if direction == 0:
                for contact, start, duration, impulse in IMPACTS:
                    if name.endswith(CONTACTS[contact]):
                        side = -1 if name.startswith("s1") else 1
                        during = (time >= start) & (time < start + duration)
                        ringing = np.exp(-30 * (time - start)) * np.sin(1256 * (time - start))
                        felt += side * impulse / duration / 4000 * during
                        felt += side * impulse / 40 * np.where(time > start, ringing, 0)
            displacement.append(moved)
            acceleration.append(felt)
            channels.append(f"{name}.{'xyz'[direction]}")
    gap = 0.02 * np.abs(np.cos(np.pi * np.outer(time, [1.0, 0.7]))) + 0.002
    force = np.zeros_like(gap)
    for contact, start, duration, impulse in IMPACTS:
        during = (time >= start) & (time <= start + duration)
        gap[during, contact] = 0
        force[during, contact] = impulse / duration
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = 1
        file.attrs["title"] = "Two <boxes> & a gap"
        file["time"] = time
        file["ground_acceleration"] = ground
        file["displacement"] = np.stack(displacement, 1)
        file["velocity"] = np.gradient(np.stack(displacement, 1), step, axis=0)
        file["acceleration"] = np.stack(acceleration, 1)
        for name in ("velocity", "acceleration"):
            file[name].attrs["time_offset"] = -step / 2
        file["channels"] = np.array(channels, dtype="S32")
        file["contacts"] = np.array(CONTACTS, dtype="S32")
        file["gap"] = gap
        file["contact_force"] = force
        turn = 2 * np.pi * time
        file["links"] = np.array(["s1:pads.7.x", "s1:pads.7.rz", "floor1.1"], dtype="S32")
        file["link_elongation"] = 0.01 * np.stack([np.sin(turn), np.cos(turn), np.sin(3 * turn)], 1)
        file["link_force"] = 1e4 * np.stack([np.cos(turn), np.sin(turn), np.clip(np.sin(3 * turn), 0, 1)], 1)


def make_summary(path: Path) -> None:
    modes = [{"frequency": 2.09, "direction": "x", "effective_mass": 7500.0},
             {"frequency": 6.14, "direction": "y", "effective_mass": 7600.0},
             {"frequency": 8.55, "direction": "rotation z", "effective_mass": 0.0}]
    structure = {"dofs": 8052, "elements": {"hex8": 1064, "beam": 284}, "mass": 9198.6,
                 "frequencies": modes, "omega_max": 1.757e5, "stable_time_step": 4.39e-6}
    path.write_text(json.dumps({
        "schema": 1, "title": "Two <boxes> & a gap", "version": "0.1.0", "ranks": 2, "steps": 1574803,
        "time_step": 2.54e-6, "end_time": 4.0, "wall_time": 61.2, "microseconds_per_step": 25.1,
        "structures": {"s1": structure, "s2": {**structure, "dofs": 5532}},
        "energy": {"relative_residual": 1e-13, "damping": -5.1, "contact": -1.1, "input": 40.0},
        "impacts": {"episodes": 3, "total_impulse": 1190.0, "largest_impulse": 900.0,
                    "max_penetration": 1e-6, "floor1": {"episodes": 1, "total_impulse": 30.0},
                    "floor2": {"episodes": 2, "total_impulse": 1160.0}},
        "drifts": [{"structure": one, "upper": f"{one}_floor{level}", "lower": "base" if level == 1 else f"{one}_floor1",
                    "height": 2.72 if level == 1 else 2.5, "peak": [0.01, 0.002], "time": [1.0, 2.0]}
                   for one in ("s1", "s2") for level in (1, 2)],
        "probes": {name: {"structure": owner, "position": [1.0, 1.14, height],
                          "peak_acceleration": [9.1, None, 1.0],
                          "peak_displacement": [0.02, 0.01, 0.0001]}
                   for name, (owner, height) in PROBES.items()}}))


def make_folder(folder: Path, samples: int = 20001) -> None:
    make_history(folder / "history.h5", samples)
    make_summary(folder / "summary.json")
    frequency = np.geomspace(0.5, 400, 120)
    lines = ["# comment", "probe,direction,damping,frequency,period,displacement,pseudo_velocity,"
             "pseudo_acceleration"]
    for number, name in enumerate(PROBES):
        for scale, direction in zip((1.0, 0.5, 0.2), "xyz"):
            value = scale * (1 + 8 / (1 + 20 * np.log(frequency / (2 + number)) ** 2)
                             + 5 / (1 + 4 * np.log(frequency / 180) ** 2))
            for f, a in zip(frequency, value):
                omega = 2 * np.pi * f
                lines.append(f"{name},{direction},0.05,{f},{1 / f},{a / omega**2},{a / omega},{a}")
    (folder / "spectra.csv").write_text("\n".join(lines) + "\n")
    lines = ["# comment", "contact,start,end,duration,impulse,peak_force,points,energy_lost,"
             "max_penetration,lateral,vertical"]
    for contact, start, duration, impulse in IMPACTS:
        lines.append(f"{CONTACTS[contact]},{start},{start + duration},{duration},{impulse},"
                     f"{2 * impulse / duration},20,{impulse / 100},1e-7,1.1,5.1")
    (folder / "impacts.csv").write_text("\n".join(lines) + "\n")
    time = np.linspace(0, 4, 2000)
    work = 40 * np.clip(time / 4, 0, 1)
    lines = ["# comment", "time,kinetic,strain,damping_loss,contact_work,input_work,residual"]
    for t, w in zip(time, work):
        phase = np.sin(13 * t) ** 2
        lines.append(f"{t},{0.5 * w * phase},{0.5 * w * (1 - phase)},{-0.4 * w},{-0.1 * w},{w},"
                     f"{1e-13 * w * np.sin(90 * t)}")
    (folder / "energy.csv").write_text("\n".join(lines) + "\n")


def drawn_by(draw, module, result):
    """The figure that a function hands over to be written."""
    with mock.patch.object(module, "save", side_effect=lambda figure, *_, **__: [figure]):
        return draw(result)[0]


def plot(*words):
    return subprocess.run([PLOT, *words], capture_output=True, text=True, timeout=300)


class PlotTest(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = Path(self.place.name)

    def test_a_full_result_folder_gives_every_figure_and_a_self_contained_report(self):
        make_folder(self.folder)
        done = plot(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({file.name for file in self.folder.glob("*.png")}, FIGURES)
        for name in FIGURES:
            image = (self.folder / name).read_bytes()
            self.assertTrue(image.startswith(b"\x89PNG"), name)
            self.assertGreater(len(image), 10000, name)
        page = (self.folder / "report.html").read_text()
        self.assertEqual(page.count("<figure>"), len(FIGURES))
        panels = [figure.count("data:image/png;base64,") for figure in page.split("<figure>")[1:]]
        self.assertEqual(sorted(set(panels)), [1, 2, 4])  # of three columns the legend is a picture of its own
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["'](?!data:|#)""", page), [])
        self.assertTrue("http" not in page)
        self.assertTrue("<h1>Two &lt;boxes&gt; &amp; a gap</h1>" in page)
        for expected in ("2.09", "9199", "8\u202f052", "900", "1 × 10⁻¹³", "2.54 × 10⁻⁶"):
            self.assertTrue(expected in page, expected)

    def test_where_they_hit_has_every_pair_every_point_hit_and_the_outlines(self):
        make_folder(self.folder, 2001)
        lines = ["contact,x,y,z,impulse"]
        lines += [f"floor2,2.0,{0.4 * i},5.22,{10.0 * i if i in (1, 4, 5) else 0.0}" for i in range(7)]
        (self.folder / "contact_points.csv").write_text("\n".join(lines) + "\n")
        summary = json.loads((self.folder / "summary.json").read_text())
        summary["contacts"] = {name: {"normal": [1, 0, 0]} for name in CONTACTS}
        summary["structures"]["s1"]["extent"] = [[0, 0, 0], [2, 2.4, 5.22]]
        (self.folder / "summary.json").write_text(json.dumps(summary))
        drawn = drawn_by(contact_figures.impact_places, contact_figures, results.load(self.folder))
        elevation, plan = drawn.axes
        self.assertEqual([axes.get_title("left") for axes in drawn.axes], ["On the faces, along y and z", "In plan"])
        for axes, column in ((elevation, 0), (plan, 1)):
            pairs, hit = axes.collections[-2:]
            np.testing.assert_allclose(pairs.get_offsets()[:, column], 0.4 * np.arange(7))
            np.testing.assert_allclose(hit.get_offsets()[:, column], [0.4, 1.6, 2.0])
            self.assertEqual([patch.get_bbox().bounds for patch in axes.patches],
                             [(0, 0, 2.4, 5.22) if axes is elevation else (0, 0, 2, 2.4)])
        np.testing.assert_allclose(np.diff(hit.get_sizes()) / np.diff(hit.get_sizes())[1], [3, 1])  # areas by impulse
        self.assertIn("floor2: 2 impacts, 100 N s, 3 of 7 points", [text.get_text() for text in elevation.get_legend().texts])

    def test_the_strongest_impact_has_the_force_over_the_stated_time_and_the_nearest_probes(self):
        make_folder(self.folder)
        summary = json.loads((self.folder / "summary.json").read_text())
        summary["impacts"]["force_window"] = 2e-3
        summary["contacts"] = {name: {"normal": [0, 1, 0]} for name in CONTACTS}
        (self.folder / "summary.json").write_text(json.dumps(summary))
        (self.folder / "contact_points.csv").write_text("contact,x,y,z,impulse\nfloor2,1.1,1.14,5.1,900\n")
        gap, force, felt = drawn_by(contact_figures.strongest_impact, contact_figures, results.load(self.folder)).axes
        self.assertIn("2 ms", force.get_ylabel())
        self.assertIn("acceleration y", felt.get_ylabel())  # across the joint
        self.assertEqual([line.get_label() for line in felt.lines], ["s1_floor2", "s2_floor2"])
        time, values = force.lines[CONTACTS.index("floor2")].get_data()
        flat = values[(time > 2) & (time < 7)]
        np.testing.assert_allclose(flat, 100, rtol=1e-12)  # 900 N s in 9 ms
        self.assertAlmostEqual(values[np.abs(time - 0.0).argmin()], 50, delta=11)  # half of the time lies before it; a sample is 10

    def test_floors_at_rest_are_drawn_and_told(self):
        make_folder(self.folder, 2001)
        lines = (self.folder / "spectra.csv").read_text().splitlines()
        rest = [",".join([*line.split(",")[:5], "0,0,0"]) for line in lines[2:]]
        (self.folder / "spectra.csv").write_text("\n".join([*lines[:2], *rest]) + "\n")
        told = []
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            report.write(results.load(self.folder), "", told.append)
        self.assertEqual(told[:2], ["picture", "gaps"])
        self.assertIn("energy_balance", told)
        self.assertTrue((self.folder / "answer.png").exists())

    def test_what_an_interrupted_run_lacks_is_skipped_with_a_word(self):
        make_folder(self.folder, 2001)
        for name in ("energy.csv", "spectra.csv", "impacts.csv", "summary.json"):
            (self.folder / name).unlink()
        (self.folder / "resolved.yaml").write_text('end_time: "15"\n')
        done = plot(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("The run stopped at 4.0 of 15 s: what is shown ends there.", done.stdout)
        self.assertIn("stopped at 4.0 of 15 s", (self.folder / "report.html").read_text())
        self.assertIn("energy_balance skipped: no energy.csv", done.stdout)
        self.assertIn("response_spectra skipped: no spectra.csv", done.stdout)
        self.assertIn("impact_catalogue skipped: no impacts.csv", done.stdout)
        made = {file.name for file in self.folder.glob("*.png")}
        self.assertEqual(made, {"gap.png", "ground_motion.png", "accelerations_x.png",
                                "accelerations_y.png", "accelerations_z.png", "loops.png"})

    def test_a_run_without_impacts_nor_contacts_is_drawn(self):
        make_folder(self.folder, 2001)
        header = (self.folder / "impacts.csv").read_text().splitlines()[:2]
        (self.folder / "impacts.csv").write_text("\n".join(header) + "\n")
        lines = (self.folder / "spectra.csv").read_text().splitlines()
        (self.folder / "spectra.csv").write_text("\n".join([*lines[:2], *(line for line in lines if line.startswith("s1_floor1,x"))]) + "\n")
        (self.folder / "energy.csv").unlink()
        with h5py.File(self.folder / "history.h5", "a") as file:
            for name in ("gap", "contact_force", "contacts", "links", "link_elongation", "link_force"):
                del file[name]
        count, skipped, page = report.write(results.load(self.folder), "", lambda name: None)
        self.assertGreater(count, 3)
        self.assertTrue(any("impact_catalogue skipped: no impact" in line for line in skipped), skipped)
        self.assertFalse((self.folder / "gap.png").exists())
        self.assertTrue(page.exists())

    def refused(self, *words):
        done = plot(*words)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        return done.stderr

    def unreadable(self):
        with self.assertRaises(results.ResultError) as caught:
            results.load(self.folder)
        self.assertEqual(len(str(caught.exception).splitlines()), 1)
        return str(caught.exception)

    def test_a_missing_or_empty_folder_is_refused_in_one_line(self):
        self.assertIn("is not a folder", self.refused(self.folder / "nowhere"))
        self.assertIn("holds no results", self.refused(self.folder))

    def test_files_of_another_schema_are_refused_in_one_line(self):
        make_folder(self.folder, 2001)
        summary = self.folder / "summary.json"
        text = summary.read_text()
        summary.write_text(text.replace('"schema": 1', '"schema": 2'))
        self.assertIn("summary.json cannot be read: it is of schema 2, this version reads schema 1: read it with",
                      self.unreadable())
        summary.write_text(text.replace('"schema": 1, ', ''))
        self.assertIn("it has no schema number, so an earlier version wrote it", self.unreadable())
        summary.write_text(text)
        with h5py.File(self.folder / "history.h5", "r+") as file:
            file.attrs["schema"] = 7
        self.assertIn("history.h5 cannot be read: it is of schema 7", self.unreadable())

    def test_a_broken_file_is_refused_by_name(self):
        (self.folder / "summary.json").write_text('{"title": ')
        self.assertIn("summary.json cannot be read", self.refused(self.folder))
        (self.folder / "summary.json").unlink()
        (self.folder / "energy.csv").write_text("time,kinetic\n0,1\n")
        self.assertIn("energy.csv cannot be read: no column strain", self.unreadable())
        (self.folder / "energy.csv").unlink()
        (self.folder / "history.h5").write_text("not HDF5")
        self.assertIn("history.h5 cannot be read", self.unreadable())


class LogScaleTest(unittest.TestCase):
    def test_labels_never_lie_over_each_other(self):
        """In half a figure, of one impact, of a decade's parts and of decades; two at least are there to read."""
        for values in ([1142.4], [2.3], [0.9, 9.0], [900, 8900], [1142, 1180], [300, 700], [40, 110], [1.0, 5e4]):
            figure, (_, axes) = style.plt.subplots(1, 2, figsize=(style.WIDTH, 3.6))
            axes.plot(values, values, "o")
            for which in "xy":
                style.log_scale(axes, which, values)
            figure.canvas.draw()
            for axis, low, high in ((axes.xaxis, "x0", "x1"), (axes.yaxis, "y0", "y1")):
                least, most = axis.get_view_interval()
                boxes = [tick.label1.get_window_extent() for tick in axis.get_major_ticks() + axis.get_minor_ticks()
                         if tick.label1.get_text() and least <= tick.get_loc() <= most]
                ends = sorted((getattr(box, low), getattr(box, high)) for box in boxes)
                self.assertGreaterEqual(len(ends), 2, values)
                for one, other in zip(ends, ends[1:]):
                    self.assertLessEqual(one[1], other[0], (values, axis.axis_name))
            style.plt.close(figure)


class EnvelopeTest(unittest.TestCase):
    def test_drawing_a_long_series_keeps_single_sample_peaks_in_place(self):
        time = np.linspace(0, 25, 500_003)
        values = np.sin(time)
        values[[123_456, 499_999, 500_002]] = 50, -40, 30
        drawn_time, drawn = envelope(time, values)
        self.assertLess(len(drawn), 10_000)
        self.assertTrue(np.all(np.diff(drawn_time) > 0))
        for index in (123_456, 499_999, 500_002):
            self.assertIn((time[index], values[index]), set(zip(drawn_time, drawn)))

    def test_a_short_series_is_drawn_as_it_is(self):
        time = np.arange(100.0)
        self.assertTrue(np.array_equal(envelope(time, time**2)[1], time**2))


if __name__ == "__main__":
    unittest.main()
