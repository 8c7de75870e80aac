#!/usr/bin/env python3
"""Prints what is in a throng dataset folder, from its files alone (standard library only)."""
import array
import ast
import json
import pathlib
import sys
import zipfile


def density_sum(path):
    """Sum of the array of a .npz file, which is a .npy file of float32 (format version 1.0, C order)."""
    with zipfile.ZipFile(path) as file:
        data = file.read("density.npy")
    assert data[:8] == b"\x93NUMPY\x01\x00", f"{path} is no .npy file of version 1.0"
    header_bytes = int.from_bytes(data[8:10], "little")
    header = ast.literal_eval(data[10 : 10 + header_bytes].decode("ascii"))
    assert header["descr"] == "<f4" and not header["fortran_order"], header
    values = array.array("f", data[10 + header_bytes :])
    assert len(values) == header["shape"][0] * header["shape"][1]
    return sum(values)


def main(folder):
    coco = json.loads((folder / "annotations/instances.json").read_text(encoding="utf-8"))
    images = coco["images"]
    people = {category["id"] for category in coco["categories"] if category["name"] == "person"}
    annotations = [annotation for annotation in coco["annotations"] if annotation["category_id"] in people]
    print(f"frames               {len(images)}")
    print(f"annotated people     {len(annotations)} boxes of {len({a['track_id'] for a in annotations})} people")

    heads = total = 0.0
    for image in images:
        density = folder / image["density_file"]
        heads += image["density_count"]
        total += density_sum(density)
    if heads:
        print(
            f"density              maps sum to {total:.2f}, heads in view {heads:.0f}"
            f" ({100 * abs(total - heads) / heads:.4f} % apart)"
        )

    for file in sorted((folder / "metrics").glob("run*.json")):
        metrics = json.loads(file.read_text(encoding="utf-8"))
        escaped = metrics["people"] - metrics["not_escaped"] - metrics["casualties"]
        print(
            f"escaped ({file.stem})     {escaped} of {metrics['people']} people in {metrics['duration_s']:.0f} s,"
            f" mean {metrics['mean_escape_time_censored_s']:.1f} s (who is still inside counts to the end)"
        )
        times = sorted(metrics["escape_time_percentiles"].items(), key=lambda item: int(item[0][1:-2]))
        reached = [f"{key[1:-2]} % at {time_s:.1f} s" for key, time_s in times if time_s is not None]
        print(f"  escape curve       {', '.join(reached) or 'less than 25 % have escaped'}")
        for exit_ in metrics["exits"]:
            print(
                f"  {exit_['id']:<18} {exit_['crossings']['out']:>3} out, {exit_['crossings']['in']:>3} in, mean clogging index"
                f" {exit_['mean_clogging_index']:.2f}, congested {exit_['congested_s']:.1f} s"
            )


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
