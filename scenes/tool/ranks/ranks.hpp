#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace raylane::scenes {

/// The processes of one job, on one host or many, as mpirun has started them: ranks from 0 to
/// size() - 1. "Collective" functions must be called by all ranks. Only one thread at a time may
/// call a function. Errors of MPI end the job.
class Ranks {
  public:
    Ranks() = default;
    virtual ~Ranks() = default; ///< collective
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    virtual int size_of_host() const = 0;  ///< ranks on this rank's host
    virtual int first_of_host() const = 0; ///< the lowest of them

    /// Collective: gathers the bytes of all ranks, any number from each. `all` receives them in the
    /// order of the ranks, and `counts` the numbers of bytes (size() of them). Both belong to this
    /// object and are valid until the next call.
    virtual void gather(const void* bytes, std::size_t count, const char*& gathered,
                        const std::size_t*& counts) = 0;
    /// Collective: sends the bytes of rank 0 to all ranks.
    virtual void broadcast(void* bytes, std::size_t count) = 0;
    /// Collective: returns true once all ranks have called this. Call it until it does.
    virtual bool all_are_here() = 0;

    /// Collective: resets the counter and the mark, which the ranks share at rank 0, to 0.
    virtual void reset_counter() = 0;
    /// Adds to the counter and returns its previous value. Rank 0 takes no part in this, but must
    /// be inside of one of these functions now and then.
    virtual std::uint64_t add_to_counter(std::uint64_t count) = 0;
    /// Does the same for the mark, a second counter.
    virtual std::uint64_t add_to_mark(std::uint64_t count) = 0;

    /// Begins to send bytes to rank 0. They must remain valid until sent() returns true.
    virtual void send(const void* bytes, std::size_t count) = 0;
    virtual bool sent() = 0;
    /// At rank 0: returns true if a message has arrived. `count` is its size in bytes, and
    /// receive() returns the bytes.
    virtual bool has_message(std::size_t& count) = 0;
    virtual void receive(void* bytes) = 0;
};

/// Returns true if mpirun, srun or the like have started this process as one of several.
bool is_one_of_several();
/// Returns true as long as this process has not joined the others, and is not rank 0. Errors until
/// then are the same for all ranks, so rank 0 alone reports them.
bool first_rank_says_the_same();
/// Makes each rank report its errors from now on, because each does something different.
void each_rank_speaks();

/// Joins the other ranks by a module that is loaded on demand. Returns null if there are no others.
/// Throws SystemRefused if the module is missing or cannot join.
std::unique_ptr<Ranks> join_ranks();

/// The function of the module. It returns null and sets the reason if it cannot join.
extern "C" using JoinRanks = Ranks * (*)(const char** why);
inline constexpr const char* join_ranks_name = "raylane_join_ranks";

} // namespace raylane::scenes
