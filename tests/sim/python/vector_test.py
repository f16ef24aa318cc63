"""Parallel environments have the protocol of Gymnasium, are deterministic, and report their faults."""

import os
import pathlib
import signal
import unittest

import numpy as np

import hedgehop
from flights import CITY
from hedgehop._shared import FOLDER, SharedArrays

SETTINGS = {"duration": 0.4, "film.enabled": False, "drawing.renderer": "tiles"}
OPTIONS = {"cameras": ["front"], "set": SETTINGS}
HOVER = np.zeros((2, 4))


def actions(count):
    return np.random.default_rng(3).uniform(-1, 1, (count, 4))


def vector(**more):
    return hedgehop.VectorEnv(str(CITY), 2, **{**OPTIONS, **more})


class Flights(unittest.TestCase):
    def fly(self, seed):
        with vector() as envs:
            observation, _ = envs.reset(seed=seed)
            said = [observation["state"]]
            for action in actions(20):
                observation, reward, terminated, truncated, infos = envs.step(np.stack([action, -action]))
                said += [observation["state"], observation["front"], reward, terminated, truncated]
                self.assertEqual(["final_info" in infos[i] for i in range(2)], list(terminated | truncated))
            said.append(envs.reset()[0]["state"])
        return said

    def test_two_processes_are_deterministic_in_the_seed_and_differ_from_one_another(self):
        first, again = self.fly(6), self.fly(6)
        for a, b in zip(first, again):
            np.testing.assert_array_equal(a, b)
        self.assertFalse(np.array_equal(first[0][0], first[0][1]))

    def test_each_environment_flies_as_one_alone_with_its_last_observation(self):
        alone = hedgehop.Env(CITY, **OPTIONS)
        with vector() as envs:
            first, _ = envs.reset(seed=[11, 12])
            np.testing.assert_array_equal(first["state"][1], alone.reset(seed=12)[0]["state"])
            for action in actions(12):
                seen, reward, terminated, truncated, infos = envs.step(np.stack([action, action]))
                expected, expected_reward, ended, over, info = alone.step(action)
                self.assertEqual((reward[1], terminated[1], truncated[1]), (expected_reward, ended, over))
                if ended or over:
                    for key, value in expected.items():
                        np.testing.assert_array_equal(infos["final_obs"][1][key], value)
                    self.assertEqual(infos[1]["final_info"]["result"]["trajectory_hash"], info["result"]["trajectory_hash"])
                    self.assertTrue(infos["_final_obs"].all())
                    expected, info = alone.reset()
                else:
                    self.assertNotIn("final_obs", infos)
                for key, value in expected.items():
                    np.testing.assert_array_equal(seen[key][1], value)
                self.assertEqual(infos["clearance_m"][1], info["clearance_m"])
                np.testing.assert_array_equal(infos[1]["p_WB_true_m"], info["p_WB_true_m"])

    def test_next_step_starts_the_next_flight_a_step_later(self):
        with vector(autoreset_mode="NextStep") as envs:
            start, _ = envs.reset(seed=1)
            over = np.zeros(2, bool)
            while not over.any():
                last, _, _, over, infos = envs.step(HOVER)
                self.assertNotIn("final_obs", infos)
            self.assertIn("result", infos[0])
            seen, reward, terminated, truncated, _ = envs.step(HOVER)
            self.assertEqual((list(reward), terminated.any(), truncated.any()), ([0.0, 0.0], False, False))
            self.assertFalse(np.array_equal(seen["front"], last["front"]))

    def test_without_autoreset_a_mask_restarts_flights(self):
        with vector(autoreset_mode="Disabled") as envs:
            envs.reset(seed=1)
            while not envs.step(HOVER)[3].any():
                pass
            with self.assertRaisesRegex(RuntimeError, "the flight is over"):
                envs.step(HOVER)
            envs.reset(options={"reset_mask": np.array([True, False])})
            with self.assertRaisesRegex(RuntimeError, "environment 1: (.|\n)*the flight is over"):
                envs.step(HOVER)
            envs.reset(options={"start.altitude": 20})
            envs.step(HOVER)
            with self.assertRaisesRegex(ValueError, "reset_mask"):
                envs.reset(options={"reset_mask": [1, 0, 1]})

    def test_spaces_and_metadata_are_those_of_one_and_of_all(self):
        with vector(render_mode="rgb_array") as envs:
            observation, _ = envs.reset(seed=1)
            self.assertEqual(envs.single_observation_space["front"].shape, (200, 200, 1))
            self.assertEqual(envs.observation_space["front"].shape, (2, 200, 200, 1))
            self.assertEqual((envs.action_space.shape, envs.single_action_space.shape), ((2, 4), (4,)))
            self.assertTrue(envs.observation_space.contains(observation))
            self.assertEqual((envs.metadata["render_fps"], envs.metadata["autoreset_mode"].value), (25, "SameStep"))
            self.assertEqual([image.shape for image in envs.render()], [(200, 200, 3)] * 2)

    def test_is_a_vector_environment_of_gymnasium(self):
        try:
            import gymnasium
        except ImportError:
            self.skipTest("needs gymnasium")
        with gymnasium.make_vec("hedgehop/Avoid-v0", num_envs=2, scenario=str(CITY), **OPTIONS) as envs:
            self.assertIsInstance(envs, gymnasium.vector.VectorEnv)
            recorded = gymnasium.wrappers.vector.RecordEpisodeStatistics(envs)
            recorded.reset(seed=1)
            while True:
                *_, truncated, infos = recorded.step(HOVER)
                if truncated.any():
                    break
            self.assertEqual(list(infos["episode"]["l"]), [10, 10])  # 0.4 s at 25 Hz


