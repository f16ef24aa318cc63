"""Parallel environments. Each has its own process."""

import multiprocessing
import signal
import traceback
import weakref

import numpy as np

from ._gymnasium import LEGACY, AutoresetMode, batch_space
from ._gymnasium import VectorEnv as _Base
from ._shared import SharedArrays
from .environment import Env


def _copies(observation):
    return {key: value.copy() for key, value in observation.items()}


class _Worker:
    """An environment in a worker process, and its row of the shared arrays."""

    def __init__(self, env, row, mode):
        self._env, self._row, self._mode = env, row, mode
        self._ended = False

    def reset(self, seed, options):
        self._ended = False
        return self._env.reset(seed=seed, options=options)

    def step(self):
        """Returns the observation and the info of a step. In the mode SAME_STEP, a new flight starts after each."""
        if self._ended and self._mode is AutoresetMode.NEXT_STEP:
            self._row["outcome"][...] = 0.0, False, False
            return self.reset(None, None)
        observation, reward, terminated, truncated, info = self._env.step(self._row["action"])
        self._row["outcome"][...] = reward, terminated, truncated
        self._ended = terminated or truncated
        if self._ended and self._mode is AutoresetMode.SAME_STEP:
            last = {"final_obs": observation, "final_info": info}
            observation, info = self.reset(None, None)
            info.update(last)
        return observation, info

    def answer(self, order, arguments):
        """Obeys an order. Returns an image for "render", else the info."""
        if order == "render":
            return self._env.render()
        observation, info = getattr(self, order)(*arguments)
        for key, value in observation.items():
            self._row[key][...] = value
        return info


