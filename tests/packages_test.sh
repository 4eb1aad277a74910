#!/bin/sh
# Makes the packages of a build of the project, installs them in a root of their own, and uses what is
# there: tests/packages_test.sh BUILD. Wants the pages of the library's headers, and to be root.
set -eu
build=$(realpath "$1")
cd "$(dirname "$0")/.."
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT

# The library's folder is Debian's by this prefix alone; it compiles nothing anew.
cmake -S . -B "$build" -DCMAKE_INSTALL_PREFIX=/usr >/dev/null
rm -rf "$build/packages"
(cd "$build" && cpack -G DEB >/dev/null)

mkdir -p "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/info"
touch "$root/var/lib/dpkg/status"
dpkg --root="$root" --force-depends --log=/dev/null --install "$build"/packages/*.deb >/dev/null 2>&1
dpkg --root="$root" -l raylane libraylane-dev raylane-doc | grep -c '^ii' | grep -qx 3

raylane=$root/usr/bin/raylane
"$raylane" render "$root/usr/share/raylane/birthday.json" --size 40x30 -o "$root/picture.png"
test -s "$root/picture.png"
for page in "$root"/usr/share/man/man1/*.1; do
    grep -q '^\.SH SYNOPSIS' "$page"
done
"$raylane" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p' | while read -r command; do
    test -s "$root/usr/share/man/man1/raylane-$command.1" || { echo "no page of $command"; exit 1; }
done
bash -n "$root/usr/share/bash-completion/completions/raylane"
test -s "$root/usr/share/doc/raylane-doc/html/tracer_8hpp.html"

cmake -S scenes/examples -B "$root/examples" -DCMAKE_PREFIX_PATH="$root/usr" >/dev/null
cmake --build "$root/examples" >/dev/null
echo "packages: installed and used"
