#!/bin/sh
# usage: floors_test.sh SOURCE_DIRECTORY
# Checks that #includes follow the floors and arrows of ARCHITECTURE.md.
cd "$1" || exit 1
failed=0
forbid() { # folder, folders that it must not include from, as an expression of grep -E
    if grep -rnE "^#include \"($2)/" "$1" --include='*.hpp' --include='*.cpp'; then
        echo "$1 must not include from $2"
        failed=1
    fi
}

forbid core 'simd|scenes|bench|tests'
above=
for folder in reference beams optics scene hierarchy solids shapes numbers; do
    [ -z "$above" ] || forbid "core/$folder" "core/($above)"
    above="$above${above:+|}$folder"
done
forbid simd 'scenes|bench|tests'
forbid simd/kernel 'simd/(query|wavefront)'
forbid simd/kernel 'core/(shapes|solids|hierarchy|scene|optics|beams|reference)'
forbid simd/query 'simd/wavefront'
forbid scenes 'bench|tests'
forbid scenes/api/python 'simd|scenes' # it is a user of the library
if grep -rn '^#include "core/' scenes/api/python --include='*.hpp' --include='*.cpp' | grep -v '"core/scene/fields.hpp"' ||
    grep -n '^#include "' core/scene/fields.hpp; then
    echo "scenes/api/python must include only fields.hpp from core, and that header nothing of raylane"
    failed=1
fi
for folder in scenes/*/; do
    case ${folder%/} in
    scenes/api | scenes/tool | scenes/web) ;; # they use the engine
    *) forbid "${folder%/}" 'simd|scenes/(api|tool|web)' ;;
    esac
done

# Functions whose last bits depend on the C library, and with one library on the processor. Those in
# core/numbers have the same bits everywhere.
if grep -rnE 'std::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|cbrt|hypot|[lt]gamma|erfc?)\(' \
    core simd scenes --include='*.hpp' --include='*.cpp' --exclude-dir=examples --exclude='more_functions.cpp'; then
    echo "use the functions of core/numbers/elementary.hpp and more_functions.hpp: the C library's bits differ"
    failed=1
fi
exit $failed
