// The floor plan of a live flight: buildings, exits, people by what they do, drones with what their cameras look at.
import { useEffect, useRef } from "preact/hooks";
import type { Hello, World } from "./messages";
import { colorOfPerson, isShown } from "./people";

interface PlanViewProps {
  hello: Hello;
  world: { current: World | null };
  drone: number;
}

const kMargin = 0.12; // of the canvas
const kDotPx = 2.5; ///< smaller people are squares: thousands are drawn faster
const kDegree = Math.PI / 180;

interface Sheet {
  scale: number;
  toPx: (x: number, y: number) => [number, number];
}

/** The place between its exits, and the drones wherever they are. */
function sheetOf(hello: Hello, world: World | null, width: number, height: number): Sheet {
  const edges = hello.exits.length > 2 ? hello.exits.flatMap((exit) => [exit.from, exit.to]) : [hello.inside.min, hello.inside.max];
  const places = [...edges, ...(world?.drones ?? []).map((drone) => drone.position)];
  const [left, right] = [Math.min(...places.map((place) => place[0]!)), Math.max(...places.map((place) => place[0]!))];
  const [bottom, top] = [Math.min(...places.map((place) => place[1]!)), Math.max(...places.map((place) => place[1]!))];
  const scale = Math.min(width / (right - left), height / (top - bottom)) * (1 - 2 * kMargin);
  const [x0, y0] = [(width - (right - left) * scale) / 2, (height - (top - bottom) * scale) / 2];
  return { scale, toPx: (x, y) => [x0 + (x - left) * scale, y0 + (top - y) * scale] };
}

function polygon(context: CanvasRenderingContext2D, sheet: Sheet, points: [number, number][]): void {
  context.beginPath();
  points.forEach(([x, y], index) => (index === 0 ? context.moveTo(...sheet.toPx(x, y)) : context.lineTo(...sheet.toPx(x, y))));
  context.closePath();
}

function drawScenario(context: CanvasRenderingContext2D, sheet: Sheet, hello: Hello): void {
  context.fillStyle = "#e6e8e6";
  context.fillRect(0, 0, context.canvas.width, context.canvas.height);
  context.fillStyle = "#9aa5ab";
  context.strokeStyle = "#5d6970";
  for (const building of hello.buildings) {
    polygon(context, sheet, building.footprint);
    context.fill();
    context.stroke();
  }
  context.lineWidth = 4;
  for (const exit of hello.exits) {
    context.strokeStyle = exit.open ? "#1d6b3a" : "#b3261e";
    context.beginPath();
    context.moveTo(...sheet.toPx(...exit.from));
    context.lineTo(...sheet.toPx(...exit.to));
    context.stroke();
  }
  context.lineWidth = 1;
}

function drawPeople(context: CanvasRenderingContext2D, sheet: Sheet, hello: Hello, { people }: World): void {
  const radius = Math.max(1.6, 0.3 * sheet.scale);
  for (let index = 0; index < people.x.length; ++index) {
    if (!isShown(hello, people, index)) continue;
    context.fillStyle = colorOfPerson(hello, people, index);
    const [x, y] = sheet.toPx(people.x[index]!, people.y[index]!);
    if (radius < kDotPx) {
      context.fillRect(x - radius, y - radius, 2 * radius, 2 * radius);
      continue;
    }
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
  }
}

function drawDrones(context: CanvasRenderingContext2D, sheet: Sheet, hello: Hello, world: World, flown: number): void {
  world.drones.forEach((drone, index) => {
    const { camera, id } = hello.drones[index]!;
    const [x, y] = sheet.toPx(drone.position[0], drone.position[1]);
    const yaw = drone.yaw + drone.gimbalDeg[1] * kDegree;
    const half = (camera.hfov_deg / 2) * kDegree;
    const reach = Math.min(40, Math.max(8, drone.position[2] / Math.tan(Math.max(0.3, -drone.gimbalDeg[0] * kDegree)))) * sheet.scale;
    context.fillStyle = index === flown ? "#0b647544" : "#5d697033";
    context.beginPath();
    context.moveTo(x, y);
    context.arc(x, y, reach, -yaw - half, -yaw + half);
    context.fill();
    context.fillStyle = drone.isRunning ? (index === flown ? "#0b6475" : "#1a2328") : "#b3261e";
    context.beginPath();
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.fill();
    if (drone.hasBeacon) {
      context.strokeStyle = "#d98200";
      context.lineWidth = 3;
      context.beginPath();
      context.arc(x, y, 11, 0, 2 * Math.PI);
      context.stroke();
      context.lineWidth = 1;
    }
    context.font = "600 13px system-ui, sans-serif";
    context.lineWidth = 3;
    context.strokeStyle = "#fff";
    context.strokeText(id, x + 13, y + 5);
    context.fillStyle = "#1a2328";
    context.fillText(id, x + 13, y + 5);
    context.lineWidth = 1;
  });
}

export function PlanView({ hello, world, drone }: PlanViewProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    let frame = 0;
    let drawn: World | null = null;
    const draw = () => {
      frame = requestAnimationFrame(draw);
      const element = canvas.current;
      const context = element?.getContext("2d");
      if (!element || !context || element.clientWidth === 0) return;
      const ratio = Math.min(2, devicePixelRatio);
      const [width, height] = [Math.round(element.clientWidth * ratio), Math.round(element.clientHeight * ratio)];
      const isResized = element.width !== width || element.height !== height;
      if (!isResized && drawn === world.current && drawn) return;
      drawn = world.current;
      if (isResized) [element.width, element.height] = [width, height];
      const sheet = sheetOf(hello, world.current, width, height);
      drawScenario(context, sheet, hello);
      if (!world.current) return;
      drawPeople(context, sheet, hello, world.current);
      drawDrones(context, sheet, hello, world.current, drone);
    };
    frame = requestAnimationFrame(draw);
    return () => cancelAnimationFrame(frame);
  }, [hello, drone]);
  return <canvas ref={canvas} class="fly-canvas" role="img" aria-label="Floor plan with people and drones" />;
}
