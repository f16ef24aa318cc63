"""Action and observation spaces: those of gymnasium if it is installed, else classes with the same protocol."""

import numpy as np

try:
    from gymnasium.spaces import Box, Dict
except ImportError:

    class Box:  # type: ignore[no-redef]
        """Arrays of a shape and type between bounds."""

        def __init__(self, low, high, shape, dtype):
            self.shape, self.dtype = tuple(shape), np.dtype(dtype)
            self.low, self.high = (np.full(self.shape, bound, self.dtype) for bound in (low, high))
            self._random = np.random.default_rng()

        def __repr__(self):
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"

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

        def seed(self, seed=None):
            for i, space in enumerate(self.spaces.values()):
                space.seed(None if seed is None else seed + i)

        def sample(self):
            return {key: space.sample() for key, space in self.spaces.items()}

        def contains(self, value):
            return set(value) == set(self.spaces) and all(s.contains(value[k]) for k, s in self.spaces.items())

        def __getitem__(self, key):
            return self.spaces[key]
