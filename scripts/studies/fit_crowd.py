#!/usr/bin/env python3
"""Fits the constants of the pedestrian model ttc to recorded people, and draws from the posterior of the fit.

usage: scripts/studies/fit_crowd.py draw FOLDER START.json DRAWS.jsonl [count=N]
       scripts/studies/fit_crowd.py fit START.json DRAWS.jsonl RESULT.json
       scripts/studies/fit_crowd.py posterior FOLDER START.json DRAWS.jsonl RESULT.json crowd/models/ttc_posterior.csv [count=N]
       scripts/studies/fit_crowd.py left_out FOLDER START.json DRAWS.jsonl TABLE.md [seeds=N]
       scripts/studies/fit_crowd.py show FOLDER START.json [seeds=N] [CONSTANT=VALUE ...]

FOLDER has recordings (docs/validation.md); START.json has the constants around which all else is done. Needs
build/release/scripts/studies/replay_crowd and crowd_gates.

- draw: constants are drawn at random, uniformly within +-SPREAD of START, and all quantities are measured with them: ln of
  model / people of recorded flows, speeds and times, and the values that the suite's own tests limit, where no recording
  says anything. May be interrupted and goes on.
- fit: a linear model of each quantity is fitted to the draws (ridge regression), and the sum of squared errors, each in
  units of its tolerance, is minimized with it. Tolerances of recorded quantities are 0.1; 0.2 for two directions, whose free
  speeds are not known, and 0.25 for the speed before a bottleneck, whose area is 0.6 m^2.
- posterior: approximate Bayesian computation by rejection. Constants are drawn uniformly within +-10 % of RESULT (and the
  spread around START), those for which the linear model expects that they fit, and those are kept with
  which, in one replay, each recorded quantity is within 15 % (35 % for the speed before a bottleneck, 40 % for
  two directions), 8 % on average, and no limit is missed by more than six tolerances.
- left_out: fits and draws again without each experiment, and measures that one. Without a corridor of the Hermes project
  the diagram of these corridors is left out, too.
"""
import json
import math
import os
import re
import subprocess
import sys

import numpy
from scipy.optimize import least_squares

STUDIES = os.path.join(os.path.dirname(__file__), "..", "..", "build", "release", "scripts", "studies")
SPREAD = 0.15  # half of the width of the prior of each constant, as a share of its value
SHARES = ("alongside", "relief")  # are 1 at most
GATES = (
    "square_1,room_100,fd_5,fd_2.9,fd_1.6,fd_1.1,meet_0.3,queue,two_way_0.75,"
    "corner_queued_4,straight_queued_4,door_0.8,door_1.2,door_2,wide_3,geometry"
)
SKIPPED = ("time gap", "density", "band index", "flow 1", "flow 2")  # given by arrivals, or by other quantities
# Limits of the tests of docs/validation.md: greatest or least value, tolerance.
LIMITS = {
    "stuck in the square": ("at most", 0.02, 0.02),
    "counter-flow, s": ("at most", 110, 20),
    "jam in counter-flow": ("at most", 0, 5),
    "flow at 5 /m2": ("at most", 0.5, 0.1),
    "drop of the flow": ("at most", 0.66, 0.03),
    "evasion, s": ("at least", 2.0, 0.1),
    "acceleration, m/s2": ("at most", 0.95, 0.1),
    "turns in a queue": ("at most", 0.8, 0.5),
    "stuck in two ways": ("at most", 0.02, 0.01),
    "two ways": ("at least", 0.82, 0.05),
    "corner": ("at least", 0.88, 0.05),
    "narrowest door": ("at least", 1.55, 0.15),
    "widest door": ("at most", 2.2, 0.15),
    "doors as drawn": ("at most", 0.12, 0.02),
    "opening of 3 m": ("at least", 2.0, 0.15),  # recorded: 2.39 /(m s) of people who walk 1.55 m/s
}


def run(program, *words):
    words = [os.path.join(STUDIES, program), *words]
    return subprocess.run(words, capture_output=True, encoding="utf-8", check=True).stdout.splitlines()


def as_words(constants):
    return [f"{name}={value:.5g}" for name, value in constants.items()]


def recorded_errors(folder, constants, seeds, only=""):
    """ln of model / people of recorded quantities, by "EXPERIMENT QUANTITY"."""
    errors = {}
    experiment = ""
    chosen = [f"only={only}"] if only else []
    for line in run("replay_crowd", folder, "ttc", f"seeds={seeds}", *chosen, *as_words(constants)):
        if not line.startswith(" "):
            experiment = line.split()[0]
            continue
        found = re.match(r"\s+(.*?)\s+([-\d.naif]+)\s+([-\d.naif]+) \+-", line)
        if not found or found[1].startswith(SKIPPED) or (experiment.startswith("bi_") and found[1] != "speed"):
            continue
        recorded, model = float(found[2]), float(found[3])
        error = math.log(max(model, 1e-3) / recorded) if math.isfinite(model) else 1.5
        errors[f"{experiment} {found[1]}"] = max(-1.5, min(1.5, error))
    return errors


