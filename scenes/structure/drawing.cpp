#include "scenes/structure/drawing.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/errors.hpp"
#include "scenes/structure/bonds.hpp"
#include "scenes/structure/selection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

namespace raylane::scenes {

namespace {

using core::MaterialIndex;
using core::Vec3d;
using core::Vec3f;

constexpr std::size_t most_for_balls = 500;
constexpr float part_of_radius = 0.25F; // of van der Waals', balls with sticks
constexpr float stick_with_balls = 0.12F, stick = 0.16F, licorice_stick = 0.3F, point = 0.2F;
constexpr double apart = 0.13; // the sticks of a double bond from its line
constexpr float cell_stick = 0.06F;

/// Okabe and Ito, "Color Universal Design" (2008), without black.
constexpr std::array<std::uint32_t, 7> apart_from_each_other = {
    0x0072b2, 0xe69f00, 0x009e73, 0xd55e00, 0x56b4e9, 0xcc79a7, 0xf0e442};

/// Kelly, "Twenty-two colors of maximum contrast" (1965), without white and black.
constexpr std::array<std::uint32_t, 20> many_apart = {
    0xf3c300, 0x875692, 0xf38400, 0xa1caf1, 0xbe0032, 0xc2b280, 0x848482,
    0x008856, 0xe68fac, 0x0067a5, 0xf99379, 0x604e97, 0xf6a600, 0xb3446c,
    0xdcd300, 0x882d17, 0x8db600, 0x654522, 0xe25822, 0x2b3d26};

/// Viridis: Smith and van der Walt (2015), by nine of its colours.
constexpr std::array<std::uint32_t, 9> ramp = {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                               0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

core::Color linear(std::uint32_t srgb) {
    const auto channel = [&](int shift) {
        return core::decode_srgb(static_cast<std::uint8_t>(srgb >> shift & 255));
    };
    return {channel(16), channel(8), channel(0)};
}

std::uint32_t ramp_at(double share) {
    constexpr int steps = static_cast<int>(ramp.size()) - 1;
    // 64 colours are enough for the eye, and few materials.
    const double place = std::round(std::clamp(share, 0.0, 1.0) * 64.0) / 64.0 * steps;
    const int below = std::min(static_cast<int>(place), steps - 1);
    const double part = place - below;
    std::uint32_t color = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const auto channel = [&](int step) {
            return static_cast<double>(ramp[static_cast<std::size_t>(step)] >> shift & 255);
        };
        const double value = channel(below) + part * (channel(below + 1) - channel(below));
        color |= static_cast<std::uint32_t>(std::lround(value)) << shift;
    }
    return color;
}

/// Materials by colour.
class Palette {
  public:
    explicit Palette(core::SceneBuilder& builder) : builder_(builder) {}

    MaterialIndex of(std::uint32_t srgb) {
        if (srgb == last_color_ && !index_.empty()) return last_;
        const auto [found, is_new] = index_.try_emplace(srgb);
        if (is_new) {
            core::Material material;
            material.pattern.colors[0] = linear(srgb);
            material.ambient = 0.0F;
            material.specular = 0.15F;
            material.exponent = 20.0F;
            found->second = builder_.add_material(material);
        }
        last_color_ = srgb;
        return last_ = found->second;
    }

  private:
    core::SceneBuilder& builder_;
    std::unordered_map<std::uint32_t, MaterialIndex> index_;
    std::uint32_t last_color_ = 0;
    MaterialIndex last_ = 0;
};

class Artist {
  public:
    Artist(const Structure& structure, const Drawing& drawing, const std::string& file,
           core::SceneBuilder& builder)
        : structure_(structure), drawing_(drawing), file_(file), builder_(builder),
          palette_(builder) {}

