// Checks a page of bench/report.py in headless Chromium: its numbers match the JSON, its controls work, and the browser
// reports no errors. run.sh calls it.
//
//   node page_check.mjs MODULES PAGE FOLDER PICTURES    MODULES: a node_modules with puppeteer-core; FOLDER: the
//                                                       page's data; PICTURES: the folder for screenshots
import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import process from "node:process";

const [modules, page_file, folder, pictures] = process.argv.slice(2).map((each) => path.resolve(each));
const puppeteer = createRequire(path.join(modules, "x"))("puppeteer-core");
const json = (name) => JSON.parse(fs.readFileSync(path.join(folder, name), "utf8").replaceAll("NaN", "null"));

const browser = await puppeteer.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-dev-shm-usage"] });
const page = await browser.newPage();
const complaints = [];
page.on("console", (message) => ["error", "warn"].includes(message.type()) && complaints.push(message.text()));
page.on("pageerror", (error) => complaints.push(`${error}`));
page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));

const until = (condition, ...rest) => page.waitForFunction(condition, { timeout: 60000 }, ...rest);
const chosen = () => page.$$eval("#compare select", (each) => each.map((one) => one.value));
/** Returns the pixel at a share of an image's width and height. */
const pixel = (source, x, y) =>
    page.evaluate(
        async (src, x, y) => {
            const image = Object.assign(new Image(), { src });
            await image.decode();
            const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
            context.drawImage(image, 0, 0);
            return [...context.getImageData(x * image.width, y * image.height, 1, 1).data];
        },
        source,
        x,
        y,
    );
const rows = (figure) =>
    page.$$eval(`#${figure} details tr`, (lines) => lines.slice(1).map((line) => [...line.children].map((each) => each.textContent)));
const is_near = (text, value) => assert.ok(Math.abs(Number(text) - value) <= 6e-4 * Math.abs(value), `${text} is not ${value}`);
const screenshot = (name) => page.screenshot({ path: path.join(pictures, `${name}.png`) });
const median = (numbers) => {
    const sorted = [...numbers].sort((a, b) => a - b);
    return (sorted[Math.floor((sorted.length - 1) / 2)] + sorted[Math.ceil((sorted.length - 1) / 2)]) / 2;
};

