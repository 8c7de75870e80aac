"""A drone, or several, that guide a crowd: gymnasium's interface over throng.engine, alone or in several processes."""

from __future__ import annotations

import json
import multiprocessing
import os
from typing import Any, Callable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._job_base import plain
from ._spaces import BaseEnv, Box, Dict
from .engine import EngineError, JobLike, Simulation, job_text

#: An action of 1 along each axis: m/s ahead and to the left, m/s up, rad/s of yaw.
SPEED_MPS, CLIMB_MPS, YAW_RATE_RAD_S = 5.0, 2.0, 1.5
#: Pitch of a camera at an action of -1 and of 1, and its yaw at 1 (rad).
PITCH_RAD, PAN_RAD = np.radians((-90.0, 30.0)), np.pi

#: Reward of a step: its arguments are the environment and the information about the step.
Reward = Callable[["Env", Mapping[str, Any]], float]


def waiting_reward(env: "Env", info: Mapping[str, Any]) -> float:
    """Minus the share of all people who are still inside, times the step's seconds: the mean escape time, as a return."""
    return -float(info["inside"]) / max(1, env.people) * env.decision_s


class Env(BaseEnv):  # type: ignore[misc]
    """A job's run that a policy flies: `reset(seed)`, `step(action)`, `render()`, as gymnasium has them.

    An action is 5 numbers from -1 to 1 per drone: velocity ahead, to the left and up in its heading, yaw rate (SPEED_MPS,
    CLIMB_MPS, YAW_RATE_RAD_S), and its beacon (above 0: on); with `gimbal`, two more: the direction of its camera, pitch
    from straight down to 30 degrees above the horizon (PITCH_RAD) and yaw (PAN_RAD). Observations, by `observe`:

    - `state`: per drone position (m, 3), velocity (3), sine and cosine of the heading (8 numbers)
    - `grid`: people per square meter on a grid of `cells` over the area that people leave (rows from the south)
    - `image`: what the first drone's camera sees, (height, width, 3)

    An episode terminates when nobody is in that area any more, and is truncated at the job's end. The flight repeats exactly from
    `flown_job()`. `simulation` gives everything else: positions, exits, events.
    """

    metadata = {"render_modes": ["rgb_array"]}

    def __init__(
        self,
        job: JobLike,
        *,
        observe: Sequence[str] = ("state", "grid"),
        reward: Reward = waiting_reward,
        decision_s: float = 0.5,
        cells: tuple[int, int] = (16, 16),
        image_size: tuple[int, int] = (320, 180),
        gimbal: bool = False,
        trace: str | os.PathLike[str] | None = None,
        render_mode: str | None = None,
    ) -> None:
        unknown = set(observe) - {"state", "grid", "image"}
        if unknown or not observe:
            raise ValueError(
                f"observe: found {sorted(unknown) or 'nothing'}, expected state, grid and image, or some of them"
            )
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode: found {render_mode!r}, expected None or 'rgb_array'")
        if isinstance(job, (str, os.PathLike)):
            text, source = job_text(job)
            try:
                job = json.loads(text)
            except ValueError as error:
                raise EngineError(f"{source}: found no JSON ({error}), expected a job") from None
        self.job: dict[str, Any] = dict(plain(job))
        self.observe = tuple(observe)
        self.reward = reward
        self.wanted_decision_s = float(decision_s)
        self.cells = cells
        self.image_size = image_size
        self._columns = 7 if gimbal else 5
        self.trace = trace
        self.render_mode = render_mode
        self._random_seeds = np.random.default_rng(self.job.get("seed", 1))
        self._begin(self.job.get("seed"))
        drones = len(self.simulation.drones)
        shape = (self._columns,) if drones == 1 else (drones, self._columns)
        self.action_space = Box(-1.0, 1.0, shape=shape, dtype=np.float32)
        spaces: dict[str, Any] = {}
        if "state" in observe:
            spaces["state"] = Box(-np.inf, np.inf, shape=(drones, 8), dtype=np.float32)
        if "grid" in observe:
            spaces["grid"] = Box(0.0, np.inf, shape=(cells[1], cells[0]), dtype=np.float32)
        if "image" in observe:
            spaces["image"] = Box(0, 255, shape=(image_size[1], image_size[0], 3), dtype=np.uint8)
        self.observation_space = Dict(spaces)

    def _begin(self, seed: int | None) -> None:
        simulation = Simulation(self.job, seed=seed, remote=True, trace=self.trace, image_size=self.image_size)
        self.simulation = simulation
        self._steps = max(1, round(self.wanted_decision_s / simulation.dt_s))
        #: Seconds of a step: the whole number of the engine's steps nearest to those asked for.
        self.decision_s = self._steps * simulation.dt_s
        #: People at the start and those who arrive: agents that are people.
        self.people = int(simulation.is_person.sum())
        self._low, self._high = simulation.area

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begins a run: of this seed, else of the next one that the job's seed gives."""
        if seed is None:
            seed = int(self._random_seeds.integers(1, 2**31))
        else:
            self._random_seeds = np.random.default_rng(seed)
        self._begin(seed)
        return self._observation(), self._info([])

    def step(self, action: ArrayLike) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        rows = np.atleast_2d(np.asarray(action, dtype=np.float64)).clip(-1, 1)
        if rows.shape != (len(self.simulation.drones), self._columns):
            raise ValueError(f"action: found the shape {rows.shape}, expected {self.action_space.shape}")
        commands = rows * np.array([SPEED_MPS, SPEED_MPS, CLIMB_MPS, YAW_RATE_RAD_S, 1, 1, PAN_RAD])[: self._columns]
        if self._columns == 7:
            commands[:, 5] = np.interp(rows[:, 5], (-1, 1), PITCH_RAD)
        self.simulation.step(commands, self._steps)
        info = self._info(self.simulation.events())
        terminated = info["inside"] == 0
        return self._observation(), float(self.reward(self, info)), terminated, self.simulation.is_over, info

    def render(self) -> NDArray[np.uint8] | None:
        return self.simulation.image() if self.render_mode == "rgb_array" else None

    def flown_job(self) -> dict[str, Any]:
        """The job that repeats the flight so far."""
        return self.simulation.flown_job()

    def finish(self) -> list[str]:
        """Ends the run and completes its trace."""
        return self.simulation.finish()

    def close(self) -> None:
        """Forgets the run."""
        self.__dict__.pop("simulation", None)

    def _info(self, events: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
        return {
            "time_s": self.simulation.time_s,
            "inside": int(self.simulation.inside.sum()),
            "events": list(events),
        }

    def _observation(self) -> dict[str, Any]:
        observation: dict[str, Any] = {}
        if "state" in self.observe:
            observation["state"] = self._state()
        if "grid" in self.observe:
            observation["grid"] = self._grid()
        if "image" in self.observe:
            observation["image"] = self.simulation.image()
        return observation

    def _state(self) -> NDArray[np.float32]:
        rows = self.simulation.drones
        w, x, y, z = rows[:, 6:10].T
        sine, cosine = 2 * (w * z + x * y), 1 - 2 * (y * y + z * z)
        length = np.maximum(np.hypot(sine, cosine), 1e-9)
        state: NDArray[np.float32] = np.column_stack([rows[:, :6], sine / length, cosine / length]).astype(np.float32)
        return state

    def _grid(self) -> NDArray[np.float32]:
        places = self.simulation.positions[self.simulation.inside]
        columns, rows = self.cells
        edges = [
            np.linspace(self._low[1], self._high[1], rows + 1),
            np.linspace(self._low[0], self._high[0], columns + 1),
        ]
        counts, _, _ = np.histogram2d(places[:, 1], places[:, 0], bins=edges)
        area_m2 = float(np.prod((self._high - self._low) / np.array(self.cells)))
        density: NDArray[np.float32] = (counts / area_m2).astype(np.float32)
        return density


def _serve(connection: Any, make: Callable[[], Env]) -> None:
    env = make()
    while True:
        name, arguments = connection.recv()
        if name == "close":
            env.close()
            connection.close()
            return
        try:
            connection.send((getattr(env, name)(**arguments), None))
        except Exception as error:  # pylint: disable=broad-exception-caught
            connection.send((None, error))


class VectorEnv:
    """Several environments, each in a process of its own: the same calls, for all at once.

    `make` is called in each process; episodes that end begin again, and their last observation is in
    `info["final_observation"]`.
    """

    def __init__(self, make: Callable[[], Env], count: int) -> None:
        context = multiprocessing.get_context("spawn")  # a forked process may not use the parent's GL context
        self._connections = []
        self._processes = []
        for _ in range(count):
            here, there = context.Pipe()
            process = context.Process(target=_serve, args=(there, make), daemon=True)
            process.start()
            there.close()
            self._connections.append(here)
            self._processes.append(process)
        self.count = count

    def _call(self, name: str, arguments: Sequence[Mapping[str, Any]]) -> list[Any]:
        for connection, own in zip(self._connections, arguments):
            connection.send((name, dict(own)))
        answers = [connection.recv() for connection in self._connections]
        for _, error in answers:
            if error is not None:
                raise error
        return [answer for answer, _ in answers]

    def reset(self, *, seed: int | None = None) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """All begin again, with the seeds seed, seed + 1, ..."""
        seeds = [{"seed": None if seed is None else seed + i} for i in range(self.count)]
        answers = self._call("reset", seeds)
        return _stacked([observation for observation, _ in answers]), [info for _, info in answers]

    def step(
        self, actions: ArrayLike
    ) -> tuple[dict[str, Any], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], list[dict[str, Any]]]:
        rows = np.asarray(actions)
        if len(rows) != self.count:
            raise ValueError(f"actions: found {len(rows)}, expected one for each of {self.count} environments")
        answers = self._call("step", [{"action": row} for row in rows])
        observations = [answer[0] for answer in answers]
        infos = [answer[4] for answer in answers]
        for number, (last, _, terminated, truncated, info) in enumerate(answers):
            if terminated or truncated:
                self._connections[number].send(("reset", {}))
                (observations[number], _), error = self._connections[number].recv()
                if error is not None:
                    raise error
                info["final_observation"] = last
        return (
            _stacked(observations),
            np.array([answer[1] for answer in answers]),
            np.array([answer[2] for answer in answers]),
            np.array([answer[3] for answer in answers]),
            infos,
        )

    def close(self) -> None:
        for connection, process in zip(self._connections, self._processes):
            try:
                connection.send(("close", {}))
            except OSError:
                pass
            process.join()
        self._connections, self._processes = [], []

    def __enter__(self) -> "VectorEnv":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _stacked(observations: Sequence[Mapping[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    return {name: np.stack([observation[name] for observation in observations]) for name in observations[0]}
