import { chart, color, forget } from "./chart.js";
import { element, escaped, many } from "./html.js";

// Colour and mark of each method, program and setting.
const looks = {
    fast: ["fast", "triangle"],
    robust: ["robust", "diamond"],
    exact: ["exact", "circle"],
    double: ["double", "rect"],
    Embree: ["peer", "pin"],
    raylane: ["exact", "circle"],
    "raylane's engine": ["faint", "rect"],
    "raylane --quality": ["quality", "diamond"],
    quality: ["quality", "diamond"],
    depth: ["violet", "triangle"],
    weight: ["earth", "arrow"],
    povray: ["violet", "rect"],
    tachyon: ["earth", "triangle"],
};
const lookOf = (name) => looks[name] ?? ["ink", "circle"];
const marks = { triangle: "\u25b2", diamond: "\u25c6", circle: "\u25cf", rect: "\u25a0", pin: "\u2666", arrow: "\u25bc" };

/** Returns a value as text, numbers with four digits. */
function textOf(value) {
    if (value === null || value === undefined) return "";
    if (typeof value !== "number") return `${value}`;
    return Number.isInteger(value) ? `${value}` : `${Number(value.toPrecision(4))}`;
}

function table(columns, rows) {
    return element(
        "details",
        {},
        element("summary", {}, "Numbers"),
        element(
            "table",
            {},
            element("tr", {}, ...columns.map((each) => element("th", {}, each))),
            ...rows.map((row) => element("tr", {}, ...row.map((each) => element("td", {}, textOf(each))))),
        ),
    );
}

function axis(name, extra) {
    return {
        name,
        nameLocation: "middle",
        nameTextStyle: { color: color("faint"), fontSize: 11 },
        axisLine: { lineStyle: { color: color("line") } },
        splitLine: { lineStyle: { color: color("line") } },
        ...extra,
    };
}

const power = (value) => (value === 0 || (value >= 0.01 && value < 1e4) ? `${Number(value.toPrecision(3))}` : value.toExponential(0));

/** Draws one panel: lines of points [x, y, ...values for the tooltip]. */
function lines(place, { title, x, y, series, vertical, tip, isLog = [true, true], least, most }) {
    chart(place, () => ({
        title: { text: title, textStyle: { fontSize: 13, color: color("ink") } },
        grid: { left: 22, right: 16, top: 34, bottom: 24, containLabel: true },
        tooltip: {
            trigger: "item",
            confine: true,
            backgroundColor: color("panel"),
            borderColor: color("line"),
            textStyle: { color: color("ink"), fontSize: 12 },
            formatter: ({ seriesName, value }) => tip(seriesName, value).map(escaped).join("<br>"),
        },
        xAxis: axis(x, { type: isLog[0] ? "log" : "value", max: most, nameGap: 22, axisLabel: { color: color("faint"), fontSize: 10, formatter: power, hideOverlap: true, showMaxLabel: most === undefined } }),
        yAxis: axis(y, { type: isLog[1] ? "log" : "value", nameGap: 38, min: least, axisLabel: { color: color("faint"), fontSize: 10, formatter: power, hideOverlap: true } }),
        series: series.map(({ name, points, isLine = true }, number) => ({
            name,
            type: isLine ? "line" : "scatter",
            data: points,
            symbol: lookOf(name)[1],
            symbolSize: isLine ? 7 : 13,
            itemStyle: { color: color(lookOf(name)[0]) },
            lineStyle: { color: color(lookOf(name)[0]), width: 1.5 },
            emphasis: { scale: 1.4 },
            // The first series carries the panel's vertical line.
            markLine: number === 0 && vertical ? { silent: true, symbol: "none", lineStyle: { color: color("ink"), type: "solid", width: 1 }, label: { show: false }, data: [{ xAxis: vertical }] } : undefined,
        })),
    }));
}

/** Returns the key for all panels of a figure. */
function key(entries) {
    return element(
        "p",
        { className: "key" },
        ...entries.flatMap(([name, meaning]) => {
            const [its, mark] = lookOf(name);
            const dot = element("span", { textContent: `${marks[mark]} ` });
            dot.style.color = `var(--${its})`;
            return [dot, `${meaning}  `];
        }),
    );
}

function figure(place, title, ...rest) {
    const made = element("div", { className: "figure" }, element("h3", {}, title), ...rest);
    place.append(made);
    return made;
}

