"""A policy gradient learns to pass a tree. The reward is from the metrics; the inputs are those of a module.

Parameter-exploring policy gradients [Sehnke2010]: a linear policy whose parameters are drawn once per flight, in
symmetric pairs.
"""

import unittest

import numpy as np

import hedgehop
from flights import SOURCE

TREE = SOURCE / "configs/leaderboard/worlds/tree.yaml"
SETTINGS = {"vehicle.use": "../../vehicles/hummingbird.yaml", "drawing.renderer": "tiles", "duration": 20,
            "start.north": -15, "goal.north": 15, "film.enabled": False, "avoidance": {"module": "go_to_goal"},
            "rig.cameras": [{"role": "front", "width": 64, "height": 48, "fov": 90, "rate": 5, "channel": "grey"},
                            {"role": "down", "width": 64, "height": 48, "fov": 60, "rate": 25, "channel": "grey",
                             "pitch": -90}]}
PAIRS, ROUNDS = 6, 20


def features(observation):
    """Returns the direction of the goal, the sideways velocity, and the brightness of the left, the middle and the right."""
    forward_m, right_m = observation["state"][:2]
    band = observation["front"][16:32] / 255.0
    left, middle, right = (band[:, columns].mean() for columns in (slice(0, 21), slice(21, 43), slice(43, 64)))
    return np.array([1.0, forward_m / 15.0, right_m / 5.0, observation["state"][4], left - right, middle - 0.5])


def fly(env, parameters, seed=None):
    observation, _ = env.reset(seed=seed)
    earned, info = 0.0, {}
    while "result" not in info:
        aside = np.tanh(parameters @ features(observation))
        observation, reward, _, _, info = env.step([0.7, aside, 0.0, 0.0])
        earned += reward
    return earned, info["result"]["outcome"]


def learn(env):
    random = np.random.default_rng(1)
    mean, spread = np.zeros(6), np.full(6, 1.0)
    earned = []
    for _ in range(ROUNDS):
        steps, gains, heights = [], [], []
        for _ in range(PAIRS):
            step = spread * random.standard_normal(6)
            up, down = (fly(env, mean + sign * step)[0] for sign in (1, -1))
            steps.append(step)
            gains.append(0.5 * (up - down))
            heights.append(0.5 * (up + down))
        scale = np.std(gains) + np.std(heights) + 1e-6
        steps = np.array(steps)
        mean = mean + 0.3 * np.mean(np.array(gains)[:, None] / scale * steps, 0)
        surprise = (np.array(heights) - np.mean(heights))[:, None] / scale * (steps**2 - spread**2) / spread
        spread = np.clip(spread + 0.1 * np.mean(surprise, 0), 0.2, 2.0)
        earned.append(np.mean(heights))
    return mean, earned


class PolicyGradient(unittest.TestCase):
    def test_gets_past_the_tree(self):
        env = hedgehop.Env(TREE, cameras=["front"], set=SETTINGS)
        env.reset(seed=1)
        parameters, earned = learn(env)
        untrained = [fly(env, np.zeros(6), seed)[1] for seed in range(101, 111)]
        trained = [fly(env, parameters, seed)[1] for seed in range(101, 111)]
        self.assertLessEqual(untrained.count("reached"), 2)
        self.assertGreaterEqual(trained.count("reached"), 8, (parameters, earned))


if __name__ == "__main__":
    unittest.main()
