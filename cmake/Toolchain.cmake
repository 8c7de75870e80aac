# Language level, warnings, sanitizers: everything that every target shares.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(THRONG_BENCHMARKS "Build the programs in bench/" OFF)
option(THRONG_FUZZ "Build the programs in tests/fuzz/ (clang only, preset asan)" OFF)
set(THRONG_SANITIZE "" CACHE STRING "Sanitizers to build with: empty, address,undefined or thread")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Paths below the source folder become relative to the build folder: what one checkout compiled holds for all others.
  set(CMAKE_CXX_COMPILER_LAUNCHER /usr/bin/env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${CCACHE_PROGRAM}")
endif()

# The engine is also a module of Python (python/engine), a shared library. Without interposition its functions call each
# other as directly as in a program.
if(NOT THRONG_SANITIZE)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()

add_library(throng_flags INTERFACE)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Its garbage collector takes a tenth of the time when it starts at once.
  target_compile_options(throng_flags INTERFACE -fno-semantic-interposition
    "SHELL:--param ggc-min-heapsize=1000000" "SHELL:--param ggc-min-expand=1000")
endif()
# No contraction into fused multiply-adds: the same source gives the same bits at any -march.
target_compile_options(throng_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wsuggest-override -Werror -ffp-contract=off)
if(THRONG_SANITIZE)
  # Left out: what AddressSanitizer finds as well (null, object-size, pointer-overflow, alignment traps) or we do not
  # have (vptr). They instrument every access and double the build's time.
  target_compile_options(throng_flags INTERFACE -fsanitize=${THRONG_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -fno-sanitize=null,object-size,pointer-overflow,alignment,vptr)
  target_link_options(throng_flags INTERFACE -fsanitize=${THRONG_SANITIZE} -fuse-ld=lld)
  # Macros of our own: by __SANITIZE_ADDRESS__ Eigen allocates in another way than Debian's libceres.a, whose copies of
  # Eigen's functions the linker may choose.
  if(THRONG_SANITIZE MATCHES address)
    target_compile_definitions(throng_flags INTERFACE THRONG_SANITIZE_ADDRESS=1)
  elseif(THRONG_SANITIZE MATCHES thread)
    target_compile_definitions(throng_flags INTERFACE THRONG_SANITIZE_THREAD=1)
  endif()
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # The sanitizers' builds: g++ decides on warnings.
  target_compile_options(throng_flags INTERFACE -w)
elseif(THRONG_JOIN_SOURCES)
  # Several files compiled as one: g++ then takes a file's own namespace for a header's, and its flow warnings see
  # strings overlap themselves and function objects without value.
  target_compile_options(throng_flags INTERFACE -Wno-subobject-linkage -Wno-restrict -Wno-maybe-uninitialized)
endif()

# Programs find their libraries where the system has them, as installed ones do. The paths that CMake writes into programs
# of the build folder end with a colon, which means the working folder: that of a worker is its job's, so each looked for
# libraries there first, 500 names on a cluster's shared file system, and would have loaded them.
set(CMAKE_SKIP_BUILD_RPATH ON)
