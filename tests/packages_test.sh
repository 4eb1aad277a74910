#!/bin/sh
# Makes the packages of a build of the project, installs them in a separate root, and uses the
# installed files: tests/packages_test.sh BUILD. Needs the pages of the library's headers.
set -eu
build=$(realpath "$1")
cd "$(dirname "$0")/.."
root=$(mktemp -d)
[ -e build/pages/tracer_8hpp.html ] || {
    echo "packages: no build/pages: run doxygen scenes/api/cpp/Doxyfile first" >&2
    exit 2
}
as_root=
[ "$(id -u)" -eq 0 ] || as_root=sudo
prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")
trap '$as_root rm -rf "$root"; cmake -S . -B "$build" -DCMAKE_INSTALL_PREFIX="$prefix" >/dev/null' EXIT
quietly() { # command...: prints its output if it fails
    "$@" >"$root/log" 2>&1 || {
        cat "$root/log"
        exit 1
    }
}

# Only with this prefix is the library's folder that of Debian. Nothing is compiled again.
quietly cmake -S . -B "$build" -DCMAKE_INSTALL_PREFIX=/usr
rm -rf "$build/packages"
quietly sh -c "cd '$build' && cpack -G DEB"

mkdir -p "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/info"
touch "$root/var/lib/dpkg/status"
# shellcheck disable=SC2086 # one word or none
quietly $as_root dpkg --root="$root" --force-depends --log=/dev/null \
    --install "$build"/packages/*.deb
for package in $(sed -n 's/^ *find_dependency(\([A-Za-z]*\).*/\1/p' scenes/api/cpp/raylaneConfig.cmake.in); do
    case $package in TBB) name=libtbb-dev ;; PNG) name=libpng-dev ;; ZLIB) name=zlib1g-dev ;; *) name="$package" ;; esac
    dpkg-deb --field "$build"/packages/libraylane-dev_*.deb Depends | grep -qwF "$name" ||
        { echo "packages: libraylane-dev does not depend on $name"; exit 1; }
done
for package in raylane libraylane-dev raylane-doc; do
    dpkg --root="$root" -l "$package" | grep -q '^ii' || { echo "packages: $package is not installed"; exit 1; }
done

raylane=$root/usr/bin/raylane
out=$(mktemp -d -p "$root")
quietly "$raylane" render "$root/usr/share/raylane/birthday.json" --size 40x30 -o "$out/picture.png"
test -s "$out/picture.png"
commands=$("$raylane" --help | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z]*\) .*/\1/p')
[ "$(echo "$commands" | wc -w)" -ge 6 ]
for command in $commands; do
    grep -q '^\.SH SYNOPSIS' "$root/usr/share/man/man1/raylane-$command.1"
done
bash -n "$root/usr/share/bash-completion/completions/raylane"
test -s "$root/usr/share/doc/raylane-doc/html/tracer_8hpp.html"

quietly cmake -S scenes/api/examples -B "$out/examples" -DCMAKE_PREFIX_PATH="$root/usr"
quietly cmake --build "$out/examples"
echo "packages: installed and used"
