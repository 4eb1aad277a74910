/** Translates touch, mouse, wheel and keys on a canvas to calls of moves(dx, dy), zooms(x, y, factor), points(x, y) and flips(). */
export function listen(canvas, { moves, zooms, points, flips }) {
    const fingers = new Map();
    const scale = () => canvas.width / canvas.getBoundingClientRect().width;
    const place = (event) => {
        const box = canvas.getBoundingClientRect();
        return [(event.clientX - box.left) * scale(), (event.clientY - box.top) * scale()];
    };
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, event);
        points(...place(event));
    });
    canvas.addEventListener("pointermove", (event) => {
        const before = fingers.get(event.pointerId);
        if (before && fingers.size === 1) moves((event.clientX - before.clientX) * scale(), (event.clientY - before.clientY) * scale());
        else if (before) {
            const other = [...fingers.values()].find((each) => each.pointerId !== event.pointerId);
            const distance = (each) => Math.hypot(each.clientX - other.clientX, each.clientY - other.clientY);
            const [ax, ay] = place(event);
            const [bx, by] = place(other);
            if (distance(before) > 0) zooms((ax + bx) / 2, (ay + by) / 2, distance(event) / distance(before));
        }
        if (before) fingers.set(event.pointerId, event);
        if (fingers.size <= 1) points(...place(event));
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener(
        "wheel",
        (event) => {
            event.preventDefault();
            zooms(...place(event), 2 ** (-event.deltaY / 300));
        },
        { passive: false },
    );
    const step = () => canvas.width / 16;
    const middle = () => [canvas.width / 2, canvas.height / 2];
    const keys = {
        " ": flips,
        "+": () => zooms(...middle(), 2),
        "-": () => zooms(...middle(), 0.5),
        ArrowLeft: () => moves(step(), 0),
        ArrowRight: () => moves(-step(), 0),
        ArrowUp: () => moves(0, step()),
        ArrowDown: () => moves(0, -step()),
    };
    canvas.addEventListener("keydown", (event) => {
        if (!keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
        points(...middle());
    });
}
