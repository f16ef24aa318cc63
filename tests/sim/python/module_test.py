"""Modules in Python fly as those in C++: with the library, with the program, and in batches."""

import importlib.util
import json
import os
import pathlib
import select
import signal
import subprocess
import tempfile
import unittest

import numpy as np

import hedgehop
import hedgehop.testing
from flights import CITY, PROGRAM, SHORT, SOURCE, STRAIGHT, TREE, VERSION, run_program, steady

MODULES = pathlib.Path(__file__).with_name("modules_in_a_file.py").read_text()


class FromFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.file = cls.folder / "mine.py"
        cls.file.write_text(MODULES)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def python(self, class_name, values=SHORT, **parameters):
        return {**values, "avoidance": {"python": str(self.file), "class": class_name, "parameters": parameters}}

    def test_a_copy_of_go_to_goal_has_its_hash_everywhere(self):
        expected = hedgehop.Simulation(CITY, set=STRAIGHT).run()["trajectory_hash"]
        values = self.python("GoToGoal", STRAIGHT, speed=3)
        status, result, said = run_program(CITY, values, self.folder / "out")
        self.assertEqual((result or {}).get("trajectory_hash"), expected, said)
        self.assertEqual(hedgehop.Simulation(CITY, set=values).run()["trajectory_hash"], expected)
        names = {}
        exec(MODULES, names)
        self.assertEqual(hedgehop.Simulation(CITY, set=STRAIGHT, module=names["GoToGoal"](speed=3.0)).run()["trajectory_hash"], expected)
        self.assertIn("mine.py", " ".join(result["inputs"]))

    def test_signals_metrics_and_images_arrive(self):
        sim = hedgehop.Simulation(CITY, set=self.python("Looks"))
        result = sim.run()
        self.assertEqual(result["metrics"]["module.images"], result["decisions"])
        self.assertTrue(np.all(sim.decisions.first_comes_last == -1))
        self.assertTrue(np.all((sim.decisions.mean_grey > 1) & (sim.decisions.mean_grey < 254)))
        self.assertEqual(result["metrics"]["module.lowest_m"], 999.0)
        _, by_program, _ = run_program(CITY, self.python("Looks"), self.folder / "looks")
        self.assertEqual(steady(result), steady(by_program))
        banded = hedgehop.Simulation(CITY, set={**self.python("Looks"), "altitude_band": {"min": 2, "max": 60}}).run()
        self.assertEqual(banded["metrics"]["module.lowest_m"], 2.0)
        self.assertEqual(banded["metrics"]["module.highest_m"], 60.0)

    def test_an_export_names_a_module_that_has_changed_since_the_flight(self):
        module, flown = self.folder / "changes.py", self.folder / "flown"
        module.write_text(MODULES)
        values = {**STRAIGHT, "avoidance": {"python": str(module), "class": "GoToGoal", "parameters": {"speed": 3}}}
        run_program(CITY, values, flown)
        module.write_text(MODULES + "\n\nclass GoToGoal(GoToGoal):\n    def update(self, observation):\n"
                                    "        return hedgehop.VelocityCommand((1, 0), 10, 0)\n")
        done = subprocess.run([PROGRAM, "export", str(flown), "--format", "ulog"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("changes.py has changed since; the data agree", done.stderr)

    def test_an_exception_of_a_module_ends_its_flight_with_the_places(self):
        _, result, _ = run_program(CITY, self.python("Fails"), self.folder / "fails")
        self.assertEqual(result["outcome"], "fault")
        for text in ("0.520 s", "ValueError: no way", f"{self.file}:27 in update"):
            self.assertIn(text, result["cause"])
        self.assertNotIn("\n", result["cause"])

    def test_a_module_that_cannot_be_loaded_is_bad_input(self):
        broken = self.folder / "broken.py"
        broken.write_text("import nothing_of_that_name\n")
        for values, text in (({**SHORT, "avoidance": {"python": "none.py", "class": "A"}}, "there is no such file"),
                             (self.python("GoToGaol"), "has no class 'GoToGaol'; its modules: AnnotatesANumber, CommandsOfNoType, Fails, GoToGoal, Looks, "),
                             (self.python("GoToGoal", sped=1), "unexpected keyword argument 'sped'"),
                             ({**SHORT, "avoidance": {"python": str(broken), "class": "A"}}, "nothing_of_that_name"),
                             ({**SHORT, "avoidance": {"python": str(self.file)}}, "class")):
            with self.subTest(text):
                status, result, said = run_program(CITY, values, self.folder / "bad")
                self.assertEqual((status, result), (2, None))
                self.assertIn(text, said)
                with self.assertRaisesRegex(hedgehop.InputError, text.replace("'", ".")):
                    hedgehop.Simulation(CITY, set=values)

    def test_faults_of_a_module_file_have_no_python_around_them(self):
        broken = self.folder / "syn.py"
        broken.write_text("x = 1 +\n")
        _, _, said = run_program(CITY, {**SHORT, "avoidance": {"python": str(broken), "class": "A"}}, self.folder / "bad")
        self.assertIn(f"{broken}:1: SyntaxError: invalid syntax", said)
        self.assertNotIn("^", said)
        _, _, said = run_program(CITY, self.python("GoToGaol"), self.folder / "bad")
        self.assertIn("has no class 'GoToGaol'", said)
        self.assertNotIn("ValueError", said)
        self.assertNotIn("Refusal", said)

    def test_a_signal_with_the_name_of_a_column_is_refused(self):
        class Clock:
            signals = {"t_s": "s"}

            def update(self, observation):
                return hedgehop.Decision(hedgehop.HoverCommand(), "", [0.0])

        with self.assertRaisesRegex(hedgehop.InputError, "^'avoidance': the module's signal 't_s' has the name of a column of decisions.csv; rename it"):
            hedgehop.Simulation(CITY, module=Clock, set=SHORT)

    def test_declarations_of_a_class_are_checked_before_the_flight(self):
        for class_name, text in (("NeedsAText", "'needs' must be a list of cameras, each its role or a CameraNeed, got 'front'"),
                                 ("NeedsANumber", "'needs' must be a list of cameras, each its role or a CameraNeed, got 5"),
                                 ("NeedsWhatIsNotThere", "needs a camera 'forward', which the rig does not have; it has: left, right"),
                                 ("NeedsWhatIsNotThere", "needs camera 'front' to deliver depth images; it delivers grey images"),
                                 ("TakesNoSetup", "the module cannot be reset: TypeError: TakesNoSetup.reset() takes 1 positional argument"),
                                 ("CommandsOfNoType", "'commands' must be a list of command types: velocity, position, attitude, hover, got ['velocity', 'thrust']"),
                                 ("SignalsInAList", "'signals' must be a dict of names and units, both texts, got ['nearest']")):
            with self.subTest(class_name):
                status, result, said = run_program(CITY, self.python(class_name), self.folder / "itself")
                self.assertEqual((status, result), (2, None), said)
                self.assertIn(text, said)

    def test_a_long_value_is_cut_between_characters(self):
        for first in ("", "a", "aa"):  # one of three has a character of three bytes across the limit of 80 bytes
            class LongNeeds:
                needs = first + "\u20ac" * 100

                def update(self, obs):
                    return None

            with self.assertRaisesRegex(ValueError, f"'needs' must be a list of cameras.*got '{first}\u20ac{{25,26}}\\.\\.\\."):
                hedgehop.Simulation(CITY, module=LongNeeds, set=SHORT)

    def test_invalid_metrics_and_images_do_not_end_the_flight(self):
        status, result, said = run_program(CITY, self.python("MetricsInAText"), self.folder / "text")
        self.assertEqual((status, result["outcome"], result["flight_time_s"]), (1, "fault", 1.0), said)
        self.assertIn("after its flight: 'metrics' must be a dict of names and numbers, or return one, got '3 turns'", result["cause"])
        sim = hedgehop.Simulation(CITY, set={**self.python("AnnotatesANumber"), "film.enabled": True})
        self.assertEqual(sim.run()["outcome"], "timeout")  # no film, so no image is requested
        done = subprocess.run([PROGRAM, "run", CITY, "--renderer", "tiles", "--no-report", "--out", self.folder / "number", "--set", "film.enabled=true", "--set",
                               "duration=0.2", "--set", f"avoidance={{python: {self.file}, class: AnnotatesANumber}}"],
                              capture_output=True, text=True)
        result = hedgehop.load(self.folder / "number").result
        self.assertEqual(result["outcome"], "timeout", done.stderr)  # a video cannot change the flight

    def test_an_update_that_returns_none_is_reported(self):
        _, result, _ = run_program(CITY, self.python("ReturnsNone"), self.folder / "none")
        self.assertEqual(result["cause"], "the module failed at 0.000 s: update() returned None, not a command or a Decision")

    def test_an_interrupt_ends_the_program_and_is_not_a_fault(self):
        awake = self.folder / "awake"
        os.mkfifo(awake)
        reader = os.open(awake, os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        flying = subprocess.Popen([PROGRAM, "run", CITY, "--renderer", "tiles", "--no-video", "--no-report", "--out", self.folder / "interrupted", "--set",
                                   f"avoidance={{python: {self.file}, class: Sleeps}}"], stderr=subprocess.DEVNULL,
                                  env={**os.environ, "AWAKE": str(awake)}, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        while flying.poll() is None and not select.select([reader], [], [], 0.1)[0]:
            pass
        self.assertIn(b"awake", os.read(reader, 16), "it never decided")
        flying.send_signal(signal.SIGINT)
        flying.communicate()
        self.assertEqual(flying.returncode, -signal.SIGINT)
        self.assertFalse((self.folder / "interrupted/result.json").exists())

    def test_printed_text_is_not_part_of_the_results(self):
        done = subprocess.run([PROGRAM, "run", CITY, "--renderer", "tiles", "--no-video", "--no-report", "--json", "--out", self.folder / "prints", "--set",
                               "duration=0.2", "--set", f"avoidance={{python: {self.file}, class: Prints}}"],
                              capture_output=True, text=True)
        self.assertEqual(json.loads(done.stdout)["outcome"], "timeout")
        self.assertIn("seen 0", (self.folder / "prints/module/module.log").read_text())

    def test_another_python_in_path_has_no_effect(self):
        other = self.folder / "bin/python3"
        other.parent.mkdir()
        other.write_text("#!/bin/sh\nexit 1\n")
        other.chmod(0o755)
        library = self.folder / f"lib/python{VERSION}"
        library.mkdir(parents=True)
        (library / "os.py").write_text("raise ImportError('not this one')\n")
        path = {"PATH": f"{other.parent}:{os.environ['PATH']}"}
        _, result, said = run_program(CITY, self.python("GoToGoal"), self.folder / "path", environment=path)
        self.assertIsNotNone(result, said)
        self.assertEqual(result["outcome"], "timeout")

    def test_a_batch_flies_it_in_workers(self):
        values = self.python("GoToGoal", STRAIGHT, speed=3)
        table = hedgehop.batch(CITY, self.folder / "batch", seeds=[1, 2], set=values, jobs=2)
        alone = [hedgehop.Simulation(CITY, set=STRAIGHT, seed=seed).run()["trajectory_hash"] for seed in (1, 2)]
        self.assertEqual(list(table.trajectory_hash), alone)


@unittest.skipIf(importlib.util.find_spec("cv2") is None, "python3-opencv is not installed")
class OpticFlow(unittest.TestCase):
    def fly(self, **parameters):
        from flow_balance_room import FlowBalance

        room = SOURCE / "configs/garratt2009_room_0_light.yaml"
        return hedgehop.Simulation(room, seed=1101, set={"duration": 24, "drawing.renderer": "tiles"}, module=FlowBalance(**parameters)).run()

    def test_it_avoids_the_walls_of_the_room_with_which_the_control_collides(self):
        seen, blind = self.fly(), self.fly(gain=0.0)
        self.assertEqual((seen["outcome"], blind["outcome"]), ("timeout", "collided"))
        self.assertGreater(seen["min_clearance_m"], 0.3)
        self.assertGreater(seen["path_length_m"], 10)


class Dodge:
    """Yaws by the number of its images."""

    needs = ["left", "right"]

    def update(self, observation):
        return hedgehop.HoverCommand(0.1 * len(observation.images))


class Forgetful:
    count = 0

    def update(self, observation):
        Forgetful.count += 1
        return hedgehop.HoverCommand(0.01 * Forgetful.count)


class Contract(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name) / "tree.yaml"
        self.tree.write_text(f"use: {TREE}\ndrawing: {{renderer: tiles}}\n")

    def test_a_good_module_passes(self):
        hedgehop.testing.check_module(Dodge, self.tree)

    def test_a_module_with_memory_across_flights_fails(self):
        with self.assertRaisesRegex(AssertionError, "equal inputs give different decisions"):
            hedgehop.testing.check_module(Forgetful, self.tree)

    def test_a_module_that_fails_without_images_fails(self):
        class Fragile:
            needs = ["left"]

            def update(self, observation):
                return hedgehop.HoverCommand(float(observation.images["left"].mean()) * 1e-3)

        with self.assertRaises(KeyError):
            hedgehop.testing.check_module(Fragile, self.tree)


if __name__ == "__main__":
    unittest.main()
