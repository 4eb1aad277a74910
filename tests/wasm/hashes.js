// usage: node hashes.js FOLDER RAYLANE
// Compares the WebAssembly build in FOLDER with the bits of a native raylane: all shipped scenes,
// on each instruction set and as the page renders them; rays; and decimal numbers.
"use strict";
const { execFileSync } = require("child_process");
const { createHash } = require("crypto");
const fs = require("fs");
const os = require("os");
const path = require("path");

const [folder, raylane] = process.argv.slice(2);
const source = path.join(__dirname, "../../scenes");
const { Engine } = require(path.join(source, "web/engine.js"));
const temporary = fs.mkdtempSync(path.join(os.tmpdir(), "raylane-"));
process.on("exit", () => fs.rmSync(temporary, { recursive: true }));

const hash = (bytes) => createHash("sha256").update(bytes).digest("hex").slice(0, 16);
const as_bytes = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);

let compared = 0;
const wrong = [];
function same(what, got, expected) {
    compared += 1;
    if (got === expected) return;
    wrong.push(`${what}: ${got}, natively ${expected}`);
}

function native(command, ...rest) {
    execFileSync(raylane, [command, "--quiet", ...rest], { stdio: ["ignore", "ignore", "inherit"] });
}

// Returns a * b + c rounded once to `bits` bits, with exponents from `least` on, by integer
// arithmetic.
function fused(a, b, c, bits, least) {
    const view = new DataView(new ArrayBuffer(8));
    const parts = (x) => { // x = m * 2 ** e
        view.setFloat64(0, x);
        const word = view.getBigUint64(0), exponent = Number((word >> 52n) & 0x7FFn);
        const fraction = word & 0xFFFFFFFFFFFFFn;
        const m = exponent === 0 ? fraction : fraction | (1n << 52n);
        return [word >> 63n ? -m : m, Math.max(exponent, 1) - 1075];
    };
    const [[ma, ea], [mb, eb], [mc, ec]] = [a, b, c].map(parts);
    const low = Math.min(ea + eb, ec);
    let sum = (ma * mb << BigInt(ea + eb - low)) + (mc << BigInt(ec - low));
    if (sum === 0n) return a * b + c; // whose sign is right
    const sign = sum < 0n ? -1 : 1;
    if (sum < 0n) sum = -sum;
    const length = sum.toString(2).length;
    const dropped = Math.max(length - bits, least - low);
    if (dropped > 0) {
        const half = 1n << BigInt(dropped - 1), rest = sum & (2n * half - 1n);
        sum >>= BigInt(dropped);
        if (rest > half || (rest === half && (sum & 1n) === 1n)) sum += 1n;
    }
    // Exact unless too large. In two steps, as one factor could overflow or underflow by itself.
    const exponent = low + Math.max(dropped, 0), first = Math.trunc(exponent / 2);
    return sign * Number(sum) * 2 ** first * 2 ** (exponent - first);
}

// Returns a native image, from the top down: rows of floats, which a PFM has from the bottom up, or
// bytes.
function native_film(scene, options, width, height) {
    const file = path.join(temporary, "picture.pfm");
    native("render", scene, "--size", `${width}x${height}`, ...options, "-o", file);
    const data = fs.readFileSync(file), row = 12 * width;
    const start = data.length - row * height;
    return Buffer.concat(Array.from({ length: height }, (_, y) => data.subarray(start + (height - 1 - y) * row, start + (height - y) * row)));
}
function native_bytes(scene, options, width, height) {
    const file = path.join(temporary, "picture.ppm");
    native("render", scene, "--size", `${width}x${height}`, ...options, "-o", file);
    return fs.readFileSync(file).subarray(-3 * width * height);
}

// Returns random rays through the camera's target, the same on each run. Some have a 0 in their
// direction.
function make_rays(camera, count) {
    let state = 1;
    const random = () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
    const away = camera.from.map((x, axis) => x - camera.at[axis]);
    const size = Math.hypot(...away);
    const rays = new Float32Array(6 * count);
    for (let i = 0; i < count; ++i)
        for (let axis = 0; axis < 3; ++axis) {
            const origin = camera.at[axis] + size * (2 * random() - 1);
            rays[6 * i + axis] = origin;
            const through = camera.at[axis] + 0.3 * size * (2 * random() - 1);
            rays[6 * i + 3 + axis] = i % 16 === axis ? 0 : through - origin;
        }
    return rays;
}
function native_hits(scene, rays) {
    const header = `{'descr': '<f4', 'fortran_order': False, 'shape': (${rays.length / 6}, 6), }`;
    const padded = header.padEnd(64 * Math.ceil((header.length + 11) / 64) - 11) + "\n";
    const file = path.join(temporary, "rays.npy"), out = path.join(temporary, "hits.npy");
    const head = Buffer.concat([Buffer.from("\x93NUMPY\x01\x00", "latin1"), Buffer.from([padded.length & 255, padded.length >> 8])]);
    fs.writeFileSync(file, Buffer.concat([head, Buffer.from(padded), as_bytes(rays)]));
    native("trace", scene, file, "-o", out);
    return fs.readFileSync(out).subarray(-22 * rays.length / 6);
}

