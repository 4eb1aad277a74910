#!/bin/sh
# What binaries saw of the shared library in a version, and see of it now: may they be of these versions?
#
# usage: abi_compare.sh BEFORE NOW VERSION    BEFORE begins with "# VERSION", both as abi.py writes them
set -eu
before=$1 now=$2 version=$3
old_version=$(sed -n '1s/^# //p' "$before")
compatible() { # version: what has to differ where something is gone
    case $1 in
    0.*) echo "${1%.*}" ;;
    *) echo "${1%%.*}" ;;
    esac
}
sorted=$(mktemp)
trap 'rm -f "$sorted" "$sorted.now"' EXIT
LC_ALL=C
export LC_ALL
grep -v '^#' "$before" | sort >"$sorted"
grep -v '^#' "$now" | sort >"$sorted.now"
gone=$(comm -23 "$sorted" "$sorted.now")
new=$(comm -13 "$sorted" "$sorted.now")
[ -z "$new" ] || echo "$new" | sed 's/^/+ /'
if [ -n "$gone" ]; then
    echo "$gone" | sed 's/^/- /'
    if [ "$(compatible "$version")" = "$(compatible "$old_version")" ]; then
        echo "programs that were built with $old_version do not run with this: it cannot be $version"
        exit 1
    fi
elif [ -n "$new" ] && [ "$version" = "$old_version" ]; then
    # What has no tag is not out, and may have more until it is.
    if git rev-parse -q --verify "refs/tags/v$version" >/dev/null 2>&1; then
        echo "$version is out, and had not all of this"
        exit 1
    fi
fi
echo "ABI: $version after $old_version, $(wc -l <"$sorted.now") lines"
