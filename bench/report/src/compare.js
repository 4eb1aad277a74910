import { chart } from "./chart.js";
import { color } from "./colors.js";
import { listen } from "./gestures.js";
import { element, many } from "./html.js";
import { colorsOf, legendOf } from "./maps.js";
import { differences, read, shown, unpack } from "./pictures.js";

const $ = (id) => document.getElementById(id);
const pixelHint = "Point at a pixel for its values.";

/** Compares two images of a set. */
export class Viewer {
    constructor(sets) {
        this.sets = sets;
        this.canvas = $("canvas");
        this.exposure = 0;
        this.showsB = false;
        this.images = new Map();
        for (const stops of [-4, -2, -1, 0, 1, 2, 4, 8])
            $("exposure").append(new Option(`${stops > 0 ? "+" : ""}${stops} EV`, stops, false, stops === 0));
        for (const set of sets) $("set").append(new Option(set.title, set.name));
        const middle = (factor) => () => this.zoomAbout(this.canvas.width / 2, this.canvas.height / 2, factor);
        const wirings = {
            set: ["change", () => this.open($("set").value)],
            a: ["change", () => this.choose()],
            b: ["change", () => this.choose()],
            exposure: ["change", () => this.choose()],
            mode: ["change", () => this.stopBlinking() || this.choose()],
            split: ["input", () => this.draw()],
            flip: ["click", () => this.flip()],
            blink: ["change", () => this.blink()],
            in: ["click", middle(2)],
            out: ["click", middle(0.5)],
            fit: ["click", () => this.fit()],
            own: ["change", () => this.takeFiles([...$("own").files])],
        };
        for (const [id, [event, act]] of Object.entries(wirings)) $(id).addEventListener(event, act);
        listen(this.canvas, {
            moves: (dx, dy) => this.move(dx, dy),
            zooms: (x, y, factor) => this.zoomAbout(x, y, factor),
            points: (x, y) => this.showPixel(x, y),
            flips: () => this.flip(),
        });
        for (const name of ["dragover", "drop"])
            window.addEventListener(name, (event) => {
                event.preventDefault();
                if (name === "drop") this.takeFiles([...event.dataTransfer.files]);
            });
        new ResizeObserver(() => this.resize()).observe(this.canvas);
    }

    async open(name, a, b) {
        this.wanted = name;
        const set = await unpack(this.sets.find((each) => each.name === name));
        if (this.wanted !== name) return; // another set was chosen meanwhile
        const isNew = set !== this.set;
        this.set = set;
        $("set").value = name;
        const last = set.pictures.at(-1).name;
        for (const [id, chosen] of [["a", a ?? set.pictures[0].name], ["b", b ?? set.reference ?? last]]) {
            $(id).replaceChildren(...set.pictures.map((each) => new Option(each.title, each.name)));
            $(id).value = chosen;
        }
        const mode = $("mode").value;
        for (const old of $("mode").querySelectorAll("[data-map]")) old.remove();
        for (const map of set.maps) {
            const option = new Option(map.title, `map:${map.name}`);
            option.dataset.map = map.name;
            $("mode").append(option);
        }
        $("mode").value = mode;
        if ($("mode").selectedIndex < 0) $("mode").value = "slider";
        if (isNew) {
            this.images.clear();
            this.fit(false);
            $("pixel").textContent = pixelHint;
        }
        this.choose();
    }

    choose() {
        const { set } = this;
        if (!set) return;
        const [a, b] = ["a", "b"].map((id) => set.pictures.find((each) => each.name === $(id).value));
        if (a !== this.a || b !== this.b) {
            [this.a, this.b] = [a, b];
            this.differences = differences(set, a, b);
            this.showTotals();
            this.showHistogram();
        }
        this.mode = $("mode").value;
        this.map = set.maps.find((each) => `map:${each.name}` === this.mode);
        if (Number($("exposure").value) !== this.exposure) {
            this.exposure = Number($("exposure").value);
            this.images.clear();
        }
        this.images.delete("map");
        $("split-label").style.visibility = this.mode === "slider" ? "visible" : "hidden";
        $("legend").replaceChildren(...legendOf(this.mode, this.map));
        this.draw();
    }

    /** Returns the canvas of an image; without an image, that of the map or of the differences. */
    image(picture) {
        const key = picture ?? "map";
        if (!this.images.has(key)) {
            const { width, height } = this.set;
            const data = picture ? shown(this.set, picture, this.exposure) : new ImageData(width, height);
            if (!picture) {
                const colors = colorsOf(this.mode, this.map, this.differences);
                for (let i = 0; i < width * height; ++i) {
                    data.data.set(colors(i), 4 * i);
                    data.data[4 * i + 3] = 255;
                }
            }
            const canvas = new OffscreenCanvas(width, height);
            canvas.getContext("2d").putImageData(data, 0, 0);
            this.images.set(key, canvas);
        }
        return this.images.get(key);
    }

