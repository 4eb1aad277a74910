#include "scenes/tool/ranks/shared_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace raylane::scenes {

namespace {

using std::chrono_literals::operator""us;
using std::chrono_literals::operator""ms;

/// Precedes the bytes of a piece in a message. Two numbers have special meanings and no bytes: all
/// ranks must stop; this rank has sent everything.
struct PieceHead {
    std::uint64_t number;
    std::uint64_t bytes;
};
constexpr std::uint64_t stop_number = ~std::uint64_t{0}, end_number = stop_number - 1;
constexpr std::uint64_t beyond_all = std::uint64_t{1} << 60;

/// Messages of this size get no more pieces.
constexpr std::size_t long_message = std::size_t{1} << 24;

constexpr double seconds_at_once = 0.1;

std::string piece_of(std::uint64_t number, std::string_view bytes) {
    const PieceHead head{number, bytes.size()};
    std::string piece(reinterpret_cast<const char*>(&head), sizeof head);
    return piece += bytes;
}

double seconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

} // namespace

SharedWork::SharedWork(Ranks& ranks, std::size_t count, int threads, std::atomic<bool>& stop,
                       std::size_t window)
    : ranks_(ranks), count_(count), threads_(threads), window_(window), stop_(stop),
      // Where hosts share no memory, the counter waits until rank 0 calls MPI.
      pause_(ranks.size_of_host() == ranks.size() ? Clock::duration(1ms) : Clock::duration(100us)) {
    ranks_.reset_counter();
    thread_ = std::thread([this] { run(); });
}

SharedWork::~SharedWork() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

std::optional<SharedWork::Piece> SharedWork::next() {
    std::unique_lock lock(mutex_);
    for (;;) {
        if (is_over_ || stop_) return std::nullopt;
        if (!received_.empty()) {
            Piece piece = std::move(received_.front());
            received_.pop_front();
            return piece;
        }
        if (!taken_.empty() && may_begin(taken_.front())) {
            const std::size_t number = taken_.front();
            taken_.pop_front();
            ++begun_;
            if (is_short()) wake_.notify_one();
            return Piece{number, false, {}};
        }
        if (taken_.empty() && is_exhausted() && (!is_first() || here_ + there_ == count_)) {
            more_.notify_all(); // no other thread has a reason to wait
            return std::nullopt;
        }
        ++waiting_;
        wake_.notify_one();
        more_.wait_for(lock, 50ms); // by then, stop_ may have been set
        --waiting_;
    }
}

void SharedWork::done(std::size_t number, std::string_view bytes) {
    if (is_first()) return;
    std::string piece = piece_of(number, bytes);
    const std::lock_guard lock(mutex_);
    outbox_.push_back(std::move(piece));
    wake_.notify_one();
}

void SharedWork::written(std::size_t next) {
    const std::lock_guard lock(mutex_);
    if (next <= written_) return; // another thread was faster
    written_ = next;
    if (waiting_ > 0) more_.notify_all();
}

void SharedWork::cancel() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    more_.notify_all();
    wake_.notify_one();
}

std::deque<SharedWork::Piece> SharedWork::finish() {
    {
        const std::lock_guard lock(mutex_);
        is_finishing_ = true;
        wake_.notify_one();
    }
    thread_.join();
    return std::move(received_);
}

double SharedWork::pieces_per_second() const {
    return static_cast<double>(begun_) / std::max(1e-6, seconds(Clock::now() - start_));
}

bool SharedWork::may_begin(std::size_t number) const {
    return window_ == no_window || number < written_ + window_;
}

/// Returns true if a taken piece may not be begun yet, as far as this rank knows.
bool SharedWork::lacks_room() const {
    return !taken_.empty() && !may_begin(taken_.back());
}

/// Returns true if more pieces should be taken.
bool SharedWork::is_short() const {
    if (is_exhausted() || stop_) return false;
    if (waiting_ > 0 && taken_.empty()) return true;
    return static_cast<double>(taken_.size()) < 2.0 * latency_ * pieces_per_second();
}

std::size_t SharedWork::chunk() const {
    if (begun_ == 0) return static_cast<std::size_t>(threads_);
    const std::size_t fair = (count_ - counter_) / (8 * static_cast<std::size_t>(ranks_.size()));
    const double soon = pieces_per_second() * seconds_at_once;
    const std::size_t least = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(latency_ * pieces_per_second())));
    const std::size_t wanted = std::max(least, std::min(fair, static_cast<std::size_t>(soon)));
    if (window_ == no_window) return wanted;
    // Otherwise the other ranks would have no space in the window.
    const std::size_t share = window_ / (4 * static_cast<std::size_t>(ranks_.size()));
    return std::min(wanted, std::max<std::size_t>(1, share));
}

