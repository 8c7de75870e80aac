"""The parts of a job as dataclasses: a typed way to write docs/job.md's JSON.

Made by python/generate_types.py from spec/job/job.schema.json; do not edit. Values that are None are left out and
have the default of the schema. The service and the program check values; types are for editors and mypy.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal, Mapping, Sequence

from ._job_base import Distribution, Part, choice, log_uniform, normal, uniform

__all__ = [
    "Aim", "Appearance", "Area", "Battery", "Camera", "Capture", "Classes", "Columns", "Counts", "Crowd", "Density",
    "Distortion", "Distribution", "Drone", "Environment", "Fields", "Filters", "Gimbal", "Guidance", "Image", "Job",
    "Line", "Mount", "Outputs", "PerFrame", "Perception", "Processing", "Props", "Recorded", "ScenarioShare", "Sensor",
    "Splits", "Webdataset", "Wind", "Zone", "choice", "log_uniform", "normal", "uniform",
]


@dataclass
class Classes(Part):
    """Classes of COCO and YOLO."""

    _: KW_ONLY
    by: Literal["none", "sex", "age_band", "state", "carries"] | None = None
    """none: all people are one class; else a class for each value of this property. Default: "none"."""
    names: Sequence[str] | None = None
    """Other names for values: female=woman."""


@dataclass
class Webdataset(Part):
    """Options of the webdataset format."""

    _: KW_ONLY
    shard_mb: float | None = None
    """Maximum size of a tar file of WebDataset before the next is begun, in 10^6 bytes. Unit: MB. Default: 1000."""


@dataclass
class Filters(Part):
    """Limits for a label in other formats; people beyond them become ignore regions if a format has them."""

    _: KW_ONLY
    min_visibility: float | None = None
    """Minimum visible share of a person. Default: 0."""
    min_height_px: float | None = None
    """Minimum height of the whole person in the image. Unit: px. Default: 0."""
    max_truncation: float | None = None
    """Maximum share of a person outside of the image; without it, any."""
    min_contrast: float | None = None
    """Minimum color difference of a person to the surroundings, in the mean or along the outline, whichever is
    larger; needs the annotation difficulty. About 2.3 is just noticeable. Unit: CIELAB. Default: 0."""


@dataclass
class Splits(Part):
    """Assignment of runs to splits in other formats."""

    _: KW_ONLY
    train: float | None = None
    """Share of the runs for training; whole runs, in their order. Default: the rest that the other two leave. The
    three sum to at most 1. Default: 1."""
    val: float | None = None
    """Share of the runs for validation. Default: 0."""
    test: float | None = None
    """Share of the runs for tests. Default: 0."""
    train_runs: Sequence[int] | None = None
    """Runs that are in train regardless of the shares."""
    train_scenarios: Sequence[str] | None = None
    """Scenarios of which every run is in train regardless of the shares."""
    val_runs: Sequence[int] | None = None
    """Runs that are in val regardless of the shares."""
    val_scenarios: Sequence[str] | None = None
    """Scenarios of which every run is in val regardless of the shares."""
    test_runs: Sequence[int] | None = None
    """Runs that are in test regardless of the shares."""
    test_scenarios: Sequence[str] | None = None
    """Scenarios of which every run is in test regardless of the shares."""


@dataclass
class Line(Part):
    """A straight line on the ground; crossings to its left are inward."""

    id: str
    """Unique among zones, lines and exits."""
    start: Sequence[float]
    """[x, y]."""
    end: Sequence[float]
    """[x, y]."""


@dataclass
class Zone(Part):
    """A simple polygon on the ground."""

    id: str
    """Unique among zones, lines and exits."""
    corners: Sequence[Sequence[float]]
    """[x, y] of each, in their order."""


@dataclass
class Counts(Part):
    """Areas of the annotation counts."""

    _: KW_ONLY
    zones: Sequence[Zone] | None = None
    """Polygons on the ground in which people are counted, beside the whole ground. Unit: m."""
    lines: Sequence[Line] | None = None
    """Lines on the ground across which people are counted, beside the exits' doors. Unit: m."""


