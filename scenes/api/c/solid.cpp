#include "calls.hpp"
#include "values.hpp"

#include <bit>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::c;

namespace {

static_assert(RAYLANE_NO_MATERIAL == ~MaterialIndex(0)); // core::no_material

std::vector<Solid> parts_of(const char* name, const raylane_solid* const* parts,
                            std::size_t count) {
    std::vector<Solid> result;
    for (const raylane_solid* const& part : span_of(name, parts, count)) {
        const std::string place = std::string(name) + "/" + std::to_string(result.size());
        result.push_back(checked(place.c_str(), part).solid);
    }
    return result;
}

/// Stores the solid that `make` returns, with a material, in a new handle.
template <class Make>
raylane_status solid_made(const Make& make, std::uint32_t material,
                          raylane_solid** solid) noexcept {
    return handle_of("solid", solid, [&] { return make().of(material); });
}

} // namespace

#define RAYLANE_SOLID_OF(shapes, shape, Shape, c_shape)                                            \
    raylane_status raylane_solid_##shape(const raylane_double_##c_shape* value, uint32_t material, \
                                         raylane_solid** solid) {                                  \
        return handle_of("solid", solid, [&] {                                                     \
            return Solid(std::bit_cast<Shape##Of<double>>(checked("shape", value)), material);     \
        });                                                                                        \
    }
RAYLANE_C_SHAPES(RAYLANE_SOLID_OF)
#undef RAYLANE_SOLID_OF

raylane_lens raylane_default_lens(void) {
    return std::bit_cast<raylane_lens>(Lens{});
}

raylane_status raylane_solid_lens(const raylane_lens* lens, uint32_t material,
                                  raylane_solid** solid) {
    return solid_made([&] { return solid_of(std::bit_cast<Lens>(checked("lens", lens))); },
                      material, solid);
}

raylane_status raylane_solid_union(const raylane_solid* const* parts, size_t count,
                                   uint32_t material, raylane_solid** solid) {
    return solid_made([&] { return union_of(parts_of("parts", parts, count)); }, material, solid);
}

raylane_status raylane_solid_intersection(const raylane_solid* const* parts, size_t count,
                                          uint32_t material, raylane_solid** solid) {
    return solid_made([&] { return intersection_of(parts_of("parts", parts, count)); }, material,
                      solid);
}

raylane_status raylane_solid_difference(const raylane_solid* whole,
                                        const raylane_solid* const* taken_away, size_t count,
                                        uint32_t material, raylane_solid** solid) {
    const auto make = [&] {
        return difference_of(checked("whole", whole).solid,
                             parts_of("taken_away", taken_away, count));
    };
    return solid_made(make, material, solid);
}

raylane_status raylane_solid_clipped(const raylane_solid* whole, const raylane_solid* const* by,
                                     size_t count, uint32_t material, raylane_solid** solid) {
    return solid_made(
        [&] { return clipped(checked("whole", whole).solid, parts_of("by", by, count)); }, material,
        solid);
}

raylane_status raylane_solid_of_material(const raylane_solid* solid, uint32_t material,
                                         raylane_solid** result) {
    return solid_made([&] { return checked("solid", solid).solid; }, material, result);
}

void raylane_solid_release(raylane_solid* solid) {
    delete solid;
}
