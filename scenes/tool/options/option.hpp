#pragma once

#include "core/scene/surroundings.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/words.hpp"
#include "simd/wavefront/render.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// The table of options. Each option of a command is one entry: a member that adds itself to the
/// table of its struct. The command line, its help, manual pages, the completion and the options
/// that an image records follow from these entries.
namespace raylane::scenes {

class OptionTable;

/// The default of settings, in the help.
inline constexpr const char* as_in_file = "as the file says";

/// The properties of an option that do not depend on the type of its values.
struct OptionProperties {
    std::string type = {};  ///< in the help: N, or choices, srgb|linear; empty for a flag
    std::string range = {}; ///< in the help, "0 to 1"; empty if the text describes the values
    std::string unit = {};
    std::string standard = {};              ///< the default, in words
    std::string for_atoms = {};             ///< the default for files of atoms, if it is another
    std::vector<std::string> excluded = {}; ///< names of options that it goes without
    bool is_pair = false; ///< on the command line, the value may be two numbers, as two words
    bool is_required = false;
    bool is_recorded = false; ///< an image records the option
};

/// A rendered image, which records its options.
struct Rendered {
    const core::Settings& settings;
    const core::Settings& own; ///< settings of the scene
    const simd::RenderOptions& options;
    bool names_size; ///< false if images of a sequence may differ in size
};

/// The values of an option: how words on a command line become values, and their use.
template <class T>
struct Values : OptionProperties {
    using When = std::function<bool(const Rendered&)>;

    /// `parse_` throws BadInput, in the form "--spp: must be ..., got ...". `text_`: the inverse,
    /// for defaults and recorded settings.
    Values(std::string type_, std::string range_,
           std::function<T(const std::string& option, const std::string& text)> parse_,
           std::function<std::string(const T&)> text_ = {})
        : OptionProperties{.type = std::move(type_), .range = std::move(range_)},
          parse(std::move(parse_)), text(std::move(text_)) {}

    Values in(std::string unit_) && {
        unit = std::move(unit_);
        return std::move(*this);
    }
    /// Sets the default in the help, in words.
    Values otherwise(std::string text_, std::string for_atoms_ = "") && {
        standard = std::move(text_);
        for_atoms = std::move(for_atoms_);
        return std::move(*this);
    }
    /// Sets a default that does not depend on the scene.
    Values initially(T value_) && {
        standard = text(value_);
        value = std::move(value_);
        return std::move(*this);
    }
    Values without(std::vector<std::string> names) && {
        excluded = std::move(names);
        return std::move(*this);
    }
    Values in_pairs() && {
        is_pair = true;
        return std::move(*this);
    }
    Values required() && {
        is_required = true;
        return std::move(*this);
    }
    /// Makes images record the option: as it was given, or as the value of `function`.
    Values recorded(std::function<T(const Rendered&)> function = {}, When when_ = {}) && {
        is_recorded = true;
        record = std::move(function);
        when = std::move(when_);
        return std::move(*this);
    }
    /// Makes the option replace a setting, which images record. `field`: a pointer to a member of
    /// core::Settings, or a function that returns a reference to a part of it.
    template <class Field>
    Values replacing(Field field, When when_ = {}) && {
        set = [field](core::Settings& settings, const T& value_) {
            std::invoke(field, settings) = value_;
        };
        standard = as_in_file;
        const core::Settings usual;
        for_atoms = text(std::invoke(field, usual));
        return std::move(*this).recorded(
            [field](const Rendered& rendered) { return std::invoke(field, rendered.settings); },
            std::move(when_));
    }
    /// Does the same for a setting that images omit if they and their scenes have the default.
    template <class Field>
    Values replacing_rarely(Field field) && {
        return std::move(*this).replacing(field, [field](const Rendered& rendered) {
            const core::Settings usual;
            return std::invoke(field, rendered.settings) != std::invoke(field, usual) ||
                   std::invoke(field, rendered.own) != std::invoke(field, usual);
        });
    }

    std::function<T(const std::string&, const std::string&)> parse;
    std::function<std::string(const T&)> text;
    std::optional<T> value = {}; ///< the default
    std::function<void(core::Settings&, const T&)> set = {};
    std::function<T(const Rendered&)> record = {};
    When when = {};
};

/// An option of any type.
class AnyOption {
  public:
    /// `names`: "-o,--output", or "SCENE" for an argument without dashes. `help`: sentences,
    /// without the range and the default.
    AnyOption(OptionTable& table, std::string names, std::string help);
    virtual ~AnyOption() = default;
    AnyOption(const AnyOption&) = delete;
    AnyOption& operator=(const AnyOption&) = delete;

    const std::string& names() const { return names_; }
    const std::string& group() const { return group_; } ///< the heading in the help
    virtual const OptionProperties& properties() const = 0;
    /// Returns the name in messages: "--output" for "-o,--output".
    std::string name() const;
    /// Returns the name in the version before, which is not in the help, or null.
    const char* former_name() const;
    std::string help() const;
    virtual bool is_list() const { return false; }

    bool is_given() const { return !texts_.empty(); }
    void give(std::vector<std::string> texts) { texts_ = std::move(texts); }
    const std::vector<std::string>& texts() const { return texts_; }

    /// Throws BadInput.
    virtual void parse() = 0;
    /// Throws BadInput if the option does not take this value.
    virtual void check(const std::string& text) const = 0;
    virtual void apply_to(core::Settings&) const {}
    /// Returns the values that an image records; that of a flag is empty.
    virtual std::vector<std::string> recorded(const Rendered&) const;

