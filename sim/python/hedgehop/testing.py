"""Checks the contract of avoidance modules, for the tests of your modules."""

import copy
import math

import numpy as np

from ._native import Decision, Goal, HoverCommand, NavigationState, Observation
from .simulation import Simulation


def _numbers(answer):
    """Returns all values of a decision as comparable bits."""
    command = answer.command if isinstance(answer, Decision) else answer
    fields = sorted(name for name in dir(command) if not name.startswith("_"))
    values = [np.asarray(getattr(command, name), float).tobytes() for name in fields]
    if isinstance(answer, Decision):
        values += [answer.status, np.asarray(answer.signals, float).tobytes()]
    return [type(command).__name__, *values]


class _Recorder:
    """Replaces the module and stores its inputs."""

    def __init__(self, module):
        self.needs = module.needs() if callable(getattr(module, "needs", None)) else getattr(module, "needs", [])
        self.setup, self.observations = None, []

    def reset(self, setup):
        self.setup = setup

    def update(self, observation):
        images = {role: image.copy() for role, image in observation.images.items()}
        self.observations.append(Observation(observation.t_ns, images, copy_of(observation.navigation),
                                             Goal(observation.goal.p_WG_m, observation.goal.heading_rad),
                                             dict(observation.image_t_ns)))
        return HoverCommand()


def copy_of(navigation):
    """Returns a copy of a NavigationState."""
    copied = NavigationState()
    for name in dir(NavigationState):
        if not name.startswith("_"):
            setattr(copied, name, copy.copy(getattr(navigation, name)))
    return copied


def _fly(module, setup, observations):
    if hasattr(module, "reset"):
        module.reset(setup)
    return [_numbers(module.update(observation)) for observation in observations]


def check_module(cls, scenario, *, decisions=5, **parameters):
    """Runs a module with the inputs from the start of a scenario. Raises AssertionError if the module violates its contract:
    equal inputs give equal decisions; reset() restores the initial state; annotate() does not affect decisions; lost and
    blank images are accepted; commands are finite; the number of signals is as declared.

    cls       class with `update`, created with **parameters.
    scenario  file; its rig has the cameras that the module needs.
    """
    recorder = _Recorder(cls(**parameters))
    simulation = Simulation(scenario, module=recorder)
    while len(recorder.observations) < decisions and not simulation.over:
        simulation.step()
    setup, observations = recorder.setup, recorder.observations

    first = _fly(cls(**parameters), setup, observations)
    used = cls(**parameters)
    assert _fly(used, setup, observations) == first, "equal inputs give different decisions"
    assert _fly(used, setup, observations) == first, "reset() does not restore the initial state"

    drawn = cls(**parameters)
    if hasattr(drawn, "reset"):
        drawn.reset(setup)
    for i, observation in enumerate(observations):
        assert _numbers(drawn.update(observation)) == first[i], "annotate() changes a decision"
        if hasattr(drawn, "annotate"):
            image = drawn.annotate()
            assert image is None or (image.dtype == np.uint8 and image.shape[2:] == (3,)), "annotate() does not return an RGB image"

    survivor = cls(**parameters)
    if hasattr(survivor, "reset"):
        survivor.reset(setup)
    announced = getattr(survivor, "signals", {})
    announced = announced() if callable(announced) else announced
    for i, seen in enumerate(observations):
        images = {} if i % 2 else {role: np.zeros_like(image) for role, image in seen.images.items()}
        times = {role: seen.image_t_ns[role] for role in images}
        answer = survivor.update(Observation(seen.t_ns, images, seen.navigation, seen.goal, times))
        command = answer.command if isinstance(answer, Decision) else answer
        for name in dir(command):
            if not name.startswith("_"):
                assert np.all(np.isfinite(getattr(command, name))), f"{name} is not finite if images are lost or blank"
        if isinstance(answer, Decision):
            assert len(answer.signals) == len(announced), "a decision has a different number of signals than declared"
            assert answer.status and not set(answer.status) & set(' ,"\n'), "a status must be one word"
    assert all(math.isfinite(value) or math.isnan(value) for value in _metrics(survivor).values()), "a metric is infinite"


def _metrics(module):
    metrics = getattr(module, "metrics", {})
    return metrics() if callable(metrics) else metrics
