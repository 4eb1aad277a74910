#include "scenes/files/included_files.hpp"

#include "core/shapes/invalid_value.hpp"
#include "scenes/files/errors.hpp"

#include <string>
#include <system_error>

namespace raylane::scenes {

namespace {

/// Returns the reason why a path cannot be included.
std::string refused(const std::string& path, std::filesystem::file_status status,
                    std::error_code error) {
    switch (status.type()) {
    case std::filesystem::file_type::not_found:
        return path + " does not exist";
    case std::filesystem::file_type::none:
        return path + " cannot be found: " + error.message();
    case std::filesystem::file_type::directory:
        return path + " is a directory";
    case std::filesystem::file_type::fifo:
        return path + " is a pipe";
    default:
        return path + " is not a regular file";
    }
}

void require(bool is_good, const std::string& must) {
    if (!is_good) throw core::InvalidValue("", must);
}

} // namespace

std::unique_ptr<InputFile> IncludedFiles::open(const std::filesystem::path& path,
                                               std::string_view name, std::size_t depth) {
    require(depth < deepest, "must not be included more than " + std::to_string(deepest) + " deep");
    auto file = open_bytes(path, name);
    file->take_as_text();
    return file;
}

std::unique_ptr<InputFile> IncludedFiles::open_bytes(const std::filesystem::path& path,
                                                     std::string_view name) {
    std::error_code unknown;
    const std::filesystem::file_status status = std::filesystem::status(path, unknown);
    require(!name.empty() && std::filesystem::is_regular_file(status),
            "must be the name of a file, got \"" + printable(name) + "\", but " +
                refused(printable(path.string(), 4096), status, unknown));
    require(opened_++ < most, "must be one of at most " + std::to_string(most) + " included files");
    auto file = std::make_unique<InputFile>(path);
    require(std::filesystem::file_size(path, unknown) <= max_bytes || unknown,
            "must be a file of at most 1 GiB, got " + printable(path.string(), 4096));
    return file;
}

} // namespace raylane::scenes
