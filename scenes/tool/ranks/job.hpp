#pragma once

#include "scenes/tool/ranks/ranks.hpp"

#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace raylane::scenes {

/// Another rank has failed, and so this one has to end. Rank 0 says why, the others nothing: they
/// end as if all were well, or mpirun would end rank 0 before it has said so.
struct RankFailed : std::exception {
    int code;         ///< to exit with
    std::string text; ///< empty: nothing is to be said
    RankFailed(int code_, std::string text_) : code(code_), text(std::move(text_)) {}
    static RankFailed silent() { return {0, ""}; }
    const char* what() const noexcept override { return text.c_str(); }
};

/// The job that this process has a part in: by itself, or as one of several ranks that mpirun has
/// started.
class Job {
  public:
    /// Joins the others, if there are any. Throws SystemRefused.
    Job();
    /// Parts, but where an exception ends this rank alone.
    ~Job();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Null: this process is all of it.
    Ranks* ranks() const { return ranks_.get(); }
    int size() const { return size_; }
    int rank() const { return rank_; }
    /// The one that says what is to be said, and writes what is to be written.
    bool is_first() const { return rank_ == 0; }
    /// True if there are others on this host.
    bool shares_host() const { return ranks_ != nullptr && ranks_->size_of_host() > 1; }
    bool is_first_of_host() const { return ranks_ == nullptr || ranks_->first_of_host() == rank_; }

    /// What each rank does for itself, all at a time. If one of them fails, all throw: that one its
    /// error if it is rank 0, else rank 0 a RankFailed with its text, and all others one without.
    void together(const std::function<void()>& work);
    /// All together: the text that the first rank of each host has for those on it.
    std::string told_on_host(const std::string& text);
    /// All together: fails unless this text is the same for all.
    void require_same(const std::string& text, const std::string& what);
    /// All together: from now on standard input is rank 0's at each of them, which has it in
    /// memory, and begins at its start. Once; after that, nothing. Alone: it stays what it is.
    void share_standard_input();
    /// All together, once they need each other no more: from now on each is by itself.
    void part();
    /// Of several ranks on one host each has a share of its processors, unless MPI has bound it to
    /// some.
    int share_of_threads(int threads) const;

  private:
    std::unique_ptr<Ranks> ranks_;
    int rank_ = 0, size_ = 1;
    int exceptions_ = std::uncaught_exceptions();
    bool fails_together_ = false, has_shared_input_ = false;
};

} // namespace raylane::scenes
