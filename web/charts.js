// The chart library with what reports use of it, and what all charts share.

import { CustomChart, LineChart, LinesChart, ScatterChart } from "echarts/charts";
import {
  AriaComponent,
  DataZoomInsideComponent,
  GridComponent,
  LegendComponent,
  ToolboxComponent,
  TooltipComponent,
  VisualMapContinuousComponent,
} from "echarts/components";
import * as echarts from "echarts/core";
import { CanvasRenderer, SVGRenderer } from "echarts/renderers";

echarts.use([
  AriaComponent,
  CanvasRenderer,
  CustomChart,
  DataZoomInsideComponent,
  GridComponent,
  LegendComponent,
  LineChart,
  LinesChart,
  ScatterChart,
  SVGRenderer,
  ToolboxComponent,
  TooltipComponent,
  VisualMapContinuousComponent,
]);

// Colors that people with any kind of color vision can tell apart (Okabe and Ito 2008).
export const colors = {
  black: "#000000",
  blue: "#0072B2",
  green: "#009E73",
  gray: "#8a8a8a",
  orange: "#E69F00",
  pale: "#e4e4e4",
  pink: "#CC79A7",
  sky: "#56B4E9",
  vermilion: "#D55E00",
};

// A browser draws as many marks as SVG, which stays sharp in print; more are pixels.
const MOST_SVG_MARKS = 5000;

// Width of A4 between usual margins, in px: during the layout for print, elements still report
// their width on the screen.
const PAPER_WIDTH = 690;

export const axis = (name, more) => ({
  type: "value",
  name,
  nameLocation: "middle",
  nameGap: 28,
  splitLine: { lineStyle: { color: "#e6e6e6" } },
  ...more,
});

// Text of somebody's file, which tooltips would take for markup.
export const escaped = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

export const number = (value, digits = 2) => (Number.isFinite(value) ? value.toFixed(digits) : "none");

// Makes the chart in an element; `layout` gives its height in px for a width, and its grid and the
// width that it takes if those depend on it. Returns what to call when the page's width changes and around printing.
export function draw(element, { option, marks = 0, layout }) {
  let paper = false;
  const place = () => {
    const room = paper ? PAPER_WIDTH : element.parentElement.clientWidth;
    const { height, width, grid } = layout(room);
    element.style.width = width || paper ? `${Math.round(width ?? room)}px` : "";
    element.style.height = `${Math.round(height)}px`;
    return grid ? { grid } : {};
  };
  const placed = place();
  const renderer = marks > MOST_SVG_MARKS ? "canvas" : "svg";
  const chart = echarts.init(element, null, { renderer, devicePixelRatio: Math.max(2, window.devicePixelRatio) });
  chart.setOption({
    animation: false,
    aria: { enabled: true },
    textStyle: { fontFamily: "sans-serif" },
    toolbox: { right: 8, top: 0, itemSize: 13, feature: { restore: {}, saveAsImage: { name: element.dataset.chart } } },
    ...option,
    ...placed,
  });
  return {
    resize() {
      const changed = place();
      chart.resize();
      chart.setOption(changed);
    },
    // On paper nobody zooms or saves; and it does not wait for the next frame.
    printing(now) {
      paper = now;
      this.resize();
      chart.setOption({ toolbox: { show: !now } });
      chart.getZr().flush();
    },
  };
}
