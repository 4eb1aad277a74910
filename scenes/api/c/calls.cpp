#include "calls.hpp"

#include <string>

namespace {

thread_local std::string error_text; // NOLINT: in place of an exception's text

} // namespace

raylane_status raylane::c::failed(raylane_status status, const char* text) noexcept {
    try {
        error_text = text;
    } catch (...) {
        error_text.clear();
    }
    return status;
}

const char* raylane_version(void) {
    return raylane::version();
}

int raylane_version_number(void) {
    return raylane::version_number();
}

const char* raylane_error_text(void) {
    return error_text.c_str();
}
