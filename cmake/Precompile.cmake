# Precompiled headers for the sanitizers' builds (clang): parsing the most used libraries takes 8 to 27 % of their time (four units measured). They
# do not go together with ccache, whose entries would hold for one build folder only, nor with g++'s warnings, which then
# see faults in the standard library's headers.
set(THRONG_PRECOMPILED_HEADERS
  <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <limits> <map> <memory> <mutex> <numbers>
  <numeric> <optional> <set> <span> <sstream> <string> <string_view> <thread> <utility> <variant> <vector>
  <Eigen/Core> <Eigen/Geometry> <fmt/core.h> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp>)
set(THRONG_PRECOMPILED_TEST_HEADERS ${THRONG_PRECOMPILED_HEADERS} <gtest/gtest.h> <gmock/gmock.h>)

# throng_precompile(TARGET HEADERS option...): TARGET, which is compiled with these options, uses the headers of the list
# HEADERS, precompiled once for all targets with the same options. Files with further options, and headers that change
# meaning by macros, set SKIP_PRECOMPILE_HEADERS.
function(throng_precompile target headers)
  if(NOT THRONG_PRECOMPILE)
    return()
  endif()
  string(MAKE_C_IDENTIFIER "throng_precompiled_${headers}_${ARGN}" name)
  if(NOT TARGET ${name})
    set(source "${PROJECT_BINARY_DIR}/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "")
    add_library(${name} OBJECT "${source}")
    target_link_libraries(${name} PRIVATE throng_flags Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
    if(headers MATCHES TEST)
      target_link_libraries(${name} PRIVATE GTest::gtest_main GTest::gmock)
    endif()
    target_compile_options(${name} PRIVATE ${ARGN})
    target_precompile_headers(${name} PRIVATE ${${headers}})
  endif()
  # Macros must be the same.
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()
