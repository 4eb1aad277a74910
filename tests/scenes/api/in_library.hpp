#pragma once

#include "core/kinds.hpp"
#include "raylane/shapes.hpp"

namespace raylane::tests {

/// Maps core's shapes to the library's, which have the same names and numbers.
template <class CoreShape>
struct InLibrary;
#define RAYLANE_IN_LIBRARY(Shape, name, text)                                                      \
    template <>                                                                                    \
    struct InLibrary<core::Shape> {                                                                \
        using Type = raylane::Shape;                                                               \
    };                                                                                             \
    template <>                                                                                    \
    struct InLibrary<core::InDouble<core::Shape>> {                                                \
        using Type = raylane::Shape##Of<double>;                                                   \
    };
RAYLANE_SHAPES(RAYLANE_IN_LIBRARY)
#undef RAYLANE_IN_LIBRARY

} // namespace raylane::tests
