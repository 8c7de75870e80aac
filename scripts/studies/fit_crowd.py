#!/usr/bin/env python3
"""Fits the constants of the pedestrian model ttc to recorded people, and draws from the posterior of the fit.

usage: scripts/studies/fit_crowd.py fit FOLDER FILE.json [minutes=N]
       scripts/studies/fit_crowd.py posterior FOLDER FILE.json crowd/models/ttc_posterior.csv [draws=N]
       scripts/studies/fit_crowd.py show FOLDER FILE.json [seeds=N] [CONSTANT=VALUE ...]

FOLDER has recordings (docs/validation.md); FILE.json has the constants: where a fit starts, and its result. Needs
build/release/scripts/studies/replay_crowd and crowd_gates.

- fit: minimizes the sum of squared errors, each in units of its tolerance, by CMA-ES (Hansen 2016, arXiv:1604.00772).
  Errors are those of recorded flows, speeds and times (ln of model / people, tolerance 0.1; 0.2 for two directions,
  whose free speeds are not known, and 0.25 for the speed before a bottleneck, whose area is 0.6 m^2), and distances from the
  limits of the suite's own tests, where no recording says anything.
- posterior: approximate Bayesian computation by rejection. Constants are drawn around the fit, uniformly within +-SPREAD of
  each, and kept if in one replay each recorded quantity is within 15 % (35 % for the speed before a bottleneck and for
  two directions), 8 % on average, and no limit is missed by more than six tolerances.
"""
import json
import math
import os
import re
import subprocess
import sys
import time

import numpy

STUDIES = os.path.join(os.path.dirname(__file__), "..", "..", "build", "release", "scripts", "studies")
SPREAD = 0.08  # half of the width of the prior of each constant, as a share of its value
GATES = (
    "square_1,room_100,fd_5,fd_2.9,fd_1.6,fd_1.1,meet_0.3,queue,two_way_0.75,"
    "corner_queued_4,straight_queued_4,door_0.8,door_1.2,door_2,geometry"
)
SKIPPED = ("time gap", "density", "band index", "flow 1", "flow 2")  # given by arrivals, or by other quantities


def run(program, *words):
    words = [os.path.join(STUDIES, program), *words]
    return subprocess.run(words, capture_output=True, encoding="utf-8", check=True).stdout.splitlines()


def as_words(constants):
    return [f"{name}={value:.5g}" for name, value in constants.items()]


def tolerance(experiment, quantity):
    if experiment.startswith("bi_"):
        return 0.2
    return 0.25 if re.match(r"\d{3}_", experiment) and quantity == "speed" else 0.1


def recorded_errors(folder, constants, seeds):
    """Errors of recorded quantities: name -> (ln of model / people, tolerance)."""
    errors = {}
    experiment = ""
    for line in run("replay_crowd", folder, "ttc", f"seeds={seeds}", *as_words(constants)):
        if not line.startswith(" "):
            experiment = line.split()[0]
            continue
        found = re.match(r"\s+(.*?)\s+([-\d.naif]+)\s+([-\d.naif]+) \+-", line)
        if not found or found[1].startswith(SKIPPED) or (experiment.startswith("bi_") and found[1] != "speed"):
            continue
        recorded, model = float(found[2]), float(found[3])
        error = math.log(max(model, 1e-3) / recorded) if math.isfinite(model) else 1.5
        errors[f"{experiment} {found[1]}"] = (max(-1.5, min(1.5, error)), tolerance(experiment, found[1]))
    return errors


