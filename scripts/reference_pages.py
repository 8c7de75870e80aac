#!/usr/bin/env python3
"""Writes the pages of docs/reference that follow from the program: commands, routes of the API, fields of files.

usage: scripts/reference_pages.py [THRONG] [--check]    default: build/release/cli/throng
--check writes nothing, names the pages that are not up to date and exits with 1.

Commands are those that `throng help` prints, routes those of `throng schema openapi`, fields those of the JSON Schemas that
`throng schema` prints. docs/reference/structure.md is written by scripts/measure_structure.py.
"""
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "docs" / "reference"
NOTE = "`scripts/reference_pages.py` writes this page from {}; do not edit it.\n\n"
PLURALS = {"number": "numbers", "integer": "integers", "text": "texts", "an object": "objects"}
FIELDS_HEAD = "| field | values | unit | default | meaning |\n|---|---|---|---|---|\n"
# Kind of file -> its schema or the table that the schema follows from, the page that explains the task.
FILES = {
    "job": ("spec/job/job.schema.json", "job.md"),
    "scenario": ("world/fields/scenario_fields.cpp", "scenario.md"),
    "blueprint": ("spec/blueprint/blueprint_fields.cpp", "blueprint.md"),
    "study": ("spec/study/study_document.cpp", "study.md"),
    "airframe": ("spec/sim/airframe_fields.cpp", "drones.md#airframes"),
    "character": ("spec/skinning/character_description.cpp", "people.md#characters-of-your-own"),
    "calibration": ("spec/calibration/request.cpp", "calibration.md"),
    "camera": ("spec/calibration/camera_file.cpp", "calibration.md"),
    "experiments": ("spec/crowd/experiment_fields.cpp", "validation.md"),
}


def meaning(text):
    """A description as the cell of a table: documents are linked."""
    text = re.sub(r"(?<!`)\bdocs/((?:reference/)?\w+\.md)", lambda m: f"[{m[1]}]({page_link(m[1])})", text)
    return text.replace("|", "\\|").replace("<", "&lt;")


def page_link(page):
    return page.removeprefix("reference/") if page.startswith("reference/") else f"../{page}"


def words_text(words):
    return ", ".join(f"`{json.dumps(word)}`" for word in words).replace("|", "\\|")


def plain(value):
    """A number or another JSON value as a person writes it."""
    return f"{value:.12g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


