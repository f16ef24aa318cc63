#!/usr/bin/env python3
"""Trains a network on the flights of section_grid and writes it for onnx_policy:

    PYTHONPATH=build/release/python python3 docs/policy/clone.py configs/leaderboard/modules/cloned_policy.onnx

The network receives one image, whereas section_grid receives a stereo pair, and the state of Env ("state"). Its target is the
motion of section_grid in the next half second. Needs PyTorch (python3-torch). On one machine, equal seeds give equal files.
"""

import argparse
import os
import pathlib
import sys

import numpy as np
import torch
from torch import nn

import hedgehop

WORLDS = pathlib.Path(__file__).resolve().parents[2] / "configs/leaderboard/worlds"
NAMES = ("tree", "balloon", "wall", "park", "forest", "city")
SEEDS = range(1101, 1106)
AIRCRAFT = {"vehicle.use": "../../vehicles/s900.yaml", "avionics.autopilot.speed_limit": 2.235,
            "avionics.autopilot.acceleration_limit": 2, "rig.use": "../../rigs/perez2018_640.yaml",
            "rig.cameras": [{"role": "down", "width": 120, "height": 120, "fov": 50, "rate": 50, "channel": "grey",
                             "down": 0.2, "pitch": -90}],
            "avoidance.use": "../modules/section_grid.yaml", "drawing.renderer": "tiles", "film.enabled": False}
POOL = 8
LOOK_AHEAD_S = 0.5


def fly(world, seed):
    """Flies section_grid once. Returns the outcome, pooled images, states, and the actions that reproduce the motion."""
    simulation = hedgehop.Simulation(WORLDS / f"{world}.yaml", seed=seed, set=AIRCRAFT)
    times, images, states = [], [], []
    seen = simulation.observation
    while not simulation.over:
        if "left" in seen.images:
            image = seen.images["left"].astype(np.float32)
            rows, columns = image.shape
            images.append(image.reshape(rows // POOL, POOL, columns // POOL, POOL).mean((1, 3)))
            states.append(hedgehop.state_of(seen.navigation, seen.goal))
            times.append(seen.t_s)
        seen = simulation.step()
    flown = simulation.trajectory
    limit_mps, _ = simulation.limits
    actions = []
    yaw = np.unwrap(flown.est_yaw_rad)
    count = sum(t_s + LOOK_AHEAD_S <= flown.t_s[-1] for t_s in times)
    for t_s in times[:count]:
        after = (flown.t_s >= t_s) & (flown.t_s <= t_s + LOOK_AHEAD_S)
        first, last = np.flatnonzero(after)[[0, -1]]
        span_s = flown.t_s[last] - flown.t_s[first]
        north, east = flown.est_v_north_mps[after].mean(), flown.est_v_east_mps[after].mean()
        cos, sin = np.cos(yaw[first]), np.sin(yaw[first])
        actions.append([(cos * north + sin * east) / limit_mps, (-sin * north + cos * east) / limit_mps,
                        -flown.est_v_down_mps[after].mean(), (yaw[last] - yaw[first]) / span_s])
    outcome = simulation.result()["outcome"]
    print(f"{world} {seed}: {count} decisions, {outcome}", file=sys.stderr, flush=True)
    return outcome, np.array(images[:count]), np.array(states[:count]), np.clip(np.array(actions, np.float32), -1.0, 1.0)


class Policy(nn.Module):
    """Three convolutions over the pooled image, then two layers with the state."""

    def __init__(self, rows, columns):
        super().__init__()
        self.see = nn.Sequential(nn.Conv2d(1, 16, 5, 2), nn.ReLU(), nn.Conv2d(16, 24, 3, 2), nn.ReLU(),
                                 nn.Conv2d(24, 32, 3, 2), nn.ReLU(), nn.Flatten(),
                                 nn.Dropout(0.3))
        with torch.no_grad():
            features = self.see(torch.zeros(1, 1, rows, columns)).shape[1]
        self.look = nn.Sequential(nn.Linear(features, 64), nn.ReLU())
        self.decide = nn.Sequential(nn.Linear(64 + 10, 64), nn.ReLU(), nn.Linear(64, 4), nn.Tanh())
        # The velocity is masked: with it, the network learns to keep its speed, and never moves again after a stop.
        scale = torch.tensor([0.05, 0.05, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1])
        self.register_buffer("scale", scale)

    def forward(self, pooled, state):
        return self.decide(torch.cat([self.look(self.see(pooled)), torch.tanh(state * self.scale)], 1))


class Whole(nn.Module):
    """The network with the input of onnx_policy: an image of the camera's size, values in [-0.5, 0.5]."""

    def __init__(self, policy):
        super().__init__()
        self.pool, self.policy = nn.AvgPool2d(POOL), policy

    def forward(self, left_grey, state):
        return self.policy(self.pool(left_grey), state)


def train(images, states, actions, epochs):
    torch.manual_seed(1)
    policy = Policy(*images.shape[1:])
    pooled = torch.from_numpy((images[:, None] - 127.5) / 255.0)
    states, actions = torch.from_numpy(states), torch.from_numpy(actions)
    optimizer = torch.optim.Adam(policy.parameters(), 1e-3, weight_decay=1e-5)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, epochs)
    order = torch.Generator().manual_seed(1)
    for epoch in range(epochs):
        policy.train()
        losses = []
        for batch in torch.randperm(len(states), generator=order).split(64):
            loss = nn.functional.smooth_l1_loss(policy(pooled[batch], states[batch]), actions[batch], beta=0.1)
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            losses.append(loss.item())
        schedule.step()
        print(f"epoch {epoch}: {np.mean(losses):.4f}", file=sys.stderr, flush=True)
    return policy.eval()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("onnx", help="file to write")
    parser.add_argument("--epochs", type=int, default=20)
    parser.add_argument("--flights", help="file of the flights: read if it exists, else written")
    arguments = parser.parse_args()
    torch.set_num_threads(1)
    if arguments.flights and os.path.exists(arguments.flights):
        data = [np.load(arguments.flights)[name] for name in ("images", "states", "actions")]
    else:
        flights = [fly(world, seed) for world in NAMES for seed in SEEDS]
        data = [np.concatenate(parts) for parts in list(zip(*(f[1:] for f in flights if f[0] == "reached")))]
        if arguments.flights:
            np.savez(arguments.flights, images=data[0], states=data[1], actions=data[2])
    whole = Whole(train(*data, arguments.epochs))
    rows, columns = data[0].shape[1:]
    torch.onnx.export(whole, (torch.zeros(1, 1, rows * POOL, columns * POOL), torch.zeros(1, 10)), arguments.onnx,
                      input_names=["left_grey", "state"], output_names=["action"], opset_version=13)


if __name__ == "__main__":
    main()
