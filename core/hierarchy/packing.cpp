#include "core/hierarchy/packing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace raylane::core {

namespace {

constexpr std::size_t blocks_in_a_task = std::size_t{1} << 8;

class Packer {
  public:
    Packer(const BigArray<Block<Sphere>>& blocks, std::size_t id_count, Workers& workers)
        : blocks_(blocks), workers_(workers),
          tasks_((blocks.size() + blocks_in_a_task - 1) / blocks_in_a_task), palette_(id_count) {}

    /// Returns the packed spheres, or an empty object if packing does not pay.
    PackedSpheres pack() {
        collect_radii();
        const std::size_t rows = place_rows();
        PackedSpheres packed;
        const std::size_t bytes =
            blocks_.size() * sizeof(PackedBlock) + rows * sizeof(PackedSpheres::Row);
        constexpr std::size_t max_rows = std::size_t{1} << (32 - PackedBlock::rows);
        // A row outside of its block costs a memory access: at most every other block may have one.
        if (bytes > blocks_.bytes() / 5 * 4 || rows >= max_rows) return packed;
        packed.blocks = BigArray<PackedBlock>(blocks_.size());
        packed.rows = decltype(packed.rows)(rows);
        workers_.each(tasks_, [&](std::size_t task) {
            std::size_t row = first_row_[task];
            for_each_in_task(task, [&](std::size_t block) {
                PackedSpheres::Row* const to = packed.rows.data() + row;
                packed.blocks[block] =
                    core::pack(blocks_[block], palette_, static_cast<std::uint32_t>(row), to);
                row += static_cast<std::size_t>(packed.blocks[block].whole_rows());
            });
        });
        packed.palette = palette_;
        return packed;
    }

  private:
    template <class Visit>
    void for_each_in_task(std::size_t task, const Visit& visit) const {
        const std::size_t first = task * blocks_in_a_task;
        for (std::size_t i = first; i < std::min(first + blocks_in_a_task, blocks_.size()); ++i)
            visit(i);
    }

    /// The distinct radii of some blocks, in order of appearance until the palette is full, with
    /// the number of spheres of each.
    class Counts {
      public:
        void add(const Block<Sphere>& block) {
            for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane) {
                const float radius = block.values[3][lane];
                radii_.add(radius);
                if (const std::uint32_t number = radii_.find(radius); number != RadiusPalette::none)
                    ++counts_[number];
            }
        }
        void add_to(std::map<std::uint32_t, std::size_t>& by_pattern) const {
            constexpr std::size_t most = std::size_t{1} << 16; // more radii never pay
            for (std::size_t i = 0; i < radii_.size(); ++i) {
                const auto pattern = std::bit_cast<std::uint32_t>(radii_.radii()[i]);
                const auto known = by_pattern.find(pattern);
                if (known != by_pattern.end())
                    known->second += counts_[i];
                else if (by_pattern.size() < most)
                    by_pattern.emplace(pattern, counts_[i]);
            }
        }

      private:
        RadiusPalette radii_;
        std::array<std::uint32_t, RadiusPalette::most> counts_{};
    };

    /// Fills the palette with the most frequent radii, as many as fit.
    void collect_radii() {
        std::map<std::uint32_t, std::size_t> by_pattern;
        std::vector<Counts> found(std::min<std::size_t>(tasks_, 64));
        for (std::size_t first = 0; first < tasks_; first += found.size()) { // limits memory
            const std::size_t count = std::min(found.size(), tasks_ - first);
            std::fill(found.begin(), found.end(), Counts());
            workers_.each(count, [&](std::size_t i) {
                for_each_in_task(first + i,
                                 [&](std::size_t block) { found[i].add(blocks_[block]); });
            });
            for (std::size_t i = 0; i < count; ++i)
                found[i].add_to(by_pattern);
        }
        std::vector<std::pair<std::size_t, std::uint32_t>> by_count;
        by_count.reserve(by_pattern.size());
        for (const auto& [pattern, count] : by_pattern)
            by_count.emplace_back(~count, pattern); // the largest count first
        std::sort(by_count.begin(), by_count.end());
        for (const auto& [count, pattern] : by_count)
            palette_.add(std::bit_cast<float>(pattern));
    }

    /// Returns the number of rows that are stored outside of their blocks.
    std::size_t place_rows() {
        first_row_.assign(tasks_ + 1, 0);
        workers_.each(tasks_, [&](std::size_t task) {
            std::size_t rows = 0;
            for_each_in_task(task, [&](std::size_t block) {
                rows += static_cast<std::size_t>(whole_rows(blocks_[block], palette_));
            });
            first_row_[task + 1] = rows;
        });
        std::partial_sum(first_row_.begin(), first_row_.end(), first_row_.begin());
        return first_row_[tasks_];
    }

    const BigArray<Block<Sphere>>& blocks_;
    Workers& workers_;
    std::size_t tasks_;
    RadiusPalette palette_;
    std::vector<std::size_t> first_row_; // by task
};

} // namespace

void pack_spheres(Table<Sphere>& table, std::size_t id_count, std::size_t from, Workers& workers) {
    if (table.block_count() * block_size < std::max(from, min_packed) || table.has_doubles() ||
        id_count > max_packed_ids)
        return;
    PackedSpheres packed = Packer(table.plain_blocks(), id_count, workers).pack();
    if (!packed.empty()) table.replace_blocks(std::move(packed));
}

} // namespace raylane::core
