# One library per module. A module declares its public headers, and the modules and libraries it may use; an #include of
# any other module, or of a private header of one, stops the configuration (scripts/module_rules.py). A module may lie in
# a folder of another ("jobs/queue"): its library is throng_jobs_queue. Other folders in a module are part of it.
include("${CMAKE_CURRENT_LIST_DIR}/ModuleRules.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/JoinSources.cmake")

# How much the optimizer does in releases, by what a minute of it gives: these compute (-O2); these read, write and serve (-Og, half
# of the time that -O2 takes to compile); all others have -O1. Loops of a kernel (throng_kernels) have -O3. With sanitizers those that
# compute have -O1.
set(THRONG_OPTIMIZED_MODULES base crowd camera sim skinning render annotate)
set(THRONG_SERVING_MODULES spec jobs/queue jobs/bucket live/foxglove live/loop live/flight jobs/study server cli/common cli/import cli cli/more)
# These are optimized with sanitizers too: their tests look at every pixel.
set(THRONG_PIXEL_MODULES annotate formats checks)
# The modules that the fuzz targets (tests/fuzz) cover.
set(THRONG_FUZZED_MODULES base crowd/description world crowd places/imports spec metrics)

# throng_module(NAME PUBLIC header... SOURCES file... MODULES module... LIBRARIES target... PRIVATE_LIBRARIES target...
#   REFUSES module...)
# PUBLIC lists the headers that other modules, their tests, benchmarks and examples may include; REFUSES the modules that it
# is not linked with, be it through others.
function(throng_module name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;SOURCES;MODULES;LIBRARIES;PRIVATE_LIBRARIES;REFUSES" ${ARGN})
  if(NOT name IN_LIST THRONG_ALL_MODULES)
    message(FATAL_ERROR "module '${name}' is not in THRONG_ALL_MODULES (CMakeLists.txt)")
  endif()
  set_property(GLOBAL APPEND PROPERTY THRONG_DECLARED_MODULES "${name}")
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
  set(module_targets "${ARG_MODULES}")
  list(TRANSFORM module_targets REPLACE "/" "_")
  list(TRANSFORM module_targets PREPEND "throng::")
  target_include_directories(throng_${target} ${links}
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:include/throng>")
  target_link_libraries(throng_${target} ${links} ${module_targets} ${ARG_LIBRARIES})
  if(ARG_SOURCES)
    set(options "")
    if(THRONG_SANITIZE AND (name IN_LIST THRONG_OPTIMIZED_MODULES OR name IN_LIST THRONG_PIXEL_MODULES))
      list(APPEND options -O1)
    elseif(CMAKE_BUILD_TYPE STREQUAL "Release" AND name IN_LIST THRONG_OPTIMIZED_MODULES)
      list(APPEND options -O2)
    elseif(CMAKE_BUILD_TYPE STREQUAL "Release" AND name IN_LIST THRONG_SERVING_MODULES)
      list(APPEND options -Og)
    elseif(CMAKE_BUILD_TYPE STREQUAL "Release")
      list(APPEND options -O1)
    endif()
    if(THRONG_FUZZ AND name IN_LIST THRONG_FUZZED_MODULES)
      list(APPEND options -fsanitize=fuzzer-no-link)
    endif()
    target_compile_options(throng_${target} PRIVATE ${options})
    throng_join_sources(throng_${target} "${THRONG_JOINED_SOURCES}")
  endif()
endfunction()

# throng_kernels(file...): files with loops for several instruction sets (base/compute/instruction_set.h). Square roots do not
# report errors, so that they can be vectors; the vectors stay inside functions, so their calling convention is nobody's.
function(throng_kernels)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-fno-math-errno;-Wno-psabi"
    SKIP_UNITY_BUILD_INCLUSION ON)
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

# throng_bench(NAME SOURCES file... LIBRARIES target...): one Google Benchmark program, bench_NAME.
function(throng_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(bench_${name} ${ARG_SOURCES})
  target_link_libraries(bench_${name} PRIVATE throng_flags ${ARG_LIBRARIES} benchmark::benchmark_main)
endfunction()
