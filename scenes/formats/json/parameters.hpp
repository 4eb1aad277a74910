#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Returns true for "$name" and "-$name", which stand for numbers.
bool is_reference(std::string_view text);

/// Returns true for letters, digits and underscores that do not begin with a digit.
bool is_parameter_name(std::string_view name);

/// The numbers that "$name" stands for, by name.
class Parameters {
  public:
    struct Number {
        std::string text; ///< as a message quotes it
        double value;
    };

    Parameters() = default;
    /// Takes values that override those of the file.
    explicit Parameters(const std::map<std::string, double>& given);

    /// True while a parameter without a value may get one later in the file.
    bool expects_more = false;

    /// True if a known error may keep some parameters from having a value.
    bool may_lack_some = false;

    /// Adds a parameter of the file, unless its value is given.
    void add_default(std::string_view name, double value);
    /// Marks a parameter as invalid, unless its value is given.
    void add_wrong(std::string_view name);
    /// Forgets that a parameter is invalid, so that it can be read again.
    void forget_wrong(std::string_view name);
    /// Notes a root key that is missing because of an error.
    void miss(std::string_view key) {
        if (key == "parameters" || key == "include") may_lack_some = true;
    }
    /// Notes a parameter without a value. Returns true if it was noted before.
    bool note_missing(std::string_view name) { return !missing_.emplace(name).second; }
    void forget_missing() { missing_.clear(); }
    /// Returns true if a reference is to an invalid parameter.
    bool is_wrong(std::string_view reference) const;
    /// Returns the number that a reference stands for, and marks the parameter as used. Returns
    /// nothing if the parameter has no value.
    std::optional<Number> find(std::string_view reference);
    /// Returns the names of all known parameters.
    std::vector<std::string_view> names() const;
    /// Returns the first given parameter that nothing refers to.
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
