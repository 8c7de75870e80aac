"""The parts of a job as dataclasses: a typed way to write docs/job.md's JSON.

Made by python/generate_types.py from jobs/spec/job.schema.json; do not edit. What is None is left out, and then has the
default of the schema. The service and the program check values; types are for editors and mypy.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal, Mapping, Sequence

from ._job_base import Distribution, Part, choice, log_uniform, normal, uniform

__all__ = [
    "Appearance", "Area", "Battery", "Camera", "Capture", "Classes", "Columns", "Crowd", "Density", "Distortion",
    "Distribution", "Drone", "Environment", "Filters", "Gimbal", "Guidance", "Image", "Job", "Outputs", "PerFrame",
    "Perception", "Props", "Recorded", "Sensor", "Splits", "Webdataset", "Wind", "choice", "log_uniform", "normal",
    "uniform",
]


@dataclass
class Classes(Part):
    """What COCO's and YOLO's classes tell apart."""

    _: KW_ONLY
    by: Literal["none", "sex", "age_band", "state", "carries"] | None = None
    """Everybody is a person (none), or a class for each value of this. Default: "none"."""
    names: Sequence[str] | None = None
    """Other names for values: female=woman."""


@dataclass
class Webdataset(Part):
    """How the webdataset format is cut."""

    _: KW_ONLY
    shard_mb: float | None = None
    """What a tar file of WebDataset may reach before the next is begun, in 10^6 bytes. Unit: MB. Default: 1000."""


@dataclass
class Filters(Part):
    """Who is worth a label in other formats; the rest become ignore regions where a format has them."""

    _: KW_ONLY
    min_visibility: float | None = None
    """Share of a person that must be visible. Default: 0."""
    min_height_px: float | None = None
    """Height that the whole person must have in the picture. Unit: px. Default: 0."""
    max_truncation: float | None = None
    """Share of a person that may lie outside of the image; without it, any."""


@dataclass
class Splits(Part):
    """How runs are shared out in other formats."""

    _: KW_ONLY
    train: float | None = None
    """Share of the runs for training; whole runs, in their order. Where it is left out, what the other two leave.
    The three sum to at most 1. Default: 1."""
    val: float | None = None
    """Share of the runs for validation. Default: 0."""
    test: float | None = None
    """Share of the runs for tests. Default: 0."""
    train_runs: Sequence[int] | None = None
    """Runs that are in train whatever the shares say."""
    val_runs: Sequence[int] | None = None
    """Runs that are in val whatever the shares say."""
    test_runs: Sequence[int] | None = None
    """Runs that are in test whatever the shares say."""


@dataclass
class Density(Part):
    """How heads are spread."""

    _: KW_ONLY
    sigma_px: float | None = None
    """Standard deviation of the Gaussian of one head. Unit: px. Default: 4."""


@dataclass
class Image(Part):
    """How frames are stored."""

    _: KW_ONLY
    format: Literal["jpeg"] | None = None
    """File format. Default: "jpeg"."""
    quality: int | None = None
    """JPEG quality. Unit: 1 to 100. Default: 95."""


@dataclass
class Outputs(Part):
    """What the dataset holds."""

    _: KW_ONLY
    image: Image | None = None
    """How frames are stored."""
    annotations: Sequence[Literal["coco", "keypoints", "amodal", "density", "exits", "fields", "depth", "instances", "parts", "normals", "flow", "semantic", "sensors"]] | None = None
    """Which ground truth is written: coco (boxes, masks, cameras, what people do and look like), keypoints (COCO's
    17 of each person in the picture and in the world, with coco), amodal (masks of whole people, with coco),
    density (crowd density maps), exits (counts and clogging index per exit and frame), fields (density and
    velocity on the ground, per frame); per pixel, as PNG: depth, instances, parts (of the body), normals, flow
    (motion to the next frame), semantic (the class of what shows: ground, person, ...); per drone: sensors (a
    table of what they read, and of the truth). Default: ["coco", "density", "exits"]."""
    density: Density | None = None
    """How heads are spread."""
    previews: int | None = None
    """Pictures with drawn annotations per run and camera, evenly spread over the frames. Unit: pictures. Default: 3."""
    formats: Sequence[str] | None = None
    """Other formats that the dataset holds as well, below formats/: those that throng export --list names."""
    splits: Splits | None = None
    """How runs are shared out in other formats."""
    filters: Filters | None = None
    """Who is worth a label in other formats; the rest become ignore regions where a format has them."""
    webdataset: Webdataset | None = None
    """How the webdataset format is cut."""
    classes: Classes | None = None
    """What COCO's and YOLO's classes tell apart."""


@dataclass
class Props(Part):
    """What stands about in the place."""

    _: KW_ONLY
    density: float | None = None
    """Share of the scenario's scattered props that are there in a run, chosen by its seed. Default: 1."""


