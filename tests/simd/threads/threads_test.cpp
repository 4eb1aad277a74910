#include "simd/threads/threads.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comes_true.hpp"
#include "tests/support/sanitized.hpp"

#include <atomic>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace raylane;

namespace {

/// Runs as many tasks as threads, each of which waits for the others. Returns whether they ran at
/// once.
bool meets(int threads) {
    std::atomic<int> running = 0;
    simd::on_threads(threads, [&] {
        simd::parallel_for(static_cast<std::size_t>(threads), [&](std::size_t) {
            ++running;
            tests::comes_true([&] { return running >= threads; });
        });
    });
    return running == threads;
}

double resident_kilobytes() {
    std::ifstream file("/proc/self/statm");
    double size = 0.0, pages = 0.0;
    file >> size >> pages;
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1024.0;
}

} // namespace

TEST_CASE("successive calls have as many threads as each requests", "[threads]") {
    for (const int threads : {1, 3, 2, 3, 5, 1, 2})
        CHECK(meets(threads));
}

TEST_CASE("concurrent and nested calls do not share their threads", "[threads]") {
    std::atomic<int> done = 0;
    const auto call = [&] {
        for (int round = 0; round < 20; ++round)
            simd::on_threads(2, [&] {
                simd::parallel_for(4, [&](std::size_t) {
                    simd::on_threads(2,
                                     [&] { simd::parallel_for(3, [&](std::size_t) { ++done; }); });
                });
            });
    };
    std::vector<std::thread> callers;
    for (int i = 0; i < 3; ++i)
        callers.emplace_back(call);
    for (std::thread& caller : callers)
        caller.join();
    CHECK(done == 3 * 20 * 4 * 3);
}

TEST_CASE("an exception propagates out of a call with threads and later calls work", "[threads]") {
    for (int i = 0; i < 3; ++i)
        CHECK_THROWS_AS(simd::on_threads(2,
                                         [] {
                                             simd::parallel_for(8, [](std::size_t task) {
                                                 if (task == 5) throw std::runtime_error("task");
                                             });
                                         }),
                        std::runtime_error);
    CHECK(meets(2));
}

TEST_CASE("thousands of calls with threads take no more memory than hundreds", "[threads]") {
    if (tests::sanitized) return; // a sanitizer keeps released memory
    const auto call = [](int times) {
        for (int i = 0; i < times; ++i) {
            std::atomic<int> done = 0;
            simd::on_threads(2 + i % 3,
                             [&] { simd::parallel_for(8, [&](std::size_t) { ++done; }); });
            if (done != 8) return false;
        }
        return true;
    };
    CHECK(call(200));
    const double before = resident_kilobytes();
    CHECK(call(3000));
    CHECK(resident_kilobytes() - before < 2000.0);
}
