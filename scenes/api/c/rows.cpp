#include "calls.hpp"

#include <vector>

using namespace raylane;

void raylane_rows_release(raylane_rows* rows) {
    delete rows;
}

size_t raylane_rows_count(const raylane_rows* rows) {
    if (rows == nullptr) return 0;
    return std::visit([](const auto& columns) { return columns.first.size() - 1; }, rows->rows);
}

const uint64_t* raylane_rows_first(const raylane_rows* rows) {
    if (rows == nullptr) return nullptr;
    return std::visit([](const auto& columns) { return columns.first.data(); }, rows->rows);
}

raylane_crossing_statistics raylane_rows_statistics(const raylane_rows* rows) {
    return rows != nullptr ? rows->statistics : raylane_crossing_statistics{};
}

#define RAYLANE_COLUMN(Element, name)                                                              \
    const Element* raylane_rows_##name(const raylane_rows* rows) {                                 \
        if (rows == nullptr) return nullptr;                                                       \
        return std::visit(                                                                         \
            [](const auto& columns) -> const Element* {                                            \
                if constexpr (requires { columns.name; }) {                                        \
                    if (!columns.name.empty()) return columns.name.data();                         \
                }                                                                                  \
                return nullptr;                                                                    \
            },                                                                                     \
            rows->rows);                                                                           \
    }
RAYLANE_COLUMN(double, t)
RAYLANE_COLUMN(double, length)
RAYLANE_COLUMN(uint32_t, shape_id)
RAYLANE_COLUMN(uint32_t, material)
RAYLANE_COLUMN(uint8_t, entering)
RAYLANE_COLUMN(uint8_t, face)
RAYLANE_COLUMN(uint8_t, tied)
RAYLANE_COLUMN(uint8_t, touching)
RAYLANE_COLUMN(uint8_t, inside)
RAYLANE_COLUMN(uint8_t, on_surface)
RAYLANE_COLUMN(float, normal_x)
RAYLANE_COLUMN(float, normal_y)
RAYLANE_COLUMN(float, normal_z)
RAYLANE_COLUMN(double, normal_double_x)
RAYLANE_COLUMN(double, normal_double_y)
RAYLANE_COLUMN(double, normal_double_z)
#undef RAYLANE_COLUMN
