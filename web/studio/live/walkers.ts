// People of a flight in space. Each step of the simulation is sent to the graphics card once; between two steps the vertex
// shader moves everybody, swings their legs by the way that they have walked, and lays down people who have fallen.
import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { type Hello, kFallen, type World } from "./messages";
import { colorOfPerson, isShown } from "./people";

const kFloats = 4;
const kCycleM = 1.4; ///< walked with two steps
const kStrollMps = 1.2; ///< from this speed on legs swing in full
const kFewPeople = 1000; ///< all of them have legs
const kMaxNear = 300; ///< of more people, so many next to the drone have
const kFirstNearM = 12;
const kMaxNearM = 45;
const kMaxStepM = 3; ///< people who are new have not walked there

const kVertexHead = /* glsl */ `
attribute vec4 aFrom, aTo, aLook;
attribute float aPart;
uniform float uShare;
varying vec3 vShade;
vec3 turnedAsPerson(vec3 at) {
  float yaw = mix(aFrom.z, aTo.z, uShare);
  float isLying = step(aLook.w, -0.5);
  vec3 lain = mix(at, vec3(at.z - 0.85, at.y, 0.2 - at.x), isLying);
  return vec3(cos(yaw) * lain.x - sin(yaw) * lain.y, sin(yaw) * lain.x + cos(yaw) * lain.y, lain.z);
}`;

// Part: -1 and 1 legs, 0 body, 2 head.
const kVertexPosition = /* glsl */ `
vec3 transformed = vec3(position);
float leg = abs(aPart) == 1.0 ? aPart : 0.0;
float swing = leg * sin(mix(aFrom.w, aTo.w, uShare)) * max(0.0, aLook.w);
float below = max(0.0, 0.85 - transformed.z);
transformed.x += 0.5 * swing * below;
transformed.z += 0.12 * swing * swing * below;
transformed = turnedAsPerson(transformed) + vec3(mix(aFrom.xy, aTo.xy, uShare), 0.0);
vShade = aPart > 1.5 ? vec3(0.62, 0.42, 0.32) : aLook.rgb * (leg == 0.0 ? 1.0 : 0.4);`;

function withPart(geometry: any, part: number): any {
  const flat = geometry.index ? geometry.toNonIndexed() : geometry;
  flat.deleteAttribute("uv");
  return flat.setAttribute("aPart", new THREE.Float32BufferAttribute(new Float32Array(flat.attributes.position.count).fill(part), 1));
}

function walkerGeometry(): any {
  const leg = (side: number) =>
    withPart(new THREE.CylinderGeometry(0.09, 0.07, 0.85, 4, 1, true).rotateX(Math.PI / 2).translate(0, 0.1 * side, 0.425), side);
  const body = withPart(
    new THREE.CylinderGeometry(0.23, 0.17, 0.7, 6, 1)
      .rotateX(Math.PI / 2)
      .scale(0.75, 1, 1)
      .translate(0, 0, 1.15),
    0,
  );
  const head = withPart(new THREE.IcosahedronGeometry(0.13, 0).translate(0, 0, 1.62), 2);
  return mergeGeometries([body, head, leg(-1), leg(1)]);
}

/** Without a graphics card each triangle counts. */
const farGeometry = () => withPart(new THREE.CylinderGeometry(0.12, 0.28, 1.7, 4, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.85), 0);

/** People of one shape. */
class Group {
  readonly mesh: any;
  private readonly from: any;
  private readonly to: any;
  private readonly look: any;
  size = 0;

