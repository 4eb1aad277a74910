#pragma once

#include "scenes/tool/checkpoint/tile_records.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace raylane::scenes {

/// The image that a checkpoint belongs to: a scene with the options of its rendering. A rendering
/// resumes only from a checkpoint of its own subject.
struct CheckpointSubject {
    std::string scene;   ///< fingerprint_of() the scene
    std::string options; ///< one line with everything else that the image depends on
};

/// A checkpoint: the finished tiles of an image that is being rendered, in a file beside the
/// output. Another process can resume from it, however this process ends.
///
/// A new file is made only `begin_after` seconds after the start, with the tiles that are finished
/// by then. From then on, each tile is written as soon as it is finished, with a checksum. A file
/// that this checkpoint found is extended from its first finished tile on. If the process dies, at
/// most the tiles in progress are lost. If the power fails, the tiles of the last `sync_every`
/// seconds are lost, too.
///
/// Each subject, that is, each scene with its options, has a separate checkpoint beside the output.
/// The one made first is "OUTPUT.part". The others are "OUTPUT.CHECKSUM.part", with 16 hexadecimal
/// digits computed from the subject. When the image is complete, remove() deletes all these files
/// except those that another process uses.
///
/// A lock on the file ensures that one process uses it at a time. Errors of the file do not end the
/// rendering; problem() returns them. Records that cannot be written are kept in memory, up to
/// `max_waiting` bytes. The checkpoint tries to write them again every `sync_every` seconds.
class Checkpoint {
  public:
    static constexpr std::chrono::seconds begin_after{2}, sync_every{3};
    static constexpr std::size_t max_waiting = std::size_t{256} << 20;

    /// The file that was found at construction, and the checkpoint's reaction.
    enum class Found : std::uint8_t {
        nothing,
        same,           ///< a checkpoint of this subject: resumes from it
        other_scene,    ///< of another scene: keeps it; this checkpoint takes another name
        other_options,  ///< of other options or another version: as for other_scene
        cut_off,        ///< cut off within the header: truncates it
        none_of_ours,   ///< not a checkpoint of this user: keeps it and writes no checkpoint
        in_use,         ///< another process uses it: as for none_of_ours
        named_too_long, ///< its name would be too long: as for none_of_ours
    };

    /// `image`: the output. `tell` receives the first problem() as soon as it occurs, in the
    /// thread in which it occurs.
    Checkpoint(std::filesystem::path image, const CheckpointSubject& subject, TileRecords records,
               std::function<void(const std::string&)> tell = {});
    ~Checkpoint();
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    const std::filesystem::path& path() const { return path_; }
    Found found() const { return found_; }
    /// Returns the file that found() is about.
    const std::filesystem::path& found_at() const { return found_at_; }
    /// Returns the number of pixels of the tiles that were found.
    std::int64_t found_pixels() const;

    /// Returns true if the tile was found.
    bool has(std::size_t number) const { return places_[number] >= 0; }

    /// Callbacks for simd::RenderOptions. Thread-safe.
    bool recall(const simd::TileToFill& tile);
    void note(const simd::FinishedTile& tile);
    /// Notes a tile whose bytes exist already.
    void note(std::size_t number, std::string_view bytes);

    /// Writes all waiting records, because the rendering ends early. Returns false if that fails.
    bool keep();
    /// Frees the file's space for a complete image of `bytes` bytes, for which the disk has no
    /// space. Returns false, and keeps the file, if the freed space would not be enough.
    bool give_room(std::size_t bytes);
    /// Removes this checkpoint and those of other subjects after the image is written, once the
    /// image is certain to survive on the disk.
    void remove();
    /// Returns the last problem in one line, as long as something is not written that should be.
    /// Otherwise returns an empty text.
    std::string problem();

  private:
    void open();
    Found look_at(const std::filesystem::path& path);
    Found kind_of(const std::string& head) const;
    void read_records();
    void drop_oldest();
    void write_waiting();
    bool begin();
    bool make();
    std::optional<std::int64_t> write_all(int descriptor) const;
    bool append(const std::string& bytes);
    void remove_others() const;
    void fail();
    void give_up();
    void keep_up();
    bool is_left_alone() const {
        return found_ == Found::none_of_ours || found_ == Found::in_use ||
               found_ == Found::named_too_long;
    }

    std::filesystem::path image_, path_, found_at_;
    TileRecords records_;
    std::string head_;
    std::uint64_t seed_; // of the checksums, so that records of other checkpoints are invalid here
    Found found_ = Found::nothing;
    std::vector<std::int64_t> places_; // of the tiles' bytes in the file; -1: missing
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

    std::mutex mutex_; // protects the members below
    int descriptor_ = -1;
    bool is_ours_ = false; // the file has this image's tiles
    bool is_given_up_ = false;
    std::deque<std::string> waiting_; // records that are not written yet
    std::size_t waiting_bytes_ = 0;
    std::chrono::steady_clock::time_point next_try_; // the time to write them
    std::int64_t end_ = 0;
    std::string problem_;
    std::function<void(const std::string&)> tell_; // empty after it was called
    std::thread keeping_;                          // runs keep_up(); without it, only note() writes
    std::condition_variable ends_;
    bool is_ending_ = false, is_to_be_synced_ = false;
};

} // namespace raylane::scenes
