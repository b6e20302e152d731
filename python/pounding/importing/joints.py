"""Nodes that move together: arms of elements and masses, hinges, rigid bodies, pins, and supports that reach them."""

from collections import Counter

import numpy as np
from scipy.cluster.hierarchy import DisjointSet
from scipy.spatial import cKDTree

from .geometry import global_components, length, sum_of
from .model import ALL, BEAMS, SHELL, TRANSLATIONS, Model, Reading

NEAR = 1e-9  # of the model's size: nodes that coincide


class Sets(DisjointSet):
    """Disjoint sets of nodes."""

    def root(self, node):
        self.add(node)
        return self[node]

    def join(self, nodes) -> None:
        nodes = list(nodes)
        for node in nodes:
            self.add(node)
            self.merge(nodes[0], node)

    def all(self) -> list:
        """Those of two nodes or more, sorted."""
        return sorted(sorted(nodes) for nodes in self.subsets() if len(nodes) > 1)


def turning_nodes(model: Model) -> set:
    """Nodes whose rotations an element holds."""
    return {node for element in model.elements if element.kind in (SHELL, *BEAMS) for node in element.nodes}


class Shared(Reading):
    """Nodes that share components, each told by a card: rigid bodies or pins once all cards are known, or lost. `used`:
    whether the cards that are kept have been counted before."""

    def __init__(self, model: Model, name: str, card: str, why: str, used: bool = False):
        super().__init__(model)
        self.name, self.card, self.why, self.used = name, card, why, used
        self.found: dict = {}  # nodes -> [components, place, cards]

    def add(self, nodes, components: int, place: str) -> None:
        held = self.found.setdefault(frozenset(nodes), [0, place, 0])
        held[0] |= components
        held[2] += 1

    def finish(self) -> None:
        turning = turning_nodes(self.model)
        for nodes, (components, place, count) in self.found.items():
            if components == ALL:
                self.model.rigid.append((self.name, sorted(nodes), place))
            elif components & TRANSLATIONS == TRANSLATIONS and (components == TRANSLATIONS or not turning & nodes):
                self.model.pins.append((set(nodes), place))
            else:
                self.lose(self.card, self.why, place, count)
                continue
            if not self.used:
                self.use(self.card, count)


def hold_turned(model: Model, node: int, components: int, axes, card: str, place: str) -> bool:
    """Components in axes of the node's own, those of the space where it has none. False where they are lost."""
    held = components if axes is None else global_components(components, axes)
    if held is None:
        return model.cards.lose(card, "supports hold along the global axes", place)
    model.hold(node, held)
    return True


def is_whole(components: int, followers, turning: set) -> bool:
    """Whether followers are held by these components as by all: where nothing turns, translations do."""
    return components == ALL or (components & TRANSLATIONS == TRANSLATIONS and not turning & set(followers))


def follow_in_part(model: Model, name: str, hub: int, nodes, components: int, axes_of, card: str, place: str) -> None:
    """Nodes follow a hub in components along axes of their own, those of the space where `axes_of` them is None. Counted
    once it is known what else moves with them."""
    found = {components if axes_of(node) is None else global_components(components, axes_of(node)) for node in nodes}
    if len(found) == 1 and None not in found:
        model.in_part.append((name, hub, list(nodes), found.pop(), card, place))
    else:
        model.cards.lose(card, "components of nodes that follow a body are along the global axes", place)


