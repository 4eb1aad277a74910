#pragma once

#include "scenes/tool/journal/tile_records.hpp"

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

/// What a journal is of; only the same goes on with it.
struct JournalSubject {
    std::string scene;   ///< fingerprint_of
    std::string options; ///< one line: all that the picture depends on beside the scene
};

/// The finished tiles of a picture that is being drawn, in a file beside it, from which another
/// process can go on when this one ends before its time, however that be. Each tile is written as
/// it comes, with a checksum. If the process dies, the tiles under way are lost at most; if the
/// power fails, those of the last `sync_every`, too. No file is made before `begin_after`, but one
/// that is there is written from the first tile on.
///
/// Journals of one output and different subjects exist side by side. The first is "OUTPUT.part",
/// the others are "OUTPUT.CHECKSUM.part", with 16 hexadecimal digits that follow from the subject.
/// A complete picture removes all that no other process uses.
///
/// To be used by one process at a time, which the file's lock sees to. Nothing that goes wrong with
/// the file ends the drawing: problem() tells it. What could not be written is kept, as far as
/// `most_waiting` goes, and tried again every `sync_every`.
class Journal {
  public:
    static constexpr std::chrono::seconds begin_after{2}, sync_every{3};
    static constexpr std::size_t most_waiting = std::size_t{256} << 20;

    /// What there was of a file.
    enum class Found : std::uint8_t {
        nothing,
        same,           ///< goes on with it
        other_scene,    ///< stays; this journal takes another name
        other_options,  ///< or another version's, likewise
        cut_off,        ///< in its first lines: empties it
        none_of_ours,   ///< leaves it alone, and keeps no journal
        in_use,         ///< likewise
        named_too_long, ///< likewise
    };

    /// `picture`: the output. `tell` receives the first problem() as soon as there is one, from
    /// whichever thread has it.
    Journal(std::filesystem::path picture, const JournalSubject& subject, TileRecords records,
            std::function<void(const std::string&)> tell = {});
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    const std::filesystem::path& path() const { return path_; }
    Found found() const { return found_; }
    /// The file that found() is about.
    const std::filesystem::path& found_at() const { return found_at_; }
    /// Pixels of the tiles that were found.
    std::int64_t found_pixels() const;

    /// True if a tile was found.
    bool has(std::size_t number) const { return places_[number] >= 0; }

    /// For simd::RenderOptions: by several threads.
    bool recall(const simd::TileToFill& tile);
    void note(const simd::FinishedTile& tile);
    /// The same of a tile of which the bytes are there.
    void note(std::size_t number, std::string_view bytes);

    /// Writes what is not written yet, for the drawing ends before its time. False if it could not.
    bool keep();
    /// The drawing is done, and there is no room on the disk for so many bytes of a picture: gives
    /// its own, if that is enough.
    bool give_room(std::size_t bytes);
    /// The picture is there: removes this journal and those of other subjects, once the picture is
    /// sure to survive them.
    void remove();
    /// What the system said last, as long as something is not written that should be; or else
    /// empty. One line.
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

    std::filesystem::path picture_, path_, found_at_;
    TileRecords records_;
    std::string head_;
    std::uint64_t seed_; // of checksums: another journal's records are none of this one's
    Found found_ = Found::nothing;
    std::vector<std::int64_t> places_; // of the tiles' bytes in the file; -1: not there
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

    std::mutex mutex_; // of what follows
    int descriptor_ = -1;
    bool is_ours_ = false; // this picture's tiles are in it
    bool is_given_up_ = false;
    std::deque<std::string> waiting_; // records that are not written
    std::size_t waiting_bytes_ = 0;
    std::chrono::steady_clock::time_point next_try_; // to write them
    std::int64_t end_ = 0;
    std::string problem_;
    std::function<void(const std::string&)> tell_; // none: it has been told
    std::thread
        keeping_; // up with what is noted; without one, it is up to who notes, and the system
    std::condition_variable ends_;
    bool is_ending_ = false, is_to_be_synced_ = false;
};

} // namespace raylane::scenes
