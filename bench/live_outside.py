#!/usr/bin/python3
"""Images per second of a flight without the service, while a client of Foxglove's protocol has subscribed to them.

usage: bench/live_outside.py THRONG [--seconds 30] [--people 260] [--scenario city_square/market_day] [--factor 1]

The client is tests/cli/foxglove_client.mjs, which needs build/web/node_modules of a build with tests. It subscribes to the
image, the lens, the odometry and people as boxes. `throng live` and the client share the machine.
"""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
IMAGE = "/d1/camera/image_color/compressed"
TOPICS = [IMAGE, "/d1/camera/camera_info", "/d1/odometry", "/ground_truth/boxes"]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("throng")
    options.add_argument("--seconds", type=float, default=30)
    options.add_argument("--people", type=int, default=260)
    options.add_argument("--scenario", default="city_square/market_day")
    options.add_argument("--factor", type=float, default=1)
    given = options.parse_args()
    job = {
        "scenario": given.scenario,
        "crowd": {"agents": given.people},
        "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"pitch_deg": -45}}],
    }
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "job.json"
        file.write_text(json.dumps(job), encoding="utf-8")
        command = [given.throng, "live", str(file), "--port", "0", "--factor", str(given.factor)]
        begun = time.monotonic()
        flight = subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8")
        url = re.search(r"ws://\S+", flight.stderr.readline())[0]
        client = subprocess.Popen(
            ["node", ROOT / "tests/cli/foxglove_client.mjs", ROOT / "build/web/node_modules", url],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            encoding="utf-8",
        )
        try:
            measure(client, begun, given)
        finally:
            for process in (client, flight):
                process.terminate()
                process.wait()


def measure(client, begun, given):
    first = None
    images, boxes, sizes = 0, 0, []
    for line in client.stdout:
        event = json.loads(line)
        now = time.monotonic()
        if event["event"] == "advertiseServices":
            client.stdin.write(json.dumps({"do": "subscribe", "topics": TOPICS}) + "\n")
            client.stdin.flush()
        if event["event"] != "message":
            continue
        if event["topic"] == IMAGE and first is None:
            first = now
            continue
        if first is None:
            continue
        if event["topic"] == IMAGE:
            images += 1
            sizes.append(event["message"]["data"]["bytes"])
        boxes += event["topic"] == "/ground_truth/boxes"
        if now > first + given.seconds:
            break
    seconds = now - first
    print(f"{given.people} people, {given.scenario}, factor {given.factor:g}")
    print(
        f"first image after {first - begun:.1f} s, {images / seconds:.1f} images/s of {sum(sizes) / len(sizes) / 1024:.0f} KiB, "
        f"{boxes / seconds:.1f} messages/s with all people"
    )


if __name__ == "__main__":
    main()
