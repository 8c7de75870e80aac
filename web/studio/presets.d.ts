// The jobs of scenarios/, which build.mjs puts into the bundle.
declare module "presets" {
  const list: { file: string; job: unknown }[];
  export default list;
}
// The definitions of docs/metrics.md.
declare module "definitions" {
  const list: { anchor: string; names: string; text: string }[];
  export default list;
}
// The studies of scenarios/, likewise.
declare module "study_presets" {
  const list: { file: string; study: unknown }[];
  export default list;
}
