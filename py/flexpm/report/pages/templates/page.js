"use strict";
// Charts by Chart.js, and sliders that show and hide the cracks and colour the fragments of a map.
const charts = {};
const axis = (title, position, grid) => ({
    type: "linear", position, title: { display: true, text: title }, grid: { drawOnChartArea: grid }, min: undefined,
});

function draw(chart) {
    const options = {
        animation: false,
        maintainAspectRatio: false,
        interaction: { mode: chart.shared ? "index" : "nearest", axis: "xy", intersect: false },
        scales: { x: axis(chart.x, "bottom", true), y: axis(chart.y, "left", true) },
        plugins: {
            legend: { labels: { boxHeight: 1 } },
            tooltip: { callbacks: {
                title: (items) => items.length ? `${chart.x}: ${items[0].parsed.x}` : "",
                label: (item) => `${item.dataset.label}: ${item.parsed.y}`,
            } },
        },
    };
    if (chart.y2) options.scales.y2 = axis(chart.y2, "right", false);
    const datasets = chart.lines.map((line) => ({
        label: line.label,
        data: line.x.map((x, i) => ({ x, y: line.y[i] })),
        showLine: true,
        borderColor: line.colour,
        backgroundColor: line.colour,
        borderWidth: 1.6,
        borderDash: line.dashed ? [6, 4] : [],
        yAxisID: line.axis,
        marked: new Set(line.marks),
        pointRadius: (point) => point.dataset.marked.has(point.dataIndex) ? 5 : point.dataset.now === point.dataIndex ? 7 : 0,
        pointHitRadius: 4,
    }));
    charts[chart.name] = new Chart(document.getElementById(chart.name), { type: "scatter", data: { datasets }, options });
}

function slide(map) {
    const slider = document.getElementById(`${map.name}-slider`);
    const text = document.getElementById(`${map.name}-text`);
    const cracks = [...document.querySelectorAll(`#${map.name}-cracks [data-at]`)];
    const grains = [...document.querySelectorAll(`#${map.name}-fragments path`)];
    const show = () => {
        const now = Number(slider.value);
        text.textContent = map.texts[now];
        for (const crack of cracks) crack.style.display = Number(crack.dataset.at) <= now ? "" : "none";
        grains.forEach((grain, i) => grain.setAttribute("class", `f${map.fragments[now][i]}`));
        const chart = charts[map.chart];
        if (chart) {
            chart.data.datasets[0].now = map.rows[now];
            chart.update("none");
        }
    };
    slider.addEventListener("input", show);
    show();
}

if (window.Chart) drawn.charts.forEach(draw);
drawn.maps.forEach(slide);