    DrawingScale draw() {
        if (structure_.size() == 0) throw BadInput(file_, "", "has no atoms");
        if (drawing_.select != "all") {
            selected_ = select_atoms(structure_, "--select", drawing_.select);
            count_ = static_cast<std::size_t>(std::count(selected_.begin(), selected_.end(), 1));
            if (count_ == 0)
                throw BadInput("--select", "",
                               "\"" + printable(drawing_.select) + "\" selects none of " +
                                   std::to_string(structure_.size()) + " atoms");
        } else {
            count_ = structure_.size();
        }
        find_scale();
        find_colors();
        find_images();
        add_atoms();
        if (scale_.style != Style::spheres && scale_.style != Style::points) add_bonds();
        if (drawing_.show_cell) add_cell();
        set_up_view();
        return scale_;
    }

  private:
    bool is_selected(AtomIndex atom) const { return selected_.empty() || selected_[atom] != 0; }

    void find_scale() {
        if (drawing_.scale) {
            scale_ = *drawing_.scale;
            return;
        }
        find_usual_radius();
        scale_.style = drawing_.style != Style::automatic                     ? drawing_.style
                       : count_ > most_for_balls || !structure_.radii.empty() ? Style::spheres
                                                                              : Style::balls;
    }

    void find_colors() {
        const std::string& by = drawing_.color;
        if (by == "element") {
            // Types that are no element's by number.
            std::size_t unknown = 0;
            for (const AtomKind& kind : structure_.of_kind)
                of_kind_.push_back(
                    kind.element != 0
                        ? data_of(kind.element).color
                        : apart_from_each_other[unknown++ % apart_from_each_other.size()]);
            color_of_ = [this](AtomIndex i) { return of_kind_[structure_.kinds[i]]; };
        } else if (by == "chain" || by == "residue") {
            if (structure_.residues.empty())
                throw BadInput("--color", "",
                               "must not be " + by + " here: " + file_ + " has no residues");
            std::vector<std::string> names;
            for (const Residue& residue : structure_.of_residue)
                names.push_back(by == "chain" ? structure_.chains[residue.chain] : residue.name);
            std::vector<std::string> distinct = names;
            std::sort(distinct.begin(), distinct.end());
            distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
            for (const std::string& name : names) {
                const auto place = static_cast<std::size_t>(
                    std::lower_bound(distinct.begin(), distinct.end(), name) - distinct.begin());
                of_kind_.push_back(color_of_one(place, distinct.size()));
            }
            color_of_ = [this](AtomIndex i) { return of_kind_[structure_.residues[i]]; };
        } else {
            color_by_property(by);
        }
    }

    /// One of several that have no order.
    static std::uint32_t color_of_one(std::size_t place, std::size_t of) {
        if (of <= apart_from_each_other.size()) return apart_from_each_other[place];
        if (of <= many_apart.size()) return many_apart[place];
        return ramp_at(static_cast<double>(place) / static_cast<double>(of - 1));
    }

    void color_by_property(const std::string& name) {
        std::vector<std::string> names = {"element", "chain", "residue"};
        for (const AtomProperty& property : structure_.properties)
            names.push_back(property.name);
        const auto found =
            std::find_if(structure_.properties.begin(), structure_.properties.end(),
                         [&](const AtomProperty& property) { return property.name == name; });
        if (found == structure_.properties.end())
            throw BadInput("--color", "",
                           "must be " + alternatives(names) + ", got \"" + printable(name) + "\"" +
                               suggestion(name, {names.begin(), names.end()}));
        const std::vector<float>* values = &found->values;
        if (!drawing_.scale) find_range(*values);
        const double least = scale_.least, most = scale_.most;
        color_of_ = [=](AtomIndex i) {
            const auto value = static_cast<double>((*values)[i]);
            if (!std::isfinite(value)) return data_of(0).color;
            return ramp_at(most > least ? (value - least) / (most - least) : 0.5);
        };
    }

    void find_range(const std::vector<float>& values) {
        scale_.least = std::numeric_limits<double>::infinity();
        scale_.most = -scale_.least;
        for (AtomIndex i = 0; i < structure_.size(); ++i) {
            const auto value = static_cast<double>(values[i]);
            if (!is_selected(i) || !std::isfinite(value)) continue;
            scale_.least = std::min(scale_.least, value);
            scale_.most = std::max(scale_.most, value);
        }
    }

