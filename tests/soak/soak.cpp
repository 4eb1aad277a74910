#include "raylane/raylane.hpp"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <malloc.h>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

/// Repeats the same work, as .ci/soak describes. `--leak` and `--wrong` show that it can fail.
using namespace raylane;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int workers = 3;

/// FNV-1a hash of all answers.
class Hash {
  public:
    template <class Value>
    void add(const std::vector<Value>& values) {
        for (const Value& value : values) {
            unsigned char bytes[sizeof(Value)];
            std::memcpy(bytes, &value, sizeof value);
            for (const unsigned char byte : bytes)
                hash_ = (hash_ ^ byte) * 0x100000001b3;
        }
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

std::string text_of(int number) {
    std::string text = R"({"camera": "auto", "materials": {"m": {}}, "objects": [)";
    for (int i = 0; i < 300; ++i)
        text += std::string(i == 0 ? "" : ", ") +
                R"({"type": "sphere", "material": "m", "radius": )" +
                std::to_string(1 + (i + number) % 3) + R"(, "center": [)" + std::to_string(i % 7) +
                ", " + std::to_string(i / 7 % 7) + ", " + std::to_string(i) + "]}";
    return text + "]}";
}

class Work {
  public:
    explicit Work(const std::string& folder)
        : folder_(folder), tracer_(parse(text_of(0), "a.json")) {
        for (int i = 0; i < 20'000; ++i) {
            const auto step = static_cast<float>(i);
            rays_[0].push_back(static_cast<float>(i % 100) / 16.0F);
            rays_[1].push_back(step / 4000.0F);
            rays_[2].push_back(-2.0F + static_cast<float>(i % 3));
            rays_[3].push_back(static_cast<float>(i % 17 - 8) / 8.0F);
            rays_[4].push_back(static_cast<float>(i % 5 - 2) / 8.0F);
            rays_[5].push_back(1.0F);
        }
    }

    static constexpr int count = 7;
    std::uint64_t run(int job) const {
        switch (job) {
        case 0:
        case 1:
        case 2:
            return draw(job);
        case 3:
            return cancel();
        case 4:
            return ask();
        case 5:
            return list();
        default:
            return read();
        }
    }

  private:
    RaySpan span(std::size_t most) const {
        const auto part_of = [&](int which) { return std::span(rays_[which]).first(most); };
        return {part_of(0), part_of(1), part_of(2), part_of(3), part_of(4), part_of(5)};
    }

    std::uint64_t draw(int which) const {
        constexpr const char* names[] = {"birthday", "cutaway", "ellipsoid"};
        const Scene scene = load(folder_ + "/" + names[which] + ".json");
        RenderOptions options{.settings = scene.settings(), .threads = 2, .aovs = which == 1};
        options.settings->width = 96;
        options.settings->height = 72;
        options.settings->grid = 1;
        const Image image = render(scene, options);
        Hash hash;
        hash.add(image.rgb);
        hash.add(image.aovs.shape_id);
        return hash.value();
    }
    std::uint64_t cancel() const {
        RenderOptions options{.settings = tracer_.scene().settings(), .threads = 2};
        options.settings->width = options.settings->height = 400;
        return render(tracer_.scene(), options, [](const Progress&) { return false; }) ? 1 : 0;
    }
    std::uint64_t ask() const {
        std::vector<float> t(rays_[0].size()), x = t, y = t, z = t;
        std::vector<ShapeId> shape(t.size());
        std::vector<std::uint8_t> entering(t.size()), blocked(t.size());
        tracer_.intersect(span(t.size()), {t, x, y, z, shape, entering});
        tracer_.occluded(span(t.size()), blocked);
        Hash hash;
        for (const auto* numbers : {&t, &x, &y, &z})
            hash.add(*numbers);
        hash.add(shape);
        hash.add(blocked);
        return hash.value();
    }
    std::uint64_t list() const {
        const RaySpan part = span(2000);
        CrossingRows rows;
        tracer_.crossings(part, rows, {.normals = true});
        SolidRows solids;
        tracer_.contains(PointSpan{part.origin_x, part.origin_y, part.origin_z}, solids);
        LengthRows lengths;
        tracer_.path_lengths(part, lengths);
        SolidLengthRows of_solids;
        tracer_.solid_lengths(part, of_solids);
        std::vector<double> normal(part.origin_x.size());
        tracer_.intersect(part, {.normal_double_x = normal});
        Hash hash;
        hash.add(rows.t);
        hash.add(rows.shape_id);
        hash.add(rows.normal_x);
        hash.add(solids.shape_id);
        hash.add(lengths.length);
        hash.add(of_solids.length);
        hash.add(normal);
        return hash.value();
    }
    static std::uint64_t read() {
        const Scene scene = parse(text_of(1), "b.json");
        std::string broken = text_of(2);
        broken.resize(broken.size() / 2);
        try {
            parse(broken, "c.json");
            return 0;
        } catch (const BadInput& bad) {
            return scene.shape_count() + std::strlen(bad.what());
        }
    }

    std::string folder_;
    Tracer tracer_;
    std::vector<float> rays_[6];
};

/// Returns the resident memory in MiB.
double resident() {
    std::ifstream file("/proc/self/statm");
    double total = 0.0, pages = 0.0;
    file >> total >> pages;
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// The largest memory in the first minute, or tenth of the time if that is shorter, and the
/// smallest in the last tenth.
struct Memory {
    double first = 0.0, last = 1e9;
    void look(double seconds, double total) {
        const double now = resident();
        if (seconds < std::min(60.0, total / 10)) first = std::max(first, now);
        if (seconds > 0.9 * total) last = std::min(last, now);
    }
    bool is_flat() const { return last <= 1.02 * first + 4.0; }
};

int soak(double minutes, const std::string& folder, bool leaks, bool is_wrong) {
    const Work work(folder);
    std::uint64_t expected[Work::count];
    for (int job = 0; job < Work::count; ++job)
        expected[job] = work.run(job);
    std::atomic<long> done = 0, wrong = 0;
    std::atomic<bool> stop = false;
    std::vector<std::thread> threads;
    for (int worker = 0; worker < workers; ++worker)
        threads.emplace_back([&, worker] {
            for (int turn = worker; !stop; ++turn) {
                const int job = turn % Work::count;
                const bool same = work.run(job) == expected[job];
                const bool counts_as_wrong = !same || (is_wrong && turn == 50);
                wrong += counts_as_wrong ? 1 : 0;
                if (leaks) std::memset(std::malloc(100'000), 1, 100'000); // NOLINT
                ++done;
            }
        });
    Memory memory;
    const auto start = Clock::now();
    const double total = 60.0 * minutes;
    for (double seconds = 0.0; seconds < total && wrong == 0;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200)); // between two looks at memory
        seconds = std::chrono::duration<double>(Clock::now() - start).count();
        memory.look(seconds, total);
    }
    stop = true;
    for (std::thread& thread : threads)
        thread.join();
    std::cout << done << " times, " << wrong << " with other bits; resident " << memory.first
              << " MiB at first, " << memory.last << " at last\n";
    if (wrong == 0 && memory.is_flat()) return 0;
    std::cout << (wrong != 0 ? "the bits are not the same\n" : "memory grows\n");
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    // One heap for all threads. Several heaps each keep their peak size, which adds up by chance
    // for half an hour and would hide a leak.
    mallopt(M_ARENA_MAX, 1);
    const std::string option = argc > 2 ? argv[2] : "";
    return soak(argc > 1 ? std::atof(argv[1]) : 60.0, "scenes", option == "--leak",
                option == "--wrong");
}
