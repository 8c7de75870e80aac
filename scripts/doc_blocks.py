"""The blocks of code of a page of the documentation, and the files that the page asks its readers to save."""

import re

BLOCK = re.compile(r"^```([^\n]*)\n(.*?)^```[ \t]*$", re.M | re.S)
SAVED = re.compile(r"[Ss]ave this as\s+`([\w./]+)`(?::\s`([^`]+)`)?")


def save_files(folder, text, next_block):
    """Saves the files that the text before a block asks for: their content is given in the text, or is the block."""
    for name, content in SAVED.findall(text):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(content or next_block, encoding="utf-8")


def read_blocks(page):
    """Yields the text before each block, its language and the block."""
    end = 0
    for match in BLOCK.finditer(page):
        yield page[end : match.start()], *match.groups()
        end = match.end()


def replace_passage(page, name, lines):
    """The page with the lines between the two comments of this name replaced."""
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end of {name} -->)", re.S)
    if not pattern.search(page):
        raise SystemExit(f"no comments <!-- {name} --> and <!-- end of {name} --> in the page")
    return pattern.sub(lambda match: match[1] + "".join(f"{line}\n" for line in lines) + match[2], page)
