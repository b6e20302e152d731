"""Cells of second order, read by their corners, and what becomes of their mid-side nodes: the same for all formats."""

from itertools import combinations

from .geometry import difference, length, scaled, sum_of
from .model import BAR, BEAMS, InputFault, Model, PointMass, Spring

WHY = {"line": "a line of second order is read by its two ends: its mid-side node goes, the mass lies at the ends",
       "tet4": "cells of second order are read by their corners: mid-side nodes go, the mass lies at the corners, and "
               "tetrahedra are far stiffer in bending, so that a finer mesh or bricks are needed where they bend",
       "": "cells of second order are read by their corners: mid-side nodes go, curved edges become straight, the mass "
           "lies at the corners, and the mesh is stiffer in bending"}


def by_corners(model: Model, card: str, kind: str, nodes, corners, place: str) -> tuple:
    """The nodes of a cell at its corners, which are places in `nodes` or their number; the cell is a loss by the name of
    its card, which may be allowed."""
    places = range(corners) if isinstance(corners, int) else corners
    family = "line" if kind in (*BEAMS, BAR) else kind if kind == "tet4" else ""
    model.cards.lose(card, WHY[family], place)
    found = tuple(nodes[k] for k in places)
    for node in set(nodes) - set(found) - {0}:
        model.midside.setdefault(node, (found, place))
    return found


def _edge(model: Model, node: int) -> tuple:
    """The two corners between which a mid-side node lies."""
    corners, place = model.midside[node]
    x = model.at(node, place)
    pairs = combinations(sorted(set(corners)), 2)
    return min(pairs, key=lambda pair: length(difference(
        x, scaled(sum_of(model.at(pair[0], place), model.at(pair[1], place)), 0.5))))


def settle(model: Model) -> None:
    """Mid-side nodes go, with what lies on them: masses and springs to the ground by halves to the two corners beside;
    all else that needs them is a loss by its name."""
    if not model.midside:
        return
    cards = model.cards
    for node, (_, place) in model.midside.items():
        model.at(node, place)
    corners = {node for element in model.elements for node in element.nodes}
    others = {node for spring in (*model.springs, *model.axial_springs) if len(spring.nodes) > 1
              for node in spring.nodes}
    for node in sorted(set(model.midside) & (corners | others)):
        cards.lose("MID-SIDE NODES THAT OTHERS USE", "an element or a spring hangs on the mid-side node of another "
                   "element; allowed, it hangs there on nothing", f"{model.midside[node][1]}, node {node}")
    gone = set(model.midside) - corners - others
    _halve(model, gone)
    for node in sorted(gone & set(model.supports)):
        held = model.supports.pop(node)
        if any(held & ~model.supports.get(one, 0) for one in _edge(model, node)):
            cards.lose("SUPPORTS OF MID-SIDE NODES", "a mid-side node is held where the corners beside it are not; "
                       "allowed, it is not held", f"{model.midside[node][1]}, node {node}")
    for name, nodes, place in model.rigid:
        if set(nodes) & gone and len(set(nodes) - gone) < 2:
            cards.lose("RIGID BODIES OF MID-SIDE NODES", f"'{name}' has mid-side nodes alone", place)
    model.rigid = [(name, [node for node in nodes if node not in gone], place) for name, nodes, place in model.rigid]
    for name, hub, nodes, components, card, place in model.in_part:
        if gone & {hub, *nodes}:
            cards.lose("RIGID BODIES OF MID-SIDE NODES", f"'{name}' has mid-side nodes", place)
    model.in_part = [one for one in model.in_part if not gone & {one[1], *one[2]}]
    for nodes, place in model.pins:
        if len(nodes - gone) == 1:
            cards.lose("PINS OF MID-SIDE NODES", "a mid-side node shares its displacements with another node", place)
    model.pins = [(nodes - gone, place) for nodes, place in model.pins]
    empty = sorted(name for name, nodes in model.node_sets.items() if nodes and set(nodes) <= gone)
    if empty:
        model.said.append(f"sets of mid-side nodes alone are no groups: {', '.join(empty)}")
    for one, other in model.ties:
        if one in empty:
            cards.lose("TIES OF MID-SIDE NODES", f"'{one}', tied to '{other}', has mid-side nodes alone", "the file")


def _halve(model: Model, gone: set) -> None:
    masses = [mass for mass in model.masses if mass.node in gone]
    springs = [spring for spring in model.springs if len(spring.nodes) == 1 and spring.nodes[0] in gone]
    for mass in masses:
        if mass.arm or any(mass.inertia):
            raise InputFault(f"{mass.place}: a mass with rotary inertia or an arm on the mid-side node {mass.node}")
        model.masses += [PointMass(node, mass.mass / 2, name=mass.name, place=mass.place)
                         for node in _edge(model, mass.node)]
    for spring in springs:
        model.springs += [Spring((node,), scaled(spring.stiffness, 0.5), scaled(spring.dashpot, 0.5), spring.name,
                                 spring.place) for node in _edge(model, spring.nodes[0])]
    if masses or springs:
        nodes = {mass.node for mass in masses} | {spring.nodes[0] for spring in springs}
        model.said.append(f"masses and springs of {len(nodes)} mid-side nodes: half to each corner beside")
        model.masses = [mass for mass in model.masses if mass.node not in gone]
        left = {id(spring) for spring in springs}
        model.springs = [spring for spring in model.springs if id(spring) not in left]