@dataclass
class Appearance(Part):
    """Which people take part, and what they wear against the colours of their wardrobes."""

    _: KW_ONLY
    brightness: float | None = None
    """Of dyed clothes: their colours' lightness is multiplied by it. Default: 1."""
    saturation: float | None = None
    """Of dyed clothes: 0 makes them grey, 2 twice as colourful. Default: 1."""
    variety: float | None = None
    """Share of the people (docs/people.md) that take part in a run, chosen by its seed. Default: 1."""
    youngest_years: float | None = None
    """Who is younger does not take part. Unit: years. Default: 0."""
    oldest_years: float | None = None
    """Who is older does not take part. Unit: years. Default: 150."""
    umbrellas: float | None = None
    """Share of people under an umbrella when it rains; in dry weather nobody is. Default: 0.05."""


@dataclass
class Wind(Part):
    """What the drones fly in."""

    _: KW_ONLY
    speed_mps: float | Distribution | None = None
    """Mean wind 10 m above the ground. Unit: m/s. Default: 0."""
    direction_deg: float | Distribution | None = None
    """Where the wind blows to, counter-clockwise from +x (east). Unit: degrees. Default: 0."""
    profile: str | Distribution | None = None
    """How the mean grows with height: log (with the logarithm of height over roughness), power (with a power of
    height), uniform (not at all). Default: "log"."""
    roughness_m: float | Distribution | None = None
    """Of the ground, for the profile log: 0.03 grass, 0.4 suburbs, 1 and more cities. Unit: m. Default: 0.4."""
    exponent: float | Distribution | None = None
    """Of the profile power. Default: 0.25."""
    gusts: str | Distribution | None = None
    """How each drone is shaken: dryden (turbulence of MIL-F-8785C at low altitude, which follows from wind and
    height), ou (Ornstein-Uhlenbeck, of a given strength and duration), none. Default: "dryden"."""
    intensity: float | Distribution | None = None
    """Factor on the strength of dryden's gusts. Default: 1."""
    gust_mps: float | Distribution | None = None
    """Standard deviation of ou's gusts along each axis. Unit: m/s. Default: 1.5."""
    gust_time_s: float | Distribution | None = None
    """Correlation time of ou's gusts. Unit: s. Default: 3."""


@dataclass
class Environment(Part):
    """Light and weather. Any field may be a distribution, drawn anew for every run."""

    _: KW_ONLY
    time_of_day: str | Distribution | None = None
    """Solar time at the run's start; sets the sun, which then stands still. Street lamps and windows are lit while
    it is below the horizon. Unit: HH:MM. Default: "15:30"."""
    latitude_deg: float | Distribution | None = None
    """Where on Earth the sun is seen from; north is positive. Unit: degrees. Default: 45."""
    day_of_year: int | Distribution | None = None
    """1 is 1 January; 225 is mid-August. Unit: days. Default: 225."""
    weather: str | Distribution | None = None
    """clear: sun and shadows; overcast: grey light without hard shadows; fog: contrast falls with distance; rain:
    overcast, streaks, a wet ground with puddles. Default: "clear"."""
    visibility_m: float | Distribution | None = None
    """Distance at which 2 % of a contrast is left; without it, by the weather: 3500 (clear), 8000 (overcast), 800
    (fog), 3000 (rain). Unit: m."""
    smoke: float | Distribution | None = None
    """How much smoke and dust there is where the scenario's dangers (disaster_agents) are; it hides what is behind
    it from the eye, not from the ground truth. Default: 0."""
    rain_mm_per_h: float | Distribution | None = None
    """Intensity of the rain, where the weather is rain. Unit: mm/h. Default: 4."""
    wind: Wind | None = None
    """What the drones fly in."""


