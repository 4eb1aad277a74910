#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace raylane::simd {

/// While it lives, this thread rounds to nearest, keeps numbers near zero and traps nothing,
/// whatever the program has made of it: a library that was built with -ffast-math turns that off
/// for all as it is loaded.
class DefaultRounding {
  public:
    DefaultRounding(const DefaultRounding&) = delete;
    DefaultRounding& operator=(const DefaultRounding&) = delete;

#if defined(__x86_64__)
    DefaultRounding() : before_(_mm_getcsr()) {
        if ((before_ & ~flags) != standard) _mm_setcsr(standard | (before_ & flags));
    }
    ~DefaultRounding() {
        if ((before_ & ~flags) != standard) _mm_setcsr((before_ & ~flags) | (_mm_getcsr() & flags));
    }

  private:
    /// What has happened, and all exceptions masked.
    static constexpr unsigned flags = 0x3F, standard = 0x1F80;
    unsigned before_;
#else
    DefaultRounding() {
        std::fegetenv(&before_);
        std::fesetenv(FE_DFL_ENV);
    }
    ~DefaultRounding() {
        std::fesetenv(&before_);
    }

  private:
    std::fenv_t before_;
#endif
};

} // namespace raylane::simd
