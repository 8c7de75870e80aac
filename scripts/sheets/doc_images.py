#!/usr/bin/python3
"""Renders the images of docs/ again, with today's renderer. The table names the command of each image.

usage: scripts/sheets/doc_images.py [IMAGE...]    IMAGE: a path below docs/, or its beginning

Needs the targets throng, weather_sheet and scenario_sheet of the release build, Pillow and matplotlib, and
Chromium for docs/studio.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
SHEETS = ROOT / "scripts/sheets"
RELEASE = ROOT / "build/release"
THRONG = RELEASE / "cli/throng"
sys.path.insert(0, str(ROOT / "python"))


def call(*command):
    subprocess.run([str(word) for word in command], check=True, cwd=ROOT, stdout=sys.stderr)


def run_job(folder, job):
    """The dataset of a job that is rendered in a folder."""
    import throng

    file = folder / "job.json"
    file.write_text(json.dumps(job), encoding="utf-8")
    call(THRONG, "run", file, "-o", folder / "out")
    return throng.Dataset(folder / "out/dataset")


def demo_job(scenario):
    return json.loads((ROOT / f"scenarios/{scenario}/demo.job.json").read_text(encoding="utf-8"))


def labels(folder):
    run_job(folder, demo_job("city_square"))
    call("/usr/bin/python3", SHEETS / "labels_sheet.py", folder / "out/dataset", DOCS / "labels.jpg")


SEMANTIC_SCENARIOS = ("station", "market_in_park")


def semantic(folder):
    """A row for each scenario: an image of its demo and its semantic classes."""
    from PIL import Image

    width, height = 640, 360
    page = Image.new("RGB", (2 * width, height * len(SEMANTIC_SCENARIOS)))
    for row, scenario in enumerate(SEMANTIC_SCENARIOS):
        job = demo_job(scenario)
        job["drones"] = job["drones"][:1]
        job["drones"][0]["camera"] |= {"width": 2 * width, "height": 2 * height}
        job |= {"capture": {"rate_hz": 1, "from_s": 20, "to_s": 20}, "outputs": {"annotations": ["coco", "semantic"]}}
        below = folder / scenario
        below.mkdir()
        frame = run_job(below, job)[0]
        for column, pixels in enumerate((frame.image(), frame.semantic_colors())):
            method = Image.LANCZOS if column == 0 else Image.NEAREST
            page.paste(Image.fromarray(pixels).resize((width, height), method), (column * width, row * height))
    page.save(DOCS / "semantic.jpg", quality=88)


def weather(folder):
    job = {"scenario": "city_square/everyday", "capture": {"rate_hz": 1, "from_s": 0, "to_s": 30}, "drones": []}
    (folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
    call(THRONG, "simulate", folder / "job.json", "-o", folder / "run.h5")
    call(RELEASE / "scripts/sheets/weather_sheet", folder / "run.h5", DOCS / "weather.jpg")


def light(folder):
    """Renderer and path tracer side by side."""
    from PIL import Image

    call(RELEASE / "scripts/sheets/light_sheet", folder, 256)
    names = ["shopping_street_clear_1", "shopping_street_overcast_1", "shopping_street_night_1", "station_night_2"]
    pairs = [[Image.open(folder / f"{name}{kind}.png").convert("RGB") for kind in ("", ".traced")] for name in names]
    width, height = pairs[0][0].size
    page = Image.new("RGB", (4 * width, 2 * height))
    for i, pair in enumerate(pairs):
        for k, image in enumerate(pair):
            page.paste(image, ((i % 2 * 2 + k) * width, i // 2 * height))
    page.save(DOCS / "light.jpg", quality=90)


CAMERAS = (None, "dji", "gopro", "phone", "surveillance")


def cameras(folder):
    """A column for each kind of camera, the ideal one first: the whole image, and a part of it, pixel by pixel."""
    from PIL import Image

    width, height, column = 1280, 720, 400
    page = Image.new("RGB", (column * len(CAMERAS), 225 + 360))
    for i, preset in enumerate(CAMERAS):
        camera = {"width": width, "height": height, "pitch_deg": -30, **({"preset": preset} if preset else {})}
        job = {"scenario": "city_square/everyday", "seed": 4, "environment": {"time_of_day": "16:30"}}
        job["drones"] = [{"id": "view", "aim": {"height_m": 12}, "camera": camera}]
        job |= {"capture": {"rate_hz": 1, "from_s": 20, "to_s": 20}, "outputs": {"annotations": ["coco"]}}
        below = folder / str(i)
        below.mkdir()
        image = Image.fromarray(run_job(below, job)[0].image())
        page.paste(image.resize((column, 225), Image.LANCZOS), (i * column, 0))
        left, top = (width - column) // 2, height // 2
        page.paste(image.crop((left, top, left + column, top + height - top)), (i * column, 225))
    page.save(DOCS / "cameras.jpg", quality=90)


def scenarios(folder):
    """The sheet of each shipped scenario, and the table of docs/shipped_scenarios.md, which are of the same runs."""
    page = DOCS / "shipped_scenarios.md"
    table = subprocess.run(
        [SHEETS / "scenario_runs.sh", folder], check=True, capture_output=True, encoding="utf-8"
    ).stdout
    text, rows = re.subn(r"\| scenario \| variant (.*\n)(\|.*\n)+", lambda _: table, page.read_text(encoding="utf-8"))
    assert rows == 1, page
    page.write_text(text, encoding="utf-8")
    call(SHEETS / "contact_sheet.sh", folder)


def people(_):
    call(THRONG, "people", "sheet", "-o", DOCS / "people_sheet.jpg", "--count", 24, "--seed", 1, "--width", 1640)


def studio(_):
    packages = ROOT / "build/web/node_modules"
    call("node", "tests/studio/screenshots.mjs", THRONG, packages, DOCS / "studio")


RENDERED = {
    "labels.jpg": labels,
    "semantic.jpg": semantic,
    "weather.jpg": weather,
    "light.jpg": light,
    "cameras.jpg": cameras,
    "people_sheet.jpg": people,
    "scenarios/generated.jpg": lambda _: call(SHEETS / "generated_sheet.py"),
    "scenarios/": scenarios,
    "presets/": lambda _: call(SHEETS / "preset_sheets.py", THRONG),
    "studio/": studio,
}
# Figures that no renderer draws: these scripts write them with the numbers of their pages.
PLOTTED = {
    "evacuation_": "scripts/studies/evacuation_figures.py",
    "guidance_": "scripts/studies/guidance_page.py",
    "validation_": "scripts/studies/validation_page.py",
}


def maker(image):
    """The function or script that makes an image, by its path below docs/; None if nothing does."""
    makers = {**RENDERED, **PLOTTED}
    return next((makers[name] for name in makers if image.startswith(name)), None)


def main():
    for name, make in RENDERED.items():
        if sys.argv[1:] and not name.startswith(tuple(sys.argv[1:])):
            continue
        with tempfile.TemporaryDirectory() as folder:
            make(pathlib.Path(folder))
        print(f"docs/{name}")


if __name__ == "__main__":
    main()
