"""The environment has the protocol of Gymnasium and is deterministic in its seeds."""

import copy
import functools
import pickle
import unittest
import warnings

import numpy as np

import hedgehop
from flights import CITY

SETTINGS = {"duration": 0.6, "film.enabled": False, "drawing.renderer": "tiles", "avoidance": {"module": "go_to_goal"}}


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
        self.env.reset(seed=1)
        for bad in ([0, 0, 0], [np.nan, 0, 0, 0], "fly", None):
            with self.assertRaises((TypeError, ValueError)):
                self.env.step(bad)
        with self.assertRaisesRegex(ValueError, "unknown 'clerance'; valid: progress"):
            hedgehop.Env(CITY, rewards={"clerance": 1})
        with self.assertRaisesRegex(ValueError, "actions: 'torque'; valid: velocity, rates, motors"):
            hedgehop.Env(CITY, actions="torque")
        with self.assertRaisesRegex(ValueError, "depth_far_m: -1; must be > 0 m"):
            hedgehop.Env(CITY, depth_far_m=-1)

    def test_calls_without_a_flight_name_the_missing_call(self):
        env = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "duration": 0.1}, render_mode="rgb_array")
        for call in (lambda: env.step([0, 0, 0, 0]), env.render):
            with self.assertRaisesRegex(RuntimeError, r"call reset\(\) first"):
                call()
        env.reset(seed=1)
        while not env.step([0, 0, 0, 0])[3]:
            pass
        with self.assertRaisesRegex(RuntimeError, r"the flight is over; reset\(\)"):
            env.step([0, 0, 0, 0])
        env.close()
        env.close()
        for call in (lambda: env.step([0, 0, 0, 0]), env.render, env.reset):
            with self.assertRaisesRegex(RuntimeError, "the environment is closed"):
                call()

    def test_a_copy_is_a_new_environment_with_equal_arguments(self):
        self.env.reset(seed=3)
        self.env.step([1, 0, 0, 0])
        factory = functools.partial(hedgehop.Env, str(CITY), cameras=["front"], set=SETTINGS, render_mode="rgb_array")
        flown = fly(self.env, 8, 4)
        for env in (copy.deepcopy(self.env), pickle.loads(pickle.dumps(self.env)), pickle.loads(pickle.dumps(factory))()):
            with self.assertRaisesRegex(RuntimeError, "call reset"):
                env.step([0, 0, 0, 0])
            for a, b in zip(fly(env, 8, 4), flown):
                np.testing.assert_array_equal(a, b)

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


class Images(unittest.TestCase):
    DURATION_S = 2.0

    def env(self, drop=0.0, **camera):
        values = {f"rig.cameras.2.{key}": value for key, value in camera.items()}
        return hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, **values, "rig.cameras.2.imperfections": {"drop": drop},
                                                          "duration": self.DURATION_S, "world_seed": 1})

    def test_are_rows_by_columns_by_channels(self):
        for channel, channels in (("grey", 1), ("color", 3), ("depth", 1)):
            env = self.env(channel=channel, height=96)
            observation, _ = env.reset(seed=1)
            self.assertEqual(observation["front"].shape, (96, 200, channels))
            self.assertTrue(env.observation_space.contains(observation))
            seen = env._simulation.observation.images["front"]
            if channel != "depth":
                np.testing.assert_array_equal(observation["front"].squeeze(), seen.squeeze())

    def test_their_space_does_not_depend_on_which_of_them_are_lost(self):
        spaces = []
        for seed in range(1, 9):
            env = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "seed": seed, "rig.cameras.2.imperfections": {"drop": 0.5}})
            spaces.append(repr(env.observation_space))
            self.assertTrue(env.observation_space.contains(env.reset(seed=seed)[0]))
        held = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "start.hold": 0.2})
        self.assertEqual({*spaces, repr(held.observation_space)}, {repr(self.env().observation_space)})
        self.assertFalse(held.reset(seed=1)[0]["front"].any())

    def test_no_flight_returns_an_image_of_the_flight_before(self):
        fresh, used = self.env(drop=0.6), self.env(drop=0.6)
        used.reset(seed=99)
        lost = 0
        for seed in range(12):
            for _ in range(4):
                used.step([1, 0, 0, 1.0])
            first, again = fresh.reset(seed=seed)[0]["front"], used.reset(seed=seed)[0]["front"]
            np.testing.assert_array_equal(first, again)
            lost += not first.any()
        self.assertGreater(lost, 0)  # some first images are lost: black
        self.assertLess(lost, 12)

    def test_of_depth_are_finite_and_far_stands_for_no_surface(self):
        for lens in ({}, {"model": "fisheye", "fov": 180}):
            env = self.env(channel="depth", **lens)
            observation, _ = env.reset(seed=1)
            raw = env._simulation.observation.images["front"]
            self.assertFalse(np.isfinite(raw).all())
            self.assertTrue(env.observation_space.contains(observation))
            expected = np.where(np.isfinite(raw) & (raw < 100), raw, 100)
            np.testing.assert_array_equal(observation["front"][:, :, 0], expected)
            self.assertEqual((env.observation_space["front"].low.min(), env.observation_space["front"].high.max()), (0, 100))

    def test_an_observation_is_the_callers_own(self):
        env = self.env(drop=0.6)
        env.reset(seed=1)
        first = env.step([0, 0, 0, 0])[0]["front"]
        kept = first.copy()
        for _ in range(5):
            env.step([1, 0, 0, 0])[0]["front"][...] = 7
        np.testing.assert_array_equal(first, kept)

    def test_a_camera_of_corners_is_refused(self):
        with self.assertRaisesRegex(hedgehop.InputError, "'front' delivers corners"):
            self.env(channel="corners")

    def test_the_rate_of_frames_is_that_of_the_fastest_camera(self):
        for rate in (20, 12.5):
            env = self.env(rate=rate)
            self.assertEqual(env.metadata["render_fps"], rate)
            env.reset(seed=1)
            steps = 1
            while not env.step([0, 0, 0, 0])[3]:
                steps += 1
            self.assertEqual(steps, self.DURATION_S * rate)


