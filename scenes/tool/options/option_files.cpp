#include "scenes/tool/options/option_files.hpp"

#include "scenes/files/input_file.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace raylane::scenes {

namespace {

/// Removes the quotes around a value that was copied from a command line.
std::string_view without_quotes(std::string_view value) {
    const bool is_quoted = value.size() >= 2 && value.front() == value.back() &&
                           (value.front() == '"' || value.front() == '\'');
    return is_quoted ? value.substr(1, value.size() - 2) : value;
}

bool is_argument(const AnyOption& option) {
    return !option.names().starts_with('-');
}

bool takes_value(const AnyOption& option) {
    return !option.properties().type.empty() || is_argument(option);
}

/// Returns the option of a name such as "--size" or "-o", or null.
const AnyOption* option_named(std::string_view name, const OptionTable& options) {
    for (const AnyOption* option : options.options()) {
        for (const std::string_view known : parts_of(option->names(), ','))
            if (known == name) return option;
        if (const char* former = option->former_name(); former != nullptr && former == name)
            return option;
    }
    return nullptr;
}

/// Returns the option that an argument begins, as in "--size", "--size=3x3" or "-oa.png", or null.
const AnyOption* option_in(std::string_view argument, const OptionTable& options) {
    if (argument.starts_with("--"))
        return option_named(argument.substr(0, argument.find('=')), options);
    return argument.starts_with('-') ? option_named(argument.substr(0, 2), options) : nullptr;
}

bool excludes(const AnyOption& option, const AnyOption& other) {
    const std::vector<std::string>& excluded = option.properties().excluded;
    return std::find(excluded.begin(), excluded.end(), other.name()) != excluded.end();
}

/// Returns the first argument without dashes, such as SCENE, or null.
const AnyOption* argument_of(const OptionTable& options) {
    for (const AnyOption* option : options.options())
        if (is_argument(*option)) return option;
    return nullptr;
}

/// Calls refuse(message) for a value with another option or a comment behind it. Quotes around the
/// value make these a part of it.
template <class Refuse>
void require_alone(std::string_view value, const OptionTable& options, const Refuse& refuse) {
    if (value != without_quotes(value)) return;
    const std::vector<std::string_view> words = parts_of(value, ' ');
    for (const std::string_view word : words) {
        const bool is_color = word.find_first_not_of("0123456789abcdefABCDEF", 1) == word.npos;
        if (word.data() != words[0].data() && word.starts_with('#') && (word == "#" || !is_color))
            refuse("must have no comment behind a value: put the comment on another line, or "
                   "the value between quotes");
        if (word.starts_with("--") && option_in(word, options) != nullptr)
            refuse("must be one option a line, got " + printable(word) +
                   ", too: put it on another line, or the value between quotes");
    }
}

/// Returns a suggestion for an unknown option.
std::string suggestion_for(std::string_view name, const OptionTable& options) {
    std::vector<std::string_view> known;
    for (const AnyOption* option : options.options())
        for (std::string_view one : parts_of(option->names(), ','))
            if (one.starts_with("--")) known.push_back(one.substr(2));
    return suggestion(name.substr(std::min(name.find_first_not_of('-'), name.size())), known, "--");
}

} // namespace

OptionFiles::OptionFiles(const std::vector<std::string>& arguments, const OptionTable& options,
                         const OptionTable& others) {
    std::vector<std::string> rest;
    const AnyOption* before = nullptr; // the option whose value an argument is
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        std::string argument = arguments[i];
        const bool is_value = before != nullptr;
        if (is_value && before->properties().is_pair && is_number(argument) &&
            i + 1 < arguments.size() && is_number(arguments[i + 1]))
            argument += ' ' + arguments[++i];
        const AnyOption* const option = is_value ? nullptr : option_in(argument, options);
        if (option != nullptr) on_command_line_.push_back(option);
        if (!is_value && argument.size() > 1 && argument.front() == '@') {
            read(argument.substr(1), options, others);
            continue;
        }
        if (!is_value && argument_of(options) != nullptr && !argument.starts_with('-'))
            on_command_line_.push_back(argument_of(options));
        const std::size_t name = argument.starts_with("--") ? argument.size() : 2;
        const bool has_value = argument.size() > name || argument.find('=') != std::string::npos;
        before = option != nullptr && takes_value(*option) && !has_value ? option : nullptr;
        rest.push_back(std::move(argument));
    }
    std::vector<std::string> first, lists, last;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const auto& [file, number, option, value] = lines_[i];
        if (!is_used(i)) continue;
        if (is_argument(*option)) {
            first.push_back(value);
            continue;
        }
        std::vector<std::string>& to = option->is_list() ? lists : last;
        to.push_back(option->name());
        if (takes_value(*option)) to.push_back(value);
    }
    for (const std::vector<std::string>* part : {&first, &lists, &rest, &last})
        arguments_.insert(arguments_.end(), part->begin(), part->end());
}

