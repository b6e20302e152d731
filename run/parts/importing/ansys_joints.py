"""Supports, couplings and components of ANSYS archives."""

from .ansys_cards import Command
from .cards import whole, whole_range
from .joints import Shared, hold_turned
from .model import ALL, InputFault, Reading

LABELS = {label: 1 << k for k, label in enumerate(("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"))} | {"ALL": ALL}

OTHER_LABELS = {"TEMP", "VOLT", "MAG", "PRES", "AX", "AY", "AZ", "CURR", "EMF", "CONC", "ENKE", "ENDS"}


class JointReader(Reading):
    """`reader` is the whole archive's."""

    def __init__(self, reader):
        super().__init__(reader.model, reader)
        self.components: dict = {}  # name -> nodes
        self.coupled = Shared(self.model, "coupled", "CP", "couplings join all displacements of nodes that coincide")
        self.selects = any(command.name in ("NSEL", "CMSEL", "NSLE") for command in reader.commands)
        self.held: dict = {}  # node -> [components, place]
        self.handlers = {"D": self._support, "CMBLOCK": self._component, "CP": self._couple}

    def _nodes(self, text: str, place: str) -> list:
        name = text.upper()
        if name == "ALL":
            return list(self.model.nodes)
        if name in self.components:
            return self.components[name]
        node = whole(text, place)
        self.model.at(node, place)
        return [node]

    def _support(self, command: Command) -> bool:
        """D, node, label, value, value2, last node, step, more labels."""
        labels = [text.upper() for text in (command.text(1), *command.words[6:]) if text]
        if set(labels) & OTHER_LABELS:
            return self.note(f"D {labels[0]}", "says nothing of displacements")
        if not labels or set(labels) - set(LABELS):
            return self.lose(f"D {' '.join(labels)}", "supports hold UX to ROTZ, or ALL", command.place)
        if command.text(0).upper() in ("ALL", "") and self.selects:
            return self.lose("D OF SELECTED NODES", "selections are not followed; name the nodes or a component",
                                  command.place)
        if command.text(2).upper() not in ("", "%_FIX%") and command.real(2):
            self.model.said.append(f"{command.place}: a displacement of {command.text(2)} is held at zero")
        nodes = self._nodes(command.text(0), command.place)
        if command.text(4):
            span = whole_range(nodes[0], command.int(4), command.int(5, 1), command.place)
            nodes = [node for node in self.model.nodes if node in span]
        for node in nodes:
            for label in labels:
                self.held.setdefault(node, [0, command.place])[0] |= LABELS[label]
        return True

    def _component(self, command: Command) -> None:
        """Numbers, and last ones of ranges with a minus sign."""
        name, kind = command.text(0).upper(), command.text(1).upper()
        members: list = []
        for value in command.rows:
            if value < 0:
                if not members:
                    raise InputFault(f"{command.place}: a component begins with the end of a range")
                members += whole_range(members[-1], -value, 1, command.place)[1:]
            else:
                members.append(value)
        if kind.startswith("NODE"):
            self.components[name] = [node for node in members if node in self.model.nodes]
            self.model.node_sets[name] = self.components[name]
        else:
            self.model.element_sets[name] = [self.reader.elements_[n] for n in members if n in self.reader.elements_]

    def _couple(self, command: Command) -> bool:
        label = command.text(1).upper()
        if label in OTHER_LABELS:
            return self.note(f"CP {label}", "says nothing of displacements")
        if label not in LABELS:
            return self.lose(f"CP {label}", "couplings are of UX to ROTZ, or ALL", command.place)
        nodes = [node for text in command.words[2:] if text for node in self._nodes(text, command.place)]
        self.coupled.add(nodes, LABELS[label], command.place)
        return False

    def finish(self) -> None:
        for node, (components, place) in self.held.items():
            hold_turned(self.model, node, components, self.reader.turned.get(node), "D", place)
        self.coupled.finish()
