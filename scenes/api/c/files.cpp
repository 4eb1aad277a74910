#include "calls.hpp"
#include "values.hpp"

#include <string>
#include <string_view>
#include <vector>

using namespace raylane;
using namespace raylane::c;

namespace {

AtomOptions options_of(const raylane_atom_option* options, std::size_t count) {
    AtomOptions result;
    for (const raylane_atom_option& option : span_of("options", options, count))
        result.emplace_back(&checked("options", option.name), &checked("options", option.value));
    return result;
}

} // namespace

raylane_status raylane_read_texture(const char* path, raylane_texture** texture) {
    return handle_of("texture", texture, [&] { return read_texture(&checked("path", path)); });
}

raylane_status raylane_load(const char* path, raylane_scene** scene) {
    return scene_of(scene, [&, on_remark = keeping_remarks()] {
        return load(&checked("path", path), on_remark);
    });
}

raylane_status raylane_parse(const char* text, size_t length, const char* name,
                             raylane_scene** scene) {
    return scene_of(scene, [&, on_remark = keeping_remarks()] {
        return parse({length != 0 ? &checked("text", text) : "", length}, &checked("name", name),
                     on_remark);
    });
}

raylane_status raylane_parse_atoms(const char* text, size_t length, const char* name,
                                   const raylane_atom_option* options, size_t count,
                                   raylane_scene** scene) {
    return scene_of(scene, [&, on_remark = keeping_remarks()] {
        const std::string_view atoms{length != 0 ? &checked("text", text) : "", length};
        return parse_atoms(atoms, &checked("name", name), options_of(options, count), on_remark);
    });
}

raylane_status raylane_load_atoms(const char* path, const raylane_atom_option* options,
                                  size_t count, raylane_scene** scene) {
    return scene_of(scene, [&, on_remark = keeping_remarks()] {
        return load_atoms(&checked("path", path), options_of(options, count), on_remark);
    });
}

raylane_status raylane_save(const raylane_scene* scene, const char* path) {
    return guarded([&, on_remark = keeping_remarks()] {
        save(checked("scene", scene).scene, &checked("path", path), on_remark);
    });
}

raylane_status raylane_write_image(const char* path, int width, int height, const float* rgb,
                                   int transfer) {
    return guarded([&] {
        Image image{width, height, {}};
        // write_image() rejects other sizes, so their pixels need no copy.
        const auto is_side = [](int pixels) { return pixels >= 1 && pixels <= 65535; };
        if (is_side(width) && is_side(height)) {
            const std::size_t count =
                3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
            const std::span<const float> components = span_of("rgb", rgb, count);
            image.rgb.assign(components.begin(), components.end());
        }
        write_image(&checked("path", path), image,
                    {.transfer = enum_from_int<Transfer>("transfer", transfer)});
    });
}
