#include "calls.hpp"

#include <vector>

using namespace raylane;

void raylane_rows_release(raylane_rows* rows) {
    delete rows;
}

size_t raylane_rows_count(const raylane_rows* rows) {
    if (rows == nullptr) return 0;
    return std::visit([](const auto& of) { return of.first.size() - 1; }, rows->rows);
}

const uint64_t* raylane_rows_first(const raylane_rows* rows) {
    if (rows == nullptr) return nullptr;
    return std::visit([](const auto& of) { return of.first.data(); }, rows->rows);
}

#define RAYLANE_COLUMN(Element, name, member)                                                      \
    const Element* raylane_rows_##name(const raylane_rows* rows) {                                 \
        if (rows == nullptr) return nullptr;                                                       \
        return std::visit(                                                                         \
            [](const auto& of) -> const Element* {                                                 \
                if constexpr (requires { of.member; }) {                                           \
                    if (!of.member.empty()) return of.member.data();                               \
                }                                                                                  \
                return nullptr;                                                                    \
            },                                                                                     \
            rows->rows);                                                                           \
    }
RAYLANE_COLUMN(double, t, t)
RAYLANE_COLUMN(double, length, length)
RAYLANE_COLUMN(uint32_t, shape_id, shape_id)
RAYLANE_COLUMN(uint32_t, material, material)
RAYLANE_COLUMN(uint8_t, entering, entering)
RAYLANE_COLUMN(uint8_t, face, face)
RAYLANE_COLUMN(uint8_t, tied, tied)
RAYLANE_COLUMN(uint8_t, touching, touching)
RAYLANE_COLUMN(uint8_t, inside, inside)
RAYLANE_COLUMN(uint8_t, on_surface, on_surface)
RAYLANE_COLUMN(float, normal_x, normal_x)
RAYLANE_COLUMN(float, normal_y, normal_y)
RAYLANE_COLUMN(float, normal_z, normal_z)
#undef RAYLANE_COLUMN
