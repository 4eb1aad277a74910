#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/formats/nff/reader.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

/// NFF texts, and functions for their scenes and errors.
namespace raylane::tests {

inline const std::string view = "v\n"
                                "from 0 0 8\n"
                                "at 0 0 0\n"
                                "up 0 1 0\n"
                                "angle 45\n"
                                "hither 1\n"
                                "resolution 512 256\n";
inline const std::string view_and_light = view + "l 4 3 20\n"; // 8 lines

inline core::Scene scene_of(std::string_view text) {
    const TemporaryDirectory directory;
    scenes::InputFile file(directory.write("scene.nff", text));
    return scenes::read_nff(file);
}

/// Returns the error without the file's directory, and with the line in words.
inline std::string error_of(std::string_view text) {
    const TemporaryDirectory directory;
    scenes::InputFile file(directory.write("scene.nff", text));
    return in_words(
        message_in<scenes::BadInput>(directory.path(), [&] { scenes::read_nff(file); }));
}

} // namespace raylane::tests