def limit_errors(constants, seeds):
    """Distances from the limits of tests (docs/validation.md), with tolerances; 0: kept with a margin."""
    value = {}
    for line in run("crowd_gates", "ttc", f"seeds={seeds}", "only=" + GATES, *as_words(constants)):
        name, *runs = line.split("|")
        value[name.strip()] = numpy.array([[float(word) for word in one.split()] for one in runs])
    mean = {name: runs.mean(axis=0) for name, runs in value.items()}
    above = lambda measured, limit: max(0.0, measured - limit)
    peak = max(mean["fd_1.1"][0], mean["fd_1.6"][0])
    doors = [mean[name][0] for name in ("door_0.8", "door_1.2", "door_2")]
    return {
        "stuck in the square": (above(mean["square_1"][0], 0.02), 0.02),
        "counter-flow": (above(mean["room_100"][0], 110), 20),
        "jam in counter-flow": (mean["room_100"][1], 5),
        "flow at 5 /m2": (above(mean["fd_5"][0], 0.5), 0.1),
        "drop of the flow": (above(mean["fd_2.9"][0] / peak, 0.66), 0.03),
        "evasion": (above(2.05, mean["meet_0.3"][0]), 0.15),
        "acceleration": (min(0.5, above(mean["meet_0.3"][1], 0.95)), 0.1),
        "turns in a queue": (above(mean["queue"][0], 0.8), 0.5),
        "stuck in two ways": (above(value["two_way_0.75"][:, 2].max(), 0.02), 0.05),
        "doors as drawn": (max(0.0, drawn_spread(mean) - 0.12), 0.02),
        "two ways": (above(0.82, value["two_way_0.75"][:, :2].min() / 0.75), 0.05),
        "corner": (above(0.88, mean["corner_queued_4"][0] / mean["straight_queued_4"][0]), 0.05),
        "doors": (max(above(1.55, min(doors)), above(max(doors), 2.2)), 0.15),
    }


def drawn_spread(mean):
    """The greatest share by which flows of doors of one width differ from their middle."""
    flows = {}
    for name, values in mean.items():
        if name.startswith("geometry_"):
            flows.setdefault(name.split("_")[1], []).append(values[0])
    return max((max(of_width) - min(of_width)) / (max(of_width) + min(of_width)) for of_width in flows.values())


def errors_of(folder, constants, seeds):
    return recorded_errors(folder, constants, seeds), limit_errors(constants, seeds)


def cost(errors):
    return sum(min(abs(error) / tolerance, 12) ** 2 for part in errors for error, tolerance in part.values())


class Search:
    """CMA-ES in units of the steps; bounds are not needed, since constants are positive and steps small."""

    def __init__(self, start, step, population, random):
        self.start, self.step, self.random = start, step, random
        size = len(start)
        self.population, half = population, population // 2
        self.weights = math.log(half + 0.5) - numpy.log(numpy.arange(1, half + 1))
        self.weights /= self.weights.sum()
        effective = 1 / (self.weights**2).sum()
        self.effective = effective
        self.path_rate = (4 + effective / size) / (size + 4 + 2 * effective / size)
        self.size_rate = (effective + 2) / (size + effective + 5)
        self.rank_one = 2 / ((size + 1.3) ** 2 + effective)
        self.rank_many = min(1 - self.rank_one, 2 * (effective - 2 + 1 / effective) / ((size + 2) ** 2 + effective))
        self.damping = 1 + self.size_rate + 2 * max(0, math.sqrt((effective - 1) / (size + 1)) - 1)
        self.norm = math.sqrt(size) * (1 - 1 / (4 * size) + 1 / (21 * size**2))
        self.mean, self.sigma = numpy.zeros(size), 1.0
        self.covariance = numpy.eye(size)
        self.path, self.size_path = numpy.zeros(size), numpy.zeros(size)

    def values(self, x):
        return numpy.maximum(self.start + self.step * x, 0.01 * self.start)

    def generation(self, measure):
        """Measures a generation; returns its best values and their cost."""
        squares, axes = numpy.linalg.eigh(self.covariance)
        lengths = numpy.sqrt(numpy.maximum(squares, 1e-12))
        moves = [axes @ (lengths * self.random.standard_normal(len(self.mean))) for _ in range(self.population)]
        costs = [measure(self.values(self.mean + self.sigma * move)) for move in moves]
        order = numpy.argsort(costs)
        best = self.values(self.mean + self.sigma * moves[order[0]])
        chosen = [moves[i] for i in order[: len(self.weights)]]
        mean_move = sum(weight * move for weight, move in zip(self.weights, chosen))
        self.mean = self.mean + self.sigma * mean_move
        white = axes @ ((axes.T @ mean_move) / lengths)
        self.size_path = (1 - self.size_rate) * self.size_path + math.sqrt(
            self.size_rate * (2 - self.size_rate) * self.effective
        ) * white
        self.path = (1 - self.path_rate) * self.path + math.sqrt(
            self.path_rate * (2 - self.path_rate) * self.effective
        ) * mean_move
        many = sum(weight * numpy.outer(move, move) for weight, move in zip(self.weights, chosen))
        kept = 1 - self.rank_one - self.rank_many
        self.covariance = (
            kept * self.covariance + self.rank_one * numpy.outer(self.path, self.path) + self.rank_many * many
        )
        self.sigma *= math.exp((self.size_rate / self.damping) * (numpy.linalg.norm(self.size_path) / self.norm - 1))
        return best, costs[order[0]]


