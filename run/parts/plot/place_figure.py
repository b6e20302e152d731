"""Where the buildings hit, and how hard: each impact at its place, in elevation and in plan."""

import numpy as np

from pounding.results import DIRECTIONS, Missing, Result
from . import scene_mesh
from .markup import readable
from .style import WIDTH, contact_colour, plt, save


def _axes_of(contact: dict) -> tuple:
    """The axis of the normal, and the two along the face in their order."""
    normal = int(np.argmax(np.abs(contact["normal"])))
    return normal, [axis for axis in range(3) if axis != normal]


def _parts(result: Result) -> list:
    try:
        return scene_mesh.load(result.folder)[1]
    except Missing:
        return []


def _areas(impulse: np.ndarray, largest: float) -> np.ndarray:
    """Of circles [points squared], in proportion to the impulse."""
    return 12 + 900 * impulse / largest


def impact_places(result: Result) -> list:
    impacts, contacts = result.impacts, result.summary.get("contacts", {})
    if not impacts or len(impacts["start"]) == 0:
        raise Missing("no impact" if impacts else "no impacts.csv")
    if "lateral" not in impacts or not contacts:
        raise Missing("impacts.csv has no places, or summary.json no contacts")
    names = [name for name in contacts if (impacts["contact"].astype(str) == name).any()]
    parts, largest = _parts(result), impacts["impulse"].max()
    figure, (elevation, plan) = plt.subplots(1, 2, figsize=(WIDTH, 4.2))
    for part in parts:  # nodes of the faces that may touch
        for first, second in sorted({tuple(_axes_of(contacts[name])[1]) for name in names}):
            elevation.scatter(part.points[:, first], part.points[:, second], s=0.3, color="#CCCCCC", zorder=0)
        for name in names:
            nodes = part.points[part.contacts.get(name, [])]
            _, (first, second) = _axes_of(contacts[name])
            elevation.scatter(nodes[:, first], nodes[:, second], s=3, color="#999999", zorder=1)
        plan.scatter(*part.points[:, :2].T, s=0.3, color="#CCCCCC", zorder=1)
    labels = set()
    for name in names:
        own = impacts["contact"].astype(str) == name
        normal, along = _axes_of(contacts[name])
        labels.add(tuple(DIRECTIONS[axis] for axis in along))
        colour = contact_colour(result.contacts, name)
        sizes = _areas(impacts["impulse"][own], largest)
        total = impacts["impulse"][own].sum()
        elevation.scatter(impacts["lateral"][own], impacts["vertical"][own], s=sizes, color=colour, alpha=0.35,
                          edgecolor=colour, zorder=2, label=f"{name}: {own.sum()}, {readable(total)} N s")
        faces = [part.points[part.contacts[name]] for part in parts if name in part.contacts]
        if normal == 2 or not faces:
            continue
        place = np.zeros((own.sum(), 3))
        place[:, normal] = np.concatenate(faces)[:, normal].mean()
        place[:, along[0]], place[:, along[1]] = impacts["lateral"][own], impacts["vertical"][own]
        plan.scatter(place[:, 0], place[:, 1], s=sizes, color=colour, alpha=0.35, edgecolor=colour, zorder=2)
    first, second = (" or ".join(sorted({pair[i] for pair in labels})) for i in range(2))
    elevation.set(title="On the faces", xlabel=f"{first} [m]", ylabel=f"{second} [m]")
    elevation.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), markerscale=0.3)
    plan.set(title="In plan", xlabel="x [m]", ylabel="y [m]")
    if not parts:  # no mesh in the folder
        plan.remove()
    for axes in (elevation, plan) if parts else (elevation,):
        axes.set_aspect("equal", "datalim")
    return save(figure, result.folder, "impact_places.png", "Where they hit",
                "Each impact at the mean place of its impulses, the area of its circle in proportion to its impulse; "
                f"the largest is {readable(largest)} N s. Grey: nodes.")


ALL = [impact_places]
