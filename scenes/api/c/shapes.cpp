#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <variant>

/// The shapes of a scene, as they were given.
using namespace raylane;
using namespace raylane::c;

namespace {

/// Copies at most `size` values to an array, which may be null.
template <class Value, class To>
void copy_to(To* to, const std::vector<Value>& values, std::size_t size) {
    static_assert(sizeof(Value) == sizeof(To));
    if (to != nullptr && !values.empty())
        std::memcpy(to, values.data(), std::min(size, values.size()) * sizeof(To));
}

template <template <class> class ShapeOf, class CShape>
raylane_status shapes_of(const raylane_scene* scene, std::uint32_t* ids, std::uint32_t* materials,
                         CShape* shapes, std::size_t size, std::size_t* count) noexcept {
    return guarded([&] {
        const auto found = checked("scene", scene).scene.shapes<ShapeOf>();
        copy_to(ids, found.id, size);
        copy_to(materials, found.material, size);
        copy_to(shapes, found.shape, size);
        if (count != nullptr) *count = found.id.size();
    });
}

} // namespace

raylane_status raylane_scene_shape(const raylane_scene* scene, uint32_t shape_id, int* type,
                                   double* numbers) {
    return guarded([&] {
        const ShapeVariant shape = checked("scene", scene).scene.shape(shape_id);
        static_assert(std::variant_size_v<ShapeVariant> == RAYLANE_ELLIPSOID + 1);
        checked("type", type) = static_cast<int>(shape.index());
        std::visit(
            [&]<class Shape>(const Shape& found) {
                static_assert(sizeof(Shape) <= RAYLANE_MAX_NUMBERS * sizeof(double));
                std::memcpy(&checked("numbers", numbers), &found, sizeof found);
            },
            shape);
    });
}

#define RAYLANE_SHAPES_OF(shapes, shape, Shape, c_shape)                                           \
    raylane_status raylane_scene_##shapes(const raylane_scene* scene, uint32_t* ids,               \
                                          uint32_t* materials, raylane_double_##c_shape* values,   \
                                          size_t size, size_t* count) {                            \
        return shapes_of<Shape##Of>(scene, ids, materials, values, size, count);                   \
    }
RAYLANE_C_SHAPES(RAYLANE_SHAPES_OF)
#undef RAYLANE_SHAPES_OF
