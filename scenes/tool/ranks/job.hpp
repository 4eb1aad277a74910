#pragma once

#include "scenes/tool/ranks/ranks.hpp"

#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace raylane::scenes {

/// Another rank has failed, so this one must end. Rank 0 reports the reason. The others report
/// nothing and end as if successful, or mpirun would end rank 0 before it has reported.
struct RankFailed : std::exception {
    int code;         ///< exit code
    std::string text; ///< empty: nothing is reported
    RankFailed(int code_, std::string text_) : code(code_), text(std::move(text_)) {}
    static RankFailed silent() { return {0, ""}; }
    const char* what() const noexcept override { return text.c_str(); }
};

/// The job of this process, which is alone or one of several ranks that mpirun has started.
class Job {
  public:
    /// Joins the other ranks, if any. Throws SystemRefused.
    Job();
    /// Calls part(), unless an exception ends this rank alone.
    ~Job();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Returns null if this process is alone.
    Ranks* ranks() const { return ranks_.get(); }
    int size() const { return size_; }
    int rank() const { return rank_; }
    /// Returns true for the rank that prints messages and writes files.
    bool is_first() const { return rank_ == 0; }
    /// Returns true if other ranks run on this host.
    bool shares_host() const { return ranks_ != nullptr && ranks_->size_of_host() > 1; }
    bool is_first_of_host() const { return ranks_ == nullptr || ranks_->first_of_host() == rank_; }

    /// Collective: each rank calls `work`. If a rank fails, all ranks throw. Rank 0 throws its own
    /// error if it failed, otherwise a RankFailed with the text of a failed rank. The others throw
    /// a RankFailed without text.
    void together(const std::function<void()>& work);
    /// Collective: returns the text of the first rank on this host.
    std::string told_on_host(const std::string& text);
    /// Collective: fails unless `text` is the same for all ranks.
    void require_same(const std::string& text, const std::string& what);
    /// Collective: replaces standard input by that of rank 0, which each rank keeps in memory and
    /// reads from its start. Only the first call has an effect. A process alone keeps its standard
    /// input.
    void share_standard_input();
    /// Collective: parts the ranks when they do not need each other any more.
    void part();
    /// Returns the number of threads for this rank. Ranks on one host share its processors, unless
    /// MPI has bound this rank to some of them.
    int share_of_threads(int threads) const;

  private:
    std::unique_ptr<Ranks> ranks_;
    int rank_ = 0, size_ = 1;
    int exceptions_ = std::uncaught_exceptions();
    bool fails_together_ = false, has_shared_input_ = false;
};

} // namespace raylane::scenes