@dataclass
class Fields(Part):
    """Grids of the annotation fields."""

    _: KW_ONLY
    cells_m: Sequence[float] | None = None
    """Sizes of cells that the fields are written with, too, below fields/RUN/cell_SIZE/. The densities of each sum
    to the same people. Unit: m."""


@dataclass
class Density(Part):
    """Kernel of the heads."""

    _: KW_ONLY
    sigma_px: float | None = None
    """Standard deviation of the Gaussian of one head. Unit: px. Default: 4."""


@dataclass
class Image(Part):
    """Storage of frames."""

    _: KW_ONLY
    format: Literal["jpeg"] | None = None
    """File format. Default: "jpeg"."""
    quality: int | None = None
    """JPEG quality. Unit: 1 to 100. Default: 95."""


@dataclass
class Outputs(Part):
    """Contents of the dataset."""

    _: KW_ONLY
    image: Image | None = None
    """Storage of frames."""
    annotations: Sequence[Literal["coco", "keypoints", "skeletons", "actions", "amodal", "vehicles", "difficulty", "heads", "occluders", "density", "exits", "hazards", "fields", "counts", "trajectories", "events", "depth", "instances", "parts", "normals", "flow", "flow_backward", "flow_occlusion", "scene_flow", "hazard_opacity", "semantic", "sensors"]] | None = None
    """Which ground truth is written: coco (boxes, masks, cameras, activity and appearance of people), keypoints
    (COCO's 17 of each person in the image and in the world, with coco), skeletons (33 joints of each person,
    turns of 21 bones and gaze, with coco), actions (of each person over the run, with times, and in images;
    members of groups who are together), amodal (masks of whole people, with coco), vehicles (boxes, masks and 3-D
    boxes of cars and trains, with coco), difficulty (contrast, blur and visible keypoints of each person, with
    coco), heads (box and visible share of each person's head, with coco), occluders (what hides each person and
    how much of them, with coco), density (crowd density maps), exits (counts and clogging index per exit and
    frame), hazards (place and reach of each disaster, danger to each person, with coco), fields (density and
    velocity on the ground, per frame), counts (people in zones and across lines since the frame before, with
    identities), trajectories (everybody's, seen or not), events (escapes, falls, collisions, notices, with time,
    place and person); per pixel, as PNG: depth, instances, parts (of the body), normals, flow (motion to the next
    frame), flow_backward (motion to the previous frame), flow_occlusion (whether the next frame shows the same),
    scene_flow (motion in the world to the next frame), hazard_opacity (of fire, smoke and gas before what shows),
    semantic (the class of the visible surface: road, person, tree, ...); per drone: sensors (a table of their
    readings and the truth). Default: ["coco", "density", "exits"]."""
    density: Density | None = None
    """Kernel of the heads."""
    fields: Fields | None = None
    """Grids of the annotation fields."""
    counts: Counts | None = None
    """Areas of the annotation counts."""
    previews: int | None = None
    """Images with the annotations drawn on them per run and camera, evenly spread over the frames. Unit: images.
    Default: 3."""
    formats: Sequence[str] | None = None
    """Additional formats of the dataset, below formats/: names that throng export --list prints."""
    publish: str | None = None
    """Address in an object store, s3://BUCKET/PREFIX, that the finished dataset is brought to; credentials come from
    the environment and never stand in a job (docs/publishing.md). Default: none."""
    splits: Splits | None = None
    """Assignment of runs to splits in other formats."""
    filters: Filters | None = None
    """Limits for a label in other formats; people beyond them become ignore regions if a format has them."""
    webdataset: Webdataset | None = None
    """Options of the webdataset format."""
    classes: Classes | None = None
    """Classes of COCO and YOLO."""


