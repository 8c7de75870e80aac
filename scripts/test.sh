#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every check and test. Every step runs, whatever failed before; a table
# at the end names each step with its times, each failed test and the slowest ones.
# usage: scripts/test.sh [STEP...]   steps: format release tidy asan tsan fuzz image (default: all of these), long, soak, includes
# With $THRONG_LIMIT_MIN, the minutes after which it will be cut off, the step image is left out when too few are left.
set -euo pipefail
# shellcheck source=scripts/lib.sh
. "$(dirname "$0")/lib.sh"
cd "$root"
steps=("$@")
[ ${#steps[@]} -gt 0 ] || steps=(format release tidy asan tsan fuzz image)
for step in "${steps[@]}"; do
  case "$step" in
    format | release | tidy | asan | tsan | fuzz | image | long | soak | includes) ;;
    *) echo "unknown step $step; steps: format release tidy asan tsan fuzz image long soak includes" >&2; exit 2 ;;
  esac
done
mkdir -p build/tmp

# Temporary files of tests lie in memory, where a synced write takes 0.02 ms instead of 8: what a test waits for does not
# depend on the disk. The file system is mounted in a name space of its own, so that nothing stays mounted.
if [ "$(stat -f -c %T build/tmp)" != tmpfs ] && [ "$(id -u)" = 0 ] &&
  unshare --mount mount -t tmpfs tmpfs build/tmp 2>/dev/null; then
  export TMPDIR="$root/build/tmp" TEST_TMPDIR="$root/build/tmp/"
  exec unshare --mount bash -c 'mount -t tmpfs -o size=8g,mode=1777 tmpfs "$TMPDIR" && exec bash "$@"' bash "$0" "${steps[@]}"
fi
# Tests of what scripts/packages.txt lists fail where it is missing, instead of being skipped.
export CI=true

# Stamps of trees that passed tidy, and of the last success of the step long, for all checkouts of this user.
stamps="${XDG_CACHE_HOME:-$HOME/.cache}/throng"
mkdir -p "$stamps/tidy"

sources() { git ls-files --cached --others --exclude-standard -- '*.cpp' '*.h'; }

# run_parts FUNCTION...: runs each, whatever failed before. Fails if one did; their names go to build/checks/failed_parts.
run_parts() {
  local part status failed=0
  for part in "$@"; do
    set +e
    (set -e; "$part")
    status=$?
    set -e
    if [ $status != 0 ]; then
      failed=1
      echo "== failed: $part"
      printf '%s ' "$part" >>build/checks/failed_parts
    fi
  done
  return $failed
}

step_format() {
  say "checking the format, the language and the types"
  run_parts tree cpp_format json_readers limits python_format shell language python_types
}
tree() { /usr/bin/python3 scripts/check_tree.py; }
cpp_format() { sources | xargs clang-format --dry-run --Werror; }
# Text becomes JSON in one place, which has limits. Tests read what the program wrote by the library itself.
json_readers() {
  if sources | grep -v -e '^tests/' -e '^bench/' -e '^base/json/json_text\.cpp$' | xargs grep -nE 'json::(parse|accept|sax_parse|from_)|>> *(json|document)\b'; then
    echo "base/json/json_text.h parses JSON; nothing else may" >&2
    return 1
  fi
}
# Files that generate_types.py writes have its format.
python_format() {
  black --check --quiet -l 120 --extend-exclude '/python/throng/(job|api_types)\.py$' python tests bench scripts examples ||
    { echo "Python files are not formatted: run black -l 120 on them" >&2; return 1; }
}
limits() { /usr/bin/python3 scripts/check_limits.py; }
shell() { git ls-files --cached --others --exclude-standard -- '*.sh' .ci/run | xargs shellcheck; }
language() { /usr/bin/python3 scripts/check_language.py; }
python_types() { mypy --strict --cache-dir "$stamps/mypy" python/throng python/generate_types.py; }

# Each test program of a module runs once: those that compute with this build, the others with the sanitizers' (cmake/
# Tests.cmake). Tests of the program run here, the shorter ones there as well. The benchmarks are compiled only.
step_release() {
  say "building and testing (release)"
  run_parts release_build
  run_parts benchmarks release_tests
}
release_build() { build release throng_computing_tests; }
# Without optimization, and by ccache, which does not know -fsyntax-only.
benchmarks() {
  mkdir -p build/benchmarks
  jq -r '.[] | select(.file | test("/(bench|scripts)/")) | .directory, .command' build/release/compile_commands.json |
    sed -E "s# -o [^ ]*/([^ /]+) # -O0 -o $root/build/benchmarks/\1 #" | xargs -d '\n' -P "$(nproc)" -n 2 bash -c 'cd "$0" && eval "$1"'
}
release_tests() { run_ctest release release --repeat-waits -j4 -LE '^sanitized$'; }
run_ctest() { /usr/bin/python3 scripts/run_ctest.py "$@"; }

