#include "scenes/formats/json/reader.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/formats/built/built_file.hpp"
#include "scenes/formats/built/checksum.hpp"
#include "scenes/formats/built/layout.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace raylane::scenes {

namespace {

/// The sections of a file.
class Directory {
  public:
    Directory(std::string name, FileBytes file, core::Workers& workers)
        : name_(std::move(name)), file_(std::move(file)) {
        layout::Header header{};
        if (file_.bytes.size() < sizeof header)
            refuse("must be complete, got " + std::to_string(file_.bytes.size()) + " bytes");
        std::memcpy(&header, file_.bytes.data(), sizeof header);
        if (!looks_built({header.begin, sizeof header.begin}))
            refuse("must be a scene written by \"raylane build\"");
        if (header.format != layout::format)
            refuse("was built by another version of raylane: build it again (format " +
                   std::to_string(header.format) + ", expected " + std::to_string(layout::format) +
                   ")");
        if (header.bytes != file_.bytes.size())
            refuse("must be complete, with " + std::to_string(header.bytes) + " bytes, got " +
                   std::to_string(file_.bytes.size()));
        if (!std::ranges::all_of(header.unused, [](std::uint64_t number) { return number == 0; }) ||
            header.checksum !=
                checksum_of(header, checksum_of(file_.bytes.subspan(sizeof header), workers)))
            refuse_damaged("wrong checksum");
        if (header.section_count > file_.bytes.size() / sizeof(layout::Section) - 1)
            refuse_damaged("too many sections");
        sections_ = {reinterpret_cast<const layout::Section*>(file_.bytes.data() + sizeof header),
                     header.section_count};
    }

    /// Returns the elements of a section, or an empty array if the file lacks the section.
    template <class T>
    core::BigArray<T> array(const std::string& name) const {
        const layout::Section* const section = find(name);
        if (section == nullptr) return {};
        const std::size_t bytes = file_.bytes.size();
        if (section->element_bytes != sizeof(T) || section->place % layout::alignment != 0 ||
            section->place > bytes || section->count > (bytes - section->place) / sizeof(T))
            refuse_damaged("invalid section \"" + name + "\"");
        return {reinterpret_cast<const T*>(file_.bytes.data() + section->place),
                static_cast<std::size_t>(section->count), file_.keeper};
    }

    [[noreturn]] void refuse(const std::string& what) const { throw BadInput(name_, "", what); }
    [[noreturn]] void refuse_damaged(const std::string& what) const {
        refuse("is damaged, or was not written by \"raylane build\": " + what);
    }

  private:
    const layout::Section* find(const std::string& name) const {
        if (name.size() >= sizeof(layout::Section::name)) return nullptr;
        for (const layout::Section& section : sections_)
            if (std::strncmp(section.name, name.c_str(), sizeof section.name) == 0) return &section;
        return nullptr;
    }

    std::string name_;
    FileBytes file_;
    std::span<const layout::Section> sections_;
};

class Reader {
  public:
    explicit Reader(const Directory& directory) : directory_(directory) {}

    core::BuiltShapes shapes() {
        core::BuiltShapes shapes;
        const core::BigArray<std::uint64_t> counts =
            directory_.array<std::uint64_t>(layout::counts);
        if (counts.size() != core::kind_count) directory_.refuse_damaged("other kinds of shapes");
        std::size_t total = 0;
        for (const std::uint64_t count : counts) {
            if (count > core::no_shape - total) directory_.refuse_damaged("too many shapes");
            total += static_cast<std::size_t>(count);
        }
        core::for_each_table(shapes.tables, [&]<class Shape>(core::Table<Shape>& table) {
            const auto kind = static_cast<std::size_t>(core::kind_of<Shape>);
            read_table(table, static_cast<std::size_t>(counts[kind]), total);
            const auto merged = directory_.array<core::MergedShape>(
                std::string(core::kind_names[kind]) + layout::merged);
            shapes.merged[kind].assign(merged.begin(), merged.end());
        });
        shapes.material_of = materials(total);
        const auto polygons = directory_.array<core::IdRange>(layout::polygons);
        shapes.polygons.assign(polygons.begin(), polygons.end());
        shapes.hierarchy = core::hierarchy_of(directory_.array<core::WideNode>(layout::nodes));
        read_auto_camera(shapes);
        return shapes;
    }

