"""Whatever a module in Python does in any of its calls, the flight ends in a verdict."""

import itertools
import json
import os
import pathlib
import subprocess
import tempfile
import textwrap
import unittest

from flights import PROGRAM, SOURCE

MODULE = textwrap.dedent("""
    import atexit
    import ctypes
    import os
    import sys

    import hedgehop


    class Odd(BaseException):
        pass


    def spin():
        while True:
            pass


    def allocate():
        while True:
            bytearray(100_000)


    def raise_it(kind):
        raise kind


    def recurse():
        return recurse()


    def close():
        os.closerange(0, 1000)


    def exit_child():
        if os.fork() == 0:
            os._exit(0)


    ACTIONS = {
        "none": lambda: None,
        "exit": lambda: os._exit(0),
        "abort": os.abort,
        "segfault": lambda: ctypes.string_at(0),
        "close": close,
        "kill": lambda: os.kill(os.getpid(), 9),
        "sys_exit": lambda: sys.exit(0),
        "odd": lambda: raise_it(Odd),
        "refuse": lambda: raise_it(ValueError),
        "interrupt": lambda: raise_it(KeyboardInterrupt),
        "recurse": recurse,
        "spin": spin,
        "allocate": allocate,
        "chdir": lambda: os.chdir("/"),
        "fork": os.fork,
        "exit_child": exit_child,
        "print": lambda: print("text of the module", flush=True),
        "at_exit": lambda: atexit.register(lambda: os._exit(0)),
    }


    class Hostile:
        def __init__(self, how="none", place="update"):
            self.how, self.place, self.decisions = how, place, 0
            self.act("constructor")

        def act(self, place):
            if place == self.place:
                ACTIONS[self.how]()

        @property
        def needs(self):
            self.act("needs")
            return []

        @property
        def signals(self):
            self.act("signals")
            return {"count": ""}

        def reset(self, setup):
            self.act("reset")

        def update(self, observation):
            self.decisions += 1
            if self.decisions == 3:
                self.act("update")
            return hedgehop.Decision(hedgehop.VelocityCommand([1.0, 0.0], 5.0, 0.0), "cruise", [self.decisions])

        def metrics(self):
            self.act("metrics")
            return {"decisions": self.decisions}

        def annotate(self):
            self.act("annotate")
            return None

        def __del__(self):
            self.act("destructor")
    """)

SCENARIO = """use: {source}/configs/garratt2009_room_0_light.yaml
name: hostile
duration: 0.3
scene: {{texture_size: 64}}
velocimeter: {{enabled: false}}
rig: {{cameras: []}}
drawing: {{renderer: tiles}}
film: {{enabled: {film}}}
avoidance: {{python: hostile.py, class: Hostile, limit: 1, parameters: {{how: {how}, place: {place}}}}}
goal: {{north: 5, east: 0, altitude: 1, radius: 1}}
checks: [{{check: no_collision}}]
"""
BEFORE = ["constructor", "needs", "signals", "reset"]
IN_FLIGHT = ["update", "metrics"]
WITHOUT_EFFECT = ["annotate", "destructor"]
ENDS = ["exit", "abort", "segfault", "close", "kill"]
RAISES = ["sys_exit", "odd", "interrupt", "recurse"]
ENDLESS = ["spin", "allocate"]
HARMLESS = ["chdir", "fork", "exit_child", "print", "at_exit"]
ALL = "HEDGEHOP_ATTACKS" in os.environ


def some(actions, places, step):
    """Returns every action in every place if requested (scripts/soak), otherwise a part."""
    attacks = list(itertools.product(places, actions))
    return attacks if ALL else attacks[::step]


class HostileModule(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "hostile.py").write_text(MODULE)
        cls.status, cls.whole = cls.fly("none", "update")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def fly(cls, how, place):
        """Returns the exit status and the result, which is also the printed one; None without a result."""
        out = cls.folder / f"{how}-{place}"
        film = place == "annotate"
        scenario = cls.folder / "hostile.yaml"
        scenario.write_text(SCENARIO.format(source=SOURCE, how=how, place=place, film=str(film).lower()))
        done = subprocess.run([PROGRAM, "run", scenario, *([] if film else ["--no-video"]), "--no-report", "--json", "--out", out],
                              capture_output=True, text=True)
        file = out / "result.json"
        if not file.exists():
            return done.returncode, None
        result = json.loads(file.read_text())
        if json.loads(done.stdout)["trajectory_hash"] != result["trajectory_hash"]:
            raise AssertionError("the printed result is another one")
        return done.returncode, result

    def expect_fault(self, place, how):
        with self.subTest(place=place, how=how):
            status, result = self.fly(how, place)
            self.assertEqual((status, result["outcome"]), (1, "fault"), result)
            flown = {"update": 2, "metrics": self.whole["decisions"]}.get(place, 0)
            self.assertEqual(result["decisions"], flown)

    def expect_no_effect(self, place, how):
        with self.subTest(place=place, how=how):
            status, result = self.fly(how, place)
            self.assertEqual((status, result["outcome"]), (0, "timeout"), result)
            self.assertEqual(result["trajectory_hash"], self.whole["trajectory_hash"])

    def test_without_an_attack_it_flies(self):
        self.assertEqual((self.status, self.whole["outcome"]), (0, "timeout"))

    def test_an_end_of_the_process_is_a_fault(self):
        for place, how in some(ENDS, BEFORE + IN_FLIGHT, 4):
            self.expect_fault(place, how)

    def test_an_exception_is_a_fault(self):
        for place, how in some(RAISES, BEFORE + IN_FLIGHT, 3):
            self.expect_fault(place, how)

    def test_a_value_error_before_the_flight_refuses_the_parameters(self):
        for place in BEFORE:
            with self.subTest(place=place):
                self.assertEqual(self.fly("refuse", place), (2, None))

    def test_no_return_is_a_fault(self):
        for place, how in some(ENDLESS, IN_FLIGHT + (BEFORE if ALL else []), 3):
            self.expect_fault(place, how)

    def test_annotate_and_the_destructor_do_not_change_the_flight(self):
        for place, how in some(ENDS + RAISES + ENDLESS, WITHOUT_EFFECT, 4):
            self.expect_no_effect(place, how)

    def test_folder_output_and_processes_of_the_simulator_stay_as_they_are(self):
        for place, how in some(HARMLESS, BEFORE + IN_FLIGHT + WITHOUT_EFFECT, 6):
            self.expect_no_effect(place, how)


if __name__ == "__main__":
    unittest.main()
