// One of a page's workers. It has its own engine, and draws rows of pictures on request.
"use strict";

let engine = null;

const tasks = {
    async start({ code }) {
        engine = await Engine.start(code);
        return {};
    },
    load: ({ text, name }) => engine.load(text, name),
    draw({ camera, picture }) {
        const began = performance.now();
        engine.look(camera);
        const { bytes, rays } = engine.render(picture);
        return { bytes: bytes.slice(), rays, milliseconds: performance.now() - began };
    },
};

self.onmessage = async ({ data }) => {
    try {
        const answer = await tasks[data.task](data);
        self.postMessage({ answer }, answer.bytes ? [answer.bytes.buffer] : []);
    } catch (failure) {
        self.postMessage({ error: String(failure.message ?? failure) });
    }
};
