// The page: a scene that the user can turn, in pictures that improve while the view does not
// change.
"use strict";

const $ = (id) => document.getElementById(id);
const canvas = $("picture"), context = canvas.getContext("2d");
const SLOWEST = 200, QUICK = 60; // milliseconds per frame in motion: coarser above, finer below
const PATIENCE = 5000; // milliseconds: pictures that take longer are not refined
const DEGREES_PER_SECOND = 40; // of a scene that turns by itself

// Options after # in the address: scene=lens&workers=1&size=256; steady keeps all pixels, even in
// motion.
const asked = new URLSearchParams(location.hash.slice(1));

// The current view. `version` counts its changes.
const view = { around: 0, above: 0, distance: 1, version: 0 };
let pool = null;
let scene = null; // its properties from the engine
let size = { width: 512, height: 512 };
let coarseness = 1; // in motion: the side, in pixels, of the square that one pixel of the picture fills
let turning = false;
let shown = null; // the last complete picture: camera, width, height, grid
const times = []; // when frames in motion were finished

function say(text, wrong = false) {
    $("message").textContent = text;
    $("message").classList.toggle("wrong", wrong);
}

function changed(change = {}) {
    Object.assign(view, change);
    view.version += 1;
    document.body.dataset.state = "drawing";
}

const camera_now = () => turned(scene.camera, view.around, view.above, view.distance);

function counted(count) {
    for (const [unit, name] of [[1e9, " G"], [1e6, " M"], [1e3, " k"]])
        if (count >= unit) return (count / unit).toPrecision(3) + name;
    return count.toFixed(0);
}

// Returns the samples per pixel of successive pictures: one, as many as the scene requests, and
// more.
function stages() {
    const stages = [{ grid: 1, text: "1" }];
    if (scene.quality > 0) return [...stages, { grid: 0, text: `as needed for ${scene.quality} dB` }];
    if (scene.grid > 1) stages.push({ grid: 0, text: String(scene.grid ** 2) });
    const finer = Math.max(2 * scene.grid, 4);
    return [...stages, { grid: finer, text: String(finer ** 2) }];
}

const still = document.createElement("canvas"); // a picture with fewer pixels, to be enlarged
function put(picture, first, rows, bytes) {
    const data = new ImageData(new Uint8ClampedArray(bytes.buffer), picture.width, rows);
    if (picture.width === canvas.width) return context.putImageData(data, 0, first);
    if (still.width !== picture.width || still.height !== picture.height)
        Object.assign(still, { width: picture.width, height: picture.height });
    still.getContext("2d").putImageData(data, 0, first);
    if (first + rows === picture.height) context.drawImage(still, 0, 0, canvas.width, canvas.height);
}

function note_frame(now, milliseconds) {
    times.push(now);
    while (times.length > 2 && now - times[0] > 3000) times.shift();
    if (times.length > 2) $("frames").textContent = (1000 * (times.length - 1) / (now - times[0])).toFixed(1);
    if (asked.has("steady")) return;
    if (milliseconds > SLOWEST && coarseness < 8) coarseness *= 2;
    else if (milliseconds < QUICK && coarseness > 1) coarseness /= 2;
}

// Draws the current view with the samples of a stage. Returns true if the view has not changed
// meanwhile.
async function draw(stage, moves) {
    const version = view.version, began = performance.now();
    const by = moves ? coarseness : 1;
    const picture = {
        width: Math.ceil(size.width / by), height: Math.ceil(size.height / by), grid: stage.grid,
    };
    const camera = camera_now();
    // A picture in motion is shown as a whole, however quickly the user continues.
    const bands = [];
    const is_stopped = () => !moves && view.version !== version;
    const on_band = (first, rows, bytes) => {
        if (moves) bands.push([first, rows, bytes]);
        else if (!is_stopped()) put(picture, first, rows, bytes);
    };
    const rays = await pool.draw(camera, picture, moves ? 3 : 16, on_band, is_stopped);
    if (rays === null) return false;
    bands.sort((a, b) => a[0] - b[0]);
    for (const band of bands) put(picture, ...band);
    const now = performance.now();
    if (moves) note_frame(now, now - began);
    shown = { camera, ...picture };
    $("rays").textContent = counted(rays);
    $("speed").textContent = counted(1000 * rays / (now - began));
    $("samples").textContent = stage.text + (by > 1 ? ` for ${by} × ${by} pixels` : "");
    return view.version === version;
}

const next_frame = () => new Promise((resolve) => requestAnimationFrame(resolve));

