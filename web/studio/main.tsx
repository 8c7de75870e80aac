// Studio, the web page of the service.
import { render } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { addBaseToElements } from "./parts/addresses";
import { Empty } from "./parts/elements";
import { Lazy } from "./parts/lazy";
import { followLinks, useAddress } from "./parts/router";
import { applyTheme, KeyDialog, Shell } from "./parts/shell";
import { Home } from "./screens/home";
import { JobScreen } from "./screens/job";
import { Jobs } from "./screens/jobs";
import "./style.css";

interface Screen {
  title: string;
  element: preact.JSX.Element;
}

const loadAccess = () => import("./access/access_screen").then((module) => module.AccessScreen);
const loadReference = () => import("./reference/reference_screen").then((module) => module.ReferenceScreen);
const loadDefinitions = () => import("./run/definitions").then((module) => module.DefinitionsScreen);
const loadDownloads = () => import("./downloads/downloads_screen").then((module) => module.DownloadsScreen);
const loadNewJob = () => import("./screens/new_job").then((module) => module.NewJob);
const loadBrowser = () => import("./dataset/browser").then((module) => module.Browser);
const loadCompare = () => import("./compare/compare_screen").then((module) => module.Compare);
const loadCalibrations = () => import("./calibration/calibrations_screen").then((module) => module.CalibrationsScreen);
const loadCalibration = () => import("./calibration/calibration_screen").then((module) => module.CalibrationScreen);
const loadBlueprint = () => import("./blueprint/blueprint_screen").then((module) => module.BlueprintScreen);
const loadStudies = () => import("./study/studies_screen").then((module) => module.StudiesScreen);
const loadStudy = () => import("./study/study_screen").then((module) => module.StudyScreen);
const loadFly = () => import("./live/fly_screen").then((module) => module.FlyScreen);
const loadRun = () => import("./run/run_screen").then((module) => module.RunScreen);

function screenOf(path: string): Screen {
  if (path === "/") return { title: "Home", element: <Home /> };
  if (path === "/jobs") return { title: "Jobs", element: <Jobs /> };
  if (path === "/new") return { title: "New job", element: <Lazy load={loadNewJob} props={{}} /> };
  if (path === "/compare") return { title: "Compare", element: <Lazy load={loadCompare} props={{}} /> };
  if (path === "/keys") return { title: "Keys and webhooks", element: <Lazy load={loadAccess} props={{}} /> };
  if (path === "/api") return { title: "API", element: <Lazy load={loadReference} props={{}} /> };
  if (path === "/definitions") return { title: "Definitions", element: <Lazy load={loadDefinitions} props={{}} /> };
  if (path === "/calibrations") return { title: "Calibrations", element: <Lazy load={loadCalibrations} props={{}} /> };
  if (path === "/fly") return { title: "Live flight", element: <Lazy load={loadFly} props={{}} /> };
  // The former address of the editor was /place.
  if (path === "/blueprint" || path === "/place") return { title: "Blueprint", element: <Lazy load={loadBlueprint} props={{}} /> };
  if (path === "/studies") return { title: "Studies", element: <Lazy load={loadStudies} props={{}} /> };
  const study = /^\/studies\/([a-z0-9]+)\/?$/.exec(path);
  if (study) return { title: "Study", element: <Lazy key={path} load={loadStudy} props={{ id: study[1]! }} /> };
  const calibration = /^\/calibrations\/([a-z0-9]+)\/?$/.exec(path);
  if (calibration) return { title: "Calibration", element: <Lazy key={path} load={loadCalibration} props={{ id: calibration[1]! }} /> };
  const run = /^\/jobs\/([a-z0-9]+)\/runs\/(\d{1,4})\/?$/.exec(path);
  if (run) return { title: "Run", element: <Lazy key={path} load={loadRun} props={{ id: run[1]!, number: Number(run[2]) }} /> };
  const job = /^\/jobs\/([a-z0-9]+)(\/images|\/downloads)?\/?$/.exec(path);
  if (job?.[2] === "/downloads") return { title: "Downloads", element: <Lazy key={path} load={loadDownloads} props={{ id: job[1]! }} /> };
  if (job?.[2]) return { title: "Images", element: <Lazy key={job[1]} load={loadBrowser} props={{ id: job[1]! }} /> };
  if (job) return { title: "Job", element: <JobScreen key={job[1]} id={job[1]!} /> };
  const element = (
    <Empty title="There is nothing at this address.">
      <a class="button" href="/">
        Home
      </a>
    </Empty>
  );
  return { title: "Not found", element };
}

function Studio() {
  const { path } = useAddress();
  const isFirst = useRef(true);
  const { title, element } = screenOf(path);
  useEffect(() => {
    document.title = `${title} – throng Studio`;
    // A reader of the screen hears the new title; the first load leaves the focus where browsers put it.
    if (!isFirst.current) document.getElementById("main")?.focus({ preventScroll: true });
    isFirst.current = false;
  }, [path]);
  return (
    <>
      <Shell>{element}</Shell>
      <KeyDialog />
    </>
  );
}

addBaseToElements();
applyTheme();
document.addEventListener("click", followLinks);
render(<Studio />, document.getElementById("studio")!);
