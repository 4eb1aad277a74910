#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#else
#include <cfenv>
#endif

namespace raylane::simd {

/// Sets the default floating-point environment for this thread while it lives: rounds to nearest,
/// keeps subnormal numbers and traps nothing. The program may run in another environment: loading a
/// library that was built with -ffast-math turns subnormal numbers off for the whole program.
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
    /// MXCSR: the status flags, and the default control bits, which mask all exceptions.
    static constexpr unsigned flags = 0x3F, standard = 0x1F80;
    unsigned before_;
#elif defined(__aarch64__)
    // The status flags are in another register.
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