    showTotals() {
        const { absolute, ulps, isSame, rmse, numberless } = this.differences;
        const sameCount = isSame.reduce((sum, each) => sum + each, 0);
        const greatest = (values) => values.reduce((a, b) => (b > a ? b : a), 0);
        const rows = [
            ["pixels with identical bits", `${many(sameCount)} of ${many(isSame.length)}`],
            ["largest difference", `${greatest(absolute).toPrecision(4)}; ${many(greatest(ulps))} ulps`],
            ["root mean square difference", rmse.toPrecision(4)],
        ];
        if (numberless) rows.push(["NaN or infinity on one side", `${many(numberless)} pixels`]);
        $("totals").replaceChildren(...rows.map((cells) => element("tr", {}, ...cells.map((text) => element("td", { textContent: text })))));
    }

    /** Shows a histogram of the pixels by powers of ten of their difference. */
    showHistogram() {
        const names = ["equal", ...Array.from({ length: 10 }, (_, i) => `1e${i - 9}`), "more"];
        const counts = new Array(names.length).fill(0);
        const { absolute, isSame } = this.differences;
        for (let i = 0; i < absolute.length; ++i) {
            const bin = Math.ceil(Math.log10(absolute[i])) + 10;
            ++counts[isSame[i] ? 0 : Number.isNaN(bin) ? names.length - 1 : Math.min(Math.max(bin, 1), names.length - 1)];
        }
        chart($("histogram"), () => ({
            grid: { left: 8, right: 8, top: 30, bottom: 4, containLabel: true },
            title: { text: "Number of pixels by difference, up to", textStyle: { fontSize: 13, fontWeight: "normal", color: color("ink") } },
            tooltip: { trigger: "axis", backgroundColor: color("panel"), borderColor: color("line"), textStyle: { color: color("ink") } },
            xAxis: { type: "category", data: names, axisLabel: { color: color("faint"), fontSize: 10 } },
            yAxis: {
                type: "log",
                min: 0.5,
                axisLabel: { color: color("faint"), formatter: (value) => (value < 1 ? "0" : `${value}`) },
                splitLine: { lineStyle: { color: color("line") } },
            },
            series: [{ name: "pixels", type: "bar", data: counts.map((each) => each || null), itemStyle: { color: color("accent") } }],
        }));
    }

    resize() {
        const box = this.canvas.getBoundingClientRect();
        const ratio = window.devicePixelRatio || 1;
        this.canvas.width = Math.max(1, Math.round(box.width * ratio));
        this.canvas.height = Math.max(1, Math.round(box.height * ratio));
        if (this.set && !this.isZoomed) this.fit(false);
        this.draw();
    }

    /** Returns the zoom at which the whole image fits. */
    fitting() {
        return Math.min(this.canvas.width / this.set.width, this.canvas.height / this.set.height);
    }

    fit(draws = true) {
        if (!this.set) return;
        this.zoom = this.fitting();
        this.x = (this.canvas.width - this.zoom * this.set.width) / 2;
        this.y = (this.canvas.height - this.zoom * this.set.height) / 2;
        this.isZoomed = false;
        if (draws) this.draw();
    }

    move(dx, dy) {
        this.x += dx;
        this.y += dy;
        this.isZoomed = true;
        this.draw();
    }

    zoomAbout(x, y, factor) {
        if (!this.set) return;
        const zoom = Math.min(Math.max(this.zoom * factor, this.fitting() / 4), Math.max(256, 4 * this.fitting()));
        this.x = x - ((x - this.x) * zoom) / this.zoom;
        this.y = y - ((y - this.y) * zoom) / this.zoom;
        this.zoom = zoom;
        this.isZoomed = true;
        this.draw();
    }

    flip() {
        this.showsB = !this.showsB;
        if (this.mode !== "flip") {
            $("mode").value = "flip";
            this.choose();
        } else this.draw();
    }

    blink() {
        clearInterval(this.timer);
        if ($("blink").checked) this.timer = setInterval(() => this.flip(), 600);
    }

    stopBlinking() {
        $("blink").checked = false;
        this.blink();
    }

    draw() {
        if (!this.set || !this.a) return;
        const context = this.canvas.getContext("2d");
        context.fillStyle = "#808080";
        context.fillRect(0, 0, this.canvas.width, this.canvas.height);
        context.imageSmoothingEnabled = false;
        const put = (image) => context.drawImage(image, this.x, this.y, this.zoom * this.set.width, this.zoom * this.set.height);
        if (this.mode === "slider") {
            const split = (this.canvas.width * Number($("split").value)) / 100;
            put(this.image(this.b));
            context.save();
            context.beginPath();
            context.rect(0, 0, split, this.canvas.height);
            context.clip();
            put(this.image(this.a));
            context.restore();
            context.fillStyle = "#ffffff";
            context.fillRect(split - 1, 0, 2, this.canvas.height);
        } else put(this.image(this.mode === "flip" ? (this.showsB ? this.b : this.a) : null));
        this.writeValues(context);
        this.writeNames(context);
    }