class Options(unittest.TestCase):
    def test_set_scenario_keys_for_one_flight(self):
        env = hedgehop.Env(CITY, cameras=["front"], set=SETTINGS)
        usual = env.reset(seed=1)[1]["p_WB_true_m"]
        moved = env.reset(seed=1, options={"start.altitude": 17.5, "duration": 0.2})[1]["p_WB_true_m"]
        self.assertAlmostEqual(moved[2], -17.5)
        steps = 1
        while not env.step([0, 0, 0, 0])[3]:
            steps += 1
        self.assertEqual(steps, 5)  # 0.2 s at 25 Hz
        np.testing.assert_array_equal(env.reset(seed=1)[1]["p_WB_true_m"], usual)
        fresh = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "start.altitude": 17.5})
        for a, b in zip(env.reset(seed=4, options={"start.altitude": 17.5})[0].values(), fresh.reset(seed=4)[0].values()):
            np.testing.assert_array_equal(a, b)

    def test_that_are_invalid_leave_the_environment_usable(self):
        env = hedgehop.Env(CITY, cameras=["front"], set=SETTINGS)
        for options, words in (({"nonsense": 1}, "unknown key 'nonsense'"), ({"duration": -1}, "duration"),
                               ({"rig.cameras.2.width": 64}, "change the observation"), ({"seed": -1}, "options..seed..: -1"),
                               ({"seed": "a"}, "integer from 0"), ({"world_seed": 1.5}, "options..world_seed")):
            with self.assertRaisesRegex(hedgehop.InputError, words):
                env.reset(seed=1, options=options)
        env.reset(seed=1)
        env.step([0, 0, 0, 0])

    def test_seed_noise_and_world_apart(self):
        settings = {**SETTINGS, "wind": {}, "start.spread": 2, "rig.cameras.2.imperfections": {"read_noise": 20, "full_well": 3000}}
        env = hedgehop.Env(CITY, cameras=["front"], set=settings)

        def start(**options):
            observation, info = env.reset(seed=1, options=options)
            return observation["front"], env._simulation.image("front", "depth").copy(), info["p_WB_true_m"]

        image, depth, place = start(world_seed=3, seed=1)
        other_noise = start(world_seed=3, seed=2)
        self.assertFalse(np.array_equal(other_noise[0], image))
        np.testing.assert_array_equal(other_noise[1], depth)  # the same world from the same place
        np.testing.assert_array_equal(other_noise[2], place)
        other_world = start(world_seed=4, seed=1)
        self.assertFalse(np.array_equal(other_world[1], depth))
        np.testing.assert_array_equal(start(world_seed=3, seed=1)[0], image)

    def test_a_world_of_the_scenario_remains_from_flight_to_flight(self):
        env = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "start.spread": 2, "world_seed": 8})
        places = [env.reset(seed=seed)[1]["p_WB_true_m"] for seed in (1, 2)]
        np.testing.assert_array_equal(*places)
        free = hedgehop.Env(CITY, cameras=["front"], set={**SETTINGS, "start.spread": 2})
        self.assertFalse(np.array_equal(*[free.reset(seed=seed)[1]["p_WB_true_m"] for seed in (1, 2)]))


if __name__ == "__main__":
    unittest.main()