def limited_values(constants, seeds):
    """The values of LIMITS."""
    value = {}
    for line in run("crowd_gates", "ttc", f"seeds={seeds}", "only=" + GATES, *as_words(constants)):
        name, *runs = line.split("|")
        value[name.strip()] = numpy.array([[float(word) for word in one.split()] for one in runs])
    mean = {name: runs.mean(axis=0) for name, runs in value.items()}
    doors = [mean[name][0] for name in ("door_0.8", "door_1.2", "door_2")]
    measured = {
        "stuck in the square": mean["square_1"][0],
        "counter-flow, s": mean["room_100"][0],
        "jam in counter-flow": mean["room_100"][1],
        "flow at 5 /m2": mean["fd_5"][0],
        "drop of the flow": mean["fd_2.9"][0] / max(mean["fd_1.1"][0], mean["fd_1.6"][0]),
        "evasion, s": mean["meet_0.3"][0],
        "acceleration, m/s2": mean["meet_0.3"][1],
        "turns in a queue": mean["queue"][0],
        "stuck in two ways": value["two_way_0.75"][:, 2].max(),
        "two ways": value["two_way_0.75"][:, :2].min() / 0.75,
        "corner": mean["corner_queued_4"][0] / mean["straight_queued_4"][0],
        "narrowest door": min(doors),
        "widest door": max(doors),
        "doors as drawn": drawn_spread(mean),
        "opening of 3 m": mean["wide_3"][0],
    }
    return {name: float(measured[name]) for name in LIMITS}


def drawn_spread(mean):
    """The greatest share by which flows of doors of one width differ from their middle."""
    flows = {}
    for name, values in mean.items():
        if name.startswith("geometry_"):
            flows.setdefault(name.split("_")[1], []).append(values[0])
    return max((max(of_width) - min(of_width)) / (max(of_width) + min(of_width)) for of_width in flows.values())


def measured_with(folder, constants, seeds):
    return {**recorded_errors(folder, constants, seeds), **limited_values(constants, seeds)}


def tolerance(name):
    """That of a recorded quantity."""
    if name.startswith("bi_"):
        return 0.2
    return 0.25 if re.match(r"\d{3}_.* speed", name) else 0.1


def error(name, value):
    """The error of a measured value in units of its tolerance; 0 where a limit is kept."""
    if name not in LIMITS:
        return value / tolerance(name)
    sense, limit, width = LIMITS[name]
    return max(0.0, value - limit if sense == "at most" else limit - value) / width


def is_kept(values):
    """Whether a draw belongs to the posterior."""
    allowed = {0.1: 0.15, 0.2: 0.40, 0.25: 0.35}
    recorded = {name: abs(math.expm1(value)) for name, value in values.items() if name not in LIMITS}
    if any(value > allowed[tolerance(name)] for name, value in recorded.items()):
        return False
    plain = [value for name, value in recorded.items() if tolerance(name) == 0.1]
    return sum(plain) / len(plain) <= 0.08 and all(error(name, values[name]) <= 6 for name in values if name in LIMITS)


def read_json(file):
    with open(file, encoding="utf-8") as stream:
        return json.load(stream)


def read_draws(file):
    if not os.path.exists(file):
        return []
    with open(file, encoding="utf-8") as stream:
        return [json.loads(line) for line in stream]


class Space:
    """Constants as vectors: each -1 to 1 within the spread around the start."""

    def __init__(self, start):
        self.start = start

    def constants(self, x):
        moved = {name: value * (1 + SPREAD * at) for (name, value), at in zip(self.start.items(), x)}
        return {name: min(1.0, value) if name in SHARES else value for name, value in moved.items()}

    def vector(self, constants):
        return [(constants[name] / value - 1) / SPREAD for name, value in self.start.items()]


class Surrogate:
    """A linear model of all quantities, with the standard deviations of what it leaves."""

    def __init__(self, space, draws):
        self.names = list(draws[0]["values"])
        x = numpy.array([space.vector(draw["constants"]) for draw in draws])
        y = numpy.array([[draw["values"][name] for name in self.names] for draw in draws])
        rows = numpy.hstack([numpy.ones((len(x), 1)), x])
        ridge = 0.02 * len(x) * numpy.eye(rows.shape[1])
        ridge[0, 0] = 0
        self.slopes = numpy.linalg.solve(rows.T @ rows + ridge, rows.T @ y)
        self.scatter = (y - rows @ self.slopes).std(axis=0)

    def values(self, x, noise=None):
        y = self.slopes[0] + numpy.asarray(x) @ self.slopes[1:]
        return dict(zip(self.names, y if noise is None else y + noise * self.scatter))

    def best(self, size, used):
        """The x with the least sum of squared errors of the used quantities; a little is added for x itself."""

        def errors(x):
            values = self.values(x)
            return [max(-12, min(12, error(name, values[name]))) for name in used] + list(0.3 * x)

        return least_squares(errors, numpy.zeros(size), bounds=(-1, 1)).x

    def proposals(self, middle, half_width, used, random):
        """Vectors in a box, cut off at -1 and 1, with which draws would be kept by the used quantities."""
        low, high = numpy.maximum(middle - half_width, -1), numpy.minimum(middle + half_width, 1)
        while True:
            x = random.uniform(low, high)
            values = self.values(x, random.standard_normal(len(self.names)))
            if is_kept({name: values[name] for name in used}):
                yield x


