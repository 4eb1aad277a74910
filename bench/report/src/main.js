import { redraw } from "./chart.js";
import { showCharts } from "./charts.js";
import { showComparison } from "./compare.js";
import { showGallery } from "./gallery.js";

// Follows the system's light or dark theme until the user chooses one.
const root = document.documentElement;
const system = matchMedia("(prefers-color-scheme: dark)");
const wear = (theme) => {
    root.dataset.theme = theme;
    redraw();
};
wear(system.matches ? "dark" : "light");
system.addEventListener("change", () => wear(system.matches ? "dark" : "light"));
document.getElementById("theme").addEventListener("click", () => wear(root.dataset.theme === "dark" ? "light" : "dark"));

const data = JSON.parse(document.getElementById("data").textContent);
const reveal = (id, condition) => (document.getElementById(id).hidden = !condition);

document.getElementById("made").textContent = data.made;
const charts = data.charts;
reveal("failures", data.failures.length);
reveal("compare", data.sets.length);
reveal("speed", Object.values(charts).some((rows) => rows.length));

if (data.sets.length) {
    const open = showComparison(data.sets);
    showGallery(document.getElementById("gallery"), data.failures, data.sets, (set, picture) => {
        open(set, picture);
        document.getElementById("compare").scrollIntoView();
    });
}
for (const link of document.querySelectorAll("header a")) link.hidden = document.querySelector(link.hash).hidden;
showCharts(document.getElementById("charts"), charts, data.machines);
