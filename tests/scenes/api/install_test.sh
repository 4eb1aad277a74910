#!/bin/sh
# Installs the built tree, moves it, checks its contents, and builds and runs the examples.
#
# usage: install_test.sh BUILD_FOLDER CMAKE GENERATOR C_COMPILER CXX_COMPILER BUILD_TYPE FLAGS
set -eu
build=$1 cmake=$2 generator=$3 c_compiler=$4 compiler=$5 build_type=$6 flags=$7
fortran=$(command -v gfortran || true)
case $flags in
*-fsanitize*) fortran= ;; # its programs lack the sanitizers' functions
esac
source=$(cd "$(dirname "$0")/../../.." && pwd)
unset DESTDIR
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "$*"
    exit 1
}
quietly() { # command...
    "$@" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
}

quietly "$cmake" --install "$build" --prefix "$folder/installed"
prefix="$folder/another place"
mv "$folder/installed" "$prefix"

echo "headers name nothing of what is inside, and each stands by itself, without a warning"
! grep -riE 'xsimd|tbb|glm|nlohmann|stb_' "$prefix/include" || fail "see above"
warnings='-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Werror'
for header in "$prefix"/include/raylane/*; do
    name=$(basename "$header")
    for each in "$compiler" g++ clang++; do
        command -v "$each" >/dev/null || continue
        # shellcheck disable=SC2086 # a list of words
        echo "#include <raylane/$name>" |
            "$each" -std=c++20 $warnings -fsyntax-only -I "$prefix/include" -x c++ - || fail "$each: $name"
    done
    case $name in
    *.h)
        # shellcheck disable=SC2086 # a list of words
        printf '#include <raylane/%s>\nextern int not_empty;\n' "$name" |
            "$c_compiler" -std=c99 ${warnings% -Wold*} -Werror -fsyntax-only -I "$prefix/include" -x c - ||
            fail "$c_compiler: $name"
        ;;
    esac
done

echo "an older standard of C++ is one error"
cd "$folder"
for each in "$compiler" g++ clang++; do
    command -v "$each" >/dev/null || continue
    for text in "#include <raylane/tracer.hpp>" "$(cat "$source/scenes/api/examples/hits.cpp")"; do
        ! echo "$text" | "$each" -std=c++17 -fsyntax-only -I "$prefix/include" -x c++ - 2>log || fail "$each: C++17"
        { [ "$(grep -c 'error: ' log)" -eq 1 ] && grep -q 'error: .*raylane needs C++20' log; } ||
            fail "$each: $(cat log)"
    done
done

ours='raylane|glm|nlohmann|stbi|CLI'
archives=$(find "$prefix" -name 'libraylane*.a')
if [ -n "$archives" ]; then
    echo "the archives claim no name outside of raylane, and what takes them in exports none of it"
    [ "$(echo "$archives" | wc -l)" -eq 2 ] || fail "not two libraries: $archives"
    cp "$(dirname "$(echo "$archives" | head -n 1)")"/libraylane*.a .
    others=$(nm -gC --defined-only libraylane*.a | awk '$2 ~ /^[TDBRC]$/' | grep -v raylane || true)
    [ -z "$others" ] || fail "$others"
    # shellcheck disable=SC2086 # a list of words
    quietly "$compiler" $flags -shared -o all.so -Wl,--whole-archive libraylane*.a -Wl,--no-whole-archive -ltbb -lz
    exported=$(nm -DC --defined-only all.so | grep -v ' std::' | grep -E "$ours" || true)
    [ -z "$exported" ] || fail "$exported"
    run_path=
else
    echo "the shared libraries export what their headers declare, and nothing else"
    version=$(sed -n 's/^#define RAYLANE_VERSION "\(.*\)"/\1/p' "$prefix/include/raylane/version.h")
    case $version in 0.*) abi=${version%.*} ;; *) abi=${version%%.*} ;; esac
    for library in raylane_trace raylane; do
        shared=$(find "$prefix" -name "lib$library.so")
        [ -n "$shared" ] || fail "no library"
        readelf -dW "$shared" | grep -qF "Library soname: [lib$library.so.$abi]" || fail "no soname of version $abi"
        nm -DC --defined-only "$shared" | cut -d' ' -f3- >>exported
    done
    others=$(grep -vE '^(((typeinfo|typeinfo name|vtable) for|unsigned int|void) )?raylane(_|::)' exported || true)
    [ -z "$others" ] || fail "$others"
    inside=$(grep -E '^([a-z ]+ for )?raylane::(core|simd|scenes|library)::' exported || true)
    [ -z "$inside" ] || fail "$inside"
    for function in $(sed -n 's/^RAYLANE_API .*\(raylane_[a-z_]*\)(.*/\1/p' "$prefix/include/raylane/raylane.h"); do
        grep -qx "$function" exported || fail "$function is not exported"
    done
    run_path="-Wl,-rpath,$(dirname "$shared")"
