# Implementation of sh tests/run.sh --sanitize; sourced by it with $top set to the checkout. Ends the shell.
#
# Each part runs regardless of earlier findings; the exit status is 0 if there are none.
# shellcheck shell=sh disable=SC2154,SC2034

failures=
# part NAME COMMAND...
part() {
  say "$1"
  shift
  "$@" || failures="$failures
  $*"
}

# Tests of a build by their names
tests_of() { ctest --test-dir "$top/build/$1" -N -LE '^long$' | sed -n 's/^ *Test *#[0-9]*: //p' | sort; }

# Reason why a test does not run under the sanitizers; empty for one that runs
reason_of() {
  case $1 in
    memcheck_*) echo "is run by valgrind" ;;
    capi_host_* | faults_* | confine_without_openat2) echo "limits memory or replaces system calls, as the sanitizers do" ;;
    capi_statics | capi_consumer | manual_first_call) echo "examines the installed library, which is not instrumented" ;;
    capi_memory | capi_many_rounds) echo "measures memory; the sanitizers keep freed memory" ;;
    performance*) echo "measures times and memory requests" ;;
    octave_*) echo "Octave is not instrumented and cannot load the library; its scripts read files that other tests also write" ;;
    report_browser | report_start | report_viewer) echo "tests the page in the browser" ;;
    study_*) echo "loads the library into Python workers that are not instrumented" ;;
    capi_wheel | capi_types) echo "tests the package of Python, not the library" ;;
  esac
}

export ASAN_OPTIONS=allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS="suppressions=$top/tests/support/leaks.supp:print_suppressions=0"
# longer time limits for test programs
export CONTACT_SLOWER=20
elsewhere='^(performance.*|octave_.*|report_browser|report_start|report_viewer|no_exports)$'

build sanitize -DCONTACT_TESTS=ON
part "Address and undefined-behaviour sanitizers, leaks" \
  ctest --test-dir "$top/build/sanitize" --output-on-failure -j2 -LE '^long$' -E "$elsewhere"
# leaks cannot be detected in a traced process
part "The same for a traced program" \
  env ASAN_OPTIONS=detect_leaks=0 ctest --test-dir "$top/build/sanitize" --output-on-failure -R '^no_exports$'

build sanitize-thread -DCONTACT_TESTS=ON
# libgfortran locks units in both orders, with a trylock that the sanitizer does not recognise; it requires fixed addresses
part "Thread sanitizer" env TSAN_OPTIONS=detect_deadlocks=0 OMP_NUM_THREADS=8 \
  setarch -R ctest --test-dir "$top/build/sanitize-thread" --output-on-failure -L '^threads$'

# only tests run by valgrind; the others are listed
build_targets=memcheck
build release -DCONTACT_TESTS=ON
part "Valgrind" ctest --test-dir "$top/build/release" --output-on-failure -j2 -L '^memcheck$'

say "Not run under the sanitizers"
tests_of release >"$top/build/tests_of_release"
tests_of sanitize | grep -vE "$elsewhere" >"$top/build/tests_of_sanitize"
echo no_exports >>"$top/build/tests_of_sanitize"
for name in $(sort "$top/build/tests_of_sanitize" | comm -23 "$top/build/tests_of_release" -); do
  reason=$(reason_of "$name")
  [ -n "$reason" ] || failures="$failures
  $name: no reason is known why it does not run under the sanitizers"
  printf '  %-40s %s\n' "$name" "$reason"
done

[ -z "$failures" ] || fail "Findings in:$failures"
say "Nothing was found"
exit 0
