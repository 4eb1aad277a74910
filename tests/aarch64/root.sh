#!/bin/sh
# Lays out build/aarch64-root: the C library and what raylane is built with, as this machine's Debian has them
# for arm64. The machine's own packages stay as they are: apt is given a state of its own, with nothing in it,
# and packages are only unpacked.
set -eu
cd "$(dirname "$0")/../.."
packages='libc6-dev libstdc++-12-dev libglm-dev libxsimd-dev libtbb-dev nlohmann-json3-dev libcli11-dev libstb-dev
    zlib1g-dev libpng-dev libopenexr-dev libxxhash-dev gemmi-dev tao-pegtl-dev catch2 libboost-dev'
root=build/aarch64-root
laid=$root/packages # written last
[ "$(cat "$laid" 2>/dev/null)" != "$packages" ] || exit 0

rm -rf "$root" "$root.apt"
mkdir -p "$root" "$root.apt/state/lists/partial" "$root.apt/cache/archives/partial"
: >"$root.apt/status"
sources=/etc/apt/sources.list.d/debian.sources
[ -e "$sources" ] || sources=/etc/apt/sources.list
apt() {
    apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Sandbox::User= \
        -o Dir::State="$PWD/$root.apt/state" -o Dir::State::status="$PWD/$root.apt/status" \
        -o Dir::Cache="$PWD/$root.apt/cache" -o Dir::Etc::sourcelist="$sources" -o Dir::Etc::sourceparts=/dev/null \
        "$@"
}
apt update
# shellcheck disable=SC2086 # a list of words
apt install --yes --download-only --no-install-recommends $packages
for package in "$root.apt"/cache/archives/*.deb; do
    dpkg-deb -x "$package" "$root"
done
rm -rf "$root.apt"
# Links from its top are from this machine's top otherwise.
find "$root" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$root$(readlink "$link")" "$link"
done
echo "$packages" >"$laid"