class Faults(unittest.TestCase):
    def test_of_an_action_are_reported_and_the_others_continue(self):
        with vector() as envs:
            first, _ = envs.reset(seed=1)
            with self.assertRaisesRegex(ValueError, "actions: .3,"):
                envs.step(np.zeros((3, 4)))
            with self.assertRaisesRegex(RuntimeError, "environment 0: (.|\n)*4 finite numbers"):
                envs.step([[np.nan, 0, 0, 0], [0, 0, 0, 0]])
            again, _ = envs.reset(seed=1)
            np.testing.assert_array_equal(first["state"], again["state"])

    def test_calls_without_a_flight_name_the_missing_call(self):
        envs = vector()
        with self.assertRaisesRegex(RuntimeError, r"call reset\(\) first"):
            envs.step(HOVER)
        with self.assertRaisesRegex(ValueError, "seed: 3 values"):
            envs.reset(seed=[1, 2, 3])
        envs.close()
        envs.close()
        for call in (lambda: envs.step(HOVER), envs.reset, envs.render):
            with self.assertRaisesRegex(RuntimeError, "the VectorEnv is closed"):
                call()
        with self.assertRaisesRegex(ValueError, "num_envs: 0"):
            hedgehop.VectorEnv(str(CITY), 0)
        with self.assertRaisesRegex(ValueError, "Sometimes"):
            vector(autoreset_mode="Sometimes")

    def test_a_process_that_dies_is_named_with_its_signal(self):
        envs = vector()
        memory = pathlib.Path(FOLDER, envs._shared.name)
        self.assertTrue(memory.exists())
        envs.reset(seed=1)
        os.kill(envs._workers[1].pid, signal.SIGKILL)
        for _ in range(2):
            with self.assertRaisesRegex(RuntimeError, "environment 1: its process was ended by SIGKILL"):
                envs.step(HOVER)
        envs.close()
        self.assertFalse(envs._workers[0].is_alive())
        self.assertFalse(memory.exists())

    def test_too_little_shared_memory_is_an_error_with_both_sizes(self):
        with self.assertRaisesRegex(OSError, r"need 1125899906.8 MB of shared memory, and /dev/shm has [0-9.]+ MB free"):
            SharedArrays([("front", (2**50,), "u1")])

    def test_shared_memory_is_allocated_before_it_is_written(self):
        shared = SharedArrays([("front", (1000, 1000), "u1")])
        try:
            self.assertGreaterEqual(512 * pathlib.Path(FOLDER, shared.name).stat().st_blocks, 10**6)
        finally:
            shared.close(unlink=True)


if __name__ == "__main__":
    unittest.main()
