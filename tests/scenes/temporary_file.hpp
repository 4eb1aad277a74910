#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

/// A file that lives as long as this.
class TemporaryFile {
  public:
    explicit TemporaryFile(std::string_view content, const std::string& ending = ".json")
        : path_(std::filesystem::temp_directory_path() /
                ("raylane-test-" + std::to_string(::getpid()) + "-" +
                 std::to_string(next_number()) + ending)) {
        std::ofstream(path_, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
    }
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    static int next_number() {
        static std::atomic<int> number = 0;
        return number++;
    }

    std::filesystem::path path_;
};
