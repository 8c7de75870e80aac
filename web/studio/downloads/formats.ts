// How each format is made and read. Paths are those of docs/formats.md.

interface Reader {
  /** Formats that are read alike. */
  names: string[];
  /** Python; FOLDER is the format's folder, SPLIT the first split. */
  text: string;
}

const kReaders: Reader[] = [
  { names: ["coco"], text: 'from pycocotools.coco import COCO\ncoco = COCO("FOLDER/annotations/instances_SPLIT.json")' },
  { names: ["coco-keypoints"], text: 'from pycocotools.coco import COCO\ncoco = COCO("FOLDER/annotations/person_keypoints_SPLIT.json")' },
  {
    names: ["coco-wholebody"],
    text: 'import json\nfile = json.load(open("FOLDER/annotations/coco_wholebody_SPLIT_v1.0.json"))\nfeet = [record["foot_kpts"] for record in file["annotations"]]  # x, y, visibility of six points',
  },
  {
    names: ["openpose"],
    text: 'import glob, json\nfor name in glob.glob("FOLDER/SPLIT/json/*_keypoints.json"):\n    people = json.load(open(name))["people"]  # pose_keypoints_2d: x, y, confidence of 25 joints',
  },
  {
    names: ["jta"],
    text: 'import glob, json, numpy as np\nfor name in glob.glob("FOLDER/annotations/SPLIT/*.json"):\n    rows = np.array(json.load(open(name)))  # frame, person, joint, x, y, x, y, z, hidden, self-hidden',
  },
  {
    names: ["market1501"],
    text: 'import glob, re\nfor name in glob.glob("FOLDER/bounding_box_train/*.jpg"):\n    identity, camera = map(int, re.search(r"(-?\\d+)_c(\\d+)", name).groups())',
  },
  {
    names: ["wildtrack"],
    text: 'import glob, json\nfor name in glob.glob("FOLDER/SPLIT/*/annotations_positions/*.json"):\n    people = json.load(open(name))  # personID, positionID, views with boxes',
  },
  {
    names: ["coco-panoptic"],
    text: 'import json\npanoptic = json.load(open("FOLDER/annotations/panoptic_SPLIT.json"))\n# ids: red + 256 green + 65536 blue of FOLDER/panoptic_SPLIT/*.png',
  },
  { names: ["yolo-detect"], text: 'from ultralytics import YOLO\nYOLO("yolo11n.pt").train(data="FOLDER/data.yaml")' },
  { names: ["yolo-segment"], text: 'from ultralytics import YOLO\nYOLO("yolo11n-seg.pt").train(data="FOLDER/data.yaml")' },
  { names: ["yolo-pose"], text: 'from ultralytics import YOLO\nYOLO("yolo11n-pose.pt").train(data="FOLDER/data.yaml")' },
  {
    names: ["mot"],
    text: 'import glob, numpy as np\nfor name in glob.glob("FOLDER/**/gt/gt.txt", recursive=True):\n    tracks = np.loadtxt(name, delimiter=",", ndmin=2)  # frame, id, left, top, width, height, ...',
  },
  {
    names: ["shanghaitech", "shanghaitech-adaptive", "shanghaitech-perspective"],
    text: 'import glob, h5py\nfor name in glob.glob("FOLDER/**/*.h5", recursive=True):\n    count = h5py.File(name)["density"][()].sum()',
  },
  {
    names: ["voc"],
    text: 'import glob, xml.etree.ElementTree as ET\nfor name in glob.glob("FOLDER/**/*.xml", recursive=True):\n    boxes = ET.parse(name).findall("object/bndbox")',
  },
  { names: ["cvat"], text: "# CVAT, task, Upload annotations, CVAT 1.1: the XML files of FOLDER" },
  {
    names: ["webdataset"],
    text: 'import glob, webdataset\nshards = sorted(glob.glob("FOLDER/**/SPLIT-*.tar", recursive=True))\nimages = webdataset.WebDataset(shards, shardshuffle=False).decode("pil").to_tuple("jpg", "json")',
  },
  { names: ["imagefolder"], text: 'from datasets import load_dataset\nimages = load_dataset("imagefolder", data_dir="FOLDER")' },
  {
    names: ["depth-exr"],
    text: 'import os, glob\nos.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"\nimport cv2\nfor name in glob.glob("FOLDER/**/*.exr", recursive=True):\n    depth_m = cv2.imread(name, cv2.IMREAD_UNCHANGED)',
  },
  {
    names: ["flow-flo"],
    text: 'import glob, cv2\nfor name in glob.glob("FOLDER/**/*.flo", recursive=True):\n    flow_px = cv2.readOpticalFlow(name)',
  },
  {
    names: ["cityscapes"],
    text: 'from torchvision.datasets import Cityscapes\nimages = Cityscapes("FOLDER", "SPLIT", "fine", ["semantic", "instance"])',
  },
  {
    names: ["uavid"],
    text: 'import glob, numpy as np\nfrom PIL import Image\nfor name in glob.glob("FOLDER/uavid_SPLIT/*/Labels/*.png"):\n    colors = np.asarray(Image.open(name))  # class colors: docs/formats_pixels.md',
  },
  {
    names: ["jupedsim"],
    text: 'import glob, pedpy\nfrom pathlib import Path\nfor name in glob.glob("FOLDER/SPLIT/*.txt"):\n    trajectories = pedpy.load_trajectory_from_txt(trajectory_file=Path(name))',
  },
  {
    names: ["eth-ucy"],
    text: 'import glob, numpy as np\nfor name in glob.glob("FOLDER/SPLIT/*.txt"):\n    frame, person, x_m, y_m = np.loadtxt(name, ndmin=2).T',
  },
  {
    names: ["trajnet"],
    text: 'import glob, json\nfor name in glob.glob("FOLDER/SPLIT/*.ndjson"):\n    rows = [json.loads(line) for line in open(name)]  # "scene" or "track"',
  },
  {
    names: ["nwpu"],
    text: 'import glob, json\nfor name in glob.glob("FOLDER/jsons/*.json"):\n    record = json.load(open(name))  # human_num, points, boxes; FOLDER/SPLIT.txt lists the split',
  },
  {
    names: ["jhu-crowd"],
    text: 'import glob, numpy as np\nfor name in glob.glob("FOLDER/SPLIT/gt/*.txt"):\n    heads = np.loadtxt(name, ndmin=2)  # x, y, width, height, occlusion, blur',
  },
  {
    names: ["movingdronecrowd"],
    text: 'import glob, numpy as np\nfor name in glob.glob("FOLDER/annotations/*/*.csv"):\n    heads = np.loadtxt(name, delimiter=",", ndmin=2)  # frame, person, left, top, width, height',
  },
  { names: ["mcap"], text: "ros2 bag info --storage mcap FOLDER/SPLIT/run000.mcap  # or open it in Foxglove" },
  { names: ["table"], text: 'import glob, pandas\npeople = pandas.read_csv(glob.glob("FOLDER/**/people.csv", recursive=True)[0])' },
];