@dataclass
class Capture(Part):
    """When pictures are taken, in every run, by every camera: at from_s, then every 1 / rate_hz, up to to_s. The run
    lasts until to_s."""

    _: KW_ONLY
    rate_hz: float | None = None
    """Frames per simulated second. Unit: Hz. Default: 1."""
    from_s: float | None = None
    """Time of the first frame, from the run's start. Unit: s. Default: 0."""
    to_s: float | None = None
    """No frame is later than this. Unit: s. Default: 60."""


@dataclass
class Sensor(Part):
    """What sensor and shutter do to the pictures; all of it is off unless asked for."""

    _: KW_ONLY
    ev: float | Distribution | None = None
    """Light is doubled by each 1. Unit: EV. Default: 0."""
    white_balance_k: float | Distribution | None = None
    """Colour temperature that the camera takes for white: below 6500 pictures turn blue, above yellow. Unit: K.
    Default: 6500."""
    vignette: float | Distribution | None = None
    """Share of the natural fall of light towards the corners, which is cos⁴ of the angle from the axis. Default: 0."""
    iso: float | Distribution | None = None
    """Sets the noise: full_well_e · 100 / iso electrons make white. 0: no noise. Default: 0."""
    full_well_e: float | Distribution | None = None
    """Electrons that fill a pixel at ISO 100. Unit: electrons. Default: 15000."""
    read_noise_e: float | Distribution | None = None
    """Standard deviation of each reading. Unit: electrons. Default: 3."""
    exposure_s: float | Distribution | None = None
    """How long each row gathers light, around the frame's time: what moves is blurred. 0: an instant. Unit: s.
    Default: 0."""
    readout_s: float | Distribution | None = None
    """From the first row to the last, the middle one at the frame's time: what moves leans. 0: all rows at once.
    Unit: s. Default: 0."""


@dataclass
class Gimbal(Part):
    """What holds the camera."""

    _: KW_ONLY
    model: Literal["ideal", "second_order"] | None = None
    """ideal: looks exactly where it is told; second_order: follows the heading like a spring with damping, shakes
    and is mounted slightly askew. Default: "ideal"."""
    natural_rad_s: float | Distribution | None = None
    """Natural frequency of the answer. Unit: rad/s. Default: 25."""
    damping: float | Distribution | None = None
    """Of the answer; 1: no overshoot. Default: 0.7."""
    jitter_deg: float | Distribution | None = None
    """Standard deviation of what shakes on, about each axis. Unit: degrees. Default: 0.015."""
    bias_deg: float | Distribution | None = None
    """The camera's mounting is off by up to so much about each axis, drawn per run. Unit: degrees. Default: 0.1."""
    reading_deg: float | Distribution | None = None
    """Standard deviation of the angles that the gimbal reports. Unit: degrees. Default: 0.02."""


@dataclass
class PerFrame(Part):
    """What differs from frame to frame: standard deviations of normal numbers that are drawn for each."""

    _: KW_ONLY
    yaw_deg: float | Distribution | None = None
    """Standard deviation of what each frame adds to yaw_deg. Unit: degrees. Default: 0."""
    pitch_deg: float | Distribution | None = None
    """Standard deviation of what each frame adds to pitch_deg, which stays between -90 and 90. Unit: degrees.
    Default: 0."""
    ev: float | Distribution | None = None
    """Standard deviation of what each frame adds to sensor.ev. Unit: EV. Default: 0."""


