"""Damages to images and previews."""
import numpy
from PIL import Image, ImageFilter

from .dataset import damage


@damage
def picture_black(d):
    image = d.image()
    d.save_picture(image, Image.new("RGB", (image["width"], image["height"])))


@damage
def picture_mirrored(d):
    image = d.image()
    d.save_picture(image, d.picture(image).transpose(Image.FLIP_LEFT_RIGHT))


@damage
def picture_upside_down(d):
    image = d.image(0)
    d.save_picture(image, d.picture(image).transpose(Image.FLIP_TOP_BOTTOM))


@damage
def all_pictures_mirrored(d):
    for image in d.images:
        d.save_picture(image, d.picture(image).transpose(Image.FLIP_LEFT_RIGHT))


@damage
def picture_2_px_to_the_right(d):
    image = d.image()
    d.save_picture(image, Image.fromarray(numpy.roll(numpy.array(d.picture(image)), 2, 1)))


@damage
def all_pictures_3_px_down(d):
    for image in d.images:
        d.save_picture(image, Image.fromarray(numpy.roll(numpy.array(d.picture(image)), 3, 0)))


@damage
def red_and_blue_exchanged(d):
    image = d.image()
    d.save_picture(image, Image.fromarray(numpy.array(d.picture(image))[..., ::-1]))


@damage
def red_and_blue_exchanged_in_all_pictures(d):
    for image in d.images:
        d.save_picture(image, Image.fromarray(numpy.array(d.picture(image))[..., ::-1]))


@damage
def picture_without_color(d):
    image = d.image()
    d.save_picture(image, d.picture(image).convert("L").convert("RGB"))


@damage
def picture_negative(d):
    image = d.image(0)
    d.save_picture(image, Image.fromarray(255 - numpy.array(d.picture(image))))


@damage
def picture_blurred(d):
    image = d.image()
    d.save_picture(image, d.picture(image).filter(ImageFilter.GaussianBlur(6)))


@damage
def picture_of_lower_quality(d):
    image = d.image()
    d.save_picture(image, d.picture(image), quality=60)


@damage
def preview_of_another_frame(d):
    names = sorted(str(p.relative_to(d.root)) for p in d.path("previews").rglob("*.jpg"))
    image = next(i for i in d.images if i["file_name"][7:] == names[0][9:])
    other = d.image(d.cameras.index(image["camera_id"]), (image["frame"] + 2) % d.frames, d.runs.index(image["run"]))
    d.save_picture(other, d.picture(other), name=names[0])


@damage
def previews_of_two_cameras_exchanged(d):
    names = sorted(str(p.relative_to(d.root)) for p in d.path("previews").rglob("*.jpg"))
    d.exchange(names[0], names[1])


@damage
def picture_half_as_bright(d):
    image = d.image()
    d.save_picture(image, Image.fromarray((numpy.array(d.picture(image)) * 0.5).astype(numpy.uint8)))


@damage
def all_pictures_20_percent_darker(d):
    for image in d.images:
        d.save_picture(image, Image.fromarray((numpy.array(d.picture(image)) * 0.8).astype(numpy.uint8)))


@damage
def picture_without_somebody(d):
    """The box of somebody large is filled with the ground beside it."""
    image = d.image(0)
    array = numpy.array(d.picture(image))
    x, y, w, h = (int(v) for v in d.largest(image, lambda p: "truncation" not in p)["bbox"])
    array[y : y + h, x : x + w] = array[y : y + h, max(0, x - 2) : max(0, x - 2) + 1]
    d.save_picture(image, Image.fromarray(array))


@damage
def pictures_of_a_camera_exchanged_between_runs(d):
    for frame in range(d.frames):
        d.exchange(d.image(0, frame, 0)["file_name"], d.image(0, frame, 1)["file_name"])


@damage
def pictures_of_a_camera_one_frame_late(d):
    data = [d.path(d.image(-1, f)["file_name"]).read_bytes() for f in range(d.frames)]
    for frame in range(1, d.frames):
        d.write(d.image(-1, frame)["file_name"], data[frame - 1])


DAMAGES = {
    "pictures of two cameras exchanged": lambda d: d.exchange(d.image(0)["file_name"], d.image(1)["file_name"]),
    "pictures of two frames exchanged": lambda d: d.exchange(d.image(0, 1)["file_name"], d.image(0, 3)["file_name"]),
    "picture of the next frame": lambda d: d.copy(d.image(-1, 2)["file_name"], d.image(-1, 1)["file_name"]),
    "picture of the other run": lambda d: d.copy(d.image(0, run=1)["file_name"], d.image(0)["file_name"]),
}
