#!/usr/bin/python3
"""How the floor spectra change with the joint: runs the two small buildings at three gaps, prints impacts and largest
floor accelerations, and draws the spectra of the left roof.

    python/examples/gaps.py [FOLDER]

Cell by cell: where things are, a scene that differs from a file, runs, what they left as arrays, a figure.
"""

# %% Where things are. The package stands in the folder python, beside this one.
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "python"))
import pounding  # noqa: E402

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "results/gaps").absolute()
folder.mkdir(parents=True, exist_ok=True)

# %% A scene that takes what it does not say from another one, and records forces of the left building.
scene = pounding.write_scene(folder / "short.yaml", {
    "include": SOURCE / "petsc-options" / "new" / "two-buildings" / "two-buildings.yaml",
    "title": "Short motion, wide output",
    "end_time": 4.0,
    "motion": {"x": {"duration": 4.0, "envelope": [0.5, 3.0]}},
    "spectra": {"damping": [0.02, 0.05]},
    "forces": ["feet", "slabs"],
    "feet": {"structure": "left", "kind": "reactions"},
    "slabs": {"structure": "left", "kind": "shells", "group": "slabs"},
})

# %% One run per gap.
runs = {}
for gap in (0.005, 0.02, 0.06):
    runs[gap] = pounding.run(scene, folder / f"gap-{gap:g}", ranks=2, floor1_gap=gap, floor2_gap=gap)

# %% What they left: dictionaries of numpy arrays.
print("gap [m]  impacts  strongest [N s]  roof PSA at 3 Hz  at 100 Hz [m/s2]  base shear [kN]  N11 [kN/m]")
for gap, run in runs.items():
    frequency, acceleration = run.spectrum("left_roof", "x", damping=0.05)
    at = [acceleration[abs(frequency - wanted).argmin()] for wanted in (3, 100)]
    strongest = max(run.impacts["impulse"], default=0.0)
    shear = run.force("feet.Fx")[1]
    membrane = run.forces["peak"][(run.forces["item"] == "slabs") & (run.forces["component"] == "N11")]
    print(f"{gap:7g}  {len(run.impacts['impulse']):7d}  {strongest:15.1f}  {at[0]:16.2f}  {at[1]:16.2f}"
          f"  {abs(shear).max() / 1e3:15.1f}  {abs(membrane).max() / 1e3:10.1f}")
time, displacement = run.series("displacement", "left_roof", "x")
print(f"left roof without a neighbour near: {1e3 * abs(displacement).max():.1f} mm at most, at "
      f"{time[abs(displacement).argmax()]:.2f} s")

# %% A figure.
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

for gap, run in runs.items():
    plt.loglog(*run.spectrum("left_roof", "x", damping=0.05), label=f"joint of {1e3 * gap:g} mm")
plt.xlabel("frequency [Hz]")
plt.ylabel("pseudo-acceleration of the left roof [m/s²]")
plt.legend()
plt.grid(alpha=0.3)
plt.savefig(folder / "gaps.png", dpi=120)
print(f"see {folder / 'gaps.png'}")
