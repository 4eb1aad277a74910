#pragma once

#include "simd/kernel/certify/exact.hpp"
#include "simd/kernel/certify/in_double.hpp"
#include "simd/kernel/certify/plain.hpp"
#include "simd/kernel/shade/shade.hpp"
#include "simd/kernel/stream/stream.hpp"
#include "simd/kernel/traverse/prepare.hpp"
#include "simd/kernel/traverse/traverse.hpp"
#include "simd/kernels.hpp"

namespace raylane::simd {

template <class Arch>
struct KernelsOf {
    static constexpr int lanes = static_cast<int>(Floats<Arch>::size);

    template <class Method>
    static constexpr MethodKernels method() {
        return {Trace<Arch, Method>::table(), Method::finish, Method::finish_all, Method::refine(),
                Method::nearest_of_few};
    }

    static constexpr Kernels table(const char* name) {
        return {name,
                lanes,
                Prepare<Arch>::table(),
                CallerStream<Arch>::table(),
                {method<PlainMethod<Arch, true>>(), method<PlainMethod<Arch, false>>(),
                 method<ExactMethod<Arch>>(), method<DoubleMethod<Arch>>()},
                {{Shading<Double<Arch>, false, false>::table(),
                  Shading<Double<Arch>, false, true>::table()},
                 {Shading<Double<Arch>, true, false>::table(),
                  Shading<Double<Arch>, true, true>::table()}}};
    }
};

} // namespace raylane::simd
