#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/objects.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes::pov {

Tuple color_of(const Pigment& pigment) {
    Tuple color = pigment.color;
    if (pigment.kind == PigmentKind::color) return color;
    for (std::size_t i = 0; i < 5; ++i)
        color.at[i] = 0.5 * (color.at[i] + pigment.other.at[i]);
    return color;
}

namespace {

struct Weighted {
    double weight;
    Texture texture;
};

/// Returns the share of light by which the finish multiplies a colour.
double share_of(const Finish& finish) {
    return finish.ambient + finish.emission + finish.diffuse;
}

/// Returns the colour that is as bright with another finish as with its own.
Tuple color_with(const Texture& texture, const Finish& finish) {
    Tuple color = color_of(texture.pigment);
    const double own = share_of(texture.finish), other = share_of(finish);
    if (own == other || other == 0.0) return color;
    for (std::size_t i = 0; i < 3; ++i)
        color.at[i] *= own / other;
    return color;
}

/// Returns the mean finish. Weights sum to 1.
Finish finish_of(const std::vector<Weighted>& textures) {
    Finish mean = textures.front().texture.finish;
    const bool same = std::all_of(textures.begin(), textures.end(), [&](const Weighted& other) {
        return other.texture.finish == mean;
    });
    if (same) return mean;
    for (double Finish::*share : {&Finish::ambient, &Finish::emission, &Finish::diffuse,
                                  &Finish::brilliance, &Finish::phong, &Finish::phong_size,
                                  &Finish::specular, &Finish::roughness, &Finish::reflection}) {
        mean.*share = 0.0;
        for (const auto& [weight, texture] : textures)
            mean.*share += weight * texture.finish.*share;
    }
    return mean;
}

/// Returns one texture in place of several. Weights sum to 1.
Texture mean_of(const std::vector<Weighted>& textures) {
    Texture mean{{}, finish_of(textures)};
    mean.pigment.color = {{}, 5};
    for (const auto& [weight, texture] : textures) {
        const Tuple color = color_with(texture, mean.finish);
        for (std::size_t i = 0; i < 5; ++i)
            mean.pigment.color.at[i] += weight * color.at[i];
    }
    return mean;
}

/// The other patterns, which are rendered as one colour.
constexpr std::string_view other_patterns[] = {
    "agate",     "aoi",       "average",       "boxed",   "bozo",     "bumps",
    "cells",     "crackle",   "cylindrical",   "dents",   "facets",   "function",
    "granite",   "image_map", "image_pattern", "julia",   "leopard",  "magnet",
    "mandel",    "marble",    "density_file",  "onion",   "pavement", "pigment_pattern",
    "planar",    "potential", "quilted",       "radial",  "ripples",  "slope",
    "spherical", "spiral1",   "spiral2",       "spotted", "tiling",   "waves",
    "wood",      "wrinkles",  "material_map"};

using ListEntries = std::vector<std::pair<double, core::Vec3d>>;
/// A pattern with a list: the approximate share of each entry, and its default colour.
struct ListPattern {
    std::string_view name;
    ListEntries entries;
};
const ListEntries six_colors = {{1.0 / 6, {0, 0, 1}}, {1.0 / 6, {0, 1, 0}}, {1.0 / 6, {1, 0, 0}},
                                {1.0 / 6, {1, 0, 1}}, {1.0 / 6, {0, 1, 1}}, {1.0 / 6, {1, 1, 0}}};
const ListPattern list_patterns[] = {
    {"checker", {{0.5, {0, 0, 1}}, {0.5, {0, 1, 0}}}},
    {"brick", {{0.25, {0.5, 0.5, 0.5}}, {0.75, {0.6, 0.15, 0.15}}}},
    {"object", {{0.5, {0, 0, 1}}, {0.5, {0, 1, 0}}}},
    {"hexagon", {{1.0 / 3, {0, 0, 1}}, {1.0 / 3, {0, 1, 0}}, {1.0 / 3, {1, 0, 0}}}},
    {"square", {{0.25, {0, 0, 1}}, {0.25, {0, 1, 0}}, {0.25, {1, 0, 0}}, {0.25, {1, 0, 1}}}},
    {"triangular", six_colors},
    {"cubic", six_colors},
};

/// Words behind a pattern that change it, each with a number, a vector or nothing.
constexpr std::string_view changes[] = {
    "turbulence", "octaves",    "omega",           "lambda",        "frequency",    "phase",
    "ramp_wave",  "sine_wave",  "triangle_wave",   "scallop_wave",  "cubic_wave",   "poly_wave",
    "accuracy",   "exponent",   "metric",          "offset",        "solid",        "form",
    "control0",   "control1",   "map_type",        "interpolate",   "once",         "brick_size",
    "mortar",     "agate_turb", "noise_generator", "quick_color",   "quick_colour", "uv_mapping",
    "use_index",  "use_color",  "use_colour",      "no_bump_scale", "coords",       "interior",
    "exterior",   "size"};

class PatternReader {
  public:
    PatternReader(Tokens& tokens, Texture& texture) : tokens_(tokens), texture_(texture) {}

