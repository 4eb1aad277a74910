#include "scenes/pov/finishes.hpp"

#include "core/numbers/more_functions.hpp"
#include "scenes/pov/expressions.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes::pov {

namespace {

/// A share, which may be given as a colour: its mean.
double read_share(Tokens& tokens, const char* what) {
    const Place place = tokens.peek().place;
    const Tuple tuple = read_color(tokens);
    const double mean = (tuple.at[0] + tuple.at[1] + tuple.at[2]) / 3.0;
    const auto differs = [&](std::size_t i) { return tuple.at[i] != tuple.at[0]; };
    if (differs(1) || differs(2)) {
        tokens.remark(place, std::string("colours ") + what + ", which is drawn without colour");
        return mean;
    }
    return tuple.at[0];
}

struct MapEntry {
    double at;
    Tuple color;
};

/// "{ [0 rgb 1] [1 rgb 0] }"
std::vector<MapEntry> read_color_map(Tokens& tokens) {
    std::vector<MapEntry> entries;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        tokens.expect("[");
        const double at = read_number(tokens);
        tokens.accept(",");
        // Of old there were two numbers, and two colours.
        const bool is_old = !begins_color(tokens.peek()) && tokens.peek().kind == TokenKind::number;
        const double to = is_old ? read_number(tokens) : at;
        entries.push_back({at, read_color(tokens)});
        tokens.accept(",");
        if (is_old) entries.push_back({to, read_color(tokens)});
        tokens.expect("]");
        if (entries.size() > most_elements) fail(tokens.peek().place, "must have fewer colours");
    }
    return entries;
}

Tuple mean_of(const std::vector<MapEntry>& entries) {
    Tuple mean{{}, 5};
    for (const MapEntry& entry : entries)
        for (std::size_t i = 0; i < 5; ++i)
            mean.at[i] += entry.color.at[i] / static_cast<double>(entries.size());
    return mean;
}

constexpr std::string_view other_patterns[] = {
    "agate",           "aoi",      "average", "boxed",       "bozo",         "brick",
    "bumps",           "cells",    "crackle", "cylindrical", "density_file", "dents",
    "facets",          "function", "granite", "hexagon",     "image_map",    "julia",
    "leopard",         "mandel",   "marble",  "object",      "onion",        "pavement",
    "pigment_pattern", "planar",   "quilted", "radial",      "ripples",      "slope",
    "spherical",       "spiral1",  "spiral2", "spotted",     "square",       "tiling",
    "triangular",      "waves",    "wood",    "wrinkles"};

/// All up to the brace, of which colours give one.
void read_other_pattern(Tokens& tokens, Pigment& pigment, const Token& word) {
    tokens.remark(word.place, "has the pattern " + word.quoted() + ", drawn as one colour");
    bool has_color = false;
    for (std::size_t open = 0; open > 0 || !tokens.at("}");) {
        if (tokens.accept("color_map") || tokens.accept("colour_map")) {
            const std::vector<MapEntry> entries = read_color_map(tokens);
            if (!entries.empty()) pigment.color = mean_of(entries);
            has_color = true;
        } else if (!has_color && begins_color(tokens.peek())) {
            pigment.color = read_color(tokens);
            has_color = true;
        } else {
            const Token token = tokens.next();
            if (token.kind == TokenKind::end)
                fail(token.place, "must be \"}\", got " + token.quoted());
            open += token.is("{") ? 1 : 0;
            open -= token.is("}") ? 1 : 0;
        }
    }
    pigment.kind = PigmentKind::color;
}

void read_checker(Tokens& tokens, Pigment& pigment) {
    pigment.kind = PigmentKind::checker;
    pigment.color = {{0.0, 0.0, 1.0, 0.0, 0.0}, 5};
    pigment.other = {{0.0, 1.0, 0.0, 0.0, 0.0}, 5};
    for (Tuple* color : {&pigment.color, &pigment.other}) {
        if (!at_tuple(tokens)) return;
        *color = read_color(tokens);
        tokens.accept(",");
    }
}

/// One color after the other, or each in its half.
void set_gradient(Tokens& tokens, Pigment& pigment, const std::vector<MapEntry>& entries,
                  const Place& place) {
    const auto is_at = [&](std::size_t i, double at) { return entries[i].at == at; };
    const auto same = [&](std::size_t i, std::size_t j) {
        return entries[i].color.at == entries[j].color.at;
    };
    if (pigment.kind == PigmentKind::gradient) {
        const bool in_steps = entries.size() == 4 && is_at(0, 0.0) && is_at(1, 0.5) &&
                              is_at(2, 0.5) && is_at(3, 1.0) && same(0, 1) && same(2, 3);
        if (in_steps || (entries.size() == 2 && is_at(0, 0.0) && is_at(1, 1.0))) {
            pigment.in_steps = in_steps;
            pigment.color = entries.front().color;
            pigment.other = entries.back().color;
            return;
        }
    }
    tokens.remark(place, "has a map of colours, drawn as one");
    pigment.kind = PigmentKind::color;
    if (!entries.empty()) pigment.color = mean_of(entries);
}

