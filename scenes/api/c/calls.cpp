#include "calls.hpp"

#include <string>

namespace {

thread_local std::string error_text;   // NOLINT: in place of an exception's text
thread_local std::string kept_remarks; // NOLINT: in place of a callback

} // namespace

raylane::OnRemark raylane::c::keeping_remarks() {
    kept_remarks.clear();
    return [](const std::string& remark) {
        if (!kept_remarks.empty()) kept_remarks += '\n';
        kept_remarks += remark;
    };
}

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

const char* raylane_remarks(void) {
    return kept_remarks.c_str();
}

const char* raylane_error_text(void) {
    return error_text.c_str();
}
