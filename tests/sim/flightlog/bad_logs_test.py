"""`hedgehop compare-log` and `identify --log` refuse bad logs, column maps and options in one line.

usage: bad_logs_test.py PROGRAM SOURCE
"""

import math
import sys
import unittest

from synthetic_logs_test import MOTORS, SOURCE, Logs


class BadInput(Logs):
    def refused(self, *arguments):
        status, _, errors = self.call(*arguments)
        self.assertEqual(status, 2, errors)
        self.assertEqual(len(errors.strip().splitlines()), 1, errors)
        return errors

    def test_each_fault_is_one_line(self):
        quadrotor, log = self.quadrotor(), self.fall(0.7, 0.05)
        map_file = self.folder / "map.yaml"
        map_file.write_text("columns:\n  - {name: p_radp, from: p}\n")
        self.assertIn("did you mean 'p_radps'", self.refused("compare-log", quadrotor, log, "--columns", map_file))
        map_file.write_text("columns:\n  - {name: p_radps, from: gyro}\n")
        self.assertIn("no column 'gyro' for 'p_radps'", self.refused("compare-log", quadrotor, log, "--columns", map_file))
        short = self.log([{"t_s": t} for t in self.times(0.05)], "short.csv")
        self.assertIn("at least 10", self.refused("compare-log", quadrotor, short))
        back = self.log([{"t_s": 1.0 - t} for t in self.times(1.0)], "back.csv")
        self.assertIn("do not rise", self.refused("compare-log", quadrotor, back))
        other = self.log([{"t_s": t} for t in self.times(1.0)], "other.csv")
        other.write_text(other.read_text().replace("t_s", "time", 1))
        self.assertIn("the file has time, north_m, east_m", self.refused("compare-log", quadrotor, other))
        degrees = self.log([{"t_s": t, "pitch_rad": 9.0} for t in self.times(1.0)], "degrees.csv")
        self.assertIn("pitch_rad is 9 rad in row 1; valid: -2 pi to 2 pi; if the column is in degrees", self.refused("compare-log", quadrotor, degrees))
        heli, trim = SOURCE / "configs/vehicles/xcell_60.yaml", dict.fromkeys(("lateral_rad", "longitudinal_rad", "tail_rad"), 0.0)
        angle = self.log([{"t_s": t, "collective_rad": 7.48, **trim} for t in self.times(1.0)], "angle.csv")
        self.assertIn("collective_rad is 7.48 rad in row 1; valid: -pi / 2 to pi / 2; if the column is in degrees", self.refused("compare-log", heli, angle))
        rates = self.log([{"t_s": t, "roll_rad": 0.1 * math.sin(t), "p_radps": math.degrees(0.1 * math.cos(t))} for t in self.times(4.0)], "rates.csv")
        self.assertIn("if the columns are in deg/s, map them with scale: 0.0174533", self.refused("compare-log", quadrotor, rates))
        milliseconds = self.log([{"t_s": 1000.0 * t} for t in self.times(4.0)], "milliseconds.csv")
        for command in (("compare-log", quadrotor, milliseconds), ("identify", quadrotor, "--log", milliseconds, "--fit", "rotor.drag=0:1")):
            self.assertIn("a sample every 10 s, but the horizon is 0.", self.refused(*command))
        late = self.log([{"t_s": t, **{name: "" if t < 0.2 else 0.0 for name in (
            "cmd_v_north_mps", "cmd_v_east_mps", "cmd_altitude_m", "cmd_heading_rad")}} for t in self.times(1.0)], "late.csv")
        self.assertIn("no finite number in row 1; row 21 has the first", self.refused("compare-log", quadrotor, late))
        self.assertIn("--time t_s --from 0.2 -o CUT.csv", self.refused("compare-log", quadrotor, late))
        later = self.log([{"t_s": 8.0 + 0.125 * k, **dict.fromkeys(MOTORS, "" if k < 2 else 0.0)} for k in range(20)], "later.csv")
        self.assertIn("--time t_s --from 0.25 -o CUT.csv", self.refused("compare-log", quadrotor, later))  # from the first row
        plot = self.refused("compare-log", quadrotor, log, "--plot", self.folder / "errors.html")
        self.assertIn("would be written as .svg", plot)
        self.assertIn("collective_rad, lateral_rad", self.refused("compare-log", heli, log))
        commands = self.log([{"t_s": t, "cmd_v_north_mps": 1.0, "cmd_v_east_mps": 0.0, "cmd_altitude_m": 0.0,
                              "cmd_heading_rad": 0.0} for t in self.times(4.0)], "commands.csv")
        self.assertIn(f"{log} has 4 columns of motor_speeds, {commands} has 4 of setpoints; logs of one call need the same inputs",
                      self.refused("compare-log", quadrotor, log, commands))
        (self.folder / "slow").mkdir()
        slow = self.log([{"t_s": 2.0 * t} for t in self.times(4.0)], "slow/log.csv")
        self.assertIn(f"{log} has a sample every 0.01 s, {slow} every 0.02 s; logs of one call need the same rate",
                      self.refused("compare-log", quadrotor, log, slow))
        fit = ("identify", quadrotor, "--log", log)
        self.assertIn("--fit is missing", self.refused(*fit))
        self.assertIn("did you mean 'rotor.drag'", self.refused(*fit, "--fit", "rotor.drg=0:1"))
        self.assertIn("expected NAME=LOW:HIGH", self.refused(*fit, "--fit", "rotor.drag=1:0"))
        self.assertIn("must be >= 0", self.refused(*fit, "--fit", "rotor.drag=-1:1"))
        self.assertIn("--input with a control, or --log", self.refused("identify", quadrotor))

    def test_horizons_longer_than_the_log_and_positions_that_count_as_commands_are_warnings(self):
        controls = dict.fromkeys(("thrust_n", "roll_torque_nm", "pitch_torque_nm", "yaw_torque_nm"), 0.0)
        log = self.log([{"t_s": t, **controls, "model_valid": 1} for t in self.times(2.0)])
        status, out, errors = self.call("compare-log", self.quadrotor(), log, "--horizon", 0.5, "--horizon", 30)
        self.assertEqual((status, out.splitlines()[0]), (0, "inputs: controls"))
        self.assertIn("no window of 30 s fits", errors)
        self.assertIn(f"{log} is a table of Hedgehop", errors)
        (map_file := self.folder / "map.yaml").write_text("inputs: control_positions\n")
        status, out, errors = self.call("compare-log", self.quadrotor(), log, "--horizon", 0.5, "--columns", map_file)
        self.assertEqual((status, out.splitlines()[0], errors), (0, "inputs: control_positions", ""))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
