// Made by web/studio/generate_types.mjs from server/openapi.json; do not edit.

export interface Job {
  id: string;
  name: string;
  state: "queued" | "running" | "succeeded" | "partial" | "failed" | "cancelled";
  /** How often work on it was begun or taken up. */
  attempt: number;
  priority: number;
  labels: string[];
  /** The id of the key that it came with. */
  owner: string | null;
  created_at: string | null;
  started_at: string | null;
  ended_at: string | null;
  /** When it will be removed for its age; earlier where all jobs together take too much disk. */
  expires_at: string | null;
  /** Never to be removed for its age. */
  keep: boolean;
  /** Disk that its files take, measured when it ended. */
  bytes: number;
  /** Why nobody works on it although it is its turn. */
  waiting_for: string | null;
  progress: Progress;
  error: JobError | null;
  links: Record<string, string>;
  /** With all defaults. */
  job: Record<string, unknown>;
}

export interface JobList {
  jobs: Job[];
  next: string | null;
}

export interface JobChange {
  priority?: number;
  labels?: string[];
  keep?: boolean;
}

export interface JobError {
  kind: "input" | "environment" | "partial";
  message: string;
  problems: Mistake[];
  /** Runs that failed, of a job that is partial. */
  runs?: {
    run: string;
    task: string;
    message: string;
    attempts: number;
  }[];
}

/** Empty before the job has begun. */
export interface Progress {
  stage?: "waiting" | "simulating" | "rendering" | "rendered" | "publishing" | "finished" | "failed";
  /** Of a job with outputs.publish only, from the time on that its dataset is finished (docs/publishing.md). */
  publishing?: {
    /** Place of the dataset in the object store, s3://BUCKET/PREFIX. */
    address: string;
    /** Known to be there. */
    bytes_done: number;
    /** 0 as long as it is not known. */
    bytes_total: number;
    /** Objects of the dataset, once all are there. */
    objects: number | null;
  };
  frames_done?: number;
  frames_total?: number;
  runs?: ({
    run: string;
    /** Up to 64 bits. */
    seed: number;
    stage: "waiting" | "simulating" | "rendering" | "rendered" | "publishing" | "finished" | "failed";
    simulated_s: number;
    duration_s: number;
    frames_done: number;
    frames_total: number;
    frames_per_s: number;
    remaining_s: number | null;
  })[];
  /** Running ones. */
  shards?: ({
    shard: string;
    frames_done: number;
    frames_total: number;
    frames_per_s: number;
    remaining_s: number | null;
    /** Of a cluster; not there where workers run on the service's machine. */
    node?: string;
  })[];
  /** The work of a cluster's nodes for the job; empty where workers run on the service's machine. */
  nodes?: {
    node: string;
    /** Tasks now. */
    running: number;
    /** Tasks that succeeded. */
    done: number;
    /** Attempts at tasks that did not, also those that were lost with the node. */
    failed: number;
    /** Seconds of all attempts that ended. */
    busy_s: number;
  }[];
  /** 0 before the first. */
  frames_per_s?: number;
  /** At this rate; null before the first frame. */
  remaining_s?: number | null;
}

export interface DryRun {
  valid: true;
  runs: number;
  shards: number;
  /** Of all cameras. */
  frames: number;
  /** In the first run, arrivals included. */
  people: number;
  estimate: JobEstimate;
  /** Of the first run's cameras whose path does not depend on the people they see. */
  views: CameraView[];
  /** Parts of the job that work and are probably not meant. */
  warnings: Mistake[];
  job: Record<string, unknown>;
}

export interface JobEstimate {
  /** Seconds of one core, with the software renderer; right within a factor of about two. */
  cpu_s: number;
  disk_bytes: number;
  /** Of the largest task. */
  memory_mib: number;
}

export interface CameraView {
  drone: string;
  /** Largest share of the scenario's area in one image, 0 to 1. */
  max_area_share: number;
  /** Largest height of a person in an image; 0: nobody is in any. */
  max_person_px: number;
}

export interface Event {
  seq: number;
  job: string;
  at: string;
  type: "submitted" | "started" | "resumed" | "stage" | "succeeded" | "failed" | "cancelled" | "retried" | "changed" | "removed";
  data: Record<string, unknown>;
}

export interface EventList {
  events: Event[];
  /** The value of `after` for the next request. */
  next: number;
}

export interface LogList {
  logs: {
    name: string;
    bytes: number;
    href: string;
  }[];
}

export interface PreviewList {
  previews: {
    name: string;
    href: string;
    /** The image without annotations. */
    clean: string;
  }[];
}