@dataclass
class Props(Part):
    """The props of the scenario."""

    _: KW_ONLY
    density: float | None = None
    """Share of the scenario's scattered props that are present in a run, chosen by its seed. Default: 1."""


@dataclass
class Appearance(Part):
    """Which characters take part, and adjustments of their clothes' colors."""

    _: KW_ONLY
    brightness: float | None = None
    """Factor on the lightness of dyed clothes' colors. Default: 1."""
    saturation: float | None = None
    """Factor on the saturation of dyed clothes' colors: 0 makes them gray, 2 twice as colorful. Default: 1."""
    variety: float | None = None
    """Share of the characters (docs/people.md) that take part in a run, chosen by its seed. Default: 1."""
    youngest_years: float | None = None
    """Minimum age of the characters that take part. Unit: years. Default: 0."""
    oldest_years: float | None = None
    """Maximum age of the characters that take part. Unit: years. Default: 150."""
    umbrellas: float | None = None
    """Share of people under an umbrella when it rains; none in dry weather. Default: 0.33."""


@dataclass
class Wind(Part):
    """The wind that acts on drones and smoke."""

    _: KW_ONLY
    speed_mps: float | Distribution | None = None
    """Mean wind 10 m above the ground. Unit: m/s. Default: 0."""
    direction_deg: float | Distribution | None = None
    """Direction that the wind blows to, counterclockwise from +x (east). Unit: degrees. Default: 0."""
    profile: str | Distribution | None = None
    """Mean wind over height: log (grows with the logarithm of height over roughness), power (with a power of
    height), uniform (constant). Default: "log"."""
    roughness_m: float | Distribution | None = None
    """Roughness length of the ground, for the profile log: 0.03 grass, 0.4 suburbs, 1 and more cities. Unit: m.
    Default: 0.4."""
    exponent: float | Distribution | None = None
    """Exponent of the profile power. Default: 0.25."""
    gusts: str | Distribution | None = None
    """Gust model of each drone: dryden (turbulence of MIL-F-8785C at low altitude, which follows from wind and
    height), ou (Ornstein-Uhlenbeck, of a given strength and duration), none. Default: "dryden"."""
    intensity: float | Distribution | None = None
    """Factor on the strength of dryden's gusts. Default: 1."""
    gust_mps: float | Distribution | None = None
    """Standard deviation of ou's gusts along each axis. Unit: m/s. Default: 1.5."""
    gust_time_s: float | Distribution | None = None
    """Correlation time of ou's gusts. Unit: s. Default: 3."""


@dataclass
class Environment(Part):
    """Light and weather. Any field may be a distribution, sampled again for every run."""

    _: KW_ONLY
    time_of_day: str | Distribution | None = None
    """Solar time at the run's start; sets the sun for the whole run: HH:MM, or midnight, dawn, sunrise, noon, sunset
    or dusk, also as "sunset-20min" or "dusk+1h". Street lamps and windows are lit while it is below the horizon.
    Unit: HH:MM. Default: "15:30"."""
    latitude_deg: float | Distribution | None = None
    """Latitude for the sun's position; north is positive. Unit: degrees. Default: 45."""
    day_of_year: int | Distribution | None = None
    """1 is 1 January; 225 is mid-August. Unit: days. Default: 225."""
    weather: str | Distribution | None = None
    """clear: sun and shadows; overcast: diffuse light without hard shadows; fog: contrast falls with distance; rain:
    overcast, streaks, a wet ground with puddles. Default: "clear"."""
    visibility_m: float | Distribution | None = None
    """Distance at which 2 % of a contrast is left; default, by the weather: 20000 (clear), 15000 (overcast), 800
    (fog), 5000 (rain). Unit: m."""
    smoke: float | Distribution | None = None
    """Density of smoke and dust around the scenario's hazards (disaster_agents); it hides objects in the image, not
    in the ground truth. Default: 0."""
    rain_mm_per_h: float | Distribution | None = None
    """Intensity of the rain if the weather is rain. Unit: mm/h. Default: 4."""
    wind: Wind | None = None
    """The wind that acts on drones and smoke."""