@dataclass
class Distortion(Part):
    """Coefficients of the lens model, by their names in OpenCV."""

    _: KW_ONLY
    k1: float | Distribution | None = None
    """Radial term of r² (fisheye: of θ³). Default: 0."""
    k2: float | Distribution | None = None
    """Radial term of r⁴ (fisheye: of θ⁵). Default: 0."""
    k3: float | Distribution | None = None
    """Radial term of r⁶ (fisheye: of θ⁷). Default: 0."""
    k4: float | Distribution | None = None
    """Term of r² of the rational model's denominator (fisheye: of θ⁹). Default: 0."""
    k5: float | Distribution | None = None
    """Term of r⁴ of the denominator; brown_conrady only. Default: 0."""
    k6: float | Distribution | None = None
    """Term of r⁶ of the denominator; brown_conrady only. Default: 0."""
    p1: float | Distribution | None = None
    """First tangential term; brown_conrady only. Default: 0."""
    p2: float | Distribution | None = None
    """Second tangential term; brown_conrady only. Default: 0."""


@dataclass
class Camera(Part):
    """A camera on a gimbal that cancels the drone's roll and pitch. Every number but the image's size may be a
    distribution, drawn anew for every run."""

    _: KW_ONLY
    preset: Literal["dji_phantom_4_pro", "dji_phantom_4_pro_full_hd", "dji_phantom_4", "px4_typhoon_h480", "airsim"] | None = None
    """A known camera, for what is left out here: its image size and field of view (jobs/spec/cameras.json, with
    sources)."""
    calibration: str | Mapping[str, Any] | None = None
    """A real camera: frames have exactly its size, lens and distortion, instead of width, height, hfov_deg, fx_px to
    cy_px, model and distortion. A file is found beside the job's; the service takes ids. A recorded job holds the
    camera itself."""
    width: int | None = None
    """Columns of each image. Unit: px. Default: 1280."""
    height: int | None = None
    """Rows of each image. Unit: px. Default: 720."""
    hfov_deg: float | Distribution | None = None
    """Horizontal angle that the image covers, with the lens's distortion. Unit: degrees. Default: 78."""
    fx_px: float | Distribution | None = None
    """Of a calibrated camera, instead of hfov_deg. Unit: px."""
    fy_px: float | Distribution | None = None
    """Of a calibrated camera; without it, fx_px. Unit: px."""
    cx_px: float | Distribution | None = None
    """Of a calibrated camera, 0 being the middle of the first column; without it, the image's middle. Unit: px."""
    cy_px: float | Distribution | None = None
    """Of a calibrated camera, 0 being the middle of the first row; without it, the image's middle. Unit: px."""
    model: Literal["pinhole", "brown_conrady", "fisheye"] | None = None
    """pinhole: straight lines stay straight; brown_conrady and fisheye (Kannala and Brandt) as in OpenCV, with the
    coefficients of distortion. Default: "pinhole"."""
    distortion: Distortion | None = None
    """Coefficients of the lens model, by their names in OpenCV."""
    pitch_deg: float | Distribution | None = None
    """Angle above the horizon; -90 looks straight down. Unit: degrees. Default: -50."""
    yaw_deg: float | Distribution | None = None
    """Angle to the left of the drone's heading. Unit: degrees. Default: 0."""
    per_frame: PerFrame | None = None
    """What differs from frame to frame: standard deviations of normal numbers that are drawn for each."""
    gimbal: Gimbal | None = None
    """What holds the camera."""
    sensor: Sensor | None = None
    """What sensor and shutter do to the pictures; all of it is off unless asked for."""


@dataclass
class Area(Part):
    """survey: the rectangle that it covers; without it, the one that people must leave."""

    min: Sequence[float]
    """[x, y]. Unit: m."""
    max: Sequence[float]
    """[x, y]. Unit: m."""


@dataclass
class Perception(Part):
    """What a policy knows of people."""

    _: KW_ONLY
    kind: Literal["truth", "camera"] | None = None
    """truth: everybody's place and aim; camera: what a camera that looks straight down from the drone would count.
    Without it, truth."""
    fov_deg: float | None = None
    """camera: the angle of the cone that it sees; without it, 90. Unit: degrees."""
    delay_s: float | None = None
    """camera: from the picture to the estimate; without it, 1. Unit: s."""
    count_noise: float | None = None
    """camera: share of the people that it misses, and of those that it counts twice; without it, 0.1."""


