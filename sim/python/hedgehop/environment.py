"""A reinforcement-learning environment with the protocol of Gymnasium."""

import numpy as np

from ._native import ActionPilot, state_of
from .simulation import Simulation
from .spaces import Box, Dict

try:
    from gymnasium import Env as _Base
except ImportError:
    _Base = object

STATE = 10

#: Rewards. progress: per meter of true approach to the goal; near: per decision, times the share of `near_m` that the
#: clearance lacks; the others: at the end of the flight, by outcome.
REWARDS = {"progress": 1.0, "near": -0.1, "near_m": 2.0, "reached": 100.0, "collided": -100.0, "fault": -100.0}


def _image_space(image):
    if image.dtype == np.uint8:
        return Box(0, 255, image.shape, np.uint8)
    return Box(-np.inf, np.inf, image.shape, image.dtype.type)


class Env(_Base):
    """Flies a scenario with actions. Deterministic in its seeds.

    Action       forward, right, climb, turn, each in [-1, 1]: shares of the speed limit (twice), of 1 m/s, of 1 rad/s.
    Observation  one image per camera, by role, and "state": position of the goal forward, right and down of the vehicle (m),
                 velocity in B (m/s), roll and pitch (rad), yaw rate (rad/s), height above ground (m). All are estimates.
    info         "clearance_m" and "p_WB_true_m" (truth, for evaluation only); at the end "result", as in result.json.

    scenario  file. cameras  roles; default: all of the rig. set  values by key path. rewards  replaces values of REWARDS.
    A seed of reset() starts a sequence of flights with different seeds.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 25}

    def __init__(self, scenario, *, cameras=None, set=None, rewards=None, render_mode=None):
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode '{render_mode}'; valid: None, rgb_array")
        unknown = sorted({*(rewards or {})} - {*REWARDS})
        if unknown:
            raise ValueError(f"rewards: unknown '{unknown[0]}'; valid: {', '.join(REWARDS)}")
        self.render_mode = render_mode
        self.rewards = {**REWARDS, **(rewards or {})}
        if cameras is None:
            cameras = list(Simulation(scenario, set=set).cameras)
        self._simulation = Simulation(scenario, set=set, cameras=cameras)
        known = self._simulation.cameras
        self.cameras = {role: known[role] for role in cameras}
        self._step_s = 1.0 / min((camera.rate_hz for camera in self.cameras.values()), default=25.0)
        first = self._simulation.observation.images
        spaces = {role: _image_space(image) for role, image in first.items()}
        self.observation_space = Dict({**spaces, "state": Box(-np.inf, np.inf, (STATE,), np.float32)})
        self.action_space = Box(-1.0, 1.0, (4,), np.float32)
        self._images = {role: np.zeros_like(image) for role, image in first.items()}
        self._seeds = np.random.default_rng()
        self._result = None

    def __repr__(self):
        return f"Env({self._simulation!r}, actions={self.action_space!r}, cameras={list(self.cameras)})"

    def reset(self, *, seed=None, options=None):
        """Starts the next flight. Returns (observation, info)."""
        if seed is not None:
            self._seeds = np.random.default_rng(seed)
            if _Base is not object:
                super().reset(seed=seed)
        seen = self._simulation.reset(int(self._seeds.integers(2**32)))
        self._result = None
        self._distance_m = self._goal_distance_m(seen)
        self._pilot = ActionPilot(seen.navigation)
        return self._observe(seen), self._info()

    def step(self, action):
        """Flies to the next decision. Returns (observation, reward, terminated, truncated, info)."""
        action = np.asarray(action, float)
        if action.shape != (4,) or not np.all(np.isfinite(action)):
            raise ValueError(f"an action must be four finite numbers, got {action!r}")
        speed_limit_mps, _ = self._simulation.limits
        command = self._pilot.fly(action, self._simulation.observation.navigation, speed_limit_mps, self._step_s)
        seen = self._simulation.step(command)
        distance_m = self._goal_distance_m(seen)
        reward = self.rewards["progress"] * (self._distance_m - distance_m)
        self._distance_m = distance_m
        lacking = 1.0 - self._simulation.proximity.obstacle_clearance_m / self.rewards["near_m"]
        reward += self.rewards["near"] * min(max(lacking, 0.0), 1.0)
        outcome = None
        if self._simulation.over:
            self._result = self._simulation.result()
            outcome = self._result["outcome"]
            reward += self.rewards.get(outcome, 0.0)
        truncated = outcome == "timeout"
        return self._observe(seen), float(reward), outcome is not None and not truncated, truncated, self._info()

    def render(self):
        """Returns the color image of the first camera, or None without a render mode."""
        if self.render_mode is None:
            return None
        return self._simulation.image(next(iter(self.cameras)), "color").copy()

    def close(self):
        """Ends the simulation."""
        self._simulation = None

    def _goal_distance_m(self, seen):
        return float(np.linalg.norm(seen.goal.p_WG_m - self._simulation.truth.p_WB_m))

    def _observe(self, seen):
        for role, image in seen.images.items():  # if an image is lost, the previous one remains
            self._images[role] = image.copy()
        return {**self._images, "state": state_of(seen.navigation, seen.goal)}

    def _info(self):
        info = {"clearance_m": self._simulation.proximity.obstacle_clearance_m,
                "p_WB_true_m": self._simulation.truth.p_WB_m.copy()}
        if self._result is not None:
            info["result"] = self._result
        return info