class Schema:
    """Tables of the fields of a JSON Schema. Definitions with fields have sections, to which other tables link."""

    def __init__(self, document, definitions):
        self.document = document
        self.definitions = definitions

    def resolved(self, rules):
        if "$ref" not in rules:
            return rules
        below = self.document
        for key in rules["$ref"][2:].split("/"):
            below = below[key]
        return {**below, **{key: value for key, value in rules.items() if key != "$ref"}}

    def alternatives(self, rules):
        return [self.resolved(one) for one in rules.get("anyOf", []) + rules.get("oneOf", [])]

    def has_fields(self, rules):
        return bool(rules.get("properties")) or any(map(self.has_fields, self.alternatives(rules)))

    def section_of(self, rules):
        """The link to the section of a reference; None where its values stand in the table itself."""
        if "$ref" not in rules or not self.has_fields(self.resolved(rules)):
            return None
        name = rules["$ref"].rsplit("/", 1)[-1]
        return f"[{name}](#{name.lower()})"

    def range_text(self, rules):
        low, high = rules.get("minimum", rules.get("exclusiveMinimum")), rules.get("maximum")
        above = "above " if "exclusiveMinimum" in rules else ""
        if low is None or high is None:
            return "" if low is None else f", {above}{plain(low)}" + ("" if above else " or more")
        return f", {above}{plain(low)} to {plain(high)}"

    def length_text(self, rules, low, high):
        low, high = rules.get(low, 0), rules.get(high)
        if high is None:
            return f"{low} or more" if low else ""
        return f"{high}" if low == high else f"{low} to {high}"

    def list_text(self, rules):
        length = self.length_text(rules, "minItems", "maxItems")
        items = rules.get("items", {})
        what = self.section_of(items)
        resolved = self.resolved(items)
        if not what and "enum" not in resolved and resolved.get("title"):
            what = resolved["title"].lower() + "s"
        elif not what and items:
            what = re.sub(r"^(number|integer|text|an object)\b", lambda m: PLURALS[m[0]], self.values(items))
        return f"list{f' of {length}' if length else ''}" + (f": {what}" if what else "")

    def values(self, reference):
        """The values that rules allow."""
        section = self.section_of(reference)
        rules = self.resolved(reference)
        if section:
            return section
        kinds = rules.get("type", "")
        kind, *others = kinds if isinstance(kinds, list) else [kinds]
        or_null = " or null" if "null" in others else ""
        choice = re.fullmatch(r"\^\((.*)\)\$", rules.get("pattern", ""))
        if rules.get("x-distribution") == ["choice"] and choice:
            return words_text(choice[1].split("|")) + "; or a choice"
        if "enum" in rules:
            return words_text(rules["enum"])
        if "const" in rules:
            return words_text([rules["const"]])
        if "x-expected" in rules and not rules["x-expected"].startswith(("an array", "a list")):
            return rules["x-expected"].replace("|", "\\|") + (
                "; or a distribution" if "x-distribution" in rules else ""
            )
        if kind == "array":
            return self.list_text(rules) + or_null
        if kind == "string":
            length = self.length_text(rules, "minLength", "maxLength")
            return f"text{f' of {length} characters' if length else ''}{or_null}"
        if kind in {"number", "integer"}:
            return f"{kind}{self.range_text(rules)}{or_null}"
        for key, word in (("anyOf", " or "), ("oneOf", " or "), ("allOf", " with ")):
            if key in rules:
                return word.join(sorted(map(self.values, rules[key]), key=lambda one: one == "null"))
        return {"boolean": "true or false", "object": "an object", "null": "null"}.get(kind, "any value") + or_null

    def rows(self, rules, path=""):
        text = ""
        for name, reference in rules.get("properties", {}).items():
            if name == "$schema" or self.resolved(reference).get("deprecated"):
                continue
            text += self.row(reference, path + name, name in rules.get("required", []))
        seen = set()
        for one in rules.get("anyOf", []) + rules.get("oneOf", []):
            if self.section_of(one):
                continue
            fresh = {
                name: field for name, field in self.resolved(one).get("properties", {}).items() if name not in seen
            }
            seen.update(fresh)
            text += self.rows({"properties": fresh}, path)
        return text

    def row(self, reference, path, is_required):
        rules = self.resolved(reference)
        section = self.section_of(reference)
        default = f"`{plain(rules['default'])}`" if rules.get("default", {}) != {} else ""
        row = f"| `{path}` | {self.values(reference)} | {rules.get('unit', '')} | "
        row += f"{'required' if is_required else default} | {meaning(rules.get('description', ''))} |\n"
        if section:
            return row
        items = rules.get("items", {})
        if self.has_fields(rules):
            row += self.rows(rules, path + ".")
        elif not self.section_of(items) and self.has_fields(items):
            row += self.rows(items, path + "[].")
        return row

    def also_required(self):
        """A sentence on alternative required fields of the document."""
        deprecated = {name for name, rules in self.document["properties"].items() if rules.get("deprecated")}
        lists = [set(one.get("required", [])) for one in self.document.get("anyOf", [])]
        lists = [names for names in lists if names and not names & deprecated]
        fields = self.document["properties"]
        choices = [", ".join(f"`{name}`" for name in fields if name in names) for names in lists]
        return f"Also required: {'; or '.join(choices)}.\n\n" if choices else ""

    def sections(self, level):
        """A section for each definition that has fields."""
        text = ""
        for name, rules in sorted(self.definitions.items()):
            if not self.has_fields(rules):
                continue
            sentences = [meaning(rules["description"])] if "description" in rules else []
            if "anyOf" in rules and "x-expected" in rules:
                sentences.append(f"It is {rules['x-expected']}.")
            text += f"\n{level} {name}\n\n" + (" ".join(sentences) + "\n\n" if sentences else "")
            text += FIELDS_HEAD + self.rows(rules)
        return text


