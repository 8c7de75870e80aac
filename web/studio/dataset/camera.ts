// Cameras of images (docs/formats.md): points of the world as pixels, through OpenCV's lenses.

export interface CameraRecord {
  K: [number[], number[], number[]];
  R: [number[], number[], number[]];
  t: [number, number, number];
  "centre": [number, number, number];
  model?: string;
  distortion?: Record<string, number>;
}

export type Point2 = [x: number, y: number];
export type Point3 = readonly [x: number, y: number, z: number];

// Lenses are used up to here off their axis, as they are rendered.
const kMaxAngle = (80 * Math.PI) / 180;
const kMinDepthM = 0.05;

interface Lens {
  /** Distance from the axis as shown, by the tangent of the angle from it. */
  radial: (r: number) => number;
  tangential: (x: number, y: number) => Point2;
}

function brown(k: (name: string) => number): Lens {
  const above = (s: number) => 1 + s * (k("k1") + s * (k("k2") + s * k("k3")));
  const below = (s: number) => 1 + s * (k("k4") + s * (k("k5") + s * k("k6")));
  return {
    radial: (r) => (r * above(r * r)) / below(r * r),
    tangential: (x, y) => [
      2 * k("p1") * x * y + k("p2") * (x * x + y * y + 2 * x * x),
      k("p1") * (x * x + y * y + 2 * y * y) + 2 * k("p2") * x * y,
    ],
  };
}

function fisheye(k: (name: string) => number): Lens {
  const scale = (s: number) => 1 + s * (k("k1") + s * (k("k2") + s * (k("k3") + s * k("k4"))));
  return { radial: (r) => Math.atan(r) * scale(Math.atan(r) ** 2), tangential: () => [0, 0] };
}

const kPinhole: Lens = { radial: (r) => r, tangential: () => [0, 0] };

function lensOf({ model = "pinhole", distortion = {} }: CameraRecord): Lens {
  const k = (name: string) => distortion[name] ?? 0;
  return model === "brown_conrady" ? brown(k) : model === "fisheye" ? fisheye(k) : kPinhole;
}

/** The tangent of the angle up to which the lens shows more the farther one looks from its axis. */
function limitOf({ radial }: Lens): number {
  const kSteps = 400;
  let last = 0;
  for (let step = 1; step <= kSteps; ++step) {
    const r = Math.tan((kMaxAngle * step) / kSteps);
    if (radial(r) <= last) return Math.tan((kMaxAngle * (step - 1)) / kSteps);
    last = radial(r);
  }
  return Math.tan(kMaxAngle);
}

/** Projects into box coordinates (pixel i covers [i, i + 1)); null behind the camera and where the lens shows nothing. */
export function projectionOf(camera: CameraRecord): (point: Point3) => Point2 | null {
  const { K, R, t } = camera;
  const lens = lensOf(camera);
  const isPinhole = lens === kPinhole;
  const limit = isPinhole ? Infinity : limitOf(lens);
  return (point) => {
    const [x, y, z] = R.map((row, axis) => row[0]! * point[0] + row[1]! * point[1] + row[2]! * point[2] + t[axis]!) as [
      number,
      number,
      number,
    ];
    if (z < kMinDepthM) return null;
    const [a, b] = [x / z, y / z];
    const r = Math.hypot(a, b);
    if (r > limit) return null;
    const scale = r < 1e-9 ? 1 : lens.radial(r) / r;
    const shift = lens.tangential(a, b);
    const [u, v] = [a * scale + shift[0], b * scale + shift[1]];
    return [K[0][0]! * u + K[0][1]! * v + K[0][2]! + 0.5, K[1][1]! * v + K[1][2]! + 0.5];
  };
}

/** Corners of a box: its middle, its size ahead, to the side and up, and where it faces. The first four are the lower ones. */
export function cornersOf([x, y, z, length, width, height]: readonly number[], heading: number): Point3[] {
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  return [-0.5, 0.5].flatMap((up) =>
    (
      [
        [0.5, 0.5],
        [0.5, -0.5],
        [-0.5, -0.5],
        [-0.5, 0.5],
      ] as const
    ).map(
      ([ahead, side]): Point3 => [
        x! + ahead * length! * cos - side * width! * sin,
        y! + ahead * length! * sin + side * width! * cos,
        z! + up * height!,
      ],
    ),
  );
}