const kAnyTable = 'import glob\nfor name in glob.glob("FOLDER/**/*.txt", recursive=True):\n    lines = open(name).read().splitlines()';

/** Reads a format from its folder. */
export function readerOf(format: string, folder: string, split: string): string {
  const text = kReaders.find((reader) => reader.names.includes(format))?.text ?? kAnyTable;
  return text.replaceAll("FOLDER", folder).replaceAll("SPLIT", split);
}

/** Reads a kind of ground truth of the dataset itself. */
const kTruthReaders: Record<string, string> = {
  coco: "frame.people.boxes, frame.people.masks()",
  keypoints: "frame.people.keypoints, frame.people.keypoints_3d",
  amodal: "frame.people.masks(amodal=True)",
  heads: "frame.people.head_boxes, frame.people.head_visibility",
  density: "frame.density()",
  exits: 'dataset.exits("run000")',
  fields: 'dataset.field("run000", 0)',
  counts: 'dataset.counts("run000"), dataset.count_areas("run000")',
  trajectories: 'values, record = dataset.trajectories("run000")',
  events: 'dataset.events("run000")',
  depth: "frame.depth()",
  instances: "frame.instances()",
  parts: "frame.parts()",
  normals: "frame.normals()",
  flow: "flow, known = frame.flow()",
  semantic: "frame.semantic()",
  sensors: 'dataset.sensors("run000", "d1")',
};

export function truthReaderOf(kind: string, dataset: string): string {
  return `import throng\ndataset = throng.Dataset("${dataset}")\nframe = dataset[0]\n${kTruthReaders[kind]}`;
}

export const isTruth = (name: string) => name in kTruthReaders;
