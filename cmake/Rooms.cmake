# One library per module. A module declares the modules and libraries it may use; an #include of any other module stops
# the configuration. A module may lie in a folder of another ("jobs/spec"): its library is throng_jobs_spec.

# With sanitizers most modules are compiled without optimization, which takes half the time; these would run too slowly.
set(THRONG_OPTIMIZED_MODULES base crowd/description crowd/menge_files world crowd camera calibrate places sim metrics validation skinning render)
# The modules that the fuzz targets (tests/fuzz) cover.
set(THRONG_FUZZED_MODULES base crowd/description crowd/menge_files world crowd imports metrics/spec metrics jobs/spec)

# throng_room(NAME SOURCES file... ROOMS module... LIBRARIES target... PRIVATE_LIBRARIES target...)
function(throng_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;ROOMS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  string(REPLACE "/" "_" target "${name}")
  if(ARG_SOURCES)
    set(links PUBLIC)
    add_library(throng_${target} STATIC ${ARG_SOURCES})
    target_link_libraries(throng_${target} PRIVATE $<BUILD_INTERFACE:throng_flags> ${ARG_PRIVATE_LIBRARIES})
  else() # only headers
    set(links INTERFACE)
    add_library(throng_${target} INTERFACE)
  endif()
  add_library(throng::${target} ALIAS throng_${target})
  set(room_targets "${ARG_ROOMS}")
  list(TRANSFORM room_targets REPLACE "/" "_")
  list(TRANSFORM room_targets PREPEND "throng::")
  target_include_directories(throng_${target} ${links}
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:include/throng>")
  target_link_libraries(throng_${target} ${links} ${room_targets} ${ARG_LIBRARIES})
  if(THRONG_SANITIZE AND ARG_SOURCES AND name IN_LIST THRONG_OPTIMIZED_MODULES)
    target_compile_options(throng_${target} PRIVATE -O1)
  endif()
  if(THRONG_FUZZ AND ARG_SOURCES AND name IN_LIST THRONG_FUZZED_MODULES)
    target_compile_options(throng_${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  throng_check_includes(${name} "${ARG_ROOMS}")
endfunction()

# throng_kernels(file...): files with loops for several instruction sets (base/instruction_set.h). Square roots do not
# report errors, so that they can be vectors; the vectors stay inside functions, so their calling convention is nobody's.
function(throng_kernels)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-fno-math-errno;-Wno-psabi" SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# The module that a path below the source folder belongs to, the innermost one: jobs/spec/plan.h is in jobs/spec. Empty
# for a path in no module.
function(throng_room_of path result)
  set(${result} "" PARENT_SCOPE)
  get_filename_component(folder "${path}" DIRECTORY)
  while(NOT folder STREQUAL "")
    if(folder IN_LIST THRONG_ROOMS)
      set(${result} "${folder}" PARENT_SCOPE)
      return()
    endif()
    get_filename_component(folder "${folder}" DIRECTORY)
  endwhile()
endfunction()

# Fails when a file of the module includes a module that it did not declare.
function(throng_check_includes name rooms)
  file(GLOB_RECURSE files RELATIVE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/${name}/*.h" "${PROJECT_SOURCE_DIR}/${name}/*.cpp")
  foreach(file IN LISTS files)
    throng_room_of("${file}" room)
    if(NOT room STREQUAL name)
      continue() # of a module in a folder of this one
    endif()
    file(STRINGS "${PROJECT_SOURCE_DIR}/${file}" includes REGEX "^#include \"[a-z_]+/")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" path "${line}")
      throng_room_of("${path}" used)
      if(NOT used STREQUAL "" AND NOT used STREQUAL name AND NOT used IN_LIST rooms)
        message(FATAL_ERROR "${PROJECT_SOURCE_DIR}/${file} includes room '${used}', which room '${name}' does not declare in its CMakeLists.txt")
      endif()
    endforeach()
  endforeach()
endfunction()

# throng_refuse_links(TARGET module...): stops the configuration when the target is linked with one of the modules, be it
# through others.
function(throng_refuse_links target)
  set(open "${target}")
  set(seen "")
  while(open)
    list(POP_FRONT open next)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" next "${next}")
    if(NOT TARGET "${next}")
      continue()
    endif()
    get_target_property(aliased "${next}" ALIASED_TARGET)
    if(aliased)
      set(next "${aliased}")
    endif()
    if(next IN_LIST seen)
      continue()
    endif()
    list(APPEND seen "${next}")
    foreach(module IN LISTS ARGN)
      string(REPLACE "/" "_" refused "throng_${module}")
      if(next STREQUAL refused)
        message(FATAL_ERROR "${target} is linked with module '${module}', which it is to do without")
      endif()
    endforeach()
    get_target_property(libraries "${next}" INTERFACE_LINK_LIBRARIES)
    if(libraries)
      list(APPEND open ${libraries})
    endif()
  endwhile()
endfunction()

# throng_embed(TARGET SYMBOL FILE): makes the file's text available as `extern const std::string_view throng::embedded::SYMBOL`.
function(throng_embed target symbol file)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/embedded_${symbol}.cpp")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(READ "${file}" text)
  # Raw string literals are limited to 64 KiB by the standard; split the text to stay below it.
  string(LENGTH "${text}" length)
  set(literal "")
  set(position 0)
  while(position LESS length)
    string(SUBSTRING "${text}" ${position} 8000 chunk)
    string(APPEND literal "R\"__throng__(${chunk})__throng__\"\n")
    math(EXPR position "${position} + 8000")
  endwhile()
  file(CONFIGURE OUTPUT "${output}" CONTENT "#include <string_view>\nnamespace throng::embedded {\nextern const std::string_view ${symbol};  // NOLINT\nconst std::string_view ${symbol} =  // NOLINT\n@literal@;\n}  // namespace throng::embedded\n" @ONLY)
  target_sources(${target} PRIVATE "${output}")
  # Apart in joined builds: clang-tidy has nothing to say of it.
  set_source_files_properties("${output}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# throng_test(NAME SOURCES file... LIBRARIES target... SHARDS n): one GoogleTest program per module, test_NAME. Its tests run
# in n processes (default 1), NAME.1 to NAME.n; `test_NAME --gtest_filter=...` runs a single one.
function(throng_test name)
  cmake_parse_arguments(ARG "" "SHARDS" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE throng_flags ${ARG_LIBRARIES} GTest::gtest_main GTest::gmock)
  target_include_directories(test_${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_compile_definitions(test_${name} PRIVATE THRONG_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # The tests' own code is compiled often and runs briefly.
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  add_dependencies(throng_tests test_${name})
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  foreach(shard RANGE 1 ${ARG_SHARDS})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${name}.${shard} COMMAND test_${name} --gtest_brief=1)
    set_tests_properties(${name}.${shard} PROPERTIES LABELS "${name}" TIMEOUT 900
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# throng_bench(NAME SOURCES file... LIBRARIES target...): one Google Benchmark program, bench_NAME.
function(throng_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(bench_${name} ${ARG_SOURCES})
  target_link_libraries(bench_${name} PRIVATE throng_flags ${ARG_LIBRARIES} benchmark::benchmark_main)
  target_compile_definitions(bench_${name} PRIVATE THRONG_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()
