"""A flight that is stepped from Python equals that of the program. Invalid arguments do not crash it."""

import gc
import math
import pathlib
import random
import tempfile
import threading
import unittest

import numpy as np

import hedgehop
from flights import CITY, SHORT, STRAIGHT, run_program, steady


def city(**more):
    return hedgehop.Simulation(CITY, set=SHORT, **more)


class WholeFlight(unittest.TestCase):
    def test_run_gives_the_result_of_the_program(self):
        with tempfile.TemporaryDirectory() as out:
            _, result, _ = run_program(CITY, SHORT, out, seed=5)
        self.assertEqual(steady(city(seed=5).run()), steady(result))

    def test_steps_and_ticks_give_the_same_flight(self):
        whole = city().run()["trajectory_hash"]
        by_step, by_tick = city(), city()
        while not by_step.over:
            by_step.step()
        while not by_tick.over:
            by_tick.tick()
        self.assertEqual([by_step.result()["trajectory_hash"], by_tick.result()["trajectory_hash"]], [whole, whole])

    def test_reset_starts_again(self):
        sim = city()
        first = sim.run()["trajectory_hash"]
        sim.reset()
        self.assertEqual((sim.t_s, sim.over), (0.0, False))
        self.assertEqual(sim.run()["trajectory_hash"], first)
        sim.reset(seed=9)
        self.assertEqual(sim.run()["trajectory_hash"], city(seed=9).run()["trajectory_hash"])

    def test_commands_fly_like_the_module_with_the_same_law(self):
        whole = hedgehop.Simulation(CITY, set=STRAIGHT).run()
        sim = hedgehop.Simulation(CITY, set=STRAIGHT)
        obs = sim.reset()
        while not sim.over:
            north, east, _ = obs.goal.p_WG_m - obs.navigation.p_WB_est_m
            distance_m = math.sqrt(north * north + east * east)
            speed_mps = 3.0 * (distance_m / 4.0 if distance_m < 4.0 else 1.0) / distance_m
            obs = sim.step(hedgehop.VelocityCommand([north * speed_mps, east * speed_mps], -obs.goal.p_WG_m[2],
                                                    obs.goal.heading_rad))
        self.assertEqual(sim.result()["trajectory_hash"], whole["trajectory_hash"])

    def test_a_text_is_a_scenario(self):
        sim = city()
        again = hedgehop.Simulation(text=sim.scenario_yaml)
        self.assertEqual(again.run()["trajectory_hash"], sim.run()["trajectory_hash"])

    def test_tables_contain_the_flight(self):
        sim = city()
        result = sim.run()
        self.assertEqual(len(sim.trajectory), 101)
        self.assertEqual(len(sim.decisions), result["decisions"])
        moved = np.diff(np.stack([sim.trajectory[n] for n in ("north_m", "east_m", "down_m")]), axis=1)
        self.assertAlmostEqual(np.linalg.norm(moved, axis=0).sum(), result["path_length_m"], places=9)
        with tempfile.TemporaryDirectory() as out:
            sim.save(out)
            loaded = hedgehop.load(out)
        self.assertEqual(loaded.result["trajectory_hash"], result["trajectory_hash"])
        for name in sim.trajectory.dtype.names:
            np.testing.assert_array_equal(loaded.trajectory[name], sim.trajectory[name])


