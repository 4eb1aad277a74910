import { BarChart, LineChart, ScatterChart } from "echarts/charts";
import { GridComponent, MarkLineComponent, TitleComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";

use([BarChart, LineChart, ScatterChart, GridComponent, MarkLineComponent, TitleComponent, TooltipComponent, SVGRenderer]);

const shown = new Map();

/** Draws what options() says in a place, and again where colours or sizes change. */
export function chart(place, options) {
    if (!shown.has(place)) {
        const made = init(place, null, { renderer: "svg" });
        new ResizeObserver(() => made.resize()).observe(place);
        shown.set(place, { made });
    }
    const entry = shown.get(place);
    entry.options = options;
    entry.made.setOption({ animation: false, ...options() }, true);
}

export function forget(place) {
    shown.get(place)?.made.dispose();
    shown.delete(place);
}

export function redraw() {
    for (const { made, options } of shown.values()) made.setOption({ animation: false, ...options() }, true);
}
