#!/bin/sh
# Both commands of the README in a minimal Debian or Ubuntu: fresh_system.sh SUITE [MIRROR [FOLDER]], as root
#
#   SUITE     a release, such as bookworm, trixie, sid (Debian) or noble (Ubuntu)
#   MIRROR    of its packages; default: that of this machine, which has to be of the same distribution
#   FOLDER    for the system, which stays there to look at; default: a temporary one that is removed
# It needs debootstrap and half an hour. The last commit is tested. The exit status is that of the first command that fails.
set -u
top=$(cd "$(dirname "$0")/../.." && pwd) || exit 1
suite=${1:?usage: sh tests/support/fresh_system.sh SUITE [MIRROR [FOLDER]]}
mirror=${2:-$(sed -n 's/^URIs: *//p; s/^deb \([^[ ]*\) .*/\1/p' /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2>/dev/null | head -1)}

# The system and its mounts are in a namespace of their own, so that nothing of this machine is in FOLDER when it is removed
if [ -z "${CONTACT_FRESH_ROOT:-}" ]; then
  CONTACT_FRESH_ROOT=${3:-$(mktemp -d)} || exit 1
  export CONTACT_FRESH_ROOT
  mkdir -p "$CONTACT_FRESH_ROOT" || exit 1
  unshare --mount sh "$0" "$suite" "$mirror"
  status=$?
  [ -n "${3:-}" ] || rm -rf --one-file-system "$CONTACT_FRESH_ROOT"
  exit $status
fi
root=$CONTACT_FRESH_ROOT

# A release newer than this debootstrap, or of a distribution whose keys are not here, is made by its general script, unsigned
set -- --variant=minbase "$suite" "$root" "$mirror"
[ -e "/usr/share/debootstrap/scripts/$suite" ] || set -- --no-check-gpg --components=main,universe "$@" gutsy
if [ ! -e "$root/etc/os-release" ]; then
  debootstrap "$@" || exit 1
fi
mount -t proc proc "$root/proc" && mount --bind /dev "$root/dev" && mount -t tmpfs tmpfs "$root/dev/shm" || exit 1
for file in /etc/resolv.conf /etc/hosts; do
  cp "$file" "$root$file"
done
certificates=/etc/ssl/certs/ca-certificates.crt
# run COMMAND: in the checkout of the system, without the environment of this machine
run() {
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    PIP_CERT="$certificates" SSL_CERT_FILE="$certificates" NODE_EXTRA_CA_CERTS="$certificates" sh -c "cd /root/contact && $1"
}
rm -rf "$root/root/contact"
git clone -q "$top" "$root/root/contact" || exit 1
run "apt-get update && apt-get install -y ca-certificates" >/dev/null || exit 1
# with those that this machine trusts in addition
cp "$certificates" "$root$certificates"
run "sh examples/run.sh cattaneo" || exit
run "sh tests/run.sh"
