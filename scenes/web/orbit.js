// Cameras that the user moves around the point that they look at.
"use strict";

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a, s) => [s * a[0], s * a[1], s * a[2]];
const sum = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => scaled(a, 1 / Math.sqrt(dot(a, a)));

const HIGHEST = 89; // degrees: never over the poles

// Returns the elevation of a camera above the point that it looks at, in degrees.
function elevation_of(camera) {
    const away = sum(camera.from, scaled(camera.at, -1));
    const sine = dot(unit(away), unit(camera.up));
    return Math.asin(Math.min(Math.max(sine, -1), 1)) * 180 / Math.PI;
}

// Returns a camera that is turned around the point that it looks at: by `around` degrees about its
// up direction, by `above` degrees towards that direction, and moved to `distance` times its
// distance. Same as Python's raylane.orbit.
function turned(camera, around, above, distance = 1) {
    const up = unit(camera.up);
    const away = sum(camera.from, scaled(camera.at, -1));
    const length = Math.sqrt(dot(away, away));
    let flat = sum(away, scaled(up, -dot(away, up)));
    if (dot(flat, flat) < 1e-12 * length * length) { // it looks along `up`: any side will do
        const least = up.map(Math.abs).indexOf(Math.min(...up.map(Math.abs)));
        const side = [0, 1, 2].map((axis) => (axis === least ? 1 : 0));
        flat = sum(side, scaled(up, -dot(side, up)));
    }
    flat = unit(flat);
    const side = cross(up, flat);
    const radians = Math.PI / 180;
    const height = Math.min(Math.max(elevation_of(camera) + above, -HIGHEST), HIGHEST) * radians;
    const level = sum(scaled(flat, Math.cos(around * radians)), scaled(side, Math.sin(around * radians)));
    const way = sum(scaled(level, Math.cos(height)), scaled(up, Math.sin(height)));
    return {
        ...camera,
        from: sum(camera.at, scaled(way, distance * length)).map(Math.fround),
        height: camera.height * distance, // of an orthographic camera, for which nearer is larger
        focus_distance: camera.focus_distance * distance,
    };
}

if (typeof module !== "undefined") module.exports = { elevation_of, turned };
