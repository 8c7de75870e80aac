#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every check and test.
# usage: scripts/test.sh [STEP...]   steps: format release tidy asan tsan fuzz (default: all of these), long, includes
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$root"
mkdir -p build
steps=("$@")
[ ${#steps[@]} -gt 0 ] || steps=(format release tidy asan tsan fuzz)

sources() { git ls-files --cached --others --exclude-standard -- '*.cpp' '*.h'; }

step_format() {
  say "checking the format"
  sources | xargs clang-format --dry-run --Werror
  # Text becomes JSON in one place, which has limits. Tests read what the program wrote by the library itself.
  if sources | grep -v -e '^tests/' -e '^bench/' -e '^base/json_text\.cpp$' | xargs grep -nE 'json::(parse|accept|sax_parse|from_)|>> *(json|document)\b'; then
    echo "base/json_text.h parses JSON; nothing else may" >&2
    return 1
  fi
  bash -n scripts/*.sh .ci/run
  /usr/bin/python3 scripts/check_language.py
  /usr/bin/python3 python/generate_types.py --check
  mypy --strict --cache-dir build/mypy python/throng python/generate_types.py
}

# Each test program of a module runs once: those that compute with this build, the others with the sanitizers' (cmake/
# Modules.cmake, throng_test). Tests of the program run here, the shorter ones there as well. Of the benchmarks only the
# syntax is checked.
step_release() {
  say "building (release)"
  build release throng_computing_tests
  jq -r '.[] | select(.file | contains("/bench/")) | .directory, .command' build/release/compile_commands.json |
    sed -E 's/ -o [^ ]+ / -fsyntax-only /' | xargs -d '\n' -P "$(nproc)" -n 2 bash -c 'cd "$0" && eval "$1"'
  bake_people 24  # enough for tests, in a quarter of the time
  say "testing (release)"
  # The tests of the program wait much.
  ctest --preset release -j3 -LE '^sanitized$'
}

# Not among the default steps: every test program of a module with both builds, and tests of which the default steps take
# a sample (all damages to datasets, all kinds of sound datasets, more people and time in all scenarios, more crashes).
step_long() {
  say "testing what lasts"
  build release throng_tests
  bake_people 24  # enough for tests, in a quarter of the time
  ctest --preset release -j2 -L '^sanitized$'
  THRONG_LONG=1 THRONG_CRASHES=10 ctest --preset release -j2 -R '^cli\.(validate_damages|sound_datasets|shipped|crash|damaged_traces)$'
  build asan throng_tests
  ctest_asan -L '^computing$'
}

# Joins the sources into a few files, so that headers, which take most of clang-tidy's time, are read a few times instead
# of 700. Names that shadow each other are left to the compiler, since joined files do so without harm. An unchanged tree
# is not checked twice.
step_tidy() {
  say "clang-tidy"
  local state stamp=build/tidy.stamp
  state="$(sources | xargs cat .clang-tidy | sha256sum)"
  [ "$(cat "$stamp" 2>/dev/null)" = "$state" ] && return
  cmake -S . --preset asan >build/configure-asan.log
  python3 scripts/join_sources.py 4 build/asan build/tidy |
    xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --extra-arg=-Wno-everything 2>build/tidy.err || return 1
  echo "$state" >"$stamp"
}

ctest_asan() {
  LSAN_OPTIONS="suppressions=$root/tests/lsan.supp:print_suppressions=0" ctest --preset asan -j3 "$@"
}

step_asan() {
  say "building and testing (AddressSanitizer, UndefinedBehaviorSanitizer)"
  build asan throng_sanitized_tests throng_fuzz
  ctest_asan -LE '^(slow|computing)$'
}

step_tsan() {
  say "building and testing (ThreadSanitizer): the concurrent parts"
  build tsan test_base test_crowd test_jobs_queue test_server
  export TSAN_OPTIONS="suppressions=$root/tests/tsan.supp"
  ctest --preset tsan -j2 -L '^(base|jobs_queue|server)$'
  # Of the crowd's tests those that compare numbers of threads.
  (cd build/tsan/tests/crowd && ./test_crowd --gtest_brief=1 --gtest_filter='Determinism.*:Threads.*')
}

# A quarter of a minute of new inputs each on top of the corpus, with the sanitizers' build. Findings stay in build/fuzz; make them
# files of tests/fuzz/corpus once they are fixed. The time limit is generous, since both cores are busy.
step_fuzz() {
  say "fuzzing the files' readers (AddressSanitizer, UndefinedBehaviorSanitizer)"
  build asan throng_fuzz
  printf '%s\n' crowd files imports bundle json head job | xargs -P "$(nproc)" -I TARGET bash -c '
    mkdir -p build/fuzz/corpus/TARGET
    build/asan/tests/fuzz/fuzz_TARGET -max_total_time=15 -timeout=60 -rss_limit_mb=3000 -max_len=8000 \
      -dict=tests/fuzz/crowd.dict -artifact_prefix=build/fuzz/TARGET- -print_final_stats=1 -verbosity=0 \
      build/fuzz/corpus/TARGET tests/fuzz/corpus/TARGET >build/fuzz/TARGET.log 2>&1 ||
      { grep -v "# Uses" build/fuzz/TARGET.log | tail -60; echo "fuzz_TARGET failed: build/fuzz/TARGET-*"; exit 1; }
    echo "fuzz_TARGET: $(grep number_of_executed_units build/fuzz/TARGET.log | tr -dc 0-9) inputs"'
}

# Not among the default steps: it parses every file by itself, which takes longer than the joined builds together.
step_includes() {
  say "parsing every file by itself"
  cmake -S . --preset asan >build/configure-asan.log
  python3 scripts/check_includes.py build/asan
}

install_packages
fetch_assets
times=()
for step in "${steps[@]}"; do
  start=$SECONDS
  "step_$step"
  times+=("$(printf '%-8s %5d s' "$step" $((SECONDS - start)))")
  say "${times[-1]}"
done
say "all checks passed"
printf '%s\n' "${times[@]}" "$(printf '%-8s %5d s' total $SECONDS)"
