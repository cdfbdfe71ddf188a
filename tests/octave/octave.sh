#!/bin/sh
# Run a script in GNU Octave without a screen: sh octave.sh text|plots|library SCRIPT
#
#   text    no graphics
#   plots   pictures, drawn by Octave's own OpenGL toolkit on a virtual X server (Xvfb)
#   library calls of the shared library, by a gateway that is built by mkoctfile, and pictures
# Exit status 77: Octave, the virtual server, or mkoctfile is not installed.
set -u
mode=$1
script=$2

skip() { echo "SKIPPED: $1"; exit 77; }
command -v octave-cli >/dev/null 2>&1 || skip "octave is not installed (Debian: apt-get install octave)"

here=$(cd "$(dirname "$0")" && pwd)
run="addpath('$here/support', '${CONTACT_SOURCE}/matlab'); run_test('$script')"
# Octave 7 reports an exception when it closes its graphics; the exit status is not affected
if [ "$mode" = text ]; then
  exec octave-cli --quiet --norc --eval "$run"
fi

if [ "$mode" = library ]; then
  command -v mkoctfile >/dev/null 2>&1 || skip "mkoctfile is not installed (Debian: apt-get install octave-dev)"
fi
command -v Xvfb >/dev/null 2>&1 || skip "Xvfb, required for plots, is not installed (Debian: apt-get install xvfb)"
number=$(mktemp)
Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>"$number" 2>/dev/null &
server=$!
trap 'kill $server 2>/dev/null; wait $server 2>/dev/null; rm -f "$number"' EXIT
for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
  [ -s "$number" ] && break
  sleep 0.5
done
[ -s "$number" ] || { echo "Xvfb did not start within 10 s"; exit 1; }
DISPLAY=:$(cat "$number") QT_LOGGING_RULES='*=false' octave --no-gui --quiet --norc --eval "$run"
