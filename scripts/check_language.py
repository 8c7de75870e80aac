#!/usr/bin/env python3
"""Refuses British spelling, coined words and relative clauses without antecedent in identifiers, comments and docs.

usage: scripts/check_language.py [FILE...]      default: all tracked files; exit code 1 with one line per finding

Each message names the replacement; docs/glossary.md defines the terms. String literals of less than three words are not
checked, nor those of tests: they hold public names, which keep their spelling. Code spans of Markdown are not checked for
the same reason.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Folders that still have old words; empty this list folder by folder.
NOT_YET: tuple[str, ...] = ()

# British -> American, by stem: an ending that both share follows.
BRITISH = {
    "behaviour": "behavior",
    "colour": "color",
    "neighbour": "neighbor",
    "honour": "honor",
    "favour": "favor",
    "labour": "labor",
    "harbour": "harbor",
    "vapour": "vapor",
    "centre": "center",
    "centring": "centering",
    "centred": "centered",
    "metre": "meter",
    "litre": "liter",
    "fibre": "fiber",
    "theatre": "theater",
    "manoeuvre": "maneuver",
    "grey": "gray",
    "catalogue": "catalog",
    "licence": "license",
    "defence": "defense",
    "labelled": "labeled",
    "labelling": "labeling",
    "modelled": "modeled",
    "modelling": "modeling",
    "travelled": "traveled",
    "travelling": "traveling",
    "signalled": "signaled",
    "levelled": "leveled",
    "storey": "story",
    "learnt": "learned",
    "spelt": "spelled",
    "burnt": "burned",
    "whilst": "while",
    "amongst": "among",
    "plough": "plow",
    "artefact": "artifact",
    "aluminium": "aluminum",
    "judgement": "judgment",
    "sceptic": "skeptic",
    "mould": "mold",
    "programme": "program",
    "tyre": "tire",
    "analyse": "analyze",
    "analysing": "analyzing",
    "initialis": "initializ",
    "normalis": "normaliz",
    "optimis": "optimiz",
    "organis": "organiz",
    "recognis": "recogniz",
    "summaris": "summariz",
    "linearis": "lineariz",
    "rasteris": "rasteriz",
    "randomis": "randomiz",
    "minimis": "minimiz",
    "maximis": "maximiz",
    "discretis": "discretiz",
    "serialis": "serializ",
    "quantis": "quantiz",
    "tokenis": "tokeniz",
    "visualis": "visualiz",
    "characteris": "characteriz",
    "specialis": "specializ",
    "generalis": "generaliz",
    "synchronis": "synchroniz",
    "standardis": "standardiz",
    "parametris": "parametriz",
    "stabilis": "stabiliz",
    "utilis": "utiliz",
    "penalis": "penaliz",
    "prioritis": "prioritiz",
    "localis": "localiz",
}

# Coined word or phrase in comments and documentation -> the field's term.
COINED = {
    "ways": "paths, trajectories",
    "strewn": "scattered, placed at random",
    "anew": "again",
    "told": "informed, given",
    "craft": "vehicle, drone",
    "crafts": "vehicles, drones",
    "shut": "closed",
    "in vain": "without success",
    "stand about": "stand, are idle",
    "stands about": "stands, is idle",
    "baked people": "character library",
    "things that stand": "props",
    "likelier": "more probable",
    "drawn anew": "sampled again",
    "people of one's own": "custom characters",
    "picture": "image",
    "pictures": "images",
    "thing": "object, prop, resource",
    "things": "objects, props, resources",
    "whoever": "those who, the person who",
    "lies hurt": "is a casualty",
    "begun first": "started first",
    "queue rests": "queue is paused",
    "shortest way": "shortest path",
    "new way": "new path",
}

# String literals that stay as they are: they are written into datasets, whose bytes do not change for spelling.
LITERALS_KEPT = ("spec/annotate/ground_truth.cpp",)

# Identifiers: pattern -> the field's term.
IDENTIFIERS = (
    (re.compile(r"\bk(?:Most|Longest|Farthest)(?=[A-Z_\d]|\b)"), "kMax..."),
    (re.compile(r"\bk(?:Least|Fewest)(?=[A-Z_\d]|\b)"), "kMin..."),
    (re.compile(r"\b(?:most|longest|farthest)_(?!similar\b|frequent\b|always\b|half\b)\w*"), "max_..."),
    (re.compile(r"\b(?:least|fewest)_\w+"), "min_..."),
    (
        re.compile(r"\b(?:ways|strewn|crafts?|Crafts?|Bell|GoOn)\b"),
        "paths, scattered, vehicle, EventCounter, ContinueCallback",
    ),
    (re.compile(r"\b(?:say_that|take_what|stop_if_wrong|is_anothers)\w*"), "a verb and its object: apply_overrides"),
    (re.compile(r"\b[Tt]old\b"), "given, reported, notified"),
    (re.compile(r"\b(?:Who|Whom|Whose|What)[A-Z]\w*"), "a noun and a verb: YieldsToAgentsWithRightOfWay"),
    (
        re.compile(r"(?<=\n)[^\s#/][^\n;={}()]*[\s&*]\w+_of(?=\()"),
        "a verb and its object, or a noun: read_name, job_name",
    ),
    (re.compile(r"\b\w*Places?\b"), "scenario, position, index"),
    (re.compile(r"\bk[A-Z][A-Za-z\d]*_(?:m2?|s|deg|rad|px|cm|h|mps|hz)\b"), "the unit as a word: kReachM"),
    (re.compile(r"\b(?:min|max)_value_?\b"), "a quantity and its unit: max_neighbors, max_speed_mps"),
    (re.compile(r"\b(?!picture_test\b)\w*[Pp]icture\w*"), "image, texture, plot"),
)

# A term of its own in some folders: in OpenStreetMap's data model an ordered list of nodes is a "way"
# (wiki.openstreetmap.org/wiki/Way).
TERMS_BY_FOLDER = {"ways": ("places/imports/", "tests/places/imports/")}


def is_term_here(word, path):
    return path.startswith(TERMS_BY_FOLDER.get(word.lower(), ("//",)))


RELATIVE = re.compile(
    r"(?:^|(?<=[.:;!?] )|(?<=\| )|(?<=- )|(?<=\*\*))(Who|Whom|Whoever|What|Whatever|Where|Those who|Those that)\b(?![^.?!]*\?)"
)

# A fragment such as "Of all jobs." leaves the reader to find its subject.
FRAGMENT = re.compile(r"(?:Of|Behind) (?!course)")

CODE = (".cpp", ".h", ".glsl", ".js", ".mjs", ".ts", ".tsx")
TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|R"(?P<mark>[^()\s\\]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|"""
    r"""(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])*'""",
    re.S,
)
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")
BRITISH_WORD = re.compile(
    "(?:re|un|mis|uni|centi|milli|kilo|deci|micro)?(" + "|".join(sorted(BRITISH, key=len, reverse=True)) + ")"
)
COINED_WORD = re.compile(r"\b(" + "|".join(sorted(COINED, key=len, reverse=True)) + r")\b", re.I)
# Public names and proper terms: see the end of docs/glossary.md.
FIELD_NAME = re.compile(r"\w*_\w*")
QUOTED = re.compile(r"`[^`\n]*`|\"[^\"\n]*\"|\w+\.(?:h|cpp|glsl|md)\b|https?://\S+")
FENCE = re.compile(r"^```.*?^```", re.S | re.M)


