#!/usr/bin/python3
"""The figures of docs/training.md: estimates of the presets, and scores of detectors and counters.

usage: scripts/studies/training_figures.py [--presets]    THRONG, or build/release/cli/throng; --presets: only the estimates

Makes the datasets of the page's commands, trains and scores with one thread and seed 1, and writes the numbers into the
page's tables, at the scenarios that comments mark. Ten minutes on two cores. Needs torch.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from doc_blocks import replace_passage  # noqa: E402

PAGE = ROOT / "docs/training.md"
THRONG = os.environ.get("THRONG", str(ROOT / "build/release/cli/throng"))
PRESETS = ("detection", "counting", "tracking", "segmentation", "keypoints", "evacuation_video")
FEW = 16  # images of the smaller training


def run(*command, cwd=ROOT):
    done = subprocess.run([str(word) for word in command], capture_output=True, encoding="utf-8", cwd=cwd)
    if done.returncode:
        raise SystemExit(f"{command}: {done.stderr}")
    return done.stdout


def write_presets():
    """The estimate of each preset, in its row's last cell, on two cores whatever this machine has."""
    text = PAGE.read_text(encoding="utf-8")
    for preset in PRESETS:
        answer = json.loads(run(THRONG, "check", "--json", f"scenarios/presets/{preset}.job.json"))
        minutes = max(1, round(answer["estimate"]["cpu_s"] / 2 / 60))
        text, count = re.subn(rf"(\| `{preset}` \|.*\| )[^|]+( \|\n)", rf"\g<1>{minutes} min\g<2>", text)
        assert count == 1, preset
    PAGE.write_text(text, encoding="utf-8")


def make_dataset(scenario, folder):
    demo = ROOT / f"scenarios/{scenario}/demo.job.json"
    job = folder / f"{scenario}.job.json"
    job.write_text(run("jq", "-f", "examples/training_set.jq", demo), encoding="utf-8")
    run(THRONG, "run", job, "-o", folder / scenario)
    return folder / scenario / "dataset"


def train(kind, dataset, folder, *more):
    model = folder / f"{kind}.pt"
    options = ["--steps", 200, "--tile", 128, "--threads", 1, "--device", "cpu", *more]
    said = run("/usr/bin/python3", f"examples/train_{kind}.py", dataset, "-o", model, *options)
    return model, float(re.search(r"trained in (\d+) s of CPU", said)[1])


def score(model, dataset, split):
    options = ["--split", split, "--threads", 1, "--device", "cpu"]
    return json.loads(run("/usr/bin/python3", "examples/evaluate.py", model, dataset, *options))


def format_ap(scores):
    return f"{scores['ap50']:.3f}, {scores['ap']:.3f}"


def format_errors(scores):
    return f"{scores['mae']:.1f}, {scores['rmse']:.1f}"


def write_scores(folder):
    seen, unseen = make_dataset("bridge", folder), make_dataset("campus", folder)
    images = len(json.loads((seen / "annotations/instances.json").read_text(encoding="utf-8"))["images"])
    held_out = images // 6
    both = lambda model: (score(model, seen, "val"), score(model, unseen, "all"))  # noqa: E731
    detectors, counters, seconds = [], [], []
    for name, more in (
        ("untrained (`--steps 0`)", ["--steps", 0]),
        (f"{FEW} images (`--images {FEW}`)", ["--images", FEW]),
        (f"{images - held_out} images", []),
    ):
        model, cpu_s = train("detector", seen, folder, *more)
        scores = both(model)
        detectors.append(f"| {name} | {format_ap(scores[0])} | {format_ap(scores[1])} |")
        if more[:1] == ["--steps"]:
            continue
        model, counter_s = train("counter", seen, folder, *more)
        counted = both(model)
        means = [format_errors(one["always_the_mean"]) for one in counted]
        name = name.split(" (")[0]
        counters.append(
            f"| {name} | {format_errors(counted[0])} | {format_errors(counted[1])} | {means[0]} | {means[1]} |"
        )
        seconds += [cpu_s, counter_s]
    facts = (
        f"The held-out run of `bridge` has {scores[0]['images']} images with {scores[0]['people']} people to be "
        f"detected; `campus` {scores[1]['images']} with {scores[1]['people']}. 200 steps took "
        f"{min(seconds):.0f} to {max(seconds):.0f} s of CPU time."
    )
    head = ["| detector | AP50, AP: held-out run | AP50, AP: unseen scenario |", "|---|---|---|"]
    counter_head = [
        "| counter | MAE, RMSE: held-out run | MAE, RMSE: unseen scenario | the mean of the images trained on: held-out run"
        " | unseen scenario |",
        "|---|---|---|---|---|",
    ]
    text = replace_passage(PAGE.read_text(encoding="utf-8"), "facts", [facts])
    text = replace_passage(text, "detectors", [*head, *detectors])
    PAGE.write_text(replace_passage(text, "counters", [*counter_head, *counters]), encoding="utf-8")


def main():
    write_presets()
    if "--presets" in sys.argv[1:]:
        return
    with tempfile.TemporaryDirectory() as folder:
        write_scores(pathlib.Path(folder))


main()
