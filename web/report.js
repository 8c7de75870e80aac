// Draws the charts of a report. The page holds their figures as JSON (#figures) and an element
// [data-chart] for each; tables and the choice of a run need no script. Curves and states are drawn by
// Studio's charts, maps and the diagram by ECharts.
import { draw } from "./charts.js";
import { fundamental } from "./fundamental.js";
import { map, paths } from "./ground.js";
import { drawReportChart, isReportChart } from "./studio/charts/report_charts";

const makers = { map, paths, fundamental };
const figures = JSON.parse(document.getElementById("figures").textContent);
const drawn = new Map();

const drawnIn = (element) => {
  const { chart } = element.dataset;
  return isReportChart(chart) ? drawReportChart(element, figures) : draw(element, makers[chart](figures, element));
};

// Those of a run that is not chosen have no width: they come when it is.
function drawVisible() {
  for (const element of document.querySelectorAll("[data-chart]")) {
    if (element.parentElement.clientWidth === 0) continue;
    const chart = drawn.get(element);
    if (chart) chart.resize();
    else drawn.set(element, drawnIn(element));
  }
}

const printing = (now) => () => {
  document.body.classList.toggle("printing", now);
  drawVisible();
  for (const chart of drawn.values()) chart.printing(now);
};

drawVisible();
document.addEventListener("change", drawVisible);
window.addEventListener("resize", drawVisible);
window.addEventListener("beforeprint", printing(true));
window.addEventListener("afterprint", printing(false));
