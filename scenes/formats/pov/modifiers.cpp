#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/objects.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes::pov {

namespace {

/// Collects the textures of an object's parts, transformed as the parts are in the object.
void collect_textures(const Object& object, std::vector<Texture>& textures) {
    const auto moved = [&](Texture texture) {
        texture.pigment.motion = both(texture.pigment.motion, object.motion);
        return texture;
    };
    for (const Shared<Object>& part : object.parts) {
        const std::size_t before = textures.size();
        if (part->texture != nullptr)
            textures.push_back(*part->texture);
        else
            collect_textures(*part, textures);
        for (std::size_t i = before; i < textures.size(); ++i)
            textures[i] = moved(std::move(textures[i]));
        if (textures.size() > 1) return; // enough to know that there are several
    }
}

/// Reads the modifiers behind an object's numbers.
class Modifiers {
  public:
    Modifiers(Tokens& tokens, Object& object) : tokens_(tokens), object_(object) {}

    /// Reads up to the closing brace, and past it.
    void read() {
        while (!tokens_.accept("}")) {
            if (const auto motion = read_motion(tokens_))
                move(motion);
            else
                read_one(tokens_.next());
        }
        if (cuts_textures_) cut_texture();
    }

  private:
    void move(const Shared<Motion>& motion) {
        object_.motion = both(object_.motion, motion);
        if (object_.texture == nullptr || object_.texture->pigment.kind == PigmentKind::color)
            return;
        Texture texture = *object_.texture;
        texture.pigment.motion = both(texture.pigment.motion, motion);
        object_.texture = std::make_shared<const Texture>(std::move(texture));
    }

    /// Gives parts without a texture that of the object they are cut out of.
    void cut_texture() {
        if (object_.texture != nullptr) return;
        std::vector<Texture> textures;
        collect_textures(object_, textures);
        if (textures.empty()) return;
        if (textures.size() > 1)
            tokens_.remark(
                object_.place,
                "cutaway_textures of several textures are not supported: the first one is used");
        set(std::move(textures.front()));
    }

    Texture own_texture() const {
        if (object_.texture != nullptr) return *object_.texture;
        Texture texture = *tokens_.default_texture;
        texture.name = texture.pigment.name = {};
        return texture;
    }
    void set(Texture texture) {
        object_.texture = std::make_shared<const Texture>(std::move(texture));
    }

    void read_one(const Token& word) {
        if (word.is("texture")) {
            Shared<Texture> texture = read_texture(tokens_);
            if (object_.texture != nullptr)
                texture = layered(tokens_, object_.texture, std::move(texture), word.place);
            object_.texture = std::move(texture);
        } else if (word.is("pigment")) {
            Texture texture = own_texture();
            texture.pigment = read_pigment(tokens_, texture.pigment);
            set(std::move(texture));
        } else if (word.is("finish")) {
            Texture texture = own_texture();
            texture.finish = read_finish(tokens_, texture.finish);
            set(std::move(texture));
        } else if (word.is("material")) {
            const Material material = read_material(tokens_);
            if (material.texture != nullptr) object_.texture = material.texture;
            if (material.interior != nullptr) object_.interior = material.interior;
        } else if (word.is("interior")) {
            object_.interior = std::make_shared<const Interior>(read_interior(tokens_));
        } else if (word.is("clipped_by") || word.is("bounded_by")) {
            read_clip(word.is("clipped_by"));
        } else if (word.is("inverse")) {
            object_.inverse = !object_.inverse;
        } else {
            read_flag(word);
        }
    }

    void read_clip(bool clips) {
        tokens_.expect("{");
        while (!tokens_.accept("}")) {
            if (tokens_.accept("bounded_by") || tokens_.accept("clipped_by")) continue;
            Shared<Object> by = read_object(tokens_);
            if (!clips) continue;             // bounds are computed, so bounded_by is ignored
            if (object_.count == 0) continue; // nothing to clip
            if (object_.motion != nullptr) put_within(); // earlier motions do not move later clips
            count_in(object_, *by, object_.pieces);
            object_.clips.push_back(std::move(by));
        }
    }

    void put_within() {
        Object inner = std::move(object_);
        object_ = {.kind = ObjectKind::all_in_one,
                   .place = inner.place,
                   .count = 0,
                   .pieces = inner.pieces};
        object_.texture = inner.texture;
        object_.interior = inner.interior;
        count_in(object_, inner, 1);
        object_.parts.push_back(std::make_shared<const Object>(std::move(inner)));
    }

    void read_flag(const Token& word) {
        static constexpr std::string_view without_meaning[] = {
            "double_illuminate", "sturm",  "hierarchy",    "split_union",
            "cutaway_textures",  "orient", "global_lights"};
        const bool is_ignored = std::find(std::begin(without_meaning), std::end(without_meaning),
                                          word.text) != std::end(without_meaning);
        if (is_ignored || word.is("no_shadow") || word.is("no_reflection") || word.is("no_image") ||
            word.is("no_radiosity") || word.is("uv_mapping") || word.is("hollow")) {
            const bool holds = !at_tuple(tokens_) || read_number(tokens_) != 0.0;
            if (word.is("no_image") && holds) object_.is_hidden = true;
            if (word.is("hollow")) object_.is_hollow = holds;
            if (word.is("cutaway_textures")) cuts_textures_ = holds;
            if (word.is("uv_mapping") && holds)
                tokens_.remark(word.place, "uv_mapping is ignored: patterns are in space");
            if ((word.is("no_shadow") || word.is("no_image") || word.is("no_reflection")) && holds)
                tokens_.remark(
                    word.place,
                    word.is("no_shadow")  ? "no_shadow is ignored: the objects cast shadows"
                    : word.is("no_image") ? "no_image objects are omitted"
                                          : "no_reflection is ignored: the objects are reflected");
        } else if (word.is("normal") || word.is("photons") || word.is("radiosity") ||
                   word.is("interior_texture") || word.is("uv_vectors")) {
            if (!word.is("uv_vectors")) tokens_.skip_braces();
            while (tokens_.at("<")) {
                read_tuple(tokens_);
                tokens_.accept(",");
            }
            tokens_.remark(word.place, word.quoted() + " is ignored");
        } else {
            fail(word.place, "must be of an object, got " + word.quoted());
        }
    }

    Tokens& tokens_;
    Object& object_;
    bool cuts_textures_ = false;
};

} // namespace

/// Counts a part that the object contains `times` times from now on.
void count_in(Object& object, const Object& part, std::size_t times) {
    object.count += times * part.count;
    object.lights += times * part.lights;
    object.depth = std::max(object.depth, part.depth + 1);
    if (object.depth > deepest)
        fail(object.place, "must not be nested more than " + std::to_string(deepest) + " deep");
    if (object.count > max_shapes)
        fail(object.place, "must not be of more than " + std::to_string(max_shapes) + " shapes");
    if (object.lights > max_lights)
        fail(object.place, "must not be of more than " + std::to_string(max_lights) + " lights");
}

void read_modifiers(Tokens& tokens, Object& object) {
    Modifiers(tokens, object).read();
}

} // namespace raylane::scenes::pov
