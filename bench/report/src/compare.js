import { chart } from "./chart.js";
import { color, css, heat } from "./colors.js";
import { differences, read, shown, unpack } from "./pictures.js";

const $ = (id) => document.getElementById(id);
const tierColors = [[54, 92, 141], [38, 166, 154], [250, 193, 39], [245, 125, 21], [214, 39, 40]];

/** Looks at two pictures of a set. */
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
        $("set").addEventListener("change", () => this.open($("set").value));
        for (const id of ["a", "b", "mode", "exposure"]) $(id).addEventListener("change", () => this.choose());
        $("split").addEventListener("input", () => this.draw());
        $("flip").addEventListener("click", () => this.flip());
        $("blink").addEventListener("change", () => this.blink());
        $("in").addEventListener("click", () => this.zoomAbout(this.canvas.width / 2, this.canvas.height / 2, 2));
        $("out").addEventListener("click", () => this.zoomAbout(this.canvas.width / 2, this.canvas.height / 2, 0.5));
        $("fit").addEventListener("click", () => this.fit());
        $("own").addEventListener("change", () => this.takeFiles($("own").files));
        this.listen();
        new ResizeObserver(() => this.resize()).observe(this.canvas);
    }

    async open(name, a, b) {
        const set = await unpack(this.sets.find((each) => each.name === name));
        const isNew = set !== this.set;
        this.set = set;
        $("set").value = name;
        const last = set.pictures.at(-1).name;
        for (const [id, chosen] of [["a", a ?? set.pictures[0].name], ["b", b ?? set.reference ?? last]]) {
            $(id).replaceChildren(...set.pictures.map((each) => new Option(each.title, each.name)));
            $(id).value = chosen;
        }
        for (const old of $("mode").querySelectorAll("[data-map]")) old.remove();
        for (const map of set.maps) {
            const option = new Option(map.title, `map:${map.name}`);
            option.dataset.map = map.name;
            $("mode").append(option);
        }
        if (!$("mode").value) $("mode").value = "slider";
        if (isNew) {
            this.images.clear();
            this.fit(false);
            $("pixel").textContent = "Point at a pixel for its values.";
        }
        this.choose();
    }

    choose() {
        const { set } = this;
        const find = (id) => set.pictures.find((each) => each.name === $(id).value);
        this.a = find("a");
        this.b = find("b");
        this.mode = $("mode").value;
        this.map = set.maps.find((each) => `map:${each.name}` === this.mode);
        if (Number($("exposure").value) !== this.exposure) {
            this.exposure = Number($("exposure").value);
            this.images.clear();
        }
        this.differences = differences(set, this.a, this.b);
        this.images.delete("field");
        $("split-label").style.visibility = this.mode === "slider" ? "visible" : "hidden";
        this.showTotals();
        this.showHistogram();
        this.showLegend();
        this.draw();
    }

    /** What is drawn of a picture, or in place of one. */
    image(picture) {
        const key = picture ?? "field";
        if (!this.images.has(key)) {
            const data = picture ? shown(this.set, picture, this.exposure) : this.field();
            const canvas = new OffscreenCanvas(this.set.width, this.set.height);
            canvas.getContext("2d").putImageData(data, 0, 0);
            this.images.set(key, canvas);
        }
        return this.images.get(key);
    }

    field() {
        const image = new ImageData(this.set.width, this.set.height);
        const colors = this.scale();
        for (let i = 0; i < image.width * image.height; ++i) {
            image.data.set(colors(i), 4 * i);
            image.data[4 * i + 3] = 255;
        }
        return image;
    }

    /** Colour by pixel. */
    scale() {
        const { absolute, ulps } = this.differences;
        if (this.map?.name === "tiers") return (i) => tierColors[this.map.values[i]];
        if (this.map) {
            const most = Math.log2(this.mapMost());
            return (i) => heat(most > 0 ? Math.log2(this.map.values[i]) / most : 0);
        }
        if (this.mode === "ulps") return (i) => (ulps[i] === 0 ? [0, 0, 0] : heat(0.15 + (0.85 * Math.log2(ulps[i])) / 31));
        return (i) => (absolute[i] === 0 ? [0, 0, 0] : heat(0.15 + 0.85 * Math.max(0, 1 + Math.log10(absolute[i]) / 8)));
    }

    mapMost() {
        return this.map.values.reduce((a, b) => Math.max(a, b), 1);
    }

    showLegend() {
        const entry = (rgb, text) => {
            const span = document.createElement("span");
            const box = document.createElement("i");
            box.style.background = css(rgb);
            span.append(box, text);
            return span;
        };
        const entries = [];
        if (this.map?.name === "tiers") {
            const counts = new Array(tierColors.length).fill(0);
            for (const tier of this.map.values) ++counts[tier];
            this.map.labels.forEach((label, i) => entries.push(entry(tierColors[i], `${label}: ${counts[i].toLocaleString("en")} pixels`)));
        } else if (this.map) {
            const most = this.mapMost();
            for (let samples = 1; samples <= most; samples *= 4)
                entries.push(entry(heat(most > 1 ? Math.log2(samples) / Math.log2(most) : 0), `${samples}`));
            entries.push(`samples in a pixel; at most ${most}`);
        } else if (this.mode === "ulps") {
            entries.push(entry([0, 0, 0], "the same bits"));
            for (const power of [0, 4, 8, 16, 24]) entries.push(entry(heat(0.15 + (0.85 * power) / 31), `${(2 ** power).toLocaleString("en")} ulps`));
        } else if (this.mode === "difference") {
            entries.push(entry([0, 0, 0], "the same bits"));
            for (const power of [-8, -6, -4, -2, 0]) entries.push(entry(heat(0.15 + 0.85 * (1 + power / 8)), `1e${power}`));
        }
        $("legend").replaceChildren(...entries);
    }

    showTotals() {
        const { absolute, ulps, rmse } = this.differences;
        const same = absolute.reduce((sum, each) => sum + (each === 0 ? 1 : 0), 0);
        const most = absolute.reduce((a, b) => Math.max(a, b), 0);
        const mostUlps = ulps.reduce((a, b) => Math.max(a, b), 0);
        const rows = [
            ["pixels with the same bits", `${same.toLocaleString("en")} of ${absolute.length.toLocaleString("en")}`],
            ["largest difference", `${most.toPrecision(4)}; ${mostUlps.toLocaleString("en")} ulps`],
            ["root mean square", rmse.toPrecision(4)],
        ];
        $("totals").replaceChildren(
            ...rows.map((cells) => {
                const row = document.createElement("tr");
                row.append(...cells.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
                return row;
            }),
        );
    }

    /** Pixels by the powers of ten of their difference. */
    showHistogram() {
        const names = ["same", ...Array.from({ length: 10 }, (_, i) => `1e${i - 9}`), "more"];
        const counts = new Array(names.length).fill(0);
        for (const each of this.differences.absolute)
            ++counts[each === 0 ? 0 : Math.min(Math.max(Math.ceil(Math.log10(each)) + 10, 1), names.length - 1)];
        chart($("histogram"), () => ({
            grid: { left: 8, right: 8, top: 30, bottom: 4, containLabel: true },
            title: { text: "Pixels by their difference, up to", textStyle: { fontSize: 13, fontWeight: "normal", color: color("ink") } },
            tooltip: { trigger: "axis" },
            xAxis: { type: "category", data: names, axisLabel: { color: color("faint"), fontSize: 10 } },
            yAxis: { type: "log", min: 0.5, axisLabel: { color: color("faint"), formatter: (v) => (v < 1 ? "0" : `${v}`) }, splitLine: { lineStyle: { color: color("line") } } },
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

    fit(draws = true) {
        const { width, height } = this.set;
        this.zoom = Math.min(this.canvas.width / width, this.canvas.height / height);
        this.x = (this.canvas.width - this.zoom * width) / 2;
        this.y = (this.canvas.height - this.zoom * height) / 2;
        this.isZoomed = false;
        if (draws) this.draw();
    }

    zoomAbout(x, y, factor) {
        const zoom = Math.min(Math.max(this.zoom * factor, 0.25), 256);
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

    draw() {
        if (!this.set || !this.a) return;
        const context = this.canvas.getContext("2d");
        context.setTransform(1, 0, 0, 1, 0, 0);
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

    writeNames(context) {
        const ratio = window.devicePixelRatio || 1;
        context.font = `${13 * ratio}px system-ui, sans-serif`;
        const write = (text, x, align) => {
            context.textAlign = align;
            context.lineWidth = 4 * ratio;
            context.strokeStyle = "#000000";
            context.fillStyle = "#ffffff";
            const room = this.canvas.width / (this.mode === "slider" ? 2.2 : 1);
            context.strokeText(text, x, 18 * ratio, room);
            context.fillText(text, x, 18 * ratio, room);
        };
        if (this.mode === "slider" || this.mode === "flip") {
            if (this.mode === "slider" || !this.showsB) write(`A: ${this.a.title}`, 8 * ratio, "left");
            if (this.mode === "slider" || this.showsB) write(`B: ${this.b.title}`, this.canvas.width - 8 * ratio, "right");
        }
    }

    /** In each pixel its values, where there is room for them. */
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
                const lines = this.map
                    ? [`${this.map.values[i]}`]
                    : this.mode === "ulps"
                      ? [`${this.differences.ulps[i]}`]
                      : this.mode === "difference"
                        ? [this.differences.absolute[i].toPrecision(3)]
                        : [0, 1, 2].map((c) => (isB ? this.b : this.a).planes[c * count + i].toPrecision(4));
                lines.forEach((text, line) => {
                    const place = [at + 5 * ratio, this.y + y * this.zoom + (16 + 14 * line) * ratio];
                    context.lineWidth = 3 * ratio;
                    context.strokeStyle = "#000000";
                    context.strokeText(text, ...place);
                    context.fillStyle = "#ffffff";
                    context.fillText(text, ...place);
                });
            }
    }

    /** Of the pixel at a place of the canvas. */
    tell(clientX, clientY) {
        const box = this.canvas.getBoundingClientRect();
        const x = Math.floor((((clientX - box.left) * this.canvas.width) / box.width - this.x) / this.zoom);
        const y = Math.floor((((clientY - box.top) * this.canvas.height) / box.height - this.y) / this.zoom);
        const { width, height, maps } = this.set;
        if (x < 0 || y < 0 || x >= width || y >= height) return;
        const i = y * width + x;
        const values = (picture) => [0, 1, 2].map((c) => picture.planes[c * width * height + i].toPrecision(9)).join("  ");
        const lines = [
            `pixel (${x}, ${y})`,
            `A ${values(this.a)}`,
            `B ${values(this.b)}`,
            `difference ${this.differences.absolute[i].toPrecision(4)}, ${this.differences.ulps[i].toLocaleString("en")} ulps`,
            ...maps.map((map) => `${map.title}: ${map.labels ? map.labels[map.values[i]] : map.values[i]}`),
        ];
        $("pixel").textContent = lines.join("\n");
    }

    listen() {
        const { canvas } = this;
        const fingers = new Map();
        const scale = () => canvas.width / canvas.getBoundingClientRect().width;
        const place = (event) => {
            const box = canvas.getBoundingClientRect();
            return [(event.clientX - box.left) * scale(), (event.clientY - box.top) * scale()];
        };
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            fingers.set(event.pointerId, event);
            this.tell(event.clientX, event.clientY);
        });
        canvas.addEventListener("pointermove", (event) => {
            const before = fingers.get(event.pointerId);
            if (before && fingers.size === 1) {
                this.x += (event.clientX - before.clientX) * scale();
                this.y += (event.clientY - before.clientY) * scale();
                this.isZoomed = true;
                this.draw();
            } else if (before) {
                const other = [...fingers.values()].find((each) => each.pointerId !== event.pointerId);
                const distance = (each) => Math.hypot(each.clientX - other.clientX, each.clientY - other.clientY);
                const [ax, ay] = place(event);
                const [bx, by] = place(other);
                if (distance(before) > 0) this.zoomAbout((ax + bx) / 2, (ay + by) / 2, distance(event) / distance(before));
            }
            if (before) fingers.set(event.pointerId, event);
            if (fingers.size <= 1) this.tell(event.clientX, event.clientY);
        });
        for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
        canvas.addEventListener(
            "wheel",
            (event) => {
                event.preventDefault();
                this.zoomAbout(...place(event), 2 ** (-event.deltaY / 300));
            },
            { passive: false },
        );
        canvas.addEventListener("keydown", (event) => {
            if (event.key === " ") {
                event.preventDefault();
                this.flip();
            }
        });
        for (const name of ["dragover", "drop"])
            window.addEventListener(name, (event) => {
                event.preventDefault();
                if (name === "drop") this.takeFiles(event.dataTransfer.files);
            });
    }

    /** The user's own pictures become a set, with those before them that are of their size. */
    async takeFiles(files) {
        const pictures = [];
        for (const file of files)
            try {
                pictures.push(await read(file));
            } catch {
                $("pixel").textContent = `${file.name} is neither PNG nor PFM`;
            }
        if (pictures.length === 0) return;
        const { width, height } = pictures[0];
        const kept = (this.own?.width === width && this.own.height === height ? this.own.pictures : []).filter(
            (each) => !pictures.some((other) => other.name === each.name),
        );
        const fitting = [...kept, ...pictures.filter((each) => each.width === width && each.height === height)];
        if (this.own) {
            this.sets.splice(this.sets.indexOf(this.own), 1);
            $("set").querySelector('[value=":own"]').remove();
        }
        this.own = { name: ":own", title: "your own", width, height, pictures: fitting, maps: [], ready: true };
        this.sets.push(this.own);
        $("set").append(new Option(this.own.title, ":own"));
        await this.open(":own", fitting.at(-2)?.name ?? fitting[0].name, fitting.at(-1).name);
        if (fitting.length < kept.length + pictures.length) $("pixel").textContent = `Left out what is not of ${width} x ${height} pixels.`;
    }
}