def _work(pipe, scenario, options, index, layout, name, mode):
    """Runs an environment in a process. Sends (info, None) or (None, fault) after its start and after each order."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent process handles Ctrl-C
    shared = None
    try:
        shared = SharedArrays(layout, name)
        worker = _Worker(Env(scenario, **options), {key: array[index] for key, array in shared.arrays.items()}, mode)
        pipe.send((None, None))
        while True:
            order, arguments = pipe.recv()
            if order == "close":
                break
            try:
                pipe.send((worker.answer(order, arguments), None))
            except Exception:
                pipe.send((None, traceback.format_exc()))
    except EOFError:  # the parent process has ended
        pass
    except Exception:
        pipe.send((None, traceback.format_exc()))
    finally:
        worker = None
        if shared is not None:
            shared.close()


def _stop(pipes, workers, shared):
    """Ends the workers, also those that have died, and releases the memory."""
    for pipe in pipes:
        try:
            pipe.send(("close", ()))
        except OSError:  # the worker has ended
            pass
    for worker in workers:
        worker.join()
    shared.close(unlink=True)


class Infos(dict):
    """Infos of all environments, as those of Gymnasium's parallel environments: an array per key, and under "_key" which
    environments have a value. infos[i] is the info of environment i."""

    def __missing__(self, index):
        if not isinstance(index, (int, np.integer)):
            raise KeyError(index)
        return {key: Infos(value)[index] if isinstance(value, dict) else value[index] for key, value in self.items()
                if not key.startswith("_") and self[f"_{key}"][index]}


class VectorEnv(_Base):
    """`num_envs` environments that step together, a gymnasium.vector.VectorEnv if gymnasium is installed. Deterministic in
    (seed, num_envs): environment i flies the i-th sequence of flights of the seed.

    Observations, rewards, terminated and truncated have one row per environment; arrays are copies. Infos are of the class
    Infos. autoreset_mode is that of Gymnasium, or its name:

    "SameStep"  (default) If a flight ends, the observation is the first one of the next flight. infos["final_obs"][i] and
                infos["final_info"] are those of the ended flight. With gymnasium before 1.0, "final_observation" too.
    "NextStep"  The next step starts the next flight, ignores the action and has reward 0.
    "Disabled"  Ended flights must be restarted by reset(options={"reset_mask": array of bool}).

    options  arguments of Env. Raises OSError if the observations do not fit into the shared memory, RuntimeError if a process
    fails; after a process has died, only close() remains.
    """

    def __init__(self, scenario, num_envs, *, autoreset_mode=AutoresetMode.SAME_STEP, **options):
        if num_envs < 1:
            raise ValueError(f"num_envs: {num_envs}; must be >= 1")
        self._mode = AutoresetMode(getattr(autoreset_mode, "value", autoreset_mode))
        probe = Env(scenario, **options)
        self.num_envs, self.is_vector_env, self.render_mode = num_envs, True, probe.render_mode
        self.metadata = {**probe.metadata, "autoreset_mode": self._mode}
        self.single_action_space, self.single_observation_space = probe.action_space, probe.observation_space
        self.action_space = batch_space(probe.action_space, num_envs)
        self.observation_space = batch_space(probe.observation_space, num_envs)
        probe.close()
        layout = [(key, space.shape, space.dtype.str) for key, space in self.observation_space.spaces.items()]
        layout += [("action", self.action_space.shape, "<f8"), ("outcome", (num_envs, 3), "<f8")]
        self._shared = SharedArrays(layout)
        context = multiprocessing.get_context("spawn")
        self._pipes, self._workers = [], []
        self._stop = weakref.finalize(self, _stop, self._pipes, self._workers, self._shared)
        for i in range(num_envs):
            ours, theirs = context.Pipe()
            worker = context.Process(target=_work, daemon=True,
                                     args=(theirs, scenario, options, i, layout, self._shared.name, self._mode))
            worker.start()
            theirs.close()
            self._pipes.append(ours)
            self._workers.append(worker)
        self.closed = False
        try:
            self._answers(range(num_envs))
        except RuntimeError:
            self.close()
            raise

    def __repr__(self):
        return f"VectorEnv(num_envs={self.num_envs}, actions={self.single_action_space!r})"

    def reset(self, *, seed=None, options=None):
        """Starts the next flight of every environment. Returns (observations, infos).

        seed     of all sequences of flights, or a list with a seed or None per environment. Default: the next flights.
        options  as of Env.reset(), and "reset_mask": which environments start, default all.
        """
        keys = dict(options or {})
        mask = np.asarray(keys.pop("reset_mask", np.ones(self.num_envs, bool)))
        if mask.shape != (self.num_envs,) or mask.dtype != bool:
            raise ValueError(f"options['reset_mask']: {mask!r}; must be {self.num_envs} values of bool")
        if seed is None or isinstance(seed, (int, np.integer)):
            seeds = [None] * self.num_envs if seed is None else np.random.SeedSequence(seed).generate_state(self.num_envs)
        else:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed: {len(seeds)} values; must be one seed, or one for each of {self.num_envs} environments")
        return self._fly({i: ("reset", (None if seeds[i] is None else int(seeds[i]), keys)) for i in np.flatnonzero(mask)})

    def step(self, actions):
        """Flies every environment to its next decision. Returns (observations, rewards, terminated, truncated, infos)."""
        actions = np.asarray(actions, float)
        if actions.shape != self.action_space.shape:
            raise ValueError(f"actions: {actions.shape}; must be {self.action_space.shape}")
        self._require_open()
        self._shared.arrays["action"][...] = actions
        observations, infos = self._fly({i: ("step", ()) for i in range(self.num_envs)})
        reward, terminated, truncated = self._shared.arrays["outcome"].T.copy()
        return observations, reward, terminated.astype(bool), truncated.astype(bool), infos

    def render(self):
        """Returns a tuple of the images of all environments, as Env.render()."""
        return tuple(self._order({i: ("render", ()) for i in range(self.num_envs)}).values())

    def close(self, **_):
        """Ends the processes. Later calls raise RuntimeError, except close()."""
        self.closed = True
        self._stop()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _require_open(self):
        if self.closed:
            raise RuntimeError("the VectorEnv is closed; create another one")

    def _order(self, orders):
        """Sends orders to environments. Returns their answers by index."""
        self._require_open()
        for i, order in orders.items():
            try:
                self._pipes[i].send(order)
            except OSError:  # the process has ended, as reading its answer will show
                pass
        return self._answers(orders)

    def _fly(self, orders):
        """Lets environments fly. Returns (observations, infos)."""
        infos = Infos()
        for i, info in self._order(orders).items():
            if LEGACY and "final_obs" in info:
                info["final_observation"] = info["final_obs"]
            self._add_info(infos, info, i)
        return _copies({key: self._shared.arrays[key] for key in self.observation_space.spaces}), infos

    def _answers(self, indices):
        """Reads the answers of environments, all of them, so that none remains for the next order. Returns them by index."""
        answers = {}
        for i in indices:
            try:
                answers[i] = self._pipes[i].recv()
            except (EOFError, OSError):
                answers[i] = None, self._cause_of_death(i)
        for i, (_, fault) in answers.items():
            if fault:
                raise RuntimeError(f"environment {i}: {fault}")
        return {i: info for i, (info, _) in answers.items()}

    def _cause_of_death(self, index):
        self._workers[index].join()
        status = self._workers[index].exitcode
        if status is not None and status < 0:
            reason = f"was ended by {signal.Signals(-status).name}" + (
                ", as by a system that runs out of memory" if -status == signal.SIGKILL else "")
        else:
            reason = f"ended with status {status}; its output shows the reason. Create a VectorEnv below `if __name__ == \"__main__\":`"
        return f"its process {reason}. close() this VectorEnv and create another one"
