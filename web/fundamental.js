// Speed over density: everybody's samples, their medians and Weidmann's curve.
import { axis, colors, number } from "./charts.js";

// 1993, Schriftenreihe des IVT 90: m/s for people per m².
const weidmann = (density) => 1.34 * (1 - Math.exp(-1.913 * (1 / density - 1 / 5.4)));

export function fundamental({ runs }, element) {
  const { samples, bins } = runs[Number(element.dataset.run)].fundamental;
  const curve = [];
  for (let density = 0.05; density <= 5.4; density += 0.05) curve.push([density, weidmann(density)]);
  const fastest = samples.reduce((most, sample) => Math.max(most, sample[1]), 1.5);
  const people = "people, each 1 s";
  return {
    layout: () => ({ height: 420 }),
    marks: samples.length,
    option: {
      grid: { left: 62, right: 24, top: 56, bottom: 52 },
      legend: { top: 22, data: [people, "median", "Weidmann 1993"] },
      tooltip: {
        formatter: ({ seriesName, value }) =>
          `${seriesName}<br>${number(value[0])} /m², ${number(value[1])} m/s${
            value.length > 2 ? `<br>${value[2]} samples, quartiles ${number(value[3])} to ${number(value[4])} m/s` : ""
          }`,
      },
      xAxis: axis("Voronoi density of each person (1/m²)", { min: 0, max: 6 }),
      yAxis: axis("speed (m/s)", { min: 0, max: Math.ceil(2 * fastest) / 2, nameGap: 38 }),
      dataZoom: ["xAxisIndex", "yAxisIndex"].map((which) => ({ type: "inside", [which]: 0, zoomOnMouseWheel: "ctrl", filterMode: "none" })),
      series: [
        { name: people, type: "scatter", data: samples, symbolSize: 3, progressive: 0, itemStyle: { color: colors.blue, opacity: 0.3 } },
        {
          name: "median",
          type: "line",
          data: bins,
          symbolSize: 7,
          lineStyle: { color: colors.black, width: 1.5 },
          itemStyle: { color: colors.black },
          z: 4,
        },
        {
          name: "Weidmann 1993",
          type: "line",
          data: curve,
          showSymbol: false,
          lineStyle: { color: colors.vermilion, width: 2 },
          itemStyle: { color: colors.vermilion },
          z: 3,
        },
      ],
    },
  };
}
