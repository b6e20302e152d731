"""What is refused of absorbing faces and of a motion from below: one line, exit status 1, on one and two ranks."""
import tempfile
import unittest

import program
from decks import contacts, in_modes, material
from program import write_samples

SITE = ["-structures", "site", "-site_mesh", "tests/meshes/column.geo", "-site_rock_element", "hex8",
        "-site_rock_material", "ground", "-site_soil_element", "hex8", "-site_soil_material", "ground",
        *material("ground", "2e8", 0.3, 2000), "-end_time", 0.01, "-modes", 0]
BELOW = ["-motion_input", "below"]
BASE = ["-site_absorbing_base", "bottom"]


class Refused(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_samples([0.0, 1.0, 0.0, -1.0, 0.0], 0.01)

    def along(self, axis):
        return [f"-motion_{axis}_record", self.record, f"-motion_{axis}_unit", "m/s2"]

    def refused(self, words, *parts):
        program.must_refuse(self, SITE + self.along("x") + words + ["-dry_run"], *parts)

    def test_faces(self):
        self.refused(["-site_absorbing", "bottmo"], "-site_absorbing bottmo", "no surface")
        self.refused(["-site_absorbing", "rock"], "-site_absorbing rock", "no surface")
        self.refused(["-site_absorbing", "joint"], "-site_absorbing joint", "lies between two solids")
        self.refused(["-site_absorbing", "sides,x_min"], "-site_absorbing x_min", "is in two absorbing groups")
        self.refused(BELOW + BASE + ["-site_absorbing", "bottom"], "-site_absorbing bottom", "absorbing_base")
        self.refused(["-site_absorbing", "bottom", "-site_matrices", "there"], "-site_absorbing bottom", "_matrices")
        self.refused(["-site_absorbing", "bottom", *in_modes("site", 3)],
                     "-site_absorbing bottom", "full order")
        with tempfile.TemporaryDirectory() as folder:
            self.refused(["-site_absorbing", "bottom", "-export_matrices", folder], "-export_matrices", "absorbing")

    def test_shells_are_no_ground(self):
        words = ["-structures", "site", "-site_mesh", "tests/meshes/table.geo", "-site_ignore", "column",
                 "-site_slab_element", "shell", "-site_slab_material", "ground", "-site_slab_thickness", 0.1,
                 "-site_absorbing", "slab"]
        program.must_refuse(self, SITE[12:] + words + ["-dry_run"], "no face of a solid")

    def test_base(self):
        self.refused(BASE, "-site_absorbing_base bottom", "goes with -motion_input below")
        self.refused(BELOW + ["-site_absorbing", "bottom"], "-motion_input below", "has no -site_absorbing_base")
        self.refused(BELOW + ["-site_absorbing_base", "top"], "-site_absorbing_base top", "does not look down")
        self.refused(BELOW + ["-site_absorbing_base", "x_min"], "-site_absorbing_base x_min", "does not look down")
        self.refused(BELOW + BASE + ["-site_clamp", "bottom:x"], "-site_absorbing_base bottom", "cannot enter")
        self.refused(["-motion_input", "above"], "-motion_input above", "base")

    def test_ground_at_rest(self):
        self.refused(BELOW + BASE + ["-site_damping_alpha", 1], "-motion_input below", "damping alpha")
        self.refused(BELOW + BASE + ["-site_rock_damping_alpha", 1], "-motion_input below", "damping alpha")
        self.refused(BELOW + BASE + ["-site_top_element", "grounded_spring", "-site_top_stiffness", "1,1,1"],
                     "-motion_input below", "springs to the ground (top)")
        self.refused(BELOW + BASE + [*contacts(joint=("site:x_max", "wall", 0.1))], "-motion_input below", "wall")

    def test_two_ways_to_move(self):
        """A structure on the moving ground beside one that a wave moves."""
        other = [word.replace("site", "other") if isinstance(word, str) else word for word in SITE[2:12]]
        words = SITE + self.along("x") + BELOW + BASE + ["-structures", "site,other", *other, "-other_clamp", "bottom"]
        program.must_refuse(self, words + ["-dry_run"], "structure other has no -other_absorbing_base")

    def test_weight_on_dashpots(self):
        for words in (["-gravity", 9.81], ["-gravity", 9.81, "-preload", "static"], ["-site_gravity", "0,1,0"]):
            self.refused(BELOW + BASE + words, "-site_absorbing_base bottom", "nothing but dashpots holds",
                         "-site_clamp bottom:" + ("y" if "0,1,0" in words else "z"))
        self.refused(BELOW + BASE + ["-gravity", 9.81, "-preload", "static", "-site_clamp", "bottom:z",
                                     "-site_gravity", "1,0,-9"], "-site_absorbing_base bottom", "gravity acts along x")

    def test_levels(self):
        self.refused(["-site_levels", "al"], "-site_levels", "'al'")
        self.refused(["-site_levels", "all", "-site_clamp", "x_min:z"], "-site_levels all", "is clamped")

    def test_a_record_that_drifts_is_doubted(self):
        record = write_samples([0.0, 1.0, 0.0], 0.01)
        words = SITE + BELOW + BASE + ["-motion_y_record", record, "-motion_y_unit", "m/s2", "-dry_run"]
        result = program.must_end(self, words, 2)
        self.assertIn("the site drifts off", result.stdout)


if __name__ == "__main__":
    unittest.main()