@dataclass
class Capture(Part):
    """Times of the frames of every run and camera: from_s, then every 1 / rate_hz, up to to_s. The run lasts until
    run_to_s."""

    _: KW_ONLY
    rate_hz: float | None = None
    """Frames per simulated second. Unit: Hz. Default: 1."""
    from_s: float | None = None
    """Time of the first frame, from the run's start. Unit: s. Default: 0."""
    to_s: float | None = None
    """Maximum time of a frame. Unit: s. Default: 60."""
    run_to_s: float | None = None
    """End of the run, if it goes on after the last frame, so that figures tell of an evacuation to its end; default:
    to_s. Unit: s."""


@dataclass
class Processing(Part):
    """Effects of the lens, the camera's signal processor and its encoder on the images, in this order. 0: none."""

    _: KW_ONLY
    point_spread_px: float | Distribution | None = None
    """Standard deviation of the Gaussian that a point of light becomes. Unit: px. Default: 0."""
    flare: float | Distribution | None = None
    """Share of the light that the lens scatters over the image. Default: 0."""
    denoising: float | Distribution | None = None
    """Strength of the filter that smooths noise, and fine texture with it. Default: 0."""
    tone_mapping: float | Distribution | None = None
    """How far dark and bright regions are brought to the brightness of the whole. Default: 0."""
    sharpening: float | Distribution | None = None
    """Gain of the unsharp mask, which draws bright and dark halos along edges. Default: 0."""
    bits_per_px: float | Distribution | None = None
    """The image is encoded once to this size before it is written: blocks of 8 x 8 pixels, and half of the colors'
    resolution. 0: it is not. Unit: bits per pixel. Default: 0."""


@dataclass
class Sensor(Part):
    """Effects of sensor and shutter on the images."""

    _: KW_ONLY
    metering: Literal["image", "light"] | None = None
    """image: each image's exposure follows the brightness of what it shows, people left out; light: only the light
    of hour and weather, the same for all images of a run. Default: "image"."""
    ev: float | Distribution | None = None
    """Each 1 EV doubles the light. Unit: EV. Default: 0."""
    white_balance_k: float | Distribution | None = None
    """Color temperature that the camera assumes for white: below 6500 images turn blue, above yellow. Unit: K.
    Default: 6500."""
    vignette: float | Distribution | None = None
    """Share of the natural fall of light towards the corners, which is cos⁴ of the angle from the axis. Default: 0."""
    color_shading: float | Distribution | None = None
    """Share of red and blue that is lost in the corners, which turn green. Default: 0."""
    iso: float | Distribution | None = None
    """Sets the noise: full_well_e · 100 / iso electrons make white. 0: no noise. Default: as the light asks for at
    f/2.8 and 1/60 s, 1600 at most, and no noise below 400, as by day."""
    min_iso: float | Distribution | None = None
    """An automatic iso is at least this: real cameras have noise by day, too. Default: 0."""
    full_well_e: float | Distribution | None = None
    """Electrons that fill a pixel at ISO 100. Unit: electrons. Default: 15000."""
    read_noise_e: float | Distribution | None = None
    """Standard deviation of each reading. Unit: electrons. Default: 3."""
    exposure_s: float | Distribution | None = None
    """Duration for which each row gathers light, around the frame's time: moving objects are blurred. 0: an instant.
    Unit: s. Default: 0."""
    readout_s: float | Distribution | None = None
    """From the first row to the last, the middle one at the frame's time: moving objects are skewed. 0: all rows at
    once (global shutter). Unit: s. Default: 0."""
    field_s: float | Distribution | None = None
    """Interlaced video: the odd rows are this much older than the frame, whose labels are those of the even rows. 0:
    all rows are of one time. Unit: s. Default: 0."""