    /// Of atoms of no known element: so that they nearly touch if they fill their bounds.
    void find_usual_radius() {
        scale_.usual_radius = 1.5F;
        const auto has_element = [](const AtomKind& kind) { return kind.element != 0; };
        if (std::any_of(structure_.of_kind.begin(), structure_.of_kind.end(), has_element)) return;
        core::Bounds bounds;
        for (const Vec3f& at : structure_.positions)
            bounds.include({at, at});
        double volume = 1.0;
        int dimensions = 0;
        const Vec3d size =
            core::convert<double>(bounds.upper) - core::convert<double>(bounds.lower);
        const double largest = std::max({size.x, size.y, size.z});
        for (int axis = 0; axis < 3; ++axis)
            if (size[axis] > 0x1p-6 * largest) {
                volume *= size[axis];
                ++dimensions;
            }
        if (dimensions > 0)
            scale_.usual_radius = static_cast<float>(
                0.5 * std::pow(volume / static_cast<double>(structure_.size()), 1.0 / dimensions));
    }

    void find_images() {
        const std::array<int, 3>& repeat = drawing_.repeat;
        if (repeat != std::array{1, 1, 1} && !structure_.cell.any())
            throw BadInput("--repeat", "",
                           "must have a cell to repeat, and " + file_ + " has none");
        for (int u = 0; u < repeat[0]; ++u)
            for (int v = 0; v < repeat[1]; ++v)
                for (int w = 0; w < repeat[2]; ++w)
                    images_.push_back(
                        core::convert<float>(static_cast<double>(u) * structure_.cell.edges[0] +
                                             static_cast<double>(v) * structure_.cell.edges[1] +
                                             static_cast<double>(w) * structure_.cell.edges[2]));
    }

    float full_radius(AtomIndex atom) const {
        if (!structure_.radii.empty() && structure_.radii[atom] > 0.0F)
            return structure_.radii[atom];
        const Element element = structure_.element(atom);
        if (element == 0) return scale_.usual_radius;
        const float radius = data_of(element).van_der_waals_radius;
        return radius > 0.0F ? radius : 2.0F;
    }

    float radius_of(AtomIndex atom) const {
        switch (scale_.style) {
        case Style::automatic:
        case Style::spheres:
            return full_radius(atom);
        case Style::balls:
            return (structure_.element(atom) == 0 ? 0.5F : part_of_radius) * full_radius(atom);
        case Style::sticks:
            return stick;
        case Style::licorice:
            return licorice_stick;
        case Style::points:
            return std::min(point, 0.5F * full_radius(atom));
        }
        return 0.0F;
    }

    void add_atoms() {
        builder_.reserve(count_ * images_.size());
        std::vector<char> has_ellipsoid;
        if (drawing_.ellipsoids) has_ellipsoid = add_ellipsoids();
        for (AtomIndex atom = 0; atom < structure_.size(); ++atom) {
            if (!is_selected(atom) || (!has_ellipsoid.empty() && has_ellipsoid[atom] != 0))
                continue;
            const MaterialIndex material = palette_.of(color_of_(atom));
            const float radius = radius_of(atom);
            for (const Vec3f& image : images_)
                builder_.add(core::Sphere{structure_.positions[atom] + image, radius}, material);
        }
    }

    /// Surfaces that hold half of a displacement's probability: 1.5382 standard deviations away.
    std::vector<char> add_ellipsoids() {
        if (structure_.anisotropies.empty())
            throw BadInput("--ellipsoids", "", file_ + " has no anisotropic displacements");
        constexpr double half_probability = 1.5382;
        std::vector<char> done(structure_.size());
        for (const Anisotropy& of : structure_.anisotropies) {
            if (!is_selected(of.atom)) continue;
            const auto& u = of.u;
            std::array<Vec3d, 3> axes = {Vec3d(u[0], u[3], u[4]), Vec3d(u[3], u[1], u[5]),
                                         Vec3d(u[4], u[5], u[2])};
            if (!to_axes(axes, half_probability)) continue; // a tensor that is none of an ellipsoid
            const MaterialIndex material = palette_.of(color_of_(of.atom));
            for (const Vec3f& image : images_)
                builder_.add(core::Ellipsoid{structure_.positions[of.atom] + image,
                                             core::convert<float>(axes[0]),
                                             core::convert<float>(axes[1]),
                                             core::convert<float>(axes[2])},
                             material);
            done[of.atom] = 1;
        }
        return done;
    }

