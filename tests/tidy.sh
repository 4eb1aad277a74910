#!/bin/sh
# clang-tidy of the sources in core, simd and scenes. A file takes it ten seconds.
set -eu
cd "$(dirname "$0")/.."

# The kernels, thousands of instances of the same templates, would take longer than all the rest. What is
# for WebAssembly alone includes what this compiler does not have.
cmake --fresh --preset release -B build/tidy -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DRAYLANE_UNITY=OFF -DRAYLANE_BENCHMARKS=OFF -DRAYLANE_TESTS=OFF
# The check that is left out takes as long as all others.
git ls-files 'core/*.cpp' 'simd/*.cpp' 'scenes/*.cpp' ':!simd/units/*' ':!simd/native_isa.cpp' ':!scenes/examples/*' ':!scenes/web/*' |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet --warnings-as-errors='*' -p build/tidy \
        --checks=-performance-unnecessary-value-param
