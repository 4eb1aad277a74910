#!/bin/bash
# Runs a command on a clone of HEAD in a bare Debian, a separate root with the essential packages only.
#
#   tests/bare.sh [--suite bookworm|trixie] [--ccache] COMMAND...
#
#   --suite     Debian 12 (bookworm) or 13 (trixie). Default: bookworm
#   --ccache    installs ccache and shares the folder CCACHE_DIR, by default ~/.cache/ccache
#
# It runs as root, for it mounts and changes roots. The archive of each root is kept in ~/.cache/raylane (or in
# XDG_CACHE_HOME). Uncommitted changes are not in the clone. The exit code is the command's.
set -euo pipefail

usage() {
    sed -n 's/^#   \(tests\/.*\)/usage: \1/p' "$0"
}

suite=bookworm
ccache=
while [ $# -gt 0 ]; do
    case $1 in
    --suite)
        suite=${2-}
        shift
        ;;
    --ccache) ccache=1 ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 2 ;;
    *) break ;;
    esac
    shift
done
case $suite in bookworm | trixie) ;; *) usage >&2; exit 2 ;; esac
[ $# -gt 0 ] || { usage >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "tests/bare.sh: only root may change roots" >&2; exit 3; }

{ # read as a whole before it runs: a commit meanwhile may change this file
project=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=tests/have.sh
. "$project/tests/have.sh"
have mmdebstrap git

cache=${XDG_CACHE_HOME:-$HOME/.cache}/raylane
archive=$cache/$suite.tar
mkdir -p "$cache"
root=$(mktemp -d)
# shellcheck disable=SC2317 # the trap calls it
clean_up() {
    # Nothing is removed before all mounts are gone: a folder of this machine may be behind one.
    for place in proc dev ccache; do
        ! mountpoint -q "$root/$place" || umount --recursive "$root/$place" || umount --lazy "$root/$place"
    done
    if grep -q " $root/" /proc/self/mounts; then
        echo "tests/bare.sh: $root has mounts, and is left as it is" >&2
        return
    fi
    rm -rf --one-file-system "$root"
}
trap clean_up EXIT
trap 'exit 130' INT TERM HUP

if [ ! -s "$archive" ]; then
    echo "making a bare root of $suite: about two minutes"
    mmdebstrap --quiet --mode=root --variant=minbase --include=ca-certificates "$suite" "$root/new.tar"
    mv "$root/new.tar" "$archive.$$"
    mv "$archive.$$" "$archive"
fi
tar -C "$root" -xf "$archive"
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
git clone -q --no-hardlinks "$project" "$root/raylane"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"

environment=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root "TERM=${TERM:-dumb}")
for name in http_proxy https_proxy no_proxy; do
    [ -z "${!name-}" ] || environment+=("$name=${!name}")
done
if [ -n "$ccache" ]; then
    shared=${CCACHE_DIR:-$HOME/.cache/ccache}
    mkdir -p "$shared" "$root/ccache"
    mount --bind "$shared" "$root/ccache"
    environment+=(CCACHE_DIR=/ccache)
    chroot "$root" env -i "${environment[@]}" sh -c \
        'apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends ccache' >/dev/null
fi

began=$SECONDS
status=0
# shellcheck disable=SC2016 # the inner shell's
chroot "$root" env -i "${environment[@]}" sh -c 'cd /raylane && exec "$@"' sh "$@" || status=$?
took=$((SECONDS - began))
echo "bare $suite: exit code $status after $((took / 60)) min $((took % 60)) s on $(nproc) processors: $*"
exit $status
}