@dataclass
class Gimbal(Part):
    """The stabilized mount of the camera."""

    _: KW_ONLY
    model: Literal["ideal", "second_order", "rigid"] | None = None
    """ideal: exact direction; second_order: follows the heading as a damped second-order system, with jitter and a
    misaligned mount; rigid: no gimbal, the camera rolls and pitches with the drone. Default: "ideal"."""
    natural_rad_s: float | Distribution | None = None
    """Natural frequency of the response. Unit: rad/s. Default: 25."""
    damping: float | Distribution | None = None
    """Damping ratio of the response; 1: no overshoot. Default: 0.7."""
    jitter_deg: float | Distribution | None = None
    """Standard deviation of the remaining vibration about each axis. Unit: degrees. Default: 0.015."""
    bias_deg: float | Distribution | None = None
    """Maximum error of the camera's mounting about each axis, sampled per run. Unit: degrees. Default: 0.1."""
    reading_deg: float | Distribution | None = None
    """Standard deviation of the angles that the gimbal reports. Unit: degrees. Default: 0.02."""


@dataclass
class PerFrame(Part):
    """Differences from frame to frame: standard deviations of normal numbers that are sampled for each."""

    _: KW_ONLY
    yaw_deg: float | Distribution | None = None
    """Standard deviation of each frame's offset from yaw_deg. Unit: degrees. Default: 0."""
    pitch_deg: float | Distribution | None = None
    """Standard deviation of each frame's offset from pitch_deg; their sum stays between -90 and 90. Unit: degrees.
    Default: 0."""
    ev: float | Distribution | None = None
    """Standard deviation of each frame's offset from sensor.ev. Unit: EV. Default: 0."""
    white_balance_k: float | Distribution | None = None
    """Standard deviation of each frame's offset from sensor.white_balance_k; their sum stays between 1667 and 25000.
    Unit: K. Default: 0."""


@dataclass
class Mount(Part):
    """Position of the camera's center on the drone."""

    _: KW_ONLY
    x_m: float | Distribution | None = None
    """Distance from the drone's center, ahead. Unit: m. Default: 0."""
    y_m: float | Distribution | None = None
    """Distance from the drone's center, to the left. Unit: m. Default: 0."""
    z_m: float | Distribution | None = None
    """Distance from the drone's center, above. Unit: m. Default: 0."""


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
    """A camera on a gimbal that cancels the drone's roll and pitch, or fixed to it. Every number except the image's
    size may be a distribution, sampled again for every run."""

    _: KW_ONLY
    preset: Literal["dji_phantom_4_pro", "dji_phantom_4_pro_full_hd", "dji_phantom_4", "px4_typhoon_h480", "airsim", "dji", "gopro", "phone", "surveillance"] | None = None
    """A known camera, whose image size and field of view are defaults of the fields below (spec/job/cameras.json,
    with sources)."""
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
    """Of a calibrated camera; default: fx_px. Unit: px."""
    cx_px: float | Distribution | None = None
    """Of a calibrated camera, 0 being the middle of the first column; default: the image's middle. Unit: px."""
    cy_px: float | Distribution | None = None
    """Of a calibrated camera, 0 being the middle of the first row; default: the image's middle. Unit: px."""
    model: Literal["pinhole", "brown_conrady", "fisheye"] | None = None
    """pinhole: straight lines stay straight; brown_conrady and fisheye (Kannala and Brandt) as in OpenCV, with the
    coefficients of distortion. Default: "pinhole"."""
    distortion: Distortion | None = None
    """Coefficients of the lens model, by their names in OpenCV."""
    pitch_deg: float | Distribution | None = None
    """Angle above the horizon; -90 looks straight down. Unit: degrees. Default: -50."""
    yaw_deg: float | Distribution | None = None
    """Angle to the left of the drone's heading. Unit: degrees. Default: 0."""
    mount: Mount | None = None
    """Position of the camera's center on the drone."""
    per_frame: PerFrame | None = None
    """Differences from frame to frame: standard deviations of normal numbers that are sampled for each."""
    gimbal: Gimbal | None = None
    """The stabilized mount of the camera."""
    sensor: Sensor | None = None
    """Effects of sensor and shutter on the images."""
    processing: Processing | None = None
    """Effects of the lens, the camera's signal processor and its encoder on the images, in this order. 0: none."""


