// Workers that draw a picture together, in bands of rows.
"use strict";

class Painter {
    constructor(url) {
        this.worker = new Worker(url);
        this.worker.onmessage = ({ data }) => this.settle(data);
        this.worker.onerror = (event) => this.settle({ error: event.message ?? "a worker has failed" });
    }

    settle(data) {
        if ("error" in data) this.failed(new Error(data.error));
        else this.answered(data.answer);
    }

    // Sends a task to the worker when the previous tasks are done.
    ask(message) {
        const before = this.last;
        const task = (async () => {
            await before;
            return new Promise((answered, failed) => {
                Object.assign(this, { answered, failed });
                this.worker.postMessage(message);
            });
        })();
        this.last = task.catch(() => {}); // the caller of that task gets its error
        return task;
    }
}

class Pool {
    // `code`: a WebAssembly.Module; `source`: the script that workers run.
    static async start(count, code, source) {
        const pool = new Pool();
        const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
        pool.workers = Array.from({ length: count }, () => new Painter(url));
        await Promise.all(pool.workers.map((worker) => worker.ask({ task: "start", code })));
        URL.revokeObjectURL(url);
        return pool;
    }

    // Makes all workers read a scene. Returns its properties.
    async load(text, name) {
        const answers = await Promise.all(this.workers.map((worker) => worker.ask({ task: "load", text, name })));
        return answers[0];
    }

    // Draws a picture in `bands` bands of rows per worker, and calls `on_band` for each finished
    // one. Returns the number of rays, or null if `is_stopped` has become true meanwhile.
    async draw(camera, { width, height, grid }, bands, on_band, is_stopped) {
        const multiple = 8; // of rows, because the engine works on squares of pixels
        const rows = Math.max(multiple, Math.ceil(height / (this.workers.length * bands) / multiple) * multiple);
        let next = 0, rays = 0;
        const work = async (worker) => {
            while (next < height && !is_stopped()) {
                const first = next, count = Math.min(rows, height - first);
                next += count;
                const done = await worker.ask({ task: "draw", camera, picture: { width, height, grid, first, rows: count } });
                rays += done.rays;
                on_band(first, count, done.bytes);
            }
        };
        await Promise.all(this.workers.map(work));
        return is_stopped() ? null : rays;
    }
}