    /// From a symmetric tensor's rows, by Jacobi's rotations: its principal axes, as long as
    /// `times` the roots of its values. False if one is not positive.
    static bool to_axes(std::array<Vec3d, 3>& rows, double times) {
        std::array<Vec3d, 3> axes = {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}; // columns
        for (int sweep = 0; sweep < 32; ++sweep)
            for (int p = 0; p < 2; ++p)
                for (int q = p + 1; q < 3; ++q) {
                    auto& row_p = rows[static_cast<std::size_t>(p)];
                    auto& row_q = rows[static_cast<std::size_t>(q)];
                    const double off = row_p[q];
                    if (off == 0.0) continue;
                    const double theta = (row_q[q] - row_p[p]) / (2.0 * off);
                    const double t =
                        (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::hypot(theta, 1.0));
                    const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
                    const Vec3d old_p = row_p, old_q = row_q;
                    row_p = c * old_p - s * old_q;
                    row_q = s * old_p + c * old_q;
                    for (Vec3d& row : rows) {
                        const double at_p = row[p], at_q = row[q];
                        row[p] = c * at_p - s * at_q;
                        row[q] = s * at_p + c * at_q;
                    }
                    Vec3d& axis_p = axes[static_cast<std::size_t>(p)];
                    Vec3d& axis_q = axes[static_cast<std::size_t>(q)];
                    const Vec3d before = axis_p;
                    axis_p = c * before - s * axis_q;
                    axis_q = s * before + c * axis_q;
                }
        for (std::size_t k = 0; k < 3; ++k) {
            const double value = rows[k][static_cast<int>(k)];
            if (!(value > 1e-9)) return false;
            rows[k] = times * std::sqrt(value) * axes[k];
        }
        return true;
    }

    void add_bonds() {
        const std::vector<Bond> bonds = find_bonds(structure_);
        if (scale_.style != Style::licorice) find_neighbours(bonds);
        for (const Bond& bond : bonds) {
            if (!is_selected(bond.a) || !is_selected(bond.b)) continue;
            const Vec3d a = core::convert<double>(structure_.positions[bond.a]);
            const Vec3d b = core::convert<double>(structure_.positions[bond.b]);
            if (a == b) continue;
            const int sticks = scale_.style == Style::licorice ? 1 : bond.order;
            const float radius = (scale_.style == Style::licorice ? licorice_stick
                                  : scale_.style == Style::balls  ? stick_with_balls
                                                                  : stick) *
                                 (sticks == 1 ? 1.0F : 0.55F);
            if (sticks == 1) {
                add_stick(bond, a, b, radius);
                continue;
            }
            const Vec3d side = beside(bond, a, b);
            for (int k = 0; k < sticks; ++k) {
                const double by = (k - 0.5 * (sticks - 1)) * 2.0 * apart / (sticks - 1);
                add_stick(bond, a + by * side, b + by * side, radius);
            }
        }
    }

    /// In the colours of both atoms, each as far as what is seen of it.
    void add_stick(const Bond& bond, const Vec3d& a, const Vec3d& b, float radius) {
        const MaterialIndex of_a = palette_.of(color_of_(bond.a));
        const MaterialIndex of_b = palette_.of(color_of_(bond.b));
        const double distance = core::length(b - a);
        const auto larger = static_cast<double>(radius_of(bond.a) - radius_of(bond.b));
        const double share = std::clamp(0.5 + 0.5 * larger / distance, 0.1, 0.9);
        for (const Vec3f& image : images_) {
            const Vec3d by = core::convert<double>(image);
            const auto add = [&](const Vec3d& from, const Vec3d& to, MaterialIndex material) {
                builder_.add(core::CappedCylinder{core::convert<float>(from + by),
                                                  core::convert<float>(to - from), radius},
                             material);
            };
            if (of_a == of_b) {
                add(a, b, of_a);
            } else {
                const Vec3d middle = a + share * (b - a);
                add(a, middle, of_a);
                add(b, middle, of_b);
            }
        }
    }