void SharedWork::take(std::unique_lock<std::mutex>& lock) {
    const std::size_t wanted = chunk();
    lock.unlock();
    const Clock::time_point before = Clock::now();
    const std::uint64_t first = ranks_.add_to_counter(wanted);
    const double latency = seconds(Clock::now() - before);
    lock.lock();
    latency_ = latency_ == 0.0 ? latency : 0.75 * latency_ + 0.25 * latency;
    const std::size_t end = std::min<std::uint64_t>(count_, first + wanted);
    for (std::size_t number = first; number < end; ++number) {
        taken_.push_back(number);
        ++here_;
    }
    counter_ = std::max<std::size_t>(counter_, std::min<std::uint64_t>(count_, first + wanted));
    more_.notify_all();
}

/// At rank 0: tells the other ranks how many pieces are written.
void SharedWork::tell_written(std::unique_lock<std::mutex>& lock) {
    const std::uint64_t more = written_ - told_;
    told_ = written_;
    lock.unlock();
    ranks_.add_to_mark(more);
    lock.lock();
}

/// At other ranks: asks rank 0 how many pieces are written.
void SharedWork::ask_written(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    const std::uint64_t written = ranks_.add_to_mark(0);
    lock.lock();
    if (written == written_) return;
    written_ = written;
    more_.notify_all();
}

/// At rank 0: receives a message. Returns true if there was one.
bool SharedWork::receive() {
    std::size_t bytes = 0;
    if (!ranks_.has_message(bytes)) return false;
    std::string message(bytes, '\0');
    ranks_.receive(message.data());
    const std::lock_guard lock(mutex_);
    for (std::size_t at = 0; at < message.size();) {
        PieceHead head{};
        std::memcpy(&head, message.data() + at, sizeof head);
        at += sizeof head;
        if (head.number == stop_number) {
            stop_ = true;
        } else if (head.number == end_number) {
            ++ended_;
        } else {
            received_.push_back({head.number, true, message.substr(at, head.bytes)});
            ++there_;
        }
        at += head.bytes;
    }
    more_.notify_all();
    return true;
}

/// Sends waiting pieces. Returns true if something is not sent yet.
bool SharedWork::send(std::unique_lock<std::mutex>& lock) {
    if (is_sending_) {
        lock.unlock();
        is_sending_ = !ranks_.sent();
        lock.lock();
    }
    if (is_sending_) return true;
    if (outbox_.empty() && is_finishing_ && !std::exchange(has_ended_, true))
        outbox_.push_back(piece_of(end_number, {}));
    if (outbox_.empty()) return false;
    for (sending_.clear(); !outbox_.empty() && sending_.size() < long_message; outbox_.pop_front())
        sending_ += outbox_.front();
    is_sending_ = true;
    lock.unlock();
    ranks_.send(sending_.data(), sending_.size());
    lock.lock();
    return true;
}

/// Stops all ranks after one of them was stopped. Rank 0 does this by leaving no pieces.
void SharedWork::spread_stop(std::unique_lock<std::mutex>& lock) {
    has_spread_ = true;
    if (!is_first()) return outbox_.push_back(piece_of(stop_number, {}));
    lock.unlock();
    ranks_.add_to_counter(beyond_all);
    ranks_.add_to_mark(beyond_all); // nothing is written any more, so no rank must wait for it
    lock.lock();
}

void SharedWork::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        if (is_over_ && !is_finishing_) return;
        if (stop_ && !has_spread_) spread_stop(lock);
        while (is_short())
            take(lock);
        bool is_busy = false;
        if (is_first()) {
            if (told_ != written_) tell_written(lock);
            lock.unlock();
            while (receive())
                is_busy = true;
            lock.lock();
            if (is_finishing_ && ended_ == ranks_.size() - 1) return;
        } else {
            is_busy = send(lock);
            if (is_finishing_ && !is_busy) return;
            if (lacks_room()) ask_written(lock);
        }
        const bool looks = is_first() || is_busy || lacks_room();
        wake_.wait_for(lock, looks ? pause_ : Clock::duration(50ms), [&] {
            return is_short() || is_over_ || (!is_sending_ && (is_finishing_ || !outbox_.empty()));
        });
    }
}

} // namespace raylane::scenes
