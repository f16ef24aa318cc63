"""Hedgehop from Python: step a flight, write an avoidance module, fly batches and sweeps, load their results.

Frames: W north, east, down; B forward, right, down; C right, down, forward. SI units and radians. Names of numbers end in
their units.
"""

from . import _missing

_missing.explain(__file__)

from . import _repr
from ._native import (ActionPilot, AttitudeCommand, CameraNeed, Decision, Goal, HoverCommand, InputError, MountedCamera,
                      NavigationState, Observation, PositionCommand, Proximity, Setup, TrueMotion, VehicleLimits,
                      VelocityCommand, build, state_of, version)
from .campaigns import batch, sweep
from .environment import Env
from .results import Flight, load, to_frame
from .simulation import Simulation
from .vector import VectorEnv

__version__ = version
for _class in (AttitudeCommand, CameraNeed, Decision, Goal, HoverCommand, MountedCamera, NavigationState, Observation,
               PositionCommand, Proximity, Setup, TrueMotion, VehicleLimits, VelocityCommand):
    _class.__repr__ = _repr.text
__all__ = ["ActionPilot", "AttitudeCommand", "CameraNeed", "Decision", "Env", "Flight", "Goal", "HoverCommand",
           "InputError", "MountedCamera", "NavigationState", "Observation", "PositionCommand", "Proximity", "Setup",
           "Simulation", "TrueMotion", "VectorEnv", "VehicleLimits", "VelocityCommand", "batch", "build", "load", "state_of", "sweep",
           "to_frame", "version"]

try:
    import gymnasium as _gymnasium
except ImportError:
    pass
else:
    _gymnasium.register("hedgehop/Avoid-v0", entry_point=Env)
