import "img-comparison-slider";

const $ = (id) => document.getElementById(id);

/** Compares two images of a set. Returns open(set, left), which shows an image beside the set's reference. */
export function showComparison(sets) {
    const sides = ["left", "right"];
    const pictures = () => sets[$("set").selectedIndex].pictures;
    const show = () => {
        for (const side of sides) {
            const { png, title } = pictures()[$(side).selectedIndex];
            Object.assign($(`${side}-image`), { src: png, alt: title });
        }
    };
    const open = (name, left) => {
        $("set").value = name;
        for (const side of sides) $(side).replaceChildren(...pictures().map((each) => new Option(each.title, each.name)));
        $("left").value = left ?? pictures()[0].name;
        $("right").value = sets[$("set").selectedIndex].reference;
        show();
    };
    $("set").append(...sets.map((each) => new Option(each.title, each.name)));
    $("set").addEventListener("change", () => open($("set").value));
    for (const side of sides) $(side).addEventListener("change", show);
    open(sets[0].name);
    return open;
}
