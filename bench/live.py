#!/usr/bin/python3
"""Images per second of a live flight, and how long a command takes until it is seen.

usage: bench/live.py THRONG [--seconds 30] [--people 260] [--record]

A service of its own on loopback. `command to image`: from a command (as a key press sends it) until a image of a time
at which it is in force has arrived whole. `until the drone turns`: until the heading has changed by half a degree.
Commands come 20 times a second meanwhile.
"""
import argparse
import math
import pathlib
import statistics
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests" / "cli")]
import throng  # noqa: E402
from service import start_service  # noqa: E402


def yaw_deg(q):
    w, x, y, z = map(float, q)
    return math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


class Pilot:
    """Sends commands 20 times a second, a new turn now and then; notes when."""

    def __init__(self, flight):
        self.flight, self.sent, self.turns, self.stopped = flight, {}, {}, False
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.rates = []

    def run(self):
        sequence, rate = 0, 0.0
        while not self.stopped:
            sequence += 1
            if sequence % 31 == 0:
                rate = 60.0 if rate <= 0 else -60.0
                self.turns[sequence] = time.monotonic()
            self.sent[sequence] = time.monotonic()
            self.flight.fly("d1", velocity_mps=[2, 0, 0], yaw_rate_deg_s=rate, sequence=sequence)
            self.rates.append(time.monotonic() - self.sent[sequence])
            time.sleep(max(0.0, 0.05 - self.rates[-1]))


def main():
    options = argparse.ArgumentParser()
    options.add_argument("throng")
    options.add_argument("--seconds", type=float, default=30)
    options.add_argument("--people", type=int, default=260)
    options.add_argument("--scenario", default="city_square/nearest_exit")
    options.add_argument("--record", action="store_true", help="record the flight, and say how large the recording is")
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        server, port = start_service(given.throng, pathlib.Path(folder) / "data")
        try:
            measure(throng.Client(f"http://127.0.0.1:{port}"), given)
        finally:
            server.terminate()
            server.wait()


def measure(client, given):
    job = {
        "scenario": given.scenario,
        "crowd": {"agents": given.people},
        "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"pitch_deg": -45}}],
    }
    begun = time.monotonic()
    flight = client.live(job, record=given.record)
    pilot = Pilot(flight)
    first = end = None
    images, steps, factors, sizes, shown, turned = 0, 0, [], [], [], []
    seen, heading, waiting = 0, None, None
    for message in flight.messages():
        now = time.monotonic()
        if isinstance(message, throng.LiveImage):
            if first is None:
                first, end = now, now + given.seconds
                pilot.thread.start()
                continue
            images += 1
            sizes.append(len(message.jpeg))
            for sequence in range(seen + 1, message.sequence + 1):
                shown.append(now - pilot.sent[sequence])
            seen = max(seen, message.sequence)
        elif isinstance(message, throng.LiveState) and first is not None:
            steps += 1
            factors.append(message.factor)
            yaw = yaw_deg(message.drones[0]["quaternion"])
            if heading is not None:
                rate = math.remainder(yaw - heading, 360)
                for sequence, when in list(pilot.turns.items()):
                    if waiting is None and sequence <= message.sequence:
                        waiting = (when, rate)
                        del pilot.turns[sequence]
                if waiting is not None and abs(rate - waiting[1]) > 0.5:
                    turned.append(now - waiting[0])
                    waiting = None
            heading = yaw
        if end is not None and now > end:
            break
    pilot.stopped = True
    pilot.thread.join()
    seconds = time.monotonic() - first
    recording = flight.stop()["recording"]
    flight.remove()
    ms = [1000 * s for s in sorted(shown)]
    print(f"{given.people} people, {given.scenario}")
    print(
        f"first image after {first - begun:.1f} s, {images / seconds:.1f} images/s of {statistics.mean(sizes) / 1024:.0f} KiB, "
        f"{steps / seconds:.1f} states/s, real-time factor {statistics.mean(factors[len(factors) // 2:]):.2f}"
    )
    print(
        f"command to image: median {statistics.median(ms):.0f} ms, 95 % {ms[int(0.95 * len(ms))]:.0f} ms ({len(ms)} commands, "
        f"POST median {1000 * statistics.median(pilot.rates):.1f} ms)"
    )
    if recording:
        minutes = recording["complete_until_s"] / 60
        print(
            f"recording: {1e-6 * recording['bytes'] / minutes:.0f} MB per simulated minute, problem {recording['problem']}"
        )
    if turned:
        print(f"until the drone turns: median {1000 * statistics.median(turned):.0f} ms ({len(turned)} turns)")


if __name__ == "__main__":
    main()
