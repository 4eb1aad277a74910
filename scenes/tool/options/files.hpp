#pragma once

#include <filesystem>
#include <string>

/// Names of the files that commands read and write. All functions throw BadInput.
namespace raylane::scenes {

/// Returns the default name of an output: the scene's file name without its folder and with another
/// extension.
std::string default_output(const std::filesystem::path& scene, const std::string& ending);

/// Refuses a file to write that is the file of another argument, under any name.
void require_other_file(const std::string& option, const std::string& file,
                        const std::string& other_option, const std::string& other_file);
/// Does the same for the argument SCENE. If that file is not a scene, the error says so instead.
void require_other_than_scene(const std::string& option, const std::string& file,
                              const std::string& scene);
/// Does the same for two output files. Only one of them may be standard output.
void require_other_output(const std::string& option, const std::string& file,
                          const std::string& other_option, const std::string& other_file);

} // namespace raylane::scenes