class Images(unittest.TestCase):
    def test_views_share_the_simulators_memory_and_outlive_it(self):
        sim = city(cameras=["front"])
        view = sim.reset().images["front"]
        before, address = view.copy(), view.ctypes.data
        self.assertEqual((view.shape, view.dtype), ((200, 200), np.uint8))
        for _ in range(5):
            obs = sim.step(hedgehop.VelocityCommand([3, 0], 10, 0))
        self.assertEqual(obs.images["front"].ctypes.data, address)
        self.assertTrue(np.any(view != before))  # overwritten
        with self.assertRaises(ValueError):
            view[0, 0] = 1
        del sim, obs
        gc.collect()
        self.assertGreater(view.astype(float).std(), 0)  # its memory still exists

    def test_images_at_any_time_do_not_affect_the_flight(self):
        asked = city()
        while not asked.over:
            self.assertEqual(asked.image("rear", "color").shape, (200, 200, 3))
            depth = asked.image("front", "depth")
            self.assertEqual(depth.dtype, np.float32)
            self.assertGreater(np.nanmin(depth), 0)
            labels, classes = asked.image("front", "labels"), asked.image("front", "semantic")
            table = asked.labels
            of_labels = [0, *(table["classes"][row["class"]] for row in table["instances"])]
            np.testing.assert_array_equal(np.array(of_labels)[labels], classes)
            asked.step()
        self.assertEqual(asked.result()["trajectory_hash"], city().run()["trajectory_hash"])

    def test_images_from_chosen_poses_are_those_of_the_flight(self):
        sim = hedgehop.Simulation(CITY, set={**SHORT, "rig.sensor": {}})  # no exposure time, in which the vehicle moves
        for _ in range(5):
            sim.step()
        truth = sim.truth
        pose = (truth.p_WB_m, truth.q_WB)
        depth = np.array(sim.image("front", "depth"))
        sim.step()
        chosen = np.array(sim.image_from("front", "depth", *pose))
        same = (chosen == depth) | (np.abs(chosen - depth) < 1e-4 * np.abs(depth))
        self.assertGreater(np.mean(same), 0.998)  # rounding of the quaternion moves an edge
        flow = np.array(sim.flow_between("front", pose, (sim.truth.p_WB_m, sim.truth.q_WB)))
        self.assertGreater(np.nanmax(np.abs(flow)), 0.0)
        self.assertLess(np.nanmax(np.abs(sim.flow_between("front", pose, pose))), 1e-9)
        with self.assertRaisesRegex(ValueError, "length 1"):
            sim.image_from("front", "grey", (0, 0, -10), (1, 1, 0, 0))

    def test_a_chosen_pose_has_clearances_and_the_noise_of_its_time(self):
        sim = hedgehop.Simulation(CITY, set={**SHORT, "rig.sensor": {"read_noise": 4, "full_well": 10000}})
        p, q = sim.truth.p_WB_m, sim.truth.q_WB
        for found, expected in ((sim.proximity_from(p, q), sim.proximity), (sim.proximity_from((p[0], p[1], 1.0), q), None)):
            self.assertEqual(found.collided, expected is None)
            if expected:
                self.assertAlmostEqual(found.ground_clearance_m, expected.ground_clearance_m, 9)
        first, again, later = (np.array(sim.image_from("front", "grey", p, q, t_s)) for t_s in (0.0, 0.0, 1.0))
        np.testing.assert_array_equal(first, again)
        self.assertGreater(np.mean(first != later), 0.5)
        with self.assertRaisesRegex(ValueError, "finite"):
            sim.proximity_from((0, 0, math.nan), q)

    def test_rays_are_those_of_a_pinhole(self):
        camera = city().cameras["front"]
        p, rays = camera.pinhole, camera.rays()
        np.testing.assert_allclose(np.linalg.norm(rays, axis=2), 1, atol=1e-12)
        v, u = 30, 170
        expected = np.array([(u - p["center_u_px"]) / p["focal_x_px"], (v - p["center_v_px"]) / p["focal_y_px"], 1])
        np.testing.assert_allclose(rays[v, u], expected / np.linalg.norm(expected), atol=1e-12)

    def test_every_lens_projects_the_rays_of_its_pixels(self):
        size = {"width": 64, "height": 48, "focal_x": 40, "rate": 25}
        lenses = [{"role": "pinhole", "distortion": [-0.28, 0.075, 0.0004, -0.0002]},
                  {"role": "rational", "distortion": [0.1, 0.02, 0.0, 0.0, 0.0, 0.2, 0.01, 0.003]},
                  {"role": "fisheye", "model": "fisheye", "distortion": [0.05, 0.01, -0.002, 0.001]},
                  {"role": "unified", "model": "unified", "xi": 0.8, "distortion": [-0.1, 0.02, 0.001, 0.0]},
                  {"role": "double", "model": "double_sphere", "xi": -0.2, "alpha": 0.6}]
        cameras = hedgehop.Simulation(CITY, set={**STRAIGHT, "velocimeter.enabled": False,
                                                  "rig.cameras": [{**size, **lens} for lens in lenses]}).cameras
        v, u = np.mgrid[:48, :64]
        for role, camera in cameras.items():
            with self.subTest(role):
                rays = camera.rays()
                seen = np.isfinite(rays[..., 0])
                self.assertGreater(np.mean(seen), 0.5)
                np.testing.assert_allclose(camera.project(5 * rays[seen]), np.stack([u, v], -1)[seen], atol=1e-6)
                self.assertTrue(np.all(np.isnan(camera.project(rays[~seen]))))
        lens = cameras["pinhole"].lens_parameters
        x, y = 0.3, -0.2
        r2 = x * x + y * y
        radial = 1 + lens["k1"] * r2 + lens["k2"] * r2**2 + lens["k3"] * r2**3
        distorted = [x * radial + 2 * lens["p1"] * x * y + lens["p2"] * (r2 + 2 * x * x),
                     y * radial + lens["p1"] * (r2 + 2 * y * y) + 2 * lens["p2"] * x * y]
        expected = [lens["focal_x_px"] * distorted[0] + lens["center_u_px"],
                    lens["focal_y_px"] * distorted[1] + lens["center_v_px"]]
        np.testing.assert_allclose(cameras["pinhole"].project([2 * x, 2 * y, 2]), expected, atol=1e-9)
        self.assertTrue(np.all(np.isnan(cameras["pinhole"].project([0, 0, -1]))))
        self.assertEqual(set(cameras["double"].lens_parameters) & {"xi", "alpha"}, {"xi", "alpha"})
        self.assertEqual(cameras["rational"].lens_parameters["k6"], 0.003)
        with self.assertRaisesRegex(ValueError, "shape"):
            cameras["pinhole"].project([1, 2])


