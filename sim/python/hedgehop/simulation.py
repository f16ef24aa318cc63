"""A scenario in flight."""

import json
import os
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _native
from .results import read_table


def overrides(values):
    """The texts `key.path=value` of a dict of key paths; None where there is none."""
    texts = []
    for key, value in (values or {}).items():
        if isinstance(value, np.generic):
            value = value.item()
        try:
            texts.append(f"{key}={json.dumps(value, allow_nan=False)}")
        except (TypeError, ValueError):
            raise _native.InputError(f"set['{key}']: {value!r} is no finite number, text, list or dict") from None
    return texts


class Simulation:
    """Flies a scenario to its end, or step by step. Equal scenarios, seeds and commands give equal flights, bit for
    bit; `run()` gives what `hedgehop run` gives.

    file     scenario in YAML. Or text=, the YAML itself; its paths are relative to the working folder.
    seed     replaces the scenario's.
    set      values by key path, as `--set` has them: {"avoidance.speed": 1.5}.
    module   flies in place of the scenario's: a class with `update`, a new object for each flight, or an object.
    cameras  roles whose images are seen, for who gives every command; the module's own when not given.

    Used by the thread that made it alone. Errors are InputError (a ValueError) with the text of the command line,
    ValueError for a command that cannot be, RuntimeError for a call at the wrong time.
    """

    def __init__(self, file: Union[str, os.PathLike, None] = None, *, text: Optional[str] = None,
                 seed: Optional[int] = None, set: Optional[dict] = None, module: Any = None,
                 cameras: Optional[Sequence[str]] = None):
        self._native = _native.Simulation(None if file is None else os.fspath(file), text, seed, overrides(set), module,
                                          cameras)

    def reset(self, seed: Optional[int] = None) -> _native.Observation:
        """Begins again; without a seed the same flight, in about a fortieth of the time. Returns the first Observation."""
        return self._native.reset(seed)

    def step(self, command=None) -> _native.Observation:
        """Gives a command, or lets the module decide; flies on to the next decision or the end.

        Returns the Observation there. Its images are views of the simulator's own memory, good until the simulation
        moves on: copy what is to be kept.
        """
        return self._native.step(command)

    def tick(self, command=None) -> _native.Observation:
        """As step(), but one physics step."""
        return self._native.tick(command)

    def run(self) -> dict:
        """Lets the module fly to the end. Returns what result.json holds."""
        return json.loads(self._native.run_json())

    def result(self) -> dict:
        """What result.json holds; RuntimeError while the flight goes on."""
        return json.loads(self._native.result_json())

    def save(self, folder: Union[str, os.PathLike]) -> None:
        """Writes scenario.yaml, result.json, trajectory.csv and decisions.csv of a flight that is over."""
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
        return self._native.t_s()

    @property
    def seed(self) -> int:
        return self._native.seed()

    @property
    def observation(self) -> _native.Observation:
        """What the module gets now."""
        return self._native.seen()

    @property
    def truth(self) -> _native.TrueMotion:
        """How the vehicle truly moves, a TrueMotion: for who judges, not for who decides."""
        return self._native.truth()

    @property
    def proximity(self) -> _native.Proximity:
        """True clearances, a Proximity."""
        return self._native.proximity()

    @property
    def cameras(self) -> "dict[str, _native.MountedCamera]":
        """All cameras of the rig, by role."""
        return {role: self._native.camera(role) for role in self._native.roles()}

    def image(self, role: str, channel: str = "grey") -> np.ndarray:
        """What a camera would deliver now as grey, color, depth or labels, with its imperfections."""
        return self._native.image(role, channel)

    def flow_to_next_image(self, role: str) -> np.ndarray:
        """Flies on by one period of the camera; returns the true optic flow of its image of before, px."""
        return self._native.flow_to_next_image(role)

    def checks_so_far(self) -> "list[dict]":
        """What the scenario's checks would say, did the flight end now: dicts of name, passed, value, limit, unit."""
        return self._native.checks_so_far()

    @property
    def limits(self) -> "tuple[float, float]":
        """(speed, m/s; acceleration, m/s2) that the autopilot keeps to."""
        return self._native.limits()

    @property
    def scenario_yaml(self) -> str:
        """The scenario in full, every key written."""
        return self._native.scenario_yaml()

    @property
    def trajectory(self) -> np.recarray:
        """One record per control tick, as trajectory.csv has them, of a flight that is over."""
        return read_table(self._native.trajectory_csv())

    @property
    def decisions(self) -> np.recarray:
        """One record per decision, as decisions.csv has them, of a flight that is over."""
        return read_table(self._native.decisions_csv())
