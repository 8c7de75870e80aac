// Charts over the floor plan: maps of values, and people's paths.
import { axis, colors, escaped, number } from "./charts.js";

const margin = { left: 62, right: 110, top: 36, bottom: 48 };
const MOST_HEIGHT = 760; // px, so that a whole map is seen at once

// Buildings and doors.
function plan({ buildings, exits }) {
  const outlines = {
    name: "buildings",
    type: "custom",
    clip: true,
    silent: true,
    z: 3,
    itemStyle: { color: "#9a9a9a" },
    data: buildings.map((_, i) => [i]),
    tooltip: { show: false },
    encode: { x: [], y: [] },
    renderItem: (params, api) => ({
      type: "polygon",
      shape: { points: buildings[params.dataIndex].map((corner) => api.coord(corner)) },
      style: { fill: "#9a9a9a", opacity: 0.85 },
    }),
  };
  const doors = (name, open, color) => ({
    name,
    type: "lines",
    coordinateSystem: "cartesian2d",
    clip: true,
    z: 4,
    itemStyle: { color },
    lineStyle: { color, width: 5, opacity: 1 },
    data: exits.filter((exit) => exit.open === open).map((exit) => ({ name: exit.id, coords: [exit.from, exit.to] })),
    tooltip: { formatter: ({ data }) => `${escaped(data.name)}, ${open ? "open" : "closed"}` },
  });
  return [outlines, doors("open exits", true, colors.green), doors("closed exits", false, colors.black)];
}

const legend = ({ buildings, exits }, names) => ({
  top: 4,
  left: margin.left,
  data: [
    ...names,
    ...(buildings.length ? ["buildings"] : []),
    ...(exits.some((exit) => exit.open) ? ["open exits"] : []),
    ...(exits.some((exit) => !exit.open) ? ["closed exits"] : []),
  ],
});

// A meter is as long in y as in x; Ctrl and the wheel zoom both.
function ground(place, series, more) {
  const [width, height] = [0, 1].map((i) => place.max[i] - place.min[i]);
  return {
    layout: (px) => {
      const scale = Math.min((px - margin.left - margin.right) / width, (MOST_HEIGHT - margin.top - margin.bottom) / height);
      const grid = { left: margin.left, top: margin.top, width: scale * width, height: scale * height };
      return { height: grid.height + margin.top + margin.bottom, width: grid.width + margin.left + margin.right, grid };
    },
    marks: series.reduce((sum, one) => sum + one.data.length, 0),
    option: {
      xAxis: axis("x (m)", { min: place.min[0], max: place.max[0], axisLine: { onZero: false } }),
      yAxis: axis("y (m)", { min: place.min[1], max: place.max[1], nameGap: 38, axisLine: { onZero: false } }),
      dataZoom: ["xAxisIndex", "yAxisIndex"].map((which) => ({ type: "inside", [which]: 0, zoomOnMouseWheel: "ctrl", filterMode: "none" })),
      legend: legend(place, []),
      tooltip: {},
      ...more,
      series: [...series, ...plan(place)],
    },
  };
}

export function map({ place, runs }, element) {
  const field = runs[Number(element.dataset.run)][element.dataset.field];
  const { cell_m: cell, columns, values, unit } = field;
  const most = values.reduce((a, b) => Math.max(a, b), 0);
  const data = [];
  values.forEach((value, i) => {
    if (value < 0.01 * most || value <= 0) return;
    data.push([place.min[0] + cell * (i % columns), place.min[1] + cell * Math.floor(i / columns), value]);
  });
  const tile = (_, api) => {
    const low = api.coord([api.value(0), api.value(1)]);
    const high = api.coord([api.value(0) + cell, api.value(1) + cell]);
    // A little over the edge, so that no seams show.
    return {
      type: "rect",
      shape: { x: low[0], y: high[1], width: high[0] - low[0] + 0.5, height: low[1] - high[1] + 0.5 },
      style: { fill: api.visual("color") },
    };
  };
  const tiles = {
    name: "values",
    type: "custom",
    clip: true,
    renderItem: tile,
    data,
    encode: { x: 0, y: 1 },
    tooltip: {
      formatter: ({ value }) =>
        `${number(value[2], 3)} ${unit}<br>at ${number(value[0] + cell / 2, 1)}, ${number(value[1] + cell / 2, 1)} m`,
    },
  };
  return ground(place, [tiles], {
    visualMap: {
      type: "continuous",
      min: 0,
      max: most || 1,
      dimension: 2,
      seriesIndex: 0,
      calculable: true,
      right: 4,
      top: "middle",
      precision: 2,
      text: [unit, ""],
      inRange: { color: ["#fff7bc", "#fec44f", "#f03b20", "#800026", "#2d0010"] },
    },
  });
}

export function paths({ place, runs }, element) {
  const walked = runs[Number(element.dataset.run)].paths;
  const series = {
    name: "paths",
    type: "lines",
    coordinateSystem: "cartesian2d",
    polyline: true,
    clip: true,
    z: 2,
    lineStyle: { color: colors.blue, width: 0.7, opacity: 0.35 },
    itemStyle: { color: colors.blue },
    emphasis: { lineStyle: { color: colors.vermilion, width: 2.5, opacity: 1 } },
    data: walked.map(({ agent, points }) => ({ name: `person ${agent}`, coords: points })),
    tooltip: { formatter: ({ data }) => data.name },
  };
  return ground(place, [series], {
    legend: legend(place, ["paths"]),
  });
}