class Lanes {
    constructor(module) {
        this.module = module;
        this.isas = module.UTF8ToString(module._lanes_isas()).trim().split("\n");
    }
    require(place) {
        if (place === 0) throw new Error(this.module.UTF8ToString(this.module._lanes_error()));
        return place;
    }
    // Calls work() with the address of a copy of some bytes.
    with(bytes, work) {
        const place = this.module._malloc(bytes.length);
        this.module.HEAPU8.set(bytes, place);
        const answer = work(place);
        this.module._free(place);
        return answer;
    }
    text(text, work) {
        return this.with(Buffer.from(text + "\0"), work);
    }
    load(text, name) {
        this.text(text, (at) => this.text(name, (name_at) => this.require(this.module._lanes_load(at, Buffer.byteLength(text), name_at))));
    }
    draw(isa, width, height, grid) {
        const at = this.require(this.module._lanes_draw(isa, width, height, grid));
        return this.module.HEAPU8.slice(at, at + 12 * width * height);
    }
    trace(isa, rays) {
        const count = rays.length / 6;
        return this.with(as_bytes(rays), (place) => {
            const at = this.require(this.module._lanes_trace(isa, place, count));
            return this.module.HEAPU8.slice(at, at + 22 * count);
        });
    }
}

function compare_scene(scene, lanes, engine) {
    const name = path.basename(scene), text = fs.readFileSync(scene, "utf8");
    const began = performance.now();
    const [width, height, grid] = [160, 120, 2];
    const expected = hash(native_film(scene, ["--spp", String(grid ** 2)], width, height));
    lanes.load(text, name);
    for (const [isa, isa_name] of lanes.isas.entries())
        same(`${name}, ${isa_name}`, hash(lanes.draw(isa, width, height, grid)), expected);

    // Renders as the page does: in bands, and to bytes.
    const known = engine.load(text, name);
    const draw = (picture, rows) => {
        const films = [], bytes = [];
        for (let first = 0; first < picture.height; first += rows) {
            const band = engine.render({ ...picture, first, rows: Math.min(rows, picture.height - first) });
            films.push(Buffer.from(as_bytes(band.film)));
            bytes.push(Buffer.from(band.bytes.filter((_, i) => i % 4 !== 3)));
        }
        return [hash(Buffer.concat(films)), hash(Buffer.concat(bytes))];
    };
    const [film, bytes] = draw({ width, height, grid }, 24);
    same(`${name}, in bands`, film, expected);
    same(`${name}, in bytes`, bytes, hash(native_bytes(scene, ["--spp", String(grid ** 2)], width, height)));
    const [own] = draw({ width: 80, height: 60, grid: 0 }, 60);
    same(`${name}, its own samples`, own, hash(native_film(scene, [], 80, 60)));

    const rays = make_rays(known.camera, 4096);
    const hits = native_hits(scene, rays);
    for (const [isa, isa_name] of lanes.isas.entries())
        same(`${name}, rays, ${isa_name}`, hash(lanes.trace(isa, rays)), hash(hits));
    const seen = new Set(Array.from({ length: 4096 }, (_, i) => hits.readUInt32LE(22 * i + 16))).size;
    console.log(`${name.padEnd(18)} ${expected}  rays ${hash(hits)} (${seen} shapes)  ${((performance.now() - began) / 1000).toFixed(1)} s`);
}

// Compares decimal numbers with JavaScript's, which are the nearest numbers and the shortest texts.
function compare_numbers(lanes) {
    const words = new DataView(new ArrayBuffer(8));
    let state = 7;
    const random = () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state ^ (state >>> 15);
    };
    const digits_of = (text) => {
        const [mantissa, power = "0"] = text.replace(/^-/, "").split("e");
        const [whole, behind = ""] = mantissa.split(".");
        const all = (whole + behind).replace(/^0+/, "");
        const digits = all.replace(/0+$/, "");
        return `${digits}e${+power - behind.length + all.length - digits.length}`;
    };
    const read_double = (text) => lanes.text(text, (at) => lanes.module._lanes_double(at));
    const read_float = (text) => lanes.text(text, (at) => lanes.module._lanes_float(at));
    const texts = (at) => lanes.module.UTF8ToString(at);
    for (let i = 0; i < 20000; ++i) {
        words.setUint32(0, random());
        words.setUint32(4, i % 4 === 0 ? 0 : random()); // among them powers of two
        if (i % 64 === 0) words.setUint32(0, words.getUint32(0) & 0xFFF00000);
        const double = words.getFloat64(0);
        if (!Number.isFinite(double)) continue;
        const text = texts(lanes.module._lanes_double_text(double));
        const whole = Number.isInteger(double) && !text.includes("e"); // with all of its digits
        same(`digits of ${double}`, whole ? text : digits_of(text), whole ? String(BigInt(double)) : digits_of(String(double)));
        same(`${double} read`, read_double(String(double)), double);
        const float = words.getFloat32(0);
        if (!Number.isFinite(float)) continue;
        same(`${float} as text`, read_float(texts(lanes.module._lanes_float_text(float))), float);
        // Halfway to the next float rounds to even, and just beyond halfway rounds up.
        const bits = words.getUint32(0) & 0x7FFFFFFF;
        words.setUint32(0, bits);
        const low = words.getFloat32(0);
        words.setUint32(0, bits + 1);
        const high = words.getFloat32(0);
        if (!Number.isFinite(high) || low < 1e-20 || low > 1e20) continue;
        const middle = (low + high) / 2; // exact, and so are its digits: its last bit is at least 2^-91
        const exact = middle.toPrecision(100);
        const beyond = exact.includes("e") ? exact.replace("e", "1e") : `${exact}1`;
        same(`${exact} halfway`, read_float(exact), bits % 2 === 0 ? low : high);
        same(`${exact} beyond`, read_float(beyond), high);
    }
    for (const [text, number] of [["1e-60", 0], ["-1e-60", -0], ["1e39", NaN], ["3.4028235e38", 3.4028234663852886e38], ["1e-45", 2 ** -149],
        ["0x10", NaN], ["+1", 1], ["1e", NaN], [".5", 0.5], ["5.", 5], ["", NaN], [" 1", NaN], ["inf", NaN], ["nan", NaN]])
        same(`"${text}"`, Object.is(read_float(text), number), true);
}

