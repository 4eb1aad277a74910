#pragma once

#include "core/hierarchy/hierarchy.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/placement.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace raylane::core {

class Scene;

/// The blocks of a kind that belong to copies.
template <class Shape>
struct CopiedBlocks {
    std::uint32_t first = 0;             ///< index in `all` of the first block of a copy
    Blocks<Shape> shapes;                ///< those of the table, then those of copies
    mutable BigArray<std::uint8_t> made; ///< State of each block of a copy

    enum State : std::uint8_t { unmade = 0, in_work, done };
    bool is_made(std::size_t i) const {
        return __atomic_load_n(&made[i], __ATOMIC_ACQUIRE) == done;
    }
};

/// Copies with at least this many shapes in one call are kept as copies. Fewer shapes take little
/// memory, and rays find them faster in one hierarchy.
inline constexpr std::size_t kept_from = std::size_t{1} << 22;

/// Copies of groups of shapes, each stored as a Placement. The numbers of a copy's shapes are
/// computed when they are needed, a block at a time, and then kept in memory behind the blocks of
/// the scene's tables. Address space is reserved for all of them beforehand. So code that reads a
/// shape by its place reads the exact numbers of a copy, too. Only searches for shapes differ: they
/// search the prototype, then make the blocks that they have found.
///
/// The shapes of the copies of a group have consecutive ids, one copy after the other, in the order
/// of the prototype's.
class Copies {
  public:
    /// The shapes of which copies are made. Their ids are 0, 1, ...
    struct Group {
        std::shared_ptr<const Scene> prototype;
        std::vector<Placement> placements;
        ShapeId first_id;
    };

    /// The copies of one group.
    struct Set {
        std::shared_ptr<const Scene> prototype;
        std::uint32_t first_copy, copy_count;
        ShapeId first_id;          ///< of the first copy
        std::uint32_t shape_count; ///< of one copy
        /// The table's first block of copies, and the number of blocks of one copy, by kind.
        std::array<std::uint32_t, kind_count> first_block, block_count;
        Vec3d center; ///< of a sphere around the prototype
        double radius;
    };

    /// A copy within its set.
    struct Copy {
        const Set& set;
        std::uint32_t number;
    };

    /// Extends the tables by the blocks of copies. Throws InvalidValue if there are too many, and
    /// std::bad_alloc.
    Copies(std::vector<Group> groups, Tables& tables);

    static constexpr std::size_t max_copies = (std::size_t{1} << 30) - 1;

    std::span<const Set> sets() const { return sets_; }
    std::uint32_t copy_count() const { return static_cast<std::uint32_t>(placements_.size()); }
    const Placement& placement(std::uint32_t copy) const { return placements_[copy]; }
    Copy copy_at(std::uint32_t copy) const;
    /// Returns the copy that a shape belongs to, which must belong to one.
    Copy copy_with(ShapeId id) const;
    /// Returns the id of a copy's first shape.
    static ShapeId first_id_of(const Copy& copy) {
        return copy.set.first_id + copy.number * copy.set.shape_count;
    }
    /// Returns the block of a table that has a copy of the prototype's block.
    static std::uint32_t block_of(const Copy& copy, Kind kind, std::uint32_t block) {
        const auto k = static_cast<std::size_t>(kind);
        return copy.set.first_block[k] + copy.number * copy.set.block_count[k] + block;
    }

    /// Computes the shapes of a block, unless that has been done. Any number of threads may call it
    /// at a time.
    void make(Kind kind, std::uint32_t block) const {
        with_shape_type(kind, [&]<class Shape>(std::type_identity<Shape>) {
            const auto& blocks = std::get<CopiedBlocks<Shape>>(of_kind_);
            const std::size_t i = std::size_t{block} - blocks.first;
            if (block < blocks.first || i >= blocks.made.size()) return;
            if (!blocks.is_made(i)) make_in(blocks, i);
        });
    }

    /// A node of the hierarchy over copies: four children with bounds, each a node or a copy.
    /// Narrower than a WideNode, as rays search it without the kernels' registers.
    struct alignas(16) Node {
        static constexpr std::uint32_t copy_bit = 1U << 31, none = 0xFFFFFFFF;

        float lower[3][4], upper[3][4]; ///< of an absent child: lower > upper
        std::uint32_t children[4];      ///< absent ones last

        Bounds bounds(int child) const {
            return {{lower[0][child], lower[1][child], lower[2][child]},
                    {upper[0][child], upper[1][child], upper[2][child]}};
        }
    };
    /// Returns the hierarchy, the root first.
    const BigArray<Node>& nodes() const { return nodes_; }
    /// Returns bounds of all copies.
    const Bounds& bounds() const { return bounds_; }

    /// Returns the bytes of placements and hierarchy, and of the blocks that have been made.
    std::size_t bytes() const;

  private:
    void take(std::vector<Group> groups);
    void reserve_blocks(Tables& tables);
    void build_tree();
    Bounds bounds_of(const Copy& copy) const;
    template <class Shape>
    void make_in(const CopiedBlocks<Shape>& blocks, std::size_t i) const;
    template <class Shape>
    void fill(const CopiedBlocks<Shape>& blocks, std::size_t i) const;

    std::vector<Set> sets_;
    std::vector<Placement> placements_;
    OfEachShape<CopiedBlocks> of_kind_;
    mutable std::atomic<std::size_t> made_bytes_ = 0;
    BigArray<Node> nodes_;
    Bounds bounds_;
};

} // namespace raylane::core
