"""The antisymmetric mode of the slabs, Models A and B side by side."""

import numpy as np

from .style import WIDTH, plt, save

AMPLITUDE = 0.35  # of the largest displacement, drawn [m]
COLOURS = ("#9ECAE1", "#08519C")  # lower and upper faces


def _surface(axes, mode, height: float, colour: str) -> None:
    """One plane of nodes, displaced."""
    own = np.isclose(mode.nodes[:, 2], height, atol=1e-6)
    nodes, moved = mode.nodes[own], mode.nodes[own] + AMPLITUDE * mode.shape[own]
    order = np.lexsort((nodes[:, 0], np.round(nodes[:, 1], 6)))
    rows = len(set(np.round(nodes[:, 1], 6)))
    x, y, z = (moved[order, i].reshape(rows, -1) for i in range(3))
    axes.plot_wireframe(x, y, z, color=colour, lw=0.4)


def draw(modes: list, folder) -> list:
    if not modes:
        return []
    figure = plt.figure(figsize=(WIDTH, 4.4))
    for number, mode in enumerate(modes, start=1):
        axes = figure.add_subplot(1, len(modes), number, projection="3d")
        for height in mode.faces:
            _surface(axes, mode, height, COLOURS[height - np.floor(2 * height) / 2 > 0.1])
        dots = mode.nodes[mode.dots] + AMPLITUDE * mode.shape[mode.dots]
        axes.scatter(*dots.T, color="black", s=18, depthshade=False)
        axes.set_box_aspect((3.36, 2.28, 3.0))
        axes.view_init(elev=14, azim=-70)
        axes.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        axes.set_title(f"Model {mode.model}: {mode.frequency:.1f} Hz; along x {mode.at_dots:+.3f} at the dots, "
                       f"{mode.at_middle:+.3f} at mid-plane", fontsize=8)
    return save(figure, folder, "fig10_slab_mode.png", "Fig. 10: antisymmetric mode of the slabs",
                "Structure 1, largest displacement 1, amplified; black: accelerometers of floor 1. They lie "
                "on the upper face in Model A, which moves along x, on the mid-plane in Model B, which hardly does.")