fi

echo "the examples find it, build and run"
quietly "$cmake" -S "$source/scenes/api/examples" -B "$folder/examples" -G "$generator" \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$c_compiler" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_BUILD_TYPE="$build_type" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_C_FLAGS="$flags" \
    -DCMAKE_Fortran_COMPILER="${fortran:-NOTFOUND}"
quietly "$cmake" --build "$folder/examples"
"$folder/examples/hits"
[ -s sphere.png ] || fail "no picture"
"$folder/examples/hits_in_c"
[ -s ball.png ] || fail "no picture from C"
cmp sphere.png ball.png || fail "another picture from C"
"$folder/examples/path" || fail "another picture than raylane's"
[ -s path.png ] || fail "no picture of paths"
"$folder/examples/solids_in_c" || fail "wrong numbers in C"
if [ -n "$fortran" ]; then
    "$folder/examples/solids_in_fortran" || fail "wrong numbers in Fortran"
else
    echo "(there is no Fortran)"
fi

echo "its components are trace and raylane"
mkdir components
cat >components/CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.25)
project(components LANGUAGES C)
foreach(components trace raylane "trace;raylane" "raylane;trace")
  find_package(raylane REQUIRED COMPONENTS \${components})
endforeach()
find_package(raylane QUIET COMPONENTS files)
if(raylane_FOUND)
  message(FATAL_ERROR "there is a component files")
endif()
EOF
quietly "$cmake" -S components -B components/build -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$c_compiler"

# A library with sanitizers must be linked by the C++ compiler.
in_c=yes
case $flags in *-fsanitize*) in_c= ;; esac
if [ -n "$in_c" ]; then
    echo "a project in C alone finds it, builds and runs"
    mkdir in_c
    cat >in_c/CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.25)
project(in_c LANGUAGES C)
find_package(raylane REQUIRED)
add_executable(hits_in_c "$source/scenes/api/examples/hits_in_c.c")
target_link_libraries(hits_in_c PRIVATE raylane::raylane)
EOF
    quietly "$cmake" -S in_c -B in_c/build -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_C_COMPILER="$c_compiler" -DCMAKE_C_FLAGS="$flags"
    quietly "$cmake" --build in_c/build
    rm ball.png
    in_c/build/hits_in_c
    [ -s ball.png ] || fail "no picture from C alone"
    echo "the program of the page for C builds and runs"
    sed -n '/^```c$/,/^```$/p' "$source/scenes/api/c/README.md" | sed '1d;$d' >of_page.c
    sed 's/hits_in_c "[^"]*"/hits_in_c of_page.c/' in_c/CMakeLists.txt >CMakeLists.txt
    quietly "$cmake" -S . -B of_page -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_C_COMPILER="$c_compiler" -DCMAKE_C_FLAGS="$flags"
    quietly "$cmake" --build of_page
    [ "$(of_page/hits_in_c)" = "4 inf" ] || fail "wrong t in C"
    ! nm of_page/hits_in_c | grep -i ' t .*raylane_closest' || fail "functions that it does not call are linked"
fi
if [ -n "$in_c" ] && [ -n "$fortran" ]; then
    echo "a project in Fortran alone finds it, builds and runs"
    mkdir in_fortran
    cat >in_fortran/CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.25)
project(in_fortran LANGUAGES Fortran)
find_package(raylane REQUIRED COMPONENTS trace)
add_executable(solids "$source/scenes/api/examples/solids_in_fortran.f90")
target_link_libraries(solids PRIVATE raylane::trace)
EOF
    quietly "$cmake" -S in_fortran -B in_fortran/build -G "$generator" -DCMAKE_PREFIX_PATH="$prefix"
    quietly "$cmake" --build in_fortran/build
    in_fortran/build/solids || fail "wrong numbers in Fortran alone"
fi

