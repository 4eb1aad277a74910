#pragma once

#include "scenes/tool/frame_arguments.hpp"
#include "scenes/tool/scene_source.hpp"
#include "scenes/tool/verbosity.hpp"
#include "scenes/tool/view_arguments.hpp"
#include "simd/render.hpp"

#include <functional>
#include <memory>
#include <string>

namespace raylane::scenes {

/// Several pictures that belong together: frames of atoms, values of parameters, ways around.
struct FilmStrip {
    std::shared_ptr<core::Workers> workers; ///< of the source
    std::unique_ptr<SceneSource> source;
    std::function<std::string(std::size_t)> name; ///< of the file of the picture with a number
    ViewChange view;
    FitTo fit_to = FitTo::first;
    std::optional<Turn> turn;
    bool overwrites = true; ///< files that are there already
    /// Of several processes that draw them, this one's number, from 0, and how many: they take
    /// turns.
    struct Share {
        std::size_t number = 0, of = 1;
    } share;
    std::optional<std::size_t> only; ///< the picture at this place alone, whoever's it is
    Verbosity verbosity = Verbosity::normal;
    /// What a scene's settings become.
    std::function<core::Settings(const core::Settings&)> settings;
    /// Draws the scene of the picture at a place, from 0, into a file.
    std::function<void(const core::Scene&, std::size_t place, const std::string& name,
                       simd::Progress&)>
        draw;
};

/// Throws BadInput: there are so many pictures `otherwise`.
[[noreturn]] void refuse_turn(const Turn& turn, const std::string& otherwise);

/// What a picture shows, and the name of its file.
struct Shot {
    core::Scene scene;
    std::string name;
};

/// That of the first picture, for others to draw, whether it is there already or not. Throws what
/// the source does.
Shot first_shot(const FilmStrip& strip);

/// Draws all of them; while one is drawn the scene of the next is made. Throws what the source and
/// the drawing do, once what came before is drawn, and BadInput where a turn is in other than as
/// many pictures as there are: before the first one too many, or behind the last.
void draw(const FilmStrip& strip);

} // namespace raylane::scenes
