#include "scenes/export/writers.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/built/built_file.hpp"
#include "scenes/formats/built/checksum.hpp"
#include "scenes/formats/built/layout.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

namespace {

class Writer {
  public:
    template <class T>
    void add(std::string_view name, const T* data, std::size_t count) {
        if (count == 0) return;
        layout::Section section{};
        std::copy(name.begin(), name.end(), section.name);
        section.element_bytes = sizeof(T);
        section.count = count;
        sections_.push_back(section);
        contents_.emplace_back(reinterpret_cast<const char*>(data), count * sizeof(T));
    }
    template <class T>
    void add(std::string_view name, const core::BigArray<T>& array) {
        add(name, array.data(), array.size());
    }

    void write(AtomicFile& file) {
        std::size_t place = (1 + sections_.size()) * layout::alignment;
        for (std::size_t i = 0; i < sections_.size(); ++i) {
            sections_[i].place = place;
            place += layout::rounded_up(contents_[i].size());
        }
        layout::Header header{};
        std::copy(std::begin(layout::magic), std::end(layout::magic), header.begin);
        header.format = layout::format;
        header.section_count = static_cast<std::uint32_t>(sections_.size());
        header.bytes = place;
        Checksum checksum;
        each_piece([&](std::span<const char> piece) { checksum.add(std::as_bytes(piece)); });
        header.checksum = checksum_of(header, checksum.result());
        file.reserve(static_cast<std::int64_t>(place));
        file.write({reinterpret_cast<const char*>(&header), sizeof header});
        each_piece([&](std::span<const char> piece) { file.write(piece); });
    }

  private:
    /// Calls visit() for each piece of the file behind the header, in order.
    template <class Visit>
    void each_piece(const Visit& visit) const {
        visit(std::span(reinterpret_cast<const char*>(sections_.data()),
                        sections_.size() * sizeof(layout::Section)));
        static constexpr char zeros[layout::alignment] = {};
        for (const std::string_view content : contents_) {
            visit(std::span(content));
            visit(std::span(zeros, layout::rounded_up(content.size()) - content.size()));
        }
    }

    std::vector<layout::Section> sections_;
    std::vector<std::string_view> contents_; // of each section
};

std::vector<double> numbers_of(const core::Scene& scene) {
    const core::AutoCamera& auto_camera = scene.auto_camera();
    const core::FitCamera fit_camera = auto_camera.fit_camera.value_or(core::FitCamera{});
    return {
        static_cast<double>(scene.own_light_count()), auto_camera.fit_camera ? 1.0 : 0.0,
        static_cast<double>(fit_camera.projection),   static_cast<double>(fit_camera.direction.x),
        static_cast<double>(fit_camera.direction.y),  static_cast<double>(fit_camera.direction.z),
        static_cast<double>(fit_camera.up.x),         static_cast<double>(fit_camera.up.y),
        static_cast<double>(fit_camera.up.z),         static_cast<double>(fit_camera.field_of_view),
        static_cast<double>(fit_camera.zoom),         auto_camera.lights ? 1.0 : 0.0,
        static_cast<double>(auto_camera.depth_cue),   auto_camera.turning ? 1.0 : 0.0};
}

} // namespace

void seal(std::string& built_file) {
    layout::Header header{};
    if (built_file.size() < sizeof header) return;
    std::memcpy(&header, built_file.data(), sizeof header);
    core::Workers alone;
    header.checksum = checksum_of(
        header, checksum_of(std::as_bytes(std::span(built_file)).subspan(sizeof header), alone));
    std::memcpy(built_file.data(), &header, sizeof header);
}

void write_built(AtomicFile& file, const core::Scene& scene) {
    if (scene.solids().any())
        throw BadInput(file.name(), "", "cannot store constructed solids: use .json or .pov");
    if (scene.copies() != nullptr)
        throw BadInput(file.name(), "", "cannot store kept copies of a group: use .json or .pov");
    for (const core::Material& material : scene.materials())
        if (material.pattern.kind == core::PatternKind::image)
            throw BadInput(file.name(), "", "cannot store images: use .json");
    if (!scene.object_spaces().empty())
        throw BadInput(file.name(), "", "cannot store patterns that have moved with their objects");
    Writer writer;
    std::string json;
    TextFile text([&](std::string_view piece) { json += piece; });
    write_json_without_objects(text, scene);
    text.flush();
    writer.add(layout::scene, json.data(), json.size());
    const std::vector<double> auto_camera = numbers_of(scene);
    writer.add(layout::auto_camera, auto_camera.data(), auto_camera.size());
    writer.add(layout::nodes, scene.hierarchy().nodes);
    const std::span<const std::uint8_t> materials = scene.material_indices().stored();
    writer.add(layout::materials, materials.data(), materials.size());
    writer.add(layout::polygons, scene.polygons().data(), scene.polygons().size());
    std::vector<std::uint64_t> counts;
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        const std::string kind(core::name_of(core::kind_of<Shape>));
        counts.push_back(table.size());
        writer.add(kind + layout::doubles, table.doubles());
        writer.add(kind + layout::blocks, table.plain_blocks());
        const auto& merged = scene.merged()[static_cast<std::size_t>(core::kind_of<Shape>)];
        writer.add(kind + layout::merged, merged.data(), merged.size());
        const core::PackedSpheres* const packed = table.packed();
        if (packed == nullptr) return;
        writer.add(layout::packed, packed->blocks);
        writer.add(layout::rows, packed->rows);
        writer.add(layout::radii, packed->palette.radii(), packed->palette.size());
    });
    writer.add(layout::counts, counts.data(), counts.size());
    writer.write(file);
}

} // namespace raylane::scenes
