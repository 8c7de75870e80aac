"""cmake/Modules.cmake and scripts/module_rules.py: projects that break a rule of modules are not configured, and the message names the place.

usage: test_module_rules.py CMAKE COMPILER
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CMAKE, COMPILER = sys.argv[1:3]
FOLDER = pathlib.Path(__file__).resolve().parents[2] / "cmake"

HOUSE = """throng_module(house SOURCES house.cpp MODULES walls)
throng_folder(. "Houses.")
"""
# Two modules, one in a folder of the other, and one above them. walls/stones/ is a plain folder of walls.
PROJECT = {
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.25)
project(fixture LANGUAGES CXX)
include("{folder}/Modules.cmake")
set(THRONG_ALL_MODULES walls/spec walls house)
foreach(module IN LISTS THRONG_ALL_MODULES)
  add_subdirectory(${module})
endforeach()
# exceptions
set(THRONG_LIBRARY_MODULES walls/spec)
throng_check_modules()
""",
    "walls/spec/CMakeLists.txt": """throng_module(walls/spec PUBLIC width.h unused.h)
throng_folder(. "Sizes.")
""",
    "walls/spec/width.h": "#pragma once\n",
    "walls/spec/unused.h": "#pragma once\n",
    "walls/CMakeLists.txt": """throng_module(walls PUBLIC wall.h stones/stone.h SOURCES wall.cpp stones/stone.cpp MODULES walls/spec)
throng_folder(stones "Stones (natural ones) and what holds them together.")
throng_folder(. "Walls.")
throng_folder(arches "Stones above nothing." USES stones)
""",
    "walls/arches/arch.h": '#pragma once\n#include "walls/stones/stone.h"\n#include "walls/brick.h"\n',
    "walls/wall.h": '#pragma once\n#include "walls/brick.h"\n#include "walls/spec/width.h"\n',
    "walls/brick.h": "#pragma once\n",
    "walls/wall.cpp": '#include "walls/wall.h"\n#include "walls/stones/mortar.h"\n',
    "walls/stones/stone.h": "#pragma once\n",
    "walls/stones/mortar.h": "#pragma once\n",
    "walls/stones/stone.cpp": '#include "walls/stones/stone.h"\n#include "walls/stones/mortar.h"\n',
    "house/CMakeLists.txt": HOUSE,
    "house/house.cpp": '#include <vector>\n#include "walls/stones/stone.h"\n#include "walls/wall.h"\n',
    "tests/walls/wall_test.cpp": '#include "walls/brick.h"\n#include "walls/stones/mortar.h"\n#include "walls/spec/width.h"\n',
    "tests/house/house_test.cpp": '#include "../walls/bricks.h"\n#include "walls/wall.h"\n',
    "tests/walls/bricks.h": "#pragma once\n",
    "bench/walls.cpp": '#include "walls/brick.h"\n',
}


