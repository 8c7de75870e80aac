"""Installs the library to a temporary prefix and builds an example against it, as a user's project does.

usage: test_installed.py CMAKE BUILD EXAMPLES COMPILER
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CMAKE, BUILD, EXAMPLES, COMPILER = sys.argv[1:5]


def run(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"{command}\n{done.stdout[-4000:]}\n{done.stderr[-4000:]}"
    return done.stdout


class Installed(unittest.TestCase):
    def test_an_example_builds_against_the_installed_library(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            prefix = folder / "prefix"
            run(CMAKE, "--install", BUILD, "--prefix", prefix, "--component", "library")
            headers = {str(path.relative_to(prefix / "include/throng")) for path in prefix.rglob("*.h")}
            self.assertLessEqual(
                {
                    "crowd/simulation.h",
                    "crowd/description/builder.h",
                    "crowd/description/menge_files/write.h",
                    "world/scenario.h",
                    "base/error.h",
                },
                headers,
            )
            # Private headers are not installed, and the installed ones need no others.
            self.assertNotIn("crowd/behavior/machine.h", headers)
            self.assertNotIn("crowd/description/menge_files/utf8.h", headers)
            every = folder / "every.cpp"
            every.write_text("".join(f'#include "{header}"\n' for header in sorted(headers)))
            libraries = run("pkg-config", "--cflags", "eigen3", "hdf5").split()
            # The package's targets define the version.
            run(
                COMPILER,
                "-std=c++20",
                "-fsyntax-only",
                '-DTHRONG_VERSION="0"',
                *libraries,
                "-I",
                prefix / "include/throng",
                every,
            )
            # Nothing of the installed package says where it was built.
            for file in prefix.rglob("*.cmake"):
                self.assertNotIn(str(Path(BUILD).resolve()), file.read_text(), file)
                self.assertNotIn(str(Path(EXAMPLES).resolve().parent), file.read_text(), file)
            # Of the examples only one: the others need nothing else.
            run(
                CMAKE,
                "-S",
                EXAMPLES,
                "-B",
                folder / "build",
                f"-DCMAKE_PREFIX_PATH={prefix}",
                f"-DCMAKE_CXX_COMPILER={COMPILER}",
            )
            run(CMAKE, "--build", folder / "build", "--target", "example_room_and_door")
            self.assertIn("60 of 60 people out", run(folder / "build/example_room_and_door"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
