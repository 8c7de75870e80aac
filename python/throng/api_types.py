"""Answers of the service as TypedDicts.

Made by python/generate_types.py from `throng schema openapi`; do not edit.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypedDict


class Job(TypedDict):
    """Job of the service."""

    id: str
    name: str
    state: Literal["queued", "running", "succeeded", "partial", "failed", "cancelled"]
    attempt: int
    """Number of times that work on it was begun or taken up."""
    priority: int
    labels: list[str]
    owner: str | None
    """Id of the key that it came with."""
    created_at: str | None
    started_at: str | None
    ended_at: str | None
    expires_at: str | None
    """Time when it will be removed for its age; it is removed earlier where all jobs together take too much disk."""
    keep: bool
    """Whether it is never removed for its age."""
    bytes: int
    """Disk space of its files, measured when it ended."""
    waiting_for: str | None
    """Reason why nobody works on it although it is its turn."""
    progress: Progress
    error: JobError | None
    links: dict[str, str]
    job: NotRequired[dict[str, Any]]
    """The job with all defaults. Not in lists."""


class JobList(TypedDict):
    """JobList of the service."""

    jobs: list[Job]
    next: str | None


class JobChange(TypedDict):
    """JobChange of the service."""

    priority: NotRequired[int]
    labels: NotRequired[list[str]]
    keep: NotRequired[bool]


class JobErrorRun(TypedDict):
    """JobErrorRun of the service."""

    run: str
    task: str
    message: str
    attempts: int


class JobError(TypedDict):
    """JobError of the service."""

    kind: Literal["input", "environment", "partial"]
    message: str
    problems: list[Mistake]
    runs: NotRequired[list[JobErrorRun]]
    """Failed runs of a partial job."""


class ProgressPublishing(TypedDict):
    """Publication of the dataset: only for a job with outputs.publish, once its dataset is finished
    (docs/publishing.md)."""

    address: str
    """Address of the dataset in the object store, s3://BUCKET/PREFIX."""
    bytes_done: int
    """Bytes that are known to be there."""
    bytes_total: int
    """Bytes of the dataset; 0 while that is not known."""
    objects: int | None
    """Number of the dataset's objects, once all are there."""


class ProgressRun(TypedDict):
    """ProgressRun of the service."""

    run: str
    seed: int
    """Seed of the run, of up to 64 bits."""
    stage: Literal["waiting", "simulating", "rendering", "rendered", "publishing", "finished", "failed"]
    simulated_s: float
    duration_s: float
    frames_done: int
    frames_total: int
    frames_per_s: float
    remaining_s: float | None


class ProgressShard(TypedDict):
    """ProgressShard of the service."""

    shard: str
    frames_done: int
    frames_total: int
    frames_per_s: float
    remaining_s: float | None
    node: NotRequired[str]
    """Node of the cluster; left out where workers run on the service's machine."""


class ProgressNode(TypedDict):
    """ProgressNode of the service."""

    node: str
    running: int
    """Number of tasks that the node is working on."""
    done: int
    """Number of tasks that succeeded."""
    failed: int
    """Number of failed attempts at tasks, including those that were lost with the node."""
    busy_s: float
    """Duration of all attempts that ended, s."""


class Progress(TypedDict):
    """Progress of a job; empty before the job has begun."""

    stage: NotRequired[Literal["waiting", "simulating", "rendering", "rendered", "publishing", "finished", "failed"]]
    publishing: NotRequired[ProgressPublishing]
    """Publication of the dataset: only for a job with outputs.publish, once its dataset is finished
    (docs/publishing.md)."""
    frames_done: NotRequired[int]
    frames_total: NotRequired[int]
    runs: NotRequired[list[ProgressRun]]
    shards: NotRequired[list[ProgressShard]]
    """The shards that are being rendered."""
    nodes: NotRequired[list[ProgressNode]]
    """The work of a cluster's nodes for the job; empty where workers run on the service's machine."""
    frames_per_s: NotRequired[float]
    """Frames per second; 0 before the first frame."""
    remaining_s: NotRequired[float | None]
    """Remaining time at this rate, s; null before the first frame."""