def draw(folder, start, file, count=100):
    space = Space(read_json(start))
    for number in range(len(read_draws(file)), int(count)):
        x = numpy.random.default_rng([1, number]).uniform(-1, 1, len(space.start))
        constants = space.constants(x)
        with open(file, "a", encoding="utf-8") as stream:
            stream.write(json.dumps({"constants": constants, "values": measured_with(folder, constants, 1)}) + "\n")
        print(f"{number + 1} of {count}", flush=True)


def fit(start, file, result):
    space = Space(read_json(start))
    surrogate = Surrogate(space, read_draws(file))
    x = surrogate.best(len(space.start), surrogate.names)
    with open(result, "w", encoding="utf-8") as stream:
        json.dump({name: float(f"{value:.4g}") for name, value in space.constants(x).items()}, stream, indent=1)
    print_values(surrogate.values(x))


def posterior(folder, start, file, result, table, count=30):
    space = Space(read_json(start))
    surrogate = Surrogate(space, read_draws(file))
    middle = numpy.array(space.vector(read_json(result)))
    proposals = surrogate.proposals(middle, 0.1 / SPREAD, surrogate.names, numpy.random.default_rng(2))
    kept, tried = [], 0
    while len(kept) < int(count):
        constants = space.constants(next(proposals))
        tried += 1
        if is_kept(recorded_errors(folder, constants, 1)) and is_kept(measured_with(folder, constants, 1)):
            kept.append([f"{constants[name]:.4g}" for name in space.start])
            with open(table, "w", encoding="utf-8") as stream:
                stream.write("\n".join(",".join(row) for row in [list(space.start), *kept]) + "\n")
        print(f"{len(kept)} of {tried} kept", flush=True)


def used_without(names, experiment):
    hermes = experiment.startswith("uo-")
    return [name for name in names if name.split()[0] != experiment and not (hermes and name.startswith("uo-diagram"))]


def left_out(folder, start, file, table, seeds=10):
    space = Space(read_json(start))
    size = len(space.start)
    surrogate = Surrogate(space, read_draws(file))
    inside = recorded_errors(folder, space.constants(surrogate.best(size, surrogate.names)), seeds)
    experiments = dict.fromkeys(name.split()[0] for name in surrogate.names if name not in LIMITS)
    lines = [
        "| experiment | quantity | in the fit | left out | 20 draws without it | covered |",
        "|---|---|---|---|---|---|",
    ]
    for experiment in experiments:
        used = used_without(surrogate.names, experiment)
        outside = recorded_errors(folder, space.constants(surrogate.best(size, used)), seeds, experiment)
        proposals = surrogate.proposals(numpy.zeros(size), 1, used, numpy.random.default_rng(3))
        drawn = [recorded_errors(folder, space.constants(next(proposals)), 1, experiment) for _ in range(20)]
        for name, value in outside.items():
            percents = sorted(100 * math.expm1(one[name]) for one in drawn)
            lines.append(
                f"| {experiment} | {name.split(' ', 1)[1]} | {100 * math.expm1(inside[name]):+.0f} % | {100 * math.expm1(value):+.0f} % "
                f"| {percents[0]:+.0f} to {percents[-1]:+.0f} % | {'yes' if percents[0] <= 0 <= percents[-1] else 'no'} |"
            )
        print("\n".join(lines[-len(outside) :]), flush=True)
        with open(table, "w", encoding="utf-8") as stream:
            stream.write("\n".join(lines) + "\n")


def print_values(values):
    for name, value in values.items():
        shown = f"{value:8.3f}  " if name in LIMITS else f"{100 * math.expm1(value):+6.0f} % "
        print(f"{name:34} {shown} {'*' if abs(error(name, value)) > 1.5 else ''}")
    cost = sum(min(abs(error(name, value)), 12) ** 2 for name, value in values.items())
    print(f"cost {cost:.1f}, kept: {is_kept(values)}")


def show(folder, start, *words, seeds=3):
    constants = read_json(start)
    for word in words:
        name, value = word.split("=")
        constants[name] = float(value)
    print_values(measured_with(folder, constants, seeds))


COMMANDS = {"draw": draw, "fit": fit, "posterior": posterior, "left_out": left_out, "show": show}

if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in COMMANDS:
        sys.exit(__doc__)
    options = dict(word.split("=", 1) for word in sys.argv[2:] if re.match(r"(count|seeds)=", word))
    COMMANDS[sys.argv[1]](*[word for word in sys.argv[2:] if not re.match(r"(count|seeds)=", word)], **options)