    /// One of the others that an atom is bonded to, for each; itself if there is none.
    void find_neighbours(const std::vector<Bond>& bonds) {
        one_.resize(structure_.size());
        another_.resize(structure_.size());
        for (AtomIndex i = 0; i < one_.size(); ++i)
            one_[i] = another_[i] = i;
        const auto note = [&](AtomIndex of, AtomIndex other) {
            (one_[of] == of ? one_ : another_)[of] = other;
        };
        for (const Bond& bond : bonds) {
            note(bond.a, bond.b);
            note(bond.b, bond.a);
        }
    }

    /// Across a bond, of length 1, in the plane of one that is next to it.
    Vec3d beside(const Bond& bond, const Vec3d& a, const Vec3d& b) const {
        const Vec3d along = 1.0 / core::length(b - a) * (b - a);
        const auto across = [&](const Vec3d& way) {
            const Vec3d part = way - core::dot(way, along) * along;
            const double size = core::length(part);
            return size > 0.1 ? 1.0 / size * part : Vec3d(0.0);
        };
        const std::pair<AtomIndex, AtomIndex> ends[] = {{bond.a, bond.b}, {bond.b, bond.a}};
        for (const auto& [end, other] : ends)
            for (const AtomIndex next : {one_[end], another_[end]}) {
                if (next == end || next == other) continue;
                const Vec3d way = core::convert<double>(structure_.positions[next]) -
                                  core::convert<double>(structure_.positions[end]);
                if (const Vec3d side = across(way); side != Vec3d(0.0)) return side;
            }
        const Vec3d side = across({1, 0, 0});
        return side != Vec3d(0.0) ? side : across({0, 1, 0});
    }

    void add_cell() {
        if (!structure_.cell.any())
            throw BadInput("--cell", "", "must have a cell to show, and " + file_ + " has none");
        const MaterialIndex gray = palette_.of(0x808080);
        const auto& edges = structure_.cell.edges;
        for (const Vec3f& image : images_)
            for (int corner = 0; corner < 8; ++corner) {
                Vec3d at = structure_.cell.origin + core::convert<double>(image);
                for (int k = 0; k < 3; ++k)
                    if ((corner >> k & 1) != 0) at = at + edges[static_cast<std::size_t>(k)];
                const auto from = core::convert<float>(at);
                builder_.add(core::Sphere{from, cell_stick}, gray);
                for (int k = 0; k < 3; ++k)
                    if ((corner >> k & 1) == 0)
                        builder_.add(
                            core::CappedCylinder{
                                from, core::convert<float>(edges[static_cast<std::size_t>(k)]),
                                cell_stick},
                            gray);
            }
    }

    void set_up_view() {
        builder_.settings.width = drawing_.width;
        builder_.settings.height = drawing_.height;
        builder_.settings.quality = 40.0F;
        builder_.background = core::Color(1.0F);
        builder_.staging = {
            .framing = drawing_.framing, .lights = true, .depth_cue = drawing_.depth_cue};
    }

    const Structure& structure_;
    const Drawing& drawing_;
    const std::string& file_;
    core::SceneBuilder& builder_;
    Palette palette_;
    std::vector<char> selected_; // empty: all
    std::size_t count_ = 0;
    DrawingScale scale_;
    std::vector<std::uint32_t> of_kind_;
    std::function<std::uint32_t(AtomIndex)> color_of_;
    std::vector<Vec3f> images_;
    std::vector<AtomIndex> one_, another_;
};

} // namespace

DrawingScale draw(const Structure& structure, const Drawing& drawing, const std::string& file,
                  core::SceneBuilder& builder) {
    return Artist(structure, drawing, file, builder).draw();
}

} // namespace raylane::scenes
