// Made by web/studio/generate_types.mjs from `throng schema openapi`; do not edit.

export interface Job {
  id: string;
  name: string;
  state: "queued" | "running" | "succeeded" | "partial" | "failed" | "cancelled";
  /** Number of times that work on it was begun or taken up. */
  attempt: number;
  priority: number;
  labels: string[];
  /** Id of the key that it came with. */
  owner: string | null;
  created_at: string | null;
  started_at: string | null;
  ended_at: string | null;
  /** Time when it will be removed for its age; it is removed earlier where all jobs together take too much disk. */
  expires_at: string | null;
  /** Whether it is never removed for its age. */
  keep: boolean;
  /** Disk space of its files, measured when it ended. */
  bytes: number;
  /** Reason why nobody works on it although it is its turn. */
  waiting_for: string | null;
  progress: Progress;
  error: JobError | null;
  links: Record<string, string>;
  /** The job with all defaults. Not in lists. */
  job?: Record<string, unknown>;
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
  /** Failed runs of a partial job. */
  runs?: {
    run: string;
    task: string;
    message: string;
    attempts: number;
  }[];
}

/** Progress of a job; empty before the job has begun. */
export interface Progress {
  stage?: "waiting" | "simulating" | "rendering" | "rendered" | "publishing" | "finished" | "failed";
  /** Publication of the dataset: only for a job with outputs.publish, once its dataset is finished (docs/publishing.md). */
  publishing?: {
    /** Address of the dataset in the object store, s3://BUCKET/PREFIX. */
    address: string;
    /** Bytes that are known to be there. */
    bytes_done: number;
    /** Bytes of the dataset; 0 while that is not known. */
    bytes_total: number;
    /** Number of the dataset's objects, once all are there. */
    objects: number | null;
  };
  frames_done?: number;
  frames_total?: number;
  runs?: ({
    run: string;
    /** Seed of the run, of up to 64 bits. */
    seed: number;
    stage: "waiting" | "simulating" | "rendering" | "rendered" | "publishing" | "finished" | "failed";
    simulated_s: number;
    duration_s: number;
    frames_done: number;
    frames_total: number;
    frames_per_s: number;
    remaining_s: number | null;
  })[];
  /** The shards that are being rendered. */
  shards?: ({
    shard: string;
    frames_done: number;
    frames_total: number;
    frames_per_s: number;
    remaining_s: number | null;
    /** Node of the cluster; left out where workers run on the service's machine. */
    node?: string;
  })[];
  /** The work of a cluster's nodes for the job; empty where workers run on the service's machine. */
  nodes?: {
    node: string;
    /** Number of tasks that the node is working on. */
    running: number;
    /** Number of tasks that succeeded. */
    done: number;
    /** Number of failed attempts at tasks, including those that were lost with the node. */
    failed: number;
    /** Duration of all attempts that ended, s. */
    busy_s: number;
  }[];
  /** Frames per second; 0 before the first frame. */
  frames_per_s?: number;
  /** Remaining time at this rate, s; null before the first frame. */
  remaining_s?: number | null;
}

export interface DryRun {
  valid: true;
  runs: number;
  shards: number;
  /** Number of frames of all cameras. */
  frames: number;
  /** Number of people in the first run, arrivals included. */
  people: number;
  estimate: JobEstimate;
  /** Views of those cameras of the first run whose path does not depend on the people that they see. */
  views: CameraView[];
  /** Parts of the job that work and are probably not intended. */
  warnings: Mistake[];
  job: Record<string, unknown>;
}