  private:
    template <class Shape>
    void read_table(core::Table<Shape>& table, std::size_t count, std::size_t id_count) const {
        const std::string kind(core::name_of(core::kind_of<Shape>));
        core::Blocks<Shape> blocks;
        blocks.floats = directory_.array<core::Block<Shape>>(kind + layout::blocks);
        blocks.doubles = directory_.array<core::DoubleBlock<Shape>>(kind + layout::doubles);
        table = {std::move(blocks), count};
        if constexpr (core::Table<Shape>::packs) {
            core::PackedSpheres packed;
            packed.blocks = directory_.array<core::PackedBlock>(layout::packed);
            if (packed.empty()) return;
            if (table.block_count() != 0 || table.has_doubles() || id_count > core::max_packed_ids)
                directory_.refuse_damaged("spheres stored twice");
            packed.rows = directory_.array<core::PackedSpheres::Row>(layout::rows);
            packed.palette = core::RadiusPalette(id_count);
            const auto radii = directory_.array<float>(layout::radii);
            for (const float radius : radii)
                packed.palette.add(radius);
            if (packed.palette.size() != radii.size()) directory_.refuse_damaged("invalid radii");
            table.replace_blocks(std::move(packed));
        }
    }

    core::MaterialIndices materials(std::size_t count) const {
        auto stored = directory_.array<std::uint8_t>(layout::materials);
        const std::size_t width = count == 0 ? 0 : stored.size() / count;
        if (stored.size() != width * count || (width > 2 && width != 4))
            directory_.refuse_damaged("invalid indices of materials");
        return {std::move(stored), static_cast<int>(width), count};
    }

    void read_auto_camera(core::BuiltShapes& shapes) const {
        const auto numbers = directory_.array<double>(layout::auto_camera);
        std::size_t next = 0;
        constexpr std::size_t count = 14;
        if (numbers.size() != count || !std::ranges::all_of(numbers, [](double number) {
                return number >= -1e30 && number <= 1e30;
            }))
            directory_.refuse_damaged("invalid camera");
        const auto number = [&] { return static_cast<float>(numbers[next++]); };
        const auto flag = [&] { return numbers[next++] != 0.0; };
        const auto vector = [&] {
            const float x = number(), y = number(), z = number();
            return core::Vec3f(x, y, z);
        };
        const double lights = std::clamp(numbers[next++], 0.0, 4294967295.0);
        shapes.own_light_count = static_cast<std::size_t>(lights);
        const bool has_fit_camera = flag();
        core::FitCamera fit_camera;
        fit_camera.projection =
            flag() ? core::Projection::orthographic : core::Projection::perspective;
        fit_camera.direction = vector();
        fit_camera.up = vector();
        fit_camera.field_of_view = number();
        fit_camera.zoom = number();
        if (has_fit_camera) shapes.auto_camera.fit_camera = fit_camera;
        shapes.auto_camera.lights = flag();
        shapes.auto_camera.depth_cue = number();
        if (!(shapes.auto_camera.depth_cue >= 0.0F && shapes.auto_camera.depth_cue < 1.0F))
            directory_.refuse_damaged("invalid fog");
        shapes.auto_camera.turning = flag();
    }

    const Directory& directory_;
};

} // namespace

bool looks_built(std::string_view head) {
    return head.starts_with(std::string_view(layout::magic, sizeof layout::magic));
}

core::Scene read_built(InputFile& file, core::Workers* workers) {
    core::Workers alone;
    const Directory directory(file.name(), file.whole(), workers != nullptr ? *workers : alone);
    const auto json = directory.array<char>(layout::scene);
    InputFile scene(file.name(), std::string_view(json.data(), json.size()));
    return read_json_with(scene, Reader(directory).shapes(), workers);
}

} // namespace raylane::scenes
