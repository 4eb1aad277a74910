#!/bin/sh
# Runs clang-tidy on the sources in core, simd and scenes. A file takes ten seconds.
set -eu
cd "$(dirname "$0")/.."

# The kernels are left out: as thousands of instances of the same templates, they would take longer
# than all the rest. Sources for WebAssembly alone include headers that this compiler does not have.
cmake --fresh --preset release -B build/tidy -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DRAYLANE_UNITY=OFF -DRAYLANE_BENCHMARKS=OFF -DRAYLANE_TESTS=OFF
# The disabled check takes as long as all others.
git ls-files 'core/*.cpp' 'simd/*.cpp' 'scenes/*.cpp' ':!simd/units/*' ':!simd/isa/runnable_isas.cpp' ':!scenes/api/examples/*' ':!scenes/web/*' |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet --warnings-as-errors='*' -p build/tidy \
        --checks=-performance-unnecessary-value-param
