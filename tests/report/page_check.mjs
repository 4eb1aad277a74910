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
const own_warning = /getImageData are faster with/; // this check reads the canvas
page.on("console", (message) => {
    if (["error", "warn"].includes(message.type()) && !own_warning.test(message.text())) complaints.push(message.text());
});
page.on("pageerror", (error) => complaints.push(`${error}`));
page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));

const until = (condition, ...rest) => page.waitForFunction(condition, { timeout: 60000 }, ...rest);
const choose = async (id, value) => {
    await page.select(`#${id}`, value);
    await new Promise((done) => setTimeout(done, 100));
};
const bits = () => page.$eval("#canvas", (canvas) => canvas.toDataURL());
const totals = () => page.$$eval("#totals td:nth-child(2)", (cells) => cells.map((each) => each.textContent));
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
    await until(() => document.querySelector('.row[data-drawn="yes"]') && document.querySelector("#totals td"));

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
    const thumbnail = (name, k) =>
        page.$eval(
            `.row[data-set="${name}"] figure:nth-child(${k}) canvas`,
            (canvas) => [...canvas.getContext("2d").getImageData(10, 10, 1, 1).data],
        );
    await page.$eval('.row[data-set="ospray-279"]', (each) => each.scrollIntoView());
    await until(() => document.querySelector('.row[data-set="ospray-279"]').dataset.drawn);
    assert.deepEqual(await thumbnail("ospray-279", 1), [0x27, 0x30, 0x3d, 255]); // the background
    assert.notDeepEqual(await thumbnail("ospray-279", 5), [0x27, 0x30, 0x3d, 255]);
    await page.evaluate(() => document.querySelector("#failures").scrollIntoView());
    await screenshot("failures");
    await (await page.$(".failure:nth-of-type(4) figure:nth-child(1) button")).click();
    await until(() => document.querySelector("#set").value === "mitsuba-512" && document.querySelector("#a").value === "textbook");
    assert.equal(await page.$eval("#b", (each) => each.value), "exact");

    // Two images of 4 x 3 pixels with known differences.
    await choose("set", "own/known");
    await until(() => document.querySelector("#a").value === "a.pfm");
    await choose("b", "b.pfm");
    assert.deepEqual(await totals(), ["10 of 12", "0.5000; 8,388,608 ulps", Math.sqrt((3 * 0.25 + 2 ** -48) / 36).toPrecision(4)]);
    await choose("mode", "ulps");
    await page.$eval("#canvas", (each) => each.scrollIntoView({ block: "center" }));
    const box = await (await page.$("#canvas")).boundingBox();
    const at = async (x, y) => {
        await page.mouse.move(box.x + (box.width * (x + 0.5)) / 4, box.y + (box.height * (y + 0.5)) / 3);
        return page.$eval("#pixel", (each) => each.textContent);
    };
    assert.match(await at(1, 0), /pixel \(1, 0\)\nA 0.500000000 .*\nB 1.00000000 .*\ndifference 0.5000, 8,388,608 ulps/);
    assert.match(await at(3, 2), /pixel \(3, 2\)\n.*\n.*\ndifference 5.960e-8, 1 ulps/);
    assert.match(await at(0, 1), /identical bits/);
    const bars = await page.$$eval("#histogram path[fill='#0072b2']", (each) => each.length);
    assert.equal(bars, 3); // equal, up to 1e-7, up to 1

    // Effect of the controls on a pixel that is 0.5 in A and 1 in B.
    const shade = () =>
        page.$eval("#canvas", (canvas) => canvas.getContext("2d").getImageData(canvas.width * 0.375, canvas.height / 6, 1, 1).data[0]);
    const slide = (percent) =>
        page.$eval(
            "#split",
            (each, value) => {
                each.value = value;
                each.dispatchEvent(new Event("input"));
            },
            percent,
        );
    await choose("mode", "slider");
    await slide(60);
    assert.equal(await shade(), 188);
    await slide(20);
    assert.equal(await shade(), 255);
    await choose("exposure", "-2");
    assert.equal(await shade(), 137);
    await choose("exposure", "0");
    await choose("mode", "flip");
    assert.equal(await shade(), 188);
    await page.click("#flip");
    assert.equal(await shade(), 255);
    await page.focus("#canvas");
    await page.keyboard.press(" ");
    assert.equal(await shade(), 188);
    await page.click("#blink");
    await until(() => document.querySelector("#canvas").getContext("2d").getImageData(0, 0, 1, 1));
    await choose("mode", "difference");
    await new Promise((done) => setTimeout(done, 1300));
    assert.equal(await page.$eval("#mode", (each) => each.value), "difference"); // choosing a mode stops blinking
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.wheel({ deltaY: -300 }); // doubles the zoom
    assert.match(await at(0.01 - 0.5, 0.01 - 0.5), /pixel \(1, 0\)/);
    await page.focus("#canvas");
    await page.keyboard.press("-");
    assert.match(await at(0.01 - 0.5, 0.01 - 0.5), /pixel \(0, 0\)/);
    await page.click("#fit");

    // NaN and infinity differ from numbers without a distance.
    await choose("set", "own/numberless");
    await until(() => document.querySelector("#a").value === "a.pfm");
    await choose("b", "b.pfm");
    assert.deepEqual(await totals(), ["1 of 4", "1.401e-45; 1 ulps", "4.045e-46", "2 pixels"]);
    await choose("mode", "difference");

    // A scene's maps.
    await choose("set", "birthday");
    await until(() => document.querySelector("#b").value === "exact");
    const seen = new Set();
    for (const mode of ["slider", "difference", "ulps", "map:samples", "map:tiers"]) {
        await choose("mode", mode);
        const now = await bits();
        assert.ok(!seen.has(now), mode);
        seen.add(now);
        await screenshot(mode.replace("map:", ""));
    }
    const counts_of_tiers = await page.$$eval("#legend span", (each) =>
        each.map((one) => Number(one.textContent.match(/: ([\d,]+) pixels$/)[1].replaceAll(",", ""))),
    );
    assert.equal(counts_of_tiers.length, 5);
    assert.equal(counts_of_tiers.reduce((a, b) => a + b), 256 * 256);
    assert.ok(counts_of_tiers[0] > 50000 && counts_of_tiers[1] > 1000);
    await choose("mode", "slider");
    for (let i = 0; i < 6; ++i) await page.click("#in");
    await screenshot("zoomed");
    await page.click("#fit");
    await Promise.all([page.select("#set", "protein"), page.select("#set", "birthday")]); // the last choice wins
    await new Promise((done) => setTimeout(done, 1500));
    assert.equal(await page.$eval("#a", (each) => each.options[0].text), data.sets.find((set) => set.name === "birthday").pictures[0].title);

    // The user's files: an image and an invalid file.
    const invalid = path.join(folder, "invalid.pfm");
    fs.writeFileSync(invalid, "PF\n-1 -1\n-1\n000000000000");
    const own = await page.$("#own");
    await own.uploadFile(path.join(folder, "pictures/known/a.pfm"), invalid);
    await until(() => document.querySelector("#set").value === ":own");
    assert.equal(await page.$eval("#a", (each) => each.options.length), 1);
    await until(() => document.querySelector("#status").textContent === "invalid.pfm: expected a PNG or PFM file.");
    await own.uploadFile(path.join(folder, "pictures/known/b.pfm"));
    await until(() => document.querySelector("#a").options.length === 2);
    assert.equal((await totals())[0], "10 of 12");

    // The dark theme, which charts follow; the libraries' licences; a phone's screen.
    const inks = () => page.evaluate(() => [getComputedStyle(document.body).backgroundColor, document.querySelector("#methods svg text").getAttribute("fill")]);
    const light = await inks();
    await page.click("#theme");
    const dark = await inks();
    assert.ok(light[0] !== dark[0] && light[1] !== dark[1]);
    const licences = await page.$eval("#licences", (each) => each.textContent);
    for (const words of ["Apache License", "Apache ECharts", "Redistribution and use", "Copyright (c) Microsoft"]) assert.ok(licences.includes(words), words);
    await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
    await page.reload();
    await until(() => document.querySelector('.row[data-drawn="yes"]') && document.querySelector("#totals td") && document.querySelector("#peers svg"));
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
