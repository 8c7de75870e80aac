#!/usr/bin/env python3
"""Writes the figures of docs/evacuation.md: it runs the page's own files and commands, and those of a second model.

usage: scripts/studies/evacuation_figures.py

THRONG names another program than build/release/cli/throng. The images beside the page need Chromium (Debian: chromium).
Eleven seconds on two idle cores; times are those of this machine, so that nothing else should run.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from doc_blocks import read_blocks, replace_passage, save_files  # noqa: E402

PAGE = ROOT / "docs/evacuation.md"
THRONG = pathlib.Path(os.environ.get("THRONG", ROOT / "build/release/cli/throng")).resolve()
OTHER_MODEL = "weidmann"


def run_page(folder):
    """Saves the page's files and runs its commands in the folder; CPU and elapsed seconds of each line of them."""
    environment = {**os.environ, "PATH": f"{THRONG.parent}:{os.environ['PATH']}", "THRONG_SCENARIOS": str(folder)}
    spent = {}
    for before, language, block in read_blocks(PAGE.read_text(encoding="utf-8")):
        save_files(folder, before, block)
        for line in block.splitlines() if language == "sh" else []:
            used, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
            subprocess.run(["bash", "-c", line], cwd=folder, env=environment, check=True, stderr=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            cpu_s = after.ru_utime + after.ru_stime - used.ru_utime - used.ru_stime
            spent[line] = (cpu_s, time.monotonic() - start)
    return spent


def run_other_model(folder):
    """The page's comparison of designs with another pedestrian model, as its summary."""
    study = json.loads((folder / "doors.json").read_text(encoding="utf-8"))
    for case in study["cases"]:
        case["crowd"] = {"model": OTHER_MODEL}
    (folder / "other.json").write_text(json.dumps(study), encoding="utf-8")
    environment = {**os.environ, "THRONG_SCENARIOS": str(folder)}
    command = [THRONG, "study", "other.json", "-o", "other"]
    subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True)
    return json.loads((folder / "other/summary.json").read_text(encoding="utf-8"))


def format_interval(mean, interval, sign=""):
    """`12.3 s [11.0, ?]`: an end that the runs do not tell is a question mark."""
    low, high = ("?" if end is None else f"{end:{sign}.1f}" for end in interval)
    return f"{mean:{sign}.1f} s [{low}, {high}]"


def time_cells(summary, percent):
    """Both designs' mean time until this share of the people is out, and the difference."""
    times = [row["times"][f"t{percent}_s"] for row in summary["rows"]]
    change = next(row for row in summary["case_differences"] if row["percent"] == percent)
    cells = [format_interval(each["mean_s"], each["mean_95_s"]) for each in times]
    return [*cells, format_interval(change["difference_s"], change["difference_95_s"], "+")]


def write_page(folder, spent, summary, other):
    """Puts the figures between the page's comments."""
    cpu_s = {line.split()[1]: seconds[0] for line, seconds in spent.items() if line.startswith("throng ")}
    study_s = next(seconds for line, seconds in spent.items() if line.startswith("throng study doors.json"))
    times = json.loads((folder / "figures.json").read_text(encoding="utf-8"))["escape_time_percentiles"]
    page = PAGE.read_text(encoding="utf-8")
    run = (
        f"This run has T50 {times['t50_s']:.1f} s, T90 {times['t90_s']:.1f} s and T95 {times['t95_s']:.1f} s, all from the "
        f"alarm on. The simulation takes {cpu_s['simulate']:.1f} s of CPU time, metrics {cpu_s['metrics']:.1f} s and the "
        f"report {cpu_s['report']:.1f} s."
    )
    table = ["| | door of 1.2 m | door of 2.0 m | difference |", "|---|---|---|---|"]
    for percent in (50, 90, 95):
        table.append(f"| T{percent} | " + " | ".join(time_cells(summary, percent)) + " |")
    times95 = [row["times"]["t95_s"] for row in summary["rows"]]
    longest = [format_interval(each["p95_s"], each["p95_95_s"]) for each in times95]
    table.append("| 95th percentile of T95 | " + " | ".join(longest) + " | |")
    duration = f"{study_s[1]:.0f} s on two idle cores (80 runs: {study_s[0]:.0f} s of CPU time). `summary.md` has:"
    needed = [f"{each['runs_for_5_percent']:.0f}" for each in times95]
    cells = time_cells(other, 95)
    model = (
        f'With another pedestrian model (`"crowd": {{"model": "{OTHER_MODEL}"}}` in both cases) the same 40 runs give T95 '
        f"{cells[0]} and {cells[1]},\na difference of {cells[2]} instead of {time_cells(summary, 95)[2]}."
    )
    page = replace_passage(page, "run", [run])
    page = replace_passage(page, "designs", [duration, "", *table])
    page = replace_passage(
        page, "runs", [f"Here they are {needed[0]} for the door of 1.2 m and {needed[1]} for that of 2.0 m."]
    )
    PAGE.write_text(replace_passage(page, "model", [model]), encoding="utf-8")


def draw(folder, report, image, size, figure=None):
    """An image of the report's top, or of one of its figures by number."""
    html = report.read_text(encoding="utf-8")
    if figure is not None:
        html = html.replace('http-equiv="Content-Security-Policy"', 'name="removed"')  # it refuses scripts
        html += f"""<script>setTimeout(() => {{
          document.body.replaceChildren(document.querySelectorAll("figure")[{figure}]);
        }}, 3000);</script>"""
    page = folder / "drawn.html"
    page.write_text(html, encoding="utf-8")
    command = ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]
    command += [f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=10000", "--hide-scrollbars"]
    command += [f"--window-size={size[0]},{size[1]}", f"--screenshot={image}", f"file://{page}"]
    subprocess.run(command, check=True, capture_output=True)


def main():
    if len(sys.argv) > 1:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        spent = run_page(folder)
        summary = json.loads((folder / "doors/summary.json").read_text(encoding="utf-8"))
        write_page(folder, spent, summary, run_other_model(folder))
        (PAGE.parent / "evacuation_plan.png").write_bytes((folder / "office.png").read_bytes())
        draw(folder, folder / "report.html", PAGE.parent / "evacuation_report.png", (905, 900))
        draw(folder, folder / "doors/report.html", PAGE.parent / "evacuation_convergence.png", (980, 400), figure=3)


if __name__ == "__main__":
    main()
