#!/bin/sh
# usage: floors_test.sh SOURCE_DIRECTORY
# Checks that #includes follow the floors and arrows of ARCHITECTURE.md.
cd "$1" || exit 1
failed=0

# Each folder with sources needs a rule, `FOLDER ...: PLACE ...`: the folders include from themselves and from the places,
# which are folders or headers. /* stands for a folder and all in it. Those `in order` also include from all before them.
rules() {
    cat <<'END'
in order: core core/numbers core/shapes core/solids core/hierarchy core/scene core/optics core/beams core/reference

simd/isa: simd/units
simd/kernel/*: simd/isa simd/units core/kinds.hpp core/numbers/elementary.hpp core/numbers/formula_program.hpp
simd/kernel/*: core/numbers/sample_sequence.hpp
simd/units: simd/kernel/* simd/isa core core/numbers core/optics
simd/threads: core/* simd/isa
simd/query: core/* simd/threads simd/units
simd/stream simd/first_hits simd/wavefront: core/* simd/isa simd/query simd/threads simd/units
simd/first_hits: simd/wavefront
simd/wavefront: simd/first_hits

scenes/files scenes/images: core/* scenes/files scenes/images
scenes/formats: core/* scenes/files scenes/formats/*
scenes/formats/json scenes/formats/nff scenes/formats/pov scenes/formats/tachyon: core/* scenes/files scenes/formats
scenes/formats/structure/*: core/* scenes/files scenes/formats
scenes/formats/json scenes/formats/pov: scenes/images
scenes/formats/tachyon: scenes/formats/nff
scenes/formats/built: core/* scenes/files scenes/formats/json scenes/export
scenes/export: core/* scenes/files scenes/formats/built scenes/formats/json scenes/formats/pov
scenes/annotation: core/* scenes/files scenes/formats/structure
scenes/tool/*: scenes/annotation core/* simd/* scenes/export scenes/files scenes/formats/* scenes/images scenes/api/cpp/raylane
scenes/api/cpp: core/* simd/* scenes/annotation scenes/export scenes/files scenes/formats scenes/formats/structure scenes/images raylane
scenes/api/cpp/raylane scenes/api/examples: raylane
scenes/api/c: raylane scenes/api/cpp
scenes/api/python: raylane core/scene/fields.hpp
scenes/web: raylane core/scene

bench/*: core/* simd/* scenes/* raylane
bench: tests/support/ray_sets.hpp tests/scenes/api/ray_arrays.hpp
tests/*: core/* simd/* scenes/* raylane bench
END
}

sources() { find core simd scenes bench tests -name '*.[hc]pp' "$@"; }
{
    rules
    sources -exec dirname {} + | sort -u | sed 's/^/folder /'
    sources -exec grep -HE '^ *# *include "[^ "]*"' {} + | sed 's/: *# *include "/ includes /; s/".*//'
} | awk '
    function is_in(folder, place) {
        return folder == place || (sub("/[*]$", "", place) && index(folder "/", place "/") == 1)
    }
    function folder_of(file) { sub("/[^/]*$", "", file); return file }
    function refuse(message) { print message; failed = 1 }

    /^in order:/ {
        for (i = 3; i <= NF; ++i) {
            places[$i] = before " " $i
            before = places[$i]
        }
    }
    /: / && !/^in order/ {
        split($0, sides, ":")
        number = split(sides[1], names, " ")
        for (i = 1; i <= number; ++i)
            places[names[i]] = places[names[i]] " " names[i] " " sides[2]
    }
    $1 == "folder" {
        for (rule in places)
            if (is_in($2, rule)) {
                allowed[$2] = allowed[$2] " " places[rule]
                is_used[rule] = 1
            }
        if (!($2 in allowed)) refuse($2 " has no rule in tests/floors_test.sh")
    }
    $2 == "includes" && $3 ~ "/" {
        number = split(allowed[folder_of($1)], names, " ")
        for (i = 1; i <= number; ++i)
            if ($3 == names[i] || is_in(folder_of($3), names[i])) next
        refuse($1 " must not include " $3)
    }
    END {
        for (rule in places)
            if (!(rule in is_used)) refuse("tests/floors_test.sh has a rule for " rule ", which has no sources")
        exit failed
    }' || failed=1
if grep -n '^#include "' core/scene/appearance.hpp core/scene/fields.hpp | grep -v '"core/scene/appearance.hpp"'; then
    echo "core/scene/fields.hpp must include enumerators alone: scenes/api/python is a user of the library"
    failed=1
fi

# Functions whose last bits depend on the C library, and with one library on the processor. Those in
# core/numbers have the same bits everywhere.
if grep -rnE 'std::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|cbrt|hypot|[lt]gamma|erfc?)\(' \
    core simd scenes --include='*.hpp' --include='*.cpp' --exclude-dir=examples --exclude='more_functions.cpp'; then
    echo "use the functions of core/numbers/elementary.hpp and more_functions.hpp: the C library's bits differ"
    failed=1
fi
exit $failed