# Not among the default steps: every test program of a module with both builds, and tests of which the default steps take
# a sample (label samples: all damages to datasets, all kinds of sound datasets, all scenarios with more people and time,
# more crashes, all recipes, the notebooks).
step_long() {
  say "testing what lasts"
  run_parts long_sanitized_with_release long_samples long_with_asan long_fuzz long_image
  touch "$stamps/long"
}
long_sanitized_with_release() {
  build release throng_tests
  run_ctest long-release release -j2 -L '^sanitized$'
}
long_samples() {
  build release throng_computing_tests
  THRONG_LONG=1 THRONG_CRASHES=10 run_ctest long-samples release -j2 -L '^samples$'
}
long_with_asan() {
  build asan throng_tests
  asan_ctest long-asan -j3 -L '^(computing|asan_in_long)$'
}
long_fuzz() { step_fuzz 60; }
long_image() { rm -rf "$stamps/image" && step_image; }

# Not among the default steps: tests that wait, ten times each (or $THRONG_SOAK times), beside two busy loops. None may fail.
step_soak() {
  say "tests that wait, beside two busy loops"
  build release throng_computing_tests
  build asan throng_sanitized_tests
  local loops=()
  for _ in 1 2; do
    (while :; do :; done) &
    loops+=($!)
  done
  trap 'kill "${loops[@]}"' EXIT
  run_parts soak_release soak_asan
}
soak_release() { run_ctest soak-release release -j4 -L '^waits$' -LE '^sanitized$' --repeat "until-fail:${THRONG_SOAK:-10}"; }
soak_asan() {
  THRONG_TEST_PROGRAM="$root/build/release/cli/throng" asan_ctest soak-asan -j4 -L '^waits$' -LE '^slow$' \
    --repeat "until-fail:${THRONG_SOAK:-10}"
}

# Joins the sources into a few files, so that headers, which take most of clang-tidy's time, are read a few times instead
# of 700. Names that shadow each other are left to the compiler, since joined files do so without harm. A tree that passed once
# is not checked again, in any checkout of this user, by the same bytes, list of modules and version of clang-tidy.
step_tidy() {
  say "clang-tidy"
  cmake -S . --preset asan >build/configure-asan.log
  local state modules
  modules="$(cut -d/ -f1 build/asan/modules.txt | sort -u | paste -sd'|')"
  state="$({ sources | grep -vE '^(tests|bench|examples|scripts)/' | sort | xargs sha256sum; sha256sum .clang-tidy scripts/join_sources.py; echo "$modules"; clang-tidy --version; } | sha256sum | cut -d' ' -f1)"
  if [ -e "$stamps/tidy/$state" ]; then
    echo "passed before, on $(date -r "$stamps/tidy/$state" '+%F %R')"
    return
  fi
  python3 scripts/join_sources.py 4 build/asan build/tidy |
    xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --header-filter="^$root/($modules)/" --extra-arg=-Wno-everything \
      2>build/tidy.err || return 1
  touch "$stamps/tidy/$state"
}

# asan_ctest STEP CTEST_ARGUMENT...: the server's tests start $THRONG_TEST_PROGRAM.
asan_ctest() {
  LSAN_OPTIONS="suppressions=$root/tests/lsan.supp:print_suppressions=0" run_ctest "$1" asan "${@:2}"
}

# Libraries and the server, whose children are the release build's program. The step long has the program with sanitizers.
step_asan() {
  say "building and testing (AddressSanitizer, UndefinedBehaviorSanitizer)"
  build release throng_programs
  build asan throng_sanitized_tests throng_fuzz
  THRONG_TEST_PROGRAM="$root/build/release/cli/throng" asan_ctest asan --repeat-waits -j3 -L '^sanitized$'
}

# The crowd's tests are those that compare numbers of threads. Live flights have their threads in live/loop: the rest of
# live/flight, and live/engine, which begins none, link the simulation and the renderer, which take minutes to compile. None of
# these is ever repeated.
step_tsan() {
  say "building and testing (ThreadSanitizer): the concurrent parts"
  local tests=(base bucket crowd_determinism live_foxglove live_loop jobs_queue server)
  build tsan "${tests[@]/#/test_}"
  TSAN_OPTIONS="suppressions=$root/tests/tsan.supp" run_ctest tsan tsan -j2 -L "^($(IFS='|' && echo "${tests[*]}"))\$"
}