void OptionFiles::read(const std::string& file, const OptionTable& options,
                       const OptionTable& others) {
    InputFile input(file);
    input.take_as_text();
    const std::string text = input.read_all();
    const std::size_t before = lines_.size();
    std::size_t number = 0;
    for (const std::string_view raw_line : parts_of(text, '\n')) {
        ++number;
        const std::string_view line = trimmed(raw_line);
        if (line.empty() || line.front() == '#') continue;
        const auto refuse = [&](const std::string& message) {
            throw BadInput({{file, {number, 0}, "", message}});
        };
        const std::size_t end = std::min(line.find_first_of(" \t="), line.size());
        const std::string name(line.substr(0, end));
        const AnyOption* option = option_named(name, options);
        std::string_view value = line.substr(std::min(end + 1, line.size()));
        if (end < line.size() && (option_named("--" + name, options) != nullptr ||
                                  option_named("--" + name, others) != nullptr))
            refuse("must begin with dashes: --" + name);
        if (option == nullptr && !name.starts_with('-')) {
            option = argument_of(options);
            value = line;
        }
        if (option == nullptr && option_named(name, others) != nullptr) continue;
        if (option == nullptr)
            refuse("unknown option \"" + printable(name) + '"' + suggestion_for(name, options));
        require_alone(trimmed(value), options, refuse);
        value = without_quotes(trimmed(value));
        if (takes_value(*option) == value.empty())
            refuse(option->name() + (value.empty()
                                         ? ": must have a value, " + option->properties().type
                                         : ": must have no value"));
        for (std::size_t i = before; i < lines_.size(); ++i)
            if (lines_[i].option == option && !option->is_list())
                refuse(option->name() + ": must be given only once, got it in line " +
                       std::to_string(lines_[i].number) + ", too");
        try {
            option->check(std::string(value));
        } catch (const BadInput& bad) {
            refuse(bad.what());
        }
        lines_.push_back({file, number, option, std::string(value)});
    }
}

bool OptionFiles::is_used(std::size_t line) const {
    const AnyOption& option = *lines_[line].option;
    if (option.is_list() && !is_argument(option)) return true;
    for (std::size_t i = line + 1; i < lines_.size(); ++i)
        if (lines_[i].option == &option ||
            (lines_[i].file != lines_[line].file &&
             (excludes(*lines_[i].option, option) || excludes(option, *lines_[i].option))))
            return false;
    return std::none_of(
        on_command_line_.begin(), on_command_line_.end(), [&](const AnyOption* other) {
            return other == &option || excludes(*other, option) || excludes(option, *other);
        });
}

BadInput OptionFiles::with_place(const BadInput& bad) const {
    const std::string_view text = bad.what();
    // The message quotes the line's value, or a word of it.
    const auto fits = [&](const Line& line) {
        constexpr std::string_view before = "got \"";
        const std::size_t got = text.find(before);
        if (text.find(line.value) != std::string_view::npos) return true;
        if (got == std::string_view::npos) return false;
        const std::string_view word = text.substr(got + before.size());
        return line.value.find(word.substr(0, word.find('"'))) != std::string::npos;
    };
    const Line* found = nullptr;
    std::size_t count = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Line& line = lines_[i];
        const std::string name = line.option->name();
        if (!is_used(i) || !text.starts_with(name + ":")) continue;
        ++count;
        if (found == nullptr || fits(line)) found = &line;
    }
    const bool is_elsewhere = found != nullptr && found->option->is_list() &&
                              std::find(on_command_line_.begin(), on_command_line_.end(),
                                        found->option) != on_command_line_.end();
    if (found == nullptr || ((count > 1 || is_elsewhere) && !fits(*found))) return bad;
    return BadInput({{found->file, {found->number, 0}, "", bad.what()}});
}

} // namespace raylane::scenes
