#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every check and test.
# usage: scripts/test.sh [STEP...]   steps: format release tidy asan tsan fuzz   (default: all of them)
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

step_release() {
  say "building (release)"
  build release
  bake_people
  say "testing (release)"
  ctest --preset release -j2
}

# Reads the sanitizer build's compilation units: they join several files, so that the headers, which take most of
# clang-tidy's time, are read once for all of them. Names that shadow each other are left to the compiler, since joined
# files do so without harm. An unchanged tree is not checked twice.
step_tidy() {
  say "clang-tidy"
  local state stamp=build/tidy.stamp
  state="$(sources | xargs cat .clang-tidy | sha256sum)"
  [ "$(cat "$stamp" 2>/dev/null)" = "$state" ] && return
  cmake -S . --preset asan >build/configure-asan.log
  jq -r '.[].file' build/asan/compile_commands.json | grep -v -e /tests/ -e /embedded_ |
    xargs -P "$(nproc)" -n 1 clang-tidy -p build/asan --quiet --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-shadow 2>build/tidy.err ||
    return 1
  echo "$state" >"$stamp"
}

step_asan() {
  say "building and testing (AddressSanitizer, UndefinedBehaviorSanitizer)"
  build asan
  # GCC 12's leak checker guesses where threads' dynamic variables lie, and now and then reads from
  # nowhere after a library with threads was loaded. It has to do without.
  ASAN_OPTIONS=intercept_tls_get_addr=0 \
    LSAN_OPTIONS="suppressions=$root/tests/lsan.supp:print_suppressions=0" \
    ctest --preset asan -j2 -LE slow
}

step_tsan() {
  say "building and testing (ThreadSanitizer): the concurrent parts"
  build tsan test_base test_crowd test_jobs_queue test_server
  TSAN_OPTIONS="suppressions=$root/tests/tsan.supp" ctest --preset tsan -j2 -L '^(base|crowd|jobs_queue|server)$'
}

# Half a minute of new inputs each on top of the corpus. Findings stay in build/fuzz; make them files of
# tests/fuzz/corpus once they are fixed.
step_fuzz() {
  say "fuzzing the files' readers (AddressSanitizer, UndefinedBehaviorSanitizer)"
  build fuzz
  printf '%s\n' crowd files imports bundle json head | xargs -P "$(nproc)" -I TARGET bash -c '
    set -e
    mkdir -p build/fuzz/corpus/TARGET
    build/fuzz/tests/fuzz/fuzz_TARGET -max_total_time=30 -timeout=20 -rss_limit_mb=3000 -max_len=8000 \
      -dict=tests/fuzz/crowd.dict -artifact_prefix=build/fuzz/TARGET- -print_final_stats=1 -verbosity=0 \
      build/fuzz/corpus/TARGET tests/fuzz/corpus/TARGET'
}

install_packages
fetch_assets
for step in "${steps[@]}"; do
  start=$SECONDS
  "step_$step"
  echo "-- $step: $((SECONDS - start)) s"
done
say "all checks passed: ${steps[*]}"