class BadCalls(unittest.TestCase):
    def test_errors_have_the_text_of_the_program(self):
        with tempfile.TemporaryDirectory() as out:
            status, result, said = run_program(CITY, {**SHORT, "duraton": 3}, out)
        self.assertEqual((status, result), (2, None))
        with self.assertRaises(hedgehop.InputError) as error:
            hedgehop.Simulation(CITY, set={**SHORT, "duraton": 3})
        self.assertIn(str(error.exception), said)
        with self.assertRaisesRegex(hedgehop.InputError, "there is no such file"):
            hedgehop.Simulation("missing.yaml")
        with self.assertRaisesRegex(hedgehop.InputError, "not a finite number"):
            hedgehop.Simulation(CITY, set={"duration": math.nan})
        with self.assertRaisesRegex(hedgehop.InputError, "its cameras: left, right, front, rear, down"):
            city().image("top")
        with self.assertRaisesRegex(ValueError, "allowed: grey, color, depth, labels"):
            city().image("front", "infrared")

    def test_values_may_be_of_numpy_paths_and_any_text(self):
        values = {"name": "flug 🚁", "description": np.str_("größe"), "start.north": np.float32(1.5), "start.east": np.array(2),
                  "tags": np.array(["a", "b"]), "notes": pathlib.Path("a/b")}
        text = hedgehop.Simulation(CITY, set={**SHORT, **values}).scenario_yaml
        for line in ('name: "flug 🚁"', 'description: "größe"', "north: 1.5", "east: 2", 'tags: [a, b]', 'notes: a/b'):
            self.assertIn(line, text)
        for bad in (np.array([math.nan]), "\ud83d", object(), b"x", {1}):
            with self.assertRaisesRegex(hedgehop.InputError, r"set\['name'\]: .* is not a finite number, text, list or dict"):
                hedgehop.Simulation(CITY, set={"name": bad})

    def test_invalid_commands_do_not_affect_the_flight(self):
        sim = hedgehop.Simulation(CITY, set=STRAIGHT)
        sim.step()
        for bad in (hedgehop.VelocityCommand([math.nan, 0], 1, 0), "north", 3, [1, 2], object()):
            with self.assertRaises(ValueError):
                sim.step(bad)
        for bad in ([1, 2, 3], "ab", np.zeros((2, 2)), None):
            with self.assertRaises((TypeError, ValueError)):
                hedgehop.VelocityCommand(bad, 1, 0)
        self.assertEqual(sim.run()["trajectory_hash"], hedgehop.Simulation(CITY, set=STRAIGHT).run()["trajectory_hash"])

    def test_a_call_at_the_wrong_time(self):
        sim = hedgehop.Simulation(CITY, set={**SHORT, "duration": 0.1})
        with self.assertRaisesRegex(RuntimeError, "not over"):
            sim.result()
        sim.run()
        with self.assertRaisesRegex(RuntimeError, "the flight is over"):
            sim.step()

    def test_another_thread_is_rejected(self):
        sim, errors = city(), []

        def use():
            try:
                sim.step()
            except RuntimeError as error:
                errors.append(str(error))

        thread = threading.Thread(target=use)
        thread.start()
        thread.join()
        self.assertRegex(errors[0], "the thread that created it")

    def test_random_calls_raise_and_never_crash(self):
        choose = random.Random(1)
        values = [None, 0, -1, 2**70, 1e308, math.nan, math.inf, "", "front", "x" * 10000, b"\0", [], {}, (1, 2), np.zeros(3),
                  np.zeros((0, 0)), object(), hedgehop.HoverCommand(0.1), hedgehop.Goal(), True]
        sim = hedgehop.Simulation(CITY, set={**SHORT, "duration": 0.4})
        names = [n for n in dir(sim) if not n.startswith("_") and callable(getattr(type(sim), n, None)) and n not in ("run", "save")]
        for _ in range(400):
            arguments = [choose.choice(values) for _ in range(choose.randrange(3))]
            try:
                getattr(sim, choose.choice(names))(*arguments)
            except (TypeError, ValueError, RuntimeError, OverflowError):
                pass
        sim.reset(1)
        self.assertEqual(sim.run()["trajectory_hash"],
                         hedgehop.Simulation(CITY, set={**SHORT, "duration": 0.4}).run()["trajectory_hash"])


if __name__ == "__main__":
    unittest.main()