@dataclass
class Guidance(Part):
    """Where the drone flies."""

    _: KW_ONLY
    policy: Literal["hover", "waypoints", "orbit", "survey", "follow_density", "zigzag", "pilot_log", "balance", "signage"] | None = None
    """hover: stay at the start; waypoints: fly from point to point and hover at the last; orbit: circle a point and
    look at it; survey: lanes over an area; follow_density: keep the camera on the densest crowd; zigzag: sweep
    and lead like a tele-operator; pilot_log: repeat recorded set-points; balance: lead people from long queues to
    short ones; signage: hover before the exit that is best and call people there. Default: "hover"."""
    waypoints: Sequence[Sequence[float]] | None = None
    """The points of the policy "waypoints", in order. Unit: m."""
    speed_mps: float | None = None
    """Speed along the path. Unit: m/s. Default: 3."""
    lead_speed_mps: float | None = None
    """balance: how fast it leads people; without it, 1.6. Unit: m/s."""
    batch: int | None = None
    """balance: most people that it fetches at once; without it, 50. Unit: people."""
    exits: Sequence[str] | None = None
    """zigzag, balance, signage: ids of the scenario's exits that it may lead to; without it, all that are open."""
    beacon: bool | None = None
    """hover, waypoints, orbit, survey, follow_density: whether people may follow the drone, all the time; without
    it, false. The other policies decide themselves."""
    perception: Perception | None = None
    """What a policy knows of people."""
    centre: Sequence[float] | None = None
    """orbit: [x, y] that it circles. Unit: m."""
    radius_m: float | None = None
    """orbit: distance from the centre. Unit: m."""
    area: Area | None = None
    """survey: the rectangle that it covers; without it, the one that people must leave."""
    overlap: float | None = None
    """survey: share of the camera's view that neighbouring lanes have in common; without it, 0.3."""
    log: str | None = None
    """pilot_log: a file of set-points in the job's folder, as throng simulate --pilot-logs writes it."""
    setpoints: Sequence[Sequence[float]] | None = None
    """pilot_log: the same in the job itself, by time."""


@dataclass
class Battery(Part):
    """Whether flying ends."""

    _: KW_ONLY
    charge: float | None = None
    """Share of a full battery at the run's start; the drone lands where it is when 15 % are left. Without it, the
    battery lasts."""


@dataclass
class Drone(Part):
    """One drone and its camera."""

    id: str
    """Unique name: letters, digits, '_' and '-'; also the name of folders. A drone of the scenario lends its start
    and goal to the one of the same id."""
    _: KW_ONLY
    airframe: str | Mapping[str, Any] | None = None
    """Which quadcopter flies: one that throng airframes lists, or an object with the fields that it prints for one.
    Default: "f450"."""
    battery: Battery | None = None
    """Whether flying ends."""
    start: Sequence[float] | None = None
    """Where the drone hovers when the run begins; without it, the scenario's start for this id. Unit: m."""
    moves_goal: Sequence[int] | None = None
    """The goal of the behaviour file, [goal set, goal], that follows the drone over the ground; without it, the
    scenario's for this id."""
    guidance: Guidance | None = None
    """Where the drone flies."""
    camera: Camera | None = None
    """A camera on a gimbal that cancels the drone's roll and pitch. Every number but the image's size may be a
    distribution, drawn anew for every run."""


@dataclass
class Columns(Part):
    """What the columns of a table (csv) are called in its first line."""

    _: KW_ONLY
    person: str | None = None
    """Name or number of the person; without it, id."""
    frame: str | None = None
    """Number of the frame; without it, frame."""
    time: str | None = None
    """Time in seconds, instead of frame."""
    x: str | None = None
    """Place along x; without it, x."""
    y: str | None = None
    """Place along y; without it, y."""


