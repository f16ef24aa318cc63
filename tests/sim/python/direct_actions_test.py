"""Body rates with thrust and motor speeds fly the vehicle by its dynamics. The oracles are gravity and the commanded rates."""

import pickle
import unittest

import numpy as np

import hedgehop
from flights import CITY

QUADROTOR = {"vehicle": {"use": "vehicles/hummingbird.yaml"}, "command_latency": 0, "start.altitude": 30, "wind": {}, "duration": 1,
             "film.enabled": False, "drawing.renderer": "tiles"}


class DirectActions(unittest.TestCase):
    def fly(self, actions, action, steps=20):
        env = hedgehop.Env(CITY, cameras=["front"], set=QUADROTOR, actions=actions)
        env.reset(seed=1)
        for _ in range(steps):
            observation, *_ = env.step(action)
        self.assertTrue(env.observation_space.contains(observation))
        return observation, env._simulation.truth

    def test_of_zero_hover(self):
        for actions in ("rates", "motors"):
            _, truth = self.fly(actions, [0, 0, 0, 0])
            self.assertLess(np.linalg.norm(truth.v_WB_W_mps), 0.3, actions)

    def test_are_shares_of_the_rates_and_of_the_thrust(self):
        for axis, rate in ((0, np.pi), (1, np.pi), (2, np.pi / 2)):
            action = np.zeros(4)
            action[axis] = 0.25
            observation, truth = self.fly("rates", action, 12)
            self.assertAlmostEqual(truth.w_WB_B_radps[axis], 0.25 * rate, delta=0.1 * rate)
            np.testing.assert_allclose(observation["rates"], truth.w_WB_B_radps, atol=0.05)
        for actions in ("rates", "motors"):
            _, truth = self.fly(actions, [0, 0, 0, -1] if actions == "rates" else [-1] * 4)
            self.assertAlmostEqual(truth.v_WB_W_mps[2], 9.81 * 0.8, delta=1.0)  # free fall for 20 steps at 25 Hz

    def test_of_motors_have_one_number_per_rotor(self):
        env = hedgehop.Env(CITY, cameras=[], set={**QUADROTOR, "vehicle": {"use": "vehicles/firefly.yaml"}}, actions="motors")
        self.assertEqual(env.action_space.shape, (6,))
        with self.assertRaisesRegex(ValueError, "the vehicle is a helicopter"):
            hedgehop.Env(CITY, cameras=[], set={"film.enabled": False, "drawing.renderer": "tiles"}, actions="motors")

    def test_commands_can_be_pickled(self):
        for command in (hedgehop.BodyRateCommand([1, 2, 3], 0.5), hedgehop.MotorCommand([1, 2, 3, 4]), hedgehop.HoverCommand(0.5),
                        hedgehop.VelocityCommand([1, 2], 3, 4)):
            self.assertEqual(repr(pickle.loads(pickle.dumps(command))), repr(command))

    def test_ranges_of_commands_are_checked(self):
        sim = hedgehop.Simulation(CITY, set=QUADROTOR)
        for command, words in ((hedgehop.BodyRateCommand([0, 0, 0], 9.8), "valid: 0 .. 1"),
                               (hedgehop.BodyRateCommand([100, 0, 0], 0.5), "body rates"),
                               (hedgehop.MotorCommand([100] * 3), "3 motor speeds; the vehicle has 4 rotors"),
                               (hedgehop.MotorCommand([100] * 40), "at most 16 rotors"),
                               (hedgehop.MotorCommand([1e5] * 4), "valid: 0 .. 838")):
            with self.assertRaisesRegex(ValueError, words):
                sim.step(command)


if __name__ == "__main__":
    unittest.main()