void read_reflection(Tokens& tokens, Finish& finish, const Place& place) {
    if (!tokens.accept("{")) {
        finish.reflection = read_share(tokens, "reflection");
        finish.fresnel = false;
        return;
    }
    double least = 0.0, most = 0.0;
    bool has_range = false;
    if (!tokens.at("}")) {
        most = read_share(tokens, "reflection");
        tokens.accept(",");
        if (at_tuple(tokens)) {
            least = most;
            most = read_share(tokens, "reflection");
            has_range = true;
        }
    }
    finish.fresnel = false;
    while (!tokens.accept("}")) {
        const Token word = tokens.next();
        const double number = at_tuple(tokens) ? read_number(tokens) : 1.0;
        if (word.is("fresnel"))
            finish.fresnel = number != 0.0;
        else if (word.is("falloff") || word.is("exponent") || word.is("metallic"))
            tokens.remark(word.place,
                          "has " + word.quoted() + " of reflection, which is not drawn");
        else
            fail(word.place, "must be of a reflection, got " + word.quoted());
    }
    finish.reflection = has_range && !finish.fresnel ? 0.5 * (least + most) : most;
    if (has_range && !finish.fresnel && least != most)
        tokens.remark(place, "reflects by the angle, which is drawn as the mean of both");
    if (finish.fresnel && (least != 0.0 || most != 1.0))
        tokens.remark(place, "has limits of Fresnel's reflection, which are not drawn");
}

/// Which shares are of all the light that comes back, in all directions.
struct Albedo {
    bool diffuse = false, phong = false, specular = false;
};

/// The shares in the direction where they are largest, as POV-Ray makes them of these.
void set_by_albedo(Finish& finish, const Albedo& is) {
    const double n = 1.0 / finish.roughness;
    if (is.diffuse) finish.diffuse *= 0.5 * (finish.brilliance + 1.0);
    if (is.phong) finish.phong *= 0.5 * (finish.phong_size + 1.0);
    if (is.specular) finish.specular *= (n + 2.0) / (4.0 * (2.0 - core::power(2.0, -0.5 * n)));
}

} // namespace

Pigment read_pigment(Tokens& tokens, Pigment pigment) {
    tokens.expect("{");
    while (!tokens.accept("}")) {
        const Token word = tokens.peek();
        if (const auto known = tokens.accept_value<Pigment>()) {
            pigment = *known;
        } else if (const auto motion = read_motion(tokens)) {
            pigment.motion = both(pigment.motion, motion);
        } else if (tokens.accept("checker")) {
            read_checker(tokens, pigment);
        } else if (tokens.accept("gradient")) {
            pigment.kind = PigmentKind::gradient;
            pigment.direction = read_vector(tokens);
            pigment.color = {{0.0, 0.0, 0.0, 0.0, 0.0}, 5};
            pigment.other = {{1.0, 1.0, 1.0, 0.0, 0.0}, 5};
            tokens.accept(",");
        } else if (tokens.accept("color_map") || tokens.accept("colour_map")) {
            set_gradient(tokens, pigment, read_color_map(tokens), word.place);
        } else if (tokens.accept("quick_color") || tokens.accept("quick_colour")) {
            read_color(tokens);
        } else if (std::find(std::begin(other_patterns), std::end(other_patterns), word.text) !=
                   std::end(other_patterns)) {
            tokens.next();
            read_other_pattern(tokens, pigment, word);
        } else if (at_tuple(tokens)) {
            const bool only_channel = word.is("transmit") || word.is("filter");
            const Tuple before = pigment.color;
            pigment.color = read_color(tokens);
            if (only_channel)
                std::copy(before.at.begin(), before.at.begin() + 3, pigment.color.at.begin());
            pigment.kind = PigmentKind::color;
        } else {
            fail(word.place, "must be of a pigment, got " + word.quoted() + tokens.perhaps_of());
        }
    }
    return pigment;
}

