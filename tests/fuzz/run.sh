#!/bin/sh
# Coverage-guided fuzzing: sh tests/fuzz/run.sh [--minutes N] [--target NAME]... [--sanitize] [--minimise]
#
#   --minutes N   total time of all targets; default: 60
#   --target      one of check run readable profile coefficients calls batch resume; default: all
#   --sanitize    with the sanitizers (preset fuzz), at a tenth of the speed; otherwise with bounds checks (preset fuzz-fast)
#   --minimise    no fuzzing; keep the smallest set of texts with the same coverage
#
# Can be stopped and restarted at any time: texts with new coverage are kept in build/fuzzing/NAME, findings
# in build/fuzzing/found (slow-...: texts that take more than 2 s of processor time), and statistics of all runs
# in build/fuzzing/statistics. The exit status is 1 if there are findings. Repeat a text by build/fuzz/tests/fuzz_NAME FILE, with
# CONTACT_SOURCE set to the top of the sources.
set -u
top=$(cd "$(dirname "$0")/../.." && pwd) || exit 1
. "$top/tests/support/setup.sh"

minutes=60
targets=
preset=fuzz-fast
minimise=
while [ $# -gt 0 ]; do
  case $1 in
    --minutes) minutes=${2:-}; shift ;;
    --target) targets="$targets ${2:-}"; shift ;;
    --sanitize) preset=fuzz ;;
    --minimise) minimise=yes ;;
    *) fail "usage: sh tests/fuzz/run.sh [--minutes N] [--target NAME]... [--sanitize] [--minimise]" ;;
  esac
  shift
done
[ -n "$targets" ] || targets="check run readable profile coefficients calls batch resume"
case $minutes in '' | *[!0-9]*) fail "--minutes must be a whole number" ;; esac

install_missing
install_fuzzer
build "$preset"
work=$top/build/fuzzing
mkdir -p "$work/found" "$work/place"
export CONTACT_SOURCE="$top" OMP_NUM_THREADS=1 CONTACT_FUZZ_PLACE CONTACT_FUZZ_FOUND="$work/found"
export ASAN_OPTIONS=allocator_may_return_null=1:handle_abort=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS="suppressions=$top/tests/support/leaks.supp:print_suppressions=0"
CONTACT_FUZZ_PLACE=$(mktemp -d /dev/shm/contact-fuzz-XXXXXX 2>/dev/null || mktemp -d)
trap 'rm -rf "$CONTACT_FUZZ_PLACE"' EXIT
trap 'exit 130' INT TERM

# Words of the dictionary, and names of routines
cp "$top/tests/fuzz/words.dict" "$work/words.dict"
sed -n 's/^\(\(cntc\|subs\)_[a-z0-9_]*\)(.*/"\1"/p' "$top/src/capi/interface.txt" >>"$work/words.dict"

# Number of slow texts of a target
slow_of() { find "$work/found" -name "slow-$1-*" | wc -l; }

# Number of files in a folder
files_of() { find "$1" -type f | wc -l; }

# A figure of the last run, by its name
figure() { sed -n "s/^stat::$1: *//p" "$work/log" | tail -n 1; }

found=0
# shellcheck disable=SC2086
count=$(echo $targets | wc -w)
for name in $targets; do
  program=$top/build/$preset/tests/fuzz_$name
  texts=$work/$name
  mkdir -p "$texts"
  if [ -n "$minimise" ]; then
    rm -rf "$texts.new"
    mkdir "$texts.new"
    "$program" -merge=1 -timeout=120 "$texts.new" "$top/tests/fuzz/corpus/$name" "$texts" >"$work/log" 2>&1 ||
      fail "$name cannot be minimised; see $work/log"
    say "$name: $(files_of "$texts") texts, $(files_of "$texts.new") take the same branches"
    rm -rf "$texts"
    mv "$texts.new" "$texts"
    continue
  fi
  seconds=$((minutes * 60 / count))
  begin=$(date +%s)
  new=0
  slow=$(slow_of "$name")
  executions=0
  while left=$((seconds - $(date +%s) + begin)) && [ $left -gt 0 ] && [ $new -lt 20 ]; do
    "$program" -entropic=0 -max_total_time=$left -timeout=120 -rss_limit_mb=4000 -max_len=4096 -dict="$work/words.dict" \
      -print_final_stats=1 -artifact_prefix="$work/found/$name-" "$texts" "$top/tests/fuzz/corpus/$name" >"$work/log" 2>&1
    status=$?
    done=$(figure number_of_executed_units)
    executions=$((executions + ${done:-0}))
    [ $status = 0 ] && break
    new=$((new + 1))
    grep -a -m 1 -E "^FOUND|runtime error|ERROR: (Address|Leak)Sanitizer|ERROR: libFuzzer|Fortran runtime error" "$work/log"
    cp "$work/log" "$work/found/$name-$begin-$new.log"
  done
  seconds=$(($(date +%s) - begin))
  new=$((new + $(slow_of "$name") - slow))
  # coverage of all texts except these findings
  "$program" -runs=0 -entropic=0 -timeout=120 "$texts" "$top/tests/fuzz/corpus/$name" >"$work/log" 2>&1
  printf '%s %s %s %s %s %s\n' "$name" "$preset" "$executions" "$seconds" "$new" "$(figure branches)" >>"$work/statistics"
  say "$name: $executions executions in $seconds s, $new findings, $(files_of "$texts") texts, $(figure branches) branches"
  found=$((found + new))
done
[ -n "$minimise" ] && exit 0
say "All runs so far"
awk '{ e[$1] += $3; s[$1] += $4; f[$1] += $5; if ($6 > b[$1]) b[$1] = $6; n += $3 }
  END { for (k in e) printf "%-14s %9d executions %8d s %4d findings %7d branches\n", k, e[k], s[k], f[k], b[k]
        printf "%-14s %9d executions\n", "total", n }' "$work/statistics"
[ $found = 0 ]