  private:
    std::string names_, group_, help_;
    std::vector<std::string> texts_;
};

/// Options under one heading of the help, which may be part of the options of a command.
class OptionTable {
  public:
    explicit OptionTable(std::string group = "Options") : group_(std::move(group)) {}
    OptionTable(OptionTable& parent, std::string group)
        : whole_(&parent), group_(std::move(group)) {}
    OptionTable(const OptionTable&) = delete;
    OptionTable& operator=(const OptionTable&) = delete;

    void add(AnyOption& option);
    const std::string& group() const { return group_; }
    const std::vector<AnyOption*>& options() const { return options_; }

    /// Parses all texts that were given. Throws BadInput.
    void parse();
    void apply_to(core::Settings& settings) const;
    /// Returns names and values of the options that render the image again.
    std::vector<std::pair<std::string, std::string>> recorded(const Rendered& rendered) const;
    /// Returns the name of the first option that was given, or an empty text.
    std::string first_given() const;
    /// Returns true for the name of one of the options.
    bool has(const std::string& name) const;

  private:
    OptionTable* whole_ = nullptr;
    std::string group_;
    std::vector<AnyOption*> options_;
};

template <class T>
class Option : public AnyOption {
  public:
    Option(OptionTable& table, std::string names, Values<T> values, std::string help)
        : AnyOption(table, std::move(names), std::move(help)), values_(std::move(values)) {}

    /// Returns true if there is a value, which may be a default.
    explicit operator bool() const { return values_.value.has_value(); }
    const T& operator*() const { return *values_.value; }
    const T* operator->() const { return &*values_.value; }
    T value_or(T other) const { return values_.value.value_or(std::move(other)); }
    const std::optional<T>& value() const { return values_.value; }
    std::string text() const { return values_.text(**this); }
    const OptionProperties& properties() const override { return values_; }

    void check(const std::string& text) const override {
        static_cast<void>(values_.parse(name(), text));
    }
    void parse() override {
        if (is_given()) values_.value = values_.parse(name(), texts().front());
    }
    void apply_to(core::Settings& settings) const override {
        if (values_.set && *this) values_.set(settings, **this);
    }
    std::vector<std::string> recorded(const Rendered& rendered) const override {
        if (!values_.record) return AnyOption::recorded(rendered);
        if (values_.when && !values_.when(rendered)) return {};
        return {values_.text(values_.record(rendered))};
    }

  private:
    Values<T> values_;
};

/// An option without a value.
using Flag = Option<bool>;

/// An option that may be given several times, or an argument of several words.
template <class T>
class ListOption : public AnyOption {
  public:
    ListOption(OptionTable& table, std::string names, Values<T> values, std::string help)
        : AnyOption(table, std::move(names), std::move(help)), values_(std::move(values)) {}

    const std::vector<T>& operator*() const { return list_; }
    const OptionProperties& properties() const override { return values_; }
    bool is_list() const override { return true; }
    void check(const std::string& text) const override {
        static_cast<void>(values_.parse(name(), text));
    }
    void parse() override {
        for (const std::string& text : texts())
            list_.push_back(values_.parse(name(), text));
    }

  private:
    Values<T> values_;
    std::vector<T> list_;
};

/// --threads
class ThreadsOption : public Option<int> {
  public:
    explicit ThreadsOption(OptionTable& table);
    /// Returns the value, or default_threads(), which may depend on the environment.
    int count() const;
};

template <class T>
Values<T> choice(const std::vector<std::pair<std::string_view, T>>& choices) {
    std::string type;
    for (const auto& [name, value] : choices)
        type.append(type.empty() ? "" : "|").append(name);
    return {type, "",
            [=](const std::string& option, const std::string& text) {
                return choice_named(option, text, choices);
            },
            [=](const T& wanted) {
                for (const auto& [name, value] : choices)
                    if (value == wanted) return std::string(name);
                return std::string();
            }};
}

Values<bool> flag();
Values<int> whole(int least, int most);
/// Returns the integer root of a square number.
Values<int> square_of(int max_root);
Values<float> number(float least, float most, std::string type = "X");
Values<std::string> word(std::string type);
/// The name of a file, which must not be empty.
Values<std::string> file_name(std::string type = "FILE");
/// The same, for a required argument without dashes.
Values<std::string> file_argument();
inline constexpr const char* any_scene =
    "Scene or atoms, in any format that render reads; - is standard input.";
/// WIDTHxHEIGHT of an image
Values<std::pair<int, int>> image_size();

/// Resolution of sizes on paper without another one.
inline constexpr float usual_dpi = 300.0F;

/// The size of an image in pixels, or on paper.
struct ImageSize {
    double width;
    double height;         ///< 0: in proportion to the width
    bool on_paper = false; ///< in inches

    /// Returns width and height in pixels, for the proportions of another size. Throws BadInput,
    /// for --size.
    std::pair<int, int> in_pixels(double dpi, const std::pair<int, int>& proportions) const;
};
/// WIDTHxHEIGHT in pixels, or a width or both in cm, mm or in.
Values<ImageSize> image_size_on_paper();
Values<core::Precision> precisions();

/// Returns the default name of an output: the scene's file name without its folder and with another
/// extension.
std::string default_output(const std::filesystem::path& scene, const std::string& ending);

/// Throws BadInput if `file`, which is to be written, is the file of another argument, under any
/// name.
void require_other_file(const std::string& option, const std::string& file,
                        const std::string& other_option, const std::string& other_file);
/// Does the same for the argument SCENE. If that file is not a scene, the error says so instead.
void require_other_than_scene(const std::string& option, const std::string& file,
                              const std::string& scene);
/// Does the same for two output files. Only one of them may be standard output.
void require_other_output(const std::string& option, const std::string& file,
                          const std::string& other_option, const std::string& other_file);

} // namespace raylane::scenes
