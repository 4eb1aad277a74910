#include "scenes/tool/ranks/ranked_tiles.hpp"
#include "scenes/tool/trace/ray_file.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comes_true.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

using namespace raylane;
using scenes::SharedWork;

namespace {

/// Shared state of the threads that play the ranks of a job.
struct Room {
    explicit Room(int count) : size(count) {}

    const int size;
    std::atomic<std::uint64_t> counter = 0, mark = 0;
    std::mutex mutex; // of the members below
    std::condition_variable changed;
    std::deque<std::string> messages;
    std::string broadcasted;
    int rank = 0, round = 0;

    void wait_for_all() {
        std::unique_lock lock(mutex);
        const int mine = round;
        if (++rank == size) {
            rank = 0;
            ++round;
            changed.notify_all();
        } else {
            changed.wait(lock, [&] { return round != mine; });
        }
    }
};

class ThreadRanks : public scenes::Ranks {
  public:
    ThreadRanks(Room& room, int rank) : room_(room), rank_(rank) {}

    int rank() const override { return rank_; }
    int size() const override { return room_.size; }
    int size_of_host() const override { return room_.size; }
    int first_of_host() const override { return 0; }
    void gather(const void*, std::size_t, const char*&, const std::size_t*&) override {
        FAIL("not asked for");
    }
    void broadcast(void* bytes, std::size_t count) override {
        if (rank_ == 0) room_.broadcasted.assign(static_cast<const char*>(bytes), count);
        room_.wait_for_all();
        std::copy_n(room_.broadcasted.data(), count, static_cast<char*>(bytes));
        room_.wait_for_all();
    }
    bool all_are_here() override { return true; }
    void reset_counter() override {
        room_.wait_for_all();
        room_.counter = room_.mark = 0;
        room_.wait_for_all();
    }
    std::uint64_t add_to_counter(std::uint64_t count) override {
        return room_.counter.fetch_add(count);
    }
    std::uint64_t add_to_mark(std::uint64_t count) override { return room_.mark.fetch_add(count); }
    void send(const void* bytes, std::size_t count) override {
        const std::lock_guard lock(room_.mutex);
        room_.messages.emplace_back(static_cast<const char*>(bytes), count);
    }
    bool sent() override { return true; }
    bool has_message(std::size_t& count) override {
        const std::lock_guard lock(room_.mutex);
        if (room_.messages.empty()) return false;
        count = room_.messages.front().size();
        return true;
    }
    void receive(void* bytes) override {
        const std::lock_guard lock(room_.mutex);
        std::copy(room_.messages.front().begin(), room_.messages.front().end(),
                  static_cast<char*>(bytes));
        room_.messages.pop_front();
    }

  private:
    Room& room_;
    int rank_;
};

/// Calls as_rank(ranks) for each of `count` ranks, all at a time.
void as_ranks(int count, const std::function<void(ThreadRanks&)>& as_rank) {
    Room room(count);
    std::vector<std::thread> ranks;
    for (int rank = 0; rank < count; ++rank)
        ranks.emplace_back([&room, &as_rank, rank] {
            ThreadRanks own(room, rank);
            as_rank(own);
        });
    for (std::thread& rank : ranks)
        rank.join();
}

std::string result_of(std::size_t piece) {
    return std::string(piece % 1000, static_cast<char>('a' + piece % 26));
}

/// Calls `visit` with each piece that next() gives, on several threads, until it gives none.
void for_each_piece(SharedWork& work, int threads,
                    const std::function<void(SharedWork::Piece)>& visit) {
    std::vector<std::thread> workers;
    for (int thread = 0; thread < threads; ++thread)
        workers.emplace_back([&] {
            while (std::optional<SharedWork::Piece> piece = work.next())
                visit(*std::move(piece));
        });
    for (std::thread& thread : workers)
        thread.join();
}

} // namespace

TEST_CASE("ranks do each piece of their work once and the first rank gets all results") {
    for (const int ranks : {1, 2, 5})
        for (const std::size_t count : {0, 1, 7, 3000}) {
            CAPTURE(ranks, count);
            std::vector<std::atomic<int>> done(count);
            std::vector<std::atomic<int>> arrived(count);
            std::atomic<int> wrong = 0, left = 0;
            as_ranks(ranks, [&](ThreadRanks& own) {
                std::atomic<bool> stop = false;
                SharedWork work(own, count, 2, stop);
                for_each_piece(work, 2, [&](const SharedWork::Piece& piece) {
                    if (piece.is_done) {
                        if (piece.bytes != result_of(piece.number)) ++wrong;
                    } else {
                        ++done[piece.number];
                        // Some pieces take longer than others, so that they end in another order.
                        if (piece.number % 500 == 0)
                            std::this_thread::sleep_for(std::chrono::milliseconds(5));
                        work.done(piece.number, result_of(piece.number));
                    }
                    if (own.rank() == 0) ++arrived[piece.number];
                });
                left += static_cast<int>(work.finish().size());
            });
            const auto is_one = [](const auto& number) { return number == 1; };
            CHECK(std::all_of(done.begin(), done.end(), is_one));
            CHECK(std::all_of(arrived.begin(), arrived.end(), is_one));
            CHECK(wrong == 0);
            CHECK(left == 0);
        }
}

