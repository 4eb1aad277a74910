import { chart, forget } from "./chart.js";
import { color } from "./colors.js";
import { element, escaped, many } from "./html.js";

// Colour and mark of each method, program and way.
const looks = {
    fast: ["fast", "triangle"],
    robust: ["robust", "diamond"],
    exact: ["exact", "circle"],
    double: ["double", "rect"],
    Embree: ["peer", "pin"],
    raylane: ["exact", "circle"],
    "its engine": ["faint", "rect"],
    "raylane --quality": ["quality", "diamond"],
    quality: ["quality", "diamond"],
    depth: ["violet", "triangle"],
    weight: ["earth", "arrow"],
    povray: ["violet", "rect"],
    tachyon: ["earth", "triangle"],
};
const lookOf = (name) => looks[name] ?? ["ink", "circle"];
const marks = { triangle: "\u25b2", diamond: "\u25c6", circle: "\u25cf", rect: "\u25a0", pin: "\u2666", arrow: "\u25bc" };

/** Numbers as people read them. */
function told(value) {
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
            ...rows.map((row) => element("tr", {}, ...row.map((each) => element("td", {}, told(each))))),
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

/** One panel: lines of points [x, y, ...what a tooltip tells]. */
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
            // Of the first one, for the panel.
            markLine: number === 0 && vertical ? { silent: true, symbol: "none", lineStyle: { color: color("ink"), type: "solid", width: 1 }, label: { show: false }, data: [{ xAxis: vertical }] } : undefined,
        })),
    }));
}

/** Who is who, once for all panels of a figure. */
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
    ["fast", "fast: float, textbook formulas"],
    ["robust", "robust: float, its best formulas"],
    ["exact", "exact: certified, exact where in doubt"],
    ["double", "double: robust's formulas in double"],
    ["Embree", "Embree: float, its own solvers, the faster call"],
];

const errors = {
    ulps_p99: "ulps of t, 99th percentile",
    ulps_median: "ulps of t, median",
    ulps_max: "ulps of t, maximum",
    wrong: "share of wrong decisions",
};

/** Nearest of a dozen shapes: speed against error, a panel for each shape. */
function showMethods(place, rows) {
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
        "Speed against error: the nearest of 12 shapes, normals included, one thread",
        element("p", {}, "Further right is faster, further down more accurate. A line stands where the plainest loop in float is that can do nothing else. What is 0 is drawn at the bottom."),
        element("div", { className: "controls" }, rays, isa, error),
        key(methodMeanings.filter(([name]) => rows.some((row) => row.method === name))),
        panels,
        numbers,
    );
    made.id = "methods";
    function draw() {
        const chosen = rows.filter((row) => row.rays === raysSelect.value && row.isa === isaSelect.value);
        const what = errorSelect.value;
        const floor = what === "wrong" ? 1e-7 : 0.1;
        panels.querySelectorAll(".chart").forEach(forget);
        panels.replaceChildren();
        for (const shape of new Set(chosen.map((row) => row.shape))) {
            const of = chosen.filter((row) => row.shape === shape);
            if (of.every((row) => row.method === "ceiling")) continue;
            const ceiling = of.find((row) => row.method === "ceiling");
            const drawn = element("div", { className: "chart" });
            drawn.dataset.shape = shape;
            panels.append(element("div", { className: "panel" }, drawn));
            lines(drawn, {
                title: shape.replaceAll("_", " "),
                x: "million rays/s",
                y: errors[what],
                isLog: [false, true],
                least: floor,
                vertical: ceiling?.mrays,
                most: ceiling && Math.ceil(1.1 * Math.max(...of.map((row) => row.mrays))),
                series: of
                    .filter((row) => row.method !== "ceiling" && row[what] !== undefined)
                    .map((row) => ({ name: row.method, isLine: false, points: [[row.mrays, Math.max(row[what], floor), row]] })),
                tip: (name, [, , row]) => [
                    `${name}, ${shape.replaceAll("_", " ")}`,
                    `${told(row.mrays)} million rays/s`,
                    ...Object.entries(errors)
                        .filter(([each]) => row[each] !== undefined)
                        .map(([each, text]) => `${text}: ${told(row[each])}`),
                ],
            });
        }
        const columns = ["shape", "method", "million rays/s", ...present.map(([, text]) => text)];
        numbers.replaceChildren(table(columns, chosen.map((row) => [row.shape, row.method, row.mrays, ...present.map(([name]) => row[name])])));
    }
    draw();
}

/** Panels of one figure, each of rows that have `by` in common. */
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

function showPictures(place, rows) {
    const made = figure(
        place,
        "Whole pictures: time against error, 400 pixels a row, one thread",
        element("p", {}, "Further left is faster, further down more accurate. By samples per pixel, by quality, and by fewer reflections or fewer faint paths of 64 samples."),
        key([...methodMeanings.slice(0, 4).map(([name]) => [name, name]), ["quality", "exact, to a quality"], ["depth", "fewer reflections"], ["weight", "fewer faint paths"]]),
    );
    made.id = "pictures";
    panelsOf(made, rows, "scene", (of) => ({
        x: "milliseconds",
        y: "RMSE to 1,024 samples",
        series: series(of, "way", (row) => [row.ms, row.rmse, row]),
        tip: (name, [, , row]) => [`${name} ${told(row.value)}`, `${told(row.ms)} ms`, `RMSE ${told(row.rmse)}`],
    }));
    made.append(table(["scene", "way", "value", "ms", "RMSE"], rows.map((row) => [row.scene, row.way, row.value, row.ms, row.rmse])));
}

function showCounts(place, rows) {
    const made = figure(
        place,
        "Rays per second against the number of spheres, one thread",
        element("p", {}, "Uniform spheres of radius 0.3/n^(1/3) in the unit cube; t, unit normal and id."),
        key([["raylane", "raylane, as its users call it"], ["its engine", "its engine, by its own arrays"], ["Embree", "Embree, its best call"]]),
    );
    made.id = "counts";
    panelsOf(made, rows, "rays", (of) => ({
        x: "spheres",
        y: "million rays/s",
        series: series(of, "by", (row) => [row.count, row.mrays, row]),
        tip: (name, [, , row]) => [`${name}, ${many(row.count)} spheres`, `${told(row.mrays)} million rays/s`],
    }));
    made.append(table(["rays", "by", "spheres", "million rays/s"], rows.map((row) => [row.rays, row.by, row.count, row.mrays])));
}

function showPeers(place, rows) {
    const made = figure(
        place,
        "Whole programs: seconds against decibels to each one's own converged picture, one thread",
        key([["raylane", "raylane, as many samples in each pixel"], ["raylane --quality", "raylane --quality"], ["povray", "POV-Ray"], ["tachyon", "Tachyon"]]),
    );
    made.id = "peers";
    panelsOf(made, rows, "scene", (of) => ({
        x: "seconds",
        y: "dB",
        isLog: [true, false],
        series: series(of, "by", (row) => [row.seconds, row.psnr, row]),
        tip: (name, [, , row]) => [`${name} ${told(row.setting)}`, `${told(row.seconds)} s`, `${told(row.psnr)} dB`],
    }));
    made.append(table(["scene", "by", "setting", "seconds", "dB"], rows.map((row) => [row.scene, row.by, row.setting, row.seconds, row.psnr])));
}

export function showCharts(place, data) {
    for (const [rows, show] of [[data.methods, showMethods], [data.pictures, showPictures], [data.counts, showCounts], [data.peers, showPeers]])
        if (rows.length) show(place, rows);
}
