"""Supports that move on their own and cannot be meant: one line each, on every rank."""
import unittest

import program
from decks import braces, in_modes, SECTION, STEEL, viaduct


class WithRecord(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = program.write_samples([0, 0.1, -0.1, 0], 0.01)
        cls.still = program.write_samples([0, 1, 1, 0], 0.01)

    def words(self, *more, supports="west,east", groups=("v:foot0", "v:foot1"), structure=()):
        words = ["-structures", "v", *viaduct("v", 1, 0.0, *structure), *STEEL, *SECTION, "-end_time", 0.02, "-modes", 0,
                 "-supports", supports]
        for support, group in zip(supports.split(","), groups):
            words += [f"-{support}_groups", group]
        return words + list(more)

    def ground(self):
        return ["-motion_x_record", self.record, "-motion_x_unit", "m/s2"]


class Refused(WithRecord):
    def refuse(self, *parts, **how):
        more = how.pop("more", [])
        return program.must_refuse(self, self.words(*more, **how), *parts)

    def test_groups(self):
        self.refuse("-west_groups", "there is no structure 'w'", groups=("w:foot0", "v:foot1"))
        self.refuse("-west_groups", "there is no structure 'foot0'; a group is named with its structure",
                    groups=("foot0", "v:foot1"))
        self.refuse("-west_groups", "'v:' is neither structure:group nor a structure", groups=("v:", "v:foot1"))
        self.refuse("-east_groups", "'v' means all ground of the structure", groups=("v:foot0", "v"))
        self.refuse("-west_groups v:abutment", "no such group", "foot0", groups=("v:abutment", "v:foot1"))
        self.refuse("-west_groups v:deck", "no node of it is clamped", groups=("v:deck", "v:foot1"))
        self.refuse("is on a support already", groups=("v:foot0", "v:foot0"))
        self.refuse("-east_groups v:feet", "is on support west as well", groups=("v:foot0", "v:feet"))
        self.refuse("clamped node at (6, 0, 0)", "is on none of -supports", supports="west", groups=("v:foot0",))
        program.must_refuse(self, ["-structures", "v", *viaduct("v", 1, 0.0), *STEEL, *SECTION, "-end_time", 0.02,
                                   "-supports", "west"], "-west_groups", "missing")

    def test_motions(self):
        self.refuse("-west_delay", "no effect", more=["-west_delay", 0.1])
        self.refuse("-west_factor", "no effect", more=["-west_factor", "0,1,1"])
        self.refuse("-west_delay", "out of range", more=[*self.ground(), "-west_delay", -0.1])
        self.refuse("-west_point", "missing", more=["-west_rotation_y_record", self.record])
        self.refuse("-west_point", "does not turn", more=["-west_point", "0,0,0"])
        self.refuse("-west_rotation_y_scale", "goes with", more=["-west_rotation_y_scale", 2])
        self.refuse("-west_motion_y_scale", "no motion along y", more=["-west_motion_y_scale", 2])
        self.refuse("unknown option -west_rotation_w_record", more=["-west_rotation_w_record", self.record])
        self.refuse("nowhere.txt", "cannot be opened",
                    more=["-west_motion_x_record", "nowhere.txt", "-west_motion_x_unit", "m/s2"])
        self.refuse("support west, motion x: scaled peak",
                    more=["-west_motion_x_record", self.record, "-west_motion_x_unit", "m/s2", "-west_motion_x_scale", 1e9])
        self.refuse("support west, rotation", "rad/s2",
                    more=["-west_rotation_y_record", self.record, "-west_rotation_y_scale", 1e8, "-west_point", "0,0,0"])

    def test_together_with_others(self):
        moved = [*self.ground(), "-west_delay", 0.1]
        for option, more in (("-v_matrices", ["-v_matrices", "/tmp"]), ("-export_matrices", ["-export_matrices", "/tmp/m"]),
                             ("-v_bearings_yield_force", [*in_modes("v", 5), "-v_bearings_yield_force", "1e3,0,0"])):
            self.refuse(option, more=[*moved, *more])
        self.refuse("-v_braces_tension_only", more=[*moved, *in_modes("v", 5)],
                    structure=braces("v"))
        self.refuse("damping alpha", "bearings",
                    more=[*moved, "-v_bearings_yield_force", "1e3,0,0", "-v_damping_alpha", 0.1])

    def test_ties_of_clamped_nodes(self):
        program.must_refuse(
            self, ["-structures", "t", "-t_mesh", "tests/meshes/tied_blocks.geo", "-t_first_element", "hex8",
                   "-t_first_material", "steel", "-t_second_element", "hex8", "-t_second_material", "steel", *STEEL,
                   "-t_mesh_set", "m2=3", "-end_time", 1e-4, "-t_clamp", "x_min,y_min:y", "-t_tie", "edge:face",
                   "-supports", "s", "-s_groups", "t:x_min,t:y_min", *self.ground(), "-s_delay", 1e-3],
            "-t_tie edge:face", "is clamped, or follows a clamped one")


class Doubted(WithRecord):
    def warnings(self, *more):
        return [text for text in program.must_run(self, self.words(*more))[1]["warnings"] if " x: " in text]

    def test_what_drifts(self):
        self.assertEqual(self.warnings(*self.ground(), "-west_delay", 0.005), [])
        drift, = self.warnings("-west_motion_x_record", self.still, "-west_motion_x_unit", "m/s2")
        self.assertIn("support west, x: once its records are over it goes on at 0.02 m/s", drift)
        left, = self.warnings("-west_motion_x_record", self.record, "-west_motion_x_unit", "m/s2")
        self.assertIn("support west, x: its records leave it", left)


if __name__ == "__main__":
    unittest.main()