  constructor(shape: any, capacity: number, material: any) {
    const geometry = new THREE.InstancedBufferGeometry();
    for (const [name, attribute] of Object.entries(shape.attributes)) geometry.setAttribute(name, attribute);
    const attribute = (name: string) => {
      const list = new THREE.InstancedBufferAttribute(new Float32Array(kFloats * capacity), kFloats).setUsage(THREE.DynamicDrawUsage);
      geometry.setAttribute(name, list);
      return list;
    };
    [this.from, this.to, this.look] = ["aFrom", "aTo", "aLook"].map(attribute);
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  begin(): void {
    this.size = 0;
  }

  add(from: readonly number[], to: readonly number[], look: readonly number[]): void {
    const at = kFloats * this.size++;
    this.from.array.set(from, at);
    this.to.array.set(to, at);
    this.look.array.set(look, at);
  }

  end(): void {
    this.mesh.geometry.instanceCount = this.size;
    this.mesh.visible = this.size > 0;
    for (const attribute of [this.from, this.to, this.look]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, kFloats * this.size);
      attribute.needsUpdate = true;
    }
  }
}

const wrapped = (angle: number) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

export class Walkers {
  readonly group = new THREE.Group();
  private readonly share = { value: 1 };
  private readonly near: Group;
  private readonly far: Group;
  private readonly phases: Float32Array;
  private nearM: number;
  private readonly shades = new Map<string, number[]>();

  constructor(private readonly hello: Hello) {
    this.phases = new Float32Array(hello.people);
    this.nearM = hello.people <= kFewPeople ? Infinity : kFirstNearM;
    const material = new THREE.MeshLambertMaterial();
    material.onBeforeCompile = (shader: any) => {
      shader.uniforms["uShare"] = this.share;
      shader.vertexShader = `${kVertexHead}\n${shader.vertexShader}`
        .replace("#include <beginnormal_vertex>", "vec3 objectNormal = turnedAsPerson(normal) - turnedAsPerson(vec3(0.0));")
        .replace("#include <begin_vertex>", kVertexPosition);
      shader.fragmentShader = `varying vec3 vShade;\n${shader.fragmentShader}`.replace(
        "#include <color_fragment>",
        "diffuseColor.rgb *= vShade;",
      );
    };
    this.near = new Group(walkerGeometry(), hello.people, material);
    this.far = new Group(farGeometry(), hello.people, material);
    this.group.add(this.near.mesh, this.far.mesh);
  }

  private shadeOf(name: string): number[] {
    let shade = this.shades.get(name);
    if (!shade) this.shades.set(name, (shade = new THREE.Color(name).toArray() as number[]));
    return shade;
  }

  /** A step of the simulation: everybody goes from `before` to `now`. `x`, `y`: from where they are seen. */
  step(before: World, now: World, x: number, y: number): void {
    const seconds = Math.max(1e-3, now.timeS - before.timeS);
    this.near.begin();
    this.far.begin();
    for (let index = 0; index < now.people.x.length; ++index) {
      if (!isShown(this.hello, now.people, index)) continue;
      const [toX, toY] = [now.people.x[index]!, now.people.y[index]!];
      const walked = Math.hypot(toX - before.people.x[index]!, toY - before.people.y[index]!);
      const isNew = walked > kMaxStepM;
      const [fromX, fromY] = isNew ? [toX, toY] : [before.people.x[index]!, before.people.y[index]!];
      const phase = this.phases[index]!;
      const next = isNew ? phase : phase + (2 * Math.PI * walked) / kCycleM;
      this.phases[index] = wrapped(next);
      const yaw = before.people.yaw[index]!;
      const amplitude = now.people.flags[index]! & kFallen ? -1 : isNew ? 0 : Math.min(1, walked / seconds / kStrollMps);
      const group = Math.hypot(toX - x, toY - y) < this.nearM ? this.near : this.far;
      group.add(
        [fromX, fromY, yaw, phase],
        [toX, toY, yaw + wrapped(now.people.yaw[index]! - yaw), next],
        [...this.shadeOf(colorOfPerson(this.hello, now.people, index)), amplitude],
      );
    }
    if (this.nearM < Infinity) this.nearM = Math.min(kMaxNearM, this.nearM * (this.near.size > kMaxNear ? 0.8 : 1.1));
    this.near.end();
    this.far.end();
  }

  /** How much of the way of the step has been gone. */
  frame(share: number): void {
    this.share.value = share;
  }
}
