#pragma once

#include "scenes/tool/ranks/ranks.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace raylane::scenes {

/// Pieces of work, by number, that the ranks of a job share. A rank that has no pieces left takes
/// the next numbers from the counter at rank 0, and sends the results to rank 0. A separate thread
/// makes all calls of MPI. Any number of other threads call next() and done().
///
/// If rank 0 must write the results in their order, it tells the others how far it is. No rank
/// begins a piece that is `window` pieces ahead of that. So the number of results to keep is
/// bounded.
///
/// A rank takes enough pieces at a time for about a tenth of a second, and fewer towards the end.
/// It takes more when the pieces that it has left would last less than twice the time that a
/// request to the counter takes.
class SharedWork {
  public:
    /// Collective: `count` pieces, for `threads` threads here. When `stop` becomes true, no more
    /// pieces are begun. If it is set at one rank, all ranks stop, and rank 0's `stop` is set.
    SharedWork(Ranks& ranks, std::size_t count, int threads, std::atomic<bool>& stop,
               std::size_t window = no_window);
    /// Loses results that are not sent, unless finish() was called.
    ~SharedWork();
    SharedWork(const SharedWork&) = delete;
    SharedWork& operator=(const SharedWork&) = delete;

    static constexpr std::size_t no_window = 0;
    struct Piece {
        std::size_t number;
        bool is_done; ///< by another rank, with these bytes; only at rank 0
        std::string bytes;
    };
    /// Waits for the next piece of the calling thread and returns it, or nothing if there are no
    /// more. Rank 0 gets all pieces: some to do, and those that other ranks have done.
    std::optional<Piece> next();
    /// Sends the result of a piece, except at rank 0.
    void done(std::size_t number, std::string_view bytes);
    /// At rank 0 with a window: reports that all pieces before `next` are written.
    void written(std::size_t next);
    /// Releases all waiting threads.
    void cancel();
    /// Collective, after next() has returned nothing. Waits until everything is sent. Returns
    /// pieces that next() has not returned, because they arrived after a stop.
    std::deque<Piece> finish();

  private:
    using Clock = std::chrono::steady_clock;

    bool is_first() const { return ranks_.rank() == 0; }
    void run();
    bool receive();
    void take(std::unique_lock<std::mutex>& lock);
    bool send(std::unique_lock<std::mutex>& lock);
    void spread_stop(std::unique_lock<std::mutex>& lock);
    void tell_written(std::unique_lock<std::mutex>& lock);
    void ask_written(std::unique_lock<std::mutex>& lock);
    bool may_begin(std::size_t number) const;
    bool lacks_room() const;
    bool is_short() const;
    std::size_t chunk() const;
    double pieces_per_second() const;

    Ranks& ranks_;
    const std::size_t count_;
    const int threads_;
    const std::size_t window_; // pieces
    std::atomic<bool>& stop_;
    const Clock::time_point start_ = Clock::now();
    const Clock::duration pause_; // between checks for messages

    std::mutex mutex_; // protects the members below
    std::condition_variable more_, wake_;
    std::deque<std::size_t> taken_;
    std::deque<Piece> received_;
    std::deque<std::string> outbox_;
    std::size_t begun_ = 0;            // at this rank
    std::size_t here_ = 0, there_ = 0; // taken by this rank; received from other ranks
    int ended_ = 0;                    // ranks that have sent everything
    std::size_t counter_ = 0;          // last known value
    std::uint64_t written_ = 0;        // last known value
    std::uint64_t told_ = 0;           // part of it that the other ranks know
    double latency_ = 0.0;             // of the counter, in seconds
    int waiting_ = 0;                  // threads in next()
    bool is_over_ = false, is_finishing_ = false, has_spread_ = false, has_ended_ = false;
    bool is_exhausted() const { return counter_ >= count_; }

    std::string sending_; // used by the thread only, until it is sent
    bool is_sending_ = false;
    std::thread thread_; // last, because it uses the other members
};

} // namespace raylane::scenes
