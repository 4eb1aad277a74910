#pragma once

namespace raylane::tests {

#if defined(__has_feature)
#define RAYLANE_HAS_FEATURE(feature) __has_feature(feature)
#else
#define RAYLANE_HAS_FEATURE(feature) 0
#endif

/// True if a sanitizer watches this program, which takes more memory and time then.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) ||                               \
    RAYLANE_HAS_FEATURE(address_sanitizer) || RAYLANE_HAS_FEATURE(thread_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

#undef RAYLANE_HAS_FEATURE

} // namespace raylane::tests
