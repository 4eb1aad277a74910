import { redraw } from "./chart.js";
import { showCharts } from "./charts.js";
import { Viewer } from "./compare.js";
import { showGallery } from "./gallery.js";

const data = JSON.parse(document.getElementById("data").textContent);
const reveal = (id, condition) => (document.getElementById(id).hidden = !condition);

document.getElementById("made").textContent = data.made;
const charts = data.charts;
reveal("failures", data.failures.length);
reveal("compare", data.sets.length);
reveal("speed", Object.values(charts).some((rows) => rows.length));

if (data.sets.length) {
    const viewer = new Viewer(data.sets);
    viewer.open(data.sets[0].name);
    showGallery(document.getElementById("gallery"), data.failures, data.sets, async (set, picture) => {
        await viewer.open(set, picture, "exact");
        document.getElementById("compare").scrollIntoView({ behavior: "smooth" });
    });
}
showCharts(document.getElementById("charts"), charts);

document.getElementById("theme").addEventListener("click", () => {
    const root = document.documentElement;
    const isDark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = isDark ? "light" : "dark";
    redraw();
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