// Draws the current view, and refines it while it does not change. Returns true if the first
// picture took long.
async function show() {
    const version = view.version, began = performance.now();
    const [quick, ...better] = stages();
    let alone = await draw(quick, true);
    const is_long = performance.now() - began >= 16;
    if (turning || !alone) return is_long;
    await new Promise((resolve) => setTimeout(resolve, 80)); // the user may be about to continue
    if (view.version !== version) return is_long;
    times.length = 0;
    if (coarseness > 1) alone = await draw(quick, false);
    for (const stage of better) {
        const begins = performance.now();
        alone = alone && view.version === version && await draw(stage, false);
        if (performance.now() - begins > PATIENCE) break;
    }
    if (alone && view.version === version) document.body.dataset.state = "done";
    return is_long;
}

async function run() {
    let drawn = -1;
    let waits = true; // for the display, if frames are quick or there is nothing to do
    for (let before = await next_frame();; ) {
        const now = waits ? await next_frame() : performance.now();
        if (turning) changed({ around: view.around + DEGREES_PER_SECOND * Math.min(now - before, 1000) / 1000 });
        before = now;
        waits = true;
        if (view.version === drawn || scene === null) {
            times.length = 0;
            continue;
        }
        drawn = view.version;
        await attempt(async () => { // after an error, the next picture may succeed
            waits = !await show();
        });
    }
}

let loaded = null; // the last scene that could be read
async function load(text, name) {
    say(`Reading ${name}…`);
    scene = null; // nothing is drawn meanwhile
    changed();
    try {
        loaded = await pool.load(text, name);
    } finally {
        scene = loaded;
    }
    coarseness = 1;
    $("shapes").textContent = scene.shapes.toLocaleString("en");
    home();
    resize();
    say("");
}

function home() {
    changed({ around: 0, above: 0, distance: 1 });
}

function resize() {
    if (scene === null) return; // load() calls this again
    const chosen = $("size").value;
    size = chosen === "own" ? { width: scene.width, height: scene.height } : { width: +chosen, height: +chosen };
    Object.assign(canvas, size);
    changed();
}

// Shows the error if the work fails. A scene that cannot be read leaves the previous one.
async function attempt(work) {
    try {
        await work();
    } catch (failure) {
        say(failure.message, true);
        document.body.dataset.state = "failed";
    }
}

function turn_by(right, up) {
    const elevation = elevation_of(scene.camera);
    const above = Math.min(Math.max(view.above + up, -89 - elevation), 89 - elevation);
    changed({ around: (view.around + right) % 360, above });
}
const come = (times) => changed({ distance: Math.min(Math.max(view.distance / times, 0.02), 50) });

function listen() {
    const fingers = new Map();
    const spread = () => {
        const [a, b] = [...fingers.values()];
        return Math.hypot(a.x - b.x, a.y - b.y);
    };
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    canvas.addEventListener("pointermove", (event) => {
        const finger = fingers.get(event.pointerId);
        if (finger === undefined || scene === null) return;
        const x = event.clientX - finger.x, y = event.clientY - finger.y;
        const before = fingers.size === 2 ? spread() : 0;
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        if (fingers.size === 1) {
            const degrees = 180 / canvas.clientHeight;
            turn_by(-x * degrees, y * degrees);
        } else if (fingers.size === 2 && before > 0) {
            come(spread() / before);
        }
    });
    for (const end of ["pointerup", "pointercancel"])
        canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        if (scene !== null) come(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
        const steps = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] };
        if (scene === null) return;
        if (event.key in steps) turn_by(...steps[event.key]);
        else if (event.key === "+" || event.key === "-") come(event.key === "+" ? 1.1 : 1 / 1.1);
        else return;
        event.preventDefault();
    });
    $("turn").addEventListener("click", () => {
        turning = !turning;
        $("turn").setAttribute("aria-pressed", turning);
        changed();
    });
    $("home").addEventListener("click", home);
    $("size").addEventListener("change", resize);
    $("scene").addEventListener("change", () => attempt(() => load(SHIPPED[$("scene").value], $("scene").value + ".json")));
    $("open").addEventListener("click", () => $("file").click());
    $("file").addEventListener("change", () => attempt(async () => {
        const [file] = $("file").files;
        if (file) await load(await file.text(), file.name);
        $("file").value = "";
    }));
}

async function code() {
    const packed = Uint8Array.from(atob($("code").textContent), (letter) => letter.charCodeAt(0));
    const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return WebAssembly.compile(await new Response(plain).arrayBuffer());
}

attempt(async () => {
    for (const name of Object.keys(SHIPPED)) $("scene").add(new Option(name, name));
    $("scene").value = asked.get("scene") in SHIPPED ? asked.get("scene") : "sphere";
    if (asked.has("size")) $("size").value = asked.get("size");
    const count = Math.min(Math.max(+asked.get("workers") || navigator.hardwareConcurrency || 2, 1), 16);
    pool = await Pool.start(count, await code(), WORKER);
    $("workers").textContent = count;
    listen();
    await load(SHIPPED[$("scene").value], $("scene").value + ".json");
    await run();
});