function select(label, options, change) {
    const made = element("select", {}, ...options.map(([value, text]) => new Option(text ?? value, value)));
    made.addEventListener("change", change);
    return [element("label", {}, `${label} `, made), made];
}

const methodMeanings = [
    ["fast", "fast: textbook formulas in float"],
    ["robust", "robust: the best formulas in float"],
    ["exact", "exact: float bounds, certified in double, exact arithmetic in doubt"],
    ["double", "double: the formulas of robust in double"],
    ["Embree", "Embree 3: its own solvers in float, the faster of its calls"],
];

const errors = {
    ulps_p99: "error of t [ulp], 99th percentile",
    ulps_median: "error of t [ulp], median",
    ulps_max: "error of t [ulp], maximum",
    wrong: "misclassified rays [%]",
};

/** Returns the small print of a figure: processor, versions and date of its measurements. */
const smallPrint = (text) => (text ? [element("p", { className: "small-print" }, text)] : []);

/** Shows speed against error for the nearest of 12 shapes, one panel for each shape. */
function showMethods(place, shares, machine) {
    const rows = shares.map((row) => (row.wrong === undefined ? row : { ...row, wrong: 100 * row.wrong }));
    const panels = element("div", { className: "panels" });
    const numbers = element("div");
    const unique = (name) => [...new Set(rows.map((row) => row[name]))];
    const present = Object.entries(errors).filter(([name]) => rows.some((row) => row[name] !== undefined));
    const [rays, raysSelect] = select("Rays", unique("rays").map((each) => [each]), draw);
    const [isa, isaSelect] = select("Instructions", unique("isa").map((each) => [each]), draw);
    const [error, errorSelect] = select("Error", present, draw);
    for (const [chosen, name] of [[raysSelect, "rays"], [isaSelect, "isa"], [errorSelect, "error"]]) chosen.dataset.choice = name;
    const preferred = { rays: "random", isa: ["avx512", "avx2", "sse4.2", "neon", "portable"].find((each) => unique("isa").includes(each)) };
    raysSelect.value = unique("rays").includes(preferred.rays) ? preferred.rays : unique("rays")[0];
    isaSelect.value = preferred.isa ?? unique("isa")[0];
    const made = figure(
        place,
        "Speed and error of the nearest hit among 12 shapes, with normals, one thread",
        element("p", {}, "Lower right is better: faster and more accurate. Vertical line: upper bound, a brute-force float loop for this shape. Zeros are at the bottom."),
        element("div", { className: "controls" }, rays, isa, error),
        key(methodMeanings.filter(([name]) => rows.some((row) => row.method === name))),
        panels,
        numbers,
        ...smallPrint(machine),
    );
    made.id = "methods";
    function draw() {
        const chosen = rows.filter((row) => row.rays === raysSelect.value && row.isa === isaSelect.value);
        const kind = errorSelect.value;
        const floor = kind === "wrong" ? 1e-5 : 0.1;
        panels.querySelectorAll(".chart").forEach(forget);
        panels.replaceChildren();
        for (const shape of new Set(chosen.map((row) => row.shape))) {
            const measured = chosen.filter((row) => row.shape === shape);
            if (measured.every((row) => row.method === "ceiling")) continue;
            const ceiling = measured.find((row) => row.method === "ceiling");
            const drawn = element("div", { className: "chart" });
            drawn.dataset.shape = shape;
            panels.append(element("div", { className: "panel" }, drawn));
            lines(drawn, {
                title: shape.replaceAll("_", " "),
                x: "million rays/s",
                y: errors[kind],
                isLog: [false, true],
                least: floor,
                vertical: ceiling?.mrays,
                most: ceiling && Math.ceil(1.1 * Math.max(...measured.map((row) => row.mrays))),
                series: measured
                    .filter((row) => row.method !== "ceiling" && row[kind] !== undefined)
                    .map((row) => ({ name: row.method, isLine: false, points: [[row.mrays, Math.max(row[kind], floor), row]] })),
                tip: (name, [, , row]) => [
                    `${name}, ${shape.replaceAll("_", " ")}`,
                    `${textOf(row.mrays)} million rays/s`,
                    ...Object.entries(errors)
                        .filter(([each]) => row[each] !== undefined)
                        .map(([each, text]) => `${text}: ${textOf(row[each])}`),
                ],
            });
        }
        const columns = ["shape", "method", "million rays/s", ...present.map(([, text]) => text)];
        numbers.replaceChildren(table(columns, chosen.map((row) => [row.shape, row.method, row.mrays, ...present.map(([name]) => row[name])])));
    }
    draw();
}

