// The jobs of scenarios/, which build.mjs puts into the bundle.
declare module "presets" {
  const list: { file: string; job: unknown }[];
  export default list;
}
