// False-colour maps: a colour for each pixel, and the legend.
import { css, heat } from "./colors.js";
import { element, many } from "./html.js";

const tierColors = [[54, 92, 141], [38, 166, 154], [250, 193, 39], [245, 125, 21], [214, 39, 40]];
const same = [0, 0, 0];
const noNumber = [255, 0, 255];

const ofUlps = (ulps) => heat(0.15 + (0.85 * Math.log2(ulps)) / 31);
const ofDifference = (difference) => heat(0.15 + 0.85 * Math.max(0, 1 + Math.log10(difference) / 8));
const ofSamples = (samples, most) => heat(most > 1 ? Math.log2(samples) / Math.log2(most) : 0);
const most = (map) => map.values.reduce((a, b) => Math.max(a, b), 1);

/** Returns a function from a pixel's index to its colour. */
export function colorsOf(mode, map, { absolute, ulps, isSame }) {
    if (map?.name === "tiers") return (i) => tierColors[map.values[i]];
    if (map) {
        const greatest = most(map);
        return (i) => ofSamples(map.values[i], greatest);
    }
    const color = mode === "ulps" ? (i) => ofUlps(ulps[i]) : (i) => ofDifference(absolute[i]);
    return (i) => (isSame[i] ? same : Number.isFinite(absolute[i]) ? color(i) : noNumber);
}

export function legendOf(mode, map) {
    const entry = (rgb, text) => {
        const box = element("i");
        box.style.background = css(rgb);
        return element("span", {}, box, text);
    };
    if (map?.name === "tiers") {
        const counts = new Array(tierColors.length).fill(0);
        for (const tier of map.values) ++counts[tier];
        return map.labels.map((label, i) => entry(tierColors[i], `${label}: ${many(counts[i])} pixels`));
    }
    const entries = [];
    if (map) {
        const greatest = most(map);
        for (let samples = 1; samples <= greatest; samples *= 4) entries.push(entry(ofSamples(samples, greatest), `${samples}`));
        return [...entries, `samples per pixel, maximum ${greatest}`];
    }
    if (mode === "ulps") for (const power of [0, 4, 8, 16, 24]) entries.push(entry(ofUlps(2 ** power), `${many(2 ** power)} ulps`));
    else if (mode === "difference") for (const power of [-8, -6, -4, -2, 0]) entries.push(entry(ofDifference(10 ** power), `1e${power}`));
    else return [];
    return [entry(same, "identical bits"), ...entries, entry(noNumber, "NaN or infinity")];
}
