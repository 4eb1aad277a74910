#include "scenes/formats/format.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/built/built_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

constexpr std::pair<std::string_view, Format> endings[] = {
    {".json", Format::json},
    {".nff", Format::nff},
    {".pov", Format::pov},
    {".rl", Format::built},
    {".pdb", Format::pdb},
    {".ent", Format::pdb},
    {".cif", Format::cif},
    {".mmcif", Format::cif},
    {".xyz", Format::xyz},
    {".extxyz", Format::xyz},
    {".gro", Format::gro},
    {".dump", Format::lammps_dump},
    {".lammpstrj", Format::lammps_dump},
    {".data", Format::lammps_data},
    {".lmp", Format::lammps_data},
    {".sdf", Format::mol},
    {".mol", Format::mol},
    {".mol2", Format::mol2},
    {".pqr", Format::pqr},
};

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string_view first_word(std::string_view line) {
    line = trimmed(line);
    return line.substr(0, line.find_first_of(blanks));
}

/// Returns up to `most` first lines of `head`. The last one may be incomplete.
std::vector<std::string_view> lines_of(std::string_view head, std::size_t most) {
    std::vector<std::string_view> lines;
    while (!head.empty() && lines.size() < most) {
        const std::size_t end = std::min(head.find('\n'), head.size());
        lines.push_back(head.substr(0, end));
        head.remove_prefix(std::min(end + 1, head.size()));
    }
    return lines;
}

/// Returns `head` without its leading blanks and comments.
std::string_view without_comments(std::string_view head) {
    for (;;) {
        head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
        const bool is_block = head.starts_with("/*");
        if (!is_block && !head.starts_with("//")) return head;
        const std::size_t end = is_block ? head.find("*/", 2) : head.find('\n');
        head.remove_prefix(end == std::string_view::npos ? head.size() : end + (is_block ? 2 : 1));
    }
}

/// JSON begins with '{', which begins no line of NFF.
bool looks_like_json(std::string_view head) {
    return without_comments(head).starts_with('{');
}

/// Returns true if the text begins with a POV-Ray directive or statement.
bool looks_like_pov(std::string_view head) {
    static constexpr std::array<std::string_view, 13> words = {
        "#version", "#include",        "#declare",   "#local",       "#macro", "#default", "#if",
        "camera",   "global_settings", "background", "light_source", "sphere", "union"};
    head = without_comments(head);
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
        if (!head.starts_with(word)) return false;
        const std::string_view rest = head.substr(word.size());
        const std::string_view next = trimmed(rest.substr(0, rest.find_first_of("{\n")));
        return word[0] == '#' || (next.empty() && rest.find('{') != std::string_view::npos);
    });
}

bool is_binary(std::string_view head) {
    return std::any_of(head.begin(), head.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < ' ' && (byte < '\t' || byte > '\r')) || byte == 0x7F;
    });
}

/// Returns true if the first entity is one of NFF: a view ("v", then "from"), or another one that
/// a number follows. Wavefront OBJ files begin with some of the same letters.
bool looks_like_nff(std::string_view head) {
    static constexpr std::string_view blanks_and_ends = " \t\r\n\v\f";
    const auto next_word = [&] {
        head.remove_prefix(std::min(head.find_first_not_of(blanks_and_ends), head.size()));
        const std::string_view word = head.substr(0, head.find_first_of(blanks_and_ends));
        head.remove_prefix(word.size());
        return word;
    };
    std::string_view word = next_word();
    while (word.starts_with('#')) {
        head.remove_prefix(std::min(head.find('\n'), head.size()));
        word = next_word();
    }
    if (word.empty()) return true; // only comments so far
    if (word == "v") return next_word() == "from";
    static constexpr std::array<std::string_view, 7> others = {"b", "c", "f", "l", "p", "pp", "s"};
    return std::find(others.begin(), others.end(), word) != others.end() && is_number(next_word());
}

/// Returns true if the first word after comments is BEGIN_SCENE, in upper or lower case. The
/// extension .dat is too common to decide.
bool looks_like_tachyon(const std::vector<std::string_view>& lines) {
    static constexpr std::string_view begin = "BEGIN_SCENE";
    for (const std::string_view line : lines) {
        const std::string_view word = first_word(line);
        if (!word.empty() && word[0] != '#')
            return std::equal(word.begin(), word.end(), begin.begin(), begin.end(),
                              [](char a, char b) { return a == b || (a & ~' ') == b; });
    }
    return false;
}

bool looks_like_pdb(const std::vector<std::string_view>& lines) {
    static constexpr std::array<std::string_view, 13> records = {
        "HEADER", "TITLE ", "COMPND", "SOURCE", "KEYWDS", "EXPDTA", "AUTHOR",
        "REMARK", "CRYST1", "MODEL ", "ATOM  ", "HETATM", "OBSLTE"};
    return !lines.empty() &&
           std::any_of(records.begin(), records.end(),
                       [&](std::string_view record) { return lines[0].starts_with(record); });
}

