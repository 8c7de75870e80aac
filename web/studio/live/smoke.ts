// Smoke and flames above a flight's dangers: soft discs that rise, widen and thin out, placed by the vertex shader. The
// renderer's own (render/passes/smoke_pass.h) is what the drone's camera shows.
import * as THREE from "three";
import type { Danger, Hello } from "./messages";

const kPuffs = 48;
const kFlames = 16;

const kVertex = /* glsl */ `
attribute vec4 aSeed;
uniform float uTime, uAge, uReach, uStrength, uRise, uLife;
uniform vec3 uTone;
varying vec2 vAt;
varying vec4 vLook;
void main() {
  bool isFlame = aSeed.w > 1.0;
  float life = isFlame ? 1.1 : uLife;
  float share = fract(uTime / life + aSeed.x);
  float age = life * share;
  float out_m = uReach * sqrt(aSeed.z) * (isFlame ? 0.6 * (1.0 - 0.5 * share) : 1.0) + (isFlame ? 0.0 : 0.1 * age);
  vec2 drift = isFlame ? vec2(0.0) : vec2(0.5, 0.2) * age;
  vec3 place = vec3(out_m * vec2(cos(aSeed.y), sin(aSeed.y)) + drift, isFlame ? 0.2 + (1.2 + 0.5 * uReach) * share : 0.6 + uRise * age);
  float radius = isFlame ? (0.22 + 0.16 * uReach) * (1.1 - 0.8 * share) : (0.55 + 0.2 * age) * (1.0 + 0.12 * uReach);
  vAt = position.xy;
  float thins = isFlame ? 0.6 * (1.0 - share) : 0.6 * min(age / 1.5, 1.0) * pow(1.0 - share, 1.3);
  vLook = vec4(isFlame ? vec3(1.0, 0.75 - 0.55 * share, 0.1) : uTone * (0.7 + 0.6 * aSeed.w), age > uAge ? 0.0 : uStrength * thins);
  vec4 center = modelViewMatrix * vec4(place, 1.0);
  gl_Position = projectionMatrix * (center + vec4(radius * position.xy, 0.0, 0.0));
}`;

const kFragment = /* glsl */ `
varying vec2 vAt;
varying vec4 vLook;
void main() {
  float opacity = vLook.a * (1.0 - smoothstep(0.2, 1.0, length(vAt)));
  if (opacity < 0.01) discard;
  gl_FragColor = vec4(vLook.rgb, opacity);
}`;

/** From 0 to 1, always the same for a number. */
const scattered = (number: number) => {
  const value = Math.sin(number * 12.9898) * 43758.5453;
  return value - Math.floor(value);
};

function puffsOf(hasFlames: boolean): any {
  const geometry = new THREE.InstancedBufferGeometry();
  const square = new THREE.PlaneGeometry(2, 2);
  geometry.setIndex(square.index);
  geometry.setAttribute("position", square.attributes.position);
  const count = kPuffs + (hasFlames ? kFlames : 0);
  const seeds = Array.from({ length: count }, (_, i) => [
    scattered(4 * i),
    2 * Math.PI * scattered(4 * i + 1),
    scattered(4 * i + 2),
    i < kPuffs ? scattered(4 * i + 3) : 2,
  ]);
  geometry.setAttribute("aSeed", new THREE.InstancedBufferAttribute(new Float32Array(seeds.flat()), 4));
  geometry.instanceCount = count;
  return geometry;
}

const kTones: Partial<Record<Danger["kind"], number[]>> = { gas: [0.42, 0.45, 0.2], collapse: [0.4, 0.37, 0.33] };
const kRises: Partial<Record<Danger["kind"], number>> = { gas: 0.15, collapse: 0.4 };

/** How far a danger reaches at a time, in m; 0 before it begins. */
export const reachOf = (danger: Danger, timeS: number) =>
  timeS < danger.start_s
    ? 0
    : Math.min(Math.max(danger.radius_m, danger.max_radius_m), danger.radius_m + danger.growth_mps * (timeS - danger.start_s));

export class Smoke {
  readonly group = new THREE.Group();
  private readonly sources: { danger: Danger; mesh: any }[] = [];

  constructor(hello: Hello) {
    if (!hello.smoke) return;
    for (const danger of hello.dangers ?? []) {
      const isFire = danger.kind === "fire" || danger.kind === "explosion";
      const uniforms = {
        uTime: { value: 0 },
        uAge: { value: 0 },
        uReach: { value: 0 },
        uStrength: { value: hello.smoke },
        uRise: { value: kRises[danger.kind] ?? 1 },
        uLife: { value: 14 },
        uTone: { value: kTones[danger.kind] ?? [0.16, 0.15, 0.15] },
      };
      const material = new THREE.ShaderMaterial({
        uniforms,
        vertexShader: kVertex,
        fragmentShader: kFragment,
        transparent: true,
        depthWrite: false,
      });
      const mesh = new THREE.Mesh(puffsOf(isFire), material);
      mesh.position.set(danger.position[0], danger.position[1], 0);
      mesh.frustumCulled = false;
      mesh.renderOrder = 1;
      this.sources.push({ danger, mesh });
      this.group.add(mesh);
    }
  }

  frame(timeS: number): void {
    for (const { danger, mesh } of this.sources) {
      mesh.visible = timeS >= danger.start_s;
      const { uTime, uAge, uReach } = mesh.material.uniforms;
      uTime.value = timeS;
      uAge.value = timeS - danger.start_s;
      uReach.value = reachOf(danger, timeS);
    }
  }
}