# Some seconds of new inputs each on top of the corpus (a minute in the step long), with the sanitizers' build. Findings stay in build/fuzz; make them
# files of tests/fuzz/corpus once they are fixed. The time limit is generous, since both cores are busy.
step_fuzz() {
  say "fuzzing the files' readers (AddressSanitizer, UndefinedBehaviorSanitizer)"
  build asan throng_fuzz
  printf '%s\n' crowd files imports bundle json head job cameras datasets | xargs -P "$(nproc)" -I TARGET env SECONDS_EACH="${1:-10}" bash -c '
    mkdir -p build/fuzz/corpus/TARGET
    build/asan/tests/fuzz/fuzz_TARGET -max_total_time=$SECONDS_EACH -timeout=60 -rss_limit_mb=3000 -max_len=8000 \
      -dict=tests/fuzz/crowd.dict -artifact_prefix=build/fuzz/TARGET- -print_final_stats=1 -verbosity=0 \
      build/fuzz/corpus/TARGET tests/fuzz/corpus/TARGET >build/fuzz/TARGET.log 2>&1 ||
      { grep -v "# Uses" build/fuzz/TARGET.log | tail -60; echo "fuzz_TARGET failed: build/fuzz/TARGET-*"; exit 1; }
    echo "fuzz_TARGET: $(grep number_of_executed_units build/fuzz/TARGET.log | tr -dc 0-9) inputs"'
}
# The container's image, built and used. It takes a quarter of an hour, so it is built again only when the files that say how have changed.
step_image() {
  say "building and using the container's image"
  local state
  state="$(git ls-files -z -- docker tests/docker scripts/packages.txt scripts/lib.sh scripts/setup.sh cmake CMakeLists.txt '*/CMakeLists.txt' |
    grep -zv '^tests/[^d]' | xargs -0 sha256sum | sha256sum | cut -d' ' -f1)"
  if [ -e "$stamps/image/$state" ]; then
    echo "passed before, on $(date -r "$stamps/image/$state" '+%F %R')"
    return
  fi
  if ! command -v buildah >/dev/null || [ "$(id -u)" != 0 ]; then
    echo "NOT RUN: it needs root and buildah"
    touch build/checks/not_run
    return
  fi
  # A run that is cut off at its limit tells nothing of the steps before, either.
  local left_min=$((${THRONG_LIMIT_MIN:-1000} - SECONDS / 60))
  if [ "$left_min" -lt 35 ]; then
    echo "NOT RUN: it can take more than half an hour, and $left_min minutes are left of $THRONG_LIMIT_MIN; run scripts/test.sh image"
    touch build/checks/not_run
    return
  fi
  /usr/bin/python3 tests/docker/test_image.py "$root/build/image" || return 1
  /usr/bin/python3 tests/docker/test_compose.py "$root/build/image" || return 1
  mkdir -p "$stamps/image"
  touch "$stamps/image/$state"
}

# Not among the default steps: it parses every file by itself, which takes longer than the joined builds together.
step_includes() {
  say "parsing every file by itself"
  cmake -S . --preset asan >build/configure-asan.log
  python3 scripts/check_includes.py build/asan
}

install_packages checks
fetch_assets
export keep_going=1  # build() of lib.sh
rm -rf build/checks
mkdir -p build/checks

# note_cpu_time: sets cpu_s to the processor seconds of all children of this shell that have ended.
note_cpu_time() {
  times >build/checks/times
  cpu_s="$(awk 'END { for (i = 1; i <= 2; ++i) { split($i, t, /[ms]/); sum += 60 * t[1] + t[2] } print int(sum) }' build/checks/times)"
}

for step in "${steps[@]}"; do
  wall_start=$SECONDS
  note_cpu_time
  cpu_start=$cpu_s
  rm -f build/checks/failed_parts build/checks/not_run
  set +e
  (set -e; "step_$step")
  status=$?
  set -e
  note_cpu_time
  printf '{"step": "%s", "wall_s": %d, "cpu_s": %d, "status": %d, "was_run": %s, "failed_parts": "%s"}\n' "$step" $((SECONDS - wall_start)) \
    $((cpu_s - cpu_start)) "$status" "$([ -e build/checks/not_run ] && echo false || echo true)" "$(sort -u build/checks/failed_parts 2>/dev/null | tr '\n' ' ' | sed 's/ *$//')" >>build/checks/steps.jsonl
  verdict=passed
  if [ -e build/checks/not_run ]; then verdict="NOT RUN,"; fi
  if [ $status != 0 ]; then verdict=FAILED; fi
  say "$step: $verdict after $((SECONDS - wall_start)) s"
done
if [ -e "$stamps/long" ]; then
  echo "the step long passed last on $(date -r "$stamps/long" '+%F %R')"
else
  echo "the step long has not passed here yet"
fi
/usr/bin/python3 scripts/report_checks.py build/checks