/// Returns true if the first word after comments begins a data block.
bool looks_like_cif(const std::vector<std::string_view>& lines) {
    for (const std::string_view line : lines) {
        const std::string_view word = first_word(line);
        if (!word.empty() && word[0] != '#') return word.starts_with("data_");
    }
    return false;
}

/// Returns true if the fourth line ends with the version of MOL.
bool looks_like_mol(const std::vector<std::string_view>& lines) {
    if (lines.size() < 4) return false;
    const std::string_view counts = trimmed(lines[3]);
    return counts.ends_with("V2000") || counts.ends_with("V3000");
}

/// Returns true if the first line that is no comment is a section of Tripos.
bool looks_like_mol2(const std::vector<std::string_view>& lines) {
    for (const std::string_view line : lines)
        if (const std::string_view word = first_word(line); !word.empty() && word[0] != '#')
            return word.starts_with("@<TRIPOS>");
    return false;
}

/// Refuses trajectories that have positions only, in binary.
void refuse_trajectory(const std::string& name, const std::string& ending) {
    for (const std::string_view binary : {".xtc", ".trr", ".dcd"})
        if (ending == binary)
            throw BadInput(name, "",
                           "has positions without elements: in Python, "
                           "raylane.from_mdanalysis(MDAnalysis.Universe(\"topology.pdb\", \"" +
                               printable(std::filesystem::path(name).filename().string(), 200) +
                               "\")) reads it with its topology");
}

bool is_count(std::string_view line) {
    const std::string_view text = trimmed(line);
    return !text.empty() && to_int(text).value_or(-1) >= 0;
}

/// Returns true for a number of atoms, a comment line, and an element with its coordinates.
bool looks_like_xyz(const std::vector<std::string_view>& lines) {
    if (lines.empty() || !is_count(lines[0])) return false;
    if (lines.size() < 3) return to_int(trimmed(lines[0])) == 0;
    return !first_word(lines[2]).empty() &&
           trimmed(lines[2]).find_first_of(blanks) != std::string_view::npos;
}

/// Returns true for a comment line, a number of atoms, and fields in columns.
bool looks_like_gro(const std::vector<std::string_view>& lines) {
    return lines.size() > 2 && is_count(lines[1]) && lines[2].size() >= 44 &&
           is_number(first_word(lines[2].substr(0, 5))) && lines[2].find('.') >= 24;
}

/// Returns true if one of the lines reads like "10 atoms".
bool looks_like_lammps_data(const std::vector<std::string_view>& lines) {
    return std::any_of(lines.begin(), lines.end(), [](std::string_view line) {
        line = trimmed(line.substr(0, line.find('#')));
        const std::size_t blank = line.find_first_of(blanks);
        return blank != std::string_view::npos && is_count(line.substr(0, blank)) &&
               trimmed(line.substr(blank)) == "atoms";
    });
}

} // namespace

Format format_of(InputFile& file) {
    const auto require_any = [&](std::string_view text) {
        if (text.empty())
            throw BadInput(file.name(), "", "must be a scene or atoms, got an empty file");
    };
    require_any(file.head());
    std::filesystem::path name = file.name();
    std::string ending = ending_of(name);
    if (ending == ".gz") ending = ending_of(name.stem());
    refuse_trajectory(file.name(), ending);
    for (const auto& [known, format] : endings)
        if (ending == known) {
            if (format != Format::built) file.take_as_text();
            return format;
        }

    std::string_view head = file.head();
    if (looks_built(head)) return Format::built;
    if (is_binary(head))
        throw BadInput(file.name(), "",
                       "must be a scene or atoms in a text format, got a binary file");
    file.take_as_text();
    head = file.head();
    require_any(head);
    if (looks_like_json(head)) return Format::json;
    if (looks_like_pov(head)) return Format::pov;
    const std::vector<std::string_view> lines = lines_of(head, 40);
    if (looks_like_tachyon(lines)) return Format::tachyon;
    if (lines[0].starts_with("ITEM: ")) return Format::lammps_dump;
    if (looks_like_pdb(lines)) return Format::pdb;
    if (looks_like_cif(lines)) return Format::cif;
    if (looks_like_mol(lines)) return Format::mol;
    if (looks_like_mol2(lines)) return Format::mol2;
    if (looks_like_xyz(lines)) return Format::xyz;
    if (looks_like_gro(lines)) return Format::gro;
    if (looks_like_nff(head)) return Format::nff;
    if (looks_like_lammps_data(lines)) return Format::lammps_data;
    throw BadInput(
        file.name(), "",
        "must be a scene (.json, .nff, .pov, Tachyon .dat, or .rl from \"raylane build\") or atoms "
        "(.pdb, .pqr, mmCIF or CIF .cif, .xyz, .gro, .mol, .sdf, .mol2, LAMMPS .dump or .data), "
        "got "
        "another format");
}

} // namespace raylane::scenes