export interface ImageList {
  images: {
    run: string;
    camera: string;
    frame: number;
    /** In the dataset: /v1/jobs/{id}/files/PATH. */
    path: string;
    bytes: number;
  }[];
  /** Images that fit, on all pages. */
  total: number;
  /** Of the whole dataset. */
  runs: {
    run: string;
    cameras: {
      camera: string;
      images: number;
      /** Number of the first frame. */
      first: number;
      last: number;
    }[];
  }[];
}

export interface Calibration {
  id: string;
  name: string;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  /** How often work on it was begun or taken up. */
  attempt: number;
  priority: number;
  labels: string[];
  /** The id of the key that it came with. */
  owner: string | null;
  created_at: string | null;
  started_at: string | null;
  ended_at: string | null;
  /** When it will be removed for its age; earlier where all jobs together take too much disk. */
  expires_at: string | null;
  /** Never to be removed for its age. */
  keep: boolean;
  /** Disk that its files take, measured when it ended. */
  bytes: number;
  /** Why nobody works on it although it is its turn. */
  waiting_for: string | null;
  progress: Record<string, unknown>;
  error: JobError | null;
  links: Record<string, string>;
  request: Record<string, unknown>;
  camera?: Record<string, unknown>;
}

export interface CalibrationList {
  calibrations: Calibration[];
  next: string | null;
  /** The JSON schema of a request. */
  schema: Record<string, unknown>;
}

export interface CalibrationPoints {
  width: number;
  height: number;
  views: ({
    image: string;
    points: ({
      /** Counted from the middle of the top-left one. */
      pixel: number[];
      /** Shown - observed; null before anything is estimated. */
      residual_px: (number | null)[] | null;
      /** false: an outlier. */
      used: boolean;
    })[];
  })[];
}

export interface Study {
  id: string;
  name: string;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  /** How often work on it was begun or taken up. */
  attempt: number;
  priority: number;
  labels: string[];
  /** The id of the key that it came with. */
  owner: string | null;
  created_at: string | null;
  started_at: string | null;
  ended_at: string | null;
  /** When it will be removed for its age; earlier where all jobs together take too much disk. */
  expires_at: string | null;
  /** Never to be removed for its age. */
  keep: boolean;
  /** Disk that its files take, measured when it ended. */
  bytes: number;
  /** Why nobody works on it although it is its turn. */
  waiting_for: string | null;
  progress: {
    stage?: "simulating" | "summing up" | "finished";
    runs_done?: number;
    runs_total?: number;
    /** Finished runs, per case and policy. */
    cells?: number[][];
    remaining_s?: number | null;
  };
  error: JobError | null;
  links: Record<string, string>;
  /** The document as it was sent. */
  study: Record<string, unknown> | null;
  plan?: StudyPlan;
  summary?: StudySummary | null;
}

export interface StudyList {
  studies: Study[];
  next: string | null;
}

export interface StudyPlan {
  name: string;
  seed: number;
  /** Pairs: runs of each case and policy. */
  runs: number;
  /** The policy that others are compared with. */
  baseline: string;
  cases: {
    id: string;
    title: string;
    scenario: string;
    duration_s: number;
    horizons_s: number[];
  }[];
  policies: {
    id: string;
    title: string;
  }[];
  /** In all. */
  simulations: number;
  /** Most that a run begins with. */
  people: number;
  /** Of the largest simulation, by estimate. */
  memory_mib: number;
  valid?: true;
}

/** As summary.json of `throng study`: of the runs that every policy of a case has. */
export interface StudySummary {
  name: string;
  seed: number;
  generator: string;
  baseline: string;
  /** To make it; of a summary of what is there so far. */
  took_s?: number;
  rows: ({
    case: string;
    policy: string;
    runs: number;
    /** t25_s to t99_s: median and quartiles. */
    times: Record<string, {
      median: number | null;
      low: number | null;
      high: number | null;
    }>;
    all_out: number;
    not_escaped: number;
    casualties: number;
    restricted_means: ({
      until_s: number;
      restricted_mean_s: {
        median: number | null;
        low: number | null;
        high: number | null;
      };
      mean_s: number | null;
      inside: number;
      ratio_to_baseline: number | null;
      difference_s: number | null;
      difference_95_s: (number | null)[];
      wilcoxon: {
        n: number;
        w_plus: number;
        p: number;
      };
      holm_p: number | null;
    })[];
    t90_to_bound: number | null;
    mean_to_bound: number | null;
    t90_to_reference: number | null;
    mean_to_reference: number | null;
    followed: number;
    /** People who left where there is no exit, mean over the runs: there is a gap in the outline. */
    left_by_no_exit?: number;
    exit_use: Record<string, number>;
  })[];
}

