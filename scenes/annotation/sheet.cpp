#include "scenes/annotation/sheet.hpp"

#include "core/scene/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>

namespace raylane::scenes {

namespace {

std::string number_text(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", number);
    std::string result = text;
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
    return result == "-0" ? "0" : result;
}

std::string color_text(std::uint32_t color) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(color & 0xFFFFFF));
    return text;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else if (static_cast<unsigned char>(c) >= ' ') // others are not XML
            result += c;
    }
    return result;
}

/// An attribute of an element, with a blank before it.
std::string with(std::string_view name, const std::string& value) {
    return ' ' + std::string(name) + "=\"" + value + '"';
}
std::string with(std::string_view name, double value) {
    return with(name, number_text(value));
}

class SvgWriter {
  public:
    explicit SvgWriter(const Sheet& sheet) : sheet_(sheet) {}

    std::string document() {
        const auto length = [this](int pixels) {
            constexpr double millimetres = 25.4;
            return sheet_.dpi > 0.0 ? number_text(pixels / sheet_.dpi * millimetres) + "mm"
                                    : std::to_string(pixels);
        };
        text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + with("width", length(sheet_.width)) +
                with("height", length(sheet_.height)) +
                with("viewBox",
                     "0 0 " + std::to_string(sheet_.width) + " " + std::to_string(sheet_.height)) +
                with("font-family", escaped(sheet_.font)) + ">\n";
        for (const MarkGroup& group : sheet_.groups) {
            text_ += "<g" + with("id", escaped(group.name)) + ">\n";
            for (const Mark& mark : group.marks)
                std::visit([this](const auto& shape) { add(shape); }, mark);
            text_ += "</g>\n";
        }
        return text_ + "</svg>\n";
    }

  private:
    void add(const SheetLine& line) {
        text_ += "<line" + with("x1", line.from.x) + with("y1", line.from.y) +
                 with("x2", line.to.x) + with("y2", line.to.y) +
                 with("stroke", color_text(line.color)) + with("stroke-width", line.width);
        if (line.dash > 0.0) text_ += with("stroke-dasharray", line.dash);
        text_ += "/>\n";
    }
    void add(const SheetPolygon& polygon) {
        std::string points;
        for (const Point& corner : polygon.corners)
            points.append(points.empty() ? "" : " ")
                .append(number_text(corner.x) + ',' + number_text(corner.y));
        text_ +=
            "<polygon" + with("points", points) + with("fill", color_text(polygon.color)) + "/>\n";
    }
    void add(const SheetBall& ball) {
        text_ += "<circle" + with("cx", ball.center.x) + with("cy", ball.center.y) +
                 with("r", ball.radius) + with("fill", color_text(ball.color)) + "/>\n";
    }
    void add(const SheetRamp& ramp) {
        const std::string name = "ramp-" + std::to_string(++ramps_);
        text_ += "<linearGradient" + with("id", name) + R"( x1="0" y1="1" x2="0" y2="0">)";
        for (std::size_t i = 0; i < ramp.colors.size(); ++i)
            text_ +=
                "<stop" +
                with("offset", static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(
                                                            1, ramp.colors.size() - 1))) +
                with("stop-color", color_text(ramp.colors[i])) + "/>";
        text_ += "</linearGradient>\n<rect" + with("x", ramp.corner.x) + with("y", ramp.corner.y) +
                 with("width", ramp.width) + with("height", ramp.height) +
                 with("fill", "url(#" + name + ")") + with("stroke", color_text(ramp.frame)) +
                 "/>\n";
    }
    void add(const SheetText& text) {
        constexpr std::string_view anchors[] = {"start", "middle", "end"};
        text_ +=
            "<text" + with("x", text.at.x) + with("y", text.at.y) + with("font-size", text.size) +
            with("text-anchor", std::string(anchors[static_cast<std::size_t>(text.anchor)])) +
            with("fill", color_text(text.color)) + with("stroke", color_text(text.halo)) +
            with("stroke-width", halo_width * text.size) +
            R"( stroke-linejoin="round" paint-order="stroke">)" + escaped(text.text) + "</text>\n";
    }

    const Sheet& sheet_;
    std::string text_;
    int ramps_ = 0;
};

/// Returns the linear component of a code in [0, 1] of an image with this transfer function.
double linear_of(double code, core::Transfer transfer) {
    return transfer == core::Transfer::srgb ? core::linear_of_srgb(code) : code;
}

} // namespace

std::string svg_of(const Sheet& sheet) {
    return SvgWriter(sheet).document();
}

void blend(const std::vector<std::uint32_t>& pixels, int width, const core::Region& part,
           core::Transfer transfer, core::Film& film) {
    constexpr double most = 255.0;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x) {
            const std::uint32_t over =
                pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)];
            if (over >> 24 == 0) continue;
            const double share = (over >> 24) / most;
            const int column = x - part.x0, row = y - part.y0;
            const double before =
                film.has_alpha() ? static_cast<double>(film.alpha_at(column, row)) : 1.0;
            const double below = before * (1.0 - share);
            const double alpha = share + below;
            core::Color& color = film.at(column, row);
            for (int channel = 0; channel < 3; ++channel) {
                // Codes of the overlay are sRGB's, whatever the image's.
                const double code = (over >> (16 - 8 * channel) & 0xFF) / most / share;
                const double shown =
                    transfer == core::Transfer::srgb ? code : core::linear_of_srgb(code);
                const double straight =
                    below > 0.0 ? static_cast<double>(color[channel]) / before : 0.0;
                const double under =
                    below > 0.0 ? core::shown(std::clamp(straight, 0.0, 1.0), transfer) : 0.0;
                color[channel] = static_cast<float>(
                    linear_of((share * shown + below * under) / alpha, transfer) * alpha);
            }
            if (film.has_alpha()) film.alpha_at(column, row) = static_cast<float>(alpha);
        }
}

} // namespace raylane::scenes
