#include "raylane/version.hpp"

namespace raylane {

const char* version() noexcept {
    return RAYLANE_VERSION;
}

int version_number() noexcept {
    return RAYLANE_VERSION_NUMBER;
}

} // namespace raylane
