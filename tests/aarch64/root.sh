#!/bin/sh
# Makes build/aarch64-root: the C library and raylane's dependencies for arm64, from this machine's
# Debian. The machine's packages do not change: apt gets a separate, empty state, and packages are
# only unpacked.
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
# Absolute links would otherwise lead to this machine's root.
find "$root" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$root$(readlink "$link")" "$link"
done
echo "$packages" >"$laid"