def file_page(throng, kind):
    file, task = FILES[kind]
    is_schema = file.endswith(".json")
    text = (ROOT / file).read_text(encoding="utf-8") if is_schema else subprocess.check_output([throng, "schema", kind])
    document = json.loads(text)
    if kind == "study":  # jobs have a page of their own
        for part in ("crowd", "drones"):
            document["definitions"][part] = {"description": f"As `{part}` of a job (docs/reference/job.md)."}
    schema = Schema(document, document.get("definitions", {}))
    text = f"# Fields of a file: {kind}\n\n{NOTE.format(f'`{file}`')}"
    text += f"[{task.partition('#')[0]}](../{task}) explains the task. `throng schema {kind}` prints the schema, "
    text += f'with which editors complete and check fields. A path such as `a[].b` is `{{"a": [{{"b": ...}}]}}`.\n\n'
    text += schema.also_required() + FIELDS_HEAD + schema.rows(document)
    if kind == "job":
        text += '\n"Or a distribution": the value may be sampled for each run, as '
        text += "[job_randomization.md](../job_randomization.md) describes.\n"
    return text + schema.sections("##")


def answers_text(schema, responses):
    """The answers of a route: those that succeed, then the codes of problem documents."""
    lines, problems = "", []
    for code, answer in responses.items():
        if "$ref" in answer:
            problems.append(code)
            continue
        kinds = [
            f"`{kind}`" + (f" {schema.values(content['schema'])}" if "schema" in content else "")
            for kind, content in answer.get("content", {}).items()
        ]
        headers = [f"`{name}`" for name in answer.get("headers", {})]
        parts = [meaning(answer["description"]), f"{', '.join(kinds)}." if kinds else ""]
        parts.append(f"Headers: {', '.join(headers)}." if headers else "")
        lines += f"- **{code}** {' '.join(filter(None, parts))}\n"
    return lines + (f"- {', '.join(sorted(problems))}: a [Problem](#problem)\n" if problems else "")


def route_text(schema, method, path, route):
    text = f"\n### {method.upper()} {path}\n\n{meaning(route['summary'])}."
    text += f" {meaning(route['description'])}\n\n" if "description" in route else "\n\n"
    parameters = [schema.resolved(parameter) for parameter in route.get("parameters", [])]
    if parameters:
        text += "| parameter | in | values | default | meaning |\n|---|---|---|---|---|\n"
    for parameter in parameters:
        rules = parameter["schema"]
        default = f"`{plain(rules['default'])}`" if "default" in rules else ""
        text += f"| `{parameter['name']}` | {parameter['in']} | {schema.values(rules)} | "
        text += (
            f"{'required' if parameter.get('required') else default} | {meaning(parameter.get('description', ''))} |\n"
        )
    text += "\n" if parameters else ""
    body = route.get("requestBody", {})
    for kind, content in body.get("content", {}).items():
        rules = content.get("schema", {})
        said = schema.resolved(rules).get("description", body.get("description", ""))
        text += f"Body `{kind}`: {schema.values(rules)}. {meaning(said)}".rstrip()
        inner = "" if schema.section_of(rules) else schema.rows(rules)
        text += f"\n\n{FIELDS_HEAD}{inner}\n" if inner else "\n\n"
    return text + answers_text(schema, route["responses"])


def api_page(throng):
    document = json.loads(subprocess.check_output([throng, "schema", "openapi"]))
    schema = Schema(document, document["components"]["schemas"])
    text = f"# Routes of the HTTP API\n\n{NOTE.format('`throng schema openapi`, which a service sends as `/openapi.json`')}"
    text += "[api.md](../api.md) explains keys, uploads and errors.\n"
    tags = {}
    for path, routes in document["paths"].items():
        for method, route in routes.items():
            tags.setdefault(route["tags"][0], []).append(route_text(schema, method, path, route))
    for tag, routes in tags.items():
        text += f"\n## Routes: {tag}\n" + "".join(routes)
    return text + "\n## Values\n" + schema.sections("###")


OPTION = re.compile(
    r"(?: (TEXT|INT|UINT|FLOAT)(?::(.*?))?(?:=(.*?))?)?((?: REQUIRED| \.\.\.)*)((?: (?:Excludes|Needs): .*)?)"
)


