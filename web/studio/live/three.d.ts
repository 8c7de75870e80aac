// The part of three.js that the scene uses has no types in its package; the scene is checked by a browser.
declare module "three";
declare module "three/examples/jsm/utils/BufferGeometryUtils.js";