@dataclass
class Area(Part):
    """survey: the rectangle that it covers; default: the one that people must leave."""

    min: Sequence[float]
    """[x, y]. Unit: m."""
    max: Sequence[float]
    """[x, y]. Unit: m."""


@dataclass
class Perception(Part):
    """A policy's information about people."""

    _: KW_ONLY
    kind: Literal["truth", "camera"] | None = None
    """truth: all people's positions and goals; camera: the count of a camera that looks straight down from the
    drone. Default: truth."""
    fov_deg: float | None = None
    """camera: opening angle of its cone of view; default: 90. Unit: degrees."""
    delay_s: float | None = None
    """camera: delay from the image to the estimate; default: 1. Unit: s."""
    count_noise: float | None = None
    """camera: share of the people that it misses, and of those that it counts twice; default: 0.1."""


@dataclass
class Guidance(Part):
    """The policy that flies the drone."""

    _: KW_ONLY
    policy: Literal["hover", "waypoints", "orbit", "survey", "follow_density", "zigzag", "pilot_log", "balance", "signage"] | None = None
    """hover: stay at the start; waypoints: fly from point to point and hover at the last; orbit: circle a point and
    look at it; survey: lanes over an area; follow_density: keep the camera on the densest crowd; zigzag: sweep
    and lead as a human pilot; pilot_log: repeat recorded set-points; balance: lead people from long queues to
    short ones; signage: hover before the best exit and attract people. Default: "hover"."""
    waypoints: Sequence[Sequence[float]] | None = None
    """The points of the policy "waypoints", in order. Unit: m."""
    speed_mps: float | None = None
    """Speed along the path. Unit: m/s. Default: 3."""
    lead_speed_mps: float | None = None
    """balance: speed at which it leads people; default: 1.6. Unit: m/s."""
    batch: int | None = None
    """balance: max people that it leads at once; default: 50. Unit: people."""
    exits: Sequence[str] | None = None
    """zigzag, balance, signage: ids of the scenario's exits that it may lead to; default: all open ones."""
    beacon: bool | None = None
    """hover, waypoints, orbit, survey, follow_density: whether people may follow the drone, all the time; default:
    false. The other policies decide themselves."""
    perception: Perception | None = None
    """A policy's information about people."""
    center: Sequence[float] | None = None
    """orbit: center of the circle, [x, y]. Unit: m."""
    centre: Sequence[float] | None = None
    """Deprecated: use center. Unit: m."""
    radius_m: float | None = None
    """orbit: radius of the circle. Unit: m."""
    area: Area | None = None
    """survey: the rectangle that it covers; default: the one that people must leave."""
    overlap: float | None = None
    """survey: share of the camera's view that neighboring lanes have in common; without it, 0.3."""
    log: str | None = None
    """pilot_log: a file of set-points in the job's folder, as throng simulate --pilot-logs writes it."""
    setpoints: Sequence[Sequence[float]] | None = None
    """pilot_log: the same in the job itself, by time."""


@dataclass
class Aim(Part):
    """Instead of a start: in every run the drone begins where its camera's optical axis meets one of the people,
    from a direction with free sight, both sampled by the seed. For jobs of several scenarios, and for any
    scenario of which nobody knows the coordinates."""

    _: KW_ONLY
    height_m: float | None = None
    """Height of the drone above the ground. Unit: m. Default: 20."""
    max_distance_m: float | None = None
    """Maximum distance on the ground between drone and person; a camera that looks less steeply has the person below
    its axis. Unit: m. Default: 100."""


@dataclass
class Battery(Part):
    """Limited flight time."""

    _: KW_ONLY
    charge: float | None = None
    """Share of a full battery at the run's start; the drone lands where it is when 15 % are left. Without it, the
    battery is not limited."""


