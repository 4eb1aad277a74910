#include "scenes/tool/ranks/ranks.hpp"

// Disables MPI's C++ bindings, which have been withdrawn.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <algorithm>
#include <cstdlib>
#include <mpi.h>
#include <numeric>
#include <vector>

namespace raylane::scenes {

namespace {

/// Counts in MPI are ints, so longer messages are sent in pieces of this many bytes.
constexpr std::size_t max_bytes = std::size_t{1} << 30;

class MpiRanks : public Ranks {
  public:
    MpiRanks() {
        MPI_Comm_dup(MPI_COMM_WORLD, &all_);
        MPI_Comm_rank(all_, &rank_);
        MPI_Comm_size(all_, &size_);
        MPI_Comm host;
        MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &host);
        MPI_Comm_size(host, &size_of_host_);
        first_of_host_ = rank_;
        MPI_Bcast(&first_of_host_, 1, MPI_INT, 0, host);
        MPI_Comm_free(&host);
        MPI_Win_allocate(rank_ == 0 ? 2 * sizeof *numbers_ : 0, sizeof *numbers_, MPI_INFO_NULL,
                         all_, static_cast<void*>(&numbers_), &window_);
        MPI_Win_lock_all(0, window_);
    }

    ~MpiRanks() override {
        MPI_Win_unlock_all(window_);
        MPI_Win_free(&window_);
        MPI_Comm_free(&all_);
        MPI_Finalize();
    }

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    int size_of_host() const override { return size_of_host_; }
    int first_of_host() const override { return first_of_host_; }

    void gather(const void* bytes, std::size_t count, const char*& gathered,
                const std::size_t*& counts) override {
        std::vector<int> lengths(static_cast<std::size_t>(size_));
        const int length = static_cast<int>(count);
        MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, all_);
        std::vector<int> places(lengths.size());
        std::exclusive_scan(lengths.begin(), lengths.end(), places.begin(), 0);
        gathered_.resize(static_cast<std::size_t>(places.back()) +
                         static_cast<std::size_t>(lengths.back()));
        MPI_Allgatherv(bytes, length, MPI_BYTE, gathered_.data(), lengths.data(), places.data(),
                       MPI_BYTE, all_);
        counts_.assign(lengths.begin(), lengths.end());
        gathered = gathered_.data();
        counts = counts_.data();
    }

    void broadcast(void* bytes, std::size_t count) override {
        auto* at = static_cast<char*>(bytes);
        while (count > 0) {
            const std::size_t piece = std::min(count, max_bytes);
            MPI_Bcast(at, static_cast<int>(piece), MPI_BYTE, 0, all_);
            at += piece;
            count -= piece;
        }
    }

    bool all_are_here() override {
        if (!waits_) MPI_Ibarrier(all_, &barrier_);
        int done = 0;
        MPI_Test(&barrier_, &done, MPI_STATUS_IGNORE);
        waits_ = done == 0;
        return !waits_;
    }

    void reset_counter() override {
        MPI_Barrier(all_);
        if (rank_ == 0) {
            for (const MPI_Aint which : {counter, mark})
                change(which, 0, MPI_REPLACE);
        }
        MPI_Barrier(all_);
    }

    std::uint64_t add_to_counter(std::uint64_t count) override {
        return change(counter, count, MPI_SUM);
    }

    std::uint64_t add_to_mark(std::uint64_t count) override { return change(mark, count, MPI_SUM); }

    void send(const void* bytes, std::size_t count) override {
        const auto* at = static_cast<const char*>(bytes);
        MPI_Isend(at, static_cast<int>(count), MPI_BYTE, 0, tag, all_, &sending_);
    }

    bool sent() override {
        int done = 0;
        MPI_Test(&sending_, &done, MPI_STATUS_IGNORE);
        return done != 0;
    }

    bool has_message(std::size_t& count) override {
        int is_there = 0;
        MPI_Status status;
        MPI_Improbe(MPI_ANY_SOURCE, tag, all_, &is_there, &message_, &status);
        if (is_there == 0) return false;
        MPI_Get_count(&status, MPI_BYTE, &length_);
        count = static_cast<std::size_t>(length_);
        return true;
    }

    void receive(void* bytes) override {
        MPI_Mrecv(bytes, length_, MPI_BYTE, &message_, MPI_STATUS_IGNORE);
    }

  private:
    static constexpr int tag = 1;
    static constexpr MPI_Aint counter = 0, mark = 1; // indices in the window

    std::uint64_t change(MPI_Aint which, std::uint64_t by, MPI_Op how) {
        std::uint64_t before = 0;
        MPI_Fetch_and_op(&by, &before, MPI_UINT64_T, 0, which, how, window_);
        MPI_Win_flush(0, window_);
        return before;
    }

    MPI_Comm all_ = MPI_COMM_NULL;
    int rank_ = 0, size_ = 1, size_of_host_ = 1, first_of_host_ = 0;
    MPI_Win window_ = MPI_WIN_NULL;
    std::uint64_t* numbers_ = nullptr; // at rank 0
    MPI_Request barrier_ = MPI_REQUEST_NULL, sending_ = MPI_REQUEST_NULL;
    bool waits_ = false;
    MPI_Message message_ = MPI_MESSAGE_NULL;
    int length_ = 0;
    std::vector<char> gathered_;
    std::vector<std::size_t> counts_;
};

} // namespace

extern "C" [[gnu::visibility("default")]] Ranks* raylane_join_ranks(const char** why) {
#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION < 5
    // Before version 5, Open MPI chooses a component for one-sided communication that fails over
    // TCP.
    ::setenv("OMPI_MCA_osc", "^rdma", 0);
#endif
    int provided = MPI_THREAD_SINGLE;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS ||
        provided < MPI_THREAD_SERIALIZED) {
        *why = "this MPI does not support calls from several threads (MPI_THREAD_SERIALIZED)";
        return nullptr;
    }
    return new MpiRanks;
}

} // namespace raylane::scenes
