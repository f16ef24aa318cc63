from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]
Command = Union["VelocityCommand", "PositionCommand", "AttitudeCommand", "HoverCommand"]

version: str
build: str

class InputError(ValueError): ...

class VelocityCommand:
    v_WB_W_mps: Vector
    altitude_m: float
    heading_rad: float
    def __init__(self, v_WB_W_mps: ArrayLike, altitude_m: float, heading_rad: float) -> None: ...

class PositionCommand:
    p_WB_m: Vector
    heading_rad: float
    def __init__(self, p_WB_m: ArrayLike, heading_rad: float) -> None: ...

class AttitudeCommand:
    roll_rad: float
    pitch_rad: float
    heading_rad: float
    altitude_m: float
    def __init__(self, roll_rad: float, pitch_rad: float, heading_rad: float, altitude_m: float) -> None: ...

class HoverCommand:
    yaw_rate_radps: float
    def __init__(self, yaw_rate_radps: float = 0.0) -> None: ...

class Decision:
    command: Command
    status: str
    signals: list[float]
    def __init__(self, command: Command, status: str = "cruise", signals: Sequence[float] = ()) -> None: ...

class NavigationState:
    p_WB_est_m: Vector
    q_WB_est: Vector
    v_WB_B_est_mps: Vector
    w_WB_B_est_radps: Vector
    q_WB_gyro: Vector
    height_above_ground_m: float
    range_m: Optional[float]
    def __init__(self) -> None: ...

class Goal:
    p_WG_m: Vector
    heading_rad: float
    def __init__(self, p_WG_m: ArrayLike = ..., heading_rad: float = 0.0) -> None: ...

class Observation:
    @property
    def t_ns(self) -> int: ...
    @property
    def t_s(self) -> float: ...
    @property
    def images(self) -> dict[str, NDArray[Any]]: ...
    @property
    def navigation(self) -> NavigationState: ...
    @property
    def goal(self) -> Goal: ...
    def __init__(self, t_ns: int, images: dict[str, NDArray[Any]], navigation: NavigationState, goal: Goal) -> None: ...

class CameraNeed:
    class Channel:
        grey: CameraNeed.Channel
        color: CameraNeed.Channel
        depth: CameraNeed.Channel
        corners: CameraNeed.Channel

    @property
    def role(self) -> str: ...
    @property
    def channel(self) -> CameraNeed.Channel: ...
    @property
    def pinhole(self) -> bool: ...
    def __init__(self, role: str, channel: str = "grey", pinhole: bool = False) -> None: ...

class MountedCamera:
    @property
    def role(self) -> str: ...
    @property
    def rate_hz(self) -> float: ...
    @property
    def width_px(self) -> int: ...
    @property
    def height_px(self) -> int: ...
    @property
    def lens(self) -> str: ...
    @property
    def pinhole(self) -> dict[str, float]: ...
    @property
    def X_BC(self) -> Vector: ...
    def rays(self) -> Vector: ...

class VehicleLimits:
    @property
    def speed_mps(self) -> float: ...
    @property
    def acceleration_mps2(self) -> float: ...
    @property
    def radius_m(self) -> float: ...

class Setup:
    @property
    def cameras(self) -> list[MountedCamera]: ...
    @property
    def limits(self) -> VehicleLimits: ...
    @property
    def seed(self) -> int: ...

class TrueMotion:
    @property
    def p_WB_m(self) -> Vector: ...
    @property
    def q_WB(self) -> Vector: ...
    @property
    def v_WB_W_mps(self) -> Vector: ...
    @property
    def w_WB_B_radps(self) -> Vector: ...
    @property
    def wind_W_mps(self) -> Vector: ...

class Proximity:
    @property
    def obstacle_clearance_m(self) -> float: ...
    @property
    def ground_clearance_m(self) -> float: ...
    @property
    def collided(self) -> bool: ...

class Simulation:
    def __init__(self, *arguments: Any) -> None: ...
    def __getattr__(self, name: str) -> Any: ...
