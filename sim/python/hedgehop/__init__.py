"""Hedgehop from Python: step a flight, write an avoidance module, fly batches and sweeps, load their results.

Frames: W north, east, down; B forward, right, down; C right, down, forward. SI units and radians. Names of numbers end in
their units.
"""

from . import _missing

_missing.explain(__file__)

from . import _repr
from ._native import (ActionPilot, AttitudeCommand, BodyRateCommand, CameraNeed, Decision, Goal, HoverCommand, InputError,
                      MotorCommand, MountedCamera, NavigationState, Observation, PositionCommand, Proximity, Setup, TrueMotion, VehicleLimits,
                      VelocityCommand, build, state_of, version)
from .campaigns import batch, sweep
from .environment import Env
from .results import Flight, load, to_frame
from .simulation import Simulation
from .vector import VectorEnv

__version__ = version
_COMMANDS = (AttitudeCommand, BodyRateCommand, HoverCommand, MotorCommand, PositionCommand, VelocityCommand)
for _class in (*_COMMANDS, CameraNeed, Decision, Goal, MountedCamera, NavigationState, Observation,
               Proximity, Setup, TrueMotion, VehicleLimits):
    _class.__repr__ = _repr.text
for _class in _COMMANDS:
    _class.__reduce__ = _repr.rebuilt
__all__ = ["ActionPilot", "AttitudeCommand", "BodyRateCommand", "CameraNeed", "Decision", "Env", "Flight", "Goal", "HoverCommand",
           "InputError", "MotorCommand", "MountedCamera", "NavigationState", "Observation", "PositionCommand", "Proximity", "Setup",
           "Simulation", "TrueMotion", "VectorEnv", "VehicleLimits", "VelocityCommand", "batch", "build", "load", "state_of", "sweep",
           "to_frame", "version"]

try:
    import gymnasium as _gymnasium
except ImportError:
    pass
else:
    _gymnasium.register("hedgehop/Avoid-v0", entry_point="hedgehop.environment:Env", vector_entry_point="hedgehop.vector:VectorEnv")
