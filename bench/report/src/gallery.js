import { element, many } from "./html.js";

function lines({ off, wrong, ulps }) {
    const [median, most99, most] = ulps.map((each) => many(Number(each.toPrecision(3))));
    return [
        element("span", { className: off ? "bad" : "" }, `${many(off)} pixels differ`),
        element("br"),
        element("span", { className: wrong ? "bad" : "" }, `${many(wrong)} rays misclassified`),
        element("br"),
        `error of t: ${median}, ${most99}, ${most} ulps`,
    ];
}

/** Shows each failure as a row of images. open(set, picture) compares one with the exact image. */
export function showGallery(place, failures, sets, open) {
    for (const failure of failures) {
        const set = sets.find((each) => each.name === failure.name);
        const figures = set.pictures.map(({ name, title, png, numbers }) => {
            const image = element("img", { src: png, alt: `${failure.title}: ${title}` });
            const button = element("button", { type: "button", title: `Compare: ${title}, exact` }, image);
            button.addEventListener("click", () => open(set.name, name));
            return element("figure", {}, button, element("figcaption", {}, element("b", {}, title), ...lines(numbers)));
        });
        place.append(
            element(
                "article",
                { className: "failure" },
                element("h3", {}, failure.title),
                element("div", { className: "reference" }, failure.reference),
                element("p", {}, failure.failure, element("br"), element("span", { className: "reference" }, `Remedy in the textbook tracer: ${failure.remedy}.`)),
                element("div", { className: "row" }, ...figures),
            ),
        );
    }
}
