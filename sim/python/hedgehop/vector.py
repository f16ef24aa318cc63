"""Parallel environments. Each has its own process."""

import multiprocessing
import traceback
from multiprocessing import shared_memory

import numpy as np

from .environment import STATE, Env


class _Shared:
    """Named arrays in one block of shared memory."""

    def __init__(self, layout, name=None):
        ends = np.cumsum([int(np.prod(shape)) * np.dtype(dtype).itemsize + 7 & ~7 for _, shape, dtype in layout])
        self._memory = shared_memory.SharedMemory(name, create=name is None, size=int(ends[-1]))
        self.name = self._memory.name
        self.arrays = {key: np.ndarray(shape, dtype, self._memory.buf, int(start))
                       for (key, shape, dtype), start in zip(layout, [0, *ends[:-1]])}

    def close(self, unlink=False):
        self.arrays = {}
        self._memory.close()
        if unlink:
            self._memory.unlink()


def _work(pipe, scenario, options, index, layout, name):
    """Runs an environment in a worker. After each flight, a new one starts with the next seed."""
    env = Env(scenario, **options)
    shared = _Shared(layout, name)
    row = {key: array[index] for key, array in shared.arrays.items()}

    try:
        while True:
            order, seed = pipe.recv()
            if order == "close":
                break
            try:
                if order == "reset":
                    observation, info = env.reset(seed=seed)
                else:
                    observation, reward, terminated, truncated, info = env.step(row["action"])
                    row["outcome"][...] = reward, terminated, truncated
                    if terminated or truncated:
                        ended = info
                        observation, info = env.reset()
                        info["final_info"] = ended
                for key, value in observation.items():
                    row[key][...] = value
                pipe.send((info, None))
            except Exception:  # sent to the parent with its traceback
                pipe.send((None, traceback.format_exc()))
    finally:
        row = None
        shared.close()


class VectorEnv:
    """`count` environments that step together. Deterministic in (seed, count): environment i flies the i-th sequence of
    flights of the seed.

    Observations, rewards, terminated and truncated have one row per environment. If a flight has ended, the observation is
    the first one of the next flight, and infos[i]["final_info"] belongs to the previous flight. Arrays are copies.
    """

    def __init__(self, scenario, count, **options):
        if count < 1:
            raise ValueError(f"count: {count}; must be >= 1")
        probe = Env(scenario, **options)
        self.num_envs = count
        self.single_action_space, self.single_observation_space = probe.action_space, probe.observation_space
        images = {role: space for role, space in probe.observation_space.spaces.items() if role != "state"}
        probe.close()
        self._keys = [*images, "state"]
        layout = [(role, (count, *space.shape), space.dtype.str) for role, space in images.items()]
        layout += [("state", (count, STATE), "<f4"), ("action", (count, 4), "<f8"), ("outcome", (count, 3), "<f8")]
        self._shared = _Shared(layout)
        context = multiprocessing.get_context("spawn")
        self._pipes, self._workers = [], []
        for i in range(count):
            ours, theirs = context.Pipe()
            worker = context.Process(target=_work, daemon=True,
                                     args=(theirs, scenario, options, i, layout, self._shared.name))
            worker.start()
            theirs.close()
            self._pipes.append(ours)
            self._workers.append(worker)

    def __repr__(self):
        return f"VectorEnv(num_envs={self.num_envs}, actions={self.single_action_space!r})"

    def reset(self, *, seed=None):
        """Starts the next flight of every environment. Returns (observations, infos)."""
        seeds = np.random.SeedSequence(seed).generate_state(self.num_envs)
        infos = self._order([("reset", int(s)) for s in seeds])
        return self._observations(), infos

    def step(self, actions):
        """Flies every environment to its next decision. Returns (observations, rewards, terminated, truncated, infos)."""
        actions = np.asarray(actions, float)
        if actions.shape != (self.num_envs, 4):
            raise ValueError(f"actions: {actions.shape}; must be ({self.num_envs}, 4)")
        self._shared.arrays["action"][...] = actions
        infos = self._order([("step", None)] * self.num_envs)
        reward, terminated, truncated = self._shared.arrays["outcome"].T.copy()
        return self._observations(), reward, terminated.astype(bool), truncated.astype(bool), infos

    def close(self):
        """Ends the workers."""
        if self._shared is None:
            return
        for pipe, worker in zip(self._pipes, self._workers):
            if worker.is_alive():
                pipe.send(("close", None))
        for worker in self._workers:
            worker.join()
        self._shared.close(unlink=True)
        self._shared = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _observations(self):
        return {key: self._shared.arrays[key].copy() for key in self._keys}

    def _order(self, orders):
        for pipe, order in zip(self._pipes, orders):
            pipe.send(order)
        answers = []
        for pipe in self._pipes:  # reads all answers, so that none remains for the next order
            try:
                answers.append(pipe.recv())
            except EOFError:
                answers.append((None, "the process ended"))
        for i, (_, fault) in enumerate(answers):
            if fault:
                raise RuntimeError(f"environment {i}: {fault}")
        return [info for info, _ in answers]
