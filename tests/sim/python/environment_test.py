"""The environment has the protocol of Gymnasium and is deterministic in its seeds, also in several processes."""

import unittest
import warnings

import numpy as np

import hedgehop
from flights import CITY

SETTINGS = {"duration": 0.6, "film.enabled": False}


def actions(count):
    return np.random.default_rng(3).uniform(-1, 1, (count, 4))


def fly(env, seed, count):
    """Returns all outputs of an environment for several steps, across ends of flights."""
    said = [env.reset(seed=seed)[0]["state"]]
    for action in actions(count):
        observation, reward, terminated, truncated, info = env.step(action)
        said += [observation["state"], observation["front"].copy(), np.array([reward, terminated, truncated])]
        if terminated or truncated:
            said.append(env.reset()[0]["state"])
    return said


class Alone(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.env = hedgehop.Env(CITY, cameras=["front"], set=SETTINGS, render_mode="rgb_array")

    def test_protocol(self):
        env = self.env
        observation, info = env.reset(seed=1)
        self.assertTrue(env.observation_space.contains(observation))
        self.assertIn("clearance_m", info)
        for _ in range(3):
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
            self.assertTrue(env.observation_space.contains(observation))
            self.assertEqual([type(v) for v in (reward, terminated, truncated)], [float, bool, bool])
        self.assertEqual(env.render().shape, (200, 200, 3))

    def test_timeout_is_truncation_and_collision_is_termination(self):
        self.env.reset(seed=1)
        steps = 0
        while True:
            steps += 1
            _, _, terminated, truncated, info = self.env.step(np.zeros(4))
            if terminated or truncated:
                break
        self.assertEqual((terminated, truncated, steps), (False, True, 15))  # 25 Hz
        self.assertEqual(info["result"]["outcome"], "timeout")
        low = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "duration": 20, "start.altitude": 0.6})
        low.reset(seed=1)
        rewards = []
        while True:
            _, reward, terminated, truncated, info = low.step([0, 0, -1, 0])
            rewards.append(reward)
            if terminated or truncated:
                break
        self.assertEqual((terminated, info["result"]["outcome"]), (True, "collided"))
        self.assertLess(rewards[-1], -99)

    def test_progress_reward_is_the_approach_to_the_goal_in_meters(self):
        env = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "duration": 4}, rewards={"near": 0.0})
        _, first = env.reset(seed=2)
        goal = env._simulation.observation.goal.p_WG_m
        earned = 0.0
        for _ in range(60):
            _, reward, _, _, info = env.step([0.5, 0, 0, 0])
            earned += reward
        nearer_m = np.linalg.norm(goal - first["p_WB_true_m"]) - np.linalg.norm(goal - info["p_WB_true_m"])
        self.assertGreater(nearer_m, 0.5)
        self.assertAlmostEqual(earned, nearer_m, places=9)

    def test_an_action_is_a_share_of_its_rate(self):
        env = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "duration": 8})
        for action, name, rate in (([0, 0, 1, 0], "down_m", -1.0), ([0, 0, -0.5, 0], "down_m", 0.5),
                                   ([0, 0, 0, 0.5], "yaw_rad", 0.5)):
            env.reset(seed=2)
            while not env.step(action)[3]:
                pass
            trajectory = env._simulation.trajectory
            moved = np.unwrap(trajectory[name]) if name == "yaw_rad" else trajectory[name]
            self.assertAlmostEqual((moved[-1] - moved[300]) / 5.0, rate, delta=0.2 * abs(rate), msg=action)

    def test_equal_seeds_give_equal_flights_and_others_do_not(self):
        first, again, other = (fly(self.env, seed, 20) for seed in (4, 4, 5))
        for a, b in zip(first, again):
            np.testing.assert_array_equal(a, b)
        self.assertFalse(all(np.array_equal(a, b) for a, b in zip(first, other)))

    def test_bad_calls(self):
        for bad in ([0, 0, 0], [np.nan, 0, 0, 0], "fly", None):
            with self.assertRaises((TypeError, ValueError)):
                self.env.step(bad)
        with self.assertRaisesRegex(ValueError, "unknown 'clerance'; valid: progress"):
            hedgehop.Env(CITY, rewards={"clerance": 1})

    def test_passes_the_check_of_gymnasium(self):
        try:
            from gymnasium.utils.env_checker import check_env
        except ImportError:
            self.skipTest("needs gymnasium")
        import gymnasium

        env = gymnasium.make("hedgehop/Avoid-v0", scenario=str(CITY), cameras=["front"], set=SETTINGS)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", "(.|\n)*(infinity|render)")  # the state has infinite bounds; rendering is optional
            check_env(env.unwrapped)


class Several(unittest.TestCase):
    def fly(self, seed):
        with hedgehop.VectorEnv(str(CITY), 2, cameras=["front"], set=SETTINGS) as envs:
            observation, _ = envs.reset(seed=seed)
            said = [observation["state"]]
            for action in actions(20):
                observation, reward, terminated, truncated, infos = envs.step(np.stack([action, -action]))
                said += [observation["state"], observation["front"], reward, terminated, truncated]
                self.assertEqual(["final_info" in info for info in infos], list(terminated | truncated))
        return said

    def test_two_processes_are_deterministic_in_the_seed_and_differ_from_one_another(self):
        first, again = self.fly(6), self.fly(6)
        for a, b in zip(first, again):
            np.testing.assert_array_equal(a, b)
        self.assertFalse(np.array_equal(first[0][0], first[0][1]))

    def test_a_fault_in_a_process_is_reported_and_the_others_continue(self):
        with hedgehop.VectorEnv(str(CITY), 2, cameras=["front"], set=SETTINGS) as envs:
            first, _ = envs.reset(seed=1)
            with self.assertRaisesRegex(ValueError, "actions: .3,"):
                envs.step(np.zeros((3, 4)))
            with self.assertRaisesRegex(RuntimeError, "environment 0: (.|\n)*four finite numbers"):
                envs.step([[np.nan, 0, 0, 0], [0, 0, 0, 0]])
            again, _ = envs.reset(seed=1)
            np.testing.assert_array_equal(first["state"], again["state"])


if __name__ == "__main__":
    unittest.main()
