#include "scenes/formats/pov/includes.hpp"

#include "scenes/formats/pov/include_macros.hpp"
#include "scenes/formats/pov/include_tables.hpp"

#include <algorithm>
#include <cctype>

namespace raylane::scenes::pov {

namespace {

/// Removes and returns the part of a text before a separator. Removes the separator, too.
std::string_view taken(std::string_view& text, std::string_view separator) {
    const std::size_t end = text.find(separator);
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + separator.size());
    return part;
}

/// Declares each "NAME 0.5 1 0; " of a table, with its numbers in place of the '@' of a
/// declaration.
void declare_table(std::string_view rows, std::string_view value, StandardFile& file) {
    const std::size_t at = value.find('@');
    while (!rows.empty()) {
        std::string_view numbers = taken(rows, "; ");
        const std::string_view name = taken(numbers, " ");
        std::string list(numbers);
        std::replace(list.begin(), list.end(), ' ', ',');
        std::string text(value);
        if (at != std::string_view::npos) text.replace(at, 1, list);
        file.declarations.insert_or_assign(std::string(name),
                                           "#declare " + std::string(name) + " = " + text + ";\n");
    }
}

/// Adds each declaration that is at the beginning of a line.
void declare_text(std::string_view text, StandardFile& file) {
    constexpr std::string_view next = "\n#";
    taken(text, next);
    while (!text.empty()) {
        // "#end" of a macro is a part of its declaration.
        std::size_t end = text.find(next);
        while (end != std::string_view::npos && text.substr(end + 2).starts_with("end"))
            end = text.find(next, end + 2);
        const std::string_view statement = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + next.size());
        std::string_view name = statement.substr(statement.find(' ') + 1);
        const auto* last = std::find_if(name.begin(), name.end(), [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_';
        });
        name = name.substr(0, static_cast<std::size_t>(last - name.begin()));
        file.declarations.insert_or_assign(std::string(name), "#" + std::string(statement) + ";\n");
    }
}

/// Declares T_Brass_1A to T_Silver_5E, for each pigment P_Brass1 in each finish F_MetalA.
void declare_metals(StandardFile& file) {
    const auto value_of = [](const std::string& declaration) {
        const std::size_t begin = declaration.find(" = ") + 3;
        return declaration.substr(begin, declaration.rfind(";\n") - begin);
    };
    const std::string pigments = "P_", finishes = "F_Metal";
    for (auto pigment = file.declarations.lower_bound(pigments);
         pigment != file.declarations.end() && pigment->first.starts_with(pigments); ++pigment)
        for (auto finish = file.declarations.lower_bound(finishes);
             finish != file.declarations.end() && finish->first.starts_with(finishes); ++finish) {
            const auto& [of, color] = *pigment;
            const std::string name = "T_" + of.substr(2, of.size() - 3) + "_" + of.back() +
                                     finish->first.substr(finishes.size());
            file.declarations.insert_or_assign(
                name, "#declare " + name + " = texture { pigment { " + value_of(color) + " } " +
                          value_of(finish->second) + " };\n");
        }
}

/// Declares T_Stone1 as Stone1, and so on.
void declare_without_prefix(const StandardFile& stones, StandardFile& file) {
    for (const auto& [name, declaration] : stones.declarations)
        if (name.starts_with("T_"))
            file.declarations.insert_or_assign(
                name.substr(2), std::string(declaration).erase(sizeof("#declare ") - 1, 2));
}

std::vector<StandardFile> all_files() {
    std::vector<StandardFile> files;
    const auto file = [&](std::string_view name) -> StandardFile& {
        const auto known = std::find_if(files.begin(), files.end(),
                                        [&](const StandardFile& f) { return f.name == name; });
        return known != files.end() ? *known : files.emplace_back(StandardFile{name, {}, {}});
    };
    for (const Inclusion& inclusion : inclusions)
        file(inclusion.file).includes.push_back(inclusion.includes);
    for (const NamesNotRead& names : names_not_read)
        for (std::string_view left = names.names; !left.empty();)
            file(names.file).declarations.insert_or_assign(std::string(taken(left, " ")), "");
    for (const Table& table : tables)
        declare_table(table.rows, table.value, file(table.file));
    declare_metals(file("metals.inc"));
    declare_metals(file("golds.inc"));
    declare_without_prefix(StandardFile(file("stones1.inc")), file("stoneold.inc"));
    declare_text(shapes_old_inc, file("shapes_old.inc"));
    declare_text(shapes_inc, file("shapes.inc"));
    declare_text(shapes2_inc, file("shapes2.inc"));
    declare_text(transforms_inc, file("transforms.inc"));
    declare_text(math_inc, file("math.inc"));
    declare_text(glass_inc, file("glass.inc"));
    declare_text(rand_inc, file("rand.inc"));
    return files;
}

} // namespace

const StandardFile* standard_file(std::string_view name) {
    static const std::vector<StandardFile> files = all_files();
    const auto found = std::find_if(files.begin(), files.end(),
                                    [&](const StandardFile& file) { return file.name == name; });
    return found == files.end() ? nullptr : &*found;
}

} // namespace raylane::scenes::pov