Finish read_finish(Tokens& tokens, Finish finish) {
    Albedo of_albedo;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<Finish>()) {
            finish = *known;
            continue;
        }
        const Token word = tokens.next();
        const auto number = [&] { return read_number(tokens); };
        const auto share = [&](bool& is_albedo) {
            is_albedo = tokens.accept("albedo");
            return read_number(tokens);
        };
        if (word.is("ambient")) {
            finish.ambient = read_share(tokens, "ambient light");
        } else if (word.is("emission")) {
            finish.emission = read_share(tokens, "emission");
        } else if (word.is("diffuse")) {
            finish.diffuse = share(of_albedo.diffuse);
            if (tokens.accept(",")) read_number(tokens);
        } else if (word.is("brilliance")) {
            finish.brilliance = std::max(number(), 0.0);
            if (finish.brilliance != 1.0)
                tokens.remark(word.place, "has brilliance, drawn as less diffuse light");
        } else if (word.is("phong")) {
            finish.phong = share(of_albedo.phong);
        } else if (word.is("phong_size")) {
            finish.phong_size = number();
        } else if (word.is("specular")) {
            finish.specular = share(of_albedo.specular);
        } else if (word.is("roughness")) {
            finish.roughness = number();
            if (!(finish.roughness > 0.0)) fail(word.place, "must be positive");
        } else if (word.is("reflection")) {
            read_reflection(tokens, finish, word.place);
        } else if (word.is("metallic")) {
            if (at_tuple(tokens)) read_number(tokens);
            tokens.remark(word.place, "is metallic, and highlights have the light's colour here");
        } else if (word.is("conserve_energy")) {
            if (at_tuple(tokens)) read_number(tokens);
        } else if (word.is("crand") || word.is("reflection_exponent")) {
            read_number(tokens);
            tokens.remark(word.place, "has " + word.quoted() + ", which is not drawn");
        } else if (word.is("irid") || word.is("subsurface")) {
            tokens.skip_braces();
            tokens.remark(word.place, "has " + word.quoted() + ", which is not drawn");
        } else {
            fail(word.place, "must be of a finish, got " + word.quoted());
        }
    }
    set_by_albedo(finish, of_albedo);
    return finish;
}

Shared<Texture> read_texture(Tokens& tokens) {
    auto texture = std::make_shared<Texture>(*tokens.default_texture);
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<Texture>()) {
            *texture = *known;
        } else if (const auto motion = read_motion(tokens)) {
            texture->pigment.motion = both(texture->pigment.motion, motion);
        } else if (tokens.accept("pigment")) {
            texture->pigment = read_pigment(tokens, texture->pigment);
        } else if (tokens.accept("finish")) {
            texture->finish = read_finish(tokens, texture->finish);
        } else {
            const Token word = tokens.next();
            if (!word.is("normal"))
                fail(word.place,
                     "must be of a texture, got " + word.quoted() + tokens.perhaps_of());
            tokens.skip_braces();
            tokens.remark(word.place, "bends normals, which are drawn as they are");
        }
    }
    return texture;
}

Interior read_interior(Tokens& tokens) {
    Interior interior;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<Interior>()) {
            interior = *known;
            continue;
        }
        const Token word = tokens.next();
        if (word.is("ior")) {
            interior = {read_number(tokens), true};
            continue;
        }
        if (word.is("media"))
            tokens.skip_braces();
        else if (word.is("fade_color") || word.is("fade_colour"))
            read_color(tokens);
        else if (word.is("caustics") || word.is("fade_distance") || word.is("fade_power") ||
                 word.is("dispersion") || word.is("dispersion_samples"))
            read_number(tokens);
        else
            fail(word.place, "must be of an interior, got " + word.quoted());
        tokens.remark(word.place, "has " + word.quoted() + " inside, which is not drawn");
    }
    return interior;
}

Material read_material(Tokens& tokens) {
    Material material;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (const auto known = tokens.accept_value<Material>()) {
            material = *known;
        } else if (tokens.accept("texture")) {
            material.texture = read_texture(tokens);
        } else if (tokens.accept("interior")) {
            material.interior = std::make_shared<const Interior>(read_interior(tokens));
        } else if (const auto motion = read_motion(tokens)) {
            if (material.texture == nullptr) continue;
            Texture moved = *material.texture;
            moved.pigment.motion = both(moved.pigment.motion, motion);
            material.texture = std::make_shared<const Texture>(std::move(moved));
        } else {
            const Token word = tokens.next();
            fail(word.place, "must be of a material, got " + word.quoted());
        }
    }
    return material;
}

void read_default(Tokens& tokens) {
    Texture texture = *tokens.default_texture;
    tokens.expect("{");
    while (!tokens.accept("}")) {
        if (tokens.accept("texture")) {
            texture = *read_texture(tokens);
        } else if (tokens.accept("pigment")) {
            texture.pigment = read_pigment(tokens, texture.pigment);
        } else if (tokens.accept("finish")) {
            texture.finish = read_finish(tokens, texture.finish);
        } else {
            const Token word = tokens.next();
            fail(word.place, "must be a texture, pigment or finish, got " + word.quoted());
        }
    }
    tokens.default_texture = std::make_shared<const Texture>(std::move(texture));
}

} // namespace raylane::scenes::pov