class Report:
    """Findings of one file."""

    def __init__(self, path, text):
        self.path, self.text, self.findings = path, text, []

    def add(self, offset, found, instead):
        line = self.text.count("\n", 0, offset) + 1
        self.findings.append(f'{self.path}:{line}: "{found}": use {instead}')

    def spelling(self, text, offset):
        for word in WORD.finditer(text):
            british = BRITISH_WORD.match(word[0].lower())
            if british and not word[0].lower().startswith(
                ("greyhound", "optimism", "optimist", "organism", "minimist", "specialist", "labelledby")
            ):
                self.add(offset + word.start(), word[0], word[0].lower().replace(british[1], BRITISH[british[1]]))

    def coined(self, text, offset):
        for word in COINED_WORD.finditer(text):
            if not is_term_here(word[0], self.path):
                self.add(offset + word.start(), word[0], COINED[word[0].lower()])

    def prose(self, text, offset):
        text = QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)
        self.spelling(text, offset)
        self.coined(text, offset)

    def literal(self, text, offset):
        """A string literal: a message or a help text if it has three words or more."""
        if text.count(" ") < 2 or self.path.startswith(("tests/", "bench/")) or self.path in LITERALS_KEPT:
            return
        text = FIELD_NAME.sub(lambda name: " " * len(name[0]), text)
        self.spelling(text, offset)
        self.coined(text, offset)
        self.clauses(re.sub(r'^(?:R"[^\s()"]*\(|")', lambda mark: " " * len(mark[0]), text).strip(), offset)

    def comment(self, text, offset):
        """A comment as a whole."""
        if fragment := FRAGMENT.match(text):
            self.add(offset, fragment[0] + "...", "a sentence with a subject at the beginning of a comment")
        self.clauses(text, offset)

    def clauses(self, text, offset):
        for clause in RELATIVE.finditer(text):
            self.add(offset + clause.start(), clause[0] + " ...", "a noun or a verb at the beginning of a sentence")

    def identifiers(self, text, offset):
        self.spelling(text, offset)
        for pattern, instead in IDENTIFIERS:
            for name in pattern.finditer(text):
                if is_term_here(name[0], self.path):
                    continue
                self.add(offset + name.start(), name[0], instead)


