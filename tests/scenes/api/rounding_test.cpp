#include "raylane/raylane.hpp"
#include "tests/support/catch.hpp"

#include <cfenv>
#include <cstdint>
#include <vector>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

using namespace raylane;

namespace {

/// Sets rounding that a program may use, during its lifetime: upward, with denormal numbers flushed
/// to zero.
class OddRounding {
  public:
    OddRounding() {
        std::fegetenv(&before_);
        std::fesetround(FE_UPWARD);
#if defined(__x86_64__)
        _mm_setcsr(_mm_getcsr() | 0x8040);
#elif defined(__aarch64__)
        set_control(control() | flush_to_zero);
#endif
    }
    ~OddRounding() {
        std::fesetenv(&before_);
    }
    OddRounding(const OddRounding&) = delete;
    OddRounding& operator=(const OddRounding&) = delete;

    static bool is_on() {
#if defined(__x86_64__)
        if ((_mm_getcsr() & 0xFFC0) != (0x1F80 | 0x8040 | 0x4000)) return false;
#elif defined(__aarch64__)
        if ((control() & flush_to_zero) == 0) return false;
#endif
        return std::fegetround() == FE_UPWARD;
    }

  private:
#if defined(__aarch64__)
    static constexpr std::uint64_t flush_to_zero = 1U << 24;
    static std::uint64_t control() {
        std::uint64_t fpcr = 0;
        __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
        return fpcr;
    }
    static void set_control(std::uint64_t fpcr) {
        __asm__ volatile("msr fpcr, %0" : : "r"(fpcr));
    }
#endif
    std::fenv_t before_{};
};

/// Returns balls whose numbers are computed once, before the rounding changes.
const std::vector<SphereOf<double>>& balls() {
    static const std::vector<SphereOf<double>> spheres = [] {
        std::vector<SphereOf<double>> result;
        for (int i = 0; i < 300; ++i)
            result.push_back(
                {{i % 7 / 3.0 - 1, i % 11 / 5.0 - 1, i % 13 / 6.0 - 1}, 0.1 + i % 3 / 30.0});
        return result;
    }();
    return spheres;
}

Scene crowd() {
    SceneBuilder builder;
    builder.settings.width = 40;
    builder.settings.height = 30;
    builder.add_light({.position = {4, 5, 6}});
    const MaterialIndex material = builder.add_material({.specular = 0.5F, .reflectivity = 0.3F});
    for (const SphereOf<double>& ball : balls())
        builder.add(ball, material);
    return builder.build();
}

struct Answers {
    std::vector<float> t, normal, rgb;
    std::vector<double> t_double, crossings;
    Bounds bounds;

    explicit Answers(const Scene& scene, int threads, std::size_t count = 8192) {
        std::vector<float> at[6];
        for (std::size_t i = 0; i < count; ++i) {
            const auto step = static_cast<float>(i);
            at[0].push_back(step / 4096 - 1);
            at[1].push_back(static_cast<float>(i % 64) / 32 - 1);
            at[2].push_back(5);
            at[3].push_back(static_cast<float>(i % 5) / 64);
            at[4].push_back(static_cast<float>(i % 3) / 64);
            at[5].push_back(-1);
        }
        const RaySpan rays{at[0], at[1], at[2], at[3], at[4], at[5]};
        t.resize(count), normal.resize(count), t_double.resize(count);
        const Tracer tracer(scene, {.threads = threads});
        tracer.intersect(rays, {.t = t, .normal_x = normal, .t_double = t_double});
        CrossingRows rows;
        tracer.crossings(rays, rows);
        crossings = rows.t;
        rgb = render(scene, {.threads = threads}).rgb;
        bounds = scene.bounds();
    }
    bool operator==(const Answers& other) const {
        return t == other.t && normal == other.normal && rgb == other.rgb &&
               t_double == other.t_double && crossings == other.crossings &&
               bounds.lower == other.bounds.lower && bounds.upper == other.bounds.upper;
    }
};

} // namespace

TEST_CASE("answers do not depend on the caller's rounding and the rounding stays") {
    // Numbers of threads that no other test uses: the first call creates the threads that are
    // reused.
    for (const int threads : {1, 23, 29}) {
        const Answers expected(crowd(), 1);
        {
            const OddRounding rounding;
            CHECK(Answers(crowd(), threads) == expected);
            CHECK(Answers(crowd(), threads, 100).bounds.lower == expected.bounds.lower);
            CHECK(OddRounding::is_on());
            CHECK_THROWS_AS(crowd().seen_by({.field_of_view = 0}), InvalidValue);
            CHECK(OddRounding::is_on());
        }
        CHECK(Answers(crowd(), threads) == expected);
    }
}
