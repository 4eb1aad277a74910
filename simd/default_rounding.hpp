#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
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
#elif defined(__aarch64__)
    // What has happened is in a register of its own.
    DefaultRounding() : before_(control()) {
        if (before_ != standard) set_control(standard);
    }
    ~DefaultRounding() {
        if (before_ != standard) set_control(before_);
    }

  private:
    static std::uint64_t control() {
        std::uint64_t fpcr = 0;
        __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
        return fpcr;
    }
    static void set_control(std::uint64_t fpcr) {
        __asm__ volatile("msr fpcr, %0" : : "r"(fpcr));
    }

    static constexpr std::uint64_t standard = 0;
    std::uint64_t before_;
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
