"""Supports and constraints of Nastran decks."""

import re
from bisect import bisect_left, bisect_right

from .cards import is_whole_number, whole
from .joints import Shared, follow_in_part, hold_turned, is_whole, turning_nodes
from .model import ALL, TRANSLATIONS, InputFault, Reading, components_of
from .nastran_cards import Card

EQUATIONS = "equations join all displacements of two nodes that coincide"


class JointReader(Reading):
    """`reader` is the whole deck's; `control`: lines before the bulk data, whose case control names the sets."""

    def __init__(self, reader, control):
        super().__init__(reader.model, reader)
        self.permanent: list = []  # components that GRID holds
        self.sets: dict = {}  # set of SPC -> (node, components, place)
        self.sums: dict = {}  # SPCADD and MPCADD: set -> its sets
        self.equal: dict = {}  # set of MPC -> Shared
        self.lost: list = []  # cards of MPC that join otherwise: (set, place)
        self.waiting: list = []  # (name, independent, dependent, components, card)
        self.wanted = {word: self._named(control, word) for word in ("SPC", "MPC")}
        self.handlers = {"SPC": self._spc, "SPC1": self._spc1, "SPCADD": self._add, "MPCADD": self._add,
                         "MPC": self._mpc, "RBE2": self._rbe2, "RBAR": self._rbar}

    @staticmethod
    def _named(control, word: str) -> tuple:
        """Sets that case control names, and the place of the last."""
        found, where = [], ""
        for place, line in control:
            match = re.match(rf"\s*{word}\s*=(.*)$", line, re.IGNORECASE)
            if match:
                number = whole(match[1].strip(), f"{place}: {word}")
                if number not in found:
                    found.append(number)
                where = place
        return found, where

    def _hold(self, key: int, node: int, components: int, card: Card) -> None:
        self.sets.setdefault(key, []).append((node, components, card))

    def _spc(self, card: Card) -> None:
        for at in (1, 4):
            if card.text(at):
                if card.real(at + 2):
                    self.model.said.append(f"{card.place}: a displacement of {card.text(at + 2)} is held at zero")
                self._hold(card.int(0), card.int(at), components_of(card.text(at + 1), card.place), card)

    def _spc1(self, card: Card) -> None:
        components = components_of(card.text(1), card.place)
        for numbers in card.ranges_from(2):  # of a range those that are there
            there = self.reader.in_order[bisect_left(self.reader.in_order, numbers[0]):bisect_right(self.reader.in_order, numbers[-1])]
            for node in numbers if len(numbers) == 1 else there:
                if node in numbers:
                    self._hold(card.int(0), node, components, card)

    def _add(self, card: Card) -> None:
        self.sums[card.name[:3], card.int(0)] = card.list_from(1, len(self.reader.cards))

    def _mpc(self, card: Card) -> None:
        values = card.fields[1:]
        terms = []
        for at in range(0, len(values), 8):  # two terms of three fields, with an empty field before and after
            terms += [values[at:at + 3], values[at + 3:at + 6]]
        terms = [term for term in terms if term and term[0]]
        nodes = {int(term[0]) for term in terms if is_whole_number(term[0])}
        digits = {term[1] for term in terms}
        factors = [Card("MPC", term, card.place).real(2) for term in terms]
        if len(terms) == 2 and len(nodes) == 2 and len(digits) == 1 and factors[0] == -factors[1] != 0:
            shared = self.equal.setdefault(card.int(0), Shared(self.model, "tied", "MPC", EQUATIONS, used=True))
            shared.add(nodes, components_of(digits.pop(), card.place), card.place)
        else:
            self.lost.append((card.int(0), card.place))

    def _rbe2(self, card: Card) -> bool:
        fields = card.fields[:]
        while fields and not fields[-1]:
            fields.pop()
        if fields and "." in fields[-1]:
            fields.pop()  # ALPHA
        self.waiting.append((f"rbe2_{card.int(0)}", card.int(1), Card("RBE2", fields, card.place).list_from(3, len(self.reader.grids)),
                             components_of(card.text(2), card.place), card))
        return False

    def _rbar(self, card: Card) -> bool:
        whole = card.text(3).strip("0") == "123456" and not card.text(4).strip("0")
        depends = card.text(6).strip("0")
        components = components_of(depends, card.place) if depends else ALL
        if not whole:
            self.lose("RBAR", "rigid bars couple all components, those of the first node independent", card.place)
        else:
            self.waiting.append((f"rbar_{card.int(0)}", card.int(1), [card.int(2)], components, card))
        return False

    def _chosen(self, word: str, there) -> set:
        """Sets in force: those of case control with their sums, or the only one."""
        named, place = self.wanted[word]
        if len(named) > 1:
            self.lose(f"{word} OF OTHER SUBCASES", f"case control names the sets {', '.join(map(str, named))} of {word}, and a scene has "
                      "one; allowed, the first holds", place, len(named) - 1)
            named = named[:1]
        if not named:
            free = set(there) - {one for (kind, _), sets in self.sums.items() if kind == word for one in sets}
            named = {key for kind, key in self.sums if kind == word} or free
            if len(named) > 1:
                raise InputFault(f"{self.reader.name}: sets {', '.join(map(str, sorted(named)))} of {word}, and no "
                                 f"case control names one: say {word} = one of them before BEGIN BULK")
        found: set = set()
        for one in named:
            found |= set(self.sums.get((word, one), [one]))
        for one in sorted(found - set(there)):
            if place:
                self.lose(f"SET {one} OF {word}", "case control, or a sum of sets, names it, and it is not in the deck", place)
        return found

    def finish(self) -> None:
        for node, digits, place in self.permanent:
            self._apply(node, components_of(digits, place), "GRID", place)
        chosen = self._chosen("SPC", self.sets)
        for key, rows in self.sets.items():
            for node, components, card in rows:
                if key in chosen and node not in self.reader.points:
                    self.model.at(node, card.place)
                    self._apply(node, components, card.name, card.place)
        unused = set(self.sets) - chosen
        if unused:
            self.model.said.append(f"sets {', '.join(map(str, sorted(unused)))} of SPC are not named by case control: "
                                   "not read")
        chosen = self._chosen("MPC", {*self.equal, *(key for key, _ in self.lost)})
        turning = turning_nodes(self.model)
        for key, place in self.lost:
            if key in chosen:
                self.lose("MPC", EQUATIONS, place)
        for key in chosen & set(self.equal):
            self.equal[key].finish()
        for name, first, others, components, card in self.waiting:
            for node in (first, *others):
                self.model.at(node, card.place)
            if is_whole(components, others, turning):
                self.model.rigid.append((name, [first, *others], card.place))
                self.use(card.name)
            elif components == TRANSLATIONS and len({self.model.nodes[node] for node in (first, *others)}) == 1:
                self.model.pins.append(({first, *others}, card.place))
                self.use(card.name)
            else:
                follow_in_part(self.model, name, first, others, components, self.reader.frame, card.name, card.place)

    def _apply(self, node: int, components: int, card: str, place: str) -> None:
        hold_turned(self.model, node, components, self.reader.frame(node), card if card != "GRID" else "PS OF GRID", place)
