"""run/fragility over the two small buildings, the left one on soil, for tests of soils, states, surveys and coherence."""
import contextlib
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import program
import two_buildings
import yaml
from two_buildings import pounding
from pounding.fragility import conditions, study

ON_SOIL = {"left_clamp": "none", "left_soil_mat": "base", "left_soil_vs": 150, "left_soil_density": 1900,
           "left_soil_poisson": 0.33, "left_soil_size": "6,4"}
STUDY = {
    "scene": str(two_buildings.SCENE),
    "options": {**two_buildings.SHORT, **ON_SOIL, "probes": "left_roof", "output_interval": 2e-4},
    "reduction": {name: {"model": "modal", "modal_vectors": 8} for name in ("left", "right")},
    "motions": {"correlation": 0.9, "x": {"target": str(two_buildings.FOLDER / "ground.csv"), "seeds": [1, 2],
                                          "options": {"duration": 6, "envelope": "0.3,4"}}},
    "levels": [4.0],
    "gaps": [0.01],
    "joints": {"floor1": {}, "floor2": {}},
    "soils": {"best": {}, "upper": {"factor": 2.25}},
    "states": {"sound": {}, "cracked": {"left": {"columns": {"stiffness_factor": 0.5}}}},
    "frequencies": [1, 2, 5, 10, 20, 50, 100],
    "dampings": [0.05],
}


def refused_where_it_is_read(path):
    """What is wrong with a study by its file alone, by the calls with which the command begins; empty where nothing is."""
    try:
        with contextlib.chdir(path.parent):
            found = study.read(Path(path.name))
            study.check_orders(found)
            conditions.find(found)
    except pounding.UserError as error:
        return str(error)
    return ""


class StudyCommand(unittest.TestCase):
    """The command in a folder of its own, `place`, over STUDY with changes: `fragility` gives how it ended."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="pounding-")
        self.addCleanup(folder.cleanup)
        self.place = Path(folder.name)

    def fragility(self, *words, status=0, **changes):
        (self.place / "study.yaml").write_text(yaml.safe_dump({**STUDY, **changes}, sort_keys=False))
        done = subprocess.run([os.path.join(program.SOURCE, "run", "fragility"), "study.yaml", *words, "--out", "out"],
                              cwd=self.place, capture_output=True, text=True, timeout=600, check=False,
                              env={**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def must_be_refused(self, words, **changes):
        """The study with changes is refused in one line that has the words: where it is read, else by a dry run."""
        path = self.place / "study.yaml"
        path.write_text(yaml.safe_dump({**STUDY, **changes}, sort_keys=False))
        said = refused_where_it_is_read(path) or self.fragility("--dry-run", status=1, **changes).stderr
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn(words, said)
