#include "core/hierarchy/packing.hpp"
#include "core/shapes/material_indices.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

namespace {

constexpr float denormal = std::numeric_limits<float>::denorm_min();
constexpr float tiny = std::numeric_limits<float>::min();
constexpr float huge = coordinate_limit;

bool same_bits(const Block<Sphere>& a, const Block<Sphere>& b) {
    return std::memcmp(&a, &b, sizeof a) == 0; // empty lanes hold NaN
}

float with_pattern(std::uint32_t pattern) {
    return std::bit_cast<float>(pattern);
}

std::uint32_t pattern_of(float number) {
    return std::bit_cast<std::uint32_t>(number);
}

/// Packs a single block.
PackedSpheres packed_alone(const Block<Sphere>& block, const RadiusPalette& palette) {
    PackedSpheres packed;
    packed.palette = palette;
    packed.blocks = BigArray<PackedBlock>(1);
    packed.rows =
        BigArray<PackedSpheres::Row>(static_cast<std::size_t>(whole_rows(block, palette)));
    packed.blocks[0] = pack(block, palette, 0, packed.rows.data());
    return packed;
}

void check_exact(const Block<Sphere>& block, const RadiusPalette& palette) {
    const PackedSpheres packed = packed_alone(block, palette);
    CHECK(same_bits(packed.block(0), block));
    for (int lane = 0; lane < block_size; ++lane) {
        CHECK(packed.id(0, lane) == block.ids[lane]);
        if (block.ids[lane] == no_shape) continue;
        CHECK(numbers_of(packed.get(0, lane)) == numbers_of(block.get(lane)));
    }
}

/// Returns a number that makes packing hard.
float hard_number(Random& random, float near) {
    switch (random.integer(0, 9)) {
    case 0:
        return random.integer(0, 1) == 0 ? 0.0F : -0.0F;
    case 1:
        return denormal * static_cast<float>(random.integer(-3, 3));
    case 2:
        return tiny * static_cast<float>(random.uniform(-2.0, 2.0));
    case 3:
        return random.integer(0, 1) == 0 ? huge : -huge;
    case 4:
        return -near;
    default:
        return with_pattern(pattern_of(near) + static_cast<std::uint32_t>(random.integer(0, 3)));
    }
}

Block<Sphere> hard_block(Random& random, int count) {
    Block<Sphere> block;
    const bool is_hard[] = {random.integer(0, 1) == 0, random.integer(0, 1) == 0,
                            random.integer(0, 3) == 0};
    float near[3];
    for (float& of_axis : near)
        of_axis = static_cast<float>(random.log_uniform(1e-30, 1e29)) *
                  (random.integer(0, 1) == 0 ? 1.0F : -1.0F);
    for (int lane = 0; lane < count; ++lane) {
        Sphere sphere{};
        for (int axis = 0; axis < 3; ++axis)
            sphere.center[axis] =
                is_hard[axis]
                    ? hard_number(random, near[axis])
                    : with_pattern(pattern_of(near[axis]) +
                                   static_cast<std::uint32_t>(random.integer(0, (1 << 24) - 1)));
        sphere.radius = random.integer(0, 20) == 0
                            ? static_cast<float>(random.log_uniform(1e-38, 1e30))
                            : static_cast<float>(random.integer(1, 4));
        block.set(lane, sphere, static_cast<ShapeId>(random.integer(0, 999'999)));
    }
    return block;
}

RadiusPalette palette_of(const std::vector<float>& radii, std::size_t id_count) {
    RadiusPalette palette(id_count);
    for (const float radius : radii)
        palette.add(radius);
    return palette;
}

} // namespace

TEST_CASE("packed spheres have the same bits as plain ones") {
    Random random(5);
    const RadiusPalette palette = palette_of({1, 2, 3, 4}, 1'000'000);
    int packed_rows = 0;
    for (int round = 0; round < 3000; ++round) {
        const Block<Sphere> block = hard_block(random, random.integer(1, block_size));
        check_exact(block, palette);
        packed_rows += PackedBlock::rows - whole_rows(block, palette);
    }
    CHECK(packed_rows > 3000);
}

TEST_CASE("rows with bit patterns that are 2^24 or more apart are stored whole") {
    const RadiusPalette palette = palette_of({1}, 16);
    const auto rows = [&](float first, float second) {
        Block<Sphere> block;
        block.set(0, {{first, 1, 1}, 1}, 0);
        block.set(1, {{second, 1, 1}, 1}, 1);
        check_exact(block, palette);
        return whole_rows(block, palette);
    };
    CHECK(rows(1, 1) == 0);
    CHECK(rows(1, with_pattern(pattern_of(1) + (1U << 24) - 1)) == 0);
    CHECK(rows(with_pattern(pattern_of(1) + (1U << 24) - 1), 1) == 0);
    CHECK(rows(1, with_pattern(pattern_of(1) + (1U << 24))) == 1);
    CHECK(rows(-5, -6) == 0);
    CHECK(rows(0, denormal) == 0);
    CHECK(rows(-denormal, denormal) == 1);
    CHECK(rows(-0.0F, 0.0F) == 1);
    CHECK(rows(-0.0F, -tiny) == 0);
    CHECK(rows(huge, -huge) == 1);
    CHECK(rows(huge, tiny) == 1);
}

TEST_CASE("radii that do not fit in a word with the ids are stored whole") {
    const std::pair<std::size_t, std::size_t> max_radii[] = {{0, 256},
                                                             {1, 256},
                                                             {std::size_t{1} << 24, 255},
                                                             {(std::size_t{1} << 27) + 1, 15},
                                                             {max_packed_ids, 3}};
    for (const auto& [ids, numbers] : max_radii) {
        std::vector<float> radii;
        for (int i = 1; i <= 300; ++i)
            radii.push_back(static_cast<float>(i));
        const RadiusPalette palette = palette_of(radii, ids);
        CAPTURE(ids, palette.size());
        CHECK(palette.size() == numbers);
        const std::size_t last_id = ids == 0 ? 0 : ids - 1;
        int full_rows = 0;
        for (std::size_t first = 0; first < radii.size(); first += block_size) {
            Block<Sphere> block;
            for (int lane = 0; lane < block_size && first + lane < radii.size(); ++lane)
                block.set(lane, {{1, 1, 1}, radii[first + lane]},
                          static_cast<ShapeId>(last_id - std::min<std::size_t>(last_id, lane)));
            check_exact(block, palette);
            full_rows += whole_rows(block, palette);
        }
        CHECK(full_rows >= static_cast<int>((radii.size() - palette.size()) / block_size));
        CHECK(full_rows < 20);
        // The last radius with the last id must not have the word of an empty lane.
        Block<Sphere> last;
        last.set(0, {{1, 1, 1}, palette.radii()[palette.size() - 1]},
                 static_cast<ShapeId>(last_id));
        CHECK(whole_rows(last, palette) == 0);
        check_exact(last, palette);
        CHECK(numbers_of(packed_alone(last, palette).get(0, 1))[0] !=
              numbers_of(packed_alone(last, palette).get(0, 1))[0]);
    }
}

namespace {

/// Runs tasks in reverse order on several threads.
class Spread : public Workers {
  public:
    explicit Spread(int threads) : threads_(threads) {}
    void each(std::size_t count, const std::function<void(std::size_t)>& task) override {
        std::vector<std::thread> threads;
        for (int thread = 0; thread < threads_; ++thread)
            threads.emplace_back([&, thread] {
                for (std::size_t i = count; i-- > 0;)
                    if (i % static_cast<std::size_t>(threads_) == static_cast<std::size_t>(thread))
                        task(i);
            });
        for (std::thread& thread : threads)
            thread.join();
    }

  private:
    int threads_;
};

Table<Sphere> table_of(int count, double lower, double upper, int radii, Random& random) {
    ShapeList<Sphere> list;
    for (int i = 0; i < count; ++i) {
        // In order, as the hierarchy would leave them.
        const double at = lower + (upper - lower) * i / count;
        const auto near = [&] { return static_cast<float>(at + random.uniform(0.0, 1.0)); };
        list.add(Sphere{{near(), near(), near()}, static_cast<float>(1 + random.integer(1, radii))},
                 static_cast<ShapeId>(i));
    }
    return Table<Sphere>(list);
}

} // namespace

TEST_CASE("a table of many spheres is packed and keeps its spheres") {
    Random random(6);
    Workers alone;
    for (const int radii : {1, 5, 200, 260}) {
        Table<Sphere> table = table_of(9'001, -3'000, 4'000, radii, random);
        const Table<Sphere> before = table;
        pack_spheres(table, 9'001, 9'009, alone);
        CHECK(!table.is_packed());
        pack_spheres(table, 9'001, 9'001, alone);
        CAPTURE(radii, table.bytes(), before.bytes());
        REQUIRE(table.is_packed());
        CHECK(table.bytes() * 5 <= before.bytes() * 4);
        if (radii <= 200) CHECK(table.bytes() < 9'001 * 15);
        REQUIRE(table.block_count() == before.block_count());
        CHECK(table.size() == before.size());
        for (std::uint32_t block = 0; block < table.block_count(); ++block) {
            CHECK(same_bits(table.blocks()[block], before.blocks()[block]));
            for (std::uint8_t lane = 0; lane < block_size; ++lane)
                CHECK(table.id({block, lane}) == before.id({block, lane}));
        }
    }
}

TEST_CASE("packed spheres have the same bits on any number of threads") {
    Random random(7);
    // Large enough for many tasks, each with rows that are stored whole.
    Table<Sphere> plain = table_of(70'001, -3'000, 4'000, 258, random);
    const auto packed_by = [&](int threads) {
        Table<Sphere> table = plain;
        Spread workers(threads);
        pack_spheres(table, 70'001, 0, workers);
        REQUIRE(table.is_packed());
        return table;
    };
    const Table<Sphere> first = packed_by(1);
    CHECK(first.packed()->rows.size() > 100);
    for (std::uint32_t block = 0; block < plain.block_count(); ++block)
        REQUIRE(same_bits(first.blocks()[block], plain.blocks()[block]));
    for (const int threads : {3, 8}) {
        const Table<Sphere> other = packed_by(threads);
        REQUIRE(other.packed()->blocks.bytes() == first.packed()->blocks.bytes());
        REQUIRE(other.packed()->rows.bytes() == first.packed()->rows.bytes());
        CHECK(std::memcmp(other.packed()->blocks.data(), first.packed()->blocks.data(),
                          first.packed()->blocks.bytes()) == 0);
        CHECK(std::memcmp(other.packed()->rows.data(), first.packed()->rows.data(),
                          first.packed()->rows.bytes()) == 0);
        CHECK(other.packed()->palette.size() == first.packed()->palette.size());
    }
}

TEST_CASE("the palette holds the most frequent radii wherever they occur") {
    ShapeList<Sphere> list;
    for (int i = 0; i < 20'000; ++i) {
        const float at = 1000.0F + static_cast<float>(i);
        list.add(Sphere{{at, at, at}, i < 400 ? 2.0F + static_cast<float>(i) : 1.0F},
                 static_cast<ShapeId>(i));
    }
    Table<Sphere> table(list);
    Workers alone;
    pack_spheres(table, 20'000, 0, alone);
    REQUIRE(table.is_packed());
    CHECK(table.packed()->palette.find(1.0F) == 0);
    CHECK(table.packed()->rows.size() < 20);
}

TEST_CASE("a table that packing would hardly shrink stays plain") {
    Workers alone;
    ShapeList<Sphere> far_apart;
    for (int i = 0; i < 1000; ++i) {
        const float size = std::ldexp(1.0F, i % 100) * (i % 2 == 0 ? 1.0F : -1.0F);
        far_apart.add(
            Sphere{{size, -size, size}, std::abs(size) * (1.0F + 1e-3F * static_cast<float>(i))},
            static_cast<ShapeId>(i));
    }
    Table<Sphere> table(far_apart);
    pack_spheres(table, 1000, 0, alone);
    CHECK(!table.is_packed());
    // Nearly every sphere has a different radius.
    Random random(8);
    Table<Sphere> radii = table_of(9'000, 1'000, 1'900, 1'000'000, random);
    pack_spheres(radii, 9'000, 0, alone);
    CHECK(!radii.is_packed());
}

TEST_CASE("material indices take as few bytes as the largest of them needs") {
    MaterialIndices indices;
    std::vector<MaterialIndex> expected;
    indices.reserve(400);
    const auto check = [&](std::size_t bytes_each) {
        REQUIRE(indices.size() == expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            CHECK(indices[i] == expected[i]);
        CHECK(indices.bytes() == 400 * bytes_each);
    };
    const auto add = [&](MaterialIndex material) {
        for (int i = 0; i < 50; ++i) {
            indices.push_back(material);
            expected.push_back(material);
        }
    };
    add(0);
    check(0);
    add(255);
    add(0);
    check(1);
    add(256);
    check(2);
    add(65'535);
    check(2);
    indices.truncate(200);
    expected.resize(200);
    check(2);
    add(65'536);
    add(0xFFFFFFFE);
    check(4);
    indices.shrink_to_fit();
    CHECK(indices.bytes() == 4 * expected.size());
    CHECK(indices[250] == 0xFFFFFFFE);
}
