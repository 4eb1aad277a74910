#include "simd/units/kernels.hpp"

#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"

namespace raylane::simd {

namespace {

template <Isa isa>
const Kernels* kernels() {
    using Parts = KernelParts<isa>;
    static const Kernels kernels = {name_of(isa).data(),
                                    Parts::lanes(),
                                    Parts::rays(),
                                    Parts::stream(),
                                    {Parts::in_float(true),
                                     Parts::in_float(false),
                                     {{Parts::nearest(), Parts::occluded()},
                                      Parts::solve(),
                                      Parts::solve_all(),
                                      Parts::refine(),
                                      nullptr},
                                     Parts::in_double()},
                                    {{Parts::shade(false, false), Parts::shade(false, true)},
                                     {Parts::shade(true, false), Parts::shade(true, true)}}};
    return &kernels;
}

} // namespace

const Kernels& kernels_of(Isa isa) {
    return *of_isa(isa, []<Isa which>() { return kernels<which>(); });
}

} // namespace raylane::simd
