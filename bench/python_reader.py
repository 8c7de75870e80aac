#!/usr/bin/python3
"""How many annotated frames a second throng.Dataset reads from labels, on one core.

usage: bench/python_reader.py DATASET...    folders, .tar or .zip files
"""
import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"

from throng import Dataset  # noqa: E402


def boxes(frame):
    people = frame.people
    return people.boxes, people.track_ids, people.visibility


def everything(frame):
    a = frame.people
    return (
        a.boxes,
        a.track_ids,
        a.visibility,
        a.boxes_amodal,
        a.positions,
        a.velocities,
        a.boxes_3d,
        a.heads,
        a.states,
        frame.camera,
    )


def with_keypoints(frame):
    return everything(frame), frame.people.keypoints, frame.people.keypoints_3d


def with_masks(frame):
    return boxes(frame), frame.people.masks()


def main():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    for path in sys.argv[1:]:
        started = time.perf_counter()
        dataset = Dataset(path)
        opened = time.perf_counter() - started
        people = sum(len(frame.people) for frame in dataset)
        print(
            f"{path}: {len(dataset)} frames, {people / max(1, len(dataset)):.1f} people each, opened in {opened:.2f} s"
        )
        kinds = [boxes, everything, with_masks]
        if any("keypoints" in record for frame in dataset[:5] for record in frame.people):
            kinds.append(with_keypoints)
        for kind in kinds:
            used = time.process_time()
            for frame in dataset:
                kind(frame)
            used = time.process_time() - used
            print(f"  {kind.__name__:16} {len(dataset) / used:7.0f} frames/s  {people / used:8.0f} people/s")


if __name__ == "__main__":
    main()
