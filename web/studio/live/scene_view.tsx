// The flight in space: buildings, people and drones, seen from behind the drone that is flown. Between two steps of the
// simulation everybody is shown on the way.
import { useEffect, useRef, useState } from "preact/hooks";
import * as THREE from "three";
import type { Hello, World } from "./messages";
import { Smoke } from "./smoke";
import { Walkers } from "./walkers";

interface SceneViewProps {
  hello: Hello;
  world: { current: World | null };
  drone: number;
}

const kBehindM = 14;
const kAboveM = 6;
const kManyPeople = 1000;
const kFollow = 0.12; ///< share of the way that the view goes in a frame

function modelOfScenario(hello: Hello): any {
  const group = new THREE.Group();
  const { min, max } = hello.ground;
  const ground = new THREE.Mesh(
    new THREE.PlaneGeometry(max[0] - min[0], max[1] - min[1]),
    new THREE.MeshLambertMaterial({ color: "#b9bdb4" }),
  );
  ground.position.set((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, -0.02);
  group.add(ground);
  const walls = new THREE.MeshLambertMaterial({ color: "#8d979e" });
  for (const building of hello.buildings) {
    const shape = new THREE.Shape(building.footprint.map(([x, y]) => new THREE.Vector2(x, y)));
    group.add(new THREE.Mesh(new THREE.ExtrudeGeometry(shape, { depth: building.height_m, bevelEnabled: false }), walls));
  }
  for (const exit of hello.exits) {
    const points = [exit.from, exit.to].map(([x, y]) => new THREE.Vector3(x, y, 0.3));
    group.add(
      new THREE.Line(
        new THREE.BufferGeometry().setFromPoints(points),
        new THREE.LineBasicMaterial({ color: exit.open ? "#1d6b3a" : "#b3261e" }),
      ),
    );
  }
  return group;
}

function droneMesh(): any {
  const group = new THREE.Group();
  const material = new THREE.MeshLambertMaterial({ color: "#2b3238" });
  group.add(new THREE.Mesh(new THREE.BoxGeometry(0.35, 0.2, 0.12), material));
  for (const turn of [0.25, 0.75]) {
    const arm = new THREE.Mesh(new THREE.BoxGeometry(0.75, 0.05, 0.04), material);
    arm.rotation.z = Math.PI * turn;
    group.add(arm);
  }
  const beacon = new THREE.Mesh(new THREE.SphereGeometry(0.14, 12, 8), new THREE.MeshBasicMaterial({ color: "#ffb020" }));
  beacon.position.z = -0.15;
  beacon.name = "beacon";
  group.add(beacon);
  group.scale.setScalar(1.8);
  return group;
}

/** The two newest steps, and when the newer one came. */
class Steps {
  before: World | null = null;
  now: World | null = null;
  private at = 0;

  /** Whether it is new. */
  take(world: World | null): boolean {
    if (!world || world === this.now) return false;
    this.before = this.now && this.now.timeS < world.timeS ? this.now : world;
    this.now = world;
    this.at = performance.now();
    return true;
  }

  /** How much of the way to the newest step has been gone. */
  share(): number {
    const { before, now } = this;
    const span = before && now ? (now.timeS - before.timeS) * 1000 : 0;
    return span > 0 ? Math.min(1, ((performance.now() - this.at) * Math.max(0.05, now!.factor)) / span) : 1;
  }
}

const mixed = (a: number, b: number, share: number) => a + share * (b - a);

export function SceneView({ hello, world, drone }: SceneViewProps) {
  const holder = useRef<HTMLDivElement>(null);
  const flown = useRef(drone);
  flown.current = drone;
  const [error, setError] = useState<string | null>(null);
  useEffect(() => {
    const element = holder.current!;
    let renderer: any;
    try {
      renderer = new THREE.WebGLRenderer({ antialias: hello.people <= kManyPeople });
    } catch {
      setError("This browser has no WebGL for the 3-D view; the plan shows the same.");
      return;
    }
    element.append(renderer.domElement);
    renderer.domElement.className = "fly-canvas";
    renderer.domElement.setAttribute("role", "img");
    renderer.domElement.setAttribute("aria-label", "The flight in space, from behind the drone");
    const scene = new THREE.Scene();
    scene.background = new THREE.Color("#c9dbe6");
    scene.fog = new THREE.Fog("#c9dbe6", 150, 600);
    const sun = new THREE.DirectionalLight("#ffffff", 2.2);
    sun.position.set(60, -40, 120);
    scene.add(new THREE.HemisphereLight("#ffffff", "#8a8f86", 1.6), sun, modelOfScenario(hello));
    const people = new Walkers(hello);
    const smoke = new Smoke(hello);
    scene.add(people.group, smoke.group);
    const drones = hello.drones.map(() => droneMesh());
    drones.forEach((mesh) => scene.add(mesh));
    const camera = new THREE.PerspectiveCamera(60, 16 / 9, 0.1, 2000);
    camera.up.set(0, 0, 1);
    const eye = new THREE.Vector3();
    const steps = new Steps();
    let isFirst = true;
    let isStale = false;

    const draw = () => {
      isStale = steps.take(world.current) || isStale;
      const { before, now } = steps;
      const width = element.clientWidth;
      if (!now || !before || width === 0) return;
      renderer.setPixelRatio(Math.min(1.5, devicePixelRatio));
      renderer.setSize(width, element.clientHeight, false);
      camera.aspect = width / Math.max(1, element.clientHeight);
      camera.updateProjectionMatrix();
      const share = steps.share();
      if (isStale) people.step(before, now, now.drones[flown.current]!.position[0], now.drones[flown.current]!.position[1]);
      isStale = false;
      people.frame(share);
      smoke.frame(mixed(before.timeS, now.timeS, share));
      now.drones.forEach((state, index) => {
        const mesh = drones[index]!;
        const last = before.drones[index]!;
        mesh.position.set(...[0, 1, 2].map((axis) => mixed(last.position[axis]!, state.position[axis]!, share)));
        const [w, x, y, z] = state.quaternion;
        mesh.quaternion.set(x, y, z, w);
        mesh.getObjectByName("beacon").visible = state.hasBeacon;
      });
      const followed = drones[flown.current]!;
      const yaw = now.drones[flown.current]!.yaw;
      const wanted = new THREE.Vector3(
        followed.position.x - kBehindM * Math.cos(yaw),
        followed.position.y - kBehindM * Math.sin(yaw),
        followed.position.z + kAboveM,
      );
      eye.lerp(wanted, isFirst ? 1 : kFollow);
      isFirst = false;
      camera.position.copy(eye);
      camera.lookAt(followed.position.x + 6 * Math.cos(yaw), followed.position.y + 6 * Math.sin(yaw), Math.max(0, followed.position.z - 6));
      renderer.render(scene, camera);
    };
    renderer.setAnimationLoop(draw);
    return () => {
      renderer.setAnimationLoop(null);
      scene.traverse((object: any) => object.geometry?.dispose());
      renderer.dispose();
      renderer.domElement.remove();
    };
  }, [hello]);
  return (
    <div ref={holder} class="fly-canvas">
      {error && <p class="quiet-text">{error}</p>}
    </div>
  );
}