class DryRun(TypedDict):
    """DryRun of the service."""

    valid: Literal[True]
    runs: int
    shards: int
    frames: int
    """Number of frames of all cameras."""
    people: int
    """Number of people in the first run, arrivals included."""
    estimate: JobEstimate
    views: list[CameraView]
    """Views of those cameras of the first run whose path does not depend on the people that they see."""
    warnings: list[Mistake]
    """Parts of the job that work and are probably not intended."""
    job: dict[str, Any]


class JobEstimate(TypedDict):
    """JobEstimate of the service."""

    cpu_s: float
    """CPU time of all processes of the job, s."""
    disk_bytes: int
    memory_mib: int
    """Memory of the largest task, MiB."""
    basis: Literal["this machine", "reference machine"]
    """The machine that takes cpu_s: this one, as its last jobs took, or before its first job the one that the
    estimates were made on."""


class CameraView(TypedDict):
    """CameraView of the service."""

    drone: str
    max_area_share: float
    """Largest share of the scenario's area in one image, 0 to 1."""
    max_person_px: float
    """Largest height of a person in an image; 0: nobody is in any."""


class Event(TypedDict):
    """Event of the service."""

    seq: int
    job: str
    at: str
    type: Literal["submitted", "stage", "changed", "removed", "started", "resumed", "succeeded", "partial", "failed", "cancelled", "retried"]
    data: dict[str, Any]


class EventList(TypedDict):
    """EventList of the service."""

    events: list[Event]
    next: int
    """The value of `after` for the next request."""


class LogListLog(TypedDict):
    """LogListLog of the service."""

    name: str
    bytes: int
    href: str


class LogList(TypedDict):
    """LogList of the service."""

    logs: list[LogListLog]


class PreviewListPreview(TypedDict):
    """PreviewListPreview of the service."""

    name: str
    href: str
    clean: str
    """The image without annotations."""


class PreviewList(TypedDict):
    """PreviewList of the service."""

    previews: list[PreviewListPreview]


class ImageListImage(TypedDict):
    """ImageListImage of the service."""

    run: str
    camera: str
    frame: int
    path: str
    """Path in the dataset, for /v1/jobs/{id}/files/PATH."""
    bytes: int


class ImageListRunCamera(TypedDict):
    """ImageListRunCamera of the service."""

    camera: str
    images: int
    first: int
    """Number of the first frame."""
    last: int


class ImageListRun(TypedDict):
    """ImageListRun of the service."""

    run: str
    cameras: list[ImageListRunCamera]


class ImageList(TypedDict):
    """ImageList of the service."""

    images: list[ImageListImage]
    total: int
    """Number of matching images on all pages."""
    runs: list[ImageListRun]
    """The runs of the whole dataset."""


class Calibration(TypedDict):
    """Calibration of the service."""

    id: str
    name: str
    state: Literal["queued", "running", "succeeded", "failed", "cancelled"]
    attempt: int
    """Number of times that work on it was begun or taken up."""
    priority: int
    labels: list[str]
    owner: str | None
    """Id of the key that it came with."""
    created_at: str | None
    started_at: str | None
    ended_at: str | None
    expires_at: str | None
    """Time when it will be removed for its age; it is removed earlier where all jobs together take too much disk."""
    keep: bool
    """Whether it is never removed for its age."""
    bytes: int
    """Disk space of its files, measured when it ended."""
    waiting_for: str | None
    """Reason why nobody works on it although it is its turn."""
    progress: dict[str, Any]
    error: JobError | None
    links: dict[str, str]
    request: dict[str, Any]
    camera: NotRequired[dict[str, Any]]


class CalibrationList(TypedDict):
    """CalibrationList of the service."""

    calibrations: list[Calibration]
    next: str | None
    schema: dict[str, Any]
    """The JSON schema of a request."""


class CalibrationPointsViewPoint(TypedDict):
    """CalibrationPointsViewPoint of the service."""

    pixel: list[float]
    """Position in the image, px; the middle of the top-left pixel is (0, 0)."""
    residual_px: list[float | None] | None
    """Difference between the projected and the observed position, px; null before anything is estimated."""
    used: bool
    """Whether the point is used; false: it is an outlier."""


class CalibrationPointsView(TypedDict):
    """CalibrationPointsView of the service."""

    image: str
    points: list[CalibrationPointsViewPoint]


class CalibrationPoints(TypedDict):
    """CalibrationPoints of the service."""

    width: int
    height: int
    views: list[CalibrationPointsView]