/** The figures of each run, in the order of `runs`. */
export interface StudyValues {
  baseline: string;
  cases: ({
    id: string;
    horizons_s: number[];
    /** Numbers of the runs that every policy has. */
    runs: number[];
    policies: ({
      id: string;
      /** Restricted means up to either horizon. */
      means_s: ((number | null)[])[];
      t50_s: (number | null)[];
      t90_s: (number | null)[];
      t95_s: (number | null)[];
      not_escaped: (number | null)[];
    })[];
  })[];
}

export interface Scenario {
  id: string;
  name?: string;
  description?: string;
  crowd_model?: string | null;
  ground_m?: number[];
  exits?: {
    id: string;
    width_m: number;
    open: boolean;
  }[];
  drones?: {
    id: string;
    start_m: number[];
    /** Its heading, counter-clockwise from +x. */
    yaw_deg: number;
  }[];
  buildings?: number;
  props?: number;
  /** Why it cannot be used. */
  error?: string;
  /** Whose upload it is from; null: it came with throng. */
  uploaded?: null | Upload;
}

export interface ScenarioList {
  scenarios: Scenario[];
}

export interface Upload {
  name: string;
  /** The id of the key that sent it. */
  owner: string;
  created_at: string;
  bytes: number;
  files: number;
  /** Of its scenarios. */
  ids?: string[];
  /** Findings that do not prevent the upload (throng scenario check). */
  findings?: ({
    pointer: string;
    found: string;
    expected: string;
    message: string;
    severity: "error" | "warning";
    remedy: string;
  })[];
}

/** The part of the job's schema that says how a job names one. */
export type JobField = unknown;

export interface Mistake {
  pointer: string;
  found: string;
  expected: string;
  message: string;
  source?: string;
}

/** RFC 9457 */
export interface Problem {
  type: string;
  title: string;
  status: number;
  detail: string;
  errors?: Mistake[];
}

export interface Key {
  id: string;
  name: string;
  scope: "read" | "submit" | "admin";
  /** Jobs that may wait or run at once; null: any number. */
  max_jobs: number | null;
  /** Disk that all their jobs may take; null: any. */
  max_bytes: number | null;
  /** Of their jobs, from -100 to 100. */
  max_priority: number;
  created_at: string | null;
  /** Null: it is good. */
  revoked_at: string | null;
  /** The text that callers send; in the answer to its creation only. */
  key?: string;
  links: Record<string, string>;
}

export interface KeyList {
  keys: Key[];
}

export interface Webhook {
  id: string;
  url: string;
  events: string[];
  /** False also when it has failed for a day. */
  enabled: boolean;
  created_at: string | null;
  /** The last event that is settled. */
  delivered_up_to: number;
  /** In a row. */
  failures: number;
  failing_since: string | null;
  /** In the answer to its creation only. */
  secret?: string;
  links: Record<string, string>;
}

export interface WebhookList {
  webhooks: Webhook[];
}

export interface Delivery {
  /** 0 for a ping. */
  event: number;
  type: string;
  at: string | null;
  attempt: number;
  status: number | null;
  error: string | null;
  took_ms: number;
  succeeded: boolean;
}

export interface DeliveryList {
  deliveries: Delivery[];
}

export interface Session {
  /** Whether callers need a key. */
  needs_key: boolean;
  /** read, submit or admin; null without a good key. */
  scope: string | null;
}

export interface LiveFlight {
  id: string;
  /** Of the job. */
  name: string;
  state: "starting" | "flying" | "ended" | "failed";
  /** Simulated so far. */
  time_s: number;
  /** Streams that are read. */
  viewers: number;
  drones: string[];
  /** Once it has ended; not in lists. */
  result?: LiveResult | null;
  error: {
    kind: string;
    message: string;
  } | null;
  links: {
    self: string;
    stream: string;
  };
}

export interface LiveResult {
  duration_s: number;
  steps: number;
  /** Of the flight's trace; that of the job's run000 is equal. */
  trace_sha256: string;
  drones: {
    id: string;
    /** The pilot log (docs/guidance.md). */
    csv: string;
  }[];
  /** Flies the logs (as set-points of the policy pilot_log): for POST /v1/jobs. */
  job: Record<string, unknown>;
  warnings: string[];
}

export interface LiveCommands {
  /** Comes back with the states and images in which the commands are in force. */
  sequence?: number;
  paused?: boolean;
  /** Simulated seconds per second; 1 at first. */
  factor?: number;
  /** The drone whose camera is shown; the first at first. */
  view?: string;
  drones?: {
    id: string;
    /** Ahead, to the left, up. At most 10 m/s over the ground and 3 m/s up or down are flown. */
    velocity_mps?: number[];
    /** Counter-clockwise; at most 120 are flown. */
    yaw_rate_deg_s?: number;
    /** Whether people may follow the drone. */
    beacon?: boolean;
    /** To its start, until it is steered again. */
    return_home?: boolean;
  }[];
}