def fit(folder, file, minutes=30):
    with open(file, encoding="utf-8") as stream:
        constants = json.load(stream)
    names = list(constants)
    start = numpy.array([constants[name] for name in names])
    search = Search(start, 0.12 * start, 12, numpy.random.default_rng(1))
    best = (math.inf, constants)
    end = time.monotonic() + 60 * float(minutes)
    while time.monotonic() < end:
        values, least = search.generation(lambda x: cost(errors_of(folder, dict(zip(names, x)), 2)))
        if least < best[0]:
            best = (least, {name: float(f"{value:.4g}") for name, value in zip(names, values)})
        print(f"cost {least:.1f}, best {best[0]:.1f}, step {search.sigma:.2f}", flush=True)
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(best[1], stream, indent=1)


def fits_people(recorded):
    """Whether the errors of recorded quantities are small enough for a draw to be kept."""
    allowed = {0.1: 0.15, 0.2: 0.35, 0.25: 0.35}
    if any(abs(math.expm1(error)) > allowed[width] for error, width in recorded.values()):
        return False
    plain = [abs(math.expm1(error)) for error, width in recorded.values() if width == 0.1]
    return sum(plain) / len(plain) <= 0.08


def keeps_limits(limits):
    return all(error <= 6 * width for error, width in limits.values())


def posterior(folder, file, table, draws=100):
    with open(file, encoding="utf-8") as stream:
        center = json.load(stream)
    names = list(center)
    random = numpy.random.default_rng(2)
    kept, tried = [], 0
    while len(kept) < int(draws):
        factors = random.uniform(1 - SPREAD, 1 + SPREAD, len(names))
        constants = {name: center[name] * factor for name, factor in zip(names, factors)}
        tried += 1
        if fits_people(recorded_errors(folder, constants, 1)) and keeps_limits(limit_errors(constants, 1)):
            kept.append([f"{constants[name]:.4g}" for name in names])
            with open(table, "w", encoding="utf-8") as stream:
                stream.write("\n".join(",".join(row) for row in [names, *kept]) + "\n")
        print(f"{len(kept)} of {tried} kept", flush=True)


def show(folder, file, *words):
    with open(file, encoding="utf-8") as stream:
        constants = json.load(stream)
    seeds = 3
    for word in words:
        name, value = word.split("=")
        if name == "seeds":
            seeds = int(value)
        else:
            constants[name] = float(value)
    errors = errors_of(folder, constants, seeds)
    for name, (error, width) in errors[0].items():
        print(f"{name:34} {100 * math.expm1(error):+5.0f} % {'*' if abs(error) > 1.5 * width else ''}")
    for name, (error, width) in errors[1].items():
        print(f"{name:34} {error:.3f} {'*' if error > width else ''}")
    print(f"cost {cost(errors):.1f}, kept: {fits_people(errors[0]) and keeps_limits(errors[1])}")


if __name__ == "__main__":
    options = dict(word.split("=", 1) for word in sys.argv[4:] if "=" in word)
    if len(sys.argv) < 4 or sys.argv[1] not in ("fit", "posterior", "show"):
        sys.exit(__doc__)
    if sys.argv[1] == "fit":
        fit(sys.argv[2], sys.argv[3], **options)
    elif sys.argv[1] == "posterior":
        posterior(sys.argv[2], sys.argv[3], sys.argv[4], **options)
    else:
        show(*sys.argv[2:])
