#pragma once

namespace raylane::tests {

#if defined(__has_feature)
#define RAYLANE_HAS_FEATURE(feature) __has_feature(feature)
#else
#define RAYLANE_HAS_FEATURE(feature) 0
#endif

/// True if the thread sanitizer watches this program. It delays signals.
#if defined(__SANITIZE_THREAD__) || RAYLANE_HAS_FEATURE(thread_sanitizer)
inline constexpr bool thread_sanitized = true;
#else
inline constexpr bool thread_sanitized = false;
#endif

/// True if a sanitizer watches this program, which takes more memory and time then.
#if defined(__SANITIZE_ADDRESS__) || RAYLANE_HAS_FEATURE(address_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = thread_sanitized;
#endif

#undef RAYLANE_HAS_FEATURE

} // namespace raylane::tests