class StudyProgress(TypedDict):
    """StudyProgress of the service."""

    stage: NotRequired[Literal["simulating", "summing up", "finished"]]
    runs_done: NotRequired[int]
    runs_total: NotRequired[int]
    cells: NotRequired[list[list[int]]]
    """Numbers of finished runs, per case and policy."""
    remaining_s: NotRequired[float | None]


class Study(TypedDict):
    """Study of the service."""

    id: str
    name: str
    state: Literal["queued", "running", "succeeded", "failed", "cancelled"]
    attempt: int
    """Number of times that work on it was begun or taken up."""
    priority: int
    labels: list[str]
    owner: str | None
    """Id of the key that it came with."""
    created_at: str | None
    started_at: str | None
    ended_at: str | None
    expires_at: str | None
    """Time when it will be removed for its age; it is removed earlier where all jobs together take too much disk."""
    keep: bool
    """Whether it is never removed for its age."""
    bytes: int
    """Disk space of its files, measured when it ended."""
    waiting_for: str | None
    """Reason why nobody works on it although it is its turn."""
    progress: StudyProgress
    error: JobError | None
    links: dict[str, str]
    study: NotRequired[dict[str, Any] | None]
    """The document as it was sent. Not in lists."""
    plan: NotRequired[StudyPlan]
    summary: NotRequired[StudySummary | None]


class StudyList(TypedDict):
    """StudyList of the service."""

    studies: list[Study]
    next: str | None


class StudyPlanCase(TypedDict):
    """StudyPlanCase of the service."""

    id: str
    title: str
    scenario: str
    duration_s: float
    horizons_s: list[float]


class StudyPlanPolicie(TypedDict):
    """StudyPlanPolicie of the service."""

    id: str
    title: str


class StudyPlan(TypedDict):
    """StudyPlan of the service."""

    name: str
    seed: int
    runs: int
    """Number of runs of each case and policy."""
    baseline: str
    """The policy that others are compared with."""
    cases: list[StudyPlanCase]
    policies: list[StudyPlanPolicie]
    simulations: int
    """Number of all simulations."""
    people: int
    """Maximum number of people at the beginning of a run."""
    memory_mib: int
    """Estimated memory of the largest simulation, MiB."""
    valid: NotRequired[Literal[True]]


class StudySummaryRowTimes(TypedDict):
    """StudySummaryRowTimes of the service."""

    median: float | None
    low: float | None
    high: float | None


class StudySummaryRowRestrictedMeanRestrictedMeanS(TypedDict):
    """StudySummaryRowRestrictedMeanRestrictedMeanS of the service."""

    median: float | None
    low: float | None
    high: float | None


class StudySummaryRowRestrictedMeanWilcoxon(TypedDict):
    """StudySummaryRowRestrictedMeanWilcoxon of the service."""

    n: int
    w_plus: float
    p: float


class StudySummaryRowRestrictedMean(TypedDict):
    """StudySummaryRowRestrictedMean of the service."""

    until_s: float
    restricted_mean_s: StudySummaryRowRestrictedMeanRestrictedMeanS
    mean_s: float | None
    inside: float
    ratio_to_baseline: float | None
    difference_s: float | None
    difference_95_s: list[float | None]
    wilcoxon: StudySummaryRowRestrictedMeanWilcoxon
    holm_p: float | None


class StudySummaryRow(TypedDict):
    """StudySummaryRow of the service."""

    case: str
    policy: str
    runs: int
    times: dict[str, StudySummaryRowTimes]
    """Median and quartiles of t25_s to t99_s."""
    all_out: int
    not_escaped: float
    casualties: float
    restricted_means: list[StudySummaryRowRestrictedMean]
    t90_to_bound: float | None
    mean_to_bound: float | None
    t90_to_reference: float | None
    mean_to_reference: float | None
    followed: float
    exit_use: dict[str, float]
    left_by_no_exit: NotRequired[float]
    """People who left where there is no exit, mean over the runs; above 0 the outline has a gap."""


class StudySummary(TypedDict):
    """The summary, as summary.json of `throng study`, over the runs that every policy of a case has."""

    name: str
    seed: int
    generator: str
    baseline: str
    rows: list[StudySummaryRow]
    took_s: NotRequired[float]
    """Time that it took to make a summary of unfinished runs, s."""