    bool read() {
        const Token word = tokens_.peek();
        if (const std::optional<MapOf> kind = map_of(word)) {
            tokens_.next();
            set(read_map(tokens_, *kind), word.place);
            return true;
        }
        const auto list = std::find_if(std::begin(list_patterns), std::end(list_patterns),
                                       [&](const auto& entry) { return word.is(entry.name); });
        if (list != std::end(list_patterns)) {
            tokens_.next();
            read_list(*list, word);
        } else if (tokens_.accept("gradient")) {
            begin_gradient();
        } else if (word.is_one_of(other_patterns)) {
            tokens_.next();
            read_other(word);
        } else if (word.is_one_of(changes) || word.is("warp")) {
            tokens_.next();
            read_change(word);
        } else {
            return false;
        }
        return true;
    }

  private:
    Pigment& pigment() { return texture_.pigment; }

    Texture read_item() {
        if (tokens_.accept("texture")) return *read_texture(tokens_);
        Texture item{{}, texture_.finish};
        if (tokens_.accept("pigment"))
            item.pigment = read_pigment(tokens_, tokens_.default_texture->pigment);
        else
            item.pigment.color = read_color(tokens_);
        return item;
    }
    bool at_item() { return tokens_.at("texture") || tokens_.at("pigment") || at_tuple(tokens_); }

    /// Reads "checker rgb 1, rgb 0", and other lists with as many entries as the pattern has.
    void read_list(const ListPattern& pattern, const Token& word) {
        const bool is_object = word.is("object");
        if (is_object) {
            tokens_.expect("{");
            read_object(tokens_);
            tokens_.accept(",");
        }
        std::vector<Weighted> items;
        for (const auto& [weight, color] : pattern.entries) {
            Texture item{{}, texture_.finish};
            item.pigment.color = {{color.x, color.y, color.z}, 5};
            if (at_item()) item = read_item();
            tokens_.accept(",");
            items.push_back({weight, std::move(item)});
        }
        if (is_object) tokens_.expect("}");
        if (word.is("checker"))
            set_two(PigmentKind::checker, items[0].texture, items[1].texture, word.place);
        else
            set_one(mean_of(items), word);
    }

    void begin_gradient() {
        Pigment gradient;
        gradient.kind = PigmentKind::gradient;
        gradient.direction = read_vector(tokens_);
        gradient.motion = pigment().motion;
        gradient.other = {{1.0, 1.0, 1.0, 0.0, 0.0}, 5};
        pigment() = gradient;
        tokens_.accept(",");
    }

    void set_one(const Texture& mean, const Token& word) {
        tokens_.remark(word.place,
                       "pattern " + word.quoted() + " is not supported: its mean colour is used");
        const Shared<Motion> motion = pigment().motion;
        texture_ = mean;
        pigment().motion = motion;
    }

    void set_two(PigmentKind kind, const Texture& first, const Texture& second,
                 const Place& place) {
        if (first.pigment.kind != PigmentKind::color || second.pigment.kind != PigmentKind::color)
            tokens_.remark(
                place, "patterns in a pattern are not supported: the mean colour of each is used");
        if (first.finish != second.finish)
            tokens_.remark(place,
                           "different finishes in a pattern are not supported: their mean is used");
        texture_.finish = finish_of({{0.5, first}, {0.5, second}});
        pigment().kind = kind;
        pigment().color = color_with(first, texture_.finish);
        pigment().other = color_with(second, texture_.finish);
    }

