// Looks at a page of bench/report.py in headless Chromium: its numbers are those of the JSON that it was made of,
// its controls do what they say, and nothing complains. By run.sh.
//
//   node page_check.mjs MODULES PAGE FOLDER PICTURES    MODULES: a node_modules with puppeteer-core; FOLDER: what
//                                                       the page was made of; PICTURES: where screenshots go
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

const until = (what, ...rest) => page.waitForFunction(what, { timeout: 60000 }, ...rest);
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

    // The charts: their tables, and what is under the mouse, have the numbers of the JSON.
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
        is_near(wrong, run.wrong);
    }
    await page.select('[data-choice="rays"]', "hard");
    await page.select('[data-choice="error"]', "wrong");
    assert.notDeepEqual(await rows("methods"), methods);
    await page.select('[data-choice="rays"]', "random");
    await page.select('[data-choice="error"]', "ulps_p99");
    const mark = await page.waitForSelector("#methods .chart path[fill='#0072b2']");
    await mark.scrollIntoView();
    await mark.hover();
    await until(() => /exact.*million rays\/s/s.test(document.querySelector("#methods .panels").textContent));
    await screenshot("methods");
    const peers = json("peers.json").rows.filter((row) => row.threads === 1);
    const counts = await rows("counts");
    for (const [rays, by, count, speed] of counts) {
        const row = peers.find((each) => `${each.what} rays` === rays && each.scene === `spheres/${count}`);
        is_near(speed, { raylane: row.by.find((each) => each.name === row.own), "its engine": row.by[0], Embree: row.by.at(-1) }[by].median);
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
    assert.equal((await rows("pictures")).length, 4);

    // The gallery: each failure has five pictures, of which the exact one is off nowhere.
    const failures = await page.$$eval(".failure", (each) => each.map((one) => one.querySelectorAll("figure").length));
    assert.deepEqual(failures, new Array(14).fill(5));
    const captions = await page.$$eval(".failure figure:last-child figcaption", (each) => each.map((one) => one.textContent));
    for (const caption of captions) assert.match(caption, /^exact0 pixels off0 rays wrong/);
    const textbook = await page.$$eval(".failure figure:first-child figcaption", (each) => each.map((one) => one.textContent));
    for (const caption of textbook) assert.match(caption, /[1-9][\d,]* pixels off/);
    await page.evaluate(() => document.querySelector("#failures").scrollIntoView());
    await screenshot("failures");
    await (await page.$(".failure:nth-of-type(4) figure:nth-child(1) button")).click();
    await until(() => document.querySelector("#set").value === "mitsuba-512" && document.querySelector("#a").value === "textbook");
    assert.equal(await page.$eval("#b", (each) => each.value), "exact");

    // Two pictures of 4 x 3 pixels whose differences are known.
    await choose("set", "known");
    await until(() => document.querySelector("#a").value === "a.pfm");
    await choose("b", "b.pfm");
    assert.deepEqual(await totals(), ["10 of 12", "0.5000; 8,388,608 ulps", (Math.sqrt(0.5 ** 2 + 2 ** -48) / 6).toPrecision(4)]);
    await choose("mode", "ulps");
    await page.$eval("#canvas", (each) => each.scrollIntoView({ block: "center" }));
    const box = await (await page.$("#canvas")).boundingBox();
    const at = async (x, y) => {
        await page.mouse.move(box.x + (box.width * (x + 0.5)) / 4, box.y + (box.height * (y + 0.5)) / 3);
        return page.$eval("#pixel", (each) => each.textContent);
    };
    assert.match(await at(1, 0), /pixel \(1, 0\)\nA 0.500000000 .*\nB 1.00000000 .*\ndifference 0.5000, 8,388,608 ulps/);
    assert.match(await at(3, 2), /pixel \(3, 2\)\n.*\n.*\ndifference 5.960e-8, 1 ulps/);
    assert.match(await at(0, 1), /difference 0.000, 0 ulps/);
    const bars = await page.$$eval("#histogram path[fill='#0072b2']", (each) => each.length);
    assert.equal(bars, 3); // the same, up to 1e-7, up to 1

    // What the controls do is seen.
    await choose("set", "birthday");
    await until(() => document.querySelector("#b").value === "exact");
    await choose("mode", "slider");
    const seen = new Set([await bits()]);
    const is_new = async (what) => {
        const now = await bits();
        assert.ok(!seen.has(now), what);
        seen.add(now);
    };
    await page.$eval("#split", (each) => {
        each.value = 20;
        each.dispatchEvent(new Event("input"));
    });
    await is_new("the slider moves");
    await page.click("#flip");
    await is_new("flips");
    await page.focus("#canvas");
    await page.keyboard.press(" ");
    await is_new("flips back");
    for (const mode of ["difference", "ulps", "map:samples", "map:tiers"]) {
        await choose("mode", mode);
        await is_new(mode);
        await screenshot(mode.replace("map:", ""));
    }
    assert.match(await page.$eval("#legend", (each) => each.textContent), /at once.*pixels/);
    await choose("mode", "slider");
    await choose("exposure", "-2");
    await is_new("darker");
    await choose("exposure", "0");
    for (let i = 0; i < 6; ++i) await page.click("#in");
    await is_new("zooms");
    await screenshot("zoomed");
    const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    await page.mouse.move(middle.x, middle.y);
    await page.mouse.down();
    await page.mouse.move(middle.x + 60, middle.y + 30);
    await page.mouse.up();
    await is_new("moves");
    await page.mouse.wheel({ deltaY: 300 });
    await is_new("the wheel zooms");
    await page.click("#fit");

    // A picture of the user's own, and what is none.
    const none = path.join(folder, "none.pfm");
    fs.writeFileSync(none, "PF\n1 1\n-1\n");
    const own = await page.$("#own");
    await own.uploadFile(path.join(folder, "pictures/known/a.pfm"), none);
    await until(() => document.querySelector("#set").value === ":own");
    assert.equal(await page.$eval("#a", (each) => each.options.length), 1);
    await own.uploadFile(path.join(folder, "pictures/known/b.pfm"));
    await until(() => document.querySelector("#a").options.length === 2);
    assert.equal((await totals())[0], "10 of 12");

    // Dark, and on a phone.
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await paper();
    await page.click("#theme");
    assert.notEqual(await paper(), light);
    await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
    await new Promise((done) => setTimeout(done, 500));
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
    console.log("the page shows what it was made of");
} finally {
    await browser.close();
}