class StudyValuesCasePolicie(TypedDict):
    """StudyValuesCasePolicie of the service."""

    id: str
    means_s: list[list[float | None]]
    """Restricted means up to either horizon."""
    t50_s: list[float | None]
    t90_s: list[float | None]
    t95_s: list[float | None]
    not_escaped: list[float | None]


class StudyValuesCase(TypedDict):
    """StudyValuesCase of the service."""

    id: str
    horizons_s: list[float]
    runs: list[int]
    """Numbers of the runs that every policy of the case has."""
    policies: list[StudyValuesCasePolicie]


class StudyValues(TypedDict):
    """The figures of each run, in the order of `runs`."""

    baseline: str
    cases: list[StudyValuesCase]


class LiveFlightError(TypedDict):
    """LiveFlightError of the service."""

    kind: str
    message: str


class LiveFlightLinks(TypedDict):
    """LiveFlightLinks of the service."""

    self: str
    stream: str
    recording: str | None
    """Address of the recording once the flight has ended; null for a flight that is not recorded."""


class LiveFlight(TypedDict):
    """LiveFlight of the service."""

    id: str
    name: str
    """Name of the job."""
    state: Literal["starting", "flying", "ended", "failed"]
    time_s: float
    """Simulated time, s."""
    viewers: int
    """Number of streams that are being read."""
    drones: list[str]
    recorded: bool
    """Whether it was begun with "record"."""
    error: LiveFlightError | None
    links: LiveFlightLinks
    result: NotRequired[LiveResult | None]
    """Result of a flight that has ended; lists leave it out."""


class LiveResultDrone(TypedDict):
    """LiveResultDrone of the service."""

    id: str
    csv: str
    """The pilot log (docs/guidance.md)."""


class LiveResultRecording(TypedDict):
    """LiveResultRecording of the service."""

    complete_until_s: float
    """All messages before this simulated time are in the recording, s."""
    problem: str | None
    """Why the recording ended before the flight, such as a full disk; null if it did not."""
    bytes: int
    """Size of the file."""


class LiveResult(TypedDict):
    """LiveResult of the service."""

    duration_s: float
    steps: int
    trace_sha256: str
    """SHA-256 of the flight's trace; the trace of the job's run000 has the same."""
    drones: list[LiveResultDrone]
    job: dict[str, Any]
    """A job for POST /v1/jobs that flies the logs again, as set-points of the policy pilot_log."""
    warnings: list[str]
    recording: LiveResultRecording | None
    """How far the recording goes; null for a flight that was not recorded."""


class LiveCommandsDrone(TypedDict):
    """LiveCommandsDrone of the service."""

    id: str
    """Id of the drone."""
    velocity_mps: NotRequired[list[float]]
    """Velocity [ahead, to the left, up]. Drones fly at most 10 m/s over the ground and 3 m/s up or down."""
    yaw_rate_deg_s: NotRequired[float]
    """Rate of yaw, counter-clockwise; drones turn at most at 120."""
    position_m: NotRequired[list[float]]
    """Point [x, y, z] in the world to fly to, after the waypoints if both are given. The drone stays there."""
    waypoints_m: NotRequired[list[list[float]]]
    """Points [x, y, z] in the world to fly to one after another; an empty list ends a flight to points."""
    yaw_deg: NotRequired[float]
    """Heading to turn to, counter-clockwise from +x. Without points, the drone turns where it is."""
    speed_mps: NotRequired[float]
    """Speed on the way to points given with it; default: 5."""
    gimbal_deg: NotRequired[list[float]]
    """Direction to turn the camera to: [pitch from -90 to 30 above the horizon, yaw from -180 to 180 to the left of
    the heading]. Gimbals turn at most at 60 degrees/s; a rigid camera has none."""
    beacon: NotRequired[bool]
    """Whether people may follow the drone."""
    return_home: NotRequired[bool]
    """Whether the drone returns to its start, until it is steered again."""


class LiveCommands(TypedDict):
    """LiveCommands of the service."""

    sequence: NotRequired[int]
    """Number that comes back with the states and images in which the commands are in force."""
    paused: NotRequired[bool]
    """Whether time stands still."""
    factor: NotRequired[float]
    """Simulated seconds per second; default at the start: 1."""
    view: NotRequired[str]
    """Id of the drone whose camera is shown; default at the start: the first drone."""
    drones: NotRequired[list[LiveCommandsDrone]]
    """Commands of drones."""