try {
    await page.setViewport({ width: 1200, height: 1000 });
    await page.goto(`file://${page_file}`);
    await until(() => document.querySelector("img-comparison-slider.rendered"));

    // The charts' tables and tooltips have the numbers of the JSON.
    const runs = json("chart.json").benchmarks.filter((run) => run.run_type === "iteration");
    const speed_of = (shape, method) =>
        median(runs.filter((run) => run.run_name === `methods/${shape}/random/${method}/avx512`).map((run) => run.items_per_second / 1e6));
    const methods = await rows("methods");
    assert.ok(methods.length >= 5);
    for (const [shape, method, speed, p99, , , wrong] of methods) {
        const names = method === "Embree" ? ["embree1", "embree16"] : [method];
        is_near(speed, Math.max(...names.map((name) => speed_of(shape, name))));
        if (method === "ceiling") continue;
        const run = runs.find((each) => each.run_name === `methods/${shape}/random/${names.at(-1)}/avx512`);
        is_near(p99, run.ulps_p99);
        is_near(wrong, 100 * run.wrong);
    }
    await page.select('[data-choice="rays"]', "hard");
    await page.select('[data-choice="error"]', "wrong");
    assert.notDeepEqual(await rows("methods"), methods);
    await page.select('[data-choice="rays"]', "random");
    await page.select('[data-choice="error"]', "ulps_p99");
    // Marks are at their numbers, and tooltips show the numbers.
    const fills = { fast: "#d7301f", robust: "#a86f00", exact: "#0072b2", double: "#666666", Embree: "#00805c" };
    const places = await page.$eval(
        '#methods [data-shape="sphere"]',
        (panel, colors) =>
            Object.fromEntries(
                Object.entries(colors).map(([name, fill]) => {
                    const box = panel.querySelector(`path[fill="${fill}"]`).getBoundingClientRect();
                    return [name, [box.x + box.width / 2, box.y + box.height / 2]];
                }),
            ),
        fills,
    );
    const of_sphere = (name) => methods.find((row) => row[0] === "sphere" && row[1] === name).map(Number);
    const share = (name, axis, number) =>
        (places[name][axis] - places.fast[axis]) / (places.double[axis] - places.fast[axis]) -
        (number(of_sphere(name)) - number(of_sphere("fast"))) / (number(of_sphere("double")) - number(of_sphere("fast")));
    for (const name of ["robust", "exact"]) {
        assert.ok(Math.abs(share(name, 0, (row) => row[2])) < 0.02, `${name}: speed`);
        assert.ok(Math.abs(share(name, 1, (row) => Math.log(row[3]))) < 0.02, `${name}: error`);
    }
    const mark = await page.waitForSelector(`#methods [data-shape="sphere"] path[fill='${fills.exact}']`);
    await mark.scrollIntoView();
    await mark.hover();
    const [, , speed, p99] = methods.find((row) => row[0] === "sphere" && row[1] === "exact");
    await until(
        (...lines) => lines.every((line) => document.querySelector("#methods .panels").textContent.includes(line)),
        "exact, sphere",
        `${speed} million rays/s`,
        `99th percentile: ${p99}`,
    );
    await screenshot("methods");
    const peers = json("peers.json").rows.filter((row) => row.threads === 1);
    const counts = await rows("counts");
    for (const [rays, by, count, speed] of counts) {
        const row = peers.find((each) => `${each.what} rays` === rays && each.scene === `spheres/${count}`);
        is_near(speed, { raylane: row.by.find((each) => each.name === row.own), "raylane's engine": row.by[0], Embree: row.by.at(-1) }[by].median);
    }
    assert.equal(counts.length, 12);
    const errors = json("errors.json").rows;
    assert.deepEqual(
        (await rows("peers")).map((row) => row.slice(0, 3)),
        errors.map((row) => [row.scene, row.by, row.setting]),
    );
    for (const [i, [, , , seconds, psnr]] of (await rows("peers")).entries()) {
        is_near(seconds, errors[i].seconds);
        is_near(psnr, errors[i].psnr);
    }
    const drawn = await rows("pictures");
    assert.equal(drawn.length, 4);
    for (const [scene, way, value, ms, rmse] of drawn) {
        const run = runs.find((each) => each.run_name === `picture/${scene}/${way === "exact" ? "samples" : way}/exact/${value}`);
        is_near(ms, 1000 * run.seconds);
        is_near(rmse, run.rmse);
    }

    // In the gallery, each failure has five images with the numbers of the data. The exact image has no differing pixel.
    const data = await page.$eval("#data", (each) => JSON.parse(each.textContent));
    const captions = await page.$$eval(".failure", (each) =>
        each.map((one) => [...one.querySelectorAll("figcaption")].map((caption) => caption.textContent)),
    );
    assert.equal(captions.length, 16);
    for (const [i, failure] of data.failures.entries()) {
        const { pictures } = data.sets.find((set) => set.name === failure.name);
        assert.equal(captions[i].length, 5);
        for (const [k, { title, numbers }] of pictures.entries()) {
            const ulps = numbers.ulps.map((each) => Number(each.toPrecision(3)).toLocaleString("en")).join(", ");
            const [off, wrong] = [numbers.off, numbers.wrong].map((each) => each.toLocaleString("en"));
            assert.equal(captions[i][k], `${title}${off} pixels differ${wrong} rays misclassified` + `error of t: ${ulps} ulps`);
        }
        assert.ok(pictures[0].numbers.off > 300);
        assert.equal(pictures[4].numbers.off, 0);
    }
    const ospray = 1 + data.failures.findIndex((each) => each.name === "ospray-279");
    const thumbnail = async (k) =>
        pixel(await page.$eval(`.failure:nth-of-type(${ospray}) figure:nth-child(${k}) img`, (each) => each.src), 0.05, 0.05);
    assert.deepEqual(await thumbnail(1), [0x27, 0x30, 0x3d, 255]); // the background
    assert.notDeepEqual(await thumbnail(5), [0x27, 0x30, 0x3d, 255]);
    await page.evaluate(() => document.querySelector("#failures").scrollIntoView());
    await screenshot("failures");
    await (await page.$(".failure:nth-of-type(4) figure:nth-child(1) button")).click();
    assert.deepEqual(await chosen(), ["mitsuba-512", "textbook", "exact"]);
    await screenshot("slider");

    // The slider shows the left image, which is gray, beside the right one, which is white.
    await page.select("#set", "own/known");
    assert.deepEqual(await chosen(), ["own/known", "a.png", "b.png"]);
    const slider = await page.$("img-comparison-slider");
    const shade = async (x) => (await pixel(`data:image/png;base64,${await slider.screenshot({ encoding: "base64" })}`, x, 0.1))[0];
    assert.deepEqual([await shade(0.3), await shade(0.7)], [188, 255]);
    const box = await slider.boundingBox();
    await page.mouse.click(box.x + 0.8 * box.width, box.y + 0.1 * box.height);
    assert.deepEqual([await shade(0.7), await shade(0.9)], [188, 255]);
    await page.select("#right", "a.png");
    assert.equal(await shade(0.9), 188);

    // The dark theme, which charts follow; the libraries' licences; a phone's screen.
    const inks = () => page.evaluate(() => [getComputedStyle(document.body).backgroundColor, document.querySelector("#methods svg text").getAttribute("fill")]);
    const light = await inks();
    await page.click("#theme");
    const dark = await inks();
    assert.ok(light[0] !== dark[0] && light[1] !== dark[1]);
    const licences = await page.$eval("#licences", (each) => each.textContent);
    for (const words of ["Apache License", "Apache ECharts", "Redistribution and use", "Copyright (c) Microsoft", "img-comparison-slider"]) assert.ok(licences.includes(words), words);
    await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
    await page.reload();
    await until(() => document.querySelector("img-comparison-slider.rendered") && document.querySelector("#peers svg"));
    for (const section of ["failures", "compare", "speed"]) {
        await page.evaluate((id) => document.getElementById(id).scrollIntoView(), section);
        await new Promise((done) => setTimeout(done, 500));
        await screenshot(`phone-${section}`);
    }
    const wide = await page.evaluate(() =>
        [...document.querySelectorAll("body *")]
            .filter((each) => each.getBoundingClientRect().right > 390 && !each.closest("details, svg"))
            .map((each) => `${each.tagName} ${each.id} ${each.className}`),
    );
    assert.deepEqual(wide, []);
    assert.deepEqual(complaints, []);
    console.log("the page matches its data");
} finally {
    await browser.close();
}
