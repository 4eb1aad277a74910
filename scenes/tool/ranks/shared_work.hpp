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

/// Pieces of work, by number, that the ranks of a job share: each takes some when it has none left,
/// by the counter at rank 0, and sends there what came of them. A thread of its own does all that
/// is to do with MPI. Others call next() and done(), any number of them.
///
/// Where rank 0 has to write what comes of them in their order, it says how far it is, and no rank
/// begins a piece that is a window ahead of that: what has to be kept is bounded.
///
/// A rank takes as many pieces at a time as last it some tenth of a second, fewer towards the end,
/// and asks for more as long before it needs them as the answer takes.
class SharedWork {
  public:
    /// All together: `count` pieces, for `threads` threads here. `stop` says from outside that no
    /// more are to be begun: if one rank is told so, none begins any, and rank 0's is set.
    SharedWork(Ranks& ranks, std::size_t count, int threads, std::atomic<bool>& stop,
               std::size_t window = no_window);
    /// Without finish(): what has not been sent is lost.
    ~SharedWork();
    SharedWork(const SharedWork&) = delete;
    SharedWork& operator=(const SharedWork&) = delete;

    static constexpr std::size_t no_window = 0;
    struct Piece {
        std::size_t number;
        bool is_done; ///< by another rank, with these bytes; at rank 0 alone
        std::string bytes;
    };
    /// The next piece for the calling thread, for which it waits; none if there are no more. Rank 0
    /// has all: it does pieces, and is given those that others have done.
    std::optional<Piece> next();
    /// What came of a piece, unless it is rank 0 that has done it.
    void done(std::size_t number, std::string_view bytes);
    /// At rank 0, if there is a window: all pieces before that one have been written.
    void written(std::size_t next);
    /// No thread is to wait any more.
    void cancel();
    /// All together, once next() has said that there are no more: returns when all has been sent.
    /// What nobody has been given, as it came behind a stop.
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
    const Clock::duration pause_; // between looks at what has come

    std::mutex mutex_; // of what follows
    std::condition_variable more_, wake_;
    std::deque<std::size_t> taken_;
    std::deque<Piece> received_;
    std::deque<std::string> outbox_;
    std::size_t begun_ = 0;            // here
    std::size_t here_ = 0, there_ = 0; // taken by this rank, and of others received
    int ended_ = 0;                    // ranks from which nothing more will come
    std::size_t counter_ = 0;          // as last seen
    std::uint64_t written_ = 0;        // as last seen
    std::uint64_t told_ = 0;           // to the others, of that
    double latency_ = 0.0;             // of the counter, in seconds
    int waiting_ = 0;                  // threads
    bool is_over_ = false, is_finishing_ = false, has_spread_ = false, has_ended_ = false;
    bool is_exhausted() const { return counter_ >= count_; }

    std::string sending_; // the thread's own, until it is sent
    bool is_sending_ = false;
    std::thread thread_; // the last: it uses the others
};

} // namespace raylane::scenes
