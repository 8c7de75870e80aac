#!/usr/bin/env python3
"""Compares predicted waits at exits with what followed: the time until as many had gone out as were in the queue.

usage: scripts/studies/predicted_waits.py EXITS.csv...    tables of `throng metrics TRACE --csv EXITS.csv` (every crowd step)

Per exit whose queue reached five: the greatest prediction with its queue and what followed, and the ratio of prediction to
what followed over all steps with at least five in the queue whose end the table shows.
"""
import csv
import sys

import numpy


def read_waits(path):
    """Per exit: queue, predicted wait and the wait that followed (NaN where the run ends before), per step."""
    exits = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            values = [float(row[name]) for name in ("time_s", "queue", "crossed_out", "predicted_wait")]
            exits.setdefault(row["exit"], []).append(values)
    for name, rows in exits.items():
        time_s, queue, out, predicted = numpy.array(rows).T
        served = numpy.searchsorted(out, out + queue, side="left")
        followed = numpy.where(served < len(out), time_s[numpy.minimum(served, len(out) - 1)] - time_s, numpy.nan)
        yield name, queue, predicted, followed


def main(*paths):
    for path in paths:
        for name, queue, predicted, followed in read_waits(path):
            long = (queue >= 5) & numpy.isfinite(followed)
            if not long.any():
                continue
            ratio = predicted[long] / numpy.maximum(followed[long], 0.5)
            most = int(predicted.argmax())
            print(
                f"{path} {name}: {predicted[most]:.1f} s for a queue of {queue[most]:.0f}, {followed[most]:.1f} s followed; "
                f"ratio {numpy.median(ratio):.2f} ({numpy.quantile(ratio, 0.1):.2f} to {numpy.quantile(ratio, 0.9):.2f}) "
                f"in {long.sum()} steps"
            )


if __name__ == "__main__":
    main(*sys.argv[1:])
