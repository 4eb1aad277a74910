#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace raylane::scenes {

/// The processes of one job, on one host or many, as mpirun has started them: ranks from 0 to
/// size() - 1. What all have to call together says so; all else is to be called by one thread at a
/// time. Errors of MPI end the job.
class Ranks {
  public:
    Ranks() = default;
    virtual ~Ranks() = default; ///< all together
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    virtual int size_of_host() const = 0;  ///< ranks on this rank's host
    virtual int first_of_host() const = 0; ///< the lowest of them

    /// All together: the bytes of each rank, of which every rank may have as many as it likes, one
    /// after the other in `all`, their numbers in `counts` (size() of them). Both are the ranks',
    /// and there until the next call.
    virtual void gather(const void* bytes, std::size_t count, const char*& all,
                        const std::size_t*& counts) = 0;
    /// All together: rank 0's bytes to all.
    virtual void broadcast(void* bytes, std::size_t count) = 0;
    /// All together: true once all ranks have called this. To be asked until it is.
    virtual bool all_are_here() = 0;

    /// All together: the counter and the mark that the ranks share, at rank 0, are 0 again.
    virtual void reset_counter() = 0;
    /// Adds to it, and says what it was. Rank 0 takes no part in that, but has to be inside of one
    /// of these functions now and then.
    virtual std::uint64_t add_to_counter(std::uint64_t count) = 0;
    /// The same of the mark, which is another one.
    virtual std::uint64_t add_to_mark(std::uint64_t count) = 0;

    /// Begins to send bytes to rank 0, which are to stay where they are until sent() is true.
    virtual void send(const void* bytes, std::size_t count) = 0;
    virtual bool sent() = 0;
    /// Rank 0: the number of bytes that somebody has sent and receive() gives, if any.
    virtual bool has_message(std::size_t& count) = 0;
    virtual void receive(void* bytes) = 0;
};

/// True if mpirun, srun or the like have started this process as one of several.
bool is_one_of_several();
/// True as long as this has not joined the others, and is not rank 0: what is wrong by then is so
/// for all of them.
bool first_rank_says_the_same();
/// From now on that is not so: each does something of its own.
void each_rank_speaks();

/// Joins the others, by a module that is loaded for it. Null if there are none. Throws
/// SystemRefused where there is no such module.
std::unique_ptr<Ranks> join_ranks();

/// What the module has: null, and why, if there is no joining.
extern "C" using JoinRanks = Ranks * (*)(const char** why);
inline constexpr const char* join_ranks_name = "raylane_join_ranks";

} // namespace raylane::scenes