@dataclass
class Drone(Part):
    """One drone and its camera."""

    id: str
    """Unique name: letters, digits, '_' and '-'; also the name of folders, so that ids differ in more than their
    case, and none is a device of Windows (con, nul, com1). The scenario's drone of this id gives the defaults of
    start and moves_goal."""
    _: KW_ONLY
    airframe: str | Mapping[str, Any] | None = None
    """The quadcopter: a name that throng airframes lists, or an object with the fields that it prints for one.
    Default: "f450"."""
    battery: Battery | None = None
    """Limited flight time."""
    start: Sequence[float] | None = None
    """Position where the drone hovers when the run begins; default: the scenario's start for this id. Unit: m."""
    aim: Aim | None = None
    """Instead of a start: in every run the drone begins where its camera's optical axis meets one of the people,
    from a direction with free sight, both sampled by the seed. For jobs of several scenarios, and for any
    scenario of which nobody knows the coordinates."""
    moves_goal: Sequence[int] | None = None
    """The goal of the behavior file, [goal set, goal], that follows the drone over the ground; default: the
    scenario's for this id."""
    guidance: Guidance | None = None
    """The policy that flies the drone."""
    camera: Camera | None = None
    """A camera on a gimbal that cancels the drone's roll and pitch, or fixed to it. Every number except the image's
    size may be a distribution, sampled again for every run."""


@dataclass
class Columns(Part):
    """Names of the columns of a table in its first line, or all of their numbers from 1."""

    _: KW_ONLY
    person: str | None = None
    """Name or number of the person; default: id."""
    frame: str | None = None
    """Number of the frame; default: frame."""
    time: str | None = None
    """Time in seconds, instead of frame."""
    x: str | None = None
    """Position along x; default: x."""
    y: str | None = None
    """Position along y; default: y."""


@dataclass
class Recorded(Part):
    """People of a trajectory file, who are replayed instead of simulating the scenario's; see docs/recorded.md."""

    file: str
    """The file of trajectories, named from the job's folder; a job's own folder keeps a copy. Requests cannot name
    files."""
    _: KW_ONLY
    sha256: str | None = None
    """SHA-256 of the file; another file is refused. Filled in."""
    format: Literal["any", "text", "sqlite", "scb", "csv", "hdf5", "fcd", "json"] | None = None
    """text or csv, a table whose columns may be named below; JuPedSim's sqlite, Menge's scb, the Data Archive's
    hdf5, SUMO's fcd, json of Pathfinder or TrajNet++; without it (any), by suffix and content."""
    frame_rate_hz: float | None = None
    """Frames per second, if the file does not contain the rate or is wrong; with a column of times, the rate to
    interpolate to. Unit: Hz."""
    unit: Literal["m", "cm", "mm", "ft"] | None = None
    """Unit of lengths in the file; default: the file's, else m."""
    columns: Columns | None = None
    """Names of the columns of a table in its first line, or all of their numbers from 1."""
    radius_m: float | None = None
    """Radius of all bodies, which files do not contain; default: 0.2. Unit: m."""
    desired_speed_mps: float | None = None
    """Preferred speed of all people, for the metrics; default: 1.34. Unit: m/s."""


