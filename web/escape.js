// How many have escaped by when: of several runs with median and quartiles, or of a study's policies.
import { axis, colors, escaped, number, timeZoom } from './charts.js';

const layout = (names) => ({
  grid: { left: 62, right: 24, top: 56, bottom: 76 },
  legend: { top: 22, data: names, type: 'scroll' },
  xAxis: axis('time from the later of alarm and arrival (s)', { min: 0, max: 'dataMax' }),
  yAxis: axis('share of the people (%)', { min: 0, max: 100, nameGap: 38 }),
  dataZoom: timeZoom(),
});

const line = (name, share, color, more) => ({
  name, type: 'line', showSymbol: false, data: share.map((value, second) => [second, value]),
  lineStyle: { color: color, width: 2 }, itemStyle: { color: color }, ...more,
});

// The area between two curves, as one polygon.
const band = (name, low, high, color) => ({
  name, type: 'custom', clip: true, silent: true, itemStyle: { color: color }, z: 1, data: [[0, 0]],
  tooltip: { show: false },
  renderItem: (_, api) => ({
    type: 'polygon',
    shape: {
      points: [...high.map((value, second) => api.coord([second, value])),
        ...low.map((value, second) => api.coord([second, value])).reverse()],
    },
    style: { fill: color, opacity: 0.35 },
  }),
});

export function escapeOfRuns({ escape }) {
  const { runs, median, low, high } = escape;
  const several = runs.length > 1;
  const series = several ? [band('quartiles', low, high, colors.sky)] : [];
  if (several) {
    for (const run of runs) {
      series.push(line('runs', run.share, colors.gray, { lineStyle: { color: colors.gray, width: 0.8, opacity: 0.7 }, silent: true }));
    }
  }
  series.push(line(several ? 'median' : runs[0].name, median, colors.blue, { z: 3, lineStyle: { color: colors.blue, width: 2.5 } }));
  const tooltipText = ([point]) => {
    const second = Math.round(point.axisValue);
    const at = (curve) => `${number(curve[Math.min(second, curve.length - 1)], 1)} %`;
    if (!several) return `${second} s: ${at(median)}`;
    return `${second} s<br>median ${at(median)}<br>quartiles ${at(low)} to ${at(high)}`;
  };
  const names = several ? ['median', 'quartiles', 'runs'] : [runs[0].name];
  return {
    layout: () => ({ height: 400 }),
    option: { ...layout(names), tooltip: { trigger: 'axis', formatter: tooltipText }, series },
  };
}

export function escapeOfPolicies({ cases }, element) {
  const { curves } = cases[Number(element.dataset.case)];
  const order = ['gray', 'orange', 'sky', 'green', 'vermilion', 'blue', 'pink', 'black'];
  // Dashes tell curves apart once the colors come again.
  const series = curves.map(({ name, share }, i) => line(name, share, colors[order[i % order.length]], {
    lineStyle: { color: colors[order[i % order.length]], width: 2, type: i < order.length ? 'solid' : 'dashed' },
  }));
  const tooltipText = (points) => [`${Math.round(points[0].axisValue)} s`,
    ...points.map((point) => `${point.marker}${escaped(point.seriesName)} ${number(point.value[1], 1)} %`)].join('<br>');
  return {
    layout: () => ({ height: 420 }),
    option: {
      ...layout(curves.map((curve) => curve.name)),
      xAxis: axis('time since the alarm (s)', { min: 0, max: 'dataMax' }),
      tooltip: { trigger: 'axis', formatter: tooltipText },
      series,
    },
  };
}
