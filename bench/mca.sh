#!/bin/sh
# Compares the speed of the AVX-512 filters with the limit that the processor sets to their code: the bounds
# of one shape for packet after packet of rays, as frusta and lists compute them. The limit comes from llvm-mca's
# model of a processor, the speed from raylane-bench on this one.
#
#   bench/mca.sh [BUILD]   BUILD: a Release build with raylane-bench; default build/release
#
# Environment: LLVM_MCA, the program (Debian's package llvm; the newest that is found); MCPU, the
# processor to model (this one if llvm-mca knows its AVX-512 units, otherwise icelake-server);
# REPETITIONS of each measurement (9), of which the median counts.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
repetitions=${REPETITIONS:-9}
kinds=$(sed -n 's/^ *SHAPE([^"]*"\([^"]*\)").*/\1/p' core/kinds.hpp | paste -sd, -)
count=$(echo "$kinds" | awk -F, '{ print NF }')

fail() {
    echo "mca.sh: $*" >&2
    exit 2
}
for file in bin/raylane-bench compile_commands.json; do
    [ -e "$build/$file" ] || fail "no $build/$file; cmake --preset release leads to one"
done
grep -q avx512dq /proc/cpuinfo || fail "this processor has no AVX-512"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mca=${LLVM_MCA:-}
if [ -z "$mca" ]; then
    for program in $(seq -f llvm-mca-%.0f 30 -1 14) llvm-mca; do
        if command -v "$program" >"$work/mca"; then
            mca=$(cat "$work/mca")
            break
        fi
    done
fi
command -v "${mca:-llvm-mca}" >"$work/mca" || fail "no llvm-mca here; Debian's package llvm has it"

models() { # processor: whether llvm-mca knows its AVX-512 units
    echo 'vfmadd231ps %zmm0, %zmm1, %zmm2' >"$work/probe.s"
    "$mca" -mtriple=x86_64 -mcpu="$1" "$work/probe.s" >"$work/probe" 2>&1
}
llc=$(echo "$mca" | sed 's/llvm-mca\([^/]*\)$/llc\1/') # of the same package
mcpu=${MCPU:-$("$llc" --version 2>/dev/null | sed -n 's/.*Host CPU: //p')}
mcpu=${mcpu:-native}
if ! models "$mcpu"; then
    [ -z "${MCPU:-}" ] || fail "$mca: no model of $mcpu with AVX-512"
    mcpu=icelake-server
    models $mcpu || fail "$mca cannot model $mcpu: $(head -n 1 "$work/probe")"
fi

# Takes the kernels with the library's headers, compiler and flags, and everything inlined: each becomes
# a function with one loop, which has no branches inside. If the compiler leaves a call in the library's
# loop, the measured rate includes it, but the bound does not.
{
    echo '#include "simd/kernel/kernels.hpp"'
    echo 'using namespace raylane::simd;'
    echo 'using Method = ExactMethod<Avx512>;'
    for kind in $(seq 0 $((count - 1))); do
        cat <<END
extern "C" [[gnu::flatten]] void loop_$kind(const float (*rows)[16], int lane,
                                            const RoundedRays& rays, const Candidates& candidates,
                                            std::size_t count) {
    Method::with_filter(raylane::core::Kind($kind), [&]<class Filter>() {
        const Filter filter(BroadcastReader<Avx512>(rows, lane));
        for (std::size_t i = 0; i < count; i += 16) {
            const RayLanes<Avx512, Method> packet(rays, i);
            LaneCandidates<Avx512> found(candidates, i);
            found.take(filter.bounds(packet.rays), packet.elsewhere(0), 0);
            found.store(candidates, i);
        }
    });
}
END
    done
} >"$work/loops.cpp"
compile=$(sed -n 's/^ *"command": "\(.*RAYLANE_ISA=avx512.*\) -o .*\/simd\/units\/nearest\.cpp",*$/\1/p' \
    "$build/compile_commands.json")
[ -n "$compile" ] || fail "$build/compile_commands.json does not say how to build the kernels"
eval "$compile -S -o $work/loops.s $work/loops.cpp"

# Prints the longest stretch of function loop_KIND from a label to a jump back to it, without other labels.
loop_of() {
    awk -v name="loop_$1" '
        $1 == name ":" { inside = 1; next }
        inside && /^\t\.size/ { exit }
        !inside { next }
        /^\.L[A-Za-z0-9_]*:/ { label = substr($1, 1, length($1) - 1); n = 0; next }
        $1 ~ /^j/ {
            if ($2 == label && n > best) {
                best = n
                found = text[1]
                for (i = 2; i <= n; ++i) found = found "\n" text[i]
                found = found "\n" $0
            }
            label = "" # what follows is no loop from there
            next
        }
        /^\t[a-z]/ { text[++n] = $0 }
        END { print found }' "$work/loops.s"
}