/** Adds the panels of a figure, one for each value of the column `by`. */
function panelsOf(place, rows, by, options) {
    const panels = element("div", { className: "panels" });
    place.append(panels);
    for (const name of new Set(rows.map((row) => row[by]))) {
        const drawn = element("div", { className: "chart" });
        panels.append(element("div", { className: "panel" }, drawn));
        lines(drawn, { title: name, ...options(rows.filter((row) => row[by] === name)) });
    }
}

const series = (rows, name, point) =>
    [...new Set(rows.map((row) => row[name]))].map((each) => ({ name: each, points: rows.filter((row) => row[name] === each).map(point) }));

function showPictures(place, rows, machine) {
    const made = figure(
        place,
        "Time and error of whole images, 400 pixels wide, one thread",
        element("p", {}, "Lower left is better: faster and more accurate. The series vary the samples per pixel; the quality; and, with 64 samples per pixel, the limits of depth and weight."),
        key([...methodMeanings.slice(0, 4).map(([name]) => [name, name]), ["quality", "exact, quality [dB]"], ["depth", "exact, depth limit"], ["weight", "exact, weight limit [1/1000]"]]),
    );
    made.id = "pictures";
    panelsOf(made, rows, "scene", (subset) => ({
        x: "time per image [ms]",
        y: "RMSE to 1,024 samples per pixel",
        series: series(subset, "way", (row) => [row.ms, row.rmse, row]),
        tip: (name, [, , row]) => [`${name} ${textOf(row.value)}`, `${textOf(row.ms)} ms`, `RMSE ${textOf(row.rmse)}`],
    }));
    made.append(table(["scene", "setting", "value", "time [ms]", "RMSE"], rows.map((row) => [row.scene, row.way, row.value, row.ms, row.rmse])), ...smallPrint(machine));
}

function showCounts(place, rows, machine) {
    const made = figure(
        place,
        "Rays per second against the number of spheres, one thread",
        element("p", {}, "Higher is better. Uniform spheres of radius 0.3/n^(1/3) in the unit cube. Each hit has t, unit normal and id."),
        key([["raylane", "raylane's library"], ["raylane's engine", "raylane's engine, internal arrays"], ["Embree", "Embree, fastest call"]]),
    );
    made.id = "counts";
    panelsOf(made, rows, "rays", (subset) => ({
        x: "number of spheres",
        y: "million rays/s",
        series: series(subset, "by", (row) => [row.count, row.mrays, row]),
        tip: (name, [, , row]) => [`${name}, ${many(row.count)} spheres`, `${textOf(row.mrays)} million rays/s`],
    }));
    made.append(table(["rays", "by", "spheres", "million rays/s"], rows.map((row) => [row.rays, row.by, row.count, row.mrays])), ...smallPrint(machine));
}

function showPeers(place, rows, machine) {
    const made = figure(
        place,
        "Time and error of whole programs",
        element("p", {}, "Upper left is better: faster and more accurate. PSNR against the renderer's own converged image. A scene under a sky light has no POV-Ray, which has no sky light."),
        key([["raylane", "raylane, fixed samples per pixel"], ["raylane --quality", "raylane --quality"], ["povray", "POV-Ray"], ["tachyon", "Tachyon"]]),
    );
    made.id = "peers";
    panelsOf(made, rows, "scene", (subset) => ({
        x: "wall-clock time [s]",
        y: "PSNR [dB]",
        isLog: [true, false],
        least: 25,
        series: series(subset, "by", (row) => [row.seconds, row.psnr, row]),
        tip: (name, [, , row]) => [`${name} ${textOf(row.setting)}`, `${textOf(row.seconds)} s`, `${textOf(row.psnr)} dB`],
    }));
    made.append(table(["scene", "program", "setting", "time [s]", "PSNR [dB]"], rows.map((row) => [row.scene, row.by, row.setting, row.seconds, row.psnr])), ...smallPrint(machine));
}

/** Shows the figures that have data; `machines` has their small print. */
export function showCharts(place, data, machines) {
    for (const [name, show] of [["methods", showMethods], ["pictures", showPictures], ["counts", showCounts], ["peers", showPeers]])
        if (data[name].length) show(place, data[name], machines[name]);
}
