"""run/fragility with a block `coherence`: each sample's records move the mats, in ensembles as in single runs, and mistakes."""
import csv
import unittest

import numpy as np
import program
import two_buildings
from study_command import StudyCommand


MATS = {"west": {"centre": "3,2,0", "sides": "6,4", "groups": "left"}, "east": {"centre": "9,2,0", "sides": "6,4", "groups": "right"}}
COHERENCE = {"mats": MATS, "model": {"luco_wong": {"gamma": 0.3, "vs": 100}}}


class Coherence(StudyCommand):
    def fragility(self, *words, **changes):
        return super().fragility(*words, **{"soils": None, "states": None, "coherence": COHERENCE, **changes})

    @program.long
    def test_members_move_their_mats_and_are_single_runs(self):
        said = self.fragility("--runner", "ensemble").stdout
        self.assertIn("mats move by motion 2 of 2", said)
        place = next((self.place / "out" / "runs").glob("*/ensemble-*"))
        with open(place / "members.csv", newline="") as file:
            columns, *rows = csv.reader(file)
        self.assertIn("ground_west_motion_x_record", columns)
        self.assertIn("ground_east_rotation_z_scale", columns)
        result = two_buildings.pounding.load_ensemble(place)
        step = next(line.split()[2] for line in result.identity if line.startswith("time step")) if hasattr(result, "identity") else None
        words = [word for name, value in zip(columns, rows[1]) for word in (f"-{name}", value)]
        folder, _ = program.must_run(self, ["-options_file", str(place.parent / "scene.yaml"), *words,
                                            *(["-time_step", step] if step else [])], 1)
        single = two_buildings.pounding.load(folder)
        self.assertEqual(len(single.summary["supports"]), 4)
        for c, channel in enumerate(result.channels):
            peak = np.abs(single.series("displacement", *channel.split())[1]).max()
            self.assertAlmostEqual(result.displacement[1, c], peak, delta=1e-9 * max(peak, 1e-6))
        files = sorted((self.place / "out" / "motions").glob("west-*.csv"))
        self.assertEqual(len(files), 2)
        before = [file.stat().st_mtime_ns for file in files]
        self.assertNotIn("mats move", self.fragility("--collect").stdout)
        self.assertEqual(before, [file.stat().st_mtime_ns for file in files])

    @program.long
    def test_coherent_ground_beside_it_is_no_part_of_the_envelope(self):
        self.fragility("--runner", "ensemble", soils={"one": {}}, coherence={**COHERENCE, "coherent_too": True})
        out = self.place / "out"
        apart, alike, envelope = (program.rows_of(out / place / "joint.csv") for place in ("conditions/one", "conditions/one_coherent", "."))
        self.assertEqual({row["soil"] for row in envelope}, {"one"})
        strongest = [row for row in apart if row["joint"] == "any"][-1]
        self.assertEqual([float(row["needed [m]"]) for row in envelope if row["joint"] == "any"][-1], float(strongest["5 % [m]"]))
        self.assertNotEqual(strongest["50 % [m]"], [row for row in alike if row["joint"] == "any"][-1]["50 % [m]"])
        moved = [row for row in program.rows_of(out / "sensitivity.csv") if row["moved by"] == "coherence"]
        self.assertEqual({row["at"] for row in moved} | {row["at "] for row in moved}, {"as given", "coherent"})

    def test_wrong_use_is_told_in_one_line(self):
        for changes, told in (({"mats": {"west": MATS["west"]}}, "coherence: mats: coherence tells how mats move apart, and there is one"),
                              ({"model": "abramson"}, "coherence: model: 'abramson' is unknown"),
                              ({"records": 1}, "coherence: records is unknown"),
                              ({"coherent_too": "yes"}, "coherence: coherent_too: 'yes' is neither true nor false"),
                              ({"model": {"table": "none.csv"}}, "coherence:")):
            self.must_be_refused(told, coherence={**COHERENCE, **changes})


if __name__ == "__main__":
    unittest.main()