    void set(const PatternMap& map, const Place& place) {
        if (pigment().kind == PigmentKind::gradient && map.form != PatternMap::Form::other) {
            pigment().in_steps = map.form == PatternMap::Form::steps;
            return set_two(PigmentKind::gradient, map.first, map.last, place);
        }
        if (pigment().kind != PigmentKind::color)
            tokens_.remark(place, "this map of a pattern is not supported: its mean is used");
        set_mean(map, false);
    }

    void set_mean(const PatternMap& map, bool is_weighted) {
        const Shared<Motion> motion = pigment().motion;
        const Finish finish = texture_.finish;
        texture_ = is_weighted ? map.weighted : map.mean;
        if (map.of != MapOf::textures) texture_.finish = finish;
        pigment().motion = motion;
    }

    /// Takes grey for a pattern that is not rendered, unless a map follows.
    void read_other(const Token& word) {
        Texture grey{{}, texture_.finish};
        grey.pigment.color = {{0.5, 0.5, 0.5, 0.0, 0.0}, 5};
        if (word.is("image_map"))
            grey.pigment.color = read_image_color(tokens_).value_or(grey.pigment.color);
        set_one(grey, word);
        if (const std::optional<MapOf> kind = map_of(tokens_.peek()); kind && word.is("average")) {
            tokens_.next();
            set_mean(read_map(tokens_, *kind), true);
        }
        // Skips numbers, strings and the like that belong to the pattern.
        for (;;) {
            const Token& token = tokens_.peek();
            if (token.is("{")) {
                tokens_.skip_braces();
            } else if (token.kind == TokenKind::string || token.is(",") || token.is("df3")) {
                tokens_.next();
            } else if (at_tuple(tokens_) && !begins_color(token)) {
                read_tuple(tokens_);
            } else {
                return;
            }
        }
    }

    void read_change(const Token& word) {
        if (word.is("warp"))
            tokens_.skip_braces();
        else if (word.is("quick_color") || word.is("quick_colour"))
            read_color(tokens_);
        else if (at_tuple(tokens_) && !begins_color(tokens_.peek()))
            read_tuple(tokens_);
        if ((word.is("interior") || word.is("exterior")) && tokens_.accept(","))
            read_tuple(tokens_);
        if (word.is("uv_mapping"))
            tokens_.remark(word.place, "uv_mapping is ignored: patterns are in space");
        else if (pigment().kind != PigmentKind::color && !word.text.starts_with("quick"))
            tokens_.remark(word.place, word.quoted() + " of a pattern is ignored");
    }

    Tokens& tokens_;
    Texture& texture_;
};

/// Weighs entries by their shares of a pattern whose values are uniform from 0 to 1.
void weigh_by_place(std::vector<Weighted>& entries) {
    std::vector<double> places;
    places.reserve(entries.size());
    for (const Weighted& entry : entries)
        places.push_back(std::clamp(entry.weight, 0.0, 1.0));
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double before = i == 0 ? -places[0] : places[i - 1];
        const double behind = i + 1 == entries.size() ? 2.0 - places[i] : places[i + 1];
        entries[i].weight = std::max(behind - before, 0.0);
    }
}

void make_sum_one(std::vector<Weighted>& entries) {
    double sum = 0.0;
    for (const Weighted& entry : entries)
        sum += entry.weight;
    for (Weighted& entry : entries)
        entry.weight = sum > 0.0 ? entry.weight / sum : 1.0 / static_cast<double>(entries.size());
}

/// Distinguishes two entries from 0 to 1, and two entries for each half.
PatternMap::Form form_of(const std::vector<Weighted>& entries) {
    const auto is_at = [&](std::size_t i, double at) { return entries[i].weight == at; };
    const auto same = [&](std::size_t i, std::size_t j) {
        const Texture &a = entries[i].texture, &b = entries[j].texture;
        return a.pigment.kind == PigmentKind::color && b.pigment.kind == PigmentKind::color &&
               a.pigment.color.at == b.pigment.color.at && a.finish == b.finish;
    };
    if (entries.size() == 2 && is_at(0, 0.0) && is_at(1, 1.0)) return PatternMap::Form::run;
    if (entries.size() == 4 && is_at(0, 0.0) && is_at(1, 0.5) && is_at(2, 0.5) && is_at(3, 1.0) &&
        same(0, 1) && same(2, 3))
        return PatternMap::Form::steps;
    return PatternMap::Form::other;
}