    write(context, text, x, y, room) {
        context.lineWidth = 3 * (window.devicePixelRatio || 1);
        context.strokeStyle = "#000000";
        context.fillStyle = "#ffffff";
        context.strokeText(text, x, y, room);
        context.fillText(text, x, y, room);
    }

    writeNames(context) {
        const ratio = window.devicePixelRatio || 1;
        const [isSlider, isFlip] = [this.mode === "slider", this.mode === "flip"];
        const room = this.canvas.width / (isSlider ? 2.2 : 1);
        context.font = `${13 * ratio}px system-ui, sans-serif`;
        context.textAlign = "left";
        if (isSlider || (isFlip && !this.showsB)) this.write(context, `A: ${this.a.title}`, 8 * ratio, 18 * ratio, room);
        context.textAlign = "right";
        if (isSlider || (isFlip && this.showsB)) this.write(context, `B: ${this.b.title}`, this.canvas.width - 8 * ratio, 18 * ratio, room);
    }

    /** Writes its values into each pixel if they fit. */
    writeValues(context) {
        const ratio = window.devicePixelRatio || 1;
        if (this.zoom < 64 * ratio) return;
        const { width, height } = this.set;
        const count = width * height;
        const split = (this.canvas.width * Number($("split").value)) / 100;
        context.font = `${11 * ratio}px ui-monospace, monospace`;
        context.textAlign = "left";
        const [left, top] = [Math.max(0, Math.floor(-this.x / this.zoom)), Math.max(0, Math.floor(-this.y / this.zoom))];
        for (let y = top; y < height && this.y + y * this.zoom < this.canvas.height; ++y)
            for (let x = left; x < width && this.x + x * this.zoom < this.canvas.width; ++x) {
                const i = y * width + x;
                const at = this.x + x * this.zoom;
                const isB = this.mode === "flip" ? this.showsB : this.mode === "slider" && at + this.zoom / 2 > split;
                let lines = [0, 1, 2].map((c) => (isB ? this.b : this.a).planes[c * count + i].toPrecision(4));
                if (this.map) lines = [`${this.map.values[i]}`];
                else if (this.mode === "ulps") lines = [`${this.differences.ulps[i]}`];
                else if (this.mode === "difference") lines = [this.differences.absolute[i].toPrecision(3)];
                lines.forEach((text, line) => this.write(context, text, at + 5 * ratio, this.y + y * this.zoom + (16 + 14 * line) * ratio));
            }
    }

    /** Shows the values of the pixel at a position of the canvas. */
    showPixel(canvasX, canvasY) {
        if (!this.set) return;
        const { width, height, maps } = this.set;
        const [x, y] = [Math.floor((canvasX - this.x) / this.zoom), Math.floor((canvasY - this.y) / this.zoom)];
        if (x < 0 || y < 0 || x >= width || y >= height) return;
        const i = y * width + x;
        const values = (picture) => [0, 1, 2].map((c) => picture.planes[c * width * height + i].toPrecision(9)).join("  ");
        const { absolute, ulps, isSame } = this.differences;
        const lines = [
            `pixel (${x}, ${y})`,
            `A ${values(this.a)}`,
            `B ${values(this.b)}`,
            isSame[i] ? "identical bits" : `difference ${absolute[i].toPrecision(4)}, ${many(ulps[i])} ulps`,
            ...maps.map((map) => `${map.title}: ${map.labels ? map.labels[map.values[i]] : map.values[i]}`),
        ];
        $("pixel").textContent = lines.join("\n");
    }

    /** Adds the user's files to a set for their size, together with earlier files of that size. */
    async takeFiles(files) {
        const [pictures, complaints] = [[], []];
        for (const file of files)
            try {
                pictures.push(await read(file));
            } catch {
                complaints.push(`${file.name}: expected a PNG or PFM file.`);
            }
        $("own").value = "";
        if (pictures.length) {
            const { width, height } = pictures[0];
            const before = this.own?.width === width && this.own.height === height ? this.own.pictures : [];
            const kept = before.filter((each) => !pictures.some((other) => other.name === each.name));
            const fitting = pictures.filter((each) => each.width === width && each.height === height);
            if (fitting.length < pictures.length) complaints.push(`Files of other sizes than ${width} x ${height} pixels are left out.`);
            const own = { name: ":own", title: "your files", width, height, pictures: [...kept, ...fitting], maps: [], ready: true };
            if (this.own) this.sets.splice(this.sets.indexOf(this.own), 1, own);
            else {
                this.sets.push(own);
                $("set").append(new Option(own.title, own.name));
            }
            this.own = own;
            await this.open(own.name, (own.pictures.at(-2) ?? own.pictures[0]).name, own.pictures.at(-1).name);
        }
        $("status").textContent = complaints.join(" ");
    }
}
