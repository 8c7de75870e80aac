#!/usr/bin/python3
"""Writes throng/job.py from spec/job/job.schema.json and throng/api_types.py from `throng schema openapi`.

usage: python/generate_types.py THRONG [--check]    --check writes nothing and exits with 1 if a file is not up to date
"""
from __future__ import annotations

import json
import keyword
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
WIDTH = 120
PLAIN = {"string": "str", "integer": "int", "number": "float", "boolean": "bool", "null": "None"}


def camel(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in name.replace("-", "_").split("_"))


def docstring(text: str, indent: str) -> list[str]:
    text = " ".join(text.split()).replace("\\", "\\\\").replace('"""', "'''")
    if text.endswith('"'):
        text += " "
    lines = textwrap.wrap(text, WIDTH - len(indent) - 6, break_long_words=False, break_on_hyphens=False) or [""]
    return [
        f'{indent}{chr(34) * 3 if i == 0 else ""}{line}{chr(34) * 3 if i == len(lines) - 1 else ""}'
        for i, line in enumerate(lines)
    ]


def literal(values: list[Any]) -> str:
    return (
        "Literal[" + ", ".join(json.dumps(value) if isinstance(value, str) else repr(value) for value in values) + "]"
    )


class JobTypes:
    """Dataclasses of the job's objects: values that are None are left out of the JSON."""

    def __init__(self, schema: dict[str, Any]) -> None:
        self.classes: dict[str, list[str]] = {}
        self.make("Job", schema)

    def type_of(self, name: str, schema: dict[str, Any], parent: str) -> str:
        if "enum" in schema:
            return literal(schema["enum"])
        if name == "randomize":
            return "Mapping[str, Distribution]"
        kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        plain = [PLAIN[kind] for kind in kinds if kind not in ("object", "array")]
        if "object" in kinds and schema.get("properties"):
            plain.append(self.make(self.class_name(camel(name), parent), schema))
        elif "object" in kinds:
            plain.append("Distribution" if "x-distribution" in schema else "Mapping[str, Any]")
        if "array" in kinds:
            items = schema["items"]
            title = camel(items.get("title", name).replace(" ", "_").replace("-", "_"))
            plain.append(f"Sequence[{self.type_of(title, items, parent)}]")
        return " | ".join(plain)

    def class_name(self, name: str, parent: str) -> str:
        return name if name not in self.classes else parent + name

    def make(self, name: str, schema: dict[str, Any]) -> str:
        lines = self.classes[name] = []
        required = schema.get("required", [])
        properties = schema["properties"]
        body: list[str] = []
        for key in [*required, *(key for key in properties if key not in required)]:
            field = properties[key]
            if keyword.iskeyword(key):
                raise ValueError(f"{key} is a keyword of Python")
            if len(body) and key not in required and "    _: KW_ONLY" not in body:
                body.append("    _: KW_ONLY")
            elif not body and key not in required:
                body.append("    _: KW_ONLY")
            kind = self.type_of(key, field, name)
            unit = f" Unit: {field['unit']}." if "unit" in field else ""
            default = f" Default: {json.dumps(field['default'])}." if field.get("default") not in (None, {}, []) else ""
            # A class may have a field that is called like its type, such as Camera.distortion.
            body.append(f"    {key}: {kind}" + ("" if key in required else " | None = None"))
            body += docstring(field.get("description", "") + unit + default, "    ")
        lines += ["@dataclass", f"class {name}(Part):", *docstring(schema.get("description", name), "    "), "", *body]
        return name

    def text(self) -> str:
        head = '''"""The parts of a job as dataclasses: a typed way to write docs/job.md's JSON.

Made by python/generate_types.py from spec/job/job.schema.json; do not edit. Values that are None are left out and
have the default of the schema. The service and the program check values; types are for editors and mypy.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal, Mapping, Sequence

from ._job_base import Distribution, Part, choice, log_uniform, normal, uniform

'''
        names = sorted(["Distribution", "choice", "log_uniform", "normal", "uniform", *self.classes])
        exported = textwrap.fill(
            ", ".join(json.dumps(name) for name in names), WIDTH, initial_indent="    ", subsequent_indent="    "
        )
        bodies = ["\n".join(lines) for lines in reversed(list(self.classes.values()))]
        return head + f"__all__ = [\n{exported},\n]\n\n\n" + "\n\n\n".join(bodies) + "\n"