class Joints:
    """Gives elements nodes of their own where they end on arms or turn on their own, and finds what the scene has to
    say: `rigid` (name, nodes), `joined` (satellite -> root), `pins` (sets of nodes). Changes the model's elements."""

    def __init__(self, model: Model):
        self.model = model
        self.satellites: dict = {}  # (root, arm) -> node
        self.joined: dict = {}  # satellite -> root
        self.hinges: list = []
        self.rigid: list = []
        self.pins: list = []
        self.next = max(model.nodes, default=0) + 1
        places = np.array(list(model.nodes.values()) or [(0, 0, 0)])
        self.near = NEAR * max(float(np.linalg.norm(places.max(axis=0) - places.min(axis=0))), 1e-30)
        self._give_arms()
        self._give_hinges()
        self.used = self._used()
        self._find_bodies()
        self._find_pins()

    def _new(self, place) -> int:
        self.model.nodes[self.next] = tuple(map(float, place))
        self.next += 1
        return self.next - 1

    def _end(self, node: int, arm) -> int:
        """The node at the end of an arm."""
        if arm is None or length(arm) <= self.near:
            return node
        key = node, tuple(round(value / self.near) for value in arm)
        if key not in self.satellites:
            self.satellites[key] = self._new(sum_of(self.model.nodes[node], arm))
            self.joined[self.satellites[key]] = node
        return self.satellites[key]

    def _give_arms(self) -> None:
        for element in self.model.elements:
            if element.arms:
                element.nodes = tuple(self._end(node, arm) for node, arm in zip(element.nodes, element.arms))
                element.arms = None
        for mass in self.model.masses:
            mass.node, mass.arm = self._end(mass.node, mass.arm), None

    def _give_hinges(self) -> None:
        """A beam hinged at both ends carries along its axis alone: a bar. One hinged at an end gets a node of its own
        there, unless nothing else turns with the one that is there."""
        turning = {node for _, nodes, _ in self.model.rigid for node in nodes} | set(self.joined) | set(
            self.joined.values())
        turning |= {mass.node for mass in self.model.masses if any(mass.inertia)}
        turning |= {node for spring in self.model.springs if any(spring.stiffness[3:]) for node in spring.nodes}
        turning |= {node for nodes, _ in self.model.pins for node in nodes}
        for element in self.model.elements:
            if element.kind in BEAMS and all(element.hinged):
                element.kind, element.z_axis = "bar", None
            elif element.kind == SHELL or element.kind in BEAMS:
                turning |= {node for k,
                            node in enumerate(element.nodes) if element.kind == SHELL or not element.hinged[k]}
        for element in self.model.elements:
            if element.kind in BEAMS and any(element.hinged):
                at = element.hinged.index(True)
                node = element.nodes[at]
                if node in turning:
                    own = self._new(self.model.nodes[node])
                    self.hinges.append(({node, own}, element.place))
                    element.nodes = tuple(own if k == at else other for k, other in enumerate(element.nodes))
                turning.add(node)

    def _used(self) -> set:
        used = {node for element in self.model.elements for node in element.nodes}
        used |= {mass.node for mass in self.model.masses}
        for spring in (*self.model.springs, *self.model.axial_springs):
            used |= set(spring.nodes)
        return used

    def _rank(self, nodes) -> int:
        """Of the six motions of a body, those that supports of its nodes take."""
        origin, rows = np.array(self.model.nodes[nodes[0]]), []
        for node in nodes:
            x, y, z = np.array(self.model.nodes[node]) - origin
            motion = np.array([(1, 0, 0, 0, z, -y), (0, 1, 0, -z, 0, x), (0, 0, 1, y, -x, 0), (0, 0, 0, 1, 0, 0),
                               (0, 0, 0, 0, 1, 0), (0, 0, 0, 0, 0, 1)], dtype=float)
            rows += [motion[k] for k in range(6) if self.model.supports.get(node, 0) >> k & 1]
        return int(np.linalg.matrix_rank(np.array(rows))) if rows else 0

    def _find_bodies(self) -> None:
        sets, names = Sets(), {}
        for name, nodes, _ in self.model.rigid:
            sets.join(nodes)
            for node in nodes:
                names.setdefault(node, name)
        for satellite, root in self.joined.items():
            sets.join((satellite, root))
        hubs = self._find_hubs(sets)
        plain = {}
        self.following: set = set()  # nodes of bodies, also such as no element uses
        for nodes in sets.all():
            own = [node for node in nodes if node in self.used]
            held = self._rank(nodes)
            if held == 6:
                for node in nodes:
                    self.model.hold(node, ALL)
                continue
            self.following |= set(nodes)
            if sets.root(nodes[0]) in hubs:
                continue
            if held:
                first = next(node for node in nodes if self.model.supports.get(node, 0))
                self.model.cards.lose("SUPPORT OF A RIGID BODY", "a rigid body, or a node with rigid arms, is clamped "
                                                                 "as a whole or not at all", f"node {first}")
            elif len(own) > 1:
                name = next((names[node] for node in nodes if node in names), None)
                roots = {self.joined[node] for node in own if node in self.joined}
                if name is None and len(roots) == 1:
                    plain[roots.pop()] = own
                else:
                    self.rigid.append((name or "arms", own))
        for nodes in hubs.values():
            self.following |= set(nodes)
        self._join(plain)

    def _find_hubs(self, sets: Sets) -> dict:
        """Bodies that some nodes follow in part of their components, as `in_part`: name, the hub's own nodes, those that
        follow, components. Returns all nodes of each by the root of its hub."""
        members = {sets.root(nodes[0]): nodes for nodes in sets.all()}
        cards: dict = {}  # (hub, components, card) -> name, followers, place, count
        for name, hub, nodes, components, card, place in self.model.in_part:
            one = cards.setdefault((hub, components, card), [name, set(), place, 0])
            one[1] |= set(nodes)
            one[3] += 1
        following = Counter(node for _, nodes, *_ in cards.values() for node in nodes)
        following.update(dict.fromkeys((hub for hub, *_ in cards), 1))
        self.in_part, hubs = [], {}
        for (hub, components, card), (name, nodes, place, count) in cards.items():
            root, followers = sets.root(hub), sorted(nodes)
            body = members.get(root, [hub])
            held = self._rank(body)
            alone = all(following[node] == 1 and sets.root(node) not in members for node in followers)
            if held == 6:
                for node in followers:
                    self.model.hold(node, components)
            elif held or not alone or root in hubs or any(self.model.supports.get(node, 0) & components for node in followers):
                self.model.cards.lose(card, "of a body that is followed in part no node is held, and a node follows one", place, count)
                continue
            else:
                hubs[root] = [*body, *followers]
                own = [[node for node in part if node in self.used] for part in (body, followers)]
                if own[1] and len(own[0] + own[1]) > 1:
                    self.in_part.append((name, *own, components))
            self.model.cards.use(card, count)
        return hubs

    def _join(self, plain: dict) -> None:
        """Arms whose own root is the nearest of all become one `join`, others rigid bodies of their own."""
        # Roots that only carry satellites have no node in the mesh; their arms hang on each other.
        rooted = {root: nodes for root, nodes in plain.items() if root in nodes}
        self.rigid += [("arms", nodes) for root, nodes in plain.items() if root not in rooted]
        roots = list(rooted)
        if roots:
            tree = cKDTree([self.model.nodes[root] for root in roots])
            clear = {}
            for root in roots:
                for node in rooted[root]:
                    if node != root:
                        found, at = tree.query(self.model.nodes[node], k=min(2, len(roots)))
                        alone = len(roots) == 1 or np.atleast_1d(found)[1] > np.atleast_1d(found)[0] + 10 * self.near
                        clear[root] = clear.get(root, True) and alone and roots[int(np.atleast_1d(at)[0])] == root
            # With fewer roots the nearest stays the nearest.
            self.rigid += [("arms", rooted[root]) for root in roots if not clear[root]]
            self.joined = {node: root for root in roots if clear[root] for node in rooted[root] if node != root}
        else:
            self.joined = {}

    def _find_pins(self) -> None:
        sets, places = Sets(), {}
        for nodes, place in (*self.hinges, *self.model.pins):
            sets.join(nodes)
            places.update(dict.fromkeys(nodes, place))
        for nodes in sets.all():
            place = places[nodes[0]]
            own = [node for node in nodes if node in self.used]
            held = 0
            for node in nodes:
                held |= self.model.supports.get(node, 0) & TRANSLATIONS
            apart = max(length(tuple(a - b for a, b in zip(self.model.nodes[node], self.model.nodes[nodes[0]])))
                        for node in nodes)
            if apart > 10 * self.near:
                self.model.cards.lose("PIN", "nodes that share their displacements have to coincide", place)
            elif held == TRANSLATIONS:
                for node in own:
                    self.model.hold(node, TRANSLATIONS)
            elif held:
                self.model.cards.lose("HINGE AT A SUPPORT",
                                      "of nodes that share their displacements all three are held, or none", place)
            elif set(nodes) & self.following:
                self.model.cards.lose("HINGE AT A RIGID BODY",
                                      "a hinge cannot be at a node of a rigid body or at an arm", place)
            elif len(own) > 1:
                self.pins.append(own)

    def pin_groups(self) -> list:
        """Groups of pins such that within each only nodes of one pin coincide."""
        groups: list = []
        for nodes in self.pins:
            cell = tuple(round(value / (100 * self.near)) for value in self.model.nodes[nodes[0]])
            for taken, members in groups:
                if cell not in taken:
                    taken.add(cell)
                    members += nodes
                    break
            else:
                groups.append(({cell}, list(nodes)))
        return [members for _, members in groups]
