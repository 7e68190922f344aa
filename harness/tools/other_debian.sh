#!/bin/sh
# Builds, verifies and tests this clone on the other supported version of Debian, in a system that initially contains only git, make and gcc:
# 'make verify' and 'make test' install all other packages. Requires root. If the other system cannot be made, prints the reason and ends with status 77.
# usage: other_debian.sh FOLDER
set -u
folder=$1 root=$1/root
. /etc/os-release
case ${VERSION_CODENAME:-} in
bookworm) other=trixie ;;
trixie) other=bookworm ;;
*) echo "needs Debian 12 or 13"; exit 77 ;;
esac
[ "$(id -u)" = 0 ] || { echo "needs root"; exit 77; }
command -v debootstrap >/dev/null 2>&1 || DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends debootstrap >/dev/null 2>&1 ||
    { echo "needs debootstrap"; exit 77; }
unshare --mount true 2>/dev/null || { echo "needs the right to mount"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
trap 'rm -rf "$folder"' EXIT
# Runs a command in the other system. The mounts end with the command.
inside() { # seconds command
    timeout -k 30 "$1" unshare --mount sh -c 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" &&
        exec chroot "$0" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${OPENBLAS_CORETYPE:+OPENBLAS_CORETYPE=$OPENBLAS_CORETYPE} sh -c "cd /root/beamwork && $1"' "$root" "$2"
}
timeout -k 30 600 unshare --mount debootstrap --variant=minbase --include=ca-certificates,git,make,gcc $other "$root" http://deb.debian.org/debian ||
    { echo "needs Debian's archive: $other could not be had"; exit 77; }
cp /etc/resolv.conf "$root/etc/resolv.conf"
git clone -q . "$root/root/beamwork" || exit 1
options='CFLAGS="-O2 -g"'
inside 1200 "make -s verify $options VERIFY='-k \"warping_torsion or c_column/default\"'" || exit 1
inside 900 "make -s test $options TESTS='build/elements/test/quadrature_test build/harness/numerics/test/linear_test' PYTHON_TESTS='harness/records/test/compare_test.py harness/records/test/sweep_test.py harness/records/test/short_table_test.py harness/records/test/files_test.py harness/records/test/matrices_test.py harness/records/test/schema_test.py'"
