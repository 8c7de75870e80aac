// The state of each exit over time.
import { axis, colors, escaped, number, timeZoom } from './charts.js';

const states = ['idle', 'flowing', 'congested', 'clogged', 'closed'];
const shades = [colors.pale, colors.green, colors.orange, colors.vermilion, colors.black];

export function timeline({ runs }, element) {
  const { exits, duration_s: end } = runs[Number(element.dataset.run)];
  const bar = (params, api) => {
    const [from, until, row] = [api.value(0), api.value(1), api.value(2)];
    const start = api.coord([from, row]);
    const stop = api.coord([until, row]);
    const thickness = api.size([0, 1])[1] * 0.7;
    const { x, y, width, height } = params.coordSys;
    // Content outside the zoomed range is clipped.
    const left = Math.max(start[0], x);
    const right = Math.min(stop[0], x + width);
    if (right <= left) return null;
    const top = Math.max(start[1] - thickness / 2, y);
    return {
      type: 'rect',
      shape: { x: left, y: top, width: right - left, height: Math.min(thickness, y + height - top) },
      style: { fill: api.visual('color') },
    };
  };
  const series = states.map((name, state) => ({
    name, type: 'custom', renderItem: bar, itemStyle: { color: shades[state] }, encode: { x: [0, 1], y: 2 },
    data: exits.flatMap((exit, row) => exit.states.filter((span) => span[2] === state).map((span) => [span[0], span[1], row])),
  }));
  const tooltipText = ({ seriesName, value, marker }) =>
    `${marker}${escaped(exits[value[2]].id)} ${seriesName}<br>${number(value[0], 1)} to ${number(value[1], 1)} s`;
  const longest = exits.reduce((most, exit) => Math.max(most, exit.id.length), 0);
  return {
    layout: () => ({ height: 130 + 34 * exits.length }),
    option: {
      grid: { left: Math.min(180, 30 + 7 * longest), right: 24, top: 56, bottom: 76 },
      legend: { top: 22, data: states },
      tooltip: { formatter: tooltipText },
      xAxis: axis('time (s)', { min: 0, max: end }),
      yAxis: { type: 'category', data: exits.map((exit) => exit.id), inverse: true },
      dataZoom: timeZoom(),
      series,
    },
  };
}
