"""Shells that lie on the same nodes: the program has one there, of the stiffness and mass of all."""

from .model import SHELL, Material, Model, Property
from .plates import Layer, equal_plate, isotropic


def unstack(model: Model) -> None:
    """Makes one shell of those that have the same nodes and offsets."""
    at_nodes: dict = {}
    for at, element in enumerate(model.elements):
        if element.kind == SHELL:
            at_nodes.setdefault((frozenset(element.nodes), repr(element.arms)), []).append(at)
    gone: dict = {}  # place of an element -> that of the one that stands for it
    for places in at_nodes.values():
        own = [model.properties.get(model.elements[at].property) for at in places]
        if len(own) < 2 or any(one is None or one.material not in model.materials or not one.thickness > 0 for one in own):
            continue
        first = model.elements[places[0]]
        first.property = _together(model, [model.elements[at].property for at in places], own, first.place)
        first.added = sum(model.elements[at].added for at in places)
        gone |= dict.fromkeys(places[1:], places[0])
    if gone:
        model.said.append(f"shells on the nodes of others {len(gone)}: one each has the stiffness in plane and in bending, and the mass, of all")
        left = [at for at in range(len(model.elements)) if at not in gone]
        new = {at: count for count, at in enumerate(left)}
        model.elements = [model.elements[at] for at in left]
        model.element_sets = {name: sorted({new[gone.get(at, at)] for at in places}) for name, places in model.element_sets.items()}


def _together(model: Model, keys: list, own: list, place: str):
    """Key of the property that has what several have."""
    key = ("shells on each other", *keys)
    if key not in model.properties:
        materials = [model.materials[one.material] for one in own]
        planes = [isotropic(one.young, one.shear, one.poisson) for one in materials]
        if max(ratio for _, ratio in planes) - min(ratio for _, ratio in planes) > 1e-6:
            model.cards.lose("SHELLS OF DIFFERENT MATERIALS ON EACH OTHER", "a shell has one Poisson's ratio; allowed, the one that keeps the "
                             "stiffness in plane", place)
        layers = [Layer(plane, material.density, one.thickness) for (plane, _), material, one in zip(planes, materials, own)]
        bending = [sum(layer.stiffness[k] * layer.thickness**3 / 12 for layer in layers) for k in (0, 1)]
        young, poisson, density, thickness = equal_plate(layers, bending)
        name = " and ".join(dict.fromkeys(str(one.name) for one in own))
        model.materials[key] = Material(young, poisson, density, alpha=materials[0].alpha, beta=materials[0].beta, place=place)
        model.properties[key] = Property(name, key, thickness=thickness, added=sum(one.added for one in own), place=place)
    return key
