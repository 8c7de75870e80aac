#!/usr/bin/env python3
"""Writes the figures of docs/guidance.md, and docs/guidance_baselines.svg.

usage: scripts/studies/guidance_page.py FOLDER    FOLDER: that of scripts/studies/guidance_studies.py, all studies done
"""
import json
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from doc_blocks import replace_passage  # noqa: E402

PAGE = ROOT / "docs/guidance.md"
FIGURE = ROOT / "docs/guidance_baselines.svg"
CASES = (1, 2, 3, 4)
POLICIES = {
    "none": "no drone",
    "zigzag": "zigzag, 1",
    "balance_1": "balance, 1",
    "balance_3": "balance, 3",
    "balance_5": "balance, 5",
    "signage_3": "signage, 3",
}
# Study, beginning of its cases' ids, what the page calls it.
OTHER_STUDIES = [
    ("unseen", "paper_", "other seeds, the paper's cases"),
    ("unseen", "ours_", "other seeds, with navigation"),
    ("three", "paper_", "led at 1.6 m/s, the paper's cases"),
    ("camera", "paper_", "the same, drones see what their cameras count"),
    ("compliance", "paper_", "the same, half of the people follow"),
    ("signage", "paper_", "signage, the paper's cases"),
    ("everyday_square", "", "shipped cases of `city_square`"),
]


class Study:
    """The rows of a study by case and policy."""

    def __init__(self, folder, name):
        summary = json.loads((folder / name / "summary.json").read_text(encoding="utf-8"))
        self.rows = {(row["case"], row["policy"]): row for row in summary["rows"]}
        self.cases = list(dict.fromkeys(row["case"] for row in summary["rows"]))
        self.policies = list(dict.fromkeys(row["policy"] for row in summary["rows"]))

    def mean(self, case, policy):
        """Mean escape time to the end of the run, with the comparison to the study's baseline."""
        return self.rows[case, policy]["restricted_means"][-1]


def difference(mean):
    """`-1.2 [-2.0, -0.4]`."""
    low, high = mean["difference_95_s"]
    return f"{mean['difference_s']:+.1f} [{low:+.1f}, {high:+.1f}]"


def baseline_table(study):
    """Drones against a siren: mean escape times of both models and all cases."""
    yield (
        "| model | case | nobody informed | 3 drones | siren | siren and 3 drones | drones against nobody informed "
        "| drones added to the siren | p (Holm) of the latter |"
    )
    yield "|" + "---|" * 9
    for model in ("orca", "ttc"):
        for case in CASES:
            plain, siren = f"{model}_ours_{case}", f"{model}_siren_ours_{case}"
            means = [study.mean(each, policy) for each in (plain, siren) for policy in ("none", "balance_3")]
            cells = [f"`{model}`" if case == 1 else "", str(case), *(f"{mean['mean_s']:.1f}" for mean in means)]
            cells += [difference(means[1]), difference(means[3]), f"{means[3]['holm_p']:.2g}"]
            yield "| " + " | ".join(cells) + " |"


def case_table(study, prefix):
    """Rows of the study of the square: times are medians, means and differences those to the end of the run."""
    yield (
        "| case | policy, drones | T50 | T75 | T90 | T95 | all out | mean escape, s | ratio | difference, s [95 %] "
        "| p (Holm) | T90/reference |"
    )
    yield "|" + "---|" * 12
    for case in CASES:
        for policy in study.policies:
            row, mean = study.rows[f"{prefix}{case}", policy], study.mean(f"{prefix}{case}", policy)
            times = [row["times"][f"t{percent}_s"] for percent in (50, 75, 90, 95)]
            cells = [str(case) if policy == "none" else "", POLICIES[policy]]
            cells += ["never" if not time or time["median"] is None else f"{time['median']:.0f}" for time in times]
            cells += [f"{row['all_out']}/{row['runs']}", f"{mean['mean_s']:.1f}"]
            if policy == "none":
                cells += ["", "", ""]
            else:
                cells += [f"{mean['ratio_to_baseline']:.2f}", difference(mean), f"{mean['holm_p']:.2g}"]
            ratio = row["t90_to_reference"]
            cells.append("" if ratio is None or math.isinf(ratio) else f"{ratio:.2f}")
            yield "| " + " | ".join(cells) + " |"


