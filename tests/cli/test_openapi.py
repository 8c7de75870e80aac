"""The description of the HTTP API against that of earlier versions: nothing that clients rely on goes or narrows.

usage: test_openapi.py THRONG            tests
       test_openapi.py THRONG --write    writes api_baseline.json, after a change that clients shall rely on
"""
import functools
import json
import pathlib
import subprocess
import sys
import unittest

BASELINE = pathlib.Path(__file__).with_name("api_baseline.json")
METHODS = ("get", "post", "patch", "delete")
# Keywords whose values bound what a client may send or gets: the direction in which they narrow.
LOWER_BOUNDS = ("minimum", "minItems", "minLength", "exclusiveMinimum")
UPPER_BOUNDS = ("maximum", "maxItems", "maxLength")


def kinds(schema):
    """The types that a schema permits; None: any."""
    if "enum" in schema or "const" in schema:
        words = schema.get("enum", [schema.get("const")])
        return {"string" if isinstance(word, str) else type(word).__name__ for word in words}
    named = schema.get("type")
    return None if named is None else {named} if isinstance(named, str) else set(named)


def flat(schema):
    """A schema without its words."""
    if isinstance(schema, list):
        return [flat(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {key: value for key, value in schema.items() if key not in ("description", "title", "pattern", "default")}
    if "oneOf" in kept:
        kept["oneOf"] = sorted(kept["oneOf"], key=json.dumps)
    if "properties" in kept:
        kept["properties"] = {name: flat(part) for name, part in kept["properties"].items()}
    return {key: value if key == "properties" else flat(value) for key, value in kept.items()}


def compact(document):
    """The parts that clients rely on: operations, their parameters, bodies and answers, and the schemas."""
    operations = {}
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            parameters = {
                f"{entry['in']} {entry['name']}": {"required": entry.get("required", False), **flat(entry["schema"])}
                for entry in operation.get("parameters", [])
            }
            body = operation.get("requestBody", {})
            answers = {
                status: {media: flat(form.get("schema", {})) for media, form in answer.get("content", {}).items()}
                for status, answer in operation["responses"].items()
            }
            operations[f"{method} {path}"] = {
                "parameters": parameters,
                "body": {media: flat(form.get("schema", {})) for media, form in body.get("content", {}).items()},
                "body_required": body.get("required", False),
                "answers": answers,
            }
    return {"operations": operations, "schemas": flat(document["components"]["schemas"])}


class Comparison:
    """Breaks of compatibility between two compact descriptions."""

    def __init__(self, before, after):
        self.breaks = []
        for name, schema in before["schemas"].items():
            self.answer(f"schema {name}", schema, after["schemas"].get(name))
        for name, operation in before["operations"].items():
            if name not in after["operations"]:
                self.breaks.append(f"{name}: is gone")
                continue
            self.operation(name, operation, after["operations"][name])

    def operation(self, name, before, after):
        for parameter, schema in before["parameters"].items():
            if parameter not in after["parameters"]:
                self.breaks.append(f"{name}: parameter {parameter} is gone")
            else:
                self.request(f"{name}: {parameter}", schema, after["parameters"][parameter])
        for parameter, schema in after["parameters"].items():
            if schema["required"] and not before["parameters"].get(parameter, {}).get("required"):
                self.breaks.append(f"{name}: parameter {parameter} is required now")
        if after["body_required"] and not before["body_required"]:
            self.breaks.append(f"{name}: a body is required now")
        for media, schema in before["body"].items():
            if media not in after["body"]:
                self.breaks.append(f"{name}: bodies of {media} are refused now")
            else:
                self.request(f"{name}: body {media}", schema, after["body"][media])
        for status, forms in before["answers"].items():
            if status not in after["answers"]:
                self.breaks.append(f"{name}: answer {status} is gone")
                continue
            for media, schema in forms.items():
                if media == "application/octet-stream" and status == "206":
                    continue  # parts have the type of the whole
                if media not in after["answers"][status]:
                    self.breaks.append(f"{name}: answer {status} has no {media} any more")
                else:
                    self.answer(f"{name}: {status}", schema, after["answers"][status][media])

    def request(self, where, before, after):
        """All that was permitted still is."""
        self.bounds(where, before, after, LOWER_BOUNDS, UPPER_BOUNDS)
        if after.get("additionalProperties") is False and before.get("additionalProperties") is not False:
            self.breaks.append(f"{where}: takes no other members any more")
        if before.get("$ref") != after.get("$ref"):
            self.breaks.append(f"{where}: was {before.get('$ref')}, is {after.get('$ref')}")
        if kinds(after) is not None and (kinds(before) is None or not kinds(before) <= kinds(after)):
            self.breaks.append(f"{where}: types {kinds(before)} are {kinds(after)} now")
        for word in set(before.get("enum", [])) - set(after.get("enum", before.get("enum", []))):
            self.breaks.append(f"{where}: {word} is refused now")
        for name in set(_required(after)) - set(_required(before)):
            self.breaks.append(f"{where}: {name} is required now")
        self.parts(where, before, after, self.request)

    def answer(self, where, before, after):
        """All that was promised still is."""
        if after is None:
            self.breaks.append(f"{where}: is gone")
            return
        self.bounds(where, after, before, LOWER_BOUNDS, UPPER_BOUNDS)
        for keyword in ("$ref", "const"):
            if before.get(keyword) != after.get(keyword):
                self.breaks.append(f"{where}: was {before.get(keyword)}, is {after.get(keyword)}")
        if kinds(before) is not None and (kinds(after) is None or not kinds(after) <= kinds(before)):
            self.breaks.append(f"{where}: types {kinds(before)} are {kinds(after)} now")
        for name in set(_required(before)) - set(_required(after)):
            self.breaks.append(f"{where}: {name} may be missing now")
        self.parts(where, before, after, self.answer)

    def parts(self, where, before, after, compare):
        for name, schema in before.get("properties", {}).items():
            if name not in after.get("properties", {}):
                self.breaks.append(f"{where}: member {name} is gone")
            else:
                compare(f"{where}/{name}", schema, after["properties"][name])
        if "items" in before:
            compare(f"{where}[]", before["items"], after.get("items", {}))
        for keyword in ("oneOf", "allOf"):
            parts = after.get(keyword, [])
            if len(parts) != len(before.get(keyword, [])):
                self.breaks.append(f"{where}: {keyword} has {len(parts)} parts, had {len(before.get(keyword, []))}")
            for i, (old, new) in enumerate(zip(before.get(keyword, []), parts)):
                compare(f"{where}<{i}>", old, new)

    def bounds(self, where, wide, narrow, lower, upper):
        """`narrow` permits at least what `wide` does."""
        for keyword in lower:
            if keyword in narrow and narrow[keyword] > wide.get(keyword, float("-inf")):
                self.breaks.append(f"{where}: {keyword} was {wide.get(keyword)}, is {narrow[keyword]}")
        for keyword in upper:
            if keyword in narrow and narrow[keyword] < wide.get(keyword, float("inf")):
                self.breaks.append(f"{where}: {keyword} was {wide.get(keyword)}, is {narrow[keyword]}")


def _required(schema):
    required = schema.get("required", [])
    return required if isinstance(required, list) else []


@functools.cache
def described():
    return json.loads(subprocess.check_output([sys.argv[1], "schema", "openapi"]))


def breaks(change):
    """Breaks that a change of today's description makes."""
    before = compact(described())
    after = json.loads(json.dumps(before))
    change(after)
    return Comparison(before, after).breaks


class OpenApi(unittest.TestCase):
    def test_clients_of_earlier_versions_go_on_working(self):
        self.assertEqual(Comparison(json.loads(BASELINE.read_text(encoding="utf-8")), compact(described())).breaks, [])

    def test_every_schema_that_is_named_is_there(self):
        document = described()
        named = {part.split('"')[0] for part in json.dumps(document).split("#/components/schemas/")[1:]}
        self.assertGreater(len(named), 20)
        self.assertLessEqual(named, set(document["components"]["schemas"]))

    def test_what_would_break_clients_is_found(self):
        jobs = "get /v1/jobs"

        def of(after):
            return after["operations"][jobs]

        for change in (
            lambda after: after["operations"].pop(jobs),
            lambda after: of(after)["parameters"].pop("query limit"),
            lambda after: of(after)["parameters"]["query limit"].update(maximum=499),
            lambda after: of(after)["parameters"]["query limit"].update(required=True),
            lambda after: of(after)["parameters"]["query sort"]["enum"].remove("oldest"),
            lambda after: of(after)["answers"].pop("200"),
            lambda after: after["operations"]["post /v1/jobs"]["body"].pop("multipart/form-data"),
            lambda after: after["operations"]["post /v1/jobs/{id}/clone"].update(body_required=True),
            lambda after: after["schemas"]["Job"]["required"].remove("state"),
            lambda after: after["schemas"]["Job"]["properties"].pop("keep"),
            lambda after: after["schemas"]["Job"]["properties"]["bytes"].update(type=["integer", "null"]),
            lambda after: after["schemas"].pop("Mistake"),
        ):
            self.assertEqual(len(breaks(change)), 1, breaks(change))

    def test_what_is_added_breaks_nobody(self):
        def add(after):
            after["operations"]["get /v1/more"] = after["operations"]["get /v1/jobs"]
            after["operations"]["get /v1/jobs"]["parameters"]["query more"] = {"required": False, "type": "string"}
            after["operations"]["get /v1/jobs"]["parameters"]["query limit"]["maximum"] = 1000
            after["schemas"]["Job"]["required"].append("more")
            after["schemas"]["Job"]["properties"]["more"] = {"type": "string"}

        self.assertEqual(breaks(add), [])


if __name__ == "__main__":
    if "--write" in sys.argv:
        BASELINE.write_text(json.dumps(compact(described()), separators=(",", ":"), sort_keys=True) + "\n")
    else:
        unittest.main(argv=sys.argv[:1])
