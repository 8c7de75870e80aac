// The part of the ground that a camera sees.

export interface View {
  x: number;
  y: number;
  height: number; ///< of the camera above the ground, m
  yawDeg: number; ///< counter-clockwise from +x
  pitchDeg: number; ///< above the horizon
  hfovDeg: number;
  aspect: number; ///< width / height of the image
}

type Vector = readonly [number, number, number];

const kMaxReach = 8; ///< heights; rays near the horizon end there

/**
 * Corners of the image on the ground z = 0, in meters, in the image's order from the top left. The camera is a pinhole:
 * x right, y down, z ahead.
 */
export function footprint(view: View): [number, number][] {
  const yaw = (view.yawDeg * Math.PI) / 180;
  const pitch = (view.pitchDeg * Math.PI) / 180;
  const ahead: Vector = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
  const right: Vector = [Math.sin(yaw), -Math.cos(yaw), 0];
  const up: Vector = [-Math.sin(pitch) * Math.cos(yaw), -Math.sin(pitch) * Math.sin(yaw), Math.cos(pitch)];
  const halfWidth = Math.tan((view.hfovDeg * Math.PI) / 360);
  const halfHeight = halfWidth / view.aspect;
  const signs = [
    [-1, 1],
    [1, 1],
    [1, -1],
    [-1, -1],
  ] as const;
  return signs.map(([sideways, vertical]) => {
    const ray = [0, 1, 2].map((i) => ahead[i]! + sideways * halfWidth * right[i]! + vertical * halfHeight * up[i]!);
    const [dx, dy, dz] = ray as [number, number, number];
    const reach = kMaxReach * view.height;
    const level = Math.hypot(dx, dy);
    const scale = dz < 0 ? Math.min(-view.height / dz, reach / Math.max(level, 1e-9)) : reach / Math.max(level, 1e-9);
    return [view.x + scale * dx, view.y + scale * dy];
  });
}
