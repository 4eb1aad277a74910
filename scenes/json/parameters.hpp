#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// True of "$name" and "-$name", that stand for numbers.
bool is_reference(std::string_view text);

/// Letters, digits and underscores, of which the first is no digit.
bool is_parameter_name(std::string_view name);

/// Numbers by name.
class Parameters {
  public:
    struct Number {
        std::string text; ///< as a message quotes it
        double value;
    };

    Parameters() = default;
    /// Values that a file's own do not change.
    explicit Parameters(const std::map<std::string, double>& given);

    /// True while one without a value may have one further on in the file.
    bool expects_more = false;

    /// True if a mistake that is known keeps some from having a value.
    bool may_lack_some = false;

    /// Adds one that a file has, unless that is given.
    void add_default(std::string_view name, double value);
    /// Notes one that has a mistake, unless it is given.
    void add_wrong(std::string_view name);
    /// Forgets that one has a mistake, to read it again.
    void forget_wrong(std::string_view name);
    /// Learns of a root key that is missing by mistake.
    void miss(std::string_view key) {
        if (key == "parameters" || key == "include") may_lack_some = true;
    }
    /// Notes one without a value; true if it has been noted before.
    bool note_missing(std::string_view name) { return !missing_.emplace(name).second; }
    void forget_missing() { missing_.clear(); }
    /// True of a reference to a parameter that has a mistake.
    bool is_wrong(std::string_view reference) const;
    /// What is_reference() stands for, which then counts as used; nothing if it has no value.
    std::optional<Number> find(std::string_view reference);
    /// Of all that have a value.
    std::vector<std::string_view> names() const;
    /// Of those that were given, the first that nothing has referred to.
    std::optional<std::string> first_unused() const;

  private:
    struct Parameter {
        double value;
        bool given = false, used = false, wrong = false;
    };
    std::map<std::string, Parameter, std::less<>> parameters_;
    std::set<std::string, std::less<>> missing_;
};

} // namespace raylane::scenes