echo "a program that only traces links no readers, and no libraries for files"
mkdir traces
cat >traces/CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.25)
project(traces LANGUAGES C CXX)
find_package(raylane REQUIRED COMPONENTS trace)
add_executable(traces traces.cpp)
target_link_libraries(traces PRIVATE raylane::trace)
EOF
cat >traces/traces.cpp <<EOF
#include <raylane/raylane.hpp>
int main() {
    raylane::SceneBuilder builder;
    builder.add(raylane::Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    const float zero[] = {0}, z[] = {5}, dz[] = {-1};
    float t[1];
    raylane::Tracer(builder.build()).intersect({zero, zero, z, zero, zero, dz}, {.t = t});
    return t[0] == 4 ? 0 : 1;
}
EOF
quietly "$cmake" -S traces -B traces/build -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$c_compiler" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" \
    -DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON
quietly "$cmake" --build traces/build
traces/build/traces || fail "wrong t"
! ldd traces/build/traces | grep -E 'png|libz|libraylane\.so' || fail "see above"
! nm -C traces/build/traces | grep 'raylane::scenes::' || fail "see above"
if [ -n "$archives" ] && [ -n "$in_c" ] && [ "$build_type" = Release ]; then
    sets=$(grep -o 'Isa::' "$build/generated/simd/isa/built_isas.hpp" | wc -l)
    strip -o traces.stripped traces/build/traces
    size=$(wc -c <traces.stripped)
    echo "($size bytes with kernels for $sets instruction sets)"
    [ "$size" -le $((3500000 + 3000000 * sets)) ] || fail "too large"
fi

echo "pkg-config finds it"
if command -v pkg-config >/dev/null; then
    PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name raylane.pc)")
    export PKG_CONFIG_PATH
    words=$(pkg-config --cflags --libs raylane-trace)
    eval "quietly \"$compiler\" $flags -std=c++20 traces/traces.cpp -o traces.pc $words ${run_path:+\"$run_path\"}"
    ./traces.pc || fail "wrong t"
    if [ -n "$in_c" ] && [ -n "$fortran" ]; then
        eval "quietly gfortran \"$source/scenes/api/examples/solids_in_fortran.f90\" -o solids.pc \
            $words ${run_path:+\"$run_path\"}"
        ./solids.pc || fail "wrong numbers in Fortran"
    fi
    words=$(pkg-config --cflags --libs raylane)
    eval "quietly \"$compiler\" $flags -std=c++20 \"$source/scenes/api/examples/hits.cpp\" -o hits.pc \
        $words ${run_path:+\"$run_path\"}"
    rm sphere.png
    ./hits.pc
    [ -s sphere.png ] || fail "no picture"
    if [ -n "$in_c" ]; then
        eval "quietly \"$c_compiler\" $flags -std=c99 \"$source/scenes/api/examples/hits_in_c.c\" -o hits_in_c.pc \
            $words ${run_path:+\"$run_path\"}"
        rm ball.png
        ./hits_in_c.pc
        [ -s ball.png ] || fail "no picture from C"
    fi
else
    echo "(there is none)"
fi

echo "as a part of another project it is the library alone, optimised"
mkdir outer
cat >outer/CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.25)
project(outer LANGUAGES C CXX)
add_library(theirs theirs.cpp)
add_subdirectory("$source" raylane)
if(NOT TARGET raylane::raylane)
  message(FATAL_ERROR "no library")
endif()
foreach(target raylane raylane-bench raylane-test-core raylane-tests)
  if(TARGET \${target})
    message(FATAL_ERROR "\${target} is none of another project's business")
  endif()
endforeach()
get_property(tests DIRECTORY "$source" PROPERTY TESTS)
if(tests)
  message(FATAL_ERROR "tests")
endif()
EOF
echo >outer/theirs.cpp
unset CFLAGS CXXFLAGS CMAKE_BUILD_TYPE
quietly "$cmake" -S outer -B outer/build -G "$generator" -DCMAKE_C_COMPILER="$c_compiler" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
commands=$(grep '"command":' outer/build/compile_commands.json)
slow=$(echo "$commands" | grep -v -e theirs.cpp -e ' -O3 -DNDEBUG ' || true)
[ -z "$slow" ] || fail "not optimised: $slow"
! echo "$commands" | grep theirs.cpp | grep -e -O3 || fail "other targets are changed"
quietly "$cmake" --install outer/build --prefix "$folder/none"
[ ! -e "$folder/none" ] || fail "it installs itself with another project"

echo "the tool and the scenes are there"
"$prefix/bin/raylane" render "$prefix/share/raylane/sphere.json" --size 16x16 -o tool.png
[ -s tool.png ] || fail "no picture by the tool"
[ -s "$prefix/share/raylane/raylane-scene.schema.json" ] || fail "no schema"
