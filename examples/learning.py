"""Shared by train_detector.py, train_counter.py and evaluate.py: datasets, tiles, training, files of models."""

import argparse
import os
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))

import throng  # noqa: E402

try:
    import torch  # noqa: E402
except ImportError:
    sys.exit("this example needs torch, which is not installed: apt-get install python3-torch or pip install torch")

import networks  # noqa: E402

# People of whom less can be seen, or who are smaller, are neither trained on nor scored.
MIN_VISIBILITY = 0.25
MIN_HEIGHT_PX = 6.0


def arguments(description, width):
    """The options of both programs that train."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("datasets", nargs="+", help="datasets of throng: folders, .tar or .zip")
    parser.add_argument("-o", "--output", required=True, help="file of the trained model")
    parser.add_argument("--split", default="train", help="which of the job's splits to train on; all: every image")
    parser.add_argument("--images", type=positive, help="train on so many images, sampled by the seed; default: all")
    parser.add_argument("--steps", type=natural, default=1000, help="0 writes the untrained network")
    parser.add_argument("--batch", type=positive, default=8, help="tiles per step")
    parser.add_argument("--tile", type=positive, default=160, help=f"side in pixels, a multiple of {networks.MULTIPLE}")
    parser.add_argument("--width", type=positive, default=width, help="channels of the network")
    parser.add_argument("--rate", type=float, default=3e-3, help="largest learning rate")
    parser.add_argument("--seed", type=natural, default=1)
    add_machine(parser)
    given = parser.parse_args()
    if given.tile % networks.MULTIPLE:
        parser.error(f"--tile: found {given.tile}, expected a multiple of {networks.MULTIPLE}")
    check_output(given.output)
    device_of(given)
    return given


def check_output(path):
    """Refuses a file of the model that could not be written after the training."""
    folder = pathlib.Path(path).absolute().parent
    if not folder.is_dir():
        raise throng.OutputFileError(f"--output: found {path}, whose folder does not exist, expected a file to write")
    target = path if os.path.exists(path) else folder
    if os.path.isdir(path) or not os.access(target, os.W_OK):
        raise throng.OutputFileError(f"--output: found {path}, which cannot be written, expected a file to write")


def add_machine(parser):
    parser.add_argument("--device", default="auto", help="cpu, cuda, ...; auto: a GPU if there is one")
    parser.add_argument("--threads", type=positive, help="of the CPU; default: all cores")
    parser.add_argument("--workers", type=natural, default=0, help="processes that read images; 0: none of their own")


def natural(text):
    if int(text) < 0:
        raise argparse.ArgumentTypeError(f"found {text}, expected 0 or more")
    return int(text)


def positive(text):
    if int(text) < 1:
        raise argparse.ArgumentTypeError(f"found {text}, expected 1 or more")
    return int(text)


def device_of(given):
    if given.threads:
        torch.set_num_threads(given.threads)
    name = given.device
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    try:
        torch.zeros(1, device=name)
    except (RuntimeError, AssertionError, NotImplementedError) as error:  # by the kind of device
        reason = str(error).split("\n")[0]
        raise ValueError(
            f"--device: found {name}, expected a device of this machine, such as cpu ({reason})"
        ) from error
    return torch.device(name)


def open_datasets(paths, split):
    """The images of a split of one or several datasets; "all" takes every image."""
    parts = [throng.Dataset(path) for path in paths]
    dataset = parts[0] if len(parts) == 1 else throng.merge(parts)
    if split == "all":
        return dataset
    splits = dataset.splits
    if split not in splits:
        raise throng.DatasetError(f"--split: found {split!r}, expected all{''.join(f', {name}' for name in splits)}")
    return splits[split]


def check_tile(dataset, given):
    """Refuses tiles that are larger than every image: the rest would be padding."""
    longest = max((max(frame.width, frame.height) for frame in dataset), default=0)
    limit = -(-longest // networks.MULTIPLE) * networks.MULTIPLE
    if given.tile > limit:
        raise ValueError(
            f"--tile: found {given.tile}, expected at most {limit}: the images have up to {longest} pixels"
        )


def cut_tile(image, side):
    """A square of an image (3, rows, columns) at a random place, flipped in half of the cases, with other light; padded
    where the image is smaller. Gives the tile, its left and top, and whether it is flipped."""
    rows, columns = image.shape[1:]
    left = int(torch.randint(0, max(columns - side, 0) + 1, ()))
    top = int(torch.randint(0, max(rows - side, 0) + 1, ()))
    tile = image[:, top : top + side, left : left + side]
    tile = torch.nn.functional.pad(tile, (0, side - tile.shape[2], 0, side - tile.shape[1]))
    is_flipped = bool(torch.rand(()) < 0.5)
    if is_flipped:
        tile = tile.flip(2)
    contrast, tint = 0.7 + 0.6 * torch.rand(()), 0.12 * (torch.rand(3, 1, 1) - 0.5)
    return ((tile - 0.45) * contrast + 0.45 + tint).clamp(0, 1), left, top, is_flipped


def train(kind, samples, loss_of, given, about):
    """Trains a network of networks.KINDS on tiles and writes it.

    samples: a map-style dataset of tuples of tensors of equal shapes, an image first; loss_of(outputs, *targets) is
    lowered. about goes into the file: whole numbers and tensors, which torch.load reads without running code.
    """
    device = device_of(given)
    model = networks.KINDS[kind](given.width).to(device)
    weights = sum(parameter.numel() for parameter in model.parameters())
    print(f"{kind} of {weights} weights, {len(samples)} images, {given.steps} steps of {given.batch} tiles on {device}")
    began = time.process_time(), time.monotonic()
    if given.steps:
        sampler = torch.utils.data.RandomSampler(samples, replacement=True, num_samples=given.steps * given.batch)
        loader = torch.utils.data.DataLoader(samples, given.batch, sampler=sampler, num_workers=given.workers)
        run_steps(model, loader, loss_of, given, device)
    spent = {"cpu_s": time.process_time() - began[0], "elapsed_s": time.monotonic() - began[1]}
    print(f"trained in {spent['cpu_s']:.0f} s of CPU time, {spent['elapsed_s']:.0f} s elapsed")
    state = {name: value.cpu() for name, value in model.state_dict().items()}
    torch.save({"kind": kind, "width": given.width, "state": state, "steps": given.steps, **about}, given.output)


def run_steps(model, loader, loss_of, given, device):
    optimizer = torch.optim.AdamW(model.parameters(), lr=given.rate, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, given.rate, total_steps=given.steps + 1, pct_start=0.2)
    model.train()
    total = 0.0
    every = max(1, given.steps // 10)
    for step, batch in enumerate(loader, 1):
        image, *targets = (tensor.to(device) for tensor in batch)
        loss = loss_of(model(image), *targets)
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(model.parameters(), 5.0)
        optimizer.step()
        schedule.step()
        total += loss.item()
        if step % every == 0:
            print(f"step {step}: loss {total / every:.4f}", flush=True)
            total = 0.0


def load(path, device):
    """The network of a file that train() wrote, ready to be used, and what else the file holds."""
    try:
        saved = torch.load(path, map_location="cpu", weights_only=True)
        model = networks.KINDS[saved["kind"]](saved["width"])
        model.load_state_dict(saved["state"])
    except Exception as error:  # noqa: BLE001 torch raises many kinds for files that are damaged
        reason = f"found no model of train_detector.py or train_counter.py ({error})"
        raise throng.DatasetError(f"{path}: {reason}") from error
    return model.to(device).eval(), saved


def true_count(frame):
    """Heads of a frame's people that are inside of the image, as throng.CountingDataset counts them."""
    heads = frame.people.heads
    size = torch.tensor([frame.width, frame.height]).numpy()
    return int(((heads >= 0) & (heads < size)).all(axis=1).sum())


def padded(image):
    """The image (3, rows, columns) as a batch whose sides are multiples of networks.MULTIPLE."""
    rows, columns = image.shape[1:]
    extra = (0, -columns % networks.MULTIPLE, 0, -rows % networks.MULTIPLE)
    return torch.nn.functional.pad(image, extra)[None]


def finish(main):
    """Runs a program; mistakes of the input end it with a line and exit code 2."""
    try:
        main()
    except (throng.ThrongError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except (MemoryError, RuntimeError) as error:
        if "memory" not in str(error):
            raise
        print("error: out of memory; a smaller --tile, --batch or --width needs less", file=sys.stderr)
        sys.exit(3)