class ScenarioExit(TypedDict):
    """ScenarioExit of the service."""

    id: str
    width_m: float
    open: bool


class ScenarioDrone(TypedDict):
    """ScenarioDrone of the service."""

    id: str
    start_m: list[float]
    yaw_deg: float
    """Heading of the drone, counter-clockwise from +x."""


class Scenario(TypedDict):
    """Scenario of the service."""

    id: str
    name: NotRequired[str]
    description: NotRequired[str]
    crowd_model: NotRequired[str | None]
    ground_m: NotRequired[list[float]]
    exits: NotRequired[list[ScenarioExit]]
    drones: NotRequired[list[ScenarioDrone]]
    buildings: NotRequired[int]
    props: NotRequired[int]
    error: NotRequired[str]
    """Reason why the scenario cannot be used."""
    uploaded: NotRequired[Upload | None]
    """Upload that it is from; null: it came with throng."""


class ScenarioList(TypedDict):
    """ScenarioList of the service."""

    scenarios: list[Scenario]
    next: str | None
    """Where the next page begins: `?after=`. A page ends when it has 4 MiB."""


class UploadFinding(TypedDict):
    """UploadFinding of the service."""

    pointer: str
    found: str
    expected: str
    message: str
    severity: Literal["error", "warning"]
    remedy: str


class Upload(TypedDict):
    """Upload of the service."""

    name: str
    owner: str
    """Id of the key that sent it."""
    created_at: str
    bytes: int
    files: int
    ids: NotRequired[list[str]]
    """Ids of its scenarios."""
    findings: NotRequired[list[UploadFinding]]
    """Findings that do not prevent the upload (throng scenario check)."""


JobField = Any


class Mistake(TypedDict):
    """Mistake of the service."""

    pointer: str
    found: str
    expected: str
    message: str
    source: NotRequired[str]


class Problem(TypedDict):
    """A problem document (RFC 9457)."""

    type: str
    title: str
    status: int
    detail: str
    errors: NotRequired[list[Mistake]]


class KeyEnded(TypedDict):
    """In the answer to its revocation: what the key had under way, which was cancelled."""

    jobs: int
    live_flights: int


class Key(TypedDict):
    """Key of the service."""

    id: str
    name: str
    scope: Literal["read", "submit", "admin"]
    max_jobs: int | None
    """Maximum number of jobs that wait or run at once; null: any number."""
    max_bytes: int | None
    """Maximum disk space of all the key's jobs; null: any."""
    max_priority: int
    """Maximum priority of the key's jobs, from -100 to 100."""
    created_at: str | None
    revoked_at: str | None
    """Time when the key was revoked; null: it is valid."""
    expires_at: str | None
    """Time from which on callers with the key get 401; null: never."""
    links: dict[str, str]
    ended: NotRequired[KeyEnded]
    """In the answer to its revocation: what the key had under way, which was cancelled."""
    key: NotRequired[str]
    """The key itself, which callers send; only in the answer to its creation."""


class KeyList(TypedDict):
    """KeyList of the service."""

    keys: list[Key]


class WebhookLinks(TypedDict):
    """WebhookLinks of the service."""

    self: str
    deliveries: str


class Webhook(TypedDict):
    """Webhook of the service."""

    id: str
    url: str
    events: list[str]
    enabled: bool
    """Whether it is in use; it goes out of use after failing for a day."""
    created_at: str | None
    delivered_up_to: int
    """Number of the last event that is settled."""
    failures: int
    """Number of failures in a row."""
    failing_since: str | None
    links: WebhookLinks
    secret: NotRequired[str]
    """Secret that signs deliveries; only in the answer to its creation."""


class WebhookList(TypedDict):
    """WebhookList of the service."""

    webhooks: list[Webhook]


class Delivery(TypedDict):
    """Delivery of the service."""

    event: int
    """Number of the event; 0 for a ping."""
    type: str
    at: str | None
    attempt: int
    status: int | None
    error: str | None
    took_ms: int
    succeeded: bool


class DeliveryList(TypedDict):
    """DeliveryList of the service."""

    deliveries: list[Delivery]


class Session(TypedDict):
    """Session of the service."""

    needs_key: bool
    """Whether callers need a key."""
    scope: str | None
    """Scope of the caller: read, submit or admin; null without a valid key."""


