#include "scenes/tool/ranks/ranks.hpp"

#include "scenes/errors.hpp"
#include "scenes/number.hpp"
#include "scenes/tool/module.hpp"

#include <cstdlib>
#include <optional>

namespace raylane::scenes {

namespace {

bool has_joined = false;
bool speaks = false;

/// Returns the value of an environment variable, if it is a number.
std::optional<int> number_in(const char* variable) {
    const char* const text = std::getenv(variable);
    return text != nullptr ? to_int(text) : std::nullopt; // allocates no memory
}

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

} // namespace raylane::scenes
