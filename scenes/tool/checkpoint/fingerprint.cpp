#include "scenes/tool/checkpoint/fingerprint.hpp"

#include "scenes/export/writers.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <variant>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace raylane::scenes {

namespace {

class Hash {
  public:
    Hash() : state_(XXH3_createState()) {
        if (state_ == nullptr) throw std::bad_alloc();
        XXH3_128bits_reset(state_.get());
    }

    void add(const void* bytes, std::size_t count) {
        if (count > 0) XXH3_128bits_update(state_.get(), bytes, count);
    }
    void add(std::string_view text) { add(text.data(), text.size()); }
    void add(std::uint64_t number) { add(&number, sizeof number); }

    std::string text() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
        char text[33];
        std::snprintf(text, sizeof text, "%016llx%016llx",
                      static_cast<unsigned long long>(hash.high64),
                      static_cast<unsigned long long>(hash.low64));
        return text;
    }

  private:
    struct Free {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, Free> state_;
};

/// Adds an array of numbers without padding.
template <class T>
void add_array(Hash& hash, const core::BigArray<T>& array) {
    hash.add(array.size());
    hash.add(array.data(), array.bytes());
}

void add_materials(Hash& hash, const core::Scene& scene) {
    std::vector<core::MaterialIndex> batch;
    constexpr std::size_t most = 4096;
    const auto add_some = [&] {
        hash.add(batch.data(), batch.size() * sizeof(core::MaterialIndex));
        batch.clear();
    };
    scene.material_indices().for_each_material([&](core::MaterialIndex material) {
        batch.push_back(material);
        if (batch.size() == most) add_some();
    });
    add_some();
}

/// Adds the pixels of a material's image, if it has one.
void add_image(Hash& hash, const core::Texture& image) {
    if (!image.any()) return;
    hash.add(static_cast<std::uint64_t>(image.width()));
    hash.add(image.components().index());
    std::visit(
        [&](const auto& values) { hash.add(values.data(), values.size() * sizeof values[0]); },
        image.components());
}

void add_spaces(Hash& hash, const core::Scene& scene) {
    for (const auto& [id, space] : scene.object_spaces()) {
        hash.add(id);
        hash.add(&space->origin, sizeof space->origin);
        hash.add(&space->axes, sizeof space->axes);
    }
}

void add_shapes(Hash& hash, const core::Scene& scene) {
    hash.add(scene.shape_count());
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        static_assert(sizeof(core::Block<Shape>) ==
                      sizeof(core::Block<Shape>::values) + sizeof(core::Block<Shape>::ids));
        static_assert(sizeof(core::DoubleBlock<Shape>) == sizeof(core::DoubleBlock<Shape>::values));
        hash.add(table.block_count());
        for (std::size_t i = 0; i < table.block_count(); ++i)
            table.visit_block(
                i, [&](const core::Block<Shape>& block) { hash.add(&block, sizeof block); });
        add_array(hash, table.doubles());
        if constexpr (core::kind_of<Shape> == core::Kind::triangle)
            core::for_each_shape(table, [&](const auto&, core::ShapeId id) {
                const core::IdRange polygon = scene.coplanar_with(id);
                hash.add(polygon.first);
                hash.add(polygon.last);
            });
    });
    add_materials(hash, scene);
    add_spaces(hash, scene);
    if (scene.copies() == nullptr) return;
    for (const core::Copies::Set& set : scene.copies()->sets()) {
        add_shapes(hash, *set.prototype);
        hash.add(set.first_id);
        hash.add(&scene.copies()->placement(set.first_copy),
                 set.copy_count * sizeof(core::Placement));
    }
}

} // namespace

std::string fingerprint_of(const core::Scene& scene) {
    Hash hash;
    TextFile text([&](std::string_view piece) { hash.add(piece); });
    write_json_without_shapes(text, scene);
    text.flush();
    for (const core::Material& material : scene.materials())
        add_image(hash, material.pattern.image);
    add_shapes(hash, scene);
    return hash.text();
}

std::string fingerprint_of(const core::Film& film) {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(film.width()));
    hash.add(static_cast<std::uint64_t>(film.height()));
    static_assert(sizeof(core::Color) == 3 * sizeof(float));
    hash.add(film.pixels().data(), film.pixels().size() * sizeof(core::Color));
    hash.add(film.alphas().data(), film.alphas().size() * sizeof(float));
    return hash.text();
}

std::uint64_t checksum_of(std::span<const char> bytes, std::uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

} // namespace raylane::scenes
