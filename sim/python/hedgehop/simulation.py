"""A scenario that is flown step by step."""

import json
import os
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _native
from .results import read_table


def _plain(value):
    """Returns the numbers of NumPy as those of Python, and a path as its text."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError


def overrides(values):
    """Returns the texts `key.path=value` for a dict of key paths, or for None."""
    texts = []
    for key, value in (values or {}).items():
        try:
            text = f"{key}={json.dumps(value, allow_nan=False, ensure_ascii=False, default=_plain)}"
            text.encode()  # refuses half of a surrogate pair
            texts.append(text)
        except (TypeError, ValueError):
            raise _native.InputError(f"set['{key}']: {value!r} is not a finite number, text, list or dict") from None
    return texts


class Simulation:
    """Flies a scenario to its end or step by step. Equal scenarios, seeds and commands give bit-for-bit equal flights.
    `run()` gives the same result as `hedgehop run`.

    file     scenario in YAML. Alternatively text=, the YAML itself; its paths are relative to the working folder.
    seed     replaces the seed of the scenario.
    set      values by key path, as with `--set`: {"avoidance.speed": 1.5}.
    module   replaces the module of the scenario: a class with `update` (a new object for each flight), or an object.
    cameras  roles of the images for a caller that gives every command; default: the cameras of the module.

    Only the thread that created the object may use it. Errors: InputError (a ValueError) with the text of the command line,
    ValueError for an invalid command, RuntimeError for a call at the wrong time.
    """

    def __init__(self, file: Union[str, os.PathLike, None] = None, *, text: Optional[str] = None,
                 seed: Optional[int] = None, set: Optional[dict] = None, module: Any = None,
                 cameras: Optional[Sequence[str]] = None):
        self._native = _native.Simulation(None if file is None else os.fspath(file), text, seed, overrides(set), module,
                                          cameras)

    def __repr__(self) -> str:
        state = "over" if self.over else f"t_s={self.t_s:.6g}"
        return f"Simulation({self._native.file()!r}, seed={self.seed}, {state}, cameras={list(self._native.roles())})"

    def reset(self, seed: Optional[int] = None, world_seed: Optional[int] = None) -> _native.Observation:
        """Starts a new flight and returns its first Observation. world_seed  as the key of the scenario. The default of both is
        that of the flight before. In the same world, a flight is about 40 times faster to start."""
        return self._native.reset(seed, world_seed)

    def step(self, command=None) -> _native.Observation:
        """Applies a command, or that of the module, and flies to the next decision or the end. BodyRateCommand and
        MotorCommand replace the autopilot too, until the next command.

        Returns the new Observation. Its images are views of the memory of the simulator, which are valid until the
        simulation continues. Copy images to keep them.
        """
        return self._native.step(command)

    def tick(self, command=None) -> _native.Observation:
        """As step(), for one physics step."""
        return self._native.tick(command)

    def run(self) -> dict:
        """Flies the module to the end. Returns the contents of result.json."""
        return json.loads(self._native.run_json())

    def result(self) -> dict:
        """Returns the contents of result.json. Raises RuntimeError during the flight."""
        return json.loads(self._native.result_json())

    def save(self, folder: Union[str, os.PathLike]) -> None:
        """Writes scenario.yaml, result.json, trajectory.csv and decisions.csv of a completed flight."""
        self._native.save(os.fspath(folder))

    @property
    def over(self) -> bool:
        """Whether the flight has ended."""
        return self._native.over()

    @property
    def decides(self) -> bool:
        """Whether a decision is due now."""
        return self._native.decides()

    @property
    def t_s(self) -> float:
        """The time of flight, s."""
        return self._native.t_s()

    @property
    def seed(self) -> int:
        """The seed of the flight."""
        return self._native.seed()

    @property
    def world_seed(self) -> Optional[int]:
        """The seed of the world; None if it is that of the flight."""
        return self._native.world_seed()

    @property
    def observation(self) -> _native.Observation:
        """The current input of the module."""
        return self._native.seen()

    @property
    def truth(self) -> _native.TrueMotion:
        """The true motion of the vehicle, for evaluation only."""
        return self._native.truth()

    @property
    def proximity(self) -> _native.Proximity:
        """The true clearances."""
        return self._native.proximity()

    @property
    def cameras(self) -> "dict[str, _native.MountedCamera]":
        """All cameras of the rig by role."""
        return {role: self._native.camera(role) for role in self._native.roles()}

    def channel(self, role: str) -> str:
        """Returns the channel of a camera: grey, color, depth or corners."""
        return self._native.channel(role).name

    def image(self, role: str, channel: str = "grey") -> np.ndarray:
        """Returns the current image of a camera as grey, color, depth, labels or semantic, with its
        imperfections."""
        return self._native.image(role, channel)

    def flow_to_next_image(self, role: str) -> np.ndarray:
        """Flies one period of the camera. Returns the true optic flow of its previous image, px."""
        return self._native.flow_to_next_image(role)

    def image_from(self, role: str, channel: str, position, quaternion, t_s: float = 0.0) -> np.ndarray:
        """Returns the image of a camera from a chosen pose of the body, at rest: north, east, down, m; w, x, y, z of the rotation
        from the body to the world. `t_s` is the time of the moving objects; images of one time have the same noise. The pose
        may be inside an obstacle (proximity_from()). Does not change the flight."""
        return self._native.image_from(role, channel, position, quaternion, t_s)

    def proximity_from(self, position, quaternion, t_s: float = 0.0) -> _native.Proximity:
        """Returns the true clearances of the vehicle at a chosen pose, as in image_from(), and whether it collides."""
        return self._native.proximity_from(position, quaternion, t_s)

    def flow_between(self, role: str, start, end, start_s: float = 0.0, end_s: float = 0.0) -> np.ndarray:
        """Returns the true optic flow of a camera between two chosen poses, px. A pose is (position, quaternion), as in
        image_from()."""
        return self._native.flow_between(role, start, end, start_s, end_s)

    @property
    def labels(self) -> dict:
        """The contents of labels.json: `classes` (value by name) and `instances` (dicts of id, name, class) of the images of
        labels and classes."""
        return json.loads(self._native.labels_json())

    def checks_so_far(self) -> "list[dict]":
        """Returns the results of the checks if the flight ended now: dicts of name, passed, value, limit, unit."""
        return self._native.checks_so_far()

    @property
    def limits(self) -> "tuple[float, float]":
        """Limits of the autopilot: (speed, m/s; acceleration, m/s2)."""
        return self._native.limits()

    @property
    def control_rate_hz(self) -> int:
        """Rate at which commands act, and of the rows of the trajectory."""
        return self._native.control_rate_hz()

    @property
    def direct_hover(self) -> "tuple[float, np.ndarray, float]":
        """The direct commands of a hover in still air: the thrust of a BodyRateCommand, the speeds of a MotorCommand (rad/s), and
        the maximum of a speed. A helicopter has no speeds."""
        return self._native.direct_hover()

    @property
    def scenario_yaml(self) -> str:
        """The resolved scenario with every key."""
        return self._native.scenario_yaml()

    @property
    def trajectory(self) -> np.recarray:
        """One record per control tick of a completed flight, as in trajectory.csv."""
        return read_table(self._native.trajectory_csv())

    @property
    def decisions(self) -> np.recarray:
        """One record per decision of a completed flight, as in decisions.csv."""
        return read_table(self._native.decisions_csv())
