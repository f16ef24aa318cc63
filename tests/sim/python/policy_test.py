"""Networks from PyTorch: `onnx_policy` flies the actions that PyTorch and a second ONNX runtime compute."""

import contextlib
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import hedgehop
from flights import CITY, SHORT

try:
    import torch
    from torch import nn
except ImportError:
    torch = None

HERE = pathlib.Path(__file__).resolve().parent
RIG = {"rig.cameras": [{"role": "front", "width": 32, "height": 24, "fov": 90, "rate": 25, "channel": "grey"},
                       {"role": "side", "width": 16, "height": 16, "fov": 60, "rate": 25, "channel": "color",
                        "yaw": 90},
                       {"role": "down", "width": 120, "height": 120, "fov": 50, "rate": 50, "channel": "grey",
                        "down": 0.2, "pitch": -90}]}
SETTINGS = {**SHORT, **RIG, "duration": 2, "rig.sensor": {}, "drawing.renderer": "tiles", "avoidance": {"module": "go_to_goal"}}
IMAGES = [{"camera": "front", "channel": "grey", "mean": 127.5},
          {"camera": "side", "channel": "color", "mean": 50, "scale": 0.01}]


def network():
    """Two images and the state as input, an action as output; random, with a fixed seed."""

    class Both(nn.Module):
        def __init__(self):
            super().__init__()
            self.front = nn.Sequential(nn.Conv2d(1, 4, 3, 2), nn.ReLU(), nn.MaxPool2d(2), nn.Flatten(),
                                       nn.Linear(140, 8))
            self.side = nn.Sequential(nn.Conv2d(3, 4, 5, 3), nn.BatchNorm2d(4), nn.Sigmoid(), nn.AvgPool2d(2),
                                      nn.Flatten())
            self.decide = nn.Sequential(nn.Linear(8 + 16 + 10, 16), nn.ReLU(), nn.Linear(16, 4), nn.Tanh())

        def forward(self, front_grey, side_color, state):
            return self.decide(torch.cat([self.front(front_grey), self.side(side_color), 0.1 * state], 1))

    torch.manual_seed(5)
    return Both().eval()


def inputs_of(images, state):
    """Returns images as onnx_policy prepares them with the configuration IMAGES."""
    front = (images["front"].reshape(24, 32).astype(np.float32) - 127.5) / 255.0  # an Env's images have a channel axis
    side = (images["side"].astype(np.float32) - 50.0) * 0.01
    return front[None, None], np.ascontiguousarray(side.transpose(2, 0, 1)[None]), state[None]


@unittest.skipIf(torch is None, "needs python3-torch")
class Policy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.exit = contextlib.ExitStack()
        cls.folder = pathlib.Path(cls.exit.enter_context(tempfile.TemporaryDirectory()))
        cls.network = network()
        shapes = [(1, 1, 24, 32), (1, 3, 16, 16), (1, 10)]
        torch.onnx.export(cls.network, tuple(torch.zeros(shape) for shape in shapes), str(cls.folder / "both.onnx"),
                          input_names=["front_grey", "side_color", "state"], output_names=["action"], opset_version=13)
        cls.avoidance = {"module": "onnx_policy", "file": str(cls.folder / "both.onnx"), "images": IMAGES}
        cls.flown = hedgehop.Simulation(CITY, seed=3, set={**SETTINGS, "avoidance": cls.avoidance})
        cls.rows = []
        while not cls.flown.over:
            seen = cls.flown.observation
            if seen.images:
                images = {role: image.copy() for role, image in seen.images.items()}
            cls.rows.append(inputs_of(images, hedgehop.state_of(seen.navigation, seen.goal)))
            cls.flown.step()
        decisions = cls.flown.decisions
        cls.actions = np.stack([decisions[f"action_{name}"] for name in ("forward", "right", "climb", "turn")], 1)
        cls.actions = cls.actions[:len(cls.rows)]  # the last action is computed at the end of the flight

    @classmethod
    def tearDownClass(cls):
        cls.exit.close()

    def test_flies_the_actions_that_pytorch_computes(self):
        with torch.no_grad():
            expected = [self.network(*(torch.from_numpy(x) for x in row))[0].numpy() for row in self.rows]
        self.assertGreater(len(expected), 40)
        self.assertGreater(np.ptp(expected, 0).max(), 0.01)  # the actions vary
        np.testing.assert_allclose(self.actions, expected, atol=1e-5)

    def test_flies_the_actions_that_another_runtime_computes(self):
        if not shutil.which("node") or not shutil.which("npm"):
            self.skipTest("needs node and npm")
        for file in ("package.json", "package-lock.json", ".npmrc", "infer.js"):
            shutil.copy(HERE / "runtime" / file, self.folder)
        fetched = subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts", "--prefer-offline"],
                                 cwd=self.folder, capture_output=True, text=True)
        if fetched.returncode != 0:
            self.skipTest("npm could not fetch onnxruntime-web")
        rows = [{name: {"dims": x.shape, "data": x.ravel().tolist()}
                 for name, x in zip(("front_grey", "side_color", "state"), row)} for row in self.rows]
        done = subprocess.run(["node", "infer.js", "both.onnx"], cwd=self.folder, input=json.dumps(rows),
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        np.testing.assert_allclose(self.actions, json.loads(done.stdout), atol=1e-5)

    def test_env_flies_equally_with_the_same_network(self):
        env = hedgehop.Env(CITY, cameras=["front", "side"], set=SETTINGS)
        observation, info = env.reset(seed=1)
        with torch.no_grad():
            while "result" not in info:
                row = inputs_of(observation, observation["state"])
                action = self.network(*(torch.from_numpy(x) for x in row))[0].numpy()
                observation, _, _, _, info = env.step(action)
        module = hedgehop.Simulation(CITY, seed=info["result"]["seed"], set={**SETTINGS, "avoidance": self.avoidance})
        module.run()
        # Rounding differences grow with each decision, so only the first decisions are compared.
        for name in ("cmd_v_north_mps", "cmd_v_east_mps", "cmd_altitude_m", "cmd_heading_rad"):
            np.testing.assert_allclose(module.decisions[name][:8], env._simulation.decisions[name][:8], atol=1e-5)
        for name in ("north_m", "east_m", "down_m"):
            np.testing.assert_allclose(module.trajectory[name], env._simulation.trajectory[name], atol=0.05)


if __name__ == "__main__":
    unittest.main()