@dataclass
class Recorded(Part):
    """People of a trajectory file, who are replayed instead of simulating the scenario's; see docs/imports.md."""

    file: str
    """The file of trajectories, named from the job's folder; a job's own folder keeps a copy. Requests cannot name
    files."""
    _: KW_ONLY
    sha256: str | None = None
    """SHA-256 of the file; another file is refused. Filled in."""
    format: Literal["any", "text", "sqlite", "scb", "csv"] | None = None
    """text of JuPedSim and PedPy, JuPedSim's sqlite, Menge's scb, or csv, a table whose columns are named below;
    without it (any), by suffix and content."""
    frame_rate_hz: float | None = None
    """Frames per second of the file, where it does not say or is wrong; with a column of times, the rate to
    interpolate to. Unit: Hz."""
    unit: Literal["m", "cm", "mm", "ft"] | None = None
    """Of lengths in the file; without it, as the file says, else m."""
    columns: Columns | None = None
    """What the columns of a table (csv) are called in its first line."""
    radius_m: float | None = None
    """Of everybody's body, which files do not say; without it, 0.2. Unit: m."""
    desired_speed_mps: float | None = None
    """Of everybody, for the metrics; without it, 1.34. Unit: m/s."""


@dataclass
class Crowd(Part):
    """Who takes part, and how they move."""

    _: KW_ONLY
    agents: int | None = None
    """How many of the scenario's people take part, drawn by the seed; without it, all. Unit: people."""
    model: str | None = None
    """How people keep clear of each other: a model that throng crowd --list names, for example orca or helbing.
    Without it the one that the scenario names, else ttc, whose speeds and flows are those of real crowds (orca
    where compat asks for the results of Menge)."""
    compat: Literal["none", "menge", "huang2016"] | None = None
    """Whose results are wanted where the scenario's files leave a choice: the sensible ones (none), Menge's with its
    quirks (menge), or also those of the elements that Huang's group added to it (huang2016). Default: "none"."""
    separation: Literal["soft", "hard"] | None = None
    """soft: as the model has it; hard: no two people ever overlap by more than 1 cm. Default: "soft"."""
    compliance: float | None = None
    """Probability that somebody who is near a guide follows it; multiplies that of the behaviour file. Default: 1."""
    physical: bool | None = None
    """Whether bodies give way: people whom a drone hits or a crowd presses are pushed, and fall where it is too
    much. Default: false."""
    fall_impulse_ns: float | None = None
    """A blow that throws somebody over, where bodies are physical. Unit: N s. Default: 20."""
    recorded: Recorded | None = None
    """People of a trajectory file, who are replayed instead of simulating the scenario's; see docs/imports.md."""


@dataclass
class Job(Part):
    """A dataset to make: a scenario, how often it is run, from which drones it is seen and what is written.
    Everything but "scenario" has a default."""

    scenario: str | Mapping[str, Any]
    """Id of a scenario: its path below the scenarios folder, without suffix, for example city_square/nearest_exit.
    Or {"generate": {"kind": "plaza", "seed": 5}}, a place from a seed; docs/blueprint.md lists its parameters."""
    _: KW_ONLY
    name: str | None = None
    """What people call the dataset; names the archive and its folder."""
    seed: int | None = None
    """All randomness comes from it: equal jobs with equal seeds give equal bytes. Default: 1."""
    runs: int | None = None
    """How many times the scenario is simulated, each time with a seed of its own. Unit: runs. Default: 1."""
    crowd: Crowd | None = None
    """Who takes part, and how they move."""
    drones: Sequence[Drone] | None = None
    """The drones in the air, one camera each; without it, the scenario's drones, hovering at their starts."""
    capture: Capture | None = None
    """When pictures are taken, in every run, by every camera: at from_s, then every 1 / rate_hz, up to to_s. The run
    lasts until to_s."""
    quality: Literal["draft", "standard", "high"] | None = None
    """Of the pictures: draft (quick: flat colours, no shadows, coarse people), standard, high (soft shadows, finer
    people, four samples of colour per pixel). Default: "standard"."""
    environment: Environment | None = None
    """Light and weather. Any field may be a distribution, drawn anew for every run."""
    appearance: Appearance | None = None
    """Which people take part, and what they wear against the colours of their wardrobes."""
    props: Props | None = None
    """What stands about in the place."""
    randomize: Mapping[str, Distribution] | None = None
    """Fields that are drawn anew for every run, by their dotted paths, each with a distribution:
    {"drones.0.camera.pitch_deg": {"uniform": [-80, -35]}}."""
    outputs: Outputs | None = None
    """What the dataset holds."""