def other_table(folder):
    """Differences of the mean escape of the other studies, 12 runs each; bold where p (Holm) is below 0.05."""
    yield "| study | policy, drones | case 1 | case 2 | case 3 | case 4 |"
    yield "|" + "---|" * 6
    for name, prefix, title in OTHER_STUDIES:
        study = Study(folder, name)
        cases = [case for case in study.cases if case.startswith(prefix)]
        for policy in study.policies[1:]:
            cells = [title, POLICIES[policy]]
            for case in cases:
                mean = study.mean(case, policy)
                text = f"{mean['difference_s']:+.1f} ({mean['ratio_to_baseline']:.2f})"
                cells.append(f"**{text}**" if mean["holm_p"] < 0.05 else text)
            yield "| " + " | ".join(cells) + " |"


CURVES = [
    ("orca_ours_2", "none", "nobody informed", "#000000"),
    ("orca_ours_2", "balance_3", "3 drones", "#009E73"),
    ("orca_siren_ours_2", "none", "siren", "#0072B2"),
    ("orca_siren_ours_2", "balance_3", "siren and 3 drones", "#D55E00"),
]
END_S = 100
LEFT, RIGHT, TOP, BOTTOM = 60, 560, 20, 330  # of the axes, pixels


def mean_out(folder, case, policy):
    """Mean number of people who are out at each second, over the runs."""
    runs = [
        json.loads(file.read_text(encoding="utf-8"))["outcome"]["escapes"]
        for file in (folder / "runs" / case / policy).iterdir()
    ]
    return [sum(time <= second for run in runs for time in run["escape_s"]) / len(runs) for second in range(END_S + 1)]


def draw(folder):
    """Escape curves of CURVES as SVG."""
    curves = [mean_out(folder, case, policy) for case, policy, _, _ in CURVES]
    most = 20 * math.ceil(max(map(max, curves)) / 20)

    def x(second):
        return LEFT + (RIGHT - LEFT) * second / END_S

    def y(count):
        return BOTTOM - (BOTTOM - TOP) * count / most

    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 380" font-family="sans-serif" font-size="12">',
        '<rect width="720" height="380" fill="white"/>',
    ]
    for count in range(0, most + 1, 20):
        parts.append(
            f'<line x1="{LEFT}" x2="{RIGHT}" y1="{y(count):.1f}" y2="{y(count):.1f}" stroke="#ddd"/>'
            f'<text x="{LEFT - 6}" y="{y(count) + 4:.1f}" text-anchor="end">{count}</text>'
        )
    for second in range(0, END_S + 1, 20):
        parts.append(f'<text x="{x(second):.1f}" y="{BOTTOM + 18}" text-anchor="middle">{second}</text>')
    parts.append(
        f'<text x="{x(END_S / 2):.1f}" y="{BOTTOM + 38}" text-anchor="middle">time since the alarm, s</text>'
        f'<text transform="translate(18 {y(most / 2):.1f}) rotate(-90)" text-anchor="middle">people out</text>'
    )
    for row, (curve, (_, _, title, color)) in enumerate(zip(curves, CURVES)):
        points = " ".join(f"{x(second):.1f},{y(count):.1f}" for second, count in enumerate(curve))
        parts.append(
            f'<polyline fill="none" stroke="{color}" stroke-width="2" points="{points}"/>'
            f'<line x1="{RIGHT + 10}" x2="{RIGHT + 30}" y1="{40 + 20 * row}" y2="{40 + 20 * row}" stroke="{color}" '
            f'stroke-width="2"/><text x="{RIGHT + 36}" y="{44 + 20 * row}">{title}</text>'
        )
    return "\n".join(parts) + "\n</svg>\n"


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    square = Study(folder, "square")
    page = PAGE.read_text(encoding="utf-8")
    page = replace_passage(page, "drones against a siren", baseline_table(Study(folder, "baselines")))
    page = replace_passage(page, "the paper's cases", case_table(square, "paper_"))
    page = replace_passage(page, "cases with navigation", case_table(square, "ours_"))
    page = replace_passage(page, "other studies", other_table(folder))
    PAGE.write_text(page, encoding="utf-8")
    FIGURE.write_text(draw(folder / "baselines"), encoding="utf-8")


if __name__ == "__main__":
    main()
