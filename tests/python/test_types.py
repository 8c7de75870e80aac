"""Generated types against the files that they are made from, read here by other code."""
import dataclasses
import json
import re
import subprocess
import sys
import typing
import unittest

import common
import numpy as np
from throng import api_types, client, job

SCHEMA = json.loads((common.ROOT / "spec/job/job.schema.json").read_text())
DOCUMENT = json.loads(subprocess.check_output([common.THRONG, "schema", "openapi"]))


class Generated(unittest.TestCase):
    def test_files_are_up_to_date(self):
        result = subprocess.run(
            [sys.executable, common.ROOT / "python/generate_types.py", common.THRONG, "--check"],
            capture_output=True,
            text=True,
        )
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_every_field_of_the_schema_has_one_of_its_name(self):
        def compare(schema, kind, where):
            fields = {f.name: f for f in dataclasses.fields(kind)}
            self.assertEqual(set(fields), set(schema["properties"]), where)
            required = {name for name, f in fields.items() if f.default is dataclasses.MISSING}
            self.assertEqual(required, set(schema.get("required", [])), where)
            hints = typing.get_type_hints(kind)
            for name, field in schema["properties"].items():
                kinds = field.get("type")
                is_list = kinds == "array" or (isinstance(kinds, list) and "array" in kinds)
                inner = field.get("items", field) if is_list else field
                parts = [p for p in _leaves(hints[name]) if isinstance(p, type) and dataclasses.is_dataclass(p)]
                if inner.get("properties"):
                    self.assertEqual(len(parts), 1, f"{where}/{name}")
                    compare(inner, parts[0], f"{where}/{name}")
                else:
                    self.assertEqual(parts, [], f"{where}/{name}")
                if "enum" in inner:
                    self.assertEqual(
                        [p for p in _leaves(hints[name]) if isinstance(p, str)], inner["enum"], f"{where}/{name}"
                    )

        compare(SCHEMA, job.Job, "")

    def test_every_answer_has_its_keys(self):
        for name, schema in DOCUMENT["components"]["schemas"].items():
            if "properties" not in schema:
                continue
            kind = getattr(api_types, name)
            self.assertEqual(
                set(kind.__annotations__), set(schema["properties"]) | set(schema.get("required", [])), name
            )
            optional = {
                key for key, hint in kind.__annotations__.items() if "NotRequired[" in str(hint.__forward_arg__)
            }
            self.assertEqual(optional, set(schema["properties"]) - set(schema.get("required", [])), name)

    def test_the_client_has_every_operation(self):
        """Paths in its source, {x} for whatever is put in."""
        files = ("client.py", "_catalog_client.py", "_events.py", "_live.py")
        source = "".join((common.ROOT / "python/throng" / name).read_text() for name in files)
        paths = {
            re.sub(r"\{[^{}]*(\([^()]*\))?[^{}]*\}", "{}", text)
            for text in re.findall(r'f?"(/[a-zA-Z0-9/{}_.()\[\]]*)', source)
        }
        for method, path in api_types.OPERATIONS:
            plain = re.sub(r"\{[^}]*\}", "{}", path)
            self.assertTrue({plain, plain + "{}"} & paths, f"{method} {path}")
        self.assertEqual(
            {(m.upper(), p) for p, methods in DOCUMENT["paths"].items() for m in methods}, set(api_types.OPERATIONS)
        )

    def test_jobs_become_json(self):
        made = job.Job(
            "city_square/everyday",
            seed=3,
            drones=[
                job.Drone(
                    "d1",
                    start=np.array([1.0, 2, 30]),
                    camera=job.Camera(pitch_deg=job.uniform(-80, -35), sensor=job.Sensor(iso=job.choice(100, 400))),
                )
            ],
            randomize={"crowd.agents": job.normal(80, 10)},
            capture=job.Capture(rate_hz=np.float64(2)),
        )
        self.assertEqual(
            client.plain(made),
            {
                "scenario": "city_square/everyday",
                "seed": 3,
                "capture": {"rate_hz": 2.0},
                "drones": [
                    {
                        "id": "d1",
                        "start": [1.0, 2.0, 30.0],
                        "camera": {"pitch_deg": {"uniform": [-80, -35]}, "sensor": {"iso": {"choice": [100, 400]}}},
                    }
                ],
                "randomize": {"crowd.agents": {"normal": [80, 10]}},
            },
        )
        with self.assertRaises(TypeError):
            job.Job("a", sed=3)


def _leaves(hint):
    arguments = typing.get_args(hint)
    return [leaf for a in arguments for leaf in _leaves(a)] if arguments else [hint]


if __name__ == "__main__":
    common.main()
