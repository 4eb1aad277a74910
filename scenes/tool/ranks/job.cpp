#include "scenes/tool/ranks/job.hpp"

#include "scenes/files/atomic_file.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/module.hpp"
#include "scenes/files/number.hpp"
#include "scenes/tool/exit.hpp"
#include "scenes/tool/ranks/ranks.hpp"
#include "scenes/tool/system.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

bool has_joined = false;
bool speaks = false;

/// Returns the value of an environment variable, if it is a number.
std::optional<int> number_in(const char* variable) {
    const char* const text = std::getenv(variable);
    return text != nullptr ? to_int(text) : std::nullopt; // allocates no memory
}

std::string host_name() {
    char name[256] = "";
    static_cast<void>(::gethostname(name, sizeof name - 1));
    return name;
}

/// Waits without using a processor, unlike MPI itself.
void wait_for_all(Ranks& ranks) {
    while (!ranks.all_are_here())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

std::vector<std::string> gathered(Ranks& ranks, const std::string& text) {
    wait_for_all(ranks);
    const char* gathered = nullptr;
    const std::size_t* counts = nullptr;
    ranks.gather(text.data(), text.size(), gathered, counts);
    std::vector<std::string> texts;
    for (int rank = 0; rank < ranks.size(); ++rank) {
        texts.emplace_back(gathered, counts[rank]);
        gathered += counts[rank];
    }
    return texts;
}

/// Fills a piece from standard input. Returns the number of bytes, which is smaller at the end of
/// the input, or -1 with errno set.
std::int64_t read_input(std::vector<char>& piece) {
    std::size_t filled = 0;
    while (filled < piece.size()) {
        const ssize_t count = ::read(STDIN_FILENO, piece.data() + filled, piece.size() - filled);
        if (count == 0) break;
        if (count > 0)
            filled += static_cast<std::size_t>(count);
        else if (errno != EINTR)
            return -1;
    }
    return static_cast<std::int64_t>(filled);
}

/// Collects the standard input that all ranks share. Errors are thrown at the end, when all ranks
/// have received it.
class SharedInput {
  public:
    void append(std::span<const char> piece) {
        attempt([&] {
            if (!memory_) file_.emplace(memory_.emplace("raylane input").path());
            file_->write(piece);
        });
    }
    /// Throws SystemRefused.
    void become_standard_input() {
        attempt([&] {
            if (!memory_) memory_.emplace("raylane input");
            if (file_) file_->commit();
            memory_->become_standard_input();
        });
        if (refusal_ != 0) throw SystemRefused("standard input", "keep in memory", refusal_);
    }

  private:
    template <class Step>
    void attempt(const Step& step) {
        if (refusal_ != 0) return;
        try {
            step();
        } catch (const SystemRefused& refused) {
            refusal_ = refused.error_number;
        }
    }

    std::optional<MemoryFile> memory_;
    std::optional<AtomicFile> file_;
    int refusal_ = 0; // errno of the first error
};

} // namespace

// Slurm sets its own variables for single programs of a job, too. With srun, those of PMI decide.
bool is_one_of_several() {
    for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
        if (number_in(variable).value_or(0) > 1) return true;
    return std::getenv("PMIX_RANK") != nullptr && number_in("SLURM_NTASKS").value_or(0) > 1;
}

bool first_rank_says_the_same() {
    if (has_joined || speaks || !is_one_of_several()) return false;
    for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
        if (std::getenv(variable) != nullptr) return number_in(variable) != 0;
    return false;
}

void each_rank_speaks() {
    speaks = true;
}

std::unique_ptr<Ranks> join_ranks() {
    if (!is_one_of_several()) return nullptr;
    has_joined = true;
    const std::string failure = "cannot join the other ranks";
    const auto join = reinterpret_cast<JoinRanks>(function_of(
        {"raylane-mpi.so", join_ranks_name, "MPI at build time (Debian: libopenmpi-dev)"},
        failure));
    const char* why = "";
    Ranks* const ranks = join(&why);
    if (ranks == nullptr) throw SystemRefused(failure + ": " + printable(why, 400));
    return std::unique_ptr<Ranks>(ranks);
}

Job::Job() : ranks_(join_ranks()) {
    if (!ranks_) return;
    rank_ = ranks_->rank();
    size_ = ranks_->size();
}

Job::~Job() {
    // The other ranks do not know of the exception, so parting would wait for them. The end of this
    // process ends them.
    if (std::uncaught_exceptions() > exceptions_ && !fails_together_)
        static_cast<void>(ranks_.release());
    part();
}

void Job::part() {
    if (!ranks_) return;
    wait_for_all(*ranks_);
    ranks_.reset();
}

void Job::together(const std::function<void()>& work) {
    if (!ranks_) return work();
    std::exception_ptr own;
    std::string report;
    try {
        work();
    } catch (...) {
        own = std::current_exception();
        const Failure failure = failure_being_handled();
        report = static_cast<char>(failure.code);
        report += failure.text;
        if (!is_first()) report += " (rank " + std::to_string(rank()) + ", " + host_name() + ")";
    }
    const std::vector<std::string> reports = gathered(*ranks_, report);
    const auto failed = std::find_if(reports.begin(), reports.end(),
                                     [](const std::string& text) { return !text.empty(); });
    if (failed == reports.end()) return;
    fails_together_ = true;
    if (is_first() && own) std::rethrow_exception(own);
    if (!is_first()) throw RankFailed::silent();
    throw RankFailed(static_cast<unsigned char>(failed->front()), failed->substr(1));
}

std::string Job::told_on_host(const std::string& text) {
    if (!ranks_) return text;
    return gathered(*ranks_, text)[static_cast<std::size_t>(ranks_->first_of_host())];
}

void Job::require_same(const std::string& text, const std::string& what) {
    if (!ranks_) return;
    const std::vector<std::string> texts = gathered(*ranks_, text);
    together([&] {
        if (text != texts.front()) throw RankFailed(3, what + " differs from that of rank 0");
    });
}

void Job::share_standard_input() {
    if (!ranks_ || std::exchange(has_shared_input_, true)) return;
    SharedInput input;
    std::int64_t count = 0;
    int unreadable = 0; // at rank 0
    std::vector<char> piece(std::size_t{4} << 20);
    do {
        if (is_first()) {
            count = read_input(piece);
            if (count < 0) unreadable = errno;
        }
        wait_for_all(*ranks_); // for as long as the input takes to arrive
        ranks_->broadcast(&count, sizeof count);
        if (count <= 0) break;
        ranks_->broadcast(piece.data(), static_cast<std::size_t>(count));
        input.append(std::span(piece).first(static_cast<std::size_t>(count)));
    } while (true);
    together([&] {
        if (unreadable != 0) throw SystemRefused("standard input", "read", unreadable);
        input.become_standard_input();
    });
}

int Job::share_of_threads(int threads) const {
    const bool is_bound = threads < static_cast<int>(std::thread::hardware_concurrency());
    if (!ranks_ || is_bound) return threads;
    return std::max(1, threads / ranks_->size_of_host());
}

} // namespace raylane::scenes
