"""Reads MCAP recordings by @mcap/core and @foxglove/rosmsg2-serialization of npm (tests/cli/read_mcap.mjs)."""
import json
import pathlib
import subprocess
import types

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read_recording(path):
    """The first line of tests/cli/read_mcap.mjs, and the messages by topic, as objects, in the order of time."""
    command = ["node", ROOT / "tests/cli/read_mcap.mjs", ROOT / "build/web/node_modules", path]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    first, *lines = done.stdout.splitlines()
    topics = {}
    for line in lines:
        message = json.loads(line, object_hook=lambda fields: types.SimpleNamespace(**fields))
        topics.setdefault(message.topic, []).append(message)
    return json.loads(first), topics


def matrix_of(transform):
    """The 4 x 4 matrix of a geometry_msgs/Transform, from the child's frame to the parent's."""
    q, shift = transform.rotation, transform.translation
    w, x, y, z = q.w, q.x, q.y, q.z
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), shift.x],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), shift.y],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), shift.z],
        [0, 0, 0, 1],
    ]
    return numpy.array(rows)
