// How a study's result settles as runs are added: the mean of a time over the first runs, with its interval.
import { axis, colors, escaped, number } from './charts.js';

const order = ['blue', 'orange', 'green', 'vermilion', 'pink', 'sky', 'gray', 'black'];
const FIRST_COUNT = 2; // runs; of one there is no interval

// Numbers where all are known: a run in which somebody never gets out has no time.
const pointsOf = (values) => values.map((value, i) => [i + FIRST_COUNT, value]);

const mean = ({ name, mean_s }, color) => ({
  name, type: 'line', showSymbol: mean_s.length < 3, data: pointsOf(mean_s),
  lineStyle: { color, width: 2 }, itemStyle: { color },
});

const end = ({ name }, values, color) => ({
  name, type: 'line', showSymbol: false, data: pointsOf(values), silent: true, tooltip: { show: false },
  lineStyle: { color, width: 1, type: 'dashed' }, itemStyle: { color },
});

export function convergenceOfPolicies({ cases }, element) {
  const { convergence } = cases[Number(element.dataset.case)];
  const series = convergence.flatMap((curve, i) => {
    const color = colors[order[i % order.length]];
    return [mean(curve, color), end(curve, curve.low_s, color), end(curve, curve.high_s, color)];
  });
  const tooltipText = (points) => {
    const count = points[0].axisValue;
    const lines = convergence.map(({ name, mean_s, low_s, high_s }) => {
      const i = count - FIRST_COUNT;
      return `${escaped(name)} ${number(mean_s[i], 1)} s [${number(low_s[i], 1)}, ${number(high_s[i], 1)}]`;
    });
    return [`${count} runs`, ...lines].join('<br>');
  };
  // The intervals of the first few runs would leave no room for the rest.
  const shown = convergence.flatMap(({ low_s, high_s }) =>
    [...low_s.slice(Math.min(2, low_s.length - 1)), ...high_s.slice(Math.min(2, high_s.length - 1))]).filter(Number.isFinite);
  const limits = shown.length ? { min: Math.floor(Math.min(...shown)), max: Math.ceil(Math.max(...shown)) } : {};
  return {
    layout: () => ({ height: 340 }),
    option: {
      grid: { left: 62, right: 24, top: 56, bottom: 48 },
      legend: { top: 22, data: convergence.map((curve) => curve.name), type: 'scroll' },
      xAxis: axis('number of runs', { min: FIRST_COUNT, max: 'dataMax', minInterval: 1 }),
      yAxis: axis('time (s)', { nameGap: 38, axisLabel: { showMinLabel: false, showMaxLabel: false }, ...limits }),
      tooltip: { trigger: 'axis', formatter: tooltipText },
      series,
    },
  };
}