export interface JobEstimate {
  /** CPU time of all processes of the job, s. */
  cpu_s: number;
  disk_bytes: number;
  /** Memory of the largest task, MiB. */
  memory_mib: number;
  /** The machine that takes cpu_s: this one, as its last jobs took, or before its first job the one that the estimates were made on. */
  basis: "this machine" | "reference machine";
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
  type: "submitted" | "stage" | "changed" | "removed" | "started" | "resumed" | "succeeded" | "partial" | "failed" | "cancelled" | "retried";
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
    /** Path in the dataset, for /v1/jobs/{id}/files/PATH. */
    path: string;
    bytes: number;
  }[];
  /** Number of matching images on all pages. */
  total: number;
  /** The runs of the whole dataset. */
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
  /** Number of times that work on it was begun or taken up. */
  attempt: number;
  priority: number;
  labels: string[];
  /** Id of the key that it came with. */
  owner: string | null;
  created_at: string | null;
  started_at: string | null;
  ended_at: string | null;
  /** Time when it will be removed for its age; it is removed earlier where all jobs together take too much disk. */
  expires_at: string | null;
  /** Whether it is never removed for its age. */
  keep: boolean;
  /** Disk space of its files, measured when it ended. */
  bytes: number;
  /** Reason why nobody works on it although it is its turn. */
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
      /** Position in the image, px; the middle of the top-left pixel is (0, 0). */
      pixel: number[];
      /** Difference between the projected and the observed position, px; null before anything is estimated. */
      residual_px: (number | null)[] | null;
      /** Whether the point is used; false: it is an outlier. */
      used: boolean;
    })[];
  })[];
}

export interface Study {
  id: string;
  name: string;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  /** Number of times that work on it was begun or taken up. */
  attempt: number;
  priority: number;
  labels: string[];
  /** Id of the key that it came with. */
  owner: string | null;
  created_at: string | null;
  started_at: string | null;
  ended_at: string | null;
  /** Time when it will be removed for its age; it is removed earlier where all jobs together take too much disk. */
  expires_at: string | null;
  /** Whether it is never removed for its age. */
  keep: boolean;
  /** Disk space of its files, measured when it ended. */
  bytes: number;
  /** Reason why nobody works on it although it is its turn. */
  waiting_for: string | null;
  progress: {
    stage?: "simulating" | "summing up" | "finished";
    runs_done?: number;
    runs_total?: number;
    /** Numbers of finished runs, per case and policy. */
    cells?: number[][];
    remaining_s?: number | null;
  };
  error: JobError | null;
  links: Record<string, string>;
  /** The document as it was sent. Not in lists. */
  study?: Record<string, unknown> | null;
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
  /** Number of runs of each case and policy. */
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
  /** Number of all simulations. */
  simulations: number;
  /** Maximum number of people at the beginning of a run. */
  people: number;
  /** Estimated memory of the largest simulation, MiB. */
  memory_mib: number;
  valid?: true;
}

