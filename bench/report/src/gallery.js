import { element, many } from "./html.js";
import { shown, unpack } from "./pictures.js";

function numbers({ off, wrong, ulps }) {
    const lines = [];
    if (off !== undefined) lines.push(element("span", { className: off ? "bad" : "" }, `${many(off)} pixels differ`));
    if (wrong !== undefined)
        lines.push(element("br"), element("span", { className: wrong ? "bad" : "" }, `${many(wrong)} rays misclassified`));
    if (ulps) {
        const [median, most99, most] = ulps.map((each) => many(Number(each.toPrecision(3))));
        lines.push(element("br"), `error of t: ${median}, ${most99}, ${most} ulps`);
    }
    return lines;
}

/** Shows each failure as a row of images. open(set, picture) shows one in the viewer. Images are drawn when they scroll near. */
export function showGallery(place, failures, sets, open) {
    const drawing = new IntersectionObserver(
        async (entries) => {
            for (const entry of entries)
                if (entry.isIntersecting) {
                    drawing.unobserve(entry.target);
                    await draw(entry.target, sets);
                }
        },
        { rootMargin: "600px" },
    );
    for (const failure of failures) {
        const set = sets.find((each) => each.name === failure.name);
        const row = element("div", { className: "row" });
        row.dataset.set = set.name;
        for (const picture of set.pictures) {
            const canvas = element("canvas", { width: set.width, height: set.height });
            const button = element("button", { type: "button", title: `Compare: ${picture.title}, exact` }, canvas);
            button.setAttribute("aria-label", `${failure.title}: ${picture.title}`);
            button.addEventListener("click", () => open(set.name, picture.name));
            row.append(element("figure", {}, button, element("figcaption", {}, element("b", {}, picture.title), ...numbers(picture.numbers))));
        }
        place.append(
            element(
                "article",
                { className: "failure" },
                element("h3", {}, failure.title),
                element("div", { className: "reference" }, failure.reference),
                element("p", {}, failure.failure, element("br"), element("span", { className: "reference" }, `Remedy in the textbook tracer: ${failure.remedy}.`)),
                row,
            ),
        );
        drawing.observe(row);
    }
}

async function draw(row, sets) {
    const set = await unpack(sets.find((each) => each.name === row.dataset.set));
    row.querySelectorAll("canvas").forEach((canvas, i) => {
        canvas.getContext("2d").putImageData(shown(set, set.pictures[i]), 0, 0);
    });
    row.dataset.drawn = "yes";
}