namespace {

/// Records the largest number of the pieces that are begun, in any order.
class Begun {
  public:
    void begin(std::size_t number) {
        std::size_t before = max_;
        while (before < number && !max_.compare_exchange_weak(before, number)) {
        }
    }
    std::size_t max() const { return max_; }
    /// Waits until this piece or a later one is begun. Returns false after ten minutes.
    bool wait_for(std::size_t number) const {
        return tests::comes_true([&] { return max() >= number; });
    }
    /// Waits until no further piece has begun for a tenth of a second, so that a mistake can show.
    /// A correct program passes whatever this pause is.
    void tempt() const {
        std::size_t before = max();
        for (int still = 0; still < 100; ++still) {
            if (std::exchange(before, max()) != max()) still = 0;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

  private:
    std::atomic<std::size_t> max_ = 0;
};

} // namespace

TEST_CASE("no piece is begun a window or more ahead of a slow one") {
    constexpr std::size_t count = 2000, window = 24;
    const tests::TemporaryDirectory directory;
    std::string text;
    for (std::size_t piece = 0; piece < count; ++piece)
        text += result_of(piece);
    for (const int ranks : {1, 2, 3})
        for (const std::size_t slow : {0, 700}) {
            CAPTURE(ranks, slow);
            Begun begun;
            std::atomic<std::size_t> max_ahead = 0, left = 0;
            std::atomic<bool> others_go_on = false;
            const std::filesystem::path path = directory.path() / "a";
            as_ranks(ranks, [&](ThreadRanks& own) {
                std::optional<scenes::AtomicFile> file;
                std::optional<scenes::OrderedOutput> output;
                if (own.rank() == 0) output.emplace(file.emplace(path), window);
                std::atomic<bool> stop = false;
                SharedWork work(own, count, 2, stop, window);
                for_each_piece(work, 2, [&](SharedWork::Piece piece) {
                    if (!piece.is_done) {
                        begun.begin(piece.number);
                        if (piece.number == slow) {
                            // The others do not wait earlier than they have to.
                            others_go_on = begun.wait_for(slow + window / 2);
                            begun.tempt();
                            max_ahead = begun.max() - slow;
                        }
                        piece.bytes = result_of(piece.number);
                    }
                    if (output)
                        work.written(output->add(piece.number, std::move(piece.bytes)));
                    else
                        work.done(piece.number, piece.bytes);
                });
                left += work.finish().size();
                if (file) file->commit();
            });
            CHECK(others_go_on);
            CHECK(max_ahead < window);
            CHECK(left == 0);
            CHECK(tests::content_of(path) == text);
        }
}

TEST_CASE("threads without ranks begin no piece a window or more ahead") {
    constexpr std::size_t count = 2000, window = 10;
    const tests::TemporaryDirectory directory;
    scenes::AtomicFile file(directory.path() / "a");
    scenes::OrderedOutput output(file, window);
    Begun begun;
    std::atomic<std::size_t> taken = 0, max_ahead = 0;
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread)
        threads.emplace_back([&] {
            for (std::size_t number = 0; (number = taken++) < count && output.wait_for(number);) {
                begun.begin(number);
                if (number == 0) {
                    begun.wait_for(window - 1);
                    begun.tempt();
                    max_ahead = begun.max();
                }
                output.add(number, result_of(number));
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    CHECK(max_ahead == window - 1);
    file.commit();
    std::string text;
    for (std::size_t piece = 0; piece < count; ++piece)
        text += result_of(piece);
    CHECK(tests::content_of(directory.path() / "a") == text);
    // A piece that fails instead of being added.
    std::atomic<bool> may_begin = true;
    std::thread waits([&] { may_begin = output.wait_for(count + window); });
    output.cancel();
    waits.join();
    CHECK_FALSE(may_begin);
}

TEST_CASE("a stop ends ranks that wait for pieces that are never written") {
    std::atomic<int> begun = 0;
    as_ranks(3, [&](ThreadRanks& own) {
        std::atomic<bool> stop = false;
        SharedWork work(own, 100'000, 2, stop, 24);
        for_each_piece(work, 2, [&](const SharedWork::Piece& piece) {
            if (!piece.is_done) {
                ++begun;
                work.done(piece.number, {});
            }
            if (own.rank() == 0 && begun == 24) stop = true; // no piece is ever written
        });
        work.finish();
    });
    CHECK(begun < 1000);
}

TEST_CASE("a stop of one rank stops all ranks and every finished piece arrives") {
    for (const int who : {0, 1, 2}) {
        constexpr std::size_t count = 100'000'000;
        std::mutex mutex;
        std::set<std::size_t> done, arrived;
        std::atomic<int> stopped_first = 0;
        as_ranks(3, [&](ThreadRanks& own) {
            std::atomic<bool> stop = false;
            SharedWork work(own, count, 2, stop);
            for_each_piece(work, 2, [&](const SharedWork::Piece& piece) {
                if (!piece.is_done) work.done(piece.number, {});
                // Slow pieces keep the sets small. The test is right without this pause.
                std::this_thread::sleep_for(std::chrono::microseconds(100));
                const std::lock_guard lock(mutex);
                if (!piece.is_done) done.insert(piece.number);
                if (own.rank() == 0) arrived.insert(piece.number);
                if (own.rank() == who && done.size() > 300) stop = true;
            });
            const auto late = work.finish();
            const std::lock_guard lock(mutex);
            for (const SharedWork::Piece& piece : late)
                arrived.insert(piece.number);
            if (own.rank() == 0) stopped_first = stop ? 1 : 0;
        });
        CHECK(done.size() < count / 10); // all have stopped
        CHECK(arrived == done);
        CHECK(stopped_first == 1);
    }
}

TEST_CASE("a thread that fails leaves no thread waiting") {
    as_ranks(2, [](ThreadRanks& own) {
        std::atomic<bool> stop = false;
        SharedWork work(own, 1000, 2, stop);
        if (own.rank() == 0) {
            std::thread fails([&] {
                // The test is right at any moment. After this pause the others mostly wait.
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                work.cancel();
            });
            for_each_piece(work, 2, [](const SharedWork::Piece&) {});
            fails.join();
        } else {
            while (work.next()) {
            } // never marked as done: rank 0 waits for it
        }
    });
    SUCCEED();
}