/** The summary, as summary.json of `throng study`, over the runs that every policy of a case has. */
export interface StudySummary {
  name: string;
  seed: number;
  generator: string;
  baseline: string;
  /** Time that it took to make a summary of unfinished runs, s. */
  took_s?: number;
  rows: ({
    case: string;
    policy: string;
    runs: number;
    /** Median and quartiles of t25_s to t99_s. */
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
    /** People who left where there is no exit, mean over the runs; above 0 the outline has a gap. */
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
    /** Numbers of the runs that every policy of the case has. */
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

export interface LiveFlight {
  id: string;
  /** Name of the job. */
  name: string;
  state: "starting" | "flying" | "ended" | "failed";
  /** Simulated time, s. */
  time_s: number;
  /** Number of streams that are being read. */
  viewers: number;
  drones: string[];
  /** Whether it was begun with "record". */
  recorded: boolean;
  /** Result of a flight that has ended; lists leave it out. */
  result?: LiveResult | null;
  error: {
    kind: string;
    message: string;
  } | null;
  links: {
    self: string;
    stream: string;
    /** Address of the recording once the flight has ended; null for a flight that is not recorded. */
    recording: string | null;
  };
}

export interface LiveResult {
  duration_s: number;
  steps: number;
  /** SHA-256 of the flight's trace; the trace of the job's run000 has the same. */
  trace_sha256: string;
  drones: {
    id: string;
    /** The pilot log (docs/guidance.md). */
    csv: string;
  }[];
  /** A job for POST /v1/jobs that flies the logs again, as set-points of the policy pilot_log. */
  job: Record<string, unknown>;
  warnings: string[];
  /** How far the recording goes; null for a flight that was not recorded. */
  recording: {
    /** All messages before this simulated time are in the recording, s. */
    complete_until_s: number;
    /** Why the recording ended before the flight, such as a full disk; null if it did not. */
    problem: string | null;
    /** Size of the file. */
    bytes: number;
  } | null;
}

export interface LiveCommands {
  /** Number that comes back with the states and images in which the commands are in force. */
  sequence?: number;
  /** Whether time stands still. */
  paused?: boolean;
  /** Simulated seconds per second; default at the start: 1. */
  factor?: number;
  /** Id of the drone whose camera is shown; default at the start: the first drone. */
  view?: string;
  /** Commands of drones. */
  drones?: {
    /** Id of the drone. */
    id: string;
    /** Velocity [ahead, to the left, up]. Drones fly at most 10 m/s over the ground and 3 m/s up or down. */
    velocity_mps?: number[];
    /** Rate of yaw, counter-clockwise; drones turn at most at 120. */
    yaw_rate_deg_s?: number;
    /** Point [x, y, z] in the world to fly to, after the waypoints if both are given. The drone stays there. */
    position_m?: number[];
    /** Points [x, y, z] in the world to fly to one after another; an empty list ends a flight to points. */
    waypoints_m?: number[][];
    /** Heading to turn to, counter-clockwise from +x. Without points, the drone turns where it is. */
    yaw_deg?: number;
    /** Speed on the way to points given with it; default: 5. */
    speed_mps?: number;
    /** Direction to turn the camera to: [pitch from -90 to 30 above the horizon, yaw from -180 to 180 to the left of the heading]. Gimbals turn at most at 60 degrees/s; a rigid camera has none. */
    gimbal_deg?: number[];
    /** Whether people may follow the drone. */
    beacon?: boolean;
    /** Whether the drone returns to its start, until it is steered again. */
    return_home?: boolean;
  }[];
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
    /** Heading of the drone, counter-clockwise from +x. */
    yaw_deg: number;
  }[];
  buildings?: number;
  props?: number;
  /** Reason why the scenario cannot be used. */
  error?: string;
  /** Upload that it is from; null: it came with throng. */
  uploaded?: Upload | null;
}

export interface ScenarioList {
  scenarios: Scenario[];
  /** Where the next page begins: `?after=`. A page ends when it has 4 MiB. */
  next: string | null;
}

export interface Upload {
  name: string;
  /** Id of the key that sent it. */
  owner: string;
  created_at: string;
  bytes: number;
  files: number;
  /** Ids of its scenarios. */
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

/** A problem document (RFC 9457). */
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
  /** In the answer to its revocation: what the key had under way, which was cancelled. */
  ended?: {
    jobs: number;
    live_flights: number;
  };
  /** Maximum number of jobs that wait or run at once; null: any number. */
  max_jobs: number | null;
  /** Maximum disk space of all the key's jobs; null: any. */
  max_bytes: number | null;
  /** Maximum priority of the key's jobs, from -100 to 100. */
  max_priority: number;
  created_at: string | null;
  /** Time when the key was revoked; null: it is valid. */
  revoked_at: string | null;
  /** Time from which on callers with the key get 401; null: never. */
  expires_at: string | null;
  /** The key itself, which callers send; only in the answer to its creation. */
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
  /** Whether it is in use; it goes out of use after failing for a day. */
  enabled: boolean;
  created_at: string | null;
  /** Number of the last event that is settled. */
  delivered_up_to: number;
  /** Number of failures in a row. */
  failures: number;
  failing_since: string | null;
  /** Secret that signs deliveries; only in the answer to its creation. */
  secret?: string;
  links: {
    self: string;
    deliveries: string;
  };
}

export interface WebhookList {
  webhooks: Webhook[];
}

export interface Delivery {
  /** Number of the event; 0 for a ping. */
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
  /** Scope of the caller: read, submit or admin; null without a valid key. */
  scope: string | null;
}
