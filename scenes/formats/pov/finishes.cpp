#include "scenes/formats/pov/finishes.hpp"

#include "core/numbers/more_functions.hpp"
#include "scenes/formats/pov/expressions.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes::pov {

namespace {

/// Reads a share. Returns the mean of a colour.
double read_share(Tokens& tokens, const char* what) {
    const Place place = tokens.peek().place;
    const Tuple tuple = read_color(tokens);
    const double mean = (tuple.at[0] + tuple.at[1] + tuple.at[2]) / 3.0;
    const auto differs = [&](std::size_t i) { return tuple.at[i] != tuple.at[0]; };
    if (differs(1) || differs(2)) {
        tokens.remark(place,
                      std::string("coloured ") + what + " is not supported: its mean is used");
        return mean;
    }
    return tuple.at[0];
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
            tokens.remark(word.place, word.quoted() + " of a reflection is ignored");
        else
            fail(word.place, "must be of a reflection, got " + word.quoted());
    }
    finish.reflection = has_range && !finish.fresnel ? 0.5 * (least + most) : most;
    if (has_range && !finish.fresnel && least != most)
        tokens.remark(place, "reflection that depends on the angle is not supported: the mean of "
                             "both limits is used");
    if (finish.fresnel && (least != 0.0 || most != 1.0))
        tokens.remark(place, "limits of Fresnel reflection are ignored");
}

/// Skips "normal { ... }". Returns false if something else comes next.
bool accept_normal(Tokens& tokens) {
    const Place place = tokens.peek().place;
    if (!tokens.accept("normal")) return false;
    tokens.skip_braces();
    tokens.remark(place, "normal is ignored: surfaces stay smooth");
    return true;
}

/// Marks shares that apply to all of the reflected light, in all directions.
struct Albedo {
    bool diffuse = false, phong = false, specular = false;
};

/// Converts these shares to shares in the direction where they are largest, as POV-Ray does.
void set_by_albedo(Finish& finish, const Albedo& is) {
    const double n = 1.0 / finish.roughness;
    if (is.diffuse) finish.diffuse *= 0.5 * (finish.brilliance + 1.0);
    if (is.phong) finish.phong *= 0.5 * (finish.phong_size + 1.0);
    if (is.specular) finish.specular *= (n + 2.0) / (4.0 * (2.0 - core::power(2.0, -0.5 * n)));
}

} // namespace

Pigment read_pigment(Tokens& tokens, Pigment given, std::string_view end) {
    Texture texture{std::move(given), {}};
    Pigment& pigment = texture.pigment;
    pigment.name = {};
    while (!tokens.accept(end)) {
        const Token word = tokens.peek();
        if (const auto known = tokens.accept_value<Pigment>()) {
            pigment = *known;
        } else if (const auto motion = read_motion(tokens)) {
            pigment.motion = both(pigment.motion, motion);
        } else if (read_pattern(tokens, texture)) {
            continue;
        } else if (at_tuple(tokens)) {
            const bool only_channel = word.is("transmit") || word.is("filter");
            const Tuple before = pigment.color;
            pigment.color = read_color(tokens);
            if (only_channel)
                std::copy(before.at.begin(), before.at.begin() + 3, pigment.color.at.begin());
            pigment.kind = PigmentKind::color;
        } else {
            fail(word.place, "must be of a pigment, got " + word.quoted() + tokens.origin_of(word));
        }
    }
    return std::move(pigment);
}

Pigment read_pigment(Tokens& tokens, Pigment pigment) {
    tokens.expect("{");
    return read_pigment(tokens, std::move(pigment), "}");
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
                tokens.remark(word.place,
                              "brilliance is not supported: diffuse light is reduced instead");
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
            tokens.remark(word.place,
                          "metallic is ignored: highlights have the colour of the light");
        } else if (word.is("conserve_energy")) {
            if (at_tuple(tokens)) read_number(tokens);
        } else if (word.is("crand") || word.is("reflection_exponent")) {
            read_number(tokens);
            tokens.remark(word.place, word.quoted() + " is ignored");
        } else if (word.is("irid") || word.is("subsurface")) {
            tokens.skip_braces();
            tokens.remark(word.place, word.quoted() + " is ignored");
        } else {
            fail(word.place, "must be of a finish, got " + word.quoted());
        }
    }
    set_by_albedo(finish, of_albedo);
    return finish;
}

Shared<Texture> read_texture(Tokens& tokens) {
    tokens.expect("{");
    return read_texture(tokens, "}");
}

Shared<Texture> read_texture(Tokens& tokens, std::string_view end) {
    auto texture = std::make_shared<Texture>(*tokens.default_texture);
    tokens.budget.count_words(Budget::words_of_item, tokens.peek().place);
    texture->name = texture->pigment.name = {};
    while (!tokens.accept(end)) {
        if (const auto known = tokens.accept_value<Texture>()) {
            *texture = *known;
        } else if (const auto pigment = tokens.accept_value<Pigment>()) {
            texture->pigment = *pigment;
        } else if (const auto finish = tokens.accept_value<Finish>()) {
            texture->finish = *finish;
        } else if (const auto motion = read_motion(tokens)) {
            texture->pigment.motion = both(texture->pigment.motion, motion);
        } else if (tokens.accept("pigment")) {
            texture->pigment = read_pigment(tokens, texture->pigment);
        } else if (tokens.accept("finish")) {
            texture->finish = read_finish(tokens, texture->finish);
        } else if (!accept_normal(tokens) && !read_pattern(tokens, *texture)) {
            const Token& word = tokens.peek();
            fail(word.place, "must be of a texture, got " + word.quoted() + tokens.origin_of(word));
        }
    }
    return texture;
}

Shared<Texture> read_layers(Tokens& tokens) {
    Shared<Texture> texture = read_texture(tokens);
    while (tokens.ahead().is("texture")) {
        const Place place = tokens.next().place;
        texture = layered(tokens, texture, read_texture(tokens), place);
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
        tokens.remark(word.place, word.quoted() + " of an interior is ignored");
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
        } else if (!accept_normal(tokens)) {
            const Token word = tokens.next();
            fail(word.place, "must be a texture, pigment or finish, got " + word.quoted());
        }
    }
    tokens.default_texture = std::make_shared<const Texture>(std::move(texture));
}

} // namespace raylane::scenes::pov
