// usage: node assemble.js PAGE FOLDER SCENES...
// Makes one page of the files beside this script, raylane.js and raylane.wasm in FOLDER, and
// scenes.
"use strict";
const fs = require("fs");
const path = require("path");
const zlib = require("zlib");

const [page, folder, ...scenes] = process.argv.slice(2);
const own = (name) => fs.readFileSync(path.join(__dirname, name), "utf8");
const built = (name) => fs.readFileSync(path.join(folder, name));

// Returns a literal for a script, in which "</script" must not end the script's element.
const quoted = (value) => JSON.stringify(value).replaceAll("<", "\\u003C");

const texts = Object.fromEntries(scenes.map((file) => [path.basename(file, ".json"), fs.readFileSync(file, "utf8")]));
const worker = [built("raylane.js").toString(), own("engine.js"), own("worker.js")].join("\n");
const code = zlib.gzipSync(built("raylane.wasm"), { level: 9 }).toString("base64");
const parts = {
    "page.css": own("page.css"),
    "scripts": [
        `const SHIPPED = ${quoted(texts)};`,
        `const WORKER = ${quoted(worker)};`,
        own("orbit.js"), own("pool.js"), own("page.js"),
    ].join("\n").replaceAll("</script", "<\\/script"),
    "raylane.wasm": code,
};
const html = own("page.html").replace(/\{\{([a-z.]+)\}\}/g, (all, name) => parts[name]);
fs.writeFileSync(page, html);
