// Images: linear float RGB, one plane after the other, rows from the top down.

/** Unpacks a set of the page's data, { name, title, width, height, pictures, maps }, and returns it. Sets the planes of its images. */
export async function unpack(set) {
    if (set.ready) return set;
    const count = set.width * set.height;
    for (const picture of set.pictures) {
        if (picture.planes) continue;
        const bytes = await inflate(picture.data);
        const words = new Uint32Array(3 * count);
        for (let plane = 0; plane < 4; ++plane)
            for (let i = 0; i < words.length; ++i) words[i] |= bytes[plane * words.length + i] << (8 * plane);
        if (picture.base !== null) {
            const base = set.pictures[picture.base].planes;
            const others = new Uint32Array(base.buffer, base.byteOffset, base.length);
            for (let i = 0; i < words.length; ++i) words[i] ^= others[i];
        }
        picture.planes = new Float32Array(words.buffer);
        delete picture.data;
    }
    for (const map of set.maps)
        if (!map.values) {
            const bytes = await inflate(map.data);
            map.values = new Uint16Array(bytes.buffer, 0, count);
            delete map.data;
        }
    set.ready = true;
    return set;
}

async function inflate(base64) {
    const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

function encoded(linear) {
    const x = Math.min(Math.max(linear, 0), 1);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

function decoded(value) {
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

/** Returns an image as RGBA bytes, brightened by a number of stops. */
export function shown(set, picture, stops = 0) {
    const count = set.width * set.height;
    const image = new ImageData(set.width, set.height);
    const factor = 2 ** stops;
    // NaN becomes black.
    for (let i = 0; i < count; ++i) {
        for (let c = 0; c < 3; ++c)
            image.data[4 * i + c] = Math.round(255 * encoded(factor * picture.planes[c * count + i]));
        image.data[4 * i + 3] = 255;
    }
    return image;
}

const word = new Uint32Array(1);
const real = new Float32Array(word.buffer);

/** Maps floats to ordered integers, whose distance is in ulps. */
function order(value) {
    real[0] = value;
    return word[0] & 0x80000000 ? -(word[0] & 0x7fffffff) : word[0];
}

/**
 * Returns for each pixel the largest difference of its three components, the same in ulps, and 1 if all bits are
 * identical. If a component is NaN or infinite, the difference is NaN. The largest difference and the mean omit NaN.
 */
export function differences(set, a, b) {
    const count = set.width * set.height;
    const [absolute, ulps, isSame] = [new Float64Array(count), new Float64Array(count), new Uint8Array(count).fill(1)];
    const [wordsA, wordsB] = [a, b].map(({ planes }) => new Uint32Array(planes.buffer, planes.byteOffset, planes.length));
    let squares = 0;
    for (let c = 0; c < 3; ++c)
        for (let pixel = 0, i = c * count; pixel < count; ++pixel, ++i) {
            if (wordsA[i] === wordsB[i]) continue;
            isSame[pixel] = 0;
            const difference = Math.abs(a.planes[i] - b.planes[i]);
            if (!Number.isFinite(difference)) {
                absolute[pixel] = ulps[pixel] = NaN;
                continue;
            }
            squares += difference * difference;
            if (difference > absolute[pixel]) absolute[pixel] = difference;
            const apart = Math.abs(order(a.planes[i]) - order(b.planes[i]));
            if (apart > ulps[pixel]) ulps[pixel] = apart;
        }
    const numberless = absolute.reduce((sum, each) => sum + (Number.isNaN(each) ? 1 : 0), 0);
    return { absolute, ulps, isSame, numberless, rmse: Math.sqrt(squares / (3 * count)) };
}

/** Reads a user's file. Returns an image with its size. */
export async function read(file) {
    const picture = file.name.toLowerCase().endsWith(".pfm") ? pfm(await file.arrayBuffer()) : await png(file);
    return { ...picture, name: file.name, title: file.name };
}

async function png(file) {
    const bitmap = await createImageBitmap(file, { colorSpaceConversion: "none", premultiplyAlpha: "none" });
    const canvas = document.createElement("canvas");
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    const count = canvas.width * canvas.height;
    const planes = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i)
        for (let c = 0; c < 3; ++c) planes[c * count + i] = decoded(data[4 * i + c] / 255);
    return { width: canvas.width, height: canvas.height, planes };
}

function pfm(buffer) {
    const bytes = new Uint8Array(buffer);
    const words = [];
    let at = 0;
    while (words.length < 4) {
        let text = "";
        while (at < bytes.length && !/\s/.test(String.fromCharCode(bytes[at]))) text += String.fromCharCode(bytes[at++]);
        if (at++ >= bytes.length) throw new Error("expected a PFM file");
        if (text) words.push(text);
    }
    const [magic, width, height, scale] = [words[0], ...words.slice(1).map(Number)];
    const channels = { PF: 3, Pf: 1 }[magic];
    const count = width * height;
    if (!channels || ![width, height].every((each) => Number.isInteger(each) && each >= 1) || bytes.length - at < 4 * channels * count) throw new Error("expected a PFM file");
    const view = new DataView(buffer, at);
    const planes = new Float32Array(3 * count);
    for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x)
            for (let c = 0; c < 3; ++c) {
                const from = ((height - 1 - y) * width + x) * channels + (channels === 3 ? c : 0);
                planes[c * count + y * width + x] = view.getFloat32(4 * from, scale < 0);
            }
    return { width, height, planes };
}
