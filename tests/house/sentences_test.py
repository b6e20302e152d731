"""Slots of sentences are right before they are printed: the names in them are keys of the same file, conversions are
those of printf, units are known. No compiler looks into them."""
import os
import re
import unittest

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")
LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"')
SLOT = re.compile(r"\{([^{}]*)\}")
MEMBERS = re.compile(r"FACTS_OF\((?:\([^()]*\)|[^(),]*),([^()]*)\)")  # whose names are keys
FORM = re.compile(r"(?P<name>[\w/]*)(?::(?P<conversion>[-+]?\d*(?:\.\d+)?[defgs])?(?: (?P<unit>\S+))?)?")


def units():
    with open(os.path.join(SOURCE, "common", "facts.cpp")) as file:
        return set(re.findall(r'ReportUnit\{"([^"]+)"', file.read()))


def faults(text, known):
    """Slots of the string literals of a file that cannot be filled, and how many there are."""
    found, count = [], 0
    words = set(LITERAL.findall(text)) | set(re.findall(r"\w+", " ".join(MEMBERS.findall(text))))
    for literal in LITERAL.findall(text):
        for slot in SLOT.findall(literal):
            count += 1
            form = FORM.fullmatch(slot)
            if not form:
                found.append(slot)
                continue
            unit = (form["unit"] or "").strip("[]")
            parts = [part for part in form["name"].split("/") if part and not part.isdigit()]
            if (unit and unit not in known) or any(part not in words for part in parts):
                found.append(slot)
    return found, count


class Sentences(unittest.TestCase):
    def test_slots_can_be_filled(self):
        known, seen = units(), 0
        with open(os.path.join(SOURCE, "dynamics", "energy_balance.h")) as file:
            ledger = file.read()
        self.assertIn("mm", known)
        for folder, _, files in os.walk(SOURCE):
            for name in files:
                with open(os.path.join(folder, name)) as file:
                    text = file.read()
                if "ledger_rows" in text:
                    text += ledger
                if not name.endswith(".cpp") or not re.search(r"(common/facts(_of)?|report/report)\.h", text):
                    continue
                if name == "facts.cpp":
                    continue
                found, count = faults(text, known)
                seen += count
                self.assertEqual(found, [], name)
        self.assertGreater(seen, 200)

    def test_a_slot_that_cannot_be_filled_is_found(self):
        text = 'facts.add("mass", m, "{mass:.3g kg} {mas} {mass:.3g mm} {:5q} {mass/0:8.2f [mm]}");'
        self.assertEqual(faults(text, {"mm"}), (["mass:.3g kg", "mas", ":5q"], 5))
        text = 'facts.values.push_back(FACTS_OF(mode, frequency, mass)); say("{frequency} {share}");'
        self.assertEqual(faults(text, {}), (["share"], 2))


if __name__ == "__main__":
    unittest.main()
