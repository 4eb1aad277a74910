#!/bin/sh
# Installs the built tree, moves it, and builds and runs the examples.
#
# usage: install_test.sh BUILD_FOLDER CMAKE GENERATOR COMPILER BUILD_TYPE FLAGS
set -eu
build=$1 cmake=$2 generator=$3 compiler=$4 build_type=$5 flags=$6
examples=$(dirname "$0")/../../../scenes/examples
unset DESTDIR
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "$*"
    exit 1
}

"$cmake" --install "$build" --prefix "$folder/installed" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
prefix="$folder/another place"
mv "$folder/installed" "$prefix"

echo "headers name nothing of what is inside, and each stands by itself"
! grep -riE 'xsimd|tbb|glm|nlohmann|stb_' "$prefix/include" || fail "see above"
for header in "$prefix"/include/raylane/*.hpp; do
    # shellcheck disable=SC2086 # a list of words
    echo "#include <raylane/$(basename "$header")>" |
        "$compiler" $flags -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion \
            -Werror -fsyntax-only -I "$prefix/include" -x c++ - || fail "$header"
done

echo "the archive claims no name outside of raylane"
archive=$(find "$prefix" -name libraylane.a)
others=$(nm -gC --defined-only "$archive" | awk '$2 ~ /^[TDBRC]$/' | grep -v raylane || true)
[ -z "$others" ] || fail "$others"

echo "the examples find it, build and run"
"$cmake" -S "$examples" -B "$folder/examples" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE="$build_type" -DCMAKE_CXX_FLAGS="$flags" \
    >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
"$cmake" --build "$folder/examples" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
cd "$folder"
"$folder/examples/hits"
[ -s sphere.png ] || fail "no picture"
"$folder/examples/hits_in_c"
[ -s ball.png ] || fail "no picture from C"
cmp sphere.png ball.png || fail "another picture from C"
"$folder/examples/path" || fail "another picture than raylane's"
[ -s path.png ] || fail "no picture of paths"

echo "the tool and the scenes are there"
"$prefix/bin/raylane" render "$prefix/share/raylane/sphere.json" --size 16x16 -o tool.png
[ -s tool.png ] || fail "no picture by the tool"
[ -s "$prefix/share/raylane/raylane-scene.schema.json" ] || fail "no schema"
