"""Damages to a dataset, one at a time, each with the manifest's sizes and hashes put right: what `throng validate`
should find without the manifest. See docs/formats.md, and test_validate_damages.py, which runs them.

usage: python3 tests/cli/damages THRONG DATASET [NAME...]    prints a table; DATASET has all annotations and at least two
runs, two cameras and five frames; damages of formats/ need `mot`, `yolo-detect`, `kitti`, `voc` and `table` there.

A module has those that a line makes in its table DAMAGES, and marks functions for the others (dataset.py)."""
import importlib
import inspect

MODULES = """motion trajectories images poses shapes identities cameras lenses pixels fields exits exports difficulty counts
heads runs hazards vehicles""".split()


def damages_of(module):
    """Damages of a module by their names, whose words blanks separate."""
    loaded = importlib.import_module(f"damages.{module}")
    content, text = vars(loaded), inspect.getsource(loaded)
    for name, value in content.items():
        own = inspect.isfunction(value) and value.__module__ == loaded.__name__
        if own and not hasattr(value, "is_damage") and len(text.split(name)) == 2:
            raise AssertionError(f"damages/{module}.py: nothing uses {name}; a damage is marked or in DAMAGES")
    marked = {name.replace("_", " "): value for name, value in content.items() if getattr(value, "is_damage", False)}
    return marked | content.get("DAMAGES", {})


#: Damages that need a dataset with cars, or one in which a disaster has begun.
OF_VEHICLES = set(damages_of("vehicles"))
OF_HAZARDS = set(damages_of("hazards"))
#: Of what is said twice of a whole run.
OF_RUNS = set(damages_of("runs"))
KINDS = {name: function for module in MODULES for name, function in damages_of(module).items()}