class Rules(unittest.TestCase):
    def configure(self, changes=None):
        """Return code and messages of the project with some files replaced (or removed, by None)."""
        files = {**PROJECT, **(changes or {})}
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in files.items():
                if text is not None:
                    (root / path).parent.mkdir(parents=True, exist_ok=True)
                    (root / path).write_text(text.replace("{folder}", str(FOLDER)))
            done = subprocess.run(
                [
                    CMAKE,
                    "-S",
                    root,
                    "-B",
                    root / "build",
                    f"-DCMAKE_CXX_COMPILER={COMPILER}",
                    "-DCMAKE_CXX_COMPILER_FORCED=ON",
                ],
                capture_output=True,
                text=True,
                timeout=120,
            )
        return done.returncode, re.sub(r"\s+", " ", done.stderr)

    def refused(self, changes, *messages):
        code, text = self.configure(changes)
        self.assertNotEqual(code, 0, "the project was configured")
        for message in messages:
            self.assertIn(message, text)
        # Only what is wrong is reported.
        self.assertEqual(
            len(re.findall(r"(?:\.cpp:\d+|\.h:\d+|CMakeLists\.txt|throng_allow_private): ", text)), len(messages), text
        )

    def accepted(self, changes=None):
        code, text = self.configure(changes)
        self.assertEqual(code, 0, text)

    def exception(self, *lines):
        return {"CMakeLists.txt": PROJECT["CMakeLists.txt"].replace("# exceptions", "\n".join(lines))}

    def test_project_that_keeps_the_rules(self):
        self.accepted()

    def test_top_level_folders_that_include_each_other(self):
        self.refused(
            {
                "CMakeLists.txt": PROJECT["CMakeLists.txt"].replace("walls house)", "walls house walls/roof)"),
                "house/CMakeLists.txt": HOUSE.replace("house SOURCES", "house PUBLIC door.h SOURCES"),
                "house/door.h": "#pragma once\n",
                "walls/roof/CMakeLists.txt": 'throng_module(walls/roof SOURCES roof.cpp MODULES house)\nthrong_folder(. "Roofs.")\n',
                "walls/roof/roof.cpp": '#include "house/door.h"\n',
            },
            "house/house.cpp:2: includes walls/stones/stone.h, but 'walls' includes 'house', too (walls/roof/roof.cpp:1),"
            " and a top-level folder is a floor",
        )

    def test_private_header(self):
        self.refused(
            {"house/house.cpp": PROJECT["house/house.cpp"] + '\n  #  include "walls/brick.h"  // inner\n'},
            "house/house.cpp:5: includes walls/brick.h, but this is a private header of module 'walls'"
            " (its public headers: walls/wall.h)",
        )

    def test_private_header_of_an_inner_folder(self):
        self.refused(
            {"house/house.cpp": PROJECT["house/house.cpp"].replace("<vector>", '"walls/stones/mortar.h"')},
            "house/house.cpp:1: includes walls/stones/mortar.h, but this is a private header of module 'walls'",
        )

    def test_private_header_by_other_spellings(self):
        for spelling in ('"../walls/brick.h"', "<walls/brick.h>"):
            self.refused(
                {"house/house.cpp": PROJECT["house/house.cpp"] + f"#include {spelling}\n"},
                "house/house.cpp:4: includes walls/brick.h, but this is a private header of module 'walls'",
            )

    def test_private_header_in_a_header(self):
        self.refused(
            {"house/house.h": '#pragma once\n#include "walls/brick.h"\n'},
            "house/house.h:2: includes walls/brick.h, but this is a private header of module 'walls'",
        )

    def test_undeclared_module(self):
        self.refused(
            {"house/house.cpp": PROJECT["house/house.cpp"] + '#include "walls/spec/width.h"\n'},
            "house/house.cpp:4: includes walls/spec/width.h, but module 'house' does not declare module 'walls/spec'"
            " (MODULES in house/CMakeLists.txt)",
        )

    def test_declared_module_without_an_include(self):
        self.refused(
            {"house/CMakeLists.txt": HOUSE.replace("MODULES walls", "MODULES walls walls/spec")},
            "house/CMakeLists.txt: module 'house' declares module 'walls/spec', but includes none of its headers",
        )

    def test_module_of_a_higher_layer(self):
        self.refused(
            {
                "walls/spec/CMakeLists.txt": PROJECT["walls/spec/CMakeLists.txt"].replace(
                    "unused.h)", "unused.h MODULES walls)"
                ),
                "walls/spec/width.h": '#pragma once\n#include "walls/wall.h"\n',
            },
            "walls/spec/CMakeLists.txt: module 'walls/spec' declares 'walls', which does not precede it",
        )

    def test_public_header_that_does_not_exist(self):
        self.refused(
            {"walls/spec/unused.h": None},
            "walls/spec/CMakeLists.txt: public header walls/spec/unused.h is not a file of module 'walls/spec'",
        )

    def test_public_header_of_another_module(self):
        text = PROJECT["walls/CMakeLists.txt"].replace("wall.h", "wall.h spec/width.h", 1)
        self.refused(
            {"walls/CMakeLists.txt": text},
            "walls/CMakeLists.txt: public header walls/spec/width.h is not a file of module 'walls'",
        )

    def test_public_header_that_nothing_includes(self):
        # Its module, the module's tests and benchmark do not count.
        text = PROJECT["walls/CMakeLists.txt"].replace("wall.h", "wall.h brick.h", 1)
        self.refused(
            {"walls/CMakeLists.txt": text},
            "walls/CMakeLists.txt: public header walls/brick.h is included by no file outside module 'walls'",
        )
        self.accepted({"walls/CMakeLists.txt": text, "tests/house/bricks_test.cpp": '#include "walls/brick.h"\n'})

    def test_tests_and_benchmarks_of_other_modules(self):
        for file in (
            "tests/house/brick_test.cpp",
            "tests/fuzz/fuzz_brick.cpp",
            "bench/house.cpp",
            "examples/brick.cpp",
            "tests/walls/spec/brick_test.cpp",
        ):
            self.refused(
                {file: '#include "walls/brick.h"\n'},
                f"{file}:1: includes walls/brick.h, but this is a private header of module 'walls'",
            )

    def test_exception(self):
        test = {"tests/house/brick_test.cpp": '#include "walls/brick.h"\n'}
        self.accepted({**test, **self.exception("throng_allow_private(tests/house/brick_test.cpp walls/brick.h)")})
        self.refused(
            self.exception("throng_allow_private(tests/house/brick_test.cpp walls/brick.h)"),
            "throng_allow_private: tests/house/brick_test.cpp includes walls/brick.h is an exception that nothing needs",
        )
        # A test may include private headers of its own module anyway.
        self.refused(
            self.exception("throng_allow_private(tests/walls/wall_test.cpp walls/brick.h)"),
            "throng_allow_private: tests/walls/wall_test.cpp includes walls/brick.h is an exception that nothing needs",
        )

    def test_a_module_says_what_it_is_for(self):
        self.refused(
            {"house/CMakeLists.txt": HOUSE.split("throng_folder")[0]},
            "house/CMakeLists.txt: folder 'house' is not declared (throng_folder)",
        )

    def test_folders(self):
        self.refused(
            {"walls/stones/mortar.h": '#pragma once\n#include "walls/arches/arch.h"\n'},
            "walls/stones/mortar.h:2: includes walls/arches/arch.h, but folder 'walls/stones' does not use 'walls/arches'",
        )
        self.refused(
            {"walls/roof/tile.h": "#pragma once\n"},
            "walls/CMakeLists.txt: folder 'walls/roof' is not declared (throng_folder)",
        )
        self.refused(
            {"walls/arches/arch.h": "#pragma once\n"},
            "walls/CMakeLists.txt: folder 'walls/arches' uses 'walls/stones', but includes none of its headers",
        )
        self.refused(
            {f"walls/stones/stone_{i}.h": "#pragma once\n" for i in range(38)},
            "walls/CMakeLists.txt: folder 'walls/stones' holds 41 files, expected at most 40",
        )

    def test_own_folder_is_below_or_above(self):
        self.refused(
            {"walls/wall.cpp": PROJECT["walls/wall.cpp"] + '#include "walls/arches/arch.h"\n'},
            "walls/wall.cpp:3: includes walls/arches/arch.h, but folder 'walls' precedes 'walls/arches' in walls/CMakeLists.txt",
        )
        self.refused(
            {"walls/stones/mortar.h": '#pragma once\n#include "walls/brick.h"\n'},
            "walls/stones/mortar.h:2: includes walls/brick.h, but folder 'walls/stones' precedes 'walls' in walls/CMakeLists.txt",
        )

    def test_a_folder_uses_only_folders_declared_before_it(self):
        text = PROJECT["walls/CMakeLists.txt"].replace('together.")', 'together." USES arches)')
        self.refused(
            {
                "walls/CMakeLists.txt": text,
                "walls/stones/mortar.h": '#pragma once\n#include "walls/arches/arch.h"\n',
            },
            "walls/CMakeLists.txt: folder 'walls/stones' uses 'walls/arches', which is not declared before it",
        )

    def test_refused_modules(self):
        self.refused(
            {"house/CMakeLists.txt": HOUSE.replace("walls)", "walls REFUSES walls/spec)")},
            "house/CMakeLists.txt: module 'house' is linked with module 'walls/spec', which it is to do without",
        )

    def test_all_violations_are_reported_at_once(self):
        self.refused(
            {
                "house/house.cpp": PROJECT["house/house.cpp"] + '#include "walls/brick.h"\n',
                "walls/spec/unused.h": None,
            },
            "house/house.cpp:4: includes walls/brick.h",
            "public header walls/spec/unused.h is not a file",
        )

    def test_build_of_some_modules(self):
        text = PROJECT["CMakeLists.txt"].replace(
            "foreach(module IN LISTS THRONG_ALL_MODULES)", "foreach(module IN ITEMS walls/spec walls)"
        )
        self.accepted({"CMakeLists.txt": text})
        self.refused(
            {"CMakeLists.txt": text, "walls/wall.h": '#pragma once\n#include "walls/brick.h"\n'},
            "walls/CMakeLists.txt: module 'walls' declares module 'walls/spec', but includes none of its headers",
        )


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