def option_row(left, text):
    """A row for a line of `throng help`: names, type with its range and default, what it needs, meaning."""
    names = left.split()[0]
    found = OPTION.fullmatch(left.removeprefix(names))
    if not found:
        sys.exit(f"throng help prints an option that this script does not know: {left}")
    kind, limits, default, marks, relation = found.groups()
    values = {"TEXT": "text", "INT": "integer", "UINT": "integer, 0 or more", "FLOAT": "number", None: ""}[kind]
    if limits and limits.startswith("{"):
        values = ", ".join(f"`{word}`" for word in limits[1:-1].split(","))
    elif limits:
        span = re.sub(r".* in \[(.*) - (.*)\]", r"\1 to \2", limits)
        values += ", " + {"NONNEGATIVE": "0 or more", "POSITIVE": "above 0"}.get(span, span)
    values += "; repeatable" if "..." in marks else ""
    default = "required" if "REQUIRED" in marks else f"`{default}`" if default else ""
    return f"| `{names}` | {values} | {default} | {meaning(text)}{f' ({relation.strip()})' if relation else ''} |\n"


def entries_of(lines):
    """Left and right column of the lines of a section of `throng help`, whose right column begins at 30."""
    for line, following in zip(lines, [*lines[1:], ""]):
        if line.startswith(" " * 30):
            continue
        is_long = following.startswith(" " * 30)
        yield (line.strip(), following.strip()) if is_long else (line[:30].strip(), line[30:].strip())


def command_text(throng, words):
    """The section of a command and those of the commands below it."""
    environment = {**os.environ, "THRONG_PEOPLE": "$THRONG_PEOPLE"}
    done = subprocess.run([throng, "help", *words], capture_output=True, encoding="utf-8", check=True, env=environment)
    summary, usage, *lines = done.stdout.replace(str(throng), "throng").splitlines()
    sections, notes = {}, []
    for line in filter(None, lines):
        if line.startswith("  "):
            sections[name].append(line)
        elif line.endswith(":"):
            name = line
            sections[name] = []
        else:
            notes.append(line)
    options = [*entries_of(sections.get("Positionals:", [])), *entries_of(sections.get("Options:", []))]
    rows = "".join(option_row(left, right) for left, right in options if left != "-h,--help")
    below = [left for left, _ in entries_of(sections.get("Subcommands:", []))]
    text = "" if not words else f"\n## throng {' '.join(words)}\n\n{meaning(summary).removesuffix('.')}.\n"
    if words and not below:
        text += f"\n`{' '.join(usage.removeprefix('Usage: ').split())}`\n"
    text += "".join(f"\n{meaning(note)}\n" for note in notes if not words or not note.startswith("Exit codes"))
    text += f"\n| argument | values | default | meaning |\n|---|---|---|---|\n{rows}" if rows else ""
    return text + "".join(command_text(throng, [*words, name]) for name in below)


def cli_page(throng):
    text = f"# Commands of the program\n\n{NOTE.format('what `throng help COMMAND` prints')}"
    return text.rstrip() + "\n" + command_text(throng, [])


def pages(throng):
    """The text of each page by its name."""
    vocabulary = subprocess.run(
        [throng, "crowd", "--list", "--markdown"], capture_output=True, encoding="utf-8", check=True
    )
    made = {"cli": cli_page(throng), "api": api_page(throng), "crowd_vocabulary": vocabulary.stdout}
    return {**made, **{kind: file_page(throng, kind) for kind in FILES}}


def main():
    arguments = [word for word in sys.argv[1:] if word != "--check"]
    throng = pathlib.Path(arguments[0] if arguments else ROOT / "build/release/cli/throng").resolve()
    stale = []
    for name, text in pages(throng).items():
        page = FOLDER / f"{name}.md"
        if page.exists() and page.read_text(encoding="utf-8") == text:
            continue
        stale.append(f"docs/reference/{name}.md")
        if "--check" not in sys.argv:
            page.write_text(text, encoding="utf-8")
    if "--check" not in sys.argv:
        print("\n".join(f"wrote {page}" for page in stale) or "nothing has changed")
    elif stale:
        sys.exit(f"not up to date: {', '.join(stale)}; run: scripts/reference_pages.py build/release/cli/throng")


if __name__ == "__main__":
    main()
