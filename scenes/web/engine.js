// The library in JavaScript: one scene, and pictures of it. For the workers of a page, and for
// node.
"use strict";

const CAMERA_NUMBERS = 14;

class Engine {
    // `module`: the result of makeRaylane() for raylane.wasm.
    constructor(module) {
        this.module = module;
    }

    // Returns an engine. `code`: a WebAssembly.Module, which several engines may share.
    static async start(code) {
        return new Engine(await new Promise((made, failed) => {
            makeRaylane({
                instantiateWasm(imports, ready) {
                    WebAssembly.instantiate(code, imports).then(ready, failed);
                    return {};
                },
            }).then(made, failed);
        }));
    }

    require(good) {
        if (!good) throw new Error(this.module.UTF8ToString(this.module._web_error()));
    }

    // Loads a scene. The extension of `name` decides the format; if it is unknown, the text does.
    // Returns the scene's properties.
    load(text, name) {
        const bytes = new TextEncoder().encode(text);
        const name_bytes = new TextEncoder().encode(name + "\0");
        const [place, name_place] = [this.room(bytes.length), this.room(name_bytes.length)];
        this.module.HEAPU8.set(bytes, place);
        this.module.HEAPU8.set(name_bytes, name_place);
        const good = this.module._web_load(place, bytes.length, name_place);
        this.module._free(place);
        this.module._free(name_place);
        this.require(good);
        return {
            shapes: this.module._web_shape_count(),
            width: this.module._web_width(),
            height: this.module._web_height(),
            grid: this.module._web_grid(),
            quality: this.module._web_quality(),
            camera: this.camera(),
        };
    }

    // Allocates memory. Pointers have 32 bits, and calls return them as signed numbers.
    room(size) {
        const place = this.module._malloc(size) >>> 0;
        if (place === 0 && size > 0) throw new Error("out of memory");
        return place;
    }

    numbers() {
        const first = (this.module._web_camera() >>> 0) / 4;
        return this.module.HEAPF32.subarray(first, first + CAMERA_NUMBERS);
    }

    camera() {
        const n = Array.from(this.numbers());
        return {
            orthographic: n[0] !== 0, from: n.slice(1, 4), at: n.slice(4, 7), up: n.slice(7, 10),
            field_of_view: n[10], height: n[11], lens_radius: n[12], focus_distance: n[13],
        };
    }

    look(camera) {
        this.numbers().set([
            camera.orthographic ? 1 : 0, ...camera.from, ...camera.at, ...camera.up,
            camera.field_of_view, camera.height, camera.lens_radius, camera.focus_distance,
        ]);
        this.require(this.module._web_look());
    }

    // Draws rows of a picture with grid x grid samples, or as the scene requests if `grid` is 0.
    // The result is in the engine's memory, which the next call overwrites: bytes in a canvas's
    // format, and linear floats, three per pixel.
    render({ width, height, grid = 0, first = 0, rows = height }) {
        this.require(this.module._web_render(width, height, grid, first, rows));
        const pixels = width * rows;
        const bytes = this.module._web_bytes() >>> 0, film = (this.module._web_film() >>> 0) / 4;
        return {
            bytes: this.module.HEAPU8.subarray(bytes, bytes + 4 * pixels),
            film: this.module.HEAPF32.subarray(film, film + 3 * pixels),
            rays: this.module._web_rays(),
        };
    }
}

if (typeof module !== "undefined") module.exports = { Engine };