def check_code(report):
    text, end = report.text, 0
    block, start = "", 0  # consecutive comment lines are one text, apart from what follows code
    follows_code = False
    for token in TOKEN.finditer(text):
        between = text[end : token.start()]
        report.identifiers(between, end)
        comment = token["comment"]
        ended = follows_code
        follows_code = bool(text[text.rfind("\n", 0, token.start()) + 1 : token.start()].strip())
        if block and (comment is None or between.strip() or between.count("\n") > 1 or ended):
            report.comment(block, start)
            block = ""
        if comment is None:
            report.literal(token[0], token.start())
        else:
            report.prose(comment, token.start())
            body = re.sub(r"^//+<?\s?", lambda mark: " " * len(mark[0]), comment)
            if not block:
                start = token.start() + len(body) - len(body.lstrip())
                block = body.lstrip()
            else:
                block += " " + body.strip()
        end = token.end()
    report.identifiers(text[end:], end)
    if block:
        report.comment(block, start)


def check_markdown(report):
    text = FENCE.sub(lambda fence: re.sub(r"[^\n]", " ", fence[0]), report.text)
    text = re.sub(r"\]\([^)]*\)", lambda link: " " * len(link[0]), text)
    report.prose(text, 0)
    offset = 0
    for line in text.split("\n"):
        report.clauses(line, offset)
        offset += len(line) + 1


def check_script(report):
    for comment in re.finditer(r"(?:^|\s)#(?!!) ?(.*)", report.text):
        report.prose(comment[1], comment.start(1))
    for text in re.finditer(r'(?:(?:^[ \t]*#(?!!).*\n)+)|"""(?:[^"]|"(?!""))*"""', report.text, re.M):
        body = re.sub(r'^[ \t]*#+ ?|"""', lambda mark: " " * len(mark[0]), text[0], flags=re.M)
        start = len(body) - len(body.lstrip())
        report.clauses(re.sub(r"\n\s*", " ", body[start:]), text.start() + start)
        if '"""' in text[0]:
            report.prose(text[0], text.start())


def check(path):
    text = (ROOT / path).read_text(encoding="utf-8")
    report = Report(path, text)
    if path.endswith(CODE):
        check_code(report)
    elif path.endswith(".md"):
        check_markdown(report)
    else:
        check_script(report)
    return report.findings


def main():
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    suffixes = CODE + (".md", ".py", ".sh", ".cmake", "CMakeLists.txt")
    paths = sys.argv[1:] or [
        path
        for path in listed.stdout.split("\0")
        if path.endswith(suffixes)
        and not path.startswith(NOT_YET)
        and path not in ("CHANGELOG.md", "docs/glossary.md", "scripts/check_language.py")
        and (ROOT / path).is_file()
    ]
    findings = [finding for path in paths for finding in check(path)]
    print("\n".join(findings), end="\n" if findings else "")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
