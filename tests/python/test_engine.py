"""The engine in the process and gymnasium's interface: traces of `throng simulate`, views, commands, episodes."""
import hashlib
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import common
import numpy as np
import throng
from throng.engine import EngineError, Simulation

os.environ["THRONG_PROGRAM"] = str(common.THRONG)
JOB = {
    "scenario": "city_square/nearest_exit",
    "seed": 3,
    "crowd": {"agents": 40},
    "drones": [
        {
            "id": "d1",
            "start": [0, -10, 20],
            "guidance": {"policy": "waypoints", "waypoints": [[0, -10, 20], [5, -5, 20]]},
        }
    ],
    "capture": {"to_s": 5},
}


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class Engine(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def simulated(self, job):
        """The hash of the trace that the program writes."""
        file = self.folder / "job.json"
        file.write_text(json.dumps(job))
        subprocess.run([common.THRONG, "simulate", file, "-o", self.folder / "s.h5"], check=True, capture_output=True)
        return sha256(self.folder / "s.h5")

    def test_the_trace_is_that_of_the_program(self):
        for seed in (3, 11):
            simulation = Simulation(JOB, seed=seed, trace=self.folder / "steps.h5")
            while not simulation.is_over:
                simulation.step()
            simulation.finish()
            self.assertEqual(sha256(self.folder / "steps.h5"), self.simulated({**JOB, "seed": seed}))

    def test_arrays_show_the_engine_s_memory(self):
        simulation = Simulation(JOB)
        positions, before = simulation.positions, simulation.positions.copy()
        self.assertEqual(positions.shape[1], 2)
        self.assertEqual(int(simulation.present.sum()), 40)
        np.testing.assert_array_equal(simulation.drones[0, :3], [0, -10, 20])
        simulation.step(steps=10)
        self.assertTrue((positions != before).any())
        np.testing.assert_array_equal(positions, simulation.positions)
        with self.assertRaises(ValueError):
            positions[0, 0] = 1
        moved = (positions - before)[simulation.present]
        np.testing.assert_allclose(moved, 10 * simulation.dt_s * simulation.velocities[simulation.present], atol=1.5)
        del simulation
        self.assertTrue(np.isfinite(positions).all())  # the array keeps what it shows

    def test_a_drone_follows_commands_and_its_job_repeats_it(self):
        simulation = Simulation(JOB, remote=True, trace=self.folder / "flown.h5")
        for _ in range(20):
            simulation.step([[2, 0, 0.5, 0.2, 1]])
        self.assertGreater(simulation.drones[0, 2], 20.1)
        self.assertGreater(float(np.hypot(*(simulation.drones[0, :2] - [0, -10]))), 0.5)
        job = simulation.flown_job()
        simulation.finish()
        self.assertEqual(sha256(self.folder / "flown.h5"), self.simulated(job))

    def test_a_camera_turns_and_the_flown_job_says_so(self):
        simulation = Simulation(JOB, remote=True, image_size=(128, 72))
        ahead = simulation.image()
        simulation.step([[0, 0, 0, 0, 0, -np.pi / 2, 0.5]], steps=15)
        self.assertGreater(float(np.abs(simulation.image().astype(float) - ahead).mean()), 10)
        setpoints = simulation.flown_job()["drones"][0]["guidance"]["setpoints"]
        self.assertEqual(setpoints[-1][6], -90)
        self.assertAlmostEqual(setpoints[-1][7], np.degrees(0.5), delta=1e-3)
        self.assertEqual(len(setpoints[0]), 6)  # as the job has it until then

    def test_events_are_the_rows_of_a_trace(self):
        # Starts beside a wall: near misses, which have a partner and a distance.
        job = {**JOB, "drones": [{"id": "d1", "start": [0, -10, 2.2]}]}
        simulation = Simulation(job, remote=True)
        events = []
        for _ in range(60):
            simulation.step([[3, 0, 0, 0.6, 0]])
            events += simulation.events()
        simulation.finish()
        events += simulation.events()
        self.assertTrue(events)
        for event in events:
            self.assertEqual(
                set(event), {"time_s", "type", "agent", "drone", "value", "partner", "other", "extra"}, event
            )

    def test_images_have_the_size_that_was_asked_for(self):
        simulation = Simulation(JOB, image_size=(128, 72))
        first = simulation.image("d1")
        self.assertEqual((first.shape, first.dtype), ((72, 128, 3), np.uint8))
        self.assertGreater(float(first.std()), 5)
        simulation.step(steps=20)
        self.assertTrue((simulation.image() != first).any())

    def test_mistakes_are_named(self):
        for job, expected in (
            ({**JOB, "scenario": "city_square/nearest_exti"}, 'did you mean "city_square/nearest_exit"'),
            ({**JOB, "capture": {"to_s": "long"}}, "/capture/to_s"),
        ):
            with self.assertRaisesRegex(EngineError, expected):
                Simulation(job)
        flown = Simulation(JOB, remote=True)
        for wrong in ([[1, 2, 3]], [[0, 0, 0, 0, np.nan]], np.zeros((2, 5))):
            with self.assertRaises(EngineError):
                flown.step(wrong)
        with self.assertRaisesRegex(EngineError, "remote=True"):
            Simulation(JOB).step([[0, 0, 0, 0, 0]])


class Environment(unittest.TestCase):
    def test_spaces_and_episodes_are_as_gymnasium_has_them(self):
        env = throng.Env(JOB, observe=("state", "grid", "image"), image_size=(64, 36), render_mode="rgb_array")
        env.action_space.seed(1)
        observation, info = env.reset(seed=5)
        self.assertTrue(env.observation_space.contains(observation))
        self.assertEqual(info["inside"], 40)
        self.assertAlmostEqual(float(observation["grid"].sum()) * _cell_m2(env), 40, places=3)
        steps = 0
        while True:
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
            self.assertTrue(env.observation_space.contains(observation))
            self.assertAlmostEqual(reward, -info["inside"] / 40 * env.decision_s)
            steps += 1
            if terminated or truncated:
                break
        self.assertFalse(terminated)
        self.assertEqual(steps, round(5 / env.decision_s))
        self.assertEqual(env.render().shape, (36, 64, 3))
        env.close()

    def test_equal_seeds_and_actions_give_equal_episodes(self):
        def episode(seed):
            env = throng.Env(JOB)
            env.reset(seed=seed)
            actions = np.random.default_rng(1).uniform(-1, 1, (6, 5))
            return [env.step(action)[0]["state"] for action in actions], env.simulation.positions.copy()

        (states, people), (again, people_again), (other, people_other) = episode(7), episode(7), episode(8)
        np.testing.assert_array_equal(states, again)
        np.testing.assert_array_equal(people, people_again)
        self.assertTrue((people != people_other).any())

    def test_the_gimbal_is_a_part_of_the_action_if_it_is_asked_for(self):
        env = throng.Env(JOB, gimbal=True)
        env.reset(seed=1)
        self.assertEqual(env.action_space.shape, (7,))
        for _ in range(5):
            env.step([0, 0, 0, 0, 0, 1, -0.25])
        setpoint = env.flown_job()["drones"][0]["guidance"]["setpoints"][-1]
        self.assertAlmostEqual(setpoint[6], 30, places=2)
        self.assertAlmostEqual(setpoint[7], -45, places=2)

    def test_a_reward_of_the_user_s_own_and_wrong_arguments(self):
        env = throng.Env(JOB, reward=lambda env, info: env.simulation.drones[0, 2])
        env.reset(seed=1)
        self.assertGreater(env.step([0, 0, 1, 0, 0])[1], 20)
        for wrong in (np.zeros(4), np.zeros((2, 5))):
            with self.assertRaisesRegex(ValueError, "shape"):
                env.step(wrong)
        with self.assertRaisesRegex(ValueError, "lidar"):
            throng.Env(JOB, observe=("lidar",))

    def test_several_processes_give_what_one_gives(self):
        with throng.VectorEnv(make_env, 2) as envs:
            observation, infos = envs.reset(seed=20)
            self.assertEqual(observation["state"].shape, (2, 1, 8))
            for _ in range(3):
                observation, rewards, _, _, infos = envs.step(np.full((2, 5), 0.5))
            alone = make_env()
            alone.reset(seed=21)
            for _ in range(3):
                expected, reward, *_ = alone.step(np.full(5, 0.5))
            np.testing.assert_array_equal(observation["grid"][1], expected["grid"])
            self.assertEqual(rewards[1], reward)
            with self.assertRaisesRegex(ValueError, "one for each of 2"):
                envs.step(np.zeros((3, 5)))


def _cell_m2(env):
    return float(np.prod((env._high - env._low) / np.array(env.cells)))


def make_env():
    return throng.Env(JOB)


if __name__ == "__main__":
    common.main()