// Compares sums almost halfway between two numbers, denormal numbers, infinities and NaN.
function compare_fused(lanes) {
    const { _lanes_fma: fma, _lanes_fmaf: fmaf } = lanes.module;
    let state = 7;
    const random = () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
    const whole = (bits) => Math.floor(random() * 2 ** Math.min(bits, 30)) + (bits > 30 ? Math.floor(random() * 2 ** 30) * 2 ** (bits - 30) : 0);
    const compare = (bits, least, round, call, what) => {
        for (let i = 0; i < 20000; ++i) {
            const scale = Math.floor(random() * (i % 4 === 3 ? 60 - least : 40)) - (i % 4 === 3 ? 30 : 20);
            const one = 2 ** (bits - 1);
            const a = round((one + whole(bits - 1)) / one * (random() < 0.5 ? -1 : 1));
            const b = i % 2 === 0 ? round((one + whole(bits - 1)) / one) : round(1 + (1 - Math.floor(random() * 3)) / one);
            // a * b is half of the last place of c, or a little more or less.
            const c = i % 4 < 2 ? round((one + whole(bits - 1)) * 2) : round((one + whole(bits - 1)) / one * 2 ** (bits - Math.floor(random() * 4)));
            const factor = i % 4 === 3 ? 2 ** Math.max(least + bits - 2, -scale - bits) : 1;
            const [x, z] = [round(a * factor), round(c * factor)];
            same(`${what}(${x}, ${b}, ${z})`, call(x, b, z), round(fused(x, b, z, bits, least)));
        }
    };
    compare(24, -149, Math.fround, fmaf, "fmaf");
    compare(53, -1074, (x) => x, fma, "fma");
    same("fmaf just below halfway", fmaf((1 - 2 ** -23) * 2 ** -24, 1 + 2 ** -23, 1), 1);
    const specials = [0, -0, 1, -1, Infinity, -Infinity, NaN];
    for (const a of specials)
        for (const b of specials)
            for (const c of specials)
                for (const call of [fma, fmaf]) same(`fused ${a} ${b} ${c}`, Object.is(call(a, b, c), a * b + c), true);
}

async function main() {
    const load = (name) => WebAssembly.compile(fs.readFileSync(path.join(folder, name)));
    globalThis.makeRaylane = require(path.join(folder, "raylane.js"));
    const engine = await Engine.start(await load("raylane.wasm"));
    const lanes = new Lanes(await require(path.join(folder, "raylane-wasm-lanes.js"))({ wasmBinary: fs.readFileSync(path.join(folder, "raylane-wasm-lanes.wasm")) }));
    console.log(`instruction sets: ${lanes.isas.join(", ")}`);
    compare_numbers(lanes);
    console.log(`${compared} numbers as files have them`);
    compare_fused(lanes);
    const shipped = fs.readdirSync(source).filter((name) => name.endsWith(".json") && !name.includes("schema"));
    const others = ["pov/pymol.pov", "pov/vmd.pov", "tachyon/data/vmd.dat"].map((name) => path.join(__dirname, "../scenes/formats", name));
    const scenes = [...shipped.map((name) => path.join(source, name)), ...others];
    for (const scene of scenes) compare_scene(scene, lanes, engine);
    if (!(shipped.length > 0)) wrong.push("no scenes");
    for (const each of wrong.slice(0, 20)) console.error(each);
    console.log(`${scenes.length} scenes, ${compared} comparisons, ${wrong.length} wrong`);
    process.exitCode = wrong.length === 0 ? 0 : 1;
}

main();