: >"$work/cycles"
for kind in $(seq 0 $((count - 1))); do
    {
        echo '# LLVM-MCA-BEGIN'
        loop_of $kind
        echo '# LLVM-MCA-END'
    } >"$work/loop.s"
    grep -q zmm "$work/loop.s" || fail "no loop of whole registers in the code for kind $kind"
    "$mca" -mtriple=x86_64 -mcpu="$mcpu" -iterations=1000 -resource-pressure=false \
        -instruction-info=false "$work/loop.s" >"$work/report" 2>"$work/errors" ||
        fail "$mca: $(cat "$work/errors")"
    awk '/^Iterations:/ { n = $2 } /^Total Cycles:/ { cycles = $3 }
         /^Block RThroughput:/ { print $3, cycles / n }' "$work/report" >>"$work/cycles"
done

# Measures cycles per second: an addition that waits for the previous one takes one cycle.
cat >"$work/frequency.cpp" <<'END'
#include <algorithm>
#include <chrono>
#include <cstdio>
int main() {
    using Clock = std::chrono::steady_clock;
    double best = 0;
    for (int attempt = 0; attempt < 1000; ++attempt) {
        unsigned long sum = 0, one = 1;
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < 10000; ++i)
            __asm__ volatile(".rept 100\n\tadd %1, %0\n\t.endr" : "+r"(sum) : "r"(one));
        const std::chrono::duration<double> seconds = Clock::now() - start;
        best = std::max(best, 1e6 / seconds.count());
    }
    std::printf("%.0f\n", best);
}
END
${CXX:-c++} -std=c++17 -O2 -o "$work/frequency" "$work/frequency.cpp"
frequency=$("$work/frequency")

"$build/bin/raylane-bench" --benchmark_filter='/(scalar|bounds/avx512)$' \
    --benchmark_repetitions="$repetitions" --benchmark_min_time=0.05 \
    --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true \
    --benchmark_format=csv >"$work/measured.csv" 2>"$work/errors" ||
    fail "raylane-bench: $(cat "$work/errors")"
again=$("$work/frequency")

echo "model: $("$mca" --version | sed -n 's/.*LLVM version/LLVM/p'), -mcpu=$mcpu" \
    "(this is: $(sed -n 's/^model name[^:]*: //p;' /proc/cpuinfo | head -n 1)," \
    "family $(sed -n 's/^cpu family[^:]*: //p' /proc/cpuinfo | head -n 1)," \
    "model $(sed -n 's/^model\t[^:]*: //p' /proc/cpuinfo | head -n 1))"
echo "core: $(awk -v a="$frequency" -v b="$again" \
    'BEGIN { printf "%.2f GHz before, %.2f GHz after", a / 1e9, b / 1e9 }')"
echo 'Cycles per packet of 16 rays: by the units alone, and with what waits for what. Rates in 10^9'
echo 'rays x shapes per second; the shares are of the rates that these cycles allow.'
awk -F, -v kinds="$kinds" -v frequency="$frequency" -v again="$again" '
    FNR == 1 { ++file }
    file == 1 { split($0, cycles, " "); units[FNR] = cycles[1]; waits[FNR] = cycles[2]; next }
    { gsub(/"/, "") }
    $1 == "name" { for (i = 1; i <= NF; ++i) if ($i == "items_per_second") column = i; next }
    column && $1 ~ /_median$/ { sub(/_median$/, "", $1); rate[$1] = $column }
    END {
        if (again > frequency) frequency = again
        printf "%-16s %7s %7s %8s %8s %8s %8s %8s %8s\n", "kind", "units", "waits", "bound",
            "measured", "of units", "of waits", "scalar", "times"
        n = split(kinds, kind, ",")
        for (k = 1; k <= n; ++k) {
            measured = rate[kind[k] "/bounds/avx512"]
            scalar = rate[kind[k] "/scalar"]
            rays = 16 * frequency
            printf "%-16s %7.1f %7.1f %8.2f %8.2f %7.0f%% %7.0f%% %8.3f %8.1f\n", kind[k],
                units[k], waits[k], rays / units[k] / 1e9, measured / 1e9,
                100 * measured * units[k] / rays, 100 * measured * waits[k] / rays, scalar / 1e9,
                measured / scalar
        }
    }' "$work/cycles" "$work/measured.csv"