OPERATIONS = (
    ("POST", "/v1/jobs"),
    ("GET", "/v1/jobs"),
    ("GET", "/v1/jobs/{id}"),
    ("PATCH", "/v1/jobs/{id}"),
    ("DELETE", "/v1/jobs/{id}"),
    ("POST", "/v1/jobs/{id}/cancel"),
    ("POST", "/v1/jobs/{id}/retry"),
    ("POST", "/v1/jobs/{id}/clone"),
    ("GET", "/v1/jobs/{id}/events"),
    ("GET", "/v1/jobs/{id}/plan"),
    ("GET", "/v1/jobs/{id}/logs"),
    ("GET", "/v1/jobs/{id}/logs/{name}"),
    ("GET", "/v1/jobs/{id}/previews"),
    ("GET", "/v1/jobs/{id}/previews/{path}"),
    ("GET", "/v1/jobs/{id}/images"),
    ("GET", "/v1/jobs/{id}/archive"),
    ("GET", "/v1/jobs/{id}/manifest"),
    ("GET", "/v1/jobs/{id}/files/{path}"),
    ("GET", "/v1/jobs/{id}/metrics"),
    ("GET", "/v1/jobs/{id}/report"),
    ("GET", "/v1/jobs/{id}/runs/{n}/metrics"),
    ("GET", "/v1/jobs/{id}/runs/{n}/metrics.csv"),
    ("GET", "/v1/jobs/{id}/runs/{n}/trace"),
    ("GET", "/v1/jobs/{id}/runs/{n}/trajectories"),
    ("POST", "/v1/calibrations"),
    ("GET", "/v1/calibrations"),
    ("GET", "/v1/calibrations/{id}"),
    ("DELETE", "/v1/calibrations/{id}"),
    ("GET", "/v1/calibrations/{id}/{name}"),
    ("GET", "/v1/calibrations/{id}/images/{path}"),
    ("POST", "/v1/studies"),
    ("GET", "/v1/studies"),
    ("GET", "/v1/studies/{id}"),
    ("PATCH", "/v1/studies/{id}"),
    ("DELETE", "/v1/studies/{id}"),
    ("POST", "/v1/studies/{id}/cancel"),
    ("POST", "/v1/studies/{id}/retry"),
    ("GET", "/v1/studies/{id}/events"),
    ("GET", "/v1/studies/{id}/report"),
    ("GET", "/v1/studies/{id}/files/{path}"),
    ("POST", "/v1/live"),
    ("GET", "/v1/live"),
    ("GET", "/v1/live/{id}"),
    ("DELETE", "/v1/live/{id}"),
    ("GET", "/v1/live/{id}/stream"),
    ("GET", "/v1/live/{id}/recording"),
    ("POST", "/v1/live/{id}/commands"),
    ("POST", "/v1/live/{id}/stop"),
    ("POST", "/v1/scenarios"),
    ("GET", "/v1/scenarios"),
    ("GET", "/v1/scenarios/{path}"),
    ("DELETE", "/v1/scenarios/{path}"),
    ("GET", "/v1/people"),
    ("GET", "/v1/airframes"),
    ("GET", "/v1/policies"),
    ("GET", "/v1/formats"),
    ("GET", "/v1/schema"),
    ("GET", "/v1/schemas"),
    ("GET", "/v1/schemas/{name}"),
    ("POST", "/v1/keys"),
    ("GET", "/v1/keys"),
    ("DELETE", "/v1/keys/{id}"),
    ("POST", "/v1/webhooks"),
    ("GET", "/v1/webhooks"),
    ("GET", "/v1/webhooks/{id}"),
    ("PATCH", "/v1/webhooks/{id}"),
    ("DELETE", "/v1/webhooks/{id}"),
    ("GET", "/v1/webhooks/{id}/deliveries"),
    ("POST", "/v1/webhooks/{id}/ping"),
    ("GET", "/v1/events"),
    ("POST", "/v1/session"),
    ("GET", "/v1/session"),
    ("DELETE", "/v1/session"),
    ("GET", "/v1/access/submit"),
    ("POST", "/v1/service/drain"),
    ("GET", "/v1/version"),
    ("GET", "/openapi.json"),
    ("GET", "/metrics"),
    ("GET", "/healthz"),
    ("GET", "/readyz"),
)
"""Every operation of the service: method and path."""
