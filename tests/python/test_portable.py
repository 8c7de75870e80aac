"""The package on other systems and in other locales: without what only Unix has, and text as UTF-8 everywhere."""
import ast
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import common

# Takes away what only Unix has before the package is imported, as Python is on Windows.
WITHOUT_UNIX = """
import os, sys
for name in (
    "O_CLOEXEC O_NONBLOCK O_NOFOLLOW O_DIRECTORY pread preadv fork register_at_fork getuid geteuid posix_fadvise "
    "sched_getaffinity killpg setsid statvfs mkfifo"
).split():
    delattr(os, name)
for name in ("fcntl", "resource", "pwd", "grp", "termios"):
    sys.modules[name] = None
import throng
"""
READ = """
import concurrent.futures
dataset = throng.Dataset(sys.argv[1])
with concurrent.futures.ThreadPoolExecutor(4) as pool:  # they share the archive's position
    frames = list(pool.map(lambda frame: [frame.image().sum(), frame.depth().shape, len(frame.people)], dataset))
print(frames)
"""
ELSEWHERE = """
import throng.env
sys.platform = "win32"
for use in (lambda: throng.Env({}), lambda: throng.simulate({}, "x.h5")):
    try:
        use()
    except throng.ThrongError as error:
        print(error)
"""
# A job whose texts and paths are not ASCII.
IN_C_LOCALE = """
import json, sys, throng
job, folder = sys.argv[1], sys.argv[2]
throng.engine.Simulation(job, trace=folder + "/trace.h5").finish()
env = throng.Env(job)
print(ascii(env.job["name"]), throng.Trace(folder + "/trace.h5").scenario)
with open(job, encoding="utf-8-sig") as file:
    print(len(throng.run(json.load(file), folder + "/out", quiet=True)[0].people.boxes))
print(throng.Dataset(folder + "/job.tar")[0].run)
"""
C_LOCALE = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}


def call(code, *arguments, **more):
    environment = {
        **os.environ,
        "PYTHONPATH": str(common.ROOT / "python"),
        "THRONG_PROGRAM": str(common.THRONG),
        **more,
    }
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, env=environment, capture_output=True, timeout=300, check=False)


class Portable(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def answer(self, *arguments, **more):
        done = call(*arguments, **more)
        self.assertEqual(done.returncode, 0, done.stderr.decode(errors="replace"))
        return done.stdout.decode()

    def test_datasets_are_read_without_unix(self):
        dataset = common.dataset_folder()
        expected = self.answer("import sys, throng" + READ, dataset)
        archives = [shutil.make_archive(self.folder / "set", kind, dataset) for kind in ("tar", "zip")]
        for path in [dataset, *archives]:
            self.assertEqual(self.answer(WITHOUT_UNIX + READ, path), expected, path)

    def test_what_needs_linux_says_so(self):
        lines = self.answer(WITHOUT_UNIX + ELSEWHERE, THRONG_PROGRAM="throng-absent").splitlines()
        self.assertEqual(len(lines), 2)
        for line in lines:
            self.assertRegex(line, "runs on Linux only: elsewhere use its container .* or throng.Client")

    def test_text_is_utf_8_in_the_c_locale(self):
        folder = self.folder / "Prüfung"
        folder.mkdir()
        drone = {"id": "a", "start": [0, -2, 14], "camera": {"width": 64, "height": 64, "pitch_deg": -60}}
        job = {"name": "Prüfung", "scenario": "city_square/nearest_exit", "crowd": {"agents": 9}, "drones": [drone]}
        job["capture"] = {"rate_hz": 1, "from_s": 1, "to_s": 1}
        file = folder / "jöb.json"
        file.write_text(json.dumps(job, ensure_ascii=False), encoding="utf-8-sig")
        shutil.make_archive(folder / "job", "tar", common.dataset_folder())
        lines = self.answer(IN_C_LOCALE, file, folder, **C_LOCALE).splitlines()
        self.assertEqual(lines[0], r"'Pr\xfcfung' city_square/nearest_exit")
        self.assertEqual(lines[2], "run000")
        file.write_bytes("Prüfung".encode("latin-1"))
        for use in ("throng.Env", "throng.engine.Simulation"):
            done = call(f"import sys, throng; {use}(sys.argv[1])", file)
            self.assertIn(b"b.json: found bytes that are no UTF-8", done.stderr)


def without_encoding(tree):
    """Lines of a source whose text would be read or written in the locale's encoding."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        given = {keyword.arg: keyword.value for keyword in node.keywords}
        if "encoding" in given or None in given:
            continue
        is_method = isinstance(node.func, ast.Attribute)
        name = node.func.attr if is_method else getattr(node.func, "id", "")
        constants = [part for each in (*node.args, *given.values()) for part in ast.walk(each)]
        words = [each.value for each in constants if isinstance(each, ast.Constant) and isinstance(each.value, str)]
        modes = [word for word in words if word and set(word) <= set("rwaxbt+")]
        is_text = not any("b" in mode for mode in modes)
        if (
            (name == "read_text" and not node.args)
            or (name == "write_text" and len(node.args) < 2)
            or (name in ("open", "fdopen") and is_text and (not is_method or modes or not node.args))
            or (name in ("NamedTemporaryFile", "TemporaryFile") and modes and is_text)
            or {"text", "universal_newlines"} & set(given)
        ):
            yield node.lineno


class Sources(unittest.TestCase):
    def test_every_text_has_its_encoding(self):
        wrong = [
            f"{path.relative_to(common.ROOT)}:{line}"
            for top in ("python", "examples", "scripts", "bench", "docker")
            for path in (common.ROOT / top).rglob("*.py")
            for line in without_encoding(ast.parse(path.read_bytes()))
        ]
        self.assertEqual(wrong, [], 'expected encoding="utf-8"')

    def test_the_check_sees_them(self):
        wrong = (
            "open(f)",
            'open(f, "w")',
            'p.open("a")',
            "p.open()",
            "p.read_text()",
            "p.write_text(t)",
            'p.read_text(errors="replace")',
            "subprocess.run(c, text=True)",
            'os.fdopen(n, "w")',
            'tempfile.NamedTemporaryFile("w")',
        )
        right = (
            'open(f, "rb")',
            'open(f, mode="wb")',
            'open(f, "ab" if more else "wb")',
            'p.read_text("utf-8")',
            "Image.open(f)",
            'http.open("GET", path)',
            'subprocess.run(c, encoding="utf-8")',
            'tarfile.open(f, "r:")',
        )
        for source in (*wrong, *right):
            self.assertEqual(len(list(without_encoding(ast.parse(source)))), source in wrong, source)


if __name__ == "__main__":
    common.main()
