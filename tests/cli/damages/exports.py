"""Damages to the files of other formats."""
from .dataset import damage


def first(d, pattern):
    names = sorted(str(p.relative_to(d.root)) for p in d.root.glob(pattern))
    assert names, "no " + pattern
    return next(n for n in names if d.path(n).stat().st_size > 100)


def edit_line(d, pattern, change):
    name = first(d, pattern)
    lines = d.path(name).read_text().split("\n")
    lines[1] = change(lines[1])
    d.write(name, "\n".join(lines))


@damage
def formats_yolo_box_moved(d):
    def move(line):
        parts = line.split(" ")
        parts[1] = f"{float(parts[1]) + 0.01:.6f}"
        return " ".join(parts)

    edit_line(d, "formats/yolo-detect/labels/*/*.txt", move)


@damage
def formats_kitti_rotation_reversed(d):
    def turn(line):
        parts = line.split(" ")
        parts[-1] = f"{-float(parts[-1]):.2f}"
        return " ".join(parts)

    edit_line(d, "formats/kitti/**/label_2/*.txt", turn)


@damage
def formats_table_column(d):
    name = "formats/table/people.csv"
    head, rows = d.table(name)
    rows[5][-1], rows[6][-1] = rows[6][-1] + "1", rows[5][-1]
    d.save_table(name, head, rows)


def change_lines(d, pattern, change):
    """All lines of the first file."""
    name = first(d, pattern)
    text = d.path(name).read_text()
    changed = "\n".join(change(line) if line.strip() else line for line in text.split("\n"))
    assert changed != text, "nothing changed"
    d.write(name, changed)


def with_column(line, separator, column, change):
    parts = line.split(separator)
    parts[column] = change(parts[column])
    return separator.join(parts)


@damage
def formats_coco_box_moved(d):
    name = first(d, "formats/coco/annotations/*.json")
    text = d.path(name).read_text()
    at = text.index('"bbox":[') + len('"bbox":[')
    d.write(name, text[:at] + "1" + text[at:])


DAMAGES = {
    "formats mot ids exchanged": lambda d: edit_line(
        d, "formats/mot/*/*/gt/gt.txt", lambda line: ",".join([line.split(",")[0], "77", *line.split(",")[2:]])
    ),
    "formats yolo class one more": lambda d: change_lines(
        d, "formats/yolo-detect/labels/*/*.txt", lambda line: with_column(line, " ", 0, lambda v: str(int(v) + 1))
    ),
    "formats visdrone category pedestrians called people": lambda d: change_lines(
        d,
        "formats/visdrone-mot/**/annotations/*.txt",
        lambda line: with_column(line, ",", 7, lambda v: {"1": "2", "2": "1"}.get(v, v)),
    ),
    "formats visdrone occlusion inverted": lambda d: change_lines(
        d,
        "formats/visdrone-mot/**/annotations/*.txt",
        lambda line: with_column(line, ",", 9, lambda v: {"0": "2", "2": "0"}.get(v, v)),
    ),
    "formats mot boxes 2 px off": lambda d: change_lines(
        d, "formats/mot/*/*/gt/gt.txt", lambda line: with_column(line, ",", 2, lambda v: f"{float(v) + 2:g}")
    ),
    "formats mot frames from zero": lambda d: change_lines(
        d, "formats/mot/*/*/gt/gt.txt", lambda line: with_column(line, ",", 0, lambda v: str(int(v) - 1))
    ),
}
