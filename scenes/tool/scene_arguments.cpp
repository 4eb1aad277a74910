#include "scenes/tool/scene_arguments.hpp"

namespace raylane::scenes {

void SceneArguments::add_to(CLI::App& command, bool sweeps) {
    verbosity.add_to(command);
    view.add_to(command);
    parameters.add_to(command, sweeps);
    drawing.add_to(command);
}

LoadOptions SceneArguments::load_options(bool sweeps) const {
    LoadOptions options;
    options.drawing = drawing.drawing();
    options.atom_style = drawing.atom_style.value_or("");
    options.option_for_atoms = drawing.first_given();
    options.parameters = parameters.values(sweeps).front();
    return options;
}

std::vector<std::pair<std::string, std::string>> SceneArguments::given() const {
    auto all = drawing.given();
    const std::pair<const char*, const Argument&> values[] = {{"--view", view.view},
                                                              {"--up", view.up},
                                                              {"--zoom", view.zoom},
                                                              {"--depth-cue", view.depth_cue}};
    for (const auto& [name, value] : values)
        if (value) all.emplace_back(name, *value);
    if (view.orthographic) all.emplace_back("--orthographic", "");
    for (const std::string& set : parameters.set)
        all.emplace_back("--set", set);
    return all;
}

} // namespace raylane::scenes
