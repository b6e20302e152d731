"""run/import --try: a folder of decks of all kinds becomes a table of what is read, with which losses, or refused and why."""
import csv
import os
import tempfile
import unittest
from pathlib import Path

import imported

NASTRAN = ("SOL 103\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,0.,0.,3.\nCBAR,1,1,1,2,1.,0.,0.\nPBAR,1,1,.01,1.-5,1.-5,2.-5\n"
           "MAT1,1,2.1+11,,.3,7850.\nSPC1,1,123456,1\n")
ABAQUS = ("*HEADING\n*NODE\n1, 0., 0., 0.\n2, 0., 0., 3.\n*ELEMENT, TYPE=B31, ELSET=ALL\n1, 1, 2\n*MATERIAL, NAME=M\n*ELASTIC\n"
          "2.1e11, .3\n*DENSITY\n7850.\n*BEAM SECTION, SECTION=CIRC, ELSET=ALL, MATERIAL=M\n.1\n1., 0., 0.\n*BOUNDARY\n1, 1, 6\n")
DECKS = {"frame.bdf": NASTRAN, "sub/frame.inp": NASTRAN, "sub/rbe3.bdf": NASTRAN + "RBE3,9,,2,123456,1.,123,1\n",
         "bad.bdf": NASTRAN + "GRID,9,,0.,o.,0.\n", "light.dat": NASTRAN.replace("7850.", ""), "mast.inp": ABAQUS,
         "=1+1.inp": ABAQUS, "notes.txt": "GRID of notes\n", "results.dat": b"\0\1\2\3", "words.inp": "a text\n",
         "none.cdb": "/PREP7\nFINISH\n"}
EXPECTED = {"frame.bdf": ("nastran", "yes", "read"), "sub/frame.inp": ("nastran", "yes", "read"),
            "sub/rbe3.bdf": ("nastran", "yes", "read with losses"), "bad.bdf": ("nastran", "yes", "refused"),
            "light.dat": ("nastran", "no", "refused"), "mast.inp": ("abaqus", "yes", "read"),
            "'=1+1.inp": ("abaqus", "yes", "read"), "none.cdb": ("ansys", "no", "refused")}


class Try(unittest.TestCase):
    def test_a_folder_of_decks(self):
        """Endings and first cards tell what a deck is; other files are not tried, among them a pipe that nobody fills."""
        folder = Path(tempfile.mkdtemp(prefix="pounding-import-"))
        for name, text in DECKS.items():
            (folder / "in" / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / "in" / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        os.mkfifo(folder / "in" / "pipe.bdf")
        done = imported.command(folder / "in", "m,kg,s", "--try")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        with open(folder / "out" / "tried.csv", newline="") as file:
            rows = {row["file"]: row for row in csv.DictReader(file)}
        self.assertEqual({name: (row["format"], row["mass"], row["outcome"]) for name, row in rows.items()}, EXPECTED)
        self.assertEqual(rows["sub/rbe3.bdf"]["losses"], "RBE3 1")
        self.assertIn("bad.bdf line 10: GRID: 'o.' is not a number", rows["bad.bdf"]["reason"])
        self.assertEqual([rows["mast.inp"][key] for key in ("nodes", "elements", "kilograms")], ["2", "1", "739.845"])
        for line in ("tried 8: read 4, read with losses 1, refused 3", "  nastran: 5, with elements and mass 4, of these read 3 (75 %)",
                     "     1  RBE3"):
            self.assertIn(f"\n{line}\n", done.stdout)
        again = imported.command(folder / "in", "m,kg,s", "--try")
        self.assertEqual((again.returncode, "tried.csv is there already" in again.stderr), (1, True))

    def test_a_folder_without_decks(self):
        folder = Path(tempfile.mkdtemp(prefix="pounding-import-"))
        done = imported.command(folder, "m,kg,s", "--try")
        self.assertEqual((done.returncode, done.stderr), (1, f"run/import: {folder}: no deck in it\n"))


if __name__ == "__main__":
    unittest.main()