class ApiTypes:
    """TypedDicts of the answers."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.document = document
        self.bodies: dict[str, str] = {}
        for name, schema in document["components"]["schemas"].items():
            if "properties" in schema or "required" in schema:
                self.make(name, schema)
            else:
                self.bodies[name] = f"{name} = Any\n"

    def type_of(self, name: str, schema: dict[str, Any]) -> str:
        if "$ref" in schema:
            return str(schema["$ref"]).rsplit("/", 1)[-1]
        if "enum" in schema:
            return literal(schema["enum"])
        if "const" in schema:
            return literal([schema["const"]])
        if "oneOf" in schema:
            return " | ".join(dict.fromkeys(self.type_of(name, part) for part in reversed(schema["oneOf"])))
        kinds = schema.get("type", "any")
        if isinstance(kinds, list):
            return " | ".join(PLAIN[kind] for kind in kinds)
        if kinds == "array":
            item = (
                self.type_of(name[:-1] if name.endswith("s") else name + "Item", schema["items"])
                if "items" in schema
                else "Any"
            )
            return f"list[{item}]"
        if kinds == "object":
            if "properties" in schema or ("required" in schema and "additionalProperties" not in schema):
                return self.make(name, schema)
            values = schema.get("additionalProperties")
            return f"dict[str, {self.type_of(name, values) if isinstance(values, dict) else 'Any'}]"
        return PLAIN.get(kinds, "Any")

    def make(self, name: str, schema: dict[str, Any]) -> str:
        required = schema.get("required", [])
        properties: dict[str, dict[str, Any]] = {key: {} for key in required}
        properties.update(schema.get("properties", {}))
        lines = [f"class {name}(TypedDict):"]
        lines += docstring(schema.get("description", f"{name} of the service."), "    ") + [""]
        for key, field in properties.items():
            kind = self.type_of(name + camel(key), field)
            lines.append(f"    {key}: {kind if key in required else f'NotRequired[{kind}]'}")
            if field.get("description"):
                lines += docstring(field["description"], "    ")
        self.bodies[name] = "\n".join(lines) + "\n"
        return name

    def text(self) -> str:
        head = '''"""Answers of the service as TypedDicts.

Made by python/generate_types.py from `throng schema openapi`; do not edit.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypedDict

'''
        operations = [
            f"    ({json.dumps(method.upper())}, {json.dumps(path)}),"
            for path, methods in self.document["paths"].items()
            for method in methods
        ]
        table = (
            "OPERATIONS = (\n" + "\n".join(operations) + '\n)\n"""Every operation of the service: method and path."""\n'
        )
        return head + "\n" + "\n\n".join(self.bodies.values()) + "\n\n" + table


def generated(throng: str) -> dict[Path, str]:
    schema = json.loads((ROOT / "spec/job/job.schema.json").read_text(encoding="utf-8"))
    document = json.loads(subprocess.check_output([throng, "schema", "openapi"]))
    package = ROOT / "python/throng"
    return {package / "job.py": JobTypes(schema).text(), package / "api_types.py": ApiTypes(document).text()}


def main() -> int:
    files = generated(sys.argv[1])
    stale = [path for path, text in files.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    if "--check" in sys.argv[1:]:
        for path in stale:
            print(f"{path.relative_to(ROOT)} is not what python/generate_types.py makes", file=sys.stderr)
        return 1 if stale else 0
    for path, text in files.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
