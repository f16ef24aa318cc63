"""The classes of gymnasium that environments use; without gymnasium, stand-ins with the part of its protocol that Hedgehop
uses itself. With gymnasium, this module contains no code of its own except LEGACY."""

import enum

import numpy as np

try:
    from gymnasium import Env
    from gymnasium.spaces import Box, Dict
    from gymnasium.vector import VectorEnv
    from gymnasium.vector.utils import batch_space

    INSTALLED = True
except ImportError:
    INSTALLED = False

    class Env:  # type: ignore[no-redef]
        """Base class of environments."""

        def reset(self, *, seed=None, options=None):
            pass

    class VectorEnv:  # type: ignore[no-redef]
        """Base class of parallel environments."""

        def _add_info(self, infos, info, index):
            """Adds the info of one environment: an array of all environments per key, and under "_key" whether it is set."""
            for key, value in info.items():
                if isinstance(value, dict) and key != "final_obs":
                    infos[key] = self._add_info(infos.get(key, {}), value, index)
                else:
                    plain = isinstance(value, (int, float, np.number, np.ndarray))
                    shape, dtype = (np.shape(value), np.asarray(value).dtype) if plain else ((), object)
                    infos.setdefault(key, np.zeros((self.num_envs, *shape), dtype))[index] = value
                infos.setdefault(f"_{key}", np.zeros(self.num_envs, bool))[index] = True
            return infos

    class Box:  # type: ignore[no-redef]
        """Arrays of a shape and type between bounds."""

        def __init__(self, low, high, shape, dtype):
            self.shape, self.dtype = tuple(shape), np.dtype(dtype)
            self.low, self.high = (np.full(self.shape, bound, self.dtype) for bound in (low, high))
            self._random = np.random.default_rng()

        def __repr__(self):
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"

        def __eq__(self, other):
            return (isinstance(other, Box) and self.dtype == other.dtype and np.array_equal(self.low, other.low)
                    and np.array_equal(self.high, other.high))

        def seed(self, seed=None):
            self._random = np.random.default_rng(seed)

        def sample(self):
            if self.dtype.kind == "u":
                return self._random.integers(self.low, self.high, self.shape, self.dtype, endpoint=True)
            low, high = np.maximum(self.low, -1e3), np.minimum(self.high, 1e3)
            return self._random.uniform(low, high).astype(self.dtype)

        def contains(self, value):
            value = np.asarray(value)
            return (value.shape == self.shape and np.can_cast(value.dtype, self.dtype, "same_kind")
                    and bool(np.all((value >= self.low) & (value <= self.high))))

    class Dict:  # type: ignore[no-redef]
        """A dict of spaces."""

        def __init__(self, spaces):
            self.spaces = dict(spaces)

        def __repr__(self):
            return f"Dict({self.spaces})"

        def __eq__(self, other):
            return isinstance(other, Dict) and self.spaces == other.spaces

        def seed(self, seed=None):
            for i, space in enumerate(self.spaces.values()):
                space.seed(None if seed is None else seed + i)

        def sample(self):
            return {key: space.sample() for key, space in self.spaces.items()}

        def contains(self, value):
            return set(value) == set(self.spaces) and all(s.contains(value[k]) for k, s in self.spaces.items())

        def __getitem__(self, key):
            return self.spaces[key]

    def batch_space(space, n):
        """Returns the space of n values."""
        if isinstance(space, Dict):
            return Dict({key: batch_space(inner, n) for key, inner in space.spaces.items()})
        return Box(space.low[None], space.high[None], (n, *space.shape), space.dtype)


try:
    from gymnasium.vector import AutoresetMode

    LEGACY = False
except ImportError:
    #: Whether gymnasium is older than 1.0, which names the last observation of a flight "final_observation".
    LEGACY = INSTALLED

    class AutoresetMode(enum.Enum):  # type: ignore[no-redef]
        """When the next flight starts after the end of one."""

        NEXT_STEP = "NextStep"
        SAME_STEP = "SameStep"
        DISABLED = "Disabled"
