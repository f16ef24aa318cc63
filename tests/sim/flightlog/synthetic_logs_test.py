"""`hedgehop compare-log` and `identify --log` on logs whose motion has a closed form.

usage: synthetic_logs_test.py PROGRAM SOURCE
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
G = 9.81
RATE_HZ = 100
STATES = ["north_m", "east_m", "down_m", "roll_rad", "pitch_rad", "yaw_rad", "v_north_mps", "v_east_mps", "v_down_mps",
          "p_radps", "q_radps", "r_radps"]
MOTORS = [f"motor_{i}_radps" for i in range(4)]
QUADROTOR = """use: {source}/configs/vehicles/hummingbird.yaml
mass: {{mass: {mass}, inertia: [0.007, 0.007, 0.012]}}
body_drag: [0.0, 0.0, {drag}]
"""


class Logs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def quadrotor(self, mass=0.7, drag=0.0):
        file = self.folder / "quadrotor.yaml"
        file.write_text(QUADROTOR.format(source=SOURCE, mass=mass, drag=drag))
        return file

    def log(self, rows, name="log.csv"):
        """rows  dictionaries; missing states and motor speeds are 0."""
        file = self.folder / name
        columns = ["t_s"] + STATES + [key for key in rows[0] if key not in STATES and key != "t_s"]
        if not any(key.startswith(("motor", "pwm", "collective", "thrust", "cmd")) for key in columns):
            columns += MOTORS
        with file.open("w", newline="") as out:
            writer = csv.DictWriter(out, columns, restval=0.0)
            writer.writeheader()
            writer.writerows(rows)
        return file

    def call(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def compare(self, *arguments):
        status, out, errors = self.call("compare-log", *arguments, "--json")
        self.assertEqual(status, 0, errors)
        return {row["horizon_s"]: {state: values for state, values in row["rmse"].items()}
                for row in json.loads(out)["horizons"]}

    @staticmethod
    def times(seconds=6.0):
        return [i / RATE_HZ for i in range(int(seconds * RATE_HZ) + 1)]

    def fall(self, mass, drag, start_s=0.5):
        """A fall from rest with quadratic drag: v = v_t tanh(g t / v_t), z = v_t^2 / g ln cosh(g t / v_t)."""
        limit = math.sqrt(mass * G / drag)
        rows = []
        for t in self.times(4.0):
            s = G * (t + start_s) / limit
            rows.append({"t_s": t, "down_m": limit ** 2 / G * math.log(math.cosh(s)), "v_down_mps": limit * math.tanh(s),
                         "fx_mps2": 0.0, "fy_mps2": 0.0, "fz_mps2": -G * math.tanh(s) ** 2})
        return self.log(rows)


class CompareLog(Logs):
    def test_a_fall_without_drag_is_a_parabola(self):
        log = self.log([{"t_s": t, "down_m": 0.5 * G * t * t, "v_down_mps": G * t} for t in self.times()])
        found = self.compare(self.quadrotor(), log)
        self.assertEqual(sorted(found), [0.1, 0.5, 1.0, 2.0])
        for horizon, states in found.items():
            self.assertLess(states["down"]["model"], 1e-9)
            self.assertLess(states["w"]["model"], 1e-9)
            self.assertAlmostEqual(states["w"]["unchanged"], G * horizon, 9)
            self.assertAlmostEqual(states["w"]["constant_velocity"], G * horizon, 9)
            self.assertAlmostEqual(states["down"]["constant_velocity"], 0.5 * G * horizon ** 2, 9)

    def test_a_fall_with_drag_follows_the_hyperbolic_tangent(self):
        log = self.fall(0.7, 0.05)
        right = self.compare(self.quadrotor(0.7, 0.05), log)
        wrong = self.compare(self.quadrotor(0.7, 0.06), log)
        self.assertLess(right[2.0]["w"]["model"], 1e-6)
        self.assertGreater(wrong[2.0]["w"]["model"], 0.1)
        self.assertLess(right[1.0]["w"]["model"], right[1.0]["w"]["linear"])

    def test_the_force_error_is_that_of_the_drag(self):
        log = self.fall(0.7, 0.05)
        status, out, _ = self.call("compare-log", self.quadrotor(0.7, 0.05), log, "--json")
        self.assertEqual(status, 0)
        self.assertLess(json.loads(out)["force_rmse_n"], 1e-9)
        rows = list(csv.DictReader(log.open()))
        drag = [0.7 * float(row["fz_mps2"]) for row in rows]
        rms = math.sqrt(sum(force ** 2 for force in drag) / len(drag))
        _, out, _ = self.call("compare-log", self.quadrotor(0.7, 0.0), log, "--json")
        self.assertAlmostEqual(json.loads(out)["force_rmse_n"], rms, 9)

    def test_a_symmetric_body_precesses(self):
        """Free motion of a body with I_x = I_y: p and q turn at (I_z / I_x - 1) r."""
        rate, swing, spin = (0.012 / 0.007 - 1.0) * 2.0, 0.05, 2.0
        rows, attitude, steps = [], [1.0, 0.0, 0.0, 0.0], 200
        for i, t in enumerate(self.times()):
            p, q = swing * math.cos(rate * t), swing * math.sin(rate * t)
            rows.append({"t_s": t, "p_radps": p, "q_radps": q, "r_radps": spin, "down_m": 0.5 * G * t * t,
                         "v_down_mps": G * t, **dict(zip(("qw", "qx", "qy", "qz"), attitude))})
            for k in range(steps):  # the attitude by the midpoint rule, whose error is far below the tolerance
                s = t + (k + 0.5) / (steps * RATE_HZ)
                attitude = turned(attitude, (swing * math.cos(rate * s), swing * math.sin(rate * s), spin),
                                  1.0 / (steps * RATE_HZ))
        states = self.compare(self.quadrotor(), self.log(rows))[2.0]
        for name in ("p", "q", "r", "attitude"):
            self.assertLess(states[name]["model"], 1e-4, name)  # degrees
        self.assertGreater(states["attitude"]["unchanged"], 10.0)

    def test_the_linear_model_of_linear_data_is_exact(self):
        decay = math.exp(-0.4 / RATE_HZ)
        rows, v, x = [], 2.0, 0.0
        for i, t in enumerate(self.times()):
            speed = 400.0 + 20.0 * math.sin(3.0 * t) + 5.0 * math.sin(11.0 * t)
            rows.append({"t_s": t, "v_north_mps": v, "north_m": x, **{motor: speed for motor in MOTORS}})
            x += v / RATE_HZ
            v = decay * v + 0.001 * (speed - 400.0)
        states = self.compare(self.quadrotor(), self.log(rows))[1.0]
        self.assertLess(states["u"]["linear"], 1e-6)
        self.assertLess(states["north"]["linear"], 1e-6)
        self.assertGreater(states["u"]["unchanged"], 1e-3)

    def test_axes_with_z_up_are_the_same_flight(self):
        rows = [{"t_s": t, "down_m": 0.5 * G * t * t, "v_down_mps": G * t, "east_m": 3.0 * t, "v_east_mps": 3.0,
                 "yaw_rad": 0.3} for t in self.times()]
        frd = self.compare(self.quadrotor(), self.log(rows))
        flipped = [{key: -value if key in ("down_m", "v_down_mps", "east_m", "v_east_mps", "yaw_rad") else value
                    for key, value in row.items()} for row in rows]
        map_file = self.folder / "map.yaml"
        map_file.write_text("axes: flu\n")
        flu = self.compare(self.quadrotor(), self.log(flipped, "flu.csv"), "--columns", map_file)
        self.assertEqual(frd, flu)

    def test_inputs_with_z_up_are_the_same_flight(self):
        commands = {"cmd_v_north_mps": 1.0, "cmd_v_east_mps": 3.0, "cmd_altitude_m": 20.0, "cmd_heading_rad": 0.7}
        torques = {"thrust_n": 7.0, "roll_torque_nm": 0.001, "pitch_torque_nm": 0.002, "yaw_torque_nm": 0.003}
        reversed_keys = ("down_m", "cmd_v_east_mps", "cmd_heading_rad", "pitch_torque_nm", "yaw_torque_nm")
        (map_file := self.folder / "map.yaml").write_text("axes: flu\n")
        for inputs in (commands, torques):
            rows = [{"t_s": t, "down_m": -20.0, **inputs} for t in self.times(3.0)]
            flipped = [{key: -value if key in reversed_keys else value for key, value in row.items()} for row in rows]
            frd = self.compare(self.quadrotor(), self.log(rows))
            self.assertEqual(frd, self.compare(self.quadrotor(), self.log(flipped, "flu.csv"), "--columns", map_file))
            self.assertGreater(frd[1.0]["psi"]["model"], 0.1)

    def test_duty_cycles_lift_like_the_speeds_that_they_command(self):
        """At the duty cycle of the hover, voltage included, the vehicle keeps its place."""
        hover = math.sqrt(0.7 * G / 4.0 / 8.54858e-6)
        volts = 3.6
        duty = (hover / (volts / 4.0) - 100.0) / 900.0
        log = self.log([{"t_s": t, "battery": 1000.0 * volts, **{f"m{i}": 65535 * duty for i in range(4)}, "pwm_none": 0.0}
                        for t in self.times()])
        map_file = self.folder / "map.yaml"
        map_file.write_text("inputs: pwm\npwm: {at_zero: 100, per_duty: 900, voltage: 4.0, voltage_exponent: 1}\ncolumns:\n"
                            "  - {name: voltage_v, from: battery, scale: 0.001}\n" +
                            "".join(f"  - {{name: pwm_{i}, from: m{i}, scale: {1 / 65535!r}}}\n" for i in range(4)))
        self.assertLess(self.compare(self.quadrotor(), log, "--columns", map_file)[2.0]["down"]["model"], 1e-6)

    def test_positions_of_the_controls_act_without_lag(self):
        """A climb with a thrust that is constant between samples: the velocity is a polygon."""
        rows, v, z = [], 0.0, -20.0
        for t in self.times():
            thrust = 0.7 * G + 1.5 * math.sin(10.0 * t)
            rows.append({"t_s": t, "down_m": z, "v_down_mps": v, "thrust_n": thrust, "roll_torque_nm": 0.0,
                         "pitch_torque_nm": 0.0, "yaw_torque_nm": 0.0})
            a = G - thrust / 0.7
            z += v / RATE_HZ + 0.5 * a / RATE_HZ ** 2
            v += a / RATE_HZ
        log, map_file = self.log(rows), self.folder / "map.yaml"
        map_file.write_text("inputs: control_positions\n")
        self.assertLess(self.compare(self.quadrotor(), log, "--columns", map_file)[1.0]["w"]["model"], 1e-6)
        self.assertGreater(self.compare(self.quadrotor(), log)[1.0]["w"]["model"], 0.01)

    def test_a_trimmed_helicopter_keeps_its_trim_under_the_controls_and_under_setpoints(self):
        for speed in (0.0, 5.0):
            with self.subTest(speed=speed):
                self.keeps_its_trim(speed)

    def keeps_its_trim(self, speed):
        vehicle = SOURCE / "configs/vehicles/xcell_60.yaml"
        status, out, _ = self.call("trim", vehicle, "--speed", speed, "--json")
        self.assertEqual(status, 0)
        trim = {key: value for key, value in json.loads(out)[0].items()}
        state = {"roll_rad": math.radians(trim["phi"]), "pitch_rad": math.radians(trim["theta"]), "v_north_mps": speed,
                 "down_m": -10.0}
        controls = {"collective_rad": trim["theta_c"], "lateral_rad": trim["delta_lat"],
                    "longitudinal_rad": trim["delta_lon"], "tail_rad": trim["theta_t"]}
        log = self.log([{"t_s": t, "north_m": speed * t, **state,
                         **{key: math.radians(value) for key, value in controls.items()}}
                        for t in self.times(3.0)])
        held = self.compare(vehicle, log)[1.0]
        commands = {"cmd_v_north_mps": speed, "cmd_v_east_mps": 0.0, "cmd_altitude_m": 10.0, "cmd_heading_rad": 0.0}
        log = self.log([{"t_s": t, "north_m": speed * t, **state, **commands} for t in self.times(3.0)], "setpoints.csv")
        flown = self.compare(vehicle, log)[1.0]
        for states in (held, flown):
            self.assertLess(states["velocity"]["model"], 0.02)
            self.assertLess(states["attitude"]["model"], 0.5)  # degrees
            self.assertLess(states["rates"]["model"], 0.5)  # degrees per second


class ExampleFlight(Logs):
    """A flight by an implementation of the equations that shares no code with Hedgehop."""

    LOG = SOURCE / "configs/logs/hummingbird_example.csv"
    VEHICLE = SOURCE / "configs/vehicles/hummingbird.yaml"

    def test_the_hummingbird_flies_it(self):
        states = self.compare(self.VEHICLE, self.LOG)[2.0]
        for group, limit in (("position", 1e-3), ("velocity", 1e-3), ("attitude", 0.05), ("rates", 0.2)):
            self.assertLess(states[group]["model"], limit)
            self.assertGreater(states[group]["linear"], 10.0 * states[group]["model"])

    def test_the_file_is_the_flight(self):
        written = subprocess.run([sys.executable, SOURCE / "tests/sim/flightlog/example_flight.py"], capture_output=True,
                                 text=True, check=True).stdout
        for new, old in zip(csv.DictReader(written.splitlines()), csv.DictReader(self.LOG.read_text().splitlines()), strict=True):
            for name, value in new.items():
                self.assertAlmostEqual(float(value), float(old[name]), 5)

    def test_rotor_drag_is_identified(self):
        vehicle = self.folder / "wrong.yaml"
        vehicle.write_text(f"use: {self.VEHICLE}\nrotor: {{drag: 2.0e-5, torque: 0.02}}\n")
        status, out, errors = self.call("identify", vehicle, "--log", self.LOG, "--fit", "rotor.drag=0:1e-3", "--fit",
                                        "rotor.torque=0.005:0.05", "--fit", "rotor.radius=0.05:0.2", "--json")
        self.assertEqual(status, 0, errors)
        found = {row["name"]: row for row in json.loads(out)["parameters"]}
        self.assertAlmostEqual(found["rotor.drag"]["fitted"] / 8.06428e-5, 1.0, 3)
        self.assertAlmostEqual(found["rotor.torque"]["fitted"] / 0.016, 1.0, 3)
        self.assertEqual(found["rotor.radius"]["data"], "undetermined")  # it only sizes the hull


class IdentifyLog(Logs):
    def identify(self, vehicle, log, *fits, options=()):
        fit = [argument for text in fits for argument in ("--fit", text)]
        status, out, errors = self.call("identify", vehicle, "--log", log, *fit, *options, "--json")
        self.assertEqual(status, 0, errors)
        return {row["name"]: row for row in json.loads(out)["parameters"]}

    def test_drag_is_recovered_and_a_parameter_without_influence_is_undetermined(self):
        log = self.fall(0.7, 0.05)
        for options in ((), ("--horizon", "0")):
            found = self.identify(self.quadrotor(0.7, 0.01), log, "body_drag.2=0:0.2", "rotor.drag=0:1e-3", options=options)
            self.assertAlmostEqual(found["body_drag.2"]["fitted"], 0.05, 5)
            self.assertEqual(found["body_drag.2"]["data"], "determined")
            self.assertEqual(found["rotor.drag"]["data"], "undetermined")
            self.assertIsNone(found["rotor.drag"]["standard_error"])

    def test_mass_and_drag_are_undetermined_together(self):
        """A fall depends on their ratio only."""
        found = self.identify(self.quadrotor(0.7, 0.04), self.fall(0.7, 0.05), "body_drag.2=0.01:0.2", "mass.mass=0.3:1.5")
        self.assertAlmostEqual(found["body_drag.2"]["fitted"] / found["mass.mass"]["fitted"], 0.05 / 0.7, 4)
        self.assertEqual({row["data"] for row in found.values()}, {"undetermined"})

    def test_a_value_outside_the_bounds_ends_at_the_bound(self):
        found = self.identify(self.quadrotor(0.7, 0.01), self.fall(0.7, 0.05), "body_drag.2=0:0.03")
        self.assertEqual(found["body_drag.2"]["data"], "at its bound")
        self.assertAlmostEqual(found["body_drag.2"]["fitted"], 0.03, 9)

    def test_the_fitted_vehicle_is_a_file_that_flies_like_the_log(self):
        log, out = self.fall(0.7, 0.05), self.folder / "fitted.yaml"
        self.identify(self.quadrotor(0.7, 0.01), log, "body_drag.2=0:0.2", options=("--out", out))
        self.assertLess(self.compare(out, log, "--part", "second")[1.0]["w"]["model"], 1e-3)

    def test_columns_are_parameters_too(self):
        """A hover whose duty cycles need a factor that the map does not know."""
        hover = math.sqrt(0.7 * G / 4.0 / 8.54858e-6)
        log = self.log([{"t_s": t, **{f"pwm_{i}": hover / 1234.0 for i in range(4)}} for t in self.times()])
        map_file, out = self.folder / "map.yaml", self.folder / "columns.yaml"
        map_file.write_text("pwm: {per_duty: 1000}\n")
        found = self.identify(self.quadrotor(), log, "columns.pwm.per_duty=900:1500",
                              options=("--columns", map_file, "--out-columns", out))
        self.assertAlmostEqual(found["columns.pwm.per_duty"]["fitted"], 1234.0, 2)
        self.assertLess(self.compare(self.quadrotor(), log, "--columns", out)[1.0]["w"]["model"], 1e-4)


def turned(q, w, dt):
    """The unit quaternion (w, x, y, z) after the body turns by w dt."""
    angle = dt * math.sqrt(sum(x * x for x in w))
    scale = math.sin(angle / 2) / angle * dt
    c, (x, y, z) = math.cos(angle / 2), (scale * k for k in w)
    a, b, d, e = q
    return [a * c - b * x - d * y - e * z, a * x + b * c + d * z - e * y, a * y - b * z + d * c + e * x,
            a * z + b * y - d * x + e * c]


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