@dataclass
class Crowd(Part):
    """The people of a run and their movement."""

    _: KW_ONLY
    agents: int | None = None
    """Number of the scenario's people that take part, sampled by the seed; default: all. Unit: people."""
    model: str | None = None
    """The pedestrian model (collision avoidance): a name that throng crowd --list prints, for example orca or
    helbing. Default: the scenario's, else ttc, whose speeds and flows are those of real crowds (orca if compat
    asks for the results of Menge)."""
    compat: Literal["none", "menge", "huang2016"] | None = None
    """Program whose results are reproduced where the scenario's files leave a choice: none, Menge with its quirks
    (menge), or also the elements that Huang's group added to it (huang2016). Default: "none"."""
    separation: Literal["auto", "soft", "hard"] | None = None
    """soft: as the model gives it; hard: no two people ever overlap by more than 1 cm; auto: hard with ttc (without
    compat), else soft. Default: "auto"."""
    constants: Literal["best", "posterior", "conservative"] | None = None
    """best: those that fit recorded people best; posterior: each run draws them from the posterior of an earlier fit
    by its seed, so that results spread more (docs/crowd.md); conservative: exits pass no more than IMO 4 and NIST
    5.2 allow, which is less than recorded people do. Models other than ttc have best. Default: "best"."""
    compliance: float | None = None
    """Probability that a person near a guide follows it; multiplies that of the behavior file. Default: 1."""
    leading: float | None = None
    """Share of people who lead something on wheels: a suitcase, a pram or a bicycle. They take up more room and are
    slower. Default: 0."""
    physical: bool | None = None
    """Physical contact: people whom a drone hits or a crowd presses are pushed, and fall above a limit of the force.
    Default: false."""
    fall_impulse_ns: float | None = None
    """Impulse that knocks a person down; needs crowd.physical. Unit: N s. Default: 20."""
    recorded: Recorded | None = None
    """People of a trajectory file, who are replayed instead of simulating the scenario's; see docs/recorded.md."""


@dataclass
class ScenarioShare(Part):
    """One of several scenarios of a job."""

    _: KW_ONLY
    id: str | None = None
    """Id of a scenario."""
    generate: Mapping[str, Any] | None = None
    """Parameters of a generated scenario; without a seed, another one for each run."""
    weight: float | None = None
    """Runs are shared out by the weights. Default: 1."""
    agents: int | None = None
    """Number of people that take part in these runs, instead of crowd.agents. Unit: people."""


@dataclass
class Job(Part):
    """Request for a dataset: a scenario, number of runs, drones with cameras, and outputs. All fields except
    "scenario" have a default."""

    scenario: str | Mapping[str, Any] | Sequence[str | ScenarioShare]
    """Id of a scenario: its path below the scenarios folder, without suffix, for example city_square/nearest_exit.
    Or {"generate": {"kind": "plaza", "seed": 5}}, a scenario generated from a seed; docs/blueprint.md lists its
    parameters. Or a list of these, among which the runs are shared out: ["campus/everyday", {"id":
    "station/everyday", "weight": 2, "agents": 120}, {"generate": {"kind": "street"}}], where a generated scenario
    without a seed is another one in each run."""
    _: KW_ONLY
    name: str | None = None
    """Name of the dataset; also of the archive and its folder."""
    seed: int | None = None
    """All randomness comes from it: equal jobs with equal seeds give equal bytes. Default: 1."""
    runs: int | None = None
    """Number of simulations of the scenario, each with its own seed. Unit: runs. Default: 1."""
    crowd: Crowd | None = None
    """The people of a run and their movement."""
    drones: Sequence[Drone] | None = None
    """The drones, one camera each; default: the scenario's drones, hovering at their starts. [] or a scenario
    without drones: figures without images."""
    capture: Capture | None = None
    """Times of the frames of every run and camera: from_s, then every 1 / rate_hz, up to to_s. The run lasts until
    run_to_s."""
    quality: Literal["draft", "standard", "high"] | None = None
    """Image quality: draft (quick: flat colors, no shadows, coarse people), standard, high (soft shadows, finer
    people, four color samples per pixel). Default: "standard"."""
    environment: Environment | None = None
    """Light and weather. Any field may be a distribution, sampled again for every run."""
    appearance: Appearance | None = None
    """Which characters take part, and adjustments of their clothes' colors."""
    props: Props | None = None
    """The props of the scenario."""
    randomize: Mapping[str, Distribution] | None = None
    """Fields that are sampled again for every run, by their dotted paths, each with a distribution:
    {"drones.0.camera.pitch_deg": {"uniform": [-80, -35]}}."""
    outputs: Outputs | None = None
    """Contents of the dataset."""
