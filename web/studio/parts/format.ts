// Figures as text.

const kMinuteS = 60;
const kHourS = 3600;
const kDayS = 86_400;

export function bytesText(bytes: number): string {
  const units = ["B", "kB", "MB", "GB", "TB"];
  let unit = 0;
  let value = bytes;
  while (value >= 1000 && unit < units.length - 1) {
    value /= 1000;
    ++unit;
  }
  return `${value >= 100 || unit === 0 ? Math.round(value) : value.toFixed(1)} ${units[unit]}`;
}

export function durationText(seconds: number): string {
  if (seconds < kMinuteS) return `${seconds < 10 ? Number(seconds.toFixed(1)) : Math.round(seconds)} s`;
  if (seconds < kHourS) return `${Math.floor(seconds / kMinuteS)} min ${Math.round(seconds % kMinuteS)} s`;
  if (seconds < kDayS) return `${Math.floor(seconds / kHourS)} h ${Math.floor((seconds % kHourS) / kMinuteS)} min`;
  return `${Math.floor(seconds / kDayS)} d ${Math.floor((seconds % kDayS) / kHourS)} h`;
}

export function agoText(time: string | null, nowMs = Date.now()): string {
  if (!time) return "";
  const seconds = Math.max(0, (nowMs - Date.parse(time)) / 1000);
  if (seconds < 5) return "just now";
  if (seconds < kMinuteS) return `${Math.round(seconds)} s ago`;
  if (seconds < kHourS) return `${Math.round(seconds / kMinuteS)} min ago`;
  if (seconds < kDayS) return `${Math.round(seconds / kHourS)} h ago`;
  return new Date(time).toLocaleDateString();
}

export function timeText(time: string | null): string {
  return time ? new Date(time).toLocaleString() : "";
}

export function countText(count: number, singular: string, plural = `${singular}s`): string {
  return `${count.toLocaleString("en-US")} ${count === 1 ? singular : plural}`;
}

/** Seconds between two times, up to now where the second is missing. */
export function secondsBetween(first: string | null, last: string | null): number {
  if (!first) return 0;
  return Math.max(0, ((last ? Date.parse(last) : Date.now()) - Date.parse(first)) / 1000);
}
