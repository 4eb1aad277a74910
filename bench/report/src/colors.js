/** Returns a colour of the style sheet in the current theme. */
export function color(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Colours from dark blue over red and yellow to white, for a share in [0, 1]. Brighter means more. */
const stops = [
    [0, 0, 4],
    [40, 11, 84],
    [101, 21, 110],
    [159, 42, 99],
    [212, 72, 66],
    [245, 125, 21],
    [250, 193, 39],
    [252, 255, 164],
];
export function heat(share) {
    const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
    const at = Math.min(Math.floor(place), stops.length - 2);
    return stops[at].map((from, c) => Math.round(from + (place - at) * (stops[at + 1][c] - from)));
}
export function css([r, g, b]) {
    return `rgb(${r} ${g} ${b})`;
}
