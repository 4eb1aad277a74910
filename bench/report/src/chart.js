import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent, MarkLineComponent, TitleComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";

use([LineChart, ScatterChart, GridComponent, MarkLineComponent, TitleComponent, TooltipComponent, SVGRenderer]);

/** Returns a colour of the style sheet in the current theme. */
export function color(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

const shown = new Map();

function draw({ made, options }) {
    made.setOption({ animation: false, ...options() }, true);
}

/** Draws a chart with options() in a place, and redraws it when colours or sizes change. */
export function chart(place, options) {
    if (!shown.has(place)) {
        const made = init(place, null, { renderer: "svg" });
        const sizes = new ResizeObserver(() => made.resize());
        sizes.observe(place);
        shown.set(place, { made, sizes });
    }
    const entry = shown.get(place);
    entry.options = options;
    draw(entry);
}

export function forget(place) {
    const { made, sizes } = shown.get(place);
    sizes.disconnect();
    made.dispose();
    shown.delete(place);
}

export function redraw() {
    shown.forEach(draw);
}
