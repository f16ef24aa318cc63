"""Public classes have docstrings and texts with their values; a package with missing parts names them."""

import ast
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import hedgehop
from flights import SHORT, SOURCE, TREE

CLASSES = [value for value in (getattr(hedgehop, name) for name in hedgehop.__all__) if isinstance(value, type)]
MISSING = pathlib.Path(hedgehop.__file__).parent / "_missing.py"


class Texts(unittest.TestCase):
    def test_every_public_class_and_function_has_a_docstring(self):
        for name in hedgehop.__all__:
            value = getattr(hedgehop, name)
            if callable(value):
                self.assertGreater(len(value.__doc__ or ""), 10, name)

    def test_a_text_has_the_values_of_a_command(self):
        command = hedgehop.VelocityCommand([1.5, -2], 10, 0.25)
        self.assertEqual(repr(command), "VelocityCommand(v_WB_W_mps=[1.5, -2], altitude_m=10, heading_rad=0.25)")
        self.assertEqual(repr(hedgehop.Decision(hedgehop.HoverCommand(0.5), "look", [1.0])),
                         "Decision(command=HoverCommand(yaw_rate_radps=0.5), status='look', signals=[1])")

    def test_every_object_of_a_flight_has_a_text(self):
        sim = hedgehop.Simulation(TREE, set=SHORT)
        obs = sim.reset()
        camera = next(iter(sim.cameras.values()))
        for value in (sim, obs, obs.navigation, obs.goal, camera, sim.truth, sim.proximity, hedgehop.CameraNeed("front")):
            self.assertTrue(repr(value).startswith(type(value).__name__ + "("), repr(value))
            self.assertNotIn(" object at 0x", repr(value))
        self.assertIn(f"role={camera.role!r}", repr(camera))

    def test_images_have_the_instant_of_their_exposure(self):
        sim = hedgehop.Simulation(TREE, set=SHORT)
        obs = sim.reset()
        while not obs.images and not sim.over:
            obs = sim.step()
        self.assertEqual(set(obs.image_t_ns), set(obs.images))
        self.assertTrue(all(0 <= t <= obs.t_ns for t in obs.image_t_ns.values()))

    def test_stereo_cameras_have_a_baseline_and_a_focal_length(self):
        sim = hedgehop.Simulation(TREE, set=SHORT)
        left, right = sim.cameras["left"], sim.cameras["right"]
        X_LR = np.linalg.inv(left.X_BC) @ right.X_BC
        self.assertGreater(X_LR[0, 3], 0.01)
        np.testing.assert_allclose(X_LR[:3, :3], np.eye(3), atol=1e-9)
        ray = left.rays()[0, 0]
        p = left.pinhole
        np.testing.assert_allclose(ray / ray[2], [-p["center_u_px"] / p["focal_x_px"], -p["center_v_px"] / p["focal_y_px"], 1])


class Sources(unittest.TestCase):
    def test_they_are_python_3_9(self):
        files = list((SOURCE / "sim/python/hedgehop").glob("*.py"))
        self.assertTrue(files)
        for file in files:
            ast.parse(file.read_text(), str(file), feature_version=(3, 9))


class Missing(unittest.TestCase):
    def explanation(self, *files):
        """Returns the error of a package with these files."""
        spec = importlib.util.spec_from_file_location("missing_under_test", MISSING)
        missing = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(missing)
        with tempfile.TemporaryDirectory() as folder:
            for file in files:
                (pathlib.Path(folder) / file).touch()
            with self.assertRaises(ImportError) as raised:
                missing.explain(str(pathlib.Path(folder) / "__init__.py"))
        return str(raised.exception)

    def test_a_package_without_its_compiled_part_names_the_command_that_builds_it(self):
        self.assertIn("scripts/packages python && scripts/build", self.explanation())

    def test_a_package_for_another_python_names_both(self):
        text = self.explanation("_native.cpython-36m-x86_64-linux-gnu.so")
        self.assertIn("was built for Python 3.6", text)
        self.assertIn(f"this is Python {sys.version_info.major}.{sys.version_info.minor}", text)

    def test_a_python_without_numpy_is_told_so(self):
        program = f"import sys; sys.modules['numpy'] = None; sys.path.insert(0, {str(MISSING.parent.parent)!r}); import hedgehop"
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertIn("apt install python3-numpy", done.stderr)


if __name__ == "__main__":
    unittest.main()
