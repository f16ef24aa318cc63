"""A reinforcement-learning environment with the protocol of Gymnasium."""

import functools
import operator

import numpy as np

from . import actions as _actions
from ._gymnasium import Box, Dict
from ._gymnasium import Env as _Base
from ._native import InputError, state_of
from .simulation import Simulation, overrides

STATE = 10
MAX_SEED = 2**64 - 1

#: Rewards. progress: per meter of true approach to the goal; near: per decision, times the share of `near_m` that the
#: clearance lacks; the others: at the end of the flight, by outcome.
REWARDS = {"progress": 1.0, "near": -0.1, "near_m": 2.0, "reached": 100.0, "collided": -100.0, "fault": -100.0}


def _seed(name, value):
    """Returns a seed as an int. Raises InputError for any other value."""
    try:
        seed = operator.index(value)
    except TypeError:
        seed = -1
    if not 0 <= seed <= MAX_SEED:
        raise InputError(f"options['{name}']: {value!r}; valid: an integer from 0 to {MAX_SEED}")
    return seed


class Env(_Base):
    """Flies a scenario with actions. Deterministic in its seeds.

    Action       numbers in [-1, 1], of the kind `actions`:
                 "velocity"  forward, right, climb, turn: shares of the speed limit (twice), of 1 m/s, of 1 rad/s;
                 "rates"     roll, pitch and yaw rate, shares of 180, 180 and 90 deg/s; thrust: -1 none, 0 that of the hover,
                             1 the maximum;
                 "motors"    speed of each rotor of a multicopter in the order of its arms: -1 stopped, 0 that of the hover,
                             1 the maximum.
    Observation  one image per camera, by role, and "state": position of the goal forward, right and down of the vehicle (m),
                 velocity in B (m/s), roll and pitch (rad), yaw rate (rad/s), height above ground (m). With actions of rates
                 or motors also "rates": roll, pitch and yaw rate (rad/s). All are estimates. Images are rows x columns x
                 channels: uint8, or depth in m as float32 in 0 .. `depth_far_m`, the value of farther, unknown and missing
                 surfaces. If a camera loses an image, the previous one of the flight remains; before the first, an image is
                 black, and its depth far.
    info         "clearance_m" and "p_WB_true_m" (truth, for evaluation only); at the end "result", as in result.json.

    scenario  file. cameras  roles; default: all of the rig. set  values by key path. rewards  replaces values of REWARDS.
    A step lasts until the next image of the fastest camera. metadata["render_fps"] is that rate.
    A pickled or copied Env is a new one with equal arguments; it does not contain the flight.
    """

    metadata = {"render_modes": ["rgb_array"]}

    def __init__(self, scenario, *, cameras=None, set=None, rewards=None, render_mode=None, actions="velocity",
                 depth_far_m=100.0):
        self._arguments = {"cameras": cameras, "set": set, "rewards": rewards, "render_mode": render_mode,
                           "actions": actions, "depth_far_m": depth_far_m}
        self._scenario, self._set, self._simulation = scenario, dict(set or {}), None
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode '{render_mode}'; valid: None, rgb_array")
        unknown = sorted({*(rewards or {})} - {*REWARDS})
        if unknown:
            raise ValueError(f"rewards: unknown '{unknown[0]}'; valid: {', '.join(REWARDS)}")
        if actions not in _actions.KINDS:
            raise ValueError(f"actions: {actions!r}; valid: {', '.join(_actions.KINDS)}")
        if not 0.0 < depth_far_m < np.inf:
            raise ValueError(f"depth_far_m: {depth_far_m!r}; must be > 0 m and finite")
        self.render_mode = render_mode
        self.rewards = {**REWARDS, **(rewards or {})}
        self._roles = list(Simulation(scenario, set=set).cameras) if cameras is None else list(cameras)
        simulation = Simulation(scenario, set=set, cameras=self._roles)
        self._kind = _actions.KINDS[actions]
        self._use(simulation, overrides(self._set))
        self.observation_space, self.action_space = self._spaces(simulation)
        self._seeds = np.random.default_rng()
        self._flying = False

    def __repr__(self):
        return f"Env({self._simulation!r}, actions={self.action_space!r}, cameras={list(self.cameras)})"

    def __reduce__(self):
        return functools.partial(type(self), self._scenario, **self._arguments), ()

    def reset(self, *, seed=None, options=None):
        """Starts the next flight. Returns (observation, info).

        seed     starts a sequence of flights with different seeds. Default: the next flight of the sequence.
        options  values of scenario keys by path, as `set`, for this flight only. "seed" is the seed of the noise and
                 "world_seed" that of the world: the same world with other noise. Without "world_seed", in options or in
                 the scenario, the world has the seed of the flight. They must not change the spaces.
        """
        self._require_open()
        if seed is not None:
            super().reset(seed=seed)
            self._seeds = np.random.default_rng(seed)
        keys = dict(options or {})
        flight_seed = _seed("seed", keys.pop("seed", int(self._seeds.integers(2**32))))
        world_seed = keys.pop("world_seed", None)
        seen = self._start({**self._set, **keys}, flight_seed, None if world_seed is None else _seed("world_seed", world_seed))
        self._images = {role: self._blank(role) for role in self.cameras}
        self._flying, self._result = True, None
        self._distance_m = self._goal_distance_m(seen)
        self._actions.start(seen)
        return self._observe(seen), self._info()

    def step(self, action):
        """Flies to the next decision. Returns (observation, reward, terminated, truncated, info)."""
        self._require_flight("step()")
        action = np.asarray(action, float)
        if action.shape != self.action_space.shape or not np.all(np.isfinite(action)):
            raise ValueError(f"an action must be {self._actions.size} finite numbers, got {action!r}")
        if self._result is not None:
            raise RuntimeError("the flight is over; reset() starts the next one")
        command = self._actions.command(np.clip(action, -1.0, 1.0), self._simulation.observation, self._step_s)
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
        self._require_flight("render()")
        if self.render_mode is None:
            return None
        return self._simulation.image(next(iter(self.cameras)), "color").copy()

    def close(self):
        """Ends the simulation. Later calls raise RuntimeError, except close()."""
        self._simulation = None

    def _require_open(self):
        if self._simulation is None:
            raise RuntimeError("the environment is closed; create another one")

    def _require_flight(self, call):
        self._require_open()
        if not self._flying:
            raise RuntimeError(f"no flight for {call}; call reset() first")

    def _start(self, keys, seed, world_seed):
        """Starts a flight with these scenario keys. Returns its first observation."""
        texts = overrides(keys)
        if texts != self._keys:
            simulation = Simulation(self._scenario, set=keys, cameras=self._roles)
            if self._spaces(simulation) != (self.observation_space, self.action_space):
                raise InputError("options: they change the observation or the action space; create another Env with `set`")
            self._use(simulation, texts)
        if world_seed is None:
            world_seed = seed if self._world_seed is None else self._world_seed
        return self._simulation.reset(seed, world_seed)

    def _use(self, simulation, texts):
        """Continues with another simulation. texts  values of its keys."""
        self._simulation, self._keys = simulation, texts
        self._world_seed = simulation.world_seed
        self._actions = self._kind(simulation)
        known = simulation.cameras
        self.cameras = {role: known[role] for role in self._roles}
        rates_hz = [camera.rate_hz for camera in (self.cameras or known).values()]  # without cameras: decisions at the rig's rate
        rate_hz = max(rates_hz, default=simulation.control_rate_hz)
        self._step_s = 1.0 / rate_hz
        self.metadata = {**type(self).metadata, "render_fps": int(rate_hz) if rate_hz == int(rate_hz) else rate_hz}

    def _spaces(self, simulation):
        """Returns the spaces of observations and actions. Images that have arrived have no effect on them."""
        cameras = simulation.cameras
        spaces = {}
        for role in self._roles:
            channel = simulation.channel(role)
            if channel == "corners":
                raise InputError(f"cameras: '{role}' delivers corners, whose number varies; valid channels: grey, color, depth")
            shape = (cameras[role].height_px, cameras[role].width_px, 3 if channel == "color" else 1)
            spaces[role] = (Box(0.0, self._arguments["depth_far_m"], shape, np.float32) if channel == "depth"
                            else Box(0, 255, shape, np.uint8))
        spaces["state"] = Box(-np.inf, np.inf, (STATE,), np.float32)
        if self._kind.rates:
            spaces["rates"] = Box(-np.inf, np.inf, (3,), np.float32)
        return Dict(spaces), Box(-1.0, 1.0, (self._kind(simulation).size,), np.float32)

    def _blank(self, role):
        space = self.observation_space[role]
        return np.zeros(space.shape, space.dtype) if space.dtype == np.uint8 else space.high.copy()

    def _image(self, role, image):
        """Returns a copy of an image in its space."""
        space = self.observation_space[role]
        if space.dtype == np.uint8:
            return image.reshape(space.shape).copy()
        far_m = space.high.flat[0]
        return np.clip(np.where(np.isfinite(image), image, far_m), 0.0, far_m).astype(np.float32).reshape(space.shape)

    def _goal_distance_m(self, seen):
        return float(np.linalg.norm(seen.goal.p_WG_m - self._simulation.truth.p_WB_m))

    def _observe(self, seen):
        for role, image in seen.images.items():
            self._images[role] = self._image(role, image)
        observation = {role: image.copy() for role, image in self._images.items()}
        observation["state"] = state_of(seen.navigation, seen.goal)
        if self._kind.rates:
            observation["rates"] = seen.navigation.w_WB_B_est_radps.astype(np.float32)
        return observation

    def _info(self):
        info = {"clearance_m": self._simulation.proximity.obstacle_clearance_m,
                "p_WB_true_m": self._simulation.truth.p_WB_m.copy()}
        if self._result is not None:
            info["result"] = self._result
        return info
