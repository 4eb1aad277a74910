// Bundles src/main.js with its libraries into one script and one style sheet. report.py puts them into the page.
//
//   node build.mjs MODULES OUTPUT    MODULES: a node_modules; OUTPUT: a folder
import { createRequire } from "node:module";
import path from "node:path";
import process from "node:process";
import { fileURLToPath } from "node:url";

const [modules, output] = process.argv.slice(2).map((each) => path.resolve(each));
const { build } = createRequire(path.join(modules, "x"))("esbuild");
const here = path.dirname(fileURLToPath(import.meta.url));
await build({
    entryPoints: [path.join(here, "src/main.js"), path.join(here, "src/style.css")],
    outdir: output,
    bundle: true,
    minify: true,
    format: "iife",
    target: ["chrome100", "firefox115", "safari16.4"],
    nodePaths: [modules],
    legalComments: "inline",
    logLevel: "warning",
});
