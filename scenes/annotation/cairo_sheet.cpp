#include "scenes/annotation/sheet.hpp"

#include <cstddef>
#include <memory>
#include <pango/pangocairo.h>
#include <sstream>
#include <string>

/// A module of the tool. Renders sheets by cairo and by pango, which shapes texts with HarfBuzz.
namespace {

using namespace raylane::scenes;

struct Release {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(PangoLayout* layout) const { g_object_unref(layout); }
    void operator()(PangoContext* context) const { g_object_unref(context); }
    void operator()(PangoFont* font) const { g_object_unref(font); }
    void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
template <class T>
using Owner = std::unique_ptr<T, Release>;

class SheetRenderer {
  public:
    SheetRenderer(const Sheet& sheet, cairo_t* context) : sheet_(sheet), context_(context) {}

    void render() {
        for (const MarkGroup& group : sheet_.groups)
            for (const Mark& mark : group.marks)
                std::visit([this](const auto& shape) { render(shape); }, mark);
    }

  private:
    void set(std::uint32_t color) {
        const auto component = [color](int shift) { return (color >> shift & 0xFF) / 255.0; };
        cairo_set_source_rgb(context_, component(16), component(8), component(0));
    }
    void render(const SheetLine& line) {
        set(line.color);
        cairo_set_line_width(context_, line.width);
        cairo_set_line_cap(context_, CAIRO_LINE_CAP_BUTT);
        cairo_set_dash(context_, &line.dash, line.dash > 0.0 ? 1 : 0, 0.0);
        cairo_move_to(context_, line.from.x, line.from.y);
        cairo_line_to(context_, line.to.x, line.to.y);
        cairo_stroke(context_);
        cairo_set_dash(context_, nullptr, 0, 0.0);
    }
    void render(const SheetPolygon& polygon) {
        set(polygon.color);
        for (const Point& corner : polygon.corners)
            cairo_line_to(context_, corner.x, corner.y);
        cairo_close_path(context_);
        cairo_fill(context_);
    }
    void render(const SheetBall& ball) {
        constexpr double turn = 6.283185307179586;
        set(ball.color);
        cairo_arc(context_, ball.center.x, ball.center.y, ball.radius, 0.0, turn);
        cairo_fill(context_);
    }
    void render(const SheetRamp& ramp) {
        cairo_pattern_t* const pattern =
            cairo_pattern_create_linear(0.0, ramp.corner.y + ramp.height, 0.0, ramp.corner.y);
        for (std::size_t i = 0; i < ramp.colors.size(); ++i) {
            const auto component = [&](int shift) {
                return (ramp.colors[i] >> shift & 0xFF) / 255.0;
            };
            const std::size_t intervals = ramp.colors.size() > 1 ? ramp.colors.size() - 1 : 1;
            cairo_pattern_add_color_stop_rgb(
                pattern, static_cast<double>(i) / static_cast<double>(intervals), component(16),
                component(8), component(0));
        }
        cairo_rectangle(context_, ramp.corner.x, ramp.corner.y, ramp.width, ramp.height);
        cairo_set_source(context_, pattern);
        cairo_fill_preserve(context_);
        cairo_pattern_destroy(pattern);
        set(ramp.frame);
        cairo_set_line_width(context_, 1.0);
        cairo_stroke(context_);
    }
    void render(const SheetText& text) {
        const Owner<PangoLayout> layout(pango_cairo_create_layout(context_));
        const Owner<PangoFontDescription> font(
            pango_font_description_from_string(sheet_.font.c_str()));
        pango_font_description_set_absolute_size(font.get(), text.size * PANGO_SCALE);
        pango_layout_set_font_description(layout.get(), font.get());
        pango_layout_set_text(layout.get(), text.text.c_str(), static_cast<int>(text.text.size()));
        int width = 0, height = 0;
        pango_layout_get_size(layout.get(), &width, &height);
        const double share = text.anchor == Anchor::start    ? 0.0
                             : text.anchor == Anchor::middle ? 0.5
                                                             : 1.0;
        const double scale = PANGO_SCALE;
        cairo_move_to(context_, text.at.x - share * width / scale,
                      text.at.y - pango_layout_get_baseline(layout.get()) / scale);
        pango_cairo_layout_path(context_, layout.get());
        set(text.halo);
        cairo_set_line_width(context_, halo_width * text.size);
        cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
        cairo_stroke_preserve(context_);
        set(text.color);
        cairo_fill(context_);
    }

    const Sheet& sheet_;
    cairo_t* context_;
};

} // namespace

extern "C" __attribute__((visibility("default"))) const char*
raylane_replaced_font(const char* name) {
    static std::string family; // of the last call
    const Owner<PangoFontDescription> wanted(pango_font_description_from_string(name));
    const char* const families = pango_font_description_get_family(wanted.get());
    if (families == nullptr) return nullptr;
    const Owner<PangoContext> context(
        pango_font_map_create_context(pango_cairo_font_map_get_default()));
    const Owner<PangoFont> font(pango_context_load_font(context.get(), wanted.get()));
    if (font.get() == nullptr) return "no font";
    const Owner<PangoFontDescription> used(pango_font_describe(font.get()));
    family = pango_font_description_get_family(used.get());
    std::istringstream list(families);
    for (std::string one; std::getline(list, one, ',');) {
        one.erase(0, one.find_first_not_of(' '));
        for (const char* const known : {"sans", "sans-serif", "serif", "monospace", "mono",
                                        "cursive", "fantasy", "system-ui", family.c_str()})
            if (g_ascii_strcasecmp(one.c_str(), known) == 0) return nullptr;
    }
    return family.c_str();
}

extern "C" __attribute__((visibility("default"))) const char*
raylane_render_sheet(const raylane::scenes::Sheet* sheet, std::uint32_t* pixels) {
    constexpr int bytes = 4;
    const Owner<cairo_surface_t> surface(cairo_image_surface_create_for_data(
        reinterpret_cast<unsigned char*>(pixels), CAIRO_FORMAT_ARGB32, sheet->width, sheet->height,
        bytes * sheet->width));
    const Owner<cairo_t> context(cairo_create(surface.get()));
    SheetRenderer(*sheet, context.get()).render();
    cairo_surface_flush(surface.get());
    const cairo_status_t status = cairo_status(context.get());
    return status == CAIRO_STATUS_SUCCESS ? nullptr : cairo_status_to_string(status);
}