/// Reads "0 rgb 1", or in the old syntax two numbers and two colours, up to the bracket.
void read_colors(Tokens& tokens, double at, std::vector<Weighted>& entries) {
    const auto add = [&](double place) {
        Texture texture;
        texture.pigment.color = read_color(tokens);
        entries.push_back({place, std::move(texture)});
        tokens.accept(",");
    };
    const bool is_old = !begins_color(tokens.peek()) && tokens.peek().kind == TokenKind::number;
    const double to = is_old ? read_number(tokens) : at;
    add(at);
    if (is_old) add(to);
    tokens.expect("]");
}

} // namespace

std::optional<MapOf> map_of(const Token& word) {
    if (word.is("color_map") || word.is("colour_map")) return MapOf::colors;
    if (word.is("pigment_map")) return MapOf::pigments;
    if (word.is("texture_map")) return MapOf::textures;
    return std::nullopt;
}

PatternMap read_map(Tokens& tokens, MapOf kind) {
    constexpr std::size_t max_entries = 4096;
    tokens.expect("{");
    if (const auto known = tokens.accept_value<PatternMap>()) {
        tokens.expect("}");
        return *known;
    }
    const Place place = tokens.peek().place;
    std::vector<Weighted> entries;
    while (!tokens.accept("}")) {
        tokens.expect("[");
        // In an average, an entry may have no weight.
        const bool has_place = at_tuple(tokens) && !begins_color(tokens.peek());
        const double at = has_place ? read_number(tokens) : 1.0;
        tokens.accept(",");
        if (kind == MapOf::colors)
            read_colors(tokens, at, entries);
        else if (kind == MapOf::pigments)
            entries.push_back(
                {at, {read_pigment(tokens, tokens.default_texture->pigment, "]"), {}}});
        else
            entries.push_back({at, *read_texture(tokens, "]")});
        tokens.accept(",");
        if (entries.size() > max_entries)
            fail(place, "must have at most " + std::to_string(max_entries) + " entries");
    }
    if (entries.empty()) fail(place, "must have an entry, got an empty map");
    PatternMap map{kind, form_of(entries), entries.front().texture, entries.back().texture};
    std::vector<Weighted> weighted = entries;
    for (Weighted& entry : weighted)
        entry.weight = std::max(entry.weight, 0.0);
    make_sum_one(weighted);
    map.weighted = mean_of(weighted);
    weigh_by_place(entries);
    make_sum_one(entries);
    map.mean = mean_of(entries);
    return map;
}

Shared<Texture> layered(Tokens& tokens, const Shared<Texture>& below, Shared<Texture> above,
                        const Place& place) {
    const auto through = [](const Tuple& color) {
        return std::clamp(color.at[3] + color.at[4], 0.0, 1.0);
    };
    const auto over = [&](const Tuple& top, const Tuple& bottom) {
        Tuple both{{}, 5};
        for (std::size_t i = 0; i < 3; ++i)
            both.at[i] = (1.0 - through(top)) * top.at[i] + through(top) * bottom.at[i];
        both.at[4] = through(top) * through(bottom);
        return both;
    };
    const Tuple top = color_of(above->pigment), bottom = color_of(below->pigment);
    if (through(top) == 0.0) return above;
    tokens.remark(place, "layered textures are not supported: their mean is used");
    const bool is_pattern_below = below->pigment.kind != PigmentKind::color;
    Texture texture = is_pattern_below ? *below : *above;
    texture.finish = finish_of({{1.0 - through(top), *above}, {through(top), *below}});
    for (Tuple* color : {&texture.pigment.color, &texture.pigment.other})
        *color = is_pattern_below ? over(top, *color) : over(*color, bottom);
    return std::make_shared<const Texture>(std::move(texture));
}

bool read_pattern(Tokens& tokens, Texture& texture) {
    return PatternReader(tokens, texture).read();
}

} // namespace raylane::scenes::pov
