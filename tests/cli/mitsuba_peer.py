#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The preview ball in Mitsuba 3, whose `measured` plug-in reads the same RGL file, is the same picture within its noise.

$BRDF_RENDER_PEERS names a Python environment with the packages mitsuba and numpy; `tests/run --all --long` makes one. Without it,
and without the measured files of $BRDF_SHARED, this is skipped."""
import json
import pathlib
import sys
import tempfile
import unittest

from support import mitsuba_peer

SKIPPED = 77
if not mitsuba_peer.RENDER or not mitsuba_peer.PEERS:
    print("BRDF_RENDER or BRDF_RENDER_PEERS is not set")
    sys.exit(SKIPPED)

SIZE, SPP = 128, 64
# One is smooth and metallic, one is rough, and the scene's own has negative values, see below.
MATERIALS = ["satin_rosaline_rgb.bsdf", "acrylic_felt_green_rgb.bsdf", "vch_golden_yellow_rgb.bsdf"]

# Of about 300 blocks with three channels the largest of |z| is around 3.4 when nothing but noise differs; a fourth means noise
# in one run of thousands. Noise of paths has heavier tails than the normal distribution, hence somewhat more.
MOST_Z, MOST_RMS_Z, MOST_WHOLE_Z = 5.5, 1.25, 4.5


class MitsubaPeer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="brdf-mitsuba-")
        cls.folder = pathlib.Path(cls.temporary.name)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def material(self, name):
        path = mitsuba_peer.SHARED / "rgl" / name
        if not path.exists():
            self.skipTest(f"{path} is absent")
        # Where a file has values below 0 libbrdf takes 0, and `measured` light that is taken away. Both get the same file without.
        clean = self.folder / name
        mitsuba_peer.call_peer("without-negatives", path, clean)
        return clean

    def compare(self, name, incident):
        ball = mitsuba_peer.Ball(self.folder, self.material(name), incident, SIZE)
        ours = [ball.ours(SPP, seed) for seed in (1, 2)]
        theirs = [ball.theirs(SPP, seed) for seed in (1, 2)]
        figures = mitsuba_peer.call_peer("compare", *(p.picture for p in ours + theirs))
        print(name, incident, json.dumps(figures), flush=True)
        return figures

    def test_same_picture(self):
        for name in MATERIALS:
            with self.subTest(material=name):
                figures = self.compare(name, "viewer")
                self.assertLess(figures["median_noise_relative"], 0.02, "too noisy to find anything")
                self.assertLess(figures["rms_z"], MOST_RMS_Z)
                self.assertLess(figures["max_z"], MOST_Z)
                self.assertLess(abs(figures["whole_z"]), MOST_WHOLE_Z)

    def test_the_incident_direction_matters(self):
        """The same bounds find that RGL's measurements are not reciprocal."""
        figures = self.compare("satin_rosaline_rgb.bsdf", "light")
        self.assertGreater(figures["max_z"], 2 * MOST_Z)
        self.assertGreater(figures["rms_z"], 1.5 * MOST_RMS_Z)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    ran = program.result.testsRun - len(program.result.skipped)
    sys.exit(SKIPPED if ran == 0 and program.result.wasSuccessful() else not program.result.wasSuccessful())
