#!/bin/sh
# Tests that optional dependencies may be missing.
#
#   tests/optional_test.sh
#       Configures with all hidden, and with each of the tool's dependencies hidden in turn. With
#       RAYLANE_TEST_ROUNDS=full, each one of the tests and benchmarks is hidden in turn, too. The
#       summary must report the part as off and name Debian's package.
#   tests/optional_test.sh --build [OPTIONS]
#       Builds the tool in build/without with all hidden. The tool must render, and refuse each missing part in one
#       line. OPTIONS are cmake's: -DRAYLANE_KERNELS=BUILD takes another build's kernels.
#
# CMAKE, CMAKE_GENERATOR and CXX choose the programs.
set -eu
cd "$(dirname "$0")/.."
source=$PWD
cmake=${CMAKE:-cmake}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# X of CMAKE_DISABLE_FIND_PACKAGE_X, and a package that the summary must name.
tool='gemmi=gemmi-dev OpenEXR=libopenexr-dev TIFF=libtiff-dev Pango=libpango1.0-dev SDL2=libsdl2-dev MPI=libopenmpi-dev doxygen=doxygen'
others='Python3=python3 pybind11=pybind11-dev NumPy=python3-numpy pytest=python3-pytest
    jsonschema=python3-jsonschema Catch2=catch2 Boost=libboost-dev gappa=gappa Xvfb=xvfb
    benchmark=libbenchmark-dev embree=libembree-dev'

fail() {
    echo "$1"
    [ ! -e "$folder/log" ] || cat "$folder/log"
    exit 1
}
configure() { # build, options...
    build=$1
    shift
    "$cmake" -S "$source" -B "$build" "$@" >"$folder/log" 2>&1 || fail "cmake fails: $*"
}
is_off() { # X=package
    grep -q "^--   .* off .*Debian: [^,]*${1#*=}.*, hidden by CMAKE_DISABLE_FIND_PACKAGE_${1%=*}" "$folder/log" ||
        fail "the summary does not say that ${1%=*} is off and that ${1#*=} turns it on"
}

hide_each() {
    for pair in $tool $others; do
        set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_${pair%=*}=ON"
    done
    configure "$folder/all" "$@"
    for pair in $tool Catch2=catch2 benchmark=libbenchmark-dev pybind11=pybind11-dev; do
        is_off "$pair"
    done

    # One tree for all: a dependency that was found before must be off.
    set --
    for pair in $tool $others; do
        set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_${pair%=*}=OFF"
    done
    in_turn=$tool
    [ "${RAYLANE_TEST_ROUNDS-}" != full ] || in_turn="$tool $others"
    for pair in $in_turn; do
        configure "$folder/all" "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_${pair%=*}=ON"
        is_off "$pair"
    done
}

has_no_mpi() { # build, options...
    configure "$@" -DRAYLANE_TESTS=OFF -DRAYLANE_BENCHMARKS=OFF -DRAYLANE_PYTHON=OFF
    grep -q '^--   ranks on several hosts .* off  (Debian: libopenmpi-dev)' "$folder/log" ||
        fail "the summary does not say that ranks are off without MPI"
    ! "$cmake" --build "$1" --target help | grep -q raylane-mpi || fail "without MPI, raylane-mpi would be built"
}

search_without_mpi() {
    # FindMPI makes its target before it searches: it must search, and find nothing.
    echo 'set(CMAKE_IGNORE_PATH /bin /usr/bin /usr/local/bin) # compilers of MPI, and pkg-config' >"$folder/blind.cmake"
    has_no_mpi "$folder/blind" "-DCMAKE_PROJECT_raylane_INCLUDE=$folder/blind.cmake"
    # A compiler of MPI without headers, such as that in Debian's openmpi-bin, fails FindMPI.
    mkdir -p "$folder/mpi/bin"
    cat >"$folder/mpi/bin/mpicxx" <<'SH'
#!/bin/sh
case $* in
-showme:compile) echo -I/none/include ;;
-showme:link) echo -L/none/lib -lmpi ;;
-showme:*) ;;
*) exit 1 ;;
esac
SH
    chmod +x "$folder/mpi/bin/mpicxx"
    PATH=$folder/mpi/bin:$PATH
    has_no_mpi "$folder/bare"
}

# Its message must be one line, which names the package.
refuses() { # package, command...
    package=$1
    shift
    ! "$@" >"$folder/log" 2>&1 || fail "succeeds without $package: $*"
    { [ "$(wc -l <"$folder/log")" -eq 1 ] && grep -q "$package" "$folder/log"; } ||
        fail "not one line that names $package: $*"
    cat "$folder/log"
}

build_without() {
    set -- "$@" -DRAYLANE_TESTS=OFF -DRAYLANE_BENCHMARKS=OFF -DRAYLANE_PYTHON=OFF
    for pair in $tool; do
        set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_${pair%=*}=ON"
    done
    build=build/without
    configure "$build" --fresh "$@"
    for pair in $tool; do
        is_off "$pair"
    done
    "$cmake" --build "$build" --target raylane --parallel "$(nproc)" || fail "the tool does not build"

    raylane=$source/$build/bin/raylane
    scene=$source/scenes/birthday.json
    rm "$folder/log"
    cd "$folder"
    "$raylane" render "$scene" --size 40x30 -q -o picture.png
    [ -s picture.png ] || fail "no picture"
    echo 'ATOM      1  CA  ALA A   1       0.000   0.000   0.000  1.00  0.00           C' >atom.pdb
    refuses gemmi-dev "$raylane" render atom.pdb -o atom.png
    refuses libopenexr-dev "$raylane" render "$scene" --size 40x30 -o picture.exr
    refuses libtiff-dev "$raylane" render "$scene" --size 40x30 -o picture.tif
    refuses libpango1.0-dev "$raylane" render "$source/scenes/fullerene.xyz" --size 40x30 --triad xyz -o axes.png
    refuses libsdl2-dev "$raylane" view "$scene"
    refuses libopenmpi-dev env OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0 \
        "$raylane" render "$scene" --size 40x30 -o ranks.png
}

case "${1-}" in
--build)
    shift
    build_without "$@"
    ;;
'')
    hide_each
    search_without_mpi
    ;;
*)
    echo "usage: tests/optional_test.sh [--build [OPTIONS]]" >&2
    exit 2
    ;;
esac
